// The car of a batch run: any level behind one face, and the inputs that drive it. For batch.cpp only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "config/base/conventions.h"
#include "vehicle_dynamics/auto_level.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/batch_playhead.h"
#include "vehicle_dynamics/models/air.h"
#include "vehicle_dynamics/models/energy.h"
#include "vehicle_dynamics/models/kinematic.h"
#include "vehicle_dynamics/models/powertrain.h"

namespace phare::batch {

// A car of any level behind one face, for this loop only.
class Car {
 public:
  Car(const Options& o, bool resistance, bool given_torques)
      : o_(o),
        level_(o.level == Level::kAuto ? Level::kKinematic : o.level),
        driver_(o.driver),
        given_torques_(given_torques) {
    if (!resistance) o_.vehicle.drag_area_m2 = o_.vehicle.rolling_coefficient = 0.0;
    input_.air_and_rolling = resistance;
    input_.road = o.road;
  }

  Status prepare() {
    if (o_.relaxation_scale && o_.vehicle.chassis) {
      o_.vehicle.chassis->tyre.long_relaxation_m *= *o_.relaxation_scale;
      o_.vehicle.chassis->tyre.lat_relaxation_m *= *o_.relaxation_scale;
    }
    const bool any = o_.level == Level::kAuto;
    if (any) {
      Result<SprungCar> sprung = SprungCar::of(o_.vehicle, o_.vehicle_place);
      if (!sprung) return sprung.error();
      hand_over_.emplace(std::move(*sprung));
    }
    if (any || level_ == Level::kFull) {
      Result<full::Params> p = full::params_of(o_.vehicle, o_.vehicle_place);
      if (!p) return p.error();
      full_params_ = *p;
      full_params_.integrator = any ? integrator_of(Level::kFull) : o_.integrator;
    }
    if (any || level_ == Level::kSingleTrack) {
      // Where forces hold the body is worked out after a step, not integrated: SUNDIALS would leave it where it was.
      if (o_.integrator == Integrator::kReference && !o_.single_track.dynamic_attitude)
        return Error{"--attitude quasi-static",
                     "is no motion to integrate; it does not go with --integrator reference"};
      Result<single_track::Params> p = single_track::params_of(o_.vehicle, o_.single_track, o_.vehicle_place);
      if (!p) return p.error();
      single_params_ = *p;
      single_params_.integrator = any ? integrator_of(Level::kSingleTrack) : o_.integrator;
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
      input_.height_m = level_ == Level::kFull ? *given : height;
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
    lamps_ = levelling::settled(o_.vehicle.levelling, o_.levelling, o_.vehicle.rest.pitch_rad);
    if (o_.columns & kEnergy) open_account();
    return Done{};
  }

  // Of a car that stands: where the first row's foot and road hold it. After place().
  void stand(Playhead& in, const Inputs& inputs, double dt) {
    if (o_.speed_mps != 0.0) return;
    in.go(inputs.time_s.front());
    input_.steer_rad = in.linear(inputs.steer_rad);
    const Driver driver = driver_;  // its memory begins with the first step
    torques_of(in, inputs, dt);     // for the pedals
    power_ = powertrain::standing(o_.vehicle, controls_);
    if (hand_over_) choose_level(0.0);
    powertrain::Torques torques = torques_of(in, inputs, dt);
    power_ = powertrain::standing(o_.vehicle, controls_);
    driver_ = driver;
    if (!given_torques_) torques.drive_nm.fill(0.0);
    input_.drive_nm = torques.drive_nm, input_.brake_nm = torques.brake_nm;
    if (level_ == Level::kFull) {
      full::stand(full_params_, input_, full_);
    } else if (level_ == Level::kSingleTrack) {
      single_track::stand(single_params_, input_, single_);
    } else {
      kinematic::stand(o_.vehicle, kinematic::push_of(o_.vehicle, torques), flat_);
    }
    if (o_.columns & kEnergy) open_account();
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
    if (hand_over_) choose_level(dt);
    if (o_.driver.path.empty())
      input_.steer_rad = in.linear(inputs.steer_rad);
    else
      input_.steer_rad = steered(dt);
    const powertrain::Torques torques = torques_of(in, inputs, dt);
    input_.drive_nm = torques.drive_nm, input_.brake_nm = torques.brake_nm;
    if (level_ == Level::kKinematic) {
      kinematic_step(torques, dt);
      return true;
    }
    if (o_.integrator == Integrator::kReference) {
      gave_up_ = level_ == Level::kFull ? reference_.advance(full_params_, input_, full_, dt)
                                        : reference_.advance(single_params_, input_, single_, dt);
      return gave_up_.ok();
    }
    const full::State full_before = full_;
    const single_track::State single_before = single_;
    if (level_ == Level::kFull)
      full::advance(full_params_, input_, full_, dt);
    else
      single_track::advance(single_params_, input_, single_, dt);
    if (o_.columns & kEnergy) {
      if (level_ == Level::kFull)
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
    if (level_ == Level::kFull)
      return finite(&full_.x_m, full::kStateSize) && possible(full_.u_mps, full_.v_mps, full_.w_mps);
    if (level_ == Level::kSingleTrack)
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
    row.level = level_ == Level::kFull ? 2.0 : level_ == Level::kSingleTrack ? 1.0 : 0.0;
    full::Input now = input_;  // heights at the end of the step
    for (std::size_t i = 0; i < 4; ++i)
      if (now.heights_given) now.height_m[i] += now.height_rate_mps[i] * dt;
    const double b = o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m, h = o_.vehicle.cg_height_m;
    if (level_ == Level::kKinematic) {
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
      add_rest(row);
      return row;
    }
    const bool whole = level_ == Level::kFull;
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

  double speed() const {
    return level_ == Level::kFull ? full_.u_mps : level_ == Level::kSingleTrack ? single_.u_mps : flat_.speed_mps;
  }
  std::array<double, 4> spins() const {
    if (level_ == Level::kFull) return full_.spin_radps;
    std::array<double, 4> spin;
    spin.fill(speed() / o_.vehicle.tyre_radius_m);
    return spin;
  }
  std::uint64_t hash() const {
    return level_ == Level::kFull          ? state_hash(full_)
           : level_ == Level::kSingleTrack ? state_hash(single_)
                                           : state_hash(flat_);
  }
  bool off_road() const { return off_road_; }
  const AutoLevel& choice() const { return auto_; }
  const std::optional<double>& rolled_over_s() const { return rolled_over_s_; }
  bool burst() const { return burst_; }
  const Status& gave_up() const { return gave_up_; }

 private:
  // Level auto: as the loop of a live run does it, from what the car is seen to do.
  void choose_level(double dt) {
    constexpr std::array<Level, 3> kRungs{Level::kKinematic, Level::kSingleTrack, Level::kFull};
    const double b = o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m;
    const bool sprung = level_ != Level::kKinematic;
    if (sprung) hand_over_->look(model_of(level_), full_, single_, input_);
    const CarState seen = sprung ? hand_over_->state() : flat_;
    const double path = sprung ? hand_over_->path_m() : path_m_ + b;
    static const Road kLevelRoad;
    const Situation situation = situation_of(o_.vehicle, seen, controls_, o_.road ? *o_.road : kLevelRoad, path,
                                             sprung ? hand_over_->least_load_share() : 1.0);
    const Level level = kRungs[static_cast<std::size_t>(auto_.next(situation, dt).rung)];
    if (level == level_) return;
    if (level == Level::kKinematic) {
      flat_ = seen, path_m_ = path - b, beside_ = seen.contact_z_m;
    } else {
      hand_over_->take_over(model_of(level), seen, path, sprung ? hand_over_->side_speed_mps() : 0.0);
      const SprungCar::Memory begun = hand_over_->memory();
      full_ = begun.full, single_ = begun.single;
    }
    level_ = level;
  }
  static SprungCar::Model model_of(Level level) {
    return level == Level::kFull ? SprungCar::Model::kFull : SprungCar::Model::kSingleTrack;
  }

  void open_account() {
    account_ = level_ == Level::kFull          ? energy::open(full_params_, input_, full_)
               : level_ == Level::kSingleTrack ? energy::open(single_params_, input_, single_)
                                               : energy::open(o_.vehicle, flat_);
  }

  double row_speed(bool whole) const {
    return whole ? std::hypot(full_.u_mps, full_.v_mps) : std::hypot(single_.u_mps, single_.v_mps);
  }

  // The centre of gravity's place on the map, and the heading.
  LanePoint place_now() const {
    if (level_ == Level::kFull) {
      const full::State& s = full_;
      return {.x_m = s.x_m,
              .y_m = s.y_m,
              .heading_rad = std::atan2(2.0 * (s.qx * s.qy + s.qw * s.qz), 1.0 - 2.0 * (s.qy * s.qy + s.qz * s.qz))};
    }
    if (level_ == Level::kSingleTrack) return {.x_m = single_.x_m, .y_m = single_.y_m, .heading_rad = single_.yaw_rad};
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

  // The models count from where the car rests with its load.
  void add_rest(Row& row) {
    const RestAttitude& rest = o_.vehicle.rest;
    row.pitch_rad += rest.pitch_rad;
    row.z_m += rest.heave_m - (o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m) * rest.pitch_rad;
    origin_z_ += rest.heave_m;
  }

  // What was asked for beside the motion. `f`: nullptr at level kinematic.
  void on_demand(const full::Forces* f, Row& row) const {
    const bool whole = level_ == Level::kFull;
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
    return level_ == Level::kFull ? given : on_the_map(given);
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
      const powertrain::Wheels wheels = level_ == Level::kFull ? full::wheels(full_params_, input_, full_)
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
  Level level_;  ///< that runs: of auto the one chosen
  AutoLevel auto_;
  std::optional<SprungCar> hand_over_;  ///< level auto: from one model to the other
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
