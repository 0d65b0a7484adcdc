#include "vehicle_dynamics/step.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

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
  if (car_.sprung()) stay_if_lost();

  // the lamps against the body
  if (!car_.recorded()) {  // a record holds them already
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
  chassis::Input& in = car_.input;
  in.road = &road();
  choose_level(dt);

  // pedals to torques, the driver's wheel to the front wheels
  if (!car_.recorded()) {
    const powertrain::Torques torques =
        powertrain::advance(setup_.vehicle, controls_, now_.speed_mps, car_.wheels(setup_), power_, dt);
    in.drive_nm = torques.drive_nm, in.brake_nm = torques.brake_nm;
    in.steering_wheel_rad = controls_.steering_wheel_rad;
    in.steer_rad = turned_rad(setup_.vehicle, controls_.steering_wheel_rad, in.steer_rad, dt);
  }

  car_.advance(setup_, dt);
  take_shown();
}

// What the level shows is the car, and where its wheels now stand the next step begins.
void StepLoop::take_shown() {
  const double lamp_tilt = now_.lamp_tilt_rad;
  now_ = car_.show(setup_).state;
  if (!car_.recorded()) now_.lamp_tilt_rad = lamp_tilt;
  car_.input.height_m = now_.contact_z_m;  // beside the road a wheel keeps its last height
  off_road_ |= car_.shown.off_road;
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
  still_s_ = car_.sprung() && held && still ? still_s_ + dt : 0.0;
  if (still_s_ <= kAfter_s) return false;
  slept_s_ += dt;
  return true;
}

// Before the first step, with the controls of the beginning: springs, tyres and brake pressure are where a car that has
// stood there has them, on whatever grade and bank, so that nothing moves.
void StepLoop::begin_standing() {
  fresh_ = false;
  power_ = powertrain::standing(setup_.vehicle, controls_);
  chassis::Input& in = car_.input;
  in.road = &road();
  choose_level(0.0);
  powertrain::State power = power_;
  in.brake_nm =
      powertrain::advance(setup_.vehicle, controls_, 0.0, car_.wheels(setup_), power, setup_.step.seconds()).brake_nm;
  in.drive_nm.fill(0.0);  // a foot on the accelerator has not yet been felt
  car_.stand(setup_);
  take_shown();
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
  VehicleState out = car_.recorded() ? setup_.track.at(time)
                                     : to_message(interpolate(before_, now_, 1.0 - ahead), setup_.vehicle.rest);
  out.frame_index = -1;
  out.level = name(car_.level());
  out.step = steps();
  out.state_hash = hash();
  if (car_.sprung() && !out_of_play_) {
    out.vx_mps -= car_.shown.side_mps * std::sin(out.yaw_rad);
    out.vy_mps += car_.shown.side_mps * std::cos(out.yaw_rad);
  }
  out.lag_s = dropped_.seconds();
  out.high_beam_telltale = false;
  return out;
}

std::uint64_t StepLoop::hash() const {
  const std::uint64_t model = out_of_play_ ? state_hash(now_) : car_.hash(now_);
  return (model * 31 + state_hash(power_)) * 31 + state_hash(lamps_);
}

