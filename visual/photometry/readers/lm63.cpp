// Reader of IES LM-63 photometry files, editions 1986 to 2019, types A, B, C.
// Liberal in layout (any line breaks, commas or blanks, any case), strict in numbers: what it cannot mean is refused
// with file:line. What it repaired is in IntensityTable::notes. The whole table comes out unfolded: H on both sides, C
// 0..360. Field 12 is a factor in 1986 and 1991 alone ("ballast-lamp photometric factor"); 1995 and 2002 reserve it
// ("future use"), 2019 codes there how the file was made.
#include <algorithm>
#include <cmath>

#include "visual/photometry/readers/file_text.h"
#include "visual/photometry/readers/grid_build.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

/// Edition of the file from its first line.
struct Edition {
  std::string version;
  int year = 1986;
};

Edition edition_of(std::string_view first_line) {
  const std::string line = upper_case(first_line);
  if (line.starts_with("IESNA91")) return {"IESNA91", 1991};
  for (const std::string_view mark : {"IESNA:LM-63-", "IES:LM-63-"}) {
    if (!line.starts_with(mark)) continue;
    const auto year = parse_number(std::string_view(line).substr(mark.size(), 4));
    return {std::string(first_line.substr(0, 32)), year ? static_cast<int>(*year) : 2002};
  }
  return {"LM-63-1986", 1986};  // that edition has no such line
}

/// LM-63-19 table of file generation types: 1.abcde, each digit a flag.
std::string generation_text(double code) {
  if (code == 1.00001) return "undefined or older file";
  if (code == 1.0001) return "computer simulation";
  const int digits = static_cast<int>(std::lround((code - 1.0) * 1e5));
  if (code < 1.0 || code > 1.2 || std::abs((code - 1.0) * 1e5 - digits) > 1e-3) return "unknown code";
  std::string text =
      digits / 10000 % 10 == 1 ? "test at an accredited laboratory" : "test at an unaccredited laboratory";
  if (digits / 1000 % 10 == 1) text += ", interpolated angles";
  if (digits / 100 % 10 == 1) text += ", lumens scaled";
  if (digits / 10 % 10 == 1) text += ", computer simulation";
  if (digits % 10 == 1) text += ", undefined";
  return text;
}

struct Counts {
  std::size_t second = 0;  // vertical angles, or gamma
  std::size_t first = 0;   // horizontal angles, or C
  double scale = 1.0;
};

Result<std::size_t> read_count(FileText& text, const char* what) {
  const auto value = text.number(what);
  if (!value) return value.error();
  // A table of n values takes at least 2n - 1 characters, so no count can reach the size of the file.
  if (*value < 1.0 || *value != std::floor(*value) || *value > static_cast<double>(text.size())) {
    return text.error(std::string(what) + " cannot be " + number_text(*value) + " in a file of " +
                      std::to_string(text.size()) + " bytes");
  }
  return static_cast<std::size_t>(*value);
}

/// A table of light output over tilt. Headlamp photometry is as mounted (tilt 0), so the factors are not used.
Status skip_tilt_table(FileText& text, std::vector<std::string>& notes) {
  if (const auto geometry = text.number("the lamp-to-luminaire geometry"); !geometry) return geometry.error();
  const auto count = read_count(text, "the number of tilt angles");
  if (!count) return count.error();
  for (std::size_t i = 0; i < *count; ++i) {
    if (const auto angle = text.number("a tilt angle"); !angle) return angle.error();
  }
  bool all_one = true;
  for (std::size_t i = 0; i < *count; ++i) {
    const auto factor = text.number("a tilt factor");
    if (!factor) return factor.error();
    all_one = all_one && *factor == 1.0;
  }
  if (!all_one)
    notes.push_back(text.place() + ": tilt factors are not applied: the photometry is of the lamp as mounted");
  return Done{};
}

/// TILT=name: looked for beside the lamp's file, checked, and like an included table not used.
Status check_tilt_file(const FileText& text, std::string_view named, const LampReadSettings& settings,
                       std::vector<std::string>& notes) {
  const std::filesystem::path name = std::filesystem::path(std::string(named)).filename();
  const std::filesystem::path file = settings.folder / name;
  std::error_code code;
  if (name.empty() || settings.folder.empty() || !std::filesystem::is_regular_file(file, code)) {
    notes.push_back(
        text.place() + ": TILT=" + in_quotes(named) +
        " is not beside this file; its factors would not be applied: the photometry is of the lamp as mounted");
    return Done{};
  }
  const auto bytes = read_photometry_bytes(file, file.string());
  if (!bytes) return bytes.error();
  FileText tilt(*bytes, file.string());
  return skip_tilt_table(tilt, notes);
}

