// Whether a device's memory holds a picture: asked before it is tried, as a software device takes the machine down.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace phare {

/// Why a picture is too large for a device with so much memory of its own, of which half is left to scene and lamps;
/// nothing: it fits. By the largest images of a frame: HDR of 16-bit floats and depth by sample, HDR and display by
/// pixel.
inline std::optional<std::string> too_large(std::uint32_t width_px, std::uint32_t height_px, int samples,
                                            std::uint64_t device_bytes) {
  constexpr double kHdr = 8.0, kDepth = 4.0, kDisplay = 4.0;  // bytes
  const double needed = static_cast<double>(width_px) * height_px * (samples * (kHdr + kDepth) + kHdr + kDisplay);
  const auto there = static_cast<double>(device_bytes);
  if (needed <= 0.5 * there) return std::nullopt;
  char text[160];
  std::snprintf(text, sizeof text,
                "a picture of %u × %u with %d samples a pixel takes %.1f GB, more than half of the device's %.1f GB",
                width_px, height_px, samples, needed * 1e-9, there * 1e-9);
  return text;
}

}  // namespace phare
