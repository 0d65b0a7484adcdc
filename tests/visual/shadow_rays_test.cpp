// Shadows by rays: against rays in float64 on the processor, at random points and in the shipped scene; of what moves;
// soft edges against an integral over the lamp's opening; and that nothing is left of them when they are not asked for.
#include "visual/passes/shadow_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "config/base/paths.h"
#include "shaders/lib/opening.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/effects_of_frame.h"
#include "visual/passes/shadows.h"
#include "visual/renderer.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

constexpr std::size_t kLens = kRayShadows + 1;

void add_triangle(Scene& scene, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::vec3 normal(glm::normalize(glm::cross(b - a, c - a)));
  for (const glm::dvec3& corner : {a, b, c}) {
    scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
    scene.vertices.push_back({glm::vec3(corner), normal});
  }
}

void add_quad(Scene& scene, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  add_triangle(scene, a, b, c);
  add_triangle(scene, a, c, d);
}

void add_box(Scene& scene, const glm::dvec3& low, const glm::dvec3& high) {
  const auto at = [&](int i) {
    return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  };
  add_quad(scene, at(0), at(4), at(6), at(2));
  add_quad(scene, at(1), at(3), at(7), at(5));
  add_quad(scene, at(0), at(1), at(5), at(4));
  add_quad(scene, at(2), at(6), at(7), at(3));
  add_quad(scene, at(0), at(2), at(3), at(1));
  add_quad(scene, at(4), at(5), at(7), at(6));
}

/// Of its triangles one chunk, about `origin_m` in the world.
void close_scene(Scene& scene, const glm::dvec3& origin_m = glm::dvec3(0.0)) {
  scene.materials = {{.name = "grey", .double_sided = true}};
  SceneChunk chunk{.node = "shape", .origin_m = origin_m, .low_m = glm::dvec3(1e12), .high_m = glm::dvec3(-1e12)};
  for (const SceneVertex& vertex : scene.vertices) {
    chunk.low_m = glm::min(chunk.low_m, origin_m + glm::dvec3(vertex.position_m));
    chunk.high_m = glm::max(chunk.high_m, origin_m + glm::dvec3(vertex.position_m));
  }
  chunk.index_count = static_cast<std::uint32_t>(scene.indices.size());
  chunk.vertex_count = static_cast<std::uint32_t>(scene.vertices.size());
  scene.chunks = {chunk};
}

/// Whether an edge is so near that float32 may decide otherwise. Places are good to 4e-6 m, and shares of a triangle's
/// sides to some 1e-6 of sides of up to 10 m: a ray turned by `hair_m` at an end tells.
bool near_an_edge(const World& world, const glm::dvec3& lamp_m, const glm::dvec3& point_m, bool hidden) {
  constexpr double hair_m = 5e-5;
  for (int axis = 0; axis < 3; ++axis)
    for (const double step : {-hair_m, hair_m}) {
      glm::dvec3 off(0.0);
      off[axis] = step;
      if ((occluder(world, lamp_m, point_m + off) != nullptr) != hidden) return true;
      if ((occluder(world, lamp_m + off, point_m) != nullptr) != hidden) return true;
    }
  // Surfaces within 2e-5 of the way hide nothing there, and within a millimetre here.
  const glm::dvec3 way = lamp_m - point_m;
  const double near_m = 2e-5 * glm::length(way);
  return near_m > 1e-3 && (occluder(world, lamp_m, point_m + 2e-5 * way) != nullptr) != hidden;
}

