// What stands in the panel, section by section. Every control says in its tooltip which key or command does the same.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "visual/effects.h"
#include "visual/effects_of_frame.h"
#include "visual/process/effect_doors.h"
#include "visual/process/lamp_keys.h"
#include "visual/process/panel.h"

namespace phare {
namespace {

using rig_command::MountQuantity;

constexpr double kPanelRadPerDeg = std::numbers::pi / 180.0;
constexpr float kNameWidth = 6.6f;  // of the column of names, in letters' heights

/// The panel as it is being laid out: what was asked, and where controls lie.
class Sheet {
 public:
  Sheet(const PanelFacts& facts, PanelState& state) : facts_(facts), state_(state) {}

  void answer();
  void beam();
  void lamps();
  void view();
  void effects();
  void times();
  void messages();
  std::vector<PanelCommand> take() { return std::move(commands_); }

 private:
  // ---- controls, each under a name of its own
  void mark(const std::string& name) {
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    state_.places[name] = {from.x, from.y, to.x, to.y};
    marked_ = name;
  }
  /// Of the control marked last.
  void tip(const std::string& text) {
    state_.tips[marked_] = text;
    if (!ImGui::IsItemHovered()) return;
    // Right of the panel, so that it hides no control.
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth() + 0.5f * ImGui::GetFontSize();
    ImGui::SetNextWindowPos({right, ImGui::GetItemRectMin().y});
    ImGui::SetTooltip("%s", text.c_str());
  }
  static std::string control_words(const std::string& setting, const std::string& value) {
    return "phare control set " + setting + " " + value;
  }
  void set(const std::string& setting, const std::string& value) {
    commands_.push_back(RigControl{RigControl::Set{setting, value}});
  }
  bool section(const char* title, bool open) {
    const bool shown = ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
    mark(title);
    return shown;
  }
  static void name(const char* text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::SameLine(kNameWidth * ImGui::GetFontSize());
  }
  /// `known_as`: of labels that stand there more than once.
  bool button(const std::string& label, const std::string& tooltip, bool enabled = true,
              const std::string& known_as = {}) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label.c_str());
    ImGui::EndDisabled();
    mark(known_as.empty() ? label : known_as);
    tip(tooltip);
    return pressed;
  }
  void key_button(const char* label, KeyAction action) {
    const KeyBinding& key = *binding_of(action);
    if (button(label, fmt::format("{}: {}", key.name, key.what))) commands_.push_back(action);
  }
  void choose(const std::string& setting, const char* label, std::span<const std::string_view> values,
              const std::string& now, const std::string& tooltip);
  void flag(const std::string& setting, const char* label, bool on, const std::string& tooltip);
  void slider(const PanelLamp& lamp, MountQuantity quantity, const char* label);
  bool slide(const std::string& control, double& value, double least, double most, const char* format,
             const std::string& tooltip);
  void mount(const RigControl::Mount& command);
  void light(const PanelLamp& lamp);
  void save();
  void exposure();
  void own_camera(const Desk& desk);

  const PanelFacts& facts_;
  PanelState& state_;
  std::vector<PanelCommand> commands_;
  std::string marked_;
};

std::string key_of_setting(KeyAction action) {
  return fmt::format("{}: {}", binding_of(action)->name, binding_of(action)->what);
}

void Sheet::choose(const std::string& setting, const char* label, std::span<const std::string_view> values,
                   const std::string& now, const std::string& tooltip) {
  name(label);
  ImGui::SetNextItemWidth(-1.0f);
  const bool open = ImGui::BeginCombo(("##" + setting).c_str(), now.c_str(), ImGuiComboFlags_HeightLarge);
  mark(setting);
  if (!open) return tip(tooltip + "\n" + control_words(setting, now));
  for (const std::string_view value : values) {
    const std::string word(value);
    if (ImGui::Selectable(word.c_str(), word == now)) set(setting, word);
    mark(setting + " " + word);
  }
  ImGui::EndCombo();
}

void Sheet::flag(const std::string& setting, const char* label, bool on, const std::string& tooltip) {
  if (ImGui::Checkbox(label, &on)) set(setting, on ? "on" : "off");
  mark(setting);
  tip(tooltip + "\n" + control_words(setting, on ? "off" : "on"));
}

/// One line that is always there, so that no control moves when a command is answered.
void Sheet::answer() {
  const ImVec4 red{1.0f, 0.45f, 0.38f, 1.0f};
  const std::string key(binding_of(KeyAction::kPanel)->name);
  const std::string line = facts_.answer.empty() ? "Rest on a control: its key or command. " + key + " hides all."
                                                 : facts_.answer.substr(0, facts_.answer.find('\n'));
  ImGui::TextColored(facts_.answer_refused ? red : ImGui::GetStyle().Colors[ImGuiCol_TextDisabled], "%s", line.c_str());
  mark("answer");
  if (!facts_.answer.empty()) tip(facts_.answer);
}

