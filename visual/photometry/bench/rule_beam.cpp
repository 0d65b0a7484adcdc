// A beam as a rulebook looks at it.
// Computes: half the sum of the lamps' tables in the frame of the rule; where they have data; the error of bilinear
// interpolation and rounding; the bounds of the sharpness G. Source: the bound of linear interpolation, max |f''| h²/8.
// Frame: H right, V up, degrees; each lamp turned up about its y axis, then right. Leaves out: errors of the
// measurement itself. Checked by tests/photometry/check_test.cpp.
#include "visual/photometry/bench/rule_beam.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

constexpr double kOnLimit_deg = 1e-9;  // turning there and back costs digits: still on the table's limit
constexpr double kGSpan_deg = 0.1;     // of G
constexpr double kRowSearch_deg = 0.01;
constexpr double kWidestRow_deg = 10.0;

TableAngles onto_limits(const IntensityTable& table, TableAngles angles) {
  const auto snap = [](const std::vector<double>& nodes, double at) {
    if (nodes.empty()) return at;
    if (at < nodes.front() && at >= nodes.front() - kOnLimit_deg) return nodes.front();
    if (at > nodes.back() && at <= nodes.back() + kOnLimit_deg) return nodes.back();
    return at;
  };
  return {snap(table.first_deg, angles.first_deg), snap(table.second_deg, angles.second_deg)};
}

/// A cell and the shares of its lower and upper node, each worked out by itself: a mirrored table gives them swapped.
struct PlaceInCell {
  std::size_t i = 0;
  double lower_01 = 0.0, upper_01 = 0.0;
};

bool place_in(const std::vector<double>& nodes, double at, PlaceInCell& place) {
  if (nodes.size() < 2 || !(at >= nodes.front() && at <= nodes.back())) return false;
  place.i = static_cast<std::size_t>(std::upper_bound(nodes.begin() + 1, nodes.end() - 1, at) - nodes.begin()) - 1;
  const double low = nodes[place.i], high = nodes[place.i + 1];
  place.lower_01 = (high - at) / (high - low);
  place.upper_01 = (at - low) / (high - low);
  return true;
}

/// Curvature of the values at four nodes i-1 … i+2 (ends clamped) as the largest error of a linear piece, there.
double piece_error(const double (&x)[4], const double (&f)[4], const PlaceInCell& place) {
  double curvature = 0.0;  // |f''|·h² of the middle interval
  const double h = x[2] - x[1];
  for (const int i : {0, 1}) {
    const double a = x[i + 1] - x[i], b = x[i + 2] - x[i + 1];
    if (a <= 0.0 || b <= 0.0) continue;
    const double second = 2.0 * ((f[i + 2] - f[i + 1]) / b - (f[i + 1] - f[i]) / a) / (a + b);
    curvature = std::max(curvature, std::abs(second) * h * h);
  }
  return curvature * 0.5 * (place.lower_01 * place.upper_01);  // = curvature / 8 in the middle
}

}  // namespace

double interpolation_error_cd(const IntensityTable& table, TableAngles angles) {
  PlaceInCell first, second;
  angles = onto_limits(table, angles);
  if (!place_in(table.first_deg, angles.first_deg, first) || !place_in(table.second_deg, angles.second_deg, second))
    return std::numeric_limits<double>::infinity();
  const std::size_t i = first.i, j = second.i;
  const std::size_t columns = table.first_deg.size(), rows = table.second_deg.size();
  double along_first = 0.0, along_second = 0.0;
  for (const std::size_t other : {std::size_t{0}, std::size_t{1}}) {
    double x[4], f[4], y[4], g[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t column = std::min(std::max(i + k, std::size_t{1}) - 1, columns - 1);
      const std::size_t row = std::min(std::max(j + k, std::size_t{1}) - 1, rows - 1);
      x[k] = table.first_deg[column];
      f[k] = table.candela[(j + other) * columns + column];
      y[k] = table.second_deg[row];
      g[k] = table.candela[row * columns + i + other];
    }
    // What lies on a node has nothing of the cell's other side.
    if ((other == 0 ? second.lower_01 : second.upper_01) > 0.0)
      along_first = std::max(along_first, piece_error(x, f, first));
    if ((other == 0 ? first.lower_01 : first.upper_01) > 0.0)
      along_second = std::max(along_second, piece_error(y, g, second));
  }
  return along_first + along_second + 0.5 * table.header.smallest_step_cd;
}

