// Luminous intensity of one photometry file over direction: float64, on the file's own grid. The truth of this program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "config/base/result.h"
#include "config/rig.h"

namespace phare {

/// IES LM-63 photometric types. A: polar axis vertical; B: polar axis horizontal; C: polar axis gamma = 0.
enum class PhotometricType { kA = 3, kB = 2, kC = 1 };

/// The two angles of a direction in a table's own convention, degrees.
/// Type A, B: first = H (right positive), second = V (up positive). Type C: first = C in [0, 360), second = gamma.
struct TableAngles {
  double first_deg = 0.0;
  double second_deg = 0.0;
};

/// What the file says about itself. What a format does not know stays empty or 0.
struct LampHeader {
  std::string format;           ///< "LM-63", "EULUMDAT", "TM-33", "CSV candela", "CSV goniometer", "CSV screen", "made"
  std::string units;            ///< of the luminaire's size: "feet", "metres", "millimetres"
  std::string symmetry;         ///< as stored, before it was unfolded: "none", "lateral", "quadrant", ...
  std::string tilt;             ///< LM-63: "NONE", "INCLUDE" or the file named
  std::string generation;       ///< LM-63-2019 field 12 in words
  bool absolute = true;         ///< candela as measured, not scaled to rated lamp lumens
  bool luminaire_flux = false;  ///< stated_flux_lm is of the luminaire; otherwise of its lamps, before losses
  double stated_flux_lm = 0.0;  ///< 0: the file states none
  double output_ratio = 0.0;    ///< EULUMDAT light output ratio of the luminaire, 0..1; 0: not stated
  double multiplier = 1.0;  ///< candela in the table = number in the file × multiplier × ballast factor × field 12
  double ballast_factor = 1.0;
  double field_12 = 1.0;  ///< as written; applied only where `field_12_applied`
  bool field_12_applied = false;
  double lamp_count = 1.0;
  double input_w = 0.0;
  double distance_m = 0.0;  ///< of a goniometer cell or screen that measured lux; 0: the file gives candela
  double width_m = 0.0;     ///< luminous opening as the format has it; negative: round (LM-63)
  double length_m = 0.0;
  double height_m = 0.0;
  double read_c0_deg = 0.0;  ///< --c0 and --mirror that the file was read with (visual/photometry/readers/read_lamp.h)
  bool read_mirrored = false;
  double smallest_step_cd = 0.0;  ///< one unit of the last digit written, in candela of the table
  std::vector<std::pair<std::string, std::string>> keywords;  ///< [KEY] value, in the file's order
};

/// Candela on a grid of the file's own angles, bilinear in these angles, dark outside their range (limits belong to
/// it).
struct IntensityTable {
  std::string name;          ///< file name, for messages
  std::string content_hash;  ///< of the file's bytes
  std::string version;       ///< "IESNA:LM-63-2002", ...
  PhotometricType type = PhotometricType::kA;
  GammaAxis axis = GammaAxis::kGamma0;  ///< only type C
  std::vector<double>
      first_deg;  ///< strictly ascending; symmetry of the file already unfolded, so H covers both sides, C 0..360
  std::vector<double> second_deg;  ///< strictly ascending
  std::vector<double> candela;     ///< [second][first]: candela[j * first_deg.size() + i]
  std::vector<std::string> notes;  ///< what was repaired while reading, with line
  /// > 0: measured on a flat screen x = distance. Then first = atan(-y/x), second = atan(z/x), and what is bilinear is
  /// the illuminance on the screen in its own y and z, not the candela in degrees. `type` is kA by name only.
  double screen_distance_m = 0.0;
  LampHeader header;

  /// Intensity in cd toward `direction` (any length > 0) in the lamp frame: x along the optical axis, y left, z up.
  double intensity_cd(const glm::dvec3& direction) const;
  /// Intensity at the table's own angles, degrees.
  double intensity_at_cd(TableAngles angles) const;
  /// Flux through the whole sphere, lm: exact integral of the bilinear table for type A, B and C.
  double flux_lm() const;
  double peak_cd() const;
  /// Node with the highest intensity; of equals the first, row by row from below and left.
  TableAngles peak_at() const;
  /// Angles of a direction (lamp frame) on this table's grid.
  TableAngles angles_of(const glm::dvec3& direction) const;
  /// Unit direction (lamp frame) of angles on this table's grid; the inverse of `angles_of`.
  glm::dvec3 direction_of(TableAngles angles) const;
};

/// Angles of a direction in a lamp frame (x axis, y left, z up). Drawn in the .cpp.
TableAngles table_angles(PhotometricType type, GammaAxis axis, const glm::dvec3& direction);

/// Unit direction in a lamp frame of the angles of a convention: the inverse of `table_angles`.
glm::dvec3 table_direction(PhotometricType type, GammaAxis axis, TableAngles angles);

/// Unit direction of azimuth H and elevation V in degrees: type A, and what the rules of headlamps mean by H and V.
glm::dvec3 direction_hv(double h_deg, double v_deg);

/// On a flat screen at distance 1 in a lamp frame: (1 + t² + u²)^1.5, candela of 1 lx at the tangents t and u, right
/// and up.
double screen_factor(double t, double u);
/// Unit direction of angles as a screen's table has them: first = atan(t), second = atan(u), degrees.
glm::dvec3 screen_direction(TableAngles angles);

/// Reads LM-63 alone (1986, 1991, 1995, 2002, 2019; types A, B, C); read_lamp.h finds the format by itself. The error
/// has file:line and reason.
Result<IntensityTable> read_lm63(const std::filesystem::path& file, GammaAxis axis = GammaAxis::kGamma0);

}  // namespace phare
