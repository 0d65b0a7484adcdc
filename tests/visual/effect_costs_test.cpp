// What each effect adds to a frame: passes, bytes and time, as the graph counts them. Those of shadows, fog, rays and
// glare stand in the tests of these.
#include <gtest/gtest.h>

#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/effects_of_frame.h"

namespace phare {
namespace {

class EffectCosts : public SharedRenderer {};

// Of every pass and image somebody says for what it is: an effect, or what is there in any frame.
TEST_F(EffectCosts, WhatEffectsAddAndTheRestAreTheFrame) {
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  const auto told = [](const FrameResult& frame, Effect effect) {
    return frame.effect_costs[static_cast<std::size_t>(effect)];
  };
  const FrameResult plain = renderer->draw(input);
  for (const EffectRow& row : effect_table()) {
    EXPECT_EQ(told(plain, row.effect).passes, 0u) << row.name;
    EXPECT_EQ(told(plain, row.effect).bytes, 0u) << row.name;
    EXPECT_FALSE(effect_time_ms(plain, row.effect).has_value()) << row.name;
  }
  EXPECT_EQ(plain.other_cost.passes, plain.pass_count);
  EXPECT_EQ(plain.other_cost.bytes, plain.image_bytes + plain.shared_image_bytes);

  // Each with a pass, and two views of which the second looks into a lamp.
  input.effects[static_cast<std::size_t>(Effect::kDepthFirst)] = 1;
  input.overlay = {"a line"};
  input.want_hdr = true;
  ViewInput second = driver_view();
  second.effects = input.effects;
  second.part = {0.5, 0.0, 0.5, 0.5};
  second.glare = {{input.camera.eye_m + input.camera.world_from_eye * glm::dvec3(10.0, 0.0, 0.0), 1.0}};
  input.more_views = {second};
  const FrameResult frame = renderer->draw(input);
  EXPECT_EQ(told(frame, Effect::kDepthFirst).passes, 2u);
  EXPECT_EQ(told(frame, Effect::kOverlay).passes, 1u);
  EXPECT_EQ(told(frame, Effect::kHdrImage).passes, 1u) << "of the first view";
  EXPECT_EQ(told(frame, Effect::kGlare).passes, 1u) << "of the second";
  EXPECT_GE(told(frame, Effect::kHdrImage).bytes, 320u * 180u * 8u);
  EXPECT_EQ(told(frame, Effect::kGlare).bytes, 0u);
  std::uint32_t passes = frame.other_cost.passes;
  std::uint64_t bytes = frame.other_cost.bytes;
  for (const EffectCost& cost : frame.effect_costs) passes += cost.passes, bytes += cost.bytes;
  EXPECT_EQ(passes, frame.pass_count);
  EXPECT_EQ(bytes, frame.image_bytes + frame.shared_image_bytes);
  EXPECT_EQ(frame.other_cost.passes, 2u) << "a lamp pass each";
  for (const Effect effect : {Effect::kDepthFirst, Effect::kOverlay, Effect::kHdrImage, Effect::kGlare})
    EXPECT_TRUE(effect_time_ms(frame, effect).has_value());
  EXPECT_FALSE(effect_time_ms(frame, Effect::kFog).has_value());
}

}  // namespace
}  // namespace phare
