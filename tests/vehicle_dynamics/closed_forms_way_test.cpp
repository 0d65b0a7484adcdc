// Coasting, slopes and friction against closed forms (notes 6.6 to 6.8); docs/dynamics.md has the table.
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <utility>

#include "closed_forms.h"
#include "config/base/conventions.h"
#include "vehicle_dynamics/models/kinematic.h"

namespace phare {
namespace {

using test::Drive;
using test::expect_share;
using test::full_car;
using test::kForm;
using test::Track;

constexpr double kAir_kgpm3 = 1.2041;
constexpr std::array<double, 4> kCoast_s{10.0, 20.0, 30.0, 60.0}, kCoast_mps{29.940, 27.173, 24.874, 19.840};

// Speeds of every level after coasting from 120 km/h.
std::array<std::array<double, 4>, 3> coast(double rolling) {
  VehicleParams v = test::car("bmw_320i.toml");
  v.rolling_coefficient = rolling;
  Drive full(*full::params_of(v, ""), 120.0 / 3.6);
  Track single(*single_track::params_of(v, {}, ""), 120.0 / 3.6);
  full.input.air_and_rolling = single.input.air_and_rolling = true;
  CarState kinematic;
  kinematic.speed_mps = 120.0 / 3.6;
  std::array<std::array<double, 4>, 3> seen{};
  double t = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double seconds = kCoast_s[i] - t;
    full.run(seconds, 0.002), single.run(seconds, 0.005);
    for (long n = 0; n < std::lround(seconds / 0.005); ++n) kinematic::advance(v, 0.0, {}, kinematic, 0.005);
    t = kCoast_s[i];
    seen[0][i] = full.state.u_mps, seen[1][i] = single.state.u_mps, seen[2][i] = kinematic.speed_mps;
  }
  return seen;
}

// 6.6. Air only: v = v0 / (1 + k v0 t / m_e).
TEST(ClosedForm, CoastDownInAir) {
  const full::Params p = full_car();
  const double effective = p.mass_kg + 4.0 * p.spin_inertia_kgm2 / (p.radius_m * p.radius_m);
  expect_share(effective, 1150.76, 1e-4, "effective mass");
  const double k = 0.5 * kAir_kgpm3 * p.drag_area_m2, v0 = 120.0 / 3.6;
  for (const auto& level : coast(0.0))
    for (std::size_t i = 0; i < 4; ++i) {
      expect_share(level[i], kCoast_mps[i], kForm, "notes");
      // Euler's method of level kinematic at 5 ms is the coarsest: half a step of deceleration, 2 mm/s at most.
      EXPECT_NEAR(level[i], v0 / (1.0 + k * v0 * kCoast_s[i] / effective), 2e-3);
    }
}

// With rolling resistance c0: v = sqrt(c0/k) tan(atan(v0 sqrt(k/c0)) - t sqrt(c0 k)/m_e).
TEST(ClosedForm, CoastDownWithRolling) {
  const full::Params p = full_car();
  ASSERT_GT(p.rolling_coefficient, 0.01);
  const double effective = p.mass_kg + 4.0 * p.spin_inertia_kgm2 / (p.radius_m * p.radius_m);
  const double k = 0.5 * kAir_kgpm3 * p.drag_area_m2, v0 = 120.0 / 3.6,
               c0 = p.rolling_coefficient * p.mass_kg * kGravity_mps2;
  for (const auto& level : coast(p.rolling_coefficient))
    for (std::size_t i = 0; i < 4; ++i) {
      const double expected =
          std::sqrt(c0 / k) * std::tan(std::atan(v0 * std::sqrt(k / c0)) - kCoast_s[i] * std::sqrt(c0 * k) / effective);
      expect_share(level[i], expected, kForm, "rolling and air");
    }
}

// 6.7. Held on 20 %.
TEST(ClosedForm, HeldOnASlope) {
  Road slope;
  slope.slope_x = 0.2;
  const double grade = std::atan(0.2);
  const VehicleParams as_shipped = test::car("bmw_320i.toml"),
                      textbook = test::one_centre("bmw_320i.toml", as_shipped.chassis->tyre.long_relaxation_m);
  // The textbook's car has 5301.4 N on its front axle; as shipped, each axle carrying its own wheels, it is 5233 N, 1.3
  // % less: half of 127.6 kg in front, not 55 %.
  const double cosine = std::cos(grade), transfer = 2103.39 * as_shipped.cg_height_m / as_shipped.wheelbase_m;
  const double own = 2.0 * full_car().load_n[0] * cosine - transfer;
  EXPECT_NEAR(own, 5233.0, 3.0);
  for (const auto& [vehicle, front_n] : {std::pair{textbook, 5301.4}, {as_shipped, own}}) {
    Drive full(*full::params_of(vehicle, ""), 0.0, &slope);
    full.brake(10.0);
    full.run(15.0, 0.002);
    Track single(*single_track::params_of(vehicle, {}, ""));
    single.input.road = &slope;
    const double a = single.params.car.x_m[0], b = single.params.car.x_m[2];
    single.state = single_track::at_rest(single.params, 0.0, 0.0, 0.0, 0.0, {0.2 * a, 0.2 * a, 0.2 * b, 0.2 * b});
    single.brake(10.0);
    single.run(15.0, 0.005);
    for (const full::Forces& f : {full.forces(), single.forces()}) {
      double fx = 0.0;
      for (const double n : f.fx_n) fx += n;
      expect_share(fx, 2103.39, kForm, "held");
      expect_share(f.road_pitch_rad - f.pitch_rad, 10.14e-3, kForm, "pitch");
      expect_share(f.load_n[0] + f.load_n[1], front_n, kForm, "front axle");
    }
  }
  const double felt = -kGravity_mps2 * -std::sin(grade);
  expect_share(-kinematic::quasi_static_attitude(as_shipped, felt, 0.0).pitch_rad, 10.14e-3, kForm, "kinematic");
}

// 6.8. Friction: nothing stops in less than v^2 / (2 mu g), and no tyre pulls more than its ellipse, in any step.
struct Manoeuvre {
  const char* what;
  double speed_mps, seconds;
  std::function<void(full::Input&, double t)> drive;
};

void brake_all(full::Input& input, double front_nm, double rear_nm) {
  input.brake_nm = {front_nm, front_nm, rear_nm, rear_nm};
}

TEST(ClosedForm, FrictionEllipseInEveryStep) {
  Road rough;
  rough.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kC, 11, 200.0));
  rough.friction = {{.from_m = 20.0, .to_m = 60.0, .left = 0.2, .right = 0.9},
                    {.from_m = 90.0, .to_m = 130.0, .left = 0.1, .right = 0.1}};
  Road kerb;
  kerb.profiles.push_back(HeightProfile::bumps(
      {{.shape = Bump::Shape::kCosine, .start_m = 20.0, .height_m = 0.12, .length_m = 1.0, .right = false}}));
  Road slippery;
  slippery.friction_everywhere = 0.3;
  std::mt19937_64 random(68);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const std::vector<Manoeuvre> manoeuvres{
      {"launch", 0.0, 6.0,
       [](full::Input& in, double) {
         in.drive_nm = {0.0, 0.0, 1500.0, 1500.0};
       }},
      {"slalom", 30.0, 8.0, [](full::Input& in, double t) { in.steer_rad = 0.15 * std::sin(4.0 * t); }},
      {"braking in a bend", 25.0, 6.0,
       [](full::Input& in, double t) {
         in.steer_rad = 0.08;
         if (t > 1.0) brake_all(in, 900.0, 450.0);
       }},
      {"locked wheels, then let go", 25.0, 6.0,
       [](full::Input& in, double t) {
         in.steer_rad = 0.03;
         t < 1.5 ? brake_all(in, 1e4, 1e4) : brake_all(in, 0.0, 0.0);
       }},
      {"reverse at full lock", -6.0, 6.0, [](full::Input& in, double) { in.steer_rad = -0.5; }},
      {"full lock at walking pace", 1.4, 6.0, [](full::Input& in, double) { in.steer_rad = 0.6; }},
      {"hand brake turn", 15.0, 6.0,
       [](full::Input& in, double t) {
         in.steer_rad = t < 1.0 ? 0.3 : -0.3;
         brake_all(in, 0.0, t < 2.0 ? 2000.0 : 0.0);
       }},
      {"at random", 20.0, 20.0, [&](full::Input& in, double t) {
         if (std::fmod(t, 0.1) > 0.002) return;
         in.steer_rad = uniform(-0.5, 0.5);
         for (double& torque : in.drive_nm) torque = uniform(-200.0, 800.0);
         for (double& torque : in.brake_nm) torque = std::max(0.0, uniform(-2000.0, 2000.0));
       }}};
  long samples = 0;
  for (const Manoeuvre& m : manoeuvres)
    for (const Road* road :
         {static_cast<const Road*>(nullptr), &std::as_const(rough), &std::as_const(kerb), &std::as_const(slippery)})
      for (const bool relaxed : {false, true}) {
        Drive full(relaxed ? test::hard_car() : full_car(), m.speed_mps, road);
        const Road smooth;
        double most = 0.0;
        for (double t = 0.0; t < m.seconds; t += 0.002) {
          if (std::max(std::abs(full.roll_rad()), std::abs(full.pitch_rad())) > kRolledOver_rad) break;  // no motion
          m.drive(full.input, t);
          full.step(0.002);
          const full::Params& p = full.params;
          const auto friction = test::friction_under(p, road ? *road : smooth, full.state.path_m);
          most = std::max(most, test::friction_use(p, full.forces(), friction));
          ++samples;
        }
        ASSERT_TRUE(test::finite(full.state)) << m.what;
        EXPECT_LE(most, 1.001) << m.what;
      }
  EXPECT_GT(samples, 150'000);
}

TEST(ClosedForm, NothingStopsShorterThanFriction) {
  for (const double friction : {1.0, 0.5, 0.1}) {
    Road road;
    road.friction_everywhere = friction;
    for (const double torque : {300.0, 900.0, 1e4}) {
      const double v0 = 20.0;
      Drive full(full_car(), v0, &road);
      brake_all(full.input, torque, 0.5 * torque);
      full.run(40.0, 0.002);
      Track single(test::single_car(), v0);
      single.input.road = &road;
      single.input.brake_nm = full.input.brake_nm;
      single.run(40.0, 0.005);
      const double least = v0 * v0 / (2.0 * friction * full.params.tyre.p.long_peak * kGravity_mps2);
      EXPECT_LT(std::abs(full.state.u_mps), 1e-3);
      EXPECT_EQ(single.state.u_mps, 0.0);
      EXPECT_GE(full.state.x_m, least);
      EXPECT_GE(single.state.x_m, least);
      // Both axles at their limit come within a few percent of it: the sliding tyre has a little less than its peak.
      if (torque == 1e4) {
        EXPECT_LT(single.state.x_m, 1.1 * least);
      }
    }
  }
}

}  // namespace
}  // namespace phare
