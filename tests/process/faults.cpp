#include "tests/process/faults.h"

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "net/drive_file.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// The stalk stands for a second; a message every 50 ms, as its timeout of 0.2 s wants.
constexpr double kStands_s = 1.0, kMessage_s = 0.05;
// What the picture may be behind or ahead of the log: the silence that is borne (0.2 s), a message, and a frame or two
// of a busy machine.
constexpr double kApart_s = 0.45;
constexpr double kFaultEvery_s = 3.0, kFirst_s = 2.0;
// Stopped for longer than this (tools/watchdog.h), a process may have been ended by the launcher; from the second on it
// must have.
constexpr double kMayBeEnded_s = 2.5;

struct Beam {
  LightSwitch light = LightSwitch::kOff;
  bool flash = false;
  friend bool operator==(const Beam&, const Beam&) = default;
};

/// Of the second that began at `second`, by the seed: never the same twice in turn.
Beam beam_of(std::uint64_t seed, int second) {
  constexpr Beam kBeams[]{{LightSwitch::kLow, false},
                          {LightSwitch::kHigh, false},
                          {LightSwitch::kLow, true},
                          {LightSwitch::kPosition, false},
                          {LightSwitch::kHigh, false}};
  return kBeams[(static_cast<std::size_t>(second) + seed) % 5];
}

void write_log(const fs::path& file, std::uint64_t seed, double length_s) {
  std::ofstream log(file);
  char line[80];
  for (int i = 0; i * kMessage_s < length_s; ++i) {
    const double t = i * kMessage_s;
    const Beam beam = beam_of(seed, static_cast<int>(t / kStands_s + 1e-9));
    // BEAM_STALK of config/cockpits/phare_stalk.dbc: BEAM_SWITCH in bits 0 and 1, FLASH in bit 2, IGNITION in bit 8.
    const int bits = static_cast<int>(beam.light) | (beam.flash ? 4 : 0);
    std::snprintf(line, sizeof line, "(%.6f) can0 500#%02X01000000000000\n", 100.0 + t, bits);
    log << line;
  }
}

/// Of the stalk alone: a log without wheel and pedals is no silence.
void write_cockpit(const fs::path& file) {
  std::ofstream(file) << "[source]\nkind = \"log\"\ndbc = \"" + std::string(cockpits_dir()) +
                             "/phare_stalk.dbc\"\ntimeout_s = 0.2\n[control.light_switch]\nmessage = \"BEAM_STALK\"\n"
                             "signal = \"BEAM_SWITCH\"\nlevels = { off = 0, position = 1, low = 2, high = 3 }\n"
                             "[control.flash]\nmessage = \"BEAM_STALK\"\nsignal = \"FLASH\"\n";
}

const char* text_of(const Beam& beam) {
  if (beam.flash) return "flash";
  return beam.light == LightSwitch::kHigh       ? "high"
         : beam.light == LightSwitch::kLow      ? "low"
         : beam.light == LightSwitch::kPosition ? "position"
                                                : "off";
}

/// Whether the stalk stood so within kApart_s of this time; nothing is asked for before its first message.
bool asked_for(const Beam& shown, double t_s, std::uint64_t seed, double log_s) {
  if (t_s < kApart_s && shown.light == LightSwitch::kOff && !shown.flash) return true;
  for (double t = std::max(0.0, t_s - kApart_s); t <= std::min(log_s, t_s + kApart_s) + 1e-9; t += kMessage_s)
    if (beam_of(seed, static_cast<int>(t / kStands_s)) == shown) return true;
  return false;
}

