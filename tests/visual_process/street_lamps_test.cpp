// unit: street lamps as their file says, their light against closed forms, and how far what vertices keep is off.
#include "config/street_lamps.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>

#include "config/base/paths.h"
#include "tests/paths.h"
#include "visual/fixed_light.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

fs::path written(const char* name, const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / (std::to_string(::getpid()) + "_" + name);
  std::ofstream(file) << text;
  return file;
}

/// Type C, 1000 cd in every plane from gamma 0 to 90, or only in planes C 45 to 135.
fs::path even_luminaire(bool street_side_only) {
  std::string text = "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 9 1 2 0 0 0\n1 1 0\n0 90\n";
  for (int c = 0; c <= 360; c += 45) text += std::to_string(c) + (c < 360 ? " " : "\n");
  for (int c = 0; c <= 360; c += 45) text += !street_side_only || c == 90 ? "1000 1000\n" : "0 0\n";
  return written(street_side_only ? "street_side.ies" : "even.ies", text);
}

std::string lamp_text(double x, double y, double z, double yaw_deg = 0.0, double tilt_deg = 0.0) {
  return "[[lamp]]\nluminaire = \"even\"\nposition_m = [" + std::to_string(x) + ", " + std::to_string(y) + ", " +
         std::to_string(z) + "]\nyaw_deg = " + std::to_string(yaw_deg) + "\ntilt_deg = " + std::to_string(tilt_deg) +
         "\n";
}

fs::path lamps_file(const std::string& lamps, bool street_side_only = false, const char* fineness = "medium") {
  return written("lamps.toml", "fineness = \"" + std::string(fineness) +
                                   "\"\n[[luminaire]]\nname = \"even\"\nfile = \"" +
                                   even_luminaire(street_side_only).string() + "\"\n" + lamps);
}

/// A level square about the origin in one quad.
Scene square(double half_m = 60.0) {
  Scene scene;
  scene.materials = {{.name = "ground", .reflectance = glm::vec3(0.2f)}};
  const float h = static_cast<float>(half_m);
  for (const auto& [x, y] : {std::pair(-h, -h), std::pair(h, -h), std::pair(h, h), std::pair(-h, h)})
    scene.vertices.push_back({glm::vec3(x, y, 0), glm::vec3(0, 0, 1)});
  scene.indices = {0, 1, 2, 0, 2, 3};
  scene.chunks = {{.node = "ground",
                   .low_m = {-half_m, -half_m, 0},
                   .high_m = {half_m, half_m, 0},
                   .index_count = 6,
                   .vertex_count = 4}};
  return scene;
}

/// A level board over the square, of the scene's last material.
void add_board(Scene& scene, const glm::vec3& low_m, const glm::vec3& high_m) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const auto& [x, y] : {std::pair(low_m.x, low_m.y), std::pair(high_m.x, low_m.y), std::pair(high_m.x, high_m.y),
                             std::pair(low_m.x, high_m.y)})
    scene.vertices.push_back({glm::vec3(x, y, low_m.z), glm::vec3(0, 0, 1)});
  scene.chunks.push_back({.node = "board",
                          .material = static_cast<std::uint32_t>(scene.materials.size()) - 1,
                          .low_m = low_m,
                          .high_m = high_m,
                          .index_count = 6,
                          .first_vertex = first,
                          .vertex_count = 4});
}

