// A text as one word of a shell's command.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace phare {

/// In single quotes where anything but letters, digits and -_./:=,+@% stands in it.
inline std::string shell_word(const std::string& text) {
  const bool plain = !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string("-_./:=,+@%").find(static_cast<char>(c)) != std::string::npos;
  });
  if (plain) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace phare
