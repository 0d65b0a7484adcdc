#include "visual/process/versus.h"

#include <algorithm>
#include <utility>

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
  if (const Lamps::Mounts mounts = shown.mounts(*design); lamps_->mounts(*design) != mounts)
    (void)lamps_->set_mounts(*design, mounts);
  controls.design_index = static_cast<std::uint32_t>(*design);
  std::vector<Lamps::Change> changes = lamps_->set_controls(controls);
  for (Lamps::Change& change : changes) change.position += kFirstBeam;
  return changes;
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

void mark_versus(OverlayMarks& marks, const Desk& desk, const Lamps& shown, const Lamps& other, SimTime now) {
  constexpr double kName_01 = 0.89;  // above the instruments
  constexpr OverlayColour kInk{255, 225, 160};
  if (desk.compare == Compare::kFlicker) {
    const bool turn = Versus::has_turn(desk, now);
    marks.labels.push_back({0.015, kName_01, (turn ? "B: " : "A: ") + (turn ? other : shown).design().name, kInk});
    return;
  }
  marks.lines.push_back({0.5, 0.0, 0.5, 1.0, kInk});
  marks.labels.push_back({0.015, kName_01, "A: " + shown.design().name, kInk});
  marks.labels.push_back({0.508, kName_01, "B: " + other.design().name, kInk});
}

}  // namespace phare
