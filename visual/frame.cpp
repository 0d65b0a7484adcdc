#include "visual/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "visual/ground_water.h"
#include "visual/passes/spray.h"
#include "visual/scene/far_mesh.h"
#include "visual/shadow_casters.h"

namespace phare {
namespace {

using Usage = vk::ImageUsageFlagBits;

// 16-bit float holds 6e-8 to 65504: a retroreflector at 5 m under 40,000 cd gives 1e5 cd/m² and is clipped there; all
// else fits.
constexpr vk::Format kHdrFormat = vk::Format::eR16G16B16A16Sfloat;

// Without them a frame is what one that calls for none is held to (tests/visual/plain_frame.cpp).
#ifdef PHARE_WITHOUT_EFFECTS
constexpr bool kEffectsBuilt = false;
#else
constexpr bool kEffectsBuilt = true;
#endif

/// A picture that views are drawn into: the frame's, or a view's own.
struct Picture {
  std::string name;  ///< before the names of its images
  vk::Extent2D extent{};
  gpu::Image* display = nullptr;
  bool begun = false;  ///< a view has been drawn
};

/// A view and where it is drawn.
struct PlacedView {
  const ViewInput& input;
  std::size_t number;  ///< 0: the frame's own
  std::string name;
  Picture& picture;
  vk::Rect2D area{};
};

vk::Rect2D area_of(const PicturePart& part, vk::Extent2D extent) {
  const auto edge = [](double at_01, std::uint32_t side) {
    return static_cast<std::int32_t>(std::lround(std::clamp(at_01, 0.0, 1.0) * side));
  };
  const std::int32_t left = std::min(edge(part.left_01, extent.width), static_cast<std::int32_t>(extent.width) - 1);
  const std::int32_t top = std::min(edge(part.top_01, extent.height), static_cast<std::int32_t>(extent.height) - 1);
  const std::int32_t right = std::max(edge(part.left_01 + part.width_01, extent.width), left + 1);
  const std::int32_t bottom = std::max(edge(part.top_01 + part.height_01, extent.height), top + 1);
  return {{left, top}, {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)}};
}

LampOutput output_of(View view) {
  switch (view) {
    case View::kFalseColour:
      return LampOutput::kFalseColour;
    case View::kClipping:
      return LampOutput::kClipping;
    case View::kDifference:
      return LampOutput::kDifference;
    case View::kRatio:
      return LampOutput::kRatio;
    case View::kPhoto:
      break;
  }
  return LampOutput::kDisplay;
}

/// Far meshes are made for pixels of kFarMeshPixel_rad: where a picture's are finer, or its eye looks through a
/// narrower angle, they begin as much farther away.
double far_mesh_from_m(const PlacedView& view) {
  // Rays are asked against the triangles in full: what lies a little below them would be dark.
  if (asks_for_rays(view.input)) return std::numeric_limits<double>::infinity();
  const Camera& camera = view.input.camera;
  const double pixel_rad =
      camera.fov_horizontal_rad * (camera.seen_to_01 - camera.seen_from_01) / view.area.extent.width;
  return view.input.far_mesh_from_m * std::max(1.0, kFarMeshPixel_rad / pixel_rad);
}

static_assert(kFarCasters * kFarMeshFrom_m * kFarLevels[kFarCasterLevels - 1].from < kShadowsTo_m &&
              kFarCasters * kFarMeshFrom_m * kFarLevels[kFarCasterLevels].from >= kShadowsTo_m);

/// Fog is asked for at a level with shadows: those in light that falls on no surface in view are seen, too.
bool has_shadows_in_air(const ViewInput& view) {
  constexpr auto kFog = static_cast<std::size_t>(Effect::kFog);
  const std::size_t level = (view.effects[kFog] ? view.effects : view.picked)[kFog].value_or(0);
  return !view.air.clear() && has_shadows(std::min(level, kFogLevels.size() - 1));
}

/// While it lives, what the graph is given is counted for an effect.
class CountedFor {
 public:
  CountedFor(Effect effect, gpu::FrameGraph& graph) : graph_(graph) { graph_.set_account(account_of(effect)); }
  ~CountedFor() { graph_.set_account(gpu::kFrameAccount); }
  CountedFor(const CountedFor&) = delete;
  CountedFor& operator=(const CountedFor&) = delete;

