// Batch runs: files in, files out, and what is wrong with bad ones.
#include "vehicle_dynamics/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "batch_files.h"
#include "full_car.h"
#include "tests/paths.h"

namespace phare {
namespace {

using test::kBraking;
using test::written;

batch::Options options(Level level, Integrator integrator = Integrator::kRk4) {
  batch::Options o;
  o.vehicle = test::car("bmw_320i.toml");
  o.level = level, o.integrator = integrator, o.speed_mps = 20.0;
  return o;
}

batch::Inputs inputs(const std::string& text) {
  Result<batch::Inputs> read = batch::read_inputs(written("in.csv", text));
  if (!read) throw std::runtime_error(read.error().text());
  return *read;
}

TEST(Batch, CutOffFallsUnderBrakingAtEveryLevel) {
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    std::vector<batch::Row> rows;
    const auto done = batch::run(options(level), inputs(kBraking), [&](const batch::Row& row) { rows.push_back(row); });
    ASSERT_TRUE(done.ok());
    ASSERT_EQ(rows.size(), 251u);
    EXPECT_NEAR(rows[100].time_s, 1.0, 1e-9);
    EXPECT_NEAR(rows[90].cutoff_25m_m, 0.65 - 0.25, 0.05);
    const batch::Row& last = rows.back();
    EXPECT_LT(last.ax_mps2, -2.0);
    EXPECT_NEAR(last.pitch_rad, 5.2693e-3 * -last.ax_mps2, 0.2 * last.pitch_rad) << name(level);
    // 25 m of lever and the lamp's own place: 28 m and a little times the pitch.
    EXPECT_NEAR(rows[90].cutoff_25m_m - last.cutoff_25m_m, 28.2 * (last.pitch_rad - rows[90].pitch_rad), 0.06);
  }
}

// One profile is one road: a straight slope of 20 % is driven as 20 % at every level, and a bump lies where the way
// leads, on a circle too.
TEST(Batch, ProfileIsTheSameRoadAtEveryLevel) {
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    Road slope;
    slope.profiles.push_back(*HeightProfile::read(written("slope.csv", "x_m,z_m\n-200,-40\n200,40\n")));
    batch::Options o = options(level);
    o.speed_mps = 0.0, o.road = &slope;
    std::vector<batch::Row> rows;
    const auto note = [&](const batch::Row& row) { rows.push_back(row); };
    ASSERT_TRUE(batch::run(o, inputs("time_s,steer_rad,accelerator_01,brake_01\n0,0,0,1\n4,0,0,1\n"), note).ok());
    // Springs add what the load transfer of standing on a grade gives: m g sin h over the dive stiffness, 10 mrad.
    const double body = -std::atan(0.2) - 5.2693e-3 * 9.81 * std::sin(std::atan(0.2));
    EXPECT_NEAR(rows.back().pitch_rad, body, 5e-4) << name(level);
    for (const double load : rows.front().fz_n) EXPECT_GT(load, 1000.0) << name(level);  // it stands, and does not fall

    Road bump;
    bump.profiles.push_back(HeightProfile::bumps({{.start_m = 60.0, .height_m = 0.05, .length_m = 2.0}}));
    o.road = &bump, o.speed_mps = 6.0, o.resistance = batch::Resistance::kOff;
    rows.clear();
    ASSERT_TRUE(
        batch::run(o, inputs("time_s,steer_rad,accelerator_01,brake_01\n0,0.12,0,0\n14,0.12,0,0\n"), note).ok());
    double highest = 0.0, at_s = 0.0;
    for (const batch::Row& row : rows)
      if (row.z_m > highest) highest = row.z_m, at_s = row.time_s;
    EXPECT_GT(highest, 0.02) << name(level);
    EXPECT_NEAR(at_s, 61.0 / 6.0, 0.6) << name(level);
  }
}

