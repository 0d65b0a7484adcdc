// The light of a pair of lamps as HSPR looks it up. Departures of the method from physics stand at their place.
#include "visual/photometry/bench/hspr_light.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kWindowColumn_m = 0.01, kWindowRow_m = 0.0138;  // one sample of the glare window
constexpr double kWindowTop_m = 1.613, kWindow_m = 50.0;         // centre of its highest row; its distance
constexpr int kWindowRows = 50;

/// Where an angle lies on the grid, in steps from its first node; beyond the grid: on its edge.
double place(double deg, double limit_deg, std::size_t count) {
  return std::clamp((deg + limit_deg) / HsprGrid::kStep_deg, 0.0, static_cast<double>(count - 1));
}

/// Σ over the method's samples of their bilinear weights on each node. Samples every 0.01° from `low` to `high`, ends
/// included, each looked up `shift` further on; those that leave the grid have no light.
std::vector<double> sample_weights(double low_deg, double high_deg, double shift_deg, double limit_deg,
                                   std::size_t count) {
  std::vector<double> weights(count, 0.0);
  const auto samples = static_cast<int>(std::lround((high_deg - low_deg) * 100.0));
  for (int k = 0; k <= samples; ++k) {
    const double at = (low_deg + 0.01 * k + shift_deg + limit_deg) / HsprGrid::kStep_deg;
    constexpr double kRounding = 1e-9;  // of a step: the grid's own ends are on it
    if (at < -kRounding || at > static_cast<double>(count - 1) + kRounding) continue;
    const double on = std::clamp(at, 0.0, static_cast<double>(count - 1));
    const auto node = std::min(static_cast<std::size_t>(on), count - 2);
    weights[node] += 1.0 - (on - static_cast<double>(node));
    weights[node + 1] += on - static_cast<double>(node);
  }
  return weights;
}

bool same_light(const IntensityTable& a, const IntensityTable& b) {
  return &a == &b || (a.type == b.type && a.axis == b.axis && a.screen_distance_m == b.screen_distance_m &&
                      a.first_deg == b.first_deg && a.second_deg == b.second_deg && a.candela == b.candela);
}

}  // namespace

HsprGrid::HsprGrid(const HsprLamp& lamp) {
  candela_.reserve(kColumns * kRows);
  const IntensityTable& table = *lamp.table;
  const bool own_angles = table.type == PhotometricType::kA && table.screen_distance_m <= 0.0 && lamp.aim_up_deg == 0.0;
  const glm::dmat3 car_from_lamp = aim_rotation(0.0, glm::radians(lamp.aim_up_deg), 0.0);
  for (std::size_t j = 0; j < kRows; ++j) {
    // Nodes as multiples of 0.05, so that they meet those of a file with such steps.
    const double v = (static_cast<double>(j) - 300.0) / 20.0;
    for (std::size_t i = 0; i < kColumns; ++i) {
      const double h = (static_cast<double>(i) - 900.0) / 20.0;
      candela_.push_back(own_angles ? table.intensity_at_cd({h, v})
                                    : table.intensity_cd(direction_hv(h, v) * car_from_lamp));
    }
  }
}

double HsprGrid::nearest_cd(double h_deg, double v_deg) const {
  return at(static_cast<std::size_t>(std::lround(place(h_deg, kWide_deg, kColumns))),
            static_cast<std::size_t>(std::lround(place(v_deg, kHigh_deg, kRows))));
}

double HsprGrid::bilinear_cd(double h_deg, double v_deg) const {
  const double x = place(h_deg, kWide_deg, kColumns), y = place(v_deg, kHigh_deg, kRows);
  const std::size_t i = std::min(static_cast<std::size_t>(x), kColumns - 2),
                    j = std::min(static_cast<std::size_t>(y), kRows - 2);
  const double s = x - static_cast<double>(i), t = y - static_cast<double>(j);
  return (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i + 1, j)) + t * ((1.0 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

HsprLight::HsprLight(std::span<const HsprLamp> lamps) : lamps_(lamps.begin(), lamps.end()) {
  for (const HsprLamp& lamp : lamps_) {
    const auto same = std::find_if(
        lamps_.begin(), lamps_.begin() + static_cast<std::ptrdiff_t>(grids_.size()), [&](const HsprLamp& other) {
          return other.aim_up_deg == lamp.aim_up_deg && same_light(*other.table, *lamp.table);
        });
    const auto before = static_cast<std::size_t>(same - lamps_.begin());
    grids_.push_back(before < grids_.size() ? grids_[before] : std::make_shared<const HsprGrid>(lamp));
  }
}

double HsprLight::spacing_m() const {
  double low = 0.0, high = 0.0;
  for (const HsprLamp& lamp : lamps_) {
    low = std::min(low, lamp.x_m);
    high = std::max(high, lamp.x_m);
  }
  return high - low;
}

double HsprLight::physical_cd(std::size_t lamp, double dx, double dy, double dz) const {
  // Ours: ahead, left, up.
  return lamps_[lamp].table->intensity_cd(glm::dvec3{dz, -dx, dy} *
                                          aim_rotation(0.0, glm::radians(lamps_[lamp].aim_up_deg), 0.0));
}

double HsprLight::lux(HsprView view, double x_m, double y_m, double z_m) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < lamps_.size() && z_m > 0.0; ++k) {
    const double dx = x_m - lamps_[k].x_m, dy = y_m - lamps_[k].y_m;
    const double q = std::sqrt(dx * dx + z_m * z_m), d2 = q * q + dy * dy;
    const double cd = view == HsprView::kPhysical
                          ? physical_cd(k, dx, dy, z_m)
                          : grids_[k]->nearest_cd(std::atan(dx / z_m) * kDegrees, std::atan(dy / q) * kDegrees);
    sum += cd * z_m / (d2 * std::sqrt(d2));
  }
  return sum;
}

