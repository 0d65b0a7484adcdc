// Ladders of the effects that a scene calls for: each in a moment of the shipped country road that calls for it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "config/base/paths.h"
#include "config/road/lane.h"
#include "tools/cost/frame_clock.h"
#include "tools/cost/measure_ladders.h"
#include "visual/fixed_light.h"
#include "visual/process/explain.h"

namespace phare::cost {
namespace {

struct EffectScene {
  std::optional<Effect> effect;       ///< whose levels; nothing: all that a scene has to call for, off and left to it
  const char* ladder;                 ///< its name, as a file's
  const char* where;                  ///< the moment in words
  double from_s_m;                    ///< along the lane
  double at_s;                        ///< of simulated time: where others are, how long it has rained on the glass
  const char* traffic;                ///< of config/examples; empty: nobody else
  std::vector<DeskCommand> commands;  ///< what is set
  LightSwitch light = LightSwitch::kLow;
};

const std::vector<EffectScene>& scenes() {
  static const std::vector<EffectScene> all{
      {Effect::kPrecipitation, "precipitation", "snow of 2 mm/h", 2.0, 1.0, "", {{"snow_mmph", "2"}}},
      {Effect::kWetGround, "ground", "rain of 25 mm/h", 2.0, 1.0, "", {{"rain_mmph", "25"}}},
      {Effect::kGlare, "glare", "an oncoming column", 2.0, 1.0, "column.toml", {}},
      {Effect::kSnowCover,
       "snow-cover",
       "snow on nine tenths of the ground",
       2.0,
       1.0,
       "",
       {{"snow_cover", "0.9"}, {"exposure_per_cdm2", "0.06"}}},
      {Effect::kSpray,
       "spray",
       "a lorry at 90 km/h in rain of 25 mm/h",
       2.0,
       0.75,
       "spray.toml",
       {{"rain_mmph", "25"}}},
      {Effect::kWindscreen,
       "windscreen",
       "an oncoming column in rain of 10 mm/h, the wiper stands",
       2.0,
       1.3,
       "column.toml",
       {{"rain_mmph", "10"}, {"windscreen", "on"}, {"wiper", "off"}}},
      {Effect::kEyeshine,
       "eyeshine",
       "two deer 80 and 95 m ahead in high beam",
       120.0,
       0.0,
       "deer.toml",
       {},
       LightSwitch::kHigh},
      {std::nullopt, "nothing", "a dry road in clear air, nobody else on it", 2.0, 1.0, "", {}}};
  return all;
}

constexpr double kSpeed_mps = 50.0 / 3.6;  // of the car: drops fall past it

/// A level as it is drawn, and what came of it.
struct Drawn {
  Level level;
  EffectChoices choices{};
  std::vector<double> times_ms{};
};

std::vector<Drawn> levels_of(const EffectScene& scene) {
  std::vector<Drawn> levels;
  if (scene.effect) {
    const auto at = static_cast<std::size_t>(*scene.effect);
    for (const std::string_view name : effect_table()[at].levels) {
      Drawn& one = levels.emplace_back(Drawn{.level = {.name = std::string(name)}});
      one.choices[at] = levels.size() - 1;
    }
    return levels;
  }
  Drawn& off = levels.emplace_back(Drawn{.level = {.name = "all set off"}});
  for (const EffectRow& row : effect_table())
    if (row.only_where_called_for) off.choices[static_cast<std::size_t>(row.effect)] = 0;
  levels.push_back({.level = {.name = "left to the scene"}});
  return levels;
}

/// All that the country road is read from, once for all scenes.
struct Country {
  Rig rig;
  Lamps lamps;
  Scene scene;
  std::vector<LanePoint> lane;
  Movers movers;
  std::shared_ptr<const FixedLight> fixed = std::make_shared<const FixedLight>();

