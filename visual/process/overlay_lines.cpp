#include "visual/process/overlay_lines.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <glm/vec3.hpp>
#include <utility>

#include "config/base/conventions.h"
#include "config/key_bindings.h"
#include "visual/air_of_desk.h"
#include "visual/effects_of_frame.h"
#include "visual/process/effect_doors.h"

namespace phare {
namespace {

/// `at_m`: as it is told, in the frame of the point.
std::string lux_line(const char* what, const Lamps& lamps, const OverlayMoment& moment, const MeasurePoint& point,
                     const glm::dvec3& at_m) {
  const Lamps::LightAt light = moment.world != nullptr ? lamps.light_at(moment.pose, point, *moment.world)
                                                       : Lamps::LightAt{.lx = lamps.illuminance_lx(moment.pose, point)};
  std::string line = fmt::format("{}{:.3g} lx at ({:.2f}, {:.2f}, {:.2f}) m", what, light.lx, at_m.x, at_m.y, at_m.z);
  if (!light.hidden_by.empty()) line += fmt::format(", {:.3g} lx hidden by {}", light.hidden_lx, light.hidden_by);
  return line;
}

}  // namespace

SeenBy seen_by(const CameraEye& eye, const ChannelConfig& channel, const Lamps& lamps, const VehicleState& pose,
               const RoadLine* road) {
  SeenBy by{channel, lamps, pose};
  if (road != nullptr && eye.kind == CameraKind::kOncoming) {
    const glm::dvec3 there_m = oncoming_place_m(pose);
    by.ground_z_m = road->ground(there_m.x, there_m.y, there_m.z).position_m.z;
  }
  return by;
}

void set_by_desk(FrameInput& input, const Desk& desk) {
  input.view = desk.view;
  input.method = desk.method;
  input.isolux_lx = desk.isolux_lx;
  input.exposure_per_cdm2 = desk.exposure_per_cdm2;
  input.effects = choices_of(desk);
  input.air = air_of(desk);
  input.snow_cover_01 = desk.snow_cover_01;
  input.viewer = {desk.age_years, desk.iris_pigment};
}

CockpitState shown_by_desk(const Desk& desk, CockpitState controls) {
  if (desk.design) controls.design_index = static_cast<std::uint32_t>(*desk.design);
  return controls;
}

std::vector<std::string> overlay_lines(const Desk& desk, const Lamps& lamps, const OverlayMoment& moment) {
  std::vector<std::string> lines;
  char text[160];
  if (desk.lines) {
    std::snprintf(text, sizeof text, "%.1f s   frame %.1f ms   %s keys   %s panel", moment.time.seconds(),
                  moment.frame_ms, std::string(binding_of(KeyAction::kHelp)->name).c_str(),
                  std::string(binding_of(KeyAction::kPanel)->name).c_str());
    lines.emplace_back(text);
    // The luminance that falls on the middle of the tone curve, as a light meter set to ISO 100 has it (ISO 2720,
    // K 12.5).
    std::snprintf(text, sizeof text, "eye adapted to %.0f K%s   exposure EV %.1f", moment.eye.adapted_k(),
                  moment.eye.fixed() ? ", fixed" : "", std::log2(8.0 / desk.exposure_per_cdm2));
    lines.emplace_back(text);
    if (!moment.picked.empty()) lines.push_back(moment.picked);
    if (const Air air = air_of(desk); !air.clear()) lines.push_back(words_of(air) + "; lux as in clear air");
    if (moment.under_mouse)
      lines.push_back(lux_line("", lamps, moment, *moment.under_mouse, moment.under_mouse->position_m));
  }
  lines.insert(lines.end(), moment.moving.begin(), moment.moving.end());
  lines.insert(lines.end(), moment.point.begin(), moment.point.end());
  for (std::size_t i = 0; i < desk.probes.size(); ++i) {
    const Probe& probe = desk.probes[i];
    std::snprintf(text, sizeof text, "probe %zu, %s: ", i + 1,
                  kProbeFrameNames[static_cast<std::size_t>(probe.frame)].data());
    static const RoadLine kNoRoad;
    const auto at = placed(probe, moment.pose, moment.road_line != nullptr ? *moment.road_line : kNoRoad);
    lines.push_back(at ? lux_line(text, lamps, moment, *at, probe.position_m)
                       : std::string(text) + "the scene has no lane");
  }
  if (desk.effects && moment.frame != nullptr)
    for (std::string& line : effect_sentences(*moment.frame)) lines.push_back(std::move(line));
  if (desk.method == Method::kReference)
    lines.emplace_back("light by the method reference: float64 at every pixel");
  else if (desk.method != Method::kFragment)
    lines.push_back("light by the method " + std::string(kMethodNames[static_cast<std::size_t>(desk.method)]) +
                    ": the picture is not exact, lux in figures is");
  for (std::string& end : lamps.lit_table_ends()) lines.push_back(std::move(end));
  if (desk.effects && !moment.audit.empty()) lines.push_back(moment.audit);
  if (moment.coming) lines.push_back("the picture that was asked for is being made ...");
  if (moment.audit_over) lines.push_back("SELF-AUDIT: a pixel is off by more than its level states");
  if (moment.road != RoadPlace::kThere) lines.push_back(road_end_line(moment.road));
  if (moment.paused) lines.emplace_back("PAUSED: phare control resume goes on");
  if (moment.pose_held) lines.emplace_back("POSE HELD: no VehicleState");
  if (moment.controls.fail_safe) lines.emplace_back("FAIL-SAFE low beam: the light switch is silent");
  if (!moment.controls.source_fault.empty()) lines.push_back(moment.controls.source_fault);
  return lines;
}

}  // namespace phare
