// process: a drive in a window on a virtual display, with keys pressed in it. What came of them stands in the
// recording.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <thread>

#include "net/drive_file.h"
#include "net/wire.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"
#include "tests/process/gpu_fault.h"
#include "tools/virtual_display.h"
#include "visual/process/panel.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

bool wait_until(const std::function<bool()>& true_at_last) {
  for (const auto until = Clock::now() + kPatience; Clock::now() < until; std::this_thread::sleep_for(50ms))
    if (true_at_last()) return true;
  return false;
}

/// A display that is looked at and typed into.
class TypedDisplay : public VirtualDisplay {
 public:
  static bool possible() { return VirtualDisplay::possible() && find_in_path("xdotool"); }

  /// What it shows, rows from the top: XWD version 7, 4 bytes a pixel, blue first, as Xvfb keeps it on a
  /// little-endian machine. Empty: it cannot be read.
  std::vector<std::array<int, 3>> screen() const {
    std::stringstream file;
    file << std::ifstream(screen_file(), std::ios::binary).rdbuf();
    const std::string bytes = file.str();
    const auto word = [&](std::size_t i) {  // of the header, most significant byte first
      std::uint32_t value = 0;
      for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[4 * i + k]);
      return std::size_t{value};
    };
    if (bytes.size() < 100 || word(1) != 7 || word(4) != kWidth_px || word(5) != kHeight_px || word(11) != 32)
      return {};
    const std::size_t begin = word(0) + 12 * word(19), row = word(12);
    if (bytes.size() < begin + row * kHeight_px) return {};
    std::vector<std::array<int, 3>> pixels;
    for (std::size_t y = 0; y < kHeight_px; ++y) {
      for (std::size_t x = 0; x < kWidth_px; ++x) {
        const char* at = bytes.data() + begin + y * row + 4 * x;
        const auto channel = [&](int k) { return static_cast<int>(static_cast<unsigned char>(at[k])); };
        pixels.push_back({channel(2), channel(1), channel(0)});
      }
    }
    return pixels;
  }
  /// Words of xdotool, the window of Phare having the focus.
  void keys(const std::string& words) const {
    const std::string line = "DISPLAY=" + name() +
                             " timeout 60 xdotool search --sync --onlyvisible --name '^Phare$' windowfocus " + words +
                             " >/dev/null 2>&1";
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
  }
};

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!TypedDisplay::possible()) GTEST_SKIP() << "no Xvfb, or no xdotool";
    display_.emplace();
  }
  void TearDown() override {
    if (!drive_ || drive_->ended()) return;
    drive_->send_signal(SIGKILL);
    while (!drive_->ended()) std::this_thread::sleep_for(5ms);
  }

  void start(std::vector<std::string> arguments, const std::string& size = "320x180", bool kept = true) {
    std::vector<std::string> words{
        "-u", "WAYLAND_DISPLAY", "DISPLAY=" + display_->name(), program("phare"), "drive", "--size",
        size, "--port-base",     std::to_string(port_base()),   "--log-level",    "error"};
    if (kept)
      words.insert(words.end(), {"--out", (folder_ / "out").string(), "--record", (folder_ / "d.pcap").string()});
    words.insert(words.end(), arguments.begin(), arguments.end());
    auto child = ChildProcess::start("/usr/bin/env", words);
    ASSERT_TRUE(child.ok());
    drive_ = *child;
  }
  int end() {
    EXPECT_TRUE(wait_until([&] { return drive_->ended().has_value(); }));
    const auto end = drive_->ended();
    return end && end->signal == 0 ? end->exit_code : -1;
  }

  std::vector<Datagram> recorded(const char* file = "d.pcap") const {
    const auto drive = read_drive(folder_ / file);
    return drive ? drive->datagrams : std::vector<Datagram>{};
  }
  /// Waits until a message of this type says so.
  template <class T>
  bool comes(const std::function<bool(const T&)>& said, const char* file = "d.pcap") {
    return wait_until([&] {
             for (const Datagram& datagram : recorded(file)) {
               const T* message = std::get_if<T>(&datagram.payload);
               if (message != nullptr && said(*message)) return true;
             }
             return drive_->ended().has_value();
           }) &&
           !drive_->ended();
  }

  TemporaryFolder folder_;
  std::optional<TypedDisplay> display_;
  std::optional<ChildProcess> drive_;
};

