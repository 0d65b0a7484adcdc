// The vehicle file: mass, springs, drive and steering of a car. Reader of config/vehicles/*.toml.
// Angles in the file are degrees and power kilowatts where the key says so; here everything is SI.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// Magic Formula with combined slip: the mirror-symmetric subset of PAC2002 (H. B. Pacejka, Tire and Vehicle Dynamics,
/// 3rd ed. 2012, ch. 4) that the CommonRoad tables give. Stiffnesses are slip stiffness over load.
struct TyreParams {
  double long_shape = 0.0, long_peak = 0.0, long_curvature = 0.0, long_stiffness = 0.0;  ///< C, D/Fz, E, K/Fz
  double lat_shape = 0.0, lat_peak = 0.0, lat_curvature = 0.0, lat_stiffness = 0.0;
  /// Weighting of the longitudinal force by side slip: stiffness factor, its fall with kappa, shape, curvature.
  double long_weight = 0.0, long_weight_fall = 0.0, long_weight_shape = 0.0, long_weight_curvature = 0.0;
  double lat_weight = 0.0, lat_weight_fall = 0.0, lat_weight_shape = 0.0, lat_weight_curvature = 0.0;
  double long_relaxation_m = 0.0, lat_relaxation_m = 0.0;  ///< at small slip
  double carcass_damping_nspm = 0.0;  ///< of the contact patch against the rim at 2.7 kN, standing still
};

/// What the levels single-track and full need beyond the kinematic one.
struct ChassisParams {
  double roll_inertia_kgm2 = 0.0;   ///< of the sprung mass about its own centre
  double pitch_inertia_kgm2 = 0.0;  ///< the same
  double yaw_inertia_kgm2 = 0.0;    ///< of the whole car
  double front_axle_kg = 0.0;       ///< unsprung mass, both wheels
  double rear_axle_kg = 0.0;
  double front_track_m = 0.0, rear_track_m = 0.0;
  double front_damping_nspm = 0.0, rear_damping_nspm = 0.0;          ///< at one wheel
  double front_anti_roll_nmprad = 0.0, rear_anti_roll_nmprad = 0.0;  ///< of the bar, per radian of roll
  double tyre_damping_nspm = 0.0;                                    ///< vertical, one tyre
  double anti_squat_01 = 0.0;  ///< share of the load transfer of driving that the rear linkage carries past the spring
  double bump_travel_m = 0.0, rebound_travel_m = 0.0;  ///< from rest with the driver alone to the stops
  double stop_rate_npm = 0.0;                          ///< added beyond them
  double front_sunk_m = 0.0, rear_sunk_m = 0.0;        ///< travel that the load takes at rest
  double brake_front_01 = 0.0, drive_front_01 = 0.0;   ///< front share of brake and drive torque
  double ackermann_01 = 0.0;                           ///< 0: parallel front wheels, 1: all axes meet
  TyreParams tyre;
};

/// Torque curve and automatic gearbox. Without one the drive is the hyperbola of max_drive_force_n and max_power_w.
struct EngineParams {
  std::vector<double> speed_radps, torque_nm;  ///< full load, rising speed
  double idle_radps = 0.0;
  double drag_nm = 0.0;            ///< engine braking at zero accelerator
  std::vector<double> gear_ratio;  ///< first gear first, falling
  double reverse_ratio = 0.0, final_ratio = 0.0, efficiency_01 = 0.0;
  double converter_ratio = 1.0;  ///< torque ratio of the converter at stall
  double shift_up_low_radps = 0.0, shift_up_full_radps = 0.0, shift_down_radps = 0.0;  ///< accelerator 0, 1
};

/// What moves the lamps against the body: the driver's wheel, the load weighed at rest, or the axles' sensors.
enum class LevellingSystem { kWheel, kStatic, kDynamic };

