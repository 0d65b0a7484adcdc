#include "visual/process/pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

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

/// Where a point of the world is seen: shares of the picture to the right and down.
glm::dvec2 seen_at(const Camera& camera, const glm::dvec3& world_m) {
  const glm::dvec4 clip = ViewGeometry(camera, 1.5).clip_from_eye() * glm::dvec4(world_m - camera.eye_m, 1.0);
  EXPECT_GT(clip.w, 0.0) << "behind the eye";
  return {0.5 + 0.5 * clip.x / clip.w, 0.5 + 0.5 * clip.y / clip.w};
}

TEST(Cameras, TheOncomingDriverLooksAtTheCar) {
  VehicleState pose;
  pose.x_m = 100.0, pose.y_m = 20.0, pose.z_m = 3.0, pose.yaw_rad = 0.5 * M_PI;  // heads along y
  const Camera camera = oncoming_camera(ChannelConfig{}, pose, 5.0);
  EXPECT_NEAR(camera.eye_m.y, 70.0, 1e-9);
  EXPECT_NEAR(camera.eye_m.x, 96.5, 1e-9) << "in the lane on the car's left";
  EXPECT_NEAR(camera.eye_m.z, 6.12, 1e-9) << "above the ground there";
  const glm::dvec2 car = seen_at(camera, {100.0, 20.0, 3.7});
  EXPECT_NEAR(car.x, 0.5, 1e-9);
  EXPECT_NEAR(car.y, 0.5, 1e-9);
  EXPECT_GT(seen_at(camera, {97.0, 20.0, 3.0}).x, 0.5) << "the car's left is to the right of who meets it";
}

TEST(Cameras, MirrorsTurnLeftAndRightRound) {
  const VehicleState pose;
  ChannelConfig channel;
  // Behind the car to its left: on the left of each mirror, as the driver sees it on his left.
  const glm::dvec3 left_behind_m{-40.0, 4.0, 1.2}, right_behind_m{-40.0, -4.0, 1.2};
  const Camera inner = mirror_camera(CameraKind::kInnerMirror, channel, pose);
  EXPECT_LT(seen_at(inner, left_behind_m).x, 0.5);
  EXPECT_GT(seen_at(inner, right_behind_m).x, 0.5);
  // What is right behind the flank is at the mirror's inner edge, what is beside at its outer.
  const Camera left = mirror_camera(CameraKind::kLeftMirror, channel, pose);
  const double inner_edge = seen_at(left, {-60.0, 0.95, 1.0}).x, outside = seen_at(left, {-40.0, 8.0, 1.0}).x;
  EXPECT_NEAR(inner_edge, 1.0, 0.02);
  EXPECT_LT(outside, 0.6);
  const Camera right = mirror_camera(CameraKind::kRightMirror, channel, pose);
  EXPECT_NEAR(seen_at(right, {-60.0, -0.95, 1.0}).x, 0.0, 0.02);
  EXPECT_TRUE(ViewGeometry(right, 1.5).mirrored());
  FrameInput picture;
  picture.more_views = mirror_views(picture, channel, pose);
  EXPECT_EQ(picture.more_views.size(), 3u);
  lay_out(picture, Layout::kSplit, Camera{}, "other");
  ASSERT_EQ(picture.more_views.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LE(picture.more_views[i].part.left_01 + picture.more_views[i].part.width_01, 0.5)
        << "the other half would lie over it";
}

TEST(Cameras, TheFreeEyeStandsOnTheCarOrInTheWorld) {
  VehicleState pose;
  pose.x_m = 10.0, pose.yaw_rad = 0.5 * M_PI, pose.pitch_rad = 0.1;
  FreeEye eye{Probe::Frame::kCar, {-6.0, 2.0, 2.0}, 0.0, -10.0, 45.0};
  Camera camera = free_camera(eye, pose);
  EXPECT_NEAR(camera.eye_m.x, 8.0, 1e-9);
  EXPECT_NEAR(camera.eye_m.y, -6.0, 1e-9);
  EXPECT_NEAR(camera.world_from_eye[0].y, std::cos(10.0 * M_PI / 180.0), 1e-9)
      << "level: the body's pitch is not in it";
  EXPECT_NEAR(camera.world_from_eye[0].z, -std::sin(10.0 * M_PI / 180.0), 1e-9);
  eye.frame = Probe::Frame::kWorld;
  camera = free_camera(eye, pose);
  EXPECT_EQ(camera.eye_m, eye.position_m);
  EXPECT_NEAR(camera.world_from_eye[0].x, std::cos(10.0 * M_PI / 180.0), 1e-9);
}

// What warms up the pipelines sees every block of the scene, and through air: parallel rays have none.
TEST(Cameras, TheOverviewSeesTheWholeSceneThroughAir) {
  Scene scene;
  for (const double x : {-1500.0, 0.0, 700.0})
    for (const double y : {-300.0, 400.0}) {
      SceneChunk chunk;
      chunk.low_m = {x, y, -5.0}, chunk.high_m = {x + 10.0, y + 10.0, 12.0};
      scene.chunks.push_back(chunk);
    }
  const Camera camera = overview_camera(scene);
  EXPECT_EQ(camera.orthographic_width_m, 0.0);
  for (const double aspect : {1.0, 16.0 / 9.0, 4.0}) {
    const ViewGeometry view(camera, aspect);
    for (const SceneChunk& chunk : scene.chunks)
      for (const glm::dvec3& corner : {chunk.low_m, chunk.high_m}) {
        const glm::dvec4 clip = view.clip_from_eye() * glm::dvec4(corner - camera.eye_m, 1.0);
        EXPECT_LE(std::abs(clip.x), clip.w) << aspect;
        EXPECT_LE(std::abs(clip.y), clip.w) << aspect;
        EXPECT_TRUE(view.sees(corner, corner)) << aspect;
      }
  }
}

}  // namespace
}  // namespace phare
