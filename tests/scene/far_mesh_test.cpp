// unit: what is left out of a mesh that is seen from afar, and what stays.
#include "visual/scene/far_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace phare {
namespace {

constexpr double kFrom_m = 375.0;  // where a pixel of 1280 across 60° is 0.3 m

/// A closed box; each face has corners of its own, as a shaded box has.
void add_box(Scene& scene, const glm::vec3& low, const glm::vec3& high) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto first = static_cast<std::uint32_t>(scene.vertices.size());
      for (int corner = 0; corner < 4; ++corner) {
        glm::vec3 at, normal(0.0f);
        at[axis] = upper ? high[axis] : low[axis];
        at[u] = corner == 1 || corner == 2 ? high[u] : low[u];
        at[v] = corner >= 2 ? high[v] : low[v];
        normal[axis] = upper ? 1.0f : -1.0f;
        scene.vertices.push_back({at, normal});
      }
      for (const std::uint32_t i : upper ? std::array{0u, 1u, 2u, 0u, 2u, 3u} : std::array{0u, 2u, 1u, 0u, 3u, 2u})
        scene.indices.push_back(first + i);
    }
  }
}

SceneChunk whole(const Scene& scene) {
  SceneChunk chunk;
  chunk.index_count = static_cast<std::uint32_t>(scene.indices.size());
  chunk.vertex_count = static_cast<std::uint32_t>(scene.vertices.size());
  return chunk;
}

FarMesh from_afar(const Scene& scene, double from_m = kFrom_m) {
  return far_mesh(scene, whole(scene), kFarLevels.size() - 1, from_m);
}

/// Size of the box about a mesh.
glm::vec3 extent(const FarMesh& mesh) {
  glm::vec3 low(1e9f), high(-1e9f);
  for (const SceneVertex& vertex : mesh.vertices) {
    low = glm::min(low, vertex.position_m);
    high = glm::max(high, vertex.position_m);
  }
  return high - low;
}

TEST(FarMesh, LeavesOutWhatIsNarrowerThanAPixelAndKeepsWhatStandsBesideIt) {
  Scene scene;
  scene.materials = {{.name = "wood"}};
  add_box(scene, {0.0f, 0.0f, 0.0f}, {0.12f, 0.12f, 1.1f});  // a post
  add_box(scene, {5.0f, 0.0f, 0.0f}, {9.0f, 0.3f, 3.0f});    // a wall
  const FarMesh mesh = from_afar(scene);
  ASSERT_FALSE(mesh.vertices.empty());
  for (const SceneVertex& vertex : mesh.vertices) EXPECT_GE(vertex.position_m.x, 4.7f) << "of the post";
  EXPECT_NEAR(extent(mesh).x, 4.0f, 2 * 0.3f);
  EXPECT_NEAR(extent(mesh).z, 3.0f, 2 * 0.3f);
}

TEST(FarMesh, APostAtFortyFiveDegreesIsAsNarrowAsOneThatStandsUpright) {
  Scene upright, leaning;
  upright.materials = leaning.materials = {{.name = "wood"}};
  add_box(upright, {0.0f, 0.0f, 0.0f}, {0.12f, 0.12f, 3.0f});
  leaning = upright;
  for (SceneVertex& vertex : leaning.vertices) {
    const glm::vec3 p = vertex.position_m;
    vertex.position_m = {0.70710678f * (p.x + p.z), p.y, 0.70710678f * (p.z - p.x)};
  }
  for (const double from_m : {60.0, 140.0, 160.0, 375.0})
    EXPECT_EQ(from_afar(upright, from_m).indices.empty(), from_afar(leaning, from_m).indices.empty()) << from_m;
  EXPECT_FALSE(from_afar(upright, 140.0).indices.empty()) << "0.117 m wide on average, 0.112 m a pixel";
  EXPECT_TRUE(from_afar(upright, 160.0).indices.empty());
}

