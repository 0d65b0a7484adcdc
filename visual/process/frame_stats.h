// Figures over any number of frames in bounded memory: a histogram with bins 1 % wide.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "visual/effects_of_frame.h"
#include "visual/renderer.h"

namespace phare {

/// Values from 1e-9 to 1e9 in log-spaced bins; percentiles are right within half a percent of the value. Minimum,
/// maximum, count and mean are exact. Smaller values (zero too) count in the lowest bin. Memory: 33 KiB, whatever the
/// count.
class LogHistogram {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    lowest_ = std::min(lowest_, value);
    highest_ = std::max(highest_, value);
    ++bins_[bin_of(value)];
  }

  std::uint64_t count() const { return count_; }
  double min() const { return count_ == 0 ? 0.0 : lowest_; }
  double max() const { return count_ == 0 ? 0.0 : highest_; }
  double mean() const { return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_); }

  /// The value that `share` (0..1) of all values do not exceed (nearest rank); 0 without values.
  double percentile(double share) const {
    if (count_ == 0) return 0.0;
    const auto rank = static_cast<std::uint64_t>(std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(count_)));
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      below += bins_[bin];
      if (below >= std::max<std::uint64_t>(rank, 1)) return std::clamp(middle_of(bin), lowest_, highest_);
    }
    return highest_;
  }

 private:
  static constexpr double kLowest = 1e-9;
  static constexpr double kLogStep = 0.00995033085316808;  // ln 1.01
  static constexpr std::size_t kBins = 4166;               // ln(1e18) / ln(1.01)

  static std::size_t bin_of(double value) {
    if (!(value > kLowest)) return 0;
    return static_cast<std::size_t>(std::min(std::log(value / kLowest) / kLogStep, static_cast<double>(kBins - 1)));
  }
  static double middle_of(std::size_t bin) { return kLowest * std::exp((static_cast<double>(bin) + 0.5) * kLogStep); }

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double sum_ = 0.0;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

/// {"count", "min", "median", "mean", "p95", "p99", "max"}; of nothing the count alone.
inline nlohmann::json to_json(const LogHistogram& histogram) {
  if (histogram.count() == 0) return {{"count", 0}};
  return {{"count", histogram.count()},
          {"min", histogram.min()},
          {"median", histogram.percentile(0.50)},
          {"mean", histogram.mean()},
          {"p95", histogram.percentile(0.95)},
          {"p99", histogram.percentile(0.99)},
          {"max", histogram.max()}};
}

/// Times of the frames of a run, ms.
struct FrameStats {
  LogHistogram wall_ms;             ///< every frame that was timed
  LogHistogram wall_no_capture_ms;  ///< frames whose picture was not read back
  LogHistogram gpu_ms;              ///< frames whose picture was not read back
  LogHistogram interval_ms;         ///< from the end of one frame to the end of the next, waiting included
  std::map<std::string, LogHistogram> pass_ms;  ///< every frame that was timed: reading back is a pass of its own
  std::map<Effect, LogHistogram> effect_ms;     ///< frames in which it has a pass
  LogHistogram other_ms;                        ///< every frame that was timed: passes that no effect calls for
  std::uint64_t frames = 0;
  std::uint64_t frames_before = 0;  ///< in real time: of a process that this one took the place of
  std::uint64_t captured_frames = 0;
  std::uint64_t stale_frames = 0;   ///< drawn with a held pose
  std::uint64_t making_frames = 0;  ///< that had to make a pipeline, which a warm-up should have made
  std::uint64_t pipelines_made = 0;
  double longest_making_ms = 0.0;
  std::uint64_t kinds_followed = 0;       ///< pictures of another kind, when what they take was made beside the frames
  std::uint64_t kinds_complete = 0;       ///< of which nothing is left to make, whatever light is switched on
  std::uint64_t pipelines_rehearsed = 0;  ///< for them
  double longest_rehearsal_ms = 0.0;      ///< between two frames
  FrameResult newest;
  std::optional<std::chrono::steady_clock::time_point> first_end, last_end;  ///< of the first and the newest frame

  void frame_ended(std::chrono::steady_clock::time_point now) {
    if (!first_end) first_end = now;
    last_end = now;
  }
  /// Seconds from the end of the first frame to the end of the newest, whatever happened in between.
  double seconds() const { return first_end ? std::chrono::duration<double>(*last_end - *first_end).count() : 0.0; }
  /// Frames by seconds; 0 while there is no second frame.
  double frames_per_s() const { return seconds() > 0.0 ? static_cast<double>(frames - 1) / seconds() : 0.0; }

  void keep(const FrameResult& result) {
    FrameResult before = std::exchange(newest, result);
    if (result.timed) return;
    newest.wall_ms = before.wall_ms, newest.gpu_ms = before.gpu_ms;
    newest.passes = std::move(before.passes);
  }

  void add(const FrameResult& result, bool captured) {
    ++frames;
    keep(result);
    if (result.pipelines_made > 0) {
      ++making_frames;
      pipelines_made += result.pipelines_made;
      longest_making_ms = std::max(longest_making_ms, result.wall_ms);
    }
    if (captured) ++captured_frames;
    if (!result.timed) return;
    wall_ms.add(result.wall_ms);
    for (const PassTime& pass : result.passes) pass_ms[pass.name].add(pass.ms);
    for (const EffectRow& row : effect_table())
      if (const auto ms = effect_time_ms(result, row.effect)) effect_ms[row.effect].add(*ms);
    double other = 0.0;
    for (const PassTime& pass : result.passes) other += pass.effect ? 0.0 : pass.ms;
    other_ms.add(other);
    if (result.timed_kept) return;
    wall_no_capture_ms.add(result.wall_ms);
    gpu_ms.add(result.gpu_ms);
  }
};

}  // namespace phare
