// Cases of a whole drive: its device is lost, its window is lost or minimised. `phare drive` of this build is started
// with a Vulkan layer (gpu_faults_layer.cpp) that reports to it what drivers and display servers report once in a
// month.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "tools/child_process.h"
#include "tools/hard_cases/hard_case.h"
#include "tools/temporary_folder.h"
#include "tools/virtual_display.h"

namespace phare::hard {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::chrono::seconds kPatience{120};  // of a busy machine
constexpr int kShownAgain = 30;                 // pictures that a window shows after it failed, as the layer counts

/// The words before the program in a command of env: no layer of ours but this one, which fails so.
std::vector<std::string> failing(const std::string& fault, const fs::path& told) {
  return {"VK_ADD_LAYER_PATH=" + program_beside_us("../lib/phare").string(),
          "VK_INSTANCE_LAYERS=VK_LAYER_PHARE_gpu_faults", "PHARE_GPU_FAULT=" + fault,
          "PHARE_GPU_FAULT_TOLD=" + told.string(), "PHARE_GPU_FAULT_SHOWN=" + std::to_string(kShownAgain)};
}

Result<ChildProcess> start_drive(std::vector<std::string> environment, const std::vector<std::string>& arguments,
                                 const fs::path& out) {
  // What the drive prints is not what this command says; what went wrong stands in its end and its report.
  environment.insert(environment.end(), {"/bin/sh", "-c", "exec \"$@\" >/dev/null 2>&1", "sh"});
  // Ports that neither a rig on this machine has (47000) nor another of these at the same time.
  const int port_base = 20'000 + static_cast<int>(getpid() % 240) * 40;
  for (const std::string& word :
       {program_beside_us("phare").string(), std::string("drive"), std::string("--size"), std::string("96x54"),
        std::string("--overwrite"), std::string("--log-level"), std::string("off"), std::string("--port-base"),
        std::to_string(port_base), std::string("--out"), out.string()})
    environment.push_back(word);
  environment.insert(environment.end(), arguments.begin(), arguments.end());
  return ChildProcess::start("/usr/bin/env", environment);
}

/// How it ended; killed when patience ends.
ProcessEnd end_of(ChildProcess& drive) {
  const auto until = Clock::now() + kPatience;
  std::optional<ProcessEnd> end;
  while (!(end = drive.ended())) {
    if (Clock::now() > until) drive.send_signal(SIGKILL);
    std::this_thread::sleep_for(5ms);
  }
  return *end;
}

/// Processes that were started anew in a drive; -1: its report cannot be read.
int restarts_of(const fs::path& out) {
  std::ifstream stream(out / "report.json");
  const nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
  const auto at = nlohmann::json::json_pointer("/summary/restarts");
  return report.is_object() && report.contains(at) ? report[at].get<int>() : -1;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Outcome lost_device(const Bench&) {
  constexpr int kFrames = 20, kAtSubmission = 15;
  const TemporaryFolder folder;
  if (folder.path().empty()) return {.error = "no temporary folder"};
  const fs::path told = folder / "told";
  for (const char* name : {"undisturbed", "disturbed"}) {
    const bool disturbed = name[0] == 'd';
    auto drive = start_drive(disturbed ? failing("lost-device:" + std::to_string(kAtSubmission), told)
                                       : std::vector<std::string>{},
                             {"--headless", "--lockstep", "--frames", std::to_string(kFrames)}, folder / name);
    if (!drive) return {.error = drive.error().text()};
    const ProcessEnd end = end_of(*drive);
    if (end.signal != 0 || end.exit_code != 0)
      return {.error = std::string("the ") + name + " drive ended with " + end.text()};
  }
  if (!fs::exists(told)) return {.error = "the layer that fails was not loaded"};
  if (const int restarts = restarts_of(folder / "disturbed"); restarts != 1)
    return {.error = std::to_string(restarts) + " restarts instead of one"};
  Outcome outcome;
  for (int frame = 0; frame < kFrames; ++frame) {
    char name[40];
    std::snprintf(name, sizeof name, "frames/%06d.png", frame);
    const std::string here = bytes_of(folder / "undisturbed" / name), there = bytes_of(folder / "disturbed" / name);
    const bool same = !here.empty() && here == there;
    outcome.device.push_back({static_cast<double>(frame), same ? 0.0 : 1.0});
    if (same) continue;
    const auto picture = [](const std::string& bytes) {
      return bytes.empty() ? std::string("none") : std::to_string(bytes.size()) + " bytes";
    };
    outcome.missed += (outcome.missed.empty() ? "frame " : "; frame ") + std::to_string(frame) + ": undisturbed " +
                      picture(here) + ", disturbed " + picture(there);
  }
  return outcome;
}

/// A drive in a window to which these things happen, one after the other: each a process that leaves, or a window that
/// shows nothing any more.
Outcome window_fails(const std::vector<std::string>& faults) {
  std::optional<VirtualDisplay> display;
  std::vector<std::string> environment;
  if (VirtualDisplay::possible()) {
    display.emplace();
    if (display->name().empty()) return {.error = "Xvfb does not start"};
    environment = {"-u", "WAYLAND_DISPLAY", "DISPLAY=" + display->name()};
  } else if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) {
    return {.not_run = "no display, and no Xvfb (apt-get install xvfb)"};
  }
  Outcome outcome;
  for (const std::string& fault : faults) {
    const TemporaryFolder folder;
    if (folder.path().empty()) return {.error = "no temporary folder"};
    const fs::path told = folder / "told";
    std::vector<std::string> words = environment;
    for (std::string& word : failing(fault, told)) words.push_back(std::move(word));
    auto drive = start_drive(std::move(words), {}, folder / "out");
    if (!drive) return {.error = drive.error().text()};
    const auto until = Clock::now() + kPatience;
    const fs::path shown = told.string() + ".shown";
    while (Clock::now() < until && !fs::exists(shown) && !drive->ended()) std::this_thread::sleep_for(5ms);
    const bool shows = fs::exists(shown);
    drive->send_signal(SIGINT);
    const ProcessEnd end = end_of(*drive);
    if (!fs::exists(told)) return {.error = "the layer that fails was not loaded"};
    const bool left = end.signal != 0 || end.exit_code != kExitInterrupted || restarts_of(folder / "out") != 0;
    outcome.device.push_back({static_cast<double>(outcome.device.size()), (shows ? 0.0 : 1.0) + (left ? 1.0 : 0.0)});
  }
  return outcome;
}

HardCase whole_drive(const char* name, const char* breaks, const char* setup, const char* unit, const char* along,
                     const char* source, std::function<Outcome(const Bench&)> run) {
  return {.name = name,
          .group = "The picture",
          .breaks = breaks,
          .setup = setup,
          .unit = unit,
          .along = along,
          .device_bound = 0.0,
          .source = source,
          .run = std::move(run)};
}

}  // namespace

