#include "visual/photometry/write_lamp.h"

#include <algorithm>
#include <cmath>

#include "visual/photometry/combine.h"
#include "visual/photometry/file_text.h"

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
  text += "TILT=NONE\n1 -1 1 " + std::to_string(table->second_deg.size()) + " " +
          std::to_string(table->first_deg.size()) + " " + std::to_string(static_cast<int>(table->type)) +
          " 2 0 0 0\n1 " + generation + " " + number_text(given.header.input_w) + "\n";
  append_numbers(text, table->second_deg.size(), [&](std::size_t j) { return table->second_deg[j]; });
  append_numbers(text, table->first_deg.size(), [&](std::size_t i) { return table->first_deg[i]; });
  const std::size_t columns = table->first_deg.size();
  for (std::size_t i = 0; i < columns; ++i)
    append_numbers(text, table->second_deg.size(), [&](std::size_t j) { return table->candela[j * columns + i]; });
  return text;
}

std::string eulumdat_text(const IntensityTable& given) {
  IntensityTable on_grid;
  const IntensityTable* table = &given;
  if (given.type != PhotometricType::kC || given.axis != GammaAxis::kGamma0) {
    std::vector<double> c, gamma;
    for (int i = 0; i <= 360; ++i) c.push_back(i);
    for (int i = 0; i <= 200; ++i) gamma.push_back(i * 5 / 100.0);
    for (int i = 1; i <= 40; ++i) gamma.push_back(10.0 + i * 0.25);
    for (int i = 21; i <= 90; ++i) gamma.push_back(i);
    on_grid = resample(given, PhotometricType::kC, GammaAxis::kGamma0, c, gamma);
    table = &on_grid;
  }
  const double flux_lm = std::max(1.0, std::round(table->flux_lm()));
  const std::size_t columns = table->first_deg.size();
  const std::size_t planes = columns - 1;  // C 360 is C 0
  std::string text;
  const auto line = [&text](const std::string& value) { text += value.substr(0, 78) + "\r\n"; };
  const auto zeros = [&line](int count) {
    for (int i = 0; i < count; ++i) line("0");
  };
  line(keyword(given, "MANUFAC", "unknown"));
  for (const std::string& value : {std::string("3"), std::string("0"), std::to_string(planes), std::string("0"),
                                   std::to_string(table->second_deg.size()), std::string("0")})
    line(value);
  line(keyword(given, "TEST", "unknown"));
  line(keyword(given, "LUMINAIRE", given.name));
  line(keyword(given, "LUMCAT", given.name));
  line(given.name);
  line(keyword(given, "ISSUEDATE", "unknown"));
  zeros(9);
  for (const char* value : {"100", "100", "1", "0", "1", "-1", "lamp"}) line(value);
  line(number_text(flux_lm));
  for (const char* value : {"-", "-"}) line(value);
  line(number_text(given.header.input_w));
  zeros(10);
  for (std::size_t i = 0; i < planes; ++i) line(number_text(table->first_deg[i]));
  for (const double gamma : table->second_deg) line(number_text(gamma));
  for (std::size_t i = 0; i < planes; ++i) {
    for (std::size_t j = 0; j < table->second_deg.size(); ++j)
      line(number_text(table->candela[j * columns + i] / (flux_lm / 1000.0)));
  }
  return text;
}

std::string csv_text(const IntensityTable& given) {
  IntensityTable on_grid;
  const IntensityTable* table = &given;
  if (given.screen_distance_m > 0.0) {
    std::vector<double> h, v;
    type_a_grid(given, h, v);
    on_grid = resample(given, PhotometricType::kA, GammaAxis::kGamma0, h, v);
    table = &on_grid;
  }
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

}  // namespace phare
