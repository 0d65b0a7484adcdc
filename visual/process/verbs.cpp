#include "visual/process/verbs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <utility>

#include "config/rig_edit.h"
#include "net/control_desk.h"
#include "visual/process/lamp_keys.h"
#include "visual/process/versus.h"

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

/// "camera chase, view false-colour": what is not as it was at first.
std::string desk_text(const Desk& desk) {
  std::string text;
  for (const DeskCommand& command : difference(desk))
    text += (text.empty() ? "" : ", ") + command.setting + " " + command.value;
  return text;
}

ControlReply answer(const Status& done, std::string now) {
  return done ? accepted(std::move(now)) : refused(done.error().text());
}

/// Every lamp of one name, where it stands; the distance of two.
std::string mounts_text(const Lamps& lamps, const std::string& lamp) {
  if (lamp.empty()) return print("all lamps turned %.3f deg up", lamps.aim_rad() * kDegPerRad);
  const auto slots = lamps.slots_of(lamp);
  if (!slots) return {};
  std::string text;
  for (const std::size_t slot : *slots) text += (text.empty() ? "" : "\n") + mount_text(lamps, slot);
  const Lamps::Mounts mounts = lamps.mounts();
  if (slots->size() == 2)
    text +=
        print("\n%.3f m apart", mounts.lamps[slots->front()].position_m.y - mounts.lamps[slots->back()].position_m.y);
  return text;
}

std::string all_mounts_text(const Lamps& lamps) {
  std::string text;
  for (std::size_t slot = 0; slot < lamps.design().lamps.size(); ++slot) text += mount_text(lamps, slot) + "\n";
  return text + mounts_text(lamps, "");
}

/// `cameras`: as the rig file has them.
ControlReply save(Lamps& lamps, const Rig& rig, const Desk& desk, std::vector<NamedEye>& cameras,
                  const std::string& file) {
  const std::vector<SavedMount> changed = lamps.changed_mounts();
  const bool own = file.empty() || std::filesystem::path(file).lexically_normal() == rig.file;
  const bool looks = desk.cameras != cameras;
  if (changed.empty() && !looks && own) return accepted(rig.file.string() + ": says so already");
  if (const Status saved = save_mounts(rig.file, file, changed, looks ? &desk.cameras : nullptr); !saved)
    return refused(saved.error().text());
  if (own) lamps.mounts_are_saved(), cameras = desk.cameras;
  return accepted((own ? rig.file.string() : file) + print(": %zu lamps", changed.size()) +
                  (looks ? print(", %zu cameras", desk.cameras.size()) : ""));
}

/// Whether the desk goes to other designs side by side.
bool chooses_designs(const Desk& desk, const Desk& wanted) {
  const bool compares = wanted.compare != Compare::kOff;
  return wanted.versus != desk.versus || (compares && (desk.compare == Compare::kOff || wanted.design != desk.design));
}

/// What changes places and turns of lamps: the first picture's.
void add_mount_verbs(Verbs& verbs, Lamps& lamps, const Rig& rig, const Desk& desk) {
  verbs.on<RigControl::Mount>([&lamps](const RigControl::Mount& mount) {
    const Status done = lamps.mount(mount);
    return answer(done, done ? mounts_text(lamps, mount.lamp) : "");
  });
  verbs.on<RigControl::Undo>([&lamps](const RigControl::Undo& undo) {
    const std::size_t steps = lamps.undo(undo.steps);
    if (steps == 0) return refused("undo: nothing has been moved in design \"" + lamps.design().name + "\"");
    return accepted(print("%zu taken back\n", steps) + all_mounts_text(lamps));
  });
  verbs.on<RigControl::Reset>([&lamps](const RigControl::Reset& reset) {
    const Status done = lamps.reset(reset.lamp);
    return answer(done, done ? (reset.lamp.empty() ? all_mounts_text(lamps) : mounts_text(lamps, reset.lamp)) : "");
  });
  verbs.on<RigControl::Save>(
      [&lamps, &rig, &desk, cameras = std::make_shared<std::vector<NamedEye>>(rig.desk.cameras)](
          const RigControl::Save& command) { return save(lamps, rig, desk, *cameras, command.file); });
}

}  // namespace

