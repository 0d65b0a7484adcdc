// unit: the rig reader and the lamp argument, good and bad.
#include "config/rig.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "config/picture_options.h"
#include "tests/paths.h"

namespace phare {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

constexpr const char* kGoodRig = R"(scene = "generated/scenes/a.glb"
vehicle = "../car.toml"
cockpit = "/etc/cockpit.toml"
[[channel]]
fov_horizontal_deg = 90
[[design]]
name = "one"
[[design.lamp]]
name = "head"
pair = true
position_m = [3.0, 0.6, 0.7]
[[design.lamp.source]]
function = "low"
file = "generated/lamps/l.ies"
pitch_deg = -0.573
yaw_deg = 1
)";

std::filesystem::path write_rig(std::string text) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "phare_rig_test.toml";
  std::ofstream(path) << text;
  return path;
}

std::string rig_error(const std::string& from, const std::string& to) {
  std::string text = kGoodRig;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto rig = read_rig(write_rig(text));
  if (rig) return "";
  return rig.error().text().substr(testing::TempDir().size());
}

TEST(Rig, ReadsGoodRig) {
  setenv("PHARE_GENERATED_DIR", "/gen", 1);
  const auto rig = read_rig(write_rig(kGoodRig));
  unsetenv("PHARE_GENERATED_DIR");
  ASSERT_TRUE(rig) << rig.error().text();
  EXPECT_EQ(rig->scene_file, "/gen/scenes/a.glb");
  EXPECT_EQ(rig->cockpit_file, "/etc/cockpit.toml");
  EXPECT_TRUE(rig->vehicle_file.is_absolute());
  EXPECT_EQ(rig->port_base, 47000);
  ASSERT_EQ(rig->channels.size(), 1u);
  EXPECT_DOUBLE_EQ(rig->channels[0].fov_horizontal_rad, 90 * kRadPerDeg);
  ASSERT_EQ(rig->designs.size(), 1u);
  ASSERT_EQ(rig->designs[0].lamps.size(), 2u);
  const LampConfig& left = rig->designs[0].lamps[0];
  const LampConfig& right = rig->designs[0].lamps[1];
  EXPECT_EQ(left.name, "head left");
  EXPECT_EQ(left.position_m, glm::dvec3(3.0, 0.6, 0.7));
  EXPECT_EQ(right.position_m, glm::dvec3(3.0, -0.6, 0.7));
  EXPECT_DOUBLE_EQ(left.sources.at(0).pitch_rad, -0.573 * kRadPerDeg);
  EXPECT_DOUBLE_EQ(left.sources.at(0).yaw_rad, kRadPerDeg);
  EXPECT_DOUBLE_EQ(right.sources.at(0).yaw_rad, -kRadPerDeg);
  EXPECT_EQ(left.sources.at(0).function, LampFunction::kLow);
}

/// The same words as keys, command line and bus have.
TEST(Rig, SetsTheDesk) {
  const std::string desk =
      "[eye]\nadaptation_k = 4500\n[desk]\ncamera = \"chase\"\nisolux_lx = [1, 2.5]\nexposure_per_cdm2 = 0.25\n"
      "design = 0\nprobes = [\"car 25 0 0\", \"world 1 2 3\"]\nlines = \"off\"\n"
      "[weather]\nvisibility_m = 80\nrain_mmph = 6\nsnow_mmph = 0.5\n";
  const auto rig = read_rig(write_rig(kGoodRig + desk));
  ASSERT_TRUE(rig) << rig.error().text();
  Desk expected;
  for (const char* words :
       {"adaptation_k 4500", "camera chase", "isolux_lx 1 2.5", "exposure_per_cdm2 0.25", "design 0",
        "probes car 25 0 0; world 1 2 3", "lines off", "visibility_m 80", "rain_mmph 6", "snow_mmph 0.5"})
    ASSERT_TRUE(apply(expected, desk_command(words))) << words;
  EXPECT_EQ(rig->desk, expected);
  EXPECT_EQ(read_rig(write_rig(kGoodRig))->desk, Desk{});

  const auto wrong = [](const std::string& line) {
    const auto bad = read_rig(write_rig(std::string(kGoodRig) + "[desk]\n" + line + "\n"));
    return bad ? std::string() : bad.error().text().substr(testing::TempDir().size());
  };
  EXPECT_EQ(
      wrong("camera = \"roof\""),
      "phare_rig_test.toml:18: \"desk.camera\": \"roof\" is none of driver, birds-eye, chase, oncoming, wall, "
      "left-mirror, inner-mirror, right-mirror, free, next");
  EXPECT_EQ(wrong("design = 1"), "phare_rig_test.toml:18: \"desk.design\": 1: the rig has 1, counted from 0");
  EXPECT_EQ(wrong("[weather]\nvisibility_m = 0.2"),
            "phare_rig_test.toml:19: \"weather.visibility_m\": 0.2 is outside 1 to 1e+05; or clear");
  EXPECT_EQ(wrong("[weather]\nrain_mmph = 200"),
            "phare_rig_test.toml:19: \"weather.rain_mmph\": 200 is outside 0 to 100");
  EXPECT_NE(wrong("visibility_m = 3").find("no key \"visibility_m\"; there is age_years, asphalt, camera"),
            std::string::npos)
      << wrong("visibility_m = 3");
  EXPECT_NE(wrong("isolux = 3").find("did you mean \"isolux_lx\"?"), std::string::npos) << wrong("isolux = 3");
}

