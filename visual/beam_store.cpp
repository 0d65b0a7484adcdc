#include "visual/beam_store.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace phare {

namespace {

constexpr std::size_t kMaxBins = 65536;
constexpr std::size_t kMaxEvenNodes = 4u << 20;

/// Nodes at multiples of a fine step within ±fine·step, beyond that at multiples of a coarse one from there.
struct EvenAxis {
  std::int64_t step = 0;    ///< millionths of a degree
  std::int64_t fine = 0;    ///< fine nodes on either side of 0
  std::int64_t coarse = 1;  ///< fine steps in a coarse one
  std::int64_t before = 0;  ///< nodes before 0
  std::size_t count = 0;

  double angle_deg(std::int64_t node) const {
    const std::int64_t inner = std::clamp(node, -fine, fine);
    return static_cast<double>((inner + (node - inner) * coarse) * step) * 1e-6;
  }
  /// Whole nodes from 0 to an angle in millionths.
  std::int64_t node_of(std::int64_t angle) const {
    const std::int64_t inner = std::clamp(angle, -fine * step, fine * step);
    return inner / step + (angle - inner) / (step * coarse);
  }
};

// The even axis with the fewest nodes that has all of these. Angles count as written in millionths of a degree.
std::optional<EvenAxis> even_axis(const std::vector<double>& nodes_deg) {
  std::vector<std::int64_t> nodes;
  std::int64_t step = 0, farthest = 0;
  for (double node : nodes_deg) {
    const double millionths = node * 1e6;
    if (std::abs(millionths - std::round(millionths)) > 1e-3) return std::nullopt;
    nodes.push_back(std::llround(millionths));
    step = std::gcd(step, nodes.back());
    farthest = std::max(farthest, std::abs(nodes.back()));
  }
  std::optional<EvenAxis> best;
  for (std::int64_t border : nodes) {
    if (border < 0) continue;
    EvenAxis axis{.step = step, .fine = border / step};
    std::int64_t rest = 0;
    for (std::int64_t node : nodes)
      if (std::abs(node) > border) rest = std::gcd(rest, std::abs(node) - border);
    axis.coarse = rest > 0 ? rest / step : 1;
    axis.before = -axis.node_of(nodes.front());
    axis.count = static_cast<std::size_t>(axis.node_of(nodes.back()) + axis.before + 1);
    const auto most = static_cast<std::int64_t>(shader::kMaxNodes) - 1;
    if (axis.count > shader::kMaxNodes - 1 || axis.before < 0 || axis.before > most || axis.fine > most || axis.coarse > most) continue;
    if (!best || axis.count < best->count) best = axis;
  }
  return best;
}

// For each node of the even axis: the table's node before it, and the way to the next.
std::vector<std::pair<std::size_t, double>> places_on(const std::vector<double>& nodes_deg, const EvenAxis& axis) {
  std::vector<std::pair<std::size_t, double>> places;
  std::size_t before = 0;
  for (std::size_t i = 0; i < axis.count; ++i) {
    const double at = axis.angle_deg(static_cast<std::int64_t>(i) - axis.before);
    while (before + 2 < nodes_deg.size() && nodes_deg[before + 1] <= at + 1e-9) ++before;
    places.emplace_back(before, std::clamp((at - nodes_deg[before]) / (nodes_deg[before + 1] - nodes_deg[before]), 0.0, 1.0));
  }
  return places;
}

float in_one_number(const EvenAxis& axis) { return static_cast<float>(axis.before * shader::kMaxNodes + axis.fine); }

void pack_even(PackedBeam& packed, const std::vector<double>& first_deg, const std::vector<double>& second_deg, const EvenAxis& first, const EvenAxis& second,
               const std::vector<float>& candela) {
  const auto columns = places_on(first_deg, first);
  const auto rows = places_on(second_deg, second);
  packed.candela.reserve((first.count + 1) * (second.count + 1));
  for (const auto& [j, t] : rows) {
    const float* low = &candela[j * first_deg.size()];
    const float* high = low + first_deg.size();
    for (const auto& [i, s] : columns) {
      auto along = [&, i = i, s = s](const float* row) { return (1.0 - s) * static_cast<double>(row[i]) + s * static_cast<double>(row[i + 1]); };
      packed.candela.push_back(static_cast<float>((1.0 - t) * along(low) + t * along(high)));
    }
    packed.candela.push_back(0.0f);
  }
  packed.candela.resize(packed.candela.size() + first.count + 1, 0.0f);
  packed.columns = static_cast<std::uint32_t>(first.count + 1);
  packed.candela_rows = static_cast<std::uint32_t>(second.count + 1);
  packed.grid = {1e6 / static_cast<double>(first.step), 1e6 / static_cast<double>(second.step), in_one_number(first), in_one_number(second)};
  packed.coarse = {first.coarse, second.coarse, 0, 0};
}

std::vector<glm::vec4> make_guide(const std::vector<double>& nodes_deg, float& bins_per_deg) {
  const std::vector<float> nodes(nodes_deg.begin(), nodes_deg.end());
  float closest = nodes.back() - nodes.front();
  for (std::size_t i = 1; i < nodes.size(); ++i) closest = std::min(closest, nodes[i] - nodes[i - 1]);
  const float range = nodes.back() - nodes.front();
  const auto bins = std::min(kMaxBins, static_cast<std::size_t>(std::ceil(1.01f * range / closest)) + 1);
  bins_per_deg = static_cast<float>(bins - 1) / range;
  auto slope_after = [&](std::size_t i) { return i + 1 < nodes.size() ? 1.0f / (nodes[i + 1] - nodes[i]) : 0.0f; };
  std::vector<glm::vec4> guide(bins);
  std::size_t node = 0;  // the last node at or before the end of this bin
  for (std::size_t bin = 0; bin < bins; ++bin) {
    auto bin_of = [&](float angle) { return static_cast<std::size_t>((angle - nodes.front()) * bins_per_deg); };
    while (node + 1 < nodes.size() && bin_of(nodes[node + 1]) <= bin) ++node;
    const float before = node > 0 ? slope_after(node - 1) : slope_after(0);
    guide[bin] = {nodes[node], static_cast<float>(node), before, slope_after(node)};
  }
  return guide;
}

void pack_guided(PackedBeam& packed, const std::vector<double>& first_deg, const std::vector<double>& second_deg, const std::vector<float>& candela) {
  float first_bins = 0.0f, second_bins = 0.0f;
  packed.guide = make_guide(first_deg, first_bins);
  const std::vector<glm::vec4> second_guide = make_guide(second_deg, second_bins);
  packed.second_guide = static_cast<std::uint32_t>(packed.guide.size());
  packed.range = {first_deg.front(), first_deg.back(), second_deg.front(), second_deg.back()};
  packed.bins_per_deg = {first_bins, second_bins, static_cast<float>(packed.guide.size() - 1), static_cast<float>(second_guide.size() - 1)};
  packed.guide.insert(packed.guide.end(), second_guide.begin(), second_guide.end());
  packed.guide.resize((packed.guide.size() + shader::kGuideRow - 1) / shader::kGuideRow * shader::kGuideRow);
  packed.columns = static_cast<std::uint32_t>(first_deg.size() + 1);
  packed.candela_rows = static_cast<std::uint32_t>(second_deg.size() + 1);
  packed.candela.assign(std::size_t{packed.columns} * packed.candela_rows, 0.0f);
  for (std::size_t j = 0; j < second_deg.size(); ++j)
    std::copy_n(candela.begin() + static_cast<std::ptrdiff_t>(j * first_deg.size()), first_deg.size(),
                packed.candela.begin() + static_cast<std::ptrdiff_t>(j * packed.columns));
}

}  // namespace

