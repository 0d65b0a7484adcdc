#include "vehicle_dynamics/batch_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "config/base/fail.h"
#include "vehicle_dynamics/levelling.h"

namespace phare::batch {

Output::Output(OutputFiles files, const Options& options, unsigned columns, std::optional<Manoeuvre> standard,
               std::string what)
    : files_(std::move(files)),
      vehicle_(options.vehicle),
      vehicle_place_(options.vehicle_place),
      what_(std::move(what)),
      level_(options.level),
      speed_mps_(options.speed_mps),
      columns_(columns),
      shown_columns_(options.columns),
      lamps_(has_lamps(options.vehicle)),
      standard_(std::move(standard)) {}

Result<Output> Output::open(const OutputFiles& files, const Options& options, unsigned columns,
                            std::optional<Manoeuvre> standard, std::string what) {
  Output out(files, options, columns, std::move(standard), std::move(what));
  if (!files.reference.empty()) {
    Result<ReferenceRun> read = read_reference_run(files.reference);
    if (!read) return read.error();
    out.reference_ = std::make_unique<ReferenceRun>(std::move(*read));
  }
  if (!files.page.empty()) out.traces_.emplace(out.lamps_, out.shown_columns_, out.reference_.get());
  if (!files.rows.empty()) {
    Result<WholeFile> created = WholeFile::create(files.rows);
    if (!created) return created.error();
    out.file_.emplace(std::move(*created));
    out.text_ = header(out.lamps_, columns);
  }
  return out;
}

void Output::take(const Row& row) {
  if (standard_) rows_.push_back(row);
  if (lamps_ && row.cutoff_25m_m < 0.0) ++below_, lowest_m_ = std::min(lowest_m_, row.cutoff_25m_m);
  if (traces_) traces_->add(row);
  if (!file_) return;
  append(row, lamps_, text_, columns_);
  pass_on(1 << 18);
}

void Output::pass_on(std::size_t from_size) {
  if (text_.size() < from_size) return;
  if (written_ && file_) written_ = file_->write(text_);
  text_.clear();
}

Status Output::finish(const Summary& summary, double step_s) {
  pass_on(0);
  if (written_ && file_) written_ = file_->finish();
  if (written_ && traces_) written_ = write_whole_file(files_.page, page(summary, step_s));
  if (written_) tell(summary, step_s);
  return written_;
}

std::vector<std::string> Output::figure_lines() const {
  std::vector<std::string> lines;
  if (!standard_) return lines;
  char line[240], value[32];
  for (const Figure& figure : figures(*standard_, rows_)) {
    std::snprintf(value, sizeof value, "%.3f", figure.value);
    std::snprintf(line, sizeof line, "%-48s %9s %s", figure.what.c_str(), std::isnan(figure.value) ? "none:" : value,
                  figure.unit.c_str());
    lines.push_back(line);
  }
  return lines;
}

void Output::tell(const Summary& summary, double step_s) const {
  if (summary.rolled_over_s)
    std::fprintf(stderr, "phare-dynamics: the car has rolled over at %.9g s; the run ends there\n",
                 *summary.rolled_over_s);
  FILE* const told = is_standard_output(files_.rows) || is_standard_output(files_.page) ? stderr : stdout;
  if (standard_) {
    std::fprintf(told, "%s at %.1f km/h, level %s, %s\n", standard_->name.c_str(), speed_mps_ * 3.6, name(level_),
                 vehicle_.name.c_str());
    for (const std::string& line : figure_lines()) std::fprintf(told, "  %s\n", line.c_str());
  }
  if (level_ == Level::kAuto) {
    std::fprintf(told, "level auto: kinematic %.1f s, single-track %.1f s, full %.1f s, %llu switches\n",
                 summary.level_s[0], summary.level_s[1], summary.level_s[2],
                 static_cast<unsigned long long>(summary.switches));
    if (summary.switches > summary.switched.size())
      std::fprintf(told, "  the newest %zu of them:\n", summary.switched.size());
    for (const LevelSwitch& change : summary.switched)
      std::fprintf(told, "  %.3f s: %s\n", change.time_s, text(change).c_str());
  }
  if (below_ > 0) {
    const double lamp_m = vehicle_.levelling.lamp_height_m;
    std::fprintf(
        stderr,
        "phare-dynamics: cutoff_25m_m is below 0 in %llu rows: below the ground, as the beam meets the road before "
        "the wall, at the nearest %.1f m ahead of the lamps\n",
        static_cast<unsigned long long>(below_), levelling::kWall_m * lamp_m / (lamp_m - lowest_m_));
  }
  if (!lamps_ && file_)
    std::fprintf(stderr, "phare-dynamics: %s has no table [levelling]: no columns for cut-off and lamps\n",
                 printable(vehicle_place_).c_str());
  std::fprintf(
      told, "%llu steps of %g s in %.3f s: %.0f times real time, rows included; state hash %016llx%s%s\n",
      static_cast<unsigned long long>(summary.steps), step_s, summary.wall_s,
      summary.simulated_s / std::max(summary.wall_s, 1e-9), static_cast<unsigned long long>(summary.state_hash),
      summary.resistance ? "" : "; no air and rolling resistance", summary.off_road ? "; a wheel left the road" : "");
}

std::string Output::page(const Summary& summary, double step_s) const {
  char text[80];
  PageWords words;
  words.title = what_;
  words.facts.emplace_back("vehicle", vehicle_.name);
  std::snprintf(text, sizeof text, "%s, steps of %g s", name(level_), step_s);
  words.facts.emplace_back("level", text);
  std::snprintf(text, sizeof text, "%.1f km/h at the start, %.2f s", speed_mps_ * 3.6, summary.simulated_s);
  words.facts.emplace_back("run", text);
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(summary.state_hash));
  words.facts.emplace_back("state hash", text);
  if (summary.rolled_over_s) words.facts.emplace_back("end", "rolled over");
  words.figures = figure_lines();
  words.switched = summary.switched;
  return plot_page(words, *traces_);
}

}  // namespace phare::batch
