#include "visual/process/picture_kind.h"

#include <gtest/gtest.h>

namespace phare {
namespace {

TEST(PictureKind, HowMuchFallsFromWhereItIsSeenAndWhatIsWrittenMakesNoOther) {
  Desk rain;
  rain.rain_mmph = 2.0;
  Desk other = rain;
  other.rain_mmph = 40.0;
  other.camera = CameraKind::kChase;
  other.grid_m = 5.0;
  other.exposure_per_cdm2 = 1.0;
  other.isolux_lx = {1.0, 3.0};
  EXPECT_TRUE(same_kind(rain, other));
}

TEST(PictureKind, WhatTakesOtherPipelinesIsOne) {
  const Desk plain;
  const auto other = [&](auto&& change) {
    Desk desk = plain;
    change(desk);
    return !same_kind(plain, desk) && !same_kind(desk, plain);
  };
  EXPECT_TRUE(other([](Desk& desk) { desk.view = View::kFalseColour; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.method = Method::kVertex; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.compare = Compare::kRatio; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.visibility_m = 100.0; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.snow_cover_01 = 0.1; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.snow_mmph = 1.0; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.ground = 2; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.shadows = 3; }));
  EXPECT_TRUE(other([](Desk& desk) { desk.windscreen = true; }));
}

// While it is made ready the rest of the desk is followed.
TEST(PictureKind, OfThatWhichIsShownTheKindAloneStays) {
  Desk shown;
  shown.visibility_m = 80.0;
  Desk asked;
  asked.rain_mmph = 5.0;
  asked.view = View::kFalseColour;
  asked.camera = CameraKind::kWall;
  asked.exposure_per_cdm2 = 1.0;
  const Desk held = with_kind_of(asked, shown);
  EXPECT_TRUE(same_kind(held, shown));
  EXPECT_EQ(held.visibility_m, 80.0);
  EXPECT_EQ(held.rain_mmph, 0.0);
  EXPECT_EQ(held.camera, CameraKind::kWall);
  EXPECT_EQ(held.exposure_per_cdm2, 1.0);
}

}  // namespace
}  // namespace phare
