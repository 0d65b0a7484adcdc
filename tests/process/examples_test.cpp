// process: what a newcomer pastes. Every command line of README.md and of the example in every --help runs as it
// stands, in a folder where config/ lies as in the source; only ports are our own, and a drive that would go on is
// ended by --frames or Ctrl-C. What commands a rig finds one running.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/paths.h"
#include "tests/process/drive_run.h"
#include "tools/help_data.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;

struct Said {
  int code = -1;
  std::string text;  ///< both streams
};

/// A folder as a clone looks to who stands in it: ./phare, config/.
class Clone {
 public:
  Clone() {
    fs::create_symlink(program("phare"), folder_ / "phare");
    fs::create_symlink(source_dir() + "/config", folder_ / "config");
  }
  const fs::path& path() const { return folder_.path(); }

  /// Through bash; after `seconds` as if Ctrl-C were pressed.
  Said run(const std::string& line, int seconds) const {
    std::ofstream(folder_ / "line.sh") << line << "\n";
    const std::string command = "cd '" + path().string() + "' && PATH='" + build_dir() +
                                "/bin':$PATH timeout --preserve-status -k 60 -s INT " + std::to_string(seconds) +
                                " env -u DISPLAY -u WAYLAND_DISPLAY bash line.sh 2>&1 </dev/null";
    Said said;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return said;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) said.text.push_back(static_cast<char>(c));
    const int status = pclose(pipe);
    said.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return said;
  }

 private:
  TemporaryFolder folder_;
};

/// "./phare drive --x" and "… | phare control -": the words after "phare".
std::string subcommand_of(const std::string& line) {
  std::istringstream in(line);
  for (std::string word; in >> word;)
    if (word == "phare" || word == "./phare") return in >> word ? word : "";
  return "";
}

/// Others than those of the test of whole drives, beside which this one runs.
std::uint16_t ports() {
  return static_cast<std::uint16_t>(30000 + getpid() % 65 * 40);
}

/// The same line on ports of our own, small and not for minutes.
std::string on_our_ports(std::string line) {
  const std::string our_ports = " --port-base " + std::to_string(ports());
  for (const char* command : {"phare drive", "phare control", "phare record", "phare replay", "phare-cockpit",
                              "phare-dynamics", "phare-visual"}) {
    const std::string words = command;
    for (std::size_t at = 0; (at = line.find(words, at)) != std::string::npos;) {
      at += words.size();
      if (at < line.size() && line[at] != ' ') continue;
      std::string more = our_ports;
      const auto lacks = [&](const char* option) { return line.find(option) == std::string::npos; };
      if (words == "phare drive" && lacks("--size")) more += " --size 320x180";
      // A whole drive of 75 s in lockstep takes minutes; that one comes to its end is another test's matter.
      if (words == "phare drive" && !lacks("--lockstep") && lacks("--frames")) more += " --frames 60";
      line.insert(at, more);
      at += more.size();
    }
  }
  return line;
}