class ShadowRaysTest : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    even_ = even_beam();
    renderer->set_beam(0, image_of(even_));
  }

  static IntensityTable even_beam() { return cut_off_table(PhotometricType::kA, GammaAxis::kGamma0); }

  /// Decisions that differ from those of the processor and lie at no edge.
  std::size_t wrong(const Scene& scene, const PlacedLamp& lamp, const std::vector<MeasurePoint>& points,
                    std::size_t& hidden_count, std::size_t& judged) {
    const auto open = renderer->measure(std::span(&lamp, 1), points);
    const auto rays = renderer->measure(std::span(&lamp, 1), points, kRayShadows);
    std::size_t bad = 0, at_edges = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!(open[0][i] > 0.0f)) continue;
      const bool hidden = occluder(scene, lamp.position_m, points[i].position_m) != nullptr;
      ++judged;
      hidden_count += hidden;
      if (rays[0][i] == (hidden ? 0.0f : open[0][i])) continue;
      if (near_an_edge(scene, lamp.position_m, points[i].position_m, hidden))
        ++at_edges;
      else
        ++bad;
    }
    std::printf("%zu of %zu wrong, %zu more at an edge, %zu hidden\n", bad, judged, at_edges, hidden_count);
    EXPECT_LE(at_edges, judged / 200);  // or the test would say nothing
    return bad;
  }

  IntensityTable even_;
};

TEST_F(ShadowRaysTest, AgreeWithTheProcessorAmongRandomTriangles) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  // Far from the world's origin too: texels are relative to a place near the lamp.
  for (const glm::dvec3& origin_m : {glm::dvec3(0.0), glm::dvec3(5e6, -3e6, 400.0)}) {
    Scene scene;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 middle(40.0 + 38.0 * any(random), 15.0 * any(random), 4.0 * any(random));
      const auto near = [&] { return middle + 0.7 * glm::dvec3(any(random), any(random), any(random)); };
      const glm::dvec3 a = near(), b = near(), c = near();
      if (glm::length(glm::cross(b - a, c - a)) > 1e-3) add_triangle(scene, a, b, c);
    }
    close_scene(scene, origin_m);
    ASSERT_TRUE(renderer->load_scene(scene).ok());
    const PlacedLamp lamp{.position_m = origin_m + glm::dvec3(0.0, 0.3, 0.65)};
    std::vector<MeasurePoint> points;
    for (int i = 0; i < 4000; ++i)
      points.push_back({origin_m + glm::dvec3(45.0 + 44.0 * any(random), 8.0 * any(random), 2.0 * any(random)),
                        glm::dvec3(-1, 0, 0)});
    std::size_t hidden = 0, judged = 0;
    EXPECT_EQ(wrong(scene, lamp, points, hidden, judged), 0u);
    EXPECT_GT(hidden, 200u);
    EXPECT_GT(judged - hidden, 200u);
  }
}

TEST_F(ShadowRaysTest, AgreeWithTheProcessorOnTheShippedRoad) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().text());
  ASSERT_TRUE(renderer->load_scene(*scene).ok());
  FrameInput input;
  std::size_t hidden = 0, judged = 0;
  for (const double x_m : {26.9, 60.0, 300.0}) {
    input.camera.eye_m = {x_m - 1.9, -1.2, 1.22};
    input.far_mesh_from_m = 1e9;
    input.lamps = {{.position_m = {x_m, -1.0, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)}};
    std::vector<MeasurePoint> points;
    for (const AuditSample& sample : renderer->audit(input, 600, 3)) points.push_back(sample.point);
    EXPECT_EQ(wrong(*scene, input.lamps[0], points, hidden, judged), 0u) << x_m;
  }
  EXPECT_GT(judged, 900u);
  EXPECT_GT(hidden, 20u);
}

