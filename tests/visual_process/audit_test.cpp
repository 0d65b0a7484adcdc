// unit: what a level of the picture states of itself, and the audit that holds it to that: it passes what is true, and
// finds what is not, names it, and says it once.
#include "visual/process/audit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "tests/visual_process/ground_square.h"

namespace phare {
namespace {

/// A beam with a steep cut-off: 20,000 cd below V = -0.6°, 100 cd above -0.5°, which ends at V = 5°.
std::filesystem::path cut_off_lamp() {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "audit_cut_off.ies";
  std::ofstream out(file);
  out << "IESNA:LM-63-2002\n[TEST] cut-off\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 5 2 3 2 0 0 0\n1 1 0\n"
         "-10 -0.6 -0.5 0 5\n-30 30\n";
  for (int i = 0; i < 2; ++i) out << "20000 20000 100 100 100\n";
  return file;
}

class Audit : public testing::Test {
 protected:
  Audit() {
    Rig rig;
    DesignConfig& design = rig.designs.emplace_back();
    for (const double y_m : {0.6, -0.6}) {
      LampConfig lamp;
      lamp.name = y_m > 0.0 ? "left" : "right";
      lamp.position_m = {3.0, y_m, 0.7};
      SourceConfig source;
      source.function = LampFunction::kLow;
      source.file = cut_off_lamp();
      lamp.sources = {source};
      design.lamps.push_back(lamp);
    }
    Result<Lamps> loaded = Lamps::load(rig);
    EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().text());
    lamps_.emplace(std::move(*loaded));
    CockpitState controls;
    controls.light_switch = LightSwitch::kLow;
    lamps_->set_controls(controls);
  }

  /// Points of the road from 5 m to 60 m, as float32 would have them `times` as bright.
  std::vector<AuditSample> samples(double times) const {
    std::vector<AuditSample> all;
    for (double x_m = 5.0; x_m < 60.0; x_m *= 1.2) {
      AuditSample sample;
      sample.point = {{3.0 + x_m, 0.3, 0.0}, {0.0, 0.0, 1.0}};
      sample.illuminance_lx = times * lamps_->illuminance_lx(pose_, sample.point);
      sample.x_01 = 0.25;
      sample.y_01 = 0.75;
      all.push_back(sample);
    }
    return all;
  }
  AuditMoment moment(std::optional<AuditBound> bound) const {
    return {.frame = 7,
            .time_s = 0.5,
            .width_px = 160,
            .height_px = 80,
            .bound = std::move(bound),
            .by_lamp = [this](const MeasurePoint& at) {  // the right one is wrong
              const auto lights = lamps_->lights_at(pose_, at);
              return std::vector<double>{lights[0].surface_lx, 1.1 * lights[1].surface_lx};
            }};
  }

  std::optional<Lamps> lamps_;
  VehicleState pose_;
};

TEST_F(Audit, NamesNoLampOfADesignThatShinesNoMore) {
  const auto said = [&](const AuditMoment& moment) {
    AuditStats stats;
    const auto failure = stats.add(*lamps_, pose_, samples(1.1), moment);
    return failure ? failure->text() : "";
  };
  AuditMoment moment = this->moment(audit_bound(ImageLevel::kFloatNodes, Method::kFragment));
  EXPECT_NE(said(moment).find(" lx, most from "), std::string::npos) << said(moment);
  moment.by_lamp = {};
  EXPECT_NE(said(moment).find(" lx; off by "), std::string::npos) << said(moment);
}

TEST_F(Audit, PassesWhatIsWithinTheLevelsBound) {
  AuditStats stats;
  // Half the bound of each level; float32's own rounding.
  EXPECT_FALSE(
      stats.add(*lamps_, pose_, samples(1.0 + 5e-6), moment(audit_bound(ImageLevel::kFloatNodes, Method::kFragment))));
  EXPECT_FALSE(
      stats.add(*lamps_, pose_, samples(1.0 - 2.5e-4), moment(audit_bound(ImageLevel::kHalfNodes, Method::kFragment))));
  EXPECT_EQ(stats.json()["over_bound"], 0);
  EXPECT_GT(stats.json()["judged"], 20);
  EXPECT_GT(stats.json()["worst_of_bound"].get<double>(), 0.1);
}

TEST_F(Audit, FindsAPlantedErrorNamesItAndSaysItOnce) {
  AuditStats stats;
  const auto bound = audit_bound(ImageLevel::kFloatNodes, Method::kFragment);
  std::vector<AuditSample> planted = samples(1.0);
  planted[2].illuminance_lx *= 1.001;
  planted[4].illuminance_lx *= 1.01;
  const auto failure = stats.add(*lamps_, pose_, planted, moment(bound));
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->frame, 7);
  EXPECT_EQ(failure->x_px, 40);
  EXPECT_EQ(failure->y_px, 60);
  EXPECT_EQ(failure->lamp, "right");
  EXPECT_NEAR(failure->value_lx / failure->float64_lx, 1.001, 1e-9);
  EXPECT_LT(failure->bound_lx, 0.001 * failure->float64_lx);
  for (const char* word : {"frame 7", "pixel (40, 60)", "right", "float32-native-nodes"})
    EXPECT_NE(failure->text().find(word), std::string::npos) << failure->text();
  EXPECT_EQ(failure->text().find('\n'), std::string::npos);
  EXPECT_FALSE(stats.add(*lamps_, pose_, planted, moment(bound))) << "the first, ever";
  EXPECT_EQ(stats.json()["over_bound"], 4);
  EXPECT_EQ(stats.json()["first_over"]["frame"], 7);
}

