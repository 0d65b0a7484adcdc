// reference: one beam in every format that is read, through the shader that draws the frame, against float64 of the
// format's own table: LM-63 A, B and C, EULUMDAT, TM-33, candela CSV, goniometer CSV, flat-screen CSV.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <set>

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

const IntensityTable& low_beam() {
  static const std::vector<SampleLamp> lamps = sample_lamps();
  return std::find_if(lamps.begin(), lamps.end(), [](const SampleLamp& lamp) { return lamp.file == "low_rht.ies"; })
      ->table;
}

std::vector<double> steps(double from, double to, double step) {
  std::vector<double> nodes;
  for (int i = 0; from + step * i <= to + 1e-9; ++i) nodes.push_back(std::round((from + step * i) * 1e9) * 1e-9);
  return nodes;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

/// A matrix CSV of our low beam; value(second, first).
std::string matrix(const std::string& head, const std::vector<double>& first, const std::vector<double>& second,
                   const std::function<double(double, double)>& value) {
  std::string text = head;
  for (const double f : first) text += "," + number(f);
  text += '\n';
  for (const double s : second) {
    text += number(s);
    for (const double f : first) text += "," + number(value(s, f));
    text += '\n';
  }
  return text;
}

/// Lux on a screen at x = `d`, y left and z up, lit by our low beam.
std::string screen(double d, const std::vector<double>& y, const std::vector<double>& z) {
  return matrix("# unit: lx\n# distance_m: " + number(d) + "\nz\\y", y, z, [d](double up, double left) {
    const double r2 = d * d + left * left + up * up;
    return low_beam().intensity_cd({d, left, up}) * d / (r2 * std::sqrt(r2));
  });
}

std::string tm33_text(const IntensityTable& table) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<IESTM33-22><Version>1.1</Version>\n<Emitter><LuminousData>"
      "<PhotometryType>CIE-A</PhotometryType><SymmType>Symm _ None</SymmType>\n";
  for (std::size_t i = 0; i < table.first_deg.size(); ++i) {
    for (std::size_t j = 0; j < table.second_deg.size(); ++j)
      text += "<IntensityData horz=\"" + number(table.first_deg[i]) + "\" vert=\"" + number(table.second_deg[j]) +
              "\">" + number(table.candela[j * table.first_deg.size() + i]) + "</IntensityData>\n";
  }
  return text + "</LuminousData></Emitter></IESTM33-22>\n";
}

struct Format {
  std::string name;  ///< of the file
  std::string text;
  std::uint32_t lookup = 0;  ///< how the device is to find its nodes
  LampReadSettings settings{};
};

