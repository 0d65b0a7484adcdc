// unit: the adjuster of a mounted lamp, by cut-off and by hand; where a table ends on the road before the car.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "visual/photometry/bench/lamp_aim.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/bench/table_end.h"
#include "visual/photometry/readers/write_lamp.h"

namespace phare {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
// The cut-off is put on its line to 0.003° and found to 0.01° on the 0.05° rows of these lamps (docs/photometry.md).
constexpr double kAim_deg = 0.013;

const IntensityTable& sample(const std::string& file) {
  static const std::vector<SampleLamp> lamps = sample_lamps();
  for (const SampleLamp& lamp : lamps)
    if (lamp.file == file) return lamp.table;
  throw std::runtime_error(file);
}

class MountedLamp : public testing::Test {
 protected:
  MountedLamp() : folder_(std::filesystem::path(testing::TempDir()) / "phare_mounted_lamp") {
    std::filesystem::create_directories(folder_);
  }
  /// A source of that table as a file, its rows moved up by so much; those at the poles stay.
  SourceConfig source(IntensityTable table, LampFunction function, double up_deg = 0.0) {
    for (double& v : table.second_deg) v += std::abs(v) < 60.0 ? up_deg : 0.0;
    SourceConfig source;
    source.function = function;
    source.file = folder_ / (std::to_string(count_++) + ".ies");
    std::ofstream(source.file, std::ios::binary) << lm63_text(table);
    const Status read = tables_.add(source);
    EXPECT_TRUE(read.ok()) << (read ? "" : read.error().text());
    return source;
  }
  LampConfig lamp(std::vector<SourceConfig> sources, AimConfig aim, double height_m = 0.66) {
    return {"lamp", {3.45, 0.62, height_m}, std::move(sources), aim};
  }
  /// Of the lamp as it stands, by the rule's own scan.
  double cutoff_deg(const LampConfig& lamp, double h_deg) {
    const AimedSource light = tables_.aimed(lamp.sources.front());
    return find_cutoff(mounted_intensity(*light.table, light.car_from_lamp), h_deg).elevation_deg;
  }

