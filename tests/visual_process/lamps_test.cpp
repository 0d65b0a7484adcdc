#include "visual/process/lamps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "visual/process/stills.h"

namespace phare {
namespace {

/// A type A table of the same intensity everywhere within ±30° x ±20°, LM-63-2002.
std::filesystem::path even_lamp(const char* name, int intensity_cd) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
  std::ofstream out(file);
  out << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 0\n-20 0 20\n-30 0 30\n";
  for (int i = 0; i < 3; ++i) out << intensity_cd << ' ' << intensity_cd << ' ' << intensity_cd << '\n';
  return file;
}

SourceConfig source(LampFunction function, const std::filesystem::path& file) {
  SourceConfig config;
  config.function = function;
  config.file = file;
  return config;
}

Rig two_lamp_rig() {
  const std::filesystem::path low = even_lamp("even_low.ies", 900), high = even_lamp("even_high.ies", 2500);
  Rig rig;
  for (const char* name : {"first", "second"}) {
    DesignConfig design;
    design.name = name;
    for (const double y_m : {0.6, -0.6}) {
      LampConfig lamp;
      lamp.name = "headlamp";
      lamp.position_m = {3.0, y_m, 0.7};
      lamp.sources = {source(LampFunction::kLow, low), source(LampFunction::kHigh, high)};
      design.lamps.push_back(lamp);
    }
    rig.designs.push_back(design);
  }
  return rig;
}

CockpitState controls(LightSwitch light, bool flash = false, bool fog = false) {
  CockpitState state;
  state.light_switch = light;
  state.flash = flash;
  state.fog_front = fog;
  return state;
}

using Lit = std::set<LampFunction>;

TEST(LitFunctions, FollowTheSwitch) {
  EXPECT_EQ(lit_functions(controls(LightSwitch::kOff), true), Lit{});
  EXPECT_EQ(lit_functions(controls(LightSwitch::kOff, true), true), Lit{LampFunction::kHigh});
  EXPECT_EQ(lit_functions(controls(LightSwitch::kOff, false, true), true), Lit{});
  EXPECT_EQ(lit_functions(controls(LightSwitch::kPosition), true), Lit{LampFunction::kPosition});
  EXPECT_EQ(lit_functions(controls(LightSwitch::kPosition, false, true), true),
            (Lit{LampFunction::kPosition, LampFunction::kFog}));
  EXPECT_EQ(lit_functions(controls(LightSwitch::kLow), true), (Lit{LampFunction::kPosition, LampFunction::kLow}));
  EXPECT_EQ(lit_functions(controls(LightSwitch::kHigh), true),
            (Lit{LampFunction::kPosition, LampFunction::kLow, LampFunction::kHigh}));
  EXPECT_EQ(lit_functions(controls(LightSwitch::kHigh), false), (Lit{LampFunction::kPosition, LampFunction::kHigh}));
  EXPECT_EQ(lit_functions(controls(LightSwitch::kLow, true), false),
            (Lit{LampFunction::kPosition, LampFunction::kHigh}));
}

TEST(Lamps, SumOnlyWhatChanges) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok()) << lamps.error().text();
  EXPECT_EQ(lamps->set_controls(controls(LightSwitch::kLow)).size(), 2u);
  EXPECT_EQ(lamps->compositions(), 2u);
  const std::uint64_t texels = lamps->summed_texels();
  EXPECT_GT(texels, 0u);
  for (int frame = 0; frame < 100; ++frame) EXPECT_TRUE(lamps->set_controls(controls(LightSwitch::kLow)).empty());
  EXPECT_EQ(lamps->compositions(), 2u);
  EXPECT_EQ(lamps->summed_texels(), texels);
  EXPECT_EQ(lamps->set_controls(controls(LightSwitch::kHigh)).size(), 2u);
  EXPECT_EQ(lamps->compositions(), 4u);
  EXPECT_EQ(lamps->set_controls(controls(LightSwitch::kLow)).size(), 2u);
  EXPECT_EQ(lamps->compositions(), 6u);
  EXPECT_EQ(lamps->uploads(), 6u);
  EXPECT_TRUE(lamps->set_controls(controls(LightSwitch::kLow, false, true)).empty());  // no fog lamps: nothing changes
  EXPECT_EQ(lamps->compositions(), 6u);
  CockpitState other = controls(LightSwitch::kLow);
  other.design_index = 1;
  EXPECT_EQ(lamps->set_controls(other).size(), 2u);
  EXPECT_EQ(lamps->compositions(), 8u);
  const std::vector<Lamps::Change> back = lamps->set_controls(controls(LightSwitch::kLow));
  EXPECT_EQ(back.size(), 2u);  // the slots hold the other design: uploaded whole, but not summed again
  for (const Lamps::Change& change : back) EXPECT_TRUE(change.part.empty());
  EXPECT_EQ(lamps->compositions(), 8u);
  lamps->set_controls(other);
  other.design_index = 99;  // past the last: the last
  EXPECT_TRUE(lamps->set_controls(other).empty());
  EXPECT_EQ(lamps->design().name, "second");
}

