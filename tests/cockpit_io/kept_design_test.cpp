// unit: a rig that keeps its design: recorded changes are left out, those of a hand are not.
#include "cockpit_io/kept_design.h"

#include <gtest/gtest.h>

#include <memory>

#include "cockpit_io/combined_source.h"

namespace phare {
namespace {

Moment at_ms(std::int64_t ms) {
  return {SimTime{ms * 1'000'000}, WallTime{ms * 1'000'000}};
}

CockpitState recorded(std::uint32_t design) {
  CockpitState state;
  state.light_switch = LightSwitch::kLow;
  state.design_index = design;
  return state;
}

TEST(KeptDesign, ARecordedChangeIsLeftOutAndTheRestIsTaken) {
  Cockpit cockpit({0, 3}, "drive");
  KeptDesign kept(cockpit);
  kept.take_recorded(recorded(0), at_ms(0));
  EXPECT_EQ(kept.left_out(), 0u);
  for (int ms = 10; ms < 50; ms += 10) kept.take_recorded(recorded(1), at_ms(ms));
  EXPECT_EQ(cockpit.state(-1, false).design_index, 0u);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  EXPECT_EQ(kept.left_out(), 1u) << "one change, however often it is repeated";
  kept.take_recorded(recorded(0), at_ms(50));
  EXPECT_EQ(kept.left_out(), 2u);
  EXPECT_EQ(cockpit.light_changes(), 1u) << "low beam";
}

TEST(KeptDesign, ByHandItChangesAndStays) {
  Cockpit cockpit({0, 3}, "drive");
  KeptDesign kept(cockpit);
  kept.take_recorded(recorded(0), at_ms(0));
  cockpit.choose_design(2, at_ms(5));
  for (int ms = 10; ms < 50; ms += 10) kept.take_recorded(recorded(1), at_ms(ms));
  EXPECT_EQ(cockpit.state(-1, false).design_index, 2u);
}

TEST(Cockpit, AChosenDesignStaysUntilTheRecordedOneChanges) {
  Cockpit cockpit({0, 3}, "drive");
  cockpit.take_recorded(recorded(0), at_ms(0));
  cockpit.choose_design(2, at_ms(5));
  for (int ms = 10; ms < 50; ms += 10) cockpit.take_recorded(recorded(0), at_ms(ms));
  EXPECT_EQ(cockpit.design_index(), 2u) << "every frame is recorded with its design";
  cockpit.take_recorded(recorded(1), at_ms(50));
  EXPECT_EQ(cockpit.design_index(), 1u);
  EXPECT_EQ(cockpit.unknown_design(), std::nullopt);
}

TEST(KeptDesign, AScriptsPressIsLeftOutToo) {
  Cockpit cockpit({0, 3}, "driver");
  KeptDesign kept(cockpit);
  DriverInput input;
  kept.take(input, false, at_ms(0));
  input.switches.design_next = true;
  kept.take(input, false, at_ms(10));
  kept.take(input, false, at_ms(20));
  EXPECT_EQ(cockpit.state(-1, false).design_index, 0u);
  EXPECT_EQ(kept.left_out(), 1u);
  cockpit.take(input, false, at_ms(30));
  EXPECT_EQ(cockpit.state(-1, false).design_index, 1u) << "without it, it counts";
}

/// Presses "next design" all the time.
class Presses : public Source {
 public:
  void advance(Moment now, const VehicleState*, ControlSink& sink) override {
    DriverInput input;
    input.switches.design_next = pressed;
    sink.take(input, false, now);
  }
  bool pressed = true;
};

TEST(KeptDesign, OfALogBesideTheKeyboardOnlyTheKeyboardActs) {
  CockpitConfig log, keys;
  log.source = SourceKind::kLog;
  log.controls.resize(1);
  log.controls[0].control = Control::kDesignNext;
  keys.source = SourceKind::kKeyboard;
  for (const bool keep : {true, false}) {
    log.keep_design = keep;
    auto of_log = std::make_unique<Presses>(), of_keys = std::make_unique<Presses>();
    Presses& keyboard = *of_keys;
    keyboard.pressed = false;
    std::vector<CombinedSource::Part> parts;
    parts.push_back({std::move(of_log), log});
    parts.push_back({std::move(of_keys), keys});
    CombinedSource source(std::move(parts));
    Cockpit cockpit({0, 3}, "log");
    source.advance(at_ms(10), nullptr, cockpit);
    EXPECT_EQ(cockpit.state(-1, false).design_index, keep ? 0u : 1u);
    if (!keep) continue;
    keyboard.pressed = true;
    source.advance(at_ms(20), nullptr, cockpit);
    EXPECT_EQ(cockpit.state(-1, false).design_index, 1u);
  }
}

}  // namespace
}  // namespace phare