TEST(Batch, ReferenceIntegratorAgreesWithSmallSteps) {
  for (const Level level : {Level::kSingleTrack, Level::kFull}) {
    std::vector<batch::Row> exact, fixed;
    batch::Options o = options(level, Integrator::kReference);
    o.step_s = 0.01;
    const batch::Inputs in = inputs(
        "time_s,steer_rad,torque_fl_nm,torque_fr_nm,torque_rl_nm,torque_rr_nm\n0,0.01,0,0,0,0\n2,0.01,0,0,0,0\n");
    ASSERT_TRUE(batch::run(o, in, [&](const batch::Row& row) { exact.push_back(row); }).ok());
    o.integrator = Integrator::kRk4, o.step_s = 0.0005;
    ASSERT_TRUE(batch::run(o, in, [&](const batch::Row& row) { fixed.push_back(row); }).ok());
    ASSERT_EQ(exact.size(), fixed.size());
    for (std::size_t i = 0; i < exact.size(); ++i) {
      ASSERT_NEAR(exact[i].pitch_rad, fixed[i].pitch_rad, 2e-7);
      ASSERT_NEAR(exact[i].y_m, fixed[i].y_m, 1e-5);
    }
  }
}

TEST(Batch, RowsBetweenStepsAreInterpolated) {
  batch::Options o = options(Level::kFull);
  o.step_s = 0.003;
  std::vector<batch::Row> rows;
  ASSERT_TRUE(batch::run(o, inputs(kBraking), [&](const batch::Row& row) { rows.push_back(row); }).ok());
  ASSERT_EQ(rows.size(), 251u);
  EXPECT_NEAR(rows[50].x_m, 10.0, 0.05);
}

TEST(Batch, BadInputsAreNamedByLine) {
  const std::pair<const char*, const char*> bad[] = {
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,nan,0,0\n", "in.csv:3: column steer_rad"},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,inf,0,0\n", "in.csv:3: column steer_rad"},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,0,2,0\n", "in.csv:3: accelerator_01"},
      {"time_s,steer_rad,accelerator_01,brake_01\n1,0,0,0\n0.5,0,0,0\n", "in.csv:3: time_s does not rise"},
      {"time_s,steer_rad,accelerator_01\n0,0,0\n1,0,0\n", "in.csv:1: has no column brake_01"},
      {"time_s,steer_rad\n0,0\n1,0\n", "in.csv:1: has neither"},
      {"time_s,steer_deg,accelerator_01,brake_01\n0,0,0,0\n1,0,0,0\n", "in.csv:1: column \"steer_deg\""},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n", "two rows"},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0\n1,0,0,0\n", "in.csv:2: column brake_01 is missing"},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,x\n1,0,0,0\n", "in.csv:2: column brake_01"},
      {"time_s,steer_rad,accelerator_01,brake_01,gear\n0,0,0,0,0.5\n1,0,0,0,0\n", "in.csv:2: gear"},
      {"time_s,steer_rad,torque_fl_nm,brake_01\n0,0,0,0\n1,0,0,0\n", "both pedals and wheel torques"},
      {"time_s,time_s\n0,0\n", "in.csv:1: column \"time_s\" comes twice"},
      {"time_s;steer_rad;accelerator_01;brake_01\n0;0;0;0\n1;0;0;0\n",
       "in.csv:1: the header line separates its columns"},
      {"# a comment\ntime_s\tsteer_rad\n0\t0\n", "in.csv:2: the header line separates its columns by tabulators"},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,1e309,0,0\n", "\"1e309\" is too large"},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,+-1,0,0\n", "\"+-1\" is not a finite number"},
      {"time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n5,0,0,0\n20000000,0,0,0\n",
       "in.csv:4: time_s 2e+07 is more"},
      {"\xff\xfet\ni\nm\n", "in.csv:1: is UTF-16"},
      {"time_s,steer_rad,accelerator_01,brake_01\r0,0,0,0\r1,0,0,0\r", "in.csv:1: has carriage returns within"},
      {"", "has no header"}};
  for (const auto& [text, expected] : bad) {
    const auto read = batch::read_inputs(written("in.csv", text));
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().text().find(expected), std::string::npos) << read.error().text();
  }
}

TEST(Batch, NumbersAsTheyAreWritten) {
  const batch::Inputs in =
      inputs("time_s,steer_rad,accelerator_01,brake_01\n0,+0.1,1e-400,0\n+1,-1e-5000,4e-324,+0.5\n");
  EXPECT_EQ(in.steer_rad, (std::vector<double>{0.1, 0.0}));
  EXPECT_EQ(in.accelerator_01, (std::vector<double>{0.0, 4e-324}));
  EXPECT_EQ(in.time_s[1], 1.0);
  EXPECT_EQ(in.brake_01[1], 0.5);
}

