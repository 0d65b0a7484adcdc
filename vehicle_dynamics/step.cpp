#include "vehicle_dynamics/step.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

#include "config/rig.h"
#include "vehicle_dynamics/models/kinematic.h"

namespace phare {
namespace {
constexpr std::array<const char*, 3> kOutOfPlay{nullptr, "the motion has no numbers any more",
                                                "the car has rolled over"};
}  // namespace

// The car, one step further. Who decides what is due, and what the outside sees of it, follows below.
void StepLoop::step_once() {
  const auto begin = std::chrono::steady_clock::now();
  const double dt = setup_.step.seconds();
  before_ = now_;

  // the car over the road, by the model that the scene calls for; parked and settled it calls for none
  if (!out_of_play_ && !sleeps(dt)) move(dt);
  if (sprung()) stay_if_lost();

  // the lamps against the body
  if (running_ != Level::kPose) {  // a record holds them already
    levelling::advance(setup_.vehicle.levelling, setup_.levelling, 0.0, now_.pitch_rad + setup_.vehicle.rest.pitch_rad,
                       now_.speed_mps, lamps_, dt);
    now_.lamp_tilt_rad = lamps_.tilt_rad;
  }

  // what proves that a repeated run was the same, and what it cost
  ++steps_;
  hashes_[steps_ % hashes_.size()] = hash();
  times_.add(std::chrono::steady_clock::now() - begin);
}

void StepLoop::move(double dt) {
  if (setup_.level == Level::kAuto) choose_level(dt);
  const auto torques = [&] {
    return powertrain::advance(setup_.vehicle, controls_, now_.speed_mps, wheels(), power_, dt);
  };
  switch (running_) {
    case Level::kPose:
      now_ = from_message(setup_.track.at(time_of(steps_ + 1)), 1.0, 1.0);
      break;
    case Level::kKinematic:
      kinematic::advance(setup_.vehicle, controls_.steering_wheel_rad, kinematic::push_of(setup_.vehicle, torques()),
                         now_, dt);
      place_on_road(dt);
      break;
    case Level::kSingleTrack:
    case Level::kFull:
    case Level::kAuto:  // never runs itself
      setup_.sprung->advance(controls_.steering_wheel_rad, torques(), road(), dt);
      now_ = setup_.sprung->state();
      off_road_ |= setup_.sprung->off_road();
      break;
  }
  path_m_ = sprung() ? setup_.sprung->path_m() : path_m_ + now_.speed_mps * std::cos(now_.road_pitch_rad) * dt;
}

void StepLoop::stay_if_lost() {
  const auto fields = fields_of(now_);
  if (!std::all_of(fields.begin(), fields.end(), [](double value) { return std::isfinite(value); }))
    out_of_play_ = kOutOfPlay[1];
  else if (std::max(std::abs(now_.roll_rad), std::abs(now_.pitch_rad)) > kRolledOver_rad)
    out_of_play_ = kOutOfPlay[2];
  if (!out_of_play_) return;
  now_ = before_;
  now_.speed_mps = now_.ax_mps2 = now_.ay_mps2 = now_.heave_rate_mps = 0.0;
  now_.yaw_rate_radps = now_.pitch_rate_radps = now_.roll_rate_radps = 0.0;
  now_.road_pitch_rate_radps = now_.road_roll_rate_radps = 0.0;
}

bool StepLoop::sleeps(double dt) {
  constexpr double kStill_mps = 1e-4, kStill_radps = 1e-5, kAfter_s = 2.0;
  const bool held = controls_.accelerator_01 == 0.0 &&
                    (controls_.brake_01 > 0.0 || controls_.parking_brake_01 > 0.0 || controls_.gear == Gear::kPark);
  const bool still = std::abs(now_.speed_mps) < kStill_mps && std::abs(now_.heave_rate_mps) < kStill_mps &&
                     std::abs(now_.pitch_rate_radps) < kStill_radps && std::abs(now_.roll_rate_radps) < kStill_radps &&
                     std::abs(now_.yaw_rate_radps) < kStill_radps;
  still_s_ = sprung() && held && still ? still_s_ + dt : 0.0;
  if (still_s_ <= kAfter_s) return false;
  slept_s_ += dt;
  return true;
}

// Before the first step, with the controls of the beginning: springs, tyres and brake pressure are where a car that has
// stood there has them, on whatever grade and bank, so that nothing moves.
void StepLoop::begin_standing() {
  fresh_ = false;
  power_ = powertrain::standing(setup_.vehicle, controls_);
  if (setup_.level == Level::kAuto) choose_level(0.0);
  powertrain::State power = power_;
  powertrain::Torques torques =
      powertrain::advance(setup_.vehicle, controls_, 0.0, wheels(), power, setup_.step.seconds());
  torques.drive_nm.fill(0.0);  // a foot on the accelerator has not yet been felt
  if (sprung()) {
    setup_.sprung->stand(torques, road());
    const double lamp_tilt = now_.lamp_tilt_rad;
    now_ = setup_.sprung->state();
    now_.lamp_tilt_rad = lamp_tilt;
  } else {
    kinematic::stand(setup_.vehicle, kinematic::push_of(setup_.vehicle, torques), now_);
  }
  before_ = now_;
}

void StepLoop::run_to(SimTime time) {
  if (fresh_) begin_standing();
  while (this->time() < time) step_once();
}

int StepLoop::catch_up(SimTime elapsed) {
  if (fresh_) begin_standing();
  const std::int64_t due_until = clock_from_.ns + elapsed.ns - dropped_.ns - paused_.ns;
  std::int64_t due = std::max<std::int64_t>(0, (due_until - time().ns) / setup_.step.ns);
  if (due > max_catch_up()) {
    dropped_.ns += (due - max_catch_up()) * setup_.step.ns;
    ++drops_;
    due = max_catch_up();
  }
  for (std::int64_t i = 0; i < due; ++i) step_once();
  return static_cast<int>(due);
}

VehicleState StepLoop::at(SimTime time) const {
  const double ahead = static_cast<double>(this->time().ns - time.ns) / static_cast<double>(setup_.step.ns);
  VehicleState out = setup_.level == Level::kPose
                         ? setup_.track.at(time)
                         : to_message(interpolate(before_, now_, 1.0 - ahead), setup_.vehicle.rest);
  out.frame_index = -1;
  out.level = name(running_);
  out.step = steps();
  out.state_hash = hash();
  if (sprung() && !out_of_play_) {
    out.vx_mps -= setup_.sprung->side_speed_mps() * std::sin(out.yaw_rad);
    out.vy_mps += setup_.sprung->side_speed_mps() * std::cos(out.yaw_rad);
  }
  out.lag_s = dropped_.seconds();
  out.high_beam_telltale = false;
  return out;
}

std::uint64_t StepLoop::hash() const {
  const std::uint64_t model = sprung() && !out_of_play_ ? setup_.sprung->hash() : state_hash(now_);
  return (model * 31 + state_hash(power_)) * 31 + state_hash(lamps_);
}

std::vector<std::uint64_t> StepLoop::hashes_after(std::uint64_t step) const {
  const std::uint64_t seen = step > steps_before_ ? step - steps_before_ : 0;
  const std::uint64_t new_ones = std::min<std::uint64_t>(steps_ - std::min(seen, steps_), hashes_.size());
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t n = steps_ - new_ones + 1; n <= steps_; ++n) hashes.push_back(hashes_[n % hashes_.size()]);
  return hashes;
}

