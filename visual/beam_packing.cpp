#include "visual/beam_packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace phare {

namespace {

constexpr std::size_t kMaxBins = 8192;                           // in 45°
constexpr std::int64_t kMaxEvenNodes = 4096;                     // of one axis
constexpr std::int64_t kMaxEvenImage = 4 << 20;                  // nodes: 16 MiB
constexpr std::int64_t kOctant = 45'000'000;                     // millionths of a degree
constexpr std::size_t kFilterColumns = 1024, kFilterRows = 512;  // of the levels that the texture filter weighs

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

// Angles as written, in millionths of a degree (of a screen: places in millionths of a metre); nothing if one is not
// whole.
std::optional<std::vector<std::int64_t>> in_millionths(const std::vector<double>& nodes_deg) {
  std::vector<std::int64_t> nodes;
  for (double node : nodes_deg) {
    if (std::abs(node * 1e6 - std::round(node * 1e6)) > 1e-3) return std::nullopt;
    nodes.push_back(std::llround(node * 1e6));
  }
  return nodes;
}

// The even axis of this coarse step with the fewest nodes that has all of these.
std::optional<EvenAxis> even_axis(const std::vector<std::int64_t>& nodes, std::int64_t coarse, bool turn) {
  std::int64_t step = turn ? kOctant : 0;  // the shader counts the nodes of a whole turn from multiples of 45°
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
  if (coarse == 1)
    propose(std::max(std::abs(nodes.front()), std::abs(nodes.back())));  // one border is like another
  else
    for (std::int64_t border : nodes) propose(std::abs(border));
  return best && best->count < kMaxEvenNodes ? best : std::nullopt;
}

// Both axes with one coarse step, for the shader has room for one; the smallest image wins.
std::optional<std::pair<EvenAxis, EvenAxis>> even_axes(const std::vector<double>& first_deg,
                                                       const std::vector<double>& second_deg, bool turn) {
  const auto first = in_millionths(first_deg), second = in_millionths(second_deg);
  if (!first || !second) return std::nullopt;
  std::optional<std::pair<EvenAxis, EvenAxis>> best;
  for (std::int64_t coarse = 1; coarse <= (turn ? 1 : 100); ++coarse) {
    const auto a = even_axis(*first, coarse, turn), b = even_axis(*second, coarse, turn);
    if (!a || !b || a->count * b->count > kMaxEvenImage) continue;
    if (!best || a->count * b->count < best->first.count * best->second.count) best.emplace(*a, *b);
  }
  return best;
}

// For each of these angles: the table's node before it, and the way to the next.
std::vector<NodePlace> places_of(const std::vector<double>& nodes_deg, std::size_t count, const auto& angle_of) {
  std::vector<NodePlace> places;
  std::size_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = angle_of(i);
    while (before + 2 < nodes_deg.size() && nodes_deg[before + 1] <= at + 1e-9) ++before;
    places.push_back(
        {before, std::clamp((at - nodes_deg[before]) / (nodes_deg[before + 1] - nodes_deg[before]), 0.0, 1.0)});
  }
  return places;
}
std::vector<NodePlace> places_on(const std::vector<double>& nodes_deg, const EvenAxis& axis) {
  return places_of(nodes_deg, static_cast<std::size_t>(axis.count),
                   [&](std::size_t i) { return axis.angle_deg(axis.first + static_cast<std::int64_t>(i)); });
}
std::vector<NodePlace> places_between_ends(const std::vector<double>& nodes_deg, std::size_t count) {
  const double step = (nodes_deg.back() - nodes_deg.front()) / static_cast<double>(count - 1);
  return places_of(nodes_deg, count, [&](std::size_t i) { return nodes_deg.front() + step * static_cast<double>(i); });
}

bool dark_at_its_edge(const std::vector<float>& candela, std::size_t columns) {
  const std::size_t rows = candela.size() / columns;
  for (std::size_t i = 0; i < columns; ++i)
    if (candela[i] != 0.0f || candela[(rows - 1) * columns + i] != 0.0f) return false;
  for (std::size_t j = 0; j < rows; ++j)
    if (candela[j * columns] != 0.0f || candela[(j + 1) * columns - 1] != 0.0f) return false;
  return true;
}