void Sheet::beam() {
  ImGui::Text("%.0f km/h   lit: %s", facts_.speed_kmh, facts_.lit.empty() ? "none" : facts_.lit.c_str());
  if (!section("Beam and design", true)) return;
  key_button("high beam", KeyAction::kHighBeam);
  ImGui::SameLine();
  key_button("light up", KeyAction::kLightUp);
  ImGui::SameLine();
  key_button("light down", KeyAction::kLightDown);
  ImGui::SameLine();
  key_button("fog lamps", KeyAction::kFogFront);
  // The cockpit chooses the design; where a drive is shown, or the desk has the word, it is the desk's to say.
  const bool by_keys = facts_.driven && !facts_.desk.design;
  for (std::size_t i = 0; i < facts_.designs.size(); ++i) {
    const std::string number = std::to_string(i);
    const bool picked =
        ImGui::RadioButton(fmt::format("{}  {}##design", i, facts_.designs[i]).c_str(), i == facts_.design);
    mark("design " + number);
    tip(by_keys ? key_of_setting(KeyAction::kDesignNext) : control_words("design", number));
    if (!picked || i == facts_.design) continue;
    if (!by_keys) set("design", number);
    const std::size_t on = (i + facts_.designs.size() - facts_.design) % facts_.designs.size();
    for (std::size_t press = 0; by_keys && press < on; ++press) commands_.push_back(KeyAction::kDesignNext);
  }
  if (facts_.desk.design) {
    if (button("as the cockpit has it", control_words("design", "cockpit"))) set("design", "cockpit");
  }
}

/// A slider from here to there; true: it has been moved by more than its last digit shows.
bool Sheet::slide(const std::string& control, double& value, double least, double most, const char* format,
                  const std::string& tooltip) {
  auto shown = static_cast<float>(value);
  const auto before = shown;
  const bool moved = ImGui::SliderFloat(("##" + control).c_str(), &shown, static_cast<float>(least),
                                        static_cast<float>(most), format, ImGuiSliderFlags_NoInput);
  mark(control);
  if (!ImGui::IsItemActive()) tip(tooltip);
  constexpr float kSame = 1e-4f;  // half of what three digits show, and more than two roundings to float make of it
  if (!moved || std::abs(shown - before) < kSame) return false;
  value = static_cast<double>(shown);
  return true;
}

/// A slider sends a command each frame while it is held. To take back they are one: before the next, the last is.
void Sheet::mount(const RigControl::Mount& command) {
  PanelState::Drag& drag = state_.drag;
  const bool on_top = drag.sent && drag.design == facts_.design && drag.steps + 1 == facts_.undo_steps;
  if (on_top) commands_.push_back(RigControl{RigControl::Undo{1}});
  drag = {true, facts_.design, on_top ? drag.steps : facts_.undo_steps};
  commands_.push_back(RigControl{command});
}

/// The same by key and by command.
std::string mount_words(const PanelLamp& lamp, MountQuantity quantity) {
  const auto i = static_cast<std::size_t>(quantity);
  return fmt::format("in the rig file {:.3f}\n{} {} {} {}: by keys\nphare control move \"{}\" {} {:.3f}",
                     lamp.of_rig[i], binding_of(KeyAction::kLampChoose)->name,
                     binding_of(KeyAction::kLampQuantity)->name, binding_of(KeyAction::kLampMore)->name,
                     binding_of(KeyAction::kLampLess)->name, lamp.name, kMountQuantityNames[i], lamp.now[i]);
}