  std::filesystem::path folder_;
  LampTables tables_;
  int count_ = 0;
};

constexpr AimConfig kByCutoff{AimConfig::Kind::kCutoff, 0.0};

TEST_F(MountedLamp, ALowBeamIsTurnedOntoTheRulesLineWhereverItWasFiled) {
  for (const double filed_deg : {-1.3, 0.0, 0.8}) {
    LampConfig low = lamp({source(sample("low_rht.ies"), LampFunction::kLow, filed_deg)}, kByCutoff);
    const LampAiming aiming = aim_lamp(low, tables_);
    ASSERT_TRUE(aiming.found);
    EXPECT_EQ(aiming.shape.side, CutoffSide::kRisesRight);
    const double line_deg = std::atan(-0.01) / kRadPerDeg;  // UN R48 6.2.6.1.2 below 0.8 m
    EXPECT_NEAR(cutoff_deg(low, -2.5), line_deg, kAim_deg) << filed_deg;
    EXPECT_NEAR(aiming.turned_deg, line_deg - filed_deg, 2.0 * kAim_deg);
    EXPECT_NEAR(low.sources.front().pitch_rad, aiming.turned_deg * kRadPerDeg, 1e-12);
    EXPECT_TRUE(aiming.within());
    EXPECT_NE(aiming.text().find("for right-hand traffic; turned by"), std::string::npos) << aiming.text();
    EXPECT_NE(aiming.text().find("UN R48 6.2.6.1.2 asks -1.0 to -1.5 %"), std::string::npos) << aiming.text();
    // Used up: aimed again, it stays.
    EXPECT_EQ(low.aim, AimConfig{});
    EXPECT_EQ(aim_lamp(low, tables_).turned_deg, 0.0);
  }
}

TEST_F(MountedLamp, LeftHandTrafficIsScannedOnItsOwnFlatSide) {
  LampConfig low = lamp({source(sample("led_low_lht.ies"), LampFunction::kLow, 0.4)}, kByCutoff);
  const LampAiming aiming = aim_lamp(low, tables_);
  EXPECT_EQ(aiming.shape.side, CutoffSide::kRisesLeft);
  EXPECT_NEAR(cutoff_deg(low, 2.5), degrees_of_percent(-1.0), kAim_deg);
  EXPECT_NE(aiming.text().find("for left-hand traffic"), std::string::npos) << aiming.text();
}

TEST_F(MountedLamp, TheLineFollowsBeamAndHeight) {
  const SourceConfig low = source(sample("low_rht.ies"), LampFunction::kLow);
  const SourceConfig fog = source(sample("fog.ies"), LampFunction::kFog);
  LampConfig truck = lamp({low}, kByCutoff, 1.1), front = lamp({fog}, kByCutoff, 0.35);
  EXPECT_NEAR(aim_lamp(truck, tables_).after_deg, degrees_of_percent(-1.5), kAim_deg);
  EXPECT_NEAR(aim_lamp(front, tables_).after_deg, degrees_of_percent(-2.0), kAim_deg);
  LampConfig steep = lamp({low}, {AimConfig::Kind::kTurned, -2.0 * kRadPerDeg});
  const LampAiming aiming = aim_lamp(steep, tables_);
  EXPECT_NEAR(aiming.after_deg, -2.0, kAim_deg);
  EXPECT_FALSE(aiming.within()) << "-3.5 %";
}

TEST_F(MountedLamp, OneAdjusterTurnsTheHighBeamWithTheLow) {
  LampConfig both =
      lamp({source(sample("low_rht.ies"), LampFunction::kLow, 0.3), source(sample("high.ies"), LampFunction::kHigh)},
           kByCutoff);
  const LampAiming aiming = aim_lamp(both, tables_);
  EXPECT_EQ(both.sources[0].pitch_rad, both.sources[1].pitch_rad);
  EXPECT_NEAR(both.sources[1].pitch_rad, aiming.turned_deg * kRadPerDeg, 1e-12);
}

TEST_F(MountedLamp, WithoutACutoffItStaysAsFiled) {
  LampConfig high = lamp({source(sample("high.ies"), LampFunction::kHigh)}, kByCutoff);
  const LampAiming of_high = aim_lamp(high, tables_);
  EXPECT_FALSE(of_high.found);
  EXPECT_EQ(high.sources.front().pitch_rad, 0.0);
  IntensityTable even = sample("high.ies");  // no edge anywhere
  std::fill(even.candela.begin(), even.candela.end(), 1000.0);
  LampConfig plain = lamp({source(even, LampFunction::kLow)}, kByCutoff);
  const LampAiming of_plain = aim_lamp(plain, tables_);
  EXPECT_FALSE(of_plain.found);
  EXPECT_EQ(plain.sources.front().pitch_rad, 0.0);
  EXPECT_EQ(of_plain.text(), "no cut-off found: aimed as filed");
}

/// Even light on a grid with these limits.
IntensityTable even_table(double h_deg, double lowest_v_deg, double cd) {
  IntensityTable table;
  table.first_deg = {-h_deg, 0.0, h_deg};
  table.second_deg = {lowest_v_deg, 0.0, 10.0};
  table.candela.assign(9, cd);
  return table;
}
const ChannelConfig kWindow{"front", 1280, 720, 70.0 * kRadPerDeg, {1.45, 0.37, 1.22}, 0.0, 0.0};
const glm::dvec3 kPlace{3.45, 0.62, 0.66};

std::optional<TableEnd> end_of(const IntensityTable& table, double pitch_deg) {
  return table_end(table, aim_rotation(0.0, pitch_deg * kRadPerDeg, 0.0), 1.0, kPlace, {&kWindow, 1});
}

TEST(TableEnd, TheNearRoadOutsideTheTable) {
  const auto as_filed = end_of(even_table(80.0, -15.0, 1000.0), 0.0);
  ASSERT_TRUE(as_filed);
  EXPECT_TRUE(as_filed->below);
  EXPECT_FALSE(as_filed->sideways);
  // Edges are found to 0.01°; at 15° that is 2 mm of road.
  EXPECT_NEAR(as_filed->v_deg, -15.0, 0.011);
  EXPECT_NEAR(as_filed->nearest_road_m, 0.66 / std::tan(15.0 * kRadPerDeg), 0.003);
  EXPECT_EQ(as_filed->text(), "table ends at V -15.0°: the road nearer than 2.5 m ahead is outside it");
  // 1,000 cd meet the road at 15° at a distance of 0.66 m / sin 15°; straight ahead it is brightest but for rounding.
  EXPECT_NEAR(as_filed->brightest_lx, 1000.0 * std::pow(std::sin(15.0 * kRadPerDeg), 3) / (0.66 * 0.66), 0.2);

  const auto turned = end_of(even_table(80.0, -15.0, 1000.0), -0.573);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->v_deg, -15.0, 0.02) << "the lamp's own angle";
  EXPECT_NEAR(turned->nearest_road_m, 0.66 / std::tan(15.573 * kRadPerDeg), 0.003);
}

