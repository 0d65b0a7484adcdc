#include "tests/process/drive_run.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/paths.h"

namespace phare::test {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

ChildProcess start_drive(const fs::path& out, const fs::path& from, const std::vector<std::string>& arguments,
                         bool lockstep) {
  // env -C is the working directory; the program that runs is phare itself.
  std::vector<std::string> words{"-C",          from.string(), program("phare"), "drive",
                                 "--headless",  "--overwrite", "--port-base",    std::to_string(port_base()),
                                 "--log-level", "error",       "--out",          out.string()};
  if (lockstep) words.push_back("--lockstep");
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (std::find(arguments.begin(), arguments.end(), "--size") == arguments.end()) {
    words.insert(words.end(), {"--size", "160x90"});
  }
  auto child = ChildProcess::start("/usr/bin/env", words);
  if (!child) {
    std::fprintf(stderr, "%s\n", child.error().text().c_str());
    std::abort();
  }
  return *child;
}

}  // namespace

std::uint16_t port_base() {
  return static_cast<std::uint16_t>(10000 + getpid() % 240 * 40);
}

DriveRun::DriveRun(const fs::path& out, const fs::path& from, const std::vector<std::string>& arguments, bool lockstep)
    : child_(start_drive(out, from, arguments, lockstep)), out_(out) {}

DriveRun::~DriveRun() {
  if (!running()) return;
  child_.send_signal(SIGKILL);
  while (running()) std::this_thread::sleep_for(1ms);
}

bool DriveRun::wait_for_frame(std::int64_t index) {
  char name[40];
  std::snprintf(name, sizeof name, "frames/%06lld.png", static_cast<long long>(index));
  const auto until = Clock::now() + kPatience;
  while (Clock::now() < until && running()) {
    if (fs::exists(out_ / name)) return true;
    std::this_thread::sleep_for(500us);
  }
  return false;
}

std::map<std::string, pid_t> DriveRun::processes() const {
  std::map<std::string, pid_t> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    // "1234 (phare-visual) S 1200 …": process, name, state, parent
    std::ifstream stat(entry.path() / "stat");
    std::string line;
    if (!std::getline(stat, line)) continue;
    const std::size_t open = line.find('('), close = line.rfind(')');
    if (open == std::string::npos || close == std::string::npos || close + 4 >= line.size()) continue;
    if (std::atoi(line.c_str() + close + 4) != child_.pid()) continue;
    found[line.substr(open + 1, close - open - 1)] = std::atoi(line.c_str());
  }
  return found;
}

int DriveRun::end(int signal) {
  child_.send_signal(signal);
  return wait();
}

int DriveRun::wait() {
  const auto until = Clock::now() + kPatience;
  std::optional<ProcessEnd> end;
  while (!(end = child_.ended())) {
    if (Clock::now() > until) child_.send_signal(SIGKILL);
    std::this_thread::sleep_for(2ms);
  }
  return end->signal != 0 ? 1000 + end->signal : end->exit_code;
}

int drive(const fs::path& out, const fs::path& from, const std::vector<std::string>& arguments) {
  return DriveRun(out, from, arguments).wait();
}

nlohmann::json report_of(const fs::path& out) {
  std::ifstream stream(out / "report.json");
  return stream ? nlohmann::json::parse(stream, nullptr, false) : nlohmann::json{};
}

std::map<std::string, std::string> pictures_of(const fs::path& out) {
  std::map<std::string, std::string> pictures;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(out / "frames", ignored))
    pictures["frames/" + entry.path().filename().string()] = bytes_of(entry.path());
  for (const char* name : {"drivers_view.png", "birds_eye.png", "wall_25m.png", "hdr.exr"})
    pictures[name] = bytes_of(out / name);
  return pictures;
}

std::vector<std::string> differences(const std::map<std::string, std::string>& a,
                                     const std::map<std::string, std::string>& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    if (other == b.end()) {
      names.push_back(name + " (only in one)");
    } else if (other->second != bytes) {
      names.push_back(name);
    }
  }
  for (const auto& [name, bytes] : b) {
    if (!a.contains(name)) names.push_back(name + " (only in one)");
  }
  return names;
}

}  // namespace phare::test
