#include "tools/lamp/check_text.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace phare {
namespace {

bool is_whole_unit(const std::string& unit) {
  return unit == "cd" || unit == "lm";
}

std::string number_of(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void print_aims(const CheckResult& result) {
  if (result.lamps.empty()) std::printf("aim: %s\n", result.aim_method.c_str());
  for (std::size_t k = 0; k < result.lamps.size(); ++k) {
    const LampAim& lamp = result.lamps[k];
    const char* whose = result.lamps.size() < 2 ? "" : k == 0 ? " of the left lamp" : " of the right lamp";
    const char* method =
        result.lamps.size() > 1 && !lamp.found ? "no cut-off found, as filed" : result.aim_method.c_str();
    std::printf("aim%s: %s%s, turned %+.2f deg up, %+.2f deg right", whose, method,
                result.aim_unconfirmed.empty() ? "" : " *", lamp.up_deg, lamp.right_deg);
    if (result.reaimed) std::printf(" (within the rule's re-aim allowance: %s of it)", turn_text(result.reaim).c_str());
    if (lamp.cutoff.found)
      std::printf("; cut-off at %+.3f +- %.2f deg, G %.3f, rows %.2g deg apart", lamp.cutoff.elevation_deg,
                  lamp.resolution_deg, lamp.cutoff.sharpness_g, lamp.row_step_deg);
    std::printf("\n");
  }
}

void print_check_row(const CheckRow& row) {
  std::string place, value = "-", margin = "-";
  if (row.has_value) {
    value = value_text(row.unit, row.value(), 3);
    margin = (row.margin < 0.0 ? "" : "+") + value_text(row.unit, row.margin, 3);
    const HV at = row.by_min ? row.lowest_at : row.highest_at;
    if (row.unit == "cd" && row.shape != RowShape::kSum)
      place = number_of("%+.2f", at.h_deg) + ", " + number_of("%+.2f", at.v_deg);
  }
  std::printf("  %-30s %-16s %17s %12s %15s %12s %-2s %s", row.id.c_str(), row.clause.substr(0, 16).c_str(),
              limits_text(row).c_str(), value.c_str(), place.c_str(), margin.c_str(), row.unit.c_str(),
              verdict_text(row).c_str());
  if (row.no_data && row.unit == "cd" && !row.not_measured)
    std::printf(" at %+.2f, %+.2f", row.no_data_at.h_deg, row.no_data_at.v_deg);
  std::printf("%s\n", row.unconfirmed.empty() ? "" : " *");
}

nlohmann::json row_json(const CheckRow& row) {
  nlohmann::json one{{"id", row.id}, {"clause", row.clause}, {"unit", row.unit}, {"verdict", verdict_name(row)}};
  if (!row.open.empty()) one["open"] = row.open;
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
  for (const HV& reaim : row.reaims) one["reaims_deg"].push_back({reaim.h_deg, reaim.v_deg});
  if (row.passes_by) one["passes_only_by_reaim_deg"] = {row.passes_by->h_deg, row.passes_by->v_deg};
  if (row.no_data && row.unit == "cd") one["no_data_at_deg"] = {row.no_data_at.h_deg, row.no_data_at.v_deg};
  if (!row.unconfirmed.empty()) one["unconfirmed"] = row.unconfirmed;
  return one;
}

}  // namespace

std::string value_text(const std::string& unit, double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", is_whole_unit(unit) ? 0 : digits, value);
  return text;
}

std::string resolution_text(const CheckRow& row) {
  const double unit = is_whole_unit(row.unit) ? 1.0 : 0.001;
  return value_text(row.unit, unit * std::ceil(row.resolution / unit), 3);
}

std::string limits_text(const CheckRow& row) {
  const auto number = [&](double value) { return value_text(row.unit, value); };
  if (row.min > kNoMinimum && row.max < kNoMaximum) return number(row.min) + " - " + number(row.max);
  if (row.min > kNoMinimum) return ">= " + number(row.min);
  return row.max < kNoMaximum ? "<= " + number(row.max) : "not known";
}

std::string turn_text(HV turn) {
  std::string text;
  const auto add = [&](double deg, const char* positive, const char* negative) {
    if (std::abs(deg) < 0.005) return;
    text += (text.empty() ? "" : ", ") + number_of("%.2f", std::abs(deg)) + " deg " + (deg > 0.0 ? positive : negative);
  };
  add(turn.h_deg, "right", "left");
  add(turn.v_deg, "up", "down");
  return text.empty() ? "0 deg" : text;
}

std::string verdict_text(const CheckRow& row) {
  switch (row.verdict) {
    case RuleVerdict::kFail:
      return "FAIL";
    case RuleVerdict::kPass:
      return row.passes_by ? "pass only by re-aim " + turn_text(*row.passes_by) : "pass";
    case RuleVerdict::kWithinResolution: {
      return "within resolution, +- " + resolution_text(row) + (row.unit.empty() ? "" : " " + row.unit);
    }
    case RuleVerdict::kNoData:
      break;
  }
  return verdict_name(row) + (row.open.empty() ? "" : ", " + row.open);
}

std::string traffic_source_text(const Judged& judged) {
  if (judged.of_points && judged.result.traffic_source == TrafficSource::kFound) return "by its points";
  return traffic_source_name(judged.result.traffic_source);
}

std::string traffic_text(const Judged& judged) {
  const CheckResult& result = judged.result;
  std::string text = result.left_hand ? "left-hand traffic (" : "right-hand traffic (";
  if (result.traffic_source != TrafficSource::kAssumed) return text + traffic_source_text(judged) + ")";
  if (judged.of_points) return text + "assumed: the list has as many points of the one side as of the other)";
  if (result.function != "low") return text + "assumed; the rows are the same for both sides)";
  text += side_source(result.shape);
  if (!result.other_side.empty())
    text += std::string("; for ") + (result.left_hand ? "right" : "left") + "-hand traffic: " + result.other_side;
  return text + ")";
}

const char* conclusion(RuleVerdict verdict) {
  return verdict == RuleVerdict::kPass ? "PASS" : verdict == RuleVerdict::kFail ? "FAIL" : "UNDECIDED";
}

nlohmann::json judged_json(const Judged& judged) {
  const CheckResult& result = judged.result;
  nlohmann::json rows = nlohmann::json::array(), lamps = nlohmann::json::array();
  for (const CheckRow& row : result.rows) rows.push_back(row_json(row));
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
                      {"traffic_source", traffic_source_text(judged)},
                      {"aim",
                       {{"method", result.aim_method},
                        {"up_deg", result.aim_up_deg},
                        {"right_deg", result.aim_right_deg},
                        {"reaimed", result.reaimed},
                        {"lamps", lamps}}},
                      {"verdict", verdict_name(result.verdict)},
                      {"failed", result.failed},
                      {"within_resolution", result.within_resolution},
                      {judged.of_points ? "not_measured" : "no_data", result.no_data},
                      {"unconfirmed_rows", result.unconfirmed},
                      {"rows", rows}};
  if (judged.of_points) {
    if (result.verdict == RuleVerdict::kNoData) json["verdict"] = "not measured";
    json["beam"] = judged.key;
    json["unused_points"] = judged.unused;
  } else {
    json["cutoff_form"] = form_name(result.shape.form);
  }
  if (!result.other_side.empty()) json["other_side"] = result.other_side;
  if (result.reaimed) json["aim"]["reaim_deg"] = {result.reaim.h_deg, result.reaim.v_deg};
  if (!result.aim_unconfirmed.empty()) json["aim"]["unconfirmed"] = result.aim_unconfirmed;
  if (result.cutoff.found)
    json["cutoff"] = {{"sharpness_g", result.cutoff.sharpness_g}, {"elevation_deg", result.cutoff.elevation_deg}};
  return json;
}

void print_judged(const Judged& judged) {
  const CheckResult& result = judged.result;
  std::printf("%s by %s (%s), %s\n", judged.beam.c_str(), result.rule_name.c_str(), result.document.c_str(),
              traffic_text(judged).c_str());
  print_aims(result);
  std::printf("  %-30s %-16s %17s %12s %15s %12s\n", "row", "clause", "limit", "value", "at H, V", "margin");
  for (const CheckRow& row : result.rows) print_check_row(row);
  if (!judged.unused.empty()) {
    std::string names;
    for (const std::string& name : judged.unused) names += (names.empty() ? "" : ", ") + name;
    std::printf("  in the list, but in no row: %s\n", names.c_str());
  }
  std::printf("%s: %zu rows, %zu failed, %zu %s, %zu within the file's resolution", conclusion(result.verdict),
              result.rows.size(), result.failed, result.no_data, judged.of_points ? "not measured" : "without data",
              result.within_resolution);
  if (result.unconfirmed > 0) std::printf("; * %zu limits rest on one source", result.unconfirmed);
  if (!result.aim_unconfirmed.empty()) std::printf("; * aim: %s", result.aim_unconfirmed.c_str());
  std::printf("\n");
}

}  // namespace phare
