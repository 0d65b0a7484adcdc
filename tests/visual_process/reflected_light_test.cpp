// unit: light that covered surfaces send on to each other, against closed forms; how far what is drawn of it is off.
#include "visual/reflected_light.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>

#include "config/base/paths.h"
#include "tests/paths.h"
#include "visual/fixed_light.h"
#include "visual/process/point_reading.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

void add_quad(Scene& scene, const char* node, const std::array<glm::vec3, 4>& corners, std::uint32_t material = 0) {
  SceneChunk chunk{.node = node, .material = material, .low_m = glm::dvec3(1e9), .high_m = glm::dvec3(-1e9)};
  chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size()), chunk.vertex_count = 4;
  chunk.first_index = static_cast<std::uint32_t>(scene.indices.size()), chunk.index_count = 6;
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (const glm::vec3& corner : corners) {
    scene.vertices.push_back({corner, normal});
    chunk.low_m = glm::min(chunk.low_m, glm::dvec3(corner)), chunk.high_m = glm::max(chunk.high_m, glm::dvec3(corner));
  }
  scene.indices.insert(scene.indices.end(), {0, 1, 2, 0, 2, 3});
  scene.chunks.push_back(chunk);
}

SceneMaterial covered(const glm::vec3& reflectance) {
  return {.name = "plain", .reflectance = reflectance, .sky_share = 0.0f};
}

/// The six faces of a room, as wide and long as high, seen from within, the middle of its floor the origin.
Scene room(const glm::vec3& reflectance, float high_m = 10.0f) {
  Scene scene;
  scene.materials = {covered(reflectance)};
  const auto p = [&](int x, int y, int z) {
    return high_m * glm::vec3(x ? 0.5f : -0.5f, y ? 0.5f : -0.5f, z ? 1.0f : 0.0f);
  };
  add_quad(scene, "floor", {p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0)});
  add_quad(scene, "roof", {p(0, 0, 1), p(0, 1, 1), p(1, 1, 1), p(1, 0, 1)});
  add_quad(scene, "back", {p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1)});
  add_quad(scene, "front", {p(1, 0, 0), p(1, 0, 1), p(1, 1, 1), p(1, 1, 0)});
  add_quad(scene, "right", {p(0, 0, 0), p(0, 0, 1), p(1, 0, 1), p(1, 0, 0)});
  add_quad(scene, "left", {p(0, 1, 0), p(1, 1, 0), p(1, 1, 1), p(0, 1, 1)});
  return scene;
}

/// Of 1000 cd in every direction: 4000·pi lm; or only below, nearly at the roof of a room of 3.5 m.
fs::path lamps_file(const char* reflected, bool under_the_roof = false) {
  const std::string pid = std::to_string(::getpid());
  const fs::path luminaire = fs::path(testing::TempDir()) / (pid + "_even.ies");
  std::ofstream(luminaire) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n"
                              "1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 "
                           << (under_the_roof ? 90 : 180) << "\n0\n1000 1000\n";
  const fs::path lamps = fs::path(testing::TempDir()) / (pid + "_room_lamps.toml");
  std::ofstream(lamps) << "fineness = \"fine\"\nreflected = \"" << reflected
                       << "\"\n[[luminaire]]\nname = \"even\"\nfile = \"" << luminaire.string()
                       << "\"\n[[lamp]]\nluminaire = \"even\"\nposition_m = "
                       << (under_the_roof ? "[0.2, 0.1, 3.4]\n" : "[1, 0.5, 6]\n");
  return lamps;
}

