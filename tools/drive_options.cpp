#include "tools/drive_options.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "config/base/input_files.h"
#include "config/base/log_levels.h"
#include "config/base/whole_file.h"
#include "config/cockpit.h"
#include "config/finite_numbers.h"
#include "config/formats/toml_table.h"
#include "config/key_bindings.h"
#include "config/port_base.h"
#include "config/vehicle.h"
#include "tools/child_process.h"
#include "tools/commands.h"
#include "tools/demo_drive.h"
#include "tools/drive_folder.h"
#include "tools/recorder.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

bool set_in_environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

/// The design of the rig that is meant by a name or a number.
std::optional<std::size_t> design_named(const Rig& rig, const std::string& name) {
  for (std::size_t i = 0; i < rig.designs.size(); ++i)
    if (rig.designs[i].name == name || std::to_string(i) == name) return i;
  return std::nullopt;
}

/// Which design is shown, and which stands beside it; one made of a lamp comes behind that which is shown.
/// `as_filed`: the rig before a lamp of one's own was put into it.
Status choose_designs(Rig& rig, const Rig& as_filed, DriveOptions& options) {
  options.desk.clear();
  options.made_design = options.lamps.any();
  if (!options.design.empty()) {
    const auto design = design_named(rig, options.design);
    if (!design) {
      std::vector<std::string> names;
      for (const DesignConfig& known : rig.designs) names.push_back(known.name);
      return Error{"--design", unknown_name_reason("design", options.design, names)};
    }
    options.desk.push_back("design=" + std::to_string(*design));
  }
  if (!options.lamps.any() && (options.versus.empty() || design_named(rig, options.versus))) {
    if (const Status status = nothing_of_a_lamp(options.lamps); !status) return status;
  }
  if (options.versus.empty()) return Done{};
  const bool shown_by_hand =
      std::ranges::any_of(options.picture.desk, [](const DeskCommand& command) { return command.setting == "design"; });
  auto other = design_named(rig, options.versus);
  if (!other) {
    Rig made = as_filed;
    LampFlags flags{.low = {options.versus}, .aim = options.lamps.aim, .others = options.lamps.others};
    const auto notes = put_lamp_design(made, flags);
    if (!notes)
      return Error{"--versus " + options.versus, "is no design of the rig, and as a lamp: " + notes.error().text()};
    if (!options.design.empty())
      return Error{"--design", "stands beside another design of the rig; with a lamp of one's own leave it out"};
    DesignConfig design = made.designs.front();
    for (const DesignConfig& known : rig.designs)
      if (known.name == design.name) design.name += " (B)";
    rig.designs.insert(rig.designs.begin() + 1, std::move(design));
    rig.keep_design = true;
    options.made_design = true;
    options.lamp_told.lines.insert(options.lamp_told.lines.end(), notes->lines.begin(), notes->lines.end());
    options.lamp_told.warnings.insert(options.lamp_told.warnings.end(), notes->warnings.begin(), notes->warnings.end());
    options.desk.push_back("design=0");
    other = 1;
  } else if (options.design.empty() && !shown_by_hand) {
    // A stays A, whatever design a recorded drive goes to: one comparison, one table.
    options.desk.push_back("design=0");
    if (*other == 0)
      return Error{"--versus " + options.versus, "is the design that shines; --design says what it stands beside"};
  } else if (!options.design.empty() && design_named(rig, options.design) == other) {
    return Error{"--versus " + options.versus, "is the design that --design names"};
  }
  options.desk.insert(options.desk.end(), {"compare=split", "versus=" + std::to_string(*other)});
  return Done{};
}

/// As the picture begins: as the rig has it, as --design and --versus choose, then as it is set by hand. Error: it
/// cannot be, or a design would be compared with itself.
Status check_desk(const Rig& rig, const DriveOptions& options) {
  Desk desk = rig.desk;
  std::vector<DeskCommand> commands;
  for (const std::string& words : options.desk) commands.push_back(setting_of(words));
  commands.insert(commands.end(), options.picture.desk.begin(), options.picture.desk.end());
  for (const DeskCommand& command : commands)
    if (const auto done = apply(desk, command, {.designs = rig.designs.size()}); !done) return done.error();
  if (desk.compare == Compare::kOff || !desk.versus || desk.versus != desk.design) return Done{};
  return Error{"versus " + std::to_string(*desk.versus),
               options.design.empty() ? "is the design that shines" : "is the design that --design names"};
}

