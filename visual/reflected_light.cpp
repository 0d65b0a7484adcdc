#include "visual/reflected_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <numbers>

#include "config/base/on_all_cores.h"
#include "shaders/lib/luminance.h"

namespace phare {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kPatchRays = 64, kRoundRays = 128;
constexpr double kShortest_m = 0.25, kLongest_m = 2.0;
constexpr int kMostHalvings = 40;
constexpr std::size_t kMostPatches = 200000;  // ten seconds of a processor; a scene with more has longer ones
constexpr double kLongestScale = 64.0;
constexpr double kFarthest_m = 200.0;
constexpr double kOff_m = 0.005;                 // the surface, where rays begin
constexpr double kDeep_m = 0.3, kThin_m = 0.15;  // of meshes: kWithin_m and kCover_m of visual/fixed_light.cpp
constexpr double kCorner_m = 0.03;               // as far points keep from what ends or stands there
constexpr double kSettled = 1e-4;                // of the brightest patch: so little changes the last time
constexpr double kWhitest = 0.95;                // of what falls on it a surface sends on at most, as fresh snow does
constexpr int kMostTimes = 400;                  // 0.95 to that power is 1e-9

/// So many directions over the half space about `normal` by the cosine (or, `even`, over the sphere): along a spiral.
glm::dvec3 direction(std::uint32_t k, std::uint32_t of, const glm::dmat3& frame, double turn, bool even) {
  const double part = (k + 0.5) / of, up = even ? 1.0 - 2.0 * part : std::sqrt(1.0 - part);
  const double level = std::sqrt(1.0 - up * up);
  const double about = turn + k * (3.0 - std::sqrt(5.0)) * std::numbers::pi;
  return frame * glm::dvec3(level * std::cos(about), level * std::sin(about), up);
}

/// Columns: two along the surface, its normal.
glm::dmat3 frame_of(const glm::dvec3& normal) {
  const glm::dvec3 least = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 along = glm::normalize(glm::cross(least, normal));
  return {along, glm::cross(normal, along), normal};
}

struct Patch {
  glm::dvec3 middle_m, normal;
  const SceneMaterial* material;
};

/// A scene's triangles, those that send light on cut into patches.
struct Pieces {
  std::vector<RayTree::Triangle> triangles;
  std::vector<std::uint32_t> patch_of;
  std::vector<Patch> patches;
  std::vector<std::pair<glm::dvec3, glm::dvec3>> boxes_m;

  /// False: there are more than kMostPatches of that length.
  bool cut(const Scene& scene, const std::vector<glm::dvec3>& lamps_m, double scale);

 private:
  void add(const SceneMaterial& material, bool sends, const std::array<glm::dvec3, 3>& corners, int cuts,
           const std::vector<glm::dvec3>& near_m, double scale);
};

bool Pieces::cut(const Scene& scene, const std::vector<glm::dvec3>& lamps_m, double scale) {
  *this = {};
  std::vector<glm::dvec3> near_m;
  for (const SceneChunk& chunk : scene.chunks) {
    const SceneMaterial& material = scene.materials[chunk.material];
    if (material.surface == Surface::kPaint) continue;  // it lies on what sends the light on
    const bool sends = material.sky_share < 1.0f && material.emission_cdm2 == glm::vec3(0.0f);
    if (sends) boxes_m.emplace_back(chunk.low_m - kReflectedReach_m, chunk.high_m + kReflectedReach_m);
    near_m.clear();  // those that may be nearer to a piece than its longest side
    for (const glm::dvec3& lamp_m : lamps_m)
      if (glm::distance(lamp_m, glm::clamp(lamp_m, chunk.low_m, chunk.high_m)) < kLongest_m) near_m.push_back(lamp_m);
    for (std::uint32_t i = 0; i + 2 < chunk.index_count; i += 3) {
      const auto corner = [&](std::uint32_t k) {
        return chunk.origin_m +
               glm::dvec3(scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i + k]].position_m);
      };
      add(material, sends, {corner(0), corner(1), corner(2)}, kMostHalvings, near_m, scale);
      if (patches.size() > kMostPatches) return false;
    }
  }
  return true;
}

