// Luminaires of the made scenes, from formulas: nothing measured. A road luminaire throws its light along the street
// and cuts it off toward the horizon as class G*3 to G*4 of EN 13201-2 asks for (chosen by eye, unconfirmed); a tunnel
// luminaire is wide and symmetrical. Flux is computed from the table and scaled to what is asked for.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tools/scene/path.h"

namespace phare::scene {
namespace {

constexpr int kGammas = 73, kPlanes = 73;  // every 2.5° of gamma 0 … 180, every 5° of C 0 … 360
constexpr double kDeg = std::numbers::pi / 180.0;

struct Shape {
  double along_deg, width_deg, gamma_deg, height_deg;  ///< of the two wings: plane C from along the street, gamma
  double wings, base;                                  ///< relative candela
  double cutoff_deg, softness_deg;                     ///< gamma where half is left
  double behind;                                       ///< share that goes to the house side
};

double relative_cd(const Shape& shape, double c_deg, double gamma_deg) {
  if (gamma_deg >= 90.0) return 0.0;
  const auto bell = [](double x, double width) { return std::exp(-0.5 * x * x / (width * width)); };
  const double from_first = std::remainder(c_deg - shape.along_deg, 360.0);
  const double from_second = std::remainder(c_deg - (180.0 - shape.along_deg), 360.0);
  // Near gamma 0 all planes are one direction: the wings begin away from it.
  const double wing = (bell(from_first, shape.width_deg) + bell(from_second, shape.width_deg)) *
                      bell(gamma_deg - shape.gamma_deg, shape.height_deg) * std::sin(gamma_deg * kDeg);
  const double base = std::cos(gamma_deg * kDeg);
  const double kept = 1.0 / (1.0 + std::exp((gamma_deg - shape.cutoff_deg) / shape.softness_deg));
  const double back = std::max(-std::sin(c_deg * kDeg), 0.0) * std::sin(gamma_deg * kDeg);
  return (shape.wings * wing + shape.base * base) * kept * (1.0 - (1.0 - shape.behind) * back);
}

std::string lm63(const char* name, const char* what, const Shape& shape, double flux_lm) {
  std::vector<double> candela;
  double sum = 0.0;
  for (int c = 0; c < kPlanes; ++c)
    for (int g = 0; g < kGammas; ++g) {
      const double gamma = 2.5 * g, value = relative_cd(shape, 5.0 * c, gamma);
      candela.push_back(value);
      // Zones of solid angle about the nodes; the last plane is the first.
      const double low = std::max(gamma - 1.25, 0.0) * kDeg, high = std::min(gamma + 1.25, 180.0) * kDeg;
      if (c + 1 < kPlanes) sum += value * 5.0 * kDeg * (std::cos(low) - std::cos(high));
    }
  char line[160];
  std::snprintf(line, sizeof line, "IESNA:LM-63-2002\n[TEST] computed, not measured\n[MANUFAC] Phare\n[LUMINAIRE] %s\n",
                name);
  std::string text = line;
  std::snprintf(line, sizeof line, "[OTHER] %s, %.0f lm\nTILT=NONE\n1 %.0f 1 %d %d 1 2 0.3 0.4 0\n1 1 30\n", what,
                flux_lm, flux_lm, kGammas, kPlanes);
  text += line;
  const auto number = [&](const char* format, double value, int& column) {
    std::snprintf(line, sizeof line, format, value);
    text += line;
    text += ++column % 12 == 0 ? "\n" : " ";
  };
  int column = 0;
  for (int g = 0; g < kGammas; ++g) number("%.1f", 2.5 * g, column);
  text += "\n", column = 0;
  for (int c = 0; c < kPlanes; ++c) number("%.0f", 5.0 * c, column);
  text += "\n";
  for (int c = 0; c < kPlanes; ++c) {
    column = 0;
    for (int g = 0; g < kGammas; ++g)
      number("%.2f", candela[static_cast<std::size_t>(c * kGammas + g)] * flux_lm / sum, column);
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> luminaire_files() {
  return {{"street_led.ies", lm63("street LED", "road luminaire, wings along the street",
                                  {12.0, 26.0, 62.0, 14.0, 1.0, 0.32, 76.0, 2.2, 0.35}, 3500.0)},
          {"tunnel_led.ies", lm63("tunnel LED", "tunnel luminaire, wide and symmetrical",
                                  {0.0, 70.0, 52.0, 18.0, 0.8, 0.6, 80.0, 3.0, 1.0}, 800.0)}};
}

}  // namespace phare::scene
