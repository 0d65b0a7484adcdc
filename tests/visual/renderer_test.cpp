// The GPU path that draws the frame against float64, with Vulkan validation and synchronization validation on.
#include "visual/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/csv_table.h"
#include "tests/paths.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/frame.h"
#include "visual/image/image.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/picture_memory.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

// Below 0.01 lx only the absolute error says anything.
constexpr double kJudgedAbove_lx = 0.01;
// At points that are given: float32 directions and weights, where the table is steepest.
constexpr double kRelativeLimit = 1e-5;
// At pixels the point itself is rounded: to about 1e-5 of the distance, across a cut-off.
constexpr double kPixelLimit = 2e-3;

class RendererTest : public SharedRenderer {};

struct Worst {
  double relative = 0.0;
  double absolute_lx = 0.0;
  std::size_t judged = 0;

  void add(double got_lx, double expected_lx) {
    absolute_lx = std::max(absolute_lx, std::abs(got_lx - expected_lx));
    if (expected_lx <= kJudgedAbove_lx) return;
    ++judged;
    relative = std::max(relative, std::abs(got_lx / expected_lx - 1.0));
  }
};

TEST(PictureMemory, APictureThatTheDeviceCannotHoldIsRefusedBeforeItIsTried) {
  constexpr std::uint64_t kGb = 1'000'000'000;
  EXPECT_EQ(too_large(1280, 720, 4, kGb / 4), std::nullopt);  // 55 MB
  EXPECT_EQ(too_large(8192, 8192, 4, 16 * kGb).value_or("it fits"),
            "it fits");  // 4.03 GB
  EXPECT_EQ(too_large(8192, 8192, 4, 8 * kGb).value_or("it fits"),
            "a picture of 8192 × 8192 with 4 samples a pixel takes 4.0 GB, more than half of the device's 8.0 GB");
  const Result<Renderer> square = Renderer::create({.width_px = 16384, .height_px = 16384});
  ASSERT_FALSE(square.ok());
  EXPECT_EQ(square.error().text(), "picture size: 16384 × 16384 is more than 134217728 pixels");
}

TEST_F(RendererTest, MeasuresWhatDoubleComputesForEveryTableType) {
  const std::pair<PhotometricType, GammaAxis> kinds[] = {{PhotometricType::kA, GammaAxis::kGamma0},
                                                         {PhotometricType::kB, GammaAxis::kGamma0},
                                                         {PhotometricType::kC, GammaAxis::kGamma0},
                                                         {PhotometricType::kC, GammaAxis::kGamma90}};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> ahead(2.0, 120.0), side(-25.0, 25.0), high(-1.0, 4.0), tilt(-1.0, 1.0);
  std::vector<MeasurePoint> points;
  for (int i = 0; i < 20000; ++i)
    points.push_back({{1e6 + ahead(random), -2e6 + side(random), high(random)},
                      glm::normalize(glm::dvec3(tilt(random) - 0.6, tilt(random), tilt(random) + 0.4))});
  for (const auto& [type, axis] : kinds) {
    const IntensityTable table = cut_off_table(type, axis);
    renderer->set_beam(0, image_of(table));
    const PlacedLamp lamp{.position_m = {1e6, -2e6, 0.65}, .world_from_image = aim_rotation(0.1, -0.01, 0.02)};
    const std::vector<std::vector<float>> got = renderer->measure(std::span(&lamp, 1), points);
    Worst worst;
    for (std::size_t i = 0; i < points.size(); ++i)
      worst.add(got[0][i], illuminance_lx(lamp.position_m, lamp.world_from_image, table, 1.0, points[i].position_m,
                                          points[i].normal));
    EXPECT_GT(worst.judged, 3000u);
    // Components of the direction carry about 3 roundings of 2^-24 of its length: 1.8e-7 rad or 1e-5°; the cut-off of
    // this table is a logistic of width 0.06°, so intensity changes by at most 1/0.06° of itself: 1.7e-4.
    EXPECT_LT(worst.relative, 2e-4) << "type " << static_cast<int>(type) << ", " << worst.absolute_lx << " lx";
    RecordProperty("worst_relative_type_" + std::to_string(static_cast<int>(type)), std::to_string(worst.relative));
  }
}

