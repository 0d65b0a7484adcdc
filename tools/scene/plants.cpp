// Trees and bushes. A crown is a few dark lumps inside a shell of ragged leaf clumps, so its outline against the sky is
// that of a tree; the clumps' normals look away from the crown's middle, so that headlamps model it as one round thing.
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numbers>

#include "tools/scene/lane_files.h"
#include "tools/scene/parts.h"

namespace phare::scene {

namespace {

using glm::dvec3;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// Even over the sphere.
dvec3 direction(Random& random) {
  const double z = random.uniform(-1.0, 1.0), a = random.uniform(0.0, kTurn), r = std::sqrt(1.0 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

constexpr int kLeavesOfTreeClump = 8, kLeavesOfBushClump = 5;

/// One clump: leaves over an irregular patch about a point of the crown, lit as the crown's surface there.
void draw_clump(Pen& pen, Material m, Random& random, dvec3 at, dvec3 normal, double size, int leaves) {
  // Partly in the crown's surface, partly standing out of it.
  const dvec3 u = glm::normalize(glm::cross(normal, direction(random) + 0.1 * normal));
  const dvec3 v = glm::normalize(glm::cross(normal, u) + random.uniform(-0.2, 0.9) * normal);
  const auto corner = [&](double a, double b) {
    return at + size * (a * random.uniform(0.7, 1.3) * u + b * random.uniform(0.7, 1.3) * v);
  };
  const dvec3 a = corner(-0.8, -0.3), b = corner(0.3, -0.8), c = corner(0.8, 0.4), d = corner(-0.2, 0.9);
  Random strewn = random;  // so that where trees stand depends on no leaf
  for (int i = 0; i < leaves; ++i) {
    const double s = strewn.uniform(-0.35, 1.35), t = strewn.uniform(-0.35, 1.35), turn = strewn.uniform(0.0, kTurn);
    const dvec3 stalk = (1 - s) * ((1 - t) * a + t * d) + s * ((1 - t) * b + t * c) +
                        strewn.uniform(-0.4, 0.3) * size * glm::cross(u, v);
    const dvec3 along = glm::normalize(std::cos(turn) * u + std::sin(turn) * v + strewn.uniform(-0.5, 0.5) * normal);
    const dvec3 across = glm::normalize(glm::cross(along, direction(strewn) + 0.1 * normal));
    const double length = strewn.uniform(0.5, 0.95) * size, width = strewn.uniform(0.5, 0.8) * length;
    const dvec3 widest = stalk + strewn.uniform(0.3, 0.6) * length * along + width * across;
    pen.triangle(m, Triangle{{stalk, widest, stalk + length * along}, {normal, normal, normal}});
  }
}

/// That of the lumps within a crown of these leaves.
Material within(Material leaves) {
  if (leaves == Material::kBush) return Material::kBushWithin;
  return leaves == Material::kLeavesAutumn ? Material::kLeavesAutumnWithin : Material::kLeavesWithin;
}

/// A lump with a bumpy surface, closed: an icosahedron, each corner moved.
void draw_lump(Pen& pen, Material m, Random& random, dvec3 centre, dvec3 radii) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<dvec3> corners;
  for (const double i : {-1.0, 1.0}) {
    for (const double k : {-g, g}) {
      corners.push_back({0.0, i, k});
      corners.push_back({i, k, 0.0});
      corners.push_back({k, 0.0, i});
    }
  }
  std::vector<dvec3> unit;
  for (dvec3& c : corners) {
    unit.push_back(glm::normalize(c));
    c = centre + radii * unit.back() * random.uniform(0.4, 1.5);
  }
  // Faces are the triples of corners at the icosahedron's edge length, 2 before normalizing.
  const double edge = 2.0 / std::sqrt(1.0 + g * g);
  const auto joined = [&](std::size_t i, std::size_t k) {
    return std::abs(glm::length(unit[i] - unit[k]) - edge) < 1e-6;
  };
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t k = i + 1; k < 12; ++k) {
      for (std::size_t l = k + 1; l < 12; ++l) {
        if (!joined(i, k) || !joined(k, l) || !joined(i, l)) continue;
        const bool turned = glm::dot(glm::cross(unit[k] - unit[i], unit[l] - unit[i]), unit[i]) < 0.0;
        const std::size_t b = turned ? l : k, c = turned ? k : l;
        pen.triangle(m, Triangle{{corners[i], corners[b], corners[c]}, {unit[i], unit[b], unit[c]}});
      }
    }
  }
}

void draw_broadleaf(Pen pen, Random& random, double height, Material leaves) {
  const double trunk = random.uniform(0.25, 0.34) * height, girth = 0.022 * height;
  const dvec3 lean(random.uniform(-0.04, 0.04) * height, random.uniform(-0.04, 0.04) * height, 0.0);
  const dvec3 fork = dvec3(0.0, 0.0, trunk) + lean;
  pen.cone(Material::kBark, {0.0, 0.0, -0.5}, 1.25 * girth, fork, 0.8 * girth, 6, false);

  const int limbs = 3;
  struct Lobe {
    dvec3 centre, radii;
  };
  std::vector<Lobe> lobes{{{lean.x, lean.y, 0.74 * height}, dvec3(0.24, 0.24, 0.22) * height}};
  const double phase = random.uniform(0.0, kTurn);
  for (int i = 0; i < limbs; ++i) {
    const double a = phase + kTurn * i / limbs + random.uniform(-0.4, 0.4);
    const double reach = random.uniform(0.15, 0.22) * height, up = random.uniform(0.46, 0.66) * height;
    const dvec3 tip = lean + dvec3(reach * std::cos(a), reach * std::sin(a), up);
    pen.cone(Material::kBark, fork - dvec3(0, 0, 0.06 * height), 0.55 * girth, tip, 0.2 * girth, 4, false);
    const double size = random.uniform(0.15, 0.21) * height;
    lobes.push_back({tip, {size, size, 0.85 * size}});
  }
  const dvec3 heart = lean + dvec3(0.0, 0.0, 0.58 * height);
  for (const Lobe& lobe : lobes) {
    draw_lump(pen, within(leaves), random, lobe.centre, 0.52 * lobe.radii);
    for (int i = 0; i < 18; ++i) {
      const dvec3 way = direction(random);
      const dvec3 at = lobe.centre + lobe.radii * way * random.uniform(0.5, 1.1);
      draw_clump(pen, leaves, random, at, glm::normalize(0.6 * way + 0.6 * glm::normalize(at - heart)),
                 random.uniform(0.045, 0.078) * height, kLeavesOfTreeClump);
    }
  }
}

void draw_spruce(Pen pen, Random& random, double height) {
  pen.cone(Material::kBark, {0.0, 0.0, -0.5}, 0.017 * height, {0.0, 0.0, 0.97 * height}, 0.003 * height, 5, false);
  const int whorls = 9;
  for (int i = 0; i < whorls; ++i) {
    const double up = height * (0.12 + 0.82 * i / whorls), share = 1.0 - static_cast<double>(i) / whorls;
    const double reach = height * 0.21 * (0.12 + 0.88 * share);
    const int branches = i < 6 ? 7 : 5;
    const double phase = random.uniform(0.0, kTurn);
    for (int k = 0; k < branches; ++k) {
      const double a = phase + kTurn * k / branches + random.uniform(-0.25, 0.25);
      const double length = reach * random.uniform(0.7, 1.15), wide = length * random.uniform(0.34, 0.5);
      const dvec3 out(std::cos(a), std::sin(a), 0.0), side(-out.y, out.x, 0.0);
      const dvec3 root(0.0, 0.0, up + 0.05 * height * random.uniform(0.8, 1.2));
      const dvec3 tip = dvec3(0.0, 0.0, up - random.uniform(0.16, 0.34) * length) + length * out;
      const dvec3 normal = glm::normalize(out + dvec3(0.0, 0.0, 0.6)), sag(0.0, 0.0, 0.12 * length);
      const auto spine = [&](double share) { return (1.0 - share) * root + share * tip; };
      // Two twigs to each side, so that its outline is ragged.
      for (const double hand : {-wide, wide}) {
        const auto twig = [&](double from, double to, double at, double reach_share) {
          const dvec3 end = spine(at) + hand * reach_share * side - sag;
          pen.triangle(Material::kSpruce, Triangle{{spine(from), end, spine(to)}, {normal, normal, normal}});
        };
        twig(0.0, 0.6, 0.48, 1.0);
        twig(0.3, 1.0, 0.86, 0.65);
      }
    }
  }
  // The leader, three blades.
  for (int k = 0; k < 3; ++k) {
    const double a = kTurn * k / 3.0;
    const dvec3 out(std::cos(a), std::sin(a), 0.0);
    pen.triangle(Material::kSpruce, Triangle{{dvec3(0, 0, 0.84 * height),
                                              0.025 * height * out + dvec3(0, 0, 0.86 * height), dvec3(0, 0, height)},
                                             {out, out, out}});
  }
}

void draw_bush(Pen pen, Random& random, double size) {
  const dvec3 centre(0.0, 0.0, 0.42 * size);
  draw_lump(pen, within(Material::kBush), random, centre, dvec3(0.55, 0.55, 0.42) * size);
  for (int i = 0; i < 14; ++i) {
    dvec3 way = direction(random);
    way.z = std::abs(way.z);
    draw_clump(pen, Material::kBush, random, centre + dvec3(0.62, 0.62, 0.5) * size * way, way,
               random.uniform(0.16, 0.3) * size, kLeavesOfBushClump);
  }
}

/// Trees of one place share a node, so that a wood is a few draws.
class Grove {
 public:
  explicit Grove(Model& model, const Alignment& road) : model_(&model), road_(&road) {}

