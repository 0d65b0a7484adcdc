// How the dynamics begins: anew, or going on for a process whose place it takes.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "net/lockstep.h"
#include "vehicle_dynamics/process.h"

namespace phare {

Result<StateFile> DynamicsProcess::open_state(const std::filesystem::path& file) {
  return StateFile::open(file, sizeof(Left));
}

void DynamicsProcess::begin_at(Begin begin, SimTime time, const VehicleState& drawn) {
  const VehicleParams& car = begin.setup.vehicle;
  const CarState state = from_message(drawn, std::max(car.wheelbase_m, 1.0), std::max(car.track_m, 1.0), car.rest);
  spdlog::info("going on at {:.3f} s, step {}", time.seconds(), drawn.step);
  loop_.emplace(std::move(begin.setup), state, time, drawn.step);
}

// Before it is sent: whoever takes our place is never behind what others have seen.
void DynamicsProcess::keep_state(std::int64_t key) {
  if (kept_) kept_->save(key, Left{loop_->memory(), sent_step_, switches_told_});
}

// Whole: every state of the models, bit for bit.
void DynamicsProcess::recall(Begin begin, const StateFile::Saved& saved) {
  const Left left = state_of<Left>(saved);
  loop_.emplace(std::move(begin.setup), begin.state);
  loop_->recall(left.car);
  sent_step_ = left.sent_step;
  switches_told_ = left.switches_told;
  spdlog::info("going on at {:.3f} s, step {}, with the state that was left", loop_->time().seconds(), loop_->steps());
}

// Returns the frame that counts as answered.
std::int64_t DynamicsProcess::begin_at_frame(Begin begin, std::int64_t frame) {
  if (frame < 0) {
    loop_.emplace(std::move(begin.setup), begin.state);
    return -1;
  }
  const SimTime time = frame_time(frame, rig_.frame_rate_hz);
  if (const auto saved = kept_ ? kept_->at(frame) : std::nullopt) {
    recall(std::move(begin), *saved);
  } else {
    begin_at(std::move(begin), time, report_of_frame(bus_, frame)->value.drawn);
  }
  // Channels that have not drawn this frame yet still need it; our predecessor may have been killed before it sent
  // it.
  const auto* cockpit = bus_.newest<CockpitState>();
  if (!all_channels_at(bus_, frame)) send_state(time, frame, cockpit ? &cockpit->value : nullptr);
  sent_step_ = loop_->steps();
  return frame;
}

// The newest simulated time that anyone speaks of: a drive is under way. The picture and the cockpit carry time on
// by themselves for a while, and it does not go back.
std::optional<SimTime> DynamicsProcess::time_of_others() const {
  std::optional<SimTime> newest;
  const auto take = [&](SimTime time) {
    if (time.ns > 0) newest = std::max(newest.value_or(time), time);
  };
  if (const auto* cockpit = bus_.newest<CockpitState>()) take(cockpit->sim_time);
  for (std::uint32_t channel = 0; channel < bus_.channels(); ++channel) {
    const auto* report = bus_.newest<FrameReport>(channel);
    if (report && !report->value.drawn.level.empty()) take(report->sim_time);
  }
  return newest;
}

// With the state that was left, and then as far as others have carried time on meanwhile.
void DynamicsProcess::go_on_in_real_time(Begin begin, const StateFile::Saved& saved) {
  constexpr std::int64_t kMostCarriedOn_ns = 300'000'000;  // 200 ms of coasting, and a frame
  kept_next_ = saved.key + 1;
  recall(std::move(begin), saved);
  for (const auto until = Clock::now() + std::chrono::milliseconds(30); Clock::now() < until;) {
    bus_.wait(std::chrono::milliseconds(5));
    bus_.poll();
  }
  if (const auto others = time_of_others())
    loop_->run_to(std::min(*others, SimTime{loop_->time().ns + kMostCarriedOn_ns}));
  loop_->begin_clock();
}

// Goes on for a predecessor: with the state it left, else from the picture that shows its car, however long that one
// takes. Where there was none it starts anew, once every visual has said that its picture is ready; one that never
// does so does not hold the drive up for ever.
void DynamicsProcess::begin_in_real_time(Begin begin) {
  if (const auto saved = kept_ ? kept_->newest() : std::nullopt) return go_on_in_real_time(std::move(begin), *saved);
  const auto look_for = std::chrono::milliseconds(200);
  const auto slow_picture = std::chrono::seconds(20);
  const bool first = kept_.has_value();  // an empty file of this run: nobody was here before
  const auto picture_within = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::max(options_.picture_within_s, 0.0)));
  const auto start = Clock::now();
  auto until = start + std::max<Clock::duration>(look_for, picture_within);
  bool told = false;
  while (!stop_ && Clock::now() < until) {
    bus_.wait(std::chrono::milliseconds(10));
    bus_.poll();
    stats_once_a_second();
    for (std::uint32_t channel = 0; channel < bus_.channels(); ++channel) {
      const auto* report = bus_.newest<FrameReport>(channel);
      if (report && !report->value.drawn.level.empty())
        return begin_at(std::move(begin), std::max(report->sim_time, time_of_others().value_or(report->sim_time)),
                        report->value.drawn);
    }
    const bool all_up = newest_frame_of_all(bus_).has_value();  // and none has drawn a car
    if (all_up && (picture_within.count() > 0 || time_of_others())) break;
    // A cockpit speaks of a drive: its picture may take long, and shows the car then.
    if (!first && time_of_others()) {
      until = std::max(until, start + slow_picture);
      if (!std::exchange(told, true)) spdlog::info("a drive is under way: waiting for the picture that shows its car");
    }
  }
  if (picture_within.count() > 0 && !stop_ && !newest_frame_of_all(bus_))
    spdlog::warn("no picture within {:.0f} s: the drive begins without it", options_.picture_within_s);
  const SimTime time = first ? SimTime{} : time_of_others().value_or(SimTime{});
  if (time.ns > 0) spdlog::error("no picture tells where the car was: it begins anew, at {:.3f} s", time.seconds());
  loop_.emplace(std::move(begin.setup), begin.state, time);
}

// A request that verbs() has let through.
bool DynamicsProcess::seek() {
  const SimTime time{static_cast<std::int64_t>(*requests_.seek_s * 1e9)};
  requests_.seek_s.reset();
  loop_.emplace(RunSetup(loop_->setup()), CarState{}, time);
  return true;
}

}  // namespace phare
