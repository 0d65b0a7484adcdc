#include "visual/gpu/spirv.h"

#include <cstddef>
#include <cstring>
#include <spirv-tools/optimizer.hpp>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace phare::gpu {

std::vector<std::uint32_t> specialised(std::span<const std::uint32_t> code, const vk::SpecializationInfo& constants) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (std::uint32_t i = 0; i < constants.mapEntryCount; ++i) {
    const vk::SpecializationMapEntry& entry = constants.pMapEntries[i];
    std::uint32_t word = 0;
    if (entry.size != sizeof word) throw std::runtime_error("a shader's constant is no word of 32 bits");
    std::memcpy(&word, static_cast<const std::byte*>(constants.pData) + entry.offset, sizeof word);
    values[entry.constantID] = {word};
  }
  std::string why;
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    why += why.empty() ? message : std::string("; ") + message;
  });
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  std::vector<std::uint32_t> less;
  if (!optimizer.Run(code.data(), code.size(), &less, options))
    throw std::runtime_error("a shader cannot be specialised: " + (why.empty() ? "no SPIR-V" : why));
  return less;
}

}  // namespace phare::gpu
