// The reader of DBC files: see dbc.h for what it reads and what it passes over.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "cockpit_io/can_frame.h"
#include "cockpit_io/dbc.h"
#include "cockpit_io/dbc_lines.h"
#include "cockpit_io/dbc_multiplexors.h"
#include "cockpit_io/text_scanner.h"
#include "config/base/input_files.h"

namespace phare {

namespace {

constexpr std::uint32_t kExtendedMark = 0x8000'0000u;  // of a BO_ number
constexpr std::string_view kOrphans = "VECTOR__INDEPENDENT_SIG_MSG";
/// Statements that run to a semicolon, by their beginnings; most are passed over.
constexpr std::string_view kKeywords[]{"VERSION", "VAL_", "CM_",     "SG_MUL_VAL_", "SIG",    "SGTYPE",   "BA_", "BU_",
                                       "BS_",     "EV_",  "ENVVAR_", "BO_TX_BU_",   "FILTER", "NS_DESC_", "CAT_"};
constexpr int kFirstFdFormat = 14;  // VFrameFormat: 14 StandardCAN_FD, 15 ExtendedCAN_FD

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// A text in quotes without the backslashes that its quotes have.
std::string plain(std::string_view quoted) {
  std::string text(quoted);
  for (std::size_t at = 0; (at = text.find("\\\"", at)) != std::string::npos; ++at) text.erase(at, 1);
  return text;
}

/// Reads a DBC file statement by statement.
class Parser {
 public:
  Parser(std::string_view text, Dbc& dbc) : lines_(text), dbc_(dbc) {}

  void run() {
    while (lines_.next()) statement();
    hang_multiplexors(dbc_);
    lengthen_names();
    tell_same_names();
  }

 private:
  void statement() {
    TextScanner scan(lines_.text());
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
    if (keyword.empty()) {
      if (!scan.at_end()) problem({}, "begins with no keyword");
      return;
    }
    const bool known = std::any_of(std::begin(kKeywords), std::end(kKeywords),
                                   [&](std::string_view known) { return keyword.starts_with(known); });
    if (!known) return problem({}, "unknown keyword \"" + std::string(keyword) + "\"");
    const DbcLines::Statement whole = lines_.to_its_end(keyword);
    if (!whole.flaw.empty()) dbc_.problems.push_back({lines_.number(), {}, {}, std::string(whole.flaw)});
    TextScanner words(whole.text);
    words.word();  // the keyword
    if (keyword == "VAL_") return value_names(words);
    if (keyword == "VAL_TABLE_") return value_table(words);
    if (keyword == "SIG_VALTYPE_") return value_type(words);
    if (keyword == "CM_") return comment(words);
    if (keyword == "SG_MUL_VAL_") return multiplex_ranges(words);
    if (keyword == "BA_") return attribute(words);
  }

  void problem(std::string_view signal, std::string reason) {
    dbc_.problems.push_back({lines_.number(), message_name_, std::string(signal), std::move(reason)});
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
    if (!message.extended && id > CanFrame::kStandardIdMax && id <= CanFrame::kExtendedIdMax) {
      problem({}, "id " + std::to_string(id) + " does not fit 11 bits and lacks the mark of a 29-bit id; taken as one");
      message.extended = true;
    }
    if (id > (message.extended ? CanFrame::kExtendedIdMax : CanFrame::kStandardIdMax)) {
      return problem({}, "id " + std::to_string(id) + " does not fit " + (message.extended ? "29" : "11") + " bits");
    }
    message.id = static_cast<std::uint32_t>(id);
    if (const auto [known, added] = by_id_.try_emplace({message.id, message.extended}, dbc_.messages.size()); !added) {
      return problem({}, "id " + std::to_string(*number) + " is taken by the message of line " +
                             std::to_string(dbc_.messages[known->second].line) + "; its signals are left out");
    }
    message.name = name;
    message.length_bytes = *length;
    message.fd = *length > 8;
    message.line = lines_.number();
    dbc_.messages.push_back(std::move(message));
    in_message_ = true;
    skip_signals_ = false;
  }

