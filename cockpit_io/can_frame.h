// One frame on a CAN bus, classic or FD, as a socket or a log gives it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace phare {

/// Whose frames.
struct CanId {
  std::uint32_t id = 0;
  bool extended = false;

  friend bool operator==(const CanId&, const CanId&) = default;
};

struct CanFrame {
  static constexpr std::uint32_t kStandardIdMax = 0x7FFu, kExtendedIdMax = 0x1FFF'FFFFu;  // 11 and 29 bits
  static constexpr std::size_t kMaxLength = 64;                                           // ISO 11898-1:2015, CAN FD

  std::uint32_t id = 0;   ///< 11 or 29 bits; of an error frame: the error class bits of linux/can/error.h
  bool extended = false;  ///< 29-bit id
  bool remote = false;    ///< asks for data, carries none
  bool error = false;     ///< not from the bus: the controller's report
  bool fd = false;
  std::uint8_t fd_flags = 0;  ///< 1 bit-rate switch, 2 error state indicator
  std::uint8_t length = 0;    ///< bytes of data; of a remote frame: bytes asked for
  std::array<std::uint8_t, kMaxLength> data{};

  std::span<const std::uint8_t> bytes() const { return {data.data(), remote ? std::size_t{0} : length}; }
  bool carries_data() const { return !remote && !error; }

  friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

}  // namespace phare
