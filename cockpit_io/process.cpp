#include "cockpit_io/process.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "cockpit_io/control_reader.h"
#include "net/lockstep.h"
#include "net/stats.h"

namespace phare {

namespace {

constexpr std::chrono::milliseconds kSendEvery(10);
constexpr std::chrono::microseconds kRest(400);     // between two wake-ups by the source
constexpr std::chrono::milliseconds kLookEvery(2);  // at the source, between two datagrams
constexpr std::chrono::milliseconds kCoast(200);    // of simulated time when the car is silent, as long as the picture
constexpr std::chrono::seconds kWaitForCar(2);      // after the picture
constexpr std::size_t kMostUnsentStamps = 20'000;

std::string source_name(const CockpitConfig& config) {
  return config.source == SourceKind::kCan ? config.interface
                                           : std::string(kSourceKindNames[static_cast<std::size_t>(config.source)]);
}

nlohmann::json latency_json(const LatencyHistogram& histogram) {
  return {{"count", histogram.count()},
          {"median_us", static_cast<double>(histogram.quantile_ns(0.5)) * 1e-3},
          {"p99_us", static_cast<double>(histogram.quantile_ns(0.99)) * 1e-3},
          {"max_us", static_cast<double>(histogram.most_ns()) * 1e-3}};
}

/// "drive: light low, steering wheel 3 deg, accelerator 20 %"
std::string text_of(const CockpitState& state, const std::string& source) {
  char text[200];
  std::snprintf(text, sizeof text, ": light switch %s%s%s, steering wheel %.0f deg, accelerator %.0f %%, brake %.0f %%",
                kLightSwitchNames[static_cast<std::size_t>(state.light_switch)].data(), state.flash ? ", flash" : "",
                state.fog_front ? ", fog" : "", state.steering_wheel_rad * 180.0 / std::numbers::pi,
                state.accelerator_01 * 100.0, state.brake_01 * 100.0);
  return source + text;
}

/// Processor time of this process since it was started.
double processor_s() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
         static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec) * 1e-6;
}

}  // namespace

CockpitProcess::CockpitProcess(Bus bus, std::unique_ptr<Source> source, const Rig& rig, CockpitConfig config,
                               std::filesystem::path stats_file, std::filesystem::path state_file, StopFlag stop)
    : bus_(std::move(bus)),
      rig_(rig),
      config_(std::move(config)),
      stats_file_(std::move(stats_file)),
      stop_(stop),
      cockpit_(new_cockpit()),
      verbs_(verbs()),
      state_file_(std::move(state_file)),
      processor_before_s_(processor_s()) {
  take_source(std::move(source));
  const bool recorded = config_.source == SourceKind::kDrive || config_.source == SourceKind::kDriver ||
                        (config_.source == SourceKind::kLog && config_.also.empty());
  if (config_.keep_design && recorded) kept_design_.emplace(cockpit_);
  bus_.on_datagram = [this](const Datagram& datagram, std::span<const std::byte>) {
    if (const auto* keys = std::get_if<KeyInput>(&datagram.payload))
      source_->take_keys(datagram.sender_channel, datagram.start_id, *keys, wall_now());
    desk_.serve(bus_, datagram, std::cref(verbs_));
  };
}

Verbs CockpitProcess::verbs() {
  Verbs verbs;
  verbs.on<RigControl::Quit>([this](const auto&) {
    stop_.request();
    bus_.leaves_as_told();
    return accepted("leaves");
  });
  verbs.on<RigControl::Pause>([this](const RigControl::Pause& pause) {
    paused_ = pause.on;
    return accepted(real_time_ ? "" : pause.on ? "paused" : "goes on");
  });
  verbs.on<RigControl::Seek>([this](const auto&) {
    if (!real_time_) return refused("seek: not in lockstep, where every frame follows the one before");
    return accepted("");  // the car may refuse; where it goes back, it is followed
  });
  verbs.on<RigControl::Design>([this](const RigControl::Design& design) {
    if (design.index >= std::max<std::size_t>(rig_.designs.size(), 1))
      return refused(no_such_design(rig_, design.index));
    wanted_design_ = design.index;
    design_by_hand_ = true;
    return accepted("");  // visual says when it shines
  });
  verbs.on<RigControl::Tell>([this](const auto&) {
    return accepted(text_of(cockpit_.state(-1, source_->ended()),
                            real_time_ && !source_->fault().empty() ? source_->fault() : source_name(config_)));
  });
  return verbs;
}

