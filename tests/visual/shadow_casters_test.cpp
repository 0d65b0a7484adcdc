// unit: what casts shadows into a view, and by which of its meshes.
#include "visual/shadow_casters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "shaders/lamps.h"
#include "visual/caster_grid.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/scene/far_mesh.h"

namespace phare {
namespace {

using Corners = std::array<glm::vec3, 3>;

Scene scene_of(const std::vector<Corners>& triangles) {
  Scene scene;
  scene.materials = {{.name = "leaf", .double_sided = true}};
  for (const Corners& triangle : triangles) {
    SceneChunk chunk;
    chunk.low_m = chunk.high_m = triangle[0];
    chunk.index_count = chunk.vertex_count = 3;
    chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
    chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
    for (std::uint32_t k = 0; k < 3; ++k) {
      scene.vertices.push_back({triangle[k], glm::vec3(0.0f, 0.0f, 1.0f)});
      scene.indices.push_back(k);
      chunk.low_m = glm::min(chunk.low_m, glm::dvec3(triangle[k]));
      chunk.high_m = glm::max(chunk.high_m, glm::dvec3(triangle[k]));
    }
    scene.chunks.push_back(chunk);
  }
  return scene;
}

/// Does the way from `from` to `to` go through it? (Möller and Trumbore 1997)
bool stands_between(const glm::dvec3& from, const glm::dvec3& to, const Corners& triangle) {
  const glm::dvec3 a = triangle[0], ab = glm::dvec3(triangle[1]) - a, ac = glm::dvec3(triangle[2]) - a, way = to - from;
  const glm::dvec3 p = glm::cross(way, ac);
  const double determinant = glm::dot(ab, p);
  if (std::abs(determinant) < 1e-12) return false;
  const glm::dvec3 s = from - a, q = glm::cross(s, ab);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(way, q) / determinant;
  const double at = glm::dot(ac, q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at > 1e-6 && at < 1.0 - 1e-6;
}

// Of the triangles that hide the lamp from a point in view none is left out, whatever view it is; of the others many
// are.
TEST(ShadowCasters, NoneIsLeftOutWhoseShadowFallsIntoTheView) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const auto anywhere = [&](double size_m) { return size_m * glm::dvec3(even(random), even(random), even(random)); };
  std::size_t hidden = 0, kept = 0, all = 0;
  for (int round = 0; round < 60; ++round) {
    const glm::dvec3 lamp_m{2.0, 0.6, 0.65};
    Camera camera{.eye_m = {even(random), even(random), 1.2 + even(random)},
                  .world_from_eye = aim_rotation(1.5 * even(random), 0.4 * even(random), 0.2 * even(random)),
                  .fov_horizontal_rad = 0.3 + 0.8 * std::abs(even(random))};
    if (round % 5 == 4) camera.orthographic_width_m = 40.0;
    const ViewGeometry view(camera, 16.0 / 9.0);
    const glm::dmat3 lamp_turn = aim_rotation(0.6 * even(random), 0.0, 0.0);
    std::vector<Corners> triangles;
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 at = lamp_m + lamp_turn * (glm::dvec3(40.0, 0.0, 0.0) + anywhere(38.0));
      triangles.push_back({glm::vec3(at), glm::vec3(at + anywhere(3.0)), glm::vec3(at + anywhere(3.0))});
    }
    const ShadowCasters casters(scene_of(triangles));
    const LampReach reach(lamp_m, lamp_turn, {{1.0, 0.0, 0.0}, 1.2});
    const CastBy anywhere_cast = casters.by(reach, lamp_turn);
    const CastBy cast = casters.by(reach, lamp_turn, {}, SIZE_MAX, {.view = &view});
    all += anywhere_cast.count, kept += cast.count;
    for (int point = 0; point < 2000; ++point) {
      const Ray ray = view.ray_through(static_cast<double>(random() % 1600), static_cast<double>(random() % 900), 1600, 900);
      const glm::dvec3 seen_m = ray.origin_m + (1.0 + 80.0 * std::abs(even(random))) * ray.direction;
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (!anywhere_cast.count || !anywhere_cast.chunks[i] || !stands_between(lamp_m, seen_m, triangles[i])) continue;
        ++hidden;
        ASSERT_TRUE(cast.count > 0 && cast.chunks[i]) << "round " << round << ", triangle " << i;
        const glm::dvec3 at = glm::transpose(lamp_turn) * (seen_m - lamp_m);
        if (glm::length(glm::dvec2(at.y, at.z)) > std::tan(1.2) * at.x || std::abs(at.z) > kHighestShadow * at.x)
          continue;
        constexpr double kRounding = 1e-5;
        ASSERT_TRUE(at.y > cast.part.right * at.x - kRounding && at.y < cast.part.left * at.x + kRounding &&
                    at.z > cast.part.low * at.x - kRounding && at.z < cast.part.high * at.x + kRounding)
            << "round " << round << ": the map does not hold " << at.y / at.x << ", " << at.z / at.x;
      }
    }
  }
  EXPECT_GT(hidden, 1000u) << "points that something hides";
  EXPECT_LT(kept, all * 3 / 4) << "nothing was left out";
}

