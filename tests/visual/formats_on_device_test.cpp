// reference: one beam in every format that is read, through the shader that draws the frame, against float64 of the
// format's own table: LM-63 A, B and C, EULUMDAT, TM-33, candela CSV, goniometer CSV, flat-screen CSV.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <set>

#include "tests/visual/formats.h"
#include "tests/visual/yard.h"
#include "visual/beam_packing.h"
#include "visual/photometry/beam/live_beam.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/renderer.h"

namespace phare {
namespace {

/// Points of a road, a wall and plates about a lamp at (3, 0.6, 0.65), turned a little.
const PlacedLamp& mounted() {
  static const PlacedLamp lamp{.position_m = {3.0, 0.6, 0.65}, .world_from_image = aim_rotation(0.003, -0.01, 0.02)};
  return lamp;
}
std::vector<MeasurePoint> scene_points() {
  std::vector<MeasurePoint> points;
  for (double x = 4.0; x < 120.0; x *= 1.07) {
    for (double y = -12.0; y <= 12.0; y += 0.77) points.push_back({{x, y, 0.0}, {0, 0, 1}});
  }
  for (double y = -20.0; y <= 20.0; y += 0.53) {
    for (double z = -2.0; z <= 4.0; z += 0.37) points.push_back({{28.0, y, z}, {-1, 0, 0}});
  }
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 d = direction_hv(-62.0 + 0.0621 * i, 18.0 * std::sin(0.7 * i));
    points.push_back({mounted().position_m + 7.0 * d, glm::normalize(glm::dvec3{0.3, 0.2, 0.9} * std::cos(i) - d)});
  }
  return points;
}

struct WorstOfFormat {
  double relative = 0.0;
  std::size_t judged = 0;
  glm::dvec3 at{};
};

/// Is a direction (of a lamp) on a limit of the table, to within float32? The limit belongs to the table, and the
/// device counts as within what misses it by up to a thousandth of a node (beam.glsl), here below 1e-3 of a degree.
bool on_limit(const IntensityTable& table, const glm::dvec3& direction, double margin_deg = 1e-3) {
  const TableAngles at = table.angles_of(direction);
  for (const auto& [nodes, deg] : {std::pair{&table.first_deg, at.first_deg}, {&table.second_deg, at.second_deg}}) {
    if (std::abs(deg - nodes->front()) < margin_deg || std::abs(deg - nodes->back()) < margin_deg) return true;
  }
  return false;
}

/// Relative where more than 0.01 lx is expected; points on a table's limit are left out.
WorstOfFormat compare_lx(const std::vector<AimedSource>& sources, const std::vector<MeasurePoint>& points,
                         const std::vector<float>& measured) {
  WorstOfFormat worst;
  for (std::size_t k = 0; k < points.size(); ++k) {
    double expected = 0.0;
    bool limit = false;
    for (const AimedSource& source : sources) {
      expected += illuminance_lx(mounted().position_m, source.car_from_lamp, *source.table, source.scale,
                                 points[k].position_m, points[k].normal);
      limit = limit || on_limit(*source.table, (points[k].position_m - mounted().position_m) * source.car_from_lamp);
    }
    if (limit || !(expected > 0.01)) continue;
    ++worst.judged;
    const double relative = std::abs(static_cast<double>(measured[k]) - expected) / expected;
    if (relative <= worst.relative) continue;
    worst.relative = relative;
    worst.at = points[k].position_m;
  }
  return worst;
}

// float32 on native nodes: a direction is known to 1e-7, and light changes by up to a factor 2.5 in the 0.1° of a
// cut-off, 5e-4 of it in 1e-7 rad·57.3… of a degree: some 1e-6. docs/accuracy.md allows 1e-5.
constexpr double kLimit = 1e-5;

TEST(FormatsOnDevice, EveryFormatIsItsTable) {
  Result<Renderer> renderer = Renderer::create({.width_px = 64, .height_px = 64, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  const std::vector<MeasurePoint> points = scene_points();
  for (const Format& format : formats()) {
    const auto table = parse_lamp(format.text, format.name, format.settings);
    ASSERT_TRUE(table.ok()) << table.error().text();
    const std::vector<AimedSource> source{{.table = &*table, .car_from_lamp = mounted().world_from_image}};
    const BeamImage image = compose_beam_image(source);
    EXPECT_EQ(pack_beam(image).lookup(), format.lookup) << format.name;
    EXPECT_FALSE(image.resampled) << format.name;
    renderer->set_beam(0, image);
    const auto lx = renderer->measure(std::span(&mounted(), 1), points);
    const WorstOfFormat worst = compare_lx(source, points, lx[0]);
    EXPECT_LT(worst.relative, kLimit) << format.name << " at " << worst.at.x << ", " << worst.at.y << ", "
                                      << worst.at.z;
    EXPECT_GT(worst.judged, 1500u) << format.name;
    std::printf("%-18s %5zu points above 0.01 lx: worst %.2e relative\n", format.name.c_str(), worst.judged,
                worst.relative);
  }
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// Beside nodes, nearer than rounding has moved them: there the cell that counting names may be the wrong one, whose
// function is another one there.
TEST(FormatsOnDevice, NodesThatAreRoundedPartTheirCellsWhereTheyLie) {
  Result<Renderer> renderer = Renderer::create({.width_px = 64, .height_px = 64, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  const std::vector<Format> all = formats();
  for (const char* name : {"a_rounded.ies", "b_rounded.ies", "a_ends.ies", "a_beside.ies", "a_thirds.ies"}) {
    const auto table = parse_lamp(format_named(all, name).text, name, {});
    ASSERT_TRUE(table.ok()) << table.error().text();
    const std::vector<AimedSource> source{{.table = &*table, .car_from_lamp = mounted().world_from_image}};
    std::vector<MeasurePoint> points;
    for (std::size_t i = 1; i + 1 < table->first_deg.size(); i += 3)
      for (std::size_t j = 1; j + 1 < table->second_deg.size(); j += 2)
        for (const double beside_deg : {-6e-5, -2e-5, 2e-5, 6e-5}) {
          const glm::dvec3 d = mounted().world_from_image * table_direction(table->type, table->axis,
                                                                            {table->first_deg[i] + beside_deg,
                                                                             table->second_deg[j] - 0.6 * beside_deg});
          points.push_back({mounted().position_m + 7.0 * d, -d});
        }
    renderer->set_beam(0, compose_beam_image(source));
    const auto lx = renderer->measure(std::span(&mounted(), 1), points);
    const WorstOfFormat worst = compare_lx(source, points, lx[0]);
    EXPECT_LT(worst.relative, kLimit) << name << " at " << worst.at.x << ", " << worst.at.y << ", " << worst.at.z;
    EXPECT_GT(worst.judged, 5000u) << name;
    std::printf("%-18s %5zu points beside nodes: worst %.2e relative\n", name, worst.judged, worst.relative);
  }
}

// The rim of a screen belongs to it: measured at the very places that its file has lux for, on a wall where the screen
// stood, the file's lux come back, corners and edges too.
TEST(FormatsOnDevice, AScreenGivesBackItsOwnLux) {
  Result<Renderer> renderer = Renderer::create({.width_px = 64, .height_px = 64, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  const std::vector<Format> all = formats();
  for (const char* name : {"screen_25m.csv", "screen_wide.csv", "screen_uneven.csv"}) {
    const auto table = parse_lamp(format_named(all, name).text, name, {});
    ASSERT_TRUE(table.ok()) << table.error().text();
    const AimedSource source{.table = &*table};
    renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
    std::vector<MeasurePoint> points;
    std::vector<double> expected;
    const double d = table->screen_distance_m;
    for (std::size_t j = 0; j < table->second_deg.size(); ++j) {
      for (std::size_t i = 0; i < table->first_deg.size(); ++i) {
        const double t = std::tan(table->first_deg[i] * M_PI / 180.0),
                     u = std::tan(table->second_deg[j] * M_PI / 180.0);
        points.push_back({{d, -d * t, d * u}, {-1, 0, 0}});
        expected.push_back(table->candela[j * table->first_deg.size() + i] / screen_factor(t, u) / (d * d));
      }
    }
    const PlacedLamp lamp{};
    const auto lx = renderer->measure(std::span(&lamp, 1), points);
    double worst = 0.0, worst_reference = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (expected[k] <= 0.01) continue;
      worst = std::max(worst, std::abs(static_cast<double>(lx[0][k]) - expected[k]) / expected[k]);
      const double reference =
          illuminance_lx({0, 0, 0}, glm::dmat3{1.0}, *table, 1.0, points[k].position_m, {-1, 0, 0});
      worst_reference = std::max(worst_reference, std::abs(reference - expected[k]) / expected[k]);
    }
    EXPECT_LT(worst, kLimit) << name;
    EXPECT_LT(worst_reference, 1e-12) << name;
  }
}

// Two screens at one lamp, at different distances and of different steps, dimmed apart: their union is exact too, and a
// part uploaded by itself is the whole.
TEST(FormatsOnDevice, ScreensAddUpOnTheirOwnNodes) {
  Result<Renderer> renderer = Renderer::create({.width_px = 64, .height_px = 64, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  const std::vector<Format> all = formats();
  const auto near = parse_lamp(format_named(all, "screen_wide.csv").text, "near.csv", {});
  const auto far = parse_lamp(screen(10, steps(-10, 10, 0.3), steps(-3, 3, 0.17)), "far.csv", {});
  ASSERT_TRUE(near.ok() && far.ok());
  std::vector<AimedSource> sources{{.table = &*near, .car_from_lamp = mounted().world_from_image},
                                   {.table = &*far, .car_from_lamp = mounted().world_from_image}};
  LiveBeam beam(sources);
  beam.set_dimming(0, 1.0);
  beam.set_dimming(1, 0.5);
  beam.update();
  EXPECT_FALSE(beam.image().resampled);
  renderer->set_beam(0, beam.image());
  const std::vector<MeasurePoint> points = scene_points();
  sources[1].scale = 0.5;
  const PlacedLamp lamp{.position_m = mounted().position_m, .world_from_image = beam.image().car_from_image};
  // Beside the limits of the smaller screen light falls to the other's over 0.01°, by design of the union.
  std::vector<MeasurePoint> apart;
  for (const MeasurePoint& point : points) {
    bool beside = false;
    for (const AimedSource& source : sources)
      beside =
          beside || on_limit(*source.table, (point.position_m - mounted().position_m) * source.car_from_lamp, 0.011);
    if (!beside) apart.push_back(point);
  }
  auto lx = renderer->measure(std::span(&lamp, 1), apart);
  EXPECT_LT(compare_lx(sources, apart, lx[0]).relative, kLimit);

  beam.set_dimming(1, 0.25);
  ASSERT_EQ(beam.update(), LiveBeam::Change::kPart);
  renderer->change_beam(0, beam.image(), beam.changed());
  sources[1].scale = 0.25;
  lx = renderer->measure(std::span(&lamp, 1), apart);
  EXPECT_LT(compare_lx(sources, apart, lx[0]).relative, kLimit);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// The cheaper levels hold for a screen what their twins on the CPU say of it.
TEST(FormatsOnDevice, LevelsOfAScreenAreAsGoodAsTheirTwins) {
  const std::vector<Format> all = formats();
  const auto table = parse_lamp(format_named(all, "screen_wide.csv").text, "wide.csv", {});
  ASSERT_TRUE(table.ok());
  const AimedSource source{.table = &*table};
  const BeamImage image = compose_beam_image(std::span(&source, 1));
  std::vector<MeasurePoint> points;
  std::vector<double> expected;
  for (double h = -60.0; h <= 60.0; h += 1.37) {
    for (double v = -20.0; v <= 15.0; v += 0.31) {
      const glm::dvec3 d = direction_hv(h, v);
      if (on_limit(*table, d)) continue;
      points.push_back({10.0 * d, -d});
      expected.push_back(table->intensity_cd(d));
    }
  }
  std::vector<double> worst_of_level;
  for (const ImageLevel level : kImageLevels) {
    Result<Renderer> renderer =
        Renderer::create({.width_px = 64, .height_px = 64, .validation = true, .beam_level = level});
    ASSERT_TRUE(renderer.ok()) << renderer.error().text();
    renderer->set_beam(0, image);
    const PlacedLamp lamp{};
    const auto lx = renderer->measure(std::span(&lamp, 1), points);
    double worst = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
      worst = std::max(worst, std::abs(100.0 * static_cast<double>(lx[0][k]) - expected[k]));
    const LevelError twin = level_error(*table, LevelImage(*table, level));
    // float32 directions, as in beam_on_device_test.cpp.
    EXPECT_LT(worst, twin.worst_cd + 1e-5 * table->peak_cd()) << level_name(level);
    worst_of_level.push_back(worst);
    std::printf("%s of a screen: worst %.3g cd on the device, %.3g cd by its twin\n", level_name(level).c_str(), worst,
                twin.worst_cd);
    EXPECT_EQ(renderer->validation_messages(), 0u);
  }
  // Native nodes are another class than what a texture filter weighs, float32 another than half floats (2^-11).
  EXPECT_LT(worst_of_level[2], 0.1 * worst_of_level[1]);
  EXPECT_LT(worst_of_level[3], 0.1 * worst_of_level[2]);
}

}  // namespace
}  // namespace phare
