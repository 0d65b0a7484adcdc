// A CIE r-table as lobes, so that a vertex can keep what many lamps above a road make of it for an eye from anywhere.
//
// A table (CIE 144:2001) holds for an eye 1° above the road, so under one lamp luminance hangs on β alone, the angle
// beside the plane of sight. At each tan γ it is taken for r(β) = mean + along·cos β + peak/(1 + sharp·(1 − cos β)): a
// diffuse part and the streak toward the eye, whose last term is a Lorentzian in the chord, a Poisson kernel in β. What
// the first two give is one number and one vector however many lamps there are; streaks are kept lamp by lamp
// (FixedRoad, visual/fixed_light.h; shaders/lib/road.h).
//
// asphalt() is our own: smooth functions of tan γ in place of these four numbers, fitted to the standard surface R3.
// The table itself is in print and not here. How far each is off: docs/street-lamps.md; checked by
// tests/photometry/road_lobes_test.cpp.
#pragma once

#include <vector>

#include "visual/photometry/table/surface_luminance.h"

namespace phare {

/// r, 1/sr, at one tan γ.
struct RoadLobe {
  double mean = 0.0, along = 0.0;
  double peak = 0.0, sharp = 0.0;

  double r_per_sr(double cos_beta) const { return mean + along * cos_beta + peak / (1.0 + sharp * (1.0 - cos_beta)); }
};

class RoadLobes {
 public:
  /// Of dry asphalt, near R3.
  static RoadLobes asphalt();
  /// By least squares, at each tan γ of the table for itself, each value weighed by one over itself and a tenth of the
  /// largest beside it; what is 0, as tables have it where there is little, by one over that largest.
  static RoadLobes of(const ReducedLuminanceTable& table);

  /// Straight in tan γ between rows; dark beyond the last.
  RoadLobe at(double tangent) const;
  /// `beta` in degrees, as the table has it; never below 0.
  double r_at(double beta, double tangent) const;
  /// What r_at() says at these nodes.
  ReducedLuminanceTable table(std::vector<double> beta_deg, std::vector<double> tan_gamma) const;

 private:
  std::vector<double> tan_gamma_;
  std::vector<RoadLobe> rows_;
};

}  // namespace phare
