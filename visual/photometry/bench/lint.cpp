// The linter of photometry files.
// Computes: repairs of the reader, flux against the header, where the light is, what the cut-off's kink says about
// traffic side, mirror and clockwise storage, and signs of missing or broken data. Thresholds are chosen by hand; each
// says what it is for. Sources: field notes §2.1 (clockwise type B in about 30 % of files, mental ray manual).
// Checked by tests/photometry/lint_test.cpp.
#include "visual/photometry/bench/lint.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>
#include <optional>

#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/readers/file_text.h"

namespace phare {
namespace {

constexpr double kFluxTolerance = 0.02;   // between integral and header: rounding of catalogues and of grids
constexpr double kLitEdge_01 = 0.01;      // of the peak: a table that ends brighter is cut off
constexpr double kNoise_01 = 0.001;       // of the peak: zeros among values below this are the end of the photometer
constexpr double kSpike = 5.0;            // a value this many times all its neighbours is no optics
constexpr double kSameDirection_01 = 0.02;  // of the peak: one direction twice may differ by what a goniometer does
constexpr double kAhead_deg = 30.0;       // a headlamp's peak farther off its axis than this: wrong axis
constexpr double kCutoffStep_deg = 0.05;  // the step in which the rules measure G
constexpr double kLeastCutoffG = 0.13;    // the least sharpness that the rules accept
constexpr double kTall = 1.5;             // headlamps are wider than tall; the other way round by this: turned

std::string format(const char* text, double a = 0.0, double b = 0.0, double c = 0.0, double d = 0.0) {
  char buffer[320];
  std::snprintf(buffer, sizeof buffer, text, a, b, c, d);
  return buffer;
}

/// Splits "file:line: text" of a reader's note.
Finding repaired(const std::string& note, const std::string& name) {
  Finding finding{Grade::kWarning, "repaired", "", note};
  const std::size_t colon = note.find(": ");
  if (colon != std::string::npos) {
    finding.place = note.substr(0, colon);
    finding.text = note.substr(colon + 2);
  } else {
    finding.place = name;
  }
  // What only had to be chosen is no repair.
  for (const char* chosen : {"lamp sets;", "emitters;", "as asked", "conversion factor"}) {
    if (note.find(chosen) != std::string::npos) finding.grade = Grade::kInfo, finding.id = "chosen";
  }
  if (note.find("not used here") != std::string::npos) finding.id = "unused";
  return finding;
}

/// Is `word` in `text` as a word of its own?
bool has_word(const std::string& text, const std::string& word) {
  const auto part_of_word = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const bool begins = at == 0 || !part_of_word(text[at - 1]);
    const bool ends = at + word.size() >= text.size() || !part_of_word(text[at + word.size()]);
    if (begins && ends) return true;
  }
  return false;
}

class Linter {
 public:
  explicit Linter(const IntensityTable& table) : table_(table) {}

  LampReport run() {
    for (const std::string& note : table_.notes) report_.findings.push_back(repaired(note, table_.name));
    report_.peak_cd = table_.peak_cd();
    report_.flux_lm = table_.flux_lm();
    if (report_.peak_cd <= 0.0) {
      add(Grade::kError, "dark", "every value is 0: no light");
      return std::move(report_);
    }
    describe();
    peak();
    flux();
    cutoff();
    orientation();
    edges();
    one_direction_twice();
    broken_values();
    steps();
    std::stable_sort(report_.findings.begin(), report_.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.grade > b.grade; });
    return std::move(report_);
  }

 private:
  void add(Grade grade, const char* id, std::string text) {
    report_.findings.push_back({grade, id, "", std::move(text)});
  }

