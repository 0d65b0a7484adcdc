#include "visual/process/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "config/road/lane.h"
#include "visual/air_of_desk.h"
#include "visual/frame_facts.h"
#include "visual/light_reach.h"
#include "visual/process/eyeshine_of_lamps.h"
#include "visual/process/glare_into_eye.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/props.h"
#include "visual/process/screens.h"
#include "visual/process/versus.h"

namespace phare {

Result<AskedMoment> moment_of_drive(const Drive& drive, double at_s) {
  AskedMoment moment;
  const CockpitState* controls = nullptr;
  const VehicleState* pose = nullptr;
  for (const Datagram& datagram : drive.datagrams) {
    if (datagram.sim_time.seconds() > at_s) continue;
    if (const auto* state = std::get_if<CockpitState>(&datagram.payload)) controls = state;
    if (const auto* state = std::get_if<VehicleState>(&datagram.payload)) pose = state;
  }
  if (controls == nullptr || pose == nullptr) {
    char text[80];
    std::snprintf(text, sizeof text, "has no %s until %g s", controls == nullptr ? "CockpitState" : "VehicleState",
                  at_s);
    return Error{"--drive", text};
  }
  moment.time.ns = static_cast<std::int64_t>(at_s * 1e9);
  moment.controls = *controls;
  moment.pose = *pose;
  return moment;
}

AskedMoment moment_at_rest(const std::filesystem::path& scene_file, LightSwitch light, bool fog_front) {
  AskedMoment moment;
  moment.controls.light_switch = light;
  moment.controls.fog_front = fog_front;
  if (const auto start = read_lane_start(lane_file_of(scene_file))) {
    moment.pose.x_m = start->x_m, moment.pose.y_m = start->y_m, moment.pose.z_m = start->z_m;
    moment.pose.yaw_rad = start->heading_rad;
  }
  return moment;
}

FrameInput frame_of_moment(Lamps& lamps, const Desk& desk, const ChannelConfig& channel, const AskedMoment& moment,
                           const Scene& scene, const Movers& movers, const Traffic& traffic, const RoadLine& road,
                           const FixedLight& fixed) {
  const CockpitState controls = shown_by_desk(desk, moment.controls);
  lamps.set_controls(controls);
  FrameInput input;
  set_by_desk(input, desk);
  const CameraEye eye = first_eye(desk);
  input.camera = camera_of(eye, seen_by(eye, channel, lamps, moment.pose, &road));
  input.falling = falling_past(eye, moment.pose, moment.time);
  if (desk.windscreen && eye.kind == CameraKind::kDriver)
    input.windscreen = Windscreen{moment.time.seconds(), moment.pose.speed_mps, desk.wiper};
  // The difference of two designs is of their illuminance: none of what changes luminance alone is called for.
  if (versus_design(desk, lamps)) {
    if (desk.compare == Compare::kDifference) input.view = View::kDifference;
    if (desk.compare == Compare::kRatio) input.view = View::kRatio;
  }
  input.lamps = lamps.placed(moment.pose);
  const std::vector<Traffic::There> users = traffic.at(moment.time.seconds(), road);
  input.moving = traffic.placed_meshes(users);
  if (wet(desk)) input.spraying = traffic.spraying(users, moment.time.seconds(), road);
  World world(scene, movers.meshes());
  world.move(input.moving);
  const std::vector<PlacedLamp> of_others =
      Traffic::placed_lamps(users, input.camera.eye_m, input.camera.world_from_eye[0], lamps_toward_first(desk));
  input.lamps.insert(input.lamps.end(), of_others.begin(), of_others.end());
  input.glare = glare_into_eye(input, lamps, {moment.pose, traffic, users, fixed, world});
  if (const auto props = Props::of(movers))  // whoever has read them has looked
    props->add_to(input, desk.camera, lamps, moment.pose, controls.light_switch != LightSwitch::kOff, world);
  input.pupils = eyeshine_of(lamps, moment.pose, Pupils(scene, movers.meshes()), world, input.camera.eye_m, input.air);
  return input;
}

void lay_over(FrameInput& input, const Lamps& lamps, const Desk& desk, const AskedMoment& moment) {
  const CockpitState controls = shown_by_desk(desk, moment.controls);
  EyeAdaptation eye = eye_set(desk.eye);
  eye.see(moment.time, lamps.light());
  input.overlay =
      overlay_lines(desk, lamps, {.time = moment.time, .controls = controls, .pose = moment.pose, .eye = eye});
  if (desk.instruments) input.instruments = instruments(controls, moment.pose, lamps.design().name, moment.time);
  input.panel = Screens({}).panel(controls, moment.time.seconds(), desk.help);
}

std::string moment_text(const Lamps& lamps, const AskedMoment& moment, const std::string& device) {
  return fmt::format("# lit: {}, design \"{:.60}\", {:.1f} s, {:.0f} km/h, on {:.80}\n", lamps.lit_text(),
                     lamps.design().name, moment.time.seconds(), moment.pose.speed_mps * 3.6, device);
}

std::string explain_moment(Lamps& lamps, const Desk& desk, const ChannelConfig& channel, const AskedMoment& moment,
                           const std::string& device, const Scene& scene, const Movers& movers, const Traffic& traffic,
                           const RoadLine& road, const FixedLight& fixed, bool window) {
  FrameInput input = frame_of_moment(lamps, desk, channel, moment, scene, movers, traffic, road, fixed);
  if (window) lay_over(input, lamps, desk, moment);
  // Those whose light the view can see; what of the scene it falls on is not asked.
  const ViewGeometry view(input.camera, static_cast<double>(channel.width_px) / channel.height_px);
  std::size_t lit = 0, wide = 0;
  std::optional<std::vector<std::shared_ptr<const CastBy>>> casts;
  std::optional<ShadowCasters> casters;
  if (looks_for_casters(input)) casts.emplace(), casters.emplace(scene, movers.meshes());
  for (const PlacedLamp& lamp : input.lamps) {
    const BeamImage& image =
        Traffic::is_theirs(lamp) ? traffic.beam(lamp.beam - Traffic::kBeam) : lamps.image(lamp.beam);
    const LampReach reach(lamp.position_m, lamp.world_from_image, light_cone(image));
    if (!reach.meets(view)) continue;
    ++lit;
    if (!casts) continue;
    LightPeaks peaks;
    peaks.set(image);
    if (peaks.is_wide()) ++wide;
    casts->push_back(
        std::make_shared<const CastBy>(casters->by(reach, lamp.world_from_image, input.moving, lamp.carried_by,
                                                   {.view = &view, .faint_lx = faint_lx(input), .peaks = &peaks})));
  }
  std::optional<std::size_t> casting;
  if (casts) casting = casters_of_all(*casts);
  DrawnOver over = drawn_over(input);
  over.gui = window && desk.panel;  // nothing is laid out: there is no window yet
  EffectFacts facts = facts_of(input, {lit, lit, wide}, casting, over, glare_of(input, view),
                               pupils_of(input, view, channel.width_px, channel.height_px).size(),
                               spraying_seen(view, input.spraying).size(), {});
  add_facts(facts, fixed, input.camera.eye_m);
  return moment_text(lamps, moment, device) + explain(plan_effects(facts, input.effects)) +
         "# --explain --cost draws this moment and adds passes, bytes and ms\n";
}

std::string explain_costs(const FrameStats& drawn, const FrameResult& anew, PictureSize size) {
  const FrameResult& frame = drawn.newest;
  std::size_t level_width = 8;
  for (const EffectRow& row : effect_table())
    level_width = std::max(level_width, row.levels[frame.effects.level(row.effect)].size() + 1);
  const auto line = [&](std::string_view name, std::string_view level, std::string_view passes, std::string_view bytes,
                        std::string_view ms, std::string_view reason) {
    return fmt::format("{:<16}{:<{}}{:>6}{:>11}{:>9}  {}\n", name, level, level_width, passes, bytes, ms, reason);
  };
  const auto in_ms = [](const LogHistogram& times) { return fmt::format("{:.2f}", times.percentile(0.5)); };

  std::string text = fmt::format(
      "# {} × {}, medians of {} frames: {} ms a frame, {} ms of them on the device; {} draws of {} triangles\n",
      size.width_px, size.height_px, drawn.frames, in_ms(drawn.wall_ms), in_ms(drawn.gpu_ms), frame.draws,
      frame.triangles);
  text += line("# effect", "level", "passes", "bytes", "ms", "because");
  std::string kept;
  for (const EffectRow& row : effect_table()) {
    const auto i = static_cast<std::size_t>(row.effect);
    const EffectDecision& decision = frame.effects[row.effect];
    const EffectCost& cost = frame.effect_costs[i];
    const auto times = drawn.effect_ms.find(row.effect);
    text += line(row.name, row.levels[decision.level], fmt::to_string(cost.passes), fmt::to_string(cost.bytes),
                 times == drawn.effect_ms.end() ? "-" : in_ms(times->second), decision.reason);
    if (const std::uint32_t passes = anew.effect_costs[i].passes; passes > cost.passes)
      kept += fmt::format("# {}: kept from the frame before; {} {}, {:.2f} ms where the eye turns against the lamps\n",
                          row.name, passes, passes == 1 ? "pass" : "passes",
                          effect_time_ms(anew, row.effect).value_or(0.0));
  }
  text += line("# any frame", "", fmt::to_string(frame.other_cost.passes), fmt::to_string(frame.other_cost.bytes),
               in_ms(drawn.other_ms), "the picture itself, with what effects draw in its passes");
  return text + kept;
}

}  // namespace phare
