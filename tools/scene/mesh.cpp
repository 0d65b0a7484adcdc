#include "tools/scene/mesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

#include "config/base/conventions.h"

namespace phare::scene {

namespace {

using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

/// Of a place on the grid.
Key key_of(glm::dvec3 p) {
  const glm::dvec3 steps = p / kPlaceGrid_m;
  return {std::llround(steps.x), std::llround(steps.y), std::llround(steps.z)};
}
Key key_of_normal(glm::dvec3 n) {
  return {std::llround(n.x * 1e3), std::llround(n.y * 1e3), std::llround(n.z * 1e3)};
}

glm::dvec3 area_vector(const Triangle& t) {
  return glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
}

glm::dvec3 round_point(glm::dvec3 centre, glm::dvec3 u, glm::dvec3 v, double radius, double turn_01) {
  const double a = 2.0 * std::numbers::pi * turn_01;
  return centre + radius * (std::cos(a) * u + std::sin(a) * v);
}

}  // namespace

IndexedMesh weld(std::span<const Triangle> as_drawn, double crease_deg) {
  std::vector<Triangle> triangles(as_drawn.begin(), as_drawn.end());
  for (Triangle& t : triangles)
    for (glm::dvec3& p : t.corner) p = on_place_grid(p);
  const double least_cos = std::cos(crease_deg * std::numbers::pi / 180.0);
  std::map<Key, std::vector<std::size_t>> around;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const glm::dvec3& p : triangles[i].corner) around[key_of(p)].push_back(i);
  }
  IndexedMesh mesh;
  std::map<std::pair<Key, Key>, std::uint32_t> known;
  for (const Triangle& t : triangles) {
    const glm::dvec3 area = area_vector(t);
    if (glm::length(area) < 1e-9) continue;
    const glm::dvec3 face = glm::normalize(area);
    for (std::size_t c = 0; c < 3; ++c) {
      glm::dvec3 normal = t.normal[c];
      if (glm::dot(normal, normal) < 0.25) {
        normal = glm::dvec3(0.0);
        for (const std::size_t other : around[key_of(t.corner[c])]) {
          const glm::dvec3 n = area_vector(triangles[other]);
          const double length = glm::length(n);
          if (length > 1e-9 && glm::dot(n, face) >= least_cos * length) normal += n;
        }
      }
      normal = glm::normalize(normal);
      const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
      const auto [at, fresh] = known.try_emplace({key_of(t.corner[c]), key_of_normal(normal)}, next);
      if (fresh) mesh.vertices.push_back({t.corner[c], normal});
      mesh.indices.push_back(at->second);
    }
  }
  return mesh;
}

double Random::uniform(double low, double high) {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return low + (high - low) * (static_cast<double>(z >> 11) * 0x1p-53);
}

void Pen::triangle(Material m, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  triangle(m, Triangle{{a, b, c}});
}

void Pen::triangle(Material m, const Triangle& t) {
  Triangle world;
  for (std::size_t i = 0; i < 3; ++i) {
    world.corner[i] = glm::dvec3(world_from_object_ * glm::dvec4(t.corner[i], 1.0));
    world.normal[i] = glm::dvec3(world_from_object_ * glm::dvec4(t.normal[i], 0.0));
  }
  node_->parts[m].push_back(world);
}

void Pen::quad(Material m, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
  triangle(m, a, b, c);
  triangle(m, a, c, d);
}

void Pen::polygon(Material m, std::span<const glm::dvec3> convex) {
  for (std::size_t i = 2; i < convex.size(); ++i) triangle(m, convex[0], convex[i - 1], convex[i]);
}

void Pen::outward(Material m, glm::dvec3 inside, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  if (glm::dot(normal, a + b + c - 3.0 * inside) < 0.0) std::swap(b, c);
  triangle(m, a, b, c);
}

void Pen::box(Material m, glm::dvec3 low, glm::dvec3 high) {
  block(m, {{{low.x, low.y, low.z},
             {high.x, low.y, low.z},
             {high.x, high.y, low.z},
             {low.x, high.y, low.z},
             {low.x, low.y, high.z},
             {high.x, low.y, high.z},
             {high.x, high.y, high.z},
             {low.x, high.y, high.z}}});
}

