// Lamps of a formula, and their light by both ways: for the hard cases.
#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "tools/hard_cases/hard_case.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare::hard {

/// Type B, nodes evenly from -`half_deg` to `half_deg`, `columns` × `rows`; candela by H and V in degrees.
IntensityTable table_of(double half_deg, std::size_t columns, std::size_t rows,
                        const std::function<double(double h_deg, double v_deg)>& candela);

/// The same intensity toward everything ahead within 89°.
IntensityTable even_lamp(double candela);

struct Point {
  glm::dvec3 at_m{0.0}, normal{0.0, 0.0, 1.0};
};

struct Placed {
  const IntensityTable* table = nullptr;
  glm::dvec3 at_m{0.0};
  glm::dmat3 world_from_lamp{1.0};
  double scale = 1.0;
};

/// Lux of a lamp at points.
std::vector<double> float64_lx(const Placed& lamp, std::span<const Point> points);
/// The same through the shader that draws the frame; empty without a device.
std::vector<double> device_lx(const Bench& bench, const Placed& lamp, std::span<const Point> points);

/// Relative to `exact`; absolute where that is 0.
double relative(double value, double exact);

/// Both ways against what is exact; `along`: what the points differ in.
Outcome against(const Bench& bench, const Placed& lamp, std::span<const Point> points, std::span<const double> exact,
                std::span<const double> along);

}  // namespace phare::hard
