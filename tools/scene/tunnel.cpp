// A road that goes through a hill: two lanes in a tunnel of 300 m with a bend, two rows of luminaires. Layout by us
// after the German guide RABT: walls 4.65 m from the middle, walkways of 0.9 m, 5.4 m high.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/scene/parts.h"
#include "tools/scene/path.h"

namespace phare::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double kBegin_m = 25.0, kEnd_m = 325.0;
constexpr double kLane_m = 3.5, kPaved_m = 3.75, kWall_m = 4.65, kKerb_m = 0.15, kPanelTop_m = 3.2, kHigh_m = 5.4;
constexpr dvec2 kCut_m{0.9, 0.7};  // what the vault cuts off of the corners above the walls: across, up
constexpr double kLampEvery_m = 8.0, kLampOffset_m = 2.1;

/// ISO 7010 E001 in outline: who runs through a door, and an arrow that way. On a wall at y 0 that looks to y.
void draw_escape_sign(Pen pen) {
  pen.box(Material::kEscapeSign, {-0.3, 0.0, 1.2}, {0.3, 0.03, 1.5});
  const auto stroke = [&](dvec2 a, dvec2 b, double wide) {
    const dvec2 d = b - a, n = 0.5 * wide / glm::length(d) * dvec2(d.y, -d.x);
    const auto at = [](dvec2 p) { return dvec3(p.x, 0.034, 1.2 + p.y); };
    pen.quad(Material::kEscapeSignWhite, at(a + n), at(a - n), at(b - n), at(b + n));
  };
  stroke({0.03, 0.02}, {0.03, 0.28}, 0.02);  // the door
  stroke({0.03, 0.27}, {0.2, 0.27}, 0.02);
  stroke({0.2, 0.28}, {0.2, 0.02}, 0.02);
  stroke({0.105, 0.222}, {0.145, 0.222}, 0.04);  // head, trunk, arms, legs
  stroke({0.12, 0.195}, {0.1, 0.11}, 0.035);
  stroke({0.17, 0.165}, {0.075, 0.18}, 0.018);
  stroke({0.1, 0.12}, {0.06, 0.075}, 0.022);
  stroke({0.06, 0.075}, {0.075, 0.03}, 0.02);
  stroke({0.105, 0.12}, {0.14, 0.08}, 0.022);
  stroke({0.14, 0.08}, {0.175, 0.085}, 0.02);
  stroke({-0.03, 0.15}, {-0.24, 0.15}, 0.03);  // the arrow
  stroke({-0.24, 0.15}, {-0.17, 0.21}, 0.03);
  stroke({-0.24, 0.15}, {-0.17, 0.09}, 0.03);
}

bool inside(double s) {
  return s > kBegin_m && s < kEnd_m;
}

/// A cutting: its banks rise toward the hill.
void add_banks(Node& node, const Path& path, double begin, double end) {
  const auto high = [](double s) {
    return std::max(0.8, 8.0 - 0.08 * std::min(std::abs(s - kBegin_m), std::abs(s - kEnd_m)));
  };
  Pen pen(node, glm::dmat4(1.0));
  const int steps = std::max(1, static_cast<int>(std::ceil((end - begin) / 10.0)));
  for (int i = 0; i < steps; ++i) {
    const double a = begin + (end - begin) * i / steps, b = begin + (end - begin) * (i + 1) / steps;
    for (const double side : {-1.0, 1.0}) {
      const auto foot = [&](double s) { return path.point(s, side * 5.6, -0.05); };
      const auto edge = [&](double s) { return path.point(s, side * (7.5 + 0.8 * high(s)), high(s)); };
      const auto field = [&](double s) { return path.point(s, side * 60.0, high(s) + 2.5); };
      const auto quad = [&](const dvec3& p, const dvec3& q, const dvec3& r, const dvec3& t) {
        side > 0.0 ? pen.quad(Material::kGrass, p, q, r, t) : pen.quad(Material::kGrass, q, p, t, r);
      };
      quad(foot(a), foot(b), edge(b), edge(a));
      quad(edge(a), edge(b), field(b), field(a));
    }
  }
}