std::vector<HardCase> whole_drive_cases() {
  return {
      whole_drive("lost-device",
                  "a driver's reset or a card taken away (VK_ERROR_DEVICE_LOST) crashes the program in its own clearing "
                  "up, or every picture from then on is black",
                  "a drive of 20 frames in lockstep whose device is lost in its midst, beside one undisturbed",
                  "pictures missing or other", "frame",
                  "the picture's process leaves and is started once; lockstep is bit-exact", lost_device),
      whole_drive("lost-surface",
                  "the display server begins anew (VK_ERROR_SURFACE_LOST_KHR), and the window is dead or the program is",
                  "a drive in a window: lost when a picture is asked for, when it is shown, and a swapchain out of date "
                  "while it is shown",
                  "windows that show no 30 pictures again, or processes that leave", "which of them",
                  "the surface is made anew in the same process",
                  [](const Bench&) {
                    return window_fails({"lost-surface:30", "lost-surface-shown:30", "out-of-date-shown:30"});
                  }),
      whole_drive("minimised-window", "images of 0 × 0 are made, or the frame waits for ever",
                  "a drive in a window that has no size for 1.5 s",
                  "windows that show no 30 pictures again, or processes that leave", "which of them",
                  "without a size nothing is shown and the drive goes on",
                  [](const Bench&) { return window_fails({"minimised:30:1500"}); }),
  };
}

}  // namespace phare::hard
