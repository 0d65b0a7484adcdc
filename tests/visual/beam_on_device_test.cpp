// Beam images on the device: the ladder of levels against float64, parts uploaded against the whole, and the cut-off
// read from a rendered wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "visual/photometry/beam/live_beam.h"
#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

const IntensityTable& sample(const std::string& file) {
  static const std::vector<SampleLamp> lamps = sample_lamps();
  return std::find_if(lamps.begin(), lamps.end(), [&](const SampleLamp& lamp) { return lamp.file == file; })->table;
}

std::vector<MeasurePoint> points_on_sphere(std::size_t count, double h_limit_deg, double v_limit_deg) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> h(-h_limit_deg, h_limit_deg), v(-v_limit_deg, v_limit_deg);
  std::vector<MeasurePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 direction = direction_hv(h(random), v(random));
    points.push_back({10.0 * direction, -direction});  // E = I/100
  }
  return points;
}

// What each level is off by, in cd, where a lamp of 27,000 cd and more shines. The twin on the CPU looks at all of the
// table.
TEST(BeamOnDevice, EveryLevelIsAsGoodAsItsTwinOnTheCpu) {
  const IntensityTable& table = sample("low_rht.ies");
  const AimedSource source{.table = &table};
  const BeamImage image = compose_beam_image(std::span(&source, 1));
  const std::vector<MeasurePoint> points = points_on_sphere(20000, 15.0, 5.0);
  const PlacedLamp lamp{};
  double finer_cd = 1e9;
  for (const ImageLevel level : kImageLevels) {
    Result<Renderer> renderer =
        Renderer::create({.width_px = 64, .height_px = 64, .validation = true, .beam_level = level});
    ASSERT_TRUE(renderer.ok()) << renderer.error().text();
    renderer->set_beam(0, image);
    const auto lx = renderer->measure(std::span(&lamp, 1), points);
    double worst_cd = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      worst_cd = std::max(worst_cd,
                          std::abs(100.0 * static_cast<double>(lx[0][i]) - table.intensity_cd(points[i].position_m)));
    const LevelError twin = level_error(table, LevelImage(table, level));
    // float32 directions are off by up to 1e-5°; across the cut-off the table changes by about its peak a degree.
    const double angles_cd = 1e-5 * table.peak_cd();
    EXPECT_LT(worst_cd, twin.worst_cd + angles_cd) << level_name(level);
    // Random points rarely meet the worst one, but come near: the level really is what it is called.
    EXPECT_GT(worst_cd, 0.1 * twin.worst_cd - angles_cd) << level_name(level);
    EXPECT_LT(worst_cd, finer_cd) << level_name(level) << " should be finer than the one before";
    finer_cd = worst_cd;
    std::printf("%s: worst %.3g cd on the device, %.3g cd on the CPU over the whole table, %zu bytes\n",
                level_name(level).c_str(), worst_cd, twin.worst_cd,
                static_cast<std::size_t>(renderer->device_memory_bytes()));
    EXPECT_EQ(renderer->validation_messages(), 0u);
  }
}

// Whatever way a table is packed: a part that changed and was uploaded alone leaves the very image that a fresh upload
// makes.
TEST(BeamOnDevice, PartsUploadedEqualTheWhole) {
  std::vector<IntensityTable> tables;
  for (const bool uneven : {false, true}) {
    for (const PhotometricType type : {PhotometricType::kA, PhotometricType::kB, PhotometricType::kC}) {
      for (const double at : {0.0, 1.0}) {  // two sources on one grid, each bright elsewhere
        IntensityTable table;
        table.type = type;
        const bool c = type == PhotometricType::kC;
        for (int i = 0; i <= 24; ++i)
          table.first_deg.push_back(c ? 15.0 * i : 2.0 * i - 24.0 + (uneven ? 0.3 * std::sin(i) : 0.0));
        for (int j = 0; j <= 20; ++j) table.second_deg.push_back(c ? j + (uneven ? 0.123456789 * j : 0.0) : j - 10.0);
        for (int j = 0; j <= 20; ++j)
          for (int i = 0; i <= 24; ++i) {
            const bool lit = at == 0.0 ? i < 12 && j < 12 : i > 5 && j > 9 && i < 20;
            table.candela.push_back(lit ? 1000.0 * (1.0 + std::sin(i + 3.0 * j)) + 10.0 : 0.0);
          }
        tables.push_back(std::move(table));
      }
    }
  }
  const std::vector<MeasurePoint> points = points_on_sphere(5000, 28.0, 14.0);
  const PlacedLamp lamp{};
  for (const ImageLevel level : {ImageLevel::kHalfEven, ImageLevel::kHalfNodes, ImageLevel::kFloatNodes}) {
    Result<Renderer> renderer =
        Renderer::create({.width_px = 64, .height_px = 64, .validation = true, .beam_level = level});
    ASSERT_TRUE(renderer.ok()) << renderer.error().text();
    for (std::size_t pair = 0; pair < tables.size(); pair += 2) {
      LiveBeam beam({{.table = &tables[pair]}, {.table = &tables[pair + 1]}});
      beam.set_dimming(0, 1.0);
      beam.set_dimming(1, 1.0);
      beam.update();
      renderer->set_beam(0, beam.image());
      const auto before = renderer->measure(std::span(&lamp, 1), points);
      const std::uint64_t whole = renderer->uploaded_texels();
      for (const double dimming : {0.5, 0.0, 0.7}) {
        beam.set_dimming(1, dimming);
        ASSERT_EQ(beam.update(), LiveBeam::Change::kPart);
        renderer->change_beam(0, beam.image(), beam.changed());
      }
      const auto in_parts = renderer->measure(std::span(&lamp, 1), points);
      const std::uint64_t parts = renderer->uploaded_texels() - whole;
      renderer->set_beam(0, beam.image());
      const auto fresh = renderer->measure(std::span(&lamp, 1), points);
      EXPECT_EQ(in_parts, fresh) << level_name(level) << ", pair " << pair;
      EXPECT_NE(in_parts, before);
      const std::uint64_t again = renderer->uploaded_texels() - whole - parts;
      EXPECT_LT(parts, 3 * again) << "three parts, each less than the whole";
    }
    EXPECT_EQ(renderer->validation_messages(), 0u);
  }
}

