#include "vehicle_dynamics/models/full.h"

#include <algorithm>
#include <cmath>

#include "config/base/conventions.h"
#include "vehicle_dynamics/models/air.h"
#include "vehicle_dynamics/models/full_parts.h"

namespace phare::full {

// Half the cross product of the diagonals of four contacts: either pair of triangles gives the same.
std::array<double, 3> normal_of(const std::array<double, 4>& x, const std::array<double, 4>& y,
                                const std::array<double, 4>& z) {
  const double ax = x[0] - x[3], ay = y[0] - y[3], az = z[0] - z[3];
  const double bx = x[2] - x[1], by = y[2] - y[1], bz = z[2] - z[1];
  if (az == 0.0 && bz == 0.0) return {0.0, 0.0, 1.0};
  double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
  // A car on its roof sees its contacts mirrored.
  const double scale = (nz < 0.0 ? -1.0 : 1.0) / std::sqrt(nx * nx + ny * ny + nz * nz);
  nx *= scale, ny *= scale, nz *= scale;
  return {nx, ny, nz};
}

Geometry geometry(const Params& p, const Input& input, const State& s, double t_s) {
  Geometry g;
  // Rotation matrix of a quaternion; divided by its square so that a stage's slight stretch does not scale the car.
  const double n2 = 2.0 / (s.qw * s.qw + s.qx * s.qx + s.qy * s.qy + s.qz * s.qz);
  const double xx = s.qx * s.qx * n2, yy = s.qy * s.qy * n2, zz = s.qz * s.qz * n2;
  const double xy = s.qx * s.qy * n2, xz = s.qx * s.qz * n2, yz = s.qy * s.qz * n2;
  const double wx = s.qw * s.qx * n2, wy = s.qw * s.qy * n2, wz = s.qw * s.qz * n2;
  g.world_from_body = {1.0 - yy - zz, xy - wz,       xz + wy,  //
                       xy + wz,       1.0 - xx - zz, yz - wx,  //
                       xz - wy,       yz + wx,       1.0 - xx - yy};
  const auto& m = g.world_from_body;

  // Wheel centres, and the road below them.
  std::array<double, 4>&x = g.x_m, &y = g.y_m, z, base_m{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double up = p.radius_m - p.cg_height_m + s.travel_m[i];
    x[i] = m[0] * p.x_m[i] + m[1] * p.y_m[i] + m[2] * up;
    y[i] = m[3] * p.x_m[i] + m[4] * p.y_m[i] + m[5] * up;
    z[i] = s.z_m + p.cg_height_m + m[6] * p.x_m[i] + m[7] * p.y_m[i] + m[8] * up;
  }
  const double per_level = 1.0 / std::sqrt(std::max(m[0] * m[0] + m[3] * m[3], 1e-12));
  g.ahead_x = m[0] * per_level, g.ahead_y = m[3] * per_level;
  Road::Laid laid[2];  // on the road, by axle: profiles count what is travelled on the map, not up and down
  if (input.road && !input.heights_given)
    for (std::size_t k = 0; k < 2; ++k)
      laid[k] = input.road->laid(s.path_m +
                                 0.5 * (g.ahead_x * (x[2 * k] + x[2 * k + 1]) + g.ahead_y * (y[2 * k] + y[2 * k + 1])));
  for (std::size_t i = 0; i < 4; ++i) {
    g.friction[i] = 1.0;
    if (input.heights_given) {
      g.ground_m[i] = input.height_m[i] + input.height_rate_mps[i] * t_s;
      if (input.road) g.friction[i] = input.road->friction_everywhere;
    } else if (input.road) {
      const Road::Laid& on_it = laid[i / 2];
      bool beside = false;  // what lies on the road ends with it
      base_m[i] = input.road->base_m(s.x_m + x[i], s.y_m + y[i], input.height_m[i], &beside);
      g.ground_m[i] = base_m[i] + (beside ? 0.0 : on_it.z_m[i % 2]);
      g.off_road |= beside;
      g.friction[i] = on_it.friction[i % 2] * input.road->base_friction(s.x_m + x[i], s.y_m + y[i]);
    }
  }

  // The tyres push along the normal of the plane through the contacts. Bank is that of the mesh or plane only: two
  // tracks of unlike height are no slope aside under either tyre.
  for (std::size_t i = 0; i < 4; i += 2) {
    const double mean = 0.5 * (g.ground_m[i] + g.ground_m[i + 1]), bank = 0.5 * (base_m[i] - base_m[i + 1]);
    g.tilt_m[i] = mean + bank, g.tilt_m[i + 1] = mean - bank;
  }
  g.normal_world = normal_of(x, y, g.tilt_m);
  const double nx = g.normal_world[0], ny = g.normal_world[1], nz = g.normal_world[2];
  g.normal = {m[0] * nx + m[3] * ny + m[6] * nz, m[1] * nx + m[4] * ny + m[7] * nz, m[2] * nx + m[5] * ny + m[8] * nz};

  for (std::size_t i = 0; i < 4; ++i)
    g.squeeze_m[i] = p.radius_m + p.load_n[i] / p.tyre_rate_npm - (z[i] - g.ground_m[i]) * nz;
  return g;
}

void kinematics(const Params& p, const Held& held, const Geometry& g, const Steer& steer, const State& s, State& d,
                Contact& contact) {
  const auto& m = g.world_from_body;
  d.x_m = m[0] * s.u_mps + m[1] * s.v_mps + m[2] * s.w_mps;
  d.y_m = m[3] * s.u_mps + m[4] * s.v_mps + m[5] * s.w_mps;
  d.z_m = m[6] * s.u_mps + m[7] * s.v_mps + m[8] * s.w_mps;
  d.path_m = g.ahead_x * d.x_m + g.ahead_y * d.y_m;
  d.qw = 0.5 * (-s.qx * s.p_radps - s.qy * s.q_radps - s.qz * s.r_radps);
  d.qx = 0.5 * (s.qw * s.p_radps + s.qy * s.r_radps - s.qz * s.q_radps);
  d.qy = 0.5 * (s.qw * s.q_radps + s.qz * s.p_radps - s.qx * s.r_radps);
  d.qz = 0.5 * (s.qw * s.r_radps + s.qx * s.q_radps - s.qy * s.p_radps);

  // The car's x axis in the road plane and its left; wheels are steered about the plane's normal.
  const auto& n = g.normal;
  const double inv = 1.0 / std::sqrt(std::max(1.0 - n[0] * n[0], 1e-12));
  const std::array<double, 3> ahead_axis{(1.0 - n[0] * n[0]) * inv, -n[0] * n[1] * inv, -n[0] * n[2] * inv};
  const std::array<double, 3> left_axis{n[1] * ahead_axis[2] - n[2] * ahead_axis[1],
                                        n[2] * ahead_axis[0] - n[0] * ahead_axis[2],
                                        n[0] * ahead_axis[1] - n[1] * ahead_axis[0]};
  for (std::size_t i = 0; i < 4; ++i) {
    d.travel_m[i] = s.rise_mps[i] - (s.w_mps - s.q_radps * p.x_m[i] + s.p_radps * p.y_m[i]);
    const double c = steer.cosine[i], sn = steer.sine[i];
    auto &along = contact.along[i], &left = contact.left[i];
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = c * ahead_axis[k] + sn * left_axis[k];
      left[k] = c * left_axis[k] - sn * ahead_axis[k];
    }
    // The roll axis lies on the ground: roll does not push the contacts sideways.
    const double vx = s.u_mps - s.r_radps * p.y_m[i], vz = s.rise_mps[i];
    const double vy = s.v_mps + s.r_radps * p.x_m[i];
    const double ahead = vx * along[0] + vy * along[1] + vz * along[2];
    const double aside = vx * left[0] + vy * left[1] + vz * left[2];
    contact.rolling_mps[i] = s.spin_radps[i] * p.radius_m;
    const tyre::SlipRate slip = tyre::slip_rate(p.tyre, s.kappa[i], s.tan_alpha[i], ahead, aside,
                                                contact.rolling_mps[i], held.most_along_pm, held.most_across_pm);
    d.kappa[i] = slip.kappa_ps;
    d.tan_alpha[i] = slip.tan_alpha_ps;
    contact.decay_ps[i] = slip.kappa_decay_ps;
    contact.decay_ps[i + 4] = slip.tan_alpha_decay_ps;
    contact.moving_mps[i] = std::max(slip.carried_mps, std::abs(aside));
    contact.stretch_mps[i] = slip.kappa_stretch_mps;
    contact.stretch_mps[i + 4] = slip.tan_alpha_stretch_mps;
    // Closing speed of the tyre: the wheel's against the road, along the normal.
    contact.closing_mps[i] = -(vx * g.normal[0] + vy * g.normal[1] + vz * g.normal[2]);
  }
}

