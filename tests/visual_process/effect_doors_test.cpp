// unit: each effect can be switched off and back, and its finest level chosen, by rig file, command line, command and
// panel; and where nothing is there to be drawn the plan says that the user's choice waits.
#include "visual/process/effect_doors.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "config/picture_options.h"
#include "tests/paths.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/panel.h"
#include "visual/process/verbs.h"

namespace phare {
namespace {

/// Facts that call for an effect, or if nothing but the user does, for none.
EffectFacts calling_for(Effect effect) {
  switch (effect) {
    case Effect::kShadows:
      return {.lit_lamps = 2, .casters = 3};
    case Effect::kDepthFirst:
      return {.lit_lamps = 2, .by_rays = true};
    case Effect::kHdrImage:
      return {};
    case Effect::kOverlay:
      return {.overlay_lines = 4};
    case Effect::kFog:
      return {.air = {.visibility_m = 80.0}};
    case Effect::kPrecipitation:
      return {.air = {.rain_mmph = 10.0}, .air_lamps = 2};
    case Effect::kWetGround:
      return {.lit_lamps = 2, .air = {.rain_mmph = 10.0}};
    case Effect::kGlare:
      return {.glare_lamps = 2, .glare_lx = 1.0};
    case Effect::kGui:
      return {.gui = true};
    case Effect::kFixedLight:
      return {.street_lamps = 5};
    case Effect::kEyeshine:
      return {.pupils = 2};
    case Effect::kSnowCover:
      return {.snow_cover_01 = 0.5};
    case Effect::kWindscreen:
      return {.air = {.rain_mmph = 10.0}, .windscreen = true};
    case Effect::kSpray:
      return {.lit_lamps = 2, .air = {.rain_mmph = 10.0}, .spraying = 1};
    case Effect::kAsphalt:
      return {.street_lamps = 5, .r_table = true};
  }
  return {};
}

/// What was said of one setting, and the desk that came of it.
using Door = std::function<void(Desk& desk, const std::string& setting, const std::string& word)>;

void by_rig_file(Desk& desk, const std::string& setting, const std::string& word) {
  std::ifstream demo(source_dir() + "/config/rigs/country_road.toml");
  std::string text{std::istreambuf_iterator<char>(demo), {}};
  for (std::size_t at = 0; (at = text.find("\"../", at)) != std::string::npos;)
    text.replace(at, 4, "\"" + source_dir() + "/config/");
  const auto row = std::ranges::find(desk_settings(), setting, &DeskSetting::name);
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "effect_doors.toml";
  std::ofstream(file) << text << "\n[" << row->rig_table << "]\n" << setting << " = \"" << word << "\"\n";
  const Result<Rig> rig = read_rig(file);
  ASSERT_TRUE(rig) << rig.error().text();
  desk = rig->desk;
}

void by_command_line(Desk& desk, const std::string& setting, const std::string& word) {
  CLI::App app;
  PictureOptions options;
  options.add_to(app);
  app.parse(std::vector<std::string>{setting + "=" + word, "--set"});
  ASSERT_EQ(options.desk.size(), 1u);
  ASSERT_TRUE(apply(desk, options.desk.front()));
}

void by_command(Desk& desk, const std::string& setting, const std::string& word) {
  Rig rig;
  rig.designs = {{"one", {}}};
  Lamps none = std::move(*Lamps::load(rig));
  const ControlReply reply = visual_verbs(none, rig, desk)(RigControl{RigControl::Set{setting, word}});
  ASSERT_EQ(reply.verdict, Verdict::kAccepted) << reply.reason;
}

/// A panel so tall that all of it is seen, clicked on with the mouse.
void by_panel(Desk& desk, const std::string& setting, const std::string& word) {
  Panel panel(720);
  FrameResult drawn;
  drawn.effects = plan_effects({});
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i)
      for (const PanelCommand& asked : panel.lay_out({.desk = desk, .frame = drawn}, 1280, 4000, 0.02)) {
        const auto* control = std::get_if<RigControl>(&asked);
        const auto* set = control != nullptr ? std::get_if<RigControl::Set>(&control->command) : nullptr;
        ASSERT_NE(set, nullptr);
        ASSERT_TRUE(apply(desk, {set->setting, set->value})) << set->setting << " " << set->value;
      }
  };
  const auto click = [&](const std::string& control) {
    const PanelRect* at = panel.place(control);
    ASSERT_NE(at, nullptr) << control;
    const double x = 0.5 * (at->left_px + at->right_px), y = 0.5 * (at->top_px + at->bottom_px);
    for (const PointerEvent::Kind kind :
         {PointerEvent::Kind::kMove, PointerEvent::Kind::kPress, PointerEvent::Kind::kRelease}) {
      const PointerEvent event{.kind = kind, .x_px = x, .y_px = y};
      panel.take(std::span(&event, 1));
    }
    frames(4);
  };
  frames(2);
  click("Effects, and why");
  click(setting);
  click(setting + " " + word);
}

const std::pair<const char*, Door> kDoors[] = {
    {"rig file", by_rig_file}, {"command line", by_command_line}, {"command", by_command}, {"panel", by_panel}};

