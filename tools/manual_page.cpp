// The manual page, roff with the man macros, made from the declarations of the command line.
#include <cstdio>
#include <initializer_list>
#include <sstream>
#include <utility>

#include "tools/help_data.h"

namespace phare {
namespace {

/// Text as roff shows it: a backslash is one, a dash can be copied, no line is taken for a request; a long word of an
/// option may end its line at a comma or plus.
std::string for_roff(const std::string& text) {
  std::string safe;
  bool line_begins = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (line_begins && (c == '.' || c == '\'')) safe += "\\&";
    line_begins = c == '\n';
    if (const auto letter = static_cast<unsigned char>(c);
        letter >= 0xC0) {  // UTF-8: roff takes the number of a letter
      const int more = letter >= 0xF0 ? 3 : letter >= 0xE0 ? 2 : 1;
      unsigned code = letter & (0x3Fu >> more);
      for (int k = 0; k < more && i + 1 < text.size(); ++k)
        code = code << 6 | (static_cast<unsigned char>(text[++i]) & 0x3Fu);
      char number[16];
      std::snprintf(number, sizeof number, "\\[u%04X]", code);
      safe += number;
    } else if (c == '\\') {
      safe += "\\e";
    } else if (c == '-') {
      safe += "\\-";
    } else {
      safe += c;
      if (c == ',' || c == '+') safe += "\\:";
    }
  }
  return safe;
}

/// An argument of a macro: quotes doubled, on one line.
std::string argument(const std::string& text) {
  std::string safe;
  for (const char c : for_roff(text)) safe += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return "\"" + safe + "\"";
}

std::string synopsis(const CommandHelp& command) {
  std::string text = "\\fB" + for_roff(command.path) + "\\fR";
  if (!command.options.empty()) text += " [options]";
  if (!command.commands.empty()) text += " \\fIcommand\\fR";
  for (const OptionHelp& option : command.options)
    if (option.is_positional()) text += " \\fI" + for_roff(option.names.front()) + "\\fR";
  return text;
}

void print_option(std::ostream& out, const OptionHelp& option) {
  out << ".TP\n";
  std::string names;
  for (const std::string& name : option.names)
    names +=
        (names.empty() ? "" : ", ") + std::string(option.is_positional() ? "\\fI" : "\\fB") + for_roff(name) + "\\fR";
  out << names;
  if (!option.is_positional() && !option.value.empty()) out << " \\fI" << for_roff(option.value) << "\\fR";
  out << "\n" << for_roff(option.description) << (option.description.empty() ? "\\&" : ".");
  if (!option.choices.empty()) {
    out << " One of";
    for (const std::string& choice : option.choices) out << ' ' << for_roff(choice);
    out << '.';
  }
  if (!option.preset.empty()) out << " Default: " << for_roff(option.preset) << '.';
  if (option.required && !option.is_positional()) out << " Must be given.";
  out << "\n";
}

void print_command(std::ostream& out, const CommandHelp& command) {
  out << ".SS " << argument(command.path) << "\n"
      << for_roff(command.description) << ".\n.PP\n"
      << synopsis(command) << "\n";
  for (const OptionHelp& option : command.options) print_option(out, option);
  if (!command.footer.empty()) out << ".PP\n.nf\n" << for_roff(command.footer) << "\n.fi\n";
}

}  // namespace

std::string manual_page(const std::vector<CommandHelp>& commands, const std::string& version) {
  const CommandHelp& program = commands.front();
  std::ostringstream out;
  out << ".\\\" Made by: phare manual\n.TH PHARE 1 \"\" " << argument("Phare " + version)
      << " \"User Commands\"\n.ad l\n.nh\n"
      << ".SH NAME\nphare \\- interactive headlight simulator\n.SH SYNOPSIS\n"
      << synopsis(program) << "\n.SH DESCRIPTION\n"
      << for_roff(program.description) << "\n.SH OPTIONS\n";
  for (const OptionHelp& option : program.options) print_option(out, option);
  out << ".SH COMMANDS\n";
  for (std::size_t i = 1; i < commands.size(); ++i) print_command(out, commands[i]);
  const auto section = [&out](const char* heading, std::initializer_list<std::pair<const char*, const char*>> rows) {
    out << ".SH " << heading << "\n";
    for (const auto& [term, words] : rows) out << ".TP\n" << for_roff(term) << "\n" << for_roff(words) << "\n";
  };
  section("\"EXIT STATUS\"", {{"0", "Done."},
                              {"1", "What was checked fails."},
                              {"2", "Bad input: one line says what and where."},
                              {"130", "Interrupted: by Ctrl-C, SIGTERM or a closed terminal."}});
  section("ENVIRONMENT",
          {{"PHARE_GENERATED_DIR", "Where the shipped lamps and scenes lie: what rig files call generated/."},
           {"PHARE_RUN_DIR", "Folder of the keys of running rigs, of its user alone. Default: /run/user/UID/phare."},
           {"PHARE_PYTHON", "The python3 that has python-can and asammdf, for logs other than candump's."},
           {"XDG_CACHE_HOME", "Under its phare what settings cost on this machine is kept. Default: ~/.cache."},
           {"TMPDIR", "Folder of files that a drive makes for itself. Default: /tmp."},
           {"DISPLAY, WAYLAND_DISPLAY", "Where windows go."},
           {"VK_ICD_FILENAMES, VK_DRIVER_FILES", "Vulkan devices, by its loader."}});
  section("FILES",
          {{"/usr/share/phare/config", "Rigs, vehicles, cockpits, drives, rules and examples that are shipped."},
           {"/usr/share/phare/generated", "Lamps and scenes that are shipped."}});
  out << ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : program.examples()) out << for_roff(example) << "\n";
  out << ".fi\n.SH \"SEE ALSO\"\nThe pages in docs/ of the source, or /usr/share/doc/phare.\n";
  return out.str();
}

}  // namespace phare
