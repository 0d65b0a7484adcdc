// reference: 30 s of a real car (comma2k19), imported; speed and steering against its own decoded table. Skips without
// ../shared.
#include "tools/can_import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "net/wire.h"
#include "tests/paths.h"
#include "tools/csv_columns.h"

namespace phare {
namespace {

const std::filesystem::path kData = shared_data_dir();
const std::filesystem::path kDrives = kData / "drives/comma2k19";

/// A lane along x with a bend of 500 m radius and a grade of 2 %.
std::filesystem::path bent_lane() {
  const auto path = std::filesystem::path(testing::TempDir()) / "phare_import_lane.csv";
  std::ofstream csv(path);
  csv.precision(17);
  csv << "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n";
  constexpr double kRadius = 500.0;
  for (int s = 0; s <= 900; ++s) {
    const double a = s / kRadius;
    csv << s << ',' << kRadius * std::sin(a) << ',' << kRadius * (1 - std::cos(a)) << ',' << 0.02 * s << ',' << a << ','
        << 1 / kRadius << '\n';
  }
  return path;
}

ImportOptions comma_options() {
  ImportOptions options;
  options.can_log = kDrives / "rav4_seg40_bus0_00-30s.candump.log";
  options.dbc = kData / "dbc/opendbc/toyota_nodsu_pt_generated.dbc";
  options.pose = kDrives / "rav4_seg40_pose_00-30s.csv";
  const auto vehicle = read_vehicle(source_dir() + "/config/vehicles/hatchback.toml");
  EXPECT_TRUE(vehicle);
  if (vehicle) options.vehicle = *vehicle;
  return options;
}

class CanImport : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kDrives)) GTEST_SKIP() << "no " << kDrives.string();
  }
};

TEST_F(CanImport, EveryStageIsCounted) {
  const auto drive = import_can_drive(comma_options());
  ASSERT_TRUE(drive) << drive.error().text();
  const ImportCounts& c = drive->counts;
  EXPECT_NEAR(drive->duration_s, 30.0, 0.1);
  EXPECT_EQ(c.frames, c.used + c.other_ids + c.undecodable + c.repeated + c.outside);
  EXPECT_EQ(c.frames + c.broken_lines, 26904u);
  EXPECT_EQ(c.broken_lines, 0u);
  EXPECT_EQ(c.undecodable, 0u);
  EXPECT_GT(c.steering_samples, 2480u);
  EXPECT_GT(c.speed_samples, 1240u);
  EXPECT_GT(c.accelerator_samples, 940u);
  EXPECT_EQ(c.pose_rows, 601u);
  EXPECT_EQ(c.cockpit_messages, drive->datagrams.size() / 2);
  EXPECT_EQ(c.cockpit_messages, static_cast<std::uint64_t>(std::llround(drive->duration_s * 100)) + 1);
  for (const Datagram& datagram : drive->datagrams) ASSERT_EQ(check(datagram), Refusal::kNone);
}

/// Linear between the rows of a table whose times ascend.
double interpolated(const std::vector<double>& t, const std::vector<double>& v, double at) {
  const auto j = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      std::upper_bound(t.begin(), t.end(), at) - t.begin(), 1, static_cast<std::ptrdiff_t>(t.size()) - 1));
  const double u = (at - t[j - 1]) / (t[j] - t[j - 1]);
  return v[j - 1] * (1 - u) + v[j] * u;
}

// The frame of SPEED taken apart here by hand: id 0B4, bytes 5 and 6, big-endian, 0.01 km/h.
TEST_F(CanImport, SpeedIsTheSignalsSpeed) {
  std::ifstream log(kDrives / "rav4_seg40_bus0_00-30s.candump.log");
  std::vector<double> t, speed_mps;
  for (std::string line; std::getline(log, line);) {
    const std::size_t frame = line.find(" 0B4#");
    if (frame == std::string::npos) continue;
    t.push_back(std::stod(line.substr(1)));
    speed_mps.push_back(static_cast<double>(std::stoul(line.substr(frame + 5 + 10, 4), nullptr, 16)) * 0.01 / 3.6);
  }
  const auto drive = import_can_drive(comma_options());
  ASSERT_TRUE(drive) << drive.error().text();
  ASSERT_GT(t.size(), 1000u);
  std::vector<double> off;
  for (const Datagram& datagram : drive->datagrams) {
    const double at = static_cast<double>(datagram.sent.ns) * 1e-9;  // the recorded stamp
    if (const auto* vehicle = std::get_if<VehicleState>(&datagram.payload)) {
      off.push_back(std::abs(vehicle->speed_mps - interpolated(t, speed_mps, at)));
    }
  }
  std::sort(off.begin(), off.end());
  // What smoothing over 0.4 s takes off. The signal jumps by up to 0.27 m/s in 20 ms (5.75 s: a bump under the wheels).
  EXPECT_LT(off[off.size() / 2], 0.02);
  EXPECT_LT(off[off.size() * 98 / 100], 0.12);
  EXPECT_LT(off.back(), 0.35);
  RecordProperty("median_mps", std::to_string(off[off.size() / 2]));
  RecordProperty("p98_mps", std::to_string(off[off.size() * 98 / 100]));
}

