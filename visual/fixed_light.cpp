#include "visual/fixed_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "shaders/lib/luminance.h"
#include "shaders/lib/opening.h"
#include "shaders/lib/road.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/lamp_tables.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

constexpr double kMoon_k = 4100.0;       // sunlight that the moon has reddened; a usual figure
constexpr std::size_t kMostNearEye = 32;  // more than glare_seen() keeps, for half of them may lie behind the eye
constexpr double kOffSurface_m = 0.005;  // vertices lie on edges of their neighbours
// A vertex of a wall may lie behind a window, of a pavement under a pole, where nobody sees it: dark, it would darken
// what is seen a metre around. So light falls on it as if what lies on it so thinly, or it lies within so deeply, were
// not there.
constexpr double kCover_m = 0.15, kWithin_m = 0.3;
constexpr double kBeyondScene_m = 5000.0;

/// Columns: axis (down, tilted up toward the street side), left, and the street side as the lamp's "up".
glm::dmat3 world_from_luminaire(double yaw_rad, double tilt_rad) {
  const glm::dvec3 street(std::cos(yaw_rad), std::sin(yaw_rad), 0.0), down(0.0, 0.0, -1.0);
  const glm::dvec3 axis = std::cos(tilt_rad) * down + std::sin(tilt_rad) * street;
  const glm::dvec3 up = std::cos(tilt_rad) * street - std::sin(tilt_rad) * down;
  return {axis, glm::cross(up, axis), up};
}

}  // namespace

Result<FixedLight> FixedLight::of(const Scene& scene, const std::filesystem::path& street_lamps,
                                  const std::optional<MoonConfig>& moon, const std::optional<Reflected>& reflected) {
  FixedLight light;
  Reflected times = Reflected::kAll;
  if (!street_lamps.empty()) {
    const auto config = read_street_lamps(street_lamps);
    if (!config) return config.error();
    times = config->reflected;
    light.level_ = kBakeLevels[static_cast<std::size_t>(config->fineness)];
    if (!config->r_table_file.empty()) {
      const auto table = read_r_table(config->r_table_file);
      if (!table) return table.error();
      light.lobes_ = RoadLobes::of(*table);
    }
    for (const LuminaireConfig& kind : config->luminaires) {
      auto table = read_lamp(kind.file, read_settings(kind));
      if (!table) return table.error();
      const double peak_cd = table->peak_cd() * kind.scale;
      light.luminaires_.push_back({std::move(*table), {}, kind.scale, peak_cd});
      Luminaire& last = light.luminaires_.back();
      last.opening = stated_opening(last.table);
      last.colour = light_colour({.table = &last.table,
                                  .colour_temperature_k = kind.colour_temperature_k,
                                  .chromaticity_xy = kind.chromaticity_xy});
    }
    for (const StreetLampConfig& lamp : config->lamps)
      light.lamps_.push_back(
          {lamp.position_m, glm::transpose(world_from_luminaire(lamp.yaw_rad, lamp.tilt_rad)), lamp.luminaire});
  }
  if (moon) {
    const glm::dvec3 toward(std::cos(moon->elevation_rad) * std::cos(moon->azimuth_rad),
                            std::cos(moon->elevation_rad) * std::sin(moon->azimuth_rad), std::sin(moon->elevation_rad));
    light.moon_ = Moon{toward, moon->illuminance_lx, black_body_colour(kMoon_k)};
  }
  if (const Status done = light.add_lights_of(scene); !done) return done.error();
  std::set<std::uint32_t> used;
  for (const SceneChunk& chunk : scene.chunks) used.insert(chunk.material);
  for (const std::uint32_t index : used) {
    const SceneMaterial& material = scene.materials[index];
    if (material.emission_cdm2 != glm::vec3(0.0f)) ++light.luminous_;
    if (material.sky_share < 1.0f) light.covered_ = true;
    if (light.r_table(material)) light.r_table_ = true;
  }
  if (!light.lamps_.empty() || light.moon_ || !light.suns_.empty() || light.covered_) light.tree_ = RayTree(scene);
  if (light.covered_ && (!light.lamps_.empty() || !light.suns_.empty())) {
    const auto direct = [&light](const glm::dvec3& point_m, const glm::dvec3& normal) {
      glm::dvec4 sum(0.0);
      light.each(point_m, &normal, false, [&](const Share& share, const glm::vec3& colour, const glm::dvec3&, double) {
        sum += glm::dvec4(glm::dvec3(colour), 1.0) * share.lx;
      });
      return sum;
    };
    std::vector<glm::dvec3> lamps_m;
    for (const Lamp& lamp : light.lamps_) lamps_m.push_back(lamp.position_m);
    light.reflected_ = ReflectedLight(scene, reflected.value_or(times), direct, lamps_m);
  }
  return light;
}

