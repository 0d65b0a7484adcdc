#include "config/commonroad.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "config/base/conventions.h"
#include "config/base/input_files.h"
#include "config/vehicle.h"

namespace phare {
namespace {

constexpr std::uintmax_t kLargestYaml = 1 << 20;

std::string place_of(const std::string& file, const YAML::Mark& mark) {
  return mark.line < 0 ? file : file + ":" + std::to_string(mark.line + 1);
}

// One table, and tables in it one deep.
Status take(const std::string& file, const YAML::Node& table, const std::string& before,
            std::map<std::string, double>& numbers) {
  for (const auto& entry : table) {
    if (!entry.first.IsScalar()) return Error{place_of(file, entry.first.Mark()), "a key that is no word"};
    const std::string key = before + entry.first.Scalar();
    if (entry.second.IsMap() && before.empty()) {
      if (const Status inner = take(file, entry.second, key + ".", numbers); !inner) return inner;
      continue;
    }
    double value = 0.0;
    if (!entry.second.IsScalar() || !YAML::convert<double>::decode(entry.second, value) || !std::isfinite(value))
      return Error{place_of(file, entry.first.Mark()), "\"" + key + "\" is no finite number"};
    if (!numbers.emplace(key, value).second)
      return Error{place_of(file, entry.first.Mark()), "\"" + key + "\" was there already"};
  }
  return Done{};
}

// A line of a vehicle file: key, number, where it is from.
class TomlLines {
 public:
  void table(const char* name) { text_ += std::string("\n[") + name + "]\n"; }
  void plain(const std::string& line) { text_ += line + "\n"; }
  void number(const char* key, double value, const std::string& from = {}) {
    char shown[64];
    std::snprintf(shown, sizeof shown, "%.9g", value);
    std::string line = std::string(key) + " = " + shown;
    if (!from.empty()) line += std::string(line.size() < 34 ? 34 - line.size() : 1, ' ') + "# " + from;
    plain(line);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void add_tyre(const TyreParams& t, const std::string& relaxation_from, TomlLines& out) {
  out.table("tyre");
  const std::pair<const char*, double> kLines[] = {{"long_shape", t.long_shape},
                                                   {"long_peak", t.long_peak},
                                                   {"long_curvature", t.long_curvature},
                                                   {"long_stiffness", t.long_stiffness},
                                                   {"lat_shape", t.lat_shape},
                                                   {"lat_peak", t.lat_peak},
                                                   {"lat_curvature", t.lat_curvature},
                                                   {"lat_stiffness", t.lat_stiffness},
                                                   {"long_weight", t.long_weight},
                                                   {"long_weight_fall", t.long_weight_fall},
                                                   {"long_weight_shape", t.long_weight_shape},
                                                   {"long_weight_curvature", t.long_weight_curvature},
                                                   {"lat_weight", t.lat_weight},
                                                   {"lat_weight_fall", t.lat_weight_fall},
                                                   {"lat_weight_shape", t.lat_weight_shape},
                                                   {"lat_weight_curvature", t.lat_weight_curvature}};
  for (const auto& [key, value] : kLines) out.number(key, value);
  out.number("long_relaxation_m", t.long_relaxation_m, relaxation_from);
  out.number("lat_relaxation_m", t.lat_relaxation_m, relaxation_from);
  out.number("carcass_damping_nspm", 10000, "chosen: as the other cars, see docs/dynamics.md");
}

// What the tables say of a tyre, whatever kind of file they come from.
struct TyreRead {
  TyreAtLoad at;
  std::string source, relaxation_from;
  bool whole = false;  // with the radius and the vertical stiffness
};

Result<TyreRead> of_tir(const std::filesystem::path& file, std::optional<double> load_n) {
  const Result<TyreFile> tyre = TyreFile::read(file);
  if (!tyre) return tyre.error();
  Result<TyreAtLoad> at = tyre->at_load(load_n.value_or(tyre->nominal_load_n()));
  if (!at) return at.error();
  TyreRead out{std::move(*at), {}, "the .tir file", true};
  char load[64];
  std::snprintf(load, sizeof load, "%.0f N", out.at.load_n);
  out.source = file.filename().string() + ", " + tyre->kind_name() + ", at " + load;
  for (const std::string& note : out.at.notes)
    if (note.starts_with("no relaxation")) out.relaxation_from = "chosen: the file has none";
  for (const std::string& line : tyre->unused()) out.at.notes.push_back("not used, " + line);
  for (std::string& note : out.at.notes) note = file.string() + ": " + note;
  return out;
}

Result<TyreRead> of_yaml(const std::filesystem::path& file) {
  Result<CommonRoadFile> read = CommonRoadFile::read(file);
  if (!read) return read.error();
  TyreRead out{{},
               file.filename().string() + ", CommonRoad table 7, mirror-symmetric",
               "chosen: the source has none; real tyres 0.1 to 0.6 m",
               false};
  TyreParams& t = out.at.tyre;
  const std::pair<const char*, double*> kKeys[] = {
      {"p_cx1", &t.long_shape},          {"p_dx1", &t.long_peak},         {"p_ex1", &t.long_curvature},
      {"p_kx1", &t.long_stiffness},      {"p_cy1", &t.lat_shape},         {"p_dy1", &t.lat_peak},
      {"p_ey1", &t.lat_curvature},       {"p_ky1", &t.lat_stiffness},     {"r_bx1", &t.long_weight},
      {"r_bx2", &t.long_weight_fall},    {"r_cx1", &t.long_weight_shape}, {"r_ex1", &t.long_weight_curvature},
      {"r_by1", &t.lat_weight},          {"r_by2", &t.lat_weight_fall},   {"r_cy1", &t.lat_weight_shape},
      {"r_ey1", &t.lat_weight_curvature}};
  for (const auto& [key, value] : kKeys) {
    const std::string full = std::string("tire.") + key;
    if (!read->has(full)) return Error{file.string(), "has no \"" + full + "\""};
    *value = read->at(full);
  }
  t.lat_stiffness = std::abs(t.lat_stiffness), t.lat_peak = std::abs(t.lat_peak);  // theirs pushes against the slip
  t.long_relaxation_m = t.lat_relaxation_m = 0.02;
  std::string names;
  for (const std::string& key : read->unused()) names += (names.empty() ? "" : ", ") + key;
  if (!names.empty()) out.at.notes.push_back(file.string() + ": not used, shifts and camber: " + names);
  return out;
}

// Springs and bars of an axle and its tyres in series, N m per radian of roll.
double roll_nmprad(double spring_npm, double track_m, double bar_nmprad, double tyre_npm) {
  const double springs = 0.5 * spring_npm * track_m * track_m + bar_nmprad, tyres = 0.5 * tyre_npm * track_m * track_m;
  return springs * tyres / (springs + tyres);
}

// The pitching mode of the body on springs and tyres in series: frequency and damping ratio, undamped shape.
std::array<double, 2> pitch_mode(const std::array<double, 2>& spring, const std::array<double, 2>& damper,
                                 const std::array<double, 2>& x, double tyre, double kg, double inertia) {
  double k[2][2] = {}, c[2][2] = {};
  for (std::size_t i = 0; i < 2; ++i) {
    const double share = tyre / (spring[i] + tyre), rate = 2.0 * spring[i] * share,
                 damping = 2.0 * damper[i] * share * share;
    const double arm[2] = {1.0, -x[i]};
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t n = 0; n < 2; ++n) k[r][n] += rate * arm[r] * arm[n], c[r][n] += damping * arm[r] * arm[n];
  }
  const double a = k[0][0] / kg, d = k[1][1] / inertia, off2 = k[0][1] * k[0][1] / (kg * inertia);
  // Of the two modes the one that pitches more than it heaves.
  const double w2 = 0.5 * (a + d) + (d >= a ? 0.5 : -0.5) * std::sqrt((a - d) * (a - d) + 4.0 * off2);
  const double heave = k[0][1] == 0.0 ? 0.0 : -k[0][1] / (k[0][0] - w2 * kg);
  const double mass = kg * heave * heave + inertia, damping = c[0][0] * heave * heave + 2.0 * c[0][1] * heave + c[1][1];
  return {std::sqrt(w2) / (2.0 * std::numbers::pi), damping / (2.0 * std::sqrt(w2) * mass)};
}

// The keys that a vehicle file of ours is made of, all of them above 0 but the bars and the shares.
constexpr const char* kNeeded[] = {"m",
                                   "m_s",
                                   "m_uf",
                                   "m_ur",
                                   "a",
                                   "b",
                                   "I_Phi_s",
                                   "I_y_s",
                                   "I_z",
                                   "K_sf",
                                   "K_sr",
                                   "K_sdf",
                                   "K_sdr",
                                   "T_f",
                                   "T_r",
                                   "K_tsf",
                                   "K_tsr",
                                   "K_zt",
                                   "h_s",
                                   "I_y_w",
                                   "R_w",
                                   "T_sb",
                                   "T_se",
                                   "steering.max",
                                   "longitudinal.a_max",
                                   "longitudinal.v_switch"};

std::string toml_of(CommonRoadFile& v, const TyreRead& tyre) {
  constexpr double kSteeringRatio = 16.0;
  const double m = v.at("m"), a = v.at("a"), b = v.at("b"), front_track = v.at("T_f"), rear_track = v.at("T_r");
  const double tyre_npm = tyre.whole ? tyre.at.rate_npm : v.at("K_zt");
  const double front_bar = std::abs(v.at("K_tsf")), rear_bar = std::abs(v.at("K_tsr"));
  const double axles_kg = v.at("m_uf") + v.at("m_ur");
  const std::string of_tyre = tyre.whole ? "the .tir file" : "";
  TomlLines out;
  out.plain("# Made by phare vehicle from " + std::filesystem::path(v.file()).filename().string() +
            " (CommonRoad vehicle models) and " + tyre.source + ".");
  out.plain("# What follows without a word is theirs; the rest says where it is from. Look over what is chosen.");
  out.plain("name = \"" + std::filesystem::path(v.file()).stem().string() + " (CommonRoad)\"");
  out.number("mass_kg", v.at("m_s") + axles_kg, "sprung mass and axles; theirs says " + std::to_string(m));
  out.number("sprung_mass_kg", v.at("m_s"));
  out.number("wheelbase_m", a + b);
  out.number("cg_to_front_m", a);
  out.number("cg_height_m", v.at("h_s"), "of the sprung mass");
  out.number("track_m", 0.5 * (front_track + rear_track), "mean of front and rear");
  out.number("tyre_radius_m", tyre.whole ? tyre.at.loaded_radius_m : v.at("R_w"), of_tyre);
  out.number("wheel_inertia_kgm2", v.at("I_y_w"));

  out.table("suspension");
  out.number("front_rate_npm", v.at("K_sf")), out.number("rear_rate_npm", v.at("K_sr"));
  out.number("tyre_rate_npm", tyre_npm, of_tyre);
  if (tyre.whole) out.number("tyre_damping_nspm", tyre.at.damping_nspm, of_tyre);
  out.number("anti_dive_01", 0.0, "theirs has none");
  out.number("roll_stiffness_nmprad",
             roll_nmprad(v.at("K_sf"), front_track, front_bar, tyre_npm) +
                 roll_nmprad(v.at("K_sr"), rear_track, rear_bar, tyre_npm),
             "springs and bars in series with the tyres");
  const auto [hertz, ratio] = pitch_mode({v.at("K_sf"), v.at("K_sr")}, {v.at("K_sdf"), v.at("K_sdr")}, {a, -b},
                                         tyre_npm, v.at("m_s"), v.at("I_y_s"));
  out.number("ride_frequency_hz", hertz, "pitching mode of the values above");
  out.number("ride_damping", ratio, "the same");
  out.number("front_damping_nspm", v.at("K_sdf")), out.number("rear_damping_nspm", v.at("K_sdr"));
  out.number("front_anti_roll_nmprad", front_bar), out.number("rear_anti_roll_nmprad", rear_bar);
  out.number("bump_travel_m", 0.10, "chosen: the source has no stops");
  out.number("rebound_travel_m", 0.12, "chosen");
  out.number("stop_rate_npm", 10.0 * v.at("K_sf"), "chosen: ten times the spring");

  out.table("steering");
  out.number("ratio", kSteeringRatio, "chosen: the source has road-wheel angles only");
  out.number("max_wheel_deg", v.at("steering.max") * kSteeringRatio * 180.0 / std::numbers::pi,
             "steering.max times the ratio");
  out.number("max_lateral_mps2", 0.83 * tyre.at.tyre.lat_peak * kGravity_mps2, "chosen: 0.83 of the tyre's peak");
  out.number("ackermann_01", 0.0, "theirs steers both wheels alike");

  out.table("drive");
  const double a_max = v.at("longitudinal.a_max");
  out.number("max_force_n", m * a_max, "their limit a_max times the mass");
  out.number("max_power_kw", 1e-3 * m * a_max * v.at("longitudinal.v_switch"),
             "theirs falls as v_switch / v: constant power");
  out.number("max_brake_n", m * a_max, "a_max times the mass");
  out.number("drag_area_m2", 0.65, "chosen: 0.30 x 2.15 m2");
  out.number("rolling_coefficient", tyre.at.rolling_coefficient > 0.0 ? tyre.at.rolling_coefficient : 0.012,
             tyre.at.rolling_coefficient > 0.0 ? "QSY1 of the .tir file" : "chosen: passenger car tyre on asphalt");
  out.number("brake_front_01", v.at("T_sb")), out.number("drive_front_01", v.at("T_se"));

  out.table("body");
  out.number("roll_inertia_kgm2", v.at("I_Phi_s")), out.number("pitch_inertia_kgm2", v.at("I_y_s"));
  out.number("yaw_inertia_kgm2", v.at("I_z"));
  out.number("front_axle_kg", v.at("m_uf")), out.number("rear_axle_kg", v.at("m_ur"));
  out.number("front_track_m", front_track), out.number("rear_track_m", rear_track);
  add_tyre(tyre.at.tyre, tyre.relaxation_from, out);

  out.table("levelling");
  out.plain("system = \"wheel\"                  # chosen; \"static\" and \"dynamic\" move by themselves");
  out.number("lamp_x_m", b + a + 0.6, "chosen: 0.6 m before the front axle");
  out.number("lamp_height_m", 0.65, "chosen");
  out.number("aim_percent", -1.0, "UN R48 6.2.6.1");
  out.number("manual_step_percent", 0.5, "chosen: four steps of the wheel");
  out.number("range_deg", 1.5, "chosen"), out.number("rate_degps", 5.0, "chosen"),
      out.number("filter_s", 0.3, "chosen");
  return out.take();
}

bool is_tir(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return kind == ".tir";
}

}  // namespace

Result<CommonRoadFile> CommonRoadFile::read(const std::filesystem::path& file) {
  const Result<std::string> text = read_input_bytes(file, kLargestYaml);
  if (!text) return text.error();
  CommonRoadFile out;
  out.file_ = input_name(file);
  try {
    const YAML::Node root = YAML::Load(*text);
    if (!root.IsMap()) return Error{out.file_, "holds no keys with numbers"};
    if (const Status taken = take(out.file_, root, "", out.numbers_); !taken) return taken.error();
  } catch (const YAML::Exception& wrong) {
    return Error{place_of(out.file_, wrong.mark), wrong.msg};
  }
  return out;
}

double CommonRoadFile::at(const std::string& key) {
  used_.insert(key);
  const auto found = numbers_.find(key);
  return found == numbers_.end() ? 0.0 : found->second;
}

std::vector<std::string> CommonRoadFile::unused() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : numbers_)
    if (value != 0.0 && !used_.count(key)) keys.push_back(key);
  return keys;
}