/// Lamps of one's own, and what every adjuster of the rig was turned by.
Status aim_lamps(Rig& rig, DriveOptions& options) {
  auto notes = options.lamps.any() ? put_lamp_design(rig, options.lamps) : aim_notes(rig);
  if (!notes) return notes.error();
  options.lamp_told = std::move(*notes);
  options.lamp_notes.clear();
  for (const std::string& line : options.lamp_told.lines) options.lamp_notes += line + "\n";
  return Done{};
}

/// A folder that holds a drive of another command line stays as it is: this one goes beside it.
void settle_out(DriveOptions& options) {
  if (options.out.empty() || options.overwrite || options.explain) return;
  const std::string there = another_drive_in(options.out, options.command);
  if (there.empty()) return;
  const std::string first = options.out;
  for (int number = 2; !another_drive_in(options.out, options.command).empty(); ++number)
    options.out = numbered(first, number);
  spdlog::warn("{} holds {} and stays: this one goes to {}; --overwrite puts it in its place", first, there,
               options.out);
}

/// What drives where the command line names no drive: keys, gamepad or stalk, or what goes by itself.
struct RigsOwn {
  bool by_hand = false;    ///< keys or a gamepad: without a window nobody touches them
  bool by_itself = false;  ///< a log, a script or a recording
  bool frames = false;     ///< CAN frames, of a bus or a log
};

Result<RigsOwn> source_of(const Rig& rig) {
  const auto cockpit = read_cockpit(rig.cockpit_file);
  if (!cockpit) return cockpit.error();
  using enum SourceKind;
  const SourceKind kind = cockpit->source;
  return RigsOwn{.by_hand = kind == kKeyboard || kind == kGamepad,
                 .by_itself = kind == kLog || kind == kDriver || kind == kDrive,
                 .frames = kind == kCan || kind == kLog};
}

/// Nobody has named a drive, and nobody sits at the window: that of the scene, recorded where it is, but for a road
/// that a car has to answer. A moment that is to be explained is of a recording or of none.
void take_demo_drive(const Rig& rig, DriveOptions& options) {
  const bool poses_do = options.car_and_road.empty() || options.level == "pose" || options.explain;
  if (const auto recording = demo_recording(rig, config_path("")); recording && poses_do) {
    options.drive = *recording;
  } else if (const auto script = demo_script(rig, config_path(""))) {
    if (!options.explain) options.script = *script;
  } else if (const std::string country_road = config_path("drives/country_road.pcap"); fs::exists(country_road)) {
    options.drive = country_road;
    options.drive_told = rig.scene_file.string() +
                         " has no drive of its own: the car goes where it went on the country road, whatever is "
                         "there; --script or --drive name another";
  }
}

}  // namespace

