// Ladders of accuracy: what each level of an approximation is off by and what it costs, and which levels are worth it.
// Pure: no device, no file.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace phare::cost {

/// Errors of a level, in the unit of its ladder.
struct Errors {
  std::optional<double> rms{}, p99{};  ///< where single ones are known
  double max = 0.0;
  std::size_t samples = 0;

  double figure() const { return rms.value_or(max); }  ///< that levels are compared by
};

/// Of absolute differences; all 0 where there are none.
Errors errors_of(std::vector<double> differences);

/// Times of a level, in the unit of its ladder.
struct Times {
  double median = 0.0;
  std::optional<double> p95{};  ///< where single ones were timed
  /// The median of all times lies so near with 95 %, by order statistics (ISO 16269-7:2001); none of fewer than 8.
  std::optional<double> within{};
  std::size_t samples = 0;
};

/// Of single times; all 0 where there are none.
Times times_of(std::vector<double> times);

struct Level {
  std::string name;
  Errors error{};
  Times time{};
  std::optional<std::uint64_t> memory_bytes{};
  std::string note{};      ///< what the figures leave out
  bool efficient = false;  ///< no other level is at once as exact and cheaper, or as cheap and more exact
};

struct Ladder {
  std::string name;        ///< as --ladder has it
  std::string what;        ///< in a sentence
  std::string reference;   ///< what is taken for the truth
  std::string error_unit;  ///< "lx"
  std::string time_unit;   ///< "ms a frame"
  std::vector<Level> levels{};
};

/// Marks the levels that are worth it: by the figure of the error and the median time.
void mark_efficient(Ladder& ladder);

/// Lines for a terminal: a table of the levels, efficient ones with a star.
std::string text_of(const Ladder& ladder);
/// One line a level, with a header once for all ladders.
std::string csv_of(const std::vector<Ladder>& ladders);
nlohmann::json json_of(const Ladder& ladder);

}  // namespace phare::cost
