// The road as two wheel tracks along a path: profile files, random roughness, bumps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/base/two.h"

namespace phare {

/// Roughness classes of ISO 8608:2016 by their geometric mean Gd(n0) at n0 = 0.1 cycles/m: 16, 64, … 1024·4 e-6 m3.
enum class RoughnessClass { kA, kB, kC, kD, kE };

/// A raised cosine h/2 (1 - cos 2 pi s/l), or with ramps of no length a step up or a plateau.
struct Bump {
  enum class Shape { kCosine, kStep, kTrapezoid };
  Shape shape = Shape::kCosine;
  double start_m = 0.0;   ///< along the path
  double height_m = 0.0;  ///< < 0: a hole
  double length_m = 0.0;  ///< kStep: endless; kTrapezoid: whole, with ramps of 0.3 m
  bool left = true, right = true;
};

/// Heights of a left and a right wheel track over the distance along the path, on an even grid, C1 between (cubic
/// through four neighbours: kinks would excite wheel hop). Before and after a profile its end heights go on, level;
/// random roughness repeats.
class HeightProfile {
 public:
  struct Sample {
    double z_m = 0.0;
    double slope = 0.0;  ///< dz/ds
  };

  /// CSV with columns x_m, z_m or x_m, z_left_m, z_right_m (also without _m), x rising. Errors name file and line.
  static Result<HeightProfile> read(const std::filesystem::path& csv_file);

  /// Random roughness: sum of sines n = 0.011 to 2.83 cycles/m with random phases from `seed`, spectrum Gd(n0)
  /// (n/n0)^-2, coherence of the tracks exp(-2.8 n) (track 1.4 m). The same for the same seed everywhere.
  static HeightProfile iso8608(RoughnessClass roughness, std::uint64_t seed, double length_m = 1000.0);

  /// Bumps on an even road, on a grid of 5 mm.
  static HeightProfile bumps(const std::vector<Bump>& bumps);

  /// What a tyre of that contact length makes of it: moving average. A tyre swallows edges shorter than its patch.
  void smooth(double contact_length_m);

  bool empty() const { return grid_.empty(); }
  double start_m() const { return start_m_; }
  double end_m() const { return start_m_ + spacing_m_ * static_cast<double>(empty() ? 0 : points() - 1); }

  /// No allocation, tens of nanoseconds. Not finite: height and slope 0.
  Sample at(double s_m, bool left) const;

  /// The same for the left and the right track at once.
  struct Pair {
    Two z_m{}, slope{};
  };
  Pair across(double s_m) const;

 private:
  std::int64_t points() const { return static_cast<std::int64_t>(grid_.size()) - kMargin; }
  struct Point {  // of the grid
    Two z_m{};    // left and right
  };
  Two& point(std::int64_t i) { return grid_[static_cast<std::size_t>(i + 1)].z_m; }
  void fill_margin();

  // The grid interval that a place lies in: `four` are the points around it, u the share of it that is passed.
  struct Cell {
    const Point* four = nullptr;  // nullptr: nowhere
    double u = 0.0;
    bool beyond = false;  // before the first or after the last point
  };
  Cell cell(double s_m) const;

  static constexpr std::int64_t kMargin =
      3;  // one point before and two after the grid: every place has four neighbours

  double start_m_ = 0.0, spacing_m_ = 1.0, per_spacing_ = 1.0, per_count_ = 1.0;
  bool repeats_ = false;
  std::vector<Point> grid_;  // with the margin
};

// Inline, as the road is asked eight times a step.
inline HeightProfile::Cell HeightProfile::cell(double s_m) const {
  const std::int64_t count = points();
  double place = (s_m - start_m_) * per_spacing_;
  // Written so that NaN fails.
  if (count < 2 || !(std::abs(place) < 1e15)) return {};
  if (repeats_) {
    // By truncation: floor() is a call where the processor's own is not assumed.
    place -= static_cast<double>(static_cast<std::int64_t>(place * per_count_)) * static_cast<double>(count);
    if (place < 0.0) place += static_cast<double>(count);
  } else if (place <= 0.0) {
    return {grid_.data(), 0.0, true};
  } else if (place >= static_cast<double>(count - 1)) {
    return {grid_.data() + (count - 1), 0.0, true};
  }
  const auto i = std::min(static_cast<std::int64_t>(place), count - 1);
  return {grid_.data() + i, place - static_cast<double>(i)};
}

// Catmull and Rom 1974: the cubic with the slopes of the neighbours' chords.
inline HeightProfile::Pair HeightProfile::across(double s_m) const {
  const Cell c = cell(s_m);
  if (!c.four) return {};
  const Two z0 = c.four[0].z_m, z1 = c.four[1].z_m, z2 = c.four[2].z_m, z3 = c.four[3].z_m;
  const Two d1 = z1 - z0, d2 = z2 - z1, d3 = z3 - z2;
  const Two slope_b = 0.5 * (d1 + d2), c3 = 0.5 * (d1 + d3) - d2, c2 = d2 - slope_b - c3;
  const Two slope = (slope_b + c.u * (c2 + c2 + 3.0 * c.u * c3)) * per_spacing_;
  return {z1 + c.u * (slope_b + c.u * (c2 + c.u * c3)), c.beyond ? Two{} : slope};
}

inline HeightProfile::Sample HeightProfile::at(double s_m, bool left) const {
  const Pair pair = across(s_m);
  return {pair.z_m[left ? 0 : 1], pair.slope[left ? 0 : 1]};
}

/// "A" to "E".
Result<RoughnessClass> parse_roughness(const std::string& text, const std::string& place);

/// Gd(n0), m3.
double roughness_gd_m3(RoughnessClass roughness);

}  // namespace phare
