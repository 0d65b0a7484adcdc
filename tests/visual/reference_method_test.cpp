// The method "reference": float64 on the device. Reference: tables that other programs computed in float64, and this
// program's own float64 at the place where a pixel's ray meets the road.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "shaders/lib/angles64.h"
#include "tests/paths.h"
#include "tests/visual/shared_renderer.h"
#include "tools/reference_table.h"
#include "visual/photometry/beam/lamp_tables.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

// Candela are float32 in the beam image, and so is what is written: half a unit of the last place each.
constexpr double kFloatRounding = 1.0 / (1 << 24);

TEST(Angles64, AreThoseOfTheLibraryAllTheWayRound) {
  double worst_deg = 0.0, worst_small = 0.0;
  for (int i = -180000; i <= 180000; ++i) {
    const double angle_rad = i * std::numbers::pi / 180000.0;
    const double y = 7.0 * std::sin(angle_rad), x = 7.0 * std::cos(angle_rad);
    const double expected_deg = std::atan2(y, x) * 180.0 / std::numbers::pi;
    worst_deg = std::max(worst_deg, std::abs(shader::atan2_deg_64(y, x) - expected_deg));
    const double t = std::pow(10.0, -12.0 * (i + 180000) / 360000.0);
    worst_small = std::max(worst_small, std::abs(shader::atan_64(t) / std::atan(t) - 1.0));
  }
  std::printf("  worst %.2g degrees, relative %.2g from 1e-12 to 1\n", worst_deg, worst_small);
  EXPECT_LT(worst_deg, 1e-13);
  EXPECT_LT(worst_small, 2e-15);
  EXPECT_EQ(shader::atan2_deg_64(0.0, 0.0), 0.0);
  EXPECT_EQ(shader::sqrt_64(0.0), 0.0);
  for (const double x : {1e-300, 2.0, 3e5, 1e200}) EXPECT_NEAR(shader::sqrt_64(x) / std::sqrt(x), 1.0, 3e-16);
}

class ReferenceMethod : public SharedRenderer {
 protected:
  /// Lux of all lamps of a case, at its points.
  std::vector<double> measured(const std::vector<LampConfig>& lamps, const std::vector<PointRow>& rows, Method method) {
    LampTables tables;
    std::vector<PlacedLamp> placed;
    for (const LampConfig& lamp : lamps) {
      std::vector<AimedSource> aimed;
      for (const SourceConfig& source : lamp.sources) {
        EXPECT_TRUE(tables.add(source).ok());
        aimed.push_back(tables.aimed(source));
      }
      const BeamImage image = compose_beam_image(aimed);
      renderer->set_beam(placed.size(), image);
      placed.push_back({lamp.position_m, image.car_from_image, placed.size()});
    }
    std::vector<MeasurePoint> points;
    for (const PointRow& row : rows) points.push_back({row.position_m, row.normal});
    std::vector<double> total_lx(points.size(), 0.0);
    for (const std::vector<float>& lx : renderer->measure(placed, points, 0, method))
      for (std::size_t i = 0; i < lx.size(); ++i) total_lx[i] += static_cast<double>(lx[i]);
    return total_lx;
  }
};

// Road, wall, plates and directions, every file of the set in every format.
TEST_F(ReferenceMethod, IsAsExactAsFloat32CandelaAllowOnTheReferenceTables) {
  const fs::path data = fs::path(shared_data_dir()) / "photometry-reference";
  if (!fs::exists(data)) GTEST_SKIP() << "no reference tables at " << data;
  for (const char* name : {"0_intensity", "a_road_flat_low", "a_road_flat_high", "a_road_flat_fog", "b_wall25_low",
                           "b_wall25_high", "b_wall25_fog", "c_plates"}) {
    const auto cases = read_reference_table(data / (std::string(name) + ".csv"));
    ASSERT_TRUE(cases.ok()) << cases.error().text();
    double worst = 0.0, worst_of_fragment = 0.0;
    for (const ReferenceCase& asked : *cases) {
      const ReferenceErrors errors = compare(asked, measured(asked.lamps, asked.points, Method::kReference));
      worst = std::max(worst, errors.worst_relative);
      // The tables' own digits: 12 of them in the columns of types B and C.
      EXPECT_LT(errors.worst_relative, 2.0 * kFloatRounding + 5e-12) << name << " " << asked.column;
      EXPECT_GT(errors.judged, 0u) << name;
      worst_of_fragment = std::max(
          worst_of_fragment, compare(asked, measured(asked.lamps, asked.points, Method::kFragment)).worst_relative);
    }
    std::printf("  %s: reference %.2e, fragment %.2e\n", name, worst, worst_of_fragment);
    EXPECT_LT(worst, worst_of_fragment) << name;
  }
}

