// Kerb posts after HLB/RPS (1 m, black slanted band, reflectors), W-beam guard rails, signs after the German StVO.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>

#include "tools/scene/lane_files.h"
#include "tools/scene/lettering.h"
#include "tools/scene/parts.h"

namespace phare::scene {

namespace {

using glm::dvec3;

std::string numbered(const char* kind, int i) {
  char name[48];
  std::snprintf(name, sizeof name, "%s_%03d", kind, i);
  return name;
}

/// x of the post looks along the road; `outer` is +1 where the road's outside is to the left.
void draw_post(const Pen& post_pen, double outer) {
  Pen pen = post_pen;
  const double w = 0.06, d = 0.045;
  // Shaft and slanted top: the side towards the road is the lower one.
  const double high_left = outer > 0.0 ? 1.02 : 0.97, high_right = outer > 0.0 ? 0.97 : 1.02;
  const auto slab = [&](Material m, double z0_left, double z0_right, double z1_left, double z1_right, double grow) {
    const double x = d + grow, y = w + grow;
    pen.block(m, {{{-x, -y, z0_right},
                   {x, -y, z0_right},
                   {x, y, z0_left},
                   {-x, y, z0_left},
                   {-x, -y, z1_right},
                   {x, -y, z1_right},
                   {x, y, z1_left},
                   {-x, y, z1_left}}});
  };
  slab(Material::kPostWhite, -0.3, -0.3, high_left, high_right, 0.0);
  const double tilt = outer > 0.0 ? 0.04 : -0.04;
  slab(Material::kPostBlack, 0.68 + tilt, 0.68 - tilt, 0.91 + tilt, 0.91 - tilt, 0.003);
  // Reflectors on both faces: who drives on the right sees one white bar on the right, two amber eyes on the left.
  for (const double face : {-1.0, 1.0}) {
    const double x = face * (d + 0.008);
    const bool right_hand = (outer < 0.0) == (face < 0.0);  // face -1 looks at a driver who goes along s
    const auto bar = [&](Material m, double z0, double z1, double half) {
      if (face < 0.0) {
        pen.quad(m, {x, half, z0}, {x, -half, z0}, {x, -half, z1}, {x, half, z1});
      } else {
        pen.quad(m, {x, -half, z0}, {x, half, z0}, {x, half, z1}, {x, -half, z1});
      }
    };
    if (right_hand) {
      bar(Material::kReflectorWhite, 0.71, 0.88, 0.024);
    } else {
      bar(Material::kReflectorAmber, 0.72, 0.77, 0.026);
      bar(Material::kReflectorAmber, 0.82, 0.87, 0.026);
    }
  }
}

void add_posts(Model& model, const Alignment& road) {
  int number = 0;
  double s = -50.0;
  while (s <= kLength_m + 50.0) {
    Node& node = model.add(numbered("post", number++));  // the pair of one station
    for (const double side : {-1.0, 1.0}) {
      const bool railed = side < 0.0 ? (s >= kRailDipBegin_m - 2.0 && s <= kRailDipEnd_m + 2.0)
                                     : (s >= kRailBendBegin_m - 2.0 && s <= kRailBendEnd_m + 2.0);
      if (railed) continue;  // the rail has its own reflectors
      draw_post(Pen(node, placed(road, s, side * 4.4)), side);
    }
    const bool bend = std::abs(curvature_1pm(s)) > 1e-4 || std::abs(curvature_1pm(s + 25.0)) > 1e-4;
    s += bend ? 25.0 : 50.0;
  }
}

/// W profile: depth towards the road, height; m. 310 mm high and 80 mm deep as ASTM A-profile and EN 1317 systems have
/// it.
constexpr std::array<std::array<double, 2>, 10> kRailProfile{{{0.0, 0.44},
                                                              {0.02, 0.455},
                                                              {0.08, 0.50},
                                                              {0.08, 0.535},
                                                              {0.015, 0.58},
                                                              {0.015, 0.61},
                                                              {0.08, 0.655},
                                                              {0.08, 0.69},
                                                              {0.02, 0.735},
                                                              {0.0, 0.75}}};

void add_rail(Model& model, const Alignment& road, double begin, double end, double side, int& number) {
  constexpr double kOffset_m = 4.45, kPost_m = 4.0, kPiece_m = 40.0, kEndSlope_m = 8.0;
  // Each end goes down into the ground.
  const auto sunk = [&](double s) { return std::clamp(std::min(s - begin, end - s) / kEndSlope_m, 0.0, 1.0); };
  const auto at = [&](double s, std::size_t i) {
    dvec3 p = road.point(s, side * (kOffset_m - kRailProfile[i][0]));
    p.z = road.height_m(s, side * kOffset_m) + kRailProfile[i][1] - 0.75 * (1.0 - sunk(s));
    return p;
  };
  const double heading_back = std::numbers::pi;
  for (double piece = begin; piece < end - 1e-6; piece += kPiece_m) {
    Node& node = model.add(numbered("rail", number++));
    Pen pen(node, glm::dmat4(1.0));
    for (double s = piece; s < std::min(piece + kPiece_m, end) - 1e-6; s += kPost_m) {
      for (std::size_t i = 0; i + 1 < kRailProfile.size(); ++i) {
        const dvec3 a = at(s, i), b = at(s + kPost_m, i), c = at(s + kPost_m, i + 1), d = at(s, i + 1);
        if (side > 0.0) {
          pen.quad(Material::kSteel, b, a, d, c);
        } else {
          pen.quad(Material::kSteel, a, b, c, d);
        }
      }
      Pen post(node, placed(road, s, side * (kOffset_m + 0.06)));
      post.box(Material::kSteel, {-0.05, -0.03, -0.4}, {0.05, 0.03, 0.70 * sunk(s) - 0.02});
      if (std::fmod(s - begin, 12.0) < 1e-6 && sunk(s) > 0.99) {
        Pen eye(node, placed(road, s, side * (kOffset_m - 0.06), side > 0.0 ? heading_back : heading_back));
        eye.box(Material::kDarkPlastic, {-0.02, -0.03, 0.57}, {0.0, 0.03, 0.63});
        const Material m = side > 0.0 ? Material::kReflectorAmber : Material::kReflectorWhite;
        eye.quad(m, {0.005, -0.026, 0.574}, {0.005, 0.026, 0.574}, {0.005, 0.026, 0.626}, {0.005, -0.026, 0.626});
      }
    }
  }
}

/// A sign's face in its own plane: u to the right as the driver sees it, v up from the plate's middle.
class Plate {
 public:
  Plate(Node& node, const glm::dmat4& frame, double height_m) : pen_(node, frame), height_m_(height_m) {}

