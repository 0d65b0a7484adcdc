// The measuring instruments of a picture, in one place for the loop: the point that is read, grid, isolux lines, scale,
// reach, probes.csv. What the desk has off costs no work and no pass: `work_done` counts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/desk.h"
#include "visual/process/lamps.h"
#include "visual/process/pick.h"
#include "visual/process/point_reading.h"
#include "visual/process/probe_log.h"
#include "visual/process/probe_plot.h"
#include "visual/process/props.h"
#include "visual/process/road_marks.h"

namespace phare {

class PictureInstruments {
 public:
  /// All four outlive it. `fixed`: street lamps and the moon; null: there are none.
  PictureInstruments(const Desk& desk, const Lamps& lamps, const World& world, RoadLine road, ProbeLog log,
                     const FixedLight* fixed = nullptr);
  PictureInstruments(const Desk&, const Lamps&, World&&, RoadLine, ProbeLog, const FixedLight* = nullptr) = delete;

  const RoadLine& road() const { return road_; }
  /// The moment that a picture shows: what the others speak of.
  struct Moment {
    SimTime time{};
    VehicleState car{};
    const FrameInput* picture = nullptr;  ///< as it is drawn; it outlives the moment
    double aspect = 16.0 / 9.0;           ///< of the picture
    std::optional<Wall> wall{};           ///< that its own view shows
    std::optional<PlacedMesh> own_car{};  ///< the same: its body hides what lies behind it
  };
  void see(const Moment& moment) { moment_ = moment; }
  /// What is seen at a place of the picture.
  std::optional<MeasurePoint> seen_at(double x_01, double y_01) const {
    return pick(world_, *moment_.picture, moment_.aspect, x_01, y_01);
  }

  /// The point of the desk in the world of that moment. Error: there is none, or the picture shows sky there.
  Result<MeasurePoint> point() const;
  /// What is read there.
  Result<PointReading> read() const;
  /// For the overlay: the point, lamp by lamp, and the reach.
  std::vector<std::string> lines() const;
  /// Of the answer to `set point`; empty without one.
  std::string answer() const;
  /// What is drawn over the picture. Isolux lines are found again where `anew`, and seen from the new place in any
  /// case. `shown`: the desk as the picture shows it, which it may not have come to follow yet.
  OverlayMarks marks(bool anew, const Desk& shown);
  OverlayMarks marks(bool anew) { return marks(anew, desk_); }
  /// A row of probes.csv, where one is due. False, once: the disk did not take it.
  bool log();

  std::uint64_t work_done() const { return work_; }

 private:
  RoadMarks beside_own_car(RoadMarks marks) const;
  double lux_at(const MeasurePoint& at) const;
  std::vector<std::optional<double>> probes_lx() const;
  void plot(OverlayMarks& picture);

  const Desk& desk_;
  const Lamps& lamps_;
  const World& world_;
  const FixedLight* fixed_;
  RoadLine road_;
  ProbeLog log_;
  Moment moment_;
  RoadMarks isolux_;
  ProbePlot plot_;
  mutable std::uint64_t work_ = 0;
};

}  // namespace phare
