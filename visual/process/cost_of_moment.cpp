#include "visual/process/cost_of_moment.h"

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "visual/process/eyeshine_of_lamps.h"
#include "visual/process/glare_into_eye.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/panel.h"
#include "visual/process/picture_instruments.h"
#include "visual/process/versus.h"

namespace phare {
namespace {

/// Chosen: more than what a grid of fog may be off and be kept, and the same is seen.
constexpr double kTurn_rad = 1e-3;

void upload(Renderer& renderer, const std::vector<Lamps::Change>& changes) {
  for (const Lamps::Change& change : changes) renderer.set_beam(change.position, *change.image);
}

/// The eyes besides the first, with what shines into each.
void add_views(FrameInput& input, const Desk& desk, const MomentScene& from, const AskedMoment& moment,
               const Lamps& lamps) {
  World world(from.scene, from.movers.meshes());
  world.move(input.moving);
  const Pupils pupils(from.scene, from.movers.meshes());
  const auto users = from.traffic.at(moment.time.seconds(), from.road);
  const bool two = desk.layout != Layout::kFull;
  const CameraEye second = two ? eye_named(desk, desk.second_camera) : CameraEye{};
  FrameInput others = input;  // the first eye's alone: its screen, its own car
  others.windscreen.reset();
  others.moving = from.traffic.placed_meshes(users);
  for (PlacedLamp& lamp : others.lamps)
    if (!Traffic::is_theirs(lamp)) lamp.carried_by = SIZE_MAX;
  if (desk.mirrors) others.more_views = mirror_views(others, from.channel, moment.pose);
  if (two) {
    lay_out(others, desk.layout, camera_of(second, seen_by(second, from.channel, lamps, moment.pose, &from.road)),
            desk.second_camera);
    others.more_views.back().falling = falling_past(second, moment.pose, moment.time);
    input.part = others.part, input.camera = others.camera;
  }
  for (ViewInput& view : others.more_views) {
    view.pupils = eyeshine_of(lamps, moment.pose, pupils, world, view.camera.eye_m, view.air);
    view.glare = glare_into_eye(view, lamps, {moment.pose, from.traffic, users, from.fixed, world});
  }
  const bool lit = moment.controls.light_switch != LightSwitch::kOff;
  if (two) from.props.add_to(others.more_views.back(), second.kind, lamps, moment.pose, lit, world);
  input.more_views = std::move(others.more_views);
  input.room = room_beside(desk);
}

/// The other of two designs beside the first.
void add_versus(FrameInput& input, const Desk& desk, const Versus& versus, const AskedMoment& moment,
                const MomentScene& from) {
  World world(from.scene, from.movers.meshes());
  world.move(input.moving);
  std::vector<PlacedLamp> of_others = input.lamps;
  std::erase_if(of_others, [](const PlacedLamp& lamp) { return !Traffic::is_theirs(lamp); });
  const glm::dvec3 eye_m = input.camera.eye_m;
  const auto users = from.traffic.at(moment.time.seconds(), from.road);
  std::vector<GlaringLamp> glare =
      glare_into_eye(input, *versus.lamps(), {moment.pose, from.traffic, users, from.fixed, world});
  versus.show(input, desk.compare, moment.pose, of_others, std::move(glare));
  if (desk.compare == Compare::kSplit)
    input.more_views.front().pupils =
        eyeshine_of(*versus.lamps(), moment.pose, Pupils(from.scene, from.movers.meshes()), world, eye_m, input.air);
}

FrameInput input_of(Lamps& lamps, const Desk& desk, const MomentScene& from, const MomentDrawn& drawn,
                    const AskedMoment& moment, const Versus& versus, double aspect) {
  FrameInput input =
      frame_of_moment(lamps, desk, from.channel, moment, from.scene, from.movers, from.traffic, from.road, from.fixed);
  const bool halves = versus.lamps() != nullptr && desk.compare != Compare::kFlicker;
  if (halves) input.view = desk.view;  // as it is before the two are shown
  add_views(input, desk, from, moment, lamps);
  // What is measured in the picture and drawn over it.
  World world(from.scene, from.movers.meshes());
  world.move(input.moving);
  PictureInstruments measuring(desk, lamps, world, from.road, ProbeLog({}, false),
                               from.fixed.any() ? &from.fixed : nullptr);
  const bool wall = desk.camera == CameraKind::kWall;
  measuring.see({.time = moment.time,
                 .car = moment.pose,
                 .picture = &input,
                 .aspect = aspect,
                 .wall = wall ? std::optional(wall_before(lamps, moment.pose)) : std::nullopt});
  input.marks = measuring.marks(true);
  if (versus.lamps() != nullptr && desk.compare != Compare::kOff)
    mark_versus(input.marks, desk, lamps, versus, moment.time);
  for (const ViewInput& inset : input.more_views) {
    keep_clear(input.marks, inset.part);
    frame_part(input.marks, inset.part);
  }
  if (drawn.window) lay_over(input, lamps, desk, moment);
  if (halves) add_versus(input, desk, versus, moment, from);
  if (!drawn.lockstep) input.shapes = ShapesFrom::kEither, input.few_kinds = true;
  for (ViewInput& view : input.more_views) view.few_kinds = input.few_kinds;
  return input;
}

}  // namespace

std::string cost_of_moment(Renderer& renderer, Lamps& lamps, const Desk& desk, const MomentScene& from,
                           const MomentDrawn& drawn) {
  const PictureSize size = renderer.picture_size();
  const CockpitState controls = shown_by_desk(desk, drawn.moment.controls);
  upload(renderer, lamps.set_controls(controls));
  Versus versus;
  upload(renderer, versus.follow(desk, lamps, controls));
  for (std::size_t beam = 0; beam < from.traffic.beams(); ++beam)
    renderer.set_beam(Traffic::kBeam + beam, from.traffic.beam(beam));
  const double aspect = static_cast<double>(size.width_px) / size.height_px;
  AskedMoment before = drawn.before;
  before.controls = drawn.moment.controls;  // one light: beams are uploaded once
  const FrameInput as_before = input_of(lamps, desk, from, drawn, before, versus, aspect);
  FrameInput input = input_of(lamps, desk, from, drawn, drawn.moment, versus, aspect);

  // A software device makes its code when a pipeline first draws.
  constexpr int kMostWarm = 8;
  const FrameResult first = renderer.draw(input);
  std::unique_ptr<Panel> panel;
  if (drawn.window && desk.panel) {
    panel = std::make_unique<Panel>(size.height_px);
    (void)panel->lay_out({.lit = lamps.lit_text(),
                          .design = lamps.design_index(),
                          .lamps = panel_lamps(lamps),
                          .desk = desk,
                          .frame = first},
                         size.width_px, size.height_px, 0.0);
    input.gui = &panel->content();
    input.room = {.left_01 = panel->right_px() / size.width_px};
  }
  for (int i = 0; i < kMostWarm; ++i) {
    (void)renderer.draw(as_before);
    if (renderer.draw(input).pipelines_made == 0 && i > 0) break;
  }
  FrameStats stats;
  for (std::int64_t i = 0; i < drawn.frames; ++i) {
    (void)renderer.draw(as_before);
    stats.add(renderer.draw(input), false);
  }
  FrameInput turned = as_before;
  turned.camera.world_from_eye =
      turned.camera.world_from_eye * glm::dmat3(glm::rotate(glm::dmat4(1.0), kTurn_rad, {0, 0, 1}));
  (void)renderer.draw(turned);
  return explain_costs(stats, renderer.draw(input), size);
}

}  // namespace phare
