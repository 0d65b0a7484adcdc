// Rain on the windscreen before a driver's eye, and the wiper that clears it. Pure: no device, no image; where drops
// are follows from their numbers and the time alone.
//
// How much water: drops of Marshall and Palmer larger than 0.5 mm that meet the glass at its car's speed and their own
// (visual/photometry/table/precipitation.h). Each covers glass kSpread times as wide as it was. An eye that looks far
// away sees a drop as its pupil, 6 mm across: half a degree, whose light is the mean of what lies within 15°
// about it, and that of lamps there; what lies behind is lost. So rain on the glass takes contrast, and a
// lamp that shines into the eye lights the drops about it.
// Drops are drawn of many sizes, lobed and drawn out by the air, and the large ones run over the glass
// (shaders/windscreen.h); they cover in the mean what the pupil's image would.
// Unconfirmed, chosen: sizes and shapes, how fast and which way drops run, spread, the glass's slant, share at which drops run together and off, angle that a drop bends
// light by, speeds of the wiper (45 and 65 strokes to and fro a minute, one in 6 s). Left out: a drop's own image, the
// film that the blade leaves, the blade itself, the way that a running drop clears, dirt, snow.
// Checked by tests/visual/windscreen_test.cpp.
#pragma once

#include "config/desk.h"
#include "visual/photometry/table/air.h"

namespace phare {

/// A screen before the eye of a view.
struct Windscreen {
  double time_s = 0.0;     ///< simulated
  double speed_mps = 0.0;  ///< of the car, ahead
  Wiper wiper = Wiper::kOff;

  friend bool operator==(const Windscreen&, const Windscreen&) = default;
};

/// Share of the glass that drops cover where they run together and off.
inline constexpr double kMostCovered_01 = 0.25;

/// Share of bare glass that drops of rain cover in a second.
double covered_per_s(const Air& air, double speed_mps);

/// From one stroke there and back to the next, s, and one way of it; 0: the wiper stands.
struct WiperPace {
  double period_s = 0.0, stroke_s = 0.0;
};
WiperPace pace_of(Wiper wiper);

}  // namespace phare
