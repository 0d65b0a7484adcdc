#include "visual/photometry/readers/point_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "config/formats/toml_table.h"
#include "visual/photometry/readers/file_text.h"
#include "visual/photometry/readers/grid_build.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

/// Words of a header cell in capitals: "Intensity (cd)" -> INTENSITY, CD.
std::vector<std::string> words_of(std::string_view cell) {
  std::vector<std::string> words(1);
  for (const char c : upper_case(cell)) {
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool has_any(const std::vector<std::string>& words, std::initializer_list<std::string_view> wanted) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(wanted.begin(), wanted.end(), std::string_view(word)) != wanted.end();
  });
}

bool is_limit(const std::vector<std::string>& words) {
  return has_any(words, {"MIN", "MAX", "MINIMUM", "MAXIMUM", "LIMIT", "LIMITS", "REQUIRED", "REQUIREMENT", "SPEC",
                         "MARGIN", "ALLOWED", "TOLERANCE"});
}
bool is_lux(const std::vector<std::string>& words) {
  return has_any(words, {"LX", "LUX", "ILLUMINANCE"});
}
bool is_value(const std::vector<std::string>& words) {
  return !is_limit(words) &&
         (is_lux(words) || has_any(words, {"CD", "CANDELA", "INTENSITY", "MEASURED", "VALUE", "READING"}));
}
bool is_point(const std::vector<std::string>& words) {
  return !is_value(words) && !is_limit(words) &&
         has_any(words, {"POINT", "POINTS", "TESTPOINT", "POSITION", "LOCATION"});
}
bool is_beam(const std::vector<std::string>& words) {
  return words.size() == 1 && has_any(words, {"BEAM", "LAMP", "SAMPLE", "FUNCTION", "HEADLAMP"});
}
bool is_angle(const std::vector<std::string>& words, std::string_view letter, std::string_view name) {
  return !words.empty() && (words.front() == letter || words.front() == name) &&
         (words.size() == 1 || (words.size() == 2 && words[1] == "DEG"));
}

char separator_of(std::string_view header) {
  for (const char c : {'\t', ';'}) {
    if (header.find(c) != std::string_view::npos) return c;
  }
  return ',';
}

/// Cells of a line; a separator in quotes does not part, and the quotes go.
std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = std::string(trimmed(cell));
  return cells;
}

bool is_blank(std::string_view cell) {
  const std::string capitals = upper_case(cell);
  constexpr std::array<std::string_view, 9> kNone{"", "-", "--", "N/A", "NA", "N.A.", "NM", "N.M.", "NOT MEASURED"};
  return std::find(kNone.begin(), kNone.end(), capitals) != kNone.end() || capitals == "\xE2\x80\x93" ||
         capitals == "\xE2\x80\x94";  // dashes of word processors
}

/// A number with blanks or commas between thousands; elsewhere a decimal comma.
std::optional<double> cell_number(std::string cell, char separator) {
  std::erase_if(cell, [](char c) { return c == ' ' || c == '\''; });
  const std::size_t comma = cell.find(',');
  if (comma != std::string::npos) {
    bool thousands = separator == ',' && comma > 0 && cell.find('.') >= comma;
    for (std::size_t at = comma; thousands && at != std::string::npos; at = cell.find(',', at + 1)) {
      const std::size_t end = std::min({cell.size(), cell.find(',', at + 1), cell.find('.', at + 1)});
      thousands = end - at == 4;
    }
    if (thousands) {
      std::erase(cell, ',');
    } else {
      if (separator == ',') return std::nullopt;
      std::replace(cell.begin(), cell.end(), ',', '.');
    }
  }
  return parse_number(cell);
}

