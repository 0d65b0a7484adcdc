// The road as two wheel tracks along a path: profile files, random roughness, bumps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/result.h"

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
/// through four neighbours: kinks would excite wheel hop). Before and after a profile its end heights go on; random
/// roughness repeats.
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

  bool empty() const { return left_.empty(); }
  double start_m() const { return start_m_; }
  double end_m() const { return start_m_ + spacing_m_ * static_cast<double>(left_.empty() ? 0 : left_.size() - 1); }

  /// No allocation, tens of nanoseconds. Not finite: height and slope 0.
  Sample at(double s_m, bool left) const;

 private:
  std::int64_t points() const { return static_cast<std::int64_t>(left_.size()); }

  double start_m_ = 0.0, spacing_m_ = 1.0, per_spacing_ = 1.0, per_count_ = 1.0;
  bool repeats_ = false;
  std::vector<double> left_, right_;
};

/// "A" to "E".
Result<RoughnessClass> parse_roughness(const std::string& text, const std::string& place);

/// Gd(n0), m3.
double roughness_gd_m3(RoughnessClass roughness);

}  // namespace phare
