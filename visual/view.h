// What an eye sees of the world, derived once for every pass, for culling and for the mouse: projection, frustum, rays.
// World: x forward, y left, z up (ISO 8855), double; the device gets float32 relative to the eye.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace phare {

/// An eye in the world. Perspective, or from above with parallel rays.
struct Camera {
  glm::dvec3 eye_m{0.0};
  glm::dmat3 world_from_eye{1.0};  ///< columns: forward, left, up
  double fov_horizontal_rad = 1.0471975511965976;
  double orthographic_width_m = 0.0;  ///< > 0: parallel projection of that width
  /// Of the whole width of the field of view the share from its left edge that is seen: a half of a split picture.
  double seen_from_01 = 0.0, seen_to_01 = 1.0;
  double near_m = 0.15;
  double far_m = 3000.0;
};

struct Ray {
  glm::dvec3 origin_m{0.0};
  glm::dvec3 direction{1.0, 0.0, 0.0};  ///< unit
};

/// A camera and the shape of the picture it makes.
class ViewGeometry {
 public:
  /// `aspect`: width of the picture over its height.
  ViewGeometry(const Camera& camera, double aspect);

  const Camera& camera() const { return camera_; }
  double aspect() const { return aspect_; }
  /// Half the height of the picture: a tangent, or m where the rays are parallel.
  double half_up() const { return half_up_; }

  /// Clip space of Vulkan (x right, y down, z 1 at the near plane and 0 at infinity: reversed, for float depth) from
  /// the world turned to the eye's place (not its direction), m.
  glm::dmat4 clip_from_eye() const;

  /// Direction of a pixel, relative to the eye: from (x, y, ·, 1) of clip space. Of parallel rays: the one direction.
  glm::dmat4 direction_from_clip() const;

  /// Distance in m from the eye of the box [low, high] of the world, 0 around the eye; nothing if none of it is in
  /// view or it is beyond `camera.far_m`. A box near an edge of the view may count as seen though it is not.
  std::optional<double> sees(const glm::dvec3& low_m, const glm::dvec3& high_m) const;

  /// The same for a ball.
  bool sees_ball(const glm::dvec3& centre_m, double radius_m) const;

  /// Sides of the view and the plane behind which it ends, relative to the eye: unit normal inward, and offset in m.
  const std::array<glm::dvec4, 5>& inward() const { return inward_; }
  /// Along its four edges.
  std::array<Ray, 4> edges() const;
  /// Left and right are swapped, as in a mirror: `world_from_eye` has its third column for a left hand.
  bool mirrored() const;

  /// Through the middle of a pixel, counted from the top left of a picture of this size.
  Ray ray_through(double x_px, double y_px, int width_px, int height_px) const;

 private:
  Camera camera_;
  double aspect_;
  double half_right_, half_up_;       // of the picture: tangents, or m where the rays are parallel
  double middle_right_;               // of the picture, from where the eye looks
  std::array<glm::dvec4, 5> inward_;  // planes of the view, relative to the eye: unit normal and offset in m
};

}  // namespace phare