/// What is dark, black or off is left out.
Status FixedLight::add_lights_of(const Scene& scene) {
  std::vector<IntensityTable> tables;
  for (const LightProfile& profile : scene.light_profiles) {
    LampReadSettings settings;
    settings.format = LampFormat::kLm63;
    settings.folder = profile.file.parent_path();
    const std::string name = profile.file.empty() ? scene.file.string() + ": " + profile.name : profile.name;
    auto table = parse_lamp(profile.bytes, name, settings);
    if (!table) return table.error();
    tables.push_back(std::move(*table));
  }
  for (const SceneLight& light : scene.lights) {
    const float luminance = shader::luminance_of(light.colour);
    const double of_white = light.intensity * static_cast<double>(luminance);
    if (!(of_white > 0.0)) continue;
    const glm::vec3 colour = light.colour / luminance;
    if (light.kind == SceneLight::Kind::kDirectional) {
      suns_.push_back({-light.world_from_light[0], of_white, colour});
      continue;
    }
    Luminaire kind{.table = {}, .colour = colour, .scale = of_white, .peak_cd = of_white, .has_table = false};
    if (light.kind == SceneLight::Kind::kProfile) {
      kind.table = tables[light.profile];
      kind.has_table = true;
      kind.peak_cd = kind.table.peak_cd() * of_white;
      kind.opening = stated_opening(kind.table);
    } else if (light.kind == SceneLight::Kind::kSpot) {
      kind.cos_inner = std::cos(light.inner_rad);
      kind.cos_outer = std::cos(light.outer_rad);
    }
    lamps_.push_back({light.position_m, glm::transpose(light.world_from_light), luminaires_.size(), light.range_m});
    luminaires_.push_back(std::move(kind));
  }
  return Done{};
}

double FixedLight::candela(const Lamp& lamp, const glm::dvec3& way) const {
  const Luminaire& kind = luminaires_[lamp.luminaire];
  const glm::dvec3 in_lamp = lamp.lamp_from_world * way;
  if (kind.has_table) return kind.scale * kind.table.intensity_cd(in_lamp);
  if (kind.cos_outer < -1.0) return kind.scale;
  // KHR_lights_punctual, "Inner and Outer Cone Angles".
  const double cosine = in_lamp.x / glm::length(in_lamp);
  const double part =
      std::clamp((cosine - kind.cos_outer) / std::max(0.001, kind.cos_inner - kind.cos_outer), 0.0, 1.0);
  return kind.scale * part * part;
}

