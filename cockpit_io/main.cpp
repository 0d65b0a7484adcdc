// phare-cockpit: what the driver does, from CAN, a log, keys, a drive or a script, onto the bus.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "cockpit_io/learn_command.h"
#include "cockpit_io/process.h"
#include "cockpit_io/source.h"
#include "config/base/fail.h"
#include "config/base/standard_output.h"
#include "config/cockpit.h"
#include "config/empty_values.h"
#include "config/finite_numbers.h"
#include "config/port_base.h"
#include "config/rig.h"
#include "net/bus.h"
#include "net/clock.h"
#include "net/run_key.h"

namespace phare {
namespace {

struct Options {
  std::string rig_file, cockpit_file, source, dbc_file, log_file, drive_file, script_file, stats_file,
      log_level = "info";
  std::optional<std::uint16_t> port_base;
  bool lockstep = false, open_bus = false;
  std::string demo_file, alive_file, state_file;
  bool demo_at_once = false, any_gamepad = false;
  double picture_within_s = 0.0;
  bool learn = false, gamepad = false;
  std::string interface;
  double rest_s = 5.0, seconds = 0.0, log_speed = 0.0;
};

/// Whether the source has a use for what the command line says of one.
Status check_used(const Options& options, const CockpitConfig& config) {
  const std::string source =
      "means nothing to the source \"" + std::string(kSourceKindNames[static_cast<std::size_t>(config.source)]) + "\"";
  const bool bus = config.source == SourceKind::kCan, log = config.source == SourceKind::kLog;
  if (!options.dbc_file.empty() && !bus && !log) return Error{"--dbc " + options.dbc_file, source};
  if (!options.interface.empty() && !bus && !log) return Error{"--interface " + options.interface, source};
  if (options.log_speed > 0.0 && !log) return Error{"--log-speed", source};
  return Done{};
}

/// The cockpit file with what the command line puts in its place.
Result<CockpitConfig> configure(const Rig& rig, const Options& options) {
  Result<CockpitConfig> config =
      read_cockpit(options.cockpit_file.empty() ? rig.cockpit_file : std::filesystem::path(options.cockpit_file));
  if (!config) return config.error();
  config->keep_design = rig.keep_design;
  const auto choose = [&](SourceKind kind, const std::string& file) {
    config->source = kind;
    config->input_file = file;
  };
  if (!options.log_file.empty()) choose(SourceKind::kLog, options.log_file);
  if (!options.drive_file.empty()) choose(SourceKind::kDrive, options.drive_file);
  if (!options.script_file.empty()) choose(SourceKind::kDriver, options.script_file);
  if (!options.source.empty()) {
    const auto named = std::find(kSourceKindNames.begin(), kSourceKindNames.end(), options.source);
    config->source = static_cast<SourceKind>(named - kSourceKindNames.begin());
  }
  if (!options.interface.empty()) config->interface = options.interface;
  config->interface_is_asked = !options.interface.empty();
  if (config->source == SourceKind::kCan && config->interface.empty()) {
    return Error{config->file.string(),
                 "names no CAN interface: it needs [source] kind = \"can\" and interface = \"can0\""};
  }
  if (const Status used = check_used(options, *config); !used) return used.error();
  if (!options.dbc_file.empty()) config->dbc_file = options.dbc_file;
  config->demo_file = options.demo_file;
  config->demo_at_once = options.demo_at_once;
  config->any_gamepad = options.any_gamepad && config->also.empty();
  if (options.log_speed > 0.0) config->log_speed = options.log_speed;
  return config;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"What the driver of a rig does: stalk, wheel and pedals, from CAN, a log, keys, a drive or a script."};
  app.footer(
      "Example:\n  phare-cockpit --rig config/rigs/country_road.toml --cockpit config/cockpits/phare_stalk.toml --log "
      "config/examples/stalk.log");
  app.set_version_flag("--version", PHARE_VERSION);
  auto* rig_option = app.add_option("--rig", options.rig_file, "Rig file (TOML)");
  app.add_option("--cockpit", options.cockpit_file, "Cockpit file (default: the rig's)");
  app.add_option("--source", options.source, "can, log, keyboard, drive or driver (default: the cockpit file's)")
      ->check(CLI::IsMember(std::vector<std::string>(kSourceKindNames.begin(), kSourceKindNames.end())));
  app.add_option("--dbc", options.dbc_file, "DBC file (default: the cockpit file's)");
  auto* log = app.add_option("--log", options.log_file, "candump log to play");
  auto* drive = app.add_option("--drive", options.drive_file, "Drive file whose controls to play");
  auto* script = app.add_option("--script", options.script_file, "Script of a driver who follows the lane");
  log->excludes(drive)->excludes(script);
  drive->excludes(script);
  auto* demo = app.add_option("--demo", options.demo_file,
                              "With the keyboard: script of the demo driver, who takes the wheel at the key D");
  app.add_flag("--demo-at-once", options.demo_at_once, "The demo driver begins")->needs(demo);
  app.add_flag("--any-gamepad", options.any_gamepad,
               "With the keyboard: a gamepad that is plugged in drives as well (needs a display)");
  app.add_option("--wait-for-picture", options.picture_within_s,
                 "In real time: wait at most so many seconds for the picture, with the car")
      ->check(number_within(0.0, 3600.0));
  app.add_flag("--lockstep", options.lockstep, "Advance frame by frame with the picture, reproducibly");
  app.add_option("--stats", options.stats_file, "Write counters and latencies to this JSON file every second");
  app.add_option("--log-level", options.log_level, "trace, debug, info, warn, error, off");
  app.add_option("--log-speed", options.log_speed, "Play the log so many times as fast as it was recorded")
      ->check(number_within(0.01, 1000.0));
  auto* learn_flag =
      app.add_flag("--learn", options.learn,
                   "Show which signals change while the stalk is moved; with --interface or --log, and --dbc");
  app.add_option("--interface", options.interface,
                 "CAN interface, of a log the one whose frames to take (default: the cockpit file's)");
  app.add_flag("--gamepad", options.gamepad, "With --learn: the axes and buttons of a gamepad")->needs(learn_flag);
  app.add_option("--rest", options.rest_s, "With --learn: seconds in which nobody touches anything")
      ->check(number_within(0.0, 600.0))
      ->needs(learn_flag);
  app.add_option("--seconds", options.seconds, "With --learn: end after so long")->needs(learn_flag);
  app.add_option("--port-base", options.port_base, "First UDP port (default: the rig's)")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  app.add_flag("--open-bus", options.open_bus, "No key of the run: anyone on this machine may speak on the bus");
  app.add_option("--state", options.state_file,
                 "File of this run in which the controls are kept, for a process that takes this one's place");
  app.add_option("--alive", options.alive_file,
                 "File that says, ten times a second and more, that this process is not hung");
  take_finite_numbers_only(app);
  refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& wrong) {
    return fail("phare-cockpit", {"", std::string(wrong.what()) + " (see --help)"});
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("cockpit"));
  spdlog::set_level(spdlog::level::from_str(options.log_level));

