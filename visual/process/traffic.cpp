#include "visual/process/traffic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <set>

#include "config/base/paths.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

// In generated_dir().
constexpr const char *kLowBeam = "lamps/low_rht.ies", *kHighBeam = "lamps/high.ies", *kBicycle = "lamps/bicycle.ies";

/// Of a kind of road user, in its frame, m. The mesh says where (tools/scene/road_users.cpp, things.cpp).
struct LampPlaces {
  std::string_view node;
  double front_m = 0.0, back_m = 0.0;  ///< before and behind its middle
  double front_up_m = 0.0, back_up_m = 0.0;
  std::array<double, 2> aside_m{};  ///< of two of them; one lamp: only the first counts
  int headlamps = 0, tail_lamps = 0;
  /// Of headlamps: UN R48 6.2.6.1.2, -1 % for lamps below 0.8 m. A bicycle's peak meets the road 10 m ahead, as its
  /// riders are told (unconfirmed: by secondary sources).
  double down_rad = 0.01;
  std::optional<glm::dvec3> third_brake_m{};
};
/// No mesh of a motorcycle is made: a cycle's stands for it. A car's third brake lamp sits at the roof's rear edge.
constexpr std::array<LampPlaces, 6> kPlaces{
    {{"car", 2.18, -2.2, 0.61, 0.8, {-0.6, 0.6}, 2, 2, 0.01, glm::dvec3(-1.4, 0.0, 1.37)},
     {"lorry", 5.03, -5.03, 0.62, 0.82, {-0.95, 0.95}, 2, 2},
     {"bicycle", 0.6, -0.8, 0.75, 0.65, {0.0, 0.0}, 1, 1},
     {"bicycle", 0.6, -0.8, 0.75, 0.65, {0.0, 0.0}, 1, 1, 0.075},
     {"pedestrian"},
     {"deer"}}};

const LampPlaces& places_of(RoadUserClass kind) {
  return kPlaces[static_cast<std::size_t>(kind)];
}

glm::dvec3 front_lamp_m(const Traffic::There& user, int lamp) {
  const LampPlaces& places = places_of(user.kind);
  return user.position_m + user.world_from_user * glm::dvec3(places.front_m,
                                                             places.aside_m[static_cast<std::size_t>(lamp)],
                                                             places.front_up_m);
}
/// Adds a lamp that shines into an eye, unless something hides it.
void add_seen(std::vector<GlaringLamp>& seen, const World& around, const glm::dvec3& lamp_m, const LampShine& shine,
              const glm::dvec3& eye_m, const Air& air) {
  if (shine.cd <= 0.0 || lamp_m == eye_m || occluder(around, lamp_m, eye_m)) return;
  seen.push_back(glaring_lamp(lamp_m, shine.cd, shine.colour, eye_m, air));
}

glm::dmat3 headlamp_turn(const Traffic::There& user) {
  return user.world_from_user * aim_rotation(0.0, -places_of(user.kind).down_rad, 0.0);
}

/// What it names, and the rest as is usual for its kind.
RoadUserLamp headlamp_of(RoadUserClass kind, RoadUserLamp lamp, const char* shipped) {
  if (lamp.file.empty()) lamp.file = generated_dir() / shipped;
  if (!lamp.colour.said())
    lamp.colour.colour_temperature_k = kind == RoadUserClass::bicycle ? kBicycleLamp_k : kHalogen_k;
  return lamp;
}

AimedSource source_of(const LightColour& colour, const IntensityTable* table) {
  AimedSource source{.table = table, .chromaticity_xy = colour.chromaticity_xy};
  source.colour_temperature_k = colour.colour_temperature_k.value_or(source.colour_temperature_k);
  return source;
}

/// Of a lamp at a back, toward `direction` in the vehicle's frame.
double rear_cd(const RearLamp& lamp, double axis_cd, const glm::dvec3& direction) {
  // Half a turn about z: the lamp's own x is backward, its y to the right.
  if (lamp.table != nullptr) return lamp.table->intensity_cd({-direction.x, -direction.y, direction.z});
  return axis_cd * std::max(-direction.x, 0.0);
}

}  // namespace

