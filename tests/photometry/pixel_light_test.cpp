// A pixel light against its definition, and what a change of its picture costs.
#include "visual/photometry/beam/pixel_light.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <random>

#include "tests/photometry/photometry_test_files.h"
#include "visual/photometry/beam/live_beam.h"

namespace phare {
namespace {

/// Full light that rises to the right and falls upwards: bilinear, so a table of four nodes is exact.
IntensityTable full_light() {
  IntensityTable table;
  table.name = "full";
  table.first_deg = {-8.0, 8.0};
  table.second_deg = {-4.0, 4.0};
  table.candela = {40'000.0, 60'000.0, 10'000.0, 20'000.0};
  return table;
}

PixelFrame random_frame(std::size_t columns, std::size_t rows, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  PixelFrame frame{columns, rows, {}};
  for (std::size_t i = 0; i < columns * rows; ++i) frame.shares.push_back(static_cast<std::uint8_t>(random() >> 56));
  return frame;
}

/// A map that is bent as a projection lens bends it: 1 % inwards at the corners, with knots every eighth of the raster.
PixelMap bent_map(std::size_t columns, std::size_t rows) {
  PixelMap map;
  for (int i = 0; i <= 8; ++i) {
    map.columns.push_back(static_cast<double>(columns) * i / 8.0);
    map.rows.push_back(static_cast<double>(rows) * i / 8.0);
  }
  for (int j = 0; j <= 8; ++j)
    for (int i = 0; i <= 8; ++i) {
      const double x = i / 4.0 - 1.0, y = 1.0 - j / 4.0, bent = 1.0 - 0.01 * (x * x + y * y);
      map.hv_deg.emplace_back(6.0 * x * bent, 3.0 * y * bent);
    }
  return map;
}

TEST(PixelLight, APixelShinesItsShareAtItsMiddle) {
  constexpr std::size_t kColumns = 60, kRows = 30;
  const IntensityTable full = full_light();
  PixelLight light(full, even_map(kColumns, kRows, {-6.0, -3.0}, {6.0, 3.0}), kColumns, kRows);
  EXPECT_EQ(light.table().peak_cd(), 0.0) << "dark at first";
  const PixelFrame frame = random_frame(kColumns, kRows, 1);
  EXPECT_FALSE(light.show(frame).empty());
  for (std::size_t row = 0; row < kRows; ++row)
    for (std::size_t column = 0; column < kColumns; ++column) {
      const double h_deg = -6.0 + 0.2 * (static_cast<double>(column) + 0.5),
                   v_deg = 3.0 - 0.2 * (static_cast<double>(row) + 0.5);
      const double expected_cd =
          full.intensity_cd(direction_hv(h_deg, v_deg)) * frame.shares[row * kColumns + column] / 255.0;
      EXPECT_NEAR(light.table().intensity_cd(direction_hv(h_deg, v_deg)), expected_cd, 1e-9 * 60'000.0);
    }
  // Beyond the outermost middles it falls to nothing within a pixel.
  EXPECT_EQ(light.table().intensity_cd(direction_hv(6.11, 0.0)), 0.0);
  EXPECT_NEAR(light.flux_lm(), light.table().flux_lm(), 1e-4 * light.flux_lm());
}

// In a bent raster the share at a pixel's middle is read from nodes up to half a pixel off: exact where shares are
// linear, whatever the map; here linear in the columns.
TEST(PixelLight, ABentRasterPutsPixelsWhereTheMapSays) {
  constexpr std::size_t kColumns = 255, kRows = 128;
  IntensityTable full = full_light();
  full.candela.assign(4, 50'000.0);
  const PixelMap map = bent_map(kColumns, kRows);
  PixelLight light(full, map, kColumns, kRows);
  PixelFrame frame{kColumns, kRows, {}};
  for (std::size_t i = 0; i < kColumns * kRows; ++i) frame.shares.push_back(static_cast<std::uint8_t>(i % kColumns));
  light.show(frame);
  double worst_01 = 0.0;
  const std::size_t across = map.columns.size();
  for (std::size_t q = 0; q + 1 < map.rows.size(); ++q)
    for (std::size_t p = 0; p + 1 < across; ++p)
      for (const double u : {0.2, 0.5, 0.8})
        for (const double v : {0.3, 0.6}) {
          const glm::dvec2 hv_deg =
              (1.0 - v) * ((1.0 - u) * map.hv_deg[q * across + p] + u * map.hv_deg[q * across + p + 1]) +
              v * ((1.0 - u) * map.hv_deg[(q + 1) * across + p] + u * map.hv_deg[(q + 1) * across + p + 1]);
          const double column = map.columns[p] + u * (map.columns[p + 1] - map.columns[p]);
          const double expected_01 = (column - 0.5) / 255.0;
          worst_01 =
              std::max(worst_01,
                       std::abs(light.table().intensity_cd(direction_hv(hv_deg.x, hv_deg.y)) / 50'000.0 - expected_01));
        }
  // Where two patches meet, the columns per degree differ by 1.5 % (0.06 x 0.25 of the bend), of which a node cuts off
  // a quarter at the most, in both directions: 0.008 columns. Their places as float32: 255 x 6e-8.
  EXPECT_LT(worst_01, 0.008 / 255.0);
}

TEST(PixelLight, OnlyWhatChangedIsLookedAtAndComesOutAsFromNothing) {
  constexpr std::size_t kColumns = 300, kRows = 200;
  const IntensityTable full = full_light();
  for (const bool bent : {false, true}) {
    const PixelMap map = bent ? bent_map(kColumns, kRows) : even_map(kColumns, kRows, {-6.0, -3.0}, {6.0, 3.0});
    PixelLight light(full, map, kColumns, kRows);
    PixelFrame frame = random_frame(kColumns, kRows, 2);
    light.show(frame);
    EXPECT_TRUE(light.show(frame).empty()) << "the same picture again";
    std::mt19937_64 random(3);
    for (int change = 0; change < 20; ++change) {
      const std::size_t column = random() % (kColumns - 20), row = random() % (kRows - 20);
      for (std::size_t j = row; j < row + 20; ++j)
        for (std::size_t i = column; i < column + 20; ++i)
          frame.shares[j * kColumns + i] = static_cast<std::uint8_t>(random() >> 56);
      const auto changed = light.show(frame);
      std::size_t looked_at = 0;
      for (const TexelRect& rect : changed) looked_at += rect.texels();
      EXPECT_GE(looked_at, 400u);
      // 20 pixels touch two tiles of 32 in each direction; those two, bent by 2 % and half a pixel, up to four of
      // nodes.
      EXPECT_LE(looked_at, std::size_t{bent ? 128u * 128u : 64u * 64u}) << bent;
    }
    PixelLight fresh(full, map, kColumns, kRows);
    fresh.show(frame);
    EXPECT_EQ(light.table().candela, fresh.table().candela) << bent;
    EXPECT_EQ(light.flux_lm(), fresh.flux_lm());
  }
}

// In a lamp with another source the image follows the picture, summed only where it changed, as one made from nothing.
TEST(PixelLight, TheBeamImageFollows) {
  constexpr std::size_t kColumns = 200, kRows = 100;
  const IntensityTable full = full_light();
  IntensityTable low = full_light();
  low.first_deg = {-20.0, -3.3, 20.0}, low.second_deg = {-10.0, -0.5, 0.5}, low.candela.assign(9, 3'000.0);
  PixelLight light(full, even_map(kColumns, kRows, {-6.0, -3.0}, {6.0, 3.0}), kColumns, kRows);
  PixelFrame frame{kColumns, kRows, std::vector<std::uint8_t>(kColumns * kRows, 0)};
  const auto sources = [&](const PixelLight& pixels) {
    return std::vector<AimedSource>{{.table = &low}, {.table = &pixels.table(), .scale = 0.5, .changes = true}};
  };
  LiveBeam beam(sources(light));
  beam.set_dimming(0, 1.0), beam.set_dimming(1, 1.0);
  beam.update();
  std::mt19937_64 random(4);
  for (int change = 0; change < 12; ++change) {
    const std::size_t column = random() % (kColumns - 30), row = random() % (kRows - 30);
    for (std::size_t j = row; j < row + 30; ++j)
      for (std::size_t i = column; i < column + 30; ++i)
        frame.shares[j * kColumns + i] = static_cast<std::uint8_t>(change % 3 == 2 ? 0 : random() >> 56);
    const std::uint64_t before = beam.summed_texels();
    const auto changed = light.show(frame);
    beam.table_changed(1, changed, light.flux_lm());
    const LiveBeam::Change kind = beam.update();
    EXPECT_EQ(kind, changed.empty() ? LiveBeam::Change::kNone : LiveBeam::Change::kPart);
    // Two tiles of 32 in each direction, and of the low beam's three nodes there those that are not the raster's.
    EXPECT_LE(beam.summed_texels() - before, 67u * 67u);
    LiveBeam fresh(sources(light));
    fresh.set_dimming(0, 1.0), fresh.set_dimming(1, 1.0);
    fresh.update();
    EXPECT_EQ(std::vector<float>(beam.image().candela), fresh.image().candela) << change;
  }
}

TEST(PixelLight, MapsThatAreNoneAreRefused) {
  const auto error_of = [&](const std::string& text) {
    const std::filesystem::path file = test::temporary_file("map.csv", text);
    const auto map = read_pixel_map(file, 40, 20);
    return map ? std::string("taken") : map.error().text().substr(file.string().size());
  };
  const std::string head = "column,row,h_deg,v_deg\n";
  EXPECT_EQ(error_of(head + "0,0,-6,3\n40,0,6,3\n0,20,-6,-3\n40,20,6,-3\n"), "taken");
  EXPECT_EQ(error_of("column,row,h_deg\n0,0,1\n"),
            ":1: no column \"v_deg\"; a pixel map has column, row, h_deg, v_deg");
  EXPECT_EQ(error_of(head + "0,0,-6,3\n41,0,6,3\n"), ":3: a knot beyond a raster of 40 × 20 pixels (0 to its size)");
  EXPECT_EQ(error_of(head + "0,0,-6,3\n0,0,6,3\n"), ":3: this knot is there twice");
  EXPECT_EQ(error_of(head + "0,0,-6,3\n40,0,6,3\n0,20,-6,-3\n"),
            ": 3 knots, not one for each of 2 columns in each of 2 rows");
  EXPECT_EQ(error_of(head + "0,0,-6,3\n40,0,6,3\n0,20,-6,3.5\n40,20,6,-3\n"),
            ":4: the map folds over: h_deg grows with column, v_deg falls with row");
  EXPECT_EQ(error_of(head + "0,0,-6,3\n30,0,6,3\n0,20,-6,-3\n30,20,6,-3\n"),
            ": knots have to reach from 0 to 40 in column and to 20 in row, the size of the picture");
  EXPECT_EQ(read_pixel_frame("none.png").error().text(), "none.png: is no file");
  EXPECT_EQ(read_pixel_frame("/dev/zero").error().text(), "/dev/zero: is no file")
      << "nor a pipe, which would be waited for";
  const auto wide = test::temporary_file("wide.pgm", "P5 16383 1 255\n" + std::string(16'383, 'x'));
  EXPECT_EQ(read_pixel_frame(wide).error().reason, "16383 × 1 pixels, more than 16382 across");
  const auto cut = test::temporary_file("cut.png", "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(read_pixel_frame(cut).error().text().substr(0, cut.string().size() + 24),
            cut.string() + ": not a readable picture");
  const auto short_pgm = test::temporary_file("short.pgm", "P5 40 20 255\nxxxx");
  EXPECT_FALSE(read_pixel_frame(short_pgm).ok()) << "400 pixels are missing";
}

// 1.3 million pixels. No bound on time: what it takes is printed, and stands in docs/pixel-light.md.
TEST(PixelLight, WhatAMillionPixelsTake) {
  constexpr std::size_t kColumns = 1'664, kRows = 800;
  const IntensityTable full = full_light();
  using Clock = std::chrono::steady_clock;
  const auto ms = [](Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); };
  for (const bool bent : {false, true}) {
    const PixelMap map = bent ? bent_map(kColumns, kRows) : even_map(kColumns, kRows, {-6.0, -3.0}, {6.0, 3.0});
    PixelLight light(full, map, kColumns, kRows);
    PixelFrame frame = random_frame(kColumns, kRows, 5);
    light.show(frame);
    LiveBeam beam({{.table = &light.table(), .changes = true}});
    beam.set_dimming(0, 1.0);
    beam.update();
    const auto change = [&](std::size_t columns, std::size_t rows) {
      std::vector<double> taken;
      for (int i = 0; i < 9; ++i) {
        for (std::size_t j = 0; j < rows; ++j)
          for (std::size_t k = 0; k < columns; ++k) frame.shares[(200 + j) * kColumns + 700 + k] ^= 0x55;
        const auto start = Clock::now();
        const auto changed = light.show(frame);
        beam.table_changed(0, changed, light.flux_lm());
        EXPECT_EQ(beam.update(), LiveBeam::Change::kPart);
        taken.push_back(ms(Clock::now() - start));
      }
      std::ranges::sort(taken);
      return taken[4];
    };
    const std::uint64_t before = beam.summed_texels();
    const double part_ms = change(116, 115);  // 1 %
    const std::uint64_t summed = (beam.summed_texels() - before) / 9;
    // Columns 700 to 815 lie in five tiles of 32, rows 200 to 314 in four; bent, one more may show them on each side.
    if (bent)
      EXPECT_LE(summed, 7u * 6u * 32u * 32u);
    else
      EXPECT_EQ(summed, 5u * 4u * 32u * 32u) << "of 1.3 million nodes";
    std::printf("%s: 1 %% changed: %.2f ms (%llu nodes summed), half changed: %.1f ms\n", bent ? "bent" : "even",
                part_ms, static_cast<unsigned long long>(summed), change(900, 600));
  }
}

}  // namespace
}  // namespace phare
