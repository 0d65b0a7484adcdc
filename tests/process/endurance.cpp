// phare-endurance: a long lockstep drive with a flood of garbage on every socket, eight seconds of every ten; in the
// other two the same flood goes to sockets nobody reads, so that its own work weighs on both.
// Prints what the project promises: garbage refused and counted, frame times as in the two seconds, memory that does
// not grow. Takes minutes: a command, not a test.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <span>
#include <thread>
#include <vector>

#include "net/drive_file.h"
#include "net/wire.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

struct Options {
  double minutes = 10.0;
  std::uint64_t garbage = 10'000'000;
  double rate_per_s = 40'000.0;
  std::string drive = source_dir() + "/config/drives/country_road.pcap", size = "160x90";
};

/// The drive over and over, one after the other, until it is long enough. At each seam the car is back at the start.
Status write_repeated(const Drive& drive, double wanted_s, const fs::path& out) {
  auto writer = DriveWriter::create(out, port_base());
  if (!writer) return writer.error();
  const std::int64_t period_ns = drive.duration.ns + 1'000'000'000 / 60;
  std::uint64_t sequence = 0;
  for (std::int64_t start_ns = 0; static_cast<double>(start_ns) * 1e-9 < wanted_s; start_ns += period_ns) {
    const bool last = static_cast<double>(start_ns + period_ns) * 1e-9 >= wanted_s;
    for (Datagram datagram : drive.datagrams) {
      auto* cockpit = std::get_if<CockpitState>(&datagram.payload);
      auto* car = std::get_if<VehicleState>(&datagram.payload);
      if (cockpit == nullptr && car == nullptr) continue;
      datagram.sim_time.ns += start_ns;
      datagram.sequence = ++sequence;
      if (cockpit != nullptr) cockpit->drive_ended = cockpit->drive_ended && last;
      if (car != nullptr) car->drive_ended = car->drive_ended && last;
      const std::string bytes = encode(datagram);
      if (const Status status = writer->write(datagram, std::as_bytes(std::span(bytes))); !status) return status;
    }
  }
  return Done{};
}

