// The command line of a program as data, read from the parser that also makes --help: for completion and manual page.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace phare {

struct OptionHelp {
  std::vector<std::string> names;    ///< "--help", "-h"; one word without dashes: a positional argument
  std::string value;                 ///< "FLOAT"; empty: a flag
  std::vector<std::string> choices;  ///< the only values, where there is a list
  std::string description;
  std::string preset;  ///< default; empty: none, or not told
  bool required = false;
  bool is_positional() const { return !names.front().starts_with('-'); }
};

struct CommandHelp {
  std::string path;  ///< "phare lamp check"
  std::string description;
  std::string footer;  ///< with the example
  std::vector<OptionHelp> options;
  std::vector<std::string> commands;  ///< names of those below it

  /// The command lines of the example: what stands after "Example" and begins with the name of a program of ours.
  std::vector<std::string> examples() const;
};

/// The program first, then its commands in order, each followed by those below it. Hidden ones are left out.
std::vector<CommandHelp> help_data(const CLI::App& app);

/// The same from a footer alone.
std::vector<std::string> examples_in(const std::string& footer);

std::string bash_completion(const std::vector<CommandHelp>& commands);
std::string zsh_completion(const std::vector<CommandHelp>& commands);
/// roff, section 1.
std::string manual_page(const std::vector<CommandHelp>& commands, const std::string& version);

}  // namespace phare
