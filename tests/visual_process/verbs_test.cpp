// unit: what a visual process answers to a command, and what it changes.
#include "visual/process/verbs.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace phare {
namespace {

/// One design of two lamps with two sources each, and another of one lamp.
Rig rig_of_two_designs() {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "verbs_even.ies";
  std::ofstream(file) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n"
                         "-20 20\n-30 30\n900 900\n900 900\n";
  Rig rig;
  const auto lamp = [&](const char* name, std::size_t sources) {
    LampConfig config;
    config.name = name;
    config.position_m = {3.0, 0.6, 0.7};
    SourceConfig source;
    source.file = file;
    config.sources.assign(sources, source);
    return config;
  };
  rig.designs.push_back({"matrix", {lamp("left", 4), lamp("right", 1)}});
  rig.designs.push_back({"plain", {lamp("middle", 1)}});
  return rig;
}

class VisualVerbs : public testing::Test {
 protected:
  VisualVerbs() : rig_(rig_of_two_designs()), lamps_(std::move(*Lamps::load(rig_))) { shine(0); }
  void shine(std::uint32_t design) {
    CockpitState controls;
    controls.light_switch = LightSwitch::kLow;
    controls.design_index = design;
    lamps_.set_controls(controls);
  }
  ControlReply tell(decltype(RigControl::command) command) {
    return visual_verbs(lamps_, rig_, desk_)(RigControl{std::move(command)});
  }

