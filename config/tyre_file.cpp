#include "config/tyre_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "config/base/input_files.h"

namespace phare {
namespace {

constexpr std::size_t kLargestTir = 1 << 20;  // such files have some 10 KiB

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

std::string upper(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::toupper(c); });
  return out;
}

// $ and ! begin a comment, but for those between quotes.
std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'') quoted = !quoted;
    if (!quoted && (line[i] == '$' || line[i] == '!')) return line.substr(0, i);
  }
  return line;
}

// Fortran writes 1.0D+05 as well.
bool number_of(std::string_view text, double& value) {
  std::string c(text);
  for (char& letter : c)
    if (letter == 'd' || letter == 'D') letter = 'e';
  const char* begin = c.data() + (c.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, c.data() + c.size(), value);
  return error == std::errc() && end == c.data() + c.size() && std::isfinite(value);
}

struct Unit {
  const char* name;
  double si;
};
constexpr Unit kLengths[] = {{"METER", 1.0}, {"METRE", 1.0}, {"M", 1.0},       {"MM", 1e-3},    {"MILLIMETER", 1e-3},
                             {"CM", 1e-2},   {"KM", 1e3},    {"INCH", 0.0254}, {"FOOT", 0.3048}};
constexpr Unit kForces[] = {{"NEWTON", 1.0},
                            {"N", 1.0},
                            {"KILO_NEWTON", 1e3},
                            {"KN", 1e3},
                            {"POUND_FORCE", 4.4482216152605},
                            {"KILOGRAM_FORCE", 9.80665}};
constexpr Unit kPressures[] = {{"PASCAL", 1.0}, {"PA", 1.0}, {"KPA", 1e3}, {"BAR", 1e5}};
constexpr Unit kTimes[] = {{"SECOND", 1.0}, {"SECONDS", 1.0}, {"SEC", 1.0}, {"S", 1.0}, {"MILLISECOND", 1e-3}};
constexpr Unit kAngles[] = {{"RADIAN", 1.0}, {"RADIANS", 1.0}, {"RAD", 1.0}};  // coefficients have no other

}  // namespace

// Line by line: [SECTION], KEY = value, a table's rows (no '='), comments.
struct TyreFile::Reader {
  TyreFile& file;
  std::string section{};
  bool table = false;  // of points, in a section that has one
  std::map<std::string, std::size_t, std::less<>> line_of{};

  std::string place(std::size_t line) const { return file.file_ + ":" + std::to_string(line); }

  Status take(std::string_view raw, std::size_t number) {
    const std::string_view line = trimmed(without_comment(raw));
    if (line.empty()) return Done{};
    if (line.front() == '[') {
      if (line.back() != ']') return Error{place(number), "a section that does not end with ]"};
      section = upper(trimmed(line.substr(1, line.size() - 2)));
      table = false;
      return Done{};
    }
    if (line.front() == '{') table = true;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
      return table ? Status(Done{}) : Status(Error{place(number), "expected KEY = value, a [SECTION] or a comment"});
    return key(upper(trimmed(line.substr(0, equals))), trimmed(line.substr(equals + 1)), number);
  }

  Status key(std::string name, std::string_view value, std::size_t number) {
    if (name.empty() || section.empty()) return Error{place(number), "expected [SECTION], and KEY = value in it"};
    if (!line_of.emplace(name, number).second)
      return Error{place(number), name + " was there already, in line " + std::to_string(line_of[name])};
    if (value.size() >= 2 && value.front() == '\'' && value.back() == '\'') {
      file.texts_[name] = upper(trimmed(value.substr(1, value.size() - 2)));
      return Done{};
    }
    double read = 0.0;
    if (!number_of(value, read)) return Error{place(number), name + " is no number: " + std::string(value)};
    file.numbers_[name] = {read, number};
    return Done{};
  }

