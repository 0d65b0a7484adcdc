// Shadows: decisions lit or dark against the reference tables, maps only where something stands in the light.
#include "visual/passes/shadows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "config/base/paths.h"
#include "tests/csv_table.h"
#include "tests/paths.h"
#include "tests/visual/shape.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/effects_of_frame.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/renderer.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

std::vector<PlacedLamp> mounted(const nlohmann::json& manifest, const char* beam) {
  std::vector<PlacedLamp> lamps;
  for (const nlohmann::json& mounting : manifest["mounting"][beam]) {
    const auto vec = [&](const char* key) { return glm::dvec3(mounting[key][0], mounting[key][1], mounting[key][2]); };
    lamps.push_back(
        {.position_m = vec("position_m"), .world_from_image = glm::dmat3(vec("forward"), vec("left"), vec("up"))});
  }
  return lamps;
}

class Shadows : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    even_ = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
    renderer->set_beam(0, image_of(even_));
  }
  static void TearDownTestSuite() {
    device_draws().reset();
    SharedRenderer::TearDownTestSuite();
  }

  /// Does it with a renderer as it is and with one whose device draws the maps though it is the processor; of another
  /// device both are one.
  void with_both(const std::function<void(bool processor_draws)>& act) {
    act(true);
    if (HasFatalFailure()) return;
    Renderer* const usual = std::exchange(renderer, nullptr);
    if (!device_draws()) {
      Result<Renderer> made =
          Renderer::create({.width_px = 320, .height_px = 180, .validation = true, .processor_depths = false});
      ASSERT_TRUE(made) << made.error().text();
      device_draws() = std::make_unique<Renderer>(std::move(*made));
    }
    renderer = device_draws().get();
    renderer->set_beam(0, image_of(even_));
    act(false);
    EXPECT_EQ(renderer->validation_messages(), 0u);
    renderer = usual;
  }

  /// Points where the map's answer (more than half lit) is not that of the table, of those that `counts` names.
  std::size_t wrong(const test::CsvTable& table, const std::vector<PlacedLamp>& lamps,
                    const std::vector<MeasurePoint>& points, std::size_t level,
                    const std::function<bool(std::size_t)>& counts) {
    const auto open = renderer->measure(lamps, points), shadowed = renderer->measure(lamps, points, level);
    std::size_t judged = 0, bad = 0;
    const char* sides[] = {"left", "right"};
    for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!counts(i) || !(open[lamp][i] > 0.0f)) continue;
        const std::string side = sides[lamp];
        const bool lit = table.text(i, "visible_" + side) == "1";
        ++judged;
        const bool wrong = (shadowed[lamp][i] > 0.5f * open[lamp][i]) != lit;
        bad += wrong;
        if (wrong && bad <= 3)
          std::printf("  wrong: %g %g %g, %s lamp, %g of %g lx, has to be %s\n", points[i].position_m.x,
                      points[i].position_m.y, points[i].position_m.z, sides[lamp],
                      static_cast<double>(shadowed[lamp][i]), static_cast<double>(open[lamp][i]), lit ? "lit" : "dark");
      }
    std::printf("level %zu: %zu of %zu decisions wrong\n", level, bad, judged);
    EXPECT_GT(judged, 500u);
    return bad;
  }

  /// The same of the ray against the scene.
  std::size_t wrong_rays(const test::CsvTable& table, const Scene& scene, const std::vector<PlacedLamp>& lamps,
                         const std::vector<MeasurePoint>& points, const std::function<bool(std::size_t)>& counts) {
    const auto open = renderer->measure(lamps, points);
    std::size_t judged = 0, bad = 0;
    const char* sides[] = {"left", "right"};
    for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!counts(i) || !(open[lamp][i] > 0.0f)) continue;
        const bool lit = !occluder(scene, lamps[lamp].position_m, points[i].position_m);
        ++judged;
        if (lit != (table.text(i, std::string("visible_") + sides[lamp]) == "1")) ++bad;
      }
    }
    std::printf("rays: %zu of %zu decisions wrong\n", bad, judged);
    return bad;
  }

  IntensityTable even_;

 private:
  static std::unique_ptr<Renderer>& device_draws() {
    static std::unique_ptr<Renderer> renderer;
    return renderer;
  }
};

