// The table of a pixel light, from its frame.
// Computes: node = full light × share of the pixel it shows; for a bent raster the inverse of the map's bilinear
// patches, once. Source: design §4. Frame: H, V of the lamp, type A. Leaves out: stray light between pixels, heat.
// Checked by tests/photometry/pixel_light_test.cpp.
#include "visual/photometry/beam/pixel_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <set>

#include "config/formats/csv_table.h"
#include "visual/image/image.h"

namespace phare {

namespace {

constexpr std::size_t kTile = 32;  // pixels, and nodes, that are compared and looked up together
constexpr std::size_t kMostRects = 32;

TexelRect around(const TexelRect& a, const TexelRect& b) {
  return {std::min(a.column, b.column), std::min(a.row, b.row), std::max(a.end_column, b.end_column),
          std::max(a.end_row, b.end_row)};
}

/// Neighbours in a row of tiles as one, then equal spans of rows one below the other; too many of them: one around all.
void add_tile(std::vector<TexelRect>& rects, const TexelRect& tile) {
  if (!rects.empty() && rects.back().row == tile.row && rects.back().end_column == tile.column)
    rects.back().end_column = tile.end_column;
  else
    rects.push_back(tile);
}
std::vector<TexelRect> stacked(const std::vector<TexelRect>& rects) {
  std::vector<TexelRect> result;
  for (const TexelRect& rect : rects) {
    const auto above = std::ranges::find_if(result, [&](const TexelRect& other) {
      return other.end_row == rect.row && other.column == rect.column && other.end_column == rect.end_column;
    });
    if (above != result.end())
      above->end_row = rect.end_row;
    else
      result.push_back(rect);
  }
  if (result.size() <= kMostRects) return result;
  TexelRect all = result.front();
  for (const TexelRect& rect : result) all = around(all, rect);
  return {all};
}

/// Where in a patch (0 to 1 in both) the point lies, by Newton's method; nothing: outside, but for a rounding.
std::optional<glm::dvec2> within_patch(const glm::dvec2 corners[4], const glm::dvec2& point) {
  glm::dvec2 at{0.5};
  for (int i = 0; i < 12; ++i) {
    const glm::dvec2 below = glm::mix(corners[0], corners[1], at.x), above = glm::mix(corners[2], corners[3], at.x);
    const glm::dvec2 by_x = glm::mix(corners[1] - corners[0], corners[3] - corners[2], at.y), by_y = above - below;
    const glm::dvec2 missing = point - glm::mix(below, above, at.y);
    const double area = by_x.x * by_y.y - by_x.y * by_y.x;
    if (area == 0.0) return std::nullopt;
    at += glm::dvec2(missing.x * by_y.y - missing.y * by_y.x, by_x.x * missing.y - by_x.y * missing.x) / area;
  }
  constexpr double kRounding = 1e-9;
  if (!(at.x >= -kRounding && at.x <= 1.0 + kRounding && at.y >= -kRounding && at.y <= 1.0 + kRounding))
    return std::nullopt;
  return at;
}

bool is_even(const PixelMap& map) {
  return map.columns.size() == 2 && map.rows.size() == 2 && map.hv_deg[0].x == map.hv_deg[2].x &&
         map.hv_deg[1].x == map.hv_deg[3].x && map.hv_deg[0].y == map.hv_deg[1].y && map.hv_deg[2].y == map.hv_deg[3].y;
}

}  // namespace

Result<PixelFrame> read_pixel_frame(const std::filesystem::path& file) {
  Result<Grey8> picture = read_grey(file, static_cast<int>(kMostPixelsAcross));
  if (!picture) return picture.error();
  return PixelFrame{static_cast<std::size_t>(picture->width_px), static_cast<std::size_t>(picture->height_px),
                    std::move(picture->grey)};
}

Result<PixelMap> read_pixel_map(const std::filesystem::path& file, std::size_t columns, std::size_t rows) {
  const Result<CsvTable> table = CsvTable::read(file);
  if (!table) return table.error();
  std::size_t at[4]{};
  const char* const names[4] = {"column", "row", "h_deg", "v_deg"};
  for (int i = 0; i < 4; ++i) {
    const auto found = table->find({names[i]});
    if (!found)
      return Error{file.string() + ":" + std::to_string(table->header_line()),
                   std::string("no column \"") + names[i] + "\"; a pixel map has column, row, h_deg, v_deg"};
    at[i] = *found;
  }
  std::set<double> across, down;
  std::map<std::pair<double, double>, std::pair<glm::dvec2, std::size_t>> knots;  // by row, column
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const double column = table->at(i, at[0]), row = table->at(i, at[1]);
    const glm::dvec2 hv_deg{table->at(i, at[2]), table->at(i, at[3])};
    if (!(column >= 0.0 && column <= static_cast<double>(columns) && row >= 0.0 && row <= static_cast<double>(rows)))
      return Error{table->place(i), "a knot beyond a raster of " + std::to_string(columns) + " × " +
                                        std::to_string(rows) + " pixels (0 to its size)"};
    if (!(std::abs(hv_deg.x) <= 90.0 && std::abs(hv_deg.y) <= 90.0))
      return Error{table->place(i), "h_deg and v_deg are -90 to 90"};
    if (!knots.emplace(std::pair{row, column}, std::pair{hv_deg, i}).second)
      return Error{table->place(i), "this knot is there twice"};
    across.insert(column), down.insert(row);
  }
  PixelMap map{{across.begin(), across.end()}, {down.begin(), down.end()}, {}};
  const auto from_edge_to_edge = [](const std::vector<double>& at_px, std::size_t size) {
    return at_px.size() >= 2 && at_px.front() == 0.0 && at_px.back() == static_cast<double>(size);
  };
  if (!from_edge_to_edge(map.columns, columns) || !from_edge_to_edge(map.rows, rows))
    return Error{file.string(), "knots have to reach from 0 to " + std::to_string(columns) + " in column and to " +
                                    std::to_string(rows) + " in row, the size of the picture"};
  if (knots.size() != across.size() * down.size())
    return Error{file.string(), std::to_string(knots.size()) + " knots, not one for each of " +
                                    std::to_string(across.size()) + " columns in each of " +
                                    std::to_string(down.size()) + " rows"};
  for (const auto& [where, knot] : knots) map.hv_deg.push_back(knot.first);
  for (std::size_t j = 0; j < map.rows.size(); ++j)
    for (std::size_t i = 0; i < map.columns.size(); ++i) {
      const std::size_t here = j * map.columns.size() + i;
      const bool folds = (i > 0 && map.hv_deg[here].x <= map.hv_deg[here - 1].x) ||
                         (j > 0 && map.hv_deg[here].y >= map.hv_deg[here - map.columns.size()].y);
      if (folds)
        return Error{table->place(knots.at({map.rows[j], map.columns[i]}).second),
                     "the map folds over: h_deg grows with column, v_deg falls with row"};
    }
  return map;
}

