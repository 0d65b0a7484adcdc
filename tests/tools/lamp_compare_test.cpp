// process: `phare lamp compare`: turned and mirrored copies, the road, what it says of beams it cannot align.
#include <cmath>
#include <nlohmann/json.hpp>

#include "lamp_program.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"

namespace phare {
namespace {

class LampCompare : public test::LampProgram {
 protected:
  /// One of our lamps with its angles moved: the same beam, turned.
  std::string moved(const std::string& name, double right_deg) const {
    auto table = read_lamp(ours(name));
    EXPECT_TRUE(table.ok()) << table.error().text();
    for (double& h : table->first_deg) h = std::round((h + right_deg) * 1e6) * 1e-6;
    // What left the range of type A is dark anyway.
    const std::size_t columns = table->first_deg.size();
    IntensityTable inside = *table;
    inside.first_deg.clear();
    inside.candela.clear();
    for (const double h : table->first_deg) {
      if (std::abs(h) <= 90.0) inside.first_deg.push_back(h);
    }
    for (std::size_t k = 0; k < table->candela.size(); ++k) {
      if (std::abs(table->first_deg[k % columns]) <= 90.0) inside.candela.push_back(table->candela[k]);
    }
    return file("moved.ies", lm63_text(inside));
  }
  nlohmann::json compare(const std::string& arguments) const {
    const Said said = lamp("compare " + arguments + " --json");
    EXPECT_EQ(said.code, 0) << said.err;
    return nlohmann::json::parse(said.out, nullptr, false);
  }
};

// Turned back, the copy lights the wall and the road as the original does. The alignment is good to 0.02° (see
// cutoff_line_test.cpp), which on the cut-off (factor 2.5 in 0.1°, rise 15°) is 0.02·tan 15°·4 = 2 % of the light
// there.
TEST_F(LampCompare, ATurnedCopyIsTheSameBeamOnWallAndRoad) {
  for (const double right : {-2.0, 1.0}) {
    const auto json = compare(ours("low_rht.ies") + " " + moved("low_rht.ies", right));
    ASSERT_TRUE(json.is_object());
    EXPECT_NEAR(json["b_turned_right_deg"], -right, 0.02);
    EXPECT_NEAR(json["b_turned_up_deg"], 0.0, 0.005);
    EXPECT_LT(json["worst_difference_cd"], 0.02 * json["peak_a_cd"].get<double>());
    for (const auto& p : json["road"]) EXPECT_NEAR(p["ratio"], 1.0, 0.02) << p.dump();
    for (const auto& p : json["points"]) EXPECT_NEAR(p["ratio"], 1.0, 0.02) << p.dump();
    // As filed they are not alike, on the road neither.
    const auto filed = compare(ours("low_rht.ies") + " " + in("moved.ies") + " --no-align");
    EXPECT_GT(filed["worst_difference_cd"], 0.1 * filed["peak_a_cd"].get<double>());
    double worst = 0.0;
    for (const auto& p : filed["road"]) worst = std::max(worst, std::abs(p["ratio"].get<double>() - 1.0));
    EXPECT_GT(worst, 0.1);
  }
}

TEST_F(LampCompare, AMirroredCopyIsRecognised) {
  const auto json = compare(ours("low_rht.ies") + " " + ours("low_lht.ies"));
  EXPECT_TRUE(json["mirrored"]["likely"]);
  EXPECT_NEAR(json["mirrored"]["worst_difference_cd"], 0.0, 0.02 * json["peak_a_cd"].get<double>());
  EXPECT_NE(lamp("compare " + ours("low_rht.ies") + " " + ours("low_lht.ies")).out.find("--mirror-b"),
            std::string::npos);
  const auto turned = compare(ours("low_rht.ies") + " " + ours("low_lht.ies") + " --mirror-b");
  EXPECT_FALSE(turned["mirrored"]["likely"]);
  EXPECT_GT(turned["correlation"], 0.9999);
  EXPECT_FALSE(compare(ours("low_rht.ies") + " " + ours("led_low_rht.ies"))["mirrored"]["likely"]);
  EXPECT_FALSE(compare(ours("high.ies") + " " + ours("led_high.ies"))["mirrored"]["likely"]);
}

TEST_F(LampCompare, AnEvenFileTellsNothingOfAnother) {
  const std::string dark = file("dark.ies",
                                "IESNA:LM-63-2002\n[TEST] dark\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n-20 20\n"
                                "-30 30\n0 0\n0 0\n");
  EXPECT_EQ(compare(dark + " " + ours("low_rht.ies"))["correlation"], 0.0);
  EXPECT_EQ(compare(dark + " " + dark)["correlation"], 1.0);
}

// What a file lacks is not a difference.
TEST_F(LampCompare, OnlyWhereBothHaveData) {
  const auto table = read_lamp(ours("low_rht.ies"));
  ASSERT_TRUE(table.ok());
  IntensityTable part = *table;
  part.first_deg.clear();
  part.candela.clear();
  for (const double h : table->first_deg) {
    if (std::abs(h) <= 8.0) part.first_deg.push_back(h);
  }
  for (const double v : table->second_deg) {
    for (const double h : part.first_deg) part.candela.push_back(table->intensity_at_cd({h, v}));
  }
  const std::string narrow = file("narrow.ies", lm63_text(part));
  const auto json = compare(ours("low_rht.ies") + " " + narrow);
  EXPECT_NEAR(json["compared_share_of_field"], 16.0 / 40.0, 0.01);
  EXPECT_NEAR(json["b_turned_right_deg"], 0.0, 0.002);
  EXPECT_LT(json["worst_difference_cd"], 0.002 * json["peak_a_cd"].get<double>());
  for (const auto& p : json["points"]) {
    const bool beside = std::abs(p["h_deg"].get<double>()) > 8.0;
    EXPECT_EQ(p["ratio"].is_null(), beside) << p.dump();
  }
  EXPECT_NE(lamp("compare " + ours("low_rht.ies") + " " + narrow).out.find("40 % compared"), std::string::npos);
}

TEST_F(LampCompare, SaysWhyItDoesNotAlign) {
  const std::string low = ours("low_rht.ies"), high = ours("high.ies"), fog = ours("fog.ies");
  EXPECT_NE(lamp("compare " + low + " " + high).out.find("B has no cut-off"), std::string::npos);
  EXPECT_NE(lamp("compare " + high + " " + high).out.find("neither beam has a cut-off"), std::string::npos);
  EXPECT_NE(lamp("compare " + low + " " + low + " --no-align").out.find("not aligned, as asked"), std::string::npos);
  EXPECT_NE(lamp("compare " + low + " " + fog).out.find("without a kink"), std::string::npos);
}

}  // namespace
}  // namespace phare
