// unit: the point that is read lamp by lamp, the road's coordinates, grid, isolux lines, scale, reach and probes.csv.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/visual_process/ground_square.h"
#include "visual/process/cameras.h"
#include "visual/process/overlay_lines.h"
#include "visual/process/picture_instruments.h"
#include "visual/process/probe_plot.h"

namespace phare {
namespace {

constexpr double kRad = 3.14159265358979323846 / 180.0;

/// 10,000 cd everywhere within 30 degrees to the sides, from 10 degrees below to 2 above.
std::filesystem::path even_beam() {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "measuring_even.ies";
  std::ofstream(file) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n"
                         "-10 2\n-30 30\n10000 10000\n10000 10000\n";
  return file;
}

class Measuring : public testing::Test {
 protected:
  Measuring() : scene_(ground_square(0.0, "road_test")), lamps_(std::move(*Lamps::load(rig()))) {
    scene_.materials[0].name = "asphalt";
    scene_.materials[0].reflectance = glm::vec3(0.1f);
    car_.z_m = 2.0;  // the ground lies at z = 2
    shine(LightSwitch::kLow);
  }
  static Rig rig() {
    Rig rig;
    const auto lamp = [&](const char* name, double y_m, LampFunction function) {
      LampConfig config{.name = name, .position_m = {3.0, y_m, 0.7}, .sources = {}};
      SourceConfig source;
      source.file = even_beam();
      source.function = function;
      config.sources = {source};
      return config;
    };
    rig.designs.push_back({"one",
                           {lamp("low left", 0.6, LampFunction::kLow), lamp("low right", -0.6, LampFunction::kLow),
                            lamp("high", 0.0, LampFunction::kHigh)}});
    return rig;
  }
  void shine(LightSwitch light) {
    CockpitState controls;
    controls.light_switch = light;
    lamps_.set_controls(controls);
  }
  MeasurePoint on_ground(double x_m, double y_m) const { return {{x_m, y_m, 2.0}, {0.0, 0.0, 1.0}}; }
  PointReading read(const MeasurePoint& at) const {
    return read_point(lamps_, car_, at, {1.4, 0.4, 3.2}, scene_, RoadLine(), true);
  }
  /// A board of 2 m x 2 m across the road, as a node of its own.
  void stand_board(double x_m) {
    SceneChunk chunk = scene_.chunks[0];
    chunk.node = "board";
    chunk.first_vertex = static_cast<std::uint32_t>(scene_.vertices.size());
    chunk.first_index = static_cast<std::uint32_t>(scene_.indices.size());
    for (const glm::vec3 corner : {glm::vec3{0, -1, 0}, {0, 1, 0}, {0, 1, 2}, {0, -1, 2}})
      scene_.vertices.push_back({corner, {-1, 0, 0}});
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) scene_.indices.push_back(index);
    chunk.origin_m = {x_m, 0.0, 2.0};
    chunk.low_m = {x_m, -1.0, 2.0}, chunk.high_m = {x_m, 1.0, 4.0};
    scene_.chunks.push_back(chunk);
  }