/// All that a closed room is given it keeps: of the flux F on surfaces A, which send rho of it on, surfaces have
/// F/(A·(1 - rho)) in the mean, and what is sent once is rho·F/A. Off by what a mean of so many random places is (three
/// times its deviation), and for patches by what their middle is off their mean where the lamp is nearest, 4 m away: E
/// is curved by 3/16 there both ways, and a halved face's triangle has its corners' spread 1.25²/18 both ways: 1.6 %.
TEST(ReflectedLight, AClosedRoomKeepsAllThatItIsGiven) {
  for (const float rho : {0.3f, 0.8f}) {
    const Scene scene = room(glm::vec3(rho, 0.5f * rho, rho));
    const auto bare = FixedLight::of(scene, lamps_file("off"), std::nullopt);
    ASSERT_TRUE(bare);
    EXPECT_EQ(bare->reflecting(), 0u);
    const glm::dvec4 lit(bare->at({0, 0, 0}, {0, 0, 1}, {}).light);
    const glm::dvec3 each(rho, 0.5f * rho, rho), given = 4000.0 * std::numbers::pi / 600.0 * glm::dvec3(lit) / lit.w;
    for (const bool once : {true, false}) {
      const auto light = FixedLight::of(scene, lamps_file(once ? "once" : "all"), std::nullopt);
      ASSERT_TRUE(light) << light.error().text();
      EXPECT_GT(light->reflecting(), 100u);
      std::mt19937_64 random(1984);
      std::uniform_real_distribution<double> even(-1.0, 1.0);
      constexpr int kPlaces = 600;
      glm::dvec3 mean(0.0), squares(0.0);
      for (int i = 0; i < kPlaces; ++i) {
        const double u = 5.0 * even(random), v = 5.0 * even(random);
        const int axis = i % 3;
        const double side = i % 6 < 3 ? -1.0 : 1.0;
        glm::dvec3 at(0.0), normal(0.0);
        at[axis] = 5.0 * side, normal[axis] = -side;
        at[(axis + 1) % 3] = u, at[(axis + 2) % 3] = v;
        const glm::dvec4 lx = light->reflected_at(at + glm::dvec3(0, 0, 5), normal, {});
        mean += glm::dvec3(lx) / static_cast<double>(kPlaces);
        squares += glm::dvec3(lx) * glm::dvec3(lx) / static_cast<double>(kPlaces);
      }
      for (int c : {0, 1}) {
        const double expected = once ? each[c] * given[c] : given[c] * each[c] / (1.0 - each[c]);
        const double deviation = std::sqrt((squares[c] - mean[c] * mean[c]) / kPlaces);
        std::printf(
            "room, rho %.2f, %s: %.4f lx reflected in the mean, by the closed form %.4f, %+.2f %% (mean of places +- "
            "%.2f %%)\n",
            each[c], once ? "once" : "all ", mean[c], expected, 100.0 * (mean[c] / expected - 1.0),
            100.0 * deviation / expected);
        EXPECT_NEAR(mean[c], expected, 3.0 * deviation + 0.016 * expected);
      }
    }
  }
}

/// What is sent on for ever would have no end: no surface sends more than 95 % on, in whatever file it says so.
TEST(ReflectedLight, AWhiteRoomIsAsBrightAsSnow) {
  const auto white = FixedLight::of(room(glm::vec3(1.0f)), lamps_file("all"), std::nullopt);
  const auto snow = FixedLight::of(room(glm::vec3(0.95f)), lamps_file("all"), std::nullopt);
  ASSERT_TRUE(white && snow);
  const double lx = white->reflected_at({2, 1, 0}, {0, 0, 1}, {}).w;
  EXPECT_NEAR(lx, snow->reflected_at({2, 1, 0}, {0, 0, 1}, {}).w, 1e-6 * lx);
  EXPECT_NEAR(lx, 4000.0 * std::numbers::pi / 600.0 * 0.95 / 0.05, 0.05 * lx) << "19 times what the lamp gives";
}

/// Of a corner of a rectangle h above the corner of another, and as wide and long: the view factor from a point
/// (Howell, A Catalog of Radiation Configuration Factors, C-11).
double corner_factor(double wide_m, double long_m, double high_m) {
  const double x = std::abs(wide_m) / high_m, y = std::abs(long_m) / high_m;
  const double a = std::sqrt(1.0 + x * x), b = std::sqrt(1.0 + y * y);
  return std::copysign(1.0, wide_m * long_m) * (x / a * std::atan(y / a) + y / b * std::atan(x / b)) /
         (2.0 * std::numbers::pi);
}