Result<Counts> read_header(FileText& text, const Edition& edition, IntensityTable& table) {
  LampHeader& header = table.header;
  Counts counts;
  const auto lamps = text.number("the number of lamps");
  if (!lamps) return lamps.error();
  const std::size_t first_line = text.line();
  const auto lumens = text.number("the lumens per lamp");
  if (!lumens) return lumens.error();
  const auto multiplier = text.number("the candela multiplier");
  if (!multiplier) return multiplier.error();
  if (*multiplier <= 0.0) return text.error("the candela multiplier is " + number_text(*multiplier) + ", not above 0");
  const auto second_count = read_count(text, "the number of vertical angles");
  if (!second_count) return second_count.error();
  const auto first_count = read_count(text, "the number of horizontal angles");
  if (!first_count) return first_count.error();
  // Each value needs a character and a separator; checked before anything of that size is allocated.
  if (*second_count > text.size() / *first_count) {
    return text.error(std::to_string(*first_count) + " × " + std::to_string(*second_count) +
                      " candela cannot be in a file of " + std::to_string(text.size()) + " bytes");
  }
  const auto type = text.number("the photometric type");
  if (!type) return type.error();
  if (*type != 1.0 && *type != 2.0 && *type != 3.0) {
    return text.error("the photometric type is " + number_text(*type) + ", not 1 (C), 2 (B) or 3 (A)");
  }
  const auto units = text.number("the units type");  // feet or metres: of the luminaire's size, candela do not care
  if (!units) return units.error();
  header.units = *units == 1.0 ? "feet" : *units == 2.0 ? "metres" : "unknown";
  if (*units != 1.0 && *units != 2.0)
    table.notes.push_back(text.place() + ": units type " + number_text(*units) +
                          " is neither feet (1) nor metres (2); unused");
  const double to_m = *units == 1.0 ? 0.3048 : 1.0;
  for (const auto& [what, size_m] : {std::pair{"the luminaire's width", &header.width_m},
                                     {"the luminaire's length", &header.length_m},
                                     {"the luminaire's height", &header.height_m}}) {
    const auto size = text.number(what);
    if (!size) return size.error();
    *size_m = *size * to_m;
  }
  if (text.line() != first_line) {
    table.notes.push_back(text.place() + ": the ten values that begin on line " + std::to_string(first_line) +
                          " belong on one line; read on");
  }
  const auto ballast = text.number("the ballast factor");
  if (!ballast) return ballast.error();
  if (*ballast <= 0.0) return text.error("the ballast factor is " + number_text(*ballast) + ", not above 0");
  double factor = 1.0;
  const auto field_12 = text.number("field 12 (ballast-lamp factor or file generation type)");
  if (!field_12) return field_12.error();
  if (edition.year < 1995) {
    if (*field_12 < 0.0) return text.error("the ballast-lamp photometric factor is " + number_text(*field_12));
    if (*field_12 == 0.0) {
      table.notes.push_back(text.place() + ": ballast-lamp photometric factor 0 taken as 1");
    } else {
      factor = *field_12;
    }
  } else if (edition.year < 2019 && *field_12 != 1.0) {
    table.notes.push_back(text.place() + ": field 12 is " + number_text(*field_12) +
                          ", reserved in this edition; not applied");
  }
  const auto watts = text.number("the input watts");
  if (!watts) return watts.error();

  counts.second = *second_count;
  counts.first = *first_count;
  counts.scale = *multiplier * *ballast * factor;
  table.type = static_cast<PhotometricType>(static_cast<int>(*type));
  header.lamp_count = *lamps;
  header.absolute = *lumens < 0.0;
  header.stated_flux_lm = *lumens > 0.0 && *lamps > 0.0 ? *lumens * *lamps : 0.0;
  header.multiplier = *multiplier;
  header.ballast_factor = *ballast;
  header.field_12 = *field_12;
  header.field_12_applied = edition.year < 1995;
  if (edition.year >= 2019) header.generation = generation_text(*field_12);
  header.input_w = *watts;
  return counts;
}

/// Strictly ascending angles within [min, max].
Result<std::vector<double>> read_angles(FileText& text, std::size_t count, const std::string& what, double min_deg,
                                        double max_deg) {
  std::vector<double> angles;
  angles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    double angle = 0.0;
    if (!text.number(angle)) return text.why(what + " angle " + std::to_string(i + 1) + " of " + std::to_string(count));
    if (angle < min_deg || angle > max_deg) {
      return text.error(what + " angle " + number_text(angle) + " is outside " + number_text(min_deg) + " to " +
                        number_text(max_deg));
    }
    if (!angles.empty() && angle <= angles.back()) {
      return text.error(what + " angles must increase, but " + number_text(angle) + " follows " +
                        number_text(angles.back()));
    }
    angles.push_back(angle);
  }
  return angles;
}

