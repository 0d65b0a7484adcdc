// Places and turns of lamps while driving: the part of Lamps (lamps.h) that moves them, takes it back and tells the rig
// file.
#include <algorithm>
#include <cmath>

#include "visual/photometry/beam/beam_image.h"
#include "visual/process/lamps.h"

namespace phare {
namespace {

constexpr std::size_t kMostSteps = 1000;  // that undo goes back
constexpr double kMostTurn_rad = 1.6;

bool in_range(const LampMount& mount) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(mount.position_m[axis]) <= kFarthestFromCar_m)) return false;
  return std::abs(mount.yaw_rad) <= kMostTurn_rad && std::abs(mount.pitch_rad) <= kMostTurn_rad &&
         std::abs(mount.roll_rad) <= kMostTurn_rad;
}

/// The angles of a rotation, as SourceConfig has them: R = Rz(yaw)·Ry(-pitch)·Rx(roll). Straight up or down, where yaw
/// and roll are one, roll is 0.
SavedMount::Turn angles_of(const glm::dmat3& r) {
  const double up = std::clamp(r[0].z, -1.0, 1.0);
  if (std::hypot(r[0].x, r[0].y) < 1e-9) return {std::atan2(-r[1].x, r[1].y), std::asin(up), 0.0};
  return {std::atan2(r[0].y, r[0].x), std::asin(up), std::atan2(r[1].z, r[2].z)};
}

}  // namespace

Lamps::Mounts Lamps::mounts(std::size_t design) const {
  Mounts mounts;
  for (const Position& position : positions_[design]) mounts.lamps.push_back(position.mount);
  mounts.aim_rad = aim_pitch_rad_;
  return mounts;
}

Status Lamps::set_mounts(std::size_t design, const Mounts& mounts) {
  if (design >= positions_.size() || positions_[design].size() != mounts.lamps.size())
    return Error{"places of lamps", "design " + std::to_string(design) + " of " + std::to_string(mounts.lamps.size()) +
                                        " lamps is not one of this rig"};
  for (std::size_t slot = 0; slot < mounts.lamps.size(); ++slot) positions_[design][slot].mount = mounts.lamps[slot];
  aim_pitch_rad_ = mounts.aim_rad;
  return Done{};
}

void Lamps::remember(const std::string& of) {
  if (!of.empty() && of == remembered_ && !before_[design_].empty()) return;
  remembered_ = of;
  std::vector<Mounts>& before = before_[design_];
  if (before.size() == kMostSteps) before.erase(before.begin());
  before.push_back(mounts());
}

Status Lamps::place(const RigControl::Place& command) {
  const Result<std::size_t> slot = find(command.lamp);
  if (!slot) return slot.error();
  remember();
  positions_[design_][*slot].mount.position_m = {command.x_m, command.y_m, command.z_m};
  return Done{};
}

Status Lamps::swivel(const RigControl::Swivel& command) {
  const Result<std::size_t> slot = find(command.lamp);
  if (!slot) return slot.error();
  remember("swivel");  // bending light turns lamps many times a second
  positions_[design_][*slot].mount.yaw_rad = command.yaw_rad;
  positions_[design_][*slot].mount.pitch_rad = command.pitch_rad;
  return Done{};
}

void Lamps::set_aim(double pitch_rad) {
  remember();
  aim_pitch_rad_ = pitch_rad;
}

Result<std::vector<std::size_t>> Lamps::slots_of(const std::string& lamp) const {
  if (const Result<std::size_t> one = find(lamp)) return std::vector{*one};
  const Result<std::size_t> left = find(lamp + " left"), right = find(lamp + " right");
  if (left && right) return std::vector{*left, *right};
  return find(lamp).error();
}

