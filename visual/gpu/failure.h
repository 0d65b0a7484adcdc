// What a person is told of a failure of the graphics device.
#pragma once

#include <exception>
#include <string>

namespace phare::gpu {

/// The failure's own words; of a device that is gone (VK_ERROR_DEVICE_LOST: the driver was reset, the GPU hung or was
/// taken away) that it is, and that a process begun anew gets it back.
std::string reason_of(const std::exception& failure);

}  // namespace phare::gpu
