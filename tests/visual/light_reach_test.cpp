// Unit: what a lamp is said not to reach, it does not light.
#include "visual/light_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/visual/yard.h"
#include "visual/light_peaks.h"

namespace phare {
namespace {

/// Lit only within a window of its own angles, at several places of a table.
IntensityTable window_table(PhotometricType type, GammaAxis axis, double first_deg, double second_deg,
                            double half_deg) {
  IntensityTable table;
  table.type = type;
  table.axis = axis;
  const bool c = type == PhotometricType::kC;
  for (int i = 0; i <= 72; ++i) table.first_deg.push_back(c ? 5.0 * i : 2.5 * i - 90.0);
  for (int j = 0; j <= 60; ++j) table.second_deg.push_back(c ? 3.0 * j : 3.0 * j - 90.0);
  for (const double second : table.second_deg)
    for (const double first : table.first_deg)
      table.candela.push_back(
          std::abs(first - first_deg) <= half_deg && std::abs(second - second_deg) <= half_deg ? 1000.0 : 0.0);
  return table;
}

std::vector<IntensityTable> tables() {
  std::vector<IntensityTable> all;
  for (const PhotometricType type : {PhotometricType::kA, PhotometricType::kB, PhotometricType::kC})
    for (const GammaAxis axis : {GammaAxis::kGamma0, GammaAxis::kGamma90})
      for (const auto& [first, second, half] :
           {std::tuple(0.0, 0.0, 12.0), {40.0, 20.0, 10.0}, {60.0, 80.0, 15.0}, {0.0, 0.0, 200.0}})
        all.push_back(window_table(type, axis, first, second, half));
  IntensityTable screen = window_table(PhotometricType::kA, GammaAxis::kGamma0, 0.0, 0.0, 20.0);
  screen.screen_distance_m = 10.0;
  for (std::vector<double>* nodes : {&screen.first_deg, &screen.second_deg})
    for (double& node : *nodes) node *= 0.4;
  all.push_back(std::move(screen));
  return all;
}

TEST(LightReach, NothingThatIsLitAndSeenIsLeftOut) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0), angle(-std::numbers::pi, std::numbers::pi);
  int lit = 0, left_out = 0, cases = 0, boxes_lit = 0, boxes_left_out = 0;
  for (const IntensityTable& table : tables()) {
    const AimedSource source{.table = &table};
    const BeamImage image = compose_beam_image(std::span(&source, 1));
    const LightCone cone = light_cone(image);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 position_m{20.0 * any(random), 20.0 * any(random), any(random)};
      const glm::dmat3 turn = aim_rotation(angle(random), 0.5 * any(random), 0.3 * any(random));
      const LampReach reach(position_m, turn * image.car_from_image, cone);
      Camera camera;
      camera.world_from_eye = aim_rotation(angle(random), 0.3 * any(random), 0.0);
      camera.fov_horizontal_rad = 0.4 + 0.3 * any(random);
      if (i % 5 == 0) camera.orthographic_width_m = 10.0;
      camera.eye_m = {any(random), any(random), any(random)};
      const ViewGeometry view(camera, 1.6);
      const bool meets = reach.meets(view);
      ++cases;
      left_out += !meets;
      for (int k = 0; k < 300; ++k) {
        // Points that the view sees.
        const Ray ray =
            view.ray_through(160.0 * (1.0 + any(random)) - 0.5, 100.0 * (1.0 + any(random)) - 0.5, 320, 200);
        const glm::dvec3 point = ray.origin_m + std::exp(3.0 + 3.0 * any(random)) * ray.direction;
        const double cd = table.intensity_cd(glm::transpose(turn) * (point - position_m));
        lit += cd > 0.0;
        ASSERT_TRUE(cd == 0.0 || meets) << "type " << static_cast<int>(table.type) << ", " << cd << " cd";
        // A box about the point.
        const glm::dvec3 low = point - glm::dvec3(2.0, 1.0, 0.5), high = point + glm::dvec3(1.0, 2.0, 3.0);
        const bool box = reach.meets(low, high);
        boxes_left_out += !box;
        boxes_lit += cd > 0.0;
        ASSERT_TRUE(cd == 0.0 || box);
      }
    }
  }
  std::printf("%d of %d views are left out, %d points were lit; %d boxes were left out\n", left_out, cases, lit,
              boxes_left_out);
  EXPECT_GT(lit, 100000);
  EXPECT_GT(left_out, cases / 5) << "a bound that leaves nothing out is none";
  EXPECT_GT(boxes_left_out, boxes_lit / 4);
}

