// Sample headlamps from formulas. Computes: a sum of bells B below the cut-off and stray light F above it, joined along
// the cut-off line in log I, I = F·(1 + B/F)^S with S a logistic step: so the steepest place of log I, by which
// cut-offs are aimed and judged, lies on the line, and the sharpness G is log10(1 + B/F)·0.1°/(4·s) there. Source:
// chosen by hand so that every row of UN R149 01 series class C (passing) and class B (driving) and FMVSS 108 UB2 holds
// and the beam looks like one on a 25 m wall and on the road; nothing measured. Frame: LM-63 type A, H right, V up.
// Leaves out: colour fringes, LED pixels, facets. Checked by tests/photometry/sample_lamps_test.cpp and by the program
// itself.
#include "visual/photometry/bench/sample_lamps.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace phare {
namespace {

/// A bell with long tails (Moffat): peak·(1 + (ΔH/width)² + (ΔV/height)²)^-power.
struct Bell {
  double peak_cd, h_deg, v_deg, width_deg, height_deg, power;
  double at(double h, double v) const {
    const double a = (h - h_deg) / width_deg;
    const double b = (v - v_deg) / height_deg;
    return peak_cd * std::pow(1.0 + a * a + b * b, -power);
  }
};

double sum_at(const std::vector<Bell>& bells, double h, double v) {
  double sum = 0.0;
  for (const Bell& bell : bells) sum += bell.at(h, v);
  return sum;
}

double radians(double deg) {
  return deg * std::numbers::pi / 180.0;
}

/// The housing: nothing goes sideways or back.
double window(double h, double v) {
  const double c = std::cos(radians(h)) * std::cos(radians(v));
  return std::max(0.0, c * c);
}

struct BeamFormula {
  std::vector<Bell> beam;
  std::vector<Bell> stray;  ///< empty: no cut-off
  double step_deg = 0.0;    ///< s of the logistic step
  double kink_deg = 0.0;    ///< rounding of the kink
  double rise = 0.0;        ///< slope of the cut-off right of the kink
};

/// Elevation of the cut-off: flat on the left, rising on the right to a shoulder near 7° right that sinks again
/// outward.
double cutoff_deg(const BeamFormula& f, double h) {
  const double right = 0.5 * (h + std::hypot(h, f.kink_deg));
  return f.rise * right / (std::pow(1.0 + std::pow(right / 6.0, 6.0), 1.0 / 6.0) * (1.0 + std::pow(right / 16.0, 4.0)));
}

double intensity_cd(const BeamFormula& f, double h, double v) {
  const double beam = sum_at(f.beam, h, v);
  if (f.stray.empty()) return window(h, v) * beam;
  const double stray = sum_at(f.stray, h, v);
  const double below_01 = 1.0 / (1.0 + std::exp(std::clamp((v - cutoff_deg(f, h)) / f.step_deg, -60.0, 60.0)));
  return window(h, v) * stray * std::pow(1.0 + beam / stray, below_01);
}

struct Steps {
  int end_milli_deg, step_milli_deg;
};

/// Nodes from 0 outward, in thousandths of a degree so that they and their mirror images are exact.
std::vector<int> outward(const std::vector<Steps>& steps) {
  std::vector<int> nodes;
  int at = 0;
  for (const Steps& part : steps) {
    while (at < part.end_milli_deg) nodes.push_back(at += part.step_milli_deg);
  }
  return nodes;
}

std::vector<double> both_sides(const std::vector<int>& below, const std::vector<int>& above) {
  std::vector<double> nodes;
  for (auto it = below.rbegin(); it != below.rend(); ++it) nodes.push_back(-*it / 1000.0);
  nodes.push_back(0.0);
  for (const int node : above) nodes.push_back(node / 1000.0);
  return nodes;
}

/// Five digits: finer than any photometer, and the files stay small.
std::string candela_text(double cd) {
  if (cd < 0.005) return "0";
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, cd < 1.0 ? "%.2f" : "%.5g", cd);
  return buffer;
}