TEST(StreetLamps, BadFilesAreRefusedWithPlaceAndReason) {
  const struct {
    const char* text;
    const char* says;
  } cases[] = {
      {"", "luminaire"},
      {"[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\n[[lamp]]\nluminaire = \"b\"\nposition_m = [0, 0, 5]\n",
       "bad.toml:5: \"lamp.luminaire\": no luminaire \"b\""},
      {"[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\n[[lamp]]\nluminaire = \"a\"\nposition_m = [0, 5]\n",
       "bad.toml:6: "},
      {"[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\nscale = -1\n", "bad.toml:4: "},
      {"[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\ncolour_temperature_k = 1200\n",
       "bad.toml:4: \"luminaire.colour_temperature_k\": 1200 is outside 1667 … 25000"},
      {"[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\n[[luminaire]]\nname = \"a\"\nfile = \"b.ies\"\n",
       "bad.toml:5: \"luminaire.name\": two luminaires are named \"a\""},
      {"[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\n[[lamp]]\nluminaire = \"a\"\nposition_m = [0, 0, 1e9]\n",
       "10,000 km"},
      {"reflected = \"twice\"\n[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\n", "bad.toml:1: "},
      {"fineness = \"finest\"\n[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\n", "bad.toml:1: "},
      {"[[luminaire]]\nname = \"a\"\nfile = \"a.ies\"\n[[lamp]]\nluminaire = \"a\"\nposition_m = [0, 0, 5]\n"
       "yaw = 3\n",
       "bad.toml:7: "}};
  for (const auto& [text, says] : cases) {
    const auto read = read_street_lamps(written("bad.toml", text));
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().text().find(says), std::string::npos) << read.error().text();
  }
  const auto missing =
      FixedLight::of(square(), written("bad.toml", "[[luminaire]]\nname = \"a\"\nfile = \"none.ies\"\n"), std::nullopt);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().text().find("none.ies"), std::string::npos);
}

TEST(StreetLamps, ALampThatIsOffIsCountedAndDark) {
  const auto read = read_street_lamps(lamps_file(lamp_text(0, 0, 8) + "on = false\n" + lamp_text(9, 0, 8)));
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->lamps.size(), 1u);
  EXPECT_EQ(read->off, 1u);
}

TEST(StreetLamps, LuxIsThatOfTheClosedForm) {
  const auto light = FixedLight::of(Scene{}, lamps_file(lamp_text(3, 1, 8) + lamp_text(-20, 4, 6)), std::nullopt);
  ASSERT_TRUE(light) << light.error().text();
  for (const glm::dvec3& at : {glm::dvec3(0, 0, 0), glm::dvec3(12, -7, 0), glm::dvec3(-30, 2, 1.5)}) {
    double expected = 0.0;
    for (const glm::dvec3& lamp : {glm::dvec3(3, 1, 8), glm::dvec3(-20, 4, 6)}) {
      const double r = glm::distance(lamp, at);
      expected += 1000.0 * (lamp.z - at.z) / (r * r * r);
    }
    EXPECT_NEAR(light->lux_at(at, {0, 0, 1}), expected, 1e-12 * expected);
  }
}

/// C 90 lies toward yaw, C 0 on the right of who looks there; a tilted lamp looks up toward the same side.
TEST(StreetLamps, TheStreetSideLiesTowardYaw) {
  const auto at = [](double yaw_deg, double tilt_deg, const glm::dvec3& point) {
    const auto light = FixedLight::of(Scene{}, lamps_file(lamp_text(0, 0, 8, yaw_deg, tilt_deg), true), std::nullopt);
    return light ? light->lux_at(point, {0, 0, 1}) : -1.0;
  };
  const double ahead = 1000.0 * 8.0 / std::pow(64.0 + 25.0, 1.5);
  EXPECT_NEAR(at(0.0, 0.0, {5, 0, 0}), ahead, 1e-9);
  EXPECT_EQ(at(0.0, 0.0, {-5, 0, 0}), 0.0);
  EXPECT_NEAR(at(90.0, 0.0, {0, 5, 0}), ahead, 1e-9);
  EXPECT_EQ(at(90.0, 0.0, {0, -5, 0}), 0.0);
  EXPECT_EQ(at(0.0, 0.0, {0, 5, 0}), 0.0);
  // Straight below an upright lamp lies in every plane; of a tilted one, away from the street.
  EXPECT_EQ(at(0.0, 20.0, {0, 0, 0}), 0.0);
  EXPECT_GT(at(0.0, 20.0, {8.0, 0, 0}), 0.0);
}

