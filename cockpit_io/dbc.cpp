#include "cockpit_io/dbc.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "cockpit_io/text_scanner.h"

namespace phare {

namespace {

constexpr std::uint32_t kExtendedMark = 0x8000'0000u;  // of a BO_ number
constexpr std::uint32_t kStandardIdMax = 0x7FFu;
constexpr std::uint32_t kExtendedIdMax = 0x1FFF'FFFFu;
constexpr std::string_view kOrphans = "VECTOR__INDEPENDENT_SIG_MSG";

/// The position of the bit that is one less significant (Motorola, from the top) or one more (Intel, from the bottom).
/// Motorola numbering: 7 6 5 4 3 2 1 0 | 15 14 … 8 | 23 …, so below bit 0 of a byte comes bit 7 of the next.
std::uint32_t next_bit(bool motorola, std::uint32_t bit) {
  if (!motorola) return bit + 1;
  return bit % 8 == 0 ? bit + 15 : bit - 1;
}

/// Bytes a frame needs to hold the signal.
std::uint32_t bytes_needed(const DbcSignal& s) {
  const std::uint32_t first_byte = s.start_bit / 8;
  const std::uint32_t bits_in_first = s.motorola ? s.start_bit % 8 + 1 : 8 - s.start_bit % 8;
  if (s.length_bits <= bits_in_first) return first_byte + 1;
  return first_byte + 1 + (s.length_bits - bits_in_first + 7) / 8;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_integer(const DbcSignal& s) {
  return s.type == DbcSignal::Type::kUnsigned || s.type == DbcSignal::Type::kSigned;
}

std::uint64_t mask(std::uint32_t bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

std::int64_t sign_extended(std::uint64_t raw, std::uint32_t bits) {
  const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
  return static_cast<std::int64_t>((raw ^ sign) - sign);
}

void write_bits(const DbcSignal& s, std::uint64_t raw, CanFrame& frame) {
  std::uint32_t bit = s.start_bit;
  for (std::uint32_t i = 0; i < s.length_bits; ++i, bit = next_bit(s.motorola, bit)) {
    const std::uint32_t rank = s.motorola ? s.length_bits - 1 - i : i;
    const auto at = static_cast<std::uint8_t>(1u << (bit % 8));
    std::uint8_t& byte = frame.data[bit / 8];
    byte = static_cast<std::uint8_t>(((raw >> rank) & 1u) != 0 ? byte | at : byte & ~at);
  }
}

/// Reads a DBC file statement by statement. A statement is one line; only quoted texts run over several.
class Parser {
 public:
  Parser(std::string_view text, Dbc& dbc) : rest_(text), dbc_(dbc) {}

  void run() {
    while (next_line()) statement();
  }

 private:
  bool next_line() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_text_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++line_;
    return true;
  }

  void statement() {
    TextScanner scan(line_text_);
    const std::string_view keyword = scan.word();
    if (in_name_list_) {  // NS_ lists keywords, one a line
      if (scan.at_end()) return;
      in_name_list_ = false;
    }
    if (keyword == "BO_") return message(scan);
    if (keyword == "SG_") return signal(scan);
    if (keyword == "NS_") {
      in_name_list_ = true;
      return;
    }
    if (keyword == "VAL_") return value_names(scan);
    if (keyword == "SIG_VALTYPE_") return value_type(scan);
    if (keyword.empty()) {
      if (!scan.at_end()) problem({}, "begins with no keyword");
      return;
    }
    const bool passed_over =
        keyword == "CM_" || keyword == "VERSION" || keyword.starts_with("BA_") || keyword == "BU_" ||
        keyword == "BS_" || keyword.starts_with("VAL_TABLE_") || keyword.starts_with("EV_") ||
        keyword.starts_with("ENVVAR_") || keyword.starts_with("BU_") || keyword.starts_with("SIG") ||
        keyword.starts_with("SGTYPE") || keyword.starts_with("SG_MUL") || keyword.starts_with("CAT_") ||
        keyword == "BO_TX_BU_" || keyword == "FILTER" || keyword == "NS_DESC_";
    if (!passed_over) return problem({}, "unknown keyword \"" + std::string(keyword) + "\"");
    pass_over_text();
  }

  /// Moves on to the line where a quoted text that this line begins ends. A line that looks like a new message or
  /// signal ends it too: the closing quote was forgotten.
  void pass_over_text() {
    if (std::count(line_text_.begin(), line_text_.end(), '"') % 2 == 0) return;
    const int begin = line_;
    while (true) {
      const std::string_view before = rest_;
      if (!next_line()) break;
      TextScanner scan(line_text_);
      const std::string_view keyword = scan.word();
      const bool new_block =
          (keyword == "BO_" && scan.number<std::uint64_t>()) || (keyword == "SG_" && looks_like_signal(scan));
      if (new_block) {
        rest_ = before;
        --line_;
        break;
      }
      if (std::count(line_text_.begin(), line_text_.end(), '"') % 2 == 1) return;
    }
    dbc_.problems.push_back({begin, {}, {}, "a text in quotes does not end"});
  }

  static bool looks_like_signal(TextScanner scan) {
    return !scan.loose_word().empty() && scan.rest().find('@') != std::string_view::npos;
  }

  void problem(std::string_view signal, std::string reason) {
    dbc_.problems.push_back({line_, message_name_, std::string(signal), std::move(reason)});
  }

  void message(TextScanner& scan) {
    in_message_ = false;
    skip_signals_ = true;  // of a message that cannot be used
    message_name_.clear();
    const auto number = scan.number<std::uint64_t>();
    const std::string_view name = scan.loose_word();
    message_name_ = name;
    if (!number || name.empty()) return problem({}, "expected BO_ number name: length node; its signals are left out");
    if (!scan.take(':')) return problem({}, "expected \":\" after the message's name; its signals are left out");
    const auto length = scan.number<std::uint32_t>();
    if (!length) return problem({}, "expected the message's length in bytes; its signals are left out");
    if (is_digit(name.front())) problem({}, "a name must not begin with a digit; kept");
    if (name == kOrphans) return;  // a container of signals that lie in no message
    if (*length > CanFrame::kMaxLength)
      return problem({}, "a message of " + std::to_string(*length) + " bytes; 64 is the most");

    DbcMessage message;
    message.extended = *number <= 0xFFFF'FFFFu && (*number & kExtendedMark) != 0;
    const std::uint64_t id = message.extended ? *number & ~std::uint64_t{kExtendedMark} : *number;
    if (!message.extended && id > kStandardIdMax && id <= kExtendedIdMax) {
      problem({}, "id " + std::to_string(id) + " does not fit 11 bits and lacks the mark of a 29-bit id; taken as one");
      message.extended = true;
    }
    if (id > (message.extended ? kExtendedIdMax : kStandardIdMax)) {
      return problem({}, "id " + std::to_string(id) + " does not fit " + (message.extended ? "29" : "11") + " bits");
    }
    message.id = static_cast<std::uint32_t>(id);
    if (const auto [known, added] = by_id_.try_emplace({message.id, message.extended}, dbc_.messages.size()); !added) {
      return problem({}, "id " + std::to_string(*number) + " is taken by the message of line " +
                             std::to_string(dbc_.messages[known->second].line) + "; its signals are left out");
    }
    message.name = name;
    message.length_bytes = *length;
    message.line = line_;
    dbc_.messages.push_back(std::move(message));
    in_message_ = true;
    skip_signals_ = false;
  }

  void signal(TextScanner& scan) {
    if (skip_signals_) return;
    if (!in_message_) return problem({}, "a signal before the first message");
    DbcMessage& message = dbc_.messages.back();
    DbcSignal s;
    s.line = line_;
    s.name = scan.loose_word();
    if (s.name.empty()) return problem({}, "expected a signal's name");
    if (is_digit(s.name.front())) problem(s.name, "a name must not begin with a digit; kept");
    if (!multiplexing(scan, s)) return;
    if (!scan.take(':')) return problem(s.name, "expected \":\" after the signal's name");
    if (!layout(scan, s) || !scaling(scan, s)) return;
    if (const auto unit = scan.quoted()) {
      s.unit = *unit;
    } else {
      return problem(s.name, "expected the unit in quotes");
    }
    if (s.length_bits == 0 || s.length_bits > 64) {
      return problem(s.name, "is " + std::to_string(s.length_bits) + " bits long; 1 to 64 are possible");
    }
    if (s.start_bit >= 8 * CanFrame::kMaxLength || bytes_needed(s) > message.length_bytes) {
      return problem(s.name, "does not fit its message: it needs " +
                                 std::to_string(std::uint64_t{s.start_bit} / 8 + 1) +
                                 (s.start_bit < 8 * CanFrame::kMaxLength && bytes_needed(s) > s.start_bit / 8 + 1
                                      ? " to " + std::to_string(bytes_needed(s))
                                      : "") +
                                 " bytes, " + message.name + " has " + std::to_string(message.length_bytes));
    }
    if (message.find(s.name) != nullptr) {
      return problem(s.name, "is already in this message, line " + std::to_string(message.find(s.name)->line));
    }
    if (s.is_multiplexor && message.multiplexor() != nullptr) {
      return problem(s.name, "is a second multiplexor beside " + message.multiplexor()->name);
    }
    message.signals.push_back(std::move(s));
  }

  /// The mark after the name: none, M, or m and a number.
  bool multiplexing(TextScanner& scan, DbcSignal& s) {
    const std::string_view mark = scan.word();
    if (mark.empty()) return true;
    if (mark == "M") {
      s.is_multiplexor = true;
      return true;
    }
    TextScanner number(mark.substr(1));
    const auto value = number.number<std::uint64_t>();
    if (mark.front() == 'm' && value && number.rest() == "M") {
      problem(s.name, "nested multiplexing (" + std::string(mark) + ") is not read");
      return false;
    }
    if (mark.front() != 'm' || !value || !number.rest().empty()) {
      problem(s.name, "expected M or m and a number, got \"" + std::string(mark) + "\"");
      return false;
    }
    s.multiplex_value = *value;
    return true;
  }

  /// start|length@order sign
  bool layout(TextScanner& scan, DbcSignal& s) {
    const auto start = scan.number<std::uint32_t>();
    const bool bar = start && scan.take('|');
    const auto length = bar ? scan.number<std::uint32_t>() : std::nullopt;
    const bool at = length && scan.take('@');
    s.motorola = at && scan.take('0');
    const bool order = s.motorola || (at && scan.take('1'));
    const bool is_signed = order && scan.take('-');
    if (!order || (!is_signed && !(order && scan.take('+')))) {
      problem(s.name, "expected start|length@order and sign, such as 7|16@0+");
      return false;
    }
    s.start_bit = *start;
    s.length_bits = *length;
    s.type = is_signed ? DbcSignal::Type::kSigned : DbcSignal::Type::kUnsigned;
    return true;
  }

  /// (factor,offset) [minimum|maximum]
  bool scaling(TextScanner& scan, DbcSignal& s) {
    const auto pair = [&scan](char open, char between, char close, double& first, double& second) {
      if (!scan.take(open)) return false;
      const auto a = scan.number<double>();
      if (!a || !scan.take(between)) return false;
      const auto b = scan.number<double>();
      if (!b || !scan.take(close)) return false;
      first = *a;
      second = *b;
      return std::isfinite(*a) && std::isfinite(*b);
    };
    if (!pair('(', ',', ')', s.factor, s.offset) || s.factor == 0.0) {
      problem(s.name, "expected (factor,offset), finite and the factor not 0");
      return false;
    }
    if (!pair('[', '|', ']', s.minimum, s.maximum)) {
      problem(s.name, "expected [minimum|maximum]");
      return false;
    }
    return true;
  }

  /// The signal a VAL_ or SIG_VALTYPE_ line names. Nothing (and no problem) when the message or signal was left out
  /// before.
  DbcSignal* named_signal(TextScanner& scan) {
    message_name_.clear();
    const auto number = scan.number<std::uint64_t>();
    if (!number) return nullptr;
    const std::string_view name = scan.loose_word();
    const bool extended = *number <= 0xFFFF'FFFFu && (*number & kExtendedMark) != 0;
    const auto id = static_cast<std::uint32_t>(extended ? *number & ~std::uint64_t{kExtendedMark} : *number);
    const auto found = by_id_.find({id, extended});
    if (found == by_id_.end()) return nullptr;
    auto& signals = dbc_.messages[found->second].signals;
    const auto signal =
        std::find_if(signals.begin(), signals.end(), [&](const DbcSignal& s) { return s.name == name; });
    return signal == signals.end() ? nullptr : &*signal;
  }

  void value_names(TextScanner& scan) {
    DbcSignal* s = named_signal(scan);
    if (s == nullptr) return pass_over_text();
    while (!scan.at_end() && scan.rest().front() != ';') {
      const auto value = scan.number<std::int64_t>();
      const auto name = value ? scan.quoted() : std::nullopt;
      if (!name) return problem(s->name, "expected a number and a name in quotes; the names before it are kept");
      s->value_names[*value] = *name;
    }
  }

  void value_type(TextScanner& scan) {
    DbcSignal* s = named_signal(scan);
    if (s == nullptr) return;
    scan.take(':');
    const auto type = scan.number<int>();
    if (type == 0) return;
    if (type == 1 && s->length_bits == 32) {
      s->type = DbcSignal::Type::kFloat;
    } else if (type == 2 && s->length_bits == 64) {
      s->type = DbcSignal::Type::kDouble;
    } else {
      problem(s->name, "expected value type 0, 1 (float, 32 bits) or 2 (double, 64 bits)");
    }
  }

  std::string_view rest_;
  std::string_view line_text_;
  int line_ = 0;
  bool in_name_list_ = false;
  bool in_message_ = false;
  bool skip_signals_ = false;
  std::string message_name_;
  std::map<std::pair<std::uint32_t, bool>, std::size_t> by_id_;
  Dbc& dbc_;
};

}  // namespace

const DbcSignal* DbcMessage::find(std::string_view signal) const {
  const auto found = std::find_if(signals.begin(), signals.end(), [&](const DbcSignal& s) { return s.name == signal; });
  return found == signals.end() ? nullptr : &*found;
}

const DbcSignal* DbcMessage::multiplexor() const {
  const auto found = std::find_if(signals.begin(), signals.end(), [](const DbcSignal& s) { return s.is_multiplexor; });
  return found == signals.end() ? nullptr : &*found;
}

const DbcMessage* Dbc::find(std::string_view message) const {
  const auto found =
      std::find_if(messages.begin(), messages.end(), [&](const DbcMessage& m) { return m.name == message; });
  return found == messages.end() ? nullptr : &*found;
}

const DbcMessage* Dbc::find(std::uint32_t id, bool extended) const {
  const auto found = std::find_if(messages.begin(), messages.end(),
                                  [&](const DbcMessage& m) { return m.id == id && m.extended == extended; });
  return found == messages.end() ? nullptr : &*found;
}

std::size_t Dbc::signal_count() const {
  std::size_t count = 0;
  for (const DbcMessage& message : messages) count += message.signals.size();
  return count;
}

Result<Dbc> parse_dbc(std::string_view text, const std::string& name) {
  Dbc dbc;
  dbc.file = name;
  Parser(text, dbc).run();
  if (dbc.messages.empty()) {
    if (dbc.problems.empty()) return Error{name, "holds no message (BO_)"};
    const DbcProblem& first = dbc.problems.front();
    return Error{name + ":" + std::to_string(first.line), first.reason + "; the file holds no message"};
  }
  return dbc;
}

Result<Dbc> read_dbc(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return Error{file.string(), "no such file"};
  if (!std::filesystem::is_regular_file(file, ignored)) return Error{file.string(), "is not a file"};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return Error{file.string(), "cannot be read"};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_dbc(text, file.string());
}

std::optional<std::uint64_t> raw_bits(const DbcSignal& s, std::span<const std::uint8_t> data) {
  if (bytes_needed(s) > data.size()) return std::nullopt;
  std::uint64_t raw = 0;
  std::uint32_t bit = s.start_bit;
  for (std::uint32_t i = 0; i < s.length_bits; ++i, bit = next_bit(s.motorola, bit)) {
    const std::uint32_t rank = s.motorola ? s.length_bits - 1 - i : i;
    raw |= static_cast<std::uint64_t>((data[bit / 8] >> (bit % 8)) & 1u) << rank;
  }
  return raw;
}

std::optional<std::int64_t> raw_value(const DbcSignal& s, std::span<const std::uint8_t> data) {
  const auto raw = raw_bits(s, data);
  if (!raw) return std::nullopt;
  return s.type == DbcSignal::Type::kSigned ? sign_extended(*raw, s.length_bits) : static_cast<std::int64_t>(*raw);
}

std::optional<double> decode(const DbcMessage& message, const DbcSignal& s, const CanFrame& frame) {
  if (!frame.carries_data()) return std::nullopt;
  if (s.multiplex_value) {
    const DbcSignal* multiplexor = message.multiplexor();
    if (multiplexor == nullptr || raw_bits(*multiplexor, frame.bytes()) != s.multiplex_value) return std::nullopt;
  }
  const auto raw = raw_bits(s, frame.bytes());
  if (!raw) return std::nullopt;
  double value = 0.0;
  switch (s.type) {
    case DbcSignal::Type::kUnsigned:
      value = static_cast<double>(*raw);
      break;
    case DbcSignal::Type::kSigned:
      value = static_cast<double>(sign_extended(*raw, s.length_bits));
      break;
    case DbcSignal::Type::kFloat:
      value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(*raw)));
      break;
    case DbcSignal::Type::kDouble:
      value = std::bit_cast<double>(*raw);
      break;
  }
  const double physical = value * s.factor + s.offset;
  return std::isfinite(physical) ? std::optional(physical) : std::nullopt;
}

