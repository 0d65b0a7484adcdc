// phare completion, manual, help-data: what shells, man and tests read of the command line. Not shown in --help.
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "config/base/whole_file.h"
#include "tools/commands.h"
#include "tools/help_data.h"

namespace phare {
namespace {

/// To standard output, or into a file whose folder is made.
int give(const std::string& text, const std::string& out) {
  if (out.empty() || is_standard_output(out)) {
    std::cout << text;
    return kExitDone;
  }
  std::error_code failed;
  if (const auto folder = std::filesystem::path(out).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, failed);
  std::ofstream file(out, std::ios::binary);
  file << text << std::flush;
  return file ? kExitDone : bad_input({out, "cannot be written"});
}

nlohmann::json as_json(const std::vector<CommandHelp>& commands) {
  nlohmann::json all = nlohmann::json::array();
  for (const CommandHelp& command : commands) {
    nlohmann::json options = nlohmann::json::array();
    for (const OptionHelp& option : command.options)
      options.push_back({{"names", option.names},
                         {"value", option.value},
                         {"choices", option.choices},
                         {"default", option.preset},
                         {"required", option.required}});
    all.push_back({{"path", command.path}, {"options", options}, {"examples", command.examples()}});
  }
  return all;
}

}  // namespace

void add_help_data(CLI::App& app, Command& chosen) {
  struct Options {
    std::string shell, out;
  };
  auto options = std::make_shared<Options>();
  const auto hidden = [&](const char* name, const char* what) {
    CLI::App* command = app.add_subcommand(name, what)->group("");
    command->add_option("--out", options->out, "File to write [standard output]");
    return command;
  };
  CLI::App* completion = hidden("completion", "Completion of the command line for a shell");
  completion->footer("Example:\n  phare completion bash");
  completion->add_option("shell", options->shell, "Shell")->required()->check(CLI::IsMember({"bash", "zsh"}));
  completion->callback([options, &app, &chosen] {
    chosen = [options, &app] {
      const std::vector<CommandHelp> data = help_data(app);
      return give(options->shell == "zsh" ? zsh_completion(data) : bash_completion(data), options->out);
    };
  });
  CLI::App* manual = hidden("manual", "The manual page, roff");
  manual->footer("Example:\n  phare manual");
  manual->callback([options, &app, &chosen] {
    chosen = [options, &app] { return give(manual_page(help_data(app), PHARE_VERSION), options->out); };
  });
  CLI::App* data = hidden("help-data", "Commands, options and examples as JSON");
  data->footer("Example:\n  phare help-data");
  data->callback([options, &app, &chosen] {
    chosen = [options, &app] { return give(as_json(help_data(app)).dump(1) + "\n", options->out); };
  });
}

}  // namespace phare
