// unit: lists of test points as laboratories print them: names, cells, beams, errors; judged by hand-made values.
#include "visual/photometry/readers/point_list.h"

#include <gtest/gtest.h>

#include <string>

#include "check_helpers.h"
#include "visual/photometry/bench/check_points.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

using test::row_of, test::rule;

std::vector<std::string> known_names() {
  const auto rules = read_rulebooks(rules_dir());
  EXPECT_TRUE(rules.ok());
  return names_of_rows(*rules);
}

Result<PointLists> read(const std::string& text, double distance_m = 0.0, bool mirror = false) {
  PointListSettings settings;
  settings.known_names = known_names();
  settings.distance_m = distance_m;
  settings.mirror_h = mirror;
  return parse_point_lists(text, "lab.csv", settings);
}

std::string refusal(const std::string& text) {
  const auto lists = read(text);
  return lists.ok() ? "read" : lists.error().text();
}

TEST(PointList, NamesOfDirections) {
  const struct {
    const char* name;
    double h_deg, v_deg;
  } names[] = {{"4D 20L", -20, -4},
               {"20L 4D", -20, -4},
               {"45L/7U", -45, 7},
               {"0.86D-3.5R", 3.5, -0.86},
               {"H-V", 0, 0},
               {"HV", 0, 0},
               {"V-H", 0, 0},
               {"2U-V", 0, 2},
               {"V 0.86D", 0, -0.86},
               {"H-5L", -5, 0},
               {"H 4L", -4, 0},
               {"1.5D-2R", 2, -1.5},
               {"1/2D-1 1/2R", 1.5, -.5},
               {"1\xC2\xBDU 1\xC2\xB0R", 1, 1.5},
               {"4d20l", -20, -4},
               {" 10U - 90R ", 90, 10}};
  for (const auto& [name, h, v] : names) {
    const auto at = point_of_name(name);
    ASSERT_TRUE(at.has_value()) << name;
    EXPECT_EQ(at->h_deg, h) << name;
    EXPECT_EQ(at->v_deg, v) << name;
  }
  for (const char* name : {"B50L", "75R", "50L", "BR", "V", "H", "10U-90U", "4X 20L", "4D 20L 3R", "D4 L20", "4 20",
                           "4U 8L & 8R", "-4D 20L 1", "Zone III", "", "1/0D 2L"})
    EXPECT_FALSE(point_of_name(name).has_value()) << name;
}

TEST(PointList, ReadsWhatLaboratoriesWrite) {
  const auto lists = read(
      "\n# report 4711\n\"Test point\";\"Min (cd)\";Measured (cd);Remark\n4D 20L;300;1 234,5;ok\nH-V;;n/a\nB50L;;350;\n"
      "75R;10100;;\n;;;\n2U 4L;135;\xE2\x80\x93;\n10U-90U;;85\n");
  ASSERT_TRUE(lists.ok()) << lists.error().text();
  ASSERT_EQ(lists->beams.size(), 1u);
  const PointList& list = lists->beams.front();
  ASSERT_EQ(list.points.size(), 6u);
  EXPECT_EQ(list.measured(), 3u);
  EXPECT_EQ(*list.points[0].cd, 1234.5);
  EXPECT_NEAR(list.points[0].step_cd, 0.1, 1e-12);
  EXPECT_EQ(list.points[0].line, 4u);
  EXPECT_FALSE(list.points[1].cd.has_value());
  EXPECT_FALSE(list.points[2].at.has_value());
  // Tabs; a thousands comma in quotes; values in lux; angles without names.
  EXPECT_EQ(*read("Point\tcd\n4D 20L\t1,5\n")->beams[0].points[0].cd, 1.5);
  EXPECT_EQ(*read("Point,cd\nHV,\"12,500\"\n")->beams[0].points[0].cd, 12500.0);
  EXPECT_NEAR(*read("# distance_m: 25\nPoint,E (lux)\n75R,16.2\n")->beams[0].points[0].cd, 16.2 * 625.0, 1e-9);
  EXPECT_NEAR(*read("Point,lx\n75R,16.2\n", 10.0)->beams[0].points[0].cd, 1620.0, 1e-9);
  EXPECT_EQ(read("h_deg,v_deg,intensity_cd\n-3.43,0.57,300\n")->beams[0].points[0].at->h_deg, -3.43);
  EXPECT_EQ(read("Point,cd\n4D 20L,1\n", 0.0, true)->beams[0].points[0].at->h_deg, 20.0);
  EXPECT_EQ(read("Point,cd\n75L,1\n", 0.0, true)->beams[0].points[0].name, "75R");
}

