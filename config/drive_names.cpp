#include "config/drive_names.h"

#include <algorithm>
#include <cctype>

namespace phare {
namespace {

constexpr std::size_t kMostOfFileName = 255;  // bytes, of Linux

bool is_number(std::string_view word) {
  return !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c); });
}

/// "PREFIX7SUFFIX"
bool is_numbered(std::string_view name, std::string_view prefix, std::string_view suffix) {
  if (!name.starts_with(prefix)) return false;
  name.remove_prefix(prefix.size());
  if (!name.ends_with(suffix)) return false;
  name.remove_suffix(suffix.size());
  return is_number(name);
}

/// Counts of a process, and what one that is killed while it writes them leaves.
bool is_of_process(std::string_view name) {
  const std::string_view process = name.substr(0, name.find(".json"));
  const std::string_view ending = name.substr(process.size());
  const bool known = process == "cockpit" || process == "dynamics" || is_numbered(process, "visual-", "");
  return known && (ending == ".json" || ending.starts_with(".json.tmp"));
}

}  // namespace

bool is_picture_of_design(std::string_view name) {
  return is_numbered(name, "birds_eye_", ".png") || is_numbered(name, "wall_25m_", ".png");
}

std::string why_no_channel_name(std::string_view name, bool first) {
  if (name.empty()) return "a channel needs a name: its pictures go into a folder of that name";
  const bool plain = name.find_first_of(std::string_view("/\0", 2)) == std::string_view::npos;
  if (!plain || name == "." || name == ".." || name.size() > kMostOfFileName)
    return "is no name of a folder, which its pictures go into";
  const bool taken = std::ranges::count(kDriveFiles, name) > 0 || name == kDriveFrames || is_of_process(name) ||
                     is_picture_of_design(name);
  return taken && !first ? "the folder of a drive has something else of that name, where its pictures go" : "";
}

}  // namespace phare
