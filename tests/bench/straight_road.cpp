#include "tests/bench/straight_road.h"

#include <algorithm>
#include <cmath>

namespace phare::bench {
namespace {

constexpr glm::dvec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

class Maker {
 public:
  std::uint32_t material(const char* name, float reflectance) {
    scene_.materials.push_back({.name = name, .reflectance = glm::vec3(reflectance)});
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }

  void begin(const char* node, std::uint32_t material) {
    SceneChunk chunk;
    chunk.node = node;
    chunk.material = material;
    chunk.first_index = static_cast<std::uint32_t>(scene_.indices.size());
    chunk.first_vertex = static_cast<std::uint32_t>(scene_.vertices.size());
    scene_.chunks.push_back(chunk);
  }

  /// A parallelogram in `columns` × `rows` cells, seen from where right × up points.
  void sheet(const glm::dvec3& corner, const glm::dvec3& right, const glm::dvec3& up, std::uint32_t columns = 1,
             std::uint32_t rows = 1) {
    SceneChunk& chunk = scene_.chunks.back();
    const auto base = static_cast<std::uint32_t>(scene_.vertices.size()) - chunk.first_vertex;
    const glm::vec3 normal(glm::normalize(glm::cross(right, up)));
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (std::uint32_t i = 0; i <= columns; ++i)
        scene_.vertices.push_back(
            {glm::vec3(corner + right * (double{1} * i / columns) + up * (double{1} * j / rows)), normal});
    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const std::uint32_t a = base + j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
        for (const std::uint32_t index : {a, b, d, a, d, c}) scene_.indices.push_back(index);
      }
  }

  void box(const glm::dvec3& low, const glm::dvec3& size) {
    const glm::dvec3 x = kX * size.x, y = kY * size.y, z = kZ * size.z;
    sheet(low + y, -y, z);      // toward the driver
    sheet(low + x, y, z);       // away
    sheet(low, x, z);           // right
    sheet(low + x + y, -x, z);  // left
    sheet(low + z, x, y);       // above
    sheet(low + y, x, -y);      // below
  }

  Scene done() {
    for (SceneChunk& chunk : scene_.chunks) {
      const std::size_t i = static_cast<std::size_t>(&chunk - scene_.chunks.data());
      const bool last = i + 1 == scene_.chunks.size();
      chunk.index_count =
          (last ? static_cast<std::uint32_t>(scene_.indices.size()) : scene_.chunks[i + 1].first_index) -
          chunk.first_index;
      chunk.vertex_count =
          (last ? static_cast<std::uint32_t>(scene_.vertices.size()) : scene_.chunks[i + 1].first_vertex) -
          chunk.first_vertex;
      chunk.low_m = glm::dvec3(1e9);
      chunk.high_m = glm::dvec3(-1e9);
      for (std::uint32_t v = 0; v < chunk.vertex_count; ++v) {
        const glm::dvec3 at(scene_.vertices[chunk.first_vertex + v].position_m);
        chunk.low_m = glm::min(chunk.low_m, at);
        chunk.high_m = glm::max(chunk.high_m, at);
      }
    }
    return std::move(scene_);
  }

 private:
  Scene scene_;
};

}  // namespace

Scene straight_road() {
  Maker make;
  const std::uint32_t road = make.material("road", 0.10f), ground = make.material("ground", 0.15f),
                      sign = make.material("sign", 0.5f), post = make.material("post", 0.3f),
                      person = make.material("person", 0.2f), car = make.material("car", 0.4f);
  make.begin("road", road);
  make.sheet({-10, -4, 0}, kX * 200.0, kY * 8.0, 20, 1);
  make.begin("ground", ground);
  make.sheet({-10, -60, 0}, kX * 200.0, kY * 56.0, 10, 2);
  make.sheet({-10, 4, 0}, kX * 200.0, kY * 56.0, 10, 2);
  make.begin("signs", sign);
  for (int i = 0; i < 20; ++i) make.box({8.0 + 9.0 * i, i % 2 == 0 ? -6.4 : 5.6, 1.6}, {0.04, 0.8, 0.8});
  make.begin("posts", post);
  for (int i = 0; i < 20; ++i) make.box({8.02 + 9.0 * i, i % 2 == 0 ? -6.03 : 5.97, 0.0}, {0.06, 0.06, 1.6});
  make.begin("people", person);
  for (int i = 0; i < 10; ++i) make.box({15.0 + 13.0 * i, i % 3 == 0 ? -4.6 : 4.2, 0.0}, {0.3, 0.5, 1.75});
  make.begin("car", car);
  make.box({70.0, 1.1, 0.2}, {4.2, 1.8, 1.3});
  return make.done();
}

IntensityTable straight_road_beam(Nodes nodes) {
  constexpr int kColumns = 256, kRows = 128;
  constexpr double kPeak_cd = 30000.0;
  IntensityTable table;
  table.name = "straight-road beam";
  table.type = PhotometricType::kA;
  const auto node = [&](double from, double to, int i, int count) {
    const double deg = from + (to - from) * i / (count - 1);
    return nodes == Nodes::kEven ? deg : std::round(deg * 1e4) / 1e4;
  };
  for (int i = 0; i < kColumns; ++i) table.first_deg.push_back(node(-45.0, 45.0, i, kColumns));
  for (int j = 0; j < kRows; ++j) table.second_deg.push_back(node(-20.0, 10.0, j, kRows));
  double peak = 0.0;
  for (const double v : table.second_deg)
    for (const double h : table.first_deg) {
      // A cut-off at −0.57° that rises at 15° on the right; a bright core below it over a wide carpet; stray light.
      const double edge_deg = h <= 0.0 ? -0.57 : std::min(-0.57 + 0.268 * h, 2.0);
      const double below = 1.0 / (1.0 + std::exp(std::clamp((v - edge_deg) / 0.1, -60.0, 60.0)));
      const auto bell = [](double x, double width) { return std::exp(-(x / width) * (x / width)); };
      const double core = 24000.0 * bell(h - 1.5, 7.0) * bell(v + 1.0, 1.8);
      const double carpet = 9000.0 * bell(h, 22.0) * bell(v + 2.0, 5.0) + 2000.0 * bell(h, 30.0) * bell(v + 5.0, 8.0);
      const double rim = std::clamp((45.0 - std::abs(h)) / 5.0, 0.0, 1.0) * std::clamp((v + 20.0) / 2.0, 0.0, 1.0) *
                         std::clamp((10.0 - v) / 2.0, 0.0, 1.0);
      table.candela.push_back(rim * (below * (core + carpet) + 150.0 * bell(h, 25.0) * bell(v, 6.0)));
      peak = std::max(peak, table.candela.back());
    }
  for (double& cd : table.candela) cd *= kPeak_cd / peak;
  return table;
}

FrameInput straight_road_view(double x_m) {
  FrameInput input;
  input.camera.eye_m = {x_m - 1.5, -1.64, 1.2};
  input.lamps = {{.position_m = {x_m, -1.4, 0.65}}, {.position_m = {x_m, -2.6, 0.65}}};
  return input;
}

}  // namespace phare::bench
