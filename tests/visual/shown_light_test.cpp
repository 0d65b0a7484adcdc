// What a display's 8 bits do not show is left out of the light there (shader::kLookupShown): the picture against
// that by float64.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/straight_road.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/renderer.h"

namespace phare {
namespace {

class ShownLight : public testing::TestWithParam<bench::Nodes> {};

TEST_P(ShownLight, IsThatOfFloat64ButForPixelsThatRoundTheOtherWay) {
  Result<Renderer> renderer = Renderer::create({.width_px = 960, .height_px = 540, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(bench::straight_road()).ok());
  const IntensityTable beam = bench::straight_road_beam(GetParam());
  const AimedSource source{.table = &beam};
  renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
  if (const auto why = renderer->no_reference()) GTEST_SKIP() << *why;
  std::size_t lit = 0, other_step = 0;
  int most = 0;
  for (const double x_m : {0.0, 3.7, 40.0}) {
    FrameInput input = bench::straight_road_view(x_m);
    input.sky_luminance_cdm2 = 0.0;  // what no lamp reaches is black
    input.want_image = true;
    renderer->draw(input);
    const Image8 picture = renderer->read_image();
    input.method = Method::kReference;
    renderer->draw(input);
    const Image8 exact = renderer->read_image();
    ASSERT_EQ(picture.rgba.size(), exact.rgba.size());
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      int off = 0;
      for (std::size_t c = 0; c < 3; ++c)
        off = std::max(off, std::abs(static_cast<int>(picture.rgba[i + c]) - static_cast<int>(exact.rgba[i + c])));
      lit += exact.rgba[i + 1] > 0 ? 1 : 0;
      other_step += off > 0 ? 1 : 0;
      most = std::max(most, off);
    }
  }
  const double share = static_cast<double>(other_step) / static_cast<double>(lit);
  std::printf("%zu lit pixels: %d of 255 off at most, %.4f %% are off\n", lit, most, 100.0 * share);
  EXPECT_GT(lit, 300'000u);
  EXPECT_LE(most, 1);
  // A signal that is off by e steps rounds the other way in 2·e of all pixels. 2.2e-5 of 10° on a beam whose light
  // falls by 0.4 of itself in a degree there: 1e-4 of the light, 0.004 steps in the middle of the display's range.
  EXPECT_LT(share, 0.01);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Nodes, ShownLight, testing::Values(bench::Nodes::kEven, bench::Nodes::kRounded),
                         [](const auto& each) { return each.param == bench::Nodes::kEven ? "Even" : "Rounded"; });

}  // namespace
}  // namespace phare
