// phare lamp check: a beam against the rulebooks. Exit code 1 when a row fails.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/print_json.h"

namespace phare {
namespace {

const char* verdict_name(Verdict verdict) {
  return verdict == Verdict::kPass ? "pass" : verdict == Verdict::kFail ? "fail" : "within resolution";
}

nlohmann::json as_json(const CheckResult& result) {
  nlohmann::json rows = nlohmann::json::array();
  for (const CheckRow& row : result.rows) {
    nlohmann::json one{{"id", row.id},
                       {"clause", row.clause},
                       {"unit", row.unit},
                       {"lowest", row.lowest},
                       {"highest", row.highest},
                       {"margin", row.margin},
                       {"resolution", row.resolution},
                       {"verdict", verdict_name(row.verdict)}};
    if (row.min > kNoMinimum) one["min"] = row.min;
    if (row.max < kNoMaximum) one["max"] = row.max;
    if (row.unit == "cd" && row.shape != RowShape::kSum) {
      one["lowest_at_deg"] = {row.lowest_at.h_deg, row.lowest_at.v_deg};
      one["highest_at_deg"] = {row.highest_at.h_deg, row.highest_at.v_deg};
    }
    if (row.reaim.h_deg != 0.0 || row.reaim.v_deg != 0.0) one["reaim_deg"] = {row.reaim.h_deg, row.reaim.v_deg};
    if (!row.unconfirmed.empty()) one["unconfirmed"] = row.unconfirmed;
    rows.push_back(std::move(one));
  }
  nlohmann::json json{{"rule", result.rule_id},
                      {"name", result.rule_name},
                      {"document", result.document},
                      {"traffic", result.left_hand ? "left" : "right"},
                      {"aim",
                       {{"method", result.aim_method},
                        {"up_deg", result.aim_up_deg},
                        {"right_deg", result.aim_right_deg},
                        {"reaimed", result.reaimed}}},
                      {"verdict", verdict_name(result.verdict)},
                      {"failed", result.failed},
                      {"within_resolution", result.within_resolution},
                      {"unconfirmed_rows", result.unconfirmed},
                      {"rows", rows}};
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

void print(const CheckResult& result, const std::string& file) {
  std::printf("%s by %s (%s), %s-hand traffic\n", file.c_str(), result.rule_name.c_str(), result.document.c_str(),
              result.left_hand ? "left" : "right");
  std::printf("aim: %s, turned %+.2f deg up, %+.2f deg right%s", result.aim_method.c_str(), result.aim_up_deg,
              result.aim_right_deg, result.reaimed ? " (within the rule's re-aim allowance)" : "");
  if (result.cutoff.found)
    std::printf("; cut-off at %+.3f deg, G %.3f", result.cutoff.elevation_deg, result.cutoff.sharpness_g);
  std::printf("\n  %-24s %-16s %17s %12s %15s %12s\n", "row", "clause", "limit", "value", "at H, V", "margin");
  for (const CheckRow& row : result.rows) {
    const bool by_min = row.min > kNoMinimum && row.margin == row.lowest - row.min;
    const double value = by_min ? row.lowest : row.highest;
    const HV at = by_min ? row.lowest_at : row.highest_at;
    char place[32] = "";
    if (row.unit == "cd" && row.shape != RowShape::kSum)
      std::snprintf(place, sizeof place, "%+.2f, %+.2f", at.h_deg, at.v_deg);
    const bool whole = row.unit == "cd" || row.unit == "lm";
    std::printf(whole ? "  %-24s %-16s %17s %12.0f %15s %+12.0f %-2s %s%s\n"
                      : "  %-24s %-16s %17s %12.3f %15s %+12.3f %-2s %s%s\n",
                row.id.c_str(), row.clause.substr(0, 16).c_str(), limits_text(row).c_str(), value, place, row.margin,
                row.unit.c_str(),
                row.verdict == Verdict::kPass   ? "pass"
                : row.verdict == Verdict::kFail ? "FAIL"
                                                : "within resolution",
                row.unconfirmed.empty() ? "" : " *");
  }
  std::printf("%s: %zu rows, %zu failed, %zu within the file's resolution",
              result.verdict == Verdict::kFail ? "FAIL" : "PASS", result.rows.size(), result.failed,
              result.within_resolution);
  if (result.unconfirmed > 0) std::printf("; * %zu limits rest on one source", result.unconfirmed);
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
  if (options.aim_up_deg || options.aim_right_deg)
    check.aim = HV{options.aim_right_deg.value_or(0.0), options.aim_up_deg.value_or(0.0)};

  nlohmann::json all = nlohmann::json::array();
  bool failed = false;
  for (const std::string& name : options.rules) {
    const auto rule = find_rulebook(rules_folder(), name);
    if (!rule) return bad_input(rule.error());
    if (pointers.size() == 2 && !rule->half_sum)
      return bad_input({rule->id, "judges each lamp by itself; check the two files one by one"});
    const CheckResult result = check_lamp(pointers, *rule, check);
    failed = failed || result.verdict == Verdict::kFail;
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