TEST(Lamps, ADimmedSourceChangesItsLampAlone) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  lamps->set_controls(controls(LightSwitch::kHigh));
  const VehicleState pose;
  const MeasurePoint wall{{28.0, 0.6, 0.7}, {-1.0, 0.0, 0.0}};
  const double before_lx = lamps->illuminance_lx(pose, wall);
  ASSERT_TRUE(lamps->dim({"headlamp", 2, 0.25}).ok());  // of two lamps of that name the first; its second source: high
  const std::vector<Lamps::Change> changes = lamps->set_controls(controls(LightSwitch::kHigh));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_FALSE(changes[0].part.empty());
  // Straight ahead of the first lamp, 25 m: 0.75 of 2500 cd are gone.
  EXPECT_NEAR(before_lx - lamps->illuminance_lx(pose, wall), 0.75 * 2500.0 / 625.0, 1e-9);
  EXPECT_TRUE(lamps->set_controls(controls(LightSwitch::kHigh)).empty());
  EXPECT_EQ(lamps->set_controls(controls(LightSwitch::kLow)).size(),
            2u);  // a dark source stays dark whatever its dimming
  EXPECT_EQ(lamps->placed(pose).size(), 2u);

  EXPECT_EQ(lamps->dim({"headlamp", 3, 0.5}).error().text(), "lamp \"headlamp\": has 2 sources, no number 3");
  EXPECT_FALSE(lamps->dim({"spotlight", 0, 0.5}).ok());
  EXPECT_FALSE(lamps->swivel({"spotlight", 0.1, 0.0}).ok());
}

/// A PGM of one row of shares, repeated.
std::filesystem::path picture(const char* name, const std::vector<int>& row, int rows) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
  std::ofstream out(file, std::ios::binary);
  out << "P5 " << row.size() << ' ' << rows << " 255\n";
  for (int j = 0; j < rows; ++j)
    for (const int share : row) out.put(static_cast<char>(share));
  return file;
}

