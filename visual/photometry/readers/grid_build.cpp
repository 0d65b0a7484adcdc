#include "visual/photometry/readers/grid_build.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "visual/photometry/readers/file_text.h"

namespace phare {
namespace {

bool before(const Column& a, const Column& b) {
  return a.angle_deg < b.angle_deg;
}
bool before_angle(const Column& column, double angle_deg) {
  return column.angle_deg < angle_deg;
}

}  // namespace

void mirror_columns(std::vector<Column>& columns, double about2_deg) {
  const std::vector<Column> half = columns;
  for (const Column& column : half) {
    const double angle = about2_deg - column.angle_deg;
    const auto there = std::lower_bound(half.begin(), half.end(), angle, before_angle);
    if (there == half.end() || there->angle_deg != angle) columns.push_back({angle, column.plane});
  }
  std::sort(columns.begin(), columns.end(), before);
}

Result<Unfolded> unfold_lm63(std::span<const double> first_deg, PhotometricType type) {
  Unfolded result{{}, "none", ""};
  std::vector<Column>& columns = result.columns;
  for (std::size_t i = 0; i < first_deg.size(); ++i) columns.push_back({first_deg[i], i});
  const double begin = first_deg.front();
  const double end = first_deg.back();

  if (type != PhotometricType::kC) {
    if (begin == 0.0) {
      mirror_columns(columns, 0.0);
      result.symmetry = "lateral (first horizontal angle 0)";
    }
    if (columns.size() < 2) return Error{"", "one horizontal angle (" + number_text(begin) + ") is no beam"};
    return result;
  }
  if (begin == 0.0 && end == 0.0) {
    columns.push_back({360.0, 0});
    result.symmetry = "about the axis";
  } else if (begin == 0.0 && end == 90.0) {
    mirror_columns(columns, 180.0);
    mirror_columns(columns, 360.0);
    result.symmetry = "quadrant";
  } else if (begin == 0.0 && end == 180.0) {
    mirror_columns(columns, 360.0);
    result.symmetry = "about the plane C0-C180";
  } else if (begin == 90.0 && end == 270.0) {
    // Symmetric about the plane C 90 - C 270: C and 180 - C are alike.
    std::vector<Column> all = columns;
    for (const Column& column : columns) {
      const double angle = 180.0 - column.angle_deg;  // -90 .. 90
      if (column.angle_deg != 90.0 && column.angle_deg != 270.0)
        all.push_back({angle < 0.0 ? angle + 360.0 : angle, column.plane});
      if (angle == 0.0) all.push_back({360.0, column.plane});
    }
    std::sort(all.begin(), all.end(), before);
    if (all.front().angle_deg != 0.0) return Error{"", "C angles from 90 to 270 need one at 180"};
    columns = std::move(all);
    result.symmetry = "about the plane C90-C270";
  } else if (begin == 0.0 && end > 180.0 && end < 360.0) {
    double widest = 0.0;
    for (std::size_t i = 1; i < first_deg.size(); ++i) widest = std::max(widest, first_deg[i] - first_deg[i - 1]);
    if (360.0 - end > widest * 1.0001)
      return Error{"", "C angles end at " + number_text(end) + ", not at 0, 90, 180 or 360"};
    result.note = "C angles end at " + number_text(end) + "; the plane C 0 repeated at 360";
    columns.push_back({360.0, 0});
  } else if (begin != 0.0 || end != 360.0) {
    return Error{"", "C angles from " + number_text(begin) + " to " + number_text(end) + " are no symmetry of LM-63"};
  }
  return result;
}

void fill_table(IntensityTable& table, std::span<const Column> columns, std::vector<double> second_deg,
                std::span<const double> planes) {
  const std::size_t rows = second_deg.size();
  table.second_deg = std::move(second_deg);
  table.first_deg.clear();
  table.first_deg.reserve(columns.size());
  table.candela.resize(rows * columns.size());
  for (const Column& column : columns) table.first_deg.push_back(column.angle_deg);
  // In blocks of rows, so that both the plane (read along) and the table (written across) stay in the cache.
  constexpr std::size_t kBlock = 64;
  for (std::size_t from = 0; from < rows; from += kBlock) {
    const std::size_t to = std::min(rows, from + kBlock);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double* plane = planes.data() + columns[i].plane * rows;
      for (std::size_t j = from; j < to; ++j) table.candela[j * columns.size() + i] = plane[j];
    }
  }
}

void turn_about_axis(IntensityTable& table, double turn_deg) {
  assert(table.type == PhotometricType::kC && table.first_deg.front() == 0.0 && table.first_deg.back() == 360.0);
  const double turn = std::fmod(std::fmod(turn_deg, 360.0) + 360.0, 360.0);
  if (turn == 0.0) return;
  const IntensityTable old = table;
  std::vector<double> nodes{0.0, 360.0};
  for (std::size_t i = 0; i + 1 < old.first_deg.size(); ++i) {
    const double at = old.first_deg[i] + turn;
    nodes.push_back(at >= 360.0 ? at - 360.0 : at);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  table.first_deg = nodes;
  table.candela.assign(nodes.size() * old.second_deg.size(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double from = nodes[i] - turn;
    if (from < 0.0) from += 360.0;
    // 0.1 + 90 - 90 may miss its node by a rounding; take the node itself then.
    const auto near = std::lower_bound(old.first_deg.begin(), old.first_deg.end(), from - 1e-9);
    if (near != old.first_deg.end() && std::abs(*near - from) < 1e-9) from = *near;
    for (std::size_t j = 0; j < old.second_deg.size(); ++j)
      table.candela[j * nodes.size() + i] = old.intensity_at_cd({from, old.second_deg[j]});
  }
}

double last_digit(std::string_view word) {
  int exponent = 0;
  const std::size_t e = word.find_first_of("eE");
  if (e != std::string_view::npos) {
    const auto value = parse_number(word.substr(e + 1));
    exponent = value && std::abs(*value) < 300 ? static_cast<int>(*value) : 0;
    word = word.substr(0, e);
  }
  const std::size_t point = word.find('.');
  if (point != std::string_view::npos)
    exponent -= static_cast<int>(std::min<std::size_t>(word.size() - point - 1, 300));
  return std::pow(10.0, exponent);
}

}  // namespace phare
