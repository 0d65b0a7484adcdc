// unit: lamps of one's own: what is typed, the design made of it, and what is refused.
#include "tools/lamp_design.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <numbers>

#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

class OwnLamp : public testing::Test {
 protected:
  OwnLamp() : folder_(fs::path(testing::TempDir()) / ("phare_own_lamp_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~OwnLamp() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  static std::string ours(const std::string& name) { return lamps_dir() + "/" + name; }
  std::string copy(const std::string& of, const std::string& as) const {
    fs::copy_file(ours(of), folder_ / as, fs::copy_options::overwrite_existing);
    return (folder_ / as).string();
  }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  static Rig demo() {
    auto rig = read_rig(source_dir() + "/config/rigs/country_road.toml");
    EXPECT_TRUE(rig.ok());
    return *rig;
  }
  /// Of refusing; empty when it is not refused.
  static std::string refusal(const LampFlags& flags) {
    Rig rig = demo();
    const auto made = put_lamp_design(rig, flags);
    return made ? "" : made.error().text();
  }
  static std::string all(const LampDesignNotes& notes) {
    std::string text;
    for (const std::string& line : notes.lines) text += line + "\n";
    return text;
  }

  fs::path folder_;
};

TEST_F(OwnLamp, APairFromOneFile) {
  const std::string my = copy("led_low_rht.ies", "my lamp.ies");
  Rig rig = demo();
  const auto notes = put_lamp_design(rig, {.low = {my}});
  ASSERT_TRUE(notes) << notes.error().text();
  ASSERT_EQ(rig.designs.size(), 3u);
  const DesignConfig& design = rig.designs.front();
  EXPECT_EQ(design.name, "my lamp");
  EXPECT_TRUE(rig.keep_design);
  ASSERT_EQ(design.lamps.size(), 6u) << "two low, two high and two fog lamps of the rig";
  EXPECT_EQ(design.lamps[0].name, "headlamp left");
  EXPECT_EQ(design.lamps[1].name, "headlamp right");
  EXPECT_EQ(design.lamps[0].position_m, glm::dvec3(3.45, 0.62, 0.66));
  EXPECT_EQ(design.lamps[1].position_m, glm::dvec3(3.45, -0.62, 0.66));
  for (const int side : {0, 1}) {
    EXPECT_EQ(design.lamps[side].aim.kind, AimConfig::Kind::kCutoff);
    ASSERT_EQ(design.lamps[side].sources.size(), 1u);
    EXPECT_EQ(design.lamps[side].sources[0].file, my);
    EXPECT_EQ(design.lamps[side].sources[0].function, LampFunction::kLow);
  }
  EXPECT_EQ(design.lamps[2].name, "headlamp high left");
  EXPECT_EQ(design.lamps[2].sources[0].file.filename(), "high.ies");
  EXPECT_DOUBLE_EQ(design.lamps[2].sources[0].pitch_rad, -0.573 * kRadPerDeg) << "the rig's own aim";
  EXPECT_EQ(design.lamps[4].name, "fog left");
  const std::string said = all(*notes);
  EXPECT_TRUE(
      said.starts_with("design \"my lamp\": low beam my lamp.ies; high beam, fog lamp: the rig's own (halogen)\n"))
      << said;
  EXPECT_NE(said.find("headlamp left, headlamp right: cut-off found at V "), std::string::npos) << said;
  EXPECT_NE(said.find("turned by -0.5"), std::string::npos) << said;
}

TEST_F(OwnLamp, TwoFilesAPlaceAndEveryKey) {
  const std::string a = copy("low_rht.ies", "a.ies"), b = copy("led_low_rht.ies", "b, c.ies");
  Rig rig = demo();
  const auto notes = put_lamp_design(
      rig, {.low = {"left=" + a + ",right=" + b + ",x=3.6,y=0.7,z=0.9,yaw_deg=1,scale=2,colour_temperature_k=4300"},
            .aim = "-0.7",
            .others = "none"});
  ASSERT_TRUE(notes) << notes.error().text();
  const DesignConfig& design = rig.designs.front();
  EXPECT_EQ(design.name, "a + b, c");
  ASSERT_EQ(design.lamps.size(), 2u);
  EXPECT_EQ(design.lamps[0].position_m, glm::dvec3(3.6, 0.7, 0.9));
  EXPECT_EQ(design.lamps[1].position_m, glm::dvec3(3.6, -0.7, 0.9));
  EXPECT_EQ(design.lamps[0].sources[0].file, a);
  EXPECT_EQ(design.lamps[1].sources[0].file, b);
  EXPECT_DOUBLE_EQ(design.lamps[0].sources[0].yaw_rad, kRadPerDeg);
  EXPECT_DOUBLE_EQ(design.lamps[1].sources[0].yaw_rad, -kRadPerDeg);
  EXPECT_EQ(design.lamps[1].sources[0].scale, 2.0);
  EXPECT_EQ(design.lamps[1].sources[0].colour_temperature_k, 4300.0);
  EXPECT_EQ(design.lamps[0].aim.kind, AimConfig::Kind::kTurned);
  EXPECT_DOUBLE_EQ(design.lamps[0].aim.up_rad, -0.7 * kRadPerDeg);
  EXPECT_NE(all(*notes).find("; no high beam, fog lamp"), std::string::npos) << all(*notes);
}

TEST_F(OwnLamp, ASpectrumIsItsColourInEveryLamp) {
  Rig rig = demo();
  const std::string spectrum = file("line.csv", "wavelength_nm,power\n585,0\n590,2\n595,0\n");
  ASSERT_TRUE(put_lamp_design(rig, {.low = {ours("low_rht.ies") + ",spectrum=" + spectrum}, .others = "none"}));
  for (const LampConfig& lamp : rig.designs.front().lamps) {
    EXPECT_EQ(lamp.sources[0].spectrum, spectrum);
    ASSERT_TRUE(lamp.sources[0].chromaticity_xy);
    EXPECT_NEAR(lamp.sources[0].chromaticity_xy->x, 0.575, 2e-3);
  }
}

TEST_F(OwnLamp, LowAndHighShareTheirPlace) {
  Rig rig = demo();
  const auto notes = put_lamp_design(rig, {.low = {ours("low_rht.ies")}, .high = {ours("led_high.ies")}});
  ASSERT_TRUE(notes) << notes.error().text();
  const DesignConfig& design = rig.designs.front();
  ASSERT_EQ(design.lamps.size(), 4u);
  ASSERT_EQ(design.lamps[0].sources.size(), 2u);
  EXPECT_EQ(design.lamps[0].sources[1].function, LampFunction::kHigh);
  EXPECT_NE(all(*notes).find("the high beam turns with it, one adjuster"), std::string::npos) << all(*notes);
}

TEST_F(OwnLamp, AHighOrFogBeamAloneSaysWhatElseBurns) {
  Rig rig = demo();
  auto notes = put_lamp_design(rig, {.high = {ours("led_high.ies")}});
  ASSERT_TRUE(notes) << notes.error().text();
  EXPECT_TRUE(all(*notes).starts_with(
      "design \"led_high\": high beam led_high.ies; low beam, fog lamp: the rig's own (halogen)\n"))
      << all(*notes);
  EXPECT_NE(all(*notes).find("aimed as filed: a driving beam has no cut-off"), std::string::npos) << all(*notes);
  EXPECT_EQ(rig.designs.front().lamps[0].aim, AimConfig{});
  rig = demo();
  notes = put_lamp_design(rig, {.fog = {ours("fog.ies")}});
  ASSERT_TRUE(notes) << notes.error().text();
  EXPECT_EQ(rig.designs.front().lamps[0].position_m, glm::dvec3(3.5, 0.55, 0.35)) << "the rig's fog lamp";
  EXPECT_NE(all(*notes).find("UN R48 6.3.6.1.2"), std::string::npos) << all(*notes);
}

TEST_F(OwnLamp, APitchThatIsGivenIsTheAimUnlessAskedOtherwise) {
  Rig rig = demo();
  ASSERT_TRUE(put_lamp_design(rig, {.low = {ours("low_rht.ies") + ",pitch_deg=-0.3"}}).ok());
  EXPECT_EQ(rig.designs.front().lamps[0].aim, AimConfig{});
  EXPECT_DOUBLE_EQ(rig.designs.front().lamps[0].sources[0].pitch_rad, -0.3 * kRadPerDeg);
  rig = demo();
  ASSERT_TRUE(put_lamp_design(rig, {.low = {ours("low_rht.ies") + ",pitch_deg=-0.3"}, .aim = "cut-off"}).ok());
  EXPECT_EQ(rig.designs.front().lamps[0].aim.kind, AimConfig::Kind::kCutoff);
}

TEST_F(OwnLamp, ANameOfItsOwn) {
  const std::string my = copy("low_rht.ies", "led.ies");
  Rig rig = demo();
  ASSERT_TRUE(put_lamp_design(rig, {.low = {my}}).ok());
  EXPECT_EQ(rig.designs.front().name, "led (2)") << "the rig has a design led";
}

TEST_F(OwnLamp, FileNamesWithCommasAndQuotes) {
  const auto left = [&](const std::string& text) {
    const auto choice = parse_lamp_choice("--lamp", LampFunction::kLow, text);
    return choice ? choice->left.filename().string() : choice.error().reason;
  };
  const std::string comma = copy("low_rht.ies", "my, lamp.ies"), key = copy("low_rht.ies", "a,x=1.ies"),
                    quote = copy("low_rht.ies", "7\" lamp.ies");
  EXPECT_EQ(left(comma + ",z=0.7"), "my, lamp.ies");
  EXPECT_EQ(left("\"" + key + "\",z=0.7"), "a,x=1.ies");
  EXPECT_EQ(left("left=\"" + key + "\",right=" + comma), "a,x=1.ies");
  EXPECT_EQ(left("\"" + (folder_ / "7\"\" lamp.ies").string() + "\""), "7\" lamp.ies");
  EXPECT_EQ(left("\"" + key), "a file name in double quotes ends with a quote, and a comma or nothing follows");
}

TEST_F(OwnLamp, WhatIsRefusedSaysWhichAndWhy) {
  const std::string low = ours("low_rht.ies");
  const auto ends = [](const std::string& text, const std::string& end) {
    EXPECT_TRUE(text.ends_with(end)) << text << "\nexpected " << end;
  };
  ends(refusal({.low = {"/nowhere/my.ies"}}),
       "--lamp /nowhere/my.ies: /nowhere/my.ies: no such file; a photometry file is expected");
  ends(refusal({.low = {folder_.string()}}), "is a folder; a photometry file is expected");
  ends(refusal({.low = {"left=" + low}}), ": left= without right=; one file for both sides is FILE alone");
  ends(refusal({.low = {"right=" + low}}), ": right= without left=");
  ends(refusal({.low = {low + ",right=" + low}}), ": a file for both sides, or left= and right=, not both");
  ends(refusal({.low = {"left=" + low + ",right=" + low}}),
       ": the same file is given twice; one file for both sides is FILE alone");
  ends(refusal({.low = {low, low}}), "--lamp: given twice; a pair from two files is left=FILE,right=FILE");
  ends(refusal({.low = {low}, .high = {low}}), "low_rht.ies is given twice: it is the low beam already");
  ends(refusal({.low = {low + ",pitch=1"}}), ": no key \"pitch\"; did you mean \"pitch_deg\"?");
  ends(refusal({.low = {low + ",colour_temperature=4000"}}),
       ": no key \"colour_temperature\"; did you mean \"colour_temperature_k\"?");
  ends(refusal({.low = {low + ",z=nan"}}), ": \"z\": expected a finite number, got \"nan\"");
  ends(refusal({.low = {low + ",z=-1"}}), ": a lamp sits above the road, z > 0");
  ends(refusal({.low = {low + ",y=-0.6"}}), ": a pair is given by its left lamp, y > 0");
  ends(refusal({.low = {low + ",colour_temperature_k=10"}}),
       ": \"colour_temperature_k\": expected 1667 to 25000, got \"10\"");
  const std::string spectrum = file("led.csv", "wavelength_nm,power\n450,1\n455,-2\n");
  ends(refusal({.low = {low + ",spectrum=" + spectrum}}), "led.csv:3: power is negative");
  const std::string line = file("line.csv", "wavelength_nm,power\n450,1\n455,2\n");
  ends(refusal({.low = {low + ",colour_temperature_k=4300,spectrum=" + line}}),
       ": a spectrum or a colour_temperature_k, not both");
  ends(refusal({.low = {low}, .aim = "up"}), "--aim up: expected as-filed, cut-off, or degrees up (-90 to 90)");
  ends(refusal({.low = {low}, .aim = "nan"}), "expected as-filed, cut-off, or degrees up (-90 to 90)");
  const std::string bad =
      file("bad.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 50\n-4 4\n-4 4\n1 2\n3 oops\n");
  ends(refusal({.low = {bad}}), "bad.ies:8: a candela value is not a number: \"oops\" (value 4 of 4)");
  const std::string dark =
      file("dark.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 50\n-4 4\n-4 4\n0 0\n0 0\n");
  EXPECT_NE(refusal({.low = {dark}}).find("dark.ies: sends no light ahead"), std::string::npos)
      << refusal({.low = {dark}});
  const std::string up =
      file("up.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 50\n40 60\n-4 4\n9 9\n9 9\n");
  EXPECT_NE(refusal({.low = {up}}).find("up.ies: sends no light ahead"), std::string::npos) << refusal({.low = {up}});
}

// A luminaire that hangs: type C, gamma 0 down.
TEST_F(OwnLamp, TypeCSaysWhichAxisWasTaken) {
  const std::string street =
      file("street.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 50\n0 45 90\n0\n1000 800 0\n");
  Rig rig = demo();
  auto notes = put_lamp_design(rig, {.low = {street}});
  ASSERT_TRUE(notes) << notes.error().text();
  EXPECT_NE(all(*notes).find("street.ies: type C: its gamma 0 is taken as straight ahead (axis=gamma0)"),
            std::string::npos)
      << all(*notes);
  rig = demo();
  notes = put_lamp_design(rig, {.low = {street + ",axis=gamma0"}});
  ASSERT_TRUE(notes);
  EXPECT_EQ(all(*notes).find("is taken as straight ahead"), std::string::npos) << "asked for";
}

TEST_F(OwnLamp, NeedsAPlaceThatTheRigDoesNotHave) {
  Rig rig = demo();
  std::erase_if(rig.designs.front().lamps, [](const LampConfig& lamp) { return lamp.name.starts_with("fog"); });
  auto made = put_lamp_design(rig, {.fog = {ours("fog.ies")}});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().text().find("has no fog lamp: say where it sits, x=…,y=…,z=… in m"), std::string::npos)
      << made.error().text();
  EXPECT_TRUE(put_lamp_design(rig, {.fog = {ours("fog.ies") + ",x=3.5,y=0.5,z=0.4"}}).ok());
}

}  // namespace
}  // namespace phare
