// A beam image as the shaders read it. Where the nodes of both axes are multiples of a fine step near 0° and of a
// coarse one beyond, on that even grid: every node of the table is one of it, so bilinear interpolation on it is that
// of the table. Else on the native nodes, with a guide that finds the node of an angle in one fetch. A flat screen
// keeps its nodes too, by their tangents: evenly in metres, or through a guide. Cheaper levels lie on a fixed even grid
// and leave the weights to the texture filter.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "shaders/lamps.h"
#include "visual/photometry/beam_composer.h"
#include "visual/photometry/beam_image.h"
#include "visual/photometry/image_levels.h"

namespace phare {

/// For a texel of the packed image: the node of the beam image before it, and the way to the next, 0 to 1.
struct NodePlace {
  std::size_t node = 0;
  double part = 0.0;
};

/// One beam image packed for the GPU.
struct PackedBeam {
  ImageLevel level = ImageLevel::kFloatNodes;
  std::uint32_t lookup = shader::kLookupGuide;
  std::vector<float>
      candela;  ///< [second][first] of the shader's angles; on nodes one column and one row of zeros follow the last
  std::uint32_t columns = 0, rows_of_candela = 0;  ///< with the zeros
  float scale_cd = 1.0f;                           ///< candela of 1.0 in the texture
  std::vector<glm::vec4> guide;                    ///< of first, then of second; whole rows of kGuideRow
  glm::uvec4 guide_bins{0};  ///< bin where that of second begins; bins in 45° of first, of second
  float inverse_coarse = 1.0f;
  glm::vec4 nodes{0.0f}, coordinates{0.0f}, within{0.0f}, range{0.0f}, bins{0.0f};  ///< as in shaders/lamps.h
  glm::dmat3 rows{1.0};  ///< the axes of the image that the shader's rows a, b, c are: columns in the image frame
                         ///< (forward, left, up)
  glm::vec3 colour{1.0f};
  std::vector<glm::vec2> tints;  ///< candela times red and times blue, as `candela`; empty: all light has `colour`
  bool dark = true;
  // Where the texels come from, to pack a part again.
  bool transposed = false;
  std::vector<NodePlace> column_places, row_places;
  std::vector<double> column_tangents, row_tangents;  ///< of a flat screen's nodes; else empty

  bool filtered() const { return lookup >= shader::kLookupFilter; }
  bool tinted() const { return !tints.empty(); }
  /// What a texel of colour is multiplied by. Half floats leave room for the bluest light there is: 1/0.0722 of its
  /// luminance.
  float tint_scale() const { return level == ImageLevel::kFloatNodes ? 1.0f : 16.0f * scale_cd; }
  /// The four bits of this lamp in the shader's `lookups`: kind, and whether candela have to be scaled.
  std::uint32_t lookup_bits() const { return lookup | (scale_cd != 1.0f && !filtered() ? shader::kLookupScaled : 0u); }
  bool guided() const { return lookup == shader::kLookupGuide || lookup == shader::kLookupScreenGuide; }
  /// What the texture takes.
  std::size_t bytes_per_texel() const {
    return level == ImageLevel::kFloatNodes ? 4 : level == ImageLevel::kNormalised8 ? 1 : 2;
  }
};

/// An even grid has at most 4096 nodes a side and 4 M in all. Guides hold at most one node a bin, so bins are as narrow
/// as the closest nodes; at most 8192 in 45°: nodes closer than 0.0055° make the guide inexact there by less than one
/// such bin. kNormalised8 is scaled by the image's peak, half floats by a thousandth of it where it lies above 60,000
/// cd.
PackedBeam pack_beam(const BeamImage& image, ImageLevel level = ImageLevel::kFloatNodes);

/// Packs again the part that `changed` (columns and rows of the image) reaches; the image has the nodes it had. Returns
/// the part, in texels of the packed image. A peak that rose above what the level can hold needs a new pack_beam: then
/// the whole image is returned, packed anew.
TexelRect pack_again(PackedBeam& packed, const BeamImage& image, const TexelRect& changed);

/// The texels of a part as the texture holds them, row by row.
std::vector<std::byte> texels_of(const PackedBeam& packed, const TexelRect& part);
/// The same of its colour: two float32 a texel, two half floats at the cheaper levels.
std::vector<std::byte> tint_texels_of(const PackedBeam& packed, const TexelRect& part);

}  // namespace phare
