// An audit that is drawn with a frame: the same figures as one by itself, and nothing that a driver would wait for.
#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>
#include <vector>

#include "tests/visual/yard.h"
#include "visual/renderer.h"

namespace phare {
namespace {

Renderer made(std::size_t frames_in_flight) {
  Result<Renderer> renderer =
      Renderer::create({.width_px = 320, .height_px = 180, .validation = true, .frames_in_flight = frames_in_flight});
  if (!renderer) throw std::runtime_error(renderer.error().text());
  if (!renderer->load_scene(yard()).ok()) throw std::runtime_error("the yard is a scene");
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  return std::move(*renderer);
}

// Asked for, an audit is drawn with the next frame, which neither waits for it nor counts it as its own.
TEST(Audits, AnAuditIsDrawnWithAFrame) {
  Renderer renderer = made(1);
  const FrameInput input = driver_view();
  EXPECT_FALSE(renderer.take_audit(8, 1).has_value()) << "none was asked for";
  const FrameResult without = renderer.draw(input);
  renderer.ask_audit(input);
  const FrameResult with = renderer.draw(input);
  EXPECT_EQ(std::tuple(with.draws, with.pass_count, with.triangles, with.images, with.image_bytes),
            std::tuple(without.draws, without.pass_count, without.triangles, without.images, without.image_bytes));
  const auto drawn = renderer.take_audit(64, 5);
  ASSERT_TRUE(drawn.has_value());
  EXPECT_FALSE(renderer.take_audit(64, 5).has_value()) << "once";
  const std::vector<AuditSample> alone = renderer.audit(input, 64, 5);
  ASSERT_EQ(drawn->size(), 64u);
  ASSERT_EQ(alone.size(), 64u);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ((*drawn)[i].illuminance_lx, alone[i].illuminance_lx);
    EXPECT_EQ((*drawn)[i].point.position_m, alone[i].point.position_m);
  }
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

TEST(Audits, AnAuditThatIsPreparedMakesNoPipeline) {
  for (const bool prepared : {false, true}) {
    Renderer renderer = made(1);
    const FrameInput input = driver_view();
    (void)renderer.draw(input);
    if (prepared) renderer.prepare_audit(input);
    renderer.ask_audit(input);
    EXPECT_EQ(renderer.draw(input).pipelines_made == 0, prepared);
    EXPECT_EQ(renderer.validation_messages(), 0u);
  }
}

// Where frames overlap it is there when the next one has been drawn.
TEST(Audits, AnAuditIsWaitedForByNoFrame) {
  Renderer renderer = made(2);
  const FrameInput input = driver_view();
  renderer.prepare_audit(input);
  (void)renderer.draw(input);
  for (int i = 0; i < 3; ++i) {
    renderer.ask_audit(input);
    (void)renderer.draw(input);
    EXPECT_FALSE(renderer.take_audit(8, 1).has_value());
    (void)renderer.draw(input);
    EXPECT_EQ(renderer.take_audit(8, 1).value_or(std::vector<AuditSample>{}).size(), 8u);
  }
  renderer.ask_audit(input);
  (void)renderer.draw(input);
  renderer.finish();
  EXPECT_TRUE(renderer.take_audit(8, 1).has_value()) << "all is done";
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
