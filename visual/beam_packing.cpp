#include "visual/beam_packing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "visual/even_axis.h"

namespace phare {

namespace {

constexpr std::size_t kMaxBins = 8192;                           // in 45°
constexpr std::size_t kFilterColumns = 1024, kFilterRows = 512;  // of the levels that the texture filter weighs

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
std::vector<NodePlace> own_places(std::size_t count) {
  std::vector<NodePlace> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back({i, 0.0});
  return places;
}
std::vector<NodePlace> places_on(const std::vector<double>& nodes_deg, const EvenAxis& axis) {
  if (axis.count == static_cast<std::int64_t>(nodes_deg.size())) return own_places(nodes_deg.size());
  return places_of(nodes_deg, static_cast<std::size_t>(axis.count), [&](std::size_t i) {
    return axis.angle(static_cast<double>(axis.first + static_cast<std::int64_t>(i)));
  });
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

// Where the cells of the nodes lie, counted from node (first, second).
void count_cells(PackedBeam& packed, std::int64_t first, std::int64_t second) {
  packed.columns = static_cast<std::uint32_t>(packed.column_places.size());
  packed.rows_of_candela = static_cast<std::uint32_t>(packed.row_places.size());
  const std::int64_t row = packed.columns + 1;
  packed.shape.cells = {static_cast<float>(row), static_cast<float>((1 - second) * row + 1 - first)};
}

// `units`: of an axis in what the shader counts in, a radian or a screen's tangent.
void describe_even(PackedBeam& packed, const EvenAxis& first, const EvenAxis& second, bool turn, double units) {
  shader::TableShape& shape = packed.shape;
  shape.per = {units / first.step, units / second.step};
  shape.phase = {first.phase, second.phase};
  shape.fine = turn ? glm::vec2(45.0 / first.step, 45.0 / second.step) : glm::vec2(first.fine, second.fine);
  shape.coarse = 1.0f / static_cast<float>(first.coarse);
  shape.range = {first.first, first.last(), second.first, second.last()};
  count_cells(packed, first.first, second.first);
}

// Of each cell, from the one before the first node: where its corners lie that are a step apart, 0 and 1 at its nodes.
std::vector<glm::dvec2> corners_of(const EvenAxis& axis) {
  std::vector<glm::dvec2> corners;
  const auto beside = [&](std::int64_t i) {
    return i < 0 || i >= axis.count || axis.beside.empty() ? 0.0 : axis.beside[static_cast<std::size_t>(i)];
  };
  for (std::int64_t i = -1; i < axis.count; ++i) {
    const double width = 1.0 + beside(i + 1) - beside(i);
    corners.emplace_back(-beside(i) / width, (1.0 - beside(i)) / width);
  }
  return corners;
}

// Half a step beyond the table at most, so that what is looked up there is one of its outer cells.
glm::vec2 reach_of(const EvenAxis& axis, bool narrow) {
  const double most_deg = narrow ? 46.4 : 90.2;
  const auto half_tangent = [&](double node) {
    return std::tan(std::clamp(axis.angle(node), -most_deg, most_deg) * std::numbers::pi / 360.0);
  };
  return {half_tangent(static_cast<double>(axis.first) - 0.49), half_tangent(static_cast<double>(axis.last()) + 0.49)};
}

// Tables of angles that look ahead: by half angles, rounded nodes through a guide of one entry a node.
void describe_ahead(PackedBeam& packed, const EvenAxis& first, const EvenAxis& second) {
  shader::TableShape& shape = packed.shape;
  shape.lookup = shader::kLookupAhead;
  const auto narrow = [](const EvenAxis& axis) {
    return std::max(-axis.angle(static_cast<double>(axis.first)), axis.angle(static_cast<double>(axis.last()))) <=
           static_cast<double>(shader::kNarrowReach_deg);
  };
  const glm::vec2 x = reach_of(first, narrow(first)), y = reach_of(second, narrow(second));
  shape.reach = {x.x, x.y, y.x, y.y};
  if (narrow(first)) shape.lookup |= shader::kLookupNarrow;
  if (narrow(second)) shape.lookup |= 2u * shader::kLookupNarrow;
  if (first.beside.empty() && second.beside.empty()) {
    if (first.coarse != 1) shape.lookup |= shader::kLookupCoarse;
    return;
  }
  const auto computed = [](const EvenAxis& axis) { return axis.beside.empty() || axis.decimals; };
  if (computed(first) && computed(second)) {
    shape.lookup |= shader::kLookupDecimals;
    const EvenAxis::Decimals x = first.decimals.value_or(EvenAxis::Decimals{}),
                             y = second.decimals.value_or(EvenAxis::Decimals{});
    shape.fine = {x.part, y.part};
    shape.from = {x.from, y.from};
    shape.unit = {x.unit, y.unit};
    // A cell's function goes on past its nodes by half of a last decimal, in steps of 1° a hundredth of a pixel of 60°
    // over 1280.
    constexpr float kLastDecimal = 1e-3f;
    if (shape.unit.x <= kLastDecimal && shape.unit.y <= kLastDecimal) shape.lookup |= shader::kLookupLast;
    const auto ends = [](const EvenAxis& axis) {
      const glm::dvec2 even(axis.first, axis.last());
      return axis.beside.empty() ? even : even + glm::dvec2(axis.beside.front(), axis.beside.back());
    };
    shape.range = glm::dvec4(ends(first), ends(second));
    packed.column_corners = corners_of(first);
    packed.row_corners = corners_of(second);
    return;
  }
  shape.lookup |= shader::kLookupRounded;
  for (const EvenAxis* axis : {&first, &second}) {
    const auto beside = [&](std::int64_t i) {
      return axis->beside.empty() ? 0.0 : axis->beside[static_cast<std::size_t>(i)];
    };
    const auto slope_after = [&](std::int64_t i) {
      i = std::clamp<std::int64_t>(i, 0, axis->count - 2);
      return 1.0 / (1.0 + beside(i + 1) - beside(i));
    };
    if (axis == &second) shape.coarse = static_cast<float>(packed.guide.size());
    for (std::int64_t i = 0; i < axis->count; ++i)
      packed.guide.emplace_back(beside(i), 0.0, slope_after(i - 1), slope_after(i));
  }
}

// A texture coordinate for each radian (of a screen: tangent) of the table's range: texel centres at its ends.
void describe_filter(PackedBeam& packed, const glm::dvec4& range) {
  packed.columns = kFilterColumns;
  packed.rows_of_candela = kFilterRows;
  const double width = kFilterColumns, height = kFilterRows;
  const double u = (width - 1) / width / (range.y - range.x), v = (height - 1) / height / (range.w - range.z);
  packed.shape.range = range;
  packed.shape.per = {u, v};
  packed.shape.phase = {0.5 / width - range.x * u, 0.5 / height - range.z * v};
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

void make_guides(PackedBeam& packed, const std::vector<double>& first_deg, const std::vector<double>& second_deg) {
  packed.column_places = own_places(first_deg.size());
  packed.row_places = own_places(second_deg.size());
  Guide first = make_guide(first_deg);
  const Guide second = make_guide(second_deg);
  shader::TableShape& shape = packed.shape;
  shape.per = {first.bins_per_deg, second.bins_per_deg};
  shape.phase = {first.first_octant, second.first_octant};
  shape.fine = {first.bins_in_octant, second.bins_in_octant};
  shape.coarse = static_cast<float>(first.bins.size());
  shape.range = {first_deg.front(), first_deg.back(), second_deg.front(), second_deg.back()};
  packed.guide = std::move(first.bins);
  packed.guide.insert(packed.guide.end(), second.bins.begin(), second.bins.end());
  count_cells(packed, 0, 0);
}

// A flat screen: evenly in metres where its nodes lie so, else through a guide. Guides are made for angles, so tangents
// are scaled into the 45° about 0.
void place_screen(PackedBeam& packed, double distance_m, bool filtered) {
  const std::vector<double>&first = packed.column_tangents, &second = packed.row_tangents;
  if (filtered) {
    packed.shape.lookup = shader::kLookupFilterScreen;
    packed.column_places = places_between_ends(first, kFilterColumns);
    packed.row_places = places_between_ends(second, kFilterRows);
    describe_filter(packed, {first.front(), first.back(), second.front(), second.back()});
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
    if (y && z && (y->count + 1) * (z->count + 1) <= kMaxEvenCells) {
      packed.shape.lookup = shader::kLookupScreen;
      packed.column_places = places_on(y_m, *y);
      packed.row_places = places_on(z_m, *z);
      describe_even(packed, *y, *z, false, distance_m);
      return;
    }
  }
  packed.shape.lookup = shader::kLookupScreenGuide;
  const auto scale = [](const std::vector<double>& nodes) {
    return 22.4 / std::max(std::abs(nodes.front()), std::abs(nodes.back()));
  };
  const double a = scale(first), b = scale(second);
  make_guides(packed, scaled(first, a), scaled(second, b));
  packed.shape.reach = {a, b, 0.0, 0.0};
}

// Candela of 1.0 in the texture. The largest half float is 65,504.
float scale_for(ImageLevel level, const BeamImage& image) {
  if (level == ImageLevel::kFloatNodes) return 1.0f;
  const float peak_cd = *std::max_element(image.candela.begin(), image.candela.end());
  if (level == ImageLevel::kNormalised8) return peak_cd > 0.0f ? peak_cd : 1.0f;
  return peak_cd > 60000.0f ? peak_cd / 60000.0f : 1.0f;
}

}  // namespace

shader::TableShape for_any_light(shader::TableShape shape) {
  const std::uint32_t kind = shape.lookup & shader::kLookupKind;
  const auto plain = [&](std::uint32_t of) { shape.lookup = of | shader::kLookupScaled | shader::kLookupEdge; };
  if (kind == shader::kLookupAhead && (shape.lookup & shader::kLookupCoarse) == 0) {
    // Even nodes are rounded to whole steps.
    shape.fine = shape.from = shape.unit = glm::vec2(0.0f);
    plain(shader::kLookupDecimals | shader::kLookupLast);
  } else if (kind == shader::kLookupAhead) {
    plain(shader::kLookupAhead | shader::kLookupCoarse);
  } else if (kind == shader::kLookupDecimals) {
    plain(shader::kLookupDecimals | (shape.lookup & shader::kLookupLast));
  } else if (kind == shader::kLookupRounded) {
    plain(shader::kLookupRounded);
  } else {
    shape.lookup |= shader::kLookupScaled;
  }
  shape.lookup |= shader::kLookupOfFrame;
  return shape;
}

shader::GpuShape shape_in_frame(const shader::TableShape& shape) {
  return {.range = shape.range,
          .reach = shape.reach,
          .per_phase = glm::vec4(shape.per, shape.phase),
          .fine_cells = glm::vec4(shape.fine, shape.cells),
          .from_unit = glm::vec4(shape.from, shape.unit),
          .coarse = glm::vec4(shape.coarse, 0.0f, 0.0f, 0.0f)};
}

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

  if (image.screen_distance_m > 0.0) {
    const auto tangents = [](std::vector<double> nodes) {
      for (double& node : nodes) node = std::tan(node * std::numbers::pi / 180.0);
      return nodes;
    };
    packed.column_tangents = tangents(first);
    packed.row_tangents = tangents(second);
    place_screen(packed, image.screen_distance_m, filtered);
  } else if (filtered) {
    packed.shape.lookup = ahead ? shader::kLookupFilterAhead : shader::kLookupFilter;
    packed.column_places = places_between_ends(first, kFilterColumns);
    packed.row_places = places_between_ends(second, kFilterRows);
    describe_filter(packed,
                    std::numbers::pi / 180.0 * glm::dvec4(first.front(), first.back(), second.front(), second.back()));
  } else if (even) {
    packed.column_places = places_on(first, even->first);
    packed.row_places = places_on(second, even->second);
    describe_even(packed, even->first, even->second, turn, 180.0 / std::numbers::pi);
    packed.shape.lookup = shader::kLookupTurn;
    if (!turn) describe_ahead(packed, even->first, even->second);
  } else {
    packed.shape.lookup = shader::kLookupGuide;
    make_guides(packed, first, second);
  }
  packed.candela.assign(std::size_t{packed.columns} * packed.rows_of_candela, 0.0f);
  if (!image.tints.empty()) packed.tints.assign(packed.candela.size(), glm::vec2(0.0f));
  packed.scale_cd = scale_for(level, image);
  if (packed.scale_cd != 1.0f) packed.shape.lookup |= shader::kLookupScaled;
  fill(packed, image, {0, 0, packed.columns, packed.rows_of_candela});
  if (packed.lookup() <= shader::kLookupRounded && !dark_at_its_edge(image.candela, image.first_deg.size()))
    packed.shape.lookup |= shader::kLookupEdge;
  return packed;
}

TexelRect pack_again(PackedBeam& packed, const BeamImage& image, const TexelRect& changed) {
  packed.colour = image.colour;
  packed.dark = image.dark;
  const bool edge_lit = packed.lookup() <= shader::kLookupRounded && (packed.shape.lookup & shader::kLookupEdge) == 0 &&
                        !dark_at_its_edge(image.candela, image.first_deg.size());
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

}  // namespace phare
