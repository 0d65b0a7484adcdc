// An audit that is drawn with a frame: the same figures as one by itself, and nothing that a driver would wait for.
#include "visual/audit_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
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

// A pixel that is no number and one whose light is missing are found; the sky is not asked.
TEST(Audits, NeitherWhatIsNoNumberNorMissingLightIsLeftOut) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<glm::vec4> places(8, glm::vec4(0.0f)), normals(8, glm::vec4(0.0f));
  for (std::size_t i = 0; i < 4; ++i) normals[i].w = 2.0f;  // the others are sky
  places[0].w = 5.0f, places[1].w = 3.0f, places[2].w = none;
  std::array<std::size_t, 8> counts{};
  for (const std::size_t pixel : audited_pixels(places, normals, 400, 7)) ++counts.at(pixel);
  EXPECT_EQ(counts[3], 400 / kDarkPixelIn) << "dark";
  for (const std::size_t lit : {0u, 1u, 2u}) EXPECT_NEAR(static_cast<double>(counts[lit]), 100.0, 40.0) << lit;
  EXPECT_EQ(counts[4] + counts[5] + counts[6] + counts[7], 0u);
  places[2].w = places[3].w = 1.0f;
  EXPECT_EQ(audited_pixels(places, normals, 400, 7).size(), 400u) << "none is dark";
  EXPECT_TRUE(audited_pixels(places, {normals.begin() + 4, normals.end()}, 400, 7).empty()) << "nothing is seen";
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
