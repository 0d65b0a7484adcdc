// unit: lamps moved while driving: by one and in pairs, taken back, reset, saved, told, replayed, and by keys.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "visual/process/lamp_keys.h"
#include "visual/process/lamp_replay.h"
#include "visual/process/verbs.h"

namespace phare {
namespace {

using rig_command::MountQuantity;
using enum rig_command::MountQuantity;

/// A rig file of a pair and a lamp of its own, whose light falls off to the sides and upwards.
std::filesystem::path rig_file() {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "phare_lamp_mounts";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "beam.ies")
      << "IESNA:LM-63-2002\n[TEST] slope\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n"
         "1 1 0\n-20 0 20\n-30 0 30\n900 500 100\n2500 2000 500\n700 300 50\n";
  std::ofstream(folder / "rig.toml") << R"(name = "bench"  # kept
scene = "s.glb"
vehicle = "v.toml"
cockpit = "c.toml"
[[channel]]
[[design]]
name = "one"
[[design.lamp]]
name = "headlamp"
pair = true
position_m = [3.45, 0.62, 0.66]
[[design.lamp.source]]
function = "low"
file = "beam.ies"
pitch_deg = -0.573
yaw_deg = 1.5
roll_deg = 2.0
[[design.lamp]]
name = "roof"
position_m = [1.2, 0.0, 1.5]
[[design.lamp.source]]
function = "low"
file = "beam.ies"
)";
  return folder / "rig.toml";
}

class LampMounts : public testing::Test {
 protected:
  LampMounts() : rig_(std::move(*read_rig(rig_file()))), lamps_(std::move(*Lamps::load(rig_))) { shine(lamps_); }
  static void shine(Lamps& lamps) {
    CockpitState controls;
    controls.light_switch = LightSwitch::kLow;
    lamps.set_controls(controls);
  }
  void mount(const std::string& lamp, MountQuantity quantity, double value, bool by) {
    const Status done = lamps_.mount({lamp, quantity, value, by});
    ASSERT_TRUE(done) << done.error().text();
  }
  LampMount at(std::size_t slot) const { return lamps_.mounts().lamps[slot]; }
  ControlReply tell(decltype(RigControl::command) command) {
    return visual_verbs(lamps_, rig_, desk_)(RigControl{std::move(command)});
  }

  Rig rig_;
  Lamps lamps_;
  Desk desk_;
};

TEST_F(LampMounts, ALampAndAPairAreMovedByAndTo) {
  mount("headlamp left", kForward, 3.6, false);
  mount("headlamp left", kLeft, -0.02, true);
  mount("headlamp left", kUp, 0.1, true);
  EXPECT_NEAR(at(0).position_m.x, 3.6, 1e-12);
  EXPECT_NEAR(at(0).position_m.y, 0.60, 1e-12);
  EXPECT_NEAR(at(0).position_m.z, 0.76, 1e-12);
  EXPECT_EQ(at(1), lamps_.mounts_of_rig(0).lamps[1]) << "the other stays";
  ASSERT_TRUE(lamps_.reset(""));

  // Of a pair the middle is moved; farther apart, each goes half the way.
  mount("headlamp", kLeft, 0.1, false);
  EXPECT_NEAR(at(0).position_m.y, 0.72, 1e-12);
  EXPECT_NEAR(at(1).position_m.y, -0.52, 1e-12);
  mount("headlamp", kSpacing, 0.04, true);
  EXPECT_NEAR(at(0).position_m.y, 0.74, 1e-12);
  EXPECT_NEAR(at(1).position_m.y, -0.54, 1e-12);
  mount("headlamp", kSpacing, 1.0, false);
  EXPECT_NEAR(at(0).position_m.y - at(1).position_m.y, 1.0, 1e-12);
  EXPECT_NEAR(at(0).position_m.y + at(1).position_m.y, 0.2, 1e-12);

  // Turned to a side, the right one mirrors the left one; up, both go the same way.
  mount("headlamp", kYaw, 0.02, false);
  mount("headlamp", kPitch, -0.01, false);
  mount("headlamp", kRoll, 0.03, true);
  EXPECT_EQ(at(0).yaw_rad, 0.02);
  EXPECT_EQ(at(1).yaw_rad, -0.02);
  EXPECT_EQ(at(1).pitch_rad, -0.01);
  EXPECT_EQ(at(1).roll_rad, -0.03);
  mount("", kPitch, 0.01, true);
  mount("", kPitch, 0.01, true);
  EXPECT_EQ(lamps_.aim_rad(), 0.02);
}

