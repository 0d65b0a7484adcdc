// What the closed forms have in common: nearness as a share, cars set up as the textbook's, and the textbook's own
// cars.
#pragma once

#include <array>
#include <cmath>

#include "full_car.h"
#include "modes.h"

namespace phare::test {

/// Of every closed form that has no bound of its own: figures are given with four or five digits, so most of it is for
/// what "small" leaves of second order in motions of a milliradian or a tenth of m/s2.
constexpr double kForm = 0.005;

inline void expect_share(double value, double expected, double share, const char* what) {
  EXPECT_NEAR(value, expected, share * std::abs(expected)) << what;
}

constexpr std::array<const char*, 3> kCars{"bmw_320i.toml", "ford_escort.toml", "vw_vanagon.toml"};

/// Gravity of the figures "per g".
constexpr double kG_mps2 = 9.81;

/// The car with its axles' mass spread so that the centre of the whole car lies where the body's does, as a single
/// track has it. In the files both axles weigh the same, and each carries its own.
inline VehicleParams one_centre(const char* file, double relaxation_m) {
  VehicleParams v = car(file);
  ChassisParams& c = *v.chassis;
  const double axles = c.front_axle_kg + c.rear_axle_kg;
  c.front_axle_kg = axles * (1.0 - v.cg_to_front_m / v.wheelbase_m);
  c.rear_axle_kg = axles - c.front_axle_kg;
  c.tyre.long_relaxation_m = c.tyre.lat_relaxation_m = relaxation_m;
  return v;
}

/// Half car of the textbook on rigid wheels without mass, springs in series with the tyres: level single-track's body.
/// States: heave, pitch, their rates.
struct HalfCar {
  Eigen::Matrix4d rate = Eigen::Matrix4d::Zero();
  explicit HalfCar(const VehicleParams& v) {
    const ChassisParams& c = *v.chassis;
    const double x[2] = {v.cg_to_front_m, v.cg_to_front_m - v.wheelbase_m};
    const double k[2] = {v.front_rate_npm, v.rear_rate_npm}, d[2] = {c.front_damping_nspm, c.rear_damping_nspm};
    rate.topRightCorner<2, 2>().setIdentity();
    for (int i = 0; i < 2; ++i) {
      const double share = v.tyre_rate_npm / (v.tyre_rate_npm + k[i]);  // of the stroke that the spring takes
      Eigen::Matrix2d arm;
      arm << 1.0 / v.sprung_mass_kg, -x[i] / v.sprung_mass_kg, -x[i] / c.pitch_inertia_kgm2,
          x[i] * x[i] / c.pitch_inertia_kgm2;
      rate.bottomLeftCorner<2, 2>() -= 2.0 * k[i] * share * arm;
      rate.bottomRightCorner<2, 2>() -= 2.0 * d[i] * share * share * arm;
    }
  }
  /// Pitch at t after a step of force that in the end pitches it by 1.
  double pitch_after_step(double t) const {
    const Eigen::EigenSolver<Eigen::Matrix4d> solved(rate);
    // x = x_end - e^{At} x_end with A x_end = -push, push in pitch only
    Eigen::Vector4d push = Eigen::Vector4d::Zero();
    push(3) = 1.0;
    const Eigen::Vector4d end = -rate.inverse() * push;
    const Eigen::Vector4cd parts = solved.eigenvectors().inverse() * end.cast<std::complex<double>>();
    const Eigen::Vector4cd left =
        solved.eigenvectors() * (solved.eigenvalues() * t).array().exp().matrix().cwiseProduct(parts);
    return 1.0 - left(1).real() / end(1);
  }
};

/// Response of a car or a formula to a step.
struct StepResponse {
  double end = 0.0;                              ///< where it settles
  double t90_s = 0.0, peak = 0.0, peak_s = 0.0;  ///< peak over the end
  double settled_s = 0.0;                        ///< within 2 % from then on
};
/// Of samples at dt, 2 dt, ...; between them linear, at the peak the parabola.
inline StepResponse step_response(const std::vector<double>& samples, double dt) {
  StepResponse r;
  r.end = samples.back();
  std::size_t top = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double now = samples[i] / r.end, before = i > 0 ? samples[i - 1] / r.end : 0.0;
    const double t = dt * static_cast<double>(i + 1);
    if (r.t90_s == 0.0 && now >= 0.9) r.t90_s = t - dt * (now - 0.9) / (now - before);
    if (now > samples[top] / r.end) top = i;
    if (std::abs(now - 1.0) > 0.02) r.settled_s = t;
  }
  r.peak = samples[top] / r.end, r.peak_s = dt * static_cast<double>(top + 1);
  if (top > 0 && top + 1 < samples.size()) {
    const double a = samples[top - 1] / r.end, b = samples[top + 1] / r.end, bend = a - 2.0 * r.peak + b;
    if (bend < 0.0) r.peak_s += 0.5 * dt * (a - b) / bend;
  }
  return r;
}

}  // namespace phare::test