  void signal(TextScanner& scan) {
    if (skip_signals_) return;
    if (!in_message_) return problem({}, "a signal before the first message");
    DbcMessage& message = dbc_.messages.back();
    DbcSignal s;
    s.line = lines_.number();
    s.name = scan.loose_word();
    if (s.name.empty()) return problem({}, "expected a signal's name");
    if (is_digit(s.name.front())) problem(s.name, "a name must not begin with a digit; kept");
    if (!multiplexing(scan, s)) return;
    if (!scan.take(':')) return problem(s.name, "expected \":\" after the signal's name");
    if (!layout(scan, s) || !scaling(scan, s)) return;
    if (const auto unit = scan.quoted()) {
      s.unit = plain(*unit);
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
    if (const DbcSignal* known = message.find(s.name)) {
      return problem(s.name, "is already in this message, line " + std::to_string(known->line));
    }
    message.signals.push_back(std::move(s));
  }

  /// The mark after the name: none, M, m and a number, or m and a number and M.
  bool multiplexing(TextScanner& scan, DbcSignal& s) {
    const std::string_view mark = scan.word();
    if (mark.empty()) return true;
    if (mark == "M") {
      s.is_multiplexor = true;
      return true;
    }
    TextScanner number(mark.substr(1));
    const auto value = number.number<std::uint64_t>();
    const bool nested = number.rest() == "M";
    if (mark.front() != 'm' || !value || (!nested && !number.rest().empty())) {
      problem(s.name, "expected M or m and a number, got \"" + std::string(mark) + "\"");
      return false;
    }
    s.is_multiplexor = nested;
    s.multiplex_values = {{*value, *value}};
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

  // ---- statements about a message or signal that stands further up; those that were left out there are passed over

  DbcMessage* named_message(TextScanner& scan) {
    message_name_.clear();
    const auto number = scan.number<std::uint64_t>();
    if (!number) return nullptr;
    bool extended = *number <= 0xFFFF'FFFFu && (*number & kExtendedMark) != 0;
    const auto id = static_cast<std::uint32_t>(extended ? *number & ~std::uint64_t{kExtendedMark} : *number);
    extended = extended || id > CanFrame::kStandardIdMax;  // as message() takes a number that lacks the mark
    const auto found = by_id_.find({id, extended});
    return found == by_id_.end() ? nullptr : &dbc_.messages[found->second];
  }

  static DbcSignal* signal_of(DbcMessage* message, std::string_view name) {
    return message == nullptr ? nullptr : const_cast<DbcSignal*>(std::as_const(*message).find(name));
  }

  DbcSignal* named_signal(TextScanner& scan) {
    DbcMessage* message = named_message(scan);
    return signal_of(message, scan.loose_word());
  }

  /// number "name" number "name" …
  std::map<std::int64_t, std::string> names(TextScanner& scan, std::string_view of) {
    std::map<std::int64_t, std::string> all;
    while (!scan.at_end() && scan.rest().front() != ';') {
      const auto value = scan.number<std::int64_t>();
      const auto name = value ? scan.quoted() : std::nullopt;
      if (!name) {
        problem(of, "expected a number and a name in quotes; the names before it are kept");
        break;
      }
      const auto [known, added] = all.try_emplace(*value);
      if (!added)
        problem(of, "names the value " + std::to_string(*value) + " twice, \"" + known->second + "\" and \"" +
                        plain(*name) + "\"; the second is used");
      known->second = plain(*name);
    }
    return all;
  }

  void value_names(TextScanner& scan) {
    DbcSignal* s = named_signal(scan);
    if (s == nullptr) return;
    if (!s->value_names.empty()) problem(s->name, "has value names already; those of this line are used");
    TextScanner table(scan.rest());
    if (const auto known = tables_.find(std::string(table.loose_word())); known != tables_.end()) {
      s->value_names = known->second;
      return;
    }
    s->value_names = names(scan, s->name);
  }

  void value_table(TextScanner& scan) {
    message_name_.clear();
    const std::string name(scan.loose_word());
    if (name.empty()) return problem({}, "expected the table's name");
    tables_[name] = names(scan, name);
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

  void comment(TextScanner& scan) {
    const std::string_view of = scan.word();
    if (of == "SG_") {
      DbcMessage* m = named_message(scan);
      const std::string_view name = scan.loose_word();
      if (name.empty()) return problem({}, "expected the signal's name before its comment");
      DbcSignal* s = signal_of(m, name);
      const auto text = scan.quoted();
      if (s != nullptr && text) s->comment = plain(*text);
    } else if (of == "BO_") {
      DbcMessage* m = named_message(scan);
      const auto text = scan.quoted();
      if (m != nullptr && text) m->comment = plain(*text);
    }
  }

  /// id signal multiplexor first-last, first-last;
  void multiplex_ranges(TextScanner& scan) {
    DbcMessage* m = named_message(scan);
    const std::string name(scan.loose_word());
    const std::string above(scan.loose_word());
    DbcSignal* s = signal_of(m, name);
    if (s == nullptr) return;
    message_name_ = m->name;
    const DbcSignal* multiplexor = m->find(above);
    if (multiplexor == nullptr || !multiplexor->is_multiplexor || multiplexor == s) {
      return problem(name, "\"" + above + "\" is no multiplexor of this message; the values after its m are kept");
    }
    std::vector<MultiplexRange> ranges;
    do {
      const auto first = scan.number<std::uint64_t>();
      const auto last = first && scan.take('-') ? scan.number<std::uint64_t>() : std::nullopt;
      if (!last || *last < *first) return problem(name, "expected ranges such as 0-3, 7-7; left as it was");
      ranges.push_back({*first, *last});
    } while (scan.take(','));
    s->multiplexor = above;
    s->multiplex_values = std::move(ranges);
  }

  /// VFrameFormat (CAN FD), and the long symbols that stand for names beyond 32 letters; all others are passed over.
  void attribute(TextScanner& scan) {
    const auto name = scan.quoted();
    const std::string_view of = scan.word();
    if (name == std::string_view("VFrameFormat") && of == "BO_") {
      DbcMessage* m = named_message(scan);
      const auto format = scan.number<int>();
      if (m != nullptr && format && *format >= kFirstFdFormat) m->fd = true;
    } else if (name == std::string_view("SystemMessageLongSymbol") && of == "BO_") {
      DbcMessage* m = named_message(scan);
      const auto symbol = scan.quoted();
      if (m != nullptr && symbol && !symbol->empty()) m->name = *symbol;
    } else if (name == std::string_view("SystemSignalLongSymbol") && of == "SG_") {
      DbcMessage* m = named_message(scan);
      const std::string signal(scan.loose_word());
      const auto symbol = scan.quoted();
      if (m != nullptr && symbol && !symbol->empty())
        long_names_.push_back({m->id, m->extended, signal, std::string(*symbol)});
    }
  }

  /// At the end, because all other statements speak of the short names.
  void lengthen_names() {
    for (const LongName& renamed : long_names_) {
      DbcMessage& m = dbc_.messages[by_id_.at({renamed.id, renamed.extended})];
      DbcSignal* s = signal_of(&m, renamed.name);
      if (s == nullptr || m.find(renamed.symbol) != nullptr) continue;
      s->name = renamed.symbol;
      for (DbcSignal& below : m.signals) {
        if (below.multiplexor == renamed.name) below.multiplexor = renamed.symbol;
      }
    }
  }

  /// At the end, because a long name may be all that tells two messages apart.
  void tell_same_names() {
    std::map<std::string_view, int> lines;
    for (const DbcMessage& m : dbc_.messages) {
      const auto [first, added] = lines.try_emplace(m.name, m.line);
      if (!added)
        dbc_.problems.push_back({m.line,
                                 m.name,
                                 {},
                                 "the message of line " + std::to_string(first->second) +
                                     " has this name too; by the name that one is found, by its id this one"});
    }
  }

  struct LongName {
    std::uint32_t id;
    bool extended;
    std::string name, symbol;
  };

  DbcLines lines_;
  bool in_name_list_ = false;
  bool in_message_ = false;
  bool skip_signals_ = false;
  std::string message_name_;
  std::map<std::pair<std::uint32_t, bool>, std::size_t> by_id_;
  std::map<std::string, std::map<std::int64_t, std::string>> tables_;
  std::vector<LongName> long_names_;
  Dbc& dbc_;
};

}  // namespace

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
  const auto text = read_file_or_input(file);
  return text ? parse_dbc(*text, input_name(file)) : text.error();
}

}  // namespace phare
