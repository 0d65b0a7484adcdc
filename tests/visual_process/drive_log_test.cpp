// unit: drive.csv has one row a frame, also over a restart; the height of the cut-off follows pitch and levelling.
#include "visual/process/drive_log.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <numeric>
#include <sstream>

#include "tests/paths.h"
#include "visual/process/lamps.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Cells, commas in quotes not counted.
std::size_t cells_of(const std::string& line) {
  std::size_t cells = 1;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) ++cells;
  }
  return cells;
}

DriveRow row_of(std::int64_t frame) {
  DriveRow row{
      .frame = frame, .time = SimTime{frame * 16'666'667}, .lit = "low", .design = "a, \"b\"", .cutoff_m = 0.41};
  if (frame % 6 == 0) row.reach = {{1.0, 80.0, 90.0}, {3.0, 50.0, 60.0}, {5.0, 40.0, 45.5}};
  return row;
}

TEST(DriveLog, ARowThatTheDiskDoesNotTakeLeavesNoHalfOfIt) {
  const fs::path folder = fs::path(testing::TempDir()) / ("phare_full_disk_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  DriveLog log(folder, false);
  ASSERT_TRUE(log.write(row_of(0)));
  const auto whole = fs::file_size(folder / "drive.csv");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handled = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit full{whole + 20, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &full), 0);
  EXPECT_FALSE(log.write(row_of(1))) << "said once";
  EXPECT_TRUE(log.write(row_of(2)));
  EXPECT_EQ(fs::file_size(folder / "drive.csv"), whole);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handled);
  EXPECT_TRUE(log.write(row_of(3)));
  const auto lines = lines_of(folder / "drive.csv");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[2] + "\n", drive_row(row_of(3), {}));

  // Of the process that takes the place of one that was killed: what the disk has stays, whatever it takes now.
  const rlimit fuller{20, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &fuller), 0);
  DriveLog next(folder, true);
  EXPECT_FALSE(next.write(row_of(4)));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handled);
  EXPECT_EQ(lines_of(folder / "drive.csv"), lines);
  EXPECT_TRUE(next.write(row_of(5)));
  EXPECT_EQ(lines_of(folder / "drive.csv").size(), lines.size() + 1);
  fs::remove_all(folder);
}

TEST(DriveLog, TrafficHasColumnsOfItsOwn) {
  DriveRow row = row_of(0);
  row.glare = {.illuminance_lx = 0.25, .veil_cdm2 = 0.0625, .threshold_increment_percent = 4.0625, .de_boer = 5.5};
  row.others_glare = {
      .illuminance_lx = 0.125, .veil_cdm2 = 0.03125, .threshold_increment_percent = 2.03125, .de_boer = 6.25};
  const DriveColumns columns{.traffic = true};
  EXPECT_EQ(cells_of(drive_row(row, columns)), cells_of(drive_columns(columns)));
  EXPECT_TRUE(drive_columns(columns).ends_with(
      ",glare_lx,veil_cdm2,threshold_increment_percent,de_boer,others_eye_lx,others_veil_cdm2,"
      "others_threshold_increment_percent,others_de_boer\n"));
  EXPECT_TRUE(drive_row(row, columns).ends_with(",0.25,0.0625,4.062,5.500,0.125,0.03125,2.031,6.250\n"))
      << drive_row(row, columns);
  row.glare = {};
  EXPECT_TRUE(drive_row(row, columns).ends_with(",0,0,0,,0.125,0.03125,2.031,6.250\n")) << "no light, no figure";
  row.others_glare = {};
  EXPECT_TRUE(drive_row(row, columns).ends_with(",0,0,0,,0,0,0,\n"));
  EXPECT_EQ(cells_of(drive_row(row, columns)), cells_of(drive_columns(columns)));
}

TEST(DriveLog, HasOneRowAFrameAlsoOverARestart) {
  const fs::path folder = fs::path(testing::TempDir()) / ("phare_drive_log_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  {
    DriveLog log(folder, false);
    EXPECT_EQ(log.frames_before(), 0);
    for (std::int64_t frame = 0; frame < 8; ++frame) ASSERT_TRUE(log.write(row_of(frame)));
  }
  std::ofstream(folder / "drive.csv", std::ios::app) << "8,0.13";  // killed in the middle of a row
  {
    DriveLog log(folder, true);
    EXPECT_EQ(log.frames_before(), 8) << "a real-time drive goes on counting there";
    for (std::int64_t frame = 6; frame < 12; ++frame) ASSERT_TRUE(log.write(row_of(frame)));  // drawn again from 6 on
  }
  const std::vector<std::string> lines = lines_of(folder / "drive.csv");
  ASSERT_EQ(lines.size(), 13u);
  EXPECT_EQ(lines[0] + "\n", drive_columns());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(cells_of(lines[i]), cells_of(lines[0])) << lines[i];
    EXPECT_EQ(std::atoll(lines[i].c_str()), static_cast<long long>(i) - 1);
  }
  EXPECT_NE(lines[1].find(",\"a, \"\"b\"\"\",0,0,0,0.41000,80.0,90.0,50.0,60.0,40.0,45.5,"), std::string::npos)
      << lines[1];
  EXPECT_NE(lines[2].find(",0.41000,,,,,,,"), std::string::npos) << lines[2];
  fs::remove_all(folder);
}

