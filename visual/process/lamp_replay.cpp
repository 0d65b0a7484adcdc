#include "visual/process/lamp_replay.h"

#include <algorithm>

namespace phare {

LampState state_of(const Lamps::Mounts& mounts, std::size_t design) {
  LampState state;
  state.design_index = static_cast<std::uint32_t>(design);
  state.aim_pitch_rad = mounts.aim_rad;
  for (const LampMount& lamp : mounts.lamps) {
    state.x_m.push_back(lamp.position_m.x);
    state.y_m.push_back(lamp.position_m.y);
    state.z_m.push_back(lamp.position_m.z);
    state.yaw_rad.push_back(lamp.yaw_rad);
    state.pitch_rad.push_back(lamp.pitch_rad);
    state.roll_rad.push_back(lamp.roll_rad);
  }
  return state;
}

Lamps::Mounts mounts_of(const LampState& state) {
  Lamps::Mounts mounts;
  mounts.aim_rad = state.aim_pitch_rad;
  for (std::size_t i = 0; i < state.x_m.size(); ++i)
    mounts.lamps.push_back(
        {{state.x_m[i], state.y_m[i], state.z_m[i]}, state.yaw_rad[i], state.pitch_rad[i], state.roll_rad[i]});
  return mounts;
}

LampReplay::LampReplay(const Drive& drive) {
  for (const Datagram& datagram : drive.datagrams)
    if (const auto* state = std::get_if<LampState>(&datagram.payload)) states_.emplace_back(datagram.sim_time, *state);
  std::ranges::stable_sort(states_, {}, [](const auto& state) { return state.first.ns; });
}

Status LampReplay::follow(SimTime now, Lamps& lamps) {
  if (states_.empty()) return Done{};
  if (now.ns < now_.ns) {  // wound back
    next_ = 0;
    for (std::size_t design = 0; design < lamps.designs().size(); ++design)
      (void)lamps.set_mounts(design, lamps.mounts_of_rig(design));
  }
  now_ = now;
  Status done = Done{};
  for (; next_ < states_.size() && states_[next_].first.ns <= now.ns; ++next_) {
    const LampState& state = states_[next_].second;
    const Status set = lamps.set_mounts(state.design_index, mounts_of(state));
    if (!set && !refused_) refused_ = true, done = set;
  }
  return done;
}

LampNews::LampNews(const Lamps& lamps) {
  for (std::size_t design = 0; design < lamps.designs().size(); ++design) of_rig_.push_back(lamps.mounts(design));
  told_ = of_rig_;
}

std::optional<LampState> LampNews::of(SimTime now, const Lamps& lamps) {
  constexpr std::int64_t kAgainAfter_ns = 1'000'000'000;
  const std::size_t design = lamps.design_index();
  Lamps::Mounts mounts = lamps.mounts();
  const bool again = mounts != of_rig_[design] && (now.ns < told_at_.ns || now.ns - told_at_.ns >= kAgainAfter_ns);
  if (mounts == told_[design] && !again) return std::nullopt;
  told_[design] = std::move(mounts);
  told_at_ = now;
  return state_of(told_[design], design);
}

}  // namespace phare
