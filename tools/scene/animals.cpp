// A roe deer. Proportions by eye: 0.75 m at the shoulder, 1.2 m long, its eyes 1.0 m above the ground.
#include <cmath>
#include <numbers>

#include "tools/scene/parts.h"

namespace phare::scene {

namespace {

using glm::dvec3;

/// Of a deer at night: 12 mm across, round here. Chosen; no figure was found. Its axis stands 45° from where the head
/// looks, so a pupil is seen from ahead and from the side.
constexpr double kPupil_m = 0.006;
const double kAxis_rad = std::numbers::pi / 4.0;

void part(Pen& pen, dvec3 a, double radius_a, dvec3 b, double radius_b) {
  pen.cone(Material::kDeerCoat, a, radius_a, b, radius_b, 9, false);
  pen.ellipsoid(Material::kDeerCoat, a, dvec3(radius_a), 4, 9);
  pen.ellipsoid(Material::kDeerCoat, b, dvec3(radius_b), 4, 9);
}

void eye(Pen& pen, dvec3 head, double side) {
  const dvec3 way(std::cos(kAxis_rad), side * std::sin(kAxis_rad), 0.0);
  const dvec3 left(-way.y, way.x, 0.0), up(0.0, 0.0, 1.0);
  const dvec3 ball = head + dvec3(0.03, side * 0.046, 0.02);
  pen.ellipsoid(Material::kDeerEye, ball, dvec3(0.017), 6, 10);
  std::vector<dvec3> rim;
  for (int i = 0; i < 12; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 12.0;
    rim.push_back(ball + 0.0185 * way + kPupil_m * (std::cos(a) * left + std::sin(a) * up));
  }
  pen.polygon(Material::kPupil, rim);
}

}  // namespace

void draw_deer(Pen pen) {
  const dvec3 rump(-0.38, 0.0, 0.62), shoulder(0.25, 0.0, 0.60), neck(0.38, 0.0, 0.72), head(0.50, 0.0, 0.99);
  part(pen, rump, 0.15, shoulder, 0.16);
  part(pen, rump + dvec3(0.1, 0.0, -0.03), 0.14, shoulder - dvec3(0.1, 0.0, 0.05), 0.15);
  part(pen, neck - dvec3(0.06, 0, 0.06), 0.11, head - dvec3(0.05, 0, 0.06), 0.055);
  pen.ellipsoid(Material::kDeerCoat, head, {0.085, 0.052, 0.062}, 7, 12);
  part(pen, head + dvec3(0.04, 0, -0.02), 0.04, head + dvec3(0.14, 0, -0.07), 0.024);  // muzzle
  pen.ellipsoid(Material::kDeerEye, head + dvec3(0.16, 0, -0.07), dvec3(0.014), 4, 7);
  // White about the tail.
  pen.ellipsoid(Material::kClothLight, rump + dvec3(-0.135, 0.0, 0.0), {0.03, 0.07, 0.09}, 5, 9);
  for (const double side : {-1.0, 1.0}) {
    eye(pen, head, side);
    pen.ellipsoid(Material::kDeerCoat, head + dvec3(-0.05, side * 0.075, 0.10), {0.02, 0.03, 0.075}, 5, 8);  // ear
    const dvec3 hip = rump + dvec3(-0.02, side * 0.07, -0.06), hock(-0.44, side * 0.075, 0.30);
    part(pen, hip, 0.09, hock, 0.032);
    part(pen, hock, 0.028, {-0.40, side * 0.075, 0.03}, 0.018);
    const dvec3 elbow = shoulder + dvec3(0.0, side * 0.07, -0.12), knee(0.25, side * 0.07, 0.28);
    part(pen, elbow, 0.06, knee, 0.026);
    part(pen, knee, 0.024, {0.26, side * 0.07, 0.03}, 0.017);
  }
}

}  // namespace phare::scene
