#include "net/inbox.h"

#include <algorithm>

namespace phare {

InboxCounters& InboxCounters::operator+=(const InboxCounters& other) {
  received += other.received;
  lost += other.lost;
  late += other.late;
  duplicate += other.duplicate;
  restarted += other.restarted;
  return *this;
}

InboxCounters& InboxCounters::operator-=(const InboxCounters& other) {
  received -= other.received;
  lost -= other.lost;
  late -= other.late;
  duplicate -= other.duplicate;
  restarted -= other.restarted;
  return *this;
}

bool SequenceTracker::seen(std::uint64_t sequence) const {
  const std::uint64_t bit = sequence % kWindow;
  return ((seen_[bit / 64] >> (bit % 64)) & 1u) != 0;
}

void SequenceTracker::mark(std::uint64_t sequence, bool seen) {
  const std::uint64_t bit = sequence % kWindow;
  const std::uint64_t mask = std::uint64_t{1} << (bit % 64);
  seen_[bit / 64] = seen ? seen_[bit / 64] | mask : seen_[bit / 64] & ~mask;
}

bool SequenceTracker::retired(std::uint64_t start_id) const {
  return std::find(retired_.begin(), retired_.end(), start_id) != retired_.end();
}

Arrival SequenceTracker::arrived(std::uint64_t start_id, std::uint64_t sequence) {
  if (start_id != start_id_) {
    if (retired(start_id)) {
      ++counters_.late;
      return Arrival::kLate;
    }
    if (start_id_ == 0) {
      first_ = sequence;
    } else {
      // We listened when it started, so whatever it numbered before this one is lost.
      retired_[next_retired_] = start_id_;
      next_retired_ = (next_retired_ + 1) % retired_.size();
      ++counters_.restarted;
      counters_.lost += sequence - 1;
      first_ = 1;
    }
    start_id_ = start_id;
    newest_ = sequence;
    seen_.fill(0);
    mark(sequence, true);
    ++counters_.received;
    return Arrival::kNewest;
  }

  if (sequence > newest_) {
    const std::uint64_t gap = sequence - newest_ - 1;
    counters_.lost += gap;
    if (gap >= kWindow) {
      seen_.fill(0);
    } else {
      for (std::uint64_t missing = newest_ + 1; missing < sequence; ++missing) mark(missing, false);
    }
    mark(sequence, true);
    newest_ = sequence;
    ++counters_.received;
    return Arrival::kNewest;
  }

  const bool known = newest_ - sequence < kWindow;
  if (known && seen(sequence)) {
    ++counters_.duplicate;
    return sequence == newest_ ? Arrival::kNewestAgain : Arrival::kDuplicate;
  }
  if (known) {
    mark(sequence, true);
    if (sequence >= first_) --counters_.lost;
  }
  ++counters_.late;
  return Arrival::kLate;
}

Arrival ManyStarts::arrived(std::uint64_t start_id, std::uint64_t sequence) {
  auto known = std::ranges::find(starts_, start_id, &Start::id);
  if (known == starts_.end()) {
    if (starts_.size() == kMost) starts_.erase(starts_.begin());
    starts_.push_back({start_id, {}});
  } else {
    std::rotate(known, known + 1, starts_.end());
  }
  SequenceTracker& tracker = starts_.back().tracker;
  counters_ -= tracker.counters();
  const Arrival arrival = tracker.arrived(start_id, sequence);
  counters_ += tracker.counters();
  return arrival;
}

}  // namespace phare
