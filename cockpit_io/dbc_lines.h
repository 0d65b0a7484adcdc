// A DBC file's lines and statements. BO_ and SG_ are one line; every other statement runs to its semicolon, and to the
// next line that begins with a keyword when that was forgotten.
#pragma once

#include <string>
#include <string_view>

namespace phare {

class DbcLines {
 public:
  explicit DbcLines(std::string_view text) : rest_(text) {}

  /// On to the next line; false at the end of the file.
  bool next();
  std::string_view text() const { return text_; }
  /// Counted from 1; of a statement the line that begins it.
  int number() const { return number_; }

  struct Statement {
    std::string text;
    std::string_view flaw;  ///< of its end; empty: none
  };
  /// The whole statement this line begins. A quoted text may run over lines; a line in it that looks like a new message
  /// or signal ends it all the same: the closing quote was forgotten.
  Statement to_its_end(std::string_view keyword);

 private:
  std::string_view rest_, text_;
  int read_ = 0, number_ = 0;
};

}  // namespace phare
