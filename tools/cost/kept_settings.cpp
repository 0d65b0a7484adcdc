// Tables of settings in the user's cache folder.
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "config/base/content_hash.h"
#include "config/base/whole_file.h"
#include "config/formats/gltf_uri.h"
#include "config/road/lane.h"
#include "tools/cost/measure_settings.h"

namespace phare::cost {
namespace {

/// A path of the environment that is whole; the XDG specification leaves out others.
std::filesystem::path folder_of(const char* name) {
  const char* value = std::getenv(name);
  const std::filesystem::path folder = value == nullptr ? "" : value;
  return folder.is_absolute() ? folder : std::filesystem::path();
}

}  // namespace

std::filesystem::path kept_settings_file(const Validity& validity) {
  std::filesystem::path cache = folder_of("XDG_CACHE_HOME");
  if (cache.empty() && !folder_of("HOME").empty()) cache = folder_of("HOME") / ".cache";
  if (cache.empty()) return {};
  // A newer driver or program writes over what the older one has left.
  const std::string of = validity.rig + "\n" + validity.picture;
  const std::string hash = content_hash(std::as_bytes(std::span(of)));
  return cache / "phare" / ("settings-" + hash.substr(hash.find(':') + 1, 16) + ".json");
}

KeptSettings kept_settings(const Validity& wanted) {
  const std::filesystem::path file = kept_settings_file(wanted);
  if (file.empty()) return {{}, "neither XDG_CACHE_HOME nor HOME names a folder to keep it in"};
  std::ifstream stream(file);
  if (!stream) return {{}, "there is none for this rig and picture yet"};
  const Result<SettingsTable> table = table_of_json(nlohmann::json::parse(stream, nullptr, false));
  if (!table) return {{}, file.string() + ": " + table.error().reason};
  const std::string why_not = why_not_valid(table->validity, wanted);
  if (!why_not.empty()) return {{}, why_not};
  return {*table, {}};
}

Result<KeptFile> keep_settings(const SettingsTable& table) {
  const std::filesystem::path file = kept_settings_file(table.validity);
  if (file.empty()) return Error{"", "neither XDG_CACHE_HOME nor HOME names a folder to keep it in"};
  if (const KeptSettings there = kept_settings(table.validity); there.table && there.table->rounds > table.rounds)
    return KeptFile{file, true};
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  if (failed) return Error{file.parent_path().string(), failed.message()};
  if (const Status written = write_whole_file(file, json_of(table).dump(2) + "\n"); !written) return written.error();
  return KeptFile{file};
}

Result<std::string> scene_hash(const std::filesystem::path& scene_file) {
  const Result<std::string> whole = content_hash_of_gltf(scene_file);
  if (!whole) return whole.error();
  std::string of = *whole;
  std::error_code ignored;
  if (const auto lane = lane_file_of(scene_file); std::filesystem::exists(lane, ignored)) {
    const Result<std::string> hash = content_hash_of_file(lane);
    if (!hash) return hash.error();
    of += " " + *hash;
  }
  return content_hash(std::as_bytes(std::span(of)));
}

}  // namespace phare::cost