TEST(Batch, NoFileTakesAllMemory) {
  EXPECT_NE(batch::read_inputs("/dev/zero").error().text().find("is a device"), std::string::npos);
  EXPECT_NE(batch::read_inputs(written("long.csv", "time_s" + std::string(1 << 21, 'x'))).error().text().find("1 MiB"),
            std::string::npos);
  const std::string large = written("large.csv", "time_s,steer_rad\n");
  std::filesystem::resize_file(large, (2ull << 30) + 1);  // a hole: it takes no room
  const auto read = batch::read_inputs(large);
  std::filesystem::remove(large);
  EXPECT_NE(read.error().text().find("larger than 2 GiB"), std::string::npos);
}

// What a run refuses, by the library: error text of it, empty when it ran.
std::string refusal(const batch::Options& o, const batch::Inputs& in) {
  const auto done = batch::run(o, in, [](const batch::Row&) {});
  return done ? "" : done.error().text();
}

TEST(Batch, RunsOfUnreasonableLengthAreRefused) {
  batch::Inputs in = inputs("time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n100000,0,0,0\n");
  batch::Options o = options(Level::kKinematic);
  o.output_hz = 1000.0;
  EXPECT_NE(refusal(o, in).find("in.csv:3: 100000 s at 1000 Hz are more than 50 million rows"), std::string::npos);
  o.output_hz = 0.01, o.step_s = 1e-5;
  EXPECT_NE(refusal(o, in).find("in.csv:3: 100000 s in steps of 1e-05 s are more than 2e9"), std::string::npos);
  in.time_s[1] = 2e7;
  EXPECT_NE(refusal(o, in).find("in.csv:3: more than 100 hours"), std::string::npos);
  in.time_s[1] = 0.0015, o.step_s = 0.002;
  EXPECT_NE(refusal(o, in).find("in.csv:3: is 0.0015 s after the first row, less than a step"), std::string::npos);
  in.time_s[1] = 0.002;
  EXPECT_EQ(refusal(o, in), "");
}

// A step too long for the method, a road no car can follow: the run ends there, and says where.
TEST(Batch, UnsoundMotionEndsTheRun) {
  std::vector<batch::Row> rows;
  batch::Options o = options(Level::kFull);
  o.step_s = 0.1;
  const auto done = batch::run(o, inputs(kBraking), [&](const batch::Row& row) { rows.push_back(row); });
  ASSERT_FALSE(done.ok());
  const std::string text = done.error().text();
  EXPECT_NE(text.find("in.csv:"), std::string::npos) << text;
  EXPECT_NE(text.find("level full, rk4, step 0.1 s"), std::string::npos) << text;
  EXPECT_NE(text.find("shorter step"), std::string::npos) << text;
  for (const batch::Row& row : rows) EXPECT_TRUE(std::isfinite(row.x_m) && std::isfinite(row.fz_n[0]));
  const batch::Inputs cliff = inputs(
      "time_s,steer_rad,accelerator_01,brake_01,road_fl_m,road_fr_m,road_rl_m,road_rr_m\n0,0,0,0,0,0,0,0\n"
      "0.1,0,0,0,10000,-10000,10000,-10000\n1,0,0,0,0,0,0,0\n");
  EXPECT_NE(refusal(options(Level::kFull), cliff).find("no car's"), std::string::npos);
  o.step_s = 0.002;
  o.stop = [] { return true; };
  EXPECT_NE(refusal(o, inputs(kBraking)).find("stopped"), std::string::npos);
}

