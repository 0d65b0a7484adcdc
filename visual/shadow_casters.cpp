#include "visual/shadow_casters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <numeric>

#include "config/base/on_all_cores.h"
#include "shaders/lamps.h"
#include "visual/caster_grid.h"
#include "visual/scene/far_mesh.h"

namespace phare {
namespace {

void widen(TangentRect& part, const TangentRect& by) {
  part = {std::min(part.right, by.right), std::max(part.left, by.left), std::min(part.low, by.low),
          std::max(part.high, by.high)};
}

TangentRect common(const TangentRect& a, const TangentRect& b) {
  return {std::max(a.right, b.right), std::min(a.left, b.left), std::max(a.low, b.low), std::min(a.high, b.high)};
}

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr TangentRect kNothing{kFar, -kFar, kFar, -kFar};

/// Tangents that a cone of light about the axis reaches. `is_high`: there is light far up or down.
TangentRect widest(const LampReach& reach, const glm::dmat3& world_from_image, bool is_high) {
  const double off_axis = std::acos(std::clamp(glm::dot(reach.cone.axis, world_from_image[0]), -1.0, 1.0));
  const double angle = off_axis + reach.cone.half_angle_rad;
  const double most = angle < std::atan(kWidestShadow) ? std::tan(angle) : kWidestShadow;
  const double high = is_high ? most : std::min(most, kHighestShadow);
  return {-most, most, -high, high};
}

/// Of the view's sides, as ShadowCasters::Light has them. What casts goes away from the lamp: past a side it stays past
/// it once it is there and does not come nearer.
std::vector<glm::vec4> sides_of(const ViewGeometry& view, const glm::dvec3& lamp_m, const glm::dmat3& world_from_image) {
  std::vector<glm::vec4> sides;
  for (const glm::dvec4& side : view.inward()) {
    const glm::dvec3 inward = side;
    const double lamp_within_m = glm::dot(inward, lamp_m - view.camera().eye_m) + side.w;
    sides.emplace_back(glm::vec3(glm::transpose(world_from_image) * inward), std::min(0.0, -lamp_within_m));
  }
  return sides;
}

/// How far within a side of the view a corner is, m; below 0 it and all that lies behind it as the lamp sees it are out
/// of view. With room for the texels that are read about a point. `distance_m`: of the corner from the lamp.
float within(const glm::vec4& side, const glm::vec3& corner, float distance_m) {
  constexpr float kRoom_rad = 0.02f;
  return glm::dot(glm::vec3(side), corner) - side.w + kRoom_rad * distance_m;
}

/// A corner as the lamp has it.
struct SeenCorner {
  glm::vec3 at_m{0.0f};
  glm::vec2 tangents{0.0f};  ///< to the left and up, where it is ahead of the lamp
  glm::vec2 cell{0.0f};      ///< the same in cells of LightPeaks, where those are asked
  std::uint32_t beyond = 0;  ///< of which sides of the view, a bit each
  bool ahead = false;
};

SeenCorner seen_corner(const glm::vec3& at_m, std::span<const glm::vec4> sides, bool with_cell) {
  SeenCorner corner{.at_m = at_m, .ahead = at_m.x >= shader::kShadowNear_m};
  if (corner.ahead) corner.tangents = glm::vec2(at_m.y, at_m.z) / at_m.x;
  if (corner.ahead && with_cell) corner.cell = LightPeaks::cell_of(corner.tangents);
  if (sides.empty()) return corner;
  const float distance_m = glm::length(at_m);
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (within(sides[i], at_m, distance_m) < 0.0f) corner.beyond |= 1u << i;
  return corner;
}

CastBounds bounds_of(const SeenCorner& a, const SeenCorner& b, const SeenCorner& c) {
  return {.least = glm::min(a.tangents, glm::min(b.tangents, c.tangents)),
          .most = glm::max(a.tangents, glm::max(b.tangents, c.tangents)),
          .nearest_m = std::min({a.at_m.x, b.at_m.x, c.at_m.x}),
          .beside = !a.ahead || !b.ahead || !c.ahead};
}

/// Keeps what of a polygon has `inside` >= 0 (Sutherland and Hodgman 1974), or a little more where it is convex.
template <typename Inside>
void clip(std::vector<glm::vec3>& polygon, std::vector<glm::vec3>& room, const Inside& inside) {
  room.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float at_a = inside(a), at_b = inside(b);
    if (at_a >= 0.0f) room.push_back(a);
    if ((at_a >= 0.0f) != (at_b >= 0.0f)) room.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  polygon.swap(room);
}

/// What a triangle fills of the lamp's view, as far as its shadow may be seen.
TangentRect part_of(const std::array<glm::vec3, 3>& corners, std::span<const glm::vec4> sides) {
  const auto widened_by = [](TangentRect part, const glm::vec3& corner) {
    const double left = static_cast<double>(corner.y / corner.x), up = static_cast<double>(corner.z / corner.x);
    widen(part, {left, left, up, up});
    return part;
  };
  thread_local std::vector<glm::vec3> polygon, room;
  polygon.assign(corners.begin(), corners.end());
  clip(polygon, room, [](const glm::vec3& corner) { return corner.x - shader::kShadowNear_m; });
  for (const glm::vec4& side : sides)
    clip(polygon, room, [&](const glm::vec3& corner) { return within(side, corner, glm::length(corner)); });
  return std::accumulate(polygon.begin(), polygon.end(), kNothing, widened_by);
}

/// All of the triangle lies in `part`.
bool lies_in(const CastBounds& bounds, const TangentRect& part) {
  const glm::dvec2 least = bounds.least, most = bounds.most;
  return !bounds.beside && least.x >= part.right && most.x <= part.left && least.y >= part.low && most.y <= part.high;
}

/// From `lamp_m`, in the frame of the triangle.
bool shows_its_far_side(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& lamp_m) {
  const glm::vec3 normal = glm::cross(b - a, c - a);
  constexpr float kBehind_m = 1e-4f;  // of the plane of the triangle
  const float behind = glm::dot(normal, a - lamp_m);
  return behind > 0.0f && behind * behind > kBehind_m * kBehind_m * glm::dot(normal, normal);
}

/// Corners of a mesh as the lamp has them, each worked out when it is first asked for.
class SeenCorners {
 public:
  void begin(std::size_t count) {
    if (count > corners_.size()) corners_.resize(count), round_of_.resize(count, round_);
    ++round_;
  }
  template <typename See>
  const SeenCorner& at(std::uint32_t i, See&& see) {
    if (round_of_[i] != round_) corners_[i] = see(i), round_of_[i] = round_;
    return corners_[i];
  }

