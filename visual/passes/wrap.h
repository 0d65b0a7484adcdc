// A line of text over several rows: at blanks only, so that no figure is torn at its point.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace phare {

/// Appends rows of `line` no wider than `room`, in the unit of `width_of`; a word that is wider alone keeps a row of
/// its own. Blanks between words of one row stay as many as they are.
inline void wrap(const std::string& line, double room, const std::function<double(const std::string&)>& width_of,
                 std::vector<std::string>& rows) {
  std::string row;
  double width = 0.0;  // letters stand side by side: widths add up
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t word = line.find_first_not_of(' ', at);
    if (word == std::string::npos) break;
    const std::size_t end = std::min(line.find(' ', word), line.size());
    const std::string more = line.substr(at, end - at);
    width += width_of(more);
    if (!row.empty() && width > room) {
      rows.push_back(row);
      row = line.substr(word, end - word);
      width = width_of(row);
    } else {
      row += more;
    }
    at = end;
  }
  rows.push_back(row);
}

}  // namespace phare
