// A pixel light: light of a whole raster, whose every pixel a frame (a picture) dims.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// Shares of full light, row by row from the upper left pixel as a driver of the lamp sees them on a wall: 0 dark, 255
/// full, linear.
struct PixelFrame {
  std::size_t columns = 0, rows = 0;
  std::vector<std::uint8_t> shares;
};

/// Most pixels of a raster in one direction: what a device's images hold, less the dark rim.
inline constexpr std::size_t kMostPixelsAcross = 16'382;

/// PNG or PGM, colours as their luma. Error: no picture, or larger than a raster may be.
Result<PixelFrame> read_pixel_frame(const std::filesystem::path& file);

/// Where pixels shine: a distortion map. Knots on a grid of pixel columns and rows (0.5 is the middle of the first),
/// between them bilinear. [row][column].
struct PixelMap {
  std::vector<double> columns, rows;  ///< of the knots, ascending, from 0 to the raster's size
  std::vector<glm::dvec2> hv_deg;     ///< H right, V up, type A
};

/// CSV with the columns column, row, h_deg, v_deg: each knot of the grid once. Error with line: knots missing, doubled,
/// not from edge to edge of such a raster, or a map that folds over (H has to grow with columns, V to fall with rows).
Result<PixelMap> read_pixel_map(const std::filesystem::path& file, std::size_t columns, std::size_t rows);
/// A raster that fills these angles evenly.
PixelMap even_map(std::size_t columns, std::size_t rows, glm::dvec2 low_deg, glm::dvec2 high_deg);

/// I(H, V) = full(H, V) × share: at a pixel's middle its share, between middles bilinear, dark one pixel beyond the
/// outermost. Stored as a type A table with as many even nodes as the raster has pixels and a dark rim: what a
/// distortion map bends is looked up at these nodes, so its pixels keep their middles to half a node.
class PixelLight {
 public:
  /// Dark at first.
  PixelLight(const IntensityTable& full, const PixelMap& map, std::size_t columns, std::size_t rows);

  const IntensityTable& table() const { return table_; }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double flux_lm() const;  ///< by the midpoints of the nodes

  /// Brings the table to this frame, of the raster's size. Returns the rectangles of nodes that changed, some tens at
  /// the most. Only what differs from the frame before is looked at again.
  std::vector<TexelRect> show(const PixelFrame& frame);

 private:
  void reckon(const TexelRect& nodes);
  double share_at(double column, double row) const;

  std::size_t columns_, rows_;
  IntensityTable table_;
  std::vector<double> full_cd_;        ///< at the nodes
  std::vector<glm::vec2> pixel_;       ///< of a bent raster: column and row that a node shows, NaN: none
  std::vector<TexelRect> tile_shows_;  ///< of a bent raster: pixels that a tile of nodes shows
  std::vector<std::uint8_t> shares_;
  std::vector<double> row_cd_;  ///< sum of each row of nodes
};

}  // namespace phare
