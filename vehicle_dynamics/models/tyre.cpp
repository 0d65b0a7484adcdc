#include "vehicle_dynamics/models/tyre.h"

namespace phare::tyre {
namespace {

constexpr double kNoSlide = 1e-20;  // a wheel without slip has no direction of slide

double magic(double b, double shape, double curvature, double slip) {
  const double bs = b * slip;
  return std::sin(shape * std::atan(bs - curvature * (bs - std::atan(bs))));
}

double weight(double b, double shape, double curvature, double slip) {
  const double bs = b * slip;
  return std::cos(shape * std::atan(bs - curvature * (bs - std::atan(bs))));
}

// Slip at the highest force, by golden section: once per car, and the curve has one peak.
double peak_slip(double b, double shape, double curvature) {
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    (magic(b, shape, curvature, left) < magic(b, shape, curvature, right) ? low : high) =
        magic(b, shape, curvature, left) < magic(b, shape, curvature, right) ? left : right;
  }
  return 0.5 * (low + high);
}

// The table of side_force(): 16 KiB, of which a drive touches little at a time.
constexpr double kCurveEnd = 8.0, kNodesPerUnit = 128.0;

// sin(C atan(w)) with w = x - E (x - atan x), and its derivative.
SideForce side_curve(Two x, double shape, double curvature) {
  const Two w = x - curvature * (x - arctangent(x)), x2 = x * x;
  const SineCosine bent = sine_cosine(shape * arctangent(w));
  return {bent.sine, shape * bent.cosine * (1.0 + (1.0 - curvature) * x2) / ((1.0 + w * w) * (1.0 + x2))};
}

}  // namespace

Constants constants(const TyreParams& p) {
  Constants c;
  c.p = p;
  c.bx = p.long_stiffness / (p.long_shape * p.long_peak);
  c.by = p.lat_stiffness / (p.lat_shape * p.lat_peak);
  c.peak_kappa = peak_slip(c.bx, p.long_shape, p.long_curvature);
  c.per_kappa_bend = 1.0 / (1.5 * c.peak_kappa);
  c.per_tan_alpha_bend = 1.0 / (1.5 * peak_slip(c.by, p.lat_shape, p.lat_curvature));
  c.per_long_m = 1.0 / p.long_relaxation_m;
  c.per_lat_m = 1.0 / p.lat_relaxation_m;
  constexpr auto kNodes = static_cast<std::size_t>(kCurveEnd * kNodesPerUnit) + 1;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const SideForce node = side_curve(both(static_cast<double>(i) / kNodesPerUnit), p.lat_shape, p.lat_curvature);
    c.side_curve.push_back(Two{node.share[0], node.rise[0] / kNodesPerUnit});
  }
  return c;
}

Force steady_force(const Constants& tyre, double kappa, double tan_alpha, double load_n, double mu) {
  const TyreParams& p = tyre.p;
  if (!(load_n > 0.0)) return {};
  // K/Fz stays, D falls with mu: so B rises (Pacejka 4.3.2, lambda_mu on D only).
  const double dx = mu * p.long_peak, dy = mu * p.lat_peak, inv_mu = 1.0 / mu;
  double fx = dx * magic(tyre.bx * inv_mu, p.long_shape, p.long_curvature, kappa);
  double fy = dy * magic(tyre.by * inv_mu, p.lat_shape, p.lat_curvature, tan_alpha);
  const double fall_x = p.long_weight_fall * kappa, fall_y = p.lat_weight_fall * tan_alpha;
  // The weighting is fitted to a rolling wheel. One that slides far would turn its sign and push the car; such a one
  // pushes against its slide, so neither part of the force is less than the slide's direction leaves it.
  const double slide = std::sqrt(kappa * kappa + tan_alpha * tan_alpha + kNoSlide);
  fx *= std::max(std::abs(kappa) / slide, weight(p.long_weight / std::sqrt(1.0 + fall_x * fall_x), p.long_weight_shape,
                                                 p.long_weight_curvature, tan_alpha));
  fy *= std::max(std::abs(tan_alpha) / slide, weight(p.lat_weight / std::sqrt(1.0 + fall_y * fall_y),
                                                     p.lat_weight_shape, p.lat_weight_curvature, kappa));
  // The weighting is a fit and may leave the friction ellipse by a little; friction may not.
  const double ex = fx / dx, ey = fy / dy, over = ex * ex + ey * ey;
  const double scale = load_n / std::sqrt(std::max(over, 1.0));
  return {fx * scale, fy * scale};
}

