// Reader of photometry as CSV: candela grids, lux of a goniometer cell at a distance (I = E·D²), lux on a flat screen,
// and lists of h, v and value. Lines "# key: value" before the table say which:
//   # quantity: …   # unit: cd | lx   # distance_m: 25   # angles: type A | B | C
// The corner cell names rows and columns ("V\H": rows V, columns H; "z\y": a screen with z up and y left in m). Rows
// and columns may ascend or descend. A list has a header line with h_deg, v_deg and intensity_cd or illuminance_lx.
// Fields are parted by commas, or by semicolons with decimal commas allowed.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "visual/photometry/readers/file_text.h"
#include "visual/photometry/readers/grid_build.h"
#include "visual/photometry/readers/point_list.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

enum class Unit { kUnknown, kCandela, kLux };
enum class Axis { kNone, kH, kV, kC, kGamma, kY, kZ };

Axis axis_named(std::string_view name) {
  const std::string text = upper_case(trimmed(name));
  if (text == "H" || text == "H_DEG" || text == "HORIZONTAL") return Axis::kH;
  if (text == "V" || text == "V_DEG" || text == "VERTICAL") return Axis::kV;
  if (text == "C" || text == "C_DEG") return Axis::kC;
  if (text == "G" || text == "GAMMA" || text == "GAMMA_DEG") return Axis::kGamma;
  if (text == "Y" || text == "Y_M") return Axis::kY;
  if (text == "Z" || text == "Z_M") return Axis::kZ;
  return Axis::kNone;
}

class LampCsv {
 public:
  LampCsv(std::string_view bytes, const std::string& name, const LampReadSettings& settings)
      : text_(bytes, name, false),
        name_(name),
        settings_(settings),
        byte_count_(bytes.size()),
        list_of_points_(names_points(bytes, name)) {
    table_.name = name;
    table_.axis = settings.axis;
  }
  Result<IntensityTable> read();

 private:
  Status read_remarks();
  Status take_remark(std::string_view line);
  std::vector<std::string_view> fields(std::string_view line) const;
  Result<double> number(std::string_view field, const std::string& what);
  Status read_matrix(const std::vector<std::string_view>& head);
  Status read_list(const std::vector<std::string_view>& head);
  /// Of a list of directions, whose angles stand in several lines: at its end.
  Error at_angle(bool columns, std::size_t i, std::string reason) const;
  Status check_and_sort(std::vector<double>& nodes, bool columns);
  Status to_candela();

  FileText text_;
  std::string name_;
  const LampReadSettings& settings_;
  std::size_t byte_count_;
  bool list_of_points_;
  IntensityTable table_;
  std::string head_;  ///< the line after the remarks
  char separator_ = ',';
  Unit unit_ = Unit::kUnknown;
  Axis row_axis_ = Axis::kNone, column_axis_ = Axis::kNone;
  bool type_stated_ = false;
  double distance_m_ = 0.0;
  std::vector<std::size_t> first_lines_, second_lines_;  ///< where the angles of a matrix stand
};

Error LampCsv::at_angle(bool columns, std::size_t i, std::string reason) const {
  const std::vector<std::size_t>& lines = columns ? first_lines_ : second_lines_;
  if (i >= lines.size()) return text_.error(std::move(reason));
  return {table_.name + ":" + std::to_string(lines[i]), std::move(reason)};
}

std::vector<std::string_view> LampCsv::fields(std::string_view line) const {
  std::vector<std::string_view> result;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] != separator_) continue;
    std::string_view field = line.substr(begin, i - begin);
    while (!field.empty() && (field.front() == ' ' || field.front() == '\t')) field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '\t' || field.back() == '\r'))
      field.remove_suffix(1);
    result.push_back(field);
    begin = i + 1;
  }
  return result;
}

Result<double> LampCsv::number(std::string_view field, const std::string& what) {
  std::optional<double> value = parse_number(field);
  if (!value && separator_ == ';') {
    std::string with_point(field.substr(0, 64));
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    value = parse_number(with_point);
  }
  if (!value) return text_.error(what + " is not a finite number: " + in_quotes(field));
  return *value;
}