// Somebody had sought back, and the process began anew: what was driven before stays.
TEST(DriveLog, KeepsRowsOfBeforeASeekOverARestart) {
  const fs::path folder = fs::path(testing::TempDir()) / ("phare_drive_log_seek_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto write = [](DriveLog& log, std::int64_t from, std::int64_t to) {
    for (std::int64_t frame = from; frame < to; ++frame) ASSERT_TRUE(log.write(row_of(frame)));
  };
  {
    DriveLog log(folder, false);
    write(log, 0, 20);
    write(log, 4, 10);  // back by 16 frames
  }
  {
    DriveLog log(folder, true);
    write(log, 8, 12);
  }
  std::vector<std::int64_t> frames;
  const std::vector<std::string> lines = lines_of(folder / "drive.csv");
  for (std::size_t i = 1; i < lines.size(); ++i) frames.push_back(std::atoll(lines[i].c_str()));
  std::vector<std::int64_t> expected(20);
  std::iota(expected.begin(), expected.end(), 0);
  for (const std::int64_t frame : {4, 5, 6, 7, 8, 9, 10, 11}) expected.push_back(frame);
  EXPECT_EQ(frames, expected);
  fs::remove_all(folder);
}

TEST(DriveLog, ReachIsDueTenTimesASecond) {
  const fs::path folder = fs::path(testing::TempDir()) / ("phare_drive_log_due_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  DriveLog log(folder, false);
  int due = 0;
  for (std::int64_t frame = 0; frame < 120; ++frame) {
    DriveRow row = row_of(frame);
    row.reach.clear();
    if (log.reach_is_due(row.time)) ++due, row.reach = {{1.0, 1.0, 1.0}};
    log.write(row);
  }
  EXPECT_EQ(due, 20);
  fs::remove_all(folder);
}

// A search takes a tenth of a second: a drive looks for all of them before it begins, whichever design shines then.
TEST(DriveLog, CutoffsThatWereFoundBeforehandAreNotLookedForAgain) {
  const auto rig = read_rig(source_dir() + "/config/rigs/country_road.toml");
  ASSERT_TRUE(rig.ok());
  ASSERT_EQ(rig->designs.size(), 2u);
  auto lamps = Lamps::load(*rig), late = Lamps::load(*rig);
  ASSERT_TRUE(lamps.ok() && late.ok());
  lamps->find_cutoffs();
  EXPECT_EQ(lamps->cutoff_searches(), 2u) << "left and right are alike";
  CockpitState controls;
  controls.light_switch = LightSwitch::kLow;
  for (controls.design_index = 0; controls.design_index < 2; ++controls.design_index) {
    (void)lamps->set_controls(controls);
    (void)late->set_controls(controls);
    const auto height_m = lamps->cutoff_height_m({}, 25.0);
    EXPECT_TRUE(height_m.has_value());
    EXPECT_EQ(height_m, late->cutoff_height_m({}, 25.0));
    EXPECT_EQ(late->cutoff_searches(), controls.design_index + 1u);
  }
  EXPECT_EQ(lamps->cutoff_searches(), 2u);
}

TEST(DriveLog, CutoffOnTheWallFollowsPitchAndLevelling) {
  const auto rig = read_rig(source_dir() + "/config/rigs/country_road.toml");
  ASSERT_TRUE(rig.ok());
  auto lamps = Lamps::load(*rig);
  ASSERT_TRUE(lamps.ok()) << lamps.error().text();
  VehicleState car;
  EXPECT_FALSE(lamps->cutoff_height_m(car, 25.0).has_value());  // dark
  CockpitState controls;
  controls.light_switch = LightSwitch::kLow;
  (void)lamps->set_controls(controls);
  const auto level = lamps->cutoff_height_m(car, 25.0), at_50 = lamps->cutoff_height_m(car, 50.0);
  ASSERT_TRUE(level && at_50);
  // Aimed 1 % down from its own height: 0.25 m lower at 25 m, and as much again at 50 m. The cut-off is found within
  // 0.01 degrees (tests/photometry/mounted_lamp_test.cpp): 4 mm at 25 m.
  const double lamp_m = rig->designs[0].lamps[0].position_m.z;
  EXPECT_NEAR(*level, lamp_m - 0.25, 0.012);
  EXPECT_NEAR(*level - *at_50, 0.25, 0.012);
  // Nose down by 1 degree lowers the mark by 25 m * tan 1 degree, and the lamp by its place ahead of the axle.
  constexpr double kDegree_rad = 3.14159265358979 / 180.0;
  car.pitch_rad = kDegree_rad;
  const double x_m = rig->designs[0].lamps[0].position_m.x;
  const double lower_m = 25.0 * std::tan(kDegree_rad) + x_m * std::sin(kDegree_rad);
  EXPECT_NEAR(*level - *lamps->cutoff_height_m(car, 25.0), lower_m, 0.001);
  car.lamp_tilt_rad = kDegree_rad;  // levelled
  EXPECT_NEAR(*level - *lamps->cutoff_height_m(car, 25.0), x_m * std::sin(kDegree_rad), 0.001);
  // The wall belongs to the car: turned round and elsewhere it is the same.
  car = {};
  car.yaw_rad = 2.0, car.x_m = 500.0, car.z_m = 30.0;
  EXPECT_NEAR(*lamps->cutoff_height_m(car, 25.0), *level, 1e-9);
}

}  // namespace
}  // namespace phare