// A file whose plane C 0 is the street side, mirrored ones, and the second of a file's lamp sets.
TEST(StreetLamps, AFileIsReadAsItsLuminaireSays) {
  const auto at = [](const std::string& keys, const glm::dvec3& point) {
    const std::string text = "[[luminaire]]\nname = \"even\"\nfile = \"" + even_luminaire(true).string() + "\"\n" +
                             keys + lamp_text(0, 0, 8);
    const auto light = FixedLight::of(Scene{}, written("turned.toml", text), std::nullopt);
    return light ? light->lux_at(point, {0, 0, 1}) : -1.0;
  };
  const double lit = 1000.0 * 8.0 / std::pow(64.0 + 25.0, 1.5);
  EXPECT_NEAR(at("", {5, 0, 0}), lit, 1e-9);
  // C 90, which is lit, lies a quarter on: to the left of who looks along yaw.
  EXPECT_NEAR(at("c0_deg = 90\n", {0, 5, 0}), lit, 1e-9);
  EXPECT_EQ(at("c0_deg = 90\n", {5, 0, 0}), 0.0);
  EXPECT_NEAR(at("c0_deg = 90\nmirror = true\n", {0, -5, 0}), lit, 1e-9);
  EXPECT_EQ(at("lamp_set = 2\n", {5, 0, 0}), -1.0) << "the file has one";
  EXPECT_EQ(at("emitter = 2\n", {5, 0, 0}), -1.0) << "the file has one";
}

TEST(StreetLamps, WhatStandsHidesAndTheMoonIsALamp) {
  Scene scene = square();
  add_board(scene, {5, -2, 3}, {6, 2, 3});
  const MoonConfig moon{.azimuth_rad = 0.0, .elevation_rad = 0.5 * std::numbers::pi, .illuminance_lx = 0.2};
  const auto light = FixedLight::of(scene, lamps_file(lamp_text(0, 0, 8)), moon);
  ASSERT_TRUE(light);
  // Under the board the moon is hidden; where the line to the lamp meets the board, 5.5/(8 - 3)·8 m away, the lamp is.
  EXPECT_EQ(light->shares_at({5.5, 0, 0}, {0, 0, 1}).size(), 1u);
  const auto behind = light->shares_at({8.8, 0, 0}, {0, 0, 1});
  ASSERT_EQ(behind.size(), 1u);
  EXPECT_FALSE(behind[0].lamp.has_value());
  EXPECT_NEAR(behind[0].lx, 0.2, 1e-12);
  EXPECT_EQ(light->shares_at({-8.8, 0, 0}, {0, 0, 1}).size(), 2u);
  EXPECT_TRUE(light->glare_at({8.8, 0, 0}, {}).empty());
  EXPECT_EQ(light->glare_at({-8.8, 0, 1}, {}).size(), 1u);
}

/// An opening of 40 cm, 8 m up, over the edge of a board halfway up: a point sees the share on the other side of the
/// way over that edge. A lamp without an opening is a point.
TEST(StreetLamps, AnOpeningIsHiddenInPart) {
  Scene scene = square();
  scene.materials.push_back({.name = "board", .double_sided = true});
  add_board(scene, {0, -2, 4}, {4, 2, 4});
  const auto light_of = [&](const char* name, const char* sizes) {
    const fs::path lamp = written(name, "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 1 1 2 " +
                                            std::string(sizes) + "\n1 1 0\n0 90\n0\n1000 1000\n");
    return FixedLight::of(scene,
                          written("opening.toml", "[[luminaire]]\nname = \"even\"\nfile = \"" + lamp.string() + "\"\n" +
                                                      lamp_text(0, 0, 8)),
                          std::nullopt);
  };
  const auto wide = light_of("wide.ies", "0.4 0.4 0"), point = light_of("point.ies", "0 0 0");
  ASSERT_TRUE(wide) << wide.error().text();
  ASSERT_TRUE(point) << point.error().text();
  const double most = 0.15;  // as kOpeningRays has it
  for (double x = -0.3; x < 0.3; x += 0.01) {
    const glm::dvec3 at(x, 0.0, 0.0);
    const double whole_lx = 1000.0 * 8.0 / std::pow(64.0 + x * x, 1.5);
    const double open = std::clamp(0.5 - x / 0.4, 0.0, 1.0);  // what lies above the way over the edge, at -x
    EXPECT_NEAR(wide->lux_at(at, {0, 0, 1}) / whole_lx, open, most + 1e-9) << x;
    EXPECT_NEAR(point->lux_at(at, {0, 0, 1}) / whole_lx, x < 0.0 ? 1.0 : 0.0, 1e-9) << x;
  }
  EXPECT_TRUE(wide->hidden_at({0.1, 0, 0}, {0, 0, 1}).empty()) << "half of it shines there";
  EXPECT_EQ(wide->hidden_at({0.3, 0, 0}, {0, 0, 1}).size(), 1u);
}

