// unit: what a picture does with the answers of a control law.
#include "visual/process/law.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>

namespace phare {
namespace {

using namespace std::chrono_literals;

/// Two lamps, each one low and two high sources that shine 1000 cd everywhere within ±20°.
Rig rig_of_two_lamps() {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "law_even.ies";
  std::ofstream(file) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n"
                         "-20 20\n-30 30\n1000 1000\n1000 1000\n";
  Rig rig;
  rig.channels.resize(1);
  DesignConfig design;
  design.name = "matrix";
  for (const char* name : {"left", "right"}) {
    LampConfig lamp;
    lamp.name = name;
    lamp.position_m = {3.0, name[0] == 'l' ? 0.6 : -0.6, 0.7};
    for (const LampFunction function : {LampFunction::kLow, LampFunction::kHigh, LampFunction::kHigh}) {
      SourceConfig source;
      source.function = function;
      source.file = file;
      lamp.sources.push_back(source);
    }
    design.lamps.push_back(lamp);
  }
  rig.designs.push_back(design);
  return rig;
}

/// A picture and a law on ports that nobody holds.
struct Pair {
  Rig rig = rig_of_two_lamps();
  std::optional<Bus> picture, law;

  Pair() {
    for (int base = 20000 + (getpid() % 1000) * 30, tries = 0; !law && tries < 200; ++tries, base += 30) {
      rig.port_base = static_cast<std::uint16_t>(base > 60000 ? base - 40000 : base);
      auto one = Bus::open(rig, Role::kVisual), other = Bus::open(rig, Role::kLaw);
      if (one && other) picture.emplace(std::move(*one)), law.emplace(std::move(*other));
    }
  }
};

CockpitState stalk_at(LightSwitch light) {
  CockpitState controls;
  controls.light_switch = light;
  return controls;
}

/// 10 m before the left lamp, facing it: its three sources give 10 lx each.
constexpr MeasurePoint kBeforeLeft{{13.0, 0.6, 0.7}, {-1.0, 0.0, 0.0}};

class LampsUnderALaw : public testing::Test {
 protected:
  LampsUnderALaw() : lamps_(std::move(*Lamps::load(rig_of_two_lamps()))) {
    lamps_.set_controls(stalk_at(LightSwitch::kHigh));
    alone_lx_ = lamps_.illuminance_lx(VehicleState{}, kBeforeLeft);
  }
  double lx(const LawAnswer& answer) {
    followed_ = lamps_.follow(answer, 0);
    return lamps_.illuminance_lx(VehicleState{}, kBeforeLeft);
  }

