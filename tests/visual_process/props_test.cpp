// Cameras outside the car show its body, the camera "wall" a wall at 25 m; what a second camera adds to a picture, and
// what the mouse finds in it.
#include "visual/process/props.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "config/base/conventions.h"
#include "tests/visual_process/ground_square.h"
#include "visual/process/cameras.h"
#include "visual/process/pick.h"
#include "visual/process/picture_instruments.h"
#include "visual/process/traffic.h"

namespace phare {
namespace {

Rig rig_of_one_lamp() {
  const auto file = std::filesystem::path(testing::TempDir()) / "props_test.ies";
  std::ofstream(file) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n"
                         "-20 20\n-30 30\n900 900\n900 900\n";
  SourceConfig low;
  low.file = file;
  Rig rig;
  rig.designs = {{"one", {{.name = "headlamp", .position_m = {3.4, 0.6, 0.7}, .sources = {low}}}}};
  return rig;
}

class PropsTest : public testing::Test {
 protected:
  void SetUp() override {
    auto movers = Movers::read();
    ASSERT_TRUE(movers) << movers.error().text();
    movers_ = std::move(*movers);
    const auto props = Props::of(movers_);
    ASSERT_TRUE(props) << props.error().text();
    props_ = *props;
    car_.x_m = 100.0, car_.y_m = -20.0, car_.z_m = 3.0, car_.yaw_rad = 0.7, car_.pitch_rad = 0.02;
  }

  ViewInput view_of(CameraKind kind) const {
    ViewInput view;
    view.camera = camera_of({kind, {}}, {channel_, lamps_, car_});
    view.lamps = {{{}, glm::dmat3(1.0), 0}, {{}, glm::dmat3(1.0), Traffic::kBeam}};
    view.moving = {{2, {}, glm::dmat3(1.0)}};
    return view;
  }

