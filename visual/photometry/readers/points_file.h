// Points to measure at, and the results: plain CSV with a header line, in and out.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// One line of a points file.
struct PointRow {
  glm::dvec3 position_m{0.0};        ///< world
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit length (the file's may have any length but 0)
  std::string text;                  ///< the line as it stands, further columns included
  std::size_t line = 0;
};

struct PointsFile {
  std::string header;  ///< the header line as it stands
  std::vector<PointRow> rows;
};

/// Reads columns x_m,y_m,z_m,nx,ny,nz, in any order, among any others but those that write_illuminance() adds. Blank
/// lines and lines that begin with # are skipped.
Result<PointsFile> read_points(const std::filesystem::path& path);

/// What hides each lamp from a point, by name; empty: nothing does.
using HiddenBy = std::vector<std::string>;

/// Writes the input's columns and illuminance_lx, illuminance_lx_1 … _n, with 17 significant digits, by
/// write_whole_file. `illuminance` belongs to `points.rows`, row by row, each of `lamps` lamps; a file without a point
/// has all columns too. `hidden`, as long, where shadows were asked for: it adds hidden_by_1 … _n, in double quotes
/// where CSV asks for them.
Status write_illuminance(const std::filesystem::path& path, const PointsFile& points, std::size_t lamps,
                         std::span<const Illuminance> illuminance,
                         const std::optional<std::vector<HiddenBy>>& hidden = std::nullopt);

/// One line of an angles file: columns h_deg,v_deg, the table's own two angles (for type C: C and gamma). A flat screen
/// has no angles of its own: there they are azimuth and elevation, as in type A.
struct AngleRow {
  TableAngles angles;
  std::string text;
};

struct AnglesFile {
  std::string header;
  std::vector<AngleRow> rows;
};

Result<AnglesFile> read_angles(const std::filesystem::path& path);

/// Intensity at the angles of such a line.
double intensity_of_row_cd(const IntensityTable& table, TableAngles angles);

/// Writes the input's columns and intensity_cd at each pair of angles, by write_whole_file.
Status write_intensity(const std::filesystem::path& path, const AnglesFile& angles, const IntensityTable& table);

}  // namespace phare
