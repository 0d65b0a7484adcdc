// unit: every level is the same to whoever drives it, and whoever drives it does not ask which it is.
#include "vehicle_dynamics/car.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "config/base/conventions.h"
#include "full_car.h"
#include "tests/paths.h"

namespace phare {
namespace {

constexpr std::array<Level, 3> kDrivenLevels{Level::kKinematic, Level::kSingleTrack, Level::kFull};

// A type that lacks one of the functions is no level, and Car does not compile with it.
struct WithoutEnergy : KinematicLevel {
  void account() const {}
};
static_assert(CarLevel<KinematicLevel> && !CarLevel<WithoutEnergy>);
static_assert(!CarLevel<kinematic::Push>);

CarParams params_of_hatchback() {
  CarParams p;
  p.vehicle = test::car("hatchback.toml");
  p.sprung = *SprungParams::of(p.vehicle, "");
  return p;
}

TEST(Car, IsOfTheLevelThatWasAskedFor) {
  for (const Level level : {Level::kPose, Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    Car car;
    car.now = Car::of(level);
    EXPECT_EQ(car.level(), level);
    EXPECT_EQ(car.recorded(), level == Level::kPose);
    EXPECT_EQ(car.sprung(), level == Level::kSingleTrack || level == Level::kFull);
  }
  Car car;
  car.now = Car::of(Level::kAuto);
  EXPECT_EQ(car.level(), Level::kKinematic);  // where auto begins
}

// What is shown live and what a row of batch tells are one place and one motion.
TEST(Car, ShowsWhatItsRowsTell) {
  const CarParams p = params_of_hatchback();
  const Road road;
  const double b = p.vehicle.wheelbase_m - p.vehicle.cg_to_front_m, h = p.vehicle.cg_height_m;
  for (const Level level : kDrivenLevels) {
    Car car;
    car.now = Car::of(level);
    car.input.road = &road;
    car.begin(p, {.x_m = 3.0, .y_m = -2.0, .yaw_rad = 0.7, .speed_mps = 12.0, .height_m = {}});
    car.input.steer_rad = 0.02, car.input.steering_wheel_rad = 0.02 * p.vehicle.steering_ratio;
    for (int n = 0; n < 1000; ++n) car.advance(p, 0.002);
    const Motion m = car.motion(p, car.input);
    const CarState s = car.show(p).state;
    const glm::dmat3 body = world_from_car(m.forces.roll_rad, m.forces.pitch_rad, s.yaw_rad);
    // Level kinematic has its centre of gravity straight above the middle between the axles, not leant with the body;
    // b (1 - cos of a pitch of 5 mrad) is 2e-5 m.
    const double leant = car.sprung() ? h : 0.0, far = car.sprung() ? 1e-9 : 1e-4;
    EXPECT_NEAR(m.x_m, s.x_m + b * body[0].x + leant * body[2].x, far) << name(level);
    EXPECT_NEAR(m.y_m, s.y_m + b * body[0].y + leant * body[2].y, far) << name(level);
    EXPECT_NEAR(m.origin_z_m, s.z_m + s.heave_m, 1e-12) << name(level);
    EXPECT_NEAR(m.forces.pitch_rad, s.road_pitch_rad + s.pitch_rad, 1e-12) << name(level);
    EXPECT_NEAR(m.forces.roll_rad, s.road_roll_rad + s.roll_rad, 1e-12) << name(level);
    EXPECT_EQ(m.forces.ground_m, s.contact_z_m) << name(level);
    const LanePoint place = car.place(p);
    EXPECT_EQ(place.x_m, m.x_m);
    EXPECT_EQ(place.y_m, m.y_m);
    EXPECT_EQ(car.speed_mps(p), m.u_mps) << name(level);
    EXPECT_GT(std::abs(std::remainder(s.yaw_rad - 0.7, 6.283185307179586)), 0.05) << name(level);  // it did turn
    EXPECT_GT(s.roll_rad, 1e-3) << name(level);                                                    // and leant
  }
}

// Plain numbers: a copy goes on bit for bit, with an account of its energies or without.
TEST(Car, CopyGoesOnBitForBit) {
  const CarParams p = params_of_hatchback();
  const Road road;
  for (const Level level : kDrivenLevels) {
    Car car;
    car.now = Car::of(level);
    car.input.road = &road;
    car.begin(p, {.speed_mps = 20.0});
    car.input.brake_nm.fill(200.0);
    for (int n = 0; n < 100; ++n) car.advance(p, 0.002);
    Car copy = car;
    energy::Account account = copy.open_account(p);
    const double had_j = account.car_j;
    for (int n = 0; n < 100; ++n) car.advance(p, 0.002), copy.advance(p, 0.002, account);
    EXPECT_EQ(car.hash(car.show(p).state), copy.hash(copy.show(p).state)) << name(level);
    EXPECT_LT(account.car_j, 0.99 * had_j) << name(level);
    EXPECT_GT(account.brakes_j, 0.0) << name(level);
  }
}

// One place visits the variant; the live loop and batch name no level but auto.
TEST(Car, NobodyElseAsksWhichLevelItIs) {
  const std::regex asks(R"((get|get_if|holds_alternative)<(Pose|Kinematic|SingleTrack|Full)Level>)");
  int visits = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() + "/vehicle_dynamics")) {
    const std::string file = entry.path().filename().string();
    if (!entry.is_regular_file() || file == "CMakeLists.txt") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const std::string code = text.str();
    EXPECT_FALSE(std::regex_search(code, asks)) << file;
    if (code.find("std::visit(") != std::string::npos) {
      EXPECT_EQ(file, "car.h");
      ++visits;
    }
    if (file != "step.cpp" && file != "batch_car.h") continue;
    for (const char* level : {"Level::kPose", "Level::kKinematic", "Level::kSingleTrack", "Level::kFull"})
      EXPECT_EQ(code.find(level), std::string::npos) << file << " names " << level;
  }
  EXPECT_EQ(visits, 1);
}

}  // namespace
}  // namespace phare
