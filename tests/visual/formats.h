// One beam, the low beam that is shipped, in every format that is read: LM-63 A, B and C, EULUMDAT, TM-33, candela CSV,
// goniometer CSV, flat-screen CSV.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "visual/beam_packing.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {

inline const IntensityTable& low_beam() {
  static const std::vector<SampleLamp> lamps = sample_lamps();
  return std::find_if(lamps.begin(), lamps.end(), [](const SampleLamp& lamp) { return lamp.file == "low_rht.ies"; })
      ->table;
}

inline std::vector<double> steps(double from, double to, double step) {
  std::vector<double> nodes;
  for (int i = 0; from + step * i <= to + 1e-9; ++i) nodes.push_back(std::round((from + step * i) * 1e9) * 1e-9);
  return nodes;
}

inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

/// A matrix CSV of our low beam; value(second, first).
inline std::string matrix(const std::string& head, const std::vector<double>& first, const std::vector<double>& second,
                          const std::function<double(double, double)>& value) {
  std::string text = head;
  for (const double f : first) text += "," + number(f);
  text += '\n';
  for (const double s : second) {
    text += number(s);
    for (const double f : first) text += "," + number(value(s, f));
    text += '\n';
  }
  return text;
}

/// Lux on a screen at x = `d`, y left and z up, lit by our low beam.
inline std::string screen(double d, const std::vector<double>& y, const std::vector<double>& z) {
  return matrix("# unit: lx\n# distance_m: " + number(d) + "\nz\\y", y, z, [d](double up, double left) {
    const double r2 = d * d + left * left + up * up;
    return low_beam().intensity_cd({d, left, up}) * d / (r2 * std::sqrt(r2));
  });
}

inline std::string tm33_text(const IntensityTable& table) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<IESTM33-22><Version>1.1</Version>\n<Emitter><LuminousData>"
      "<PhotometryType>CIE-A</PhotometryType><SymmType>Symm _ None</SymmType>\n";
  for (std::size_t i = 0; i < table.first_deg.size(); ++i) {
    for (std::size_t j = 0; j < table.second_deg.size(); ++j)
      text += "<IntensityData horz=\"" + number(table.first_deg[i]) + "\" vert=\"" + number(table.second_deg[j]) +
              "\">" + number(table.candela[j * table.first_deg.size() + i]) + "</IntensityData>\n";
  }
  return text + "</LuminousData></Emitter></IESTM33-22>\n";
}

struct Format {
  std::string name;  ///< of the file
  std::string text;
  std::uint32_t lookup = 0;  ///< how the device is to find its nodes
  LampReadSettings settings{};
};

