// From what a photometry file stores to a whole table: symmetry unfolded, planes in order, the roll of a type C file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// A column of the whole table and the plane of the file that it repeats.
struct Column {
  double angle_deg = 0.0;
  std::size_t plane = 0;
};

/// Adds to each column its image at `about2_deg - angle`, but none that is there already. Ascending in and out.
void mirror_columns(std::vector<Column>& columns, double about2_deg);

/// Undoes the symmetry that the first and last horizontal angle stand for (LM-63-19 §5.15). `symmetry` and `note` say
/// what it was. The error is the reason alone.
struct Unfolded {
  std::vector<Column> columns;
  std::string symmetry;
  std::string note;  ///< what was repaired; empty if nothing
};
Result<Unfolded> unfold_lm63(std::span<const double> first_deg, PhotometricType type);

/// Puts `planes` (plane after plane, each with one value for every `second_deg`) under `columns` into the table.
void fill_table(IntensityTable& table, std::span<const Column> columns, std::vector<double> second_deg,
                std::span<const double> planes);

/// Turns a whole type C table (C from 0 to 360) about its polar axis: C of the table becomes C + turn_deg. Exact: where
/// the seam falls between two planes, the plane there is their bilinear mean.
void turn_about_axis(IntensityTable& table, double turn_deg);

/// The smallest step a decimal number as written can take: "12.50" -> 0.01, "1e3" -> 1000.
double last_digit(std::string_view word);

}  // namespace phare