TEST(Rig, BadRigsSayWhere) {
  EXPECT_EQ(rig_error("fov_horizontal_deg", "fov_deg"),
            "phare_rig_test.toml:5: no key \"fov_deg\"; did you mean \"fov_horizontal_deg\"? (in channel)");
  EXPECT_EQ(rig_error("= 90", "= 190"),
            "phare_rig_test.toml:5: \"channel.fov_horizontal_deg\": 190 is outside 1 … 170");
  EXPECT_EQ(rig_error("\"low\"", "\"lwo\""),
            "phare_rig_test.toml:13: \"design.lamp.source.function\": \"lwo\" is none of position, low, high, fog, "
            "daytime, cornering");
  EXPECT_EQ(rig_error("0.6,", "-0.6,"),
            "phare_rig_test.toml:11: \"design.lamp.position_m\": a pair is given by its left lamp, y > 0");
  EXPECT_EQ(rig_error("scene =", "scnee ="), "phare_rig_test.toml:1: no key \"scnee\"; did you mean \"scene\"?");
  EXPECT_EQ(rig_error("[[channel]]", "[bus]\naddress=\"0.0.0.0\"\n[[channel]]"),
            "phare_rig_test.toml:5: \"bus.address\": off loopback (127.…) a key_file is required: 64 hexadecimal "
            "digits, as of openssl rand -hex 32");
  EXPECT_TRUE(rig_error("[[design.lamp]]", "[[design.lamp]").starts_with("phare_rig_test.toml:8: "));
}

// But for the first, a channel's pictures go into a folder of its name, in the folder of the drive.
TEST(Rig, AChannelIsNamedAsAFolderThatIsFree) {
  const auto named = [](const std::string& first, const std::string& second) {
    return rig_error("fov_horizontal_deg = 90\n", "name = \"" + first + "\"\n[[channel]]\nname = \"" + second + "\"\n");
  };
  for (const char* bad : {"", ".", "..", "../../x", "/tmp/x", "a/b", "a\\u0000b"}) {
    EXPECT_TRUE(named(bad, "left").starts_with("phare_rig_test.toml:5: \"channel.name\": ")) << bad;
    EXPECT_TRUE(named("front", bad).starts_with("phare_rig_test.toml:7: \"channel.name\": ")) << bad;
  }
  for (const char* taken : {"frames", "index.html", "report.json", "drive.csv", "wall_25m.png", "birds_eye_1.png",
                            "visual-0.json", "cockpit.json.tmp7"}) {
    EXPECT_TRUE(named("front", taken).starts_with("phare_rig_test.toml:7: \"channel.name\": ")) << taken;
    EXPECT_EQ(named(taken, "left"), "") << "the first has no folder of its own";
  }
  for (const char* good : {"left", "Kanal 2 (links)", "frames-2", "visual-0", "birds_eye_x.png", "...", "öst"})
    EXPECT_EQ(named("front", good), "") << good;
  EXPECT_NE(named("front", std::string(300, 'a')), "");
}