  void polygon(Material m, std::vector<std::array<double, 2>> uv, double layer) {
    std::vector<dvec3> points;
    for (const auto& [u, v] : uv) points.push_back({0.02 + 0.004 * layer, u, height_m_ + v});
    pen_.polygon(m, points);
  }
  void stroke(Material m, std::array<double, 2> a, std::array<double, 2> b, double width, double layer) {
    const double du = b[0] - a[0], dv = b[1] - a[1], scale = 0.5 * width / std::hypot(du, dv);
    const double nu = -dv * scale, nv = du * scale;
    polygon(m, {{a[0] - nu, a[1] - nv}, {b[0] - nu, b[1] - nv}, {b[0] + nu, b[1] + nv}, {a[0] + nu, a[1] + nv}}, layer);
  }
  /// Everything between two outlines of equal count.
  void ring(Material m, const std::vector<std::array<double, 2>>& outer,
            const std::vector<std::array<double, 2>>& inner) {
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const std::size_t k = (i + 1) % outer.size();
      polygon(m, {outer[i], outer[k], inner[k], inner[i]}, 0.0);
    }
  }
  void back(const std::vector<std::array<double, 2>>& outline) {
    std::vector<dvec3> points;
    for (auto it = outline.rbegin(); it != outline.rend(); ++it)
      points.push_back({0.014, (*it)[0], height_m_ + (*it)[1]});
    pen_.polygon(Material::kSignBack, points);
  }
  void mast(double u, double top) { pen_.cone(Material::kSteel, {-0.04, u, -0.4}, 0.035, {-0.04, u, top}, 0.035, 8); }

