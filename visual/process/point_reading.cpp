#include "visual/process/point_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "config/base/conventions.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/scene/ray_hit.h"
#include "visual/scene/snow.h"

namespace phare {
namespace {

constexpr double kDegOfRad = 180.0 / std::numbers::pi;

constexpr std::array<const char*, 7> kWhyDarkWords{
    "lit",   "off", "behind the lamp", "outside its table", "no light in that direction", "the surface faces away",
    "hidden"};

/// What lies within a millimetre of the point.
std::optional<RayHit> surface_at(const World& world, const MeasurePoint& at) {
  constexpr double kNear_m = 1e-3;
  return ray_hit(world, at.position_m + kNear_m * at.normal, -at.normal, 0.0, 2.0 * kNear_m);
}

/// One lamp, as if nothing stood in its light.
LampReading read_lamp(const PointLight& light, const MeasurePoint& at, const glm::dvec3& back,
                      const glm::dvec3& to_eye) {
  LampReading reading;
  reading.lamp = light.lamp;
  const glm::dvec3 way = light.lamp_m - at.position_m;
  reading.distance_m = glm::length(way);
  reading.h_deg = light.h_deg, reading.v_deg = light.v_deg;
  reading.candela = light.candela;
  reading.why = !light.lit                                         ? WhyDark::kOff
                : light.candela > 0.0 || reading.distance_m <= 0.0 ? WhyDark::kLit
                : light.behind                                     ? WhyDark::kBehindLamp
                : light.out_of_table                               ? WhyDark::kOutOfTable
                                                                   : WhyDark::kNoLightThere;
  if (reading.why != WhyDark::kLit || reading.distance_m <= 0.0) return reading;
  reading.facing_lx = light.candela / (reading.distance_m * reading.distance_m);
  const glm::dvec3 toward = way / reading.distance_m;
  const auto on = [&](const glm::dvec3& normal) { return reading.facing_lx * std::max(glm::dot(toward, normal), 0.0); };
  reading.surface_lx = light.surface_lx;
  reading.horizontal_lx = on({0.0, 0.0, 1.0});
  reading.vertical_lx = on(back);
  reading.eye_lx = on(to_eye);
  if (light.surface_lx <= 0.0) reading.why = WhyDark::kFacesAway;
  return reading;
}

}  // namespace

PointReading read_point(const Lamps& lamps, const VehicleState& car, const MeasurePoint& at, const glm::dvec3& eye_m,
                        const World& world, const RoadLine& road, bool shadows, const FixedLight* fixed,
                        double snow_cover_01) {
  PointReading reading;
  reading.world = at;
  const glm::dmat3 body = world_from_car(car.roll_rad, car.pitch_rad, car.yaw_rad);
  reading.car_m = glm::transpose(body) * (at.position_m - glm::dvec3(car.x_m, car.y_m, car.z_m));
  reading.road = road.place_of(at.position_m);
  glm::dvec3 rho{0.0};
  std::optional<Retroreflection> retro;
  double snow_01 = 0.0;  // share of the surface that is covered
  if (const auto hit = surface_at(world, at)) {
    const SceneMaterial& material = hit->scene->materials[hit->chunk->material];
    reading.node = hit->chunk->node, reading.material = material.name;
    rho = glm::dvec3(material.reflectance);
    if (material.retro.kind != RetroKind::kNone) retro = material.retro;
    snow_01 = snow_share(at.normal, snow_cover_01);
    // Beads lie below; what is left of them has the strength of facets (shaders/lib/snow.h).
    if (snow_cover_01 > 0.0 && retro && retro->kind == RetroKind::kMarking) retro->kind = RetroKind::kFacets;
    reading.luminance_cdm2 = glm::dot(glm::dvec3(mean_emitted_cdm2(*hit->scene, material)), {0.2126, 0.7152, 0.0722});
  }
  const glm::dvec3 back{-std::cos(car.yaw_rad), -std::sin(car.yaw_rad), 0.0};
  const glm::dvec3 away = eye_m - at.position_m;
  const glm::dvec3 to_eye = glm::length(away) > 0.0 ? glm::normalize(away) : at.normal;
  for (const PointLight& light : lamps.lights_at(car, at)) {
    LampReading lamp = read_lamp(light, at, back, to_eye);
    if (shadows && lamp.why == WhyDark::kLit) {
      if (const SceneChunk* by = occluder(world, light.lamp_m, at.position_m)) {
        lamp.why = WhyDark::kHidden;
        lamp.hidden_by = name_of(*by);
      }
    }
    // A surface that faces away from the lamp may stand in its light when it is turned.
    if (lamp.why == WhyDark::kLit || lamp.why == WhyDark::kFacesAway) {
      reading.surface_lx += lamp.surface_lx;
      reading.horizontal_lx += lamp.horizontal_lx;
      reading.vertical_lx += lamp.vertical_lx;
      reading.eye_lx += lamp.eye_lx;
      // What is bare, and what is covered.
      const auto add = [&](const glm::dvec3& rho_of, const std::optional<Retroreflection>& sends, double share) {
        const double seen = share * glm::dot(rho_of * glm::dvec3(light.colour), {0.2126, 0.7152, 0.0722});
        reading.luminance_cdm2 += lamp.surface_lx * seen / std::numbers::pi;
        if (!sends || lamp.surface_lx <= 0.0) return;
        const double rho_a = reflectance_under_a(glm::vec3(rho_of));
        const double back_cdm2 =
            lamp.facing_lx * seen / rho_a *
            sent_back_per_lx(*sends, rho_a, glm::normalize(light.lamp_m - at.position_m), at.normal, to_eye);
        reading.sent_back_cdm2 += back_cdm2;
        reading.luminance_cdm2 += back_cdm2;
      };
      add(rho, retro, 1.0 - snow_01);
      const bool ground = retro && retro->kind == RetroKind::kFacets;
      if (snow_01 > 0.0)
        add(snow_reflectance(), ground ? std::optional(Retroreflection{.kind = RetroKind::kFacets}) : std::nullopt,
            snow_01);
    }
    reading.lamps.push_back(std::move(lamp));
  }
  if (fixed != nullptr) reading.fixed = fixed->shares_at(at.position_m, at.normal);
  for (const FixedLight::Share& share : reading.fixed) reading.fixed_lx += share.lx;
  return reading;
}

namespace {

/// "2 lamps and what walls and roof reflect".
std::string by_words(const std::vector<FixedLight::Share>& shares) {
  const bool reflected = std::ranges::any_of(shares, &FixedLight::Share::reflected);
  const std::size_t lamps = shares.size() - (reflected ? 1 : 0);
  const std::string words = lamps == 1 ? "one lamp" : fmt::format("{} lamps", lamps);
  if (!reflected) return words;
  return (lamps > 0 ? words + " and " : "") + "what walls and roof reflect";
}

}  // namespace

std::vector<std::string> lines_of(const PointReading& r) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{}: {:.6g} lx; level {:.6g}, upright {:.6g}, facing the eye {:.6g} lx; {:.3g} cd/m2{}",
                              r.node.empty() ? "point" : r.node + (r.material.empty() ? "" : " (" + r.material + ")"),
                              r.surface_lx, r.horizontal_lx, r.vertical_lx, r.eye_lx, r.luminance_cdm2,
                              r.sent_back_cdm2 > 0.0 ? fmt::format(", {:.3g} of it sent back", r.sent_back_cdm2) : ""));
  const glm::dvec3 w = r.world.position_m;
  std::string where = fmt::format("  car ({:.2f}, {:.2f}, {:.2f}), world ({:.2f}, {:.2f}, {:.2f}) m", r.car_m.x,
                                  r.car_m.y, r.car_m.z, w.x, w.y, w.z);
  if (r.road) where += fmt::format(", road s {:.2f}, {:.2f} m left", r.road->s_m, r.road->lateral_m);
  lines.push_back(std::move(where));
  if (!r.fixed.empty()) {
    const FixedLight::Share& most = r.fixed.front();
    lines.push_back(fmt::format("  besides, of what stands: {:.6g} lx by {}, {:.4g} of {}", r.fixed_lx,
                                by_words(r.fixed), most.lx,
                                most.lamp          ? fmt::format("street lamp {}", *most.lamp + 1)
                                : most.directional ? fmt::format("directional light {}", *most.directional + 1)
                                : most.reflected   ? "walls and roof"
                                                   : "the moon"));
  }
  for (const LampReading& lamp : r.lamps) {
    std::string line = "  " + lamp.lamp + ": ";
    if (lamp.why == WhyDark::kLit)
      line += fmt::format("{:.6g} lx, {:.0f} %", lamp.surface_lx,
                          r.surface_lx > 0.0 ? 100.0 * lamp.surface_lx / r.surface_lx : 0.0);
    else
      line += std::string("dark, ") + kWhyDarkWords[static_cast<std::size_t>(lamp.why)] +
              (lamp.hidden_by.empty() ? "" : " by " + lamp.hidden_by + fmt::format(" ({:.4g} lx)", lamp.surface_lx));
    if (lamp.why != WhyDark::kOff)
      line += fmt::format("; {:.5g} cd at H {:.2f}, V {:.2f} deg, {:.2f} m, facing it {:.4g} lx", lamp.candela,
                          lamp.h_deg, lamp.v_deg, lamp.distance_m, lamp.facing_lx);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace phare
