// Rows of UN R149 01 series and FMVSS 108, and their check.
// Source: UN R149 01 series as transcribed in the project's field notes §5.3 (ECE/TRANS/WP.29/2022/93 Tables 5 and 6
// with Supplements 1 to 7; one transcription, not re-read in the UN text) and 49 CFR 571.108 Table XVIII. Leaves out:
// the receiver's 65 mm square at 25 m (0.149°), re-aim tolerances, gradients beyond G. Checked by
// tests/photometry/sample_lamps_test.cpp, which compares the rows with the regulation data set.
#include "visual/photometry/regulation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace phare {
namespace {

constexpr double kSample_deg = 0.05;

RegulationRow least(std::string id, std::vector<HV> at, double min_cd) {
  return {.id = std::move(id), .at = std::move(at), .min_cd = min_cd, .reference = {}};
}
RegulationRow most(std::string id, std::vector<HV> at, double max_cd) {
  return {.id = std::move(id), .at = std::move(at), .max_cd = max_cd, .reference = {}};
}
RegulationRow least_on_line(std::string id, HV from, HV to, double min_cd) {
  return {.id = std::move(id), .shape = RowShape::kLine, .at = {from, to}, .min_cd = min_cd, .reference = {}};
}
RegulationRow least_sum(std::string id, std::vector<HV> at, double min_cd) {
  return {.id = std::move(id), .shape = RowShape::kSum, .at = std::move(at), .min_cd = min_cd, .reference = {}};
}

std::vector<RegulationRow> driving(double peak_min, double up_2, double h_3, double h_6, double h_9, double h_12) {
  std::vector<RegulationRow> rows{
      {.id = "Imax", .shape = RowShape::kPeak, .at = {}, .min_cd = peak_min, .max_cd = 215000.0, .reference = {}},
      {.id = "H-V", .at = {{0.0, 0.0}}, .min_of_peak_01 = 0.8, .reference = {}},
      least("2U-V", {{0.0, 2.0}}, up_2)};
  for (const auto& [degrees, min_cd] : {std::pair{12, h_12}, {9, h_9}, {6, h_6}, {3, h_3}}) {
    rows.push_back(least("H-" + std::to_string(degrees) + "L", {{-static_cast<double>(degrees), 0.0}}, min_cd));
    rows.push_back(least("H-" + std::to_string(degrees) + "R", {{static_cast<double>(degrees), 0.0}}, min_cd));
  }
  return rows;
}

void along(HV from, HV to, const std::function<void(HV)>& visit) {
  const int steps =
      std::max(1, static_cast<int>(std::ceil(std::hypot(to.h_deg - from.h_deg, to.v_deg - from.v_deg) / kSample_deg)));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    visit({from.h_deg + t * (to.h_deg - from.h_deg), from.v_deg + t * (to.v_deg - from.v_deg)});
  }
}

bool inside(const std::vector<HV>& polygon, HV p) {
  bool is_inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const HV a = polygon[i], b = polygon[j];
    if ((a.v_deg > p.v_deg) != (b.v_deg > p.v_deg) &&
        p.h_deg < a.h_deg + (b.h_deg - a.h_deg) * (p.v_deg - a.v_deg) / (b.v_deg - a.v_deg)) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

void over_area(HV low, HV high, const std::function<void(HV)>& visit) {
  const int columns = static_cast<int>(std::ceil((high.h_deg - low.h_deg) / kSample_deg));
  const int rows = static_cast<int>(std::ceil((high.v_deg - low.v_deg) / kSample_deg));
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      visit({low.h_deg + (high.h_deg - low.h_deg) * i / std::max(columns, 1),
             low.v_deg + (high.v_deg - low.v_deg) * j / std::max(rows, 1)});
    }
  }
}

