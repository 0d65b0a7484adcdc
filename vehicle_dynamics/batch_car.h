// The car of a batch run: any level behind one face, and the inputs that drive it. For batch.cpp only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "config/conventions.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/models/air.h"
#include "vehicle_dynamics/models/energy.h"
#include "vehicle_dynamics/models/kinematic.h"
#include "vehicle_dynamics/models/powertrain.h"

namespace phare::batch {

// Inputs at any time; rows are walked forwards only.
class Playhead {
 public:
  explicit Playhead(const Inputs& in) : in_(in) {}

  void go(double time_s) {
    while (row_ + 2 < in_.time_s.size() && in_.time_s[row_ + 1] <= time_s) ++row_;
    const double from = in_.time_s[row_], to = in_.time_s[std::min(row_ + 1, in_.time_s.size() - 1)];
    share_ = to > from ? std::clamp((time_s - from) / (to - from), 0.0, 1.0) : 0.0;
  }
  double linear(const std::vector<double>& column) const {
    if (column.empty()) return 0.0;
    return column[row_] + share_ * (column[std::min(row_ + 1, column.size() - 1)] - column[row_]);
  }
  std::size_t row() const { return row_; }
  double held(const std::vector<double>& column) const {
    return column.empty() ? 0.0 : column[share_ >= 1.0 ? std::min(row_ + 1, column.size() - 1) : row_];
  }

 private:
  const Inputs& in_;
  std::size_t row_ = 0;
  double share_ = 0.0;
};

inline std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

// Every number finite: what is not makes its product with 0 not 0. Four sums, which do not wait for one another.
inline bool finite(const double* values, std::size_t count) {
  std::array<double, 4> sum{};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (std::size_t k = 0; k < 4; ++k) sum[k] += values[i + k] * 0.0;
  for (; i < count; ++i) sum[0] += values[i] * 0.0;
  return sum[0] + sum[1] + sum[2] + sum[3] == 0.0;
}

// A car of any level behind one face, for this loop only.
class Car {
 public:
  Car(const Options& o, bool resistance, bool given_torques) : o_(o), driver_(o.driver), given_torques_(given_torques) {
    if (!resistance) o_.vehicle.drag_area_m2 = o_.vehicle.rolling_coefficient = 0.0;
    input_.air_and_rolling = resistance;
    input_.road = o.road;
  }

  Status prepare() {
    if (o_.relaxation_scale && o_.vehicle.chassis) {
      o_.vehicle.chassis->tyre.long_relaxation_m *= *o_.relaxation_scale;
      o_.vehicle.chassis->tyre.lat_relaxation_m *= *o_.relaxation_scale;
    }
    if (o_.level == Level::kFull) {
      Result<full::Params> p = full::params_of(o_.vehicle, o_.vehicle_place);
      if (!p) return p.error();
      full_params_ = *p;
      full_params_.integrator = o_.integrator;
    } else if (o_.level == Level::kSingleTrack) {
      // Where forces hold the body is worked out after a step, not integrated: SUNDIALS would leave it where it was.
      if (o_.integrator == Integrator::kReference && !o_.single_track.dynamic_attitude)
        return Error{"--attitude quasi-static",
                     "is no motion to integrate; it does not go with --integrator reference"};
      Result<single_track::Params> p = single_track::params_of(o_.vehicle, o_.single_track, o_.vehicle_place);
      if (!p) return p.error();
      single_params_ = *p;
      single_params_.integrator = o_.integrator;
      single_track::set_step(single_params_, o_.step_s);
    }
    return Done{};
  }

