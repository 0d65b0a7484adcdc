#include "tools/cost/ladder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace phare::cost {
namespace {

/// The value that a share of all is not above; `sorted` has one at least.
double share(const std::vector<double>& sorted, double share_01) {
  const auto at = static_cast<std::size_t>(std::ceil(share_01 * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(at, 1, sorted.size()) - 1];
}

std::string number_text(const std::optional<double>& value, const char* format) {
  if (!value) return "";
  char text[32];
  std::snprintf(text, sizeof text, format, *value);
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

bool beats(const Level& a, const Level& b) {
  return a.error.figure() <= b.error.figure() && a.time.median <= b.time.median &&
         (a.error.figure() < b.error.figure() || a.time.median < b.time.median);
}

}  // namespace

Errors errors_of(std::vector<double> differences) {
  if (differences.empty()) return {};
  Errors errors{.samples = differences.size()};
  double squares = 0.0;
  for (double& difference : differences) {
    difference = std::abs(difference);
    squares += difference * difference;
  }
  std::ranges::sort(differences);
  errors.rms = std::sqrt(squares / static_cast<double>(differences.size()));
  errors.p99 = share(differences, 0.99);
  errors.max = differences.back();
  return errors;
}

Times times_of(std::vector<double> times) {
  if (times.empty()) return {};
  std::ranges::sort(times);
  Times found{.median = share(times, 0.5), .p95 = share(times, 0.95), .samples = times.size()};
  // So many of n times lie below the median: n / 2, give or take 1.96 standard deviations of √n / 2.
  const auto n = static_cast<double>(times.size());
  const double below = std::floor(0.5 * (n - 1.96 * std::sqrt(n)));
  if (below >= 1.0) {
    const auto first = static_cast<std::size_t>(below) - 1;
    found.within = std::max(found.median - times[first], times[times.size() - 1 - first] - found.median);
  }
  return found;
}

void mark_efficient(Ladder& ladder) {
  for (Level& level : ladder.levels)
    level.efficient = std::ranges::none_of(ladder.levels, [&](const Level& other) { return beats(other, level); });
}

std::string text_of(const Ladder& ladder) {
  std::string text = ladder.name + ": " + ladder.what + "; truth: " + ladder.reference + "\n";
  char line[256];
  std::snprintf(line, sizeof line, "  %-44s %10s %10s %10s  %-4s %10s %10s  %s\n", "level", "rms", "99 %", "worst",
                ladder.error_unit.c_str(), "median", "95 %", ladder.time_unit.c_str());
  text += line;
  for (const Level& level : ladder.levels) {
    std::snprintf(line, sizeof line, "%c %-44s %10s %10s %10s  %-4s %10s %10s", level.efficient ? '*' : ' ',
                  level.name.c_str(), number_text(level.error.rms, "%.3g").c_str(),
                  number_text(level.error.p99, "%.3g").c_str(), number_text(level.error.max, "%.3g").c_str(), "",
                  number_text(level.time.median, "%.3g").c_str(), number_text(level.time.p95, "%.3g").c_str());
    text += line;
    if (!level.note.empty()) text += "  " + level.note;
    text += '\n';
  }
  return text;
}

std::string csv_of(const std::vector<Ladder>& ladders) {
  std::string csv =
      "ladder,level,error_unit,error_rms,error_p99,error_max,error_samples,time_unit,time_median,time_p95,time_samples,"
      "memory_bytes,efficient\n";
  const char* const exact = "%.9g";
  for (const Ladder& ladder : ladders)
    for (const Level& level : ladder.levels) {
      const std::vector<std::string> cells{quoted(ladder.name),
                                           quoted(level.name),
                                           quoted(ladder.error_unit),
                                           number_text(level.error.rms, exact),
                                           number_text(level.error.p99, exact),
                                           number_text(level.error.max, exact),
                                           std::to_string(level.error.samples),
                                           quoted(ladder.time_unit),
                                           number_text(level.time.median, exact),
                                           number_text(level.time.p95, exact),
                                           std::to_string(level.time.samples),
                                           level.memory_bytes ? std::to_string(*level.memory_bytes) : "",
                                           level.efficient ? "1" : "0"};
      for (std::size_t i = 0; i < cells.size(); ++i) csv += cells[i] + (i + 1 < cells.size() ? "," : "\n");
    }
  return csv;
}

nlohmann::json json_of(const Ladder& ladder) {
  nlohmann::json json{{"name", ladder.name},           {"what", ladder.what},
                      {"reference", ladder.reference}, {"error_unit", ladder.error_unit},
                      {"time_unit", ladder.time_unit}, {"levels", nlohmann::json::array()}};
  for (const Level& level : ladder.levels) {
    nlohmann::json row{{"name", level.name},
                       {"error", {{"max", level.error.max}, {"samples", level.error.samples}}},
                       {"time", {{"median", level.time.median}, {"samples", level.time.samples}}},
                       {"efficient", level.efficient}};
    if (level.error.rms) row["error"]["rms"] = *level.error.rms;
    if (level.error.p99) row["error"]["p99"] = *level.error.p99;
    if (level.time.p95) row["time"]["p95"] = *level.time.p95;
    if (level.time.within) row["time"]["within"] = *level.time.within;
    if (level.memory_bytes) row["memory_bytes"] = *level.memory_bytes;
    if (!level.note.empty()) row["note"] = level.note;
    json["levels"].push_back(std::move(row));
  }
  return json;
}

}  // namespace phare::cost
