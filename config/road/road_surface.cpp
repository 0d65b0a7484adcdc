#include "config/road/road_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "config/formats/gltf_file.h"
#include "config/road/road_friction.h"

namespace phare {
namespace {

// A point this far outside a triangle, in barycentric units, still belongs to it: neighbours must leave no crack
// between.
constexpr double kEdgeTolerance = 1e-7;
constexpr std::uint64_t kMaxCells = 4'000'000;
constexpr std::uint64_t kMaxCellEntries = 16'000'000;

// Bounds of a facet: min x, min y, max x, max y.
using Box = std::array<double, 4>;

// Which of `count` intervals a place lies in, `place` counted in intervals from the first. Rises with the place, so no
// facet is missing from a cell that holds a point of it.
std::int64_t interval(double place, std::int64_t count) {
  return std::clamp(static_cast<std::int64_t>(place), std::int64_t{0}, count - 1);
}

// What the material of a primitive says, 1 if nothing.
Result<double> friction_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  if (primitive.material < 0 || static_cast<std::size_t>(primitive.material) >= model.materials.size()) return 1.0;
  const tinygltf::Material& material = model.materials[static_cast<std::size_t>(primitive.material)];
  if (!material.extras.IsObject() || !material.extras.Has("friction")) return 1.0;
  const tinygltf::Value& value = material.extras.Get("friction");
  const double friction = value.IsNumber() ? value.GetNumberAsDouble() : 0.0;
  if (friction >= kLeastFriction && friction <= kMostFriction) return friction;
  return Error{"material \"" + material.name + "\"", "extras.friction is no number from 0.01 to 2"};
}

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
      const Result<double> friction = friction_of(*model, primitive);
      if (!friction) return in_file(friction.error());
      for (std::size_t i = 0; i + 2 < indices->size(); i += 3) {
        Triangle triangle{.corner_m = {}, .road = road, .friction = *friction};
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
    if (!(std::abs(twice_area) > 1e-6 * longest2) || !std::isfinite(twice_area)) {
      ++surface.left_out_;
      continue;
    }
    Facet f{};
    f.x0 = a.x, f.y0 = a.y, f.z0 = a.z;
    f.ux = q.y / twice_area, f.uy = -q.x / twice_area;
    f.vx = -p.y / twice_area, f.vy = p.x / twice_area;
    f.slope_x = p.z * f.ux + q.z * f.vx;
    f.slope_y = p.z * f.uy + q.z * f.vy;
    f.road = triangle.road;
    f.friction = static_cast<float>(triangle.friction);
    surface.has_friction_ |= triangle.friction != 1.0;
    surface.facets_.push_back(f);
    const auto [low_x, high_x] = std::minmax({0.0, p.x, q.x});
    const auto [low_y, high_y] = std::minmax({0.0, p.y, q.y});
    const Box box{a.x + low_x, a.y + low_y, a.x + high_x, a.y + high_y};
    boxes.push_back(box);
    all = {std::min(all[0], box[0]), std::min(all[1], box[1]), std::max(all[2], box[2]), std::max(all[3], box[3])};
  }
  if (boxes.empty()) return surface;

  // About one triangle a cell where they spread evenly; coarser until cells and entries fit their limits.
  const double width = all[2] - all[0], depth = all[3] - all[1];
  surface.min_x_ = all[0], surface.min_y_ = all[1];
  double cell_m = std::max({std::sqrt(width * depth / static_cast<double>(boxes.size())), 0.25,
                            std::sqrt(width * depth / static_cast<double>(kMaxCells))});
  struct Range {
    std::int64_t from_column, to_column, from_row, to_row;
  };
  const auto range = [&surface](const Box& box) {
    const auto column = [&](double x) { return interval((x - surface.min_x_) * surface.cells_pm_, surface.columns_); };
    const auto row = [&](double y) { return interval((y - surface.min_y_) * surface.cells_pm_, surface.rows_); };
    return Range{column(box[0]), column(box[2]), row(box[1]), row(box[3])};
  };
  for (;; cell_m *= 2.0) {
    surface.cells_pm_ = 1.0 / cell_m;
    surface.columns_ = static_cast<std::int64_t>(width / cell_m) + 1;
    surface.rows_ = static_cast<std::int64_t>(depth / cell_m) + 1;
    std::uint64_t entries = 0;
    for (const Box& box : boxes) {
      const Range r = range(box);
      entries += static_cast<std::uint64_t>((r.to_column - r.from_column + 1) * (r.to_row - r.from_row + 1));
    }
    const auto cells = static_cast<std::uint64_t>(surface.columns_ * surface.rows_);
    if (cells <= kMaxCells && entries <= std::max<std::uint64_t>(kMaxCellEntries, 2 * boxes.size())) break;
    if (cells == 1) break;
  }

