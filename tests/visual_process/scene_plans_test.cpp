// unit: what each scene that we make calls for, effect by effect and with the fact that decides: in clear air and in
// weather, alone and among other road users.
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <sstream>

#include "config/base/paths.h"
#include "visual/fixed_light.h"
#include "visual/process/explain.h"

namespace phare {
namespace {

struct Row {
  std::string level;
  std::string reason;  ///< in what is expected: words of it
};
using Plan = std::map<std::string, Row>;  // by the effect's name

struct ScenePlan {
  std::string name;
  std::string rig;
  double at_s_m;                      ///< where on the lane the car stands
  std::string traffic;                ///< of config/examples; empty: the rig's own
  std::vector<DeskCommand> commands;  ///< what is set besides
  Plan other;                         ///< rows that are not those of kDryRoad

  friend void PrintTo(const ScenePlan& scene, std::ostream* to) { *to << scene.name; }
};

/// Low beam in clear air on a dry road without lamps, alone on it, and something at its verge.
const Plan kDryRoad{{"shadows", {"soft", "pieces of the scene stand in the light of the lamps"}},
                    {"depth first", {"off", "near pieces are drawn first"}},
                    {"hdr image", {"off", "nothing reads luminance in cd/m²"}},
                    {"overlay", {"off", "no line of text"}},
                    {"fog", {"off", "the air is clear"}},
                    {"precipitation", {"off", "neither rain nor snow falls"}},
                    {"ground", {"dry", "it does not rain"}},
                    {"glare", {"off", "no lamp shines into the eye"}},
                    {"gui", {"off", "the panel is hidden"}},
                    {"fixed light", {"off", "no street lamp, no moon"}},
                    {"eyeshine", {"off", "no animal's eye"}},
                    {"snow cover", {"off", "no snow lies"}},
                    {"windscreen", {"off", "no windscreen"}},
                    {"spray", {"off", "the ground is dry"}},
                    {"asphalt", {"lambert", "no street lamp and no moon"}}};

const char* const kColumn = "column.toml";

const ScenePlan kScenes[] = {
    {"DryRoad", "country_road", 20.0, "", {}, {}},
    {"Fog80m", "country_road", 20.0, "", {{"visibility_m", "80"}}, {{"fog", {"medium", "visibility 80 m"}}}},
    {"Fog300m", "country_road", 20.0, "", {{"visibility_m", "300"}}, {{"fog", {"medium", "visibility 300 m"}}}},
    {"Rain",
     "country_road",
     20.0,
     "",
     {{"rain_mmph", "10"}},
     {{"hdr image", {"on", "drops and flakes are added to luminance"}},
      {"fog", {"medium", "rain 10 mm/h"}},
      {"precipitation", {"on", "2 lamps light drops"}},
      {"ground", {"wet", "rain of 10 mm/h fills the texture"}},
      {"spray", {"off", "no vehicle in view is fast enough"}}}},
    {"Snow",
     "country_road",
     20.0,
     "",
     {{"snow_mmph", "2"}},
     {{"hdr image", {"on", "drops and flakes are added to luminance"}},
      {"fog", {"medium", "snow 2 mm/h"}},
      {"precipitation", {"on", "2 lamps light flakes"}}}},
    {"Column",
     "country_road",
     20.0,
     kColumn,
     {},
     {{"hdr image", {"on", "light scattered in the eye"}}, {"glare", {"on", "6 lamps shine into the eye"}}}},
    {"ColumnInFogOf80m",
     "country_road",
     20.0,
     kColumn,
     {{"visibility_m", "80"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"fog", {"medium", "visibility 80 m"}},
      {"glare", {"on", "6 lamps shine into the eye"}}}},
    {"ColumnInFogOf300m",
     "country_road",
     20.0,
     kColumn,
     {{"visibility_m", "300"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"fog", {"medium", "visibility 300 m"}},
      {"glare", {"on", "6 lamps shine into the eye"}}}},
    {"ColumnInRain",
     "country_road",
     20.0,
     kColumn,
     {{"rain_mmph", "10"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"fog", {"medium", "rain 10 mm/h"}},
      {"precipitation", {"on", "4 lamps light drops"}},
      {"ground", {"wet", "rain of 10 mm/h fills the texture"}},
      {"glare", {"on", "6 lamps shine into the eye"}},
      {"spray", {"on", "3 vehicles throw up water"}}}},
    {"ColumnInRainBehindAWindscreen",
     "country_road",
     20.0,
     kColumn,
     {{"rain_mmph", "10"}, {"windscreen", "on"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"fog", {"medium", "rain 10 mm/h"}},
      {"precipitation", {"on", "4 lamps light drops"}},
      {"ground", {"wet", "rain of 10 mm/h fills the texture"}},
      {"glare", {"on", "6 lamps shine into the eye"}},
      {"windscreen", {"on", "rain of 10 mm/h falls on the windscreen"}},
      {"spray", {"on", "3 vehicles throw up water"}}}},
    {"ColumnInSnow",
     "country_road",
     20.0,
     kColumn,
     {{"snow_mmph", "2"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"fog", {"medium", "snow 2 mm/h"}},
      {"precipitation", {"on", "4 lamps light flakes"}},
      {"glare", {"on", "6 lamps shine into the eye"}}}},
    {"ColumnOnLyingSnow",
     "country_road",
     20.0,
     kColumn,
     {{"snow_cover", "0.9"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"glare", {"on", "6 lamps shine into the eye"}},
      {"snow cover", {"on", "snow lies on 90 %"}}}},
    {"Cloudburst",
     "country_road",
     20.0,
     "spray.toml",
     {{"rain_mmph", "25"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"fog", {"medium", "rain 25 mm/h"}},
      {"precipitation", {"on", "4 lamps light drops"}},
      {"ground", {"flooded", "stands over the texture of the road"}},
      {"glare", {"on", "2 lamps shine into the eye"}},
      {"spray", {"on", "1 vehicle throws up water"}}}},
    {"Deer", "country_road", 20.0, "deer.toml", {}, {{"eyeshine", {"on", "2 eyes of animals"}}}},
    {"Town",
     "town",
     20.0,
     "",
     {},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"glare", {"on", "10 lamps shine into the eye"}},
      {"fixed light", {"on", "52 street lamps, 5 luminous materials"}},
      {"asphalt", {"r-table", "street lamps or the moon shine on asphalt"}}}},
    {"TownInRain",
     "town",
     20.0,
     "",
     {{"rain_mmph", "4"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"fog", {"medium", "rain 4 mm/h"}},
      {"precipitation", {"on", "lamps light drops"}},
      {"ground", {"wet", "rain of 4 mm/h fills the texture"}},
      {"glare", {"on", "10 lamps shine into the eye"}},
      {"fixed light", {"on", "52 street lamps, 5 luminous materials"}},
      {"spray", {"on", "vehicles throw up water"}},
      {"asphalt", {"lambert", "water lies on it"}}}},
    {"TownWithItsLampsOff",
     "town",
     20.0,
     "",
     {{"fixed_light", "off"}},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"glare", {"on", "5 lamps shine into the eye"}},
      {"fixed light", {"off", "set by the user; by itself: 52 street lamps"}},
      {"asphalt", {"lambert", "street lamps and the moon are not drawn"}}}},
    {"Tunnel",
     "tunnel",
     150.0,
     "",
     {},
     {{"hdr image", {"on", "light scattered in the eye"}},
      {"glare", {"on", "12 lamps shine into the eye"}},
      {"fixed light", {"on", "74 street lamps, 3 luminous materials, a roof over the road"}},
      {"asphalt", {"r-table", "street lamps or the moon shine on asphalt"}}}},
    {"Motorway",
     "motorway",
     20.0,
     "",
     {},
     {{"hdr image", {"on", "light scattered in the eye"}}, {"glare", {"on", "8 lamps shine into the eye"}}}},
};