  Status unit(const char* key, std::span<const Unit> known, double& si) {
    const auto found = file.texts_.find(key);
    if (found == file.texts_.end()) return Done{};
    for (const Unit& unit : known)
      if (found->second == unit.name) {
        si = unit.si;
        return Done{};
      }
    std::string names;
    for (const Unit& unit : known) names += std::string(names.empty() ? "" : ", ") + unit.name;
    return Error{place(line_of[key]), std::string(key) + " '" + found->second + "' is not known; there are " + names};
  }

  // Which equations the coefficients are of.
  Status kind() {
    const auto format = file.texts_.find("PROPERTY_FILE_FORMAT");
    const int fit = static_cast<int>(file.value("FITTYP"));
    const std::string named = format == file.texts_.end() ? "" : format->second;
    if (fit == 61 || named == "MF61" || named == "MF_61" || named == "MF-TYRE61")
      file.kind_ = Kind::kMf61;
    else if (fit == 6 || fit == 21 || fit == 52 || named == "MF_05" || named == "MF52" || named == "MF_52")
      file.kind_ = Kind::kMf52;
    else if (named == "PAC2002" || named == "PAC02")
      file.kind_ = Kind::kPac2002;
    else
      return Error{file.file_,
                   "is of no Magic Formula that is read here (PAC2002; 5.2: MF_05, FITTYP 6, 21 or 52; 6.1: "
                   "MF61, FITTYP 61): PROPERTY_FILE_FORMAT '" +
                       named + "', FITTYP " + std::to_string(fit)};
    return Done{};
  }
};

Result<TyreFile> TyreFile::read(const std::filesystem::path& file) {
  const Result<std::string> text = read_input_bytes(file, kLargestTir);
  if (!text) return text.error();
  return parse(*text, input_name(file));
}

Result<TyreFile> TyreFile::parse(std::string_view text, const std::string& name) {
  TyreFile out;
  out.file_ = name;
  Reader reader{out};
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (const Status taken = reader.take(text.substr(0, end), ++number); !taken) return taken.error();
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  double angle = 1.0;
  for (const Status& status :
       {reader.unit("LENGTH", kLengths, out.length_m_), reader.unit("FORCE", kForces, out.force_n_),
        reader.unit("PRESSURE", kPressures, out.pressure_pa_), reader.unit("TIME", kTimes, out.time_s_),
        reader.unit("ANGLE", kAngles, angle), reader.kind()})
    if (!status) return status.error();
  return out;
}

double TyreFile::value(const char* key, double otherwise) const {
  const auto found = numbers_.find(key);
  return found == numbers_.end() ? otherwise : found->second.value;
}

const char* TyreFile::kind_name() const {
  return kind_ == Kind::kPac2002 ? "PAC2002" : kind_ == Kind::kMf52 ? "Magic Formula 5.2" : "Magic Formula 6.1";
}

double TyreFile::nominal_load_n() const {
  return value("FNOMIN") * force_n_ * value("LFZO", 1.0);
}