Verbs visual_verbs(Lamps& lamps, const Rig& rig, Desk& desk, std::uint32_t channel, const std::string& no_reference,
                   std::function<std::optional<FreeEye>()> seen_from) {
  Verbs verbs;
  verbs.on<RigControl::Dim>([&lamps](const RigControl::Dim& dim) {
    const std::string which = dim.source == 0 ? "all sources" : "source " + std::to_string(dim.source);
    return answer(lamps.dim(dim), dim.lamp + ": " + which + print(" at %.4g %%", dim.dimming_01 * 100.0));
  });
  verbs.on<RigControl::Frame>([&lamps](const RigControl::Frame& frame) {
    return answer(lamps.frame(frame), frame.lamp + ": shines the picture " + frame.file);
  });
  verbs.on<RigControl::Swivel>([&lamps](const RigControl::Swivel& swivel) {
    return answer(lamps.swivel(swivel),
                  swivel.lamp + print(": turned %.3f deg left, %.3f deg up", swivel.yaw_rad * kDegPerRad,
                                      swivel.pitch_rad * kDegPerRad));
  });
  verbs.on<RigControl::Place>([&lamps](const RigControl::Place& place) {
    return answer(lamps.place(place),
                  place.lamp + print(": at x %.3f, y %.3f, z %.3f m", place.x_m, place.y_m, place.z_m));
  });
  if (channel == 0) {
    add_mount_verbs(verbs, lamps, rig, desk);
  } else {
    verbs.on<RigControl::Mount>([](const auto&) { return not_mine(); });
    verbs.on<RigControl::Undo>([](const auto&) { return not_mine(); });
    verbs.on<RigControl::Reset>([](const auto&) { return not_mine(); });
    verbs.on<RigControl::Save>([](const auto&) { return not_mine(); });
  }
  verbs.on<RigControl::Aim>([&lamps](const RigControl::Aim& aim) {
    lamps.set_aim(aim.pitch_rad);
    return accepted(print("all lamps turned %.3f deg up", aim.pitch_rad * kDegPerRad));
  });
  verbs.on<RigControl::Design>([&lamps, &rig, &desk](const RigControl::Design& design) {
    if (design.index >= lamps.designs().size()) return refused(no_such_design(rig, design.index));
    if (design.index == lamps.design_index()) return accepted(design_text(lamps));
    if (desk.design) return accepted("the picture shows " + design_text(lamps) + ", as set on the desk");
    return pending("still " + design_text(lamps));
  });
  verbs.on<RigControl::Set>(
      [&lamps, &desk, no_reference, seen_from = std::move(seen_from)](const RigControl::Set& set) {
        Desk wanted = desk;
        auto done = apply(wanted, {set.setting, set.value},
                          {.designs = lamps.designs().size(),
                           .seen_from = seen_from ? seen_from() : std::nullopt,
                           .no_reference = no_reference});
        if (!done) return refused(done.error().text());
        if (chooses_designs(desk, wanted))
          if (const Status two = check_versus(wanted, lamps.design_index()); !two) return refused(two.error().text());
        desk = std::move(wanted);
        return accepted(std::move(*done));
      });
  verbs.on<RigControl::Tell>([&lamps, &desk](const auto&) { return accepted(text_of(lamps, desk)); });
  return verbs;
}

std::string text_of(const Lamps& lamps, const Desk& desk) {
  std::string text = design_text(lamps) + ", lit: " + lamps.lit_text() +
                     print(", all lamps turned %.3f deg up", lamps.aim_rad() * kDegPerRad);
  for (std::size_t slot = 0; slot < lamps.design().lamps.size(); ++slot) {
    text += "\n  " + mount_text(lamps, slot);
    const std::string dimmed = dimmed_text(lamps.dimming_01(slot));
    const std::size_t sources = lamps.dimming_01(slot).size();
    text += ", " + std::to_string(sources) + (sources == 1 ? " source" : " sources") + " at " +
            (dimmed.empty() ? "full light" : "full light but " + dimmed);
  }
  if (const std::string set = desk_text(desk); !set.empty()) text += "\n  desk: " + set;
  constexpr std::size_t kMost = 4000;  // of a reply
  return text.size() <= kMost ? text : text.substr(0, kMost) + "…";
}

}  // namespace phare
