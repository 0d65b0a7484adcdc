// Unit: projection, frustum and rays of a view agree with one another.
#include "visual/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>

#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

Camera perspective() {
  Camera camera;
  camera.eye_m = {5e6, -3e6, 1.2};
  camera.world_from_eye = aim_rotation(0.4, -0.1, 0.05);
  camera.fov_horizontal_rad = 1.1;
  return camera;
}

Camera from_above() {
  Camera camera;
  camera.eye_m = {100.0, 20.0, 80.0};
  camera.world_from_eye = glm::dmat3(glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0));
  camera.orthographic_width_m = 60.0;
  camera.far_m = 200.0;
  return camera;
}

/// The right half of a split picture.
Camera right_half() {
  Camera camera = perspective();
  camera.seen_from_01 = 0.5;
  return camera;
}

/// Pixel of a world point, by the projection.
glm::dvec2 pixel_of(const ViewGeometry& view, const glm::dvec3& world_m, int width, int height) {
  const glm::dvec4 clip = view.clip_from_eye() * glm::dvec4(world_m - view.camera().eye_m, 1.0);
  return {(clip.x / clip.w + 1.0) * 0.5 * width - 0.5, (clip.y / clip.w + 1.0) * 0.5 * height - 0.5};
}

TEST(View, ARayThroughAPixelProjectsBackToIt) {
  for (const Camera& camera : {perspective(), from_above(), right_half()}) {
    const ViewGeometry view(camera, 16.0 / 9.0);
    for (const auto& [x, y] :
         {std::pair(0.0, 0.0), std::pair(1279.0, 719.0), std::pair(639.5, 359.5), std::pair(200.25, 50.75)}) {
      const Ray ray = view.ray_through(x, y, 1280, 720);
      // Positions of 5e6 m keep 1e-9 m in double; 50 m away that is 2e-11 rad, 1e-8 pixels.
      const glm::dvec2 back = pixel_of(view, ray.origin_m + 50.0 * ray.direction, 1280, 720);
      EXPECT_NEAR(back.x, x, 1e-6);
      EXPECT_NEAR(back.y, y, 1e-6);
    }
  }
}

// Each half of a split picture sees what the whole one sees there.
TEST(View, HalvesAreThoseOfTheWhole) {
  for (Camera camera : {perspective(), from_above()}) {
    const ViewGeometry whole(camera, 16.0 / 9.0);
    for (const int side : {0, 1}) {
      camera.seen_from_01 = 0.5 * side, camera.seen_to_01 = 0.5 + 0.5 * side;
      const ViewGeometry half(camera, 8.0 / 9.0);
      for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(639.0, 719.0), std::pair(100.25, 500.5)}) {
        const Ray part = half.ray_through(x, y, 640, 720), all = whole.ray_through(x + 640 * side, y, 1280, 720);
        EXPECT_LT(glm::length(part.direction - all.direction), 1e-12);
        EXPECT_LT(glm::length(part.origin_m - all.origin_m), 1e-8);  // of 5e6 m in double
      }
      const glm::dvec4 corner = half.direction_from_clip() * glm::dvec4(-1.0, -1.0, 1.0, 0.0),
                       there = whole.direction_from_clip() * glm::dvec4(-1.0 + side, -1.0, 1.0, 0.0);
      EXPECT_LT(glm::length(corner - there), 1e-12);
      for (const std::size_t i : {std::size_t(side), std::size_t(side) + 2})
        EXPECT_LT(glm::length(half.edges()[i].direction - whole.edges()[i].direction), 1e-12) << i;
    }
  }
}

TEST(View, DirectionOfAPixelIsThatOfItsRay) {
  const ViewGeometry view(perspective(), 16.0 / 9.0);
  const glm::dvec4 direction = view.direction_from_clip() * glm::dvec4(0.3, -0.7, 1.0, 0.0);
  const Ray ray = view.ray_through((0.3 + 1.0) * 640.0 - 0.5, (-0.7 + 1.0) * 360.0 - 0.5, 1280, 720);
  EXPECT_LT(glm::length(glm::normalize(glm::dvec3(direction)) - ray.direction), 1e-12);
}

// A point inside the picture is never culled; one well outside is.
TEST(View, FrustumAndProjectionAgree) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> at(-60.0, 60.0);
  for (const Camera& camera : {perspective(), from_above(), right_half()}) {
    const ViewGeometry view(camera, 16.0 / 9.0 * (camera.seen_to_01 - camera.seen_from_01));
    int in = 0, out = 0;
    for (int i = 0; i < 40000; ++i) {
      const glm::dvec3 point = camera.eye_m + glm::dvec3(at(random), at(random), at(random));
      const glm::dvec4 clip = view.clip_from_eye() * glm::dvec4(point - camera.eye_m, 1.0);
      const bool ahead = glm::dot(point - camera.eye_m, camera.world_from_eye[0]) > 0.0;
      const double beyond = std::max(std::abs(clip.x / clip.w), std::abs(clip.y / clip.w));
      const bool seen = view.sees(point, point).has_value();
      if (ahead && beyond < 1.0 - 1e-9) {
        ++in;
        EXPECT_TRUE(seen);
      }
      if (!ahead || beyond > 1.0 + 1e-9) {
        ++out;
        EXPECT_FALSE(seen);
      }
      EXPECT_EQ(view.sees_ball(point, 0.0), seen);
    }
    EXPECT_GT(in, 300);
    EXPECT_GT(out, 3000);
  }
}

}  // namespace
}  // namespace phare
