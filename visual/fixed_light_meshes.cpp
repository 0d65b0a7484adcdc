// What FixedLight is asked for when a scene is loaded: its meshes, cut where the light asks for it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "config/base/on_all_cores.h"
#include "shaders/lib/road.h"
#include "visual/fixed_light.h"
#include "visual/fixed_light_fit.h"
#include "visual/renderer.h"
#include "visual/scene/refine.h"

namespace phare {
namespace {

constexpr double kFloor_lx = 0.5;   // the error is that of so many lux where there are fewer
constexpr double kLongestSide_m = 6.0;  // a longer side may have a pool of light between its ends
// Those lengths are of lamps so far away. What interpolation is off by goes with the square of a side's length over the
// distance of the lamp.
constexpr double kHigh_m = 8.0;
constexpr double kLeastShare = 0.05;  // of the lengths: lamps nearer than 0.4 m are taken for so far away
constexpr double kReflected_m = 2.0;  // light that is reflected is even along shorter sides
/// So many vertices ask for it along kReflectedWays; where there are more, along fewer, down to kFewestWays.
constexpr std::size_t kMostAsk = 200000;
constexpr std::uint32_t kFewestWays = 16;
constexpr int kMostCuts = 10;
constexpr double kStreaksOff = 2.0;  // times the tolerance: luminance of asphalt by its r-table, from any side

/// The light at a vertex, asked once for each place and normal of a chunk.
class Baker {
 public:
  Baker(const FixedLight& light, const Scene& scene, const SceneChunk& chunk, std::uint32_t ways)
      : light_(light),
        material_(scene.materials[chunk.material]),
        origin_m_(chunk.origin_m),
        r_table_(light.r_table(material_)),
        relief_(material_.look.relief()),
        lamps_m_(light.lamps_near(chunk.low_m, chunk.high_m, kHigh_m)),
        ways_(ways) {}

  void add(FixedMesh& mesh, const SceneVertex& vertex) {
    const Kept& kept = at(vertex);
    mesh.light.push_back(kept.light);
    if (r_table_) mesh.road.push_back(kept.road);
    if (relief_) mesh.ways.push_back(kept.way);
    if (light_.reflecting() > 0) mesh.reflected_lx.push_back(kept.reflected_lx);
  }

  /// Sides whose middle is off by more than the level allows are halved, in both triangles that share them.
  /// `by_distance`: the shorter the nearer their lamp.
  void cut(FixedMesh& mesh, const BakeLevel& level, bool by_distance) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<std::uint32_t>> middle_of;
    for (int cut = 0; cut < kMostCuts; ++cut) {
      bool any = false;
      const auto middle = [&](std::uint32_t i, std::uint32_t j) -> std::optional<std::uint32_t> {
        const auto [found, fresh] = middle_of.try_emplace(std::minmax(i, j));
        if (fresh) found->second = halved(mesh, i, j, level, by_distance);
        any = any || found->second;
        return found->second;
      };
      std::vector<std::uint32_t> next;
      for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const std::array<std::uint32_t, 3> c{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
        const std::array<std::optional<std::uint32_t>, 3> m{middle(c[0], c[1]), middle(c[1], c[2]), middle(c[2], c[0])};
        split(next, c, m);
      }
      mesh.indices = std::move(next);
      if (!any) break;
    }
  }

 private:
  struct Kept {
    FixedVertex light;
    FixedRoad road;
    FixedWay way{0.0f};
    glm::dvec4 reflected_lx{0.0};
  };

  /// `reflected_lx`: where it is known.
  const Kept& at(const SceneVertex& vertex, const std::optional<glm::dvec4>& reflected_lx = {}) {
    const auto key = std::bit_cast<std::array<std::uint32_t, 6>>(vertex);
    const auto [found, fresh] = known_.try_emplace(key);
    if (!fresh) return found->second;
    Kept& kept = found->second;
    const glm::dvec3 at_m = origin_m_ + glm::dvec3(vertex.position_m);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(vertex.normal));
    kept.reflected_lx = reflected_lx ? *reflected_lx : light_.reflected_at(at_m, normal, material_, ways_);
    kept.light = light_.at(at_m, normal, material_, r_table_ ? &kept.road : nullptr, relief_ ? &kept.way : nullptr,
                           &kept.reflected_lx);
    return kept;
  }

