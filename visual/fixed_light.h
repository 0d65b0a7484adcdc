// Light that does not change while one drives: street lamps by their own photometry files, the moon, and surfaces that
// shine by themselves. It falls on a scene that stands, so it is computed once, in float64, when the scene is loaded,
// and kept at the vertices of meshes that are cut as finely as the light asks for, such that what lies between them is
// nearest to it (visual/fixed_light_fit.h). A frame then pays for one interpolated number, however many lamps there
// are.
//
// Lamps of a glTF file (KHR_lights_punctual, EXT_lights_ies) are among them: point and spot by candela, the spot's cone
// by the extension's own formula, directional ones by lux, as the moon.
//
// E = Σ I(C, gamma)·cos/r² with the shadows of what stands, as everywhere (README.md). A lamp whose file states the
// size of its opening is hidden in part, with the share of it that a point does not see; one without is a point. Left
// out: lamps beyond kReach_m or of less than kLeast_lx at a point; light that has been reflected before, but where the
// sky does not reach (visual/reflected_light.h); shadows of what moves; retroreflection (nobody looks from a street
// lamp). Surfaces under lamps above the road are Lambert's, but for asphalt: its vertices keep what an r-table makes of
// the lamps for an eye from anywhere (FixedRoad). What moves is lit by how much light arrives at its middle and from
// where (Probe): 25 % of a lamp off at worst. How far interpolation is off: docs/street-lamps.md. Checked by
// tests/visual_process/street_lamps_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/rig.h"
#include "config/street_lamps.h"
#include "visual/glare.h"
#include "visual/photometry/table/intensity_table.h"
#include "visual/photometry/table/opening.h"
#include "visual/photometry/table/road_lobes.h"
#include "visual/reflected_light.h"
#include "visual/scene/far_mesh.h"
#include "visual/scene/ray_tree.h"
#include "visual/scene/scene.h"

namespace phare {

/// A street lamp farther away lights nothing: at 200 m one of 3000 cd gives a level road 0.003 lx.
inline constexpr double kStreetLampReach_m = 200.0;
/// What one lamp gives a point less of is left out: a thousandth of the least that roads are lit with (EN 13201 P6).
inline constexpr double kLeastOfLamp_lx = 0.002;
/// A lamp's own housing and pole, within this of its light, hide nothing.
inline constexpr double kOwnHousing_m = 0.6;
/// How many rays go to places of a lamp's opening. An edge along or across a rectangle is off by an eighth at most, and
/// by 0.15 where it comes in on the side from which the first three are farthest.
inline constexpr std::uint32_t kOpeningRays = 8;
/// What gives a point less is seen or hidden as its middle is. Chosen: at 0.05 lx the town takes twice as long to load.
inline constexpr double kLeastOfOpening_lx = 0.3;

/// What a vertex keeps.
struct FixedVertex {
  glm::vec4 light{0.0f};   ///< rgb: lx, linear Rec. 709, with what the surface itself sends out times pi/rho; w: lx
  float sky_share = 1.0f;  ///< of the sky's light
};

/// What a vertex of asphalt keeps besides: luminance by an r-table over that of a diffuse surface, of the way of sight
/// along the ground (shaders/lib/road.h). Of the shader::kRoadStreaks lamps whose streaks are the brightest each by
/// itself, of all others the even part and the first harmonic of theirs. As if all light had the colour of their sum.
struct FixedRoad {
  std::array<std::uint32_t, 12> halves{};  ///< pairs of half floats
};

/// What a vertex of a relief keeps besides: whence its light comes, Σ E·l over what falls on the surface, E of each
/// lamp facing it and l its direction. Light on a facet n is that times dot(n, way), whatever the lamps, as long as
/// none of them is below the facet. 0 where the relief does not turn it: surfaces lit from both sides, or that shine.
using FixedWay = glm::vec3;

/// A mesh as it is drawn: cut where its light asks for it.
struct FixedMesh {
  std::vector<SceneVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<FixedVertex> light;
  std::vector<CornerLook> looks{};  ///< one for each vertex, where the chunk has them
  std::vector<FixedRoad> road{};    ///< the same, where the chunk is of asphalt
  std::vector<FixedWay> ways{};     ///< the same, where it has a relief
  std::vector<glm::dvec4> reflected_lx{};  ///< the same while light is fitted, where any is reflected: part of `light`
};

/// What arrives at a place, for what moves: on a surface with normal n, lx·max(0, 1/4 + dot(way, n)).
struct FixedProbe {
  glm::vec4 light{0.0f};  ///< as of FixedVertex, on a surface that faces each lamp
  glm::vec3 way{0.0f};    ///< half the mean direction that it comes from
  float sky_share = 1.0f;
};

/// How finely meshes are cut: where the middle of a side is off by more than `tolerance` of its light, down to the
/// least edge; that is of lamps 8 m away, and near by of nearer lamps shorter in that proportion.
struct BakeLevel {
  double tolerance, least_edge_m;
};
inline constexpr std::array<BakeLevel, 3> kBakeLevels{{{0.10, 3.0}, {0.05, 1.5}, {0.02, 0.75}}};
static_assert(kBakeLevels.size() == kFinenessNames.size());

class FixedLight {
 public:
  FixedLight() = default;
  /// What shines in that scene, its own lamps (visual/scene/scene_lights.h) behind those of the file `street_lamps`,
  /// which may be empty: there are none. `reflected`: in place of what that says. Error: a file that cannot be read.
  static Result<FixedLight> of(const Scene& scene, const std::filesystem::path& street_lamps,
                               const std::optional<MoonConfig>& moon, const std::optional<Reflected>& reflected = {});

