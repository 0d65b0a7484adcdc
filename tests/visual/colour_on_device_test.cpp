// Sources of several colours in one place, on the device: the picture's chromaticity against float64 mixing in XYZ.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "visual/photometry/beam/live_beam.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

constexpr int kWidth = 401, kHeight = 41;
constexpr double kHalfWidth_deg = 20.0;

enum class Nodes { kEven, kUneven, kRounded };

std::string text_of(Nodes nodes) {
  return nodes == Nodes::kEven ? "Even" : nodes == Nodes::kUneven ? "Uneven" : "Rounded";
}

// A lobe of 1000 cd and more between two H, zero outside.
IntensityTable lobe(double from_deg, double to_deg, Nodes nodes) {
  IntensityTable table;
  const auto node = [&](int i) {
    if (nodes == Nodes::kRounded) return std::round(100.0 * i / 2.1) / 100.0;
    return 0.5 * i + (nodes == Nodes::kUneven ? 0.1 * std::sin(i) : 0.0);
  };
  for (int i = -43; i <= 43; ++i) table.first_deg.push_back(node(i));
  for (int j = -20; j <= 20; ++j) table.second_deg.push_back(node(j));
  for (double v : table.second_deg)
    for (double h : table.first_deg) {
      const double part = (h - from_deg) / (to_deg - from_deg);
      table.candela.push_back(
          part > 0.0 && part < 1.0 ? 8000.0 * std::sin(std::numbers::pi * part) * (2.0 + std::cos(v)) : 0.0);
    }
  return table;
}

// The chromaticity of the Planckian locus by the formula of Kim et al. that the lamps' colours come from, in float64.
glm::dvec2 planckian(double t) {
  const double x = t <= 4000.0 ? -0.2661239e9 / (t * t * t) - 0.2343589e6 / (t * t) + 0.8776956e3 / t + 0.179910
                               : -3.0258469e9 / (t * t * t) + 2.1070379e6 / (t * t) + 0.2226347e3 / t + 0.240390;
  const double y = t <= 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                               : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  return {x, y};
}
glm::dvec3 xyz_of(glm::dvec2 xy, double luminance) {
  return luminance * glm::dvec3(xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y);
}
glm::dvec2 xy_of(glm::dvec3 xyz) {
  return glm::dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}
// IEC 61966-2-1, four digits.
glm::dvec3 xyz_of_rgb(glm::dvec3 c) {
  return {0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
          0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z};
}

// A wall of reflectance 1 at 25 m.
Scene white_wall() {
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

struct Judged {
  double worst = 0.0;
  int first_alone = 0, second_alone = 0, both = 0;
};

// Every pixel of the middle row against what the two tables give there.
Judged judge(Renderer& renderer, const IntensityTable& a, double a_scale, glm::dvec2 a_xy, const IntensityTable& b,
             double b_scale, glm::dvec2 b_xy) {
  FrameInput input;
  input.camera.fov_horizontal_rad = 2.0 * kHalfWidth_deg * std::numbers::pi / 180.0;
  input.lamps = {PlacedLamp{}};
  input.sky_luminance_cdm2 = 0.0;
  input.want_hdr = true;
  renderer.draw(input);
  const ImageF picture = renderer.read_hdr();
  Judged judged;
  for (int x = 0; x < kWidth; ++x) {
    const double right = (2.0 * (x + 0.5) / kWidth - 1.0) * std::tan(kHalfWidth_deg * std::numbers::pi / 180.0);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, -right, 0.0));
    const double a_cd = a_scale * a.intensity_cd(direction), b_cd = b_scale * b.intensity_cd(direction);
    if (a_cd + b_cd < 500.0) continue;  // too dark for half floats
    const std::size_t at = (static_cast<std::size_t>(kHeight / 2) * kWidth + static_cast<std::size_t>(x)) * 4;
    const glm::dvec3 rgb(picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]);
    const glm::dvec2 seen = xy_of(xyz_of_rgb(rgb)), expected = xy_of(xyz_of(a_xy, a_cd) + xyz_of(b_xy, b_cd));
    judged.worst = std::max(judged.worst, glm::length(seen - expected));
    (b_cd == 0.0 ? judged.first_alone : a_cd == 0.0 ? judged.second_alone : judged.both) += 1;
  }
  return judged;
}

// Half floats of the picture are off by 2^-11 in each of three channels, which moves x and y by less than 4e-4;
// matrices of four digits that are not quite each other's inverse by 1e-4.
constexpr double kChromaticityLimit = 5e-4;

class ColourOnDevice : public testing::TestWithParam<std::tuple<ImageLevel, Nodes>> {};

