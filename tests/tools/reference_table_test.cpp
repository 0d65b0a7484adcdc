// unit: tables of a reference set of our own making; the real set where it is; how errors are judged.
#include "tools/reference_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

class ReferenceTable : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / "phare_reference_table_test";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "manifest.json") << R"({"files": {
      "low_A": {"file": "photometry/low_A.ies", "beam": "low"},
      "low_C": {"file": "photometry/low_C.ies", "beam": "low",
                "frame_in_lamp_axes": {"c0": [0, 0, 1], "c90": [0, 1, 0], "g0": [1, 0, 0]}},
      "low_ldt": {"file": "photometry/low.ldt", "beam": "low"}},
      "primary_file_per_beam": {"low": "low_A"}, "wall_x_m": 25.0,
      "mounting": {"low": [{"name": "left", "position_m": [0, 0.6, 0.65], "yaw_deg": 0, "pitch_deg": -0.5, "roll_deg": 0}]}})";
    std::ofstream(folder_ / "b_wall25_low.csv") << "y,z,E,E[low_C],E[low_ldt]\n-1,2,3,4,5\n0,1,0.5,0.25,0\n";
    std::ofstream(folder_ / "a_road_flat_low.csv") << "x,y,E\n1,2,3\n";
    std::ofstream(folder_ / "notes.csv") << "x\n1\n";
  }
  fs::path folder_;
};

TEST_F(ReferenceTable, WallHasAColumnForEachLm63File) {
  const auto cases = read_reference_table(folder_ / "b_wall25_low.csv");
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  ASSERT_EQ(cases->size(), 2u);
  EXPECT_EQ((*cases)[0].column, "E");
  EXPECT_EQ((*cases)[1].column, "E[low_C]");
  EXPECT_EQ((*cases)[1].expected_lx, (std::vector<double>{4.0, 0.25}));
  ASSERT_EQ((*cases)[0].points.size(), 2u);
  EXPECT_EQ((*cases)[0].points[0].position_m, (glm::dvec3{25.0, -1.0, 2.0}));
  EXPECT_EQ((*cases)[0].points[0].normal, (glm::dvec3{-1.0, 0.0, 0.0}));
  EXPECT_EQ((*cases)[0].points[1].line, 3u);
  EXPECT_EQ((*cases)[0].lamps[0].sources[0].roll_rad, 0.0);
  EXPECT_NEAR((*cases)[1].lamps[0].sources[0].roll_rad, -std::acos(0.0), 1e-15);  // C 0 up: ours, to the right, turned
}

TEST_F(ReferenceTable, SaysWhatIsWrong) {
  const auto reason = [](const fs::path& table) {
    const auto cases = read_reference_table(table);
    return cases.ok() ? std::string("nothing") : cases.error().text();
  };
  EXPECT_EQ(reason(folder_ / "absent.csv"), (folder_ / "absent.csv").string() + ": no such file");
  EXPECT_NE(reason(folder_ / "notes.csv").find("notes.csv: is none of"), std::string::npos);
  EXPECT_NE(reason(folder_ / "a_road_flat_low.csv").find("a_road_flat_low.csv:1: no column \"E[low_C]\""),
            std::string::npos)
      << reason(folder_ / "a_road_flat_low.csv");
  std::ofstream(folder_ / "manifest.json") << "{ broken";
  EXPECT_NE(reason(folder_ / "b_wall25_low.csv").find("manifest.json: "), std::string::npos);
  fs::remove(folder_ / "manifest.json");
  EXPECT_NE(reason(folder_ / "b_wall25_low.csv").find("manifest.json: no such file"), std::string::npos);
}

TEST_F(ReferenceTable, RelativeErrorsCountInTheLight) {
  ReferenceCase expected{"E", {}, std::vector<PointRow>(3), {10.0, 0.02, 0.005}};
  for (std::size_t i = 0; i < 3; ++i) expected.points[i].line = i + 2;
  const ReferenceErrors errors = compare(expected, {10.1, 0.021, 0.0});
  EXPECT_EQ(errors.judged, 2u);
  EXPECT_NEAR(errors.worst_relative, 0.05, 1e-12);
  EXPECT_EQ(errors.worst_line, 3u);
  EXPECT_NEAR(errors.worst_absolute_lx, 0.1, 1e-12);
  EXPECT_EQ(errors.highest_lx, 10.0);
}

TEST_F(ReferenceTable, ReadsTheSharedSet) {
  const fs::path set = fs::path(shared_data_dir()) / "photometry-reference";
  if (!fs::exists(set)) GTEST_SKIP() << "no reference set at " << set;
  std::size_t columns = 0;
  for (const char* table : {"0_intensity", "a_road_flat_low", "a_road_flat_high", "a_road_flat_fog", "b_wall25_low",
                            "b_wall25_high", "b_wall25_fog", "c_plates"}) {
    const auto cases = read_reference_table(set / (std::string(table) + ".csv"));
    ASSERT_TRUE(cases.ok()) << cases.error().text();
    columns += cases->size();
    for (const ReferenceCase& asked : *cases) EXPECT_EQ(asked.points.size(), asked.expected_lx.size());
  }
  EXPECT_EQ(columns, 25u);
}

}  // namespace
}  // namespace phare