  Pen place(const char* kind, double s, double t, double turn) {
    const auto cell = std::make_pair(static_cast<int>(std::floor(s / 24.0)), t > 40.0    ? 2
                                                                             : t > 0.0   ? 1
                                                                             : t > -40.0 ? -1
                                                                                         : -2);
    const auto [at, fresh] = nodes_.try_emplace({kind, cell}, nullptr);
    if (fresh) {
      char name[48];
      std::snprintf(name, sizeof name, "%s_%03d", kind, numbers_[kind]++);
      at->second = &model_->add(name);
    }
    return {*at->second, placed(*road_, s, t, turn)};
  }

 private:
  Model* model_;
  const Alignment* road_;
  std::map<std::pair<std::string, std::pair<int, int>>, Node*> nodes_;
  std::map<std::string, int> numbers_;
};

}  // namespace

void draw_tree(Pen pen, Random& random, double height, Material leaves) {
  draw_broadleaf(pen, random, height, leaves);
}

void add_plants(Model& model, const Alignment& road) {
  Random random(19990928);  // any number; it fixes the wood for ever
  Grove grove(model, road);
  const auto broadleaf = [&](double s, double t, double height) {
    const Material leaves = random.uniform(0.0, 1.0) < 0.3 ? Material::kLeavesAutumn : Material::kLeaves;
    draw_broadleaf(grove.place("tree", s, t, random.uniform(0.0, kTurn)), random, height, leaves);
  };
  const auto spruce = [&](double s, double t, double height) {
    draw_spruce(grove.place("tree", s, t, random.uniform(0.0, kTurn)), random, height);
  };
  const auto bush = [&](double s, double t, double size) {
    draw_bush(grove.place("bush", s, t, random.uniform(0.0, kTurn)), random, size);
  };

  // A row of old trees along the left of the first straight.
  for (double s = 20.0; s <= 215.0; s += 24.0)
    broadleaf(s + random.uniform(-2.0, 2.0), random.uniform(8.8, 9.6), random.uniform(9.5, 12.5));
  // The wood on both sides of the last straight: close trees at its edge, others behind.
  for (double s = kWoodBegin_m; s <= kWoodEnd_m; s += 8.5) {
    for (const double side : {-1.0, 1.0}) {
      const double t = side * random.uniform(8.6, 11.5), at = s + random.uniform(-3.0, 3.0);
      random.uniform(0.0, 1.0) < 0.55 ? spruce(at, t, random.uniform(11.0, 18.0))
                                      : broadleaf(at, t, random.uniform(10.0, 15.0));
      const double behind = side * random.uniform(15.0, 24.0);
      random.uniform(0.0, 1.0) < 0.7 ? spruce(s + random.uniform(-4.0, 4.0), behind, random.uniform(14.0, 20.0))
                                     : broadleaf(s + random.uniform(-4.0, 4.0), behind, random.uniform(12.0, 16.0));
      if (random.uniform(0.0, 1.0) < 0.3)
        bush(s + random.uniform(-4.0, 4.0), side * random.uniform(7.8, 8.6), random.uniform(1.0, 1.8));
    }
  }
  // Where the road goes on beyond both ends, trees close the view.
  for (const double end : {-kMargin_m + 4.0, kLength_m + kMargin_m - 4.0}) {
    for (double t = -60.0; t <= 60.0; t += 9.0) {
      if (std::abs(t) > 6.0)
        spruce(end + random.uniform(-3.0, 3.0), t + random.uniform(-2.0, 2.0), random.uniform(12.0, 18.0));
    }
  }
  // The barn has a walnut beside it, the crest its lonely oak.
  broadleaf(486.0, -10.5, 11.0);
  broadleaf(440.0, -31.0, 12.0);
  broadleaf(798.0, 13.0, 12.5);
  // Loose trees and hedges in the fields; clear of yard, bales and the view into the bends.
  for (double s = 40.0; s < 1540.0; s += 17.0) {
    for (const double side : {-1.0, 1.0}) {
      const double at = s + random.uniform(-8.0, 8.0), t = side * random.uniform(20.0, 85.0);
      const bool yard = side < 0.0 && at > 410.0 && at < 500.0 && t > -45.0;
      const bool bales = side > 0.0 && at > 930.0 && at < 1040.0 && t < 50.0;
      const double kind = random.uniform(0.0, 1.0);
      if (yard || bales || kind < 0.42) continue;
      if (kind < 0.66)
        broadleaf(at, t, random.uniform(7.0, 12.0));
      else if (kind < 0.78)
        spruce(at, t, random.uniform(8.0, 14.0));
      else
        bush(at, t * 0.6, random.uniform(1.2, 2.4));
    }
  }
  for (double s = 1000.0; s < 1140.0; s += 4.5) bush(s, 11.5 + random.uniform(-0.6, 0.6), random.uniform(1.0, 1.9));
}

}  // namespace phare::scene
