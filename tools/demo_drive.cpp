#include "tools/demo_drive.h"

#include <filesystem>

namespace phare {
namespace {

namespace fs = std::filesystem;

/// The file of that ending for a scene that lies where our country road does.
std::optional<std::string> drive_of_scene(const Rig& rig, const fs::path& config, const char* ending) {
  const auto ours = read_rig((config / "rigs/country_road.toml").string());
  if (!ours || ours->scene_file.parent_path() != rig.scene_file.parent_path()) return std::nullopt;
  const fs::path file = config / "drives" / (rig.scene_file.stem().string() + ending);
  return fs::exists(file) ? std::optional(file.string()) : std::nullopt;
}

}  // namespace

std::optional<std::string> demo_script(const Rig& rig, const std::filesystem::path& config) {
  return drive_of_scene(rig, config, "_script.toml");
}

std::optional<std::string> demo_recording(const Rig& rig, const std::filesystem::path& config) {
  return drive_of_scene(rig, config, ".pcap");
}

}  // namespace phare