// Kinks of friction, every step: the solver used to give up at them, and the rest of the file was written all the same.
TEST(Batch, ReferenceIntegratorBrakes) {
  const batch::Inputs in = inputs(
      "time_s,steer_rad,accelerator_01,brake_01\n0,0,0.2,0\n0.5,0.03,0.2,0\n1,0.03,0,0\n1.2,0.03,0,0.4\n2,0,0,0.4\n");
  for (const Level level : {Level::kSingleTrack, Level::kFull}) {
    std::vector<batch::Row> exact, fixed;
    batch::Options o = options(level, Integrator::kReference);
    o.speed_mps = 25.0, o.step_s = 0.001;
    const auto done = batch::run(o, in, [&](const batch::Row& row) { exact.push_back(row); });
    ASSERT_TRUE(done.ok()) << done.error().text();
    o.integrator = Integrator::kRk4;
    ASSERT_TRUE(batch::run(o, in, [&](const batch::Row& row) { fixed.push_back(row); }).ok());
    ASSERT_EQ(exact.size(), fixed.size());
    for (std::size_t i = 0; i < exact.size(); ++i) {
      ASSERT_NEAR(exact[i].vx_mps, fixed[i].vx_mps, 1e-3) << name(level) << ' ' << exact[i].time_s;
      ASSERT_NEAR(exact[i].pitch_rad, fixed[i].pitch_rad, 1e-5) << name(level) << ' ' << exact[i].time_s;
    }
  }
}

// Where braking wheels come to a stand, and where a tyre reaches its limit in a turn.
TEST(Batch, ReferenceIntegratorStops) {
  const batch::Inputs stop = inputs("time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n0.2,0,0,0.4\n2.5,0,0,0.4\n");
  batch::Options o = options(Level::kFull, Integrator::kReference);
  for (const auto& [speed_mps, step_s] : {std::pair{5.0, 0.005}, {6.0, 0.005}, {7.0, 0.01}, {8.0, 0.005}}) {
    o.speed_mps = speed_mps, o.step_s = step_s;
    EXPECT_EQ(refusal(o, stop), "") << speed_mps;
  }
  o.level = Level::kSingleTrack, o.speed_mps = 25.0;
  const batch::Inputs turn = inputs(
      "time_s,steer_rad,accelerator_01,brake_01\n0,0,0.2,0\n1,0.03,0.2,0\n2,0.03,0,0\n2.2,0.03,0,0.4\n6,0,0,0.4\n");
  EXPECT_EQ(refusal(o, turn), "");
}

TEST(Batch, ReferenceIntegratorSaysWhyItGaveUp) {
  batch::Options o = options(Level::kFull, Integrator::kReference);
  o.step_s = 0.01, o.relaxation_scale = 1e-5;  // slips that follow in 10 ns: more steps than it may take
  testing::internal::CaptureStderr();
  const std::string text = refusal(o, inputs(kBraking));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // SUNDIALS itself is silent
  EXPECT_NE(text.find("gave up"), std::string::npos) << text;
  EXPECT_NE(text.find("in.csv:2: at 0 s, level full, reference, step 0.01 s"), std::string::npos) << text;
  o.level = Level::kSingleTrack, o.single_track.dynamic_attitude = false, o.relaxation_scale.reset();
  EXPECT_NE(refusal(o, inputs(kBraking)).find("--integrator reference"), std::string::npos);
}

TEST(Batch, LampsGoWithTheVehicleAndTheColumn) {
  batch::Options o = options(Level::kFull);
  o.levelling = levelling::Kind::kManual;
  EXPECT_NE(refusal(o, inputs(kBraking)).find("needs the column levelling_step"), std::string::npos);
  const batch::Inputs by_hand =
      inputs("time_s,steer_rad,accelerator_01,brake_01,levelling_step\n0,0,0,0,1\n0.1,0,0,0,1\n");
  EXPECT_EQ(refusal(o, by_hand), "");
  o.levelling = levelling::Kind::kDynamic;
  EXPECT_NE(refusal(o, by_hand).find("needs levelling by hand"), std::string::npos);
  o.vehicle = test::car("bmw_m8.toml"), o.vehicle_place = "bmw_m8.toml";
  EXPECT_NE(refusal(o, inputs(kBraking)).find("bmw_m8.toml: has no table [levelling]"), std::string::npos);
  EXPECT_FALSE(batch::has_lamps(o.vehicle));
  const batch::Row row{};
  for (const bool lamps : {false, true}) {
    std::string line;
    batch::append(row, lamps, line);
    const std::string header = batch::header(lamps);
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
    EXPECT_EQ(header.find("cutoff_25m") != std::string::npos, lamps);
  }
}

TEST(Batch, SteeringBeyondTheLockIsRefusedAtEveryLevel) {
  const batch::Inputs in = inputs("time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,-0.7,0,0\n");
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull})
    EXPECT_NE(refusal(options(level), in).find("in.csv:3: steer_rad -0.7 is beyond the car's lock"), std::string::npos);
}

