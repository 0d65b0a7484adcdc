// The shaders of what most of a night drive is (shaders/lean.frag): two lamps at most, of one colour, light dry
// surfaces in clear air by the method "fragment".
#pragma once

#include <cstdint>
#include <span>

namespace phare {

struct LeanKind {
  enum class Surface : std::uint8_t {
    kSmooth,  ///< the normal changes over a triangle
    kFlat,    ///< it is that of the triangle's plane
    kPlain    ///< the same, without detail, without light sent back, seen from one side
  };
  Surface surface = Surface::kSmooth;
  bool alike = false;  ///< the tables of both lamps have the same axes
  bool shadows = false;
};

struct LeanCode {
  std::span<const std::uint32_t> vertex, fragment;
};
const LeanCode& lean_code(const LeanKind& kind);

}  // namespace phare
