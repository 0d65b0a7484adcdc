// The clocks of all processes of a rig as one of them sees them: whom to ask and when, and the stamps of what they send
// in our time. Told in the log when first known, when one was set, and in the statistics.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/rig.h"
#include "net/channels.h"
#include "net/messages.h"
#include "net/peer_clock.h"
#include "net/udp.h"

namespace phare {

class PeerClocks {
 public:
  using Time = PeerClock::Time;

  struct Peer {
    Role role;
    std::uint32_t channel = 0;
    std::string name;  ///< "visual-1"
    Endpoint endpoint;
    PeerClock clock;
    std::uint64_t asked_count = 0;
    bool told = false;
    bool drift_told = false;
    std::uint64_t steps_told = 0;
    std::array<WallTime, 8> open{};  ///< questions that may still be answered, a ring
    std::size_t next_open = 0;
  };

  /// Of who asks: it does not ask itself.
  PeerClocks(const Rig& rig, Role role, std::uint32_t channel);

  /// Who is to be asked now: all, every 50 ms for half a second, then once a second. The caller sends `question` to
  /// each.
  std::vector<Endpoint> due(Time now);
  ClockProbe question(WallTime now);

  /// An answer by `sender`, sent at `answered_there` by its clock. One that we have not asked for is left out.
  void answered(const ClockProbe& answer, Sender sender, std::uint32_t channel, WallTime answered_there, WallTime heard,
                Time now);

  /// How far the sender's clock is ahead of ours; 0 as long as nothing is known.
  std::int64_t ahead_ns(Sender sender, std::uint32_t channel, Time now) const;

  const std::vector<Peer>& peers() const { return peers_; }

 private:
  const Peer* peer_of(Sender sender, std::uint32_t channel) const;
  static void tell(Peer& peer, Time now);

  std::vector<Peer> peers_;
  Time next_{};
  std::uint64_t rounds_ = 0;
};

/// The stamps of a message, in our time.
void to_our_clock(Datagram& datagram, std::int64_t ahead_ns);

}  // namespace phare
