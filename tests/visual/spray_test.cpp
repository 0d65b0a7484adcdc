// Spray behind vehicles: as much as the model says, on the device as a float64 integral through the same cloud has it,
// the same from its time alone, and nothing where there is none.
#include "visual/spray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "shaders/lib/luminance.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/ground_water.h"

namespace phare {
namespace {

constexpr auto kSpray = static_cast<std::size_t>(Effect::kSpray);
constexpr auto kGround = static_cast<std::size_t>(Effect::kWetGround);
constexpr std::size_t kWet = 2;
constexpr double kWater_mm = 0.4;  // of that level without rain

/// A car that goes ahead at 25 m/s, its rear wheels `ahead_m` from the origin now.
SprayingVehicle car(double ahead_m, double time_s = 12.34) {
  SprayingVehicle vehicle{.speed_mps = 25.0, .time_s = time_s, .number = 3};
  for (std::size_t i = 0; i < 3; ++i)
    vehicle.wheels_m[i] = {ahead_m - 0.5 * static_cast<double>(i) * kSprayAge_s * vehicle.speed_mps, 0.0, 0.0};
  vehicle.tail_m = {glm::dvec3(ahead_m - 0.7, 0.6, 0.8), {ahead_m - 0.7, -0.6, 0.8}};
  return vehicle;
}

TEST(Spray, GrowsWithSpeedAndWater) {
  EXPECT_EQ(spray_share_01(30.0 / 3.6), 0.0);
  EXPECT_NEAR(spray_share_01(100.0 / 3.6), 0.05, 1e-12);
  EXPECT_NEAR(spray_share_01(65.0 / 3.6), 0.0125, 1e-12);
  EXPECT_EQ(spray_share_01(100.0), 0.1);
  // By hand: 5 % of 0.4 m by 0.9 mm are 1.8e-5 m3 a metre; drops of 0.2 mm meet 7500 m2 of a m3.
  SprayingVehicle vehicle = car(20.0);
  vehicle.speed_mps = 100.0 / 3.6;
  EXPECT_NEAR(spray_scatters_m2_per_m(vehicle, 0.9), 0.135, 1e-9);
  EXPECT_EQ(water_mm(0.0, 0), 0.0);
  EXPECT_NEAR(water_mm(10.0, 2), 0.53, 0.01) << "0.27 mm below the texture of 0.8 mm";
  EXPECT_NEAR(water_mm(50.0, 3), 1.37, 0.01);
}

TEST(Spray, AColumnHoldsAllOfItsPuff) {
  double sum = 0.0;
  constexpr int kRings = 2000;
  for (int i = 0; i < kRings; ++i) {
    const double b = (i + 0.5) / kRings;
    sum += 2.0 * std::numbers::pi * b / kRings * static_cast<double>(shader::spray_column(static_cast<float>(b * b)));
  }
  EXPECT_NEAR(sum, 1.0, 1e-5) << "middles of rings, and float32";
}

// Over many moments the puffs hold what the wheels throw up, less what has settled.
TEST(Spray, PuffsHoldWhatTheModelSays) {
  const SprayingVehicle at = car(60.0);
  double mean = 0.0, square = 0.0, expected = 0.0;
  constexpr int kMoments = 400, kSteps = 4000;
  for (int k = 0; k < kMoments; ++k) {
    SprayingVehicle vehicle = at;
    vehicle.time_s = 5.0 + 3.71 * k;
    const shader::GpuSpray spray = spray_of(vehicle, kWater_mm, {-100.0, 0.0, 1.2});
    double all = 0.0;
    for (shader::uint i = 0; i < shader::kSprayPuffs; ++i)
      all += static_cast<double>(shader::spray_puff(spray, i).scatters_m2);
    mean += all / kMoments, square += all * all / kMoments;
  }
  const double per_s = spray_scatters_m2_per_m(at, kWater_mm) * at.speed_mps;
  for (int i = 0; i < kSteps; ++i) {
    const double age = (i + 0.5) / kSteps * kSprayAge_s;
    const auto part = [&](double from, double to, double x) {
      const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
      return t * t * (3.0 - 2.0 * t);
    };
    expected += per_s * kSprayAge_s / kSteps * std::exp(-age / kSprayLife_s) * part(0.0, 0.1, age) *
                (1.0 - part(0.8, 1.0, age / kSprayAge_s));
  }
  const double error = std::sqrt((square - mean * mean) / kMoments);
  std::printf("%.4f m2 of spray, +- %.4f; %.4f by the integral\n", mean, error, expected);
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(mean, expected, 4.0 * error) << "four times the scatter of their mean";
}

TEST(Spray, TheNearestInViewAreDrawnFarthestFirst) {
  Camera camera;
  camera.eye_m = {0.0, 0.0, 1.2};
  const ViewGeometry view(camera, 16.0 / 9.0);
  std::vector<SprayingVehicle> vehicles;
  for (const double ahead_m : {30.0, 90.0, -60.0, 140.0, 60.0, 120.0, 200.0}) vehicles.push_back(car(ahead_m));
  vehicles.push_back(car(40.0));
  vehicles.back().speed_mps = 5.0;
  const auto seen = spraying_seen(view, vehicles);
  ASSERT_EQ(seen.size(), kMostSpraying);
  std::vector<double> ahead_m;
  for (const SprayingVehicle& one : seen) ahead_m.push_back(one.wheels_m[0].x);
  EXPECT_EQ(ahead_m, (std::vector{120.0, 90.0, 60.0, 30.0}));
}

class SprayOnDevice : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer != nullptr) renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  }
  /// Low beams with a cut-off before a wall that is 200 m away, a car between.
  static FrameInput following(double ahead_m, double time_s = 12.34) {
    FrameInput input = driver_view();
    input.sky_luminance_cdm2 = 0.0;
    input.effects[kGround] = kWet;
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
    input.spraying = {car(ahead_m, time_s)};
    input.want_hdr = true;
    return input;
  }
  static Scene wall(float rho) {
    Scene scene = black_wall(200.0);
    scene.materials[0].reflectance = glm::vec3(rho);
    return scene;
  }
  std::vector<double> luminance(const FrameInput& input) {
    renderer->draw(input);
    const ImageF image = renderer->read_hdr();
    std::vector<double> values;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      values.push_back(static_cast<double>(
          shader::luminance_of(glm::vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]))));
    return values;
  }

  struct Ray64 {
    double cdm2 = 0.0, left_01 = 1.0;
  };
  /// Light scattered once into a line of sight, in float64, by the same puffs: every point in its own light, spray that
  /// overlaps mixed.
  static Ray64 integral(const FrameInput& input, const IntensityTable& table, const glm::dvec3& way) {
    static constexpr double kStep_m = 0.05, kTo_m = 80.0;
    const shader::GpuSpray spray = spray_of(input.spraying[0], kWater_mm, input.camera.eye_m);
    struct Crossed {
      double along_m, b2, radius_m, scatters_m2;
    };
    std::vector<Crossed> crossed;
    for (shader::uint i = 0; i < shader::kSprayPuffs; ++i) {
      const shader::SprayPuff puff = shader::spray_puff(spray, i);
      const glm::dvec3 middle(puff.middle);
      const double along = glm::dot(middle, way), b2 = glm::dot(middle, middle) - along * along;
      const auto radius = static_cast<double>(puff.radius_m);
      if (puff.scatters_m2 > 0.0f && b2 < radius * radius)
        crossed.push_back({along, b2, radius, static_cast<double>(puff.scatters_m2)});
    }
    Ray64 ray;
    if (crossed.empty()) return ray;
    for (double s = 0.5 * kStep_m; s < kTo_m; s += kStep_m) {
      double per_m = 0.0;
      for (const Crossed& one : crossed) {
        const double r2 = ((s - one.along_m) * (s - one.along_m) + one.b2) / (one.radius_m * one.radius_m);
        if (r2 < 1.0)
          per_m += one.scatters_m2 * (1.0 - r2) * (1.0 - r2) * 105.0 /
                   (32.0 * std::numbers::pi * std::pow(one.radius_m, 3.0));
      }
      if (per_m <= 0.0) continue;
      const glm::dvec3 point = input.camera.eye_m + way * s;
      double lit = 0.0;
      for (const PlacedLamp& lamp : input.lamps) {
        const glm::dvec3 from = point - lamp.position_m;
        const double r = glm::length(from);
        lit += table.intensity_cd(glm::transpose(lamp.world_from_image) * from) / (r * r) *
               henyey_greenstein_per_sr(kSprayG, std::acos(std::clamp(-glm::dot(from, way) / r, -1.0, 1.0)));
      }
      for (const glm::dvec3& tail : input.spraying[0].tail_m) {
        const glm::dvec3 from = point - tail;
        const double r = std::max(glm::length(from), 1e-3);
        lit += input.spraying[0].tail_cd * std::max(-from.x / r, 0.0) / (r * r) *
               henyey_greenstein_per_sr(kSprayG, std::acos(std::clamp(-glm::dot(from, way) / r, -1.0, 1.0)));
      }
      const double through = std::exp(-per_m * kStep_m);
      ray.cdm2 += ray.left_01 * (1.0 - through) * lit;
      ray.left_01 *= through;
    }
    return ray;
  }

  struct Differences {
    double sum = 0.0, median = 0.0, most = 0.0, least_left_01 = 1.0, brightest_cdm2 = 0.0;
  };
  /// Of the picture with spray from the integral, among pixels that have a tenth of the brightest spray; `most` over
  /// the brightest.
  Differences differences(FrameInput input, const IntensityTable& table) {
    renderer->set_beam(0, image_of(table));
    EXPECT_TRUE(renderer->load_scene(wall(0.0f)).ok());
    const std::vector<double> with = luminance(input);
    const ViewGeometry geometry(input.camera, 16.0 / 9.0);
    std::vector<std::pair<double, double>> rays;  // by the device, by the integral
    Differences found;
    double device = 0.0, reference = 0.0;
    for (int y = 2; y < 180; y += 4)
      for (int x = 2; x < 320; x += 4) {
        const auto at = static_cast<std::size_t>(y * 320 + x);
        const Ray64 ray = integral(input, table, geometry.ray_through(x, y, 320, 180).direction);
        rays.emplace_back(with[at], ray.cdm2);
        device += with[at], reference += ray.cdm2;
        found.brightest_cdm2 = std::max(found.brightest_cdm2, ray.cdm2);
        found.least_left_01 = std::min(found.least_left_01, ray.left_01);
      }
    std::vector<double> shares;
    for (const auto& [got, wanted] : rays) {
      found.most = std::max(found.most, std::abs(got - wanted) / found.brightest_cdm2);
      if (wanted >= 0.1 * found.brightest_cdm2) shares.push_back(std::abs(got / wanted - 1.0));
    }
    std::ranges::nth_element(shares, shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2));
    found.median = shares[shares.size() / 2];
    found.sum = device / reference - 1.0;
    std::printf("sum %+.4f, median %.4f of %zu rays, worst %.3f of the brightest %.4g cd/m2; %.3f left at least\n",
                found.sum, found.median, shares.size(), found.most, found.brightest_cdm2, found.least_left_01);
    return found;
  }
};