/// A drive in the background, for commands that need one.
class RunningRig {
 public:
  RunningRig(const Clone& clone, const std::string& rig) : clone_(clone) {
    std::vector<std::string> words{"-C",
                                   clone.path().string(),
                                   "-u",
                                   "DISPLAY",
                                   "-u",
                                   "WAYLAND_DISPLAY",
                                   program("phare"),
                                   "drive",
                                   "--headless",
                                   "--out",
                                   "running",
                                   "--log-level",
                                   "error",
                                   "--size",
                                   "160x90",
                                   "--port-base",
                                   std::to_string(ports()),
                                   "--rig",
                                   rig};
    child_ = std::make_unique<ChildProcess>(std::move(*ChildProcess::start("/usr/bin/env", words)));
  }
  ~RunningRig() {
    child_->send_signal(SIGINT);
    for (int waited = 0; !child_->ended(); ++waited) {
      if (waited == 30'000) child_->send_signal(SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  /// Until every process of it answers; false when it ended.
  bool answers() {
    while (!child_->ended())
      if (clone_.run(on_our_ports("phare control status --wait 2"), 60).code == 0) return true;
    return false;
  }

 private:
  const Clone& clone_;
  std::unique_ptr<ChildProcess> child_;
};

bool needs_a_rig(const std::string& line) {
  const std::string command = subcommand_of(line);
  return command == "control" || command == "record";
}

std::string rig_of(const std::string& line) {
  const std::size_t at = line.find("--rig ");
  if (at == std::string::npos) return "config/rigs/country_road.toml";
  return line.substr(at + 6, line.find(' ', at + 6) - at - 6);
}

/// Seconds a line gets before Ctrl-C; those that end by themselves end before.
int patience_s(const std::string& line) {
  const std::string command = subcommand_of(line);
  const bool ends = line.find("--frames") != std::string::npos || line.find("--lockstep") != std::string::npos;
  if (line.starts_with("phare-")) return 5;
  if (command == "record" || command == "replay") return 4;
  if (command == "drive" && !ends) return 15;
  return 240;
}

void expect_to_run(const Clone& clone, const std::string& line) {
  // Of an example before: a recording is not written over.
  if (subcommand_of(line) == "record") (void)clone.run("rm -f evening.pcap", 5);
  const auto begin = std::chrono::steady_clock::now();
  const Said said = clone.run(on_our_ports(line), patience_s(line));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  // What a check finds on this machine is no matter of the command line.
  const bool unheard =
      subcommand_of(line) == "replay" && said.text.find("nobody listens at ") != std::string::npos;  // no picture runs
  const bool told = (subcommand_of(line) == "doctor" || unheard) && said.code == 1;
  // A drive and a replay that nothing ends are ended by Ctrl-C, and say so.
  const bool lasts = subcommand_of(line) == "drive" || subcommand_of(line) == "replay";
  const bool interrupted = lasts && said.code == kExitInterrupted;
  EXPECT_TRUE(said.code == 0 || told || interrupted) << said.code << " of " << line << "\n" << said.text;
  std::printf("%3d  %5.1f s  %s\n", said.code, took.count(), line.c_str());
  std::fflush(stdout);
}

/// All lines in order; those for a running rig last, one rig after the other.
void expect_all_to_run(const std::vector<std::string>& lines) {
  const Clone clone;
  std::map<std::string, std::vector<std::string>> with_rig;
  for (const std::string& line : lines) {
    if (needs_a_rig(line)) {
      with_rig[rig_of(line)].push_back(line);
    } else {
      expect_to_run(clone, line);
    }
  }
  for (auto& [rig, commands] : with_rig) {
    std::ranges::stable_partition(commands, [](const std::string& c) { return c.find(" quit") == std::string::npos; });
    RunningRig running(clone, rig);
    ASSERT_TRUE(running.answers()) << rig;
    for (const std::string& command : commands) expect_to_run(clone, command);
  }
}

TEST(Examples, OfEveryHelpRun) {
  const Clone clone;
  const auto commands = nlohmann::json::parse(clone.run("phare help-data", 60).text, nullptr, false);
  ASSERT_GT(commands.size(), 12u);
  std::vector<std::string> lines;
  for (const nlohmann::json& command : commands) {
    EXPECT_FALSE(command["examples"].empty()) << command["path"] << " has no example";
    for (const std::string line : command["examples"])
      if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  for (const char* other : {"phare-cockpit", "phare-dynamics", "phare-visual"}) {
    const std::vector<std::string> examples = examples_in(clone.run(std::string(other) + " --help", 60).text);
    EXPECT_FALSE(examples.empty()) << other << " has no example";
    lines.insert(lines.end(), examples.begin(), examples.end());
  }
  expect_all_to_run(lines);
}

TEST(Examples, OfTheReadmeRun) {
  std::ifstream readme(source_dir() + "/README.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(readme, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    line = line.substr(begin);
    if (!line.starts_with("./phare ") && !line.starts_with("phare ")) continue;
    if (subcommand_of(line) != "test") lines.push_back(line);  // that one runs this
  }
  ASSERT_GT(lines.size(), 8u);
  expect_all_to_run(lines);
}

}  // namespace
}  // namespace phare::test
