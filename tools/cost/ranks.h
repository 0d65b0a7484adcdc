// Whether two runs of `phare cost` rank the levels alike. Pure: works on what cost.json holds.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare::cost {

/// Pairs of levels that both runs have in a ladder.
struct RanksAlike {
  std::string ladder;
  std::size_t pairs = 0;
  std::size_t opposite_error = 0;  ///< the one is more exact in this run, the other in that
  /// By time, where both runs tell the two levels apart: their medians' 95 % intervals do not overlap.
  std::size_t told_apart = 0;
  std::size_t opposite_time = 0;         ///< of these: the one is cheaper in this run, the other in that
  std::vector<std::string> opposites{};  ///< which: "coarse, medium: time"

  bool alike() const { return opposite_error == 0 && opposite_time == 0; }
};

/// Of every ladder that both runs have. The error: `before` is no cost.json.
Result<std::vector<RanksAlike>> compare_ranks(const nlohmann::json& now, const nlohmann::json& before);

/// What was not the same in the two runs: "size 1280x720, before 640x360". Empty: nothing.
std::vector<std::string> unlike(const nlohmann::json& now, const nlohmann::json& before);

/// Lines for a terminal.
std::string text_of(const std::vector<RanksAlike>& ladders);

}  // namespace phare::cost
