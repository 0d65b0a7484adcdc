// unit: what --explain says of a lit and of an unlit moment, and the lines that the desk lets be shown.
#include "visual/process/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "visual/fixed_light.h"
#include "visual/process/overlay_lines.h"

namespace phare {
namespace {

Rig rig_of_two_lamps() {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "explain_even.ies";
  std::ofstream(file) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n"
                         "-20 20\n-30 30\n900 900\n900 900\n";
  Rig rig;
  SourceConfig low;
  low.file = file;
  LampConfig left{.name = "left", .position_m = {3.0, 0.6, 0.7}, .sources = {low}}, right = left;
  right.name = "right";
  right.position_m.y = -0.6;
  rig.designs = {{"pair", {left, right}}, {"one", {left}}};
  rig.channels.push_back({});
  return rig;
}

class Explain : public testing::Test {
 protected:
  std::vector<std::string> lines(const AskedMoment& moment, const std::string& device, bool window = false) {
    std::istringstream text(explain_moment(lamps_, desk_, rig_.channels[0], moment, device, scene_, movers_, traffic_,
                                           road_, fixed_, window));
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);) all.push_back(line);
    return all;
  }
  static AskedMoment moment(LightSwitch light) {
    AskedMoment asked;
    asked.controls.light_switch = light;
    return asked;
  }

  Rig rig_ = rig_of_two_lamps();
  Lamps lamps_ = std::move(*Lamps::load(rig_));
  Desk desk_;
  Scene scene_;
  Movers movers_ = std::move(*Movers::read());
  Traffic traffic_;
  std::vector<LanePoint> lane_{{0, 0, 0, 0, 0, 0}, {1000, 1000, 0, 0, 0, 0}};
  RoadLine road_{lane_, {}};
  FixedLight fixed_;
  const std::string device_ = "a card";
};

// Asked about no drive, the car stands on its lane, not wherever the scene has its origin: on the motorway that is a
// guard rail.
TEST_F(Explain, WithoutADriveTheCarStandsWhereOneBegins) {
  const auto folder = std::filesystem::path(testing::TempDir());
  std::ofstream(folder / "explained_lane.csv") << "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n"
                                                  "0,3,-8.375,0.5,0.25,0\n10,12.7,-5.9,0.5,0.25,0\n";
  const AskedMoment there = moment_at_rest(folder / "explained.glb", LightSwitch::kHigh, true);
  EXPECT_EQ(there.pose.x_m, 3.0);
  EXPECT_EQ(there.pose.y_m, -8.375);
  EXPECT_EQ(there.pose.z_m, 0.5);
  EXPECT_EQ(there.pose.yaw_rad, 0.25);
  EXPECT_EQ(there.controls.light_switch, LightSwitch::kHigh);
  EXPECT_TRUE(there.controls.fog_front);
  EXPECT_EQ(moment_at_rest(folder / "without_lane.glb", LightSwitch::kLow, false).pose.x_m, 0.0);
}

/// The whole plan of a drive in fog: fog, and nothing that clear air has not.
TEST_F(Explain, FogCallsForFogAlone) {
  const auto clear = lines(moment(LightSwitch::kLow), device_);
  for (const double visibility_m : {80.0, 300.0}) {
    desk_.visibility_m = visibility_m;
    const auto foggy = lines(moment(LightSwitch::kLow), device_);
    ASSERT_EQ(foggy.size(), clear.size());
    for (std::size_t i = 0; i < clear.size(); ++i) {
      if (clear[i].starts_with("fog "))
        EXPECT_EQ(foggy[i], visibility_m == 80.0
                                ? "fog             medium  visibility 80 m between the eye and what it sees"
                                : "fog             medium  visibility 300 m between the eye and what it sees");
      else
        EXPECT_EQ(foggy[i], clear[i]);
    }
  }
}