  // Count, add up, fill: one array for all cells.
  const auto for_cells = [&](const Box& box, auto&& visit) {
    const Range r = range(box);
    for (std::int64_t row = r.from_row; row <= r.to_row; ++row)
      for (std::int64_t column = r.from_column; column <= r.to_column; ++column)
        visit(static_cast<std::size_t>(row * surface.columns_ + column));
  };
  std::vector<std::uint32_t> start(static_cast<std::size_t>(surface.columns_ * surface.rows_) + 1, 0);
  for (const Box& box : boxes) for_cells(box, [&](std::size_t cell) { ++start[cell + 1]; });
  for (std::size_t cell = 1; cell < start.size(); ++cell) start[cell] += start[cell - 1];
  std::vector<std::uint32_t> facets(start.back()), next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for_cells(boxes[i], [&](std::size_t cell) { facets[next[cell]++] = static_cast<std::uint32_t>(i); });
  surface.divide(start, facets);
  return surface;
}

// Whether it may have a point in common with the square about (x, y): not if one of its barycentric coordinates, linear
// as they are, is below zero all over the square. A little larger than both are, for rounding.
bool RoadSurface::touches(const Facet& f, double x_m, double y_m, double half_m) {
  const double dx = x_m - f.x0, dy = y_m - f.y0, reach_m = half_m * (1.0 + 1e-6);
  const double u = f.ux * dx + f.uy * dy, v = f.vx * dx + f.vy * dy;
  const auto most = [&](double middle, double slope_x, double slope_y) {
    return middle + reach_m * (std::abs(slope_x) + std::abs(slope_y));
  };
  const double least =
      std::min({most(u, f.ux, f.uy), most(v, f.vx, f.vy), most(1.0 - u - v, f.ux + f.vx, f.uy + f.vy)});
  return least >= -10.0 * kEdgeTolerance;
}

