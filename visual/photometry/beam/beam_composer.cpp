// Recomposition of a beam image from what changed.
// Computes: image = Σ scale·source, over rectangles. Source: design §4. Frame: angles of the image, of its photometric
// type. Leaves out: colour over direction within one source. Checked by tests/photometry/beam_composer_test.cpp (bit
// equality with a fresh image, counters).
#include "visual/photometry/beam/beam_composer.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "visual/photometry/beam/beam_image.h"

namespace phare {

BeamComposer::BeamComposer(std::vector<double> first_deg, std::vector<double> second_deg, PhotometricType type,
                           GammaAxis axis, bool screen)
    : first_deg_(std::move(first_deg)), second_deg_(std::move(second_deg)), type_(type), axis_(axis), screen_(screen) {
  assert(first_deg_.size() >= 2 && second_deg_.size() >= 2);
  image_.assign(first_deg_.size() * second_deg_.size(), 0.0f);
}

std::size_t BeamComposer::add(const IntensityTable& table, const glm::dmat3& image_from_lamp, const glm::vec3& colour,
                              bool changes) {
  Source source;
  source.table = &table;
  source.changes = changes;
  source.image_from_lamp = image_from_lamp;
  source.red_blue = {colour.x, colour.z};
  sample(source);
  sources_.push_back(std::move(source));
  return sources_.size() - 1;
}

void BeamComposer::set_dimming(std::size_t source, double scale) {
  const float wanted = static_cast<float>(std::max(0.0, scale));
  if (sources_[source].scale == wanted) return;
  sources_[source].scale = wanted;
  sources_[source].dirty = true;
}

void BeamComposer::set_swivel(std::size_t index, double yaw_rad, double pitch_rad) {
  Source& source = sources_[index];
  const glm::dmat3 image_from_lamp = aim_rotation(yaw_rad, pitch_rad, 0.0);
  if (source.image_from_lamp == image_from_lamp) return;
  stale_.push_back(source.rect);
  source.image_from_lamp = image_from_lamp;
  sample(source);
}

void BeamComposer::set_table(std::size_t index, const IntensityTable& table) {
  if (sources_[index].table == &table) return;
  stale_.push_back(sources_[index].rect);
  sources_[index].table = &table;
  sample(sources_[index]);
}

void BeamComposer::table_changed(std::size_t index, std::span<const TexelRect> nodes) {
  Source& source = sources_[index];
  const IntensityTable& table = *source.table;
  if (!as_filed(source)) {
    stale_.push_back(source.rect);
    return sample(source);
  }
  // Between a node that changed and its neighbours that did not, the light changes too.
  const auto between = [](const std::vector<double>& grid, const std::vector<double>& own, std::size_t from,
                          std::size_t to) {
    const auto begin = from == 0 ? std::lower_bound(grid.begin(), grid.end(), own.front())
                                 : std::upper_bound(grid.begin(), grid.end(), own[from - 1]);
    const auto end = to >= own.size() ? std::upper_bound(grid.begin(), grid.end(), own.back())
                                      : std::lower_bound(grid.begin(), grid.end(), own[to]);
    return std::pair{static_cast<std::size_t>(begin - grid.begin()), static_cast<std::size_t>(end - grid.begin())};
  };
  assert(source.changes);  // else only where it shone is kept
  const std::size_t across = source.rect.end_column - source.rect.column;
  for (const TexelRect& rect : nodes) {
    const auto [column, end_column] = between(first_deg_, table.first_deg, rect.column, rect.end_column);
    const auto [row, end_row] = between(second_deg_, table.second_deg, rect.row, rect.end_row);
    for (std::size_t j = row; j < end_row; ++j)
      for (std::size_t i = column; i < end_column; ++i)
        source.candela[(j - source.rect.row) * across + i - source.rect.column] =
            static_cast<float>(table.intensity_at_cd({first_deg_[i], second_deg_[j]}));
    stale_.push_back({column, row, end_column, end_row});
  }
}

bool BeamComposer::as_filed(const Source& source) const {
  const IntensityTable& table = *source.table;
  return source.image_from_lamp == glm::dmat3{1.0} && table.type == type_ &&
         (type_ != PhotometricType::kC || table.axis == axis_) && (table.screen_distance_m > 0.0) == screen_;
}

void BeamComposer::sample(Source& source) {
  const IntensityTable& table = *source.table;
  const std::size_t columns = first_deg_.size(), rows = second_deg_.size();
  const bool own_angles = as_filed(source);
  // In its own angles a table is dark beyond its limits.
  const auto within = [&](const std::vector<double>& nodes, const std::vector<double>& own) {
    if (!own_angles) return std::pair{std::size_t{0}, nodes.size()};
    const auto begin = std::lower_bound(nodes.begin(), nodes.end(), own.front());
    return std::pair{static_cast<std::size_t>(begin - nodes.begin()),
                     static_cast<std::size_t>(std::upper_bound(begin, nodes.end(), own.back()) - nodes.begin())};
  };
  const auto [first_column, last_column] = within(first_deg_, table.first_deg);
  const auto [first_row, last_row] = within(second_deg_, table.second_deg);
  std::vector<float> whole(columns * rows, 0.0f);
  TexelRect rect{columns, rows, 0, 0};
  if (source.changes) rect = {first_column, first_row, last_column, last_row};
  for (std::size_t j = first_row; j < last_row; ++j) {
    for (std::size_t i = first_column; i < last_column; ++i) {
      const TableAngles angles{first_deg_[i], second_deg_[j]};
      const glm::dvec3 direction = screen_ ? screen_direction(angles) : table_direction(type_, axis_, angles);
      const double cd =
          own_angles ? table.intensity_at_cd(angles) : table.intensity_cd(direction * source.image_from_lamp);
      if (cd <= 0.0) continue;
      whole[j * columns + i] = static_cast<float>(cd);
      rect = {std::min(rect.column, i), std::min(rect.row, j), std::max(rect.end_column, i + 1),
              std::max(rect.end_row, j + 1)};
    }
  }
  source.rect = rect;
  source.candela.clear();
  for (std::size_t j = rect.row; j < rect.end_row && !rect.empty(); ++j) {
    const auto row = whole.begin() + static_cast<std::ptrdiff_t>(j * columns);
    source.candela.insert(source.candela.end(), row + static_cast<std::ptrdiff_t>(rect.column),
                          row + static_cast<std::ptrdiff_t>(rect.end_column));
  }
  source.dirty = true;
  ++count_.sources;
}

// Of row j of the rectangle: row(source, from, to, candela) for each lit source that reaches it, candela[i] of column
// i.
template <typename Row>
void BeamComposer::each_row(const TexelRect& rect, std::size_t j, Row&& row) const {
  for (const Source& source : sources_) {
    if (source.scale == 0.0f || j < source.rect.row || j >= source.rect.end_row) continue;
    const std::size_t from = std::max(rect.column, source.rect.column),
                      to = std::min(rect.end_column, source.rect.end_column);
    if (from >= to) continue;
    row(source, from, to,
        source.candela.data() + (j - source.rect.row) * (source.rect.end_column - source.rect.column) -
            source.rect.column);
  }
}

void BeamComposer::sum(const TexelRect& rect) {
  const std::size_t columns = first_deg_.size();
  for (std::size_t j = rect.row; j < rect.end_row; ++j) {
    float* out = image_.data() + j * columns;
    std::fill(out + rect.column, out + rect.end_column, 0.0f);
    each_row(rect, j, [out](const Source& source, std::size_t from, std::size_t to, const float* in) {
      const float scale = source.scale;
      for (std::size_t i = from; i < to; ++i) out[i] += scale * in[i];
    });
  }
  count_.texels += rect.texels();
}

void BeamComposer::sum_tints(const TexelRect& rect) {
  const std::size_t columns = first_deg_.size();
  for (std::size_t j = rect.row; j < rect.end_row; ++j) {
    glm::vec2* out = tints_.data() + j * columns;
    std::fill(out + rect.column, out + rect.end_column, glm::vec2{0.0f});
    each_row(rect, j, [out](const Source& source, std::size_t from, std::size_t to, const float* in) {
      const glm::vec2 scale = source.scale * source.red_blue;
      for (std::size_t i = from; i < to; ++i) out[i] += scale * in[i];
    });
  }
}

void BeamComposer::keep_tints(bool wanted) {
  tinted_ = wanted;
  if (!wanted) tints_.clear();
}

std::vector<TexelRect> BeamComposer::update() {
  std::vector<TexelRect> changed;
  changed.swap(stale_);
  for (Source& source : sources_) {
    if (source.dirty) changed.push_back(source.rect);
    source.dirty = false;
  }
  std::erase_if(changed, [](const TexelRect& rect) { return rect.empty(); });
  // Rectangles that overlap are summed as one where that is no more work than apart.
  for (bool merged = true; merged;) {
    merged = false;
    for (std::size_t a = 0; a < changed.size() && !merged; ++a) {
      for (std::size_t b = a + 1; b < changed.size() && !merged; ++b) {
        const TexelRect both{std::min(changed[a].column, changed[b].column), std::min(changed[a].row, changed[b].row),
                             std::max(changed[a].end_column, changed[b].end_column),
                             std::max(changed[a].end_row, changed[b].end_row)};
        if (both.texels() > changed[a].texels() + changed[b].texels()) continue;
        changed[a] = both;
        changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(b));
        merged = true;
      }
    }
  }
  for (const TexelRect& rect : changed) sum(rect);
  if (tinted_ && tints_.empty()) {
    tints_.resize(image_.size());
    sum_tints({0, 0, columns(), rows()});
  } else if (tinted_) {
    for (const TexelRect& rect : changed) sum_tints(rect);
  }
  ++(changed.empty() ? count_.idle : count_.images);
  return changed;
}

}  // namespace phare
