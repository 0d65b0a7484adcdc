// phare-dynamics: the car. Takes the driver's controls from the bus, gives the pose of the car.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "config/fail.h"
#include "config/lane.h"
#include "config/log_levels.h"
#include "config/rig.h"
#include "net/bus.h"
#include "net/clock.h"
#include "net/control_desk.h"
#include "net/drive_file.h"
#include "net/lockstep.h"
#include "net/run_key.h"
#include "net/scheduling.h"
#include "net/silence.h"
#include "net/state_file.h"
#include "net/stats.h"
#include "vehicle_dynamics/batch_command.h"
#include "vehicle_dynamics/road_laid.h"
#include "vehicle_dynamics/start_pose.h"
#include "vehicle_dynamics/step.h"

namespace phare {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::string rig_file, drive_file, stats_file, state_file, alive_file, level, log_level = "info";
  std::optional<std::uint16_t> port_base;
  bool lockstep = false, open_bus = false;
  double picture_within_s = 0.0;  // real time: begin when every picture is ready, after so long at the latest
};

// What the run starts from: the setup, and the car at simulated time 0.
struct Begin {
  RunSetup setup;
  CarState state;
};

// What a process leaves behind for the one that takes its place.
struct Left {
  StepLoop::Memory car;
  std::uint64_t sent_step = 0;  // the newest whose hash had been sent before this state was
};

// What a rig control asked for since the last look.
struct Requests {
  bool paused = false;
  std::optional<double> seek_s;
};

Controls controls_of(const CockpitState& state) {
  return {state.steering_wheel_rad, state.accelerator_01, state.brake_01, state.gear, state.parking_brake_01};
}

bool high_beam_on(const CockpitState& state) {
  return state.flash || state.light_switch == LightSwitch::kHigh;
}

Result<Begin> prepare(const Rig& rig, const Options& options, std::optional<levelling::Kind> levelling,
                      const Conditions& conditions) {
  const std::string named = options.level.empty() ? rig.dynamics_level : options.level;
  const Result<Level> level = parse_level(named, options.level.empty() ? rig.file.string() : "--level");
  if (!level) return level.error();
  Begin begin;
  begin.setup.level = *level;
  begin.setup.step.ns = static_cast<std::int64_t>(rig.dynamics_step_s * 1e9 + 0.5);
  if (begin.setup.step.ns <= 0) return Error{rig.file.string(), "the step of the dynamics is not positive"};

  if (!options.drive_file.empty()) {
    const Result<Drive> drive = read_drive(options.drive_file);
    if (!drive) return drive.error();
    begin.setup.track = PoseTrack::from_drive(drive->datagrams);
    if (drive->cut) spdlog::warn("{}: cut off, read up to its last whole record", options.drive_file);
  }
  if (*level == Level::kPose) {
    if (options.drive_file.empty()) return Error{"--level", "pose replays a drive: give --drive FILE"};
    if (begin.setup.track.empty()) return Error{options.drive_file, "holds no VehicleState to replay"};
    return begin;
  }

  Result<VehicleParams> vehicle = read_vehicle(rig.vehicle_file);
  if (!vehicle) return vehicle.error();
  begin.setup.vehicle = std::move(*vehicle);
  begin.setup.levelling = levelling.value_or(levelling::kind_of(begin.setup.vehicle.levelling.system));
  if (begin.setup.levelling == levelling::Kind::kManual)
    return Error{"--levelling", "manual: the cockpit's wheel turns the lamps of a live run"};
  if (begin.setup.levelling != levelling::Kind::kNone && begin.setup.vehicle.levelling.lamp_height_m <= 0.0)
    return Error{rig.vehicle_file.string(), "has no table [levelling]: there are no lamps to level"};
  if (*level != Level::kKinematic) {
    Result<SprungCar> sprung = SprungCar::of(begin.setup.vehicle, rig.vehicle_file.string());
    if (!sprung) return sprung.error();
    begin.setup.sprung = std::move(*sprung);
  }
  if (!rig.scene_file.empty()) {
    Result<RoadSurface> road = RoadSurface::read(rig.scene_file);
    if (!road) return road.error();
    begin.setup.road = std::move(*road);
    if (begin.setup.road.triangle_count() == 0)
      spdlog::warn("{}: no node whose name begins with road or ground; the car drives on a plane",
                   rig.scene_file.string());
  }

  if (const Status laid = lay(conditions, rig.scene_file, begin.setup.on_top); !laid) return laid.error();
  const std::string said = text(begin.setup.on_top);
  if (!said.empty()) spdlog::info("road: {}", said);
  if (!said.empty() && *level == Level::kKinematic)
    spdlog::warn(
        "level kinematic has no tyres: friction changes nothing, and roughness its plane only; --level auto does");

  if (!begin.setup.track.empty()) {
    begin.state = from_message(begin.setup.track.at(begin.setup.track.begin()), begin.setup.vehicle.wheelbase_m,
                               begin.setup.vehicle.track_m);
    return begin;
  }
  if (const auto lane = lane_file_of(rig.scene_file); std::filesystem::exists(lane)) {
    Result<CarState> start = start_of_lane(lane);
    if (!start) return start.error();
    begin.state = *start;
  } else {
    spdlog::info("no lane file {}; the car starts at the origin", lane.string());
  }
  return begin;
}

