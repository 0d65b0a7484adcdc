// Vehicle files: those we ship, and what is wrong with bad ones.
#include "config/vehicle.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "test_car.h"
#include "tests/paths.h"
#include "vehicle_dynamics/models/kinematic.h"
#include "vehicle_dynamics/start_pose.h"

namespace phare {
namespace {

std::filesystem::path written(const std::string& name, const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
  std::ofstream(file) << text;
  return file;
}

// The 320i with one piece of text replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::stringstream text;
  text << std::ifstream(std::string(vehicles_dir()) + "/bmw_320i.toml").rdbuf();
  std::string out = text.str();
  const std::size_t where = out.find(from);
  if (where == std::string::npos) throw std::runtime_error("no " + from);
  return out.replace(where, from.size(), to);
}

TEST(Vehicle, ShippedFilesAreGood) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(vehicles_dir())) {
    const Result<VehicleParams> read = read_vehicle(entry.path());
    EXPECT_TRUE(read.ok()) << (read ? "" : read.error().text());
    ++count;
  }
  EXPECT_GE(count, 2);
  EXPECT_EQ(test::car("hatchback.toml").wheelbase_m, 2.63);
}

TEST(Vehicle, HatchbackDivesAndRollsAsItsFileSays) {
  const VehicleParams p = test::car("hatchback.toml");
  EXPECT_NEAR(kinematic::quasi_static_attitude(p, -1.0, 0.0).pitch_rad, 4.5e-3, 0.05e-3);
  EXPECT_NEAR(kinematic::quasi_static_attitude(p, 0.0, 9.81).roll_rad, 0.087, 0.009);
}

TEST(Vehicle, BadFilesAreRefusedWithPlaceAndReason) {
  struct Case {
    std::string from, to, expected;
  };
  for (const Case& c : {Case{"mass_kg = 1093.2952", "mass_kg = -1", "mass_kg"},
                        Case{"track_m", "trakc_m", "track_m"},
                        Case{"wheelbase_m = 2.5789", "wheelbase_m = \"long\"", "wheelbase_m"},
                        Case{"cg_to_front_m = 1.1562", "cg_to_front_m = 2.6", "rear axle"},
                        Case{"roll_stiffness_nmprad = 43670", "roll_stiffness_nmprad = 5000", "upright"},
                        Case{"front_rate_npm = 24453", "front_rate_npm = nan", "front_rate_npm"},
                        Case{"front_rate_npm = 24453", "front_rate_npm = 2445.3", "0.48"},
                        Case{"front_damping_nspm = 1786.24", "front_damping_nspm = 1.786", "damping ratio"},
                        Case{"rear_damping_nspm = 1649.08", "rear_damping_nspm = 178600", "damping ratio"},
                        Case{"wheel_inertia_kgm2 = 1.7", "wheel_inertia_kgm2 = 0", "wheel_inertia_kgm2"},
                        Case{"wheel_inertia_kgm2 = 1.7", "wheel_inertia_kgm2 = 0.05", "wheel_inertia_kgm2"},
                        Case{"yaw_inertia_kgm2 = 1791.5995", "yaw_inertia_kgm2 = 10", "gyration"},
                        Case{"pitch_inertia_kgm2 = 1565.8179", "pitch_inertia_kgm2 = 15658", "gyration"},
                        Case{"roll_inertia_kgm2 = 207.2652", "roll_inertia_kgm2 = 20730", "gyration"},
                        Case{"roll_stiffness_nmprad = 43670", "roll_stiffness_nmprad = 1e8", "springs, bars"},
                        Case{"track_m = 1.3755", "track_m = 2.9", "mean track"},
                        Case{"wheelbase_m = 2.5789", "wheelbase_m = 1.2", "share of the weight"},
                        Case{"tyre_rate_npm = 158294", "tyre_rate_npm = 15829", "springs, bars"},
                        Case{"[drive]", "[drvie]", "drive"},
                        Case{"ratio = 16.0", "ratio = ", "toml"}}) {
    const Result<VehicleParams> read = read_vehicle(written("car.toml", changed(c.from, c.to)));
    ASSERT_FALSE(read.ok()) << c.to;
    EXPECT_NE(read.error().text().find(c.expected), std::string::npos) << read.error().text();
    EXPECT_NE(read.error().place.find("car.toml"), std::string::npos) << read.error().text();
  }
  EXPECT_FALSE(read_vehicle("/nonexistent.toml").ok());
}

TEST(StartPose, FirstRowOfTheLane) {
  EXPECT_EQ(lane_file_of("/a/country_road.glb"), "/a/country_road_lane.csv");
  const auto good =
      start_of_lane(written("lane.csv", "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n0,1,2,3,0.5,0\n1,9,9,9,9,9\n"));
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(good->x_m, 1.0);
  EXPECT_EQ(good->yaw_rad, 0.5);
  EXPECT_EQ(good->contact_z_m[2], 3.0);
  EXPECT_FALSE(start_of_lane(written("lane.csv", "s_m,x_m,y_m\n0,1,2\n")).ok());
  EXPECT_FALSE(start_of_lane(written("lane.csv", "x_m,y_m,z_m,heading_rad\n0,1,2,nan\n")).ok());
  EXPECT_FALSE(start_of_lane(written("lane.csv", "x_m,y_m,z_m,heading_rad\n0,1,oops,0\n")).ok());
  EXPECT_FALSE(start_of_lane(written("lane.csv", "")).ok());
  EXPECT_FALSE(start_of_lane("/nonexistent.csv").ok());
}

}  // namespace
}  // namespace phare
