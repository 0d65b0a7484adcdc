// Signs, message conversion, hash, fading.
#include "vehicle_dynamics/state.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include "config/base/conventions.h"
#include "test_car.h"

namespace phare {
namespace {

TEST(Conventions, NoseDownIsBeamDown) {
  EXPECT_LT(aim_from_pitch_rad(0.01), 0.0);
  const glm::dvec3 forward = world_from_car(0.0, 0.01, 0.0)[0];
  EXPECT_NEAR(std::atan2(forward.z, forward.x), aim_from_pitch_rad(0.01), 1e-15);
}

TEST(Conventions, RotationIsYawPitchRoll) {
  const glm::dmat3 r = world_from_car(0.2, -0.3, 1.1);
  EXPECT_NEAR(glm::determinant(r), 1.0, 1e-15);
  const glm::dmat3 product = world_from_car(0, 0, 1.1) * world_from_car(0, -0.3, 0) * world_from_car(0.2, 0, 0);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) EXPECT_NEAR(r[column][row], product[column][row], 1e-15);
  EXPECT_NEAR(world_from_car(0, 0, 0.5 * std::numbers::pi)[0].y, 1.0, 1e-15);  // yaw > 0: to the left
  EXPECT_GT(world_from_car(0.1, 0, 0)[1].z, 0.0);  // roll > 0: left side up, right side down
}

TEST(State, HashSeesEveryBit) {
  CarState a, b;
  EXPECT_EQ(state_hash(a), state_hash(b));
  b.contact_z_m[3] = std::nextafter(0.0, 1.0);
  EXPECT_NE(state_hash(a), state_hash(b));
  b = a;
  b.x_m = -0.0;
  EXPECT_NE(state_hash(a), state_hash(b));
}

TEST(State, MessageAndBack) {
  CarState s;
  s.x_m = 10.0, s.y_m = 20.0, s.z_m = 3.0, s.yaw_rad = 40.0, s.speed_mps = 12.0, s.steer_rad = 0.1;
  s.road_pitch_rad = 0.05, s.road_roll_rad = -0.02, s.pitch_rad = 0.01, s.roll_rad = 0.004, s.heave_m = -0.01;
  s.heave_rate_mps = 0.02;
  const VehicleState m = to_message(s);
  EXPECT_LE(std::abs(m.yaw_rad), std::numbers::pi);
  EXPECT_DOUBLE_EQ(m.z_m, 2.99);
  EXPECT_DOUBLE_EQ(m.pitch_rad, 0.06);
  EXPECT_NEAR(std::hypot(m.vx_mps, m.vy_mps, m.vz_mps - 0.02), 12.0, 1e-12);
  const CarState back = from_message(m, 2.5, 1.5);
  EXPECT_NEAR(back.road_pitch_rad, s.road_pitch_rad, 1e-15);
  EXPECT_NEAR(back.heave_rate_mps, s.heave_rate_mps, 1e-14);
  EXPECT_NEAR(back.z_m, s.z_m, 1e-15);
}

TEST(Controls, FadeInSilence) {
  using namespace std::chrono_literals;
  const Controls c{.steering_wheel_rad = 1.0, .accelerator_01 = 0.8, .brake_01 = 0.4};
  EXPECT_EQ(faded(c, 400ms).accelerator_01, 0.8);
  EXPECT_NEAR(faded(c, 1000ms).accelerator_01, 0.4, 1e-12);
  EXPECT_EQ(faded(c, 1500ms).accelerator_01, 0.0);
  EXPECT_EQ(faded(c, 1h).brake_01, 0.0);
  EXPECT_EQ(faded(c, 1h).steering_wheel_rad, 1.0);
}

}  // namespace
}  // namespace phare