// A screen with holes, its texture wrapped and read in each way that glTF has.
TEST_F(ShadowRaysTest, GoThroughHolesAsTheProcessorsDo) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> any_byte(0, 255);
  SceneTexture holes{"holes", 13, 7, {}};
  for (std::size_t i = 0; i < 4u * 13 * 7; ++i) holes.rgba.push_back(static_cast<std::uint8_t>(any_byte(random)));
  const PlacedLamp lamp{.position_m = {0.0, 0.3, 0.2}};
  std::vector<MeasurePoint> points;
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 1500; ++i) points.push_back({{20.0, 9.0 * any(random), 9.0 * any(random)}, {-1, 0, 0}});
  std::size_t hidden = 0, judged = 0;
  for (const TextureWrap wrap : {TextureWrap::kRepeat, TextureWrap::kMirror, TextureWrap::kClamp})
    for (const bool nearest : {false, true}) {
      Scene scene;
      add_quad(scene, {10, 4, -4}, {10, -4, -4}, {10, -4, 4}, {10, 4, 4});
      close_scene(scene);
      scene.textures = {holes};
      scene.materials[0].look = {.base = glm::vec4(1.0f, 1.0f, 1.0f, 0.8f),
                                 .base_texture = 0,
                                 .sampler = {.across = wrap, .down = TextureWrap::kMirror, .nearest = nearest},
                                 .cut_below = 0.4f};
      for (const SceneVertex& vertex : scene.vertices)
        scene.looks.push_back({.uv = {0.3f - 0.25f * vertex.position_m.y, 0.2f - 0.2f * vertex.position_m.z}});
      scene.chunks[0].first_look = 0;
      ASSERT_TRUE(renderer->load_scene(scene).ok());
      EXPECT_EQ(wrong(scene, lamp, points, hidden, judged), 0u) << static_cast<int>(wrap) << nearest;
    }
  EXPECT_GT(hidden, 1000u);
  EXPECT_GT(judged - hidden, 1000u);
}

