// The car of a batch run, and the inputs that drive it. For batch.cpp only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/batch_playhead.h"
#include "vehicle_dynamics/car.h"

namespace phare::batch {

// A car with what a batch run drives it by, and what it tells of it.
class DrivenCar {
 public:
  DrivenCar(const Options& o, bool resistance, bool given_torques) : o_(o), driver_(o.driver) {
    p_.vehicle = o.vehicle;
    p_.step = SimTime{std::llround(o.step_s * 1e9)};
    p_.footing = Footing::kBatch;
    p_.torques_given = given_torques;
    if (!resistance) p_.vehicle.drag_area_m2 = p_.vehicle.rolling_coefficient = 0.0;
    car_.now = Car::of(o.level);
    car_.input.air_and_rolling = resistance;
    car_.input.road = o.road;
  }

  Status prepare() {
    if (o_.relaxation_scale && p_.vehicle.chassis) {
      p_.vehicle.chassis->tyre.long_relaxation_m *= *o_.relaxation_scale;
      p_.vehicle.chassis->tyre.lat_relaxation_m *= *o_.relaxation_scale;
    }
    if (!automatic() && !car_.sprung()) return Done{};
    // Where forces hold the body is worked out after a step, not integrated: SUNDIALS would leave it where it was.
    if (o_.integrator == Integrator::kReference && !o_.single_track.dynamic_attitude)
      return Error{"--attitude quasi-static", "is no motion to integrate; it does not go with --integrator reference"};
    Result<SprungParams> sprung = SprungParams::of(p_.vehicle, o_.vehicle_place, o_.single_track);
    if (!sprung) return sprung.error();
    if (!automatic()) sprung->set_integrator(o_.integrator);
    single_track::set_step(sprung->single_track, o_.step_s);
    p_.sprung = std::move(*sprung);
    return Done{};
  }