 private:
  gpu::FrameGraph& graph_;
};

/// What one view calls for, and no more. `over`: what will lie over it.
ViewResult draw_view(FrameParts& parts, const PlacedView& view, const DrawnOver& over) {
  gpu::FrameGraph& graph = parts.graph;
  const gpu::Counts before = graph.counts();
  const auto image = [&](const char* name, vk::Format format, vk::ImageUsageFlags usage,
                         vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1) {
    return &graph.image(view.picture.name + name, {format, view.picture.extent, usage, samples});
  };
  graph.set_prefix(view.number == 0 ? "" : view.name + ": ");

  // What is seen, by which lamps.
  const double aspect = static_cast<double>(view.area.extent.width) / static_cast<double>(view.area.extent.height);
  LitView lit = parts.scene.view(ViewGeometry(view.input.camera, aspect), sky_of(view.input), view.input.lamps,
                                 view.input.moving, far_mesh_from_m(view), view.input.isolux_lx, view.input.few_kinds);
  lit.method = view.input.method;
  lit.area = view.area;

  // What that calls for, and the images it takes.
  std::vector<GlaringLamp> glare;
  std::vector<PupilInPicture> pupils;
  std::vector<SprayingVehicle> spraying;
  EffectPlan effects;
  if (kEffectsBuilt) {
    std::optional<std::size_t> casters;
    if (looks_for_casters(view.input))
      casters = parts.scene.find_casters(
          lit,
          {.far_from_m = whole_casters(view.input) ? HUGE_VAL : kFarCasters * far_mesh_from_m(view),
           .view = &lit.geometry,
           .faint_lx = faint_lx(view.input)},
          has_shadows_in_air(view.input));
    glare = glare_of(view.input, lit.geometry);
    pupils = pupils_of(view.input, lit.geometry, view.area.extent.width, view.area.extent.height);
    spraying = spraying_seen(lit.geometry, view.input.spraying);
    EffectFacts facts = facts_of(view.input, {lit.lamps, lit.air_lamps.size(), parts.scene.wide_lamps(lit)}, casters,
                                 over, glare, pupils.size(), spraying.size(), parts.device_facts);
    add_facts(facts, parts.scene.fixed_light(), view.input.camera.eye_m);
    effects = plan_effects(facts, view.input.effects, view.input.picked);
  }
  const auto on = [&](Effect effect) { return kEffectsBuilt && effects.on(effect); };
  const bool hdr = on(Effect::kHdrImage);
  gpu::Image* depth = image("depth", vk::Format::eD32Sfloat, Usage::eDepthStencilAttachment, parts.target.samples);
  gpu::Image* light = view.picture.display;
  LampOutput output = output_of(view.input.view);
  if (hdr) {
    const CountedFor counted(Effect::kHdrImage, graph);
    light = image("hdr_cdm2", kHdrFormat, Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc);
    output = LampOutput::kHdr;
  }
  gpu::Image* samples = nullptr;
  if (parts.target.samples != vk::SampleCountFlagBits::e1)
    samples = image(hdr ? "hdr samples" : "samples", light->format, Usage::eColorAttachment, parts.target.samples);
  const bool first = !std::exchange(view.picture.begun, true);

  // What each lamp sees, where something stands in its light.
  if (on(Effect::kShadows)) {
    const CountedFor counted(Effect::kShadows, graph);
    parts.shadows.draw(graph, parts.scene, lit, effects.level(Effect::kShadows),
                       has_shadows(effects.level(Effect::kFog)));
  }

  // What fog scatters of the light.
  if (on(Effect::kFog)) {
    const CountedFor counted(Effect::kFog, graph);
    parts.fog.draw(graph, parts.scene, lit, effects.level(Effect::kFog), view.input, view.area, hdr,
                   on(Effect::kPrecipitation));
  }

  // Which drops fall past the eye.
  if (on(Effect::kPrecipitation)) add_drops(parts.scene, lit, view.input);

  // What vehicles throw up of the water on the ground.
  if (on(Effect::kSpray))
    add_spray(parts.scene, lit, spraying, water_mm(view.input.air.rain_mmph, effects.level(Effect::kWetGround)));

  // Which animals look at the lamps.
  if (on(Effect::kEyeshine)) lit.pupils = std::move(pupils);

  // What water makes of the ground.
  if (on(Effect::kWetGround)) lit.wet_ground(effects.level(Effect::kWetGround));

  // What snow makes of all that looks up.
  if (on(Effect::kSnowCover)) lit.cover_with_snow(view.input.snow_cover_01);

  // What street lamps give, and what shines by itself.
  if (on(Effect::kFixedLight)) parts.scene.add_fixed_light(lit);
  lit.r_table = on(Effect::kAsphalt);

  // Depth of everything, so that each pixel is lit once.
  const bool depth_done = on(Effect::kDepthFirst);
  if (depth_done) {
    const CountedFor counted(Effect::kDepthFirst, graph);
    parts.depth.draw(graph, parts.scene, lit, *depth, view.area);
  }

  // Every surface under every lamp; the sky behind.
  parts.lit.draw(graph, parts.scene, lit,
                 {.colour = samples != nullptr ? *samples : *light,
                  .resolved = samples != nullptr ? light : nullptr,
                  .depth = *depth,
                  .area = view.area,
                  .depth_done = depth_done,
                  .keep = !first && !hdr,
                  .black_around = first && !hdr},
                 output);

  // What is drawn over it: rain on the windscreen, and what a program adds.
  const auto draw_over = [&](DrawsOver what, gpu::Image& picture) {
    for (const PictureEffectKind& kind : picture_effects()) {
      if (kind.over != what || !on(kind.effect)) continue;
      const CountedFor counted(kind.effect, graph);
      parts.picture_effects.draw(kind, {.graph = graph,
                                        .picture = picture,
                                        .area = view.area,
                                        .input = view.input,
                                        .geometry = lit.geometry,
                                        .glare = glare,
                                        .level = effects.level(kind.effect)});
    }
  };
  draw_over(DrawsOver::kLuminance, *light);

  // From cd/m² to the display, with what lamps scatter in the eye. Without an HDR image the lit pass has done it.
  if (on(Effect::kGlare)) {
    const CountedFor counted(Effect::kGlare, graph);
    parts.glare.draw(graph, *light, *view.picture.display, view.area, first, lit.sky.exposure_per_cdm2, lit.geometry,
                     glare, view.input.viewer);
  } else if (hdr) {
    const CountedFor counted(Effect::kHdrImage, graph);
    parts.tone_mapping.draw(graph, *light, *view.picture.display, view.area, first, lit.sky.exposure_per_cdm2);
  }
  draw_over(DrawsOver::kDisplay, *view.picture.display);
  if (hdr && view.input.want_hdr) parts.read_hdr(view.number, *light, view.area);

  // What the next view may use.
  graph.release(*depth);
  if (hdr) graph.release(*light);
  if (samples != nullptr) graph.release(*samples);
  const gpu::Counts counts = graph.counts().since(before);
  return {.name = view.name,
          .effects = effects,
          .lamps = lit.lamps,
          .lamps_unreached = lit.unreached,
          .lamps_over_limit = lit.over_limit,
          .lamps_without_map = lit.without_map,
          .passes = counts.passes,
          .draws = counts.draws,
          .triangles = counts.triangles};
}

}  // namespace