  Scene scene_;
  World world_{scene_};
  Lamps lamps_;
  VehicleState car_;
  Desk desk_;
};

TEST_F(Measuring, APointIsReadAsTheLawsHaveIt) {
  const PointReading reading = read(on_ground(23.0, 0.6));
  // From the left lamp straight ahead: 20 m away, 0.7 m below.
  const double r2 = 400.0 + 0.49, r = std::sqrt(r2);
  ASSERT_EQ(reading.lamps.size(), 3u);
  const LampReading& left = reading.lamps[0];
  EXPECT_EQ(left.why, WhyDark::kLit);
  EXPECT_NEAR(left.candela, 10000.0, 1e-9);
  EXPECT_NEAR(left.distance_m, r, 1e-12);
  EXPECT_NEAR(left.h_deg, 0.0, 1e-12);
  EXPECT_NEAR(left.v_deg, -std::asin(0.7 / r) / kRad, 1e-9);
  EXPECT_NEAR(left.facing_lx, 10000.0 / r2, 1e-9);
  EXPECT_NEAR(left.surface_lx, 10000.0 / r2 * 0.7 / r, 1e-9);
  EXPECT_NEAR(left.horizontal_lx, left.surface_lx, 1e-12);
  EXPECT_NEAR(left.vertical_lx, 10000.0 / r2 * 20.0 / r, 1e-9);
  EXPECT_NEAR(reading.lamps[1].h_deg, -std::atan2(1.2, 20.0) / kRad, 1e-9) << "left of the right lamp's axis";
  EXPECT_EQ(reading.lamps[2].why, WhyDark::kOff);
  EXPECT_NEAR(reading.surface_lx, lamps_.illuminance_lx(car_, on_ground(23.0, 0.6)), 1e-12);
  EXPECT_NEAR(reading.luminance_cdm2, 0.1f * reading.surface_lx / M_PI, 1e-7) << "float32 of the reflectance";
  EXPECT_EQ(reading.node, "road_test");
  EXPECT_EQ(reading.material, "asphalt");
  EXPECT_NEAR(reading.car_m.x, 23.0, 1e-12);
  EXPECT_NEAR(reading.car_m.z, 0.0, 1e-12);
}

// Under snow lux are the same, and luminance is snow's: rough ground of its reflectance, whatever lies below.
TEST_F(Measuring, SnowChangesLuminanceAndNotLux) {
  const MeasurePoint at = on_ground(23.0, 0.6);
  const auto under = [&](double cover_01) {
    return read_point(lamps_, car_, at, {1.4, 0.4, 3.2}, scene_, RoadLine(), true, nullptr, cover_01);
  };
  const PointReading flat = under(0.0), flat_snow = under(1.0);
  EXPECT_EQ(flat_snow.surface_lx, flat.surface_lx);
  const double snow = 0.2126 * 0.80 + 0.7152 * 0.82 + 0.0722 * 0.85;  // as surfaces.toml has it
  // The lamp's light is warm, which moves the mean toward red's 0.80 by less than the 0.02 between red and green.
  EXPECT_NEAR(flat_snow.luminance_cdm2 / flat.luminance_cdm2, snow / 0.1, 0.2);
  scene_.materials[0].retro = *retroreflection("upright facets", std::nullopt, std::nullopt);
  const PointReading rough = under(0.0), half = under(0.5), rough_snow = under(1.0);
  EXPECT_NEAR(rough_snow.luminance_cdm2 / rough.luminance_cdm2, flat_snow.luminance_cdm2 / flat.luminance_cdm2, 1e-5);
  EXPECT_NEAR(half.luminance_cdm2, 0.5 * (rough.luminance_cdm2 + rough_snow.luminance_cdm2), 1e-6);
  scene_.materials[0].retro = *retroreflection("EN 1436 R4", std::nullopt, std::nullopt);
  EXPECT_NEAR(under(1.0).luminance_cdm2, rough_snow.luminance_cdm2, 1e-6) << "a marking is hidden";
}

// What rough ground sends back belongs to what the eye sees of it, lamp by lamp; lux stay.
TEST_F(Measuring, LuminanceHasWhatGroundSendsBack) {
  const MeasurePoint at = on_ground(23.0, 0.6);
  const PointReading flat = read(at);
  EXPECT_EQ(flat.sent_back_cdm2, 0.0);
  scene_.materials[0].retro.kind = RetroKind::kFacets;
  const PointReading rough = read(at);
  EXPECT_EQ(rough.surface_lx, flat.surface_lx);
  const glm::dvec3 to_eye = glm::normalize(glm::dvec3(1.4, 0.4, 3.2) - at.position_m);
  double expected = 0.0;
  for (const double y_m : {0.6, -0.6}) {
    const glm::dvec3 way = glm::dvec3(3.0, y_m, 0.7) + glm::dvec3(car_.x_m, car_.y_m, car_.z_m) - at.position_m;
    const glm::dvec3 to_lamp = glm::normalize(way);
    // Its own reflectance times (l·v - cos cos)·min(1, cos/cos), white light.
    expected += 0.1 / M_PI * 10000.0 / glm::dot(way, way) * (glm::dot(to_lamp, to_eye) - to_lamp.z * to_eye.z) *
                std::min(to_lamp.z / to_eye.z, 1.0);
  }
  EXPECT_NEAR(rough.sent_back_cdm2 / expected, 1.0, 1e-5) << "float32 of cosines near grazing";
  EXPECT_NEAR(rough.luminance_cdm2, flat.luminance_cdm2 + rough.sent_back_cdm2, 1e-12);
}

TEST_F(Measuring, ADarkPointSaysWhy) {
  const auto why = [&](const MeasurePoint& at) { return read(at).lamps[0].why; };
  EXPECT_EQ(why(on_ground(-5.0, 0.0)), WhyDark::kBehindLamp);
  EXPECT_EQ(why(on_ground(4.0, 0.6)), WhyDark::kOutOfTable) << "35 degrees below";
  EXPECT_EQ(why({{23.0, 0.6, 2.0}, {0.0, 0.0, -1.0}}), WhyDark::kFacesAway);
  shine(LightSwitch::kOff);
  EXPECT_EQ(why(on_ground(23.0, 0.6)), WhyDark::kOff);
  shine(LightSwitch::kLow);
  stand_board(12.0);
  const PointReading hidden = read(on_ground(23.0, 0.6));
  EXPECT_EQ(hidden.lamps[0].why, WhyDark::kHidden);
  EXPECT_EQ(hidden.lamps[0].hidden_by, "board");
  EXPECT_EQ(hidden.surface_lx, 0.0);
  const std::vector<std::string> lines = lines_of(hidden);
  EXPECT_NE(lines[2].find("low left: dark, hidden by board (0.8734 lx); 10000 cd at H"), std::string::npos) << lines[2];
  EXPECT_EQ(lines.back(), "  high: dark, off");
}

/// A lane along x to 100 m, then along y.
std::vector<LanePoint> bent_lane() {
  std::vector<LanePoint> lane;
  for (int i = 0; i <= 10; ++i) lane.push_back({10.0 * i, 10.0 * i, 0.0, 2.0, 0.0, 0.0});
  for (int i = 1; i <= 5; ++i) lane.push_back({100.0 + 10.0 * i, 100.0, 10.0 * i, 2.0, M_PI / 2.0, 0.0});
  return lane;
}

TEST(RoadLine, TurnsPlacesOfTheRoadIntoTheWorldAndBack) {
  const RoadLine road(bent_lane(), "");
  const MeasurePoint point = road.at({42.0, -1.75});
  EXPECT_NEAR(point.position_m.x, 42.0, 1e-12);
  EXPECT_NEAR(point.position_m.y, -1.75, 1e-12);
  EXPECT_NEAR(point.position_m.z, 2.0, 1e-12);
  for (const RoadLine::Place& place : {RoadLine::Place{42.0, 3.0}, {130.0, -2.0}, {-7.0, 1.0}, {170.0, 0.5}}) {
    const auto back = road.place_of(road.at(place).position_m);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->s_m, place.s_m, 1e-9);
    EXPECT_NEAR(back->lateral_m, place.lateral_m, 1e-9);
  }
  EXPECT_FALSE(RoadLine().place_of({1.0, 2.0, 3.0})) << "no lane";
  VehicleState car;
  car.x_m = 95.0, car.y_m = 0.5, car.z_m = 2.0;
  EXPECT_NEAR(road.ahead_of(car)(20.0, 0.0).position_m.y, 15.0, 1e-9) << "round the bend";
  car.y_m = 40.0, car.x_m = 50.0;
  EXPECT_NEAR(road.ahead_of(car)(20.0, 1.0).position_m.x, 70.0, 1e-9) << "away from the road, straight on";
  // Probes of the road.
  const Probe probe{Probe::Frame::kRoad, {42.0, -1.75, 1.5}};
  EXPECT_NEAR(placed(probe, car, road)->position_m.z, 3.5, 1e-12);
  EXPECT_FALSE(placed(probe, car, RoadLine()));
}

