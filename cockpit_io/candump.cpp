#include "cockpit_io/candump.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

#include "cockpit_io/can_frame.h"
#include "cockpit_io/text_scanner.h"
#include "config/base/input_files.h"

namespace phare {

namespace {

constexpr std::uint32_t kErrorFlag = 0x2000'0000u;  // CAN_ERR_FLAG of linux/can.h

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

Error broken(std::string reason) {
  return Error{{}, std::move(reason)};
}

/// "(seconds.fraction)" in nanoseconds, exactly: a double would not hold today's date to the nanosecond.
std::optional<std::int64_t> stamp(TextScanner& scan) {
  if (!scan.take('(')) return std::nullopt;
  const auto seconds = scan.number<std::int64_t>();
  constexpr std::int64_t kMostSeconds = std::numeric_limits<std::int64_t>::max() / 1'000'000'000 - 1;
  if (!seconds || *seconds < 0 || *seconds > kMostSeconds || !scan.take('.')) return std::nullopt;
  std::int64_t fraction_ns = 0;
  std::int64_t digit_ns = 100'000'000;
  std::size_t digits = 0;
  const std::string_view rest = scan.rest();
  while (digits < rest.size() && rest[digits] >= '0' && rest[digits] <= '9') {
    fraction_ns += digit_ns * (rest[digits++] - '0');
    digit_ns /= 10;  // beyond nanoseconds: nothing
  }
  TextScanner after(rest.substr(digits));
  if (digits == 0 || !after.take(')')) return std::nullopt;
  scan = after;
  return *seconds * 1'000'000'000 + fraction_ns;
}

std::optional<Error> read_id(std::string_view text, CanFrame& frame) {
  if (text.size() != 3 && text.size() != 8) return broken("an id has 3 or 8 hexadecimal digits");
  std::uint32_t id = 0;
  for (const char c : text) {
    if (hex_digit(c) < 0) return broken("an id has 3 or 8 hexadecimal digits");
    id = id << 4 | static_cast<std::uint32_t>(hex_digit(c));
  }
  frame.extended = text.size() == 8;
  if (frame.extended && (id & kErrorFlag) != 0 && id <= (kErrorFlag | CanFrame::kExtendedIdMax)) {
    frame.error = true;
    frame.extended = false;
    id &= CanFrame::kExtendedIdMax;
  }
  if (id > (frame.extended || frame.error ? CanFrame::kExtendedIdMax : CanFrame::kStandardIdMax))
    return broken("the id does not fit its bits");
  frame.id = id;
  return std::nullopt;
}

std::optional<Error> read_data(std::string_view text, CanFrame& frame) {
  const std::size_t most = frame.fd ? CanFrame::kMaxLength : 8;
  while (!text.empty()) {
    if (text.front() == '_' && !frame.fd && frame.length == 8 && text.size() == 2 && hex_digit(text[1]) > 8)
      break;  // raw DLC
    if (text.front() == '.') {
      text.remove_prefix(1);
      continue;
    }
    if (text.size() < 2 || hex_digit(text[0]) < 0 || hex_digit(text[1]) < 0) {
      return broken("data is pairs of hexadecimal digits");
    }
    if (frame.length == most) return broken("more than " + std::to_string(most) + " data bytes");
    frame.data[frame.length++] = static_cast<std::uint8_t>(hex_digit(text[0]) << 4 | hex_digit(text[1]));
    text.remove_prefix(2);
  }
  return std::nullopt;
}

}  // namespace

Result<CandumpEntry> parse_candump_line(std::string_view line) {
  TextScanner scan(line);
  CandumpEntry entry;
  const auto stamp_ns = stamp(scan);
  if (!stamp_ns) return broken("expected a stamp such as (1700000000.123456)");
  entry.stamp_ns = *stamp_ns;
  const std::string_view interface = scan.token();
  if (interface.empty() || interface.find('#') != std::string_view::npos)
    return broken("expected an interface such as can0");
  const std::string_view text = scan.token();
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos) return broken("expected id#data");
  const std::string_view direction = scan.token();
  if ((!direction.empty() && direction != "R" && direction != "T") || !scan.at_end()) {
    return broken("more behind the data than R or T");
  }

  CanFrame& frame = entry.frame;
  if (auto error = read_id(text.substr(0, hash), frame)) return *error;
  std::string_view data = text.substr(hash + 1);
  if (data.starts_with('#')) {
    frame.fd = true;
    if (data.size() < 2 || hex_digit(data[1]) < 0) return broken("expected a digit of flags after ##");
    frame.fd_flags = static_cast<std::uint8_t>(hex_digit(data[1]));
    data.remove_prefix(2);
  } else if (data.starts_with('R')) {
    frame.remote = true;
    if (data.size() > 2 || (data.size() == 2 && (data[1] < '0' || data[1] > '8'))) {
      return broken("expected R and a length of 0 to 8");
    }
    if (data.size() == 2) frame.length = static_cast<std::uint8_t>(data[1] - '0');
    return entry;
  }
  if (auto error = read_data(data, frame)) return *error;
  return entry;
}

Result<CandumpLog> parse_candump(std::string_view text, const std::string& name) {
  CandumpLog log;
  log.file = name;
  int line_number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    ++line_number;
    TextScanner scan(line);
    if (scan.at_end() || scan.rest().front() == '#') continue;
    Result<CandumpEntry> entry = parse_candump_line(line);
    if (!entry) {
      const std::string cut = end == std::string_view::npos ? ", and the log ends within the line" : "";
      if (log.problems.size() < CandumpLog::kProblemsKept)
        log.problems.push_back({line_number, entry.error().reason + cut});
      ++log.broken_lines;
      continue;
    }
    if (!log.entries.empty() && entry->stamp_ns < log.entries.back().stamp_ns) ++log.backward_stamps;
    log.entries.push_back(*entry);
  }
  if (log.entries.empty()) {
    if (log.problems.empty()) return Error{name, "is empty: no CAN frame in it"};
    return Error{name + ":" + std::to_string(log.problems.front().line),
                 log.problems.front().reason + "; not one line of the file is a CAN frame"};
  }
  return log;
}

Result<CandumpLog> read_candump(const std::filesystem::path& file) {
  if (const std::string why = why_no_file(file); !why.empty()) return Error{file.string(), why};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return Error{file.string(), "cannot be read"};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_candump(text, file.string());
}

}  // namespace phare
