// unit: the tree of triangles answers as the search through all of them does.
#include "visual/scene/ray_tree.h"

#include <gtest/gtest.h>

#include <random>

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

TEST(RayTree, NothingIsFree) {
  EXPECT_FALSE(RayTree().blocked({0, 0, 0}, {1, 0, 0}, 0.0, 0.0));
  EXPECT_FALSE(RayTree(Scene{}).blocked({0, 0, 0}, {1, 0, 0}, 0.0, 0.0));
}

}  // namespace
}  // namespace phare