void Pen::block(Material m, const std::array<glm::dvec3, 8>& p) {
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& corner : p) middle += corner / 8.0;
  constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  for (const auto& f : faces) {
    outward(m, middle, p[f[0]], p[f[1]], p[f[2]]);
    outward(m, middle, p[f[0]], p[f[2]], p[f[3]]);
  }
}

void Pen::cone(Material m, glm::dvec3 a, double radius_a, glm::dvec3 b, double radius_b, int sides, bool caps) {
  const glm::dvec3 axis = glm::normalize(b - a);
  const glm::dvec3 u =
      glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 v = glm::cross(axis, u);
  const glm::dvec3 middle = 0.5 * (a + b);
  for (int i = 0; i < sides; ++i) {
    const double t0 = static_cast<double>(i) / sides, t1 = static_cast<double>(i + 1) / sides;
    const glm::dvec3 a0 = round_point(a, u, v, radius_a, t0), a1 = round_point(a, u, v, radius_a, t1);
    const glm::dvec3 b0 = round_point(b, u, v, radius_b, t0), b1 = round_point(b, u, v, radius_b, t1);
    outward(m, middle, a0, a1, b1);
    outward(m, middle, a0, b1, b0);
    if (caps) {
      outward(m, middle, a, a0, a1);
      outward(m, middle, b, b0, b1);
    }
  }
}

void Pen::ellipsoid(Material m, glm::dvec3 centre, glm::dvec3 radii, int rings, int sides) {
  const auto at = [&](int ring, int side) {
    const double polar = std::numbers::pi * ring / rings, turn = 2.0 * std::numbers::pi * side / sides;
    return centre +
           radii * glm::dvec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
  };
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < sides; ++k) {
      if (i > 0) outward(m, centre, at(i, k), at(i + 1, k), at(i, k + 1));
      if (i + 1 < rings) outward(m, centre, at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
    }
  }
}

void Pen::torus(Material m, glm::dvec3 centre, double radius, double tube, int segments, int sides) {
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto hub = [&](int i) { return round_point(centre, x, z, radius, static_cast<double>(i) / segments); };
  const auto at = [&](int i, int k) {
    return round_point(hub(i), glm::normalize(hub(i) - centre), y, tube, static_cast<double>(k) / sides);
  };
  for (int i = 0; i < segments; ++i) {
    for (int k = 0; k < sides; ++k) {
      const glm::dvec3 inside = 0.5 * (hub(i) + hub(i + 1));
      outward(m, inside, at(i, k), at(i + 1, k), at(i + 1, k + 1));
      outward(m, inside, at(i, k), at(i + 1, k + 1), at(i, k + 1));
    }
  }
}

void Pen::loft(Material m, const std::vector<std::vector<glm::dvec3>>& rings, bool caps) {
  std::vector<glm::dvec3> middle(rings.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < rings.size(); ++i) {
    for (const glm::dvec3& p : rings[i]) middle[i] += p / static_cast<double>(rings[i].size());
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const std::size_t n = rings[i].size();
    for (std::size_t k = 0; k < n; ++k) {
      const glm::dvec3 inside = 0.5 * (middle[i] + middle[i + 1]);
      const glm::dvec3 a = rings[i][k], b = rings[i][(k + 1) % n], c = rings[i + 1][(k + 1) % n], d = rings[i + 1][k];
      outward(m, inside, a, b, c);
      outward(m, inside, a, c, d);
    }
  }
  if (!caps || rings.size() < 2) return;
  const glm::dvec3 core = 0.5 * (middle.front() + middle.back());
  for (const std::size_t end : {std::size_t{0}, rings.size() - 1}) {
    const std::size_t n = rings[end].size();
    for (std::size_t k = 0; k < n; ++k) outward(m, core, middle[end], rings[end][k], rings[end][(k + 1) % n]);
  }
}

}  // namespace phare::scene
