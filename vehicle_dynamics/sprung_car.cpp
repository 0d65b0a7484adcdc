#include "vehicle_dynamics/sprung_car.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/base/conventions.h"

namespace phare {
namespace {
constexpr double kMaxSteeringWheelRate_radps = 1000.0 * std::numbers::pi / 180.0;  // as level kinematic
}  // namespace

Result<SprungCar> SprungCar::of(const VehicleParams& vehicle, const std::string& place) {
  SprungCar car;
  car.vehicle_ = vehicle;
  Result<full::Params> full = full::params_of(vehicle, place);
  if (!full) return full.error();
  Result<single_track::Params> single = single_track::params_of(vehicle, {}, place);
  if (!single) return single.error();
  car.full_params_ = *full;
  car.single_params_ = *single;
  return car;
}

void SprungCar::set_integrator(Integrator integrator) {
  full_params_.integrator = single_params_.integrator = integrator;
}

std::uint64_t SprungCar::hash() const {
  return model_ == Model::kFull ? state_hash(full_) : state_hash(single_);
}

void SprungCar::take_over(Model model, const CarState& s, double path_m, double side_mps) {
  const full::Params& p = full_params_;
  model_ = model;
  side_mps_ = side_mps;
  input_.height_m = s.contact_z_m;
  input_.steer_rad = s.steer_rad;
  shown_ = s;
  const double roll = s.road_roll_rad + s.roll_rad, pitch = s.road_pitch_rad + s.pitch_rad;
  const glm::dmat3 body = world_from_car(roll, pitch, s.yaw_rad);
  const double b = -p.x_m[2], h = p.cg_height_m;
  const glm::dvec3 origin(s.x_m, s.y_m, s.z_m + s.heave_m);
  const glm::dvec3 centre = origin + body[0] * b + body[2] * h;

  // Rates about the body's axes from those of the angles (R = Rz Ry Rx).
  const double roll_rate = s.road_roll_rate_radps + s.roll_rate_radps,
               pitch_rate = s.road_pitch_rate_radps + s.pitch_rate_radps;
  const double p_rate = roll_rate - s.yaw_rate_radps * std::sin(pitch);
  const double q_rate = pitch_rate * std::cos(roll) + s.yaw_rate_radps * std::sin(roll) * std::cos(pitch);
  const double r_rate = s.yaw_rate_radps * std::cos(roll) * std::cos(pitch) - pitch_rate * std::sin(roll);
  // The origin moves along the road plane and with the heave; the centre of gravity turns about it.
  const glm::dmat3 plane = world_from_car(s.road_roll_rad, s.road_pitch_rad, s.yaw_rad);
  const glm::dvec3 moving = plane[0] * s.speed_mps + plane[1] * side_mps_ + glm::dvec3(0.0, 0.0, s.heave_rate_mps);
  const glm::dvec3 of_origin(moving.x * body[0].x + moving.y * body[0].y + moving.z * body[0].z,
                             moving.x * body[1].x + moving.y * body[1].y + moving.z * body[1].z,
                             moving.x * body[2].x + moving.y * body[2].y + moving.z * body[2].z);

  if (model == Model::kFull) {
    full::State f;
    f.x_m = centre.x, f.y_m = centre.y, f.z_m = centre.z - h;
    const double cr = std::cos(0.5 * roll), sr = std::sin(0.5 * roll), cp = std::cos(0.5 * pitch),
                 sp = std::sin(0.5 * pitch), cy = std::cos(0.5 * s.yaw_rad), sy = std::sin(0.5 * s.yaw_rad);
    f.qw = cr * cp * cy + sr * sp * sy, f.qx = sr * cp * cy - cr * sp * sy;
    f.qy = cr * sp * cy + sr * cp * sy, f.qz = cr * cp * sy - sr * sp * cy;
    f.path_m = path_m;
    f.u_mps = of_origin.x, f.v_mps = of_origin.y + r_rate * b, f.w_mps = of_origin.z - q_rate * b;
    f.p_radps = p_rate, f.q_radps = q_rate, f.r_radps = r_rate;
    const double carried = std::max(std::abs(f.u_mps), 0.5);
    for (std::size_t i = 0; i < 4; ++i) {
      // Spring and tyre in series share what the corner has been lifted from rest.
      const double up = p.radius_m - h;
      const double wheel_z = centre.z + body[0].z * p.x_m[i] + body[1].z * p.y_m[i] + body[2].z * up;
      const double lift = (wheel_z - s.contact_z_m[i]) * plane[2].z - p.radius_m;
      f.travel_m[i] = -lift * p.tyre_rate_npm / (p.spring_npm[i] + p.tyre_rate_npm);
      f.rise_mps[i] = f.w_mps - f.q_radps * p.x_m[i] + f.p_radps * p.y_m[i];
      f.spin_radps[i] = f.u_mps / p.radius_m;
      // The side force the car is in, at steady slip.
      const double steer = i < 2 ? s.steer_rad : 0.0;
      const double aside = f.v_mps + f.r_radps * p.x_m[i] - f.u_mps * std::tan(steer);
      f.tan_alpha[i] = std::abs(s.speed_mps) > 0.5 ? -aside / carried : 0.0;
    }
    full_ = f;
  } else {
    single_track::State t;
    t.x_m = centre.x, t.y_m = centre.y, t.yaw_rad = s.yaw_rad, t.path_m = path_m;
    t.u_mps = s.speed_mps, t.v_mps = side_mps_ + s.yaw_rate_radps * b, t.r_radps = s.yaw_rate_radps;
    t.pitch = std::tan(pitch), t.roll = std::tan(roll) / std::cos(pitch);
    t.z_m = centre.z - h;
    t.pitch_rate_ps = pitch_rate * (1.0 + t.pitch * t.pitch),
    t.roll_rate_ps = roll_rate / (std::cos(roll) * std::cos(roll) * std::cos(pitch));
    t.z_rate_mps = moving.z - q_rate * b;
    if (std::abs(t.u_mps) > 0.5) {
      const double carried = std::abs(t.u_mps);
      t.front_slip = -(t.v_mps + p.x_m[0] * t.r_radps - t.u_mps * std::tan(s.steer_rad)) / carried;
      t.rear_slip = -(t.v_mps + p.x_m[2] * t.r_radps) / carried;
    }
    single_ = t;
  }
}

void SprungCar::look(Model model, const full::State& full, const single_track::State& single,
                     const full::Input& input) {
  model_ = model, full_ = full, single_ = single, input_ = input;
  show();
}

void SprungCar::stand(const powertrain::Torques& torques, const Road& road) {
  input_.road = &road;
  input_.drive_nm = torques.drive_nm, input_.brake_nm = torques.brake_nm;
  if (model_ == Model::kFull)
    full::stand(full_params_, input_, full_);
  else
    single_track::stand(single_params_, input_, single_);
  show();
}

powertrain::Wheels SprungCar::wheels(const Road& road) {
  input_.road = &road;
  return model_ == Model::kFull ? full::wheels(full_params_, input_, full_)
                                : powertrain::rolling(single_.u_mps, vehicle_.tyre_radius_m);
}

void SprungCar::advance(double steering_wheel_rad, const powertrain::Torques& torques, const Road& road, double dt) {
  const double wheel =
      std::clamp(steering_wheel_rad, -vehicle_.max_steering_wheel_rad, vehicle_.max_steering_wheel_rad);
  const double most = kMaxSteeringWheelRate_radps / vehicle_.steering_ratio * dt;
  input_.steer_rad += std::clamp(wheel / vehicle_.steering_ratio - input_.steer_rad, -most, most);
  input_.road = &road;
  input_.drive_nm = torques.drive_nm, input_.brake_nm = torques.brake_nm;
  const bool whole = model_ == Model::kFull;
  if (whole) {
    full::advance(full_params_, input_, full_, dt);
  } else {
    single_track::set_step(single_params_, dt);
    single_track::advance(single_params_, input_, single_, dt);
  }
  show();
}

void SprungCar::show() {
  const full::Params& p = full_params_;
  const bool whole = model_ == Model::kFull;
  const full::Forces f = whole ? full::forces(p, input_, full_) : single_track::forces(single_params_, input_, single_);
  input_.height_m = f.ground_m;  // beside the road a wheel keeps its last height
  off_road_ = f.off_road;
  const double b = -p.x_m[2], h = p.cg_height_m;
  CarState s;
  s.yaw_rad = shown_.yaw_rad + std::remainder(f.yaw_rad - shown_.yaw_rad, 2.0 * std::numbers::pi);
  const glm::dmat3 body = world_from_car(f.roll_rad, f.pitch_rad, s.yaw_rad);
  const double x = whole ? full_.x_m : single_.x_m, y = whole ? full_.y_m : single_.y_m,
               z = (whole ? full_.z_m : single_.z_m) + h;
  s.x_m = x - b * body[0].x - h * body[2].x;
  s.y_m = y - b * body[0].y - h * body[2].y;
  const double origin_z = z - b * body[0].z - h * body[2].z;
  s.z_m = 0.5 * (f.ground_m[2] + f.ground_m[3]);
  s.heave_m = origin_z - s.z_m;
  s.road_pitch_rad = f.road_pitch_rad, s.road_roll_rad = f.road_roll_rad;
  s.pitch_rad = f.pitch_rad - f.road_pitch_rad, s.roll_rad = f.roll_rad - f.road_roll_rad;
  s.pitch_rate_radps = f.pitch_rate_radps, s.roll_rate_radps = f.roll_rate_radps;  // of the body: the road's is in them
  const double u = whole ? full_.u_mps : single_.u_mps, v = whole ? full_.v_mps : single_.v_mps;
  const double q = f.pitch_rate_radps, r = f.yaw_rate_radps;
  s.speed_mps = whole ? u - q * h : u;
  side_mps_ = v - r * b;
  const double vz =
      whole ? body[0].z * u + body[1].z * v + body[2].z * full_.w_mps + q * b : single_.z_rate_mps + q * b;
  s.heave_rate_mps = vz + s.speed_mps * std::sin(s.road_pitch_rad);
  s.steer_rad = input_.steer_rad;
  s.ax_mps2 = f.ax_mps2, s.ay_mps2 = f.ay_mps2, s.yaw_rate_radps = f.yaw_rate_radps;
  s.contact_z_m = f.ground_m;
  least_load_share_ = 1.0;
  for (std::size_t i = 0; i < 4; ++i) least_load_share_ = std::min(least_load_share_, f.load_n[i] / p.load_n[i]);
  shown_ = s;
}

SprungCar::Memory SprungCar::memory() const {
  Memory memory{model_, full_, single_, input_, shown_, side_mps_, least_load_share_, off_road_};
  memory.input.road = nullptr;
  return memory;
}

void SprungCar::recall(const Memory& memory) {
  model_ = memory.model;
  full_ = memory.full;
  single_ = memory.single;
  input_ = memory.input;
  shown_ = memory.shown;
  side_mps_ = memory.side_mps, least_load_share_ = memory.least_load_share;
  off_road_ = memory.off_road;
}

}  // namespace phare
