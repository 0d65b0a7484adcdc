#include "visual/photometry/readers/file_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "config/base/input_files.h"

namespace phare {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r' || c == '\f' || c == '\v';
}

}  // namespace

Result<std::string> read_photometry_bytes(const std::filesystem::path& file, const std::string& name) {
  auto bytes = read_input_bytes(file, kMaxPhotometryBytes);
  if (bytes) return std::move(*bytes);
  const bool too_large = bytes.error().reason.starts_with("is larger");
  return Error{name.empty() ? bytes.error().place : name,
               bytes.error().reason + (too_large ? ", no photometry file" : "")};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

std::string in_quotes(std::string_view word) {
  std::string text = "\"";
  for (const char c : word.substr(0, 24)) text += c >= 0x20 && c < 0x7f ? c : '?';
  return text + (word.size() > 24 ? "…\"" : "\"");
}

std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

bool FileText::parse(std::string_view word, double& value) {
  const char* begin = word.data();
  const char* const end = begin + word.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, code] = std::from_chars(begin, end, value);
  return code == std::errc{} && stop == end && std::isfinite(value);
}

std::optional<double> parse_number(std::string_view word) {
  double value = 0.0;
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [stop, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc{} || stop != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

FileText::FileText(std::string_view text, std::string file, bool comma_separates)
    : text_(text), file_(std::move(file)) {
  for (const char c : {' ', '\t', '\r', '\f', '\v'}) separator_[static_cast<unsigned char>(c)] = true;
  separator_[static_cast<unsigned char>(',')] = comma_separates;
}

std::optional<std::string_view> FileText::next_line() {
  if (at_ >= text_.size()) return std::nullopt;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  const std::string_view line = text_.substr(at_, end - at_);
  at_ = end + 1;
  word_line_ = line_++;
  return trimmed(line);
}

std::string_view FileText::next_word() {
  const std::size_t size = text_.size();
  while (at_ < size && (is_separator(text_[at_]) || text_[at_] == '\n')) {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }
  word_line_ = line_;
  const std::size_t begin = std::min(at_, size);
  while (at_ < size && !is_separator(text_[at_]) && text_[at_] != '\n') ++at_;
  return text_.substr(begin, at_ - begin);
}

bool FileText::number(double& value) {
  // Most numbers are a few plain digits. Up to 15 of them are exact in a double, so is 10^n up to 22, and the quotient
  // is rounded once: what std::from_chars would give (Clinger 1990), in one pass with the search for the word's end.
  constexpr double kTens[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* const end = text_.data() + text_.size();
  const char* at = text_.data() + std::min(at_, text_.size());
  while (at != end && (is_separator(*at) || *at == '\n')) line_ += *at++ == '\n';
  word_line_ = line_;
  at_ = static_cast<std::size_t>(at - text_.data());
  const char* const begin = at;
  std::uint64_t digits = 0;
  std::ptrdiff_t fraction = 0;
  while (at != end && static_cast<unsigned char>(*at - '0') < 10)
    digits = digits * 10 + static_cast<unsigned char>(*at++ - '0');
  if (at != end && *at == '.') {
    const char* const point = at++;
    while (at != end && static_cast<unsigned char>(*at - '0') < 10)
      digits = digits * 10 + static_cast<unsigned char>(*at++ - '0');
    fraction = at - point - 1;
  }
  const std::ptrdiff_t length = at - begin;
  const bool plain =
      length > 0 && length <= 15 && (length > 1 || *begin != '.') && (at == end || is_separator(*at) || *at == '\n');
  if (!plain) {
    // More digits, a sign or an exponent. std::from_chars finds the word's end itself; what it does not take whole is
    // looked at once more for the error.
    const char* const from = begin != end && *begin == '+' ? begin + 1 : begin;
    const auto [stop, code] = std::from_chars(from, end, value);
    if (code == std::errc{} && std::isfinite(value) && (stop == end || is_separator(*stop) || *stop == '\n')) {
      word_ = {begin, static_cast<std::size_t>(stop - begin)};
      at_ += word_.size();
      return true;
    }
    word_ = next_word();
    return parse(word_, value);
  }
  at_ += static_cast<std::size_t>(length);
  word_ = {begin, static_cast<std::size_t>(length)};
  value = static_cast<double>(digits) / kTens[fraction];
  return true;
}

Result<double> FileText::number(const char* what) {
  double value = 0.0;
  if (!number(value)) return why(what);
  return value;
}

Error FileText::why(const std::string& what) const {
  if (word_.empty()) return error("the file ends where " + what + " is expected");
  std::string_view digits = word_;
  if (digits.front() == '+') digits.remove_prefix(1);
  double value = 0.0;
  const auto [stop, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::result_out_of_range)
    return error(what + " " + in_quotes(word_) + " is too large or too small a number");
  if (code != std::errc{} || stop != digits.data() + digits.size())
    return error(what + " is not a number: " + in_quotes(word_));
  return error(what + " is not a finite number: " + in_quotes(word_));
}

std::string_view without_marks(std::string_view bytes, const std::string& place, std::string& storage,
                               std::string& note) {
  if (bytes.starts_with("\xEF\xBB\xBF")) {
    bytes.remove_prefix(3);
    note = place + ":1: byte order mark skipped";
  }
  // A lone CR as line end, as on the first Macintoshes.
  if (bytes.find('\n') == std::string_view::npos && bytes.find('\r') != std::string_view::npos) {
    storage = bytes;
    std::replace(storage.begin(), storage.end(), '\r', '\n');
    return storage;
  }
  return bytes;
}

}  // namespace phare