std::vector<Format> formats() {
  const IntensityTable& low = low_beam();
  const auto on = [&](PhotometricType type, GammaAxis axis, std::vector<double> first, std::vector<double> second) {
    return resample(low, type, axis, std::move(first), std::move(second));
  };
  const auto b_h = steps(-40, 40, 0.5), b_v = steps(-14, 10, 0.25);
  const IntensityTable b = on(PhotometricType::kB, GammaAxis::kGamma0, b_h, b_v);
  const IntensityTable c0 = on(PhotometricType::kC, GammaAxis::kGamma0, steps(0, 360, 2.5), steps(0, 60, 0.25));
  const IntensityTable c90 = on(PhotometricType::kC, GammaAxis::kGamma90, steps(0, 360, 0.5), steps(60, 120, 0.25));
  // Multiples of nothing: bent a little, so that every node is where counting says or next to it; and freely.
  std::vector<double> bent_h, bent_v, uneven_h, uneven_v;
  for (int i = -60; i <= 60; ++i) bent_h.push_back(0.7 * i + 0.0723456789 * std::sin(i));
  for (int j = -40; j <= 30; ++j) bent_v.push_back(0.3 * j + 0.0223456789 * std::cos(j));
  for (int i = -60; i <= 60; ++i) uneven_h.push_back(0.7 * i + 0.3123456789 * std::sin(i));
  for (int j = -40; j <= 30; ++j) uneven_v.push_back(0.3 * j + 0.1323456789 * std::cos(j));
  const IntensityTable bent = on(PhotometricType::kA, GammaAxis::kGamma0, bent_h, bent_v);
  const IntensityTable uneven = on(PhotometricType::kA, GammaAxis::kGamma0, uneven_h, uneven_v);
  // Evenly about 0°, which is no node; and 256 × 128 nodes as a program writes them, rounded to 1e-4°: also with ends
  // that are rounded, with one that is not as the others say, which takes a second fetch, and coarsely, by up to a 67th
  // of the way between two nodes; and so finely that they are even.
  const IntensityTable half =
      on(PhotometricType::kA, GammaAxis::kGamma0, steps(-39.75, 39.75, 0.5), steps(-13.9, 9.9, 0.2));
  const auto written = [](double from, double to, int count, double per_unit = 1e4) {
    std::vector<double> nodes;
    for (int i = 0; i < count; ++i)
      nodes.push_back(std::round((from + (to - from) * i / (count - 1)) * per_unit) / per_unit);
    return nodes;
  };
  const IntensityTable rounded =
      on(PhotometricType::kA, GammaAxis::kGamma0, written(-45, 45, 256), written(-20, 10, 128));
  const IntensityTable b_rounded =
      on(PhotometricType::kB, GammaAxis::kGamma0, written(-45, 45, 256), written(-20, 10, 128));
  const auto off_h = written(-44.98765, 44.51117, 251), off_v = written(-19.43219, 9.87654, 119);
  const IntensityTable ends = on(PhotometricType::kA, GammaAxis::kGamma0, off_h, off_v);
  auto one_beside = off_v;
  one_beside[60] += 1e-4;
  const IntensityTable beside = on(PhotometricType::kA, GammaAxis::kGamma0, off_h, one_beside);
  const IntensityTable finely =
      on(PhotometricType::kA, GammaAxis::kGamma0, written(-45, 45, 256, 1e7), written(-20, 10, 128, 1e7));
  const IntensityTable thirds =
      on(PhotometricType::kA, GammaAxis::kGamma0, written(-40, 40, 241, 100), written(-40.0 / 3, 10, 71, 1000));
  LampReadSettings gamma90;
  gamma90.axis = GammaAxis::kGamma90;
  // Wide, near screens show the projection's factor: at their corners 1/cos³ is 12 and 3.4.
  std::vector<double> far_out;  // multiples of nothing
  for (int i = -40; i <= 40; ++i) far_out.push_back(10.0 * std::sinh(0.05 * i) / std::sinh(2.0));
  using namespace shader;
  return {{"a.ies", lm63_text(low), kLookupAhead},
          {"a_half.ies", lm63_text(half), kLookupAhead},
          {"a_rounded.ies", lm63_text(rounded), kLookupDecimals},
          {"b_rounded.ies", lm63_text(b_rounded), kLookupDecimals},
          {"a_finely.ies", lm63_text(finely), kLookupAhead},
          {"a_ends.ies", lm63_text(ends), kLookupDecimals},
          {"a_beside.ies", lm63_text(beside), kLookupRounded},
          {"a_thirds.ies", lm63_text(thirds), kLookupDecimals},
          {"a_bent.ies", lm63_text(bent), kLookupRounded},
          {"a_uneven.ies", lm63_text(uneven), kLookupGuide},
          {"b.ies", lm63_text(b), kLookupAhead},
          {"c_gamma0.ies", lm63_text(c0), kLookupTurn},
          {"c_gamma90.ies", lm63_text(c90), kLookupTurn, gamma90},
          {"gamma0.ldt", eulumdat_text(c0), kLookupTurn},
          {"gamma90.ldt", eulumdat_text(c90, GammaAxis::kGamma90), kLookupTurn, gamma90},
          {"a.xml", tm33_text(on(PhotometricType::kA, GammaAxis::kGamma0, b_h, b_v)), kLookupAhead},
          {"candela.csv", csv_text(b), kLookupAhead},
          {"candela_c.csv", csv_text(c0), kLookupTurn},
          {"goniometer.csv",
           matrix("# unit: lx\n# distance_m: 25\n# angles: type B\nV\\H", b_h, b_v,
                  [&](double v, double h) {
                    return low.intensity_cd(table_direction(PhotometricType::kB, GammaAxis::kGamma0, {h, v})) / 625.0;
                  }),
           kLookupAhead},
          {"screen_25m.csv", screen(25, steps(-30, 30, 0.25), steps(-7.5, 7.5, 0.1)), kLookupScreen},
          {"screen_wide.csv", screen(5, steps(-10, 10, 0.1), steps(-4, 2, 0.05)), kLookupScreen},
          {"screen_uneven.csv", screen(5, far_out, steps(-4, 2, 1.0 / 29.0)), kLookupScreenGuide}};
}

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

const Format& format_named(const std::vector<Format>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const Format& format) { return format.name == name; });
}

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

/// The lux of every pixel of the yard by one lamp with beam 0. Half floats.
struct YardPicture {
  std::vector<float> lx;
  std::uint64_t pipelines_made = 0;
};
YardPicture yard_lit(Renderer& renderer, ShapesFrom shapes) {
  FrameInput input = driver_view();
  input.lamps.resize(1);
  input.shapes = shapes;
  input.want_hdr = true;
  YardPicture picture;
  picture.pipelines_made = renderer.draw(input).pipelines_made;
  const ImageF image = renderer.read_hdr();
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) picture.lx.push_back(image.rgba[i]);
  return picture;
}