/// "[KEY] value" into the header; [MORE] goes on with the last.
void read_keyword(std::string_view line, LampHeader& header) {
  constexpr std::size_t kMaxKeywords = 1000;
  if (!line.starts_with('[') || header.keywords.size() >= kMaxKeywords) return;
  const std::size_t end = line.find(']');
  if (end == std::string_view::npos) return;
  const std::string key = upper_case(line.substr(1, end - 1));
  const std::string value(trimmed(line.substr(end + 1)));
  if (key == "MORE" && !header.keywords.empty()) {
    header.keywords.back().second += " " + value;
  } else {
    header.keywords.emplace_back(key, value);
  }
}

bool holds_digits_about_a_comma(std::string_view text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t at = 1; at + 1 < text.size(); ++at)
    if (text[at] == ',' && digit(text[at - 1]) && digit(text[at + 1])) return true;
  return false;
}

}  // namespace

Result<IntensityTable> parse_lm63(std::string_view bytes, const std::string& name, const LampReadSettings& settings) {
  IntensityTable table;
  table.name = name;
  table.axis = settings.axis;
  table.header.format = "LM-63";
  FileText text(bytes, name);

  // Free text and keywords up to the TILT line.
  std::optional<Edition> edition;
  while (true) {
    const auto line = text.next_line();
    if (!line) return text.error("no TILT= line: not an LM-63 file, or cut off");
    if (!edition) edition = edition_of(*line);
    read_keyword(*line, table.header);
    const std::string capitals = upper_case(*line);
    if (!capitals.starts_with("TILT")) continue;
    const std::size_t equals = capitals.find_first_not_of(" \t", 4);
    if (equals == std::string::npos || capitals[equals] != '=') continue;
    table.header.tilt = trimmed(line->substr(equals + 1));
    break;
  }
  table.version = edition->version;
  const std::string tilt = upper_case(table.header.tilt);
  if (tilt == "INCLUDE") {
    if (const auto skipped = skip_tilt_table(text, table.notes); !skipped) return skipped.error();
  } else if (tilt.empty()) {
    return text.error("TILT= names nothing; expected NONE, INCLUDE or a file");
  } else if (tilt != "NONE") {
    if (const auto checked = check_tilt_file(text, table.header.tilt, settings, table.notes); !checked)
      return checked.error();
  }

  const std::size_t numbers_at = bytes.size() - text.rest().size();
  const auto counts = read_header(text, *edition, table);
  if (!counts) return counts.error();
  const bool is_c = table.type == PhotometricType::kC;
  const double second_max = table.type == PhotometricType::kB ? 180.0 : is_c ? 180.0 : 90.0;
  const double first_max = table.type == PhotometricType::kB ? 90.0 : is_c ? 360.0 : 180.0;
  auto second = read_angles(text, counts->second, is_c ? "gamma" : "vertical", is_c ? 0.0 : -second_max, second_max);
  if (!second) return second.error();
  if (second->size() < 2) return text.error("one vertical angle (" + number_text(second->front()) + ") is no beam");
  const auto first = read_angles(text, counts->first, is_c ? "C" : "horizontal", is_c ? 0.0 : -first_max, first_max);
  if (!first) return first.error();
  auto unfolded = unfold_lm63(*first, table.type);
  if (!unfolded) return text.error(unfolded.error().reason);
  table.header.symmetry = unfolded->symmetry;
  if (!unfolded->note.empty()) table.notes.push_back(text.place() + ": " + unfolded->note);

  // The file stores one horizontal angle after the other.
  std::vector<double> planes;
  const std::size_t count = first->size() * second->size();
  planes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    double value = 0.0;
    if (!text.number(value)) {
      const Error why = text.why("a candela value");
      return Error{why.place, why.reason + " (value " + std::to_string(i + 1) + " of " + std::to_string(count) + ")"};
    }
    if (value < 0.0) return text.error("negative candela " + number_text(value));
    planes.push_back(value * counts->scale);
    if (!std::isfinite(planes.back())) return text.error("candela times the factors of the header is no finite number");
    if (value != 0.0 && (i < 1000 || i % 61 == 0)) {  // enough to see how many digits the file was written with
      const double step = last_digit(text.word()) * counts->scale;
      double& smallest = table.header.smallest_step_cd;
      smallest = smallest == 0.0 ? step : std::min(smallest, step);
    }
  }
  const std::string_view values = bytes.substr(0, bytes.size() - text.rest().size());
  if (!text.next_word().empty()) {
    const std::string where = text.place();
    std::size_t extra = 1;
    while (!text.next_word().empty()) ++extra;
    if (holds_digits_about_a_comma(values.substr(numbers_at)))
      return Error{where, std::to_string(extra) + " words more than the " + std::to_string(count) +
                              " candela values, and commas stand between digits: a comma separates numbers here, "
                              "decimals are written with a point"};
    table.notes.push_back(where + ": " + std::to_string(extra) + " word(s) after the last candela value ignored");
  }
  fill_table(table, unfolded->columns, std::move(*second), planes);
  if (is_c) turn_about_axis(table, settings.c0_turn_deg);
  return table;
}

}  // namespace phare