// Light that is no number is within no bound.
TEST_F(Audit, NotANumberIsFound) {
  AuditStats stats;
  std::vector<AuditSample> planted = samples(1.0);
  planted.front().illuminance_lx = std::nan("");
  EXPECT_TRUE(stats.add(*lamps_, pose_, planted, moment(audit_bound(ImageLevel::kHalfEven, Method::kFragment))));
}

// In the cut-off a rounding of the direction is a per cent of the light and no error of the level.
TEST_F(Audit, ARoundingOfTheDirectionInTheCutOffIsNoError) {
  AuditStats stats;
  AuditSample sample;
  sample.point = {{3.0 + 25.0, 0.3, 0.7 - 25.0 * std::tan(0.5001 * 0.017453292519943295)}, {-1.0, 0.0, 0.0}};
  MeasurePoint rounded = sample.point;
  rounded.position_m.z -= 25.0 * 2.0 * 5.9604644775390625e-08;  // two roundings
  sample.illuminance_lx = lamps_->illuminance_lx(pose_, rounded);
  const double exact_lx = lamps_->illuminance_lx(pose_, sample.point);
  EXPECT_GT(std::abs(sample.illuminance_lx - exact_lx), 1e-4 * exact_lx) << "not steep enough to tell";
  EXPECT_FALSE(
      stats.add(*lamps_, pose_, std::vector{sample}, moment(audit_bound(ImageLevel::kFloatNodes, Method::kFragment))));
}

// A pixel's place that the device has off its triangle leaves more room, and one on another triangle does not.
TEST_F(Audit, APlaceOffItsTriangleIsMeasuredAndLeavesThatMuchRoom) {
  const Scene ground = ground_square(0.0);  // at z = 2 m
  pose_.z_m = 2.0;
  AuditMoment at = moment(audit_bound(ImageLevel::kFloatNodes, Method::kFragment));
  at.eye_m = {0.0, 0.0, 3.2};
  AuditSample sample;
  sample.point = {{7.0, 0.3, 2.0}, {0.0, 0.0, 1.0}};
  const double true_lx = lamps_->illuminance_lx(pose_, sample.point);
  ASSERT_GT(true_lx, 1.0);
  sample.point.position_m.z += 2e-5;  // as the device says it; its light is that of 4e-5 m elsewhere
  MeasurePoint elsewhere = sample.point;
  elsewhere.position_m.x += 4e-5;
  sample.illuminance_lx = lamps_->illuminance_lx(pose_, elsewhere);
  const double off = std::abs(sample.illuminance_lx / lamps_->illuminance_lx(pose_, sample.point) - 1.0);
  ASSERT_GT(off, 2e-5) << "too little to tell";
  AuditStats without, with, far;
  EXPECT_TRUE(without.add(*lamps_, pose_, std::vector{sample}, at)) << "by the level alone";
  at.scene = &ground;
  EXPECT_FALSE(with.add(*lamps_, pose_, std::vector{sample}, at));
  // What is seen there is another surface, 0.2 m in front: its distance is no error of the place.
  Scene in_front = ground;
  in_front.chunks[0].origin_m.z += 0.2, in_front.chunks[0].low_m.z += 0.2, in_front.chunks[0].high_m.z += 0.2;
  at.scene = &in_front;
  EXPECT_TRUE(far.add(*lamps_, pose_, std::vector{sample}, at));
}

// Where a surface turns by much from pixel to pixel, its normal has the room that interpolation leaves it.
TEST_F(Audit, ANormalThatTurnsFastHasRoom) {
  AuditSample sample;
  sample.point = {{7.0, 0.3, 0.0}, glm::normalize(glm::dvec3(-0.02, 0.0, 1.0))};
  MeasurePoint turned = sample.point;
  turned.normal = glm::normalize(sample.point.normal + glm::dvec3(3e-5, 0.0, 0.0));
  sample.illuminance_lx = lamps_->illuminance_lx(pose_, turned);
  const AuditMoment at = moment(audit_bound(ImageLevel::kFloatNodes, Method::kFragment));
  AuditStats flat, round;
  EXPECT_TRUE(flat.add(*lamps_, pose_, std::vector{sample}, at));
  sample.normal_room_rad = 4e-5;
  EXPECT_FALSE(round.add(*lamps_, pose_, std::vector{sample}, at));
}

TEST(AuditBounds, ByVertexNoneIsStatedAndTheUsersHoldsEverywhere) {
  EXPECT_FALSE(audit_bound(ImageLevel::kFloatNodes, Method::kVertex));
  EXPECT_FALSE(audit_bound(ImageLevel::kFloatNodes, Method::kVertex1998));
  // Float64 whatever way the other methods store the beam.
  for (const ImageLevel level : kImageLevels) EXPECT_EQ(audit_bound(level, Method::kReference)->relative, 1e-6);
  const auto asked = audit_bound(ImageLevel::kNormalised8, Method::kVertex1998, 0.02);
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->relative, 0.02);
  EXPECT_EQ(asked->of_peak, 0.0);
  // A finer level states less.
  const auto relative = [](ImageLevel level) { return audit_bound(level, Method::kFragment)->relative; };
  EXPECT_LT(relative(ImageLevel::kFloatNodes), relative(ImageLevel::kHalfNodes));
}

}  // namespace
}  // namespace phare
