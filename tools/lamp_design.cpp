#include "tools/lamp_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "config/base/input_files.h"
#include "config/spectrum.h"
#include "visual/photometry/bench/lamp_aim.h"
#include "visual/photometry/bench/lint.h"
#include "visual/photometry/bench/table_end.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

/// "a.ies", "x=1", "right=b, c.ies": cut at commas that a word and '=' follow, outside of double quotes.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool may_open = words.back().empty() || words.back().back() == '=';
    if (text[at] == '"' && (quoted || may_open)) quoted = !quoted;
    if (text[at] == ',' && !quoted) {
      std::size_t end = at + 1;
      while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_')) ++end;
      if (end > at + 1 && end < text.size() && text[end] == '=') {
        words.emplace_back();
        continue;
      }
    }
    words.back() += text[at];
  }
  return words;
}

/// A file name, taken out of its double quotes.
std::optional<std::string> unquoted(const std::string& word) {
  if (!word.starts_with('"')) return word;
  if (word.size() < 2 || !word.ends_with('"')) return std::nullopt;
  std::string name;
  for (std::size_t i = 1; i + 1 < word.size(); ++i) {
    if (word[i] == '"' && (i + 2 >= word.size() || word[++i] != '"')) return std::nullopt;
    name += word[i];
  }
  return name;
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [stop, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc() || stop != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

bool has_function(const LampConfig& lamp, LampFunction function) {
  return std::ranges::any_of(lamp.sources, [&](const SourceConfig& s) { return s.function == function; });
}

/// Where the rig has a function: its leftmost lamp, and whether there is one across.
struct Place {
  std::string name;  ///< without the side
  glm::dvec3 left_m{0.0};
  bool pair = true;
};
std::optional<Place> place_of(const DesignConfig& design, LampFunction function) {
  const LampConfig* left = nullptr;
  for (const LampConfig& lamp : design.lamps) {
    if (has_function(lamp, function) && (left == nullptr || lamp.position_m.y > left->position_m.y)) left = &lamp;
  }
  if (left == nullptr) return std::nullopt;
  Place place{left->name, left->position_m, left->position_m.y > 0.0};
  place.left_m.y = std::abs(place.left_m.y);
  for (const char* side : {" left", " right"}) {
    if (place.name.ends_with(side)) place.name.resize(place.name.size() - std::string_view(side).size());
  }
  return place;
}

class DesignMaker {
 public:
  DesignMaker(Rig& rig, const LampFlags& flags) : rig_(rig), flags_(flags) {}

  Result<LampDesignNotes> make() {
    if (const Status status = read_flags(); !status) return status.error();
    if (const Status status = read_rigs_own(); !status) return status.error();
    for (const LampChoice& choice : choices_) {
      if (const Status status = mount(choice); !status) return status.error();
    }
    aim();
    add_others();
    if (design_.lamps.size() > kMostLampsOfDesign) {
      return Error{choices_.front().flag,
                   fmt::format("{} lamp positions together with those of the rig; at most {} are "
                               "drawn (--lamp-others none leaves the rig's out)",
                               design_.lamps.size(), kMostLampsOfDesign)};
    }
    name_it();
    tell();
    rig_.designs.insert(rig_.designs.begin(), std::move(design_));
    rig_.keep_design = true;
    return std::move(notes_);
  }

 private:
  Status read_flags() {
    const struct {
      const char* flag;
      LampFunction function;
      const std::vector<std::string>& texts;
    } all[] = {{"--lamp", LampFunction::kLow, flags_.low},
               {"--lamp-high", LampFunction::kHigh, flags_.high},
               {"--lamp-fog", LampFunction::kFog, flags_.fog}};
    for (const auto& given : all) {
      if (given.texts.size() > 1)
        return Error{given.flag, "given twice; a pair from two files is left=FILE,right=FILE"};
      for (const std::string& text : given.texts) {
        auto choice = parse_lamp_choice(given.flag, given.function, text);
        if (!choice) return choice.error();
        choices_.push_back(std::move(*choice));
      }
    }
    auto aim = parse_aim(flags_.aim.empty() ? "cut-off" : flags_.aim);
    if (!aim) return aim.error();
    aim_ = *aim;
    // One file for two functions is a slip, unless it holds both.
    std::map<std::tuple<fs::path, std::size_t, std::size_t>, const LampChoice*> seen;
    for (const LampChoice& choice : choices_) {
      for (const fs::path& file : std::set{choice.left, choice.right}) {
        const auto [at, fresh] = seen.try_emplace({file, choice.source.lamp_set, choice.source.emitter}, &choice);
        if (!fresh)
          return Error{choice.flag + " " + choice.text,
                       fmt::format("{} is given twice: it is the {} already", file.filename().string(),
                                   beam_name(at->second->function))};
      }
    }
    return Done{};
  }

  /// The rig's first design, with its adjusters where they stand.
  Status read_rigs_own() {
    own_ = rig_.designs.front();
    for (const LampConfig& lamp : own_.lamps) {
      for (const SourceConfig& source : lamp.sources) {
        if (const Status read = tables_.add(source); !read) return read.error();
      }
    }
    for (LampConfig& lamp : own_.lamps)
      if (lamp.aim.kind != AimConfig::Kind::kAsFiled) aim_lamp(lamp, tables_);
    return Done{};
  }

  Result<Place> place_for(const LampChoice& choice) const {
    std::optional<Place> place = place_of(own_, choice.function);
    if (!place && choice.function == LampFunction::kLow) place = place_of(own_, LampFunction::kHigh);
    if (!place && choice.function == LampFunction::kHigh) place = place_of(own_, LampFunction::kLow);
    if (!place && !(choice.x_m && choice.y_m && choice.z_m)) {
      return Error{choice.flag + " " + choice.text,
                   fmt::format("the rig's first design (\"{}\") has no {}: say where it sits, x=…,y=…,z=… in m",
                               own_.name, beam_name(choice.function))};
    }
    if (!place) place = Place{choice.function == LampFunction::kFog ? "fog" : "headlamp", {}, true};
    if (choice.x_m) place->left_m.x = *choice.x_m;
    if (choice.y_m) place->left_m.y = *choice.y_m, place->pair = *choice.y_m != 0.0;
    if (choice.z_m) place->left_m.z = *choice.z_m;
    if (place->left_m.y < 0.0) return Error{choice.flag + " " + choice.text, "a pair is given by its left lamp, y > 0"};
    if (!place->pair && choice.two_files)
      return Error{choice.flag + " " + choice.text, "left and right need two places, and here is one in the middle"};
    if (!(place->left_m.z > 0.0)) return Error{choice.flag + " " + choice.text, "a lamp sits above the road, z > 0"};
    return *place;
  }

  /// The sources of a choice, in the lamps of their place.
  Status mount(const LampChoice& choice) {
    const auto place = place_for(choice);
    if (!place) return place.error();
    LampConfig left;
    left.name = place->name + (place->pair ? " left" : "");
    left.position_m = place->left_m;
    left.sources = {choice.source};
    left.sources.front().function = choice.function;
    LampConfig right = lamp_across(left);
    right.name = place->name + " right";
    left.sources.front().file = choice.left;
    right.sources.front().file = choice.right;
    for (LampConfig* lamp : {&left, &right}) {
      if (lamp == &right && !place->pair) continue;
      const SourceConfig& source = lamp->sources.front();
      if (const Status read = tables_.add(source); !read) return read.error();
      if (!lights_ahead(source, tables_.of(source))) {
        return Error{source.file.string(),
                     fmt::format("sends no light ahead: all of it lies further than 60° to the sides, below 45° down "
                                 "or above 20° up{}",
                                 tables_.of(source).type == PhotometricType::kC
                                     ? fmt::format("; it is type C and {} was taken as ahead (axis=gamma0|gamma90)",
                                                   axis_words(source.axis))
                                     : "")};
      }
      add_to_lamp(*lamp);
    }
    explain_axis(choice);
    return Done{};
  }

  void add_to_lamp(const LampConfig& lamp) {
    const auto there = std::ranges::find_if(design_.lamps, [&](const LampConfig& other) {
      return other.position_m == lamp.position_m && other.name == lamp.name;
    });
    if (there != design_.lamps.end())
      there->sources.push_back(lamp.sources.front());
    else
      design_.lamps.push_back(lamp);
  }

  static const char* axis_words(GammaAxis axis) {
    return axis == GammaAxis::kGamma0 ? "its gamma 0" : "its C 0, gamma 90";
  }

  /// Type C leaves open where ahead is: street lamps have gamma 0 downwards.
  void explain_axis(const LampChoice& choice) {
    SourceConfig source = choice.source;
    source.file = choice.left;
    const IntensityTable& table = tables_.of(source);
    if (table.type != PhotometricType::kC || choice.axis_given) return;
    const glm::dvec3 peak = table.direction_of(table.peak_at());
    const double off_deg = std::acos(std::clamp(peak.x, -1.0, 1.0)) / kRadPerDegree;
    notes_.lines.push_back(
        fmt::format("{}: type C: {} is taken as straight ahead (axis=gamma0), its peak lies {:.0f}° off that; of a "
                    "luminaire that hangs, as in the street, this throws what it sends downwards ahead; axis=gamma90 "
                    "takes C 0, gamma 90 as ahead",
                    choice.left.filename().string(), axis_words(source.axis), off_deg));
  }

  void aim() {
    for (LampConfig& lamp : design_.lamps) {
      const bool cutoff_beam = has_function(lamp, LampFunction::kLow) || has_function(lamp, LampFunction::kFog);
      const bool pitched = std::ranges::any_of(choices_, [&](const LampChoice& choice) {
        return choice.pitch_given && has_function(lamp, choice.function);
      });
      lamp.aim = aim_;
      if (aim_.kind == AimConfig::Kind::kCutoff && (!cutoff_beam || (pitched && flags_.aim.empty()))) lamp.aim = {};
    }
  }

  /// The functions that were not given, from the rig.
  void add_others() {
    std::set<LampFunction> given;
    for (const LampChoice& choice : choices_) given.insert(choice.function);
    std::set<LampFunction> taken;
    for (LampConfig lamp : own_.lamps) {
      std::erase_if(lamp.sources, [&](const SourceConfig& source) { return given.contains(source.function); });
      if (lamp.sources.empty()) continue;
      for (const SourceConfig& source : lamp.sources) taken.insert(source.function);
      if (flags_.others == "none") continue;
      // Its adjuster is another than that of a new lamp in the same place.
      const auto same = [&](const LampConfig& other) { return other.name == lamp.name; };
      if (std::ranges::any_of(design_.lamps, same)) {
        const Place place = *place_of({"", {lamp}}, lamp.sources.front().function);
        const std::string side = lamp.name.substr(place.name.size());
        lamp.name = fmt::format("{} {}{}", place.name,
                                kLampFunctionNames[static_cast<std::size_t>(lamp.sources.front().function)], side);
      }
      design_.lamps.push_back(std::move(lamp));
    }
    for (const LampFunction function : taken) others_ += (others_.empty() ? "" : ", ") + beam_name(function);
  }

  void name_it() {
    const LampChoice& first = choices_.front();
    std::string name = first.left.stem().string();
    if (first.left != first.right) name += " + " + first.right.stem().string();
    const auto taken = [&](const std::string& wanted) {
      return std::ranges::any_of(rig_.designs, [&](const DesignConfig& d) { return d.name == wanted; });
    };
    design_.name = name;
    for (int number = 2; taken(design_.name); ++number) design_.name = fmt::format("{} ({})", name, number);
  }

  void tell() {
    std::string what;
    for (const LampChoice& choice : choices_) {
      what += (what.empty() ? "" : ", ") + beam_name(choice.function) + " " + choice.left.filename().string();
      if (choice.two_files) what += " (left) and " + choice.right.filename().string() + " (right)";
    }
    std::string own;
    if (!others_.empty())
      own = flags_.others == "none" ? "; no " + others_ : fmt::format("; {}: the rig's own ({})", others_, own_.name);
    notes_.lines.insert(notes_.lines.begin(), fmt::format("design \"{}\": {}{}", design_.name, what, own));
    // Left and right mostly say the same.
    std::vector<std::pair<std::string, std::string>> said;  // text, lamps
    for (const LampConfig& lamp : design_.lamps) {
      const bool chosen = std::ranges::any_of(lamp.sources, [&](const SourceConfig& source) {
        return std::ranges::any_of(choices_, [&](const LampChoice& c) {
          return c.function == source.function && (c.left == source.file || c.right == source.file);
        });
      });
      if (!chosen) continue;
      LampConfig copy = lamp;
      const LampAiming aiming = aim_lamp(copy, tables_);
      std::string text = aiming.text();
      const bool no_cutoff_beam = !has_function(lamp, LampFunction::kLow) && !has_function(lamp, LampFunction::kFog);
      if (no_cutoff_beam && lamp.aim.kind == AimConfig::Kind::kAsFiled)
        text = "aimed as filed: a driving beam has no cut-off to aim by";
      else if (lamp.aim.kind == AimConfig::Kind::kAsFiled && aim_.kind == AimConfig::Kind::kCutoff)
        text = "aimed by its pitch_deg";
      if (lamp.aim.kind == AimConfig::Kind::kCutoff && aiming.found && has_function(lamp, LampFunction::kLow) &&
          has_function(lamp, LampFunction::kHigh))
        text += "; the high beam turns with it, one adjuster";
      if (lamp.aim.kind == AimConfig::Kind::kCutoff && !aiming.found && has_function(lamp, LampFunction::kLow))
        text += "; if it is a driving beam, give it as --lamp-high";
      const auto at = std::ranges::find_if(said, [&](const auto& line) { return line.first == text; });
      if (at == said.end())
        said.emplace_back(text, lamp.name);
      else
        at->second += ", " + lamp.name;
    }
    for (const auto& [text, lamps] : said) notes_.lines.push_back(lamps + ": " + text);
    std::vector<DesignConfig> as_it_stands{design_};
    aim_lamps(as_it_stands, tables_);
    for (const SourceEnd& end : table_ends(as_it_stands, tables_, rig_.channels)) notes_.lines.push_back(end.text());
    for (const LampChoice& choice : choices_) {
      SourceConfig source = choice.source;
      for (const fs::path& file : std::set{choice.left, choice.right}) {
        source.file = file;
        for (const Finding& finding : lint_lamp(tables_.of(source)).findings) {
          if (finding.grade == Grade::kError) notes_.warnings.push_back(file.filename().string() + ": " + finding.text);
        }
      }
    }
  }

  Rig& rig_;
  const LampFlags& flags_;
  std::vector<LampChoice> choices_;
  AimConfig aim_;
  DesignConfig own_, design_;
  std::string others_;
  LampTables tables_;
  LampDesignNotes notes_;
};

}  // namespace

const char* const kLampFlagsHelp =
    "A lamp of one's own is FILE[,KEY=VALUE…] for a pair from one file, or left=FILE,right=FILE[,KEY=VALUE…]. It sits "
    "where "
    "the rig's first design has that lamp; x, y (of the left one), z in m say another place. Further keys: pitch_deg, "
    "yaw_deg, roll_deg, scale, mirror=1, colour_temperature_k or spectrum (a CSV file); type C and EULUMDAT: "
    "axis=gamma0|gamma90, c0_deg; "
    "lamp_set, "
    "emitter; distance_m. A file name may hold commas; one that holds \",word=\" stands in double quotes, a quote in "
    "it "
    "doubled: --lamp '\"a,x=1.ies\",z=0.7'";

void add_lamp_flags(CLI::App* command, LampFlags& flags) {
  command
      ->add_option("--lamp", flags.low,
                   "Low beam of a lamp of one's own: FILE[,KEY=VALUE…] or left=FILE,right=FILE (see below)")
      ->allow_extra_args(false);
  command->add_option("--lamp-high", flags.high, "High beam of one's own, in the same words")->allow_extra_args(false);
  command->add_option("--lamp-fog", flags.fog, "Fog lamp of one's own, in the same words")->allow_extra_args(false);
  command->add_option("--aim", flags.aim,
                      "How that lamp is aimed: cut-off (on the line of UN R48 for its height), as-filed, or degrees up "
                      "[cut-off; as its pitch_deg says where it has one]");
  command->add_option("--lamp-others", flags.others, "What is not given of the design: the rig's own, or none")
      ->check(CLI::IsMember({"rig", "none"}))
      ->capture_default_str();
}

Result<LampChoice> parse_lamp_choice(const std::string& flag, LampFunction function, const std::string& text) {
  LampChoice choice;
  choice.flag = flag;
  choice.text = text;
  choice.function = function;
  const auto wrong = [&](const std::string& reason) { return Error{flag + " " + text, reason}; };
  std::vector<std::string> words = words_of(text);
  std::optional<std::string> sides[2];
  bool kelvin_given = false;
  std::string rest;
  const bool file_first = !words.front().starts_with("left=") && !words.front().starts_with("right=");
  std::string file = file_first ? words.front() : "";
  for (std::size_t i = file_first ? 1 : 0; i < words.size(); ++i) {
    const std::size_t equals = words[i].find('=');
    const std::string key = words[i].substr(0, equals), value = words[i].substr(equals + 1);
    if (key == "left" || key == "right") {
      auto& side = sides[key == "right" ? 1 : 0];
      if (side) return wrong("\"" + key + "\" is given twice");
      side = value;
      continue;
    }
    if (key == "colour_temperature_k") {
      const auto kelvin = number_of(value);
      if (!kelvin || *kelvin < kCoolestSource_k || *kelvin > kHottestSource_k)
        return wrong("\"colour_temperature_k\": expected 1667 to 25000, got \"" + value + "\"");
      choice.source.colour_temperature_k = *kelvin;
      kelvin_given = true;
      continue;
    }
    if (key == "spectrum") {
      choice.source.spectrum = fs::absolute(value).lexically_normal();
      const auto xy = read_spectrum_xy(choice.source.spectrum);
      if (!xy) return xy.error();
      choice.source.chromaticity_xy = *xy;
      continue;
    }
    if (key == "x" || key == "y" || key == "z") {
      auto& of_key = key == "x" ? choice.x_m : key == "y" ? choice.y_m : choice.z_m;
      if (of_key) return wrong("\"" + key + "\" is given twice");
      of_key = number_of(value);
      if (!of_key) return wrong("\"" + key + "\": expected a finite number, got \"" + value + "\"");
      continue;
    }
    choice.pitch_given = choice.pitch_given || key == "pitch_deg";
    choice.axis_given = choice.axis_given || key == "axis";
    rest += "," + words[i];
  }
  if (file_first && (sides[0] || sides[1])) return wrong("a file for both sides, or left= and right=, not both");
  if (!file_first && !sides[0]) return wrong("right= without left=");
  if (!file_first && !sides[1]) return wrong("left= without right=; one file for both sides is FILE alone");
  // The keys are those of `phare measure --lamp`, read by the same reader.
  auto parsed = parse_lamp_argument("lamp,x=0,y=0,z=0" + rest, {"colour_temperature_k", "spectrum"});
  if (!parsed) return wrong(parsed.error().reason);
  if (kelvin_given && choice.source.chromaticity_xy) return wrong("a spectrum or a colour_temperature_k, not both");
  const SourceConfig coloured = choice.source;
  choice.source = parsed->sources.front();
  choice.source.colour_temperature_k = coloured.colour_temperature_k;
  choice.source.chromaticity_xy = coloured.chromaticity_xy;
  choice.source.spectrum = coloured.spectrum;
  choice.source.file.clear();
  choice.two_files = !file_first;
  for (int side = 0; side < 2; ++side) {
    const auto name = unquoted(file_first ? file : *sides[side]);
    if (!name) return wrong("a file name in double quotes ends with a quote, and a comma or nothing follows");
    if (name->empty()) return wrong("expected a photometry file");
    (side == 0 ? choice.left : choice.right) = fs::absolute(*name).lexically_normal();
  }
  for (const fs::path& path : {choice.left, choice.right}) {
    if (const std::string why = why_no_file(path); !why.empty())
      return wrong(path.string() + ": " + why + "; a photometry file is expected");
  }
  if (choice.two_files && choice.left == choice.right)
    return wrong("the same file is given twice; one file for both sides is FILE alone");
  return choice;
}

Result<AimConfig> parse_aim(const std::string& text) {
  if (text == "as-filed") return AimConfig{};
  if (text == "cut-off") return AimConfig{AimConfig::Kind::kCutoff, 0.0};
  const auto up_deg = number_of(text);
  if (!up_deg || std::abs(*up_deg) > 90.0)
    return Error{"--aim " + text, "expected as-filed, cut-off, or degrees up (-90 to 90)"};
  return AimConfig{AimConfig::Kind::kTurned, *up_deg * kRadPerDegree};
}

Status nothing_of_a_lamp(const LampFlags& flags) {
  const std::string remedy = "give --lamp, --lamp-high or --lamp-fog";
  if (!flags.aim.empty()) return Error{"--aim " + flags.aim, "aims a lamp of one's own: " + remedy};
  if (flags.others == "none") return Error{"--lamp-others none", "is about lamps beside one's own: " + remedy};
  return Done{};
}

Result<LampDesignNotes> put_lamp_design(Rig& rig, const LampFlags& flags) {
  return DesignMaker(rig, flags).make();
}

Result<LampDesignNotes> aim_notes(const Rig& rig) {
  LampDesignNotes notes;
  LampTables tables;
  std::vector<DesignConfig> designs = rig.designs;
  for (DesignConfig& design : designs)
    std::erase_if(design.lamps, [](const LampConfig& lamp) { return lamp.aim.kind == AimConfig::Kind::kAsFiled; });
  for (const DesignConfig& design : designs) {
    for (const LampConfig& lamp : design.lamps) {
      for (const SourceConfig& source : lamp.sources) {
        if (const Status read = tables.add(source); !read) return read.error();
      }
    }
  }
  std::vector<std::pair<std::string, std::string>> said;
  for (const LampAiming& aiming : aim_lamps(designs, tables)) {
    const std::string text = aiming.text();
    if (!said.empty() && said.back().second == text)
      said.back().first += ", " + aiming.lamp;
    else
      said.emplace_back("design \"" + aiming.design + "\", " + aiming.lamp, text);
  }
  for (const auto& [who, text] : said) notes.lines.push_back(who + ": " + text);
  return notes;
}

bool lights_ahead(const SourceConfig& source, const IntensityTable& table) {
  const glm::dmat3 turn = aim_rotation(source.yaw_rad, source.pitch_rad, source.roll_rad);
  for (std::size_t j = 0; j < table.second_deg.size(); ++j) {
    for (std::size_t i = 0; i < table.first_deg.size(); ++i) {
      if (table.candela[j * table.first_deg.size() + i] <= 0.0) continue;
      const glm::dvec3 d = turn * table.direction_of({table.first_deg[i], table.second_deg[j]});
      const TableAngles hv = table_angles(PhotometricType::kA, GammaAxis::kGamma0, d);
      if (std::abs(hv.first_deg) <= 60.0 && hv.second_deg >= -45.0 && hv.second_deg <= 20.0) return true;
    }
  }
  for (double v = -45.0; v <= 20.0; v += 1.0) {  // a coarse table may have no node there
    for (double h = -60.0; h <= 60.0; h += 1.0) {
      if (table.intensity_cd(direction_hv(h, v) * turn) > 0.0) return true;
    }
  }
  return false;
}

}  // namespace phare