std::vector<ViewResult> draw_frame(FrameParts& parts, const FrameInput& input, gpu::Image*& display) {
  const auto picture = [&](const std::string& of_view, vk::Extent2D extent) {
    const std::string name = parts.target.name + of_view;
    return Picture{name, extent,
                   &parts.graph.image(name + "display", {parts.target.display_format, extent,
                                                         Usage::eColorAttachment | Usage::eTransferSrc})};
  };
  const DrawnOver over = drawn_over(input);
  parts.scene.begin_frame(parts.graph, input.shapes);
  parts.shadows.begin_frame(parts.target.seen);
  parts.fog.begin_frame();
  parts.lit.begin_frame();
  parts.glare.begin_frame();
  parts.picture_effects.begin_frame();
  parts.tone_mapping.begin_frame();
  Picture seen = picture("", parts.target.extent);
  display = seen.display;

  // The frame's own view, then the others, each into its part of the picture or into one of its own.
  std::vector<ViewResult> views;
  views.push_back(draw_view(
      parts, {input, 0, input.name.empty() ? "view 1" : input.name, seen, area_of(input.part, seen.extent)}, over));
  for (const ViewInput& view : input.more_views) {
    const std::size_t number = views.size();
    const std::string name = view.name.empty() ? "view " + std::to_string(number + 1) : view.name;
    if (!view.own_picture) {
      views.push_back(draw_view(parts, {view, number, name, seen, area_of(view.part, seen.extent)}, {}));
      continue;
    }
    Picture own = picture(std::to_string(number + 1) + ": ", {static_cast<std::uint32_t>(view.own_picture->width_px),
                                                              static_cast<std::uint32_t>(view.own_picture->height_px)});
    const vk::Rect2D area = area_of(view.part, own.extent);
    views.push_back(draw_view(parts, {view, number, name, own, area}, {}));
    if (view.want_image) parts.read_image(number, *own.display, area);
    parts.graph.release(*own.display);
  }
  parts.graph.set_prefix("");

  // What the driver is told besides.
  if (kEffectsBuilt && views.front().effects.on(Effect::kOverlay)) {
    const CountedFor counted(Effect::kOverlay, parts.graph);
    if (!parts.overlay)
      parts.overlay =
          std::make_unique<OverlayPass>(parts.device, parts.target.display_format, parts.target.extent.height);
    parts.overlay->draw(parts.graph, *seen.display, input.overlay, input.instruments, input.panel, input.marks,
                        input.room);
  }

  // What is set by the mouse.
  if (kEffectsBuilt && views.front().effects.on(Effect::kGui)) {
    const CountedFor counted(Effect::kGui, parts.graph);
    parts.gui.draw(parts.graph, *seen.display, *input.gui);
  } else if (parts.target.seen) {
    parts.gui.hide();
  }

  // What is kept of the finished picture.
  if (input.want_image) parts.read_image(0, *seen.display, {{0, 0}, seen.extent});
  for (std::size_t i = 0; i < input.more_views.size(); ++i)
    if (const ViewInput& view = input.more_views[i]; view.want_image && !view.own_picture)
      parts.read_image(i + 1, *seen.display, area_of(view.part, seen.extent));
  return views;
}

glm::vec3 exposure_of(const ViewInput& input) {
  return static_cast<float>(input.exposure_per_cdm2) / input.white.value_or(black_body_colour(input.adaptation_k));
}

Sky sky_of(const ViewInput& input) {
  return {exposure_of(input), input.sky_luminance_cdm2};
}

}  // namespace phare
