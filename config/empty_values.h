// An option of the command line that is given says something.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <string>

namespace phare {

/// Before a program parses: each of its options that takes a value, and of its subcommands', refuses an empty one. It
/// comes of a shell's variable that is not set, and would pass for an option that was not given. What stands without
/// an option's name is seen by those who read it.
inline void refuse_empty_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (option->nonpositional() && option->get_expected_max() > 0)
      option->check([](const std::string& text) { return text.empty() ? "is given nothing" : ""; }, "");
  for (CLI::App* subcommand : app.get_subcommands(nullptr)) refuse_empty_values(*subcommand);
}

}  // namespace phare
