// How long steps took: a histogram of constant size.
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <cstdint>

namespace phare {

/// Buckets of an eighth of an octave from 1 ns to 18 minutes: quantiles are exact to 9 %.
class StepTimes {
 public:
  void add(std::chrono::nanoseconds time) {
    const auto ns = static_cast<std::uint64_t>(time.count() < 1 ? 1 : time.count());
    ++buckets_[bucket_of(ns)];
    ++count_;
    if (ns > max_ns_) max_ns_ = ns;
  }

  /// Upper bound of the bucket below or in which `share` of all steps lie, ns; 0 when there were none.
  double quantile_ns(double share) const {
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
      below += buckets_[i];
      if (count_ > 0 && static_cast<double>(below) >= share * static_cast<double>(count_)) return upper_ns(i);
    }
    return 0.0;
  }
  /// Histogram: how many lie in [2^i, 2^(i+1)) ns.
  std::array<std::uint64_t, 40> octaves() const {
    std::array<std::uint64_t, 40> counts{};
    for (std::size_t i = 0; i < buckets_.size(); ++i) counts[i / 8] += buckets_[i];
    return counts;
  }
  std::uint64_t count() const { return count_; }
  std::uint64_t max_ns() const { return max_ns_; }

 private:
  // Octave by the highest bit, then its next three bits.
  static std::size_t bucket_of(std::uint64_t ns) {
    const auto octave = static_cast<int>(std::bit_width(ns)) - 1;
    const std::uint64_t eighth = octave >= 3 ? (ns >> (octave - 3)) & 7u : (ns << (3 - octave)) & 7u;
    const std::size_t bucket = static_cast<std::size_t>(octave) * 8 + static_cast<std::size_t>(eighth);
    return bucket < kBuckets ? bucket : kBuckets - 1;
  }
  static double upper_ns(std::size_t bucket) {
    return static_cast<double>(std::uint64_t{1} << (bucket / 8)) * (1.0 + static_cast<double>(bucket % 8 + 1) / 8.0);
  }

  static constexpr std::size_t kBuckets = 40 * 8;
  std::array<std::uint64_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::uint64_t max_ns_ = 0;
};

}  // namespace phare
