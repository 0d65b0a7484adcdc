// What `check`, its page and `plot` say of a verdict, in words and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "visual/photometry/bench/check.h"

namespace phare {

/// One beam by one rule.
struct Judged {
  std::string beam;  ///< the file, files, or the beam of a list
  std::string key;   ///< stays the same from run to run: what `beam` is called in JSON
  CheckResult result;
  std::vector<std::string> unused;  ///< of a list of points: what no row looked at
  bool of_points = false;
};

/// "1000", "0.13": candela and lumens whole, others in so many digits.
std::string value_text(const std::string& unit, double value, int digits = 2);
/// What the file leaves open of a value, rounded up to the digits that `value_text` prints: "12", "0.081".
std::string resolution_text(const CheckRow& row);
/// ">= 1000", "350 - 700".
std::string limits_text(const CheckRow& row);
/// "FAIL", "pass", "pass only by re-aim 0.25 deg left, 0.10 deg up", "within resolution, +- 12 cd", "not measured".
std::string verdict_text(const CheckRow& row);
/// "0.25 deg left, 0.10 deg up".
std::string turn_text(HV turn);
/// "right-hand traffic (by the cut-off)", "right-hand traffic (assumed: …)".
std::string traffic_text(const Judged& judged);
/// "by the cut-off", "by its points", "given", "assumed".
std::string traffic_source_text(const Judged& judged);
/// "PASS", "FAIL", "UNDECIDED".
const char* conclusion(RuleVerdict verdict);

nlohmann::json judged_json(const Judged& judged);

/// One rule's rows as a table on standard output.
void print_judged(const Judged& judged);

}  // namespace phare