Cockpit CockpitProcess::new_cockpit() const {
  const auto designs = static_cast<std::uint32_t>(std::max<std::size_t>(rig_.designs.size(), 1));
  return Cockpit(switch_params(config_, designs), source_name(config_));
}

void CockpitProcess::take_source(std::unique_ptr<Source> source) {
  source_ = std::move(source);
  source_->on_frame = [this](WallTime stamp) {
    newest_stamp_ = std::max(newest_stamp_, stamp);
    if (real_time_ && unsent_stamps_.size() < kMostUnsentStamps) unsent_stamps_.push_back(stamp);
  };
}

/// The car has gone back in time: what plays by simulated time is played again up to there.
void CockpitProcess::begin_anew() {
  if (config_.source != SourceKind::kLog && config_.source != SourceKind::kDrive) return;
  Result<std::unique_ptr<Source>> source = open_source(config_);
  if (!source) return spdlog::warn("{}", source.error().text());
  take_source(std::move(*source));
  before_ = Before{cockpit_.light_changes(), cockpit_.design_index(), design_by_hand_};
  cockpit_ = new_cockpit();
  newest_ = {};
}

// ---- what a killed cockpit leaves behind

void CockpitProcess::remember(Memory& memory) {
  Before now{cockpit_.light_changes(), cockpit_.design_index(), design_by_hand_};
  memory.field(now);
  if (memory.recalls()) {
    before_ = now;
    design_by_hand_ = now.design_by_hand;
  }
  source_->remember(memory);
  // A source that goes through everything again takes the switch logic with it; latches would turn twice.
  if (source_->plays_again()) return;
  memory.field(newest_);
  memory.field(newest_stamp_);
  cockpit_.remember(memory);
}

Status CockpitProcess::take_up_state() {
  if (state_file_.empty()) return Done{};
  Memory now;
  remember(now);
  Result<StateFile> opened = StateFile::open(state_file_, now.bytes().size());
  if (!opened) return opened.error();
  kept_.emplace(std::move(*opened));
  const auto saved = kept_->newest();
  if (!saved) return Done{};
  Memory left(saved->state);
  remember(left);
  kept_next_ = saved->key + 1;
  light_changes_sent_ = source_->plays_again() ? 0 : cockpit_.light_changes();
  spdlog::info("going on with the controls that were left");
  return Done{};
}

/// Before it is sent: whoever takes our place is never behind what others have seen.
void CockpitProcess::leave_state() {
  if (!kept_) return;
  Memory now;
  remember(now);
  kept_->save(kept_next_++, std::span<const std::byte>(now.bytes()));
}

/// After a source has played again: what was chosen by hand beside it, and how often the lights had changed.
void CockpitProcess::go_on_with_design(Moment now) {
  if (!before_ || !source_->plays_again()) return;
  const Before before = *std::exchange(before_, std::nullopt);
  if (before.design_by_hand && !wanted_design_) cockpit_.choose_design(before.design_index, now);
  cockpit_.count_on_from(before.light_changes);
}

// ---- real time

/// Simulated time is the car's, carried on by the wall clock; it goes back where the car does.
Moment CockpitProcess::now_in_real_time() {
  const WallTime wall = wall_now();
  const auto* vehicle = bus_.newest<VehicleState>();
  if (vehicle != nullptr && vehicle->sim_time < std::exchange(car_time_, vehicle->sim_time)) begin_anew();
  SimTime sim = newest_;
  if (vehicle != nullptr) {
    const std::int64_t age_ns =
        std::clamp<std::int64_t>(wall.ns - vehicle->received.ns, 0, std::chrono::nanoseconds(kCoast).count());
    sim.ns = vehicle->sim_time.ns + age_ns;
  } else if (const auto waited = Clock::now() - start_; waited > wait_for_car_) {
    sim.ns = std::chrono::nanoseconds(waited - wait_for_car_).count();
  }
  newest_ = std::max(newest_, sim);
  return {newest_, wall};
}