// For type C this is the pole of the table, for every type a node that rounding must not lose.
TEST_F(RendererTest, StraightAheadIsLit) {
  const std::pair<PhotometricType, GammaAxis> kinds[] = {{PhotometricType::kA, GammaAxis::kGamma0},
                                                         {PhotometricType::kB, GammaAxis::kGamma0},
                                                         {PhotometricType::kC, GammaAxis::kGamma0},
                                                         {PhotometricType::kC, GammaAxis::kGamma90}};
  for (const auto& [type, axis] : kinds)
    for (const bool uneven : {false, true}) {
      IntensityTable table = cut_off_table(type, axis);
      if (!uneven) {  // steps of 0.25°: the even lookup
        table.second_deg.clear();
        for (int i = 0; i <= 240; ++i)
          table.second_deg.push_back(type == PhotometricType::kC ? (axis == GammaAxis::kGamma90 ? 60.0 : 0.0) + 0.25 * i
                                                                 : 0.25 * i - 30.0);
      }
      table.candela.clear();  // one value at the pole, whichever half-plane it is reached from
      for (double v : table.second_deg)
        table.candela.insert(table.candela.end(), table.first_deg.size(), 1000.0 + 10.0 * v);
      renderer->set_beam(0, image_of(table));
      const PlacedLamp lamp{.position_m = {0, 0, 0}};
      const std::vector<MeasurePoint> points{
          {{25, 0, 0}, {-1, 0, 0}}, {{25, 1e-9, 0}, {-1, 0, 0}}, {{25, -1e-9, -1e-9}, {-1, 0, 0}}};
      const auto lx = renderer->measure(std::span(&lamp, 1), points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double expected =
            illuminance_lx(lamp.position_m, lamp.world_from_image, table, 1.0, points[i].position_m, points[i].normal);
        EXPECT_GT(expected, 0.1);
        EXPECT_NEAR(static_cast<double>(lx[0][i]), expected, 2e-4 * expected)
            << "type " << static_cast<int>(type) << ", axis " << static_cast<int>(axis);
      }
    }
}

TEST_F(RendererTest, OutsideTheTableAndBehindIsDark) {
  IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  const PlacedLamp lamp{.position_m = {0, 0, 1}};
  const std::vector<MeasurePoint> points{{{-5, 0, 1}, {1, 0, 0}}, {{1, 2, 1}, {0, -1, 0}}, {{0, 0, 6}, {0, 0, -1}},
                                         {{5, 0, 1}, {1, 0, 0}},  {{0, 0, 1}, {0, 0, 1}},  {{5, 0, 1}, {-1, 0, 0}}};
  const auto lx = renderer->measure(std::span(&lamp, 1), points);
  EXPECT_EQ(lx[0][0], 0.0f) << "behind";
  EXPECT_EQ(lx[0][1], 0.0f) << "63° to the left, the table ends at 60°";
  EXPECT_EQ(lx[0][2], 0.0f) << "straight up";
  EXPECT_EQ(lx[0][3], 0.0f) << "faces away";
  EXPECT_EQ(lx[0][4], 0.0f) << "the lamp itself";
  EXPECT_GT(lx[0][5], 10.0f);
}

// --- the reference tables of ../shared/data, where they are
// -----------------------------------------------------------

