// The road as the scene file has it: height and normal at a point, from the triangles that are drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// A point of the road, world frame.
struct RoadPoint {
  double z_m = 0.0;
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, of the triangle, upwards
  bool road = true;                  ///< false: open ground beside it
};

/// Triangles of the nodes whose names begin with "road" or "ground" under a grid of even cells, the crowded ones of
/// which are divided again: a narrow road in a wide country has all its triangles in few cells. Where both cover a
/// point the road counts; of several roads above one another the highest (bridges are not told apart).
class RoadSurface {
 public:
  /// Reads a glTF file (see gltf_file.h for axes and names). A file without any such triangle gives an empty surface.
  static Result<RoadSurface> read(const std::filesystem::path& gltf_file);

  /// From triangles, three corners each, world frame, in the order given. Triangles that stand upright are left out.
  struct Triangle {
    std::array<glm::dvec3, 3> corner_m;
    bool road = true;
    double friction = 1.0;  ///< of its material
  };
  static RoadSurface from_triangles(const std::vector<Triangle>& triangles);

  RoadSurface() = default;

  /// The surface above or below (x, y), nullopt beside it or for numbers that are not finite. No allocation; well below
  /// a microsecond (measured by RoadSurface.QueryTime).
  std::optional<RoadPoint> at(double x_m, double y_m) const;

  /// Its height alone: what a wheel asks for, a few dozen times a step.
  std::optional<double> height_m(double x_m, double y_m) const;

  /// Friction of the material there: its glTF `extras` may have a number "friction", 1 as the tyre was measured. 1
  /// beside the surface.
  double friction(double x_m, double y_m) const;
  bool has_friction() const { return has_friction_; }  ///< whether any material says one

  std::size_t triangle_count() const { return facets_.size(); }
  /// Whether there were triangles, all of which stand upright or have no area.
  bool all_upright() const { return facets_.empty() && left_out_ > 0; }

 private:
  // z over the triangle is a plane; (u, v) its barycentric coordinates, u = (a·d) with d = (x, y) - origin.
  struct Facet {
    double x0, y0, z0;
    double ux, uy, vx, vy;  // u = ux dx + uy dy, v = vx dx + vy dy
    double slope_x, slope_y;
    float friction;
    bool road;
  };

  // A cell of the grid: across by across parts, row by row from part `first` on.
  struct Cell {
    std::uint32_t first = 0, across = 1;
  };
  struct Found {
    const Facet* facet = nullptr;  // nullptr: beside the surface
    double z_m = 0.0;
  };
  Found find(double x_m, double y_m) const;
  static bool touches(const Facet& facet, double x_m, double y_m, double half_m);
  void divide(const std::vector<std::uint32_t>& cell_start, const std::vector<std::uint32_t>& cell_facets);

  std::size_t left_out_ = 0;  ///< triangles
  std::vector<Facet> facets_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> part_start_;  // facets of part k: part_facets_[part_start_[k] .. part_start_[k + 1])
  std::vector<std::uint32_t> part_facets_;
  double min_x_ = 0.0, min_y_ = 0.0, cells_pm_ = 1.0;
  std::int64_t columns_ = 0, rows_ = 0;
  bool has_friction_ = false;
};

/// Why a car at (x, y) stands on none of it, for a person to read; empty: it does.
std::string no_ground_below(const RoadSurface& surface, double x_m, double y_m);

}  // namespace phare
