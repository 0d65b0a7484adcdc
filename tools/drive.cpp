// phare drive: starts the processes of a rig, keeps them running, ends them, and tells what came out.
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "config/base/whole_file.h"
#include "config/key_bindings.h"
#include "net/bus.h"
#include "net/clock.h"
#include "net/drive_file.h"
#include "net/run_key.h"
#include "net/stats.h"
#include "tools/commands.h"
#include "tools/derived_rig.h"
#include "tools/drive_folder.h"
#include "tools/drive_options.h"
#include "tools/drive_pick.h"
#include "tools/drive_processes.h"
#include "tools/drive_progress.h"
#include "tools/drive_series.h"
#include "tools/drive_video.h"
#include "tools/lamp_verdicts.h"
#include "tools/recorder.h"
#include "tools/report.h"
#include "tools/supervisor.h"
#include "tools/wish.h"

namespace phare {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A visual process writes its pictures when it is told to end; give it the time, unless somebody is in a hurry.
constexpr std::chrono::seconds kEndGrace{10};

/// Once nothing more can be refused: a refusal is one line.
void tell_of_lamps(const LampDesignNotes& notes) {
  for (const std::string& line : notes.lines) spdlog::info("{}", line);
  for (const std::string& line : notes.warnings) spdlog::warn("{}", line);
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

/// The first pixel that a channel found off by more than its level states.
struct AuditsFailed {
  std::string first;

  void take(const Datagram& datagram) {
    if (const auto* report = std::get_if<FrameReport>(&datagram.payload); report && first.empty())
      if (!report->audit_failure.empty())
        first = "self-audit of visual-" + std::to_string(datagram.sender_channel) + ": " + report->audit_failure;
  }
};

/// Empty when everything that was asked for is kept.
std::string what_is_missing(const PicturesNotKept& pictures, const Status& recorded) {
  std::string missing;
  if (pictures.count() > 0) missing = std::to_string(pictures.count()) + " pictures could not be kept";
  if (!recorded) missing += (missing.empty() ? "" : "; ") + ("the record ends early: " + recorded.error().text());
  return missing;
}

void print_summary(const nlohmann::json& report, const std::string& out, bool page_written) {
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
    const auto before = summary.value("frames_before", std::uint64_t{0});  // of a picture that was started again
    if (before > 0)
      std::printf("%llu frames; since the picture was started again ",
                  static_cast<unsigned long long>(before + summary["frames"].get<std::uint64_t>()));
    std::printf("%s frames, %.1f s after the first: %.3g a second; a frame %.2f ms median, %.2f ms p99\n",
                summary["frames"].dump().c_str(), summary.value("drawn_s", 0.0), summary.value("frames_per_s", 0.0),
                t.value("median", 0.0), t.value("p99", 0.0));
  }
  if (page_written) std::printf("%s\n", (fs::path(out) / "index.html").c_str());
}

/// Which effects a moment calls for, by the picture of every channel; no drive.
int explain_drive(DriveOptions& options) {
  auto rig = prepare_drive(options);
  if (!rig) return bad_input(rig.error());
  std::optional<DerivedRig> derived;
  if (options.made_design) {
    auto made_of_it = DerivedRig::for_drive({});
    if (!made_of_it) return bad_input(made_of_it.error());
    derived.emplace(std::move(*made_of_it));
    if (const Status status = derived->write(*rig, options.lamp_notes); !status) return bad_input(status.error());
    rig->file = derived->file();
  }
  const bool of_drive = !options.drive.empty() && options.explain_light.empty() && !options.explain_fog;
  int exit_code = kExitDone;
  for (std::size_t channel = 0; channel < rig->channels.size() && exit_code == kExitDone; ++channel) {
    std::vector<std::string> arguments{"--rig", rig->file.string(), "--channel", std::to_string(channel), "--explain"};
    if (options.headless) arguments.push_back("--headless");
    if (!options.explain_light.empty()) arguments.insert(arguments.end(), {"--light", options.explain_light});
    if (of_drive) arguments.insert(arguments.end(), {"--drive", options.drive});
    if (options.explain_fog) arguments.push_back("--fog");
    if (options.explain_cost) arguments.push_back("--cost");
    if (options.lockstep) arguments.push_back("--lockstep");
    for (const std::string& setting : options.desk) arguments.insert(arguments.end(), {"--set", setting});
    const std::vector<std::string> picture = options.picture.arguments();
    arguments.insert(arguments.end(), picture.begin(), picture.end());
    if (rig->channels.size() > 1) std::printf("# %s\n", rig->channels[channel].name.c_str());
    std::fflush(stdout);
    auto child = ChildProcess::start(program_beside_us("phare-visual"), arguments);
    if (!child) return bad_input(child.error());
    std::optional<ProcessEnd> end;
    while (!(end = child->ended())) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    exit_code = end->signal != 0 ? kExitCheckFailed : end->exit_code;
    if (end->signal != 0)
      std::fprintf(stderr, "phare: phare-visual, which explains, ended with %s\n", end->text().c_str());
  }
  if (exit_code == kExitDone && of_drive && !options.drive_told.empty()) spdlog::warn(options.drive_told);
  return exit_code;
}

/// One drive, from its files to its report. Each step says what was wrong with what was asked for, or goes on.
class DriveRun {
 public:
  DriveRun(DriveOptions& options, Rig rig)
      : options_(options), rig_(std::move(rig)), given_rig_(rig_.file), stop_(install_stop_signals()) {}

