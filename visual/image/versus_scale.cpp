#include "visual/image/versus_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lib/tone.h"

namespace phare {

double versus_share(double value, VersusScale scale) {
  const auto number = static_cast<float>(value);
  return static_cast<double>(scale == VersusScale::kRatio ? shader::ratio_share(number)
                                                          : shader::difference_share(number));
}

Colour versus_colour_at(double share) {
  const glm::vec3 signal = shader::versus_signal(static_cast<float>(share));
  const auto part = [](float of_one) { return static_cast<std::uint8_t>(std::lround(255.0f * of_one)); };
  return {part(signal.x), part(signal.y), part(signal.z)};
}

Colour versus_colour(double value, VersusScale scale) {
  return versus_colour_at(versus_share(value, scale));
}

std::vector<std::pair<double, const char*>> versus_marks(VersusScale scale) {
  if (scale == VersusScale::kRatio)
    return {{8, "8"}, {4, "4"}, {2, "2"}, {1, "1"}, {0.5, "1/2"}, {0.25, "1/4"}, {0.125, "1/8"}};
  return {{30, "+30"}, {10, "+10"}, {3, "+3"}, {1, "+1"}, {0, "0"}, {-1, "-1"}, {-3, "-3"}, {-10, "-10"}, {-30, "-30"}};
}

double versus_dark_lx() {
  return static_cast<double>(shader::kVersusDark_lx);
}

}  // namespace phare