double FixedLight::open_share(const glm::dvec3& from_m, const Lamp& lamp, double lx, double leave_within_m) const {
  const auto seen = [&](const glm::dvec3& place_m) {
    return !tree_.blocked(from_m, place_m, 1e-3, kOwnHousing_m, leave_within_m);
  };
  const std::optional<LampOpening>& opening = luminaires_[lamp.luminaire].opening;
  if (!opening || lx < kLeastOfOpening_lx) return seen(lamp.position_m) ? 1.0 : 0.0;
  const auto seen_at = [&](std::uint32_t i) {
    const glm::vec2 place = shader::opening_place(i, kOpeningRays, opening->round);
    const glm::dvec2 half_m(0.5 * opening->width_m, 0.5 * opening->height_m);
    return seen(lamp.position_m +
                glm::dvec3(0.0, half_m.x * static_cast<double>(place.x), half_m.y * static_cast<double>(place.y)) *
                    lamp.lamp_from_world);
  };
  // Most points see all of it or nothing. These lie all over it.
  constexpr std::array<std::uint32_t, 3> kFirst{0, 3, 7};
  std::uint32_t open = 0;
  for (const std::uint32_t i : kFirst) open += seen_at(i) ? 1 : 0;
  if (open == 0 || open == kFirst.size()) return open > 0 ? 1.0 : 0.0;
  for (std::uint32_t i = 0; i < kOpeningRays; ++i)
    if (std::ranges::find(kFirst, i) == kFirst.end()) open += seen_at(i) ? 1 : 0;
  return static_cast<double>(open) / kOpeningRays;
}

/// Calls add(share of the surface's lx, colour, direction, lx facing it) for all that reaches the point. `normal`:
/// null, nothing faces away. `of_mesh`: as vertices keep it (kCover_m). `hidden`: for what would
/// reach it and is hidden, all of it.
template <typename Add>
void FixedLight::each(const glm::dvec3& point_m, const glm::dvec3* normal, bool of_mesh, const Add& add,
                      bool hidden) const {
  glm::dvec3 from_m = normal != nullptr ? point_m + kOffSurface_m * *normal : point_m;
  const double leave_within_m = of_mesh ? kWithin_m : 0.0;
  if (of_mesh) from_m += tree_.left_at_m(from_m, *normal, kCover_m) * *normal;
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const Lamp& lamp = lamps_[i];
    const glm::dvec3 way = lamp.position_m - point_m;
    const double r2 = glm::dot(way, way);
    const double reach_m = std::min(lamp.range_m, kStreetLampReach_m);
    if (!(r2 > 0.0) || r2 > reach_m * reach_m) continue;
    const double r = std::sqrt(r2), cosine = normal != nullptr ? glm::dot(way, *normal) / r : 1.0;
    const Luminaire& kind = luminaires_[lamp.luminaire];
    if (kind.peak_cd * cosine < kLeastOfLamp_lx * r2) continue;
    const double facing_lx = candela(lamp, -way) / r2;
    if (facing_lx * cosine < kLeastOfLamp_lx) continue;
    // What moves is lit by its middle alone, and coarsely.
    const double open = open_share(from_m, lamp, normal != nullptr ? facing_lx * cosine : 0.0, leave_within_m);
    if ((open > 0.0) == hidden) continue;
    const double part = hidden ? 1.0 : open;
    add(Share{.lamp = i, .lx = part * facing_lx * cosine}, kind.colour, way / r, part * facing_lx);
  }
  const auto from_far = [&](const Moon& moon, Share share) {
    const double cosine = normal != nullptr ? glm::dot(moon.toward, *normal) : 1.0;
    if (!(cosine > 0.0)) return;
    if (tree_.blocked(from_m, from_m + kBeyondScene_m * moon.toward, 1e-3, 0.0, leave_within_m) != hidden) return;
    share.lx = moon.lx * cosine;
    add(share, moon.colour, moon.toward, moon.lx);
  };
  if (moon_) from_far(*moon_, {});
  for (std::size_t i = 0; i < suns_.size(); ++i) from_far(suns_[i], {.directional = i});
}

std::vector<glm::dvec3> FixedLight::lamps_near(const glm::dvec3& low_m, const glm::dvec3& high_m,
                                               double within_m) const {
  std::vector<glm::dvec3> near;
  for (const Lamp& lamp : lamps_)
    if (glm::distance(lamp.position_m, glm::clamp(lamp.position_m, low_m, high_m)) < within_m)
      near.push_back(lamp.position_m);
  return near;
}