Result<Traffic> Traffic::read(const std::filesystem::path& file, const std::vector<LanePoint>& lane,
                              const Movers& movers) {
  Traffic traffic;
  if (file.empty()) return traffic;
  auto users = read_road_users(file);
  if (!users) return users.error();
  if (lane.size() < 2) return Error{file.string(), "the scene has no lane beside it that road users would drive along"};
  traffic.users_ = std::move(*users);
  traffic.lane_.emplace(lane);
  if (const auto first = traffic.headlamp({headlamp_of(RoadUserClass::car, {}, kLowBeam)}); !first)
    return first.error();
  for (const RoadUser& user : traffic.users_) {
    const bool bicycle = user.kind == RoadUserClass::bicycle;
    std::vector<RoadUserLamp> lamps{headlamp_of(user.kind, user.low_beam, bicycle ? kBicycle : kLowBeam)};
    if (user.lights == RoadUserLights::high) lamps.push_back(headlamp_of(user.kind, user.high_beam, kHighBeam));
    const auto beam = traffic.headlamp(std::move(lamps));
    if (!beam) return beam.error();
    traffic.headlamp_of_user_.push_back(*beam);
    const auto tail = traffic.rear_lamp(user.tail_lamp), brake = traffic.rear_lamp(user.brake_lamp),
               third = traffic.rear_lamp(user.third_brake_lamp);
    for (const auto* lamp : {&tail, &brake, &third})
      if (!*lamp) return lamp->error();
    traffic.rear_of_user_.push_back({.tail = *tail, .brake = *brake, .third_brake = *third});
  }
  for (const LampPlaces& places : kPlaces) {
    const auto mesh = movers.mesh(places.node);
    if (!mesh) return mesh.error();
    traffic.mesh_of_kind_.push_back(*mesh);
  }
  return traffic;
}

Result<std::size_t> Traffic::headlamp(std::vector<RoadUserLamp> lamps) {
  const auto known = std::ranges::find(headlamps_, lamps, &Headlamp::lamps);
  if (known != headlamps_.end()) return static_cast<std::size_t>(known - headlamps_.begin());
  Headlamp headlamp{.lamps = std::move(lamps)};
  for (const RoadUserLamp& lamp : headlamp.lamps) {
    auto table = read_lamp(lamp.file, {});
    if (!table) return table.error();
    headlamp.tables.push_back(std::move(*table));
  }
  headlamps_.push_back(std::move(headlamp));
  return headlamps_.size() - 1;
}

Result<RearLamp> Traffic::rear_lamp(const RoadUserLamp& named) {
  RearLamp lamp;
  if (named.colour.said()) lamp.colour = light_colour(source_of(named.colour, nullptr));
  if (named.file.empty()) return lamp;
  auto known = rear_lamps_.find(named.file);
  if (known == rear_lamps_.end()) {
    auto table = read_lamp(named.file, {});
    if (!table) return table.error();
    known = rear_lamps_.emplace(named.file, std::move(*table)).first;
  }
  lamp.table = &known->second;
  return lamp;
}

void LampShine::add(double more_cd, const glm::vec3& of_colour) {
  if (more_cd <= 0.0) return;
  cd += more_cd;
  colour = glm::mix(colour, of_colour, static_cast<float>(more_cd / cd));
}

LampShine RearLight::toward(const glm::dvec3& direction) const {
  LampShine shine;
  if (tail_on) shine.add(rear_cd(tail, kTailLamp_cd, direction), tail.colour);
  if (brake_on) shine.add(rear_cd(brake, kBrakeLamp_cd, direction), brake.colour);
  return shine;
}

LampShine RearLight::third_toward(const glm::dvec3& direction) const {
  LampShine shine;
  if (brake_on) shine.add(rear_cd(third_brake, kThirdBrakeLamp_cd, direction), third_brake.colour);
  return shine;
}

