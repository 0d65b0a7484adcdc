// A direction in a lamp's own angles.
#pragma once

namespace phare {

/// Degrees of goniometer type A: H right positive, V up positive.
struct HV {
  double h_deg = 0.0;
  double v_deg = 0.0;
};

}  // namespace phare
