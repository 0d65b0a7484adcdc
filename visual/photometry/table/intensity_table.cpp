// Luminous intensity of one photometry file over direction.
// Computes: I(direction) bilinear in the file's own angles, and the flux as the exact integral of that surface.
// Source: ANSI/IES LM-63-19 and LM-75 for the three goniometer types; the integrals are worked out below.
// Frame: the lamp's, x along the optical axis, y left, z up. Leaves out: near field (lamps are points), spectrum.
// Checked by tests/photometry/reference_test.cpp (0_intensity.csv, f_flux.csv) and lm63_test.cpp.
#include "visual/photometry/table/intensity_table.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace phare {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// Cell of `x` on ascending nodes and the shares of its two nodes; index + 1 is a node, too. False outside the range.
/// Each share is worked out by itself, so that a mirrored table gives the mirrored values to the bit.
struct Cell {
  std::size_t index = 0;
  double lower_share_01 = 1.0;
  double upper_share_01 = 0.0;
};

bool find_cell(const std::vector<double>& nodes, double x, Cell& cell) {
  // Written so that a NaN is outside.
  if (nodes.size() < 2 || !(x >= nodes.front() && x <= nodes.back())) return false;
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  cell.index = static_cast<std::size_t>(above - nodes.begin()) - 1;
  const double low = nodes[cell.index], high = nodes[cell.index + 1];
  cell.lower_share_01 = (high - x) / (high - low);
  cell.upper_share_01 = (x - low) / (high - low);
  return true;
}

/// What a cell's lower and upper node contribute to the integral of a linear function times the weight.
struct Weights {
  double lower = 0.0;
  double upper = 0.0;
};

/// Weight 1 (the angle about the polar axis). Radians.
Weights flat_weights(double from_rad, double to_rad) {
  const double half = 0.5 * (to_rad - from_rad);
  return {half, half};
}

/// Weight cos(x). With m the middle, h half the width and x = m + u:
///   ∫ cos(x)·(1/2 ± u/2h) du over [-h, h] = cos(m)·sin(h) ∓ sin(m)·(sin(h) - h·cos(h))/h.
/// About the middle nothing cancels, so narrow cells keep their digits.
Weights cosine_weights(double from_rad, double to_rad) {
  const double m = 0.5 * (from_rad + to_rad);
  const double h = 0.5 * (to_rad - from_rad);
  // (sin h - h cos h)/h = h²/3 - h⁴/30 + h⁶/840 - … ; the closed form loses digits below 0.1 rad.
  const double h2 = h * h;
  const double tilt = h < 0.1 ? h2 * (1.0 / 3.0 - h2 * (1.0 / 30.0 - h2 * (1.0 / 840.0 - h2 / 45360.0)))
                              : std::sin(h) / h - std::cos(h);
  return {std::cos(m) * std::sin(h) + std::sin(m) * tilt, std::cos(m) * std::sin(h) - std::sin(m) * tilt};
}

/// Weight sin(x) = cos(x - 90°).
Weights sine_weights(double from_rad, double to_rad) {
  return cosine_weights(from_rad - std::numbers::pi / 2, to_rad - std::numbers::pi / 2);
}

/// Weight of each node for the integral over the whole axis.
std::vector<double> node_weights(const std::vector<double>& nodes_deg, Weights (*cell_weights)(double, double)) {
  std::vector<double> weights(nodes_deg.size(), 0.0);
  for (std::size_t i = 0; i + 1 < nodes_deg.size(); ++i) {
    const Weights cell = cell_weights(nodes_deg[i] / kDegreesPerRadian, nodes_deg[i + 1] / kDegreesPerRadian);
    weights[i] += cell.lower;
    weights[i + 1] += cell.upper;
  }
  return weights;
}

}  // namespace

