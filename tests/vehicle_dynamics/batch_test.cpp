// Batch runs: files in, files out, and what is wrong with bad ones.
#include "vehicle_dynamics/batch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "full_car.h"

namespace phare {
namespace {

std::string written(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + name;
  std::ofstream(file) << text;
  return file;
}

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

constexpr const char* kBraking =
    "time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,0,0,0\n1.2,0,0,0.3\n2.5,0,0,0.3\n";

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
      {"", "has no header"}};
  for (const auto& [text, expected] : bad) {
    const auto read = batch::read_inputs(written("in.csv", text));
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().text().find(expected), std::string::npos) << read.error().text();
  }
}

int program(const std::string& arguments) {
  const int status = std::system((std::string(PHARE_DYNAMICS_PROGRAM) + " " + arguments + " >/dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Batch, TheProgram) {
  const std::string in = written("program_in.csv", kBraking), out = testing::TempDir() + "program_out.csv";
  const std::string car = std::string(PHARE_VEHICLES_DIR) + "/bmw_320i.toml";
  const std::string base = "--batch " + in + " --out " + out + " --vehicle " + car + " --speed-mps 20";
  EXPECT_EQ(program(base + " --level full --integrator rk4 --step-s 0.002 --levelling dynamic"), 0);
  std::ifstream file(out);
  std::string header, line, last;
  std::getline(file, header);
  EXPECT_EQ(header.rfind("time_s,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,", 0), 0u);
  EXPECT_NE(header.find("cutoff_25m_m"), std::string::npos);
  int rows = 0;
  while (std::getline(file, line)) ++rows, last = line;
  EXPECT_EQ(rows, 251);
  EXPECT_EQ(std::count(last.begin(), last.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_EQ(program(base + " --level best"), 2);
  EXPECT_EQ(program(base + " --level pose"), 2);
  EXPECT_EQ(program(base + " --integrator magic"), 2);
  EXPECT_EQ(program(base + " --step-s 0"), 2);
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + car + " --speed-mps nan"), 2);
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + car + " --speed-mps inf"), 2);
  EXPECT_EQ(program(base + " --road /nonexistent.glb"), 2);
  EXPECT_EQ(program(base + " --roughness F"), 2);
  EXPECT_EQ(program("--batch " + in + " --vehicle " + car), 2);
  EXPECT_EQ(program("--batch /nonexistent.csv --out " + out + " --vehicle " + car), 2);
  std::stringstream text;
  text << std::ifstream(car).rdbuf();
  std::string heavy = text.str();
  heavy.replace(heavy.find("mass_kg = 1093.2952"), 19, "mass_kg = -1093.295");
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + written("bad_car.toml", heavy)), 2);
  std::string wrong_unit = text.str();
  wrong_unit.replace(wrong_unit.find("front_rate_npm = 24453"), 22, "front_rate_npm = 24.45");
  EXPECT_EQ(program("--batch " + in + " --out " + out + " --vehicle " + written("bad_car.toml", wrong_unit)), 2);
}

TEST(Batch, SmallVehicleFileNamesWhatIsMissing) {
  std::stringstream text;
  text << std::ifstream(std::string(PHARE_VEHICLES_DIR) + "/bmw_320i.toml").rdbuf();
  const std::string whole = text.str();
  const Result<VehicleParams> half = read_vehicle(written("half.toml", whole.substr(0, whole.find("[tyre]"))));
  ASSERT_FALSE(half.ok());
  EXPECT_NE(half.error().text().find("tyre"), std::string::npos);
}

}  // namespace
}  // namespace phare