void Sheet::slider(const PanelLamp& lamp, MountQuantity quantity, const char* label) {
  const auto i = static_cast<std::size_t>(quantity);
  const bool angle = quantity > MountQuantity::kSpacing;
  const double unit = angle ? kPanelRadPerDeg : 1.0;
  const double step = angle ? kLampStep_deg : kLampStep_m;
  // About the rig's value: as far as lamps are moved on a car, and as levelling and bending light turn them. By eye.
  const double reach = angle ? 3.0 : 0.3;
  double value = lamp.now[i];
  const std::string quantity_name(kMountQuantityNames[i]), control = "lamp " + quantity_name;
  name(label);
  if (button("-##" + quantity_name, fmt::format("{:g} {} less", step, angle ? "deg" : "m"), true, control + " less"))
    commands_.push_back(RigControl{RigControl::Mount{lamp.name, quantity, -step * unit, true}});
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-2.2f * ImGui::GetFontSize());
  const double least =
      quantity == MountQuantity::kSpacing ? std::max(lamp.of_rig[i] - reach, 0.0) : lamp.of_rig[i] - reach;
  if (slide(control, value, least, lamp.of_rig[i] + reach, angle ? "%.2f deg" : "%.3f m", mount_words(lamp, quantity)))
    mount({lamp.name, quantity, value * unit, false});
  if (ImGui::IsItemDeactivated()) state_.drag = {};
  ImGui::SameLine();
  if (button("+##" + quantity_name, fmt::format("{:g} {} more", step, angle ? "deg" : "m"), true, control + " more"))
    commands_.push_back(RigControl{RigControl::Mount{lamp.name, quantity, step * unit, true}});
}

/// All sources of a lamp, or of both, alike; undo is of places only.
void Sheet::light(const PanelLamp& lamp) {
  double percent = 100.0 * lamp.light_01;
  name("light");
  ImGui::SetNextItemWidth(-1.0f);
  if (!slide("light", percent, 0.0, 100.0, "%.0f %%",
             fmt::format("every source of it\nphare control dim \"{}\" 0 {:.2f}", lamp.members.front(), lamp.light_01)))
    return;
  for (const std::string& member : lamp.members)
    commands_.push_back(RigControl{RigControl::Dim{member, 0, std::clamp(percent / 100.0, 0.0, 1.0)}});
}

void Sheet::lamps() {
  if (!section("Lamps", true)) return;
  if (!facts_.moves_lamps) return ImGui::TextDisabled("The first window of the rig moves lamps.");
  if (facts_.lamps.empty()) return;
  state_.lamp = std::min(state_.lamp, facts_.lamps.size() - 1);
  name("which");
  ImGui::SetNextItemWidth(-1.0f);
  const auto label = [](const PanelLamp& lamp) { return lamp.name + (lamp.pair ? " (pair)" : ""); };
  const bool open = ImGui::BeginCombo("##lamp", label(facts_.lamps[state_.lamp]).c_str());
  mark("lamp");
  if (!open) tip(key_of_setting(KeyAction::kLampChoose));
  for (std::size_t i = 0; open && i < facts_.lamps.size(); ++i) {
    if (ImGui::Selectable(label(facts_.lamps[i]).c_str(), i == state_.lamp)) state_.lamp = i;
    mark("lamp " + facts_.lamps[i].name);
  }
  if (open) ImGui::EndCombo();
  const PanelLamp& lamp = facts_.lamps[state_.lamp];
  slider(lamp, MountQuantity::kForward, "forward");
  slider(lamp, MountQuantity::kLeft, "left");
  slider(lamp, MountQuantity::kUp, "height");
  if (lamp.pair) slider(lamp, MountQuantity::kSpacing, "spacing");
  slider(lamp, MountQuantity::kYaw, "yaw, left");
  slider(lamp, MountQuantity::kPitch, "pitch, up");
  slider(lamp, MountQuantity::kRoll, "roll");
  light(lamp);
  double aim_deg = facts_.aim_deg;
  name("all, up");
  ImGui::SetNextItemWidth(-1.0f);
  if (slide("all pitch", aim_deg, -3.0, 3.0, "%.2f deg",
            key_of_setting(KeyAction::kLampsUp) + "\n" + key_of_setting(KeyAction::kLampsDown)))
    mount({"", MountQuantity::kPitch, aim_deg * kPanelRadPerDeg, false});
  if (ImGui::IsItemDeactivated()) state_.drag = {};
  if (button("undo", key_of_setting(KeyAction::kLampUndo), facts_.undo_steps > 0))
    commands_.push_back(RigControl{RigControl::Undo{1}});
  ImGui::SameLine();
  if (button("as in the rig", "these lamps as the rig file has them\nphare control reset \"" + lamp.name + "\""))
    commands_.push_back(RigControl{RigControl::Reset{lamp.name}});
  ImGui::SameLine();
  if (button("all as in the rig",
             "places and turns of all lamps as the rig file has them; their light stays\nphare control reset"))
    commands_.push_back(RigControl{RigControl::Reset{}});
  ImGui::SameLine();
  save();
}

