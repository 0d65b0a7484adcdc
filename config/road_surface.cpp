#include "config/road_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "config/gltf_file.h"

namespace phare {
namespace {

// A point this far outside a triangle, in barycentric units, still belongs to it: neighbours must leave no crack
// between.
constexpr double kEdgeTolerance = 1e-7;
constexpr std::uint64_t kMaxCells = 4'000'000;
constexpr std::uint64_t kMaxCellEntries = 16'000'000;

}  // namespace

Result<RoadSurface> RoadSurface::read(const std::filesystem::path& gltf_file) {
  const Result<tinygltf::Model> model = read_gltf(gltf_file);
  if (!model) return model.error();
  const auto in_file = [&](const Error& error) { return Error{gltf_file.string(), error.text()}; };
  const Result<std::vector<MeshInstance>> instances = mesh_instances(*model);
  if (!instances) return in_file(instances.error());

  std::vector<Triangle> triangles;
  for (const MeshInstance& instance : *instances) {
    const bool road = instance.name.starts_with("road");
    if (!road && !instance.name.starts_with("ground")) continue;
    for (const tinygltf::Primitive& primitive : model->meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end()) continue;  // glTF allows it: nothing to stand on
      const Result<std::vector<glm::vec3>> vertices = read_vec3(*model, position->second);
      if (!vertices) return in_file(vertices.error());
      const Result<std::vector<std::uint32_t>> indices = read_triangles(*model, primitive, vertices->size());
      if (!indices) return in_file(indices.error());
      for (std::size_t i = 0; i + 2 < indices->size(); i += 3) {
        Triangle triangle{.corner_m = {}, .road = road};
        for (std::size_t corner = 0; corner < 3; ++corner)
          triangle.corner_m[corner] =
              glm::dvec3(instance.world_from_mesh * glm::dvec4((*vertices)[(*indices)[i + corner]], 1.0));
        triangles.push_back(triangle);
      }
    }
  }
  return from_triangles(triangles);
}

