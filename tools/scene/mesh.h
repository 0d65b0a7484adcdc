// Triangles on their way into a glTF file: nodes, each with one triangle soup per material, and a pen that draws
// solids.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tools/scene/materials.h"

namespace phare::scene {

/// World frame, m, counter-clockwise seen from outside. Normals of zero length are filled in by `weld`.
struct Triangle {
  std::array<glm::dvec3, 3> corner;
  std::array<glm::dvec3, 3> normal{};
};

struct Node {
  std::string name;
  std::map<Material, std::vector<Triangle>> parts;
};

/// Nodes keep their addresses while others are added.
struct Model {
  std::deque<Node> nodes;
  Node& add(std::string name) { return nodes.emplace_back(Node{std::move(name), {}}); }
};

struct Vertex {
  glm::dvec3 position, normal;
};
struct IndexedMesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Corners go to the grid of places (config/base/conventions.h), and equal ones are joined. Missing normals become the
/// area-weighted mean of the faces around a corner that turn by less than crease_deg: round where round, hard where
/// hard. Triangles without area are left out.
IndexedMesh weld(std::span<const Triangle> triangles, double crease_deg = 42.0);

/// Same numbers everywhere for one seed (splitmix64, Steele et al. 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double uniform(double low, double high);

 private:
  std::uint64_t state_;
};

/// Draws solids in an object's frame: x forward, y left, z up, m; `world_from_object` sets them down.
class Pen {
 public:
  Pen(Node& node, const glm::dmat4& world_from_object) : node_(&node), world_from_object_(world_from_object) {}

  void triangle(Material m, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);
  void quad(Material m, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d);
  /// With normals given at the corners; for leaves, lit as the crown they belong to.
  void triangle(Material m, const Triangle& object_triangle);
  void polygon(Material m, std::span<const glm::dvec3> convex);
  void box(Material m, glm::dvec3 low, glm::dvec3 high);
  /// Six faces; corners 0–3 around the bottom, 4–7 above them.
  void block(Material m, const std::array<glm::dvec3, 8>& corners);
  void cone(Material m, glm::dvec3 a, double radius_a, glm::dvec3 b, double radius_b, int sides, bool caps = true);
  void ellipsoid(Material m, glm::dvec3 centre, glm::dvec3 radii, int rings, int sides);
  /// A ring in the x-z plane, as a tyre of a bicycle.
  void torus(Material m, glm::dvec3 centre, double radius, double tube, int segments, int sides);
  /// Skin over cross-sections of equal point count, each closed; ends covered by fans.
  void loft(Material m, const std::vector<std::vector<glm::dvec3>>& rings, bool caps = true);

  Pen moved(const glm::dmat4& object_from_part) const { return {*node_, world_from_object_ * object_from_part}; }
  Node& node() const { return *node_; }

 private:
  /// A face of a solid that can be seen whole from `inside`: turned to look away from it.
  void outward(Material m, glm::dvec3 inside, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

  Node* node_;
  glm::dmat4 world_from_object_;
};

}  // namespace phare::scene