PackedBeam pack_beam(const BeamImage& image) {
  PackedBeam packed;
  packed.dark = image.dark || image.first_deg.size() < 2 || image.second_deg.size() < 2;
  packed.colour = image.colour;
  if (packed.dark) return packed;

  // The image's frame: x forward, y left, z up. The shader's: first = atan2(b, a), second = atan2(c, hypot(a, b)).
  const glm::dvec3 forward(1, 0, 0), right(0, -1, 0), up(0, 0, 1);
  std::vector<double> first = image.first_deg, second = image.second_deg;
  std::vector<float> candela = image.candela;
  switch (image.type) {
    case PhotometricType::kA: packed.rows = {forward, right, up}; break;
    case PhotometricType::kB:
      packed.rows = {forward, up, right};
      std::swap(first, second);
      for (std::size_t i = 0; i < second.size(); ++i)
        for (std::size_t j = 0; j < first.size(); ++j) candela[i * first.size() + j] = image.candela[j * second.size() + i];
      break;
    case PhotometricType::kC:
      // gamma 0 ahead: c0 right, c90 up, g0 forward. gamma 90 ahead: c0 forward, c90 left, g0 down. second = gamma - 90, along -g0.
      if (image.axis == GammaAxis::kGamma0) packed.rows = {right, up, -forward};
      else packed.rows = {forward, -right, up};
      for (double& gamma_deg : second) gamma_deg -= 90.0;
      break;
  }
  const std::optional<EvenAxis> even_first = even_axis(first), even_second = even_axis(second);
  const bool turn = first.back() > 180.0;  // the shader's turn knows no coarse steps
  if (even_first && even_second && even_first->count * even_second->count <= kMaxEvenNodes && (!turn || (even_first->coarse == 1 && even_second->coarse == 1))) {
    packed.lookup = turn ? shader::kLookupEvenTurn : shader::kLookupEven;
    pack_even(packed, first, second, *even_first, *even_second, candela);
  } else {
    pack_guided(packed, first, second, candela);
  }
  return packed;
}

