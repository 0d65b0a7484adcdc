// Two pedestrians and a cyclist. Proportions after an adult of 1.75 m (Drillis and Contini 1966: segment lengths by
// stature).
#include <array>
#include <cmath>
#include <numbers>

#include "tools/scene/lane_files.h"
#include "tools/scene/parts.h"

namespace phare::scene {

namespace {

using glm::dvec3;

void limb(Pen& pen, Material m, dvec3 a, double radius_a, dvec3 b, double radius_b) {
  pen.cone(m, a, radius_a, b, radius_b, 9, false);
  pen.ellipsoid(m, a, dvec3(radius_a), 4, 9);
  pen.ellipsoid(m, b, dvec3(radius_b), 4, 9);
}

void shoe(Pen& pen, dvec3 ankle, double pitch) {
  const dvec3 ahead(std::cos(pitch), 0.0, -std::sin(pitch));
  limb(pen, Material::kDarkPlastic, ankle - dvec3(0.02, 0.0, 0.035), 0.045, ankle + 0.14 * ahead - dvec3(0, 0, 0.045),
       0.035);
}

void head(Pen& pen, dvec3 centre) {
  pen.cone(Material::kSkin, centre - dvec3(0.01, 0, 0.20), 0.055, centre - dvec3(0, 0, 0.06), 0.05, 8, false);
  pen.ellipsoid(Material::kSkin, centre, {0.095, 0.075, 0.12}, 8, 12);
  pen.ellipsoid(Material::kSkin, centre + dvec3(0.095, 0, -0.015), {0.02, 0.014, 0.022}, 4, 6);
  pen.ellipsoid(Material::kHair, centre + dvec3(-0.018, 0.0, 0.032), {0.098, 0.083, 0.11}, 7, 12);
}

/// Torso as a skin over five level sections between hips and neck; `lean` is the way from hips to neck.
void torso(Pen& pen, Material m, dvec3 hips, dvec3 lean, double coat) {
  struct Section {
    double along, half_width, half_depth;
  };
  const std::array<Section, 7> sections{{{-coat, 0.185, 0.135},
                                         {0.0, 0.165, 0.115},
                                         {0.25, 0.145, 0.10},
                                         {0.55, 0.165, 0.115},
                                         {0.82, 0.185, 0.105},
                                         {0.94, 0.13, 0.08},
                                         {1.0, 0.06, 0.055}}};
  const dvec3 left(0, 1, 0), ahead = glm::normalize(glm::cross(left, lean));
  std::vector<std::vector<dvec3>> rings;
  for (const Section& s : sections) {
    std::vector<dvec3> ring;
    for (int i = 0; i < 12; ++i) {
      const double a = 2.0 * std::numbers::pi * i / 12.0;
      ring.push_back(hips + s.along * lean + s.half_depth * std::cos(a) * ahead + s.half_width * std::sin(a) * left);
    }
    rings.push_back(ring);
  }
  pen.loft(m, rings);
}

}  // namespace

void draw_walker(Pen pen, const Clothes& clothes, double stride, bool coat, bool bag) {
  const dvec3 hips(0.0, 0.0, 0.93);
  for (const double side : {-1.0, 1.0}) {
    const double ahead = 0.5 * stride * side;
    const double lift = ahead < 0.0 ? 0.06 : 0.0;  // the heel behind is up
    const dvec3 hip = hips + dvec3(0.0, side * 0.09, 0.0), ankle(ahead, side * 0.095, 0.09 + lift);
    const dvec3 knee = 0.5 * (hip + ankle) + dvec3(0.05 + 0.06 * (ahead < 0.0 ? 1.0 : 0.4), 0.0, 0.01);
    limb(pen, clothes.legs, hip, 0.09, knee, 0.065);
    limb(pen, clothes.legs, knee, 0.063, ankle, 0.048);
    shoe(pen, ankle, ahead < 0.0 ? 0.5 : 0.0);

    const dvec3 shoulder = hips + dvec3(0.0, side * 0.19, 0.47);
    const double swing = -0.45 * ahead;
    const dvec3 elbow = shoulder + dvec3(swing - 0.03, side * 0.055, -0.29);
    const dvec3 hand = elbow + dvec3(0.09 + 0.6 * swing, -side * 0.01, -0.24);
    limb(pen, clothes.sleeves, shoulder, 0.062, elbow, 0.047);
    limb(pen, clothes.sleeves, elbow, 0.045, hand, 0.036);
    pen.ellipsoid(Material::kSkin, hand + dvec3(0.02, 0.0, -0.05), {0.035, 0.025, 0.06}, 5, 7);
    if (bag && side > 0.0)
      pen.box(Material::kClothRed, hand + dvec3(-0.14, -0.05, -0.42), hand + dvec3(0.18, 0.05, -0.10));
  }
  torso(pen, clothes.torso, hips, {0.02, 0.0, 0.58}, coat ? 0.62 : 0.10);
  head(pen, hips + dvec3(0.03, 0.0, 0.70));
}

/// x forward, the rear wheel's contact at the origin.
void draw_cyclist(Pen pen) {
  constexpr double kWheel = 0.335, kBase = 1.05;
  const dvec3 rear(0, 0, kWheel), front(kBase, 0, kWheel), crank(0.43, 0, 0.29), seat(0.27, 0, 0.88),
      stem(0.86, 0, 0.86), fork(0.90, 0, 0.72);
  for (const dvec3 hub : {rear, front}) {
    pen.torus(Material::kRubber, hub, kWheel - 0.018, 0.018, 24, 5);
    pen.torus(Material::kChrome, hub, kWheel - 0.045, 0.008, 24, 4);
    pen.cone(Material::kChrome, hub - dvec3(0, 0.05, 0), 0.022, hub + dvec3(0, 0.05, 0), 0.022, 7);
    for (int i = 0; i < 9; ++i) {
      const double a = 2.0 * std::numbers::pi * i / 9.0;
      pen.cone(Material::kChrome, hub, 0.0035, hub + (kWheel - 0.05) * dvec3(std::cos(a), 0, std::sin(a)), 0.0035, 3,
               false);
    }
  }
  const auto tube = [&](dvec3 a, dvec3 b, double r) { pen.cone(Material::kClothRed, a, r, b, r, 7); };
  tube(crank, seat - dvec3(0, 0, 0.08), 0.017), tube(crank, fork, 0.019),
      tube(seat - dvec3(0.0, 0, 0.12), stem - dvec3(0, 0, 0.06), 0.017);
  for (const double y : {-0.05, 0.05}) {
    tube(rear + dvec3(0, y, 0), crank, 0.010), tube(rear + dvec3(0, y, 0), seat - dvec3(0, 0, 0.12), 0.009);
    tube(front + dvec3(0, y, 0), fork, 0.012);
  }
  tube(fork, stem, 0.018);
  pen.cone(Material::kDarkPlastic, stem + dvec3(0.03, -0.29, 0.05), 0.014, stem + dvec3(0.03, 0.29, 0.05), 0.014, 6);
  pen.ellipsoid(Material::kDarkPlastic, seat, {0.14, 0.07, 0.035}, 5, 9);
  pen.box(Material::kDarkPlastic, {-0.28, -0.03, kWheel + 0.345}, {0.20, 0.03, kWheel + 0.36});  // mudguard and carrier
  // Red rear reflector, broad as German ones are, and amber ones in the pedals.
  pen.box(Material::kDarkPlastic, {-0.30, -0.055, 0.60}, {-0.275, 0.055, 0.69});
  pen.quad(Material::kReflectorRed, {-0.304, 0.05, 0.605}, {-0.304, -0.05, 0.605}, {-0.304, -0.05, 0.685},
           {-0.304, 0.05, 0.685});

  const dvec3 hips = seat + dvec3(0.0, 0.0, 0.09), neck = hips + dvec3(0.36, 0.0, 0.46);
  for (const double side : {-1.0, 1.0}) {
    const dvec3 pedal = crank + dvec3(0.12 * side, side * 0.13, -0.12 * side);
    pen.box(Material::kDarkPlastic, pedal + dvec3(-0.05, -0.04, -0.015), pedal + dvec3(0.05, 0.04, 0.015));
    pen.quad(Material::kReflectorAmber, pedal + dvec3(-0.053, 0.035, -0.012), pedal + dvec3(-0.053, -0.035, -0.012),
             pedal + dvec3(-0.053, -0.035, 0.012), pedal + dvec3(-0.053, 0.035, 0.012));
    pen.cone(Material::kChrome, crank + dvec3(0, 0.08 * side, 0), 0.012, pedal, 0.012, 5);
    const dvec3 ankle = pedal + dvec3(-0.03, -0.01 * side, 0.10), hip = hips + dvec3(0.0, side * 0.09, 0.0);
    const dvec3 middle = 0.5 * (hip + ankle), along = glm::normalize(ankle - hip);
    const double half = 0.5 * glm::length(ankle - hip), bend = std::sqrt(std::max(0.0, 0.43 * 0.43 - half * half));
    const dvec3 knee = middle + bend * glm::normalize(glm::cross(along, dvec3(0, -1, 0)));
    limb(pen, Material::kClothDark, hip, 0.09, knee, 0.065);
    limb(pen, Material::kClothDark, knee, 0.06, ankle, 0.045);
    shoe(pen, ankle, 0.1);
    const dvec3 shoulder = neck + dvec3(-0.04, side * 0.18, -0.07), grip = stem + dvec3(0.03, side * 0.27, 0.07);
    const dvec3 elbow = 0.5 * (shoulder + grip) + dvec3(-0.03, side * 0.05, -0.06);
    limb(pen, Material::kClothBlue, shoulder, 0.06, elbow, 0.046);
    limb(pen, Material::kClothBlue, elbow, 0.044, grip, 0.036);
  }
  torso(pen, Material::kClothBlue, hips, neck - hips, 0.08);
  const dvec3 crown = neck + dvec3(0.10, 0.0, 0.13);
  head(pen, crown);
  pen.ellipsoid(Material::kClothLight, crown + dvec3(-0.01, 0.0, 0.055), {0.135, 0.10, 0.10}, 6, 12);  // helmet
}


void add_people(Model& model, const Alignment& road) {
  const double across = std::numbers::pi / 2.0;
  draw_walker(Pen(model.add("pedestrian_1"), placed(road, kPedestrian1_m, -4.6, 0.12)),
              {Material::kClothDark, Material::kClothDark, Material::kClothDark}, 0.42, true, false);
  draw_walker(Pen(model.add("pedestrian_2"), placed(road, kPedestrian2_m, -4.1, across - 0.15)),
              {Material::kClothBlue, Material::kClothLight, Material::kClothLight}, 0.62, false, true);
  draw_cyclist(Pen(model.add("cyclist"), placed(road, kCyclist_m, -3.55)));
}

}  // namespace phare::scene