// The decoded table's speed is the mean of the wheels, which read 2.1 % less than SPEED in this car (positions: 1.3 %
// less).
TEST_F(CanImport, SpeedAndSteeringFollowTheDecodedTable) {
  const auto drive = import_can_drive(comma_options());
  ASSERT_TRUE(drive) << drive.error().text();
  const std::array<std::string, 3> names{"t_s", "speed_mps", "steer_wheel_deg"};
  const auto table = read_csv_columns(kDrives / "rav4_seg40_can_decoded_00-30s.csv", names);
  ASSERT_TRUE(table) << table.error().text();
  const auto& t = (*table)[0];
  double worst_speed = 0.0, worst_steer = 0.0;
  for (const Datagram& datagram : drive->datagrams) {
    const double at = static_cast<double>(datagram.sent.ns) * 1e-9;
    if (at < t.front() || at > t.back()) continue;
    if (const auto* vehicle = std::get_if<VehicleState>(&datagram.payload)) {
      worst_speed = std::max(worst_speed, std::abs(vehicle->speed_mps / 1.021 - interpolated(t, (*table)[1], at)));
    } else if (const auto* cockpit = std::get_if<CockpitState>(&datagram.payload)) {
      const double steer_deg = cockpit->steering_wheel_rad * 180 / std::numbers::pi;
      worst_steer = std::max(worst_steer, std::abs(steer_deg - interpolated(t, (*table)[2], at)));
    }
  }
  EXPECT_LT(worst_speed, 0.35);  // m/s
  EXPECT_LT(worst_steer, 1.0);   // deg
  RecordProperty("worst_speed_mps", std::to_string(worst_speed));
  RecordProperty("worst_steer_deg", std::to_string(worst_steer));
}

TEST_F(CanImport, KeepsTheRecordedPose) {
  const auto drive = import_can_drive(comma_options());
  ASSERT_TRUE(drive) << drive.error().text();
  const std::array<std::string, 5> names{"t_s", "east_m", "north_m", "up_m", "heading_deg_cw_from_north"};
  const auto table = read_csv_columns(kDrives / "rav4_seg40_pose_00-30s.csv", names);
  ASSERT_TRUE(table);
  const auto& last = std::get<VehicleState>(drive->datagrams.back().payload);
  EXPECT_TRUE(last.drive_ended);
  EXPECT_NEAR(last.x_m, (*table)[1].back(), 0.5);
  EXPECT_NEAR(last.y_m, (*table)[2].back(), 0.5);
  EXPECT_NEAR(last.yaw_rad, std::numbers::pi / 2 - (*table)[4].back() * std::numbers::pi / 180, 0.01);
  EXPECT_NEAR(drive->pose_path_m, 521.0, 2.0);
  EXPECT_NEAR(drive->distance_m / drive->pose_path_m, 1.0129, 0.002);  // SPEED reads that much more than the positions
}

TEST_F(CanImport, OntoALaneKeepsSpeedAndFollowsTheLane) {
  ImportOptions options = comma_options();
  options.lane = bent_lane();
  const auto drive = import_can_drive(options), free = import_can_drive(comma_options());
  ASSERT_TRUE(drive && free);
  const double worst_radius = 0.002;
  for (std::size_t i = 1; i < drive->datagrams.size(); i += 2) {
    const auto& on = std::get<VehicleState>(drive->datagrams[i].payload);
    const auto& off = std::get<VehicleState>(free->datagrams[i].payload);
    EXPECT_EQ(on.speed_mps, off.speed_mps);
    EXPECT_EQ(on.ax_mps2, off.ax_mps2);
    EXPECT_NEAR(std::hypot(on.x_m, on.y_m - 500.0), 500.0, worst_radius);
    EXPECT_NEAR(on.pitch_rad - on.suspension_pitch_rad, -std::atan(0.02), 2e-4);  // uphill: nose up
    // braking presses the nose down, felt acceleration includes the grade
    if (on.ax_mps2 + 0.02 * 9.81 < -0.5) {
      EXPECT_GT(on.suspension_pitch_rad, 0.0);
    }
  }
  EXPECT_EQ(std::get<CockpitState>(drive->datagrams.front().payload).light_switch, LightSwitch::kLow);
}