/// What moves: a lamp's own E·cos(q) against E·(1/4 + cos(q)/2), which is a quarter off at worst (q = 0, 90° and 180°).
/// A plate of 1 m, 5 cm thick, on the ground: what lies under it nobody sees, and it must not darken what lies around.
TEST(StreetLamps, WhatNobodySeesIsNoShadowOnWhatIsSeen) {
  Scene scene = square();
  SceneChunk plate{.node = "plate", .low_m = {-0.5, -0.5, 0.0}, .high_m = {0.5, 0.5, 0.05}};
  plate.first_index = static_cast<std::uint32_t>(scene.indices.size());
  plate.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  for (int i = 0; i < 8; ++i)
    scene.vertices.push_back({{i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.05f : 0.0f}, {0, 0, 1}});
  for (const auto& f : {std::array{0u, 2u, 3u, 1u},
                        {4u, 5u, 7u, 6u},
                        {0u, 1u, 5u, 4u},
                        {2u, 6u, 7u, 3u},
                        {0u, 4u, 6u, 2u},
                        {1u, 3u, 7u, 5u}})
    scene.indices.insert(scene.indices.end(), {f[0], f[1], f[2], f[0], f[2], f[3]});
  plate.index_count = 36, plate.vertex_count = 8;
  const auto bare = FixedLight::of(square(), lamps_file(lamp_text(3, 0, 3)), std::nullopt);
  scene.chunks.push_back(plate);
  const auto light = FixedLight::of(scene, lamps_file(lamp_text(3, 0, 3)), std::nullopt);
  ASSERT_TRUE(bare && light);
  const glm::dvec3 up(0, 0, 1), under(0.2, 0.1, 0.0), beside(1.0, 0.0, 0.0), behind(-0.52, 0.0, 0.0);
  const SceneMaterial& ground = scene.materials[0];
  EXPECT_EQ(light->lux_at(under, up), 0.0) << "as a point it is dark";
  EXPECT_NEAR(light->at(under, up, ground).light.w, bare->lux_at(under, up), 1e-5 * bare->lux_at(under, up));
  EXPECT_EQ(static_cast<double>(light->at(beside, up, ground).light.w),
            static_cast<double>(static_cast<float>(light->lux_at(beside, up))));
  EXPECT_EQ(light->at(behind, up, ground).light.w, 0.0f) << "the plate's own shadow stays";
}

TEST(StreetLamps, TheProbeOfWhatMovesIsWithinAQuarter) {
  const auto light = FixedLight::of(Scene{}, lamps_file(lamp_text(0, 0, 8)), std::nullopt);
  ASSERT_TRUE(light);
  const glm::dvec3 at{4, 3, 1};
  const FixedProbe probe = light->probe(at);
  const double facing_lx = 1000.0 / glm::dot(glm::dvec3(0, 0, 8) - at, glm::dvec3(0, 0, 8) - at);
  EXPECT_NEAR(static_cast<double>(probe.light.w), facing_lx, 1e-6 * facing_lx);
  double worst = 0.0;
  for (int i = 0; i <= 36; ++i) {
    const double a = i * std::numbers::pi / 18.0;
    const glm::dvec3 n{std::cos(a), 0.0, std::sin(a)};
    const double by_probe = facing_lx * std::max(0.25 + glm::dot(glm::dvec3(probe.way), n), 0.0);
    worst = std::max(worst, std::abs(by_probe - light->lux_at(at, n)) / facing_lx);
  }
  EXPECT_LE(worst, 0.25 + 1e-6);
  EXPECT_GT(worst, 0.1);
}