RuleBeam::RuleBeam(std::span<const IntensityTable* const> tables, bool mirrored)
    : tables_(tables), mirrored_(mirrored), aims_(tables.size()), car_from_lamp_(tables.size(), glm::dmat3{1.0}) {}

void RuleBeam::set_aim(std::size_t lamp, HV aim) {
  aims_[lamp] = aim;
  const double side = mirrored_ ? -1.0 : 1.0;
  car_from_lamp_[lamp] = aim_rotation(-side * glm::radians(aim.h_deg), glm::radians(aim.v_deg), 0.0);
  nodes_.clear();
  peak_.reset();
}

void RuleBeam::turn(HV by) {
  for (std::size_t k = 0; k < lamps(); ++k) set_aim(k, {aims_[k].h_deg + by.h_deg, aims_[k].v_deg + by.v_deg});
}

glm::dvec3 RuleBeam::in_lamp(std::size_t lamp, double h_deg, double v_deg) const {
  return direction_hv(mirrored_ ? -h_deg : h_deg, v_deg) * car_from_lamp_[lamp];
}

RuleBeam::Value RuleBeam::at(double h_deg, double v_deg) const {
  Value value;
  for (std::size_t k = 0; k < lamps(); ++k) {
    const IntensityTable& table = *tables_[k];
    const glm::dvec3 direction = in_lamp(k, h_deg, v_deg);
    const TableAngles angles = onto_limits(table, table.angles_of(direction));
    const bool inside = angles.first_deg >= table.first_deg.front() && angles.first_deg <= table.first_deg.back() &&
                        angles.second_deg >= table.second_deg.front() && angles.second_deg <= table.second_deg.back();
    value.cd += table.intensity_at_cd(angles);
    value.known = value.known && (inside || evidence_of(table, direction) != Evidence::kNone);
  }
  value.cd /= static_cast<double>(lamps());
  return value;
}

double RuleBeam::resolution_cd(HV p) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < lamps(); ++k) {
    const glm::dvec3 direction = in_lamp(k, p.h_deg, p.v_deg);
    const double error = interpolation_error_cd(*tables_[k], tables_[k]->angles_of(direction));
    if (std::isfinite(error) || evidence_of(*tables_[k], direction) == Evidence::kNone) sum += error;
  }
  return sum / static_cast<double>(lamps());
}

double RuleBeam::peak_resolution_cd(HV node) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < lamps(); ++k) {
    const IntensityTable& table = *tables_[k];
    const TableAngles at = onto_limits(table, table.angles_of(in_lamp(k, node.h_deg, node.v_deg)));
    const auto middles = [](const std::vector<double>& nodes, double x) {
      std::vector<double> result;
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        if (nodes[i] <= x + 1e-6 && nodes[i + 1] >= x - 1e-6) result.push_back(0.5 * (nodes[i] + nodes[i + 1]));
      }
      return result;
    };
    double most = 0.0;
    for (const double first : middles(table.first_deg, at.first_deg)) {
      for (const double second : middles(table.second_deg, at.second_deg))
        most = std::max(most, interpolation_error_cd(table, {first, second}));
    }
    sum += most;
  }
  return sum / static_cast<double>(lamps());
}

const std::vector<RuleBeam::Node>& RuleBeam::nodes() {
  if (!nodes_.empty()) return nodes_;
  for (std::size_t k = 0; k < lamps(); ++k) {
    const std::vector<double>& first_deg = tables_[k]->first_deg;
    for (const double second : tables_[k]->second_deg) {
      for (std::size_t i = 0; i < first_deg.size(); ++i) {  // in the order of the rule's H: the first of equals is told
        const double first = first_deg[mirrored_ ? first_deg.size() - 1 - i : i];
        const glm::dvec3 d = car_from_lamp_[k] * tables_[k]->direction_of({first, second});
        TableAngles hv = table_angles(PhotometricType::kA, GammaAxis::kGamma0, d);
        if (mirrored_) hv.first_deg = -hv.first_deg;
        nodes_.push_back({{hv.first_deg, hv.second_deg}, at(hv.first_deg, hv.second_deg)});
      }
    }
  }
  return nodes_;
}