// A wall that runs past the car: what of it stands beside the lamp shades nothing that the driver sees.
TEST(ShadowCasters, AMapIsAsWideAsWhatShadesTheView) {
  const std::vector<Corners> wall{{glm::vec3(-40, 6, 0), glm::vec3(60, 6, 0), glm::vec3(60, 6, 4)},
                                  {glm::vec3(-40, 6, 0), glm::vec3(60, 6, 4), glm::vec3(-40, 6, 4)}};
  const ShadowCasters casters(scene_of(wall));
  const LampReach reach({2.0, 0.6, 0.65}, glm::dmat3(1.0), {{1.0, 0.0, 0.0}, 1.4});
  const ViewGeometry view({.eye_m = {0.0, 0.3, 1.2}}, 16.0 / 9.0);
  EXPECT_DOUBLE_EQ(casters.by(reach, glm::dmat3(1.0)).part.left, kWidestShadow);
  const CastBy cast = casters.by(reach, glm::dmat3(1.0), {}, SIZE_MAX, {.view = &view});
  ASSERT_EQ(cast.count, 2u);
  // Where the left edge of the view of 60 degrees meets the wall.
  const double from_eye_m = (6.0 - 0.3) / std::tan(std::numbers::pi / 6.0);
  EXPECT_NEAR(cast.part.left, (6.0 - 0.6) / (from_eye_m - 2.0), 0.1);
}

// What a lamp's last light falls on casts nothing where that is asked for: by how much light comes so far, and there.
TEST(ShadowCasters, WhatStandsInFaintLightCastsNothing) {
  // 100 cd above the axis, 10,000 below it.
  IntensityTable table;
  table.first_deg = {-60.0, 60.0}, table.second_deg = {-30.0, -1.0, 0.0, 30.0};
  table.candela = {1e4, 1e4, 1e4, 1e4, 100.0, 100.0, 100.0, 100.0};
  const AimedSource source{.table = &table};
  const BeamImage image = compose_beam_image(std::span(&source, 1));
  LightPeaks peaks;
  peaks.set(image);
  const LampReach reach({0.0, 0.0, 0.0}, glm::dmat3(1.0), light_cone(image));
  const auto cast = [&](float x_m, float z_m, double faint_lx) {
    const std::vector<Corners> one{{glm::vec3(x_m, -1, z_m), glm::vec3(x_m, 1, z_m), glm::vec3(x_m, 0, z_m + 1)}};
    return ShadowCasters(scene_of(one))
        .by(reach, glm::dmat3(1.0), {}, SIZE_MAX, {.faint_lx = faint_lx, .peaks = &peaks})
        .count;
  };
  // 100 cd are 0.01 lx at 100 m; there a metre is more than the bound is coarse by.
  EXPECT_EQ(cast(95.0f, 20.0f, 0.01), 1u);
  EXPECT_EQ(cast(105.0f, 20.0f, 0.01), 0u);
  EXPECT_EQ(cast(105.0f, 20.0f, 0.0), 1u) << "all casts where nothing is too faint";
  EXPECT_EQ(cast(105.0f, -20.0f, 0.01), 1u) << "in the bright part of the beam";
  EXPECT_EQ(cast(105.0f, -0.5f, 0.01), 1u) << "from the bright part into the faint";
}

