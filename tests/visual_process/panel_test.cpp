// unit: the panel, fed by a mouse: which command comes of which control, and that it changes nothing itself.
#include "visual/process/panel.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "visual/process/verbs.h"

namespace phare {
namespace {

using PointerKind = PointerEvent::Kind;
using rig_command::MountQuantity;
constexpr double kDeg = 180.0 / std::numbers::pi;

/// Two designs, each a pair of headlamps and a fog lamp.
Rig rig_of_pairs() {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "panel_even.ies";
  std::ofstream(file) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n"
                         "-20 20\n-30 30\n900 900\n900 900\n";
  const auto lamp = [&](const char* name, double left_m) {
    LampConfig config;
    config.name = name;
    config.position_m = {3.0, left_m, 0.7};
    SourceConfig source;
    source.file = file;
    config.sources = {source};
    return config;
  };
  Rig rig;
  const std::vector<LampConfig> lamps{lamp("headlamp left", 0.6), lamp("headlamp right", -0.6), lamp("fog", 0.0)};
  rig.designs = {{"halogen", lamps}, {"led", lamps}, {"matrix", lamps}};
  return rig;
}

class PanelTest : public testing::Test {
 protected:
  PanelTest() : rig_(rig_of_pairs()), lamps_(std::move(*Lamps::load(rig_))) {
    shine(0);
    frame();
    frame();  // Dear ImGui knows the sizes of a window from its first frame on
  }
  void shine(std::uint32_t design) {
    CockpitState controls;
    controls.light_switch = LightSwitch::kLow;
    controls.design_index = design;
    lamps_.set_controls(controls);
  }
  PanelFacts facts() const {
    PanelFacts facts{.lit = lamps_.lit_text(),
                     .designs = {"halogen", "led", "matrix"},
                     .design = lamps_.design_index(),
                     .lamps = panel_lamps(lamps_),
                     .aim_deg = lamps_.aim_rad() * kDeg,
                     .undo_steps = lamps_.undo_steps(),
                     .rig_file = "road.toml",
                     .desk = desk_,
                     .answer = answer_.reason};
    facts.driven = driven_;
    facts.moves_lamps = moves_lamps_;
    facts.frame.effects = plan_effects({.lit_lamps = 2});
    facts.frame.passes = {{"lit", 12.5}};
    facts.messages = {{"vehicle_state", 0, 250, 3, 1}};
    return facts;
  }
  /// One frame, what it asks for done by the verbs that bus and keys have.
  std::vector<PanelCommand> frame() {
    std::vector<PanelCommand> asked = panel_.lay_out(facts(), 1280, 720, 0.02);
    const Verbs verbs = visual_verbs(lamps_, rig_, desk_);
    for (const PanelCommand& each : asked)
      if (const auto* control = std::get_if<RigControl>(&each)) answer_ = verbs(*control);
    return asked;
  }
  void point(PointerKind kind, double x_px, double y_px, double wheel = 0.0) {
    const PointerEvent event{.kind = kind, .x_px = x_px, .y_px = y_px, .wheel = wheel};
    panel_.take(std::span(&event, 1));
  }
  std::pair<double, double> middle(const std::string& control) {
    const PanelRect* at = panel_.place(control);
    EXPECT_NE(at, nullptr) << control;
    if (at == nullptr) return {};
    return {0.5 * (at->left_px + at->right_px), 0.5 * (at->top_px + at->bottom_px)};
  }
  std::vector<PanelCommand> frames(int count) {
    std::vector<PanelCommand> all;
    for (int i = 0; i < count; ++i)
      for (PanelCommand& asked : frame()) all.push_back(std::move(asked));
    return all;
  }
  /// All three of a click come at once, as between two frames of a slow picture.
  std::vector<PanelCommand> click(const std::string& control) {
    const auto [x, y] = middle(control);
    point(PointerKind::kMove, x, y), point(PointerKind::kPress, x, y), point(PointerKind::kRelease, x, y);
    return frames(4);
  }
  /// Takes hold at a share of the control's width and lets go at another.
  std::vector<PanelCommand> drag(const std::string& control, double from_01, double to_01, int steps = 5) {
    const PanelRect at = *panel_.place(control);
    const double y = 0.5 * (at.top_px + at.bottom_px);
    const auto x = [&](double share) { return at.left_px + share * (at.right_px - at.left_px); };
    point(PointerKind::kMove, x(from_01), y), point(PointerKind::kPress, x(from_01), y);
    std::vector<PanelCommand> all = frames(2);
    for (int i = 1; i <= steps; ++i) {
      point(PointerKind::kMove, x(from_01 + (to_01 - from_01) * i / steps), y);
      for (PanelCommand& asked : frame()) all.push_back(std::move(asked));
    }
    point(PointerKind::kRelease, x(to_01), y);
    for (PanelCommand& asked : frames(2)) all.push_back(std::move(asked));
    return all;
  }

