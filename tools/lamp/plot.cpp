// phare lamp plot: the views of one beam or a pair, as SVG and PNG.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/plot_points.h"
#include "tools/lamp/point_lists.h"
#include "tools/lamp/print_json.h"
#include "tools/lamp/views.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

/// A lamp with its aim. The table stays where it is.
struct AimedLamp {
  const IntensityTable* table = nullptr;
  std::string file;
  std::string aim = "as filed";  ///< in words
  double up_deg = 0.0, right_deg = 0.0;
  CutoffShape shape;                 ///< as filed
  std::optional<CheckResult> check;  ///< of this lamp alone

  IntensityHv intensity() const {
    return mounted_intensity(*table, aim_rotation(-glm::radians(right_deg), glm::radians(up_deg), 0.0));
  }
};

std::string aim_words(const std::string& method) {
  if (method.ends_with("as filed")) return method;  // there may be no cut-off to aim by
  return method == "given" ? "aimed as given" : "aimed by " + method;
}

CheckOptions how_to_check(const LampPlotOptions& options) {
  CheckOptions how;
  if (options.pitch_given) how.aim = HV{0.0, options.pitch_deg};
  return how;
}

/// As given; else as the rule says; else a passing beam by its cut-off, any other as filed.
AimedLamp aim_lamp(const std::string& file, const IntensityTable& table, const Rulebook* rule,
                   const LampPlotOptions& options) {
  AimedLamp lamp;
  lamp.table = &table;
  lamp.file = file;
  lamp.shape = cutoff_shape(mounted_intensity(table, glm::dmat3{1.0}));
  if (rule != nullptr) {
    const IntensityTable* one[] = {&table};
    lamp.check = check_lamp(one, *rule, how_to_check(options));
    lamp.up_deg = lamp.check->aim_up_deg;
    lamp.right_deg = lamp.check->aim_right_deg;
    lamp.aim = aim_words(lamp.check->aim_method);
  } else if (options.pitch_given) {
    lamp.up_deg = options.pitch_deg;
    lamp.aim = "aimed as given";
  } else if (lamp.shape.side == CutoffSide::kRisesRight || lamp.shape.side == CutoffSide::kRisesLeft) {
    lamp.up_deg = -0.57 - lamp.shape.flat_v_deg;
    lamp.aim = "cut-off put on 0.57 deg down";
  }
  return lamp;
}

std::string aim_text(const AimedLamp& lamp) {
  char text[160];
  std::snprintf(text, sizeof text, "%s, turned %+.2f deg up", lamp.aim.c_str(), lamp.up_deg);
  std::string words = text;
  if (std::abs(lamp.right_deg) >= 0.005) {
    std::snprintf(text, sizeof text, ", %+.2f deg right", lamp.right_deg);
    words += text;
  }
  return words;
}

std::string verdict_text(const CheckResult& check) {
  std::string text = check.rule_name + (check.left_hand ? ", rows mirrored: " : ": ");
  if (check.verdict == RuleVerdict::kFail) {
    text += "FAIL, " + std::to_string(check.failed) + " of " + std::to_string(check.rows.size()) + " rows";
  } else {
    text += check.verdict == RuleVerdict::kPass ? "pass" : "undecided";
  }
  if (check.within_resolution > 0)
    text += ", " + std::to_string(check.within_resolution) + " within the file's resolution";
  if (check.no_data > 0) text += ", " + std::to_string(check.no_data) + " without data";
  return text;
}

/// What is drawn on the wall: one lamp, or half the sum of two.
struct WallBeam {
  std::string suffix;  ///< of the files' names
  std::string name, subtitle;
  IntensityHv intensity;
  const CheckResult* check = nullptr;
  bool left_hand = false;
  std::string traffic;  ///< how the side of traffic is known: "by the cut-off", "assumed: …"
};

WallBeam wall_beam(const AimedLamp& lamp, std::string suffix) {
  char facts[80];
  std::snprintf(facts, sizeof facts, "; peak %.0f cd, %.0f lm", lamp.table->peak_cd(), lamp.table->flux_lm());
  WallBeam beam{std::move(suffix),      lamp.table->name, aim_text(lamp) + facts,
                lamp.intensity(),       nullptr,          lamp.shape.side == CutoffSide::kRisesLeft,
                side_source(lamp.shape)};
  if (lamp.check) {
    beam.check = &*lamp.check;
    beam.subtitle += "; " + verdict_text(*lamp.check);
    beam.left_hand = lamp.check->left_hand;
  }
  if (!lamp.shape.tells_side())
    beam.subtitle += std::string("; ") + (beam.left_hand ? "left" : "right") + "-hand traffic assumed";
  return beam;
}

