// What maps of shadows hold: how far to the sides, how many, and of sheets that are seen from both sides.
#include <gtest/gtest.h>

#include <vector>

#include "tests/visual/shape.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/passes/shadows.h"

namespace phare {
namespace {

class ShadowMaps : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer != nullptr) renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  }
};

// A plate above the lamp, 45° to 63° up. Of a beam that shines there too it casts; what goes past the sides of any map
// is told.
TEST_F(ShadowMaps, OfABeamThatShinesHighAreMadeThereAndWhatIsBesideIsTold) {
  Shape shape;
  shape.box({1, -1, 3}, {2, 1, 3.2});
  ASSERT_TRUE(renderer->load_scene(shape.scene()).ok());
  const auto even_to = [](double first_deg) {
    IntensityTable table;
    table.first_deg = {-first_deg, first_deg}, table.second_deg = {-70, 70};
    table.candela.assign(4, 1000.0);
    return image_of(table);
  };
  const std::vector<PlacedLamp> lamps{{.position_m = {0, 0, 1}}};
  const std::vector<MeasurePoint> points{{{3.5, 0, 6}, {0, 0, -1}}, {{3.5, 4, 6}, {0, 0, -1}}, {{7, 0, 6}, {0, 0, -1}}};
  renderer->set_beam(0, even_to(60.0));
  const auto open = renderer->measure(lamps, points);
  for (std::size_t level = 1; level < kShadowNames.size(); ++level) {
    const auto shadowed = renderer->measure(lamps, points, level);
    EXPECT_GT(open[0][0], 1.0f);
    EXPECT_EQ(shadowed[0][0], 0.0f) << kShadowNames[level];
    EXPECT_EQ(shadowed[0][1], open[0][1]) << kShadowNames[level];
    EXPECT_EQ(shadowed[0][2], open[0][2]) << kShadowNames[level];
  }
  FrameInput input;
  input.camera = {.eye_m = {-3, 0, 1.5}};
  input.lamps = lamps;
  const auto reason = [&] { return renderer->draw(input).effects[Effect::kShadows].reason; };
  EXPECT_EQ(reason().find("75°"), std::string::npos) << reason();
  renderer->set_beam(0, even_to(85.0));
  EXPECT_NE(reason().find("; light of 1 lamp more than 75° beside the axis goes through what stands there"),
            std::string::npos)
      << reason();
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = kRayShadows;
  EXPECT_EQ(reason().find("75°"), std::string::npos) << "rays go every way: " << reason();
}

TEST(ShadowLimits, ADeviceHoldsSoManyMapsAndSaysSo) {
  const ShadowLevel& soft = kShadowLevels[2];
  const ShadowLimits promised{.buffer_texels = 65'536, .image_side = 4096};
  EXPECT_EQ(shadow_maps_in_image(soft, promised), 4u);
  EXPECT_EQ(most_shadow_maps(soft, promised), 0u);
  EXPECT_EQ(most_shadow_maps(soft, {.buffer_texels = 3u * 2u * 768u * 512u, .image_side = 4096}), 3u);
  EXPECT_EQ(most_shadow_maps(soft, {.buffer_texels = 1u << 27, .image_side = 767}), 0u);
  EXPECT_EQ(most_shadow_maps(kShadowLevels[3], {.buffer_texels = 1u << 27, .image_side = 16'384}), kMostShadowMaps);
}

// A sheet that is seen from both sides casts with the side that faces the lamp, and must not shadow itself.
TEST_F(ShadowMaps, ASheetIsLitAndWhatIsBehindItIsDark) {
  Shape shape;
  shape.quad({30, -2, 0}, {30, 2, 0}, {36, 2, 3}, {36, -2, 3});  // leans back by 63 degrees
  ASSERT_TRUE(renderer->load_scene(shape.scene(true)).ok());
  const PlacedLamp lamp{.position_m = {0.0, 0.3, 1.5}};
  std::vector<MeasurePoint> points;
  for (int i = 1; i < 60; ++i)
    for (int k = 1; k < 40; ++k)
      points.push_back({{30 + 0.1 * i, -2 + 0.1 * k, 0.05 * i}, glm::normalize(glm::dvec3(-3, 0, 6))});
  const std::size_t on_sheet = points.size();
  for (int k = 1; k < 40; ++k) points.push_back({{45, -2 + 0.1 * k, 1.2}, {-1, 0, 0}});
  for (std::size_t level = 1; level < kShadowNames.size(); ++level) {
    const auto open = renderer->measure(std::span(&lamp, 1), points);
    const auto lx = renderer->measure(std::span(&lamp, 1), points, level);
    for (std::size_t i = 0; i < on_sheet; ++i) {
      if (open[0][i] > 0.0f) {
        ASSERT_EQ(lx[0][i], open[0][i]) << i << " at level " << level;
      }
    }
    for (std::size_t i = on_sheet; i < points.size(); ++i) EXPECT_EQ(lx[0][i], 0.0f) << i << " at level " << level;
  }
}

}  // namespace
}  // namespace phare