LampShine Traffic::Headlamp::toward(const glm::dvec3& direction) const {
  LampShine shine;
  for (std::size_t i = 0; i < tables.size(); ++i)
    shine.add(tables[i].intensity_cd(direction), light_colour(source_of(lamps[i].colour, nullptr)));
  return shine;
}

BeamImage Traffic::beam(std::size_t number) const {
  const Headlamp& headlamp = headlamps_[number];
  std::vector<AimedSource> sources;
  for (std::size_t i = 0; i < headlamp.tables.size(); ++i)
    sources.push_back(source_of(headlamp.lamps[i].colour, &headlamp.tables[i]));
  return compose_beam_image(sources);
}

std::vector<std::size_t> Traffic::beams_to_meet() const {
  std::vector<std::size_t> beams;
  std::vector<std::optional<glm::vec3>> seen;  // nothing: of several colours
  for (std::size_t i = 0; i < users_.size(); ++i) {
    if (users_[i].lights == RoadUserLights::off || places_of(users_[i].kind).headlamps == 0) continue;
    std::optional<glm::vec3> colour;
    for (const RoadUserLamp& lamp : headlamps_[headlamp_of_user_[i]].lamps) {
      const glm::vec3 its = light_colour(source_of(lamp.colour, nullptr));
      const bool mixed = colour && *colour != its;
      colour = its;
      if (!mixed) continue;
      colour.reset();
      break;
    }
    if (std::ranges::find(seen, colour) != seen.end()) continue;
    seen.push_back(colour);
    const bool usual = colour == light_colour({.colour_temperature_k = kHalogen_k});
    beams.push_back(usual ? kBeam : kBeam + headlamp_of_user_[i]);
  }
  if (beams.empty()) beams.push_back(kBeam);
  return beams;
}

std::vector<Traffic::There> Traffic::at(double time_s, const RoadLine& road) const {
  std::vector<There> there;
  for (std::size_t i = 0; i < users_.size(); ++i)
    if (const auto user = there_at(i, time_s, road)) there.push_back(*user);
  return there;
}

std::optional<Traffic::There> Traffic::there_at(std::size_t number, double time_s, const RoadLine& road) const {
  const RoadUser& user = users_[number];
  const std::optional<RoadUserPose> pose = pose_of(user, *lane_, time_s);
  if (!pose) return std::nullopt;
  const MeasurePoint on_road = road.ground(pose->x_m, pose->y_m, pose->z_m);
  const glm::dvec3 heading(std::cos(pose->heading_rad), std::sin(pose->heading_rad), 0.0);
  const glm::dvec3 left = glm::normalize(glm::cross(on_road.normal, heading));
  const glm::dvec3 forward = glm::cross(left, on_road.normal);
  RearLight rear = rear_of_user_[number];
  rear.tail_on = user.lights != RoadUserLights::off;
  rear.brake_on = pose->brakes;
  return There{.kind = user.kind,
               .position_m = on_road.position_m,
               .world_from_user = {forward, left, on_road.normal},
               .lights = user.lights != RoadUserLights::off,
               .number = number,
               .speed_mps = pose->speed_mps,
               .beam = headlamp_of_user_[number],
               .rear = rear};
}