Status LampCsv::take_remark(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return Done{};
  const std::string key = upper_case(trimmed(line.substr(1, colon - 1)));
  const std::string_view value = trimmed(line.substr(colon + 1));
  const std::string capitals = upper_case(value);
  if (key == "UNIT") {
    if (capitals == "CD" || capitals == "CANDELA") {
      unit_ = Unit::kCandela;
    } else if (capitals == "LX" || capitals == "LUX") {
      unit_ = Unit::kLux;
    } else {
      return text_.error("unit " + in_quotes(value) + " is neither cd nor lx");
    }
  } else if (key == "DISTANCE_M") {
    const auto distance = parse_number(value);
    if (!distance || !(*distance > 0.0) || *distance > 1e6)
      return text_.error("distance_m is no number of metres above 0: " + in_quotes(value));
    distance_m_ = *distance;
    if (settings_.distance_m > 0.0 && settings_.distance_m != distance_m_)
      return text_.error("states a distance of " + number_text(distance_m_) + " m, and " +
                         number_text(settings_.distance_m) + " m are asked for");
  } else if (key == "ANGLES") {
    const std::string kind = capitals.starts_with("TYPE ") ? capitals.substr(5) : capitals;
    if (kind != "A" && kind != "B" && kind != "C")
      return text_.error("angles " + in_quotes(value) + " are not type A, B or C");
    table_.type = kind == "A" ? PhotometricType::kA : kind == "B" ? PhotometricType::kB : PhotometricType::kC;
    type_stated_ = true;
  } else if (table_.header.keywords.size() < 1000) {
    table_.header.keywords.emplace_back(key, value);
  }
  return Done{};
}

Status LampCsv::read_remarks() {
  while (const auto line = text_.next_line()) {
    if (line->empty()) continue;
    if (line->front() == '#') {
      if (const Status status = take_remark(*line); !status) return status.error();
      continue;
    }
    head_ = *line;
    separator_ = head_.find(';') != std::string::npos ? ';' : ',';
    return Done{};
  }
  return text_.error("the file ends before its table");
}

/// Ascending nodes; columns or rows of the table are turned where they descend.
Status LampCsv::check_and_sort(std::vector<double>& nodes, bool columns) {
  const std::string what = columns ? "column" : "row";
  if (nodes.size() < 2) return text_.error("one " + what + " is no beam");
  const bool descending = nodes[1] < nodes[0];
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (!(descending ? nodes[i] < nodes[i - 1] : nodes[i] > nodes[i - 1])) {
      return at_angle(columns, i,
                      "the " + what + " angles go neither up nor down all the way: " + number_text(nodes[i]) +
                          " follows " + number_text(nodes[i - 1]));
    }
  }
  if (!descending) return Done{};
  std::reverse(nodes.begin(), nodes.end());
  const std::size_t width = table_.first_deg.size(), height = table_.second_deg.size();
  if (columns) {
    for (std::size_t j = 0; j < height; ++j) {
      const auto row = table_.candela.begin() + static_cast<std::ptrdiff_t>(j * width);
      std::reverse(row, row + static_cast<std::ptrdiff_t>(width));
    }
  } else {
    for (std::size_t j = 0; j < height / 2; ++j) {
      const auto row = table_.candela.begin() + static_cast<std::ptrdiff_t>(j * width);
      const auto other = table_.candela.begin() + static_cast<std::ptrdiff_t>((height - 1 - j) * width);
      std::swap_ranges(row, row + static_cast<std::ptrdiff_t>(width), other);
    }
  }
  return Done{};
}

Status LampCsv::read_matrix(const std::vector<std::string_view>& head) {
  const std::size_t slash = head[0].find_first_of("\\/");
  if (slash != std::string_view::npos) {
    row_axis_ = axis_named(head[0].substr(0, slash));
    column_axis_ = axis_named(head[0].substr(slash + 1));
  }
  if (row_axis_ == Axis::kNone || column_axis_ == Axis::kNone)
    return text_.error("the corner cell " + in_quotes(head[0]) + " does not name rows and columns, such as V\\H");
  for (std::size_t i = 1; i < head.size(); ++i) {
    if (head[i].empty() && i + 1 == head.size()) break;  // a separator at the end of the line
    const auto angle = number(head[i], "column " + std::to_string(i));
    if (!angle) return angle.error();
    table_.first_deg.push_back(*angle);
    first_lines_.push_back(text_.line());
  }
  const std::size_t columns = table_.first_deg.size();
  if (columns == 0) return text_.error("no columns");
  double& smallest = table_.header.smallest_step_cd;
  while (const auto line = text_.next_line()) {
    if (line->empty() || line->front() == '#') continue;
    std::size_t begin = 0, field = 0;
    // Field by field without a list: these lines hold most of the file.
    while (begin <= line->size()) {
      const std::size_t end = std::min(line->find(separator_, begin), line->size());
      std::string_view word = line->substr(begin, end - begin);
      while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
      while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
      begin = end + 1;
      if (field > columns) {
        if (word.empty() && end == line->size()) break;
        return text_.error("expected " + std::to_string(columns) + " values, got more");
      }
      auto value = parse_number(word);
      if (!value) {  // a decimal comma, or wrong
        const auto other = number(word, field == 0 ? "the row's angle" : "value " + std::to_string(field));
        if (!other) return other.error();
        value = *other;
      }
      if (field == 0) {
        table_.second_deg.push_back(*value);
        second_lines_.push_back(text_.line());
      } else {
        if (*value < 0.0) return text_.error("negative value " + number_text(*value));
        table_.candela.push_back(*value);
        if (*value != 0.0 && field % 7 == 1)
          smallest = smallest == 0.0 ? last_digit(word) : std::min(smallest, last_digit(word));
      }
      ++field;
    }
    if (field != columns + 1)
      return text_.error("expected " + std::to_string(columns) + " values, got " + std::to_string(field - 1));
  }
  // Rows are the second angle and columns the first, unless the file has them the other way.
  const bool turned = row_axis_ == Axis::kH || row_axis_ == Axis::kC || row_axis_ == Axis::kY;
  if (turned) {
    std::vector<double> values(table_.candela.size());
    const std::size_t rows = table_.second_deg.size();
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) values[i * rows + j] = table_.candela[j * columns + i];
    }
    table_.candela = std::move(values);
    std::swap(table_.first_deg, table_.second_deg);
    std::swap(first_lines_, second_lines_);
    std::swap(row_axis_, column_axis_);
  }
  return Done{};
}