Result<TyreAtLoad> TyreFile::at_load(double load_n) const {
  for (const char* key :
       {"FNOMIN", "UNLOADED_RADIUS", "VERTICAL_STIFFNESS", "PCX1", "PDX1", "PKX1", "PCY1", "PDY1", "PKY1", "PKY2"}) {
    if (!has(key)) return Error{file_, std::string("has no ") + key};
    if (value(key) == 0.0)
      return Error{file_ + ":" + std::to_string(numbers_.find(key)->second.line), std::string(key) + " is 0"};
  }
  const double nominal = nominal_load_n(), radius = value("UNLOADED_RADIUS") * length_m_;
  if (!(load_n > 0.0 && nominal > 0.0 && radius > 0.0))
    return Error{file_, "load, FNOMIN and UNLOADED_RADIUS must be above 0"};
  const auto c = [&](const char* key, double otherwise = 0.0) { return value(key, otherwise); };
  const bool of_61 = kind_ == Kind::kMf61;
  const double dfz = (load_n - nominal) / nominal;
  // Inflation counts in 6.1 only, and only where both pressures are known.
  const double dpi = of_61 && c("NOMPRES") > 0.0 && has("INFLPRES") ? c("INFLPRES") / c("NOMPRES") - 1.0 : 0.0;
  const auto pressed = [&](const char* first, const char* second) { return 1.0 + (c(first) + c(second) * dpi) * dpi; };

  TyreAtLoad out;
  out.load_n = load_n;
  TyreParams& t = out.tyre;
  t.long_shape = c("PCX1") * c("LCX", 1.0);
  t.long_peak = (c("PDX1") + c("PDX2") * dfz) * pressed("PPX3", "PPX4") * c("LMUX", 1.0);
  t.long_curvature = std::min((c("PEX1") + (c("PEX2") + c("PEX3") * dfz) * dfz) * c("LEX", 1.0), 1.0);
  t.long_stiffness = (c("PKX1") + c("PKX2") * dfz) * std::exp(c("PKX3") * dfz) * pressed("PPX1", "PPX2") *
                     c(of_61 ? "LKXK" : "LKX", c("LKX", 1.0));
  t.lat_shape = c("PCY1") * c("LCY", 1.0);
  t.lat_peak = std::abs((c("PDY1") + c("PDY2") * dfz) * pressed("PPY3", "PPY4")) * c("LMUY", 1.0);
  t.lat_curvature = std::min((c("PEY1") + c("PEY2") * dfz) * c("LEY", 1.0), 1.0);
  const double bent = of_61 ? c("PKY4", 2.0) : 2.0;
  t.lat_stiffness = std::abs(c("PKY1") * nominal * (1.0 + c("PPY1") * dpi) *
                             std::sin(bent * std::atan(load_n / (nominal * c("PKY2") * (1.0 + c("PPY2") * dpi))))) /
                    load_n * c("LKY", 1.0);

  // Combined slip; without coefficients the friction ellipse alone holds the two together.
  const bool combined = has("RBX1") && has("RBY1");
  if (!combined) out.notes.push_back("no coefficients of combined slip: the friction ellipse alone");
  t.long_weight = combined ? c("RBX1") * c("LXAL", 1.0) : 0.0, t.long_weight_fall = combined ? c("RBX2") : 0.0;
  t.long_weight_shape = combined ? c("RCX1", 1.0) : 1.0;
  t.long_weight_curvature = combined ? std::min(c("REX1") + c("REX2") * dfz, 1.0) : 0.0;
  t.lat_weight = combined ? c("RBY1") * c("LYKA", 1.0) : 0.0, t.lat_weight_fall = combined ? c("RBY2") : 0.0;
  t.lat_weight_shape = combined ? c("RCY1", 1.0) : 1.0;
  t.lat_weight_curvature = combined ? std::min(c("REY1") + c("REY2") * dfz, 1.0) : 0.0;

  // Relaxation: 5.2 has lengths, 6.1 has the carcass' stiffness.
  const double rate = c("VERTICAL_STIFFNESS") * force_n_ / length_m_;
  if (!of_61 && has("PTX1") && has("PTY1") && c("PTY2") != 0.0) {
    const double sign = kind_ == Kind::kPac2002 ? 1.0 : -1.0;  // of PTX3, see the header
    const double over = kind_ == Kind::kPac2002 ? nominal : c("FNOMIN") * force_n_;
    t.long_relaxation_m =
        load_n * (c("PTX1") + c("PTX2") * dfz) * std::exp(sign * c("PTX3") * dfz) * radius / over * c("LSGKP", 1.0);
    t.lat_relaxation_m = c("PTY1") * std::sin(2.0 * std::atan(load_n / (c("PTY2") * nominal))) * radius *
                         c("LFZO", 1.0) * c("LSGAL", 1.0);
  } else if (of_61 && c("LONGITUDINAL_STIFFNESS") > 0.0 && c("LATERAL_STIFFNESS") > 0.0) {
    const auto stiff = [&](const char* key, const char* by_load, const char* by_load2, const char* by_pressure) {
      return c(key) * force_n_ / length_m_ * (1.0 + (c(by_load) + c(by_load2) * dfz) * dfz) *
             (1.0 + c(by_pressure) * dpi);
    };
    t.long_relaxation_m = t.long_stiffness * load_n / stiff("LONGITUDINAL_STIFFNESS", "PCFX1", "PCFX2", "PCFX3");
    t.lat_relaxation_m = t.lat_stiffness * load_n / stiff("LATERAL_STIFFNESS", "PCFY1", "PCFY2", "PCFY3");
  } else {
    t.long_relaxation_m = 0.5 * radius, t.lat_relaxation_m = radius;  // chosen, of the size that tyres have
    out.notes.push_back("no relaxation: 0.5 and 1 radius, chosen");
  }

  out.rate_npm = rate * (1.0 + c("PFZ1") * dpi) * c("LCZ", 1.0);
  out.damping_nspm = c("VERTICAL_DAMPING") * force_n_ * time_s_ / length_m_;
  out.loaded_radius_m = radius - load_n / out.rate_npm;
  out.rolling_coefficient = c("QSY1") * c("LMY", 1.0);
  return out;
}

