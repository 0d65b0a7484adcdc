// What the effects are decided by (visual/effects.h), of a view that is asked for. Pure: `--explain` has it without a
// device.
#pragma once

#include "visual/effects.h"
#include "visual/fixed_light.h"
#include "visual/renderer.h"

namespace phare {

/// What a device can do, as the effects ask for it.
struct DeviceFacts {
  bool shadow_maps = true;  ///< it holds one
  bool shadow_rays = true;  ///< it holds the scene's triangles
};

/// What lies over the frame's picture.
struct DrawnOver {
  std::size_t lines = 0;  ///< of text
  bool gui = false;       ///< the panel
};

/// Lamps whose light reaches into a view.
struct LampsInView {
  std::size_t lit = 0;  ///< that light something in it
  std::size_t air = 0;  ///< whose light goes through what it sees of the air
  std::size_t wide = 0;  ///< of those that are lit, LightPeaks::is_wide()
};

/// `casters`: pieces of the scene that stand in their light, where they
/// were looked for; `over`: what will lie over it; `glare`: glare_of() it;
/// `pupils`: how many pupils_of() it; `spraying`: how many spraying_seen() by it.
EffectFacts facts_of(const ViewInput& view, const LampsInView& lamps, std::optional<std::size_t> casters,
                     const DrawnOver& over, std::span<const GlaringLamp> glare, std::size_t pupils,
                     std::size_t spraying, const DeviceFacts& device);

/// What shines in the scene and does not change.
void add_facts(EffectFacts& facts, const FixedLight& light, const glm::dvec3& eye_m);

/// Lamps whose light the eye of the view scatters over its picture (glare_seen).
std::vector<GlaringLamp> glare_of(const ViewInput& view, const ViewGeometry& geometry);

/// Animals' eyes that the view shows (pupils_seen).
std::vector<PupilInPicture> pupils_of(const ViewInput& view, const ViewGeometry& geometry, double width_px,
                                      double height_px);

/// The user has not switched shadows off.
bool looks_for_casters(const ViewInput& view);

/// The user wants a level of shadows at which things cast with all their triangles, however far they are.
bool whole_casters(const ViewInput& view);
/// CastersFor::faint_lx at the view's exposure: 0 at those levels, else what makes white paper kFaintShown.
double faint_lx(const ViewInput& view);
/// Of the display's white, in linear light: 8 of 255 in a picture, and less than 1 of 255 on leaves. Chosen: 0.01 lx
/// at the exposure of a drive at night, a twentieth of what the full moon gives.
inline constexpr double kFaintShown = 0.0025;
/// The user wants shadows by rays.
bool asks_for_rays(const ViewInput& view);

DrawnOver drawn_over(const FrameInput& input);

}  // namespace phare