// Pictures by hand and by a law; the truth of points and the beam image follow, for this lamp alone.
TEST(Lamps, APixelLightShinesItsPicture) {
  Rig rig = two_lamp_rig();
  for (LampConfig& lamp : rig.designs[0].lamps)
    lamp.sources[1].pixels = picture("begin.pgm", {255, 255, 255, 0, 0, 0}, 4);
  rig.designs[0].lamps[1].name = "other";
  Result<Lamps> lamps = Lamps::load(rig);
  ASSERT_TRUE(lamps.ok()) << lamps.error().text();
  lamps->set_controls(controls(LightSwitch::kHigh));
  const VehicleState pose;
  // 25 m ahead of the left lamp, 15 degrees to the left and to the right: low beam's 900 cd, and the pixels' 2500.
  const auto lux = [&](double side_deg) {
    const double side = std::tan(side_deg * 3.14159265358979323846 / 180.0);
    const MeasurePoint wall{{28.0, 0.6 + 25.0 * side, 0.7}, {-1.0, 0.0, 0.0}};
    double of_left = 0.0;
    for (const PointLight& light : lamps->lights_at(pose, wall))
      if (light.lamp == "headlamp") of_left = light.candela;
    return of_left;
  };
  EXPECT_NEAR(lux(15.0), 900.0 + 2500.0, 1e-6);
  EXPECT_NEAR(lux(-15.0), 900.0, 1e-6);

  ASSERT_TRUE(lamps->frame({"headlamp", picture("turned.pgm", {0, 0, 0, 255, 255, 51}, 4).string()}).ok());
  const std::vector<Lamps::Change> changes = lamps->set_controls(controls(LightSwitch::kHigh));
  ASSERT_EQ(changes.size(), 1u) << "the other lamp has its own";
  EXPECT_FALSE(changes[0].part.empty());
  EXPECT_NEAR(lux(15.0), 900.0, 1e-6);
  EXPECT_NEAR(lux(-15.0), 900.0 + 2500.0, 1e-6);
  EXPECT_NEAR(lux(-25.0), 900.0 + 500.0, 1e-6);
  EXPECT_TRUE(lamps->set_controls(controls(LightSwitch::kHigh)).empty());

  LawAnswer answer;
  answer.lamps.push_back({"headlamp", 0.0, 0.0, {}, picture("law.pgm", {0, 0, 0, 0, 255, 0}, 4).string()});
  ASSERT_TRUE(lamps->follow(answer, 0).ok());
  lamps->set_controls(controls(LightSwitch::kHigh));
  EXPECT_NEAR(lux(-15.0), 900.0 + 2500.0, 1e-6);
  EXPECT_NEAR(lux(-25.0), 900.0, 1e-6);

  const std::string wrong = picture("wrong.pgm", {1, 2, 3}, 4).string();
  EXPECT_EQ(lamps->frame({"headlamp", wrong}).error().text(),
            wrong + ": 3 × 4 pixels; the light of lamp \"headlamp\" has 6 × 4");
  EXPECT_FALSE(lamps->frame({"headlamp", "/no/such.png"}).ok());
  EXPECT_NEAR(lux(-15.0), 900.0 + 2500.0, 1e-6) << "as before";
  CockpitState second = controls(LightSwitch::kHigh);
  second.design_index = 1;
  lamps->set_controls(second);
  EXPECT_EQ(lamps->frame({"headlamp", wrong}).error().text(),
            "lamp \"headlamp\": has no pixel light (\"pixels\" of a source in the rig file)");
}

TEST(Lamps, ASwivelTurnsALampAndSumsNothing) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  lamps->set_controls(controls(LightSwitch::kLow));
  const std::uint64_t texels = lamps->summed_texels();
  ASSERT_TRUE(lamps->swivel({"headlamp", 0.2, 0.0}).ok());
  EXPECT_TRUE(lamps->set_controls(controls(LightSwitch::kLow)).empty());
  EXPECT_EQ(lamps->summed_texels(), texels);
  const std::vector<PlacedLamp> placed = lamps->placed(VehicleState{});
  EXPECT_NEAR(placed[0].world_from_image[0].y, std::sin(0.2), 1e-12);  // to the left
  EXPECT_NEAR(placed[1].world_from_image[0].y, 0.0, 1e-12);
}

TEST(Lamps, ALampIsMovedOnTheCar) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  lamps->set_controls(controls(LightSwitch::kLow));
  const MeasurePoint wall{{28.0, 0.6, 0.7}, {-1.0, 0.0, 0.0}};
  const double before_lx = lamps->illuminance_lx(VehicleState{}, wall);
  ASSERT_TRUE(lamps->place({"headlamp", 8.0, 0.6, 0.7}).ok());  // from 25 m to 20 m
  EXPECT_EQ(lamps->placed(VehicleState{})[0].position_m, glm::dvec3(8.0, 0.6, 0.7));
  EXPECT_NEAR(lamps->illuminance_lx(VehicleState{}, wall) - before_lx, 900.0 / 400.0 - 900.0 / 625.0, 1e-9);
  EXPECT_FALSE(lamps->place({"spotlight", 0.0, 0.0, 0.0}).ok());
}