  bool any() const { return !lamps_.empty() || moon_ || !suns_.empty() || luminous_ > 0 || covered_; }
  std::size_t street_lamps() const { return lamps_.size(); }
  std::size_t luminous() const { return luminous_; }  ///< materials that shine by themselves
  struct Moon {
    glm::dvec3 toward{0.0, 0.0, 1.0};
    double lx = 0.0;  ///< on a plane that faces it
    glm::vec3 colour{1.0f};
  };
  const std::optional<Moon>& moon_toward() const { return moon_; }
  bool moon() const { return moon_.has_value(); }
  std::size_t directional() const { return suns_.size(); }  ///< lights of the scene that have a direction alone
  bool r_table() const { return r_table_; }  ///< some asphalt is lit by lamps, the moon or what has a direction alone
  /// Vertices of the material keep a FixedRoad.
  bool r_table(const SceneMaterial& material) const;
  bool covered() const { return covered_; }  ///< some surface does not see the whole sky
  /// Where some surface does not: whether there is a roof, anything but paint, within 100 m straight above.
  bool roofed(const glm::dvec3& point_m) const;

  /// Pieces of covered surfaces that send light on; 0: there is nothing covered, or no lamp, or it is switched off.
  std::size_t reflecting() const { return reflected_.patches(); }
  bool too_many_reflecting() const { return reflected_.too_many(); }