// A cell with more than a few facets becomes so many parts that each holds a few, if that does not copy them too often:
// facets as large as the cell lie in all its parts.
void RoadSurface::divide(const std::vector<std::uint32_t>& cell_start, const std::vector<std::uint32_t>& cell_facets) {
  constexpr std::size_t kFew = 3, kMostCopies = 16;
  constexpr double kPartsPerFacet = 16.0, kTests = 1e8;  // half a second, however the triangles lie
  const double most_across = std::clamp(std::sqrt(kTests / static_cast<double>(cell_facets.size() + 1)), 1.0, 64.0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> entries;  // part, facet
  for (std::size_t cell = 0; cell + 1 < cell_start.size(); ++cell) {
    const std::size_t crowd = cell_start[cell + 1] - cell_start[cell];
    const double cell_m = 1.0 / cells_pm_;
    const double left_m = min_x_ + cell_m * static_cast<double>(static_cast<std::int64_t>(cell) % columns_),
                 near_m = min_y_ + cell_m * static_cast<double>(static_cast<std::int64_t>(cell) / columns_);
    std::uint32_t across = 1;
    if (crowd > kFew)
      across = static_cast<std::uint32_t>(
          std::min(most_across, std::ceil(std::sqrt(kPartsPerFacet * static_cast<double>(crowd)))));
    for (;; across /= 2) {
      entries.clear();
      const double part_m = cell_m / static_cast<double>(across);
      for (std::uint32_t row = 0; row < across; ++row)
        for (std::uint32_t column = 0; column < across; ++column)
          for (std::uint32_t i = cell_start[cell]; i < cell_start[cell + 1]; ++i)
            if (touches(facets_[cell_facets[i]], left_m + (column + 0.5) * part_m, near_m + (row + 0.5) * part_m,
                        0.5 * part_m))
              entries.emplace_back(row * across + column, cell_facets[i]);
      if (across == 1 || entries.size() <= kMostCopies * crowd) break;
    }
    cells_.push_back({static_cast<std::uint32_t>(part_start_.size()), across});
    auto entry = entries.begin();
    for (std::uint32_t part = 0; part < across * across; ++part) {
      part_start_.push_back(static_cast<std::uint32_t>(part_facets_.size()));
      for (; entry != entries.end() && entry->first == part; ++entry) part_facets_.push_back(entry->second);
    }
  }
  part_start_.push_back(static_cast<std::uint32_t>(part_facets_.size()));
}

RoadSurface::Found RoadSurface::find(double x_m, double y_m) const {
  const double column = (x_m - min_x_) * cells_pm_, row = (y_m - min_y_) * cells_pm_;
  // Written so that NaN fails.
  if (!(column >= 0.0 && column < static_cast<double>(columns_) && row >= 0.0 && row < static_cast<double>(rows_)))
    return {};
  const auto whole_column = static_cast<std::int64_t>(column), whole_row = static_cast<std::int64_t>(row);
  const Cell& cell = cells_[static_cast<std::size_t>(whole_row * columns_ + whole_column)];
  std::size_t part = cell.first;
  if (cell.across > 1) {
    const auto across = static_cast<std::int64_t>(cell.across);
    const auto within = [&](double place, std::int64_t whole) {
      return interval((place - static_cast<double>(whole)) * static_cast<double>(across), across);
    };
    part += static_cast<std::size_t>(within(row, whole_row) * across + within(column, whole_column));
  }

  Found best;
  for (std::uint32_t i = part_start_[part]; i < part_start_[part + 1]; ++i) {
    const Facet& f = facets_[part_facets_[i]];
    if (best.facet && best.facet->road && !f.road) continue;
    const double dx = x_m - f.x0, dy = y_m - f.y0;
    const double u = f.ux * dx + f.uy * dy, v = f.vx * dx + f.vy * dy;
    if (std::min(std::min(u, v), 1.0 - u - v) < -kEdgeTolerance) continue;
    const double z = f.z0 + f.slope_x * dx + f.slope_y * dy;
    if (!best.facet || (f.road && !best.facet->road) || z > best.z_m) best = {&f, z};
  }
  return best;
}

std::optional<double> RoadSurface::height_m(double x_m, double y_m) const {
  const Found found = find(x_m, y_m);
  if (!found.facet) return std::nullopt;
  return found.z_m;
}

double RoadSurface::friction(double x_m, double y_m) const {
  const Found found = find(x_m, y_m);
  return found.facet ? static_cast<double>(found.facet->friction) : 1.0;
}

std::optional<RoadPoint> RoadSurface::at(double x_m, double y_m) const {
  const auto [facet, z] = find(x_m, y_m);
  if (!facet) return std::nullopt;
  const double length = std::sqrt(facet->slope_x * facet->slope_x + facet->slope_y * facet->slope_y + 1.0);
  return RoadPoint{z, {-facet->slope_x / length, -facet->slope_y / length, 1.0 / length}, facet->road};
}

std::string no_ground_below(const RoadSurface& surface, double x_m, double y_m) {
  constexpr const char* kAsked = ": the car drives on a plane; is the scene in metres, with the axes of glTF (y up)?";
  if (surface.all_upright()) return std::string("all that is named road or ground stands upright") + kAsked;
  if (surface.triangle_count() == 0) return "no node whose name begins with road or ground: the car drives on a plane";
  if (surface.at(x_m, y_m)) return "";
  char where[64];
  std::snprintf(where, sizeof where, "(%.1f, %.1f) m", x_m, y_m);
  return std::string("no road or ground below the start ") + where +
         ": the car drives on a plane there; is the scene in metres, with the axes of glTF (y up), and the start on "
         "it?";
}

}  // namespace phare