std::vector<FixedLight::Share> FixedLight::shares_at(const glm::dvec3& point_m, const glm::dvec3& normal) const {
  std::vector<Share> shares;
  each(point_m, &normal, false,
       [&](const Share& share, const glm::vec3&, const glm::dvec3&, double) { shares.push_back(share); });
  if (const double lx = reflected_.at(point_m, normal).w; lx > 0.0) shares.push_back({.reflected = true, .lx = lx});
  std::ranges::stable_sort(shares, std::greater(), &Share::lx);
  return shares;
}

std::vector<FixedLight::Hidden> FixedLight::hidden_at(const glm::dvec3& point_m, const glm::dvec3& normal) const {
  std::vector<Hidden> all;
  each(
      point_m, &normal, false,
      [&](const Share& share, const glm::vec3&, const glm::dvec3& way, double) {
        all.push_back({share, share.lamp ? lamps_[*share.lamp].position_m : point_m + kBeyondScene_m * way});
      },
      true);
  std::ranges::stable_sort(all, std::greater(), [](const Hidden& one) { return one.share.lx; });
  return all;
}

double FixedLight::lux_at(const glm::dvec3& point_m, const glm::dvec3& normal) const {
  double sum = 0.0;
  for (const Share& share : shares_at(point_m, normal)) sum += share.lx;
  return sum;
}

bool FixedLight::r_table(const SceneMaterial& material) const {
  return material.r_table && !material.double_sided && material.emission_cdm2 == glm::vec3(0.0f) &&
         (!lamps_.empty() || moon_ || !suns_.empty());
}

namespace {

/// Of one lamp on asphalt, cd/m² by its r-table.
struct RoadLight {
  RoadLobe lobe;
  glm::dvec2 toward{1.0, 0.0};  ///< along the ground, length 1
};

RoadLight road_light(const RoadLobes& lobes, const glm::dvec3& normal, const glm::dvec3& way, double lx) {
  const double up = glm::dot(way, normal);
  const glm::dvec3 level = way - up * normal;
  const double tangent = glm::length(level) / up, across = glm::length(glm::dvec2(level));
  RoadLight light{lobes.at(tangent)};
  if (across > 0.0) light.toward = glm::dvec2(level) / across;
  const double one_over_cos2 = 1.0 + tangent * tangent, q_of_r = one_over_cos2 * std::sqrt(one_over_cos2);
  for (double* number : {&light.lobe.mean, &light.lobe.along, &light.lobe.peak}) *number *= lx * q_of_r;
  return light;
}

/// `reflected`: the share of `diffuse_cdm2` that comes from all sides.
FixedRoad packed(std::vector<RoadLight>& lights, double diffuse_cdm2, double reflected) {
  std::array<float, 24> numbers{};
  double mean = lights.empty() ? 1.0 : reflected;  // in the dark as if diffuse: so it is toward a lit vertex, too
  glm::dvec2 along(0.0);
  std::ranges::stable_sort(lights, std::greater(), [](const RoadLight& light) { return light.lobe.peak; });
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const RoadLobe& lobe = lights[i].lobe;
    const double peak = lobe.peak / diffuse_cdm2, unit = static_cast<double>(shader::kStreakUnit);
    mean += lobe.mean / diffuse_cdm2;
    along += lobe.along / diffuse_cdm2 * lights[i].toward;
    // Weaker than half floats hold sharpness over peak: less than 0.3 % of diffuse light at the sharpest.
    if (i < shader::kRoadStreaks && peak > 0.0 && lobe.sharp / (peak * unit) < 6e4 && 1.0 / (peak * unit) < 6e4) {
      const glm::dvec2 toward = lobe.sharp / (peak * unit) * lights[i].toward;
      numbers[3 + 3 * i] = static_cast<float>(toward.x), numbers[4 + 3 * i] = static_cast<float>(toward.y);
      numbers[5 + 3 * i] = static_cast<float>(1.0 / (peak * unit));
      continue;
    }
    if (i < shader::kRoadStreaks) numbers[5 + 3 * i] = shader::kNoStreak;
    // Of a Poisson kernel the mean and the first harmonic.
    const double root = std::sqrt(1.0 + 2.0 * lobe.sharp), even = peak / root;
    mean += even;
    if (lobe.sharp > 0.0) along += 2.0 * even * (1.0 + lobe.sharp - root) / lobe.sharp * lights[i].toward;
  }
  for (std::size_t i = lights.size(); i < shader::kRoadStreaks; ++i) numbers[5 + 3 * i] = shader::kNoStreak;
  numbers[0] = static_cast<float>(mean), numbers[1] = static_cast<float>(along.x);
  numbers[2] = static_cast<float>(along.y);
  FixedRoad road;
  for (std::size_t i = 0; i < road.halves.size(); ++i)
    road.halves[i] = glm::packHalf2x16({numbers[2 * i], numbers[2 * i + 1]});
  return road;
}

}  // namespace

