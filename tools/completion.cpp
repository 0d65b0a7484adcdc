// Shell completion made from the declarations of the command line.
#include <sstream>

#include "tools/help_data.h"

namespace phare {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// A name for the shell function of a command: "_phare_lamp_check".
std::string function_of(std::string path) {
  for (char& c : path)
    if (c == ' ' || c == '-') c = '_';
  return "_" + path;
}

/// Within an entry of zsh's _arguments, in single quotes.
std::string for_zsh(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\'') {
      safe += "'\\''";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      safe += std::string("\\") + c;
    } else {
      safe += c == '\n' ? ' ' : c;
    }
  }
  return safe;
}

}  // namespace

std::string bash_completion(const std::vector<CommandHelp>& commands) {
  std::ostringstream out;
  out << "# bash completion of phare, made by: phare completion bash\n"
         "_phare() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} path=phare options= commands= "
         "i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"$path ${COMP_WORDS[i]}\" in\n";
  for (const CommandHelp& command : commands)
    if (command.path.find(' ') != std::string::npos)
      out << "      \"" << command.path << "\") path=\"" << command.path << "\" ;;\n";
  out << "    esac\n  done\n  case \"$path $previous\" in\n";
  for (const CommandHelp& command : commands) {
    for (const OptionHelp& option : command.options) {
      if (option.is_positional() || option.value.empty()) continue;
      std::string patterns;
      for (const std::string& name : option.names)
        patterns += (patterns.empty() ? "\"" : "|\"") + command.path + " " + name + "\"";
      out << "    " << patterns << ") ";
      if (option.choices.empty()) {
        out << "compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$current\"); return ;;\n";
      } else {
        out << "mapfile -t COMPREPLY < <(compgen -W \"" << joined(option.choices, " ")
            << "\" -- \"$current\"); return ;;\n";
      }
    }
  }
  out << "  esac\n  case \"$path\" in\n";
  for (const CommandHelp& command : commands) {
    std::vector<std::string> names;
    for (const OptionHelp& option : command.options)
      if (!option.is_positional()) names.insert(names.end(), option.names.begin(), option.names.end());
    out << "    \"" << command.path << "\") options=\"" << joined(names, " ") << "\"";
    if (!command.commands.empty()) out << " commands=\"" << joined(command.commands, " ") << "\"";
    for (const OptionHelp& option : command.options)
      if (option.is_positional() && !option.choices.empty())
        out << " commands=\"" << joined(option.choices, " ") << "\"";
    out << " ;;\n";
  }
  out << "  esac\n"
         "  if [[ $current == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
         "  elif [[ -n $commands ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$commands\" -- \"$current\")\n"
         "  else\n"
         "    compopt -o filenames 2>/dev/null\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "  fi\n"
         "}\n"
         "complete -F _phare phare ./phare\n";
  return out.str();
}

std::string zsh_completion(const std::vector<CommandHelp>& commands) {
  std::ostringstream out;
  out << "#compdef phare\n# zsh completion of phare, made by: phare completion zsh\n";
  for (auto command = commands.rbegin(); command != commands.rend(); ++command) {
    out << function_of(command->path) << "() {\n";
    if (!command->commands.empty()) {
      out << "  local -a commands=(";
      for (const CommandHelp& below : commands)
        if (below.path.starts_with(command->path + " ") &&
            below.path.find(' ', command->path.size() + 1) == std::string::npos)
          out << "\n    '" << below.path.substr(command->path.size() + 1) << ":" << for_zsh(below.description) << "'";
      out << ")\n  if (( CURRENT > 2 )); then\n    local next=" << function_of(command->path)
          << "_${words[2]//-/_}\n    shift words; (( CURRENT-- ))\n"
             "    (( $+functions[$next] )) && $next\n    return\n  fi\n  _describe command commands\n";
    }
    out << "  _arguments";
    for (const OptionHelp& option : command->options) {
      const std::string action = option.choices.empty() ? "_files" : "(" + joined(option.choices, " ") + ")";
      if (option.is_positional()) {
        out << " \\\n    '*:" << for_zsh(option.names.front()) << ":" << action << "'";
        continue;
      }
      for (const std::string& name : option.names)
        out << " \\\n    '*" << name << "[" << for_zsh(option.description) << "]"
            << (option.value.empty() ? "" : ":" + for_zsh(option.value) + ":" + action) << "'";
    }
    out << "\n}\n";
  }
  out << "_phare \"$@\"\n";
  return out.str();
}

}  // namespace phare
