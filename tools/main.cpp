// phare: launch a rig, record, replay, import, measure, and look at the machine.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "config/paths.h"
#include "config/toml_table.h"
#include "tools/commands.h"

namespace phare {

int bad_input(const Error& error) {
  std::fprintf(stderr, "phare: %s\n", error.text().c_str());
  return kExitBadInput;
}

std::string config_path(const std::string& below) {
  return (config_dir() / below).string();
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
  add_rig(app, chosen);
  add_doctor(app, chosen);
  // A command that does not exist is told before anything else: --help after it must not hide the mistake.
  const CLI::App* at = &app;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    std::vector<std::string> commands;
    for (const CLI::App* command : at->get_subcommands(nullptr)) commands.push_back(command->get_name());
    if (commands.empty()) break;
    const auto list = at->get_subcommands(nullptr);
    const auto named =
        std::find_if(list.begin(), list.end(), [&](const CLI::App* c) { return c->get_name() == argv[i]; });
    if (named == list.end())
      return bad_input(
          {"", unknown_name_reason(i == 1 ? "command" : "command of " + at->get_name(), argv[i], commands)});
    at = *named;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
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
