// Reads words, numbers and marks off one line of text, left to right; shared by the readers of DBC files and candump
// logs.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>

namespace phare {

class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : rest_(text) {}

  std::string_view rest() const { return rest_; }
  bool at_end() {
    skip_space();
    return rest_.empty();
  }

  void skip_space() {
    while (!rest_.empty() && (rest_.front() == ' ' || (rest_.front() >= '\t' && rest_.front() <= '\r'))) {
      rest_.remove_prefix(1);
    }
  }

  /// Takes `mark` if it comes next, after spaces.
  bool take(char mark) {
    skip_space();
    if (rest_.empty() || rest_.front() != mark) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// A C identifier; empty when there is none.
  std::string_view word() {
    skip_space();
    std::size_t n = 0;
    while (n < rest_.size() && is_word(rest_[n], n)) ++n;
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }

  /// Like word(), but may begin with a digit, as names in real files do.
  std::string_view loose_word() {
    skip_space();
    std::size_t n = 0;
    while (n < rest_.size() && is_word(rest_[n], 1)) ++n;
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }

  /// Everything up to the next space.
  std::string_view token() {
    skip_space();
    const std::string_view taken = rest_.substr(0, rest_.find_first_of(" \t\r"));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  /// A number of type T: whole (no sign for unsigned types), or decimal with sign and exponent.
  template <typename T>
  requires std::integral<T> || std::floating_point<T> std::optional<T> number() {
    skip_space();
    std::string_view text = rest_;
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    rest_ = text.substr(static_cast<std::size_t>(end - text.data()));
    return value;
  }

  /// What stands between two double quotes, as it is written: a quote behind a backslash is of the text. nullopt when
  /// the next is no quote or the second is missing.
  std::optional<std::string_view> quoted() {
    skip_space();
    if (rest_.empty() || rest_.front() != '"') return std::nullopt;
    std::size_t end = rest_.find('"', 1);
    while (end != std::string_view::npos && rest_[end - 1] == '\\') end = rest_.find('"', end + 1);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view taken = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return taken;
  }

 private:
  static bool is_word(char c, std::size_t index) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    return letter || (index > 0 && c >= '0' && c <= '9');
  }

  std::string_view rest_;
};

}  // namespace phare
