// A road drawn with far meshes against the same road drawn whole: fewer triangles, and a picture that a person takes
// for the same.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "config/base/paths.h"
#include "tests/bench/straight_road.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

TEST(FarMeshes, ChangeAPictureOfTheCountryRoadLessThanOneSees) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  const Result<IntensityTable> lamp = read_lamp(generated_dir() / "lamps/low_rht.ies", {});
  ASSERT_TRUE(scene.ok() && lamp.ok());
  Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(*scene).ok());
  const AimedSource source{.table = &*lamp};
  renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
  for (const double x_m : {26.9, 300.0}) {
    FrameInput input;
    input.camera.eye_m = {x_m - 1.9, -1.2, 1.22};
    input.camera.world_from_eye = aim_rotation(0.0, -0.01, 0.0);
    for (const double y_m : {-1.0, -2.2})
      input.lamps.push_back({.position_m = {x_m, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
    input.want_image = true;
    const FrameResult far = renderer->draw(input);
    const Image8 from_afar = renderer->read_image();
    input.far_mesh_from_m = std::numeric_limits<double>::infinity();
    const FrameResult full = renderer->draw(input);
    const Image8 whole = renderer->read_image();
    std::size_t more_than_8 = 0;
    double sum = 0.0;
    for (std::size_t i = 0; i < whole.rgba.size(); i += 4) {
      const int difference = std::abs(static_cast<int>(whole.rgba[i + 1]) - static_cast<int>(from_afar.rgba[i + 1]));
      sum += difference;
      if (difference > 8) ++more_than_8;
    }
    const double pixels = static_cast<double>(whole.rgba.size()) / 4.0;
    std::printf("x = %.0f m: %llu triangles in place of %llu; mean %.4f of 255, %.3f %% of pixels by more than 8\n",
                x_m, static_cast<unsigned long long>(far.triangles), static_cast<unsigned long long>(full.triangles),
                sum / pixels, 100.0 * static_cast<double>(more_than_8) / pixels);
    EXPECT_LT(far.triangles, full.triangles);
    // Asked for: a tenth of a step of the display on average, and a step that one sees in one pixel of two hundred.
    EXPECT_LT(sum / pixels, 0.1);
    EXPECT_LT(static_cast<double>(more_than_8) / pixels, 0.005);
  }
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

TEST(FarMeshes, AreDrawnTogetherWhereTheDeviceTakesManyDrawsInOneCall) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(scene.ok());
  std::vector<Image8> pictures;
  std::vector<FrameResult> frames;
  for (const bool multi_draw : {true, false}) {
    Result<Renderer> renderer =
        Renderer::create({.width_px = 1280, .height_px = 720, .validation = true, .multi_draw = multi_draw});
    ASSERT_TRUE(renderer.ok()) << renderer.error().text();
    ASSERT_TRUE(renderer->load_scene(*scene).ok());
    FrameInput input;
    input.camera.eye_m = {25.0, -1.2, 1.22};
    input.sky_luminance_cdm2 = 1.0;
    input.exposure_per_cdm2 = 1.0;
    input.want_image = true;
    frames.push_back(renderer->draw(input));
    pictures.push_back(renderer->read_image());
    EXPECT_EQ(renderer->validation_messages(), 0u);
  }
  EXPECT_EQ(pictures[0].rgba, pictures[1].rgba);
  EXPECT_EQ(frames[0].triangles, frames[1].triangles);
  std::printf("%u draws of %llu triangles, one by one %u\n", frames[0].draws,
              static_cast<unsigned long long>(frames[0].triangles), frames[1].draws);
  EXPECT_LE(frames[0].draws, frames[1].draws);
  if (frames[0].draws == frames[1].draws) GTEST_SKIP() << "the device has no VK_EXT_multi_draw";
  EXPECT_LT(2 * frames[0].draws, frames[1].draws) << "what is far has one origin for all";
}

TEST(FarMeshes, BeginFartherAwayWherePixelsAreFiner) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(scene.ok());
  Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(*scene).ok());
  FrameInput input;
  input.camera.eye_m = {25.0, -1.2, 1.22};
  const auto triangles = [&](int width_px, int height_px, double far_mesh_from_m) {
    renderer->resize(width_px, height_px);
    input.far_mesh_from_m = far_mesh_from_m;
    return renderer->draw(input).triangles;
  };
  const std::uint64_t usual = triangles(1280, 720, kFarMeshFrom_m);
  EXPECT_EQ(triangles(640, 360, kFarMeshFrom_m), usual) << "coarser pixels gain nothing: insets stay as they are";
  EXPECT_EQ(triangles(2560, 1440, kFarMeshFrom_m), triangles(1280, 720, 2.0 * kFarMeshFrom_m));
  EXPECT_GT(triangles(2560, 1440, kFarMeshFrom_m), usual);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
