#include "tools/help_data.h"

#include <CLI/CLI.hpp>
#include <sstream>

#include "config/base/paths.h"

namespace phare {
namespace {

/// The files that come with the program under one name everywhere: a page made here is read there.
std::string without_our_folder(std::string text) {
  const std::string here = config_dir().string() + "/";
  for (std::size_t at = 0; (at = text.find(here, at)) != std::string::npos;) text.replace(at, here.size(), "config/");
  return text;
}

/// "TEXT:{driver,chase}": the choices.
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  std::vector<std::string> choices;
  if (open == std::string::npos || close == std::string::npos) return choices;
  std::istringstream in(type.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(in, choice, ',');) choices.push_back(choice);
  return choices;
}

OptionHelp option_help(const CLI::Option& option) {
  OptionHelp help;
  for (const std::string& name : option.get_snames()) help.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) help.names.push_back("--" + name);
  if (help.names.empty()) help.names.push_back(option.get_name());
  const std::string type = option.get_type_name();
  if (option.get_expected_max() > 0 && option.get_items_expected_max() > 0) {
    help.choices = choices_of(type);
    help.value = type.substr(0, type.find_first_of(": "));
    if (help.value.empty() || help.value.front() == '{') help.value = "VALUE";
  }
  help.description = without_our_folder(option.get_description());
  help.preset = without_our_folder(option.get_default_str());
  help.required = option.get_required();
  return help;
}

void add_commands(const CLI::App& app, const std::string& path, std::vector<CommandHelp>& all) {
  CommandHelp help{path, without_our_folder(app.get_description()), without_our_folder(app.get_footer()), {}, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) help.options.push_back(option_help(*option));
  std::vector<const CLI::App*> below;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    if (!command->get_group().empty()) below.push_back(command);
  for (const CLI::App* command : below) help.commands.push_back(command->get_name());
  all.push_back(std::move(help));
  for (const CLI::App* command : below) add_commands(*command, path + " " + command->get_name(), all);
}

}  // namespace

std::vector<CommandHelp> help_data(const CLI::App& app) {
  std::vector<CommandHelp> all;
  add_commands(app, app.get_name(), all);
  return all;
}

std::vector<std::string> examples_in(const std::string& footer) {
  std::vector<std::string> examples;
  std::istringstream in(footer);
  bool within = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("Example")) {
      within = true;
      const std::size_t colon = line.find(": ");
      line = colon == std::string::npos ? "" : line.substr(colon + 1);
    }
    const std::size_t begin = line.find_first_not_of(' ');
    if (!within || begin == std::string::npos || begin == 0) continue;
    if (line.compare(begin, 5, "phare") == 0) examples.push_back(line.substr(begin));
  }
  return examples;
}

std::vector<std::string> CommandHelp::examples() const {
  return examples_in(footer);
}

}  // namespace phare