// Grazing, close, far, behind, at nodes, seams and cut-offs: at every point, however dim, what docs/accuracy.md
// promises of the shader that draws the frame.
TEST_F(ReferenceMethod, FragmentHoldsItsPromiseAtEveryHardPoint) {
  const fs::path table = fs::path(shared_data_dir()) / "photometry-reference/j_hard.csv";
  if (!fs::exists(table)) GTEST_SKIP() << "no " << table;
  const auto cases = read_reference_table(table);
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  std::size_t judged = 0;
  for (const ReferenceCase& asked : *cases) {
    const ReferenceErrors errors = compare(asked, measured(asked.lamps, asked.points, Method::kFragment));
    EXPECT_LT(errors.worst_relative, 1e-5) << asked.column << ", line " << errors.worst_line;
    judged += errors.judged;
  }
  EXPECT_EQ(judged, 107u);
}

/// A slope of 3 % to the side, from 4 m to 204 m, in oblong triangles whose corners float32 holds exactly.
Scene slope() {
  Scene scene;
  scene.materials = {{.name = "grey", .reflectance = glm::vec3(0.2f)}};
  const glm::vec3 normal = glm::normalize(glm::vec3(0.0f, -0.03125f, 1.0f));
  for (const float x : {4.0f, 204.0f})
    for (const float y : {-16.0f, 16.0f}) scene.vertices.push_back({{x, y, 0.03125f * y}, normal});
  scene.indices = {0, 2, 3, 0, 3, 1};
  SceneChunk chunk{.node = "road", .low_m = {4, -16, -0.5}, .high_m = {204, 16, 0.5}};
  chunk.index_count = 6;
  chunk.vertex_count = 4;
  scene.chunks = {chunk};
  return scene;
}

/// A beam with a cut-off: ten times as bright within 0.2°.
IntensityTable steep_beam(PhotometricType type) {
  IntensityTable table;
  table.type = type;
  for (double deg = -40.0; deg <= 40.0; deg += 0.5) table.first_deg.push_back(deg);
  for (double deg = -20.0; deg <= 10.0; deg += 0.1) table.second_deg.push_back(deg);
  if (type == PhotometricType::kB) std::swap(table.first_deg, table.second_deg);
  for (const double second : table.second_deg)
    for (const double first : table.first_deg) {
      const double h = first, v = second;
      table.candela.push_back(20'000.0 * std::exp(-h * h / 400.0) * (v > -0.5 ? 0.1 : v > -0.7 ? 0.5 : 1.0));
    }
  return table;
}

struct PictureErrors {
  double worst_relative = 0.0, rms_relative = 0.0;
  double worst_place = 0.0;  ///< where the pixel is said to lie, of the distance
};

class ReferencePicture : public ReferenceMethod {
 protected:
  FrameInput input_of(Method method) const {
    FrameInput input;
    input.camera = {.eye_m = {-1.9, 0.3, 1.22}, .world_from_eye = aim_rotation(0.0, -0.03, 0.0)};
    input.lamps = {{.position_m = {0.0, 0.6, 0.65}, .world_from_image = aim_rotation(0.01, 0.003, 0.02)},
                   {.position_m = {0.0, -0.6, 0.65}, .world_from_image = aim_rotation(0.0, -0.002, 0.0)}};
    input.method = method;
    return input;
  }
  void use(const IntensityTable& table) {
    const AimedSource source{.table = &table};
    renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
  }
  /// Against float64 where the ray through the middle of the pixel meets the slope: what the pixel really shows.
  PictureErrors errors(const IntensityTable& table, const FrameInput& input) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.0, -0.03125, 1.0));
    const ViewGeometry geometry(input.camera, 320.0 / 180.0);
    PictureErrors found;
    std::size_t judged = 0;
    for (const AuditSample& sample : renderer->audit(input, 6000, 5)) {
      const Ray ray = geometry.ray_through(sample.x_01 * 320.0 - 0.5, sample.y_01 * 180.0 - 0.5, 320, 180);
      const glm::dvec3 at_m =
          ray.origin_m - ray.direction * (glm::dot(ray.origin_m, normal) / glm::dot(ray.direction, normal));
      found.worst_place = std::max(
          found.worst_place, glm::distance(sample.point.position_m, at_m) / glm::distance(at_m, input.camera.eye_m));
      double expected_lx = 0.0;
      for (const PlacedLamp& lamp : input.lamps)
        expected_lx += illuminance_lx(lamp.position_m, lamp.world_from_image, table, 1.0, at_m, normal);
      if (expected_lx < 1e-3) continue;
      ++judged;
      const double relative = std::abs(sample.illuminance_lx / expected_lx - 1.0);
      found.worst_relative = std::max(found.worst_relative, relative);
      found.rms_relative += relative * relative;
    }
    EXPECT_GT(judged, 3000u);
    found.rms_relative = std::sqrt(found.rms_relative / static_cast<double>(judged));
    return found;
  }
};

