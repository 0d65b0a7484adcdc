// The beam image: what one lamp position shines, in candela, summed over its lit sources. What the GPU reads.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// One table at a lamp position, aimed and dimmed.
struct AimedSource {
  const IntensityTable* table = nullptr;
  glm::dmat3 car_from_lamp{1.0};  ///< columns: the lamp's forward, left, up in the car frame
  double scale = 1.0;             ///< multiplies candela; 0 = dark
  double colour_temperature_k = 5000.0;
  std::optional<glm::dvec2> chromaticity_xy{};  ///< CIE 1931; in place of the colour temperature
  bool changes = false;                         ///< the table is a pixel light's
};

/// R = Rz(yaw)·Ry(-pitch)·Rx(roll), columns forward, left, up of the lamp in the car. Angles as in SourceConfig.
glm::dmat3 aim_rotation(double yaw_rad, double pitch_rad, double roll_rad);

/// Do two sources have the angles of their tables in common: type, axis and aim? Flat screens share with one another,
/// at whatever distance: lux times the distance squared is bilinear in the tangents on each.
bool same_angles(const AimedSource& a, const AimedSource& b);

/// The grid of a beam image, and the frame of its angles in the car.
struct BeamGrid {
  PhotometricType type = PhotometricType::kA;
  GammaAxis axis = GammaAxis::kGamma0;
  double screen_distance_m = 0.0;  ///< > 0: the nodes lie on a flat screen, as those of IntensityTable (the first's)
  glm::dmat3 car_from_image{1.0};
  std::vector<double> first_deg;   ///< strictly ascending, at least 2
  std::vector<double> second_deg;  ///< strictly ascending, at least 2
  bool resampled = false;          ///< not all sources keep their nodes
};

/// Sources that share their angles keep them: the union of their nodes, on which the sum of bilinear tables is exact.
/// Others are resampled by direction onto a type A grid in the first source's aim. At least one source.
BeamGrid beam_grid(std::span<const AimedSource> sources);

/// Candela on such a grid, float32, with own bilinear weights in the nodes' angles (a flat screen: of
/// candela / screen_factor, in the nodes' tangents).
struct BeamImage : BeamGrid {
  std::vector<float> candela;  ///< [second][first]
  glm::vec3 colour{1.0f};      ///< linear sRGB of the light, luminance (Rec. 709) exactly 1; the mean where it differs
  /// Where lit sources differ in colour: candela times red and times blue of each light, summed, on the same nodes.
  /// Green follows from luminance. Empty while all light has `colour`.
  std::vector<glm::vec2> tints;
  bool dark = true;  ///< nothing lit: no need to draw
};

/// Composes the image of one lamp position. Sources may be empty (a dark image).
BeamImage compose_beam_image(std::span<const AimedSource> sources);

/// Linear sRGB of a black body at `temperature_k` (1667 K to 25000 K), luminance 1. Source: Kim et al. 2002 cubic
/// spline of the Planckian locus.
glm::vec3 black_body_colour(double temperature_k);

/// Share of illuminant A (2856 K) that a surface of linear sRGB reflectance sends back, by luminance: product of the
/// colours, not spectral. At least 1e-3, since figures are stated over it.
double reflectance_under_a(const glm::vec3& reflectance);

/// Linear sRGB of a CIE 1931 chromaticity, luminance 1. What lies outside sRGB loses its negative parts.
glm::vec3 chromaticity_colour(glm::dvec2 xy);

/// Of a source: its chromaticity if it has one, else that of its colour temperature.
glm::vec3 light_colour(const AimedSource& source);

}  // namespace phare
