// How long it takes from a frame's stamp to the datagram that carries it: a histogram of fixed size.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace phare {

class LatencyHistogram {
 public:
  static constexpr std::int64_t kBin_ns = 10'000;
  static constexpr std::size_t kBins = 10'000;  // up to 100 ms, the last holds all above

  void add(std::int64_t latency_ns) {
    const auto bin = static_cast<std::size_t>(std::max<std::int64_t>(latency_ns, 0) / kBin_ns);
    ++bins_[std::min(bin, kBins - 1)];
    ++count_;
    most_ns_ = std::max(most_ns_, latency_ns);
  }

  std::uint64_t count() const { return count_; }
  std::int64_t most_ns() const { return most_ns_; }

  /// Upper edge of the bin in which the share lies; 0 when empty.
  std::int64_t quantile_ns(double share_01) const {
    const auto wanted = static_cast<std::uint64_t>(share_01 * static_cast<double>(count_));
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kBins; ++i) {
      sum += bins_[i];
      if (sum > wanted || (sum == count_ && count_ > 0)) {
        return std::min(static_cast<std::int64_t>(i + 1) * kBin_ns, most_ns_);
      }
    }
    return 0;
  }

 private:
  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t most_ns_ = 0;
};

}  // namespace phare