TEST_F(WindowTest, APersonDrivesWithTheKeysOfTheWindow) {
  start({});
  ASSERT_TRUE(comes<VehicleState>([](const VehicleState&) { return true; }));
  display_->keys("keydown Up");
  EXPECT_TRUE(comes<VehicleState>([](const VehicleState& car) { return car.speed_mps > 3.0; })) << "it moves";
  display_->keys("keyup Up key h");
  EXPECT_TRUE(comes<CockpitState>([](const CockpitState& c) { return c.light_switch == LightSwitch::kHigh; }));
  display_->keys("keydown Left");
  EXPECT_TRUE(comes<CockpitState>([](const CockpitState& c) { return c.steering_wheel_rad > 0.1; }));
  display_->keys("keyup Left key d");
  EXPECT_TRUE(comes<CockpitState>([](const CockpitState& c) { return c.source == "demo"; }));
  display_->keys("key F1 key Escape key Escape");  // help, away with it, leave
  EXPECT_EQ(end(), 0);

  // A live drive begins with the picture: nothing moved before every visual said that it is ready, the car stood at
  // simulated time 0, and the first picture shows it as it was then.
  bool ready = false, moved = false, drawn = false;
  for (const Datagram& datagram : recorded()) {
    const auto* report = std::get_if<FrameReport>(&datagram.payload);
    if (report != nullptr && report->drawn.level.empty()) ready = true;
    if (std::holds_alternative<VehicleState>(datagram.payload) && !moved) {
      moved = true;
      EXPECT_TRUE(ready) << "the car began before the picture";
    }
    EXPECT_TRUE(ready || !std::holds_alternative<CockpitState>(datagram.payload));
    if (report != nullptr && !report->drawn.level.empty() && !drawn) {
      drawn = true;
      EXPECT_FALSE(report->pose_stale);
    }
  }
  EXPECT_TRUE(drawn);
  const nlohmann::json report = report_of(folder_ / "out");
  EXPECT_GE(report["summary"]["switch_to_photon"]["changes"].get<int>(), 1);
  EXPECT_EQ(report["processes"]["cockpit"]["source"]["name"], "keyboard");
}

TEST_F(WindowTest, LampsAreMovedByKeysAndAClickReadsAPoint) {
  start({});
  ASSERT_TRUE(comes<VehicleState>([](const VehicleState&) { return true; }));
  display_->keys("key m key Prior key Prior key End");  // the pair of headlamps, 2 cm up; all lamps down
  EXPECT_TRUE(comes<LampState>([](const LampState& lamps) {
    return lamps.z_m.size() == 4 && std::abs(lamps.z_m[0] - 0.68) < 1e-9 && std::abs(lamps.z_m[1] - 0.68) < 1e-9 &&
           lamps.z_m[2] == 0.35 && lamps.aim_pitch_rad < 0.0;
  }));
  display_->keys("key U");  // with Shift: as in the rig file; the headlamps are chosen
  EXPECT_TRUE(comes<LampState>([](const LampState& lamps) { return lamps.z_m[0] == 0.66; }));
  display_->keys("mousemove --window %1 160 120 click 1");
  const std::string answer = (folder_ / "answer.txt").string();
  const std::string ask = "'" + program("phare") + "' control --port-base " + std::to_string(port_base()) +
                          " set point >'" + answer + "' 2>&1";
  EXPECT_TRUE(wait_until([&] {
    if (std::system(ask.c_str()) != 0) return false;
    std::stringstream text;
    text << std::ifstream(answer).rdbuf();
    return text.str().starts_with("point world ") && text.str().find("headlamp left: ") != std::string::npos;
  })) << "the click chose a point of the road";
  display_->keys("key Escape");
  EXPECT_EQ(end(), 0);
}

/// How many pixels of the screen are not what they were, of a million.
int changed_ppm(const std::vector<std::array<int, 3>>& before, const std::vector<std::array<int, 3>>& after) {
  if (before.empty() || before.size() != after.size()) return -1;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) changed += before[i] == after[i] ? 0u : 1u;
  return static_cast<int>(1'000'000 * changed / before.size());
}

