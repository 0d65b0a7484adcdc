#include "visual/fixed_light_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "config/base/on_all_cores.h"

namespace phare {
namespace {

constexpr int kSteps = 4;  // twice as many change the mean error in the town by 1 % of itself
// Samples are so far apart at least, of the shortest side that is cut: near by, and in far meshes.
constexpr double kApart = 0.33, kFarApart = 0.5;
// So many of a triangle; more of one that lies in the dark or has light with an edge: where one of the first is off.
constexpr std::size_t kFirstSamples = 4, kMostSamples = 16;
constexpr double kSmooth = 0.05, kLeast_lx = 0.5;  // off by less, of the light there or of so many lux
constexpr double kPlace_m = 1e-3;                  // corners nearer to each other are one
constexpr double kNormal = 1e-2;                   // the same, of normals
// Numbers of files and their halves lie on no boundary of such cells, where float32 would tell on which side.
constexpr double kCell = 0.2718;

// Of larger scenes samples are fewer, and beyond so many corners there are none: light stays what it is at corners.
constexpr std::size_t kMostOfAll = 2000000;
constexpr std::size_t kMostCorners = 4000000;

struct Sample {
  std::array<std::uint32_t, 3> corner{};  ///< of all
  glm::vec3 weight{0.0f};
  glm::vec4 lx{0.0f};
  float area_m2 = 0.0f;
};

/// Places in a triangle that lie evenly: the sequence of Roberts (2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences"), folded.
glm::dvec3 place_in_triangle(std::size_t i) {
  double u = std::fmod(0.5 + 0.7548776662466927 * static_cast<double>(i + 1), 1.0);
  double v = std::fmod(0.5 + 0.5698402909980532 * static_cast<double>(i + 1), 1.0);
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  return {1.0 - u - v, u, v};
}

/// Corners of one level of the meshes, joined.
class Corners {
 public:
  std::uint32_t at(std::uint32_t material, const glm::dvec3& place_m, const glm::dvec3& normal) {
    const auto whole = [](double value, double unit) {
      return static_cast<std::int64_t>(std::llround(value / unit + kCell));
    };
    const Key key{material,
                  whole(place_m.x, kPlace_m),
                  whole(place_m.y, kPlace_m),
                  whole(place_m.z, kPlace_m),
                  whole(normal.x, kNormal),
                  whole(normal.y, kNormal),
                  whole(normal.z, kNormal)};
    return known_.try_emplace(key, static_cast<std::uint32_t>(known_.size())).first->second;
  }
  std::size_t size() const { return known_.size(); }

 private:
  using Key = std::array<std::int64_t, 7>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t sum = 0;
      for (const std::int64_t part : key)
        sum = (sum ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15u, sum ^= sum >> 32;
      return sum;
    }
  };
  std::unordered_map<Key, std::uint32_t, Hash> known_;
};

/// Of the vertices' light that which is not reflected.
glm::dvec4 direct_lx(const FixedMesh& mesh, std::size_t vertex) {
  const glm::dvec4 reflected = mesh.reflected_lx.empty() ? glm::dvec4(0.0) : mesh.reflected_lx[vertex];
  return glm::dvec4(mesh.light[vertex].light) - reflected;
}

std::size_t triangles_of(const FixedMesh& mesh) {
  return mesh.indices.size() / 3;
}

double area_m2(const FixedMesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t k) { return glm::dvec3(mesh.vertices[mesh.indices[3 * triangle + k]].position_m); };
  return 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
}

std::size_t most_samples(double area_m2, double sample_m2) {
  return static_cast<std::size_t>(std::min(static_cast<double>(kMostSamples), area_m2 / sample_m2));
}

/// What falls on a triangle besides what is reflected, which is even; corners are those of the mesh.
void take_samples(std::vector<Sample>& into, const FixedLight& light, const SceneChunk& chunk,
                  const SceneMaterial& material, const FixedMesh& mesh, std::size_t triangle, double sample_m2) {
  std::array<std::uint32_t, 3> corner{};
  std::array<glm::dvec3, 3> at_m, normals;
  std::array<glm::dvec4, 3> lx;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = mesh.indices[3 * triangle + k];
    const SceneVertex& vertex = mesh.vertices[corner[k]];
    at_m[k] = glm::dvec3(vertex.position_m), normals[k] = glm::dvec3(vertex.normal), lx[k] = direct_lx(mesh, corner[k]);
  }
  const double all_m2 = area_m2(mesh, triangle);
  const std::size_t most = most_samples(all_m2, sample_m2), first = into.size();
  bool smooth = true;
  for (std::size_t i = 0; i < (smooth ? std::min(most, kFirstSamples) : most); ++i) {
    const glm::dvec3 weight = place_in_triangle(i);
    const auto between = [&weight](const auto& of) { return weight.x * of[0] + weight.y * of[1] + weight.z * of[2]; };
    const glm::dvec3 normal = between(normals);
    if (!(glm::dot(normal, normal) > 1e-6)) continue;  // of a file: they look away from each other
    const glm::dvec4 none(0.0);
    const glm::vec4 there =
        light.at(chunk.origin_m + between(at_m), glm::normalize(normal), material, nullptr, nullptr, &none).light;
    into.push_back({corner, weight, there});
    const double exact = static_cast<double>(there.w);
    smooth = smooth && std::abs(exact - between(lx).w) < kSmooth * std::max(exact, kLeast_lx);
  }
  if (into.size() == first) return;
  const auto share_m2 = static_cast<float>(all_m2 / static_cast<double>(into.size() - first));
  for (std::size_t i = first; i < into.size(); ++i) into[i].area_m2 = share_m2;
}