TEST_F(CanImport, SameInputSameBytes) {
  const auto a = import_can_drive(comma_options()), b = import_can_drive(comma_options());
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->datagrams.size(), b->datagrams.size());
  for (std::size_t i = 0; i < a->datagrams.size(); ++i) ASSERT_EQ(encode(a->datagrams[i]), encode(b->datagrams[i]));
}

TEST_F(CanImport, BadInputIsNamed) {
  ImportOptions options = comma_options();
  options.signals.speed = "SPEED.SPEDE";
  EXPECT_NE(import_can_drive(options).error().text().find("has no signal \"SPEDE\""), std::string::npos);
  options = comma_options();
  options.pose = kDrives / "rav4_seg40_imu_00-30s.csv";
  EXPECT_NE(import_can_drive(options).error().text().find("imu_00-30s.csv:1: no column \"east_m\""), std::string::npos);
  options = comma_options();
  options.can_log = "/nowhere.log";
  EXPECT_FALSE(import_can_drive(options).ok());
}

// What speed and steering alone give for this car, told, not judged: its ratio and the zero of its sensor are not the
// vehicle file's.
TEST_F(CanImport, TellsHowFarSpeedAndSteeringDrift) {
  const auto drive = import_can_drive(comma_options());
  ASSERT_TRUE(drive) << drive.error().text();
  ASSERT_TRUE(drive->drift);
  EXPECT_NEAR(drive->drift->path_m, drive->distance_m, 0.5);
  EXPECT_GT(drive->drift->distance_m, 0.0);
  EXPECT_EQ(to_json(*drive)["drift"]["distance_m"], drive->drift->distance_m);
  std::printf("%s\n", drive->drift->text().c_str());
}

// ---- a car of no make: config/examples/car.dbc, on a log made here

/// 10 s at 10 m/s with the wheel held at 90 degrees to the left; lights: off, low at 2 s, high from 4 to 6 s.
class MadeDrive : public testing::Test {
 protected:
  MadeDrive() : folder_(std::filesystem::path(testing::TempDir()) / "phare_made_drive") {
    std::filesystem::create_directories(folder_);
    std::ofstream log(folder_ / "car.log");
    for (int k = 0; k <= 1000; ++k) {
      const double t_s = 0.01 * k;
      const int light = t_s < 2.0 ? 0 : t_s < 4.0 || t_s >= 6.0 ? 3 : 7;
      char line[200];
      std::snprintf(line, sizeof line,
                    "(%.6f) can0 200#100E000000000000\n(%.6f) can0 201#8403000000000000\n"
                    "(%.6f) can0 204#%02X00000000000000\n",
                    1000.0 + t_s, 1000.0 + t_s + 0.001, 1000.0 + t_s + 0.002, light);
      log << line;
    }
    std::ofstream(folder_ / "car.toml") << "[source]\nkind = \"log\"\ndbc = \"" + kDbc.string() +
                                               "\"\n"
                                               "[control.position]\nmessage = \"LIGHT_STALK\"\nsignal = "
                                               "\"PARKING_LIGHT\"\n"
                                               "[control.low]\nmessage = \"LIGHT_STALK\"\nsignal = \"LOW_BEAM\"\n"
                                               "[control.high]\nmessage = \"LIGHT_STALK\"\nsignal = \"HIGH_BEAM\"\n"
                                               "[control.steering]\nmessage = \"STEER_ANGLE_SENSOR\"\n"
                                               "signal = \"STEER_ANGLE\"\nfine_signal = \"STEER_FRACTION\"\n";
    options_.can_log = folder_ / "car.log";
    options_.dbc = kDbc;
    options_.vehicle = *read_vehicle(source_dir() + "/config/vehicles/hatchback.toml");
    radius_m_ = options_.vehicle.wheelbase_m / std::tan(std::numbers::pi / 2.0 / options_.vehicle.steering_ratio);
  }
  ~MadeDrive() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  static inline const std::filesystem::path kDbc = source_dir() + "/config/examples/car.dbc";
  std::filesystem::path folder_;
  ImportOptions options_;
  double radius_m_ = 0.0;
};

