#include "config/desk.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "config/desk_cameras.h"
#include "config/desk_words.h"
#include "config/formats/toml_table.h"

namespace phare {
namespace {

using namespace desk_words;

Status turn(bool& flag, std::string_view value) {
  if (value == "toggle") {
    flag = !flag;
    return Done{};
  }
  if (value != kOffOnNames[0] && value != kOffOnNames[1]) return none_of(value, kOffOnNames, "toggle");
  flag = value == kOffOnNames[1];
  return Done{};
}

template <bool Desk::*flag>
Status set_flag(Desk& desk, std::string_view value, const DeskContext&) {
  return turn(desk.*flag, value);
}
template <bool Desk::*flag>
std::string get_flag(const Desk& desk) {
  return std::string(kOffOnNames[desk.*flag ? 1 : 0]);
}

/// Chooses, but for `taken` while the other of two designs and two cameras has the halves of the picture.
template <std::size_t count, typename Enum>
Status choose_halves(const std::array<std::string_view, count>& names, Enum& chosen, std::string_view value, bool taken,
                     const char* by) {
  Enum wanted = chosen;
  if (const Status done = choose(names, wanted, value); !done) return done.error();
  if (taken && wanted == Enum::kSplit) {
    if (value != "next") return Error{"", std::string("the halves of the picture are taken by ") + by};
    (void)choose(names, wanted, value);
  }
  chosen = wanted;
  return Done{};
}

constexpr const char* kOneDesign = "the rig has one design";

Status set_compare(Desk& desk, std::string_view value, const DeskContext& context) {
  Compare chosen = desk.compare;
  if (const Status done = choose_halves(kCompareNames, chosen, value, desk.layout == Layout::kSplit, "layout split");
      !done)
    return done.error();
  if (chosen != Compare::kOff && context.designs < 2) return Error{"", kOneDesign};
  desk.compare = chosen;
  return Done{};
}
Status set_versus_aligned(Desk& desk, std::string_view value, const DeskContext& context) {
  bool aligned = desk.versus_aligned;
  if (const Status done = turn(aligned, value); !done) return done.error();
  if (aligned && context.designs < 2) return Error{"", kOneDesign};
  desk.versus_aligned = aligned;
  return Done{};
}
Status set_layout(Desk& desk, std::string_view value, const DeskContext&) {
  return choose_halves(kLayoutNames, desk.layout, value, desk.compare == Compare::kSplit, "compare split");
}
std::string get_layout(const Desk& desk) {
  return std::string(kLayoutNames[static_cast<std::size_t>(desk.layout)]);
}
std::string get_compare(const Desk& desk) {
  return std::string(kCompareNames[static_cast<std::size_t>(desk.compare)]);
}

Status set_view(Desk& desk, std::string_view value, const DeskContext&) {
  return choose(kViewNames, desk.view, value);
}
std::string get_view(const Desk& desk) {
  return std::string(kViewNames[static_cast<std::size_t>(desk.view)]);
}

Status set_method(Desk& desk, std::string_view value, const DeskContext& context) {
  Method chosen = desk.method;
  if (const Status done = choose(kMethodNames, chosen, value); !done) return done.error();
  if (chosen == Method::kReference && !context.no_reference.empty()) {
    if (value != "next") return Error{"", "reference: " + context.no_reference};
    (void)choose(kMethodNames, chosen, value);
  }
  desk.method = chosen;
  return Done{};
}
std::string get_method(const Desk& desk) {
  return std::string(kMethodNames[static_cast<std::size_t>(desk.method)]);
}

Status set_isolux(Desk& desk, std::string_view value, const DeskContext&) {
  std::vector<double> levels_lx;
  for (const std::string& word : words_of(value)) {
    if (word == "default") {
      levels_lx.insert(levels_lx.end(), kIsoluxLevels_lx.begin(), kIsoluxLevels_lx.end());
      continue;
    }
    const auto level_lx = number_of(word, 1e-3, 1e6);
    if (!level_lx) return level_lx.error();
    levels_lx.push_back(*level_lx);
  }
  if (levels_lx.empty()) return Error{"", "expected at least one level"};
  if (levels_lx.size() > kMostIsoluxLevels)
    return Error{"",
                 "at most " + std::to_string(kMostIsoluxLevels) + " levels, not " + std::to_string(levels_lx.size())};
  if (std::ranges::adjacent_find(levels_lx, std::greater_equal<>()) != levels_lx.end())
    return Error{"", "the levels have to rise"};
  desk.isolux_lx = std::move(levels_lx);
  return Done{};
}
std::string get_isolux(const Desk& desk) {
  std::string text;
  for (const double level_lx : desk.isolux_lx) text += (text.empty() ? "" : " ") + word_of(level_lx);
  return text;
}

template <double Desk::*number, int least, int most_tenths>
Status set_number(Desk& desk, std::string_view value, const DeskContext&) {
  const auto read = number_of(value, least, most_tenths / 10.0);
  if (!read) return read.error();
  desk.*number = *read;
  return Done{};
}
template <double Desk::*number>
std::string get_number(const Desk& desk) {
  return word_of(desk.*number);
}

Status set_exposure(Desk& desk, std::string_view value, const DeskContext&) {
  const auto exposure = number_of(value, 1e-6, 1e6);
  if (!exposure) return exposure.error();
  desk.exposure_per_cdm2 = *exposure;
  return Done{};
}
std::string get_exposure(const Desk& desk) {
  return word_of(desk.exposure_per_cdm2);
}

Status set_adaptation(Desk& desk, std::string_view value, const DeskContext&) {
  const auto setting = parse_adaptation(std::string(value));
  if (!setting) return Error{"", setting.error().reason};
  desk.eye = *setting;
  return Done{};
}
std::string get_adaptation(const Desk& desk) {
  return desk.eye.fixed_k ? word_of(*desk.eye.fixed_k) : "auto";
}

/// A design's number, or the word for none.
template <std::optional<std::size_t> Desk::*design, const std::string_view& none>
Status set_number_of_design(Desk& desk, std::string_view value, const DeskContext& context) {
  if (value == none) {
    (desk.*design).reset();
    return Done{};
  }
  std::size_t index = 0;
  const auto [stop, failed] = std::from_chars(value.data(), value.data() + value.size(), index);
  if (failed != std::errc() || stop != value.data() + value.size())
    return Error{"", "expected " + std::string(none) + " or a design's number, got \"" + std::string(value) + "\""};
  if (index >= context.designs)
    return Error{"", std::string(value) + ": the rig has " + std::to_string(context.designs) + ", counted from 0"};
  desk.*design = index;
  return Done{};
}
template <std::optional<std::size_t> Desk::*design, const std::string_view& none>
std::string get_number_of_design(const Desk& desk) {
  return desk.*design ? std::to_string(*(desk.*design)) : std::string(none);
}
constexpr std::string_view kCockpitName = "cockpit", kNextName = "next";

/// "car X Y Z" with the normal up, or "car X Y Z NX NY NZ"; "road S LEFT [UP]"; of `frames`.
Result<Probe> probe_of(std::span<const std::string> words, std::span<const std::string_view> frames) {
  Probe probe;
  const auto frame = std::ranges::find(frames, words.empty() ? "" : words.front());
  if (frame == frames.end()) return none_of(words.empty() ? "" : words.front(), frames);
  probe.frame = static_cast<Probe::Frame>(frame - frames.begin());
  if (probe.frame == Probe::Frame::kPicture) {
    if (words.size() != 3) return Error{"", "a point of the picture is its shares of width and height, 0 to 1"};
    for (int axis = 0; axis < 2; ++axis) {
      const auto share_01 = number_of(words[static_cast<std::size_t>(axis) + 1], 0.0, 1.0);
      if (!share_01) return share_01.error();
      probe.position_m[axis] = *share_01;
    }
    return probe;
  }
  const bool on_road = probe.frame == Probe::Frame::kRoad && words.size() == 3;
  if (!on_road && words.size() != 4 && words.size() != 7)
    return Error{"",
                 "a probe is car or world, x, y, z in m, and a normal of three numbers unless it is up; or road, s, "
                 "to the left, and above it unless on it"};
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto value = number_of(words[i], -1e7, 1e7);
    if (!value) return value.error();
    (i < 4 ? probe.position_m : probe.normal)[static_cast<int>((i - 1) % 3)] = *value;
  }
  const double length = glm::length(probe.normal);
  if (!(length > 1e-6)) return Error{"", "a normal of no length"};
  // What is a unit already stays as it is, so that a value read back is the same.
  if (std::abs(length - 1.0) > 1e-12) probe.normal /= length;
  return probe;
}

/// "none", or one probe after the other, a semicolon between them; "add …" keeps those there are.
Status set_probes(Desk& desk, std::string_view value, const DeskContext&) {
  const bool add = value.starts_with("add ");
  std::vector<Probe> probes = add ? desk.probes : std::vector<Probe>{};
  if (add) value.remove_prefix(4);
  for (bool more = value != "none"; more;) {
    const std::size_t end = std::min(value.find(';'), value.size());
    more = end < value.size();
    const std::vector<std::string> words = words_of(value.substr(0, end));
    value.remove_prefix(std::min(end + 1, value.size()));
    const auto probe = probe_of(words, std::span(kProbeFrameNames).first(3));
    if (!probe) return probe.error();
    probes.push_back(*probe);
  }
  if (probes.size() > kMostProbes) return Error{"", "at most " + std::to_string(kMostProbes) + " probes"};
  desk.probes = std::move(probes);
  return Done{};
}
std::string probe_words(const Probe& probe) {
  std::string text(kProbeFrameNames[static_cast<std::size_t>(probe.frame)]);
  const bool turned = probe.normal != Probe{}.normal;
  const bool two = probe.frame == Probe::Frame::kPicture ||
                   (probe.frame == Probe::Frame::kRoad && probe.position_m.z == 0.0 && !turned);
  for (int i = 0; i < (two ? 2 : 3); ++i) text += " " + word_of(probe.position_m[i]);
  for (int i = 0; turned && i < 3; ++i) text += " " + word_of(probe.normal[i]);
  return text;
}
std::string get_probes(const Desk& desk) {
  std::string text;
  for (const Probe& probe : desk.probes) text += (text.empty() ? "" : "; ") + probe_words(probe);
  return text.empty() ? "none" : text;
}

Status set_point(Desk& desk, std::string_view value, const DeskContext&) {
  if (value == "none") {
    desk.point.reset();
    return Done{};
  }
  const std::vector<std::string> words = words_of(value);
  const auto point = probe_of(words, kProbeFrameNames);
  if (!point) return point.error();
  desk.point = *point;
  return Done{};
}
std::string get_point(const Desk& desk) {
  return desk.point ? probe_words(*desk.point) : "none";
}

Status set_grid(Desk& desk, std::string_view value, const DeskContext&) {
  if (value == "next") {
    desk.grid_m = desk.grid_m == 0.0 ? 10.0 : desk.grid_m == 10.0 ? 20.0 : 0.0;
    return Done{};
  }
  if (value == "off") {
    desk.grid_m = 0.0;
    return Done{};
  }
  const auto spacing_m = number_of(value, 1.0, 100.0);
  if (!spacing_m) return spacing_m.error();
  desk.grid_m = *spacing_m;
  return Done{};
}
std::string get_grid(const Desk& desk) {
  return desk.grid_m == 0.0 ? "off" : word_of(desk.grid_m);
}

/// "auto", or a level of an effect by its name.
template <std::optional<std::size_t> Desk::*level, const auto& names>
Status set_level(Desk& desk, std::string_view value, const DeskContext&) {
  std::array<std::string_view, names.size() + 1> known{"auto"};
  std::ranges::copy(names, known.begin() + 1);
  const auto found = std::ranges::find(known, value);
  if (found == known.end()) return none_of(value, known);
  (desk.*level).reset();
  if (found != known.begin()) desk.*level = static_cast<std::size_t>(found - known.begin()) - 1;
  return Done{};
}
template <std::optional<std::size_t> Desk::*level, const auto& names>
std::string get_level(const Desk& desk) {
  return !(desk.*level) ? "auto" : std::string(names[*(desk.*level)]);
}

/// "clear", or metres.
Status set_visibility(Desk& desk, std::string_view value, const DeskContext&) {
  if (value == "clear") {
    desk.visibility_m.reset();
    return Done{};
  }
  const auto visibility_m = number_of(value, kLeastVisibility_m, kMostVisibility_m);
  if (!visibility_m) return Error{"", visibility_m.error().reason + "; or clear"};
  desk.visibility_m = *visibility_m;
  return Done{};
}
std::string get_visibility(const Desk& desk) {
  return desk.visibility_m ? word_of(*desk.visibility_m) : "clear";
}

Status set_wiper(Desk& desk, std::string_view value, const DeskContext&) {
  const auto found = std::ranges::find(kWiperNames, value);
  if (found == kWiperNames.end()) return none_of(value, kWiperNames);
  desk.wiper = static_cast<Wiper>(found - kWiperNames.begin());
  return Done{};
}
std::string get_wiper(const Desk& desk) {
  return std::string(kWiperNames[static_cast<std::size_t>(desk.wiper)]);
}

constexpr DeskSetting kSettings[] = {
    {"cameras", "none, [add] NAME car|world X Y Z YAW_DEG PITCH_DEG [FOV_DEG]; ..., add NAME, remove NAME",
     "cameras of one's own; add NAME: as the picture is seen now", true, set_cameras, get_cameras},
    {"camera",
     "driver, birds-eye, chase, oncoming, wall, left-mirror, inner-mirror, right-mirror, free, a name of cameras, next",
     "the eye: the driver's, above the road, behind the car, of a driver who meets it, before a wall at 25 m, mirrors, "
     "free, one's own",
     true, set_camera, get_camera},
    {"layout", "full, split, inset, next", "one camera, two in halves, or a second one small in a corner", true,
     set_layout, get_layout},
    {"second_camera", "a camera but next", "of a layout with two", true, set_second_camera, get_second_camera},
    {"free_eye", "car|world X Y Z YAW_DEG PITCH_DEG [FOV_DEG]",
     "of the camera free: m, degrees to the left and up; moved by mouse and keys too", true, set_free_eye,
     get_free_eye},
    {"mirrors", "off, on, toggle", "the three mirrors over the picture", true, set_flag<&Desk::mirrors>,
     get_flag<&Desk::mirrors>},
    {"compare", "off, split, flicker, difference, ratio, next",
     "two designs in one picture: halves, by turns, or what the other has more or less by colour", true, set_compare,
     get_compare},
    {"versus", "next, 0, 1, ...", "the design beside that which shines; next: the one after it", true,
     set_number_of_design<&Desk::versus, kNextName>, get_number_of_design<&Desk::versus, kNextName>},
    {"versus_aligned", "off, on, toggle", "that design turned until both cut-offs stand equally high at 25 m", true,
     set_versus_aligned, get_flag<&Desk::versus_aligned>},
    {"view", "photo, false-colour, clipping, next",
     "as the eye sees it, illuminance by colour, or stripes where the display clips", true, set_view, get_view},
    {"method", "fragment, vertex, vertex-1998, reference, next", "where illuminance is computed: docs/accuracy.md",
     true, set_method, get_method},
    {"isolux_lx", "up to 8 rising numbers, default", "lines of equal illuminance in false colour", true, set_isolux,
     get_isolux},
    {"exposure_per_cdm2", "0.000001 to 1000000", "multiplies luminance before the tone curve", true, set_exposure,
     get_exposure},
    {"adaptation_k", "auto, 2000 to 25000", "light of this colour temperature looks white; auto: as the lamps shine",
     false, set_adaptation, get_adaptation},
    {"design", "cockpit, 0, 1, ...", "the picture shows this design, whatever the cockpit has chosen", true,
     set_number_of_design<&Desk::design, kCockpitName>, get_number_of_design<&Desk::design, kCockpitName>},
    {"probes", "none, [add] car|world X Y Z [NX NY NZ]; road S LEFT [UP]; ...",
     "points whose lux the overlay tells and probes.csv keeps", true, set_probes, get_probes},
    {"point", "none, picture X_01 Y_01, car|world X Y Z [NX NY NZ], road S LEFT [UP]",
     "one point read lamp by lamp: what a click in the window chooses", true, set_point, get_point},
    {"plot", "off, on, toggle", "lux at the probes and at the point over the last 20 s, in the picture", true,
     set_flag<&Desk::plot>, get_flag<&Desk::plot>},
    {"grid_m", "off, 1 to 100, next", "a grid on the road ahead with this spacing", true, set_grid, get_grid},
    {"road_isolux", "off, on, toggle", "isolux lines on the road of the photo", true, set_flag<&Desk::isolux>,
     get_flag<&Desk::isolux>},
    {"scale", "off, on, toggle", "the scale of the false colours, where they are", true, set_flag<&Desk::scale>,
     get_flag<&Desk::scale>},
    {"reach", "off, on, toggle", "how far 1, 3 and 5 lx reach along the lane's edges; kept in probes.csv", true,
     set_flag<&Desk::reach>, get_flag<&Desk::reach>},
    {"lines", "off, on, toggle", "text at the top: time, lux under the mouse, warnings", true, set_flag<&Desk::lines>,
     get_flag<&Desk::lines>},
    {"instruments", "off, on, toggle", "speed, gear and lights at the lower edge", true, set_flag<&Desk::instruments>,
     get_flag<&Desk::instruments>},
    {"effects", "off, on, toggle", "in the picture: each effect with its level and the reason", true,
     set_flag<&Desk::effects>, get_flag<&Desk::effects>},
    {"help", "off, on, toggle", "every key", false, set_flag<&Desk::help>, get_flag<&Desk::help>},
    {"panel", "off, on, toggle", "what the mouse sets: designs, lamps, view, effects; times and messages", true,
     set_flag<&Desk::panel>, get_flag<&Desk::panel>},
    {"depth_first", "auto, off, on", "a depth pass before the lit one; auto: with shadows by rays", true,
     set_level<&Desk::depth_first, kOffOnNames>, get_level<&Desk::depth_first, kOffOnNames>},
    {"hdr_image", "auto, off, on", "luminance in cd/m² before the tone curve; auto: where something reads it", true,
     set_level<&Desk::hdr_image, kOffOnNames>, get_level<&Desk::hdr_image, kOffOnNames>},
    {"overlay", "auto, off, on", "all that is written and drawn over the picture, warnings too; auto: where some is",
     true, set_level<&Desk::overlay, kOffOnNames>, get_level<&Desk::overlay, kOffOnNames>},
    {"shadows", "auto, off, hard, soft, fine, rays, lens", "of what stands in the beams; auto: as the scene calls for",
     true, set_level<&Desk::shadows, kShadowNames>, get_level<&Desk::shadows, kShadowNames>},
    {"fog", "auto, off, coarse, medium, fine, shadowed, finest",
     "light scattered in fog; auto: as the visibility calls for", true, set_level<&Desk::fog, kFogNames>,
     get_level<&Desk::fog, kFogNames>},
    {"precipitation", "auto, off, on", "drops and flakes near the eye, one by one; auto: as they fall", true,
     set_level<&Desk::precipitation, kOffOnNames>, get_level<&Desk::precipitation, kOffOnNames>},
    {"ground", "auto, dry, damp, wet, flooded", "water on the ground; auto: as it rains", true,
     set_level<&Desk::ground, kWetNames>, get_level<&Desk::ground, kWetNames>, "weather"},
    {"glare", "auto, off, on", "light that lamps scatter in the eye; auto: as they shine into it", true,
     set_level<&Desk::glare, kOffOnNames>, get_level<&Desk::glare, kOffOnNames>},
    {"fixed_light", "auto, off, on", "of street lamps, the moon and what shines by itself; auto: as the scene has it",
     true, set_level<&Desk::fixed_light, kOffOnNames>, get_level<&Desk::fixed_light, kOffOnNames>},
    {"asphalt", "auto, lambert, r-table", "how it sends light of street lamps to the eye; auto: by its r-table", true,
     set_level<&Desk::asphalt, kAsphaltNames>, get_level<&Desk::asphalt, kAsphaltNames>},
    {"eyeshine", "auto, off, on", "of animals' eyes in the car's lamps; auto: as they look at them", true,
     set_level<&Desk::eyeshine, kOffOnNames>, get_level<&Desk::eyeshine, kOffOnNames>},
    {"spray", "auto, off, on", "behind others' wheels on wet ground; auto: as they throw it up", true,
     set_level<&Desk::spray, kOffOnNames>, get_level<&Desk::spray, kOffOnNames>},
    {"windscreen", "off, on, toggle", "rain on a windscreen before the driver's eye", true, set_flag<&Desk::windscreen>,
     get_flag<&Desk::windscreen>},
    {"windscreen_drawn", "auto, off, on", "what rain makes of the windscreen; auto: as it falls on one", true,
     set_level<&Desk::windscreen_drawn, kOffOnNames>, get_level<&Desk::windscreen_drawn, kOffOnNames>},
    {"wiper", "off, interval, slow, fast", "of the windscreen: one stroke in 6 s, 45 or 65 in a minute", true,
     set_wiper, get_wiper},
    {"age_years", "1 to 120", "of who looks: how much light the eye scatters", true,
     set_number<&Desk::age_years, 1, 1200>, get_number<&Desk::age_years>},
    {"iris_pigment", "0 to 1.2", "of who looks: 0 black, 0.5 brown, 1 light, 1.2 blue", true,
     set_number<&Desk::iris_pigment, 0, 12>, get_number<&Desk::iris_pigment>},
    {"visibility_m", "clear, 1 to 100000", "meteorological visibility: fog from it, with the beams in it", true,
     set_visibility, get_visibility, "weather"},
    {"rain_mmph", "0 to 100", "rain: its drops in the beams, and what it takes of them", true,
     set_number<&Desk::rain_mmph, 0, 10 * kMostRain_mmph>, get_number<&Desk::rain_mmph>, "weather"},
    {"snow_mmph", "0 to 10", "snow, mm/h of water: its flakes in the beams, and what it takes of them", true,
     set_number<&Desk::snow_mmph, 0, 10 * kMostSnow_mmph>, get_number<&Desk::snow_mmph>, "weather"},
    {"snow_cover", "0 to 1", "snow that lies: the share of level ground, and of what looks up, that it covers", true,
     set_number<&Desk::snow_cover_01, 0, 10>, get_number<&Desk::snow_cover_01>, "weather"},
    {"snow_cover_drawn", "auto, off, on", "snow that lies; auto: as much as snow_cover says", true,
     set_level<&Desk::snow_cover_drawn, kOffOnNames>, get_level<&Desk::snow_cover_drawn, kOffOnNames>, "weather"},
    {"weather_ahead", "auto, off, on",
     "what other weather takes is made before a drive in real time; auto: in a window, for 8 s or so, or if it begins "
     "in some",
     true, set_level<&Desk::weather_ahead, kOffOnNames>, get_level<&Desk::weather_ahead, kOffOnNames>, "weather"},
};

}  // namespace