/// The whole plan of a drive in rain and in snow: its air, its drops, and the luminance image that they are added to.
TEST_F(Explain, RainCallsForItsAirItsDropsAndTheirImage) {
  const auto dry = lines(moment(LightSwitch::kLow), device_);
  for (const bool snow : {false, true}) {
    desk_.rain_mmph = snow ? 0.0 : 10.0, desk_.snow_mmph = snow ? 2.0 : 0.0;
    const auto wet = lines(moment(LightSwitch::kLow), device_);
    ASSERT_EQ(wet.size(), dry.size());
    for (std::size_t i = 0; i < dry.size(); ++i) {
      if (wet[i].starts_with("fog "))
        EXPECT_EQ(wet[i], std::string("fog             medium  ") + (snow ? "snow 2 mm/h" : "rain 10 mm/h") +
                              " between the eye and what it sees");
      else if (wet[i].starts_with("precipitation"))
        EXPECT_EQ(wet[i], std::string("precipitation   on      2 lamps light ") + (snow ? "flakes" : "drops") +
                              " near the eye");
      else if (wet[i].starts_with("ground ") && !snow)
        EXPECT_EQ(wet[i], "ground          wet     rain of 10 mm/h fills the texture of the road");
      else if (wet[i].starts_with("spray ") && !snow)
        EXPECT_EQ(wet[i], "spray           off     no vehicle in view is fast enough to throw up water");
      else if (wet[i].starts_with("hdr image"))
        EXPECT_EQ(wet[i], "hdr image       on      drops and flakes are added to luminance in cd/m²");
      else
        EXPECT_EQ(wet[i], dry[i]);
    }
  }
}

/// The whole plan of a drive that meets a car: its lamps glare, for which the luminance image is made, and its body
/// casts a shadow.
TEST_F(Explain, AnOncomingCarCallsForGlareAndItsImage) {
  const auto alone = lines(moment(LightSwitch::kLow), device_);
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "explain_traffic.toml";
  std::ofstream(file) << "[[road_user]]\nstart_s_m = 60\noffset_m = 3.5\n";
  traffic_ = std::move(*Traffic::read(file, lane_, movers_));
  const auto met = lines(moment(LightSwitch::kLow), device_);
  ASSERT_EQ(met.size(), alone.size());
  for (std::size_t i = 0; i < met.size(); ++i) {
    if (met[i].starts_with("glare "))
      EXPECT_TRUE(met[i].starts_with("glare           on      2 lamps shine into the eye, 0.")) << met[i];
    else if (met[i].starts_with("hdr image"))
      EXPECT_EQ(met[i], "hdr image       on      light scattered in the eye is added to luminance in cd/m²");
    else if (met[i].starts_with("shadows"))
      EXPECT_EQ(met[i], "shadows         soft    1 pieces of the scene stand in the light of the lamps");
    else
      EXPECT_EQ(met[i], alone[i]);
  }
}

/// What casts its shadow out of the view casts none, as in the frame.
TEST_F(Explain, AShadowThatNobodySeesIsNotCalledFor) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "explain_hidden.toml";
  std::ofstream(file) << "[[road_user]]\nclass = \"deer\"\nstart_s_m = 50\noffset_m = -2.0\n";
  traffic_ = std::move(*Traffic::read(file, lane_, movers_));
  const auto shadows = [&] {
    for (const std::string& line : lines(moment(LightSwitch::kLow), device_))
      if (line.starts_with("shadows ")) return line;
    return std::string();
  };
  EXPECT_TRUE(shadows().starts_with("shadows         soft ")) << shadows();
  desk_.camera = CameraKind::kFree;
  desk_.free_eye = {
      .position_m = {30.0, 0.0, 1.2}, .yaw_deg = 180.0, .pitch_deg = 0.0};  // before the deer, looking back
  EXPECT_EQ(shadows(), "shadows         off     nothing stands in the light of the lamps");
}

/// What rain changes of luminance is not called for where two designs are compared by illuminance.
TEST_F(Explain, TheDifferenceOfTwoDesignsIsOfIlluminance) {
  desk_.rain_mmph = 10.0;
  const auto level = [&](const std::string& effect) {
    for (const std::string& line : lines(moment(LightSwitch::kLow), device_))
      if (line.starts_with(effect + " ")) return line.substr(16, line.find(' ', 16) - 16);
    return std::string();
  };
  for (const auto& [effect, photo, lux] : {std::tuple("fog", "medium", "off"),
                                           {"precipitation", "on", "off"},
                                           {"ground", "wet", "dry"},
                                           {"hdr image", "on", "off"}}) {
    desk_.compare = Compare::kSplit;
    EXPECT_EQ(level(effect), photo) << effect;
    for (const Compare compare : {Compare::kDifference, Compare::kRatio}) {
      desk_.compare = compare;
      EXPECT_EQ(level(effect), lux) << effect;
    }
  }
}