// Lamp axes: x ahead out of the page towards the driver's view, y left, z up. As seen from the lamp, looking ahead:
//
//            z, V > 0                 type A: polar axis z. H turns about z (right positive), V is the latitude.
//               |                     type B: polar axis y. V turns about y (up positive), H is the latitude.
//   y  ---------+---------  H > 0     type C: polar axis gamma = 0; C turns about it, counter-clockwise as LM-63 says.
//  left         |           right       gamma0:  gamma = 0 along x, C = 0 to the right, C = 90 up.
//               |                       gamma90: gamma = 0 straight down, C = 0 ahead, C = 90 left.
TableAngles table_angles(PhotometricType type, GammaAxis axis, const glm::dvec3& direction) {
  const double x = direction.x;
  const double y = direction.y;
  const double z = direction.z;
  switch (type) {
    case PhotometricType::kA:
      return {std::atan2(-y, x) * kDegreesPerRadian, std::atan2(z, std::sqrt(x * x + y * y)) * kDegreesPerRadian};
    case PhotometricType::kB:
      return {std::atan2(-y, std::sqrt(x * x + z * z)) * kDegreesPerRadian, std::atan2(z, x) * kDegreesPerRadian};
    case PhotometricType::kC:
      break;
  }
  const glm::dvec3 c = axis == GammaAxis::kGamma0 ? glm::dvec3{-y, z, x} : glm::dvec3{x, y, -z};  // along c0, c90, g0
  double c_deg = std::atan2(c.y, c.x) * kDegreesPerRadian;
  if (c_deg < 0.0) c_deg += 360.0;
  if (c_deg >= 360.0) c_deg = 0.0;  // -1e-15 + 360 rounds to 360
  return {c_deg, std::atan2(std::sqrt(c.x * c.x + c.y * c.y), c.z) * kDegreesPerRadian};
}

glm::dvec3 direction_hv(double h_deg, double v_deg) {
  const double h = h_deg / kDegreesPerRadian;
  const double v = v_deg / kDegreesPerRadian;
  return {std::cos(v) * std::cos(h), -std::cos(v) * std::sin(h), std::sin(v)};
}

glm::dvec3 table_direction(PhotometricType type, GammaAxis axis, TableAngles angles) {
  const double first = angles.first_deg / kDegreesPerRadian;
  const double second = angles.second_deg / kDegreesPerRadian;
  switch (type) {
    case PhotometricType::kA:
      return direction_hv(angles.first_deg, angles.second_deg);
    case PhotometricType::kB:
      return {std::cos(first) * std::cos(second), -std::sin(first), std::cos(first) * std::sin(second)};
    case PhotometricType::kC:
      break;
  }
  const double c0 = std::sin(second) * std::cos(first), c90 = std::sin(second) * std::sin(first);
  const double g0 = std::cos(second);
  return axis == GammaAxis::kGamma0 ? glm::dvec3{g0, -c0, c90} : glm::dvec3{c0, c90, -g0};
}

TableAngles IntensityTable::angles_of(const glm::dvec3& direction) const {
  if (screen_distance_m <= 0.0) return table_angles(type, axis, direction);
  return {std::atan2(-direction.y, direction.x) * kDegreesPerRadian,
          std::atan2(direction.z, direction.x) * kDegreesPerRadian};
}

glm::dvec3 IntensityTable::direction_of(TableAngles angles) const {
  return screen_distance_m > 0.0 ? screen_direction(angles) : table_direction(type, axis, angles);
}

// The distance to a point over its distance along the axis, cubed: two for 1/r², one for the cosine.
double screen_factor(double t, double u) {
  const double s = 1.0 + t * t + u * u;
  return s * std::sqrt(s);
}

glm::dvec3 screen_direction(TableAngles angles) {
  return glm::normalize(glm::dvec3{1.0, -std::tan(angles.first_deg / kDegreesPerRadian),
                                   std::tan(angles.second_deg / kDegreesPerRadian)});
}

double IntensityTable::intensity_cd(const glm::dvec3& direction) const {
  if (direction == glm::dvec3{0.0}) return 0.0;
  TableAngles angles = angles_of(direction);
  if (screen_distance_m > 0.0 && direction.x > 0.0 && !candela.empty()) {
    // A point on the screen's rim may miss it by a rounding of its tangent: it is on it.
    constexpr double kRounding_deg = 1e-12;
    const auto onto_rim = [](const std::vector<double>& nodes, double deg) {
      const double within = std::clamp(deg, nodes.front(), nodes.back());
      return std::abs(deg - within) < kRounding_deg ? within : deg;
    };
    angles = {onto_rim(first_deg, angles.first_deg), onto_rim(second_deg, angles.second_deg)};
  }
  return intensity_at_cd(angles);
}

