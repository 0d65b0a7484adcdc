// The white that the eye takes for white.
// Computes: the colour of the light it is adapted to, following the mean light of the lamps that shine, weighted by
//   flux; and from it the balance of the picture: gain = D/colour + (1 - D) in linear Rec. 709, the form of CIECAM02's
//   (CIE 159:2004) adaptation, with D65, to which the viewer of the display is adapted, as where none leads to.
// Source: time course: Rinner and Gegenfurtner 2000 (Vision Research 40, 1813; abstract): "more than 50 %" of what a
//   colour looks like follows faster than 10 ms, a part with a half-life of 40 to 70 ms, the rest with 20 s. Here 0.55
//   (chosen) for both fast parts together, which frames of 17 ms hardly tell apart, with 55 ms; 0.45 with 20 s. Degree:
//   D = F(1 - exp(-(L_A + 42)/92)/3.6) of CIECAM02, F 0.8 (dark surround), L_A 0.3 cd/m² (chosen; from 0 to 5 cd/m² D
//   changes from 0.659 to 0.667): 0.66.
// Frame: linear sRGB of luminance 1. Leaves out: what the scene reflects, where one looks, glare, rods; von Kries is
//   done on Rec. 709 and not on cones. All dark: nothing changes. Checked by tests/visual_process/adaptation_test.cpp.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "config/eye.h"
#include "net/sim_time.h"

namespace phare {

/// How far adaptation goes at this luminance of the scene, 0 to 1.
double degree_of_adaptation(double scene_cdm2);

/// Correlated colour temperature, K, of a linear sRGB colour: McCamy 1992; the display's black body, not the eye's.
double colour_temperature_k(const glm::vec3& colour);

class EyeAdaptation {
 public:
  EyeAdaptation() = default;
  /// Fixed: light of this colour temperature looks white.
  explicit EyeAdaptation(double fixed_k) : fixed_k_(fixed_k) {}

  /// `light`: of the lamps that shine now; nothing when all are dark. The first light finds the eye adapted to it. A
  /// time before the last one (a drive that begins anew) does too.
  void see(SimTime now, const std::optional<glm::vec3>& light);

  /// What exposure is divided by: this light looks white.
  glm::vec3 white() const;
  /// Colour temperature of what the eye is adapted to, before the degree of adaptation.
  double adapted_k() const;
  bool fixed() const { return fixed_k_.has_value(); }

  /// The state, to go on from in another process: numbers with all their digits.
  nlohmann::json json() const;
  /// Takes over a state. False (and nothing changed) when that is none.
  bool restore(const nlohmann::json& state);

 private:
  std::optional<double> fixed_k_;
  bool begun_ = false;
  SimTime seen_;
  glm::dvec3 fast_{1.0}, slow_{1.0};
};

/// An eye as it is set: fixed, or one that follows from here on.
inline EyeAdaptation eye_set(const EyeSetting& setting) {
  return setting.fixed_k ? EyeAdaptation(*setting.fixed_k) : EyeAdaptation();
}

}  // namespace phare