/// Resident memory, KiB.
double rss_kib(pid_t process) {
  std::ifstream statm("/proc/" + std::to_string(process) + "/statm");
  double size = 0.0, resident = 0.0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024.0;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

const std::map<std::string, int> kPorts{
    {"cockpit", 0}, {"dynamics", 1}, {"recorder", 2}, {"phare", 3}, {"visual-0", 10}};

/// The flood by the wall clock; frames that end near its edges belong to neither.
constexpr double kOn_s = 8.0, kPeriod_s = 10.0, kEdge_s = 0.25;

std::optional<bool> flooded_at(WallTime wall) {
  const double into_s = std::fmod(static_cast<double>(wall.ns) * 1e-9, kPeriod_s);
  if (into_s > kEdge_s && into_s < kOn_s - kEdge_s) return true;
  if (into_s > kOn_s + kEdge_s && into_s < kPeriod_s - kEdge_s) return false;
  return std::nullopt;
}

std::vector<ChildProcess> begin_flood(const Options& options, double per_s) {
  std::vector<ChildProcess> throwers;
  for (const auto& [process, offset] : kPorts) {
    auto thrower =
        ChildProcess::start(program("phare-throw-garbage"),
                            {"--port", std::to_string(port_base() + offset), "--count", std::to_string(options.garbage),
                             "--seed", std::to_string(offset + 1), "--rate", std::to_string(per_s), "--on",
                             std::to_string(kOn_s), "--period", std::to_string(kPeriod_s), "--quiet"});
    if (thrower) throwers.push_back(*thrower);
  }
  return throwers;
}

/// By program, a sample every half second of wall time, KiB.
using Samples = std::map<std::string, std::vector<double>>;

Samples watch(DriveRun& run, std::vector<ChildProcess>& throwers) {
  Samples samples;
  bool flood_over = false;
  while (run.running()) {
    for (const auto& [program, process] : run.processes()) {
      if (const double kib = rss_kib(process); kib > 0.0) samples[program].push_back(kib);
    }
    flood_over = true;
    for (ChildProcess& thrower : throwers) flood_over = thrower.ended().has_value() && flood_over;
    std::this_thread::sleep_for(500ms);
  }
  if (!flood_over) std::printf("the drive ended before the flood: counts are short of it\n");
  for (ChildProcess& thrower : throwers) {
    if (!thrower.ended()) thrower.send_signal(15);
  }
  return samples;
}

void say_memory(const Samples& rss, double minutes) {
  for (const auto& [program, samples] : rss) {
    const auto minute = static_cast<std::size_t>(static_cast<double>(samples.size()) / minutes);  // of simulated time
    if (minute < 4 || samples.size() < 3 * minute) continue;
    const auto middle_of = [&](std::size_t from) {
      const auto first = samples.begin() + static_cast<std::ptrdiff_t>(from);
      return median({first, first + static_cast<std::ptrdiff_t>(minute - 2)});
    };
    std::printf("%-15s resident, MiB, minute by minute:", program.c_str());
    for (std::size_t from = 0; from + minute <= samples.size(); from += minute)
      std::printf(" %.1f", middle_of(from) / 1024.0);
    std::printf("\n");
  }
}

/// From the recorded FrameReports: what a frame took, and from one to the next, with and without the flood.
Status say_times(const fs::path& recorded) {
  const auto drive = read_drive(recorded);
  if (!drive) return drive.error();
  std::vector<double> frame_ms[2], interval_ms[2];
  std::int64_t before_ns = 0;
  std::optional<bool> before;
  for (const Datagram& datagram : drive->datagrams) {
    const auto* report = std::get_if<FrameReport>(&datagram.payload);
    if (report == nullptr || report->frame_index < 0) continue;
    const std::optional<bool> flooded = flooded_at(datagram.sent);
    if (flooded) frame_ms[*flooded ? 1 : 0].push_back(report->frame_ms);
    if (flooded && before == flooded)
      interval_ms[*flooded ? 1 : 0].push_back(static_cast<double>(datagram.sent.ns - before_ns) * 1e-6);
    before = flooded;
    before_ns = datagram.sent.ns;
  }
  for (const int flooded : {0, 1}) {
    std::printf("%-8s %zu frames, %.3f ms a frame, %.3f ms frame to frame, at the median\n",
                flooded != 0 ? "flooded" : "quiet", frame_ms[flooded].size(), median(frame_ms[flooded]),
                median(interval_ms[flooded]));
  }
  std::printf("ratio    %.4f a frame, %.4f frame to frame\n", median(frame_ms[1]) / median(frame_ms[0]),
              median(interval_ms[1]) / median(interval_ms[0]));
  return Done{};
}

/// True when every datagram of the flood was refused, and nothing of the processes' own was taken for a stranger's.
bool say_counts(const Options& options, const json& report) {
  bool good = true;
  for (const auto& [process, offset] : kPorts) {
    const json& bus = report["processes"][process]["bus"];
    const auto refused = bus.value("refused", std::uint64_t{0}),
               early = bus.value("refused_in_kernel", std::uint64_t{0});
    const json& own = report["summary"]["messages"][process];
    // More than was thrown: messages of the drive that found no room behind the flood, and were sent again.
    good = good && refused >= options.garbage && own["lost"] == 0 && own["restarted"] == 0;
    std::printf(
        "%-9s thrown %llu, refused %llu: %llu by the socket (its filter, or no room), %s; own messages received "
        "%s, lost %s\n",
        process.c_str(), static_cast<unsigned long long>(options.garbage), static_cast<unsigned long long>(refused),
        static_cast<unsigned long long>(early), bus["refused_because"].dump().c_str(), own["received"].dump().c_str(),
        own["lost"].dump().c_str());
  }
  return good;
}

int fail(const Error& error) {
  std::fprintf(stderr, "phare-endurance: %s\n", error.text().c_str());
  return kExitBadInput;
}

int endure(const Options& options) {
  auto drive = read_drive(options.drive);
  if (!drive) return fail(drive.error());
  TemporaryFolder folder;
  if (const Status status = write_repeated(*drive, options.minutes * 60.0, folder / "long.pcap"); !status)
    return fail(status.error());
  const fs::path out = folder / "out", recorded = folder / "recorded.pcap";
  DriveRun run(out, folder.path(),
               {"--drive", (folder / "long.pcap").string(), "--size", options.size, "--record", recorded.string()});
  std::vector<ChildProcess> throwers;
  if (run.wait_for_frame(0)) throwers = begin_flood(options, options.rate_per_s);
  const Samples rss = watch(run, throwers);
  const int exit_code = run.wait();
  const json report = report_of(out);
  if (exit_code != 0 || !report.is_object()) {
    std::printf("phare drive ended with %d\n", exit_code);
    return kExitCheckFailed;
  }
  const bool good = say_counts(options, report);
  if (const Status status = say_times(recorded); !status) return fail(status.error());
  say_memory(rss, options.minutes);
  return good ? kExitDone : kExitCheckFailed;
}

}  // namespace
}  // namespace phare::test

int main(int argc, char** argv) {
  phare::test::Options options;
  CLI::App app{
      "Drives the demo drive for many minutes of simulated time under garbage, and tells what came of it.\n"
      "Example: phare-endurance --minutes 10 --garbage 10000000"};
  app.add_option("--minutes", options.minutes, "Simulated time")->check(CLI::Range(0.5, 600.0))->capture_default_str();
  app.add_option("--garbage", options.garbage, "Datagrams for each socket")->capture_default_str();
  app.add_option("--rate", options.rate_per_s, "Datagrams a second for each socket while the flood is on")
      ->capture_default_str();
  app.add_option("--drive", options.drive, "Drive file that is repeated")->capture_default_str();
  app.add_option("--size", options.size, "Size of the picture")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? phare::kExitDone : phare::kExitBadInput;
  }
  return phare::test::endure(options);
}