double rounded(double cd) {
  const std::string text = candela_text(cd);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

IntensityTable sample(const BeamFormula& f) {
  // 0.05° where the kink and the cut-off are; 0.2° across where the 15° line runs, so that it climbs 0.05° per column.
  const std::vector<int> h =
      outward({{500, 50}, {3000, 100}, {10000, 200}, {16000, 500}, {30000, 1000}, {60000, 2500}, {90000, 5000}});
  const std::vector<int> down =
      outward({{1000, 50}, {3000, 100}, {6000, 250}, {10000, 500}, {20000, 1000}, {45000, 2500}, {90000, 5000}});
  const std::vector<int> up =
      outward({{2000, 50}, {4000, 100}, {6000, 250}, {10000, 500}, {20000, 1000}, {45000, 2500}, {90000, 5000}});
  IntensityTable table;
  table.version = "IES:LM-63-2019";
  table.first_deg = both_sides(h, h);
  table.second_deg = both_sides(down, up);
  for (const double v : table.second_deg) {
    for (const double angle : table.first_deg) table.candela.push_back(rounded(intensity_cd(f, angle, v)));
  }
  return table;
}

/// Left-right mirrored, value by value.
IntensityTable mirrored(IntensityTable table) {
  const std::size_t columns = table.first_deg.size();
  for (auto row = table.candela.begin(); row != table.candela.end(); row += static_cast<std::ptrdiff_t>(columns)) {
    std::reverse(row, row + static_cast<std::ptrdiff_t>(columns));
  }
  return table;
}

const double kRise15 = std::tan(radians(15.0));  // UN R149: the right part rises by 15°

/// A reflector or projector lamp with a bulb's levels.
BeamFormula halogen_low() {
  return {.beam = {{10500, 1.4, -0.4, 3.2, 1.4, 2.0}, {9600, 0.4, -0.6, 12.5, 3.0, 2.0}, {8300, 0, -1.9, 41, 8.5, 3.0}},
          .stray = {{190, 0, 0.6, 9, 3, 1.3}, {75, 0, 2, 30, 14, 2}},
          .step_deg = 0.168,
          .kink_deg = 0.15,
          .rise = kRise15};
}

/// A projector LED lamp: sharper, wider, more light.
BeamFormula led_low() {
  return {.beam = {{8500, 1.3, -0.5, 4.0, 1.3, 2.0}, {12500, 0.3, -0.8, 16, 3.0, 2.0}, {8800, 0, -2.2, 46, 9.0, 3.0}},
          .stray = {{170, 0, 0.4, 10, 3, 1.3}, {70, 0, 2, 32, 14, 2}},
          .step_deg = 0.135,
          .kink_deg = 0.10,
          .rise = kRise15};
}

BeamFormula halogen_high() {
  return {.beam = {{40000, 0, 0, 3.4, 2.2, 2.0}, {12500, 0, 0, 9.5, 3.6, 2.0}, {2600, 0, -0.3, 28, 7, 2.5}},
          .stray = {}};
}

BeamFormula led_high() {
  return {.beam = {{43000, 0, 0, 3.8, 2.2, 2.0}, {17500, 0, 0, 12, 3.4, 2.0}, {4200, 0, -0.3, 34, 6.5, 2.5}},
          .stray = {}};
}

BeamFormula fog_formula() {
  return {.beam = {{3200, 0, -1.5, 16, 1.7, 2.0}, {6400, 0, -1.7, 42, 2.8, 2.5}, {900, 0, -4.0, 60, 8, 2.5}},
          .stray = {{70, 0, 1.5, 25, 4, 1.5}, {20, 0, 3, 40, 18, 2}},
          .step_deg = 0.30,
          .kink_deg = 0.0,
          .rise = 0.0};
}

/// A cornering lamp of the left side: a wide soft patch to the left, low, with a soft upper edge.
BeamFormula cornering_left() {
  return {.beam = {{3400, -38, -4.5, 22, 6.0, 2.2}, {1500, -55, -5.0, 26, 8.0, 2.2}},
          .stray = {{90, -38, 0.5, 30, 6, 1.5}},
          .step_deg = 0.6,
          .kink_deg = 0.0,
          .rise = 0.0};
}

/// A bicycle's front lamp of today: 30 lx at HV on a wall 10 m away, thrice the least of the German TA 23, which has
/// its peak on H-H and 2 lx at most 3.4° above (Verkehrsblatt 22/2003; unconfirmed: figures by secondary sources).
BeamFormula bicycle_formula() {
  return {.beam = {{2900, 0, 0, 6.0, 1.8, 2.0}, {280, 0, -4.0, 20, 5.0, 2.0}}, .stray = {}};
}

}  // namespace

