// A run from a file of inputs to a file of motion, as fast as it goes: phare-dynamics --batch.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/formats/csv_table.h"
#include "vehicle_dynamics/driver.h"
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

/// What a row shows on demand, by group: bits of Options::columns.
enum RowColumn : unsigned {
  kSlip = 1,           ///< transient longitudinal slip of the wheels
  kSlipAngle = 2,      ///< of the wheels, > 0 pushes to the left
  kTravel = 4,         ///< of the wheels towards the body
  kCamber = 8,         ///< of the wheels against the road: the body's lean, as they have no linkage of their own
  kTorque = 16,        ///< drive and brake torque of the wheels
  kFrictionUsed = 32,  ///< share of the friction ellipse, 0 to 1
  kGear = 64,          ///< gear (1 the first) and engine speed; 0 where torques drive or there is no engine
  kDriver = 128,       ///< road-wheel angle, accelerator and brake
  kEnergy = 256,       ///< see models/energy.h
  kLevel = 512         ///< 0 kinematic, 1 single-track, 2 full
};
/// "slip", "slip-angle", "travel", "camber", "torque", "friction-used", "gear", "driver", "energy", "level".
std::optional<unsigned> column_named(std::string_view name);

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
  double start_x_m = 0.0, start_y_m = 0.0, start_yaw_rad = 0.0;  ///< of the centre of gravity
  DriverOptions driver;                                          ///< instead of the inputs' pedals, steering, or both
  bool ends_at_rest = false;  ///< once braked to a stand, or the driver's path is at its end
  const Road* road = nullptr;
  Resistance resistance = Resistance::kAuto;
  levelling::Kind levelling = levelling::Kind::kNone;
  unsigned columns = 0;                    ///< of RowColumn, on demand
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
  // On demand, in the order of RowColumn.
  std::array<double, 4> slip{}, slip_angle_rad{}, travel_m{}, camber_rad{}, drive_nm{}, brake_nm{}, friction_used_01{};
  double gear = 0.0, engine_rpm = 0.0, steer_rad = 0.0, accelerator_01 = 0.0, brake_01 = 0.0;
  double car_j = 0.0, engine_j = 0.0, brakes_j = 0.0, tyres_j = 0.0, dampers_j = 0.0, air_j = 0.0, road_j = 0.0;
  double level = 0.0;
};

struct Summary {
  std::uint64_t steps = 0, rows = 0;
  double simulated_s = 0.0, wall_s = 0.0;  ///< wall: of the car and its rows, not of what is done with them
  std::uint64_t state_hash = 0;
  bool off_road = false;
  std::optional<double> rolled_over_s;  ///< when a row first showed it: the last row, no car moves on like that
  bool resistance = false;
  std::uint64_t switches = 0;         ///< of level auto
  std::vector<LevelSwitch> switched;  ///< the newest AutoLevel::kKept of them, times since the run's begin
  std::array<double, 3> level_s{};    ///< level auto: spent on each rung
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
/// last three columns are left out; of those on demand only what `columns` names is there.
std::string header(bool lamps, unsigned columns = 0);
void append(const Row& row, bool lamps, std::string& text, unsigned columns = 0);

}  // namespace phare::batch
