// A recorded drive of a real car, CAN log and pose, turned into a drive file.
//
// What: controls from decoded CAN signals, by name or by a cockpit file; motion from CAN speed and a lane, a pose
// table, or the steering (import_motion.h); both every 10 ms from simulated time 0. Source: smoothing by local
// regression (local_fit.h); attitude on the springs as the kinematic level has it at rest. Frame: world x east, y
// north, z up; pose tables say their heading clockwise from north, so yaw = 90° - heading. Leaves out: where on the car
// the recorded position was taken (it is used as the rear axle), camera and IMU records. Test:
// tests/tools/can_import_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/cockpit.h"
#include "config/road/road_surface.h"
#include "config/vehicle.h"
#include "net/messages.h"
#include "tools/import_motion.h"
#include "vehicle_dynamics/state.h"

namespace phare {

enum class ImportLight { kLow, kHigh, kAsRecorded };

/// Where the controls are in the DBC file: "MESSAGE.SIGNAL"; several joined by + are added. Defaults: Toyota (opendbc).
struct ImportSignals {
  std::string steering = "STEER_ANGLE_SENSOR.STEER_ANGLE+STEER_ANGLE_SENSOR.STEER_FRACTION";  ///< left positive
  std::string speed = "SPEED.SPEED";
  std::string accelerator = "GAS_PEDAL.GAS_PEDAL";
  std::string brake = "BRAKE_MODULE.BRAKE_POSITION";
  std::string parking_light = "LIGHT_STALK.PARKING_LIGHT";
  std::string low_beam = "LIGHT_STALK.LOW_BEAM";
  std::string high_beam = "LIGHT_STALK.HIGH_BEAM";
  bool accelerator_must = false, brake_must = false;  ///< that it is not there is an error; else a note
  std::string speed_unit{}, steering_unit{};          ///< in place of the DBC file's; empty: that
};

struct ImportOptions {
  std::filesystem::path can_log;
  std::string interface {};  ///< of a log of several buses; empty: the cockpit file's, or all
  std::filesystem::path dbc;
  std::optional<CockpitConfig> cockpit{};  ///< names the controls in place of `signals`, but for the speed
  std::filesystem::path
      pose;  ///< may be empty: none; CSV t_s, east_m, north_m, up_m, heading_deg_cw_from_north, path_pitch_deg
  std::optional<std::filesystem::path> lane;  ///< CSV of a lane to put the drive onto; none: the pose, or driven
  CarState start{};                           ///< of a drive that is driven, without lane and pose
  double lane_start_m = 15.0;                 ///< where on the lane the drive begins
  ImportLight light = ImportLight::kLow;
  ImportSignals signals;
  VehicleParams vehicle;
  RoadSurface road;  ///< empty: height and grade from the lane
};

/// What became of every frame of the log: frames = used + other_ids + undecodable + repeated + outside, and what came
/// out.
struct ImportCounts {
  std::uint64_t frames = 0;
  std::uint64_t broken_lines = 0;
  std::uint64_t backward_stamps = 0;
  std::uint64_t used = 0;
  std::uint64_t other_ids = 0;    ///< hold no signal asked for
  std::uint64_t undecodable = 0;  ///< right id, but too short or no data frame
  std::uint64_t repeated = 0;     ///< right id, but stamped no later than the one before
  std::uint64_t outside = 0;      ///< outside the time that log and pose share
  std::uint64_t refused = 0;      ///< of those used: by a check of the cockpit file
  std::uint64_t steering_samples = 0, speed_samples = 0, accelerator_samples = 0, brake_samples = 0, light_samples = 0;
  std::uint64_t pose_rows = 0;
  std::uint64_t cockpit_messages = 0, vehicle_messages = 0;
};

struct ImportedDrive {
  std::vector<Datagram> datagrams;  ///< in order of time, numbered, ready to be written
  ImportCounts counts;
  double duration_s = 0.0;
  double distance_m = 0.0;         ///< integral of the CAN speed
  std::optional<Drift> drift;      ///< of CAN speed and steering against the pose, where there is one
  double pose_path_m = 0.0;        ///< length of the recorded positions' path in the same time, for comparison
  std::vector<std::string> notes;  ///< what was put in place of what was not recorded
};

Result<ImportedDrive> import_can_drive(const ImportOptions& options);

nlohmann::json to_json(const ImportedDrive& drive);

}  // namespace phare
