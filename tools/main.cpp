// phare: launch a rig, record, replay, import, measure, and look at the machine.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "config/toml_table.h"
#include "tools/commands.h"

namespace phare {

int bad_input(const Error& error) {
  std::fprintf(stderr, "phare: %s\n", error.text().c_str());
  return kExitBadInput;
}

std::string config_path(const std::string& below) {
  return std::string(PHARE_CONFIG_DIR "/") + below;
}

namespace {

int run(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("phare"));
  spdlog::set_pattern("%T.%e phare %^%l%$ %v");
  CLI::App app{"Phare drives headlamps through the night before they exist.", "phare"};
  app.footer(
      "Example:\n  phare drive --headless --lockstep --frames 60 --out out\nEvery command has --help with an example.");
  app.set_version_flag("--version", PHARE_VERSION);
  app.require_subcommand(1);
  Command chosen;
  add_drive(app, chosen);
  add_record(app, chosen);
  add_control(app, chosen);
  add_replay(app, chosen);
  add_import(app, chosen);
  add_lamp(app, chosen);
  add_measure(app, chosen);
  add_doctor(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::RequiredError& wrong) {
    const bool named = argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty();
    if (!named) return bad_input({"", wrong.what() + std::string(" (see --help)")});
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands(nullptr)) commands.push_back(command->get_name());
    return bad_input({"", unknown_name_reason("command", argv[1], commands)});
  } catch (const CLI::ParseError& wrong) {
    std::fprintf(stderr, "phare: %s (see --help)\n", wrong.what());
    return kExitBadInput;
  }
  return chosen();
}

}  // namespace
}  // namespace phare

int main(int argc, char** argv) {
  try {
    return phare::run(argc, argv);
  } catch (const std::exception& failure) {  // out of memory, a full disk under a stream: leave with a reason
    std::fprintf(stderr, "phare: %s\n", failure.what());
    return phare::kExitCheckFailed;
  }
}