TEST_F(Measuring, ReachIsWhereTheLevelEnds) {
  // E = 2·I·h/r³ on the axis between the lamps, up to their sides: 5 lx of 20000·0.7/r³ at 14.1 m from the lamps.
  const std::vector<Reach> reach = reach_of(lamps_, car_, RoadLine());
  ASSERT_EQ(reach.size(), 3u);
  const double expected_m = 3.0 + std::sqrt(std::pow(2.0 * 10000.0 * 0.7 / 3.0, 2.0 / 3.0) - 0.49 - 1.15 * 1.15 * 0.5);
  // The lamps stand 1.15 and 2.35 m beside the edge: r differs by 0.1 m between them.
  EXPECT_NEAR(reach[1].left_m, expected_m, 0.3);
  EXPECT_NEAR(reach[1].left_m, reach[1].right_m, 1e-9);
  EXPECT_GT(reach[0].left_m, reach[1].left_m);
  const double at_m = reach[1].left_m;
  EXPECT_GE(lamps_.illuminance_lx(car_, on_ground(at_m, kLaneEdge_m)), 3.0);
  EXPECT_LT(lamps_.illuminance_lx(car_, on_ground(at_m + 0.1, kLaneEdge_m)), 3.0);
  shine(LightSwitch::kOff);
  EXPECT_EQ(reach_of(lamps_, car_, RoadLine())[0], (Reach{1.0, 0.0, 0.0}));
  EXPECT_EQ(reach_line({{1.0, 74.2, 96.0}, {3.0, 51.0, 70.4}}), "reach left/right: 1 lx 74/96 m, 3 lx 51/70 m");
}