TEST(Lamps, DarkPositionsAreNotPlaced) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  lamps->set_controls(controls(LightSwitch::kOff));
  EXPECT_TRUE(lamps->placed(VehicleState{}).empty());
  lamps->set_controls(controls(LightSwitch::kLow));
  EXPECT_EQ(lamps->placed(VehicleState{}).size(), 2u);
}

TEST(Lamps, StandInTheWorldWithTheBody) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  lamps->set_controls(controls(LightSwitch::kLow));
  VehicleState pose;
  pose.x_m = 100.0;
  pose.yaw_rad = M_PI / 2;  // heads north (y)
  const PlacedLamp left = lamps->placed(pose).front();
  EXPECT_NEAR(left.position_m.x, 99.4, 1e-12);
  EXPECT_NEAR(left.position_m.y, 3.0, 1e-12);
  EXPECT_NEAR(left.position_m.z, 0.7, 1e-12);
  EXPECT_NEAR(left.world_from_image[0].y, 1.0, 1e-12);

  pose = {};
  pose.pitch_rad = 0.1;  // nose down: the beam falls
  EXPECT_LT(lamps->placed(pose).front().world_from_image[0].z, -0.09);
  lamps->set_aim(0.1);  // aim up by as much: level again
  EXPECT_NEAR(lamps->placed(pose).front().world_from_image[0].z, 0.0, 1e-12);
}

TEST(Lamps, LevellingInThePoseTiltsTheBeamOnce) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  CockpitState wheel = controls(LightSwitch::kLow);
  wheel.lamp_aim_rad = -0.02;
  lamps->set_controls(wheel);
  VehicleState pose;
  pose.pitch_rad = 0.03;
  pose.lamp_tilt_rad = 0.05;  // -0.03 of the body, -0.02 of the wheel, +0.05 of levelling: level
  EXPECT_NEAR(lamps->placed(pose).front().world_from_image[0].z, 0.0, 1e-12);
  pose.lamp_tilt_rad = 0.0;
  EXPECT_NEAR(std::asin(lamps->placed(pose).front().world_from_image[0].z), -0.05, 1e-12);
  // The truth that the picture is held to tilts alike: the table ends at 20 degrees, 0.35 rad.
  const MeasurePoint wall{{28.0, 0.2, 0.9}, {-1.0, 0.0, 0.0}};
  EXPECT_GT(lamps->illuminance_lx(pose, wall), 1.0);
  pose.lamp_tilt_rad = 0.5;
  EXPECT_EQ(lamps->illuminance_lx(pose, wall), 0.0);
  lamps->set_aim(-0.5);
  EXPECT_GT(lamps->illuminance_lx(pose, wall), 1.0);
}

TEST(Lamps, IlluminanceIsIntensityOverDistanceSquared) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  lamps->set_controls(controls(LightSwitch::kLow));
  VehicleState pose;
  pose.x_m = 5e6;  // far from the origin
  const MeasurePoint wall{{5e6 + 28.0, 0.0, 0.7}, {-1.0, 0.0, 0.0}};
  const double r2 = 25.0 * 25.0 + 0.36;
  EXPECT_NEAR(lamps->illuminance_lx(pose, wall), 2.0 * 900.0 / r2 * 25.0 / std::sqrt(r2), 1e-7);
  lamps->set_controls(controls(LightSwitch::kHigh));
  EXPECT_NEAR(lamps->illuminance_lx(pose, wall), 2.0 * 3400.0 / r2 * 25.0 / std::sqrt(r2), 1e-7);
  EXPECT_EQ(lamps->illuminance_lx(pose, {wall.position_m, {1.0, 0.0, 0.0}}), 0.0);  // lit from behind
}