/// Three digits and no more behind one mark, as behind a mark of thousands: "5,000", "15.100"; what is below 1 is not.
bool looks_like_thousands(std::string_view cell) {
  const std::size_t mark = cell.find_first_of(",.");
  return mark != std::string_view::npos && mark >= 1 && mark <= 3 && cell.front() != '0' && cell.size() == mark + 4 &&
         std::all_of(cell.begin() + static_cast<std::ptrdiff_t>(mark) + 1, cell.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

/// "1", "0.86", "1/2", "1 1/2", "1-1/2"; letters and signs around are gone.
std::optional<double> angle_number(std::string text) {
  for (char& c : text) {
    if (c == '-' || c == '\t' || c == ',') c = ' ';
  }
  std::string_view rest = trimmed(text);
  while (!rest.empty() && (rest.front() == '/' || rest.front() == ' ')) rest.remove_prefix(1);
  while (!rest.empty() && (rest.back() == '/' || rest.back() == ' ')) rest.remove_suffix(1);
  if (rest.empty()) return std::nullopt;
  double sum = 0.0;
  const std::size_t blank = rest.find(' ');
  std::string_view last = rest;
  if (blank != std::string_view::npos) {
    const auto whole = parse_number(rest.substr(0, blank));
    last = trimmed(rest.substr(blank));
    if (!whole || *whole < 0.0 || last.find('/') == std::string_view::npos) return std::nullopt;
    sum = *whole;
  }
  const std::size_t slash = last.find('/');
  const auto above = parse_number(last.substr(0, slash));
  if (!above || *above < 0.0) return std::nullopt;
  if (slash == std::string_view::npos) return sum + *above;
  const auto below = parse_number(last.substr(slash + 1));
  if (!below || !(*below > 0.0)) return std::nullopt;
  return sum + *above / *below;
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// "10U-90U", "10U to 90U": from one elevation to another.
bool is_range(std::string_view name) {
  const std::string plain = plain_name(name);
  return plain.starts_with("10U") && plain.find("90U") != std::string::npos;
}

class ListReader {
 public:
  ListReader(std::string_view text, const std::string& name, const PointListSettings& settings)
      : text_(text, name, false), settings_(settings) {
    lists_.name = name;
    for (const std::string& known : settings.known_names) {
      known_.insert(plain_name(known));
      known_.insert(mirrored_name(plain_name(known)));  // as lists for left-hand traffic have them
    }
  }

  Result<PointLists> read() {
    if (const Status header = read_header(); !header) return header.error();
    while (const auto line = text_.next_line()) {
      if (line->empty() || line->front() == '#') continue;
      if (const Status row = read_row(*line); !row) return row.error();
    }
    std::size_t points = 0;
    for (const PointList& beam : lists_.beams) points += beam.points.size();
    if (points == 0) return text_.error("the list has no points");
    if (marked_ > 0 && marked_ == like_thousands_ && !beyond_thousand_)
      lists_.warnings.push_back(lists_.name + ":" + std::to_string(first_marked_line_) + ": " +
                                in_quotes(first_marked_) + " is read as " + number_text(first_marked_value_) +
                                ", as all values of three digits behind their mark; thousands are written without one");
    return std::move(lists_);
  }

 private:
  struct Value {
    std::size_t column = 0;
    bool lux = false;
    std::string beam;
  };

  Status take_remark(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return Done{};
    const std::string key = upper_case(trimmed(line.substr(1, colon - 1)));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (key == "DISTANCE_M") {
      const auto distance = parse_number(value);
      if (!distance || !(*distance > 0.0) || *distance > 1e6)
        return text_.error("distance_m is no number of metres above 0: " + in_quotes(value));
      lists_.distance_m = *distance;
    } else if (key == "UNIT") {
      const std::string unit = upper_case(value);
      if (unit != "CD" && unit != "LX") return text_.error("unit " + in_quotes(value) + " is neither cd nor lx");
      all_lux_ = unit == "LX";
    }
    return Done{};
  }

  Status read_header() {
    std::optional<std::string_view> line;
    while ((line = text_.next_line())) {
      if (line->empty()) continue;
      if (line->front() != '#') break;
      if (const Status remark = take_remark(*line); !remark) return remark.error();
    }
    if (!line) return text_.error("the file ends before its list");
    separator_ = separator_of(*line);
    const std::vector<std::string> cells = cells_of(*line, separator_);
    columns_ = cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::vector<std::string> words = words_of(cells[i]);
      std::optional<std::size_t>* one = is_point(words)                      ? &point_
                                        : is_beam(words)                     ? &beam_
                                        : is_angle(words, "H", "HORIZONTAL") ? &h_
                                        : is_angle(words, "V", "VERTICAL")   ? &v_
                                                                             : nullptr;
      if (one != nullptr) {
        if (*one) return text_.error("column " + in_quotes(cells[i]) + " is there twice");
        *one = i;
      } else if (is_value(words)) {
        Value value{i, is_lux(words) || (all_lux_ && !has_any(words, {"CD", "CANDELA", "INTENSITY"})), ""};
        for (const std::string& word : words) {
          if (!is_value({word}) && word != "I" && word != "E") value.beam += (value.beam.empty() ? "" : " ") + word;
        }
        values_.push_back(std::move(value));
      }
    }
    if (!point_ && !(h_ && v_)) return text_.error("no column names the points: expected \"point\", or H and V");
    if (values_.empty())
      return text_.error("no column holds the values: expected one named cd, intensity, value, measured or lux");
    if (beam_ && values_.size() > 1)
      return text_.error("either a column tells the beam or each beam has its own of values, not both");
    for (const Value& value : values_) {
      if (!value.lux) continue;
      if (lists_.distance_m <= 0.0) lists_.distance_m = settings_.distance_m;
      if (lists_.distance_m <= 0.0) return text_.error("values in lx need \"# distance_m: …\" or --distance");
    }
    if (values_.size() > 1) {
      std::set<std::string> names;
      for (const Value& value : values_) {
        if (!names.insert(value.beam).second)
          return text_.error("two columns of values cannot be told apart: " +
                             (value.beam.empty() ? "neither names its beam" : in_quotes(value.beam)));
      }
    }
    if (!beam_) {
      for (const Value& value : values_) lists_.beams.push_back({values_.size() > 1 ? value.beam : "", {}});
    }
    return Done{};
  }

  /// Where a row is measured.
  Result<MeasuredPoint> place(const std::vector<std::string>& cells) {
    MeasuredPoint point;
    point.line = text_.line();
    if (point_) point.name = cells[*point_];
    if (h_ && v_ && !(is_blank(cells[*h_]) && is_blank(cells[*v_]))) {
      const auto h = cell_number(cells[*h_], separator_), v = cell_number(cells[*v_], separator_);
      if (!h || !v) return text_.error("no pair of angles: " + in_quotes(cells[*h_] + ", " + cells[*v_]));
      point.at = HV{*h, *v};
      if (point.name.empty()) point.name = number_text(*h) + ", " + number_text(*v);
    } else {
      point.at = point_of_name(point.name);
    }
    if (point.at && (std::abs(point.at->h_deg) > 180.0 || std::abs(point.at->v_deg) > 90.0))
      return text_.error("the direction " + in_quotes(point.name) + " is outside the sphere");
    if (point.at && settings_.mirror_h) point.at->h_deg = 0.0 - point.at->h_deg;
    if (!point.at && settings_.mirror_h) point.name = mirrored_name(plain_name(point.name));
    const std::string plain = plain_name(point.name);
    if (!point.at && !is_range(point.name) && !settings_.known_names.empty() && !known_.contains(plain))
      return text_.error(in_quotes(point.name) +
                         " is no direction such as 4D 20L, 0.86D-3.5R or H-V, and no row of a rulebook");
    return point;
  }

  /// Whether all values may have been meant as thousands is known at the end.
  void note_mark(const std::string& cell, double number) {
    beyond_thousand_ = beyond_thousand_ || number >= 1000.0;
    if (cell.find_first_of(",.") == std::string::npos) return;
    if (marked_++ == 0) {
      first_marked_ = cell;
      first_marked_value_ = number;
      first_marked_line_ = text_.line();
    }
    like_thousands_ += looks_like_thousands(cell) ? 1 : 0;
  }

  Status read_row(std::string_view line) {
    std::vector<std::string> cells = cells_of(line, separator_);
    while (cells.size() > columns_ && cells.back().empty()) cells.pop_back();
    if (cells.size() > columns_)
      return text_.error("expected " + std::to_string(columns_) + " columns, got " + std::to_string(cells.size()) +
                         (separator_ == ',' ? " (a comma within a cell needs quotes)" : ""));
    cells.resize(columns_);  // reports leave out blank cells at the end
    if (std::all_of(cells.begin(), cells.end(), [](const std::string& c) { return c.empty(); })) return Done{};
    auto point = place(cells);
    if (!point) return point.error();
    if (point->name.empty()) return text_.error("the row names no point");
    std::size_t beam = 0;
    if (beam_) {
      const auto same = [&](const PointList& list) { return list.beam == cells[*beam_]; };
      const auto found = std::find_if(lists_.beams.begin(), lists_.beams.end(), same);
      beam = static_cast<std::size_t>(found - lists_.beams.begin());
      if (found == lists_.beams.end()) lists_.beams.push_back({cells[*beam_], {}});
    }
    for (const Value& value : values_) {
      MeasuredPoint measured = *point;
      const std::string& cell = cells[value.column];
      if (!is_blank(cell)) {
        const auto number = cell_number(cell, separator_);
        if (!number) return text_.error("the value at " + in_quotes(point->name) + " is no number: " + in_quotes(cell));
        if (*number < 0.0) return text_.error("negative value " + number_text(*number));
        if (!value.lux) note_mark(cell, *number);
        const double factor = value.lux ? lists_.distance_m * lists_.distance_m : 1.0;
        std::string digits = cell;
        if (separator_ != ',') std::replace(digits.begin(), digits.end(), ',', '.');
        measured.cd = *number * factor;
        measured.step_cd = last_digit(digits) * factor;
        if (!std::isfinite(*measured.cd))
          return text_.error("the value times the distance squared is no finite number");
      }
      PointList& list = lists_.beams[beam++];
      for (const MeasuredPoint& other : list.points) {
        const bool same = measured.at && other.at
                              ? measured.at->h_deg == other.at->h_deg && measured.at->v_deg == other.at->v_deg
                              : plain_name(other.name) == plain_name(measured.name);
        if (same && measured.cd && other.cd)
          return text_.error("the point " + in_quotes(measured.name) + " is there twice, first in line " +
                             std::to_string(other.line));
      }
      list.points.push_back(std::move(measured));
    }
    return Done{};
  }

  FileText text_;
  const PointListSettings& settings_;
  PointLists lists_;
  std::set<std::string> known_;
  char separator_ = ',';
  bool all_lux_ = false, beyond_thousand_ = false;
  std::size_t marked_ = 0, like_thousands_ = 0, first_marked_line_ = 0;  // values with a mark
  std::string first_marked_;
  double first_marked_value_ = 0.0;
  std::size_t columns_ = 0;
  std::optional<std::size_t> point_, beam_, h_, v_;
  std::vector<Value> values_;
};

}  // namespace

std::size_t PointList::measured() const {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const MeasuredPoint& p) { return p.cd.has_value(); }));
}

