#include "visual/scene/far_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <numeric>
#include <span>

namespace phare {

namespace {

double area_m2(const FarMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position_m; };
    sum += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  return sum;
}

void thin_leaves(FarMesh& mesh, const FarLevel& level) {
  FarMesh far;
  const double leaves = static_cast<double>(mesh.indices.size() / 3);
  const auto share = static_cast<std::uint32_t>(
      std::clamp(std::round(level.leaf_m2 * leaves / std::max(area_m2(mesh), 1e-9)), 1.0, 1.0 * level.leaves_per_leaf));
  const float grow = std::sqrt(static_cast<float>(share));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += std::size_t{3} * share) {
    std::array<SceneVertex, 3> leaf{mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                                    mesh.vertices[mesh.indices[i + 2]]};
    const glm::vec3 middle = (leaf[0].position_m + leaf[1].position_m + leaf[2].position_m) / 3.0f;
    for (SceneVertex& vertex : leaf) {
      vertex.position_m = middle + grow * (vertex.position_m - middle);
      far.indices.push_back(static_cast<std::uint32_t>(far.vertices.size()));
      far.vertices.push_back(vertex);
    }
    if (!mesh.looks.empty())
      for (std::size_t k = 0; k < 3; ++k) far.looks.push_back(mesh.looks[mesh.indices[i + k]]);
  }
  mesh = std::move(far);
}

// Keeps the vertices that are still used, in their order.
void drop_unused(FarMesh& mesh) {
  std::vector<std::uint32_t> place(mesh.vertices.size(), ~0u);
  std::vector<SceneVertex> kept;
  std::vector<CornerLook> looks;
  for (std::uint32_t& index : mesh.indices) {
    if (place[index] == ~0u) {
      place[index] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(mesh.vertices[index]);
      if (!mesh.looks.empty()) looks.push_back(mesh.looks[index]);
    }
    index = place[index];
  }
  mesh.vertices = std::move(kept);
  mesh.looks = std::move(looks);
}

// Of triangles between places that are `stride` bytes apart in memory, fewer that are within the error of them.
std::vector<std::uint32_t> fewer(std::span<const std::uint32_t> indices, const glm::vec3& first_place_m,
                                 std::size_t places, std::size_t stride, float error_m, unsigned options = 0) {
  const float scale = meshopt_simplifyScale(&first_place_m.x, places, stride);
  if (!(scale > 0.0f)) return {indices.begin(), indices.end()};
  std::vector<std::uint32_t> kept(indices.size());
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), &first_place_m.x, places, stride,
                               std::size_t{3}, std::min(1.0f, error_m / scale), options, nullptr));
  return kept;
}

void simplify(FarMesh& mesh, float error_m, unsigned options = 0) {
  mesh.indices = fewer(mesh.indices, mesh.vertices.front().position_m, mesh.vertices.size(), sizeof(SceneVertex),
                       error_m, options);
  drop_unused(mesh);
}

// Pieces of a mesh that hang together by the places of their corners; a number for each vertex.
class Pieces {
 public:
  explicit Pieces(const FarMesh& mesh) : of_(mesh.vertices.size()) {
    std::iota(of_.begin(), of_.end(), 0u);
    std::vector<std::uint32_t> by_place = of_;
    const auto place = [&](std::uint32_t i) {
      const glm::vec3& p = mesh.vertices[i].position_m;
      return std::array{p.x, p.y, p.z};
    };
    std::ranges::sort(by_place, {}, place);
    for (std::size_t i = 1; i < by_place.size(); ++i)
      if (place(by_place[i]) == place(by_place[i - 1])) join(by_place[i], by_place[i - 1]);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
      for (std::size_t k = 1; k < 3; ++k) join(mesh.indices[i], mesh.indices[i + k]);
  }
  std::uint32_t of(std::uint32_t vertex) {
    while (of_[vertex] != vertex) vertex = of_[vertex] = of_[of_[vertex]];
    return vertex;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) { of_[of(a)] = of(b); }
  std::vector<std::uint32_t> of_;
};

struct PieceSize {
  static constexpr float kClosed = 0.05f;  // of its area
  glm::vec3 low{1e30f}, high{-1e30f}, area_vector{0.0f};
  float area_m2 = 0.0f;

