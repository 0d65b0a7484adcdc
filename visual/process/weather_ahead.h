// Kinds of weather that a running drive may come to, each with pipelines of its own: what is drawn before a drive, so
// that no frame in it makes them. Pure. Not among them, so that the picture follows some time later
// (visual/process/loop_change.cpp): where nothing falls, fog over water or snow, and water with snow that lies.
// Checked by tests/visual_process/weather_ahead_test.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "config/desk.h"
#include "net/messages.h"
#include "visual/photometry/table/air.h"

namespace phare {

struct WeatherAhead {
  std::string_view name;
  Air air{};
  std::size_t ground = 0;  ///< of kWetNames
  double snow_cover_01 = 0.0;

  /// Pipelines of both are the same: what falls, what lies, whether there is fog and water, and not how much.
  bool same_kind(const WeatherAhead& other) const;
};

/// That which the desk has set.
WeatherAhead weather_of(const Desk& desk);

/// The kinds that the desk's own is none of.
std::vector<WeatherAhead> weathers_ahead(const Desk& desk);

/// Those of them in which a person may switch lights: what falls or hangs in the air over ground that no snow covers.
std::vector<WeatherAhead> weathers_for_lights(const Desk& desk);

/// The lights that a person may switch to, of the design that shines: first that which shines, then the same with the
/// front fog lamps the other way, then low and high beam without them and with, then none.
std::vector<CockpitState> lights_ahead(const CockpitState& shining);

/// Whether they are made ready: as the desk says; by itself in a window, where a person may set weather, and where the
/// drive begins in some.
bool makes_weather_ready(const Desk& desk, bool window);

}  // namespace phare