  void describe() {
    const LampHeader& header = table_.header;
    if (header.units == "feet") add(Grade::kInfo, "feet", "sizes are in feet; candela do not depend on it");
    if (!header.absolute)
      add(Grade::kInfo, "relative", "relative photometry: candela belong to the rated lumens of the lamp");
    std::string factors;
    for (const auto& [name, factor] : {std::pair{"the multiplier", header.multiplier},
                                       {"the ballast factor", header.ballast_factor},
                                       {"field 12", header.field_12_applied ? header.field_12 : 1.0}})
      if (factor != 1.0) factors += (factors.empty() ? "" : " and by ") + (name + format(" %g", factor));
    if (!factors.empty()) add(Grade::kInfo, "factors", "values are multiplied by " + factors);
    if (!header.generation.empty()) add(Grade::kInfo, "generation", "file generation: " + header.generation);
    if (!header.symmetry.empty() && header.symmetry != "none")
      add(Grade::kInfo, "symmetry", "stored with symmetry " + header.symmetry + "; unfolded");
    if (header.distance_m > 0.0)
      add(Grade::kInfo, "distance", format("candela from illuminance at %g m", header.distance_m));
  }

  void peak() {
    report_.peak = table_.peak_at();
    const glm::dvec3 d = table_.direction_of(report_.peak);
    const TableAngles hv = table_angles(PhotometricType::kA, GammaAxis::kGamma0, d);
    if (table_.type == PhotometricType::kC) report_.peak = {hv.first_deg + 0.0, hv.second_deg + 0.0};  // no -0
    const double off = std::acos(std::clamp(d.x, -1.0, 1.0)) * 57.29577951308232;
    if (table_.type == PhotometricType::kC && off > kAhead_deg)
      add(Grade::kWarning, "axis", format("the peak lies %.0f deg off the lamp's axis: ", off) + axis_hint());
    if (report_.peak_cd > 430000.0)  // all driving beams of a car together (UN R48)
      add(Grade::kWarning, "too-bright",
          format("a peak of %.0f cd is more than all driving beams of a car may have", report_.peak_cd));
    if (report_.peak_cd < 50.0)
      add(Grade::kWarning, "too-dim", format("a peak of %.3g cd is no headlamp", report_.peak_cd));
  }

  /// The axis and plane C 0 under which the peak lies ahead, and how to read the file so.
  std::string axis_hint() const {
    const TableAngles peak = table_.peak_at();
    double least = std::cos(glm::radians(kAhead_deg));
    std::optional<std::pair<GammaAxis, double>> best;
    const GammaAxis other = table_.axis == GammaAxis::kGamma0 ? GammaAxis::kGamma90 : GammaAxis::kGamma0;
    for (const auto& [axis, turn_deg] : {std::pair{other, 0.0},
                                         {GammaAxis::kGamma90, 90.0},
                                         {GammaAxis::kGamma90, -90.0},
                                         {GammaAxis::kGamma90, 180.0}}) {
      const double ahead = table_direction(PhotometricType::kC, axis, {peak.first_deg + turn_deg, peak.second_deg}).x;
      if (ahead <= least) continue;
      least = ahead;
      best.emplace(axis, turn_deg);
    }
    if (!best) return "no axis and no place of plane C 0 bring it ahead";
    const double c0 = c0_turned_by(best->second);
    return std::string("the file may have its optical axis at gamma ") +
           (best->first == GammaAxis::kGamma90 ? "90 (--axis gamma90" : "0 (--axis gamma0") +
           (c0 != 0.0 || table_.header.read_c0_deg != 0.0 ? c0_text(c0) : "") + ")";
  }

  /// --c0 that turns the file's planes further than it does now; a mirror image turns the other way.
  double c0_turned_by(double turn_deg) const {
    const double c0 = table_.header.read_c0_deg + (table_.header.read_mirrored ? -turn_deg : turn_deg);
    return std::remainder(c0, 360.0) + 0.0;
  }
  static std::string c0_text(double c0_deg) { return " --c0 " + number_text(c0_deg); }
  std::string mirror_text() const { return table_.header.read_mirrored ? "without --mirror" : "with --mirror"; }