/// Of one level, by chunk.
std::vector<std::vector<Sample>> all_samples(const FixedLight& light, const Scene& scene,
                                             const std::vector<FixedLight::Meshes>& meshes, std::size_t level,
                                             double sample_m2) {
  const auto most_of_all = [&] {
    std::size_t most = 0;
    for (const FixedLight::Meshes& of : meshes)
      for (std::size_t t = 0; t < triangles_of(of[level]); ++t) most += most_samples(area_m2(of[level], t), sample_m2);
    return most;
  };
  while (most_of_all() > kMostOfAll) sample_m2 *= 2.0;
  std::vector<std::vector<Sample>> taken(meshes.size());
  on_all_cores(meshes.size(), [&](std::size_t c) {
    const SceneChunk& chunk = scene.chunks[c];
    for (std::size_t t = 0; t < triangles_of(meshes[c][level]); ++t)
      take_samples(taken[c], light, chunk, scene.materials[chunk.material], meshes[c][level], t, sample_m2);
  });
  return taken;
}

/// Least squares by steps: light at corners, of samples that name them.
std::vector<glm::dvec4> fitted(std::vector<glm::dvec4> lx, const std::vector<std::vector<Sample>>& by_chunk) {
  std::vector<double> weight_m2(lx.size(), 0.0);
  const auto each = [&by_chunk](const auto& with) {
    for (const std::vector<Sample>& samples : by_chunk)
      for (const Sample& sample : samples)
        with(glm::dvec4(sample.lx), sample.corner,
             std::array{static_cast<double>(sample.weight.x), static_cast<double>(sample.weight.y),
                        static_cast<double>(sample.weight.z)},
             static_cast<double>(sample.area_m2));
  };
  each([&](const glm::dvec4&, const auto& corner, const auto& weight, double area) {
    for (std::size_t k = 0; k < 3; ++k) weight_m2[corner[k]] += area * weight[k];
  });
  std::vector<glm::dvec4> change(lx.size());
  for (int step = 0; step < kSteps; ++step) {
    std::ranges::fill(change, glm::dvec4(0.0));
    each([&](glm::dvec4 off, const auto& corner, const auto& weight, double area) {
      for (std::size_t k = 0; k < 3; ++k) off -= weight[k] * lx[corner[k]];
      for (std::size_t k = 0; k < 3; ++k) change[corner[k]] += area * weight[k] * off;
    });
    for (std::size_t i = 0; i < lx.size(); ++i)
      if (weight_m2[i] > 0.0) lx[i] = glm::max(lx[i] + change[i] / weight_m2[i], 0.0);
  }
  return lx;
}

void fit_level(const FixedLight& light, const Scene& scene, std::vector<FixedLight::Meshes>& meshes, std::size_t level,
               double least_edge_m) {
  std::size_t count = 0;
  for (const FixedLight::Meshes& of : meshes) count += of[level].vertices.size();
  if (count > kMostCorners) return;
  const double apart_m = (level == 0 ? kApart : kFarApart) * least_edge_m;
  std::vector<std::vector<Sample>> samples = all_samples(light, scene, meshes, level, apart_m * apart_m);

  Corners corners;
  std::vector<std::vector<std::uint32_t>> corner_of(meshes.size());
  std::vector<glm::dvec4> before_lx;
  for (std::size_t c = 0; c < meshes.size(); ++c) {
    const SceneChunk& chunk = scene.chunks[c];
    const FixedMesh& mesh = meshes[c][level];
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const SceneVertex& vertex = mesh.vertices[v];
      corner_of[c].push_back(
          corners.at(chunk.material, chunk.origin_m + glm::dvec3(vertex.position_m), glm::dvec3(vertex.normal)));
      before_lx.resize(corners.size());
      before_lx[corner_of[c][v]] = direct_lx(mesh, v);
    }
    for (Sample& sample : samples[c])
      for (std::uint32_t& corner : sample.corner) corner = corner_of[c][corner];
  }
  const std::vector<glm::dvec4> lx = fitted(before_lx, samples);
  for (std::size_t c = 0; c < meshes.size(); ++c)
    for (std::size_t v = 0; v < corner_of[c].size(); ++v)
      meshes[c][level].light[v].light += glm::vec4(lx[corner_of[c][v]] - before_lx[corner_of[c][v]]);
}

}  // namespace

void fit_light(const FixedLight& light, const Scene& scene, std::vector<FixedLight::Meshes>& meshes,
               const std::array<double, 1 + kFarLevels.size()>& least_edges_m) {
  for (std::size_t level = 0; level < least_edges_m.size(); ++level)
    fit_level(light, scene, meshes, level, least_edges_m[level]);
}

}  // namespace phare
