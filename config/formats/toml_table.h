// A TOML file read with every key checked: type, range, and no key that nobody asked for. Errors say file:line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// A table of a TOML file. A getter notes the key as known; a wrong type, a missing required key or a value out of
/// range is noted as an error (the getter then returns a harmless value) and comes out of `finish`. Copies refer to the
/// same document, so a child's errors come out of its root's `finish`, and a child must not ask after that.
class TomlTable {
 public:
  /// Parses `path`. Error when it cannot be read (place: the path) or is not TOML (place: path:line).
  static Result<TomlTable> read(const std::filesystem::path& path);
  /// The same from text; `name` stands for the file in messages.
  static Result<TomlTable> parse(std::string_view text, const std::string& name);

  bool has(std::string_view key) const;

  /// A finite number within [min, max]; an integer in the file is taken as a number.
  double number(std::string_view key, double min, double max);
  double number_or(std::string_view key, double fallback, double min, double max);
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string_view fallback);
  bool flag_or(std::string_view key, bool fallback);
  bool is_text(std::string_view key) const;  ///< for keys that take a text or something else
  std::int64_t integer(std::string_view key, std::int64_t min, std::int64_t max);
  std::int64_t integer_or(std::string_view key, std::int64_t fallback, std::int64_t min, std::int64_t max);
  /// A required text that is one of `choices`; otherwise an error naming the nearest. Returns its index.
  std::size_t choice(std::string_view key, std::span<const std::string_view> choices);
  std::size_t choice_or(std::string_view key, std::size_t fallback, std::span<const std::string_view> choices);
  /// A required array of exactly `count` finite numbers (0: any count); zeros when it is not.
  std::vector<double> numbers(std::string_view key, std::size_t count);
  std::vector<double> numbers_or(std::string_view key, std::span<const double> fallback);
  /// An array of arrays of exactly `columns` finite numbers; empty when the key is missing, and when it is anything
  /// else.
  std::vector<std::vector<double>> rows_or_empty(std::string_view key, std::size_t columns);
  /// Numbers and texts: one of them, or an array of them; empty when the key is missing.
  std::vector<std::variant<double, std::string>> values_or_empty(std::string_view key);
  /// An array of texts; empty when the key is missing.
  std::vector<std::string> texts_or_empty(std::string_view key);

  /// A required table; when missing, an empty one whose own getters stay silent.
  TomlTable table(std::string_view key);
  std::optional<TomlTable> table_if(std::string_view key);
  /// An array of tables, [[key]]; empty when missing.
  std::vector<TomlTable> tables(std::string_view key);
  /// Every key of this table in the file's order, for tables whose keys are names chosen by the writer.
  std::vector<std::string> keys() const;

  /// "file:line" of a key, or of the table when it has no such key.
  std::string place(std::string_view key = {}) const;
  /// Where a value stands in the text, or this table where no key is given ([[header]], or its inline form {…}): lines
  /// and columns count from 1, columns in Unicode code points; the end is the first place behind. Nothing: no such key.
  struct Region {
    std::uint32_t begin_line = 1, begin_column = 1, end_line = 1, end_column = 1;
  };
  std::optional<Region> region(std::string_view key = {}) const;
  /// Notes an error of the caller's own check at a key.
  void fail(std::string_view key, std::string reason);
  const std::filesystem::path& file() const;

  /// Everything that was wrong in the whole document: unknown keys come first (with the nearest known one), because a
  /// mistyped key is also why another is missing.
  std::vector<Error> problems() const;
  /// The first of them.
  Status finish();
  /// Every key that was asked for, with the tables it stands in ("design.lamp.name"), sorted.
  std::vector<std::string> known_keys() const;

 private:
  struct Document;
  struct Node;
  TomlTable(std::shared_ptr<Document> document, Node* node) : document_(std::move(document)), node_(node) {}

  std::shared_ptr<Document> document_;
  Node* node_;  ///< owned by the document
};

/// The known name with the smallest edit distance to `name`; empty when none is near enough to be what was meant.
std::string nearest_name(std::string_view name, std::span<const std::string> known);

/// "no key \"x\"; did you mean \"y\"?" with the known names instead of a guess when none is near.
std::string unknown_name_reason(std::string_view what, std::string_view name, std::span<const std::string> known);

}  // namespace phare
