// Unit: the floor that frame times are quoted in computes the light it says, so that it is no shortcut.
#include "tests/bench/floor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bench/straight_road.h"
#include "visual/photometry/table/illuminance.h"

namespace phare::bench {
namespace {

TEST(Floor, LightsTheRoadAsFloat64Does) {
  if (!Floor::possible()) GTEST_SKIP() << "this processor has no AVX2 and FMA";
  constexpr int kWidth = 640, kHeight = 360;
  const IntensityTable beam = straight_road_beam(Nodes::kEven);
  Floor floor(beam, kWidth, kHeight);
  const FrameInput input = straight_road_view(3.0);
  const ViewGeometry view(input.camera, static_cast<double>(kWidth) / kHeight);
  std::size_t judged = 0;
  double sum = 0.0, worst = 0.0;
  for (int row = kHeight / 2 + 5; row < kHeight; row += 7) {
    const std::vector<float> lx = floor.illuminance_lx(3.0f, row);
    for (int column = 0; column < kWidth; column += 11) {
      const Ray ray = view.ray_through(column, row, kWidth, kHeight);
      const glm::dvec3 point = ray.origin_m + ray.direction * (-ray.origin_m.z / ray.direction.z);
      double expected = 0.0;
      for (const PlacedLamp& lamp : input.lamps)
        expected += illuminance_lx(lamp.position_m, lamp.world_from_image, beam, 1.0, point, {0.0, 0.0, 1.0});
      if (expected < 1.0) continue;
      ++judged;
      const double off = std::abs(static_cast<double>(lx[static_cast<std::size_t>(column)]) / expected - 1.0);
      sum += off;
      worst = std::max(worst, off);
    }
  }
  ASSERT_GT(judged, 500u);
  // 1024 tangents over ±1 are 0.11° apart, the cut-off's logistic is 0.1° wide: up to some per cent there, 0.1 %
  // elsewhere.
  EXPECT_LT(sum / static_cast<double>(judged), 2e-3);
  EXPECT_LT(worst, 0.1);
  floor.draw(3.0f);
  EXPECT_GT(floor.rgba()[static_cast<std::size_t>(kWidth) * (kHeight - 40) + kWidth / 2], 0xff101010u);
}

TEST(StraightRoad, IsTheRoadThatOthersWereTimedOn) {
  const Scene scene = straight_road();
  EXPECT_NEAR(static_cast<double>(scene.indices.size()) / 3.0, 732.0, 50.0);
  EXPECT_EQ(scene.materials.size(), 6u);
  for (const SceneChunk& chunk : scene.chunks) {
    for (std::uint32_t i = 0; i < chunk.index_count; i += 3) {
      const auto at = [&](std::uint32_t k) -> const SceneVertex& {
        return scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i + k]];
      };
      const glm::vec3 turn = glm::cross(at(1).position_m - at(0).position_m, at(2).position_m - at(0).position_m);
      ASSERT_GT(glm::dot(turn, at(0).normal), 0.0f) << chunk.node << ": seen from where its normal points";
    }
  }
}

}  // namespace
}  // namespace phare::bench
