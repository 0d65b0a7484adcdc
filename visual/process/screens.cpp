#include "visual/process/screens.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace phare {

namespace {

constexpr double kReplayStart_s = 6.0;  // long enough to read

std::string key_name(KeyAction action) {
  return std::string(binding_of(action)->name);
}

std::string key_names(std::initializer_list<KeyAction> actions) {
  std::string names;
  for (const KeyAction action : actions) names += (names.empty() ? "" : "  ") + key_name(action);
  return names;
}

OverlayPanel::Row row(KeyAction action, std::string words) {
  return {key_name(action), std::move(words)};
}

}  // namespace

Screens::Screens(ScreensSetup setup) : setup_(std::move(setup)), start_(setup_.kind != ScreensSetup::Kind::kNone) {}

bool Screens::press(std::span<const KeyAction> presses, bool any, Desk& desk, const Set& set) {
  if (any) start_ = false;
  for (const KeyAction action : presses) {
    if (const std::string_view words = binding_of(action)->desk; !words.empty()) set(desk_command(words));
    if (action == KeyAction::kBeginAgain) begin_again_ = setup_.kind != ScreensSetup::Kind::kNone;
    if (action == KeyAction::kLeave && !std::exchange(desk.help, false) && !std::exchange(desk.panel, false))
      return true;
  }
  return false;
}

void Screens::see(const CockpitState& controls) {
  constexpr double kPressed_01 = 0.05;  // beyond what a pedal at rest may tell; chosen
  if (setup_.kind == ScreensSetup::Kind::kLive && controls.accelerator_01 > kPressed_01) start_ = false;
}

OverlayPanel Screens::panel(const CockpitState& controls, double drive_s, bool help) const {
  const bool demo_ended = controls.source == "demo ended";
  const bool replay = setup_.kind == ScreensSetup::Kind::kReplay;
  if (help) return help_panel();
  if (begin_again_) return {.title = "Beginning again ..."};
  if (over_ || demo_ended) return end_panel(demo_ended && !over_);
  if (road_ == RoadPlace::kNoGround && setup_.kind == ScreensSetup::Kind::kLive) return road_end_panel();
  if (start_ && !(replay && drive_s > kReplayStart_s)) return start_panel();
  return {};
}

OverlayPanel Screens::start_panel() const {
  if (setup_.kind == ScreensSetup::Kind::kReplay) {
    return {.title = "A recorded drive: " + setup_.shown,
            .rows = {row(KeyAction::kCamera, "another camera"), row(KeyAction::kFalseColour, "lux in false colour"),
                     row(KeyAction::kHelp, "all keys"), row(KeyAction::kPanel, "everything by the mouse"),
                     row(KeyAction::kLeave, "leave")}};
  }
  OverlayPanel panel{.title = "Phare: you drive, at night"};
  panel.rows = {{key_names({KeyAction::kAccelerate, KeyAction::kBrake}), "accelerate, brake"},
                {key_names({KeyAction::kSteerLeft, KeyAction::kSteerRight}), "steer"},
                row(KeyAction::kHighBeam, "high beam"),
                row(KeyAction::kDesignNext, "the next design of the lamps"),
                row(KeyAction::kHelp, "all keys"),
                row(KeyAction::kPanel, "everything by the mouse")};
  if (setup_.demo) panel.rows.push_back(row(KeyAction::kDemo, "watch the demo driver instead"));
  panel.rows.push_back({"", "Press Up and drive. A gamepad that is plugged in drives as well."});
  return panel;
}

