// The kink of a cut-off and the alignment of two: beams turned by known angles, every rise, the reference files.
#include "visual/photometry/bench/cutoff_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "photometry_test_files.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

const IntensityTable& own_lamp(const std::string& file) {
  static const std::vector<SampleLamp> lamps = sample_lamps();
  for (const SampleLamp& lamp : lamps) {
    if (lamp.file == file) return lamp.table;
  }
  ADD_FAILURE() << file;
  return lamps.front().table;
}

/// The table with its angles moved: an exact copy of the beam, turned (sideways exactly, upwards near the axis).
IntensityTable moved(IntensityTable table, double right_deg, double up_deg) {
  for (double& h : table.first_deg) h += right_deg;
  for (double& v : table.second_deg) v += up_deg;
  return table;
}

CutoffShape shape_of(const IntensityTable& table) {
  return cutoff_shape(mounted_intensity(table, glm::dmat3{1.0}));
}

CutoffAlignment align(const IntensityTable& a, const IntensityTable& b) {
  return align_cutoffs(a, b, shape_of(a), shape_of(b));
}

/// A cut-off that follows `line(h)`, 0.1° by 0.05°.
template <typename Line>
IntensityTable beam(const Line& line) {
  IntensityTable table;
  for (int i = -150; i <= 150; ++i) table.first_deg.push_back(i / 10.0);
  for (int j = -120; j <= 80; ++j) table.second_deg.push_back(j / 20.0);
  for (const double v : table.second_deg) {
    for (const double h : table.first_deg)
      table.candela.push_back(100.0 * std::pow(150.0, 1.0 / (1.0 + std::exp((v - line(h)) / 0.1))));
  }
  return table;
}

// A scan finds the inflection to about 0.005° (cutoff.h). On a rise of 15° that is 0.005/tan 15° = 0.02° sideways for
// one scan; the place of the kink rests on fifty.
constexpr double kSideways_deg = 0.02;
constexpr double kUpward_deg = 0.006;

TEST(Kink, GoesWithTheBeam) {
  for (const char* file : {"low_rht.ies", "led_low_rht.ies", "low_lht.ies"}) {
    const CutoffShape filed = shape_of(own_lamp(file));
    EXPECT_NEAR(filed.kink_h_deg, 0.0, 0.1) << file;  // rounded over 0.1 to 0.15° by the lamp's formula
    for (const double right : {-2.5, -1.5, -0.5, 1.0, 2.0}) {
      const CutoffShape shape = shape_of(moved(own_lamp(file), right, 0.0));
      EXPECT_EQ(shape.side, filed.side) << file << " " << right;
      EXPECT_NEAR(shape.kink_h_deg - filed.kink_h_deg, right, 2 * kSideways_deg) << file << " " << right;
      EXPECT_NEAR(shape.flat_v_deg, filed.flat_v_deg, kUpward_deg) << file << " " << right;
    }
  }
}

TEST(Kink, OfEveryRise) {
  for (const double foot : {-1.5, 0.7}) {
    for (const double degrees : {10.0, 15.0, 30.0}) {
      const double rise = std::tan(degrees * 3.14159265358979 / 180.0);
      const CutoffShape shape = shape_of(beam([&](double h) { return -0.5 + rise * std::max(0.0, h - foot); }));
      EXPECT_EQ(shape.side, CutoffSide::kRisesRight) << foot << " " << degrees;
      EXPECT_NEAR(shape.kink_h_deg, foot, 0.06) << degrees;  // columns 0.1° apart: the kink lies between two
      EXPECT_NEAR(shape.rise_deg, degrees, 1.0) << foot;
    }
    // 45° to a shoulder, and what SAE calls VOR: the same step seen from its upper side.
    for (const double top : {0.5, 0.75, 1.2}) {
      const CutoffShape right = shape_of(beam([&](double h) { return std::clamp(h - foot, 0.0, top) - top; }));
      EXPECT_EQ(right.side, CutoffSide::kRisesRight) << foot << " " << top;
      EXPECT_NEAR(right.kink_h_deg, foot, 0.1) << top;
      EXPECT_GT(right.rise_deg, 30.0) << top;
      const CutoffShape left = shape_of(beam([&](double h) { return std::clamp(-h + foot, 0.0, top); }));
      EXPECT_EQ(left.side, CutoffSide::kRisesLeft) << foot << " " << top;
      EXPECT_NEAR(left.kink_h_deg, foot, 0.1) << top;
    }
  }
  EXPECT_FALSE(find_kink(mounted_intensity(beam([](double) { return -0.57; }), glm::dmat3{1.0})).found);
  EXPECT_FALSE(find_kink(mounted_intensity(beam([](double h) { return 0.05 * h; }), glm::dmat3{1.0})).found);
  EXPECT_FALSE(find_kink(mounted_intensity(own_lamp("fog.ies"), glm::dmat3{1.0})).found);
  EXPECT_FALSE(find_kink(mounted_intensity(own_lamp("high.ies"), glm::dmat3{1.0})).found);
}

