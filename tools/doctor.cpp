// phare doctor: what this machine has, which Debian package gives what it lacks, and what would miss it: a drive, or
// only Phare's own tests.
#include <sched.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

#include "cockpit_io/can_log.h"
#include "config/base/paths.h"
#include "config/base/remedies.h"
#include "net/scheduling.h"
#include "tools/child_process.h"
#include "tools/commands.h"
#ifdef PHARE_WITH_GRAPHICS
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "visual/vulkan_devices.h"
#endif

namespace phare {
namespace {

struct Finding {
  std::string what;
  bool there = false;
  bool needed = false;  ///< phare drive cannot do without
  std::string detail;
  std::string remedy;      ///< when it is missing
  bool for_tests = false;  ///< a drive never uses it
};

Finding vulkan_devices() {
  Finding finding{"Vulkan device", false, true, "", kVulkanRemedy};
#ifdef PHARE_WITH_GRAPHICS
  const auto devices = list_vulkan_devices();
  if (!devices) {
    finding.detail = "none (" + devices.error().reason + ")";
  } else {
    finding.there = !devices->empty();
    for (const std::string& device : *devices) finding.detail += (finding.detail.empty() ? "" : "; ") + device;
    if (!finding.there) finding.detail = "none";
  }
#else
  finding.needed = false;
  finding.detail = "not asked: built without graphics (PHARE_GRAPHICS=OFF)";
#endif
  return finding;
}

/// Where the Vulkan loader looks for explicit layers; the environment can add to it.
Finding validation_layer() {
  Finding finding{"Vulkan validation layer", false, false, "not found; --validation does not work",
                  kValidationRemedy,         true};
  std::vector<std::filesystem::path> folders{"/usr/share/vulkan/explicit_layer.d", "/etc/vulkan/explicit_layer.d",
                                             "/usr/local/share/vulkan/explicit_layer.d"};
  if (const char* path = std::getenv("VK_LAYER_PATH")) folders.insert(folders.begin(), path);
  for (const auto& folder : folders) {
    std::error_code ignored;
    const auto file = folder / "VkLayer_khronos_validation.json";
    if (!std::filesystem::exists(file, ignored)) continue;
    finding.there = true;
    finding.detail = file.string();
    break;
  }
  return finding;
}

Finding can_sockets() {
  const int fd = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, 1 /* CAN_RAW */);
  Finding finding{"SocketCAN", fd >= 0, false, "the kernel opens CAN sockets", ""};
  if (fd < 0) {
    finding.detail = std::string("the kernel has none (") + std::strerror(errno) + "); logs and the keyboard work";
    finding.remedy =
        "a kernel with CONFIG_CAN (Debian's linux-image-amd64: modprobe can can_raw vcan); tools: apt-get install "
        "can-utils";
  } else {
    close(fd);
  }
  return finding;
}

Finding display() {
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  const char* x11 = std::getenv("DISPLAY");
  const bool has_wayland = wayland != nullptr && *wayland != '\0', has_x11 = x11 != nullptr && *x11 != '\0';
  Finding finding{"Display", has_wayland || has_x11, false, "none; phare drive writes pictures instead",
                  kDisplayRemedy};
  if (!finding.there) return finding;
  finding.detail = has_wayland ? std::string("Wayland ") + wayland : "X11 " + std::string(x11);
#ifdef PHARE_WITH_GRAPHICS
  // Named is not yet open.
  const bool opens = glfwInit() == GLFW_TRUE;
  const char* reason = nullptr;
  if (!opens) glfwGetError(&reason);
  glfwTerminate();
  finding.there = opens;
  if (!opens) finding.detail += ", which does not open (" + std::string(reason != nullptr ? reason : "GLFW") + ")";
#endif
  return finding;
}

Finding clock_found() {
  timespec resolution{};
  clock_getres(CLOCK_MONOTONIC, &resolution);
  const auto before = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const double late_us =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count() - 1000.0;
  char text[96];
  std::snprintf(text, sizeof text, "resolution %ld ns, a sleep of 1 ms came back %.0f us late", resolution.tv_nsec,
                late_us);
  return {"Clock", resolution.tv_sec == 0 && resolution.tv_nsec <= 1000, false, text,
          "high-resolution timers in the kernel"};
}

/// May cockpit and dynamics run before other programs?
Finding real_time_priority() {
  const Scheduling scheduling = run_before_others(true);
  const sched_param ordinary{};
  sched_setscheduler(0, SCHED_OTHER | SCHED_RESET_ON_FORK, &ordinary);
  return {"Real-time priority", scheduling.real_time, false, scheduling.text,
          "echo '* - rtprio 10' > /etc/security/limits.d/phare.conf, then log in again"};
}

Finding program(const char* name, const char* what_for, const char* remedy, bool for_tests) {
  const auto path = find_in_path(name);
  return {name,   path.has_value(), false, path ? path->string() : std::string("not in PATH; ") + what_for,
          remedy, for_tests};
}

/// Is there what reads the CAN logs of other makers?
Finding python_can() {
  const bool there = reads_foreign_can_logs();
  return {"python-can", there, false, there ? "reads ASC, BLF and TRC logs" : "ASC, BLF and TRC logs are not read",
          kCanLogRemedy};
}

/// What dpkg has installed; empty where there is no dpkg.
std::set<std::string> installed_packages() {
  std::set<std::string> installed;
  FILE* dpkg = popen("dpkg-query -W -f '${db:Status-Abbrev} ${Package}\\n' 2>/dev/null", "r");
  for (char state[16], name[256]; dpkg != nullptr && std::fscanf(dpkg, "%15s %255s", state, name) == 2;) {
    if (std::strncmp(state, "ii", 2) == 0) installed.insert(name);
  }
  if (dpkg != nullptr) pclose(dpkg);
  return installed;
}

/// The names in packages.txt that carry one of `marks` ("" for none), against what dpkg has.
Finding packages(const std::string& what, const std::set<std::string>& marks, bool for_tests) {
  Finding finding{what, false, false, "", "", for_tests};
  std::ifstream list(packages_file());
  const std::set<std::string> installed = installed_packages();
  if (!list || installed.empty()) {
    finding.detail = !list ? packages_file().string() + " cannot be read" : "dpkg-query tells of none: not a Debian";
    return finding;
  }
  std::size_t wanted = 0;
  std::string missing;
  for (std::string line; std::getline(list, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string name, mark;
    if (!(words >> name)) continue;
    words >> mark;
    if (!marks.contains(mark)) continue;
    ++wanted;
    if (!installed.contains(name)) missing += " " + name;
  }
  finding.there = missing.empty();
  finding.detail = (finding.there ? "all " : "not all ") + std::to_string(wanted) + " of packages.txt";
  finding.remedy = "apt-get install" + missing;
  return finding;
}

Finding processes() {
  Finding finding{"Phare's processes", true, true, "", "build everything: cmake --build --preset release"};
  for (const char* name : {"phare-cockpit", "phare-dynamics", "phare-visual"}) {
    if (access(program_beside_us(name).c_str(), X_OK) == 0) continue;
    finding.there = false;
    finding.detail += (finding.detail.empty() ? "not beside phare: " : ", ") + std::string(name);
  }
  if (finding.there) finding.detail = program_beside_us("").parent_path().string();
  return finding;
}

std::vector<Finding> all_findings() {
  std::vector<Finding> findings{
      vulkan_devices(), processes(),
      // An installed phare has been built; dpkg sees to its libraries.
      is_installed() ? packages("Debian packages", {"run"}, false) : packages("Debian packages", {"", "run"}, false),
      can_sockets(), display(), clock_found(), real_time_priority(),
      program("ffmpeg", "no drive.mp4 from the frames", kVideoRemedy, false), python_can()};
  if (!is_installed()) {  // its tests stay with its sources
    findings.push_back(packages("Debian packages", {"test"}, true));
    findings.push_back(validation_layer());
    findings.push_back(program("tshark", "drive files are not looked into", "apt-get install tshark", true));
    findings.push_back(program("xvfb-run", "no window is tried", kDisplayRemedy, true));
    findings.push_back(program("mmdebstrap", "no bare Debian is tried", "apt-get install mmdebstrap", true));
  }
  return findings;
}

void print(const std::vector<Finding>& findings, bool for_tests) {
  for (const Finding& finding : findings) {
    if (finding.for_tests != for_tests) continue;
    const char* state = finding.there ? "there" : finding.needed ? "MISSING" : "missing";
    std::printf("  %-8s %-24s %s\n", state, finding.what.c_str(), finding.detail.c_str());
    if (!finding.there && !finding.remedy.empty()) std::printf("  %-8s %-24s -> %s\n", "", "", finding.remedy.c_str());
  }
}

int doctor(bool json) {
  const std::vector<Finding> findings = all_findings();
  bool healthy = true, tests = true;
  nlohmann::json report = nlohmann::json::array();
  for (const Finding& finding : findings) {
    healthy = healthy && (finding.there || !finding.needed);
    tests = tests && (finding.there || !finding.for_tests);
    nlohmann::json item{{"what", finding.what},
                        {"for", finding.for_tests ? "tests" : "drive"},
                        {"there", finding.there},
                        {"needed", finding.needed},
                        {"detail", finding.detail}};
    if (!finding.there) item["remedy"] = finding.remedy;
    report.push_back(std::move(item));
  }
  if (json) {
    std::printf("%s\n", nlohmann::json{{"healthy", healthy}, {"findings", report}}.dump(2).c_str());
    return healthy ? kExitDone : kExitCheckFailed;
  }
  std::printf("For driving\n");
  print(findings, false);
  if (!is_installed()) {
    std::printf("Only for Phare's own tests (./phare test installs what is missing)\n");
    print(findings, true);
  }
  std::printf("This machine %s.\n", healthy ? "can drive" : "cannot drive: see MISSING above");
  if (!is_installed()) std::printf("It %s the tests need.\n", tests ? "has all that" : "lacks some of what only");
  return healthy ? kExitDone : kExitCheckFailed;
}

}  // namespace

void add_doctor(CLI::App& app, Command& chosen) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("doctor", "What this machine has, and which package gives what is missing");
  command->footer(
      "Exit code 1 when something is MISSING that phare drive needs; what is \"missing\" it can do "
      "without.\nExample:\n  phare doctor --json");
  command->add_flag("--json", *json, "Print as JSON");
  command->callback([json, &chosen] { chosen = [json] { return doctor(*json); }; });
}

}  // namespace phare
