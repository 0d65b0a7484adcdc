// The road as the scene file has it: height and normal at a point, from the triangles that are drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "config/result.h"

namespace phare {

/// A point of the road, world frame.
struct RoadPoint {
  double z_m = 0.0;
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, of the triangle, upwards
  bool road = true;                  ///< false: open ground beside it
};

/// Triangles of the nodes whose names begin with "road" or "ground" under a uniform grid. Where both cover a point the
/// road counts; of several roads above one another the highest (bridges are not told apart).
class RoadSurface {
 public:
  /// Reads a glTF file (see gltf_file.h for axes and names). A file without any such triangle gives an empty surface.
  static Result<RoadSurface> read(const std::filesystem::path& gltf_file);

  /// From triangles, three corners each, world frame, in the order given. Triangles that stand upright are left out.
  struct Triangle {
    std::array<glm::dvec3, 3> corner_m;
    bool road = true;
  };
  static RoadSurface from_triangles(const std::vector<Triangle>& triangles);

  RoadSurface() = default;

  /// The surface above or below (x, y), nullopt beside it or for numbers that are not finite. No allocation; well below
  /// a microsecond (measured by RoadSurface.QueryTime).
  std::optional<RoadPoint> at(double x_m, double y_m) const;

  std::size_t triangle_count() const { return facets_.size(); }

 private:
  // z over the triangle is a plane; (u, v) its barycentric coordinates, u = (a·d) with d = (x, y) - origin.
  struct Facet {
    double x0, y0, z0;
    double ux, uy, vx, vy;  // u = ux dx + uy dy, v = vx dx + vy dy
    double slope_x, slope_y;
    bool road;
  };

  std::vector<Facet> facets_;
  std::vector<std::uint32_t> cell_start_;  // facets of cell c: cell_facets_[cell_start_[c] .. cell_start_[c + 1])
  std::vector<std::uint32_t> cell_facets_;
  double min_x_ = 0.0, min_y_ = 0.0, cell_m_ = 1.0;
  std::int64_t columns_ = 0, rows_ = 0;
};

}  // namespace phare