TEST_F(RendererTest, AgreesWithTheReferenceTables) {
  const fs::path data = fs::path(shared_data_dir()) / "photometry-reference";
  if (!fs::exists(data)) GTEST_SKIP() << "no reference tables at " << data;
  const nlohmann::json manifest = nlohmann::json::parse(std::ifstream(data / "manifest.json"));
  struct Case {
    const char* table;
    const char* beam;
    const char* column;
    const char* file;
  };
  for (const Case& c : {Case{"a_road_flat_low.csv", "low", "E", "low_A"},
                        {"a_road_flat_low.csv", "low", "E[low_B]", "low_B"},
                        {"a_road_flat_low.csv", "low", "E[low_C_axis]", "low_C_axis"},
                        {"a_road_flat_low.csv", "low", "E[low_C_horiz]", "low_C_horiz"},
                        {"a_road_flat_high.csv", "high", "E", "high_A"},
                        {"a_road_flat_high.csv", "high", "E[high_B]", "high_B"},
                        {"a_road_flat_fog.csv", "fog", "E", "fog_A"},
                        {"a_road_flat_fog.csv", "fog", "E[fog_C]", "fog_C"},
                        {"b_wall25_low.csv", "low", "E", "low_A"},
                        {"b_wall25_low.csv", "low", "E[low_B]", "low_B"},
                        {"b_wall25_low.csv", "low", "E[low_C_axis]", "low_C_axis"},
                        {"b_wall25_low.csv", "low", "E[low_C_horiz]", "low_C_horiz"},
                        {"b_wall25_high.csv", "high", "E", "high_A"},
                        {"b_wall25_high.csv", "high", "E[high_B]", "high_B"},
                        {"b_wall25_fog.csv", "fog", "E", "fog_A"},
                        {"b_wall25_fog.csv", "fog", "E[fog_C]", "fog_C"}}) {
    const test::CsvTable csv = test::read_csv_table(data / c.table);
    ASSERT_LT(csv.column(c.column), csv.names.size()) << c.table << " " << c.column;
    const nlohmann::json& file = manifest["files"][c.file];
    const bool gamma0_ahead = !file.contains("frame_in_lamp_axes") || file["frame_in_lamp_axes"]["g0"][0] == 1;
    const GammaAxis axis = gamma0_ahead ? GammaAxis::kGamma0 : GammaAxis::kGamma90;
    const Result<IntensityTable> table = read_lm63(data / file["file"].get<std::string>(), axis);
    ASSERT_TRUE(table.ok()) << table.error().text();
    renderer->set_beam(0, image_of(*table));
    // A type C lamp whose C 0 is not where ours is by default is mounted turned: fog_C has C 0 up, a roll of -90°.
    glm::dmat3 turn(1.0);
    if (file.contains("frame_in_lamp_axes")) {
      auto axis_of = [&](const char* key) {
        const nlohmann::json& v = file["frame_in_lamp_axes"][key];
        return glm::dvec3(v[0], v[1], v[2]);
      };
      const glm::dmat3 wanted(axis_of("c0"), axis_of("c90"), axis_of("g0"));
      const glm::dmat3 ours =
          gamma0_ahead ? glm::dmat3(0, -1, 0, 0, 0, 1, 1, 0, 0) : glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1);
      turn = wanted * glm::transpose(ours);
    }
    std::vector<PlacedLamp> lamps;
    for (const nlohmann::json& mounting : manifest["mounting"][c.beam]) {
      auto vec = [&](const char* key) { return glm::dvec3(mounting[key][0], mounting[key][1], mounting[key][2]); };
      lamps.push_back({.position_m = vec("position_m"),
                       .world_from_image = glm::dmat3(vec("forward"), vec("left"), vec("up")) * turn});
    }
    const bool wall = std::string(c.table)[0] == 'b';
    std::vector<MeasurePoint> points;
    for (std::size_t i = 0; i < csv.rows.size(); ++i) {
      if (wall)
        points.push_back({{manifest["wall_x_m"].get<double>(), csv.number(i, "y"), csv.number(i, "z")}, {-1, 0, 0}});
      else
        points.push_back({{csv.number(i, "x"), csv.number(i, "y"), 0.0}, {0, 0, 1}});
    }
    const auto lx = renderer->measure(lamps, points);
    Worst worst;
    for (std::size_t i = 0; i < points.size(); ++i) {
      double sum = 0.0;
      for (const auto& lamp : lx) sum += static_cast<double>(lamp[i]);
      worst.add(sum, csv.number(i, c.column));
    }
    std::printf("%s %s: %zu points above %g lx, worst %.2e relative, %.2e lx\n", c.table, c.column, worst.judged,
                kJudgedAbove_lx, worst.relative, worst.absolute_lx);
    EXPECT_GT(worst.judged, 100u);
    EXPECT_LT(worst.relative, kRelativeLimit) << c.table << " " << c.column;
  }
}

// --- pictures
// ---------------------------------------------------------------------------------------------------------