Result<VehicleText> vehicle_of_commonroad(const std::filesystem::path& vehicle, const std::filesystem::path& tyre,
                                          std::optional<double> load_n) {
  Result<CommonRoadFile> read = CommonRoadFile::read(vehicle);
  if (!read) return read.error();
  for (const char* key : kNeeded)
    if (!read->has(key)) return Error{vehicle.string(), std::string("has no \"") + key + "\""};
  const double quarter_n = 0.25 * read->at("m") * kGravity_mps2;
  const Result<TyreRead> tyres = is_tir(tyre) ? of_tir(tyre, load_n.value_or(quarter_n)) : of_yaml(tyre);
  if (!tyres) return tyres.error();
  VehicleText out;
  out.toml = toml_of(*read, *tyres);
  std::string names;
  for (const std::string& key : read->unused()) names += (names.empty() ? "" : ", ") + key;
  if (!names.empty()) out.notes.push_back(vehicle.string() + ": not used: " + names);
  out.notes.insert(out.notes.end(), tyres->at.notes.begin(), tyres->at.notes.end());
  if (const Result<VehicleParams> good = parse_vehicle(out.toml, vehicle.string() + " as a vehicle file"); !good)
    return good.error();
  return out;
}

Result<VehicleText> tyre_table(const std::filesystem::path& tyre, std::optional<double> load_n) {
  const Result<TyreRead> read = of_tir(tyre, load_n);
  if (!read) return read.error();
  TomlLines out;
  out.plain("# Made by phare vehicle from " + read->source + ".");
  char text[160];
  std::snprintf(
      text, sizeof text,
      "# For the tables above it: tyre_radius_m = %.4f; [suspension] tyre_rate_npm = %.0f, tyre_damping_nspm = %.0f",
      read->at.loaded_radius_m, read->at.rate_npm, read->at.damping_nspm);
  out.plain(text);
  add_tyre(read->at.tyre, read->relaxation_from, out);
  return VehicleText{out.take(), read->at.notes};
}

}  // namespace phare