OverlayPanel Screens::end_panel(bool demo_ended) const {
  OverlayPanel panel;
  if (demo_ended) {
    panel = {.title = "The demo ends here",
             .rows = {row(KeyAction::kAccelerate, "drive on yourself"),
                      row(KeyAction::kBeginAgain, "begin again from the start")}};
  } else {
    panel = {.title = "The drive is over", .rows = {row(KeyAction::kBeginAgain, "the same drive again")}};
    if (setup_.kind == ScreensSetup::Kind::kReplay) {
      panel.rows.push_back(row(KeyAction::kAccelerate, "drive yourself, from the start of the road"));
      if (setup_.demo) panel.rows.push_back(row(KeyAction::kDemo, "watch the demo driver"));
    }
  }
  panel.rows.push_back(row(KeyAction::kLeave, "leave"));
  panel.rows.push_back({"", setup_.report.empty() ? "There is no report; for one: phare drive --out FOLDER"
                                                  : "On leaving, the report is written: " + setup_.report});
  return panel;
}

OverlayPanel Screens::road_end_panel() const {
  return {.title = "The road has ended",
          .rows = {row(KeyAction::kBeginAgain, "begin again from the start"),
                   row(KeyAction::kReverse, "reverse gear, to go back"), row(KeyAction::kLeave, "leave")}};
}

OverlayPanel Screens::help_panel() const {
  OverlayPanel panel{.title = "Keys", .place = OverlayPanel::Place::kLeft};
  for (const KeyBinding& binding : key_bindings())
    if (!binding.what.empty()) panel.rows.push_back({std::string(binding.name), std::string(binding.what)});
  return panel;
}

OverlayPanel getting_ready_panel(int step, int steps) {
  return {.title = "Phare: the picture is being made ready ...",
          .rows = {{"", "step " + std::to_string(step) + " of " + std::to_string(steps)}},
          .place = OverlayPanel::Place::kAlone};
}

std::vector<OverlayInstrument> instruments(const CockpitState& controls, const VehicleState& car,
                                           const std::string& design, SimTime now) {
  // Colours of telltales as ISO 2575 has them: high beam blue, low beam and turn green, rear fog amber, danger red.
  constexpr OverlayColour kGreen{90, 225, 110}, kBlue{110, 160, 255}, kAmber{255, 190, 70}, kRed{255, 95, 75},
      kGrey{165, 165, 160};
  std::vector<OverlayInstrument> all;
  char speed[40];
  std::snprintf(speed, sizeof speed, "%.0f km/h", std::abs(car.speed_mps) * 3.6);
  all.push_back({speed, {}, true});
  constexpr const char* kGears[] = {"D", "N", "R", "P"};
  all.push_back({kGears[static_cast<std::size_t>(controls.gear)],
                 controls.gear == Gear::kDrive ? OverlayColour{} : kAmber, true});

  if (controls.flash || controls.light_switch == LightSwitch::kHigh)
    all.push_back({controls.flash ? "flash" : "high beam", kBlue});
  else if (controls.light_switch == LightSwitch::kLow)
    all.push_back({"low beam", kGreen});
  else
    all.push_back({controls.light_switch == LightSwitch::kPosition ? "position lamps" : "lights off", kAmber});
  if (controls.high_beam_automatic) all.push_back({"automatic", kGreen});
  if (controls.fog_front) all.push_back({"front fog", kGreen});
  if (controls.fog_rear) all.push_back({"rear fog", kAmber});
  constexpr std::int64_t kPeriod_ns = 60'000'000'000 / 90;  // UN R48 6.5.9: 90 flashes a minute
  const bool lit = now.ns % kPeriod_ns < kPeriod_ns / 2;
  const char* turn = controls.hazard                       ? "hazard"
                     : controls.turn == TurnSignal::kLeft  ? "turn left"
                     : controls.turn == TurnSignal::kRight ? "turn right"
                                                           : nullptr;
  if (turn != nullptr) all.push_back({turn, !lit ? kGrey : controls.hazard ? kRed : kGreen});
  if (controls.parking_brake_01 > 0.0) all.push_back({"parking brake", kRed});
  if (!design.empty()) all.push_back({design, kGrey});
  if (controls.source == "demo")
    all.push_back({"demo: " + key_name(KeyAction::kAccelerate) + " gives you the wheel", kAmber});
  return all;
}

}  // namespace phare
