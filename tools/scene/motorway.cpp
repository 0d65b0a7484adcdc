// A motorway outside towns: two lanes and a hard shoulder each way, median with rails, posts, signs, a bridge over it;
// no lamp stands beside it. Layout by us after the German guide RAA: lanes of 3.75 m, shoulder of 2.5 m, median of 4 m.
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "tools/scene/lettering.h"
#include "tools/scene/parts.h"
#include "tools/scene/path.h"

namespace phare::scene {
namespace {

using glm::dvec3;

constexpr double kInner_m = 2.0, kLane_m = 3.75;  ///< paved from the median on
constexpr double kInnerLine_m = 2.75, kMiddle_m = kInnerLine_m + kLane_m, kOuterLine_m = kMiddle_m + kLane_m,
                 kPaved_m = kOuterLine_m + 2.75;
constexpr double kBridge_m = 520.0, kGantry_m = 190.0;

void add_carriageway(Model& model, const Path& path, int number, double begin, double end, double side) {
  Node& road = model.add(numbered_node("road", 2 * number + (side > 0.0 ? 1 : 0)));
  const auto strip = [&](Node& node, Material m, double inner, double outer, double z_inner, double z_outer) {
    if (side > 0.0)
      add_strip(node, m, path, begin, end, 10.0, {inner, z_inner}, {outer, z_outer});
    else
      add_strip(node, m, path, begin, end, 10.0, {-outer, z_outer}, {-inner, z_inner});
  };
  constexpr std::array kAcross_m{
      kInner_m,     kInnerLine_m, 0.5 * (kInnerLine_m + kMiddle_m), kMiddle_m, 0.5 * (kMiddle_m + kOuterLine_m),
      kOuterLine_m, kPaved_m};
  for (std::size_t i = 0; i + 1 < kAcross_m.size(); ++i)
    strip(road, Material::kAsphalt, kAcross_m[i], kAcross_m[i + 1], 0.0, 0.0);
  Node& marking = model.add(numbered_node("marking", 2 * number + (side > 0.0 ? 1 : 0)));
  constexpr double kUp_m = 0.006;
  strip(marking, Material::kPaint, kInnerLine_m - 0.075, kInnerLine_m + 0.075, kUp_m, kUp_m);
  strip(marking, Material::kPaint, kOuterLine_m - 0.15, kOuterLine_m + 0.15, kUp_m, kUp_m);
  const double low = std::min(side * kMiddle_m - 0.075, side * kMiddle_m + 0.075);
  for (double s = std::ceil(begin / 18.0) * 18.0; s < end; s += 18.0)  // 6 m of paint, 12 m of gap
    add_strip(marking, Material::kPaint, path, s, s + 6.0, 6.0, {low, kUp_m}, {low + 0.15, kUp_m});
  Node& ground = model.add(numbered_node("ground", 2 * number + (side > 0.0 ? 1 : 0)));
  strip(ground, Material::kVerge, 0.0, kInner_m, 0.02, 0.0);
  strip(ground, Material::kVerge, kPaved_m, kPaved_m + 1.5, 0.0, -0.08);
  strip(ground, Material::kGrass, kPaved_m + 1.5, kPaved_m + 8.0, -0.08, 1.4);
  strip(ground, Material::kGrass, kPaved_m + 8.0, kPaved_m + 45.0, 1.4, 2.6);
}

/// W profile as of the country road's rails: depth toward the road, height.
constexpr std::array<std::array<double, 2>, 6> kRail{
    {{0.0, 0.44}, {0.08, 0.51}, {0.015, 0.58}, {0.015, 0.61}, {0.08, 0.68}, {0.0, 0.75}}};

void add_rail(Model& model, const Path& path, int number, double begin, double end, double t, double toward) {
  Node& node = model.add(numbered_node("rail", number));
  for (std::size_t i = 0; i + 1 < kRail.size(); ++i) {
    const StripLine a{t + toward * kRail[i][0], kRail[i][1]}, b{t + toward * kRail[i + 1][0], kRail[i + 1][1]};
    if (toward < 0.0)
      add_strip(node, Material::kSteel, path, begin, end, 12.5, a, b);
    else
      add_strip(node, Material::kSteel, path, begin, end, 12.5, b, a);
  }
  for (double s = begin; s < end; s += 4.0)
    Pen(node, path.placed(s, t - toward * 0.05)).box(Material::kSteel, {-0.05, -0.03, -0.2}, {0.05, 0.03, 0.7});
  for (double s = begin + 12.5; s < end; s += 25.0) {  // seen by who drives on the side that it looks at
    Pen eye(node, path.placed(s, t + toward * 0.03, toward < 0.0 ? std::numbers::pi : 0.0, 0.75));
    eye.box(Material::kDarkPlastic, {-0.02, -0.045, 0.0}, {0.0, 0.045, 0.16});
    eye.quad(Material::kReflectorAmber, {0.004, -0.04, 0.02}, {0.004, 0.04, 0.02}, {0.004, 0.04, 0.15},
             {0.004, -0.04, 0.15});
  }
}

/// A plate that looks back along the road at who comes: its lower edge at z.
void draw_plate(Pen pen, double width, double height, double z, std::string_view upper, std::string_view lower) {
  const auto face = [&](Material m, double x, double inset) {
    const double y = 0.5 * width - inset;
    pen.quad(m, {x, y, z + inset}, {x, -y, z + inset}, {x, -y, z + height - inset}, {x, y, z + height - inset});
  };
  pen.box(Material::kSignBack, {0.0, -0.5 * width, z}, {0.06, 0.5 * width, z + height});
  face(Material::kSheetWhite, -0.004, 0.0);
  face(Material::kSheetBlue, -0.008, 0.12);
  // Two lines of letters, and an arrow that points down to the lane. y counts to the left, as who comes reads.
  const auto stroke = [&](std::array<double, 2> a, std::array<double, 2> b, double wide) {
    const double dy = b[0] - a[0], dz = b[1] - a[1], scale = 0.5 * wide / std::hypot(dy, dz);
    const double ny = dz * scale, nz = -dy * scale;
    pen.quad(Material::kSheetWhite, {-0.012, a[0] - ny, a[1] - nz}, {-0.012, b[0] - ny, b[1] - nz},
             {-0.012, b[0] + ny, b[1] + nz}, {-0.012, a[0] + ny, a[1] + nz});
  };
  const auto line = [&](std::string_view text, double low) {
    const double high = 0.15 * height, wide = 0.62 * high, step = 1.45 * wide;
    double left = 0.42 * width;
    for (const char letter : text) {
      for (const LetterStroke& l : strokes_of(letter))
        stroke({left - wide * l[0], z + low + high * l[1]}, {left - wide * l[2], z + low + high * l[3]}, 0.17 * high);
      left -= step;
    }
  };
  line(upper, 0.68 * height);
  line(lower, 0.42 * height);
  const double tip = z + 0.1 * height, top = z + 0.32 * height, barb = 0.09 * height;
  stroke({0.0, top}, {0.0, tip}, 0.03 * height);
  for (const double side : {-1.0, 1.0}) stroke({side * barb, tip + barb}, {0.0, tip}, 0.03 * height);
}

void add_gantry(Model& model, const Path& path) {
  Node& node = model.add("sign_gantry");
  Pen pen(node, path.placed(kGantry_m, 0.0));
  pen.box(Material::kSteel, {-0.15, -kPaved_m - 1.2, -0.3}, {0.15, -kPaved_m - 0.9, 7.4});
  pen.box(Material::kSteel, {-0.15, -0.15, -0.3}, {0.15, 0.15, 7.4});
  pen.box(Material::kSteel, {-0.2, -kPaved_m - 1.2, 7.0}, {0.2, 0.15, 7.4});
  draw_plate(Pen(node, path.placed(kGantry_m - 0.25, -8.6)), 4.6, 2.6, 5.1, "LUMEN", "A 7  NORD");
  draw_plate(Pen(node, path.placed(kGantry_m - 0.25, -4.0)), 4.0, 2.6, 5.1, "CANDELA", "A 25");
}

void add_bridge(Model& model, const Path& path) {
  Pen pen(model.add("bridge"), path.placed(kBridge_m, 0.0, 0.12));
  pen.box(Material::kConcrete, {-4.5, -60.0, 5.2}, {4.5, 60.0, 6.3});
  for (const double x : {-4.5, 4.3}) pen.box(Material::kConcrete, {x, -60.0, 6.3}, {x + 0.2, 60.0, 7.2});
  for (const double y : {-16.5, 0.0, 16.5}) pen.box(Material::kConcrete, {-3.0, y - 0.45, -0.3}, {3.0, y + 0.45, 5.2});
}

void add_things(Model& model, const Path& path) {
  Random random(4711);
  int number = 0;
  for (double s = path.begin_m() + 5.0; s < path.end_m(); s += 50.0) {
    Node& node = model.add(numbered_node("post", number++));
    for (const double side : {-1.0, 1.0}) draw_kerb_post(Pen(node, path.placed(s, side * (kPaved_m + 0.5))), side);
  }
  number = 0;
  for (double s = path.begin_m(); s < path.end_m(); s += 19.0)
    for (const double side : {-1.0, 1.0}) {
      if (random.uniform(0.0, 1.0) < 0.45 || std::abs(s - kBridge_m) < 20.0) continue;
      draw_tree(Pen(model.add(numbered_node("tree", number++)),
                    path.placed(s + random.uniform(-6.0, 6.0), side * random.uniform(26.0, 46.0), 0.0, 1.6)),
                random, random.uniform(7.0, 12.0), Material::kLeaves);
    }
}

}  // namespace

MadeScene make_motorway() {
  const Path path(1500.0, 60.0, {{300.0, 900.0, 900.0}, {1000.0, 1400.0, -1100.0}});
  MadeScene scene;
  int rails = 0;
  each_piece(path, [&](int number, double begin, double end) {
    for (const double side : {-1.0, 1.0}) {
      add_carriageway(scene.model, path, number, begin, end, side);
      add_rail(scene.model, path, rails++, begin, end, side * 1.0, side);
      if (begin > 440.0 && end < 640.0)  // the piers of the bridge
        add_rail(scene.model, path, rails++, begin, end, side * (kPaved_m + 0.6), -side);
    }
  });
  add_gantry(scene.model, path);
  add_bridge(scene.model, path);
  add_things(scene.model, path);
  scene.lane_csv = path.lane_csv(-0.5 * (kMiddle_m + kOuterLine_m));
  return scene;
}

}  // namespace phare::scene
