#include "config/rig.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>
#include <variant>

#include "config/base/input_files.h"
#include "config/base/paths.h"
#include "config/desk.h"
#include "config/drive_names.h"
#include "config/formats/filled_text.h"
#include "config/formats/toml_table.h"
#include "config/light_colour.h"
#include "config/picture_size.h"
#include "config/port_base.h"

namespace phare {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::size_t kMaxChannels = 16;

/// A place in the car, m.
glm::dvec3 place_in_car(TomlTable& table, std::string_view key, const std::vector<double>& xyz) {
  if (std::ranges::any_of(xyz, [](double x) { return !(std::abs(x) <= kFarthestFromCar_m); }))
    table.fail(key, "farther than " + std::to_string(std::lround(kFarthestFromCar_m)) + " m from the car");
  return {xyz[0], xyz[1], xyz[2]};
}

double degrees(TomlTable& table, std::string_view key, double min_deg, double max_deg) {
  return table.number_or(key, 0.0, min_deg, max_deg) * kRadPerDeg;
}

/// How the picture begins, in the words of config/desk.h; several numbers are an array. `name`: of the table.
void read_desk(TomlTable table, std::string_view name, std::size_t designs, Desk& desk) {
  for (const DeskSetting& setting : desk_settings()) {
    if (!setting.in_rig || setting.rig_table != name) continue;
    std::string words;
    for (const auto& value : table.values_or_empty(setting.name)) {
      if (const auto* number = std::get_if<double>(&value)) {
        char digits[40];
        words += (words.empty() ? "" : " ") +
                 std::string(digits, std::to_chars(digits, digits + sizeof digits, *number).ptr);
      } else {
        words += (words.empty() ? "" : "; ") + std::get<std::string>(value);
      }
    }
    if (words.empty()) continue;
    if (const auto done = apply(desk, {std::string(setting.name), words}, {.designs = designs}); !done)
      table.fail(setting.name, done.error().reason);
  }
}

ChannelConfig read_channel(TomlTable table, std::size_t index) {
  ChannelConfig channel;
  channel.name = table.text_or("name", "channel-" + std::to_string(index));
  if (const std::string reason = why_no_channel_name(channel.name, index == 0); !reason.empty())
    table.fail("name", "\"" + channel.name + "\": " + reason);
  channel.width_px = static_cast<int>(table.integer_or("width_px", channel.width_px, kLeastSide_px, kMostSide_px));
  channel.height_px = static_cast<int>(table.integer_or("height_px", channel.height_px, kLeastSide_px, kMostSide_px));
  channel.fov_horizontal_rad = table.number_or("fov_horizontal_deg", 60.0, 1.0, 170.0) * kRadPerDeg;
  const std::array eye_m{channel.eye_m.x, channel.eye_m.y, channel.eye_m.z};
  channel.eye_m = place_in_car(table, "eye_m", table.numbers_or("eye_m", eye_m));
  channel.yaw_rad = degrees(table, "yaw_deg", -180.0, 180.0);
  channel.pitch_rad = degrees(table, "pitch_deg", -89.0, 89.0);
  channel.place = read_bus_place(table);
  return channel;
}

SourceConfig read_source(TomlTable table, const std::filesystem::path& rig_file) {
  SourceConfig source;
  source.function = static_cast<LampFunction>(table.choice("function", kLampFunctionNames));
  source.file = resolve_path(filled_text(table, "file"), rig_file);
  source.axis = static_cast<GammaAxis>(table.choice_or("axis", 0, kGammaAxisNames));
  source.c0_turn_deg = table.number_or("c0_deg", 0.0, -360.0, 360.0);
  source.mirror = table.flag_or("mirror", false);
  source.lamp_set = static_cast<std::size_t>(table.integer_or("lamp_set", 1, 1, 1000));
  source.emitter = static_cast<std::size_t>(table.integer_or("emitter", 1, 1, 1000));
  source.distance_m = table.number_or("distance_m", 0.0, 0.0, 1e6);
  source.scale = table.number_or("scale", 1.0, 0.0, 1e6);
  source.yaw_rad = degrees(table, "yaw_deg", -180.0, 180.0);
  source.pitch_rad = degrees(table, "pitch_deg", -90.0, 90.0);
  source.roll_rad = degrees(table, "roll_deg", -180.0, 180.0);
  if (table.has("pixels")) source.pixels = resolve_path(filled_text(table, "pixels"), rig_file);
  if (table.has("pixel_map")) {
    source.pixel_map = resolve_path(filled_text(table, "pixel_map"), rig_file);
    if (!table.has("pixels")) table.fail("pixel_map", "says where the pixels of \"pixels\" shine, and there are none");
  }
  const LightColour colour = read_light_colour(table);
  source.colour_temperature_k = colour.colour_temperature_k.value_or(source.colour_temperature_k);
  source.chromaticity_xy = colour.chromaticity_xy;
  source.spectrum = colour.spectrum;
  return source;
}

/// One, or one for each of the first `emitters` of a file: a matrix in one file.
std::vector<SourceConfig> read_sources(TomlTable table, const std::filesystem::path& rig_file) {
  const SourceConfig source = read_source(table, rig_file);
  if (!table.has("emitters")) return {source};
  if (table.has("emitter")) table.fail("emitters", "stands for emitter 1 and those that follow; \"emitter\" is one");
  if (!source.pixels.empty()) table.fail("emitters", "\"pixels\" are of one source");
  std::vector<SourceConfig> sources(static_cast<std::size_t>(table.integer_or("emitters", 1, 1, 1000)), source);
  for (std::size_t i = 0; i < sources.size(); ++i) sources[i].emitter = i + 1;
  return sources;
}

/// "as-filed", "cut-off", or degrees up.
AimConfig read_aim(TomlTable& table) {
  AimConfig aim;
  const auto values = table.values_or_empty("aim");
  if (values.empty()) return aim;
  const auto wrong = [&] {
    table.fail("aim", "\"as-filed\", \"cut-off\", or the degrees (-90 to 90) by which the lamp is turned up");
    return AimConfig{};
  };
  if (values.size() != 1) return wrong();
  if (const auto* word = std::get_if<std::string>(&values.front())) {
    if (*word != "as-filed" && *word != "cut-off") return wrong();
    if (*word == "cut-off") aim.kind = AimConfig::Kind::kCutoff;
    return aim;
  }
  const double up_deg = std::get<double>(values.front());
  if (!(std::abs(up_deg) <= 90.0)) return wrong();
  return {AimConfig::Kind::kTurned, up_deg * kRadPerDeg};
}

void read_lamp(TomlTable table, const std::filesystem::path& rig_file, DesignConfig& design) {
  LampConfig lamp;
  lamp.name = filled_text(table, "name");
  lamp.position_m = place_in_car(table, "position_m", table.numbers("position_m", 3));
  lamp.aim = read_aim(table);
  for (TomlTable source : table.tables("source"))
    std::ranges::copy(read_sources(source, rig_file), std::back_inserter(lamp.sources));
  if (lamp.sources.empty()) table.fail("source", "a lamp needs at least one [[design.lamp.source]]");
  if (std::ranges::count_if(lamp.sources, [](const SourceConfig& source) { return !source.pixels.empty(); }) > 1)
    table.fail("source", "a lamp has one source with \"pixels\" at most");
  if (!table.flag_or("pair", false)) {
    design.lamps.push_back(lamp);
    return;
  }
  if (!(lamp.position_m.y > 0.0)) table.fail("position_m", "a pair is given by its left lamp, y > 0");
  LampConfig right = lamp_across(lamp);
  lamp.name += " left";
  right.name += " right";
  design.lamps.push_back(std::move(lamp));
  design.lamps.push_back(std::move(right));
}

DesignConfig read_design(TomlTable table, const std::filesystem::path& rig_file) {
  DesignConfig design;
  design.name = filled_text(table, "name");
  for (TomlTable lamp : table.tables("lamp")) read_lamp(lamp, rig_file, design);
  if (design.lamps.empty()) table.fail("lamp", "a design needs at least one [[design.lamp]]");
  if (design.lamps.size() > kMostLampsOfDesign) {
    table.fail("lamp", std::to_string(design.lamps.size()) + " lamp positions; at most " +
                           std::to_string(kMostLampsOfDesign) + " are drawn");
  }
  return design;
}

template <typename Named>
void check_names_differ(TomlTable& table, std::string_view key, const std::vector<Named>& items) {
  std::set<std::string> seen;
  for (const Named& item : items) {
    if (!seen.insert(item.name).second) table.fail(key, "two of them are named \"" + item.name + "\"");
  }
}

}  // namespace

