// Tyre property files (.tir) with the Magic Formula 5.2 (PAC2002, MF-Tyre 5.2) or 6.1, and the tyre of ours that they
// come to at one load.
//
// Source: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, ch. 4.3.2 (eq. 4.E1 to 4.E78) and app. 3 (6.1); 2nd
//   ed. 2006, ch. 4.3 (5.2); relaxation of 5.2 after the MF-Tyre 5.2 manual, of PAC2002 after Adams/Tire, which has the
//   other sign at PTX3. Units of the file's [UNITS] become SI.
// Leaves out: what a mirror-symmetric tyre of proportional load has not: camber, shifts (conicity, ply steer), moments,
//   side force by longitudinal slip, how coefficients go with load: they are those at one load. unused() names them.
// Tests: tests/vehicle_dynamics/vehicle_import_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "config/vehicle.h"

namespace phare {

/// What a .tir file says of a tyre under one load, at rest and upright.
struct TyreAtLoad {
  TyreParams tyre;                   ///< carcass_damping_nspm is not in such files: left 0
  double load_n = 0.0;               ///< the load that was asked for
  double rate_npm = 0.0;             ///< vertical
  double damping_nspm = 0.0;         ///< vertical
  double loaded_radius_m = 0.0;      ///< under load_n
  double rolling_coefficient = 0.0;  ///< QSY1; 0: the file has none
  std::vector<std::string> notes;    ///< what the file does not say and what stands instead, one line each
};

class TyreFile {
 public:
  enum class Kind { kPac2002, kMf52, kMf61 };

  /// Error with file and line: not a .tir, a number that is none, a key twice, a unit or a formula that is not known.
  static Result<TyreFile> read(const std::filesystem::path& file);
  /// The same from text; `name` stands for the file in messages.
  static Result<TyreFile> parse(std::string_view text, const std::string& name);

  /// "PAC2002", "Magic Formula 5.2", "Magic Formula 6.1".
  const char* kind_name() const;
  double nominal_load_n() const;  ///< FNOMIN times LFZO

  /// Error: a coefficient that cannot be left out is missing.
  Result<TyreAtLoad> at_load(double load_n) const;

  /// Keys of coefficients that are there, not 0, and have no place in at_load(), by what they are: "camber: PDX3,
  /// PDY3".
  std::vector<std::string> unused() const;

 private:
  struct Number {
    double value = 0.0;
    std::size_t line = 0;
  };
  struct Reader;
  double value(const char* key, double otherwise = 0.0) const;
  bool has(const char* key) const { return numbers_.count(key) > 0; }

  std::string file_;
  Kind kind_ = Kind::kPac2002;
  double length_m_ = 1.0, force_n_ = 1.0, pressure_pa_ = 1.0, time_s_ = 1.0;  ///< one of the file's units
  std::map<std::string, Number, std::less<>> numbers_;
  std::map<std::string, std::string, std::less<>> texts_;
};

}  // namespace phare
