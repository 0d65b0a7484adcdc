#include "vehicle_dynamics/batch.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "config/conventions.h"
#include "vehicle_dynamics/models/kinematic.h"
#include "vehicle_dynamics/models/powertrain.h"

namespace phare::batch {
namespace {

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
  double held(const std::vector<double>& column) const {
    return column.empty() ? 0.0 : column[share_ >= 1.0 ? std::min(row_ + 1, column.size() - 1) : row_];
  }

 private:
  const Inputs& in_;
  std::size_t row_ = 0;
  double share_ = 0.0;
};

// A car of any level behind one face, for this loop only.
class Car {
 public:
  Car(const Options& o, bool resistance) : o_(o) {
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
      Result<single_track::Params> p = single_track::params_of(o_.vehicle, o_.single_track, o_.vehicle_place);
      if (!p) return p.error();
      single_params_ = *p;
      single_params_.integrator = o_.integrator;
      single_track::set_step(single_params_, o_.step_s);
    }
    return Done{};
  }

  void place(const std::array<double, 4>* given) {
    const double b = o_.vehicle.wheelbase_m - o_.vehicle.cg_to_front_m;
    std::array<double, 4> height{};
    if (given) {
      height = *given;
      input_.heights_given = true;
      input_.height_m = height;
    } else if (o_.road) {
      bool off = false;
      for (std::size_t i = 0; i < 4; ++i) {
        const double x = o_.start_x_m + (i < 2 ? o_.vehicle.cg_to_front_m : -b),
                     y = (i % 2 == 0 ? 0.5 : -0.5) * o_.vehicle.track_m;
        height[i] = o_.road->at(x, y, x, i % 2 == 0, 0.0, &off).z_m;
      }
    }
    full_ = full::at_rest(full_params_, o_.start_x_m, 0.0, 0.0, o_.speed_mps, height);
    single_ = single_track::at_rest(single_params_, o_.start_x_m, 0.0, 0.0, o_.speed_mps, height);
    flat_.x_m = o_.start_x_m - b;
    flat_.speed_mps = o_.speed_mps;
    kinematic::stand_on(o_.vehicle, height, flat_, 0.0);
    beside_ = height;
  }

