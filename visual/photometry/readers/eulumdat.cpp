// Reader of EULUMDAT files (.ldt): one value a line, candela per 1000 lm over C and gamma, symmetries Isym 0 to 4.
// Source: A. Stockmar, "EULUMDAT - ein Leuchtendatenformat für den europäischen Beleuchtungsplaner", 1990; field
// numbers in messages are those of that list. Candela = value × flux of the chosen lamp set / 1000 × conversion factor.
// A lamp count below 0 marks absolute photometry and changes no number. Repairs: decimal commas, blank lines, and files
// without the lines between flux and angles where the rest of the file can be read in one way only.
#include <algorithm>
#include <cmath>
#include <vector>

#include "visual/photometry/readers/file_text.h"
#include "visual/photometry/readers/grid_build.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

constexpr std::size_t kHeaderLines = 26;  ///< up to the number of lamp sets
constexpr std::size_t kSetLines = 6;
constexpr std::size_t kRatioLines = 10;

struct Line {
  std::string_view text;
  std::size_t number = 0;
};

class Eulumdat {
 public:
  Eulumdat(std::string_view bytes, const std::string& name, const LampReadSettings& settings)
      : name_(name), settings_(settings) {
    FileText text(bytes, name, false);
    while (const auto line = text.next_line()) lines_.push_back({*line, text.line()});
    table_.name = name;
    table_.version = "EULUMDAT";
    table_.type = PhotometricType::kC;
    table_.axis = settings.axis;
    table_.header.format = "EULUMDAT";
    table_.header.units = "millimetres";
  }

  Result<IntensityTable> read();

 private:
  std::string place(std::size_t i) const {
    return name_ + ":" + std::to_string(i < lines_.size() ? lines_[i].number : lines_.size());
  }
  /// A decimal comma is read as a point; counted, and noted at the end.
  std::optional<double> value_at(std::size_t i, std::string* word = nullptr);
  Result<double> number(std::size_t i, const std::string& what);
  Result<std::size_t> count(std::size_t i, const std::string& what, std::size_t min);
  Status read_header();
  Status read_lamp_sets();
  Status find_body();
  bool body_fits(std::size_t begin, std::size_t gamma_count);
  Status read_body();
  void unfold();
  void note_steps();  ///< where the angles are not as far apart as the header says

  std::string name_;
  const LampReadSettings& settings_;
  std::vector<Line> lines_;
  IntensityTable table_;
  std::size_t isym_ = 0, c_count_ = 0, gamma_count_ = 0, plane_count_ = 0, set_count_ = 0;
  double c_step_deg_ = 0.0, gamma_step_deg_ = 0.0, scale_ = 0.0;
  std::size_t body_ = 0, after_flux_ = 0;
  std::size_t decimal_commas_ = 0, first_comma_ = 0;
  std::vector<double> c_deg_, gamma_deg_, planes_;
  std::vector<Column> columns_;
};

std::optional<double> Eulumdat::value_at(std::size_t i, std::string* word) {
  if (i >= lines_.size()) return std::nullopt;
  std::string_view text = lines_[i].text;
  std::string with_point;
  if (const std::size_t comma = text.find(','); comma != std::string_view::npos) {
    with_point = text;
    with_point[comma] = '.';
    text = with_point;
    if (decimal_commas_++ == 0) first_comma_ = lines_[i].number;
  }
  if (word != nullptr) *word = text;
  return parse_number(text);
}

Result<double> Eulumdat::number(std::size_t i, const std::string& what) {
  if (i >= lines_.size()) return Error{place(i), "the file ends where " + what + " is expected"};
  const auto value = value_at(i);
  if (!value) return Error{place(i), what + " is not a finite number: " + in_quotes(lines_[i].text)};
  return *value;
}

Result<std::size_t> Eulumdat::count(std::size_t i, const std::string& what, std::size_t min) {
  const auto value = number(i, what);
  if (!value) return value.error();
  if (*value < static_cast<double>(min) || *value != std::floor(*value) ||
      *value > static_cast<double>(lines_.size())) {
    return Error{place(i), what + " cannot be " + number_text(*value) + " in a file of " +
                               std::to_string(lines_.size()) + " lines"};
  }
  return static_cast<std::size_t>(*value);
}

