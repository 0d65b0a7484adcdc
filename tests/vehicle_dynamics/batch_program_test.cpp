// phare-dynamics --batch as a program: files, options, messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <tuple>

#include "batch_files.h"
#include "tests/paths.h"

namespace phare {
namespace {

using test::content;
using test::kBraking;
using test::program;
using test::written;

TEST(BatchProgram, RunsAndRefuses) {
  const std::string in = written("program_in.csv", kBraking), out = testing::TempDir() + "program_out.csv";
  const std::string car = std::string(vehicles_dir()) + "/bmw_320i.toml";
  const std::string base = "--batch " + in + " --out " + out + " --vehicle " + car + " --speed-mps 20";
  EXPECT_EQ(program(base + " --level full --integrator rk4 --step-s 0.002 --levelling dynamic"), 0);
  std::ifstream file(out);
  std::string header, line, last;
  std::getline(file, header);
  EXPECT_EQ(header.rfind("time_s,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,", 0), 0u);
  EXPECT_NE(header.find("cutoff_25m_m"), std::string::npos);
  int rows = 0;
  while (std::getline(file, line)) ++rows, last = line;
  EXPECT_EQ(rows, 251);
  EXPECT_EQ(std::count(last.begin(), last.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_EQ(program(base + " --level best"), 2);
  EXPECT_EQ(program(base + " --level pose"), 2);
  EXPECT_EQ(program(base + " --integrator magic"), 2);
  EXPECT_EQ(program(base + " --step-s 0"), 2);
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + car + " --speed-mps nan"), 2);
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + car + " --speed-mps inf"), 2);
  EXPECT_EQ(program(base + " --road /nonexistent.glb"), 2);
  EXPECT_EQ(program(base + " --roughness F"), 2);
  EXPECT_EQ(program("--batch " + in + " --vehicle " + car), 2);
  EXPECT_EQ(program("--batch /nonexistent.csv --out " + out + " --vehicle " + car), 2);
  std::stringstream text;
  text << std::ifstream(car).rdbuf();
  std::string heavy = text.str();
  heavy.replace(heavy.find("mass_kg = 1093.2952"), 19, "mass_kg = -1093.295");
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + written("bad_car.toml", heavy)), 2);
  std::string wrong_unit = text.str();
  wrong_unit.replace(wrong_unit.find("front_rate_npm = 24453"), 22, "front_rate_npm = 24.45");
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + written("bad_car.toml", wrong_unit)), 2);
}

// Nothing that was there is lost: not the inputs, under whatever name, nor an earlier result when a run fails.
TEST(BatchProgram, KeepsWhatWasThere) {
  namespace fs = std::filesystem;
  const std::string folder = testing::TempDir() + "keeps/";
  fs::remove_all(folder), fs::create_directories(folder);
  const std::string in = written("keeps/in.csv", kBraking), car = folder + "car.toml", out = folder + "out.csv";
  fs::copy_file(std::string(vehicles_dir()) + "/bmw_320i.toml", car);
  fs::create_symlink(in, folder + "link.csv"), fs::create_hard_link(in, folder + "hard.csv");
  const std::string road = written("keeps/road.csv", "x_m,z_m\n0,0\n1000,0\n"), car_text = content(car);
  const std::string base = "--batch " + in + " --vehicle " + car + " --road " + road + " --speed-mps 20 --out ";
  for (const char* name : {"in.csv", "link.csv", "hard.csv", "car.toml", "road.csv"}) {
    std::string said;
    EXPECT_EQ(program(base + folder + name, &said), 2) << name;
    EXPECT_NE(said.find("would be overwritten"), std::string::npos) << said;
  }
  EXPECT_EQ(content(in), kBraking);
  EXPECT_EQ(content(car), car_text);
  const auto files = [&] { return std::distance(fs::directory_iterator(folder), fs::directory_iterator{}); };
  const auto before = files();
  EXPECT_EQ(program(base + out + " --step-s 0.1"), 2);
  EXPECT_EQ(files(), before);  // no output, nothing beside it
  ASSERT_EQ(program(base + out), 0);
  const std::string result = content(out);
  std::string said;
  EXPECT_EQ(program(base + out + " --step-s 0.1", &said), 2);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_EQ(content(out), result);
  EXPECT_EQ(files(), before + 1);
  EXPECT_EQ(program(base + "/dev/full"), 2);
  const std::string shell = std::string(phare::program("phare-dynamics")) + " " + base;
  ASSERT_EQ(std::system((shell + "/dev/stdout 2>/dev/null >" + folder + "streamed.csv").c_str()), 0);
  EXPECT_EQ(content(folder + "streamed.csv"), result);  // no summary among the rows
  ASSERT_EQ(std::system(("cat " + in + " | " + phare::program("phare-dynamics") + " --batch /dev/stdin --vehicle " +
                         car + " --road " + road + " --speed-mps 20 --out - 2>/dev/null | cmp - " + out)
                            .c_str()),
            0);
}

