#include "visual/photometry/table/combine.h"

#include <algorithm>
#include <cmath>

namespace phare {
namespace {

constexpr double kLimitStep_deg = 0.01;  // as in beam_image.cpp: where a lit table ends, the sum falls over this angle

bool lit_edge(const IntensityTable& table, bool first, bool upper) {
  const std::size_t columns = table.first_deg.size(), rows = table.second_deg.size();
  for (std::size_t k = 0; k < (first ? rows : columns); ++k) {
    const std::size_t i = first ? (upper ? columns - 1 : 0) : k;
    const std::size_t j = first ? k : (upper ? rows - 1 : 0);
    if (table.candela[j * columns + i] > 0.0) return true;
  }
  return false;
}

std::vector<double> union_nodes(std::span<const IntensityTable* const> tables, bool first) {
  std::vector<double> nodes;
  const auto own = [first](const IntensityTable* t) -> const std::vector<double>& {
    return first ? t->first_deg : t->second_deg;
  };
  double low = 1e9, high = -1e9;
  for (const IntensityTable* table : tables) {
    nodes.insert(nodes.end(), own(table).begin(), own(table).end());
    low = std::min(low, own(table).front());
    high = std::max(high, own(table).back());
  }
  for (const IntensityTable* table : tables) {
    if (own(table).front() > low && lit_edge(*table, first, false))
      nodes.push_back(own(table).front() - kLimitStep_deg);
    if (own(table).back() < high && lit_edge(*table, first, true)) nodes.push_back(own(table).back() + kLimitStep_deg);
  }
  std::sort(nodes.begin(), nodes.end());
  // -1 + 0.1·k from two files may differ in the last bit: one node.
  nodes.erase(std::unique(nodes.begin(), nodes.end(), [](double a, double b) { return b - a < 1e-9; }), nodes.end());
  return nodes;
}

}  // namespace

void type_a_grid(const IntensityTable& table, std::vector<double>& h_deg, std::vector<double>& v_deg) {
  if (table.type == PhotometricType::kA && table.screen_distance_m <= 0.0) {
    h_deg = table.first_deg;
    v_deg = table.second_deg;
    return;
  }
  // Where it shines, by direction.
  double h_low = 180.0, h_high = -180.0, v_low = 90.0, v_high = -90.0;
  const std::size_t columns = table.first_deg.size();
  for (std::size_t k = 0; k < table.candela.size(); ++k) {
    if (table.candela[k] <= 0.0) continue;
    const TableAngles hv =
        table_angles(PhotometricType::kA, GammaAxis::kGamma0,
                     table.direction_of({table.first_deg[k % columns], table.second_deg[k / columns]}));
    h_low = std::min(h_low, hv.first_deg);
    h_high = std::max(h_high, hv.first_deg);
    v_low = std::min(v_low, hv.second_deg);
    v_high = std::max(v_high, hv.second_deg);
  }
  const auto nodes = [](double low, double high, double near_deg) {
    std::vector<double> result;
    const auto step_at = [near_deg](double a) {
      return a < near_deg ? 0.05 : a < 2 * near_deg ? 0.1 : a < 4 * near_deg ? 0.5 : 2.5;
    };
    std::vector<double> up{0.0};
    while (up.back() < std::max(std::abs(low), std::abs(high)))
      up.push_back(std::round((up.back() + step_at(up.back())) * 1e4) * 1e-4);
    for (auto it = up.rbegin(); it != up.rend(); ++it) {
      if (-*it >= low - step_at(*it)) result.push_back(-*it + 0.0);
    }
    for (auto it = up.begin() + 1; it != up.end(); ++it) {
      if (*it <= high + step_at(*it)) result.push_back(*it);
    }
    return result;
  };
  h_deg = nodes(std::max(h_low, -180.0), std::min(h_high, 180.0), 10.0);
  v_deg = nodes(std::max(v_low, -90.0), std::min(v_high, 90.0), 5.0);
  while (!h_deg.empty() && h_deg.front() < -180.0) h_deg.erase(h_deg.begin());
  while (!h_deg.empty() && h_deg.back() > 180.0) h_deg.pop_back();
  while (!v_deg.empty() && v_deg.front() < -90.0) v_deg.erase(v_deg.begin());
  while (!v_deg.empty() && v_deg.back() > 90.0) v_deg.pop_back();
}

IntensityTable resample(const IntensityTable& table, PhotometricType type, GammaAxis axis,
                        std::vector<double> first_deg, std::vector<double> second_deg,
                        const glm::dmat3& car_from_lamp) {
  IntensityTable result;
  result.name = table.name;
  result.version = table.version;
  result.header.keywords = table.header.keywords;
  result.header.smallest_step_cd = table.header.smallest_step_cd;
  result.type = type;
  result.axis = axis;
  result.first_deg = std::move(first_deg);
  result.second_deg = std::move(second_deg);
  result.candela.reserve(result.first_deg.size() * result.second_deg.size());
  for (const double second : result.second_deg) {
    for (const double first : result.first_deg)
      result.candela.push_back(table.intensity_cd(table_direction(type, axis, {first, second}) * car_from_lamp));
  }
  return result;
}

IntensityTable sum_tables(std::span<const IntensityTable* const> tables) {
  IntensityTable sum;
  if (tables.empty()) return sum;
  const IntensityTable& lead = *tables.front();
  const bool alike = std::all_of(tables.begin(), tables.end(), [&](const IntensityTable* t) {
    return t->type == lead.type && t->axis == lead.axis && t->screen_distance_m <= 0.0;
  });
  sum.version = lead.version;
  sum.axis = lead.axis;
  sum.header.format = "made";
  if (alike) {
    sum.type = lead.type;
    sum.first_deg = union_nodes(tables, true);
    sum.second_deg = union_nodes(tables, false);
  } else {
    sum.type = PhotometricType::kA;
    type_a_grid(lead, sum.first_deg, sum.second_deg);
  }
  const std::size_t columns = sum.first_deg.size();
  sum.candela.assign(columns * sum.second_deg.size(), 0.0);
  for (const IntensityTable* table : tables) {
    sum.header.smallest_step_cd = std::max(sum.header.smallest_step_cd, table->header.smallest_step_cd);
    for (std::size_t j = 0; j < sum.second_deg.size(); ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const TableAngles at{sum.first_deg[i], sum.second_deg[j]};
        sum.candela[j * columns + i] +=
            alike ? table->intensity_at_cd(at) : table->intensity_cd(table_direction(sum.type, sum.axis, at));
      }
    }
  }
  return sum;
}