double HsprLight::flux_lm(HsprView view, double v_low_deg, double v_high_deg, double shift_at_m) const {
  double sum = 0.0;
  if (view == HsprView::kPhysical) {
    // The grid is bilinear in H and V: its flux is exact, cosine of V included.
    const auto row_of = [](double v) { return static_cast<std::size_t>(std::lround(v * 20.0) + 300); };
    for (const auto& grid_of : grids_) {
      const HsprGrid& grid = *grid_of;
      IntensityTable window;
      for (std::size_t i = 0; i < HsprGrid::kColumns; ++i)
        window.first_deg.push_back((static_cast<double>(i) - 900.0) / 20.0);
      for (std::size_t j = row_of(v_low_deg); j <= row_of(v_high_deg); ++j) {
        window.second_deg.push_back((static_cast<double>(j) - 300.0) / 20.0);
        for (std::size_t i = 0; i < HsprGrid::kColumns; ++i) window.candela.push_back(grid.at(i, j));
      }
      sum += window.flux_lm();
    }
    return sum;
  }
  const double tan_step = std::tan(0.01 / kDegrees);
  const std::vector<double> rows = sample_weights(v_low_deg, v_high_deg, 0.0, HsprGrid::kHigh_deg, HsprGrid::kRows);
  for (std::size_t k = 0; k < lamps_.size(); ++k) {
    const double shift_deg = -std::atan(lamps_[k].x_m / shift_at_m) * kDegrees;  // the left lamp's moves to the left
    const std::vector<double> columns =
        sample_weights(-HsprGrid::kWide_deg, HsprGrid::kWide_deg, shift_deg, HsprGrid::kWide_deg, HsprGrid::kColumns);
    for (std::size_t j = 0; j < HsprGrid::kRows; ++j) {
      if (rows[j] == 0.0) continue;
      double row = 0.0;
      for (std::size_t i = 0; i < HsprGrid::kColumns; ++i) row += columns[i] * grids_[k]->at(i, j);
      sum += rows[j] * row;
    }
  }
  return sum * tan_step * tan_step;
}

std::vector<double> HsprLight::glare_lm(HsprView view, std::span<const HsprStrip> strips,
                                        const std::function<double(int row, int column)>& weight) const {
  std::vector<double> result(lamps_.size(), 0.0);
  const bool method = view == HsprView::kMethod;
  for (std::size_t k = 0; k < lamps_.size(); ++k) {
    for (const HsprStrip& strip : strips) {
      for (int column = 0; column < strip.columns; ++column) {
        const double dx = strip.x_m + kWindowColumn_m * (column + 0.5) - lamps_[k].x_m;
        const double z =
            method ? kWindow_m + (strip.z_end_m - kWindow_m) * column / std::max(strip.columns - 1, 1) : kWindow_m;
        for (int row = 0; row < kWindowRows; ++row) {
          const double dy = kWindowTop_m - kWindowRow_m * row - lamps_[k].y_m;
          const double q = std::sqrt(dx * dx + z * z), d2 = q * q + dy * dy;
          const double cd = method ? grids_[k]->bilinear_cd(std::atan(dx / z) * kDegrees, std::atan(dy / q) * kDegrees)
                                   : physical_cd(k, dx, dy, z);
          const double cosine = method ? 1.0 : z / std::sqrt(d2);
          result[k] += strip.factor * weight(row, column) * cd * cosine * kWindowColumn_m * kWindowRow_m / d2;
        }
      }
    }
  }
  return result;
}

double HsprLight::brightest_cd(std::size_t lamp, double h_from_deg, double h_to_deg, double v_deg) const {
  double brightest = 0.0;
  for (int i = 0; i <= 100; ++i)
    brightest = std::max(brightest, grids_[lamp]->bilinear_cd(h_from_deg + (h_to_deg - h_from_deg) * i / 100.0, v_deg));
  return brightest;
}

std::optional<double> hspr_walk_in(double from, double step, double threshold_lx,
                                   const std::function<double(double)>& lux_at) {
  for (int i = 0;; ++i) {
    const double at = from - step * i;
    if (at <= 1e-9 * step) return std::nullopt;
    if (lux_at(at) > threshold_lx) return at;
  }
}

std::optional<double> hspr_reach(HsprView view, double from, double step, double threshold_lx,
                                 const std::function<double(double)>& lux_at) {
  const auto walked = hspr_walk_in(from, step, threshold_lx, lux_at);
  if (view == HsprView::kMethod || !walked || *walked >= from) return walked;
  double lit = *walked, dark = lit + step;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (lit + dark);
    (lux_at(middle) > threshold_lx ? lit : dark) = middle;
  }
  return lit;
}

}  // namespace phare