// Three digits behind every mark: may have been meant as thousands, and the verdict hangs on it.
TEST(PointList, MarksThatLookLikeThousandsAreTold) {
  const auto told = [](const std::string& text) {
    const auto lists = read(text);
    return !lists.ok() ? lists.error().text() : lists->warnings.empty() ? std::string() : lists->warnings.front();
  };
  EXPECT_EQ(told("Point;cd\n0.86D-V;5,000\n1.5D 2R;15,100\n75R;400\n"),
            "lab.csv:2: \"5,000\" is read as 5, as all values of three digits behind their mark; thousands are written "
            "without one");
  EXPECT_EQ(told("Point,cd\nHV,12\n0.86D-V,15.100\n").substr(0, 35), "lab.csv:3: \"15.100\" is read as 15.1");
  for (const char* decimals :
       {"Point,cd\nHV,15.100\n75R,15.1\n", "Point,cd\nHV,15.100\n75R,0.250\n", "Point,cd\nHV,15.100\n75R,10200\n",
        "Point,cd\nHV,\"1,310\"\n", "# distance_m: 25\nPoint,E (lux)\n75R,16.250\n"})
    EXPECT_EQ(told(decimals), "") << decimals;
}

TEST(PointList, SeveralBeams) {
  const auto by_rows = read("Beam,Point,cd\nLower,4D 20L,400\nUpper,HV,50000\nLower,HV,\n");
  ASSERT_TRUE(by_rows.ok()) << by_rows.error().text();
  ASSERT_EQ(by_rows->beams.size(), 2u);
  EXPECT_EQ(by_rows->beams[0].beam, "Lower");
  EXPECT_EQ(by_rows->beams[0].points.size(), 2u);
  EXPECT_EQ(by_rows->beams[0].measured(), 1u);
  const auto by_columns = read("Point,Low beam cd,High beam cd\nHV,3000,50000\n4D 20L,400,n/a\n");
  ASSERT_TRUE(by_columns.ok()) << by_columns.error().text();
  ASSERT_EQ(by_columns->beams.size(), 2u);
  EXPECT_EQ(by_columns->beams[1].beam, "HIGH BEAM");
  EXPECT_EQ(*by_columns->beams[1].points[0].cd, 50000.0);
  EXPECT_EQ(function_of_beam("HIGH BEAM"), "high");
  EXPECT_EQ(function_of_beam("LB2V left"), "low");
  EXPECT_EQ(function_of_beam("sample 3"), "");
}

TEST(PointList, RefusalsSayWhereAndWhy) {
  EXPECT_EQ(refusal("Point,cd\nHV,1\n4X 20L,2\n"),
            "lab.csv:3: \"4X 20L\" is no direction such as 4D 20L, 0.86D-3.5R or H-V, and no row of a rulebook");
  EXPECT_EQ(refusal("Point,cd\nHV,abc\n"), "lab.csv:2: the value at \"HV\" is no number: \"abc\"");
  EXPECT_EQ(refusal("Point,cd\nHV,-5\n"), "lab.csv:2: negative value -5");
  EXPECT_EQ(refusal("Point,cd\nHV,5\nH-V,6\n"), "lab.csv:3: the point \"H-V\" is there twice, first in line 2");
  EXPECT_EQ(refusal("Point,cd\nHV,5,6\n"), "lab.csv:2: expected 2 columns, got 3 (a comma within a cell needs quotes)");
  EXPECT_EQ(refusal("Point,lux\nHV,5\n"), "lab.csv:1: values in lx need \"# distance_m: …\" or --distance");
  EXPECT_EQ(refusal("Point,cd,candela\nHV,5,6\n"),
            "lab.csv:1: two columns of values cannot be told apart: neither names its beam");
  EXPECT_EQ(refusal("Point,remark\nHV,5\n"),
            "lab.csv:1: no column holds the values: expected one named cd, intensity, value, measured or lux");
  EXPECT_EQ(refusal("Point,cd\n4D 200L,5\n"), "lab.csv:2: the direction \"4D 200L\" is outside the sphere");
  EXPECT_EQ(refusal("Point,cd\n"), "lab.csv:1: the list has no points");
}

