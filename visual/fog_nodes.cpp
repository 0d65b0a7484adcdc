#include "visual/fog_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <optional>

namespace phare {
namespace {

/// Elevations above the way a lamp looks between which rows lie closer together, by this factor: cut-offs and what of
/// them is near.
constexpr double kCloseAbove_rad = 0.045, kCloseBelow_rad = -0.065, kCloser = 12.0;
/// Of the nodes, where lamps are in view, those about them. Chosen so that the error of own beams and beside lamps is
/// alike.
constexpr double kShareOfPeaks = 0.55;
/// No lens of a headlamp is smaller: nearer to its middle light does not rise as beside a point.
constexpr double kLens_m = 0.05;

/// Rising from 0 to 1 over the side, as fast as nodes lie close.
class Density {
 public:
  Density(std::span<const NodeBand> bands, std::span<const NodePeak> peaks) : bands_(bands), peaks_(peaks) {
    even_ = even(1.0);
    share_of_peaks_ = peaks_.empty() ? 0.0 : kShareOfPeaks;
  }
  double operator()(double at_01) const {
    double about = 0.0;
    for (const NodePeak& peak : peaks_) {
      const auto row = [&](double at) { return std::asinh((at - peak.at_01) / peak.width_01); };
      about += (row(at_01) - row(0.0)) / (row(1.0) - row(0.0));
    }
    const double even_part = (1.0 - share_of_peaks_) * even(at_01) / even_;
    return peaks_.empty() ? even_part : even_part + share_of_peaks_ * about / static_cast<double>(peaks_.size());
  }

 private:
  double even(double at_01) const {
    double sum = at_01;
    for (const NodeBand& band : bands_)
      sum += (kCloser - 1.0) * (std::clamp(at_01, band.from_01, band.to_01) - band.from_01);
    return sum;
  }
  std::span<const NodeBand> bands_;
  std::span<const NodePeak> peaks_;
  double even_ = 1.0, share_of_peaks_ = 0.0;
};

}  // namespace

std::vector<double> place_nodes(std::size_t count, std::span<const NodeBand> bands, std::vector<NodePeak> peaks) {
  // Lamps of one housing share their row.
  std::ranges::sort(peaks, {}, &NodePeak::at_01);
  std::vector<NodePeak> apart;
  for (const NodePeak& peak : peaks) {
    if (apart.empty() || peak.at_01 - apart.back().at_01 > peak.width_01)
      apart.push_back(peak);
    else
      apart.back().width_01 = std::min(apart.back().width_01, peak.width_01);
  }
  const Density density(bands, apart);
  std::vector<double> nodes(count);
  nodes.back() = 1.0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double wanted = static_cast<double>(i) / static_cast<double>(count - 1);
    double low = nodes[i - 1], high = 1.0;
    for (int halving = 0; halving < 30; ++halving) {
      const double middle = 0.5 * (low + high);
      (density(middle) < wanted ? low : high) = middle;
    }
    nodes[i] = high;
  }
  return nodes;
}

FogNodes place_nodes(const ViewGeometry& view, const glm::dvec2& size_px, std::span<const LampInFog> lamps,
                     std::size_t columns, std::size_t rows) {
  const glm::dmat3& eye = view.camera().world_from_eye;
  const double half_up = view.half_up(), half_across = half_up * view.aspect();
  std::optional<NodeBand> band;
  std::vector<NodePeak> across, down;
  for (const LampInFog& lamp : lamps) {
    // The cut-off of a lamp that looks ahead as the eye does lies level before both.
    const glm::dvec3 ahead = lamp.forward * eye;
    if (ahead.x > 0.3) {
      const auto way_down = [&](double above_rad) {
        const double elevation = std::clamp(std::atan2(ahead.z, ahead.x) + above_rad, -1.4, 1.4);
        return std::clamp(0.5 - 0.5 * std::tan(elevation) / half_up, 0.0, 1.0);
      };
      const NodeBand own{way_down(kCloseAbove_rad), way_down(kCloseBelow_rad)};
      if (!band) band = own;
      band = NodeBand{std::min(band->from_01, own.from_01), std::max(band->to_01, own.to_01)};
    }
    const glm::dvec4 clip = view.clip_from_eye() * glm::dvec4(lamp.from_eye_m, 1.0);
    if (clip.w <= 0.0) continue;
    const glm::dvec2 at = 0.5 + 0.5 * glm::dvec2(clip) / clip.w;
    // What is that far outside of the picture has no peak in it.
    if (std::abs(at.x - 0.5) > 0.6 || std::abs(at.y - 0.5) > 0.6) continue;
    const double lens = 0.5 * kLens_m / std::max((lamp.from_eye_m * eye).x, kLens_m);
    across.push_back({at.x, std::max(lens / half_across, 0.5 / size_px.x)});
    down.push_back({at.y, std::max(lens / half_up, 0.5 / size_px.y)});
  }
  const std::span<const NodeBand> bands(band ? &*band : nullptr, band ? 1 : 0);
  return {place_nodes(columns, {}, std::move(across)), place_nodes(rows, bands, std::move(down))};
}

std::vector<double> places_of_pixels(std::span<const double> nodes_01, double first_px, double size_px) {
  std::vector<double> places;
  const double end_px = first_px + size_px;
  std::size_t node = 0;
  for (double px = 0.0; px < end_px; px += 1.0) {
    const double at_01 = std::clamp((px + 0.5 - first_px) / size_px, 0.0, 1.0);
    while (node + 2 < nodes_01.size() && nodes_01[node + 1] <= at_01) ++node;
    const double part = (at_01 - nodes_01[node]) / (nodes_01[node + 1] - nodes_01[node]);
    places.push_back(static_cast<double>(node) + std::min(part, 1.0 - 1e-4));
  }
  return places;
}

}  // namespace phare
