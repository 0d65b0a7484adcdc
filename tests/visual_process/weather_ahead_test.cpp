// Unit: which kinds of weather are made ready before a drive.
#include "visual/process/weather_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace phare {
namespace {

bool among(const std::vector<WeatherAhead>& all, std::string_view name) {
  return std::ranges::find(all, name, &WeatherAhead::name) != all.end();
}

// All but that which is drawn anyway; how much of it falls or lies is of no account.
TEST(WeatherAhead, IsAllButThatWhichTheDriveBeginsWith) {
  Desk desk;
  const std::size_t kinds = weathers_ahead(desk).size();
  EXPECT_FALSE(among(weathers_ahead(desk), "clear"));
  for (const char* name : {"fog", "rain", "wet ground", "snow", "snow that lies"})
    EXPECT_TRUE(among(weathers_ahead(desk), name)) << name;
  desk.rain_mmph = 0.2;
  EXPECT_EQ(weathers_ahead(desk).size(), kinds);
  EXPECT_TRUE(among(weathers_ahead(desk), "clear"));
  EXPECT_FALSE(among(weathers_ahead(desk), "rain"));
  desk.ground = 0;
  EXPECT_TRUE(among(weathers_ahead(desk), "rain")) << "its ground is wet";
  desk = {};
  desk.snow_cover_01 = 1.0;
  EXPECT_FALSE(among(weathers_ahead(desk), "snow that lies"));
  EXPECT_TRUE(among(weathers_ahead(desk), "snow on snow"));
}

TEST(WeatherAhead, NoTwoAreOfAKind) {
  const std::vector<WeatherAhead> all = weathers_ahead({});
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(all[i].same_kind(all[j])) << all[i].name << ", " << all[j].name;
}

TEST(WeatherAhead, LightsAreSwitchedInWhatFallsOrHangsInTheAir) {
  Desk desk;
  const std::vector<WeatherAhead> clear = weathers_for_lights(desk);
  for (const char* name : {"fog", "rain", "snow"}) EXPECT_TRUE(among(clear, name)) << name;
  EXPECT_EQ(clear.size(), 3u);
  desk.visibility_m = 50.0;
  EXPECT_FALSE(among(weathers_for_lights(desk), "fog")) << "the drive begins in it";
}

TEST(LightsAhead, BeginWithThatWhichShinesAndNameEachOnce) {
  CockpitState shining;
  shining.light_switch = LightSwitch::kLow;
  shining.design_index = 2;
  const std::vector<CockpitState> lights = lights_ahead(shining);
  ASSERT_EQ(lights.size(), 5u) << "low and high, each with fog lamps and without, and none";
  EXPECT_EQ(lights.front(), shining);
  EXPECT_TRUE(lights[1].fog_front) << "most likely next";
  EXPECT_EQ(lights[1].light_switch, LightSwitch::kLow);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    EXPECT_EQ(lights[i].design_index, 2u);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(lights[i], lights[j]);
  }
  shining.light_switch = LightSwitch::kPosition;
  EXPECT_EQ(lights_ahead(shining).size(), 7u) << "position lamps with fog lamps and without, besides";
}

TEST(WeatherAhead, IsMadeWhereADriveMayComeToIt) {
  Desk desk;
  EXPECT_TRUE(makes_weather_ready(desk, true)) << "a window has the panel";
  EXPECT_FALSE(makes_weather_ready(desk, false));
  desk.visibility_m = 200.0;
  EXPECT_TRUE(makes_weather_ready(desk, false)) << "it clears up";
  desk.weather_ahead = 0;
  EXPECT_FALSE(makes_weather_ready(desk, true)) << "the user's word";
  desk = {};
  desk.weather_ahead = 1;
  EXPECT_TRUE(makes_weather_ready(desk, false));
}

}  // namespace
}  // namespace phare
