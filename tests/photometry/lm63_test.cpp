// The LM-63 reader and the table on small files of our own with values worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "photometry_test_files.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {
namespace {

Result<IntensityTable> read(const std::string& text, GammaAxis axis = GammaAxis::kGamma0) {
  return read_lm63(test::temporary_file("lamp.ies", text), axis);
}

std::string reason(const std::string& text) {
  const auto table = read(text);
  if (table.ok()) return "read";
  return table.error().text().substr(table.error().text().find("lamp.ies"));
}

const std::string kHead = "IESNA:LM-63-2002\n[TEST] 1\nTILT=NONE\n";
// V -10, 10; H -20, 0, 40: columns (100, 200), (300, 400), (500, 900).
const std::string kTypeA = kHead + "1 -1 1 2 3 3 2 0 0 0\n1 1 0\n-10 10\n-20 0 40\n100 200\n300 400\n500 900\n";

TEST(Lm63, BilinearByHand) {
  const auto table = read(kTypeA);
  ASSERT_TRUE(table.ok()) << table.error().text();
  EXPECT_EQ(table->type, PhotometricType::kA);
  EXPECT_EQ(table->version, "IESNA:LM-63-2002");
  EXPECT_TRUE(table->content_hash.starts_with("sha256:"));
  EXPECT_TRUE(table->notes.empty());
  EXPECT_DOUBLE_EQ(table->intensity_at_cd({-20, -10}), 100.0);
  EXPECT_DOUBLE_EQ(table->intensity_at_cd({40, 10}), 900.0);  // the limits belong to the range
  EXPECT_DOUBLE_EQ(table->intensity_at_cd({-10, 0}), 250.0);
  EXPECT_DOUBLE_EQ(table->intensity_at_cd({10, -5}), 0.75 * 350 + 0.25 * 525);
  EXPECT_EQ(table->intensity_at_cd({std::nextafter(40.0, 50.0), 0}), 0.0);
  EXPECT_EQ(table->intensity_at_cd({0, -10.0001}), 0.0);
  EXPECT_EQ(table->intensity_at_cd({NAN, 0}), 0.0);
  EXPECT_EQ(table->intensity_cd({0, 0, 0}), 0.0);
  EXPECT_EQ(table->peak_cd(), 900.0);
}

TEST(Lm63, DirectionsOfTheThreeTypes) {
  const auto expect = [](PhotometricType type, GammaAxis axis, glm::dvec3 d, double first, double second) {
    const TableAngles angles = table_angles(type, axis, d);
    EXPECT_NEAR(angles.first_deg, first, 1e-12);
    EXPECT_NEAR(angles.second_deg, second, 1e-12);
  };
  const auto a = PhotometricType::kA, b = PhotometricType::kB, c = PhotometricType::kC;
  const auto g0 = GammaAxis::kGamma0, g90 = GammaAxis::kGamma90;
  expect(a, g0, {1, -1, std::sqrt(2.0)}, 45, 45);  // right is y < 0
  expect(b, g0, {1, -std::sqrt(2.0), 1}, 45, 45);
  expect(a, g0, {0, 0, 1}, 0, 90);
  expect(b, g0, {0, 1, 0}, -90, 0);
  expect(c, g0, {1, -1, 0}, 0, 45);  // gamma0: C 0 right, C 90 up
  expect(c, g0, {1, 0, 1}, 90, 45);
  expect(c, g0, {1, 1, 0}, 180, 45);
  expect(c, g0, {1, 0, -1}, 270, 45);
  expect(c, g90, {1, 0, 0}, 0, 90);  // gamma90: C 0 ahead, C 90 left, gamma 0 down
  expect(c, g90, {0, 1, 0}, 90, 90);
  expect(c, g90, {0, 0, -1}, 0, 0);
  expect(c, g90, {0, 0, 1}, 0, 180);
  // Just right of straight ahead: 360 - tiny must not leave [0, 360).
  EXPECT_LT(table_angles(c, g90, {1, -1e-17, 0}).first_deg, 360.0);
  EXPECT_NEAR(table_angles(c, g90, {1, -1e-9, 0}).first_deg, 360.0 - 1e-9 * 180 / std::numbers::pi, 1e-12);
}

TEST(Lm63, FirstHorizontalAngleZeroMirrorsTypesAAndB) {
  for (const char* type : {"3", "2"}) {
    const auto table = read(kHead + "1 -1 1 2 2 " + type + " 2 0 0 0\n1 1 0\n-10 10\n0 40\n300 400\n500 900\n");
    ASSERT_TRUE(table.ok()) << table.error().text();
    EXPECT_EQ(table->first_deg, (std::vector<double>{-40, 0, 40}));
    for (const double h : {0.0, 3.0, 17.0, 40.0}) {
      for (const double v : {-10.0, -3.0, 10.0})
        EXPECT_DOUBLE_EQ(table->intensity_at_cd({h, v}), table->intensity_at_cd({-h, v}));
    }
  }
}

TEST(Lm63, TypeCUnfolds) {
  const auto quadrant = read(kHead + "1 -1 1 2 3 1 2 0 0 0\n1 1 0\n0 90\n0 30 90\n10 20\n30 40\n50 60\n");
  ASSERT_TRUE(quadrant.ok()) << quadrant.error().text();
  EXPECT_EQ(quadrant->first_deg, (std::vector<double>{0, 30, 90, 150, 180, 210, 270, 330, 360}));
  for (const double c : {150.0, 210.0, 330.0}) EXPECT_EQ(quadrant->intensity_at_cd({c, 90}), 40.0);
  EXPECT_EQ(quadrant->intensity_at_cd({180, 0}), 10.0);

  const auto half = read(kHead + "1 -1 1 2 3 1 2 0 0 0\n1 1 0\n0 90\n0 30 180\n10 20\n30 40\n50 60\n");
  ASSERT_TRUE(half.ok()) << half.error().text();
  EXPECT_EQ(half->first_deg, (std::vector<double>{0, 30, 180, 330, 360}));
  EXPECT_EQ(half->intensity_at_cd({330, 90}), 40.0);

  const auto round = read(kHead + "1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n10 20\n");
  ASSERT_TRUE(round.ok()) << round.error().text();
  EXPECT_EQ(round->intensity_at_cd({217, 45}), 15.0);

  const auto upright = read(kHead + "1 -1 1 2 3 1 2 0 0 0\n1 1 0\n0 90\n90 180 270\n10 20\n30 40\n50 60\n");
  ASSERT_TRUE(upright.ok()) << upright.error().text();
  EXPECT_EQ(upright->first_deg, (std::vector<double>{0, 90, 180, 270, 360}));
  EXPECT_EQ(upright->intensity_at_cd({0, 90}), 40.0);
  EXPECT_EQ(upright->intensity_at_cd({45, 90}), 30.0);

  const auto open = read(kHead + "1 -1 1 2 4 1 2 0 0 0\n1 1 0\n0 90\n0 90 180 270\n10 20\n30 40\n50 60\n70 80\n");
  ASSERT_TRUE(open.ok()) << open.error().text();
  EXPECT_EQ(open->intensity_at_cd({315, 90}), 50.0);
  ASSERT_EQ(open->notes.size(), 1u);
}

TEST(Lm63, FactorsOfTheEditions) {
  const auto peak = [](const std::string& first_lines, const std::string& field_12) {
    const auto table =
        read(first_lines + "TILT=NONE\n1 1000 1.5 2 2 3 1 0 0 0\n0.9 " + field_12 + " 55\n0 10\n-5 5\n1 2\n3 4\n");
    return table.ok() ? table->peak_cd() : -1.0;
  };
  EXPECT_DOUBLE_EQ(peak("any words\n", "0.8"), 4 * 1.5 * 0.9 * 0.8);  // 1986
  EXPECT_DOUBLE_EQ(peak("", "0.8"), 4 * 1.5 * 0.9 * 0.8);
  EXPECT_DOUBLE_EQ(peak("IESNA91\n[TEST] x\n", "0.8"), 4 * 1.5 * 0.9 * 0.8);
  EXPECT_DOUBLE_EQ(peak("IESNA:LM-63-1995\n[TEST] x\n", "0.8"), 4 * 1.5 * 0.9);
  EXPECT_DOUBLE_EQ(peak("IESNA:LM-63-2002\n[TEST] x\n", "0.8"), 4 * 1.5 * 0.9);
  EXPECT_DOUBLE_EQ(peak("IES:LM-63-2019\n[TEST] x\n", "1.00010"), 4 * 1.5 * 0.9);
}

TEST(Lm63, LayoutIsFree) {
  std::string scattered = kTypeA;
  for (std::size_t i = kHead.size(); i < scattered.size(); ++i) {
    if (scattered[i] == ' ') scattered[i] = i % 2 == 0 ? '\n' : ',';
  }
  std::string dos;
  for (const char c : kTypeA) dos += c == '\n' ? "\r\n" : std::string(1, c);
  std::string mac = kTypeA;
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  const auto plain = read(kTypeA);
  ASSERT_TRUE(plain.ok());
  for (const std::string& text : {scattered, dos, mac, "\xEF\xBB\xBF" + kTypeA}) {
    const auto table = read(text);
    ASSERT_TRUE(table.ok()) << table.error().text();
    EXPECT_EQ(table->candela, plain->candela);
    EXPECT_EQ(table->first_deg, plain->first_deg);
  }
}

TEST(Lm63, RefusalsSayWhereAndWhy) {
  EXPECT_EQ(reason(""), "lamp.ies: is empty");
  EXPECT_EQ(reason("a\nb\n"), "lamp.ies:2: no TILT= line: not an LM-63 file, or cut off");
  EXPECT_EQ(reason("IESNA91\nTILT=\n"), "lamp.ies:2: TILT= names nothing; expected NONE, INCLUDE or a file");
  EXPECT_EQ(reason(kHead + "1 -1 1 0 3 3 2 0 0 0\n"),
            "lamp.ies:4: the number of vertical angles cannot be 0 in a file of 57 bytes");
  EXPECT_EQ(reason(kHead + "1 -1 1 40 40 3 2 0 0 0\n"), "lamp.ies:4: 40 × 40 candela cannot be in a file of 59 bytes");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2.5 3 2 0 0 0\n"),
            "lamp.ies:4: the number of horizontal angles cannot be 2.5 in a file of 59 bytes");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 4 2 0 0 0\n1 1 0\n"),
            "lamp.ies:4: the photometric type is 4, not 1 (C), 2 (B) or 3 (A)");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 3 2 0 0 0\n1 1 0\n10 -10\n0 9\n1 2 3 4"),
            "lamp.ies:6: vertical angles must increase, but -10 follows 10");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 3 2 0 0 0\n1 1 0\n0 10\n5 5\n1 2 3 4"),
            "lamp.ies:7: horizontal angles must increase, but 5 follows 5");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 3 2 0 0 0\n1 1 0\n0 100\n5 6\n1 2 3 4"),
            "lamp.ies:6: vertical angle 100 is outside -90 to 90");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 3 2 0 0 0\n1 1 0\n0 10\n5 6\n1 2 nan 4"),
            "lamp.ies:8: a candela value is not a finite number: \"nan\" (value 3 of 4)");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 3 2 0 0 0\n1 1 0\n0 10\n5 6\n1 2 3,5x 4"),
            "lamp.ies:8: a candela value is not a number: \"5x\" (value 4 of 4)");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 3 2 0 0 0\n1 1 0\n0 10\n5 6\n1 2\n-3 4"), "lamp.ies:9: negative candela -3");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 3 2 0 0 0\n1 1 0\n0 10\n5 6\n1 2\n3\n"),
            "lamp.ies:10: the file ends where a candela value is expected (value 4 of 4)");
  EXPECT_EQ(reason(kHead + "1 -1 1e300 2 2 3 2 0 0 0\n1 1 0\n0 10\n5 6\n1 2\n3 1e300"),
            "lamp.ies:9: candela times the factors of the header is no finite number");
  EXPECT_EQ(reason(kHead + "1 -1 0 2 2 3 2 0 0 0\n"), "lamp.ies:4: the candela multiplier is 0, not above 0");
  EXPECT_EQ(reason(kHead + "1 -1 1 2 2 1 2 0 0 0\n1 1 0\n0 10\n5 6\n1 2 3 4"),
            "lamp.ies:7: C angles from 5 to 6 are no symmetry of LM-63");
  EXPECT_FALSE(read_lm63("/nowhere/lamp.ies").ok());
  EXPECT_FALSE(read_lm63("/").ok());
}