  // Error: there is no road there.
  Status place(const std::array<double, 4>* given) {
    const double b = o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m;
    const double c = std::cos(o_.start_yaw_rad), sn = std::sin(o_.start_yaw_rad);
    std::array<double, 4> height{};
    if (given) {
      input_.heights_given = true;
      height = on_the_map(*given);
      input_.height_m = o_.level == Level::kFull ? *given : height;
    } else if (o_.road) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double along = i < 2 ? o_.vehicle.cg_to_front_m : -b,
                     aside = (i % 2 == 0 ? 0.5 : -0.5) * o_.vehicle.track_m;
        const double x = o_.start_x_m + c * along - sn * aside, y = o_.start_y_m + sn * along + c * aside;
        bool off = false;
        height[i] = o_.road->at(x, y, o_.start_x_m + along, i % 2 == 0, 0.0, &off).z_m;
        if (off)
          return Error{"--start-x-m", "there is no road under the car: none of its triangles is at x " + text_of(x) +
                                          " m, y " + text_of(y) + " m"};
      }
    }
    full_ = full::at_rest(full_params_, o_.start_x_m, o_.start_y_m, o_.start_yaw_rad, o_.speed_mps, height);
    single_ = single_track::at_rest(single_params_, o_.start_x_m, o_.start_y_m, o_.start_yaw_rad, o_.speed_mps, height);
    path_m_ = o_.start_x_m - b;
    flat_.x_m = o_.start_x_m - b * c, flat_.y_m = o_.start_y_m - b * sn, flat_.yaw_rad = yaw_ = o_.start_yaw_rad;
    flat_.speed_mps = o_.speed_mps;
    kinematic::stand_on(o_.vehicle, height, flat_, 0.0);
    beside_ = height;
    if (o_.columns & kEnergy)
      account_ = o_.level == Level::kFull          ? energy::open(full_params_, input_, full_)
                 : o_.level == Level::kSingleTrack ? energy::open(single_params_, input_, single_)
                                                   : energy::open(o_.vehicle, flat_);
    return Done{};
  }

  // Inputs over the step [time, time + dt]: heights linear, the rest at its middle.
  // False: the reference integrator gave up, see gave_up().
  bool step(Playhead& in, const Inputs& inputs, double time_s, double dt) {
    if (!inputs.road_m[0].empty()) {
      input_.height_m = heights(in, inputs, time_s);
      const std::array<double, 4> next = heights(in, inputs, time_s + dt);
      for (std::size_t i = 0; i < 4; ++i) input_.height_rate_mps[i] = (next[i] - input_.height_m[i]) / dt;
    } else {
      input_.height_m = beside_;
    }
    in.go(time_s + 0.5 * dt);
    if (o_.driver.path.empty())
      input_.steer_rad = in.linear(inputs.steer_rad);
    else
      input_.steer_rad = steered(dt);
    const powertrain::Torques torques = torques_of(in, inputs, dt);
    input_.drive_nm = torques.drive_nm, input_.brake_nm = torques.brake_nm;
    if (o_.level == Level::kKinematic) {
      kinematic_step(torques, dt);
      return true;
    }
    if (o_.integrator == Integrator::kReference) {
      gave_up_ = o_.level == Level::kFull ? reference_.advance(full_params_, input_, full_, dt)
                                          : reference_.advance(single_params_, input_, single_, dt);
      return gave_up_.ok();
    }
    const full::State full_before = full_;
    const single_track::State single_before = single_;
    if (o_.level == Level::kFull)
      full::advance(full_params_, input_, full_, dt);
    else
      single_track::advance(single_params_, input_, single_, dt);
    if (o_.columns & kEnergy) {
      if (o_.level == Level::kFull)
        energy::add(full_params_, input_, full_before, full_, dt, account_);
      else
        energy::add(single_params_, input_, single_before, single_, dt, account_);
    }
    return true;
  }

  // Braked to a stand, or at the end of the way.
  bool at_rest() const {
    return (std::abs(speed()) < 1e-3 && controls_.brake_01 > 0.0) || (!o_.driver.path.empty() && driver_.arrived());
  }

  // Numbers that a car can have, by far: a step that is too long for the method, or a road that rises by kilometres,
  // leaves them.
  bool sound() const {
    constexpr double kMost_mps = 1e4, kSteepest = 100.0;
    const auto possible = [](double a, double b, double c) { return a * a + b * b + c * c < kMost_mps * kMost_mps; };
    if (o_.level == Level::kFull)
      return finite(&full_.x_m, full::kStateSize) && possible(full_.u_mps, full_.v_mps, full_.w_mps);
    if (o_.level == Level::kSingleTrack)
      return finite(&single_.x_m, single_track::kStateSize) &&
             possible(single_.u_mps, single_.v_mps, single_.z_rate_mps) && std::abs(single_.pitch) < kSteepest &&
             std::abs(single_.roll) < kSteepest;
    return finite(&flat_.x_m, sizeof(CarState) / sizeof(double)) &&
           possible(flat_.speed_mps, flat_.heave_rate_mps, 0.0);
  }

  // After a step of length dt, or at the start with 0. Not part of the model's own work.
  Row row(double time_s, double dt) {
    Row row;
    row.time_s = time_s;
    full::Input now = input_;  // heights at the end of the step
    for (std::size_t i = 0; i < 4; ++i)
      if (now.heights_given) now.height_m[i] += now.height_rate_mps[i] * dt;
    const double b = o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m, h = o_.vehicle.cg_height_m;
    if (o_.level == Level::kKinematic) {
      const CarState& s = flat_;
      const double c = std::cos(s.yaw_rad), sn = std::sin(s.yaw_rad);
      row.x_m = s.x_m + b * c, row.y_m = s.y_m + b * sn;
      row.pitch_rad = s.road_pitch_rad + s.pitch_rad, row.roll_rad = s.road_roll_rad + s.roll_rad;
      row.z_m = s.z_m + s.heave_m - b * std::sin(row.pitch_rad);
      row.yaw_rad = s.yaw_rad;
      row.roll_rate_radps = s.road_roll_rate_radps + s.roll_rate_radps;
      row.pitch_rate_radps = s.road_pitch_rate_radps + s.pitch_rate_radps;
      row.yaw_rate_radps = s.yaw_rate_radps;
      row.vx_mps = s.speed_mps, row.vy_mps = s.yaw_rate_radps * b;
      row.ax_mps2 = s.ax_mps2, row.ay_mps2 = s.ay_mps2;
      row.spin_radps.fill(s.speed_mps / o_.vehicle.tyre_radius_m);
      kinematic_forces(row);
      if (o_.columns) on_demand(nullptr, row);
      road_pitch_ = s.road_pitch_rad, origin_z_ = s.z_m + s.heave_m, plane_z_ = s.z_m;
      return row;
    }
    const bool whole = o_.level == Level::kFull;
    const full::Forces f =
        whole ? full::forces(full_params_, now, full_) : single_track::forces(single_params_, now, single_);
    beside_ = f.ground_m;
    off_road_ |= f.off_road;
    row.x_m = whole ? full_.x_m : single_.x_m, row.y_m = whole ? full_.y_m : single_.y_m;
    row.z_m = whole ? full_.z_m : single_.z_m;
    row.roll_rad = f.roll_rad, row.pitch_rad = f.pitch_rad;
    if (!rolled_over_s_ &&
        std::max(std::abs(f.roll_rad - f.road_roll_rad), std::abs(f.pitch_rad - f.road_pitch_rad)) > kRolledOver_rad)
      rolled_over_s_ = time_s;
    // No car comes over that fast: a step too long for the method does.
    constexpr double kTumbles_mps = 150.0;
    if (rolled_over_s_ && std::hypot(row_speed(whole), whole ? full_.w_mps : single_.z_rate_mps) > kTumbles_mps)
      burst_ = true;
    row.yaw_rad = yaw_ += std::remainder(f.yaw_rad - yaw_, 2.0 * std::numbers::pi);
    row.roll_rate_radps = f.roll_rate_radps, row.pitch_rate_radps = f.pitch_rate_radps,
    row.yaw_rate_radps = f.yaw_rate_radps;
    row.vx_mps = whole ? full_.u_mps : single_.u_mps, row.vy_mps = whole ? full_.v_mps : single_.v_mps;
    row.ax_mps2 = f.ax_mps2, row.ay_mps2 = f.ay_mps2;
    row.spin_radps = spins();
    row.fz_n = f.load_n, row.fx_n = f.fx_n, row.fy_n = f.fy_n;
    if (o_.columns) on_demand(&f, row);
    road_pitch_ = f.road_pitch_rad;
    origin_z_ = row.z_m + h + b * std::sin(f.pitch_rad) - h * std::cos(f.pitch_rad) * std::cos(f.roll_rad);
    plane_z_ = 0.5 * (f.ground_m[2] + f.ground_m[3]);
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

  double speed() const {
    return o_.level == Level::kFull ? full_.u_mps : o_.level == Level::kSingleTrack ? single_.u_mps : flat_.speed_mps;
  }
  std::array<double, 4> spins() const {
    if (o_.level == Level::kFull) return full_.spin_radps;
    std::array<double, 4> spin;
    spin.fill(speed() / o_.vehicle.tyre_radius_m);
    return spin;
  }
  std::uint64_t hash() const {
    return o_.level == Level::kFull          ? state_hash(full_)
           : o_.level == Level::kSingleTrack ? state_hash(single_)
                                             : state_hash(flat_);
  }
  bool off_road() const { return off_road_; }
  const std::optional<double>& rolled_over_s() const { return rolled_over_s_; }
  bool burst() const { return burst_; }
  const Status& gave_up() const { return gave_up_; }

 private:
  double row_speed(bool whole) const {
    return whole ? std::hypot(full_.u_mps, full_.v_mps) : std::hypot(single_.u_mps, single_.v_mps);
  }

  // The centre of gravity's place on the map, and the heading.
  LanePoint place_now() const {
    if (o_.level == Level::kFull) {
      const full::State& s = full_;
      return {.x_m = s.x_m,
              .y_m = s.y_m,
              .heading_rad = std::atan2(2.0 * (s.qx * s.qy + s.qw * s.qz), 1.0 - 2.0 * (s.qy * s.qy + s.qz * s.qz))};
    }
    if (o_.level == Level::kSingleTrack)
      return {.x_m = single_.x_m, .y_m = single_.y_m, .heading_rad = single_.yaw_rad};
    const double b = o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m;
    return {.x_m = flat_.x_m + b * std::cos(flat_.yaw_rad),
            .y_m = flat_.y_m + b * std::sin(flat_.yaw_rad),
            .heading_rad = flat_.yaw_rad};
  }
  // The path is that of the car's origin, as lanes are.
  double steered(double dt) {
    const LanePoint now = place_now();
    const double b = o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m;
    return driver_.steer_rad(now.x_m - b * std::cos(now.heading_rad), now.y_m - b * std::sin(now.heading_rad),
                             now.heading_rad, speed(), o_.vehicle.wheelbase_m,
                             o_.vehicle.max_steering_wheel_rad / o_.vehicle.steering_ratio, input_.steer_rad, dt);
  }

  // What was asked for beside the motion. `f`: nullptr at level kinematic.
  void on_demand(const full::Forces* f, Row& row) const {
    const bool whole = o_.level == Level::kFull;
    row.drive_nm = input_.drive_nm, row.brake_nm = input_.brake_nm;
    row.gear = given_torques_ || !o_.vehicle.engine ? 0.0 : power_.gear + 1.0;
    row.engine_rpm = power_.engine_radps * 30.0 / std::numbers::pi;
    row.steer_rad = input_.steer_rad, row.accelerator_01 = controls_.accelerator_01, row.brake_01 = controls_.brake_01;
    row.car_j = account_.car_j, row.engine_j = account_.engine_j, row.brakes_j = account_.brakes_j;
    row.tyres_j = account_.tyres_j, row.dampers_j = account_.dampers_j, row.air_j = account_.air_j;
    row.road_j = account_.road_j;
    if (!f) return;
    const full::Params& p = whole ? full_params_ : single_params_.car;
    const powertrain::Wheels wheels = whole ? full::wheels(full_params_, input_, full_) : powertrain::Wheels{};
    const double friction = whole ? 1.0 : single_track::held(single_params_, input_, single_, o_.step_s).friction;
    for (std::size_t i = 0; i < 4; ++i) {
      const double share = p.tyre_rate_npm / (p.tyre_rate_npm + p.spring_npm[i]);
      row.slip[i] = whole ? full_.kappa[i] : 0.0;
      row.slip_angle_rad[i] = std::atan(whole ? full_.tan_alpha[i] : (i < 2 ? single_.front_slip : single_.rear_slip));
      row.travel_m[i] =
          whole ? full_.travel_m[i]
                : share * (f->ground_m[i] - (single_.z_m - p.x_m[i] * single_.pitch + p.y_m[i] * single_.roll));
      row.camber_rad[i] = f->roll_rad - f->road_roll_rad;
      const double most = (whole ? wheels.peak_slip[i] / p.tyre.peak_kappa : friction) * f->load_n[i];
      if (most > 0.0)
        row.friction_used_01[i] =
            std::hypot(f->fx_n[i] / (most * p.tyre.p.long_peak), f->fy_n[i] / (most * p.tyre.p.lat_peak));
    }
  }

  // Heights that the inputs give, as the model takes them: full where its wheels are, the others a wheelbase and a
  // track apart on the map.
  std::array<double, 4> heights(Playhead& in, const Inputs& inputs, double time_s) const {
    in.go(time_s);
    std::array<double, 4> given{};
    for (std::size_t i = 0; i < 4; ++i) given[i] = in.linear(inputs.road_m[i]);
    return o_.level == Level::kFull ? given : on_the_map(given);
  }
  std::array<double, 4> on_the_map(const std::array<double, 4>& h) const {
    constexpr double kSteepest = 0.99;  // of a sine: what stands upright is no road
    const VehicleParams& v = o_.vehicle;
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
        const Driver::Pedals pedals = driver_.pedals(place_now().x_m, speed(), dt);
        controls_.accelerator_01 = controls_.brake_01 > 0.0 ? 0.0 : pedals.accelerator_01;
        controls_.brake_01 = std::max(controls_.brake_01, pedals.brake_01);  // the inputs' foot comes first
      }
      const powertrain::Wheels wheels = o_.level == Level::kFull
                                            ? full::wheels(full_params_, input_, full_)
                                            : powertrain::rolling(speed(), o_.vehicle.tyre_radius_m);
      return powertrain::advance(o_.vehicle, controls_, speed(), wheels, power_, dt);
    }
    powertrain::Torques out;
    for (std::size_t i = 0; i < 4; ++i) {
      const double torque = in.linear(inputs.torque_nm[i]);
      if (!inputs.brake_nm[i].empty()) {
        out.drive_nm[i] = torque, out.brake_nm[i] = in.linear(inputs.brake_nm[i]);
      } else {
        out.drive_nm[i] = std::max(torque, 0.0), out.brake_nm[i] = std::max(-torque, 0.0);
      }
      if (i >= 2) out.brake_nm[i] += powertrain::parking_nm(o_.vehicle, parking_01);
    }
    return out;
  }

  // This level has no tyres: torques that are given count up to what the car's own drive and brakes can give.
  void kinematic_step(const powertrain::Torques& torques, double dt) {
    kinematic::Push push = kinematic::push_of(o_.vehicle, torques);
    const double most =
        std::min(o_.vehicle.max_drive_force_n, o_.vehicle.max_power_w / std::max(std::abs(flat_.speed_mps), 0.1));
    if (given_torques_) {
      push.drive_n = std::clamp(push.drive_n, -most, most);
      push.brake_n = std::min(push.brake_n, o_.vehicle.max_brake_force_n);
    }
    const double before_mps = flat_.speed_mps;
    const CarState before = flat_;
    kinematic::advance(o_.vehicle, input_.steer_rad * o_.vehicle.steering_ratio, push, flat_, dt);
    if (o_.columns & kEnergy) energy::add(o_.vehicle, push, before, flat_, dt, account_);
    path_m_ += 0.5 * (before_mps + flat_.speed_mps) * std::cos(flat_.road_pitch_rad) * dt;
    std::array<double, 4> height = beside_;
    if (input_.heights_given) {
      for (std::size_t i = 0; i < 4; ++i) height[i] = input_.height_m[i] + input_.height_rate_mps[i] * dt;
    } else if (o_.road) {
      const auto points = kinematic::contact_points(o_.vehicle, flat_);
      for (std::size_t i = 0; i < 4; ++i)
        height[i] = o_.road
                        ->at(points[i].x, points[i].y, path_m_ + (i < 2 ? o_.vehicle.wheelbase_m : 0.0), i % 2 == 0,
                             beside_[i], &off_road_)
                        .z_m;
    }
    beside_ = height;
    kinematic::stand_on(o_.vehicle, height, flat_, dt);
  }

  // What the motion needs of wheels that this level does not have: weight and inertia at the centre of gravity, borne
  // by four contacts; side force by its share of the axles, all else as the loads.
  void kinematic_forces(Row& row) const {
    const VehicleParams& p = o_.vehicle;
    const CarState& s = flat_;
    const double b = p.wheelbase_m - p.cg_to_front_m, weight = p.mass_kg * kGravity_mps2 * std::cos(s.road_pitch_rad);
    const double felt_x = s.ax_mps2 - kGravity_mps2 * std::sin(s.road_pitch_rad);
    const double felt_y = s.ay_mps2 + kGravity_mps2 * std::cos(s.road_pitch_rad) * std::sin(s.road_roll_rad);
    const double drag = 0.5 * kAirDensity_kgpm3 * p.drag_area_m2 * s.speed_mps * std::abs(s.speed_mps);
    const double down = weight * std::cos(s.road_roll_rad), back = p.mass_kg * felt_x * p.cg_height_m / p.wheelbase_m;
    const double ahead = p.mass_kg * felt_x + drag, aside = p.mass_kg * felt_y;
    const double right = down > 0.0 ? aside * p.cg_height_m / p.track_m / down : 0.0;  // share that moves over
    for (std::size_t i = 0; i < 4; ++i) {
      const double axle = std::max(down * (i < 2 ? b : p.cg_to_front_m) / p.wheelbase_m + (i < 2 ? -back : back), 0.0);
      const double share = std::clamp(0.5 + (i % 2 == 0 ? -right : right), 0.0, 1.0);
      const double turned = i < 2 ? s.steer_rad : 0.0, c = std::cos(turned), sn = std::sin(turned);
      row.fz_n[i] = axle * share;
      const double x = ahead * row.fz_n[i] / down, y = aside * (i < 2 ? b : p.cg_to_front_m) / p.wheelbase_m * share;
      row.fx_n[i] = x * c + y * sn, row.fy_n[i] = y * c - x * sn;
    }
  }

  Options o_;
  full::Params full_params_;
  single_track::Params single_params_;
  full::Input input_;
  full::State full_;
  single_track::State single_;
  CarState flat_;
  powertrain::State power_;
  Controls controls_;
  Driver driver_;
  energy::Account account_;
  levelling::State lamps_;
  ReferenceIntegrator reference_;
  std::array<double, 4> beside_{};
  double path_m_ = 0.0;  // level kinematic: travelled by the rear axle
  double yaw_ = 0.0, road_pitch_ = 0.0, origin_z_ = 0.0, plane_z_ = 0.0;
  bool off_road_ = false, given_torques_ = false, burst_ = false;
  std::optional<double> rolled_over_s_;
  Status gave_up_ = Done{};
};

}  // namespace phare::batch
