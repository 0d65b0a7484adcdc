// Wet ground: the functions of shaders/lib/wet.h against figures worked out elsewhere, and on the device against them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "shaders/lib/wet.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/lit_scene.h"

namespace phare {
namespace {

// Lekner and Dorf's body, and Fresnel's equations, as another program has them; of the body with r_i rounded to 0.475.
TEST(WetGround, IsAsDarkAsLeknerAndDorfHaveIt) {
  for (const auto& [dry, wet] :
       {std::pair(0.05f, 0.0251f), std::pair(0.1f, 0.0515f), std::pair(0.2f, 0.1084f), std::pair(0.3f, 0.1716f)})
    EXPECT_NEAR(shader::wet_reflectance(glm::vec3(dry)).x, wet, 2e-4f) << dry;
  EXPECT_EQ(shader::wet_reflectance(glm::vec3(0.0f)).x, 0.0f);
  EXPECT_LE(shader::wet_reflectance(glm::vec3(1.0f)).x, 1.0f);
}

TEST(WetGround, MirrorsAsFresnelHasIt) {
  for (const auto& [deg, share] : {std::pair(60.0, 0.060), std::pair(80.0, 0.348), std::pair(85.0, 0.584),
                                   std::pair(88.76, 0.873), std::pair(0.0, 0.0204), std::pair(90.0, 1.0)})
    EXPECT_NEAR(shader::mirrored_by_water(static_cast<float>(std::cos(deg * std::numbers::pi / 180.0))), share, 6e-4)
        << deg;
}

/// Light that the film mirrors into all directions is no more than what it mirrors at all, and of a smooth film near
/// to that: nothing is gained, and at angles that are not grazing little is lost.
TEST(WetGround, SendsOutNoMoreThanFresnelLets) {
  for (const float alpha : kWetAlpha)
    for (const double deg : {0.0, 40.0, 70.0, 85.0}) {
      if (alpha == 0.0f) continue;
      const double lamp = std::cos(deg * std::numbers::pi / 180.0);
      const glm::dvec3 to_lamp(std::sqrt(1.0 - lamp * lamp), 0.0, lamp);
      // Over facets: half ways, of which a solid angle is a quarter of the mirrored one over the cosine.
      double sum = 0.0;
      constexpr int kSteps = 400;
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double u = (i + 0.5) / kSteps, around = 2.0 * std::numbers::pi * (j + 0.5) / kSteps;
          const double a2 = static_cast<double>(alpha) * static_cast<double>(alpha);
          const double tan2 = a2 * u / (1.0 - u), c = 1.0 / std::sqrt(1.0 + tan2), s = std::sqrt(1.0 - c * c);
          const glm::dvec3 facet(s * std::cos(around), s * std::sin(around), c);
          const double against = glm::dot(facet, to_lamp);
          const glm::dvec3 out = 2.0 * against * facet - to_lamp;
          if (against <= 0.0 || out.z <= 0.0) continue;
          const double density = a2 / (std::numbers::pi * std::pow(c * c * (a2 - 1.0) + 1.0, 2.0)) * c;  // of facets
          const double lobe =
              static_cast<double>(shader::water_lobe(alpha, static_cast<float>(lamp), static_cast<float>(out.z),
                                                     static_cast<float>(c), static_cast<float>(against)));
          sum += lobe * out.z * 4.0 * against / density / (kSteps * kSteps);
        }
      const double fresnel = static_cast<double>(shader::mirrored_by_water(static_cast<float>(lamp)));
      if (static_cast<double>(alpha) * std::tan(deg * std::numbers::pi / 180.0) < 0.2) {
        EXPECT_NEAR(sum / fresnel, 1.0, 0.12) << alpha << ", " << deg;
      }
      EXPECT_LE(sum, fresnel * 1.12) << alpha << ", " << deg;
      EXPECT_LE(sum, 1.0);
    }
}

class WetGroundOnDevice : public SharedRenderer {
 protected:
  static Scene ground(float reflectance, Surface surface) {
    Scene scene;
    scene.materials = {{.name = "ground", .reflectance = glm::vec3(reflectance), .surface = surface}};
    for (const auto& [x, y] :
         {std::pair(-50.0, -100.0), std::pair(150.0, -100.0), std::pair(150.0, 100.0), std::pair(-50.0, 100.0)})
      scene.vertices.push_back({glm::vec3(x, y, 0.0), glm::vec3(0, 0, 1)});
    scene.indices = {0, 1, 2, 0, 2, 3};
    scene.chunks = {
        {.node = "ground", .low_m = {-50, -100, 0}, .high_m = {150, 100, 0}, .index_count = 6, .vertex_count = 4}};
    return scene;
  }
  static IntensityTable even_lamp() {
    IntensityTable table;
    table.first_deg = {-80.0, 0.0, 80.0};
    table.second_deg = {-80.0, 0.0, 80.0};
    table.candela.assign(9, 1000.0);
    return table;
  }
  static FrameInput lit_from(const glm::dvec3& lamp_m, double yaw_rad) {
    FrameInput input;
    input.camera.eye_m = {0.0, 0.0, 1.2};
    input.camera.world_from_eye = aim_rotation(0.0, -0.1, 0.0);
    input.lamps.push_back({.position_m = lamp_m, .world_from_image = aim_rotation(yaw_rad, 0.0, 0.0)});
    input.sky_luminance_cdm2 = 0.0;
    input.want_hdr = true;
    return input;
  }
  static constexpr auto kWet = static_cast<std::size_t>(Effect::kWetGround);
};

/// R_L as measured wet is what the wet marking sends back in the geometry of EN 1436; of one as measured dry the beads
/// lie under water: 12 % of what it sends back beside its body is left, and about half of that.
TEST_F(WetGroundOnDevice, MarkingsKeepWhatWasMeasuredWet) {
  renderer->set_beam(0, image_of(even_lamp()));
  // The eye 0.55 m above the lamp, both looking along the road; the marking is 30 m away.
  FrameInput input = lit_from({0.0, 0.0, 0.65}, 0.0);
  input.camera.world_from_eye = aim_rotation(0.0, -std::atan2(1.2, 30.0), 0.0);
  const double lx = 1000.0 / (30.0 * 30.0 + 0.65 * 0.65);  // on a plane that faces the lamp
  std::optional<double> paint;  // what its wear makes of the first, dry: every class has the same there
  const double body = 0.4 / std::numbers::pi * 0.65 / std::hypot(30.0, 0.65);
  const double body_wet = static_cast<double>(shader::wet_reflectance(glm::vec3(0.4f)).x) / 0.4 * body;
  for (const auto& [name, dry_mcd, wet_mcd] : {std::tuple("EN 1436 R4", 200.0, 1e3 * (0.12 * (0.2 - body) + body_wet)),
                                               {"EN 1436 RW1", 25.0, 25.0},
                                               {"EN 1436 RW2", 35.0, 35.0},
                                               {"EN 1436 RR1", 25.0, 25.0}}) {
    Scene scene = ground(0.4f, Surface::kPaint);
    scene.materials[0].retro = *retroreflection(name, std::nullopt, std::nullopt);
    ASSERT_TRUE(renderer->load_scene(scene).ok());
    for (const std::size_t level : {0u, 2u}) {
      input.effects[kWet] = level;
      renderer->draw(input);
      const ImageF image = renderer->read_hdr();
      // The mean of the pixels about the middle, in whose corner the marking is 30 m away.
      double sum = 0.0;
      for (const int dx : {-1, 0})
        for (const int dy : {-1, 0}) {
          const float* rgb = &image.rgba[4 * (static_cast<std::size_t>(image.height_px / 2 + dy) *
                                                  static_cast<std::size_t>(image.width_px) +
                                              static_cast<std::size_t>(image.width_px / 2 + dx))];
          sum += 0.25 * (0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                         0.0722 * static_cast<double>(rgb[2]));
        }
      const double mcd = 1e3 * sum / lx, expected_mcd = level == 0 ? dry_mcd : wet_mcd;
      if (!paint) paint = mcd / expected_mcd;
      std::printf("%s, %s: %.2f mcd/(lx m2), times %.3f of the paint there\n", name, level == 0 ? "dry" : "wet", mcd,
                  *paint);
      // What is asked of markings at the standard's geometry: 2 %. Of it the film's mirror and half floats take 0.3 %.
      EXPECT_NEAR(mcd, *paint * expected_mcd, 0.02 * *paint * expected_mcd);
    }
  }
}

/// Black ground shows the film alone: an oncoming lamp in its mirror, by the functions above in float64's geometry.
TEST_F(WetGroundOnDevice, ShowsTheFilmOfTheFunctions) {
  renderer->set_beam(0, image_of(even_lamp()));
  ASSERT_TRUE(renderer->load_scene(ground(0.0f, Surface::kAsphalt)).ok());
  FrameInput input = lit_from({50.0, 1.5, 0.65}, std::numbers::pi);
  for (std::size_t level = 1; level < kWetNames.size(); ++level) {
    input.effects[kWet] = level;
    renderer->draw(input);
    const ImageF image = renderer->read_hdr();
    const ViewGeometry view(input.camera, double{1} * image.width_px / image.height_px);
    double worst = 0.0, brightest = 0.0;
    for (const bool find : {true, false})
      for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
          const Ray ray = view.ray_through(x, y, image.width_px, image.height_px);
          if (ray.direction.z >= -1e-3) continue;
          const glm::dvec3 point = ray.origin_m - ray.direction * (ray.origin_m.z / ray.direction.z);
          if (point.x > 140.0 || std::abs(point.y) > 90.0) continue;
          const glm::dvec3 way = input.lamps[0].position_m - point;
          const double r = glm::length(way);
          const glm::dvec3 to_lamp = way / r, half = glm::normalize(to_lamp - ray.direction);
          if (to_lamp.x < 0.2) continue;  // beyond the lamp's table
          const double expected =
              1000.0 / (r * r) * to_lamp.z *
              static_cast<double>(shader::water_lobe(kWetAlpha[level], static_cast<float>(to_lamp.z),
                                                     static_cast<float>(-ray.direction.z), static_cast<float>(half.z),
                                                     static_cast<float>(-glm::dot(half, ray.direction))));
          if (find) {
            brightest = std::max(brightest, expected);
            continue;
          }
          if (expected < 0.01 * brightest) continue;
          const float* rgb = &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
                                              static_cast<std::size_t>(x))];
          const double found = 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                               0.0722 * static_cast<double>(rgb[2]);
          worst = std::max(worst, std::abs(found / expected - 1.0));
        }
    std::printf("%s: brightest %.4g cd/m2, worst relative difference %.2g\n", std::string(kWetNames[level]).c_str(),
                brightest, worst);
    EXPECT_GT(brightest, 0.01);
    // Half floats have 5e-4. A facet's height over the ground is known to 1e-7, and over the width of the flooded lobe,
    // 4e-4 in its square, that is 5e-4 of the lobe at 1 %.
    EXPECT_LT(worst, 5e-3) << kWetNames[level];
  }
}

