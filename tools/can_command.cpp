// phare can: the words of a CAN engineer - list a DBC file, decode a log, check a cockpit file, find a checksum.
#include <iostream>
#include <memory>

#include "cockpit_io/can_log.h"
#include "cockpit_io/source.h"
#include "config/cockpit.h"
#include "tools/can_tool.h"
#include "tools/commands.h"

namespace phare {
namespace {

struct CanOptions {
  std::string dbc_file, log_file, cockpit_file;
  DecodeAsked decode;
};

/// Problems go to standard error, the rest of the file is used.
Result<Dbc> dbc_of(const std::string& file) {
  Result<Dbc> dbc = read_dbc(file);
  if (dbc) tell_problems(*dbc, std::cerr);
  return dbc;
}

Result<CandumpLog> log_of(const std::string& file) {
  Result<CanLog> read = read_can_log(file);
  if (!read) return read.error();
  tell_problems(read->log, std::cerr);
  return std::move(read->log);
}

int all_written() {
  std::cout.flush();
  return std::cout ? kExitDone : kExitCheckFailed;
}

int can_list(const CanOptions& options) {
  const auto dbc = dbc_of(options.dbc_file);
  if (!dbc) return bad_input(dbc.error());
  list_dbc(*dbc, std::cout);
  return all_written();
}

int can_decode(const CanOptions& options) {
  const auto dbc = dbc_of(options.dbc_file);
  if (!dbc) return bad_input(dbc.error());
  const auto log = log_of(options.log_file);
  if (!log) return bad_input(log.error());
  if (const Status done = decode_log(*dbc, *log, options.decode, std::cout); !done) return bad_input(done.error());
  return all_written();
}

int can_check(const CanOptions& options) {
  auto config = read_cockpit(options.cockpit_file);
  if (!config) return bad_input(config.error());
  const std::string dbc_file = options.dbc_file.empty() ? config->dbc_file.string() : options.dbc_file;
  if (dbc_file.empty()) return bad_input({options.cockpit_file, "names no DBC file; give one with --dbc FILE"});
  const auto dbc = dbc_of(dbc_file);
  if (!dbc) return bad_input(dbc.error());
  for (const auto& file : config->also)
    if (const auto beside = read_source_beside(file); !beside) return bad_input(beside.error());
  const auto log = log_of(options.log_file);
  if (!log) return bad_input(log.error());
  if (const Status done = check_cockpit(*config, *dbc, *log, std::cout); !done) return bad_input(done.error());
  return all_written();
}

/// The signal that a DBC file needs for it, and the table of a cockpit file; for a check of one byte.
void tell_check(const CrcFound& found) {
  int byte = 0, end = 0;
  if (std::sscanf(found.where.c_str(), "byte %d%n", &byte, &end) != 1) return;
  std::cout << "     in the DBC file, under its BO_:    SG_ CRC : " << 8 * byte << "|8@1+ (1,0) [0|255] \"\" PHARE\n"
            << "     in the cockpit file:    [check.MESSAGE], crc = \"CRC\", " << found.scheme << "\n";
}

int can_crc(const CanOptions& options) {
  const auto log = log_of(options.log_file);
  if (!log) return bad_input(log.error());
  const auto found = find_crcs(*log);
  for (const CrcFound& one : found) {
    char id[16];
    std::snprintf(id, sizeof id, one.id.extended ? "%08X" : "%03X", one.id.id);
    std::cout << id << "  " << one.where << "  " << one.scheme << "  # " << one.frames << " different frames\n";
    tell_check(one);
  }
  if (found.empty()) std::cout << "no known check fits any message of this log\n";
  return all_written();
}

}  // namespace

void add_can(CLI::App& app, Command& chosen) {
  CLI::App* can = app.add_subcommand("can", "CAN files: list a DBC file, decode a log, check a cockpit file");
  can->require_subcommand(1);
  can->footer(
      "Logs are candump's; Vector ASC and BLF, PEAK TRC and MF4 are read through python-can (docs/driving.md).\n"
      "Example:\n  phare can list config/cockpits/phare_stalk.dbc");
  auto options = std::make_shared<CanOptions>();

  CLI::App* list = can->add_subcommand("list", "Every message and signal of a DBC file, and the lines that are broken");
  list->footer("Example:\n  phare can list config/cockpits/phare_stalk.dbc");
  list->add_option("dbc", options->dbc_file, "DBC file")->required();
  list->callback([options, &chosen] { chosen = [options] { return can_list(*options); }; });

  CLI::App* decode = can->add_subcommand("decode", "What the frames of a log say, by a DBC file");
  decode->footer("Example:\n  phare can decode config/examples/stalk.log --dbc config/cockpits/phare_stalk.dbc --csv");
  decode->add_option("log", options->log_file, "Log of candump, or ASC, BLF, TRC, MF4")->required();
  decode->add_option("--dbc", options->dbc_file, "DBC file")->required();
  decode->add_option("--signal", options->decode.signals, "Only this signal, or MESSAGE.SIGNAL; again for others");
  decode->add_flag("--csv", options->decode.csv, "t_s,message,signal,value,unit,name");
  decode->callback([options, &chosen] { chosen = [options] { return can_decode(*options); }; });

  CLI::App* check = can->add_subcommand("check", "Which control of a cockpit file a log moves, and when");
  check->footer("Example:\n  phare can check config/cockpits/phare_stalk.toml --log config/examples/stalk.log");
  check->add_option("cockpit", options->cockpit_file, "Cockpit file")->required();
  check->add_option("--log", options->log_file, "Log of candump, or ASC, BLF, TRC, MF4")->required();
  check->add_option("--dbc", options->dbc_file, "DBC file [the cockpit file's]");
  check->callback([options, &chosen] { chosen = [options] { return can_check(*options); }; });

  CLI::App* crc = can->add_subcommand("crc", "Find which known checksum the messages of a log carry");
  crc->footer("Example:\n  phare can crc config/examples/stalk.log");
  crc->add_option("log", options->log_file, "Log of candump, or ASC, BLF, TRC, MF4")->required();
  crc->callback([options, &chosen] { chosen = [options] { return can_crc(*options); }; });
}

}  // namespace phare
