#include "visual/fixed_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "config/base/on_all_cores.h"
#include "shaders/lib/luminance.h"
#include "shaders/lib/road.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/renderer.h"
#include "visual/scene/refine.h"

namespace phare {
namespace {

constexpr double kMoon_k = 4100.0;       // sunlight that the moon has reddened; a usual figure
constexpr double kOffSurface_m = 0.005;  // vertices lie on edges of their neighbours
// A vertex of a wall may lie behind a window, of a pavement under a pole, where nobody sees it: dark, it would darken
// what is seen a metre around. So light falls on it as if what lies on it so thinly, or it lies within so deeply, were
// not there.
constexpr double kCover_m = 0.15, kWithin_m = 0.3;
constexpr double kBeyondScene_m = 5000.0;
constexpr double kFloor_lx = 0.5;   // the error is that of so many lux where there are fewer
constexpr double kLongest_m = 6.0;  // a longer side may have a pool of light between its ends
constexpr int kMostCuts = 7;
constexpr double kStreaksOff = 2.0;  // times the tolerance: luminance of asphalt by its r-table, from any side

/// Columns: axis (down, tilted up toward the street side), left, and the street side as the lamp's "up".
glm::dmat3 world_from_luminaire(double yaw_rad, double tilt_rad) {
  const glm::dvec3 street(std::cos(yaw_rad), std::sin(yaw_rad), 0.0), down(0.0, 0.0, -1.0);
  const glm::dvec3 axis = std::cos(tilt_rad) * down + std::sin(tilt_rad) * street;
  const glm::dvec3 up = std::cos(tilt_rad) * street - std::sin(tilt_rad) * down;
  return {axis, glm::cross(up, axis), up};
}

}  // namespace

Result<FixedLight> FixedLight::of(const Scene& scene, const std::filesystem::path& street_lamps,
                                  const std::optional<MoonConfig>& moon) {
  FixedLight light;
  if (!street_lamps.empty()) {
    const auto config = read_street_lamps(street_lamps);
    if (!config) return config.error();
    light.level_ = kBakeLevels[static_cast<std::size_t>(config->fineness)];
    if (!config->r_table_file.empty()) {
      const auto table = read_r_table(config->r_table_file);
      if (!table) return table.error();
      light.lobes_ = RoadLobes::of(*table);
    }
    for (const LuminaireConfig& kind : config->luminaires) {
      auto table = read_lamp(kind.file, {});
      if (!table) return table.error();
      const double peak_cd = table->peak_cd() * kind.scale;
      light.luminaires_.push_back({std::move(*table), {}, kind.scale, peak_cd});
      Luminaire& last = light.luminaires_.back();
      last.colour = light_colour({.table = &last.table, .colour_temperature_k = kind.colour_temperature_k});
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
  if (!light.lamps_.empty() || light.moon_ || !light.suns_.empty()) light.tree_ = RayTree(scene);
  return light;
}

/// What is dark, black or off is left out.
Status FixedLight::add_lights_of(const Scene& scene) {
  std::vector<IntensityTable> tables;
  for (const LightProfile& profile : scene.light_profiles) {
    LampReadSettings settings;
    settings.format = LampFormat::kLm63;
    settings.folder = profile.file.parent_path();
    const std::string name =
        profile.file.empty() ? scene.file.string() + ": " + profile.name : profile.name;
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
    } else if (light.kind == SceneLight::Kind::kSpot) {
      kind.cos_inner = std::cos(light.inner_rad);
      kind.cos_outer = std::cos(light.outer_rad);
    }
    lamps_.push_back({light.position_m, glm::transpose(light.world_from_light), luminaires_.size(),
                      light.range_m});
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

/// Calls add(share of the surface's lx, colour, direction, lx facing it) for all that reaches the point. `normal`:
/// null, nothing faces away. `of_mesh`: as vertices keep it (kCover_m).
template <typename Add>
void FixedLight::each(const glm::dvec3& point_m, const glm::dvec3* normal, bool of_mesh, const Add& add) const {
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
    if (tree_.blocked(from_m, lamp.position_m, 1e-3, kOwnHousing_m, leave_within_m)) continue;
    add(Share{.lamp = i, .lx = facing_lx * cosine}, kind.colour, way / r, facing_lx);
  }
  const auto from_far = [&](const Moon& moon, Share share) {
    const double cosine = normal != nullptr ? glm::dot(moon.toward, *normal) : 1.0;
    if (!(cosine > 0.0) || tree_.blocked(from_m, from_m + kBeyondScene_m * moon.toward, 1e-3, 0.0, leave_within_m))
      return;
    share.lx = moon.lx * cosine;
    add(share, moon.colour, moon.toward, moon.lx);
  };
  if (moon_) from_far(*moon_, {});
  for (std::size_t i = 0; i < suns_.size(); ++i) from_far(suns_[i], {.directional = i});
}

std::vector<FixedLight::Share> FixedLight::shares_at(const glm::dvec3& point_m, const glm::dvec3& normal) const {
  std::vector<Share> shares;
  each(point_m, &normal, false,
       [&](const Share& share, const glm::vec3&, const glm::dvec3&, double) { shares.push_back(share); });
  std::ranges::stable_sort(shares, std::greater(), &Share::lx);
  return shares;
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

FixedRoad packed(std::vector<RoadLight>& lights, double diffuse_cdm2) {
  std::array<float, 24> numbers{};
  double mean = lights.empty() ? 1.0 : 0.0;  // in the dark as if diffuse: so it is between that and a lit vertex, too
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
                           FixedRoad* road, FixedWay* way_to) const {
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
  const glm::dvec3 rho = glm::max(glm::dvec3(material.reflectance), 1e-3);
  if (road != nullptr) {
    const double reflectance = static_cast<double>(shader::luminance_of(glm::vec3(rho)));
    *road = packed(on_road, sum.w * reflectance / std::numbers::pi);
  }
  if (way_to != nullptr) {
    const bool turned = !material.double_sided && material.emission_cdm2 == glm::vec3(0.0f);
    *way_to = !turned ? glm::vec3(0.0f) : glm::vec3(sum.w > 0.0 ? facing / sum.w : normal);
  }
  const glm::dvec3 own_lx = glm::dvec3(material.emission_cdm2) * std::numbers::pi / rho;
  return {glm::vec4(glm::vec3(glm::dvec3(sum) + own_lx), static_cast<float>(sum.w)), material.sky_share};
}

FixedProbe FixedLight::probe(const glm::dvec3& point_m) const {
  FixedProbe probe;
  glm::dvec4 sum(0.0);
  glm::dvec3 from(0.0);
  each(point_m, nullptr, false,
       [&](const Share&, const glm::vec3& colour, const glm::dvec3& way, double lx) {
         sum += glm::dvec4(glm::dvec3(colour), 1.0) * lx;
         from += lx * way;
       });
  probe.light = glm::vec4(sum);
  if (sum.w > 0.0) probe.way = glm::vec3(0.5 * from / sum.w);
  if (covered_ && tree_.blocked(point_m, point_m + glm::dvec3(0.0, 0.0, 100.0), 1e-3, 0.0)) probe.sky_share = 0.0f;
  return probe;
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
    if (seen.size() == kMostGlaringLamps) break;
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

namespace {

/// The light at a vertex, asked once for each place and normal of a chunk.
class Baker {
 public:
  Baker(const FixedLight& light, const Scene& scene, const SceneChunk& chunk)
      : light_(light),
        material_(scene.materials[chunk.material]),
        origin_m_(chunk.origin_m),
        r_table_(light.r_table(material_)),
        relief_(material_.look.relief()) {}

  void add(FixedMesh& mesh, const SceneVertex& vertex) {
    const Kept& kept = at(vertex);
    mesh.light.push_back(kept.light);
    if (r_table_) mesh.road.push_back(kept.road);
    if (relief_) mesh.ways.push_back(kept.way);
  }

  /// Sides whose middle is off by more than the level allows are halved, in both triangles that share them.
  void cut(FixedMesh& mesh, const BakeLevel& level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<std::uint32_t>> middle_of;
    for (int cut = 0; cut < kMostCuts; ++cut) {
      bool any = false;
      const auto middle = [&](std::uint32_t i, std::uint32_t j) -> std::optional<std::uint32_t> {
        const auto [found, fresh] = middle_of.try_emplace(std::minmax(i, j));
        if (fresh) found->second = halved(mesh, i, j, level);
        any = any || found->second;
        return found->second;
      };
      std::vector<std::uint32_t> next;
      for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const std::array<std::uint32_t, 3> c{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
        const std::array<std::optional<std::uint32_t>, 3> m{middle(c[0], c[1]), middle(c[1], c[2]), middle(c[2], c[0])};
        split(next, c, m);
      }
      mesh.indices = std::move(next);
      if (!any) break;
    }
  }

 private:
  struct Kept {
    FixedVertex light;
    FixedRoad road;
    FixedWay way{0.0f};
  };

  const Kept& at(const SceneVertex& vertex) {
    const auto key = std::bit_cast<std::array<std::uint32_t, 6>>(vertex);
    const auto [found, fresh] = known_.try_emplace(key);
    if (fresh)
      found->second.light =
          light_.at(origin_m_ + glm::dvec3(vertex.position_m), glm::normalize(glm::dvec3(vertex.normal)), material_,
                    r_table_ ? &found->second.road : nullptr, relief_ ? &found->second.way : nullptr);
    return found->second;
  }

  /// Of asphalt luminance, from all around, is off by more in the middle.
  static bool streaks_off(const FixedMesh& mesh, std::uint32_t i, std::uint32_t j, const Kept& middle,
                          const BakeLevel& level) {
    constexpr int kWays = 24;  // half as wide as a streak of a lamp 20° over the road
    std::array<double, kWays> exact, between;
    double most = 0.0;
    for (int k = 0; k < kWays; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / kWays;
      const glm::vec2 way(std::cos(turn), std::sin(turn));
      const auto seen = [&way](const FixedVertex& light, const FixedRoad& road) {
        const auto word = [&road](std::size_t at) {
          return shader::uvec4(road.halves[at], road.halves[at + 1], road.halves[at + 2], road.halves[at + 3]);
        };
        return static_cast<double>(light.light.w * shader::of_the_table(word(0), word(4), word(8), way));
      };
      const auto at = static_cast<std::size_t>(k);
      exact[at] = seen(middle.light, middle.road);
      between[at] = 0.5 * (seen(mesh.light[i], mesh.road[i]) + seen(mesh.light[j], mesh.road[j]));
      most = std::max(most, exact[at]);
    }
    if (most < kFloor_lx) return false;
    for (std::size_t k = 0; k < kWays; ++k)
      if (std::abs(exact[k] - between[k]) > kStreaksOff * level.tolerance * std::max(exact[k], 0.25 * most))
        return true;
    return false;
  }

  std::optional<std::uint32_t> halved(FixedMesh& mesh, std::uint32_t i, std::uint32_t j, const BakeLevel& level) {
    const SceneVertex a = mesh.vertices[i], b = mesh.vertices[j];
    const double length_m = static_cast<double>(glm::distance(a.position_m, b.position_m));
    if (length_m < 2.0 * level.least_edge_m) return std::nullopt;
    const glm::vec3 normal = a.normal + b.normal;
    if (glm::dot(normal, normal) < 1e-6f) return std::nullopt;
    const SceneVertex between{0.5f * (a.position_m + b.position_m), glm::normalize(normal)};
    const double at_a = static_cast<double>(mesh.light[i].light.w), at_b = static_cast<double>(mesh.light[j].light.w);
    const Kept& middle = at(between);
    const double exact = static_cast<double>(middle.light.light.w);
    const bool off = std::abs(exact - 0.5 * (at_a + at_b)) > level.tolerance * std::max(exact, kFloor_lx);
    const bool unseen = length_m > kLongest_m && std::max({at_a, at_b, exact}) > 0.1 * kFloor_lx;
    if (!off && !unseen && !(r_table_ && streaks_off(mesh, i, j, middle, level))) return std::nullopt;
    mesh.vertices.push_back(between);
    add(mesh, between);
    if (!mesh.looks.empty()) mesh.looks.push_back(look_between(mesh.looks[i], mesh.looks[j]));
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  }

  static void split(std::vector<std::uint32_t>& out, std::array<std::uint32_t, 3> c,
                    std::array<std::optional<std::uint32_t>, 3> m) {
    const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t d) { out.insert(out.end(), {a, b, d}); };
    const int count = (m[0] ? 1 : 0) + (m[1] ? 1 : 0) + (m[2] ? 1 : 0);
    if (count == 0) return emit(c[0], c[1], c[2]);
    if (count == 3) {
      emit(c[0], *m[0], *m[2]);
      emit(c[1], *m[1], *m[0]);
      emit(c[2], *m[2], *m[1]);
      return emit(*m[0], *m[1], *m[2]);
    }
    // Turned so that the first side is halved, and of two the second as well.
    while (!(m[0] && (count == 1 || m[1]))) {
      std::rotate(c.begin(), c.begin() + 1, c.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    if (count == 1) {
      emit(c[0], *m[0], c[2]);
      return emit(*m[0], c[1], c[2]);
    }
    emit(*m[0], c[1], *m[1]);
    emit(c[0], *m[0], *m[1]);
    emit(c[0], *m[1], c[2]);
  }

  const FixedLight& light_;
  const SceneMaterial& material_;
  glm::dvec3 origin_m_;
  bool r_table_, relief_;
  std::map<std::array<std::uint32_t, 6>, Kept> known_;
};
static_assert(sizeof(SceneVertex) == sizeof(std::array<std::uint32_t, 6>));

}  // namespace

std::vector<FixedLight::Meshes> FixedLight::meshes(const Scene& scene) const {
  std::vector<Meshes> all(scene.chunks.size());
  on_all_cores(all.size(), [&](std::size_t i) {
    const SceneChunk& chunk = scene.chunks[i];
    Baker baker(*this, scene, chunk);
    for (std::size_t level = 0; level < all[i].size(); ++level) {
      FixedMesh& mesh = all[i][level];
      BakeLevel cuts = level_;
      if (level == 0) {
        const auto vertices = scene.vertices.begin() + chunk.first_vertex;
        const auto indices = scene.indices.begin() + chunk.first_index;
        mesh.vertices.assign(vertices, vertices + chunk.vertex_count);
        mesh.indices.assign(indices, indices + chunk.index_count);
        if (chunk.first_look) {
          const auto looks = scene.looks.begin() + *chunk.first_look;
          mesh.looks.assign(looks, looks + chunk.vertex_count);
        }
      } else {
        const double from_m = kFarLevels[level - 1].from * kFarMeshFrom_m;
        FarMesh far = far_mesh(scene, chunk, level - 1, from_m);
        mesh.vertices = std::move(far.vertices), mesh.indices = std::move(far.indices);
        mesh.looks = std::move(far.looks);
        cuts.least_edge_m = std::max(cuts.least_edge_m, 0.015 * from_m);  // a hundred pixels wide, seen edge on
      }
      for (const SceneVertex& vertex : mesh.vertices) baker.add(mesh, vertex);
      if (!lamps_.empty() || !suns_.empty()) baker.cut(mesh, cuts);
    }
  });
  return all;
}

}  // namespace phare