Status Lamps::mount(const RigControl::Mount& command) {
  using enum rig_command::MountQuantity;
  if (command.lamp.empty()) {
    if (command.quantity != kPitch) return Error{"all lamps", "are turned up and down only; name a lamp or a pair"};
    const double aim_rad = command.by ? aim_pitch_rad_ + command.value : command.value;
    if (!(std::abs(aim_rad) <= kMostTurn_rad)) return Error{"all lamps", "turned beyond 91 degrees"};
    set_aim(aim_rad);
    return Done{};
  }
  const auto slots = slots_of(command.lamp);
  if (!slots) return slots.error();
  const bool pair = slots->size() == 2;
  LampMount first = positions_[design_][slots->front()].mount, second = positions_[design_][slots->back()].mount;

  // Of a pair, places are those of its middle; what is turned to a side is the left lamp, the right one mirrored.
  const auto moved = [&](double now) { return command.by ? now + command.value : command.value; };
  const auto shift = [&](int axis) {
    const double middle = 0.5 * (first.position_m[axis] + second.position_m[axis]);
    const double by = moved(middle) - middle;
    first.position_m[axis] += by, second.position_m[axis] += by;
  };
  const auto turn = [&](double LampMount::*angle, double side) {
    const double before = first.*angle;
    first.*angle = moved(before);
    second.*angle = command.by ? second.*angle + side * command.value : side * command.value;
  };
  switch (command.quantity) {
    case kForward:
    case kLeft:
    case kUp:
      shift(static_cast<int>(command.quantity));
      break;
    case kSpacing: {
      if (!pair) return Error{"lamp \"" + command.lamp + "\"", "is one lamp; the spacing is a pair's"};
      const double middle = 0.5 * (first.position_m.y + second.position_m.y);
      const double apart_m = moved(first.position_m.y - second.position_m.y);
      if (!(apart_m >= 0.0)) return Error{"lamp \"" + command.lamp + "\"", "its left lamp would be right of the other"};
      first.position_m.y = middle + 0.5 * apart_m, second.position_m.y = middle - 0.5 * apart_m;
      break;
    }
    case kYaw:
      turn(&LampMount::yaw_rad, pair ? -1.0 : 1.0);
      break;
    case kPitch:
      turn(&LampMount::pitch_rad, 1.0);
      break;
    case kRoll:
      turn(&LampMount::roll_rad, pair ? -1.0 : 1.0);
      break;
  }
  if (!in_range(first) || !in_range(second))
    return Error{"lamp \"" + command.lamp + "\"", "more than 50 m from its car, or turned beyond 91 degrees"};
  remember();
  positions_[design_][slots->front()].mount = first;
  if (pair) positions_[design_][slots->back()].mount = second;
  return Done{};
}

std::size_t Lamps::undo(std::size_t steps) {
  std::vector<Mounts>& before = before_[design_];
  steps = std::min(steps, before.size());
  if (steps == 0) return 0;
  (void)set_mounts(design_, before[before.size() - steps]);
  before.resize(before.size() - steps);
  remembered_.clear();
  return steps;
}

Status Lamps::reset(const std::string& lamp) {
  std::vector<std::size_t> slots;
  if (!lamp.empty()) {
    auto named = slots_of(lamp);
    if (!named) return named.error();
    slots = std::move(*named);
  }
  Mounts wanted = lamp.empty() ? of_rig_[design_] : mounts();
  for (const std::size_t slot : slots) wanted.lamps[slot] = of_rig_[design_].lamps[slot];
  remember();
  return set_mounts(design_, wanted);
}

std::vector<SavedMount> Lamps::changed_mounts() const {
  std::vector<SavedMount> changed;
  for (std::size_t design = 0; design < designs_.size(); ++design) {
    for (std::size_t slot = 0; slot < positions_[design].size(); ++slot) {
      const LampMount& mount = positions_[design][slot].mount;
      if (mount == of_rig_[design].lamps[slot] && aim_pitch_rad_ == of_rig_[design].aim_rad) continue;
      const LampConfig& lamp = designs_[design].lamps[slot];
      SavedMount saved{designs_[design].name, lamp.name, mount.position_m, {}};
      const glm::dmat3 turned = aim_rotation(mount.yaw_rad, aim_pitch_rad_ + mount.pitch_rad, mount.roll_rad);
      for (const SourceConfig& source : lamp.sources)
        saved.sources.push_back(angles_of(turned * aim_rotation(source.yaw_rad, source.pitch_rad, source.roll_rad)));
      changed.push_back(std::move(saved));
    }
  }
  return changed;
}

void Lamps::mounts_are_saved() {
  for (std::size_t design = 0; design < designs_.size(); ++design) of_rig_[design] = mounts(design);
}

}  // namespace phare
