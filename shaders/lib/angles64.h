// Angles and square roots in float64, for which GLSL has no functions of its own (atan) or promises float32 only (sqrt).
#ifndef PHARE_SHADERS_LIB_ANGLES64_H
#define PHARE_SHADERS_LIB_ANGLES64_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

// GLSL reads a literal without "lf" as float32, C++ knows no "lf": all others below are exact in float32.
#ifdef __cplusplus
const double kDegPerRad64 = 57.295779513082320877;
#else
const double kDegPerRad64 = 57.295779513082320877lf;
#endif

/// Vulkan promises a square root of float64 no better than one of float32: two steps of Newton make it one. x >= 0.
PHARE_INLINE double sqrt_64(double x) {
  if (!(x > double(0.0))) return double(0.0);
  double root = sqrt(x);
  root = double(0.5) * (root + x / root);
  return double(0.5) * (root + x / root);
}

/// atan(t) for 0 <= t <= 1, rad: half the angle twice, tan(a/2) = t/(1 + sqrt(1 + t²)), then the series of
/// |u| <= tan(11.25°). Its first term left out is u^27/27 < 1e-20. Relative error below 2e-15.
PHARE_INLINE double atan_64(double t) {
  double u = t / (double(1.0) + sqrt_64(double(1.0) + t * t));
  u = u / (double(1.0) + sqrt_64(double(1.0) + u * u));
  double s = u * u;
  double series = double(0.0);
  for (int k = 12; k >= 0; --k) series = double(1.0) / double(2 * k + 1) - s * series;
  return double(4.0) * u * series;
}

/// atan2(y, x) in degrees, -180 to 180; (0, 0) gives 0. Off by less than 1e-13 degrees.
PHARE_INLINE double atan2_deg_64(double y, double x) {
  double ax = abs(x);
  double ay = abs(y);
  double high = max(ax, ay);
  if (!(high > double(0.0))) return double(0.0);
  double angle_deg = atan_64(min(ax, ay) / high) * kDegPerRad64;
  if (ay > ax) angle_deg = double(90.0) - angle_deg;
  if (x < double(0.0)) angle_deg = double(180.0) - angle_deg;
  return y < double(0.0) ? -angle_deg : angle_deg;
}

PHARE_SHADER_END
#endif
