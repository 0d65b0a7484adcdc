#include "visual/scene/horizon.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "visual/scene/far_mesh.h"

namespace phare {

namespace {

// Crests farther away hide little. In a cell of 4 m half a sector of 0.9° fits up to here.
constexpr double kTo_m = 500.0;
// From afar the ground is drawn with corners beside their places by this.
constexpr float kDrawnLower_rad = static_cast<float>(2.0 * kFarGroundError_rad);

// Once round for 0 to 4, as the way along a square around the eye: less work than an angle, and in the same order.
double round_square(const glm::dvec2& p) {
  const double share = p.y / (std::abs(p.x) + std::abs(p.y));
  if (p.x < 0.0) return 2.0 - share;
  return share < 0.0 ? 4.0 + share : share;
}

glm::dvec2 direction_of(double way) {
  const double quarter = std::floor(way), part = way - quarter;
  const glm::dvec2 first(1.0 - part, part);
  const int turns = static_cast<int>(quarter) % 4;
  const glm::dvec2 turned = turns == 0   ? first
                            : turns == 1 ? glm::dvec2(-first.y, first.x)
                            : turns == 2 ? -first
                                         : glm::dvec2(first.y, -first.x);
  return glm::normalize(turned);
}

}  // namespace

Horizon::Horizon(const GroundHeights& ground, const glm::dvec3& eye_m) : ground_(&ground), eye_m_(eye_m) {
  row_of_.fill(-1);
  const bool above = !ground.none() && ground.least_m(glm::dvec2(eye_m)) < eye_m.z;
  if (!above) return;
  steps_ = static_cast<std::size_t>(kTo_m / ground.cell_m()) + 1;
  above_.reserve(kSectors / 4 * steps_);  // of a wide view
}

const float* Horizon::sector(int number) {
  std::int16_t& row = row_of_[static_cast<std::size_t>(number)];
  if (row >= 0) return &above_[static_cast<std::size_t>(row) * steps_];
  row = static_cast<std::int16_t>(above_.size() / steps_);
  above_.resize(above_.size() + steps_, -HUGE_VALF);
  float* above = &above_[static_cast<std::size_t>(row) * steps_];
  const glm::dvec2 step_m = ground_->cell_m() * direction_of(4.0 / kSectors * (number + 0.5));
  glm::dvec2 at_m(eye_m_);
  const auto eye_up_m = static_cast<float>(eye_m_.z);
  float most = -HUGE_VALF;
  bool whole = true;
  for (std::size_t k = 1; k < steps_; ++k) {
    at_m += step_m;
    const float least_m = whole ? ground_->least_m(at_m) : 0.0f;
    whole = whole && !std::isnan(least_m);  // beyond a gap one may see below what comes then
    if (whole)
      most = std::max(most, (least_m - eye_up_m) / static_cast<float>(static_cast<double>(k) * ground_->cell_m()) -
                                kDrawnLower_rad);
    above[k] = most;
  }
  return above;
}

bool Horizon::hides(const glm::dvec3& low_m, const glm::dvec3& high_m) {
  if (steps_ == 0) return false;
  const glm::dvec2 low = glm::dvec2(low_m - eye_m_), high = glm::dvec2(high_m - eye_m_);
  const double near_m = glm::length(glm::max(glm::max(low, -high), glm::dvec2(0.0)));
  const auto step = std::min(static_cast<std::size_t>(near_m / ground_->cell_m()), steps_ - 1);
  if (step == 0) return false;
  const double up_m = high_m.z - eye_m_.z;
  const double far_m = glm::length(glm::max(glm::abs(low), glm::abs(high)));
  const auto tangent = static_cast<float>(up_m / (up_m > 0.0 ? near_m : far_m));
  // From one side of the box to the other, which is less than half a turn.
  const double middle = round_square(0.5 * (low + high));
  double first = 0.0, last = 0.0;
  for (const glm::dvec2& corner : {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)}) {
    double way = round_square(corner) - middle;
    way -= 4.0 * std::round(0.25 * way);
    first = std::min(first, way), last = std::max(last, way);
  }
  const auto number = [](double way) { return static_cast<int>(std::floor(way * (kSectors / 4.0))); };
  for (int k = number(middle + first); k <= number(middle + last); ++k)
    if (!(sector(((k % kSectors) + kSectors) % kSectors)[step] > tangent)) return false;
  return true;
}

}  // namespace phare
