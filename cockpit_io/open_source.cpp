#include <spdlog/spdlog.h>

#include <memory>

#include "cockpit_io/can_source.h"
#include "cockpit_io/drive_source.h"
#include "cockpit_io/driver_source.h"
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
  Result<CandumpLog> log = read_candump(config.input_file);
  if (!log) return log.error();
  if (log->broken_lines > 0) {
    const CandumpProblem& first = log->problems.front();
    spdlog::warn("{}:{}: {}; {} broken lines, the rest is used", config.input_file.string(), first.line, first.reason,
                 log->broken_lines);
  }
  Result<SignalMap> map = read_signals(config, 0);
  if (!map) return map.error();
  return std::unique_ptr<Source>(std::make_unique<LogSource>(std::move(*log), std::move(*map)));
}

}  // namespace

Result<std::unique_ptr<Source>> open_source(const CockpitConfig& config) {
  switch (config.source) {
    case SourceKind::kCan: {
      Result<SignalMap> map = read_signals(config, wall_now().ns);
      if (!map) return map.error();
      return CanSource::open(config.interface, std::move(*map));
    }
    case SourceKind::kLog:
      return open_log(config);
    case SourceKind::kKeyboard:
      return std::unique_ptr<Source>(std::make_unique<KeyboardSource>());
    case SourceKind::kDrive:
      if (config.input_file.empty()) return Error{config.file.string(), "names no drive; give one with --drive FILE"};
      return DriveSource::open(config.input_file);
    case SourceKind::kDriver:
      if (config.input_file.empty()) return Error{config.file.string(), "names no script; give one with --script FILE"};
      return DriverSource::open(config.input_file);
  }
  return Error{config.file.string(), "unknown source"};
}

}  // namespace phare