void Pieces::add(const SceneMaterial& material, bool sends, const std::array<glm::dvec3, 3>& corners, int cuts,
                 const std::vector<glm::dvec3>& near_m, double scale) {
  if (patches.size() > kMostPatches) return;
  const auto& [a, b, c] = corners;
  const glm::dvec3 middle_m = (a + b + c) / 3.0, across = glm::cross(b - a, c - a);
  if (!(glm::length(across) > 0.0)) return;
  const double ab = glm::distance(a, b), bc = glm::distance(b, c), ca = glm::distance(c, a);
  const double longest_m = std::max({ab, bc, ca});
  const auto piece = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, int left) {
    add(material, sends, {p, q, r}, left, near_m, scale);
  };
  if (sends && ab < longest_m) return bc < longest_m ? piece(c, a, b, cuts) : piece(b, c, a, cuts);
  double side_m = kLongest_m;
  for (const glm::dvec3& lamp_m : near_m) side_m = std::min(side_m, glm::distance(lamp_m, middle_m));
  if (sends && cuts > 0 && longest_m > scale * std::max(side_m, kShortest_m)) {
    const glm::dvec3 half = 0.5 * (a + b);
    piece(a, half, c, cuts - 1);
    return piece(half, b, c, cuts - 1);
  }
  triangles.push_back({a, b - a, c - a, !material.double_sided});
  patch_of.push_back(sends ? static_cast<std::uint32_t>(patches.size()) : kNone);
  if (sends) patches.push_back({middle_m, glm::normalize(across), &material});
}

glm::dvec4 sent(const SceneMaterial& material, const glm::dvec4& lx) {
  const glm::dvec3 rgb = glm::min(glm::dvec3(material.reflectance), kWhitest) * glm::dvec3(lx);
  return {rgb, static_cast<double>(shader::luminance_of(glm::vec3(rgb)))};
}

}  // namespace

ReflectedLight::ReflectedLight(const Scene& scene, Reflected times, const Direct& direct,
                               const std::vector<glm::dvec3>& lamps_m) {
  if (times == Reflected::kOff) return;
  Pieces pieces;
  for (double scale = 1.0; !pieces.cut(scene, lamps_m, scale); scale *= 2.0)
    if (scale >= kLongestScale) {
      too_many_ = true;
      return;
    }
  const std::vector<Patch>& patches = pieces.patches;
  if (patches.empty()) return;
  patch_of_ = std::move(pieces.patch_of);
  boxes_m_ = std::move(pieces.boxes_m);
  tree_ = RayTree(pieces.triangles);
  pieces.triangles = {};

  constexpr std::size_t kTogether = 64;
  std::vector<glm::dvec4> lamps_lx(patches.size());
  const bool again = times == Reflected::kAll;
  std::vector<std::uint32_t> sees(again ? patches.size() * kPatchRays : 0);
  on_all_cores((patches.size() + kTogether - 1) / kTogether, [&](std::size_t part) {
    for (std::size_t i = part * kTogether; i < std::min(patches.size(), (part + 1) * kTogether); ++i) {
      const Patch& patch = patches[i];
      lamps_lx[i] = direct(patch.middle_m, patch.normal);
      if (patch.material->double_sided) lamps_lx[i] = 0.5 * (lamps_lx[i] + direct(patch.middle_m, -patch.normal));
      const glm::dmat3 frame = frame_of(patch.normal);
      const double turn = static_cast<double>(i) * std::numbers::sqrt2;  // what each is off by is not that of the next
      for (std::uint32_t k = 0; again && k < kPatchRays; ++k) {
        const double side = patch.material->double_sided && k % 2 == 1 ? -1.0 : 1.0;
        sees[i * kPatchRays + k] = seen(patch.middle_m + side * kOff_m * patch.normal,
                                        side * direction(k, kPatchRays, frame, turn, false), 0.0);
      }
    }
  });
  std::vector<glm::dvec4> next(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) next[i] = sent(*patches[i].material, lamps_lx[i]);
  sent_lx_ = next;
  for (int time = 0; again && time < kMostTimes; ++time) {
    double most = 0.0, change = 0.0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      glm::dvec4 sum(0.0);
      for (std::uint32_t k = 0; k < kPatchRays; ++k)
        if (const std::uint32_t patch = sees[i * kPatchRays + k]; patch != kNone) sum += sent_lx_[patch];
      next[i] = sent(*patches[i].material, lamps_lx[i] + sum / static_cast<double>(kPatchRays));
      most = std::max(most, next[i].w), change = std::max(change, std::abs(next[i].w - sent_lx_[i].w));
    }
    std::swap(next, sent_lx_);
    if (change <= kSettled * most) break;
  }
}