TEST_F(LampMounts, LightTurnsWithTheLamp) {
  // A lamp rolled by 90 degrees throws to the right side what it threw up.
  const VehicleState car;
  const auto lx = [&](double y_m, double z_m) {
    return lamps_.illuminance_lx(car, {{11.2, y_m, z_m}, {-1.0, 0.0, 0.0}});
  };
  for (const char* lamp : {"headlamp left", "headlamp right"})
    for (std::uint32_t source = 0; source < 1; ++source) ASSERT_TRUE(lamps_.dim({lamp, 0, 0.0}));
  shine(lamps_);
  const double above = lx(0.0, 1.5 + 1.0);
  mount("roof", kRoll, 0.5 * M_PI, false);
  EXPECT_NEAR(lx(-1.0, 1.5), above, 1e-9);
  // Turned left by 0.1 it lights there what it lit ahead.
  ASSERT_TRUE(lamps_.reset(""));
  const double ahead = lx(0.0, 1.5);
  mount("roof", kYaw, 0.1, false);
  const double there = lamps_.illuminance_lx(
      car, {{1.2 + 10.0 * std::cos(0.1), 10.0 * std::sin(0.1), 1.5}, {-std::cos(0.1), -std::sin(0.1), 0.0}});
  EXPECT_NEAR(there, ahead, 1e-9);
}

TEST_F(LampMounts, WhatCannotBeIsRefusedAndChangesNothing) {
  const Lamps::Mounts before = lamps_.mounts();
  for (const RigControl::Mount& wrong :
       {RigControl::Mount{"roof", kSpacing, 1.0, false}, RigControl::Mount{"bonnet", kUp, 0.1, true},
        RigControl::Mount{"", kUp, 0.1, true}, RigControl::Mount{"headlamp", kSpacing, -2.0, true},
        RigControl::Mount{"headlamp", kUp, 60.0, false}, RigControl::Mount{"roof", kYaw, 1.7, false}}) {
    const ControlReply reply = tell(wrong);
    EXPECT_EQ(reply.verdict, Verdict::kRefused) << wrong.lamp;
    EXPECT_FALSE(reply.reason.empty());
  }
  EXPECT_EQ(lamps_.mounts(), before);
  EXPECT_EQ(tell(RigControl::Undo{1}).verdict, Verdict::kRefused) << "nothing to take back";
  EXPECT_EQ(tell(RigControl::Reset{"bonnet"}).verdict, Verdict::kRefused);
}

TEST_F(LampMounts, StepsAreTakenBackOneByOneAndSeveral) {
  const Lamps::Mounts rig = lamps_.mounts();
  mount("headlamp", kUp, 0.1, true);
  const Lamps::Mounts one = lamps_.mounts();
  mount("roof", kYaw, 0.1, true);
  lamps_.set_aim(-0.01);
  // Bending light turns often: all of it is one step.
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(lamps_.swivel({"headlamp left", 0.001 * i, 0.0}));
  ASSERT_TRUE(lamps_.place({"roof", 1.0, 0.0, 1.6}));
  EXPECT_EQ(lamps_.undo(3), 3u);
  EXPECT_EQ(lamps_.aim_rad(), 0.0);
  EXPECT_EQ(at(0).yaw_rad, 0.0);
  EXPECT_EQ(lamps_.undo(1), 1u);
  EXPECT_EQ(lamps_.mounts(), one);
  EXPECT_EQ(lamps_.undo(100), 1u);
  EXPECT_EQ(lamps_.mounts(), rig);
  EXPECT_EQ(lamps_.undo(1), 0u);
  // A reset is a step too.
  mount("headlamp", kUp, 0.1, true);
  ASSERT_TRUE(lamps_.reset(""));
  EXPECT_EQ(lamps_.mounts(), rig);
  EXPECT_EQ(lamps_.undo(1), 1u);
  EXPECT_EQ(lamps_.mounts(), one);
}