/// Headlamp levelling.
struct LevellingParams {
  LevellingSystem system = LevellingSystem::kWheel;
  double lamp_x_m = 0.0, lamp_height_m = 0.0;  ///< of the lamp, from the car's origin
  double aim_rad = 0.0;                        ///< of the cut-off, > 0 up, at rest
  double manual_step_rad = 0.0;                ///< down per step of the wheel at the dashboard
  double range_rad = 0.0;                      ///< of the actuator, either way
  double rate_radps = 0.0;
  double filter_s = 0.0;  ///< time constant of the dynamic system's axle sensors
};

/// Where the body stands at rest, against the car with its driver alone.
struct RestAttitude {
  double pitch_rad = 0.0;  ///< nose down > 0: a full boot is below 0
  double heave_m = 0.0;    ///< over the rear axle, up > 0
};

/// Passengers and what lies in the boot: a mass at a place of the body.
struct LoadParams {
  double kg = 0.0;
  double x_m = 0.0;  ///< ahead of the rear axle
  double height_m = 0.0;
};

struct VehicleParams {
  std::string name;
  double mass_kg = 0.0;         ///< whole car with driver
  double sprung_mass_kg = 0.0;  ///< body without wheels and axles
  double wheelbase_m = 0.0;
  double cg_to_front_m = 0.0;       ///< centre of gravity to front axle, horizontal
  double cg_height_m = 0.0;         ///< above the ground at rest
  double track_m = 0.0;             ///< mean of front and rear
  double tyre_radius_m = 0.0;       ///< loaded
  double wheel_inertia_kgm2 = 0.0;  ///< spin inertia of one wheel

  double front_rate_npm = 0.0;  ///< spring rate at one front wheel, without the tyre
  double rear_rate_npm = 0.0;
  double tyre_rate_npm = 0.0;  ///< vertical rate of one tyre, in series with the spring
  double anti_dive_01 = 0.0;   ///< share of the front load transfer of braking the linkage carries past the spring
  double roll_stiffness_nmprad = 0.0;  ///< whole car, springs and anti-roll bars in series with the tyres
  double ride_frequency_hz = 0.0;      ///< undamped, of the body on its springs
  double ride_damping = 0.0;           ///< ratio to critical

  double steering_ratio = 0.0;  ///< steering wheel angle over mean road-wheel angle
  double max_steering_wheel_rad = 0.0;
  double max_lateral_mps2 = 0.0;  ///< grip: sharper turns are widened to this

  double max_drive_force_n = 0.0;    ///< at the wheels, accelerator 1, low speed
  double max_power_w = 0.0;          ///< at the wheels
  double max_brake_force_n = 0.0;    ///< brake 1
  double creep_force_n = 0.0;        ///< at the wheels in D and R, accelerator 0, standing; 0: it does not creep
  double creep_speed_mps = 0.0;      ///< where it has faded to nothing, evenly
  double hill_hold_s = 0.0;          ///< how long brakes stay on when the pedal is let go standing, 0: not at all
  double drag_area_m2 = 0.0;         ///< drag coefficient times frontal area
  double rolling_coefficient = 0.0;  ///< rolling resistance over weight

  std::optional<ChassisParams> chassis;  ///< tables [body] and [tyre] of the file
  std::optional<EngineParams> engine;    ///< table [engine]
  LevellingParams levelling;             ///< table [levelling]
  RestAttitude rest;                     ///< what the table [load] does to the body; its masses are in all the above
};

/// The car with more in it: masses, centre of gravity, inertias, where its body rests and what travel is left. The
/// loads are point masses in its middle; springs, tyres and dampers stay. Error's place is empty: a load that leaves no
/// travel, or whose weight the roll stiffness does not hold.
Result<VehicleParams> loaded(const VehicleParams& vehicle, const std::vector<LoadParams>& loads);

/// Reads and checks a vehicle file: all keys, their ranges, and that the centre of gravity lies between the axles and
/// the car does not fall over its roll stiffness.
Result<VehicleParams> read_vehicle(const std::filesystem::path& file);
/// The same from text; `name` stands for the file in messages.
Result<VehicleParams> parse_vehicle(std::string_view text, const std::string& name);

}  // namespace phare