void over_row(const RegulationRow& row, const std::function<void(HV)>& visit) {
  switch (row.shape) {
    case RowShape::kPoints:
    case RowShape::kSum:
      for (const HV p : row.at) visit(p);
      break;
    case RowShape::kLine:
      along(row.at[0], row.at[1], visit);
      break;
    case RowShape::kPolygon: {
      HV low = row.at[0], high = row.at[0];
      for (std::size_t i = 0; i < row.at.size(); ++i) {
        along(row.at[i], row.at[(i + 1) % row.at.size()], visit);
        low = {std::min(low.h_deg, row.at[i].h_deg), std::min(low.v_deg, row.at[i].v_deg)};
        high = {std::max(high.h_deg, row.at[i].h_deg), std::max(high.v_deg, row.at[i].v_deg)};
      }
      over_area(low, high, [&](HV p) {
        if (inside(row.at, p)) visit(p);
      });
      break;
    }
    case RowShape::kBelow:
      over_area({row.at[0].h_deg, -90.0}, row.at[1], visit);
      break;
    case RowShape::kPeak:
      break;
  }
}

double intensity_mounted_cd(const IntensityTable& table, const glm::dmat3& car_from_lamp, HV p) {
  const double h = glm::radians(p.h_deg);
  const double v = glm::radians(p.v_deg);
  const glm::dvec3 in_car{std::cos(v) * std::cos(h), -std::cos(v) * std::sin(h), std::sin(v)};
  return table.intensity_cd(in_car * car_from_lamp);
}

}  // namespace

std::span<const RegulationRow> r149_passing_class_c() {
  static const std::vector<RegulationRow> rows{
      {.id = "Zone III",
       .shape = RowShape::kPolygon,
       .at = {{-8, 1}, {-8, 4}, {8, 4}, {8, 2}, {6, 1.5}, {1.5, 1.5}, {0, 0}, {-4, 0}},
       .max_cd = 625.0,
       .reference = {}},
      most("BR", {{2.5, 1.0}}, 1750.0),
      {.id = "Segment BLL",
       .shape = RowShape::kLine,
       .at = {{-20, 0.57}, {-8, 0.57}},
       .max_cd = 625.0,
       .reference = {}},
      most("B50L", {{-3.43, 0.57}}, 350.0),
      least("75R", {{1.15, -0.57}}, 12100.0),
      least("P", {{-7.0, 0.0}}, 63.0),
      {.id = "50L", .at = {{-3.43, -0.86}}, .min_cd = 5000.0, .max_cd = 37000.0, .reference = {}},
      least("50V", {{0.0, -0.86}}, 5100.0),
      least("50R", {{1.72, -0.86}}, 10100.0),
      least_on_line("Segment 50", {-6.84, -0.86}, {6.84, -0.86}, 2540.0),
      least_on_line("Segment 40LL", {-14, -1.07}, {-9, -1.07}, 850.0),
      least("40L", {{-9, -1.07}}, 2800.0),
      least("40R", {{9, -1.07}}, 2800.0),
      least_on_line("Segment 40RR", {9, -1.07}, {14, -1.07}, 850.0),
      least("25V", {{0, -1.72}}, 2500.0),
      least_on_line("Segment 25L", {-16, -1.72}, {-9, -1.72}, 1180.0),
      least_on_line("Segment 25", {-9, -1.72}, {9, -1.72}, 1700.0),
      least_on_line("Segment 25R", {9, -1.72}, {16, -1.72}, 1180.0),
      least_on_line("Segment 15", {-20, -2.86}, {20, -2.86}, 425.0),
      least_on_line("Segment 10", {-4.5, -4}, {2, -4}, 500.0),
      {.id = "Segment 10 and below",
       .shape = RowShape::kBelow,
       .at = {{-4.5, -4}, {2, -4}},
       .max_of_first = 0.8,
       .reference = {1.72, -0.86}},
      least_sum("S50+S50LL+S50RR", {{-8, 4}, {0, 4}, {8, 4}}, 190.0),
      least_sum("S100+S100LL+S100RR", {{-4, 2}, {0, 2}, {4, 2}}, 375.0),
  };
  return rows;
}