struct Errors {
  double mean = 0.0, p95 = 0.0, worst = 0.0, mean_lx = 0.0;
  double of_vertices = 0.0;  ///< the mean, had vertices the light of their place
  std::size_t triangles = 0;
};

/// Interpolated against exact at random places of the meshes, even over their area, relative to the light there or to
/// 0.5 lx, what is larger; or to the mean light of all these places. `which_material`: of surfaces of these only.
template <typename Which>
Errors errors_of(const FixedLight& light, const Scene& scene, int samples, bool to_mean, const Which& which_material) {
  struct Piece {
    const FixedMesh* mesh;
    const SceneChunk* chunk;
    std::size_t at;
  };
  const auto meshes = light.meshes(scene);
  std::vector<Piece> pieces;
  std::vector<double> areas;
  for (std::size_t c = 0; c < meshes.size(); ++c) {
    if (!which_material(scene.materials[scene.chunks[c].material])) continue;
    const FixedMesh& mesh = meshes[c][0];
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const auto p = [&](std::size_t k) { return glm::dvec3(mesh.vertices[mesh.indices[t + k]].position_m); };
      pieces.push_back({&mesh, &scene.chunks[c], t});
      areas.push_back(glm::length(glm::cross(p(1) - p(0), p(2) - p(0))));
    }
  }
  Errors errors{.triangles = pieces.size()};
  std::mt19937_64 random(1999);
  std::discrete_distribution<std::size_t> which(areas.begin(), areas.end());
  std::uniform_real_distribution<double> even(0.0, 1.0);
  std::vector<double> all;
  for (int i = 0; i < samples; ++i) {
    const Piece& piece = pieces[which(random)];
    double u = even(random), v = even(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const std::array<double, 3> weights{1.0 - u - v, u, v};
    glm::dvec3 at = piece.chunk->origin_m, normal(0.0);
    double lx = 0.0, of_vertices_lx = 0.0;
    const SceneMaterial& material = scene.materials[piece.chunk->material];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = piece.mesh->indices[piece.at + k];
      const SceneVertex& vertex = piece.mesh->vertices[index];
      const FixedVertex there = light.at(piece.chunk->origin_m + glm::dvec3(vertex.position_m),
                                         glm::normalize(glm::dvec3(vertex.normal)), material);
      of_vertices_lx += weights[k] * static_cast<double>(there.light.w);
      at += weights[k] * glm::dvec3(vertex.position_m);
      normal += weights[k] * glm::dvec3(vertex.normal);
      lx += weights[k] * static_cast<double>(piece.mesh->light[index].light.w);
    }
    // Of what nobody sees, that which vertices keep of it.
    const double exact = static_cast<double>(light.at(at, glm::normalize(normal), material).light.w);
    const double relative_to = to_mean ? 1.0 : std::max(exact, 0.5);
    all.push_back(std::abs(lx - exact) / relative_to);
    errors.of_vertices += std::abs(of_vertices_lx - exact) / relative_to / samples;
    errors.mean_lx += exact / samples;
  }
  for (double& error : all) {
    if (to_mean) error /= errors.mean_lx;
    errors.mean += error / samples;
  }
  if (to_mean) errors.of_vertices /= errors.mean_lx;
  std::ranges::sort(all);
  errors.p95 = all[all.size() * 95 / 100], errors.worst = all.back();
  return errors;
}

