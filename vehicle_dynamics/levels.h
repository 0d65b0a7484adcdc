// The levels of the car: each one type, all with the same functions. A level is what changes while it drives, in plain
// numbers, so copying it keeps it whole; what does not change is CarParams, what a step brings is chassis::Input.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>

#include "config/base/result.h"
#include "config/road/lane.h"
#include "config/vehicle.h"
#include "vehicle_dynamics/level.h"
#include "vehicle_dynamics/models/energy.h"
#include "vehicle_dynamics/models/full.h"
#include "vehicle_dynamics/models/kinematic.h"
#include "vehicle_dynamics/models/pose.h"
#include "vehicle_dynamics/models/single_track.h"
#include "vehicle_dynamics/state.h"

namespace phare {

/// The car of levels single-track and full, whose body moves on springs.
struct SprungParams {
  full::Params full;
  single_track::Params single_track;

  /// Error when the vehicle file lacks what the models need.
  static Result<SprungParams> of(const VehicleParams& vehicle, const std::string& place,
                                 const single_track::Options& options = {});
  void set_integrator(Integrator integrator) { full.integrator = single_track.integrator = integrator; }
};

/// How level kinematic counts its way, and what a wheel does beside the road. Two, as live drives and batch runs that
/// were kept repeat bit for bit, and each had its own.
enum class Footing {
  kLive,  ///< at the centre of gravity, by the step's last speed; a wheel beside the road rises with the others
  kBatch  ///< at the rear axle, by the step's mean speed; a wheel beside the road keeps its height
};

/// What a car is made of; does not change while it drives. A level uses what it needs of it.
struct CarParams {
  VehicleParams vehicle;               ///< not needed by level pose
  std::optional<SprungParams> sprung;  ///< needed by single-track, full and auto
  PoseTrack track;                     ///< needed by level pose only
  SimTime step{2'000'000};
  Footing footing = Footing::kLive;
  bool torques_given = false;  ///< not by pedals; kinematic takes no more of them than the car's drive and brakes give
};

/// A car as any level shows it, and all that another level needs to go on from there.
struct Seen {
  CarState state;
  SimTime time{};                 ///< of a recorded drive
  double path_m = 0.0;            ///< travelled by the centre of gravity, on the map
  double side_mps = 0.0;          ///< of the origin, to the left
  double least_load_share = 1.0;  ///< lowest tyre load over its load at rest
  bool off_road = false;          ///< a wheel is, or at level kinematic has been, where there is no surface
};

/// A car that rolls at `speed_mps` on four given heights, its centre of gravity over (x, y).
struct Start {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0, speed_mps = 0.0;
  std::array<double, 4> height_m{};
};

/// The car in numbers, as a row of batch has them.
struct Motion {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;           ///< of the centre of gravity; z over its height at rest
  double u_mps = 0.0, v_mps = 0.0, rise_mps = 0.0;  ///< along the car's axes; along z of car or, single-track, world
  double origin_z_m = 0.0;                          ///< of the car's origin
  double plane_z_m = 0.0;                           ///< of the road under it
  bool turns_wrapped = false;                       ///< forces.yaw_rad lies within one turn
  std::array<double, 4> spin_radps{};
  chassis::Forces forces;
};

/// Of the wheels, on demand; 0 where a level has no such thing.
struct WheelFigures {
  std::array<double, 4> slip{}, slip_angle_rad{}, travel_m{}, camber_rad{}, friction_used_01{};
};

/// A recorded drive: the car is where the record says.
struct PoseLevel {
  static constexpr Level kLevel = Level::kPose;
  static constexpr bool kRecorded = true, kSprung = false, kHeightsAlongRoad = false;
  SimTime time;

  void begin(const CarParams&, const Start&) {}
  void take_over(const CarParams&, const Seen& seen) { time = seen.time; }
  bool stand(const CarParams&, const chassis::Input&) { return true; }
  void advance(const CarParams& p, const chassis::Input&, double) { time.ns += p.step.ns; }
  template <class Reference>
  Status advance_by(Reference&, const CarParams& p, const chassis::Input& in, double dt) {
    advance(p, in, dt);
    return Done{};
  }
  Seen seen(const CarParams& p, const chassis::Input&, double yaw_before_rad) const;
  Motion motion(const CarParams& p, const chassis::Input& in) const;
  WheelFigures figures(const CarParams&, const chassis::Input&, const chassis::Forces&, double) const { return {}; }
  LanePoint place(const CarParams& p) const;
  double speed_mps(const CarParams& p) const;
  powertrain::Wheels wheels(const CarParams& p, const chassis::Input&) const;
  energy::Account open_account(const CarParams&, const chassis::Input&) const { return {}; }
  void account(const CarParams&, const chassis::Input&, const PoseLevel&, double, energy::Account&) const {}
  std::uint64_t hash(const CarState& shown) const { return state_hash(shown); }
  bool sound() const { return true; }
};

struct KinematicLevel {
  static constexpr Level kLevel = Level::kKinematic;
  static constexpr bool kRecorded = false, kSprung = false, kHeightsAlongRoad = false;
  CarState state;
  double way_m = 0.0;  ///< counted as CarParams::footing says
  bool off_road = false;

