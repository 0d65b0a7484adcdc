#include "visual/even_axis.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace phare {

namespace {

constexpr std::int64_t kMaxEvenNodes = 4096;   // of one axis
constexpr std::int64_t kSmallCells = 1 << 16;  // 1 MiB, which the processor's caches hold
constexpr double kAsEven = 1e-6;               // steps beside: less than float32 tells of an angle
constexpr std::int64_t kOctant = 45'000'000;   // millionths of a degree

struct Line {
  double at_0 = 0.0, step = 0.0;

  double at(std::size_t i) const { return at_0 + step * static_cast<double>(i); }
};

// From which the farthest of the values, at 0, 1, 2 …, is the least off (Chebyshev): three are off by as much, by turns
// above and below, and are exchanged for farther ones until there is none.
Line nearest_line(const std::vector<double>& values) {
  std::array<std::size_t, 3> three{0, values.size() / 2, values.size() - 1};
  Line line;
  for (std::size_t turn = 0; turn < values.size(); ++turn) {
    const auto [a, b, c] = three;
    line.step = (values[c] - values[a]) / static_cast<double>(c - a);
    line.at_0 = values[a] - line.step * static_cast<double>(a);
    const double off = 0.5 * (values[b] - line.at(b));
    line.at_0 += off;
    std::size_t farthest = a;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::abs(values[i] - line.at(i)) > std::abs(values[farthest] - line.at(farthest))) farthest = i;
    const double most = values[farthest] - line.at(farthest);
    if (std::abs(most) <= std::abs(off) * (1.0 + 1e-9) + 1e-12) break;
    const bool as_b = (most > 0.0) == (off > 0.0);
    if (farthest < a)
      three = as_b ? std::array{farthest, a, c} : std::array{farthest, b, c};
    else if (farthest < b)
      three = as_b ? std::array{a, farthest, c} : std::array{farthest, b, c};
    else if (farthest < c)
      three = as_b ? std::array{a, farthest, c} : std::array{a, b, farthest};
    else
      three = as_b ? std::array{a, c, farthest} : std::array{a, b, farthest};
  }
  return line;
}

// Makes of the axis that of the nodes before they were rounded to decimals, if they were: all of them, as float32 has
// it in the shader.
void find_decimals(EvenAxis& axis, const std::vector<double>& nodes) {
  // The corners of a cell lie within a unit of its nodes: half floats have room for what is brighter there by 5 % on
  // either axis.
  constexpr double kLargestUnit = 0.05;
  constexpr int kMostDecimals = 6;
  double per_unit = 1.0;
  const auto is_whole = [&](double node) { return std::abs(node * per_unit - std::round(node * per_unit)) < 1e-4; };
  int decimals = 0;
  while (decimals <= kMostDecimals && !std::ranges::all_of(nodes, is_whole)) ++decimals, per_unit *= 10.0;
  if (decimals > kMostDecimals || !(axis.step * per_unit * kLargestUnit > 1.0)) return;
  std::vector<double> units;
  for (const double node : nodes) units.push_back(std::round(node * per_unit));
  const Line line = nearest_line(units);
  const double first = line.at_0 / line.step, whole = std::floor(line.step);
  EvenAxis found{
      .step = line.step / per_unit, .first = static_cast<std::int64_t>(std::floor(first + 1e-9)), .count = axis.count};
  found.phase = std::max(first - static_cast<double>(found.first), 0.0);
  const double of_0 = line.at_0 - line.step * static_cast<double>(found.first);
  const EvenAxis::Decimals rounded{1.0 / line.step, line.step - whole, of_0 - std::floor(of_0)};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto node = static_cast<double>(found.first + static_cast<std::int64_t>(i));
    const double shift = static_cast<double>(static_cast<float>(rounded.part)) * node;
    const double before = shift + static_cast<double>(static_cast<float>(rounded.from));
    // float32 may round the product and the sum.
    const double rounding = 0x1p-23 * (std::abs(shift) + 2.0);
    if (std::abs(units[i] - whole * node - std::floor(of_0) - before) > 0.5 - rounding) return;
    found.beside.push_back((nodes[i] - found.angle(node)) / found.step);
  }
  found.decimals = rounded;
  axis = found;
}