TEST_F(MadeDrive, WithoutAPoseTheCarIsDrivenByItsSteering) {
  options_.start.x_m = 100.0;
  options_.start.y_m = 50.0;
  options_.start.yaw_rad = 0.5;
  const auto drive = import_can_drive(options_);
  ASSERT_TRUE(drive) << drive.error().text();
  EXPECT_FALSE(drive->drift) << "nothing to compare with";
  EXPECT_EQ(drive->counts.pose_rows, 0u);
  // The circle of a wheel that does not slip, to the steps of 0.1 m that its chords are made of: s³/24r² a step of s.
  const double cx = 100.0 - radius_m_ * std::sin(0.5), cy = 50.0 + radius_m_ * std::cos(0.5);
  for (const Datagram& datagram : drive->datagrams) {
    ASSERT_EQ(check(datagram), Refusal::kNone);
    const auto* vehicle = std::get_if<VehicleState>(&datagram.payload);
    if (vehicle == nullptr) continue;
    ASSERT_NEAR(std::hypot(vehicle->x_m - cx, vehicle->y_m - cy), radius_m_, 0.01) << datagram.sim_time.seconds();
    ASSERT_NEAR(vehicle->speed_mps, 10.0, 1e-6);
    const double turned_rad = 10.0 * datagram.sim_time.seconds() / radius_m_;
    ASSERT_NEAR(std::remainder(vehicle->yaw_rad - 0.5 - turned_rad, 2.0 * std::numbers::pi), 0.0, 1e-3);
  }
  const auto again = import_can_drive(options_);
  ASSERT_TRUE(again);
  for (std::size_t i = 0; i < drive->datagrams.size(); ++i)
    ASSERT_EQ(encode(drive->datagrams[i]), encode(again->datagrams[i]));
}

TEST_F(MadeDrive, BrokenLinesAreTold) {
  const auto whole = import_can_drive(options_);
  ASSERT_TRUE(whole) << whole.error().text();
  EXPECT_EQ(whole->notes.front().find("broken"), std::string::npos) << whole->notes.front();
  std::ofstream(options_.can_log, std::ios::app) << "nonsense\n(1010.1) can0 200#100";
  const auto drive = import_can_drive(options_);
  ASSERT_TRUE(drive) << drive.error().text();
  EXPECT_EQ(drive->counts.broken_lines, 2u);
  ASSERT_EQ(drive->notes.size(), whole->notes.size() + 1);
  EXPECT_TRUE(std::ranges::any_of(drive->notes, [](const std::string& note) {
    return note.find("car.log:3004: ") != std::string::npos && note.ends_with("; 2 broken lines are left out");
  }));
}

TEST_F(MadeDrive, UnitsAreKnownOrRefused) {
  std::ifstream file(kDbc);
  const std::string dbc{std::istreambuf_iterator<char>(file), {}};
  const auto imported = [&](const std::string& unit, const std::string& of = "km/h") {
    std::string text = dbc;
    const std::size_t line = text.find(of == "km/h" ? " SG_ SPEED " : " SG_ STEER_FRACTION ");
    const std::size_t at = text.find("\"" + of + "\"", line);
    EXPECT_NE(at, std::string::npos) << of;
    text.replace(at, of.size() + 2, "\"" + unit + "\"");
    options_.dbc = folder_ / "unit.dbc";
    std::ofstream(options_.dbc) << text;
    return import_can_drive(options_);
  };
  // 3600 of hundredths, 100 m in 10 s where it is km/h.
  for (const auto& [unit, distance_m] : {std::pair{"km/h", 100.0},
                                         {"KPH", 100.0},
                                         {"Km/h", 100.0},
                                         {"Unit_KiloMeterPerHour", 100.0},
                                         {"m/s", 360.0},
                                         {"mph", 360.0 * 0.44704},
                                         {"mi/h", 360.0 * 0.44704},
                                         {"knots", 360.0 * 1852.0 / 3600.0},
                                         {"cm/s", 3.6}}) {
    const auto drive = imported(unit);
    ASSERT_TRUE(drive) << drive.error().text();
    EXPECT_NEAR(drive->distance_m, distance_m, 0.01 * distance_m) << unit;
  }
  for (const char* unit : {"", "furlongs", "deg"}) {
    const auto refused = imported(unit);
    ASSERT_FALSE(refused) << unit;
    EXPECT_NE(
        refused.error().text().find("its unit \"" + std::string(unit) + "\" is no speed that is known; --speed-unit"),
        std::string::npos)
        << refused.error().text();
  }
  options_.signals.speed_unit = "km/h";
  const auto stated = imported("furlongs");
  ASSERT_TRUE(stated) << stated.error().text();
  EXPECT_NEAR(stated->distance_m, 100.0, 1.0);
  EXPECT_FALSE(imported("", "deg")) << "a sum has one unit";
}