TEST_P(ColourOnDevice, EachSourceKeepsItsColourAndTheOverlapMixes) {
  const auto [level, nodes] = GetParam();
  Result<Renderer> renderer =
      Renderer::create({.width_px = kWidth, .height_px = kHeight, .validation = true, .beam_level = level});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(white_wall()).ok());
  const IntensityTable low = lobe(-15.0, 4.0, nodes), high = lobe(-4.0, 15.0, nodes);
  const glm::dvec2 cool = planckian(5500.0), warm = planckian(3200.0);
  LiveBeam beam({{.table = &low, .colour_temperature_k = 5500.0}, {.table = &high, .colour_temperature_k = 3200.0}});
  beam.set_dimming(0, 1.0);
  beam.update();
  renderer->set_beam(0, beam.image());
  EXPECT_TRUE(beam.image().tints.empty()) << "one colour needs no table";
  const Judged alone = judge(*renderer, low, 1.0, cool, high, 0.0, warm);
  EXPECT_LT(alone.worst, kChromaticityLimit);
  EXPECT_GT(alone.first_alone, 100);

  beam.set_dimming(1, 1.0);
  ASSERT_EQ(beam.update(), LiveBeam::Change::kWhole);
  renderer->set_beam(0, beam.image());
  const Judged mixed = judge(*renderer, low, 1.0, cool, high, 1.0, warm);
  std::printf("%s, %s: chromaticity within %.1e of float64\n", level_name(level).c_str(), text_of(nodes).c_str(),
              mixed.worst);
  EXPECT_LT(mixed.worst, kChromaticityLimit);
  EXPECT_GT(mixed.first_alone, 50);
  EXPECT_GT(mixed.second_alone, 50);
  EXPECT_GT(mixed.both, 50);
  EXPECT_GT(glm::length(cool - warm), 0.08) << "one colour for both would be off by half of this";

  // Dimmed: only rectangles go to the device.
  for (const double dimming : {0.3, 0.7}) {
    beam.set_dimming(1, dimming);
    ASSERT_EQ(beam.update(), LiveBeam::Change::kPart);
    renderer->change_beam(0, beam.image(), beam.changed());
    const Judged dimmed = judge(*renderer, low, 1.0, cool, high, dimming, warm);
    EXPECT_LT(dimmed.worst, kChromaticityLimit) << dimming;
    EXPECT_GT(dimmed.both, 50);
  }
  // And back to one colour.
  beam.set_dimming(0, 0.0);
  ASSERT_EQ(beam.update(), LiveBeam::Change::kWhole);
  renderer->set_beam(0, beam.image());
  EXPECT_LT(judge(*renderer, low, 0.0, cool, high, 0.7, warm).worst, kChromaticityLimit);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Levels, ColourOnDevice,
                         testing::Combine(testing::Values(ImageLevel::kHalfEven, ImageLevel::kHalfNodes,
                                                          ImageLevel::kFloatNodes),
                                          testing::Values(Nodes::kEven, Nodes::kUneven, Nodes::kRounded)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) == ImageLevel::kHalfEven    ? "HalfEven"
                                              : std::get<0>(info.param) == ImageLevel::kHalfNodes ? "HalfNodes"
                                                                                                  : "FloatNodes") +
                                  text_of(std::get<1>(info.param));
                         });

// Colour is beside the lux and not in them: to the bit.
TEST(ColourOnDevice, LuxAreTheSameWhateverTheColours) {
  Result<Renderer> renderer = Renderer::create({.width_px = kWidth, .height_px = kHeight, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(white_wall()).ok());
  const IntensityTable low = lobe(-15.0, 4.0, Nodes::kEven), high = lobe(-4.0, 15.0, Nodes::kEven);
  std::vector<std::vector<float>> lux;
  std::vector<std::vector<float>> drawn;
  for (const double kelvin : {5500.0, 3200.0}) {
    const std::vector<AimedSource> sources{{.table = &low, .colour_temperature_k = 5500.0},
                                           {.table = &high, .colour_temperature_k = kelvin}};
    renderer->set_beam(0, compose_beam_image(sources));
    std::vector<MeasurePoint> points;
    for (int i = 0; i < 2000; ++i) points.push_back({{25.0, 0.01 * i - 10.0, 0.003 * i - 3.0}, {-1, 0, 0}});
    const PlacedLamp lamp{};
    lux.push_back(renderer->measure(std::span(&lamp, 1), points)[0]);
    FrameInput input;
    input.lamps = {lamp};
    input.want_hdr = true;
    renderer->draw(input);
    std::vector<float>& alpha = drawn.emplace_back();
    const ImageF picture = renderer->read_hdr();
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) alpha.push_back(picture.rgba[i]);
  }
  EXPECT_EQ(lux[0], lux[1]);
  EXPECT_EQ(drawn[0], drawn[1]);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
