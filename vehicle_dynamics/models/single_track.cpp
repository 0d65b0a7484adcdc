#include "vehicle_dynamics/models/single_track.h"

#include <algorithm>
#include <cmath>

#include "config/base/conventions.h"
#include "vehicle_dynamics/models/air.h"
#include "vehicle_dynamics/models/single_track_parts.h"

namespace phare::single_track {
namespace {

constexpr double kRollingKnee_mps = 0.05;  // rolling resistance turns its sign smoothly

double sign(double value) {
  return value > 0.0 ? 1.0 : (value < 0.0 ? -1.0 : 0.0);
}

// Attitude is kept as slopes: on a steep plane an angle more is a larger step of slope, d tan = (1 + tan2) d angle.
double steep(double slope) {
  return 1.0 + slope * slope;
}

// One over the root of 1 + q: by its series where that is exact to the last bit, on all but steep roads.
double per_root(double q) {
  return q < 1e-4 ? 1.0 - q * (0.5 - q * (0.375 - q * 0.3125)) : 1.0 / std::sqrt(1.0 + q);
}

}  // namespace

Grip grip(const Params& p, const Held& held, const State& s) {
  const tyre::Constants& tyre = p.car.tyre;
  const Two slip{s.front_slip, s.rear_slip};
  if (!p.options.magic_formula)
    return {tyre.p.lat_stiffness * slip, both(tyre.p.lat_stiffness), slip, std::numeric_limits<double>::infinity()};
  const tyre::SideForce force = tyre::side_force(tyre, slip, held.friction);
  return {force.share, force.rise, slip, held.friction * tyre.p.lat_peak};
}

namespace {

// A wheel pair of the body: what its springs and dampers carry, and what the road under it adds.
struct Corners {
  Two load_n;       // of the tyres, left and right; below 0 they would hang on the road
  Two from_road_n;  // on the body, beside what answers to the body's own place
};
[[gnu::always_inline]] inline Corners corners(const Params& p, const Axle& axle, const Under& road, double rest_n,
                                              double leaning, double dt_s, const State& s, double t_s) {
  const double damper = p.options.dynamic_attitude ? axle.damper_nspm : 0.0;
  const Two y{axle.half_track_m, -axle.half_track_m};
  const Two height = road.height_m + t_s * (road.rate_mps + (t_s - dt_s) * road.bend_mps2);
  const Two rate = road.rate_mps + (2.0 * t_s - dt_s) * road.bend_mps2;
  const Two from_road = axle.spring_npm * height + damper * rate;
  const Two from_body = axle.spring_npm * (s.z_m - axle.x_m * s.pitch + y * s.roll) +
                        damper * (s.z_rate_mps - axle.x_m * s.pitch_rate_ps + y * s.roll_rate_ps);
  const double bar = axle.bar_n * leaning;
  return {rest_n + from_road - from_body - Two{bar, -bar}, from_road};
}

// No tyre hangs on the road; what those that would do not give, the others do not have: together they carry what the
// body's motion says.
[[gnu::always_inline]] inline void lift(Corners& front, Corners& rear) {
  const Two held_front = largest(front.load_n, Two{}), held_rear = largest(rear.load_n, Two{});
  const Two all = front.load_n + rear.load_n, held = held_front + held_rear;
  const double hangs = (held[0] + held[1]) - (all[0] + all[1]);
  if (hangs <= 0.0) return;
  const double share = std::max(all[0] + all[1], 0.0) / (held[0] + held[1] + 1e-9);
  front.load_n = share * held_front, rear.load_n = share * held_rear;
}

}  // namespace

Acting acting(const Params& p, const Held& held, Two share, const State& s, double t_s) {
  constexpr double kDampedBelow_mps = 2.0, kPerFullDamping_n = 1.0 / 2700.0;  // carcass damping, as in level full
  const chassis::Params& car = p.car;

  // body over its contacts
  const double across = held.across + held.across_rate_ps * t_s, leaning = s.roll - across;
  Corners front = corners(p, p.axles[0], held.front, car.load_n[0] * held.level, leaning, held.dt_s, s, t_s);
  Corners rear = corners(p, p.axles[1], held.rear, car.load_n[2] * held.level, leaning, held.dt_s, s, t_s);
  lift(front, rear);
  const Two load{front.load_n[0] + front.load_n[1], rear.load_n[0] + rear.load_n[1]};

  // along: torque over radius up to the limit of friction
  const double along_limit = held.friction * car.tyre.p.long_peak;
  const Two grip = along_limit * load, limit = held.reach * grip;
  const Two ahead = least(largest(Two{held.front_push_n, held.rear_push_n}, -limit), limit);
  const double resisted = held.drag_kgpm * s.u_mps * std::abs(s.u_mps) + held.rolling * (load[0] + load[1]);

  // across: what slip gives, less where the friction is used along; at walking pace the carcass' damping
  const double vf = s.v_mps + car.x_m[0] * s.r_radps, vr = s.v_mps + car.x_m[2] * s.r_radps;
  const Two vx{s.u_mps * held.cosine + vf * held.sine, s.u_mps}, vy{vf * held.cosine - s.u_mps * held.sine, vr};
  const auto slip = tyre::side_slip_rate(car.tyre, Two{s.front_slip, s.rear_slip}, vx, vy, held.most_slip_pm);
  Two for_side = load;  // the load whose friction is left for the side
  if ((ahead[0] != 0.0 || ahead[1] != 0.0) && p.options.magic_formula) {
    const Two left_over = largest(grip * grip - ahead * ahead, Two{});
    for_side = 1.0 / along_limit * Two{std::sqrt(left_over[0]), std::sqrt(left_over[1])};
  }
  Two side = share * for_side;
  const Two fade = largest(1.0 - largest(magnitude(vx), magnitude(vy)) / kDampedBelow_mps, Two{});
  if (fade[0] > 0.0 || fade[1] > 0.0) {
    side += car.tyre.p.carcass_damping_nspm * kPerFullDamping_n * fade * load * slip.stretch_mps;
    const Two most = held.friction * car.tyre.p.lat_peak * for_side;
    if (p.options.magic_formula) side = least(largest(side, -most), most);
  }
  const double front_y = side[0], rear_y = side[1];

  // the car in the plane: what torque leaves for it after spinning up its own wheels
  const double downhill_n = -car.mass_kg * kGravity_mps2 * held.along * held.level;
  const double pull = ahead[0] * held.cosine - front_y * held.sine + ahead[1] - resisted + downhill_n;
  // The wheels' spin answers to the speed's own change alone, not to what the car's turning makes of it.
  const double spin_kg = p.effective_kg - car.mass_kg, turning = s.r_radps * s.v_mps;
  const double ax = held.stopped ? 0.0 : (pull - spin_kg * turning) * p.per_effective_kg;
  const Two pulls = least(largest(ahead - both(0.5 * spin_kg * (ax + turning)), -grip), grip);
  const double front_x = pulls[0], rear_x = pulls[1];
  // Aside acts what torque gives: the wheels' spin is counted along the car, where its energy is (effective_kg).
  const double front_side = held.stopped ? front_y * held.cosine : ahead[0] * held.sine + front_y * held.cosine;
  const double fx = held.stopped ? -downhill_n : front_x * held.cosine - front_y * held.sine + rear_x;
  const double fy = front_side + rear_y, felt = fy * p.per_mass_kg;
  const double ay = felt - kGravity_mps2 * held.bank * held.level;

  // the body: what the road lifts it by, the linkage's share, the way along a plane that rises, and the lever of the
  // centre of gravity
  const double front_n = front.from_road_n[0] + front.from_road_n[1] - std::min(front_x, 0.0) * p.front_brake_jack;
  const double rear_n = rear.from_road_n[0] + rear.from_road_n[1] + std::max(rear_x, 0.0) * p.rear_drive_jack;
  const double dive_nm = -car.x_m[0] * front_n - car.x_m[2] * rear_n - car.cg_height_m * fx * steep(held.along);
  const double roll_nm = p.axles[0].half_track_m * (front.from_road_n[0] - front.from_road_n[1]) +
                         p.axles[1].half_track_m * (rear.from_road_n[0] - rear.from_road_n[1]) +
                         (p.axles[0].bar_nmprad + p.axles[1].bar_nmprad) * across +
                         car.sprung_kg * car.cg_height_m * (felt * steep(held.bank) - kGravity_mps2 * held.bank);
  return {.front_load_n = front.load_n,
          .rear_load_n = rear.load_n,
          .ahead_n = ahead,
          .limit_n = limit,
          .front_x_n = front_x,
          .rear_x_n = rear_x,
          .front_y_n = front_y,
          .rear_y_n = rear_y,
          .fx_n = fx,
          .fy_n = fy,
          .ax_mps2 = ax,
          .ay_mps2 = ay,
          .u_mps2 = held.stopped ? 0.0 : ax + turning,
          .v_mps2 = ay - s.r_radps * s.u_mps,
          .r_ps2 = (car.x_m[0] * front_side + car.x_m[2] * rear_y) * p.per_yaw_kgm2,
          .slip_rate_ps = slip.tan_alpha_ps,
          .slip_decay_ps = slip.decay_ps,
          .ride = {.heave = (front_n + rear_n) * p.per_sprung_kg + (ax * held.rise[0] + ay * held.rise[1]),
                   .pitch = dive_nm * p.per_pitch_kgm2,
                   .roll = roll_nm * p.per_roll_kgm2}};
}

void derivative(const Params& p, const Held& h, const State& s, double t_s, State& d) {
  const Acting a = acting(p, h, grip(p, h, s).share, s, t_s);
  const double c = std::cos(s.yaw_rad), sn = std::sin(s.yaw_rad);
  const Two over = h.on_map * Two{s.u_mps, s.v_mps};
  d.x_m = over[0] * c - over[1] * sn, d.y_m = over[0] * sn + over[1] * c;
  d.yaw_rad = s.r_radps, d.path_m = over[0];
  d.u_mps = a.u_mps2, d.v_mps = a.v_mps2, d.r_radps = a.r_ps2;
  d.front_slip = a.slip_rate_ps[0], d.rear_slip = a.slip_rate_ps[1];
  if (!p.options.dynamic_attitude) return;
  const auto &k = p.springs.stiffness_ps2, &c2 = p.springs.damping_ps;
  d.z_m = s.z_rate_mps, d.pitch = s.pitch_rate_ps, d.roll = s.roll_rate_ps;
  d.z_rate_mps =
      a.ride.heave - k[0][0] * s.z_m - k[0][1] * s.pitch - c2[0][0] * s.z_rate_mps - c2[0][1] * s.pitch_rate_ps;
  d.pitch_rate_ps =
      a.ride.pitch - k[1][0] * s.z_m - k[1][1] * s.pitch - c2[1][0] * s.z_rate_mps - c2[1][1] * s.pitch_rate_ps;
  d.roll_rate_ps = a.ride.roll - p.springs.roll_stiffness_ps2 * s.roll - p.springs.roll_damping_ps * s.roll_rate_ps;
}

Result<Params> params_of(const VehicleParams& vehicle, const Options& options, const std::string& place) {
  Result<chassis::Params> car = chassis::params_of(vehicle, place);
  if (!car) return car.error();
  Params p;
  p.car = *car;
  p.options = options;
  const double tyre_npm = p.car.tyre_rate_npm;
  double roll_nm = -p.car.sprung_kg * p.car.cg_height_m * kGravity_mps2, roll_nms = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    Axle& axle = p.axles[k];
    const std::size_t left = 2 * k;
    axle.x_m = p.car.x_m[left], axle.half_track_m = p.car.y_m[left];
    // In series with the tyre: its share of the whole stroke counts in rate and in force.
    const double share = tyre_npm / (p.car.spring_npm[left] + tyre_npm), w2 = axle.half_track_m * axle.half_track_m;
    axle.spring_npm = p.car.spring_npm[left] * share;
    axle.damper_nspm = p.car.damper_nspm[left] * share * share;
    const double springs = 2.0 * w2 * (p.car.spring_npm[left] + 2.0 * p.car.bar_npm[left]), tyres = 2.0 * w2 * tyre_npm;
    axle.bar_nmprad = springs * tyres / (springs + tyres) - 2.0 * w2 * axle.spring_npm;
    axle.bar_n = 0.5 * axle.bar_nmprad / axle.half_track_m;
    const double x = axle.x_m, both_npm = 2.0 * axle.spring_npm, both_nspm = 2.0 * axle.damper_nspm;
    const double per_kg = 1.0 / p.car.sprung_kg, per_inertia = 1.0 / p.car.pitch_inertia_kgm2;
    const std::array<std::array<double, 2>, 2> arm{{{per_kg, -x * per_kg}, {-x * per_inertia, x * x * per_inertia}}};
    for (std::size_t row = 0; row < 2; ++row)
      for (std::size_t column = 0; column < 2; ++column) {
        p.springs.stiffness_ps2[row][column] += both_npm * arm[row][column];
        p.springs.damping_ps[row][column] += both_nspm * arm[row][column];
      }
    roll_nm += both_npm * w2 + axle.bar_nmprad, roll_nms += both_nspm * w2;
  }
  p.springs.roll_stiffness_ps2 = roll_nm / p.car.roll_inertia_kgm2;
  p.springs.roll_damping_ps = roll_nms / p.car.roll_inertia_kgm2;
  p.effective_kg = p.car.mass_kg + 4.0 * p.car.spin_inertia_kgm2 / (p.car.radius_m * p.car.radius_m);
  p.front_brake_jack = p.car.brake_jack[0], p.rear_drive_jack = p.car.drive_jack[2];
  p.per_effective_kg = 1.0 / p.effective_kg, p.per_mass_kg = 1.0 / p.car.mass_kg;
  p.per_sprung_kg = 1.0 / p.car.sprung_kg, p.per_wheelbase_m = 1.0 / p.car.wheelbase_m;
  p.per_tracks_m = 0.5 / (p.axles[0].half_track_m + p.axles[1].half_track_m);
  p.per_roll_kgm2 = 1.0 / p.car.roll_inertia_kgm2, p.per_pitch_kgm2 = 1.0 / p.car.pitch_inertia_kgm2;
  p.per_yaw_kgm2 = 1.0 / p.car.yaw_inertia_kgm2;
  p.per_radius_m = 1.0 / p.car.radius_m;
  return p;
}

