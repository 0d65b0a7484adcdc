#include "tools/drive_series.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numbers>
#include <span>

namespace phare {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Cells of a line of CSV, quotes taken off (RFC 4180).
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += c, ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

/// A file whose rows may have empty cells, and whose columns are named again when their number changes.
class Rows {
 public:
  explicit Rows(const std::filesystem::path& file) : file_(file), stream_(file) {
    std::string header;
    if (std::getline(stream_, header)) columns_ = cells_of(header);
  }
  bool there() const { return !columns_.empty(); }
  const std::vector<std::string>& columns() const { return columns_; }

  /// False at the end; a row without its end of line is none.
  Result<bool> next() {
    std::string line;
    if (!std::getline(stream_, line) || stream_.eof()) return false;
    ++line_;
    cells_ = cells_of(line);
    if (cells_ == columns_) return next();
    if (cells_.size() == columns_.size()) return true;
    return Error{file_.string() + ":" + std::to_string(line_),
                 "expected " + std::to_string(columns_.size()) + " cells, got " + std::to_string(cells_.size())};
  }
  const std::string& text(const std::string& column) const {
    static const std::string kEmpty;
    const auto at = std::ranges::find(columns_, column);
    return at == columns_.end() ? kEmpty : cells_[static_cast<std::size_t>(at - columns_.begin())];
  }
  double number(const std::string& column) const {
    const std::string& cell = text(column);
    return cell.empty() ? kNone : std::atof(cell.c_str());
  }

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::vector<std::string> columns_, cells_;
  std::size_t line_ = 1;
};

void add(TimeSeries& series, double time_s, double value) {
  series.time_s.push_back(time_s);
  series.value.push_back(value);
}

/// Of the values that there are.
nlohmann::json spread_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return nullptr;
  std::ranges::sort(values);
  return {{"min", values.front()}, {"median", values[(values.size() - 1) / 2]}, {"max", values.back()}};
}

std::vector<TimeSeries> columns_with(const Rows& rows, const std::string& begins, const std::string& ends) {
  std::vector<TimeSeries> found;
  for (const std::string& column : rows.columns())
    if (column.starts_with(begins) && column.ends_with(ends)) found.push_back({.name = column});
  return found;
}

}  // namespace

Result<std::optional<DriveSeries>> read_drive_series(const std::filesystem::path& folder) {
  Rows rows(folder / "drive.csv");
  if (!rows.there()) return std::optional<DriveSeries>{};
  DriveSeries series;
  series.reach_m = columns_with(rows, "reach_", "_m");
  for (TimeSeries& other : columns_with(rows, "versus_reach_", "_m")) series.reach_m.push_back(std::move(other));
  struct GlareLines {
    std::vector<TimeSeries>& lines;
    const char* column;
  };
  const std::array<GlareLines, 3> glare{{{series.veil_cdm2, "veil_cdm2"},
                                         {series.threshold_increment_percent, "threshold_increment_percent"},
                                         {series.de_boer, "de_boer"}}};
  for (const GlareLines& of : glare) of.lines = {{.name = "the driver"}, {.name = "who comes toward the car"}};
  constexpr double kDegPerRad = 180.0 / std::numbers::pi;
  double x_m = kNone, y_m = kNone, before_s = kNone;
  for (auto row = rows.next();; row = rows.next()) {
    if (!row) return row.error();
    if (!*row) break;
    const double time_s = rows.number("time_s");
    ++series.rows;
    add(series.speed_kmh, time_s, rows.number("speed_mps") * 3.6);
    add(series.pitch_deg, time_s, rows.number("pitch_rad") * kDegPerRad);
    add(series.cutoff_m, time_s, rows.number("cutoff_25m_m"));
    for (TimeSeries& reach : series.reach_m)
      if (const double value = rows.number(reach.name); !std::isnan(value)) add(reach, time_s, value);
    for (const GlareLines& of : glare) {
      add(of.lines[0], time_s, rows.number(of.column));
      add(of.lines[1], time_s, rows.number(std::string("others_") + of.column));
    }
    if (rows.text("picture") == "1") series.pictures.push_back({std::atoll(rows.text("frame").c_str()), time_s});
    const std::string &lit = rows.text("lit"), &design = rows.text("design");
    if (series.lit.empty() || series.lit.back().lit != lit || series.lit.back().design != design) {
      if (!series.lit.empty()) series.lit.back().to_s = time_s;
      series.lit.push_back({time_s, time_s, lit, design});
    }
    series.lit.back().to_s = time_s;
    const double to_x_m = rows.number("x_m"), to_y_m = rows.number("y_m");
    if (time_s > before_s) {  // else somebody has sought, and the car was set elsewhere
      series.driven_s += time_s - before_s;
      series.distance_m += std::hypot(to_x_m - x_m, to_y_m - y_m);
    }
    x_m = to_x_m, y_m = to_y_m, before_s = time_s;
  }
  for (const GlareLines& of : glare)
    std::erase_if(of.lines, [](const TimeSeries& line) {
      return std::ranges::none_of(line.value, [](double value) { return value > 0.0; });
    });
  if (Rows probes(folder / "probes.csv"); probes.there()) {
    series.probes_lx = columns_with(probes, "probe", "_lx");
    for (auto row = probes.next(); row && *row; row = probes.next())
      for (TimeSeries& probe : series.probes_lx) add(probe, probes.number("time_s"), probes.number(probe.name));
  }
  return std::optional(std::move(series));
}

nlohmann::json figures_of(const DriveSeries& series) {
  nlohmann::json figures{{"rows", series.rows}, {"distance_m", series.distance_m}};
  if (series.rows > 0) figures["driven_s"] = series.driven_s;
  const auto put = [](nlohmann::json& into, const std::string& key, const std::vector<double>& values) {
    if (nlohmann::json spread = spread_of(values); !spread.is_null()) into[key] = std::move(spread);
  };
  put(figures, "speed_kmh", series.speed_kmh.value);
  put(figures, "pitch_deg", series.pitch_deg.value);
  put(figures, "cutoff_25m_m", series.cutoff_m.value);
  figures["reach_m"] = nlohmann::json::object();
  for (const TimeSeries& reach : series.reach_m) {
    std::vector<double> lit;
    std::size_t span = 0;
    for (std::size_t i = 0; i < reach.value.size(); ++i) {
      while (span + 1 < series.lit.size() && series.lit[span + 1].from_s <= reach.time_s[i]) ++span;
      if (span < series.lit.size() && !series.lit[span].lit.empty()) lit.push_back(reach.value[i]);
    }
    put(figures["reach_m"], reach.name, lit);
  }
  for (const TimeSeries& probe : series.probes_lx) put(figures["probes_lx"], probe.name, probe.value);
  return figures;
}

}  // namespace phare
