// The settings of the picture that trade accuracy for time, as a table of one machine, and what is picked from it for a
// budget or a tolerance. Pure: no device, no file.
//
// A setting is a level of light (method and beam image), of shadows and of fog. Each ladder is measured by itself:
//   misplaced   Σ|E − E₀| / ΣE₀ over points of the drive, the share of the light that is not where it should be. Shares
//               of the ladders add up at most (triangle inequality), so their sum ranks whole settings.
//   p99         of |E − E₀|/E₀ where there is more than 0.01 lx, of light: what a lux is off by.
//   time        of a frame on the wall, ms. A setting takes what its light takes without shadows and in clear air, and
//               besides what its shadows and its fog took more than none.
// Rules: docs/cost.md, "Budget and tolerance". Checked by tests/tools/settings_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/desk.h"
#include "config/rig.h"
#include "tools/cost/ladder.h"

namespace phare::cost {

/// What is known of a level of one ladder.
struct SettingFigures {
  double misplaced = 0.0;       ///< a share of the light
  std::optional<double> p99{};  ///< a share of the light there; of light only
  double median_ms = 0.0, p95_ms = 0.0;
  double within_ms = 0.0;  ///< as Times::within, of the median; 0 where it is not known

  friend bool operator==(const SettingFigures&, const SettingFigures&) = default;
};

struct LightSetting {
  Method method = Method::kFragment;
  ImageLevel image = ImageLevel::kFloatNodes;
  SettingFigures figures{};

  friend bool operator==(const LightSetting&, const LightSetting&) = default;
};

/// What a table is of; it counts only for the very same.
struct Validity {
  std::string device{};   ///< its name, driver and driver's version
  std::string version{};  ///< of this program, with its commit
  std::string rig{};      ///< hash over the scene's files, lamps and camera
  std::string picture{};  ///< size, samples, visibility

  friend bool operator==(const Validity&, const Validity&) = default;
};

struct SettingsTable {
  Validity validity{};
  std::string measured_at{};  ///< UTC
  int rounds = 0;             ///< frames that each time is taken of
  std::vector<LightSetting> light{};
  /// By level from off; of shadows below kRayShadows, which nothing picks; fog: empty in clear air.
  std::vector<SettingFigures> shadows{}, fog{};

  friend bool operator==(const SettingsTable&, const SettingsTable&) = default;
};

/// Why the table does not count for `wanted`, in words; empty: it does.
std::string why_not_valid(const Validity& table, const Validity& wanted);

nlohmann::json json_of(const SettingsTable& table);
Result<SettingsTable> table_of_json(const nlohmann::json& json);

/// What is not to be picked because the user has set it.
struct FixedSettings {
  std::optional<Method> method{};
  std::optional<ImageLevel> image{};
  std::optional<std::size_t> shadows{}, fog{};
};

struct Setting {
  Method method = Method::kFragment;
  ImageLevel image = ImageLevel::kFloatNodes;
  std::size_t shadows = 0;
  std::optional<std::size_t> fog{};   ///< nothing: the air is clear
  double misplaced = 0.0, p99 = 0.0;  ///< p99: of light
  double worst_share = 0.0;           ///< the largest of what a tolerance is held against
  double median_ms = 0.0, p95_ms = 0.0;
  double within_ms = 0.0;  ///< of the median, if all that is added is off at once

  /// "fragment, float32-native-nodes, shadows soft".
  std::string text() const;
};

/// Every setting that the fixed ones leave.
std::vector<Setting> all_settings(const SettingsTable& table, const FixedSettings& fixed = {});
/// Of these, those that no other beats in both the light they misplace and p95, from the most accurate to the cheapest.
std::vector<Setting> frontier(std::vector<Setting> settings);

struct Pick {
  Setting setting;
  bool holds = true;  ///< false: of a budget, none fits and this is the cheapest; of a tolerance, the most accurate
  std::string why;    ///< in a sentence
};

/// The most accurate setting whose p95 fits; where none does, the cheapest. `settings`: at least one.
Pick pick_for_budget(const std::vector<Setting>& settings, double budget_ms);
/// The cheapest (by median) whose 99 % of lux, and whose misplaced light by shadows and by fog, are within the share.
Pick pick_for_tolerance(const std::vector<Setting>& settings, double share);

/// All settings as a ladder of phare cost: what they misplace in percent of the light, against ms on the wall.
Ladder ladder_of(const SettingsTable& table);

/// What the picture may step along while driving: the frontier of those with the beam image of `picked`, which a
/// running picture cannot change, with `picked` among them.
std::vector<Setting> steps_about(const std::vector<Setting>& settings, const Setting& picked);

}  // namespace phare::cost
