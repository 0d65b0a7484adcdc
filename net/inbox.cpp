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

bool LiveSender::admits(std::uint64_t start_id, const Endpoint& from, Time heard) {
  heard = std::max(heard, heard_);
  if (start_id != start_id_ && start_id_ != 0) {
    const bool silent = heard - heard_ >= silent_after_;
    // What the network held back of a start that gave way is no new start.
    const bool started_again = from == from_ && std::ranges::find(gave_way_, start_id) == gave_way_.end();
    if (!silent && !started_again) return false;
    gave_way_[next_gave_way_] = start_id_;
    next_gave_way_ = (next_gave_way_ + 1) % gave_way_.size();
  }
  start_id_ = start_id;
  from_ = from;
  heard_ = heard;
  return true;
}

Arrival SequenceTracker::arrived(std::uint64_t start_id, std::uint64_t sequence) {
  if (start_id != start_id_) {
    const auto known = std::ranges::find(retired_, start_id, &Retired::start_id);
    const bool comes_back = known != retired_.end();
    if (comes_back && sequence <= known->newest) {
      ++counters_.late;
      return Arrival::kLate;
    }
    if (start_id_ == 0) {
      first_ = sequence;
    } else {
      // We listened when it started, so whatever it numbered before this one is lost; what it said while another spoke
      // was refused.
      const Retired gives_way{start_id_, newest_};
      if (comes_back) {
        *known = gives_way;
        first_ = sequence;
      } else {
        retired_[next_retired_] = gives_way;
        next_retired_ = (next_retired_ + 1) % retired_.size();
        counters_.lost += sequence - 1;
        first_ = 1;
      }
      ++counters_.restarted;
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
