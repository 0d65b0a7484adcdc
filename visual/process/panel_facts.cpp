#include "visual/process/panel_facts.h"

#include <numbers>

#include "visual/process/lamp_keys.h"

namespace phare {
namespace {

/// `slots`: one lamp, or the left and the right one of a pair (Lamps::slots_of).
std::array<double, 7> quantities(const std::vector<std::size_t>& slots, const Lamps::Mounts& mounts) {
  constexpr double kDeg = 180.0 / std::numbers::pi;
  const LampMount &first = mounts.lamps[slots.front()], &second = mounts.lamps[slots.back()];
  const glm::dvec3 middle_m = 0.5 * (first.position_m + second.position_m);
  return {middle_m.x,           middle_m.y,
          middle_m.z,           first.position_m.y - second.position_m.y,
          first.yaw_rad * kDeg, first.pitch_rad * kDeg,
          first.roll_rad * kDeg};
}

}  // namespace

std::vector<PanelLamp> panel_lamps(const Lamps& lamps) {
  std::vector<PanelLamp> all;
  for (const std::string& name : movable_lamps(lamps)) {
    const auto slots = lamps.slots_of(name);
    if (!slots) continue;
    PanelLamp lamp{name, slots->size() == 2, quantities(*slots, lamps.mounts()),
                   quantities(*slots, lamps.mounts_of_rig(lamps.design_index()))};
    double sum = 0.0, sources = 0.0;
    for (const std::size_t slot : *slots) {
      lamp.members.push_back(lamps.design().lamps[slot].name);
      for (const double dimming_01 : lamps.dimming_01(slot)) sum += dimming_01, sources += 1.0;
    }
    if (sources > 0.0) lamp.light_01 = sum / sources;
    all.push_back(std::move(lamp));
  }
  return all;
}

std::vector<PanelMessages> panel_messages(const BusCounters& counters) {
  std::vector<PanelMessages> all;
  for (std::size_t i = 0; i < kChannels.size(); ++i) {
    const InboxCounters& in = counters.received[i];
    if (in.received + in.lost + in.late + counters.sent[i] == 0) continue;
    all.push_back({std::string(kChannels[i].message), counters.sent[i], in.received, in.lost, in.late});
  }
  return all;
}

}  // namespace phare