TEST(PointList, ToldFromBeams) {
  EXPECT_TRUE(is_point_list("Test point;cd\nHV;1\n", "a.csv"));
  EXPECT_TRUE(is_point_list("Position\tIntensity\nHV\t1\n", "report.txt"));
  EXPECT_TRUE(is_point_list("h_deg,v_deg,cd\n0,0,1\n-3.43,0.57,2\n1.15,-0.57,3\n", "a.csv"));
  EXPECT_FALSE(is_point_list("h_deg,v_deg,cd\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n", "a.csv"));
  EXPECT_FALSE(is_point_list("h_deg,v_deg,cd\n0,0,1\n1,0,2\n0,1,3\n", "a.csv"));  // a grid with a hole is a broken one
  EXPECT_FALSE(is_point_list("V\\H,0,1\n0,1,2\n1,3,4\n", "a.csv"));
  EXPECT_FALSE(is_point_list("IESNA:LM-63-2002\n[TEST] point cd\n", "a.ies"));
  const auto beam = parse_lamp("Point,cd\nHV,1\n", "a.csv");
  ASSERT_FALSE(beam.ok());
  EXPECT_NE(beam.error().text().find("a list of test points is no beam"), std::string::npos) << beam.error().text();
}

CheckResult judged(const std::string& text, const char* id, const CheckOptions& options = {},
                   std::vector<std::string>* unused = nullptr) {
  const auto lists = read(text);
  EXPECT_TRUE(lists.ok()) << (lists.ok() ? "" : lists.error().text());
  return check_points(lists.ok() ? lists->beams.front() : PointList{}, rule(id), options, unused);
}

TEST(CheckPoints, RowsThatHaveTheirPoint) {
  std::vector<std::string> unused;
  const CheckResult result = judged(
      "Point,cd\nH 4L,200\nH-8L,60\n0.6D-1.3R,12000\n4U 8L,70\n4U 8R,63\n2D 9L,1300\n5D 5L,1000\n1.5D-2R,15000.0\n",
      "fmvss108-lb2v", {}, &unused);
  EXPECT_EQ(row_of(result, "H 4L").verdict, RuleVerdict::kPass);
  EXPECT_EQ(row_of(result, "H 4L").margin, 65.0);
  EXPECT_EQ(row_of(result, "H 8L").verdict, RuleVerdict::kFail);
  EXPECT_EQ(row_of(result, "0.6D 1.3R").verdict, RuleVerdict::kPass);
  EXPECT_EQ(row_of(result, "4U 8L & 8R").verdict, RuleVerdict::kFail);  // the right one
  EXPECT_EQ(row_of(result, "4U 8L & 8R").lowest_at.h_deg, 8.0);
  // One of two points is there and passes: the row is not measured.
  EXPECT_EQ(verdict_name(row_of(result, "2D 9L & 9R")), "not measured");
  EXPECT_EQ(row_of(result, "2D 9L & 9R").no_data_at.h_deg, 9.0);
  EXPECT_EQ(verdict_name(row_of(result, "0.86D V")), "not measured");
  EXPECT_EQ(verdict_name(row_of(result, "10U-90U 90L-90R zone")), "not measured");
  EXPECT_EQ(verdict_name(row_of(result, "cut-off sharpness G")), "not measured");
  EXPECT_EQ(row_of(result, "1.5D 2R").verdict, RuleVerdict::kWithinResolution);  // on the limit, to half a digit
  EXPECT_EQ(unused, std::vector<std::string>{"5D 5L"});
  EXPECT_EQ(result.verdict, RuleVerdict::kFail);
  EXPECT_EQ(result.aim_method, "as measured");
}

// Measured by its direction and once more by its name: neither is passed over.
TEST(CheckPoints, APointThatIsThereByNameAndByDirectionCountsTwice) {
  for (const char* text : {"Point,cd\nB50L,310\n0.57U 3.43L,400\n", "Point,cd\nB50L,400\n0.57U 3.43L,310\n"}) {
    std::vector<std::string> unused;
    const CheckResult result = judged(text, "r112-passing-b", {}, &unused);
    EXPECT_EQ(row_of(result, "B50L").highest, 400.0) << text;
    EXPECT_EQ(row_of(result, "B50L").lowest, 310.0) << text;
    EXPECT_TRUE(unused.empty()) << text;
  }
}