Status Eulumdat::read_header() {
  if (lines_.size() < kHeaderLines)
    return Error{place(lines_.size()),
                 "ends after " + std::to_string(lines_.size()) + " lines: not EULUMDAT, or cut off"};
  const auto isym = number(2, "the symmetry Isym (3)");
  if (!isym) return isym.error();
  if (*isym < 0.0 || *isym > 4.0 || *isym != std::floor(*isym))
    return Error{place(2), "the symmetry Isym is " + number_text(*isym) + ", not 0 to 4"};
  isym_ = static_cast<std::size_t>(*isym);
  const auto c_count = count(3, "the number of C planes Mc (4)", 1);
  if (!c_count) return c_count.error();
  const auto gamma_count = count(5, "the number of gamma angles Ng (6)", 2);
  if (!gamma_count) return gamma_count.error();
  c_count_ = *c_count;
  gamma_count_ = *gamma_count;
  if ((isym_ == 2 && c_count_ % 2 != 0) || (isym_ > 2 && c_count_ % 4 != 0)) {
    return Error{place(3),
                 std::to_string(c_count_) + " C planes cannot have the symmetry Isym " + std::to_string(isym_)};
  }
  plane_count_ = isym_ == 0 ? c_count_ : isym_ == 1 ? 1 : isym_ == 4 ? c_count_ / 4 + 1 : c_count_ / 2 + 1;
  if (plane_count_ > lines_.size() / gamma_count_) {
    return Error{place(5), std::to_string(plane_count_) + " × " + std::to_string(gamma_count_) +
                               " intensities cannot be in a file of " + std::to_string(lines_.size()) + " lines"};
  }
  c_step_deg_ = value_at(4).value_or(0.0);
  gamma_step_deg_ = value_at(6).value_or(0.0);
  constexpr const char* kSymmetries[] = {"none", "about the axis", "about the plane C0-C180",
                                         "about the plane C90-C270", "quadrant"};
  LampHeader& header = table_.header;
  header.symmetry = kSymmetries[isym_];
  for (const auto& [i, key] :
       {std::pair{0, "MANUFAC"}, {7, "TEST"}, {8, "LUMINAIRE"}, {9, "LUMCAT"}, {11, "ISSUEDATE"}})
    header.keywords.emplace_back(key, lines_[static_cast<std::size_t>(i)].text);
  header.length_m = value_at(15).value_or(0.0) * 1e-3;
  header.width_m = value_at(16).value_or(0.0) * 1e-3;
  header.height_m = value_at(17).value_or(0.0) * 1e-3;  // as seen from C 0
  header.output_ratio = value_at(22).value_or(0.0) * 0.01;
  const auto conversion = number(23, "the conversion factor (24)");
  if (!conversion) return conversion.error();
  if (*conversion <= 0.0)
    return Error{place(23), "the conversion factor is " + number_text(*conversion) + ", not above 0"};
  if (*conversion != 1.0)
    table_.notes.push_back(place(23) + ": intensities multiplied by the conversion factor " + number_text(*conversion));
  header.multiplier = *conversion;
  if (const double tilt = value_at(24).value_or(0.0); tilt != 0.0)
    table_.notes.push_back(place(24) + ": measured with the luminaire tilted by " + number_text(tilt) +
                           " deg (25); angles are read as they stand, of the tilted one");
  return Done{};
}

Status Eulumdat::read_lamp_sets() {
  const auto sets = count(25, "the number of lamp sets (26)", 1);
  if (!sets) return sets.error();
  set_count_ = *sets;
  if (kHeaderLines + 3 > lines_.size() || set_count_ > (lines_.size() - kHeaderLines) / 3)
    return Error{place(25), std::to_string(set_count_) + " lamp sets cannot be in this file"};
  if (settings_.lamp_set < 1 || settings_.lamp_set > set_count_) {
    return Error{place(25), "lamp set " + std::to_string(settings_.lamp_set) + " was asked for, the file has " +
                                std::to_string(set_count_)};
  }
  const std::size_t set = kHeaderLines + kSetLines * (settings_.lamp_set - 1);
  const auto lamps = number(set, "the number of lamps (26a)");
  if (!lamps) return lamps.error();
  const auto flux = number(set + 2, "the total flux of the lamps (26c)");
  if (!flux) return flux.error();
  if (*flux <= 0.0)
    return Error{place(set + 2), "the total flux of the lamps is " + number_text(*flux) +
                                     " lm, so candela per 1000 lm cannot become candela"};
  if (set_count_ > 1) {
    table_.notes.push_back(place(25) + ": " + std::to_string(set_count_) + " lamp sets; set " +
                           std::to_string(settings_.lamp_set) + " with " + number_text(*flux) + " lm used");
  }
  LampHeader& header = table_.header;
  header.lamp_count = std::abs(*lamps);
  header.absolute = *lamps < 0.0;
  header.stated_flux_lm = *flux;
  header.keywords.emplace_back("LAMP", lines_[set + 1].text);
  header.input_w = value_at(set + 5).value_or(0.0);
  scale_ = *flux / 1000.0 * header.multiplier;
  after_flux_ = kHeaderLines + 3;
  return Done{};
}