#if defined(__x86_64__) && defined(__GLIBC__)
namespace {

// The vector mathematics of the C library (libmvec), four lanes: a car's wheels. Its results are within 4 ulp, and the
// same on every run of one machine.
using Four = double __attribute__((vector_size(32)));
extern "C" Four _ZGVdN4v_atan(Four);
extern "C" Four _ZGVdN4v_sin(Four);
extern "C" Four _ZGVdN4v_cos(Four);

[[gnu::target("avx2")]] inline Four bent(Four bs, double curvature) {
  return _ZGVdN4v_atan(bs - curvature * (bs - _ZGVdN4v_atan(bs)));
}

[[gnu::target("avx2")]] inline Four root(Four v) {
  for (int i = 0; i < 4; ++i) v[i] = std::sqrt(v[i]);
  return v;
}

[[gnu::target("avx2")]] void four_forces(const Constants& tyre, const double kappa[4], const double tan_alpha[4],
                                         const double load_n[4], const double mu[4], double fx_n[4], double fy_n[4]) {
  const TyreParams& p = tyre.p;
  const Four k{kappa[0], kappa[1], kappa[2], kappa[3]}, t{tan_alpha[0], tan_alpha[1], tan_alpha[2], tan_alpha[3]};
  const Four m{mu[0], mu[1], mu[2], mu[3]}, load{load_n[0], load_n[1], load_n[2], load_n[3]};
  const Four inv_mu = 1.0 / m;
  const Four fall_x = p.long_weight_fall * k, fall_y = p.lat_weight_fall * t;
  const Four bx = p.long_weight / root(1.0 + fall_x * fall_x), by = p.lat_weight / root(1.0 + fall_y * fall_y);
  const Four per_slide = 1.0 / root(k * k + t * t + kNoSlide);
  const Four slide_x = (k < 0.0 ? -k : k) * per_slide, slide_y = (t < 0.0 ? -t : t) * per_slide;
  const Four weight_x = _ZGVdN4v_cos(p.long_weight_shape * bent(bx * t, p.long_weight_curvature));
  const Four weight_y = _ZGVdN4v_cos(p.lat_weight_shape * bent(by * k, p.lat_weight_curvature));
  const Four ex = _ZGVdN4v_sin(p.long_shape * bent(tyre.bx * inv_mu * k, p.long_curvature)) *
                  (weight_x > slide_x ? weight_x : slide_x);
  const Four ey = _ZGVdN4v_sin(p.lat_shape * bent(tyre.by * inv_mu * t, p.lat_curvature)) *
                  (weight_y > slide_y ? weight_y : slide_y);
  const Four over = ex * ex + ey * ey;
  for (int i = 0; i < 4; ++i) {
    const double scale = mu[i] * load[i] * (1.0 / std::sqrt(std::max(over[i], 1.0)));
    fx_n[i] = ex[i] * p.long_peak * scale;
    fy_n[i] = ey[i] * p.lat_peak * scale;
  }
  __builtin_ia32_vzeroupper();  // as in config/base/two.cpp
}

const bool kFourLanes = __builtin_cpu_supports("avx2");

}  // namespace
#endif

void steady_forces(const Constants& tyre, const double kappa[4], const double tan_alpha[4], const double load_n[4],
                   const double mu[4], double fx_n[4], double fy_n[4]) {
#if defined(__x86_64__) && defined(__GLIBC__)
  if (kFourLanes) {
    four_forces(tyre, kappa, tan_alpha, load_n, mu, fx_n, fy_n);
    return;
  }
#endif
  for (int i = 0; i < 4; ++i) {
    const Force force = steady_force(tyre, kappa[i], tan_alpha[i], load_n[i], mu[i]);
    fx_n[i] = force.x_n, fy_n[i] = force.y_n;
  }
}

SideForce side_force(const Constants& tyre, Two tan_alpha, double mu) {
  const double b = tyre.by / mu, peak = mu * tyre.p.lat_peak;
  const Two x = b * tan_alpha, size = magnitude(x);
  if (!(size[0] < kCurveEnd && size[1] < kCurveEnd)) {
    const SideForce far = side_curve(x, tyre.p.lat_shape, tyre.p.lat_curvature);
    return {peak * far.share, peak * b * far.rise};
  }
  const Two place = kNodesPerUnit * size;
  const auto first = static_cast<std::size_t>(place[0]), second = static_cast<std::size_t>(place[1]);
  const Two u = place - Two{static_cast<double>(first), static_cast<double>(second)};
  const Two *f = &tyre.side_curve[first], *s = &tyre.side_curve[second];
  const Two from{f[0][0], s[0][0]}, rise{f[0][1], s[0][1]}, step = Two{f[1][0], s[1][0]} - from, next{f[1][1], s[1][1]};
  const Two c3 = rise + next - 2.0 * step, c2 = step - rise - c3;
  const Two share = from + u * (rise + u * (c2 + u * c3));
  return {(x < 0.0 ? -peak : peak) * share, peak * b * kNodesPerUnit * (rise + u * (2.0 * c2 + 3.0 * u * c3))};
}

}  // namespace phare::tyre
