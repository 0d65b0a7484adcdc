// Everything that can be said of a rig file before it is driven.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/rig.h"

namespace phare {

struct RigFindings {
  std::vector<Error> problems;        ///< it cannot be driven, or not as it stands
  std::vector<std::string> warnings;  ///< it can, but look
  std::vector<std::string> notes;     ///< what every adjuster was turned by
};

/// Reads the rig and every file it names.
RigFindings check_rig(const std::filesystem::path& file);

nlohmann::json as_json(const RigFindings& findings, const std::filesystem::path& file);

}  // namespace phare
