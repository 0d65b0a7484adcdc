#include "visual/process/weather_ahead.h"

#include <algorithm>
#include <tuple>

#include "visual/air_of_desk.h"

namespace phare {

bool WeatherAhead::same_kind(const WeatherAhead& other) const {
  const auto kind = [](const WeatherAhead& of) {
    return std::tuple(of.air.clear(), of.air.rain_mmph > 0.0, of.air.snow_mmph > 0.0, of.ground > 0,
                      of.snow_cover_01 > 0.0);
  };
  return kind(*this) == kind(other);
}

WeatherAhead weather_of(const Desk& desk) {
  return {"as the drive begins", air_of(desk), desk.ground.value_or(desk.rain_mmph > 0.0 ? 2 : 0), desk.snow_cover_01};
}

std::vector<WeatherAhead> weathers_ahead(const Desk& desk) {
  constexpr std::size_t kWet = 2;
  std::vector<WeatherAhead> all{{"clear"},
                                {"fog", {.visibility_m = 100.0}},
                                {"rain", {.rain_mmph = 5.0}, kWet},
                                {"wet ground", {}, kWet},
                                {"snow", {.snow_mmph = 1.0}},
                                {"snow that lies", {}, 0, 0.5},
                                {"snow on snow", {.snow_mmph = 1.0}, 0, 0.5},
                                {"rain on snow", {.rain_mmph = 5.0}, kWet, 0.3}};
  const WeatherAhead own = weather_of(desk);
  std::erase_if(all, [&](const WeatherAhead& weather) { return weather.same_kind(own); });
  return all;
}

std::vector<WeatherAhead> weathers_for_lights(const Desk& desk) {
  std::vector<WeatherAhead> all = weathers_ahead(desk);
  std::erase_if(all, [](const WeatherAhead& weather) { return weather.air.clear() || weather.snow_cover_01 > 0.0; });
  return all;
}

std::vector<CockpitState> lights_ahead(const CockpitState& shining) {
  std::vector<CockpitState> lights;
  const auto add = [&](LightSwitch light, bool fog_front) {
    const auto same = [&](const CockpitState& known) {
      return known.light_switch == light && known.fog_front == fog_front;
    };
    if (std::ranges::any_of(lights, same)) return;
    CockpitState& added = lights.emplace_back(shining);
    added.light_switch = light;
    added.fog_front = fog_front;
  };
  add(shining.light_switch, shining.fog_front);
  add(shining.light_switch, !shining.fog_front);
  for (const LightSwitch light : {LightSwitch::kLow, LightSwitch::kHigh})
    for (const bool fog_front : {false, true}) add(light, fog_front);
  add(LightSwitch::kOff, false);
  return lights;
}

bool makes_weather_ready(const Desk& desk, bool window) {
  const WeatherAhead own = weather_of(desk);
  const bool weather = !own.air.clear() || own.ground > 0 || own.snow_cover_01 > 0.0;
  return desk.weather_ahead ? *desk.weather_ahead > 0 : window || weather;
}

}  // namespace phare