// A wall of reflectance 1 at 25 m, seen through a narrow upright picture centred on the scan at 2.5° left.
Scene wall_25_m() {
  Scene scene;
  scene.materials = {{.name = "wall", .reflectance = glm::vec3(1.0f)}};
  SceneChunk chunk{.node = "wall", .material = 0, .origin_m = {}, .low_m = {25, -20, -10}, .high_m = {25, 20, 10}};
  for (const glm::vec3& p :
       {glm::vec3(25, 20, -10), glm::vec3(25, -20, -10), glm::vec3(25, -20, 10), glm::vec3(25, 20, 10)})
    scene.vertices.push_back({p, {-1, 0, 0}});
  scene.indices = {0, 1, 2, 0, 2, 3};
  chunk.index_count = 6;
  chunk.vertex_count = 4;
  scene.chunks.push_back(chunk);
  return scene;
}

TEST(BeamOnDevice, SharpnessReadFromARenderedWallIsThatOfTheTable) {
  constexpr int kWidth = 97, kHeight = 1201;  // odd: the middle column lies on the scan
  constexpr double kScan_deg = -2.5, kHalfHeight_deg = 5.0;
  Result<Renderer> renderer = Renderer::create({.width_px = kWidth, .height_px = kHeight, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(wall_25_m()).ok());
  for (const char* file : {"low_rht.ies", "led_low_rht.ies", "fog.ies"}) {
    const IntensityTable& table = sample(file);
    const glm::dmat3 aim = aim_rotation(0.0, sample_pitch_rad(), 0.0);
    const AimedSource source{.table = &table};
    renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
    FrameInput input;
    const double tan_v = std::tan(kHalfHeight_deg * std::numbers::pi / 180.0);
    input.camera.world_from_eye = aim_rotation(-kScan_deg * std::numbers::pi / 180.0, 0.0, 0.0);
    input.camera.fov_horizontal_rad = 2.0 * std::atan(tan_v * kWidth / kHeight);
    input.lamps = {{.position_m = {0, 0, 0}, .world_from_image = aim}};
    input.want_hdr = true;
    renderer->draw(input);
    const ImageF picture = renderer->read_hdr();
    // Candela toward (scan, v) from the lux of the two pixels about it: E = I·cos/r², r = 25 m/cos.
    const IntensityHv seen = [&](double h_deg, double v_deg) {
      const double row = (1.0 - std::tan(v_deg * std::numbers::pi / 180.0) / tan_v) * kHeight / 2.0 - 0.5;
      const auto above = static_cast<std::size_t>(std::clamp(std::floor(row), 0.0, kHeight - 2.0));
      const double part = row - static_cast<double>(above);
      const auto lx = [&](std::size_t y) {
        return static_cast<double>(picture.rgba[(y * kWidth + kWidth / 2) * 4 + 3]);
      };
      const double cosine = direction_hv(h_deg, v_deg).x;
      return ((1.0 - part) * lx(above) + part * lx(above + 1)) * 625.0 / (cosine * cosine * cosine);
    };
    const Cutoff read = find_cutoff(seen, kScan_deg), truth = find_cutoff(mounted_intensity(table, aim), kScan_deg);
    ASSERT_TRUE(read.found && truth.found) << file;
    // Half floats of lux are off by 2^-11, two of them in a difference of logarithms by 4e-4.
    EXPECT_NEAR(read.sharpness_g, truth.sharpness_g, 0.01) << file;
    EXPECT_NEAR(read.elevation_deg, truth.elevation_deg, 0.02) << file;
    std::printf("%s: G %.4f from the rendered wall, %.4f from the table; cut-off at %.3f and %.3f degrees\n", file,
                read.sharpness_g, truth.sharpness_g, read.elevation_deg, truth.elevation_deg);
  }
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
