// What the picture shows of markings and sheeting, measured in it at the standards' geometries: luminance over
// illuminance, in the HDR image.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "visual/photometry/table/illuminance.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
// The image holds half floats, 2^-11 each way; angles of float32 are good to 1e-5°, of which a coefficient changes by
// less than a thousandth.
constexpr double kHalfFloat = 1e-3;

IntensityTable even_lamp(double cd) {
  IntensityTable table;
  table.first_deg = {-80, 0, 80};
  table.second_deg = {-80, 0, 80};
  table.candela.assign(9, cd);
  return table;
}

// A small square at a place of the world, seen from an eye and lit by one lamp; all light is the lamp's.
class Patch {
 public:
  static Patch& shared() {
    static Patch the_only;
    return the_only;
  }
  /// Luminance toward the eye of a patch of 0.2 m about `at`, cd/m².
  double luminance_cdm2(const SceneMaterial& material, glm::dvec3 at, glm::dvec3 normal, glm::dvec3 eye,
                        glm::dvec3 lamp, double kelvin = 2856.0, std::size_t wet = 0) {
    Scene scene;
    scene.materials = {material};
    const glm::dvec3 u =
        glm::normalize(glm::cross(std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), normal));
    const glm::dvec3 v = glm::cross(normal, u);
    SceneChunk chunk{.node = "patch", .material = 0, .origin_m = at, .low_m = at - 0.2, .high_m = at + 0.2};
    for (const auto& [a, b] : {std::pair{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}})
      scene.vertices.push_back({glm::vec3(a * u + b * v), glm::vec3(normal)});
    scene.indices = {0, 1, 2, 0, 2, 3};
    chunk.index_count = 6;
    chunk.vertex_count = 4;
    scene.chunks.push_back(chunk);
    EXPECT_TRUE(renderer->load_scene(scene).ok());
    const IntensityTable table = even_lamp(10000.0);
    const AimedSource source{.table = &table, .colour_temperature_k = kelvin};
    renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
    FrameInput input;
    input.camera.eye_m = eye;
    const glm::dvec3 forward = glm::normalize(at - eye),
                     left = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), forward));
    input.camera.world_from_eye = {forward, left, glm::cross(forward, left)};
    input.camera.fov_horizontal_rad = 0.1 * kRadPerDeg;  // the middle pixel sees the patch's middle
    const glm::dvec3 ahead = glm::normalize(at - lamp), side = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), ahead));
    input.lamps = {{.position_m = lamp, .world_from_image = {ahead, side, glm::cross(ahead, side)}}};
    input.sky_luminance_cdm2 = 0.0;
    input.want_hdr = true;
    input.effects[static_cast<std::size_t>(Effect::kWetGround)] = wet;
    renderer->draw(input);
    const ImageF picture = renderer->read_hdr();
    const std::size_t middle = (15 * 31 + 15) * 4;
    glm::dvec3 rgb;
    for (int i = 0; i < 3; ++i) rgb[i] = static_cast<double>(picture.rgba[middle + static_cast<std::size_t>(i)]);
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
  }
  static double facing_lx(glm::dvec3 at, glm::dvec3 lamp) { return 10000.0 / glm::dot(at - lamp, at - lamp); }
  std::unique_ptr<Renderer> renderer;

 private:
  Patch() {
    Result<Renderer> made = Renderer::create({.width_px = 31, .height_px = 31, .validation = true});
    if (made) renderer = std::make_unique<Renderer>(std::move(*made));
  }
};

SceneMaterial of_class(const std::string& name, glm::vec3 reflectance, std::optional<double> r_a = std::nullopt) {
  SceneMaterial material{.name = name, .reflectance = reflectance};
  const auto retro = retroreflection(name, r_a, std::nullopt);
  EXPECT_TRUE(retro) << name;
  if (retro) material.retro = *retro;
  return material;
}

class RetroOnDevice : public testing::Test {
 protected:
  void SetUp() override { ASSERT_NE(Patch::shared().renderer, nullptr); }
  void TearDown() override { EXPECT_EQ(Patch::shared().renderer->validation_messages(), 0u); }
};

constexpr glm::dvec3 kLamp{0, 0, 0.65}, kEye{0, 0, 1.2}, kUp{0, 0, 1};
const glm::vec3 kPaint(0.5f, 0.5f, 0.48f);
const double kPaintRho =
    glm::dot(glm::dvec3(kPaint) * glm::dvec3(black_body_colour(2856.0)), glm::dvec3(0.2126, 0.7152, 0.0722));

// R_L in mcd/(lx·m²) of a marking so far ahead.
double seen_r_l(const SceneMaterial& material, double distance_m) {
  const glm::dvec3 at(distance_m, 0, 0);
  return 1e3 * Patch::shared().luminance_cdm2(material, at, kUp, kEye, kLamp) / Patch::facing_lx(at, kLamp);
}

