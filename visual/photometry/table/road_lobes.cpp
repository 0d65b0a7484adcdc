#include "visual/photometry/table/road_lobes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>

namespace phare {
namespace {

constexpr double kRadOfDeg = std::numbers::pi / 180.0;

/// Highest power first.
template <std::size_t count>
double polynomial(const std::array<double, count>& factors, double x) {
  double sum = 0.0;
  for (const double factor : factors) sum = sum * x + factor;
  return sum;
}

/// Least squares of one row for a given sharpness. `weights`: of squares.
struct RowFit {
  RoadLobe lobe;
  double squares = std::numeric_limits<double>::infinity();
};
RowFit fitted(const std::vector<double>& cosines, const double* r, const std::vector<double>& weights, double sharp) {
  glm::dmat3 normal(0.0);
  glm::dvec3 right(0.0);
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    const glm::dvec3 basis(1.0, cosines[i], 1.0 / (1.0 + sharp * (1.0 - cosines[i])));
    normal += weights[i] * glm::outerProduct(basis, basis);
    right += weights[i] * r[i] * basis;
  }
  const double size = normal[0][0] * normal[1][1] * normal[2][2];
  if (!(std::abs(glm::determinant(normal)) > 1e-12 * size)) return {};
  const glm::dvec3 x = glm::inverse(normal) * right;
  if (!(x.z >= 0.0)) return {};
  RowFit fit{{x.x, x.y, x.z, sharp}, 0.0};
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    const double off = fit.lobe.r_per_sr(cosines[i]) - r[i];
    fit.squares += weights[i] * off * off;
  }
  return fit;
}

}  // namespace

RoadLobes RoadLobes::asphalt() {
  // Fitted to R3 (CIE 144:2001) by least squares, each value weighed by one over itself and a tenth of the largest at
  // its tan γ. Of u = ln(1 + tan γ): logarithms of the four numbers, two of them over tan γ.
  constexpr std::array kMean{0.2825, -1.0078, -1.4, -3.5289}, kSharp{0.2264, -1.4574, 5.8418, -1.2077};
  constexpr std::array kPeak{0.0512, 0.0525, -1.2116, 0.0663, -2.9866};
  constexpr std::array kAlong{-1.6523, -0.2243, -5.7709};
  constexpr double kStep = 0.25, kLast = 12.0;  // where the tables of CIE 144 end
  RoadLobes lobes;
  for (double t = 0.0; t <= kLast; t += kStep) {
    const double u = std::log1p(t);
    lobes.tan_gamma_.push_back(t);
    lobes.rows_.push_back({.mean = std::exp(polynomial(kMean, u)),
                           .along = -t * std::exp(polynomial(kAlong, u)),
                           .peak = t * std::exp(polynomial(kPeak, u)),
                           .sharp = std::exp(polynomial(kSharp, u))});
  }
  return lobes;
}

RoadLobes RoadLobes::of(const ReducedLuminanceTable& table) {
  const std::size_t columns = table.beta_deg.size();
  std::vector<double> cosines, spans;
  for (std::size_t i = 0; i < columns; ++i) {
    cosines.push_back(std::cos(table.beta_deg[i] * kRadOfDeg));
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, columns - 1);
    spans.push_back(table.beta_deg[after] - table.beta_deg[before]);
  }
  RoadLobes lobes;
  lobes.tan_gamma_ = table.tan_gamma;
  for (std::size_t row = 0; row < table.tan_gamma.size(); ++row) {
    const double* r = &table.r_per_sr[row * columns];
    const double most = *std::max_element(r, r + columns);
    std::vector<double> weights;
    for (std::size_t i = 0; i < columns; ++i) {
      const double scale = r[i] > 0.0 ? r[i] + 0.1 * most : most;
      weights.push_back(scale > 0.0 ? spans[i] / (scale * scale) : 0.0);
    }
    RowFit best;
    constexpr double kLeast = 0.2, kStep = 1.02;  // half as bright 53° beside; steps of 1 % of a streak's width
    for (double sharp = kLeast; sharp < 1e4; sharp *= kStep)
      if (const RowFit fit = fitted(cosines, r, weights, sharp); fit.squares < best.squares) best = fit;
    // Even all round, or of too few columns: the mean.
    if (!std::isfinite(best.squares)) {
      double sum = 0.0, all = 0.0;
      for (std::size_t i = 0; i < columns; ++i) sum += spans[i] * r[i], all += spans[i];
      best.lobe = {.mean = sum / all, .sharp = lobes.rows_.empty() ? 1.0 : lobes.rows_.back().sharp};
    }
    lobes.rows_.push_back(best.lobe);
  }
  return lobes;
}

RoadLobe RoadLobes::at(double tangent) const {
  if (rows_.empty() || tangent > tan_gamma_.back()) return {};
  const auto after = std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(tan_gamma_, tangent) - tan_gamma_.begin(), 1,
                                                static_cast<std::ptrdiff_t>(rows_.size()) - 1);
  const auto row = static_cast<std::size_t>(after - 1);
  const double part =
      std::clamp((tangent - tan_gamma_[row]) / (tan_gamma_[row + 1] - tan_gamma_[row]), 0.0, 1.0);
  const RoadLobe &a = rows_[row], &b = rows_[row + 1];
  return {std::lerp(a.mean, b.mean, part), std::lerp(a.along, b.along, part), std::lerp(a.peak, b.peak, part),
          std::lerp(a.sharp, b.sharp, part)};
}

double RoadLobes::r_at(double beta, double tangent) const {
  return std::max(at(tangent).r_per_sr(std::cos(beta * kRadOfDeg)), 0.0);
}

ReducedLuminanceTable RoadLobes::table(std::vector<double> beta_deg, std::vector<double> tan_gamma) const {
  ReducedLuminanceTable table{std::move(beta_deg), std::move(tan_gamma), {}};
  for (const double tangent : table.tan_gamma)
    for (const double beta : table.beta_deg) table.r_per_sr.push_back(r_at(beta, tangent));
  return table;
}

}  // namespace phare