LampConfig lamp_across(LampConfig lamp) {
  lamp.position_m.y = -lamp.position_m.y;
  for (SourceConfig& source : lamp.sources) {
    source.yaw_rad = -source.yaw_rad;
    source.roll_rad = -source.roll_rad;
  }
  return lamp;
}

Result<Rig> read_rig(const std::filesystem::path& file) {
  auto reading = read_rig_whole(file);
  if (!reading) return reading.error();
  if (!reading->problems.empty()) return reading->problems.front();
  return std::move(reading->rig);
}

namespace {

RigReading read_root(TomlTable root, const std::filesystem::path& file) {
  const std::filesystem::path rig_file = std::filesystem::absolute(file).lexically_normal();

  RigReading reading;
  Rig& rig = reading.rig;
  rig.file = rig_file;
  rig.name = root.text_or("name", rig_file.stem().string());
  rig.keep_design = root.flag_or("keep_design", rig.keep_design);
  rig.scene_file = resolve_path(filled_text(root, "scene"), rig_file);
  if (const std::string traffic = root.text_or("traffic", ""); !traffic.empty())
    rig.traffic_file = resolve_path(traffic, rig_file);
  if (const std::string lamps = root.text_or("street_lamps", ""); !lamps.empty())
    rig.street_lamps_file = resolve_path(lamps, rig_file);
  if (auto moon = root.table_if("moon")) {
    MoonConfig shining;
    shining.azimuth_rad = moon->number_or("azimuth_deg", 0.0, -360.0, 360.0) * kRadPerDeg;
    shining.elevation_rad = moon->number_or("elevation_deg", 40.0, 0.0, 90.0) * kRadPerDeg;
    shining.illuminance_lx = moon->number_or("illuminance_lx", 0.0, 0.0, 0.5);
    if (shining.illuminance_lx > 0.0) rig.moon = shining;
  }
  rig.vehicle_file = resolve_path(filled_text(root, "vehicle"), rig_file);
  rig.cockpit_file = resolve_path(filled_text(root, "cockpit"), rig_file);
  if (auto bus = root.table_if("bus")) {
    rig.bind_address = bus->text_or("address", rig.bind_address);
    if (!is_ipv4(rig.bind_address))
      bus->fail("address", "\"" + rig.bind_address + "\" is not an IPv4 address such as 10.0.0.2");
    rig.places = read_bus_places(*bus);
    rig.port_base =
        static_cast<std::uint16_t>(bus->integer_or("port_base", rig.port_base, kLowestPortBase, kHighestPortBase));
    rig.run_key = bus->flag_or("run_key", rig.run_key);
    const std::string key_file = bus->text_or("key_file", "");
    if (!key_file.empty()) {
      rig.key_file = resolve_path(key_file, rig_file);
      const Result<BusKey> key = read_bus_key(rig.key_file);
      if (key)
        rig.bus_key = *key;
      else
        reading.problems.push_back(key.error());
    }
  }
  if (auto clock = root.table_if("clock")) {
    rig.frame_rate_hz = clock->integer_or("frame_rate_hz", rig.frame_rate_hz, 1, 1000);
    rig.real_time_priority = clock->flag_or("real_time_priority", rig.real_time_priority);
  }
  if (auto dynamics = root.table_if("dynamics")) {
    rig.dynamics_level = kDynamicsLevelNames[dynamics->choice_or("level", 1, kDynamicsLevelNames)];
    rig.dynamics_step_s = dynamics->number_or("step_s", rig.dynamics_step_s, 1e-5, 0.05);
  }
  if (auto beams = root.table_if("beams")) {
    rig.high_keeps_low = beams->flag_or("high_keeps_low", rig.high_keeps_low);
    rig.beam_image =
        static_cast<ImageLevel>(beams->choice_or("image", static_cast<std::size_t>(rig.beam_image), kImageLevelNames));
  }
  if (auto eye = root.table_if("eye")) {
    const double white_k = eye->number_or("adaptation_k", 4000.0, kCoolestWhite_k, kHottestWhite_k);
    if (eye->has("adaptation_k")) rig.desk.eye.fixed_k = white_k;
  }
  for (TomlTable channel : root.tables("channel")) rig.channels.push_back(read_channel(channel, rig.channels.size()));
  for (TomlTable design : root.tables("design")) rig.designs.push_back(read_design(design, rig_file));

  if (rig.key_file.empty() && off_loopback(rig)) {
    TomlTable bus = root.table_if("bus").value_or(root);
    bus.fail("address",
             "off loopback (127.…) a key_file is required: 64 hexadecimal digits, as of openssl rand -hex 32");
  }
  for (const std::string_view name : kDeskTables)
    if (auto desk = root.table_if(name)) read_desk(*desk, name, rig.designs.size(), rig.desk);

  if (rig.channels.empty()) root.fail("channel", "a rig needs at least one [[channel]]");
  if (rig.channels.size() > kMaxChannels) root.fail("channel", "at most 16 channels");
  if (rig.designs.empty()) root.fail("design", "a rig needs at least one [[design]]");
  check_names_differ(root, "channel", rig.channels);
  check_names_differ(root, "design", rig.designs);
  const std::vector<Error> of_file = root.problems();
  reading.problems.insert(reading.problems.begin(), of_file.begin(), of_file.end());
  reading.known_keys = root.known_keys();
  return reading;
}

}  // namespace

