// Shaders (SPIR-V 1.6, Khronos) changed before a device compiles them: what specialization constants switch off within
// a shader, a device reads and copies into each place that calls it, and throws away after.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace phare::gpu {

/// The shader, in which the function of this name, with any arguments, is nothing but `return 1.0`; without names. As
/// it was, where it has no such function or no constant 1.0. The names of functions are in what glslang writes.
std::vector<std::uint32_t> returning_one(std::span<const std::uint32_t> code, std::string_view function);

}  // namespace phare::gpu