TEST_F(LampMounts, TheSavedRigShinesAsTheMovedOneDid) {
  mount("headlamp", kForward, 0.05, true);
  mount("headlamp", kYaw, 0.02, true);
  mount("headlamp left", kRoll, 0.01, true);
  mount("roof", kPitch, -0.03, true);
  lamps_.set_aim(-0.005);
  const ControlReply saved = tell(RigControl::Save{(rig_file().parent_path() / "moved.toml").string()});
  ASSERT_EQ(saved.verdict, Verdict::kAccepted) << saved.reason;
  const auto rig = read_rig(rig_file().parent_path() / "moved.toml");
  ASSERT_TRUE(rig) << rig.error().text();
  EXPECT_EQ(rig->designs[0].lamps.size(), 3u);
  Lamps again = std::move(*Lamps::load(*rig));
  shine(again);
  // 1e-6 of a degree and of a metre, in a table that falls by 100 cd a degree and at 25 m: 1e-6 lx.
  for (const double y_m : {-3.0, 0.0, 2.0})
    for (const double x_m : {15.0, 40.0}) {
      const MeasurePoint point{{x_m, y_m, 0.0}, {0.0, 0.0, 1.0}};
      EXPECT_NEAR(again.illuminance_lx({}, point), lamps_.illuminance_lx({}, point), 1e-6) << x_m << " " << y_m;
    }
  // Saved to itself, that is what a reset goes back to.
  ASSERT_EQ(tell(RigControl::Save{}).verdict, Verdict::kAccepted);
  const Lamps::Mounts here = lamps_.mounts();
  mount("roof", kUp, 0.2, true);
  ASSERT_TRUE(lamps_.reset(""));
  EXPECT_EQ(lamps_.mounts(), here);
  EXPECT_EQ(tell(RigControl::Save{}).now, rig_.file.string() + ": says so already");
  EXPECT_EQ(tell(RigControl::Save{"/tmp/elsewhere.toml"}).verdict, Verdict::kRefused);
}

