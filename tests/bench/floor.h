// The floor of a frame: the bare light integral of two headlamps on a level road, by hand for AVX2 and all cores. No
// geometry, no depth, no surface: what is left when a program does nothing but the physics, so the unit that frame
// times are quoted in.
#pragma once

#include <cstdint>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare::bench {

/// Illuminance of two lamps 0.65 m above a level road, E = I·cos(q)/r² (Lecocq et al. 1999), the beam looked up by
/// bilinear interpolation in a plane of tangents (right/ahead, up/ahead) so that no angle is computed; then exposure,
/// tone curve and 8 bits a channel.
class Floor {
 public:
  /// `beam`: looked up in 1024 × 512 tangents, right ±1 and up ±0.5.
  Floor(const IntensityTable& beam, int width_px, int height_px);

  /// The processor has AVX2 and FMA; without, there is no floor to compare with.
  static bool possible();

  /// One frame of a car whose lamps are `x_m` along the road, on all cores. The width is a multiple of 8.
  void draw(float x_m);
  /// Illuminance of a row of that frame, lx, one value a pixel.
  std::vector<float> illuminance_lx(float x_m, int row);

  const std::vector<std::uint32_t>& rgba() const { return rgba_; }

 private:
  void draw_row(float x_m, int row, float* lx);

  int width_px_, height_px_;
  std::vector<float> tangents_cd_;  // [up][right]
  std::vector<std::uint32_t> rgba_;
};

}  // namespace phare::bench
