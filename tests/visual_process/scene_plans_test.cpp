// unit: what each scene that we make calls for, effect by effect, as its rig and its script begin.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "config/base/paths.h"
#include "visual/fixed_light.h"
#include "visual/process/explain.h"

namespace phare {
namespace {

using Plan = std::map<std::string, std::string>;

/// Name of each effect and its level. `desk`: what is set besides.
Plan plan_of(const char* rig_name, double at_s_m, const std::vector<DeskCommand>& commands = {},
             std::string* text = nullptr) {
  Plan plan;
  Result<Rig> rig = read_rig(config_dir() / "rigs" / (std::string(rig_name) + ".toml"));
  EXPECT_TRUE(rig) << rig.error().text();
  if (!rig) return plan;
  Desk desk = rig->desk;
  for (const DeskCommand& command : commands) EXPECT_TRUE(apply(desk, command, {.designs = rig->designs.size()}));
  Result<Lamps> lamps = Lamps::load(*rig);
  Result<Scene> scene = read_scene(rig->scene_file);
  Result<std::vector<LanePoint>> lane = read_lane(lane_file_of(rig->scene_file));
  Result<Movers> movers = Movers::read();
  EXPECT_TRUE(lamps && scene && lane && movers);
  if (!lamps || !scene || !lane || !movers) return plan;
  Result<Traffic> traffic = Traffic::read(rig->traffic_file, *lane, *movers);
  EXPECT_TRUE(traffic) << traffic.error().text();
  const Result<FixedLight> fixed = FixedLight::of(*scene, rig->street_lamps_file, rig->moon);
  EXPECT_TRUE(fixed) << fixed.error().text();
  if (!traffic || !fixed) return plan;
  AskedMoment moment;
  moment.controls.light_switch = LightSwitch::kLow;
  const LanePoint at = *LaneLine(*lane).at(at_s_m, 0.0);
  moment.pose.x_m = at.x_m, moment.pose.y_m = at.y_m, moment.pose.z_m = at.z_m, moment.pose.yaw_rad = at.heading_rad;
  const std::string all = explain_moment(*lamps, desk, rig->channels[0], moment, "llvmpipe", *scene, *movers, *traffic,
                                         RoadLine(*lane, rig->scene_file), *fixed, false);
  if (text != nullptr) *text = all;
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("#")) plan[line.substr(0, line.find("  "))] = line.substr(16, line.find(' ', 16) - 16);
  return plan;
}

Plan expected(const Plan& on) {
  Plan plan{{"shadows", "off"}, {"depth first", "off"},   {"hdr image", "off"}, {"overlay", "off"},
            {"fog", "off"},     {"precipitation", "off"}, {"ground", "dry"},    {"glare", "off"},
            {"gui", "off"},     {"fixed light", "off"}, {"eyeshine", "off"},  {"snow cover", "off"},
            {"windscreen", "off"}, {"spray", "off"},    {"asphalt", "lambert"}};
  for (const auto& [effect, level] : on) plan[effect] = level;
  return plan;
}

TEST(ScenePlans, TheTownStreetCallsForItsLampsAndTheirGlare) {
  std::string text;
  EXPECT_EQ(plan_of("town", 20.0, {}, &text),
            expected({{"shadows", "soft"},
                      {"hdr image", "on"},
                      {"glare", "on"},
                      {"fixed light", "on"},
                      {"asphalt", "r-table"}}))
      << text;
  EXPECT_NE(text.find("street lamps, 5 luminous materials\n"), std::string::npos) << text;
}

TEST(ScenePlans, TheTownStreetInRainCallsForWaterBesides) {
  std::string text;
  EXPECT_EQ(plan_of("town", 20.0, {{"rain_mmph", "4"}}, &text), expected({{"shadows", "soft"},
                                                                          {"hdr image", "on"},
                                                                          {"fog", "medium"},
                                                                          {"precipitation", "on"},
                                                                          {"ground", "wet"},
                                                                          {"glare", "on"},
                                                                          {"fixed light", "on"},
                                                                          {"spray", "on"}}))
      << text;
}

TEST(ScenePlans, TheTownStreetWithItsLampsOffIsAnyRoad) {
  const Plan plan = plan_of("town", 20.0, {{"fixed_light", "off"}});
  EXPECT_EQ(plan.at("fixed light"), "off");
}

TEST(ScenePlans, TheMotorwayCallsForTheOthersGlareAndForNoLampBesideIt) {
  std::string text;
  EXPECT_EQ(plan_of("motorway", 20.0, {}, &text), expected({{"shadows", "soft"}, {"hdr image", "on"}, {"glare", "on"}}))
      << text;
}

TEST(ScenePlans, TheTunnelCallsForItsLampsAndItsRoof) {
  std::string text;
  EXPECT_EQ(plan_of("tunnel", 150.0, {}, &text),
            expected({{"shadows", "soft"},
                      {"hdr image", "on"},
                      {"glare", "on"},
                      {"fixed light", "on"},
                      {"asphalt", "r-table"}}))
      << text;
  EXPECT_NE(text.find("a roof over the road"), std::string::npos) << text;
}

TEST(ScenePlans, TheCountryRoadHasNoneOfIt) {
  const Plan plan = plan_of("country_road", 20.0);
  EXPECT_EQ(plan.at("fixed light"), "off");
  EXPECT_EQ(plan.at("glare"), "off");
  EXPECT_EQ(plan.at("hdr image"), "off");
}

}  // namespace
}  // namespace phare