// What is found is found in the same way, but for a longer polynomial and a compare with the table's edge: as near as
// float32 has it. In half floats a pixel in a hundred may fall on the other side of a step of 2^-10.
TEST(FormatsOnDevice, ShapesFromTheFrameLightAsThoseOfThePipeline) {
  Result<Renderer> renderer = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  std::set<std::uint32_t> lookups;
  for (const Format& format : formats()) {
    const auto table = parse_lamp(format.text, format.name, format.settings);
    ASSERT_TRUE(table.ok()) << table.error().text();
    const BeamImage image = image_of(*table);
    renderer->set_beam(0, image);
    const YardPicture own = yard_lit(*renderer, ShapesFrom::kPipeline), any = yard_lit(*renderer, ShapesFrom::kFrame);
    std::size_t lit = 0, steps = 0;
    for (std::size_t i = 0; i < own.lx.size(); ++i) {
      lit += own.lx[i] > 0.01f ? 1 : 0;
      if (own.lx[i] == any.lx[i]) continue;
      ++steps;
      ASSERT_NEAR(own.lx[i], any.lx[i], own.lx[i] / 1024.0f + 1e-6f) << format.name << ", pixel " << i;
    }
    EXPECT_GT(lit, own.lx.size() / 8) << format.name;
    EXPECT_LT(steps, own.lx.size() / 100) << format.name;
    // One pipeline serves all tables that are looked up alike.
    const bool first = lookups.insert(for_any_light(pack_beam(image).shape).lookup).second;
    EXPECT_EQ(any.pipelines_made > 0, first) << format.name;
  }
  // Even with a coarse step; even, and rounded to decimals, fine ones and others; rounded otherwise; a whole turn; any
  // nodes; a screen's, even and any.
  EXPECT_EQ(lookups.size(), 8u) << "of " << formats().size() << " formats";
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// Two lamps: of one table, whose shape the first has for both, and of two, where each has its own. What a display
// shows, by shorter polynomials here and longer ones there, is the same to a step of 255; in fog too, whose grid is
// read in half floats: a thousandth, and a step is eight of them.
// Where a table ends in the midst of its light, a pixel on that limit may fall on either side of it.
TEST(FormatsOnDevice, TwoLampsLightFromTheFrameAsFromThePipeline) {
  Result<Renderer> renderer = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  const std::vector<Format> all = formats();
  const auto shown = [&](ShapesFrom shapes, bool foggy) {
    FrameInput input = driver_view();
    input.lamps[0].beam = 0, input.lamps[1].beam = 1;
    input.shapes = shapes;
    if (foggy) input.air.visibility_m = 60.0;
    input.want_image = true;
    renderer->draw(input);
    return renderer->read_image();
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::array<std::size_t, 2> of_lamp{i, i % 2 == 0 ? i : (i + 5) % all.size()};
    for (std::size_t lamp = 0; lamp < 2; ++lamp) {
      const Format& format = all[of_lamp[lamp]];
      const auto table = parse_lamp(format.text, format.name, format.settings);
      ASSERT_TRUE(table.ok()) << table.error().text();
      renderer->set_beam(lamp, image_of(*table));
    }
    for (const bool foggy : {false, true}) {
      const Image8 own = shown(ShapesFrom::kPipeline, foggy), any = shown(ShapesFrom::kFrame, foggy);
      std::size_t bright = 0, steps = 0, ends = 0;
      for (std::size_t k = 0; k < own.rgba.size(); ++k) {
        bright += own.rgba[k] > 40 && k % 4 != 3 ? 1 : 0;
        steps += own.rgba[k] != any.rgba[k] ? 1 : 0;
        ends += std::abs(own.rgba[k] - any.rgba[k]) > 1 ? 1 : 0;
      }
      EXPECT_GT(bright, own.rgba.size() / 10) << all[i].name;
      EXPECT_LT(steps, own.rgba.size() / 50) << all[i].name;
      EXPECT_LE(ends, 9u) << all[i].name << (foggy ? ", in fog" : "") << ": three pixels on a table's limit";
    }
  }
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// In a drive: what is made for the light is taken, else what is made for any; only where neither is, is it made.
TEST(FormatsOnDevice, ALightThatNoPipelineWasMadeForTakesOneForAny) {
  Result<Renderer> renderer = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  const std::vector<Format> all = formats();
  const auto shine = [&](const char* name) {
    const auto table = parse_lamp(format_named(all, name).text, name, {});
    ASSERT_TRUE(table.ok()) << table.error().text();
    renderer->set_beam(0, image_of(*table));
  };
  shine("a.ies");
  const YardPicture own = yard_lit(*renderer, ShapesFrom::kEither);
  EXPECT_GT(own.pipelines_made, 0u) << "nothing was made";
  EXPECT_EQ(yard_lit(*renderer, ShapesFrom::kPipeline).pipelines_made, 0u) << "those of the light were";
  EXPECT_GT(yard_lit(*renderer, ShapesFrom::kFrame).pipelines_made, 0u);
  const YardPicture still_own = yard_lit(*renderer, ShapesFrom::kEither);
  EXPECT_EQ(still_own.pipelines_made, 0u);
  EXPECT_EQ(still_own.lx, own.lx);

  shine("a_rounded.ies");
  (void)yard_lit(*renderer, ShapesFrom::kFrame);
  shine("a_half.ies");
  const YardPicture other = yard_lit(*renderer, ShapesFrom::kEither);
  EXPECT_EQ(other.pipelines_made, 0u);
  EXPECT_EQ(other.lx, yard_lit(*renderer, ShapesFrom::kFrame).lx);
  EXPECT_GT(yard_lit(*renderer, ShapesFrom::kPipeline).pipelines_made, 0u);
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
