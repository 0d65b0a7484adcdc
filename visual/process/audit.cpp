#include "visual/process/audit.h"

#include <cmath>

namespace phare {

void AuditStats::add(double gpu_lx, double reference_lx) {
  const double residual_lx = std::abs(gpu_lx - reference_lx);
  residual_lx_.add(residual_lx);
  if (reference_lx > kDim_lx) residual_percent_.add(100.0 * residual_lx / reference_lx);
}

void AuditStats::add(const Lamps& lamps, const VehicleState& pose, std::span<const AuditSample> samples) {
  ++audits_;
  for (const AuditSample& sample : samples) add(sample.illuminance_lx, lamps.illuminance_lx(pose, sample.point));
}

nlohmann::json AuditStats::json() const {
  const auto brief = [](const LogHistogram& residual) -> nlohmann::json {
    return {{"pixels", residual.count()},
            {"max", residual.max()},
            {"p99", residual.percentile(0.99)},
            {"median", residual.percentile(0.5)}};
  };
  return {{"audits", audits_},
          {"pixels", residual_lx_.count()},
          {"residual_lx", brief(residual_lx_)},
          {"residual_percent", brief(residual_percent_)}};
}

}  // namespace phare
