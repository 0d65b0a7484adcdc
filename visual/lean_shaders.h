// The shaders of what most of a night drive is (shaders/lean.frag): two lamps at most, of one colour, light dry surfaces
// in clear air by the method "fragment". Each is made when it is first called for.
#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "visual/gpu/vulkan.h"

namespace phare {

namespace gpu {
struct Device;
}

struct LeanKind {
  enum class Surface : std::uint8_t {
    kSmooth,  ///< the normal changes over a triangle
    kFlat,    ///< it is that of the triangle's plane
    kPlain    ///< the same, without detail, without light sent back, seen from one side
  };
  Surface surface = Surface::kSmooth;
  bool alike = false;  ///< the tables of both lamps have the same axes
  bool shadows = false;

  friend auto operator<=>(const LeanKind&, const LeanKind&) = default;
};

class LeanShaders {
 public:
  explicit LeanShaders(const gpu::Device& device) : device_(&device) {}
  struct Stages {
    vk::raii::ShaderModule vertex;
    std::span<const std::uint32_t> fragment;
  };
  const Stages& stages(const LeanKind& kind);

 private:
  const gpu::Device* device_;
  std::map<LeanKind, Stages> made_;
};

}  // namespace phare
