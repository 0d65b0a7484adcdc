#include "vehicle_dynamics/models/kinematic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/base/conventions.h"
#include "config/base/two.h"
#include "vehicle_dynamics/models/air.h"

namespace phare::kinematic {
namespace {

double sign(double value) {
  return value > 0.0 ? 1.0 : (value < 0.0 ? -1.0 : 0.0);
}

// The plane under the car, asked for once a step.
struct Slopes {
  double pitch_sine, pitch_cosine, roll_sine;
};
Slopes slopes_of(const CarState& s) {
  const SineCosine road = sine_cosine(Two{s.road_pitch_rad, s.road_roll_rad});
  return {road.sine[0], road.cosine[0], road.sine[1]};
}

// Speed after dt. Brakes and rolling resistance only ever oppose the motion: they stop the car at exactly 0 and hold it
// there.
double next_speed_mps(const VehicleParams& p, const Push& wheels, const Slopes& road, const CarState& s, double dt) {
  const double v = s.speed_mps;
  const double drag = drag_n(p.drag_area_m2, v);
  const double push = wheels.drive_n + p.mass_kg * kGravity_mps2 * road.pitch_sine - drag;
  const double hold = wheels.brake_n + p.rolling_coefficient * p.mass_kg * kGravity_mps2 * road.pitch_cosine;
  const double inertia = p.mass_kg + 4.0 * p.wheel_inertia_kgm2 / (p.tyre_radius_m * p.tyre_radius_m);

  if (v == 0.0) return std::abs(push) <= hold ? 0.0 : (push - sign(push) * hold) / inertia * dt;
  const double next = v + (push - sign(v) * hold) / inertia * dt;
  return next * v < 0.0 ? 0.0 : next;
}

// x'' = w^2 (target - x) - 2 zeta w x' over a step, exactly for a target that is held: no step is too long.
struct Approach {
  double from_x = 1.0, from_v = 0.0;  ///< distance from the target after the step, from distance and rate before
  double rate_from_x = 0.0, rate_from_v = 1.0;