/// A car ahead at 90 km/h on wet ground: its spray besides all that it calls for on dry ground.
TEST_F(Explain, AFastCarOnWetGroundThrowsUpSpray) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "explain_spray.toml";
  std::ofstream(file) << "[[road_user]]\ndirection = \"same\"\nstart_s_m = 40\nspeed_kmh = 90\n";
  traffic_ = std::move(*Traffic::read(file, lane_, movers_));
  const auto spray = [&] {
    const auto all = lines(moment(LightSwitch::kLow), device_);
    const auto line = std::ranges::find_if(all, [](const std::string& each) { return each.starts_with("spray "); });
    return line == all.end() ? std::string() : *line;
  };
  EXPECT_EQ(spray(), "spray           off     the ground is dry");
  desk_.ground = 2;
  EXPECT_EQ(spray(), "spray           on      1 vehicle throws up water of 0.4 mm");
  desk_.spray = 0;
  EXPECT_TRUE(spray().starts_with("spray           off     set by the user")) << spray();
}

/// A deer at the verge that looks at the car: its eyes, drawn without the luminance image, and its body's shadow.
TEST_F(Explain, ADeerCallsForItsEyes) {
  const auto alone = lines(moment(LightSwitch::kLow), device_);
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "explain_deer.toml";
  std::ofstream(file) << "[[road_user]]\nclass = \"deer\"\nstart_s_m = 50\noffset_m = -2.0\n";
  traffic_ = std::move(*Traffic::read(file, lane_, movers_));
  const auto met = lines(moment(LightSwitch::kLow), device_);
  ASSERT_EQ(met.size(), alone.size());
  for (std::size_t i = 0; i < met.size(); ++i) {
    if (met[i].starts_with("eyeshine"))
      EXPECT_EQ(met[i], "eyeshine        on      2 eyes of animals send light back");
    else if (met[i].starts_with("shadows"))
      EXPECT_TRUE(met[i].starts_with("shadows         soft ")) << met[i];
    else
      EXPECT_EQ(met[i], alone[i]);
  }
}

TEST_F(Explain, ALineForEachEffectWithLevelAndReason) {
  const auto lit = lines(moment(LightSwitch::kLow), device_);
  ASSERT_EQ(lit.size(), 1 + kEffectCount + 1);
  EXPECT_EQ(lit.back(), "# --explain --cost draws this moment and adds passes, bytes and ms");
  EXPECT_EQ(lit[0], "# lit: low, design \"pair\", 0.0 s, 0 km/h, on a card");
  EXPECT_EQ(lit[1], "shadows         off     nothing stands in the light of the lamps");
  EXPECT_EQ(lit[2],
            "depth first     off     near pieces are drawn first: a second pass over the vertices costs more than it "
            "saves");
  EXPECT_EQ(lit[3],
            "hdr image       off     nothing reads luminance in cd/m²: the lamp pass applies the tone curve itself");
  EXPECT_EQ(lit[4], "overlay         off     no line of text to show");
  EXPECT_EQ(lit[5], "fog             off     the air is clear");
  EXPECT_EQ(lit[6], "precipitation   off     neither rain nor snow falls");
  EXPECT_EQ(lit[7], "ground          dry     it does not rain");
  EXPECT_EQ(lit[8], "glare           off     no lamp shines into the eye");

  const auto dark = lines(moment(LightSwitch::kOff), device_);
  EXPECT_EQ(dark[0], "# lit: off, design \"pair\", 0.0 s, 0 km/h, on a card");
  EXPECT_EQ(dark[2], "depth first     off     no lamp is lit: a pixel drawn twice costs nothing");
}

TEST_F(Explain, DeskAndWindowCount) {
  desk_.design = 1;
  const std::string of_other = lines(moment(LightSwitch::kLow), device_)[0];
  EXPECT_EQ(of_other.find("design \"pair\""), std::string::npos) << of_other;
  desk_.shadows = kRayShadows;
  EXPECT_TRUE(lines(moment(LightSwitch::kLow), device_)[2].starts_with("depth first     on      shadows by rays"));
  desk_.depth_first = 0;
  EXPECT_EQ(lines(moment(LightSwitch::kLow), device_)[2].substr(0, 41), "depth first     off     set by the user; ");
  desk_.visibility_m = 80.0;
  EXPECT_EQ(lines(moment(LightSwitch::kLow), device_)[5],
            "fog             medium  visibility 80 m between the eye and what it sees");
  desk_.camera = CameraKind::kBirdsEye;
  EXPECT_NE(lines(moment(LightSwitch::kLow), device_)[5].find("off     the view is from above"), std::string::npos);
  desk_.camera = CameraKind::kDriver;
  desk_.view = View::kFalseColour;
  EXPECT_NE(lines(moment(LightSwitch::kLow), device_)[3].find("false colour"), std::string::npos);
  EXPECT_NE(lines(moment(LightSwitch::kLow), device_, true)[4].find("on "), std::string::npos);
}

