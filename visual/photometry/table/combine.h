// New tables out of others: sums, a table on another grid; and how far one table is from others.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// The sum of tables in one lamp frame. Of one type and axis: on the union of their nodes, which is exact but for a
/// band of 0.01° beside a lit limit. Otherwise: on the first's grid if it is type A, else on a type A grid of the
/// first's extent; then good to what that grid resolves. Empty input gives an empty table.
IntensityTable sum_tables(std::span<const IntensityTable* const> tables);

/// The table on another grid of type A or C (gamma 0 = optical axis), sampled by direction.
IntensityTable resample(const IntensityTable& table, PhotometricType type, GammaAxis axis,
                        std::vector<double> first_deg, std::vector<double> second_deg,
                        const glm::dmat3& car_from_lamp = glm::dmat3{1.0});

/// A type A grid that holds what a table of any kind shows: its own nodes if it is type A; else 0.05° near the axis
/// and coarser outward, within where it is lit.
void type_a_grid(const IntensityTable& table, std::vector<double>& h_deg, std::vector<double>& v_deg);

/// How far a table is from the sum of `parts`: at every node and in the middle of every cell of each part, but at the
/// poles, where one direction has many angles. A direction on a limit counts as inside, however the angles round.
struct TableDifference {
  double worst_cd = 0.0;
  TableAngles at;  ///< azimuth and elevation
  std::size_t looked_at = 0;
};
TableDifference difference_from_sum(std::span<const IntensityTable* const> parts, const IntensityTable& table);

}  // namespace phare
