#include "visual/process/pick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/visual_process/ground_square.h"
#include "visual/process/cameras.h"

namespace phare {
namespace {

TEST(Pick, MeetsTheGroundWhereGeometrySays) {
  const Scene scene = ground_square(1000.0);
  const Ray ray{{1000.0, 5.0, 12.0}, glm::dvec3{std::sqrt(0.5), 0.0, -std::sqrt(0.5)}};
  const auto point = pick(scene, ray);
  ASSERT_TRUE(point.has_value());
  EXPECT_NEAR(point->position_m.x, 1010.0, 1e-9);
  EXPECT_NEAR(point->position_m.y, 5.0, 1e-9);
  EXPECT_NEAR(point->position_m.z, 2.0, 1e-9);
  EXPECT_NEAR(point->normal.z, 1.0, 1e-12);
  EXPECT_FALSE(pick(scene, {{1000.0, 5.0, 12.0}, {0.0, 0.0, 1.0}}).has_value());
  EXPECT_FALSE(pick(scene, ray, 5.0).has_value());
}

TEST(RayThrough, MiddleAndEdgesOfThePicture) {
  Camera camera;  // looks along x
  camera.fov_horizontal_rad = M_PI / 2;
  const Ray middle = ViewGeometry(camera, 200.0 / 100.0).ray_through(99.5, 49.5, 200, 100);
  EXPECT_NEAR(middle.direction.x, 1.0, 1e-12);
  const Ray right = ViewGeometry(camera, 200.0 / 100.0)
                        .ray_through(199.5, 49.5, 200, 100);  // the right edge: 45° to the right, y < 0
  EXPECT_NEAR(right.direction.y, -std::sqrt(0.5), 1e-12);
  const Ray top = ViewGeometry(camera, 200.0 / 100.0).ray_through(99.5, -0.5, 200, 100);
  EXPECT_GT(top.direction.z, 0.4);
}

TEST(BirdsEye, IsAMapAheadOfTheCar) {
  VehicleState pose;
  pose.x_m = 1000.0;
  pose.z_m = 2.0;
  pose.pitch_rad = 0.05;  // does not tilt the map
  const Camera camera = birds_eye_camera(pose);
  const auto near_left =
      pick(ground_square(1000.0), ViewGeometry(camera, 1000.0 / 400.0).ray_through(-0.5, -0.5, 1000, 400));
  ASSERT_TRUE(near_left.has_value());
  EXPECT_NEAR(near_left->position_m.x, 1000.0 + kBirdsEyeStart_m, 1e-9);
  EXPECT_NEAR(near_left->position_m.y, 20.0, 1e-9);
  const auto far_right =
      pick(ground_square(1000.0), ViewGeometry(camera, 1000.0 / 400.0).ray_through(999.5 - 1e-6, 399.5, 1000, 400));
  ASSERT_TRUE(far_right.has_value());
  EXPECT_NEAR(far_right->position_m.x, 1100.0, 1e-6);
  EXPECT_NEAR(far_right->position_m.y, -20.0, 1e-9);
}

TEST(DriverCamera, MovesWithTheBody) {
  ChannelConfig channel;
  VehicleState pose;
  pose.pitch_rad = 0.02;
  const Camera camera = driver_camera(channel, pose);
  EXPECT_NEAR(camera.world_from_eye[0].z, -std::sin(0.02), 1e-12);  // nose down, the eye looks down
  EXPECT_LT(camera.eye_m.z, channel.eye_m.z);
}

}  // namespace
}  // namespace phare