std::vector<std::string> TyreFile::unused() const {
  const std::pair<const char*, std::vector<const char*>> kGroups[] = {
      {"camber",
       {"PDX3", "PDY3", "PEY3", "PEY4", "PEY5", "PKY3", "PKY5", "PKY6", "PKY7", "PHY3", "PVY3", "PVY4", "PPY5", "RBX3",
        "RBY4", "RVY3"}},
      {"shifts (conicity, ply steer)",
       {"PHX1", "PHX2", "PVX1", "PVX2", "PHY1", "PHY2", "PVY1", "PVY2", "RHX1", "RHY1", "RHY2", "RBY3"}},
      {"driving other than braking", {"PEX4"}},
      {"side force by longitudinal slip", {"RVY1", "RVY2", "RVY4", "RVY5", "RVY6"}},
      {"load, but at the one load",
       {"PDX2", "PEX2", "PEX3", "PKX2", "PKX3", "PDY2", "PEY2", "PTX2", "PTX3", "REX2", "REY2", "PCFX1", "PCFX2",
        "PCFY1", "PCFY2"}},
  };
  std::vector<std::string> lines;
  std::vector<std::string> named;
  for (const auto& [what, keys] : kGroups) {
    std::string line;
    for (const char* key : keys)
      if (has(key) && value(key) != 0.0) line += (line.empty() ? "" : ", ") + std::string(key), named.push_back(key);
    if (!line.empty()) lines.push_back(std::string(what) + ": " + line);
  }
  // Whole families: moments (Q…, S…), turn slip (PDXP…), belt, contact patch.
  std::string moments, turning;
  for (const auto& [key, number] : numbers_) {
    if (number.value == 0.0 || key == "QSY1") continue;
    const bool digits = std::isdigit(static_cast<unsigned char>(key.back())) != 0;
    if (digits && (key[0] == 'Q' || key.starts_with("SSZ"))) moments += (moments.empty() ? "" : ", ") + key;
    if (digits &&
        (key.starts_with("PDXP") || key.starts_with("PKYP") || key.starts_with("PDYP") || key.starts_with("PHYP") ||
         key.starts_with("PECP") || key.starts_with("QDTP") || key.starts_with("QCRP") || key.starts_with("QBRP")))
      turning += (turning.empty() ? "" : ", ") + key;
  }
  if (!moments.empty()) lines.push_back("moments, and radius by speed and force: " + moments);
  if (!turning.empty()) lines.push_back("turn slip: " + turning);
  return lines;
}

}  // namespace phare
