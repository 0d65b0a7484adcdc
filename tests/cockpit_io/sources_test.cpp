// Sources: the log's timing and fail-safe, real CAN numbers, a socket on a kernel without CAN.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cockpit_io/can_socket.h"
#include "cockpit_io/candump.h"
#include "cockpit_io/drive_source.h"
#include "cockpit_io/latency.h"
#include "cockpit_io/log_source.h"
#include "cockpit_io/text_scanner.h"
#include "net/drive_file.h"
#include "net/wire.h"
#include "tests/paths.h"

namespace phare {
namespace {

const std::filesystem::path kCockpits = cockpits_dir();
const std::filesystem::path kShared = shared_data_dir();

Moment at_ms(std::int64_t ms) {
  return {SimTime{ms * 1'000'000}, WallTime{1'000'000'000 + ms * 1'000'000}};
}

SignalMap stalk_map() {
  const auto config = parse_cockpit(
      "[source]\nkind = \"log\"\ntimeout_s = 0.2\n[control.light_switch]\nmessage = \"BEAM_STALK\"\nsignal = "
      "\"BEAM_SWITCH\"\n"
      "levels = { off = 0, position = 1, low = 2, high = 3 }\n[control.flash]\nmessage = \"BEAM_STALK\"\nsignal = "
      "\"FLASH\"\n",
      "c.toml");
  return *SignalMap::bind(*config, *read_dbc(kCockpits / "phare_stalk.dbc"), 0);
}

TEST(LogSource, OfSeveralBusesThatOfTheCockpitFileIsPlayed) {
  const auto folder = std::filesystem::temp_directory_path() / ("phare-buses-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "any.log") << "(1.000) can0 500#0200000000000000\n(1.001) can1 500#0000000000000000\n";
  const auto light_of = [&](const std::string& interface, bool asked) -> std::string {
    auto config = parse_cockpit("[source]\nkind = \"log\"\n" + interface +
                                    "[control.light_switch]\nmessage = \"BEAM_STALK\"\nsignal = \"BEAM_SWITCH\"\n"
                                    "levels = { off = 0, position = 1, low = 2, high = 3 }\n",
                                (folder / "c.toml").string());
    if (!config) return config.error().text();
    config->dbc_file = kCockpits / "phare_stalk.dbc";
    config->input_file = folder / "any.log";
    config->interface_is_asked = asked;
    auto source = open_source(*config);
    if (!source) return source.error().reason;
    Cockpit cockpit({20'000'000, 2}, "log");
    (*source)->advance(at_ms(0), nullptr, cockpit);
    (*source)->advance(at_ms(30), nullptr, cockpit);
    return cockpit.state(-1, false).light_switch == LightSwitch::kLow ? "low" : "off";
  };
  EXPECT_EQ(light_of("", false), "off") << "both, the newest counts";
  EXPECT_EQ(light_of("interface = \"can0\"\n", false), "low");
  EXPECT_EQ(light_of("interface = \"can1\"\n", false), "off");
  EXPECT_EQ(light_of("interface = \"can7\"\n", true), "no frame comes from can7, but from can0 and can1");
  std::filesystem::remove_all(folder);
}

TEST(LogSource, PlaysByTheStampAndNotByTheTick) {
  LogSource source(
      *parse_candump(
          "(50.000) can0 500#0200000000000000\n(50.105) can0 500#0300000000000000\n"
          "(50.200) can0 500#0300000000000000\n(50.210) can0 7FF#\nbad\n(50.400) can0 20000040#0000000000000000\n",
          "l"),
      stalk_map());
  Cockpit cockpit({20'000'000, 2}, "log");
  source.advance(at_ms(0), nullptr, cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  source.advance(at_ms(104), nullptr, cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  source.advance(at_ms(120), nullptr, cockpit);
  const CockpitState state = cockpit.state(7, false);
  EXPECT_EQ(state.light_switch, LightSwitch::kHigh);
  EXPECT_EQ(state.light_change_sim, at_ms(105).sim);
  EXPECT_EQ(state.light_change_wall, at_ms(105).wall);
  EXPECT_EQ(state.light_changes, 2u);
  EXPECT_FALSE(source.ended());

  // The newest mapped frame is at 200 ms: silent from 400 ms on, whatever else is on the bus.
  source.advance(at_ms(399), nullptr, cockpit);
  EXPECT_FALSE(cockpit.state(-1, false).fail_safe);
  source.advance(at_ms(410), nullptr, cockpit);
  EXPECT_TRUE(cockpit.state(-1, false).fail_safe);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  EXPECT_EQ(cockpit.state(-1, false).light_change_sim, at_ms(400).sim);
  EXPECT_TRUE(source.ended());
  EXPECT_EQ(source.counts().frames_read, 5u);
  EXPECT_EQ(source.counts().decoded, 3u);
  EXPECT_EQ(source.counts().unknown_ids, 1u);
  EXPECT_EQ(source.counts().error_frames, 1u);
  EXPECT_EQ(source.counts().broken_lines, 1u);
  EXPECT_EQ(source.counts().fail_safes, 1u);
}

TEST(LogSource, TheTickDoesNotChangeWhatComesOut) {
  const char* text =
      "(1.000) c 500#0200000000000000\n(1.050) c 500#0600000000000000\n(1.051) c 500#0200000000000000\n"
      "(1.500) c 500#0300000000000000\n(1.600) c 500#0200000000000000\n";
  std::vector<CockpitState> ends;
  for (const std::int64_t tick_ms : {1, 7, 10, 50}) {
    LogSource source(*parse_candump(text, "l"), stalk_map());
    Cockpit cockpit({20'000'000, 2}, "log");
    for (std::int64_t ms = 0; ms <= 700; ms += tick_ms) source.advance(at_ms(ms), nullptr, cockpit);
    ends.push_back(cockpit.state(-1, source.ended()));
  }
  for (const CockpitState& end : ends) EXPECT_EQ(end, ends.front());
  EXPECT_EQ(ends.front().light_changes, 5u);  // low, flash, no flash (debounced), high, low; fail-safe is low as before
}

TEST(LogSource, ARefusedFrameIsCountedAndShown) {
  const auto config = parse_cockpit(
      "[source]\nkind = \"log\"\n[control.flash]\nmessage = \"BEAM_STALK\"\nsignal = \"FLASH\"\n"
      "[check.BEAM_STALK]\ncounter = \"COUNTER\"\n",
      "c.toml");
  ASSERT_TRUE(config.ok()) << config.error().text();
  LogSource source(*parse_candump("(5.000) c 500#0400000000000001\n(5.050) c 500#0000000000000001\n"
                                  "(5.100) c 500#0400000000000004\n(9.000) c 123#\n",
                                  "l"),
                   *SignalMap::bind(*config, *read_dbc(kCockpits / "phare_stalk.dbc"), 0));
  Cockpit cockpit({20'000'000, 2}, "log");
  source.advance(at_ms(40), nullptr, cockpit);
  EXPECT_EQ(source.fault(), "");
  source.advance(at_ms(120), nullptr, cockpit);
  EXPECT_TRUE(cockpit.state(-1, false).flash) << "the frozen frame was not read";
  EXPECT_EQ(source.counts().bad_counter, 1u);
  EXPECT_EQ(source.counts().lost_in_data, 2u);
  EXPECT_EQ(source.fault(), "log: BEAM_STALK refused: its counter stands still or jumps");
  source.advance(at_ms(3000), nullptr, cockpit);
  EXPECT_EQ(source.fault(), "log: BEAM_STALK silent");
}

TEST(LogSource, PlaysFasterWithItsTimeoutsInTheLogsTime) {
  const auto config = parse_cockpit(
      "[source]\nkind = \"log\"\ntimeout_s = 0.2\nspeed = 4.0\n[control.light_switch]\nmessage = "
      "\"BEAM_STALK\"\nsignal = "
      "\"BEAM_SWITCH\"\nlevels = { off = 0, position = 1, low = 2, high = 3 }\n",
      "c.toml");
  ASSERT_TRUE(config.ok()) << config.error().text();
  LogSource source(*parse_candump("(5.000) c 500#0200000000000000\n(5.100) c 500#0300000000000000\n"
                                  "(5.200) c 500#0300000000000000\n(9.000) c 123#\n",
                                  "l"),
                   *SignalMap::bind(*config, *read_dbc(kCockpits / "phare_stalk.dbc"), 0));
  Cockpit cockpit({20'000'000, 2}, "log");
  source.advance(at_ms(24), nullptr, cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  source.advance(at_ms(26), nullptr, cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kHigh);
  EXPECT_EQ(cockpit.state(-1, false).light_change_sim, at_ms(25).sim);
  source.advance(at_ms(99), nullptr, cockpit);
  EXPECT_FALSE(cockpit.state(-1, false).fail_safe);
  source.advance(at_ms(150), nullptr, cockpit);
  EXPECT_TRUE(cockpit.state(-1, false).fail_safe) << "200 ms of the log after its newest frame: 100 ms here";
  EXPECT_EQ(cockpit.state(-1, false).light_change_sim, at_ms(100).sim);
  source.advance(at_ms(1000), nullptr, cockpit);
  EXPECT_TRUE(source.ended());
}

TEST(Cockpit, PedalsFadeWhenTheSourceIsSilent) {
  Cockpit cockpit({20'000'000, 1}, "can0");
  DriverInput input;
  input.accelerator_01 = 0.8;
  input.steering_wheel_rad = 0.3;
  cockpit.take(input, false, at_ms(1000));
  EXPECT_DOUBLE_EQ(cockpit.state(-1, false).accelerator_01, 0.8);
  cockpit.take(input, true, at_ms(1500));
  cockpit.take(input, true, at_ms(2000));
  EXPECT_NEAR(cockpit.state(-1, false).accelerator_01, 0.4, 1e-9);
  cockpit.take(input, true, at_ms(9000));
  EXPECT_EQ(cockpit.state(-1, false).accelerator_01, 0.0);
  EXPECT_DOUBLE_EQ(cockpit.state(-1, false).steering_wheel_rad, 0.3);
  cockpit.take(input, false, at_ms(9100));
  EXPECT_DOUBLE_EQ(cockpit.state(-1, false).accelerator_01, 0.8);
}

TEST(RealDrive, SpeedAndSteeringAgreeWithTheDecodedTable) {
  const auto folder = kShared / "drives/comma2k19";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const Dbc dbc = *read_dbc(kShared / "dbc/opendbc/toyota_nodsu_pt_generated.dbc");
  const CandumpLog log = *read_candump(folder / "rav4_seg40_bus0_00-30s.candump.log");
  const DbcMessage& wheels = *dbc.find("WHEEL_SPEEDS");
  const DbcMessage& angle = *dbc.find("STEER_ANGLE_SENSOR");
  const auto value = [](const DbcMessage& message, const char* name, const CanFrame& frame) {
    return decode(message, *message.find(name), frame).value_or(NAN);
  };

  // The table gives steering at the stamps of the wheel speeds, linearly between its own frames.
  std::vector<std::pair<double, double>> steering;  // s, degrees
  for (const CandumpEntry& e : log.entries) {
    if (e.frame.id != angle.id) continue;
    steering.emplace_back(static_cast<double>(e.stamp_ns) * 1e-9,
                          value(angle, "STEER_ANGLE", e.frame) + value(angle, "STEER_FRACTION", e.frame));
  }
  const auto steering_deg = [&](double t_s) {
    const auto after = std::upper_bound(steering.begin(), steering.end(), std::pair(t_s, 1e9));
    if (after == steering.begin()) return after->second;
    if (after == steering.end()) return steering.back().second;
    const auto before = after - 1;
    return before->second + (t_s - before->first) / (after->first - before->first) * (after->second - before->second);
  };

  std::ifstream table(folder / "rav4_seg40_can_decoded_00-30s.csv");
  std::string line;
  std::getline(table, line);
  double worst_mps = 0.0, worst_deg = 0.0;
  std::size_t rows = 0, entry = 0;
  while (std::getline(table, line)) {
    TextScanner scan(line);
    const double t_s = *scan.number<double>();
    scan.take(',');
    const double speed_mps = *scan.number<double>();
    scan.take(',');
    const double wheel_deg = *scan.number<double>();
    double decoded_mps = NAN;
    for (; entry < log.entries.size() && std::isnan(decoded_mps); ++entry) {
      const CanFrame& frame = log.entries[entry].frame;
      if (frame.id != wheels.id) continue;
      decoded_mps = 0.0;
      for (const char* wheel : {"WHEEL_SPEED_FR", "WHEEL_SPEED_FL", "WHEEL_SPEED_RR", "WHEEL_SPEED_RL"}) {
        decoded_mps += value(wheels, wheel, frame) / 3.6 / 4.0;
      }
      EXPECT_NEAR(static_cast<double>(log.entries[entry].stamp_ns) * 1e-9, t_s, 1e-4);
    }
    worst_mps = std::max(worst_mps, std::abs(decoded_mps - speed_mps));
    worst_deg = std::max(worst_deg, std::abs(steering_deg(t_s) - wheel_deg));
    ASSERT_FALSE(std::isnan(decoded_mps)) << line;
    ++rows;
  }
  std::printf("%zu rows: speed within %.2g m/s, steering within %.2g degrees\n", rows, worst_mps, worst_deg);
  EXPECT_EQ(rows, 2487u);
  EXPECT_LE(worst_mps, 0.01);
  EXPECT_LE(worst_deg, 0.1);
}

TEST(RealDrive, TheToyotaCockpitPlaysTheLog) {
  const auto folder = kShared / "drives/comma2k19";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const auto config = read_cockpit(kCockpits / "toyota_rav4.toml");
  LogSource source(*read_candump(folder / "rav4_seg40_bus0_00-30s.candump.log"),
                   *SignalMap::bind(*config, *read_dbc(kShared / "dbc/opendbc/toyota_nodsu_pt_generated.dbc"), 0));
  Cockpit cockpit({20'000'000, 2}, "log");
  double most_deg = 0.0, most_accelerator = 0.0;
  for (std::int64_t ms = 0; !source.ended() && ms < 40'000; ms += 10) {
    source.advance(at_ms(ms), nullptr, cockpit);
    const CockpitState state = cockpit.state(-1, source.ended());
    EXPECT_FALSE(state.fail_safe) << ms << " ms";
    EXPECT_EQ(state.light_switch, LightSwitch::kOff);  // the light stalk stays off throughout
    most_deg = std::max(most_deg, std::abs(state.steering_wheel_rad) * 180.0 / std::numbers::pi);
    most_accelerator = std::max(most_accelerator, state.accelerator_01);
  }
  EXPECT_TRUE(source.ended());
  EXPECT_EQ(source.counts().frames_read, 26904u);
  EXPECT_EQ(source.counts().incomplete, 0u);
  EXPECT_EQ(source.counts().bad_crc, 0u);  // GAS_PEDAL's checksum is checked
  EXPECT_GT(source.counts().decoded, 3000u);
  EXPECT_GT(most_deg, 1.0);
  EXPECT_GT(most_accelerator, 0.05);
  std::printf("decoded %llu, unknown ids %llu, steering up to %.1f degrees, accelerator up to %.2f\n",
              static_cast<unsigned long long>(source.counts().decoded),
              static_cast<unsigned long long>(source.counts().unknown_ids), most_deg, most_accelerator);
}

TEST(DriveSource, PlaysTheRecordedControlsToTheEndOfTheDrive) {
  const auto file =
      std::filesystem::temp_directory_path() / ("phare_drive_source_test_" + std::to_string(getpid()) + ".pcap");
  {
    auto writer = DriveWriter::create(file, 47000);
    ASSERT_TRUE(writer.ok()) << writer.error().text();
    const auto write = [&](std::int64_t ms, Sender sender, std::uint64_t sequence, const Payload& payload) {
      const Datagram datagram{sender, 0, 77, sequence, at_ms(ms).sim, at_ms(ms).wall, payload};
      const std::string bytes = encode(datagram);
      ASSERT_TRUE(writer->write(datagram, std::as_bytes(std::span(bytes))).ok());
    };
    CockpitState state;
    state.light_switch = LightSwitch::kLow;
    state.steering_wheel_rad = 0.5;
    write(0, Sender::kCockpit, 1, state);
    state.light_switch = LightSwitch::kHigh;
    state.design_index = 7;
    write(105, Sender::kCockpit, 2, state);
    VehicleState pose;
    pose.level = "pose";
    write(300, Sender::kDynamics, 1, pose);
  }
  auto source = DriveSource::open(file);
  ASSERT_TRUE(source.ok()) << source.error().text();
  Cockpit cockpit({20'000'000, 2}, "drive");
  (*source)->advance(at_ms(104), nullptr, cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  EXPECT_DOUBLE_EQ(cockpit.state(-1, false).steering_wheel_rad, 0.5);
  (*source)->advance(at_ms(120), nullptr, cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kHigh);
  EXPECT_EQ(cockpit.state(-1, false).design_index, 0u) << "the rig has no design 7, and none is taken in its place";
  EXPECT_EQ(cockpit.unknown_design(), 7u);
  EXPECT_EQ(cockpit.state(-1, false).light_change_sim, at_ms(105).sim);
  EXPECT_EQ(cockpit.state(-1, false).light_changes, 2u);
  EXPECT_FALSE((*source)->ended());
  (*source)->advance(at_ms(300), nullptr, cockpit);
  EXPECT_TRUE((*source)->ended());
  std::filesystem::remove(file);
}

TEST(CanSocket, AKernelWithoutCanIsNamed) {
  const auto supported = can_supported();
  if (supported.ok()) {
    const auto missing = CanSocket::open("phare-none", {});
    ASSERT_FALSE(missing.ok());
    EXPECT_NE(missing.error().reason.find("no such interface"), std::string::npos);
  } else {
    EXPECT_NE(supported.error().reason.find("CAN"), std::string::npos);
    EXPECT_FALSE(CanSocket::open("can0", {}).ok());
    std::printf("this machine: %s\n", supported.error().text().c_str());
  }
}

TEST(Latency, QuantilesAreUpperEdgesOfBins) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.quantile_ns(0.5), 0);
  for (int i = 1; i <= 100; ++i) histogram.add(i * 100'000 - 1);
  EXPECT_EQ(histogram.quantile_ns(0.5), 5'100'000 - 0);
  EXPECT_EQ(histogram.quantile_ns(0.99), 9'999'999);
  EXPECT_EQ(histogram.most_ns(), 9'999'999);
}

}  // namespace
}  // namespace phare
