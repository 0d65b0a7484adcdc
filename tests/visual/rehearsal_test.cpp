// Rehearsals: what a picture of another kind takes is made beside the frames, which stay as they are, and no frame
// after makes a pipeline.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "tests/visual/panel_content.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"

namespace phare {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kManyTurns = 200;

std::unique_ptr<Renderer> fresh(std::size_t frames_in_flight = 1) {
  Result<Renderer> made =
      Renderer::create({.width_px = 320, .height_px = 180, .validation = true, .frames_in_flight = frames_in_flight});
  if (!made || !made->load_scene(yard()).ok()) return nullptr;
  made->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  return std::make_unique<Renderer>(std::move(*made));
}

std::size_t& level_of(FrameInput& input, Effect effect) {
  return input.effects[static_cast<std::size_t>(effect)].emplace();
}

std::vector<std::pair<const char*, FrameInput>> kinds() {
  std::vector<std::pair<const char*, FrameInput>> all;
  const auto add = [&](const char* name, auto&& change) {
    change(all.emplace_back(name, driver_view()).second);
    all.back().second.want_image = true;
  };
  add("false colours", [](FrameInput& input) { input.view = View::kFalseColour; });
  add("by vertex", [](FrameInput& input) { input.method = Method::kVertex; });
  add("fog", [](FrameInput& input) { input.air.visibility_m = 60.0; });
  add("wet ground", [](FrameInput& input) { level_of(input, Effect::kWetGround) = 2; });
  add("snow that lies", [](FrameInput& input) { input.snow_cover_01 = 0.5; });
  return all;
}

/// Until all that it takes is made; how many times that took.
std::size_t rehearse(Renderer& renderer, const FrameInput& input, std::size_t most) {
  for (std::size_t turn = 1; turn <= kManyTurns; ++turn) {
    if (renderer.rehearse(input, most).ready()) return turn;
    while (renderer.is_making()) std::this_thread::sleep_for(1ms);
  }
  return kManyTurns + 1;
}

TEST(Rehearsal, AfterItNoFrameOfItsKindMakesAPipeline) {
  const std::unique_ptr<Renderer> renderer = fresh(), other = fresh();
  ASSERT_TRUE(renderer && other);
  renderer->draw(driver_view());
  for (const auto& [name, input] : kinds()) {
    EXPECT_GT(other->draw(input).pipelines_made, 0u) << name << ": nothing to rehearse";
    const std::size_t turns = rehearse(*renderer, input, 1);
    EXPECT_GT(turns, 1u) << name;
    EXPECT_LE(turns, kManyTurns) << name;
    EXPECT_EQ(renderer->draw(input).pipelines_made, 0u) << name;
    EXPECT_EQ(renderer->read_image().rgba, other->read_image().rgba) << name;
    EXPECT_EQ(rehearse(*renderer, input, 1), 1u) << name << ": all is there";
  }
  EXPECT_EQ(renderer->validation_messages() + other->validation_messages(), 0u);
}

TEST(Rehearsal, NorDoesAnAudit) {
  const std::unique_ptr<Renderer> renderer = fresh();
  ASSERT_TRUE(renderer);
  renderer->draw(driver_view());
  FrameInput input = driver_view();
  input.method = Method::kVertex;
  for (const bool audited : {false, true}) {
    std::size_t turns = 0;
    while (!renderer->rehearse(input, 4, audited).ready() && ++turns < kManyTurns)
      while (renderer->is_making()) std::this_thread::sleep_for(1ms);
    EXPECT_GT(turns, 0u) << audited;
    EXPECT_LT(turns, kManyTurns) << audited;
  }
  renderer->ask_audit(input);
  EXPECT_EQ(renderer->draw(input).pipelines_made, 0u);
  EXPECT_FALSE(renderer->take_audit(8, 1)->empty());
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// A software device makes its code at the first draw, so that those are taken in turns, too.
TEST(Rehearsal, DrawsWithNoMorePipelinesThanItIsTold) {
  const std::unique_ptr<Renderer> renderer = fresh();
  ASSERT_TRUE(renderer);
  renderer->draw(driver_view());
  FrameInput input = driver_view();
  input.snow_cover_01 = 0.5;
  const std::size_t all = renderer->rehearse(input, 1).left;
  ASSERT_GT(all, 1u);
  while (renderer->is_making()) std::this_thread::sleep_for(1ms);
  for (std::size_t left = all; left > 0; --left) EXPECT_EQ(renderer->rehearse(input, 1).left, left - 1);
  EXPECT_TRUE(renderer->rehearse(input, 1).ready());
}

// With all that a frame keeps for the next one: fog and maps of shadows, panel, overlay, what is read back.
TEST(Rehearsal, FramesAboutItStayAsTheyAre) {
  const GuiContent gui = panel(320.0f, 180.0f);
  const auto frame = [&](int number) {
    FrameInput input = driver_view();
    input.camera.eye_m.x += 0.5 * number;
    if (number < 4) input.air.visibility_m = 60.0;
    if (number > 1) input.overlay = {"frame " + std::to_string(number)};
    input.gui = number > 2 ? &gui : nullptr;
    input.want_image = true;
    return input;
  };
  for (const std::size_t in_flight : {1u, 2u}) {
    const std::unique_ptr<Renderer> plain = fresh(in_flight), rehearsing = fresh(in_flight);
    ASSERT_TRUE(plain && rehearsing);
    for (int number = 0; number < 6; ++number) {
      plain->draw(frame(number));
      rehearsing->draw(frame(number));
      for (const auto& [name, input] : kinds()) rehearsing->rehearse(input, 2);
      EXPECT_EQ(rehearsing->read_image().rgba, plain->read_image().rgba) << "frame " << number;
    }
    EXPECT_EQ(rehearsing->validation_messages() + plain->validation_messages(), 0u);
  }
}

TEST(Rehearsal, WhoLeavesMeanwhileLeavesNothingBehindThatIsStillUsed) {
  std::unique_ptr<Renderer> renderer = fresh();
  ASSERT_TRUE(renderer);
  renderer->draw(driver_view());
  renderer->rehearse(kinds().back().second, 1);
  renderer.reset();  // nothing of it is used after: the sanitizers would tell
}

}  // namespace
}  // namespace phare
