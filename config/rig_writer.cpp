#include "config/rig_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "config/base/paths.h"

namespace phare {

std::string number_word(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value).ptr;
  return {text, end};
}

std::string vector_word(const glm::dvec3& v) {
  return "[" + number_word(v.x) + ", " + number_word(v.y) + ", " + number_word(v.z) + "]";
}

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Shortest decimal in degrees that read_rig turns into the same radians.
std::string degrees_word(double rad) {
  if (rad == 0.0) return "0";
  const double deg = rad / kRadPerDeg;
  for (int digits = 1; digits < 17; ++digits) {
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, deg, std::chars_format::general, digits).ptr;
    double back = 0.0;
    std::from_chars(text, end, back);
    if (back * kRadPerDeg == rad) return number_word(back);
  }
  for (double near : {deg, std::nextafter(deg, 1e9), std::nextafter(deg, -1e9)}) {
    if (near * kRadPerDeg == rad) return number_word(near);
  }
  return number_word(deg);
}

bool ends_with_side(const std::string& name, const std::string& side, std::string& stem) {
  if (!name.ends_with(side) || name.size() == side.size()) return false;
  stem = name.substr(0, name.size() - side.size());
  return true;
}

/// Do these two come from one table with pair = true?
bool is_pair(const LampConfig& left, const LampConfig& right, std::string& stem) {
  std::string other;
  if (!ends_with_side(left.name, " left", stem) || !ends_with_side(right.name, " right", other) || stem != other)
    return false;
  if (!(left.position_m.y > 0.0)) return false;
  LampConfig twin = lamp_across(left);
  twin.name = right.name;
  return twin == right;
}

class RigText {
 public:
  RigText(const Rig& rig, const RigWords& words) : rig_(rig), words_(words) {}

  std::string text() {
    comment(words_.heading);
    key("name", toml_quoted(rig_.name), "in the picture and the report");
    if (rig_.keep_design)
      key("keep_design", "true", "changes of design in a recorded drive, script or log are left out; by hand they act");
    out_ << '\n';
    key("scene", path(rig_.scene_file), "glTF; <its name>_lane.csv beside it is where the car starts");
    if (!rig_.traffic_file.empty()) key("traffic", path(rig_.traffic_file), "other road users");
    if (!rig_.street_lamps_file.empty()) key("street_lamps", path(rig_.street_lamps_file));
    key("vehicle", path(rig_.vehicle_file));
    key("cockpit", path(rig_.cockpit_file), "where the driver's controls come from");
    if (rig_.moon) {
      out_ << "\n[moon]\n";
      key("azimuth_deg", degrees_word(rig_.moon->azimuth_rad), "from x toward y");
      key("elevation_deg", degrees_word(rig_.moon->elevation_rad));
      key("illuminance_lx", number_word(rig_.moon->illuminance_lx), "on a plane that faces it");
    }
    out_ << "\n[bus]" << note("off loopback also key_file = a file of 64 hexadecimal digits, openssl rand -hex 32");
    key("address", toml_quoted(rig_.bind_address));
    key("port_base", std::to_string(rig_.port_base), "first UDP port");
    if (!rig_.key_file.empty()) key("key_file", path(rig_.key_file));
    if (!rig_.run_key) key("run_key", "false", "anyone on this machine may speak on the bus");
    write(rig_.places);
    out_ << "\n[clock]\n";
    key("frame_rate_hz", std::to_string(rig_.frame_rate_hz));
    key("real_time_priority", rig_.real_time_priority ? "true" : "false", "of cockpit and dynamics, in real time");
    out_ << "\n[dynamics]\n";
    key("level", toml_quoted(rig_.dynamics_level), "pose, kinematic, single-track, full or auto");
    key("step_s", number_word(rig_.dynamics_step_s));
    out_ << "\n[beams]\n";
    key("high_keeps_low", rig_.high_keeps_low ? "true" : "false", "low beam stays lit under high beam");
    key("image", toml_quoted(std::string(kImageLevelNames[static_cast<std::size_t>(rig_.beam_image)])),
        "how beams are stored on the device; this one keeps the file's own nodes");
    if (rig_.desk.eye.fixed_k) {
      out_ << "\n[eye]\n";
      key("adaptation_k", number_word(*rig_.desk.eye.fixed_k), "light of this colour temperature looks white");
    }
    write(rig_.desk);
    for (const ChannelConfig& channel : rig_.channels) write(channel);
    if (words_.comments)
      comment(
          "Designs of lamps, to be swapped while driving; the first one shines at the start. Positions in the car "
          "frame:\nx forward, y left, z up, m, origin on the ground below the middle of the rear axle.\nAngles in "
          "degrees: yaw to the left, pitch up, roll with the right side down.",
          true);
    for (std::size_t i = 0; i < rig_.designs.size(); ++i) write(rig_.designs[i], i);
    return out_.str();
  }