  Rig rig_;
  Lamps lamps_;
  Desk desk_;
  ControlReply answer_;
  bool driven_ = true, moves_lamps_ = true;
  Panel panel_{720};
};

PanelCommand control(decltype(RigControl::command) command) {
  return RigControl{std::move(command)};
}

TEST_F(PanelTest, LooksOnAsLongAsNobodyTouchesIt) {
  const Desk before = desk_;
  EXPECT_TRUE(frames(10).empty());
  point(PointerKind::kMove, 100.0, 200.0);
  EXPECT_TRUE(frames(10).empty());
  EXPECT_EQ(desk_, before);
  EXPECT_FALSE(panel_.content().draws.empty());
  EXPECT_LE(panel_.right_px(), 1280.0 / 3.0) << "the left third, not more";
}

// A window that is made larger or smaller has letters and panel in the same part of the picture.
TEST_F(PanelTest, FollowsTheSizeOfTheWindow) {
  const auto width_in = [&](int height_px) {
    for (int i = 0; i < 3; ++i) (void)panel_.lay_out(facts(), height_px * 16 / 9, height_px, 0.02);
    return panel_.right_px() / (height_px * 16 / 9);
  };
  const double part = width_in(720);
  EXPECT_NEAR(part, 0.33, 0.03);
  EXPECT_NEAR(width_in(1440), part, 0.01);
  EXPECT_LT(width_in(540), part + 0.01) << "letters of 11 px are read";
  EXPECT_NEAR(width_in(720), part, 0.001) << "and back";
  for (int i = 0; i < 3; ++i) (void)panel_.lay_out(facts(), 1280, 4000, 0.02);
  EXPECT_NEAR(panel_.right_px() / 1280, part, 0.01) << "of a window that stands upright";
}

TEST_F(PanelTest, EveryIndexAndVertexOfWhatIsDrawnIsThere) {
  const GuiContent& content = panel_.content();
  ASSERT_FALSE(content.draws.empty());
  for (const GuiDraw& draw : content.draws) {
    ASSERT_LE(draw.first_index + draw.indices, content.indices.size());
    for (std::uint32_t i = 0; i < draw.indices; ++i)
      ASSERT_LT(draw.first_vertex + content.indices[draw.first_index + i], content.vertices.size());
  }
}

TEST_F(PanelTest, AClickOnADesignIsAsManyPressesOfItsKey) {
  const std::vector<PanelCommand> asked = click("design 2");
  EXPECT_EQ(asked, (std::vector<PanelCommand>{KeyAction::kDesignNext, KeyAction::kDesignNext}));
  EXPECT_TRUE(click("design 0").empty()) << "it shines already";
}

TEST_F(PanelTest, WhereNobodyDrivesTheDeskShowsTheDesign) {
  driven_ = false;
  EXPECT_EQ(click("design 1"), std::vector{control(RigControl::Set{"design", "1"})});
  EXPECT_EQ(desk_.design, std::optional<std::size_t>(1));
  EXPECT_EQ(click("as the cockpit has it"), std::vector{control(RigControl::Set{"design", "cockpit"})});
  EXPECT_FALSE(desk_.design);
}

TEST_F(PanelTest, KeysOfTheCarAreKeys) {
  EXPECT_EQ(click("high beam"), std::vector<PanelCommand>{KeyAction::kHighBeam});
  EXPECT_EQ(click("light down"), std::vector<PanelCommand>{KeyAction::kLightDown});
}

TEST_F(PanelTest, ASliderMovesThePairAndIsOneStepToTakeBack) {
  const std::vector<PanelCommand> asked = drag("lamp up", 0.5, 0.9);
  ASSERT_FALSE(asked.empty());
  const LampMount left = lamps_.mounts().lamps[0], right = lamps_.mounts().lamps[1];
  // 0.3 m each way over the slider, its grab taken off on both sides: some 0.25 m up.
  EXPECT_NEAR(left.position_m.z, 0.7 + 0.25, 0.03);
  EXPECT_DOUBLE_EQ(left.position_m.z, right.position_m.z);
  EXPECT_EQ(lamps_.undo_steps(), 1u);
  const auto* last = std::get_if<RigControl>(&asked.back());
  ASSERT_NE(last, nullptr);
  const auto* mount = std::get_if<RigControl::Mount>(&last->command);
  ASSERT_NE(mount, nullptr);
  EXPECT_EQ(mount->lamp, "headlamp");
  EXPECT_EQ(mount->quantity, MountQuantity::kUp);
  EXPECT_FALSE(mount->by);

  drag("lamp pitch", 0.5, 0.4);
  EXPECT_LT(lamps_.mounts().lamps[0].pitch_rad, -0.3 / kDeg);
  EXPECT_EQ(lamps_.undo_steps(), 2u) << "another slider is another step";
  EXPECT_EQ(click("undo"), std::vector{control(RigControl::Undo{1})});
  EXPECT_EQ(lamps_.mounts().lamps[0].pitch_rad, 0.0);
  click("undo");
  EXPECT_DOUBLE_EQ(lamps_.mounts().lamps[0].position_m.z, 0.7);
  EXPECT_TRUE(click("undo").empty()) << "nothing is left to take back";
}

// What another one has moved in the meantime is not taken back with the slider's own.
TEST_F(PanelTest, ASliderTakesBackOnlyWhatItDid) {
  const PanelRect at = *panel_.place("lamp up");
  const double y = 0.5 * (at.top_px + at.bottom_px), x = 0.5 * (at.left_px + at.right_px);
  point(PointerKind::kMove, x, y), point(PointerKind::kPress, x, y);
  frames(2);
  point(PointerKind::kMove, x + 20.0, y);
  frames(1);
  ASSERT_TRUE(lamps_.mount({"fog", MountQuantity::kForward, 0.5, true}));
  point(PointerKind::kMove, x + 40.0, y);
  frames(1);
  point(PointerKind::kRelease, x + 40.0, y);
  frames(2);
  EXPECT_DOUBLE_EQ(lamps_.mounts().lamps[2].position_m.x, 3.5);
}

TEST_F(PanelTest, StepsOfASliderAreThoseOfTheKeys) {
  const std::vector<PanelCommand> asked = click("lamp yaw more");
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0], control(RigControl::Mount{"headlamp", MountQuantity::kYaw, 0.1 / kDeg, true}));
  EXPECT_EQ(click("lamp forward less"),
            std::vector{control(RigControl::Mount{"headlamp", MountQuantity::kForward, -0.01, true})});
}