  if (options.learn) {
    return learn(
        {options.interface, options.log_file, options.dbc_file, options.gamepad, options.rest_s, options.seconds},
        install_stop_signals());
  }
  if (rig_option->count() == 0) return fail("phare-cockpit", {"--rig", "is required"});

  Result<Rig> rig = read_rig(options.rig_file);
  if (!rig) return fail("phare-cockpit", rig.error());
  if (options.port_base) rig->port_base = *options.port_base;
  if (options.open_bus) rig->run_key = false;
  Result<CockpitConfig> config = configure(*rig, options);
  if (!config) return fail("phare-cockpit", config.error());
  const StopFlag stop = install_stop_signals();
  if (const Status key = take_run_key(*rig); !key) return fail("phare-cockpit", key.error());
  Result<Bus> bus = Bus::open(*rig, Role::kCockpit);
  if (!bus) return fail("phare-cockpit", bus.error());
  Result<std::unique_ptr<Source>> source = open_source(*config);
  if (!source) return fail("phare-cockpit", source.error());
  const Status ready = bus->ready_with_the_others(options.alive_file, [&] { return stop.requested(); });
  if (!ready) return fail("phare-cockpit", ready.error());
  if (stop) return kExitDone;  // before the drive has begun: nothing is written

  CockpitProcess process(std::move(*bus), std::move(*source), *rig, std::move(*config), options.stats_file,
                         options.state_file, stop);
  if (const Status taken = process.take_up_state(); !taken) return fail("phare-cockpit", taken.error());
  if (options.lockstep) {
    process.run_lockstep();
  } else {
    process.run_real_time(std::chrono::nanoseconds(static_cast<std::int64_t>(options.picture_within_s * 1e9)));
  }
  return kExitDone;
}

}  // namespace
}  // namespace phare

int main(int argc, char** argv) {
  return phare::end_of_output("phare-cockpit", phare::run(argc, argv));
}