void StepLoop::place_on_road(double dt) {
  const auto points = kinematic::contact_points(setup_.vehicle, now_);
  std::array<double, 4> height = now_.contact_z_m;
  std::array<bool, 4> found{};
  double moved = 0.0;
  int count = 0;
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    auto point = setup_.road.at(points[wheel].x, points[wheel].y);
    if (!setup_.on_top.profiles.empty()) {
      bool off = false;
      const double path = path_m_ + (wheel < 2 ? setup_.vehicle.cg_to_front_m
                                               : setup_.vehicle.cg_to_front_m - setup_.vehicle.wheelbase_m);
      const double z = road().at(points[wheel].x, points[wheel].y, path, wheel % 2 == 0, height[wheel], &off).z_m;
      if (!off) point = RoadPoint{.z_m = z};
    }
    if (!point) continue;
    moved += point->z_m - height[wheel];
    height[wheel] = point->z_m;
    found[wheel] = true;
    ++count;
  }
  // Beside the surface a wheel keeps its last height, raised or lowered with the wheels that do stand on something.
  if (count < 4) {
    off_road_ = true;
    for (std::size_t wheel = 0; wheel < 4 && count > 0; ++wheel)
      if (!found[wheel]) height[wheel] += moved / count;
  }
  kinematic::stand_on(setup_.vehicle, height, now_, dt);
}

powertrain::Wheels StepLoop::wheels() {
  return sprung() ? setup_.sprung->wheels(road()) : powertrain::rolling(now_.speed_mps, setup_.vehicle.tyre_radius_m);
}

const Road& StepLoop::road() {
  road_.mesh = setup_.road.triangle_count() > 0 ? &setup_.road : nullptr;  // a loop may have been moved
  return road_;
}

