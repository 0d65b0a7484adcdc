// Surfaces by Oren and Nayar in the picture: reference, against a set's own table of a rough road and, at any geometry,
// against float64; unit, the shader's function; and what a scene without one does not pay.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "shaders/lib/retro.h"
#include "tests/csv_table.h"
#include "tests/paths.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/photometry/table/surface_luminance.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr glm::dvec3 kUpward{0.0, 0.0, 1.0};
// Half floats of the image, which lavapipe rounds toward 0: 2^-10 = 9.8e-4. Illuminance 1e-5; the equation in float32
// 7e-5 of Lambert's.
constexpr double kOfPixel = 1.05e-3;

SceneMaterial rough(double roughness_deg, glm::vec3 reflectance = glm::vec3(0.1f)) {
  SceneMaterial material{.name = "rough", .reflectance = reflectance};
  material.retro = grooves(roughness_deg);
  return material;
}

Scene square(const SceneMaterial& material, double half_m) {
  Scene scene;
  scene.materials = {material};
  const auto far = static_cast<float>(half_m);
  for (const auto& [x, y] : {std::pair{-far, -far}, {far, -far}, {far, far}, {-far, far}})
    scene.vertices.push_back({{x, y, 0.0f}, {0.0f, 0.0f, 1.0f}});
  scene.indices = {0, 1, 2, 0, 2, 3};
  scene.chunks = {{.node = "square",
                   .low_m = {-half_m, -half_m, -0.1},
                   .high_m = {half_m, half_m, 0.1},
                   .index_count = 6,
                   .vertex_count = 4}};
  return scene;
}

/// A point of the ground in the middle of the picture.
class RoughSurface : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Result<Renderer> made = Renderer::create({.width_px = 31, .height_px = 31, .validation = true});
    if (made) shared() = std::make_unique<Renderer>(std::move(*made));
  }
  static void TearDownTestSuite() { shared().reset(); }
  void SetUp() override {
    ASSERT_NE(shared(), nullptr);
    renderer_ = shared().get();
  }
  void TearDown() override {
    if (renderer_ == nullptr) return;
    EXPECT_EQ(renderer_->validation_messages(), 0u);
  }
  FrameInput input(const glm::dvec3& eye_m, const glm::dvec3& at_m, const std::vector<PlacedLamp>& lamps) const {
    FrameInput input;
    input.camera.eye_m = eye_m;
    const glm::dvec3 forward = glm::normalize(at_m - eye_m), left = glm::normalize(glm::cross(kUpward, forward));
    input.camera.world_from_eye = {forward, left, glm::cross(forward, left)};
    input.camera.fov_horizontal_rad = 0.02 * kRadiansPerDegree;
    input.lamps = lamps;
    input.sky_luminance_cdm2 = 0.0;
    input.want_hdr = true;
    return input;
  }
  double seen_cdm2(const FrameInput& input) {
    renderer_->draw(input);
    const ImageF picture = renderer_->read_hdr();
    const float* middle = &picture.rgba[(15 * 31 + 15) * 4];
    return 0.2126 * static_cast<double>(middle[0]) + 0.7152 * static_cast<double>(middle[1]) +
           0.0722 * static_cast<double>(middle[2]);
  }
  /// 10,000 cd wherever it looks.
  void set_even_beam(std::size_t beam, double kelvin) {
    IntensityTable table;
    table.first_deg = {-80, 0, 80}, table.second_deg = {-80, 0, 80};
    table.candela.assign(9, 1e4);
    const AimedSource source{.table = &table, .colour_temperature_k = kelvin};
    renderer_->set_beam(beam, compose_beam_image(std::span(&source, 1)));
  }
  static PlacedLamp looking_at(const glm::dvec3& lamp_m, const glm::dvec3& at_m, std::size_t beam) {
    const glm::dvec3 ahead = glm::normalize(at_m - lamp_m), side = glm::normalize(glm::cross(kUpward, ahead));
    return {.position_m = lamp_m, .world_from_image = {ahead, side, glm::cross(ahead, side)}, .beam = beam};
  }
  Renderer* renderer_ = nullptr;

 private:
  static std::unique_ptr<Renderer>& shared() {
    static std::unique_ptr<Renderer> renderer;
    return renderer;
  }
};

