#include "cockpit_io/dbc_lines.h"

#include <cstddef>
#include <cstdint>

#include "cockpit_io/text_scanner.h"

namespace phare {
namespace {

bool looks_like_signal(TextScanner scan) {
  return !scan.loose_word().empty() && scan.rest().find('@') != std::string_view::npos;
}

/// Double quotes that begin or end a text: those behind a backslash are of the text.
std::size_t quotes(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '"' && (i == 0 || text[i - 1] != '\\')) ++count;
  return count;
}

}  // namespace

bool DbcLines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  text_ = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
  number_ = ++read_;
  return true;
}

DbcLines::Statement DbcLines::to_its_end(std::string_view keyword) {
  Statement statement{std::string(text_), {}};
  bool in_text = quotes(text_) % 2 == 1;
  const bool ends_by_line = keyword == "VERSION" || keyword == "BU_" || keyword == "BS_";
  const auto ended = [](std::string_view text) {
    const std::size_t last = text.find_last_not_of(" \t\r");
    return last != std::string_view::npos && text[last] == ';';
  };
  std::string_view newest = text_;
  while (in_text || (!ends_by_line && !ended(newest))) {
    const std::size_t end = rest_.find('\n');
    if (rest_.empty()) break;
    const std::string_view next = rest_.substr(0, end);
    TextScanner scan(next);
    const std::string_view word = scan.word();
    if (in_text) {
      const bool new_block =
          (word == "BO_" && scan.number<std::uint64_t>()) || (word == "SG_" && looks_like_signal(scan));
      if (new_block) break;
    } else if (!word.empty() || scan.at_end()) {
      break;  // a keyword or an empty line: the semicolon was forgotten
    }
    in_text = in_text != (quotes(next) % 2 == 1);
    statement.text += '\n';
    statement.text += next;
    newest = next;
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++read_;
  }
  if (in_text) {
    statement.flaw = "a text in quotes does not end";
  } else if (!ends_by_line && !ended(newest)) {
    statement.flaw = "the semicolon at its end is missing";
  }
  return statement;
}

}  // namespace phare
