#include "net/seal.h"

#include <sodium.h>

#include <algorithm>
#include <cstdlib>

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

bool Replays::is_replay(const Datagram& datagram, WallTime arrived) {
  if (std::abs(arrived.ns - datagram.sent.ns) > apart_.count()) return true;
  if (kChannels[datagram.payload.index()].many_starts) return is_replay_of_many(datagram);
  const Seen& seen = streams_[{datagram.payload.index(), datagram.sender_channel}];
  return seen.start_id != 0 && seen.start_id != datagram.start_id && datagram.sent <= seen.newest;
}

void Replays::taken(const Datagram& datagram, WallTime sent) {
  if (kChannels[datagram.payload.index()].many_starts) return;  // is_replay_of_many has noted it
  Seen& seen = streams_[{datagram.payload.index(), datagram.sender_channel}];
  seen.newest = seen.start_id == datagram.start_id ? std::max(seen.newest, sent) : sent;
  seen.start_id = datagram.start_id;
}

bool Replays::is_replay_of_many(const Datagram& datagram) {
  Many& many = shared_streams_[{datagram.payload.index(), datagram.sender_channel}];
  const auto known = std::ranges::find(many.starts, datagram.start_id, &Seen::start_id);
  if (known == many.starts.end()) {
    if (many.newest_forgotten.ns != 0 && datagram.sent <= many.newest_forgotten) return true;
    if (many.starts.size() == ManyStarts::kMost) {
      many.newest_forgotten = std::max(many.newest_forgotten, many.starts.front().newest);
      many.starts.erase(many.starts.begin());
    }
    many.starts.push_back({datagram.start_id, datagram.sent});
  } else {
    known->newest = std::max(known->newest, datagram.sent);
    std::rotate(known, known + 1, many.starts.end());
  }
  return false;
}

}  // namespace phare