std::optional<HV> point_of_name(std::string_view name) {
  std::string text = upper_case(name);
  for (const auto& [from, to] : {std::pair<const char*, const char*>{"\xC2\xBD", ".5"},
                                 {"\xC2\xBC", ".25"},
                                 {"\xC2\xBE", ".75"},
                                 {"\xC2\xB0", ""},
                                 {"DEG", ""},
                                 {"\xE2\x80\x93", "-"}})
    replace_all(text, from, to);
  if (text.find_first_not_of("0123456789./ -,UDLRHV\t") != std::string::npos) return std::nullopt;
  std::optional<double> h, v;
  std::string before;
  for (const char c : text) {
    if (c != 'U' && c != 'D' && c != 'L' && c != 'R' && c != 'H' && c != 'V') {
      before += c;
      continue;
    }
    const bool zero = c == 'H' || c == 'V', vertical = c == 'U' || c == 'D' || c == 'H';
    const bool bare = before.find_first_of("0123456789.") == std::string::npos;
    if (zero != bare) return std::nullopt;  // a letter without its number, or H and V with one
    const auto number = zero ? std::optional<double>(0.0) : angle_number(before);
    std::optional<double>& angle = vertical ? v : h;
    if (!number || angle) return std::nullopt;
    angle = c == 'D' || c == 'L' ? 0.0 - *number : *number;
    before.clear();
  }
  if (!h || !v || before.find_first_not_of(" -/,\t") != std::string::npos) return std::nullopt;
  return HV{*h, *v};
}

