#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "tools/scene/parts.h"

namespace phare::scene {

namespace {

constexpr double kChunk_m = 50.0, kCell_m = 10.0;
constexpr double kBegin_m = -kMargin_m, kEnd_m = kLength_m + kMargin_m;
constexpr std::array kRoadOffsets_m{-kPavedHalfWidth_m, -3.25, kLaneCentre_m, -0.4, 0.0, 0.4, 1.625, 3.25,
                                    kPavedHalfWidth_m};
constexpr std::array kNearOffsets_m{kPavedHalfWidth_m, 5.3, 6.3, 6.9, 8.4};
constexpr std::array kFarOffsets_m{8.4, 11.0, 16.0, 24.0, 36.0, 54.0, 78.0, 104.0, 130.0};
constexpr double kMarkingHeight_m = 0.007;  ///< thick paint, and out of the way of the depth buffer

std::string numbered(const char* kind, std::size_t i) {
  char name[48];
  std::snprintf(name, sizeof name, "%s_%03zu", kind, i);
  return name;
}

/// Stations of the rows in one cell of 10 m: so many that a chord leaves the road by 2 mm at most, 5 m apart at most.
std::vector<double> rows_in_cell(double begin) {
  double bend = 1e-9;
  for (double s = begin; s <= begin + kCell_m; s += 1.0) {
    const double vertical = profile_m(s - 1.0) - 2.0 * profile_m(s) + profile_m(s + 1.0);
    bend = std::max({bend, std::abs(curvature_1pm(s)), std::abs(vertical)});
  }
  const double step = std::clamp(std::sqrt(8.0 * 0.002 / bend), 1.7, 5.0);
  const int count = static_cast<int>(std::ceil(kCell_m / step - 1e-6));
  std::vector<double> rows;
  for (int i = 0; i < count; ++i) rows.push_back(begin + kCell_m * i / count);
  return rows;
}

/// Normal of the smooth surface; one-sided differences would see the kinks of the verge, so about a decimetre wide.
glm::dvec3 normal_at(const Alignment& road, double s, double t, double reach) {
  const glm::dvec3 along = road.point(s + reach, t) - road.point(s - reach, t);
  const glm::dvec3 across = road.point(s, t + reach) - road.point(s, t - reach);
  return glm::normalize(glm::cross(along, across));
}

struct Corner {
  glm::dvec3 point, normal;
};

/// Between two neighbouring lines of corners, cut so that both may have their own steps. `left` lies left of `right`.
void stitch(std::vector<Triangle>& out, const std::vector<std::pair<double, Corner>>& left,
            const std::vector<std::pair<double, Corner>>& right) {
  const auto emit = [&out](const Corner& a, const Corner& b, const Corner& c) {
    out.push_back({{a.point, b.point, c.point}, {a.normal, b.normal, c.normal}});
  };
  std::size_t i = 0, k = 0;
  while (i + 1 < left.size() || k + 1 < right.size()) {
    const bool step_left =
        k + 1 >= right.size() || (i + 1 < left.size() && left[i + 1].first < right[k + 1].first + 1e-9);
    if (step_left) {
      emit(left[i].second, right[k].second, left[i + 1].second);
      ++i;
    } else {
      emit(left[i].second, right[k].second, right[k + 1].second);
      ++k;
    }
  }
}

/// A line of corners at one offset.
std::vector<std::pair<double, Corner>> line(const Alignment& road, const std::vector<double>& rows, double t,
                                            double reach) {
  std::vector<std::pair<double, Corner>> corners;
  for (const double s : rows) corners.push_back({s, {road.point(s, t), normal_at(road, s, t, reach)}});
  return corners;
}

/// Corners between two lines at the same rows, so that a marking lies on the mesh and not on the formula.
class RoadSheet {
 public:
  RoadSheet(const Alignment& road, std::vector<double> rows) : rows_(std::move(rows)) {
    for (const double t : kRoadOffsets_m) columns_.push_back(line(road, rows_, t, 0.05));
  }
  const std::vector<double>& rows() const { return rows_; }
  const auto& column(std::size_t i) const { return columns_[i]; }

  Corner at(double s, double t) const {
    const auto row = std::clamp<std::ptrdiff_t>(std::upper_bound(rows_.begin(), rows_.end(), s) - rows_.begin() - 1, 0,
                                                static_cast<std::ptrdiff_t>(rows_.size()) - 2);
    const auto r = static_cast<std::size_t>(row);
    std::size_t c = 0;
    while (c + 2 < kRoadOffsets_m.size() && t > kRoadOffsets_m[c + 1]) ++c;
    const double u = (s - rows_[r]) / (rows_[r + 1] - rows_[r]);
    const double v = (t - kRoadOffsets_m[c]) / (kRoadOffsets_m[c + 1] - kRoadOffsets_m[c]);
    const auto mix = [](const Corner& a, const Corner& b, double w) {
      return Corner{a.point + w * (b.point - a.point), a.normal + w * (b.normal - a.normal)};
    };
    Corner corner = mix(mix(columns_[c][r].second, columns_[c][r + 1].second, u),
                        mix(columns_[c + 1][r].second, columns_[c + 1][r + 1].second, u), v);
    corner.normal = glm::normalize(corner.normal);
    return corner;
  }

