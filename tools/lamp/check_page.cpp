#include "tools/lamp/check_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "tools/lamp/chart.h"

namespace phare {
namespace {

constexpr std::size_t kTightestPasses = 10;  // of the passing rows so many are printed; the page has all

int badness(const CheckRow& row) {
  if (row.verdict == RuleVerdict::kFail) return 0;
  if (row.verdict == RuleVerdict::kNoData) return row.not_measured ? 5 : 1;
  if (row.verdict == RuleVerdict::kWithinResolution) return 2;
  return row.passes_by ? 3 : 4;
}

const char* colour_of(const CheckRow& row) {
  constexpr const char* kClasses[] = {"fail", "nodata", "within", "reaim", "pass", "nodata"};
  return kClasses[badness(row)];
}

std::string number_of_percent(const CheckRow& row) {
  if (!row.has_value) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%+.1f %%", margin_percent(row));
  return text;
}

std::string place_of(const CheckRow& row) {
  if (!row.has_value || row.unit != "cd" || row.shape == RowShape::kSum) return "";
  const HV at = row.by_min ? row.lowest_at : row.highest_at;
  char text[48];
  std::snprintf(text, sizeof text, "%+.2f, %+.2f", at.h_deg, at.v_deg);
  return text;
}

std::string summary_of(const Judged& judged) {
  const CheckResult& r = judged.result;
  std::string text = std::to_string(r.rows.size()) + " rows, " + std::to_string(r.failed) + " failed, " +
                     std::to_string(r.no_data) + (judged.of_points ? " not measured, " : " without data, ") +
                     std::to_string(r.within_resolution) + " within resolution";
  const auto by_reaim = std::count_if(r.rows.begin(), r.rows.end(), [](const CheckRow& row) { return row.passes_by; });
  if (by_reaim > 0) text += ", " + std::to_string(by_reaim) + " only by re-aim";
  return text;
}

std::string aim_of(const CheckResult& r) {
  std::string text = r.aim_method;
  if (!r.lamps.empty()) text += ", turned " + turn_text({r.aim_right_deg, r.aim_up_deg});
  if (r.reaimed) text += " (of it re-aim " + turn_text(r.reaim) + ")";
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return out;
}

/// All rules judge for one side of traffic, known in one way: said once. Else every rule says its own.
bool one_traffic(std::span<const Judged> all) {
  return std::all_of(all.begin(), all.end(),
                     [&](const Judged& judged) { return traffic_text(judged) == traffic_text(all.front()); });
}

}  // namespace

double margin_percent(const CheckRow& row) {
  if (!row.has_value) return 0.0;
  const double limit = row.by_min ? row.min : row.max;
  return limit > 0.0 && limit < kNoMaximum ? 100.0 * row.margin / limit : row.margin;
}

std::vector<PageRow> worst_first(std::span<const Judged> all) {
  std::vector<PageRow> rows;
  for (const Judged& judged : all) {
    for (const CheckRow& row : judged.result.rows) rows.push_back({&judged, &row});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const PageRow& a, const PageRow& b) {
    return std::tuple(badness(*a.row), margin_percent(*a.row)) < std::tuple(badness(*b.row), margin_percent(*b.row));
  });
  return rows;
}

void print_page(const PageHead& head, std::span<const Judged> all) {
  std::printf("%s: %s%s\n", head.beams.c_str(), head.function.c_str(), head.market.c_str());
  const bool one = one_traffic(all);
  if (!all.empty() && one) std::printf("%s\n", traffic_text(all.front()).c_str());
  for (const Judged& judged : all) {
    std::printf("  %-9s %-18s %s; aim: %s%s%s\n", conclusion(judged.result.verdict), judged.result.rule_id.c_str(),
                summary_of(judged).c_str(), aim_of(judged.result).c_str(),
                all.front().beam != judged.beam ? ("; " + judged.beam).c_str() : "",
                one ? "" : ("; " + traffic_text(judged)).c_str());
  }
  const std::vector<PageRow> rows = worst_first(all);
  std::printf("worst rows first:\n  %-18s %-30s %17s %12s %15s %10s  %s\n", "rule", "row", "limit", "value", "at H, V",
              "margin", "verdict");
  std::size_t passed = 0, not_measured = 0;
  for (const auto& [judged, row] : rows) {
    if (row->verdict == RuleVerdict::kNoData && row->not_measured) {
      ++not_measured;
      continue;
    }
    if (row->verdict == RuleVerdict::kPass && !row->passes_by && ++passed > kTightestPasses) continue;
    std::printf("  %-18s %-30s %17s %12s %15s %10s  %s%s\n", judged->result.rule_id.c_str(), row->id.c_str(),
                limits_text(*row).c_str(), row->has_value ? value_text(row->unit, row->value(), 3).c_str() : "-",
                place_of(*row).c_str(), number_of_percent(*row).c_str(), verdict_text(*row).c_str(),
                row->unconfirmed.empty() ? "" : " *");
  }
  if (passed > kTightestPasses) std::printf("  and %zu rows that pass with more margin\n", passed - kTightestPasses);
  if (not_measured > 0) std::printf("  and %zu rows that were not measured\n", not_measured);
  std::printf("* limit rests on one source\n");
}