/// Open ground: light is smooth. A side is left whole where its middle is within the tolerance t, or where it is
/// shorter than twice the least edge; within a triangle a quadratic is off by 4/3 of its sides' middles at most, and
/// the least edges are chosen such that lamps of 8 m stay within t there (E''/E = 3/h² on the axis: (3/8)·(2·1.5)²/64 =
/// 5 % for 1.5 m). Between them twice t, as light is not a quadratic.
TEST(StreetLamps, OnOpenGroundVerticesKeepLightWithinTwiceTheTolerance) {
  const Scene scene = square();
  double before = 1.0;
  for (const char* fineness : {"coarse", "medium", "fine"}) {
    const double tolerance = kBakeLevels[static_cast<std::size_t>(fineness[0] == 'c'   ? 0
                                                                  : fineness[0] == 'm' ? 1
                                                                                       : 2)]
                                 .tolerance;
    const auto light =
        FixedLight::of(scene, lamps_file(lamp_text(0, 4, 8) + lamp_text(30, -4, 8), false, fineness), std::nullopt);
    ASSERT_TRUE(light);
    const Errors errors = errors_of(*light, scene, 4000, false, [](const SceneMaterial&) { return true; });
    std::printf("open ground, %-6s  mean %.2f %%  95 of 100 within %.2f %%  worst %.2f %%  %zu triangles\n", fineness,
                100.0 * errors.mean, 100.0 * errors.p95, 100.0 * errors.worst, errors.triangles);
    const double least = fineness[0] == 'c' ? 0.21 : 0.0;  // (3/8)·6²/64: the coarse level's least edge
    EXPECT_LE(errors.worst, std::max(2.0 * tolerance, least)) << fineness;
    EXPECT_LT(errors.worst, before);
    before = errors.worst;
  }
}

/// Ground of two meshes that meet where a board's shadow lies: corners at one place have one light, whatever mesh they
/// are of, and there it is not that of the corner alone.
TEST(StreetLamps, MeshesThatMeetHaveOneLightThere) {
  Scene scene = square();
  const double meet_m = 7.3;
  SceneChunk& west = scene.chunks[0];
  SceneChunk east = west;
  for (const std::size_t i : {1, 2}) scene.vertices[i].position_m.x = static_cast<float>(meet_m);
  for (const auto& [x, y] : {std::pair(0.0f, -60.0f), std::pair(60.0f - static_cast<float>(meet_m), -60.0f),
                             std::pair(60.0f - static_cast<float>(meet_m), 60.0f), std::pair(0.0f, 60.0f)})
    scene.vertices.push_back({glm::vec3(x, y, 0), glm::vec3(0, 0, 1)});
  for (const auto& [x, y] : {std::pair(3, -1), std::pair(6, -1), std::pair(6, 1), std::pair(3, 1)})
    scene.vertices.push_back({glm::vec3(x, y, 3), glm::vec3(0, 0, 1)});
  west.high_m.x = meet_m;
  east.origin_m.x = east.low_m.x = meet_m, east.first_vertex = 4;
  const SceneChunk board{.node = "board",
                         .low_m = {3, -1, 3},
                         .high_m = {6, 1, 3},
                         .index_count = 6,
                         .first_vertex = 8,
                         .vertex_count = 4};
  scene.chunks.push_back(east);
  scene.chunks.push_back(board);
  const auto light = FixedLight::of(scene, lamps_file(lamp_text(0, 0, 8)), std::nullopt);
  ASSERT_TRUE(light);
  const auto meshes = light->meshes(scene);
  std::map<float, float> there;
  std::size_t both = 0, fitted = 0;
  for (const std::size_t chunk : {0u, 1u})
    for (std::size_t v = 0; v < meshes[chunk][0].vertices.size(); ++v) {
      const glm::dvec3 at_m = scene.chunks[chunk].origin_m + glm::dvec3(meshes[chunk][0].vertices[v].position_m);
      if (std::abs(at_m.x - meet_m) > 1e-4) continue;
      const float lx = meshes[chunk][0].light[v].light.w;
      const auto [first, fresh] = there.try_emplace(static_cast<float>(at_m.y), lx);
      if (fresh) {
        const double of_corner_lx = light->lux_at(at_m, {0, 0, 1});
        if (std::abs(static_cast<double>(lx) - of_corner_lx) > 0.1 * std::max(of_corner_lx, 0.5)) ++fitted;
        continue;
      }
      ++both;
      EXPECT_NEAR(lx, first->second, 1e-5f * std::max(lx, 1.0f)) << "at y = " << at_m.y;
    }
  EXPECT_GE(both, 10u);
  EXPECT_GE(fitted, 2u);
}