FixedVertex FixedLight::at(const glm::dvec3& point_m, const glm::dvec3& normal, const SceneMaterial& material,
                           FixedRoad* road, FixedWay* way_to, const glm::dvec4* reflected_lx) const {
  glm::dvec4 sum(0.0);
  glm::dvec3 facing(0.0);
  std::vector<RoadLight> on_road;
  const auto add = [&](const Share& share, const glm::vec3& colour, const glm::dvec3& way, double facing_lx) {
    sum += glm::dvec4(glm::dvec3(colour), 1.0) * share.lx;
    facing += facing_lx * way;
    if (road != nullptr) on_road.push_back(road_light(lobes_, normal, way, share.lx));
  };
  each(point_m, &normal, !material.double_sided, add);
  if (material.double_sided) {  // one number for both sides: leaves, of which one sees either
    const glm::dvec3 back = -normal;
    each(point_m, &back, false, add);
    sum *= 0.5;
  }
  const glm::dvec4 reflected = reflected_lx != nullptr ? *reflected_lx : reflected_at(point_m, normal, material);
  sum += reflected;
  facing += reflected.w * normal;
  const glm::dvec3 rho = glm::max(glm::dvec3(material.reflectance), 1e-3);
  if (road != nullptr) {
    const double reflectance = static_cast<double>(shader::luminance_of(glm::vec3(rho)));
    *road = packed(on_road, sum.w * reflectance / std::numbers::pi, sum.w > 0.0 ? reflected.w / sum.w : 0.0);
  }
  if (way_to != nullptr) {
    const bool turned = !material.double_sided && material.emission_cdm2 == glm::vec3(0.0f);
    *way_to = !turned ? glm::vec3(0.0f) : glm::vec3(sum.w > 0.0 ? facing / sum.w : normal);
  }
  const glm::dvec3 own_lx = glm::dvec3(material.emission_cdm2) * std::numbers::pi / rho;
  return {glm::vec4(glm::vec3(glm::dvec3(sum) + own_lx), static_cast<float>(sum.w)), material.sky_share};
}

glm::dvec4 FixedLight::reflected_at(const glm::dvec3& point_m, const glm::dvec3& normal, const SceneMaterial& material,
                                    std::uint32_t ways) const {
  if (!material.double_sided) return reflected_.at(point_m, normal, true, ways);
  return 0.5 * (reflected_.at(point_m, normal, false, ways) + reflected_.at(point_m, -normal, false, ways));
}

FixedProbe FixedLight::probe(const glm::dvec3& point_m) const {
  FixedProbe probe;
  glm::dvec4 sum(0.0);
  glm::dvec3 from(0.0);
  each(point_m, nullptr, false, [&](const Share&, const glm::vec3& colour, const glm::dvec3& way, double lx) {
    sum += glm::dvec4(glm::dvec3(colour), 1.0) * lx;
    from += lx * way;
  });
  reflected_.each_way(point_m, [&](const glm::dvec3& way, const glm::dvec4& lx) {
    sum += lx;
    from += lx.w * way;
  });
  probe.light = glm::vec4(sum);
  if (sum.w > 0.0) probe.way = glm::vec3(0.5 * from / sum.w);
  if (roofed(point_m)) probe.sky_share = 0.0f;
  return probe;
}

