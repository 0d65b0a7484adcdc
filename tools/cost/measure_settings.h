// The table of settings of this machine: measured for a rig, and kept in the user's cache folder as long as it counts.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "config/rig.h"
#include "tools/cost/settings.h"
#include "visual/photometry/table/air.h"

namespace phare::cost {

struct SettingsPlan {
  const Rig* rig = nullptr;
  int width_px = 1280, height_px = 720, samples = 1;
  Air air{};
  std::size_t design = 0;  ///< whose low beam is drawn
  std::string device_name{};
  bool quick = true;  ///< fewer places and turns: seconds
  std::function<void(const std::string& doing, double share_01)> progress;
};

/// What a table would have to be of.
Result<Validity> validity_of(const SettingsPlan& plan);

/// Draws the rig's low beam from its first channel's eye at places along the scene's lane (of a scene without one, of
/// the straight at its origin), every level in turn.
Result<SettingsTable> measure_settings(const SettingsPlan& plan);

/// Where tables of this rig and picture are kept: $XDG_CACHE_HOME/phare, else ~/.cache/phare. Empty: nowhere.
std::filesystem::path kept_settings_file(const Validity& validity);

struct KeptSettings {
  std::optional<SettingsTable> table;
  std::string why_not;  ///< where there is none that counts
};
KeptSettings kept_settings(const Validity& wanted);
/// The file; an error where it cannot be written.
Result<std::filesystem::path> keep_settings(const SettingsTable& table);

}  // namespace phare::cost