  Lamps lamps_ = std::move(*Lamps::load(rig_of_one_lamp()));
  Movers movers_;
  Props props_;
  ChannelConfig channel_;
  VehicleState car_;
  Scene nothing_;
};

TEST_F(PropsTest, TheCarIsSeenFromOutsideAndCarriesItsOwnLamps) {
  const World world(nothing_, movers_.meshes());
  for (std::size_t kind = 0; kind < kCameraNames.size(); ++kind) {
    SCOPED_TRACE(kCameraNames[kind]);
    const auto camera = static_cast<CameraKind>(kind);
    const bool outside = camera == CameraKind::kBirdsEye || camera == CameraKind::kChase ||
                         camera == CameraKind::kOncoming || camera == CameraKind::kFree;
    ViewInput view = view_of(camera);
    props_.add_to(view, camera, lamps_, car_, true, world);
    const bool wall = camera == CameraKind::kWall;
    EXPECT_EQ(view.moving.size(), outside || wall ? 2u : 1u);
    EXPECT_EQ(view.lamps[0].carried_by, outside ? 1u : SIZE_MAX);
    EXPECT_EQ(view.lamps[1].carried_by, SIZE_MAX) << "a lamp of others stays as it is";
    EXPECT_EQ(view.glare.size(), camera == CameraKind::kChase || camera == CameraKind::kFree ? 2u : 0u)
        << "tail lamps, seen from behind";
  }
  ViewInput dark = view_of(CameraKind::kChase);
  props_.add_to(dark, CameraKind::kChase, lamps_, car_, false, world);
  EXPECT_TRUE(dark.glare.empty()) << "lights off";
}

// The mesh's rear axle stands where the car's does, and its front where it looks.
TEST_F(PropsTest, TheBodyStandsWhereTheCarIs) {
  ViewInput view = view_of(CameraKind::kChase);
  props_.add_to(view, CameraKind::kChase, lamps_, car_, false, World(nothing_));
  const PlacedMesh& body = view.moving.back();
  const auto chunks = chunks_by_node(movers_.meshes())[body.mesh];
  glm::dvec3 low(1e9), high(-1e9);
  for (const std::size_t chunk : chunks) {
    low = glm::min(low, movers_.meshes().chunks[chunk].low_m);
    high = glm::max(high, movers_.meshes().chunks[chunk].high_m);
  }
  const glm::dmat3 turn = world_from_car(car_.roll_rad, car_.pitch_rad, car_.yaw_rad);
  const glm::dvec3 from_axle = glm::transpose(turn) * (body.position_m - glm::dvec3(car_.x_m, car_.y_m, car_.z_m));
  const double front_m = from_axle.x + high.x, rear_m = from_axle.x + low.x;
  EXPECT_GT(front_m, 3.2) << "4.5 m long, an overhang before the front axle";
  EXPECT_LT(front_m, 3.7) << "within the box in which no camera shows it";
  EXPECT_GT(rear_m, -1.2);
  EXPECT_NEAR(from_axle.y, 0.0, 1e-12);
  EXPECT_NEAR(from_axle.z, 0.0, 1e-12);
}

// Lines of the road that the body hides are not drawn over it.
TEST_F(PropsTest, TheBodyHidesLinesOfTheRoad) {
  car_ = {};
  const World world(nothing_, movers_.meshes());
  Desk desk;
  desk.grid_m = 3.0;
  PictureInstruments instruments(desk, lamps_, world, RoadLine(), ProbeLog("", false));
  for (const CameraKind kind : {CameraKind::kChase, CameraKind::kBirdsEye}) {
    FrameInput picture;
    picture.camera = camera_of({kind, {}}, {channel_, lamps_, car_});
    const ViewGeometry view(picture.camera, 16.0 / 9.0);
    const auto lines_from = [&](const std::optional<PlacedMesh>& own_car, const glm::dvec3& at_m) {
      instruments.see({.car = car_, .picture = &picture, .own_car = own_car});
      const glm::dvec4 clip = view.clip_from_eye() * glm::dvec4(at_m - picture.camera.eye_m, 1.0);
      const double x_01 = 0.5 + 0.5 * clip.x / clip.w, y_01 = 0.5 + 0.5 * clip.y / clip.w;
      return std::ranges::count_if(instruments.marks(true).lines, [&](const OverlayMarks::Line& line) {
        constexpr double kNear_01 = 1e-3;
        return std::abs(line.x0_01 - x_01) < kNear_01 && std::abs(line.y0_01 - y_01) < kNear_01;
      });
    };
    const std::optional<PlacedMesh> body = props_.own_car_in(kind, picture.camera, car_);
    ASSERT_TRUE(body);
    const glm::dvec3 behind_m{3.0, 0.0, 0.01}, beside_m{15.0, 4.0, 0.01};
    EXPECT_GT(lines_from(std::nullopt, behind_m), 0) << kCameraNames[static_cast<std::size_t>(kind)];
    EXPECT_EQ(lines_from(body, behind_m), 0) << kCameraNames[static_cast<std::size_t>(kind)];
    EXPECT_GT(lines_from(body, beside_m), 0) << kCameraNames[static_cast<std::size_t>(kind)];
  }
  EXPECT_FALSE(props_.own_car_in(CameraKind::kDriver, driver_camera(channel_, car_), car_));
}

TEST_F(PropsTest, ACameraWithinTheCarDoesNotShowIt) {
  FreeEye eye{.position_m = {0.8, 0.0, 1.2}};
  EXPECT_FALSE(Props::shows_own_car(CameraKind::kFree, free_camera(eye, car_), car_));
  eye.position_m.x = -3.0;
  EXPECT_TRUE(Props::shows_own_car(CameraKind::kFree, free_camera(eye, car_), car_));
}

// The wall stands upright 25 m before the lamps whatever the car's pitch, and its lines have their angles.
TEST_F(PropsTest, TheWallStandsAt25MetresWithItsAngles) {
  const World world(nothing_, movers_.meshes());
  ViewInput view = view_of(CameraKind::kWall);
  props_.add_to(view, CameraKind::kWall, lamps_, car_, true, world);
  const Wall wall = wall_before(lamps_, car_);
  EXPECT_NEAR(wall.lamps_m.z - car_.z_m, 0.7 - 3.4 * std::sin(car_.pitch_rad), 0.01) << "at the lamps, nose down";
  const ViewGeometry geometry(view.camera, 16.0 / 9.0);
  FrameInput picture;
  static_cast<ViewInput&>(picture) = view;
  const auto ahead = pick(world, picture, 16.0 / 9.0, 0.5, 0.5);
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(glm::distance(ahead->position_m, wall.lamps_m), kWall_m, 1e-4) << "a millionth of the picture";
  EXPECT_NEAR(ahead->normal.z, 0.0, 1e-6) << "upright, of float32 corners";
  OverlayMarks marks;
  draw_marks(marks, wall_marks(wall), geometry);
  const double half = std::tan(0.5 * view.camera.fov_horizontal_rad);
  const auto label = [&](const char* text) {
    return std::ranges::find(marks.labels, text, &OverlayMarks::Label::text);
  };
  ASSERT_NE(label("5 L"), marks.labels.end());
  EXPECT_NEAR(label("5 L")->x_01, 0.5 - 0.5 * std::tan(5.0 * M_PI / 180.0) / half, 1e-9);
  ASSERT_NE(label("5 U"), marks.labels.end());
  EXPECT_NEAR(label("5 U")->y_01, 0.5 - 0.5 * std::tan(5.0 * M_PI / 180.0) / half * 16.0 / 9.0, 1e-9);
  EXPECT_NE(label("H-H"), marks.labels.end());
  EXPECT_NE(label("V-V"), marks.labels.end());
  for (const char* at_a_corner : {"20 L", "20 R", "10 U"})
    EXPECT_NE(label(at_a_corner), marks.labels.end()) << at_a_corner << " lies on no other";
}

TEST_F(PropsTest, NothingShinesThroughTheWall) {
  const World world(nothing_, movers_.meshes());
  for (const CameraKind kind : {CameraKind::kWall, CameraKind::kDriver}) {
    ViewInput view = view_of(kind);
    const auto at = [&](const glm::dvec3& from_eye) {
      return GlaringLamp{view.camera.eye_m + view.camera.world_from_eye * from_eye, 1.0};
    };
    view.glare = {at({60, 1, 0.2}), at({20, 1, 0.2}), at({60, 90, 0.2}), at({-30, 1, 0.2})};
    const std::vector<GlaringLamp> all = view.glare;
    EXPECT_TRUE(props_.add_to(view, kind, lamps_, car_, true, world).empty()) << "nothing of it is the own car's";
    const auto shines = [&](std::size_t i) {
      return std::ranges::count(view.glare, all[i].place_m, &GlaringLamp::place_m) > 0;
    };
    EXPECT_EQ(shines(0), kind != CameraKind::kWall) << "behind it";
    EXPECT_TRUE(shines(1)) << "before it";
    EXPECT_TRUE(shines(2)) << "beside it";
    EXPECT_TRUE(shines(3)) << "behind the eye";
  }
}

TEST_F(PropsTest, TheFreeEyeTakesThePlaceOfAnother) {
  for (const CameraKind kind : {CameraKind::kDriver, CameraKind::kChase, CameraKind::kOncoming, CameraKind::kWall}) {
    SCOPED_TRACE(kCameraNames[static_cast<std::size_t>(kind)]);
    const Camera camera = camera_of({kind, {}}, {channel_, lamps_, car_});
    const Camera free = free_camera(free_eye_at(camera, car_), car_);
    EXPECT_NEAR(glm::distance(free.eye_m, camera.eye_m), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(free.world_from_eye[0], camera.world_from_eye[0]), 0.0, 1e-9);
    EXPECT_NEAR(free.fov_horizontal_rad, camera.fov_horizontal_rad, 1e-12);
  }
  const FreeEye above = free_eye_at(birds_eye_camera(car_), car_);
  EXPECT_EQ(above.pitch_deg, -89.0);
  EXPECT_NEAR(2.0 * above.position_m.z * std::tan(above.fov_deg * M_PI / 360.0), kBirdsEyeLength_m, 1e-9);
}

// Halves show the middle of each camera, an inset lies in the corner; the mouse finds in each what that camera sees.
TEST_F(PropsTest, TheMouseFindsWhatTheViewThereShows) {
  const Scene ground = ground_square(60.0);  // at z = 2 m
  const auto picture_of = [&](Layout layout) {
    FrameInput picture;
    picture.camera.eye_m = {0.0, 0.0, 4.0};
    Camera second;
    second.eye_m = {100.0, 0.0, 6.0};
    lay_out(picture, layout, second, "second");
    return picture;
  };
  const auto aim = [](double eye_z, double half_up, double y_01) { return eye_z / ((2.0 * y_01 - 1.0) * half_up); };
  const double half = std::tan(0.5 * Camera{}.fov_horizontal_rad), aspect = 16.0 / 9.0;
  const FrameInput full = picture_of(Layout::kFull);
  EXPECT_TRUE(full.more_views.empty());
  EXPECT_NEAR(pick(ground, full, aspect, 0.5, 0.75)->position_m.x, aim(2.0, half / aspect, 0.75), 1e-3);

  const FrameInput split = picture_of(Layout::kSplit);
  ASSERT_EQ(split.more_views.size(), 1u);
  const auto left = pick(ground, split, aspect, 0.25, 0.75), right = pick(ground, split, aspect, 0.75, 0.75);
  ASSERT_TRUE(left && right);
  EXPECT_NEAR(left->position_m.x, aim(2.0, half / aspect, 0.75), 1e-3) << "as high as in the whole picture";
  EXPECT_NEAR(left->position_m.y, 0.0, 1e-3) << "the middle of its half";
  EXPECT_NEAR(right->position_m.x, 100.0 + aim(4.0, half / aspect, 0.75), 1e-3);
  EXPECT_NEAR(right->position_m.y, 0.0, 1e-3);

  const FrameInput inset = picture_of(Layout::kInset);
  const PicturePart& part = inset.more_views.front().part;
  const auto in_it =
      pick(ground, inset, aspect, part.left_01 + 0.5 * part.width_01, part.top_01 + 0.75 * part.height_01);
  ASSERT_TRUE(in_it);
  EXPECT_NEAR(in_it->position_m.x, 100.0 + aim(4.0, half * part.height_01 / part.width_01 / aspect, 0.75), 1e-3);
  EXPECT_FALSE(pick(ground, inset, aspect, 0.3, 0.2)) << "beside it the first camera's sky";
}

}  // namespace
}  // namespace phare
