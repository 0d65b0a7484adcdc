// Barn, parked car, fences, hay bales.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tools/scene/lane_files.h"
#include "tools/scene/parts.h"

namespace phare::scene {

namespace {

using glm::dvec3;

/// x of the barn points at the driver; its light wall lies in x = 0, from y = 0 (next to the road) to y = kWide on his
/// right.
void draw_barn(Pen pen) {
  constexpr double kWide = 14.0, kDeep = 10.0, kPlaster = 3.6, kEaves = 5.4, kRidge = 9.2, kFoot = -2.0;
  pen.box(Material::kStone, {-kDeep - 0.06, -0.06, kFoot}, {0.06, kWide + 0.06, 0.45});
  pen.box(Material::kPlaster, {-kDeep, 0.0, 0.45}, {0.0, kWide, kPlaster});
  // Boards above the plaster, each with its own small step, so that the upper part reads as wood.
  constexpr int kBoards = 35;
  for (int i = 0; i < kBoards; ++i) {
    const double y0 = kWide * i / kBoards, y1 = kWide * (i + 1) / kBoards - 0.03, out = 0.05 + 0.025 * (i % 3);
    pen.box(i % 5 == 2 ? Material::kWoodOld : Material::kWood, {0.0, y0, kPlaster - 0.12}, {out, y1, kEaves + 0.1});
  }
  pen.box(Material::kWood, {-kDeep - 0.03, -0.03, kPlaster}, {-0.02, kWide + 0.03, kEaves});
  // Gables and roof; the ridge runs along the wall.
  for (const double y : {-0.03, kWide + 0.03}) {
    const std::array<dvec3, 3> gable{{{0.0, y, kEaves}, {-kDeep, y, kEaves}, {-0.5 * kDeep, y, kRidge}}};
    if (y < 1.0) {
      pen.triangle(Material::kWood, gable[0], gable[2], gable[1]);
    } else {
      pen.triangle(Material::kWood, gable[0], gable[1], gable[2]);
    }
  }
  const double slope = (kRidge - kEaves) / (0.5 * kDeep), over = 0.7;
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x_from_ridge, double y, double lift) {
      return dvec3(-0.5 * kDeep + side * x_from_ridge, y, kRidge - slope * x_from_ridge + lift);
    };
    const double reach = 0.5 * kDeep + over;
    pen.block(Material::kRoofTiles,
              {{at(0, -0.6, 0.05), at(reach, -0.6, 0.05), at(reach, kWide + 0.6, 0.05), at(0, kWide + 0.6, 0.05),
                at(0, -0.6, 0.25), at(reach, -0.6, 0.25), at(reach, kWide + 0.6, 0.25), at(0, kWide + 0.6, 0.25)}});
  }
  // Two-leaved door with frame and braces at the far end of the wall: the near 9 m stay plain, to see the cut-off on.
  const double y0 = 9.6, y1 = 12.8, top = 3.2;
  pen.box(Material::kWoodOld, {-0.05, y0 - 0.18, 0.0}, {0.07, y1 + 0.18, top + 0.2});
  for (const double leaf : {0.0, 1.0}) {
    const double a = y0 + 1.61 * leaf, b = a + 1.57;
    pen.box(Material::kDoor, {0.0, a, 0.0}, {0.10, b, top});
    for (const double z : {0.35, 1.55, 2.75})
      pen.box(Material::kWoodOld, {0.10, a + 0.05, z}, {0.13, b - 0.05, z + 0.16});
  }
  pen.box(Material::kDarkPlastic, {0.0, 7.6, 1.7}, {0.05, 8.4, 2.5});  // a small window, dark
  pen.box(Material::kWoodOld, {0.0, 7.52, 1.6}, {0.09, 8.48, 1.7});
}

void add_fence(Model& model, const Alignment& road, double begin, double end, double t, int& number) {
  constexpr double kSpan_m = 3.0;
  Node* node = nullptr;
  int i = 0;
  for (double s = begin; s <= end; s += kSpan_m, ++i) {
    if (i % 16 == 0) {
      char name[32];
      std::snprintf(name, sizeof name, "fence_%03d", number++);
      node = &model.add(name);
    }
    Pen pen(*node, placed(road, s, t));
    // Without what nobody sees: the foot in the ground, rails' ends within posts.
    std::vector<dvec3> foot, top;
    for (int corner = 0; corner < 6; ++corner) {
      const double turn = std::numbers::pi * corner / 3.0;
      foot.push_back({0.06 * std::cos(turn), 0.06 * std::sin(turn), -0.4});
      top.push_back({0.055 * std::cos(turn), 0.055 * std::sin(turn), 1.15 + 0.07 * std::sin(7.0 * i)});
    }
    pen.loft(Material::kWoodOld, {foot, top}, false);
    pen.polygon(Material::kWoodOld, top);
    if (s + kSpan_m > end) break;
    const dvec3 a = road.point(s, t), b = road.point(s + kSpan_m, t);
    Pen rails(*node, glm::dmat4(1.0));
    const dvec3 side = 0.04 * glm::normalize(glm::cross(b - a, dvec3(0, 0, 1)));
    for (const double z : {0.5, 0.95}) {
      const dvec3 low(0, 0, z), high(0, 0, z + 0.1);
      rails.loft(Material::kWoodOld,
                 {{a - side + low, a + side + low, a + side + high, a - side + high},
                  {b - side + low, b + side + low, b + side + high, b - side + high}},
                 false);
    }
  }
}

}  // namespace

void add_things(Model& model, const Alignment& road) {
  // The barn's wall faces a driver 36 m before it, at s = 425, where the road has begun to bend away to the left.
  const Station view = road.at(425.0);
  dvec3 foot = view.position_m + 36.0 * view.forward() - 3.2 * view.left();
  foot.z = road.height_m(kBarn_m, -9.0) + 0.1;
  // x towards the driver makes y his right-hand side.
  draw_barn(Pen(model.add("barn"), placed_at(foot, view.heading_rad + std::numbers::pi)));

  draw_car(Pen(model.add("car_parked"), placed(road, kParkedCar_m, -5.2, -0.02, -0.01)));

  int fences = 0;
  add_fence(model, road, 640.0, 784.0, 9.6, fences);
  add_fence(model, road, 885.0, 1005.0, -10.4, fences);
  add_fence(model, road, 510.0, 612.0, -9.6, fences);

  constexpr std::array<std::array<double, 3>, 6> bales{{{958.0, 17.0, 0.3},
                                                        {966.0, 21.0, 1.2},
                                                        {975.0, 15.5, 2.2},
                                                        {984.0, 25.0, 0.7},
                                                        {1000.0, 19.0, 1.7},
                                                        {1012.0, 28.0, 0.1}}};
  for (std::size_t i = 0; i < bales.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "bale_%03zu", i);
    Pen pen(model.add(name), placed(road, bales[i][0], bales[i][1], bales[i][2]));
    pen.cone(Material::kHay, {0.0, -0.62, 0.70}, 0.74, {0.0, 0.62, 0.70}, 0.74, 18);
  }
}

}  // namespace phare::scene