 private:
  std::vector<SeenCorner> corners_;
  std::vector<std::uint64_t> round_of_;
  std::uint64_t round_ = 0;
};

void append(WholeCasters& to, const WholeCasters& from) {
  to.corners.insert(to.corners.end(), from.corners.begin(), from.corners.end());
  to.bounds.insert(to.bounds.end(), from.bounds.begin(), from.bounds.end());
}

CutCasters& of_material(std::vector<CutCasters>& all, std::size_t material) {
  const auto known = std::ranges::find(all, material, &CutCasters::material);
  return known != all.end() ? *known : all.emplace_back(CutCasters{material});
}

/// What another part of the chunks casts.
void append(CastBy& to, const CastBy& from) {
  for (std::size_t i = 0; i < to.chunks.size(); ++i) to.chunks[i] = to.chunks[i] || from.chunks[i];
  widen(to.part, from.part);
  append(to.far_sides, from.far_sides);
  append(to.both_sides, from.both_sides);
  for (const CutCasters& cut : from.cut) {
    CutCasters& known = of_material(to.cut, cut.material);
    known.corners.insert(known.corners.end(), cut.corners.begin(), cut.corners.end());
    known.bounds.insert(known.bounds.end(), cut.bounds.begin(), cut.bounds.end());
  }
}

Holes holes_in(const Scene& scene, std::size_t material) {
  const PixelLook& look = scene.materials[material].look;
  const SceneTexture& texture = scene.textures[*look.base_texture];
  // Where the base has no opacity, all is a hole.
  const float below = look.base.w > 0.0f ? 255.0f * *look.cut_below / look.base.w : 256.0f;
  Holes holes{texture.width, texture.height, look.sampler, below, {}};
  holes.opacity.reserve(texture.rgba.size() / 4);
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) holes.opacity.push_back(texture.rgba[i]);
  return holes;
}

}  // namespace

ShadowCasters::Chunk ShadowCasters::chunk_of(const Scene& scene, const SceneChunk& from, std::size_t first_material) {
  const SceneMaterial& material = scene.materials[from.material];
  Chunk chunk{.origin_m = from.origin_m,
              .low_m = from.low_m,
              .high_m = from.high_m,
              .double_sided = material.double_sided,
              .paint = material.surface == Surface::kPaint};
  if (from.first_look && material.look.cut_below && material.look.base_texture) {
    chunk.cut_of = first_material + from.material;
    for (std::uint32_t i = 0; i < from.vertex_count; ++i) chunk.whole.uvs.push_back(scene.looks[*from.first_look + i].uv);
  }
  chunk.whole.corners_m.reserve(from.vertex_count);
  for (std::uint32_t i = 0; i < from.vertex_count; ++i)
    chunk.whole.corners_m.push_back(scene.vertices[from.first_vertex + i].position_m);
  chunk.whole.indices.assign(scene.indices.begin() + from.first_index,
                             scene.indices.begin() + from.first_index + from.index_count);
  return chunk;
}