TEST_F(Explain, AMomentOfADriveIsTheNewestUntilThen) {
  Drive drive;
  const auto add = [&](double at_s, Payload payload) {
    Datagram datagram;
    datagram.sim_time.ns = static_cast<std::int64_t>(at_s * 1e9);
    datagram.payload = std::move(payload);
    drive.datagrams.push_back(datagram);
  };
  CockpitState low, high;
  low.light_switch = LightSwitch::kLow;
  high.light_switch = LightSwitch::kHigh;
  VehicleState car;
  car.speed_mps = 10.0;
  add(1.0, low);
  add(2.0, car);
  add(3.0, high);
  EXPECT_EQ(moment_of_drive(drive, 0.5).error().text(), "--drive: has no CockpitState until 0.5 s");
  EXPECT_EQ(moment_of_drive(drive, 1.5).error().text(), "--drive: has no VehicleState until 1.5 s");
  EXPECT_EQ(moment_of_drive(drive, 2.5)->controls.light_switch, LightSwitch::kLow);
  EXPECT_EQ(moment_of_drive(drive, 3.0)->controls.light_switch, LightSwitch::kHigh);
  EXPECT_EQ(moment_of_drive(drive, 3.0)->pose.speed_mps, 10.0);
}

TEST_F(Explain, TheLinesShowWhatTheDeskSays) {
  CockpitState controls;
  controls.light_switch = LightSwitch::kLow;
  lamps_.set_controls(controls);
  VehicleState pose;
  pose.x_m = 100.0;
  const EyeAdaptation eye;
  FrameResult frame;
  frame.effects = plan_effects({.lit_lamps = 2, .casters = 3});
  frame.effect_costs[static_cast<std::size_t>(Effect::kShadows)] = {2, 12'580'000};
  frame.passes = {{"shadow maps", 1.5, Effect::kShadows}, {"copy of maps", 0.25, Effect::kShadows}, {"lamps", 9.0, {}}};
  OverlayMoment moment{.controls = controls, .pose = pose, .eye = eye, .frame = &frame};
  EXPECT_EQ(overlay_lines(desk_, lamps_, moment).size(), 2u + lamps_.lit_table_ends().size());
  desk_.lines = false;
  moment.pose_held = true;
  const auto only = overlay_lines(desk_, lamps_, moment);
  ASSERT_EQ(only.size(), 1u + lamps_.lit_table_ends().size());
  EXPECT_EQ(only.back(), "POSE HELD: no VehicleState") << "what is wrong is told in any case";
  moment.pose_held = false, moment.paused = true;
  EXPECT_EQ(overlay_lines(desk_, lamps_, moment).back(), "PAUSED: phare control resume goes on");
  moment.pose_held = true, moment.paused = false;
  desk_.effects = true;
  const auto with_effects = overlay_lines(desk_, lamps_, moment);
  EXPECT_EQ(with_effects.size(), only.size() + kEffectCount);
  EXPECT_EQ(with_effects.front(),
            "shadows soft, 2 passes, 12.6 MB, 1.75 ms: 3 pieces of the scene stand in the light of the lamps");
  EXPECT_EQ(with_effects[3], "overlay off: no line of text to show") << "what is off takes nothing";
  for (const std::string& line : with_effects)
    EXPECT_EQ(line.find("  "), std::string::npos) << "no columns in letters of many widths: " << line;
  moment.road = RoadPlace::kPastEnd;
  EXPECT_EQ(overlay_lines(desk_, lamps_, moment).size(), with_effects.size() + 1) << "the road's end is told";
  moment.road = RoadPlace::kThere;
  // What was picked stands among the lines, what the audit found with the effects, and a pixel that is off in any case.
  moment.picked = "budget 16.6 ms: fragment, shadows hard";
  moment.audit = "self-audit: 32 pixels in float64, at most 0.0004 % off";
  EXPECT_EQ(overlay_lines(desk_, lamps_, moment).size(), with_effects.size() + 1);
  desk_.lines = true, desk_.effects = false;
  const auto with_pick = overlay_lines(desk_, lamps_, moment);
  EXPECT_NE(std::ranges::find(with_pick, moment.picked), with_pick.end());
  EXPECT_EQ(std::ranges::find(with_pick, moment.audit), with_pick.end());
  desk_.lines = false, desk_.effects = true;
  moment.audit_over = true;
  EXPECT_EQ(overlay_lines(desk_, lamps_, moment).size(), with_effects.size() + 2);
  moment.audit_over = false, moment.audit.clear(), moment.picked.clear();
  // That a picture of another kind is on its way, too: it may take seconds after the key.
  moment.coming = true;
  const auto coming = overlay_lines(desk_, lamps_, moment);
  EXPECT_EQ(std::ranges::count(coming, "the picture that was asked for is being made ..."), 1);
  moment.coming = false;
  // A probe of the car goes with it; one of the world stays. Facing the lamps, 900 cd each from 22 m: 900/22² lx.
  ASSERT_TRUE(apply(desk_, {"probes", "car 25 0.6 0.7 -1 0 0; world 125 0.6 0.7 -1 0 0"}));
  desk_.effects = false;
  const auto probed = overlay_lines(desk_, lamps_, moment);
  ASSERT_EQ(probed.size(), only.size() + 2);
  const double left = 900.0 / (22.0 * 22.0), r2 = 22.0 * 22.0 + 1.2 * 1.2;
  char lux[40];
  std::snprintf(lux, sizeof lux, "%.3g lx", left + 900.0 * 22.0 / (r2 * std::sqrt(r2)));
  EXPECT_EQ(probed[0], "probe 1, car: " + std::string(lux) + " at (25.00, 0.60, 0.70) m");
  EXPECT_EQ(probed[1], "probe 2, world: " + std::string(lux) + " at (125.00, 0.60, 0.70) m");
}