/// Asks first: a slip of the mouse writes no file.
void Sheet::save() {
  if (button("save", "writes the places into the rig file\nphare control save")) ImGui::OpenPopup("write");
  if (!ImGui::BeginPopup("write")) return;
  if (button("write " + facts_.rig_file, "the lines of the lamps that were moved")) {
    commands_.push_back(RigControl{RigControl::Save{}});
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

/// In EV as a light meter has it (overlay_lines.cpp).
void Sheet::exposure() {
  double ev = std::log2(8.0 / facts_.desk.exposure_per_cdm2);
  name("exposure");
  ImGui::SetNextItemWidth(-1.0f);
  if (slide("exposure", ev, -4.0, 16.0, "EV %.1f",
            "brighter to the left\n" +
                control_words("exposure_per_cdm2", fmt::format("{:.4g}", facts_.desk.exposure_per_cdm2))))
    set("exposure_per_cdm2", fmt::format("{:.6g}", 8.0 / std::exp2(ev)));
}

/// The free eye, moved by the mouse, becomes a camera of the user's own, or that which is seen from is moved to it.
void Sheet::own_camera(const Desk& desk) {
  std::string name = desk.own_camera;
  for (std::size_t n = 1; name.empty(); ++n) {
    const std::string next = "camera" + std::to_string(n);
    if (std::ranges::find(desk.cameras, next, &NamedEye::name) == desk.cameras.end()) name = next;
  }
  const bool room = !desk.own_camera.empty() || desk.cameras.size() < kMostCameras;
  if (button("keep as " + name,
             "a camera of one's own where the picture is seen from\n" + control_words("cameras", "add " + name), room,
             "cameras add")) {
    set("cameras", "add " + name);
    if (desk.own_camera.empty()) set("camera", name);
  }
  if (desk.own_camera.empty()) return;
  ImGui::SameLine();
  if (button("remove", control_words("cameras", "remove " + name), true, "cameras remove"))
    set("cameras", "remove " + name);
}

void Sheet::view() {
  if (!section("View", true)) return;
  const Desk& desk = facts_.desk;
  const auto at = [](std::span<const std::string_view> names, auto value) {
    return std::string(names[static_cast<std::size_t>(value)]);
  };
  std::vector<std::string_view> cameras(kCameraNames.begin(), kCameraNames.end());
  for (const NamedEye& own : desk.cameras) cameras.push_back(own.name);
  choose("camera", "camera", cameras, desk.own_camera.empty() ? at(kCameraNames, desk.camera) : desk.own_camera,
         key_of_setting(KeyAction::kCamera));
  own_camera(desk);
  choose("layout", "cameras", kLayoutNames, at(kLayoutNames, desk.layout), key_of_setting(KeyAction::kLayout));
  if (desk.layout != Layout::kFull) choose("second_camera", "the second", cameras, desk.second_camera, "beside it");
  choose("view", "shows", kViewNames, at(kViewNames, desk.view), key_of_setting(KeyAction::kFalseColour));
  if (facts_.designs.size() > 1)
    choose("compare", "compare A, B", kCompareNames, at(kCompareNames, desk.compare),
           key_of_setting(KeyAction::kCompare));
  constexpr std::array<std::string_view, 3> kGrids{"off", "10", "20"};
  choose("grid_m", "grid, m", kGrids, desk.grid_m > 0.0 ? fmt::format("{:g}", desk.grid_m) : "off",
         key_of_setting(KeyAction::kGrid));
  constexpr std::array<std::string_view, 6> kVisibilities{"clear", "1000", "300", "100", "50", "25"};
  choose("visibility_m", "visibility, m", kVisibilities,
         desk.visibility_m ? fmt::format("{:.4g}", *desk.visibility_m) : "clear", "fog, with the beams in it");
  constexpr std::array<std::string_view, 5> kRains{"0", "2", "10", "25", "50"};
  choose("rain_mmph", "rain, mm/h", kRains, fmt::format("{:.4g}", desk.rain_mmph), "its drops, and the wet road");
  constexpr std::array<std::string_view, 4> kSnows{"0", "0.5", "1", "3"};
  choose("snow_mmph", "snow, mm/h", kSnows, fmt::format("{:.4g}", desk.snow_mmph), "of water: its flakes");
  constexpr std::array<std::string_view, 4> kCovers{"0", "0.3", "0.6", "1"};
  choose("snow_cover", "snow lies", kCovers, fmt::format("{:.4g}", desk.snow_cover_01), "on this share of the ground");
  constexpr std::array<std::string_view, 5> kGrounds{"auto", kWetNames[0], kWetNames[1], kWetNames[2], kWetNames[3]};
  choose("ground", "ground", kGrounds, std::string(desk.ground ? kWetNames[*desk.ground] : kGrounds[0]),
         "water on it; auto: as it rains");
  if (desk.windscreen) choose("wiper", "wiper", kWiperNames, at(kWiperNames, desk.wiper), "of the windscreen");
  exposure();
  flag("windscreen", "windscreen", desk.windscreen, "rain on one before the driver's eye");
  ImGui::SameLine();
  flag("road_isolux", "isolux", desk.isolux, key_of_setting(KeyAction::kIsolux));
  ImGui::SameLine();
  flag("mirrors", "mirrors", desk.mirrors, key_of_setting(KeyAction::kMirrors));
  ImGui::SameLine();
  flag("reach", "reach", desk.reach, "how far 1, 3 and 5 lx reach along the lane's edges");  // no room for six in a row
  flag("plot", "plot", desk.plot, key_of_setting(KeyAction::kPlot));
  ImGui::SameLine();
  flag("lines", "text", desk.lines, "lines of text at the top");
}

/// The setting of the desk that chooses an effect's level. None: it is on where its setting is.
const DeskSetting* setting_of(Effect effect) {
  const EffectDoor& door = effect_doors()[static_cast<std::size_t>(effect)];
  return door.level == nullptr ? nullptr : &*std::ranges::find(desk_settings(), door.setting, &DeskSetting::name);
}

/// "auto, off, hard, soft" one by one.
std::vector<std::string_view> forced_levels(std::string_view values) {
  std::vector<std::string_view> words;
  while (!values.empty()) {
    const std::size_t comma = std::min(values.find(", "), values.size());
    words.push_back(values.substr(0, comma));
    values.remove_prefix(std::min(comma + 2, values.size()));
  }
  return words;
}

void Sheet::effects() {
  if (!section("Effects, and why", false)) return;
  choose("method", "light at", kMethodNames, std::string(kMethodNames[static_cast<std::size_t>(facts_.desk.method)]),
         key_of_setting(KeyAction::kMethod));
  for (const EffectRow& row : effect_table()) {
    const EffectDecision& decision = facts_.frame.effects[row.effect];
    const std::string name(row.name);
    const DeskSetting* setting = setting_of(row.effect);
    // Two controls of one name would be one for the mouse: what the section of the view shows stands there alone.
    if (setting != nullptr && !state_.places.contains(std::string(setting->name)))
      choose(std::string(setting->name), name.c_str(), forced_levels(setting->values), setting->get(facts_.desk),
             std::string(setting->what));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("%s %s: %s%s", name.c_str(), std::string(row.levels[decision.level]).c_str(),
                        decision.reason.c_str(), cost_text(facts_.frame, row.effect).c_str());
    ImGui::PopTextWrapPos();
    mark("effect " + name);
    tip("needs " + std::string(row.needs));
  }
}

void Sheet::times() {
  if (!section("Times", false)) return;
  const FrameResult& frame = facts_.frame;
  ImGui::Text("%.1f frames/s   frame %.1f ms   device %.1f ms", facts_.frames_per_s, frame.wall_ms, frame.gpu_ms);
  mark("times");
  ImGui::Text("%u passes, %u draws, %llu triangles", frame.pass_count, frame.draws,
              static_cast<unsigned long long>(frame.triangles));
  ImGui::Text("%u images, %.1f MB", frame.images, static_cast<double>(frame.image_bytes) / 1e6);
  for (const PassTime& pass : frame.passes) {
    ImGui::Text("%7.2f ms", pass.ms);
    ImGui::SameLine(kNameWidth * ImGui::GetFontSize());
    ImGui::TextUnformatted(pass.name.c_str());
  }
}

void Sheet::messages() {
  if (!section("Messages", false)) return;
  if (!ImGui::BeginTable("messages", 5, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  for (const char* heading : {"sent", "received", "lost", "late"}) ImGui::TableSetupColumn(heading);
  ImGui::TableHeadersRow();
  for (const PanelMessages& kind : facts_.messages) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(kind.name.c_str());
    for (const std::uint64_t count : {kind.sent, kind.received, kind.lost, kind.late}) {
      ImGui::TableNextColumn();
      ImGui::Text("%llu", static_cast<unsigned long long>(count));
    }
  }
  ImGui::EndTable();
  ImGui::Text("refused: %llu", static_cast<unsigned long long>(facts_.refused));
  mark("messages");
}

}  // namespace

std::vector<PanelCommand> panel_sections(const PanelFacts& facts, PanelState& state) {
  Sheet sheet(facts, state);
  sheet.answer();
  sheet.beam();
  sheet.lamps();
  sheet.view();
  sheet.effects();
  sheet.times();
  sheet.messages();
  return sheet.take();
}

}  // namespace phare
