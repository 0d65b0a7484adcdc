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
/// Of the rows, where lamps are in view, those about them: chosen, cut-offs have the rest.
constexpr double kRowsOfPeaks = 0.55;
/// Of a pixel's weight between nodes what follows the fall beside a lamp, the rest a straight line. Chosen by computing
/// 1/d beside the lamps of a car at 50 m: there least is the worst of all pixels 0.1 m beside them and more.
constexpr double kFollowsFall = 0.8;
/// No lens of a headlamp is smaller: nearer to its middle light does not rise as beside a point.
constexpr double kLens_m = 0.05;

/// How many factors of distance lie between a peak and a place, to either side.
double row_about(const NodePeak& peak, double at_01) {
  return std::asinh((at_01 - peak.at_01) / peak.width_01);
}

/// Rising from 0 to 1 over the side, as fast as nodes lie close.
class Density {
 public:
  Density(std::span<const NodeBand> bands, std::span<const NodePeak> peaks, double share_of_peaks)
      : bands_(bands), peaks_(peaks), share_of_peaks_(peaks.empty() ? 0.0 : share_of_peaks) {
    whole_ = even(1.0);
    if (!peaks_.empty()) whole_about_ = about(1.0);
  }
  double operator()(double at_01) const {
    const double even_part = (1.0 - share_of_peaks_) * even(at_01) / whole_;
    return peaks_.empty() ? even_part : even_part + share_of_peaks_ * about(at_01) / whole_about_;
  }

 private:
  double even(double at_01) const {
    double sum = at_01;
    for (const NodeBand& band : bands_)
      sum += (kCloser - 1.0) * (std::clamp(at_01, band.from_01, band.to_01) - band.from_01);
    return sum;
  }
  double about(double at_01) const {
    double sum = 0.0;
    for (const NodePeak& peak : peaks_) sum += row_about(peak, at_01) - row_about(peak, 0.0);
    return sum;
  }
  std::span<const NodeBand> bands_;
  std::span<const NodePeak> peaks_;
  double share_of_peaks_, whole_ = 1.0, whole_about_ = 1.0;
};

/// As light falls beside a peak, and about its middle as over a lens.
double fall(const NodePeak& peak, double at_01) {
  return 1.0 / std::hypot(at_01 - peak.at_01, peak.width_01);
}

}  // namespace

NodeRow place_nodes(std::size_t count, std::span<const NodeBand> bands, std::vector<NodePeak> peaks,
                    double share_of_peaks) {
  // Lamps of one housing share their row.
  std::ranges::sort(peaks, {}, &NodePeak::at_01);
  NodeRow row;
  for (const NodePeak& peak : peaks) {
    if (row.peaks.empty() || peak.at_01 - row.peaks.back().at_01 > peak.width_01)
      row.peaks.push_back(peak);
    else
      row.peaks.back().width_01 = std::min(row.peaks.back().width_01, peak.width_01);
  }
  const Density density(bands, row.peaks, share_of_peaks);
  row.at_01.resize(count);
  row.at_01.back() = 1.0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double wanted = static_cast<double>(i) / static_cast<double>(count - 1);
    double low = row.at_01[i - 1], high = 1.0;
    for (int halving = 0; halving < 30; ++halving) {
      const double middle = 0.5 * (low + high);
      (density(middle) < wanted ? low : high) = middle;
    }
    row.at_01[i] = high;
  }
  return row;
}

FogNodes place_nodes(const ViewGeometry& view, const glm::dvec2& size_px, std::span<const LampInFog> lamps,
                     std::size_t columns, std::size_t rows, double columns_of_peaks) {
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
  return {place_nodes(columns, {}, std::move(across), columns_of_peaks),
          place_nodes(rows, bands, std::move(down), kRowsOfPeaks)};
}

std::vector<double> places_of_pixels(const NodeRow& nodes, double first_px, double size_px) {
  std::vector<double> places;
  const double end_px = first_px + size_px;
  const auto weight_of_next = [&](double before, double at, double next) {
    const double straight = (at - before) / (next - before);
    const auto nearest = std::ranges::min_element(
        nodes.peaks, {}, [&](const NodePeak& peak) { return std::abs(0.5 * (before + next) - peak.at_01); });
    if (nearest == nodes.peaks.end() || (before < nearest->at_01 && nearest->at_01 < next)) return straight;
    const double whole = fall(*nearest, next) - fall(*nearest, before);
    return kFollowsFall * (fall(*nearest, at) - fall(*nearest, before)) / whole + (1.0 - kFollowsFall) * straight;
  };
  std::size_t node = 0;
  for (double px = 0.0; px < end_px; px += 1.0) {
    const double at_01 = std::clamp((px + 0.5 - first_px) / size_px, 0.0, 1.0);
    while (node + 2 < nodes.at_01.size() && nodes.at_01[node + 1] <= at_01) ++node;
    const double part = weight_of_next(nodes.at_01[node], at_01, nodes.at_01[node + 1]);
    places.push_back(static_cast<double>(node) + std::clamp(part, 0.0, 1.0 - 1e-4));
  }
  return places;
}

}  // namespace phare
