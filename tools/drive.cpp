// phare drive: starts the processes of a rig, keeps them running, ends them, and tells what came out.
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "config/cockpit.h"
#include "config/key_bindings.h"
#include "config/log_levels.h"
#include "config/picture_options.h"
#include "config/vehicle.h"
#include "config/whole_file.h"
#include "net/bus.h"
#include "net/clock.h"
#include "net/drive_file.h"
#include "net/run_key.h"
#include "net/stats.h"
#include "tools/commands.h"
#include "tools/derived_rig.h"
#include "tools/drive_folder.h"
#include "tools/drive_progress.h"
#include "tools/lamp_design.h"
#include "tools/recorder.h"
#include "tools/report.h"
#include "tools/run_files.h"
#include "tools/supervisor.h"
#include "tools/wish.h"

namespace phare {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// In real time the drive begins when every picture is ready; a busy machine without a GPU took a minute.
constexpr const char* kPictureWithin_s = "180";

// A visual process writes its pictures when it is told to end; give it the time, unless somebody is in a hurry.
constexpr std::chrono::seconds kEndGrace{10};

struct DriveOptions {
  std::string rig_file = config_path("rigs/country_road.toml");
  std::string drive, script, log, dbc, cockpit, out, record, log_level = "info";
  bool headless = false, lockstep = false, closed_loop = false, json = false;
  bool overwrite = false, open_bus = false;
  bool explain = false;       ///< which effects a moment calls for, instead of a drive
  std::string explain_light;  ///< that moment is not of a drive: the light switch, and
  bool explain_fog = false;   ///< the front fog lamps
  PictureOptions picture;
  std::uint16_t port_base = 0;
  LampFlags lamps;
  LampDesignNotes lamp_told;  ///< what became of them
  std::string lamp_notes;     ///< the same, as the derived rig says it
  std::vector<std::string> command;
  std::string level, vehicle;             ///< of the car, instead of the rig's
  std::vector<std::string> car_and_road;  ///< what phare-dynamics is told besides
  std::string guide;          ///< somebody sits at the window and drives (live) or looks on (replay); empty: nobody
  bool demo_at_once = false;  ///< live: the demo driver begins
};

bool set_in_environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
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

/// Once nothing more can be refused: a refusal is one line.
void tell_of_lamps(const LampDesignNotes& notes) {
  for (const std::string& line : notes.lines) spdlog::info("{}", line);
  for (const std::string& line : notes.warnings) spdlog::warn("{}", line);
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

/// Everything that can be wrong before a process is started: files, ports, flags.
Result<Rig> prepare(DriveOptions& options) {
  auto rig = read_rig(options.rig_file);
  if (!rig) return rig.error();
  if (options.port_base != 0) rig->port_base = options.port_base;
  if (!options.cockpit.empty()) rig->cockpit_file = fs::absolute(options.cockpit).lexically_normal();
  if (const Status status = check_rig_files(*rig); !status) return status.error();

  if (!options.vehicle.empty()) rig->vehicle_file = fs::absolute(options.vehicle).lexically_normal();
  if (const auto vehicle = read_vehicle(rig->vehicle_file); !vehicle) return vehicle.error();
  if (!options.drive.empty() && !options.level.empty() && options.level != "pose") {
    options.closed_loop = true;
    spdlog::warn(
        "the controls of {} are replayed to a car of level {}, open loop: it need not stay on its lane; a driver "
        "model does (--script)",
        options.drive, options.level);
  }
  if (!options.lamps.any() && !options.lamps.aim.empty())
    return Error{"--aim " + options.lamps.aim, "aims a lamp of one's own: give --lamp, --lamp-high or --lamp-fog"};
  if (const Status status = aim_lamps(*rig, options); !status) return status.error();

  Desk desk = rig->desk;
  for (const DeskCommand& command : options.picture.desk)
    if (const auto done = apply(desk, command, {.designs = rig->designs.size()}); !done) return done.error();

  if (!options.headless && !set_in_environment("DISPLAY") && !set_in_environment("WAYLAND_DISPLAY")) {
    spdlog::info("no display: driving headless");
    options.headless = true;
  }
  // Whoever sits at a window drives, unless a drive is named; automation (--frames, --lockstep) waits for nobody's key.
  const bool person = !options.headless && !options.lockstep && options.picture.frames == 0;
  const bool any_drive = !options.drive.empty() || !options.script.empty() || !options.log.empty();
  if (person) options.guide = any_drive ? "replay" : "live";
  const std::string demo = config_path("drives/country_road.pcap");
  if (!person && !any_drive && options.cockpit.empty() && fs::exists(demo)) options.drive = demo;
  for (std::string* file : {&options.drive, &options.script, &options.log, &options.dbc}) {
    if (file->empty()) continue;
    if (!fs::is_regular_file(*file)) return Error{*file, "no such file"};
    *file = fs::absolute(*file).string();
  }
  if (options.headless && options.out.empty()) options.out = "out";
  if (!options.out.empty()) options.out = fs::absolute(options.out).lexically_normal().string();
  settle_out(options);
  if (options.open_bus) rig->run_key = false;
  for (const char* name : {"phare-cockpit", "phare-dynamics", "phare-visual"}) {
    if (access(program_beside_us(name).c_str(), X_OK) != 0)
      return Error{program_beside_us(name).string(), "is not there; build everything"};
  }
  return rig;
}

/// The demo driver knows one road.
bool has_demo_driver(const Rig& rig) {
  const auto demo = read_rig(config_path("rigs/country_road.toml"));
  return demo && demo->scene_file == rig.scene_file;
}

/// What the processes are told where somebody sits at the window, and when to begin.
void add_person(const Rig& rig, const DriveOptions& options, std::vector<ProcessSpec>& specs) {
  const bool live = options.guide == "live", demo = has_demo_driver(rig);
  for (ProcessSpec& spec : specs) {
    const auto add = [&](std::initializer_list<std::string> words) {
      spec.arguments.insert(spec.arguments.end(), words);
    };
    const bool picture = spec.name.starts_with("visual-");
    if (!picture && !options.lockstep) add({"--wait-for-picture", kPictureWithin_s});
    if (spec.name == "cockpit" && live) add({"--any-gamepad"});
    if (spec.name == "cockpit" && live && demo) add({"--demo", config_path("drives/country_road_script.toml")});
    if (spec.name == "cockpit" && live && demo && options.demo_at_once) add({"--demo-at-once"});
    if (spec.name != "visual-0" || options.guide.empty()) continue;
    add({"--guide", options.guide});
    if (demo) add({"--demo"});
    if (!options.out.empty()) add({"--report", (fs::path(options.out) / "index.html").string()});
  }
}

std::vector<ProcessSpec> processes_of(const Rig& rig, const DriveOptions& options, const RunFiles& files) {
  const auto common = [&](const std::string& name) {
    std::vector<std::string> arguments{"--rig",       rig.file.string(), "--port-base", std::to_string(rig.port_base),
                                       "--log-level", options.log_level, "--alive",     files.alive(name).string()};
    if (options.open_bus) arguments.push_back("--open-bus");
    if (options.lockstep) arguments.push_back("--lockstep");
    if (!options.drive.empty()) arguments.insert(arguments.end(), {"--drive", options.drive});
    if (!options.out.empty())
      arguments.insert(arguments.end(), {"--stats", (fs::path(options.out) / (name + ".json")).string()});
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
    const std::vector<std::string> picture = options.picture.arguments();
    arguments.insert(arguments.end(), picture.begin(), picture.end());
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

/// Frames there will be, as far as that is known.
std::int64_t frames_expected(const DriveOptions& options, const Rig& rig, SimTime duration) {
  if (options.picture.frames > 0) return options.picture.frames;
  return static_cast<std::int64_t>(duration.seconds() * static_cast<double>(rig.frame_rate_hz));
}

/// What the channels say of pictures that their disk did not take; of one that was started again, all of them.
struct PicturesNotKept {
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::uint64_t> by_start;  // channel, start id

  void take(const Datagram& datagram) {
    if (const auto* report = std::get_if<FrameReport>(&datagram.payload))
      by_start[{datagram.sender_channel, datagram.start_id}] = report->pictures_not_kept;
  }
  std::uint64_t count() const {
    std::uint64_t all = 0;
    for (const auto& [start, count] : by_start) all += count;
    return all;
  }
};

/// Empty when everything that was asked for is kept.
std::string what_is_missing(const PicturesNotKept& pictures, const Status& recorded) {
  std::string missing;
  if (pictures.count() > 0) missing = std::to_string(pictures.count()) + " pictures could not be kept";
  if (!recorded) missing += (missing.empty() ? "" : "; ") + ("the record ends early: " + recorded.error().text());
  return missing;
}

void print_summary(const nlohmann::json& report, const std::string& out) {
  const auto& summary = report["summary"];
  for (const auto& [process, how] : report["ends"].items()) {
    std::printf("%-10s %-10s", process.c_str(), how.get<std::string>().c_str());
    if (summary["messages"].contains(process)) {
      const auto& m = summary["messages"][process];
      std::printf(" received %s, lost %s, late %s, duplicate %s, refused %s", m["received"].dump().c_str(),
                  m["lost"].dump().c_str(), m["late"].dump().c_str(), m["duplicate"].dump().c_str(),
                  m["refused"].dump().c_str());
    }
    if (summary["memory"].contains(process))
      std::printf("; %s KiB", summary["memory"][process].value("peak_kib", nlohmann::json(0)).dump().c_str());
    std::printf("\n");
  }
  for (const auto& restart : report["restarts"]) {
    std::printf("%s was started again at %.2f s after %s\n", restart["process"].get<std::string>().c_str(),
                restart["at_s"].get<double>(), restart["because"].get<std::string>().c_str());
  }
  if (summary.contains("frame_ms")) {
    const auto& t = summary["frame_ms"];
    std::printf("%s frames in %.1f s: %.3g a second; a frame %.2f ms median, %.2f ms p99\n",
                summary["frames"].dump().c_str(), summary.value("drawn_s", 0.0), summary.value("frames_per_s", 0.0),
                t.value("median", 0.0), t.value("p99", 0.0));
  }
  std::printf("%s\n", (fs::path(out) / "index.html").c_str());
}

/// Which effects a moment calls for, by the picture of every channel; no drive.
int explain_drive(DriveOptions& options) {
  auto rig = prepare(options);
  if (!rig) return bad_input(rig.error());
  std::optional<DerivedRig> derived;
  if (options.lamps.any()) {
    auto made_of_it = DerivedRig::for_drive({});
    if (!made_of_it) return bad_input(made_of_it.error());
    derived.emplace(std::move(*made_of_it));
    if (const Status status = derived->write(*rig, options.lamp_notes); !status) return bad_input(status.error());
    rig->file = derived->file();
  }
  int exit_code = kExitDone;
  for (std::size_t channel = 0; channel < rig->channels.size() && exit_code == kExitDone; ++channel) {
    std::vector<std::string> arguments{"--rig", rig->file.string(), "--channel", std::to_string(channel), "--explain"};
    if (options.headless) arguments.push_back("--headless");
    if (!options.explain_light.empty()) {
      arguments.insert(arguments.end(), {"--light", options.explain_light});
    } else if (!options.drive.empty() && !options.explain_fog) {
      arguments.insert(arguments.end(), {"--drive", options.drive});
    }
    if (options.explain_fog) arguments.push_back("--fog");
    const std::vector<std::string> picture = options.picture.arguments();
    arguments.insert(arguments.end(), picture.begin(), picture.end());
    if (rig->channels.size() > 1) std::printf("# %s\n", rig->channels[channel].name.c_str());
    std::fflush(stdout);
    auto child = ChildProcess::start(program_beside_us("phare-visual"), arguments);
    if (!child) return bad_input(child.error());
    std::optional<ProcessEnd> end;
    while (!(end = child->ended())) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    exit_code = end->signal != 0 ? kExitCheckFailed : end->exit_code;
  }
  return exit_code;
}

/// `wish`: what the person at the window wants next, when that is how the drive came to its end.
int drive_once(DriveOptions& options, std::optional<Wish>& wish) {
  auto rig = prepare(options);
  if (!rig) return bad_input(rig.error());
  SimTime duration;
  if (!options.drive.empty()) {
    const auto read = read_drive(options.drive);
    if (!read) return bad_input(read.error());
    if (read->datagrams.empty()) return bad_input({options.drive, "holds no valid datagram"});
    if (read->cut) spdlog::warn("{}: cut off, driving up to its last whole record", options.drive);
    duration = read->duration;
  }
  // A rig of lamps of one's own: what the processes read, and what stays in the folder.
  std::optional<DerivedRig> derived, kept_rig;
  const fs::path given_rig = rig->file;
  if (options.lamps.any()) {
    for (auto* each : {&derived, &kept_rig}) {
      if (each == &kept_rig && options.out.empty()) continue;
      auto made_of_it = DerivedRig::for_drive(each == &derived ? "" : options.out);
      if (!made_of_it) return bad_input(made_of_it.error());
      each->emplace(std::move(*made_of_it));
    }
    if (const Status status = derived->write(*rig, options.lamp_notes); !status) return bad_input(status.error());
    rig->file = derived->file();
  }
  const StopFlag stop = install_stop_signals();
  if (const Status key = take_run_key(*rig, RunKey::kMake); !key) return bad_input(key.error());
  const auto files = RunFiles::make(*rig);
  if (!files) return bad_input(files.error());
  const std::vector<ProcessSpec> specs = processes_of(*rig, options, *files);
  DriveFacts facts;
  for (const ProcessSpec& spec : specs) facts.process_names.push_back(spec.name);
  auto bus = Bus::open(*rig, Role::kControl);
  if (!bus) return bad_input(bus.error());
  // The recorder listens before anyone speaks, so that the first message is in the file.
  std::unique_ptr<Recorder> recorder;
  if (!options.record.empty()) {
    auto opened = Recorder::open(*rig);
    if (!opened) return bad_input(opened.error());
    recorder = std::move(*opened);
  }
  Supervisor supervisor(specs);
  if (const Status status = supervisor.start(); !status) return bad_input(status.error());
  bool goes_on = true;
  while (goes_on && !stop && !supervisor.all_ready()) {
    goes_on = supervisor.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (!goes_on || stop) {
    supervisor.end_all(kEndGrace, [&] { return stop.requested(); });
    if (stop) return kExitInterrupted;
    if (supervisor.exit_code() != kExitBadInput) std::fprintf(stderr, "phare: %s\n", supervisor.why().c_str());
    return supervisor.exit_code();
  }
  // All that was named has been read, and nobody has written anything: an earlier drive lies as it lay.
  tell_of_lamps(options.lamp_told);
  fs::path made;
  if (recorder) {
    if (const Status created = recorder->create(options.record); !created) return bad_input(created.error());
  }
  if (!options.out.empty()) {
    std::error_code failed;
    made = first_missing(options.out);
    fs::create_directories(options.out, failed);
    if (failed) return bad_input({options.out, failed.message()});
    remove_earlier_output(options.out, facts.process_names);
    remove_earlier_rig(options.out, given_rig);
  }
  if (kept_rig) {
    if (const Status status = kept_rig->write(*rig, options.lamp_notes); !status) return bad_input(status.error());
    rig->file = kept_rig->file();
  }

  bool told = options.guide != "live";  // how to drive, when there is a picture to drive in
  WishReader wishes(*bus, options.guide == "replay");
  std::optional<Clock::time_point> over_at;
  bool after = false;  // a window that stays open after the end of a drive is not part of it
  const auto begin = Clock::now();
  supervisor.let_go();
  Status recorded = Done{};
  PicturesNotKept not_kept;
  bus->on_datagram = [&not_kept, wishes_too = bus->on_datagram](const Datagram& datagram, auto bytes) {
    if (wishes_too) wishes_too(datagram, bytes);
    not_kept.take(datagram);
  };
  std::size_t restarts_seen = 0;
  {
    DriveProgress progress(frames_expected(options, *rig, duration));
    while (!stop && !wish && supervisor.step()) {
      bus->wait(std::chrono::milliseconds(10));
      bus->poll();
      if (!options.guide.empty()) wish = wishes.take();
      if (const auto report = bus->take<FrameReport>()) {
        if (!std::exchange(told, true))
          spdlog::info(
              "you drive, with the keys of the window or of this terminal: arrows, H high beam, F1 in the window for "
              "all");
        const std::int64_t frame =
            report->value.frame_index >= 0
                ? report->value.frame_index
                : static_cast<std::int64_t>(report->sim_time.seconds() * static_cast<double>(rig->frame_rate_hz));
        progress.show(report->value, frame);
      }
      if (wishes.drive_over() && !over_at) over_at = Clock::now();
      after = !options.guide.empty() && over_at && Clock::now() - *over_at > std::chrono::milliseconds(500);
      if (recorder && recorded.ok() && !after) recorded = recorder->poll();
      // What a process last said of itself, before the one that takes its place writes over it.
      for (; restarts_seen < supervisor.restarts().size(); ++restarts_seen) {
        const std::string& name = supervisor.restarts()[restarts_seen].process;
        if (!options.out.empty()) facts.before_restarts.push_back(read_stats(options.out, name));
      }
    }
  }
  facts.interrupted = stop.requested();
  supervisor.end_all(kEndGrace, [&] { return stop.requested(); });
  facts.interrupted |= stop.requested();
  if (recorder && recorded.ok() && !after) recorded = recorder->poll();
  facts.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  facts.exit_code = supervisor.exit_code();
  facts.why = supervisor.why();
  if (facts.interrupted && facts.exit_code == kExitDone) {
    facts.exit_code = kExitInterrupted;
    facts.why = "cut short: interrupted after " + std::to_string(static_cast<int>(facts.wall_s + 0.5)) + " s";
  }
  bus->poll();
  if (facts.exit_code == kExitDone) {
    facts.why = what_is_missing(not_kept, recorded);
    if (!facts.why.empty()) facts.exit_code = kExitCheckFailed;
  }
  if (recorder) spdlog::info("{} datagrams recorded in {}", recorder->written(), options.record);
  if (facts.exit_code == kExitBadInput && kept_rig && kept_rig->file() != given_rig) kept_rig->remove();
  if (facts.exit_code == kExitBadInput && !options.out.empty()) remove_traces(options.out, made, facts.process_names);
  // What was wrong with its input the process has said itself.
  if (facts.exit_code != kExitDone && facts.exit_code != kExitBadInput)
    std::fprintf(stderr, "phare: %s\n", facts.why.c_str());

  if (!options.out.empty() && facts.exit_code != kExitBadInput) {
    facts.command = options.command;
    facts.lockstep = options.lockstep;
    facts.restarts = supervisor.restarts();
    facts.ends = supervisor.ends();
    bus->poll();
    facts.own_counts["phare"] = stats_json("phare", *bus);
    if (recorder) facts.own_counts["recorder"] = stats_json("recorder", recorder->bus());
    remove_half_written(options.out, facts.process_names);
    for (const std::string* file : {&options.drive, &options.script, &options.log}) {
      if (!file->empty()) facts.source_file = *file;
    }
    make_video(options.out, rig->frame_rate_hz, [&] { return stop.requested(); });
    const nlohmann::json report = make_report(*rig, facts, options.out);
    const bool told_in_json = write_json(fs::path(options.out) / "report.json", report);
    const Status page = write_whole_file(fs::path(options.out) / "index.html", report_page(report, options.out));
    if (!told_in_json || !page) {
      std::fprintf(stderr, "phare: %s: the report cannot be written%s\n", options.out.c_str(),
                   page ? "" : (", " + page.error().reason).c_str());
      if (facts.exit_code == kExitDone) facts.exit_code = kExitCheckFailed;
    }
    if (options.json) {
      std::printf("%s\n", report.dump(2).c_str());
    } else {
      print_summary(report, options.out);
    }
  }
  return facts.exit_code;
}

/// One drive, and those that the person at the window wants after it.
int drive(DriveOptions& options) {
  if (options.explain) return explain_drive(options);
  const std::string out = options.out, record = options.record;
  for (int number = 1;; ++number) {
    options.out = numbered(out, number);
    options.record = numbered(record, number);
    std::optional<Wish> wish;
    const int exit_code = drive_once(options, wish);
    if (!wish || exit_code != kExitDone) return exit_code;
    if (*wish == Wish::kAgain) continue;
    options.drive.clear(), options.script.clear(), options.log.clear();
    options.demo_at_once = *wish == Wish::kDemo;
  }
}

}  // namespace

void add_drive(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<DriveOptions>();
  CLI::App* command = app.add_subcommand("drive", "Drive a rig: in a window, or headless into a folder");
  command->footer(
      "With a window and no drive named, you drive:\n" + key_list_text("  ") +
      "A gamepad that is plugged in drives as well. More: docs/driving.md\n"
      "Examples:\n  phare drive\n  phare drive --headless --lockstep --frames 60 --out out\n"
      "  phare drive --script config/drives/country_road_script.toml --headless --lockstep --record evening.pcap\n"
      "  phare drive --explain --light high\n"
      "  phare drive --lamp led_low_beam.ies --lamp-high high_beam.ies --headless --lockstep --frames 60 --out own\n" +
      std::string(kLampFlagsHelp));
  command->add_option("--rig", options->rig_file, "Rig file")->capture_default_str();
  auto* drive_file =
      command->add_option("--drive", options->drive, "Drive file to replay [without a window: the demo drive]");
  auto* script = command->add_option("--script", options->script, "Script for the driver model")->excludes(drive_file);
  command->add_option("--log", options->log, "candump log that moves the controls")
      ->excludes(drive_file)
      ->excludes(script);
  command->add_option("--dbc", options->dbc, "DBC file for --log [the cockpit file's]");
  add_lamp_flags(command, options->lamps);
  command->add_option("--cockpit", options->cockpit,
                      "Cockpit file, instead of the rig's: which signals move the controls");
  command->add_flag("--headless", options->headless, "No window (also when there is no display)");
  command->add_flag("--lockstep", options->lockstep, "Frame by frame: reproducible bit for bit, however slow");
  command->add_option("--out", options->out, "Folder for pictures and report [headless: out]");
  command->add_option("--record", options->record, "Record the drive into this file (pcap)");
  command->add_flag("--closed-loop", options->closed_loop,
                    "With --drive: replay the controls and let the car answer, instead of the poses");
  command->add_option("--level", options->level, "Model of the car, instead of the rig's")
      ->check(CLI::IsMember(std::vector<std::string>(kDynamicsLevelNames.begin(), kDynamicsLevelNames.end())));
  command->add_option("--vehicle", options->vehicle, "Vehicle file, instead of the rig's");
  const auto pass_on = [&](const char* flag, const char* says) {
    return command->add_option_function<std::string>(
        flag,
        [options, flag](const std::string& word) {
          options->car_and_road.insert(options->car_and_road.end(), {flag, word});
        },
        says);
  };
  pass_on("--friction", "Of the whole road: 1 dry, 0.6 wet, 0.3 snow, 0.1 ice")->check(CLI::Range(0.01, 2.0));
  pass_on("--roughness", "Of the road: ISO 8608 class A to E")->check(CLI::IsMember({"A", "B", "C", "D", "E"}));
  pass_on("--road", "Heights and friction along the way (CSV, see docs/dynamics.md)")->check(CLI::ExistingFile);
  command->add_option("--log-level", options->log_level, "trace, debug, info, warn, error, off")
      ->check(CLI::IsMember(kLogLevelNames))
      ->capture_default_str();
  command->add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(1024, 65000));
  command->add_flag("--overwrite", options->overwrite, "Put this drive in the place of another one in --out");
  command->add_flag("--open-bus", options->open_bus,
                    "No key of the run: anyone on this machine may speak on the bus (docs/send.md)");
  command->add_flag("--json", options->json, "Print the report as JSON");
  auto* explain = command->add_flag("--explain", options->explain,
                                    "No drive: print each effect with its level and the reason, for the moment "
                                    "--still-at of the drive, or for --light and --fog");
  command->add_option("--light", options->explain_light, "With --explain: the light switch [low]")
      ->check(CLI::IsMember(std::vector<std::string>(kLightSwitchNames.begin(), kLightSwitchNames.end())))
      ->excludes(drive_file)
      ->needs(explain);
  command->add_flag("--fog", options->explain_fog, "With --explain: the front fog lamps too")
      ->excludes(drive_file)
      ->needs(explain);
  options->picture.add_to(*command);
  command->callback([options, &app, &chosen] {
    spdlog::set_level(spdlog::level::from_str(options->log_level));
    options->command = {"phare", "drive"};
    for (const CLI::Option* option : app.get_subcommand("drive")->parse_order()) {
      options->command.push_back(option->get_name());
      for (const std::string& value : option->get_expected_max() > 0 ? option->results() : CLI::results_t{})
        options->command.push_back(value);
    }
    chosen = [options] { return drive(*options); };
  });
}

}  // namespace phare
