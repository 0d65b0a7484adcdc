#include "tools/cost/page.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace phare::cost {
namespace {

constexpr const char* kStyle = R"(
body{margin:0 auto;max-width:1000px;padding:24px;color:#1b2430;background:#fff;font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
h1{margin:0 0 4px;font-size:28px}h2{margin:44px 0 6px;font-size:20px}p{margin:6px 0;color:#4a5666}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:13px;width:100%}th,td{padding:4px 10px;text-align:right;white-space:nowrap;border-top:1px solid #dde3ea;font-variant-numeric:tabular-nums}
th:first-child,td:first-child,td.text{text-align:left}tr.worth td:first-child{font-weight:600;color:#00538a}
svg{max-width:100%;height:auto}code{font-size:13px}@media print{h2{break-before:page}}
)";

std::string html(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else
      result += c;
  }
  return result;
}

std::string cell(const std::optional<double>& value) {
  char text[48];
  std::snprintf(text, sizeof text, "<td>%.3g</td>", value.value_or(0.0));
  return value ? text : "<td></td>";
}

std::string table(const Ladder& ladder) {
  std::string rows = "<div class=\"scroll\"><table><tr><th>level</th><th>rms, " + html(ladder.error_unit) +
                     "</th><th>99 %</th><th>worst</th><th>median, " + html(ladder.time_unit) +
                     "</th><th>95 %</th><th>MiB</th><th></th></tr>\n";
  for (const Level& level : ladder.levels) {
    std::optional<double> mib;
    if (level.memory_bytes) mib = static_cast<double>(*level.memory_bytes) / 1048576.0;
    rows += level.efficient ? "<tr class=\"worth\"><td>" : "<tr><td>";
    rows += html(level.name) + "</td>" + cell(level.error.rms) + cell(level.error.p99) + cell(level.error.max) +
            cell(level.time.median) + cell(level.time.p95) + cell(mib) + "<td class=\"text\">" + html(level.note) +
            "</td></tr>\n";
  }
  return rows + "</table></div>\n";
}

}  // namespace

std::string page(const nlohmann::json& json, const std::vector<Ladder>& ladders,
                 const std::vector<std::string>& plots) {
  std::string text =
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>What accuracy costs</title><style>";
  text += std::string(kStyle) +
          "</style>\n<h1>What accuracy costs</h1>\n<p>Every level of every approximation: how far "
          "it is from the truth and what it takes, measured on this machine. Bold levels are worth it: none is at once "
          "as exact and cheaper.</p>\n<p>";
  for (const char* key : {"date", "version", "processor", "device", "scene", "lamp", "vehicle", "command"})
    if (json.contains(key))
      text += std::string(key) + ": <code>" + html(json[key].get<std::string>()) + "</code><br>\n";
  text += "</p>\n";
  for (std::size_t i = 0; i < ladders.size(); ++i) {
    text += "<h2>" + html(ladders[i].name) + "</h2>\n<p>" + html(ladders[i].what) +
            ". Truth: " + html(ladders[i].reference) + ".</p>\n";
    if (i < plots.size()) text += plots[i].substr(std::min(plots[i].find("<svg"), plots[i].size())) + "\n";
    text += table(ladders[i]);
  }
  return text + "</html>\n";
}

}  // namespace phare::cost