TEST_F(Shadows, OfBoxesFallWhereTheReferenceHasThem) {
  const fs::path data = fs::path(shared_data_dir()) / "photometry-reference";
  if (!fs::exists(data)) GTEST_SKIP() << "no reference tables at " << data;
  const nlohmann::json manifest = nlohmann::json::parse(std::ifstream(data / "manifest.json"));
  Shape shape;
  const auto corner = [](const nlohmann::json& at) { return glm::dvec3(at[0], at[1], at[2]); };
  for (const nlohmann::json& box : manifest["occluder_boxes"]) shape.box(corner(box["min"]), corner(box["max"]));
  shape.quad({0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
  const test::CsvTable table = test::read_csv_table(data / "d_shadow.csv");
  std::vector<MeasurePoint> points;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    points.push_back({{table.number(i, "x"), table.number(i, "y"), table.number(i, "z")},
                      {table.number(i, "nx"), table.number(i, "ny"), table.number(i, "nz")}});
  const std::vector<PlacedLamp> lamps = mounted(manifest, "low");
  const auto clear = [&](std::size_t i) { return table.number(i, "edge_clearance_m") >= 0.01; };
  with_both([&](bool processor_draws) {
    ASSERT_TRUE(renderer->load_scene(shape.scene()).ok());
    if (processor_draws) {
      EXPECT_EQ(wrong_rays(table, shape.scene(), lamps, points, clear), 0u);
    }
    const std::size_t levels = processor_draws ? kShadowNames.size() : kRayShadows;
    for (std::size_t level = 1; level < levels; ++level)
      for (const double clear_m : {0.05, 0.02, 0.01, 0.002}) {
        const auto counts = [&](std::size_t i) { return table.number(i, "edge_clearance_m") >= clear_m; };
        std::printf("%s by the %s, edge clearance %g m, ", std::string(kShadowNames[level]).c_str(),
                    processor_draws ? "processor" : "device", clear_m);
        const std::size_t bad = wrong(table, lamps, points, level, counts);
        // A ray's place is good to micrometres. Of lens more than half of an opening tells as its middle does.
        if (clear_m == 0.05 || level == kRayShadows) {
          EXPECT_EQ(bad, 0u) << "level " << level << ", " << clear_m << " m";
        }
      }
  });
}

TEST_F(Shadows, OfAHillFallWhereTheReferenceHasThem) {
  const fs::path data = fs::path(shared_data_dir()) / "photometry-reference";
  if (!fs::exists(data)) GTEST_SKIP() << "no reference tables at " << data;
  const nlohmann::json manifest = nlohmann::json::parse(std::ifstream(data / "manifest.json"));
  const nlohmann::json& hill = manifest["hill"];
  const double x0 = hill["x0"], x1 = hill["x1"], height = hill["height"], crossfall = hill["crossfall"];
  const auto ground = [&](double x, double y) {
    const double u = (x - x0) / (x1 - x0);
    const double bump = u < 0.0 || u > 1.0 ? 0.0 : 0.5 * height * (1.0 - std::cos(6.283185307179586 * u));
    return glm::dvec3(x, y, bump + crossfall * y);
  };
  Shape shape;
  // Strips of 2 cm: a ray that leaves the back slope at 1 mrad, where it ends, leaves the strips within 2 cm of there,
  // less than the bias of the maps at that distance.
  for (int i = 0; i < 3500; ++i) {
    const double x = 0.02 * i;
    shape.quad(ground(x, -12), ground(x + 0.02, -12), ground(x + 0.02, 12), ground(x, 12));
  }
  ASSERT_TRUE(renderer->load_scene(shape.scene()).ok());
  const test::CsvTable table = test::read_csv_table(data / "e_hill.csv");
  std::vector<MeasurePoint> points;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    points.push_back({{table.number(i, "x"), table.number(i, "y"), table.number(i, "z")},
                      {table.number(i, "nx"), table.number(i, "ny"), table.number(i, "nz")}});
  const std::vector<PlacedLamp> lamps = mounted(manifest, "high");
  const auto robust = [&](std::size_t i) {
    return table.text(i, "robust_2cm") == "1" && points[i].position_m.x < 70.0;
  };
  EXPECT_EQ(wrong_rays(table, shape.scene(), lamps, points, robust), 0u);
  for (std::size_t level = 1; level <= kRayShadows; ++level) {
    const std::size_t bad = wrong(table, lamps, points, level, robust);
    EXPECT_EQ(bad, 0u) << "level " << level;
  }
}

FrameInput view_of_the_road() {
  FrameInput input;
  input.camera.eye_m = {-1.9, 0.3, 1.22};
  for (const double y_m : {0.6, -0.6})
    input.lamps.push_back({.position_m = {0.0, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
  return input;
}

// In false colour light ends at the edge of a shadow, within a pixel: a line of equal lux there would be drawn where
// the edge goes through a group of four pixels and not where it goes between two, in dashes.
TEST_F(Shadows, HaveNoDashesOfIsoluxLinesAtTheirEdges) {
  Shape road;
  road.quad({-5, -30, 0}, {100, -30, 0}, {100, 30, 0}, {-5, 30, 0});
  road.box({12, 1, 0}, {12.1, 2, 2});
  ASSERT_TRUE(renderer->load_scene(road.scene()).ok());
  FrameInput input = view_of_the_road();
  input.camera.eye_m = {0, 0, 14};
  input.camera.world_from_eye = aim_rotation(0.0, -0.6, 0.0);
  input.view = View::kFalseColour;
  input.isolux_lx = {0.5};  // the road behind the box has more, its shadow none
  input.want_image = true;
  std::array<std::size_t, 2> white{}, dark{};
  for (const bool shadows : {false, true}) {
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = shadows ? 1 : 0;
    renderer->draw(input);
    const Image8 picture = renderer->read_image();
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      const auto channel = [&](std::size_t c) { return static_cast<int>(picture.rgba[i + c]); };
      if (channel(0) > 140 && channel(1) > 140 && channel(2) > 140) ++white[shadows ? 1 : 0];
      if (channel(0) + channel(1) + channel(2) < 60) ++dark[shadows ? 1 : 0];
    }
  }
  EXPECT_GT(dark[1], dark[0] + 500) << "the shadow is seen";
  // The line of 0.5 lx around the whole beam is cut by four edges, some pixels each.
  EXPECT_LE(white[1], white[0] + 20);
  EXPECT_GT(white[0], 200u);
}

// What is not called for costs nothing: no pass, no image, no draw.
TEST_F(Shadows, AreMadeWhereSomethingStandsInTheLightAndNowhereElse) {
  with_both([&](bool processor_draws) {
    Shape road;
    road.quad({0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
    ASSERT_TRUE(renderer->load_scene(road.scene()).ok());
    FrameInput input = view_of_the_road();
    const FrameResult flat = renderer->draw(input);
    EXPECT_EQ(flat.effects.level(Effect::kShadows), 0u);
    EXPECT_EQ(flat.pass_count, 1u);

    Shape with_box = road;
    with_box.box({20, -1, 0}, {21, 1, 2});
    ASSERT_TRUE(renderer->load_scene(with_box.scene()).ok());
    const FrameResult shadowed = renderer->draw(input);
    EXPECT_EQ(kShadowNames[shadowed.effects.level(Effect::kShadows)], "soft");
    EXPECT_EQ(shadowed.pass_count, 2u);
    // Drawn by a device into an image, and copied into the buffer that is read; by the processor into one of two of
    // those.
    const bool draws_itself = shadowed.image_bytes == flat.image_bytes;
    if (!processor_draws) {
      EXPECT_FALSE(draws_itself);
    }
    constexpr auto kShadows = static_cast<std::size_t>(Effect::kShadows);
    const auto maps = std::ranges::count(shadowed.passes, std::string("shadows"), &PassTime::name);
    EXPECT_EQ(shadowed.effect_costs[kShadows].passes, static_cast<std::uint32_t>(maps));
    EXPECT_EQ(shadowed.other_cost.passes, 1u) << "the lamp pass";
    EXPECT_GE(shadowed.effect_costs[kShadows].bytes, shadowed.image_bytes - flat.image_bytes);
    const ShadowLevel& level = kShadowLevels[shadowed.effects.level(Effect::kShadows)];
    EXPECT_GE(shadowed.effect_costs[kShadows].bytes, 2 * sizeof(float) * 2 * level.width * level.height);
    EXPECT_GT(effect_time_ms(shadowed, Effect::kShadows).value_or(0.0), 0.0);

    input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
    const FrameResult off = renderer->draw(input);
    EXPECT_EQ(off.pass_count, flat.pass_count);
    EXPECT_EQ(off.effect_costs[kShadows].passes, 0u);
    EXPECT_EQ(off.effect_costs[kShadows].bytes, 0u);
    EXPECT_FALSE(effect_time_ms(off, Effect::kShadows).has_value());
    EXPECT_EQ(off.images, flat.images);
    EXPECT_EQ(off.image_bytes, flat.image_bytes);
    EXPECT_EQ(off.draws, flat.draws);
    EXPECT_NE(off.effects[Effect::kShadows].reason.find("not looked for"), std::string::npos);

    // The box behind the lamps casts nothing.
    input.effects = {};
    for (PlacedLamp& lamp : input.lamps) lamp.position_m.x = 22.0;
    input.camera.eye_m.x = 20.1;
    EXPECT_EQ(renderer->draw(input).effects.level(Effect::kShadows), 0u);
  });
}
// Of ground in many triangles those that no shadow can reach are drawn as where nothing casts; the picture is that of
// rays, which are asked everywhere, but for the width of a texel.
TEST_F(Shadows, PiecesOfGroundThatNoneReachesAreDrawnWithoutAndLookTheSame) {
  Shape shape;
  for (int x = 0; x < 40; ++x)
    for (int y = -6; y < 6; ++y)
      shape.quad({2.0 * x, 2.0 * y, 0}, {2.0 * x + 2, 2.0 * y, 0}, {2.0 * x + 2, 2.0 * y + 2, 0},
                 {2.0 * x, 2.0 * y + 2, 0});
  Scene scene = shape.scene();
  Shape posts;
  for (const double x : {9.0, 13.0, 18.0}) posts.box({x, 1.5, 0}, {x + 0.3, 2.0, 1.5});
  posts.box({30, -5, 0}, {31, -3, 2});
  Scene things = posts.scene();
  // Both in one scene, the ground of asphalt.
  scene.materials.push_back(things.materials[0]);
  scene.materials[0].surface = Surface::kAsphalt;
  SceneChunk chunk = things.chunks[0];
  chunk.material = 1;
  chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
  scene.vertices.insert(scene.vertices.end(), things.vertices.begin(), things.vertices.end());
  scene.indices.insert(scene.indices.end(), things.indices.begin(), things.indices.end());
  scene.chunks.push_back(chunk);
  ASSERT_TRUE(renderer->load_scene(scene).ok());
  FrameInput input = view_of_the_road();
  input.want_image = true;
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = kRayShadows;
  const FrameResult by_rays = renderer->draw(input);
  const Image8 expected = renderer->read_image();
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  const FrameResult without = renderer->draw(input);
  const Image8 open = renderer->read_image();
  input.effects = {};
  const FrameResult by_maps = renderer->draw(input);
  const Image8 seen = renderer->read_image();
  EXPECT_EQ(kShadowNames[by_maps.effects.level(Effect::kShadows)], "soft");
  EXPECT_GT(by_maps.views.front().draws, without.views.front().draws) << "no piece is drawn without";
  std::size_t in_shadow = 0, differ = 0;
  for (std::size_t i = 0; i < seen.rgba.size(); i += 4) {
    const auto off = [&](const Image8& other) {
      return std::abs(int(expected.rgba[i + 1]) - int(other.rgba[i + 1])) > 6;
    };
    in_shadow += off(open), differ += off(seen);
  }
  std::printf("%zu pixels in shadow, %zu differ from rays\n", in_shadow, differ);
  EXPECT_GT(in_shadow, 300u);
  EXPECT_LT(differ, in_shadow / 8) << "more than the edges";
}

// What only a map's second picture is asked about is not drawn into its first.
TEST_F(Shadows, AThingInTheMiddleIsDrawnIntoOnePictureOfAMap) {
  Shape near;  // at the side: it makes the first picture wide
  near.quad({0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
  near.box({5, 4, 0}, {6, 6, 2});
  Shape both = near;
  both.box({60, -1, 0}, {61, 1, 2});
  const FrameInput input = view_of_the_road();
  with_both([&](bool processor_draws) {
    if (processor_draws) return;  // it counts none
    const auto triangles = [&](Shape& shape) {
      EXPECT_TRUE(renderer->load_scene(shape.scene()).ok());
      const FrameResult frame = renderer->draw(input);
      EXPECT_NE(frame.effects.level(Effect::kShadows), 0u);
      return frame.triangles;
    };
    constexpr std::uint64_t kBox = 12, kLamps = 2;
    const std::uint64_t more = triangles(both) - triangles(near);
    EXPECT_GT(more, kBox) << "it casts";
    EXPECT_LE(more, kBox + kLamps * kBox) << "once for each lamp";
  });
}

// Leaves, trunks and posts on both sides of a road, some beside the lamps.
TEST_F(Shadows, AreWhereTheDeviceHasThemThoughTheProcessorDraws) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(scene.ok());
  FrameInput input = view_of_the_road();
  input.want_image = true;
  input.exposure_per_cdm2 = 3.0;
  std::vector<std::vector<std::uint8_t>> pictures;
  with_both([&](bool processor_draws) {
    ASSERT_TRUE(renderer->load_scene(*scene).ok());
    std::size_t picture = 0, differ = 0, shadowed = 0;
    for (const double x_m : {26.9, 100.0, 180.0})
      for (std::size_t level = 0; level <= 3; ++level, ++picture) {
        input.effects[static_cast<std::size_t>(Effect::kShadows)] = level;
        input.camera.eye_m = {x_m - 1.9, -1.2, 1.22};
        for (std::size_t i = 0; i < 2; ++i) input.lamps[i].position_m = {x_m, i == 0 ? -1.0 : -2.2, 0.65};
        renderer->draw(input);
        if (processor_draws) {
          pictures.push_back(renderer->read_image().rgba);
          continue;
        }
        const std::vector<std::uint8_t> drawn = renderer->read_image().rgba;
        for (std::size_t i = 0; i < drawn.size(); i += 4) {
          if (std::abs(int{drawn[i + 1]} - int{pictures[picture][i + 1]}) > 2) ++differ;
          if (drawn[i + 1] != pictures[4 * (picture / 4)][i + 1]) ++shadowed;
        }
      }
    if (processor_draws) return;
    std::printf("%zu pixels in shadow, %zu of them differ\n", shadowed, differ);
    EXPECT_GT(shadowed, 5000u);
    // A side is off by a 256th of a texel at most, either way, so one in 128 texels that it passes tells otherwise.
    EXPECT_LE(differ, shadowed / 128);
  });
}

TEST_F(Shadows, ALampSeenInManyViewsAndAmongManyLampsCastsTheSameShadow) {
  Shape shape;
  shape.quad({0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
  shape.box({20, -1, 0}, {21, 1, 2});
  ASSERT_TRUE(renderer->load_scene(shape.scene()).ok());
  FrameInput input = view_of_the_road();
  input.want_image = true;
  renderer->draw(input);
  const Image8 alone = renderer->read_image();
  // Twelve more lamps that look away: drawn by blocks, and by other pipelines.
  FrameInput many = input;
  for (int i = 0; i < 12; ++i)
    many.lamps.push_back({.position_m = {-5.0, 0.1 * i, 0.65}, .world_from_image = aim_rotation(3.1415926, 0.0, 0.0)});
  ViewInput other = many;
  other.own_picture = {320, 180};
  many.more_views = {other};
  renderer->draw(many);
  EXPECT_EQ(renderer->read_image().rgba, alone.rgba);
  EXPECT_EQ(renderer->read_image(1).rgba, alone.rgba);
}

// What comes into the beam of one lamp and not of the other makes no pipeline where each lamp has a map: the same
// picture, by those for both.
TEST_F(Shadows, InTheBeamOfOneLampAreDrawnAsInThoseOfBoth) {
  Shape shape;
  shape.quad({0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
  shape.box({20, -1, 0}, {21, 1, 2});
  with_both([&](bool) {
    ASSERT_TRUE(renderer->load_scene(shape.scene()).ok());
    FrameInput both = view_of_the_road();
    both.want_image = both.few_kinds = true;
    const FrameResult of_both = renderer->draw(both);
    FrameInput one = both;
    one.lamps.back().position_m = {21.5, -0.62, 0.65};  // the box is behind it
    const FrameResult each = renderer->draw(one);
    EXPECT_EQ(each.pipelines_made, 0u);
    const auto bytes = [](const FrameResult& frame) {
      return frame.effect_costs[static_cast<std::size_t>(Effect::kShadows)].bytes;
    };
    EXPECT_EQ(bytes(each), bytes(of_both));
    const std::vector<std::uint8_t> expected = renderer->read_image().rgba;

    one.few_kinds = false;
    const FrameResult alone = renderer->draw(one);
    EXPECT_LT(bytes(alone), bytes(each)) << "one map";
    EXPECT_EQ(renderer->read_image().rgba, expected);

    // Where nothing stands in any beam there is none to read.
    one.few_kinds = true;
    for (PlacedLamp& lamp : one.lamps) lamp.position_m.x = 21.5;
    EXPECT_EQ(renderer->draw(one).effects.level(Effect::kShadows), 0u);
  });
}

// As many maps as lamps that something stands before, in as many images as the device's largest takes.
TEST_F(Shadows, MoreLampsThanADrawSumsCastAllOfThem) {
  Shape shape;
  shape.quad({0, -30, 0}, {100, -30, 0}, {100, 30, 0}, {0, 30, 0});
  shape.box({20, -1, 0}, {21, 1, 2});
  ASSERT_TRUE(renderer->load_scene(shape.scene()).ok());
  FrameInput eight = view_of_the_road();
  eight.want_image = true;
  eight.effects[static_cast<std::size_t>(Effect::kShadows)] = 3;
  const PlacedLamp lamp = eight.lamps.front();
  eight.lamps.assign(kLampsPerDraw, lamp);
  FrameInput more = eight;
  // Farther ones first: the eight that a draw sums are the last.
  PlacedLamp behind = lamp;
  behind.position_m.x = -30.0;
  more.lamps.insert(more.lamps.begin(), 4, behind);
  renderer->draw(eight);
  const Image8 expected = renderer->read_image();
  const FrameResult result = renderer->draw(more);
  EXPECT_EQ(result.views.front().lamps, 12u);
  EXPECT_EQ(result.views.front().lamps_without_map, 0u);
  EXPECT_EQ(renderer->read_image().rgba, expected.rgba);

  more.lamps.assign(kMostShadowMaps + 2, lamp);
  EXPECT_EQ(renderer->draw(more).views.front().lamps_without_map, 2u);
  EXPECT_EQ(renderer->read_image().rgba, expected.rgba);
}

// A ditch beside the road, its corners' normals smoothed: at the top of its near slope they face the lamp, though the
// slope is turned away. Rays have it dark.
TEST_F(Shadows, ASlopeTurnedFromTheLampIsDarkThoughItsNormalsFaceIt) {
  const std::array<glm::dvec2, 6> profile{{{5, 0}, {-3, 0}, {-3.7, -0.35}, {-4.4, -0.7}, {-6.4, 0.3}, {-30, 0.3}}};
  const auto upward = [&](std::size_t side) {
    const glm::dvec2 along = profile[side] - profile[side + 1];
    return glm::normalize(glm::dvec3(0, -along.y, along.x));
  };
  Scene scene;
  scene.materials = {{.name = "grass", .reflectance = glm::vec3(0.3f)}};
  for (std::size_t i = 0; i < profile.size(); ++i)
    for (const double x : {-10.0, 70.0}) {
      const glm::dvec3 normal = upward(i == 0 ? 0 : i - 1) + upward(std::min(i, profile.size() - 2));
      scene.vertices.push_back({{x, profile[i].x, profile[i].y}, glm::vec3(glm::normalize(normal))});
    }
  for (std::uint32_t i = 0; i + 2 < scene.vertices.size(); i += 2)
    for (const std::uint32_t corner : {0u, 2u, 1u, 1u, 2u, 3u}) scene.indices.push_back(i + corner);
  SceneChunk chunk{.node = "ground", .low_m = {-10, -30, -0.7}, .high_m = {70, 5, 0.3}};
  chunk.index_count = static_cast<std::uint32_t>(scene.indices.size());
  chunk.vertex_count = static_cast<std::uint32_t>(scene.vertices.size());
  scene.chunks = {chunk};
  ASSERT_TRUE(renderer->load_scene(scene).ok());

  FrameInput input = view_of_the_road();
  input.want_image = true;
  input.camera.eye_m = {-4.0, -5.0, 5.0};  // into the ditch
  const std::vector<PlacedLamp> two = input.lamps;
  for (const bool mirrored : {false, true})
    for (const std::size_t lamps : {std::size_t{2}, std::size_t{4}, std::size_t{6}}) {
      input.camera.world_from_eye = aim_rotation(0.0, -0.4, 0.0);
      if (mirrored) input.camera.world_from_eye[1] *= -1.0;
      input.lamps = two;
      while (input.lamps.size() < lamps) input.lamps.push_back(two[input.lamps.size() % 2]);
      const auto picture = [&](std::size_t level) {
        input.effects[static_cast<std::size_t>(Effect::kShadows)] = level;
        renderer->draw(input);
        return renderer->read_image();
      };
      const Image8 open = picture(0), by_rays = picture(kRayShadows), by_maps = picture(2);
      std::size_t in_shadow = 0, lit = 0, dark = 0;
      for (std::size_t i = 1; i < open.rgba.size(); i += 4) {
        in_shadow += int(open.rgba[i]) - int(by_rays.rgba[i]) > 6;
        lit += int(by_maps.rgba[i]) - int(by_rays.rgba[i]) > 6;
        dark += int(by_rays.rgba[i]) - int(by_maps.rgba[i]) > 6;
      }
      std::printf("%zu lamps%s: %zu pixels in shadow, %zu lit and %zu dark for all that\n", lamps,
                  mirrored ? ", mirrored" : "", in_shadow, lit, dark);
      EXPECT_GT(in_shadow, 1000u);
      EXPECT_LT(lit + dark, in_shadow / 20) << "more than the edges";
    }
}

}  // namespace
}  // namespace phare
