#include "tools/drive_processes.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "tools/commands.h"
#include "tools/demo_drive.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

// In real time the drive begins when every picture is ready; a busy machine without a GPU took a minute.
constexpr const char* kPictureWithin_s = "180";

/// What the processes are told where somebody sits at the window, and when to begin.
void add_person(const Rig& rig, const DriveOptions& options, std::vector<ProcessSpec>& specs) {
  const bool live = options.guide == "live";
  const std::optional<std::string> demo = demo_script(rig, config_path(""));
  for (ProcessSpec& spec : specs) {
    const auto add = [&](std::initializer_list<std::string> words) {
      spec.arguments.insert(spec.arguments.end(), words);
    };
    const bool picture = spec.name.starts_with("visual-");
    if (!picture && !options.lockstep) add({"--wait-for-picture", kPictureWithin_s});
    if (spec.name == "cockpit" && live) add({"--any-gamepad"});
    if (spec.name == "cockpit" && live && demo) add({"--demo", *demo});
    if (spec.name == "cockpit" && live && demo && options.demo_at_once) add({"--demo-at-once"});
    if (spec.name != "visual-0" || options.guide.empty()) continue;
    add({"--guide", options.guide});
    if (demo) add({"--demo"});
    if (!options.out.empty()) add({"--report", (fs::path(options.out) / "index.html").string()});
  }
}

}  // namespace

fs::path stats_folder(const DriveOptions& options, const RunFiles& files) {
  if (!options.out.empty()) return options.out;
  return options.picture.validation ? files.folder() : fs::path{};
}

std::vector<ProcessSpec> processes_of(const Rig& rig, const DriveOptions& options, const RunFiles& files) {
  const auto common = [&](const std::string& name) {
    std::vector<std::string> arguments{"--rig",       rig.file.string(), "--port-base", std::to_string(rig.port_base),
                                       "--log-level", options.log_level, "--alive",     files.alive(name).string()};
    if (options.open_bus) arguments.push_back("--open-bus");
    if (options.lockstep) arguments.push_back("--lockstep");
    if (!options.drive.empty()) arguments.insert(arguments.end(), {"--drive", options.drive});
    if (const fs::path folder = stats_folder(options, files); !folder.empty())
      arguments.insert(arguments.end(), {"--stats", (folder / (name + ".json")).string()});
    return arguments;
  };
  ProcessSpec cockpit{"cockpit", program_beside_us("phare-cockpit"), common("cockpit")};
  cockpit.arguments.insert(cockpit.arguments.end(), {"--cockpit", rig.cockpit_file.string()});
  cockpit.arguments.insert(cockpit.arguments.end(), {"--state", files.state("cockpit").string()});
  if (!options.script.empty()) cockpit.arguments.insert(cockpit.arguments.end(), {"--script", options.script});
  if (!options.log.empty()) cockpit.arguments.insert(cockpit.arguments.end(), {"--log", options.log});
  if (!options.dbc.empty()) cockpit.arguments.insert(cockpit.arguments.end(), {"--dbc", options.dbc});

  ProcessSpec dynamics{"dynamics", program_beside_us("phare-dynamics"), common("dynamics")};
  dynamics.arguments.insert(dynamics.arguments.end(), {"--state", files.state("dynamics").string()});
  // Open loop shows the recorded poses; closed loop lets the car answer the recorded controls.
  if (!options.drive.empty() && !options.closed_loop)
    dynamics.arguments.insert(dynamics.arguments.end(), {"--level", "pose"});
  else if (!options.level.empty())
    dynamics.arguments.insert(dynamics.arguments.end(), {"--level", options.level});
  if (!options.vehicle.empty())
    dynamics.arguments.insert(dynamics.arguments.end(), {"--vehicle", rig.vehicle_file.string()});
  dynamics.arguments.insert(dynamics.arguments.end(), options.car_and_road.begin(), options.car_and_road.end());

  std::vector<ProcessSpec> specs{dynamics, cockpit};
  for (std::size_t channel = 0; channel < rig.channels.size(); ++channel) {
    const std::string name = "visual-" + std::to_string(channel);
    ProcessSpec visual{name, program_beside_us("phare-visual"), common(name), true};
    auto& arguments = visual.arguments;
    arguments.insert(arguments.end(), {"--channel", std::to_string(channel)});
    if (options.headless) arguments.push_back("--headless");
    if (options.law) arguments.push_back("--law");
    for (const std::string& setting : options.desk) arguments.insert(arguments.end(), {"--set", setting});
    const std::vector<std::string> picture = options.picture.arguments();
    arguments.insert(arguments.end(), picture.begin(), picture.end());
    arguments.insert(arguments.end(), options.picked_arguments.begin(), options.picked_arguments.end());
    if (!options.out.empty()) {
      const fs::path out = channel == 0 ? fs::path(options.out) : fs::path(options.out) / rig.channels[channel].name;
      arguments.insert(arguments.end(), {"--out", out.string()});
      visual.restart_arguments = {"--go-on"};
    }
    // A picture may take long, and a covered window is shown none.
    visual.hung_after = {.idle = std::chrono::seconds(10),
                         .beginning = std::chrono::seconds(60),
                         .busy = std::chrono::minutes(10),
                         .may_be_covered = !options.headless};
    specs.push_back(std::move(visual));
  }
  for (ProcessSpec& spec : specs) spec.alive_file = files.alive(spec.name);
  add_person(rig, options, specs);
  return specs;
}

}  // namespace phare
