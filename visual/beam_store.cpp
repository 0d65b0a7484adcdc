#include "visual/beam_store.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace phare {

namespace {

constexpr std::size_t kMaxBins = 65536;

std::vector<glm::vec4> make_guide(const std::vector<float>& nodes, float& bins_per_deg) {
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

std::vector<float> to_float(const std::vector<double>& values, double shift) {
  std::vector<float> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [shift](double v) { return static_cast<float>(v + shift); });
  return result;
}

}  // namespace

PackedBeam pack_beam(const BeamImage& image) {
  PackedBeam packed;
  packed.dark = image.dark || image.first_deg.size() < 2 || image.second_deg.size() < 2;
  packed.colour = image.colour;
  if (packed.dark) return packed;

  // The image's frame: x forward, y left, z up. The shader's: first = atan2(b, a), second = atan2(c, hypot(a, b)).
  const glm::dvec3 forward(1, 0, 0), right(0, -1, 0), up(0, 0, 1);
  std::vector<float> first = to_float(image.first_deg, 0.0);
  std::vector<float> second = to_float(image.second_deg, 0.0);
  bool transposed = false;
  switch (image.type) {
    case PhotometricType::kA: packed.rows = {forward, right, up}; break;
    case PhotometricType::kB:
      packed.rows = {forward, up, right};
      transposed = true;
      break;
    case PhotometricType::kC:
      // gamma 0 ahead: c0 right, c90 up, g0 forward. gamma 90 ahead: c0 forward, c90 left, g0 down. second = gamma - 90, along -g0.
      if (image.axis == GammaAxis::kGamma0) packed.rows = {right, up, -forward};
      else packed.rows = {forward, -right, up};
      second = to_float(image.second_deg, -90.0);
      break;
  }
  const std::size_t columns = image.first_deg.size();
  const std::size_t rows = image.second_deg.size();
  if (transposed) {
    std::swap(first, second);
    packed.candela.reserve((rows + 1) * (columns + 1));
    for (std::size_t i = 0; i < columns; ++i)
      for (std::size_t j = 0; j < rows; ++j) packed.candela.push_back(image.candela[j * columns + i]);
  } else {
    packed.candela = image.candela;
  }
  packed.row_length = static_cast<std::uint32_t>(first.size());
  packed.candela.resize(packed.candela.size() + first.size() + 2, 0.0f);  // read with weight 0 at the last nodes
  float first_bins = 0.0f, second_bins = 0.0f;
  packed.first_guide = make_guide(first, first_bins);
  packed.second_guide = make_guide(second, second_bins);
  packed.range = {first.front(), first.back(), second.front(), second.back()};
  packed.bins_per_deg = {first_bins, second_bins, static_cast<float>(packed.first_guide.size() - 1),
                         static_cast<float>(packed.second_guide.size() - 1)};
  return packed;
}

BeamStore::BeamStore(gpu::Device& device) : device_(device) { upload(); }

void BeamStore::set(std::size_t index, const BeamImage& image) {
  beams_.at(index) = pack_beam(image);
  changed_ = true;
}

bool BeamStore::upload() {
  if (!changed_) return false;
  changed_ = false;
  std::vector<glm::vec4> guides;
  std::vector<float> candela;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const PackedBeam& beam = beams_[i];
    places_[i].first_guide = static_cast<std::uint32_t>(guides.size());
    guides.insert(guides.end(), beam.first_guide.begin(), beam.first_guide.end());
    places_[i].second_guide = static_cast<std::uint32_t>(guides.size());
    guides.insert(guides.end(), beam.second_guide.begin(), beam.second_guide.end());
    places_[i].candela = static_cast<std::uint32_t>(candela.size());
    candela.insert(candela.end(), beam.candela.begin(), beam.candela.end());
  }
  const vk::DeviceSize guide_bytes = std::max<std::size_t>(guides.size() * sizeof(glm::vec4), 64);
  const vk::DeviceSize candela_bytes = std::max<std::size_t>(candela.size() * sizeof(float), 64);
  bool fresh = false;
  auto fit = [&](gpu::HostBuffer& buffer, vk::DeviceSize bytes, const char* name) {
    if (buffer.bytes >= bytes) return;
    device_.allocated_bytes -= buffer.bytes;
    buffer = gpu::HostBuffer(device_, bytes, vk::BufferUsageFlagBits::eStorageBuffer, name);
    fresh = true;
  };
  fit(guides_, guide_bytes, "beam guides");
  fit(candela_, candela_bytes, "beam candela");
  std::memcpy(guides_.data, guides.data(), guides.size() * sizeof(glm::vec4));
  std::memcpy(candela_.data, candela.data(), candela.size() * sizeof(float));
  return fresh;
}

void BeamStore::describe(std::size_t index, shader::GpuLamp& lamp) const {
  const PackedBeam& beam = beams_.at(index);
  lamp.colour = {beam.colour.x, beam.colour.y, beam.colour.z, 1.0f};
  lamp.range = beam.range;
  lamp.bins_per_deg = beam.bins_per_deg;
  lamp.table = {places_[index].first_guide, places_[index].second_guide, places_[index].candela, beam.row_length};
}

}  // namespace phare