void dynamics(const Params& p, const Input& input, const Held& held, const Geometry& g, const Contact& c,
              const State& s, State& d, TyreForces& tyres) {
  constexpr double kFullDamping_n = 2700.0;  // load at which carcass_damping_nspm is given
  constexpr double kDampedBelow_mps = 2.0;   // faded out there: a rolling or sliding tyre carries it away
  constexpr double kRollingKnee_mps = 0.05;  // rolling resistance turns its sign smoothly
  const auto& m = g.world_from_body;

  for (std::size_t i = 0; i < 4; ++i) {
    const double closing =
        p.tyre_damping_nspm * (c.closing_mps[i] + (input.heights_given ? input.height_rate_mps[i] : 0.0));
    tyres.load_n[i] = g.squeeze_m[i] > 0.0 ? std::max(0.0, p.tyre_rate_npm * g.squeeze_m[i] + closing) : 0.0;
  }
  tyre::steady_forces(p.tyre, s.kappa.data(), s.tan_alpha.data(), tyres.load_n.data(), g.friction.data(),
                      tyres.fx_n.data(), tyres.fy_n.data());

  const double gx = -kGravity_mps2 * m[6], gy = -kGravity_mps2 * m[7], gz = -kGravity_mps2 * m[8];
  const double lighter = 1.0 + gz / kGravity_mps2;
  double fx = 0.0, fy = 0.0, roll = 0.0, pitch = 0.0, yaw = 0.0;
  std::array<double, 4> up{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (c.moving_mps[i] < kDampedBelow_mps && tyres.load_n[i] > 0.0) {
      const double damping =
          p.tyre.p.carcass_damping_nspm * (1.0 - c.moving_mps[i] / kDampedBelow_mps) * tyres.load_n[i] / kFullDamping_n;
      const double x = tyres.fx_n[i] + std::min(damping, held.most_damping_nspm) * c.stretch_mps[i],
                   y = tyres.fy_n[i] + damping * c.stretch_mps[i + 4];
      const double most = g.friction[i] * tyres.load_n[i];
      const double ex = x / (most * p.tyre.p.long_peak), ey = y / (most * p.tyre.p.lat_peak), over = ex * ex + ey * ey;
      const double scale = 1.0 / std::sqrt(std::max(over, 1.0));
      tyres.fx_n[i] = x * scale, tyres.fy_n[i] = y * scale;
    }
    const double along = tyres.fx_n[i], left = tyres.fy_n[i], load = tyres.load_n[i];
    const double rx = along * c.along[i][0] + left * c.left[i][0];
    const double bx = rx + load * g.normal[0];
    const double ry = along * c.along[i][1] + left * c.left[i][1];
    const double by = ry + load * g.normal[1];
    up[i] = along * c.along[i][2] + left * c.left[i][2] + load * g.normal[2];
    fx += bx, fy += by;
    yaw += p.x_m[i] * by - p.y_m[i] * bx;
    // A leaning body has a lever for each wheel: the height of the centre of gravity less what this corner has sunk
    // from rest on this grade. Their part along the body's z is in `up`, at the same contact.
    const double sunk = s.travel_m[i] + (load - p.load_n[i]) / p.tyre_rate_npm + lighter * p.rest_m[i];
    pitch -= (p.cg_height_m - sunk) * rx;
    roll -= sunk * ry;

    const double rolling =
        input.air_and_rolling && !held.locked[i]
            ? p.rolling_coefficient * load * p.radius_m * c.rolling_mps[i] /
                  std::sqrt(c.rolling_mps[i] * c.rolling_mps[i] + kRollingKnee_mps * kRollingKnee_mps)
            : 0.0;
    d.spin_radps[i] = held.locked[i]
                          ? 0.0
                          : (input.drive_nm[i] - held.brake_nm[i] - rolling - p.radius_m * along) / p.spin_inertia_kgm2;
    if (held.locked[i]) tyres.net_nm[i] = input.drive_nm[i] - p.radius_m * along;
  }

  // Suspension: springs, dampers, bars, stops, and what the linkage carries past them.
  double lift = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    yaw += p.unsprung_kg[i] * (p.x_m[i] * gy - p.y_m[i] * gx);  // weight of the wheels, at the wheels
    const double other = s.travel_m[i ^ 1u], travel = s.travel_m[i];
    double force =
        p.spring_n[i] + p.spring_npm[i] * travel + p.damper_nspm[i] * d.travel_m[i] + p.bar_npm[i] * (travel - other);
    const double from_driver = travel + p.sunk_m[i];
    if (from_driver > p.bump_travel_m) force += p.stop_rate_npm * (from_driver - p.bump_travel_m);
    if (from_driver < -p.rebound_travel_m) force += p.stop_rate_npm * (from_driver + p.rebound_travel_m);
    force -= std::min(tyres.fx_n[i], 0.0) * p.brake_jack[i];
    force += std::max(tyres.fx_n[i], 0.0) * p.drive_jack[i];
    lift += force;
    roll += p.y_m[i] * force;
    pitch -= p.x_m[i] * force;
    const double u = s.u_mps - s.r_radps * p.y_m[i], v = s.v_mps + s.r_radps * p.x_m[i];
    d.rise_mps[i] = (up[i] - force + p.unsprung_couple[i] * fy) / p.unsprung_kg[i] + gz - s.p_radps * v + s.q_radps * u;
  }
  roll += p.sprung_kg / p.mass_kg * p.cg_height_m * fy;

  const double drag = input.air_and_rolling ? drag_n(p.drag_area_m2, s.u_mps) : 0.0;
  tyres.ax_mps2 = (fx - drag) / p.mass_kg + gx;
  tyres.ay_mps2 = fy / p.mass_kg + gy;
  d.u_mps = tyres.ax_mps2 - s.q_radps * s.w_mps + s.r_radps * s.v_mps;
  d.v_mps = tyres.ay_mps2 - s.r_radps * s.u_mps + s.p_radps * s.w_mps;
  d.w_mps = lift / p.sprung_kg + gz - s.p_radps * s.v_mps + s.q_radps * s.u_mps;
  d.p_radps = (roll + (p.pitch_inertia_kgm2 - p.yaw_inertia_kgm2) * s.q_radps * s.r_radps) / p.roll_inertia_kgm2;
  d.q_radps = (pitch + (p.yaw_inertia_kgm2 - p.roll_inertia_kgm2) * s.p_radps * s.r_radps) / p.pitch_inertia_kgm2;
  d.r_radps = (yaw + (p.roll_inertia_kgm2 - p.pitch_inertia_kgm2) * s.p_radps * s.q_radps) / p.yaw_inertia_kgm2;
}

Steer steer_angles(const Params& p, double mean_rad) {
  Steer steer;
  steer.cosine = {1.0, 1.0, 1.0, 1.0};
  if (mean_rad == 0.0) return steer;
  // All axes meet on the line of the rear axle: cot outer = cot inner + track / wheelbase; about the mean.
  const double track = p.y_m[0] - p.y_m[1], tangent = std::tan(mean_rad);
  const double left = std::atan(tangent / (1.0 - 0.5 * track / p.wheelbase_m * tangent));
  const double right = std::atan(tangent / (1.0 + 0.5 * track / p.wheelbase_m * tangent));
  const std::array<double, 2> angle{mean_rad + p.ackermann_01 * (left - mean_rad),
                                    mean_rad + p.ackermann_01 * (right - mean_rad)};
  for (std::size_t i = 0; i < 2; ++i) steer.cosine[i] = std::cos(angle[i]), steer.sine[i] = std::sin(angle[i]);
  return steer;
}

}  // namespace phare::full