bool ReflectedLight::reaches(const glm::dvec3& point_m) const {
  return std::ranges::any_of(boxes_m_, [&](const auto& box) {
    return glm::all(glm::greaterThanEqual(point_m, box.first)) && glm::all(glm::lessThanEqual(point_m, box.second));
  });
}

std::uint32_t ReflectedLight::seen(const glm::dvec3& from_m, const glm::dvec3& along, double leave_within_m) const {
  const auto met = tree_.first_met(from_m, along, kFarthest_m, leave_within_m);
  return met && !met->from_behind ? patch_of_[met->triangle] : kNone;
}

/// A corner of a floor lies in the wall that stands there, and half of what it sees lies beyond: it is asked a little
/// beside, where the surface goes on and nothing stands.
glm::dvec3 ReflectedLight::off_corners(const glm::dvec3& point_m, const glm::dvec3& normal) const {
  constexpr int kSides = 8;
  const glm::dmat3 frame = frame_of(normal);
  const glm::dvec3 from_m = point_m + kOff_m * normal;
  glm::dvec3 free(0.0);
  for (int k = 0; k < kSides; ++k) {
    const double about = 2.0 * std::numbers::pi * (k + 0.25) / kSides;
    const glm::dvec3 way = frame * glm::dvec3(std::cos(about), std::sin(about), 0.0);
    const glm::dvec3 beside_m = from_m + kCorner_m * way;
    const auto under = tree_.first_met(beside_m, -normal, kOff_m + kCorner_m, 0.0);
    if (!under || under->from_behind) continue;  // the surface ends before
    if (const auto back = tree_.first_met(beside_m, -way, 2.0 * kCorner_m, 0.0); back && back->from_behind) continue;
    free += way;
  }
  return glm::length(free) > 1e-6 ? from_m + kCorner_m * glm::normalize(free) : from_m;
}

glm::dvec4 ReflectedLight::at(const glm::dvec3& point_m, const glm::dvec3& normal, bool of_mesh,
                              std::uint32_t ways) const {
  if (!reaches(point_m)) return glm::dvec4(0.0);
  glm::dvec3 from_m = off_corners(point_m, normal);
  if (of_mesh) from_m += tree_.left_at_m(from_m, normal, kThin_m) * normal;
  const glm::dmat3 frame = frame_of(normal);
  glm::dvec4 sum(0.0);
  const double leave_within_m = of_mesh ? kDeep_m : 0.0;
  for (std::uint32_t k = 0; k < ways; ++k) {
    const std::uint32_t patch = seen(from_m, direction(k, ways, frame, 0.0, false), leave_within_m);
    if (patch != kNone) sum += sent_lx_[patch];
  }
  return sum / static_cast<double>(ways);
}

void ReflectedLight::each_way(const glm::dvec3& point_m,
                              const std::function<void(const glm::dvec3&, const glm::dvec4&)>& arrives) const {
  if (!reaches(point_m)) return;
  for (std::uint32_t k = 0; k < kRoundRays; ++k) {
    const glm::dvec3 way = direction(k, kRoundRays, glm::dmat3(1.0), 0.0, true);
    // Luminance sent/pi over 4·pi/kRoundRays of the sphere.
    if (const std::uint32_t patch = seen(point_m, way, 0.0); patch != kNone)
      arrives(way, sent_lx_[patch] * (4.0 / kRoundRays));
  }
}

}  // namespace phare