  Lamps lamps_;
  double alone_lx_ = 0.0;
  Status followed_ = Done{};
};

TEST_F(LampsUnderALaw, AreDimmedSourceBySourceUntilTheLawSaysOtherwise) {
  LawAnswer answer;
  answer.lamps = {{"left", 0.0, 0.0, {1.0, 0.0, 0.5}}};
  // 1.5 of three sources of the left lamp are left, 10 lx each in float64.
  EXPECT_NEAR(alone_lx_ - lx(answer), 15.0, 1e-9);
  EXPECT_TRUE(followed_);
  answer.lamps[0].dimming_01 = {0.0};  // one value: of all
  EXPECT_NEAR(alone_lx_ - lx(answer), 30.0, 1e-9);
  EXPECT_NEAR(lx(LawAnswer{}), alone_lx_, 1e-12);
}

TEST_F(LampsUnderALaw, AreDimmedOnTopOfWhatACommandSays) {
  ASSERT_TRUE(lamps_.dim({"left", 1, 0.5}));
  LawAnswer answer;
  answer.lamps = {{"left", 0.0, 0.0, {0.5, 1.0, 1.0}}};
  EXPECT_NEAR(alone_lx_ - lx(answer), 7.5, 1e-9);
}

TEST_F(LampsUnderALaw, AreTurned) {
  LawAnswer answer;
  answer.lamps = {{"left", 0.4, 0.0, {}}};
  answer.levelling_rad = -0.1;
  static_cast<void>(lx(answer));
  const auto forward = [&](std::size_t lamp) { return lamps_.placed(VehicleState{})[lamp].world_from_image[0]; };
  EXPECT_NEAR(std::atan2(forward(0).y, forward(0).x), 0.4, 1e-6);
  EXPECT_NEAR(std::asin(forward(0).z), -0.1, 1e-6);
  EXPECT_NEAR(forward(1).y, 0.0, 1e-6);
  EXPECT_NEAR(std::asin(forward(1).z), -0.1, 1e-6);
}

TEST_F(LampsUnderALaw, StayAsTheyAreWhenTheAnswerDoesNotFit) {
  LawAnswer answer;
  answer.levelling_rad = 0.3;
  answer.lamps = {{"right", 0.0, 0.0, {0.0}}, {"middle", 0.0, 0.0, {0.0}}};
  EXPECT_NEAR(lx(answer), alone_lx_, 1e-12);
  EXPECT_EQ(followed_.error().text(), "lamp \"middle\": design \"matrix\" has left, right");
  answer.lamps = {{"left", 0.0, 0.0, {0.0, 0.0}}};
  EXPECT_NEAR(lx(answer), alone_lx_, 1e-12);
  EXPECT_EQ(followed_.error().text(), "lamp \"left\": has 3 sources, not 2");
}

TEST(BeamOfTheLaw, ReplacesTheStalksOnlyWhileThatIsAtLowOrHigh) {
  LawAnswer answer;
  EXPECT_EQ(with_beam_of(answer, stalk_at(LightSwitch::kHigh)).light_switch, LightSwitch::kHigh);
  answer.light_switch = LightSwitch::kHigh;
  EXPECT_EQ(with_beam_of(answer, stalk_at(LightSwitch::kLow)).light_switch, LightSwitch::kHigh);
  EXPECT_EQ(with_beam_of(answer, stalk_at(LightSwitch::kPosition)).light_switch, LightSwitch::kPosition);
  EXPECT_EQ(with_beam_of(answer, stalk_at(LightSwitch::kOff)).light_switch, LightSwitch::kOff);
  answer.light_switch = LightSwitch::kLow;
  EXPECT_EQ(with_beam_of(answer, stalk_at(LightSwitch::kHigh)).light_switch, LightSwitch::kLow);
}

TEST(LawLink, ASilentLawMeansLowBeamAndIsSaid) {
  Pair pair;
  ASSERT_TRUE(pair.law);
  auto &picture = pair.picture, &law = pair.law;
  Lamps lamps = std::move(*Lamps::load(pair.rig));
  LawLink link;
  const auto lead = [&] { return link.lead(*picture, lamps, stalk_at(LightSwitch::kHigh), 16ms, false); };
  EXPECT_EQ(lead().light_switch, LightSwitch::kLow);
  EXPECT_EQ(lead().source_fault, "the control law is silent: low beam");
  EXPECT_EQ(link.json()["silent_frames"], 2);
  LawAnswer answer;
  answer.input = wall_now();
  law->send(SimTime{}, answer);
  picture->poll();
  EXPECT_EQ(lead().light_switch, LightSwitch::kHigh);
  EXPECT_FALSE(lead().fail_safe);
  EXPECT_EQ(link.json()["answers"], 1);  // however often it is followed
  EXPECT_EQ(link.json()["delay_ms"]["count"], 1);
}

TEST(LawLink, ALockstepFrameWaitsForTheAnswerToItselfAlone) {
  Pair pair;
  ASSERT_TRUE(pair.law);
  auto &picture = pair.picture, &law = pair.law;
  EXPECT_FALSE(LawLink::has_answered(*picture, 7));
  LawAnswer answer;
  answer.frame_index = 6;
  law->send(SimTime{}, answer);
  picture->poll();
  EXPECT_FALSE(LawLink::has_answered(*picture, 7));
  answer.frame_index = 7;
  law->send(SimTime{}, answer);
  picture->poll();
  EXPECT_TRUE(LawLink::has_answered(*picture, 7));
}

}  // namespace
}  // namespace phare
