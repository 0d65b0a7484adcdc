// Unit: the gui pass on the device: what a panel costs, shown and hidden, and that it lies where it says.
#include <gtest/gtest.h>

#include <memory>

#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/gui_content.h"
#include "visual/passes/wrap.h"

namespace phare {
namespace {

class GuiOnDevice : public SharedRenderer {};

/// A rectangle of one colour, cut off at the right edge of its draw.
GuiContent rectangle(float left_px, float top_px, float right_px, float bottom_px, float cut_off_px,
                     std::array<std::uint8_t, 4> srgba) {
  GuiContent content;
  content.atlas = std::make_shared<const GuiAtlas>(GuiAtlas{1, 1, {255}});
  for (const auto& [x, y] :
       {std::pair(left_px, top_px), {right_px, top_px}, {right_px, bottom_px}, {left_px, bottom_px}})
    content.vertices.push_back({x, y, 0.5f, 0.5f, srgba});
  content.indices = {0, 1, 2, 0, 2, 3};
  content.draws = {{.indices = 6, .right_px = cut_off_px, .bottom_px = 180.0f}};
  return content;
}

std::array<int, 3> pixel(const Image8& image, int x, int y) {
  const std::size_t at =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(x));
  return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2]};
}

FrameInput black() {
  FrameInput input;
  input.sky_luminance_cdm2 = 0.0;
  input.want_image = true;
  return input;
}

TEST_F(GuiOnDevice, TrianglesLieWhereTheyAreAndAreCutOffAtTheirEdges) {
  FrameInput input = black();
  const GuiContent content = rectangle(40.0f, 30.0f, 120.0f, 60.0f, 100.0f, {200, 100, 50, 255});
  input.gui = &content;
  renderer->draw(input);
  const Image8 image = renderer->read_image();
  const std::array<int, 3> colour{200, 100, 50}, none{0, 0, 0};
  // The first and the last pixels inside, and those beside them: middles lie at halves.
  EXPECT_EQ(pixel(image, 40, 30), colour);
  EXPECT_EQ(pixel(image, 99, 59), colour);
  EXPECT_EQ(pixel(image, 39, 30), none);
  EXPECT_EQ(pixel(image, 40, 29), none);
  EXPECT_EQ(pixel(image, 40, 60), none);
  EXPECT_EQ(pixel(image, 100, 45), none) << "beyond the edge of its draw";
}

// Rows that would be too small to be read under each other stand in columns; few rows in one.
TEST_F(GuiOnDevice, ManyRowsOfAPanelStandInColumns) {
  const auto reaches_px = [&](std::size_t rows) {
    FrameInput input = black();
    input.panel.place = OverlayPanel::Place::kLeft;
    input.panel.rows.assign(rows, {"K", "steer"});
    renderer->draw(input);
    const Image8 image = renderer->read_image();
    int right_px = 0;
    for (int x = 0; x < image.width_px; ++x)
      if (pixel(image, x, 20) != std::array<int, 3>{0, 0, 0}) right_px = x;
    return right_px;
  };
  constexpr int kEdge_px = 11;  // the least letters: three of it beside one column, one between two
  const int one = reaches_px(5), column = one - 3 * kEdge_px;
  EXPECT_GT(column, 30);
  EXPECT_NEAR(reaches_px(20), 2 * column + 4 * kEdge_px, 2);
  EXPECT_NEAR(reaches_px(30), 3 * column + 5 * kEdge_px, 3);
}