/// A lamp on a wall is half a metre to 2 m from it, and a side of 1.5 m spans a pool of light. Sides are at most as
/// long as 2·least_edge/8 of their distance d from the lamp, and where E goes with 1/d³, E''/E = 12/d²: off by 12/8 of
/// the square of that in the middle of a side, by 4/3 of it in that of a triangle.
TEST(StreetLamps, SidesAreTheShorterTheNearerTheirLamp) {
  for (const char* fineness : {"coarse", "medium", "fine"}) {
    const BakeLevel level = kBakeLevels[fineness[0] == 'c' ? 0 : fineness[0] == 'm' ? 1 : 2];
    const double side_over_distance = 2.0 * level.least_edge_m / 8.0;
    const double bound =
        std::max(2.0 * level.tolerance, 4.0 / 3.0 * 12.0 / 8.0 * side_over_distance * side_over_distance);
    for (const double high_m : {0.5, 2.0}) {
      const Scene scene = square(4.0 * high_m);
      const auto light = FixedLight::of(scene, lamps_file(lamp_text(0.3, 0.2, high_m), false, fineness), std::nullopt);
      ASSERT_TRUE(light);
      const Errors errors = errors_of(*light, scene, 4000, false, [](const SceneMaterial&) { return true; });
      std::printf("a lamp at %.1f m, %-6s  mean %.2f %%  worst %.2f %%  %zu triangles\n", high_m, fineness,
                  100.0 * errors.mean, 100.0 * errors.worst, errors.triangles);
      EXPECT_LE(errors.worst, bound) << fineness << " " << high_m;
    }
  }
}

/// In the town shadows of cars, poles and eaves lie between vertices, and walls go on behind what stands before them:
/// there the light of a vertex is that of its own place. So far off, as a share of their mean light, are road and
/// pavement (with what lies under cars), and fronts of houses.
TEST(StreetLamps, InTheTownTheFinerTheNearer) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/town.glb");
  ASSERT_TRUE(scene) << scene.error().text();
  std::ifstream stream(generated_dir() / "scenes/town_lamps.toml");
  const std::string lamps{std::istreambuf_iterator<char>(stream), {}};
  // A tenth of the street, so that the test takes seconds: chunks that begin within it.
  Scene part = *scene;
  std::erase_if(part.chunks, [](const SceneChunk& chunk) { return chunk.low_m.x < 90.0 || chunk.low_m.x > 160.0; });
  double before = 1e9;
  for (const char* fineness : {"coarse", "medium", "fine"}) {
    const auto light = FixedLight::of(*scene,
                                      written("town_lamps.toml", "fineness = \"" + std::string(fineness) + "\"\n" +
                                                                     lamps.substr(lamps.find("[[luminaire]]"))),
                                      std::nullopt);
    ASSERT_TRUE(light) << light.error().text();
    EXPECT_GT(light->street_lamps(), 40u);
    const auto told = [&](const char* what, const auto& which) {
      const Errors errors = errors_of(*light, part, 4000, true, which);
      std::printf(
          "town, %s, %-6s  %.2f lx, off by %.2f %% of that in the mean, 95 of 100 within %.2f %%, %zu triangles; "
          "by light at the corners off by %.2f %%\n",
          what, fineness, errors.mean_lx, 100.0 * errors.mean, 100.0 * errors.p95, errors.triangles,
          100.0 * errors.of_vertices);
      return errors;
    };
    const Errors road = told("carriageway and pavement",
                             [](const SceneMaterial& m) { return m.name == "asphalt" || m.name == "pavement"; });
    const Errors fronts = told("fronts of houses", [](const SceneMaterial& m) { return m.name.starts_with("facade"); });
    // What is nearest to the light there is nearer than its values at the corners.
    EXPECT_LT(road.mean, 0.9 * road.of_vertices);
    EXPECT_LT(fronts.mean, 0.9 * fronts.of_vertices);
    EXPECT_LT(road.mean, before);
    before = road.mean;
  }
}

TEST(StreetLamps, AnRTableThatIsWrongIsRefused) {
  const auto light =
      FixedLight::of(square(),
                     written("bad.toml", "r_table = \"none.csv\"\n[[luminaire]]\nname = \"a\"\nfile = \"" +
                                             even_luminaire(false).string() + "\"\n"),
                     std::nullopt);
  ASSERT_FALSE(light);
  EXPECT_NE(light.error().text().find("none.csv"), std::string::npos);
}

}  // namespace
}  // namespace phare
