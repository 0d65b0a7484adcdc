// phare lamp check: a beam against the rulebooks. Exit code 1 when a row fails or the file has no data for it.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "config/toml_table.h"
#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/print_json.h"

namespace phare {
namespace {

nlohmann::json as_json(const CheckResult& result) {
  nlohmann::json rows = nlohmann::json::array();
  for (const CheckRow& row : result.rows) {
    nlohmann::json one{
        {"id", row.id}, {"clause", row.clause}, {"unit", row.unit}, {"verdict", verdict_name(row.verdict)}};
    // Null: there is nothing to measure.
    const auto number = [&](double value) { return row.has_value ? nlohmann::json(value) : nlohmann::json(); };
    one["value"] = number(row.value());
    one["lowest"] = number(row.lowest);
    one["highest"] = number(row.highest);
    one["margin"] = number(row.margin);
    one["resolution"] = number(row.resolution);
    if (row.min > kNoMinimum) one["min"] = row.min;
    if (row.max < kNoMaximum) one["max"] = row.max;
    if (row.unit == "cd" && row.shape != RowShape::kSum && row.has_value) {
      one["lowest_at_deg"] = {row.lowest_at.h_deg, row.lowest_at.v_deg};
      one["highest_at_deg"] = {row.highest_at.h_deg, row.highest_at.v_deg};
    }
    if (row.reaim.h_deg != 0.0 || row.reaim.v_deg != 0.0) one["reaim_deg"] = {row.reaim.h_deg, row.reaim.v_deg};
    if (!row.reaims.empty()) {
      for (const HV& reaim : row.reaims) one["reaims_deg"].push_back({reaim.h_deg, reaim.v_deg});
    }
    if (row.no_data && row.unit == "cd") one["no_data_at_deg"] = {row.no_data_at.h_deg, row.no_data_at.v_deg};
    if (!row.unconfirmed.empty()) one["unconfirmed"] = row.unconfirmed;
    rows.push_back(std::move(one));
  }
  nlohmann::json lamps = nlohmann::json::array();
  for (const LampAim& lamp : result.lamps) {
    nlohmann::json one{{"up_deg", lamp.up_deg}, {"right_deg", lamp.right_deg}, {"found", lamp.found}};
    if (lamp.cutoff.found) {
      one["sharpness_g"] = lamp.cutoff.sharpness_g;
      one["elevation_deg"] = lamp.cutoff.elevation_deg;
      one["resolution_deg"] = lamp.resolution_deg;
      one["row_step_deg"] = lamp.row_step_deg;
    }
    lamps.push_back(std::move(one));
  }
  nlohmann::json json{{"rule", result.rule_id},
                      {"name", result.rule_name},
                      {"document", result.document},
                      {"traffic", result.left_hand ? "left" : "right"},
                      {"aim",
                       {{"method", result.aim_method},
                        {"up_deg", result.aim_up_deg},
                        {"right_deg", result.aim_right_deg},
                        {"reaimed", result.reaimed},
                        {"lamps", lamps}}},
                      {"verdict", verdict_name(result.verdict)},
                      {"failed", result.failed},
                      {"within_resolution", result.within_resolution},
                      {"no_data", result.no_data},
                      {"unconfirmed_rows", result.unconfirmed},
                      {"rows", rows}};
  if (!result.aim_unconfirmed.empty()) json["aim"]["unconfirmed"] = result.aim_unconfirmed;
  if (result.cutoff.found)
    json["cutoff"] = {{"sharpness_g", result.cutoff.sharpness_g}, {"elevation_deg", result.cutoff.elevation_deg}};
  return json;
}

std::string limits_text(const CheckRow& row) {
  char text[64];
  const auto number = [&](double value) {
    std::snprintf(text, sizeof text, row.unit == "cd" || row.unit == "lm" ? "%.0f" : "%.2f", value);
    return std::string(text);
  };
  if (row.min > kNoMinimum && row.max < kNoMaximum) return number(row.min) + " - " + number(row.max);
  return row.min > kNoMinimum ? ">= " + number(row.min) : "<= " + number(row.max);
}

void print_aim(const CheckResult& result) {
  for (std::size_t k = 0; k < result.lamps.size(); ++k) {
    const LampAim& lamp = result.lamps[k];
    const char* whose = result.lamps.size() < 2 ? "" : k == 0 ? " of the left lamp" : " of the right lamp";
    const char* method =
        result.lamps.size() > 1 && !lamp.found ? "no cut-off found, as filed" : result.aim_method.c_str();
    std::printf("aim%s: %s%s, turned %+.2f deg up, %+.2f deg right%s", whose, method,
                result.aim_unconfirmed.empty() ? "" : " *", lamp.up_deg, lamp.right_deg,
                result.reaimed ? " (within the rule's re-aim allowance)" : "");
    if (lamp.cutoff.found)
      std::printf("; cut-off at %+.3f +- %.2f deg, G %.3f, rows %.2g deg apart", lamp.cutoff.elevation_deg,
                  lamp.resolution_deg, lamp.cutoff.sharpness_g, lamp.row_step_deg);
    std::printf("\n");
  }
}

void print_row(const CheckRow& row) {
  char place[32] = "", value[32] = "-", margin[32] = "-";
  if (row.has_value) {
    const char* format = row.unit == "cd" || row.unit == "lm" ? "%.0f" : "%.3f";
    std::snprintf(value, sizeof value, format, row.value());
    std::snprintf(margin, sizeof margin, row.unit == "cd" || row.unit == "lm" ? "%+.0f" : "%+.3f", row.margin);
    const HV at = row.by_min ? row.lowest_at : row.highest_at;
    if (row.unit == "cd" && row.shape != RowShape::kSum)
      std::snprintf(place, sizeof place, "%+.2f, %+.2f", at.h_deg, at.v_deg);
  }
  std::printf("  %-30s %-16s %17s %12s %15s %12s %-2s %s", row.id.c_str(), row.clause.substr(0, 16).c_str(),
              limits_text(row).c_str(), value, place, margin, row.unit.c_str(),
              row.verdict == Verdict::kFail ? "FAIL" : verdict_name(row.verdict).c_str());
  if (row.no_data && row.unit == "cd") std::printf(" at %+.2f, %+.2f", row.no_data_at.h_deg, row.no_data_at.v_deg);
  std::printf("%s\n", row.unconfirmed.empty() ? "" : " *");
}

void print(const CheckResult& result, const std::string& file) {
  std::printf("%s by %s (%s), %s-hand traffic\n", file.c_str(), result.rule_name.c_str(), result.document.c_str(),
              result.left_hand ? "left" : "right");
  print_aim(result);
  std::printf("  %-30s %-16s %17s %12s %15s %12s\n", "row", "clause", "limit", "value", "at H, V", "margin");
  for (const CheckRow& row : result.rows) print_row(row);
  std::printf("%s: %zu rows, %zu failed, %zu without data, %zu within the file's resolution",
              result.verdict == Verdict::kPass   ? "PASS"
              : result.verdict == Verdict::kFail ? "FAIL"
                                                 : "UNDECIDED",
              result.rows.size(), result.failed, result.no_data, result.within_resolution);
  if (result.unconfirmed > 0) std::printf("; * %zu limits rest on one source", result.unconfirmed);
  if (!result.aim_unconfirmed.empty()) std::printf("; * aim: %s", result.aim_unconfirmed.c_str());
  std::printf("\n");
}

int list_rules(bool as_json) {
  const auto rules = read_rulebooks(rules_folder());
  if (!rules) return bad_input(rules.error());
  if (as_json) {
    nlohmann::json all = nlohmann::json::array();
    for (const Rulebook& rule : *rules) {
      all.push_back({{"id", rule.id},
                     {"name", rule.name},
                     {"aliases", rule.aliases},
                     {"document", rule.document},
                     {"clause", rule.clause},
                     {"function", rule.function},
                     {"half_sum", rule.half_sum},
                     {"sources", rule.sources},
                     {"rows", rule.rows.size()}});
    }
    print_json(all);
    return kExitDone;
  }
  for (const Rulebook& rule : *rules)
    std::printf("%-18s %s, %zu rows\n", rule.id.c_str(), rule.name.c_str(), rule.rows.size());
  return kExitDone;
}

}  // namespace

int lamp_check(const LampCheckOptions& options) {
  if (options.list) return list_rules(options.json);
  if (options.files.empty()) return bad_input({"", "give a photometry file, or --list"});
  if (options.rules.empty()) return bad_input({"--rule", "name a rulebook; --list shows them"});
  if (options.files.size() > 2) return bad_input({"", "one file, or the left and the right lamp's"});
  std::vector<IntensityTable> tables;
  std::string names;
  for (const std::string& file : options.files) {
    auto table = read_lamp(file, options.settings);
    if (!table) return bad_input(table.error());
    tables.push_back(std::move(*table));
    names += (names.empty() ? "" : " and ") + base_name(file);
  }
  std::vector<const IntensityTable*> pointers;
  for (const IntensityTable& table : tables) pointers.push_back(&table);
  CheckOptions check;
  check.traffic = options.traffic == "left"    ? Traffic::kLeft
                  : options.traffic == "right" ? Traffic::kRight
                                               : Traffic::kFind;
  check.reaim = options.reaim;
  check.aim_name = options.aim;
  check.led_module = options.led_module;
  if (const Status pair = same_traffic(pointers); !pair) return bad_input(pair.error());
  if (options.aim_up_deg || options.aim_right_deg)
    check.aim = HV{options.aim_right_deg.value_or(0.0), options.aim_up_deg.value_or(0.0)};

  nlohmann::json all = nlohmann::json::array();
  bool failed = false;
  for (const std::string& name : options.rules) {
    const auto rule = find_rulebook(rules_folder(), name);
    if (!rule) return bad_input(rule.error());
    if (pointers.size() == 2 && !rule->half_sum)
      return bad_input({rule->id, "judges each lamp by itself; check the two files one by one"});
    if (!options.aim.empty() && rule->aim(options.aim) == nullptr) {
      std::vector<std::string> known;
      for (const CutoffAim& aim : rule->cutoff_aims) known.push_back(aim.name);
      return bad_input({"--aim", known.empty() ? rule->id + " has no aim by the cut-off"
                                               : rule->id + ": " + unknown_name_reason("aim", options.aim, known)});
    }
    if (options.led_module && !rule->has_led_module_limits())
      return bad_input({"--led-module", rule->id + " has no limits of its own for LED modules"});
    const CheckResult result = check_lamp(pointers, *rule, check);
    failed = failed || result.verdict >= Verdict::kNoData;
    if (options.json) {
      all.push_back(as_json(result));
      all.back()["files"] = options.files;
    } else {
      print(result, names);
    }
  }
  if (options.json) print_json(all.size() == 1 ? all.front() : all);
  return failed ? kExitCheckFailed : kExitDone;
}

}  // namespace phare