// A ball of triangles: each corner stands in six of them with a normal of each, and the simplifier moves none that has
// more than two.
TEST(FarMesh, ABodyWithFlatSidesIsSimplifiedAndStaysFlat) {
  Scene scene;
  scene.materials = {{.name = "stone"}};
  constexpr int kAround = 48, kUp = 24;
  constexpr float kPi = 3.14159265f;
  const auto at = [](int i, int j) {
    const float turn = 2.0f * kPi * static_cast<float>(i % kAround) / kAround, up = kPi * static_cast<float>(j) / kUp;
    if (j % kUp == 0) return glm::vec3(0.0f, 0.0f, std::cos(up));  // one corner at each pole
    return glm::vec3(std::sin(up) * std::cos(turn), std::sin(up) * std::sin(turn), std::cos(up));
  };
  for (int j = 0; j < kUp; ++j)
    for (int i = 0; i < kAround; ++i)
      for (const auto& corners : {std::array{at(i, j), at(i, j + 1), at(i + 1, j + 1)},
                                  std::array{at(i, j), at(i + 1, j + 1), at(i + 1, j)}}) {
        const glm::vec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::length(across) < 1e-6f) continue;  // at the poles
        for (const glm::vec3& corner : corners) {
          scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
          scene.vertices.push_back({corner, glm::normalize(across)});
        }
      }
  ASSERT_TRUE(is_flat(scene.vertices, scene.indices));
  const double from_m = 0.1 / kFarThingError_rad;  // off by 10 cm at most
  const FarMesh mesh = from_afar(scene, from_m);
  EXPECT_LT(mesh.indices.size(), scene.indices.size() / 8);
  EXPECT_GT(mesh.indices.size(), 3u * 12u);
  EXPECT_TRUE(is_flat(mesh.vertices, mesh.indices));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position_m; };
    const glm::vec3 middle = (corner(0) + corner(1) + corner(2)) / 3.0f;
    // The error is a mean over planes (Garland and Heckbert): twice of it in a triangle's middle.
    EXPECT_GT(glm::length(middle), 1.0f - 2.0f * 0.1f);
    EXPECT_GT(glm::dot(mesh.vertices[mesh.indices[i]].normal, middle), 0.0f) << "turned inside out";
  }
}

// A simplifier tells its error by planes: along a tube its corners stay near those of its sides however far they move,
// and what is thin becomes a plate.
TEST(FarMesh, ATubeKeepsItsLengthAndItsSides) {
  std::size_t fewer = 0;
  for (const bool textured : {false, true})
    for (const int sides : {4, 6, 8})
      for (const float radius_m : {0.06f, 0.12f, 0.2f, 0.4f})
        for (const glm::vec3& end_m : {glm::vec3(0.0f, 0.0f, 5.0f), {1.5f, 1.0f, 3.0f}, {4.0f, 0.5f, 0.3f}}) {
          Scene scene;
          scene.materials = {{.name = "bark"}};
          const glm::vec3 u = glm::normalize(glm::cross(end_m, glm::vec3(0.3f, 1.0f, 0.1f)));
          const glm::vec3 v = glm::normalize(glm::cross(end_m, u));
          const auto at = [&](int i, int j) {
            const float turn = 2.0f * 3.14159265f * static_cast<float>(i % sides) / static_cast<float>(sides);
            return static_cast<float>(j) * end_m +
                   radius_m * (1.0f - 0.6f * static_cast<float>(j)) * (std::cos(turn) * u + std::sin(turn) * v);
          };
          for (int i = 0; i < sides; ++i)
            if (textured)  // round, its corners shared
              for (int j = 0; j < 2; ++j)
                scene.vertices.push_back({at(i, j), glm::normalize(at(i, j) - static_cast<float>(j) * end_m)});
            else
              for (const auto& corners :
                   {std::array{at(i, 0), at(i + 1, 0), at(i + 1, 1)}, std::array{at(i, 0), at(i + 1, 1), at(i, 1)}}) {
                const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
                for (const glm::vec3& corner : corners) {
                  scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
                  scene.vertices.push_back({corner, normal});
                }
              }
          SceneChunk chunk = whole(scene);
          if (textured) {
            const auto around = static_cast<std::uint32_t>(2 * sides);
            for (std::uint32_t i = 0; i < around; i += 2)
              for (const std::uint32_t corner : {i, i + 2, i + 3, i, i + 3, i + 1})
                scene.indices.push_back(corner % around);
            chunk = whole(scene);
            chunk.first_look = 0;
            scene.looks.resize(scene.vertices.size());
          }
          struct Shape {
            glm::vec3 low{1e9f}, high{-1e9f}, area{0.0f};
            float area_m2 = 0.0f;
          };
          const auto shape_of = [](const auto& mesh) {
            Shape shape;
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
              const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position_m; };
              for (std::size_t k = 0; k < 3; ++k)
                shape.low = glm::min(shape.low, corner(k)), shape.high = glm::max(shape.high, corner(k));
              const glm::vec3 area = 0.5f * glm::cross(corner(1) - corner(0), corner(2) - corner(0));
              shape.area += area, shape.area_m2 += glm::length(area);
            }
            return shape;
          };
          const Shape all = shape_of(scene);
          for (double from_m = 20.0; from_m < 400.0; from_m *= 1.3) {
            const FarMesh mesh = far_mesh(scene, chunk, kFarLevels.size() - 1, from_m);
            if (mesh.indices.empty()) break;  // narrower than a pixel
            fewer += mesh.indices.size() < scene.indices.size() ? 1 : 0;
            const Shape far = shape_of(mesh);
            const glm::vec3 off = glm::max(far.low - all.low, all.high - far.high);
            const auto error_m = static_cast<float>(kFarThingError_rad * from_m);
            EXPECT_LE(std::max({off.x, off.y, off.z}), error_m)
                << sides << " sides, " << radius_m << " m, from " << from_m;
            // What it shows of itself changes by less than a pixel wide strip along it.
            EXPECT_LE(glm::length(far.area - all.area), error_m * glm::length(all.high - all.low))
                << sides << " sides, " << radius_m << " m, from " << from_m;
          }
        }
  EXPECT_GT(fewer, 0u);
}