std::vector<SprayingVehicle> Traffic::spraying(std::span<const There> users, double time_s,
                                               const RoadLine& road) const {
  std::vector<SprayingVehicle> vehicles;
  for (const There& user : users) {
    const LampPlaces& places = places_of(user.kind);
    const bool motor = user.kind == RoadUserClass::car || user.kind == RoadUserClass::lorry ||
                       user.kind == RoadUserClass::motorcycle;
    if (!motor || spray_share_01(user.speed_mps) <= 0.0) continue;
    const auto in_world = [&](const There& at, const glm::dvec3& place) {
      return at.position_m + at.world_from_user * place;
    };
    const bool lorry = user.kind == RoadUserClass::lorry, one_track = user.kind == RoadUserClass::motorcycle;
    const LampShine behind = user.rear.toward({-1.0, 0.0, 0.0});
    // Chosen: rear wheels 0.7 m before the back; tyres 0.2 m wide, of a lorry twice two of 0.3 m.
    const glm::dvec3 wheels(places.back_m + 0.7, 0.0, 0.0);
    SprayingVehicle vehicle{.left = user.world_from_user[1],
                            .half_track_m = one_track ? 0.0
                                            : lorry   ? 0.95
                                                      : 0.75,
                            .tyres_m = one_track ? 0.2
                                       : lorry   ? 1.2
                                                 : 0.4,
                            .speed_mps = user.speed_mps,
                            .tail_cd = (places.tail_lamps == 1 ? 0.5 : 1.0) * behind.cd,
                            .tail_colour = behind.colour,
                            .time_s = time_s,
                            .number = static_cast<std::uint32_t>(user.number)};
    vehicle.wheels_m[0] = in_world(user, wheels);
    for (std::size_t i = 1; i < vehicle.wheels_m.size(); ++i) {
      const double ago_s = 0.5 * static_cast<double>(i) * kSprayAge_s;
      const auto then = there_at(user.number, time_s - ago_s, road);
      // Who was not there yet came straight.
      vehicle.wheels_m[i] = then ? in_world(*then, wheels)
                                 : vehicle.wheels_m[0] - user.world_from_user[0] * (user.speed_mps * ago_s);
    }
    for (std::size_t i = 0; i < vehicle.tail_m.size(); ++i)
      vehicle.tail_m[i] = in_world(user, {places.back_m, places.aside_m[i], places.back_up_m});
    vehicles.push_back(vehicle);
  }
  return vehicles;
}

std::vector<PlacedMesh> Traffic::placed_meshes(std::span<const There> users) const {
  std::vector<PlacedMesh> meshes;
  for (const There& user : users)
    meshes.push_back({mesh_of_kind_[static_cast<std::size_t>(user.kind)], user.position_m, user.world_from_user});
  return meshes;
}

std::vector<PlacedMesh> Traffic::one_of_each(const glm::dvec3& place_m) const {
  std::set<std::size_t> meshes;
  for (const RoadUser& user : users_) meshes.insert(mesh_of_kind_[static_cast<std::size_t>(user.kind)]);
  std::vector<PlacedMesh> placed;
  for (const std::size_t mesh : meshes) placed.push_back({mesh, place_m, glm::dmat3(1.0)});
  return placed;
}

std::vector<PlacedLamp> Traffic::placed_lamps(std::span<const There> users, const glm::dvec3& eye_m,
                                              const glm::dvec3& ahead, bool toward_first) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < users.size(); ++i) {
    const bool behind = glm::dot(users[i].position_m - eye_m, ahead) < 0.0;
    if (users[i].lights && !behind) near.push_back(i);
  }
  std::ranges::stable_sort(near, {}, [&](std::size_t i) { return glm::distance(users[i].position_m, eye_m); });
  if (toward_first)
    std::ranges::stable_partition(
        near, [&](std::size_t i) { return glm::dot(headlamp_turn(users[i])[0], eye_m - users[i].position_m) > 0.0; });
  std::vector<PlacedLamp> lamps;
  for (const std::size_t i : near)
    for (int lamp = 0; lamp < places_of(users[i].kind).headlamps && lamps.size() < kMostLamps; ++lamp)
      lamps.push_back({front_lamp_m(users[i], lamp), headlamp_turn(users[i]), kBeam + users[i].beam, i});
  return lamps;
}

std::vector<GlaringLamp> Traffic::glare_at(std::span<const There> users, const glm::dvec3& eye_m, const World& world,
                                           const Air& air) const {
  std::vector<GlaringLamp> sources;
  for (std::size_t i = 0; i < users.size(); ++i) {
    const There& user = users[i];
    if (!user.lights && !user.rear.brake_on) continue;
    const World around = world.without(i);
    const int headlamps = user.lights ? places_of(user.kind).headlamps : 0;
    for (int lamp = 0; lamp < headlamps; ++lamp) {
      const glm::dvec3 lamp_m = front_lamp_m(user, lamp);
      const glm::dvec3 toward_eye = glm::transpose(headlamp_turn(user)) * (eye_m - lamp_m);
      add_seen(sources, around, lamp_m, headlamps_[user.beam].toward(toward_eye), eye_m, air);
    }
    const auto rear = rear_lamps_into(user.kind, user.rear, user.position_m, user.world_from_user, eye_m, around, air);
    sources.insert(sources.end(), rear.begin(), rear.end());
  }
  return sources;
}