// The road before a car with the set's two lamps, from the set's eye: 120 points to 85 m, two roughnesses.
TEST_F(RoughSurface, ARoadIsThatOfTheReferenceTable) {
  const std::filesystem::path data = std::filesystem::path(shared_data_dir()) / "photometry-reference";
  if (!std::filesystem::exists(data / "manifest.json")) GTEST_SKIP() << "no reference tables at " << data;
  const nlohmann::json manifest = nlohmann::json::parse(std::ifstream(data / "manifest.json"));
  const auto vec = [](const nlohmann::json& v) { return glm::dvec3(v[0], v[1], v[2]); };
  const auto key = manifest["primary_file_per_beam"]["low"].get<std::string>();
  const auto table = read_lamp(data / manifest["files"][key]["file"].get<std::string>(), {});
  ASSERT_TRUE(table);
  const AimedSource source{.table = &*table};
  renderer_->set_beam(0, compose_beam_image(std::span(&source, 1)));
  std::vector<PlacedLamp> lamps;
  for (const nlohmann::json& at : manifest["mounting"]["low"])
    lamps.push_back({.position_m = vec(at["position_m"]),
                     .world_from_image = {vec(at["forward"]), vec(at["left"]), vec(at["up"])}});
  const test::CsvTable csv = test::read_csv_table(data / "g_luminance_road.csv");
  for (const auto& [roughness_deg, column] :
       {std::pair{0.0, "L_lambert"}, {20.0, "L_on_full_20deg"}, {35.0, "L_on_full_35deg"}}) {
    ASSERT_TRUE(renderer_->load_scene(
        square(rough(roughness_deg, glm::vec3(manifest["road_reflectance"].get<float>())), 100.0)));
    double worst = 0.0, rms = 0.0;
    std::size_t judged = 0;
    for (std::size_t i = 0; i < csv.rows.size(); ++i) {
      const double expected = csv.number(i, column);
      if (csv.number(i, "E") < 0.01) continue;  // as the set judges lux
      const glm::dvec3 at(csv.number(i, "x"), csv.number(i, "y"), csv.number(i, "z"));
      const double off = seen_cdm2(input(vec(manifest["eye_m"]), at, lamps)) / expected - 1.0;
      EXPECT_LE(std::abs(off), 1e-3) << column << " at " << at.x << ", " << at.y;
      worst = std::max(worst, std::abs(off)), rms += off * off, ++judged;
    }
    std::printf("%s in the picture: %zu points, worst %.2g, rms %.2g\n", column, judged, worst,
                std::sqrt(rms / static_cast<double>(judged)));
    EXPECT_GT(judged, 100u);
  }
}