TEST_F(RendererTest, PictureEqualsTheGoldenOne) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  input.want_image = true;
  const FrameResult result = renderer->draw(input);
  EXPECT_EQ(result.pass_count, result.draws == 3 ? 1u : 2u) << "no pass that nothing called for";
  const Image8 got = renderer->read_image();
  const fs::path golden = fs::path(tests_dir("visual/golden")) / "yard.png";
  if (std::getenv("PHARE_WRITE_GOLDEN") != nullptr) {
    ASSERT_TRUE(write_png(golden, got).ok());
  }
  const Result<Image8> expected = read_png(golden);
  ASSERT_TRUE(expected.ok()) << expected.error().text();
  ASSERT_EQ(got.rgba.size(), expected->rgba.size());
  // Devices round differently and place edges differently by a fraction of a pixel: 99.5 % of all values within 2 of
  // 255.
  std::size_t off = 0;
  for (std::size_t i = 0; i < got.rgba.size(); ++i) off += std::abs(int{got.rgba[i]} - int{expected->rgba[i]}) > 2;
  if (off > got.rgba.size() / 200) {
    const fs::path actual = fs::path(testing::TempDir()) / "yard_actual.png";
    ASSERT_TRUE(write_png(actual, got).ok());
    ADD_FAILURE() << off << " of " << got.rgba.size() << " values differ by more than 2; see " << actual << " beside "
                  << golden << "; when the change is meant: PHARE_WRITE_GOLDEN=1 phare_renderer_test";
  }
}

TEST_F(RendererTest, SameFrameTwiceIsBitIdentical) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  input.want_image = true;
  renderer->draw(input);
  const Image8 first = renderer->read_image();
  renderer->draw(input);
  EXPECT_EQ(renderer->read_image().rgba, first.rgba);
}

TEST_F(RendererTest, HdrPassComesWhenCalledForAndHoldsIlluminance) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  const std::uint32_t without = renderer->draw(input).pass_count;
  input.want_hdr = true;
  EXPECT_EQ(renderer->draw(input).pass_count, without + 1);
  const ImageF hdr = renderer->read_hdr();
  // The wall's middle: Lambert, so luminance is rho·E/pi plus what the sky gives, to the 11 bits of 16-bit float.
  const std::size_t at = (static_cast<std::size_t>(hdr.height_px / 2 + 6) * static_cast<std::size_t>(hdr.width_px) +
                          static_cast<std::size_t>(hdr.width_px * 6 / 10)) *
                         4;
  const double lx = static_cast<double>(hdr.rgba[at + 3]);
  EXPECT_GT(lx, 0.3);
  const double luminance = 0.2126 * static_cast<double>(hdr.rgba[at]) + 0.7152 * static_cast<double>(hdr.rgba[at + 1]) +
                           0.0722 * static_cast<double>(hdr.rgba[at + 2]);
  EXPECT_NEAR(luminance, 0.6 * lx / 3.14159265, 0.01 * lx + 0.02);
}

// Nothing lit, HDR on and off again: an image that a frame does not call for is freed, and memory accounts for itself.
// Against the luminance image and the tone curve in float64: marked is what is above 1 or below half a step of 8 bits,
// all else is the photo.
TEST_F(RendererTest, ClippingIsMarkedWhereTheDisplayClipsAndNowhereElse) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  input.sky_luminance_cdm2 = 0.0;  // what no lamp reaches is black
  input.want_image = true;
  const struct {
    double exposure_per_cdm2;
    bool bright;
  } cases[]{{4.0, true}, {1e-3, false}};
  for (const auto& [exposure_per_cdm2, bright] : cases) {
    input.exposure_per_cdm2 = exposure_per_cdm2;
    input.view = View::kPhoto;
    input.want_hdr = true;
    renderer->draw(input);
    const ImageF hdr = renderer->read_hdr();
    input.want_hdr = false;
    const std::uint32_t passes = renderer->draw(input).pass_count;
    const Image8 photo = renderer->read_image();
    input.view = View::kClipping;
    EXPECT_EQ(renderer->draw(input).pass_count, passes) << "marks cost no pass";
    const Image8 marked = renderer->read_image();
    const glm::dvec3 exposure(exposure_of(input));
    std::size_t above = 0, below = 0, same = 0, stripes = 0;
    for (std::size_t i = 0; i < photo.rgba.size(); i += 4) {
      if (hdr.rgba[i + 3] <= 0.0f) continue;  // sky
      const glm::dvec3 exposed =
          exposure * glm::dvec3(static_cast<double>(hdr.rgba[i]), static_cast<double>(hdr.rgba[i + 1]),
                                static_cast<double>(hdr.rgba[i + 2]));
      const double y = glm::dot(exposed, glm::dvec3(0.2126, 0.7152, 0.0722));
      const glm::dvec3 shown = exposed * ((1.0 + y / 144.0) / (1.0 + y));
      const double most = std::max({shown.x, shown.y, shown.z}), half_step = 0.5 / 255.0 / 12.92;
      // 16-bit float of the image: a thousandth.
      if (most > 1.001) {
        EXPECT_TRUE(marked.rgba[i + 1] == 0 && marked.rgba[i + 2] == 0) << i << ": neither red nor black";
        ++above, stripes += marked.rgba[i] == 255;
      } else if (most < 0.999 * half_step) {
        EXPECT_TRUE(marked.rgba[i] == 0 && marked.rgba[i + 1] == 0) << i << ": neither blue nor black";
        ++below, stripes += marked.rgba[i + 2] > 0;
      } else if (most < 0.999 && most > 1.001 * half_step) {
        for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(marked.rgba[i + c], photo.rgba[i + c]) << i;
        ++same;
      }
    }
    std::printf("%zu pixels above white, %zu below black, %zu as they are\n", above, below, same);
    EXPECT_GT(bright ? above : below, 100u);
    EXPECT_GT(same, 1000u);
    EXPECT_NEAR(static_cast<double>(stripes) / static_cast<double>(above + below), 0.5, 0.1);
  }
}

