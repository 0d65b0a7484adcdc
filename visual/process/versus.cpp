#include "visual/process/versus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "visual/process/props.h"
#include "visual/process/road_marks.h"

namespace phare {
namespace {

constexpr PicturePart kLeft{0.0, 0.0, 0.5, 1.0}, kRight{0.5, 0.0, 0.5, 1.0};

}  // namespace

std::optional<std::size_t> versus_design(const Desk& desk, const Lamps& shown) {
  const std::size_t designs = shown.designs().size();
  if (designs < 2) return std::nullopt;
  return desk.versus ? std::min(*desk.versus, designs - 1) : (shown.design_index() + 1) % designs;
}

Status check_versus(const Desk& desk, std::size_t shining) {
  if (desk.versus != desk.design.value_or(shining)) return Done{};
  return Error{"versus " + std::to_string(*desk.versus), "is the design that shines"};
}

std::vector<Lamps::Change> Versus::follow(const Desk& desk, const Lamps& shown, CockpitState controls) {
  const auto design = desk.compare == Compare::kOff ? std::nullopt : versus_design(desk, shown);
  if (!design) {
    lamps_.reset();
    return {};
  }
  ++work_;
  if (!lamps_) {
    lamps_ = std::make_unique<Lamps>(shown);
    lamps_->forget_shown();
  }
  // As they are moved while driving, and as recorded.
  const Lamps::Mounts mounts = shown.mounts(*design);
  if (lamps_->mounts(*design) != mounts) (void)lamps_->set_mounts(*design, mounts);
  controls.design_index = static_cast<std::uint32_t>(*design);
  std::vector<Lamps::Change> changes = lamps_->set_controls(controls);
  for (Lamps::Change& change : changes) change.position += kFirstBeam;
  align(desk, shown, *design, mounts);
  return changes;
}

Versus Versus::copy() const {
  Versus same;
  if (lamps_) same.lamps_ = std::make_unique<Lamps>(*lamps_);
  same.aligned_rad_ = aligned_rad_;
  same.work_ = work_;
  return same;
}

void Versus::align(const Desk& desk, const Lamps& shown, std::size_t design, Lamps::Mounts mounts) {
  aligned_rad_.reset();
  if (!desk.versus_aligned) return;
  double turned_rad = 0.0;
  for (int step = 0; step < 3; ++step) {  // of a tangent: each leaves a hundredth of what the one before did
    const auto a_m = shown.cutoff_height_m({}, kWall_m), b_m = lamps_->cutoff_height_m({}, kWall_m);
    if (!a_m || !b_m) return;
    const double more_rad = std::atan2(*a_m - *b_m, kWall_m);
    turned_rad += more_rad, mounts.aim_rad += more_rad;
    (void)lamps_->set_mounts(design, mounts);  // no step that somebody could take back
  }
  aligned_rad_ = turned_rad;
}

void Versus::show(FrameInput& frame, Compare compare, const VehicleState& pose, std::span<const PlacedLamp> also,
                  std::vector<GlaringLamp> glare) const {
  if (compare == Compare::kSplit) split(frame, pose, also, std::move(glare));
  if (compare != Compare::kDifference && compare != Compare::kRatio) return;
  std::erase_if(frame.lamps, [](const PlacedLamp& lamp) { return lamp.beam >= kFirstBeam; });
  const std::size_t carried = frame.lamps.empty() ? SIZE_MAX : frame.lamps.front().carried_by;
  for (PlacedLamp& lamp : placed(pose)) {
    lamp.of_b = true, lamp.carried_by = carried;
    frame.lamps.push_back(lamp);
  }
  frame.view = compare == Compare::kDifference ? View::kDifference : View::kRatio;
  frame.glare.clear();
}

std::vector<PlacedLamp> Versus::placed(const VehicleState& pose) const {
  std::vector<PlacedLamp> lamps = lamps_->placed(pose);
  for (PlacedLamp& lamp : lamps) lamp.beam += kFirstBeam;
  return lamps;
}

std::optional<glm::vec3> Versus::light(const Lamps& shown) const {
  const std::optional<glm::vec3> a = shown.light(), b = lamps_ ? lamps_->light() : std::nullopt;
  if (a && b) return 0.5f * (*a + *b);
  return a ? a : b;
}

void Versus::split(FrameInput& frame, const VehicleState& pose, std::span<const PlacedLamp> also,
                   std::vector<GlaringLamp> glare) const {
  ViewInput other = frame;
  other.name = "versus";
  other.lamps = placed(pose);
  // What carries A's lamps carries B's.
  const auto own = std::ranges::find_if(frame.lamps, [](const PlacedLamp& lamp) { return lamp.beam < kFirstBeam; });
  if (own != frame.lamps.end())
    for (PlacedLamp& lamp : other.lamps) lamp.carried_by = own->carried_by;
  other.lamps.insert(other.lamps.end(), also.begin(), also.end());
  other.glare = std::move(glare);
  other.part = kRight;
  other.camera.seen_from_01 = 0.5;
  frame.part = kLeft;
  frame.camera.seen_to_01 = 0.5;
  frame.more_views.insert(frame.more_views.begin(), std::move(other));
}

void keep_to_a(OverlayMarks& marks, const Desk& desk, const Lamps& shown, SimTime now) {
  if (!versus_design(desk, shown)) return;
  if (desk.compare == Compare::kSplit) keep_clear(marks, kRight);
  if (Versus::has_turn(desk, now)) marks = {};
}

void mark_versus(OverlayMarks& marks, const Desk& desk, const Lamps& shown, const Versus& versus, SimTime now) {
  const Lamps& other = *versus.lamps();
  constexpr double kName_01 = 0.89;  // above the instruments
  constexpr double kHalf_01 = 0.48, kWhole_01 = 0.97;
  constexpr OverlayColour kInk{255, 225, 160};
  std::string b = "B: " + other.design().name;
  if (desk.versus_aligned && versus.aligned_rad())
    b += fmt::format(", aligned by {:+.2f} deg",
                     std::round(*versus.aligned_rad() * 18000.0 / std::numbers::pi) / 100.0 + 0.0);
  else if (desk.versus_aligned)
    b += ", not aligned: no cut-off";
  if (desk.compare == Compare::kDifference || desk.compare == Compare::kRatio) {
    marks.labels.push_back({0.015, kName_01, "A: " + shown.design().name + "   " + b, kInk, kWhole_01});
    return;
  }
  if (desk.compare == Compare::kFlicker) {
    const bool turn = Versus::has_turn(desk, now);
    marks.labels.push_back({0.015, kName_01, turn ? b : "A: " + shown.design().name, kInk, kWhole_01});
    return;
  }
  marks.lines.push_back({0.5, 0.0, 0.5, 1.0, kInk});
  marks.labels.push_back({0.015, kName_01, "A: " + shown.design().name, kInk, kHalf_01});
  marks.labels.push_back({0.508, kName_01, b, kInk, kHalf_01});
}

}  // namespace phare