  // Inputs over the step [time, time + dt]: heights linear, the rest at its middle.
  void step(Playhead& in, const Inputs& inputs, double time_s, double dt) {
    if (!inputs.road_m[0].empty()) {
      in.go(time_s);
      for (std::size_t i = 0; i < 4; ++i) input_.height_m[i] = in.linear(inputs.road_m[i]);
      in.go(time_s + dt);
      for (std::size_t i = 0; i < 4; ++i)
        input_.height_rate_mps[i] = (in.linear(inputs.road_m[i]) - input_.height_m[i]) / dt;
    } else {
      input_.height_m = beside_;
    }
    in.go(time_s + 0.5 * dt);
    input_.steer_rad = in.linear(inputs.steer_rad);
    Controls controls;
    controls.steering_wheel_rad = input_.steer_rad * o_.vehicle.steering_ratio;
    controls.gear = static_cast<Gear>(static_cast<int>(in.held(inputs.gear)));
    const bool pedals = !inputs.accelerator_01.empty();
    if (pedals) {
      controls.accelerator_01 = in.linear(inputs.accelerator_01);
      controls.brake_01 = in.linear(inputs.brake_01);
    }
    const double parking = in.linear(inputs.parking_01);
    const double speed = this->speed();
    if (o_.level == Level::kKinematic) {
      kinematic_step(in, inputs, controls, pedals, dt);
      return;
    }
    if (pedals) {
      const auto torque =
          powertrain::advance(o_.vehicle, controls, parking, speed, spins(), o_.level == Level::kFull, power_, dt);
      input_.drive_nm = torque.drive_nm, input_.brake_nm = torque.brake_nm;
    } else {
      for (std::size_t i = 0; i < 4; ++i) {
        const double torque = in.linear(inputs.torque_nm[i]);
        input_.drive_nm[i] = std::max(torque, 0.0), input_.brake_nm[i] = std::max(-torque, 0.0);
      }
    }
    if (o_.level == Level::kFull) {
      if (o_.integrator == Integrator::kReference)
        gave_up_ |= !reference_.advance(full_params_, input_, full_, dt);
      else
        full::advance(full_params_, input_, full_, dt);
    } else {
      if (o_.integrator == Integrator::kReference)
        gave_up_ |= !reference_.advance(single_params_, input_, single_, dt);
      else
        single_track::advance(single_params_, input_, single_, dt);
    }
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
    row.yaw_rad = yaw_ += std::remainder(f.yaw_rad - yaw_, 2.0 * std::numbers::pi);
    row.roll_rate_radps = f.roll_rate_radps, row.pitch_rate_radps = f.pitch_rate_radps,
    row.yaw_rate_radps = f.yaw_rate_radps;
    row.vx_mps = whole ? full_.u_mps : single_.u_mps, row.vy_mps = whole ? full_.v_mps : single_.v_mps;
    row.ax_mps2 = f.ax_mps2, row.ay_mps2 = f.ay_mps2;
    row.spin_radps = spins();
    row.fz_n = f.load_n, row.fx_n = f.fx_n, row.fy_n = f.fy_n;
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
  bool gave_up() const { return gave_up_; }

 private:
  void kinematic_step(const Playhead& in, const Inputs& inputs, Controls controls, bool pedals, double dt) {
    if (!pedals) {
      double force = 0.0;
      for (const auto& torque : inputs.torque_nm) force += in.linear(torque) / o_.vehicle.tyre_radius_m;
      const double most =
          std::min(o_.vehicle.max_drive_force_n, o_.vehicle.max_power_w / std::max(std::abs(flat_.speed_mps), 0.1));
      controls.accelerator_01 = std::clamp(force / most, 0.0, 1.0);
      controls.brake_01 = std::clamp(-force / o_.vehicle.max_brake_force_n, 0.0, 1.0);
    }
    kinematic::advance(o_.vehicle, controls, flat_, dt);
    std::array<double, 4> height = beside_;
    if (input_.heights_given) {
      for (std::size_t i = 0; i < 4; ++i) height[i] = input_.height_m[i] + input_.height_rate_mps[i] * dt;
    } else if (o_.road) {
      const auto points = kinematic::contact_points(o_.vehicle, flat_);
      const double path = flat_.x_m;
      for (std::size_t i = 0; i < 4; ++i)
        height[i] = o_.road
                        ->at(points[i].x, points[i].y, path + (i < 2 ? o_.vehicle.wheelbase_m : 0.0), i % 2 == 0,
                             beside_[i], &off_road_)
                        .z_m;
    }
    beside_ = height;
    kinematic::stand_on(o_.vehicle, height, flat_, dt);
  }

  Options o_;
  full::Params full_params_;
  single_track::Params single_params_;
  full::Input input_;
  full::State full_;
  single_track::State single_;
  CarState flat_;
  powertrain::State power_;
  levelling::State lamps_;
  ReferenceIntegrator reference_;
  std::array<double, 4> beside_{};
  double yaw_ = 0.0, road_pitch_ = 0.0, origin_z_ = 0.0, plane_z_ = 0.0;
  bool off_road_ = false, gave_up_ = false;
};

Row between(const Row& a, const Row& b, double u) {
  static_assert(sizeof(Row) == 33 * sizeof(double), "a row is doubles only");
  Row out;
  const auto *pa = &a.time_s, *pb = &b.time_s;
  auto* po = &out.time_s;
  for (std::size_t i = 0; i < sizeof(Row) / sizeof(double); ++i) po[i] = pa[i] + u * (pb[i] - pa[i]);
  return out;
}

}  // namespace

