// unit: two designs in one picture: off it is no work and no view, on it is B's lamps in B's half; the colours of what
// differs.
#include "visual/process/versus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/paths.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/process/stills.h"

namespace phare {
namespace {

class VersusTest : public testing::Test {
 protected:
  VersusTest() : rig_(*read_rig(source_dir() + "/config/rigs/country_road.toml")), lamps_(*Lamps::load(rig_)) {
    controls_.light_switch = LightSwitch::kLow;
    (void)lamps_.set_controls(controls_);
  }
  Rig rig_;
  Lamps lamps_;
  CockpitState controls_;
  Desk desk_;
};

TEST_F(VersusTest, OffIsNoWork) {
  Versus versus;
  for (int frame = 0; frame < 10; ++frame) EXPECT_TRUE(versus.follow(desk_, lamps_, controls_).empty());
  EXPECT_EQ(versus.work_done(), 0u);
  EXPECT_EQ(versus.lamps(), nullptr);
  // A rig of one design has nothing beside it.
  Rig one = rig_;
  one.designs.resize(1);
  const Lamps alone = *Lamps::load(one);
  desk_.compare = Compare::kSplit;
  EXPECT_TRUE(versus.follow(desk_, alone, controls_).empty());
  EXPECT_EQ(versus.work_done(), 0u);
}

// B is a copy of A's lamps, and its beams are summed from tables: they outlive whoever read them.
TEST_F(VersusTest, CopiedLampsShineWhenThoseTheyWereCopiedFromAreGone) {
  auto first = std::make_unique<Lamps>(lamps_);
  const auto ahead_lx = [](const Lamps& lamps) {
    return illuminance_lx(lamps.sources_in_car(0, {LampFunction::kLow}), {25.0, 0.0, 0.0}, {-1.0, 0.0, 0.0});
  };
  const double lx = ahead_lx(*first);
  Lamps copy = *first;
  first.reset();
  controls_.light_switch = LightSwitch::kHigh;
  EXPECT_FALSE(copy.set_controls(controls_).empty());
  EXPECT_GT(lx, 0.0);
  EXPECT_EQ(ahead_lx(copy), lx);
}

TEST_F(VersusTest, TheOtherDesignHasBeamsOfItsOwn) {
  Versus versus;
  desk_.compare = Compare::kSplit;
  const auto changes = versus.follow(desk_, lamps_, controls_);
  ASSERT_NE(versus.lamps(), nullptr);
  EXPECT_EQ(versus.lamps()->design_index(), 1u);  // the next one
  EXPECT_EQ(lamps_.design_index(), 0u);
  ASSERT_EQ(changes.size(), 2u);  // low beam of a pair
  for (const Lamps::Change& change : changes) EXPECT_GE(change.position, Versus::kFirstBeam);
  EXPECT_TRUE(versus.follow(desk_, lamps_, controls_).empty());  // nothing is uploaded twice
  const VehicleState car;
  for (const PlacedLamp& lamp : versus.placed(car)) EXPECT_GE(lamp.beam, Versus::kFirstBeam);

  // Beside itself: it has to be uploaded there though A shows it.
  desk_.versus = 0;
  EXPECT_EQ(versus.follow(desk_, lamps_, controls_).size(), 2u);
  // Lamps that are moved move on both sides.
  ASSERT_TRUE(
      lamps_.mount({.lamp = "headlamp", .quantity = rig_command::MountQuantity::kPitch, .value = 0.01, .by = true})
          .ok());
  (void)versus.follow(desk_, lamps_, controls_);
  EXPECT_EQ(versus.lamps()->mounts(0), lamps_.mounts(0));
}

TEST_F(VersusTest, HalvesAreTwoViewsOfOneEye) {
  Versus versus;
  desk_.compare = Compare::kSplit;
  (void)versus.follow(desk_, lamps_, controls_);
  const VehicleState car;
  FrameInput frame;
  frame.lamps = lamps_.placed(car);
  frame.more_views.resize(1);  // an inset
  frame.glare = {{{5.0, 0.0, 1.0}, 1.0}};
  const PlacedLamp of_another{.position_m = {50.0, 3.0, 0.6}, .world_from_image = glm::dmat3(1.0), .beam = 40};
  versus.split(frame, car, std::span(&of_another, 1), {{{5.0, 0.0, 1.0}, 2.0}});
  ASSERT_EQ(frame.more_views.size(), 2u);
  const ViewInput& right = frame.more_views.front();  // below the insets
  EXPECT_DOUBLE_EQ(frame.part.width_01, 0.5);
  EXPECT_DOUBLE_EQ(right.part.left_01, 0.5);
  EXPECT_DOUBLE_EQ(frame.camera.seen_to_01, right.camera.seen_from_01);
  EXPECT_EQ(frame.camera.eye_m, right.camera.eye_m);
  EXPECT_EQ(right.lamps.size(), frame.lamps.size() + 1);
  EXPECT_EQ(right.lamps.back().beam, 40u);
  ASSERT_EQ(right.glare.size(), 1u);
  EXPECT_EQ(right.glare.front().eye_lx, 2.0) << "B's own glare";
  EXPECT_EQ(frame.glare.front().eye_lx, 1.0);
  EXPECT_NE(right.lamps.front().beam, frame.lamps.front().beam);
}

// The lamps of both light one view, B's told apart; lamps of others, which light both, and glare have no part in it.
TEST_F(VersusTest, DifferenceAndRatioAreOfBothInOneView) {
  Versus versus;
  for (const Compare compare : {Compare::kDifference, Compare::kRatio}) {
    desk_.compare = compare;
    (void)versus.follow(desk_, lamps_, controls_);
    FrameInput frame;
    frame.lamps = lamps_.placed({});
    for (PlacedLamp& lamp : frame.lamps) lamp.carried_by = 3;
    const std::size_t own = frame.lamps.size();
    const PlacedLamp of_another{.position_m = {50.0, 3.0, 0.6}, .beam = 2 * Versus::kFirstBeam};
    frame.lamps.push_back(of_another);
    frame.glare = {{{5.0, 0.0, 1.0}, 1.0}};
    versus.show(frame, compare, {}, std::span(&of_another, 1), {});
    EXPECT_EQ(frame.view, compare == Compare::kRatio ? View::kRatio : View::kDifference);
    EXPECT_TRUE(frame.more_views.empty());
    EXPECT_TRUE(frame.glare.empty());
    ASSERT_EQ(frame.lamps.size(), own + versus.placed({}).size());
    for (std::size_t i = 0; i < frame.lamps.size(); ++i) {
      EXPECT_EQ(frame.lamps[i].of_b, i >= own);
      EXPECT_EQ(frame.lamps[i].beam >= Versus::kFirstBeam, i >= own);
      EXPECT_EQ(frame.lamps[i].carried_by, 3u) << "by one body";
    }
  }
  FrameInput alone;
  versus.show(alone, Compare::kFlicker, {}, {}, {});
  EXPECT_EQ(alone.view, View::kPhoto);
}

// Both cut-offs stand equally high at 25 m, wherever A's lamps are turned to; off, B stays as it is mounted.
TEST_F(VersusTest, AlignedByTheCutOff) {
  Versus versus;
  desk_.compare = Compare::kSplit;
  (void)versus.follow(desk_, lamps_, controls_);
  const double b_m = versus.lamps()->cutoff_height_m({}, 25.0).value();
  lamps_.set_aim(0.02);
  (void)versus.follow(desk_, lamps_, controls_);
  const double apart_m = lamps_.cutoff_height_m({}, 25.0).value() - versus.lamps()->cutoff_height_m({}, 25.0).value();
  EXPECT_FALSE(versus.aligned_rad());
  desk_.versus_aligned = true;
  for (int frame = 0; frame < 3; ++frame) {
    (void)versus.follow(desk_, lamps_, controls_);
    EXPECT_NEAR(versus.lamps()->cutoff_height_m({}, 25.0).value(), lamps_.cutoff_height_m({}, 25.0).value(), 1e-6);
    ASSERT_TRUE(versus.aligned_rad());
    EXPECT_NEAR(*versus.aligned_rad(), apart_m / 25.0, 1e-3 * std::abs(apart_m) + 1e-9) << "of a small angle";
  }
  lamps_.set_aim(0.0);
  desk_.versus_aligned = false;
  (void)versus.follow(desk_, lamps_, controls_);
  EXPECT_NEAR(versus.lamps()->cutoff_height_m({}, 25.0).value(), b_m, 1e-9) << "as it was";
  controls_.light_switch = LightSwitch::kOff;
  (void)lamps_.set_controls(controls_);
  desk_.versus_aligned = true;
  (void)versus.follow(desk_, lamps_, controls_);
  EXPECT_FALSE(versus.aligned_rad()) << "dark lamps have no cut-off";
}

TEST_F(VersusTest, TheEyeAdaptsToBoth) {
  Versus versus;
  const glm::vec3 a = lamps_.light().value();
  EXPECT_EQ(versus.light(lamps_), a) << "off: to what shines";
  desk_.compare = Compare::kSplit;
  (void)versus.follow(desk_, lamps_, controls_);
  const glm::vec3 b = versus.lamps()->light().value();
  EXPECT_GT(b.z, a.z) << "the second design is cooler";
  EXPECT_EQ(versus.light(lamps_), 0.5f * (a + b));
  controls_.light_switch = LightSwitch::kOff;
  (void)lamps_.set_controls(controls_);
  (void)versus.follow(desk_, lamps_, controls_);
  EXPECT_EQ(versus.light(lamps_), std::nullopt);
}

TEST_F(VersusTest, ByTurnsHalfASecondEach) {
  EXPECT_FALSE(Versus::has_turn(desk_, SimTime{700'000'000}));
  desk_.compare = Compare::kFlicker;
  EXPECT_FALSE(Versus::has_turn(desk_, SimTime{1'499'000'000}));
  EXPECT_TRUE(Versus::has_turn(desk_, SimTime{1'500'000'000}));
}

TEST(VersusPicture, SaysWhichIsBrighter) {
  const auto colour = [](double value, VersusScale scale) { return versus_colour(value, scale); };
  const Colour none = colour(0.0, VersusScale::kDifference), more = colour(3.0, VersusScale::kDifference),
               less = colour(-3.0, VersusScale::kDifference);
  EXPECT_EQ(none.red + none.green + none.blue, 0);
  EXPECT_GT(more.red, more.blue);
  EXPECT_GT(less.blue, less.red);
  EXPECT_EQ(colour(1.0, VersusScale::kRatio).red, 0);
  EXPECT_GT(colour(4.0, VersusScale::kRatio).red, colour(2.0, VersusScale::kRatio).red);
  // Two pixels: 1 and 4 lx more in B, dark in both.
  ImageF a{2, 1, std::vector<float>(8, 0.0f)}, b = a;
  a.rgba[3] = 1.0f, b.rgba[3] = 5.0f;
  const Image8 page = versus_picture(a, b, VersusScale::kRatio, "");
  // 5 to 1 lx on the left, dark on the right: one pixel of the page is another than where nothing differs.
  const Image8 same = versus_picture(a, a, VersusScale::kRatio, "");
  ASSERT_EQ(page.rgba.size(), same.rgba.size());
  std::size_t other = 0, red = 0;
  for (std::size_t at = 0; at < page.rgba.size(); at += 4) {
    if (std::equal(page.rgba.begin() + static_cast<std::ptrdiff_t>(at),
                   page.rgba.begin() + static_cast<std::ptrdiff_t>(at + 4),
                   same.rgba.begin() + static_cast<std::ptrdiff_t>(at)))
      continue;
    ++other;
    red += page.rgba[at] > page.rgba[at + 2] ? 1 : 0;
  }
  EXPECT_EQ(other, 1u);
  EXPECT_EQ(red, 1u);
}

}  // namespace
}  // namespace phare