// Nodes as evenly as their ends say, but for rounding; nothing if one lies more than a fifth of a step beside.
std::optional<EvenAxis> rounded_axis(const std::vector<double>& nodes) {
  const auto count = static_cast<std::int64_t>(nodes.size());
  if (count >= kMaxEvenNodes) return std::nullopt;
  EvenAxis axis{.step = (nodes.back() - nodes.front()) / static_cast<double>(count - 1), .count = count};
  const double first = nodes.front() / axis.step;
  axis.first = static_cast<std::int64_t>(std::floor(first + 1e-9));
  axis.phase = std::max(first - static_cast<double>(axis.first), 0.0);
  double most = 0.0;
  for (std::int64_t i = 0; i < count; ++i) {
    const double even = axis.angle(static_cast<double>(axis.first + i));
    axis.beside.push_back((nodes[static_cast<std::size_t>(i)] - even) / axis.step);
    most = std::max(most, std::abs(axis.beside.back()));
  }
  if (most > 0.2) return std::nullopt;
  if (most < kAsEven)
    axis.beside.clear();
  else
    find_decimals(axis, nodes);
  return axis;
}

}  // namespace

std::optional<std::vector<std::int64_t>> in_millionths(const std::vector<double>& nodes_written) {
  std::vector<std::int64_t> nodes;
  for (double node : nodes_written) {
    if (std::abs(node * 1e6 - std::round(node * 1e6)) > 1e-3) return std::nullopt;
    nodes.push_back(std::llround(node * 1e6));
  }
  return nodes;
}

std::optional<EvenAxis> even_axis(const std::vector<std::int64_t>& nodes, std::int64_t coarse, bool turn) {
  std::optional<EvenAxis> best;
  if (coarse == 1 && !turn) {
    std::int64_t step = 0;
    for (std::int64_t node : nodes) step = std::gcd(step, node - nodes.front());
    const std::int64_t before = nodes.front() - (nodes.front() % step + step) % step;
    best = {.step = static_cast<double>(step) * 1e-6,
            .phase = static_cast<double>(nodes.front() - before) / static_cast<double>(step),
            .first = before / step,
            .count = (nodes.back() - nodes.front()) / step + 1};
  } else {
    std::int64_t step = turn ? kOctant : 0;  // the shader counts the nodes of a whole turn from multiples of 45°
    for (std::int64_t node : nodes) step = std::gcd(step, node);
    const auto propose = [&](std::int64_t border) {
      for (std::int64_t node : nodes)
        if (std::abs(node) > border && (std::abs(node) - border) % (step * coarse) != 0) return;
      const auto node_of = [&](std::int64_t angle) {
        const std::int64_t inner = std::clamp(angle, -border, border);
        return inner / step + (angle - inner) / (step * coarse);
      };
      const EvenAxis axis{.step = static_cast<double>(step) * 1e-6,
                          .fine = border / step,
                          .coarse = coarse,
                          .first = node_of(nodes.front()),
                          .count = node_of(nodes.back()) - node_of(nodes.front()) + 1};
      if (!best || axis.count < best->count) best = axis;
    };
    if (turn)
      propose(std::max(std::abs(nodes.front()), std::abs(nodes.back())));
    else
      for (std::int64_t border : nodes) propose(std::abs(border));
  }
  return best && best->count < kMaxEvenNodes ? best : std::nullopt;
}

std::optional<std::pair<EvenAxis, EvenAxis>> even_axes(const std::vector<double>& first_deg,
                                                       const std::vector<double>& second_deg, bool turn) {
  const auto cells = [](const EvenAxis& a, const EvenAxis& b) { return (a.count + 1) * (b.count + 1); };
  const auto first = in_millionths(first_deg), second = in_millionths(second_deg);
  std::optional<std::pair<EvenAxis, EvenAxis>> best;
  if (first && second) {
    for (std::int64_t coarse = 1; coarse <= (turn ? 1 : 100); ++coarse) {
      const auto a = even_axis(*first, coarse, turn), b = even_axis(*second, coarse, turn);
      if (a && b && cells(*a, *b) <= (best ? cells(best->first, best->second) - 1 : kMaxEvenCells))
        best.emplace(*a, *b);
    }
  }
  const auto own = static_cast<std::int64_t>(first_deg.size() * second_deg.size());
  if (turn || (best && cells(best->first, best->second) <= std::max(8 * own, kSmallCells))) return best;
  const auto either = [](const auto& whole, const std::vector<double>& nodes) {
    const auto even = whole ? even_axis(*whole, 1, false) : std::nullopt;
    return even && even->count <= static_cast<std::int64_t>(2 * nodes.size()) ? even : rounded_axis(nodes);
  };
  const auto a = either(first, first_deg), b = either(second, second_deg);
  if (a && b && cells(*a, *b) <= kMaxEvenCells) return std::pair(*a, *b);
  return best;
}

}  // namespace phare