  /// Of asphalt luminance, from all around, is off by more in the middle.
  static bool streaks_off(const FixedMesh& mesh, std::uint32_t i, std::uint32_t j, const Kept& middle,
                          const BakeLevel& level) {
    constexpr int kWays = 24;  // half as wide as a streak of a lamp 20° over the road
    std::array<double, kWays> exact, between;
    double most = 0.0;
    for (int k = 0; k < kWays; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / kWays;
      const glm::vec2 way(std::cos(turn), std::sin(turn));
      const auto seen = [&way](const FixedVertex& light, const FixedRoad& road) {
        const auto word = [&road](std::size_t at) {
          return shader::uvec4(road.halves[at], road.halves[at + 1], road.halves[at + 2], road.halves[at + 3]);
        };
        return static_cast<double>(light.light.w * shader::of_the_table(word(0), word(4), word(8), way));
      };
      const auto at = static_cast<std::size_t>(k);
      exact[at] = seen(middle.light, middle.road);
      between[at] = 0.5 * (seen(mesh.light[i], mesh.road[i]) + seen(mesh.light[j], mesh.road[j]));
      most = std::max(most, exact[at]);
    }
    if (most < kFloor_lx) return false;
    for (std::size_t k = 0; k < kWays; ++k)
      if (std::abs(exact[k] - between[k]) > kStreaksOff * level.tolerance * std::max(exact[k], 0.25 * most))
        return true;
    return false;
  }

  /// Of the lengths above, for a side between two vertices.
  double share_of_lengths(const SceneVertex& a, const SceneVertex& b) const {
    const glm::dvec3 a_m = origin_m_ + glm::dvec3(a.position_m), along(b.position_m - a.position_m);
    const double length_m2 = glm::dot(along, along);
    double lamp_m = kHigh_m;
    for (const glm::dvec3& at_m : lamps_m_) {
      const double at = length_m2 > 0.0 ? std::clamp(glm::dot(at_m - a_m, along) / length_m2, 0.0, 1.0) : 0.0;
      lamp_m = std::min(lamp_m, glm::distance(at_m, a_m + at * along));
    }
    return std::max(lamp_m / kHigh_m, kLeastShare);
  }

  std::optional<std::uint32_t> halved(FixedMesh& mesh, std::uint32_t i, std::uint32_t j, const BakeLevel& level,
                                      bool by_distance) {
    const SceneVertex a = mesh.vertices[i], b = mesh.vertices[j];
    const double length_m = static_cast<double>(glm::distance(a.position_m, b.position_m));
    if (length_m < 2.0 * kLeastShare * level.least_edge_m) return std::nullopt;
    const double share = by_distance ? share_of_lengths(a, b) : 1.0;
    if (length_m < 2.0 * share * level.least_edge_m) return std::nullopt;
    const glm::vec3 normal = a.normal + b.normal;
    if (glm::dot(normal, normal) < 1e-6f) return std::nullopt;
    const SceneVertex between{0.5f * (a.position_m + b.position_m), glm::normalize(normal)};
    const double at_a = static_cast<double>(mesh.light[i].light.w), at_b = static_cast<double>(mesh.light[j].light.w);
    std::optional<glm::dvec4> reflected_lx;
    if (light_.reflecting() > 0 && length_m <= kReflected_m)
      reflected_lx = 0.5 * (at(a).reflected_lx + at(b).reflected_lx);
    const Kept& middle = at(between, reflected_lx);
    const double exact = static_cast<double>(middle.light.light.w);
    // What rays are off by is nothing to cut for: their number to -3/4 of what they bring.
    const double rays_lx = middle.reflected_lx.w * std::pow(static_cast<double>(ways_), -0.75);
    const bool off = std::abs(exact - 0.5 * (at_a + at_b)) > level.tolerance * std::max(exact, kFloor_lx) + rays_lx;
    const bool unseen = length_m > share * kLongestSide_m && std::max({at_a, at_b, exact}) > 0.1 * kFloor_lx;
    if (!off && !unseen && !(r_table_ && streaks_off(mesh, i, j, middle, level))) return std::nullopt;
    mesh.vertices.push_back(between);
    add(mesh, between);
    if (!mesh.looks.empty()) mesh.looks.push_back(look_between(mesh.looks[i], mesh.looks[j]));
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  }

