// unit: the tree of triangles answers as the search through all of them does.
#include "visual/scene/ray_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <vector>

#include "config/base/paths.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

TEST(RayTree, AnswersAsTheSearchThroughAllTriangles) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/town.glb");
  ASSERT_TRUE(scene) << scene.error().text();
  const RayTree tree(*scene);
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> along(0.0, 120.0), across(-12.0, 12.0), up(0.05, 9.0);
  int hidden = 0;
  constexpr int kRays = 400;
  for (int i = 0; i < kRays; ++i) {
    const glm::dvec3 point_m{along(random), across(random), up(random)},
        lamp_m{along(random), across(random), up(random)};
    const bool blocked = tree.blocked(point_m, lamp_m, 1e-3, 1e-3);
    EXPECT_EQ(blocked, occluder(*scene, lamp_m, point_m) != nullptr) << i;
    hidden += blocked ? 1 : 0;
  }
  EXPECT_GT(hidden, kRays / 10);
  EXPECT_LT(hidden, kRays * 9 / 10);
}

TEST(RayTree, TheFirstThatIsMetIsTheNearestOfAll) {
  std::mt19937_64 random(1968);
  std::uniform_real_distribution<double> place(-5.0, 5.0), side(-1.0, 1.0);
  const auto vector = [&](auto& of) { return glm::dvec3(of(random), of(random), of(random)); };
  std::vector<RayTree::Triangle> all;
  for (int i = 0; i < 300; ++i) all.push_back({vector(place), vector(side), vector(side), i % 3 != 0});
  const RayTree tree(all);
  std::vector<RayTree> alone;
  for (const RayTree::Triangle& triangle : all) alone.emplace_back(std::vector{triangle});
  int met = 0, from_behind = 0;
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 from_m = vector(place), along = glm::normalize(vector(side));
    const double most_m = i % 2 == 0 ? 30.0 : 4.0, leave_m = i % 5 == 0 ? 2.0 : 0.0;
    std::optional<RayTree::Met> nearest;
    for (std::uint32_t k = 0; k < all.size(); ++k)
      if (const auto one = alone[k].first_met(from_m, along, most_m, leave_m);
          one && (!nearest || one->at_m < nearest->at_m))
        nearest = {one->at_m, one->from_behind, k};
    const auto first = tree.first_met(from_m, along, most_m, leave_m);
    ASSERT_EQ(first.has_value(), nearest.has_value()) << i;
    if (!first) continue;
    EXPECT_EQ(first->triangle, nearest->triangle) << i;
    EXPECT_EQ(first->at_m, nearest->at_m) << i;
    EXPECT_EQ(first->from_behind, nearest->from_behind) << i;
    EXPECT_FALSE(first->from_behind && (all[first->triangle].one_sided ? first->at_m <= leave_m : true)) << i;
    ++met, from_behind += first->from_behind ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_GT(from_behind, 10);
}

/// A box of 0.2 m about (0, 0, 1), its faces looking outward; `both`: seen from both sides.
Scene box(bool both) {
  Scene scene;
  scene.materials = {{.name = "box", .double_sided = both}};
  for (int i = 0; i < 8; ++i)
    scene.vertices.push_back({{i & 1 ? 0.1f : -0.1f, i & 2 ? 0.1f : -0.1f, i & 4 ? 1.1f : 0.9f}, {0, 0, 1}});
  for (const auto& f : {std::array{0u, 2u, 3u, 1u}, {4u, 5u, 7u, 6u}, {0u, 1u, 5u, 4u}, {2u, 6u, 7u, 3u},
                        {0u, 4u, 6u, 2u}, {1u, 3u, 7u, 5u}})
    scene.indices.insert(scene.indices.end(), {f[0], f[1], f[2], f[0], f[2], f[3]});
  scene.chunks = {{.node = "box", .low_m = {-0.1, -0.1, 0.9}, .high_m = {0.1, 0.1, 1.1}, .index_count = 36,
                   .vertex_count = 8}};
  return scene;
}

TEST(RayTree, WhatAPointLiesInIsLeftThroughItsBack) {
  const RayTree tree(box(false)), seen_from_both(box(true));
  const glm::dvec3 inside(0.01, 0.02, 1.0), outside(0.01, 0.02, 2.0), below(0.01, 0.02, 0.5);
  EXPECT_TRUE(tree.blocked(inside, outside, 1e-3, 0.0));
  EXPECT_FALSE(tree.blocked(inside, outside, 1e-3, 0.0, 0.15));
  EXPECT_TRUE(tree.blocked(inside, outside, 1e-3, 0.0, 0.05)) << "its back is 0.1 m away";
  EXPECT_TRUE(seen_from_both.blocked(inside, outside, 1e-3, 0.0, 0.15)) << "that has no back";
  EXPECT_TRUE(tree.blocked(below, outside, 1e-3, 0.0, 2.0)) << "its front stands in the way";
  EXPECT_NEAR(tree.left_at_m(inside, {0, 0, 1}, 0.5), 0.1, 1e-6);
  EXPECT_NEAR(tree.left_at_m(below, {0, 0, 1}, 2.0), 0.6, 1e-6);
  EXPECT_EQ(tree.left_at_m(inside, {0, 0, 1}, 0.05), 0.0);
  EXPECT_EQ(seen_from_both.left_at_m(inside, {0, 0, 1}, 0.5), 0.0);
}

TEST(RayTree, ARayInAFaceOfABoxMeetsWhatItsEdgeMeets) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double tip : {0.0, 2.0}) {  // the edge lies in the high face, in the low one
      const auto turned = [&](double x, double y, double z) {
        const std::array<double, 3> at{x, y, z};
        return glm::dvec3(at[(3 - axis) % 3], at[(4 - axis) % 3], at[(5 - axis) % 3]);
      };
      const RayTree tree(
          std::vector<RayTree::Triangle>{{turned(5, 0, tip), turned(0, -1, 1 - tip), turned(0, 1, 1 - tip)}});
      const glm::dvec3 here = turned(0, 0, 1), there = turned(10, 0, 1);
      EXPECT_TRUE(tree.blocked(here, there, 0.0, 0.0)) << axis << ' ' << tip;
      EXPECT_TRUE(tree.blocked(there, here, 0.0, 0.0)) << axis << ' ' << tip;
    }
}

TEST(RayTree, NothingIsFree) {
  EXPECT_FALSE(RayTree().blocked({0, 0, 0}, {1, 0, 0}, 0.0, 0.0));
  EXPECT_FALSE(RayTree(Scene{}).blocked({0, 0, 0}, {1, 0, 0}, 0.0, 0.0));
}

}  // namespace
}  // namespace phare
