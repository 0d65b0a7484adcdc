// What to do where a machine lacks something, in one wording for phare doctor and for the command that fails.
#pragma once

#include <string>

#include "config/base/result.h"

namespace phare {

inline constexpr const char* kVulkanRemedy = "apt-get install mesa-vulkan-drivers (draws without a GPU)";
inline constexpr const char* kValidationRemedy = "apt-get install vulkan-validationlayers";
inline constexpr const char* kVideoRemedy = "apt-get install ffmpeg";
inline constexpr const char* kCanLogRemedy =
    "apt-get install python3-can (MF4: pip install python-can asammdf in a venv, and PHARE_PYTHON=VENV/bin/python)";
inline constexpr const char* kReferenceRemedy =
    "apt-get install libsundials-dev and cmake --preset release before the next ./phare";
inline constexpr const char* kDisplayRemedy = "apt-get install xvfb xauth, and xvfb-run, for a virtual one";

/// An error of the Vulkan loader that finds no driver, in words and with the package that brings one; others as they
/// are.
inline Error with_remedy(const Error& error) {
  if (error.place != "vulkan" || error.reason.find("IncompatibleDriver") == std::string::npos) return error;
  return {"vulkan", "no Vulkan device (" + error.reason + "); " + kVulkanRemedy};
}

}  // namespace phare