/// What the drive's own --explain says, row by row.
void find_plan(const ScenePlan& of, Plan& plan) {
  Result<Rig> rig = read_rig(config_dir() / "rigs" / (of.rig + ".toml"));
  ASSERT_TRUE(rig) << rig.error().text();
  Desk desk = rig->desk;
  for (const DeskCommand& command : of.commands) ASSERT_TRUE(apply(desk, command, {.designs = rig->designs.size()}));
  Result<Lamps> lamps = Lamps::load(*rig);
  Result<Scene> scene = read_scene(rig->scene_file);
  Result<std::vector<LanePoint>> lane = read_lane(lane_file_of(rig->scene_file));
  Result<Movers> movers = Movers::read();
  ASSERT_TRUE(lamps && scene && lane && movers);
  const std::filesystem::path users =
      of.traffic.empty() ? std::filesystem::path(rig->traffic_file) : config_dir() / "examples" / of.traffic;
  Result<Traffic> traffic = Traffic::read(users, *lane, *movers);
  ASSERT_TRUE(traffic) << traffic.error().text();
  const Result<FixedLight> fixed = FixedLight::of(*scene, rig->street_lamps_file, rig->moon);
  ASSERT_TRUE(fixed) << fixed.error().text();
  AskedMoment moment;
  moment.controls.light_switch = LightSwitch::kLow;
  const LanePoint at = *LaneLine(*lane).at(of.at_s_m, 0.0);
  moment.pose.x_m = at.x_m, moment.pose.y_m = at.y_m, moment.pose.z_m = at.z_m, moment.pose.yaw_rad = at.heading_rad;
  std::istringstream lines(explain_moment(*lamps, desk, rig->channels[0], moment, "llvmpipe", *scene, *movers, *traffic,
                                          RoadLine(*lane, rig->scene_file), *fixed, false));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    const std::size_t level_end = line.find(' ', 16), reason = line.find_first_not_of(' ', level_end);
    plan[line.substr(0, line.find("  "))] = {line.substr(16, level_end - 16), line.substr(reason)};
  }
}

class ScenePlans : public testing::TestWithParam<ScenePlan> {};

TEST_P(ScenePlans, EveryEffectHasItsLevelAndItsReason) {
  Plan plan, expected = GetParam().other;
  ASSERT_NO_FATAL_FAILURE(find_plan(GetParam(), plan));
  expected.insert(kDryRoad.begin(), kDryRoad.end());
  ASSERT_EQ(plan.size(), kEffectCount);
  ASSERT_EQ(expected.size(), kEffectCount);
  for (const EffectRow& row : effect_table()) {
    const std::string effect(row.name);
    ASSERT_TRUE(plan.contains(effect) && expected.contains(effect)) << effect;
    EXPECT_EQ(plan[effect].level, expected[effect].level) << effect << ": " << plan[effect].reason;
    EXPECT_NE(plan[effect].reason.find(expected[effect].reason), std::string::npos)
        << effect << " is " << plan[effect].level << " since " << plan[effect].reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ScenePlans, testing::ValuesIn(kScenes),
                         [](const testing::TestParamInfo<ScenePlan>& scene) { return scene.param.name; });

}  // namespace
}  // namespace phare
