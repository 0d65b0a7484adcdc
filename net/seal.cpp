#include "net/seal.h"

#include <sodium.h>

#include <algorithm>

#include "net/inbox.h"

namespace phare {

static_assert(crypto_auth_BYTES == Seal::kTagBytes && crypto_auth_KEYBYTES == std::tuple_size_v<BusKey>);

void Seal::close(std::string& bytes) const {
  if (!key_) return;
  std::array<unsigned char, kTagBytes> tag{};
  crypto_auth(tag.data(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), key_->data());
  bytes.append(reinterpret_cast<const char*>(tag.data()), tag.size());
}

std::optional<std::span<const std::byte>> Seal::open(std::span<const std::byte> bytes) const {
  if (!key_) return bytes;
  if (bytes.size() < kTagBytes) return std::nullopt;
  const auto datagram = bytes.first(bytes.size() - kTagBytes);
  const auto* tag = reinterpret_cast<const unsigned char*>(bytes.data()) + datagram.size();
  const auto* message = reinterpret_cast<const unsigned char*>(datagram.data());
  if (crypto_auth_verify(tag, message, datagram.size(), key_->data()) != 0) return std::nullopt;
  return datagram;
}

bool Replays::is_replay(const Datagram& datagram) {
  if (kChannels[datagram.payload.index()].many_starts) return is_replay_of_many(datagram);
  Seen& seen = streams_[{datagram.payload.index(), datagram.sender_channel}];
  const bool another_start = seen.start_id != datagram.start_id;
  if (seen.start_id != 0 && another_start && datagram.sent <= seen.newest) return true;
  seen.newest = another_start ? datagram.sent : std::max(seen.newest, datagram.sent);
  seen.start_id = datagram.start_id;
  return false;
}

bool Replays::is_replay_of_many(const Datagram& datagram) {
  Many& many = shared_streams_[{datagram.payload.index(), datagram.sender_channel}];
  const auto known = std::ranges::find(many.starts, datagram.start_id, &Seen::start_id);
  if (known == many.starts.end()) {
    const bool long_ago = datagram.sent.ns + std::chrono::nanoseconds(kClocksApart).count() < many.newest.ns;
    if (long_ago || (many.newest_forgotten.ns != 0 && datagram.sent <= many.newest_forgotten)) return true;
    if (many.starts.size() == ManyStarts::kMost) {
      many.newest_forgotten = std::max(many.newest_forgotten, many.starts.front().newest);
      many.starts.erase(many.starts.begin());
    }
    many.starts.push_back({datagram.start_id, datagram.sent});
  } else {
    known->newest = std::max(known->newest, datagram.sent);
    std::rotate(known, known + 1, many.starts.end());
  }
  many.newest = std::max(many.newest, datagram.sent);
  return false;
}

}  // namespace phare