/// Water takes pipelines of its own; how wet it is, which is a number in the data, takes none. A renderer of its own:
/// that of the other tests may have them.
TEST_F(WetGroundOnDevice, HowWetMakesNoPipeline) {
  Result<Renderer> own = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
  ASSERT_TRUE(own) << own.error().text();
  own->set_beam(0, image_of(even_lamp()));
  ASSERT_TRUE(own->load_scene(ground(0.1f, Surface::kAsphalt)).ok());
  FrameInput input = lit_from({1.5, 0.6, 0.65}, 0.0);
  const auto made = [&](std::size_t level) {
    input.effects[kWet] = level;
    return own->draw(input).pipelines_made;
  };
  made(0);
  EXPECT_GT(made(1), 0u);
  EXPECT_EQ(made(3), 0u);
  EXPECT_EQ(made(2), 0u);
  EXPECT_EQ(own->validation_messages(), 0u);
}

/// By the own lamps ground is darker as its body says; what stands upright, and dry ground, stay as they were.
TEST_F(WetGroundOnDevice, IsDarkerByItsOwnLampsAndCostsNothingDry) {
  renderer->set_beam(0, image_of(even_lamp()));
  ASSERT_TRUE(renderer->load_scene(ground(0.1f, Surface::kAsphalt)).ok());
  FrameInput input = lit_from({1.5, 0.6, 0.65}, 0.0);
  const auto drawn = [&](std::size_t level) {
    input.effects[kWet] = level;
    const FrameResult result = renderer->draw(input);
    return std::pair(renderer->read_hdr().rgba, result);
  };
  const auto [dry, dry_frame] = drawn(0);
  const auto [wet, wet_frame] = drawn(3);
  EXPECT_EQ(wet_frame.pass_count, dry_frame.pass_count);
  EXPECT_EQ(wet_frame.draws, dry_frame.draws);
  EXPECT_EQ(wet_frame.image_bytes, dry_frame.image_bytes);
  EXPECT_EQ(drawn(0).first, dry) << "to the bit";
  const float expected = shader::wet_reflectance(glm::vec3(0.1f)).x / 0.1f;
  std::size_t seen = 0;
  for (std::size_t i = 1; i < dry.size(); i += 4) {
    if (dry[i] < 0.05f) continue;
    ++seen;
    ASSERT_NEAR(wet[i] / dry[i], expected, 3e-3f) << "half floats, twice, and a film that mirrors next to nothing";
  }
  EXPECT_GT(seen, 1000u);

  ASSERT_TRUE(renderer->load_scene(ground(0.1f, Surface::kPlain)).ok());
  const auto upright = drawn(0).first;
  EXPECT_EQ(drawn(3).first, upright) << "water runs off what is no ground";
  input.effects = {};
  EXPECT_EQ(renderer->draw(input).effects[Effect::kWetGround].reason, "it does not rain");
}

}  // namespace
}  // namespace phare
