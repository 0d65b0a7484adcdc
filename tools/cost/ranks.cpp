#include "tools/cost/ranks.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace phare::cost {
namespace {

using nlohmann::json;

/// A level as it is compared: its error, its median time and how far from that the median of all times may lie.
struct Ranked {
  std::string name;
  double error = 0.0, time = 0.0, within = 0.0;
};

std::vector<Ranked> levels_of(const json& ladder) {
  std::vector<Ranked> levels;
  for (const json& level : ladder.at("levels")) {
    const json &error = level.at("error"), &time = level.at("time");
    levels.push_back({level.at("name"), error.contains("rms") ? error["rms"] : error.at("max"), time.at("median"),
                      time.value("within", 0.0)});
  }
  return levels;
}

/// -1, 0, 1: a is less, as far as is known; more.
int order(double a, double b, double apart = 0.0) {
  return a < b - apart ? -1 : a > b + apart ? 1 : 0;
}

RanksAlike compare(const std::string& name, const std::vector<Ranked>& now, const std::vector<Ranked>& before) {
  RanksAlike result{.ladder = name};
  std::vector<std::pair<const Ranked*, const Ranked*>> both;
  for (const Ranked& level : now)
    for (const Ranked& other : before)
      if (other.name == level.name) both.emplace_back(&level, &other);
  for (std::size_t i = 0; i < both.size(); ++i)
    for (std::size_t k = i + 1; k < both.size(); ++k) {
      ++result.pairs;
      const auto& [a, a_then] = both[i];
      const auto& [b, b_then] = both[k];
      const std::string names = a->name + ", " + b->name;
      if (order(a->error, b->error) * order(a_then->error, b_then->error) < 0) {
        ++result.opposite_error;
        result.opposites.push_back(names + ": error");
      }
      const int cheaper = order(a->time, b->time, a->within + b->within),
                cheaper_then = order(a_then->time, b_then->time, a_then->within + b_then->within);
      if (cheaper == 0 || cheaper_then == 0) continue;
      ++result.told_apart;
      if (cheaper == cheaper_then) continue;
      ++result.opposite_time;
      result.opposites.push_back(names + ": time");
    }
  return result;
}

}  // namespace

Result<std::vector<RanksAlike>> compare_ranks(const json& now, const json& before) {
  try {
    std::vector<RanksAlike> result;
    for (const json& ladder : now.at("ladders"))
      for (const json& other : before.at("ladders"))
        if (other.at("name") == ladder.at("name"))
          result.push_back(compare(ladder.at("name"), levels_of(ladder), levels_of(other)));
    return result;
  } catch (const json::exception&) {
    return Error{"", "is no cost.json, as phare cost writes it"};
  }
}

std::vector<std::string> unlike(const json& now, const json& before) {
  std::vector<std::string> lines;
  for (const char* key : {"version", "processor", "device", "size", "scene", "lamp", "vehicle", "seed", "quick"}) {
    const json a = now.value(key, json()), b = before.is_object() ? before.value(key, json()) : json();
    if (a == b) continue;
    const auto word = [](const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); };
    lines.push_back(std::string(key) + " " + word(a) + ", before " + word(b));
  }
  return lines;
}

std::string text_of(const std::vector<RanksAlike>& ladders) {
  std::string text;
  for (const RanksAlike& ladder : ladders) {
    char line[200];
    std::snprintf(line, sizeof line,
                  "%-22s %s: of %zu pairs of levels %zu opposite in error; %zu told apart in time, %zu opposite\n",
                  ladder.ladder.c_str(), ladder.alike() ? "ranks alike" : "RANKS OTHERWISE", ladder.pairs,
                  ladder.opposite_error, ladder.told_apart, ladder.opposite_time);
    text += line;
    for (const std::string& names : ladder.opposites) text += "  " + names + "\n";
  }
  return text;
}

}  // namespace phare::cost
