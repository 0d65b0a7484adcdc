#include "visual/photometry/readers/write_lamp.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <utility>

#include "visual/photometry/readers/file_text.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

/// Numbers on lines of at most 120 characters; every call begins a new line.
template <typename At>
void append_numbers(std::string& text, std::size_t count, const At& at) {
  std::size_t column = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string word = number_text(at(i));
    if (column > 0 && column + 1 + word.size() > 120) {
      text += '\n';
      column = 0;
    }
    if (column > 0) {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
  }
  text += '\n';
}

/// One line, printable, at most 250 bytes (LM-63-19 §5.2 allows 256 in a line).
std::string keyword_line(const std::string& text) {
  std::string line;
  for (const char c : text.substr(0, 250)) line += static_cast<unsigned char>(c) >= 0x20 ? c : ' ';
  return line;
}

std::string keyword(const IntensityTable& table, const std::string& key, const std::string& fallback) {
  for (const auto& [k, value] : table.header.keywords) {
    if (k == key) return value;
  }
  return fallback;
}

/// Millimetres, feet: what a unit's conversion added in the last digits is left off.
std::string size_text(double value) {
  return number_text(std::round(value * 1e9) * 1e-9 + 0.0);
}

/// The same table in type C with its axis at gamma 90: C = -H, gamma = 90 + V. Bilinear in the same angles, so exact.
IntensityTable type_a_as_gamma90(const IntensityTable& a) {
  constexpr double kLimitStep_deg = 0.01;  // beside a lit limit the table ends in the dark, as in combine.cpp
  IntensityTable c = a;
  c.type = PhotometricType::kC;
  c.axis = GammaAxis::kGamma90;
  const auto tidy = [](double deg) { return std::round(deg * 1e9) * 1e-9; };
  for (double& v : c.second_deg) v = tidy(v + 90.0);
  std::vector<std::pair<double, double>> columns;  // C and the H it is read at; H beyond the limits: dark
  const auto add = [&](double h) { columns.emplace_back(tidy(h > 0.0 ? 360.0 - h : -h) + 0.0, h); };
  for (const double h : a.first_deg) add(h);
  if (a.first_deg.front() < 0.0 && a.first_deg.back() > 0.0) add(0.0);
  if (a.first_deg.front() > -180.0 + kLimitStep_deg) add(a.first_deg.front() - kLimitStep_deg);
  if (a.first_deg.back() < 180.0 - kLimitStep_deg) add(a.first_deg.back() + kLimitStep_deg);
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end(),
                            [](const auto& x, const auto& y) { return y.first - x.first < 1e-9; }),
                columns.end());
  if (columns.front().first > 0.0) columns.insert(columns.begin(), {0.0, 0.0});
  columns.emplace_back(360.0, columns.front().second);
  c.first_deg.clear();
  c.candela.clear();
  for (const auto& column : columns) c.first_deg.push_back(column.first);
  for (const double v : a.second_deg) {
    for (const auto& column : columns) c.candela.push_back(a.intensity_at_cd({column.second, v}));
  }
  return c;
}

/// The text of a number that was computed to and fro: without the noise of its last digits.
std::string tidy_text(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.14g", value);
  return buffer;
}