Result<Rig> prepare_drive(DriveOptions& options) {
  auto rig = read_rig(options.rig_file);
  if (!rig) return rig.error();
  if (options.port_base != 0) rig->port_base = options.port_base;
  if (!options.cockpit.empty()) rig->cockpit_file = fs::absolute(options.cockpit).lexically_normal();
  if (const Status status = check_rig_files(*rig); !status) return status.error();

  if (!options.vehicle.empty()) rig->vehicle_file = fs::absolute(options.vehicle).lexically_normal();
  if (const auto vehicle = read_vehicle(rig->vehicle_file); !vehicle) return vehicle.error();
  if (!options.lamps.any() && options.versus.empty() && !options.lamps.aim.empty())
    return Error{"--aim " + options.lamps.aim, "aims a lamp of one's own: give --lamp, --lamp-high or --lamp-fog"};
  const Rig as_filed = *rig;
  if (const Status status = aim_lamps(*rig, options); !status) return status.error();
  if (const Status status = choose_designs(*rig, as_filed, options); !status) return status.error();

  if (const Status status = check_desk(*rig, options); !status) return status.error();

  if (!options.headless && !set_in_environment("DISPLAY") && !set_in_environment("WAYLAND_DISPLAY")) {
    spdlog::info("no display: driving headless");
    options.headless = true;
  }
  // Whoever sits at a window drives, unless a drive is named; automation (--frames, --lockstep) waits for nobody's key.
  const bool person = !options.headless && !options.lockstep && options.picture.frames == 0;
  const bool any_drive = !options.drive.empty() || !options.script.empty() || !options.log.empty();
  const auto rigs_own = source_of(*rig);
  if (!rigs_own) return rigs_own.error();
  if (person) options.guide = any_drive || rigs_own->by_itself ? "replay" : "live";
  if (!options.dbc.empty() && options.log.empty() && (any_drive || !rigs_own->frames))
    return Error{"--dbc " + options.dbc, "describes CAN frames, and the drive comes from neither a bus nor a log"};
  if (!person && !any_drive && options.cockpit.empty() && rigs_own->by_hand) take_demo_drive(*rig, options);
  if (!options.drive.empty() && !options.level.empty() && options.level != "pose") {
    options.closed_loop = true;
    spdlog::warn(
        "the controls of {} are replayed to a car of level {}, open loop: it need not stay on its lane; a driver "
        "model does (--script)",
        options.drive, options.level);
  }
  if (!options.drive.empty() && !options.closed_loop && !options.car_and_road.empty() && !options.explain)
    return Error{options.car_and_road.front(),
                 "means nothing to recorded poses; with --closed-loop the car answers the recorded controls"};
  if (options.closed_loop && options.drive.empty())
    return Error{"--closed-loop", "replays a recording's controls: give --drive"};
  if (options.picture.audit_bound && options.picture.audit_every == 0)
    return Error{"--audit-bound", "holds audited pixels to it, and --audit-every 0 audits none"};
  if (options.lockstep && options.picture.frames_in_flight == 2)
    return Error{"--frames-in-flight", "2 is of real time: in lockstep one frame follows the other"};
  if (options.explain && !options.explain_cost && options.picture.frames > 0)
    return Error{"--frames", "says with --explain how often --cost draws the moment, and --cost is not given"};
  for (std::string* file : {&options.drive, &options.script, &options.log, &options.dbc}) {
    if (file->empty()) continue;
    if (const std::string why = why_no_file(*file); !why.empty()) return Error{*file, why};
    *file = fs::absolute(*file).string();
  }
  std::vector<std::string> inputs = files_of(*rig);
  inputs.insert(inputs.end(), {options.drive, options.script, options.log, options.dbc, options.picture.traffic});
  inputs.insert(inputs.end(), options.car_and_road.begin(), options.car_and_road.end());
  if (const Status apart = check_inputs(inputs, {options.record}); !apart) return apart.error();
  if (is_standard_output(options.record)) return Error{"--record " + options.record, "a recording goes into a file"};
  if (!options.overwrite)
    if (const Status none = no_recording_at(options.record); !none)
      return Error{none.error().place, none.error().reason + " without --overwrite"};
  if (options.headless && options.out.empty()) options.out = "out";
  if (!options.out.empty()) options.out = fs::absolute(options.out).lexically_normal().string();
  settle_out(options);
  if (!options.record.empty() && !options.out.empty())
    if (const Status apart = apart_from_output(options.record, options.out, *rig); !apart) return apart.error();
  if (options.open_bus) rig->run_key = false;
  for (const char* name : {"phare-cockpit", "phare-dynamics", "phare-visual"}) {
    if (access(program_beside_us(name).c_str(), X_OK) != 0)
      return Error{program_beside_us(name).string(), "is not there; build everything"};
  }
  return rig;
}