namespace {

/// Intensity toward a direction; one that misses a limit of the table by rounding is on it.
double intensity_on_limit_cd(const IntensityTable& table, const glm::dvec3& direction) {
  constexpr double kRounding_deg = 1e-9;
  TableAngles at = table.angles_of(direction);
  const auto onto = [](const std::vector<double>& nodes, double& x) {
    if (std::abs(x - nodes.front()) < kRounding_deg) x = nodes.front();
    if (std::abs(x - nodes.back()) < kRounding_deg) x = nodes.back();
  };
  onto(table.first_deg, at.first_deg);
  onto(table.second_deg, at.second_deg);
  return table.intensity_at_cd(at);
}

bool at_pole(const IntensityTable& table, TableAngles at) {
  constexpr double kNear_deg = 1e-6;
  if (table.screen_distance_m > 0.0) return false;
  switch (table.type) {
    case PhotometricType::kA:
      return std::abs(at.second_deg) > 90.0 - kNear_deg;
    case PhotometricType::kB:
      return std::abs(at.first_deg) > 90.0 - kNear_deg;
    case PhotometricType::kC:
      break;
  }
  return at.second_deg < kNear_deg || at.second_deg > 180.0 - kNear_deg;
}

}  // namespace

TableDifference difference_from_sum(std::span<const IntensityTable* const> parts, const IntensityTable& table) {
  TableDifference difference;
  for (const IntensityTable* const part : parts) {
    const auto look = [&](TableAngles at) {
      if (at_pole(*part, at)) return;
      const glm::dvec3 d = part->direction_of(at);
      double sum = 0.0;
      for (const IntensityTable* const other : parts)
        sum += other == part ? part->intensity_at_cd(at) : intensity_on_limit_cd(*other, d);
      const double off = std::abs(sum - intensity_on_limit_cd(table, d));
      ++difference.looked_at;
      if (off <= difference.worst_cd) return;
      difference.worst_cd = off;
      difference.at = table_angles(PhotometricType::kA, GammaAxis::kGamma0, d);
    };
    const std::vector<double>&first = part->first_deg, &second = part->second_deg;
    for (std::size_t j = 0; j < second.size(); ++j) {
      for (std::size_t i = 0; i < first.size(); ++i) {
        look({first[i], second[j]});
        if (i + 1 < first.size() && j + 1 < second.size())
          look({0.5 * (first[i] + first[i + 1]), 0.5 * (second[j] + second[j + 1])});
      }
    }
  }
  return difference;
}

}  // namespace phare