inline std::vector<Format> formats() {
  const IntensityTable& low = low_beam();
  const auto on = [&](PhotometricType type, GammaAxis axis, std::vector<double> first, std::vector<double> second) {
    return resample(low, type, axis, std::move(first), std::move(second));
  };
  const auto b_h = steps(-40, 40, 0.5), b_v = steps(-14, 10, 0.25);
  const IntensityTable b = on(PhotometricType::kB, GammaAxis::kGamma0, b_h, b_v);
  const IntensityTable c0 = on(PhotometricType::kC, GammaAxis::kGamma0, steps(0, 360, 2.5), steps(0, 60, 0.25));
  const IntensityTable c90 = on(PhotometricType::kC, GammaAxis::kGamma90, steps(0, 360, 0.5), steps(60, 120, 0.25));
  // Multiples of nothing: bent a little, so that every node is where counting says or next to it; and freely.
  std::vector<double> bent_h, bent_v, uneven_h, uneven_v;
  for (int i = -60; i <= 60; ++i) bent_h.push_back(0.7 * i + 0.0723456789 * std::sin(i));
  for (int j = -40; j <= 30; ++j) bent_v.push_back(0.3 * j + 0.0223456789 * std::cos(j));
  for (int i = -60; i <= 60; ++i) uneven_h.push_back(0.7 * i + 0.3123456789 * std::sin(i));
  for (int j = -40; j <= 30; ++j) uneven_v.push_back(0.3 * j + 0.1323456789 * std::cos(j));
  const IntensityTable bent = on(PhotometricType::kA, GammaAxis::kGamma0, bent_h, bent_v);
  const IntensityTable uneven = on(PhotometricType::kA, GammaAxis::kGamma0, uneven_h, uneven_v);
  // Evenly about 0°, which is no node; and 256 × 128 nodes as a program writes them, rounded to 1e-4°: also with ends
  // that are rounded, with one that is not as the others say, which takes a second fetch, and coarsely, by up to a 67th
  // of the way between two nodes; and so finely that they are even.
  const IntensityTable half =
      on(PhotometricType::kA, GammaAxis::kGamma0, steps(-39.75, 39.75, 0.5), steps(-13.9, 9.9, 0.2));
  const auto written = [](double from, double to, int count, double per_unit = 1e4) {
    std::vector<double> nodes;
    for (int i = 0; i < count; ++i)
      nodes.push_back(std::round((from + (to - from) * i / (count - 1)) * per_unit) / per_unit);
    return nodes;
  };
  const IntensityTable rounded =
      on(PhotometricType::kA, GammaAxis::kGamma0, written(-45, 45, 256), written(-20, 10, 128));
  const IntensityTable b_rounded =
      on(PhotometricType::kB, GammaAxis::kGamma0, written(-45, 45, 256), written(-20, 10, 128));
  const auto off_h = written(-44.98765, 44.51117, 251), off_v = written(-19.43219, 9.87654, 119);
  const IntensityTable ends = on(PhotometricType::kA, GammaAxis::kGamma0, off_h, off_v);
  auto one_beside = off_v;
  one_beside[60] += 1e-4;
  const IntensityTable beside = on(PhotometricType::kA, GammaAxis::kGamma0, off_h, one_beside);
  const IntensityTable finely =
      on(PhotometricType::kA, GammaAxis::kGamma0, written(-45, 45, 256, 1e7), written(-20, 10, 128, 1e7));
  const IntensityTable thirds =
      on(PhotometricType::kA, GammaAxis::kGamma0, written(-40, 40, 241, 100), written(-40.0 / 3, 10, 71, 1000));
  LampReadSettings gamma90;
  gamma90.axis = GammaAxis::kGamma90;
  // Wide, near screens show the projection's factor: at their corners 1/cos³ is 12 and 3.4.
  std::vector<double> far_out;  // multiples of nothing
  for (int i = -40; i <= 40; ++i) far_out.push_back(10.0 * std::sinh(0.05 * i) / std::sinh(2.0));
  using namespace shader;
  return {{"a.ies", lm63_text(low), kLookupAhead},
          {"a_half.ies", lm63_text(half), kLookupAhead},
          {"a_rounded.ies", lm63_text(rounded), kLookupDecimals},
          {"b_rounded.ies", lm63_text(b_rounded), kLookupDecimals},
          {"a_finely.ies", lm63_text(finely), kLookupAhead},
          {"a_ends.ies", lm63_text(ends), kLookupDecimals},
          {"a_beside.ies", lm63_text(beside), kLookupRounded},
          {"a_thirds.ies", lm63_text(thirds), kLookupDecimals},
          {"a_bent.ies", lm63_text(bent), kLookupRounded},
          {"a_uneven.ies", lm63_text(uneven), kLookupGuide},
          {"b.ies", lm63_text(b), kLookupAhead},
          {"c_gamma0.ies", lm63_text(c0), kLookupTurn},
          {"c_gamma90.ies", lm63_text(c90), kLookupTurn, gamma90},
          {"gamma0.ldt", eulumdat_text(c0), kLookupTurn},
          {"gamma90.ldt", eulumdat_text(c90, GammaAxis::kGamma90), kLookupTurn, gamma90},
          {"a.xml", tm33_text(on(PhotometricType::kA, GammaAxis::kGamma0, b_h, b_v)), kLookupAhead},
          {"candela.csv", csv_text(b), kLookupAhead},
          {"candela_c.csv", csv_text(c0), kLookupTurn},
          {"goniometer.csv",
           matrix("# unit: lx\n# distance_m: 25\n# angles: type B\nV\\H", b_h, b_v,
                  [&](double v, double h) {
                    return low.intensity_cd(table_direction(PhotometricType::kB, GammaAxis::kGamma0, {h, v})) / 625.0;
                  }),
           kLookupAhead},
          {"screen_25m.csv", screen(25, steps(-30, 30, 0.25), steps(-7.5, 7.5, 0.1)), kLookupScreen},
          {"screen_wide.csv", screen(5, steps(-10, 10, 0.1), steps(-4, 2, 0.05)), kLookupScreen},
          {"screen_uneven.csv", screen(5, far_out, steps(-4, 2, 1.0 / 29.0)), kLookupScreenGuide}};
}

inline const Format& format_named(const std::vector<Format>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const Format& format) { return format.name == name; });
}

}  // namespace phare