// Values of texels, from the nodes about each. Wide: what float32 values are weighed in.
template <typename Wide, typename Value>
void fill_values(const PackedBeam& packed, const BeamImage& image, const std::vector<Value>& nodes,
                 std::vector<Value>& texels, const TexelRect& part) {
  const std::size_t columns = image.first_deg.size();
  const std::size_t across = packed.transposed ? columns : 1,
                    along = packed.transposed ? 1 : columns;  // steps to the next column and row of the packed image
  // What is bilinear: candela, and on a screen candela over its factor.
  const bool screen = !packed.column_tangents.empty();
  const auto value = [&](std::size_t column, std::size_t row) {
    const auto cd = static_cast<Wide>(nodes[row * along + column * across]);
    return screen ? cd / screen_factor(packed.column_tangents[column], packed.row_tangents[row]) : cd;
  };
  for (std::size_t j = part.row; j < part.end_row; ++j) {
    const auto [row, t] = packed.row_places[j];
    for (std::size_t i = part.column; i < part.end_column; ++i) {
      const auto [column, s] = packed.column_places[i];
      Value& texel = texels[j * packed.columns + i];
      if (s == 0.0 && t == 0.0) {
        texel = static_cast<Value>(value(column, row));
        continue;
      }
      const std::size_t right = s > 0.0 ? column + 1 : column, up = t > 0.0 ? row + 1 : row;
      const Wide low = (1.0 - s) * value(column, row) + s * value(right, row);
      const Wide high = (1.0 - s) * value(column, up) + s * value(right, up);
      texel = static_cast<Value>((1.0 - t) * low + t * high);
    }
  }
}
void fill(PackedBeam& packed, const BeamImage& image, const TexelRect& part) {
  fill_values<double>(packed, image, image.candela, packed.candela, part);
  if (packed.tinted()) fill_values<glm::dvec2>(packed, image, image.tints, packed.tints, part);
}

// `per_unit`: millionths in what the shader counts in, a radian or a screen's tangent.
void describe_even(PackedBeam& packed, const EvenAxis& first, const EvenAxis& second, bool turn, double per_unit) {
  const double a = per_unit / static_cast<double>(first.step), b = per_unit / static_cast<double>(second.step);
  packed.nodes =
      turn ? glm::vec4(a, b, kOctant / first.step, kOctant / second.step) : glm::vec4(a, b, first.fine, second.fine);
  packed.inverse_coarse = 1.0f / static_cast<float>(first.coarse);
  // A gather midway between node i and the next finds both: at (i - first + 1) texels.
  const double width = static_cast<double>(first.count + 1), height = static_cast<double>(second.count + 1);
  packed.coordinates = {1.0 / width, 1.0 / height, static_cast<double>(1 - first.first) / width,
                        static_cast<double>(1 - second.first) / height};
  packed.within = {first.first, first.first + first.count - 1, second.first, second.first + second.count - 1};
}

// A texture coordinate for each radian (of a screen: tangent) of the table's range: texel centres at its ends.
void describe_filter(PackedBeam& packed, double units_of_range) {
  packed.nodes = packed.range * static_cast<float>(units_of_range);
  const double width = kFilterColumns, height = kFilterRows;
  const double u = (width - 1) / width / static_cast<double>(packed.nodes.y - packed.nodes.x),
               v = (height - 1) / height / static_cast<double>(packed.nodes.w - packed.nodes.z);
  packed.coordinates = {u, v, 0.5 / width - static_cast<double>(packed.nodes.x) * u,
                        0.5 / height - static_cast<double>(packed.nodes.z) * v};
}

// The guide of one axis: bins of equal width in each 45° about a multiple of 45° (shaders/lib/beam.glsl).
struct Guide {
  std::vector<glm::vec4> bins;
  std::int64_t first_octant = 0;
  std::size_t bins_in_octant = 0;
  double bins_per_deg = 0.0;
};