  static void split(std::vector<std::uint32_t>& out, std::array<std::uint32_t, 3> c,
                    std::array<std::optional<std::uint32_t>, 3> m) {
    const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t d) { out.insert(out.end(), {a, b, d}); };
    const int count = (m[0] ? 1 : 0) + (m[1] ? 1 : 0) + (m[2] ? 1 : 0);
    if (count == 0) return emit(c[0], c[1], c[2]);
    if (count == 3) {
      emit(c[0], *m[0], *m[2]);
      emit(c[1], *m[1], *m[0]);
      emit(c[2], *m[2], *m[1]);
      return emit(*m[0], *m[1], *m[2]);
    }
    // Turned so that the first side is halved, and of two the second as well.
    while (!(m[0] && (count == 1 || m[1]))) {
      std::rotate(c.begin(), c.begin() + 1, c.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    if (count == 1) {
      emit(c[0], *m[0], c[2]);
      return emit(*m[0], c[1], c[2]);
    }
    emit(*m[0], c[1], *m[1]);
    emit(c[0], *m[0], *m[1]);
    emit(c[0], *m[1], c[2]);
  }

  const FixedLight& light_;
  const SceneMaterial& material_;
  glm::dvec3 origin_m_;
  bool r_table_, relief_;
  std::vector<glm::dvec3> lamps_m_;  ///< nearer than kHigh_m to any of it
  std::uint32_t ways_;               ///< reflected light is asked for along so many
  std::map<std::array<std::uint32_t, 6>, Kept> known_;
};
static_assert(sizeof(SceneVertex) == sizeof(std::array<std::uint32_t, 6>));

}  // namespace

std::vector<FixedLight::Meshes> FixedLight::meshes(const Scene& scene) const {
  std::vector<Meshes> all(scene.chunks.size());
  std::size_t ask = 0;
  for (const SceneChunk& chunk : scene.chunks)
    if (reflected_.reaches(0.5 * (chunk.low_m + chunk.high_m))) ask += chunk.vertex_count;
  const auto ways = static_cast<std::uint32_t>(
      std::max<std::size_t>(kFewestWays, kReflectedWays * std::min(kMostAsk, ask) / std::max<std::size_t>(ask, 1)));
  std::array<double, 1 + kFarLevels.size()> least_edges_m{level_.least_edge_m};
  for (std::size_t far = 0; far < kFarLevels.size(); ++far)  // a hundred pixels wide, seen edge on
    least_edges_m[1 + far] = std::max(level_.least_edge_m, 0.015 * kFarLevels[far].from * kFarMeshFrom_m);
  on_all_cores(all.size(), [&](std::size_t i) {
    const SceneChunk& chunk = scene.chunks[i];
    Baker baker(*this, scene, chunk, ways);
    for (std::size_t level = 0; level < all[i].size(); ++level) {
      FixedMesh& mesh = all[i][level];
      if (level > 0 && level - 1 < first_far_level(scene.materials[chunk.material])) continue;
      const BakeLevel cuts{level_.tolerance, least_edges_m[level]};
      if (level == 0) {
        const auto vertices = scene.vertices.begin() + chunk.first_vertex;
        const auto indices = scene.indices.begin() + chunk.first_index;
        mesh.vertices.assign(vertices, vertices + chunk.vertex_count);
        mesh.indices.assign(indices, indices + chunk.index_count);
        if (chunk.first_look) {
          const auto looks = scene.looks.begin() + *chunk.first_look;
          mesh.looks.assign(looks, looks + chunk.vertex_count);
        }
      } else {
        const double from_m = kFarLevels[level - 1].from * kFarMeshFrom_m;
        FarMesh far = far_mesh(scene, chunk, level - 1, from_m);
        mesh.vertices = std::move(far.vertices), mesh.indices = std::move(far.indices);
        mesh.looks = std::move(far.looks);
      }
      for (const SceneVertex& vertex : mesh.vertices) baker.add(mesh, vertex);
      if (!lamps_.empty() || !suns_.empty()) baker.cut(mesh, cuts, level == 0);
    }
  });
  if (!lamps_.empty() || !suns_.empty()) fit_light(*this, scene, all, least_edges_m);
  for (Meshes& of : all)
    for (FixedMesh& mesh : of) std::vector<glm::dvec4>().swap(mesh.reflected_lx);
  return all;
}

}  // namespace phare
