// A laboratory's report as it comes: intensities at named test points, as a list. No grid and no beam: only what stands
// in it is known. `phare lamp check` judges it, `plot` draws it, `info` tells what it holds.
//
//   Test point;Low beam cd;Remark          columns in any order; parted by commas, semicolons or tabs
//   10U-90U;85;                            a range is a name of a rule's row
//   4D 20L;1 234                           also 45L/7U, 0.86D-3.5R, H-V, HV, 2U-V, 1/2D-1 1/2R
//   B50L;n/a                               names of ECE points; blank, "n/a", "-": not measured
//
// Several beams: a column of candela each, or a column named beam, lamp, sample or function.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/table/direction.h"

namespace phare {

struct MeasuredPoint {
  std::string name;          ///< as it stands, or "H, V" where the list has angles
  std::size_t line = 0;      ///< of the file
  std::optional<HV> at;      ///< none: a name that only a rulebook can place
  std::optional<double> cd;  ///< none: not measured
  double step_cd = 0.0;      ///< of the value's last digit
};

/// One beam of a list.
struct PointList {
  std::string beam;  ///< from its column; empty: the file has one
  std::vector<MeasuredPoint> points;

  std::size_t measured() const;
};

struct PointLists {
  std::string name;  ///< of the file, for messages
  std::vector<PointList> beams;
  double distance_m = 0.0;  ///< of a list in lux
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  ///< "file:line: …": what may have been meant otherwise
};

struct PointListSettings {
  double distance_m = 0.0;  ///< for lux without a distance
  bool mirror_h = false;    ///< left and right turned round
  /// Names without angles that are no mistakes: rows of rulebooks. Empty: every name is.
  std::vector<std::string> known_names;
};

/// "45L/7U" and the like: both angles, one with its letter and the other with its letter, H or V. None: a name.
std::optional<HV> point_of_name(std::string_view name);

/// Names are compared so: capitals without blanks, signs and the word "zone".
std::string plain_name(std::string_view name);

/// The plain name of the point on the other side: 75R and 75L, BR and BL; others as they are.
std::string mirrored_name(std::string_view plain);

/// Does the header name points?
bool names_points(std::string_view bytes, std::string_view name);
/// Do the bytes look like such a list: a header that names points, or angles that fill less than half of a grid?
bool is_point_list(std::string_view bytes, std::string_view name);

/// Errors say file:line.
Result<PointLists> parse_point_lists(std::string_view bytes, const std::string& name,
                                     const PointListSettings& settings);

}  // namespace phare