/// Lux over y (left) and z (up) in m.
std::string screen_csv(const IntensityTable& table) {
  const double d = table.screen_distance_m;
  const auto metres = [d](double deg) { return d * std::tan(deg * std::numbers::pi / 180.0); };
  std::string text = "# title: " + keyword_line(table.name) +
                     "\n# quantity: illuminance on a flat screen perpendicular to the lamp axis\n# unit: lx\n"
                     "# distance_m: " +
                     tidy_text(d) + "\nz\\y";
  const std::size_t columns = table.first_deg.size();
  for (std::size_t i = columns; i-- > 0;) text += "," + tidy_text(-metres(table.first_deg[i]) + 0.0);  // y ascending
  text += '\n';
  for (std::size_t j = 0; j < table.second_deg.size(); ++j) {
    const double z = metres(table.second_deg[j]);
    text += tidy_text(z + 0.0);
    for (std::size_t i = columns; i-- > 0;) {
      const double y = metres(table.first_deg[i]), r2 = d * d + y * y + z * z;
      text += "," + tidy_text(table.candela[j * columns + i] / (r2 * std::sqrt(r2) / d));
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string lm63_text(const IntensityTable& given, const std::string& generation) {
  IntensityTable on_grid;
  const IntensityTable* table = &given;
  if (given.screen_distance_m > 0.0) {
    std::vector<double> h, v;
    type_a_grid(given, h, v);
    on_grid = resample(given, PhotometricType::kA, GammaAxis::kGamma0, h, v);
    table = &on_grid;
  }
  std::string text = "IES:LM-63-2019\n";
  // Required keywords first, then the others in their order (LM-63-19 §5.2).
  for (const char* key : {"TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"})
    text += "[" + std::string(key) + "] " + keyword_line(keyword(given, key, "unknown")) + "\n";
  for (const auto& [key, value] : given.header.keywords) {
    if (key == "TEST" || key == "TESTLAB" || key == "ISSUEDATE" || key == "MANUFAC") continue;
    for (std::size_t begin = 0; begin == 0 || begin < value.size(); begin += 200)
      text += (begin == 0 ? "[" + key.substr(0, 40) + "] " : "[MORE] ") + keyword_line(value.substr(begin, 200)) + "\n";
  }
  const LampHeader& header = given.header;
  const bool relative = !header.absolute && header.stated_flux_lm > 0.0;
  const double lamps = header.lamp_count > 0.0 ? header.lamp_count : 1.0;
  const double unit_m = header.units == "feet" ? 0.3048 : 1.0;
  // EULUMDAT tells a round opening by a width of 0, LM-63 by negative sizes.
  const bool round = header.format == "EULUMDAT" && header.width_m == 0.0 && header.length_m > 0.0;
  text += "TILT=NONE\n" + number_text(lamps) + " " + (relative ? number_text(header.stated_flux_lm / lamps) : "-1") +
          " 1 " + std::to_string(table->second_deg.size()) + " " + std::to_string(table->first_deg.size()) + " " +
          std::to_string(static_cast<int>(table->type)) + (header.units == "feet" ? " 1 " : " 2 ") +
          size_text((round ? -header.length_m : header.width_m) / unit_m) + " " +
          size_text((round ? -header.length_m : header.length_m) / unit_m) + " " + size_text(header.height_m / unit_m) +
          "\n1 " + generation + " " + number_text(header.input_w) + "\n";
  append_numbers(text, table->second_deg.size(), [&](std::size_t j) { return table->second_deg[j]; });
  append_numbers(text, table->first_deg.size(), [&](std::size_t i) { return table->first_deg[i]; });
  const std::size_t columns = table->first_deg.size();
  for (std::size_t i = 0; i < columns; ++i)
    append_numbers(text, table->second_deg.size(), [&](std::size_t j) { return table->candela[j * columns + i]; });
  return text;
}

namespace {

/// How far apart the angles are, of the first `count`; 0: not evenly.
double even_step_deg(std::span<const double> angles) {
  if (angles.size() < 2) return 0.0;
  const double step = angles[1] - angles[0];
  for (std::size_t i = 2; i < angles.size(); ++i)
    if (std::abs(angles[i] - angles[i - 1] - step) > 1e-6) return 0.0;
  return step;
}

/// The share of the flux of a table of type C that goes down, below gamma 90.
double downward_share(const IntensityTable& table) {
  const double whole_lm = table.flux_lm();
  if (table.second_deg.back() <= 90.0 || !(whole_lm > 0.0)) return 1.0;
  if (table.second_deg.front() >= 90.0) return 0.0;
  IntensityTable down = table;
  std::size_t rows = 0;
  while (table.second_deg[rows] < 90.0) ++rows;
  down.second_deg.resize(rows);
  down.candela.resize(rows * table.first_deg.size());
  for (const double c : table.first_deg) down.candela.push_back(table.intensity_at_cd({c, 90.0}));
  down.second_deg.push_back(90.0);
  return down.flux_lm() / whole_lm;
}

}  // namespace

std::string eulumdat_text(const IntensityTable& given, GammaAxis axis) {
  IntensityTable on_grid;
  const IntensityTable* table = &given;
  if (given.type != PhotometricType::kC || given.axis != axis) {
    std::vector<double> first, second;
    if (axis == GammaAxis::kGamma90) {
      type_a_grid(given, first, second);
      const bool is_a = given.type == PhotometricType::kA && given.screen_distance_m <= 0.0;
      on_grid =
          type_a_as_gamma90(is_a ? given : resample(given, PhotometricType::kA, GammaAxis::kGamma0, first, second));
    } else {
      for (int i = 0; i <= 360; ++i) first.push_back(i);
      for (int i = 0; i <= 200; ++i) second.push_back(i * 5 / 100.0);
      for (int i = 1; i <= 40; ++i) second.push_back(10.0 + i * 0.25);
      for (int i = 21; i <= 90; ++i) second.push_back(i);
      on_grid = resample(given, PhotometricType::kC, GammaAxis::kGamma0, first, second);
    }
    table = &on_grid;
  }
  const LampHeader& header = given.header;
  const bool relative = !header.absolute && header.stated_flux_lm > 0.0;
  const double flux_lm = relative ? header.stated_flux_lm : std::max(1.0, std::round(table->flux_lm()));
  const std::size_t columns = table->first_deg.size();
  const std::size_t planes = columns - 1;  // C 360 is C 0
  std::string text;
  const auto line = [&text](const std::string& value) { text += value.substr(0, 78) + "\r\n"; };
  line(keyword(given, "MANUFAC", "unknown"));
  const bool same_all_round = planes == 1;
  line(same_all_round ? "1" : "3");
  line(same_all_round ? "1" : "0");
  line(std::to_string(planes));
  line(number_text(same_all_round ? 0.0 : even_step_deg(table->first_deg)));
  line(std::to_string(table->second_deg.size()));
  line(number_text(even_step_deg(table->second_deg)));
  line(keyword(given, "TEST", "unknown"));
  line(keyword(given, "LUMINAIRE", given.name));
  line(keyword(given, "LUMCAT", given.name));
  line(given.name);
  line(keyword(given, "ISSUEDATE", "unknown"));
  // 13 to 21: luminaire and its opening in mm; a width of 0 is round. Of the luminaire no more is known than its
  // opening.
  const std::string length_mm = size_text(1e3 * std::abs(header.length_m));
  const std::string width_mm = size_text(1e3 * std::max(0.0, header.width_m));
  const std::string height_mm = size_text(1e3 * std::abs(header.height_m));
  for (const std::string& value : {length_mm, width_mm, height_mm, length_mm, width_mm}) line(value);
  for (int i = 0; i < 4; ++i) line(height_mm);  // as seen from C 0, 90, 180 and 270
  line(size_text(100.0 * downward_share(*table)));
  line(relative ? number_text(100.0 * table->flux_lm() / flux_lm) : "100");
  for (const char* value : {"1", "0", "1"}) line(value);
  line(relative ? number_text(header.lamp_count > 0.0 ? header.lamp_count : 1.0) : "-1");
  line(keyword(given, "LAMP", "lamp"));
  line(number_text(flux_lm));
  for (const char* value : {"-", "-"}) line(value);
  line(number_text(header.input_w));
  for (int i = 0; i < 10; ++i) line("0");
  for (std::size_t i = 0; i < planes; ++i) line(number_text(table->first_deg[i]));
  for (const double gamma : table->second_deg) line(number_text(gamma));
  for (std::size_t i = 0; i < planes; ++i) {
    for (std::size_t j = 0; j < table->second_deg.size(); ++j)
      line(number_text(table->candela[j * columns + i] / (flux_lm / 1000.0)));
  }
  return text;
}

std::string csv_text(const IntensityTable& given) {
  if (given.screen_distance_m > 0.0) return screen_csv(given);
  const IntensityTable* const table = &given;
  const bool is_c = table->type == PhotometricType::kC;
  std::string text = "# title: " + keyword_line(given.name) +
                     "\n# quantity: luminous intensity\n# unit: cd\n# angles: type " +
                     (table->type == PhotometricType::kA   ? "A"
                      : table->type == PhotometricType::kB ? "B"
                                                           : "C") +
                     "\n" + (is_c ? "gamma\\C" : "V\\H");
  for (const double first : table->first_deg) text += "," + number_text(first);
  text += '\n';
  const std::size_t columns = table->first_deg.size();
  for (std::size_t j = 0; j < table->second_deg.size(); ++j) {
    text += number_text(table->second_deg[j]);
    for (std::size_t i = 0; i < columns; ++i) text += "," + number_text(table->candela[j * columns + i]);
    text += '\n';
  }
  return text;
}

std::string with_traffic_side(const std::string& text, bool left_hand) {
  const std::string capitals = upper_case(text);
  const auto part_of_word = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t length = 0, swapped_length = 0;
    const char* to = "";
    for (const auto& [from, other] : {std::pair{"RIGHT-HAND TRAFFIC", "LEFT"},
                                      {"RIGHT HAND TRAFFIC", "LEFT"},
                                      {"RHT", "LHT"},
                                      {"LEFT-HAND TRAFFIC", "RIGHT"},
                                      {"LEFT HAND TRAFFIC", "RIGHT"},
                                      {"LHT", "RHT"}}) {
      const std::string_view word = from;
      const bool says_left = word.starts_with('L');
      if (says_left == left_hand || capitals.compare(i, word.size(), word) != 0) continue;
      if (i > 0 && part_of_word(capitals[i - 1])) continue;
      if (i + word.size() < capitals.size() && part_of_word(capitals[i + word.size()])) continue;
      length = word.size();
      swapped_length = length == 3 ? 3 : says_left ? 4 : 5;  // "left" or "right"; the rest of the words stays
      to = other;
    }
    if (length == 0) {
      result += text[i++];
      continue;
    }
    const bool all_capitals = text.compare(i, swapped_length, capitals, i, swapped_length) == 0;
    const bool first_capital = text[i] == capitals[i];
    for (std::size_t k = 0; to[k] != 0; ++k) {
      const bool capital = all_capitals || (k == 0 && first_capital);
      result += capital ? to[k] : static_cast<char>(to[k] - 'A' + 'a');
    }
    result += text.substr(i + swapped_length, length - swapped_length);
    i += length;
  }
  return result;
}

}  // namespace phare