/// Under a roof with 100 lx everywhere, which sends a half of it on. So many rays see an edge off by N^-3/4 of all.
TEST(ReflectedLight, UnderAnEvenlyLitRoofItIsTheViewFactor) {
  Scene scene;
  scene.materials = {covered(glm::vec3(0.5f))};
  constexpr double kWide_m = 2.0, kLong_m = 3.0, kHigh_m = 3.0;
  const auto corner = [](double x, double y) { return glm::vec3(x, y, kHigh_m); };
  add_quad(
      scene, "roof",
      {corner(-kWide_m, -kLong_m), corner(-kWide_m, kLong_m), corner(kWide_m, kLong_m), corner(kWide_m, -kLong_m)});
  const ReflectedLight light(scene, Reflected::kOnce,
                             [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec4(100.0); }, {});
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 2.0}, {2.0, 0.0}, {3.0, 1.0}, {0.0, 6.0}}) {
    double factor = 0.0;
    for (const double side : {-1.0, 1.0})
      for (const double end : {-1.0, 1.0}) factor += corner_factor(kWide_m + side * x, kLong_m + end * y, kHigh_m);
    const double lx = light.at({x, y, 0.0}, {0, 0, 1}).w;
    std::printf("under a roof at (%.0f, %.0f) m: %.3f lx, by the view factor %.3f\n", x, y, lx, 50.0 * factor);
    EXPECT_NEAR(lx, 50.0 * factor, 50.0 * std::pow(128.0, -0.75));
    EXPECT_EQ(light.at({x, y, 0.0}, {0, 0, -1}).w, 0.0) << "from below there comes nothing";
    // What moves asks for it by directions: so many see the roof, give or take those that its edges cut.
    double on_level = 0.0;
    int met = 0;
    light.each_way({x, y, 0.0}, [&](const glm::dvec3& way, const glm::dvec4& facing) {
      on_level += facing.w * std::max(way.z, 0.0), ++met;
    });
    EXPECT_NEAR(on_level, 50.0 * factor, 50.0 * factor / std::sqrt(met));
  }
  EXPECT_EQ(light.at({kWide_m + kReflectedReach_m + 1.0, 0.0, 0.0}, {0, 0, 1}).w, 0.0) << "out of reach";
}

/// Vertices lie where walls meet. As much as a hand's width beside, but for what light changes over 5 cm of 10 m and
/// for the rays (above, of a roof of which all is seen: of all the light).
TEST(ReflectedLight, CornersAreNotDarkForWhatLiesBeyond) {
  const Scene scene = room(glm::vec3(0.5f));
  const auto light = FixedLight::of(scene, lamps_file("all"), std::nullopt);
  ASSERT_TRUE(light);
  for (const glm::dvec3& at : {glm::dvec3(-5, -5, 0), {5, -5, 0}, {5, 5, 0}, {0, 5, 0}, {-5, 1, 0}}) {
    const double here = light->reflected_at(at, {0, 0, 1}, {}).w;
    const glm::dvec3 inside = at - 0.05 * glm::sign(at);
    const double beside = light->reflected_at(inside, {0, 0, 1}, {}).w;
    EXPECT_NEAR(here, beside, 0.05 * beside) << at.x << " " << at.y;
  }
}

