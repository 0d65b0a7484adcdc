// How good the lamps of a rig are by themselves, for the page of a drive: the verdict of the rule and the HSPR of every
// design's beams, as `phare lamp check` and `phare lamp hspr` give them for the same files.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "config/rig.h"

namespace phare {

/// A row for each beam (low, high, fog) of each design: {"design", "beam", "files", "rules": [{"rule", "verdict",
/// "rows", "failed", "worst"}], "hspr": {"score", "class"} or "hspr_none": why}; or "none": why a beam is not judged. A
/// beam of several sources in a lamp, or of other than one lamp or two, is not judged as one: files are.
nlohmann::json lamp_verdicts(const Rig& rig, const std::filesystem::path& rules_folder);

}  // namespace phare