TEST_F(PanelTest, ALampIsChosenFromTheListOfThoseThereAre) {
  click("lamp");
  ASSERT_NE(panel_.place("lamp fog"), nullptr);
  EXPECT_TRUE(panel_.covers(1270.0, 10.0)) << "a list is open: a click beside it closes it";
  EXPECT_TRUE(click("lamp fog").empty());
  EXPECT_EQ(panel_.place("lamp spacing"), nullptr) << "one lamp has none";
  drag("lamp left", 0.5, 0.7);
  EXPECT_GT(lamps_.mounts().lamps[2].position_m.y, 0.05);
  EXPECT_DOUBLE_EQ(lamps_.mounts().lamps[0].position_m.y, 0.6);
  EXPECT_EQ(click("as in the rig"), std::vector{control(RigControl::Reset{"fog"})});
  EXPECT_EQ(click("all as in the rig"), std::vector{control(RigControl::Reset{""})});
}

TEST_F(PanelTest, SavingAsksFirst) {
  EXPECT_TRUE(click("save").empty());
  ASSERT_NE(panel_.place("write road.toml"), nullptr);
  EXPECT_EQ(click("write road.toml"), std::vector{control(RigControl::Save{})});
  EXPECT_EQ(panel_.place("write road.toml"), nullptr) << "once";
}

