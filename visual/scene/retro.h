// Retroreflection: what markings, sheeting, reflectors and rough ground send back to where it came from.
// Computes: R_A of a sheeting over observation and entrance angle, R_L of a marking over observation angle.
//   R_A = L·cos(nu)/E_perp in cd/(lx·m²) (EN 12899-1, ASTM E808), R_L = L/E_perp in mcd/(lx·m²) (EN 1436): L is the
//   luminance toward the eye, E_perp the illuminance on a plane facing the lamp, nu the eye's angle from the normal.
//   Observation angle: lamp, surface, eye. Entrance angle: between the normal and the way to the lamp.
// Source: each class names its own. No standard was read here in its own text; what other texts did not confirm either
//   says so (`confirmed`), and docs/light.md lists it.
// RA1 and RA2 are as an Austrian ordinance prints them, whose types 1 and 2 they are.
// Leaves out: rotation of the sheeting, orientation of the two planes, rain, dirt, colour over angle.
// Checked by tests/scene/retro_test.cpp, tests/visual/retro_on_device_test.cpp.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// As in shaders/lamps.h.
/// A pupil is sheeting in its figures, but no surface of a picture: it is smaller than a pixel, so what it sends back
/// is drawn by a pass of its own (visual/eyeshine.h) and the lit pass knows it as a plain surface.
/// Grooves are no retroreflection of their own but a rough surface in place of a flat one; what they send beside what
/// Lambert's would goes the same way, and may be less than nothing.
enum class RetroKind : std::uint32_t { kNone = 0, kSheeting = 1, kMarking = 2, kFacets = 3, kPupil = 4, kGrooves = 5 };

/// What a class prescribes: the least R_L of a marking in the 30 m geometry (observation 1.05°, entrance 88.76°), or
/// the least R_A of a sheeting at some observation angles.
struct RetroClass {
  std::string name;
  RetroKind kind = RetroKind::kNone;
  double r_l_mcd_per_lx_m2 = 0.0;  ///< of a marking
  double wet_mcd_per_lx_m2 = 0.0;  ///< its R_L when wet: of classes measured wet or in rain, and of type II
  struct Row {
    double observation_deg = 0.0;              ///< one of kObservations_deg
    std::array<double, 4> r_a_cd_per_lx_m2{};  ///< at kEntrances_deg
  };
  std::vector<Row> rows{};
  std::string source;
  bool confirmed = true;      ///< found in at least one text that could be read
  bool whole_device = false;  ///< stated in mcd/lx of a whole reflector: R_A has to be given, the rows are its shape
};
inline constexpr std::array<double, 6> kObservations_deg{0.2, 0.33, 0.5, 1.0, 1.5, 2.0};
inline constexpr std::array<double, 4> kEntrances_deg{5.0, 20.0, 30.0, 40.0};

/// All classes that a material may name.
std::span<const RetroClass> retro_classes();

/// How a material sends light back.
struct Retroreflection {
  RetroKind kind = RetroKind::kNone;
  std::string class_name{};
  double r_l_mcd_per_lx_m2 = 0.0;  ///< in the 30 m geometry, all light together; facets: 0 as rho gives
  /// The same on wet ground, of classes measured wet or in rain and of type II; 0: ordinary beads, which keep what
  /// shaders/lib/wet.h leaves them.
  double wet_mcd_per_lx_m2 = 0.0;
  std::array<glm::vec4, kObservations_deg.size()>
      ln_r_a{};  ///< of sheeting: ln of cd/(lx·m²), [observation], xyzw entrance
  double roughness_rad = 0.0;  ///< of grooves: standard deviation of their slopes
};

/// By its class, or by a measured figure, or both: a class gives the shape over the angles, the figure then replaces
/// its own. R_A is that at (0.33°, 5°), R_L that in the 30 m geometry (of markings and facets); the wet R_L of a type
/// II changes with it. A figure alone has the shape of EN 12899-1 RA2 white. Error: no such class (naming the nearest),
/// or a figure of the other kind.
Result<Retroreflection> retroreflection(const std::string& class_name, std::optional<double> r_a_cd_per_lx_m2,
                                        std::optional<double> r_l_mcd_per_lx_m2);

/// The most that a material may state: what Oren and Nayar measured is below 40°.
inline constexpr double kRoughest_deg = 60.0;
/// A surface by Oren and Nayar (visual/photometry/table/surface_luminance.h) where Lambert's is flat; 0°: flat.
Retroreflection grooves(double roughness_deg);
/// Their terms as the shader has them (grooves_beside()), dry and wet. Of light between facets a colour counts once
/// more; that has one number here, by which the luminance is right in white light and the hue that of `reflectance`.
/// Water leaves as much of what they send beside Lambert's as of what facets do.
std::array<glm::vec4, 2> groove_terms(double roughness_rad, const glm::vec3& reflectance);

/// What is sent back beside diffuse rho/pi, luminance toward the eye over the illuminance on a plane facing the lamp in
/// cd/(lx·m²): of a marking in the 30 m geometry, of facets at a share of 1 (shaders/lib/retro.h). `rho`: as below.
double sent_back_strength(const Retroreflection& retro, double rho);

/// On wet ground: what a marking's sent_back_strength() keeps, so that with what its darker paint gives it has its wet
/// R_L in the 30 m geometry. Only of markings that have one.
double wet_share(const Retroreflection& marking, double rho);

/// Luminance toward the eye over the illuminance on a plane facing the lamp, cd/(lx·m²), of what is sent back beside
/// diffuse rho/pi, as the shader computes it. `rho`: reflectance_under_a() of the material. Unit vectors, of one frame;
/// the surface is seen from where `normal` points.
double sent_back_per_lx(const Retroreflection& retro, double rho, const glm::dvec3& to_lamp, const glm::dvec3& normal,
                        const glm::dvec3& to_eye);

/// R_A of a sheeting in cd/(lx·m²), as the shader computes it.
double sheeting_r_a(const Retroreflection& sheeting, double observation_deg, double entrance_deg);

}  // namespace phare