TEST(FarMesh, APlateThatIsSeenFromOneSideOnlyCountsByItsHalf) {
  Scene scene;
  scene.materials = {{.name = "board"}};
  for (const glm::vec3 corner : {glm::vec3{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}})
    scene.vertices.push_back({corner, {-1, 0, 0}});
  scene.indices = {0, 1, 2, 0, 2, 3};
  // 1 m² over its diagonal, halved: 0.354 m.
  EXPECT_EQ(from_afar(scene, 0.35 / kFarThingWidth_rad).indices.size(), 6u);
  EXPECT_TRUE(from_afar(scene, 0.36 / kFarThingWidth_rad).indices.empty());
}

/// Squares of 4 m, ten each way, as high as `height` says.
Scene meadow(float (*height)(int x, int y)) {
  Scene scene;
  scene.materials = {{.name = "meadow", .surface = Surface::kGrass}};
  for (int x = 0; x <= 10; ++x)
    for (int y = 0; y <= 10; ++y)
      scene.vertices.push_back({{4.0f * static_cast<float>(x), 4.0f * static_cast<float>(y), height(x, y)}, {0, 0, 1}});
  for (std::uint32_t x = 0; x < 10; ++x)
    for (std::uint32_t y = 0; y < 10; ++y) {
      const std::uint32_t i = 11 * x + y;
      for (const std::uint32_t corner : {i, i + 11, i + 12, i, i + 12, i + 1}) scene.indices.push_back(corner);
    }
  return scene;
}

// It sends light back too, and is no point of light: of a plane of a hundred squares its sides stay, and little within.
TEST(FarMesh, RoughGroundIsSimplifiedLikeSmoothGround) {
  Scene scene = meadow([](int, int) { return 0.0f; });
  const std::size_t smooth = from_afar(scene).indices.size();
  EXPECT_LT(smooth, scene.indices.size() / 4);
  scene.materials[0].retro.kind = RetroKind::kFacets;
  EXPECT_EQ(from_afar(scene).indices.size(), smooth);
}

// Else one would see between it and the ground beside it, which is simplified by itself or not at all.
TEST(FarMesh, GroundKeepsItsSides) {
  const Scene scene = meadow([](int x, int y) { return 0.01f * static_cast<float>(x * y % 3); });
  const FarMesh far = from_afar(scene);
  EXPECT_LT(far.indices.size(), scene.indices.size() / 2);
  for (const SceneVertex& vertex : scene.vertices) {
    const glm::vec3 p = vertex.position_m;
    if (p.x > 0.0f && p.x < 40.0f && p.y > 0.0f && p.y < 40.0f) continue;
    EXPECT_TRUE(std::ranges::any_of(far.indices, [&](std::uint32_t i) { return far.vertices[i].position_m == p; }))
        << p.x << ' ' << p.y;
  }
}