State at_rest(const Params& p, double x_m, double y_m, double yaw_rad, double speed_mps,
              const std::array<double, 4>& h) {
  State s;
  s.x_m = x_m, s.y_m = y_m, s.yaw_rad = yaw_rad, s.path_m = x_m;
  s.u_mps = speed_mps;
  s.pitch = -0.5 * (h[0] + h[1] - h[2] - h[3]) * p.per_wheelbase_m,
  s.roll = (h[0] + h[2] - h[1] - h[3]) * p.per_tracks_m;
  s.z_m = 0.5 * (h[0] + h[1]) + p.axles[0].x_m * s.pitch;
  s.z_rate_mps = -speed_mps * s.pitch * per_root(s.pitch * s.pitch);
  return s;
}

namespace {

struct Asked {
  Under front, rear;
  double bank_m;  // left less right, of the mesh or plane, both axles together, in the middle of the step
  double friction;
  bool off_road;
};

Asked ask_road(const Params& p, const chassis::Input& in, const State& s, double dt) {
  if (in.heights_given) {
    const auto &z = in.height_m, &rate = in.height_rate_mps;
    return {{Two{z[0], z[1]}, Two{rate[0], rate[1]}, Two{}},
            {Two{z[2], z[3]}, Two{rate[2], rate[3]}, Two{}},
            0.0,
            in.road ? in.road->friction_everywhere : 1.0,
            false};
  }
  if (!in.road) return {{}, {}, 0.0, 1.0, false};
  const double travelled = s.u_mps * dt, per_s = dt > 0.0 ? 1.0 / dt : 0.0;
  bool off = false;
  double bank = 0.0;
  Two friction{};
  const auto axle = [&](std::size_t left) __attribute__((always_inline)) {  // twice in every step
    const double path = s.path_m + p.car.x_m[left];
    const Road::Laid here = in.road->laid(path), there = in.road->laid(path + travelled);
    Two from = here.z_m, to = there.z_m, here_friction = here.friction, bend_of = both(1.0);
    if (in.road->placed()) {
      const double c = std::cos(s.yaw_rad), sn = std::sin(s.yaw_rad);
      const double aside_mps = s.v_mps * per_root(s.roll * s.roll);
      const double dx = (s.u_mps * c - aside_mps * sn) * dt, dy = (s.u_mps * sn + aside_mps * c) * dt;
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t i = left + side;
        const double x = s.x_m + c * p.car.x_m[i] - sn * p.car.y_m[i], y = s.y_m + sn * p.car.x_m[i] + c * p.car.y_m[i];
        bool beside = false;
        const double base = in.road->base_m(x, y, in.height_m[i], &beside),
                     next = in.road->base_m(x + dx, y + dy, in.height_m[i], &beside);
        if (beside) {  // what lies on the road ends with it
          from[side] = to[side] = in.height_m[i], bend_of[side] = 0.0;
        } else {
          from[side] += base, to[side] += next;
        }
        off |= beside;
        bank += (side == 0 ? 0.5 : -0.5) * (base + next);
        here_friction[static_cast<int>(side)] *= in.road->base_friction(x, y);
      }
    } else {  // along a road of profiles only, where the car is in the world does not matter
      from += in.road->z_m, to += in.road->z_m;
    }
    friction += here_friction;
    const Two bend = bend_of * ((there.slope - here.slope) * (0.5 * s.u_mps * per_s));
    return Under{from, (to - from) * per_s, bend};
  };
  const Under front = axle(0), rear = axle(2);
  // On the map a way up or down a slope is shorter, and its heights come as much later.
  const Two fall = front.height_m - rear.height_m;
  const double along = 0.5 * (fall[0] + fall[1]) * p.per_wheelbase_m, over = per_root(along * along);
  const auto on_map = [&](const Under& under) __attribute__((always_inline)) {
    const Two bend = over * over * under.bend_mps2;
    // The exponential step looks at its two ends and takes a straight line between: shifted by what the parabola's mean
    // lies beside theirs, the road pushes as much.
    const Two shift = p.integrator == Integrator::kEtd2 ? bend * (dt * dt / -6.0) : Two{};
    return Under{under.height_m + shift, over * under.rate_mps, bend};
  };
  return {on_map(front), on_map(rear), bank, 0.25 * (friction[0] + friction[1]), off};
}

}  // namespace

