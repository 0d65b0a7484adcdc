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
  EXPECT_EQ(json["beam"], "LOW BEAM") << machine.out;
  EXPECT_EQ(json["failed"], 0);
  EXPECT_GT(json["not_measured"], 0);
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

TEST_F(LampPoints, ARuleIsForTheBeamsOfItsKind) {
  // lb1m allows 5,000 cd at HV: nothing that the high beam of the same report could fail.
  const std::string list = file("both.csv", "Point;Low beam (cd);High beam (cd)\nH V;3000;60000\n4D V;3000;3000\n");
  const Said low = lamp("check " + list + " --rule lb1m");
  EXPECT_EQ(low.out.find("HIGH BEAM"), std::string::npos) << low.out;
  EXPECT_NE(low.err.find("HIGH BEAM is a high beam by its name and left out; fmvss108-lb1m is for low beams"),
            std::string::npos)
      << low.err;
  EXPECT_EQ(low.out.find("FAIL"), std::string::npos) << low.out;
  const Said asked = lamp("check " + list + " --rule lb1m --beam 'high beam'");
  EXPECT_NE(asked.out.find("FAIL"), std::string::npos) << "what is asked for is done: " << asked.out;
}

TEST_F(LampPoints, AListIsForOneSideOfTrafficUnderEveryRule) {
  // Of lb2v's points as many on the one side as on the other, of all rules more for right-hand traffic.
  const std::string list = file("side.csv", "Point,cd\n4D 20L,520\n4D 20R,610\n0.86D-3.5R,9800\n1.5D 2R,17000\n");
  for (const char* rule : {"lb2v", "lb1v", "lb1m"}) {
    const Said said = lamp("check " + list + " --rule " + rule);
    EXPECT_NE(said.out.find("right-hand traffic (by its points)"), std::string::npos) << rule << said.out;
  }
  const Said all = lamp("check " + list + " --rule all --function low");
  const std::size_t first = all.out.find("hand traffic (");
  EXPECT_NE(first, std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("hand traffic (", first + 1), std::string::npos) << "said once: " << all.out;
}

TEST_F(LampPoints, RulesThatAssumeDifferentlySayEachTheirOwn) {
  // A level cut-off tells no side: each rule takes the one on which the beam does better, and has its own verdict for
  // the other.
  const Said said = lamp("check " + ours("fog.ies") + " --rule all --function low --out " + in("page.html"));
  std::size_t rules = 0, sides = 0;
  for (std::size_t at = 0; (at = said.out.find("; aim: ", at)) != std::string::npos; ++at) ++rules;
  for (std::size_t at = 0; (at = said.out.find("hand traffic (assumed", at)) != std::string::npos; ++at) ++sides;
  EXPECT_GT(rules, 5u) << said.out;
  EXPECT_EQ(sides, rules) << said.out;
  EXPECT_NE(test::content_of(in("page.html")).find("<th>side of traffic</th>"), std::string::npos);
}

TEST_F(LampPoints, ResolutionsAreWholeCandela) {
  const Said said =
      lamp("check " + ours("low_rht.ies") + " --rule all --out " + in("page.html") + "; cat " + in("page.html"));
  EXPECT_EQ(said.out.find("e+0"), std::string::npos) << said.out;
  EXPECT_EQ(said.out.find("± 0<"), std::string::npos) << "nothing is known without a rest";
}

TEST_F(LampPoints, WhatCannotBeReadIsToldWithItsLine) {
  const std::string odd = file("odd.csv", "Point,cd\nHV,12\n4X 20L,5\n");
  for (const std::string& command :
       {"check " + odd + " --rule lb2v", "plot " + odd + " --out " + in("p"), "info " + odd}) {
    const Said said = lamp(command);
    EXPECT_EQ(said.code, 2) << command;
    EXPECT_NE(said.err.find("odd.csv:3: \"4X 20L\" is no direction"), std::string::npos) << command << said.err;
  }
  // A report whose columns do not say what they hold: the error tells how they would.
  const Said bare = lamp("info " + file("bare.csv", "Point;Low beam;High beam\nH V;3000;60000\n"));
  EXPECT_EQ(bare.code, 2);
  EXPECT_NE(bare.err.find("a column \"point\" and one of values, \"low beam (cd)\""), std::string::npos) << bare.err;
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
    const bool assumed = std::string(source) == "assumed";
    // Nothing that info tells hangs on the side: it takes none, so that it cannot take another than check.
    const auto info = said_by("info " + file);
    EXPECT_EQ(info["traffic_source"], assumed ? "not told" : source) << name;
    EXPECT_EQ(info["traffic"].is_null(), assumed) << name;
    EXPECT_EQ(said_by("check " + file + " --rule r112-passing-b")["traffic_source"], source) << name;
    EXPECT_EQ(said_by("compare " + file + " " + file)["traffic_source"], source) << name;
    EXPECT_EQ(said_by("plot " + file + " --view birds_eye --out " + in("p"))["traffic_source"], source) << name;
    EXPECT_EQ(said_by("hspr " + file + " " + file + " --beam low")["traffic_source"], source) << name;
    for (const std::string& command :
         {"info " + file, "check " + file + " --rule r112-passing-b", "compare " + file + " " + file,
          "plot " + file + " --view birds_eye --out " + in("p")})
      EXPECT_EQ(lamp(command).out.find("assumed") != std::string::npos, assumed) << command;
  }
}

}  // namespace
}  // namespace phare