/// One pair of limits, as --size has.
TEST(Rig, APictureMayBeAsSmallAndLargeAsBySize) {
  const auto of_width = [](const std::string& width_px) {
    return rig_error("fov_horizontal_deg", "width_px = " + width_px + "\nfov_horizontal_deg");
  };
  const auto by_size = [](const std::string& width_px) {
    CLI::App app;
    PictureOptions options;
    options.add_to(app);
    try {
      app.parse("--size " + width_px + "x720");
    } catch (const CLI::ParseError&) {
      return false;
    }
    return true;
  };
  for (const char* width_px : {"16", "63", "8193", "16384"})
    EXPECT_TRUE(of_width(width_px).empty() && by_size(width_px)) << width_px;
  for (const char* width_px : {"15", "16385"})
    EXPECT_FALSE(of_width(width_px).empty() || by_size(width_px)) << width_px;
}

TEST(Rig, AMatrixInOneFileIsASourceForEachEmitter) {
  std::string text = kGoodRig;
  text += "[[design.lamp.source]]\nfunction = \"high\"\nfile = \"matrix.xml\"\nemitters = 3\nyaw_deg = 2\n";
  const auto rig = read_rig(write_rig(text));
  ASSERT_TRUE(rig) << rig.error().text();
  for (const LampConfig& lamp : rig->designs[0].lamps) {
    ASSERT_EQ(lamp.sources.size(), 4u);
    for (std::size_t i = 1; i < 4; ++i) {
      SourceConfig same = lamp.sources[1];
      same.emitter = i;
      EXPECT_EQ(lamp.sources[i], same);
    }
    EXPECT_EQ(lamp.sources[1].function, LampFunction::kHigh);
  }
  EXPECT_EQ(rig_error("yaw_deg = 1", "emitters = 1001"),
            "phare_rig_test.toml:16: \"design.lamp.source.emitters\": 1001 is outside 1 … 1000");
  EXPECT_EQ(rig_error("yaw_deg = 1", "emitter = 2\nemitters = 3"),
            "phare_rig_test.toml:17: \"design.lamp.source.emitters\": stands for emitter 1 and those that follow; "
            "\"emitter\" is one");
  EXPECT_EQ(rig_error("yaw_deg = 1", "pixels = \"a.png\"\nemitters = 3"),
            "phare_rig_test.toml:17: \"design.lamp.source.emitters\": \"pixels\" are of one source");
}

TEST(Rig, MissingFilesAreNamed) {
  const auto rig = read_rig(write_rig(kGoodRig));
  ASSERT_TRUE(rig);
  const Status status = check_rig_files(*rig);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().text().find("scenes/a.glb: no such file; it is the scene of"), std::string::npos);
  EXPECT_EQ(read_rig("/nowhere.toml").error().text(), "/nowhere.toml: no such file");
}

TEST(Rig, TheDemoRigReads) {
  const auto rig = read_rig(source_dir() + "/config/rigs/country_road.toml");
  ASSERT_TRUE(rig) << rig.error().text();
  ASSERT_EQ(rig->designs.size(), 2u);
  EXPECT_EQ(rig->designs[0].name, "halogen");
  EXPECT_EQ(rig->designs[0].lamps.size(), 4u);
  EXPECT_EQ(rig->designs[0].lamps[0].sources.size(), 2u);
}

TEST(LampArgument, GoodAndBad) {
  const auto lamp =
      parse_lamp_argument("/d/low.ies,x=1.5,y=0.6,z=0.65,yaw_deg=2,pitch_deg=-0.5729,roll_deg=1,axis=gamma90,scale=2");
  ASSERT_TRUE(lamp) << lamp.error().text();
  EXPECT_EQ(lamp->position_m, glm::dvec3(1.5, 0.6, 0.65));
  ASSERT_EQ(lamp->sources.size(), 1u);
  EXPECT_EQ(lamp->sources[0].file, "/d/low.ies");
  EXPECT_EQ(lamp->sources[0].axis, GammaAxis::kGamma90);
  EXPECT_DOUBLE_EQ(lamp->sources[0].pitch_rad, -0.5729 * kRadPerDeg);
  EXPECT_EQ(lamp->sources[0].scale, 2.0);

  const auto reason = [](const char* text) {
    const auto bad = parse_lamp_argument(text);
    return bad ? std::string() : bad.error().reason;
  };
  EXPECT_EQ(reason("a.ies,x=1,y=2"), "\"z\" is missing (position in m)");
  EXPECT_EQ(reason("a.ies,x=1,y=2,z=3m"), "\"z\": expected a finite number, got \"3m\"");
  EXPECT_EQ(reason("a.ies,x=1,y=2,z=nan"), "\"z\": expected a finite number, got \"nan\"");
  EXPECT_EQ(reason("a.ies,x=1,y=2,z=3,pitch=1"), "no key \"pitch\"; did you mean \"pitch_deg\"?");
  EXPECT_EQ(reason("a.ies,x=1,x=2"), "\"x\" is given twice");
  EXPECT_EQ(reason("x=1,y=2,z=3"), "the photometry file comes first: FILE,x=…,y=…,z=…");
  EXPECT_EQ(reason("a.ies,x=1,y=2,z=3,axis=up"), "\"axis\": \"up\" is none of gamma0, gamma90");
  EXPECT_EQ(reason("a.ies,x=1,y=2,z=3,pitch_deg=91"), "\"pitch_deg\": 91 is outside -90 to 90");
  EXPECT_EQ(reason("a.ies,x=1,y=2,z=3,scale=-1"), "\"scale\": -1 is outside 0 to 1e+06");
  EXPECT_EQ(reason("a.ies,x=1,y=2,z=3,lamp_set=1.5"), "\"lamp_set\" counts from 1");
}

