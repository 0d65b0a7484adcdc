#include "visual/process/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>

#include "visual/photometry/image_levels.h"

namespace phare {
namespace {

/// "1280x720"
bool parse_size(const std::string& text, int& width_px, int& height_px) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, width_px);
  if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') return false;
  const auto height = std::from_chars(width.ptr + 1, end, height_px);
  return height.ec == std::errc{} && height.ptr == end && width_px >= 16 && height_px >= 16 && width_px <= 8192 &&
         height_px <= 8192;
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  VisualOptions options;
  std::string size, beam_image;
  std::uint16_t port_base = 0;
  CLI::App app{"Draws the night road of one channel from CockpitState and VehicleState.", "phare-visual"};
  app.footer(
      "Example:\n  phare-visual --rig config/rigs/country_road.toml --headless --lockstep --frames 60 --out out");
  app.add_option("--rig", options.rig_file, "Rig file")->required();
  app.add_option("--drive", options.drive_file, "Drive file being replayed; tells how long the drive is");
  app.add_option("--channel", options.channel, "Which visual channel of the rig")->capture_default_str();
  app.add_flag("--lockstep", options.lockstep, "One frame per simulated frame time, reproducible bit for bit");
  app.add_flag("--headless", options.headless, "No window");
  app.add_flag("--go-on", options.going_on,
               "Take the place of one that was killed: keep the pictures it left in --out");
  app.add_option("--frames", options.frames, "Save each of the first N frames, then leave")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--size", size, "WIDTHxHEIGHT of the picture in pixels, such as 1280x720");
  app.add_option("--samples", options.samples, "Samples a pixel: 1 or 4")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  app.add_option("--out", options.out, "Folder for pictures (headless: out)");
  app.add_option("--stats", options.stats_file, "Statistics file (JSON); visual-<channel>.json in --out");
  app.add_option("--still-at", options.still_at_s, "Simulated time of the stills, s")->check(CLI::NonNegativeNumber);
  app.add_option("--exposure", options.exposure_per_cdm2, "Exposure, 1/(cd/m2)")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  app.add_option("--audit-every", options.audit_every, "Frames between self-audits, 0: never")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  app.add_option("--beam-image", beam_image,
                 "How beam images are stored and looked up, instead of the rig's: what accuracy costs in time")
      ->check(CLI::IsMember(level_names()));
  app.add_flag("--false-colour", options.false_colour, "Begin with illuminance in false colour");
  app.add_option(
         "--guide", options.guide,
         "Somebody sits at the window and drives (live) or looks on (replay): tell how to begin and what can be "
         "done at the end, and wait there")
      ->check(CLI::IsMember({"live", "replay"}));
  app.add_flag("--demo", options.demo, "With --guide: the demo driver waits for his key");
  app.add_option("--report", options.report, "With --guide: where the end screen says that the report will lie");
  app.add_flag("--validation", options.validation, "Vulkan validation with synchronization validation");
  app.add_option("--device", options.device_name, "Take the Vulkan device whose name contains this");
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
  if (!size.empty() && !parse_size(size, options.width_px, options.height_px)) {
    std::fprintf(stderr, "phare-visual: --size: expected WIDTHxHEIGHT of 16 to 8192 pixels, got '%s'\n", size.c_str());
    return {std::nullopt, kExitBadInput};
  }
  options.beam_image = level_named(beam_image);
  if (port_base != 0) options.port_base = port_base;
  if (options.headless && options.out.empty()) options.out = "out";
  if (options.stats_file.empty() && !options.out.empty()) {
    options.stats_file = options.out / ("visual-" + std::to_string(options.channel) + ".json");
  }
  return {options, kExitDone};
}

}  // namespace phare
