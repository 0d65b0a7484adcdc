// Everything that a rig names, copied into one folder, so that rig and folder can be moved together.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "config/rig.h"

namespace phare {

class PortableFiles {
 public:
  /// `folder` is not made before copy().
  explicit PortableFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Scene with its lane and buffers, vehicle, cockpit with its DBC, script and further cockpits, key file, every
  /// photometry file with its TILT file, pixels and spectrum. Error: the folder is there already, or something cannot
  /// be copied; then nothing stays.
  Status copy(const Rig& rig);
  /// Where the copy of a file lies, as the rig beside the folder names it.
  std::string word(const std::filesystem::path& file) const;
  std::size_t count() const { return names_.size(); }

 private:
  Status add(const std::filesystem::path& file, const std::string& below);
  Status add_named(const std::filesystem::path& toml, const std::string& below);
  Status add_scene(const std::filesystem::path& scene);
  Status add_rig(const Rig& rig);
  std::string free_name(const std::filesystem::path& file, const std::string& below);

  std::filesystem::path folder_;
  std::map<std::filesystem::path, std::string> names_;  ///< below the folder
  std::set<std::string> taken_;
};

}  // namespace phare