std::string plain_name(std::string_view name) {
  std::string capitals = upper_case(name), plain;
  replace_all(capitals, "ZONE ", "");
  replace_all(capitals, " ZONE", "");
  replace_all(capitals, "(OPEN)", "");
  replace_all(capitals, " TO ", "-");
  for (const char c : capitals) {
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '&') plain += c;
  }
  return plain;
}

std::string mirrored_name(std::string_view plain) {
  std::string mirrored(plain);
  for (std::size_t i = 0; i < mirrored.size(); ++i) {
    char& c = mirrored[i];
    if (c != 'L' && c != 'R') continue;
    // A letter of a side stands after a number or another of them, or is BR's; those of words stay.
    const char before = i > 0 ? plain[i - 1] : ' ';
    const bool after_side = i > 0 && mirrored[i - 1] != before;
    const bool side = (before >= '0' && before <= '9') || after_side || plain == "BR" || plain == "BL";
    if (side) c = c == 'L' ? 'R' : 'L';
  }
  return mirrored;
}

namespace {

/// The columns of a header that could be a list's.
struct ListHead {
  char separator = ',';
  std::size_t columns = 0, h = 0, v = 0;  ///< h, v: `columns` where there is none
  std::size_t values = 0;
  bool point = false;
};

/// Leaves `text` behind the header.
std::optional<ListHead> list_head(std::string_view bytes, std::string_view name, FileText& text) {
  const LampFormat format = find_format(bytes, name);
  if (format != LampFormat::kCsv && format != LampFormat::kFind) return std::nullopt;
  std::optional<std::string_view> line;
  while ((line = text.next_line()) && (line->empty() || line->front() == '#')) {
  }
  if (!line || line->size() > 4096) return std::nullopt;
  if (line->starts_with("\xEF\xBB\xBF")) line->remove_prefix(3);
  ListHead head;
  head.separator = separator_of(*line);
  const std::vector<std::string> cells = cells_of(*line, head.separator);
  head.columns = head.h = head.v = cells.size();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::vector<std::string> words = words_of(cells[i]);
    head.point = head.point || is_point(words);
    head.values += is_value(words) ? 1 : 0;
    if (is_angle(words, "H", "HORIZONTAL")) head.h = i;
    if (is_angle(words, "V", "VERTICAL")) head.v = i;
  }
  return head;
}

}  // namespace

