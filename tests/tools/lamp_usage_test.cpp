// process: what every `phare lamp` command owes: --json, names that are no UTF-8, numbers that are none, clear
// refusals.
#include <cmath>
#include <nlohmann/json.hpp>

#include "lamp_program.h"

namespace phare {
namespace {

using LampUsage = test::LampProgram;

TEST_F(LampUsage, EveryCommandHasJson) {
  const std::string low = ours("low_rht.ies"), at = file("at.csv", "h_deg,v_deg\n0,-1\n");
  for (const std::string& command :
       {"info " + low, "table " + low + " --at " + at, "check " + low + " --rule r149-passing-c",
        std::string("check --list"), "plot " + low + " --out " + in("p"),
        "compare " + low + " " + low + " --out " + in("c"), "convert " + low + " --out " + in("x.csv"),
        "hspr " + low + " " + low, "levels " + low}) {
    const Said said = lamp(command + " --json");
    EXPECT_EQ(said.code, 0) << command << "\n" << said.err;
    EXPECT_FALSE(nlohmann::json::parse(said.out, nullptr, false).is_discarded()) << command << "\n" << said.out;
  }
  // Beside the JSON the table goes where it was asked to.
  EXPECT_EQ(lamp("table " + low + " --at " + at + " --json --out " + in("t.csv")).code, 0);
  EXPECT_TRUE(test::content_of(in("t.csv")).starts_with("h_deg,v_deg,intensity_cd\n"));
}

// H and V are azimuth and elevation whatever the file's own angles: type A has them, of type C they are turned.
TEST_F(LampUsage, IntensityAtHAndV) {
  const std::string of_c = in("c.ldt");
  ASSERT_EQ(lamp("convert " + ours("low_rht.ies") + " --out " + of_c).code, 0);
  const auto at = [&](const std::string& what) { return lamp("table " + ours("low_rht.ies") + what).out; };
  EXPECT_EQ(at(" --hv -3.5,0.5 1,-1"), at(" --at " + file("two.csv", "h_deg,v_deg\n-3.5,0.5\n1,-1\n")));
  const auto cd = [&](const std::string& lamp_file, const char* hv) {
    const auto said = nlohmann::json::parse(lamp("table " + lamp_file + " --json --hv " + hv).out);
    EXPECT_EQ(said["rows"].size(), 1u);
    EXPECT_NEAR(said["rows"][0]["v_deg"].get<double>(), -1.0, 1e-12);
    return said["rows"][0]["intensity_cd"].get<double>();
  };
  for (const char* hv : {"0,-1", "-4,-1", "5,-1"}) {
    const double a = cd(ours("low_rht.ies"), hv), c = cd(of_c, hv);
    EXPECT_NEAR(c, a, 0.1 * a) << hv;  // planes of the converted file lie between the nodes
  }
  for (const char* bad : {"--hv 1", "--hv 1,b", "--hv 1,2,3", "--hv 0,91", "--hv nan,0", "", "--hv 0,0 --at two.csv"})
    EXPECT_EQ(lamp("table " + ours("low_rht.ies") + " " + bad).code, 2) << bad;
}

TEST_F(LampUsage, AnyFileNameIsJson) {
  const std::string odd =
      in("b\xE9"
         "d.ies");
  std::filesystem::copy_file(ours("low_rht.ies"), odd);
  for (const std::string& command :
       {"info " + odd, "check " + odd + " --rule r149-passing-c", "compare " + odd + " " + odd,
        "hspr " + odd + " " + odd, "levels " + odd, "convert " + odd + " --out " + in("x.csv")}) {
    const Said said = lamp(command + " --json");
    EXPECT_EQ(said.code, 0) << command << "\n" << said.err;
    EXPECT_FALSE(nlohmann::json::parse(said.out, nullptr, false).is_discarded()) << command;
  }
}

TEST_F(LampUsage, NoNumberIsNoNumber) {
  const std::string low = ours("low_rht.ies");
  for (const std::string& command :
       {"plot " + low + " --out " + in("p") + " --height nan", "plot " + low + " --out " + in("p") + " --pitch-deg nan",
        "plot " + low + " --out " + in("p") + " --spacing inf", "check " + low + " --rule r149-passing-c --aim-up nan",
        "check " + low + " --rule r149-passing-c --aim-right inf", "info " + low + " --c0 nan",
        "info " + low + " --distance nan", "compare " + low + " " + low + " --height nan",
        "hspr " + low + " " + low + " --height nan"}) {
    const Said said = lamp(command);
    EXPECT_EQ(said.code, 2) << command;
    EXPECT_NE(said.err.find("is not a finite number"), std::string::npos) << command << "\n" << said.err;
  }
}

TEST_F(LampUsage, InfoGoesOnAfterABadFile) {
  const std::string bad = file("bad.ies", "TILT=NONE\n1 x\n");
  const Said words = lamp("info " + ours("fog.ies") + " " + bad + " " + ours("high.ies"));
  EXPECT_EQ(words.code, 2);
  EXPECT_NE(words.out.find("fog.ies"), std::string::npos);
  EXPECT_NE(words.out.find("high.ies"), std::string::npos);
  EXPECT_NE(words.err.find("bad.ies:2"), std::string::npos) << words.err;
  const Said machine = lamp("info " + ours("fog.ies") + " " + bad + " " + ours("high.ies") + " --json");
  EXPECT_EQ(machine.code, 2);
  const auto json = nlohmann::json::parse(machine.out, nullptr, false);
  ASSERT_EQ(json.size(), 3u);
  EXPECT_GT(json[0]["flux_lm"], 0.0);
  EXPECT_TRUE(json[1]["error"]["place"].get<std::string>().ends_with("bad.ies:2"));
  EXPECT_GT(json[2]["flux_lm"], 0.0);
}

TEST_F(LampUsage, MistakesAreNamed) {
  for (const auto& [command, words] : {std::pair<std::string, const char*>{"frobnicate", "frobnicate"},
                                       {"frobnicate --help", "frobnicate"},
                                       {"sum --help", "sum"},
                                       {"inof x.ies", "did you mean"},
                                       {"levels", "give a photometry file, or --bench"},
                                       {"info ''", "names no file"},
                                       {"convert " + ours("fog.ies") + " --out " + in("x.foo"), "say --to"}}) {
    const Said said = lamp(command);
    EXPECT_EQ(said.code, 2) << command;
    EXPECT_NE(said.err.find(words), std::string::npos) << command << "\n" << said.err;
  }
  EXPECT_EQ(lamp("--help").out.find("phare drive"), std::string::npos);
  EXPECT_NE(lamp("--help").out.find("phare lamp info"), std::string::npos);
  const Said type = lamp("convert " + ours("fog.ies") + " --out " + in("x.csv"));
  EXPECT_NE(type.out.find("type A"), std::string::npos) << type.out;
}

// A flat screen has no angles of its own; `table` takes azimuth and elevation there. 1 lx all over a screen at 10 m is
// r³/D cd, which is known without the program.
TEST_F(LampUsage, TableOfAScreenTakesAzimuthAndElevation) {
  const std::string screen = file("w.csv", "# unit: lx\n# distance_m: 10\nz\\y,-8,0,8\n-8,1,1,1\n8,1,1,1\n");
  const auto json = nlohmann::json::parse(
      lamp("table " + screen + " --json --at " + file("at.csv", "h_deg,v_deg\n0,0\n30,0\n0,30\n30,20\n")).out, nullptr,
      false);
  ASSERT_EQ(json["rows"].size(), 4u);
  for (const auto& row : json["rows"]) {
    const double h = row["h_deg"].get<double>() * 3.14159265358979323846 / 180.0;
    const double v = row["v_deg"].get<double>() * 3.14159265358979323846 / 180.0;
    const double x = std::cos(h) * std::cos(v);  // r = 10/x
    EXPECT_NEAR(row["intensity_cd"], 100.0 / (x * x * x), 1e-9) << row.dump();
  }
}

}  // namespace
}  // namespace phare