// A lump of leaves hides what is in it, from afar too: it is closed. Leaves are thinned, though their material is seen
// from one side alone, as a file's is that does not say otherwise: narrower than a pixel, they are not left out.
TEST(FarMesh, ClosedFoliageStaysClosed) {
  Scene scene;
  scene.materials = {{.name = "lump", .surface = Surface::kFoliage}};
  add_box(scene, {0, 0, 0}, {4, 4, 4});
  const auto area_vector = [](const FarMesh& mesh) {
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position_m; };
      sum += glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    }
    return glm::length(sum);
  };
  const FarMesh lump = from_afar(scene);
  EXPECT_EQ(lump.indices.size(), scene.indices.size());
  EXPECT_LT(area_vector(lump), 1e-4f);
  scene.materials[0].double_sided = true;
  EXPECT_EQ(from_afar(scene).indices.size(), scene.indices.size()) << "as large as leaves become, 8 m² of 9.6 m²";
  for (SceneVertex& vertex : scene.vertices) vertex.position_m *= 0.1f;
  EXPECT_LT(from_afar(scene).indices.size(), scene.indices.size());

  Scene leaves;
  leaves.materials = {{.name = "leaves", .surface = Surface::kFoliage}};  // of 0.02 m², the smaller the more for one
  const std::uint32_t count = 10 * kFarLevels.back().leaves_per_leaf;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float x = 0.5f * static_cast<float>(i);
    for (const glm::vec3 corner : {glm::vec3(x, 0, 0), {x + 0.2f, 0, 0}, {x, 0, 0.2f}})
      leaves.indices.push_back(static_cast<std::uint32_t>(leaves.vertices.size())),
          leaves.vertices.push_back({corner, {0, -1, 0}});
  }
  EXPECT_EQ(from_afar(leaves).indices.size(), std::size_t{3 * 10});
}

// The smaller leaves are the more of them become one, up to the level's bound; their area stays.
TEST(FarMesh, LeavesAreThinnedByTheirSize) {
  for (const float side_m : {0.1f, 0.5f, 1.0f, 3.0f}) {
    Scene leaves;
    leaves.materials = {{.name = "leaves", .surface = Surface::kFoliage}};
    for (std::uint32_t i = 0; i < 1000; ++i)
      for (const glm::vec3 corner : {glm::vec3(0, 0, 0), {side_m, 0, 0}, {0, 0, side_m}}) {
        leaves.indices.push_back(static_cast<std::uint32_t>(leaves.vertices.size()));
        leaves.vertices.push_back({corner + glm::vec3(static_cast<float>(i), 0, 0), {0, -1, 0}});
      }
    const double leaf_m2 = 0.5 * static_cast<double>(side_m) * static_cast<double>(side_m);
    for (std::size_t level = 0; level < kFarLevels.size(); ++level) {
      const FarMesh far = far_mesh(leaves, whole(leaves), level, kFrom_m);
      const double stay = static_cast<double>(far.indices.size()) / 3.0, of = 1000.0 / stay;
      const double most = kFarLevels[level].leaves_per_leaf, wanted = kFarLevels[level].leaf_m2 / leaf_m2;
      // Half a leaf of rounding; the last of a thousand may stand for fewer, up to 96 of them.
      EXPECT_LE(of, std::clamp(wanted + 0.5, 1.0, most)) << side_m << " m at level " << level;
      EXPECT_GE(1.1 * of, std::min(wanted - 0.5, most)) << side_m << " m at level " << level;
      double area_m2 = 0.0;
      for (std::size_t i = 0; i + 2 < far.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return far.vertices[far.indices[i + k]].position_m; };
        area_m2 += 0.5 * static_cast<double>(glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))));
      }
      EXPECT_NEAR(area_m2 / (1000.0 * leaf_m2), 1.0, std::ceil(of) / 1000.0 + 1e-3)
          << side_m << " m at level " << level;
    }
  }
}

TEST(FarMesh, KeepsEveryReflectorHoweverSmall) {
  Scene scene;
  scene.materials = {{.name = "reflector"}};
  scene.materials[0].retro.kind = RetroKind::kSheeting;
  add_box(scene, {0.0f, 0.0f, 0.0f}, {0.01f, 0.05f, 0.18f});
  EXPECT_EQ(from_afar(scene).indices.size(), scene.indices.size());
}

TEST(FarMesh, LooksStayWithTheirCorners) {
  Scene scene;
  scene.materials = {{.name = "wall"}};
  add_box(scene, {0, 0, 0}, {40, 30, 20});
  SceneChunk chunk = whole(scene);
  chunk.first_look = 0;
  for (const SceneVertex& vertex : scene.vertices)
    scene.looks.push_back({{vertex.position_m.x + vertex.normal.x, vertex.position_m.y + vertex.normal.y}});
  const FarMesh far = far_mesh(scene, chunk, kFarLevels.size() - 1, kFrom_m);
  ASSERT_FALSE(far.indices.empty());
  ASSERT_EQ(far.looks.size(), far.vertices.size());
  for (std::size_t i = 0; i < far.vertices.size(); ++i) {
    const SceneVertex& vertex = far.vertices[i];
    EXPECT_EQ(far.looks[i].uv,
              glm::vec2(vertex.position_m.x + vertex.normal.x, vertex.position_m.y + vertex.normal.y));
  }
}

}  // namespace
}  // namespace phare
