// On the device: the picture of two designs' difference and ratio has the colours of what each alone gives there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shaders/lib/tone.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"

namespace phare {
namespace {

/// Bright in a band of the given height, dark above and below: two of them cross in places.
IntensityTable band(double centre_deg, double peak_cd) {
  IntensityTable table;
  for (double at = -60.0; at <= 60.0; at += 4.0) table.first_deg.push_back(at), table.second_deg.push_back(at);
  for (const double first : table.first_deg)
    for (const double second : table.second_deg)
      table.candela.push_back(peak_cd * std::exp(-std::pow((second - centre_deg) / 6.0, 2.0)) *
                              (1.2 + std::cos(0.1 * first)));
  return table;
}

class VersusOnDevice : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    renderer->set_beam(0, image_of(band(-4.0, 9000.0)));
    renderer->set_beam(1, image_of(band(2.0, 12000.0)));
    ASSERT_TRUE(renderer->load_scene(black_wall(30.0)).ok());
  }
  static FrameInput both() {
    FrameInput input;
    input.camera.eye_m = {0.0, 0.0, 1.2};
    input.lamps = {{.position_m = {0.5, 0.6, 0.7}, .beam = 0},
                   {.position_m = {0.5, -0.6, 0.7}, .beam = 0},
                   {.position_m = {0.5, 0.6, 0.9}, .beam = 1, .of_b = true}};
    return input;
  }
  /// Lux at each pixel by those of the lamps that are of B, or of A.
  std::vector<double> lux(bool of_b) {
    FrameInput one = both();
    std::erase_if(one.lamps, [&](const PlacedLamp& lamp) { return lamp.of_b != of_b; });
    one.want_hdr = true;
    renderer->draw(one);
    const ImageF image = renderer->read_hdr();
    std::vector<double> lx;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) lx.push_back(static_cast<double>(image.rgba[i]));
    return lx;
  }
};

TEST_F(VersusOnDevice, ColoursAreThoseOfWhatEachGivesAlone) {
  const std::vector<double> a = lux(false), b = lux(true);
  for (const View view : {View::kDifference, View::kRatio}) {
    SCOPED_TRACE(view == View::kRatio ? "ratio" : "difference");
    FrameInput input = both();
    input.view = view;
    input.want_image = true;
    const FrameResult result = renderer->draw(input);
    EXPECT_FALSE(result.effects.on(Effect::kHdrImage)) << "lux needs no image of luminance";
    const Image8 image = renderer->read_image();
    ASSERT_EQ(image.rgba.size(), 4 * a.size());
    std::size_t more = 0, less = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] == 0.0 && b[i] == 0.0) continue;  // beside the wall
      // What the 16-bit floats that a and b were read from leave open, 2^-11 of each, and the step of the picture.
      const double room_lx = (a[i] + b[i]) / 2048.0;
      const auto share = [&](double by_lx) {
        const auto of_a = static_cast<float>(a[i] - by_lx), of_b = static_cast<float>(b[i] + by_lx);
        if (view == View::kDifference) return shader::difference_share(of_b - of_a);
        if (std::max(of_a, of_b) < shader::kVersusDark_lx) return 0.0f;
        return shader::ratio_share(std::max(of_b, 1e-3f) / std::max(of_a, 1e-3f));
      };
      const glm::vec3 low = shader::versus_signal(share(-room_lx)), high = shader::versus_signal(share(room_lx));
      if (view == View::kRatio && std::abs(std::max(a[i], b[i]) - 0.1) < 1e-3) continue;  // dark, or not yet
      for (int channel = 0; channel < 3; ++channel) {
        const double seen = image.rgba[4 * i + static_cast<std::size_t>(channel)];
        const double least = 255.0 * static_cast<double>(std::min(low[channel], high[channel]));
        const double most = 255.0 * static_cast<double>(std::max(low[channel], high[channel]));
        ASSERT_GE(seen, least - 1.0) << i << ": " << a[i] << ", " << b[i];
        ASSERT_LE(seen, most + 1.0) << i << ": " << a[i] << ", " << b[i];
      }
      more += b[i] > 1.5 * a[i] ? 1 : 0, less += a[i] > 1.5 * b[i] ? 1 : 0;
    }
    EXPECT_GT(more, 100u);
    EXPECT_GT(less, 100u);
  }
}

}  // namespace
}  // namespace phare