void CockpitProcess::evaluate(Moment now, const VehicleState* vehicle) {
  if (vehicle != nullptr) cockpit_.set_speed(vehicle->speed_mps);
  source_->advance(now, vehicle, kept_design_ ? static_cast<ControlSink&>(*kept_design_) : cockpit_);
  if (kept_design_ && kept_design_->left_out() > 0 && !said_design_left_out_) {
    said_design_left_out_ = true;
    spdlog::info("a recorded change of design is left out: the rig keeps \"{}\" (keep_design)",
                 rig_.designs[cockpit_.design_index()].name);
  }
  if (cockpit_.unknown_design() && !said_unknown_design_) {
    said_unknown_design_ = true;
    spdlog::warn("a recorded design is left out: {}", no_such_design(rig_, *cockpit_.unknown_design()));
  }
  if (wanted_design_) cockpit_.choose_design(*std::exchange(wanted_design_, std::nullopt), now);
}

void CockpitProcess::send(SimTime time, std::int64_t frame) {
  CockpitState state = cockpit_.state(frame, source_->ended());
  if (std::string driver = source_->driver(); !driver.empty()) state.source = std::move(driver);
  if (real_time_) {  // in lockstep two runs must be equal, whatever the wall clock says
    state.source_stamp = newest_stamp_;
    state.source_fault = source_->fault();
  }
  leave_state();
  bus_.send(time, state);
  if (!real_time_) return;
  const WallTime sent = wall_now();
  for (const WallTime stamp : unsent_stamps_) latency_.add(sent.ns - stamp.ns);
  unsent_stamps_.clear();
  if (state.light_changes != light_changes_sent_) light_latency_.add(sent.ns - state.light_change_wall.ns);
  light_changes_sent_ = state.light_changes;
}

/// Sleeps until the source has something, or the bus where the source cannot be waited for.
void CockpitProcess::wait(std::chrono::nanoseconds at_most) {
  const std::vector<int> fds = source_->wait_fds();
  if (fds.empty()) {
    bus_.wait(at_most);
    return;
  }
  std::vector<pollfd> polled;
  for (const int fd : fds) polled.push_back({fd, POLLIN, 0});
  // A full bus would wake us for every frame; most of the time would go into that.
  const auto rested = Clock::now() - woken_;
  if (rested < kRest) std::this_thread::sleep_for(kRest - rested);
  const std::int64_t ns = std::max<std::int64_t>(at_most.count(), 0);
  const timespec limit{ns / 1'000'000'000, ns % 1'000'000'000};
  ppoll(polled.data(), polled.size(), &limit, nullptr);
  woken_ = Clock::now();
}

/// Telltales and speed for the car whose stalk this is.
void CockpitProcess::send_back(Moment now, const VehicleState* vehicle) {
  if (!source_->sends_back()) return;
  const CockpitState state = cockpit_.state(-1, false);
  FeedbackValues values;
  values.telltales = cockpit_.telltales(now.sim);
  values.light = state.light_switch;
  values.design_index = state.design_index;
  values.speed_mps = vehicle != nullptr ? vehicle->speed_mps : 0.0;
  values.steering_wheel_rad = state.steering_wheel_rad;
  source_->send_back(values, now.wall);
}

void CockpitProcess::run_real_time(std::chrono::nanoseconds picture_within) {
  real_time_ = true;
  wait_for_car_ = picture_within + kWaitForCar;
  scheduling_ = run_before_others(rig_.real_time_priority);
  spdlog::debug("scheduling: {}", scheduling_.text);
  start_ = Clock::now();
  Pacer pacer(kSendEvery);
  while (!stop_) {
    wait(std::min<std::chrono::nanoseconds>(pacer.left(), kLookEvery));
    bus_.poll();
    stats_once_a_second();
    const Moment now = now_in_real_time();
    const auto* vehicle = bus_.newest<VehicleState>();
    evaluate(now, vehicle != nullptr ? &vehicle->value : nullptr);
    if (vehicle != nullptr) go_on_with_design(now);
    send_back(now, vehicle != nullptr ? &vehicle->value : nullptr);
    const bool begun = picture_within.count() == 0 || vehicle != nullptr || Clock::now() - start_ > wait_for_car_;
    // Asked before the picture is ready too: a deadline that stays passed would leave no time to sleep.
    const bool due = pacer.due();
    if (begun && (due || cockpit_.light_changes() != light_changes_sent_)) send(now.sim, -1);
    ++turns_;
  }
  write_stats();
}

