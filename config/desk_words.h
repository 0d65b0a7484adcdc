// Words and numbers of what the desk is told (config/desk.h).
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"

namespace phare::desk_words {

/// Shortest decimal that reads back as the same number.
inline std::string word_of(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

inline std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const std::size_t begin = text.find_first_not_of(" ,\t");
    if (begin == std::string_view::npos) return words;
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(" ,\t"), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

inline Result<double> number_of(std::string_view word, double least, double most) {
  double value = 0.0;
  const auto [stop, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc() || stop != word.data() + word.size() || !std::isfinite(value))
    return Error{"", "expected a number, got \"" + std::string(word) + "\""};
  if (!(value >= least && value <= most))
    return Error{"", std::string(word) + " is outside " + word_of(least) + " to " + word_of(most)};
  return value;
}

inline Error none_of(std::string_view value, std::span<const std::string_view> choices, std::string_view more = {}) {
  std::string all;
  for (const std::string_view choice : choices) all += (all.empty() ? "" : ", ") + std::string(choice);
  return {"", "\"" + std::string(value) + "\" is none of " + all + (more.empty() ? "" : ", ") + std::string(more)};
}

/// One of the names, or "next".
template <std::size_t count, typename Enum>
Status choose(const std::array<std::string_view, count>& names, Enum& chosen, std::string_view value) {
  if (value == "next") {
    chosen = static_cast<Enum>((static_cast<std::size_t>(chosen) + 1) % count);
    return Done{};
  }
  const auto found = std::ranges::find(names, value);
  if (found == names.end()) return none_of(value, names, "next");
  chosen = static_cast<Enum>(found - names.begin());
  return Done{};
}

}  // namespace phare::desk_words