void add_drive_options(CLI::App& command, const std::shared_ptr<DriveOptions>& options) {
  command.footer(
      "With a window and no drive named, you drive:\n" + key_list_text("  ") +
      "A gamepad that is plugged in drives as well. More: docs/driving.md\n"
      "Examples:\n  phare drive\n  phare drive --headless --lockstep --frames 60 --out out\n"
      "  phare drive --script config/drives/country_road_script.toml --headless --lockstep --record evening.pcap\n"
      "  phare drive --explain --light high\n"
      "  phare drive --headless --lockstep --explain --cost --still-at 5 --set visibility_m=80\n"
      "  phare drive --design halogen --versus led --headless --lockstep --frames 60 --out ab\n"
      "  phare drive --budget-ms 40 --headless --frames 60 --size 320x180 --out quick\n"
      "  phare drive --lamp led_low_beam.ies --lamp-high high_beam.ies --headless --lockstep --frames 60 --out own\n" +
      std::string(kLampFlagsHelp));
  command.add_option("--rig", options->rig_file, "Rig file")->capture_default_str();
  auto* drive_file = command.add_option("--drive", options->drive,
                                        "Drive file to replay [without a window: the demo drive of the scene]");
  auto* script = command.add_option("--script", options->script, "Script for the driver model")->excludes(drive_file);
  auto* log = command.add_option("--log", options->log, "candump log that moves the controls");
  log->excludes(drive_file)->excludes(script);
  command.add_option("--dbc", options->dbc, "DBC file of the log or bus [the cockpit file's]");
  add_lamp_flags(&command, options->lamps);
  command.add_option("--design", options->design, "Design of the rig that is shown, by its name or number");
  command
      .add_option("--versus", options->versus,
                  "Two designs on the same drive: beside the one that shines another of the rig, or a lamp file as "
                  "--lamp has them; halves of the picture, differences and reaches on the page")
      ->check([](const std::string& name) { return name.empty() ? "names no design and no lamp file" : ""; });
  command.add_option("--cockpit", options->cockpit,
                     "Cockpit file, instead of the rig's: which signals move the controls");
  command.add_flag("--headless", options->headless, "No window (also when there is no display)");
  command.add_flag("--lockstep", options->lockstep, "Frame by frame: reproducible bit for bit, however slow");
  command.add_flag(
      "--law", options->law,
      "A control law of your own leads the lamps (docs/control-law.md); in lockstep each frame waits for it");
  auto* out = command.add_option("--out", options->out, "Folder for pictures and report [headless: out]")
                  ->check([](const std::string& name) { return name.empty() ? "names no folder" : ""; });
  auto* record = command.add_option("--record", options->record,
                                    "Record the drive into this file (pcap); one that is there needs --overwrite");
  command.add_flag("--closed-loop", options->closed_loop,
                   "With --drive: replay the controls and let the car answer, instead of the poses");
  command.add_option("--level", options->level, "Model of the car, instead of the rig's")
      ->check(CLI::IsMember(std::vector<std::string>(kDynamicsLevelNames.begin(), kDynamicsLevelNames.end())));
  command.add_option("--vehicle", options->vehicle, "Vehicle file, instead of the rig's");
  const auto pass_on = [&](const char* flag, const char* says) {
    return command.add_option_function<std::string>(
        flag,
        [options, flag](const std::string& word) {
          options->car_and_road.insert(options->car_and_road.end(), {flag, word});
        },
        says);
  };
  pass_on("--friction", "Of the whole road: 1 dry, 0.6 wet, 0.3 snow, 0.1 ice")->check(number_within(0.01, 2.0));
  pass_on("--roughness", "Of the road: ISO 8608 class A to E")->check(CLI::IsMember({"A", "B", "C", "D", "E"}));
  pass_on("--road", "Heights and friction along the way (CSV, see docs/dynamics.md)")->check(CLI::ExistingFile);
  command.add_option("--log-level", options->log_level, "trace, debug, info, warn, error, off")
      ->check(CLI::IsMember(kLogLevelNames))
      ->capture_default_str();
  command.add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  auto* single_file = command.add_flag("--single-file", options->single_file,
                                       "index.html holds its pictures and its video: one file that can be mailed");
  command.add_flag("--overwrite", options->overwrite,
                   "Put this drive in the place of another one in --out and --record");
  command.add_flag("--open-bus", options->open_bus,
                   "No key of the run: anyone on this machine may speak on the bus (docs/send.md)");
  auto* json = command.add_flag("--json", options->json, "Print the report as JSON");
  auto* explain = command.add_flag("--explain", options->explain,
                                   "No drive: print each effect with its level and the reason, for the moment "
                                   "--still-at of the drive, or for --light and --fog; no device is asked");
  command.add_option("--light", options->explain_light, "With --explain: the light switch [low]")
      ->check(CLI::IsMember(std::vector<std::string>(kLightSwitchNames.begin(), kLightSwitchNames.end())))
      ->excludes(drive_file)
      ->needs(explain);
  command.add_flag("--fog", options->explain_fog, "With --explain: the front fog lamps too")
      ->excludes(drive_file)
      ->needs(explain);
  command
      .add_flag("--cost", options->explain_cost,
                "With --explain: draw that moment on the device, without a window, --frames times [30], and print "
                "passes, bytes and ms of each effect too")
      ->needs(explain);
  for (CLI::Option* of_a_drive : {script, log, out, record, single_file, json}) explain->excludes(of_a_drive);
  auto* budget =
      command
          .add_option("--budget-ms", options->budget_ms,
                      "Pick the most accurate settings of the picture whose frames take at most this, as measured on "
                      "this machine; in real time a governor keeps it (docs/cost.md)")
          ->check(number_within(0.1, 10000.0))
          ->excludes(explain);
  command
      .add_option_function<std::string>(
          "--tolerance", [options](const std::string& text) { options->tolerance = share_of_percent(text); },
          "Pick the cheapest settings that keep lux within this, such as 1%, as measured on this machine")
      ->check(
          [](const std::string& text) {
            return share_of_percent(text) ? std::string()
                                          : "expected a share of the light in percent, such as 1%, got '" + text + "'";
          },
          "", "percent")
      ->excludes(budget)
      ->excludes(explain);
  options->picture.add_to(command);
}

}  // namespace phare