std::span<const RegulationRow> r149_driving_class_b() {
  static const std::vector<RegulationRow> rows = driving(40000.0, 1700.0, 17500.0, 5000.0, 3400.0, 1500.0);
  return rows;
}

std::span<const RegulationRow> r149_driving_class_a() {
  static const std::vector<RegulationRow> rows = driving(27000.0, 1000.0, 12000.0, 3400.0, 2000.0, 600.0);
  return rows;
}

std::span<const RegulationRow> fmvss108_upper_ub2() {
  static const std::vector<RegulationRow> rows{
      least("2U V", {{0, 2}}, 1500.0),
      least("1U 3L & 3R", {{-3, 1}, {3, 1}}, 5000.0),
      {.id = "H V", .at = {{0, 0}}, .min_cd = 40000.0, .max_cd = 75000.0, .reference = {}},
      least("H 3L & 3R", {{-3, 0}, {3, 0}}, 15000.0),
      least("H 6L & 6R", {{-6, 0}, {6, 0}}, 5000.0),
      least("H 9L & 9R", {{-9, 0}, {9, 0}}, 3000.0),
      least("H 12L & 12R", {{-12, 0}, {12, 0}}, 1500.0),
      least("1.5D V", {{0, -1.5}}, 5000.0),
      least("1.5D 9L & 9R", {{-9, -1.5}, {9, -1.5}}, 2000.0),
      least("2.5D V", {{0, -2.5}}, 2500.0),
      least("2.5D 12L & 12R", {{-12, -2.5}, {12, -2.5}}, 1000.0),
      most("4D V", {{0, -4}}, 12000.0),
  };
  return rows;
}

std::vector<RowResult> check_rows(const IntensityTable& table, const glm::dmat3& car_from_lamp,
                                  std::span<const RegulationRow> rows, bool mirrored) {
  const double peak_cd = table.peak_cd();
  const auto intensity_cd = [&](HV p) {
    return intensity_mounted_cd(table, car_from_lamp, {mirrored ? -p.h_deg : p.h_deg, p.v_deg});
  };
  std::vector<RowResult> results;
  for (const RegulationRow& row : rows) {
    RowResult result{.id = row.id, .min_cd = row.min_cd, .max_cd = row.max_cd};
    if (row.min_of_peak_01 > 0.0) result.min_cd = std::max(result.min_cd, row.min_of_peak_01 * peak_cd);
    if (row.max_of_first > 0.0) result.max_cd = std::min(result.max_cd, row.max_of_first * intensity_cd(row.reference));
    if (row.shape == RowShape::kPeak) {
      result.lowest_cd = result.highest_cd = peak_cd;
    } else {
      double lowest = kNoMaximum, highest = 0.0, sum = 0.0;
      over_row(row, [&](HV p) {
        const double i = intensity_cd(p);
        lowest = std::min(lowest, i);
        highest = std::max(highest, i);
        sum += i;
      });
      result.lowest_cd = row.shape == RowShape::kSum ? sum : lowest;
      result.highest_cd = row.shape == RowShape::kSum ? sum : highest;
    }
    result.passed = result.lowest_cd >= result.min_cd && result.highest_cd <= result.max_cd;
    results.push_back(result);
  }
  return results;
}

Cutoff find_cutoff(const IntensityTable& table, const glm::dmat3& car_from_lamp, double h_deg, double from_v_deg,
                   double to_v_deg) {
  Cutoff best;
  const int steps = static_cast<int>(std::lround((to_v_deg - from_v_deg) / 0.05));
  const auto log_e = [&](int i) {
    return std::log10(std::max(intensity_mounted_cd(table, car_from_lamp, {h_deg, from_v_deg + 0.05 * i}), 1e-6));
  };
  for (int i = 0; i + 2 <= steps; ++i) {
    const double g = log_e(i) - log_e(i + 2);
    if (g > best.sharpness_g) best = {g, from_v_deg + 0.05 * (i + 1)};
  }
  return best;
}

}  // namespace phare
