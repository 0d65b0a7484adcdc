// Illumination methods: how far those that compute at the vertices are from float64, and that they come nearer as the
// road is cut finer.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/visual/shared_renderer.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

/// A level road from 4 m to 60 m, 20 m wide, in squares of `side_m`.
Scene road(double side_m) {
  Scene scene;
  scene.materials = {{.name = "grey", .reflectance = glm::vec3(0.2f)}};
  const int along = static_cast<int>(std::lround(56.0 / side_m)), across = static_cast<int>(std::lround(20.0 / side_m));
  for (int i = 0; i <= along; ++i)
    for (int k = 0; k <= across; ++k)
      scene.vertices.push_back({glm::vec3(4.0 + i * side_m, -10.0 + k * side_m, 0.0), {0, 0, 1}});
  const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (across + 1) + k); };
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < across; ++k)
      for (const std::uint32_t v : {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)})
        scene.indices.push_back(v);
  SceneChunk chunk{.node = "road", .low_m = {4, -10, 0}, .high_m = {60, 10, 0}};
  chunk.index_count = static_cast<std::uint32_t>(scene.indices.size());
  chunk.vertex_count = static_cast<std::uint32_t>(scene.vertices.size());
  scene.chunks = {chunk};
  return scene;
}

constexpr double kPeak_cd = 20'000.0;

/// A beam without a cut-off, so that what is left is the method's error.
IntensityTable smooth_beam() {
  IntensityTable table;
  for (double deg = -60.0; deg <= 60.0; deg += 0.5) table.first_deg.push_back(deg);
  for (double deg = -20.0; deg <= 20.0; deg += 0.25) table.second_deg.push_back(deg);
  for (const double v : table.second_deg)
    for (const double h : table.first_deg)
      table.candela.push_back(kPeak_cd * std::exp(-h * h / 800.0 - (v + 2.0) * (v + 2.0) / 50.0));
  return table;
}

struct Errors {
  double rms_lx = 0.0, worst_lx = 0.0, most_lx = 0.0;
  double steps_lx = 0.0;  ///< of 8 bits, at most half a step of the peak
};

class Methods : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer != nullptr) renderer->set_beam(0, image_of_smooth());
  }
  BeamImage image_of_smooth() const {
    const AimedSource source{.table = &beam_};
    return compose_beam_image(std::span(&source, 1));
  }
  FrameInput from_above(Method method) const {
    FrameInput input;
    input.camera = {.eye_m = {25.0, 0.0, 30.0},
                    .world_from_eye = aim_rotation(0.0, -0.5 * std::numbers::pi, 0.0),
                    .fov_horizontal_rad = 1.4};
    input.lamps = {{.position_m = {0.0, 0.6, 0.65}}, {.position_m = {0.0, -0.6, 0.65}}};
    input.method = method;
    return input;
  }
  /// Against float64, over 4,000 pixels.
  Errors errors(Method method) {
    const FrameInput input = from_above(method);
    Errors found;
    const std::vector<AuditSample> samples = renderer->audit(input, 4000, 11);
    EXPECT_EQ(samples.size(), 4000u);
    for (const AuditSample& sample : samples) {
      double expected_lx = 0.0, per_candela = 0.0;
      for (const PlacedLamp& lamp : input.lamps) {
        expected_lx += illuminance_lx(lamp.position_m, lamp.world_from_image, beam_, 1.0, sample.point.position_m,
                                      sample.point.normal);
        const glm::dvec3 way = lamp.position_m - sample.point.position_m;
        per_candela += glm::dot(way, sample.point.normal) / std::pow(glm::length(way), 3.0);
      }
      const double error_lx = std::abs(sample.illuminance_lx - expected_lx);
      found.rms_lx += error_lx * error_lx / 4000.0;
      found.worst_lx = std::max(found.worst_lx, error_lx);
      found.most_lx = std::max(found.most_lx, expected_lx);
      found.steps_lx = std::max(found.steps_lx, 0.5 / 255.0 * kPeak_cd * per_candela);
    }
    found.rms_lx = std::sqrt(found.rms_lx);
    return found;
  }
  IntensityTable beam_ = smooth_beam();
};

// Linear interpolation between points d apart is off by d²/8 of the second derivative: half the side, a quarter of the
// error.
TEST_F(Methods, ThoseByVertexComeNearerWithTheSquareOfTheSide) {
  double before[2] = {0.0, 0.0};
  for (const double side_m : {2.0, 1.0, 0.5, 0.25}) {
    ASSERT_TRUE(renderer->load_scene(road(side_m)).ok());
    const Errors at_pixels = errors(Method::kFragment);
    EXPECT_LT(at_pixels.worst_lx, 2e-5 * at_pixels.most_lx);
    for (const Method method : {Method::kVertex, Method::kVertex1998}) {
      const bool in_1998 = method == Method::kVertex1998;
      const Errors found = errors(method);
      std::printf("  side %g m, %s: rms %.4g lx, worst %.4g lx of %.4g lx\n", side_m,
                  in_1998 ? "vertex-1998" : "vertex", found.rms_lx, found.worst_lx, found.most_lx);
      double& last = before[in_1998 ? 1 : 0];
      // Past the coarsest grid the second derivative is resolved; a tenth is left for what is not.
      if (last > 0.0 && side_m < 1.0) {
        const double steps = in_1998 ? found.steps_lx : 0.0;
        EXPECT_LT(found.rms_lx, 1.1 * last / 4.0 + steps) << side_m << " m";
      }
      last = found.rms_lx;
    }
  }
}

// What interpolation leaves of the method of 1998 on a fine road are the 255 steps of its texture.
TEST_F(Methods, TheTextureOf1998HasItsSteps) {
  ASSERT_TRUE(renderer->load_scene(road(0.125)).ok());
  const Errors by_vertex = errors(Method::kVertex), in_1998 = errors(Method::kVertex1998);
  EXPECT_GT(in_1998.worst_lx, 0.5 * in_1998.steps_lx);
  EXPECT_LT(in_1998.worst_lx, in_1998.steps_lx + 2.0 * by_vertex.worst_lx);
}

TEST_F(Methods, APictureByVertexIsThatOfPixelsWhereTheRoadIsFine) {
  ASSERT_TRUE(renderer->load_scene(road(0.125)).ok());
  FrameInput input = from_above(Method::kFragment);
  input.want_image = true;
  renderer->draw(input);
  const Image8 expected = renderer->read_image();
  input.method = Method::kVertex;
  const FrameResult result = renderer->draw(input);
  const Image8 picture = renderer->read_image();
  int worst = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); ++i)
    worst = std::max(worst, std::abs(int{picture.rgba[i]} - int{expected.rgba[i]}));
  EXPECT_LE(worst, 3) << "of 255";
  EXPECT_EQ(result.pass_count, 1u);
  // Each view by a method of its own.
  ViewInput other = from_above(Method::kFragment);
  other.own_picture = {320, 180};
  other.want_image = true;
  input.more_views = {other};
  renderer->draw(input);
  EXPECT_EQ(renderer->read_image(1).rgba, expected.rgba);
  EXPECT_EQ(renderer->read_image().rgba, picture.rgba);
}

}  // namespace
}  // namespace phare