  void begin(const CarParams& p, const Start& start);
  void take_over(const CarParams& p, const Seen& seen);
  bool stand(const CarParams& p, const chassis::Input& in);
  void advance(const CarParams& p, const chassis::Input& in, double dt);
  template <class Reference>
  Status advance_by(Reference&, const CarParams& p, const chassis::Input& in, double dt) {
    advance(p, in, dt);  // it has an exact method of its own
    return Done{};
  }
  /// Puts it on the road under it; 0: a first placing.
  void place_on_road(const CarParams& p, const chassis::Input& in, double dt);
  Seen seen(const CarParams& p, const chassis::Input&, double yaw_before_rad) const;
  Motion motion(const CarParams& p, const chassis::Input& in) const;
  WheelFigures figures(const CarParams&, const chassis::Input&, const chassis::Forces&, double) const { return {}; }
  LanePoint place(const CarParams& p) const;
  double speed_mps(const CarParams&) const { return state.speed_mps; }
  powertrain::Wheels wheels(const CarParams& p, const chassis::Input&) const;
  energy::Account open_account(const CarParams& p, const chassis::Input& in) const;
  void account(const CarParams& p, const chassis::Input& in, const KinematicLevel& before, double dt,
               energy::Account& to) const;
  std::uint64_t hash(const CarState& shown) const { return state_hash(shown); }
  bool sound() const;
};

struct SingleTrackLevel {
  static constexpr Level kLevel = Level::kSingleTrack;
  static constexpr bool kRecorded = false, kSprung = true, kHeightsAlongRoad = false;
  single_track::State state;

  void begin(const CarParams& p, const Start& start);
  void take_over(const CarParams& p, const Seen& seen);
  bool stand(const CarParams& p, const chassis::Input& in);
  void advance(const CarParams& p, const chassis::Input& in, double dt);
  template <class Reference>
  Status advance_by(Reference& reference, const CarParams& p, const chassis::Input& in, double dt) {
    return reference.advance(p.sprung->single_track, in, state, dt);
  }
  Seen seen(const CarParams& p, const chassis::Input& in, double yaw_before_rad) const;
  Motion motion(const CarParams& p, const chassis::Input& in) const;
  WheelFigures figures(const CarParams& p, const chassis::Input& in, const chassis::Forces& f, double dt) const;
  LanePoint place(const CarParams&) const;
  double speed_mps(const CarParams&) const { return state.u_mps; }
  powertrain::Wheels wheels(const CarParams& p, const chassis::Input&) const;
  energy::Account open_account(const CarParams& p, const chassis::Input& in) const;
  void account(const CarParams& p, const chassis::Input& in, const SingleTrackLevel& before, double dt,
               energy::Account& to) const;
  std::uint64_t hash(const CarState&) const { return state_hash(state); }
  bool sound() const;
};

struct FullLevel {
  static constexpr Level kLevel = Level::kFull;
  static constexpr bool kRecorded = false, kSprung = true, kHeightsAlongRoad = true;
  full::State state;

  void begin(const CarParams& p, const Start& start);
  void take_over(const CarParams& p, const Seen& seen);
  bool stand(const CarParams& p, const chassis::Input& in);
  void advance(const CarParams& p, const chassis::Input& in, double dt);
  template <class Reference>
  Status advance_by(Reference& reference, const CarParams& p, const chassis::Input& in, double dt) {
    return reference.advance(p.sprung->full, in, state, dt);
  }
  Seen seen(const CarParams& p, const chassis::Input& in, double yaw_before_rad) const;
  Motion motion(const CarParams& p, const chassis::Input& in) const;
  WheelFigures figures(const CarParams& p, const chassis::Input& in, const chassis::Forces& f, double dt) const;
  LanePoint place(const CarParams&) const;
  double speed_mps(const CarParams&) const { return state.u_mps; }
  powertrain::Wheels wheels(const CarParams& p, const chassis::Input& in) const;
  energy::Account open_account(const CarParams& p, const chassis::Input& in) const;
  void account(const CarParams& p, const chassis::Input& in, const FullLevel& before, double dt,
               energy::Account& to) const;
  std::uint64_t hash(const CarState&) const { return state_hash(state); }
  bool sound() const;
};

/// What a type must have to be a level. `dt` in seconds throughout.
template <class L>
concept CarLevel = std::is_trivially_copyable_v<L> &&
    requires(L level, const L& now, const CarParams& p, const chassis::Input& in, const Start& start, const Seen& from,
             const chassis::Forces& forces, const CarState& shown, energy::Account& account, double dt) {
  { L::kLevel } -> std::convertible_to<Level>;
  { L::kRecorded } -> std::convertible_to<bool>;          // moves as a record says, driven by nobody
  { L::kSprung } -> std::convertible_to<bool>;            // its body can roll over, and settle on its springs
  { L::kHeightsAlongRoad } -> std::convertible_to<bool>;  // takes heights that are given where its own wheels are
  level.begin(p, start);
  level.take_over(p, from);                      // same pose, speed and rates; wheels and slips where they would settle
  { level.stand(p, in) } -> std::same_as<bool>;  // settles where `in` holds it; false: there is no such place
  level.advance(p, in, dt);
  { now.seen(p, in, dt) } -> std::same_as<Seen>;  // its yaw counts on from the last argument
  { now.motion(p, in) } -> std::same_as<Motion>;
  { now.figures(p, in, forces, dt) } -> std::same_as<WheelFigures>;
  { now.place(p) } -> std::same_as<LanePoint>;  // of the centre of gravity, and the heading
  { now.speed_mps(p) } -> std::same_as<double>;
  { now.wheels(p, in) } -> std::same_as<powertrain::Wheels>;
  { now.open_account(p, in) } -> std::same_as<energy::Account>;
  now.account(p, in, now, dt, account);  // adds a step made from the third argument on
  { now.hash(shown) } -> std::same_as<std::uint64_t>;
  { now.sound() } -> std::same_as<bool>;  // finite, and numbers that a car can have
};

}  // namespace phare