const CasterMesh& ShadowCasters::Chunk::mesh_at(double distance_m, double far_from_m) const {
  const CasterMesh* mesh = &whole;
  for (std::size_t level = 0; level < far.size(); ++level)
    if (far[level] && distance_m >= kFarLevels[level].from * far_from_m) mesh = &*far[level];
  return *mesh;
}

ShadowCasters::ShadowCasters(const Scene& scene, const Scene& moving, std::vector<FarCasters> far) {
  for (const SceneChunk& from : scene.chunks) chunks_.push_back(chunk_of(scene, from, 0));
  for (std::size_t i = 0; i < std::min(far.size(), chunks_.size()); ++i) chunks_[i].far = std::move(far[i]);
  for (const std::vector<std::size_t>& of_node : chunks_by_node(moving)) {
    std::vector<Chunk>& mesh = moving_.emplace_back();
    for (const std::size_t from : of_node)
      mesh.push_back(chunk_of(moving, moving.chunks[from], scene.materials.size()));
  }
  std::map<std::size_t, std::size_t> holes_of;  // of a material
  const auto count = [&](std::vector<Chunk>& chunks) {
    for (Chunk& chunk : chunks) {
      if (chunk.paint) continue;
      ray_triangles_ += chunk.whole.indices.size() / 3;
      if (!chunk.cut_of) continue;
      ray_triangles_with_holes_ += chunk.whole.indices.size() / 3;
      const auto [known, added] = holes_of.try_emplace(*chunk.cut_of, holes_.size());
      chunk.holes = known->second;
      if (!added) continue;
      const bool stands = *chunk.cut_of < scene.materials.size();
      holes_.push_back(stands ? holes_in(scene, *chunk.cut_of) : holes_in(moving, *chunk.cut_of - scene.materials.size()));
    }
  };
  count(chunks_);
  for (std::vector<Chunk>& mesh : moving_) count(mesh);
}

void ShadowCasters::add_triangles(const Chunk& chunk, std::vector<RayTree::Triangle>& triangles,
                                  std::vector<CutTriangle>& cut) {
  if (chunk.paint) return;
  const CasterMesh& mesh = chunk.whole;
  for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
    const auto corner = [&](std::size_t i) { return chunk.origin_m + glm::dvec3(mesh.corners_m[mesh.indices[k + i]]); };
    const glm::dvec3 a = corner(0);
    triangles.push_back({a, corner(1) - a, corner(2) - a, !chunk.double_sided});
    if (!chunk.cut_of) continue;
    const auto uv = [&](std::size_t i) { return mesh.uvs[mesh.indices[k + i]]; };
    cut.push_back({uv(0), uv(1) - uv(0), uv(2) - uv(0), chunk.holes});
    triangles.back().cut = static_cast<std::uint32_t>(cut.size());
  }
}

RayTrees ShadowCasters::ray_trees() const {
  RayTrees trees;
  const auto tree_of = [&](const std::vector<Chunk>& chunks) {
    std::vector<RayTree::Triangle> triangles;
    for (const Chunk& chunk : chunks) add_triangles(chunk, triangles, trees.cut);
    return RayTree(triangles);
  };
  trees.standing = tree_of(chunks_);
  for (const std::vector<Chunk>& mesh : moving_) trees.moving.push_back(tree_of(mesh));
  return trees;
}