Result<Summary> run(const Options& options, const Inputs& inputs, const std::function<void(const Row&)>& each) {
  const bool torques = inputs.accelerator_01.empty();
  Summary summary;
  summary.resistance = options.resistance == Resistance::kOn || (options.resistance == Resistance::kAuto && !torques);
  Car car(options, summary.resistance);
  if (Status ready = car.prepare(); !ready) return ready.error();
  Playhead in(inputs);
  std::array<double, 4> first{};
  if (!inputs.road_m[0].empty())
    for (std::size_t i = 0; i < 4; ++i) first[i] = inputs.road_m[i].front();
  car.place(inputs.road_m[0].empty() ? nullptr : &first);

  const double start = inputs.time_s.front(), end = inputs.time_s.back(), dt = options.step_s;
  const auto steps = static_cast<std::uint64_t>(std::llround(std::ceil((end - start) / dt - 1e-6)));
  const double every = 1.0 / options.output_hz;
  const LevellingParams& lamps = options.vehicle.levelling;
  // Rows cost about as much as a step: they are worked out where one is due, or where the lamps follow the car.
  const bool every_step = options.levelling != levelling::Kind::kNone || (options.road && options.road->mesh);
  // Rows are handed on by the thousand, so that what is done with them, writing above all, is not taken for the model's
  // time.
  std::vector<Row> waiting;
  waiting.reserve(1024);
  std::chrono::steady_clock::duration elsewhere{};
  const auto hand_on = [&] {
    const auto left = std::chrono::steady_clock::now();
    for (const Row& row : waiting) each(row);
    waiting.clear();
    elsewhere += std::chrono::steady_clock::now() - left;
  };
  Row before = car.row(start, 0.0);
  car.lamps(lamps, in.held(inputs.levelling_step), dt, before);
  waiting.push_back(before);
  summary.rows = 1;
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t n = 0; n < steps; ++n) {
    const double from = start + static_cast<double>(n) * dt, to = start + static_cast<double>(n + 1) * dt;
    const auto due = [&] { return start + static_cast<double>(summary.rows) * every; };
    const bool reached = due() <= to + 1e-9 * every && due() <= end + 1e-6 * every;
    if (reached && !every_step && due() < to - 1e-9) {
      before = car.row(from, 0.0);
      car.lamps(lamps, 0.0, dt, before);
    }
    car.step(in, inputs, from, dt);
    if (!reached && !every_step) continue;
    Row now = car.row(to, dt);
    car.lamps(lamps, in.held(inputs.levelling_step), dt, now);
    for (; due() <= to + 1e-9 * every && due() <= end + 1e-6 * every; ++summary.rows) {
      const double time = due();
      Row out = std::abs(time - to) < 1e-9 ? now : between(before, now, (time - from) / dt);
      out.time_s = time;
      waiting.push_back(out);
      if (waiting.size() == waiting.capacity()) hand_on();
    }
    before = now;
  }
  hand_on();
  summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin - elsewhere).count();
  summary.steps = steps;
  summary.simulated_s = static_cast<double>(steps) * dt;
  summary.state_hash = car.hash();
  summary.off_road = car.off_road();
  summary.gave_up = car.gave_up();
  return summary;
}

std::string header() {
  std::string text =
      "time_s,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,roll_rate_radps,pitch_rate_radps,yaw_rate_radps,vx_mps,vy_mps,"
      "ax_mps2,ay_mps2";
  for (const auto& [name, unit] : {std::pair{"spin", "radps"}, {"fz", "n"}, {"fx", "n"}, {"fy", "n"}})
    for (const char* wheel : {"fl", "fr", "rl", "rr"}) text += std::string(",") + name + "_" + wheel + "_" + unit;
  return text + ",cutoff_25m_m,cutoff_25m_z_m,lamp_tilt_rad";
}

void print(const Row& row, std::FILE* file) {
  constexpr std::size_t kCount = sizeof(Row) / sizeof(double), kMostPerNumber = 26;  // -2.2250738585072014e-308,
  const double* values = &row.time_s;
  std::array<char, kCount * kMostPerNumber> line;
  char* at = line.data();
  for (std::size_t i = 0; i < kCount; ++i) {
    at = std::to_chars(at, line.data() + line.size(), values[i]).ptr;
    *at++ = i + 1 < kCount ? ',' : '\n';
  }
  std::fwrite(line.data(), 1, static_cast<std::size_t>(at - line.data()), file);
}

}  // namespace phare::batch