Guide make_guide(const std::vector<double>& nodes_deg) {
  Guide guide;
  double closest_deg = 45.0;
  for (std::size_t i = 1; i < nodes_deg.size(); ++i)
    closest_deg = std::min(closest_deg, nodes_deg[i] - nodes_deg[i - 1]);
  guide.bins_in_octant = std::min(kMaxBins, static_cast<std::size_t>(std::ceil(1.01 * 45.0 / closest_deg)) + 1);
  guide.bins_per_deg = static_cast<double>(guide.bins_in_octant) / 45.0;
  const auto octant_of = [](double deg) { return static_cast<std::int64_t>(std::floor((deg + 22.5) / 45.0)); };
  guide.first_octant = octant_of(nodes_deg.front());
  const auto octants = static_cast<std::size_t>(octant_of(nodes_deg.back()) - guide.first_octant + 1);
  const auto slope_after = [&](std::size_t i) {
    return i + 1 < nodes_deg.size() ? 1.0 / (nodes_deg[i + 1] - nodes_deg[i]) : 0.0;
  };
  std::size_t node = 0;  // the last node at or before the end of this bin
  for (std::size_t octant = 0; octant < octants; ++octant) {
    const double centre_deg = 45.0 * static_cast<double>(guide.first_octant + static_cast<std::int64_t>(octant));
    for (std::size_t bin = 0; bin < guide.bins_in_octant; ++bin) {
      const double end_deg = centre_deg - 22.5 + static_cast<double>(bin + 1) / guide.bins_per_deg;
      while (node + 1 < nodes_deg.size() && nodes_deg[node + 1] < end_deg) ++node;
      guide.bins.emplace_back(nodes_deg[node] - centre_deg, node, node > 0 ? slope_after(node - 1) : slope_after(0),
                              slope_after(node));
    }
  }
  return guide;
}

// Texels are the table's own nodes.
void keep_nodes(PackedBeam& packed, std::size_t columns, std::size_t rows) {
  for (std::size_t i = 0; i < columns; ++i) packed.column_places.push_back({i, 0.0});
  for (std::size_t j = 0; j < rows; ++j) packed.row_places.push_back({j, 0.0});
}

void make_guides(PackedBeam& packed, const std::vector<double>& first_deg, const std::vector<double>& second_deg) {
  Guide first = make_guide(first_deg);
  const Guide second = make_guide(second_deg);
  packed.guide_bins = {first.bins.size(), first.bins_in_octant, second.bins_in_octant, 0};
  packed.bins = {first.bins_per_deg, second.bins_per_deg, first.first_octant, second.first_octant};
  packed.guide = std::move(first.bins);
  packed.guide.insert(packed.guide.end(), second.bins.begin(), second.bins.end());
  packed.guide.resize((packed.guide.size() + shader::kGuideRow - 1) / shader::kGuideRow * shader::kGuideRow);
}

// A flat screen: evenly in metres where its nodes lie so, else through a guide. Guides are made for angles, so tangents
// are scaled into the 45° about 0.
void place_screen(PackedBeam& packed, double distance_m, bool filtered) {
  const std::vector<double>&first = packed.column_tangents, &second = packed.row_tangents;
  packed.range = {first.front(), first.back(), second.front(), second.back()};
  if (filtered) {
    packed.lookup = shader::kLookupFilterScreen;
    packed.column_places = places_between_ends(first, kFilterColumns);
    packed.row_places = places_between_ends(second, kFilterRows);
    describe_filter(packed, 1.0);
    return;
  }
  const auto scaled = [](std::vector<double> nodes, double factor) {
    for (double& node : nodes) node *= factor;
    return nodes;
  };
  const std::vector<double> y_m = scaled(first, distance_m), z_m = scaled(second, distance_m);
  const auto y_millionths = in_millionths(y_m), z_millionths = in_millionths(z_m);
  if (y_millionths && z_millionths) {
    const auto y = even_axis(*y_millionths, 1, false), z = even_axis(*z_millionths, 1, false);
    if (y && z && y->count * z->count <= kMaxEvenImage) {
      packed.lookup = shader::kLookupScreen;
      packed.column_places = places_on(y_m, *y);
      packed.row_places = places_on(z_m, *z);
      describe_even(packed, *y, *z, false, 1e6 * distance_m);
      return;
    }
  }
  packed.lookup = shader::kLookupScreenGuide;
  const auto scale = [](const std::vector<double>& nodes) {
    return 22.4 / std::max(std::abs(nodes.front()), std::abs(nodes.back()));
  };
  const double a = scale(first), b = scale(second);
  keep_nodes(packed, first.size(), second.size());
  packed.nodes = {a, b, 0.0, 0.0};
  packed.range = {first.front() * a, first.back() * a, second.front() * b, second.back() * b};
  make_guides(packed, scaled(first, a), scaled(second, b));
}