TEST_F(SprayOnDevice, IsTheIntegralThroughItsCloud) {
  IntensityTable even;
  even.first_deg = even.second_deg = {-60.0, 0.0, 60.0};
  even.candela.assign(9, 1000.0);
  const Differences alike = differences(following(45.0), even);
  const Differences cut = differences(following(45.0), cut_off_table(PhotometricType::kA, GammaAxis::kGamma0));
  FrameInput tail = following(30.0);
  tail.spraying[0].tail_cd = 8.0;
  IntensityTable faint = even;
  faint.candela.assign(9, 1e-3);  // that a lamp is lit
  const Differences red = differences(tail, faint);
  EXPECT_LT(alike.least_left_01, 0.9) << "there was something to be looked through";
  // Half floats are cut off, 2.5e-4 in the mean for each of up to 40 puffs in a row; 1/r² over a puff is R²/3r² more
  // than in its middle, 0.7 % at 12 m; and of puffs that overlap the nearer one counts as wholly before the other: with
  // a quarter taken, 2 % for light that is half as strong at the far end.
  EXPECT_LT(std::abs(alike.sum), 0.05);
  // Besides, a cut-off of 0.2° is a line over a strip of 0.3°, up to 2 % to either side of the light that a puff has.
  EXPECT_LT(std::abs(cut.sum), 0.07);
  // A lamp in the midst of a puff of 0.7 m that counts as 0.3 m aside gives it half; that puff has a third of its
  // light.
  EXPECT_LT(std::abs(red.sum), 0.2);
}

