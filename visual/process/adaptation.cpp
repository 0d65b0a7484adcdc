#include "visual/process/adaptation.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

constexpr double kFastShare = 0.55;
constexpr double kFast_s = 0.055 / std::numbers::ln2;
constexpr double kSlow_s = 20.0 / std::numbers::ln2;
constexpr double kSceneLuminance_cdm2 = 0.3;
constexpr double kLeast = 0.1;  ///< of a component of the colour; a bulb of 2400 K has 0.13 in blue

}  // namespace

double degree_of_adaptation(double scene_cdm2) {
  constexpr double kDarkSurround = 0.8;
  return kDarkSurround * (1.0 - std::exp(-(scene_cdm2 + 42.0) / 92.0) / 3.6);
}

double colour_temperature_k(const glm::vec3& colour) {
  const glm::dvec3 c(colour);
  const double x = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, y = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
               z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z;
  const double sum = x + y + z;
  const double n = (x / sum - 0.3320) / (y / sum - 0.1858);
  return -449.0 * n * n * n + 3525.0 * n * n - 6823.3 * n + 5520.33;
}

void EyeAdaptation::see(SimTime now, const std::optional<glm::vec3>& light) {
  const double dt_s = now.seconds() - seen_.seconds();
  seen_ = now;
  if (!light) return;
  const glm::dvec3 target(*light);
  if (!begun_ || dt_s < 0.0) {
    fast_ = slow_ = target;
    begun_ = true;
    return;
  }
  fast_ += (target - fast_) * -std::expm1(-dt_s / kFast_s);
  slow_ += (target - slow_) * -std::expm1(-dt_s / kSlow_s);
}

glm::vec3 EyeAdaptation::white() const {
  if (fixed_k_) return black_body_colour(*fixed_k_);
  if (!begun_) return glm::vec3(1.0f);
  const double degree = degree_of_adaptation(kSceneLuminance_cdm2);
  const glm::dvec3 colour = kFastShare * fast_ + (1.0 - kFastShare) * slow_;
  // Light without red or blue, as of an amber lamp, must not make the rest of the world infinitely bright.
  const glm::dvec3 gain = degree / glm::max(colour, glm::dvec3(kLeast)) + (1.0 - degree);
  return glm::vec3(1.0 / gain);
}

double EyeAdaptation::adapted_k() const {
  if (fixed_k_) return *fixed_k_;
  return colour_temperature_k(glm::vec3(kFastShare * fast_ + (1.0 - kFastShare) * slow_));
}

nlohmann::json EyeAdaptation::json() const {
  return {{"seen_ns", seen_.ns},
          {"begun", begun_},
          {"fast", {fast_.x, fast_.y, fast_.z}},
          {"slow", {slow_.x, slow_.y, slow_.z}}};
}

bool EyeAdaptation::restore(const nlohmann::json& state) {
  try {
    EyeAdaptation other = *this;
    other.seen_.ns = state.at("seen_ns").get<std::int64_t>();
    other.begun_ = state.at("begun").get<bool>();
    const auto fast = state.at("fast").get<std::array<double, 3>>(),
               slow = state.at("slow").get<std::array<double, 3>>();
    other.fast_ = {fast[0], fast[1], fast[2]};
    other.slow_ = {slow[0], slow[1], slow[2]};
    *this = other;
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace phare