TEST_F(MadeDrive, APedalThatWasAskedForHasToBeThere) {
  options_.signals.brake = "NOT.THERE";
  EXPECT_TRUE(import_can_drive(options_));
  options_.signals.brake_must = true;
  EXPECT_FALSE(import_can_drive(options_));
}

TEST_F(MadeDrive, ALogWhoseClockWasSetIsNoDrive) {
  const auto whole = import_can_drive(options_);
  ASSERT_TRUE(whole) << whole.error().text();
  for (const char* stamp : {"1600000000.0", "1110.5", "905.0"}) {
    std::ofstream(options_.can_log, std::ios::app) << "(" << stamp << ") can0 200#100E000000000000\n";
    const auto drive = import_can_drive(options_);
    ASSERT_FALSE(drive) << stamp;
    EXPECT_NE(drive.error().text().find("car.log:3004: stamped "), std::string::npos) << drive.error().text();
    std::filesystem::resize_file(options_.can_log,
                                 std::filesystem::file_size(options_.can_log) - std::string(stamp).size() - 29);
  }
}

TEST_F(MadeDrive, OfSeveralBusesOneIsTaken) {
  std::ifstream log(options_.can_log);
  std::string both;
  for (std::string line; std::getline(log, line);) {
    both += line + "\n";
    if (line.find(" 200#") != std::string::npos)
      both += line.substr(0, line.find(" can0")) + " can1 200#0000000000000000\n";
  }
  log.close();
  std::ofstream(options_.can_log) << both;
  const auto mixed = import_can_drive(options_);
  ASSERT_TRUE(mixed) << mixed.error().text();
  EXPECT_TRUE(std::ranges::any_of(mixed->notes, [](const std::string& note) {
    return note.find("can0") != std::string::npos && note.find("can1") != std::string::npos;
  })) << "told";
  options_.interface = "can0";
  const auto one = import_can_drive(options_);
  ASSERT_TRUE(one) << one.error().text();
  EXPECT_NEAR(one->distance_m, 100.0, 0.5);
  options_.interface = "can7";
  EXPECT_FALSE(import_can_drive(options_));
}

TEST_F(MadeDrive, AHoleInTheLogIsBridgedAndTold) {
  std::ifstream log(options_.can_log);
  std::string kept;
  for (std::string line; std::getline(log, line);)
    if (const double t_s = std::stod(line.substr(1)) - 1000.0; t_s < 4.0 || t_s > 6.0) kept += line + "\n";
  log.close();
  std::ofstream(options_.can_log) << kept;
  const auto drive = import_can_drive(options_);
  ASSERT_TRUE(drive) << drive.error().text();
  EXPECT_NEAR(drive->distance_m, 100.0, 0.5);
  for (const Datagram& datagram : drive->datagrams)
    if (const auto* vehicle = std::get_if<VehicleState>(&datagram.payload)) {
      ASSERT_NEAR(vehicle->speed_mps, 10.0, 0.01) << datagram.sim_time.seconds();
    }
  EXPECT_TRUE(std::ranges::any_of(drive->notes, [](const std::string& note) {
    return note.starts_with("speed: no sample for 2.0") && note.ends_with("bridged");
  }));
}

