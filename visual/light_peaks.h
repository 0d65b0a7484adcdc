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
  /// The same by cells, worked out once a corner: they rise with tangents.
  static glm::vec2 cell_of(const glm::vec2& tangents);
  bool exceeds_in(const glm::vec2& least_cell, const glm::vec2& most_cell, float cd) const;

 private:
  /// Nodes of a table, both ends included, and the cells of the lamp's view in which their light may be, ends
  /// beyond: columns from the rightmost, rows from the lowest.
  struct Block {
    std::uint16_t column = 0, last_column = 0, row = 0, last_row = 0;
    std::uint8_t right = 0, left = 0, low = 0, high = 0;
    float most_cd = 0.0f;
  };
  void place_blocks(const BeamGrid& grid);
  static void read(const BeamImage& image, Block& block);
  void fill_cells();

  BeamGrid grid_;  ///< of the blocks
  std::vector<Block> blocks_;
  std::vector<float> most_cd_;  ///< row by row; empty: dark
};

}  // namespace phare
