// Cyclic redundancy checks by their parameters, as G. Cook's catalogue lists them ("CRC RevEng"), and by name.
#pragma once

#include <cstdint>
#include <span>

namespace phare {

struct CrcParams {
  int width = 8;  ///< 3 … 32 bits
  std::uint32_t polynomial = 0;
  std::uint32_t init = 0;
  bool reflected = false;  ///< input and output
  std::uint32_t xor_out = 0;
};

inline constexpr CrcParams kCrc8{8, 0x07, 0x00, false, 0x00};                     // CRC-8/SMBUS
inline constexpr CrcParams kCrc8SaeJ1850{8, 0x1D, 0xFF, false, 0xFF};             // CRC-8/SAE-J1850
inline constexpr CrcParams kCrc8E2eProfile1{8, 0x1D, 0x00, false, 0x00};          // AUTOSAR E2E: its own start and xor
inline constexpr CrcParams kCrc8H2f{8, 0x2F, 0xFF, false, 0xFF};                  // CRC-8/AUTOSAR
inline constexpr CrcParams kCrc16CcittFalse{16, 0x1021, 0xFFFF, false, 0x0000};   // CRC-16/IBM-3740
inline constexpr CrcParams kCrc16Arc{16, 0x8005, 0x0000, true, 0x0000};           // CRC-16/ARC
inline constexpr CrcParams kCrc32{32, 0x04C11DB7, 0xFFFFFFFF, true, 0xFFFFFFFF};  // CRC-32/ISO-HDLC
inline constexpr CrcParams kCrc32P4{32, 0xF4ACFB13, 0xFFFFFFFF, true, 0xFFFFFFFF};  // CRC-32/AUTOSAR

class Crc {
 public:
  explicit Crc(const CrcParams& params) : params_(params), register_(params.init) {}

  void add(std::uint8_t byte) {
    const std::uint32_t top = std::uint32_t{1} << (params_.width - 1);
    for (int i = 0; i < 8; ++i) {
      const std::uint32_t bit = params_.reflected ? (byte >> i) & 1u : (byte >> (7 - i)) & 1u;
      const bool carry = ((register_ & top) != 0) != (bit != 0);
      register_ <<= 1;
      if (carry) register_ ^= params_.polynomial;
    }
    register_ &= params_.width == 32 ? 0xFFFF'FFFFu : (std::uint32_t{1} << params_.width) - 1;
  }
  void add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) add(byte);
  }

  std::uint32_t value() const {
    std::uint32_t out = register_;
    if (params_.reflected) {
      out = 0;
      for (int i = 0; i < params_.width; ++i) out |= ((register_ >> i) & 1u) << (params_.width - 1 - i);
    }
    return out ^ params_.xor_out;
  }

 private:
  CrcParams params_;
  std::uint32_t register_;
};

}  // namespace phare