bool ShadowCasters::cast_chunk(const Chunk& chunk, const CasterMesh& mesh, const glm::mat3& turn,
                               const glm::vec3& shift, const glm::vec3& lamp_m, const Light& light, CastBy& cast) {
  thread_local SeenCorners corners;
  corners.begin(mesh.corners_m.size());
  const auto seen = [&](std::size_t k) -> const SeenCorner& {
    return corners.at(mesh.indices[k], [&](std::uint32_t corner) {
      return seen_corner(turn * mesh.corners_m[corner] + shift, light.sides, light.peaks != nullptr);
    });
  };
  const bool far_sides = !chunk.cut_of && !chunk.double_sided;
  bool casts = false;
  CutCasters* const cut = chunk.cut_of ? &of_material(cast.cut, *chunk.cut_of) : nullptr;
  WholeCasters& whole = chunk.double_sided ? cast.both_sides : cast.far_sides;
  for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
    const auto corner_m = [&](std::size_t i) { return mesh.corners_m[mesh.indices[k + i]]; };
    if (far_sides && !shows_its_far_side(corner_m(0), corner_m(1), corner_m(2), lamp_m)) continue;
    const SeenCorner &a = seen(k), &b = seen(k + 1), &c = seen(k + 2);
    if ((a.beyond & b.beyond & c.beyond) != 0) continue;
    const CastBounds bounds = bounds_of(a, b, c);
    if (!(a.ahead || b.ahead || c.ahead) || static_cast<double>(bounds.nearest_m) > kShadowsTo_m) continue;
    if (!bounds.beside && light.faint(glm::min(a.cell, glm::min(b.cell, c.cell)),
                                      glm::max(a.cell, glm::max(b.cell, c.cell)), bounds.nearest_m))
      continue;
    if (!lies_in(bounds, cast.part)) {
      const TangentRect part = common(part_of({a.at_m, b.at_m, c.at_m}, light.sides), light.part);
      if (part.left < part.right || part.high < part.low) continue;
      widen(cast.part, part);
    }
    if (cut != nullptr) {
      const auto uv = [&](std::size_t corner) { return mesh.uvs[mesh.indices[k + corner]]; };
      cut->corners.insert(cut->corners.end(), {{a.at_m, uv(0)}, {b.at_m, uv(1)}, {c.at_m, uv(2)}});
      cut->bounds.push_back(bounds);
    } else {
      for (const SeenCorner* corner : {&a, &b, &c}) whole.corners.push_back(corner->at_m);
      whole.bounds.push_back(bounds);
    }
    casts = true;
  }
  return casts;
}

