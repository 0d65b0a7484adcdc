// Cars that slide far or come down on their roofs: whatever the tyres are dragged through, no state grows without
// bound.
#include <gtest/gtest.h>

#include "config/base/conventions.h"
#include "full_car.h"

namespace phare {
namespace {

using test::Drive;

// A slip is what the patch is dragged by over what carries it away, and that is never less than a tenth of the slide:
// 10 at most, once settled. A coarse step may overshoot that, by less than as much again.
constexpr double kMostSlip = 20.0;

double largest_slip(const full::State& s) {
  double most = 0.0;
  for (std::size_t i = 0; i < 4; ++i) most = std::max({most, std::abs(s.kappa[i]), std::abs(s.tan_alpha[i])});
  return std::isfinite(most) ? most : 1e300;
}

// Thrown sideways at 20 m/s with turned front wheels, locked or free: what rolls through a front tyre's patch is then
// the slide, not the car's speed along its own axis.
TEST(HardCase, C08SlidingSidewaysOnTurnedWheels) {
  Road wet;
  wet.friction_everywhere = 0.3;
  for (const char* file : {"bmw_320i.toml", "hatchback.toml"})
    for (const Integrator integrator : {Integrator::kSemiImplicitEuler, Integrator::kEtd2, Integrator::kRk4})
      for (const double steer : {0.0, 0.3, 0.6})
        for (const double dt : {0.001, 0.002, 0.005, 0.010})
          for (const double brake_nm : {0.0, 1e5}) {
            full::Params p = test::full_car(file);
            p.integrator = integrator;
            Drive d(p, 0.0, &wet);
            d.state.v_mps = 20.0;
            d.input.steer_rad = steer;
            d.input.brake_nm.fill(brake_nm);
            double most = 0.0;
            d.run(6.0, dt, [&](const Drive& now) { most = std::max(most, largest_slip(now.state)); });
            EXPECT_LE(most, kMostSlip) << file << " method " << static_cast<int>(integrator) << " steer " << steer
                                       << " step " << dt << " brake " << brake_nm;
            EXPECT_TRUE(test::finite(d.state));
          }
}

// After a spin the car comes to a stand where it is: what the carcasses give back, 15 mm, and no creeping on.
TEST(HardCase, C08StandsAfterASpin) {
  for (const double friction : {0.1, 0.3, 0.6})
    for (const bool hard : {true, false})
      for (const double dt : {0.002, 0.005}) {
        Road wet;
        wet.friction_everywhere = friction;
        Drive d(hard ? test::hard_car() : test::full_car("hatchback.toml"), 20.0, &wet);
        d.state.r_radps = 4.0;
        d.state.spin_radps = {};
        d.input.brake_nm.fill(1e5);
        const auto slow = [&] {
          return std::hypot(d.state.u_mps, d.state.v_mps) < 0.05 && std::abs(d.state.r_radps) < 0.05;
        };
        while (!slow() && d.time_s < 40.0) d.step(dt);
        ASSERT_LT(d.time_s, 40.0);
        const double x = d.state.x_m, y = d.state.y_m;
        d.run(1.5, dt);
        EXPECT_LT(std::hypot(d.state.u_mps, d.state.v_mps), 1e-3) << friction << ' ' << hard << ' ' << dt;
        d.run(10.0, dt);
        EXPECT_LT(std::hypot(d.state.x_m - x, d.state.y_m - y), 0.016) << friction << ' ' << hard << ' ' << dt;
        EXPECT_LT(std::hypot(d.state.u_mps, d.state.v_mps), 1e-6);
      }
}

// Class E at the limit of grip turns the 320i over; then its wheels face any way, and its state stays finite.
TEST(HardCase, C14TurnedOver) {
  Road rough;
  rough.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kE, 11, 200.0));
  rough.friction = {{.from_m = 20.0, .to_m = 60.0, .left = 0.2, .right = 0.9}};
  for (const double dt : {0.001, 0.002}) {
    Drive d(test::full_car(), 25.0, &rough);
    d.input.steer_rad = 0.08;
    double most = 0.0, furthest = 0.0;
    d.run(6.0, dt, [&](Drive& now) {
      if (now.time_s > 1.0) now.input.brake_nm = {900.0, 900.0, 450.0, 450.0};
      most = std::max(most, largest_slip(now.state));
      furthest = std::max(furthest, std::abs(now.roll_rad()));
    });
    EXPECT_TRUE(test::finite(d.state)) << dt;
    EXPECT_LE(most, 1e3) << dt;  // in the air nothing limits it but the speeds' ratio
    EXPECT_GT(furthest, 1.5);
  }
}

}  // namespace
}  // namespace phare