// A page beside or instead of the rows; a reference is another run, ours too, and then nothing is between them.
TEST(BatchProgram, DrawsAPage) {
  const std::string in = written("page_in.csv", kBraking), out = testing::TempDir() + "page_out.csv",
                    page = testing::TempDir() + "page.html";
  const std::string base = "--batch " + in + " --vehicle " + vehicles_dir() + "/bmw_320i.toml --speed-mps 20 ";
  std::filesystem::remove(page);
  ASSERT_EQ(program(base + "--out " + out + " --columns slip"), 0);
  ASSERT_EQ(program(base + "--plot " + page + " --reference " + out + " --columns slip"), 0);
  const std::string html = content(page);
  for (const char* part : {"Speed, km/h", "Slip along, %", "Pedals, %", "Against page_out.csv", "0.00 %", "BMW 320i"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("Lamps by levelling"), std::string::npos);  // nothing levels them
  for (const auto& [options, says] : {std::pair{"--out " + out + " --reference " + in, "--plot FILE.html"},
                                      {"--out " + out + " --plot " + out, "would be overwritten"},
                                      {"--plot " + in, "would be overwritten"},
                                      {"--plot " + page + " --reference " + written("page_bad.csv", "t,other\n0,1\n"),
                                       "has no column that a page shows"},
                                      {"--plot " + page + " --reference /nonexistent.csv", "nonexistent"},
                                      {"--plot /nonexistent/page.html", "nonexistent"}}) {
    std::string said;
    EXPECT_EQ(program(base + options, &said), 2) << options;
    EXPECT_NE(said.find(says), std::string::npos) << said;
  }
  EXPECT_EQ(content(page), html);
  EXPECT_EQ(content(in), kBraking);
}

TEST(BatchProgram, AutoWhereItCanLook) {
  const std::string out = testing::TempDir() + "auto_out.csv";
  const std::string base =
      std::string("--level auto --out ") + out + " --vehicle " + vehicles_dir() + "/bmw_320i.toml ";
  EXPECT_EQ(program(base + "--speed-mps 20 --columns level --batch " + written("auto_in.csv", kBraking)), 0);
  EXPECT_NE(content(out).find(",level\n"), std::string::npos);
  const std::string torques =
      written("auto_torques.csv",
              "time_s,steer_rad,torque_fl_nm,torque_fr_nm,torque_rl_nm,torque_rr_nm\n0,0,0,0,0,0\n1,0,0,0,0,0\n");
  EXPECT_EQ(program(base + "--batch " + torques), 2);
  EXPECT_EQ(program(base + "--integrator rk4 --batch " + written("auto_in.csv", kBraking)), 2);
  EXPECT_EQ(program(base + "--columns energy --batch " + written("auto_in.csv", kBraking)), 2);
}

TEST(BatchProgram, RefusesOptionsThatMeanNothing) {
  const std::string in = written("means_in.csv", kBraking), out = testing::TempDir() + "means_out.csv";
  const std::string base =
      "--batch " + in + " --out " + out + " --vehicle " + vehicles_dir() + "/bmw_320i.toml --speed-mps 20 ";
  std::filesystem::remove(out);
  for (const char* option : {"--lockstep",
                             "--rig x.toml",
                             "--drive x.pcap",
                             "--stats x.json",
                             "--port-base 5000",
                             "--compare x",
                             "--work-precision",
                             "--tyre linear",
                             "--tyre magic",
                             "--attitude quasi-static",
                             "--level kinematic --tyre linear",
                             "--level kinematic --integrator rk4",
                             "--level kinematic --friction 0.5",
                             "--level kinematic --relaxation-scale 2",
                             "--seed 1",
                             "--roughness A --seed -1",
                             "--roughness A --seed 1.5",
                             "--roughness A --seed 18446744073709551616",
                             "--envelope-m 0.2",
                             "--roughness A --envelope-m 0.2",
                             "--levelling manual",
                             "--level single-track --attitude quasi-static --integrator reference"}) {
    std::string said;
    EXPECT_EQ(program(base + option, &said), 2) << option;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_FALSE(std::filesystem::exists(out)) << option;
  }
  for (const char* option : {"--level single-track --tyre linear", "--roughness A --seed 18446744073709551615"})
    EXPECT_EQ(program(base + option), 0) << option;
  EXPECT_EQ(program("--rig x.toml --step-s 0.001"), 2);
  EXPECT_EQ(program("--work-precision --output-hz 10 --vehicle x.toml"), 2);
  const std::string manoeuvre = "--manoeuvre iso7401 --vehicle " + std::string(vehicles_dir()) + "/bmw_320i.toml ";
  for (const auto& [options, says] : {std::pair{"--output-hz 50 --out " + out, "100 rows a second or more"},
                                      {"--output-hz 200", "--output-hz: is of the rows that are written"},
                                      {"--columns slip", "--columns: is of the rows that are written"}}) {
    std::string said;
    EXPECT_EQ(program(manoeuvre + options, &said), 2) << options;
    EXPECT_NE(said.find(says), std::string::npos) << said;
  }
}

TEST(BatchProgram, SaysWhatItMeans) {
  const std::string car = std::string(vehicles_dir()) + "/bmw_320i.toml", out = testing::TempDir() + "says_out.csv";
  const std::string in = written("says_in.csv", kBraking);
  std::string said;
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + car + " --road " + car, &said), 2);
  EXPECT_NE(said.find("a scene (.glb, .gltf) or a height profile (.csv)"), std::string::npos) << said;
  const std::string escaping =
      written("says_esc.csv", "time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,0,0.1\x1b[31m\xc2\x9b,0\n");
  EXPECT_EQ(program("--batch " + escaping + " --out " + out + " --vehicle " + car, &said), 2);
  EXPECT_NE(said.find("0.1\\x1b[31m"), std::string::npos) << said;
  EXPECT_EQ(said.find('\x1b'), std::string::npos);
  EXPECT_EQ(said.find('\x9b'), std::string::npos);
  const std::string unlit = std::string(vehicles_dir()) + "/bmw_m8.toml";
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + unlit, &said), 0);
  EXPECT_NE(said.find("no table [levelling]"), std::string::npos) << said;
  EXPECT_EQ(content(out).find("cutoff"), std::string::npos);
}