// Candela of 1.0 in the texture. The largest half float is 65,504.
float scale_for(ImageLevel level, const BeamImage& image) {
  if (level == ImageLevel::kFloatNodes) return 1.0f;
  const float peak_cd = *std::max_element(image.candela.begin(), image.candela.end());
  if (level == ImageLevel::kNormalised8) return peak_cd > 0.0f ? peak_cd : 1.0f;
  return peak_cd > 60000.0f ? peak_cd / 60000.0f : 1.0f;
}

}  // namespace

PackedBeam pack_beam(const BeamImage& image, ImageLevel level) {
  PackedBeam packed;
  packed.level = level;
  packed.dark = image.dark || image.first_deg.size() < 2 || image.second_deg.size() < 2;
  packed.colour = image.colour;
  if (packed.dark) return packed;

  // The image's frame: x forward, y left, z up. The shader's: first = atan2(b, a), second = atan2(c, hypot(a, b)).
  const glm::dvec3 forward(1, 0, 0), right(0, -1, 0), up(0, 0, 1);
  std::vector<double> first = image.first_deg, second = image.second_deg;
  switch (image.type) {
    case PhotometricType::kA:
      packed.rows = {forward, right, up};
      break;
    case PhotometricType::kB:
      packed.rows = {forward, up, right};
      std::swap(first, second);
      packed.transposed = true;
      break;
    case PhotometricType::kC:
      // gamma 0 ahead: c0 right, c90 up, g0 forward. gamma 90 ahead: c0 forward, c90 left, g0 down. c is along -g0.
      if (image.axis == GammaAxis::kGamma0)
        packed.rows = {right, up, -forward};
      else
        packed.rows = {forward, -right, up};
      break;
  }
  const bool turn = image.type == PhotometricType::kC && first.back() > 180.0;
  const bool ahead = image.type != PhotometricType::kC && first.front() >= -90.0 && first.back() <= 90.0;
  const bool filtered = level == ImageLevel::kNormalised8 || level == ImageLevel::kHalfEven;
  const auto even = !filtered && (turn || ahead) ? even_axes(first, second, turn) : std::nullopt;
  if (image.type == PhotometricType::kC && !(even && turn))
    for (double& gamma_deg : second) gamma_deg -= 90.0;  // second = gamma - 90
  packed.range = {first.front(), first.back(), second.front(), second.back()};

  if (image.screen_distance_m > 0.0) {
    const auto tangents = [](std::vector<double> nodes) {
      for (double& node : nodes) node = std::tan(node * std::numbers::pi / 180.0);
      return nodes;
    };
    packed.column_tangents = tangents(first);
    packed.row_tangents = tangents(second);
    place_screen(packed, image.screen_distance_m, filtered);
  } else if (filtered) {
    packed.lookup = ahead ? shader::kLookupFilterAhead : shader::kLookupFilter;
    packed.column_places = places_between_ends(first, kFilterColumns);
    packed.row_places = places_between_ends(second, kFilterRows);
    describe_filter(packed, std::numbers::pi / 180.0);
  } else if (even) {
    packed.lookup = turn ? shader::kLookupTurn : shader::kLookupAhead;
    packed.column_places = places_on(first, even->first);
    packed.row_places = places_on(second, even->second);
    describe_even(packed, even->first, even->second, turn, 180e6 / std::numbers::pi);
  } else {
    packed.lookup = shader::kLookupGuide;
    keep_nodes(packed, first.size(), second.size());
    make_guides(packed, first, second);
  }
  const std::uint32_t zeros = filtered ? 0 : 1;
  packed.columns = static_cast<std::uint32_t>(packed.column_places.size()) + zeros;
  packed.rows_of_candela = static_cast<std::uint32_t>(packed.row_places.size()) + zeros;
  packed.candela.assign(std::size_t{packed.columns} * packed.rows_of_candela, 0.0f);
  if (!image.tints.empty()) packed.tints.assign(packed.candela.size(), glm::vec2(0.0f));
  packed.scale_cd = scale_for(level, image);
  fill(packed, image, {0, 0, packed.column_places.size(), packed.row_places.size()});
  if (packed.lookup == shader::kLookupAhead && dark_at_its_edge(image.candela, image.first_deg.size()))
    packed.lookup = shader::kLookupDark;
  return packed;
}