class WindowFaultTest : public WindowTest {
 protected:
  /// From a window that is as it was on: keys move the car, and the window shows what happens.
  void expect_a_drive_that_is_seen() {
    display_->keys("keydown Up");
    EXPECT_TRUE(comes<VehicleState>([](const VehicleState& car) { return car.speed_mps > 3.0; })) << "it moves";
    display_->keys("keyup Up");
    const auto before = display_->screen();
    display_->keys("key F1");
    EXPECT_TRUE(wait_until([&] { return changed_ppm(before, display_->screen()) > 20'000; })) << "the help is shown";
    display_->keys("key Escape key Escape");
    EXPECT_EQ(end(), 0) << "and no message of validation";
    EXPECT_EQ(report_of(folder_ / "out")["summary"]["restarts"], 0);
  }
};

class WindowFaults : public WindowFaultTest, public testing::WithParamInterface<const char*> {};

// What a display server or a driver does to a window: the drive goes on in the same process, and the window shows what
// happens in it again.
TEST_P(WindowFaults, TheWindowShowsTheDriveAgain) {
  const GpuFault fault(GetParam(), folder_ / "told");
  start({"--validation", "--frames", "100000", "--frames-in-flight",
         "2"});  // every picture is kept: also the one that it happens to
  ASSERT_TRUE(wait_until([&] { return fault.happened(); }));
  expect_a_drive_that_is_seen();
}
INSTANTIATE_TEST_SUITE_P(Each, WindowFaults,
                         testing::Values("lost-surface:60", "lost-surface-shown:60", "out-of-date-shown:60",
                                         "minimised:60:1500"),
                         [](const auto& info) {
                           std::string name(info.param, std::strcspn(info.param, ":"));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// With what is drawn over the picture there is more to be taken down when the device is lost.
TEST_F(WindowFaultTest, ALostDeviceIsSaidAndAskedForAgain) {
  const GpuFault fault("lost-device:60", folder_ / "told");
  start({"--set", "lines=on"});
  ASSERT_TRUE(wait_until([&] { return fault.happened(); }));
  const auto rows = [&] {
    std::ifstream file(folder_ / "out" / "drive.csv");
    return std::count(std::istreambuf_iterator<char>(file), {}, '\n');
  };
  const auto then = rows();
  ASSERT_TRUE(wait_until([&] { return rows() > then + 20; })) << "one begun anew draws";
  display_->keys("key Escape key Escape");
  EXPECT_EQ(end(), 0);
  const auto report = report_of(folder_ / "out");
  ASSERT_EQ(report["restarts"].size(), 1u);
  EXPECT_EQ(report["restarts"][0]["because"], "exit 1") << "it leaves by itself, and does not crash";
}

/// What a window manager does to a window that a person minimises, and to one that is wanted again: ICCCM 4.1.3.1.
/// False: there is no libX11.
bool set_wm_state(const std::string& display, unsigned long window, long state) {
  void* x11 = dlopen("libX11.so.6", RTLD_NOW);
  if (x11 == nullptr) return false;
  const auto open = reinterpret_cast<void* (*)(const char*)>(dlsym(x11, "XOpenDisplay"));
  const auto atom_of = reinterpret_cast<unsigned long (*)(void*, const char*, int)>(dlsym(x11, "XInternAtom"));
  const auto change = reinterpret_cast<int (*)(void*, unsigned long, unsigned long, unsigned long, int, int,
                                               const unsigned char*, int)>(dlsym(x11, "XChangeProperty"));
  const auto close = reinterpret_cast<int (*)(void*)>(dlsym(x11, "XCloseDisplay"));
  void* const server = open(display.c_str());
  if (server == nullptr) return false;
  const unsigned long wm_state = atom_of(server, "WM_STATE", 0);
  const long words[2] = {state, 0};
  change(server, window, wm_state, wm_state, 32, 0, reinterpret_cast<const unsigned char*>(words), 2);
  close(server);
  return true;
}

TEST_F(WindowFaultTest, APersonMinimisesTheWindow) {
  start({"--validation", "--frames", "100000"});
  ASSERT_TRUE(comes<FrameReport>([](const FrameReport& report) { return !report.drawn.level.empty(); }));
  const std::string id_file = (folder_ / "id").string();
  const std::string search =
      "DISPLAY=" + display_->name() + " xdotool search --onlyvisible --name '^Phare$' >'" + id_file + "'";
  ASSERT_EQ(std::system(search.c_str()), 0);
  unsigned long window = 0;
  ASSERT_TRUE(std::ifstream(id_file) >> window);
  constexpr long kNormal = 1, kIconic = 3;
  ASSERT_TRUE(set_wm_state(display_->name(), window, kIconic)) << "no libX11, or no server";
  const auto drawn = [&] {
    std::size_t count = 0;
    for (const Datagram& datagram : recorded())
      count += std::holds_alternative<FrameReport>(datagram.payload) ? 1u : 0u;
    return count;
  };
  const std::size_t before = drawn();
  EXPECT_TRUE(wait_until([&] { return drawn() > before + 60; })) << "the drive goes on";
  const auto shown = display_->screen();
  const std::size_t then = drawn();
  EXPECT_TRUE(wait_until([&] { return drawn() > then + 30; }));
  EXPECT_EQ(changed_ppm(shown, display_->screen()), 0) << "and nothing is shown";
  ASSERT_TRUE(set_wm_state(display_->name(), window, kNormal));
  expect_a_drive_that_is_seen();
}

// Camera, halves and plot by keys; the free eye goes on from where another camera stands, and what it sees is kept.
TEST_F(WindowTest, CamerasAreChosenMovedAndKept) {
  start({"--validation"});
  ASSERT_TRUE(comes<VehicleState>([](const VehicleState&) { return true; }));
  const std::string answer = (folder_ / "answer.txt").string();
  const auto says = [&](const std::string& asked, const std::string& begin) {
    const std::string ask = "'" + program("phare") + "' control --port-base " + std::to_string(port_base()) + " set " +
                            asked + " >'" + answer + "' 2>&1";
    std::string text;
    EXPECT_TRUE(wait_until([&] {
      if (std::system(ask.c_str()) != 0) return false;
      std::stringstream read;
      read << std::ifstream(answer).rdbuf();
      text = read.str();
      return text.starts_with(begin);
    })) << asked
        << ": " << text;
  };
  display_->keys("key c key c key v key t");
  says("camera", "camera chase");
  says("layout", "layout split");
  says("plot", "plot on");
  display_->keys("key 8 key 8");  // forward along the view, a metre
  says("camera", "camera free");
  says("cameras 'add near'", "cameras near car -8.00");  // from 9 m behind, looking 0.08 rad down
  display_->keys("key c");
  says("camera near", "camera near");
  says("camera wall", "camera wall");
  display_->keys("mousemove --window %1 40 120 click 1");
  says("point", "point world ");
  display_->keys("key Escape");
  EXPECT_EQ(end(), 0) << "and no message of validation";
}

/// Where the panel's controls lie in a window of this size. The panel is laid out here as in the window: what stands
/// above a control is the same.
class ShownPanel {
 public:
  ShownPanel(int width_px, int height_px) : panel_(height_px) {
    const auto rig = read_rig(source_dir() + "/config/rigs/country_road.toml");
    EXPECT_TRUE(rig.ok());
    auto lamps = Lamps::load(*rig);
    EXPECT_TRUE(lamps.ok());
    lamps->set_controls({});
    PanelFacts facts{.lit = "low", .lamps = panel_lamps(*lamps)};
    for (const DesignConfig& design : rig->designs) facts.designs.push_back(design.name);
    for (int i = 0; i < 3; ++i) panel_.lay_out(facts, width_px, height_px, 0.02);
  }
  /// "X Y" at this share of a control's width.
  std::string at(const std::string& control, double x_01) const {
    const PanelRect at = rect(control);
    return std::to_string(std::lround(at.left_px + x_01 * (at.right_px - at.left_px))) + " " +
           std::to_string(std::lround(0.5 * (at.top_px + at.bottom_px)));
  }
  PanelRect rect(const std::string& control) const {
    const PanelRect* found = panel_.place(control);
    EXPECT_NE(found, nullptr) << control;
    return found != nullptr ? *found : PanelRect{};
  }

 private:
  Panel panel_;
};

TEST_F(WindowTest, APanelMovesLampsByTheMouse) {
  start({"--validation"}, "640x360");
  ASSERT_TRUE(comes<VehicleState>([](const VehicleState&) { return true; }));
  const ShownPanel panel(640, 360);
  // The bars that head its sections, where no letters are: bluer than anything on a road at night.
  const auto bars_01 = [&] {
    const auto pixels = display_->screen();
    std::size_t like = 0, all = 0;
    for (const char* section : {"Beam and design", "Lamps"}) {
      const PanelRect bar = panel.rect(section);
      for (auto y = std::lround(bar.top_px) + 3; y < std::lround(bar.bottom_px) - 3; ++y) {
        for (auto x = std::lround(0.6 * bar.right_px); x < std::lround(bar.right_px) - 8; ++x, ++all) {
          if (pixels.empty()) return -1.0;
          const auto [red, green, blue] =
              pixels[static_cast<std::size_t>(y) * VirtualDisplay::kWidth_px + static_cast<std::size_t>(x)];
          like += blue > red + 30 && blue > green + 15 ? 1u : 0u;
        }
      }
    }
    EXPECT_GT(all, 500u);
    return static_cast<double>(like) / static_cast<double>(all);
  };
  EXPECT_EQ(bars_01(), 0.0) << "no panel yet (-1: the screen cannot be read)";
  display_->keys("key F9");
  EXPECT_TRUE(wait_until([&] { return bars_01() == 1.0; })) << "the panel shows where it was laid out: " << bars_01();

  // From the middle of the slider, which is the rig's height, to a quarter of its width before its end.
  display_->keys("mousemove --window %1 " + panel.at("lamp up", 0.5) + " mousedown 1 mousemove --window %1 " +
                 panel.at("lamp up", 0.75) + " mouseup 1");
  EXPECT_TRUE(comes<LampState>([](const LampState& lamps) {
    // 0.6 m over the slider's width but its grab; a pixel is some 4 mm.
    return lamps.z_m.size() == 4 && std::abs(lamps.z_m[0] - 0.82) < 0.03 && lamps.z_m[0] == lamps.z_m[1] &&
           lamps.z_m[2] == 0.35;
  })) << "the pair of headlamps is higher";
  display_->keys("mousemove --window %1 " + panel.at("design 1", 0.1) + " click 1");
  EXPECT_TRUE(comes<CockpitState>([](const CockpitState& c) { return c.design_index == 1; }));
  display_->keys("mousemove --window %1 " + panel.at("high beam", 0.5) + " click 1");
  EXPECT_TRUE(comes<CockpitState>([](const CockpitState& c) { return c.light_switch == LightSwitch::kHigh; }));

  const std::string answer = (folder_ / "answer.txt").string();
  const std::string ask = "'" + program("phare") + "' control --port-base " + std::to_string(port_base()) +
                          " set point >'" + answer + "' 2>&1";
  EXPECT_EQ(std::system(ask.c_str()), 0);
  std::stringstream text;
  text << std::ifstream(answer).rdbuf();
  EXPECT_TRUE(text.str().starts_with("point none")) << "no click went through to the road: " << text.str();
  display_->keys("key F9");
  EXPECT_TRUE(wait_until([&] { return bars_01() == 0.0; })) << "hidden again: " << bars_01();
  display_->keys("key F9 key Escape");
  EXPECT_TRUE(wait_until([&] { return bars_01() == 0.0; })) << "Esc hides the panel first";
  EXPECT_FALSE(drive_->ended());
  display_->keys("key Escape");
  EXPECT_EQ(end(), 0);
}

TEST_F(WindowTest, AtTheEndOfADriveTheWindowStaysAndTheDriveCanBeHadAgain) {
  // The first second and a half of the demo.
  const auto demo = read_drive(source_dir() + "/config/drives/country_road.pcap");
  ASSERT_TRUE(demo.ok());
  {
    auto writer = DriveWriter::create(folder_ / "short.pcap", 47000);
    ASSERT_TRUE(writer.ok());
    for (const Datagram& datagram : demo->datagrams) {
      if (datagram.sim_time.ns > 1'500'000'000) continue;
      const std::string bytes = encode(datagram);
      ASSERT_TRUE(writer->write(datagram, std::as_bytes(std::span(bytes))).ok());
    }
  }
  start({"--drive", (folder_ / "short.pcap").string()});
  const auto over = [](const FrameReport& report) { return report.drawn.drive_ended; };
  ASSERT_TRUE(comes<FrameReport>(over));
  std::this_thread::sleep_for(1s);
  ASSERT_FALSE(drive_->ended()) << "the window closed without a word";
  display_->keys("key BackSpace");
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "d-2.pcap"); }));
  ASSERT_TRUE(comes<FrameReport>(over, "d-2.pcap")) << "the same drive again";
  display_->keys("key Up");
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "d-3.pcap"); }));
  ASSERT_TRUE(comes<CockpitState>([](const CockpitState& c) { return c.source == "keyboard"; }, "d-3.pcap"))
      << "and then the person's own";
  display_->keys("key Escape");
  EXPECT_EQ(end(), 0);
  for (const char* out : {"out", "out-2", "out-3"}) EXPECT_FALSE(report_of(folder_ / out).empty()) << out;
  EXPECT_EQ(report_of(folder_ / "out")["processes"]["visual-0"]["frames_stale_pose"], 0);
}

TEST_F(WindowTest, WhatIsCountedInFramesWaitsForNobody) {
  start({"--frames", "3"});
  EXPECT_EQ(end(), 0);
  EXPECT_EQ(report_of(folder_ / "out")["processes"]["cockpit"]["source"]["name"], "drive") << "the demo, as ever";
}

TEST_F(WindowTest, WhatValidationFoundFailsADriveThatKeepsNothing) {
  setenv("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT", 1);  // it finds something everywhere
  start({"--frames", "3", "--lockstep", "--validation"}, "320x180", false);
  unsetenv("VK_LAYER_ENABLES");
  EXPECT_EQ(end(), 1);
}

}  // namespace
}  // namespace phare::test