TEST_F(MadeDrive, AgainstAPoseTheDriftIsTold) {
  options_.pose = folder_ / "pose.csv";
  const auto write_pose = [&](double radius_m) {
    std::ofstream csv(options_.pose);
    csv.precision(12);
    csv << "t_s,east_m,north_m,up_m,heading_deg_cw_from_north,path_pitch_deg\n";
    for (int k = 0; k <= 200; ++k) {
      const double s_m = 10.0 * 0.05 * k, a = s_m / radius_m;
      csv << 1000.0 + 0.05 * k << ',' << radius_m * std::sin(a) << ',' << radius_m * (1.0 - std::cos(a)) << ",0,"
          << 90.0 - a * 180.0 / std::numbers::pi << ",0\n";
    }
  };
  write_pose(radius_m_);
  auto drive = import_can_drive(options_);
  ASSERT_TRUE(drive) << drive.error().text();
  // What smoothing over 0.25 s takes off a circle at its end: at most the sagitta of half of it, r(1 - cos(v 0.125/r)).
  EXPECT_LT(drive->drift->distance_m, 0.1);
  EXPECT_NEAR(drive->drift->path_m, 100.0, 0.15) << "to a step of 10 ms";
  // On a way that turns half as much the car that turns whole ends elsewhere: by what geometry says.
  write_pose(2.0 * radius_m_);
  drive = import_can_drive(options_);
  ASSERT_TRUE(drive);
  const double path_m = drive->drift->path_m, a = path_m / radius_m_, b = a / 2.0;
  const double apart_m = std::hypot(radius_m_ * std::sin(a) - 2.0 * radius_m_ * std::sin(b),
                                    radius_m_ * (1.0 - std::cos(a)) - 2.0 * radius_m_ * (1.0 - std::cos(b)));
  EXPECT_NEAR(drive->drift->distance_m, apart_m, 0.2);
  EXPECT_NE(drive->notes.back().find("%"), std::string::npos);
  bool told = false;
  for (const std::string& note : drive->notes) told = told || note.find("would end") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST_F(MadeDrive, ACockpitFileNamesTheControls) {
  options_.light = ImportLight::kAsRecorded;
  const auto by_name = import_can_drive(options_);
  options_.cockpit = *read_cockpit(folder_ / "car.toml");
  options_.signals.steering = "NOT.THERE";  // the cockpit file's is used
  const auto drive = import_can_drive(options_);
  ASSERT_TRUE(drive && by_name) << (drive ? "" : drive.error().text());
  ASSERT_EQ(drive->datagrams.size(), by_name->datagrams.size());
  std::vector<LightSwitch> beams;
  for (std::size_t i = 0; i < drive->datagrams.size(); ++i) {
    ASSERT_EQ(check(drive->datagrams[i]), Refusal::kNone);
    const auto* cockpit = std::get_if<CockpitState>(&drive->datagrams[i].payload);
    if (cockpit == nullptr) continue;
    EXPECT_NEAR(cockpit->steering_wheel_rad, std::numbers::pi / 2.0, 1e-9);
    const double t_s = drive->datagrams[i].sim_time.seconds();
    const LightSwitch beam = t_s < 2.01 ? LightSwitch::kOff : t_s < 4.01 ? LightSwitch::kLow : LightSwitch::kHigh;
    if (t_s < 6.0) {
      EXPECT_EQ(cockpit->light_switch, beam) << t_s;
    }
    if (beams.empty() || beams.back() != cockpit->light_switch) beams.push_back(cockpit->light_switch);
  }
  EXPECT_EQ(beams, (std::vector{LightSwitch::kOff, LightSwitch::kLow, LightSwitch::kHigh, LightSwitch::kLow}));
  options_.cockpit->controls.clear();
  EXPECT_NE(import_can_drive(options_).error().text().find("maps no steering"), std::string::npos);
}

TEST(CsvColumns, ErrorsSayWhere) {
  const auto path = std::filesystem::path(testing::TempDir()) / "phare_csv_test.csv";
  std::ofstream(path) << "# made up\na,b\n1,2\n3,x\n";
  const std::array<std::string, 2> names{"b", "a"};
  EXPECT_EQ(read_csv_columns(path, names).error().text(),
            path.string() + ":4: \"b\": expected a finite number, got \"x\"");
  std::ofstream(path) << "a,b\n1,2\n\n3,4\n";
  const auto columns = read_csv_columns(path, names);
  ASSERT_TRUE(columns);
  EXPECT_EQ((*columns)[0], (std::vector<double>{2, 4}));
  EXPECT_EQ((*columns)[1], (std::vector<double>{1, 3}));
  EXPECT_EQ(read_csv_columns("/nowhere.csv", names).error().text(), "/nowhere.csv: no such file");
}

}  // namespace
}  // namespace phare