SharpnessLimits sharpness_limits(const Rulebook* rule, const CutoffShape& shape) {
  if (rule != nullptr) {
    if (rule->cutoff_aims.empty()) return {};
    const CutoffAim& aim = rule->cutoff_aims.front();
    return {aim.sharpness_min, aim.sharpness_max, rule->name};
  }
  const bool kinked = shape.side == CutoffSide::kRisesRight || shape.side == CutoffSide::kRisesLeft;
  return kinked ? SharpnessLimits{0.13, 0.40, "UN R149 passing beams"} : SharpnessLimits{};
}

}  // namespace

int lamp_plot(const LampPlotOptions& options) {
  if (options.files.empty() || options.files.size() > 2)
    return bad_input({"", "one file, or the left and the right lamp's"});
  std::vector<IntensityTable> tables;
  for (const std::string& file : options.files) {
    auto points = read_as_points(file, options.settings);
    if (!points) return bad_input(points.error());
    if (*points && options.files.size() > 1)
      return bad_input({file, "is a list of points: drawn by itself, not as one of a pair"});
    if (*points) return plot_points(options, **points);
    if (!options.beam.empty()) return bad_input({"--beam", "is for lists of points; " + file + " is none"});
    auto table = read_lamp(file, options.settings);
    if (!table) return bad_input(table.error());
    tables.push_back(std::move(*table));
  }
  std::optional<Rulebook> rule;
  if (!options.rule.empty()) {
    auto found = find_rulebook(rules_folder(), options.rule);
    if (!found) return bad_input(found.error());
    rule = std::move(*found);
  }
  const Rulebook* const judged_by = rule ? &*rule : nullptr;
  std::error_code code;
  std::filesystem::create_directories(options.out, code);
  if (code) return bad_input({options.out, code.message()});

  std::vector<AimedLamp> lamps;
  for (std::size_t i = 0; i < tables.size(); ++i)
    lamps.push_back(aim_lamp(options.files[i], tables[i], judged_by, options));
  const AimedLamp &left = lamps.front(), &right = lamps.back();

  std::vector<WallBeam> walls;
  std::optional<CheckResult> both;
  if (lamps.size() == 1) {
    walls.push_back(wall_beam(left, ""));
  } else if (rule && rule->half_sum) {
    const IntensityTable* pair[] = {left.table, right.table};
    if (const Status same = same_traffic(pair); !same) return bad_input(same.error());
    both = check_lamp(pair, *rule, how_to_check(options));
    for (std::size_t i = 0; i < lamps.size(); ++i) {  // drawn as judged
      lamps[i].up_deg = both->lamps[i].up_deg;
      lamps[i].right_deg = both->lamps[i].right_deg;
    }
    const IntensityHv of_left = left.intensity(), of_right = right.intensity();
    IntensityHv half = [of_left, of_right](double h, double v) { return 0.5 * (of_left(h, v) + of_right(h, v)); };
    half.evidence = [of_left, of_right](double h, double v) {  // as far as both reach
      return std::max(of_left.evidence(h, v), of_right.evidence(h, v));
    };
    walls.push_back({"", "half the sum of " + left.table->name + " and " + right.table->name,
                     "left " + aim_text(left) + "; right " + aim_text(right) + "; " + verdict_text(*both),
                     std::move(half), &*both, both->left_hand, side_source(both->shape)});
  } else {
    walls.push_back(wall_beam(left, "_left"));
    walls.push_back(wall_beam(right, "_right"));
  }

  // Both lamps by themselves, at their own aim.
  std::vector<RoadLamp> on_car{
      {left.table, 0.5 * options.spacing_m, options.height_m, left.up_deg, -left.right_deg},
      {right.table, -0.5 * options.spacing_m, options.height_m, right.up_deg, -right.right_deg}};
  char facts[120];
  std::snprintf(facts, sizeof facts, "pair at %.2f m height, %.2f m apart; ", options.height_m, options.spacing_m);
  const bool left_hand = walls.front().left_hand || walls.back().left_hand;
  const std::string mounted =
      facts + (lamps.size() == 1 ? aim_text(left) : "left " + aim_text(left) + "; right " + aim_text(right));
  // Lanes lie as the side of traffic has them.
  const std::string on_road = mounted + (left.shape.tells_side() || right.shape.tells_side() ? ""
                                         : left_hand ? "; left-hand traffic assumed"
                                                     : "; right-hand traffic assumed");
  const std::string names =
      lamps.size() == 1 ? left.table->name : left.table->name + " (left), " + right.table->name + " (right)";
  const SharpnessLimits limits = sharpness_limits(judged_by, left.shape);

  std::vector<std::pair<std::string, std::function<void(Chart&)>>> views;
  const auto add = [&](const std::string& view, const std::string& suffix, std::function<void(Chart&)> draw) {
    const bool asked =
        options.views.empty() || std::find(options.views.begin(), options.views.end(), view) != options.views.end();
    if (asked) views.emplace_back(view + suffix, std::move(draw));
  };
  for (const WallBeam& beam : walls) {
    const double cut_h = beam.left_hand ? 2.5 : -2.5;
    add("wall_25m", beam.suffix, [&beam](Chart& c) {
      draw_wall(c, beam.intensity, beam.name + ": 25 m wall, log candela", beam.subtitle, beam.check, true);
    });
    add("isocandela", beam.suffix, [&beam](Chart& c) {
      draw_wall(c, beam.intensity, beam.name + ": isocandela", beam.subtitle, beam.check, false);
    });
    add("vertical_cut", beam.suffix, [&beam, &limits, cut_h](Chart& c) {
      draw_cut(c, beam.intensity, cut_h, limits,
               beam.name + (cut_h > 0.0 ? ": vertical cut at 2.5 deg R" : ": vertical cut at 2.5 deg L"),
               beam.subtitle);
    });
    add("false_colour", beam.suffix,
        [&beam](Chart& c) { draw_bands(c, beam.intensity, beam.name + ": false colour", beam.subtitle); });
  }
  add("birds_eye", "", [&](Chart& c) { draw_road(c, on_car, left_hand, names + ": isolux of the road", on_road); });

  const RoadExtent extent = road_extent(on_car, true);
  const bool told = left.shape.tells_side() || right.shape.tells_side();
  const std::string traffic = told ? "by the cut-off" : side_source(left.shape);
  nlohmann::json json{
      {"traffic", left_hand ? "left" : "right"}, {"traffic_source", told ? "by the cut-off" : "assumed"},
      {"lane_lines_m", lane_lines_m(left_hand)}, {"road_ahead_m", extent.ahead_m},
      {"road_aside_m", extent.aside_m},          {"road_goes_on", extent.clipped}};
  for (const AimedLamp& lamp : lamps) {
    json["lamps"].push_back({{"file", lamp.file},
                             {"cutoff_form", form_name(lamp.shape.form)},
                             {"aim", lamp.aim},
                             {"turned_up_deg", lamp.up_deg},
                             {"turned_right_deg", lamp.right_deg},
                             {"peak_cd", lamp.table->peak_cd()},
                             {"flux_lm", lamp.table->flux_lm()}});
  }
  for (const WallBeam& beam : walls) {
    if (beam.check == nullptr) continue;
    json["checks"].push_back({{"beam", beam.name},
                              {"rule", beam.check->rule_id},
                              {"verdict", verdict_name(beam.check->verdict)},
                              {"traffic", beam.left_hand ? "left" : "right"},
                              {"traffic_source", traffic_source_name(beam.check->traffic_source)},
                              {"failed", beam.check->failed},
                              {"within_resolution", beam.check->within_resolution},
                              {"no_data", beam.check->no_data},
                              {"not_wholly_on_the_wall", rows_beyond_wall(*beam.check)}});
  }
  for (const auto& [stem, draw] : views) {
    const std::string path = options.out + "/" + stem;
    if (const Status written = write_chart(path, kPageWidth, kPageHeight, draw); !written)
      return bad_input(written.error());
    for (const char* ending : {".svg", ".png"}) json["files"].push_back(path + ending);
    if (!options.json) std::printf("%s.svg, .png\n", path.c_str());
  }
  if (options.json) {
    print_json(json);
  } else {
    std::printf("%s-hand traffic (%s)\n", left_hand ? "left" : "right", traffic.c_str());
  }
  return kExitDone;
}

}  // namespace phare
