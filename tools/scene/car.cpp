// A saloon.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tools/scene/parts.h"

namespace phare::scene {

namespace {

using glm::dvec3;

/// Half cross-section of the body at one x, mirrored; z of sill, shoulder, and the deck in the middle.
std::vector<dvec3> body_ring(double x, double half_width, double sill, double shoulder, double deck) {
  const double w = half_width;
  const std::vector<std::array<double, 2>> half{{0.0, sill},
                                                {0.72 * w, sill},
                                                {0.96 * w, sill + 0.07},
                                                {w, 0.45 * sill + 0.55 * shoulder},
                                                {0.98 * w, shoulder - 0.06},
                                                {0.90 * w, shoulder},
                                                {0.5 * w, 0.4 * shoulder + 0.6 * deck},
                                                {0.0, deck}};
  std::vector<dvec3> ring;
  for (const auto& [y, z] : half) ring.push_back({x, y, z});
  for (std::size_t i = half.size() - 1; i-- > 1;) ring.push_back({x, -half[i][0], half[i][1]});
  return ring;
}

struct Section {
  double x, half_width, sill, shoulder, deck;  // m
};
constexpr std::array<Section, 11> kBody{{{-1.00, 0.74, 0.40, 0.86, 0.89},
                                         {-0.93, 0.83, 0.30, 0.94, 0.98},
                                         {-0.72, 0.87, 0.24, 0.97, 1.03},
                                         {-0.30, 0.89, 0.22, 0.95, 1.04},
                                         {0.40, 0.90, 0.20, 0.92, 0.98},
                                         {1.40, 0.90, 0.20, 0.90, 0.96},
                                         {2.05, 0.90, 0.20, 0.89, 0.96},
                                         {2.60, 0.89, 0.20, 0.85, 0.92},
                                         {3.15, 0.87, 0.22, 0.78, 0.84},
                                         {3.42, 0.80, 0.25, 0.68, 0.72},
                                         {3.54, 0.68, 0.34, 0.56, 0.58}}};
constexpr std::array<double, 2> kAxles_m{0.0, 2.62};
constexpr double kAxleHeight_m = 0.31, kArch_m = 0.37;  // radius of the openings about the wheels

/// Linear between the sections of the body, x within them.
Section body_section(double x) {
  std::size_t i = 1;
  while (i + 1 < kBody.size() && kBody[i].x < x) ++i;
  const Section &a = kBody[i - 1], &b = kBody[i];
  const double t = (x - a.x) / (b.x - a.x);
  const auto mix = [&](double from, double to) { return from + t * (to - from); };
  return {x, mix(a.half_width, b.half_width), mix(a.sill, b.sill), mix(a.shoulder, b.shoulder), mix(a.deck, b.deck)};
}

/// Height to which the body is open at a wheel; 0 beside them.
double arch_m(double x) {
  for (const double axle : kAxles_m)
    if (std::abs(x - axle) < kArch_m) return kAxleHeight_m + std::sqrt(kArch_m * kArch_m - (x - axle) * (x - axle));
  return 0.0;
}

/// Where the body is cut: its sections, and the openings about the wheels.
std::vector<double> body_stations() {
  std::vector<double> stations;
  for (const Section& s : kBody)
    if (std::ranges::none_of(kAxles_m, [&](double axle) { return std::abs(s.x - axle) < kArch_m + 0.01; }))
      stations.push_back(s.x);
  for (const double axle : kAxles_m)
    for (const double from_axle : {0.372, 0.36, 0.30, 0.17, 0.0})
      for (const double side : {-1.0, 1.0})
        if (from_axle > 0.0 || side > 0.0) stations.push_back(axle + side * from_axle);
  std::ranges::sort(stations);
  return stations;
}

/// Tyre, and a rim of five spokes before the dark.
void draw_wheel(Pen& pen, double x, double side) {
  const auto at = [&](double r, double turn, double y) {
    return dvec3(x + r * std::cos(turn), side * y, kAxleHeight_m + r * std::sin(turn));
  };
  // Seen from outside, which is to the left of the one and to the right of the other.
  const auto face = [&](Material m, dvec3 a, dvec3 b, dvec3 c, dvec3 d) {
    side < 0.0 ? pen.quad(m, a, b, c, d) : pen.quad(m, d, c, b, a);
  };
  constexpr int kSides = 16, kSpokes = 5;
  const auto tyre = [&](double y_a, double r_a, double y_b, double r_b) {
    pen.cone(Material::kRubber, {x, side * y_a, kAxleHeight_m}, r_a, {x, side * y_b, kAxleHeight_m}, r_b, kSides,
             false);
  };
  tyre(0.63, 0.31, 0.865, 0.31);
  tyre(0.865, 0.31, 0.88, 0.285);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto ring = [&](Material m, double outer, double inner, double y_outer, double y_inner, int sides) {
    for (int i = 0; i < sides; ++i) {
      const double a = kTurn * i / sides, b = kTurn * (i + 1) / sides;
      face(m, at(inner, a, y_inner), at(outer, a, y_outer), at(outer, b, y_outer), at(inner, b, y_inner));
    }
  };
  ring(Material::kRubber, 0.285, 0.215, 0.88, 0.882, kSides);
  ring(Material::kChrome, 0.215, 0.195, 0.882, 0.872, kSides);
  ring(Material::kDarkPlastic, 0.195, 0.0, 0.868, 0.868, kSides);
  for (int i = 0; i < kSpokes; ++i) {
    const double a = kTurn * (i + 0.25) / kSpokes, wide = 0.17, narrow = 0.6;
    face(Material::kChrome, at(0.05, a - narrow, 0.879), at(0.2, a - wide, 0.875), at(0.2, a + wide, 0.875),
         at(0.05, a + narrow, 0.879));
  }
  ring(Material::kChrome, 0.05, 0.0, 0.879, 0.881, 8);
}

/// Lens in a dark housing, on the edge of the bonnet from above the grille round to the wing.
void draw_headlamp(Pen& pen, double side) {
  // Along the body, m; shares of the way from its shoulder to the bonnet's middle and down the wing; m over the paint.
  const auto patch = [&](Material m, double from_x, double to_x, double inward, double outward, double over) {
    const auto across = [&](double x) {
      const Section s = body_section(x);
      const std::vector<dvec3> ring = body_ring(x, s.half_width, s.sill, s.shoulder, s.deck);
      const dvec3 wing = ring[4], shoulder = ring[5], bonnet = ring[6];
      const dvec3 out = {0.5 * over, 0.0, over};
      std::array<dvec3, 3> line{glm::mix(shoulder, bonnet, inward) + out, shoulder + out + dvec3(0.0, over, 0.0),
                                glm::mix(shoulder, wing, outward) + out + dvec3(0.0, over, 0.0)};
      for (dvec3& at : line) at.y *= side;
      return line;
    };
    const auto rear = across(from_x), front = across(to_x);
    for (std::size_t i = 0; i + 1 < rear.size(); ++i)
      side > 0.0 ? pen.quad(m, rear[i], front[i], front[i + 1], rear[i + 1])
                 : pen.quad(m, rear[i + 1], front[i + 1], front[i], rear[i]);
  };
  patch(Material::kDarkPlastic, 3.425, 3.538, 0.85, 0.95, 0.004);
  patch(Material::kChrome, 3.445, 3.53, 0.6, 0.7, 0.009);
}

}  // namespace

void draw_car(Pen pen, Material paint) {
  std::vector<std::vector<dvec3>> rings;
  for (const double x : body_stations()) {
    const Section s = body_section(x);
    rings.push_back(body_ring(x, s.half_width, std::max(s.sill, arch_m(x)), s.shoulder, s.deck));
  }
  pen.loft(paint, rings);
  pen.box(Material::kDarkPlastic, {-0.85, -0.64, 0.17}, {3.3, 0.64, 0.66});  // under it, and between the wheels

  // Greenhouse: glass all round under a painted roof, pillars in front of the glass.
  const auto slab = [](double x0, double x1, double w, double z) {
    return std::vector<dvec3>{{x0, -0.8 * w, z}, {x0 + 0.05, -w, z}, {x1 - 0.1, -w, z}, {x1, -0.7 * w, z},
                              {x1, 0.7 * w, z},  {x1 - 0.1, w, z},   {x0 + 0.05, w, z}, {x0, 0.8 * w, z}};
  };
  pen.loft(Material::kGlass, {slab(-0.52, 2.42, 0.80, 0.90), slab(-0.10, 1.72, 0.66, 1.36)}, false);
  pen.loft(paint, {slab(-0.14, 1.76, 0.675, 1.345), slab(0.0, 1.62, 0.63, 1.43), slab(0.25, 1.4, 0.48, 1.46)});
  for (const double side : {-1.0, 1.0}) {
    const auto pillar = [&](dvec3 low, dvec3 high, double thick) {
      low.y *= side, high.y *= side;
      pen.cone(paint, low, thick, high, 0.8 * thick, 4, false);
    };
    pillar({2.36, 0.74, 0.92}, {1.70, 0.62, 1.35}, 0.04);
    pillar({0.95, 0.80, 0.92}, {0.90, 0.665, 1.35}, 0.04);
    pillar({-0.36, 0.76, 0.95}, {-0.04, 0.63, 1.35}, 0.07);
    for (const double x : kAxles_m) draw_wheel(pen, x, side);
    pen.ellipsoid(paint, {1.98, side * 0.98, 0.96}, {0.08, 0.12, 0.07}, 4, 7);  // mirror
    // Tail lamp: a housing with its retroreflector.
    pen.box(Material::kSheetRed, {-1.015, side * 0.62 - 0.14, 0.72}, {-0.84, side * 0.62 + 0.14, 0.86});
    const double y = side * 0.60;
    pen.quad(Material::kReflectorRed, {-1.02, y + 0.12, 0.735}, {-1.02, y - 0.12, 0.735}, {-1.02, y - 0.12, 0.80},
             {-1.02, y + 0.12, 0.80});
    draw_headlamp(pen, side);
    pen.box(Material::kDarkPlastic, {0.45, side * 0.87, 0.20}, {2.17, side * 0.895, 0.28});
  }
  // Grille, bumper, number plates.
  const double nose = kBody.back().x;
  pen.box(Material::kDarkPlastic, {nose - 0.02, -0.40, 0.50}, {nose + 0.004, 0.40, 0.55});
  pen.box(Material::kDarkPlastic, {nose - 0.02, -0.50, 0.35}, {nose + 0.003, 0.50, 0.395});
  pen.box(Material::kDarkPlastic, {nose - 0.02, -0.28, 0.385}, {nose + 0.008, 0.28, 0.49});
  pen.quad(Material::kPlate, {nose + 0.01, -0.26, 0.39}, {nose + 0.01, 0.26, 0.39}, {nose + 0.01, 0.26, 0.485},
           {nose + 0.01, -0.26, 0.485});
  pen.box(Material::kDarkPlastic, {-1.04, -0.70, 0.36}, {-0.85, 0.70, 0.46});
  pen.box(Material::kDarkPlastic, {-1.015, -0.28, 0.555}, {-0.93, 0.28, 0.685});
  pen.quad(Material::kPlate, {-1.02, 0.26, 0.565}, {-1.02, -0.26, 0.565}, {-1.02, -0.26, 0.675}, {-1.02, 0.26, 0.675});
}

}  // namespace phare::scene
