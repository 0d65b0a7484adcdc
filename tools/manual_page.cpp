// The manual page, roff with the man macros, made from the declarations of the command line.
#include <cstdio>
#include <sstream>

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
  out << ".SH \"EXIT STATUS\"\n.TP\n0\nDone.\n.TP\n1\nWhat was checked fails.\n.TP\n2\nBad input: one line says what "
         "and "
         "where.\n"
      << ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : program.examples()) out << for_roff(example) << "\n";
  out << ".fi\n.SH \"SEE ALSO\"\nThe pages in docs/ of the source, or /usr/share/doc/phare.\n";
  return out.str();
}

}  // namespace phare