namespace {

/// E on the screen is bilinear in the tangents: I = (1 + t² + u²)^1.5 · Σ w·I_node / (1 + t_node² + u_node²)^1.5.
double screen_intensity_cd(const IntensityTable& table, const Cell& first, const Cell& second, TableAngles angles) {
  const auto tangent = [](double deg) { return std::tan(deg / kDegreesPerRadian); };
  const double t[2] = {tangent(table.first_deg[first.index]), tangent(table.first_deg[first.index + 1])};
  const double u[2] = {tangent(table.second_deg[second.index]), tangent(table.second_deg[second.index + 1])};
  const double at_t = tangent(angles.first_deg), at_u = tangent(angles.second_deg);
  const double share_t[2] = {(t[1] - at_t) / (t[1] - t[0]), (at_t - t[0]) / (t[1] - t[0])};
  const double share_u = (at_u - u[0]) / (u[1] - u[0]);
  const double* row = table.candela.data() + second.index * table.first_deg.size() + first.index;
  double sum = 0.0;
  for (std::size_t j = 0; j < 2; ++j) {
    double of_row = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      of_row += share_t[i] * row[j * table.first_deg.size() + i] / screen_factor(t[i], u[j]);
    sum += (j == 0 ? 1.0 - share_u : share_u) * of_row;
  }
  return sum * screen_factor(at_t, at_u);
}

}  // namespace

double IntensityTable::intensity_at_cd(TableAngles angles) const {
  Cell first;
  Cell second;
  if (!find_cell(first_deg, angles.first_deg, first) || !find_cell(second_deg, angles.second_deg, second)) return 0.0;
  if (screen_distance_m > 0.0) return screen_intensity_cd(*this, first, second, angles);
  const double* row = candela.data() + second.index * first_deg.size() + first.index;
  const double* next_row = row + first_deg.size();
  const double v = second.upper_share_01;
  const double low = row[0] * first.lower_share_01 + row[1] * first.upper_share_01;
  const double high = next_row[0] * first.lower_share_01 + next_row[1] * first.upper_share_01;
  return low * (1.0 - v) + high * v;
}

namespace {

/// ∫E dA of a flat screen: with D² out of E·D² and of the area, Σ cells (mean of the corners)·Δt·Δu.
double screen_flux_lm(const IntensityTable& table) {
  std::vector<double> t, u;
  for (const double deg : table.first_deg) t.push_back(std::tan(deg / kDegreesPerRadian));
  for (const double deg : table.second_deg) u.push_back(std::tan(deg / kDegreesPerRadian));
  const auto weight = [](const std::vector<double>& nodes, std::size_t i) {
    return 0.5 * ((i > 0 ? nodes[i] - nodes[i - 1] : 0.0) + (i + 1 < nodes.size() ? nodes[i + 1] - nodes[i] : 0.0));
  };
  double flux_lm = 0.0;
  for (std::size_t j = 0; j < u.size(); ++j) {
    double row = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i)
      row += weight(t, i) * table.candela[j * t.size() + i] / screen_factor(t[i], u[j]);
    flux_lm += weight(u, j) * row;
  }
  return flux_lm;
}

}  // namespace

double IntensityTable::flux_lm() const {
  if (screen_distance_m > 0.0) return screen_flux_lm(*this);
  // dω = cos V dV dH (A), cos H dH dV (B), sin γ dγ dC (C).
  const auto first = node_weights(first_deg, type == PhotometricType::kB ? cosine_weights : flat_weights);
  const auto second = node_weights(second_deg, type == PhotometricType::kA   ? cosine_weights
                                               : type == PhotometricType::kB ? flat_weights
                                                                             : sine_weights);
  double flux_lm = 0.0;
  for (std::size_t j = 0; j < second.size(); ++j) {
    double row = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) row += first[i] * candela[j * first.size() + i];
    flux_lm += second[j] * row;
  }
  return flux_lm;
}

double IntensityTable::peak_cd() const {
  return candela.empty() ? 0.0 : *std::max_element(candela.begin(), candela.end());
}

TableAngles IntensityTable::peak_at() const {
  if (candela.empty()) return {};
  const std::size_t at = static_cast<std::size_t>(std::max_element(candela.begin(), candela.end()) - candela.begin());
  return {first_deg[at % first_deg.size()], second_deg[at / first_deg.size()]};
}

}  // namespace phare
