// The one way Vulkan comes in: vulkan.hpp RAII, structs with designated initializers. Slow to compile: only for
// visual/gpu, visual/passes and the renderer, through the precompiled header.
#pragma once

#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>