TEST_F(Measuring, EveryPointOfAnIsoluxLineHasItsLevel) {
  const RoadMarks marks = isolux_marks(lamps_, car_, RoadLine(), {3.0});
  ASSERT_GT(marks.lines.size(), 50u);
  ASSERT_EQ(marks.labels.size(), 1u);
  EXPECT_EQ(marks.labels[0].text, "3 lx");
  for (const RoadMarks::Line& line : marks.lines)
    for (const glm::dvec3& p : line.points_m) {
      const double lx = lamps_.illuminance_lx(car_, {{p.x, p.y, car_.z_m}, {0.0, 0.0, 1.0}});
      // Nodes 0.5 m apart to the side and 5 % of the distance ahead, log E straight between: E ~ r^-3 bends by
      // h²/8·3/r², below 1 % from 4 m on. At the beam's hard edges, where E jumps, a line stands between the nodes.
      if (p.x > 8.0 && std::abs(p.y) < 0.5 * (p.x - 4.0)) {
        EXPECT_NEAR(lx, 3.0, 0.05) << p.x << " " << p.y;
      }
    }
}

TEST(PictureMarks, AnInsetIsKeptClearOfLinesAndLabels) {
  const PicturePart inset{0.25, 0.25, 0.5, 0.5};
  OverlayMarks picture;
  picture.lines = {{0.0, 0.5, 1.0, 0.5, {}},   // through it
                   {0.5, 0.5, 0.5, 1.0, {}},   // out of it
                   {0.3, 0.3, 0.7, 0.7, {}},   // within
                   {0.0, 0.1, 1.0, 0.1, {}},   // above
                   {0.0, 0.8, 0.2, 1.0, {}}};  // past a corner
  picture.labels = {{0.5, 0.5, "10 m", {}}, {0.1, 0.1, "20 m", {}}, {0.9, 0.5, "30 m", {}}};
  keep_clear(picture, inset);
  const auto line = [](double x0, double y0, double x1, double y1) { return std::array{x0, y0, x1, y1}; };
  std::vector<std::array<double, 4>> left;
  for (const OverlayMarks::Line& one : picture.lines) left.push_back(line(one.x0_01, one.y0_01, one.x1_01, one.y1_01));
  EXPECT_EQ(left, (std::vector{line(0.0, 0.5, 0.25, 0.5), line(0.75, 0.5, 1.0, 0.5), line(0.5, 0.75, 0.5, 1.0),
                               line(0.0, 0.1, 1.0, 0.1), line(0.0, 0.8, 0.2, 1.0)}));
  ASSERT_EQ(picture.labels.size(), 2u);
  EXPECT_EQ(picture.labels[0].text, "20 m");
  EXPECT_EQ(picture.labels[1].text, "30 m");
}

// The plot's box hides what lies under it: lines and labels of the road end there.
TEST(PictureMarks, ThePlotKeepsItsBoxClear) {
  ProbePlot plot;
  plot.add({}, {1.0});
  OverlayMarks alone;
  plot.draw(alone, 1);
  ASSERT_EQ(alone.boxes.size(), 1u);
  const OverlayMarks::Box& box = alone.boxes.front();
  const double middle_01 = box.top_01 + 0.5 * box.height_01;
  OverlayMarks picture;
  picture.lines = {{0.0, middle_01, box.left_01 + 0.5 * box.width_01, middle_01, {}}};
  picture.labels = {{box.left_01 + 0.1, middle_01, "1 lx", {}}, {0.1, middle_01, "3 lx", {}}};
  plot.draw(picture, 1);
  ASSERT_EQ(picture.lines.size(), alone.lines.size() + 1);
  EXPECT_NEAR(picture.lines.front().x1_01, box.left_01, 1e-12);
  ASSERT_EQ(picture.labels.size(), alone.labels.size() + 1);
  EXPECT_EQ(picture.labels.front().text, "3 lx");
}

