// How a program says that it was given something wrong: one line, exit code 2.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "config/base/result.h"

namespace phare {

/// As it is up to 4,000 bytes. Longer, where a message cites a file's value that goes on and on: its beginning, how
/// much is left out, and its end. Characters of UTF-8 stay whole.
inline std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 4000, kBegin = 3000, kEnd = 500;
  if (text.size() <= kMost) return std::string(text);
  const auto character_at = [&](std::size_t i) {
    while (i > 0 && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80) --i;
    return i;
  };
  const std::size_t begin = character_at(kBegin), end = character_at(text.size() - kEnd);
  return std::string(text.substr(0, begin)) + " … " + std::to_string(end - begin) + " bytes … " +
         std::string(text.substr(end));
}

/// Control characters, of ASCII and those of two bytes in UTF-8, as \xNN: what a message cites out of a file shall not
/// move the terminal's cursor, and it stays one line, shortened.
inline std::string printable(std::string_view all) {
  const std::string text = shortened(all);
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto before = static_cast<unsigned char>(i > 0 ? text[i - 1] : 0);
    if (c >= 0x20 && c != 0x7f && !(before == 0xc2 && c < 0xa0)) {
      out += text[i];
      continue;
    }
    char escaped[8];
    std::snprintf(escaped, sizeof escaped, "\\x%02x", c);
    out += escaped;
  }
  return out;
}

/// Prints "program: place: reason" to stderr. Returns the exit code.
inline int fail(const char* program, const Error& error) {
  std::fprintf(stderr, "%s: %s\n", program, printable(error.text()).c_str());
  return kExitBadInput;
}

}  // namespace phare