class Process {
 public:
  Process(Bus bus, const Rig& rig, const Options& options, std::optional<StateFile> kept, StopFlag stop)
      : bus_(std::move(bus)), rig_(rig), options_(options), kept_(std::move(kept)), stop_(stop) {
    bus_.on_datagram = [this](const Datagram& datagram, std::span<const std::byte>) {
      desk_.serve(bus_, datagram, std::cref(verbs_));
    };
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void run(Begin begin) {
    if (options_.lockstep) {
      run_lockstep(std::move(begin));
    } else {
      run_real_time(std::move(begin));
    }
    write_stats();
  }

 private:
  // Frame by frame, as fast as the slowest process: the run is the same however long a frame takes.
  void run_lockstep(Begin begin) {
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
  void run_real_time(Begin begin) {
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

  void send_state(SimTime time, std::int64_t frame, const CockpitState* cockpit) {
    VehicleState state = loop_->at(time);
    state.frame_index = frame;
    state.step_hash = loop_->hashes_after(sent_step_);
    sent_step_ = state.step;
    state.high_beam_telltale = cockpit && !silent_ && high_beam_on(*cockpit);
    if (cockpit && cockpit->drive_ended) state.drive_ended = true;
    bus_.send(time, state);
    if (loop_->out_of_play() && !lost_logged_) {
      lost_logged_ = true;
      spdlog::error("{} at {:.3f} s, level {}: it stays where it is", loop_->out_of_play(), loop_->time().seconds(),
                    name(loop_->level_now()));
    }
    tell_switches();
    const bool has_road = loop_->setup().road.triangle_count() > 0;  // without one it has been said already
    if (has_road && loop_->off_road() && !off_road_logged_) {
      off_road_logged_ = true;
      spdlog::warn("no road under a wheel at x {:.1f} m, y {:.1f} m: its last height is held", state.x_m, state.y_m);
    }
  }

  // Level auto says why, once for each switch; in the stats the newest stay.
  void tell_switches() {
    const AutoLevel& choice = loop_->choice();
    for (; switches_told_ < choice.switches(); ++switches_told_) {
      const LevelSwitch& change = choice.change(switches_told_);
      if (choice.switches() - switches_told_ > AutoLevel::kKept) continue;  // more than are kept between two messages
      spdlog::info("level auto at {:.3f} s: {}", began_s_ + change.time_s, text(change));
    }
  }

  nlohmann::json switch_history() const {
    const AutoLevel& choice = loop_->choice();
    nlohmann::json history = nlohmann::json::array();
    const std::uint64_t count = choice.switches();
    for (std::uint64_t n = count > AutoLevel::kKept ? count - AutoLevel::kKept : 0; n < count; ++n) {
      const LevelSwitch& change = choice.change(n);
      history.push_back({{"time_s", began_s_ + change.time_s}, {"what", text(change)}, {"fact", change.fact}});
    }
    return history;
  }

  // ---- beginning, or going on for a predecessor

  void begin_at(Begin begin, SimTime time, const VehicleState& drawn) {
    const VehicleParams& car = begin.setup.vehicle;
    const CarState state = from_message(drawn, std::max(car.wheelbase_m, 1.0), std::max(car.track_m, 1.0));
    spdlog::info("going on at {:.3f} s, step {}", time.seconds(), drawn.step);
    loop_.emplace(std::move(begin.setup), state, time, drawn.step);
    began_s_ = time.seconds();
  }

  // Before it is sent: whoever takes our place is never behind what others have seen.
  void keep_state(std::int64_t key) {
    if (kept_) kept_->save(key, Left{loop_->memory(), sent_step_});
  }

  // Whole: every state of the models, bit for bit.
  void recall(Begin begin, const StateFile::Saved& saved) {
    const Left left = state_of<Left>(saved);
    loop_.emplace(std::move(begin.setup), begin.state);
    loop_->recall(left.car);
    sent_step_ = left.sent_step;
    spdlog::info("going on at {:.3f} s, step {}, with the state that was left", loop_->time().seconds(),
                 loop_->steps());
  }

  // Returns the frame that counts as answered.
  std::int64_t begin_at_frame(Begin begin, std::int64_t frame) {
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
  std::optional<SimTime> time_of_others() const {
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
  void go_on_in_real_time(Begin begin, const StateFile::Saved& saved) {
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
  void begin_in_real_time(Begin begin) {
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
        if (!std::exchange(told, true))
          spdlog::info("a drive is under way: waiting for the picture that shows its car");
      }
    }
    if (picture_within.count() > 0 && !stop_ && !newest_frame_of_all(bus_))
      spdlog::warn("no picture within {:.0f} s: the drive begins without it", options_.picture_within_s);
    const SimTime time = first ? SimTime{} : time_of_others().value_or(SimTime{});
    if (time.ns > 0) spdlog::error("no picture tells where the car was: it begins anew, at {:.3f} s", time.seconds());
    loop_.emplace(std::move(begin.setup), begin.state, time);
  }

  // A request that verbs() has let through.
  bool seek() {
    const SimTime time{static_cast<std::int64_t>(*requests_.seek_s * 1e9)};
    requests_.seek_s.reset();
    loop_.emplace(RunSetup(loop_->setup()), CarState{}, time);
    return true;
  }

  // ---- commands

  Verbs verbs() {
    Verbs verbs;
    verbs.on<RigControl::Quit>([this](const auto&) {
      stop_.request();
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

  std::string state_text() const {
    const VehicleState car = loop_->at(loop_->time());
    char text[160];
    std::snprintf(text, sizeof text, "%s%.1f km/h, x %.2f, y %.2f, z %.2f m, yaw %.2f, pitch %.3f deg, level %s",
                  requests_.paused ? "paused, " : "", car.speed_mps * 3.6, car.x_m, car.y_m, car.z_m,
                  car.yaw_rad * 180.0 / std::numbers::pi, car.pitch_rad * 180.0 / std::numbers::pi,
                  name(loop_->level_now()));
    return text + time_text();
  }

  // Level pose only: a simulated car has no past to go back to.
  ControlReply may_seek(double to_s) {
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

  std::string time_text() const {
    if (!loop_) return {};
    char text[40];
    std::snprintf(text, sizeof text, " at %.3f s", requests_.seek_s.value_or(loop_->time().seconds()));
    return text;
  }

  // ---- controls, reports

  Controls controls_now(const Bus::Newest<CockpitState>& cockpit) {
    const std::chrono::nanoseconds silence = Clock::now() - cockpit.heard;
    const bool silent = is_silent(silence);
    if (silent && !silent_) spdlog::warn("the cockpit is silent: low beam, and from 500 ms on the pedals fade");
    if (!silent && silent_) spdlog::info("the cockpit is back");
    silent_ = silent;
    return faded(controls_of(cockpit.value), silence);
  }

  void report_lag() {
    if (loop_->drops() == drops_logged_ || Clock::now() < next_lag_log_) return;
    spdlog::warn("wall time dropped {} times, simulated time is {:.3f} s behind", loop_->drops(),
                 loop_->dropped().seconds());
    drops_logged_ = loop_->drops();
    next_lag_log_ = Clock::now() + std::chrono::seconds(5);
  }

  void stats_once_a_second() {
    if (options_.stats_file.empty() || Clock::now() < next_stats_) return;
    next_stats_ = Clock::now() + std::chrono::seconds(1);
    write_stats();
  }

  void write_stats() const {
    if (options_.stats_file.empty()) return;
    nlohmann::json json = stats_json("dynamics", bus_);
    json["scheduling"] = scheduling_.text;
    if (loop_) {
      const StepTimes& times = loop_->times();
      json["level"] = name(loop_->setup().level);
      if (loop_->setup().level == Level::kAuto) {
        const AutoLevel& choice = loop_->choice();
        json["auto"] = {{"level", name(loop_->level_now())},
                        {"reason", name(choice.now().reason)},
                        {"switches", choice.switches()},
                        {"history", switch_history()},
                        {"seconds",
                         {{name(Level::kKinematic), choice.seconds()[0]},
                          {name(Level::kSingleTrack), choice.seconds()[1]},
                          {name(Level::kFull), choice.seconds()[2]}}}};
      }
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
    if (!write_json(options_.stats_file, json)) spdlog::warn("{}: cannot be written", options_.stats_file);
  }

  Bus bus_;
  const Rig& rig_;
  const Options& options_;
  std::optional<StateFile> kept_;
  std::int64_t kept_next_ = 0;
  StopFlag stop_;
  Requests requests_;
  const Verbs verbs_ = verbs();
  ControlDesk desk_;
  std::optional<StepLoop> loop_;
  double began_s_ = 0.0;  ///< simulated time at which the loop began
  std::uint64_t switches_told_ = 0;
  std::uint64_t sent_step_ = 0;  ///< the newest step whose hash has been sent
  Scheduling scheduling_;
  StepTimes wake_late_;  ///< real time: how long after its time a wake-up came
  std::uint64_t missed_wakes_ =
      0;  ///< wake-ups that fell away because the one before came a step too late; their steps are caught up
  bool silent_ = false, off_road_logged_ = false, lost_logged_ = false;
  std::uint64_t drops_logged_ = 0;
  Clock::time_point next_lag_log_{}, next_stats_{};
};

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"The car of a rig: controls in, pose out."};
  app.footer("Example:\n  phare-dynamics --rig config/rigs/country_road.toml --lockstep --level kinematic");
  app.set_version_flag("--version", PHARE_VERSION);
  app.add_option("--rig", options.rig_file, "Rig file (TOML)");
  app.add_flag("--lockstep", options.lockstep, "Advance frame by frame with the picture, reproducibly");
  app.add_option("--drive", options.drive_file,
                 "Drive file to replay (pose) or to take the first pose from (kinematic)");
  app.add_option("--level", options.level,
                 "Model: pose, kinematic, single-track, full, auto (default: the rig's; batch: full)");
  app.add_option("--wait-for-picture", options.picture_within_s,
                 "In real time: begin when every picture is ready, after so many seconds at the latest")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--stats", options.stats_file, "Write counters and times to this JSON file every second");
  app.add_option("--state", options.state_file,
                 "File of this run in which the car's state is kept, for a process that takes this one's place");
  app.add_option("--log-level", options.log_level, "How much to tell")->check(CLI::IsMember(kLogLevelNames));
  app.add_option("--port-base", options.port_base, "First UDP port (default: the rig's)");
  app.add_flag("--open-bus", options.open_bus, "No key of the run: anyone on this machine may speak on the bus");
  app.add_option("--alive", options.alive_file,
                 "File that says, ten times a second and more, that this process is not hung");
  BatchCommand batch;
  batch.add_to(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() != 0) return fail("phare-dynamics", {"command line", problem.what()});
    app.exit(problem);  // --help, --version
    return kExitDone;
  }
  if (const Status fit = batch.options_fit(); !fit) return fail("phare-dynamics", fit.error());
  if (batch.asked()) return batch.run(options.level.empty() ? "full" : options.level);
  if (options.rig_file.empty()) return fail("phare-dynamics", {"--rig", "is required, unless --batch runs a file"});
  spdlog::set_default_logger(spdlog::stderr_color_mt("dynamics"));
  spdlog::set_level(spdlog::level::from_str(options.log_level));

  Result<Rig> rig = read_rig(options.rig_file);
  if (!rig) return fail("phare-dynamics", rig.error());
  if (options.port_base) rig->port_base = *options.port_base;
  if (options.open_bus) rig->run_key = false;
  StopFlag stop = install_stop_signals();
  if (!batch.vehicle().empty()) rig->vehicle_file = batch.vehicle();
  Result<Begin> begin = prepare(*rig, options, batch.levelling(), batch.conditions());
  if (!begin) return fail("phare-dynamics", begin.error());
  if (const Status key = take_run_key(*rig); !key) return fail("phare-dynamics", key.error());
  Result<Bus> bus = Bus::open(*rig, Role::kDynamics);
  if (!bus) return fail("phare-dynamics", bus.error());
  std::optional<StateFile> kept;
  if (!options.state_file.empty()) {
    Result<StateFile> opened = StateFile::open(options.state_file, sizeof(Left));
    if (!opened) return fail("phare-dynamics", opened.error());
    kept.emplace(std::move(*opened));
  }
  const Status ready = bus->ready_with_the_others(options.alive_file, [&] { return stop.requested(); });
  if (!ready) return fail("phare-dynamics", ready.error());
  if (stop) return kExitDone;  // before the drive has begun: nothing is written
  Process(std::move(*bus), *rig, options, std::move(kept), stop).run(std::move(*begin));
  return kExitDone;
}

}  // namespace
}  // namespace phare

int main(int argc, char** argv) {
  return phare::run(argc, argv);
}
