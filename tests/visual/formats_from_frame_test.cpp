// Pipelines that read the shapes of lamps' tables from the frame draw as those that have them as constants do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/visual/formats.h"
#include "tests/visual/yard.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/renderer.h"

namespace phare {
namespace {

/// The lux of every pixel of the yard by one lamp with beam 0. Half floats.
struct YardPicture {
  std::vector<float> lx;
  std::uint64_t pipelines_made = 0;
};
YardPicture yard_lit(Renderer& renderer, ShapesFrom shapes) {
  FrameInput input = driver_view();
  input.lamps.resize(1);
  input.shapes = shapes;
  input.want_hdr = true;
  YardPicture picture;
  picture.pipelines_made = renderer.draw(input).pipelines_made;
  const ImageF image = renderer.read_hdr();
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) picture.lx.push_back(image.rgba[i]);
  return picture;
}

// What is found is found in the same way, but for a longer polynomial and a compare with the table's edge: as near as
// float32 has it. In half floats a pixel in a hundred may fall on the other side of a step of 2^-10.
TEST(FormatsFromTheFrame, ShapesFromTheFrameLightAsThoseOfThePipeline) {
  Result<Renderer> renderer = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  std::set<std::uint32_t> lookups;
  for (const Format& format : formats()) {
    const auto table = parse_lamp(format.text, format.name, format.settings);
    ASSERT_TRUE(table.ok()) << table.error().text();
    const BeamImage image = image_of(*table);
    renderer->set_beam(0, image);
    const YardPicture own = yard_lit(*renderer, ShapesFrom::kPipeline), any = yard_lit(*renderer, ShapesFrom::kFrame);
    std::size_t lit = 0, steps = 0;
    for (std::size_t i = 0; i < own.lx.size(); ++i) {
      lit += own.lx[i] > 0.01f ? 1 : 0;
      if (own.lx[i] == any.lx[i]) continue;
      ++steps;
      ASSERT_NEAR(own.lx[i], any.lx[i], own.lx[i] / 1024.0f + 1e-6f) << format.name << ", pixel " << i;
    }
    EXPECT_GT(lit, own.lx.size() / 8) << format.name;
    EXPECT_LT(steps, own.lx.size() / 100) << format.name;
    // One pipeline serves all tables that are looked up alike.
    const bool first = lookups.insert(for_any_light(pack_beam(image).shape).lookup).second;
    EXPECT_EQ(any.pipelines_made > 0, first) << format.name;
  }
  // Even with a coarse step; even, and rounded to decimals, fine ones and others; rounded otherwise; a whole turn; any
  // nodes; a screen's, even and any.
  EXPECT_EQ(lookups.size(), 8u) << "of " << formats().size() << " formats";
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// Two lamps: of one table, whose shape the first has for both, and of two, where each has its own. What a display
// shows, by shorter polynomials here and longer ones there, is the same to a step of 255; in fog too, whose grid is
// read in half floats: a thousandth, and a step is eight of them.
// Where a table ends in the midst of its light, a pixel on that limit may fall on either side of it.
TEST(FormatsFromTheFrame, TwoLampsLightFromTheFrameAsFromThePipeline) {
  Result<Renderer> renderer = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  const std::vector<Format> all = formats();
  const auto shown = [&](ShapesFrom shapes, bool foggy) {
    FrameInput input = driver_view();
    input.lamps[0].beam = 0, input.lamps[1].beam = 1;
    input.shapes = shapes;
    if (foggy) input.air.visibility_m = 60.0;
    input.want_image = true;
    renderer->draw(input);
    return renderer->read_image();
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::array<std::size_t, 2> of_lamp{i, i % 2 == 0 ? i : (i + 5) % all.size()};
    for (std::size_t lamp = 0; lamp < 2; ++lamp) {
      const Format& format = all[of_lamp[lamp]];
      const auto table = parse_lamp(format.text, format.name, format.settings);
      ASSERT_TRUE(table.ok()) << table.error().text();
      renderer->set_beam(lamp, image_of(*table));
    }
    for (const bool foggy : {false, true}) {
      const Image8 own = shown(ShapesFrom::kPipeline, foggy), any = shown(ShapesFrom::kFrame, foggy);
      std::size_t bright = 0, steps = 0, ends = 0;
      for (std::size_t k = 0; k < own.rgba.size(); ++k) {
        bright += own.rgba[k] > 40 && k % 4 != 3 ? 1 : 0;
        steps += own.rgba[k] != any.rgba[k] ? 1 : 0;
        ends += std::abs(own.rgba[k] - any.rgba[k]) > 1 ? 1 : 0;
      }
      EXPECT_GT(bright, own.rgba.size() / 10) << all[i].name;
      EXPECT_LT(steps, own.rgba.size() / 50) << all[i].name;
      EXPECT_LE(ends, 9u) << all[i].name << (foggy ? ", in fog" : "") << ": three pixels on a table's limit";
    }
  }
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// In a drive: what is made for the light is taken, else what is made for any; only where neither is, is it made.
TEST(FormatsFromTheFrame, ALightThatNoPipelineWasMadeForTakesOneForAny) {
  Result<Renderer> renderer = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  const std::vector<Format> all = formats();
  const auto shine = [&](const char* name) {
    const auto table = parse_lamp(format_named(all, name).text, name, {});
    ASSERT_TRUE(table.ok()) << table.error().text();
    renderer->set_beam(0, image_of(*table));
  };
  shine("a.ies");
  const YardPicture own = yard_lit(*renderer, ShapesFrom::kEither);
  EXPECT_GT(own.pipelines_made, 0u) << "nothing was made";
  EXPECT_EQ(yard_lit(*renderer, ShapesFrom::kPipeline).pipelines_made, 0u) << "those of the light were";
  EXPECT_GT(yard_lit(*renderer, ShapesFrom::kFrame).pipelines_made, 0u);
  const YardPicture still_own = yard_lit(*renderer, ShapesFrom::kEither);
  EXPECT_EQ(still_own.pipelines_made, 0u);
  EXPECT_EQ(still_own.lx, own.lx);

  shine("a_rounded.ies");
  (void)yard_lit(*renderer, ShapesFrom::kFrame);
  shine("a_half.ies");
  const YardPicture other = yard_lit(*renderer, ShapesFrom::kEither);
  EXPECT_EQ(other.pipelines_made, 0u);
  EXPECT_EQ(other.lx, yard_lit(*renderer, ShapesFrom::kFrame).lx);
  EXPECT_GT(yard_lit(*renderer, ShapesFrom::kPipeline).pipelines_made, 0u);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