TEST(Alignment, UndoesATurn) {
  for (const char* file : {"low_rht.ies", "led_low_rht.ies"}) {
    for (const double right : {-2.0, -1.2, 0.5, 1.5}) {
      for (const double up : {0.0, 1.0}) {
        const CutoffAlignment turn = align(own_lamp(file), moved(own_lamp(file), right, up));
        EXPECT_TRUE(turn.aligned && turn.right_known) << file << " " << right << " " << up;
        // Light about the cut-off places a copy better than scans do. Both moves at once are no turn: right·up of roll
        // over 57°, 2.5° off the kink on a 15° rise.
        EXPECT_NEAR(turn.right_deg, -right, 0.1 * kSideways_deg + 0.01 * std::abs(right * up))
            << file << " " << right << " " << up;
        // Moved angles are a turn only near the axis: 5° aside by 1° · (1 - cos 5°).
        EXPECT_NEAR(turn.up_deg, -up, kUpward_deg + 0.004 * std::abs(up)) << file << " " << right << " " << up;
        EXPECT_LT(turn.apart_deg, 0.01) << file << " " << right << " " << up;
      }
    }
  }
  const auto step = [](double foot) { return beam([=](double h) { return std::clamp(h - foot, 0.0, 0.75); }); };
  for (const double foot : {-1.0, 0.3, 1.0}) {
    const CutoffAlignment turn = align(step(0.0), step(foot));
    EXPECT_TRUE(turn.right_known) << foot;
    EXPECT_NEAR(turn.right_deg, -foot, kSideways_deg) << foot;
  }
}

// Different beams whose formulas have their kinks at H = V = 0: nothing to turn.
TEST(Alignment, DifferentBeamsByTheirLines) {
  const CutoffAlignment turn = align(own_lamp("low_rht.ies"), own_lamp("led_low_rht.ies"));
  EXPECT_NEAR(turn.right_deg, 0.0, kSideways_deg);
  EXPECT_NEAR(turn.up_deg, 0.0, kUpward_deg);
}

TEST(Alignment, SaysWhatItDoesNotKnow) {
  const auto flat = [](double v) { return beam([=](double) { return v; }); };
  const CutoffAlignment turn = align(flat(-0.5), moved(flat(0.2), 1.0, 0.0));
  EXPECT_TRUE(turn.aligned);
  EXPECT_FALSE(turn.right_known);
  EXPECT_EQ(turn.right_deg, 0.0);
  EXPECT_NEAR(turn.up_deg, -0.7, kUpward_deg);
  EXPECT_FALSE(align(own_lamp("low_rht.ies"), own_lamp("high.ies")).aligned);
  EXPECT_TRUE(align(own_lamp("low_rht.ies"), own_lamp("low_lht.ies")).other_side);
}

// One beam in every format of the reference set: nothing to turn, within what the coarser files resolve.
TEST(Alignment, OneBeamInEveryFormat) {
  PHARE_NEEDS_SHARED_DATA("photometry-reference/photometry");
  const auto folder = test::shared_data("photometry-reference/photometry");
  const auto a = read_lamp(folder / "low_A.ies");
  ASSERT_TRUE(a.ok()) << a.error().text();
  for (const char* name : {"low_B.ies", "low_C_axis.ies", "low.ldt", "low_gonio25m.csv", "low_wall25m.csv"}) {
    if (!std::filesystem::exists(folder / name)) continue;
    const auto b = read_lamp(folder / name);
    ASSERT_TRUE(b.ok()) << b.error().text();
    const CutoffAlignment turn = align(*a, *b);
    std::printf("%-18s up %+.4f, right %+.4f%s, apart %.4f deg\n", name, turn.up_deg, turn.right_deg,
                turn.right_known ? "" : " (not known)", turn.apart_deg);
    // A tenth of the rows, and what that is on a 15° rise.
    const double row_deg = std::max(0.05, turn.up_open_deg);
    EXPECT_NEAR(turn.up_deg, 0.0, 0.1 * row_deg) << name;
    EXPECT_NEAR(turn.right_deg, 0.0, 0.1 * row_deg / std::tan(0.26)) << name;
  }
}

}  // namespace
}  // namespace phare
