#include "visual/process/lamp_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>

namespace phare {
namespace {

using rig_command::MountQuantity;

constexpr double kLampRadPerDeg = std::numbers::pi / 180.0;

bool is_angle(MountQuantity quantity) {
  return quantity > MountQuantity::kSpacing;
}

std::string key_of(KeyAction action) {
  return std::string(binding_of(action)->name);
}

}  // namespace

std::string mount_text(const Lamps& lamps, std::size_t slot) {
  const LampMount mount = lamps.mounts().lamps[slot];
  std::string text = fmt::format("{}: at x {:.3f}, y {:.3f}, z {:.3f} m", lamps.design().lamps[slot].name,
                                 mount.position_m.x, mount.position_m.y, mount.position_m.z);
  if (mount.yaw_rad != 0.0 || mount.pitch_rad != 0.0 || mount.roll_rad != 0.0)
    text += fmt::format(", turned {:.3f} deg left, {:.3f} deg up", mount.yaw_rad / kLampRadPerDeg,
                        mount.pitch_rad / kLampRadPerDeg);
  if (mount.roll_rad != 0.0)
    text += fmt::format(", rolled {:.3f} deg right side down", mount.roll_rad / kLampRadPerDeg);
  return text;
}

std::vector<std::string> movable_lamps(const Lamps& lamps) {
  std::vector<std::string> names;
  for (const LampConfig& lamp : lamps.design().lamps) {
    if (!lamp.name.ends_with(" left")) continue;
    const std::string stem = lamp.name.substr(0, lamp.name.size() - 5);
    if (const auto slots = lamps.slots_of(stem); slots && slots->size() == 2) names.push_back(stem);
  }
  for (const LampConfig& lamp : lamps.design().lamps) names.push_back(lamp.name);
  return names;
}

std::string LampKeys::chosen(const Lamps& lamps) const {
  const std::vector<std::string> names = movable_lamps(lamps);
  return choice_ == 0 || choice_ > names.size() ? std::string() : names[choice_ - 1];
}

bool LampKeys::pair(const Lamps& lamps) const {
  const auto slots = lamps.slots_of(chosen(lamps));
  return slots && slots->size() == 2;
}

bool LampKeys::has(KeyAction action) {
  using enum KeyAction;
  constexpr std::array kOfLamps{kLampChoose, kLampQuantity, kLampMore, kLampLess,
                                kLampsUp,    kLampsDown,    kLampUndo, kLampReset};
  return std::ranges::count(kOfLamps, action) > 0;
}

std::optional<RigControl> LampKeys::press(KeyAction action, const Lamps& lamps) {
  const auto step = [&](double sign) -> std::optional<RigControl> {
    const std::string name = chosen(lamps);
    if (name.empty()) return std::nullopt;
    const double by = is_angle(quantity_) ? kLampStep_deg * kLampRadPerDeg : kLampStep_m;
    return RigControl{RigControl::Mount{name, quantity_, sign * by, true}};
  };
  const auto aim = [](double sign) {
    return RigControl{RigControl::Mount{"", MountQuantity::kPitch, sign * kLampStep_deg * kLampRadPerDeg, true}};
  };
  const auto next_quantity = [&] {
    quantity_ = quantity_ == MountQuantity::kRoll ? MountQuantity::kForward
                                                  : static_cast<MountQuantity>(static_cast<int>(quantity_) + 1);
  };
  switch (action) {
    case KeyAction::kLampChoose:
      choice_ = choice_ >= movable_lamps(lamps).size() ? 0 : choice_ + 1;
      if (quantity_ == MountQuantity::kSpacing && !pair(lamps)) next_quantity();
      return std::nullopt;
    case KeyAction::kLampQuantity:
      next_quantity();
      if (quantity_ == MountQuantity::kSpacing && !pair(lamps)) next_quantity();
      return std::nullopt;
    case KeyAction::kLampMore:
      return step(1.0);
    case KeyAction::kLampLess:
      return step(-1.0);
    case KeyAction::kLampsUp:
      return aim(1.0);
    case KeyAction::kLampsDown:
      return aim(-1.0);
    case KeyAction::kLampUndo:
      return RigControl{RigControl::Undo{1}};
    case KeyAction::kLampReset:
      return RigControl{RigControl::Reset{chosen(lamps)}};
    default:
      return std::nullopt;
  }
}

std::vector<std::string> LampKeys::lines(const Lamps& lamps) const {
  const std::string name = chosen(lamps);
  if (name.empty()) return {};
  const auto slots = lamps.slots_of(name);
  const std::string step =
      is_angle(quantity_) ? fmt::format("{:g} deg", kLampStep_deg) : fmt::format("{:g} cm", 100.0 * kLampStep_m);
  std::vector<std::string> lines{
      fmt::format("moving {}{}: {}   {} {} by {}, {} what, {} which, {} undo", name,
                  slots->size() == 2 ? " (pair)" : "", kMountQuantityNames[static_cast<std::size_t>(quantity_)],
                  key_of(KeyAction::kLampMore), key_of(KeyAction::kLampLess), step, key_of(KeyAction::kLampQuantity),
                  key_of(KeyAction::kLampChoose), key_of(KeyAction::kLampUndo))};
  for (const std::size_t slot : *slots) lines.push_back("  " + mount_text(lamps, slot));
  const Lamps::Mounts mounts = lamps.mounts();
  if (slots->size() == 2)
    lines.push_back(fmt::format("  {:.3f} m apart",
                                mounts.lamps[slots->front()].position_m.y - mounts.lamps[slots->back()].position_m.y));
  if (mounts.aim_rad != 0.0) lines.push_back(fmt::format("  all lamps {:.3f} deg up", mounts.aim_rad / kLampRadPerDeg));
  return lines;
}

}  // namespace phare
