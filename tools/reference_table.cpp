#include "tools/reference_table.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "config/base/input_files.h"
#include "tools/csv_columns.h"

namespace phare {
namespace {

using nlohmann::json;
constexpr double kRadPerDeg = std::numbers::pi / 180.0;

glm::dvec3 vector_of(const json& xyz) {
  return {xyz.at(0).get<double>(), xyz.at(1).get<double>(), xyz.at(2).get<double>()};
}

/// How a file of the set is read. A type C table is read with its axis and with its plane C 0 where the frame has it;
/// one that counts C clockwise is read as the mirror image that it is. A frame that no setting reaches is an error.
SourceConfig source_of(const json& file, const std::filesystem::path& folder) {
  SourceConfig source;
  source.file = folder / file.at("file").get<std::string>();
  if (!file.contains("frame_in_lamp_axes")) return source;
  const json& frame = file.at("frame_in_lamp_axes");
  const glm::dvec3 c0 = vector_of(frame.at("c0")), g0 = vector_of(frame.at("g0"));
  const glm::dvec3 c90 = frame.contains("c90") ? vector_of(frame.at("c90")) : glm::cross(c0, g0);
  const auto along = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, b) > 1.0 - 1e-9; };
  const bool down = along(g0, {0, 0, -1});
  source.mirror = along(c90, -glm::cross(c0, g0));
  if ((!down && !along(g0, {1, 0, 0})) || (!source.mirror && !along(c90, glm::cross(c0, g0))))
    throw std::invalid_argument(source.file.filename().string() + ": no axis and c0 give this frame");
  source.axis = down ? GammaAxis::kGamma90 : GammaAxis::kGamma0;
  // C 0 as an angle of ours: gamma 0 ahead has 0 right and 90 up; gamma 90 ahead has 0 ahead and 90 left.
  const double c0_deg = (down ? std::atan2(c0.y, c0.x) : std::atan2(c0.z, -c0.y)) / kRadPerDeg;
  // The reader turns first and mirrors then: gamma0 C to 180 - C, gamma90 C to -C.
  source.c0_turn_deg = !source.mirror ? c0_deg : down ? -c0_deg : 180.0 - c0_deg;
  return source;
}

/// Both lamps of a beam with one of the set's files.
std::vector<LampConfig> mounted(const json& manifest, const std::string& beam, const std::string& key,
                                const std::filesystem::path& folder) {
  std::vector<LampConfig> lamps;
  for (const json& mount : manifest.at("mounting").at(beam)) {
    LampConfig lamp;
    lamp.name = beam + " " + mount.at("name").get<std::string>();
    lamp.position_m = vector_of(mount.at("position_m"));
    SourceConfig source = source_of(manifest.at("files").at(key), folder);
    source.yaw_rad = mount.at("yaw_deg").get<double>() * kRadPerDeg;
    source.pitch_rad = mount.at("pitch_deg").get<double>() * kRadPerDeg;
    source.roll_rad = mount.at("roll_deg").get<double>() * kRadPerDeg;
    lamp.sources.push_back(source);
    lamps.push_back(std::move(lamp));
  }
  return lamps;
}

std::vector<PointRow> points_of(const std::vector<std::vector<double>>& xyz, const glm::dvec3& normal) {
  std::vector<PointRow> points(xyz[0].size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].position_m = {xyz[0][i], xyz[1][i], xyz[2][i]};
    points[i].normal = normal;
    points[i].line = i + 2;
  }
  return points;
}

/// Road and wall: a column for each format of the beam.
Result<std::vector<ReferenceCase>> plane_cases(const std::filesystem::path& table, const json& manifest,
                                               const std::string& beam, bool wall) {
  const std::vector<std::string> axes = wall ? std::vector<std::string>{"y", "z"} : std::vector<std::string>{"x", "y"};
  auto plane = read_csv_columns(table, axes);
  if (!plane) return plane.error();
  const std::vector<double> fixed(plane->front().size(), wall ? manifest.at("wall_x_m").get<double>() : 0.0);
  const auto points = wall ? points_of({fixed, (*plane)[0], (*plane)[1]}, {-1.0, 0.0, 0.0})
                           : points_of({(*plane)[0], (*plane)[1], fixed}, {0.0, 0.0, 1.0});
  const std::string primary = manifest.at("primary_file_per_beam").at(beam);
  std::vector<ReferenceCase> cases;
  for (const auto& [key, file] : manifest.at("files").items()) {
    const std::string column = key == primary ? "E" : "E[" + key + "]";
    if (file.value("beam", "") != beam) continue;
    const auto expected = read_csv_columns(table, std::vector<std::string>{column});
    if (!expected) return expected.error();
    cases.push_back({column, mounted(manifest, beam, key, table.parent_path()), points, expected->front()});
  }
  return cases;
}