// An adjuster stands in the lux and in the picture's image, on the CPU and on the device alike.
TEST(Lamps, AnAimTurnsTheWholeLamp) {
  Rig straight = two_lamp_rig(), turned = two_lamp_rig();
  for (LampConfig& lamp : turned.designs[0].lamps) lamp.aim = {AimConfig::Kind::kTurned, -0.05};
  for (LampConfig& lamp : straight.designs[0].lamps)
    for (SourceConfig& each : lamp.sources) each.pitch_rad -= 0.05;
  Result<Lamps> by_hand = Lamps::load(straight), by_aim = Lamps::load(turned);
  ASSERT_TRUE(by_hand.ok() && by_aim.ok());
  ASSERT_EQ(by_aim->aimings().size(), 2u);
  const VehicleState pose;
  for (Lamps* lamps : {&*by_hand, &*by_aim}) lamps->set_controls(controls(LightSwitch::kLow));
  const MeasurePoint road{{20.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  EXPECT_GT(by_aim->illuminance_lx(pose, road), 0.0);
  EXPECT_DOUBLE_EQ(by_aim->illuminance_lx(pose, road), by_hand->illuminance_lx(pose, road));
  EXPECT_EQ(by_aim->placed(pose).at(0).world_from_image, by_hand->placed(pose).at(0).world_from_image);
}

// These tables end at V -20° and H ±30°; the window sees the road up to 21° below its eye.
TEST(Lamps, TheOverlayTellsOfTablesThatEndWhereTheyAreLit) {
  Rig rig = two_lamp_rig();
  rig.channels = {{"front", 1280, 720, 1.2, {1.4, 0.4, 1.2}, 0.0, 0.0}};
  Result<Lamps> lamps = Lamps::load(rig);
  ASSERT_TRUE(lamps.ok());
  lamps->set_controls(controls(LightSwitch::kOff));
  EXPECT_TRUE(lamps->lit_table_ends().empty());
  lamps->set_controls(controls(LightSwitch::kLow));
  ASSERT_EQ(lamps->lit_table_ends().size(), 1u) << "a pair says it once";
  // 0.7 m / tan 20°
  EXPECT_TRUE(lamps->lit_table_ends().front().starts_with(
      "low beam even_low.ies: table ends at V -20.0°: the road nearer than 1.9 m ahead is outside it"))
      << lamps->lit_table_ends().front();
  lamps->set_controls(controls(LightSwitch::kHigh));
  EXPECT_EQ(lamps->lit_table_ends().size(), 2u);
}

TEST(Lamps, BadRigsAreErrors) {
  Rig none;
  EXPECT_FALSE(Lamps::load(none).ok());
  Rig missing = two_lamp_rig();
  missing.designs[0].lamps[0].sources[0].file = "/nonexistent/lamp.ies";
  const Result<Lamps> loaded = Lamps::load(missing);
  ASSERT_FALSE(loaded.ok());
  EXPECT_NE(loaded.error().text().find("lamp.ies"), std::string::npos);
  Rig many = two_lamp_rig();
  many.designs[0].lamps.resize(9);
  EXPECT_FALSE(Lamps::load(many).ok());
}

TEST(Stills, TheWallHasItsGridAndLight) {
  Result<Lamps> lamps = Lamps::load(two_lamp_rig());
  ASSERT_TRUE(lamps.ok());
  const Image8 page = wall_picture(*lamps, 0);
  EXPECT_GT(page.width_px, 40 * 28);
  EXPECT_GT(page.height_px, 16 * 28);
  // 2 x 900 cd at 25 m: 2.9 lx, a colour well away from black in the middle of the wall, off the grid lines
  const std::size_t at =
      (static_cast<std::size_t>(page.height_px / 2 + 20) * static_cast<std::size_t>(page.width_px) + 700) * 4;
  EXPECT_GT(page.rgba[at] + page.rgba[at + 1] + page.rgba[at + 2], 60);
}

}  // namespace
}  // namespace phare