LampHeader sample_header(const std::string& file, const std::string& description, const IntensityTable& table) {
  LampHeader header;
  header.format = "LM-63";
  header.keywords = {{"TEST", "SYNTHETIC"},
                     {"TESTLAB", "none: computed from formulas by phare-make-lamps"},
                     {"ISSUEDATE", "01-JAN-2025"},
                     {"MANUFAC", "Phare"},
                     {"LUMCAT", file.substr(0, file.size() - 4)},
                     {"LUMINAIRE", "sample headlamp, no product"}};
  for (std::size_t begin = 0; begin < description.size();) {
    const std::size_t end = std::min(description.find(". ", begin), description.size());
    header.keywords.emplace_back("OTHER", description.substr(begin, end - begin));
    begin = end + 2;
  }
  char flux[80];
  std::snprintf(flux, sizeof flux, "Flux %.1f lm (integral of this table), peak %.0f cd", table.flux_lm(),
                table.peak_cd());
  header.keywords.emplace_back("OTHER", flux);
  return header;
}

double sample_pitch_rad() {
  return -std::atan(0.01);
}

double rounded_cd(double cd) {
  return rounded(cd);
}

std::vector<SampleLamp> sample_lamps() {
  const std::string passing =
      "Kink of the cut-off at H=V=0 of this file: mount it 1 % (0.573 deg) down, pitch_deg = -0.5729386976834859";
  const std::string driving =
      "Peak at H=V=0 of this file; passes its rows mounted level and with the passing beam's pitch of -1 %";
  const std::vector<std::string> passes_low{"r149-passing-c", "r149-passing-v", "r112-passing-b", "r123-passing-c"};
  const std::vector<std::string> passes_high{"r149-driving-b", "r149-driving-a", "r112-driving-b", "r112-driving-a",
                                             "fmvss108-ub2"};
  std::vector<SampleLamp> lamps;
  const auto add = [&](const char* file, SampleKind kind, std::string description, std::vector<std::string> rules,
                       IntensityTable table) {
    table.name = file;
    table.header = sample_header(file, description, table);
    lamps.push_back({file, kind, std::move(description), std::move(rules), std::move(table)});
  };
  const IntensityTable low = sample(halogen_low());
  const IntensityTable led = sample(led_low());
  const IntensityTable corner = sample(cornering_left());
  add("low_rht.ies", SampleKind::kLowRight, "Passing beam, right-hand traffic, UN R149 class C. " + passing, passes_low,
      low);
  add("low_lht.ies", SampleKind::kLowLeft, "Passing beam, left-hand traffic, mirror image of low_rht.ies. " + passing,
      passes_low, mirrored(low));
  add("high.ies", SampleKind::kHigh, "Driving beam, UN R149 class B and FMVSS 108 UB2. " + driving, passes_high,
      sample(halogen_high()));
  add("fog.ies", SampleKind::kFog,
      "Front fog beam, flat wide cut-off like UN R19 class F3. Cut-off at V=0 of this file: mounted 1 % down it passes "
      "the rows of UN R19 class F3 that were at hand",
      {"r19-f3"}, sample(fog_formula()));
  add("cornering_left.ies", SampleKind::kCornering,
      "Cornering beam of the left side, a soft patch about 40 deg to the left. No rule's numbers were at hand: not "
      "checked",
      {}, corner);
  add("cornering_right.ies", SampleKind::kCornering,
      "Cornering beam of the right side, mirror image of cornering_left.ies", {}, mirrored(corner));
  add("led_low_rht.ies", SampleKind::kLowRight,
      "LED passing beam, right-hand traffic, UN R149 class C, sharper and wider. " + passing, passes_low, led);
  add("led_low_lht.ies", SampleKind::kLowLeft,
      "LED passing beam, left-hand traffic, mirror image of led_low_rht.ies. " + passing, passes_low, mirrored(led));
  add("led_high.ies", SampleKind::kHigh, "LED driving beam, UN R149 class B and FMVSS 108 UB2, wider. " + driving,
      passes_high, sample(led_high()));
  add("bicycle.ies", SampleKind::kBicycle,
      "Front lamp of a bicycle, 30 lx on a wall 10 m away. Peak at H=V=0 of this file: aim it at the road 10 m ahead. "
      "No rulebook has it: not checked",
      {}, sample(bicycle_formula()));
  return lamps;
}

}  // namespace phare
