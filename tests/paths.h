// Where tests find the source, the build and the data. One compilation knows these folders, so that every other object
// file is the same in every clone and comes out of the compiler cache.
#pragma once

#include <string>

namespace phare {

std::string source_dir();                          ///< the clone
std::string build_dir();                           ///< build/<preset> of this build
std::string build_root(const std::string& below);  ///< build/<below>, shared by all presets
std::string shared_data_dir();                     ///< data outside the repository; may be missing
std::string program(const std::string& name);      ///< a program of this build
std::string tests_dir(const std::string& below);   ///< tests/<below>

inline std::string cockpits_dir() {
  return source_dir() + "/config/cockpits";
}
inline std::string vehicles_dir() {
  return source_dir() + "/config/vehicles";
}
inline std::string rules_dir() {
  return source_dir() + "/config/rules";
}
inline std::string lamps_dir() {
  return build_dir() + "/generated/lamps";
}
inline std::string scene_dir() {
  return build_dir() + "/generated/scenes";
}

}  // namespace phare