  void add(const std::array<glm::vec3, 3>& corners) {
    for (const glm::vec3& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
    const glm::vec3 area = 0.5f * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    area_vector += area;
    area_m2 += glm::length(area);
  }
  bool closed() const { return glm::length(area_vector) < kClosed * area_m2; }
  // As it looks on average from all sides: of a closed body a quarter of its surface is seen (Cauchy 1832), of a plate
  // half.
  float width_m() const { return area_m2 / ((closed() ? 4.0f : 2.0f) * glm::length(high - low)); }
};

// Of each piece of the triangles, at its number; the rest is empty.
std::vector<PieceSize> sizes_of(const FarMesh& mesh, Pieces& pieces, std::span<const std::uint32_t> indices) {
  std::vector<PieceSize> sizes(mesh.vertices.size());
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[indices[i + k]].position_m; };
    sizes[pieces.of(indices[i])].add({corner(0), corner(1), corner(2)});
  }
  return sizes;
}

// Appends them as triangles of places, each corner with the normal there that is nearest to its triangle's plane; of a
// flat mesh that of the plane. `normals`: at each place.
void append_places(FarMesh& mesh, std::span<const std::uint32_t> places, std::span<const glm::vec3> at_m,
                   std::span<const std::vector<glm::vec3>> normals, bool flat) {
  constexpr float kNear = 0.7f;  // cosine: of a normal that leans more than 45°, the plane's is taken
  std::map<std::array<std::uint32_t, 6>, std::uint32_t> known;
  for (std::size_t i = 0; i + 2 < places.size(); i += 3) {
    const glm::vec3 a_m = at_m[places[i]];
    const glm::vec3 across = glm::cross(at_m[places[i + 1]] - a_m, at_m[places[i + 2]] - a_m);
    if (!(glm::length(across) > 0.0f)) continue;
    const glm::vec3 plane = glm::normalize(across);
    for (std::size_t k = 0; k < 3; ++k) {
      SceneVertex corner{at_m[places[i + k]], plane};
      float nearest = kNear;
      if (!flat)
        for (const glm::vec3& normal : normals[places[i + k]])
          if (const float cosine = glm::dot(normal, plane); cosine > nearest) nearest = cosine, corner.normal = normal;
      const auto [found, fresh] = known.try_emplace(std::bit_cast<std::array<std::uint32_t, 6>>(corner),
                                                    static_cast<std::uint32_t>(mesh.vertices.size()));
      if (fresh) mesh.vertices.push_back(corner);
      mesh.indices.push_back(found->second);
    }
  }
}

// It is as long, wide and high as it was but for the error, and shows to every side the area that it showed, but for a
// strip along it that is half of the error wide: a simplifier tells its own error by planes, and lets a tube become
// shorter, or a plate that is not seen from behind.
bool has_kept_its_shape(const PieceSize& was, const PieceSize& is, float error_m) {
  const glm::vec3 off = glm::max(is.low - was.low, was.high - is.high);
  return std::max({off.x, off.y, off.z}) <= error_m &&
         glm::length(is.area_vector - was.area_vector) <=
             std::max(PieceSize::kClosed * was.area_m2, 0.5f * error_m * glm::length(was.high - was.low));
}

// A hard edge has a corner for each of its sides, and the simplifier moves none that has more than two: of a body with
// flat sides it leaves all. So places are simplified. What is narrow keeps its edges, or it would be gone while it is
// still wider than a pixel; and so does what has a look, which edges part. What loses its shape is simplified with less
// error, and in the end not at all.
void simplify_things(FarMesh& mesh, float error_m) {
  constexpr float kNarrow = 2.0f;  // times the error; chosen
  constexpr int kTries = 4;        // each with half of the error of the one before; chosen
  const std::size_t corners = mesh.vertices.size();
  const bool flat = is_flat(mesh.vertices, mesh.indices);
  std::vector<glm::vec3> place_m(corners);
  std::ranges::transform(mesh.vertices, place_m.begin(), [](const SceneVertex& vertex) {
    return vertex.position_m + 0.0f;  // places are compared byte by byte, and -0 is 0
  });
  std::vector<std::uint32_t> place_of(corners);
  const std::size_t places = meshopt_generateVertexRemap(place_of.data(), static_cast<const std::uint32_t*>(nullptr),
                                                         corners, place_m.data(), corners, sizeof(glm::vec3));
  std::vector<glm::vec3> at_m(places);
  std::vector<std::uint32_t> vertex_at(places);
  std::vector<std::vector<glm::vec3>> normals(places);
  for (std::uint32_t i = 0; i < corners; ++i) {
    at_m[place_of[i]] = place_m[i];
    vertex_at[place_of[i]] = i;
    normals[place_of[i]].push_back(mesh.vertices[i].normal);
  }
  Pieces pieces(mesh);
  const std::vector<PieceSize> whole = sizes_of(mesh, pieces, mesh.indices);
  std::vector<std::uint32_t> left = mesh.indices, by_vertices, by_places;
  float error = error_m;
  for (int tried = 0; tried < kTries && !left.empty(); ++tried, error *= 0.5f) {
    std::vector<std::uint32_t> wide, narrow;
    for (const std::uint32_t vertex : left)
      if (mesh.looks.empty() && whole[pieces.of(vertex)].width_m() >= kNarrow * error)
        wide.push_back(place_of[vertex]);
      else
        narrow.push_back(vertex);
    if (!wide.empty()) wide = fewer(wide, at_m.front(), places, sizeof(glm::vec3), error);
    if (!narrow.empty()) narrow = fewer(narrow, mesh.vertices.front().position_m, corners, sizeof(SceneVertex), error);
    std::vector<std::uint32_t> both = narrow;
    for (const std::uint32_t place : wide) both.push_back(vertex_at[place]);
    const std::vector<PieceSize> now = sizes_of(mesh, pieces, both);
    const auto good = [&](std::uint32_t vertex) {
      const std::uint32_t piece = pieces.of(vertex);
      return has_kept_its_shape(whole[piece], now[piece], error_m);
    };
    std::ranges::copy_if(narrow, std::back_inserter(by_vertices), good);
    std::ranges::copy_if(wide, std::back_inserter(by_places),
                         [&](std::uint32_t place) { return good(vertex_at[place]); });
    std::erase_if(left, good);
  }
  mesh.indices = std::move(by_vertices);
  mesh.indices.insert(mesh.indices.end(), left.begin(), left.end());
  drop_unused(mesh);
  append_places(mesh, by_places, at_m, normals, flat);
}