/// Strips that know whether they lie under the roof, on a rectangle's or an open road's cross-section.
void add_piece(Model& model, const Path& path, int number, double begin, double end) {
  const bool covered = inside(0.5 * (begin + end));
  // What meets along the road bends at the same places, or one would see through between.
  const double step_m = covered ? 4.0 : 5.0;
  Node& road = model.add(numbered_node("road", number));
  const Material asphalt = covered ? Material::kTunnelRoad : Material::kAsphalt;
  constexpr std::array kAcross_m{-kPaved_m, -1.75, 0.0, 1.75, kPaved_m};
  for (std::size_t i = 0; i + 1 < kAcross_m.size(); ++i)
    add_strip(road, asphalt, path, begin, end, step_m, {kAcross_m[i], 0.0}, {kAcross_m[i + 1], 0.0});
  Node& marking = model.add(numbered_node("marking", number));
  const Material paint = covered ? Material::kTunnelPaint : Material::kPaint;
  constexpr double kUp_m = 0.006;
  for (const double t : {-kLane_m, kLane_m})
    add_strip(marking, paint, path, begin, end, step_m, {t - 0.06, kUp_m}, {t + 0.06, kUp_m});
  for (const double t : {-0.12, 0.12})  // a double line: no overtaking in a tunnel and before it
    add_strip(marking, paint, path, begin, end, step_m, {t - 0.06, kUp_m}, {t + 0.06, kUp_m});
  if (!covered) {
    Node& ground = model.add(numbered_node("ground", number));
    add_strip(ground, Material::kVerge, path, begin, end, step_m, {-5.6, -0.05}, {-kPaved_m, 0.0});
    add_strip(ground, Material::kVerge, path, begin, end, step_m, {kPaved_m, 0.0}, {5.6, -0.05});
    add_banks(ground, path, begin, end);
    return;
  }
  Node& walk = model.add(numbered_node("ground", number));
  Node& tube = model.add(numbered_node("tunnel", number));
  for (const double side : {-1.0, 1.0}) {
    const auto strip = [&](Node& node, Material material, StripLine inner, StripLine outer) {
      inner.t_m *= side, outer.t_m *= side;
      if (side > 0.0)
        add_strip(node, material, path, begin, end, step_m, inner, outer);
      else
        add_strip(node, material, path, begin, end, step_m, outer, inner);
    };
    strip(walk, Material::kTunnelWalk, {kPaved_m, 0.0}, {kPaved_m, kKerb_m});
    strip(walk, Material::kTunnelWalk, {kPaved_m, kKerb_m}, {kWall_m, kKerb_m});
    strip(tube, Material::kTunnelPanel, {kWall_m, kKerb_m}, {kWall_m, 1.2});
    strip(tube, Material::kTunnelPanel, {kWall_m, 1.2}, {kWall_m, kPanelTop_m});
    strip(tube, Material::kTunnelVault, {kWall_m, kPanelTop_m}, {kWall_m, kHigh_m - kCut_m.y});
    strip(tube, Material::kTunnelVault, {kWall_m, kHigh_m - kCut_m.y}, {kWall_m - kCut_m.x, kHigh_m});
    strip(tube, Material::kTunnelVault, {kWall_m - kCut_m.x, kHigh_m}, {1.6, kHigh_m});
    strip(tube, Material::kTunnelVault, {1.6, kHigh_m}, {0.0, kHigh_m});
  }
}

void add_portal(Model& model, const Path& path, double s, bool entrance) {
  // x of the frame looks out of the hill.
  const double turn = entrance ? std::numbers::pi : 0.0;
  Pen pen(model.add(entrance ? "portal_in" : "portal_out"), path.placed(s, 0.0, turn));
  constexpr double kHalf_m = 11.0, kTop_m = 9.0, kThick_m = 0.8;
  const auto slab = [&](double y0, double y1, double z0, double z1) {
    pen.box(Material::kConcrete, {-kThick_m, y0, z0}, {0.05, y1, z1});
  };
  // It frames the tube, a little within walls and vault, and closes the ends of the walkways and what the vault cuts
  // off.
  constexpr double kFrame_m = 0.02, kSide_m = kWall_m - kFrame_m, kOver_m = kHigh_m - kFrame_m;
  constexpr double kSlope = kCut_m.y / kCut_m.x;
  const double frame_m = kFrame_m * std::hypot(1.0, kSlope);
  const dvec2 foot(kSide_m, kHigh_m - frame_m - kSlope * (kCut_m.x - kFrame_m));
  const dvec2 head(kWall_m - kCut_m.x - (frame_m - kFrame_m) / kSlope, kOver_m);
  slab(-kSide_m, kSide_m, kOver_m, kTop_m);
  for (const double side : {-1.0, 1.0}) {
    const auto ends = [&](double a, double b) { return std::minmax({side * a, side * b}); };
    const auto [from, to] = ends(kSide_m, kHalf_m);
    slab(from, to, -0.2, kTop_m);
    const auto [walk_from, walk_to] = ends(kPaved_m + 0.01, kSide_m);
    slab(walk_from, walk_to, -0.2, kKerb_m - 0.005);
    const auto at = [&](double x, const dvec2& yz) { return dvec3(x, side * yz.x, yz.y); };
    const dvec2 corner(kSide_m, kOver_m);
    const dvec3 a = at(0.05, foot), b = at(0.05, head), c = at(-kThick_m, head), d = at(-kThick_m, foot);
    if (side > 0.0) {
      pen.triangle(Material::kConcrete, a, at(0.05, corner), b);
      pen.quad(Material::kConcrete, a, b, c, d);
    } else {
      pen.triangle(Material::kConcrete, b, at(0.05, corner), a);
      pen.quad(Material::kConcrete, d, c, b, a);
    }
  }
  pen.box(Material::kConcrete, {-kThick_m - 0.2, -kHalf_m - 0.2, kTop_m}, {0.35, kHalf_m + 0.2, kTop_m + 0.4});
  // The hill above and beside it, and wing walls that hold it back.
  constexpr double kWide_m = 70.0, kBack_m = 25.0, kCrest_m = 15.0;
  pen.quad(Material::kGrass, {0, -kHalf_m, kTop_m}, {0, kHalf_m, kTop_m}, {-kBack_m, kHalf_m, kCrest_m},
           {-kBack_m, -kHalf_m, kCrest_m});
  for (const double side : {-1.0, 1.0}) {
    const dvec3 a(0, side * kHalf_m, kTop_m), b(0.0, side * kWide_m, kTop_m + 3.0),
        c(-kBack_m, side * kWide_m, kCrest_m), d(-kBack_m, side * kHalf_m, kCrest_m), low(6.0, side * kHalf_m, -0.2),
        far(6.0, side * kWide_m, 2.0), under(0.0, side * kHalf_m, -0.2);
    if (side > 0.0) {
      pen.quad(Material::kGrass, a, b, c, d);
      pen.quad(Material::kGrass, low, far, b, a);
      pen.triangle(Material::kConcrete, under, low, a);
    } else {
      pen.quad(Material::kGrass, b, a, d, c);
      pen.quad(Material::kGrass, far, low, a, b);
      pen.triangle(Material::kConcrete, low, under, a);
    }
  }
}