RoadSurface RoadSurface::from_triangles(const std::vector<Triangle>& triangles) {
  struct Box {
    double min_x, min_y, max_x, max_y;
  };
  RoadSurface surface;
  std::vector<Box> boxes;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box all{kFar, kFar, -kFar, -kFar};
  for (const Triangle& triangle : triangles) {
    const glm::dvec3 a = triangle.corner_m[0];
    const glm::dvec3 p = triangle.corner_m[1] - a, q = triangle.corner_m[2] - a;
    const double twice_area = p.x * q.y - p.y * q.x;  // seen from above
    const double longest2 = std::max(p.x * p.x + p.y * p.y + p.z * p.z, q.x * q.x + q.y * q.y + q.z * q.z);
    // Upright to a tenth of a degree or degenerate: no height of its own. The negation refuses NaN too.
    if (!(std::abs(twice_area) > 1e-6 * longest2) || !std::isfinite(twice_area)) continue;
    Facet f{};
    f.x0 = a.x, f.y0 = a.y, f.z0 = a.z;
    f.ux = q.y / twice_area, f.uy = -q.x / twice_area;
    f.vx = -p.y / twice_area, f.vy = p.x / twice_area;
    f.slope_x = p.z * f.ux + q.z * f.vx;
    f.slope_y = p.z * f.uy + q.z * f.vy;
    f.road = triangle.road;
    surface.facets_.push_back(f);
    const auto [low_x, high_x] = std::minmax({0.0, p.x, q.x});
    const auto [low_y, high_y] = std::minmax({0.0, p.y, q.y});
    const Box box{a.x + low_x, a.y + low_y, a.x + high_x, a.y + high_y};
    boxes.push_back(box);
    all = {std::min(all.min_x, box.min_x), std::min(all.min_y, box.min_y), std::max(all.max_x, box.max_x),
           std::max(all.max_y, box.max_y)};
  }
  if (boxes.empty()) return surface;

  // About one triangle a cell where they spread evenly; coarser until cells and entries fit their limits.
  const double width = all.max_x - all.min_x, depth = all.max_y - all.min_y;
  surface.min_x_ = all.min_x;
  surface.min_y_ = all.min_y;
  surface.cell_m_ = std::max({std::sqrt(width * depth / static_cast<double>(boxes.size())), 0.25,
                              std::sqrt(width * depth / static_cast<double>(kMaxCells))});
  const auto cell_of = [&surface](double value, double from, std::int64_t count) {
    return std::clamp(static_cast<std::int64_t>((value - from) / surface.cell_m_), std::int64_t{0}, count - 1);
  };
  const auto for_cells = [&](const Box& box, auto&& visit) {
    for (std::int64_t row = cell_of(box.min_y, surface.min_y_, surface.rows_);
         row <= cell_of(box.max_y, surface.min_y_, surface.rows_); ++row)
      for (std::int64_t column = cell_of(box.min_x, surface.min_x_, surface.columns_);
           column <= cell_of(box.max_x, surface.min_x_, surface.columns_); ++column)
        visit(static_cast<std::size_t>(row * surface.columns_ + column));
  };
  for (;; surface.cell_m_ *= 2.0) {
    surface.columns_ = static_cast<std::int64_t>(width / surface.cell_m_) + 1;
    surface.rows_ = static_cast<std::int64_t>(depth / surface.cell_m_) + 1;
    std::uint64_t entries = 0;
    for (const Box& box : boxes) {
      const std::int64_t columns = cell_of(box.max_x, surface.min_x_, surface.columns_) -
                                   cell_of(box.min_x, surface.min_x_, surface.columns_) + 1;
      const std::int64_t rows =
          cell_of(box.max_y, surface.min_y_, surface.rows_) - cell_of(box.min_y, surface.min_y_, surface.rows_) + 1;
      entries += static_cast<std::uint64_t>(columns * rows);
    }
    const auto cells = static_cast<std::uint64_t>(surface.columns_ * surface.rows_);
    if (cells <= kMaxCells && entries <= std::max<std::uint64_t>(kMaxCellEntries, 2 * boxes.size())) break;
    if (cells == 1) break;
  }

  // Count, add up, fill: one array for all cells.
  surface.cell_start_.assign(static_cast<std::size_t>(surface.columns_ * surface.rows_) + 1, 0);
  for (const Box& box : boxes) for_cells(box, [&](std::size_t cell) { ++surface.cell_start_[cell + 1]; });
  for (std::size_t cell = 1; cell < surface.cell_start_.size(); ++cell)
    surface.cell_start_[cell] += surface.cell_start_[cell - 1];
  surface.cell_facets_.resize(surface.cell_start_.back());
  std::vector<std::uint32_t> next(surface.cell_start_.begin(), surface.cell_start_.end() - 1);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for_cells(boxes[i], [&](std::size_t cell) { surface.cell_facets_[next[cell]++] = static_cast<std::uint32_t>(i); });
  return surface;
}

std::optional<RoadPoint> RoadSurface::at(double x_m, double y_m) const {
  const double column = (x_m - min_x_) / cell_m_, row = (y_m - min_y_) / cell_m_;
  // Written so that NaN fails.
  if (!(column >= 0.0 && column < static_cast<double>(columns_) && row >= 0.0 && row < static_cast<double>(rows_)))
    return std::nullopt;
  const auto cell =
      static_cast<std::size_t>(static_cast<std::int64_t>(row) * columns_ + static_cast<std::int64_t>(column));

  const Facet* best = nullptr;
  double best_z = 0.0;
  for (std::uint32_t i = cell_start_[cell]; i < cell_start_[cell + 1]; ++i) {
    const Facet& f = facets_[cell_facets_[i]];
    if (best && best->road && !f.road) continue;
    const double dx = x_m - f.x0, dy = y_m - f.y0;
    const double u = f.ux * dx + f.uy * dy, v = f.vx * dx + f.vy * dy;
    if (u < -kEdgeTolerance || v < -kEdgeTolerance || u + v > 1.0 + kEdgeTolerance) continue;
    const double z = f.z0 + f.slope_x * dx + f.slope_y * dy;
    if (!best || (f.road && !best->road) || z > best_z) best = &f, best_z = z;
  }
  if (!best) return std::nullopt;
  const double length = std::sqrt(best->slope_x * best->slope_x + best->slope_y * best->slope_y + 1.0);
  return RoadPoint{best_z, {-best->slope_x / length, -best->slope_y / length, 1.0 / length}, best->road};
}

}  // namespace phare
