// What a person at the window is told: how to begin, which keys there are, that the drive is over and what can be done
// then. Made from the table that binds the keys. Pure text: tests/visual_process/screens_test.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "config/desk.h"
#include "config/key_bindings.h"
#include "net/messages.h"
#include "visual/overlay_content.h"
#include "visual/process/road_end.h"

namespace phare {

struct ScreensSetup {
  /// Nobody is told anything but the help; the person drives; a drive is shown to the person.
  enum class Kind { kNone, kLive, kReplay };
  Kind kind = Kind::kNone;
  std::string shown{};   ///< the rig that is driven, or the drive that is shown
  bool demo = false;     ///< there is a demo driver
  std::string report{};  ///< where the report will lie; empty: there is none
};

class Screens {
 public:
  explicit Screens(ScreensSetup setup);

  /// The bound keys that were pressed, and whether any was: those of the picture ask `set` for what they are bound to.
  /// True: the person leaves.
  using Set = std::function<void(const DeskCommand&)>;
  bool press(std::span<const KeyAction> presses, bool any, Desk& desk, const Set& set);
  /// Who drives with a gamepad, a wheel or a stalk presses no key here: who accelerates has read how to begin.
  void see(const CockpitState& controls);
  /// The drive has come to its end.
  void drive_over() { over_ = true; }
  /// Where the car is.
  void set_road(RoadPlace place) { road_ = place; }
  /// Whether the window stays when the drive is over, because somebody sits there.
  bool stays() const { return setup_.kind != ScreensSetup::Kind::kNone; }

  /// The panel of now; empty: none. `drive_s`: simulated time; `help`: of the desk.
  OverlayPanel panel(const CockpitState& controls, double drive_s, bool help) const;

 private:
  OverlayPanel start_panel() const;
  OverlayPanel end_panel(bool demo_ended) const;
  OverlayPanel road_end_panel() const;
  OverlayPanel help_panel() const;

  ScreensSetup setup_;
  bool start_, over_ = false, begin_again_ = false;
  RoadPlace road_ = RoadPlace::kThere;
};

/// While the picture is being made ready, from the first step on.
OverlayPanel getting_ready_panel(int step, int steps);

/// Speed, gear, lights, design: what a driver looks for below the road. `now`: simulated, for what flashes.
std::vector<OverlayInstrument> instruments(const CockpitState& controls, const VehicleState& car,
                                           const std::string& design, SimTime now);

}  // namespace phare