std::vector<batch::Row> rows_of(const batch::Options& o, const batch::Inputs& in) {
  std::vector<batch::Row> rows;
  const auto done = batch::run(o, in, [&](const batch::Row& row) { rows.push_back(row); });
  if (!done) throw std::runtime_error(done.error().text());
  return rows;
}

// Torques are forces at the wheels: reverse, neutral and park are the pedals' business.
TEST(Batch, GearIsNothingToTorques) {
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    std::vector<double> reached;
    for (const char* gear : {"0", "1", "2", "3"}) {
      std::string text = "time_s,steer_rad,torque_fl_nm,torque_fr_nm,torque_rl_nm,torque_rr_nm,gear\n";
      for (const char* time : {"0", "2"}) text += std::string(time) + ",0,0,0,200,200," + gear + "\n";
      batch::Options o = options(level);
      o.speed_mps = 0.0;
      reached.push_back(rows_of(o, inputs(text)).back().vx_mps);
    }
    // 400 Nm at 0.344 m on 1.2 t: 1 m/s2 less what spins the wheels up.
    EXPECT_GT(reached[0], 1.5) << name(level);
    for (const double speed : reached) EXPECT_EQ(speed, reached[0]) << name(level);
  }
}

// A grade of 15 %: it rolls off, unless the parking brake holds it; with pedals and with torques alike.
TEST(Batch, ParkingBrakeHoldsAtEveryLevel) {
  Road grade;
  grade.slope_x = 0.15;
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull})
    for (const char* drive : {"accelerator_01,brake_01", "torque_fl_nm,torque_fr_nm,torque_rl_nm,torque_rr_nm"}) {
      const std::string still = drive[0] == 'a' ? "0,0" : "0,0,0,0";
      std::array<double, 2> rolled{};
      for (const bool held : {false, true}) {
        std::string text = std::string("time_s,steer_rad,") + drive + ",gear,parking_brake_01\n";
        for (const char* time : {"0", "5"})
          text += std::string(time) + ",0," + still + ",1," + (held ? "1" : "0") + "\n";
        batch::Options o = options(level);
        o.speed_mps = 0.0, o.road = &grade;
        rolled[held] = rows_of(o, inputs(text)).back().x_m;
      }
      EXPECT_LT(rolled[0], -10.0) << name(level) << ' ' << drive;
      EXPECT_NEAR(rolled[1], 0.0, 0.05) << name(level) << ' ' << drive;  // full settles on its tyres
    }
}

// The forces that level kinematic needs of its wheels add up to its motion, as those of level full do.
TEST(Batch, KinematicForcesAddUp) {
  const batch::Inputs in =
      inputs("time_s,steer_rad,accelerator_01,brake_01\n0,0.02,0,0\n3,0.02,0,0\n3.2,0.02,0,0.3\n5,0.02,0,0.3\n");
  const batch::Options o = options(Level::kKinematic);
  const std::vector<batch::Row> flat = rows_of(o, in), whole = rows_of(options(Level::kFull), in);
  for (const std::size_t k : {200u, 450u}) {
    const batch::Row& row = flat[k];
    const double c = std::cos(0.02), s = std::sin(0.02), v = row.vx_mps;
    double down = 0.0, ahead = 0.0, aside = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      down += row.fz_n[i];
      ahead += i < 2 ? row.fx_n[i] * c - row.fy_n[i] * s : row.fx_n[i];
      aside += i < 2 ? row.fx_n[i] * s + row.fy_n[i] * c : row.fy_n[i];
    }
    EXPECT_NEAR(down, o.vehicle.mass_kg * 9.80665, 1e-6);
    EXPECT_NEAR(ahead, o.vehicle.mass_kg * row.ax_mps2 + 0.5 * 1.2041 * o.vehicle.drag_area_m2 * v * v, 1e-6);
    EXPECT_NEAR(aside, o.vehicle.mass_kg * row.ay_mps2, 1e-6);
    // Full shares the roll between its axles by their bars, the loads differ by that: a twentieth of an axle.
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(row.fz_n[i], whole[k].fz_n[i], 300.0) << k << ' ' << i;
  }
}