FrameInput view_of_a_box() {
  FrameInput input;
  input.camera.eye_m = {-1.9, 0.3, 1.22};
  input.want_image = true;
  for (const double y_m : {0.6, -0.6})
    input.lamps.push_back({.position_m = {0.0, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = kRayShadows;
  return input;
}

// A box that stands, and the same box as a mesh that was carried and turned there.
TEST_F(ShadowRaysTest, OfWhatMovesFallWhereThoseOfWhatStandsDo) {
  Scene road, with_box, box;
  for (Scene* scene : {&road, &with_box}) add_quad(*scene, {0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
  add_box(with_box, {20, -1, 0}, {21, 1, 2});
  add_box(box, {-1, -0.5, 0}, {1, 0.5, 2});
  for (Scene* scene : {&road, &with_box, &box}) close_scene(*scene);
  // A quarter turn about z: what was 2 m along is 2 m across.
  const std::vector<PlacedMesh> placed{
      {.mesh = 0, .position_m = {20.5, 0, 0}, .world_from_mesh = glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1)}};
  for (const std::size_t level : {kRayShadows, kLens}) {
    FrameInput input = view_of_a_box();
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = level;
    ASSERT_TRUE(renderer->load_scene(with_box).ok());
    renderer->draw(input);
    const Image8 standing = renderer->read_image();
    ASSERT_TRUE(renderer->load_scene(road, box).ok());
    input.moving = placed;
    const FrameResult drawn = renderer->draw(input);
    EXPECT_EQ(drawn.effects.level(Effect::kShadows), level);
    const Image8 moved = renderer->read_image();
    std::size_t differ = 0;
    for (std::size_t i = 0; i < moved.rgba.size(); ++i) differ += std::abs(moved.rgba[i] - standing.rgba[i]) > 2;
    EXPECT_LE(differ, 4u * 60u) << level;  // pixels of the box's own edges
    // The lamp that it carries is not hidden by it, and another is.
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
    renderer->draw(input);
    const Image8 without = renderer->read_image();
    EXPECT_NE(without.rgba, moved.rgba);
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = level;
    for (PlacedLamp& lamp : input.lamps) lamp.carried_by = 0;
    renderer->draw(input);
    EXPECT_EQ(renderer->read_image().rgba, without.rgba);
  }
}

TEST_F(ShadowRaysTest, LeaveNothingBehindAndCostNothingWhereTheyAreNotAskedFor) {
  Scene scene;
  add_quad(scene, {0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
  add_box(scene, {20, -1, 0}, {21, 1, 2});
  close_scene(scene);
  ASSERT_TRUE(renderer->load_scene(scene).ok());
  FrameInput input = view_of_a_box();
  input.effects[static_cast<std::size_t>(Effect::kDepthFirst)] = 0;
  const auto drawn_with = [&](std::size_t level) {
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = level;
    renderer->draw(input);
    return renderer->draw(input);
  };
  drawn_with(kRayShadows);
  const FrameResult off = drawn_with(0);
  const std::uint64_t bytes = renderer->device_memory_bytes();
  const FrameResult rays = drawn_with(kRayShadows);
  EXPECT_GT(renderer->device_memory_bytes(), bytes);
  EXPECT_EQ(rays.images, off.images);  // no map
  EXPECT_EQ(rays.draws, off.draws);
  const EffectCost& cost = rays.effect_costs[static_cast<std::size_t>(Effect::kShadows)];
  EXPECT_EQ(cost.passes, 0u) << "its triangles are copied";
  EXPECT_GT(cost.bytes, 0u);
  EXPECT_LE(cost.bytes, renderer->device_memory_bytes() - bytes);
  EXPECT_TRUE(effect_time_ms(rays, Effect::kShadows).has_value());
  const FrameResult again = drawn_with(0);
  EXPECT_EQ(renderer->device_memory_bytes(), bytes);
  EXPECT_EQ(again.pass_count, off.pass_count);
  // The facts never choose them.
  for (std::size_t casters = 0; casters < 3; ++casters)
    EXPECT_LT(plan_effects({.lit_lamps = 2, .casters = casters}).level(Effect::kShadows), kRayShadows);
}

TEST(ShadowRayLimits, AreToldWhereTheDeviceHoldsNoSuchBuffer) {
  EXPECT_TRUE(holds_rays(65'536, 65'536));
  EXPECT_FALSE(holds_rays(65'537, 65'536));
  EXPECT_FALSE(holds_rays((1u << 24) + 1, 1u << 30));  // more texels than float32 counts
  EffectChoices choices;
  choices[static_cast<std::size_t>(Effect::kShadows)] = kLens;
  const EffectPlan plan = plan_effects({.lit_lamps = 2, .casters = 3, .shadow_rays = false}, choices);
  EXPECT_EQ(plan.level(Effect::kShadows), kRayShadows - 1);
  EXPECT_NE(plan[Effect::kShadows].reason.find("no buffer as large"), std::string::npos);
  EXPECT_EQ(plan_effects({.lit_lamps = 2, .casters = 3}, choices).level(Effect::kShadows), kLens);
}

// Behind the edge of a wall the opening is hidden bit by bit. Of n places that stand for equal shares, on any straight
// edge, at most one or two lie on the wrong side: 2/16.
TEST_F(ShadowRaysTest, OverTheOpeningGiveTheShareOfItThatIsSeen) {
  Scene scene;
  add_quad(scene, {10, -5, -5}, {10, 0, -5}, {10, 0, 5}, {10, -5, 5});
  close_scene(scene);
  ASSERT_TRUE(renderer->load_scene(scene).ok());
  for (const bool round : {true, false}) {
    const PlacedLamp lamp{.position_m = {0, 0, 0}, .opening = {.width_m = 0.2, .height_m = 0.1, .round = round}};
    std::vector<MeasurePoint> points;
    for (int i = -60; i <= 60; ++i) points.push_back({{20, 0.002 * i, 0.01}, {-1, 0, 0}});
    const auto open = renderer->measure(std::span(&lamp, 1), points);
    const auto lens = renderer->measure(std::span(&lamp, 1), points, kLens);
    double worst = 0.0;
    std::size_t between = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      // The wall's edge is half way: from y the opening is seen left of -y.
      const double edge = glm::clamp(-points[i].position_m.y / 0.1, -1.0, 1.0);
      const double hidden = round ? 0.5 + (edge * std::sqrt(1.0 - edge * edge) + std::asin(edge)) / 3.14159265358979
                                  : 0.5 * (1.0 + edge);
      const double found = static_cast<double>(lens[0][i]) / static_cast<double>(open[0][i]);
      worst = std::max(worst, std::abs(found - (1.0 - hidden)));
      between += found > 0.01 && found < 0.99;
    }
    std::printf("%s: worst share off by %.3g, %zu in the penumbra\n", round ? "round" : "rectangle", worst, between);
    EXPECT_LE(worst, 2.0 / shader::kLensRays);
    EXPECT_GT(between, 80u);
  }
}

}  // namespace
}  // namespace phare