// Upright facets under lamp and eye above each other, in float64.
double facets_share_at(double distance_m) {
  const glm::dvec3 lamp = glm::normalize(glm::dvec3(-distance_m, 0, 0.65)),
                   eye = glm::normalize(glm::dvec3(-distance_m, 0, 1.2));
  return (glm::dot(lamp, eye) - lamp.z * eye.z) * std::min(lamp.z / eye.z, 1.0);
}

TEST_F(RetroOnDevice, RoughGroundSendsBackItsFacets) {
  const SceneMaterial ground = of_class("upright facets", kPaint), flat{.name = "flat", .reflectance = kPaint};
  SceneMaterial measured = ground;
  measured.retro.r_l_mcd_per_lx_m2 = 15.0;
  for (const double distance_m : {7.0, 30.0, 100.0}) {
    const double facets = seen_r_l(ground, distance_m) - seen_r_l(flat, distance_m);
    std::printf("rough ground of rho %.3f at %.0f m: %.2f mcd/(lx·m²) more\n", kPaintRho, distance_m, facets);
    EXPECT_NEAR(facets / (1e3 * kPaintRho / std::numbers::pi * facets_share_at(distance_m)), 1.0, 3 * kHalfFloat)
        << distance_m << " m: two readings, of which one holds a sixth more than the difference";
  }
  EXPECT_NEAR(seen_r_l(measured, 30.0) / 15.0, 1.0, kHalfFloat);
  const glm::dvec3 at(30, 0, 0), oncoming(60, 0, 0.65);
  EXPECT_EQ(Patch::shared().luminance_cdm2(ground, at, kUp, kEye, oncoming),
            Patch::shared().luminance_cdm2(flat, at, kUp, kEye, oncoming));
}

TEST_F(RetroOnDevice, AMarkingHasItsClassInTheThirtyMetreGeometry) {
  for (const auto& [name, mcd] :
       {std::pair{"EN 1436 R2", 100.0}, {"EN 1436 R3", 150.0}, {"EN 1436 R4", 200.0}, {"EN 1436 R5", 300.0}}) {
    const double seen = seen_r_l(of_class(name, kPaint), 30.0);
    std::printf("%s: %.1f mcd/(lx·m²) at 30 m\n", name, seen);
    // 30 m with these heights is 1.0494°, which the standard rounds to 1.05°: 4e-4 of the coefficient.
    EXPECT_NEAR(seen / mcd, 1.0, kHalfFloat + 4e-4) << name;
  }
  // Paint without beads is a diffuse surface: a marking for the day.
  const double bare = seen_r_l({.name = "bare", .reflectance = kPaint}, 30.0);
  EXPECT_NEAR(bare, 0.499 / std::numbers::pi * std::cos(88.76 * kRadPerDeg) * 1e3, 0.1);
}

TEST_F(RetroOnDevice, AMarkingChangesSensiblyNearerAndFarther) {
  const SceneMaterial r4 = of_class("EN 1436 R4", kPaint);
  const double diffuse_30 = seen_r_l({.name = "bare", .reflectance = kPaint}, 30.0);
  for (const double distance_m : {7.0, 15.0, 50.0, 100.0}) {
    const double observation_deg = (std::atan(1.2 / distance_m) - std::atan(0.65 / distance_m)) / kRadPerDeg;
    const double diffuse = seen_r_l({.name = "bare", .reflectance = kPaint}, distance_m);
    // Paint as rough as the ground: at 30 m rho/pi·0.5414 of R_L, the rest is beads.
    const double facets_30 = 1e3 * kPaintRho / std::numbers::pi * 0.5414125;
    const double facets = facets_30 / 0.5414125 * facets_share_at(distance_m);
    const double expected =
        (200.0 - diffuse_30 - facets_30) * std::exp(-(observation_deg - 1.05) / 1.6) + facets + diffuse;
    const double seen = seen_r_l(r4, distance_m);
    std::printf("R4 at %.0f m: %.0f mcd/(lx·m²)\n", distance_m, seen);
    EXPECT_NEAR(seen / expected, 1.0, 2e-3) << distance_m;  // two such readings in it
  }
}