bool FixedLight::roofed(const glm::dvec3& point_m) const {
  return covered_ && tree_.blocked(point_m, point_m + glm::dvec3(0.0, 0.0, 100.0), 1e-3, 0.0);
}

std::vector<GlaringLamp> FixedLight::glare_at(const glm::dvec3& eye_m, const Air& air) const {
  std::vector<GlaringLamp> all;
  for (const Lamp& lamp : lamps_) {
    const glm::dvec3 way = eye_m - lamp.position_m;
    const double r2 = glm::dot(way, way);
    const Luminaire& kind = luminaires_[lamp.luminaire];
    if (!(r2 > 0.0) || r2 > lamp.range_m * lamp.range_m || kind.peak_cd < kLeastOfLamp_lx * r2) continue;
    const double cd = candela(lamp, way);
    if (cd < kLeastOfLamp_lx * r2) continue;
    all.push_back(glaring_lamp(lamp.position_m, cd, kind.colour, eye_m, air));
  }
  std::ranges::stable_sort(all, std::greater(), &GlaringLamp::eye_lx);
  std::vector<GlaringLamp> seen;
  for (const GlaringLamp& lamp : all) {
    if (seen.size() == kMostNearEye) break;
    if (!tree_.blocked(eye_m, lamp.place_m, 1e-3, kOwnHousing_m)) seen.push_back(lamp);
  }
  return seen;
}

std::vector<FixedLight::Mirrored> FixedLight::mirrored_into(const glm::dvec3& eye_m, std::size_t most) const {
  // The ground below the eye: how far down the way is free.
  double free_m = 0.0, hidden_m = 30.0;
  if (!tree_.blocked(eye_m, eye_m - glm::dvec3(0.0, 0.0, hidden_m), 1e-3, 0.0)) return {};
  for (int i = 0; i < 14; ++i) {
    const double middle_m = 0.5 * (free_m + hidden_m);
    (tree_.blocked(eye_m, eye_m - glm::dvec3(0.0, 0.0, middle_m), 1e-3, 0.0) ? hidden_m : free_m) = middle_m;
  }
  const glm::dvec3 mirror_eye_m = eye_m - glm::dvec3(0.0, 0.0, 2.0 * hidden_m);
  std::vector<std::pair<double, Mirrored>> all;
  for (const Lamp& lamp : lamps_) {
    const glm::dvec3 way = mirror_eye_m - lamp.position_m;
    const double r2 = glm::dot(way, way), up_m = lamp.position_m.z - (eye_m.z - hidden_m);
    const Luminaire& kind = luminaires_[lamp.luminaire];
    if (!(up_m > 0.0) || r2 > lamp.range_m * lamp.range_m || kind.peak_cd < kLeastOfLamp_lx * r2) continue;
    const double cd = candela(lamp, way);
    if (cd < kLeastOfLamp_lx * r2) continue;
    all.push_back({cd / r2, {lamp.position_m, kind.colour * static_cast<float>(cd)}});
  }
  std::ranges::stable_sort(all, std::greater(), &std::pair<double, Mirrored>::first);
  std::vector<Mirrored> seen;
  for (const auto& [lx, lamp] : all) {
    if (seen.size() == most) break;
    const double up_m = lamp.place_m.z - (eye_m.z - hidden_m);
    const glm::dvec3 ground_m = glm::mix(lamp.place_m, mirror_eye_m, up_m / (up_m + hidden_m));
    if (!tree_.blocked(ground_m, lamp.place_m, 0.2, kOwnHousing_m)) seen.push_back(lamp);
  }
  return seen;
}

}  // namespace phare
