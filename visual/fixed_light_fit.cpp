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

struct Sample {
  std::array<std::uint32_t, 3> corner{};  ///< of all
  glm::dvec3 weight{0.0};
  glm::dvec4 lx{0.0};
  double area_m2 = 0.0;
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
    const auto whole = [](double value, double unit) { return static_cast<std::int64_t>(std::llround(value / unit)); };
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

/// What falls on a triangle besides what is reflected, which is even.
std::vector<Sample> samples_of(const FixedLight& light, const SceneChunk& chunk, const SceneMaterial& material,
                               const FixedMesh& mesh, std::size_t t, double sample_m2) {
  std::array<glm::dvec3, 3> at_m, normals;
  std::array<glm::dvec4, 3> lx;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = mesh.indices[t + k];
    at_m[k] = glm::dvec3(mesh.vertices[vertex].position_m), normals[k] = glm::dvec3(mesh.vertices[vertex].normal);
    lx[k] = direct_lx(mesh, vertex);
  }
  const double area_m2 = 0.5 * glm::length(glm::cross(at_m[1] - at_m[0], at_m[2] - at_m[0]));
  const std::size_t most = std::min(kMostSamples, static_cast<std::size_t>(area_m2 / sample_m2));
  std::vector<Sample> samples;
  bool smooth = true;
  while (samples.size() < (smooth ? std::min(most, kFirstSamples) : most)) {
    Sample& sample = samples.emplace_back();
    sample.weight = place_in_triangle(samples.size() - 1);
    const auto between = [&weight = sample.weight](const auto& of) {
      return weight[0] * of[0] + weight[1] * of[1] + weight[2] * of[2];
    };
    const glm::dvec4 none(0.0);
    sample.lx = glm::dvec4(
        light.at(chunk.origin_m + between(at_m), glm::normalize(between(normals)), material, nullptr, nullptr, &none)
            .light);
    smooth = smooth && std::abs(sample.lx.w - between(lx).w) < kSmooth * std::max(sample.lx.w, kLeast_lx);
  }
  for (Sample& sample : samples) sample.area_m2 = area_m2 / static_cast<double>(samples.size());
  return samples;
}

void fit_level(const FixedLight& light, const Scene& scene, std::vector<FixedLight::Meshes>& meshes, std::size_t level,
               double least_edge_m) {
  const double apart_m = (level == 0 ? kApart : kFarApart) * least_edge_m;
  std::vector<std::vector<std::vector<Sample>>> taken(meshes.size());
  on_all_cores(meshes.size(), [&](std::size_t c) {
    const SceneChunk& chunk = scene.chunks[c];
    const FixedMesh& mesh = meshes[c][level];
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3)
      taken[c].push_back(samples_of(light, chunk, scene.materials[chunk.material], mesh, t, apart_m * apart_m));
  });

  Corners corners;
  std::vector<std::vector<std::uint32_t>> corner_of(meshes.size());
  std::vector<glm::dvec4> fitted_lx;
  std::vector<double> weight_m2;
  std::vector<Sample> all;
  for (std::size_t c = 0; c < meshes.size(); ++c) {
    const SceneChunk& chunk = scene.chunks[c];
    const FixedMesh& mesh = meshes[c][level];
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const SceneVertex& vertex = mesh.vertices[v];
      const std::uint32_t corner =
          corners.at(chunk.material, chunk.origin_m + glm::dvec3(vertex.position_m), glm::dvec3(vertex.normal));
      corner_of[c].push_back(corner);
      fitted_lx.resize(corners.size());
      fitted_lx[corner] = direct_lx(mesh, v);
    }
    weight_m2.resize(corners.size(), 0.0);
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const std::array<std::uint32_t, 3> of{corner_of[c][mesh.indices[t]], corner_of[c][mesh.indices[t + 1]],
                                            corner_of[c][mesh.indices[t + 2]]};
      for (Sample& sample : taken[c][t / 3]) {
        sample.corner = of;
        for (glm::length_t k = 0; k < 3; ++k)
          weight_m2[of[static_cast<std::size_t>(k)]] += sample.area_m2 * sample.weight[k];
        all.push_back(sample);
      }
    }
    taken[c].clear();
  }

  const std::vector<glm::dvec4> before_lx = fitted_lx;
  std::vector<glm::dvec4> change(fitted_lx.size());
  for (int step = 0; step < kSteps; ++step) {
    std::ranges::fill(change, glm::dvec4(0.0));
    for (const Sample& sample : all) {
      glm::dvec4 off = sample.lx;
      for (glm::length_t k = 0; k < 3; ++k)
        off -= sample.weight[k] * fitted_lx[sample.corner[static_cast<std::size_t>(k)]];
      for (glm::length_t k = 0; k < 3; ++k)
        change[sample.corner[static_cast<std::size_t>(k)]] += sample.area_m2 * sample.weight[k] * off;
    }
    for (std::size_t i = 0; i < fitted_lx.size(); ++i)
      if (weight_m2[i] > 0.0) fitted_lx[i] = glm::max(fitted_lx[i] + change[i] / weight_m2[i], 0.0);
  }
  for (std::size_t c = 0; c < meshes.size(); ++c) {
    FixedMesh& mesh = meshes[c][level];
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const std::uint32_t corner = corner_of[c][v];
      mesh.light[v].light += glm::vec4(fitted_lx[corner] - before_lx[corner]);
    }
  }
}

}  // namespace

void fit_light(const FixedLight& light, const Scene& scene, std::vector<FixedLight::Meshes>& meshes,
               const std::array<double, 1 + kFarLevels.size()>& least_edges_m) {
  for (std::size_t level = 0; level < least_edges_m.size(); ++level)
    fit_level(light, scene, meshes, level, least_edges_m[level]);
}

}  // namespace phare