 private:
  std::vector<double> rows_;
  std::vector<std::vector<std::pair<double, Corner>>> columns_;
};

void add_strip(Node& node, const RoadSheet& sheet, double begin, double end, double right_t, double left_t) {
  if (end - begin < 1e-6) return;
  std::vector<double> stations{begin};
  for (const double s : sheet.rows()) {
    if (s > begin + 1e-6 && s < end - 1e-6) stations.push_back(s);
  }
  stations.push_back(end);
  const auto raised = [&sheet](double s, double t) {
    Corner corner = sheet.at(s, t);
    corner.point += kMarkingHeight_m * corner.normal;
    return corner;
  };
  std::vector<std::pair<double, Corner>> right, left;
  for (const double s : stations) {
    right.push_back({s, raised(s, right_t)});
    left.push_back({s, raised(s, left_t)});
  }
  stitch(node.parts[Material::kPaint], left, right);
}

/// The middle line is unbroken before the crest and through the bends, else 6 m of paint and 12 m of gap.
bool solid_centre(double s) {
  const auto within = [s](double a, double b) { return s >= a && s < b; };
  return within(342.0, 558.0) || within(630.0, 846.0) || within(1260.0, 1476.0);
}

void add_markings(Node& node, const RoadSheet& sheet, double begin, double end) {
  for (const double side : {-1.0, 1.0}) {
    add_strip(node, sheet, begin, end, side * 3.31 - 0.06, side * 3.31 + 0.06);
  }
  constexpr double kPeriod_m = 18.0, kDash_m = 6.0;
  double s = begin;
  while (s < end - 1e-6) {
    const double cycle = std::floor(s / kPeriod_m + 1e-9) * kPeriod_m;
    const bool solid = solid_centre(s + 1e-6);
    const double next = s < cycle + kDash_m - 1e-6 ? cycle + kDash_m : cycle + kPeriod_m;
    if (solid || s < cycle + kDash_m - 1e-6) add_strip(node, sheet, s, std::min(next, end), -0.06, 0.06);
    s = next;
  }
}

template <std::size_t N>
void add_columns(std::vector<Triangle>& out, const Alignment& road, const std::vector<double>& rows,
                 const std::array<double, N>& offsets, double side, std::size_t first, std::size_t last, double reach) {
  for (std::size_t c = first; c < last; ++c) {
    auto inner = line(road, rows, side * offsets[c], reach);
    auto outer = line(road, rows, side * offsets[c + 1], reach);
    if (side > 0.0) {
      stitch(out, outer, inner);
    } else {
      stitch(out, inner, outer);
    }
  }
}

}  // namespace

void add_road(Model& model, const Alignment& road) {
  const auto chunks = static_cast<std::size_t>(std::ceil((kEnd_m - kBegin_m) / kChunk_m - 1e-9));
  for (std::size_t i = 0; i < chunks; ++i) {
    const double begin = kBegin_m + kChunk_m * static_cast<double>(i), end = std::min(begin + kChunk_m, kEnd_m);
    std::vector<double> fine, coarse;
    for (double cell = begin; cell < end - 1e-6; cell += kCell_m) {
      for (const double s : rows_in_cell(cell)) fine.push_back(s);
      coarse.push_back(cell);
    }
    fine.push_back(end);
    coarse.push_back(end);

    const RoadSheet sheet(road, fine);
    auto& asphalt = model.add(numbered("road", i)).parts[Material::kAsphalt];
    for (std::size_t c = 0; c + 1 < kRoadOffsets_m.size(); ++c) stitch(asphalt, sheet.column(c + 1), sheet.column(c));

    Node& ground = model.add(numbered("ground", i));
    for (const double side : {-1.0, 1.0}) {
      add_columns(ground.parts[Material::kVerge], road, fine, kNearOffsets_m, side, 0, 1, 0.2);
      auto& grass = ground.parts[Material::kGrass];
      add_columns(grass, road, fine, kNearOffsets_m, side, 1, kNearOffsets_m.size() - 1, 0.3);
      auto inner = line(road, fine, side * kFarOffsets_m[0], 0.3);
      auto outer = line(road, coarse, side * kFarOffsets_m[1], 2.0);
      if (side > 0.0) {
        stitch(grass, outer, inner);
      } else {
        stitch(grass, inner, outer);
      }
      add_columns(grass, road, coarse, kFarOffsets_m, side, 1, kFarOffsets_m.size() - 1, 2.0);
    }

    add_markings(model.add(numbered("marking", i)), sheet, begin, end);
  }
}

glm::dmat4 placed(const Alignment& road, double s, double t, double turn, double raise) {
  return placed_at(road.point(s, t) + glm::dvec3(0.0, 0.0, raise), heading_rad(s) + turn);
}

}  // namespace phare::scene