// A profile lies along the way travelled, in a turn too: half a circle on a rise of 1 in 100.
TEST(Batch, ProfilesAreTravelledInTurns) {
  Result<HeightProfile> rise = HeightProfile::read(written("rise.csv", "x_m,z_m\n-10,-0.1\n500,5\n"));
  ASSERT_TRUE(rise.ok());
  Road road;
  road.profiles.push_back(*rise);
  const batch::Inputs in = inputs("time_s,steer_rad,accelerator_01,brake_01,gear\n0,0.15,0,0,1\n6,0.15,0,0,1\n");
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    batch::Options o = options(level);
    o.speed_mps = 10.0, o.road = &road;
    const std::vector<batch::Row> rows = rows_of(o, in);
    double way_m = 0.0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      way_m += std::hypot(rows[i].x_m - rows[i - 1].x_m, rows[i].y_m - rows[i - 1].y_m);
    EXPECT_GT(way_m - rows.back().x_m, 30.0);
    EXPECT_NEAR(rows.back().z_m, 0.01 * way_m, 0.05) << name(level);
  }
}

// Torques and brakes apart: then negative torque drives backwards. At every level.
TEST(Batch, NegativeTorqueDrivesBackwardsBesideBrakes) {
  const char* columns =
      "time_s,steer_rad,torque_fl_nm,torque_fr_nm,torque_rl_nm,torque_rr_nm,brake_fl_nm,brake_fr_nm,brake_rl_nm,"
      "brake_rr_nm\n";
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    batch::Options o = options(level);
    o.speed_mps = 0.0;
    const auto end_mps = [&](const char* brake) {
      std::string text = columns;
      for (const char* time : {"0", "2"})
        text += std::string(time) + ",0,0,0,-200,-200," + brake + "," + brake + "," + brake + "," + brake + "\n";
      return rows_of(o, inputs(text)).back().vx_mps;
    };
    EXPECT_NEAR(end_mps("0"), -2.0 * 400.0 / 0.344 / 1150.76, 0.03) << name(level);
    EXPECT_NEAR(end_mps("300"), 0.0, 0.01) << name(level);
  }
  const auto alone = batch::read_inputs(written("in.csv", "time_s,steer_rad,accelerator_01,brake_01,brake_fl_nm\n"));
  ASSERT_FALSE(alone.ok());
  EXPECT_NE(alone.error().text().find("brake_fl_nm goes with torque_fl_nm"), std::string::npos);
}

// Level auto in batch is that of a live run: the same switches at the same times, and the same place at the end.
TEST(Batch, AutoIsThatOfALiveRun) {
  batch::Options o = options(Level::kAuto);
  o.vehicle = test::car("hatchback.toml"), o.columns = batch::kLevel;
  o.speed_mps = 10.0;
  const std::string pedals =
      "time_s,steer_rad,accelerator_01,brake_01\n0,0,0.1,0\n2,0,0.1,0\n2.002,0,0,0.7\n6,0,0,0.7\n";
  std::vector<batch::Row> rows;
  const auto done = batch::run(o, inputs(pedals), [&](const batch::Row& row) { rows.push_back(row); });
  ASSERT_TRUE(done.ok()) << done.error().text();

  RunSetup setup;
  setup.level = Level::kAuto, setup.vehicle = o.vehicle;
  setup.sprung = *SprungParams::of(o.vehicle, "hatchback");
  CarState start;
  start.speed_mps = 10.0;
  StepLoop loop(std::move(setup), start);
  loop.set_controls({.accelerator_01 = 0.1});
  loop.run_to(test::seconds(2.0));
  loop.set_controls({.brake_01 = 0.7});
  loop.run_to(test::seconds(6.0));

  ASSERT_EQ(done->switches, loop.choice().switches());
  ASSERT_GE(done->switches, 2u);
  for (std::uint64_t n = 0; n < done->switches; ++n) {
    const LevelSwitch &ours = done->switched[n], &live = loop.choice().change(n);
    EXPECT_EQ(phare::text(ours).substr(0, 12), phare::text(live).substr(0, 12));
    EXPECT_NEAR(ours.time_s, live.time_s, 0.0041) << n;  // a step: batch takes pedals at the step's middle
  }
  // The live car began with its origin at 0, ours with its centre of gravity there.
  EXPECT_NEAR(rows.back().x_m - rows.front().x_m, loop.state().x_m, 0.05);  // of 30 m; the pedal a step earlier is 0.02
  EXPECT_EQ(rows.front().level, 0.0);
  EXPECT_EQ(rows.back().level, 2.0);
  EXPECT_NEAR(done->level_s[0] + done->level_s[1] + done->level_s[2], done->simulated_s, 1e-9);
}

