#include "visual/photometry/table/surface_luminance.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <string>

namespace phare {
namespace {

constexpr double kPerPi = std::numbers::inv_pi;

/// Angles that both forms are written in.
struct GrooveAngles {
  double larger, smaller;  ///< of those of light and sight from the normal, radians
  double cos_azimuth;      ///< between their horizontal parts; 1 where one has none
  bool seen;
};

GrooveAngles groove_angles(const LightAndSight& at) {
  const double cos_light = glm::dot(at.normal, at.to_lamp), cos_sight = glm::dot(at.normal, at.to_eye);
  const glm::dvec3 light = at.to_lamp - at.normal * cos_light, sight = at.to_eye - at.normal * cos_sight;
  const double lengths = glm::length(light) * glm::length(sight);
  // By sine and cosine: near grazing a cosine alone is exact, near the normal it is not.
  const double light_rad = std::atan2(glm::length(light), cos_light),
               sight_rad = std::atan2(glm::length(sight), cos_sight);
  return {std::max(light_rad, sight_rad), std::min(light_rad, sight_rad),
          lengths > 0.0 ? std::clamp(glm::dot(light, sight) / lengths, -1.0, 1.0) : 1.0,
          cos_light > 0.0 && cos_sight > 0.0};
}

/// The cell of an axis that holds `at`, and the way through it, 0 to 1.
struct AxisPlace {
  std::size_t cell;
  double part;
};
AxisPlace place_on(const std::vector<double>& nodes, double at) {
  const auto after = std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(nodes, at) - nodes.begin(), 1,
                                                static_cast<std::ptrdiff_t>(nodes.size()) - 1);
  const auto cell = static_cast<std::size_t>(after - 1);
  return {cell, std::clamp((at - nodes[cell]) / (nodes[cell + 1] - nodes[cell]), 0.0, 1.0)};
}

std::string plain_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

Result<std::vector<double>> numbers_of(std::string line, char separator, std::size_t skip) {
  if (separator == ';') std::ranges::replace(line, ',', '.');
  std::vector<double> numbers;
  std::size_t column = 0;
  for (std::size_t begin = 0; begin <= line.size(); ++column) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    double value = 0.0;
    const auto [stop, failed] = std::from_chars(line.data() + begin, line.data() + end, value);
    if (column >= skip) {
      if (failed != std::errc() || stop != line.data() + end || !std::isfinite(value))
        return Error{"", "expected a number, got \"" + line.substr(begin, end - begin) + "\""};
      numbers.push_back(value);
    }
    begin = end + 1;
  }
  return numbers;
}

}  // namespace

double oren_nayar_per_sr(double reflectance, double roughness_rad, const LightAndSight& at) {
  const GrooveAngles angles = groove_angles(at);
  if (!angles.seen) return 0.0;
  const double s2 = roughness_rad * roughness_rad, a = angles.larger, b = angles.smaller, c = angles.cos_azimuth;
  const double b_part = 2.0 * b * kPerPi;
  const double c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
  const double c2 = 0.45 * s2 / (s2 + 0.09) * (c >= 0.0 ? std::sin(a) : std::sin(a) - b_part * b_part * b_part);
  const double ab = 4.0 * a * b * kPerPi * kPerPi;
  const double c3 = 0.125 * s2 / (s2 + 0.09) * ab * ab;
  const double direct = reflectance * (c1 + c * c2 * std::tan(b) + (1.0 - std::abs(c)) * c3 * std::tan(0.5 * (a + b)));
  const double between = 0.17 * reflectance * reflectance * s2 / (s2 + 0.13) * (1.0 - c * b_part * b_part);
  return kPerPi * std::max(direct + between, 0.0);
}

double oren_nayar_simple_per_sr(double reflectance, double roughness_rad, const LightAndSight& at) {
  const GrooveAngles angles = groove_angles(at);
  if (!angles.seen) return 0.0;
  const double s2 = roughness_rad * roughness_rad;
  const double a = 1.0 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
  return kPerPi * reflectance *
         (a + b * std::max(angles.cos_azimuth, 0.0) * std::sin(angles.larger) * std::tan(angles.smaller));
}