TEST_F(RendererTest, WhatNoFrameCallsForIsFreed) {
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  input.want_hdr = true;
  renderer->draw(input);  // whatever buffers reading back takes are there now
  input.want_hdr = false;
  renderer->draw(input);  // and the room for the beam's upload is not used any more
  const FrameResult plain = renderer->draw(input);
  const std::uint64_t bytes = renderer->device_memory_bytes();
  EXPECT_EQ(plain.images, 2u) << "display and depth";
  EXPECT_GE(plain.image_bytes, 320u * 180u * 8u);
  EXPECT_FALSE(plain.effects.on(Effect::kHdrImage));

  input.want_hdr = true;
  const FrameResult hdr = renderer->draw(input);
  EXPECT_EQ(hdr.images, 3u);
  EXPECT_EQ(hdr.pass_count, plain.pass_count + 1);
  EXPECT_EQ(hdr.draws, plain.draws + 1);
  EXPECT_TRUE(hdr.effects.on(Effect::kHdrImage));
  EXPECT_EQ(renderer->device_memory_bytes(), bytes + hdr.image_bytes - plain.image_bytes);

  input.want_hdr = false;
  EXPECT_EQ(renderer->draw(input).image_bytes, plain.image_bytes);
  EXPECT_EQ(renderer->device_memory_bytes(), bytes);

  input.lamps.clear();
  const FrameResult dark = renderer->draw(input);
  EXPECT_EQ(dark.pass_count, 1u);
  EXPECT_EQ(dark.images, 2u);
}

TEST_F(RendererTest, AnotherSizeAndBackTakesTheSameMemory) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  const FrameInput input = driver_view();
  renderer->resize(320, 180);
  for (int i = 0; i < 3; ++i) renderer->draw(input);
  const std::uint64_t bytes = renderer->device_memory_bytes();
  renderer->resize(640, 360);
  EXPECT_EQ(renderer->picture_size().width_px, 640);
  EXPECT_EQ(renderer->picture_size().height_px, 360);
  EXPECT_GT(renderer->draw(input).image_bytes, 3u * 320u * 180u * 8u);
  renderer->resize(320, 180);
  renderer->draw(input);
  EXPECT_EQ(renderer->device_memory_bytes(), bytes);
  const std::vector<MeasurePoint> points{{{25, 0, 0}, {-1, 0, 0}}};
  renderer->measure(input.lamps, points);
  renderer->audit(input, 10, 1);
  EXPECT_EQ(renderer->device_memory_bytes(), bytes) << "measuring and auditing keep nothing";
}

