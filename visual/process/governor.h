// The governor: keeps the frames of a real-time drive within a budget by stepping along levels of the picture, from the
// most accurate to the cheapest. A pure decision over a series of frame times; no clock, no picture.
//
//   Down: p95 of two windows of 40 frames, one after the other, is over the budget. Two, so that what lasts less than
//   that (another program, a page fault, the first picture of a pipeline) moves nothing; 40, so that two frames of a
//   window may be as slow as they like.
//   Up: for three windows one after the other p95, times what the finer level takes more by the measured table, would
//   be below 90 % of the budget. A step up that has to be taken back within ten windows doubles the windows that the
//   next one to that level waits for, up to 96; noise at the edge does not make it hunt.
// Checked by tests/visual_process/governor_test.cpp.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/desk.h"

namespace phare {

/// A level that a running picture can change to.
struct GovernorLevel {
  Method method = Method::kFragment;
  std::size_t shadows = 0;
  std::optional<std::size_t> fog{};  ///< nothing: the air is clear
  double p95_ms = 0.0;               ///< by the measured table; only ratios count

  std::string text() const;  ///< "fragment, shadows soft"
  friend bool operator==(const GovernorLevel&, const GovernorLevel&) = default;
};

/// "fragment soft off 18.25"; fog "-" in clear air. Nothing: it is none.
std::string words_of(const GovernorLevel& level);
std::optional<GovernorLevel> governor_level(const std::string& words);

class Governor {
 public:
  static constexpr std::size_t kWindow = 40;                      ///< frames
  static constexpr int kDownAfter = 2, kUpAfter = 3;              ///< windows
  static constexpr double kUpBelow = 0.9;                         ///< of the budget
  static constexpr int kTakenBackWithin = 10, kLongestWait = 96;  ///< windows

  struct Step {
    double time_s = 0.0;
    std::size_t from = 0, to = 0;  ///< of levels()
    double p95_ms = 0.0;           ///< the fact: of the window that decided
  };

  Governor() = default;  ///< steps nowhere
  /// `levels`: from the most accurate to the cheapest, at least one.
  Governor(double budget_ms, std::vector<GovernorLevel> levels, std::size_t begin_at);

  /// A frame of the level that holds. A step: the next frame is to be drawn at its level.
  std::optional<Step> add(double time_s, double frame_ms);

  bool on() const { return !levels_.empty(); }
  double budget_ms() const { return budget_ms_; }
  std::size_t now() const { return now_; }
  const std::vector<GovernorLevel>& levels() const { return levels_; }
  const std::vector<Step>& steps() const { return steps_; }
  /// "12.30 s: fragment, shadows soft -> fragment, shadows hard: p95 of 40 frames 18.3 ms, budget 16.6 ms".
  std::string text(const Step& step) const;
  /// {"budget_ms", "now", "levels", "steps": [{"time_s", "from", "to", "p95_ms"}]}
  nlohmann::json json() const;

 private:
  std::optional<Step> step_to(std::size_t level, double time_s, double p95_ms);

  double budget_ms_ = 0.0;
  std::vector<GovernorLevel> levels_;
  std::size_t now_ = 0;
  std::vector<double> window_;
  int over_ = 0, room_ = 0;              ///< windows one after the other
  std::vector<int> waits_;               ///< of each level: windows with room before a step up to it
  int since_up_ = kTakenBackWithin + 1;  ///< windows since the last step up
  std::vector<Step> steps_;
};

}  // namespace phare
