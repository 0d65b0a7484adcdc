#include "net/wire.h"

#include <google/protobuf/arena.h>
#include <google/protobuf/message.h>
#include <google/protobuf/stubs/logging.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "net/udp.h"
#include "net/wire_payload.h"

namespace phare {
namespace {

// Tag of field 16, fixed32, as a varint; then four bytes, little-endian.
constexpr std::size_t kCheckBytes = 6;
constexpr unsigned char kCheckTag[2] = {0x85, 0x01};
// version, sender, start id, sequence, payload of length 0, check
constexpr std::size_t kMinDatagramBytes = 2 + 2 + 9 + 2 + 2 + kCheckBytes;

std::uint32_t crc_of(const void* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(crc32(0, static_cast<const Bytef*>(bytes), static_cast<uInt>(size)));
}

/// One protobuf message on an arena whose first block is kept, so that small datagrams need no heap at all.
class Scratch {
 public:
  Scratch() : arena_(options(block_)) {
    // Otherwise protobuf writes a line to stderr for every string that is not UTF-8.
    google::protobuf::SetLogHandler(nullptr);
  }

  wire::Datagram& fresh() {
    arena_.Reset();
    return *google::protobuf::Arena::CreateMessage<wire::Datagram>(&arena_);
  }

 private:
  using Block = std::array<char, 16384>;
  static google::protobuf::ArenaOptions options(Block& block) {
    google::protobuf::ArenaOptions options;
    options.initial_block = block.data();
    options.initial_block_size = block.size();
    return options;
  }

  alignas(16) Block block_;
  google::protobuf::Arena arena_;
};

wire::Datagram& fresh_message() {
  thread_local Scratch scratch;
  return scratch.fresh();
}

/// Every message has one encoding. What parses but encodes otherwise repeats fields, pads numbers or changes their
/// order.
bool is_the_encoding_of(const wire::Datagram& message, const std::uint8_t* bytes, std::size_t size) {
  if (message.ByteSizeLong() != size) return false;
  thread_local std::vector<std::uint8_t> canonical(kMaxDatagramBytes);
  message.SerializeWithCachedSizesToArray(canonical.data());
  return std::memcmp(canonical.data(), bytes, size) == 0;
}

}  // namespace

void encode_into(const Datagram& datagram, std::string& bytes) {
  wire::Datagram& message = fresh_message();
  message.set_protocol_version(kProtocolVersion);
  message.set_sender(to_wire_enum<wire::Sender>(static_cast<int>(datagram.sender)));
  message.set_sender_channel(datagram.sender_channel);
  message.set_start_id(datagram.start_id);
  message.set_sequence(datagram.sequence);
  message.set_sim_time_ns(datagram.sim_time.ns);
  message.set_sent_wall_ns(datagram.sent.ns);
  fill_payload(message, datagram.payload);

  // There are no maps and no unknown fields: protobuf's encoding of equal messages is equal.
  const std::size_t size = message.ByteSizeLong();
  bytes.resize(size + kCheckBytes);
  auto* const begin = reinterpret_cast<std::uint8_t*>(bytes.data());
  std::uint8_t* end = message.SerializeWithCachedSizesToArray(begin);
  const std::uint32_t crc = crc_of(begin, size);
  *end++ = kCheckTag[0];
  *end++ = kCheckTag[1];
  for (int shift = 0; shift < 32; shift += 8) *end++ = static_cast<std::uint8_t>(crc >> shift);
}

std::string encode(const Datagram& datagram) {
  std::string bytes;
  encode_into(datagram, bytes);
  return bytes;
}

Refusal decode_into(std::span<const std::byte> bytes, Datagram& datagram) {
  // Cheap checks first, so that a flood of garbage costs little: size, first bytes, check tag, CRC.
  if (bytes.size() < kMinDatagramBytes || bytes.size() > kMaxDatagramBytes) return Refusal::kSize;
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (data[0] != 0x08 || data[1] != kProtocolVersion || data[2] != 0x10 || data[3] < 1 || data[3] > 5) {
    return Refusal::kHeader;
  }
  const std::size_t size = bytes.size() - kCheckBytes;
  const std::uint8_t* const tail = data + size;
  if (tail[0] != kCheckTag[0] || tail[1] != kCheckTag[1]) return Refusal::kChecksum;
  std::uint32_t crc = 0;
  for (unsigned i = 0; i < 4; ++i) crc |= static_cast<std::uint32_t>(tail[2 + i]) << (8 * i);
  if (crc != crc_of(data, size)) return Refusal::kChecksum;

  wire::Datagram& message = fresh_message();
  if (!message.ParseFromArray(data, static_cast<int>(size))) return Refusal::kMalformed;
  if (any_unknown(message) || message.check() != 0 || !is_the_encoding_of(message, data, size))
    return Refusal::kMalformed;

  datagram.sender = static_cast<Sender>(static_cast<int>(message.sender()));
  datagram.sender_channel = message.sender_channel();
  datagram.start_id = message.start_id();
  datagram.sequence = message.sequence();
  datagram.sim_time.ns = message.sim_time_ns();
  datagram.sent.ns = message.sent_wall_ns();
  if (!read_payload(message, datagram.payload)) return Refusal::kMalformed;
  return check(datagram);
}

Result<Datagram> decode(std::span<const std::byte> bytes) {
  Datagram datagram;
  const Refusal refusal = decode_into(bytes, datagram);
  if (refusal != Refusal::kNone) return Error{"datagram", refusal_text(refusal)};
  return datagram;
}

}  // namespace phare