TEST_F(RendererTest, OverlayComesWhenThereAreLinesAndLeavesTheRestAlone) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  input.want_image = true;
  const std::uint32_t without = renderer->draw(input).pass_count;
  const Image8 bare = renderer->read_image();
  input.overlay = {"12.3 lx", "pose held"};
  EXPECT_EQ(renderer->draw(input).pass_count, without + 1);
  const Image8 told = renderer->read_image();
  std::size_t bright = 0, changed_below = 0;
  for (int y = 0; y < told.height_px; ++y)
    for (int x = 0; x < told.width_px; ++x) {
      const std::size_t at =
          (static_cast<std::size_t>(y) * static_cast<std::size_t>(told.width_px) + static_cast<std::size_t>(x)) * 4;
      const bool same = std::equal(&told.rgba[at], &told.rgba[at] + 3, &bare.rgba[at]);
      if (y < 64)
        bright += told.rgba[at] > 150 && !same;  // more than half letter
      else
        changed_below += !same;
    }
  EXPECT_GT(bright, 50u) << "letters";
  EXPECT_EQ(changed_below, 0u);
}

TEST_F(RendererTest, ALineWiderThanThePictureGoesOnBelow) {
  FrameInput input = driver_view();
  input.want_image = true;
  const auto letters = [&](int from_y, int to_y) {
    renderer->draw(input);
    const Image8 told = renderer->read_image();
    std::size_t bright = 0;
    for (int y = from_y; y < to_y; ++y)
      for (int x = 0; x < told.width_px; ++x)
        bright += told.rgba[static_cast<std::size_t>((y * told.width_px + x) * 4)] > 150;  // more than half letter
    return bright;
  };
  // Letters of 11 px: lines begin 8 and 22.5 px from the top.
  input.overlay = {"low beam my.ies"};
  EXPECT_GT(letters(8, 22), 50u);
  EXPECT_EQ(letters(25, 36), 0u);
  input.overlay = {"low beam my.ies: table ends at V -9.1: the road nearer than 3.8 m ahead is outside it"};
  EXPECT_GT(letters(25, 36), 50u);
}

TEST_F(RendererTest, AMarksLettersShrinkUntilTheyFit) {
  FrameInput input = driver_view();
  input.camera.world_from_eye = aim_rotation(0.0, 1.2, 0.0);  // the dark sky alone
  input.want_image = true;
  const auto letters_right_of = [&](double x_01) {
    renderer->draw(input);
    const Image8 told = renderer->read_image();
    std::size_t bright = 0;
    for (int y = 0; y < told.height_px; ++y)
      for (int x = static_cast<int>(std::ceil(x_01 * told.width_px)); x < told.width_px; ++x)
        bright += told.rgba[static_cast<std::size_t>((y * told.width_px + x) * 4)] > 150;
    return bright;
  };
  input.marks.labels = {{0.1, 0.2, "no probe and no point is set in this drive", {255, 255, 255}}};
  EXPECT_GT(letters_right_of(0.4), 10u);
  input.marks.labels.front().room_01 = 0.3;
  EXPECT_GT(letters_right_of(0.3), 10u);
  EXPECT_EQ(letters_right_of(0.4), 0u);
}

TEST_F(RendererTest, AuditedPixelsAgreeWithDouble) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  const FrameInput input = driver_view();
  const std::vector<AuditSample> samples = renderer->audit(input, 500, 1);
  ASSERT_EQ(samples.size(), 500u);
  Worst worst;
  for (const AuditSample& sample : samples) {
    double expected = 0.0;
    for (const PlacedLamp& lamp : input.lamps)
      expected += illuminance_lx(lamp.position_m, lamp.world_from_image, table, 1.0, sample.point.position_m,
                                 sample.point.normal);
    worst.add(sample.illuminance_lx, expected);
  }
  EXPECT_GT(worst.judged, 300u);
  EXPECT_LT(worst.relative, kPixelLimit);
}

TEST_F(RendererTest, NoLampNoLight) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = driver_view();
  input.lamps.clear();
  input.sky_luminance_cdm2 = 0.0;
  input.want_image = true;
  renderer->draw(input);
  const Image8 picture = renderer->read_image();
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) ASSERT_EQ(picture.rgba[i], i % 4 == 3 ? 255 : 0) << i;
}

TEST(RendererCreate, RefusesBadOptionsWithAReason) {
  EXPECT_FALSE(Renderer::create({.width_px = 0}).ok());
  EXPECT_FALSE(Renderer::create({.width_px = 20000}).ok());
  EXPECT_FALSE(Renderer::create({.samples = 3}).ok());
  const Result<Renderer> none = Renderer::create({.width_px = 16, .height_px = 16, .device_name = "no such device"});
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().text().find("no such device"), std::string::npos);
}

}  // namespace
}  // namespace phare
