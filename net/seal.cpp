#include "net/seal.h"

#include <sodium.h>

#include <algorithm>

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
  Seen& seen = streams_[{datagram.payload.index(), datagram.sender_channel}];
  const bool another_start = seen.start_id != datagram.start_id;
  if (seen.start_id != 0 && another_start && datagram.sent <= seen.newest) return true;
  seen.newest = another_start ? datagram.sent : std::max(seen.newest, datagram.sent);
  seen.start_id = datagram.start_id;
  return false;
}

}  // namespace phare