/// Do C and gamma angles of this count stand here, and after them as many lines as intensities are needed?
bool Eulumdat::body_fits(std::size_t begin, std::size_t gamma_count) {
  if (begin + c_count_ + gamma_count * (1 + plane_count_) > lines_.size()) return false;
  double last = -1.0;
  for (std::size_t i = 0; i < c_count_; ++i) {
    const auto c = value_at(begin + i);
    if (!c || *c <= last || *c > 360.0 || (i == 0 && *c != 0.0)) return false;
    last = *c;
  }
  last = -1.0;
  for (std::size_t i = 0; i < gamma_count; ++i) {
    const auto gamma = value_at(begin + c_count_ + i);
    if (!gamma || *gamma <= last || *gamma > 180.0) return false;
    if (i > 0 && gamma_step_deg_ > 0.0 && std::abs(*gamma - last - gamma_step_deg_) > 1e-6) return false;
    last = *gamma;
  }
  return true;
}

/// Where the C angles begin. Normally after the last lamp set and ten direct ratios.
Status Eulumdat::find_body() {
  while (!lines_.empty() && lines_.back().text.empty()) lines_.pop_back();
  body_ = kHeaderLines + kSetLines * set_count_ + kRatioLines;
  const std::size_t expected = body_ + c_count_ + gamma_count_ * (1 + plane_count_);
  if (lines_.size() >= expected || set_count_ != 1) return Done{};
  // Too short. Perhaps lines before the angles were left out: is there one way to read the rest?
  std::size_t found = 0, begin = 0, gammas = 0;
  for (std::size_t skip = 0; skip <= kSetLines - 3 + kRatioLines; ++skip) {
    const std::size_t at = after_flux_ + skip;
    if (lines_.size() < at + c_count_) break;
    const std::size_t left = lines_.size() - at - c_count_;
    if (left % (1 + plane_count_) != 0) continue;
    const std::size_t count = left / (1 + plane_count_);
    if (count < 2 || gamma_step_deg_ <= 0.0 || !body_fits(at, count)) continue;
    ++found;
    begin = at;
    gammas = count;
  }
  if (found == 1) {
    table_.notes.push_back(place(begin) + ": angles begin here instead of " + std::to_string(body_ - begin) +
                           " lines further down: lines 26d to 35 are incomplete");
    if (gammas != gamma_count_) {
      table_.notes.push_back(place(5) + ": Ng is " + std::to_string(gamma_count_) + ", but " + std::to_string(gammas) +
                             " gamma angles and their intensities stand below; read as these");
    }
    body_ = begin;
    gamma_count_ = gammas;
  }
  return Done{};
}

Status Eulumdat::read_body() {
  std::size_t at = body_;
  const auto read_angles = [&](std::vector<double>& angles, std::size_t count, const std::string& what,
                               double max) -> Status {
    for (std::size_t i = 0; i < count; ++i, ++at) {
      const auto angle = number(at, what + " angle " + std::to_string(i + 1) + " of " + std::to_string(count));
      if (!angle) return angle.error();
      if (*angle < 0.0 || *angle > max)
        return Error{place(at), what + " angle " + number_text(*angle) + " is outside 0 to " + number_text(max)};
      if (!angles.empty() && *angle <= angles.back()) {
        return Error{place(at), what + " angles must increase, but " + number_text(*angle) + " follows " +
                                    number_text(angles.back())};
      }
      angles.push_back(*angle);
    }
    return Done{};
  };
  if (const Status status = read_angles(c_deg_, c_count_, "C", 360.0); !status) return status.error();
  if (c_deg_.front() != 0.0)
    return Error{place(body_), "the C angles begin at " + number_text(c_deg_.front()) + ", not at 0"};
  if (const Status status = read_angles(gamma_deg_, gamma_count_, "gamma", 180.0); !status) return status.error();
  planes_.reserve(plane_count_ * gamma_count_);
  std::string word;
  for (std::size_t i = 0; i < plane_count_ * gamma_count_; ++i, ++at) {
    const auto value = value_at(at, &word);
    if (!value) {
      const std::string what =
          "an intensity (value " + std::to_string(i + 1) + " of " + std::to_string(plane_count_ * gamma_count_) + ")";
      return number(at, what).error();
    }
    if (*value < 0.0) return Error{place(at), "negative intensity " + number_text(*value)};
    planes_.push_back(*value * scale_);
    if (!std::isfinite(planes_.back())) return Error{place(at), "intensity times flux is no finite number"};
    double& smallest = table_.header.smallest_step_cd;
    if (*value != 0.0) smallest = std::min(smallest == 0.0 ? 1e300 : smallest, last_digit(word) * scale_);
  }
  if (at < lines_.size())
    table_.notes.push_back(place(at) + ": " + std::to_string(lines_.size() - at) +
                           " line(s) after the last intensity ignored");
  return Done{};
}

