// The lamps of the rig as they shine now: which sources are lit, their beam images, where they stand in the world.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "config/result.h"
#include "config/rig.h"
#include "net/messages.h"
#include "visual/photometry/beam_image.h"
#include "visual/renderer.h"

namespace phare {

/// Functions that the controls light. Off lights nothing; flash adds high beam whatever the switch; high beam keeps low
/// beam where the rig says so; fog needs the position lights at least.
std::set<LampFunction> lit_functions(const CockpitState& controls, bool high_keeps_low);

class Lamps {
 public:
  static constexpr std::size_t kMostPositions = 8;  ///< what a renderer holds

  /// Reads every table of every design. A file named twice is read once. Error: of the first bad file, or a design with
  /// more than kMostPositions lamps, or a rig without designs.
  static Result<Lamps> load(const Rig& rig);

  /// A beam image that has to go to the renderer's slot `position` now.
  struct Change {
    std::size_t position = 0;
    const BeamImage* image = nullptr;  ///< valid as long as these Lamps
  };

  /// Adopts the controls. Composes a beam image only when a lamp position is lit in a way not seen before, and reports
  /// only slots whose image is another than before. A design index past the last means the last.
  std::vector<Change> set_controls(const CockpitState& controls);

  /// All lamps turned up (positive) together, rad.
  void set_aim(double pitch_rad) { aim_pitch_rad_ = pitch_rad; }

  /// The positions that shine, in the world. The body's rotation is that of `pose`: Rz(yaw)·Ry(pitch)·Rx(roll); what
  /// levelling tilts the lamps by, is in the pose too.
  std::vector<PlacedLamp> placed(const VehicleState& pose) const;

  /// E in lx at a point of the world: float64 from the native tables, no beam image in between. The truth the GPU is
  /// held to.
  double illuminance_lx(const VehicleState& pose, const MeasurePoint& at) const;
  /// The same in the car frame for one set of lit functions of one design: the wall.
  /// `tilt_rad`: of automatic levelling, positive up.
  double illuminance_in_car_lx(std::size_t design, const std::set<LampFunction>& lit, const MeasurePoint& at,
                               double tilt_rad = 0.0) const;

  const std::vector<DesignConfig>& designs() const { return designs_; }
  const DesignConfig& design() const { return designs_[design_]; }
  std::size_t design_index() const { return design_; }
  const std::string& lit_text() const { return lit_text_; }  ///< "low high", for labels
  std::uint64_t compositions() const { return compositions_; }
  std::uint64_t uploads() const { return uploads_; }
  std::uint64_t resampled_images() const;
  struct TableInfo {
    std::string name, content_hash;
    double peak_cd = 0.0, flux_lm = 0.0;
    std::vector<std::string> notes;
  };
  std::vector<TableInfo> tables() const;

 private:
  using SourceMask = std::uint64_t;
  std::string text_of_lit() const;
  SourceMask lit_mask(const LampConfig& lamp, const std::set<LampFunction>& lit) const;
  const BeamImage& image_of(std::size_t design, std::size_t position, SourceMask mask);
  AimedSource aimed(const SourceConfig& source) const;

  std::vector<DesignConfig> designs_;
  bool high_keeps_low_ = true;
  std::map<std::pair<std::string, GammaAxis>, IntensityTable> tables_;  // by file
  std::map<std::tuple<std::size_t, std::size_t, SourceMask>, std::unique_ptr<BeamImage>> images_;
  std::vector<const BeamImage*> shown_;  // per slot
  std::set<LampFunction> lit_;
  std::size_t design_ = 0;
  double aim_pitch_rad_ = 0.0;    // of the program's aim command
  double wheel_pitch_rad_ = 0.0;  // of the driver's aim wheel
  std::string lit_text_;
  std::uint64_t compositions_ = 0;
  std::uint64_t uploads_ = 0;
};

}  // namespace phare