// The mirror: lamps whose tables reach 90° to all sides light nothing of what lies behind the car.
TEST(LightReach, AViewBackwardFromBehindTheLampsIsDarkHoweverWideTheTable) {
  const IntensityTable table = window_table(PhotometricType::kA, GammaAxis::kGamma0, 0.0, 0.0, 200.0);
  const AimedSource source{.table = &table};
  const LightCone cone = light_cone(compose_beam_image(std::span(&source, 1)));
  EXPECT_GT(cone.half_angle_rad, 0.5 * std::numbers::pi);
  Camera camera;
  camera.eye_m = {-1.9, 0.37, 1.22};
  for (const double y_m : {0.6, -0.6}) {
    const LampReach reach({0.0, y_m, 0.65}, aim_rotation(0.0, -0.01, 0.0), cone);
    camera.world_from_eye = aim_rotation(std::numbers::pi, 0.0, 0.0);
    EXPECT_FALSE(reach.meets(ViewGeometry(camera, 3.0)));
    camera.world_from_eye = aim_rotation(0.55 * std::numbers::pi, 0.0, 0.0);
    EXPECT_TRUE(reach.meets(ViewGeometry(camera, 3.0))) << "aside it may";
  }
}

TEST(LightReach, TheConeIsHardlyWiderThanTheLight) {
  const IntensityTable table = window_table(PhotometricType::kA, GammaAxis::kGamma0, 0.0, 0.0, 10.0);
  const AimedSource source{.table = &table};
  const LightCone cone = light_cone(compose_beam_image(std::span(&source, 1)));
  EXPECT_GT(glm::dot(cone.axis, glm::dvec3(1, 0, 0)), 0.999);
  // Light ends a node beyond the window, at 12.5° and 12°: its corner is 17.2° out. Margins: 0.7° each way, half a
  // step.
  const double corner_deg = 17.2;
  EXPECT_GT(cone.half_angle_rad * 180.0 / std::numbers::pi, corner_deg);
  EXPECT_LT(cone.half_angle_rad * 180.0 / std::numbers::pi, corner_deg + 2.0);
}

TEST(LightReach, ADarkBeamReachesNothingAndAChangeWidensTheCone) {
  EXPECT_LT(light_cone(compose_beam_image({})).half_angle_rad, 0.0);
  const IntensityTable narrow = window_table(PhotometricType::kA, GammaAxis::kGamma0, 0.0, 0.0, 6.0);
  const IntensityTable wide = window_table(PhotometricType::kA, GammaAxis::kGamma0, 30.0, 0.0, 6.0);
  const AimedSource a{.table = &narrow}, b{.table = &wide};
  const LightCone before = light_cone(compose_beam_image(std::span(&a, 1)));
  const BeamImage image = compose_beam_image(std::span(&b, 1));
  const TexelRect whole{0, 0, image.first_deg.size(), image.second_deg.size()};
  const LightCone after = light_cone_after(before, image, std::span(&whole, 1));
  EXPECT_GT(after.half_angle_rad, before.half_angle_rad + 0.4);
  EXPECT_EQ(light_cone_after(before, image, {}).half_angle_rad, before.half_angle_rad);
}