TEST_F(GuiOnDevice, AlphaBlendsAsDisplayed) {
  FrameInput input = black();
  GuiContent content = rectangle(0.0f, 0.0f, 320.0f, 180.0f, 320.0f, {200, 200, 200, 255});
  const GuiContent half = rectangle(0.0f, 0.0f, 160.0f, 180.0f, 320.0f, {0, 0, 0, 128});
  content.vertices.insert(content.vertices.end(), half.vertices.begin(), half.vertices.end());
  content.indices.insert(content.indices.end(), half.indices.begin(), half.indices.end());
  content.draws.push_back({.first_index = 6, .indices = 6, .first_vertex = 4, .right_px = 320.0f, .bottom_px = 180.0f});
  input.gui = &content;
  renderer->draw(input);
  const Image8 image = renderer->read_image();
  // 200·(1 - 128/255) is 99.6; the device rounds to one of its neighbours.
  EXPECT_NEAR(pixel(image, 10, 90)[0], 99.6, 1.0);
  EXPECT_EQ(pixel(image, 300, 90)[0], 200);
}

// Hidden there is no pass, no image, no byte, no pipeline; shown one pass; hidden again all is as before.
TEST_F(GuiOnDevice, HiddenItCostsNothing) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = black();
  input.want_image = false;
  // Nothing of this test has been drawn yet: with the pipeline that the tests above have made or without.
  renderer->draw(input);
  const FrameResult without = renderer->draw(input);
  const std::uint64_t bytes = renderer->device_memory_bytes();
  for (const PassTime& pass : without.passes) EXPECT_NE(pass.name, "gui");
  EXPECT_FALSE(without.effects.on(Effect::kGui));
  EXPECT_EQ(without.effects[Effect::kGui].reason, "the panel is hidden");
  EXPECT_EQ(without.pipelines_made, 0u);

  const GuiContent content = rectangle(40.0f, 30.0f, 120.0f, 60.0f, 100.0f, {200, 100, 50, 255});
  input.gui = &content;
  const FrameResult with = renderer->draw(input);
  EXPECT_EQ(with.pass_count, without.pass_count + 1);
  EXPECT_EQ(with.draws, without.draws + 1);
  EXPECT_EQ(with.triangles, without.triangles + 2);
  EXPECT_EQ(with.image_bytes, without.image_bytes) << "it draws into the picture that is there";
  EXPECT_TRUE(with.effects.on(Effect::kGui));
  EXPECT_GT(renderer->device_memory_bytes(), bytes);
  EXPECT_EQ(renderer->draw(input).pipelines_made, 0u) << "once";

  input.gui = nullptr;
  const FrameResult again = renderer->draw(input);
  EXPECT_EQ(again.pass_count, without.pass_count);
  EXPECT_EQ(again.draws, without.draws);
  EXPECT_EQ(again.pipelines_made, 0u);
  EXPECT_EQ(renderer->device_memory_bytes(), bytes);
}

// A renderer that never shows a panel has made nothing for it; the first one makes one pipeline.
TEST(Wrap, ALineIsCutAtBlanksAndAFigureStaysWhole) {
  const auto letters = [](const std::string& text) { return static_cast<double>(text.size()); };
  std::vector<std::string> rows;
  wrap("facing it 2.995 lx   and 19.5 of it", 12.0, letters, rows);
  EXPECT_EQ(rows, (std::vector<std::string>{"facing it", "2.995 lx", "and 19.5 of", "it"}));
  rows.clear();
  wrap("  22.8cd/m2-is-long on", 6.0, letters, rows);
  EXPECT_EQ(rows, (std::vector<std::string>{"  22.8cd/m2-is-long", "on"}));
  rows.clear();
  wrap("", 6.0, letters, rows);
  EXPECT_EQ(rows, (std::vector<std::string>{""})) << "an empty line keeps its row";
}

TEST(GuiPipeline, IsMadeByTheFirstPanel) {
  Result<Renderer> made = Renderer::create({.width_px = 64, .height_px = 36, .validation = true});
  ASSERT_TRUE(made.ok()) << made.error().text();
  FrameInput input;
  made->draw(input);
  EXPECT_EQ(made->draw(input).pipelines_made, 0u);
  const GuiContent content = rectangle(0.0f, 0.0f, 8.0f, 8.0f, 8.0f, {255, 255, 255, 255});
  input.gui = &content;
  EXPECT_EQ(made->draw(input).pipelines_made, 1u);
  EXPECT_EQ(made->validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
