#include "tools/lamp/point_lists.h"

#include <cstdio>

#include "config/formats/toml_table.h"
#include "tools/lamp/lamp_commands.h"
#include "visual/photometry/bench/check_points.h"
#include "visual/photometry/readers/file_text.h"

namespace phare {

Result<std::optional<PointLists>> read_as_points(const std::string& file, const LampReadSettings& settings) {
  const bool may_be = settings.format == LampFormat::kFind || settings.format == LampFormat::kCsv;
  if (!may_be) return std::optional<PointLists>{};
  const auto bytes = read_photometry_bytes(file, file);
  if (!bytes) return bytes.error();
  if (!is_point_list(*bytes, file)) return std::optional<PointLists>{};
  const auto rules = read_rulebooks(rules_folder());
  if (!rules) return rules.error();
  PointListSettings how;
  how.distance_m = settings.distance_m;
  how.mirror_h = settings.mirror_h;
  how.known_names = names_of_rows(*rules);
  auto lists = parse_point_lists(*bytes, file, how);
  if (!lists) return lists.error();
  for (const std::string& warning : lists->warnings) std::fprintf(stderr, "phare: %s\n", warning.c_str());
  return std::optional<PointLists>(std::move(*lists));
}

Result<std::vector<PointList>> beams_named(const PointLists& lists, const std::string& beam) {
  if (beam.empty()) return lists.beams;
  std::vector<PointList> found;
  std::vector<std::string> known;
  for (const PointList& list : lists.beams) {
    known.push_back(list.beam);
    if (upper_case(list.beam) == upper_case(beam)) found.push_back(list);
  }
  if (found.empty()) return Error{"--beam", unknown_name_reason("beam", beam, known)};
  return found;
}

std::vector<PointList> beams_for(const std::vector<PointList>& lists, const Rulebook& rule) {
  std::vector<PointList> fitting;
  for (const PointList& list : lists) {
    const std::string function = function_of_beam(list.beam);
    if (function.empty() || function == rule.function) fitting.push_back(list);
  }
  return fitting.empty() ? lists : fitting;
}

CheckResult check_list(const PointList& list, const Rulebook& rule, std::span<const Rulebook> rules,
                       CheckOptions options, std::vector<std::string>& unused) {
  int for_right = 0;
  for (const Rulebook& other : rules) for_right += other.function == rule.function ? points_for_right(list, other) : 0;
  const bool find = options.traffic == TrafficSide::kFind;
  if (find) options.traffic = for_right < 0 ? TrafficSide::kLeft : TrafficSide::kRight;
  CheckResult result = check_points(list, rule, options, &unused);
  if (find) result.traffic_source = for_right != 0 ? TrafficSource::kFound : TrafficSource::kAssumed;
  return result;
}

std::string list_title(const std::string& file, const PointList& list) {
  return base_name(file) + (list.beam.empty() ? "" : ", " + list.beam);
}

}  // namespace phare