Status LampCsv::read_list(const std::vector<std::string_view>& head) {
  std::size_t first = head.size(), second = head.size(), value = head.size();
  for (std::size_t i = 0; i < head.size(); ++i) {
    const Axis axis = axis_named(head[i]);
    const std::string name = upper_case(head[i]);
    if (axis == Axis::kH || axis == Axis::kC || axis == Axis::kY) {
      first = i;
      column_axis_ = axis;
    } else if (axis == Axis::kV || axis == Axis::kGamma || axis == Axis::kZ) {
      second = i;
      row_axis_ = axis;
    } else if (name == "INTENSITY_CD" || name == "I_CD" || name == "CD" || name == "CANDELA") {
      value = i;
      unit_ = Unit::kCandela;
    } else if (name == "ILLUMINANCE_LX" || name == "E_LX" || name == "LX" || name == "LUX") {
      value = i;
      unit_ = Unit::kLux;
    }
  }
  if (first == head.size() || second == head.size() || value == head.size())
    return text_.error(
        "expected \"# unit: cd\" or lx, a grid's corner (V\\H, gamma\\C, z\\y), columns h_deg, v_deg and "
        "intensity_cd or illuminance_lx, or of a list a column \"point\" and one of values, \"low beam (cd)\"");
  std::map<double, std::map<double, double>> rows;
  std::size_t count = 0;
  double& smallest = table_.header.smallest_step_cd;
  while (const auto line = text_.next_line()) {
    if (line->empty() || line->front() == '#') continue;
    const auto f = fields(*line);
    if (f.size() != head.size())
      return text_.error("expected " + std::to_string(head.size()) + " columns, got " + std::to_string(f.size()));
    double v[3];
    std::size_t k = 0;
    for (const std::size_t column : {first, second, value}) {
      const auto n = number(f[column], std::string(head[column].substr(0, 24)));
      if (!n) return n.error();
      v[k++] = *n;
    }
    if (v[2] < 0.0) return text_.error("negative value " + number_text(v[2]));
    if (!rows[v[1]].emplace(v[0], v[2]).second)
      return text_.error("the direction " + number_text(v[0]) + ", " + number_text(v[1]) + " is there twice");
    if (v[2] != 0.0) smallest = smallest == 0.0 ? last_digit(f[value]) : std::min(smallest, last_digit(f[value]));
    ++count;
  }
  if (rows.empty()) return text_.error("no rows");
  for (const auto& [angle, unused] : rows.begin()->second) table_.first_deg.push_back(angle);
  for (const auto& [angle, row] : rows) {
    table_.second_deg.push_back(angle);
    std::size_t i = 0;
    for (const auto& [h, cd] : row) {
      if (i >= table_.first_deg.size() || table_.first_deg[i] != h) break;
      table_.candela.push_back(cd);
      ++i;
    }
    if (i != table_.first_deg.size() || row.size() != i)
      return text_.error("the list is no grid: the directions at " + number_text(angle) + " are not those at " +
                         number_text(rows.begin()->first));
  }
  return Done{};
}