  void flux() {
    const LampHeader& header = table_.header;
    if (header.stated_flux_lm <= 0.0) return;
    const bool partial = table_.screen_distance_m > 0.0 || header.distance_m > 0.0;
    if (header.luminaire_flux) report_.expected_flux_lm = header.stated_flux_lm;
    if (header.output_ratio > 0.0) report_.expected_flux_lm = header.stated_flux_lm * header.output_ratio;
    if (report_.expected_flux_lm > 0.0) {
      const double ratio = report_.flux_lm / report_.expected_flux_lm;
      const std::string text = format("the candela integrate to %.1f lm, the header promises %.1f lm (%+.1f %%)",
                                      report_.flux_lm, report_.expected_flux_lm, (ratio - 1.0) * 100.0);
      const bool agrees = std::abs(ratio - 1.0) <= kFluxTolerance;
      add(agrees || partial ? Grade::kInfo : Grade::kWarning, agrees ? "flux" : "flux-mismatch", text);
    } else if (report_.flux_lm > header.stated_flux_lm * (1.0 + kFluxTolerance)) {
      add(Grade::kWarning, "flux-mismatch",
          format("the candela integrate to %.1f lm, more than the %.1f lm of its lamps", report_.flux_lm,
                 header.stated_flux_lm));
    } else {
      add(Grade::kInfo, "flux",
          format("%.1f lm of the %.1f lm of its lamps: %.0f %%", report_.flux_lm, header.stated_flux_lm,
                 100.0 * report_.flux_lm / header.stated_flux_lm));
    }
  }

  void cutoff() {
    report_.cutoff = cutoff_shape(mounted_intensity(table_, glm::dmat3{1.0}));
    const CutoffShape& shape = report_.cutoff;
    if (shape.side == CutoffSide::kNone) return;
    const bool left = shape.side == CutoffSide::kRisesLeft;
    if (shape.side == CutoffSide::kFlat) {
      add(Grade::kInfo, "cut-off",
          form_name(shape.form) + format(" cut-off at V %+.2f deg, G %.3f", shape.flat_v_deg, shape.sharpness_g) +
              cut_side());
      return;
    }
    add(Grade::kInfo, "cut-off",
        form_name(shape.form) +
            format(" cut-off at V %+.2f deg, kink at H %+.2f deg, G %.3f, rising by %.0f deg", shape.flat_v_deg,
                   shape.kink_h_deg, shape.sharpness_g, shape.rise_deg) +
            (left ? " to the left" : " to the right") + format(", to V %+.2f deg", shape.upper_v_deg));
    std::string words;
    for (const auto& [key, value] : table_.header.keywords) words += upper_case(value) + " ";
    std::replace(words.begin(), words.end(), '-', ' ');
    const bool says_right = has_word(words, "RHT") || has_word(words, "RIGHT HAND TRAFFIC");
    const bool says_left = has_word(words, "LHT") || has_word(words, "LEFT HAND TRAFFIC");
    if (says_right != says_left && says_right == left) {
      add(Grade::kWarning, "mirrored",
          std::string("the keywords say ") + (says_right ? "right" : "left") +
              "-hand traffic, but the cut-off rises to the " + (left ? "left" : "right") +
              (table_.type == PhotometricType::kB ? ": stored clockwise" : ": mirrored") + "; read " + mirror_text() +
              " to turn it");
    } else if (left && table_.type == PhotometricType::kB && !says_left) {
      add(Grade::kWarning, "left-hand-traffic",
          "the cut-off rises to the left: a lamp for left-hand traffic, or type B stored clockwise, as about 30 % of "
          "these "
          "files are; if it is for right-hand traffic, read " +
              mirror_text());
    } else if (left) {
      add(Grade::kInfo, "left-hand-traffic",
          "the cut-off rises to the left: for left-hand traffic" +
              (says_left ? "" : "; if the lamp is not, read " + mirror_text()));
    }
  }

