// The program checks itself: pixels of a frame recomputed in float64.
#pragma once

#include <span>

#include "visual/process/frame_stats.h"
#include "visual/process/lamps.h"

namespace phare {

/// Residuals |GPU - float64| of audited pixels. The share is taken where float64 says more than 0.01 lx.
class AuditStats {
 public:
  static constexpr double kDim_lx = 0.01;

  void add(double gpu_lx, double reference_lx);
  /// Recomputes each sample from the native tables at this pose.
  void add(const Lamps& lamps, const VehicleState& pose, std::span<const AuditSample> samples);

  std::uint64_t audits() const { return audits_; }
  /// {"audits", "pixels", "residual_lx": {"max", "p99", "median"}, "residual_percent": {… where E > 0.01 lx}}
  nlohmann::json json() const;

 private:
  LogHistogram residual_lx_;
  LogHistogram residual_percent_;
  std::uint64_t audits_ = 0;
};

}  // namespace phare