double ReducedLuminanceTable::r_at(double beta, double tangent) const {
  if (tan_gamma.empty() || tangent > tan_gamma.back()) return 0.0;
  const AxisPlace row = place_on(tan_gamma, tangent), column = place_on(beta_deg, beta);
  const auto at = [&](std::size_t j, std::size_t i) {
    return r_per_sr[(row.cell + j) * beta_deg.size() + column.cell + i];
  };
  const double low = at(0, 0) + (at(0, 1) - at(0, 0)) * column.part;
  const double high = at(1, 0) + (at(1, 1) - at(1, 0)) * column.part;
  return low + (high - low) * row.part;
}

double ReducedLuminanceTable::q_per_sr(double beta, double tangent) const {
  const double s = 1.0 + tangent * tangent;  // 1/cos²γ
  return r_at(beta, tangent) * s * std::sqrt(s);
}

double road_luminance_cdm2(const ReducedLuminanceTable& table, double intensity_cd, const glm::dvec3& lamp_m,
                           const glm::dvec3& point_m, const glm::dvec3& eye_m) {
  const double h = lamp_m.z - point_m.z;
  if (!(h > 0.0)) return 0.0;
  const glm::dvec2 to_lamp(lamp_m - point_m), to_eye(eye_m - point_m);
  // 0 where lamp, point and eye lie in one plane, the lamp beyond the point: light goes on toward the eye.
  const double cross = to_lamp.x * to_eye.y - to_lamp.y * to_eye.x;
  const double beta = 180.0 * kPerPi * std::atan2(std::abs(cross), -glm::dot(to_lamp, to_eye));
  return intensity_cd * table.r_at(beta, glm::length(to_lamp) / h) / (h * h);
}

Result<ReducedLuminanceTable> read_r_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return Error{file.string(), "cannot be read"};
  ReducedLuminanceTable table;
  std::string line;
  char separator = ',';
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const auto fail = [&](const std::string& reason) {
      return Error{file.string() + ":" + std::to_string(number), reason};
    };
    const bool head = table.beta_deg.empty();
    if (head && line.find(';') != std::string::npos) separator = ';';
    const auto numbers = numbers_of(line, separator, head ? 1 : 0);
    if (!numbers) return fail(numbers.error().reason);
    const auto rises = [](double a, double b) { return b <= a; };
    if (head) {
      table.beta_deg = *numbers;
      if (table.beta_deg.size() < 2 || std::ranges::adjacent_find(*numbers, rises) != numbers->end())
        return fail("expected two angles or more that rise");
      if (table.beta_deg.front() != 0.0 || table.beta_deg.back() != 180.0)
        return fail("expected angles from 0 to 180, got " + plain_number(table.beta_deg.front()) + " to " +
                    plain_number(table.beta_deg.back()));
      continue;
    }
    if (numbers->size() != table.beta_deg.size() + 1)
      return fail("expected tan gamma and " + std::to_string(table.beta_deg.size()) + " values, got " +
                  std::to_string(numbers->size()) + " numbers");
    if (!table.tan_gamma.empty() && numbers->front() <= table.tan_gamma.back()) return fail("tan gamma has to rise");
    if (std::ranges::any_of(*numbers, [](double value) { return value < 0.0; })) return fail("a negative number");
    // Of light from straight above there is no β.
    const auto [least, most] = std::minmax_element(numbers->begin() + 1, numbers->end());
    if (numbers->front() == 0.0 && *most - *least > 0.01 * *most)
      return fail("light from straight above has one r, got " + plain_number(*least) + " to " + plain_number(*most));
    table.tan_gamma.push_back(numbers->front());
    for (std::size_t i = 1; i < numbers->size(); ++i) table.r_per_sr.push_back((*numbers)[i] * 1e-4);
  }
  if (table.tan_gamma.size() < 2) return Error{file.string(), "expected two lines of tan gamma or more"};
  if (*std::ranges::max_element(table.r_per_sr) <= 0.0) return Error{file.string(), "the road sends no light back"};
  return table;
}

}  // namespace phare