  Approach(double w, double zeta, double dt) {
    const double inside = w * w * (1.0 - zeta * zeta), root = std::sqrt(std::abs(inside)),
                 decay = std::exp(-zeta * w * dt);
    const double c = inside > 0.0 ? std::cos(root * dt) : std::cosh(root * dt);
    const double s = root * dt < 1e-9 ? dt : (inside > 0.0 ? std::sin(root * dt) : std::sinh(root * dt)) / root;
    from_x = decay * (c + zeta * w * s), from_v = decay * s;
    rate_from_x = -decay * w * w * s, rate_from_v = decay * (c - zeta * w * s);
  }
  void operator()(double& value, double& rate, double target) const {
    constexpr double kSettled = 1e-9;  // rad or m, and per second: far below the 0.02 mrad that a beam shows
    const double away = value - target, before = rate;
    if (std::abs(away) < kSettled && std::abs(rate) < kSettled) {
      value = target;
      rate = 0.0;
      return;
    }
    value = target + from_x * away + from_v * before;
    rate = rate_from_x * away + rate_from_v * before;
  }
};

// A drive steps by one length: what follows from it alone is worked out once.
const Approach& approach_of(const VehicleParams& p, double dt) {
  struct Known {
    double frequency_hz, damping, dt_s;
    Approach approach;
  };
  const auto known = [&] {
    return Known{p.ride_frequency_hz, p.ride_damping, dt,
                 Approach(2.0 * std::numbers::pi * p.ride_frequency_hz, p.ride_damping, dt)};
  };
  thread_local Known last = known();
  if (last.frequency_hz != p.ride_frequency_hz || last.damping != p.ride_damping || last.dt_s != dt) last = known();
  return last.approach;
}

}  // namespace

Attitude quasi_static_attitude(const VehicleParams& p, double fx_mps2, double fy_mps2) {
  const auto in_series = [&p](double spring) { return spring * p.tyre_rate_npm / (spring + p.tyre_rate_npm); };
  const double transfer_n = -p.mass_kg * fx_mps2 * p.cg_height_m / p.wheelbase_m;  // onto the front axle under braking
  const double front_share = transfer_n > 0.0 ? 1.0 - p.anti_dive_01 : 1.0;
  const double front_m = -transfer_n * front_share / (2.0 * in_series(p.front_rate_npm));
  const double rear_m = transfer_n / (2.0 * in_series(p.rear_rate_npm));
  const double toppling = p.sprung_mass_kg * p.cg_height_m;
  return {.pitch_rad = (rear_m - front_m) / p.wheelbase_m,
          .roll_rad = toppling * fy_mps2 / (p.roll_stiffness_nmprad - toppling * kGravity_mps2),
          .heave_m = rear_m};
}

Push push_of(const VehicleParams& p, const std::array<double, 4>& drive_nm, const std::array<double, 4>& brake_nm) {
  return {.drive_n = (drive_nm[0] + drive_nm[1] + drive_nm[2] + drive_nm[3]) / p.tyre_radius_m,
          .brake_n = (brake_nm[0] + brake_nm[1] + brake_nm[2] + brake_nm[3]) / p.tyre_radius_m};
}

double pushed_n(const VehicleParams& p, const CarState& s) {
  const double v = s.speed_mps, weight = p.mass_kg * kGravity_mps2;
  const double inertia = p.mass_kg + 4.0 * p.wheel_inertia_kgm2 / (p.tyre_radius_m * p.tyre_radius_m);
  return inertia * s.ax_mps2 - weight * std::sin(s.road_pitch_rad) + drag_n(p.drag_area_m2, v) +
         sign(v) * p.rolling_coefficient * weight * std::cos(s.road_pitch_rad);
}

namespace {

// What is felt in the car: acceleration less gravity along the road plane.
Attitude attitude_of(const VehicleParams& p, const Slopes& road, const CarState& s) {
  const double fx = s.ax_mps2 - kGravity_mps2 * road.pitch_sine;
  const double fy = s.ay_mps2 + kGravity_mps2 * road.pitch_cosine * road.roll_sine;
  return quasi_static_attitude(p, fx, fy);
}

}  // namespace

void stand(const VehicleParams& p, const Push& push, CarState& s) {
  constexpr double kMoment_s = 1e-3;
  const Slopes road = slopes_of(s);
  s.ax_mps2 = next_speed_mps(p, push, road, s, kMoment_s) / kMoment_s;
  const Attitude rest = attitude_of(p, road, s);
  s.pitch_rad = rest.pitch_rad, s.roll_rad = rest.roll_rad, s.heave_m = rest.heave_m;
  s.pitch_rate_radps = s.roll_rate_radps = s.heave_rate_mps = 0.0;
}

void advance(const VehicleParams& p, double steering_wheel_rad, const Push& push, CarState& s, double dt) {
  // steer: lock and rate are those of the steering wheel
  const double wheel = std::clamp(steering_wheel_rad, -p.max_steering_wheel_rad, p.max_steering_wheel_rad);
  const double most = kMaxSteeringWheelRate_radps / p.steering_ratio * dt;
  s.steer_rad += std::clamp(wheel / p.steering_ratio - s.steer_rad, -most, most);

  // speed
  const Slopes road = slopes_of(s);
  const double before = s.speed_mps;
  s.speed_mps = next_speed_mps(p, push, road, s, dt);
  s.ax_mps2 = (s.speed_mps - before) / dt;
  const double v = 0.5 * (before + s.speed_mps);

  // path: an arc of constant curvature, its chord exact
  double curvature = std::tan(s.steer_rad) / p.wheelbase_m;
  const double grip = p.max_lateral_mps2 / std::max(v * v, 1e-6);
  curvature = std::clamp(curvature, -grip, grip);
  const double turned = v * curvature * dt;
  const double half = 0.5 * turned;
  const SineCosine course = sine_cosine(Two{s.yaw_rad + half, half});
  const double chord = v * dt * (std::abs(half) < 1e-9 ? 1.0 : course.sine[1] / half) * road.pitch_cosine;
  s.x_m += chord * course.cosine[0];
  s.y_m += chord * course.sine[0];
  s.yaw_rad += turned;
  s.yaw_rate_radps = s.speed_mps * curvature;
  s.ay_mps2 = s.speed_mps * s.yaw_rate_radps;

  // attitude
  const Attitude target = attitude_of(p, road, s);
  const Approach& approach = approach_of(p, dt);
  approach(s.pitch_rad, s.pitch_rate_radps, target.pitch_rad);
  approach(s.roll_rad, s.roll_rate_radps, target.roll_rad);
  approach(s.heave_m, s.heave_rate_mps, target.heave_m);
}

std::array<glm::dvec2, 4> contact_points(const VehicleParams& p, const CarState& s) {
  const SineCosine yaw = sine_cosine(both(s.yaw_rad));
  const glm::dvec2 forward(yaw.cosine[0], yaw.sine[0]), left(-forward.y, forward.x);
  const glm::dvec2 rear(s.x_m, s.y_m);
  const glm::dvec2 front = rear + p.wheelbase_m * forward, side = 0.5 * p.track_m * left;
  return {front + side, front - side, rear + side, rear - side};
}

void stand_on(const VehicleParams& p, const std::array<double, 4>& h, CarState& s, double dt) {
  const double front = 0.5 * (h[0] + h[1]), rear = 0.5 * (h[2] + h[3]);
  const double left = 0.5 * (h[0] + h[2]), right = 0.5 * (h[1] + h[3]);
  const double rise = (front - rear) / p.wheelbase_m;
  // Roll turns about the pitched x axis, hence its cosine: R = Rz·Ry·Rx then puts the car's z on the plane's normal.
  const Two angles = arctangent(Two{rise, (left - right) / p.track_m / std::sqrt(1.0 + rise * rise)});
  const double pitch = -angles[0], roll = angles[1];
  s.road_pitch_rate_radps = dt > 0.0 ? (pitch - s.road_pitch_rad) / dt : 0.0;
  s.road_roll_rate_radps = dt > 0.0 ? (roll - s.road_roll_rad) / dt : 0.0;
  s.road_pitch_rad = pitch;
  s.road_roll_rad = roll;
  s.z_m = rear;
  s.contact_z_m = h;
}

}  // namespace phare::kinematic
