// The grain of surfaces: a tile of noise that repeats, at several finenesses. Fine chippings and soft patches; made
// here, seeded, no file.
#pragma once

#include "visual/gpu/device.h"

namespace phare {

/// The tile in a texel buffer as shaders/lib/grain.glsl reads it: first all chippings, then all patches, each in levels
/// of 512×512, 256×256 … 1×1 texels from the first that the device's texel buffers have room for; a texel is the four
/// corners of a cell. Mean 0.5 in both.
struct Grain {
  gpu::DeviceBuffer texels;
  vk::raii::BufferView view{nullptr};
  std::uint32_t first_level = 0;  ///< 0 where the device holds all; the spec guarantees room from 128×128 on
};

Grain make_grain(gpu::Device& device);

}  // namespace phare