  /// A flat part says nothing of the other side where that leaves the table before the light has fallen.
  std::string cut_side() const {
    const IntensityHv intensity = mounted_intensity(table_, glm::dmat3{1.0});
    for (const double side : {-1.0, 1.0}) {
      int outside = 0;
      for (const double h : {1.5, 2.5, 3.5}) outside += find_cutoff(intensity, side * h).at_edge ? 1 : 0;
      if (outside >= 2)
        return std::string("; on the ") + (side < 0.0 ? "left" : "right") +
               " the table ends before the light has fallen, so that a kink cannot be told";
    }
    return "";
  }

  /// A passing beam that shows its kink only when it is turned about its axis; a type C beam on its side.
  void orientation() {
    const CutoffShape& as_read = report_.cutoff;
    if (as_read.side == CutoffSide::kRisesRight || as_read.side == CutoffSide::kRisesLeft) return;
    const bool c = table_.type == PhotometricType::kC;
    const bool gamma0 = table_.axis == GammaAxis::kGamma0;  // else C turns about the upright, not about the beam
    for (const double roll_deg : {180.0, 90.0, -90.0}) {
      const IntensityHv rolled = mounted_intensity(table_, aim_rotation(0.0, 0.0, glm::radians(roll_deg)));
      const double g = std::max(find_cutoff(rolled, -2.5).sharpness_g, find_cutoff(rolled, 2.5).sharpness_g);
      if (g < kLeastCutoffG) continue;
      const CutoffShape turned = cutoff_shape(rolled);
      const bool kinked = turned.side == CutoffSide::kRisesRight || turned.side == CutoffSide::kRisesLeft;
      // A flat edge is a lower one upside down only where the format leaves open how it lies.
      const bool flat = c && roll_deg == 180.0 && as_read.side == CutoffSide::kNone && turned.side == CutoffSide::kFlat;
      if (!(kinked || flat) || turned.sharpness_g < std::max(kLeastCutoffG, as_read.sharpness_g)) continue;
      add(Grade::kWarning, "turned",
          std::string(roll_deg == 180.0 ? "the beam stands upside down" : "the beam lies on its side") +
              ": its cut-off shows when it is turned by " + (roll_deg == 180.0 ? "180" : "90") + " deg about its axis" +
              (c && gamma0 ? "; plane C 0 may lie elsewhere (read with" +
                                 c0_text(c0_turned_by(roll_deg == 180.0 ? 180.0 : -roll_deg)) + ")"
                           : ""));
      return;
    }
    const double tall = height_to_width();
    if (c && tall > kTall) {
      add(Grade::kWarning, "turned",
          format("the beam is %.1f times as tall as wide", tall) +
              (gamma0 ? ": plane C 0 may lie elsewhere (read with" + c0_text(c0_turned_by(90.0)) + " or" +
                            c0_text(c0_turned_by(-90.0)) + ")"
                      : ""));
    }
  }

  /// Of the light within 40° of the axis: spread in V over spread in H.
  double height_to_width() const {
    double sum = 0.0, h_sum = 0.0, v_sum = 0.0, hh = 0.0, vv = 0.0;
    for (double v = -40.0; v <= 40.0; v += 1.0) {
      for (double h = -40.0; h <= 40.0; h += 1.0) {
        const double cd = table_.intensity_cd(direction_hv(h, v));
        sum += cd;
        h_sum += cd * h;
        v_sum += cd * v;
        hh += cd * h * h;
        vv += cd * v * v;
      }
    }
    if (sum <= 0.0) return 1.0;
    const double wide = hh / sum - (h_sum / sum) * (h_sum / sum), tall = vv / sum - (v_sum / sum) * (v_sum / sum);
    return wide > 0.0 ? std::sqrt(std::max(0.0, tall) / wide) : 1.0;
  }