// The numbers of a scale stand close to where the other half begins.
TEST(PictureMarks, ALabelEndsWithItsText) {
  OverlayMarks picture;
  picture.labels = {{0.478, 0.5, "100", {}}, {0.478, 0.6, "a longer one", {}}};
  keep_clear(picture, {0.5, 0.0, 0.5, 1.0});
  ASSERT_EQ(picture.labels.size(), 1u);
  EXPECT_EQ(picture.labels[0].text, "100");
}

TEST_F(Measuring, MarksAreSeenWhereTheyLie) {
  Camera camera;
  camera.eye_m = {0.0, 0.0, 3.2};
  const ViewGeometry view(camera, 16.0 / 9.0);
  OverlayMarks picture;
  draw_marks(picture, grid_marks(car_, RoadLine(), 10.0), view);
  const auto label = std::ranges::find(picture.labels, "30 m", &OverlayMarks::Label::text);
  ASSERT_NE(label, picture.labels.end());
  // 30 m ahead, 2 m to the right, 1.2 m below the eye (less the 0.01 m that lines lie above): 60 degrees wide.
  const double half = std::tan(0.5 * camera.fov_horizontal_rad);
  EXPECT_NEAR(label->x_01, 0.5 + 0.5 * (2.0 / 30.0) / half, 1e-9);
  // The ground of a scene that has none lies at the car's height.
  EXPECT_NEAR(label->y_01, 0.5 + 0.5 * (1.19 / 30.0) / half * 16.0 / 9.0, 1e-9);
  // Far rows lie close together: no label on another, and the nearest has stayed.
  EXPECT_EQ(picture.labels.front().text, "10 m");
  EXPECT_LT(picture.labels.size(), 10u);
  for (std::size_t i = 0; i < picture.labels.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_TRUE(std::abs(picture.labels[i].x_01 - picture.labels[k].x_01) >= 0.04 ||
                  std::abs(picture.labels[i].y_01 - picture.labels[k].y_01) >= 0.025)
          << picture.labels[i].text << " on " << picture.labels[k].text;
  for (const OverlayMarks::Line& line : picture.lines)
    for (const double share : {line.x0_01, line.y0_01, line.x1_01, line.y1_01}) EXPECT_TRUE(std::isfinite(share));
  // What lies behind the eye is not drawn.
  camera.world_from_eye = glm::dmat3{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  OverlayMarks behind;
  draw_marks(behind, grid_marks(car_, RoadLine(), 10.0), ViewGeometry(camera, 16.0 / 9.0));
  EXPECT_EQ(behind.size(), 0u);
  OverlayMarks scale;
  draw_scale(scale, {0.1, 1.0, 30.0, 1000.0});
  EXPECT_EQ(scale.labels.size(), 3u) << "lux, 1 and 30: the others are beyond the colours";
}

TEST_F(Measuring, WhatIsOffCostsNothing) {
  PictureInstruments off(desk_, lamps_, world_, RoadLine(), ProbeLog(testing::TempDir(), false));
  const FrameInput picture;
  off.see({SimTime{0}, car_, &picture, 1.6});
  EXPECT_EQ(off.marks(true).size(), 0u) << "so there is no pass for them";
  EXPECT_TRUE(off.lines().empty());
  EXPECT_TRUE(off.log());
  EXPECT_EQ(off.answer(), "");
  EXPECT_EQ(off.work_done(), 0u);
  desk_.grid_m = 10.0;
  desk_.isolux = desk_.reach = true;
  EXPECT_GT(off.marks(true).size(), 0u);
  EXPECT_EQ(off.lines().size(), 1u);
  EXPECT_EQ(off.work_done(), 3u);
}

TEST_F(Measuring, TheLinesTellTheExposure) {
  const CockpitState controls;
  const EyeAdaptation eye(4000.0);
  const auto lines = [&] { return overlay_lines(desk_, lamps_, {.controls = controls, .pose = car_, .eye = eye}); };
  // 1 / 0.3 cd/m² in the middle: log2(8 / 0.3) = 4.7; twice the exposure is one less.
  EXPECT_NE(lines()[1].find("exposure EV 4.7"), std::string::npos) << lines()[1];
  desk_.exposure_per_cdm2 = 0.6;
  EXPECT_NE(lines()[1].find("exposure EV 3.7"), std::string::npos) << lines()[1];
}

TEST_F(Measuring, APointOfThePictureIsWhatIsSeenThere) {
  PictureInstruments instruments(desk_, lamps_, world_, RoadLine(), ProbeLog());
  Camera camera;
  camera.eye_m = {0.0, 0.0, 3.2};
  FrameInput picture;
  picture.camera = camera;
  instruments.see({SimTime{0}, car_, &picture, 16.0 / 9.0});
  ASSERT_TRUE(apply(desk_, desk_command("point picture 0.5 0.75")));
  const auto at = instruments.point();
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->position_m.z, 2.0, 1e-9);
  const double down = 0.5 * std::tan(0.5 * camera.fov_horizontal_rad) * 9.0 / 16.0;
  EXPECT_NEAR(at->position_m.x, 1.2 / down, 1e-4) << "a millionth of the picture";
  EXPECT_NE(instruments.answer().find("\nroad_test (asphalt): "), std::string::npos) << instruments.answer();
  ASSERT_TRUE(apply(desk_, desk_command("point picture 0.5 0.1")));
  EXPECT_EQ(instruments.answer(), "\npoint: the picture shows nothing of the scene there");
  ASSERT_TRUE(apply(desk_, desk_command("point road 20 0")));
  EXPECT_EQ(instruments.answer(), "\npoint: the scene has no lane");
}

// Lines that rise with the light of each probe, from the left edge to now; what is off is no box.
TEST_F(Measuring, ThePlotShowsEachProbesLightOverTime) {
  PictureInstruments instruments(desk_, lamps_, world_, RoadLine(), ProbeLog());
  const FrameInput picture;
  desk_.plot = true;
  desk_.shadows = 0;
  desk_.probes = {{Probe::Frame::kCar, {23.0, 0.6, 0.0}}, {Probe::Frame::kRoad, {20.0, 0.0, 0.0}}};
  ASSERT_TRUE(apply(desk_, desk_command("point car 23 0.6 0")));
  OverlayMarks marks;
  for (int frame = 0; frame < 30; ++frame) {
    instruments.see({SimTime{frame * 16'666'667}, car_, &picture, 1.6});
    marks = instruments.marks(false);
  }
  ASSERT_EQ(marks.boxes.size(), 1u);
  const OverlayMarks::Box& box = marks.boxes.front();
  std::size_t curves = 0;
  for (const OverlayMarks::Line& line : marks.lines) {
    if (line.x0_01 < box.left_01) continue;  // the cross of the point
    EXPECT_LE(line.x1_01, box.left_01 + box.width_01);
    EXPECT_GE(std::min(line.y0_01, line.y1_01), box.top_01);
    EXPECT_LE(std::max(line.y0_01, line.y1_01), box.top_01 + box.height_01);
    curves += line.x1_01 - line.x0_01 < 0.01 ? 1 : 0;
  }
  EXPECT_EQ(curves, 2u * 4u) << "five tenths, of the probe and the point; the road has no lane";
  const auto has = [&](const std::string& begin) {
    return std::ranges::any_of(marks.labels,
                               [&](const OverlayMarks::Label& label) { return label.text.starts_with(begin); });
  };
  const double lx = lamps_.illuminance_lx(car_, *placed(desk_.probes[0], car_, RoadLine()));
  ASSERT_GT(lx, 0.0);
  char now[40];
  std::snprintf(now, sizeof now, "%.3g", lx);
  EXPECT_TRUE(has(std::string("1: ") + now));
  EXPECT_TRUE(has("2: -"));
  EXPECT_TRUE(has(std::string("point: ") + now));
  desk_.plot = false;
  EXPECT_TRUE(instruments.marks(false).boxes.empty());
  desk_.plot = true, desk_.probes.clear(), desk_.point.reset();
  marks = instruments.marks(false);
  EXPECT_EQ(marks.labels.front().text, "no probe and no point is set") << "and nothing of before";
}

// Labels of the isolux lines go on along their lines where those of the grid are.
TEST_F(Measuring, GridAndIsoluxLinesHaveNoLabelOnAnother) {
  PictureInstruments instruments(desk_, lamps_, world_, RoadLine(), ProbeLog());
  desk_.grid_m = 5.0;
  desk_.isolux = true;
  desk_.isolux_lx = {1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0};
  FrameInput picture;
  std::size_t labels = 0;
  for (const double up_m : {3.2, 4.0, 6.0, 10.0}) {
    picture.camera.eye_m = {0.0, 0.0, up_m};
    instruments.see({SimTime{0}, car_, &picture, 16.0 / 9.0});
    const OverlayMarks marks = instruments.marks(true);
    labels += marks.labels.size();
    for (std::size_t i = 0; i < marks.labels.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_TRUE(std::abs(marks.labels[i].x_01 - marks.labels[k].x_01) >= 0.04 ||
                    std::abs(marks.labels[i].y_01 - marks.labels[k].y_01) >= 0.025)
            << marks.labels[i].text << " on " << marks.labels[k].text << " from " << up_m << " m";
  }
  EXPECT_GT(labels, 30u);
}

// Of a picture in halves: marks of its own view lie in its half.
TEST_F(Measuring, MarksLieInThePartOfTheirView) {
  PictureInstruments instruments(desk_, lamps_, world_, RoadLine(), ProbeLog());
  desk_.grid_m = 10.0;
  FrameInput picture;
  picture.camera.eye_m = {0.0, 0.0, 3.2};
  instruments.see({SimTime{0}, car_, &picture, 16.0 / 9.0});
  const OverlayMarks whole = instruments.marks(true);
  lay_out(picture, Layout::kSplit, Camera{}, "other");
  const OverlayMarks half = instruments.marks(true);
  const auto row = [](const OverlayMarks& marks) {
    return std::ranges::find(marks.labels, "10 m", &OverlayMarks::Label::text);
  };
  ASSERT_NE(row(whole), whole.labels.end());
  ASSERT_NE(row(half), half.labels.end());
  EXPECT_NEAR(row(half)->x_01, row(whole)->x_01 - 0.25, 1e-9) << "the middle half of the view, in the left half";
  EXPECT_NEAR(row(half)->y_01, row(whole)->y_01, 1e-9);
}

TEST_F(Measuring, ProbesAreKeptTenTimesASecond) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "phare_probe_log";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  desk_.probes = {{Probe::Frame::kCar, {23.0, 0.6, 0.0}}, {Probe::Frame::kRoad, {20.0, 0.0, 0.0}}};
  {
    PictureInstruments instruments(desk_, lamps_, world_, RoadLine(), ProbeLog(folder, false));
    const FrameInput picture;
    for (int frame = 0; frame < 30; ++frame) {
      instruments.see({SimTime{frame * 16'666'667}, car_, &picture, 1.6});
      EXPECT_TRUE(instruments.log());
    }
  }
  std::ifstream file(folder / "probes.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line,
            "time_s,x_m,y_m,z_m,yaw_rad,pitch_rad,speed_mps,probe1_lx,probe2_lx,reach_1lx_left_m,reach_1lx_right_m,"
            "reach_3lx_left_m,reach_3lx_right_m,reach_5lx_left_m,reach_5lx_right_m");
  int rows = 0;
  while (std::getline(file, line)) {
    ++rows;
    std::vector<std::string> cells;
    std::istringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 15u) << line;
    // Nine digits are written.
    const double lx = lamps_.illuminance_lx(car_, on_ground(23.0, 0.6));
    EXPECT_NEAR(std::stod(cells[7]), lx, 1e-8 * lx);
    EXPECT_EQ(cells[8], "") << "the scene has no lane";
  }
  EXPECT_EQ(rows, 5) << "half a second";
  // A process in the place of one that was killed goes on in the same file.
  ProbeLog again(folder, true);
  EXPECT_TRUE(again.due(SimTime{500'000'000}));
  EXPECT_TRUE(again.write({SimTime{500'000'000}, car_, {1.0, 2.0}, reach_of(lamps_, car_, RoadLine())}));
  std::ifstream whole(folder / "probes.csv");
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(whole), {}, '\n'), 7);
  ProbeLog nowhere("/no/such/folder", false);
  EXPECT_FALSE(nowhere.write({}));
  EXPECT_TRUE(nowhere.write({})) << "said once";
}

}  // namespace
}  // namespace phare
