#include "visual/photometry/table/opening.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace phare {
namespace {

/// As the file has them: across the optical axis, to the left or right and upward, and along it. Negative: round.
struct Sizes {
  double across_m = 0.0, up_m = 0.0, along_m = 0.0;
};

Sizes sizes_of(const IntensityTable& table) {
  const LampHeader& header = table.header;
  double width_m = header.width_m, length_m = header.length_m, height_m = header.height_m;
  if (header.format == "EULUMDAT") {
    if (width_m == 0.0) width_m = length_m = -length_m;  // its sign of a round one
    std::swap(width_m, length_m);                        // now as LM-63 has them: length along C 0
  }
  if (table.type == PhotometricType::kA) return {width_m, height_m, length_m};
  if (table.type == PhotometricType::kB) return {width_m, length_m, height_m};
  const double turn_rad = header.read_c0_deg * std::numbers::pi / 180.0;
  if (std::abs(std::sin(turn_rad)) > std::abs(std::cos(turn_rad))) std::swap(width_m, length_m);
  if (table.axis == GammaAxis::kGamma0) return {length_m, width_m, height_m};
  return {width_m, height_m, length_m};
}

double largest_m(const IntensityTable& table) {
  return std::max(
      {std::abs(table.header.width_m), std::abs(table.header.length_m), std::abs(table.header.height_m)});
}

std::string text_of(const LampOpening& opening) {
  char text[64];
  if (opening.round && opening.width_m == opening.height_m)
    std::snprintf(text, sizeof text, "round, %.4g mm", 1e3 * opening.width_m);
  else
    std::snprintf(text, sizeof text, "%s%.4g x %.4g mm", opening.round ? "elliptic, " : "", 1e3 * opening.width_m,
                  1e3 * opening.height_m);
  return text;
}

}  // namespace

std::optional<LampOpening> stated_opening(const IntensityTable& table) {
  const double most_m = largest_m(table);
  if (!(most_m > 0.0) || most_m > kLargestOpening_m) return std::nullopt;
  auto [across_m, up_m, along_m] = sizes_of(table);
  if (across_m == 0.0) across_m = along_m;
  else if (up_m == 0.0) up_m = along_m;
  const bool round = across_m < 0.0 || up_m < 0.0;
  if (round && up_m == 0.0) up_m = across_m;
  if (round && across_m == 0.0) across_m = up_m;
  return LampOpening{std::abs(across_m), std::abs(up_m), round};
}

std::string opening_text(const IntensityTable& table) {
  if (const std::optional<LampOpening> stated = stated_opening(table)) return text_of(*stated) + ", by the file";
  const std::string chosen = text_of({}) + ", chosen: ";
  if (largest_m(table) > kLargestOpening_m) {
    char text[80];
    std::snprintf(text, sizeof text, "the file's %.4g m are more than %.4g m", largest_m(table), kLargestOpening_m);
    return chosen + text;
  }
  return chosen + "the file states none";
}

}  // namespace phare