// Type II on wet ground; dry it is its dry class, to the bit. Ordinary beads keep 12 %.
TEST_F(RetroOnDevice, AMarkingOfTypeTwoIsItsWetClassOnWetGround) {
  const auto seen = [](const char* name, std::size_t wet) {
    const glm::dvec3 at(30, 0, 0);
    SceneMaterial material = of_class(name, kPaint);
    material.surface = Surface::kPaint;
    return 1e3 * Patch::shared().luminance_cdm2(material, at, kUp, kEye, kLamp, 2856.0, wet) /
           Patch::facing_lx(at, kLamp);
  };
  const double grain = seen("EN 1436 R4", 0) / 200.0;  // of the paint, at this place: all light is times this
  EXPECT_NEAR(grain, 1.0, 0.1);
  for (const auto& [name, dry, wet] : {std::tuple{"EN 1436 R2 RW1", "EN 1436 R2", 25.0},
                                       {"EN 1436 R3 RW2", "EN 1436 R3", 35.0},
                                       {"EN 1436 R5 RW6", "EN 1436 R5", 150.0}}) {
    EXPECT_EQ(seen(name, 0), seen(dry, 0)) << name;
    for (std::size_t level = 1; level < kWetNames.size(); ++level) {
      const double mcd = seen(name, level) / grain;
      std::printf("%s, %s: %.2f mcd/(lx·m²)\n", name, std::string(kWetNames[level]).c_str(), mcd);
      // Two readings, and what a damp film's wide slopes mirror: 0.2 mcd.
      EXPECT_NEAR(mcd, wet, 3.0 * kHalfFloat * wet + 0.3) << name << ", level " << level;
    }
  }
  EXPECT_NEAR(seen("EN 1436 R4", 3) / seen("EN 1436 R4", 0), 0.12, 0.01);
}

TEST_F(RetroOnDevice, AMarkingSendsNothingBackToWhereTheLampIsNot) {
  const glm::dvec3 at(30, 0, 0), oncoming(60, 0, 0.65);
  const double with = Patch::shared().luminance_cdm2(of_class("EN 1436 R5", kPaint), at, kUp, kEye, oncoming);
  const double without =
      Patch::shared().luminance_cdm2({.name = "bare", .reflectance = kPaint}, at, kUp, kEye, oncoming);
  EXPECT_EQ(with, without);
}

// A plate lit at an entrance angle and seen at an observation angle, 60 m away.
TEST_F(RetroOnDevice, ASignHasItsFigureAtTheStandardsAngles) {
  struct Plate {
    const char* name;
    glm::vec3 reflectance;
    double observation_deg, entrance_deg, cd;
  };
  const glm::vec3 white(0.4f, 0.4f, 0.39f), red(0.16f, 0.012f, 0.014f), yellow(0.38f, 0.26f, 0.02f);
  for (const Plate& plate : {Plate{"EN 12899-1 RA2 white", white, 0.33, 5, 180},
                             {"EN 12899-1 RA2 white", white, 0.2, 30, 150},
                             {"EN 12899-1 RA2 white", white, 0.33, 40, 95},
                             {"EN 12899-1 RA2 white", white, 2, 5, 5},
                             {"EN 12899-1 RA2 red", red, 0.33, 5, 25},
                             {"EN 12899-1 RA2 yellow", yellow, 0.33, 5, 120},
                             {"EN 12899-1 RA1 white", white, 0.33, 30, 24},
                             {"DIN 67520 RA3B white", white, 0.33, 30, 165},
                             {"DIN 67520 RA3B white", white, 1, 40, 3.5},
                             {"DIN 67520 RA3A white", white, 0.2, 20, 450},
                             {"EN ISO 20471 tape", white, 0.33, 20, 200}}) {
    const glm::dvec3 lamp(0, 0, 2), at(60, 0, 2),
        normal = aim_rotation(plate.entrance_deg * kRadPerDeg, 0, 0) * glm::dvec3(-1, 0, 0);
    const glm::dvec3 eye = at + aim_rotation(0, plate.observation_deg * kRadPerDeg, 0) * (lamp - at);
    const SceneMaterial material = of_class(plate.name, plate.reflectance);
    const double luminance = Patch::shared().luminance_cdm2(material, at, normal, eye, lamp);
    const SceneMaterial bare{.name = "bare", .reflectance = plate.reflectance};
    const double diffuse = Patch::shared().luminance_cdm2(bare, at, normal, eye, lamp);
    const double cos_seen = glm::dot(normal, glm::normalize(eye - at));
    const double r_a = (luminance - diffuse) * cos_seen / Patch::facing_lx(at, lamp);
    EXPECT_NEAR(r_a / plate.cd, 1.0, 2.0 * kHalfFloat)
        << plate.name << " at " << plate.observation_deg << "°, " << plate.entrance_deg << "°";
  }
}

// The back of a sign, lit from behind the plate, gives nothing to the eye before it.
TEST_F(RetroOnDevice, BackLightOfASignIsDark) {
  const SceneMaterial sign = of_class("EN 12899-1 RA2 white", glm::vec3(0.4f));
  const double behind = Patch::shared().luminance_cdm2(sign, {60, 0, 2}, {-1, 0, 0}, {0, 0, 2.3}, {120, 0, 2});
  EXPECT_EQ(behind, 0.0);
}

}  // namespace
}  // namespace phare