/// What a pixel gets, interpolated from the corners, against what is asked for at its place.
TEST(ReflectedLight, InTheTunnelThereIsMuchOfIt) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/tunnel.glb");
  ASSERT_TRUE(scene) << scene.error().text();
  const auto light = FixedLight::of(*scene, generated_dir() / "scenes/tunnel_lamps.toml", std::nullopt);
  ASSERT_TRUE(light) << light.error().text();
  Scene part = *scene;
  part.chunks.clear();
  std::map<std::uint32_t, int> of_material;  // a part of each, so that the test takes seconds
  for (const SceneChunk& chunk : scene->chunks) {
    const SceneMaterial& material = scene->materials[chunk.material];
    if (material.sky_share < 1.0f && material.emission_cdm2 == glm::vec3(0.0f) &&
        of_material[chunk.material]++ % 5 == 2)
      part.chunks.push_back(chunk);
  }
  ASSERT_FALSE(part.chunks.empty());
  const auto meshes = light->meshes(part);
  struct Sum {
    double area = 0.0, lx = 0.0, reflected = 0.0, off = 0.0;
  };
  std::map<std::string, Sum> sums;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  for (std::size_t c = 0; c < meshes.size(); ++c) {
    const FixedMesh& mesh = meshes[c][0];
    const SceneMaterial& material = part.materials[part.chunks[c].material];
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 18) {
      double u = even(random), v = even(random);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const std::array<double, 3> weights{1.0 - u - v, u, v};
      glm::dvec3 at = part.chunks[c].origin_m, normal(0.0);
      std::array<glm::dvec3, 3> corners;
      double lx = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t index = mesh.indices[t + k];
        corners[k] = glm::dvec3(mesh.vertices[index].position_m);
        at += weights[k] * corners[k], normal += weights[k] * glm::dvec3(mesh.vertices[index].normal);
        lx += weights[k] * static_cast<double>(mesh.light[index].light.w);
      }
      normal = glm::normalize(normal);
      const double area = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
      const double exact = static_cast<double>(light->at(at, normal, material).light.w);
      Sum& sum = sums[material.name];
      sum.area += area, sum.lx += area * exact, sum.off += area * std::abs(lx - exact);
      sum.reflected += area * light->reflected_at(at, normal, material).w;
    }
  }
  std::printf("%zu pieces\n", light->reflecting());
  for (const auto& [name, sum] : sums) {
    std::printf("%-22s %.2f lx, %.1f %% of it reflected; corners off by %.2f %%\n", name.c_str(), sum.lx / sum.area,
                100.0 * sum.reflected / sum.lx, 100.0 * sum.off / sum.lx);
    EXPECT_GT(sum.reflected, 0.05 * sum.lx) << name;
    // The level's tolerance twice, as on open ground.
    EXPECT_LT(sum.off, 2.0 * kBakeLevels[2].tolerance * sum.lx) << name;
  }
  EXPECT_GT(sums["vault"].reflected, 0.3 * sums["vault"].lx) << "the lamps below it give it nothing";
}

/// Where nothing covers a point, its shares are the light that a vertex keeps there.
TEST(ReflectedLight, APointHasWhatVerticesKeep) {
  const Scene scene = room(glm::vec3(0.5f));
  const auto light = FixedLight::of(scene, lamps_file("all"), std::nullopt);
  ASSERT_TRUE(light);
  for (const glm::dvec3& at : {glm::dvec3(0, 0, 0), {3, -2, 0}, {-4.9, 4.9, 0}}) {
    const std::vector<FixedLight::Share> shares = light->shares_at(at, {0, 0, 1});
    EXPECT_EQ(std::ranges::count(shares, true, &FixedLight::Share::reflected), 1);
    EXPECT_EQ(shares.size(), 2u);
    double sum = 0.0;
    for (const FixedLight::Share& share : shares) sum += share.lx;
    EXPECT_NEAR(static_cast<double>(light->at(at, {0, 0, 1}, {}).light.w), sum, 1e-6 * sum);
  }
}