TEST_F(LampMounts, TheFirstPictureMovesAndTheOthersFollow) {
  Lamps other = std::move(*Lamps::load(rig_));
  shine(other);
  const Verbs second = visual_verbs(other, rig_, desk_, 1);
  EXPECT_EQ(second(RigControl{RigControl::Mount{"roof", kUp, 0.1, true}}).verdict, Verdict::kNotMine);
  LampNews news(lamps_);
  EXPECT_FALSE(news.of(SimTime{0}, lamps_)) << "as in the rig file";
  mount("roof", kUp, 0.1, true);
  const auto told = news.of(SimTime{16'000'000}, lamps_);
  ASSERT_TRUE(told);
  EXPECT_FALSE(news.of(SimTime{32'000'000}, lamps_)) << "told already";
  EXPECT_TRUE(news.of(SimTime{1'016'000'000}, lamps_)) << "again, for who has come since";
  ASSERT_TRUE(other.set_mounts(told->design_index, mounts_of(*told)));
  EXPECT_EQ(other.mounts(), lamps_.mounts());
  EXPECT_EQ(lamps_.undo(1), 1u);
  EXPECT_TRUE(news.of(SimTime{1'032'000'000}, lamps_)) << "back where the rig has it";
  EXPECT_FALSE(news.of(SimTime{9'000'000'000}, lamps_));
}

Datagram recorded(std::int64_t at_ns, const LampState& state) {
  Datagram datagram;
  datagram.sender = Sender::kVisual;
  datagram.sim_time.ns = at_ns;
  datagram.payload = state;
  return datagram;
}

TEST_F(LampMounts, AReplayMovesThemAtTheSameTimes) {
  Drive drive;
  const Lamps::Mounts rig = lamps_.mounts();
  mount("roof", kUp, 0.1, true);
  const Lamps::Mounts moved = lamps_.mounts();
  drive.datagrams = {recorded(2'000'000'000, state_of(rig, 0)), recorded(1'000'000'000, state_of(moved, 0))};
  Lamps shown = std::move(*Lamps::load(rig_));
  shine(shown);
  LampReplay replay(drive);
  EXPECT_TRUE(replay.follow(SimTime{999'999'999}, shown));
  EXPECT_EQ(shown.mounts(), rig);
  EXPECT_TRUE(replay.follow(SimTime{1'000'000'000}, shown));
  EXPECT_EQ(shown.mounts(), moved);
  EXPECT_TRUE(replay.follow(SimTime{3'000'000'000}, shown));
  EXPECT_EQ(shown.mounts(), rig);
  EXPECT_TRUE(replay.follow(SimTime{1'500'000'000}, shown)) << "wound back";
  EXPECT_EQ(shown.mounts(), moved);

  // Lamps of another rig: said once, and left.
  LampState other = state_of(moved, 0);
  for (auto* array : {&other.x_m, &other.y_m, &other.z_m, &other.yaw_rad, &other.pitch_rad, &other.roll_rad})
    array->pop_back();
  drive.datagrams = {recorded(1, other), recorded(2, other)};
  LampReplay of_another(drive);
  EXPECT_FALSE(of_another.follow(SimTime{1}, shown));
  EXPECT_TRUE(of_another.follow(SimTime{2}, shown));
  EXPECT_EQ(shown.mounts(), moved);
}

TEST_F(LampMounts, KeysChooseAndMoveAndTheLinesSayWhatAndWhere) {
  LampKeys keys;
  const auto press = [&](KeyAction action) {
    const auto command = keys.press(action, lamps_);
    if (command) {
      EXPECT_EQ(tell(command->command).verdict, Verdict::kAccepted);
    }
    return command.has_value();
  };
  for (const KeyBinding& binding : key_bindings())
    EXPECT_EQ(LampKeys::has(binding.action),
              LampKeys().press(binding.action, lamps_) || binding.action == KeyAction::kLampChoose ||
                  binding.action == KeyAction::kLampQuantity || binding.action == KeyAction::kLampMore ||
                  binding.action == KeyAction::kLampLess)
        << binding.name;
  EXPECT_TRUE(keys.lines(lamps_).empty());
  EXPECT_FALSE(press(KeyAction::kLampMore)) << "nothing is chosen";
  press(KeyAction::kLampChoose);
  ASSERT_FALSE(keys.lines(lamps_).empty());
  EXPECT_NE(keys.lines(lamps_)[0].find("moving headlamp (pair): up"), std::string::npos) << keys.lines(lamps_)[0];
  EXPECT_TRUE(press(KeyAction::kLampMore));
  EXPECT_NEAR(at(0).position_m.z, 0.67, 1e-12);
  press(KeyAction::kLampQuantity);
  EXPECT_NE(keys.lines(lamps_)[0].find("spacing"), std::string::npos);
  press(KeyAction::kLampLess);
  EXPECT_EQ(keys.lines(lamps_).back(), "  1.230 m apart");
  EXPECT_EQ(keys.lines(lamps_)[1], "  headlamp left: at x 3.450, y 0.615, z 0.670 m");
  press(KeyAction::kLampUndo);
  press(KeyAction::kLampUndo);
  EXPECT_EQ(lamps_.mounts(), lamps_.mounts_of_rig(0));
  press(KeyAction::kLampChoose);  // the left one alone has no spacing
  EXPECT_NE(keys.lines(lamps_)[0].find("moving headlamp left: yaw"), std::string::npos) << keys.lines(lamps_)[0];
  press(KeyAction::kLampMore);
  EXPECT_NEAR(at(0).yaw_rad, 0.1 * M_PI / 180.0, 1e-12);
  press(KeyAction::kLampReset);
  press(KeyAction::kLampsDown);
  EXPECT_NEAR(lamps_.aim_rad(), -0.1 * M_PI / 180.0, 1e-12);
  for (int i = 0; i < 3; ++i) press(KeyAction::kLampChoose);
  EXPECT_TRUE(keys.lines(lamps_).empty()) << "after the last, none";
}

}  // namespace
}  // namespace phare
