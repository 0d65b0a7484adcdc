// Light of street lamps that walls, roof and road send on to each other where the sky does not reach: in our tunnel
// a sixth of the road's light and half of the vault's. Diffuse surfaces exchange it: what a patch sends is rho·E, and E
// is what lamps give it and what it sees of all others (radiosity; Goral, Torrance, Greenberg and Battaile, SIGGRAPH
// 1984, eq. 5), for a scene that stands once and for all.
//
// Covered surfaces (SceneMaterial::sky_share below 1) send light on; all others only hide it, and so do those with
// an emission_cdm2. It is received by whatever stands within kReflectedReach_m of them. Of a patch one number is
// kept, in the middle; patches are as long as the nearest lamp is far, 0.25 to 2 m, and of large scenes longer in
// proportion, so that there are 200,000 at most. How far that is off:
// docs/street-lamps.md. float64. Checked by tests/visual_process/reflected_light_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

#include "config/street_lamps.h"
#include "visual/scene/ray_tree.h"
#include "visual/scene/scene.h"

namespace phare {

inline constexpr std::uint32_t kReflectedWays = 128;
/// Farther from every covered surface nothing of it is received.
inline constexpr double kReflectedReach_m = 30.0;

class ReflectedLight {
 public:
  /// What lamps give a surface there, lx: linear Rec. 709 and photopic.
  using Direct = std::function<glm::dvec4(const glm::dvec3& point_m, const glm::dvec3& normal)>;

  ReflectedLight() = default;
  /// On all cores; the same however many. `times` kOff: nothing is reflected.
  ReflectedLight(const Scene& scene, Reflected times, const Direct& direct, const std::vector<glm::dvec3>& lamps_m);

  std::size_t patches() const { return sent_lx_.size(); }
  bool too_many() const { return too_many_; }  ///< so that nothing is reflected
  /// Any of it may be received there.
  bool reaches(const glm::dvec3& point_m) const;
  /// What falls on a surface, lx as of Direct, asked for along so many ways. `of_mesh`: as vertices keep it
  /// (FixedLight::at), of a point that something thin lies on, or that lies within something.
  glm::dvec4 at(const glm::dvec3& point_m, const glm::dvec3& normal, bool of_mesh = false,
                std::uint32_t ways = kReflectedWays) const;
  /// Calls arrives(unit direction that it comes from, lx facing it) for 128 ways, evenly over the sphere.
  void each_way(const glm::dvec3& point_m,
                const std::function<void(const glm::dvec3&, const glm::dvec4&)>& arrives) const;

 private:
  /// The patch that is seen along a unit direction; kNone: what sends nothing on.
  std::uint32_t seen(const glm::dvec3& from_m, const glm::dvec3& along, double leave_within_m) const;
  glm::dvec3 off_corners(const glm::dvec3& point_m, const glm::dvec3& normal) const;

  RayTree tree_;
  bool too_many_ = false;
  std::vector<std::uint32_t> patch_of_;                     ///< of the tree's triangles
  std::vector<glm::dvec4> sent_lx_;                         ///< rho·E of each patch
  std::vector<std::pair<glm::dvec3, glm::dvec3>> boxes_m_;  ///< corners of where it is received
};

}  // namespace phare