  Rig rig_;
  Lamps lamps_;
  Desk desk_;
};

TEST_F(VisualVerbs, DoesWhatItCanAndSaysWhatHolds) {
  EXPECT_EQ(tell(RigControl::Dim{"left", 3, 0.25}).now, "left: source 3 at 25 %");
  EXPECT_EQ(tell(RigControl::Dim{"left", 2, 0.25}).now, "left: source 2 at 25 %");
  EXPECT_EQ(tell(RigControl::Swivel{"right", 0.1, 0.0}).now, "right: turned 5.730 deg left, 0.000 deg up");
  EXPECT_EQ(tell(RigControl::Place{"right", 3.5, -0.7, 0.8}).now, "right: at x 3.500, y -0.700, z 0.800 m");
  EXPECT_EQ(tell(RigControl::Aim{-0.01}).now, "all lamps turned -0.573 deg up");
  EXPECT_EQ(tell(RigControl::Tell{}).now,
            "design 0 of 2, \"matrix\", lit: low, all lamps turned -0.573 deg up\n"
            "  left: at x 3.000, y 0.600, z 0.700 m, 4 sources at full light but source 2-3 at 25 %\n"
            "  right: at x 3.500, y -0.700, z 0.800 m, turned 5.730 deg left, 0.000 deg up, 1 source at full light");
}

TEST_F(VisualVerbs, RefusesWhatTheRigDoesNotHave) {
  const std::string before = text_of(lamps_, desk_);
  for (const ControlReply& reply : {tell(RigControl::Dim{"fog", 1, 0.0}), tell(RigControl::Dim{"right", 2, 0.0}),
                                    tell(RigControl::Swivel{"middle", 0.1, 0.0}), tell(RigControl::Place{"", 1, 1, 1}),
                                    tell(RigControl::Design{2})}) {
    EXPECT_EQ(reply.verdict, Verdict::kRefused);
    EXPECT_FALSE(reply.reason.empty());
  }
  EXPECT_EQ(tell(RigControl::Dim{"fog", 1, 0.0}).reason, "lamp \"fog\": design \"matrix\" has left, right");
  EXPECT_EQ(tell(RigControl::Design{2}).reason, "design 2: the rig has 2, counted from 0: 0 \"matrix\", 1 \"plain\"");
  EXPECT_EQ(text_of(lamps_, desk_), before);
}

TEST_F(VisualVerbs, ADesignIsPendingUntilItShines) {
  EXPECT_EQ(tell(RigControl::Design{1}).verdict, Verdict::kPending);
  EXPECT_EQ(tell(RigControl::Design{1}).now, "still design 0 of 2, \"matrix\"");
  shine(1);
  EXPECT_EQ(tell(RigControl::Design{1}).verdict, Verdict::kAccepted);
  EXPECT_EQ(tell(RigControl::Design{1}).now, "design 1 of 2, \"plain\"");
}

TEST_F(VisualVerbs, LeavesPauseAndSeekToOthers) {
  EXPECT_EQ(tell(RigControl::Pause{true}).verdict, Verdict::kNotMine);
  EXPECT_EQ(tell(RigControl::Seek{1.0}).verdict, Verdict::kNotMine);
}

TEST_F(VisualVerbs, SetsTheDeskAndTellsOfIt) {
  EXPECT_EQ(tell(RigControl::Set{"camera", "chase"}).now, "camera chase");
  EXPECT_EQ(tell(RigControl::Set{"view", "next"}).now, "view false-colour");
  EXPECT_EQ(tell(RigControl::Set{"camera", ""}).now, "camera chase") << "asked, not set";
  const std::string status = tell(RigControl::Tell{}).now;
  EXPECT_NE(status.find("\n  desk: camera chase, view false-colour"), std::string::npos) << status;
  const Desk before = desk_;
  for (const RigControl::Set& set :
       {RigControl::Set{"camera", "roof"}, RigControl::Set{"design", "2"}, RigControl::Set{"kamera", "chase"}}) {
    const ControlReply reply = tell(set);
    EXPECT_EQ(reply.verdict, Verdict::kRefused);
    EXPECT_FALSE(reply.reason.empty());
  }
  EXPECT_EQ(desk_, before);
}

TEST_F(VisualVerbs, ADesignIsNotComparedWithItself) {
  EXPECT_EQ(tell(RigControl::Set{"versus", "0"}).reason, "versus 0: is the design that shines");
  EXPECT_EQ(desk_, Desk{});
  EXPECT_EQ(tell(RigControl::Set{"versus", "1"}).now, "versus 1");
  EXPECT_EQ(tell(RigControl::Set{"compare", "split"}).now, "compare split");
  EXPECT_EQ(tell(RigControl::Set{"design", "1"}).reason, "versus 1: is the design that shines");
  EXPECT_EQ(tell(RigControl::Set{"design", "0"}).now, "design 0");
  // The cockpit may change to the other one while two are compared: that can be left.
  desk_.design.reset(), shine(1);
  EXPECT_EQ(tell(RigControl::Set{"compare", ""}).now, "compare split");
  EXPECT_EQ(tell(RigControl::Set{"camera", "chase"}).now, "camera chase");
  EXPECT_EQ(tell(RigControl::Set{"compare", "off"}).now, "compare off");
  EXPECT_EQ(tell(RigControl::Set{"compare", "split"}).reason, "versus 1: is the design that shines");
}

TEST_F(VisualVerbs, ADesignHeldByTheDeskIsNotWaitedFor) {
  desk_.design = 0;
  EXPECT_EQ(tell(RigControl::Design{1}).verdict, Verdict::kAccepted);
  EXPECT_EQ(tell(RigControl::Design{1}).now, "the picture shows design 0 of 2, \"matrix\", as set on the desk");
}

TEST_F(VisualVerbs, HasAHandlerForWhatConcernsAPicture) {
  const RigControl all[] = {{RigControl::Pause{}}, {RigControl::Seek{}}, {RigControl::Design{}},
                            {RigControl::Aim{}},   {RigControl::Dim{}},  {RigControl::Swivel{}},
                            {RigControl::Place{}}, {RigControl::Tell{}}, {RigControl::Set{"camera", ""}},
                            {RigControl::Mount{}}, {RigControl::Undo{}}, {RigControl::Reset{}},
                            {RigControl::Save{}},  {RigControl::Frame{}}};
  for (const RigControl& control : all)
    EXPECT_EQ(tell(control.command).verdict != Verdict::kNotMine, concerned(control).has(Role::kVisual))
        << control.command.index();
}

}  // namespace
}  // namespace phare
