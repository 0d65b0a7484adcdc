// A beam image as the shaders read it: cells of four nodes each, one fetch a look-up. Where the nodes of both axes are
// multiples of a step (a fine one near 0° and a coarse one beyond; or from a phase), on that even grid: every node of
// the table is one of it, so bilinear interpolation on it is that of the table. Nodes that were even before they were
// rounded to decimals lie on the even grid, with the values that their cells' bilinear functions have there; nodes that
// are even but for rounding of another kind keep their true places in a guide, an entry a node; any others are found
// through a guide of bins.
// A flat screen keeps its nodes too, by their tangents: evenly in metres, or through a guide. Cheaper levels lie on a
// fixed even grid and leave the weights to the texture filter.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "shaders/lamps.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/beam/image_levels.h"

namespace phare {

/// For a texel of the packed image: the node of the beam image before it, and the way to the next, 0 to 1.
struct NodePlace {
  std::size_t node = 0;
  double part = 0.0;
};

/// One beam image packed for the GPU.
struct PackedBeam {
  ImageLevel level = ImageLevel::kFloatNodes;
  shader::TableShape shape{};
  std::vector<float> candela;  ///< of nodes, [second][first] of the shader's angles
  std::uint32_t columns = 0, rows_of_candela = 0;
  float scale_cd = 1.0f;         ///< candela of 1.0 in the texture
  std::vector<glm::vec4> guide;  ///< of first, then of second; as shaders/lib/beam.glsl reads it
  glm::dmat3 rows{1.0};  ///< the axes of the image that the shader's rows a, b, c are: columns in the image frame
                         ///< (forward, left, up)
  glm::vec3 colour{1.0f};
  std::vector<glm::vec2> tints;  ///< candela times red and times blue, as `candela`; empty: all light has `colour`
  bool dark = true;
  // Where the texels come from, to pack a part again.
  bool transposed = false;
  std::vector<NodePlace> column_places, row_places;
  std::vector<glm::dvec2> column_corners, row_corners;  ///< of nodes rounded to decimals, of each cell; else empty
  std::vector<double> column_tangents, row_tangents;  ///< of a flat screen's nodes; else empty

  std::uint32_t lookup() const { return shape.lookup & shader::kLookupKind; }
  bool filtered() const { return lookup() >= shader::kLookupFilter; }
  bool tinted() const { return !tints.empty(); }
  /// What a texel of colour is multiplied by. Half floats leave room for the bluest light there is: 1/0.0722 of its
  /// luminance.
  float tint_scale() const { return level == ImageLevel::kFloatNodes ? 1.0f : 16.0f * scale_cd; }
  bool guided() const { return !guide.empty(); }
  /// Texels of the table on the device: cells, or of a filter's image what it has nodes.
  std::size_t texels() const {
    return filtered() ? std::size_t{columns} * rows_of_candela : std::size_t{columns + 1} * (rows_of_candela + 1);
  }
  /// What one of them takes.
  std::size_t bytes_per_texel() const {
    return level == ImageLevel::kFloatNodes  ? 16
           : level == ImageLevel::kHalfNodes ? 8
           : level == ImageLevel::kHalfEven  ? 2
                                             : 1;
  }
};

/// The same table by the lookup that serves most: pipelines with that in place of the table's own take the shape from
/// the frame, so that tables of many shapes are of one. What they find is the same.
shader::TableShape for_any_light(shader::TableShape shape);
shader::GpuShape shape_in_frame(const shader::TableShape& shape);

/// An even grid has at most 1 M cells, and 8 for each node of the table unless it is small. Guides of bins hold at most
/// one node a bin, so bins are as narrow as the closest nodes; at most 8192 in 45°: nodes closer than 0.0055° make the
/// guide inexact there by less than one such bin. kNormalised8 is scaled by the image's peak, half floats by a
/// thousandth of it where it lies above 60,000 cd.
PackedBeam pack_beam(const BeamImage& image, ImageLevel level = ImageLevel::kFloatNodes);

/// Packs again the part that `changed` (columns and rows of the image) reaches; the image has the nodes it had. Returns
/// the part, in texels of the packed image. A peak that rose above what the level can hold needs a new pack_beam: then
/// the whole image is returned, packed anew.
TexelRect pack_again(PackedBeam& packed, const BeamImage& image, const TexelRect& changed);

/// The texels that a part of the nodes stands in: of a filter's image that part, else the cells about it, one more to
/// the left and below (cells are counted from the one before node 0).
TexelRect texels_about(const PackedBeam& packed, const TexelRect& nodes);
/// Texels as the device holds them, row by row.
std::vector<std::byte> texels_of(const PackedBeam& packed, const TexelRect& texels);
/// The same of its colour: red and blue, of a cell as two texels (four reds, four blues).
std::vector<std::byte> tint_texels_of(const PackedBeam& packed, const TexelRect& texels);

}  // namespace phare