void Eulumdat::note_steps() {
  const auto note = [&](std::size_t line, const char* what, double step_deg, const std::vector<double>& angles) {
    if (!(step_deg > 0.0)) return;
    for (std::size_t i = 1; i < angles.size(); ++i) {
      const double is = angles[i] - angles[i - 1];
      if (std::abs(is - step_deg) <= 1e-6) continue;
      table_.notes.push_back(place(line) + ": " + what + " is " + number_text(step_deg) + " deg, but " +
                             number_text(angles[i]) + " follows " + number_text(angles[i - 1]) +
                             "; the angles themselves count");
      return;
    }
  };
  note(4, "the distance Dc of C planes (5)", c_step_deg_, c_deg_);
  note(6, "the distance Dg of gamma angles (7)", gamma_step_deg_, gamma_deg_);
}

void Eulumdat::unfold() {
  const auto add = [&](double c, std::size_t plane) {
    c = std::fmod(c + 720.0, 360.0);
    columns_.push_back({c, plane});
  };
  const auto c_of = [&](std::size_t plane) { return c_deg_[plane % c_count_]; };
  for (std::size_t k = 0; k < plane_count_; ++k) {
    switch (isym_) {
      case 0:
        if (c_of(k) < 360.0) add(c_of(k), k);
        break;
      case 1:
        add(0.0, 0);
        break;
      case 2:
        add(c_of(k), k);
        add(360.0 - c_of(k), k);
        break;
      case 3:  // stored from C 270 over C 0 to C 90
        add(c_of(k + 3 * c_count_ / 4), k);
        add(180.0 - c_of(k + 3 * c_count_ / 4), k);
        break;
      default:
        for (const double c : {c_of(k), 180.0 - c_of(k), 180.0 + c_of(k), 360.0 - c_of(k)}) add(c, k);
    }
  }
  std::stable_sort(columns_.begin(), columns_.end(),
                   [](const Column& a, const Column& b) { return a.angle_deg < b.angle_deg; });
  columns_.erase(std::unique(columns_.begin(), columns_.end(),
                             [](const Column& a, const Column& b) { return b.angle_deg - a.angle_deg < 1e-9; }),
                 columns_.end());
  columns_.push_back({360.0, columns_.front().plane});
}

Result<IntensityTable> Eulumdat::read() {
  if (const Status status = read_header(); !status) return status.error();
  if (const Status status = read_lamp_sets(); !status) return status.error();
  if (const Status status = find_body(); !status) return status.error();
  if (const Status status = read_body(); !status) return status.error();
  unfold();
  note_steps();
  if (columns_.front().angle_deg != 0.0)
    return Error{place(body_), "no C plane at 0 after the symmetry Isym " + std::to_string(isym_) + " is undone"};
  // Two planes 180° apart are a whole turn; more that end there are half of one.
  if (isym_ == 0 && c_count_ > 2 && 360.0 - c_deg_.back() > 179.0)
    return Error{place(body_ + c_count_ - 1), "the C angles end at " + number_text(c_deg_.back()) +
                                                  " although Isym is 0: the other half is missing (2: it is the same)"};
  if (decimal_commas_ > 0) {
    table_.notes.push_back(name_ + ":" + std::to_string(first_comma_) + ": decimal comma read as a point, " +
                           std::to_string(decimal_commas_) + " time(s)");
  }
  fill_table(table_, columns_, std::move(gamma_deg_), planes_);
  turn_about_axis(table_, settings_.c0_turn_deg);
  return std::move(table_);
}

}  // namespace

Result<IntensityTable> parse_eulumdat(std::string_view text, const std::string& name,
                                      const LampReadSettings& settings) {
  return Eulumdat(text, name, settings).read();
}

}  // namespace phare
