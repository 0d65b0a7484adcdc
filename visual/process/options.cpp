#include "visual/process/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "config/base/fail.h"
#include "config/base/log_levels.h"
#include "config/cockpit.h"
#include "config/empty_values.h"
#include "config/finite_numbers.h"
#include "config/picture_options.h"
#include "config/port_base.h"
#include "visual/photometry/beam/image_levels.h"

namespace phare {

ParsedOptions parse_options(int argc, const char* const* argv) {
  VisualOptions options;
  PictureOptions picture;
  std::uint16_t port_base = 0;
  CLI::App app{"Draws the night road of one channel from CockpitState and VehicleState.", "phare-visual"};
  app.footer(
      "Example:\n  phare-visual --rig config/rigs/country_road.toml --headless --lockstep --frames 60 --out out");
  app.set_version_flag("--version", PHARE_VERSION);
  app.add_option("--rig", options.rig_file, "Rig file")->required();
  auto* drive = app.add_option("--drive", options.drive_file, "Drive file being replayed; tells how long the drive is");
  app.add_option("--channel", options.channel, "Which visual channel of the rig")->capture_default_str();
  app.add_flag("--lockstep", options.lockstep, "One frame per simulated frame time, reproducible bit for bit");
  app.add_flag("--law", options.law,
               "A control law leads the lamps (docs/control-law.md); in lockstep each frame waits for it");
  app.add_flag("--headless", options.headless, "No window");
  app.add_flag("--go-on", options.going_on,
               "Take the place of one that was killed: keep the pictures it left in --out");
  app.add_option("--out", options.out, "Folder for pictures (headless: out)");
  app.add_option("--stats", options.stats_file, "Statistics file (JSON); visual-<channel>.json in --out");
  app.add_option(
         "--guide", options.guide,
         "Somebody sits at the window and drives (live) or looks on (replay): tell how to begin and what can be "
         "done at the end, and wait there")
      ->check(CLI::IsMember({"live", "replay"}));
  app.add_flag("--demo", options.demo, "With --guide: the demo driver waits for his key");
  app.add_option("--report", options.report, "With --guide: where the end screen says that the report will lie");
  auto* explain = app.add_flag("--explain", options.explain,
                               "Print each effect with its level and the reason, for the moment --still-at of --drive "
                               "or for --light and --fog; nothing is drawn but with --cost");
  std::string light;
  app.add_option("--light", light, "With --explain: the light switch [low]")
      ->check(CLI::IsMember(std::vector<std::string>(kLightSwitchNames.begin(), kLightSwitchNames.end())))
      ->excludes(drive)
      ->needs(explain);
  app.add_flag("--fog", options.explain_fog, "With --explain: the front fog lamps too")
      ->excludes(drive)
      ->needs(explain);
  app.add_flag("--cost", options.explain_cost,
               "With --explain: draw that moment without a window, --frames times [30], and print passes, bytes and ms "
               "of each effect too")
      ->needs(explain);
  // From phare drive, which picks them: no words for people.
  app.add_option("--budget-ms", options.budget_ms)->check(CLI::PositiveNumber)->group("");
  app.add_option("--picked", options.picked)->group("");
  app.add_option("--begin-level", options.begin_level)->group("");
  app.add_option_function<std::string>(
         "--level", [&](const std::string& words) { options.levels.push_back(*governor_level(words)); })
      ->check([](const std::string& words) { return governor_level(words) ? "" : "\"" + words + "\" is no level"; })
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->trigger_on_parse()
      ->group("");
  picture.add_to(app);
  app.add_option("--log-level", options.log_level, "trace, debug, info, warn, error, off")
      ->check(CLI::IsMember(kLogLevelNames))
      ->capture_default_str();
  app.add_option("--port-base", port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  app.add_flag("--open-bus", options.open_bus, "No key of the run: anyone on this machine may speak on the bus");
  app.add_option("--alive", options.alive_file, "File that says, with every frame, that this process is not hung");
  take_finite_numbers_only(app);
  refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return {std::nullopt, app.exit(help)};
  } catch (const CLI::ParseError& wrong) {
    return {std::nullopt, fail("phare-visual", {"", std::string(wrong.what()) + " (see --help)"})};
  }
  if (!light.empty())
    options.explain_light =
        static_cast<LightSwitch>(std::ranges::find(kLightSwitchNames, light) - kLightSwitchNames.begin());
  options.frames = picture.frames;
  options.width_px = picture.width_px;
  options.height_px = picture.height_px;
  options.samples = picture.samples;
  options.frames_in_flight = picture.frames_in_flight;
  options.still_at_s = picture.still_at_s;
  options.video = picture.video;
  if (!picture.traffic.empty()) options.traffic_file = picture.traffic;
  options.desk = picture.desk;
  options.road_cuts = picture.road_cuts;
  options.audit_every = picture.audit_every;
  options.audit_bound = picture.audit_bound;
  if (!options.levels.empty()) options.begin_level = std::min(options.begin_level, options.levels.size() - 1);
  options.beam_image = level_named(picture.beam_image);
  options.validation = picture.validation;
  options.device_name = picture.device_name;
  if (port_base != 0) options.port_base = port_base;
  if (options.headless && options.out.empty()) options.out = "out";
  if (options.stats_file.empty() && !options.out.empty()) {
    options.stats_file = options.out / ("visual-" + std::to_string(options.channel) + ".json");
  }
  return {options, kExitDone};
}

}  // namespace phare
