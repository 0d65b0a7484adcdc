// unit: tables of a reference set of our own making; the real set where it is; how errors are judged.
#include "tools/reference_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "tests/paths.h"
#include "visual/photometry/beam/lamp_tables.h"

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

TEST_F(ReferenceTable, WallHasAColumnForEachFile) {
  const auto cases = read_reference_table(folder_ / "b_wall25_low.csv");
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  ASSERT_EQ(cases->size(), 3u);
  EXPECT_EQ((*cases)[0].column, "E");
  EXPECT_EQ((*cases)[1].column, "E[low_C]");
  EXPECT_EQ((*cases)[1].expected_lx, (std::vector<double>{4.0, 0.25}));
  ASSERT_EQ((*cases)[0].points.size(), 2u);
  EXPECT_EQ((*cases)[0].points[0].position_m, (glm::dvec3{25.0, -1.0, 2.0}));
  EXPECT_EQ((*cases)[0].points[0].normal, (glm::dvec3{-1.0, 0.0, 0.0}));
  EXPECT_EQ((*cases)[0].points[1].line, 3u);
  EXPECT_EQ((*cases)[0].lamps[0].sources[0].roll_rad, 0.0);
  EXPECT_EQ((*cases)[1].lamps[0].sources[0].c0_turn_deg, 90.0);  // C 0 up
  EXPECT_EQ((*cases)[2].column, "E[low_ldt]");
  EXPECT_EQ((*cases)[2].expected_lx, (std::vector<double>{5.0, 0.0}));
}

// A frame of the manifest becomes the settings of the reader: whatever way C 0 points and C is counted, the direction
// that the frame gives to a plane is the one that the table read with them gives it.
TEST_F(ReferenceTable, AFrameIsReadAsItStands) {
  // Type C with a different value in every plane of 45°, at gamma 90 alone; candela of plane C: 1000 + C.
  std::string ies = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 9 1 2 0 0 0 1 1 0\n45 90 135\n";
  for (int c = 0; c <= 360; c += 45) ies += std::to_string(c) + " ";
  ies += "\n";
  for (int c = 0; c <= 360; c += 45) ies += "100 " + std::to_string(1000 + c % 360) + " 200\n";
  fs::create_directories(folder_ / "photometry");
  std::ofstream(folder_ / "photometry" / "turned.ies") << ies;
  const glm::dvec3 ahead{1, 0, 0}, left{0, 1, 0}, up{0, 0, 1};
  struct Frame {
    glm::dvec3 c0, c90, g0;
  };
  std::vector<Frame> frames;
  for (const double sign : {1.0, -1.0}) {  // counted as the format says, and clockwise
    for (const glm::dvec3& c0 : {ahead, left, -ahead, -left}) frames.push_back({c0, sign * glm::cross(c0, -up), -up});
    for (const glm::dvec3& c0 : {up, left, -up, -left}) frames.push_back({c0, sign * glm::cross(c0, ahead), ahead});
  }
  const auto text = [](const glm::dvec3& v) {
    return "[" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + "]";
  };
  const auto read_with = [&](const Frame& frame) {
    std::ofstream(folder_ / "manifest.json")
        << R"({"files": {"t": {"file": "photometry/turned.ies", "beam": "low", "frame_in_lamp_axes": {"c0": )"
        << text(frame.c0) << R"(, "c90": )" << text(frame.c90) << R"(, "g0": )" << text(frame.g0)
        << R"(}}}, "primary_file_per_beam": {"low": "t"}, "wall_x_m": 25, "mounting": {"low": [{"name": "left",)"
        << R"("position_m": [0, 0, 0], "yaw_deg": 0, "pitch_deg": 0, "roll_deg": 0}]}})";
    return read_reference_table(folder_ / "a_road_flat_low.csv");
  };
  for (const Frame& frame : frames) {
    const auto cases = read_with(frame);
    ASSERT_TRUE(cases.ok()) << cases.error().text();
    LampTables tables;
    const SourceConfig& source = cases->front().lamps.front().sources.front();
    ASSERT_TRUE(tables.add(source).ok());
    EXPECT_EQ(source.roll_rad, 0.0);
    for (int c = 0; c < 360; c += 45) {
      const double rad = c * std::acos(0.0) / 90.0;
      const glm::dvec3 direction = std::cos(rad) * frame.c0 + std::sin(rad) * frame.c90;
      EXPECT_NEAR(tables.of(source).intensity_cd(direction), 1000.0 + c, 1e-9)
          << "C " << c << ", c0 " << text(frame.c0) << " c90 " << text(frame.c90) << " g0 " << text(frame.g0);
    }
  }
  const auto odd = read_with({ahead, left, up});  // gamma 0 straight up: no setting of ours
  ASSERT_FALSE(odd.ok());
  EXPECT_NE(odd.error().reason.find("no axis and c0 give this frame"), std::string::npos);
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

TEST_F(ReferenceTable, WhereNothingIsDimDarkHasToBeDark) {
  ReferenceCase expected{"low", {}, std::vector<PointRow>(2), {1e-9, 0.0}, 0.0};
  expected.points[0].line = 2, expected.points[1].line = 3;
  EXPECT_EQ(compare(expected, {1e-9, 1e-13}).worst_relative, 0.0);
  EXPECT_EQ(compare(expected, {1e-9, 1e-13}).judged, 2u);
  EXPECT_NEAR(compare(expected, {2e-9, 0.0}).worst_relative, 1.0, 1e-12);
  EXPECT_TRUE(std::isinf(compare(expected, {1e-9, 1e-11}).worst_relative));
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
  // LM-63, EULUMDAT, goniometer and screen: intensities of 14 files; road and wall with 7, 4 and 3 columns; plates.
  EXPECT_EQ(columns, 14u + 2u * (7u + 4u + 3u) + 1u);
  const auto hard = read_reference_table(set / "j_hard.csv");
  ASSERT_TRUE(hard.ok()) << hard.error().text();
  std::size_t points = 0;
  for (const ReferenceCase& asked : *hard) points += asked.points.size();
  EXPECT_EQ(hard->size(), 14u) << "lamps and places";
  EXPECT_EQ(points, 107u);
}

}  // namespace
}  // namespace phare