// A wall between the lamps and a point: the probe says what it takes away.
TEST_F(Explain, AProbeBehindAWallTellsWhatHidesTheLight) {
  scene_.materials = {{}};
  scene_.vertices = {{{10, -5, 0}, {-1, 0, 0}}, {{10, 5, 0}, {-1, 0, 0}}, {{10, 0, 9}, {-1, 0, 0}}};
  scene_.indices = {0, 1, 2};
  scene_.chunks = {{.node = "barn", .low_m = {10, -5, 0}, .high_m = {10, 5, 9}, .index_count = 3, .vertex_count = 3}};
  AskedMoment asked = moment(LightSwitch::kLow);
  lamps_.set_controls(asked.controls);
  ASSERT_TRUE(apply(desk_, {"probes", "world 20 0 0.7 -1 0 0; world 9 0 0.7 -1 0 0"}).ok());
  const EyeAdaptation eye;
  const World world(scene_);
  const auto told = [&](const World* world, std::size_t from_end) {
    const auto all =
        overlay_lines(desk_, lamps_, {.controls = asked.controls, .pose = asked.pose, .eye = eye, .world = world});
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].starts_with("probe 1")) return all[i + from_end];
    return std::string();
  };
  const MeasurePoint behind{{20, 0, 0.7}, {-1, 0, 0}};
  const double open_lx = lamps_.illuminance_lx(asked.pose, behind);
  char hidden[60];
  std::snprintf(hidden, sizeof hidden, ", %.3g lx hidden by barn", open_lx);
  EXPECT_TRUE(told(&world, 0).starts_with("probe 1, world: 0 lx")) << told(&world, 0);
  EXPECT_TRUE(told(&world, 0).ends_with(hidden)) << told(&world, 0);
  EXPECT_EQ(told(&world, 1), told(nullptr, 1)) << "before the wall nothing hides it";
  EXPECT_EQ(told(nullptr, 0).find("hidden"), std::string::npos);
  EXPECT_NE(lines(asked, device_)[1].find("1 pieces of the scene stand in the light"), std::string::npos)
      << lines(asked, device_)[1];
}

}  // namespace
}  // namespace phare
