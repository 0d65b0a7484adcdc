#include "tests/bench/growth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace phare::bench {
Scene with_more_draws(const Scene& scene, std::size_t count) {
  constexpr double kCell_m = 96.0;  // side of the cells that chunks are gathered in (visual/gpu/scene_buffers.cpp)
  Scene result = scene;
  std::size_t made = 0;
  for (int column = 3; made < count && column < 30; ++column) {
    const double x_m = (column + 0.5) * kCell_m;
    const int rows = static_cast<int>(x_m * std::tan(25.0 * 3.14159265 / 180.0) / kCell_m);
    for (int row = -rows; made < count && row < rows; ++row, ++made) {
      SceneChunk chunk;
      chunk.node = "post";
      chunk.origin_m = {x_m, (row + 0.5) * kCell_m, 0.0};
      chunk.first_index = static_cast<std::uint32_t>(result.indices.size());
      chunk.first_vertex = static_cast<std::uint32_t>(result.vertices.size());
      for (const glm::vec3& at : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0, -1, 2), glm::vec3(0, 1, 2)})
        result.vertices.push_back({at, {-1, 0, 0}});
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) result.indices.push_back(i);
      chunk.index_count = 6;
      chunk.vertex_count = 4;
      chunk.low_m = chunk.origin_m - glm::dvec3(0, 1, 0);
      chunk.high_m = chunk.origin_m + glm::dvec3(0, 1, 2);
      result.chunks.push_back(chunk);
    }
  }
  return result;
}

std::string growth_curve(const std::string& title, const std::string& unit, const std::vector<GrowthPoint>& points) {
  if (points.empty()) return {};
  double most = 0.0, n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const GrowthPoint& point : points) {
    most = std::max(most, point.cpu_ms);
    n += 1.0, x += point.amount, y += point.cpu_ms;
    xx += point.amount * point.amount, xy += point.amount * point.cpu_ms;
  }
  const double spread = n * xx - x * x;
  const double slope = spread > 0.0 ? (n * xy - x * y) / spread : 0.0;
  char line[200];
  std::string text = "\n" + title + "\n";
  for (const GrowthPoint& point : points) {
    const auto length = static_cast<std::size_t>(std::lround(48.0 * point.cpu_ms / most));
    std::snprintf(line, sizeof line, "  %10.0f %-10s %8.2f ms %6.2f floors  %s\n", point.amount, unit.c_str(),
                  point.cpu_ms, point.floors, std::string(length, '#').c_str());
    text += line;
  }
  std::snprintf(line, sizeof line, "  about %.2f ms and %.3g us for each of the %s\n", (y - slope * x) / n, 1e3 * slope,
                unit.c_str());
  return text + line;
}

}  // namespace phare::bench
