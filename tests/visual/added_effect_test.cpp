// An effect that a program adds, and a second view that does not call for it: what a stranger writes, in one place.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "tests/visual/yard.h"
#include "visual/effects_of_frame.h"
#include "visual/passes/pipeline.h"
#include "visual/picture_effect.h"

namespace phare {
namespace {

/// Bars above and below the picture, as in a cinema, where lamps are lit.
constexpr std::array<std::string_view, 3> kLevels{"off", "thin", "thick"};
const EffectRow kBars{
    .effect = {}, .name = "bars", .levels = kLevels, .needs = "a pass", .decide = [](const EffectFacts& facts) {
      return facts.lit_lamps > 0 ? EffectDecision{1, "lamps are lit"} : EffectDecision{0, "it is dark"};
    }};

struct Bars : PictureEffect {
  void draw(const PictureDraw& at) override {
    at.graph.pass("bars", {{&at.picture, gpu::Use::kColourTarget}}, [&](gpu::Recorder& commands) {
      const vk::RenderingAttachmentInfo target = attachment(at.picture, vk::ImageLayout::eColorAttachmentOptimal,
                                                            vk::AttachmentLoadOp::eLoad, vk::ClearColorValue{});
      commands.beginRendering(vk::RenderingInfo{
          .renderArea = at.area, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &target});
      const std::uint32_t rows = at.area.extent.height * static_cast<std::uint32_t>(at.level) / 10;
      const std::int32_t below = at.area.offset.y + static_cast<std::int32_t>(at.area.extent.height - rows);
      const vk::Extent2D bar{at.area.extent.width, rows};
      const std::array bars{vk::ClearRect{{at.area.offset, bar}, 0, 1},
                            vk::ClearRect{{{at.area.offset.x, below}, bar}, 0, 1}};
      const vk::ClearValue red(vk::ClearColorValue(std::array{1.0f, 0.0f, 0.0f, 1.0f}));
      commands.clearAttachments(vk::ClearAttachment{vk::ImageAspectFlagBits::eColor, 0, red}, bars);
      commands.endRendering();
    });
  }
};

/// The driver's view above, and below it one that no lamp lights.
FrameInput two_views() {
  FrameInput input = driver_view();
  input.part = {0.0, 0.0, 1.0, 0.5};
  input.more_views = {ViewInput(input)};
  input.more_views[0].lamps.clear();
  input.more_views[0].part = {0.0, 0.5, 1.0, 0.5};
  input.want_image = true;
  return input;
}
// To here fewer than 60 lines: the effect and the second view.

class AddedEffects : public testing::Test {
 protected:
  static Renderer made() {
    Result<Renderer> renderer = Renderer::create({.width_px = 320, .height_px = 360, .validation = true});
    if (!renderer) throw std::runtime_error(renderer.error().text());
    if (!renderer->load_scene(yard()).ok()) throw std::runtime_error("the yard is a scene");
    renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
    return std::move(*renderer);
  }
  static bool red(const Image8& image, int row) {
    const std::size_t at = 4 * static_cast<std::size_t>(row * image.width_px + image.width_px / 2);
    return image.rgba[at] == 255 && image.rgba[at + 1] == 0 && image.rgba[at + 2] == 0;
  }
};

TEST_F(AddedEffects, DrawWhereTheyDecideAndAreToldAsOthersAre) {
  const auto plain_renderer = [&] {
    Renderer renderer = made();
    return renderer.draw(two_views());
  };
  const FrameResult plain = plain_renderer();
  {
    const AddedEffect bars(kBars, [](gpu::Device&) { return std::make_unique<Bars>(); });
    ASSERT_EQ(effect_table().size(), kEffectCount + 1);
    Renderer renderer = made();
    FrameInput input = two_views();
    const FrameResult frame = renderer.draw(input);
    const Image8 image = renderer.read_image();
    EXPECT_TRUE(red(image, 0) && red(image, 17) && red(image, 162) && red(image, 179));
    EXPECT_FALSE(red(image, 18) || red(image, 161) || red(image, 180) || red(image, 359));

    // Counted, timed and explained for itself; the second view has none of it.
    const EffectCost& cost = frame.effect_costs[static_cast<std::size_t>(bars.effect())];
    EXPECT_EQ(cost.passes, 1u);
    EXPECT_EQ(frame.pass_count, plain.pass_count + 1);
    EXPECT_EQ(frame.views[1].passes, plain.views[1].passes);
    EXPECT_EQ(frame.image_bytes, plain.image_bytes);
    EXPECT_TRUE(effect_time_ms(frame, bars.effect()).has_value());
    EXPECT_NE(explain(frame.effects).find("bars            thin    lamps are lit\n"), std::string::npos);
    EXPECT_NE(explain(frame.views[1].effects).find("bars            off     it is dark\n"), std::string::npos);

    // A level by the user, and off: then the frame is what it was.
    input.effects[static_cast<std::size_t>(bars.effect())] = 2;
    renderer.draw(input);
    EXPECT_TRUE(red(renderer.read_image(), 35));
    input.effects[static_cast<std::size_t>(bars.effect())] = 0;
    const FrameResult off = renderer.draw(input);
    EXPECT_EQ(off.pass_count, plain.pass_count);
    EXPECT_FALSE(red(renderer.read_image(), 0));
    EXPECT_EQ(renderer.validation_messages(), 0u);
  }
  EXPECT_EQ(effect_table().size(), kEffectCount);
  EXPECT_EQ(plain_renderer().pass_count, plain.pass_count);
}

TEST_F(AddedEffects, OverLuminanceCallForItsImage) {
  EffectRow row = kBars;
  row.over_luminance = true;
  const AddedEffect bars(row, [](gpu::Device&) { return std::make_unique<Bars>(); });
  Renderer renderer = made();
  const FrameResult frame = renderer.draw(two_views());
  EXPECT_EQ(frame.views[0].effects[Effect::kHdrImage].reason, "bars is drawn over luminance in cd/m²");
  EXPECT_FALSE(frame.views[1].effects.on(Effect::kHdrImage));
  const Image8 image = renderer.read_image();
  EXPECT_GT(image.rgba[0], 50);
  EXPECT_LT(image.rgba[0], 250) << "cd/m² before the tone curve, not the display's full red";
  for (const View other : {View::kFalseColour, View::kClipping}) {
    FrameInput input = two_views();
    input.view = other;
    const FrameResult without = renderer.draw(input);
    EXPECT_FALSE(without.views[0].effects.on(bars.effect())) << "there is no luminance to draw it over";
    EXPECT_FALSE(without.views[0].effects.on(Effect::kHdrImage));
  }
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

TEST_F(AddedEffects, AreRefusedWithANameThatIsTakenOrWithoutRoom) {
  EffectRow fog = kBars;
  fog.name = "fog";
  EXPECT_THROW(AddedRow{fog}, std::invalid_argument);
  std::vector<std::string> names;
  for (std::size_t i = kEffectCount; i < kMostEffects; ++i) names.push_back("effect " + std::to_string(i));
  std::vector<std::unique_ptr<AddedRow>> rows;
  EffectRow row = kBars;
  for (const std::string& name : names) row.name = name, rows.push_back(std::make_unique<AddedRow>(row));
  EXPECT_THROW(AddedRow{kBars}, std::invalid_argument);
  while (!rows.empty()) rows.pop_back();
  EXPECT_EQ(effect_table().size(), kEffectCount);
}

}  // namespace
}  // namespace phare