bool encode(const DbcMessage& message, const DbcSignal& s, double value, CanFrame& frame) {
  const double scaled = (value - s.offset) / s.factor;
  if (!std::isfinite(scaled) || bytes_needed(s) > frame.length || frame.length > CanFrame::kMaxLength) return false;
  std::uint64_t raw = 0;
  if (is_integer(s)) {
    const double rounded = std::round(scaled);
    const bool is_signed = s.type == DbcSignal::Type::kSigned;
    const double end =
        std::ldexp(1.0, static_cast<int>(s.length_bits) - (is_signed ? 1 : 0));  // first that does not fit
    if (rounded >= end || rounded < (is_signed ? -end : 0.0)) return false;
    raw = is_signed ? static_cast<std::uint64_t>(static_cast<std::int64_t>(rounded))
                    : static_cast<std::uint64_t>(rounded);
  } else if (s.type == DbcSignal::Type::kFloat) {
    raw = std::bit_cast<std::uint32_t>(static_cast<float>(scaled));
  } else {
    raw = std::bit_cast<std::uint64_t>(scaled);
  }
  if (s.multiplex_value) {
    const DbcSignal* multiplexor = message.multiplexor();
    if (multiplexor == nullptr || bytes_needed(*multiplexor) > frame.length) return false;
    if (*s.multiplex_value > mask(multiplexor->length_bits)) return false;
    write_bits(*multiplexor, *s.multiplex_value, frame);
  }
  write_bits(s, raw & mask(s.length_bits), frame);
  return true;
}

CanFrame empty_frame(const DbcMessage& message) {
  CanFrame frame;
  frame.id = message.id;
  frame.extended = message.extended;
  frame.fd = message.length_bytes > 8;
  frame.length = static_cast<std::uint8_t>(message.length_bytes);
  return frame;
}

}  // namespace phare
