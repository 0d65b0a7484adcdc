// A run from a file of inputs to a file of motion, as fast as it goes: phare-dynamics --batch.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/csv_table.h"
#include "vehicle_dynamics/levelling.h"
#include "vehicle_dynamics/reference.h"
#include "vehicle_dynamics/step.h"

namespace phare::batch {

/// What drives the car, at times that rise. Between rows numbers are linear, gear and steps of the wheel are held.
struct Inputs {
  std::vector<double> time_s, steer_rad;
  std::vector<double> accelerator_01, brake_01;  ///< empty when torques are given
  /// < 0 brakes and never turns a wheel backwards; with brake_nm (>= 0) beside it either sign drives.
  std::array<std::vector<double>, 4> torque_nm, brake_nm;
  /// Under the wheels as they stand, a wheelbase and a track apart along the road: on a grade their differences over
  /// those are sines. Empty unless given.
  std::array<std::vector<double>, 4> road_m;
  std::vector<double> gear, parking_01, levelling_step;  ///< optional columns
  std::string file;                                      ///< where they were read, empty: nowhere
  std::vector<std::size_t> line;                         ///< of each row in it

  /// "file:line" of a row, or "inputs, row N".
  std::string place(std::size_t row) const;
};

/// Columns time_s, steer_rad and either accelerator_01, brake_01 or torque_fl_nm … torque_rr_nm; optional road_fl_m …
/// road_rr_m, brake_fl_nm … brake_rr_nm (with torques), gear (0 D, 1 N, 2 R, 3 P), parking_brake_01, levelling_step.
/// Numbers out of range, other columns, time that does not rise or goes on for more than kMostSimulated_s: an Error
/// with file and line.
Result<Inputs> read_inputs(const std::filesystem::path& csv_file);

/// A wrong time cell shall not fill the disk.
inline constexpr double kMostSimulated_s = 100.0 * 3600.0, kMostSteps = 2e9, kMostRows = 50e6;

/// What a level runs with in real time; kinematic has a method of its own.
constexpr Integrator integrator_of(Level level) {
  return level == Level::kSingleTrack ? Integrator::kEtd2 : Integrator::kRk4;
}
const char* name(Integrator integrator);

enum class Resistance { kAuto, kOn, kOff };  ///< kAuto: off when torques are given, they stand for all that pulls

struct Options {
  VehicleParams vehicle;
  std::string vehicle_place;
  Level level = Level::kFull;
  Integrator integrator = Integrator::kRk4;
  single_track::Options single_track;
  double step_s = 0.002;
  double output_hz = 100.0;
  double speed_mps = 0.0;
  double start_x_m = 0.0;
  const Road* road = nullptr;
  Resistance resistance = Resistance::kAuto;
  levelling::Kind levelling = levelling::Kind::kNone;
  std::optional<double> relaxation_scale;  ///< multiplies the tyre's relaxation lengths
  std::function<bool()> stop;              ///< asked now and then; true ends the run with an Error
};

/// One line of output. Position and velocities of the centre of gravity, z from its height at rest; angles of the body
/// in the world; velocities and accelerations along the car's axes; forces in the wheels' heading. Level kinematic has
/// no tyres: its forces are those that its motion needs, on wheels that share them as their loads.
struct Row {
  double time_s = 0.0, x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;
  double roll_rate_radps = 0.0, pitch_rate_radps = 0.0, yaw_rate_radps = 0.0;
  double vx_mps = 0.0, vy_mps = 0.0, ax_mps2 = 0.0, ay_mps2 = 0.0;
  std::array<double, 4> spin_radps{}, fz_n{}, fx_n{}, fy_n{};
  double cutoff_25m_m = 0.0;    ///< height of the cut-off on a wall 25 m ahead, above the plane the car stands on
  double cutoff_25m_z_m = 0.0;  ///< the same above z = 0 of the world
  double lamp_tilt_rad = 0.0;   ///< of the lamps by levelling, > 0 up
};

struct Summary {
  std::uint64_t steps = 0, rows = 0;
  double simulated_s = 0.0, wall_s = 0.0;  ///< wall: of the car and its rows, not of what is done with them
  std::uint64_t state_hash = 0;
  bool off_road = false;
  std::optional<double> rolled_over_s;  ///< when a row first showed it: the last row, no car moves on like that
  bool resistance = false;
};

/// Whether the vehicle file says where its lamps are: else there is no cut-off, and nothing to level.
inline bool has_lamps(const VehicleParams& vehicle) {
  return vehicle.levelling.lamp_height_m > 0.0;
}

/// Runs the inputs; calls `each` for every row. Error: level, integrator, vehicle and inputs do not go together, the
/// inputs are too long or shorter than a step, the start is beside the road, the reference integrator gave up, or a
/// state is not finite or no car's (10 km/s, slopes of 100), with the time and line of it. Rows before that have
/// been handed on.
Result<Summary> run(const Options& options, const Inputs& inputs, const std::function<void(const Row&)>& each);

/// Column names of a row, and a row as text: the fewest digits that read back as the same numbers. Without `lamps` its
/// last three columns are left out.
std::string header(bool lamps);
void append(const Row& row, bool lamps, std::string& text);

}  // namespace phare::batch