// ---- lockstep

/// The car in the picture of a frame. Not the newest VehicleState, which may or may not have arrived: this one has.
const VehicleState* CockpitProcess::drawn_at(std::int64_t frame) const {
  const auto* report = report_of_frame(bus_, frame);
  return report == nullptr || report->value.drawn.level.empty() ? nullptr : &report->value.drawn;
}

void CockpitProcess::evaluate_frame(std::int64_t frame) {
  evaluate({frame_time(frame, rig_.frame_rate_hz), wall_now()}, drawn_at(frame - 1));
}

void CockpitProcess::run_lockstep() {
  std::optional<std::int64_t> sent;  // newest frame the controls went out for
  StaysHeard stays_heard(kPayloadIndex<CockpitState>);
  while (!stop_) {
    bus_.wait(std::chrono::milliseconds(20));
    bus_.poll();
    stats_once_a_second();
    if (!sent) {
      // A cockpit that was restarted goes through every frame again, so that it stands where its predecessor stood.
      sent = newest_frame_of_all(bus_);
      if (!sent) continue;
      for (std::int64_t frame = 0; frame <= *sent; ++frame) evaluate_frame(frame);
      if (*sent >= 0) go_on_with_design({frame_time(*sent, rig_.frame_rate_hz), wall_now()});
      if (*sent >= 0 && !all_channels_at(bus_, *sent)) send(frame_time(*sent, rig_.frame_rate_hz), *sent);
      if (*sent >= 0) spdlog::info("going on after frame {}", *sent);
    }
    send_again_to_late(bus_, *sent, kPayloadIndex<CockpitState>);
    stays_heard.step(bus_);
    if (paused_ || !all_channels_at(bus_, *sent)) continue;
    ++*sent;
    evaluate_frame(*sent);
    send(frame_time(*sent, rig_.frame_rate_hz), *sent);
  }
  write_stats();
}

// ---- reports

void CockpitProcess::stats_once_a_second() {
  if (stats_file_.empty() || Clock::now() < next_stats_) return;
  next_stats_ = Clock::now() + std::chrono::seconds(1);
  write_stats();
}

void CockpitProcess::write_stats() const {
  if (stats_file_.empty()) return;
  nlohmann::json json = stats_json("cockpit", bus_);
  json["scheduling"] = scheduling_.text;
  const SourceCounts& counts = source_->counts();
  json["source"] = {
      {"name", source_name(config_)},        {"status", source_->status()},       {"frames_read", counts.frames_read},
      {"decoded", counts.decoded},           {"incomplete", counts.incomplete},   {"unknown_ids", counts.unknown_ids},
      {"error_frames", counts.error_frames}, {"dropped", counts.dropped},         {"broken_lines", counts.broken_lines},
      {"bad_crc", counts.bad_crc},           {"bad_counter", counts.bad_counter}, {"lost_in_data", counts.lost_in_data},
      {"link_dropped", counts.link_dropped}, {"bus_offs", counts.bus_offs},       {"sent", counts.sent},
      {"not_sent", counts.not_sent},         {"fault", source_->fault()},         {"reconnects", counts.reconnects},
      {"fail_safes", counts.fail_safes}};
  json["cpu_s"] = processor_s() - processor_before_s_;
  json["wall_s"] = std::chrono::duration<double>(Clock::now() - start_).count();
  json["turns"] = turns_;
  json["light_changes"] = cockpit_.light_changes();
  json["fail_safe"] = cockpit_.fail_safe();
  if (kept_design_) json["design_changes_left_out"] = kept_design_->left_out();
  json["frame_to_datagram"] = latency_json(latency_);
  json["light_change_to_datagram"] = latency_json(light_latency_);
  if (!write_json(stats_file_, json)) spdlog::warn("{}: cannot be written", stats_file_.string());
}

}  // namespace phare
