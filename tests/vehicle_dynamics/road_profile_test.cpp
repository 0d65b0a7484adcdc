// Height profiles: ISO 8608 spectrum, bumps, tyre envelope, files, query time.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>

#include "config/road/road_surface_profile.h"
#include "vehicle_dynamics/road.h"

namespace phare {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(HeightProfile, RoughnessHasItsSpectrum) {
  const double rms_mm[5] = {3.8, 7.6, 15.2, 30.4, 60.9};
  for (int c = 0; c < 5; ++c) {
    const HeightProfile road = HeightProfile::iso8608(static_cast<RoughnessClass>(c), 7, 500.0);
    double sum = 0.0;
    for (int i = 0; i < 10'000; ++i) sum += std::pow(road.at(0.05 * i, true).z_m, 2);
    EXPECT_NEAR(std::sqrt(sum / 10'000) * 1e3, rms_mm[c], 0.03 * rms_mm[c]);
  }
  const HeightProfile road = HeightProfile::iso8608(RoughnessClass::kB, 7, 500.0);
  for (double octave = 0.016; octave < 2.0; octave *= 2.0)
    for (const bool left : {true, false}) {
      // Mean power of lines in the octave against Gd(n0) (n/n0)^-2 dn.
      double found = 0.0, expected = 0.0;
      const double dn = 1.0 / 500.0;
      const int first = static_cast<int>(std::ceil(octave / dn)), last = static_cast<int>(2.0 * octave / dn);
      const int stride = std::max(1, (last - first) / 24);
      for (int k = first; k < last; k += stride) {
        double re = 0.0, im = 0.0;
        for (int i = 0; i < 10'000; ++i) {
          const double z = road.at(0.05 * i, left).z_m, phase = 2.0 * kPi * k * dn * 0.05 * i;
          re += z * std::cos(phase), im += z * std::sin(phase);
        }
        found += 2.0 * (re * re + im * im) / 1e8;
        expected += 64e-6 * std::pow(k * dn / 0.1, -2.0) * dn;
      }
      // The right track's lines mix two phases, so their power scatters about the mean.
      EXPECT_LT(std::abs(10.0 * std::log10(found / expected)), left ? 0.1 : 1.0)
          << octave << (left ? " left" : " right");
    }
}

TEST(HeightProfile, SameSeedSameRoad) {
  const HeightProfile a = HeightProfile::iso8608(RoughnessClass::kC, 1, 100.0),
                      b = HeightProfile::iso8608(RoughnessClass::kC, 1, 100.0),
                      other = HeightProfile::iso8608(RoughnessClass::kC, 2, 100.0);
  EXPECT_EQ(a.at(12.34, true).z_m, b.at(12.34, true).z_m);
  EXPECT_NE(a.at(12.34, true).z_m, other.at(12.34, true).z_m);
  EXPECT_NEAR(a.at(12.34, true).z_m, a.at(112.34, true).z_m, 1e-12);
  EXPECT_NEAR(a.at(12.34, false).z_m, a.at(-87.66, false).z_m, 1e-12);
}

TEST(HeightProfile, BumpsAndTheTyresEnvelope) {
  HeightProfile bump = HeightProfile::bumps({{.start_m = 2.0, .height_m = 0.06, .length_m = 3.0}});
  EXPECT_NEAR(bump.at(3.5, true).z_m, 0.06, 1e-9);
  EXPECT_NEAR(bump.at(2.75, true).z_m, 0.03, 1e-6);
  EXPECT_NEAR(bump.at(2.75, true).slope, 0.03 * 2.0 * kPi / 3.0, 1e-4);
  EXPECT_EQ(bump.at(100.0, true).z_m, 0.0);
  HeightProfile kerb = HeightProfile::bumps({{.shape = Bump::Shape::kStep, .start_m = 1.0, .height_m = 0.1}});
  kerb.smooth(0.1);
  EXPECT_NEAR(kerb.at(1.0, true).z_m, 0.05, 0.004);
  EXPECT_EQ(kerb.at(0.9, true).z_m, 0.0);
  EXPECT_NEAR(kerb.at(50.0, true).z_m, 0.1, 1e-12);
}

TEST(HeightProfile, FilesAndTheirFaults) {
  const auto written = [](const char* text) {
    const std::string file = testing::TempDir() + "profile.csv";
    std::ofstream(file) << text;
    return file;
  };
  const auto good = HeightProfile::read(written("x_m,z_left_m,z_right_m\n0,0,0\n1,0.1,0.2\n2,0.2,0.4\n"));
  ASSERT_TRUE(good.ok()) << good.error().text();
  EXPECT_NEAR(good->at(1.0, true).z_m, 0.1, 1e-12);
  for (double x = 0.0; x <= 2.0; x += 0.1) {  // straight tracks stay straight, in the first and last cell too
    EXPECT_NEAR(good->at(x, true).z_m, 0.1 * x, 1e-12) << x;
    EXPECT_NEAR(good->at(x, false).z_m, 0.2 * x, 1e-12) << x;
  }
  const auto two = HeightProfile::read(written("x_m,z_m\n0,0\n100,10\n"));
  ASSERT_TRUE(two.ok());
  EXPECT_NEAR(two->at(5.0, true).z_m, 0.5, 1e-12);
  EXPECT_NEAR(two->at(50.0, true).slope, 0.1, 1e-12);
  EXPECT_EQ(two->at(150.0, true).z_m, 10.0);
  const std::pair<const char*, const char*> bad[] = {{"x_m,z_m\n0,0\n0,1\n", "profile.csv:3: x_m does not rise"},
                                                     {"x_m,z_m\n0,0\n1,nan\n", "profile.csv:3: column z_m"},
                                                     {"x_m,z_m\n0,0\n1\n", "profile.csv:3: column z_m is missing"},
                                                     {"x_m,q\n0,0\n1,1\n", "profile.csv:1:"},
                                                     {"x_m,z_m\n0,0\n", "two rows"},
                                                     {"x_m,z_m\n0,0\n1,1e9\n", "profile.csv:3:"}};
  for (const auto& [text, expected] : bad) {
    const auto read = HeightProfile::read(written(text));
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().text().find(expected), std::string::npos) << read.error().text();
  }
  EXPECT_FALSE(HeightProfile::read("/nonexistent.csv").ok());
}

TEST(HeightProfile, QueryTime) {
  Road road;
  road.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kC, 1, 200.0));
  bool off = false;
  double sum = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) sum += road.at(0.0, 0.0, 0.013 * i, i % 2 == 0, 0.0, &off).z_m;
  const double ns = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() / kCount;
  std::printf("road query: %.0f ns (sum %.3g)\n", ns, sum);
  EXPECT_FALSE(off);
}

}  // namespace
}  // namespace phare
