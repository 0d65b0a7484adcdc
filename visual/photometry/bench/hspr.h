// HSPR, the headlamp safety performance rating: ranges, widths, flux, glare, points, scores and classes of a pair of
// lamps. Written from the project's notes on the program HSPR 2.1.1, which says that it computes GTB CE-5815; no copy
// of CE-5815 was at hand. Where that method departs from physics both figures are given and named.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/bench/hspr_light.h"

namespace phare {

struct HsprRow {
  std::string id;  ///< "A", "B", ... as in the method
  std::string what;
  std::string unit;                          ///< "m" or "lm"
  std::optional<double> value{}, points{};   ///< the method's, rounded as it rounds; none: a threshold never reached
  std::optional<double> physical{};          ///< the same of the light as it is; none: it has no physical meaning
  std::optional<double> physical_points{};   ///< on the method's scale, unrounded
  double one_point = 0.0, two_points = 0.0;  ///< values that give 1 and 2 points
  double weight = 0.0;
  std::string departure{};  ///< how the method departs from physics in this row
};

struct HsprResult {
  std::vector<HsprRow> rows{};
  double worst = 0.0, best = 0.0;             ///< weighted points that score 1 and 5
  std::optional<double> weighted{}, score{};  ///< none: a row has no points
  std::optional<double> physical_weighted{}, physical_score{};
};

enum class HsprBeam { kFind, kLow, kHigh };

/// Which beam the lamps have, and their aims: the cut-off 1 % down (the method's 0.57°), a driving beam as filed.
/// Refused: a passing beam beside another kind, one for left-hand traffic, and with kFind a flat cut-off, which is
/// neither. The error names the table.
Result<HsprBeam> hspr_beam(std::vector<HsprLamp>& lamps, HsprBeam asked);

HsprResult hspr_low_beam(const std::vector<HsprLamp>& lamps);
HsprResult hspr_high_beam(const std::vector<HsprLamp>& lamps);

/// The method's check that an ADB keeps its dark field; it is not scored.
struct HsprBlockOut {
  std::string situation, lamp;
  double h_from_deg = 0.0, h_to_deg = 0.0, v_deg = 0.0;
  double brightest_cd = 0.0, limit_cd = 0.0;
};

struct HsprAdb {
  std::array<HsprResult, 3> distances;  ///< 50, 100, 200 m; ten rows each
  std::optional<double> score;          ///< their mean
  std::vector<HsprBlockOut> block_out;
};

/// Situations: oncoming at 50, 100, 200 m, then preceding. Lamps as filed.
HsprAdb hspr_adb(const std::array<std::vector<HsprLamp>, 6>& situations);

/// A headlamp system of the beams' scores: who switches decides how much each beam counts.
struct HsprSystem {
  std::string name;               ///< "manual", "automatic", "ADB"
  double mean_performance = 0.0;  ///< MEP
  double score = 0.0;
  std::string grade{};  ///< its class
};
std::vector<HsprSystem> hspr_systems(double low, double high, std::optional<double> adb);

/// Class of a system's score; of a beam alone: of 10 times its score.
std::string hspr_class(double score);

}  // namespace phare
