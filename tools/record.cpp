// phare record: every datagram of a running rig into a drive file.
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "config/base/input_files.h"
#include "config/base/whole_file.h"
#include "config/port_base.h"
#include "net/clock.h"
#include "net/run_key.h"
#include "net/stats.h"
#include "tools/commands.h"
#include "tools/recorder.h"

namespace phare {
namespace {

struct RecordOptions {
  std::string rig_file = config_path("rigs/country_road.toml"), out;
  std::uint16_t port_base = 0;
  bool open_bus = false;
  bool json = false;
};

int record(const RecordOptions& options) {
  if (const Status apart = check_inputs({options.rig_file}, {options.out}); !apart) return bad_input(apart.error());
  if (is_standard_output(options.out)) return bad_input({"--out " + options.out, "a recording goes into a file"});
  if (const Status none = no_recording_at(options.out); !none) return bad_input(none.error());
  auto rig = read_rig(options.rig_file);
  if (!rig) return bad_input(rig.error());
  if (options.port_base != 0) rig->port_base = options.port_base;
  if (options.open_bus) rig->run_key = false;
  if (const Status key = take_run_key(*rig); !key) return bad_input(key.error());
  const StopFlag stop = install_stop_signals();
  auto recorder = Recorder::open(*rig);
  if (!recorder) return bad_input(recorder.error());
  if (const Status created = (*recorder)->create(options.out); !created) return bad_input(created.error());
  spdlog::info("recording port {} into {} until Ctrl-C or the end of the drive", rig->port_base + 2, options.out);

  // After the last pose the frame that shows it is still being reported: stay until it is quiet.
  int quiet = 0;
  while (!stop && quiet < 5) {
    const bool something = (*recorder)->wait(std::chrono::milliseconds(100));
    if (const Status status = (*recorder)->poll(); !status) return bad_input(status.error());
    quiet = (*recorder)->drive_ended() && !something ? quiet + 1 : 0;
  }
  if (options.json) {
    nlohmann::json report = stats_json("recorder", (*recorder)->bus());
    report["written"] = (*recorder)->written();
    std::printf("%s\n", report.dump(2).c_str());
  } else {
    std::printf("%llu datagrams in %s\n", static_cast<unsigned long long>((*recorder)->written()), options.out.c_str());
  }
  return kExitDone;
}

}  // namespace

void add_record(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<RecordOptions>();
  CLI::App* command = app.add_subcommand("record", "Write every datagram of a running rig into a drive file (pcap)");
  command->footer("Example:\n  phare record --out evening.pcap");
  command->add_option("--rig", options->rig_file, "Rig file")->capture_default_str();
  command->add_option("--out", options->out, "Drive file to write")->required();
  command->add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  command->add_flag("--open-bus", options->open_bus, "Of a rig that runs with --open-bus: no key");
  command->add_flag("--json", options->json, "Print the counts as JSON");
  command->callback([options, &chosen] { chosen = [options] { return record(*options); }; });
}

}  // namespace phare
