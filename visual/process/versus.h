// Two designs of the lamps on the same drive: the one that shines (A) and another (B), in halves of one picture or by
// turns. Off it holds no lamps and adds no view: `work_done` counts. Checked by tests/visual_process/versus_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "config/desk.h"
#include "visual/process/lamps.h"
#include "visual/renderer.h"

namespace phare {

class Versus {
 public:
  /// Where the beams of B begin among the renderer's.
  static constexpr std::size_t kFirstBeam = kMostLampsOfDesign;

  /// Adopts desk and controls, after A has. What changed of B's beams, with their places among the renderer's.
  std::vector<Lamps::Change> follow(const Desk& desk, const Lamps& shown, CockpitState controls);

  /// As it is now.
  Versus copy() const;
  /// The renderer holds none of B's beams: all are reported again.
  void forget_shown() {
    if (lamps_) lamps_->forget_shown();
  }

  /// B as it shines; none: nothing is compared.
  const Lamps* lamps() const { return lamps_.get(); }
  /// B's lamps in the world, with the places of their beams.
  std::vector<PlacedLamp> placed(const VehicleState& pose) const;
  /// What the eye adapts to: the light of A, or of both in the same measure where two are compared, or a cooler B would
  /// look blue in an eye that only A has adapted. None: all dark.
  std::optional<glm::vec3> light(const Lamps& shown) const;
  /// By turns: B has its half of each second.
  static bool has_turn(const Desk& desk, SimTime now) {
    return desk.compare == Compare::kFlicker && now.ns % 1'000'000'000 >= 500'000'000;
  }
  /// As `compare` has both in one picture; by turns, or off, it stays as it is. The difference or the ratio is of their
  /// own light, by colour (View::kDifference): lamps of others light both.
  void show(FrameInput& frame, Compare compare, const VehicleState& pose, std::span<const PlacedLamp> also,
            std::vector<GlaringLamp> glare) const;
  /// The frame's own view is the left half of what it was, and the right half shows B. `also`: lamps of others that
  /// light both; `glare`: into B's eye.
  void split(FrameInput& frame, const VehicleState& pose, std::span<const PlacedLamp> also,
             std::vector<GlaringLamp> glare) const;

  /// How far B is turned up to have its cut-off where A has it, rad; nothing: it is not asked for, or one of them has
  /// none.
  std::optional<double> aligned_rad() const { return aligned_rad_; }

  std::uint64_t work_done() const { return work_; }

 private:
  void align(const Desk& desk, const Lamps& shown, std::size_t design, Lamps::Mounts mounts);

  std::unique_ptr<Lamps> lamps_;
  std::optional<double> aligned_rad_;
  std::uint64_t work_ = 0;
};

/// Which design stands beside the one that shines; none: the rig has no other.
std::optional<std::size_t> versus_design(const Desk& desk, const Lamps& shown);

/// Error: what the desk compares with the design that shines is that design itself.
Status check_versus(const Desk& desk, std::size_t shining);

/// Takes marks that are of A's light off what shows B.
void keep_to_a(OverlayMarks& marks, const Desk& desk, const Lamps& shown, SimTime now);

/// The line between the halves and the names of both, or of the one that has its turn.
void mark_versus(OverlayMarks& marks, const Desk& desk, const Lamps& shown, const Versus& versus, SimTime now);

}  // namespace phare
