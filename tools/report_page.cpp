// The page of a drive: what was driven and how good it was first, processes and hashes folded below. Static HTML, style
// within, no script; pictures beside it, or within it to be mailed.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "config/base/base64.h"
#include "tools/drive_series.h"
#include "tools/report.h"
#include "tools/report_text.h"
#include "tools/time_plot.h"

namespace phare {
namespace {

using nlohmann::json;

constexpr const char* kStyle = R"(
:root{--bg:#0b0e13;--card:#141922;--line:#242c38;--ink:#e6eaf0;--dim:#8e9aab;--lamp:#ffd48a;--bad:#ff8a7a;--good:#8fd694}
*{box-sizing:border-box}body{margin:0;background:var(--bg);color:var(--ink);font:15px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
header{position:relative}header img{display:block;width:100%;max-height:72vh;object-fit:cover}
header .title{padding:28px max(24px,calc(50vw - 560px)) 20px;background:linear-gradient(transparent,var(--bg) 85%)}
header img+.title{position:absolute;left:0;right:0;bottom:0;padding-top:120px}
h1{margin:0;font-size:34px;font-weight:650;letter-spacing:-.01em}h1 span{color:var(--lamp)}
h2{margin:44px 0 14px;font-size:13px;font-weight:600;letter-spacing:.09em;text-transform:uppercase;color:var(--lamp)}
h3{margin:26px 0 8px;font-size:16px;font-weight:600}h3 span{color:var(--dim);font-weight:400}
main{max-width:1120px;margin:0 auto;padding:0 24px 72px}p{margin:6px 0;color:var(--dim)}a{color:inherit}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin-top:20px}
.fact{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:14px 16px}
.fact b{display:block;font-size:24px;font-weight:600;font-variant-numeric:tabular-nums;overflow-wrap:anywhere}.fact i{font-style:normal;color:var(--dim);font-size:13px}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(320px,1fr));gap:16px}figure{margin:0}
figure img,video{display:block;width:100%;border-radius:10px;border:1px solid var(--line);background:#000}figcaption{padding:8px 2px 0;color:var(--dim);font-size:13px}
.scroll{overflow-x:auto;border:1px solid var(--line);border-radius:10px;background:var(--card)}
table{border-collapse:collapse;width:100%;font-size:14px}th,td{padding:8px 14px;text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums;border-top:1px solid var(--line)}
tr:first-child>*{border-top:0}th{color:var(--dim);font-weight:500}th:first-child,td:first-child,td.text,th.text{text-align:left}
code{font:12px/1.4 ui-monospace,Menlo,Consolas,monospace;color:var(--dim)}.bad{color:var(--bad)}.good{color:var(--good)}
.bar{display:inline-block;height:.8em;background:var(--lamp);border-radius:2px;margin-right:.4em}
.plot{display:block;width:100%;margin:0 0 10px;background:var(--card);border:1px solid var(--line);border-radius:10px}
.plot text{fill:var(--dim);font-size:12px}.plot .name{fill:var(--ink);font-size:13px}.plot .grid{stroke:var(--line);fill:none}
.plot .line{fill:none;stroke-width:1.6;stroke-linejoin:round}.plot .high{fill:#5b8cff;opacity:.14}.plot .dark{fill:#000;opacity:.45}
details{margin-top:48px;border-top:1px solid var(--line)}summary{padding:14px 0;cursor:pointer;color:var(--dim)}
@media print{:root{--bg:#fff;--card:#fff;--line:#ccc;--ink:#111;--dim:#444;--lamp:#7a4b00;--bad:#a01808;--good:#116611}
body{font-size:11pt}main{max-width:none;padding:0}video,.screen{display:none}.fact,.plot,figure,tr{break-inside:avoid}h2,h3{break-after:avoid}
header img{max-height:9cm}header img+.title{position:static;padding:8px 0}header .title{background:none;padding:0}.plot .dark{opacity:.12}
th,td{padding:3px 8px;white-space:normal}.pictures{grid-template-columns:1fr 1fr}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

class Page {
 public:
  Page(const json& report, const std::filesystem::path& out, PageFiles files)
      : report_(report),
        summary_(report["summary"]),
        visual_(report["processes"].value("visual-0", json::object())),
        out_(out),
        within_(files == PageFiles::kWithin) {
    if (auto read = read_drive_series(out); read && *read) series_ = std::move(**read);
  }

  std::string html() {
    head();
    facts();
    picked();
    fail_safe();
    video();
    plots();
    versus();
    beams();
    verdicts();
    pictures();
    page_ << "<details><summary>Processes, times, effects, files and their hashes</summary>" << report_tables(report_);
    self_audit();
    if (!within_) page_ << "<p>Everything in numbers: <a href=\"report.json\">report.json</a></p>";
    page_ << "</details></main></body></html>\n";
    return page_.str();
  }

 private:
  bool there(const std::string& file) const {
    std::error_code ignored;
    return std::filesystem::exists(out_ / file, ignored);
  }

  /// Where a file of the folder is found from the page: beside it, or in it.
  std::string url(const std::string& file, const char* type) const {
    if (!within_) return escaped(percent_encoded(file));
    std::ifstream stream(out_ / file, std::ios::binary);
    return std::string("data:") + type + ";base64," + base64(std::string(std::istreambuf_iterator<char>(stream), {}));
  }

  void head() {
    const std::string rig = escaped(report_["rig"].value("name", ""));
    page_ << "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
             "content=\"width=device-width\">"
          << "<title>Phare · " << rig << "</title><style>" << kStyle << "</style></head><body><header>";
    if (there("drivers_view.png"))
      page_ << "<img src=\"" << url("drivers_view.png", "image/png") << "\" alt=\"The driver's view\">";
    page_ << "<div class=\"title\"><h1><span>Phare</span> · " << rig << "</h1><p>";
    std::string designs;
    for (const json& design : visual_.value("designs", json::array()))
      designs +=
          (designs.empty() ? "" : ", ") + value_text(design, "name") + " " + value_text(design, "lit_s", "%.0f") + " s";
    if (!designs.empty()) page_ << designs << "<br>";
    page_ << (report_.contains("drive") ? value_text(report_["drive"], "file") + " · " : "")
          << escaped(report_.value("made_at", "")) << " · "
          << (report_.value("lockstep", false) ? "lockstep" : "real time");
    page_ << "</p></div></header><main>";
    if (report_.contains("why")) page_ << "<p class=\"bad\">Ended early: " << value_text(report_, "why") << "</p>";
  }

  void fact(const std::string& value, const std::string& what) {
    page_ << "<div class=\"fact\"><b>" << value << "</b><i>" << what << "</i></div>";
  }

  /// Least to greatest, in the same words wherever it stands.
  static std::string range_text(const json& spread, const char* format) {
    return number(spread.value("min", 0.0), format) + " to " + number(spread.value("max", 0.0), format);
  }

  /// How good it was: of the figures those that a lighting engineer asks for first.
  void facts() {
    const json drove = report_.value("drove", json::object());
    page_ << "<div class=\"facts\">";
    if (drove.contains("driven_s"))
      fact(value_text(drove, "driven_s", "%.1f") + " s",
           "driven, " + value_text(drove, "distance_m", "%.0f") + " m along the road");
    else if (summary_.contains("sim_time_s"))
      fact(value_text(summary_, "sim_time_s", "%.1f") + " s", "driven");
    if (drove.contains("speed_kmh"))
      fact(value_text(drove["speed_kmh"], "median", "%.0f") + " km/h",
           "median speed, " + value_text(drove["speed_kmh"], "max", "%.0f") + " at most");
    for (const char* side : {"left", "right"}) {
      const json reach = drove.value("reach_m", json::object()).value(std::string("reach_3lx_") + side + "_m", json());
      if (reach.is_object())
        fact(value_text(reach, "median", "%.0f") + " m", std::string("3 lx on the ") + side +
                                                             " edge of the lane reach so far (median), " +
                                                             range_text(reach, "%.0f"));
    }
    if (drove.contains("cutoff_25m_m"))
      fact(value_text(drove["cutoff_25m_m"], "median", "%.2f") + " m",
           "cut-off on a wall at 25 m (median), " + range_text(drove["cutoff_25m_m"], "%.2f"));
    if (drove.contains("pitch_deg"))
      fact(range_text(drove["pitch_deg"], "%+.2f") + "°", "pitch with the slope of the road, positive nose down");
    if (const json best = first_low_beam(); best.is_object()) {
      if (!best["rules"].empty()) {
        const json& rule = best["rules"].front();
        const std::string verdict = rule.value("verdict", "");
        fact("<span class=\"" +
                 std::string(verdict == "fail"                                     ? "bad"
                             : verdict == "pass" || verdict == "within resolution" ? "good"
                                                                                   : "") +
                 "\">" + escaped(verdict) + "</span>",
             value_text(rule, "rule") + ", low beam of " + value_text(best, "design"));
      }
      if (best.contains("hspr"))
        fact(value_text(best["hspr"], "score", "%.2f"), "HSPR of that low beam: " + value_text(best["hspr"], "class"));
    }
    page_ << "</div>";
  }

  /// The low beam of the design that shone longest, where it was judged.
  json first_low_beam() const {
    std::string longest;
    double most_s = -1.0;
    for (const json& design : visual_.value("designs", json::array()))
      if (design.value("lit_s", 0.0) > most_s) most_s = design.value("lit_s", 0.0), longest = design.value("name", "");
    for (const json& row : report_.value("lamp_verdicts", json::array()))
      if (row.value("design", "") == longest && row.value("beam", "") == "low" && row.contains("rules")) return row;
    return nullptr;
  }

  void picture(const std::string& file, const std::string& caption) {
    if (!there(file)) return;
    const std::string at = url(file, "image/png"), image = "<img src=\"" + at + "\" alt=\"" + caption + "\">";
    page_ << "<figure>" << (within_ ? image : "<a href=\"" + at + "\">" + image + "</a>") << "<figcaption>" << caption
          << "</figcaption></figure>";
  }

  void video() {
    if (!there("drive.mp4")) return;
    page_ << "<div class=\"screen\"><h2>The drive, at its own speed</h2><video controls muted loop "
             "preload=\"metadata\" src=\""
          << url("drive.mp4", "video/mp4") << "\"></video></div>";
  }

  void plot(TimePlot plot) {
    if (std::ranges::all_of(plot.lines, [](const TimeSeries& line) { return line.value.empty(); })) return;
    plot.from_s = series_->speed_kmh.time_s.front(), plot.to_s = series_->speed_kmh.time_s.back();
    plot.bands = series_->lit;
    page_ << time_plot_svg(plot);
  }

  void plots() {
    if (!series_ || series_->rows < 2) return;
    page_ << "<h2>Over time</h2>";
    plot({.title = "Speed", .unit = "km/h", .lines = {series_->speed_kmh}, .from_zero = true});
    plot({.title = "Pitch with the slope of the road, nose down", .unit = "degrees", .lines = {series_->pitch_deg}});
    if (summary_of("cutoff_25m_m"))
      plot({.title = "Cut-off of the low beam on a wall at 25 m, above the road there",
            .unit = "m",
            .lines = {series_->cutoff_m}});
    for (const char* level : {"1lx", "3lx", "5lx"}) {
      TimePlot reach{
          .title = "Reach of " + std::string(level, 1) + " lx along the lane's edges", .unit = "m", .from_zero = true};
      for (TimeSeries line : series_->reach_m) {
        if (line.name.find(level) == std::string::npos) continue;
        const bool other = line.name.starts_with("versus_");
        line.name = line.name.find("left") != std::string::npos ? "left" : "right";
        if (visual_.contains("versus")) line.name = (other ? "B " : "A ") + line.name;
        reach.lines.push_back(std::move(line));
      }
      plot(std::move(reach));
    }
    plot({.title = "Veil over the eyes by lamps that shine into them",
          .unit = "cd/m²",
          .lines = series_->veil_cdm2,
          .from_zero = true});
    plot({.title = "Threshold increment by these lamps",
          .unit = "%",
          .lines = series_->threshold_increment_percent,
          .from_zero = true});
    plot({.title = "Discomfort by these lamps on de Boer's scale: 9 just seen, 1 unbearable",
          .unit = "1 to 9",
          .lines = series_->de_boer});
    if (!series_->probes_lx.empty())
      plot({.title = "At the probes", .unit = "lx", .lines = series_->probes_lx, .from_zero = true});
    page_ << "<p>Blue: high beam shines; darker: nothing does. Every frame in numbers: "
          << (within_ ? "<a download=\"drive.csv\" href=\"" + url("drive.csv", "text/csv") + "\">drive.csv</a>"
                      : "<a href=\"drive.csv\">drive.csv</a>")
          << "</p>";
  }

  bool summary_of(const char* key) const { return report_.value("drove", json::object()).contains(key); }

  static const char* seen_in_video(const std::string& compare) {
    if (compare == "flicker") return "In the video they take turns, half a second each.";
    if (compare == "difference") return "The video has the lux of B less that of A by colour.";
    if (compare == "ratio") return "The video has the lux of B over that of A by colour.";
    return "In the video A is on the left, B on the right.";
  }

  /// Two designs on the same drive: what differs in the picture, and how far each reached.
  void versus() {
    const json two = visual_.value("versus", json::object());
    if (two.empty()) return;
    page_ << "<h2>A beside B</h2><p>A: " << value_text(two, "a") << ". B: " << value_text(two, "b")
          << ". " << seen_in_video(two.value("compare", std::string()))
          << (two.value("aligned", false) ? " B is turned until both cut-offs stand equally high at 25 m." : "")
          << "</p><div class=\"pictures\">";
    picture("versus.png", "The same moment: A on the left, B on the right");
    picture("versus_difference.png", "Lux on what the driver sees, B less A");
    picture("versus_birds_eye.png", "Lux from above, B less A");
    picture("versus_ratio.png", "Lux from above, B over A");
    page_ << "</div>";
    const json reach = report_.value("drove", json::object()).value("reach_m", json::object());
    if (!reach.contains("versus_reach_1lx_left_m")) return;
    page_ << "<h3>Reach over the drive, m</h3><div class=\"scroll\"><table><tr><th>along the lane's edges</th>";
    for (const char* of : {"A", "B"})
      for (const char* what : {"least", "median", "greatest"}) page_ << "<th>" << of << ", " << what << "</th>";
    page_ << "<th>B less A, median</th></tr>";
    for (const char* level : {"1", "3", "5"})
      for (const char* side : {"left", "right"}) {
        const std::string name = std::string("reach_") + level + "lx_" + side + "_m";
        page_ << "<tr><td>" << level << " lx, " << side << "</td>";
        const json a = reach.value(name, json::object()), b = reach.value("versus_" + name, json::object());
        for (const json& one : {a, b})
          for (const char* key : {"min", "median", "max"}) page_ << "<td>" << value_text(one, key, "%.0f") << "</td>";
        page_ << "<td>" << number(b.value("median", 0.0) - a.value("median", 0.0), "%+.0f") << "</td></tr>";
      }
    page_ << "</table></div>";
  }

  /// Wall and bird's eye of every design that was lit; without their list those of the stills.
  void beams() {
    json designs = visual_.value("designs", json::array());
    if (designs.empty()) designs.push_back({{"index", -1}, {"in_the_stills", true}});
    bool any = false;
    for (const json& design : designs) {
      const std::string number = "_" + std::to_string(design.value("index", -1)) + ".png";
      const bool stills = design.value("in_the_stills", false);
      const std::string above = stills ? "birds_eye.png" : "birds_eye" + number,
                        wall = stills ? "wall_25m.png" : "wall_25m" + number;
      if (!there(above) && !there(wall)) continue;
      if (!std::exchange(any, true)) page_ << "<h2>Low beam of every design that was lit</h2>";
      if (design.contains("name"))
        page_ << "<h3>" << value_text(design, "name") << " <span>"
              << (design.value("lit_s", 0.0) > 0.0 ? "lit " + value_text(design, "lit_s", "%.1f") + " s of the drive"
                                                   : "beside it")
              << "</span></h3>";
      page_ << "<div class=\"pictures\">";
      picture(above, "Illuminance on the road from above, lx");
      picture(wall, "On a wall 25 m ahead, lx");
      page_ << "</div>";
    }
  }

  /// What the rule says of each beam, and how it is rated.
  void verdicts() {
    const json rows = report_.value("lamp_verdicts", json::array());
    if (rows.empty()) return;
    page_ << "<h2>The lamps by themselves</h2><div class=\"scroll\"><table><tr><th>design</th><th "
             "class=\"text\">beam</th>"
             "<th class=\"text\">rule</th><th class=\"text\">verdict</th><th>rows failed</th>"
             "<th class=\"text\">worst row</th><th>HSPR</th><th class=\"text\">class</th><th "
             "class=\"text\">file</th></tr>";
    for (const json& row : rows) {
      const json rules = row.contains("none") ? json::array() : row.value("rules", json::array());
      for (std::size_t i = 0; i < std::max<std::size_t>(1, rules.size()); ++i) {
        page_ << "<tr><td>" << (i == 0 ? value_text(row, "design") : "") << "</td><td class=\"text\">"
              << (i == 0 ? value_text(row, "beam") : "") << "</td>";
        if (rules.empty()) {
          page_ << "<td class=\"text\" colspan=\"6\">not judged: " << value_text(row, "none") << "</td>";
        } else {
          verdict(rules[i]);
          if (i > 0)
            page_ << "<td></td><td></td>";
          else if (row.contains("hspr"))
            page_ << "<td>" << value_text(row["hspr"], "score") << "</td><td class=\"text\">"
                  << value_text(row["hspr"], "class") << ", lamps " << value_text(row["hspr"], "height_m")
                  << " m high, " << value_text(row["hspr"], "spacing_m") << " m apart</td>";
          else
            page_ << "<td>–</td><td class=\"text\">" << (row.contains("hspr_none") ? value_text(row, "hspr_none") : "")
                  << "</td>";
        }
        page_ << "<td class=\"text\">" << (i == 0 ? value_text(row, "files") : "") << "</td></tr>";
      }
    }
    page_ << "</table></div><p>Of the photometry files times the rig's scale, each aimed as the rule says; HSPR of the "
             "lamps where the rig has them. phare lamp check and phare lamp hspr, with these --height and --spacing, "
             "tell "
             "every row.</p>";
  }

  void verdict(const json& rule) {
    const std::string verdict = rule.value("verdict", "");
    page_ << "<td class=\"text\">" << value_text(rule, "rule") << "</td><td class=\"text "
          << (verdict == "fail"   ? "bad"
              : verdict == "pass" ? "good"
                                  : "")
          << "\">" << escaped(verdict) << "</td><td>" << value_text(rule, "failed") << " of "
          << value_text(rule, "rows") << "</td><td class=\"text\">";
    if (rule.contains("worst")) {
      const json& worst = rule["worst"];
      page_ << value_text(worst, "row") << ": " << value_text(worst, "value", "%.4g") << " of "
            << value_text(worst, "limit", "%.4g") << ' ' << value_text(worst, "unit");
    }
    page_ << "</td>";
  }

  void pictures() {
    if (there("contact_sheet.png")) {
      page_ << "<h2>Along the road</h2>";
      picture("contact_sheet.png", "Frames of the drive in order");
    }
    // Other channels keep theirs in a folder of their own.
    for (const auto& [process, stats] : report_["processes"].items()) {
      if (!process.starts_with("visual-") || process == "visual-0") continue;
      const std::string folder = stats.value("channel", std::string());
      if (folder.empty() || !there(folder + "/drivers_view.png")) continue;
      page_ << "<h2>Channel " << escaped(folder) << "</h2><div class=\"pictures\">";
      picture(folder + "/drivers_view.png", "The same moment");
      picture(folder + "/contact_sheet.png", "Frames of the drive in order");
      page_ << "</div>";
    }
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

  const json& report_;
  const json& summary_;
  const json visual_;
  std::filesystem::path out_;
  bool within_;
  std::optional<DriveSeries> series_;
  std::ostringstream page_;
};

}  // namespace

std::string report_page(const nlohmann::json& report, const std::filesystem::path& out, PageFiles files) {
  return Page(report, out, files).html();
}

}  // namespace phare
