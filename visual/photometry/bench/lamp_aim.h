// The adjuster of a mounted lamp: turned until its cut-off stands where the rule of installation has it.
// Computes: the cut-off of the lamp's passing beam (else its fog beam) by cutoff.h, scanned beside its kink on the flat
// side; all of the lamp's sources turned about their own lateral axis by what is missing, iterated to 0.003°.
// Sources: UN R48 6.2.6.1.2, initial aiming of the passing beam by mounting height h: -1.0 to -1.5 % up to 1.0 m
// (above 0.8 m the maker may choose -1.5 to -2.0 %), -1.5 to -2.0 % above. UN R48 6.3.6.1.2, front fog lamps: -1.5 %
// or lower; for strong ones -1.5 to -2.0 % up to 0.8 m and -2.0 to -2.5 % above, which a file does not tell apart: the
// window here is all of it. Chosen within: the flattest of a passing beam, as headlamps are marked (1 %), and -2 % for
// fog, which is right for each. The clause measures h at the lower edge of the apparent surface; here it is the lamp's
// position. Its limits under load are not looked at.
// Frame: H, V of the car. Left out: turning sideways, FMVSS 108 (VOL and VOR of `phare lamp check`).
// Checked by tests/photometry/mounted_lamp_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "config/rig.h"
#include "visual/photometry/beam/lamp_tables.h"
#include "visual/photometry/bench/cutoff.h"

namespace phare {

/// Where a cut-off is put, and between which values it may stand; percent, negative down.
struct AimLine {
  double line_percent = -1.0, lowest_percent = -1.5, highest_percent = -1.0;
  const char* clause = "UN R48 6.2.6.1.2";
};
/// For a lamp at `height_m` above the road. `function`: kLow or kFog.
AimLine aim_line(LampFunction function, double height_m);

/// Percent of aim as an angle in degrees, and back.
double degrees_of_percent(double percent);
double percent_of_degrees(double degrees);

/// What came of aiming one lamp.
struct LampAiming {
  std::string design, lamp;
  AimConfig::Kind asked = AimConfig::Kind::kAsFiled;
  bool found = false;  ///< a cut-off, that is
  LampFunction function = LampFunction::kLow;
  CutoffShape shape;        ///< as mounted, before the lamp was turned
  double before_deg = 0.0;  ///< elevation of the cut-off then
  double turned_deg = 0.0;  ///< > 0 up
  double after_deg = 0.0;   ///< elevation of the cut-off as it stands now
  double height_m = 0.0;    ///< of the lamp
  AimLine line;
  bool within() const;       ///< the rule's window, to 0.05 %: found, and aimed as a new lamp is to be
  std::string text() const;  ///< one sentence: what was found and done, and why
};

/// Looks for the cut-off of a lamp as it is mounted, and turns the lamp by its `aim`, which is used up: the sources'
/// own pitch holds it then. The tables of all its sources have been added. `found` tells of lamps that are not turned,
/// too.
LampAiming aim_lamp(LampConfig& lamp, const LampTables& tables);

/// Every lamp of a rig whose aim says "cut-off" or degrees; one entry each.
std::vector<LampAiming> aim_lamps(std::vector<DesignConfig>& designs, const LampTables& tables);

/// "low beam", "high beam", "fog", ... for people.
std::string beam_name(LampFunction function);

}  // namespace phare