 private:
  Pen pen_;
  double height_m_;
};

/// The frame's x looks back at the driver, so y is to his right.
glm::dmat4 facing_driver(const Alignment& road, double s, double t) {
  return placed(road, s, t, std::numbers::pi + (t > 0.0 ? 0.06 : -0.06));
}

using Outline = std::vector<std::array<double, 2>>;

Outline regular(int corners, double radius, double turn_rad) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double a = turn_rad + 2.0 * std::numbers::pi * i / corners;
    outline.push_back({radius * std::cos(a), radius * std::sin(a)});
  }
  return outline;
}

/// Digit height 0.3 m by strokes on a 2 × 4 grid.
void draw_digit(Plate& plate, char digit, double u0) {
  const double w = 0.07, h = 0.13, thick = 0.042;
  const std::array<double, 2> tl{u0 - w, h}, tr{u0 + w, h}, ml{u0 - w, 0.0}, mr{u0 + w, 0.0}, bl{u0 - w, -h},
      br{u0 + w, -h};
  const auto line = [&](std::array<double, 2> a, std::array<double, 2> b) {
    plate.stroke(Material::kSheetBlack, a, b, thick, 1.0);
  };
  switch (digit) {
    case '7':
      line({tl[0] - 0.02, tl[1]}, {tr[0] + 0.02, tr[1]}), line(tr, {u0 - 0.03, -h - 0.02});
      break;
    case '0':
      line(tl, tr), line(bl, br), line({tl[0], h + 0.02}, {bl[0], -h - 0.02}),
          line({tr[0], h + 0.02}, {br[0], -h - 0.02});
      break;
    case '5':
      line(tl, tr), line({tl[0], h + 0.02}, ml), line(ml, mr), line(mr, br), line({br[0] + 0.02, -h}, bl);
      break;
    default:
      line(ml, mr);
      break;
  }
}

/// StVO 274: speed limit.
void draw_limit(Node& node, const glm::dmat4& frame, const char* number) {
  Plate plate(node, frame, 2.2);
  const Outline rim = regular(28, 0.30, 0.0), inside = regular(28, 0.245, 0.0);
  plate.ring(Material::kSheetRed, rim, inside);
  plate.polygon(Material::kSheetWhite, inside, 0.0);
  plate.back(rim);
  draw_digit(plate, number[0], -0.095);
  draw_digit(plate, number[1], 0.095);
  plate.mast(0.0, 2.45);
}

/// StVO 103: bend ahead; bend +1 to the left.
void draw_warning(Node& node, const glm::dmat4& frame, double bend) {
  Plate plate(node, frame, 2.1);
  const double up = std::numbers::pi / 2.0;
  const Outline rim = regular(3, 0.52, up), inside = regular(3, 0.38, up);
  plate.ring(Material::kSheetRed, rim, inside);
  plate.polygon(Material::kSheetWhite, inside, 0.0);
  plate.back(rim);
  const auto line = [&](double u0, double v0, double u1, double v1) {
    plate.stroke(Material::kSheetBlack, {-bend * u0, v0}, {-bend * u1, v1}, 0.05, 1.0);
  };
  line(-0.06, -0.15, -0.06, 0.0), line(-0.06, -0.01, 0.05, 0.10);
  line(0.05, 0.11, 0.05, 0.03),
      line(0.05, 0.10, -0.03, 0.10);  // arrow head; u is mirrored so that it points into the bend
  plate.mast(0.0, 2.3);
}

