// Friction along the way: from CSV, from the scene's materials, from a flag; what the car makes of it, and what is
// wrong with bad files.
#include "config/road/road_friction.h"

#include <gtest/gtest.h>

#include "batch_files.h"
#include "config/base/conventions.h"
#include "full_car.h"
#include "vehicle_dynamics/models/powertrain.h"
#include "vehicle_dynamics/road_laid.h"

namespace phare {
namespace {

using test::written;

TEST(RoadFriction, ZonesOfACsvHoldUntilTheNext) {
  const auto file = written("ice.csv", "x_m,friction_left,friction_right\n0,1,1\n40,0.8,0.1\n60,0.8,0.1\n80,1,1\n");
  const auto zones = read_friction(file);
  ASSERT_TRUE(zones.ok()) << zones.error().text();
  ASSERT_EQ(zones->size(), 3u);
  Road road;
  const Status laid = lay({.friction = 0.6, .csv_file = file}, {}, road);
  ASSERT_TRUE(laid.ok()) << laid.error().text();
  EXPECT_EQ(road.laid(-1.0).friction[0], 0.6);  // before the first row: of the whole road
  EXPECT_EQ(road.laid(50.0).friction[0], 0.8);
  EXPECT_EQ(road.laid(70.0).friction[1], 0.1);
  EXPECT_EQ(road.laid(1e6).friction[1], 1.0);
  EXPECT_TRUE(road.profiles.empty());
  EXPECT_EQ(text(road), "friction 0.6, 3 zones of friction");
}

TEST(RoadFriction, LiesBesideHeightsInOneFile) {
  const auto file = written("both.csv", "x_m,z_m,friction\n0,0,1\n10,0.1,0.3\n20,0.1,0.3\n");
  Road road;
  ASSERT_TRUE(lay({.csv_file = file}, {}, road).ok());
  EXPECT_EQ(road.profiles.size(), 1u);
  EXPECT_EQ(road.laid(15.0).friction[0], 0.3);
}

TEST(RoadFriction, BadFilesAreNamed) {
  const auto said = [](const char* content) {
    const auto zones = read_friction(written("bad.csv", content));
    return zones ? std::string() : zones.error().text();
  };
  EXPECT_NE(said("x_m,friction\n0,1\n10,0\n").find("bad.csv:3: friction 0.000000 is outside"), std::string::npos);
  EXPECT_NE(said("x_m,friction\n0,1\n0,0.5\n").find("bad.csv:3: x_m does not rise"), std::string::npos);
  EXPECT_NE(said("x_m,friction_left\n0,1\n").find("one track only"), std::string::npos);
  EXPECT_NE(said("friction\n1\n").find("no column x_m"), std::string::npos);
  std::string many = "x_m,friction\n";
  for (int i = 0; i < 100; ++i) many += std::to_string(i) + "," + (i % 2 == 0 ? "1" : "0.5") + "\n";
  EXPECT_NE(said(many.c_str()).find("more than 64"), std::string::npos);
}

// A pond of ice on the scene's own triangles: under the wheels on it, at every level that has tyres.
TEST(RoadFriction, OfTheMaterialUnderEachWheel) {
  const auto patch = [](double from_x, double to_x, double from_y, double to_y, double friction) {
    const glm::dvec3 a(from_x, from_y, 0.0), b(to_x, from_y, 0.0), c(to_x, to_y, 0.0), d(from_x, to_y, 0.0);
    return std::array<RoadSurface::Triangle, 2>{RoadSurface::Triangle{{a, b, c}, true, friction},
                                                RoadSurface::Triangle{{a, c, d}, true, friction}};
  };
  std::vector<RoadSurface::Triangle> triangles;
  for (const auto& part : {patch(-50, 300, 0, 20, 1.0), patch(-50, 300, -20, 0, 0.1)})
    triangles.insert(triangles.end(), part.begin(), part.end());
  const RoadSurface surface = RoadSurface::from_triangles(triangles);
  EXPECT_TRUE(surface.has_friction());
  EXPECT_NEAR(surface.friction(10.0, -5.0), 0.1, 1e-7);
  EXPECT_EQ(surface.friction(10.0, 5.0), 1.0);
  Road road;
  road.mesh = &surface;
  test::Drive d(test::full_car(), 20.0, &road);
  const auto wheels = full::wheels(d.params, d.input, d.state);
  EXPECT_NEAR(wheels.peak_slip[1] / wheels.peak_slip[0], 0.1, 1e-6);
  d.input.brake_nm.fill(1e5);  // locked: left and right slide on what they are on
  d.run(0.2, 0.002);
  const full::Forces f = d.forces();
  EXPECT_LT(f.fx_n[1] / f.load_n[1] / (f.fx_n[0] / f.load_n[0]), 0.2);
  test::Track single(test::single_car(), 20.0);
  single.input.road = &road;
  EXPECT_NEAR(single_track::held(single.params, single.input, single.state, 0.005).friction, 0.55, 1e-6);
}

// Hard case 7 with pedals: braking to a stand on ice to the right and asphalt to the left. ABS keeps every wheel
// turning, the rear axle by its worse wheel, so a driver has a car to steer: held on its line by small angles it stops
// within its lane, with more than the ice alone would give.
TEST(HardCase, C07AbsOnSplitFriction) {
  for (const char* file : {"bmw_320i.toml", "hatchback.toml", "vw_vanagon.toml"})
    for (const double dt : {0.001, 0.002}) {
      const VehicleParams vehicle = test::car(file);
      const full::Params p = *full::params_of(vehicle, file);
      Road split;
      split.friction = {{.from_m = -1e9, .to_m = 1e9, .left = 0.8, .right = 0.1}};
      const double v0 = 20.0;
      test::Drive d(p, v0, &split);
      powertrain::State power;
      double aside_m = 0.0, yaw_rad = 0.0, locked_s = 0.0;
      while (d.state.u_mps > 0.5 && d.time_s < 60.0) {
        const auto torque = powertrain::advance(vehicle, {.brake_01 = 1.0, .gear = Gear::kNeutral}, d.state.u_mps,
                                                full::wheels(p, d.input, d.state), power, dt);
        d.input.brake_nm = torque.brake_nm;
        const full::Forces f = d.forces();
        // A driver who holds the lane: heading, and half a second ahead; the wheel turned at 1 rad/s of road wheel.
        const double wanted = std::clamp(
            -0.15 * (d.state.y_m + 0.5 * d.state.v_mps) - 1.2 * f.yaw_rad - 0.25 * d.state.r_radps, -0.5, 0.5);
        d.input.steer_rad += std::clamp(wanted - d.input.steer_rad, -dt, dt);
        d.step(dt);
        ASSERT_LE(test::friction_use(p, d.forces(), {0.8, 0.1, 0.8, 0.1}), 1.001) << file << ' ' << d.time_s;
        if (d.state.u_mps > 5.0)
          for (const double spin : d.state.spin_radps) locked_s += spin == 0.0 ? 0.25 * dt : 0.0;
        aside_m = std::max(aside_m, std::abs(d.state.y_m)), yaw_rad = std::max(yaw_rad, std::abs(f.yaw_rad));
      }
      const double mean_mps2 = v0 * v0 / 2.0 / d.state.x_m, peak = p.tyre.p.long_peak * kGravity_mps2;
      EXPECT_LT(aside_m, 1.0) << file << ' ' << dt;
      EXPECT_LT(yaw_rad, 0.3) << file << ' ' << dt;
      EXPECT_LT(locked_s, 0.2) << file << ' ' << dt;
      EXPECT_GT(mean_mps2, 1.5 * 0.1 * peak) << file << ' ' << dt;
      EXPECT_LT(mean_mps2, 0.45 * peak) << file << ' ' << dt;  // the mean of both sides
      std::printf("%s, %g ms: %.1f m, %.2f m/s2 of %.2f; %.2f m and %.3f rad aside\n", file, 1e3 * dt, d.state.x_m,
                  mean_mps2, 0.45 * peak, aside_m, yaw_rad);
    }
}

}  // namespace
}  // namespace phare
