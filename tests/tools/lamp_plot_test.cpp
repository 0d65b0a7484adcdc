// process: `phare lamp plot`: which lamp is judged and aimed, lanes, texts that a machine can read.
#include <cmath>
#include <nlohmann/json.hpp>

#include "lamp_program.h"
#include "tools/lamp/views.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"

namespace phare {
namespace {

class LampPlot : public test::LampProgram {
 protected:
  nlohmann::json plot(const std::string& arguments, const std::string& view) const {
    const Said said = lamp("plot " + arguments + " --view " + view + " --out " + in("out") + " --json");
    EXPECT_EQ(said.code, 0) << said.err;
    return nlohmann::json::parse(said.out, nullptr, false);
  }
  std::string svg(const std::string& stem) const { return test::content_of(folder_ / "out" / (stem + ".svg")); }
};

// The car at y = 0 stands in one of two lanes; the other lies to its left where traffic keeps right.
TEST_F(LampPlot, LanesLieOnTheRightSide) {
  for (const bool left_hand : {false, true}) {
    const auto lines = lane_lines_m(left_hand);
    const double own_low = std::min(lines[0], lines[1]), own_high = std::max(lines[0], lines[1]);
    EXPECT_DOUBLE_EQ(own_low + own_high, 0.0);
    EXPECT_DOUBLE_EQ(own_high - own_low, 3.5);
    EXPECT_DOUBLE_EQ(lines[2] - lines[1], left_hand ? -3.5 : 3.5);  // y left positive
  }
  plot(ours("low_rht.ies"), "birds_eye");
  EXPECT_NE(svg("birds_eye").find("the car in the middle of the right one"), std::string::npos);
  EXPECT_EQ(plot(ours("low_lht.ies"), "birds_eye")["lane_lines_m"], nlohmann::json(lane_lines_m(true)));
  EXPECT_NE(svg("birds_eye").find("the car in the middle of the left one"), std::string::npos);
}

TEST_F(LampPlot, APairIsJudgedAndAimedAsAPair) {
  // Half the sum of a passing and a driving beam fails, as `check` says.
  const std::string pair = ours("low_rht.ies") + " " + ours("high.ies");
  EXPECT_EQ(lamp("check " + pair + " --rule r123-passing-c").code, 1);
  const auto sum = plot(pair + " --rule r123-passing-c", "wall_25m");
  ASSERT_EQ(sum["checks"].size(), 1u);
  EXPECT_EQ(sum["checks"][0]["verdict"], "fail");
  EXPECT_NE(svg("wall_25m").find("FAIL, "), std::string::npos);
  EXPECT_NE(svg("wall_25m").find("high.ies"), std::string::npos);
  // A rule of single lamps judges both, each on a wall of its own and at its own aim.
  IntensityTable up = *read_lamp(ours("low_rht.ies"));
  up.second_deg.pop_back();
  up.candela.resize(up.first_deg.size() * up.second_deg.size());
  for (double& v : up.second_deg) v += 0.5;
  const std::string higher = file("higher.ies", lm63_text(up));
  const auto each = plot(ours("low_rht.ies") + " " + higher + " --rule r149-passing-c", "wall_25m --view birds_eye");
  ASSERT_EQ(each["checks"].size(), 2u);
  EXPECT_NEAR(each["lamps"][1]["turned_up_deg"].get<double>(), each["lamps"][0]["turned_up_deg"].get<double>() - 0.5,
              0.006);  // the aim is iterated to 0.003° for each
  EXPECT_NE(svg("wall_25m_right").find("higher.ies"), std::string::npos);
  EXPECT_NE(svg("birds_eye").find("higher.ies (right)"), std::string::npos);
  const auto bare = plot(ours("low_rht.ies") + " " + higher, "vertical_cut");
  EXPECT_NEAR(bare["lamps"][1]["turned_up_deg"].get<double>(), bare["lamps"][0]["turned_up_deg"].get<double>() - 0.5,
              0.006);
}

TEST_F(LampPlot, LimitsOfGBelongToTheRule) {
  plot(ours("low_rht.ies") + " --rule r149-passing-c", "vertical_cut");
  EXPECT_NE(svg("vertical_cut").find("G 0.40 (most"), std::string::npos);
  plot(ours("low_rht.ies") + " --rule fmvss108-lb2v", "vertical_cut");  // has no maximum
  EXPECT_NE(svg("vertical_cut").find("G 0.13 (least"), std::string::npos);
  EXPECT_EQ(svg("vertical_cut").find("(most"), std::string::npos);
  plot(ours("high.ies") + " --rule r149-driving-b", "vertical_cut");
  EXPECT_EQ(svg("vertical_cut").find("(least"), std::string::npos);
  plot(ours("high.ies"), "vertical_cut");
  EXPECT_EQ(svg("vertical_cut").find("(least"), std::string::npos);
}

// Every row is named on the wall, or named as not being on this page.
TEST_F(LampPlot, EveryRowIsNamed) {
  for (const auto& [file, rule] :
       {std::pair{"low_rht.ies", "r149-passing-c"}, {"low_rht.ies", "fmvss108-lb2v"}, {"fog.ies", "r19-f3"}}) {
    plot(ours(file) + " --rule " + rule, "isocandela");
    const std::string text = svg("isocandela");
    const auto judged = nlohmann::json::parse(lamp("check " + ours(file) + " --rule " + rule + " --json").out);
    for (const auto& row : judged["rows"]) {
      if (!row.contains("lowest_at_deg") && !row["id"].get<std::string>().starts_with("S50")) continue;
      std::string id = row["id"];
      for (std::size_t at = 0; (at = id.find('&', at)) != std::string::npos; at += 5) id.replace(at, 1, "&amp;");
      EXPECT_NE(text.find(id), std::string::npos) << rule << " " << id;
    }
    EXPECT_NE(text.find("light at least"), std::string::npos);
  }
  EXPECT_NE(svg("isocandela").find("not wholly on this page"), std::string::npos);
}

// The page holds the end of 1 lx, worked out here from the table: E = I·x/r³ of both lamps on a plane facing the car.
TEST_F(LampPlot, TheRoadReachesToWhereOneLuxEnds) {
  const auto table = read_lamp(ours("low_rht.ies"));
  ASSERT_TRUE(table.ok());
  const auto json = plot(ours("low_rht.ies"), "birds_eye");
  const double pitch = json["lamps"][0]["turned_up_deg"].get<double>() * 3.14159265358979 / 180.0;
  double ahead = 0.0;
  for (double x = 10.0; x < 390.0; x += 0.5) {
    for (double y = -30.0; y <= 30.0; y += 0.5) {
      double lux = 0.0;
      for (const double lamp_y : {0.6, -0.6}) {
        const double dz = 0.25 - 0.65, dy = y - lamp_y, r2 = x * x + dy * dy + dz * dz;
        const glm::dvec3 in_lamp{std::cos(pitch) * x + std::sin(pitch) * dz, dy,
                                 std::cos(pitch) * dz - std::sin(pitch) * x};
        lux += table->intensity_cd(in_lamp) * x / (r2 * std::sqrt(r2));
      }
      if (lux >= 1.0) ahead = x;
    }
  }
  EXPECT_GT(ahead, 100.0);
  EXPECT_GT(json["road_ahead_m"], ahead);
  EXPECT_LT(json["road_ahead_m"], ahead + 30.0);
  EXPECT_FALSE(json["road_goes_on"]);
  EXPECT_EQ(svg("birds_eye").find("1 lx reaches beyond"), std::string::npos);
  EXPECT_NE(svg("birds_eye").find(">100</text>"), std::string::npos);  // the colour bar's
}

TEST_F(LampPlot, WhatTheFileLacksIsNotDrawnAsDark) {
  IntensityTable table = *read_lamp(ours("high.ies"));
  EXPECT_EQ((plot(ours("high.ies"), "wall_25m"), svg("wall_25m")).find("no data in the file"), std::string::npos);
  IntensityTable narrow = table;
  narrow.first_deg = {-5.0, 0.0, 5.0};
  narrow.candela.clear();
  for (const double v : table.second_deg) {
    for (const double h : narrow.first_deg) narrow.candela.push_back(table.intensity_at_cd({h, v}));
  }
  plot(file("narrow.ies", lm63_text(narrow)) + " --rule r149-driving-b", "wall_25m --view false_colour");
  for (const char* view : {"wall_25m", "false_colour"})
    EXPECT_NE(svg(view).find("no data in the file"), std::string::npos) << view;
  EXPECT_NE(svg("wall_25m").find("without data"), std::string::npos);
}

TEST_F(LampPlot, AnyFileNameIsDrawn) {
  const std::string odd = in("b\xE9 <&>.ies");
  std::filesystem::copy_file(ours("fog.ies"), odd);
  const auto json = plot("'" + odd + "'", "wall_25m");
  EXPECT_TRUE(json.is_object());
  EXPECT_NE(svg("wall_25m").find("b? &lt;&amp;&gt;.ies"), std::string::npos);
}

/// Texts above a chart that are wider than the page would be cut off: the title gets smaller, what stands below it
/// takes two lines.
TEST_F(LampPlot, NoTextLeavesThePage) {
  const std::string name(120, 'n');
  std::filesystem::copy_file(ours("fog.ies"), in(name + ".ies"));
  const std::string lamps = in(name + ".ies") + " " + in(name + ".ies");
  const Said said = lamp("plot " + lamps + " --rule r112-passing-b --view isocandela --out " + in("p"));
  ASSERT_EQ(said.code, 0) << said.err;
  std::string svg = test::content_of(in("p") + "/isocandela.svg");
  const auto has = [&](const char* part) { return svg.find(part) != std::string::npos; };
  EXPECT_FALSE(has("font-size=\"13\"")) << "a title of 120 letters at its usual size is 1,100 wide, the page 860";
  // The side of traffic of a list that does not tell it takes many words.
  const Said list = lamp("plot " + file("one.csv", "Point,cd\nH-V,500\n") + " --rule lb2v --out " + in("p"));
  ASSERT_EQ(list.code, 0) << list.err;
  svg = test::content_of(in("p") + "/wall_25m.svg");
  EXPECT_TRUE(has("<text x=\"62.00\" y=\"35.24\"") && has("<text x=\"62.00\" y=\"46.24\"")) << "two lines";
}

}  // namespace
}  // namespace phare
