#include "tools/lamp/plot_points.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/commands.h"
#include "tools/lamp/check_text.h"
#include "tools/lamp/point_lists.h"
#include "tools/lamp/print_json.h"
#include "tools/lamp/views.h"

namespace phare {
namespace {

/// A beam's name as part of a file's: letters and digits, others as _.
std::string file_part(const std::string& beam) {
  std::string part = beam.empty() ? "" : "_";
  for (const char c : beam) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    part += plain ? c : '_';
  }
  return part;
}

}  // namespace

int plot_points(const LampPlotOptions& options, const PointLists& lists) {
  for (const std::string& view : options.views) {
    if (view != "wall_25m") return bad_input({"--view", "a list of points is drawn as wall_25m alone, not as " + view});
  }
  if (options.pitch_given) return bad_input({"--pitch-deg", "a list of points cannot be turned"});
  const auto beams = beams_named(lists, options.beam);
  if (!beams) return bad_input(beams.error());
  std::optional<Rulebook> rule;
  if (!options.rule.empty()) {
    auto found = find_rulebook(rules_folder(), options.rule);
    if (!found) return bad_input(found.error());
    rule = std::move(*found);
  }
  const auto rules = read_rulebooks(rules_folder());
  if (!rules) return bad_input(rules.error());
  std::error_code code;
  std::filesystem::create_directories(options.out, code);
  if (code) return bad_input({options.out, code.message()});

  nlohmann::json json{{"file", options.files.front()}, {"beams", nlohmann::json::array()}};
  for (const PointList& list : rule ? beams_for(*beams, *rule) : *beams) {
    Judged judged{list_title(options.files.front(), list), list.beam, {}, {}, true};
    if (rule) judged.result = check_list(list, *rule, *rules, {}, judged.unused);
    std::vector<PointMark> marks;
    std::size_t unplaced = 0;
    for (const MeasuredPoint& point : list.points) {
      if (!point.cd) continue;
      // A name without angles stands where the rule's row of that name does.
      std::optional<HV> at = point.at;
      for (const CheckRow& row : judged.result.rows) {
        if (!at && row.at.size() == 1 && plain_name(row.id) == plain_name(point.name)) at = row.at.front();
      }
      if (at) marks.push_back({*at, *point.cd});
      unplaced += at ? 0 : 1;
    }
    std::string subtitle = std::to_string(list.measured()) + " of " + std::to_string(list.points.size()) +
                           " points measured" +
                           (unplaced > 0 ? ", " + std::to_string(unplaced) + " by a name without a place" : "");
    if (rule) {
      subtitle += "; " + rule->name + ": " + conclusion(judged.result.verdict) + ", " +
                  std::to_string(judged.result.failed) + " of " + std::to_string(judged.result.rows.size()) +
                  " rows failed, " + std::to_string(judged.result.no_data) + " not measured; " + traffic_text(judged);
    }
    const std::string path = options.out + "/wall_25m" + file_part(list.beam);
    const CheckResult* const check = rule ? &judged.result : nullptr;
    const Status written = write_chart(path, kPageWidth, kPageHeight, [&](Chart& chart) {
      draw_point_wall(chart, marks, judged.beam + ": measured points", subtitle, check);
    });
    if (!written) return bad_input(written.error());
    nlohmann::json one{{"beam", list.beam}, {"points", list.points.size()}, {"measured", list.measured()}};
    for (const char* ending : {".svg", ".png"}) one["files"].push_back(path + ending);
    if (rule) one["check"] = judged_json(judged);
    json["beams"].push_back(std::move(one));
    if (!options.json) std::printf("%s.svg, .png\n", path.c_str());
  }
  if (options.json) print_json(json);
  return kExitDone;
}

}  // namespace phare