// The place of a pixel costs no digit: candela, each lamp's lux and their sum are rounded to float32. The slope's
// normal is stored as float32: its tilt of 0.031 is off by a rounding, times 27, how far to the side light comes from
// over the lamp's height, is less than one more.
TEST_F(ReferencePicture, EachPixelIsRightAtTheVeryPlaceThatItShows) {
  ASSERT_TRUE(renderer->load_scene(slope()).ok());
  for (const PhotometricType type : {PhotometricType::kA, PhotometricType::kB}) {
    const IntensityTable table = steep_beam(type);
    use(table);
    const PictureErrors exact = errors(table, input_of(Method::kReference));
    const PictureErrors fragment = errors(table, input_of(Method::kFragment));
    std::printf("  reference: worst %.2e, rms %.2e; fragment: worst %.2e, rms %.2e\n", exact.worst_relative,
                exact.rms_relative, fragment.worst_relative, fragment.rms_relative);
    EXPECT_LT(exact.worst_relative, 4.0 * kFloatRounding);
    EXPECT_LT(exact.worst_relative, fragment.worst_relative);
    std::printf("  place: reference %.2e, fragment %.2e of the distance\n", exact.worst_place, fragment.worst_place);
    EXPECT_LT(exact.worst_place, kFloatRounding) << "told in float32";
  }
}

/// Lamps with light of several colours, fog, a shadow, a mirror, parallel rays.
TEST_F(ReferencePicture, ShowsWhatThePictureByFragmentShows) {
  Scene scene = slope();
  scene.vertices.insert(scene.vertices.end(),
                        {{{20, -1, 0}, {-1, 0, 0}}, {{20, 1, 0}, {-1, 0, 0}}, {{20, 0, 2}, {-1, 0, 0}}});
  scene.indices.insert(scene.indices.end(), {0, 2, 1});
  SceneChunk sign{.node = "sign", .low_m = {20, -1, 0}, .high_m = {20, 1, 2}};
  sign.first_index = 6, sign.index_count = 3, sign.first_vertex = 4, sign.vertex_count = 3;
  scene.chunks.push_back(sign);
  ASSERT_TRUE(renderer->load_scene(scene).ok());
  const IntensityTable table = steep_beam(PhotometricType::kA);
  IntensityTable wide = table;
  for (double& deg : wide.first_deg) deg *= 0.5;
  const AimedSource sources[]{{.table = &table, .colour_temperature_k = 3000.0}, {.table = &wide}};
  renderer->set_beam(0, compose_beam_image(sources));
  const auto pictures_agree = [&](FrameInput input, const char* what) {
    input.want_image = true;
    input.method = Method::kFragment;
    renderer->draw(input);  // what is kept from frame to frame: the light in fog
    const FrameResult by_fragment = renderer->draw(input);
    const Image8 expected = renderer->read_image();
    input.method = Method::kReference;
    const FrameResult by_reference = renderer->draw(input);
    const Image8 picture = renderer->read_image();
    EXPECT_EQ(by_reference.pass_count, by_fragment.pass_count) << what;
    int lit = 0, worst = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
      worst = std::max(worst, std::abs(int{picture.rgba[i]} - int{expected.rgba[i]}));
      lit += i % 4 == 0 && expected.rgba[i] > 30 ? 1 : 0;
    }
    EXPECT_GT(lit, 1000) << what;
    EXPECT_LE(worst, 1) << what << ": the same light, rounded to 255 steps";
  };
  FrameInput input = input_of(Method::kReference);
  pictures_agree(input, "road and sign, with shadows");
  input.air.visibility_m = 80.0;
  pictures_agree(input, "fog");
  input.air.visibility_m.reset();
  input.camera.world_from_eye[1] = -input.camera.world_from_eye[1];
  pictures_agree(input, "as in a mirror");
  input = input_of(Method::kReference);
  input.part = {.left_01 = 0.25, .top_01 = 0.125, .width_01 = 0.75, .height_01 = 0.875};
  pictures_agree(input, "a part of the picture");
  input = input_of(Method::kReference);
  input.camera = {.eye_m = {30.0, 0.0, 40.0},
                  .world_from_eye = aim_rotation(0.0, -0.5 * std::numbers::pi, 0.0),
                  .orthographic_width_m = 60.0};
  pictures_agree(input, "from above, parallel rays");
}

TEST(ReferenceRefused, ByADeviceWithoutFloat64) {
  Result<Renderer> renderer = Renderer::create({.width_px = 64, .height_px = 64, .validation = true, .float64 = false});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->no_reference().has_value());
  EXPECT_NE(renderer->no_reference()->find("shaderFloat64"), std::string::npos) << *renderer->no_reference();
  const PlacedLamp lamp{};
  const MeasurePoint point{{10, 0, 0}, {-1, 0, 0}};
  const IntensityTable table = steep_beam(PhotometricType::kA);
  const AimedSource source{.table = &table};
  renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
  EXPECT_GT(renderer->measure(std::span(&lamp, 1), std::span(&point, 1))[0][0], 0.0f);
  EXPECT_THROW(renderer->measure(std::span(&lamp, 1), std::span(&point, 1), 0, Method::kReference), std::runtime_error);
}

}  // namespace
}  // namespace phare
