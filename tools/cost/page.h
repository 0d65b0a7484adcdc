// What accuracy costs on this machine, as one page that can be mailed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/cost/ladder.h"

namespace phare::cost {

/// `json`: of the whole run; `plots`: SVG text of each ladder, in their order. Self-contained HTML, no script.
std::string page(const nlohmann::json& json, const std::vector<Ladder>& ladders, const std::vector<std::string>& plots);

}  // namespace phare::cost