std::string html_page(const PageHead& head, std::span<const Judged> all) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(head.beams) +
      "</title>\n<style>body{font:14px sans-serif;margin:2em;max-width:80em}table{border-collapse:collapse;margin:1em "
      "0}th,td{padding:.25em .7em;text-align:left;border-bottom:1px solid #ddd}td.n{text-align:right;"
      "font-variant-numeric:tabular-nums}.fail{background:#fbd5d5}.nodata{background:#e8e8e8}.within{background:#"
      "fdeac0}"
      ".reaim{background:#e3f0fb}.pass{background:#dff3df}</style></head>\n<body><h1>" +
      escaped(head.beams) + "</h1>\n<p>" + escaped(head.function + head.market) + "</p>\n";
  const bool one = one_traffic(all);
  if (!all.empty() && one) page += "<p>" + escaped(traffic_text(all.front())) + "</p>\n";
  page += std::string("<h2>Rules</h2>\n<table><tr><th>verdict</th><th>rule</th><th>document</th><th>rows</th>") +
          "<th>aim</th>" + (one ? "" : "<th>side of traffic</th>") + "</tr>\n";
  for (const Judged& judged : all) {
    const CheckResult& r = judged.result;
    const char* shade = r.verdict == RuleVerdict::kPass ? "pass" : r.verdict == RuleVerdict::kFail ? "fail" : "within";
    page += std::string("<tr class=\"") + shade + "\"><td>" + conclusion(r.verdict) + "</td><td>" +
            escaped(r.rule_name + (all.front().beam != judged.beam ? ", " + judged.beam : "")) + "</td><td>" +
            escaped(r.document) + "</td><td>" + escaped(summary_of(judged)) + "</td><td>" + escaped(aim_of(r)) +
            (r.aim_unconfirmed.empty() ? "" : " *") + (one ? "" : "</td><td>" + escaped(traffic_text(judged))) +
            "</td></tr>\n";
  }
  page +=
      "</table>\n<h2>Rows, the worst first</h2>\n<table><tr><th>rule</th><th>row</th><th>clause</th><th>limit</th>"
      "<th>value</th><th>unit</th><th>at H, V in deg</th><th>margin</th><th>verdict</th></tr>\n";
  for (const auto& [judged, row] : worst_first(all)) {
    std::string value = row->has_value ? value_text(row->unit, row->value(), 3) : "-";
    if (row->has_value && row->resolution > 0.0) value += " ± " + resolution_text(*row);
    page += std::string("<tr class=\"") + colour_of(*row) + "\"><td>" + escaped(judged->result.rule_id) + "</td><td>" +
            escaped(row->id) + "</td><td>" + escaped(row->clause) + "</td><td class=\"n\">" +
            escaped(limits_text(*row)) + "</td><td class=\"n\">" + escaped(value) + "</td><td>" + escaped(row->unit) +
            "</td><td class=\"n\">" + escaped(place_of(*row)) + "</td><td class=\"n\">" +
            escaped(number_of_percent(*row)) + "</td><td>" + escaped(verdict_text(*row)) +
            (row->unconfirmed.empty() ? "" : " *") + "</td></tr>\n";
  }
  return page +
         "</table>\n<p>Margin: in parts of the limit. ±: what the file's own grid and digits leave open. * the limit "
         "(or "
         "the aim) rests on one source.</p>\n</body></html>\n";
}

}  // namespace phare