std::span<const DeskSetting> desk_settings() {
  return kSettings;
}

Result<std::string> apply(Desk& desk, const DeskCommand& command, const DeskContext& context) {
  const auto setting = std::ranges::find(kSettings, command.setting, &DeskSetting::name);
  if (setting == std::end(kSettings)) {
    std::vector<std::string> names;
    for (const DeskSetting& known : kSettings) names.emplace_back(known.name);
    return Error{"", unknown_name_reason("setting", command.setting, names)};
  }
  if (!command.value.empty()) {
    if (const Status done = setting->set(desk, command.value, context); !done)
      return Error{command.setting, done.error().reason};
  }
  return std::string(setting->name) + " " + setting->get(desk);
}

DeskCommand desk_command(std::string_view words) {
  const std::size_t blank = std::min(words.find(' '), words.size());
  return {std::string(words.substr(0, blank)), std::string(words.substr(std::min(blank + 1, words.size())))};
}

std::vector<DeskCommand> difference(const Desk& desk, const Desk& other) {
  std::vector<DeskCommand> commands;
  for (const DeskSetting& setting : kSettings) {
    std::string value = setting.get(desk);
    if (value != setting.get(other)) commands.push_back({std::string(setting.name), std::move(value)});
  }
  return commands;
}

std::string desk_settings_text(std::string_view indent) {
  std::string text;
  for (const DeskSetting& setting : kSettings) {
    text += indent;
    text += setting.name;
    text.append(19 - std::min<std::size_t>(setting.name.size(), 18), ' ');
    text += std::string(setting.values) + "   " + std::string(setting.what) + "\n";
  }
  return text;
}

}  // namespace phare
