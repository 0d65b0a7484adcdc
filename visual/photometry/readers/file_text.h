// The text of a photometry file, for all readers: bounded bytes, lines and words with their line number, numbers.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "config/base/result.h"

namespace phare {

/// Larger files are refused unread: a 0.01° grid of a headlamp stays below.
inline constexpr std::uintmax_t kMaxPhotometryBytes = 64u << 20;

/// The bytes of a photometry file, a pipe, or ("-") standard input. The error's place is `name`.
Result<std::string> read_photometry_bytes(const std::filesystem::path& file, const std::string& name);

std::string_view trimmed(std::string_view text);
std::string upper_case(std::string_view text);
/// A word of a hostile file, fit for an error line: printable, at most 24 characters.
std::string in_quotes(std::string_view word);
/// Shortest text that reads back as the same number.
std::string number_text(double value);
/// The whole of `word` as a finite number. A decimal comma is none.
std::optional<double> parse_number(std::string_view word);

/// Text line by line for headers and word by word for numbers. Separators are blanks and, if wanted, commas.
class FileText {
 public:
  FileText(std::string_view text, std::string file, bool comma_separates = true);

  /// Next line without its end and outer blanks; nothing at the end of the text. `line()` is its number.
  std::optional<std::string_view> next_line();
  /// Next word; empty at the end of the text.
  std::string_view next_word();
  /// A finite number, or the error. `what` names it in the error.
  Result<double> number(const char* what);
  /// The same for long tables: false and `why()` instead of a Result, and no allocation.
  bool number(double& value);
  /// The last number as it stands in the text.
  std::string_view word() const { return word_; }
  /// The error of the last number: what it was to be, and what stands there.
  Error why(const std::string& what) const;

  Error error(std::string reason) const { return {place(), std::move(reason)}; }
  std::string place() const { return file_ + ":" + std::to_string(word_line_); }
  std::size_t line() const { return word_line_; }
  std::size_t size() const { return text_.size(); }
  std::string_view rest() const { return at_ < text_.size() ? text_.substr(at_) : std::string_view{}; }

 private:
  bool is_separator(char c) const { return separator_[static_cast<unsigned char>(c)]; }
  static bool parse(std::string_view word, double& value);

  std::string_view text_;
  std::string file_;
  std::array<bool, 256> separator_{};  ///< not the line end
  std::string_view word_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t word_line_ = 1;
};

/// A mark before the text and lone CR as line ends are undone; `storage` keeps the changed text. Notes what was done.
std::string_view without_marks(std::string_view bytes, const std::string& place, std::string& storage,
                               std::string& note);

}  // namespace phare