// In a live run, too, there must be lamps to level.
TEST(BatchProgram, LiveLevellingNeedsLamps) {
  const std::string rig = written(
      "unlit_rig.toml", std::string("name = \"test\"\nscene = \"scene.gltf\"\nvehicle = \"") + vehicles_dir() +
                            "/bmw_m8.toml\"\ncockpit = \"none.toml\"\n[dynamics]\nlevel = \"kinematic\"\n"
                            "[[channel]]\nname = \"front\"\n[[design]]\nname = \"a\"\n[[design.lamp]]\nname = \"l\"\n"
                            "pair = true\nposition_m = [3.4, 0.6, 0.6]\n[[design.lamp.source]]\nfunction = \"low\"\n"
                            "file = \"l.ies\"\n");
  std::string said;
  EXPECT_EQ(program("--rig " + rig + " --levelling dynamic", &said), 2);
  EXPECT_NE(said.find("bmw_m8.toml: has no table [levelling]"), std::string::npos) << said;
}

// Without --integrator a level runs by the method of real time.
TEST(BatchProgram, RunsAsRealTimeDoes) {
  const std::string in = written("default_in.csv", kBraking), out = testing::TempDir() + "default_out.csv";
  const std::string base =
      "--batch " + in + " --out " + out + " --vehicle " + vehicles_dir() + "/bmw_320i.toml --speed-mps 20 --level ";
  for (const auto& [level, method, other] :
       {std::tuple{"full", "rk4", "etd2"}, std::tuple{"single-track", "etd2", "rk4"}}) {
    std::array<std::string, 3> results;
    for (const std::string& options :
         {std::string(), std::string(" --integrator ") + method, std::string(" --integrator ") + other}) {
      ASSERT_EQ(program(base + level + options), 0);
      results[options.empty() ? 0 : options.ends_with(method) ? 1 : 2] = content(out);
    }
    EXPECT_EQ(results[0], results[1]) << level;
    EXPECT_NE(results[0], results[2]) << level;
  }
}

}  // namespace
}  // namespace phare
