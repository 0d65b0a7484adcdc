// process: three pictures of one rig in real time and in lockstep. No two show different moments, and where they meet
// there is no seam.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "config/rig.h"
#include "net/drive_file.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"
#include "visual/image/image.h"
#include "visual/process/cameras.h"

namespace phare::test {
namespace {

using nlohmann::json;

std::string rig_file() {
  return source_dir() + "/config/rigs/three_channels.toml";
}
constexpr std::array<std::size_t, 3> kFromLeft{1, 0, 2};  // the first of the rig looks ahead
std::string demo_drive() {
  return source_dir() + "/config/drives/country_road.pcap";
}

// Edges of neighbours are the same rays at every height of the picture, whatever the car does; counted in pixels.
TEST(Channels, MeetWithoutASeam) {
  const auto rig = read_rig(rig_file());
  ASSERT_TRUE(rig) << rig.error().text();
  ASSERT_EQ(rig->channels.size(), 3u);
  VehicleState pose;
  pose.x_m = 3000.0, pose.y_m = -70.0, pose.z_m = 12.0;
  pose.yaw_rad = 2.1, pose.pitch_rad = -0.03, pose.roll_rad = 0.05;
  constexpr int kWidth = 1280, kHeight = 720;
  double most_px = 0.0, degrees = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    degrees += rig->channels[kFromLeft[i]].fov_horizontal_rad * 180.0 / M_PI;
    if (i == 2) break;
    const double aspect = static_cast<double>(kWidth) / kHeight;
    const ViewGeometry left(driver_camera(rig->channels[kFromLeft[i]], pose), aspect),
        right(driver_camera(rig->channels[kFromLeft[i + 1]], pose), aspect);
    EXPECT_EQ(left.camera().eye_m, right.camera().eye_m);
    for (int y = 0; y < kHeight; ++y) {
      // Half a pixel beyond the last and before the first: the edge itself.
      const glm::dvec3 a = left.ray_through(kWidth - 0.5, y, kWidth, kHeight).direction,
                       b = right.ray_through(-0.5, y, kWidth, kHeight).direction;
      const double pixel_rad =
          glm::length(right.ray_through(0.5, y, kWidth, kHeight).direction - b);  // between two neighbours
      most_px = std::max(most_px, glm::length(a - b) / pixel_rad);
    }
  }
  std::printf("rays at the seams: %.2g pixel apart at the most\n", most_px);
  EXPECT_LT(most_px, 1e-9) << "asked: 0.01";
  EXPECT_NEAR(degrees, 150.0, 1e-9);
}

// A column at the seam differs from its neighbour in the other picture as from that in its own.
TEST(Channels, TheLightGoesOnAcrossTheSeam) {
  const TemporaryFolder folder;
  ASSERT_EQ(drive(folder / "out", folder.path(),
                  {"--rig", rig_file(), "--drive", demo_drive(), "--frames", "2", "--size", "320x180", "--set",
                   "instruments=off", "--set", "lines=off"}),
            0);
  std::array<Image8, 3> pictures;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr std::array<const char*, 3> kOut{"out/left", "out", "out/right"};
    auto picture = read_png(folder / (std::string(kOut[i]) + "/frames/000001.png"));
    ASSERT_TRUE(picture) << picture.error().text();
    pictures[i] = std::move(*picture);
  }
  const auto channel_of = [](const Image8& image, int x, int y, int c) {
    return int{image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
                               static_cast<std::size_t>(x)) +
                          static_cast<std::size_t>(c)]};
  };
  const auto step_between = [&](const Image8& a, int at, const Image8& b, int bt) {
    double sum = 0.0;
    for (int y = 0; y < a.height_px; ++y)
      for (int c = 0; c < 3; ++c) sum += std::abs(channel_of(a, at, y, c) - channel_of(b, bt, y, c));
    return sum / (3.0 * a.height_px);
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const Image8 &left = pictures[i], &right = pictures[i + 1];
    const int last = left.width_px - 1;
    const double seam = step_between(left, last, right, 0);
    const double within = std::max(step_between(left, last - 1, left, last), step_between(right, 0, right, 1));
    std::printf("seam %zu: %.2f of 255, within the pictures %.2f\n", i, seam, within);
    EXPECT_GT(within, 0.0) << "something is lit there";
    EXPECT_LT(seam, 2.0 * within + 0.5);
  }
}

// Counted in the reports of all three, which say of which time their picture is.
TEST(Channels, ShowTheSameMomentInRealTime) {
  const TemporaryFolder folder;
  DriveRun run(folder / "out", folder.path(),
               {"--rig", rig_file(), "--drive", demo_drive(), "--frames", "60", "--record", folder / "drive.pcap"},
               false);
  ASSERT_EQ(run.wait(), 0);
  const json report = report_of(folder / "out");
  const json& first = report["processes"]["visual-0"];
  const auto together = first["frame_lock"]["together"].get<std::uint64_t>(),
             apart = first["frame_lock"]["apart"].get<std::uint64_t>();
  for (const char* other : {"visual-1", "visual-2"})
    std::printf("%s: %s\n", other, report["processes"][other]["frame_lock"].dump().c_str());
  const auto recorded = read_drive(folder / "drive.pcap");
  ASSERT_TRUE(recorded) << recorded.error().text();
  std::map<std::int64_t, std::set<std::uint32_t>> drawn;  // by simulated time
  std::uint64_t begun = 0;
  for (const Datagram& datagram : recorded->datagrams) {
    const auto* picture = std::get_if<FrameReport>(&datagram.payload);
    if (picture == nullptr || datagram.sim_time.ns == 0 || picture->start == 0) continue;
    drawn[datagram.sim_time.ns].insert(picture->channel);
    begun += picture->channel == 0 ? 1 : 0;
  }
  std::size_t all_three = 0;
  for (const auto& [time, channels] : drawn) all_three += channels.size() == 3 ? 1 : 0;
  std::printf("%llu frames: %llu together, %llu apart; by their reports %zu moments, %zu shown by all three\n",
              static_cast<unsigned long long>(begun), static_cast<unsigned long long>(together),
              static_cast<unsigned long long>(apart), drawn.size(), all_three);
  // A picture of a busy machine may take longer than the first waits: then it is counted there.
  EXPECT_GT(together, 30u);
  EXPECT_GE(all_three + apart + 2, drawn.size()) << "and the frames in which the drive ends";
}

}  // namespace
}  // namespace phare::test