// An answer moves no control: what is clicked next lies where it lay.
TEST_F(PanelTest, AnAnswerHasItsPlace) {
  const PanelRect before = *panel_.place("lamp up");
  answer_.reason = "lamp \"fog\": more than 50 m from its car, or turned beyond 91 degrees";
  frames(2);
  EXPECT_EQ(panel_.place("lamp up")->top_px, before.top_px);
}

TEST_F(PanelTest, OtherWindowsMoveNoLamps) {
  moves_lamps_ = false;
  frames(2);
  EXPECT_EQ(panel_.place("lamp up"), nullptr);
  EXPECT_NE(panel_.place("camera"), nullptr);
}

TEST_F(PanelTest, TheDeskIsSetInItsOwnWords) {
  click("camera");
  EXPECT_EQ(click("camera chase"), std::vector{control(RigControl::Set{"camera", "chase"})});
  EXPECT_EQ(desk_.camera, CameraKind::kChase);
  click("camera"), click("camera free");
  click("cameras add");
  EXPECT_EQ(desk_.own_camera, "camera1");
  ASSERT_EQ(desk_.cameras.size(), 1u);
  click("camera"), click("camera driver");
  click("camera"), click("camera camera1");
  EXPECT_EQ(desk_.own_camera, "camera1");
  click("cameras remove");
  EXPECT_TRUE(desk_.cameras.empty());
  click("view");
  click("view false-colour");
  EXPECT_EQ(desk_.view, View::kFalseColour);
  click("compare"), click("compare split");
  EXPECT_EQ(desk_.compare, Compare::kSplit);
  click("grid_m"), click("grid_m 20");
  EXPECT_EQ(desk_.grid_m, 20.0);
  EXPECT_EQ(click("road_isolux"), std::vector{control(RigControl::Set{"road_isolux", "on"})});
  EXPECT_EQ(click("road_isolux"), std::vector{control(RigControl::Set{"road_isolux", "off"})});
  drag("exposure", 0.5, 0.2);
  EXPECT_GT(desk_.exposure_per_cdm2, 0.3);
}

TEST_F(PanelTest, LightIsOfBothLampsAndTheAirOfTheDesk) {
  drag("light", 0.9, 0.5);
  EXPECT_NEAR(lamps_.dimming_01(0)[0], 0.5, 0.05);
  EXPECT_EQ(lamps_.dimming_01(0)[0], lamps_.dimming_01(1)[0]);
  EXPECT_EQ(lamps_.dimming_01(2)[0], 1.0);
  EXPECT_NEAR(panel_lamps(lamps_)[0].light_01, 0.5, 0.05);
  EXPECT_EQ(lamps_.undo_steps(), 0u);
  click("visibility_m"), click("visibility_m 100");
  EXPECT_EQ(desk_.visibility_m, 100.0);
  click("visibility_m"), click("visibility_m clear");
  EXPECT_FALSE(desk_.visibility_m);
  click("rain_mmph"), click("rain_mmph 10");
  click("snow_mmph"), click("snow_mmph 0.5");
  click("snow_cover"), click("snow_cover 0.6");
  click("windscreen"), click("wiper"), click("wiper fast");
  click("ground"), click("ground flooded");
  EXPECT_EQ(desk_.rain_mmph, 10.0);
  EXPECT_EQ(desk_.snow_mmph, 0.5);
  EXPECT_EQ(desk_.snow_cover_01, 0.6);
  EXPECT_TRUE(desk_.windscreen);
  EXPECT_EQ(desk_.wiper, Wiper::kFast);
  EXPECT_EQ(desk_.ground, 3u);
  click("ground"), click("ground auto");
  EXPECT_FALSE(desk_.ground);
}