// The same keys as a source in a rig, each of them kept.
TEST(LampArgument, EveryKeyOfASource) {
  const auto lamp = parse_lamp_argument(
      "/d/a.ldt,x=1,y=2,z=3,axis=gamma90,c0_deg=90,mirror=1,lamp_set=2,emitter=3,distance_m=25,scale=0.5");
  ASSERT_TRUE(lamp) << lamp.error().text();
  const SourceConfig& source = lamp->sources.front();
  EXPECT_EQ(source.c0_turn_deg, 90.0);
  EXPECT_TRUE(source.mirror);
  EXPECT_EQ(source.lamp_set, 2u);
  EXPECT_EQ(source.emitter, 3u);
  EXPECT_EQ(source.distance_m, 25.0);
  EXPECT_EQ(source.scale, 0.5);
}

TEST(Rig, NamesAndFilesSaySomething) {
  EXPECT_EQ(rig_error("\"generated/scenes/a.glb\"", "\"\""), "phare_rig_test.toml:1: \"scene\": is empty");
  EXPECT_EQ(rig_error("\"../car.toml\"", "\"\""), "phare_rig_test.toml:2: \"vehicle\": is empty");
  EXPECT_EQ(rig_error("\"/etc/cockpit.toml\"", "\"\""), "phare_rig_test.toml:3: \"cockpit\": is empty");
  EXPECT_EQ(rig_error("\"one\"", "\"\""), "phare_rig_test.toml:7: \"design.name\": is empty");
  EXPECT_EQ(rig_error("\"head\"", "\"\""), "phare_rig_test.toml:9: \"design.lamp.name\": is empty");
  EXPECT_EQ(rig_error("\"generated/lamps/l.ies\"", "\"\""),
            "phare_rig_test.toml:14: \"design.lamp.source.file\": is empty");
}

TEST(LampArgument, FileNamesWithCommasQuotesAndEqualsSigns) {
  const auto file = [](const std::string& text) {
    const auto lamp = parse_lamp_argument(text);
    return lamp ? lamp->sources.front().file.string() : lamp.error().reason;
  };
  EXPECT_EQ(file("/d/low, left.ies,x=1,y=2,z=3"), "/d/low, left.ies");
  EXPECT_EQ(file("/d/a=b, c d.ies,x=1,y=2,z=3"), "/d/a=b, c d.ies");
  EXPECT_EQ(file("/d/5,5 k=lm.ies,x=1,y=2,z=3"), "/d/5,5 k=lm.ies") << "a space is in no key";
  EXPECT_EQ(file("\"/d/a,x=1.ies\",x=1,y=2,z=3"), "/d/a,x=1.ies");
  EXPECT_EQ(file("\"/d/7\"\" lamp.ies\",x=1,y=2,z=3"), "/d/7\" lamp.ies");
  const std::string unfinished = "a file name in double quotes ends with a quote, and a comma or nothing follows";
  EXPECT_EQ(file("\"/d/a.ies,x=1,y=2,z=3"), unfinished);
  EXPECT_EQ(file("\"/d/a\".ies,x=1,y=2,z=3"), unfinished);
  EXPECT_EQ(file("\"\",x=1,y=2,z=3"), "expected FILE,x=…,y=…,z=…");
}

}  // namespace
}  // namespace phare