// Lamps and eyes all round the point, high and grazing: by lean shaders, by those for lamps of different colours, and
// in float64 on the device. The coloured one has the luminance of its three parts each by the equation.
TEST_F(RoughSurface, APixelIsTheEquationAtAnyGeometryInEveryShader) {
  set_even_beam(0, 6500.0);
  set_even_beam(1, 6500.0);
  const glm::dvec3 at(0.0, 0.0, 0.0);
  const auto from = [](double elevation_deg, double azimuth_deg, double far_m) {
    const double e = elevation_deg * kRadiansPerDegree, a = azimuth_deg * kRadiansPerDegree;
    return far_m * glm::dvec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  };
  struct Shader {
    const char* name;
    bool colours;
    Method method;
  };
  std::size_t tried = 0;
  double worst = 0.0;
  for (const Shader& shader : {Shader{"lean", false, Method::kFragment},
                               {"two colours", true, Method::kFragment},
                               {"float64", false, Method::kReference}}) {
    if (shader.method == Method::kReference && renderer_->no_reference()) continue;
    set_even_beam(1, shader.colours ? 3000.0 : 6500.0);
    for (const double roughness_deg : {12.0, 30.0, 50.0})
      for (const glm::vec3 rho : {glm::vec3(0.08f), glm::vec3(0.9f), glm::vec3(0.6f, 0.2f, 0.05f)}) {
        if (shader.colours && rho.x != rho.y) continue;
        // There the equation is below nothing for one part of a colour and not for another.
        if (roughness_deg > 40.0 && rho.x != rho.y) continue;
        ASSERT_TRUE(renderer_->load_scene(square(rough(roughness_deg, rho), 2.0)));
        for (const double seen_deg : {1.5, 20.0, 85.0})
          for (const double lit_deg : {0.8, 30.0, 88.0})
            for (const double azimuth_deg : {0.0, 35.0, 100.0, 178.0}) {
              const glm::dvec3 eye = from(seen_deg, 0.0, 30.0);
              const std::vector<PlacedLamp> lamps{looking_at(from(lit_deg, azimuth_deg, 25.0), at, 0),
                                                  looking_at(from(lit_deg + 1.0, azimuth_deg - 20.0, 25.0), at, 1)};
              double expected = 0.0, sum_of_lamps = 0.0;
              for (const PlacedLamp& lamp : lamps) {
                const LightAndSight where{kUpward, glm::normalize(lamp.position_m), glm::normalize(eye)};
                const double lx = 1e4 / glm::dot(lamp.position_m, lamp.position_m) * where.to_lamp.z;
                sum_of_lamps += lx;
                const glm::vec3 colour = black_body_colour(lamp.beam == 1 && shader.colours ? 3000.0 : 6500.0);
                const glm::dvec3 weights = glm::dvec3(colour) * glm::dvec3(0.2126, 0.7152, 0.0722);
                for (const auto& [weight, part] : {std::pair{weights.x, rho.x}, {weights.y, rho.y}, {weights.z, rho.z}})
                  expected += weight * lx *
                              oren_nayar_per_sr(static_cast<double>(part), roughness_deg * kRadiansPerDegree, where);
              }
              FrameInput asked = input(eye, at, lamps);
              asked.method = shader.method;
              const double seen = seen_cdm2(asked);
              // The one number for light between facets is that of white light: of a coloured surface it is off by this
              // much in light of 6,500 K, times at most 2 where azimuths differ.
              const glm::dvec3 white(0.2126, 0.7152, 0.0722), rhos(rho), light(black_body_colour(6500.0));
              const double s = std::pow(roughness_deg * kRadiansPerDegree, 2.0);
              const double once_more = glm::dot(white, rhos * rhos) / glm::dot(white, rhos);
              const double of_colour =
                  rho.x == rho.y
                      ? 0.0
                      : 2.0 * 0.17 * s / (s + 0.13) * sum_of_lamps / std::numbers::pi *
                            std::abs(once_more * glm::dot(white * light, rhos) - glm::dot(white * light, rhos * rhos));
              // Near nothing, where Lambert's part and what is taken from it are large beside the rest, their rounding.
              const double rounding = 2e-5 * sum_of_lamps * 0.3;
              EXPECT_NEAR(seen, expected, kOfPixel * expected + rounding + of_colour)
                  << shader.name << ", " << roughness_deg << " deg, rho " << rho.x << ", seen from " << seen_deg
                  << ", lit from " << lit_deg << " at " << azimuth_deg;
              if (rho.x == rho.y && expected > 5e-4 * sum_of_lamps)
                worst = std::max(worst, std::abs(seen / expected - 1.0));
              ++tried;
            }
      }
  }
  std::printf("rough surfaces at any geometry: %zu pixels, worst %.2g\n", tried, worst);
  EXPECT_GT(tried, 400u);
}