  // Error: there is no road there.
  Status place(const std::array<double, 4>* given) {
    const double b = p_.vehicle.wheelbase_m - p_.vehicle.cg_to_front_m;
    const double c = std::cos(o_.start_yaw_rad), sn = std::sin(o_.start_yaw_rad);
    std::array<double, 4> height{};
    if (given) {
      car_.input.heights_given = true;
      height = on_the_map(*given);
      car_.input.height_m = car_.heights_along_road() ? *given : height;
    } else if (o_.road) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double along = i < 2 ? p_.vehicle.cg_to_front_m : -b,
                     aside = (i % 2 == 0 ? 0.5 : -0.5) * p_.vehicle.track_m;
        const double x = o_.start_x_m + c * along - sn * aside, y = o_.start_y_m + sn * along + c * aside;
        bool off = false;
        height[i] = o_.road->height_m(x, y, o_.start_x_m + along, i % 2 == 0, 0.0, &off);
        if (off)
          return Error{"--start-x-m", "there is no road under the car: none of its triangles is at x " + text_of(x) +
                                          " m, y " + text_of(y) + " m"};
      }
    }
    car_.begin(p_, {o_.start_x_m, o_.start_y_m, o_.start_yaw_rad, o_.speed_mps, height});
    yaw_ = o_.start_yaw_rad;
    beside_ = height;
    lamps_ = levelling::settled(p_.vehicle.levelling, o_.levelling, p_.vehicle.rest.pitch_rad);
    if (accounts()) account_ = car_.open_account(p_);
    return Done{};
  }

  // Of a car that stands: where the first row's foot and road hold it. After place().
  void stand(Playhead& in, const Inputs& inputs, double dt) {
    if (o_.speed_mps != 0.0) return;
    in.go(inputs.time_s.front());
    car_.input.steer_rad = in.linear(inputs.steer_rad);
    const Driver driver = driver_;  // its memory begins with the first step
    torques_of(in, inputs, dt);     // for the pedals
    power_ = powertrain::standing(p_.vehicle, controls_);
    choose_level(0.0);
    powertrain::Torques torques = torques_of(in, inputs, dt);
    power_ = powertrain::standing(p_.vehicle, controls_);
    driver_ = driver;
    if (!p_.torques_given) torques.drive_nm.fill(0.0);
    car_.input.drive_nm = torques.drive_nm, car_.input.brake_nm = torques.brake_nm;
    car_.stand(p_);
    if (accounts()) account_ = car_.open_account(p_);
  }

  // Inputs over the step [time, time + dt]: heights linear, the rest at its middle.
  // False: the reference integrator gave up, see gave_up().
  bool step(Playhead& in, const Inputs& inputs, double time_s, double dt) {
    chassis::Input& now = car_.input;
    if (!inputs.road_m[0].empty()) {
      now.height_m = heights(in, inputs, time_s);
      const std::array<double, 4> next = heights(in, inputs, time_s + dt);
      for (std::size_t i = 0; i < 4; ++i) now.height_rate_mps[i] = (next[i] - now.height_m[i]) / dt;
    } else {
      now.height_m = beside_;
    }
    in.go(time_s + 0.5 * dt);
    choose_level(dt);
    now.steer_rad = o_.driver.path.empty() ? in.linear(inputs.steer_rad) : steered(dt);
    now.steering_wheel_rad = now.steer_rad * p_.vehicle.steering_ratio;
    const powertrain::Torques torques = torques_of(in, inputs, dt);
    now.drive_nm = torques.drive_nm, now.brake_nm = torques.brake_nm;
    if (o_.integrator == Integrator::kReference) {
      gave_up_ = car_.advance_by(reference_, p_, dt);
      return gave_up_.ok();
    }
    if (accounts())
      car_.advance(p_, dt, account_);
    else
      car_.advance(p_, dt);
    return true;
  }

  // Braked to a stand, or at the end of the way.
  bool at_rest() const {
    return (std::abs(car_.speed_mps(p_)) < 1e-3 && controls_.brake_01 > 0.0) ||
           (!o_.driver.path.empty() && driver_.arrived());
  }

  bool sound() const { return car_.sound(); }

  // After a step of length dt, or at the start with 0. Not part of the model's own work.
  Row row(double time_s, double dt) {
    chassis::Input now = car_.input;  // heights at the end of the step
    for (std::size_t i = 0; i < 4; ++i)
      if (now.heights_given) now.height_m[i] += now.height_rate_mps[i] * dt;
    const Motion m = car_.motion(p_, now);
    const chassis::Forces& f = m.forces;
    beside_ = f.ground_m;
    off_road_ |= f.off_road;
    watch_for_roll_over(m, time_s);
    Row row;
    row.time_s = time_s;
    row.level = rung_of(car_.level());
    row.x_m = m.x_m, row.y_m = m.y_m, row.z_m = m.z_m;
    row.roll_rad = f.roll_rad, row.pitch_rad = f.pitch_rad;
    row.yaw_rad = m.turns_wrapped ? yaw_ += std::remainder(f.yaw_rad - yaw_, 2.0 * std::numbers::pi) : f.yaw_rad;
    row.roll_rate_radps = f.roll_rate_radps, row.pitch_rate_radps = f.pitch_rate_radps,
    row.yaw_rate_radps = f.yaw_rate_radps;
    row.vx_mps = m.u_mps, row.vy_mps = m.v_mps;
    row.ax_mps2 = f.ax_mps2, row.ay_mps2 = f.ay_mps2;
    row.spin_radps = m.spin_radps;
    row.fz_n = f.load_n, row.fx_n = f.fx_n, row.fy_n = f.fy_n;
    if (o_.columns) on_demand(f, row);
    road_pitch_ = f.road_pitch_rad, origin_z_ = m.origin_z_m, plane_z_ = m.plane_z_m;
    add_rest(row);
    return row;
  }

  // Lamps: after the row, with the same dt.
  void lamps(const LevellingParams& p, double wheel_steps, double dt, Row& row) {
    const double pitch = row.pitch_rad - road_pitch_;
    levelling::advance(p, o_.levelling, wheel_steps, pitch, row.vx_mps, lamps_, dt);
    row.lamp_tilt_rad = lamps_.tilt_rad;
    row.cutoff_25m_m =
        levelling::cutoff_on_wall_m(p, pitch, (origin_z_ - plane_z_) * std::cos(road_pitch_), lamps_.tilt_rad);
    row.cutoff_25m_z_m = levelling::cutoff_on_wall_m(p, row.pitch_rad, origin_z_, lamps_.tilt_rad);
  }

  std::uint64_t hash() { return car_.hash(car_.show(p_).state); }
  bool off_road() const { return off_road_; }
  const AutoLevel& choice() const { return auto_; }
  const std::optional<double>& rolled_over_s() const { return rolled_over_s_; }
  bool burst() const { return burst_; }
  const Status& gave_up() const { return gave_up_; }

 private:
  bool automatic() const { return o_.level == Level::kAuto; }
  bool accounts() const { return o_.columns & kEnergy; }

  // Level auto: as the loop of a live run does it, from what the car is seen to do.
  void choose_level(double dt) {
    if (!automatic()) return;
    static const Road kLevelRoad;
    car_.show(p_);
    car_.choose(auto_, p_, controls_, o_.road ? *o_.road : kLevelRoad, dt);
  }

  // A car on its side has none of the forces that a level knows. No car comes over that fast: a step too long for the
  // method does.
  void watch_for_roll_over(const Motion& m, double time_s) {
    constexpr double kTumbles_mps = 150.0;
    const chassis::Forces& f = m.forces;
    const double lean_rad = std::max(std::abs(f.roll_rad - f.road_roll_rad), std::abs(f.pitch_rad - f.road_pitch_rad));
    if (!rolled_over_s_ && car_.sprung() && lean_rad > kRolledOver_rad) rolled_over_s_ = time_s;
    if (rolled_over_s_ && std::hypot(std::hypot(m.u_mps, m.v_mps), m.rise_mps) > kTumbles_mps) burst_ = true;
  }

  // The path is that of the car's origin, as lanes are.
  double steered(double dt) {
    const LanePoint now = car_.place(p_);
    const double b = p_.vehicle.wheelbase_m - p_.vehicle.cg_to_front_m;
    return driver_.steer_rad(now.x_m - b * std::cos(now.heading_rad), now.y_m - b * std::sin(now.heading_rad),
                             now.heading_rad, car_.speed_mps(p_), p_.vehicle.wheelbase_m,
                             p_.vehicle.max_steering_wheel_rad / p_.vehicle.steering_ratio, car_.input.steer_rad, dt);
  }

  // The models count from where the car rests with its load.
  void add_rest(Row& row) {
    const RestAttitude& rest = p_.vehicle.rest;
    row.pitch_rad += rest.pitch_rad;
    row.z_m += rest.heave_m - (p_.vehicle.wheelbase_m - p_.vehicle.cg_to_front_m) * rest.pitch_rad;
    origin_z_ += rest.heave_m;
  }

  // What was asked for beside the motion.
  void on_demand(const chassis::Forces& f, Row& row) const {
    row.drive_nm = car_.input.drive_nm, row.brake_nm = car_.input.brake_nm;
    row.gear = p_.torques_given || !p_.vehicle.engine ? 0.0 : power_.gear + 1.0;
    row.engine_rpm = power_.engine_radps * 30.0 / std::numbers::pi;
    row.steer_rad = car_.input.steer_rad, row.accelerator_01 = controls_.accelerator_01;
    row.brake_01 = controls_.brake_01;
    row.car_j = account_.car_j, row.engine_j = account_.engine_j, row.brakes_j = account_.brakes_j;
    row.tyres_j = account_.tyres_j, row.dampers_j = account_.dampers_j, row.air_j = account_.air_j;
    row.road_j = account_.road_j;
    const WheelFigures wheels = car_.figures(p_, f, o_.step_s);
    row.slip = wheels.slip, row.slip_angle_rad = wheels.slip_angle_rad, row.travel_m = wheels.travel_m;
    row.camber_rad = wheels.camber_rad, row.friction_used_01 = wheels.friction_used_01;
  }

  // Heights that the inputs give, as the level takes them: where its own wheels are, or a wheelbase and a track apart
  // on the map.
  std::array<double, 4> heights(Playhead& in, const Inputs& inputs, double time_s) const {
    in.go(time_s);
    std::array<double, 4> given{};
    for (std::size_t i = 0; i < 4; ++i) given[i] = in.linear(inputs.road_m[i]);
    return car_.heights_along_road() ? given : on_the_map(given);
  }
  std::array<double, 4> on_the_map(const std::array<double, 4>& h) const {
    constexpr double kSteepest = 0.99;  // of a sine: what stands upright is no road
    const VehicleParams& v = p_.vehicle;
    const double front = 0.5 * (h[0] + h[1]), rear = 0.5 * (h[2] + h[3]);
    const double up = std::clamp((front - rear) / v.wheelbase_m, -kSteepest, kSteepest);
    const double level = std::sqrt(1.0 - up * up), rise = up / level * v.wheelbase_m;
    const double centre = rear + (front - rear) * (v.wheelbase_m - v.cg_to_front_m) / v.wheelbase_m;
    std::array<double, 4> out{};
    for (std::size_t i = 0; i < 4; i += 2) {
      const double track = v.chassis ? (i == 0 ? v.chassis->front_track_m : v.chassis->rear_track_m) : v.track_m;
      const double aside = std::clamp((h[i] - h[i + 1]) / (track * level), -kSteepest, kSteepest);
      const double half = 0.5 * track * aside / std::sqrt(1.0 - aside * aside) / level;
      const double mean = centre + rise * (i == 0 ? v.cg_to_front_m : v.cg_to_front_m - v.wheelbase_m) / v.wheelbase_m;
      out[i] = mean + half, out[i + 1] = mean - half;
    }
    return out;
  }

  // What the inputs turn and brake the wheels with: pedals through the powertrain, torques as they are.
  powertrain::Torques torques_of(const Playhead& in, const Inputs& inputs, double dt) {
    const double parking_01 = in.linear(inputs.parking_01);
    if (!inputs.accelerator_01.empty()) {
      controls_ = {.accelerator_01 = in.linear(inputs.accelerator_01),
                   .brake_01 = in.linear(inputs.brake_01),
                   .gear = static_cast<Gear>(static_cast<int>(in.held(inputs.gear))),
                   .parking_brake_01 = parking_01};
      if (o_.driver.hold_speed_mps) {
        const Driver::Pedals pedals = driver_.pedals(car_.place(p_).x_m, car_.speed_mps(p_), dt);
        controls_.accelerator_01 = controls_.brake_01 > 0.0 ? 0.0 : pedals.accelerator_01;
        controls_.brake_01 = std::max(controls_.brake_01, pedals.brake_01);  // the inputs' foot comes first
      }
      return powertrain::advance(p_.vehicle, controls_, car_.speed_mps(p_), car_.wheels(p_), power_, dt);
    }
    powertrain::Torques out;
    for (std::size_t i = 0; i < 4; ++i) {
      const double torque = in.linear(inputs.torque_nm[i]);
      if (!inputs.brake_nm[i].empty()) {
        out.drive_nm[i] = torque, out.brake_nm[i] = in.linear(inputs.brake_nm[i]);
      } else {
        out.drive_nm[i] = std::max(torque, 0.0), out.brake_nm[i] = std::max(-torque, 0.0);
      }
      if (i >= 2) out.brake_nm[i] += powertrain::parking_nm(p_.vehicle, parking_01);
    }
    return out;
  }

  Options o_;
  CarParams p_;
  Car car_;
  AutoLevel auto_;
  powertrain::State power_;
  Controls controls_;
  Driver driver_;
  energy::Account account_;
  levelling::State lamps_;
  ReferenceIntegrator reference_;
  std::array<double, 4> beside_{};
  double yaw_ = 0.0, road_pitch_ = 0.0, origin_z_ = 0.0, plane_z_ = 0.0;
  bool off_road_ = false, burst_ = false;
  std::optional<double> rolled_over_s_;
  Status gave_up_ = Done{};
};

}  // namespace phare::batch
