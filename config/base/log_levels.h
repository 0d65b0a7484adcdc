// How much the programs say (spdlog), for --log-level.
#pragma once

#include <string>
#include <vector>

namespace phare {

inline const std::vector<std::string> kLogLevelNames{"trace", "debug", "info", "warn", "error", "off"};

}  // namespace phare
