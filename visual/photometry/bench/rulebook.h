// The photometric tables of the headlamp rules, as files of config/rules: rows with clause, place and limit, and how
// the lamp is aimed for them. H right positive, V up positive, degrees, for right-hand traffic.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/table/direction.h"

namespace phare {

/// kPoints: each of them; kLine: from point to point; kArea: the rectangle of two corners; kPolygon: inside and edge;
/// kSum: the points' sum; kPeak: the whole beam.
enum class RowShape { kPoints, kLine, kArea, kPolygon, kSum, kPeak };

inline constexpr double kNoMinimum = 0.0;
inline constexpr double kNoMaximum = 1e30;

/// Rows printed without a far end go on to one side as far as the file has data.
enum class OpenSide { kNone, kLeft, kRight, kDown };

struct RuleRow {
  std::string id;
  std::string clause;
  RowShape shape = RowShape::kPoints;
  std::vector<HV> at;
  double min_cd = kNoMinimum;
  double max_cd = kNoMaximum;
  double min_of_peak_01 = 0.0;  ///< at least this share of the beam's highest intensity
  double max_factor = 0.0;      ///< at most this times the intensity of row `max_of`; 0: no such limit
  std::string max_of;
  OpenSide open = OpenSide::kNone;
  double max_led_module_cd = 0.0;  ///< instead of max_cd for a lamp of LED modules; 0: no limit of its own
  std::string unconfirmed;         ///< why the number rests on one source; empty: two sources agree
};

/// Aim by the cut-off: inflection of log E on a vertical scan at `scan_h_deg` put on `line_v_deg`.
struct CutoffAim {
  std::string name;  ///< "cut-off", "VOL", "VOR"
  double scan_h_deg = -2.5;
  double line_v_deg = -0.57;
  double sharpness_min = 0.0;
  double sharpness_max = kNoMaximum;
  std::vector<double> linearity_h_deg;  ///< empty: not asked
  double linearity_max_deg = 0.0;
  std::string clause;       ///< of sharpness and linearity
  std::string unconfirmed;  ///< why line and scan are not sure; empty: they are
};

struct Rulebook {
  std::string id;  ///< "r149-passing-c"
  std::vector<std::string> aliases;
  std::string name;
  std::string document;  ///< with its edition
  std::string clause;
  std::vector<std::string> sources;  ///< where the numbers were read
  std::string function;              ///< "low", "high", "fog"
  std::string market;                ///< where it holds: "ECE", "US"; empty: not said
  bool half_sum = false;             ///< limits hold for half the sum of both sides' lamps
  double flux_min_lm = 0.0;
  std::string flux_or;                 ///< what the clause takes in place of so much flux, not checked; empty: nothing
  std::vector<CutoffAim> cutoff_aims;  ///< empty: as filed; several: the one with the sharpest cut-off is used
  double reaim_left_deg = 0.0, reaim_right_deg = 0.0, reaim_up_deg = 0.0, reaim_down_deg = 0.0;  ///< of the whole beam
  double point_reaim_deg = 0.0;  ///< of each row by itself, any direction (FMVSS 108 S14.2.5)
  std::vector<RuleRow> rows;

  const RuleRow* row(const std::string& row_id) const;
  /// The aim of that name in any case; null: none.
  const CutoffAim* aim(const std::string& aim_name) const;
  bool has_led_module_limits() const;
  /// With the limits for LED modules in place of the others.
  Rulebook for_led_modules() const;
};

/// Reads one rule file. Errors say file:line.
Result<Rulebook> read_rulebook(const std::filesystem::path& file);

/// The rulebook called `name` (id, alias, any case, blanks and underscores as hyphens; or a file) among the files of
/// `folder`. The error names the nearest.
Result<Rulebook> find_rulebook(const std::filesystem::path& folder, const std::string& name);

/// Every rulebook of a folder, by id.
Result<std::vector<Rulebook>> read_rulebooks(const std::filesystem::path& folder);

/// The names that a rulebook's rows have, those of a sum one by one.
std::vector<std::string> names_of_rows(std::span<const Rulebook> rules);

}  // namespace phare