std::vector<MadeLamp> add_lamps(Model& model, const Path& path) {
  std::vector<MadeLamp> lamps;
  int number = 0;
  for (double s = kBegin_m + 4.0; s < kEnd_m; s += kLampEvery_m) {
    Node& node = model.add(numbered_node("lamps", number++));
    for (const double t : {-kLampOffset_m, kLampOffset_m}) {
      const double z = kHigh_m - 0.2;
      Pen pen(node, path.placed(s, t, 0.0, z));
      pen.box(Material::kLampHousing, {-0.45, -0.14, 0.0}, {0.45, 0.14, 0.16});
      pen.box(Material::kTunnelGlass, {-0.42, -0.11, -0.02}, {0.42, 0.11, 0.0});
      lamps.push_back(
          {"tunnel", path.point(s, t, z - 0.04), path.heading_rad(s) + (t < 0.0 ? 0.5 : -0.5) * std::numbers::pi, 0.0});
    }
  }
  return lamps;
}

void add_things(Model& model, const Path& path) {
  int number = 0;
  for (double s = kBegin_m + 12.5; s < kEnd_m; s += 25.0) {
    Node& node = model.add(numbered_node("guide", number++));
    for (const double side : {-1.0, 1.0}) {  // reflectors on the walkway's edge, escape signs on the right wall
      Pen pen(node, path.placed(s, side * (kPaved_m + 0.06), std::numbers::pi, kKerb_m));
      pen.box(Material::kDarkPlastic, {-0.05, -0.05, 0.0}, {0.0, 0.05, 0.1});
      const Material m = side < 0.0 ? Material::kReflectorWhite : Material::kReflectorAmber;
      pen.quad(m, {0.004, -0.045, 0.01}, {0.004, 0.045, 0.01}, {0.004, 0.045, 0.09}, {0.004, -0.045, 0.09});
    }
    if (number % 2 == 1) {
      Pen pen(node, path.placed(s, -kWall_m, 0.0, kKerb_m));
      draw_escape_sign(pen);
    }
  }
  number = 0;
  for (double s = path.begin_m() + 10.0; s < path.end_m(); s += 25.0) {
    if (s > kBegin_m - 8.0 && s < kEnd_m + 8.0) continue;
    Node& node = model.add(numbered_node("post", number++));
    for (const double side : {-1.0, 1.0}) draw_kerb_post(Pen(node, path.placed(s, side * 4.5)), side);
  }
}

}  // namespace

MadeScene make_tunnel() {
  const Path path(430.0, 60.0, {{40.0, 290.0, 420.0}});
  MadeScene scene;
  int number = 0;
  for (const auto& [begin, end] :
       {std::pair(path.begin_m(), kBegin_m), std::pair(kBegin_m, kEnd_m), std::pair(kEnd_m, path.end_m())})
    for (double s = begin; s < end - 1e-6; s += kPiece_m)
      add_piece(scene.model, path, number++, s, std::min(s + kPiece_m, end));
  add_portal(scene.model, path, kBegin_m, true);
  add_portal(scene.model, path, kEnd_m, false);
  const std::vector<MadeLamp> lamps = add_lamps(scene.model, path);
  add_things(scene.model, path);
  scene.lane_csv = path.lane_csv(-0.5 * kLane_m);
  scene.street_lamps = street_lamps_toml("The lamps of the tunnel, by phare-make-scene (tools/scene/tunnel.cpp).",
                                         {{"tunnel", "generated/scenes/tunnel_led.ies", 4000.0}}, lamps);
  return scene;
}

}  // namespace phare::scene