// Heights under the wheels, a wheelbase and a track apart along the road: the same grade and bank at every level.
TEST(Batch, HeightColumnsAreTheSameGradeAtEveryLevel) {
  const VehicleParams car = test::car("bmw_320i.toml");
  const double grade = std::atan(0.25), bank = std::atan(0.1);
  const double up = car.wheelbase_m * std::sin(grade);
  const auto aside = [&](double track) { return track * std::sin(bank) * std::cos(grade); };
  const double f = 0.5 * aside(car.chassis->front_track_m), r = 0.5 * aside(car.chassis->rear_track_m);
  char line[200];
  std::snprintf(line, sizeof line, ",0,0,1,%.15g,%.15g,%.15g,%.15g,1\n", up + f, up - f, r, -r);
  const batch::Inputs in = inputs(
      std::string(
          "time_s,steer_rad,accelerator_01,brake_01,road_fl_m,road_fr_m,road_rl_m,road_rr_m,parking_brake_01\n0") +
      line + "10" + line);
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    batch::Options o = options(level);
    o.speed_mps = 1e-6;  // one that stands settles on its springs first (standing_test.cpp)
    const std::vector<batch::Row> rows = rows_of(o, in);
    EXPECT_NEAR(rows.front().pitch_rad, -grade, 1e-6) << name(level);
    EXPECT_NEAR(rows.front().roll_rad, bank, 1e-4) << name(level);  // the two axles' tracks are not the same
  }
}

TEST(Batch, RollingOverIsSaid) {
  const batch::Inputs cliff = inputs(
      "time_s,steer_rad,accelerator_01,brake_01,road_fl_m,road_fr_m,road_rl_m,road_rr_m\n0,0,0,0,0,0,0,0\n"
      "0.5,0,0,0,0,0,0,0\n0.51,0,0,0,5,0,5,0\n0.6,0,0,0,0,0,0,0\n3,0,0,0,0,0,0,0\n");
  const auto over = batch::run(options(Level::kFull), cliff, [](const batch::Row&) {});
  ASSERT_TRUE(over.ok()) << over.error().text();
  ASSERT_TRUE(over->rolled_over_s.has_value());
  EXPECT_GT(*over->rolled_over_s, 0.5);
  // It ends the run: the rows go up to it.
  const std::vector<batch::Row> rows = rows_of(options(Level::kFull), cliff);
  EXPECT_EQ(rows.size(), over->rows);
  EXPECT_NEAR(rows.back().time_s, *over->rolled_over_s, 1e-9);
  EXPECT_LT(over->simulated_s, 2.9);
  const auto upright = batch::run(options(Level::kFull), inputs(kBraking), [](const batch::Row&) {});
  EXPECT_FALSE(upright->rolled_over_s.has_value());
}

TEST(Batch, TheStartMustBeOnTheRoad) {
  const RoadSurface surface = test::tilted_plane(0.0, 0.0, 50.0);
  Road road;
  road.mesh = &surface;
  batch::Options o = options(Level::kFull);
  o.road = &road;
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    o.level = level, o.start_x_m = 49.5;  // the front wheels are beside it
    EXPECT_NE(refusal(o, inputs(kBraking)).find("--start-x-m: there is no road under the car"), std::string::npos);
    o.start_x_m = 0.0;
    EXPECT_EQ(refusal(o, inputs(kBraking)), "");
  }
}

TEST(Batch, SmallVehicleFileNamesWhatIsMissing) {
  std::stringstream text;
  text << std::ifstream(std::string(vehicles_dir()) + "/bmw_320i.toml").rdbuf();
  const std::string whole = text.str();
  const Result<VehicleParams> half = read_vehicle(written("half.toml", whole.substr(0, whole.find("[tyre]"))));
  ASSERT_FALSE(half.ok());
  EXPECT_NE(half.error().text().find("tyre"), std::string::npos);
}

}  // namespace
}  // namespace phare