TexelRect pack_again(PackedBeam& packed, const BeamImage& image, const TexelRect& changed) {
  packed.colour = image.colour;
  packed.dark = image.dark;
  const bool edge_lit =
      packed.lookup == shader::kLookupDark && !dark_at_its_edge(image.candela, image.first_deg.size());
  const bool too_bright = !packed.candela.empty() && scale_for(packed.level, image) > packed.scale_cd;
  const bool recoloured = packed.tinted() == image.tints.empty();
  if (packed.candela.empty() || edge_lit || too_bright || recoloured) {
    packed = pack_beam(image, packed.level);
    return {0, 0, packed.columns, packed.rows_of_candela};
  }
  // Texels between a changed node and its neighbours change too.
  TexelRect nodes = changed;
  if (packed.transposed) nodes = {changed.row, changed.column, changed.end_row, changed.end_column};
  const auto part_of = [](const std::vector<NodePlace>& places, std::size_t begin, std::size_t end) {
    const auto node = [](const NodePlace& place) {
      return place.part > 0.0 ? place.node + 1 : place.node;
    };  // the last node it reads
    const auto first =
        std::partition_point(places.begin(), places.end(), [&](const NodePlace& place) { return node(place) < begin; });
    const auto last =
        std::partition_point(places.begin(), places.end(), [&](const NodePlace& place) { return place.node < end; });
    return std::pair{static_cast<std::size_t>(first - places.begin()), static_cast<std::size_t>(last - places.begin())};
  };
  const auto [column, end_column] = part_of(packed.column_places, nodes.column, nodes.end_column);
  const auto [row, end_row] = part_of(packed.row_places, nodes.row, nodes.end_row);
  const TexelRect part{column, row, end_column, end_row};
  if (!part.empty()) fill(packed, image, part);
  return part;
}

std::vector<std::byte> texels_of(const PackedBeam& packed, const TexelRect& part) {
  std::vector<std::byte> bytes(part.texels() * packed.bytes_per_texel());
  std::byte* out = bytes.data();
  const auto put_rows = [&](const auto& texel_of) {
    for (std::size_t j = part.row; j < part.end_row; ++j) {
      for (std::size_t i = part.column; i < part.end_column; ++i) {
        const auto texel = texel_of(packed.candela[j * packed.columns + i]);
        std::memcpy(out, &texel, sizeof texel);
        out += sizeof texel;
      }
    }
  };
  switch (packed.level) {
    case ImageLevel::kNormalised8:
      put_rows([&](float cd) { return static_cast<std::uint8_t>(std::lround(255.0f * cd / packed.scale_cd)); });
      break;
    case ImageLevel::kHalfEven:
    case ImageLevel::kHalfNodes:
      put_rows([&](float cd) { return half_from_float(cd / packed.scale_cd); });
      break;
    case ImageLevel::kFloatNodes:
      put_rows([](float cd) { return cd; });
      break;
  }
  return bytes;
}

std::vector<std::byte> tint_texels_of(const PackedBeam& packed, const TexelRect& part) {
  const bool whole = packed.level == ImageLevel::kFloatNodes;
  std::vector<std::byte> bytes(part.texels() * (whole ? 8 : 4));
  std::byte* out = bytes.data();
  for (std::size_t j = part.row; j < part.end_row; ++j) {
    for (std::size_t i = part.column; i < part.end_column; ++i) {
      const glm::vec2 tint = packed.tints[j * packed.columns + i] / packed.tint_scale();
      const std::array half{half_from_float(tint.x), half_from_float(tint.y)};
      std::memcpy(out, whole ? static_cast<const void*>(&tint) : half.data(), whole ? sizeof tint : sizeof half);
      out += whole ? sizeof tint : sizeof half;
    }
  }
  return bytes;
}

}  // namespace phare
