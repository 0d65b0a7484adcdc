#include "net/peer_clock.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phare {

/// By how much it may be off by now, ns.
double PeerClock::within_at(const Sample& sample, Time now) {
  const double age_ns = std::max(std::chrono::duration<double, std::nano>(now - sample.when).count(), 0.0);
  return static_cast<double>(sample.within_ns) + age_ns * kDrift_ppm * 1e-6;
}

const PeerClock::Sample* PeerClock::tightest(Time now) const {
  const auto best = std::ranges::min_element(newest_, {}, [&](const Sample& s) { return within_at(s, now); });
  return best == newest_.end() ? nullptr : &*best;
}

void PeerClock::add(const ClockExchange& exchange, Time now) {
  const std::int64_t there_ns = exchange.answered_there.ns - exchange.heard_there.ns;
  const std::int64_t away_ns = exchange.heard.ns - exchange.asked.ns - there_ns;
  if (there_ns < 0 || away_ns < 0) return;
  const std::int64_t go_ns = exchange.heard_there.ns - exchange.asked.ns;
  const std::int64_t back_ns = exchange.answered_there.ns - exchange.heard.ns;
  const Sample sample{now, go_ns / 2 + back_ns / 2, away_ns / 2 + 1};
  ++exchanges_;

  const Sample* before = tightest(now);
  if (before != nullptr) {
    const double apart_ns = std::abs(static_cast<double>(sample.ahead_ns - before->ahead_ns));
    if (apart_ns > static_cast<double>(sample.within_ns) + within_at(*before, now)) {
      ++steps_;
      newest_.clear();
      anchors_.clear();
    }
  }
  newest_.push_back(sample);
  if (newest_.size() > kNewest) newest_.pop_front();

  if (anchors_.empty() || now - anchor_began_ >= kAnchorEvery) {
    anchors_.push_back(sample);
    anchor_began_ = now;
    if (anchors_.size() > kAnchors) anchors_.pop_front();
  } else if (sample.within_ns < anchors_.back().within_ns) {
    anchors_.back() = sample;
  }
}

std::optional<PeerClock::Estimate> PeerClock::at(Time now) const {
  const Sample* best = tightest(now);
  if (best == nullptr) return std::nullopt;
  Estimate estimate{best->ahead_ns, static_cast<std::int64_t>(within_at(*best, now)), 0.0,
                    std::numeric_limits<double>::infinity()};
  if (anchors_.size() >= 3) {  // the last one is being made
    const Sample &first = anchors_.front(), &last = anchors_[anchors_.size() - 2];
    const double span_ns = std::chrono::duration<double, std::nano>(last.when - first.when).count();
    if (span_ns > 0.0) {
      estimate.drift_ppm = static_cast<double>(last.ahead_ns - first.ahead_ns) / span_ns * 1e6;
      estimate.drift_within_ppm = static_cast<double>(first.within_ns + last.within_ns) / span_ns * 1e6;
    }
  }
  return estimate;
}

}  // namespace phare
