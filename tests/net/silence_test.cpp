// unit: whatever a cockpit said last, when it is silent low beam is shown, and said.
#include "net/silence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace phare {
namespace {

using namespace std::chrono_literals;

TEST(Silence, OfTheCockpitMeansLowBeamWhateverItSaidLast) {
  for (const LightSwitch last : {LightSwitch::kOff, LightSwitch::kPosition, LightSwitch::kLow, LightSwitch::kHigh}) {
    for (const bool flash : {false, true}) {
      CockpitState said;
      said.light_switch = last;
      said.flash = flash;
      said.fog_front = said.fog_rear = said.hazard = said.high_beam_automatic = true;
      said.design_index = 1;
      EXPECT_EQ(after_silence(said, 200ms), said) << "not yet silent";
      const CockpitState shown = after_silence(said, 201ms);
      EXPECT_EQ(shown.light_switch, LightSwitch::kLow);
      EXPECT_FALSE(shown.flash || shown.fog_front || shown.fog_rear || shown.high_beam_automatic);
      EXPECT_TRUE(shown.fail_safe);
      EXPECT_EQ(shown.source_fault, "no cockpit for 0.2 s: low beam");
      EXPECT_TRUE(shown.hazard);
      EXPECT_EQ(shown.design_index, 1u);
    }
  }
}

// Over the bus, and with a receiver that is busy meanwhile: what has waited for it is as old as it is.
TEST(Silence, IsCountedFromWhenTheNewestCame) {
  Rig rig;
  rig.file = "test.toml";
  rig.channels.resize(1);
  rig.port_base = static_cast<std::uint16_t>(23000 + getpid() % 900 * 30);
  auto visual = Bus::open(rig, Role::kVisual), cockpit = Bus::open(rig, Role::kCockpit);
  ASSERT_TRUE(visual && cockpit);
  // The kernel begins to stamp what comes a moment after the first socket has asked for it (net_enable_timestamp() leaves
  // it to a worker), and gives what came before the time of reading.
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(controls_to_show(*visual, std::chrono::steady_clock::now()).light_switch, LightSwitch::kLow);
  CockpitState high;
  high.light_switch = LightSwitch::kHigh;
  cockpit->send({}, high);
  visual->poll();
  EXPECT_EQ(controls_to_show(*visual, std::chrono::steady_clock::now()).light_switch, LightSwitch::kHigh);
  cockpit->send({}, high);
  std::this_thread::sleep_for(channel_of<CockpitState>().stale_after + 1ms);
  visual->poll();
  const CockpitState shown = controls_to_show(*visual, std::chrono::steady_clock::now());
  EXPECT_EQ(shown.light_switch, LightSwitch::kLow);
  EXPECT_TRUE(shown.fail_safe);
}

}  // namespace
}  // namespace phare
