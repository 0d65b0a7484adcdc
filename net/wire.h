// Datagram structs to bytes and back; the only place that knows protobuf.
//
// A datagram on the wire is the protobuf encoding of phare.wire.Datagram, fields in ascending order, and then always
// field 16, the CRC-32 of everything before it. So it begins with 08 01 10 (version 1, then the sender) and ends with
// 85 01 and four bytes: what is garbage, cut short or has a flipped bit is refused before protobuf sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "config/base/result.h"
#include "net/messages.h"

namespace phare {

inline constexpr std::uint32_t kProtocolVersion = 1;

/// Most points of a ProbeRequest.
inline constexpr std::size_t kMaxProbePoints = 1000;

/// Why a datagram is not taken. kNone: it is.
enum class Refusal {
  kNone,
  kSize,       ///< shorter than any, or longer than UDP carries
  kHeader,     ///< does not begin with this protocol's version and a known sender
  kChecksum,   ///< no or a wrong CRC: cut short, or bits changed
  kMalformed,  ///< not the one encoding of a Datagram: broken, unknown or repeated fields, trailing bytes
  kEnvelope,   ///< start id or sequence 0, channel or time out of range
  kSender,     ///< this sender may not send this payload
  kNotFinite,  ///< NaN or infinity
  kRange,      ///< a number, enum or text length outside its sane range
  kArrays,     ///< probe arrays of different or excessive length
  kNotForUs,   ///< valid, but this process is no receiver of it (told by Bus)
  kKey,        ///< not sealed with the key of this bus (told by Bus)
  kReplay,     ///< sent earlier and played again (told by Bus, where there is a key)
  kSecond,     ///< another sender of this message is heard (told by Bus)
};
inline constexpr std::size_t kRefusals = 14;

/// One short sentence, static.
const char* refusal_text(Refusal refusal);

/// Deterministic bytes: equal structs give equal bytes.
std::string encode(const Datagram& datagram);

/// Same, into `bytes`, whose capacity is reused.
void encode_into(const Datagram& datagram, std::string& bytes);

/// The ranges decode() holds a datagram to, applied to a struct: what is wrong with it, or kNone.
Refusal check(const Datagram& datagram);

/// Checks everything and gives the struct, or the reason.
Result<Datagram> decode(std::span<const std::byte> bytes);

/// Same without allocation on refusal; `datagram` holds anything then.
Refusal decode_into(std::span<const std::byte> bytes, Datagram& datagram);

}  // namespace phare