// A bound from above, wherever one asks and however large a part; and one that tells dark parts of a beam from lit
// ones.
TEST(LightPeaks, NoDirectionHasMoreThanIsTold) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::size_t asked = 0, told_dark = 0;
  for (const IntensityTable& table : tables()) {
    const AimedSource source{.table = &table};
    const BeamImage image = compose_beam_image(std::span(&source, 1));
    LightPeaks peaks;
    peaks.set(image);
    for (int i = 0; i < 400; ++i) {
      const glm::dvec2 middle(3.5 * any(random), any(random)),
          half = glm::abs(glm::dvec2(any(random), 0.3 * any(random)));
      const glm::dvec2 least = middle - half, most = middle + half;
      double brightest_cd = 0.0;
      for (int k = 0; k < 60; ++k) {
        const glm::dvec2 at = middle + half * glm::dvec2(any(random), any(random));
        brightest_cd = std::max(brightest_cd, table.intensity_cd({1.0, at.x, at.y}));
      }
      // The image holds float32.
      if (brightest_cd > 0.0) {
        EXPECT_TRUE(peaks.exceeds(least, most, static_cast<float>(0.9999 * brightest_cd)))
            << "type " << static_cast<int>(table.type) << ": " << brightest_cd << " cd between " << least.x << " and "
            << most.x << ", " << least.y << " and " << most.y;
      }
      ++asked, told_dark += peaks.exceeds(least, most, 0.0f) ? 0 : 1;
      EXPECT_FALSE(peaks.exceeds(least, most, 1000.5f)) << "more than the table has";
    }
  }
  EXPECT_GT(told_dark, asked / 4);
  EXPECT_FALSE(LightPeaks().exceeds({-1.0f, -1.0f}, {1.0f, 1.0f}, 0.0f)) << "a dark beam";
}

// More than a hundredth of the brightest, past 75° to the side or past 45° up: by where nodes have it.
TEST(LightPeaks, TellLightPastTheSidesOfMaps) {
  const auto peaks_of = [](double side_deg, double up_deg, double cd) {
    IntensityTable table;
    for (int deg = -90; deg <= 90; ++deg) table.first_deg.push_back(deg), table.second_deg.push_back(deg);
    for (const double v : table.second_deg)
      for (const double h : table.first_deg)
        table.candela.push_back(h == 0.0 && v == 0.0 ? 1000.0 : h == side_deg && v == up_deg ? cd : 0.0);
    const AimedSource source{.table = &table};
    LightPeaks peaks;
    peaks.set(compose_beam_image(std::span(&source, 1)));
    return std::pair(peaks.is_wide(), peaks.is_high());
  };
  EXPECT_EQ(peaks_of(30, 35, 1000), std::pair(false, false));
  EXPECT_EQ(peaks_of(70, 0, 1000), std::pair(false, false));
  EXPECT_EQ(peaks_of(80, 0, 20), std::pair(true, false));
  EXPECT_EQ(peaks_of(-80, 0, 9), std::pair(false, false)) << "less than a hundredth";
  EXPECT_EQ(peaks_of(0, -50, 20), std::pair(false, true));
  EXPECT_EQ(peaks_of(0, 50, 9), std::pair(false, false));
  EXPECT_FALSE(LightPeaks().is_wide() || LightPeaks().is_high()) << "a dark beam";
}

// A part that changes counts at once, there and where light runs on to the next node; and when it is as it was, so is
// all that is told: a picture must not hang on what was lit before it.
TEST(LightPeaks, AreThoseOfTheBeamAsItIsNow) {
  const IntensityTable table = window_table(PhotometricType::kA, GammaAxis::kGamma0, 0.0, 0.0, 5.0);
  const AimedSource source{.table = &table};
  BeamImage image = compose_beam_image(std::span(&source, 1));
  LightPeaks peaks;
  peaks.set(image);
  const glm::vec2 least(0.55f, 0.2f), most(0.6f, 0.25f);  // 30° to the left, 12° up
  ASSERT_FALSE(peaks.exceeds(least, most, 0.0f));
  const auto nearest = [](const std::vector<double>& nodes, double deg) {
    const auto found = std::ranges::min_element(nodes, {}, [deg](double node) { return std::abs(node - deg); });
    return static_cast<std::size_t>(found - nodes.begin());
  };
  const TableAngles at = table_angles(image.type, image.axis, {1.0, 0.575, 0.225});
  const std::size_t column = nearest(image.first_deg, at.first_deg), row = nearest(image.second_deg, at.second_deg);
  float& node_cd = image.candela[row * image.first_deg.size() + column];
  node_cd = 4000.0f;
  const TexelRect changed{column, row, column + 1, row + 1};
  peaks.change(image, std::span(&changed, 1));
  EXPECT_TRUE(peaks.exceeds(least, most, 3999.0f));
  EXPECT_TRUE(peaks.exceeds({-0.01f, -0.01f}, {0.01f, 0.01f}, 999.0f)) << "what shone before";
  node_cd = 0.0f;
  peaks.change(image, std::span(&changed, 1));
  EXPECT_FALSE(peaks.exceeds(least, most, 0.0f));
}

}  // namespace
}  // namespace phare
