// phare-dynamics: the car. Takes the driver's controls from the bus, gives the pose of the car.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>

#include "config/base/fail.h"
#include "config/base/log_levels.h"
#include "config/base/standard_output.h"
#include "config/empty_values.h"
#include "config/finite_numbers.h"
#include "config/port_base.h"
#include "config/rig.h"
#include "net/bus.h"
#include "net/clock.h"
#include "net/run_key.h"
#include "net/state_file.h"
#include "vehicle_dynamics/batch_command.h"
#include "vehicle_dynamics/begin.h"
#include "vehicle_dynamics/process.h"

namespace phare {
namespace {

struct Options {
  std::string rig_file, drive_file, stats_file, state_file, alive_file, level, log_level = "info";
  std::optional<std::uint16_t> port_base;
  bool lockstep = false, open_bus = false;
  double picture_within_s = 0.0;  // real time: begin when every picture is ready, after so long at the latest
};

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"The car of a rig: controls in, pose out."};
  app.footer("Example:\n  phare-dynamics --rig config/rigs/country_road.toml --lockstep --level kinematic");
  app.set_version_flag("--version", PHARE_VERSION);
  app.add_option("--rig", options.rig_file, "Rig file (TOML)");
  app.add_flag("--lockstep", options.lockstep, "Advance frame by frame with the picture, reproducibly");
  app.add_option("--drive", options.drive_file,
                 "Drive file to replay (pose) or to take the first pose from (kinematic)");
  app.add_option("--level", options.level,
                 "Model: pose, kinematic, single-track, full, auto (default: the rig's; batch: full)");
  app.add_option("--wait-for-picture", options.picture_within_s,
                 "In real time: begin when every picture is ready, after so many seconds at the latest")
      ->check(number_within(0.0, 3600.0));
  app.add_option("--stats", options.stats_file, "Write counters and times to this JSON file every second");
  app.add_option("--state", options.state_file,
                 "File of this run in which the car's state is kept, for a process that takes this one's place");
  app.add_option("--log-level", options.log_level, "How much to tell")->check(CLI::IsMember(kLogLevelNames));
  app.add_option("--port-base", options.port_base, "First UDP port (default: the rig's)")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  app.add_flag("--open-bus", options.open_bus, "No key of the run: anyone on this machine may speak on the bus");
  app.add_option("--alive", options.alive_file,
                 "File that says, ten times a second and more, that this process is not hung");
  BatchCommand batch;
  batch.add_to(app);
  take_finite_numbers_only(app);
  refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() != 0) return fail("phare-dynamics", {"command line", problem.what()});
    app.exit(problem);  // --help, --version
    return kExitDone;
  }
  if (const Status fit = batch.options_fit(); !fit) return fail("phare-dynamics", fit.error());
  if (batch.asked()) return batch.run(options.level.empty() ? "full" : options.level);
  if (options.rig_file.empty()) return fail("phare-dynamics", {"--rig", "is required, unless --batch runs a file"});
  spdlog::set_default_logger(spdlog::stderr_color_mt("dynamics"));
  spdlog::set_level(spdlog::level::from_str(options.log_level));

  Result<Rig> rig = read_rig(options.rig_file);
  if (!rig) return fail("phare-dynamics", rig.error());
  if (options.port_base) rig->port_base = *options.port_base;
  if (options.open_bus) rig->run_key = false;
  StopFlag stop = install_stop_signals();
  if (!batch.vehicle().empty()) rig->vehicle_file = batch.vehicle();
  Result<Begin> begin = begin_of(*rig, {options.level, options.drive_file, batch.levelling(), batch.conditions()});
  if (!begin) return fail("phare-dynamics", begin.error());
  if (const Status key = take_run_key(*rig); !key) return fail("phare-dynamics", key.error());
  Result<Bus> bus = Bus::open(*rig, Role::kDynamics);
  if (!bus) return fail("phare-dynamics", bus.error());
  std::optional<StateFile> kept;
  if (!options.state_file.empty()) {
    Result<StateFile> opened = DynamicsProcess::open_state(options.state_file);
    if (!opened) return fail("phare-dynamics", opened.error());
    kept.emplace(std::move(*opened));
  }
  const Status ready = bus->ready_with_the_others(options.alive_file, [&] { return stop.requested(); });
  if (!ready) return fail("phare-dynamics", ready.error());
  if (stop) return kExitDone;  // before the drive has begun: nothing is written
  DynamicsProcess(std::move(*bus), *rig, {options.lockstep, options.stats_file, options.picture_within_s},
                  std::move(kept), stop)
      .run(std::move(*begin));
  return kExitDone;
}

}  // namespace
}  // namespace phare

int main(int argc, char** argv) {
  return phare::end_of_output("phare-dynamics", phare::run(argc, argv));
}
