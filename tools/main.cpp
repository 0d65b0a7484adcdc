// phare: launch a rig, record, replay, import, measure, and look at the machine.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "config/base/fail.h"
#include "config/base/paths.h"
#include "config/base/standard_output.h"
#include "config/empty_values.h"
#include "config/finite_numbers.h"
#include "config/formats/toml_table.h"
#include "tools/commands.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/gpu/failure.h"
#endif

namespace phare {

int bad_input(const Error& error) {
  return fail("phare", error);
}

std::string config_path(const std::string& below) {
  return (config_dir() / below).string();
}

std::string example_file(const std::string& name) {
  return is_installed() ? config_path("examples/" + name) : "config/examples/" + name;
}

namespace {

/// Files of config/examples/ that a footer names get the path they have from here; what an example writes does not.
void show_example_paths(CLI::App& app) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(config_path("examples"), missing))
    names.push_back(entry.path().filename().string());
  std::string footer = app.get_footer();
  for (const std::string& name : names) {
    const auto belongs_to_name = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '/' || c == '-';
    };
    for (std::size_t at = 0; (at = footer.find(name, at)) != std::string::npos; at += name.size()) {
      const std::size_t end = at + name.size();
      const bool whole = at > 0 && !belongs_to_name(footer[at - 1]) &&
                         (end == footer.size() || footer[end] == '/' || !belongs_to_name(footer[end]));
      const bool written = at >= 6 && footer.compare(at - 6, 6, "--out ") == 0;
      if (!whole || written) continue;
      const std::string path = example_file(name);
      footer.replace(at, name.size(), path);
      at += path.size() - name.size();
    }
  }
  app.footer(footer);
  for (CLI::App* command : app.get_subcommands(nullptr)) show_example_paths(*command);
}

int run(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("phare"));
  spdlog::set_pattern("%T.%e phare %^%l%$ %v");
  CLI::App app{"Phare drives headlamps through the night before they exist.", "phare"};
  app.footer(
      "Example:\n  phare drive --headless --lockstep --frames 60 --out out\nEvery command has --help with an example.");
  app.set_version_flag("--version", version_text, "Version, commit and Vulkan device");
  app.require_subcommand(1);
  Command chosen;
  add_drive(app, chosen);
  add_record(app, chosen);
  add_control(app, chosen);
  add_replay(app, chosen);
  add_import(app, chosen);
  add_can(app, chosen);
  add_bus_relay(app, chosen);
  add_lamp(app, chosen);
  add_measure(app, chosen);
  add_rig(app, chosen);
  add_vehicle(app, chosen);
  add_cost(app, chosen);
  add_hard_cases(app, chosen);
  add_doctor(app, chosen);
  add_help_data(app, chosen);
  show_example_paths(app);
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
  // CLI11 would take the next word for the value of "--record=".
  for (const std::string word : std::vector<const char*>(argv + 1, argv + argc))
    if (word.starts_with("--") && word.find('=') + 1 == word.size())
      return bad_input({word.substr(0, word.size() - 1), "is given nothing (see --help)"});
  take_finite_numbers_only(app);
  refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& wrong) {
    // A command that is missing may be an option that there is not: phare -V.
    const std::vector<std::string> unknown = app.remaining(true);
    const bool no_command = dynamic_cast<const CLI::RequiredError*>(&wrong) != nullptr && !unknown.empty();
    const std::string what = no_command ? "unknown option " + unknown.front() : std::string(wrong.what());
    return bad_input({"", what + " (see --help)"});
  }
  return chosen();
}

}  // namespace
}  // namespace phare

int main(int argc, char** argv) {
  std::signal(SIGCHLD, SIG_DFL);  // a parent that ignores it hands that down, and how our children end would be lost
  try {
    return phare::end_of_output("phare", phare::run(argc, argv));
  } catch (const std::exception& failure) {  // out of memory, a full disk under a stream: leave with a reason
#ifdef PHARE_WITH_GRAPHICS
    const std::string reason = phare::gpu::reason_of(failure);
#else
    const std::string reason = failure.what();
#endif
    std::fprintf(stderr, "phare: %s\n", reason.c_str());
    return phare::kExitCheckFailed;
  }
}
