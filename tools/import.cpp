// phare import: CAN log, DBC and pose table of a real car into a drive file.
#include <spdlog/spdlog.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>

#include "config/base/input_files.h"
#include "config/base/whole_file.h"
#include "config/cockpit.h"
#include "config/finite_numbers.h"
#include "config/rig.h"
#include "config/road/lane.h"
#include "net/drive_file.h"
#include "net/wire.h"
#include "tools/can_import.h"
#include "tools/commands.h"
#include "tools/lamp/print_json.h"
#include "tools/temporary_folder.h"
#include "vehicle_dynamics/start_pose.h"

namespace phare {
namespace {

struct ImportArguments {
  ImportOptions import;
  std::string rig_file = config_path("rigs/country_road.toml"), out, light, onto, cockpit;
  bool json = false;
  CLI::Option *start = nullptr, *accelerator = nullptr, *brake = nullptr;
};

Status write_datagrams(const std::vector<Datagram>& datagrams, const std::filesystem::path& file,
                       std::uint16_t port_base) {
  auto writer = DriveWriter::create(file, port_base);
  if (!writer) return writer.error();
  for (const Datagram& datagram : datagrams) {
    const std::string bytes = encode(datagram);
    if (const Status status = writer->write(datagram, std::as_bytes(std::span(bytes))); !status) return status;
  }
  return Done{};
}

/// By way of a file: a drive file is written to one.
Status write_to_standard_output(const std::vector<Datagram>& datagrams, std::uint16_t port_base) {
  const TemporaryFolder folder;
  if (folder.path().empty()) return Error{"", "no temporary folder can be made"};
  const std::filesystem::path file = folder.path() / "drive.pcap";
  if (const Status status = write_datagrams(datagrams, file, port_base); !status) return status;
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (const Status written = write_whole_file("-", bytes); !written)
    return Error{"standard output", written.error().reason};
  return Done{};
}

/// Written beside the target and renamed when whole: bad input leaves nothing half-written.
Status write_drive(const std::vector<Datagram>& datagrams, const std::filesystem::path& out, std::uint16_t port_base) {
  if (is_standard_output(out)) return write_to_standard_output(datagrams, port_base);
  std::filesystem::path unfinished = out;
  unfinished += ".part";
  std::error_code failed;
  if (const Status status = write_datagrams(datagrams, unfinished, port_base); !status) {
    std::filesystem::remove(unfinished, failed);
    return status;
  }
  std::filesystem::rename(unfinished, out, failed);
  if (failed) {
    const Error error{out.string(), failed.message()};
    std::filesystem::remove(unfinished, failed);
    return error;
  }
  return Done{};
}

int import_drive(ImportArguments& arguments) {
  ImportOptions& options = arguments.import;
  if (const Status alone = json_alone(arguments.out, arguments.json); !alone) return bad_input(alone.error());
  if (const Status apart = check_inputs({options.can_log.string(), options.dbc.string(), options.pose.string(),
                                         arguments.rig_file, arguments.onto, arguments.cockpit},
                                        {arguments.out});
      !apart)
    return bad_input(apart.error());
  const auto rig = read_rig(arguments.rig_file);
  if (!rig) return bad_input(rig.error());
  auto vehicle = read_vehicle(rig->vehicle_file);
  if (!vehicle) return bad_input(vehicle.error());
  options.vehicle = *vehicle;
  if (!arguments.cockpit.empty()) {
    auto cockpit = read_cockpit(arguments.cockpit);
    if (!cockpit) return bad_input(cockpit.error());
    if (options.dbc.empty()) options.dbc = cockpit->dbc_file;
    options.cockpit = std::move(*cockpit);
  }
  if (options.dbc.empty()) return bad_input({"--dbc", "is required, unless the cockpit file names a DBC file"});
  const std::string light = !arguments.light.empty() ? arguments.light : options.cockpit ? "as-recorded" : "low";
  options.light = light == "high" ? ImportLight::kHigh : light == "low" ? ImportLight::kLow : ImportLight::kAsRecorded;
  if (arguments.onto.empty()) {
    const std::filesystem::path lane = lane_file_of(rig->scene_file);
    if (std::filesystem::exists(lane)) {
      options.lane = lane;
    } else {
      spdlog::warn("no {}: the recorded pose is kept, which lies on no road of the scene", lane.string());
    }
  } else if (arguments.onto != "none") {
    options.lane = arguments.onto;
  }
  if (!options.lane && arguments.start->count() > 0)
    return bad_input({"--start", "is a place on a lane, and the drive is put onto none"});
  const bool driven = !options.lane && options.pose.empty();
  if (const auto lane = lane_file_of(rig->scene_file); driven && std::filesystem::exists(lane)) {
    auto start = start_of_lane(lane);
    if (!start) return bad_input(start.error());
    options.start = *start;
  }
  if ((options.lane || driven) && std::filesystem::exists(rig->scene_file)) {
    auto road = RoadSurface::read(rig->scene_file);
    if (!road) return bad_input(road.error());
    options.road = std::move(*road);
  }

  options.signals.accelerator_must = arguments.accelerator->count() > 0;
  options.signals.brake_must = arguments.brake->count() > 0;
  auto drive = import_can_drive(options);
  if (!drive) return bad_input(drive.error());
  if (const Status status = write_drive(drive->datagrams, arguments.out, rig->port_base); !status)
    return bad_input(status.error());
  for (const std::string& note : drive->notes) spdlog::info("{}", note);
  if (arguments.json) {
    nlohmann::json report = to_json(*drive);
    report["out"] = arguments.out;
    std::printf("%s\n", report.dump(2).c_str());
  } else {
    const ImportCounts& c = drive->counts;
    std::fprintf(
        is_standard_output(arguments.out) ? stderr : stdout,
        "%s: %.2f s, %.1f m, %llu messages from %llu CAN frames (%llu used, %llu of other ids, %llu undecodable, "
        "%llu stamped no later than one before, %llu outside), %llu broken lines and %llu poses\n",
        arguments.out.c_str(), drive->duration_s, drive->distance_m,
        static_cast<unsigned long long>(drive->datagrams.size()), static_cast<unsigned long long>(c.frames),
        static_cast<unsigned long long>(c.used), static_cast<unsigned long long>(c.other_ids),
        static_cast<unsigned long long>(c.undecodable), static_cast<unsigned long long>(c.repeated),
        static_cast<unsigned long long>(c.outside), static_cast<unsigned long long>(c.broken_lines),
        static_cast<unsigned long long>(c.pose_rows));
  }
  return kExitDone;
}

}  // namespace

void add_import(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<ImportArguments>();
  ImportOptions& import = arguments->import;
  CLI::App* command = app.add_subcommand("import", "Turn a recorded drive of a real car into a drive file");
  command->footer(
      "Example:\n  phare import --can car.log --dbc car.dbc --pose car_pose.csv --out car.pcap\n"
      "Without --pose the drive is put onto the lane by its speed alone, or, with --onto none, the car is driven by\n"
      "its recorded speed and steering.\n"
      "The pose table has columns t_s, east_m, north_m, up_m, heading_deg_cw_from_north, path_pitch_deg.");
  command->add_option("--can", import.can_log, "CAN log: candump -l; ASC, BLF, TRC and MF4 with python-can")
      ->required();
  command->add_option("--interface", import.interface,
                      "Of a log of several buses the one to take [the cockpit file's]");
  command->add_option("--dbc", import.dbc, "DBC file that describes its signals [the cockpit file's]");
  command->add_option(
      "--cockpit", arguments->cockpit,
      "Cockpit file that names the controls, lights among them, in place of the options below; the speed "
      "is --speed");
  command->add_option("--pose", import.pose, "Pose table (CSV), on the log's clock");
  command->add_option("--out", arguments->out, "Drive file to write")->required();
  command->add_option("--rig", arguments->rig_file, "Rig file: vehicle and scene")->capture_default_str();
  command->add_option(
      "--onto", arguments->onto,
      "Lane (CSV) to put the drive onto by path length, or none to keep the recorded pose [the scene's lane]");
  arguments->start = command->add_option("--start", import.lane_start_m, "Where on the lane the drive begins, m")
                         ->check(number_within(0.0, 1e9))
                         ->capture_default_str();
  command
      ->add_option("--light", arguments->light,
                   "Light switch: low, high or as-recorded [low; with --cockpit as-recorded]")
      ->check(CLI::IsMember({"low", "high", "as-recorded"}));
  command->add_option("--steering", import.signals.steering, "MESSAGE.SIGNAL of the steering wheel, left positive")
      ->capture_default_str();
  command->add_option("--speed", import.signals.speed, "MESSAGE.SIGNAL of the speed")->capture_default_str();
  command
      ->add_option("--speed-unit", import.signals.speed_unit,
                   "Unit of --speed, where the DBC file names none or another")
      ->check(CLI::IsMember({"m/s", "km/h", "mph", "knots"}));
  command
      ->add_option("--steering-unit", import.signals.steering_unit,
                   "Unit of --steering, where the DBC file names none or another")
      ->check(CLI::IsMember({"deg", "rad"}));
  arguments->accelerator =
      command->add_option("--accelerator", import.signals.accelerator, "MESSAGE.SIGNAL of the accelerator")
          ->capture_default_str();
  arguments->brake =
      command->add_option("--brake", import.signals.brake, "MESSAGE.SIGNAL of the brake")->capture_default_str();
  command->add_flag("--json", arguments->json, "Print what was read as JSON");
  command->callback([arguments, &chosen] { chosen = [arguments] { return import_drive(*arguments); }; });
}

}  // namespace phare
