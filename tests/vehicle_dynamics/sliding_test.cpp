// Cars that slide far or come down on their roofs: whatever the tyres are dragged through, no state grows without
// bound.
#include <gtest/gtest.h>

#include "config/conventions.h"
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
            if (integrator == Integrator::kRk4 && dt > 0.002) continue;  // longer than what real time runs
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

}  // namespace
}  // namespace phare
