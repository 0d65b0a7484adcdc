// phare lamp plot: the views of one beam or a pair, as SVG and PNG.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/views.h"
#include "visual/photometry/beam_image.h"

namespace phare {

int lamp_plot(const LampPlotOptions& options) {
  std::vector<IntensityTable> tables;
  for (const std::string& file : options.files) {
    auto table = read_lamp(file, options.settings);
    if (!table) return bad_input(table.error());
    tables.push_back(std::move(*table));
  }
  if (tables.empty() || tables.size() > 2) return bad_input({"", "one file, or the left and the right lamp's"});
  const IntensityTable& left = tables.front();
  std::error_code code;
  std::filesystem::create_directories(options.out, code);
  if (code) return bad_input({options.out, code.message()});

  // Aim: as given; else as the rule says; else a passing beam by its cut-off, any other as filed.
  std::optional<CheckResult> check;
  double pitch_deg = options.pitch_given ? options.pitch_deg : 0.0;
  std::string aim = options.pitch_given ? "aimed as given" : "as filed";
  if (!options.rule.empty()) {
    const auto rule = find_rulebook(rules_folder(), options.rule);
    if (!rule) return bad_input(rule.error());
    CheckOptions how;
    if (options.pitch_given) how.aim = HV{0.0, pitch_deg};
    const IntensityTable* one[] = {&left};
    check = check_lamp(one, *rule, how);
    pitch_deg = check->aim_up_deg;
    aim = "aimed by " + check->aim_method;
  } else if (!options.pitch_given) {
    const CutoffShape shape = cutoff_shape(mounted_intensity(left, glm::dmat3{1.0}));
    if (shape.side == CutoffSide::kRisesRight || shape.side == CutoffSide::kRisesLeft) {
      pitch_deg = -0.57 - shape.flat_v_deg;
      aim = "cut-off put on 0.57 deg down";
    }
  }
  const double yaw_deg = check ? -check->aim_right_deg : 0.0;
  const IntensityHv intensity =
      mounted_intensity(left, aim_rotation(glm::radians(yaw_deg), glm::radians(pitch_deg), 0.0));
  char facts[200];
  std::snprintf(facts, sizeof facts, "%s, turned %+.2f deg up; peak %.0f cd, %.0f lm", aim.c_str(), pitch_deg,
                left.peak_cd(), left.flux_lm());
  std::string subtitle = facts;
  if (check) {
    subtitle +=
        "; " + check->rule_name + ": " +
        (check->verdict == Verdict::kFail ? "FAIL, " + std::to_string(check->failed) + " rows" : verdict_name(check->verdict));
  }
  const std::string name = left.name;
  std::vector<RoadLamp> pair{{&tables.front(), 0.5 * options.spacing_m, options.height_m, pitch_deg},
                             {&tables.back(), -0.5 * options.spacing_m, options.height_m, pitch_deg}};
  std::snprintf(facts, sizeof facts, "pair at %.2f m height, %.2f m apart, %s (%+.2f deg)", options.height_m,
                options.spacing_m, aim.c_str(), pitch_deg);
  const std::string mounted = facts;
  const bool left_hand = check ? check->left_hand : cutoff_shape(intensity).side == CutoffSide::kRisesLeft;
  const double cut_h = left_hand ? 2.5 : -2.5;
  const CheckResult* rows = check ? &*check : nullptr;

  const std::string folder = options.out + "/";
  const std::vector<std::pair<std::string, std::function<void(Chart&)>>> views{
      {"wall_25m", [&](Chart& c) { draw_wall(c, intensity, name + ": 25 m wall, log candela", subtitle, rows, true); }},
      {"isocandela", [&](Chart& c) { draw_wall(c, intensity, name + ": isocandela", subtitle, rows, false); }},
      {"birds_eye", [&](Chart& c) { draw_road(c, pair, name + ": isolux of the road", mounted); }},
      {"vertical_cut",
       [&](Chart& c) {
         draw_cut(c, intensity, cut_h,
                  name + (left_hand ? ": vertical cut at 2.5 deg R" : ": vertical cut at 2.5 deg L"), subtitle);
       }},
      {"false_colour", [&](Chart& c) { draw_bands(c, intensity, name + ": false colour", subtitle); }}};
  for (const auto& [stem, draw] : views) {
    if (const Status written = write_chart(folder + stem, kPageWidth, kPageHeight, draw); !written)
      return bad_input(written.error());
    std::printf("%s%s.svg, .png\n", folder.c_str(), stem.c_str());
  }
  return kExitDone;
}

}  // namespace phare
