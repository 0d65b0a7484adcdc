// Level pose against a sampled analytic path.
#include "vehicle_dynamics/models/pose.h"

#include <cmath>
#include <numbers>

#include "test_car.h"

namespace phare {
namespace {

using test::seconds;

// A circle of 30 m at 15 m/s with a wavy height: 7.5 m/s2 sideways, sharper than a road.
VehicleState on_circle(double t) {
  const double w = 0.5, r = 30.0;
  VehicleState s;
  s.x_m = r * std::sin(w * t);
  s.y_m = r * (1.0 - std::cos(w * t));
  s.z_m = std::sin(t);
  s.yaw_rad = std::remainder(w * t, 2.0 * std::numbers::pi);
  s.pitch_rad = 0.02 * std::sin(3.0 * t);
  s.speed_mps = 15.0;
  return s;
}

Datagram record(double t, const VehicleState& state) {
  Datagram datagram;
  datagram.sender = Sender::kDynamics;
  datagram.sim_time = seconds(t);
  datagram.payload = state;
  return datagram;
}

PoseTrack sampled(double rate_hz, double duration_s) {
  std::vector<Datagram> datagrams;
  for (int i = 0; i <= static_cast<int>(duration_s * rate_hz); ++i)
    datagrams.push_back(record(i / rate_hz, on_circle(i / rate_hz)));
  return PoseTrack::from_drive(datagrams);
}

double worst_position_m(double rate_hz) {
  const PoseTrack track = sampled(rate_hz, 20.0);
  double worst = 0.0;
  for (double t = 0.0; t < 20.0; t += 0.0007) {
    const VehicleState got = track.at(seconds(t)), want = on_circle(t);
    worst = std::max(worst, std::hypot(got.x_m - want.x_m, got.y_m - want.y_m, got.z_m - want.z_m));
    EXPECT_NEAR(std::remainder(got.yaw_rad - want.yaw_rad, 2.0 * std::numbers::pi), 0.0, 1e-6);
    EXPECT_NEAR(got.pitch_rad, want.pitch_rad, 1.5e-5);  // budget: 0.02 mrad
  }
  return worst;
}

TEST(PoseTrack, SampledCircleWithinItsErrorBound) {
  // Slopes off by h^2 f'''/6, so the curve by at most h/4 of that: h^3 f'''/24 with |f'''| < 4 m/s3 (30 w^3 and 1 from
  // z).
  const double at_60 = worst_position_m(60.0), at_20 = worst_position_m(20.0);
  std::printf("pose error: %.3g m at 60 Hz, %.3g m at 20 Hz\n", at_60, at_20);
  EXPECT_LT(at_60, std::pow(1.0 / 60.0, 3) * 4.0 / 6.0);
  EXPECT_LT(at_20, std::pow(1.0 / 20.0, 3) * 4.0 / 6.0);
  EXPECT_LT(at_60, at_20 / 20.0);  // third order: a factor 27
}

TEST(PoseTrack, HitsItsRecords) {
  const PoseTrack track = sampled(60.0, 3.0);
  for (int i = 0; i < 180; ++i) EXPECT_EQ(track.at(seconds(i / 60.0)).x_m, on_circle(i / 60.0).x_m);
}

TEST(PoseTrack, YawGoesTheShortWayThroughPi) {
  VehicleState a, b;
  a.yaw_rad = 3.1, b.yaw_rad = -3.1;
  const PoseTrack track = PoseTrack::from_drive(std::vector{record(0.0, a), record(0.1, b)});
  EXPECT_NEAR(std::abs(track.at(seconds(0.05)).yaw_rad), std::numbers::pi, 1e-9);
}

TEST(PoseTrack, HoldsBeyondItsEnds) {
  const PoseTrack track = sampled(60.0, 2.0);
  EXPECT_EQ(track.at(SimTime{-5}).x_m, on_circle(0.0).x_m);
  EXPECT_FALSE(track.at(SimTime{-5}).drive_ended);
  EXPECT_FALSE(track.at(SimTime{track.end().ns - 1}).drive_ended);
  EXPECT_TRUE(track.at(track.end()).drive_ended);
  const VehicleState beyond = track.at(seconds(100.0));
  EXPECT_TRUE(beyond.drive_ended);
  EXPECT_EQ(beyond.x_m, on_circle(2.0).x_m);
  EXPECT_EQ(beyond.speed_mps, 0.0);
  EXPECT_TRUE(PoseTrack().at(SimTime{}).drive_ended);
}

TEST(PoseTrack, GoesStraightThroughAGap) {
  VehicleState a, b, c;
  a.x_m = 0.0, b.x_m = 1.0, c.x_m = 101.0;
  const PoseTrack track = PoseTrack::from_drive(std::vector{record(0.0, a), record(0.1, b), record(10.1, c)});
  EXPECT_NEAR(track.at(seconds(5.1)).x_m, 51.0, 1e-9);
  EXPECT_LE(track.at(seconds(0.05)).x_m, 1.0);
}

TEST(PoseTrack, UnorderedAndDoubledRecordsDoNoHarm) {
  std::vector<Datagram> datagrams;
  for (const int i : {3, 1, 1, 0, 2, 2, 5, 4}) datagrams.push_back(record(i * 0.1, on_circle(i * 0.1)));
  const PoseTrack track = PoseTrack::from_drive(datagrams);
  for (double t = 0.0; t < 0.5; t += 0.01) EXPECT_NEAR(track.at(seconds(t)).x_m, on_circle(t).x_m, 1e-3);
}

TEST(PoseTrack, ReplaysThroughTheLoopAtTheExactTime) {
  RunSetup setup;
  setup.level = Level::kPose;
  setup.track = sampled(60.0, 2.0);
  StepLoop loop(setup, CarState{});
  for (std::int64_t frame = 0; frame <= 120; ++frame) {
    loop.run_to(frame_time(frame, 60));
    const VehicleState out = loop.at(frame_time(frame, 60));
    EXPECT_NEAR(out.x_m, on_circle(static_cast<double>(frame) / 60.0).x_m, 1e-7);
    EXPECT_EQ(out.level, "pose");
  }
}

}  // namespace
}  // namespace phare
