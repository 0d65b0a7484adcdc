// Places and turns of lamps put into the text of a rig file: numbers change where they stand, everything else stays as
// it was written, comments included.
//
// A pair whose lamps no longer mirror each other is written as two lamps. Numbers are rounded to 1e-6 m and 1e-6
// degrees. What is to be written is read again first, and has to say what was wanted of these lamps and what the file
// said before of all else. Checked by tests/tools/rig_edit_test.cpp.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/desk.h"

namespace phare {

/// A lamp as it is to stand in the rig file.
struct SavedMount {
  struct Turn {
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;  ///< positive left, up, right side down
  };
  std::string design, lamp;    ///< "halogen", "headlamp left"
  glm::dvec3 position_m{0.0};  ///< car frame
  std::vector<Turn> sources;   ///< of each, whole: what `aim` of the file does to them is in it, and gone from the file
};

/// The text with these lamps in it. `file`: for messages, and what paths in it are relative to. Error: no rig file, no
/// such design, lamp or number of sources, or written in a way that cannot be edited.
Result<std::string> with_mounts(const std::string& text, const std::filesystem::path& file,
                                std::span<const SavedMount> mounts);

/// The text with these cameras of the user's own in it, in place of those it has. Error: as above.
Result<std::string> with_cameras(const std::string& text, const std::filesystem::path& file,
                                 std::span<const NamedEye> cameras);

/// Reads the rig file as it is now, and writes it with these lamps, and cameras if they are given, to `out` (empty: to
/// itself): whole, or not at all. `out` has to lie in the folder of the rig, for its paths, and is written over only
/// where it is that rig. Error: as above, or the disk's.
Status save_mounts(const std::filesystem::path& rig_file, const std::filesystem::path& out,
                   std::span<const SavedMount> mounts, const std::vector<NamedEye>* cameras = nullptr);

}  // namespace phare