Result<RigReading> read_rig_whole(const std::filesystem::path& file) {
  auto root = TomlTable::read(file);
  if (!root) return root.error();
  return read_root(std::move(*root), file);
}

Result<RigReading> read_rig_text(std::string_view text, const std::filesystem::path& file) {
  auto root = TomlTable::parse(text, file.string());
  if (!root) return root.error();
  return read_root(std::move(*root), file);
}

Status check_rig_files(const Rig& rig) {
  const auto missing = [&](const std::filesystem::path& path, const std::string& what) -> std::optional<Error> {
    const std::string why = why_no_file(path);
    if (why.empty()) return std::nullopt;
    return Error{path.string(), why + "; it is " + what + " of " + rig.file.string()};
  };
  if (auto error = missing(rig.scene_file, "the scene")) return *error;
  if (!rig.traffic_file.empty())
    if (auto error = missing(rig.traffic_file, "the traffic")) return *error;
  if (!rig.street_lamps_file.empty())
    if (auto error = missing(rig.street_lamps_file, "the street lamps")) return *error;
  if (auto error = missing(rig.vehicle_file, "the vehicle")) return *error;
  if (auto error = missing(rig.cockpit_file, "the cockpit")) return *error;
  for (const DesignConfig& design : rig.designs) {
    for (const LampConfig& lamp : design.lamps) {
      for (const SourceConfig& source : lamp.sources) {
        if (auto error = missing(source.file, "lamp \"" + lamp.name + "\", design \"" + design.name + "\","))
          return *error;
      }
    }
  }
  return Done{};
}

