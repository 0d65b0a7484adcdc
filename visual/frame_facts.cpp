#include "visual/frame_facts.h"

#include <numbers>

namespace phare {

EffectFacts facts_of(const ViewInput& view, const LampsInView& lamps, std::optional<std::size_t> casters,
                     const DrawnOver& over, std::span<const GlaringLamp> glare, std::size_t pupils,
                     std::size_t spraying, const DeviceFacts& device) {
  double glare_lx = 0.0;
  for (const GlaringLamp& source : glare) glare_lx += source.eye_lx;
  return {.lit_lamps = lamps.lit,
          .casters = casters,
          .wide_lamps = lamps.wide,
          .shadow_maps = device.shadow_maps,
          .shadow_rays = device.shadow_rays,
          .hdr_wanted = view.want_hdr,
          .false_colour = view.view != View::kPhoto && view.view != View::kClipping,
          .clipping = view.view == View::kClipping,
          .overlay_lines = over.lines,
          .air = view.air,
          .air_lamps = lamps.air,
          .parallel_rays = view.camera.orthographic_width_m > 0.0,
          .glare_lamps = glare.size(),
          .glare_lx = glare_lx,
          .pupils = pupils,
          .snow_cover_01 = view.snow_cover_01,
          .windscreen = view.windscreen.has_value(),
          .spraying = spraying,
          .gui = over.gui};
}

void add_facts(EffectFacts& facts, const FixedLight& light, const glm::dvec3& eye_m) {
  facts.street_lamps = light.street_lamps();
  facts.moon = light.moon();
  facts.directional = light.directional();
  facts.luminous = light.luminous();
  facts.covered = light.covered();
  facts.roofed = facts.air.falls() && light.roofed(eye_m);
  facts.reflecting = light.reflecting();
  facts.too_many_reflecting = light.too_many_reflecting();
  facts.r_table = light.r_table();
}

std::vector<GlaringLamp> glare_of(const ViewInput& view, const ViewGeometry& geometry) {
  return glare_seen(geometry, view.glare, view.viewer, view.exposure_per_cdm2);
}

std::vector<PupilInPicture> pupils_of(const ViewInput& view, const ViewGeometry& geometry, double width_px,
                                      double height_px) {
  return pupils_seen(geometry, width_px, height_px, view.pupils, view.exposure_per_cdm2);
}

bool looks_for_casters(const ViewInput& view) {
  constexpr auto kShadows = static_cast<std::size_t>(Effect::kShadows);
  return (view.effects[kShadows] ? view.effects : view.picked)[kShadows] != std::size_t{0};
}

bool whole_casters(const ViewInput& view) {
  constexpr auto kShadows = static_cast<std::size_t>(Effect::kShadows);
  return (view.effects[kShadows] ? view.effects : view.picked)[kShadows].value_or(0) >= kWholeCasters;
}

double faint_lx(const ViewInput& view) {
  return whole_casters(view) ? 0.0 : std::numbers::pi * kFaintShown / view.exposure_per_cdm2;
}

bool asks_for_rays(const ViewInput& view) {
  constexpr auto kShadows = static_cast<std::size_t>(Effect::kShadows);
  return (view.effects[kShadows] ? view.effects : view.picked)[kShadows].value_or(0) >= kRayShadows;
}

DrawnOver drawn_over(const FrameInput& input) {
  return {.lines = input.overlay.size() + input.instruments.size() + input.panel.rows.size() +
                   (input.panel.title.empty() ? 0u : 1u) + input.marks.size(),
          .gui = input.gui != nullptr};
}

}  // namespace phare