// 15 % of what its facets send beside Lambert's is left under water, as of other rough ground.
TEST_F(RoughSurface, WaterLeavesLittleOfIt) {
  set_even_beam(0, 6500.0);
  const glm::dvec3 at(0.0), eye(-30.0, 0.0, 1.2);
  const std::vector<PlacedLamp> lamps{looking_at({-30.0, 0.0, 0.65}, at, 0)};
  std::array<double, 4> seen{};
  for (const std::size_t i : {0u, 1u, 2u, 3u}) {
    SceneMaterial material = rough(i < 2 ? 0.0 : 30.0);
    material.surface = Surface::kAsphalt;
    ASSERT_TRUE(renderer_->load_scene(square(material, 2.0)));
    FrameInput asked = input(eye, at, lamps);
    asked.effects[static_cast<std::size_t>(Effect::kWetGround)] = i % 2 == 0 ? 0u : 2u;
    seen[i] = seen_cdm2(asked);
  }
  const double rho = 0.1, wet_rho = 0.0525;  // wet_reflectance() of it
  const double dry_more = (seen[2] - seen[0]) / rho, wet_more = (seen[3] - seen[1]) / wet_rho;
  EXPECT_GT(dry_more, 4.0 * seen[0] / rho) << "the road is dark without";
  EXPECT_NEAR(wet_more / dry_more, 0.15, 0.01);
}

// No byte, no pass, no draw: terms stand where sheetings have theirs. A scene without it makes no pipeline for it.
TEST_F(RoughSurface, CostsNothingWhereNothingIsRough) {
  set_even_beam(0, 6500.0);
  const glm::dvec3 at(0.0);
  const FrameInput asked =
      input({-30.0, 0.0, 1.2}, at, {looking_at({-30.0, 0.6, 0.65}, at, 0), looking_at({-30.0, -0.6, 0.65}, at, 0)});
  const auto frame_of = [&](const SceneMaterial& material) {
    EXPECT_TRUE(renderer_->load_scene(square(material, 2.0)));
    return renderer_->draw(asked);
  };
  (void)frame_of(rough(0.0));
  (void)renderer_->draw(asked);
  (void)frame_of(rough(0.0));
  const std::uint64_t bytes = renderer_->device_memory_bytes();
  const FrameResult flat = frame_of(rough(0.0));
  EXPECT_EQ(flat.pipelines_made, 0u);
  const FrameResult grooved = frame_of(rough(41.0));
  EXPECT_EQ(grooved.pass_count, flat.pass_count);
  EXPECT_EQ(grooved.draws, flat.draws);
  EXPECT_EQ(grooved.triangles, flat.triangles);
  EXPECT_EQ(grooved.image_bytes, flat.image_bytes);
  EXPECT_EQ(renderer_->device_memory_bytes(), bytes);
  const FrameResult after = frame_of(rough(0.0));
  EXPECT_EQ(after.pipelines_made, 0u) << "those that it had";
}

// The function that shader and clicks share, over the half sphere: cosines and the cube of an angle in float32, some
// steps of 6e-8 each, 6e-7 at most together, over the cosine of the smaller angle, 0.004 at least, times 0.45.
TEST(RoughSurfaces, TheShadersFunctionIsTheEquation) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  double worst = 0.0;
  std::size_t below_nothing = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto way = [&] {
      const double z = std::pow(std::abs(even(random)), 3.0) + 0.004, turn = std::numbers::pi * even(random);
      const double level = std::sqrt(std::max(1.0 - z * z, 0.0));
      return glm::normalize(glm::dvec3(level * std::cos(turn), level * std::sin(turn), z));
    };
    const glm::dvec3 lamp = way(), eye = way();
    const double rho = 0.5 * (1.0 + even(random)),
                 roughness_rad = kRoughest_deg * kRadiansPerDegree * std::abs(even(random));
    const double exact = oren_nayar_per_sr(rho, roughness_rad, {kUpward, lamp, eye}) * lamp.z;
    Retroreflection retro = grooves(roughness_rad / kRadiansPerDegree);
    const double found = rho / std::numbers::pi * lamp.z + sent_back_per_lx(retro, rho, lamp, kUpward, eye);
    ASSERT_NEAR(found, exact, 7e-5 / std::numbers::pi * rho * lamp.z + 1e-9)
        << rho << " " << roughness_rad << " " << lamp.z << " " << eye.z;
    if (exact > 0.0) worst = std::max(worst, std::abs(found - exact) / (rho * lamp.z + 1e-9));
    below_nothing += exact == 0.0 ? 1 : 0;
  }
  std::printf("grooves in float32: at most %.2g of Lambert's; nothing at all in %zu of 200,000\n",
              worst * std::numbers::pi, below_nothing);
}

}  // namespace
}  // namespace phare
