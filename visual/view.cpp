#include "visual/view.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace phare {

ViewGeometry::ViewGeometry(const Camera& camera, double aspect) : camera_(camera), aspect_(aspect) {
  const bool parallel = camera.orthographic_width_m > 0.0;
  const double whole = parallel ? 0.5 * camera.orthographic_width_m : std::tan(0.5 * camera.fov_horizontal_rad);
  half_right_ = whole * (camera.seen_to_01 - camera.seen_from_01);
  middle_right_ = whole * (camera.seen_to_01 + camera.seen_from_01 - 1.0);
  half_up_ = half_right_ / aspect;
  const glm::dvec3 forward = camera.world_from_eye[0], left = camera.world_from_eye[1], up = camera.world_from_eye[2];
  if (parallel) {
    inward_ = {glm::dvec4(left, half_right_ + middle_right_), glm::dvec4(-left, half_right_ - middle_right_),
               glm::dvec4(up, half_up_), glm::dvec4(-up, half_up_), glm::dvec4(forward, 0.0)};
  } else {
    inward_ = {glm::dvec4(glm::normalize(forward * (half_right_ + middle_right_) + left), 0.0),
               glm::dvec4(glm::normalize(forward * (half_right_ - middle_right_) - left), 0.0),
               glm::dvec4(glm::normalize(forward * half_up_ + up), 0.0),
               glm::dvec4(glm::normalize(forward * half_up_ - up), 0.0), glm::dvec4(forward, 0.0)};
  }
}

glm::dmat4 ViewGeometry::clip_from_eye() const {
  const glm::dvec3 forward = camera_.world_from_eye[0], left = camera_.world_from_eye[1],
                   up = camera_.world_from_eye[2];
  const bool parallel = camera_.orthographic_width_m > 0.0;
  glm::dmat4 rows(0.0);  // rows[i] is row i; transposed below
  const double aside = middle_right_ / half_right_;
  rows[0] = parallel ? glm::dvec4(-left / half_right_, -aside) : glm::dvec4(-left / half_right_ - forward * aside, 0.0);
  rows[1] = glm::dvec4(-up / half_up_, 0.0);
  rows[2] = parallel ? glm::dvec4(-forward / camera_.far_m, 1.0) : glm::dvec4(0, 0, 0, camera_.near_m);
  rows[3] = parallel ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(forward, 0.0);
  return glm::transpose(rows);
}

glm::dmat4 ViewGeometry::direction_from_clip() const {
  const glm::dvec3 forward = camera_.world_from_eye[0], left = camera_.world_from_eye[1],
                   up = camera_.world_from_eye[2];
  const bool parallel = camera_.orthographic_width_m > 0.0;
  return {glm::dvec4(parallel ? glm::dvec3(0.0) : -left * half_right_, 0.0),
          glm::dvec4(parallel ? glm::dvec3(0.0) : -up * half_up_, 0.0),
          glm::dvec4(parallel ? forward : forward - left * middle_right_, 0.0), glm::dvec4(0.0)};
}

std::optional<double> ViewGeometry::sees(const glm::dvec3& low_m, const glm::dvec3& high_m) const {
  const glm::dvec3 centre = (low_m + high_m) * 0.5 - camera_.eye_m;
  const glm::dvec3 half = (high_m - low_m) * 0.5;
  for (const glm::dvec4& plane : inward_) {
    const glm::dvec3 normal(plane);
    if (glm::dot(normal, centre) + glm::dot(glm::abs(normal), half) + plane.w < 0.0) return std::nullopt;
  }
  const double distance_m = glm::length(glm::max(glm::abs(centre) - half, glm::dvec3(0.0)));
  return distance_m > camera_.far_m ? std::nullopt : std::optional(distance_m);
}

bool ViewGeometry::sees_ball(const glm::dvec3& centre_m, double radius_m) const {
  const glm::dvec3 centre = centre_m - camera_.eye_m;
  for (const glm::dvec4& plane : inward_)
    if (glm::dot(glm::dvec3(plane), centre) + plane.w < -radius_m) return false;
  return glm::length(centre) - radius_m <= camera_.far_m;
}

std::array<Ray, 4> ViewGeometry::edges() const {
  std::array<Ray, 4> edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const glm::dvec3 aside(0.0, (i % 2 == 0 ? half_right_ : -half_right_) - middle_right_,
                           i < 2 ? half_up_ : -half_up_);
    const glm::dmat3& eye = camera_.world_from_eye;
    if (camera_.orthographic_width_m > 0.0)
      edges[i] = {camera_.eye_m + eye * aside, eye[0]};
    else
      edges[i] = {camera_.eye_m, glm::normalize(eye * (glm::dvec3(1.0, 0.0, 0.0) + aside))};
  }
  return edges;
}

bool ViewGeometry::mirrored() const {
  return glm::determinant(camera_.world_from_eye) < 0.0;
}

Ray ViewGeometry::ray_through(double x_px, double y_px, int width_px, int height_px) const {
  // Right and up of the picture, -1 to 1 across its width.
  const double right = (2.0 * (x_px + 0.5) - width_px) / width_px;
  const double up = (height_px - 2.0 * (y_px + 0.5)) / width_px;
  const glm::dmat3& eye = camera_.world_from_eye;
  const glm::dvec3 aside(0.0, -right * half_right_ - middle_right_, up * half_right_);
  if (camera_.orthographic_width_m > 0.0) return {camera_.eye_m + eye * aside, eye[0]};
  return {camera_.eye_m, glm::normalize(eye * (glm::dvec3(1.0, 0.0, 0.0) + aside))};
}

}  // namespace phare