std::vector<std::string> files_of(const Rig& rig) {
  std::vector<std::string> files;
  const auto add = [&](std::initializer_list<std::filesystem::path> named) {
    for (const std::filesystem::path& file : named)
      if (!file.empty()) files.push_back(file.string());
  };
  add({rig.file, rig.key_file, rig.scene_file, rig.traffic_file, rig.street_lamps_file, rig.vehicle_file,
       rig.cockpit_file});
  for (const DesignConfig& design : rig.designs)
    for (const LampConfig& lamp : design.lamps)
      for (const SourceConfig& source : lamp.sources)
        add({source.file, source.spectrum, source.pixels, source.pixel_map});
  return files;
}

namespace {

// The first key of a lamp argument: a comma, a word of letters, digits and '_', and '='. The comma, or npos.
std::size_t first_key(const std::string& text) {
  for (std::size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',', comma + 1)) {
    std::size_t end = comma + 1;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_')) ++end;
    if (end > comma + 1 && end < text.size() && text[end] == '=') return comma;
  }
  return std::string::npos;
}

std::string short_text(double number) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%g", number);
  return digits;
}

struct LampArgumentFile {
  std::string name;
  std::size_t end = std::string::npos;  ///< where the keys begin: a comma, or npos
};

// The file at the head of a lamp argument. A name may hold commas; one that holds ",word=" stands in double quotes, a
// quote in it doubled.
Result<LampArgumentFile> lamp_argument_file(const std::string& text, const Error& unfinished) {
  LampArgumentFile file;
  if (!text.starts_with('"')) {
    file.end = first_key(text);
    file.name = text.substr(0, file.end);
    return file;
  }
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (text[at] != '"') {
      file.name += text[at];
    } else if (at + 1 < text.size() && text[at + 1] == '"') {
      file.name += text[at++];
    } else if (at + 1 < text.size() && text[at + 1] != ',') {
      return unfinished;
    } else {
      file.end = at + 1 < text.size() ? at + 1 : std::string::npos;
      return file;
    }
  }
  return unfinished;
}

}  // namespace

