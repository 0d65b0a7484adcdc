#include "visual/photometry/readers/points_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <sstream>
#include <string_view>
#include <utility>

#include "config/base/input_files.h"
#include "config/base/whole_file.h"

namespace phare {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Fields of a CSV line; commas inside double quotes do not part. Quotes around a whole field are taken off.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  bool in_quotes = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') in_quotes = !in_quotes;
    if (i < line.size() && (line[i] != ',' || in_quotes)) continue;
    std::string_view field = trimmed(line.substr(begin, i - begin));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    fields.push_back(field);
    begin = i + 1;
  }
  return fields;
}

Result<double> number(std::string_view field, const std::string& place, std::string_view column) {
  std::string_view digits = field;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
    return Error{place, std::string(column) + " is not a finite number: \"" + std::string(field.substr(0, 24)) + "\""};
  }
  return value;
}

/// Reads a CSV file and hands each row's line and the numbers of `columns` to `row`. Returns the header line.
template <std::size_t n>
Result<std::string> read_rows(
    const std::filesystem::path& path, const std::array<const char*, n>& columns,
    std::initializer_list<std::string_view> taken_prefixes,
    const std::function<Status(const std::string&, std::size_t, const std::array<double, n>&)>& row) {
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 30;
  const std::string name = input_name(path);
  auto bytes = read_input_bytes(path, kMaxBytes);
  if (!bytes) return bytes.error();
  std::istringstream stream(std::move(*bytes));
  std::string header;
  std::string line;
  std::array<std::size_t, n> index{};
  std::size_t column_count = 0;
  for (std::size_t line_number = 1; std::getline(stream, line); ++line_number) {
    if (line_number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (line.ends_with('\r')) line.pop_back();
    if (trimmed(line).empty() || line.front() == '#') continue;
    const std::string place = name + ":" + std::to_string(line_number);
    const auto fields = fields_of(line);
    if (header.empty()) {
      header = line;
      column_count = fields.size();
      for (std::size_t k = 0; k < n; ++k) {
        index[k] = column_count;
        for (std::size_t i = 0; i < column_count; ++i) {
          if (fields[i] != columns[k]) continue;
          if (index[k] != column_count) return Error{place, "column " + std::string(columns[k]) + " is there twice"};
          index[k] = i;
        }
        if (index[k] == column_count) return Error{place, "column " + std::string(columns[k]) + " is missing"};
      }
      for (const std::string_view field : fields) {
        if (std::ranges::any_of(taken_prefixes, [&](std::string_view taken) { return field.starts_with(taken); })) {
          return Error{place, "column " + std::string(field) + " is there already; the result would have it twice"};
        }
      }
      continue;
    }
    if (fields.size() != column_count) {
      return Error{place,
                   "expected " + std::to_string(column_count) + " columns, got " + std::to_string(fields.size())};
    }
    std::array<double, n> values{};
    for (std::size_t k = 0; k < n; ++k) {
      const auto value = number(fields[index[k]], place, columns[k]);
      if (!value) return value.error();
      values[k] = *value;
    }
    if (const auto taken = row(line, line_number, values); !taken) return taken.error();
  }
  if (header.empty())
    return Error{name, "is empty: expected a header line with " + std::string(columns.front()) + " …"};
  return header;
}

std::string digits_17(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

/// As a field of CSV that stays on its line, whatever a name holds.
std::string csv_field(std::string text) {
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < ' ') letter = ' ';
  if (text.find_first_of(",\"") == std::string::npos && trimmed(text) == text && !text.starts_with('#')) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

}  // namespace

Result<PointsFile> read_points(const std::filesystem::path& path) {
  constexpr double kFarthest_m = 1e8;  // as for the vertices of a scene: beyond it a file is wrong
  PointsFile points;
  const std::array<const char*, 6> columns{"x_m", "y_m", "z_m", "nx", "ny", "nz"};
  auto header = read_rows<6>(
      path, columns, {"illuminance_lx", "hidden_by_"},
      [&](const std::string& line, std::size_t line_number, const std::array<double, 6>& v) -> Status {
        PointRow row{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, line, line_number};
        const std::string place = input_name(path) + ":" + std::to_string(line_number);
        if (!(glm::length(row.position_m) < kFarthest_m))
          return Error{place, "the point is not within 1e8 m of the origin"};
        // Scaled first, so that no length over- or underflows on the way.
        const double largest = std::max({std::abs(v[3]), std::abs(v[4]), std::abs(v[5])});
        if (!(largest > 0.0)) return Error{place, "the normal nx, ny, nz is zero"};
        row.normal = glm::normalize(row.normal / largest);
        points.rows.push_back(std::move(row));
        return Done{};
      });
  if (!header) return header.error();
  points.header = std::move(*header);
  return points;
}

Status write_illuminance(const std::filesystem::path& path, const PointsFile& points, std::size_t lamps,
                         std::span<const Illuminance> illuminance, const std::optional<std::vector<HiddenBy>>& hidden) {
  assert(illuminance.size() == points.rows.size());
  assert(!hidden || hidden->size() == points.rows.size());
  std::string content = points.header + ",illuminance_lx";
  for (std::size_t k = 1; k <= lamps; ++k) content += ",illuminance_lx_" + std::to_string(k);
  for (std::size_t k = 1; k <= lamps && hidden; ++k) content += ",hidden_by_" + std::to_string(k);
  content += '\n';
  for (std::size_t i = 0; i < points.rows.size(); ++i) {
    content += points.rows[i].text + "," + digits_17(illuminance[i].total_lx);
    for (const double e : illuminance[i].lamps_lx) content += "," + digits_17(e);
    if (hidden)
      for (const std::string& name : (*hidden)[i]) content += "," + csv_field(name);
    content += '\n';
  }
  return write_whole_file(path, content);
}

Result<AnglesFile> read_angles(const std::filesystem::path& path) {
  AnglesFile angles;
  const std::array<const char*, 2> columns{"h_deg", "v_deg"};
  auto header = read_rows<2>(path, columns, {"intensity_cd"},
                             [&](const std::string& line, std::size_t, const std::array<double, 2>& v) -> Status {
                               angles.rows.push_back({{v[0], v[1]}, line});
                               return Done{};
                             });
  if (!header) return header.error();
  angles.header = std::move(*header);
  return angles;
}

double intensity_of_row_cd(const IntensityTable& table, TableAngles angles) {
  // C goes round: -10° is 350°.
  if (table.type == PhotometricType::kC) angles.first_deg -= 360.0 * std::floor(angles.first_deg / 360.0);
  return table.screen_distance_m > 0.0 ? table.intensity_cd(direction_hv(angles.first_deg, angles.second_deg))
                                       : table.intensity_at_cd(angles);
}

Status write_intensity(const std::filesystem::path& path, const AnglesFile& angles, const IntensityTable& table) {
  std::string content = angles.header + ",intensity_cd\n";
  for (const AngleRow& row : angles.rows)
    content += row.text + "," + digits_17(intensity_of_row_cd(table, row.angles)) + '\n';
  return write_whole_file(path, content);
}

}  // namespace phare