std::vector<std::uint64_t> StepLoop::hashes_after(std::uint64_t step) const {
  const std::uint64_t seen = step > steps_before_ ? step - steps_before_ : 0;
  const std::uint64_t new_ones = std::min<std::uint64_t>(steps_ - std::min(seen, steps_), hashes_.size());
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t n = steps_ - new_ones + 1; n <= steps_; ++n) hashes.push_back(hashes_[n % hashes_.size()]);
  return hashes;
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
  road_.z_m = 0.25 * (state.contact_z_m[0] + state.contact_z_m[1] + state.contact_z_m[2] + state.contact_z_m[3]);
  if (setup_.sprung) single_track::set_step(setup_.sprung->single_track, setup_.step.seconds());
  begin_at(state);
  if (state.ax_mps2 != 0.0 && !car_.recorded())  // goes on from a drive
    power_ = powertrain::under_way(setup_.vehicle, state.speed_mps, kinematic::pushed_n(setup_.vehicle, state));
  lamps_.tilt_rad = lamps_.measured_rad = state.lamp_tilt_rad;
  if (state.lamp_tilt_rad == 0.0 && !car_.recorded())
    lamps_ = levelling::settled(setup_.vehicle.levelling, setup_.levelling, setup_.vehicle.rest.pitch_rad);
  now_.lamp_tilt_rad = lamps_.tilt_rad;
  before_ = now_;
  const CarState& s = state;
  fresh_ = !car_.recorded() && steps_before_ == 0 && s.speed_mps == 0.0 && s.pitch_rad == 0.0 && s.roll_rad == 0.0 &&
           s.heave_m == 0.0 && s.ax_mps2 == 0.0;
}

// Every car begins on its wheels, as level kinematic stands on the road; a record where it is.
void StepLoop::begin_at(const CarState& state) {
  car_.now = Car::of(setup_.level);
  if (car_.recorded()) {
    car_.shown.time = start_;
    car_.take_over(setup_.level, setup_);
    now_ = car_.show(setup_).state;
    return;
  }
  KinematicLevel placed{.state = state};
  car_.input.road = &road();
  placed.place_on_road(setup_, car_.input, 0.0);
  car_.shown = placed.seen(setup_, car_.input, 0.0);
  now_ = car_.shown.state, off_road_ = car_.shown.off_road;
  car_.take_over(setup_.level, setup_);
  take_input_from_shown();
}

void StepLoop::take_input_from_shown() {
  car_.input.height_m = car_.shown.state.contact_z_m;
  car_.input.steer_rad = car_.shown.state.steer_rad;
}

void StepLoop::choose_level(double dt) {
  if (setup_.level != Level::kAuto) return;
  if (car_.choose(auto_, setup_, controls_, road(), dt)) take_input_from_shown();
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
  m.car = car_, m.car.input.road = nullptr;
  m.choice = auto_;
  m.power = power_;
  m.plane_z_m = road_.z_m;
  m.lamps = lamps_;
  m.hashes = hashes_;
  m.controls = controls_;
  m.start = start_, m.dropped = dropped_, m.paused = paused_;
  m.steps_before = steps_before_, m.steps = steps_, m.drops = drops_, m.controls_refused = controls_refused_;
  m.off_road = off_road_;
  m.out_of_play = static_cast<int>(std::find(kOutOfPlay.begin(), kOutOfPlay.end(), out_of_play_) - kOutOfPlay.begin());
  m.still_s = still_s_, m.slept_s = slept_s_;
  return m;
}

void StepLoop::recall(const Memory& m) {
  fresh_ = false;
  before_ = m.before, now_ = m.now;
  car_ = m.car;
  auto_ = m.choice;
  power_ = m.power;
  road_.z_m = m.plane_z_m;
  lamps_ = m.lamps;
  hashes_ = m.hashes;
  controls_ = m.controls;
  start_ = m.start, dropped_ = m.dropped, paused_ = m.paused;
  steps_before_ = m.steps_before, steps_ = m.steps, drops_ = m.drops, controls_refused_ = m.controls_refused;
  off_road_ = m.off_road;
  out_of_play_ = kOutOfPlay[static_cast<std::size_t>(m.out_of_play) % kOutOfPlay.size()];
  still_s_ = m.still_s, slept_s_ = m.slept_s;
}

void StepLoop::begin_clock() {
  clock_from_.ns = time().ns + dropped_.ns + paused_.ns;
}

int StepLoop::max_catch_up() const {
  constexpr std::int64_t kMaxSteps = 25, kMaxTime_ns = 50'000'000;
  return static_cast<int>(std::clamp<std::int64_t>(kMaxTime_ns / setup_.step.ns, 1, kMaxSteps));
}

}  // namespace phare