TEST(EffectDoors, EachEffectIsForcedOffAndOnAndBackByEach) {
  for (const auto& [name, door] : kDoors)
    for (const EffectRow& row : effect_table()) {
      const EffectDoor& its = effect_doors()[static_cast<std::size_t>(row.effect)];
      if (its.level == nullptr) continue;  // ThePanelIsTheUsersWordItself
      SCOPED_TRACE(std::string(name) + ": " + std::string(row.name));
      const std::string setting(its.setting), finest(row.levels.back());
      const EffectFacts calling = calling_for(row.effect);
      Desk desk;
      ASSERT_NO_FATAL_FAILURE(door(desk, setting, std::string(row.levels.front())));
      const EffectDecision off = plan_effects(calling, choices_of(desk))[row.effect];
      EXPECT_EQ(off.level, 0u);
      EXPECT_TRUE(off.reason.starts_with("set by the user; by itself: ")) << off.reason;

      ASSERT_NO_FATAL_FAILURE(door(desk, setting, finest));
      const EffectDecision on = plan_effects(calling, choices_of(desk))[row.effect];
      EXPECT_EQ(row.levels[on.level], finest);
      EXPECT_TRUE(on.reason.starts_with("set by the user; by itself: ")) << on.reason;
      // Where nothing is there that it could be made of it waits; else it is made.
      const EffectDecision alone = plan_effects({}, choices_of(desk))[row.effect];
      EXPECT_EQ(alone.level > 0, !row.only_where_called_for) << alone.reason;
      const std::string told =
          row.only_where_called_for ? finest + ", set by the user, waits for that" : "set by the user; by itself: ";
      EXPECT_NE(alone.reason.find(told), std::string::npos) << alone.reason;

      ASSERT_NO_FATAL_FAILURE(door(desk, setting, "auto"));
      EXPECT_EQ(desk, Desk{});
      EXPECT_EQ(plan_effects(calling, choices_of(desk))[row.effect].reason, plan_effects(calling)[row.effect].reason);
      EXPECT_EQ(plan_effects(calling, choices_of(desk)).on(row.effect), row.effect != Effect::kHdrImage);
    }
}

// What must be as it is says so: the choice waits until that is over.
TEST(EffectDoors, AChoiceAgainstWhatMustBeIsTold) {
  Desk desk;
  ASSERT_TRUE(apply(desk, {"hdr_image", "off"}));
  const EffectFacts glared{.glare_lamps = 1, .glare_lx = 1.0};
  EXPECT_EQ(plan_effects(glared, choices_of(desk))[Effect::kHdrImage].reason,
            "light scattered in the eye is added to luminance in cd/m²; off, set by the user, waits for that to end");
  EXPECT_TRUE(plan_effects({.hdr_wanted = true}, choices_of(desk)).on(Effect::kHdrImage)) << "it is read";
  ASSERT_TRUE(apply(desk, {"glare", "off"}));
  EXPECT_FALSE(plan_effects(glared, choices_of(desk)).on(Effect::kHdrImage));
  for (const char* setting : {"hdr_image", "snow_cover_drawn"}) ASSERT_TRUE(apply(desk, {setting, "on"}));
  ASSERT_TRUE(apply(desk, {"ground", "wet"}));
  const EffectPlan lux = plan_effects({.lit_lamps = 2, .false_colour = true, .snow_cover_01 = 0.5}, choices_of(desk));
  for (const Effect effect : {Effect::kHdrImage, Effect::kSnowCover, Effect::kWetGround}) {
    EXPECT_FALSE(lux.on(effect));
    EXPECT_NE(lux[effect].reason.find(", set by the user, waits for that to end"), std::string::npos)
        << lux[effect].reason;
  }
}

// Snow that is not drawn hides no wet ground and no asphalt.
TEST(EffectDoors, WhatIsSwitchedOffIsNoFactForOthers) {
  Desk desk;
  ASSERT_TRUE(apply(desk, {"snow_cover_drawn", "off"}));
  const EffectFacts rain{.lit_lamps = 2, .air = {.rain_mmph = 10.0}, .snow_cover_01 = 0.9};
  EXPECT_FALSE(plan_effects(rain).on(Effect::kWetGround));
  EXPECT_TRUE(plan_effects(rain, choices_of(desk)).on(Effect::kWetGround));
  const EffectFacts town{.snow_cover_01 = 0.9, .street_lamps = 5, .r_table = true};
  EXPECT_FALSE(plan_effects(town).on(Effect::kAsphalt));
  EXPECT_TRUE(plan_effects(town, choices_of(desk)).on(Effect::kAsphalt));
}

TEST(EffectDoors, ThePanelIsTheUsersWordItself) {
  const EffectDoor& its = effect_doors()[static_cast<std::size_t>(Effect::kGui)];
  Desk desk;
  ASSERT_TRUE(apply(desk, {std::string(its.setting), "on"}));
  EXPECT_TRUE(desk.panel);
  EXPECT_TRUE(plan_effects({.gui = desk.panel}, choices_of(desk)).on(Effect::kGui));
  ASSERT_TRUE(apply(desk, {std::string(its.setting), "off"}));
  EXPECT_EQ(desk, Desk{});
  EXPECT_FALSE(plan_effects({.gui = desk.panel}, choices_of(desk)).on(Effect::kGui));
}

// A setting reaches the picture, and one that was on is none less for being said so.
TEST(EffectDoors, ReachTheFrame) {
  for (const EffectDoor& door : effect_doors()) {
    if (door.level == nullptr) continue;
    Desk desk;
    desk.*door.level = 0;
    FrameInput input;
    set_by_desk(input, desk);
    EXPECT_EQ(input.effects[static_cast<std::size_t>(door.effect)], std::optional<std::size_t>(0)) << door.setting;
    set_by_desk(input, Desk{});
    EXPECT_FALSE(input.effects[static_cast<std::size_t>(door.effect)]) << door.setting;
  }
}

}  // namespace
}  // namespace phare
