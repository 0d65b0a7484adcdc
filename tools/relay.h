// A relay of a rig's datagrams that loses, delays and reorders them by a seed: how a rig stands a bad network.
//
// It listens on every port of a rig at one address and passes what comes on to the same port at another, and answers
// back the way they came: each sender has a port of its own behind the relay, as behind an address translation. Faults
// are drawn for every datagram, on the way there and back, by one generator: the same seed and the same order of
// datagrams give the same faults.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <queue>
#include <random>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "net/udp.h"

namespace phare {

struct RelayFaults {
  double loss_01 = 0.0;       ///< share of datagrams that never arrive
  double duplicate_01 = 0.0;  ///< share that arrives twice
  double reorder_01 = 0.0;    ///< share that is held back until others have passed: delay and jitter once more
  std::chrono::nanoseconds delay{}, jitter{};  ///< each datagram: delay, and up to jitter more
  std::uint64_t seed = 1;
};

struct RelayCounts {
  std::uint64_t received = 0, passed_on = 0, lost = 0, duplicated = 0, held_back = 0;
  std::uint64_t not_taken = 0;  ///< by the kernel, or of more senders than are told apart

  friend bool operator==(const RelayCounts&, const RelayCounts&) = default;
};

class Relay {
 public:
  using Clock = std::chrono::steady_clock;

  /// Binds `ports` ports from `port_base` on at `listen`. `to`: IPv4 address of those behind. Error where a port is
  /// taken or an address is none.
  static Result<Relay> open(const std::string& listen, const std::string& to, std::uint16_t port_base,
                            std::uint16_t ports, const RelayFaults& faults);

  /// Takes what waits and passes on what is due; sleeps `at_most` when there is nothing.
  void step(std::chrono::nanoseconds at_most);
  const RelayCounts& counts() const { return counts_; }

 private:
  struct Way {  ///< one sender to one port
    Endpoint client;
    std::size_t front = 0;  ///< index of the listening socket
    UdpSocket behind;
  };
  struct Held {
    Clock::time_point due;
    std::uint64_t order = 0;
    std::size_t way = 0;
    bool back = false;
    std::string bytes;
    bool operator>(const Held& other) const { return due != other.due ? due > other.due : order > other.order; }
  };
  Relay() = default;
  std::optional<std::size_t> way_of(const Endpoint& client, std::size_t front);
  void take(std::size_t way, bool back, std::span<const std::byte> bytes);
  void pass_on(const Held& held);
  bool chance(double share_01);

  std::string behind_;  // what the sockets to those behind bind
  std::uint32_t to_ = 0;
  RelayFaults faults_;
  std::mt19937_64 random_;
  std::vector<UdpSocket> fronts_;
  std::deque<Way> ways_;
  std::priority_queue<Held, std::vector<Held>, std::greater<>> held_;
  std::uint64_t order_ = 0;
  RelayCounts counts_;
};

}  // namespace phare
