// The key of a bus that leaves this machine: every datagram carries a tag that only holders of the key can make.
//
// The tag is libsodium's crypto_auth (HMAC-SHA-512-256, RFC 4231) over the datagram's bytes, and follows them. It says
// who may speak, it hides nothing. A datagram sent again falls to the sequence numbers; one played again later to
// Replays. Without a key bytes travel as they are, which is allowed on loopback only.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/rig.h"
#include "net/messages.h"

namespace phare {

class Seal {
 public:
  static constexpr std::size_t kTagBytes = 32;

  explicit Seal(const std::optional<BusKey>& key) : key_(key) {}

  /// Bytes that close() adds.
  std::size_t tag_bytes() const { return key_ ? kTagBytes : 0; }
  /// Appends the tag.
  void close(std::string& bytes) const;
  /// The datagram without its tag; nullopt when the tag is missing or made with another key.
  std::optional<std::span<const std::byte>> open(std::span<const std::byte> bytes) const;

 private:
  std::optional<BusKey> key_;
};

/// Tells what was recorded and is played again by a stranger from what its sender says now.
/// What was sent long before it arrived, by the sender's own clock, is old, also to a receiver that has just begun and
/// knows nobody. A new start has been sent later than anything of the start before it.
/// Where many starts speak at once (Channel::many_starts), a start that is not known must have been sent after all that
/// was heard of the forgotten ones.
class Replays {
 public:
  static constexpr std::chrono::seconds kClocksApart{10};  ///< of the machines of one rig, chosen by us
  static constexpr std::chrono::seconds kOneClock{1};      ///< on one machine: a send() that waits for a processor

  /// `apart`: most that may lie between sending and arriving, either way.
  explicit Replays(std::chrono::nanoseconds apart) : apart_(apart) {}

  /// `arrived`: by the sender's clock, as far as it is known.
  bool is_replay(const Datagram& datagram, WallTime arrived);
  /// It was no replay, and is of the sender that speaks. `sent`: as its sender wrote it.
  void taken(const Datagram& datagram, WallTime sent);

 private:
  struct Seen {
    std::uint64_t start_id = 0;
    WallTime newest{};
  };
  bool is_replay_of_many(const Datagram& datagram);

  std::chrono::nanoseconds apart_;
  std::map<std::pair<std::size_t, std::uint32_t>, Seen> streams_;  // by payload index and sender channel
  struct Many {
    std::vector<Seen> starts;  // at most ManyStarts::kMost, in the order they were heard
    WallTime newest_forgotten{};
  };
  std::map<std::pair<std::size_t, std::uint32_t>, Many> shared_streams_;
};

}  // namespace phare
