#include "visual/lean_shaders.h"

#include <array>
#include <span>

#include "shaders/lean_frag_flat.h"
#include "shaders/lean_frag_flat_alike.h"
#include "shaders/lean_frag_flat_alike_shadows.h"
#include "shaders/lean_frag_flat_shadows.h"
#include "shaders/lean_frag_plain.h"
#include "shaders/lean_frag_plain_alike.h"
#include "shaders/lean_frag_plain_alike_shadows.h"
#include "shaders/lean_frag_plain_shadows.h"
#include "shaders/lean_frag_smooth.h"
#include "shaders/lean_frag_smooth_alike.h"
#include "shaders/lean_frag_smooth_alike_shadows.h"
#include "shaders/lean_frag_smooth_shadows.h"
#include "shaders/lean_vert_flat.h"
#include "shaders/lean_vert_flat_alike.h"
#include "shaders/lean_vert_flat_alike_shadows.h"
#include "shaders/lean_vert_flat_shadows.h"
#include "shaders/lean_vert_plain.h"
#include "shaders/lean_vert_plain_alike.h"
#include "shaders/lean_vert_plain_alike_shadows.h"
#include "shaders/lean_vert_plain_shadows.h"
#include "shaders/lean_vert_smooth.h"
#include "shaders/lean_vert_smooth_alike.h"
#include "shaders/lean_vert_smooth_alike_shadows.h"
#include "shaders/lean_vert_smooth_shadows.h"
#include "visual/gpu/device.h"

namespace phare {
namespace {

using LeanWords = std::span<const std::uint32_t>;
struct LeanCode {
  LeanWords vertex, fragment;
};

/// By surface, then by alike, then by shadows.
constexpr std::array<LeanCode, 12> kCode{{
    {k_lean_vert_smooth, k_lean_frag_smooth},
    {k_lean_vert_smooth_shadows, k_lean_frag_smooth_shadows},
    {k_lean_vert_smooth_alike, k_lean_frag_smooth_alike},
    {k_lean_vert_smooth_alike_shadows, k_lean_frag_smooth_alike_shadows},
    {k_lean_vert_flat, k_lean_frag_flat},
    {k_lean_vert_flat_shadows, k_lean_frag_flat_shadows},
    {k_lean_vert_flat_alike, k_lean_frag_flat_alike},
    {k_lean_vert_flat_alike_shadows, k_lean_frag_flat_alike_shadows},
    {k_lean_vert_plain, k_lean_frag_plain},
    {k_lean_vert_plain_shadows, k_lean_frag_plain_shadows},
    {k_lean_vert_plain_alike, k_lean_frag_plain_alike},
    {k_lean_vert_plain_alike_shadows, k_lean_frag_plain_alike_shadows}}};

}  // namespace

const LeanShaders::Stages& LeanShaders::stages(const LeanKind& kind) {
  const auto found = made_.find(kind);
  if (found != made_.end()) return found->second;
  const LeanCode& code = kCode[4 * static_cast<std::size_t>(kind.surface) + (kind.alike ? 2 : 0) + (kind.shadows ? 1 : 0)];
  return made_.emplace(kind, Stages{gpu::make_shader(*device_, code.vertex), code.fragment}).first->second;
}

}  // namespace phare