Held held(const Params& p, const chassis::Input& in, const State& s, double dt) {
  const auto [front, rear, bank_m, friction, off_road] = ask_road(p, in, s, dt);
  // The plane through the contacts: > 0 rises forwards, to the left.
  const Two all = front.height_m + rear.height_m, all_rate = front.rate_mps + rear.rate_mps;
  const Two fall = front.height_m - rear.height_m + 0.5 * dt * (front.rate_mps - rear.rate_mps);
  const double across = (all[0] - all[1]) * p.per_tracks_m, across_rate = (all_rate[0] - all_rate[1]) * p.per_tracks_m;
  const double along = 0.5 * (fall[0] + fall[1]) * p.per_wheelbase_m, bank = bank_m * p.per_tracks_m;
  const double level = per_root(along * along + bank * bank);
  const Two on_map = bank == 0.0 ? Two{level, 1.0} : Two{per_root(along * along), per_root(bank * bank)};

  // Of the steering, and of the heading that the yaw rate brings in half a step.
  const SineCosine turned = sine_cosine(Two{in.steer_rad, s.yaw_rad + 0.5 * dt * s.r_radps});
  const double cosine = turned.cosine[0], sine = turned.sine[0];
  double most_slip_pm = std::numeric_limits<double>::infinity();
  if (p.integrator == Integrator::kRk4) {
    const double turning = std::abs(s.v_mps) + std::max(p.car.x_m[0], -p.car.x_m[2]) * std::abs(s.r_radps);
    const double fastest = std::max(std::abs(s.u_mps) + std::abs(sine) * turning, tyre::kSlideCarries * turning);
    most_slip_pm = 1.0 / std::max(0.5 * fastest * dt, 1e-6);
  }

  const double front_drive = (in.drive_nm[0] + in.drive_nm[1]) * p.per_radius_m,
               rear_drive = (in.drive_nm[2] + in.drive_nm[3]) * p.per_radius_m,
               front_brake = (in.brake_nm[0] + in.brake_nm[1]) * p.per_radius_m,
               rear_brake = (in.brake_nm[2] + in.brake_nm[3]) * p.per_radius_m, brake = front_brake + rear_brake;
  double against = sign(s.u_mps);  // the motion that the brakes oppose
  bool stopped = false;
  Two reach{1.0, 1.0};
  double aside_mps = 0.0, sticks_n = brake;
  if (brake > 0.0 && p.options.magic_formula) {
    // A locked wheel pushes against its slide. Aside it slides beyond the slip of the highest force, at twice that all
    // of its motion is slide; below it the patch sticks, and what moves is the carcass.
    const double vf = s.v_mps + p.car.x_m[0] * s.r_radps, vr = s.v_mps + p.car.x_m[2] * s.r_radps;
    const Two vx = magnitude(Two{s.u_mps * cosine + vf * sine, s.u_mps});
    const Two over = magnitude(Two{s.front_slip, s.rear_slip}) * (1.5 * p.car.tyre.per_tan_alpha_bend) - both(1.0);
    const Two aside = least(largest(over, Two{}), both(1.0)) * magnitude(Two{vf * cosine - s.u_mps * sine, vr});
    aside_mps = std::max(aside[0], aside[1]);
    if (aside_mps > 0.0) {
      const Two slide2 = vx * vx + aside * aside;
      for (int k = 0; k < 2; ++k)
        if (slide2[k] > 0.0) reach[k] = vx[k] / std::sqrt(slide2[k]);
      sticks_n = (aside[0] > 0.0 ? 0.0 : front_brake) + (aside[1] > 0.0 ? 0.0 : rear_brake);
    }
  }
  if (brake > 0.0 && std::max(std::abs(s.u_mps), aside_mps) * p.effective_kg <= dt * brake) {
    // They can stop the car within the step: do they hold it against drive and grade?
    const double grade_n = p.car.mass_kg * kGravity_mps2 * along * level;
    // Each axle pushes as its brakes let it, within the friction under what its springs now put on it.
    const double grip = friction * p.car.tyre.p.long_peak;
    const auto load_n = [&](const Axle& axle, const Under& road, double rest_n) {
      const double sunk = road.height_m[0] + road.height_m[1] - 2.0 * (s.z_m - axle.x_m * s.pitch);
      return std::max(2.0 * rest_n * level + axle.spring_npm * sunk, 0.0);
    };
    const double front_n = load_n(p.axles[0], front, p.car.load_n[0]),
                 rear_n = load_n(p.axles[1], rear, p.car.load_n[2]);
    const auto pushes_n = [&](double drive_n, double brake_n, double limit_n) {
      return Two{std::clamp(drive_n - brake_n, -limit_n, limit_n), std::clamp(drive_n + brake_n, -limit_n, limit_n)};
    };
    const Two ahead = cosine * pushes_n(front_drive, front_brake, grip * front_n) +
                      pushes_n(rear_drive, rear_brake, grip * rear_n) - both(grade_n);
    stopped = ahead[0] <= 0.0 && ahead[1] >= 0.0;
    if (!stopped && s.u_mps == 0.0) against = sign(ahead[0]);
  }
  const double u = s.u_mps;
  return {.front = front,
          .rear = rear,
          .friction = friction,
          .dt_s = dt,
          .along = along,
          .across = across,
          .across_rate_ps = across_rate,
          .bank = bank,
          .level = level,
          .on_map = on_map,
          .rise = on_map * Two{along, bank},
          .cosine = cosine,
          .sine = sine,
          .yaw_cosine = turned.cosine[1],
          .yaw_sine = turned.sine[1],
          .front_push_n = front_drive - against * front_brake,
          .rear_push_n = rear_drive - against * rear_brake,
          .reach = reach,
          .sticks_mps = dt * sticks_n * p.per_effective_kg,
          .drag_kgpm = in.air_and_rolling ? phare::drag_kgpm(p.car.drag_area_m2) : 0.0,
          .rolling = in.air_and_rolling
                         ? p.car.rolling_coefficient * u / std::sqrt(u * u + kRollingKnee_mps * kRollingKnee_mps)
                         : 0.0,
          .stopped = stopped,
          .off_road = off_road,
          .most_slip_pm = most_slip_pm};
}

