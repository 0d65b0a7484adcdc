// The lower half of the page of a drive: processes, times, effects, hashes. Tables that nobody reads in a meeting and
// everybody wants when something is odd.
#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

#include "config/base/shell_word.h"
#include "tools/report.h"
#include "tools/report_text.h"

namespace phare {
namespace {

using nlohmann::json;

class Tables {
 public:
  explicit Tables(const json& report) : report_(report), summary_(report["summary"]) {}

  std::string html() {
    counts();
    timings();
    effects();
    light_switch();
    law();
    levels();
    messages();
    lamps();
    inputs();
    return page_.str();
  }

 private:
  void counts() {
    page_ << "<p>" << value_text(summary_, "frames") << " frames drawn";
    if (summary_.contains("frames_before"))
      page_ << " since the picture was started again, " << value_text(summary_, "frames_before") << " before";
    if (summary_.contains("device")) page_ << " on " << value_text(summary_, "device");
    if (summary_.contains("frames_per_s")) {
      page_ << ", " << value_text(summary_, "frames_per_s", "%.3g")
            << " frames a second: all frames after the first by all seconds since";
      if (summary_.contains("frames_per_s_median"))
        page_ << "; " << value_text(summary_, "frames_per_s_median", "%.3g") << " by the median interval";
    }
    std::uint64_t lost = 0;
    for (const auto& [process, counts] : summary_["messages"].items()) lost += counts.value("lost", std::uint64_t{0});
    page_ << ". " << lost << " messages lost, " << value_text(summary_, "restarts") << " restarts.";
    if (summary_.contains("self_audit") && summary_["self_audit"].contains("residual_percent"))
      page_ << " Self-audit: " << value_text(summary_["self_audit"]["residual_percent"], "p99", "%.2g")
            << " % off float64, 99th percentile of the pixels.";
    page_ << "</p>";
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
             "class=\"text\">because</th><th class=\"text\">needs</th><th>passes</th><th>MB</th><th>ms</th></tr>";
    for (const json& row : rows) {
      page_ << "<tr><td>" << value_text(row, "name") << "</td>";
      for (const char* key : {"level", "because", "needs"})
        page_ << "<td class=\"text\">" << value_text(row, key) << "</td>";
      page_ << "<td>" << value_text(row, "passes") << "</td><td>" << number(row.value("bytes", 0.0) / 1e6, "%.1f")
            << "</td><td>" << value_text(row, "ms") << "</td></tr>";
    }
    page_ << "</table></div><p>Of the last frame, over all its views; ms on the device: median of the frames in which "
             "the effect had passes of its own. What draws within the lamp pass is timed with that. Any other moment: "
             "phare drive … --explain --cost.</p>";
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
    for (const char* what : {"rig", "scene", "vehicle", "cockpit", "traffic", "drive"}) {
      if (!report_.contains(what)) continue;
      page_ << "<tr><td>" << what << "</td><td class=\"text\">" << value_text(report_[what], "file")
            << "</td><td class=\"text\"><code>" << escaped(report_[what].value("content_hash", ""))
            << "</code></td></tr>";
    }
    page_ << "<tr><td>Phare</td><td class=\"text\">" << value_text(report_, "version") << ", commit "
          << value_text(report_, "commit") << "</td><td class=\"text\"><code>";
    for (const json& word : report_["command"]) page_ << escaped(shell_word(word.get<std::string>())) << ' ';
    page_ << "</code></td></tr></table></div>";
  }

  const json& report_;
  const json& summary_;
  std::ostringstream page_;
};

}  // namespace

std::string report_tables(const nlohmann::json& report) {
  return Tables(report).html();
}

}  // namespace phare