  static Result<Country> read() {
    Result<Rig> rig = read_rig(config_dir() / "rigs/country_road.toml");
    if (!rig) return rig.error();
    Result<Lamps> lamps = Lamps::load(*rig);
    if (!lamps) return lamps.error();
    Result<Scene> scene = read_scene(rig->scene_file);
    if (!scene) return scene.error();
    Result<std::vector<LanePoint>> lane = read_lane(lane_file_of(rig->scene_file));
    if (!lane) return lane.error();
    Result<Movers> movers = Movers::read();
    if (!movers) return movers.error();
    return Country{std::move(*rig), std::move(*lamps), std::move(*scene), std::move(*lane), std::move(*movers)};
  }
};

/// Frames of the scene, one metre of the way after the other.
Result<std::vector<FrameInput>> frames_of(const EffectScene& scene, Country& country, const Traffic& traffic,
                                          int count) {
  Desk desk = country.rig.desk;
  for (const DeskCommand& command : scene.commands)
    if (const auto done = apply(desk, command, {.designs = country.rig.designs.size()}); !done) return done.error();
  const RoadLine road(country.lane, country.rig.scene_file);
  const LaneLine lane(country.lane);
  std::vector<FrameInput> frames;
  for (int i = 0; i < count; ++i) {
    const auto at = lane.at(scene.from_s_m + i, 0.0);
    if (!at) return Error{country.rig.scene_file.string(), "its lane is too short"};
    AskedMoment moment{.time = {static_cast<std::int64_t>(scene.at_s * 1e9)}};
    moment.controls.light_switch = scene.light;
    moment.pose.x_m = at->x_m, moment.pose.y_m = at->y_m, moment.pose.z_m = at->z_m;
    moment.pose.yaw_rad = at->heading_rad, moment.pose.speed_mps = kSpeed_mps;
    frames.push_back(frame_of_moment(country.lamps, desk, country.rig.channels.front(), moment, country.scene,
                                     country.movers, traffic, road, *country.fixed));
  }
  return frames;
}

/// Steps of the display between two pictures, red, green and blue.
void add_differences(std::vector<double>& to, const Image8& found, const Image8& reference) {
  for (std::size_t i = 0; i < found.rgba.size(); ++i)
    if (i % 4 != 3) to.push_back(static_cast<double>(found.rgba[i]) - static_cast<double>(reference.rgba[i]));
}

Result<Ladder> ladder_of(const EffectScene& scene, Country& country, Renderer& renderer, const Plan& plan,
                         const FrameClock& clock, double done_01) {
  plan.progress(scene.ladder, done_01);
  const std::filesystem::path users = *scene.traffic == '\0' ? "" : config_dir() / "examples" / scene.traffic;
  Result<Traffic> traffic = Traffic::read(users, country.lane, country.movers);
  if (!traffic) return traffic.error();
  const Result<std::vector<FrameInput>> frames = frames_of(scene, country, *traffic, plan.quick ? 2 : 3);
  if (!frames) return frames.error();
  for (const PlacedLamp& lamp : frames->front().lamps)
    if (!Traffic::is_theirs(lamp)) renderer.set_beam(lamp.beam, country.lamps.image(lamp.beam));
  for (std::size_t number = 0; number < traffic->beams(); ++number)
    renderer.set_beam(Traffic::kBeam + number, traffic->beam(number));

  std::vector<Drawn> levels = levels_of(scene);
  const auto input_of = [&](const Drawn& level, std::size_t frame) {
    FrameInput input = (*frames)[frame];
    for (std::size_t i = 0; i < kEffectCount; ++i)
      if (level.choices[i]) input.effects[i] = level.choices[i];
    return input;
  };
  // From the highest level down, which the others are held to.
  std::vector<Image8> references;
  for (std::size_t k = levels.size(); k-- > 0;) {
    std::vector<double> differences;
    for (std::size_t frame = 0; frame < frames->size(); ++frame) {
      FrameInput input = input_of(levels[k], frame);
      input.want_image = true;
      const EffectPlan effects = renderer.draw(input).effects;
      const Image8 seen = renderer.read_image();
      if (k + 1 == levels.size()) {
        references.push_back(seen);
        if (scene.effect && effects.level(*scene.effect) != k)
          return Error{scene.ladder, "its scene does not call for it: " + effects[*scene.effect].reason};
      }
      add_differences(differences, seen, references[frame]);
    }
    const auto differing =
        std::ranges::count_if(differences, [](double difference) { return std::abs(difference) > 1.0; });
    char note[64];
    std::snprintf(note, sizeof note, "off by more than a step: %.3g %% of the values",
                  100.0 * static_cast<double>(differing) / static_cast<double>(differences.size()));
    levels[k].level.note = note;
    levels[k].level.error = errors_of(std::move(differences));
  }
  // Turn by turn, after a frame of the same level, as in a drive; what a level holds and the next has not is given up
  // by the second frame without it.
  const int rounds = plan.quick ? 9 : 40;
  for (int round = 0; round < rounds; ++round)
    for (Drawn& one : levels) {
      const FrameInput input = input_of(one, static_cast<std::size_t>(round) % frames->size());
      for (int i = 0; i < 2; ++i) renderer.draw(input);
      one.times_ms.push_back(clock.draw_ms(renderer, input));
      one.level.memory_bytes = renderer.device_memory_bytes();
    }
  Ladder ladder{
      .name = scene.ladder,
      .what = std::string(scene.where) + (scene.effect ? ": levels of the effect, all else as the scene calls for it"
                                                       : ": what only a scene calls for, set off and left to it"),
      .reference = "the picture at the highest level",
      .error_unit = "of 255",
      .time_unit = clock.unit()};
  for (Drawn& one : levels) {
    one.level.time = times_of(std::move(one.times_ms));
    ladder.levels.push_back(std::move(one.level));
  }
  return ladder;
}

}  // namespace

Result<EffectLadders> effect_ladders(const Plan& plan) {
  Result<Country> country = Country::read();
  if (!country) return country.error();
  Result<Renderer> renderer = Renderer::create({.width_px = plan.width_px, .height_px = plan.height_px});
  if (!renderer) return renderer.error();
  if (const Status loaded = renderer->load_scene(country->scene, country->movers.meshes(), country->fixed); !loaded)
    return loaded.error();
  const FrameClock clock;
  EffectLadders found{.device = renderer->device(), .ladders = {}};
  for (const EffectScene& scene : scenes()) {
    const double done_01 = static_cast<double>(found.ladders.size()) / static_cast<double>(scenes().size());
    Result<Ladder> ladder = ladder_of(scene, *country, *renderer, plan, clock, done_01);
    if (!ladder) return ladder.error();
    found.ladders.push_back(std::move(*ladder));
  }
  return found;
}

}  // namespace phare::cost
