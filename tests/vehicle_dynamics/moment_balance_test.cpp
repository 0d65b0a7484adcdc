// Level full: the tyres' loads against the moments about the ground that the model's own equations leave. Reference:
// written from the masses, their heights and what the tyres give together, not from how the model puts wheels together.
#include <gtest/gtest.h>

#include "config/base/conventions.h"
#include "full_car.h"

namespace phare {
namespace {

using test::Drive;
using test::full_car;

struct Transfer {
  double loads_nm = 0.0;    ///< moment of the tyres' loads about the centre of gravity
  double balance_nm = 0.0;  ///< what holds it
  double share() const { return loads_nm / balance_nm - 1.0; }
};

// What the road gives along and across the car.
struct RoadForce {
  double along_n = 0.0, across_n = 0.0;
};

RoadForce road_force(const Drive& d, const full::Forces& f) {
  RoadForce sum;
  for (std::size_t i = 0; i < 4; ++i) {
    const double steer = i < 2 ? d.input.steer_rad : 0.0;
    sum.along_n += f.fx_n[i] * std::cos(steer) - f.fy_n[i] * std::sin(steer);
    sum.across_n += f.fx_n[i] * std::sin(steer) + f.fy_n[i] * std::cos(steer);
  }
  return sum;
}

// From front to rear: every kilogram at the height of the body's centre of gravity, as dive has it (docs/dynamics.md).
// The pitching moment of the weight is left out there, and here.
Transfer along(const Drive& d) {
  const full::Params& p = d.params;
  const full::Forces f = d.forces();
  Transfer t;
  for (std::size_t i = 0; i < 4; ++i) t.loads_nm -= p.x_m[i] * (f.load_n[i] - p.load_n[i]);
  t.balance_nm = road_force(d, f).along_n * (p.cg_height_m + d.state.z_m);
  return t;
}

// From left to right: the body at its height, the axles at that of the wheels, and the weight of both as they lean.
Transfer across(const Drive& d) {
  const full::Params& p = d.params;
  const full::Forces f = d.forces();
  Transfer t;
  for (std::size_t i = 0; i < 4; ++i) t.loads_nm -= p.y_m[i] * f.load_n[i];
  const double of_body = p.sprung_kg * (p.cg_height_m + d.state.z_m), of_axles = (p.mass_kg - p.sprung_kg) * p.radius_m;
  t.balance_nm = (of_body + of_axles) * (road_force(d, f).across_n / p.mass_kg + kGravity_mps2 * std::sin(f.roll_rad));
  return t;
}

// Tolerance 0.5 %, of which the test's own formula takes: cosines of pitch and roll of 7 degrees at most (0.7 % of the
// small part that they multiply), motion that has not quite settled, a thousandth.
constexpr double kBand = 0.005;

TEST(MomentBalance, DrivingOff) {
  for (const char* file : {"bmw_320i.toml", "hatchback.toml", "ford_escort.toml"}) {
    Drive d(full_car(file), 5.0);
    const double torque = 0.45 * d.params.mass_kg * kGravity_mps2 * d.params.radius_m;
    for (const std::size_t i : {2u, 3u}) d.input.drive_nm[i] = 0.5 * torque;
    d.run(4.0, 0.002);
    EXPECT_GT(d.forces().ax_mps2, 3.5) << file;
    EXPECT_NEAR(along(d).share(), 0.0, kBand) << file;
  }
}

TEST(MomentBalance, Braking) {
  for (const char* file : {"bmw_320i.toml", "hatchback.toml", "ford_escort.toml"}) {
    Drive d(full_car(file), 40.0);
    d.brake(7.0);
    d.run(4.0, 0.002);
    EXPECT_LT(d.forces().ax_mps2, -6.0) << file;
    EXPECT_NEAR(along(d).share(), 0.0, kBand) << file;
  }
}

TEST(MomentBalance, InABend) {
  for (const char* file : {"bmw_320i.toml", "hatchback.toml", "vw_vanagon.toml"}) {
    Drive d(full_car(file), 20.0);
    double short_of = 0.0;
    d.run(12.0, 0.002, [&](Drive& now) {
      now.input.steer_rad = 0.055 * std::min(1.0, now.time_s / 4.0);
      short_of = 20.0 - now.state.u_mps;
      now.input.drive_nm = {0.0, 0.0, 2000.0 * short_of, 2000.0 * short_of};
    });
    EXPECT_GT(std::abs(d.forces().ay_mps2), 6.0) << file;
    EXPECT_NEAR(across(d).share(), 0.0, kBand) << file;
  }
}

// Nothing is steady here: means over a second and a half, in which the body's own turning takes a thousandth.
TEST(MomentBalance, BrakingInABend) {
  Drive d(full_car(), 28.0);
  d.input.steer_rad = 0.012;
  d.run(2.0, 0.002);
  d.brake(3.5);
  d.run(2.5, 0.002);
  Transfer pitch, roll;
  d.run(1.5, 0.002, [&](const Drive& now) {
    const Transfer x = along(now), y = across(now);
    pitch.loads_nm += x.loads_nm, pitch.balance_nm += x.balance_nm;
    roll.loads_nm += y.loads_nm, roll.balance_nm += y.balance_nm;
  });
  EXPECT_NEAR(pitch.share(), 0.0, 2.0 * kBand);
  EXPECT_NEAR(roll.share(), 0.0, 2.0 * kBand);
}

}  // namespace
}  // namespace phare