BeamStore::BeamStore(gpu::Device& device) : device_(device) {
  nothing_ = gpu::Image(device, vk::Format::eR32Sfloat, {1, 1}, vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, "no beam");
  const float dark = 0.0f;
  gpu::fill_image(device, nothing_, std::as_bytes(std::span(&dark, 1)));
}

void BeamStore::set(std::size_t index, const BeamImage& image) {
  beams_.at(index).packed = pack_beam(image);
  beams_.at(index).changed = true;
}

// Makes the image anew if it has another size.
bool BeamStore::fit(gpu::Image& image, vk::Format format, std::uint32_t width, std::uint32_t height, const char* name) {
  if (*image.image && image.extent == vk::Extent2D{width, height}) return false;
  device_.allocated_bytes -= image.bytes;
  image = gpu::Image(device_, format, {width, height}, vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, name);
  return true;
}

bool BeamStore::upload() {
  bool fresh = false;
  for (Beam& beam : beams_) {
    if (!std::exchange(beam.changed, false) || beam.packed.dark) continue;
    ++uploads_;
    fresh |= fit(beam.candela, vk::Format::eR32Sfloat, beam.packed.columns, beam.packed.candela_rows, "beam candela");
    gpu::fill_image(device_, beam.candela, std::as_bytes(std::span(beam.packed.candela)));
    if (beam.packed.lookup != shader::kLookupGuide) continue;
    const auto guide_rows = static_cast<std::uint32_t>(beam.packed.guide.size() / shader::kGuideRow);
    fresh |= fit(beam.guide, vk::Format::eR32G32B32A32Sfloat, shader::kGuideRow, guide_rows, "beam guide");
    gpu::fill_image(device_, beam.guide, std::as_bytes(std::span(beam.packed.guide)));
  }
  return fresh;
}

void BeamStore::describe(std::size_t index, shader::GpuLamp& lamp) const {
  const PackedBeam& beam = beams_.at(index).packed;
  lamp.colour = {beam.colour.x, beam.colour.y, beam.colour.z, 1.0f};
  lamp.grid = beam.grid;
  lamp.coarse = beam.coarse;
  lamp.range = beam.range;
  lamp.bins_per_deg = beam.bins_per_deg;
  lamp.guide = {beam.second_guide, 0u, 0u, 0u};
}

}  // namespace phare
