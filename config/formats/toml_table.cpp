#include "config/formats/toml_table.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <set>
#include <sstream>

// The only file that sees toml++, so its header-only implementation is compiled once.
// Its parser asserts that a key begins well before it reports that it does not; a malformed file must not end a debug
// build.
#define TOML_EXCEPTIONS 0
#define TOML_ASSERT(expr) static_assert(true)
#include <toml++/toml.h>

#include "config/base/input_files.h"

namespace phare {

struct TomlTable::Node {
  toml::table* table = nullptr;  ///< nullptr: missing, and already complained about
  std::uint32_t line = 1;
  std::string prefix;  ///< "channel.", for messages
  std::set<std::string> asked;
};

struct TomlTable::Document {
  std::filesystem::path file;
  toml::table root;
  std::list<Node> nodes;
  std::map<const toml::table*, Node*> by_table;
  std::vector<Error> errors;

  std::string at(std::uint32_t line) const { return file.string() + ":" + std::to_string(std::max(line, 1u)); }

  Node* node_of(toml::table* table, std::uint32_t line, std::string prefix) {
    if (table != nullptr) {
      if (const auto known = by_table.find(table); known != by_table.end()) return known->second;
    }
    Node& node = nodes.emplace_back();
    node.table = table;
    node.line = line;
    node.prefix = std::move(prefix);
    if (table != nullptr) by_table[table] = &node;
    return &node;
  }

  /// The value of a key, noted as asked for; complains when it is required and missing.
  toml::node* value(Node& node, std::string_view key, bool required) {
    node.asked.emplace(key);
    if (node.table == nullptr) return nullptr;
    toml::node* found = node.table->get(key);
    if (found == nullptr && required) {
      errors.push_back({at(node.line), "missing key \"" + node.prefix + std::string(key) + "\""});
    }
    return found;
  }

  void wrong(const Node& node, std::string_view key, const toml::node& value, const std::string& expected) {
    errors.push_back({at(value.source().begin.line), "\"" + node.prefix + std::string(key) + "\": " + expected});
  }

