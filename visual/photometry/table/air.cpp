#include "visual/photometry/table/air.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

namespace phare {
namespace {

/// What one lamp adds, over the angle at it: tan(angle) = (s − along)/aside, ds/r² = d(angle)/aside.
struct LampAlongRay {
  const PlacedSource& source;
  const glm::dvec3& eye_m;
  const glm::dvec3& direction;
  double extinction, along_m, aside_m;
  const Air& air;

  double operator()(double angle) const {
    const double past_m = aside_m * std::tan(angle), s = along_m + past_m;
    const double r = aside_m / std::cos(angle);
    const double cd =
        source.scale * source.table->intensity_cd((eye_m + direction * s - source.position_m) * source.world_from_lamp);
    if (cd == 0.0) return 0.0;
    // From the direction of travel, lamp to point, to that from point to eye.
    return cd * phase_per_sr(air, 0.5 * std::numbers::pi + angle) * std::exp(-extinction * (r + s)) / aside_m;
  }
};

/// Gauss and Kronrod, 7 and 15 points; halves where they differ.
template <typename F>
double integral(const F& f, double from, double to, double allowed, int halvings) {
  static constexpr double x[] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                 0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                 0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                                 0.207784955007898467600689403773245, 0.0};
  static constexpr double wk[] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                  0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                  0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                  0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr double wg[] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                  0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from), centre = f(middle);
  double kronrod = wk[7] * centre, gauss = wg[3] * centre;
  for (int i = 0; i < 7; ++i) {
    const double sum = f(middle - half * x[i]) + f(middle + half * x[i]);
    kronrod += wk[i] * sum;
    if (i % 2 == 1) gauss += wg[i / 2] * sum;
  }
  if (halvings == 0 || std::abs(kronrod - gauss) * half <= allowed) return kronrod * half;
  return integral(f, from, middle, 0.5 * allowed, halvings - 1) + integral(f, middle, to, 0.5 * allowed, halvings - 1);
}

/// Of fog, rain and snow what each scatters.
double fog_per_m(const Air& air) {
  return air.visibility_m ? extinction_per_m(*air.visibility_m) * air.droplets.albedo : 0.0;
}
double rain_per_m(const Air& air) {
  return air.rain_mmph > 0.0 ? particles_of(Precipitation::kRain, air.rain_mmph).scattering_per_m : 0.0;
}
double snow_per_m(const Air& air) {
  return air.snow_mmph > 0.0 ? particles_of(Precipitation::kSnow, air.snow_mmph).scattering_per_m : 0.0;
}

}  // namespace

Particles Air::particles() const {
  return snow_mmph > rain_mmph ? particles_of(Precipitation::kSnow, snow_mmph)
                               : particles_of(Precipitation::kRain, rain_mmph);
}

std::string words_of(const Air& air) {
  std::string words;
  const auto add = [&](const char* format, double value) {
    char text[60];
    std::snprintf(text, sizeof text, format, value);
    words += (words.empty() ? "" : ", ") + std::string(text);
  };
  if (air.visibility_m) add("visibility %.4g m", *air.visibility_m);
  if (air.rain_mmph > 0.0) add("rain %.4g mm/h", air.rain_mmph);
  if (air.snow_mmph > 0.0) add("snow %.4g mm/h", air.snow_mmph);
  return words.empty() ? "clear air" : words;
}

double extinction_per_m(const Air& air) {
  return (air.visibility_m ? extinction_per_m(*air.visibility_m) : 0.0) + rain_per_m(air) + snow_per_m(air);
}

double scattering_per_m(const Air& air) {
  return fog_per_m(air) + rain_per_m(air) + snow_per_m(air);
}

double phase_of_particles_per_sr(const Air& air, double angle_rad) {
  if (!air.falls()) return 0.0;
  const Particles particles = air.particles();
  return particles.scattering_per_m / scattering_per_m(air) * henyey_greenstein_per_sr(particles.g, angle_rad);
}

double phase_per_sr(const Air& air, double angle_rad) {
  const double all = scattering_per_m(air);
  if (all <= 0.0) return 0.0;
  double sum = 0.0;
  if (const double fog = fog_per_m(air); fog > 0.0) sum += fog * phase_per_sr(air.droplets, angle_rad);
  for (const auto& [kind, rate, part] : {std::tuple(Precipitation::kRain, air.rain_mmph, rain_per_m(air)),
                                         std::tuple(Precipitation::kSnow, air.snow_mmph, snow_per_m(air))})
    if (part > 0.0) sum += part * henyey_greenstein_per_sr(particles_of(kind, rate).g, angle_rad);
  return sum / all;
}

double airlight_cdm2(std::span<const PlacedSource> sources, const Air& air, const glm::dvec3& eye_m,
                     const glm::dvec3& direction, double length_m) {
  const double extinction = extinction_per_m(air);
  double sum = 0.0;
  for (const PlacedSource& source : sources) {
    const glm::dvec3 to_lamp = source.position_m - eye_m;
    const double along_m = glm::dot(to_lamp, direction);
    const double aside_m = std::max(glm::length(glm::cross(to_lamp, direction)), kNearestToLamp_m);
    const LampAlongRay lamp{source, eye_m, direction, extinction, along_m, aside_m, air};
    // In pieces, so that no narrow beam falls between the first points.
    constexpr int kPieces = 64;
    const double from = std::atan(-along_m / aside_m), to = std::atan((length_m - along_m) / aside_m);
    std::array<double, kPieces + 1> ends;
    for (int i = 0; i <= kPieces; ++i) ends[static_cast<std::size_t>(i)] = from + (to - from) * i / kPieces;
    double rough = 0.0, lamp_sum = 0.0;
    for (std::size_t i = 0; i < kPieces; ++i) rough += integral(lamp, ends[i], ends[i + 1], 0.0, 0);
    for (std::size_t i = 0; i < kPieces; ++i)
      lamp_sum += integral(lamp, ends[i], ends[i + 1], 1e-8 * rough / kPieces, 24);
    sum += lamp_sum;
  }
  return scattering_per_m(air) * sum;
}

double airlight_cdm2(std::span<const PlacedSource> sources, double extinction_per_m, const FogDroplets& droplets,
                     const glm::dvec3& eye_m, const glm::dvec3& direction, double length_m) {
  return airlight_cdm2(sources, {.visibility_m = -std::log(0.05) / extinction_per_m, .droplets = droplets}, eye_m,
                       direction, length_m);
}

}  // namespace phare