// What every control asks for is a command that is accepted: no word is misspelt.
TEST_F(PanelTest, EffectsAreForcedAndSayWhy) {
  const auto scroll = [&](const char* over, double by) {  // the sections are longer than the window
    const auto [x, y] = middle(over);
    point(PointerKind::kWheel, x, y, by);
    frames(4);
  };
  scroll("camera", -3.0);
  click("Effects, and why");
  ASSERT_NE(panel_.place("shadows"), nullptr);
  ASSERT_NE(panel_.place("effect hdr image"), nullptr);
  for (const EffectRow& row : effect_table()) EXPECT_NE(panel_.place("effect " + std::string(row.name)), nullptr);
  click("method"), click("method vertex");
  EXPECT_EQ(desk_.method, Method::kVertex);
  scroll("method", -6.0);
  click("shadows");
  EXPECT_EQ(click("shadows hard"), std::vector{control(RigControl::Set{"shadows", "hard"})});
  EXPECT_EQ(desk_.shadows, std::optional<std::size_t>(1));
  EXPECT_EQ(answer_.verdict, Verdict::kAccepted);
}

// What a control says of the desk is a command that the desk takes, and each control says something.
TEST_F(PanelTest, EachControlNamesItsKeyOrCommand) {
  const auto [x, y] = middle("camera");
  point(PointerKind::kWheel, x, y, -3.0);
  frames(4);
  click("Effects, and why");
  frames(2);
  std::size_t of_desk = 0;
  for (const auto& [name, tip] : panel_.tips()) {
    EXPECT_FALSE(tip.empty()) << name;
    const std::string words = "phare control set ";
    const std::size_t at = tip.find(words);
    if (at == std::string::npos) continue;
    ++of_desk;
    Desk desk = desk_;
    EXPECT_TRUE(apply(desk, desk_command(tip.substr(at + words.size())), {.designs = 3})) << tip;
  }
  EXPECT_GT(of_desk, 10u);
  for (const char* name : {"high beam", "design 1", "lamp", "lamp up", "lamp up more", "light", "all pitch", "undo",
                           "as in the rig", "save", "camera", "exposure", "mirrors", "shadows"})
    EXPECT_TRUE(panel_.tips().contains(name)) << name;
}

TEST_F(PanelTest, TheRoadIsTheRoadsBesideThePanel) {
  EXPECT_TRUE(panel_.covers(100.0, 300.0));
  EXPECT_FALSE(panel_.covers(panel_.right_px() + 1.0, 300.0));
  panel_.hide();
  EXPECT_FALSE(panel_.covers(100.0, 300.0));
}

// Hidden with a slider in hand: shown again it is not held any more.
TEST_F(PanelTest, HidingLetsGo) {
  const PanelRect at = *panel_.place("lamp up");
  const double y = 0.5 * (at.top_px + at.bottom_px), x = 0.5 * (at.left_px + at.right_px);
  point(PointerKind::kMove, x, y), point(PointerKind::kPress, x, y);
  frames(2);
  panel_.hide();
  point(PointerKind::kMove, x + 60.0, y);
  EXPECT_TRUE(frames(4).empty());
}

}  // namespace
}  // namespace phare
