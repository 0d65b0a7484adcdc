#include <spdlog/spdlog.h>

#include <iterator>
#include <memory>
#include <vector>

#include "cockpit_io/can_log.h"
#include "cockpit_io/can_source.h"
#include "cockpit_io/combined_source.h"
#include "cockpit_io/drive_source.h"
#include "cockpit_io/driver_source.h"
#include "cockpit_io/feedback.h"
#include "cockpit_io/gamepad_source.h"
#include "cockpit_io/keyboard_source.h"
#include "cockpit_io/log_source.h"
#include "cockpit_io/source.h"

namespace phare {

namespace {

/// The mapped DBC; what the reader had to leave out is said once, in short.
Result<SignalMap> read_signals(const CockpitConfig& config, std::int64_t start_ns) {
  if (config.controls.empty()) return Error{config.file.string(), "maps no signal: a [control.…] table is missing"};
  if (config.dbc_file.empty()) return Error{config.file.string(), "names no DBC file; give one with --dbc FILE"};
  Result<Dbc> dbc = read_dbc(config.dbc_file);
  if (!dbc) return dbc.error();
  if (!dbc->problems.empty()) {
    const DbcProblem& first = dbc->problems.front();
    spdlog::warn("{}:{}: {} {}: {}; {} such lines, the rest is used", config.dbc_file.string(), first.line,
                 first.message, first.signal, first.reason, dbc->problems.size());
  }
  return SignalMap::bind(config, std::move(*dbc), start_ns);
}

Result<std::unique_ptr<Source>> open_log(const CockpitConfig& config) {
  if (config.input_file.empty()) return Error{config.file.string(), "names no log; give one with --log FILE"};
  Result<CanLog> read = read_can_log(config.input_file);
  if (!read) return read.error();
  CandumpLog* const log = &read->log;
  if (log->broken_lines > 0) {
    const CandumpProblem& first = log->problems.front();
    spdlog::warn("{}:{}: {}; {} broken lines, the rest is used", config.input_file.string(), first.line, first.reason,
                 log->broken_lines);
  }
  const auto chosen = choose_interface(*log, config.interface, config.interface_is_asked);
  if (!chosen) return chosen.error();
  if (!chosen->empty()) spdlog::warn("{}", *chosen);
  for (const std::string& doubt : doubts(*log)) spdlog::warn("{}", doubt);
  Result<SignalMap> map = read_signals(config, 0);
  if (!map) return map.error();
  return std::unique_ptr<Source>(std::make_unique<LogSource>(std::move(*log), std::move(*map)));
}

/// Keys, with whom they stand beside. Only the demo's script can be wrong; without a gamepad there are the keys.
Result<std::unique_ptr<Source>> open_keyboard(const CockpitConfig& config) {
  KeyboardCompany company;
  if (!config.demo_file.empty()) {
    Result<DriverScript> script = read_driver_script(config.demo_file);
    if (!script) return script.error();
    Result<std::vector<LanePoint>> lane = read_lane(script->lane_file);
    if (!lane) return lane.error();
    company.demo = {std::move(*script), std::move(*lane)};
  }
  company.demo_at_once = config.demo_at_once;
  if (config.any_gamepad) company.pad = open_any_gamepad();
  return std::unique_ptr<Source>(std::make_unique<KeyboardSource>(std::move(company)));
}

Result<std::unique_ptr<Source>> open_one(const CockpitConfig& config) {
  switch (config.source) {
    case SourceKind::kCan: {
      Result<SignalMap> map = read_signals(config, wall_now().ns);
      if (!map) return map.error();
      Result<Feedback> feedback = Feedback::bind(config, map->dbc());
      if (!feedback) return feedback.error();
      for (const std::string& doubt : send_doubts(config, map->dbc())) spdlog::warn("{}", doubt);
      return CanSource::open(config.interface, std::move(*map), std::move(*feedback));
    }
    case SourceKind::kLog:
      return open_log(config);
    case SourceKind::kKeyboard:
      return open_keyboard(config);
    case SourceKind::kGamepad: {
      Result<GamepadSource::Reader> reader = open_glfw_gamepad(config.device);
      if (!reader) return reader.error();
      return std::unique_ptr<Source>(std::make_unique<GamepadSource>(config, std::move(*reader)));
    }
    case SourceKind::kDrive:
      if (config.input_file.empty()) return Error{config.file.string(), "names no drive; give one with --drive FILE"};
      return DriveSource::open(config.input_file);
    case SourceKind::kDriver:
      if (config.input_file.empty()) return Error{config.file.string(), "names no script; give one with --script FILE"};
      return DriverSource::open(config.input_file);
  }
  return Error{config.file.string(), "unknown source"};
}

bool plays_by_itself(const CockpitConfig& config) {
  return config.source == SourceKind::kDrive || config.source == SourceKind::kDriver;
}

}  // namespace

SourceCounts& SourceCounts::operator+=(const SourceCounts& other) {
  constexpr std::uint64_t SourceCounts::*kAll[]{
      &SourceCounts::frames_read,  &SourceCounts::decoded,      &SourceCounts::incomplete,  &SourceCounts::unknown_ids,
      &SourceCounts::error_frames, &SourceCounts::bad_crc,      &SourceCounts::bad_counter, &SourceCounts::lost_in_data,
      &SourceCounts::dropped,      &SourceCounts::link_dropped, &SourceCounts::bus_offs,    &SourceCounts::sent,
      &SourceCounts::not_sent,     &SourceCounts::broken_lines, &SourceCounts::reconnects,  &SourceCounts::fail_safes};
  static_assert(sizeof(SourceCounts) == std::size(kAll) * sizeof(std::uint64_t), "a count is missing here");
  for (const auto count : kAll) this->*count += other.*count;
  return *this;
}

Result<CockpitConfig> read_source_beside(const std::filesystem::path& file) {
  Result<CockpitConfig> beside = read_cockpit(file);
  if (!beside) return beside;
  if (plays_by_itself(*beside)) return Error{file.string(), "a drive or a script cannot stand beside another source"};
  if (!beside->also.empty()) return Error{file.string(), "names further sources itself (also)"};
  return beside;
}

Result<std::unique_ptr<Source>> open_source(const CockpitConfig& config) {
  Result<std::unique_ptr<Source>> first = open_one(config);
  if (!first || config.also.empty() || plays_by_itself(config)) return first;
  std::vector<CombinedSource::Part> parts;
  parts.push_back({std::move(*first), config});
  for (const std::filesystem::path& file : config.also) {
    Result<CockpitConfig> beside = read_source_beside(file);
    if (!beside) return beside.error();
    Result<std::unique_ptr<Source>> source = open_one(*beside);
    if (!source) {
      // The first has to be there; what stands beside it is a convenience.
      spdlog::warn("{}; goes on without it", source.error().text());
      continue;
    }
    parts.push_back({std::move(*source), std::move(*beside)});
  }
  return std::unique_ptr<Source>(std::make_unique<CombinedSource>(std::move(parts)));
}

}  // namespace phare