Result<std::vector<ReferenceCase>> plate_cases(const std::filesystem::path& table, const json& manifest) {
  const auto columns = read_csv_columns(table, std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz", "E"});
  if (!columns) return columns.error();
  ReferenceCase plates{"E", {}, points_of(*columns, {}), (*columns)[6]};
  for (std::size_t i = 0; i < plates.points.size(); ++i)
    plates.points[i].normal = {(*columns)[3][i], (*columns)[4][i], (*columns)[5][i]};
  for (const char* beam : {"low", "high"}) {
    const std::string key = manifest.at("primary_file_per_beam").at(beam);
    for (LampConfig& lamp : mounted(manifest, beam, key, table.parent_path())) plates.lamps.push_back(std::move(lamp));
  }
  return std::vector<ReferenceCase>{plates};
}

/// Candela in a direction is lux at 1 m on a plate that faces the lamp. The file's key stands in the first column.
Result<std::vector<ReferenceCase>> intensity_cases(const std::filesystem::path& table, const json& manifest) {
  const auto columns = read_csv_columns(table, std::vector<std::string>{"dx", "dy", "dz", "I_cd"});
  if (!columns) return columns.error();
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);
  std::vector<ReferenceCase> cases;
  for (std::size_t i = 0; i < columns->front().size() && std::getline(stream, line); ++i) {
    const std::string key = line.substr(0, line.find(','));
    if (cases.empty() || cases.back().column != key) {
      LampConfig lamp;
      lamp.name = key;
      lamp.sources.push_back(source_of(manifest.at("files").at(key), table.parent_path()));
      cases.push_back({key, {lamp}, {}, {}});
    }
    const glm::dvec3 direction{(*columns)[0][i], (*columns)[1][i], (*columns)[2][i]};
    PointRow point;
    point.position_m = direction;
    point.normal = -direction;
    point.line = i + 2;
    cases.back().points.push_back(point);
    cases.back().expected_lx.push_back((*columns)[3][i]);
  }
  return cases;
}

/// Single lamps where light is hard to compute: grazing, close, far, behind, at nodes, seams and cut-offs, far from 0.
Result<std::vector<ReferenceCase>> hard_cases(const std::filesystem::path& table, const json& manifest) {
  const std::vector<std::string> names{"lx", "ly", "lz", "yaw", "pitch", "roll", "px",
                                       "py", "pz", "nx", "ny",  "nz",    "E_lx"};
  const auto columns = read_csv_columns(table, names);
  if (!columns) return columns.error();
  const auto vector = [&](std::size_t first, std::size_t row) {
    return glm::dvec3{(*columns)[first][row], (*columns)[first + 1][row], (*columns)[first + 2][row]};
  };
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);
  std::vector<ReferenceCase> cases;
  for (std::size_t i = 0; i < columns->front().size() && std::getline(stream, line); ++i) {
    const std::size_t comma = line.find(',') + 1;
    LampConfig lamp;
    lamp.name = line.substr(comma, line.find(',', comma) - comma);
    lamp.position_m = vector(0, i);
    SourceConfig source = source_of(manifest.at("files").at(lamp.name), table.parent_path());
    const glm::dvec3 turns = vector(3, i) * kRadPerDeg;
    source.yaw_rad = turns.x, source.pitch_rad = turns.y, source.roll_rad = turns.z;
    lamp.sources.push_back(source);
    auto same = std::ranges::find_if(cases, [&](const ReferenceCase& one) { return one.lamps.front() == lamp; });
    if (same == cases.end()) same = cases.insert(same, {lamp.name, {lamp}, {}, {}, 0.0});
    PointRow point;
    point.position_m = vector(6, i);
    point.normal = vector(9, i);
    point.line = i + 2;
    same->points.push_back(point);
    same->expected_lx.push_back((*columns)[12][i]);
  }
  return cases;
}

std::optional<std::string> after(const std::string& text, const std::string& begin) {
  if (!text.starts_with(begin)) return std::nullopt;
  return text.substr(begin.size());
}

}  // namespace

Result<std::vector<ReferenceCase>> read_reference_table(const std::filesystem::path& given) {
  const std::filesystem::path table = std::filesystem::absolute(given).lexically_normal();
  const std::filesystem::path manifest_file = table.parent_path() / "manifest.json";
  if (const std::string why = why_no_file(table); !why.empty()) return Error{table.string(), why};
  std::ifstream stream(manifest_file);
  if (!stream) return Error{manifest_file.string(), "no such file; it tells the lamps of " + table.filename().string()};
  const std::string name = table.stem().string();
  try {
    const json manifest = json::parse(stream);
    if (name == "0_intensity") return intensity_cases(table, manifest);
    if (name == "j_hard") return hard_cases(table, manifest);
    if (name == "c_plates") return plate_cases(table, manifest);
    if (const auto beam = after(name, "a_road_flat_")) return plane_cases(table, manifest, *beam, false);
    if (const auto beam = after(name, "b_wall25_")) return plane_cases(table, manifest, *beam, true);
  } catch (const json::exception& wrong) {
    return Error{manifest_file.string(), wrong.what()};
  } catch (const std::invalid_argument& wrong) {
    return Error{manifest_file.string(), wrong.what()};
  }
  return Error{table.string(), "is none of 0_intensity, a_road_flat_<beam>, b_wall25_<beam>, c_plates, j_hard"};
}

ReferenceErrors compare(const ReferenceCase& expected, const std::vector<double>& measured_lx) {
  ReferenceErrors errors;
  for (std::size_t i = 0; i < expected.expected_lx.size(); ++i) {
    const double wanted_lx = expected.expected_lx[i], error_lx = std::abs(measured_lx[i] - wanted_lx);
    errors.worst_absolute_lx = std::max(errors.worst_absolute_lx, error_lx);
    errors.highest_lx = std::max(errors.highest_lx, wanted_lx);
    const bool dark = wanted_lx == 0.0 && expected.dim_lx == 0.0;
    if (!(wanted_lx > expected.dim_lx) && !dark) continue;
    ++errors.judged;
    const bool nothing = expected.dim_lx == 0.0 && error_lx <= ReferenceErrors::kDark_lx;
    const double relative = nothing ? 0.0 : error_lx / wanted_lx;  // of what has to be dark: without bound
    if (relative <= errors.worst_relative && errors.worst_line != 0) continue;
    errors.worst_relative = relative;
    errors.worst_line = expected.points[i].line;
  }
  return errors;
}

}  // namespace phare
