#include "visual/image/lux_scale.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/tone.h"

namespace phare {
namespace {

// The legend's ends: where the colours of false_colour begin and end.
constexpr double kLowest_lx = 0.3;
constexpr double kHighest_lx = 200.0;
constexpr int kBarWidth_px = 18;

std::uint8_t srgb(float linear) {
  const double c =
      linear <= 0.0031308f ? 12.92 * linear : 1.055 * std::pow(static_cast<double>(linear), 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0, 1.0) * 255.0));
}

}  // namespace

Colour false_colour(double illuminance_lx) {
  const glm::vec3 linear = shader::false_colour(static_cast<float>(illuminance_lx));
  return {srgb(linear.x), srgb(linear.y), srgb(linear.z)};
}

int isolux_band(double illuminance_lx) {
  return static_cast<int>(std::upper_bound(kIsoluxLevels_lx.begin(), kIsoluxLevels_lx.end(), illuminance_lx) -
                          kIsoluxLevels_lx.begin());
}

void draw_lux_legend(Image8& image, int x_px, int y_px, int height_px) {
  const double decades = std::log(kHighest_lx / kLowest_lx);
  for (int y = 0; y < height_px; ++y) {
    const double from_top_01 = static_cast<double>(y) / static_cast<double>(height_px - 1);
    fill_box(image, x_px, y_px + y, kBarWidth_px, 1, false_colour(kHighest_lx * std::exp(-decades * from_top_01)));
  }
  for (const double level_lx : kIsoluxLevels_lx) {
    const int y = y_px + static_cast<int>(std::log(kHighest_lx / level_lx) / decades * (height_px - 1));
    draw_line(image, x_px, y, x_px + kBarWidth_px + 3, y, {255, 255, 255});
    draw_text(image, x_px + kBarWidth_px + 7, y - text_height_px() / 2, std::to_string(static_cast<int>(level_lx)),
              {220, 220, 220});
  }
  draw_text(image, x_px, y_px - text_height_px() - 3, "lux", {220, 220, 220});
}

}  // namespace phare