void judge(const fs::path& record, std::uint64_t seed, FaultResult& result) {
  const auto drive = read_drive(record);
  if (!drive) return;
  SimTime before{-1};
  for (const Datagram& datagram : drive->datagrams) {
    const auto* report = std::get_if<FrameReport>(&datagram.payload);
    if (report == nullptr || report->drawn.level.empty()) continue;
    const bool none_drawn = report->light_drawn == LightSwitch::kOff && report->pose_stale && report->frame_ms == 0.0;
    if (none_drawn) continue;
    ++result.pictures;
    const double t_s = datagram.sim_time.seconds();
    if (datagram.sim_time < before) ++result.time_back;
    before = datagram.sim_time;
    result.driven_s = std::max(result.driven_s, t_s);
    const Beam shown{report->light_drawn, report->flash_drawn};
    const bool safe = report->fail_safe_drawn && shown == Beam{LightSwitch::kLow, false};
    if (safe) ++result.fail_safe;
    if (safe || (!report->fail_safe_drawn && asked_for(shown, t_s, seed, result.log_s))) continue;
    ++result.wrong;
    char text[120];
    std::snprintf(text, sizeof text, "%.3f s: %s%s, stalk %s", t_s, text_of(shown),
                  report->fail_safe_drawn ? " of the fail-safe" : "",
                  text_of(beam_of(seed, static_cast<int>(t_s / kStands_s))));
    if (result.wrong_ones.size() < 8) result.wrong_ones.push_back(text);
  }
}

}  // namespace

FaultResult drive_with_faults(const FaultSetup& setup, const fs::path& folder) {
  FaultResult result;
  std::mt19937_64 random(setup.seed);
  result.log_s = kFirst_s + kFaultEvery_s * (setup.faults + 1);
  const fs::path log = folder / "stalk.log", out = folder / "out", record = folder / "drive.pcap";
  write_log(log, setup.seed, result.log_s);
  write_cockpit(folder / "stalk.toml");
  {
    DriveRun run(out, folder,
                 {"--log", log.string(), "--cockpit", (folder / "stalk.toml").string(), "--record", record.string(),
                  "--size", "96x54", "--audit-every", "0"},
                 setup.lockstep);
    const auto name = [&](std::uint64_t number) {
      constexpr const char* kNames[]{"phare-cockpit", "phare-dynamics", "phare-visual"};
      return std::string(kNames[number % 3]);
    };
    run.wait_for_frame(0);
    // In lockstep the log runs as fast as the pictures come: the faults follow those.
    int second = 0;
    const auto wait_a_while = [&] {
      const double jitter_s = static_cast<double>(random() % 1000) * 1e-3;
      if (setup.lockstep) {
        second += static_cast<int>(kFaultEvery_s);
        run.wait_for_frame(60 * second);
        std::this_thread::sleep_for(std::chrono::duration<double>(0.05 * jitter_s));
      } else {
        std::this_thread::sleep_for(std::chrono::duration<double>(kFaultEvery_s - 0.5 + jitter_s));
      }
    };
    for (int fault = 0; fault < setup.faults && run.running(); ++fault) {
      const std::uint64_t which = random(), other = which + 1 + random() % 2;
      const double share = static_cast<double>(random() % 1000) * 1e-3;
      const auto processes = run.processes();
      const auto signal = [&](const std::string& process, int number) {
        const auto found = processes.find(process);
        return found != processes.end() && kill(found->second, number) == 0;
      };
      // Stops of all lengths alike by their logarithm.
      const double stop_s =
          1e-3 * static_cast<double>(setup.shortest_stop.count()) *
          std::pow(static_cast<double>(setup.longest_stop.count()) / static_cast<double>(setup.shortest_stop.count()),
                   share);
      if (setup.kind != FaultSetup::Kind::kKill && signal(name(which), SIGSTOP)) ++result.stops;
      if (setup.kind == FaultSetup::Kind::kBoth) std::this_thread::sleep_for(std::chrono::duration<double>(stop_s / 2));
      if (setup.kind != FaultSetup::Kind::kStop &&
          signal(name(setup.kind == FaultSetup::Kind::kKill ? which : other), SIGKILL))
        ++result.kills;
      if (setup.kind != FaultSetup::Kind::kKill) {
        std::this_thread::sleep_for(
            std::chrono::duration<double>(setup.kind == FaultSetup::Kind::kBoth ? stop_s / 2 : stop_s));
        signal(name(which), SIGCONT);
        const double limit_s = name(which) == "phare-visual" ? kMayBeEnded_s + 7.0 : kMayBeEnded_s;
        if (stop_s > limit_s) ++result.stops_to_death;
      }
      wait_a_while();
    }
    result.exit_code = run.wait();
  }
  const auto report = report_of(out);
  if (report.is_object() && report.contains("restarts"))
    result.restarts_reported = static_cast<int>(report["restarts"].size());
  judge(record, setup.seed, result);
  return result;
}

}  // namespace phare::test