Status LampCsv::to_candela() {
  const bool screen = column_axis_ == Axis::kY;
  if (screen != (row_axis_ == Axis::kZ))
    return text_.error("rows and columns do not go together: H with V, C with gamma, y with z");
  const bool is_c = column_axis_ == Axis::kC;
  if (is_c != (row_axis_ == Axis::kGamma))
    return text_.error("rows and columns do not go together: H with V, C with gamma, y with z");
  if (is_c != (table_.type == PhotometricType::kC) && type_stated_)
    return text_.error("the axes named are not those of the angles' type");
  if (is_c) table_.type = PhotometricType::kC;
  if (unit_ == Unit::kUnknown) {
    if (!screen && distance_m_ == 0.0)
      return text_.error("neither \"# unit: cd\" nor \"# unit: lx\" says what the values are");
    unit_ = Unit::kLux;
    table_.notes.push_back(text_.place() + ": no unit; taken as lx because a distance is stated");
  }
  if (unit_ == Unit::kLux && distance_m_ == 0.0) distance_m_ = settings_.distance_m;
  if ((unit_ == Unit::kLux || screen) && !(distance_m_ > 0.0))
    return text_.error("values in lx need \"# distance_m: …\" or --distance");
  if (screen && unit_ != Unit::kLux) return text_.error("a screen in y and z has values in lx");
  if (!type_stated_ && !is_c && !screen)
    table_.notes.push_back(text_.place() + ": no \"# angles: type …\"; taken as type A");

  const double factor = unit_ == Unit::kLux ? distance_m_ * distance_m_ : 1.0;
  table_.header.smallest_step_cd *= factor;
  table_.header.distance_m = unit_ == Unit::kLux ? distance_m_ : 0.0;
  table_.header.format = screen ? "CSV screen" : unit_ == Unit::kLux ? "CSV goniometer" : "CSV candela";
  table_.version = table_.header.format;
  table_.header.symmetry = "none";
  const std::size_t columns = table_.first_deg.size();
  if (screen) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    table_.screen_distance_m = distance_m_;
    const double d2 = distance_m_ * distance_m_;
    for (std::size_t j = 0; j < table_.second_deg.size(); ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const double y = table_.first_deg[i], z = table_.second_deg[j];
        const double r2 = d2 + y * y + z * z;
        table_.candela[j * columns + i] *= r2 * std::sqrt(r2) / distance_m_;  // E·r²/cos, cos = D/r
      }
    }
    for (double& y : table_.first_deg) y = std::atan(-y / distance_m_) * kDegrees;
    for (double& z : table_.second_deg) z = std::atan(z / distance_m_) * kDegrees;
  } else {
    for (double& value : table_.candela) value *= factor;
    const double first_max = table_.type == PhotometricType::kB ? 90.0 : is_c ? 360.0 : 180.0;
    const double second_max = table_.type == PhotometricType::kA ? 90.0 : 180.0;
    for (const auto& [nodes, max] : {std::pair{&table_.first_deg, first_max}, {&table_.second_deg, second_max}}) {
      for (std::size_t i = 0; i < nodes->size(); ++i) {
        const double angle = (*nodes)[i];
        if (std::abs(angle) > max || (is_c && angle < 0.0))
          return at_angle(nodes == &table_.first_deg, i,
                          "the angle " + number_text(angle) + " is outside this type's range");
      }
    }
  }
  for (const double cd : table_.candela) {
    if (!std::isfinite(cd)) return text_.error("a value times the distance squared is no finite number");
  }
  return Done{};
}

Result<IntensityTable> LampCsv::read() {
  distance_m_ = 0.0;
  if (const Status status = read_remarks(); !status) return status.error();
  const std::vector<std::string_view> head = fields(head_);
  if (list_of_points_)
    return text_.error("a list of test points is no beam: phare lamp check judges it, plot draws it, info tells of it");
  const bool matrix = head[0].find_first_of("\\/") != std::string_view::npos;
  if (const Status status = matrix ? read_matrix(head) : read_list(head); !status) return status.error();
  if (const Status status = to_candela(); !status) return status.error();
  if (const Status status = check_and_sort(table_.first_deg, true); !status) return status.error();
  if (const Status status = check_and_sort(table_.second_deg, false); !status) return status.error();
  if (table_.type == PhotometricType::kC) {
    if (table_.second_deg.size() < 2) return text_.error("one gamma angle is no beam");
    auto unfolded = unfold_lm63(table_.first_deg, PhotometricType::kC);
    if (!unfolded) return text_.error(unfolded.error().reason);
    table_.header.symmetry = unfolded->symmetry;
    std::vector<double> planes(table_.candela.size());
    const std::size_t rows = table_.second_deg.size(), columns = table_.first_deg.size();
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t j = 0; j < rows; ++j) planes[i * rows + j] = table_.candela[j * columns + i];
    }
    fill_table(table_, unfolded->columns, std::vector<double>(table_.second_deg), planes);
    turn_about_axis(table_, settings_.c0_turn_deg);
  }
  return std::move(table_);
}

}  // namespace

Result<IntensityTable> parse_lamp_csv(std::string_view text, const std::string& name,
                                      const LampReadSettings& settings) {
  return LampCsv(text, name, settings).read();
}

}  // namespace phare
