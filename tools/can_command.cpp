// phare can: the words of a CAN engineer - list a DBC file, decode a log, check a cockpit file, find a checksum.
#include <iostream>
#include <memory>

#include "cockpit_io/can_log.h"
#include "cockpit_io/feedback.h"
#include "cockpit_io/source.h"
#include "config/cockpit.h"
#include "tools/can_tool.h"
#include "tools/commands.h"
#include "tools/crc_search.h"

namespace phare {
namespace {

struct CanOptions {
  std::string dbc_file, log_file, cockpit_file, interface;
  DecodeAsked decode;
};

/// Problems go to standard error, the rest of the file is used.
Result<Dbc> dbc_of(const std::string& file) {
  Result<Dbc> dbc = read_dbc(file);
  if (dbc) tell_problems(*dbc, std::cerr);
  return dbc;
}

/// `interface`: what the cockpit file names; the command line's comes first.
Result<CandumpLog> log_of(const CanOptions& options, const std::string& interface = {}) {
  Result<CanLog> read = read_can_log(options.log_file);
  if (!read) return read.error();
  const bool asked = !options.interface.empty();
  const auto chosen = choose_interface(read->log, asked ? options.interface : interface, asked);
  if (!chosen) return chosen.error();
  tell_problems(read->log, std::cerr);
  if (!chosen->empty()) std::cerr << *chosen << "\n";
  return std::move(read->log);
}

int can_list(const CanOptions& options) {
  const auto dbc = dbc_of(options.dbc_file);
  if (!dbc) return bad_input(dbc.error());
  list_dbc(*dbc, std::cout);
  return kExitDone;
}

int can_decode(const CanOptions& options) {
  const auto dbc = dbc_of(options.dbc_file);
  if (!dbc) return bad_input(dbc.error());
  const auto log = log_of(options);
  if (!log) return bad_input(log.error());
  if (const Status done = decode_log(*dbc, *log, options.decode, std::cout); !done) return bad_input(done.error());
  return kExitDone;
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
  for (const std::string& doubt : send_doubts(*config, *dbc)) std::cerr << doubt << "\n";
  const auto log = log_of(options, config->interface);
  if (!log) return bad_input(log.error());
  if (const Status done = check_cockpit(*config, *dbc, *log, std::cout); !done) return bad_input(done.error());
  return kExitDone;
}

/// The signals that a DBC file needs for it, and the table of a cockpit file.
void tell_check(const CrcFound& found) {
  if (!found.note.empty()) std::cout << "  # " << found.note << "\n";
  std::cout << "  in the DBC file, under the message's BO_:\n";
  for (const std::string& line : found.signals) std::cout << "     " << line << "\n";
  std::cout << "  in the cockpit file, MESSAGE as the DBC file names it:\n    [check.MESSAGE]\n";
  for (const std::string& line : found.table) std::cout << "    " << line << "\n";
}

int can_crc(const CanOptions& options) {
  const auto log = log_of(options);
  if (!log) return bad_input(log.error());
  const auto found = find_crcs(*log);
  for (const CrcFound& one : found) {
    char id[16];
    std::snprintf(id, sizeof id, one.id.extended ? "%08X" : "%03X", one.id.id);
    std::cout << id << "  " << one.where << "  " << one.scheme << "  # " << one.frames << " different frames\n";
    tell_check(one);
  }
  if (found.empty()) std::cout << "no known check fits any message of this log\n";
  return kExitDone;
}

}  // namespace

void add_can(CLI::App& app, Command& chosen) {
  CLI::App* can = app.add_subcommand("can", "CAN files: list a DBC file, decode a log, check a cockpit file");
  can->require_subcommand(1);
  can->footer(
      "Logs are candump's; Vector ASC and BLF, PEAK TRC and MF4 are read through python-can (docs/driving.md).\n"
      "Example:\n  phare can list config/cockpits/phare_stalk.dbc");
  auto options = std::make_shared<CanOptions>();
  const auto takes_interface = [options](CLI::App* command, const char* otherwise) {
    command->add_option("--interface", options->interface,
                        "Of a log of several buses only the frames of this interface [" + std::string(otherwise) + "]");
  };

  CLI::App* list = can->add_subcommand("list", "Every message and signal of a DBC file, and the lines that are broken");
  list->footer("Example:\n  phare can list config/cockpits/phare_stalk.dbc");
  list->add_option("dbc", options->dbc_file, "DBC file; \"-\" is standard input")->required();
  list->callback([options, &chosen] { chosen = [options] { return can_list(*options); }; });

  CLI::App* decode = can->add_subcommand("decode", "What the frames of a log say, by a DBC file");
  decode->footer("Example:\n  phare can decode config/examples/stalk.log --dbc config/cockpits/phare_stalk.dbc --csv");
  decode->add_option("log", options->log_file, "Log of candump, or ASC, BLF, TRC, MF4")->required();
  decode->add_option("--dbc", options->dbc_file, "DBC file")->required();
  decode->add_option("--signal", options->decode.signals, "Only this signal, or MESSAGE.SIGNAL; again for others");
  decode->add_flag("--csv", options->decode.csv,
                   "t_s,message,signal,value,unit,name, and interface where there are several");
  takes_interface(decode, "all");
  decode->callback([options, &chosen] { chosen = [options] { return can_decode(*options); }; });

  CLI::App* check = can->add_subcommand("check", "Which control of a cockpit file a log moves, and when");
  check->footer("Example:\n  phare can check config/cockpits/phare_stalk.toml --log config/examples/stalk.log");
  check->add_option("cockpit", options->cockpit_file, "Cockpit file")->required();
  check->add_option("--log", options->log_file, "Log of candump, or ASC, BLF, TRC, MF4")->required();
  check->add_option("--dbc", options->dbc_file, "DBC file [the cockpit file's]");
  takes_interface(check, "the cockpit file's");
  check->callback([options, &chosen] { chosen = [options] { return can_check(*options); }; });

  CLI::App* crc = can->add_subcommand("crc", "Find which known checksum the messages of a log carry");
  crc->footer("Example:\n  phare can crc config/examples/stalk.log");
  crc->add_option("log", options->log_file, "Log of candump, or ASC, BLF, TRC, MF4")->required();
  takes_interface(crc, "all");
  crc->callback([options, &chosen] { chosen = [options] { return can_crc(*options); }; });
}

}  // namespace phare