/// A roof that no lamp shines at, in one quad of 3.5 m: darkest above the lamp. Sides longer than 2 m are asked in
/// their middle, and what is left is what rays are off by: N^-3/4 of the brightest that they see, the walls 1.5 m
/// beside the lamp, which send a half of 1000/1.55² lx on.
TEST(ReflectedLight, ARoofThatNoLampShinesAtIsCutForIt) {
  const Scene scene = room(glm::vec3(0.5f), 3.5f);
  const auto light = FixedLight::of(scene, lamps_file("all", true), std::nullopt);
  ASSERT_TRUE(light);
  const FixedMesh roof = light->meshes(scene)[1][0];
  EXPECT_GT(roof.indices.size(), 6u);
  double lowest = 1e9, highest = 0.0, mean = 0.0;
  for (std::size_t t = 0; t + 2 < roof.indices.size(); t += 3) {
    glm::dvec3 at(0.0);
    double lx = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      at += glm::dvec3(roof.vertices[roof.indices[t + k]].position_m) / 3.0;
      lx += static_cast<double>(roof.light[roof.indices[t + k]].light.w) / 3.0;
    }
    const double exact = light->reflected_at(at, {0, 0, -1}, scene.materials[0]).w;
    EXPECT_EQ(light->shares_at(at, {0, 0, -1}).size(), 1u) << "no lamp shines at it";
    lowest = std::min(lowest, exact), highest = std::max(highest, exact);
    mean += std::abs(lx - exact) * 3.0 / static_cast<double>(roof.indices.size());
  }
  std::printf("a roof in %zu triangles: %.0f to %.0f lx, off by %.1f in the mean\n", roof.indices.size() / 3, lowest,
              highest, mean);
  const double rays_lx = 0.5 * 1000.0 / (1.55 * 1.55) * std::pow(128.0, -0.75);
  EXPECT_LT(mean, rays_lx);
  EXPECT_GT(highest - lowest, 4.0 * rays_lx) << "there is something to be cut for";
}

TEST(ReflectedLight, AClickTellsIt) {
  PointReading reading;
  reading.fixed = {{.lamp = 3, .lx = 4.0}, {.reflected = true, .lx = 1.0}};
  reading.fixed_lx = 5.0;
  const auto line = [&] { return lines_of(reading).at(2); };
  EXPECT_EQ(line(), "  besides, of what stands: 5 lx by one lamp and what walls and roof reflect, 4 of street lamp 4");
  reading.fixed = {{.reflected = true, .lx = 5.0}};
  EXPECT_EQ(line(), "  besides, of what stands: 5 lx by what walls and roof reflect, 5 of walls and roof");
}

/// Ground of 4 km would be cut into 8 million pieces of 2 m, and a mesh of more triangles than that is left alone.
TEST(ReflectedLight, LargeScenesHaveLongerPiecesOrNone) {
  const ReflectedLight::Direct direct = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec4(10.0); };
  Scene scene;
  scene.materials = {covered(glm::vec3(0.5f))};
  add_quad(scene, "ground", {glm::vec3(-2000, -2000, 0), {2000, -2000, 0}, {2000, 2000, 0}, {-2000, 2000, 0}});
  const ReflectedLight ground(scene, Reflected::kOnce, direct, {});
  EXPECT_FALSE(ground.too_many());
  EXPECT_GT(ground.patches(), 50000u);
  EXPECT_LE(ground.patches(), 200000u);
  EXPECT_NEAR(ground.at({10, 10, 1}, {0, 0, -1}).w, 5.0, 5.0 * std::pow(128.0, -0.75)) << "all below is ground";
  for (int i = 0; i < 200000; ++i) scene.indices.insert(scene.indices.end(), {0, 1, 2});
  scene.chunks[0].index_count += 600000;
  const ReflectedLight none(scene, Reflected::kAll, direct, {});
  EXPECT_TRUE(none.too_many());
  EXPECT_EQ(none.patches(), 0u);
  EXPECT_EQ(none.at({10, 10, 1}, {0, 0, -1}).w, 0.0);
}

/// No roof, no piece, no ray.
TEST(ReflectedLight, WhereNothingIsCoveredThereIsNone) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/town.glb");
  ASSERT_TRUE(scene) << scene.error().text();
  const auto light = FixedLight::of(*scene, generated_dir() / "scenes/town_lamps.toml", std::nullopt);
  ASSERT_TRUE(light) << light.error().text();
  EXPECT_EQ(light->reflecting(), 0u);
  EXPECT_EQ(light->reflected_at({20, 0, 0}, {0, 0, 1}, {}).w, 0.0);
}

}  // namespace
}  // namespace phare