CastBy ShadowCasters::by(const LampReach& reach, const glm::dmat3& world_from_image, std::span<const PlacedMesh> moving,
                         std::size_t carried_by, const CastersFor& wanted) const {
  CastBy cast{.chunks = std::vector<bool>(chunks_.size() + moving.size()), .part = kNothing};
  constexpr std::size_t kUsual = 1024;  // triangles on a country road: memory that need not grow
  Light light{.part = widest(reach, world_from_image, wanted.peaks != nullptr && wanted.peaks->is_high())};
  if (wanted.faint_lx > 0.0) light.peaks = wanted.peaks, light.faint_lx = static_cast<float>(wanted.faint_lx);
  if (wanted.view != nullptr) light.sides = sides_of(*wanted.view, reach.tip_m, world_from_image);
  const glm::dmat3 image_from_world = glm::transpose(world_from_image);
  const auto distance_m = [&](const glm::dvec3& low_m, const glm::dvec3& high_m) {
    return glm::distance(reach.tip_m, glm::clamp(reach.tip_m, low_m, high_m));
  };
  // What is beyond a side with all of its corners is so with all that lies between them: it is convex.
  const auto shades_the_view = [&](const glm::dvec3& low_m, const glm::dvec3& high_m) {
    std::uint32_t beyond = ~0u;
    for (const glm::vec3& corner : box_corners(image_from_world, reach.tip_m, low_m, high_m))
      beyond &= seen_corner(corner, light.sides, false).beyond;
    return beyond == 0;
  };
  const auto stands_in_faint_light = [&](const glm::dvec3& low_m, const glm::dvec3& high_m) {
    glm::vec2 least(std::numeric_limits<float>::infinity()), most(-least);
    for (const glm::vec3& corner : box_corners(image_from_world, reach.tip_m, low_m, high_m)) {
      if (corner.x < shader::kShadowNear_m) return false;
      const glm::vec2 tangents = glm::vec2(corner.y, corner.z) / corner.x;
      least = glm::min(least, tangents), most = glm::max(most, tangents);
    }
    return light.faint(LightPeaks::cell_of(least), LightPeaks::cell_of(most),
                       static_cast<float>(distance_m(low_m, high_m)));
  };
  const auto near = [&](const glm::dvec3& low_m, const glm::dvec3& high_m) {
    return distance_m(low_m, high_m) <= kShadowsTo_m && reach.meets(low_m, high_m) && shades_the_view(low_m, high_m) &&
           !stands_in_faint_light(low_m, high_m);
  };
  /// A chunk that is near and in the light, as cast_chunk() takes it.
  struct Near {
    const Chunk* chunk = nullptr;
    const CasterMesh* mesh = nullptr;
    glm::mat3 turn;
    glm::vec3 shift, lamp_m;
    std::size_t piece = 0;         ///< of CastBy::chunks
    std::size_t triangles_to = 0;  ///< of all up to it
  };
  std::vector<Near> lit;
  const auto add = [&](Near one) {
    if (one.mesh->indices.size() < 3) return;
    one.triangles_to = (lit.empty() ? 0 : lit.back().triangles_to) + one.mesh->indices.size() / 3;
    lit.push_back(one);
  };
  for (std::size_t i = 0; i < chunks_.size() && wanted.standing == nullptr; ++i) {
    const Chunk& chunk = chunks_[i];
    if (!near(chunk.low_m, chunk.high_m)) continue;
    add({.chunk = &chunk,
         .mesh = &chunk.mesh_at(distance_m(chunk.low_m, chunk.high_m), wanted.far_from_m),
         .turn = glm::mat3(image_from_world),
         .shift = glm::vec3(image_from_world * (chunk.origin_m - reach.tip_m)),
         .lamp_m = glm::vec3(reach.tip_m - chunk.origin_m),
         .piece = i});
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const PlacedMesh& placed = moving[i];
    if (i == carried_by || placed.mesh >= moving_.size()) continue;
    const glm::dmat3 extent(glm::abs(placed.world_from_mesh[0]), glm::abs(placed.world_from_mesh[1]),
                            glm::abs(placed.world_from_mesh[2]));
    const glm::mat3 turn(image_from_world * placed.world_from_mesh);
    const glm::dvec3 lamp_m = glm::transpose(placed.world_from_mesh) * (reach.tip_m - placed.position_m);
    for (const Chunk& chunk : moving_[placed.mesh]) {
      const glm::dvec3 middle_m = placed.position_m + placed.world_from_mesh * (0.5 * (chunk.low_m + chunk.high_m));
      const glm::dvec3 half_m = extent * (0.5 * (chunk.high_m - chunk.low_m));
      if (!near(middle_m - half_m, middle_m + half_m)) continue;
      const glm::dvec3 origin_m = placed.position_m + placed.world_from_mesh * chunk.origin_m;
      add({.chunk = &chunk,
           .mesh = &chunk.whole,
           .turn = turn,
           .shift = glm::vec3(image_from_world * (origin_m - reach.tip_m)),
           .lamp_m = glm::vec3(lamp_m - chunk.origin_m),
           .piece = chunks_.size() + i});
    }
  }
  const std::size_t triangles = lit.empty() ? 0 : lit.back().triangles_to, parts = parts_of_casters(triangles);
  std::vector<CastBy> of_parts(parts, cast);
  on_all_cores(parts, [&](std::size_t part) {
    CastBy& own = of_parts[part];
    own.far_sides.reserve(kUsual), own.both_sides.reserve(kUsual);
    for (const Near& one : lit) {
      if ((one.triangles_to - 1) * parts / triangles != part) continue;
      if (cast_chunk(*one.chunk, *one.mesh, one.turn, one.shift, one.lamp_m, light, own)) own.chunks[one.piece] = true;
    }
  });
  cast = std::move(of_parts.front());
  for (std::size_t part = 1; part < parts; ++part) append(cast, of_parts[part]);
  if (wanted.standing != nullptr && wanted.standing->count > 0) {
    CastBy all = *wanted.standing;
    all.chunks.resize(cast.chunks.size());
    append(all, cast);
    cast = std::move(all);
  }
  cast.count = static_cast<std::size_t>(std::ranges::count(cast.chunks, true));
  if (cast.count == 0) return {};
  return cast;
}

std::size_t parts_of_casters(std::size_t triangles) {
  constexpr std::size_t kOfPart = 4096, kMost = 8;
  return std::clamp(triangles / kOfPart, std::size_t{1}, kMost);
}

std::size_t casters_of_all(std::span<const std::shared_ptr<const CastBy>> casts) {
  std::vector<bool> any;
  for (const auto& cast : casts) {
    any.resize(std::max(any.size(), cast->chunks.size()));
    for (std::size_t i = 0; i < cast->chunks.size(); ++i) any[i] = any[i] || cast->chunks[i];
  }
  return static_cast<std::size_t>(std::ranges::count(any, true));
}

glm::dvec2 half_sides(const TangentRect& part) {
  const auto step_above = [](double half) {
    return std::exp2(std::ceil(std::log2(std::max(half, 1.0 / 64.0)) * 2.0) / 2.0);
  };
  return {step_above(std::max(-part.right, part.left)), step_above(std::max(-part.low, part.high))};
}

}  // namespace phare