  /// What is named is read; nothing is written but beside the system's temporary files.
  Status read();
  /// Processes that wait for each other. An exit code: they do not begin.
  Result<std::optional<int>> start();
  /// The folder and the files of this drive take the place of the earlier one's.
  Status make_room();
  /// Until the drive ends, or the person at the window wants another.
  void run(std::optional<Wish>& wish);
  /// Ends the processes, tells what came out, and how it ended.
  int finish();

 private:
  bool kept() const { return !options_.out.empty(); }
  auto in_a_hurry() const {
    return [this] { return stop_.requested(); };
  }
  void show_progress(DriveProgress& progress, const Newest<FrameReport>& report);
  void remember_restarts();
  std::string validation_messages() const;
  std::string what_was_not_written() const;
  void judge();
  void write_report();

  DriveOptions& options_;
  Rig rig_;
  fs::path given_rig_;
  StopFlag stop_;
  SimTime duration_{};  ///< of the drive that is replayed
  /// A rig of lamps of one's own: what the processes read, and what stays in the folder.
  std::optional<DerivedRig> derived_, kept_rig_;
  std::optional<RunFiles> files_;
  std::optional<Bus> bus_;
  std::optional<WishReader> wishes_;  ///< listens as long as the bus is polled
  std::unique_ptr<Recorder> recorder_;
  std::optional<Supervisor> supervisor_;
  fs::path made_;  ///< the first folder that was not there before
  FolderClaim claim_;
  DriveFacts facts_;
  PicturesNotKept not_kept_;
  AuditsFailed audits_;
  Status recorded_ = Done{};
  std::size_t restarts_seen_ = 0;
  bool told_ = false;   ///< how to drive
  bool after_ = false;  ///< a window that stays open after the end of a drive is not part of it
  Clock::time_point begin_{};
};

Status DriveRun::read() {
  if (!options_.drive.empty()) {
    const auto read = read_drive(options_.drive);
    if (!read) return read.error();
    if (read->datagrams.empty()) return Error{options_.drive, "holds no valid datagram"};
    if (read->cut) spdlog::warn("{}: cut off, driving up to its last whole record", options_.drive);
    duration_ = read->duration;
  }
  if (!options_.made_design) return Done{};
  for (auto* each : {&derived_, &kept_rig_}) {
    if (each == &kept_rig_ && !kept()) continue;
    auto made_of_it = DerivedRig::for_drive(each == &derived_ ? "" : options_.out);
    if (!made_of_it) return made_of_it.error();
    each->emplace(std::move(*made_of_it));
  }
  if (const Status status = derived_->write(rig_, options_.lamp_notes); !status) return status;
  rig_.file = derived_->file();
  return Done{};
}

Result<std::optional<int>> DriveRun::start() {
  if (const Status key = take_run_key(rig_, RunKey::kMake); !key) return key.error();
  auto files = RunFiles::make(rig_);
  if (!files) return files.error();
  files_.emplace(std::move(*files));
  const std::vector<ProcessSpec> specs = processes_of(rig_, options_, *files_);
  for (const ProcessSpec& spec : specs) facts_.process_names.push_back(spec.name);
  auto bus = Bus::open(rig_, Role::kControl);
  if (!bus) return bus.error();
  bus_.emplace(std::move(*bus));
  // The recorder listens before anyone speaks, so that the first message is in the file.
  if (!options_.record.empty()) {
    auto opened = Recorder::open(rig_);
    if (!opened) return opened.error();
    recorder_ = std::move(*opened);
  }
  supervisor_.emplace(specs);
  if (const Status status = supervisor_->start(); !status) return status.error();
  bool goes_on = true;
  while (goes_on && !stop_ && !supervisor_->all_ready()) {
    goes_on = supervisor_->step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (goes_on && !stop_) return std::optional<int>{};
  supervisor_->end_all(kEndGrace, in_a_hurry());
  if (stop_) return std::optional(kExitInterrupted);
  if (supervisor_->exit_code() != kExitBadInput) std::fprintf(stderr, "phare: %s\n", supervisor_->why().c_str());
  return std::optional(supervisor_->exit_code());
}

Status DriveRun::make_room() {
  if (kept()) {
    std::error_code failed;
    made_ = first_missing(options_.out);
    fs::create_directories(options_.out, failed);
    if (failed) return Error{options_.out, failed.message()};
    if (::access(options_.out.c_str(), W_OK | X_OK) != 0) return Error{options_.out, std::strerror(errno)};
    auto claim = claim_folder(options_.out);
    if (!claim) return claim.error();
    claim_ = std::move(*claim);
  }
  if (recorder_)
    if (const Status created = recorder_->create(options_.record); !created) {
      if (kept()) remove_made(options_.out, made_);
      return created;
    }
  if (kept()) {
    remove_earlier_output(options_.out, facts_.process_names);
    remove_earlier_rig(options_.out, given_rig_);
  }
  if (!kept_rig_) return Done{};
  if (const Status status = kept_rig_->write(rig_, options_.lamp_notes); !status) return status;
  rig_.file = kept_rig_->file();
  return Done{};
}

void DriveRun::run(std::optional<Wish>& wish) {
  wishes_.emplace(*bus_, options_.guide == "replay");
  std::optional<Clock::time_point> over_at;
  bus_->on_datagram = [this, wishes_too = bus_->on_datagram](const Datagram& datagram, auto bytes) {
    if (wishes_too) wishes_too(datagram, bytes);
    not_kept_.take(datagram);
    audits_.take(datagram);
  };
  begin_ = Clock::now();
  supervisor_->let_go();
  DriveProgress progress(frames_expected(options_, rig_, duration_));
  while (!stop_ && !wish && supervisor_->step()) {
    // Whoever leaves one of several windows leaves the drive.
    if (!options_.guide.empty() && supervisor_->one_has_left()) break;
    bus_->wait(std::chrono::milliseconds(10));
    bus_->poll();
    if (!options_.guide.empty()) wish = wishes_->take();
    if (const auto report = bus_->take<FrameReport>()) show_progress(progress, *report);
    if (wishes_->drive_over() && !over_at) over_at = Clock::now();
    after_ = !options_.guide.empty() && over_at && Clock::now() - *over_at > std::chrono::milliseconds(500);
    if (recorder_ && recorded_.ok() && !after_) recorded_ = recorder_->poll();
    remember_restarts();
  }
}

void DriveRun::show_progress(DriveProgress& progress, const Newest<FrameReport>& report) {
  if (options_.guide == "live" && !std::exchange(told_, true))
    spdlog::info(
        "you drive, with the keys of the window or of this terminal: arrows, H high beam, F1 in the window for all");
  const std::int64_t by_time =
      static_cast<std::int64_t>(report.sim_time.seconds() * static_cast<double>(rig_.frame_rate_hz));
  progress.show(report.value, report.value.frame_index >= 0 ? report.value.frame_index : by_time);
}

/// What a process last said of itself, before the one that takes its place writes over it.
void DriveRun::remember_restarts() {
  const auto& restarts = supervisor_->restarts();
  for (; restarts_seen_ < restarts.size(); ++restarts_seen_)
    if (kept()) facts_.before_restarts.push_back(read_stats(options_.out, restarts[restarts_seen_].process));
}

/// What Vulkan's validation found, as the processes say that draw; empty: nothing.
std::string DriveRun::validation_messages() const {
  std::string found;
  const std::filesystem::path said = stats_folder(options_, *files_);
  if (said.empty()) return found;
  for (const std::string& name : facts_.process_names) {
    const nlohmann::json stats = read_stats(said, name);
    const std::uint64_t count = stats.is_null() ? 0 : stats.value("validation_messages", std::uint64_t{0});
    if (count > 0)
      found += (found.empty() ? "" : "; ") + std::to_string(count) + " Vulkan validation messages in " + name;
  }
  return found;
}

/// Pictures of those who had no time to make them.
std::string DriveRun::what_was_not_written() const {
  std::string names;
  for (const Supervisor::Ended& end : supervisor_->ends()) {
    const bool hurried = end.how == "SIGKILL" || end.how == "left behind";
    if (kept() && facts_.interrupted && end.process.starts_with("visual") && hurried)
      names += (names.empty() ? "" : ", ") + end.process;
  }
  return names.empty() ? "" : "no time was left for " + names + " to write all stills and rows";
}

/// How the drive ended, and whether all that was asked for is kept.
void DriveRun::judge() {
  facts_.exit_code = supervisor_->exit_code();
  facts_.why = supervisor_->why();
  if (facts_.interrupted && facts_.exit_code == kExitDone) {
    facts_.exit_code = kExitInterrupted;
    facts_.why = "cut short: interrupted after " + std::to_string(static_cast<int>(facts_.wall_s + 0.5)) + " s";
  }
  bus_->poll();
  if (facts_.exit_code == kExitBadInput) return;
  // Who was hurried to his end did not choose it.
  const std::string badly = facts_.exit_code == kExitDone ? supervisor_->ended_badly() : "";
  for (const std::string& reason :
       {audits_.first, validation_messages(), badly, what_is_missing(not_kept_, recorded_), what_was_not_written()})
    if (!reason.empty()) facts_.why += (facts_.why.empty() ? "" : "; ") + reason;
  if (!facts_.why.empty() && facts_.exit_code == kExitDone) facts_.exit_code = kExitCheckFailed;
}

int DriveRun::finish() {
  facts_.interrupted = stop_.requested();
  supervisor_->end_all(kEndGrace, in_a_hurry());
  facts_.interrupted |= stop_.requested();
  if (recorder_ && recorded_.ok() && !after_) recorded_ = recorder_->poll();
  facts_.wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
  judge();
  if (recorder_) spdlog::info("{} datagrams recorded in {}", recorder_->written(), options_.record);
  if (facts_.exit_code == kExitBadInput) {  // what was wrong with its input the process has said itself
    if (kept_rig_ && kept_rig_->file() != given_rig_) kept_rig_->remove();
    if (kept()) remove_traces(options_.out, made_, facts_.process_names);
    return facts_.exit_code;
  }
  if (facts_.exit_code != kExitDone) std::fprintf(stderr, "phare: %s\n", facts_.why.c_str());
  if (kept()) write_report();
  return facts_.exit_code;
}

void DriveRun::write_report() {
  facts_.command = options_.command;
  facts_.lockstep = options_.lockstep;
  facts_.restarts = supervisor_->restarts();
  facts_.ends = supervisor_->ends();
  bus_->poll();
  facts_.own_counts["phare"] = stats_json("phare", *bus_);
  if (recorder_) facts_.own_counts["recorder"] = stats_json("recorder", recorder_->bus());
  remove_half_written(options_.out, facts_.process_names);
  for (const std::string* file : {&options_.drive, &options_.script, &options_.log})
    if (!file->empty()) facts_.source_file = *file;
  const PictureOptions& picture = options_.picture;
  if (!picture.traffic.empty()) facts_.traffic_file = picture.traffic;
  if (picture.traffic.empty() && !rig_.traffic_file.empty()) facts_.traffic_file = rig_.traffic_file;
  const auto series = read_drive_series(options_.out);
  if (!series) spdlog::warn("{}; the page is without it", series.error().text());
  const DriveSeries* driven = series && *series ? &**series : nullptr;
  if (driven != nullptr &&
      make_video(options_.out, *driven, rig_.frame_rate_hz, picture.video || picture.frames > 0, in_a_hurry()) &&
      picture.frames == 0)
    thin_frames(options_.out, *driven);
  nlohmann::json report = make_report(rig_, facts_, options_.out);
  if (driven != nullptr) report["drove"] = figures_of(*driven);
  if (!stop_) report["lamp_verdicts"] = lamp_verdicts(rig_, config_path("rules"));
  const bool told_in_json = write_json(fs::path(options_.out) / "report.json", report);
  const Status page = write_whole_file(
      fs::path(options_.out) / "index.html",
      report_page(report, options_.out, options_.single_file ? PageFiles::kWithin : PageFiles::kBeside));
  if (!told_in_json || !page) {
    std::fprintf(stderr, "phare: %s: the report: %s\n", options_.out.c_str(),
                 page ? "report.json cannot be written" : page.error().reason.c_str());
    if (facts_.exit_code == kExitDone) facts_.exit_code = kExitCheckFailed;
  }
  if (options_.json) {
    std::printf("%s\n", report.dump(2).c_str());
  } else {
    print_summary(report, options_.out, page.ok());
  }
}

/// `wish`: what the person at the window wants next, when that is how the drive came to its end.
int drive_once(DriveOptions& options, std::optional<Wish>& wish) {
  auto rig = prepare_drive(options);
  if (!rig) return bad_input(rig.error());
  if (const Status picked = pick_settings(options, *rig); !picked) return bad_input(picked.error());
  DriveRun drive(options, std::move(*rig));
  if (const Status read = drive.read(); !read) return bad_input(read.error());
  const auto started = drive.start();
  if (!started) return bad_input(started.error());
  if (*started) return **started;
  // All that was named has been read, and nobody has written anything: an earlier drive lies as it lay.
  tell_of_lamps(options.lamp_told);
  if (!options.drive_told.empty()) spdlog::warn(options.drive_told);
  if (const Status room = drive.make_room(); !room) return bad_input(room.error());
  drive.run(wish);
  return drive.finish();
}

/// One drive, and those that the person at the window wants after it.
int drive(DriveOptions& options) {
  if (options.explain) return explain_drive(options);
  const std::string out = options.out, record = options.record;
  for (int number = 1;; ++number) {
    if (number > 1 && !options.overwrite)  // the window is open: beside what is there
      while (!no_recording_at(numbered(record, number)).ok()) ++number;
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
  add_drive_options(*command, options);
  command->callback([options, &app, &chosen] {
    spdlog::set_level(spdlog::level::from_str(options->log_level));
    options->command = {"phare", "drive"};
    std::map<const CLI::Option*, std::size_t> given;  // how many values of it are told: each is given with its option
    for (const CLI::Option* option : app.get_subcommand("drive")->parse_order()) {
      options->command.push_back(option->get_name());
      if (option->get_expected_max() > 0) options->command.push_back(option->results().at(given[option]++));
    }
    chosen = [options] { return drive(*options); };
  });
}

}  // namespace phare