 private:
  std::string note(const std::string& text) const {
    return words_.comments && !text.empty() ? "  # " + text + "\n" : "\n";
  }
  void key(const std::string& name, const std::string& value, const std::string& says = "") {
    out_ << name << " = " << value << note(says);
  }
  std::string path(const std::filesystem::path& file) const { return toml_quoted(words_.path(file)); }
  /// Lines of a comment; a control character ends none of them.
  void comment(const std::string& text, bool apart = false) {
    if (text.empty()) return;
    if (apart) out_ << '\n';
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
      out_ << "# " << line << '\n';
    }
  }

  void write(const BusPlace& place) {
    if (!place.bind.empty()) key("bind", toml_quoted(place.bind));
    if (!place.send_to.empty()) key("send_to", toml_quoted(place.send_to));
  }

  void write(const BusPlaces& places) {
    const auto table = [&](const char* name, const BusPlace& place) {
      if (place == BusPlace{}) return;
      out_ << "\n[bus." << name << "]\n";
      write(place);
    };
    table("cockpit", places.cockpit);
    table("dynamics", places.dynamics);
    table("recorder", places.recorder);
    table("control", places.control);
  }

  void write(const Desk& desk) {
    for (const std::string_view table : kDeskTables) {
      bool begun = false;
      for (const DeskCommand& command : difference(desk)) {
        const DeskSetting& setting = *std::ranges::find(desk_settings(), command.setting, &DeskSetting::name);
        if (!setting.in_rig || setting.rig_table != table) continue;
        if (!std::exchange(begun, true)) out_ << "\n[" << table << "]" << note("the picture as it begins");
        key(command.setting, toml_quoted(command.value), std::string(setting.what));
      }
    }
  }

  void write(const ChannelConfig& channel) {
    out_ << "\n[[channel]]" << note("a window and its eye");
    key("name", toml_quoted(channel.name));
    key("width_px", std::to_string(channel.width_px));
    key("height_px", std::to_string(channel.height_px));
    key("fov_horizontal_deg", degrees_word(channel.fov_horizontal_rad));
    key("eye_m", vector_word(channel.eye_m), "in the car, as the lamps below");
    if (channel.yaw_rad != 0.0) key("yaw_deg", degrees_word(channel.yaw_rad));
    if (channel.pitch_rad != 0.0) key("pitch_deg", degrees_word(channel.pitch_rad));
    write(channel.place);
  }

  void write(const DesignConfig& design, std::size_t index) {
    out_ << "\n[[design]]\n";
    if (index < words_.of_designs.size()) comment(words_.of_designs[index]);
    key("name", toml_quoted(design.name));
    for (std::size_t i = 0; i < design.lamps.size(); ++i) {
      std::string stem;
      const bool pair = i + 1 < design.lamps.size() && is_pair(design.lamps[i], design.lamps[i + 1], stem);
      write(design.lamps[i], pair ? stem : design.lamps[i].name, pair);
      if (pair) ++i;
    }
  }

  void write(const LampConfig& lamp, const std::string& name, bool pair) {
    out_ << "\n[[design.lamp]]\n";
    key("name", toml_quoted(name));
    if (pair) key("pair", "true", std::string(kPairSays));
    key("position_m", vector_word(lamp.position_m));
    if (lamp.aim.kind == AimConfig::Kind::kCutoff)
      key("aim", "\"cut-off\"", "turned until its cut-off stands where UN R48 has it; \"as-filed\", or degrees up");
    if (lamp.aim.kind == AimConfig::Kind::kTurned)
      key("aim", degrees_word(lamp.aim.up_rad), "degrees up; or \"cut-off\", \"as-filed\"");
    for (const SourceConfig& source : lamp.sources) write(source);
  }

  void write(const SourceConfig& source) {
    const SourceConfig none;
    out_ << "\n[[design.lamp.source]]\n";
    key("function", toml_quoted(std::string(kLampFunctionNames[static_cast<std::size_t>(source.function)])));
    key("file", path(source.file));
    if (source.axis != none.axis)
      key("axis", toml_quoted(std::string(kGammaAxisNames[static_cast<std::size_t>(source.axis)])),
          "type C, EULUMDAT: where ahead lies in the file");
    if (source.c0_turn_deg != none.c0_turn_deg) key("c0_deg", number_word(source.c0_turn_deg));
    if (source.mirror) key("mirror", "true", "left and right turned round");
    if (source.lamp_set != none.lamp_set) key("lamp_set", std::to_string(source.lamp_set));
    if (source.emitter != none.emitter) key("emitter", std::to_string(source.emitter));
    if (source.distance_m != none.distance_m) key("distance_m", number_word(source.distance_m));
    if (source.scale != none.scale) key("scale", number_word(source.scale), "multiplies candela");
    if (source.yaw_rad != 0.0) key("yaw_deg", degrees_word(source.yaw_rad));
    if (source.pitch_rad != 0.0) key("pitch_deg", degrees_word(source.pitch_rad));
    if (source.roll_rad != 0.0) key("roll_deg", degrees_word(source.roll_rad));
    if (!source.pixels.empty()) key("pixels", path(source.pixels), "a pixel light: the picture it begins with");
    if (!source.pixel_map.empty()) key("pixel_map", path(source.pixel_map), "where its pixels shine");
    if (!source.spectrum.empty())
      key("spectrum", path(source.spectrum), "power over wavelength: its colour");
    else if (source.chromaticity_xy)
      out_ << "chromaticity_xy = [" << number_word(source.chromaticity_xy->x) << ", "
           << number_word(source.chromaticity_xy->y) << "]\n";
    else
      key("colour_temperature_k", number_word(source.colour_temperature_k));
  }

  const Rig& rig_;
  const RigWords& words_;
  std::ostringstream out_;
};

}  // namespace

