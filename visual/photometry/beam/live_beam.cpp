// The image of a lamp position kept up to date.
// Computes: which sums are needed, through BeamComposer; colour as one while all lit sources share it, else as tables
// beside candela. Source: design §4. Frame: angles of the image. Leaves out: colour over direction within one source.
// Checked by tests/photometry/live_beam_test.cpp.
#include "visual/photometry/beam/live_beam.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <utility>

namespace phare {

LiveBeam::LiveBeam(std::vector<AimedSource> sources) {
  std::size_t kinds = 0;
  for (AimedSource& light : sources) {
    Source source{
        .light = light, .lumens = light.scale * light.table->flux_lm(), .colour = light_colour(light), .kind = kinds};
    for (const Source& other : sources_)
      if (same_angles(other.light, light)) source.kind = other.kind;
    if (source.kind == kinds) ++kinds;
    sources_.push_back(std::move(source));
  }
  sums_.resize(kinds + 1);
  if (!sources_.empty()) image_.car_from_image = sources_.front().light.car_from_lamp;
  image_.first_deg = image_.second_deg = {-1.0, 1.0};
  image_.candela.assign(4, 0.0f);
}

void LiveBeam::set_dimming(std::size_t source, double dimming_01) {
  if (sources_[source].dimming_01 == dimming_01) return;
  sources_[source].dimming_01 = dimming_01;
  stale_ = true;
}

template <typename Do>
void LiveBeam::change_sums_of(std::size_t source, Do&& change) {
  for (std::optional<Sum>& sum : sums_) {
    if (!sum) continue;
    const auto at = std::ranges::find(sum->source_of, source);
    if (at != sum->source_of.end()) change(sum->composer, static_cast<std::size_t>(at - sum->source_of.begin()));
  }
  stale_ = true;
}

void LiveBeam::set_table(std::size_t source, const IntensityTable& table) {
  sources_[source].light.table = &table;
  change_sums_of(source, [&](BeamComposer& composer, std::size_t at) { composer.set_table(at, table); });
}

void LiveBeam::table_changed(std::size_t source, std::span<const TexelRect> nodes, double flux_lm) {
  if (nodes.empty()) return;
  sources_[source].lumens = sources_[source].light.scale * flux_lm;
  change_sums_of(source, [&](BeamComposer& composer, std::size_t at) { composer.table_changed(at, nodes); });
}

/// The kind that all lit sources have, or the sum of all kinds; nothing when all is dark.
std::optional<std::size_t> LiveBeam::wanted_sum() const {
  std::optional<std::size_t> wanted;
  for (const Source& source : sources_) {
    if (source.dimming_01 <= 0.0 || source.light.scale <= 0.0 || source.lumens <= 0.0) continue;
    wanted = wanted && *wanted != source.kind ? sums_.size() - 1 : source.kind;
    if (*wanted == sums_.size() - 1) break;
  }
  return wanted;
}

LiveBeam::Sum LiveBeam::make_sum(std::size_t which) const {
  std::vector<AimedSource> lights;
  std::vector<std::size_t> source_of;
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    if (which + 1 < sums_.size() && sources_[k].kind != which) continue;
    lights.push_back(sources_[k].light);
    source_of.push_back(k);
  }
  BeamGrid grid = beam_grid(lights);
  BeamComposer composer(grid.first_deg, grid.second_deg, grid.type, grid.axis, grid.screen_distance_m > 0.0);
  for (const AimedSource& light : lights)
    composer.add(*light.table,
                 grid.resampled ? glm::transpose(grid.car_from_image) * light.car_from_lamp : glm::dmat3{1.0},
                 light_colour(light), light.changes);
  return {std::move(grid), std::move(composer), std::move(source_of)};
}

bool LiveBeam::colours_differ() const {
  const Source* first = nullptr;
  for (const Source& source : sources_) {
    if (source.dimming_01 <= 0.0 || source.lumens <= 0.0) continue;
    if (first != nullptr && source.colour != first->colour) return true;
    first = &source;
  }
  return false;
}

double LiveBeam::lumens() const {
  double sum = 0.0;
  for (const Source& source : sources_) sum += source.dimming_01 * source.lumens;
  return sum;
}

glm::vec3 LiveBeam::mean_colour() const {
  glm::dvec3 sum{0.0};
  double lumens = 0.0;
  for (const Source& source : sources_) {
    sum += source.dimming_01 * source.lumens * glm::dvec3(source.colour);
    lumens += source.dimming_01 * source.lumens;
  }
  return lumens > 0.0 ? glm::vec3(sum / lumens) : glm::vec3{1.0f};
}

LiveBeam::Change LiveBeam::update() {
  changed_.clear();
  if (!std::exchange(stale_, false)) return Change::kNone;
  const std::optional<std::size_t> wanted = wanted_sum();
  if (!wanted) {  // nothing to draw, so nothing to sum
    const bool was_dark = std::exchange(image_.dark, true);
    return was_dark ? Change::kNone : Change::kPart;
  }
  std::optional<Sum>& sum = sums_[*wanted];
  if (!sum) sum = make_sum(*wanted);
  for (std::size_t k = 0; k < sum->source_of.size(); ++k) {
    const Source& source = sources_[sum->source_of[k]];
    sum->composer.set_dimming(k, source.dimming_01 * source.light.scale);
  }
  const bool mixed = colours_differ(), was_mixed = !image_.tints.empty();
  sum->composer.keep_tints(mixed);
  changed_ = sum->composer.update();
  image_.colour = mean_colour();
  const bool was_dark = std::exchange(image_.dark, false);
  const std::span<const float> candela = sum->composer.candela();
  const std::span<const glm::vec2> tints = sum->composer.tints();
  if (shown_ != wanted || mixed != was_mixed) {
    shown_ = wanted;
    static_cast<BeamGrid&>(image_) = sum->grid;
    image_.candela.assign(candela.begin(), candela.end());
    image_.tints.assign(tints.begin(), tints.end());
    changed_ = {{0, 0, image_.first_deg.size(), image_.second_deg.size()}};
    return Change::kWhole;
  }
  const std::size_t columns = image_.first_deg.size();
  for (const TexelRect& rect : changed_) {
    for (std::size_t j = rect.row; j < rect.end_row; ++j) {
      const auto row = static_cast<std::ptrdiff_t>(j * columns);
      std::copy(candela.begin() + row + static_cast<std::ptrdiff_t>(rect.column),
                candela.begin() + row + static_cast<std::ptrdiff_t>(rect.end_column),
                image_.candela.begin() + row + static_cast<std::ptrdiff_t>(rect.column));
      if (mixed)
        std::copy(tints.begin() + row + static_cast<std::ptrdiff_t>(rect.column),
                  tints.begin() + row + static_cast<std::ptrdiff_t>(rect.end_column),
                  image_.tints.begin() + row + static_cast<std::ptrdiff_t>(rect.column));
    }
  }
  return changed_.empty() && !was_dark ? Change::kNone : Change::kPart;
}

std::uint64_t LiveBeam::summed_texels() const {
  std::uint64_t texels = 0;
  for (const std::optional<Sum>& sum : sums_) texels += sum ? sum->composer.count().texels : 0;
  return texels;
}

}  // namespace phare
