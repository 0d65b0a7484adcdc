#include "visual/process/obey.h"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <variant>

#include "net/control_desk.h"

namespace phare {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

template <typename... Values>
std::string print(const char* format, Values... values) {
  char text[240];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string design_text(const Lamps& lamps) {
  return print("design %zu of %zu, \"%.100s\"", lamps.design_index(), lamps.designs().size(),
               lamps.design().name.c_str());
}

/// "sources 3, 17-19 at 0 %; 5 at 40 %": those that are not at full light.
std::string dimmed_text(std::span<const double> dimming_01) {
  std::string text;
  for (std::size_t first = 0, end = 0; first < dimming_01.size(); first = end) {
    for (end = first; end < dimming_01.size() && dimming_01[end] == dimming_01[first];) ++end;
    if (dimming_01[first] == 1.0) continue;
    text += text.empty() ? "source " : "; ";
    text += std::to_string(first + 1) + (end - first > 1 ? "-" + std::to_string(end) : "");
    text += print(" at %.4g %%", dimming_01[first] * 100.0);
  }
  return text;
}

struct Obedience {
  Lamps& lamps;
  const Rig& rig;

  ControlReply operator()(const RigControl::Dim& dim) const {
    if (const Status done = lamps.dim(dim); !done) return refused(done.error().text());
    const std::string which = dim.source == 0 ? "all sources" : "source " + std::to_string(dim.source);
    return accepted(dim.lamp + ": " + which + print(" at %.4g %%", dim.dimming_01 * 100.0));
  }
  ControlReply operator()(const RigControl::Swivel& swivel) const {
    if (const Status done = lamps.swivel(swivel); !done) return refused(done.error().text());
    return accepted(swivel.lamp + print(": turned %.3f deg left, %.3f deg up", swivel.yaw_rad * kDegPerRad,
                                        swivel.pitch_rad * kDegPerRad));
  }
  ControlReply operator()(const RigControl::Place& place) const {
    if (const Status done = lamps.place(place); !done) return refused(done.error().text());
    return accepted(place.lamp + print(": at x %.3f, y %.3f, z %.3f m", place.x_m, place.y_m, place.z_m));
  }
  ControlReply operator()(const RigControl::Aim& aim) const {
    lamps.set_aim(aim.pitch_rad);
    return accepted(print("all lamps turned %.3f deg up", aim.pitch_rad * kDegPerRad));
  }
  ControlReply operator()(const RigControl::Design& design) const {
    if (design.index >= lamps.designs().size()) return refused(no_such_design(rig, design.index));
    return design.index == lamps.design_index() ? accepted(design_text(lamps)) : pending("still " + design_text(lamps));
  }
  ControlReply operator()(const RigControl::Tell&) const { return accepted(text_of(lamps)); }
  ControlReply operator()(const RigControl::Quit&) const { return accepted("leaves"); }
  ControlReply operator()(const RigControl::Pause&) const { return not_mine(); }
  ControlReply operator()(const RigControl::Seek&) const { return not_mine(); }
};

}  // namespace

ControlReply obey(Lamps& lamps, const Rig& rig, const RigControl& control) {
  return std::visit(Obedience{lamps, rig}, control.command);
}

std::string text_of(const Lamps& lamps) {
  std::string text = design_text(lamps) + ", lit: " + lamps.lit_text() +
                     print(", all lamps turned %.3f deg up", lamps.aim_rad() * kDegPerRad);
  for (std::size_t slot = 0; slot < lamps.design().lamps.size(); ++slot) {
    const LampConfig& lamp = lamps.design().lamps[slot];
    const Lamps::Commanded now = lamps.commanded(slot);
    text += "\n  " + lamp.name +
            print(": at x %.3f, y %.3f, z %.3f m", lamp.position_m.x, lamp.position_m.y, lamp.position_m.z);
    if (now.yaw_rad != 0.0 || now.pitch_rad != 0.0)
      text += print(", turned %.3f deg left, %.3f deg up", now.yaw_rad * kDegPerRad, now.pitch_rad * kDegPerRad);
    const std::string dimmed = dimmed_text(now.dimming_01);
    const std::size_t sources = now.dimming_01.size();
    text += ", " + std::to_string(sources) + (sources == 1 ? " source" : " sources") + " at " +
            (dimmed.empty() ? "full light" : "full light but " + dimmed);
  }
  constexpr std::size_t kMost = 4000;  // of a reply
  return text.size() <= kMost ? text : text.substr(0, kMost) + "…";
}

}  // namespace phare
