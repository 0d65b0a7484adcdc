#include "visual/process/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "config/picture_options.h"
#include "visual/photometry/image_levels.h"

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
  app.add_option("--drive", options.drive_file, "Drive file being replayed; tells how long the drive is");
  app.add_option("--channel", options.channel, "Which visual channel of the rig")->capture_default_str();
  app.add_flag("--lockstep", options.lockstep, "One frame per simulated frame time, reproducible bit for bit");
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
  picture.add_to(app);
  app.add_option("--log-level", options.log_level, "trace, debug, info, warn, error, off")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
  app.add_option("--port-base", port_base, "First UDP port, instead of the rig's")->check(CLI::Range(1024, 65000));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return {std::nullopt, app.exit(help)};
  } catch (const CLI::ParseError& wrong) {
    std::fprintf(stderr, "phare-visual: %s (see --help)\n", wrong.what());
    return {std::nullopt, kExitBadInput};
  }
  options.frames = picture.frames;
  options.width_px = picture.width_px;
  options.height_px = picture.height_px;
  options.samples = picture.samples;
  options.camera = static_cast<CameraKind>(std::ranges::find(kCameraNames, picture.camera) - kCameraNames.begin());
  options.still_at_s = picture.still_at_s;
  options.exposure_per_cdm2 = picture.exposure_per_cdm2;
  options.audit_every = picture.audit_every;
  options.false_colour = picture.false_colour;
  options.beam_image = level_named(picture.beam_image);
  options.validation = picture.validation;
  options.device_name = picture.device_name;
  if (!picture.adaptation.empty()) {
    const auto setting = parse_adaptation(picture.adaptation);
    if (!setting) {
      std::fprintf(stderr, "phare-visual: %s\n", setting.error().text().c_str());
      return {std::nullopt, kExitBadInput};
    }
    options.adaptation = *setting;
  }
  if (port_base != 0) options.port_base = port_base;
  if (options.headless && options.out.empty()) options.out = "out";
  if (options.stats_file.empty() && !options.out.empty()) {
    options.stats_file = options.out / ("visual-" + std::to_string(options.channel) + ".json");
  }
  return {options, kExitDone};
}

}  // namespace phare