RuleBeam::Node RuleBeam::peak() {
  if (!peak_) {
    const auto& all = nodes();
    peak_ =
        *std::max_element(all.begin(), all.end(), [](const Node& a, const Node& b) { return a.value.cd < b.value.cd; });
  }
  return *peak_;
}

double RuleBeam::flux_lm() const {
  double sum = 0.0;
  for (const IntensityTable* table : tables_) sum += table->flux_lm();
  return sum / static_cast<double>(lamps());
}

bool RuleBeam::covers_the_front() const {
  const HV sides[] = {{-89.0, 0.0}, {89.0, 0.0}, {0.0, -89.0}, {0.0, 89.0}};
  return std::all_of(std::begin(sides), std::end(sides), [&](HV p) { return at(p.h_deg, p.v_deg).known; });
}

IntensityHv RuleBeam::intensity() const {
  IntensityHv intensity = [this](double h_deg, double v_deg) { return at(h_deg, v_deg).cd; };
  intensity.evidence = [this](double h_deg, double v_deg) {
    Evidence worst = Evidence::kLit;
    for (std::size_t k = 0; k < lamps(); ++k)
      worst = std::max(worst, evidence_of(*tables_[k], in_lamp(k, h_deg, v_deg)));
    return worst;
  };
  if (lamps() == 1)
    intensity.row = [this](double h_deg, double v_deg) { return row_of(*tables_[0], in_lamp(0, h_deg, v_deg)); };
  return intensity;
}

RuleBeam::SharpnessRange RuleBeam::sharpness_range(std::size_t lamp, double h_deg, const Cutoff& cutoff) const {
  const IntensityTable& table = *tables_[lamp];
  // From the inflection down and up to where the scan leaves its rows.
  const std::size_t start = row_of(table, in_lamp(lamp, h_deg, cutoff.elevation_deg));
  const auto in_start = [&](double v_deg) { return row_of(table, in_lamp(lamp, h_deg, v_deg)) == start; };
  const auto edge = [&](double direction) {
    double inside = 0.0, outside = 0.0;
    while (outside < kWidestRow_deg && in_start(cutoff.elevation_deg + direction * outside)) {
      inside = outside;
      outside += kRowSearch_deg;
    }
    for (int halving = 0; halving < 20; ++halving) {
      const double middle = 0.5 * (inside + outside);
      (in_start(cutoff.elevation_deg + direction * middle) ? inside : outside) = middle;
    }
    return cutoff.elevation_deg + direction * inside;
  };
  const double low_v = edge(-1.0), high_v = edge(1.0);
  SharpnessRange range{cutoff.sharpness_g, cutoff.sharpness_g, high_v - low_v};
  const auto own = [&](double v_deg) {
    return table.intensity_at_cd(onto_limits(table, table.angles_of(in_lamp(lamp, h_deg, v_deg))));
  };
  const auto error = [&](double v_deg) {
    return interpolation_error_cd(table, table.angles_of(in_lamp(lamp, h_deg, v_deg)));
  };
  if (range.row_step_deg <= 1.01 * kGSpan_deg) {
    double relative = 0.0;
    for (const double v_deg : {cutoff.elevation_deg - 0.5 * kGSpan_deg, cutoff.elevation_deg + 0.5 * kGSpan_deg})
      relative += error(v_deg) / std::max(own(v_deg), 1e-9);
    range.lowest_g = std::max(0.0, cutoff.sharpness_g - relative / std::log(10.0));
    range.highest_g = cutoff.sharpness_g + relative / std::log(10.0);
  } else {
    const double whole = std::log10(std::max(own(low_v), 1e-9)) - std::log10(std::max(own(high_v), 1e-9));
    range.lowest_g = std::min(range.lowest_g, whole * kGSpan_deg / range.row_step_deg);
    range.highest_g = std::max(range.highest_g, whole);
  }
  return range;
}

}  // namespace phare
