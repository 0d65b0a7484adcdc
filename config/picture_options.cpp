#include "config/picture_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "config/eye.h"
#include "config/rig.h"

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

template <std::size_t count>
CLI::IsMember one_of(const std::array<std::string_view, count>& names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace

void PictureOptions::add_to(CLI::App& app) {
  const auto declare = [&](CLI::Option* option) {
    option->group("Picture");
    declared_.push_back(option);
    return option;
  };
  declare(app.add_option("--frames", frames, "Keep each of the first N frames as a picture, then end"))
      ->check(CLI::Range(1, 1'000'000));
  declare(app.add_option_function<std::string>(
              "--size", [this](const std::string& text) { parse_size(text, width_px, height_px); },
              "WIDTHxHEIGHT of the picture in pixels, such as 1280x720 [the rig's]"))
      ->check(
          [](const std::string& text) {
            int width_px = 0, height_px = 0;
            return parse_size(text, width_px, height_px)
                       ? std::string()
                       : "expected WIDTHxHEIGHT of 16 to 8192 pixels, got '" + text + "'";
          },
          "", "size");
  declare(app.add_option("--samples", samples, "Samples a pixel: 1 or 4"))
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  declare(
      app.add_option("--camera", camera, "Eye of the picture: the driver's, one above the road, one behind the car"))
      ->check(one_of(kCameraNames))
      ->capture_default_str();
  declare(app.add_option("--still-at", still_at_s,
                         "Simulated time of the stills, s [a fifth of the drive, on low beam, moving]"))
      ->check(CLI::NonNegativeNumber);
  declare(app.add_option("--exposure", exposure_per_cdm2, "Exposure, 1/(cd/m2)"))
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  declare(app.add_option("--adaptation", adaptation,
                         "Light of this colour temperature in K looks white, or auto: the eye follows the lamps [the "
                         "rig's]"))
      ->check(
          [](const std::string& text) {
            const auto setting = parse_adaptation(text);
            return setting ? std::string() : setting.error().reason;
          },
          "", "adaptation");
  declare(app.add_flag("--false-colour", false_colour, "Begin with illuminance in false colour"));
  declare(app.add_option("--beam-image", beam_image,
                         "How beam images are stored and looked up, instead of the rig's: what accuracy costs in time"))
      ->check(one_of(kImageLevelNames));
  declare(app.add_option("--audit-every", audit_every, "Frames between self-audits, 0: never"))
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  declare(app.add_option("--device", device_name, "Take the Vulkan device whose name contains this"));
  declare(app.add_flag("--validation", validation, "Vulkan validation with synchronization validation"));
}

std::vector<std::string> PictureOptions::arguments() const {
  std::vector<std::string> words;
  for (const CLI::Option* option : declared_) {
    if (option->count() == 0) continue;
    words.push_back(option->get_name());
    if (option->get_expected_max() > 0)
      for (const std::string& value : option->results()) words.push_back(value);
  }
  return words;
}

}  // namespace phare
