// unit: rigs written and read back, their page in docs/ held against the reader, and rigs that are moved.
#include "config/rig_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "config/spectrum.h"
#include "config/traffic/road_users.h"
#include "tests/paths.h"
#include "tools/lamp_design.h"
#include "tools/portable_rig.h"
#include "tools/rig_check.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class RigFolder : public testing::Test {
 protected:
  RigFolder() : folder_(fs::path(testing::TempDir()) / ("phare_rig_writer_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~RigFolder() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  fs::path folder_;
};
using RigWriter = RigFolder;
using RigPage = RigFolder;
using RigCheck = RigFolder;
using Portable = RigFolder;

Rig demo_rig(const std::string& name) {
  auto rig = read_rig(source_dir() + "/config/rigs/" + name);
  EXPECT_TRUE(rig.ok()) << (rig ? "" : rig.error().text());
  return *rig;
}

TEST_F(RigWriter, WhatIsWrittenReadsBackTheSame) {
  for (const char* name : {"country_road.toml", "matrix.toml", "town.toml"}) {
    Rig rig = demo_rig(name);
    if (rig.name == "Country road") {  // everything a rig may say
      ASSERT_TRUE(
          put_lamp_design(rig, {.low = {lamps_dir() + "/led_low_rht.ies,yaw_deg=0.1,roll_deg=-3,scale=0.3"}}).ok());
      rig.name = "quotes \" and \\ and\ttabs, ünïcode";
      rig.key_file = write("bus.key", std::string(64, 'a'));
      fs::permissions(rig.key_file, fs::perms::owner_read | fs::perms::owner_write);
      rig.bus_key.emplace().fill(0xaa);
      rig.frame_rate_hz = 50;
      rig.moon = MoonConfig{0.1234567, 0.3, 0.21};
      rig.real_time_priority = rig.high_keeps_low = false;
      rig.dynamics_level = "full";
      rig.dynamics_step_s = 1.0 / 3000.0;
      rig.beam_image = ImageLevel::kHalfNodes;
      for (const char* set :
           {"adaptation_k 4321.5", "camera chase", "isolux_lx 0.1 2 33", "exposure_per_cdm2 0.7", "design 1",
            "lines off", "visibility_m 120.5", "probes car 25 0 0.01; world 1 2 3 0.6 0 -0.8"})
        ASSERT_TRUE(apply(rig.desk, desk_command(set), {.designs = rig.designs.size()})) << set;
      rig.channels.push_back({"left", 640, 480, 0.7, {1.0, 2.0, 3.0}, 0.1234567, -0.3, {"0.0.0.0", "10.0.0.3"}});
      rig.places = {{"10.0.0.1", ""}, {"", "10.0.0.2"}, {}, {"0.0.0.0", "10.0.0.1"}};
      SourceConfig& source = rig.designs[1].lamps[0].sources[0];
      source.axis = GammaAxis::kGamma90;
      source.c0_turn_deg = 90.0;
      source.mirror = true;
      source.lamp_set = 2;
      source.emitter = 3;
      source.distance_m = 25.0;
      source.pixels = folder_ / "pixels.png";
      source.pixel_map = folder_ / "lens.csv";
      source.chromaticity_xy = glm::dvec2{0.3127, 0.329};
      source.colour_temperature_k = SourceConfig{}.colour_temperature_k;
      SourceConfig& by_spectrum = rig.designs[2].lamps[0].sources[0];
      by_spectrum.spectrum = write("led.csv", "wavelength_nm,power\n450,1\n455,2\n460,1\n");
      by_spectrum.chromaticity_xy = read_spectrum_xy(by_spectrum.spectrum).value();
      by_spectrum.colour_temperature_k = SourceConfig{}.colour_temperature_k;
      rig.designs[2].lamps[0].aim = {AimConfig::Kind::kTurned, -0.01};
    }
    rig.file = folder_ / "copy.toml";
    for (const bool comments : {true, false}) {
      RigWords words;
      words.path = paths_from(folder_);
      words.heading = "A copy.";
      words.comments = comments;
      write("copy.toml", rig_text(rig, words));
      const auto read = read_rig(rig.file);
      ASSERT_TRUE(read) << read.error().text() << "\n" << text_of(rig.file);
      EXPECT_TRUE(*read == rig) << text_of(rig.file);
    }
  }
}

TEST_F(RigWriter, PairsAndDegreesStayAsAPersonWroteThem) {
  RigWords words;
  words.path = paths_from(folder_);
  const std::string text = rig_text(demo_rig("country_road.toml"), words);
  EXPECT_NE(text.find("pair = true"), std::string::npos);
  EXPECT_EQ(text.find("headlamp left"), std::string::npos);
  EXPECT_NE(text.find("pitch_deg = -0.573\n"), std::string::npos) << text;
  EXPECT_NE(text.find("fov_horizontal_deg = 70\n"), std::string::npos) << text;
  EXPECT_NE(text.find("file = \"generated/lamps/low_rht.ies\""), std::string::npos);
}

TEST_F(RigWriter, PathsBelowBesideAndFarAway) {
  const PathWords near = paths_from("/home/me/rigs"), also_up = paths_from("/home/me/rigs", true);
  EXPECT_EQ(near("/home/me/rigs/lamps/a.ies"), "lamps/a.ies");
  EXPECT_EQ(near("/home/me/lamps/a.ies"), "/home/me/lamps/a.ies");
  EXPECT_EQ(also_up("/home/me/lamps/a.ies"), "../lamps/a.ies");
  EXPECT_EQ(also_up("/data/a.ies"), "/data/a.ies");
  EXPECT_EQ(near("/home/me/rigs/generated/a.ies"), "/home/me/rigs/generated/a.ies") << "not the build's";
  EXPECT_EQ(also_up(source_dir() + "/config/vehicles/hatchback.toml"),
            source_dir() + "/config/vehicles/hatchback.toml");
}

// ---- the page

struct PageKey {
  std::string key, unit, fallback;
};
std::vector<PageKey> keys_of_page() {
  std::vector<PageKey> keys;
  std::ifstream stream(source_dir() + "/docs/rig-file.md");
  const std::regex row("^\\| `([a-z0-9_.]+)` \\| ([^|]*) \\| ([^|]*) \\|.*");
  for (std::string line; std::getline(stream, line);) {
    std::smatch cells;
    if (std::regex_match(line, cells, row)) keys.push_back({cells[1], cells[2], cells[3]});
  }
  return keys;
}
std::string example_of_page() {
  const std::string page = text_of(source_dir() + "/docs/rig-file.md");
  const std::size_t begin = page.find("```toml\n");
  return begin == std::string::npos ? "" : page.substr(begin + 8, page.find("\n```", begin) - begin - 7);
}

TEST_F(RigPage, NamesEveryKeyThatTheReaderKnowsAndNoOther) {
  const auto reading = read_rig_whole(write("example.toml", example_of_page()));
  ASSERT_TRUE(reading) << reading.error().text();
  ASSERT_TRUE(reading->problems.empty()) << reading->problems.front().text();
  std::set<std::string> known(reading->known_keys.begin(), reading->known_keys.end()), page;
  for (const PageKey& key : keys_of_page()) EXPECT_TRUE(page.insert(key.key).second) << key.key << " stands twice";
  for (const std::string& key : known) EXPECT_TRUE(page.contains(key)) << key << " is missing in docs/rig-file.md";
  for (const std::string& key : page) EXPECT_TRUE(known.contains(key)) << key << " is unknown to the reader";
}

// The example holds every key that has a default, with it; without those lines the rig is the same.
TEST_F(RigPage, DefaultsAreWhatTheReaderTakes) {
  const auto whole = read_rig(write("my.toml", example_of_page()));
  ASSERT_TRUE(whole) << whole.error().text();
  fs::create_directories(folder_ / "bare");
  std::string bare;
  std::istringstream lines(example_of_page());
  const std::set<std::string> required{"scene",       "vehicle",    "cockpit",
                                       "[[channel]]", "[[design]]", "[[design.lamp]]",
                                       "position_m",  "function",   "[[design.lamp.source]]"};
  std::string table;
  for (std::string line; std::getline(lines, line);) {
    const std::string word = line.substr(0, line.find(' '));
    if (word.starts_with('[')) table = word;
    const bool name = word == "name" && table.starts_with("[[design");
    const bool file = word == "file";
    if (required.contains(word) || name || file) bare += line + "\n";
  }
  const auto few = read_rig(write("bare/my.toml", bare));
  ASSERT_TRUE(few) << few.error().text() << "\n" << bare;
  Rig expected = *whole;
  expected.file = few->file;  // elsewhere, and its relative paths with it
  expected.vehicle_file = few->vehicle_file;
  expected.cockpit_file = few->cockpit_file;
  EXPECT_TRUE(*few == expected);
  // In the table, the default of every such key is what the example gives.
  std::map<std::string, std::string> given;
  table.clear();
  std::istringstream again(example_of_page());
  for (std::string line; std::getline(again, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with('[')) {
      table = line;
      std::erase_if(table, [](char c) { return c == '[' || c == ']'; });
      table += ".";
    } else if (equals != std::string::npos) {
      given[table + line.substr(0, equals)] = line.substr(equals + 3);
    }
  }
  for (const PageKey& key : keys_of_page()) {
    if (key.fallback.empty() || key.fallback == "none" || key.fallback == "the file's name") continue;
    ASSERT_TRUE(given.contains(key.key)) << key.key << " has a default and is not in the example";
    const std::string fallback = key.fallback.substr(0, key.fallback.find(", …"));
    const std::string value = given[key.key];
    const bool number = std::regex_match(value, std::regex("-?[0-9.]+"));
    EXPECT_TRUE(number ? std::stod(value) == std::stod(fallback) : value == fallback) << key.key << " = " << value;
  }
}

// ---- check

TEST_F(RigCheck, OurRigsAreGood) {
  for (const char* name : {"country_road.toml", "matrix.toml"}) {
    const RigFindings found = check_rig(source_dir() + "/config/rigs/" + name);
    EXPECT_TRUE(found.problems.empty()) << found.problems.front().text();
    for (const std::string& warning : found.warnings)
      EXPECT_EQ(warning.find("the cut-off stands at"), std::string::npos) << warning;
  }
}

TEST_F(RigCheck, LampsForBothSidesOfTheRoadAreNoPair) {
  const auto design = [](const std::string& name, const std::string& left, const std::string& right) {
    const auto lamp = [](const std::string& side, const char* y, const std::string& file) {
      return "[[design.lamp]]\nname = \"" + side + "\"\nposition_m = [3, " + y +
             ", 0.66]\naim = \"cut-off\"\nsource = [ { function = \"low\", file = \"" + lamps_dir() + "/" + file +
             "\" } ]\n";
    };
    return "[[design]]\nname = \"" + name + "\"\n" + lamp("left", "0.6", left) + lamp("right", "-0.6", right);
  };
  const fs::path rig =
      write("sides.toml", design("mixed", "low_lht.ies", "low_rht.ies") + design("pair", "low_rht.ies", "low_rht.ies") +
                              design("fog", "low_rht.ies", "fog.ies"));
  std::string warnings;
  for (const std::string& warning : check_rig(rig).warnings) warnings += warning + "\n";
  EXPECT_NE(warnings.find("design \"mixed\": the low beam of right is for right-hand traffic, that of left for "
                          "left-hand traffic"),
            std::string::npos)
      << warnings;
  EXPECT_EQ(warnings.find("design \"pair\": the low beam"), std::string::npos) << warnings;
  EXPECT_EQ(warnings.find("design \"fog\": the low beam"), std::string::npos)
      << "a flat one tells no side: " << warnings;
}

TEST_F(RigCheck, TellsEveryProblemAtOnce) {
  write("car.toml", "mass_kg = -1\n");
  write("bad.ies", "nonsense\n");
  write("others.toml", "[[road_user]]\nclass = \"kar\"\n");
  const fs::path rig = write("rig.toml", R"(scene = "no.glb"
vehicle = "car.toml"
cockpit = "no.toml"
traffic = "others.toml"
speed = 3
[[channel]]
fov_horizontal_deg = 400
[[design]]
name = "a"
[[design.lamp]]
name = "h"
position_m = [3, 0.6, 1.4]
source = [ { function = "low", file = "bad.ies" }, { function = "lwo", file = ")" +
                                             lamps_dir() +
                                             R"(/low_rht.ies" } ]
[[design]]
name = "steep"
[[design.lamp]]
name = "h"
position_m = [3, 0.6, 0.6]
aim = -3
source = [ { function = "low", file = ")" + lamps_dir() +
                                             R"(/low_rht.ies" } ]
[[design]]
name = "no low"
[[design.lamp]]
name = "h"
position_m = [3, 0.6, 0.6]
source = [ { function = "high", file = "absent.ies" } ]
)");
  const RigFindings found = check_rig(rig);
  std::string problems, warnings;
  for (const Error& error : found.problems) problems += error.text() + "\n";
  for (const std::string& warning : found.warnings) warnings += warning + "\n";
  for (const char* part :
       {"rig.toml:5: no key \"speed\"", "400 is outside 1 … 170", "\"lwo\" is none of",
        "no.glb: no such file; it is the scene", "no.toml: no such file; it is the cockpit", "car.toml:", "bad.ies",
        "others.toml:", "absent.ies: no such file; it is lamp \"h\", design \"no low\""})
    EXPECT_NE(problems.find(part), std::string::npos) << part << " is missing in\n" << problems;
  EXPECT_NE(warnings.find("design \"steep\", h: the cut-off stands at -3.0"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("design \"no low\" has no low beam"), std::string::npos) << warnings;
  const nlohmann::json json = as_json(found, rig);
  EXPECT_FALSE(json["good"]);
  EXPECT_EQ(json["problems"].size(), found.problems.size());
}

// ---- moved

TEST_F(Portable, EverythingNamedGoesAlongAndReadsAfterTheMove) {
  const fs::path home = folder_ / "home", away = folder_ / "away";
  fs::create_directories(home / "lamps");
  fs::create_directories(home / "other");
  for (const char* name : {"lamps/a.ies", "other/a.ies"})
    fs::copy_file(lamps_dir() + (name[0] == 'l' ? "/low_rht.ies" : "/led_low_rht.ies"), home / name);
  std::ofstream(home / "cockpit.toml") << "[source]\nkind = \"log\"\ndbc = \"" << cockpits_dir()
                                       << "/phare_stalk.dbc\"\n# \"a remark\"\n";
  Rig rig = demo_rig("country_road.toml");
  ASSERT_TRUE(put_lamp_design(rig, {.low = {"left=" + (home / "lamps/a.ies").string() +
                                            ",right=" + (home / "other/a.ies").string()}})
                  .ok());
  rig.cockpit_file = home / "cockpit.toml";
  rig.traffic_file = home / "others.toml";
  std::ofstream(rig.traffic_file) << "[[road_user]]\nlow_beam = \"other/a.ies\"\ntail_lamp = \"other/a.ies\"\n"
                                  << "brake_lamp = \"lamps/a.ies\"\nthird_brake_lamp = { file = \"lamps/a.ies\" }\n"
                                  << "high_beam = { spectrum = \"other/led.csv\" }\npath = \"lead.csv\"\n";
  std::ofstream(home / "lead.csv") << "time_s,s_m,offset_m\n0,50,0\n2,90,0\n";
  SourceConfig& by_spectrum = rig.designs[0].lamps[0].sources[0];
  by_spectrum.spectrum = home / "other/led.csv";
  std::ofstream(by_spectrum.spectrum) << "wavelength_nm,power\n450,1\n455,2\n460,1\n";
  fs::create_directories(away);
  PortableFiles files(away / "my_files");
  const Status copied = files.copy(rig);
  ASSERT_TRUE(copied) << copied.error().text();
  EXPECT_FALSE(files.copy(rig)) << "the folder is there";
  RigWords words;
  words.path = [&](const fs::path& file) { return files.word(file); };
  std::ofstream(away / "my.toml") << rig_text(rig, words);
  fs::rename(away, folder_ / "moved");
  fs::remove_all(home);

  const auto moved = read_rig(folder_ / "moved/my.toml");
  ASSERT_TRUE(moved) << moved.error().text();
  const std::string base = (folder_ / "moved/").string();
  for (const fs::path& file : {moved->scene_file, moved->vehicle_file, moved->cockpit_file}) {
    EXPECT_TRUE(file.string().starts_with(base)) << file;
    EXPECT_TRUE(fs::exists(file)) << file;
  }
  EXPECT_TRUE(fs::exists(moved->scene_file.parent_path() / (moved->scene_file.stem().string() + "_lane.csv")));
  EXPECT_TRUE(fs::exists(moved->cockpit_file.parent_path() / "phare_stalk.dbc"));
  EXPECT_NE(text_of(moved->cockpit_file).find("dbc = \"phare_stalk.dbc\"\n# \"a remark\"\n"), std::string::npos)
      << text_of(moved->cockpit_file);
  EXPECT_EQ(text_of(moved->designs[0].lamps[0].sources[0].file), text_of(lamps_dir() + "/low_rht.ies"));
  EXPECT_TRUE(moved->designs[0].lamps[0].sources[0].spectrum.string().starts_with(base));
  ASSERT_TRUE(moved->designs[0].lamps[0].sources[0].chromaticity_xy);
  EXPECT_LT(moved->designs[0].lamps[0].sources[0].chromaticity_xy->y, 0.05) << "as blue as its spectrum";
  EXPECT_EQ(text_of(moved->designs[0].lamps[1].sources[0].file), text_of(lamps_dir() + "/led_low_rht.ies"));
  const auto others = read_road_users(moved->traffic_file);
  ASSERT_TRUE(others) << others.error().text();
  for (const fs::path& file :
       {others->front().low_beam.file, others->front().tail_lamp.file, others->front().brake_lamp.file,
        others->front().third_brake_lamp.file, others->front().high_beam.colour.spectrum})
    EXPECT_TRUE(file.string().starts_with(base)) << file;
  ASSERT_TRUE(others->front().path) << "its recorded way went along";
  EXPECT_EQ(others->front().path->to_s(), 2.0);
  for (const DesignConfig& design : moved->designs)
    for (const LampConfig& lamp : design.lamps)
      for (const SourceConfig& source : lamp.sources)
        EXPECT_TRUE(source.file.string().starts_with(base)) << source.file;
  const RigFindings found = check_rig(folder_ / "moved/my.toml");
  EXPECT_TRUE(found.problems.empty()) << found.problems.front().text();
}

TEST_F(Portable, ASceneOfOthersIsCopiedWithWhatLiesBesideItAndItsNotesAreTold) {
  const fs::path home = folder_ / "scene of others";
  fs::create_directories(home);
  std::ofstream(home / "my bark.png") << "no picture";
  std::ofstream(home / "street lamp.ies") << "no photometry";
  std::ofstream(home / "yard.gltf")
      << R"({"asset": {"version": "2.0"}, "extensionsUsed": ["XYZ_curves"], "images": [{"uri": "my%20bark.png"}],
           "textures": [{"source": 0}],
           "materials": [{"name": "bark", "normalTexture": {"index": 0}}],
           "extensions": {"EXT_lights_ies": {"lights": [{"uri": "street%20lamp.ies"}]}}})";
  Rig rig = demo_rig("country_road.toml");
  rig.scene_file = home / "yard.gltf";
  PortableFiles files(folder_ / "taken");
  const Status copied = files.copy(rig);
  ASSERT_TRUE(copied) << copied.error().text();
  for (const char* name : {"yard.gltf", "my bark.png", "street lamp.ies"})
    EXPECT_TRUE(fs::is_regular_file(folder_ / "taken/scene" / name)) << name;

  RigWords words;
  words.path = [](const fs::path& file) { return file.string(); };
  std::ofstream(folder_ / "others.toml") << rig_text(rig, words);
  const RigFindings found = check_rig(folder_ / "others.toml");
  std::string notes;
  for (const std::string& note : found.notes) notes += note + "\n";
  EXPECT_NE(notes.find("yard.gltf: extensions that are not read: XYZ_curves"), std::string::npos) << notes;
  EXPECT_NE(notes.find("my bark.png: is no PNG or JPEG"), std::string::npos) << notes;
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_NE(found.problems[0].text().find("street lamp.ies"), std::string::npos) << found.problems[0].text();
}

}  // namespace
}  // namespace phare
