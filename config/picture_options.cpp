#include "config/picture_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <limits>

#include "config/desk_cameras.h"
#include "config/finite_numbers.h"
#include "config/picture_size.h"
#include "config/rig.h"

namespace phare {
namespace {

/// "1280x720"
bool parse_size(const std::string& text, int& width_px, int& height_px) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, width_px);
  if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') return false;
  const auto height = std::from_chars(width.ptr + 1, end, height_px);
  return height.ec == std::errc{} && height.ptr == end && std::min(width_px, height_px) >= kLeastSide_px &&
         std::max(width_px, height_px) <= kMostSide_px;
}

template <std::size_t count>
CLI::IsMember one_of(const std::array<std::string_view, count>& names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

/// Why a desk would not take it, empty where it would; whether a rig has such a design or camera is seen when it is
/// read.
std::string why_not(const DeskCommand& command) {
  Desk desk;
  if (command.value.empty()) return "expected SETTING=VALUE";
  // A camera may be the rig's own, which is seen when that is read too.
  if ((command.setting == "camera" || command.setting == "second_camera") && check_camera_name(command.value))
    return {};
  const auto done = apply(desk, command, {.designs = std::numeric_limits<std::size_t>::max()});
  return done ? std::string() : done.error().text();
}

}  // namespace

DeskCommand setting_of(const std::string& words) {
  const std::size_t equals = std::min(words.find('='), words.size());
  return {words.substr(0, equals), words.substr(std::min(equals + 1, words.size()))};
}

std::optional<double> share_of_percent(const std::string& text) {
  double percent = 0.0;
  const char* const end = text.data() + text.size();
  auto [stop, failed] = std::from_chars(text.data(), end, percent);
  if (failed != std::errc{}) return std::nullopt;
  if (stop != end && *stop == ' ') ++stop;
  if (std::string_view(stop, end) != "%" || !(percent > 0.0 && percent <= 100.0)) return std::nullopt;
  return 0.01 * percent;
}

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
                       : "expected WIDTHxHEIGHT of " + std::to_string(kLeastSide_px) + " to " +
                             std::to_string(kMostSide_px) + " pixels, got '" + text + "'";
          },
          "", "size");
  declare(app.add_option("--samples", samples, "Samples a pixel: 1 or 4"))
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  // Short names of settings of the desk; --set reaches them all.
  const auto setting = [&](const char* option, const char* name, const char* says) {
    return declare(app.add_option_function<std::string>(
        option,
        [this, name](const std::string& value) {
          desk.push_back({name, value});
        },
        says));
  };
  const auto checked = [&](const char* option, const char* name, const char* says) {
    setting(option, name, says)->check([name](const std::string& value) { return why_not({name, value}); }, "", name);
  };
  // The names that there are always, for help and completion.
  std::string cameras;
  for (const std::string_view name : kCameraNames) cameras += (cameras.empty() ? "{" : ",") + std::string(name);
  setting("--camera", "camera", "Eye of the picture: one of these, or one of the rig's own cameras [driver]")
      ->check(
          [](const std::string& value) {
            return why_not({"camera", value});
          },
          cameras + "}", "camera");
  checked("--exposure", "exposure_per_cdm2", "Exposure, 1/(cd/m2) [0.3]");
  checked("--adaptation", "adaptation_k",
          "Light of this colour temperature in K looks white, or auto: the eye follows the lamps [the rig's]");
  setting("--method", "method", "Where illuminance is computed: what accuracy costs in time [fragment]")
      ->check(one_of(kMethodNames));
  declare(app.add_flag_callback(
      "--false-colour",
      [this] {
        desk.push_back({"view", "false-colour"});
      },
      "Begin with illuminance in false colour"));
  declare(app.add_option_function<std::vector<std::string>>(
              "--set",
              [this](const std::vector<std::string>& settings) {
                for (const std::string& words : settings) {
                  const DeskCommand command = setting_of(words);
                  // Before --camera, wherever it stands, which may name one of them.
                  const auto at = command.setting != "cameras"
                                      ? desk.end()
                                      : std::ranges::find_if(
                                            desk, [](const DeskCommand& each) { return each.setting != "cameras"; });
                  desk.insert(at, command);
                }
              },
              "SETTING=VALUE of the picture, as phare control set has them (docs/control.md); repeat for more"))
      ->allow_extra_args(false)
      ->check([](const std::string& words) { return why_not(setting_of(words)); }, "", "setting");
  declare(app.add_option("--still-at", still_at_s,
                         "Simulated time of the stills, s [a fifth of the drive, on low beam, moving]"))
      ->check(number_within(0.0, 1e9));
  declare(app.add_option("--traffic", traffic, "Other road users, a TOML file (docs/traffic.md) [the rig's]"))
      ->check(CLI::ExistingFile);
  declare(app.add_flag("--video", video,
                       "The video of the drive has every frame [one each tenth of a second]; its pictures take room"));
  declare(app.add_option("--beam-image", beam_image,
                         "How beam images are stored and looked up, instead of the rig's: what accuracy costs in time"))
      ->check(one_of(kImageLevelNames));
  declare(app.add_option("--road-lod", road_cuts,
                         "Cut each triangle of the ground in four, so many times: what methods by vertex need"))
      ->check(CLI::Range(0, kMostRoadCuts))
      ->capture_default_str();
  declare(app.add_option("--audit-every", audit_every, "Frames between self-audits, 0: never"))
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  declare(app.add_option_function<std::string>(
              "--audit-bound", [this](const std::string& text) { audit_bound = share_of_percent(text); },
              "Most that an audited pixel may be off by, such as 1%, in place of what its level states; one that is "
              "off by more fails a lockstep drive"))
      ->check(
          [](const std::string& text) {
            return share_of_percent(text) ? std::string()
                                          : "expected a share of the light in percent, such as 1%, got '" + text + "'";
          },
          "", "percent");
  declare(app.add_option("--frames-in-flight", frames_in_flight,
                         "In real time: 2 prepares a frame while the device draws the one before, 1 shows each sooner "
                         "[2; in a window without a GPU 1]"))
      ->check(CLI::IsMember({1, 2}));
  declare(app.add_option("--device", device_name, "Take the Vulkan device whose name contains this"));
  declare(app.add_flag("--validation", validation, "Vulkan validation with synchronization validation"));
}

std::vector<std::string> PictureOptions::arguments() const {
  std::vector<std::string> words;
  for (const CLI::Option* option : declared_) {
    if (option->count() == 0) continue;
    if (option->get_expected_max() == 0) words.push_back(option->get_name());
    for (const std::string& value : option->get_expected_max() > 0 ? option->results() : CLI::results_t{}) {
      words.push_back(option->get_name());
      words.push_back(value);
    }
  }
  return words;
}

}  // namespace phare
