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
  int road_cuts = 0;  ///< how often each triangle of the ground is cut in four
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
struct KeptFile {
  std::filesystem::path file;
  bool stays = false;  ///< the table there counts too and was measured longer: it stays
};
/// Error: it cannot be written.
Result<KeptFile> keep_settings(const SettingsTable& table);

/// One number for all that a scene is read from: its file, the files that a .gltf names, the lane beside it. Error: one
/// of them cannot be read.
Result<std::string> scene_hash(const std::filesystem::path& scene_file);

}  // namespace phare::cost