TEST(TableEnd, NothingToTellWhereItIsDarkOrOutOfThePicture) {
  EXPECT_FALSE(end_of(even_table(80.0, -70.0, 1000.0), 0.0)) << "below the picture";
  EXPECT_FALSE(end_of(even_table(80.0, -15.0, 2.0), 0.0)) << "0.08 lx";
  EXPECT_TRUE(end_of(even_table(80.0, -15.0, 3.0), 0.0)) << "0.12 lx";
  EXPECT_FALSE(table_end(even_table(80.0, -15.0, 1000.0), glm::dmat3{1.0}, 1.0, kPlace, {})) << "no window";
}

TEST(TableEnd, SidewaysToo) {
  const auto narrow = end_of(even_table(20.0, -70.0, 1000.0), 0.0);
  ASSERT_TRUE(narrow);
  EXPECT_FALSE(narrow->below);
  EXPECT_TRUE(narrow->sideways);
  EXPECT_NEAR(narrow->left_deg, -20.0, 0.011);
  EXPECT_NEAR(narrow->right_deg, 20.0, 0.011);
  EXPECT_EQ(narrow->text(), "table ends at H -20° and +20°: the road beside that is outside it");
  // To the right it ends in the dark: that end takes no light from anybody, and is not told.
  IntensityTable left = even_table(20.0, -70.0, 1000.0);
  for (const std::size_t dark : {2u, 5u, 8u}) left.candela[dark] = 0.0;
  const auto one = end_of(left, 0.0);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->text(), "table ends at H -20°: the road beside that is outside it");
}

/// The lower edge of a flat screen, and of a type B table, rises to the sides: its end there is none to the side.
TEST(TableEnd, TheLowerEdgeIsNoSide) {
  const double aside_deg = std::atan(12.0 / 25.0) / kRadPerDeg;
  IntensityTable screen = even_table(aside_deg, std::atan(-5.0 / 25.0) / kRadPerDeg, 1e4);
  screen.screen_distance_m = 25.0;
  IntensityTable type_b = even_table(40.0, -14.0, 1e4);
  type_b.type = PhotometricType::kB;
  for (const double pitch_deg : {0.0, -0.8}) {
    const auto of_screen = end_of(screen, pitch_deg);
    ASSERT_TRUE(of_screen);
    EXPECT_TRUE(of_screen->below);
    EXPECT_NEAR(of_screen->right_deg, aside_deg, 0.02);
    EXPECT_NEAR(of_screen->left_deg, -aside_deg, 0.02);
    const auto of_b = end_of(type_b, pitch_deg);
    ASSERT_TRUE(of_b);
    EXPECT_TRUE(of_b->below);
    EXPECT_FALSE(of_b->sideways && of_b->right_deg < 40.0) << "told at H " << of_b->right_deg;
  }
}

/// A TM-33 file of segments, each with a peak of its own.
std::string matrix_file(int segments) {
  std::string text = "<IESTM33-22>\n";
  for (int segment = 1; segment <= segments; ++segment) {
    text += "<Emitter><LuminousData><PhotometryType>A</PhotometryType><SymmType>None</SymmType>\n";
    for (const int h : {-1, 1}) {
      for (const int v : {-1, 0})
        text += "<IntensityData horz=\"" + std::to_string(h) + "\" vert=\"" + std::to_string(v) + "\">" +
                std::to_string(100 * segment) + "</IntensityData>\n";
    }
    text += "</LuminousData></Emitter>\n";
  }
  return text + "</IESTM33-22>\n";
}

TEST_F(MountedLamp, AFileOfManySegmentsIsReadOnceForAllOfThem) {
  const std::filesystem::path file = folder_ / "matrix.xml";
  std::ofstream(file, std::ios::binary) << matrix_file(3);
  SourceConfig source;
  source.file = file;
  const auto add = [&](std::size_t emitter) {
    source.emitter = emitter;
    const Status read = tables_.add(source);
    EXPECT_TRUE(read.ok()) << (read ? "" : read.error().text());
  };
  add(1);
  const IntensityTable alone = *read_lamp(file, read_settings(source));
  std::ofstream(file, std::ios::binary) << "not read again";
  for (const std::size_t emitter : {2u, 3u}) {
    add(emitter);
    EXPECT_EQ(tables_.of(source).peak_cd(), 100.0 * static_cast<double>(emitter));
    EXPECT_EQ(tables_.of(source).content_hash, alone.content_hash);
    EXPECT_EQ(tables_.of(source).name, alone.name);
    EXPECT_EQ(tables_.of(source).first_deg, alone.first_deg);
  }
  source.emitter = 4;
  const Status none = tables_.add(source);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().text().find("emitter 4 was asked for, the file has 3"), std::string::npos);
  tables_.close();
  source.emitter = 3;
  source.mirror = true;  // another reading of it: the file as it is now
  EXPECT_FALSE(tables_.add(source).ok());
}

}  // namespace
}  // namespace phare
