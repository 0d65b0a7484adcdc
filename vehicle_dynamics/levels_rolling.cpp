// The levels whose wheels do not slip: a recorded drive, and `kinematic`.
#include <algorithm>
#include <cmath>

#include "config/base/conventions.h"
#include "vehicle_dynamics/levels.h"
#include "vehicle_dynamics/models/air.h"

namespace phare {

Seen PoseLevel::seen(const CarParams& p, const chassis::Input&, double) const {
  return {.state = from_message(p.track.at(time), 1.0, 1.0), .time = time};
}

LanePoint PoseLevel::place(const CarParams& p) const {
  return KinematicLevel{seen(p, {}, 0.0).state}.place(p);
}

double PoseLevel::speed_mps(const CarParams& p) const {
  return p.track.at(time).speed_mps;
}

powertrain::Wheels PoseLevel::wheels(const CarParams& p, const chassis::Input&) const {
  return powertrain::rolling(speed_mps(p), std::max(p.vehicle.tyre_radius_m, 0.1));
}

Motion PoseLevel::motion(const CarParams& p, const chassis::Input& in) const {
  return KinematicLevel{seen(p, in, 0.0).state}.motion(p, in);
}

namespace {

double to_rear_m(const VehicleParams& v) {
  return v.wheelbase_m - v.cg_to_front_m;
}

// The way under the axles, from what is counted as `footing` says.
struct Ahead {
  double centre_m = 0.0, front_m = 0.0, rear_m = 0.0;
};
Ahead ahead_of(const CarParams& p) {
  const VehicleParams& v = p.vehicle;
  if (p.footing == Footing::kBatch) return {to_rear_m(v), v.wheelbase_m, 0.0};
  return {0.0, v.cg_to_front_m, v.cg_to_front_m - v.wheelbase_m};
}

// Torques that are given count up to what the car's own drive and brakes can give, as this level has no tyres.
kinematic::Push push_of(const CarParams& p, const chassis::Input& in, double speed_mps) {
  const VehicleParams& v = p.vehicle;
  kinematic::Push push = kinematic::push_of(v, in.drive_nm, in.brake_nm);
  if (!p.torques_given) return push;
  const double most = std::min(v.max_drive_force_n, v.max_power_w / std::max(std::abs(speed_mps), 0.1));
  push.drive_n = std::clamp(push.drive_n, -most, most);
  push.brake_n = std::min(push.brake_n, v.max_brake_force_n);
  return push;
}

}  // namespace

void KinematicLevel::begin(const CarParams& p, const Start& start) {
  const double b = to_rear_m(p.vehicle);
  way_m = start.x_m - ahead_of(p).centre_m;
  state.x_m = start.x_m - b * std::cos(start.yaw_rad), state.y_m = start.y_m - b * std::sin(start.yaw_rad);
  state.yaw_rad = start.yaw_rad;
  state.speed_mps = start.speed_mps;
  kinematic::stand_on(p.vehicle, start.height_m, state, 0.0);
}

void KinematicLevel::take_over(const CarParams& p, const Seen& seen) {
  state = seen.state;
  way_m = seen.path_m - ahead_of(p).centre_m;
}

bool KinematicLevel::stand(const CarParams& p, const chassis::Input& in) {
  kinematic::stand(p.vehicle, kinematic::push_of(p.vehicle, in.drive_nm, in.brake_nm), state);
  return true;
}

void KinematicLevel::advance(const CarParams& p, const chassis::Input& in, double dt) {
  const double before_mps = state.speed_mps;
  kinematic::advance(p.vehicle, in.steering_wheel_rad, push_of(p, in, before_mps), state, dt);
  if (p.footing == Footing::kBatch) way_m += 0.5 * (before_mps + state.speed_mps) * std::cos(state.road_pitch_rad) * dt;
  place_on_road(p, in, dt);
  if (p.footing == Footing::kLive) way_m += state.speed_mps * std::cos(state.road_pitch_rad) * dt;
}

namespace {

// Under the wheels: front left, front right, rear left, rear right; the way is that of the axles.
using Heights = std::array<double, 4>;
using Points = std::array<glm::dvec2, 4>;

// What lies on the road along the way, which is asked for once an axle.
Heights laid_on(const Road& road, double front_m, double rear_m) {
  const Two front = road.laid(front_m).z_m, rear = road.laid(rear_m).z_m;
  return {front[0], front[1], rear[0], rear[1]};
}

// Beside the surface a wheel keeps its last height, raised or lowered with the wheels that do stand on something. A
// plane without anything on it is where the car began: its wheels are beside the road.
void live_heights(const Road& road, const Points& points, double front_m, double rear_m, Heights& height,
                  bool& off_road) {
  const bool nowhere = !road.mesh && road.profiles.empty();
  std::array<bool, 4> beside{nowhere, nowhere, nowhere, nowhere};
  double moved = 0.0;
  int count = 0;
  const Heights laid = laid_on(road, front_m, rear_m);
  for (std::size_t i = 0; i < 4 && !nowhere; ++i) {
    const double z = road.base_m(points[i].x, points[i].y, height[i], &beside[i]) + laid[i];
    if (beside[i]) continue;
    moved += z - height[i];
    height[i] = z;
    ++count;
  }
  off_road |= count < 4;
  for (std::size_t i = 0; i < 4 && count > 0; ++i)
    if (beside[i]) height[i] += moved / count;
}

void batch_heights(const Road& road, const Points& points, double front_m, double rear_m, Heights& height,
                   bool& off_road) {
  const Heights laid = laid_on(road, front_m, rear_m);
  for (std::size_t i = 0; i < 4; ++i) {
    bool beside = false;
    const double z = road.base_m(points[i].x, points[i].y, height[i], &beside) + laid[i];
    if (!beside) height[i] = z;
    off_road |= beside;
  }
}

}  // namespace

void KinematicLevel::place_on_road(const CarParams& p, const chassis::Input& in, double dt) {
  Heights height = state.contact_z_m;
  if (in.heights_given) {
    for (std::size_t i = 0; i < 4; ++i) height[i] = in.height_m[i] + in.height_rate_mps[i] * dt;
  } else if (in.road) {
    const Points points = kinematic::contact_points(p.vehicle, state);
    const Ahead ahead = ahead_of(p);
    const double front = way_m + ahead.front_m, rear = way_m + ahead.rear_m;
    const auto put = p.footing == Footing::kLive ? live_heights : batch_heights;
    put(*in.road, points, front, rear, height, off_road);
  }
  kinematic::stand_on(p.vehicle, height, state, dt);
}

Seen KinematicLevel::seen(const CarParams& p, const chassis::Input&, double) const {
  return {.state = state, .time = {}, .path_m = way_m + ahead_of(p).centre_m, .off_road = off_road};
}

LanePoint KinematicLevel::place(const CarParams& p) const {
  const double b = to_rear_m(p.vehicle);
  return {.x_m = state.x_m + b * std::cos(state.yaw_rad),
          .y_m = state.y_m + b * std::sin(state.yaw_rad),
          .heading_rad = state.yaw_rad};
}

powertrain::Wheels KinematicLevel::wheels(const CarParams& p, const chassis::Input&) const {
  return powertrain::rolling(state.speed_mps, p.vehicle.tyre_radius_m);
}

namespace {

// What the motion needs of wheels that this level does not have: weight and inertia at the centre of gravity, borne by
// four contacts; side force by its share of the axles, all else as the loads.
void share_forces(const VehicleParams& p, const CarState& s, chassis::Forces& f) {
  const double b = to_rear_m(p), weight = p.mass_kg * kGravity_mps2 * std::cos(s.road_pitch_rad);
  const double felt_x = s.ax_mps2 - kGravity_mps2 * std::sin(s.road_pitch_rad);
  const double felt_y = s.ay_mps2 + kGravity_mps2 * std::cos(s.road_pitch_rad) * std::sin(s.road_roll_rad);
  const double drag = drag_n(p.drag_area_m2, s.speed_mps);
  const double down = weight * std::cos(s.road_roll_rad), back = p.mass_kg * felt_x * p.cg_height_m / p.wheelbase_m;
  const double ahead = p.mass_kg * felt_x + drag, aside = p.mass_kg * felt_y;
  const double right = down > 0.0 ? aside * p.cg_height_m / p.track_m / down : 0.0;  // share that moves over
  for (std::size_t i = 0; i < 4; ++i) {
    const double axle = std::max(down * (i < 2 ? b : p.cg_to_front_m) / p.wheelbase_m + (i < 2 ? -back : back), 0.0);
    const double share = std::clamp(0.5 + (i % 2 == 0 ? -right : right), 0.0, 1.0);
    const double turned = i < 2 ? s.steer_rad : 0.0, c = std::cos(turned), sn = std::sin(turned);
    f.load_n[i] = axle * share;
    const double x = ahead * f.load_n[i] / down, y = aside * (i < 2 ? b : p.cg_to_front_m) / p.wheelbase_m * share;
    f.fx_n[i] = x * c + y * sn, f.fy_n[i] = y * c - x * sn;
  }
}

}  // namespace

Motion KinematicLevel::motion(const CarParams& p, const chassis::Input&) const {
  const double b = to_rear_m(p.vehicle);
  const CarState& s = state;
  const LanePoint at = place(p);
  Motion m;
  chassis::Forces& f = m.forces;
  m.x_m = at.x_m, m.y_m = at.y_m;
  f.pitch_rad = s.road_pitch_rad + s.pitch_rad, f.roll_rad = s.road_roll_rad + s.roll_rad, f.yaw_rad = s.yaw_rad;
  m.z_m = s.z_m + s.heave_m - b * std::sin(f.pitch_rad);
  f.roll_rate_radps = s.road_roll_rate_radps + s.roll_rate_radps;
  f.pitch_rate_radps = s.road_pitch_rate_radps + s.pitch_rate_radps;
  f.yaw_rate_radps = s.yaw_rate_radps;
  m.u_mps = s.speed_mps, m.v_mps = s.yaw_rate_radps * b;
  f.ax_mps2 = s.ax_mps2, f.ay_mps2 = s.ay_mps2;
  m.spin_radps.fill(s.speed_mps / p.vehicle.tyre_radius_m);
  share_forces(p.vehicle, s, f);
  f.road_pitch_rad = s.road_pitch_rad, f.road_roll_rad = s.road_roll_rad;
  f.ground_m = s.contact_z_m, f.off_road = off_road;
  m.origin_z_m = s.z_m + s.heave_m, m.plane_z_m = s.z_m;
  return m;
}

energy::Account KinematicLevel::open_account(const CarParams& p, const chassis::Input&) const {
  return energy::open(p.vehicle, state);
}

void KinematicLevel::account(const CarParams& p, const chassis::Input& in, const KinematicLevel& before, double dt,
                             energy::Account& to) const {
  energy::add(p.vehicle, push_of(p, in, before.state.speed_mps), before.state, state, dt, to);
}

bool KinematicLevel::sound() const {
  return all_finite(state) && a_car_could(state.speed_mps, state.heave_rate_mps, 0.0);
}

static_assert(CarLevel<PoseLevel> && CarLevel<KinematicLevel>);

}  // namespace phare