std::string toml_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += std::string("\\") + c;
    } else if (byte < 0x20 || byte == 0x7f) {
      constexpr const char* kHex = "0123456789ABCDEF";
      quoted += std::string("\\u00") + kHex[byte >> 4] + kHex[byte & 15];
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

PathWords paths_from(const std::filesystem::path& folder, bool upwards) {
  const auto from = std::filesystem::absolute(folder).lexically_normal();
  const auto generated = std::filesystem::absolute(generated_dir()).lexically_normal();
  const auto below = [](const std::filesystem::path& file, const std::filesystem::path& base) {
    const auto relative = file.lexically_relative(base);
    return !relative.empty() && *relative.begin() != ".." ? relative : std::filesystem::path{};
  };
  return [=](const std::filesystem::path& file) {
    if (const auto made = below(file, generated); !made.empty()) return ("generated" / made).generic_string();
    // A folder of that name beside the rig would be taken for the build's.
    if (const auto near = below(file, from); !near.empty() && *near.begin() != "generated")
      return near.generic_string();
    const auto relative = file.lexically_relative(from);
    const bool program_file = !below(file, config_dir().lexically_normal()).empty();
    // Through the root, an absolute path says more.
    const bool common = std::distance(from.begin(), from.end()) > 1 && std::distance(file.begin(), file.end()) > 1 &&
                        *std::next(from.begin()) == *std::next(file.begin());
    if (upwards && !program_file && common) return relative.generic_string();
    return file.generic_string();
  };
}

std::string rig_text(const Rig& rig, const RigWords& words) {
  return RigText(rig, words).text();
}

}  // namespace phare
