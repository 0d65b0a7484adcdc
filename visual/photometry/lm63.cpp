// Reader of IES LM-63 photometry files, editions 1986 to 2019, types A, B and C.
// Liberal in layout (any line breaks, commas or blanks, any case), strict in numbers: what it cannot mean is refused
// with file:line. What it repaired is in IntensityTable::notes. The whole table comes out unfolded: H on both sides, C
// 0..360.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>

#include "config/content_hash.h"
#include "visual/photometry/intensity_table.h"

namespace phare {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 64u
                                         << 20;  // a 0.01° grid of a headlamp stays below; more is no photometry file

bool is_separator(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_separator(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_separator(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

/// A word of a hostile file, fit for an error line.
std::string in_quotes(std::string_view word) {
  std::string text = "\"";
  for (const char c : word.substr(0, 24)) text += c >= 0x20 && c < 0x7f ? c : '?';
  return text + (word.size() > 24 ? "…\"" : "\"");
}

/// Shortest text of a number.
std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

/// The text of a file, line by line for the header and word by word for the numbers.
class Text {
 public:
  Text(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  std::optional<std::string_view> next_line() {
    if (at_ >= text_.size()) return std::nullopt;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    word_line_ = line_++;
    return trimmed(line);
  }

  /// Next word after separators and line ends; empty at the end of the file. `line()` is the word's.
  std::string_view next_word() {
    while (at_ < text_.size() && (is_separator(text_[at_]) || text_[at_] == '\n')) {
      if (text_[at_] == '\n') ++line_;
      ++at_;
    }
    word_line_ = line_;
    const std::size_t begin = std::min(at_, text_.size());
    while (at_ < text_.size() && !is_separator(text_[at_]) && text_[at_] != '\n') ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// A finite number, or the error. `what` names it.
  Result<double> number(const std::string& what) {
    std::string_view word = next_word();
    if (word.empty()) return error("the file ends where " + what + " is expected");
    const std::string_view all = word;
    if (word.front() == '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code == std::errc::result_out_of_range)
      return error(what + " " + in_quotes(all) + " is too large or too small a number");
    if (code != std::errc{} || end != word.data() + word.size())
      return error(what + " is not a number: " + in_quotes(all));
    if (!std::isfinite(value)) return error(what + " is not a finite number: " + in_quotes(all));
    return value;
  }

  Error error(std::string reason) const { return {place(), std::move(reason)}; }
  std::string place() const { return file_ + ":" + std::to_string(word_line_); }
  std::size_t size() const { return text_.size(); }

 private:
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t word_line_ = 1;
};

/// Edition of the file from its first line. Field 12 is a factor only before 1995.
struct Edition {
  std::string version;
  bool field_12_is_factor = false;
};

Edition edition_of(std::string_view first_line) {
  const std::string line = upper(first_line);
  if (line.starts_with("IESNA91")) return {"IESNA91", true};
  if (line.starts_with("IESNA:LM-63-") || line.starts_with("IES:LM-63-")) {
    return {std::string(first_line.substr(0, 32)), false};
  }
  return {"LM-63-1986", true};  // that edition has no such line
}

struct Header {
  std::size_t second_count = 0;  // vertical angles, or gamma
  std::size_t first_count = 0;   // horizontal angles, or C
  PhotometricType type = PhotometricType::kA;
  double scale = 1.0;
};

Result<std::size_t> read_count(Text& text, const std::string& what) {
  const auto value = text.number(what);
  if (!value) return value.error();
  // A table of n values takes at least 2n - 1 characters, so no count can reach the size of the file.
  if (*value < 1.0 || *value != std::floor(*value) || *value > static_cast<double>(text.size())) {
    return text.error(what + " cannot be " + number_text(*value) + " in a file of " + std::to_string(text.size()) +
                      " bytes");
  }
  return static_cast<std::size_t>(*value);
}

/// TILT=INCLUDE: a table of lamp position over tilt. Headlamp photometry is as mounted, so the factors are not used.
Status skip_tilt_table(Text& text, std::vector<std::string>& notes) {
  if (const auto geometry = text.number("the lamp-to-luminaire geometry"); !geometry) return geometry.error();
  const auto count = read_count(text, "the number of tilt angles");
  if (!count) return count.error();
  for (std::size_t i = 0; i < *count; ++i) {
    if (const auto angle = text.number("tilt angle " + std::to_string(i + 1)); !angle) return angle.error();
  }
  bool all_one = true;
  for (std::size_t i = 0; i < *count; ++i) {
    const auto factor = text.number("tilt factor " + std::to_string(i + 1));
    if (!factor) return factor.error();
    all_one = all_one && *factor == 1.0;
  }
  if (!all_one)
    notes.push_back(text.place() + ": tilt factors are not applied: the photometry is of the lamp as mounted");
  return Done{};
}

Result<Header> read_header(Text& text, const Edition& edition, std::vector<std::string>& notes) {
  Header header;
  if (const auto lamps = text.number("the number of lamps"); !lamps) return lamps.error();
  if (const auto lumens = text.number("the lumens per lamp"); !lumens) return lumens.error();
  const auto multiplier = text.number("the candela multiplier");
  if (!multiplier) return multiplier.error();
  if (*multiplier <= 0.0) return text.error("the candela multiplier is " + number_text(*multiplier) + ", not above 0");
  const auto second_count = read_count(text, "the number of vertical angles");
  if (!second_count) return second_count.error();
  const auto first_count = read_count(text, "the number of horizontal angles");
  if (!first_count) return first_count.error();
  // Each value needs a character and a separator; checked before anything of that size is allocated.
  if (*second_count > text.size() / *first_count) {
    return text.error(std::to_string(*first_count) + " × " + std::to_string(*second_count) +
                      " candela cannot be in a file of " + std::to_string(text.size()) + " bytes");
  }
  const auto type = text.number("the photometric type");
  if (!type) return type.error();
  if (*type != 1.0 && *type != 2.0 && *type != 3.0) {
    return text.error("the photometric type is " + number_text(*type) + ", not 1 (C), 2 (B) or 3 (A)");
  }
  const auto units = text.number("the units type");  // feet or metres: of the luminaire's size, candela do not care
  if (!units) return units.error();
  if (*units != 1.0 && *units != 2.0)
    notes.push_back(text.place() + ": units type " + number_text(*units) +
                    " is neither feet (1) nor metres (2); unused");
  for (const char* what : {"the luminaire's width", "the luminaire's length", "the luminaire's height"}) {
    if (const auto size = text.number(what); !size) return size.error();
  }
  const auto ballast = text.number("the ballast factor");
  if (!ballast) return ballast.error();
  if (*ballast <= 0.0) return text.error("the ballast factor is " + number_text(*ballast) + ", not above 0");
  double factor = 1.0;
  const auto field_12 = text.number("field 12 (ballast-lamp factor or file generation type)");
  if (!field_12) return field_12.error();
  if (edition.field_12_is_factor) {
    if (*field_12 < 0.0) return text.error("the ballast-lamp photometric factor is " + number_text(*field_12));
    if (*field_12 == 0.0) {
      notes.push_back(text.place() + ": ballast-lamp photometric factor 0 taken as 1");
    } else {
      factor = *field_12;
    }
  }
  if (const auto watts = text.number("the input watts"); !watts) return watts.error();

  header.second_count = *second_count;
  header.first_count = *first_count;
  header.type = static_cast<PhotometricType>(static_cast<int>(*type));
  header.scale = *multiplier * *ballast * factor;
  return header;
}

/// Strictly ascending angles within [min, max].
Result<std::vector<double>> read_angles(Text& text, std::size_t count, const std::string& what, double min_deg,
                                        double max_deg) {
  std::vector<double> angles;
  angles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto angle = text.number(what + " angle " + std::to_string(i + 1) + " of " + std::to_string(count));
    if (!angle) return angle.error();
    if (*angle < min_deg || *angle > max_deg) {
      return text.error(what + " angle " + number_text(*angle) + " is outside " + number_text(min_deg) + " to " +
                        number_text(max_deg));
    }
    if (!angles.empty() && *angle <= angles.back()) {
      return text.error(what + " angles must increase, but " + number_text(*angle) + " follows " +
                        number_text(angles.back()));
    }
    angles.push_back(*angle);
  }
  return angles;
}

/// Columns of the file become columns of the unfolded table: target angle and the column it repeats.
struct Column {
  double angle_deg = 0.0;
  std::size_t source = 0;
};

bool before(const Column& a, const Column& b) {
  return a.angle_deg < b.angle_deg;
}
bool before_angle(const Column& column, double angle_deg) {
  return column.angle_deg < angle_deg;
}

/// Adds to each (ascending) column its image at `about2 - angle`, but none that is there already (a column on the
/// mirror plane).
void mirror(std::vector<Column>& columns, double about2_deg) {
  const std::vector<Column> half = columns;
  for (const Column& column : half) {
    const double angle = about2_deg - column.angle_deg;
    const auto there = std::lower_bound(half.begin(), half.end(), angle, before_angle);
    if (there == half.end() || there->angle_deg != angle) columns.push_back({angle, column.source});
  }
  std::sort(columns.begin(), columns.end(), before);
}

/// Undoes the symmetry that the first and last horizontal angle stand for (LM-63-19 §5.15).
Result<std::vector<Column>> unfold(const std::vector<double>& first_deg, PhotometricType type, const Text& text,
                                   std::vector<std::string>& notes) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < first_deg.size(); ++i) columns.push_back({first_deg[i], i});
  const double begin = first_deg.front();
  const double end = first_deg.back();

  if (type != PhotometricType::kC) {
    if (begin == 0.0) mirror(columns, 0.0);
    if (columns.size() < 2) return text.error("one horizontal angle (" + number_text(begin) + ") is no beam");
    return columns;
  }
  if (begin == 0.0 && end == 0.0) {
    columns.push_back({360.0, 0});
  } else if (begin == 0.0 && end == 90.0) {
    mirror(columns, 180.0);
    mirror(columns, 360.0);
  } else if (begin == 0.0 && end == 180.0) {
    mirror(columns, 360.0);
  } else if (begin == 90.0 && end == 270.0) {
    // Symmetric about the plane C 90 - C 270: C and 180 - C are alike.
    std::vector<Column> all = columns;
    for (const Column& column : columns) {
      const double angle = 180.0 - column.angle_deg;  // -90 .. 90
      if (column.angle_deg != 90.0 && column.angle_deg != 270.0)
        all.push_back({angle < 0.0 ? angle + 360.0 : angle, column.source});
      if (angle == 0.0) all.push_back({360.0, column.source});
    }
    std::sort(all.begin(), all.end(), before);
    if (all.front().angle_deg != 0.0) return text.error("C angles from 90 to 270 need one at 180");
    columns = std::move(all);
  } else if (begin == 0.0 && end > 180.0 && end < 360.0) {
    double widest = 0.0;
    for (std::size_t i = 1; i < first_deg.size(); ++i) widest = std::max(widest, first_deg[i] - first_deg[i - 1]);
    if (360.0 - end > widest * 1.0001)
      return text.error("C angles end at " + number_text(end) + ", not at 0, 90, 180 or 360");
    notes.push_back(text.place() + ": C angles end at " + number_text(end) + "; the plane C 0 repeated at 360");
    columns.push_back({360.0, 0});
  } else if (begin != 0.0 || end != 360.0) {
    return text.error("C angles from " + number_text(begin) + " to " + number_text(end) + " are no symmetry of LM-63");
  }
  return columns;
}

Result<std::string> read_bytes(const std::filesystem::path& file, const std::string& name) {
  std::error_code code;
  if (std::filesystem::is_directory(file, code)) return Error{name, "is a directory"};
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  if (code) return Error{name, "cannot be read: " + code.message()};
  if (size > kMaxFileBytes) return Error{name, "is larger than 64 MiB, no photometry file"};
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) return Error{name, std::string("cannot be read: ") + std::strerror(errno)};
  return bytes;
}

}  // namespace

Result<IntensityTable> read_lm63(const std::filesystem::path& file, GammaAxis axis) {
  const std::string place = file.string();
  auto bytes = read_bytes(file, place);
  if (!bytes) return bytes.error();

  IntensityTable table;
  table.name = file.filename().string();
  table.content_hash = content_hash(std::as_bytes(std::span(*bytes)));
  table.axis = axis;
  if (bytes->empty()) return Error{place, "is empty"};

  std::string_view content = *bytes;
  if (content.starts_with("\xEF\xBB\xBF")) {
    content.remove_prefix(3);
    table.notes.push_back(place + ":1: byte order mark skipped");
  }
  std::string old_mac_lines;  // a lone CR as line end: only the line numbers and the header need it
  if (content.find('\n') == std::string_view::npos && content.find('\r') != std::string_view::npos) {
    old_mac_lines = content;
    std::replace(old_mac_lines.begin(), old_mac_lines.end(), '\r', '\n');
    content = old_mac_lines;
  }
  Text text(content, place);

  // Free text and keywords up to the TILT line.
  std::optional<Edition> edition;
  std::string tilt;
  while (true) {
    const auto line = text.next_line();
    if (!line) return text.error("no TILT= line: not an LM-63 file, or cut off");
    if (!edition) edition = edition_of(*line);
    const std::string capitals = upper(*line);
    if (!capitals.starts_with("TILT")) continue;
    const std::size_t equals = capitals.find_first_not_of(" \t", 4);
    if (equals == std::string::npos || capitals[equals] != '=') continue;
    tilt = trimmed(line->substr(equals + 1));
    break;
  }
  table.version = edition->version;
  if (upper(tilt) == "INCLUDE") {
    if (const auto skipped = skip_tilt_table(text, table.notes); !skipped) return skipped.error();
  } else if (upper(tilt) != "NONE") {
    return text.error("TILT=" + in_quotes(tilt) + " names another file; only TILT=NONE and TILT=INCLUDE are read");
  }

  const auto header = read_header(text, *edition, table.notes);
  if (!header) return header.error();
  table.type = header->type;
  const bool is_c = table.type == PhotometricType::kC;
  const double second_max = table.type == PhotometricType::kB ? 180.0 : is_c ? 180.0 : 90.0;
  const double first_max = table.type == PhotometricType::kB ? 90.0 : is_c ? 360.0 : 180.0;
  auto second =
      read_angles(text, header->second_count, is_c ? "gamma" : "vertical", is_c ? 0.0 : -second_max, second_max);
  if (!second) return second.error();
  if (second->size() < 2) return text.error("one vertical angle (" + number_text(second->front()) + ") is no beam");
  const auto first =
      read_angles(text, header->first_count, is_c ? "C" : "horizontal", is_c ? 0.0 : -first_max, first_max);
  if (!first) return first.error();
  auto columns = unfold(*first, table.type, text, table.notes);
  if (!columns) return columns.error();

  // The file stores one horizontal angle after the other; the table one vertical angle after the other.
  const std::size_t rows = second->size();
  std::vector<double> in_file(first->size() * rows);
  for (std::size_t i = 0; i < in_file.size(); ++i) {
    const auto value = text.number("a candela value");
    if (!value)
      return Error{value.error().place, value.error().reason + " (value " + std::to_string(i + 1) + " of " +
                                            std::to_string(in_file.size()) + ")"};
    if (*value < 0.0) return text.error("negative candela " + number_text(*value));
    in_file[i] = *value * header->scale;
    if (!std::isfinite(in_file[i])) return text.error("candela times the factors of the header is no finite number");
  }
  if (!text.next_word().empty()) {
    const std::string where = text.place();
    std::size_t extra = 1;
    while (!text.next_word().empty()) ++extra;
    table.notes.push_back(where + ": " + std::to_string(extra) + " word(s) after the last candela value ignored");
  }

  table.second_deg = std::move(*second);
  table.candela.resize(rows * columns->size());
  for (std::size_t i = 0; i < columns->size(); ++i) {
    const Column& column = (*columns)[i];
    table.first_deg.push_back(column.angle_deg);
    for (std::size_t j = 0; j < rows; ++j) table.candela[j * columns->size() + i] = in_file[column.source * rows + j];
  }
  return table;
}

}  // namespace phare
