// phare lamp info, phare lamp table: what a photometry file is, and what it says in a direction.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "config/base/input_files.h"
#include "config/finite_numbers.h"
#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/point_lists.h"
#include "tools/lamp/print_json.h"
#include "visual/photometry/bench/lamp_aim.h"
#include "visual/photometry/bench/lint.h"
#include "visual/photometry/bench/table_end.h"
#include "visual/photometry/readers/points_file.h"

namespace phare {
namespace {

const char* side_name(CutoffSide side) {
  switch (side) {
    case CutoffSide::kNone:
      return "none";
    case CutoffSide::kFlat:
      return "flat";
    case CutoffSide::kRisesRight:
      return "rises right";
    case CutoffSide::kRisesLeft:
      break;
  }
  return "rises left";
}

/// Nothing here hangs on the side, so none is assumed; who assumes one is named.
std::string traffic_told(const CutoffShape& shape) {
  if (shape.tells_side())
    return std::string(shape.side == CutoffSide::kRisesLeft ? "left" : "right") + "-hand (by the cut-off)";
  return "not told: " + why_no_side(shape) +
         "; assumed where a side is needed: by check the one that the beam does better on, else right-hand";
}

constexpr double kInfoHeight_m = 0.65;  // as `plot` and `hspr` mount it

/// Where the table would end on the road in the driver's picture of a usual car, its cut-off on the line.
std::optional<TableEnd> road_end(const IntensityTable& table, const LampReport& report) {
  const CutoffShape& shape = report.cutoff;
  const double up_deg =
      shape.side == CutoffSide::kNone
          ? 0.0
          : degrees_of_percent(aim_line(LampFunction::kLow, kInfoHeight_m).line_percent) - shape.flat_v_deg;
  const ChannelConfig window;
  return table_end(table, aim_rotation(0.0, glm::radians(up_deg), 0.0), 1.0, {3.45, 0.62, kInfoHeight_m}, {&window, 1});
}

nlohmann::json as_json(const std::string& file, const IntensityTable& table, const LampReport& report) {
  const LampHeader& header = table.header;
  nlohmann::json findings = nlohmann::json::array();
  for (const Finding& f : report.findings)
    findings.push_back({{"grade", grade_name(f.grade)}, {"id", f.id}, {"place", f.place}, {"text", f.text}});
  nlohmann::json keywords = nlohmann::json::array();
  for (const auto& [key, value] : header.keywords) keywords.push_back({key, value});
  const CutoffSide side = report.cutoff.side;
  nlohmann::json json{{"file", file},
                      {"format", header.format},
                      {"version", table.version},
                      {"photometric_type", type_name(table)},
                      {"units", header.units},
                      {"symmetry", header.symmetry},
                      {"absolute", header.absolute},
                      {"multiplier", header.multiplier},
                      {"ballast_factor", header.ballast_factor},
                      {"field_12", header.field_12},
                      {"field_12_applied", header.field_12_applied},
                      {"flux_lm", report.flux_lm},
                      {"stated_flux_lm", header.stated_flux_lm},
                      {"expected_flux_lm", report.expected_flux_lm},
                      {"peak_cd", report.peak_cd},
                      {"peak_h_deg", report.peak.first_deg},
                      {"peak_v_deg", report.peak.second_deg},
                      {"grid",
                       {{"first_count", table.first_deg.size()},
                        {"second_count", table.second_deg.size()},
                        {"first_range_deg", {table.first_deg.front(), table.first_deg.back()}},
                        {"second_range_deg", {table.second_deg.front(), table.second_deg.back()}},
                        {"first_step_at_peak_deg", report.step_h_deg},
                        {"second_step_at_peak_deg", report.step_v_deg},
                        {"smallest_step_cd", header.smallest_step_cd}}},
                      {"cutoff", {{"shape", side_name(side)}, {"form", form_name(report.cutoff.form)}}},
                      {"traffic_source", report.cutoff.tells_side() ? "by the cut-off" : "not told"},
                      {"content_hash", table.content_hash},
                      {"keywords", keywords},
                      {"findings", findings}};
  json["traffic"] =
      report.cutoff.tells_side() ? nlohmann::json(side == CutoffSide::kRisesLeft ? "left" : "right") : nlohmann::json();
  if (const auto end = road_end(table, report)) {
    json["table_end"] = {{"text", end->text()}, {"height_m", kInfoHeight_m}};
    if (end->below) json["table_end"]["v_deg"] = end->v_deg;
    if (end->below) json["table_end"]["nearest_road_m"] = end->nearest_road_m;
  }
  if (side != CutoffSide::kNone) {
    json["cutoff"]["flat_v_deg"] = report.cutoff.flat_v_deg;
    json["cutoff"]["sharpness_g"] = report.cutoff.sharpness_g;
    if (side != CutoffSide::kFlat) {
      json["cutoff"]["kink_h_deg"] = report.cutoff.kink_h_deg;
      json["cutoff"]["rise_deg"] = report.cutoff.rise_deg;
      json["cutoff"]["upper_v_deg"] = report.cutoff.upper_v_deg;
      for (const CutoffStep& step : report.cutoff.steps)
        json["cutoff"]["steps"].push_back(
            {{"foot_h_deg", step.foot_h_deg}, {"head_h_deg", step.head_h_deg}, {"height_deg", step.height_deg}});
    }
  }
  return json;
}

void print(const std::string& file, const IntensityTable& table, const LampReport& report) {
  const LampHeader& header = table.header;
  const bool c = table.type == PhotometricType::kC;
  std::printf("%s\n", input_name(file).c_str());
  std::printf("  version   %s, type %s%s%s\n", table.version.c_str(), type_name(table).c_str(),
              header.absolute ? ", absolute" : ", relative", header.units.empty() ? "" : (", " + header.units).c_str());
  std::printf("  grid      %zu × %zu values, %s %g to %g, %s %g to %g deg; %.3g × %.3g deg at the peak\n",
              table.first_deg.size(), table.second_deg.size(), c ? "C" : "H", table.first_deg.front(),
              table.first_deg.back(), c ? "gamma" : "V", table.second_deg.front(), table.second_deg.back(),
              report.step_h_deg, report.step_v_deg);
  std::printf("  peak      %.6g cd at H %+.2f, V %+.2f deg\n", report.peak_cd, report.peak.first_deg,
              report.peak.second_deg);
  std::printf("  flux      %.1f lm\n", report.flux_lm);
  std::printf("  traffic   %s\n", traffic_told(report.cutoff).c_str());
  std::printf("  hash      %s\n", table.content_hash.c_str());
  if (const auto end = road_end(table, report))
    std::printf("  road      mounted %.2f m high%s: %s\n", kInfoHeight_m,
                report.cutoff.side == CutoffSide::kNone ? "" : ", its cut-off 1 % down", end->text().c_str());
  for (const Finding& f : report.findings)
    std::printf("  %-8s  %s%s%s\n", grade_name(f.grade).c_str(), f.place.c_str(), f.place.empty() ? "" : ": ",
                f.text.c_str());
}

nlohmann::json points_json(const std::string& file, const PointLists& lists) {
  nlohmann::json json{{"file", file}, {"format", "list of points"}, {"beams", nlohmann::json::array()}};
  for (const PointList& list : lists.beams) {
    nlohmann::json points = nlohmann::json::array();
    for (const MeasuredPoint& point : list.points) {
      nlohmann::json one{{"name", point.name}, {"line", point.line}};
      one["at_deg"] = point.at ? nlohmann::json({point.at->h_deg, point.at->v_deg}) : nlohmann::json();
      one["cd"] = point.cd ? nlohmann::json(*point.cd) : nlohmann::json();
      points.push_back(std::move(one));
    }
    json["beams"].push_back({{"beam", list.beam}, {"measured", list.measured()}, {"points", points}});
  }
  return json;
}

void print_points(const std::string& file, const PointLists& lists) {
  std::printf("%s\n  list of measured points, no beam: judged by check, drawn by plot; nothing lies between them\n",
              input_name(file).c_str());
  if (lists.distance_m > 0.0) std::printf("  distance  %g m\n", lists.distance_m);
  for (const PointList& list : lists.beams) {
    std::size_t named = 0;
    double most = 0.0;
    const MeasuredPoint* brightest = nullptr;
    for (const MeasuredPoint& point : list.points) {
      named += point.at ? 0 : 1;
      if (point.cd && *point.cd >= most) most = *point.cd, brightest = &point;
    }
    std::printf("  %s%s%zu points, %zu measured, %zu by a rule's name alone", list.beam.c_str(),
                list.beam.empty() ? "" : ": ", list.points.size(), list.measured(), named);
    if (brightest != nullptr) std::printf("; brightest %.6g cd at %s", most, brightest->name.c_str());
    std::printf("\n");
  }
  for (const std::string& note : lists.notes) std::printf("  info      %s\n", note.c_str());
}

}  // namespace

std::string base_name(const std::string& file) {
  return is_standard_input(file) ? input_name(file) : std::filesystem::path(file).filename().string();
}

int lamp_info(const LampInfoOptions& options) {
  nlohmann::json all = nlohmann::json::array();
  bool bad = false, wrong = false;
  for (const std::string& file : options.files) {
    // A list of points is no beam; what cannot be read at all is told by read_lamp.
    if (const auto points = read_as_points(file, options.settings); points && *points) {
      if (options.json) {
        all.push_back(points_json(file, **points));
      } else {
        print_points(file, **points);
      }
      continue;
    } else if (!points && points.error().place != file) {
      bad_input(points.error());
      bad = true;
      if (options.json)
        all.push_back(
            {{"file", file}, {"error", {{"place", points.error().place}, {"reason", points.error().reason}}}});
      continue;
    }
    const auto table = read_lamp(file, options.settings);
    if (!table) {  // the others are still worth knowing
      bad_input(table.error());
      bad = true;
      if (options.json)
        all.push_back({{"file", file}, {"error", {{"place", table.error().place}, {"reason", table.error().reason}}}});
      continue;
    }
    const LampReport report = lint_lamp(*table);
    wrong = wrong || std::any_of(report.findings.begin(), report.findings.end(),
                                 [](const Finding& finding) { return finding.grade == Grade::kError; });
    if (options.json) {
      all.push_back(as_json(file, *table, report));
    } else {
      print(file, *table, report);
    }
  }
  if (options.json) print_json(all.size() == 1 ? all.front() : all);
  return bad ? kExitBadInput : options.strict && wrong ? kExitCheckFailed : kExitDone;
}

namespace {

/// Of "H,V", degrees.
Result<TableAngles> hv_of(const std::string& word) {
  const auto comma = word.find(',');
  const auto h = finite_number(word.substr(0, comma));
  const auto v = comma == std::string::npos ? std::nullopt : finite_number(word.substr(comma + 1));
  if (!h || !v) return Error{"--hv " + word, "expected H,V, two numbers of degrees, as -3.43,0.57"};
  if (std::abs(*h) > 180.0 || std::abs(*v) > 90.0)
    return Error{"--hv " + word, "H lies within -180 and 180 degrees, V within -90 and 90"};
  return TableAngles{*h, *v};
}

/// The directions asked for in the table's own angles, each row's text as it was given.
Result<AnglesFile> angles_asked_for(const LampTableOptions& options, const IntensityTable& table) {
  if (options.hv.empty() && options.at.empty()) return Error{"", "--at or --hv is required (see --help)"};
  if (options.hv.empty()) return read_angles(options.at);
  AnglesFile angles{.header = "h_deg,v_deg", .rows = {}};
  for (const std::string& word : options.hv) {
    const auto hv = hv_of(word);
    if (!hv) return hv.error();
    const bool screen = table.screen_distance_m > 0.0;  // its rows are H and V already
    angles.rows.push_back({screen ? *hv : table.angles_of(direction_hv(hv->first_deg, hv->second_deg)), word});
  }
  return angles;
}

}  // namespace

int lamp_table(const LampTableOptions& options) {
  const auto table = read_lamp(options.file, options.settings);
  if (!table) return bad_input(table.error());
  const auto angles = angles_asked_for(options, *table);
  if (!angles) return bad_input(angles.error());
  if (!options.out.empty() || !options.json) {
    const Status written = write_intensity(options.out.empty() ? "-" : options.out, *angles, *table);
    if (!written) return bad_input(written.error());
  }
  if (options.json) {
    nlohmann::json json{
        {"file", options.file}, {"photometric_type", type_name(*table)}, {"rows", nlohmann::json::array()}};
    if (!options.out.empty()) json["out"] = options.out;
    for (const AngleRow& row : angles->rows) {
      const TableAngles told = options.hv.empty() ? row.angles : *hv_of(row.text);
      json["rows"].push_back({{"h_deg", told.first_deg},
                              {"v_deg", told.second_deg},
                              {"intensity_cd", intensity_of_row_cd(*table, row.angles)}});
    }
    print_json(json);
  }
  return kExitDone;
}

}  // namespace phare
