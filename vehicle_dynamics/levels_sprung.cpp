// The levels whose body moves on springs: `single-track` and `full`.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/base/conventions.h"
#include "vehicle_dynamics/levels.h"

namespace phare {
namespace {

// What a state says of the car's motion that its forces do not.
struct Place {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double u_mps = 0.0, v_mps = 0.0;
  double speed_mps = 0.0;  // of the origin
  double rise_mps = 0.0;   // of the centre of gravity, in the world
};

// As the other levels show it: angles split into road and springs, origin under the rear axle.
Seen seen_of(const chassis::Params& p, const chassis::Input& in, const chassis::Forces& f, const Place& at,
             const glm::dmat3& body, double yaw_rad, double path_m) {
  const double b = -p.x_m[2], h = p.cg_height_m;
  Seen seen;
  seen.path_m = path_m, seen.off_road = f.off_road;
  CarState& s = seen.state;
  s.yaw_rad = yaw_rad;
  s.x_m = at.x_m - b * body[0].x - h * body[2].x;
  s.y_m = at.y_m - b * body[0].y - h * body[2].y;
  const double origin_z = at.z_m + h - b * body[0].z - h * body[2].z;
  s.z_m = 0.5 * (f.ground_m[2] + f.ground_m[3]);
  s.heave_m = origin_z - s.z_m;
  s.road_pitch_rad = f.road_pitch_rad, s.road_roll_rad = f.road_roll_rad;
  s.pitch_rad = f.pitch_rad - f.road_pitch_rad, s.roll_rad = f.roll_rad - f.road_roll_rad;
  s.pitch_rate_radps = f.pitch_rate_radps, s.roll_rate_radps = f.roll_rate_radps;  // of the body: the road's is in them
  s.speed_mps = at.speed_mps;
  seen.side_mps = at.v_mps - f.yaw_rate_radps * b;
  s.heave_rate_mps = at.rise_mps + f.pitch_rate_radps * b + s.speed_mps * std::sin(s.road_pitch_rad);
  s.steer_rad = in.steer_rad;
  s.ax_mps2 = f.ax_mps2, s.ay_mps2 = f.ay_mps2, s.yaw_rate_radps = f.yaw_rate_radps;
  s.contact_z_m = f.ground_m;
  for (std::size_t i = 0; i < 4; ++i)
    seen.least_load_share = std::min(seen.least_load_share, f.load_n[i] / p.load_n[i]);
  return seen;
}

double counted_on(double yaw_rad, double before_rad) {
  return before_rad + std::remainder(yaw_rad - before_rad, 2.0 * std::numbers::pi);
}

Motion motion_of(const chassis::Params& p, const chassis::Forces& f, const Place& at, double rise_mps) {
  const double b = -p.x_m[2], h = p.cg_height_m;
  return {.x_m = at.x_m,
          .y_m = at.y_m,
          .z_m = at.z_m,
          .u_mps = at.u_mps,
          .v_mps = at.v_mps,
          .rise_mps = rise_mps,
          .origin_z_m = at.z_m + h + b * std::sin(f.pitch_rad) - h * std::cos(f.pitch_rad) * std::cos(f.roll_rad),
          .plane_z_m = 0.5 * (f.ground_m[2] + f.ground_m[3]),
          .turns_wrapped = true,
          .forces = f};
}

// What another level shows, at the centre of gravity: where it is, and how it moves and turns.
struct Handed {
  double roll_rad = 0.0, pitch_rad = 0.0, roll_rate_radps = 0.0, pitch_rate_radps = 0.0;
  double p_radps = 0.0, q_radps = 0.0, r_radps = 0.0;   // about the body's axes
  glm::dmat3 body{1.0}, plane{1.0};                     // world from the body, from the road plane
  glm::dvec3 centre{0.0}, moving{0.0}, of_origin{0.0};  // moving: the origin in the world, of_origin: along the body
};
Handed handed(const chassis::Params& p, const Seen& seen) {
  const CarState& s = seen.state;
  Handed o;
  o.roll_rad = s.road_roll_rad + s.roll_rad, o.pitch_rad = s.road_pitch_rad + s.pitch_rad;
  o.body = world_from_car(o.roll_rad, o.pitch_rad, s.yaw_rad);
  const glm::dmat3& body = o.body;
  const double b = -p.x_m[2], h = p.cg_height_m, roll = o.roll_rad, pitch = o.pitch_rad;
  const glm::dvec3 origin(s.x_m, s.y_m, s.z_m + s.heave_m);
  o.centre = origin + body[0] * b + body[2] * h;

  // Rates about the body's axes from those of the angles (R = Rz Ry Rx).
  o.roll_rate_radps = s.road_roll_rate_radps + s.roll_rate_radps;
  o.pitch_rate_radps = s.road_pitch_rate_radps + s.pitch_rate_radps;
  o.p_radps = o.roll_rate_radps - s.yaw_rate_radps * std::sin(pitch);
  o.q_radps = o.pitch_rate_radps * std::cos(roll) + s.yaw_rate_radps * std::sin(roll) * std::cos(pitch);
  o.r_radps = s.yaw_rate_radps * std::cos(roll) * std::cos(pitch) - o.pitch_rate_radps * std::sin(roll);
  // The origin moves along the road plane and with the heave; the centre of gravity turns about it.
  o.plane = world_from_car(s.road_roll_rad, s.road_pitch_rad, s.yaw_rad);
  const glm::dvec3 moving =
      o.plane[0] * s.speed_mps + o.plane[1] * seen.side_mps + glm::dvec3(0.0, 0.0, s.heave_rate_mps);
  o.moving = moving;
  o.of_origin = glm::dvec3(moving.x * body[0].x + moving.y * body[0].y + moving.z * body[0].z,
                           moving.x * body[1].x + moving.y * body[1].y + moving.z * body[1].z,
                           moving.x * body[2].x + moving.y * body[2].y + moving.z * body[2].z);
  return o;
}

// Share of the friction ellipse that each wheel uses, of `most_n` at the peak.
void use_friction(const chassis::Params& p, const chassis::Forces& f, const std::array<double, 4>& most_n,
                  WheelFigures& out) {
  for (std::size_t i = 0; i < 4; ++i)
    if (most_n[i] > 0.0)
      out.friction_used_01[i] =
          std::hypot(f.fx_n[i] / (most_n[i] * p.tyre.p.long_peak), f.fy_n[i] / (most_n[i] * p.tyre.p.lat_peak));
}

}  // namespace

Result<SprungParams> SprungParams::of(const VehicleParams& vehicle, const std::string& place,
                                      const single_track::Options& options) {
  SprungParams car;
  Result<full::Params> full = full::params_of(vehicle, place);
  if (!full) return full.error();
  Result<single_track::Params> single = single_track::params_of(vehicle, options, place);
  if (!single) return single.error();
  car.full = *full;
  car.single_track = *single;
  return car;
}

// single-track

void SingleTrackLevel::begin(const CarParams& p, const Start& at) {
  state = single_track::at_rest(p.sprung->single_track, at.x_m, at.y_m, at.yaw_rad, at.speed_mps, at.height_m);
}

void SingleTrackLevel::take_over(const CarParams& p, const Seen& seen) {
  const chassis::Params& car = p.sprung->single_track.car;
  const CarState& s = seen.state;
  const double b = -car.x_m[2], h = car.cg_height_m;
  const Handed from = handed(car, seen);
  const double roll = from.roll_rad, pitch = from.pitch_rad;
  single_track::State t;
  t.x_m = from.centre.x, t.y_m = from.centre.y, t.yaw_rad = s.yaw_rad, t.path_m = seen.path_m;
  t.u_mps = s.speed_mps, t.v_mps = seen.side_mps + s.yaw_rate_radps * b, t.r_radps = s.yaw_rate_radps;
  t.pitch = std::tan(pitch), t.roll = std::tan(roll) / std::cos(pitch);
  t.z_m = from.centre.z - h;
  t.pitch_rate_ps = from.pitch_rate_radps * (1.0 + t.pitch * t.pitch),
  t.roll_rate_ps = from.roll_rate_radps / (std::cos(roll) * std::cos(roll) * std::cos(pitch));
  t.z_rate_mps = from.moving.z - from.q_radps * b;
  if (std::abs(t.u_mps) > 0.5) {
    const double carried = std::abs(t.u_mps);
    t.front_slip = -(t.v_mps + car.x_m[0] * t.r_radps - t.u_mps * std::tan(s.steer_rad)) / carried;
    t.rear_slip = -(t.v_mps + car.x_m[2] * t.r_radps) / carried;
  }
  state = t;
}

bool SingleTrackLevel::stand(const CarParams& p, const chassis::Input& in) {
  return single_track::stand(p.sprung->single_track, in, state);
}

void SingleTrackLevel::advance(const CarParams& p, const chassis::Input& in, double dt) {
  single_track::advance(p.sprung->single_track, in, state, dt);
}

Seen SingleTrackLevel::seen(const CarParams& p, const chassis::Input& in, double yaw_before_rad) const {
  const chassis::Forces f = single_track::forces(p.sprung->single_track, in, state);
  const double yaw = counted_on(f.yaw_rad, yaw_before_rad);
  const Place at{state.x_m, state.y_m, state.z_m, state.u_mps, state.v_mps, state.u_mps, state.z_rate_mps};
  return seen_of(p.sprung->single_track.car, in, f, at, world_from_car(f.roll_rad, f.pitch_rad, yaw), yaw,
                 state.path_m);
}

Motion SingleTrackLevel::motion(const CarParams& p, const chassis::Input& in) const {
  const chassis::Forces f = single_track::forces(p.sprung->single_track, in, state);
  const Place at{.x_m = state.x_m, .y_m = state.y_m, .z_m = state.z_m, .u_mps = state.u_mps, .v_mps = state.v_mps};
  Motion m = motion_of(p.sprung->single_track.car, f, at, state.z_rate_mps);
  m.spin_radps.fill(state.u_mps / p.vehicle.tyre_radius_m);
  return m;
}

WheelFigures SingleTrackLevel::figures(const CarParams& params, const chassis::Input& in, const chassis::Forces& f,
                                       double dt) const {
  const single_track::Params& p = params.sprung->single_track;
  const double friction = single_track::held(p, in, state, dt).friction;
  WheelFigures out;
  std::array<double, 4> most_n{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = p.car.tyre_rate_npm / (p.car.tyre_rate_npm + p.car.spring_npm[i]);
    out.slip_angle_rad[i] = std::atan(i < 2 ? state.front_slip : state.rear_slip);
    out.travel_m[i] = share * (f.ground_m[i] - (state.z_m - p.car.x_m[i] * state.pitch + p.car.y_m[i] * state.roll));
    out.camber_rad[i] = f.roll_rad - f.road_roll_rad;
    most_n[i] = friction * f.load_n[i];
  }
  use_friction(p.car, f, most_n, out);
  return out;
}

LanePoint SingleTrackLevel::place(const CarParams&) const {
  return {.x_m = state.x_m, .y_m = state.y_m, .heading_rad = state.yaw_rad};
}

powertrain::Wheels SingleTrackLevel::wheels(const CarParams& p, const chassis::Input&) const {
  return powertrain::rolling(state.u_mps, p.vehicle.tyre_radius_m);
}

energy::Account SingleTrackLevel::open_account(const CarParams& p, const chassis::Input& in) const {
  return energy::open(p.sprung->single_track, in, state);
}

void SingleTrackLevel::account(const CarParams& p, const chassis::Input& in, const SingleTrackLevel& before, double dt,
                               energy::Account& to) const {
  energy::add(p.sprung->single_track, in, before.state, state, dt, to);
}

bool SingleTrackLevel::sound() const {
  constexpr double kSteepest = 100.0;
  return all_finite(state) && a_car_could(state.u_mps, state.v_mps, state.z_rate_mps) &&
         std::abs(state.pitch) < kSteepest && std::abs(state.roll) < kSteepest;
}

// full

void FullLevel::begin(const CarParams& p, const Start& at) {
  state = full::at_rest(p.sprung->full, at.x_m, at.y_m, at.yaw_rad, at.speed_mps, at.height_m);
}

void FullLevel::take_over(const CarParams& params, const Seen& seen) {
  const full::Params& p = params.sprung->full;
  const CarState& s = seen.state;
  const double b = -p.x_m[2], h = p.cg_height_m;
  const Handed from = handed(p, seen);
  const double roll = from.roll_rad, pitch = from.pitch_rad;
  full::State f;
  f.x_m = from.centre.x, f.y_m = from.centre.y, f.z_m = from.centre.z - h;
  const double cr = std::cos(0.5 * roll), sr = std::sin(0.5 * roll), cp = std::cos(0.5 * pitch),
               sp = std::sin(0.5 * pitch), cy = std::cos(0.5 * s.yaw_rad), sy = std::sin(0.5 * s.yaw_rad);
  f.qw = cr * cp * cy + sr * sp * sy, f.qx = sr * cp * cy - cr * sp * sy;
  f.qy = cr * sp * cy + sr * cp * sy, f.qz = cr * cp * sy - sr * sp * cy;
  f.path_m = seen.path_m;
  f.u_mps = from.of_origin.x, f.v_mps = from.of_origin.y + from.r_radps * b,
  f.w_mps = from.of_origin.z - from.q_radps * b;
  f.p_radps = from.p_radps, f.q_radps = from.q_radps, f.r_radps = from.r_radps;
  const double carried = std::max(std::abs(f.u_mps), 0.5);
  for (std::size_t i = 0; i < 4; ++i) {
    // Spring and tyre in series share what the corner has been lifted from rest.
    const double up = p.radius_m - h;
    const double wheel_z = from.centre.z + from.body[0].z * p.x_m[i] + from.body[1].z * p.y_m[i] + from.body[2].z * up;
    const double lift = (wheel_z - s.contact_z_m[i]) * from.plane[2].z - p.radius_m;
    f.travel_m[i] = -lift * p.tyre_rate_npm / (p.spring_npm[i] + p.tyre_rate_npm);
    f.rise_mps[i] = f.w_mps - f.q_radps * p.x_m[i] + f.p_radps * p.y_m[i];
    f.spin_radps[i] = f.u_mps / p.radius_m;
    // The side force the car is in, at steady slip.
    const double steer = i < 2 ? s.steer_rad : 0.0;
    const double aside = f.v_mps + f.r_radps * p.x_m[i] - f.u_mps * std::tan(steer);
    f.tan_alpha[i] = std::abs(s.speed_mps) > 0.5 ? -aside / carried : 0.0;
  }
  state = f;
}

bool FullLevel::stand(const CarParams& p, const chassis::Input& in) {
  return full::stand(p.sprung->full, in, state);
}

void FullLevel::advance(const CarParams& p, const chassis::Input& in, double dt) {
  full::advance(p.sprung->full, in, state, dt);
}

Seen FullLevel::seen(const CarParams& p, const chassis::Input& in, double yaw_before_rad) const {
  const chassis::Forces f = full::forces(p.sprung->full, in, state);
  const double yaw = counted_on(f.yaw_rad, yaw_before_rad);
  const glm::dmat3 body = world_from_car(f.roll_rad, f.pitch_rad, yaw);
  const Place at{.x_m = state.x_m,
                 .y_m = state.y_m,
                 .z_m = state.z_m,
                 .u_mps = state.u_mps,
                 .v_mps = state.v_mps,
                 .speed_mps = state.u_mps - f.pitch_rate_radps * p.sprung->full.cg_height_m,
                 .rise_mps = body[0].z * state.u_mps + body[1].z * state.v_mps + body[2].z * state.w_mps};
  return seen_of(p.sprung->full, in, f, at, body, yaw, state.path_m);
}

Motion FullLevel::motion(const CarParams& p, const chassis::Input& in) const {
  const chassis::Forces f = full::forces(p.sprung->full, in, state);
  const Place at{.x_m = state.x_m, .y_m = state.y_m, .z_m = state.z_m, .u_mps = state.u_mps, .v_mps = state.v_mps};
  Motion m = motion_of(p.sprung->full, f, at, state.w_mps);
  m.spin_radps = state.spin_radps;
  return m;
}

WheelFigures FullLevel::figures(const CarParams& params, const chassis::Input& in, const chassis::Forces& f,
                                double) const {
  const full::Params& p = params.sprung->full;
  const powertrain::Wheels turning = full::wheels(p, in, state);
  WheelFigures out{.slip = state.kappa, .travel_m = state.travel_m};
  std::array<double, 4> most_n{};
  for (std::size_t i = 0; i < 4; ++i) {
    out.slip_angle_rad[i] = std::atan(state.tan_alpha[i]);
    out.camber_rad[i] = f.roll_rad - f.road_roll_rad;
    most_n[i] = turning.peak_slip[i] / p.tyre.peak_kappa * f.load_n[i];
  }
  use_friction(p, f, most_n, out);
  return out;
}

LanePoint FullLevel::place(const CarParams&) const {
  const full::State& s = state;
  return {.x_m = s.x_m,
          .y_m = s.y_m,
          .heading_rad = std::atan2(2.0 * (s.qx * s.qy + s.qw * s.qz), 1.0 - 2.0 * (s.qy * s.qy + s.qz * s.qz))};
}

powertrain::Wheels FullLevel::wheels(const CarParams& p, const chassis::Input& in) const {
  return full::wheels(p.sprung->full, in, state);
}

energy::Account FullLevel::open_account(const CarParams& p, const chassis::Input& in) const {
  return energy::open(p.sprung->full, in, state);
}

void FullLevel::account(const CarParams& p, const chassis::Input& in, const FullLevel& before, double dt,
                        energy::Account& to) const {
  energy::add(p.sprung->full, in, before.state, state, dt, to);
}

bool FullLevel::sound() const {
  return all_finite(state) && a_car_could(state.u_mps, state.v_mps, state.w_mps);
}

static_assert(CarLevel<SingleTrackLevel> && CarLevel<FullLevel>);

}  // namespace phare
