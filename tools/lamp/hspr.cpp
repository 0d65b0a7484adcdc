// phare lamp hspr: ranges, widths, flux, glare and points of a left and a right lamp (GTB CE-5815).
#include "visual/photometry/hspr.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/print_json.h"
#include "visual/photometry/cutoff.h"

namespace phare {

int lamp_hspr(const LampHsprOptions& options) {
  const auto left = read_lamp(options.left, options.settings);
  if (!left) return bad_input(left.error());
  const auto right = read_lamp(options.right, options.settings);
  if (!right) return bad_input(right.error());
  std::vector<HsprLamp> lamps{{&*left, -0.5 * options.spacing_m, options.height_m, 0.0},
                              {&*right, 0.5 * options.spacing_m, options.height_m, 0.0}};
  const auto beam = hspr_beam(lamps, options.beam == "low"    ? HsprBeam::kLow
                                     : options.beam == "high" ? HsprBeam::kHigh
                                                              : HsprBeam::kFind);
  if (!beam) return bad_input(beam.error());
  const bool low = *beam == HsprBeam::kLow;
  for (HsprLamp& lamp : lamps) {
    if (options.pitch_given) lamp.aim_up_deg = options.pitch_deg;
  }
  const CutoffShape shape = cutoff_shape(mounted_intensity(*left, glm::dmat3{1.0}));  // tells the side of traffic
  const HsprResult result = low ? hspr_low_beam(lamps) : hspr_high_beam(lamps);
  if (options.json) {
    nlohmann::json rows = nlohmann::json::array();
    for (const HsprRow& row : result.rows) {
      nlohmann::json one{
          {"id", row.id}, {"what", row.what}, {"unit", row.unit}, {"value", row.value}, {"weight", row.weight}};
      if (row.one_point != row.two_points)
        one["points"] = row.points, one["one_point"] = row.one_point, one["two_points"] = row.two_points;
      if (!row.chosen.empty()) one["chosen"] = row.chosen;
      rows.push_back(std::move(one));
    }
    nlohmann::json json{{"beam", low ? "low" : "high"},
                        {"left", options.left},
                        {"right", options.right},
                        {"aim_up_deg", {lamps[0].aim_up_deg, lamps[1].aim_up_deg}},
                        {"height_m", options.height_m},
                        {"spacing_m", options.spacing_m},
                        {"rows", rows},
                        {"scale_worst", result.worst},
                        {"scale_best", result.best}};
    json["traffic_source"] = shape.tells_side() ? "by the cut-off" : "assumed";
    if (result.complete) json["on_scale_01"] = result.on_scale_01;
    if (!result.complete) json["no_points"] = "the one- and two-point values of this beam were not at hand";
    if (result.complete) json["weighted_points"] = result.weighted;
    print_json(json);
    return kExitDone;
  }
  std::printf(
      "HSPR (GTB CE-5815 by the field notes), %s beam, lamps %.2f m high, %.2f m apart, aimed %+.2f and %+.2f deg\n",
      low ? "low" : "high", options.height_m, options.spacing_m, lamps[0].aim_up_deg, lamps[1].aim_up_deg);
  std::printf("right-hand traffic (%s)\n", side_source(shape).c_str());
  std::printf("  %-8s %-58s %12s %8s %8s\n", "row", "what", "value", "points", "weight");
  for (const HsprRow& row : result.rows) {
    char points[16] = "-";
    if (row.one_point != row.two_points) std::snprintf(points, sizeof points, "%.2f", row.points);
    std::printf("  %-8s %-58s %9.2f %-2s %8s %8.2f%s\n", row.id.c_str(), row.what.c_str(), row.value, row.unit.c_str(),
                points, row.weight, row.chosen.empty() ? "" : " *");
  }
  std::set<std::string> chosen;
  for (const HsprRow& row : result.rows) {
    if (!row.chosen.empty() && chosen.insert(row.chosen).second)
      std::printf("  * %s: left open by the notes, chosen here: %s\n", row.id.c_str(), row.chosen.c_str());
  }
  if (result.complete) {
    std::printf("weighted points %.2f: %.0f %% of the way from the method's worst, %.2f, to its best, %.2f\n",
                result.weighted, 100.0 * result.on_scale_01, result.worst, result.best);
  } else {
    std::printf("no total: the one- and two-point values of this beam were not at hand\n");
  }
  return kExitDone;
}

}  // namespace phare