// Of many triangles parts are worked on at once: the same casts as of each third alone, few enough to be one part.
TEST(ShadowCasters, InPartsAreWhatTheyAreInOne) {
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const auto anywhere = [&](double size_m) { return size_m * glm::dvec3(even(random), even(random), even(random)); };
  const glm::dvec3 lamp_m{2.0, 0.6, 0.65};
  const glm::dmat3 turn = aim_rotation(0.1, -0.02, 0.0);
  constexpr std::size_t kThird = 5000;
  std::vector<Corners> triangles;
  while (triangles.size() < 3 * kThird) {
    const double far_m = 3.0 + 40.0 * std::abs(even(random));
    const glm::dvec3 at = lamp_m + turn * glm::dvec3(far_m, 0.6 * far_m * even(random), 0.2 * far_m * even(random));
    triangles.push_back({glm::vec3(at), glm::vec3(at + anywhere(0.1)), glm::vec3(at + anywhere(0.1))});
  }
  ASSERT_GT(parts_of_casters(3 * kThird), 1u);
  ASSERT_EQ(parts_of_casters(kThird), 1u);
  const auto cast_by = [&](const std::vector<Corners>& some) {
    return ShadowCasters(scene_of(some)).by(LampReach(lamp_m, turn, {{1.0, 0.0, 0.0}, 1.3}), turn);
  };
  const CastBy all = cast_by(triangles);
  const glm::dvec2 half = half_sides(all.part), texel = half / glm::dvec2(255.0, 127.0);
  const CasterGrid grid(all, half, texel, 4.0);
  std::vector<CasterGrid> of_thirds;
  std::vector<glm::vec3> corners;
  std::size_t count = 0;
  for (std::size_t third = 0; third < 3; ++third) {
    const auto begin = triangles.begin() + static_cast<std::ptrdiff_t>(third * kThird);
    const CastBy cast = cast_by({begin, begin + kThird});
    count += cast.count;
    corners.insert(corners.end(), cast.both_sides.corners.begin(), cast.both_sides.corners.end());
    of_thirds.emplace_back(cast, half, texel, 4.0);
  }
  EXPECT_EQ(all.count, count);
  EXPECT_GT(count, 10'000u);
  EXPECT_EQ(all.both_sides.corners, corners);
  std::size_t clear = 0;
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 middle_m =
        lamp_m + turn * glm::dvec3(25.0 + 24.0 * even(random), 15.0 * even(random), 3.0 * even(random));
    const glm::dvec3 half_m = glm::abs(anywhere(0.3));
    const BoxCorners box = box_corners(glm::transpose(turn), lamp_m, middle_m - half_m, middle_m + half_m);
    const bool told = grid.may_shade(box);
    ASSERT_EQ(told, std::ranges::any_of(of_thirds, [&](const CasterGrid& of) { return of.may_shade(box); })) << i;
    clear += told ? 0 : 1;
  }
  EXPECT_GT(clear, 100u);
  EXPECT_LT(clear, 19'900u);
}

// A box that something shades is never told clear, wherever it and what casts are; most boxes before and beside it are.
TEST(CasterGrid, NoBoxIsClearOnWhichAShadowFalls) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const auto anywhere = [&](double size_m) { return size_m * glm::dvec3(even(random), even(random), even(random)); };
  std::size_t clear = 0, boxes = 0, low = 0, clear_low = 0;
  for (int round = 0; round < 80; ++round) {
    const glm::dvec3 lamp_m{2.0, 0.6, 0.65};
    const glm::dmat3 turn = aim_rotation(0.6 * even(random), 0.1 * even(random), 0.0);
    std::vector<Corners> triangles;
    for (int i = 0; i < 12; ++i) {
      const double far_m = 3.0 + 40.0 * std::abs(even(random)), size_m = round % 4 == 3 ? 30.0 : 2.0;
      const glm::dvec3 at = lamp_m + turn * glm::dvec3(far_m, 0.6 * far_m * even(random), 0.2 * far_m * even(random));
      triangles.push_back({glm::vec3(at), glm::vec3(at + anywhere(size_m)), glm::vec3(at + anywhere(size_m))});
    }
    const CastBy cast = ShadowCasters(scene_of(triangles)).by(LampReach(lamp_m, turn, {{1.0, 0.0, 0.0}, 1.3}), turn);
    if (cast.count == 0) continue;
    const glm::dvec2 half = half_sides(cast.part);
    const glm::dvec2 texel = half / glm::dvec2(255.0, 127.0);
    const double zoom = round % 2 == 0 ? 4.0 : 2.0;
    const CasterGrid grid(cast, half, texel, zoom);
    for (int i = 0; i < 1500; ++i) {
      // Some hold the lamp or reach past it.
      const glm::dvec3 middle_m =
          lamp_m + turn * glm::dvec3(25.0 + 26.0 * even(random), 15.0 * even(random), 3.0 * even(random));
      const glm::dvec3 half_m = glm::abs(anywhere(i % 10 == 0 ? 12.0 : 1.5));
      ++boxes;
      const bool told = grid.may_shade(box_corners(glm::transpose(turn), lamp_m, middle_m - half_m, middle_m + half_m));
      clear += told ? 0 : 1;
      if ((glm::transpose(turn) * (middle_m - lamp_m)).z < 0.0) ++low, clear_low += told ? 0 : 1;
      if (told) continue;
      for (int point = 0; point < 40; ++point) {
        glm::dvec3 in_box(even(random), even(random), even(random));
        if (point % 2 == 0) in_box = glm::sign(in_box);  // a corner
        const glm::dvec3 at_m = middle_m + half_m * in_box;
        const glm::dvec3 at = glm::transpose(turn) * (at_m - lamp_m);
        if (at.x < 0.05 || std::abs(at.y) > half.x * at.x || std::abs(at.z) > half.y * at.x) continue;
        // The texels about the point are weighed with its own (shaders/lib/shadow.glsl): those of the second picture in
        // the middle, both ways.
        const bool close = zoom * std::abs(at.y) < half.x * at.x && zoom * std::abs(at.z) < half.y * at.x;
        for (const double across : {-1.0, 0.0, 1.0})
          for (const double up : {-1.0, 0.0, 1.5}) {
            const glm::dvec2 beside = glm::dvec2(across, up) * texel * (close ? 1.0 / zoom : 1.0) * at.x;
            const glm::dvec3 to_read_m = turn * (at + glm::dvec3(0.0, beside)), read_m = lamp_m + to_read_m;
            const glm::dvec3 from_m = lamp_m + to_read_m * (static_cast<double>(shader::kShadowNear_m) / at.x);
            for (const Corners& triangle : triangles)  // a map holds nothing that is nearer
              ASSERT_FALSE(stands_between(from_m, read_m, triangle))
                  << "round " << round << ", box " << i << " at " << at.x << ", " << at.y << ", " << at.z;
          }
      }
    }
  }
  EXPECT_GT(boxes, 20'000u);
  // High above the axis the grid keeps one number for all.
  EXPECT_GT(clear_low, low / 3);
  EXPECT_LT(clear, boxes);
}

TEST(ShadowCasters, WhatIsFarCastsByItsFarMesh) {
  const std::vector<Corners> near_and_far{{{{20, -1, 0}, {20, 1, 0}, {20, 0, 2}}}, {{{200, -1, 0}, {200, 1, 0}, {200, 0, 2}}}};
  // In place of the triangle: nothing at the first level, two triangles at the second.
  FarCasters far(3);
  far[0].emplace();
  far[1] = {.corners_m = {{200, -1, 0}, {200, 1, 0}, {200, 0, 1}, {200, 0, 2}}, .indices = {0, 1, 2, 0, 1, 3}};
  const ShadowCasters casters(scene_of(near_and_far), {}, {far, far});
  const LampReach reach({0.0, 0.0, 0.65}, glm::dmat3(1.0), {{1.0, 0.0, 0.0}, 1.2});
  const auto triangles = [&](double far_from_m) {
    return casters.by(reach, glm::dmat3(1.0), {}, SIZE_MAX, {.far_from_m = far_from_m}).both_sides.bounds.size();
  };
  EXPECT_EQ(triangles(std::numeric_limits<double>::infinity()), 2u);
  EXPECT_EQ(triangles(300.0), 3u) << "beyond " << kFarLevels[1].from << " times as far: the second level";
  EXPECT_EQ(triangles(600.0), 1u) << "between both: the first";
  EXPECT_EQ(triangles(2000.0), 2u);
  EXPECT_EQ(triangles(150.0), 3u) << "beyond the third level, which is the mesh before";
}

// The far slope of a ditch runs past the lamps, and the road beside them lies nearer to the axis than it: nothing
// shades it.
TEST(CasterGrid, WhatRunsPastTheLampLeavesTheRoadBeforeItClear) {
  const std::vector<Corners> slope{{glm::vec3(-3, -7, 0), glm::vec3(5, -7, 0), glm::vec3(5, -6.5, -0.5)}};
  const glm::dvec3 lamp_m{0.0, 0.0, 0.65};
  const CastBy cast =
      ShadowCasters(scene_of(slope)).by(LampReach(lamp_m, glm::dmat3(1.0), {{1.0, 0.0, 0.0}, 1.3}), glm::dmat3(1.0));
  ASSERT_EQ(cast.count, 1u);
  const glm::dvec2 half = half_sides(cast.part);
  const CasterGrid grid(cast, half, half / glm::dvec2(255.0, 127.0), 2.0);
  const auto may_shade = [&](const glm::dvec3& low_m, const glm::dvec3& high_m) {
    return grid.may_shade(box_corners(glm::dmat3(1.0), lamp_m, low_m, high_m));
  };
  EXPECT_FALSE(may_shade({-1.0, -3.5, -0.02}, {4.0, 1.7, 0.02})) << "the lane";
  EXPECT_TRUE(may_shade({4.0, -12.0, -0.5}, {6.0, -9.0, 0.0})) << "ground behind the slope";
}

}  // namespace
}  // namespace phare