  template <typename Number>
  Number bounded(const Node& node, std::string_view key, const toml::node& value, std::optional<Number> number,
                 Number min, Number max, const char* kind) {
    const Number harmless = std::clamp(Number{}, min, max);
    if (!number) {
      wrong(node, key, value, std::string("expected ") + kind);
      return harmless;
    }
    if (!(*number >= min && *number <= max)) {
      std::ostringstream reason;
      reason << *number << " is outside " << min << " … " << max;
      wrong(node, key, value, reason.str());
      return harmless;
    }
    return *number;
  }
};

namespace {

/// A TOML float or integer as a finite number.
std::optional<double> finite_number(const toml::node& value) {
  if (const auto* real = value.as_floating_point()) {
    return std::isfinite(real->get()) ? std::optional(real->get()) : std::nullopt;
  }
  if (const auto* whole = value.as_integer()) return static_cast<double>(whole->get());
  return std::nullopt;
}

std::optional<std::int64_t> whole_number(const toml::node& value) {
  const auto* whole = value.as_integer();
  return whole ? std::optional(whole->get()) : std::nullopt;
}

/// Edit distance in which two neighbouring letters swapped count one (optimal string alignment; Damerau 1964).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({substitute, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

/// All letters of `part` occur in `whole`, in order, beginning with the first.
bool is_subsequence(std::string_view part, std::string_view whole) {
  if (part.empty() || whole.empty() || part.front() != whole.front()) return false;
  std::size_t matched = 0;
  for (const char letter : whole) matched += matched < part.size() && part[matched] == letter ? 1 : 0;
  return matched == part.size();
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> known) {
  std::string best;
  std::size_t best_distance = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : known) {
    // Letters left out ("fov_deg" for "fov_horizontal_deg") or too many are a likely slip, though many edits away.
    const bool part = name.size() >= 3 && (is_subsequence(name, candidate) || is_subsequence(candidate, name));
    const std::size_t distance =
        std::min<std::size_t>(edit_distance(name, candidate), part ? 2 : std::numeric_limits<std::size_t>::max());
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best_distance <= std::max<std::size_t>(2, name.size() / 2) ? best : std::string();
}

std::string unknown_name_reason(std::string_view what, std::string_view name, std::span<const std::string> known) {
  std::string reason = "no " + std::string(what) + " \"" + std::string(name) + "\"";
  if (const std::string nearest = nearest_name(name, known); !nearest.empty()) {
    return reason + "; did you mean \"" + nearest + "\"?";
  }
  reason += "; there is";
  for (std::size_t i = 0; i < known.size(); ++i) reason += (i == 0 ? " " : ", ") + known[i];
  return known.empty() ? "no " + std::string(what) + " is known here, \"" + std::string(name) + "\" is one too many"
                       : reason;
}

Result<TomlTable> TomlTable::read(const std::filesystem::path& path) {
  if (const std::string why = why_no_file(path); !why.empty()) return Error{path.string(), why};
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return Error{path.string(), "cannot be read"};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse(text, path.string());
}

Result<TomlTable> TomlTable::parse(std::string_view text, const std::string& name) {
  toml::parse_result parsed = toml::parse(text, name);
  if (!parsed) {
    const toml::parse_error& error = parsed.error();
    return Error{name + ":" + std::to_string(std::max(error.source().begin.line, 1u)),
                 std::string(error.description())};
  }
  auto document = std::make_shared<Document>();
  document->file = name;
  document->root = std::move(parsed).table();
  Node* node = document->node_of(&document->root, 1, "");
  return TomlTable(std::move(document), node);
}

std::optional<TomlTable::Region> TomlTable::region(std::string_view key) const {
  if (node_->table == nullptr) return std::nullopt;
  const toml::node* value = key.empty() ? node_->table : node_->table->get(key);
  if (value == nullptr) return std::nullopt;
  const toml::source_region& at = value->source();
  return Region{at.begin.line, at.begin.column, at.end.line, at.end.column};
}

bool TomlTable::has(std::string_view key) const {
  node_->asked.emplace(key);
  return node_->table != nullptr && node_->table->contains(key);
}

bool TomlTable::is_text(std::string_view key) const {
  return has(key) && node_->table->get(key)->is_string();
}

double TomlTable::number(std::string_view key, double min, double max) {
  const toml::node* value = document_->value(*node_, key, true);
  if (value == nullptr) return std::clamp(0.0, min, max);
  return document_->bounded(*node_, key, *value, finite_number(*value), min, max, "a finite number");
}

double TomlTable::number_or(std::string_view key, double fallback, double min, double max) {
  return has(key) ? number(key, min, max) : fallback;
}

std::string TomlTable::text(std::string_view key) {
  const toml::node* value = document_->value(*node_, key, true);
  if (value == nullptr) return {};
  if (const auto* string = value->as_string()) return string->get();
  document_->wrong(*node_, key, *value, "expected a text in quotes");
  return {};
}

std::string TomlTable::text_or(std::string_view key, std::string_view fallback) {
  return has(key) ? text(key) : std::string(fallback);
}

bool TomlTable::flag_or(std::string_view key, bool fallback) {
  const toml::node* value = document_->value(*node_, key, false);
  if (value == nullptr) return fallback;
  if (const auto* flag = value->as_boolean()) return flag->get();
  document_->wrong(*node_, key, *value, "expected true or false");
  return fallback;
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t min, std::int64_t max) {
  const toml::node* value = document_->value(*node_, key, true);
  if (value == nullptr) return std::clamp<std::int64_t>(0, min, max);
  return document_->bounded(*node_, key, *value, whole_number(*value), min, max, "a whole number");
}

std::int64_t TomlTable::integer_or(std::string_view key, std::int64_t fallback, std::int64_t min, std::int64_t max) {
  return has(key) ? integer(key, min, max) : fallback;
}

std::size_t TomlTable::choice(std::string_view key, std::span<const std::string_view> choices) {
  const std::size_t errors_before = document_->errors.size();
  const std::string chosen = text(key);
  const auto found = std::find(choices.begin(), choices.end(), chosen);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  const toml::node* value = document_->value(*node_, key, false);
  if (value != nullptr && document_->errors.size() == errors_before) {
    std::string reason = "\"" + chosen + "\" is none of";
    for (std::size_t i = 0; i < choices.size(); ++i) reason += (i == 0 ? " " : ", ") + std::string(choices[i]);
    document_->wrong(*node_, key, *value, reason);
  }
  return 0;
}

std::size_t TomlTable::choice_or(std::string_view key, std::size_t fallback,
                                 std::span<const std::string_view> choices) {
  return has(key) ? choice(key, choices) : fallback;
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count) {
  const toml::node* value = document_->value(*node_, key, true);
  std::vector<double> result;
  if (value == nullptr) return std::vector<double>(count, 0.0);
  bool good = value->is_array();
  if (const auto* array = value->as_array()) {
    for (const toml::node& element : *array) {
      const auto number = finite_number(element);
      good = good && number.has_value();
      result.push_back(number.value_or(0.0));
    }
    good = good && (count == 0 || result.size() == count);
  }
  if (!good) {
    document_->wrong(
        *node_, key, *value,
        "expected an array of " + (count == 0 ? "finite numbers" : std::to_string(count) + " finite numbers"));
    return std::vector<double>(count, 0.0);
  }
  return result;
}

std::vector<double> TomlTable::numbers_or(std::string_view key, std::span<const double> fallback) {
  if (!has(key)) return {fallback.begin(), fallback.end()};
  return numbers(key, fallback.size());
}

std::vector<std::vector<double>> TomlTable::rows_or_empty(std::string_view key, std::size_t columns) {
  const toml::node* value = document_->value(*node_, key, false);
  std::vector<std::vector<double>> rows;
  if (value == nullptr) return rows;
  const auto* array = value->as_array();
  bool good = array != nullptr && !array->empty();
  for (std::size_t i = 0; good && i < array->size(); ++i) {
    const auto* row = (*array)[i].as_array();
    good = row != nullptr && row->size() == columns;
    if (!good) break;
    std::vector<double>& numbers = rows.emplace_back();
    for (const toml::node& element : *row) {
      const auto number = finite_number(element);
      good = good && number.has_value();
      numbers.push_back(number.value_or(0.0));
    }
  }
  if (good) return rows;
  document_->wrong(*node_, key, *value,
                   "expected an array of arrays of " + std::to_string(columns) + " finite numbers");
  return {};
}

std::vector<std::variant<double, std::string>> TomlTable::values_or_empty(std::string_view key) {
  const toml::node* value = document_->value(*node_, key, false);
  std::vector<std::variant<double, std::string>> result;
  if (value == nullptr) return result;
  bool good = true;
  const auto take = [&](const toml::node& element) {
    if (const auto* string = element.as_string()) {
      result.emplace_back(string->get());
    } else if (const auto number = finite_number(element)) {
      result.emplace_back(*number);
    } else {
      good = false;
    }
  };
  if (const auto* array = value->as_array()) {
    for (const toml::node& element : *array) take(element);
  } else {
    take(*value);
  }
  if (!good || result.empty()) {
    document_->wrong(*node_, key, *value, "expected a finite number or a text, or an array of them");
    result.clear();
  }
  return result;
}

std::vector<std::string> TomlTable::texts_or_empty(std::string_view key) {
  const toml::node* value = document_->value(*node_, key, false);
  std::vector<std::string> result;
  if (value == nullptr) return result;
  bool good = value->is_array();
  if (const auto* array = value->as_array()) {
    for (const toml::node& element : *array) {
      good = good && element.is_string();
      if (const auto* string = element.as_string()) result.push_back(string->get());
    }
  }
  if (!good) document_->wrong(*node_, key, *value, "expected an array of texts");
  return good ? result : std::vector<std::string>{};
}

TomlTable TomlTable::table(std::string_view key) {
  toml::node* value = document_->value(*node_, key, true);
  toml::table* table = value != nullptr ? value->as_table() : nullptr;
  if (value != nullptr && table == nullptr) document_->wrong(*node_, key, *value, "expected a table");
  const std::uint32_t line = value != nullptr ? value->source().begin.line : node_->line;
  return TomlTable(document_, document_->node_of(table, line, node_->prefix + std::string(key) + "."));
}

std::optional<TomlTable> TomlTable::table_if(std::string_view key) {
  if (!has(key)) return std::nullopt;
  return table(key);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  toml::node* value = document_->value(*node_, key, false);
  std::vector<TomlTable> result;
  if (value == nullptr) return result;
  toml::array* array = value->as_array();
  if (array == nullptr) {
    document_->wrong(*node_, key, *value, "expected tables, [[" + node_->prefix + std::string(key) + "]]");
    return result;
  }
  for (toml::node& element : *array) {
    toml::table* table = element.as_table();
    if (table == nullptr) {
      document_->wrong(*node_, key, element, "expected a table");
      continue;
    }
    result.push_back(TomlTable(
        document_, document_->node_of(table, element.source().begin.line, node_->prefix + std::string(key) + ".")));
  }
  return result;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::pair<toml::source_position, std::string>> found;
  if (node_->table != nullptr) {
    for (auto&& [key, value] : *node_->table) found.emplace_back(key.source().begin, std::string(key.str()));
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& [where, name] : found) names.push_back(std::move(name));
  return names;
}

std::string TomlTable::place(std::string_view key) const {
  if (!key.empty() && node_->table != nullptr) {
    if (const toml::node* value = node_->table->get(key)) return document_->at(value->source().begin.line);
  }
  return document_->at(node_->line);
}

void TomlTable::fail(std::string_view key, std::string reason) {
  document_->errors.push_back({place(key), "\"" + node_->prefix + std::string(key) + "\": " + std::move(reason)});
}

const std::filesystem::path& TomlTable::file() const {
  return document_->file;
}

std::vector<Error> TomlTable::problems() const {
  std::vector<std::pair<std::uint32_t, Error>> unknown;
  for (const Node& node : document_->nodes) {
    if (node.table == nullptr) continue;
    const std::vector<std::string> known(node.asked.begin(), node.asked.end());
    for (auto&& [key, value] : *node.table) {
      const std::string name(key.str());
      if (node.asked.contains(name)) continue;
      const std::uint32_t line = key.source().begin.line;
      std::string reason = unknown_name_reason("key", name, known);
      if (!node.prefix.empty()) reason += " (in " + node.prefix.substr(0, node.prefix.size() - 1) + ")";
      unknown.emplace_back(line, Error{document_->at(line), std::move(reason)});
    }
  }
  std::stable_sort(unknown.begin(), unknown.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Error> all;
  for (auto& [line, error] : unknown) all.push_back(std::move(error));
  all.insert(all.end(), document_->errors.begin(), document_->errors.end());
  return all;
}

Status TomlTable::finish() {
  const std::vector<Error> all = problems();
  if (!all.empty()) return all.front();
  return Done{};
}

std::vector<std::string> TomlTable::known_keys() const {
  std::set<std::string> keys;
  for (const Node& node : document_->nodes) {
    for (const std::string& key : node.asked) keys.insert(node.prefix + key);
  }
  return {keys.begin(), keys.end()};
}

}  // namespace phare
