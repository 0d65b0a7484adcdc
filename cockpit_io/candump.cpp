#include "cockpit_io/candump.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

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

/// "can0  123   [2]  11 22", with or without a stamp before it and "RX - -" in it.
bool is_of_the_screen(std::string_view line) {
  const std::size_t open = line.find(" ["), close = line.find(']', open);
  if (line.find('#') < open || open == std::string_view::npos || close == std::string_view::npos) return false;
  const std::string_view length = line.substr(open + 2, close - open - 2);
  return !length.empty() && length.size() <= 2 &&
         std::ranges::all_of(length, [](unsigned char c) { return std::isdigit(c) != 0; });
}

Result<CandumpEntry> read_line(std::string_view line, std::string_view& interface) {
  TextScanner scan(line);
  CandumpEntry entry;
  const auto expected = [line](const char* what) {
    return broken(is_of_the_screen(line) ? "is what candump shows on the screen; a log is what candump -l or -L writes"
                                         : std::string("expected ") + what);
  };
  const auto stamp_ns = stamp(scan);
  if (!stamp_ns) return expected("a stamp such as (1700000000.123456)");
  entry.stamp_ns = *stamp_ns;
  interface = scan.token();
  if (interface.empty() || interface.find('#') != std::string_view::npos) return expected("an interface such as can0");
  const std::string_view text = scan.token();
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos) return expected("id#data");
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

std::uint64_t count_backward_stamps(const std::vector<CandumpEntry>& entries) {
  std::uint64_t count = 0;
  for (std::size_t i = 1; i < entries.size(); ++i) count += entries[i].stamp_ns < entries[i - 1].stamp_ns ? 1u : 0u;
  return count;
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return all;
}

/// What goes back first, and how often.
std::string backward_doubt(const CandumpLog& log) {
  std::size_t first = 1;
  while (log.entries[first].stamp_ns >= log.entries[first - 1].stamp_ns) ++first;
  const CandumpEntry& entry = log.entries[first];
  char by_s[40];
  std::snprintf(by_s, sizeof by_s, "%.6f",
                static_cast<double>(log.entries[first - 1].stamp_ns - entry.stamp_ns) * 1e-9);
  const std::string line = std::to_string(entry.line);
  return log.file.string() + (log.counts_frames ? ": frame " + line : ":" + line) + ": the stamp goes back by " + by_s +
         " s, " +
         (log.backward_stamps == 1 ? "the only one that does"
                                   : "the first of " + std::to_string(log.backward_stamps) + " that do") +
         "; frames are taken at once until the stamps have caught up";
}

/// The interfaces from which the same ids come.
std::string mixed_doubt(const CandumpLog& log) {
  using Id = std::pair<std::uint32_t, bool>;
  std::map<Id, std::uint32_t> first;
  std::set<Id> shared;
  std::set<std::uint32_t> mixed;
  std::optional<Id> example;
  for (const CandumpEntry& entry : log.entries) {
    if (entry.frame.error) continue;
    const Id id{entry.frame.id, entry.frame.extended};
    const auto [known, added] = first.try_emplace(id, entry.interface);
    if (added || known->second == entry.interface) continue;
    if (!example) example = id;
    shared.insert(id);
    mixed.insert({known->second, entry.interface});
  }
  if (!example) return {};
  std::vector<std::string> names;
  for (const std::uint32_t i : mixed) names.push_back(log.interfaces[i]);
  char id[16];
  std::snprintf(id, sizeof id, example->second ? "%08X" : "%03X", example->first);
  return log.file.string() + ": id " + id +
         (shared.size() > 1 ? " and " + std::to_string(shared.size() - 1) + " more" : "") + " from several buses (" +
         listed(names) + "), which are mixed; --interface, or interface in the cockpit file, chooses one";
}

}  // namespace

Result<CandumpEntry> parse_candump_line(std::string_view line) {
  std::string_view interface;
  return read_line(line, interface);
}

Result<CandumpLog> parse_candump(std::string_view text, const std::string& name) {
  CandumpLog log;
  log.file = name;
  std::map<std::string, std::uint32_t, std::less<>> interfaces;
  int line_number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    ++line_number;
    TextScanner scan(line);
    if (scan.at_end() || scan.rest().front() == '#') continue;
    std::string_view interface;
    Result<CandumpEntry> entry = read_line(line, interface);
    if (!entry) {
      const std::string cut = end == std::string_view::npos ? ", and the log ends within the line" : "";
      if (log.problems.size() < CandumpLog::kProblemsKept)
        log.problems.push_back({line_number, entry.error().reason + cut});
      ++log.broken_lines;
      continue;
    }
    auto known = interfaces.find(interface);
    if (known == interfaces.end()) {
      known = interfaces.emplace(interface, static_cast<std::uint32_t>(log.interfaces.size())).first;
      log.interfaces.emplace_back(interface);
    }
    entry->interface = known->second;
    entry->line = line_number;
    log.entries.push_back(*entry);
  }
  log.backward_stamps = count_backward_stamps(log.entries);
  if (log.entries.empty()) {
    if (log.problems.empty()) return Error{name, "is empty: no CAN frame in it"};
    return Error{name + ":" + std::to_string(log.problems.front().line),
                 log.problems.front().reason + "; not one line of the file is a CAN frame"};
  }
  return log;
}

Result<CandumpLog> read_candump(const std::filesystem::path& file) {
  const auto text = read_file_or_input(file);
  return text ? parse_candump(*text, input_name(file)) : text.error();
}

Result<std::string> choose_interface(CandumpLog& log, const std::string& named, bool must_be_there) {
  const auto found = std::ranges::find(log.interfaces, named);
  const bool several = log.interfaces.size() > 1;
  if (named.empty()) return std::string();
  if (found == log.interfaces.end()) {
    const std::string reason = "no frame comes from " + named + ", but from " + listed(log.interfaces);
    if (must_be_there) return Error{log.file.string(), reason};
    return several ? log.file.string() + ": " + reason + ": all of them are taken" : std::string();
  }
  if (!several) return std::string();
  const auto kept = static_cast<std::uint32_t>(found - log.interfaces.begin());
  std::erase_if(log.entries, [kept](const CandumpEntry& entry) { return entry.interface != kept; });
  for (CandumpEntry& entry : log.entries) entry.interface = 0;
  std::vector<std::string> others = std::exchange(log.interfaces, {named});
  std::erase(others, named);
  log.backward_stamps = count_backward_stamps(log.entries);
  return log.file.string() + ": only the frames of " + named + " are taken, not those of " + listed(others);
}

std::vector<std::string> doubts(const CandumpLog& log) {
  std::vector<std::string> lines;
  if (log.backward_stamps > 0) lines.push_back(backward_doubt(log));
  if (log.interfaces.size() > 1) lines.push_back(mixed_doubt(log));
  std::erase(lines, "");
  return lines;
}

}  // namespace phare
