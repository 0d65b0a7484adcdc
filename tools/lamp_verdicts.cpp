#include "tools/lamp_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "visual/photometry/beam/lamp_tables.h"
#include "visual/photometry/bench/check.h"
#include "visual/photometry/bench/hspr.h"

namespace phare {
namespace {

using nlohmann::json;

/// The rules of UN R149 (headlamps) and R19 (fog lamps, class F3) that a beam is asked for.
struct Asked {
  LampFunction function;
  std::vector<const char*> rules;
};
const std::array<Asked, 3> kAsked{{{LampFunction::kLow, {"r149-passing-c"}},
                                   {LampFunction::kHigh, {"r149-driving-a", "r149-driving-b"}},
                                   {LampFunction::kFog, {"r19-f3"}}}};

/// The sources of one beam of a design, the left lamp first.
struct Beam {
  std::vector<IntensityTable> tables;  ///< as they shine: times their scale
  std::vector<double> y_m, z_m;
  std::string files;
  std::string none;  ///< why it is not judged
};

IntensityTable scaled(IntensityTable table, double scale) {
  for (double& cd : table.candela) cd *= scale;
  table.header.smallest_step_cd *= scale;
  return table;
}

Beam beam_of(const DesignConfig& design, LampFunction function) {
  Beam beam;
  LampTables read;
  std::vector<const LampConfig*> lamps;
  for (const LampConfig& lamp : design.lamps) {
    const auto sources = std::ranges::count(lamp.sources, function, &SourceConfig::function);
    if (sources == 0) continue;
    if (sources > 1) beam.none = "made of several sources; its files are judged by phare lamp check";
    lamps.push_back(&lamp);
  }
  std::ranges::sort(lamps, std::greater{}, [](const LampConfig* lamp) { return lamp->position_m.y; });
  if (lamps.size() > 2)
    beam.none = "of " + std::to_string(lamps.size()) + " lamps; its files are judged by phare lamp check";
  for (const LampConfig* lamp : lamps) {
    for (const SourceConfig& source : lamp->sources) {
      if (source.function != function) continue;
      std::string file = source.file.filename().string();
      if (source.scale != 1.0) file += fmt::format(" \u00d7 {:g}", source.scale);
      if (beam.files.find(file) == std::string::npos) beam.files += (beam.files.empty() ? "" : ", ") + file;
      if (!beam.none.empty()) continue;
      if (const Status status = read.add(source); !status) {
        beam.none = status.error().text();
        continue;
      }
      beam.tables.push_back(scaled(read.of(source), source.scale));
      beam.y_m.push_back(lamp->position_m.y), beam.z_m.push_back(lamp->position_m.z);
    }
  }
  return beam;
}

json verdict_of(const CheckResult& result) {
  json verdict{{"rule", result.rule_name},
               {"rule_id", result.rule_id},
               {"verdict", verdict_name(result.verdict)},
               {"rows", result.rows.size()},
               {"failed", result.failed},
               {"no_data", result.no_data},
               {"traffic", result.left_hand ? "left" : "right"}};
  // Of the rows that fail the one that misses most of its limit.
  double most = 0.0;
  for (const CheckRow& row : result.rows) {
    const double limit = row.by_min ? row.min : row.max;
    if (row.verdict != RuleVerdict::kFail || limit <= 0.0) continue;
    if (-row.margin / limit <= most) continue;
    most = -row.margin / limit;
    verdict["worst"] = {{"row", row.id}, {"value", row.value()}, {"limit", limit}, {"unit", row.unit}};
  }
  return verdict;
}

void add_hspr(json& row, const Beam& beam, LampFunction function) {
  if (beam.tables.size() != 2) {
    row["hspr_none"] = "rates a pair";
    return;
  }
  std::vector<HsprLamp> lamps;
  for (std::size_t i = 0; i < 2; ++i) lamps.push_back({&beam.tables[i], -beam.y_m[i], beam.z_m[i], 0.0});
  const auto known = hspr_beam(lamps, function == LampFunction::kLow ? HsprBeam::kLow : HsprBeam::kHigh);
  if (!known) {
    row["hspr_none"] = known.error().reason;
    return;
  }
  const HsprResult result = function == LampFunction::kLow ? hspr_low_beam(lamps) : hspr_high_beam(lamps);
  if (result.score)
    row["hspr"] = {{"score", *result.score},
                   {"class", hspr_class(10.0 * *result.score)},
                   {"height_m", 0.5 * (beam.z_m[0] + beam.z_m[1])},
                   {"spacing_m", beam.y_m[0] - beam.y_m[1]}};
  else
    row["hspr_none"] = "a threshold of the method is never reached";
}

}  // namespace

json lamp_verdicts(const Rig& rig, const std::filesystem::path& rules_folder) {
  json all = json::array();
  const auto rules = read_rulebooks(rules_folder);
  std::map<std::vector<std::string>, json> judged;  // the same files in another design: the same verdict
  for (const DesignConfig& design : rig.designs) {
    for (const Asked& asked : kAsked) {
      const Beam beam = beam_of(design, asked.function);
      if (beam.files.empty()) continue;
      json row{{"design", design.name},
               {"beam", kLampFunctionNames[static_cast<std::size_t>(asked.function)]},
               {"files", beam.files}};
      std::vector<const IntensityTable*> tables;
      std::vector<std::string> key{row["beam"].get<std::string>()};
      for (std::size_t i = 0; i < beam.tables.size(); ++i) {
        const IntensityTable& table = beam.tables[i];
        tables.push_back(&table);
        key.push_back(table.content_hash + std::to_string(table.peak_cd()) + " " + std::to_string(table.flux_lm()) +
                      " " + std::to_string(beam.y_m[i]) + " " + std::to_string(beam.z_m[i]));
      }
      if (!beam.none.empty()) row["none"] = beam.none;
      if (!rules) row["none"] = rules.error().text();
      if (row.contains("none")) {
        all.push_back(std::move(row));
        continue;
      }
      if (const auto same = judged.find(key); same != judged.end()) {
        const json named = row;
        row = same->second;
        row.update(named);
        all.push_back(std::move(row));
        continue;
      }
      row["rules"] = json::array();
      for (const Rulebook& rule : *rules) {
        if (std::ranges::find(asked.rules, rule.id) == asked.rules.end()) continue;
        if (const Status same = same_traffic(tables); !same) {
          row["none"] = same.error().reason;
          break;
        }
        // A rule of one lamp judges each; the worse one speaks. One file for both sides is judged once.
        const std::span<const IntensityTable* const> pair(tables);
        std::vector<std::span<const IntensityTable* const>> parts{pair};
        if (!rule.half_sum && pair.size() == 2) {
          parts = {pair.first(1)};
          if (tables[0]->candela != tables[1]->candela) parts.push_back(pair.last(1));
        }
        std::optional<CheckResult> worse;
        for (const auto& part : parts) {
          CheckResult result = check_lamp(part, rule);
          const auto badness = [](const CheckResult& one) { return std::pair(one.verdict, one.failed); };
          if (!worse || badness(result) > badness(*worse)) worse = std::move(result);
        }
        row["rules"].push_back(verdict_of(*worse));
      }
      if (asked.function != LampFunction::kFog) add_hspr(row, beam, asked.function);
      judged[key] = row;
      all.push_back(std::move(row));
    }
  }
  return all;
}

}  // namespace phare