bool names_points(std::string_view bytes, std::string_view name) {
  FileText text(bytes, std::string(name), false);
  const auto head = list_head(bytes, name, text);
  return head && head->point && head->values > 0;
}

bool is_point_list(std::string_view bytes, std::string_view name) {
  FileText text(bytes, std::string(name), false);
  const auto head = list_head(bytes, name, text);
  if (!head || head->values == 0) return false;
  if (head->point) return true;
  if (head->h == head->columns || head->v == head->columns) return false;
  std::set<std::string> all_h, all_v;
  std::size_t rows = 0;
  while (const auto line = text.next_line()) {
    if (line->empty() || line->front() == '#') continue;
    const std::vector<std::string> cells = cells_of(*line, head->separator);
    if (cells.size() <= std::max(head->h, head->v)) return false;
    all_h.insert(cells[head->h]);
    all_v.insert(cells[head->v]);
    ++rows;
  }
  const bool one_line = all_h.size() < 2 || all_v.size() < 2;
  return rows > 0 && (head->values > 1 || one_line || 2 * rows < all_h.size() * all_v.size());
}

Result<PointLists> parse_point_lists(std::string_view bytes, const std::string& name,
                                     const PointListSettings& settings) {
  std::string storage, note;
  const std::string_view text = without_marks(bytes, name, storage, note);
  auto lists = ListReader(text, name, settings).read();
  if (lists && !note.empty()) lists->notes.push_back(note);
  return lists;
}

}  // namespace phare
