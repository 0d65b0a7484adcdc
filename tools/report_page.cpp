// The page of a drive: static HTML, style within, pictures beside it. No script.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>

#include "tools/report.h"

namespace phare {
namespace {

using nlohmann::json;

constexpr const char* kStyle = R"(
:root{--bg:#0b0e13;--card:#141922;--line:#242c38;--ink:#e6eaf0;--dim:#8e9aab;--lamp:#ffd48a;--bad:#ff8a7a}
*{box-sizing:border-box}body{margin:0;background:var(--bg);color:var(--ink);font:15px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
header{position:relative}header img{display:block;width:100%;max-height:72vh;object-fit:cover}
header .title{padding:28px max(24px,calc(50vw - 560px)) 20px;background:linear-gradient(transparent,var(--bg) 85%)}
header img+.title{position:absolute;left:0;right:0;bottom:0;padding-top:120px}
h1{margin:0;font-size:34px;font-weight:650;letter-spacing:-.01em}h1 span{color:var(--lamp)}
h2{margin:44px 0 14px;font-size:13px;font-weight:600;letter-spacing:.09em;text-transform:uppercase;color:var(--lamp)}
main{max-width:1120px;margin:0 auto;padding:0 24px 72px}p{margin:6px 0;color:var(--dim)}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin-top:20px}
.fact{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:14px 16px}
.fact b{display:block;font-size:24px;font-weight:600;font-variant-numeric:tabular-nums;overflow-wrap:anywhere}.fact i{font-style:normal;color:var(--dim);font-size:13px}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(320px,1fr));gap:16px}figure{margin:0}
figure img,video{display:block;width:100%;border-radius:10px;border:1px solid var(--line);background:#000}figcaption{padding:8px 2px 0;color:var(--dim);font-size:13px}
.scroll{overflow-x:auto;border:1px solid var(--line);border-radius:10px;background:var(--card)}
table{border-collapse:collapse;width:100%;font-size:14px}th,td{padding:8px 14px;text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums;border-top:1px solid var(--line)}
tr:first-child>*{border-top:0}th{color:var(--dim);font-weight:500}th:first-child,td:first-child,td.text,th.text{text-align:left}
code{font:12px/1.4 ui-monospace,Menlo,Consolas,monospace;color:var(--dim)}.bad{color:var(--bad)}
.bar{display:inline-block;height:.8em;background:var(--lamp);border-radius:2px;margin-right:.4em}
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string number(double value, const char* format = "%.3g") {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A value as short text; "–" when it is not there.
std::string value_text(const json& object, const char* key, const char* format = "%.2f") {
  if (!object.is_object() || !object.contains(key)) return "–";
  const json& value = object[key];
  if (value.is_number_float()) return number(value.get<double>(), format);
  if (value.is_number()) return value.dump();
  if (value.is_string()) return escaped(value.get<std::string>());
  return "–";
}

std::string short_hash(const std::string& hash) {
  const std::size_t colon = hash.find(':');
  return escaped(colon == std::string::npos ? hash.substr(0, 12) : hash.substr(colon + 1, 12));
}

class Page {
 public:
  Page(const json& report, const std::filesystem::path& out)
      : report_(report), summary_(report["summary"]), out_(out) {}

  std::string html() {
    head();
    facts();
    pictures();
    timings();
    effects();
    light_switch();
    picked();
    self_audit();
    law();
    fail_safe();
    levels();
    messages();
    lamps();
    inputs();
    page_ << "</main></body></html>\n";
    return page_.str();
  }

 private:
  bool there(const std::string& file) const {
    std::error_code ignored;
    return std::filesystem::exists(out_ / file, ignored);
  }

  void head() {
    const std::string rig = escaped(report_["rig"].value("name", ""));
    page_ << "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
             "content=\"width=device-width\">"
          << "<title>Phare · " << rig << "</title><style>" << kStyle << "</style></head><body><header>";
    if (there("drivers_view.png")) page_ << "<img src=\"drivers_view.png\" alt=\"The driver's view\">";
    page_ << "<div class=\"title\"><h1><span>Phare</span> · " << rig << "</h1><p>"
          << escaped(report_.value("made_at", "")) << " · "
          << (report_.value("lockstep", false) ? "lockstep" : "real time");
    if (summary_.contains("device")) page_ << " · " << value_text(summary_, "device");
    page_ << "</p></div></header><main>";
    if (report_.contains("why")) page_ << "<p class=\"bad\">Ended early: " << value_text(report_, "why") << "</p>";
  }

  void fact(const std::string& value, const std::string& what) {
    page_ << "<div class=\"fact\"><b>" << value << "</b><i>" << what << "</i></div>";
  }

  void facts() {
    page_ << "<div class=\"facts\">";
    if (summary_.contains("sim_time_s")) fact(value_text(summary_, "sim_time_s", "%.1f") + " s", "driven");
    fact(value_text(summary_, "frames"), "frames drawn");
    if (summary_.contains("frame_ms")) {
      fact(value_text(summary_["frame_ms"], "median") + " ms", "a frame, median");
      fact(value_text(summary_["frame_ms"], "p99") + " ms", "a frame, 99th percentile");
    }
    if (summary_.contains("frames_per_s")) {
      const std::string median =
          summary_.contains("frames_per_s_median")
              ? "; " + value_text(summary_, "frames_per_s_median", "%.3g") + " by the median interval"
              : "";
      fact(value_text(summary_, "frames_per_s", "%.3g"), "frames a second: all frames by all seconds" + median);
    }
    std::uint64_t lost = 0;
    for (const auto& [process, counts] : summary_["messages"].items()) lost += counts.value("lost", std::uint64_t{0});
    fact(std::to_string(lost), "messages lost");
    if (summary_.contains("self_audit") && summary_["self_audit"].contains("residual_percent")) {
      fact(value_text(summary_["self_audit"]["residual_percent"], "p99", "%.2g") + " %",
           "self-audit residual, 99th percentile");
    }
    fact(value_text(summary_, "restarts"), "restarts");
    page_ << "</div>";
  }

  void picture(const std::string& file, const std::string& caption) {
    if (there(file))
      page_ << "<figure><a href=\"" << file << "\"><img loading=\"lazy\" src=\"" << file << "\" alt=\"" << caption
            << "\"></a><figcaption>" << caption << "</figcaption></figure>";
  }

  void pictures() {
    if (there("drive.mp4")) page_ << "<h2>The drive</h2><video controls muted loop src=\"drive.mp4\"></video>";
    if (there("birds_eye.png") || there("wall_25m.png")) {
      page_ << "<h2>The beam</h2><div class=\"pictures\">";
      picture("birds_eye.png", "Illuminance on the road from above, lx");
      picture("wall_25m.png", "On a wall 25 m ahead, lx");
      page_ << "</div>";
    }
    if (there("contact_sheet.png")) {
      page_ << "<h2>Along the road</h2>";
      picture("contact_sheet.png", "Frames of the drive in order");
    }
  }

  void timing_row(const std::string& name, const json& times) {
    page_ << "<tr><td>" << escaped(name) << "</td>";
    for (const char* key : {"min", "median", "p95", "p99", "max"})
      page_ << "<td>" << value_text(times, key, "%.3f") << "</td>";
    page_ << "<td>" << value_text(times, "count") << "</td></tr>";
  }

  void timings() {
    if (!summary_.contains("frame_ms")) return;
    page_ << "<h2>Time, ms</h2><div "
             "class=\"scroll\"><table><tr><th></th><th>min</th><th>median</th><th>p95</th><th>p99</th><th>max</"
             "th><th>frames</th></tr>";
    timing_row("frame", summary_["frame_ms"]);
    if (summary_.contains("frame_ms_without_capture"))
      timing_row("frame, not read back", summary_["frame_ms_without_capture"]);
    if (summary_.contains("interval_ms")) timing_row("frame to frame", summary_["interval_ms"]);
    if (summary_.contains("gpu_ms")) timing_row("GPU", summary_["gpu_ms"]);
    if (summary_.contains("pass_ms")) {
      for (const auto& [pass, times] : summary_["pass_ms"].items()) timing_row("pass " + pass, times);
    }
    page_ << "</table></div><p>" << value_text(summary_, "passes") << " passes, " << value_text(summary_, "draws")
          << " draws, " << value_text(summary_, "triangles") << " triangles a frame.</p>";
  }

  /// What the newest frame called for, and why.
  void effects() {
    const json rows = report_["processes"].value("visual-0", json::object()).value("effects", json::array());
    if (rows.empty()) return;
    page_ << "<h2>Effects</h2><div class=\"scroll\"><table><tr><th></th><th class=\"text\">level</th><th "
             "class=\"text\">because</th><th class=\"text\">needs</th></tr>";
    for (const json& row : rows) {
      page_ << "<tr><td>" << value_text(row, "name") << "</td>";
      for (const char* key : {"level", "because", "needs"})
        page_ << "<td class=\"text\">" << value_text(row, key) << "</td>";
      page_ << "</tr>";
    }
    page_ << "</table></div><p>Of the last frame. Any other moment: phare drive … --explain.</p>";
  }

  /// How many frames it took, as bars: 1 is the first frame that could show the new beam.
  void light_switch() {
    const json switches = summary_.value("switch_to_photon", json::object());
    const json frames = switches.value("frames", json::object());
    if (frames.empty()) return;
    std::map<int, std::uint64_t> histogram;
    std::uint64_t most = 1;
    for (const auto& [count, changes] : frames.items()) {
      histogram[std::atoi(count.c_str())] = changes.get<std::uint64_t>();
      most = std::max(most, changes.get<std::uint64_t>());
    }
    page_ << "<h2>Light switch to photon</h2><div class=\"scroll\"><table><tr><th>frames</th><th "
             "class=\"text\">changes of the beam</th></tr>";
    for (const auto& [count, changes] : histogram) {
      page_ << "<tr><td>" << count << "</td><td class=\"text\"><span class=\"bar\" style=\"width:"
            << number(30.0 * static_cast<double>(changes) / static_cast<double>(most), "%.2f") << "em\"></span> "
            << changes << "</td></tr>";
    }
    page_ << "</table></div><p>From the message that moved the stalk to the finished first frame with the new beam: "
          << value_text(switches["ms"], "median") << " ms median, " << value_text(switches["ms"], "max")
          << " ms at most";
    if (report_.value("lockstep", false)) page_ << " of wall time; frames are counted in simulated time";
    page_ << ".</p>";
  }

  /// What a budget or a tolerance had picked, and what the governor made of it.
  void picked() {
    const json picked = summary_.value("picked", json::object());
    if (picked.empty()) return;
    page_ << "<h2>Accuracy and time</h2><p>" << value_text(picked, "level") << ": " << value_text(picked, "why")
          << ".</p>";
    const json governor = picked.value("governor", json::object());
    if (governor.empty()) return;
    const json steps = governor.value("steps", json::array());
    page_ << "<p>The governor kept " << value_text(governor, "budget_ms", "%.4g") << " ms in " << steps.size()
          << " steps; at the end: " << value_text(governor, "now") << ".</p>";
    if (steps.empty()) return;
    page_ << "<div class=\"scroll\"><table><tr><th>at, s</th><th class=\"text\">from</th><th class=\"text\">to</th>"
             "<th>p95 of a window, ms</th></tr>";
    for (const json& step : steps)
      page_ << "<tr><td>" << value_text(step, "time_s") << "</td><td class=\"text\">" << value_text(step, "from")
            << "</td><td class=\"text\">" << value_text(step, "to") << "</td><td>" << value_text(step, "p95_ms", "%.3g")
            << "</td></tr>";
    page_ << "</table></div>";
  }

  /// What pixels computed again in float64 are off by, and whether their level had said so.
  void self_audit() {
    const json audit = summary_.value("self_audit", json::object());
    if (audit.value("pixels", 0) == 0) return;
    const json percent = audit.value("residual_percent", json::object());
    page_ << "<h2>Self-audit</h2><p>" << value_text(audit, "pixels") << " lit pixels of " << value_text(audit, "audits")
          << " frames computed again in float64: off by " << value_text(percent, "median", "%.2g")
          << " % in the median, " << value_text(percent, "p99", "%.2g") << " % 99th percentile, "
          << value_text(percent, "max", "%.2g") << " % at most, where there is more than 0.01 lx.</p>";
    if (!audit.contains("bound"))
      page_ << "<p>The level states no bound of its own: by vertex the size of the triangles decides.</p>";
    else if (!audit.contains("worst_of_bound"))
      page_ << "<p>None was judged: tables of different aims are summed on a grid of their own.</p>";
    else
      page_ << "<p>What the level states, " << value_text(audit, "bound") << ": the worst came to "
            << number(100.0 * audit["worst_of_bound"].get<double>()) << " % of it.</p>";
    if (audit.contains("first_over"))
      page_ << "<p class=\"bad\">" << value_text(audit, "over_bound") << " are off by more, first "
            << value_text(audit["first_over"], "text") << ".</p>";
  }

  /// Pictures that did not show what the stalk asked for, and why.
  void law() {
    const json law = summary_.value("law", json::object());
    if (law.empty()) return;
    const auto answers = law.value("answers", std::uint64_t{0}), in_frame = law.value("in_frame", std::uint64_t{0});
    const json delay = law.value("delay_ms", json::object());
    page_ << "<h2>Control law</h2><p>" << answers << " answers; from the pose to the answer to it "
          << value_text(delay, "median") << " ms median, " << value_text(delay, "p99") << " ms 99th percentile, "
          << value_text(delay, "max") << " ms at most; " << in_frame
          << " within a frame's time. Frames without an answer, on low beam: " << value_text(law, "silent_frames")
          << "; answers that were not followed: " << value_text(law, "refused") << ".</p>";
    if (law.contains("why")) page_ << "<p class=\"bad\">" << value_text(law, "why") << "</p>";
  }

  void fail_safe() {
    const json fail_safe = summary_.value("fail_safe", json::object());
    const auto held = summary_.value("frames_stale_pose", std::uint64_t{0});
    const auto frames = fail_safe.value("frames", std::uint64_t{0});
    if (frames == 0 && held == 0) return;
    page_ << "<h2>What was missing</h2>";
    if (frames > 0)
      page_ << "<p class=\"bad\">" << frames << " pictures with the low beam of the fail-safe, "
            << value_text(fail_safe, "count") << " times:</p>";
    for (const json& once : fail_safe.value("times", json::array()))
      page_ << "<p>" << value_text(once, "from_s", "%.3f") << " to " << value_text(once, "to_s", "%.3f")
            << " s: " << value_text(once, "because") << "</p>";
    if (held > 0) page_ << "<p class=\"bad\">" << held << " pictures with a pose that was held: no VehicleState.</p>";
  }

  /// Level auto: which model of the car ran when, and what called for it.
  void levels() {
    const json dynamics = report_["processes"].value("dynamics", json::object()).value("auto", json::object());
    const json history = dynamics.value("history", json::array());
    if (dynamics.empty()) return;
    page_ << "<h2>Level of the car</h2><p>";
    const json seconds = dynamics.value("seconds", json::object());
    for (const auto& [level, spent] : seconds.items())
      page_ << escaped(level) << ' ' << value_text(seconds, level.c_str(), "%.1f") << " s, ";
    page_ << value_text(dynamics, "switches") << " switches.</p>";
    if (history.empty()) return;
    page_ << "<div class=\"scroll\"><table><tr><th>at, s</th><th class=\"text\">from</th><th class=\"text\">to</th>"
             "<th class=\"text\">because</th><th>fact</th></tr>";
    for (const json& change : history) {
      page_ << "<tr><td>" << value_text(change, "time_s", "%.3f") << "</td>";
      for (const char* key : {"from", "to", "because"})
        page_ << "<td class=\"text\">" << value_text(change, key) << "</td>";
      page_ << "<td>" << value_text(change, "fact", "%.3g") << "</td></tr>";
    }
    page_ << "</table></div>";
  }

  void messages() {
    page_ << "<h2>Processes</h2><div "
             "class=\"scroll\"><table><tr><th></th><th>received</th><th>lost</th><th>late</th><th>duplicate</th>"
             "<th>refused</th><th>memory, MiB</th><th>peak, MiB</th><th class=\"text\">ended</th></tr>";
    for (const auto& [process, counts] : summary_["messages"].items()) {
      page_ << "<tr><td>" << escaped(process) << "</td>";
      for (const char* key : {"received", "lost", "late", "duplicate", "refused"})
        page_ << "<td>" << value_text(counts, key) << "</td>";
      const json memory = summary_["memory"].value(process, json::object());
      for (const char* key : {"rss_kib", "peak_kib"}) {
        page_ << "<td>" << (memory.contains(key) ? number(memory[key].get<double>() / 1024.0, "%.1f") : "–") << "</td>";
      }
      page_ << "<td class=\"text\">" << value_text(report_["ends"], process.c_str()) << "</td></tr>";
    }
    page_ << "</table></div>";
    for (const json& restart : report_["restarts"]) {
      page_ << "<p>" << value_text(restart, "process") << " restarted at " << value_text(restart, "at_s") << " s after "
            << value_text(restart, "because") << ".</p>";
    }
  }

  void lamps() {
    page_ << "<h2>Lamps</h2><div class=\"scroll\"><table><tr><th>design</th><th class=\"text\">lamp</th><th "
             "class=\"text\">function</th>"
             "<th>flux, lm</th><th>peak, cd</th><th class=\"text\">file</th><th class=\"text\">content</th></tr>";
    for (const json& lamp : report_["lamps"]) {
      page_ << "<tr><td>" << value_text(lamp, "design") << "</td><td class=\"text\">" << value_text(lamp, "lamp")
            << "</td><td class=\"text\">" << value_text(lamp, "function") << "</td><td>"
            << value_text(lamp, "flux_lm", "%.0f") << "</td><td>" << value_text(lamp, "peak_cd", "%.0f")
            << "</td><td class=\"text\">" << value_text(lamp, "file") << "</td><td class=\"text\"><code>"
            << short_hash(lamp.value("content_hash", "")) << "</code></td></tr>";
    }
    page_ << "</table></div>";
    const json visual = report_["processes"].value("visual-0", json::object());
    for (const json& aim : visual.value("aims", json::array()))
      page_ << "<p>" << value_text(aim, "design") << ", " << value_text(aim, "lamp") << ": " << value_text(aim, "text")
            << ".</p>";
    for (const json& end : visual.value("table_ends", json::array()))
      page_ << "<p class=\"bad\">" << value_text(end, "design") << ", " << value_text(end, "text")
            << "; it is drawn dark, as the file says nothing there.</p>";
  }

  void inputs() {
    page_ << "<h2>Made from</h2><div class=\"scroll\"><table>";
    for (const char* what : {"rig", "scene", "vehicle", "cockpit", "drive"}) {
      if (!report_.contains(what)) continue;
      page_ << "<tr><td>" << what << "</td><td class=\"text\">" << value_text(report_[what], "file")
            << "</td><td class=\"text\"><code>" << escaped(report_[what].value("content_hash", ""))
            << "</code></td></tr>";
    }
    page_ << "<tr><td>Phare</td><td class=\"text\">" << value_text(report_, "version") << ", commit "
          << value_text(report_, "commit") << "</td><td class=\"text\"><code>";
    for (const json& word : report_["command"]) page_ << escaped(word.get<std::string>()) << ' ';
    page_ << "</code></td></tr></table></div><p>Everything in numbers: <a style=\"color:inherit\" "
             "href=\"report.json\">report.json</a></p>";
  }

  const json& report_;
  const json& summary_;
  std::filesystem::path out_;
  std::ostringstream page_;
};

}  // namespace

std::string report_page(const nlohmann::json& report, const std::filesystem::path& out) {
  return Page(report, out).html();
}

}  // namespace phare