std::vector<GlaringLamp> rear_lamps_into(RoadUserClass kind, const RearLight& light, const glm::dvec3& position_m,
                                         const glm::dmat3& world_from_user, const glm::dvec3& eye_m,
                                         const World& around, const Air& air) {
  std::vector<GlaringLamp> seen;
  const LampPlaces& places = places_of(kind);
  const auto in_world = [&](const glm::dvec3& place) { return position_m + world_from_user * place; };
  const auto toward_eye = [&](const glm::dvec3& lamp_m) {
    return glm::transpose(world_from_user) * glm::normalize(eye_m - lamp_m);
  };
  for (int lamp = 0; lamp < places.tail_lamps; ++lamp) {
    const glm::dvec3 lamp_m =
        in_world({places.back_m, places.aside_m[static_cast<std::size_t>(lamp)], places.back_up_m});
    add_seen(seen, around, lamp_m, light.toward(toward_eye(lamp_m)), eye_m, air);
  }
  if (places.third_brake_m) {
    const glm::dvec3 lamp_m = in_world(*places.third_brake_m);
    add_seen(seen, around, lamp_m, light.third_toward(toward_eye(lamp_m)), eye_m, air);
  }
  return seen;
}

std::vector<Traffic::Eye> Traffic::oncoming_eyes(std::span<const There> users, const glm::dvec3& heading) {
  // Eye behind the front and above the road; chosen by eye, as the bodies are. A pedestrian does not drive, nor
  // does a deer.
  constexpr std::array<glm::dvec3, 6> kEyes_m{
      {{0.35, 0.37, 1.2}, {4.2, 0.6, 2.4}, {-0.1, 0.0, 1.5}, {-0.1, 0.0, 1.6}, {0.0, 0.0, 1.65}, {0.5, 0.0, 1.0}}};
  std::vector<Eye> eyes;
  for (std::size_t i = 0; i < users.size(); ++i) {
    const There& user = users[i];
    const bool drives = user.kind != RoadUserClass::pedestrian && user.kind != RoadUserClass::deer;
    if (!drives || glm::dot(user.world_from_user[0], heading) >= 0.0) continue;
    const glm::dvec3 eye_m = user.position_m + user.world_from_user * kEyes_m[static_cast<std::size_t>(user.kind)];
    eyes.push_back({i, {eye_m, user.world_from_user[0]}});
  }
  return eyes;
}

Glare glare_figures(std::span<const GlaringLamp> lamps, const glm::dvec3& eye_m, const glm::dvec3& ahead,
                    const Viewer& viewer) {
  std::vector<GlareSource> sources;
  for (const GlaringLamp& lamp : lamps) {
    const glm::dvec3 way = glm::normalize(lamp.place_m - eye_m);
    const double cos_angle = glm::dot(way, ahead);
    if (cos_angle <= 0.0) continue;
    const double angle_deg = glm::degrees(std::atan2(glm::length(glm::cross(way, ahead)), cos_angle));
    sources.push_back({lamp.eye_lx * cos_angle, angle_deg});
  }
  return glare_at_eye(viewer, sources, kAdaptation_cdm2);
}

Glare glare_at_oncoming_eyes(const Lamps& lamps, const VehicleState& car, std::span<const Traffic::Eye> eyes,
                             const World& world, const Air& air, const Viewer& viewer) {
  Glare most;
  for (const Traffic::Eye& eye : eyes) {
    const auto shining = lamps.glare_at(car, eye.at.position_m, world.without(eye.user), air);
    const Glare glare = glare_figures(shining, eye.at.position_m, eye.at.normal, viewer);
    if (glare.illuminance_lx > most.illuminance_lx) most = glare;
  }
  return most;
}

}  // namespace phare