// Lumps that hide what is in them; else leaves, each a surface of its own.
bool is_closed(const FarMesh& mesh) {
  Pieces pieces(mesh);
  return std::ranges::all_of(sizes_of(mesh, pieces, mesh.indices),
                             [](const PieceSize& size) { return size.area_m2 == 0.0f || size.closed(); });
}

// Leaves out what is narrower than a pixel: it would flicker from pixel to pixel.
void drop_slivers(FarMesh& mesh, float width_m) {
  Pieces pieces(mesh);
  const std::vector<PieceSize> sizes = sizes_of(mesh, pieces, mesh.indices);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (sizes[pieces.of(mesh.indices[i])].width_m() >= width_m)
      kept.insert(kept.end(), &mesh.indices[i], &mesh.indices[i] + 3);
  mesh.indices = std::move(kept);
  drop_unused(mesh);
}

}  // namespace

FarMesh far_mesh(const Scene& scene, const SceneChunk& chunk, std::size_t level, double from_m) {
  FarMesh mesh;
  const auto vertex = scene.vertices.begin() + static_cast<std::ptrdiff_t>(chunk.first_vertex);
  mesh.vertices.assign(vertex, vertex + static_cast<std::ptrdiff_t>(chunk.vertex_count));
  if (chunk.first_look) {
    const auto look = scene.looks.begin() + static_cast<std::ptrdiff_t>(*chunk.first_look);
    mesh.looks.assign(look, look + static_cast<std::ptrdiff_t>(chunk.vertex_count));
  }
  const auto index = scene.indices.begin() + static_cast<std::ptrdiff_t>(chunk.first_index);
  mesh.indices.assign(index, index + static_cast<std::ptrdiff_t>(chunk.index_count));
  const SceneMaterial& material = scene.materials[chunk.material];
  // What shines by itself is seen from afar however narrow it is.
  if (material.emission_cdm2 != glm::vec3(0.0f)) return mesh;
  if (mesh.indices.empty() || material.retro.kind == RetroKind::kSheeting || material.retro.kind == RetroKind::kMarking)
    return mesh;
  const bool closed = material.surface == Surface::kFoliage && !material.double_sided && is_closed(mesh);
  switch (closed ? Surface::kPlain : material.surface) {
    case Surface::kFoliage:
      thin_leaves(mesh, kFarLevels[level]);
      break;
    case Surface::kAsphalt:
    case Surface::kGrass:
      // Sides are kept, or one would see between chunks through the ground.
      simplify(mesh, static_cast<float>(kFarGroundError_rad * from_m), meshopt_SimplifyLockBorder);
      break;
    case Surface::kPlain:
      drop_slivers(mesh, static_cast<float>(kFarThingWidth_rad * from_m));
      if (mesh.indices.empty()) break;
      if (closed)  // lumps, whose outline is their leaves'
        simplify(mesh, static_cast<float>(kFarLumpError_rad * from_m));
      else
        simplify_things(mesh, static_cast<float>(kFarThingError_rad * from_m));
      break;
    case Surface::kPaint:
      if (level + 1 == kFarLevels.size()) simplify(mesh, static_cast<float>(kFarGroundError_rad * from_m));
      break;
  }
  return mesh;
}

}  // namespace phare
