// A rig as a file: what read_rig reads back is the same, number for number.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "config/rig.h"

namespace phare {

/// How the path of a file that a rig names is written.
using PathWords = std::function<std::string(const std::filesystem::path& file)>;

/// "generated/…" for what the build made, else the path from `folder` to a file below it, else the absolute path.
/// `upwards`: also to a file beside or above it, but for the files that come with the program.
PathWords paths_from(const std::filesystem::path& folder, bool upwards = false);

struct RigWords {
  PathWords path;                         ///< required
  std::string heading;                    ///< comment lines at the top, without '#'
  std::vector<std::string> of_designs{};  ///< a comment (several lines) above each design; may be shorter
  bool comments = true;                   ///< say what each key means
};

/// The text of a rig file. A left lamp and its twin are written as one with pair = true.
std::string rig_text(const Rig& rig, const RigWords& words);

/// The comment of "pair = true".
inline constexpr std::string_view kPairSays = "the left one; its twin sits at -y";

/// Shortest decimal that reads back as the same number.
std::string number_word(double value);
std::string vector_word(const glm::dvec3& v);

/// A text in TOML's quotes.
std::string toml_quoted(const std::string& text);

}  // namespace phare