PixelMap even_map(std::size_t columns, std::size_t rows, glm::dvec2 low_deg, glm::dvec2 high_deg) {
  return {{0.0, static_cast<double>(columns)},
          {0.0, static_cast<double>(rows)},
          {{low_deg.x, high_deg.y}, {high_deg.x, high_deg.y}, {low_deg.x, low_deg.y}, {high_deg.x, low_deg.y}}};
}

PixelLight::PixelLight(const IntensityTable& full, const PixelMap& map, std::size_t columns, std::size_t rows)
    : columns_(columns), rows_(rows), shares_(columns * rows, 0) {
  glm::dvec2 low_deg = map.hv_deg.front(), high_deg = low_deg;
  for (const glm::dvec2& hv_deg : map.hv_deg)
    low_deg = glm::min(low_deg, hv_deg), high_deg = glm::max(high_deg, hv_deg);
  const glm::dvec2 step_deg =
      (high_deg - low_deg) / glm::dvec2(static_cast<double>(columns), static_cast<double>(rows));
  table_.name = full.name;
  table_.content_hash = full.content_hash;
  table_.version = full.version;
  table_.notes = full.notes;
  table_.header = full.header;
  for (std::size_t i = 0; i < columns + 2; ++i)
    table_.first_deg.push_back(low_deg.x + (static_cast<double>(i) - 0.5) * step_deg.x);
  for (std::size_t j = 0; j < rows + 2; ++j)
    table_.second_deg.push_back(low_deg.y + (static_cast<double>(j) - 0.5) * step_deg.y);
  const std::size_t across = columns + 2, nodes = across * (rows + 2);
  table_.candela.assign(nodes, 0.0);
  row_cd_.assign(rows + 2, 0.0);
  full_cd_.reserve(nodes);
  for (const double v_deg : table_.second_deg)
    for (const double h_deg : table_.first_deg) full_cd_.push_back(full.intensity_cd(direction_hv(h_deg, v_deg)));
  if (is_even(map)) return;

  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  pixel_.assign(nodes, glm::vec2(kNone));
  const std::size_t knots_across = map.columns.size();
  for (std::size_t q = 0; q + 1 < map.rows.size(); ++q) {
    for (std::size_t p = 0; p + 1 < knots_across; ++p) {
      const glm::dvec2 corners[4] = {map.hv_deg[q * knots_across + p], map.hv_deg[q * knots_across + p + 1],
                                     map.hv_deg[(q + 1) * knots_across + p],
                                     map.hv_deg[(q + 1) * knots_across + p + 1]};
      glm::dvec2 low = corners[0], high = corners[0];
      for (const glm::dvec2& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
      const auto nodes_within = [](const std::vector<double>& axis, double from, double to) {
        return std::pair{static_cast<std::size_t>(std::ranges::lower_bound(axis, from) - axis.begin()),
                         static_cast<std::size_t>(std::ranges::upper_bound(axis, to) - axis.begin())};
      };
      const auto [i_begin, i_end] = nodes_within(table_.first_deg, low.x, high.x);
      const auto [j_begin, j_end] = nodes_within(table_.second_deg, low.y, high.y);
      for (std::size_t j = j_begin; j < j_end; ++j)
        for (std::size_t i = i_begin; i < i_end; ++i)
          if (const auto at = within_patch(corners, {table_.first_deg[i], table_.second_deg[j]}))
            pixel_[j * across + i] = {static_cast<float>(glm::mix(map.columns[p], map.columns[p + 1], at->x)),
                                      static_cast<float>(glm::mix(map.rows[q], map.rows[q + 1], at->y))};
    }
  }
  for (std::size_t j = 0; j < rows + 2; j += kTile) {
    for (std::size_t i = 0; i < across; i += kTile) {
      TexelRect shows{columns_, rows_, 0, 0};
      for (std::size_t b = j; b < std::min(j + kTile, rows + 2); ++b)
        for (std::size_t a = i; a < std::min(i + kTile, across); ++a) {
          const glm::vec2 pixel = pixel_[b * across + a];
          if (std::isnan(pixel.x)) continue;
          const auto first = [](float at) { return static_cast<std::size_t>(std::max(at - 0.5f, 0.0f)); };
          shows = around(shows, {first(pixel.x), first(pixel.y), std::min(first(pixel.x) + 2, columns_),
                                 std::min(first(pixel.y) + 2, rows_)});
        }
      tile_shows_.push_back(shows);
    }
  }
}

/// Bilinear between the middles of pixels, dark beyond the rim.
double PixelLight::share_at(double column, double row) const {
  const double x = column - 0.5, y = row - 0.5;
  const auto i = static_cast<std::ptrdiff_t>(std::floor(x)), j = static_cast<std::ptrdiff_t>(std::floor(y));
  const auto at = [this](std::ptrdiff_t a, std::ptrdiff_t b) {
    const auto columns = static_cast<std::ptrdiff_t>(columns_);
    return a < 0 || b < 0 || a >= columns || b >= static_cast<std::ptrdiff_t>(rows_)
               ? 0.0
               : static_cast<double>(shares_[static_cast<std::size_t>(b * columns + a)]);
  };
  const double u = x - std::floor(x), v = y - std::floor(y);
  return ((1.0 - v) * ((1.0 - u) * at(i, j) + u * at(i + 1, j)) +
          v * ((1.0 - u) * at(i, j + 1) + u * at(i + 1, j + 1))) /
         255.0;
}

void PixelLight::reckon(const TexelRect& nodes) {
  const std::size_t across = columns_ + 2;
  for (std::size_t j = nodes.row; j < nodes.end_row; ++j) {
    double* out = table_.candela.data() + j * across;
    const double* full = full_cd_.data() + j * across;
    for (std::size_t i = nodes.column; i < nodes.end_column; ++i) {
      double share = 0.0;
      if (!pixel_.empty()) {
        const glm::vec2 pixel = pixel_[j * across + i];
        if (!std::isnan(pixel.x)) share = share_at(pixel.x, pixel.y);
      } else if (i > 0 && i <= columns_ && j > 0 && j <= rows_) {
        share = shares_[(rows_ - j) * columns_ + i - 1] / 255.0;
      }
      out[i] = full[i] * share;
    }
    row_cd_[j] = 0.0;
    for (std::size_t i = 0; i < across; ++i) row_cd_[j] += out[i];
  }
}

double PixelLight::flux_lm() const {
  const double step_sr = glm::radians(table_.first_deg[1] - table_.first_deg[0]) *
                         glm::radians(table_.second_deg[1] - table_.second_deg[0]);
  double sum_lm = 0.0;
  for (std::size_t j = 0; j < row_cd_.size(); ++j)
    sum_lm += row_cd_[j] * std::cos(glm::radians(table_.second_deg[j])) * step_sr;
  return sum_lm;
}

std::vector<TexelRect> PixelLight::show(const PixelFrame& frame) {
  std::vector<TexelRect> tiles;
  for (std::size_t j = 0; j < rows_; j += kTile) {
    const std::size_t end_j = std::min(j + kTile, rows_);
    for (std::size_t i = 0; i < columns_; i += kTile) {
      const std::size_t end_i = std::min(i + kTile, columns_);
      bool differs = false;
      for (std::size_t b = j; b < end_j && !differs; ++b) {
        const auto begin = static_cast<std::ptrdiff_t>(b * columns_ + i);
        differs =
            !std::equal(frame.shares.begin() + begin,
                        frame.shares.begin() + begin + static_cast<std::ptrdiff_t>(end_i - i), shares_.begin() + begin);
      }
      if (differs) add_tile(tiles, {i, j, end_i, end_j});
    }
  }
  const std::vector<TexelRect> pixels = stacked(tiles);
  if (pixels.empty()) return {};
  std::ranges::copy(frame.shares, shares_.begin());
  std::vector<TexelRect> nodes;
  if (pixel_.empty()) {
    for (const TexelRect& rect : pixels)
      nodes.push_back({rect.column + 1, rows_ + 1 - rect.end_row, rect.end_column + 1, rows_ + 1 - rect.row});
  } else {
    const std::size_t across = columns_ + 2, down = rows_ + 2, tiles_across = (across + kTile - 1) / kTile;
    std::vector<TexelRect> shown;
    for (std::size_t t = 0; t < tile_shows_.size(); ++t) {
      const TexelRect& shows = tile_shows_[t];
      const bool changed = std::ranges::any_of(pixels, [&](const TexelRect& rect) {
        return rect.column < shows.end_column && shows.column < rect.end_column && rect.row < shows.end_row &&
               shows.row < rect.end_row;
      });
      const std::size_t i = t % tiles_across * kTile, j = t / tiles_across * kTile;
      if (changed) add_tile(shown, {i, j, std::min(i + kTile, across), std::min(j + kTile, down)});
    }
    nodes = stacked(shown);
  }
  for (const TexelRect& rect : nodes) reckon(rect);
  return nodes;
}

}  // namespace phare
