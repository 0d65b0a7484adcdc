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

namespace phare {
namespace {

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

const LeanCode& lean_code(const LeanKind& kind) {
  return kCode[4 * static_cast<std::size_t>(kind.surface) + (kind.alike ? 2 : 0) + (kind.shadows ? 1 : 0)];
}

}  // namespace phare