  void edges() {
    const std::size_t columns = table_.first_deg.size(), rows = table_.second_deg.size();
    const bool round = table_.type == PhotometricType::kC;
    double brightest = 0.0;
    std::size_t at = 0;
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const bool edge_h = !round && (i == 0 || i + 1 == columns);
        const bool edge_v =
            round ? (j == 0 && table_.second_deg[j] > 0.0) || (j + 1 == rows && table_.second_deg[j] < 180.0)
                  : j == 0 || j + 1 == rows;
        if ((edge_h || edge_v) && table_.candela[j * columns + i] > brightest) {
          brightest = table_.candela[j * columns + i];
          at = j * columns + i;
        }
      }
    }
    if (brightest > kLitEdge_01 * report_.peak_cd) {
      add(Grade::kWarning, "cut-table",
          format("the table ends in light: %.0f cd at %g, %g; beyond it the lamp is dark", brightest,
                 table_.first_deg[at % columns], table_.second_deg[at / columns]));
    }
  }

  /// One direction that the table has in several columns: gamma 0 and 180 in all, C 0 as C 360.
  void one_direction_twice() {
    if (table_.type != PhotometricType::kC) return;
    const std::size_t columns = table_.first_deg.size(), rows = table_.second_deg.size();
    const auto differ = [&](double least, double most) { return most - least > kSameDirection_01 * report_.peak_cd; };
    for (const std::size_t j : {std::size_t{0}, rows - 1}) {
      if (table_.second_deg[j] != 0.0 && table_.second_deg[j] != 180.0) continue;
      const auto row = table_.candela.begin() + static_cast<std::ptrdiff_t>(j * columns);
      const auto [least, most] = std::minmax_element(row, row + static_cast<std::ptrdiff_t>(columns));
      if (differ(*least, *most))
        add(Grade::kWarning, "pole",
            format("gamma %g is one direction, which has %.4g to %.4g cd in the file", table_.second_deg[j], *least,
                   *most));
    }
    if (table_.first_deg.front() != 0.0 || table_.first_deg.back() != 360.0) return;
    for (std::size_t j = 0; j < rows; ++j) {
      const double begin = table_.candela[j * columns], end = table_.candela[(j + 1) * columns - 1];
      if (!differ(std::min(begin, end), std::max(begin, end))) continue;
      add(Grade::kWarning, "seam",
          format("C 0 and C 360 are one plane, but %.4g and %.4g cd at gamma %g", begin, end, table_.second_deg[j]));
      return;
    }
  }

  void broken_values() {
    const std::size_t columns = table_.first_deg.size(), rows = table_.second_deg.size();
    std::size_t spikes = 0, first_spike = 0;
    const auto cd = [&](std::size_t i, std::size_t j) { return table_.candela[j * columns + i]; };
    for (std::size_t j = 1; j + 1 < rows; ++j) {
      for (std::size_t i = 1; i + 1 < columns; ++i) {
        const double highest = std::max({cd(i - 1, j), cd(i + 1, j), cd(i, j - 1), cd(i, j + 1)});
        if (cd(i, j) > kSpike * highest && cd(i, j) > 0.01 * report_.peak_cd && spikes++ == 0)
          first_spike = j * columns + i;
      }
    }
    const auto where = [&](std::size_t k) {
      return format(", first at %g, %g", table_.first_deg[k % columns], table_.second_deg[k / columns]);
    };
    const std::vector<char> missing = missing_values();
    const auto first_missing = std::find(missing.begin(), missing.end(), 1);
    if (first_missing != missing.end()) {
      add(Grade::kWarning, "missing-data",
          std::to_string(std::count(missing.begin(), missing.end(), 1)) + " value(s) of 0 in the midst of light" +
              where(static_cast<std::size_t>(first_missing - missing.begin())));
    }
    if (spikes > 0)
      add(Grade::kWarning, "spike",
          std::to_string(spikes) + " value(s) above five times all their neighbours" + where(first_spike));
  }

  /// Zeros in the midst of light, however many lie together: those that no way over zeros leads to the table's border,
  /// and those between two bright values of one row or column.
  std::vector<char> missing_values() const {
    const std::size_t columns = table_.first_deg.size(), rows = table_.second_deg.size();
    const std::vector<double>& cd = table_.candela;
    const bool round = table_.type == PhotometricType::kC;  // C closes on itself, gamma 0 is a point
    std::vector<char> missing(cd.size(), 0), seen(cd.size(), 0);
    for (std::size_t start = 0; start < cd.size(); ++start) {
      if (cd[start] != 0.0 || seen[start] != 0) continue;
      // All zeros that hang together with this one, and the brightest value beside them.
      std::vector<std::size_t> patch{start};
      seen[start] = 1;
      bool to_border = false;
      double beside_cd = 0.0;
      const auto look = [&](std::size_t k) {
        beside_cd = std::max(beside_cd, cd[k]);
        if (cd[k] != 0.0 || seen[k] != 0) return;
        seen[k] = 1;
        patch.push_back(k);
      };
      for (std::size_t n = 0; n < patch.size(); ++n) {
        const std::size_t i = patch[n] % columns, row = patch[n] - i;
        const bool first = i == 0, last = i + 1 == columns, bottom = row == 0, top = row + columns == cd.size();
        to_border =
            to_border || ((first || last) && !round) || top || (bottom && !(round && table_.second_deg[0] == 0.0));
        if (!first || round) look(row + (first ? columns - 1 : i - 1));
        if (!last || round) look(row + (last ? 0 : i + 1));
        if (!bottom) look(patch[n] - columns);
        if (!top) look(patch[n] + columns);
      }
      if (to_border || beside_cd <= kNoise_01 * report_.peak_cd) continue;
      for (const std::size_t k : patch) missing[k] = 1;
    }
    const double bright = kLitEdge_01 * report_.peak_cd;
    const auto between = [&](std::size_t start, std::size_t stride, std::size_t count) {
      for (std::size_t a = 0; a < count; ++a) {
        std::size_t b = a + 1;
        if (cd[start + a * stride] <= bright) continue;
        while (b < count && cd[start + b * stride] == 0.0) ++b;
        if (b == count || b == a + 1 || cd[start + b * stride] <= bright) continue;
        for (std::size_t k = a + 1; k < b; ++k) missing[start + k * stride] = 1;
      }
    };
    for (std::size_t i = 0; i < columns; ++i) between(i, columns, rows);
    for (std::size_t j = 0; j < rows && !round; ++j) between(j * columns, 1, columns);
    return missing;
  }

  void steps() {
    const TableAngles peak = table_.peak_at();
    const auto widest = [](const std::vector<double>& nodes, double at, double reach) {
      double step = 0.0;
      for (std::size_t i = 1; i < nodes.size(); ++i) {
        if (nodes[i] >= at - reach && nodes[i - 1] <= at + reach) step = std::max(step, nodes[i] - nodes[i - 1]);
      }
      return step;
    };
    report_.step_h_deg = widest(table_.first_deg, peak.first_deg, 2.0);
    report_.step_v_deg = widest(table_.second_deg, peak.second_deg, 1.0);
    if (report_.cutoff.side != CutoffSide::kNone && table_.type != PhotometricType::kC) {
      const double at_cutoff = widest(table_.second_deg, report_.cutoff.flat_v_deg, 0.1);
      if (at_cutoff > 1.001 * kCutoffStep_deg)
        add(at_cutoff > 0.2 ? Grade::kWarning : Grade::kInfo, "coarse",
            format("rows %.3g deg apart at the cut-off: its sharpness G is that of the interpolation (the rules "
                   "measure in 0.05 deg)",
                   at_cutoff));
    }
  }

  const IntensityTable& table_;
  LampReport report_;
};

}  // namespace

LampReport lint_lamp(const IntensityTable& table) {
  return Linter(table).run();
}

std::string grade_name(Grade grade) {
  return grade == Grade::kInfo ? "info" : grade == Grade::kWarning ? "warning" : "error";
}

std::string type_name(const IntensityTable& table) {
  if (table.screen_distance_m > 0.0) return "screen";
  return table.type == PhotometricType::kA ? "A" : table.type == PhotometricType::kB ? "B" : "C";
}

}  // namespace phare