// Of no other light than its tail lamps' it has their colour, in half floats: 1 part in 1000 of each value.
TEST_F(SprayOnDevice, HasTheColourOfItsTailLamps) {
  ASSERT_TRUE(renderer->load_scene(wall(0.0f)).ok());
  IntensityTable faint;  // that a lamp is lit
  faint.first_deg = faint.second_deg = {-60.0, 0.0, 60.0};
  faint.candela.assign(9, 1e-3);
  renderer->set_beam(0, image_of(faint));
  FrameInput input = following(30.0);
  const auto mean = [&](const glm::vec3& colour) {
    input.spraying[0].tail_colour = colour;
    input.spraying[0].tail_cd = 800.0;
    renderer->draw(input);
    const ImageF image = renderer->read_hdr();
    glm::dvec3 sum{0.0};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      sum += glm::dvec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]);
    return sum;
  };
  const glm::dvec3 red = mean(kSignalRed), amber = mean({2.5f, 0.65f, 0.05f});
  EXPECT_GT(red.x, 0.0);
  EXPECT_NEAR(red.y / red.x, 0.02, 2e-4);
  EXPECT_NEAR(amber.z / amber.x, 0.02, 2e-4);
  EXPECT_NEAR(amber.y / amber.x, (1.0 - 0.2126 * 2.5 - 0.0722 * 0.05) / 0.7152 / 2.5, 2e-3);
}

