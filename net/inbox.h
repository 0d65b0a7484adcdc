// What a receiver keeps of one stream (one sender, channel and payload type): the newest valid message, and the counts.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "net/channels.h"
#include "net/messages.h"
#include "net/sim_time.h"
#include "net/udp.h"

namespace phare {

/// Datagrams of one stream. Of one start id: received + late + lost = newest sequence - first sequence + 1, as long as
/// nothing comes more than SequenceTracker::kWindow behind the newest.
struct InboxCounters {
  std::uint64_t received = 0;   ///< taken as the newest
  std::uint64_t lost = 0;       ///< gaps in the sequence that nothing has filled yet
  std::uint64_t late = 0;       ///< valid, but older than the newest, or of a sender's earlier start
  std::uint64_t duplicate = 0;  ///< sequence already seen
  std::uint64_t restarted = 0;  ///< new start ids after the first

  InboxCounters& operator+=(const InboxCounters& other);
  InboxCounters& operator-=(const InboxCounters& other);
  friend bool operator==(const InboxCounters&, const InboxCounters&) = default;
};

enum class Arrival {
  kNewest,       ///< take it
  kLate,         ///< older than the newest
  kDuplicate,    ///< seen before
  kNewestAgain,  ///< the newest once more
  kSecond,       ///< of another start than the one that speaks here: refused, and not counted by the tracker
};

/// Who may speak in a stream that has one sender at a time: who was heard first, as long as it is heard. A start from
/// elsewhere is a second sender until the first has been silent for its time; one from the same address and port is the
/// first started again, for a port has one holder. Who had to give way may come back the same way: nobody is mute for
/// good.
class LiveSender {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit LiveSender(std::chrono::nanoseconds silent_after) : silent_after_(silent_after) {}

  /// Whether this start speaks from now on, `heard` when it arrived. Times that go back count as the newest.
  bool admits(std::uint64_t start_id, const Endpoint& from, Time heard);

 private:
  std::chrono::nanoseconds silent_after_;
  std::uint64_t start_id_ = 0;  // 0: nobody yet
  Endpoint from_;
  Time heard_{};
  std::array<std::uint64_t, 8> gave_way_{};  // start ids before this one, a ring
  std::size_t next_gave_way_ = 0;
};

/// Judges sequences, of one start after the other. A start that comes back after another goes on with its own numbers.
class SequenceTracker {
 public:
  /// How far behind the newest a straggler is still told from a duplicate; further behind all count as late.
  static constexpr std::uint64_t kWindow = 1024;

  /// Judges one arrival and counts it.
  Arrival arrived(std::uint64_t start_id, std::uint64_t sequence);

  const InboxCounters& counters() const { return counters_; }

 private:
  bool seen(std::uint64_t sequence) const;
  void mark(std::uint64_t sequence, bool seen);

  InboxCounters counters_;
  std::uint64_t start_id_ = 0;  // 0: nothing has arrived
  std::uint64_t first_ = 0;     // sequences before it were sent before this receiver listened: not lost
  std::uint64_t newest_ = 0;
  std::array<std::uint64_t, kWindow / 64> seen_{};  // bit sequence % kWindow, for the kWindow newest sequences
  struct Retired {
    std::uint64_t start_id = 0, newest = 0;
  };
  std::array<Retired, 8> retired_{};  // earlier starts, a ring
  std::size_t next_retired_ = 0;
};

/// The same for a stream that several starts share at the same time (Channel::many_starts): each has a sequence of its
/// own, and none silences another. Of the starts the kMost heard last are known; counts are of all together.
class ManyStarts {
 public:
  static constexpr std::size_t kMost = 64;

  Arrival arrived(std::uint64_t start_id, std::uint64_t sequence);

  const InboxCounters& counters() const { return counters_; }

 private:
  struct Start {
    std::uint64_t id = 0;
    SequenceTracker tracker;
  };
  std::vector<Start> starts_;  // in the order they were heard, the newest last
  InboxCounters counters_;
};

/// The newest valid message of a stream and its envelope.
template <class T>
struct Newest {
  T value;
  SimTime sim_time;  ///< simulated time the value is valid for
  WallTime sent;
  WallTime received;                            ///< when it reached this machine
  std::chrono::steady_clock::time_point heard;  ///< the same, by the clock that nobody sets
  std::uint32_t sender_channel = 0;
};

/// Silence of a channel's sender after which another may take its place.
constexpr std::chrono::nanoseconds taken_over_after(const Channel& row) {
  return row.stale_after.count() > 0 ? row.stale_after : std::chrono::seconds(1);
}

template <class T>
class Inbox {
 public:
  /// Keeps the payload when it is the newest. `repeat_is_news`: a repeat of the newest can be taken again.
  Arrival deliver(const Datagram& datagram, const T& payload, const ArrivalTime& arrived, const Endpoint& from,
                  bool repeat_is_news) {
    if (!channel_of<T>().many_starts && !live_.admits(datagram.start_id, from, arrived.steady)) return Arrival::kSecond;
    const Arrival arrival = tracker_.arrived(datagram.start_id, datagram.sequence);
    if (arrival == Arrival::kNewest) {
      newest_.value = payload;
      newest_.sim_time = datagram.sim_time;
      newest_.sent = datagram.sent;
      newest_.received = arrived.wall;
      newest_.heard = arrived.steady;
      newest_.sender_channel = datagram.sender_channel;
      present_ = true;
      untaken_ = true;
    } else if (arrival == Arrival::kNewestAgain && repeat_is_news) {
      untaken_ = true;
    }
    return arrival;
  }

  /// nullptr before the first.
  const Newest<T>* newest() const { return present_ ? &newest_ : nullptr; }

  /// nullptr when the newest has been taken. The pointer is valid until the next delivery.
  const Newest<T>* take() {
    if (!untaken_) return nullptr;
    untaken_ = false;
    return &newest_;
  }

  const InboxCounters& counters() const { return tracker_.counters(); }

 private:
  std::conditional_t<channel_of<T>().many_starts, ManyStarts, SequenceTracker> tracker_;
  LiveSender live_{taken_over_after(channel_of<T>())};
  Newest<T> newest_;
  bool present_ = false;
  bool untaken_ = false;
};

}  // namespace phare
