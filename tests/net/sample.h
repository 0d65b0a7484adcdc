// Valid datagrams with every field set, for tests.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "net/messages.h"

namespace phare::test {

/// A valid datagram of payload `payload_index` with random values in every field.
Datagram sample(std::size_t payload_index, std::mt19937_64& random);

/// One of each payload, all RigControl commands among them.
std::vector<Datagram> samples(std::uint64_t seed);

/// Text as the bytes of a datagram.
inline std::span<const std::byte> view(const std::string& bytes) {
  return std::as_bytes(std::span(bytes.data(), bytes.size()));
}

bool equal(const Datagram& a, const Datagram& b);

}  // namespace phare::test