// What lies behind is seen by what the cloud leaves: of a wall a thousand times as bright as the spray before it.
TEST_F(SprayOnDevice, DimsWhatLiesBehind) {
  ASSERT_TRUE(renderer->load_scene(wall(1.0f)).ok());
  FrameInput input = following(45.0);
  IntensityTable table;
  table.first_deg = table.second_deg = {-60.0, 0.0, 60.0};
  table.candela.assign(9, 1000.0);
  renderer->set_beam(0, image_of(table));
  for (PlacedLamp& lamp : input.lamps) lamp.position_m = {199.0, 0.0, 0.0};
  const std::vector<double> with = luminance(input);
  input.effects[kSpray] = 0;
  const std::vector<double> without = luminance(input);
  const ViewGeometry geometry(input.camera, 16.0 / 9.0);
  double worst = 0.0, least = 1.0;
  for (int y = 2; y < 180; y += 4)
    for (int x = 2; x < 320; x += 4) {
      const auto at = static_cast<std::size_t>(y * 320 + x);
      if (without[at] < 1.0) continue;
      const double left = integral(input, table, geometry.ray_through(x, y, 320, 180).direction).left_01;
      worst = std::max(worst, std::abs(with[at] / without[at] - left));
      least = std::min(least, left);
    }
  std::printf("%.3f left at least, worst difference %.2g\n", least, worst);
  EXPECT_LT(least, 0.85);
  // Up to 40 puffs lie one behind the other, each mixed in half floats, which are cut off: 5e-4 of what is there.
  EXPECT_LT(worst, 40 * 5e-4);
}

TEST_F(SprayOnDevice, FollowsFromTheTimeAlone) {
  ASSERT_TRUE(renderer->load_scene(wall(0.1f)).ok());
  const std::vector<double> now = luminance(following(30.0));
  EXPECT_NE(luminance(following(30.0, 12.40)), now);
  EXPECT_EQ(luminance(following(30.0)), now) << "to the bit";
}

TEST_F(SprayOnDevice, CostsNothingWhereNoneIsThrownUp) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = following(22.0);
  input.want_hdr = false, input.want_image = true;
  const std::vector<SprayingVehicle> vehicles = std::exchange(input.spraying, {});
  const auto counts = [&](const FrameInput& of) {
    renderer->draw(of);  // what the frame before left is gone
    const FrameResult result = renderer->draw(of);
    return std::tuple(result.pass_count, result.draws, result.triangles, result.images, result.image_bytes,
                      result.pipelines_made, renderer->read_image().rgba);
  };
  const auto before = counts(input);
  input.spraying = vehicles;
  const FrameResult shown = renderer->draw(input);
  EXPECT_EQ(shown.effects[Effect::kSpray].reason, "1 vehicle throws up water of 0.4 mm");
  EXPECT_EQ(shown.effects[Effect::kHdrImage].reason, "spray mixes luminance in cd/m²");
  EXPECT_EQ(shown.pass_count, std::get<0>(before) + 1) << "the tone curve";
  EXPECT_EQ(shown.draws, std::get<1>(before) + 2) << "the cloud, and the tone curve";
  EXPECT_NE(renderer->read_image().rgba, std::get<6>(before));
  input.effects[kSpray] = 0;
  EXPECT_EQ(counts(input), before);
  input.effects[kSpray].reset();
  input.spraying[0].speed_mps = 5.0;
  EXPECT_EQ(counts(input), before) << "too slow";
  input.spraying = {car(-80.0)};
  EXPECT_EQ(counts(input), before) << "out of view";
  input.spraying = vehicles;
  input.effects[kGround] = 0;
  const FrameResult dry = renderer->draw(input);
  EXPECT_FALSE(dry.effects.on(Effect::kSpray));
  EXPECT_EQ(dry.pass_count, std::get<0>(before));
}

}  // namespace
}  // namespace phare