// A point decides of a zone or a line only that it breaks its limit.
TEST(CheckPoints, ZonesFailByAPointAndPassByNone) {
  const auto zone = [](const std::string& text) {
    return verdict_name(row_of(judged("Point,cd\n" + text, "fmvss108-lb2v"), "10U-90U 90L-90R zone"));
  };
  EXPECT_EQ(zone("20U 30L,124\n"), "not measured");
  EXPECT_EQ(zone("20U 30L,126\n"), "fail");
  EXPECT_EQ(zone("9U 30L,126\n"), "not measured");  // outside
  EXPECT_EQ(zone("10U-90U,124\n"), "pass");         // the laboratory speaks of the whole zone
  EXPECT_EQ(zone("10U-90U,126\n"), "fail");
  const auto line = [](const std::string& text) {
    return verdict_name(row_of(judged("Point,cd\n" + text, "fmvss108-lb2v"), "0.5U 1R to 3R"));
  };
  EXPECT_EQ(line("0.5U 2R,600\n"), "not measured");
  EXPECT_EQ(line("0.5U 2R,400\n"), "fail");
  EXPECT_EQ(line("0.5U 2R,2800\n"), "fail");
  EXPECT_EQ(line("0.5U 3.5R,2800\n"), "not measured");
  EXPECT_EQ(line("0.5U 1R to 3R,600\n"), "pass");
}

TEST(CheckPoints, NamesSumsAndPeaksOfUnRules) {
  const CheckResult r112 =
      judged("Point,cd\nB50L,300\n75R,11000\nP1,70\nP2,70\nP3,60\nP4,30\nP7,60\n", "r112-passing-b");
  EXPECT_EQ(row_of(r112, "B50L").verdict, RuleVerdict::kPass);
  EXPECT_EQ(row_of(r112, "75R").verdict, RuleVerdict::kPass);
  EXPECT_EQ(row_of(r112, "P1+P2+P3").lowest, 200.0);
  EXPECT_NE(row_of(r112, "P1+P2+P3").verdict, RuleVerdict::kNoData);
  EXPECT_EQ(verdict_name(row_of(r112, "P4+P5+P6")), "not measured");
  EXPECT_NE(row_of(r112, "P7").verdict, RuleVerdict::kNoData);
  EXPECT_EQ(verdict_name(row_of(r112, "Zone III")), "not measured");
  // 0.8 of the highest intensity: unknown without it, but no more than a measured point allows.
  const auto hv = [](const std::string& text) {
    return verdict_name(row_of(judged("Point,cd\n" + text, "r149-driving-b"), "H-V"));
  };
  EXPECT_EQ(hv("H-V,50000\n"), "not measured");
  EXPECT_EQ(hv("H-V,50000\nImax,60000\n"), "pass");
  EXPECT_EQ(hv("H-V,50000\nImax,70000\n"), "fail");
  EXPECT_EQ(hv("H-V,30000\nH-3R,60000\n"), "fail");
  const auto peak = [](const std::string& text) {
    return verdict_name(row_of(judged("Point,cd\n" + text, "r149-driving-b"), "Imax"));
  };
  EXPECT_EQ(peak("H-V,50000\n"), "not measured");  // not above its most: it may be higher elsewhere
  EXPECT_EQ(peak("Imax,60000\n"), "pass");
  EXPECT_EQ(peak("H-V,300000\n"), "fail");
}

TEST(CheckPoints, TheSideOfTraffic) {
  const std::string right = "Point,cd\nB50L,300\n75R,11000\n25L,3000\n",
                    left = "Point,cd\nB50R,300\n75L,11000\n25R,3000\n";
  const CheckResult a = judged(right, "r112-passing-b"), b = judged(left, "r112-passing-b");
  EXPECT_FALSE(a.left_hand);
  EXPECT_EQ(a.traffic_source, TrafficSource::kFound);
  EXPECT_TRUE(b.left_hand);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].verdict, b.rows[i].verdict) << a.rows[i].id;
    EXPECT_EQ(a.rows[i].margin, b.rows[i].margin) << a.rows[i].id;
  }
  EXPECT_EQ(judged("Point,cd\nHV,500\n", "r112-passing-b").traffic_source, TrafficSource::kAssumed);
  CheckOptions given;
  given.traffic = TrafficSide::kRight;
  EXPECT_FALSE(judged(left, "r112-passing-b", given).left_hand);
}

}  // namespace
}  // namespace phare