  /// One lamp's share, or that of what has a direction alone.
  struct Share {
    std::optional<std::size_t> lamp{};
    std::optional<std::size_t> directional{};  ///< neither: the moon, or
    bool reflected = false;                    ///< what covered surfaces send on
    double lx = 0.0;
  };
  /// In float64, with shadows: what falls on a point, strongest first.
  std::vector<Share> shares_at(const glm::dvec3& point_m, const glm::dvec3& normal) const;
  /// The same of what would fall there and is hidden, all of it. `from_m`: where it comes from, of what has a direction
  /// alone beyond the scene.
  struct Hidden {
    Share share{};
    glm::dvec3 from_m{0.0};
  };
  std::vector<Hidden> hidden_at(const glm::dvec3& point_m, const glm::dvec3& normal) const;
  double lux_at(const glm::dvec3& point_m, const glm::dvec3& normal) const;
  /// Where lamps are that are so near a box.
  std::vector<glm::dvec3> lamps_near(const glm::dvec3& low_m, const glm::dvec3& high_m, double within_m) const;
  /// As vertices of the scene keep it: one that nobody sees, for something thin lies on it, has the light that falls on
  /// that; else lux_at(). `reflected_lx`: as reflected_at() gives it, where that is known.
  FixedVertex at(const glm::dvec3& point_m, const glm::dvec3& normal, const SceneMaterial& material,
                 FixedRoad* road = nullptr, FixedWay* way = nullptr, const glm::dvec4* reflected_lx = nullptr) const;
  /// Of that what covered surfaces send on, lx: linear Rec. 709 and photopic.
  glm::dvec4 reflected_at(const glm::dvec3& point_m, const glm::dvec3& normal, const SceneMaterial& material,
                          std::uint32_t ways = kReflectedWays) const;
  FixedProbe probe(const glm::dvec3& point_m) const;
  /// Lamps that shine into an eye, the scene and the air between them; what moves hides none. The strongest at the eye,
  /// so many that those which a view sees best are among them.
  std::vector<GlaringLamp> glare_at(const glm::dvec3& eye_m, const Air& air) const;

  /// Lamps that level wet ground below an eye mirrors into it: those that would be brightest in a mirror, with what
  /// shines from each toward the place of the ground where it is seen. The film shows them wherever it is rough enough.
  struct Mirrored {
    glm::dvec3 place_m{0.0};
    glm::vec3 cd{0.0f};  ///< rgb
  };
  std::vector<Mirrored> mirrored_into(const glm::dvec3& eye_m, std::size_t most) const;

  /// Of each chunk the mesh near by and those of kFarLevels. On all cores; the same meshes however many.
  using Meshes = std::array<FixedMesh, 1 + kFarLevels.size()>;
  std::vector<Meshes> meshes(const Scene& scene) const;

 private:
  struct Luminaire {
    IntensityTable table;
    glm::vec3 colour{1.0f};  ///< luminance 1
    double scale = 1.0, peak_cd = 0.0;
    /// Of a lamp without a table: cosines of its cone, where its full light ends and where it is dark; -2: every way.
    bool has_table = true;
    double cos_inner = -2.0, cos_outer = -2.0;
    std::optional<LampOpening> opening{};  ///< as its file states it; none: a point
  };
  struct Lamp {
    glm::dvec3 position_m{0.0};
    glm::dmat3 lamp_from_world{1.0};
    std::size_t luminaire = 0;
    double range_m = std::numeric_limits<double>::infinity();  ///< there is nothing of it beyond (KHR_lights_punctual)
  };
  Status add_lights_of(const Scene& scene);
  /// cd into a direction of the world, of any length.
  double candela(const Lamp& lamp, const glm::dvec3& way) const;
  /// The share of the lamp that nothing hides, 0 to 1. `lx`: what all of it gives. `leave_within_m`: as
  /// RayTree::blocked().
  double open_share(const glm::dvec3& from_m, const Lamp& lamp, double lx, double leave_within_m) const;
  template <typename Add>
  void each(const glm::dvec3& point_m, const glm::dvec3* normal, bool of_mesh, const Add& add,
            bool hidden = false) const;

  BakeLevel level_ = kBakeLevels[1];
  std::vector<Luminaire> luminaires_;
  std::vector<Lamp> lamps_;
  std::optional<Moon> moon_;
  std::vector<Moon> suns_;  ///< directional lights of the scene
  std::size_t luminous_ = 0;
  bool covered_ = false, r_table_ = false;
  RoadLobes lobes_ = RoadLobes::asphalt();
  RayTree tree_;
  ReflectedLight reflected_;
};

}  // namespace phare