TEST(Lm63, HugeCountsAllocateNothing) {
  EXPECT_FALSE(read(kHead + "1 -1 1 1000000000 1000000000 3 2 0 0 0\n1 1 0\n").ok());
  EXPECT_FALSE(read(kHead + "1 -1 1 1e308 1e308 3 2 0 0 0\n1 1 0\n").ok());
  EXPECT_FALSE(read("TILT=INCLUDE\n1\n999999999\n").ok());
}

TEST(Lm63, TooManyValuesAreReported) {
  const auto table = read(kTypeA + "7 8 9\n");
  ASSERT_TRUE(table.ok());
  ASSERT_EQ(table->notes.size(), 1u);
  EXPECT_NE(table->notes[0].find("lamp.ies:11: 3 word(s) after the last candela value ignored"), std::string::npos)
      << table->notes[0];
}

// "1,5" is two numbers here; where that makes more than the table has, it was one.
TEST(Lm63, DecimalCommasAreRefusedNotReadAsTwoNumbers) {
  const std::string axes = kHead + "1 1000 1 2 2 3 2 0 0 0\n1 1 0\n-10 10\n-20 20\n";
  EXPECT_EQ(reason(axes + "1,5 500,5\n3,5 4,5\n"),
            "lamp.ies:9: 4 words more than the 4 candela values, and commas stand between digits: a comma separates "
            "numbers here, decimals are written with a point");
  EXPECT_TRUE(read(axes + "1,500\n3,4\n").ok()) << "as many as there are nodes";
}

