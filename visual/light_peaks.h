// The most that a beam shines into a part of its view: a coarse bound from above, by which what stands in its last
// light casts no shadow in a map. Pure: no device.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare {

class LightPeaks {
 public:
  LightPeaks() = default;  ///< of a dark beam
  explicit LightPeaks(const BeamImage& image);

  /// When only these rectangles of nodes have changed; nowhere less than before.
  void raise(const BeamImage& image, std::span<const TexelRect> changed);

  /// False only if no direction between these tangents, to the left and up over the way forward of the image's frame,
  /// has more than `cd`. Beyond the tangents of shadow_casters.h: as at them.
  bool exceeds(const glm::vec2& least, const glm::vec2& most, float cd) const;

 private:
  static constexpr int kColumns = 64, kRows = 64;
  void raise(const BeamImage& image, const TexelRect& rect);
  std::vector<float> most_cd_;  ///< row by row from the lowest, in each from the rightmost; empty: dark
};

}  // namespace phare
