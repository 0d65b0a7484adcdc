// Two frames in flight: each is drawn from what was written for it, while the next is written; what is made anew or
// freed meanwhile is waited for; times are told once for each frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "tests/visual/panel_content.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/overlay_content.h"

namespace phare {
namespace {

constexpr std::size_t kFrames = 12;
constexpr int kWidth_px = 1920, kHeight_px = 1080;  // the device takes longer for a frame than it takes to write the next

/// A post that moves about in the beams.
Scene post() {
  Scene scene;
  scene.materials = {{.name = "post", .reflectance = {0.5f, 0.3f, 0.2f}, .double_sided = true}};
  for (const glm::vec3& corner :
       {glm::vec3(0, -0.3, 0), glm::vec3(0, 0.3, 0), glm::vec3(0, 0.3, 2), glm::vec3(0, -0.3, 2)})
    scene.vertices.push_back({corner, {-1, 0, 0}});
  scene.indices = {0, 1, 2, 0, 2, 3};
  scene.chunks = {
      {.node = "post", .low_m = {0, -0.3, 0}, .high_m = {0, 0.3, 2}, .index_count = 6, .vertex_count = 4}};
  return scene;
}

IntensityTable table_of(std::size_t frame) {
  IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  for (double& candela : table.candela) candela *= 1.0 + 0.2 * static_cast<double>(frame);
  if (frame >= 6) {  // another size: its buffers are made anew
    table.second_deg.pop_back();
    table.candela.resize(table.second_deg.size() * table.first_deg.size());
  }
  return table;
}

const BeamImage& beam_of(std::size_t frame) {
  static const std::vector<BeamImage> beams = [] {
    std::vector<BeamImage> all;
    for (std::size_t i = 0; i <= kFrames; ++i) all.push_back(image_of(table_of(i)));
    return all;
  }();
  return beams.at(frame);
}

/// Another in each frame: eye, lamps, beams, what moves, letters. Effects come and go, and stay for some frames.
FrameInput frame_of(std::size_t frame) {
  const auto at = static_cast<double>(frame);
  FrameInput input = driver_view();
  input.exposure_per_cdm2 = 0.3;
  input.camera.eye_m.x += 0.5 * at;
  for (PlacedLamp& lamp : input.lamps) lamp.position_m.x += 0.5 * at;
  input.moving = {{0, {12.0, -3.0 + 0.5 * at, 0.0}, glm::dmat3(1.0)}};
  if (frame >= 2 && frame < 6) {
    input.air.visibility_m = 60.0 + at;
    input.effects[static_cast<std::size_t>(Effect::kFog)] = 1;
  }
  if (frame >= 4 && frame < 9) input.glare = {{input.camera.eye_m + glm::dvec3(10.0, 1.0 + 0.1 * at, 0.5), 2.0 + at}};
  if (frame >= 9) input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  if (frame != 7) input.overlay = {"frame " + std::to_string(frame)};
  if (frame >= 7 && frame < 10) {
    ViewInput more = input;
    more.camera.eye_m.z += 1.0;
    more.part = {0.6, 0.1, 0.3, 0.3};
    input.more_views = {more};
  }
  return input;
}

/// Frames one after the other, of which this one is kept, two go before it, and so many follow.
Image8 picture_of(Renderer& renderer, std::size_t kept, std::size_t after, const GuiContent& panel) {
  for (std::size_t frame = kept - std::min<std::size_t>(kept, 2); frame <= kept + after; ++frame) {
    if (frame % 3 == 0 || frame + 2 == kept) renderer.set_beam(0, beam_of(frame / 3 * 3));
    FrameInput input = frame_of(frame);
    if (frame >= 3 && frame < 8) input.gui = &panel;
    input.want_image = frame == kept;
    renderer.draw(input);
  }
  return renderer.read_image();
}

Result<Renderer> renderer_with(std::size_t frames_in_flight) {
  Result<Renderer> made = Renderer::create(
      {.width_px = kWidth_px, .height_px = kHeight_px, .validation = true, .frames_in_flight = frames_in_flight});
  if (made && !made->load_scene(yard(), post()).ok()) return Error{"scene", "not loaded"};
  return made;
}

TEST(FramesInFlight, EachIsDrawnFromWhatWasWrittenForIt) {
  Result<Renderer> one = renderer_with(1), two = renderer_with(2);
  ASSERT_TRUE(one && two);
  const GuiContent gui = panel(1920.0f, 1080.0f);
  for (std::size_t kept = 2; kept <= kFrames; kept += 3)  // pipelines: who makes one waits for it
    (void)picture_of(*two, kept, 0, gui);
  std::vector<Image8> all;
  for (std::size_t kept = 0; kept < kFrames; ++kept) {
    // The next frame is written while the device draws the one that is kept.
    all.push_back(picture_of(*one, kept, 0, gui));
    const Image8 overlapped = picture_of(*two, kept, 1, gui);
    EXPECT_EQ(overlapped.rgba, all.back().rgba) << "frame " << kept;
    if (kept > 0) {
      EXPECT_NE(all[kept].rgba, all[kept - 1].rgba) << "the frames are to differ";
    }
  }
  EXPECT_EQ(one->validation_messages() + two->validation_messages(), 0u);
}

TEST(FramesInFlight, APictureIsReadWhileTheNextFrameIsDrawn) {
  Result<Renderer> one = renderer_with(1), two = renderer_with(2);
  ASSERT_TRUE(one && two);
  const GuiContent gui = panel(1920.0f, 1080.0f);
  const Image8 alone = picture_of(*one, 2, 0, gui);
  EXPECT_TRUE(one->has_kept()) << "it was waited for";
  (void)picture_of(*two, 2, 0, gui);  // pipelines: who makes one waits for it
  FrameInput input = frame_of(2);
  input.want_image = true;
  two->draw(input);
  EXPECT_FALSE(two->has_kept()) << "it is on its way";
  input.want_image = false;
  two->draw(input);
  EXPECT_TRUE(two->has_kept());
  EXPECT_EQ(two->read_image().rgba, alone.rgba);
  EXPECT_FALSE(two->draw(input).timed_kept) << "of the frame that was on its way while the picture was read";
  EXPECT_TRUE(two->has_kept()) << "the frame that has its number now keeps nothing";
  two->resize(kWidth_px / 2, kHeight_px / 2);
  two->draw(input);
  EXPECT_EQ(two->read_image().rgba, alone.rgba) << "what is kept stays when the size changes";
  EXPECT_EQ(one->validation_messages() + two->validation_messages(), 0u);
}

TEST(FramesInFlight, TimesAreToldOnceForEachFrame) {
  Result<Renderer> renderer = renderer_with(2);
  ASSERT_TRUE(renderer);
  renderer->set_beam(0, beam_of(0));
  FrameInput input = driver_view();
  EXPECT_TRUE(renderer->draw(input).timed) << "it made pipelines, so it was waited for";
  EXPECT_FALSE(renderer->draw(input).timed) << "it is on its way";
  FrameResult before = renderer->draw(input);
  EXPECT_TRUE(before.timed) << "of the one before";
  EXPECT_GT(before.wall_ms, 0.0);
  EXPECT_GT(before.gpu_ms, 0.0);
  EXPECT_EQ(before.passes.size(), before.pass_count);
  EXPECT_FALSE(before.timed_kept);
  input.want_image = true;
  renderer->draw(input);
  renderer->finish();
  input.want_image = false;
  before = renderer->draw(input);
  EXPECT_TRUE(before.timed && before.timed_kept) << "of the one that was kept, and finished meanwhile";
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// The time of a frame ends when the device has done it, not when the next one is drawn.
TEST(FramesInFlight, WhoHasTimeWaitsForAFrameAsLongAsHeLikes) {
  Result<Renderer> renderer = renderer_with(2);
  ASSERT_TRUE(renderer);
  renderer->set_beam(0, beam_of(0));
  const FrameInput input = driver_view();
  for (int i = 0; i < 3; ++i) renderer->draw(input);
  ASSERT_TRUE(renderer->finish_within(std::chrono::minutes(1)));
  renderer->draw(input);  // takes the times of the one before
  const auto begin = std::chrono::steady_clock::now();
  renderer->draw(input);
  EXPECT_TRUE(renderer->finish_within(std::chrono::minutes(1)));
  const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(took_ms));
  const FrameResult after = renderer->draw(input);
  ASSERT_TRUE(after.timed);
  EXPECT_GT(after.wall_ms, 0.0);
  EXPECT_LE(after.wall_ms, took_ms);
  FrameInput many = input;
  many.more_views.assign(60, input);
  renderer->draw(many);  // makes no pipelines, and takes the device a while
  EXPECT_FALSE(renderer->finish_within(std::chrono::nanoseconds(0)));
  EXPECT_TRUE(renderer->finish_within(std::chrono::minutes(1)));
  EXPECT_TRUE(renderer->finish_within(std::chrono::nanoseconds(0))) << "nothing is on its way";
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

TEST(FramesInFlight, OneOrTwo) {
  EXPECT_FALSE(Renderer::create({.width_px = 16, .height_px = 16, .frames_in_flight = 0}));
  EXPECT_FALSE(Renderer::create({.width_px = 16, .height_px = 16, .frames_in_flight = 3}));
}

// Both are one interval, up to what follows the device's end.
TEST(FramesInFlight, AFrameThatMakesPipelinesSaysHowLongThatTook) {
  Result<Renderer> renderer =
      Renderer::create({.width_px = 320, .height_px = 180, .validation = true, .frames_in_flight = 2});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  renderer->set_beam(0, beam_of(0));
  FrameInput input = driver_view();
  for (int i = 0; i < 3; ++i) renderer->draw(input);
  input.air.visibility_m = 60.0;
  const auto begin = std::chrono::steady_clock::now();
  const FrameResult result = renderer->draw(input);
  const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_GT(result.pipelines_made, 0u);
  EXPECT_GT(result.wall_ms, 0.9 * took_ms);
  EXPECT_LE(result.wall_ms, took_ms);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
