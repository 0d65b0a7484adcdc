// Luminous intensity of one photometry file over direction: float64, on the file's own grid. The truth of this program.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "config/result.h"
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

/// Candela on a grid of the file's own angles, bilinear in these angles, dark outside their range (limits belong to it).
struct IntensityTable {
  std::string name;          ///< file name, for messages
  std::string content_hash;  ///< of the file's bytes
  std::string version;       ///< "IESNA:LM-63-2002", ...
  PhotometricType type = PhotometricType::kA;
  GammaAxis axis = GammaAxis::kGamma0;  ///< only type C
  std::vector<double> first_deg;        ///< strictly ascending; symmetry of the file already unfolded, so H covers both sides, C 0..360
  std::vector<double> second_deg;       ///< strictly ascending
  std::vector<double> candela;          ///< [second][first]: candela[j * first_deg.size() + i]
  std::vector<std::string> notes;       ///< what was repaired while reading, with line

  /// Intensity in cd toward `direction` (any length > 0) in the lamp frame: x along the optical axis, y left, z up.
  double intensity_cd(const glm::dvec3& direction) const;
  /// Intensity at the table's own angles, degrees.
  double intensity_at_cd(TableAngles angles) const;
  /// Flux through the whole sphere, lm: exact integral of the bilinear table for type A, B and C.
  double flux_lm() const;
  double peak_cd() const;
};

/// Angles of a direction in a lamp frame (x axis, y left, z up). Drawn in the .cpp.
TableAngles table_angles(PhotometricType type, GammaAxis axis, const glm::dvec3& direction);

/// Reads LM-63 (1986, 1991, 1995, 2002, 2019; types A, B, C; TILT=NONE or INCLUDE). The error has file:line and reason.
Result<IntensityTable> read_lm63(const std::filesystem::path& file, GammaAxis axis = GammaAxis::kGamma0);

}  // namespace phare
