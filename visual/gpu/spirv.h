// Shaders (SPIR-V 1.6, Khronos) made less before a device compiles them: what specialization constants switch off
// within a shader, a software device reads and copies into each place that calls it, and throws away after, which takes
// it longer than all the rest. By SPIRV-Tools, in some hundredths of a second. Any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visual/gpu/vulkan.h"

namespace phare::gpu {

/// The shader with these values of its specialization constants for good (those that are not named: their defaults),
/// without the branches and functions that nothing reaches then. What it computes is the same, bit for bit. All
/// constants are words of 32 bits. Throws std::runtime_error with the reason, where it is no shader.
std::vector<std::uint32_t> specialised(std::span<const std::uint32_t> code, const vk::SpecializationInfo& constants);

}  // namespace phare::gpu
