#include "tools/scene/alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace phare::scene {

namespace {

constexpr double kTableBegin_m = -260.0, kTableEnd_m = 2060.0, kKnotStep_m = 0.5;

double smooth(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

/// Integral of smooth from 0 to u, which goes on as a straight line beyond 1.
double smooth_integral(double u) {
  if (u <= 0.0) return 0.0;
  if (u >= 1.0) return 0.5 + (u - 1.0);
  return u * u * u - 0.5 * u * u * u * u;
}

double bend_curvature(const Bend& b, double s) {
  return (smooth((s - b.begin_m) / (b.full_begin_m - b.begin_m)) -
          smooth((s - b.full_end_m) / (b.end_m - b.full_end_m))) /
         b.radius_m;
}

double bend_heading(const Bend& b, double s) {
  const double in = b.full_begin_m - b.begin_m, out = b.end_m - b.full_end_m;
  return (in * smooth_integral((s - b.begin_m) / in) - out * smooth_integral((s - b.full_end_m) / out)) / b.radius_m;
}

double hump(const Hump& h, double s) {
  if (s <= h.begin_m || s >= h.end_m) return 0.0;
  const double length = h.end_m - h.begin_m;
  const double u = (s - h.begin_m) / length * (h.end_m - s) / length;
  return 64.0 * h.height_m * u * u * u;
}

/// Roll of the land, in the plane: a few long waves that never line up. About ±1.
double land(double x, double y) {
  return 0.45 * std::sin(x / 71.0 + 0.7 * std::sin(y / 53.0)) +
         0.35 * std::sin(y / 43.0 + 1.3 + 0.5 * std::sin(x / 61.0)) + 0.2 * std::sin((x + 1.7 * y) / 23.0 + 0.4);
}

/// 1 where a swale runs beside the road, 0 at the lay-by, the farm yard and the way into the field.
double swale_share(double s, double t) {
  const auto gap = [s](double begin, double end) {
    return smooth_step(begin - 6.0, begin, s) * (1.0 - smooth_step(end, end + 6.0, s));
  };
  if (t < 0.0) return 1.0 - std::max({gap(222.0, 262.0), gap(432.0, 500.0), gap(630.0, 655.0)});
  return 1.0 - std::max(gap(985.0, 995.0), gap(100.0, 112.0));
}

}  // namespace

double smooth_step(double a, double b, double x) {
  return smooth((x - a) / (b - a));
}

double curvature_1pm(double s) {
  return bend_curvature(kFirstBend, s) + bend_curvature(kSecondBend, s);
}

double heading_rad(double s) {
  return bend_heading(kFirstBend, s) + bend_heading(kSecondBend, s);
}

double profile_m(double s) {
  // A long gentle wave under crest and dip, so that no stretch is quite level.
  return hump(kCrest, s) + hump(kDip, s) + 1.2 * (1.0 - std::cos(2.0 * std::numbers::pi * s / 900.0));
}

glm::dvec3 Station::forward() const {
  return {std::cos(heading_rad), std::sin(heading_rad), 0.0};
}
glm::dvec3 Station::left() const {
  return {-std::sin(heading_rad), std::cos(heading_rad), 0.0};
}

namespace {

/// Path from a to b by Gauss's three-point rule; exact to 1e-12 m over half a metre.
std::array<double, 2> integrate(double a, double b) {
  constexpr std::array<double, 3> node{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  std::array<double, 2> sum{0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double psi = heading_rad(0.5 * (a + b) + 0.5 * (b - a) * node[i]);
    sum[0] += weight[i] * (b - a) * std::cos(psi);
    sum[1] += weight[i] * (b - a) * std::sin(psi);
  }
  return sum;
}

}  // namespace

Alignment::Alignment() {
  const auto count = static_cast<std::size_t>((kTableEnd_m - kTableBegin_m) / kKnotStep_m) + 1;
  knots_.resize(count);
  knots_[0] = {kTableBegin_m, 0.0};  // straight before s = 0, so the origin is met exactly
  for (std::size_t i = 1; i < count; ++i) {
    const double s = kTableBegin_m + kKnotStep_m * static_cast<double>(i - 1);
    const auto step = integrate(s, s + kKnotStep_m);
    knots_[i] = {knots_[i - 1].x_m + step[0], knots_[i - 1].y_m + step[1]};
  }
}

Station Alignment::at(double s) const {
  const double last = static_cast<double>(knots_.size() - 1);
  const double index = std::clamp(std::floor((s - kTableBegin_m) / kKnotStep_m), 0.0, last);
  const Knot& knot = knots_[static_cast<std::size_t>(index)];
  const auto rest = integrate(kTableBegin_m + kKnotStep_m * index, s);
  return {{knot.x_m + rest[0], knot.y_m + rest[1], profile_m(s)},
          phare::scene::heading_rad(s),
          phare::scene::curvature_1pm(s)};
}

double Alignment::height_m(double s, double t) const {
  // Road: a roof of 2.5 % with a rounded ridge; in a bend the outer side turns up until the whole road falls inwards.
  const double left_bend = smooth(bend_curvature(kFirstBend, s) * kFirstBend.radius_m);
  const double right_bend = smooth(bend_curvature(kSecondBend, s) * kSecondBend.radius_m);
  const double slope_left = -kCrossfall + 2.0 * kCrossfall * right_bend;  // dz per metre away from the middle
  const double slope_right = -kCrossfall + 2.0 * kCrossfall * left_bend;
  const double paved_t = std::clamp(t, -kPavedHalfWidth_m, kPavedHalfWidth_m);
  constexpr double kRidge_m = 0.3;
  const double rounded = std::sqrt(paved_t * paved_t + kRidge_m * kRidge_m) - kRidge_m;
  double z = profile_m(s) + 0.5 * (slope_left + slope_right) * rounded + 0.5 * (slope_left - slope_right) * paved_t;
  const double d = std::abs(t);
  if (d <= kPavedHalfWidth_m) return z;

  // Beside it: verge, a swale so shallow that low beams light it all, then the land takes over from the road's profile.
  // Where it is deeper than the lamps are high over its far edge it is a black band; where they just reach it, light
  // glances along its slope.
  const double swale = swale_share(s, t);
  z -= 0.05 * (std::min(d, 5.3) - kPavedHalfWidth_m);
  z -= 0.06 * swale * smooth_step(5.3, 6.6, d) * (1.0 - smooth_step(6.9, 8.4, d));
  if (d > 8.0) {
    const Station station = at(s);
    const glm::dvec3 p = station.position_m + station.left() * t;
    const double away = smooth_step(8.0, 70.0, d);
    const double bank = (0.5 + 0.5 * std::sin(s / 47.0 + (t > 0.0 ? 0.9 : 3.4))) * smooth_step(8.4, 16.0, d);
    z += 1.1 * bank * swale + away * (2.6 * land(p.x, p.y) + 0.45 * (0.0 - hump(kCrest, s) - hump(kDip, s)));
    z += 7.0 * smooth_step(45.0, 130.0, d) * (0.55 + 0.5 * land(0.45 * p.x - 90.0, 0.45 * p.y + 300.0));  // ridges
    z += 0.045 * std::max(0.0, d - 14.0) * (0.9 + 0.5 * land(0.6 * p.x + 200.0, 0.6 * p.y));
  }
  return z;
}

glm::dvec3 Alignment::point(double s, double t) const {
  const Station station = at(s);
  glm::dvec3 p = station.position_m + station.left() * t;
  p.z = height_m(s, t);
  return p;
}

}  // namespace phare::scene