chassis::Forces forces(const Params& p, const chassis::Input& in, const State& s) {
  const Held h = held(p, in, s, 1e-3);
  const Acting a = acting(p, h, grip(p, h, s).share, s, 0.0);
  chassis::Forces out;
  const double brakes_nm = in.brake_nm[0] + in.brake_nm[1] + in.brake_nm[2] + in.brake_nm[3];
  for (std::size_t i = 0; i < 4; ++i) {
    const Two load = i < 2 ? a.front_load_n : a.rear_load_n;
    const double axle = load[0] + load[1], share = axle > 0.0 ? load[i % 2] / axle : 0.0;
    out.load_n[i] = load[i % 2];
    // What holds a car that stands, each wheel by its share of the brakes.
    out.fx_n[i] = h.stopped ? a.fx_n * in.brake_nm[i] / brakes_nm : 0.5 * (i < 2 ? a.front_x_n : a.rear_x_n);
    out.fy_n[i] = share * (i < 2 ? a.front_y_n : a.rear_y_n);
    out.ground_m[i] = (i < 2 ? h.front : h.rear).height_m[i % 2];
  }
  const Two along = h.front.height_m - h.rear.height_m;
  out.road_pitch_rad = -std::atan(0.5 * (along[0] + along[1]) * p.per_wheelbase_m);
  // Roll turns about the pitched x axis (R = Rz Ry Rx), a slope aside does not.
  const double pitched = 1.0 / std::sqrt(1.0 + s.pitch * s.pitch);
  out.road_roll_rad = std::atan(h.across * std::cos(out.road_pitch_rad));
  out.ax_mps2 = a.ax_mps2, out.ay_mps2 = a.ay_mps2;
  out.roll_rad = std::atan(s.roll * pitched), out.pitch_rad = std::atan(s.pitch), out.yaw_rad = s.yaw_rad;
  out.roll_rate_radps = s.roll_rate_ps * pitched / steep(s.roll * pitched);
  out.pitch_rate_radps = s.pitch_rate_ps / steep(s.pitch);
  out.yaw_rate_radps = s.r_radps;
  out.off_road = h.off_road;
  return out;
}

}  // namespace phare::single_track
