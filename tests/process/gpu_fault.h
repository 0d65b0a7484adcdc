// What is started while this lives has a device or a window that fails (gpu_faults_layer.cpp says how).
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/paths.h"

namespace phare::test {

class GpuFault {
 public:
  /// `told` is a file that is not there yet, and is once the fault has happened; it happens once.
  GpuFault(const std::string& fault, std::filesystem::path told) : told_(std::move(told)) {
    setenv("VK_ADD_LAYER_PATH", (build_dir() + "/lib/phare").c_str(), 1);
    setenv("VK_INSTANCE_LAYERS", "VK_LAYER_PHARE_gpu_faults", 1);
    setenv("PHARE_GPU_FAULT", fault.c_str(), 1);
    setenv("PHARE_GPU_FAULT_TOLD", told_.c_str(), 1);
  }
  ~GpuFault() {
    for (const char* name : {"VK_ADD_LAYER_PATH", "VK_INSTANCE_LAYERS", "PHARE_GPU_FAULT", "PHARE_GPU_FAULT_TOLD"})
      unsetenv(name);
  }
  GpuFault(const GpuFault&) = delete;
  GpuFault& operator=(const GpuFault&) = delete;
  bool happened() const { return std::filesystem::exists(told_); }

 private:
  std::filesystem::path told_;
};

}  // namespace phare::test
