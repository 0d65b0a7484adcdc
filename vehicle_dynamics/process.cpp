#include "vehicle_dynamics/process.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <utility>

#include "net/lockstep.h"
#include "net/silence.h"
#include "net/stats.h"

namespace phare {
namespace {

Controls controls_of(const CockpitState& state) {
  return {state.steering_wheel_rad, state.accelerator_01, state.brake_01, state.gear, state.parking_brake_01};
}

bool high_beam_on(const CockpitState& state) {
  return state.flash || state.light_switch == LightSwitch::kHigh;
}

}  // namespace

DynamicsProcess::DynamicsProcess(Bus bus, const Rig& rig, DynamicsOptions options, std::optional<StateFile> kept,
                                 StopFlag stop)
    : bus_(std::move(bus)),
      rig_(rig),
      options_(std::move(options)),
      kept_(std::move(kept)),
      stop_(stop),
      verbs_(verbs()) {
  bus_.on_datagram = [this](const Datagram& datagram, std::span<const std::byte>) {
    desk_.serve(bus_, datagram, std::cref(verbs_));
  };
}

void DynamicsProcess::run(Begin begin) {
  if (options_.lockstep) {
    run_lockstep(std::move(begin));
  } else {
    run_real_time(std::move(begin));
  }
  write_stats();
}

// Frame by frame, as fast as the slowest process: the run is the same however long a frame takes.
void DynamicsProcess::run_lockstep(Begin begin) {
  std::int64_t sent = -1;  // newest frame answered
  StaysHeard stays_heard(kPayloadIndex<VehicleState>);
  while (!stop_) {
    bus_.wait(std::chrono::milliseconds(20));
    bus_.poll();
    stats_once_a_second();
    if (!loop_) {
      const auto newest_frame = newest_frame_of_all(bus_);
      if (!newest_frame) continue;
      sent = begin_at_frame(std::move(begin), *newest_frame);
    }

    send_again_to_late(bus_, sent, kPayloadIndex<VehicleState>);
    stays_heard.step(bus_);
    const auto* cockpit = bus_.newest<CockpitState>();
    if (!cockpit || cockpit->value.frame_index != sent + 1 || !all_channels_at(bus_, sent)) continue;
    const SimTime time = frame_time(sent + 1, rig_.frame_rate_hz);
    loop_->set_controls(controls_of(cockpit->value));
    loop_->run_to(time);
    keep_state(++sent);
    send_state(time, sent, &cockpit->value);
  }
}

// By the wall clock: a wake-up per step, those due are done, the newest is sent 250 times a second.
void DynamicsProcess::run_real_time(Begin begin) {
  constexpr std::chrono::milliseconds kSendEvery(4);
  scheduling_ = run_before_others(rig_.real_time_priority);
  spdlog::debug("scheduling: {}", scheduling_.text);
  begin_in_real_time(std::move(begin));
  const std::chrono::nanoseconds step(loop_->setup().step.ns);
  Pacer pacer(step);
  Clock::time_point start = Clock::now(), before = start, next_send = start;
  while (!stop_) {
    missed_wakes_ += static_cast<std::uint64_t>(pacer.wait());
    wake_late_.add(pacer.late());
    bus_.poll();
    stats_once_a_second();
    const Clock::time_point now = Clock::now();
    if (requests_.seek_s && seek()) start = before = now;
    if (requests_.paused) loop_->skip(SimTime{(now - before).count()});  // the pose goes on being sent
    before = now;

    const auto* cockpit = bus_.newest<CockpitState>();
    if (cockpit) loop_->set_controls(controls_now(*cockpit));
    loop_->catch_up(SimTime{(now - start).count()});
    report_lag();
    if (now + step / 2 < next_send) continue;  // half a step early is this wake-up, not the next
    next_send = std::max(next_send + kSendEvery, now);
    keep_state(kept_next_++);
    send_state(loop_->time(), -1, cockpit ? &cockpit->value : nullptr);
  }
}

void DynamicsProcess::send_state(SimTime time, std::int64_t frame, const CockpitState* cockpit) {
  VehicleState state = loop_->at(time);
  state.frame_index = frame;
  state.step_hash = loop_->hashes_after(sent_step_);
  sent_step_ = state.step;
  state.high_beam_telltale = cockpit && !silent_ && high_beam_on(*cockpit);
  if (cockpit && cockpit->drive_ended) state.drive_ended = true;
  bus_.send(time, state);
  tell_switches();
  tell_once(state);
}

// What is said once a drive.
void DynamicsProcess::tell_once(const VehicleState& sent) {
  if (loop_->out_of_play() && !lost_logged_) {
    lost_logged_ = true;
    spdlog::error("{} at {:.3f} s, level {}: it stays where it is", loop_->out_of_play(), loop_->time().seconds(),
                  name(loop_->level_now()));
  }
  const bool has_road = loop_->setup().road.triangle_count() > 0;  // without one it has been said already
  if (has_road && loop_->off_road() && !off_road_logged_) {
    off_road_logged_ = true;
    spdlog::warn("no road under a wheel at x {:.1f} m, y {:.1f} m: its last height is held", sent.x_m, sent.y_m);
  }
}

// Level auto says why, once for each switch; in the stats the newest stay.
void DynamicsProcess::tell_switches() {
  const AutoLevel& choice = loop_->choice();
  for (; switches_told_ < choice.switches(); ++switches_told_) {
    const LevelSwitch& change = choice.change(switches_told_);
    if (choice.switches() - switches_told_ > AutoLevel::kKept) continue;  // more than are kept between two messages
    spdlog::info("level auto at {:.3f} s: {}", loop_->start().seconds() + change.time_s, text(change));
  }
}

Verbs DynamicsProcess::verbs() {
  Verbs verbs;
  verbs.on<RigControl::Quit>([this](const auto&) {
    stop_.request();
    bus_.leaves_as_told();
    return accepted("leaves");
  });
  verbs.on<RigControl::Pause>([this](const RigControl::Pause& pause) {
    requests_.paused = pause.on;
    return accepted((pause.on ? "paused" : "goes on") + time_text());
  });
  verbs.on<RigControl::Seek>([this](const RigControl::Seek& seek) { return may_seek(seek.to_s); });
  verbs.on<RigControl::Tell>([this](const auto&) { return accepted(loop_ ? state_text() : "has not begun"); });
  return verbs;
}

std::string DynamicsProcess::state_text() const {
  const VehicleState car = loop_->at(loop_->time());
  char text[160];
  std::snprintf(text, sizeof text, "%s%.1f km/h, x %.2f, y %.2f, z %.2f m, yaw %.2f, pitch %.3f deg, level %s",
                requests_.paused ? "paused, " : "", car.speed_mps * 3.6, car.x_m, car.y_m, car.z_m,
                car.yaw_rad * 180.0 / std::numbers::pi, car.pitch_rad * 180.0 / std::numbers::pi,
                name(loop_->level_now()));
  return text + time_text();
}

// Level pose only: a simulated car has no past to go back to.
ControlReply DynamicsProcess::may_seek(double to_s) {
  if (options_.lockstep) return refused("seek: not in lockstep, where every frame follows the one before");
  if (!loop_) return refused("seek: the drive has not begun");
  if (loop_->setup().level != Level::kPose)
    return refused("seek: only in a replayed drive; a simulated car has no past to go back to");
  const double end_s = loop_->setup().track.end().seconds();
  char text[80];
  if (to_s > end_s) {
    std::snprintf(text, sizeof text, "seek: the drive ends at %.3f s", end_s);
    return refused(text);
  }
  requests_.seek_s = to_s;
  std::snprintf(text, sizeof text, "at %.3f s of %.3f s", to_s, end_s);
  return accepted(text);
}

std::string DynamicsProcess::time_text() const {
  if (!loop_) return {};
  char text[40];
  std::snprintf(text, sizeof text, " at %.3f s", requests_.seek_s.value_or(loop_->time().seconds()));
  return text;
}

Controls DynamicsProcess::controls_now(const Bus::Newest<CockpitState>& cockpit) {
  const std::chrono::nanoseconds silence = Clock::now() - cockpit.heard;
  const bool silent = is_silent(silence);
  if (silent && !silent_) spdlog::warn("the cockpit is silent: low beam, and from 500 ms on the pedals fade");
  if (!silent && silent_) spdlog::info("the cockpit is back");
  silent_ = silent;
  return faded(controls_of(cockpit.value), silence);
}

void DynamicsProcess::report_lag() {
  if (loop_->drops() == drops_logged_ || Clock::now() < next_lag_log_) return;
  spdlog::warn("wall time dropped {} times, simulated time is {:.3f} s behind", loop_->drops(),
               loop_->dropped().seconds());
  drops_logged_ = loop_->drops();
  next_lag_log_ = Clock::now() + std::chrono::seconds(5);
}

void DynamicsProcess::stats_once_a_second() {
  if (options_.stats_file.empty() || Clock::now() < next_stats_) return;
  next_stats_ = Clock::now() + std::chrono::seconds(1);
  write_stats();
}

nlohmann::json DynamicsProcess::switch_history() const {
  const AutoLevel& choice = loop_->choice();
  nlohmann::json history = nlohmann::json::array();
  const std::uint64_t count = choice.switches();
  for (std::uint64_t n = count > AutoLevel::kKept ? count - AutoLevel::kKept : 0; n < count; ++n) {
    const LevelSwitch& change = choice.change(n);
    history.push_back({{"time_s", loop_->start().seconds() + change.time_s},
                       {"from", rung_name(change.from)},
                       {"to", rung_name(change.to)},
                       {"because", name(change.reason)},
                       {"fact", change.fact}});
  }
  return history;
}

nlohmann::json DynamicsProcess::auto_stats() const {
  const AutoLevel& choice = loop_->choice();
  return {{"level", name(loop_->level_now())},
          {"reason", name(choice.now().reason)},
          {"switches", choice.switches()},
          {"history", switch_history()},
          {"seconds",
           {{name(Level::kKinematic), choice.seconds()[0]},
            {name(Level::kSingleTrack), choice.seconds()[1]},
            {name(Level::kFull), choice.seconds()[2]}}}};
}

void DynamicsProcess::add_loop_stats(nlohmann::json& json) const {
  const StepTimes& times = loop_->times();
  json["level"] = name(loop_->setup().level);
  if (loop_->setup().level == Level::kAuto) json["auto"] = auto_stats();
  json["sim_time_s"] = loop_->time().seconds();
  json["steps"] = loop_->steps();
  json["lag_s"] = loop_->dropped().seconds();
  json["drops"] = loop_->drops();
  json["controls_refused"] = loop_->controls_refused();
  json["off_road"] = loop_->off_road();
  json["out_of_play"] = loop_->out_of_play() ? nlohmann::json(loop_->out_of_play()) : nlohmann::json();
  json["slept_s"] = loop_->slept_s();
  json["step_ns"] = {{"count", times.count()},
                     {"p50", times.quantile_ns(0.5)},
                     {"p99", times.quantile_ns(0.99)},
                     {"p99_9", times.quantile_ns(0.999)},
                     {"max", times.max_ns()}};
  if (wake_late_.count() > 0)
    json["wake_late_ns"] = {{"count", wake_late_.count()},         {"p50", wake_late_.quantile_ns(0.5)},
                            {"p99", wake_late_.quantile_ns(0.99)}, {"p99_9", wake_late_.quantile_ns(0.999)},
                            {"max", wake_late_.max_ns()},          {"missed", missed_wakes_},
                            {"octaves", wake_late_.octaves()}};
}

void DynamicsProcess::write_stats() const {
  if (options_.stats_file.empty()) return;
  nlohmann::json json = stats_json("dynamics", bus_);
  json["scheduling"] = scheduling_.text;
  if (loop_) add_loop_stats(json);
  if (!write_json(options_.stats_file, json)) spdlog::warn("{}: cannot be written", options_.stats_file.string());
}

}  // namespace phare