/// StVO 625: chevron board; points to the right as seen, for a right-hand bend.
void draw_chevron(Node& node, const glm::dmat4& frame, double bend) {
  Plate plate(node, frame, 1.15);
  const double h = 0.25;
  plate.back({{-h, -h}, {h, -h}, {h, h}, {-h, h}});
  // Six bands, each bent at half height; clipped by hand to the board: band i covers u + |v| in one sixth of 2h.
  constexpr int kBands = 4;
  const double step = 2.0 * h / kBands;
  for (int i = -2; i < kBands; ++i) {
    const Material m = (i + 4) % 2 == 0 ? Material::kSheetRed : Material::kSheetWhite;
    const double a = -h + step * i + h, b = a + step;  // u of the tip's back and front at v = 0, less |v| elsewhere
    for (const double half : {-1.0, 1.0}) {
      // Quadrilateral (a,0) (b,0) (b-h,h) (a-h,h), clipped at u = ±h by Sutherland and Hodgman.
      Outline shape{{a, 0.0}, {b, 0.0}, {b - h, h}, {a - h, h}};
      for (const double edge : {-1.0, 1.0}) {
        Outline kept;
        for (std::size_t k = 0; k < shape.size(); ++k) {
          const auto p = shape[k], q = shape[(k + 1) % shape.size()];
          const double dp = h - edge * p[0], dq = h - edge * q[0];
          if (dp >= 0.0) kept.push_back(p);
          if ((dp >= 0.0) != (dq >= 0.0)) {
            const double w = dp / (dp - dq);
            kept.push_back({p[0] + w * (q[0] - p[0]), p[1] + w * (q[1] - p[1])});
          }
        }
        shape = kept;
      }
      if (shape.size() < 3) continue;
      for (auto& p : shape) p = {-bend * p[0], half * p[1]};
      if (half * -bend < 0.0) std::reverse(shape.begin(), shape.end());
      plate.polygon(m, shape, 0.0);
    }
  }
  plate.mast(0.0, 1.4);
}

/// StVO 310: yellow board at a village's edge.
void draw_village(Node& node, const glm::dmat4& frame) {
  Plate plate(node, frame, 1.9);
  const Outline rim{{-0.55, -0.36}, {0.55, -0.36}, {0.55, 0.36}, {-0.55, 0.36}};
  const Outline inside{{-0.52, -0.33}, {0.52, -0.33}, {0.52, 0.33}, {-0.52, 0.33}};
  plate.ring(Material::kSheetBlack, rim, inside);
  plate.polygon(Material::kSheetYellow, inside, 0.0);
  plate.back(rim);
  // 0.18 m high; the line below stands for the district.
  double u = -0.40;
  for (const char letter : std::string_view("PHARE")) {
    for (const LetterStroke& l : strokes_of(letter))
      plate.stroke(Material::kSheetBlack, {u + 0.10 * l[0], 0.02 + 0.18 * l[1]}, {u + 0.10 * l[2], 0.02 + 0.18 * l[3]},
                   0.026, 1.0);
    u += 0.17;
  }
  plate.stroke(Material::kSheetBlack, {-0.3, -0.16}, {0.3, -0.16}, 0.05, 1.0);
  plate.mast(-0.42, 2.2);
  plate.mast(0.42, 2.2);
}

}  // namespace

void draw_kerb_post(Pen pen, double outer) {
  draw_post(pen, outer);
}

void add_furniture(Model& model, const Alignment& road) {
  add_posts(model, road);

  int rails = 0;
  add_rail(model, road, kRailDipBegin_m, kRailDipEnd_m, -1.0, rails);
  add_rail(model, road, kRailBendBegin_m, kRailBendEnd_m, 1.0, rails);

  int signs = 0;
  const auto sign = [&]() -> Node& { return model.add(numbered("sign", signs++)); };
  draw_village(sign(), facing_driver(road, 60.0, -5.6));
  draw_limit(sign(), facing_driver(road, 130.0, -5.0), "70");
  draw_warning(sign(), facing_driver(road, 205.0, -5.0), 1.0);
  draw_limit(sign(), facing_driver(road, 620.0, -5.0), "70");
  draw_warning(sign(), facing_driver(road, 1150.0, -5.0), -1.0);
  draw_limit(sign(), facing_driver(road, 1185.0, -5.0), "50");
  for (double s = 1270.0; s <= 1450.0; s += 20.0) draw_chevron(sign(), facing_driver(road, s, 5.4), -1.0);
}

}  // namespace phare::scene
