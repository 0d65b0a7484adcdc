// Stands for reference.cpp where SUNDIALS was not there when Phare was built.
#include "config/base/remedies.h"
#include "vehicle_dynamics/reference.h"

namespace phare {

struct ReferenceIntegrator::Solver {};

ReferenceIntegrator::ReferenceIntegrator() = default;
ReferenceIntegrator::~ReferenceIntegrator() = default;

Status ReferenceIntegrator::there() {
  return Error{"reference integrator", std::string("this build has none; ") + kReferenceRemedy};
}

Status ReferenceIntegrator::advance(const full::Params&, const chassis::Input&, full::State&, double) {
  return there();
}

Status ReferenceIntegrator::advance(const single_track::Params&, const chassis::Input&, single_track::State&, double) {
  return there();
}

}  // namespace phare
