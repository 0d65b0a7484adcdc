#include "visual/beam_store.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace phare {

namespace {

constexpr std::size_t kMaxBins = 65536;
constexpr std::int64_t kMaxEvenNodes = 4096;      // of one axis
constexpr std::int64_t kMaxEvenImage = 4 << 20;   // nodes: 16 MiB

/// Nodes at multiples of a fine step within ±fine·step, beyond that at multiples of a coarse one from there.
struct EvenAxis {
  std::int64_t step = 0;    ///< millionths of a degree
  std::int64_t fine = 0;    ///< fine nodes on either side of 0
  std::int64_t coarse = 1;  ///< fine steps in a coarse one
  std::int64_t first = 0;   ///< node, from the one at 0
  std::int64_t count = 0;

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

// Angles as written, in millionths of a degree; nothing if one is not whole.
std::optional<std::vector<std::int64_t>> in_millionths(const std::vector<double>& nodes_deg) {
  std::vector<std::int64_t> nodes;
  for (double node : nodes_deg) {
    if (std::abs(node * 1e6 - std::round(node * 1e6)) > 1e-3) return std::nullopt;
    nodes.push_back(std::llround(node * 1e6));
  }
  return nodes;
}

// The even axis of this coarse step with the fewest nodes that has all of these.
std::optional<EvenAxis> even_axis(const std::vector<std::int64_t>& nodes, std::int64_t coarse) {
  std::int64_t step = 0;
  for (std::int64_t node : nodes) step = std::gcd(step, node);
  std::optional<EvenAxis> best;
  auto propose = [&](std::int64_t border) {
    EvenAxis axis{.step = step, .fine = border / step, .coarse = coarse};
    for (std::int64_t node : nodes)
      if (std::abs(node) > border && (std::abs(node) - border) % (step * coarse) != 0) return;
    axis.first = axis.node_of(nodes.front());
    axis.count = axis.node_of(nodes.back()) - axis.first + 1;
    if (!best || axis.count < best->count) best = axis;
  };
  for (std::int64_t border : nodes) propose(std::abs(border));
  return best && best->count < kMaxEvenNodes ? best : std::nullopt;
}

// Both axes with one coarse step, for the shader has room for one; the smallest image wins.
std::optional<std::pair<EvenAxis, EvenAxis>> even_axes(const std::vector<double>& first_deg, const std::vector<double>& second_deg, bool may_be_coarse) {
  const auto first = in_millionths(first_deg), second = in_millionths(second_deg);
  if (!first || !second) return std::nullopt;
  std::optional<std::pair<EvenAxis, EvenAxis>> best;
  for (std::int64_t coarse = 1; coarse <= (may_be_coarse ? 100 : 1); ++coarse) {
    const auto a = even_axis(*first, coarse), b = even_axis(*second, coarse);
    if (!a || !b || a->count * b->count > kMaxEvenImage) continue;
    if (!best || a->count * b->count < best->first.count * best->second.count) best.emplace(*a, *b);
  }
  return best;
}

// For each node of the even axis: the table's node before it, and the way to the next.
std::vector<std::pair<std::size_t, double>> places_on(const std::vector<double>& nodes_deg, const EvenAxis& axis) {
  std::vector<std::pair<std::size_t, double>> places;
  std::size_t before = 0;
  for (std::int64_t i = 0; i < axis.count; ++i) {
    const double at = axis.angle_deg(axis.first + i);
    while (before + 2 < nodes_deg.size() && nodes_deg[before + 1] <= at + 1e-9) ++before;
    places.emplace_back(before, std::clamp((at - nodes_deg[before]) / (nodes_deg[before + 1] - nodes_deg[before]), 0.0, 1.0));
  }
  return places;
}

bool dark_at_its_edge(const std::vector<float>& candela, std::size_t columns) {
  const std::size_t rows = candela.size() / columns;
  for (std::size_t i = 0; i < columns; ++i)
    if (candela[i] != 0.0f || candela[(rows - 1) * columns + i] != 0.0f) return false;
  for (std::size_t j = 0; j < rows; ++j)
    if (candela[j * columns] != 0.0f || candela[(j + 1) * columns - 1] != 0.0f) return false;
  return true;
}

void pack_even(PackedBeam& packed, const std::vector<double>& first_deg, const std::vector<double>& second_deg, const EvenAxis& first, const EvenAxis& second,
               const std::vector<float>& candela, bool turn) {
  const auto columns = places_on(first_deg, first);
  const auto rows = places_on(second_deg, second);
  packed.columns = static_cast<std::uint32_t>(columns.size() + 1);
  packed.candela_rows = static_cast<std::uint32_t>(rows.size() + 1);
  packed.candela.reserve(std::size_t{packed.columns} * packed.candela_rows);
  for (const auto& [j, t] : rows) {
    const float* low = &candela[j * first_deg.size()];
    const float* high = low + first_deg.size();
    for (const auto& [i, s] : columns) {
      auto along = [&, i = i, s = s](const float* row) { return (1.0 - s) * static_cast<double>(row[i]) + s * static_cast<double>(row[i + 1]); };
      packed.candela.push_back(static_cast<float>((1.0 - t) * along(low) + t * along(high)));
    }
    packed.candela.push_back(0.0f);
  }
  packed.candela.resize(std::size_t{packed.columns} * packed.candela_rows, 0.0f);
  packed.lookup = turn ? shader::kLookupTurn : dark_at_its_edge(candela, first_deg.size()) ? shader::kLookupDark : shader::kLookupAhead;
  const auto per_rad = [](const EvenAxis& axis) { return 180e6 / std::numbers::pi / static_cast<double>(axis.step); };
  packed.nodes = {per_rad(first), per_rad(second), first.fine, second.fine};
  packed.inverse_coarse = 1.0f / static_cast<float>(first.coarse);
  // A gather midway between node i and the next finds both: at (i - first + 1) texels.
  const double width = packed.columns, height = packed.candela_rows;
  packed.coordinates = {1.0 / width, 1.0 / height, static_cast<double>(1 - first.first) / width, static_cast<double>(1 - second.first) / height};
  const std::int64_t first_last = first.first + first.count - 1, second_last = second.first + second.count - 1;
  packed.within = turn ? glm::vec4(first_last, second.first, second_last, 360e6 / static_cast<double>(first.step))
                       : glm::vec4(first.first, first_last, second.first, second_last);
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
  const bool turn = first.back() > 180.0;
  const bool ahead = first.front() >= -90.0 && first.back() <= 90.0;
  const auto even = turn || ahead ? even_axes(first, second, !turn) : std::nullopt;
  if (even) pack_even(packed, first, second, even->first, even->second, candela, turn);
  else pack_guided(packed, first, second, candela);
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
  lamp.position.w = beam.inverse_coarse;
  lamp.nodes = beam.nodes;
  lamp.coordinates = beam.coordinates;
  lamp.within = beam.within;
  lamp.range = beam.range;
  lamp.bins_per_deg = beam.bins_per_deg;
  lamp.guide = {beam.second_guide, 0u, 0u, 0u};
}

}  // namespace phare