Result<LampConfig> parse_lamp_argument(const std::string& text, const std::vector<std::string>& known_before) {
  static const std::vector<std::string> known{"x",        "y",          "z",      "yaw_deg", "pitch_deg",
                                              "roll_deg", "axis",       "c0_deg", "mirror",  "lamp_set",
                                              "emitter",  "distance_m", "scale"};
  const auto wrong = [&](const std::string& reason) { return Error{"--lamp " + text, reason}; };
  LampConfig lamp;
  SourceConfig source;

  const auto named =
      lamp_argument_file(text, wrong("a file name in double quotes ends with a quote, and a comma or nothing follows"));
  if (!named) return named.error();
  const std::string& file = named->name;
  std::size_t start = named->end;
  if (file.empty()) return wrong("expected FILE,x=…,y=…,z=…");
  if (!text.starts_with('"') && known.end() != std::find(known.begin(), known.end(), file.substr(0, file.find('='))) &&
      file.find('=') != std::string::npos)
    return wrong("the photometry file comes first: FILE,x=…,y=…,z=…");
  source.file =
      is_standard_input(file) ? std::filesystem::path(file) : std::filesystem::absolute(file).lexically_normal();
  std::set<std::string> given;
  while (start != std::string::npos) {
    const std::size_t end = text.find(',', start + 1);
    const std::string item = text.substr(start + 1, end == std::string::npos ? end : end - start - 1);
    start = end;
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos) return wrong("expected key=value, got \"" + item + "\"");
    const std::string key = item.substr(0, equals), value = item.substr(equals + 1);
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::vector<std::string> all = known;
      all.insert(all.end(), known_before.begin(), known_before.end());
      return wrong(unknown_name_reason("key", key, all));
    }
    if (!given.insert(key).second) return wrong("\"" + key + "\" is given twice");
    if (key == "axis") {
      if (value != "gamma0" && value != "gamma90")
        return wrong("\"axis\": \"" + value + "\" is none of gamma0, gamma90");
      source.axis = value == "gamma0" ? GammaAxis::kGamma0 : GammaAxis::kGamma90;
      continue;
    }
    double number = 0.0;
    const auto [stop, failed] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (failed != std::errc() || stop != value.data() + value.size() || !std::isfinite(number)) {
      return wrong("\"" + key + "\": expected a finite number, got \"" + value + "\"");
    }
    static const std::map<std::string, std::pair<double, double>> limits{
        {"yaw_deg", {-180.0, 180.0}}, {"pitch_deg", {-90.0, 90.0}}, {"roll_deg", {-180.0, 180.0}},
        {"c0_deg", {-360.0, 360.0}},  {"distance_m", {0.01, 1e6}},  {"scale", {0.0, 1e6}}};
    if (const auto limit = limits.find(key);
        limit != limits.end() && !(number >= limit->second.first && number <= limit->second.second))
      return wrong("\"" + key + "\": " + value + " is outside " + short_text(limit->second.first) + " to " +
                   short_text(limit->second.second));
    if (key == "x") lamp.position_m.x = number;
    if (key == "y") lamp.position_m.y = number;
    if (key == "z") lamp.position_m.z = number;
    if (key == "yaw_deg") source.yaw_rad = number * kRadPerDeg;
    if (key == "pitch_deg") source.pitch_rad = number * kRadPerDeg;
    if (key == "roll_deg") source.roll_rad = number * kRadPerDeg;
    if (key == "scale") source.scale = number;
    if (key == "c0_deg") source.c0_turn_deg = number;
    if (key == "distance_m") source.distance_m = number;
    if (key == "mirror") {
      if (number != 0.0 && number != 1.0) return wrong("\"mirror\" is 0 or 1");
      source.mirror = number == 1.0;
    }
    if (key == "lamp_set" || key == "emitter") {
      if (!(number >= 1.0 && number <= 1000.0) || number != std::floor(number))
        return wrong("\"" + key + "\" counts from 1");
      (key == "emitter" ? source.emitter : source.lamp_set) = static_cast<std::size_t>(number);
    }
  }
  for (const char* key : {"x", "y", "z"}) {
    if (!given.contains(key)) return wrong(std::string("\"") + key + "\" is missing (position in m)");
  }
  lamp.name = is_standard_input(source.file) ? input_name(source.file) : source.file.stem().string();
  lamp.sources.push_back(std::move(source));
  return lamp;
}

}  // namespace phare