TEST(Lm63, DamagedFilesDoNotCrash) {
  std::mt19937 random(7);
  for (std::size_t length = 0; length < kTypeA.size(); ++length) (void)read(kTypeA.substr(0, length)).ok();
  for (int round = 0; round < 500; ++round) {
    std::string text = kTypeA;
    for (int k = 0; k < 4; ++k) text[random() % text.size()] = static_cast<char>(random() % 256);
    const auto table = read(text);
    if (table.ok()) {
      EXPECT_EQ(table->candela.size(), table->first_deg.size() * table->second_deg.size());
      EXPECT_GE(table->intensity_cd({1, 0.1, 0.05}), 0.0);
    }
  }
}

// Constant 1 cd: the flux is the solid angle, which has a closed form for each type.
TEST(Flux, OfConstantTablesIsTheSolidAngle) {
  constexpr double kPi = std::numbers::pi;
  const double h = 60 * kPi / 180, v = 30 * kPi / 180;
  const auto flux = [](const std::string& type, const std::string& angles) {
    const auto table = read(kHead + "1 -1 1 2 2 " + type + " 2 0 0 0\n1 1 0\n" + angles + "1 1 1 1\n");
    return table.ok() ? table->flux_lm() : -1.0;
  };
  EXPECT_NEAR(flux("3", "-30 30\n-60 60\n"), 2 * h * 2 * std::sin(v), 1e-14);
  EXPECT_NEAR(flux("2", "-30 30\n-60 60\n"), 2 * v * 2 * std::sin(h), 1e-14);
  EXPECT_NEAR(flux("1", "0 180\n0 360\n"), 4 * kPi, 1e-14);
  EXPECT_NEAR(flux("1", "0 30\n0 360\n"), 2 * kPi * (1 - std::cos(v)), 1e-14);
}

// I = γ in a cone: ∫ γ·sin γ = sin γ - γ·cos γ, in one cell and in narrow ones.
TEST(Flux, OfALinearTable) {
  const double end = 40 * std::numbers::pi / 180;
  const double expected = 2 * std::numbers::pi * (180 / std::numbers::pi) * (std::sin(end) - end * std::cos(end));
  IntensityTable table;
  table.type = PhotometricType::kC;
  table.first_deg = {0, 360};
  for (const int cells : {1, 7, 4000}) {
    table.second_deg.clear();
    table.candela.clear();
    for (int j = 0; j <= cells; ++j) {
      table.second_deg.push_back(40.0 * j / cells);
      table.candela.insert(table.candela.end(), 2, table.second_deg.back());
    }
    EXPECT_NEAR(table.flux_lm() / expected, 1.0, 1e-13) << cells;
  }
}

}  // namespace
}  // namespace phare
