// The levels single-track and full behind one face for the loop: torques in, CarState out, and hand-over between
// levels.
#pragma once

#include <array>

#include "vehicle_dynamics/models/powertrain.h"
#include "vehicle_dynamics/models/single_track.h"
#include "vehicle_dynamics/state.h"

namespace phare {

/// A car whose body moves on springs. One of the two models is alive at a time.
class SprungCar {
 public:
  enum class Model { kSingleTrack, kFull };

  /// Error when the vehicle file lacks what the models need.
  static Result<SprungCar> of(const VehicleParams& vehicle, const std::string& place);

  /// Goes on from what another level shows: same pose, speed and rates; wheels and slips where they would settle.
  /// `path_m`: travelled by the centre of gravity;
  /// `side_mps`: of the origin, to the left.
  void take_over(Model model, const CarState& state, double path_m, double side_mps);

  /// Takes the state of a model that is advanced elsewhere, for state() and for a hand-over.
  void look(Model model, const full::State& full, const single_track::State& single, const full::Input& input);

  /// A car that stands settles where these torques hold it on that road, see full::stand().
  void stand(const powertrain::Torques& torques, const Road& road);

  /// One step. `steering_wheel_rad` must be finite.
  void advance(double steering_wheel_rad, const powertrain::Torques& torques, const Road& road, double dt);

  /// How its wheels turn, for the coming step's torques.
  powertrain::Wheels wheels(const Road& road);

  /// As the other levels show it: angles split into road and springs, origin under the rear axle. The lamps are not the
  /// car's.
  CarState state() const { return shown_; }
  double path_m() const { return model_ == Model::kFull ? full_.path_m : single_.path_m; }
  double side_speed_mps() const { return side_mps_; }  ///< of the origin, to the left
  bool off_road() const { return off_road_; }
  double least_load_share() const { return least_load_share_; }  ///< lowest tyre load over its load at rest
  std::uint64_t hash() const;

  /// All that a step changes, in plain numbers: what a process that takes this one's place goes on from.
  struct Memory {
    Model model = Model::kFull;
    full::State full;
    single_track::State single;
    full::Input input;  ///< without the road
    CarState shown;
    double side_mps = 0.0, least_load_share = 1.0;
    bool off_road = false;
  };
  Memory memory() const;
  void recall(const Memory& memory);
  void set_integrator(Integrator integrator);

 private:
  void show();

  VehicleParams vehicle_;
  full::Params full_params_;
  single_track::Params single_params_;
  Model model_ = Model::kFull;
  full::State full_;
  single_track::State single_;
  full::Input input_;
  CarState shown_;
  double side_mps_ = 0.0, least_load_share_ = 1.0;
  bool off_road_ = false;
};

}  // namespace phare
