// The most that a beam shines into a part of its view: a coarse bound from above, by which what stands in its last
// light casts no shadow in a map. Pure: no device.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare {

class LightPeaks {
 public:
  LightPeaks() = default;  ///< of a dark beam

  /// Where the nodes lie in the lamp's view is kept for the next image on the same ones.
  void set(const BeamImage& image);
  /// The same where only these rectangles of nodes have changed: what it then tells hangs on the image alone.
  void change(const BeamImage& image, std::span<const TexelRect> changed);

  /// False only if no direction between these tangents, to the left and up over the way forward of the image's frame,
  /// has more than `cd`. Beyond the tangents of shadow_casters.h: as at them.
  bool exceeds(const glm::vec2& least, const glm::vec2& most, float cd) const {
    return exceeds_in(cell_of(least), cell_of(most), cd);
  }
  /// Some above kWideShare of its brightest shines farther to the side than any map of shadows shows (kWidestShadow),
  /// or behind the lamp; or as far up or down as a map shows of other beams (kHighestShadow).
  bool is_wide() const { return wide_cd_ > kWideShare * peak_cd_; }
  bool is_high() const { return high_cd_ > kWideShare * peak_cd_; }
  /// Chosen: light that is weaker there is that of a lens's rim.
  static constexpr float kWideShare = 0.01f;
  /// The same by cells, worked out once a corner: they rise with tangents.
  static glm::vec2 cell_of(const glm::vec2& tangents);
  bool exceeds_in(const glm::vec2& least_cell, const glm::vec2& most_cell, float cd) const;

 private:
  /// Nodes of a table, both ends included, and the cells of the lamp's view in which their light may be, ends
  /// beyond: columns from the rightmost, rows from the lowest.
  struct Block {
    std::uint16_t column = 0, last_column = 0, row = 0, last_row = 0;
    std::uint8_t right = 0, left = 0, low = 0, high = 0;  ///< nothing between them: all of it is beside the lamp
    bool wide_beyond = false, high_beyond = false;        ///< some of it, as is_wide() and is_high() have it
    float most_cd = 0.0f;
  };
  void place_blocks(const BeamGrid& grid);
  static void read(const BeamImage& image, Block& block);
  void fill_cells();

  BeamGrid grid_;  ///< of the blocks
  std::vector<Block> blocks_;
  std::vector<float> most_cd_;  ///< row by row; empty: dark
  float peak_cd_ = 0.0f, wide_cd_ = 0.0f, high_cd_ = 0.0f;
};

}  // namespace phare