StepLoop::StepLoop(RunSetup setup, const CarState& state, SimTime start, std::uint64_t steps_before)
    : setup_(std::move(setup)),
      before_(state),
      now_(state),
      start_(start),
      clock_from_(start),
      steps_before_(steps_before) {
  assert(setup_.step.ns > 0);
  road_ = setup_.on_top;
  running_ = setup_.level == Level::kAuto ? Level::kKinematic : setup_.level;
  road_.z_m = 0.25 * (state.contact_z_m[0] + state.contact_z_m[1] + state.contact_z_m[2] + state.contact_z_m[3]);
  if (running_ == Level::kPose) now_ = from_message(setup_.track.at(start), 1.0, 1.0);
  if (running_ == Level::kKinematic) place_on_road(0.0);
  if (running_ == Level::kSingleTrack || running_ == Level::kFull) {
    place_on_road(0.0);
    run_as(running_);
  }
  if (state.ax_mps2 != 0.0 && running_ != Level::kPose)  // goes on from a drive
    power_ = powertrain::under_way(setup_.vehicle, state.speed_mps, kinematic::pushed_n(setup_.vehicle, state));
  lamps_.tilt_rad = lamps_.measured_rad = state.lamp_tilt_rad;
  if (state.lamp_tilt_rad == 0.0 && running_ != Level::kPose)
    lamps_ = levelling::settled(setup_.vehicle.levelling, setup_.levelling, setup_.vehicle.rest.pitch_rad);
  now_.lamp_tilt_rad = lamps_.tilt_rad;
  before_ = now_;
  const CarState& s = state;
  fresh_ = running_ != Level::kPose && steps_before_ == 0 && s.speed_mps == 0.0 && s.pitch_rad == 0.0 &&
           s.roll_rad == 0.0 && s.heave_m == 0.0 && s.ax_mps2 == 0.0;
}

void StepLoop::run_as(Level level) {
  const double side = sprung() ? setup_.sprung->side_speed_mps() : 0.0;
  if (level == Level::kSingleTrack) setup_.sprung->take_over(SprungCar::Model::kSingleTrack, now_, path_m_, side);
  if (level == Level::kFull) setup_.sprung->take_over(SprungCar::Model::kFull, now_, path_m_, side);
  running_ = level;
}

void StepLoop::choose_level(double dt) {
  constexpr std::array<Level, 3> kRungs{Level::kKinematic, Level::kSingleTrack, Level::kFull};
  const Situation situation =
      situation_of(setup_.vehicle, now_, controls_, road(), path_m_, sprung() ? setup_.sprung->least_load_share() : 1.0);
  const Level level = kRungs[static_cast<std::size_t>(auto_.next(situation, dt).rung)];
  if (level != running_) run_as(level);
}

void StepLoop::set_controls(const Controls& controls) {
  bool refused = false;
  const Controls wanted = accepted(controls, controls_, &refused);
  if (wanted != controls_) still_s_ = 0.0;  // any change wakes the car
  controls_ = wanted;
  controls_refused_ += refused ? 1 : 0;
}

void StepLoop::skip(SimTime paused) {
  paused_.ns += paused.ns;
}

StepLoop::Memory StepLoop::memory() const {
  Memory m;
  m.before = before_, m.now = now_;
  m.running = running_;
  m.choice = auto_;
  m.power = power_;
  m.plane_z_m = road_.z_m, m.path_m = path_m_;
  m.lamps = lamps_;
  m.hashes = hashes_;
  m.controls = controls_;
  m.start = start_, m.dropped = dropped_, m.paused = paused_;
  m.steps_before = steps_before_, m.steps = steps_, m.drops = drops_, m.controls_refused = controls_refused_;
  m.off_road = off_road_;
  m.out_of_play = static_cast<int>(std::find(kOutOfPlay.begin(), kOutOfPlay.end(), out_of_play_) - kOutOfPlay.begin());
  m.still_s = still_s_, m.slept_s = slept_s_;
  if (setup_.sprung) m.sprung = setup_.sprung->memory();
  return m;
}

void StepLoop::recall(const Memory& m) {
  fresh_ = false;
  before_ = m.before, now_ = m.now;
  running_ = m.running;
  auto_ = m.choice;
  power_ = m.power;
  road_.z_m = m.plane_z_m, path_m_ = m.path_m;
  lamps_ = m.lamps;
  hashes_ = m.hashes;
  controls_ = m.controls;
  start_ = m.start, dropped_ = m.dropped, paused_ = m.paused;
  steps_before_ = m.steps_before, steps_ = m.steps, drops_ = m.drops, controls_refused_ = m.controls_refused;
  off_road_ = m.off_road;
  out_of_play_ = kOutOfPlay[static_cast<std::size_t>(m.out_of_play) % kOutOfPlay.size()];
  still_s_ = m.still_s, slept_s_ = m.slept_s;
  if (setup_.sprung) setup_.sprung->recall(m.sprung);
}

void StepLoop::begin_clock() {
  clock_from_.ns = time().ns + dropped_.ns + paused_.ns;
}

int StepLoop::max_catch_up() const {
  constexpr std::int64_t kMaxSteps = 25, kMaxTime_ns = 50'000'000;
  return static_cast<int>(std::clamp<std::int64_t>(kMaxTime_ns / setup_.step.ns, 1, kMaxSteps));
}

const char* name(Level level) {
  return kDynamicsLevelNames[static_cast<std::size_t>(level)].data();
}

Result<Level> parse_level(const std::string& text, const std::string& place) {
  std::string all;
  for (std::size_t i = 0; i < kDynamicsLevelNames.size(); ++i) {
    if (text == kDynamicsLevelNames[i]) return static_cast<Level>(i);
    all += (i == 0 ? "" : ", ") + std::string(kDynamicsLevelNames[i]);
  }
  return Error{place, "level \"" + text + "\" is unknown; there are " + all};
}

}  // namespace phare
