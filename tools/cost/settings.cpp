#include "tools/cost/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <tuple>

#include "visual/photometry/beam/image_levels.h"

namespace phare::cost {
namespace {

using nlohmann::json;

std::string print(const char* format, double a, double b = 0.0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// Nothing of a table that could not be compared may come from a file.
bool sound(const SettingFigures& figures) {
  const auto share = [](double value) { return std::isfinite(value) && value >= 0.0; };
  return share(figures.misplaced) && share(figures.p99.value_or(0.0)) && share(figures.median_ms) &&
         share(figures.p95_ms) && share(figures.within_ms) && figures.median_ms <= figures.p95_ms;
}

json json_of(const SettingFigures& figures) {
  json row{{"misplaced", figures.misplaced}, {"median_ms", figures.median_ms}, {"p95_ms", figures.p95_ms}};
  if (figures.within_ms > 0.0) row["within_ms"] = figures.within_ms;
  if (figures.p99) row["p99"] = *figures.p99;
  return row;
}

SettingFigures figures_of(const json& row) {
  SettingFigures figures{
      .misplaced = row.at("misplaced"), .p99 = {}, .median_ms = row.at("median_ms"), .p95_ms = row.at("p95_ms")};
  if (row.contains("p99")) figures.p99 = row["p99"].get<double>();
  if (row.contains("within_ms")) figures.within_ms = row["within_ms"].get<double>();
  return figures;
}

template <typename Names>
std::size_t index_of(const Names& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw std::invalid_argument(name + " is none of ours");
  return static_cast<std::size_t>(found - names.begin());
}

/// `other` is at least as good in both and better in one.
bool beats(const Setting& other, const Setting& one) {
  return other.misplaced <= one.misplaced && other.p95_ms <= one.p95_ms &&
         (other.misplaced < one.misplaced || other.p95_ms < one.p95_ms);
}

bool finer(const Setting& a, const Setting& b) {
  return a.misplaced != b.misplaced ? a.misplaced < b.misplaced : a.p95_ms < b.p95_ms;
}

bool same(const Setting& a, const Setting& b) {
  return a.method == b.method && a.image == b.image && a.shadows == b.shadows && a.fog == b.fog;
}

}  // namespace

std::string why_not_valid(const Validity& table, const Validity& wanted) {
  if (table.version != wanted.version) return "it is of Phare " + table.version + ", this is " + wanted.version;
  if (table.device != wanted.device) return "it is of " + table.device + ", this is " + wanted.device;
  if (table.rig != wanted.rig) return "scene, lamps or camera are others";
  if (table.picture != wanted.picture) return "it is of " + table.picture + ", this is " + wanted.picture;
  return {};
}

json json_of(const SettingsTable& table) {
  json light = json::array(), shadows = json::array(), fog = json::array();
  for (const LightSetting& one : table.light) {
    light.push_back(json_of(one.figures));
    light.back()["method"] = kMethodNames[static_cast<std::size_t>(one.method)];
    light.back()["beam_image"] = level_name(one.image);
  }
  for (const auto& [figures, names, rows] :
       {std::tuple{&table.shadows, std::span<const std::string_view>(kShadowNames), &shadows},
        std::tuple{&table.fog, std::span<const std::string_view>(kFogNames), &fog}})
    for (std::size_t level = 0; level < figures->size(); ++level) {
      rows->push_back(json_of((*figures)[level]));
      rows->back()["level"] = names[level];
    }
  return {{"device", table.validity.device},   {"version", table.validity.version}, {"rig", table.validity.rig},
          {"picture", table.validity.picture}, {"measured_at", table.measured_at},  {"rounds", table.rounds},
          {"light", std::move(light)},         {"shadows", std::move(shadows)},     {"fog", std::move(fog)}};
}

Result<SettingsTable> table_of_json(const json& from) try {
  SettingsTable table{.validity = {from.at("device"), from.at("version"), from.at("rig"), from.at("picture")},
                      .measured_at = from.at("measured_at"),
                      .rounds = from.at("rounds")};
  for (const json& row : from.at("light"))
    table.light.push_back({static_cast<Method>(index_of(kMethodNames, row.at("method"))),
                           static_cast<ImageLevel>(index_of(kImageLevelNames, row.at("beam_image"))), figures_of(row)});
  for (const json& row : from.at("shadows")) table.shadows.push_back(figures_of(row));
  for (const json& row : from.at("fog")) table.fog.push_back(figures_of(row));
  bool whole = !table.light.empty() && table.shadows.size() == kRayShadows &&
               (table.fog.empty() || table.fog.size() == kFogNames.size());
  for (const LightSetting& one : table.light) whole = whole && sound(one.figures);
  for (const auto* ladder : {&table.shadows, &table.fog})
    for (const SettingFigures& one : *ladder) whole = whole && sound(one);
  if (!whole) return Error{"", "the table is not whole"};
  return table;
} catch (const std::exception& wrong) {
  return Error{"", wrong.what()};
}

std::string Setting::text() const {
  std::string text = std::string(kMethodNames[static_cast<std::size_t>(method)]) + ", " + level_name(image) +
                     ", shadows " + std::string(kShadowNames[shadows]);
  if (fog) text += ", fog " + std::string(kFogNames[*fog]);
  return text;
}

std::vector<Setting> all_settings(const SettingsTable& table, const FixedSettings& fixed) {
  std::vector<Setting> settings;
  const auto more = [](const std::vector<SettingFigures>& ladder, std::size_t level, double SettingFigures::*figure) {
    return std::max(0.0, ladder[level].*figure - ladder.front().*figure);
  };
  // Off holds no tolerance, unless the user wants it off: then it is no approximation of anything.
  const auto worst_of = [](const std::vector<SettingFigures>& ladder, std::size_t level,
                           const std::optional<std::size_t>& by_hand) {
    if (level != 0) return ladder[level].misplaced;
    return by_hand ? 0.0 : std::numeric_limits<double>::infinity();
  };
  for (const LightSetting& light : table.light) {
    if (fixed.method.value_or(light.method) != light.method || fixed.image.value_or(light.image) != light.image)
      continue;
    for (std::size_t shadows = 0; shadows < table.shadows.size(); ++shadows) {
      if (fixed.shadows.value_or(shadows) != shadows) continue;
      Setting setting{.method = light.method, .image = light.image, .shadows = shadows};
      setting.p99 = light.figures.p99.value_or(0.0);
      setting.misplaced = light.figures.misplaced + table.shadows[shadows].misplaced;
      // Without shadows a lux behind something is wrong by all of it, however little of the whole light that is.
      setting.worst_share = std::max(setting.p99, worst_of(table.shadows, shadows, fixed.shadows));
      setting.median_ms = light.figures.median_ms + more(table.shadows, shadows, &SettingFigures::median_ms);
      setting.p95_ms = light.figures.p95_ms + more(table.shadows, shadows, &SettingFigures::p95_ms);
      // Off takes nothing, so nothing of it is off.
      const auto within = [](const std::vector<SettingFigures>& ladder, std::size_t level) {
        return level == 0 ? 0.0 : ladder[level].within_ms + ladder.front().within_ms;
      };
      setting.within_ms = light.figures.within_ms + within(table.shadows, shadows);
      if (table.fog.empty()) settings.push_back(setting);
      for (std::size_t fog = 0; fog < table.fog.size(); ++fog) {
        if (fixed.fog.value_or(fog) != fog) continue;
        Setting foggy = setting;
        foggy.fog = fog;
        foggy.misplaced += table.fog[fog].misplaced;
        foggy.worst_share = std::max(foggy.worst_share, worst_of(table.fog, fog, fixed.fog));
        foggy.median_ms += more(table.fog, fog, &SettingFigures::median_ms);
        foggy.p95_ms += more(table.fog, fog, &SettingFigures::p95_ms);
        foggy.within_ms += within(table.fog, fog);
        settings.push_back(foggy);
      }
    }
  }
  return settings;
}

std::vector<Setting> frontier(std::vector<Setting> settings) {
  std::vector<Setting> kept;
  for (const Setting& one : settings) {
    const bool beaten = std::ranges::any_of(settings, [&](const Setting& other) { return beats(other, one); });
    // Of two that are alike in both, one.
    const bool again = std::ranges::any_of(
        kept, [&](const Setting& other) { return other.misplaced == one.misplaced && other.p95_ms == one.p95_ms; });
    if (!beaten && !again) kept.push_back(one);
  }
  std::ranges::sort(kept, finer);
  return kept;
}

Pick pick_for_budget(const std::vector<Setting>& settings, double budget_ms) {
  const std::vector<Setting> worth = frontier(settings);
  const auto fits = std::ranges::find_if(worth, [&](const Setting& one) { return one.p95_ms <= budget_ms; });
  if (fits == worth.end())
    return {worth.back(), false,
            print("none fits %.4g ms: the cheapest, with p95 %.3g ms", budget_ms, worth.back().p95_ms)};
  std::string why = print("the most accurate that fits %.4g ms: p95 %.3g ms", budget_ms, fits->p95_ms) +
                    print(", %.2g %% of the light misplaced", 100.0 * fits->misplaced);
  if (fits != worth.begin()) {
    const Setting& next = *std::prev(fits);
    why += "; " + next.text() + print(" would take %.3g ms", next.p95_ms);
  }
  return {*fits, true, why};
}

Pick pick_for_tolerance(const std::vector<Setting>& settings, double share) {
  std::vector<Setting> hold;
  for (const Setting& one : settings)
    if (one.worst_share <= share) hold.push_back(one);
  const auto told = [&](const Setting& one) {
    return print("99 %% of lux within %.2g %%, %.2g %% of the light misplaced", 100.0 * one.p99, 100.0 * one.misplaced);
  };
  if (hold.empty()) {
    const Setting best = *std::ranges::min_element(settings, {}, &Setting::worst_share);
    return {best, false,
            print("no setting holds %.3g %%; the best is ", 100.0 * share) + best.text() + ": " +
                print("%.2g %%", 100.0 * best.worst_share)};
  }
  const Setting best = *std::ranges::min_element(hold, [](const Setting& a, const Setting& b) {
    return a.median_ms != b.median_ms ? a.median_ms < b.median_ms : finer(a, b);
  });
  return {best, true, print("the cheapest that holds %.3g %%, %.3g ms: ", 100.0 * share, best.median_ms) + told(best)};
}

Ladder ladder_of(const SettingsTable& table) {
  Ladder ladder{.name = "settings",
                .what =
                    "whole pictures of the rig by light, shadows and fog: times of a frame on the wall, as far as the "
                    "ladders add up",
                .reference = "float64 with a ray to each lamp, at points of the drive",
                .error_unit = "% of the light",
                .time_unit = "ms a frame"};
  for (const Setting& setting : all_settings(table)) {
    Level& level = ladder.levels.emplace_back();
    level.name = setting.text();
    level.error = {.rms = {}, .p99 = 100.0 * setting.p99, .max = 100.0 * setting.misplaced};
    level.time = {.median = setting.median_ms, .p95 = setting.p95_ms, .within = setting.within_ms};
    level.note = "99 %: of single lux, of light alone; worst: of all the light, what is misplaced";
  }
  return ladder;
}

std::vector<Setting> steps_about(const std::vector<Setting>& settings, const Setting& picked) {
  std::vector<Setting> reachable;
  for (const Setting& one : settings)
    if (one.image == picked.image) reachable.push_back(one);
  std::vector<Setting> steps = frontier(std::move(reachable));
  if (std::ranges::none_of(steps, [&](const Setting& one) { return same(one, picked); })) {
    steps.push_back(picked);
    std::ranges::sort(steps, finer);
  }
  // Where the picked one is beaten by another, what lies between them is no step: time has to fall along the way.
  std::vector<Setting> falling;
  for (const Setting& one : steps)
    if (falling.empty() || one.p95_ms < falling.back().p95_ms || same(one, picked)) {
      while (same(one, picked) && !falling.empty() && falling.back().p95_ms <= one.p95_ms) falling.pop_back();
      falling.push_back(one);
    }
  return falling;
}

}  // namespace phare::cost
