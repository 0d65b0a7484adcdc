// process: lists of test points, every rule on one page, and assumed sides of traffic, as `phare lamp` tells them.
#include <nlohmann/json.hpp>

#include "lamp_program.h"

namespace phare {
namespace {

using LampPoints = test::LampProgram;

constexpr const char* kReport =
    "Test point;Low beam (cd);High beam (cd);Remark\n10U-90U;85;;\n4U 8L;70;;\n4U 8R;70;;\nH 4L;200;;\nH-V;;75000;\n"
    "0.86D-3.5L;n/a;;\n1.5D-2R;16000;;\n2U-V;;2000;\n";

TEST_F(LampPoints, AReportIsJudgedAndDrawn) {
  const std::string list = file("report.csv", kReport);
  const Said info = lamp("info " + list);
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_NE(info.out.find("LOW BEAM: 8 points, 5 measured, 1 by a rule's name alone"), std::string::npos) << info.out;
  const Said check = lamp("check " + list + " --rule lb2v --beam 'low beam'");
  EXPECT_EQ(check.code, 1);  // not all of it was measured
  EXPECT_NE(check.out.find("not measured"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("UNDECIDED"), std::string::npos) << check.out;
  EXPECT_EQ(check.out.find("HIGH"), std::string::npos) << check.out;
  const Said machine = lamp("check " + list + " --rule lb2v --json");
  const auto json = nlohmann::json::parse(machine.out, nullptr, false);
  ASSERT_EQ(json.size(), 2u) << machine.out;
  EXPECT_EQ(json[0]["beam"], "LOW BEAM");
  EXPECT_EQ(json[0]["failed"], 0);
  EXPECT_GT(json[0]["not_measured"], 0);
  // Each beam by the rules of its kind.
  const Said all = lamp("check " + list + " --market US");
  EXPECT_EQ(all.code, 1);
  EXPECT_NE(all.out.find("fmvss108-lb2v"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("fmvss108-ub2"), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("r112"), std::string::npos) << all.out;
  const Said plot = lamp("plot " + list + " --rule lb2v --beam 'low beam' --out " + in("p"));
  EXPECT_EQ(plot.code, 0) << plot.err;
  EXPECT_GT(std::filesystem::file_size(in("p") + "/wall_25m_LOW_BEAM.png"), 10000u);
  EXPECT_NE(test::content_of(in("p") + "/wall_25m_LOW_BEAM.svg").find("16000 cd"), std::string::npos);
}

TEST_F(LampPoints, WhatCannotBeReadIsToldWithItsLine) {
  const std::string odd = file("odd.csv", "Point,cd\nHV,12\n4X 20L,5\n");
  for (const std::string& command :
       {"check " + odd + " --rule lb2v", "plot " + odd + " --out " + in("p"), "info " + odd}) {
    const Said said = lamp(command);
    EXPECT_EQ(said.code, 2) << command;
    EXPECT_NE(said.err.find("odd.csv:3: \"4X 20L\" is no direction"), std::string::npos) << command << said.err;
  }
  const std::string good = file("good.csv", "Point,cd\nHV,12\n");
  const Said convert = lamp("convert " + good + " --out " + in("x.ies"));
  EXPECT_EQ(convert.code, 2);
  EXPECT_NE(convert.err.find("good.csv:1: a list of test points is no beam"), std::string::npos) << convert.err;
  EXPECT_FALSE(std::filesystem::exists(in("x.ies")));
  EXPECT_EQ(lamp("check " + good + " --rule lb2v --beam upper").code, 2);
  EXPECT_EQ(lamp("check " + ours("low_rht.ies") + " --rule lb2v --beam upper").code, 2);
  EXPECT_EQ(lamp("plot " + good + " --out " + in("p") + " --view birds_eye").code, 2);
}

TEST_F(LampPoints, EveryRuleOnOnePage) {
  const Said said = lamp("check " + ours("low_rht.ies") + " --rule all --out " + in("out/page.html"));
  EXPECT_EQ(said.code, 1);
  EXPECT_NE(said.out.find("low beam (its cut-off rises: elbow)"), std::string::npos) << said.out;
  for (const char* rule : {"r149-passing-c", "r112-passing-b", "fmvss108-lb2v"})
    EXPECT_NE(said.out.find(rule), std::string::npos) << said.out;
  EXPECT_EQ(said.out.find("r149-driving"), std::string::npos) << said.out;
  // Failed rows first, and no failed row after another.
  const std::size_t worst = said.out.find("worst rows first");
  ASSERT_NE(worst, std::string::npos);
  const std::size_t last_fail = said.out.rfind("  FAIL\n"), first_pass = said.out.find("  pass", worst);
  if (last_fail != std::string::npos && last_fail > worst) {
    EXPECT_LT(last_fail, first_pass) << said.out;
  }
  const std::string page = test::content_of(in("out/page.html"));
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_NE(page.find("UN R149 passing beam, class C"), std::string::npos);
  const Said market = lamp("check " + ours("fog.ies") + " --market EU --json");
  const auto json = nlohmann::json::parse(market.out, nullptr, false);
  ASSERT_EQ(json.size(), 1u) << market.out;
  EXPECT_EQ(json[0]["rule"], "r19-f3");
  EXPECT_EQ(json[0]["traffic_source"], "assumed");
  EXPECT_EQ(lamp("check " + ours("fog.ies") + " --market US").code, 2);  // no rule of fog lamps there
  EXPECT_EQ(lamp("check " + ours("fog.ies") + " --rule r19-f3 --market ECE").code, 2);
}

TEST_F(LampPoints, AssumedSidesAreCalledSo) {
  const auto said_by = [&](const std::string& command) {
    const Said said = lamp(command + " --json");
    return nlohmann::json::parse(said.out, nullptr, false);
  };
  for (const auto& [name, source] :
       {std::pair{"fog.ies", "assumed"}, {"high.ies", "assumed"}, {"low_rht.ies", "by the cut-off"}}) {
    const std::string file = ours(name);
    EXPECT_EQ(said_by("info " + file)["traffic_source"], source) << name;
    EXPECT_EQ(said_by("check " + file + " --rule r112-passing-b")["traffic_source"], source) << name;
    EXPECT_EQ(said_by("compare " + file + " " + file)["traffic_source"], source) << name;
    EXPECT_EQ(said_by("plot " + file + " --view birds_eye --out " + in("p"))["traffic_source"], source) << name;
    EXPECT_EQ(said_by("hspr " + file + " " + file + " --beam low")["traffic_source"], source) << name;
    const bool assumed = std::string(source) == "assumed";
    for (const std::string& command :
         {"info " + file, "check " + file + " --rule r112-passing-b", "compare " + file + " " + file,
          "plot " + file + " --view birds_eye --out " + in("p")})
      EXPECT_EQ(lamp(command).out.find("assumed") != std::string::npos, assumed) << command;
  }
}

}  // namespace
}  // namespace phare
