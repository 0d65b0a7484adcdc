// phare lamp check: a beam, or a laboratory's list of points, against the rulebooks. Exit code 1 when a row fails or
// the file has no data for it.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "config/base/whole_file.h"
#include "config/formats/toml_table.h"
#include "tools/commands.h"
#include "tools/lamp/check_page.h"
#include "tools/lamp/check_text.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/point_lists.h"
#include "tools/lamp/print_json.h"
#include "visual/photometry/bench/check_points.h"
#include "visual/photometry/readers/file_text.h"

namespace phare {
namespace {

int list_rules(bool as_json) {
  const auto rules = read_rulebooks(rules_folder());
  if (!rules) return bad_input(rules.error());
  if (as_json) {
    nlohmann::json all = nlohmann::json::array();
    for (const Rulebook& rule : *rules) {
      all.push_back({{"id", rule.id},
                     {"name", rule.name},
                     {"aliases", rule.aliases},
                     {"document", rule.document},
                     {"clause", rule.clause},
                     {"function", rule.function},
                     {"market", rule.market},
                     {"half_sum", rule.half_sum},
                     {"sources", rule.sources},
                     {"rows", rule.rows.size()}});
    }
    print_json(all);
    return kExitDone;
  }
  for (const Rulebook& rule : *rules)
    std::printf("%-18s %-4s %-5s %s, %zu rows\n", rule.id.c_str(), rule.market.c_str(), rule.function.c_str(),
                rule.name.c_str(), rule.rows.size());
  return kExitDone;
}

/// What is judged: one or two tables, or the beams of a list of points.
struct Inputs {
  std::vector<IntensityTable> tables;
  std::vector<PointList> lists;
  std::string names;

  std::vector<const IntensityTable*> pointers() const {
    std::vector<const IntensityTable*> all;
    for (const IntensityTable& table : tables) all.push_back(&table);
    return all;
  }
};

Result<Inputs> read_inputs(const LampCheckOptions& options) {
  Inputs inputs;
  for (const std::string& file : options.files) {
    auto points = read_as_points(file, options.settings);
    if (!points) return points.error();
    inputs.names += (inputs.names.empty() ? "" : " and ") + base_name(file);
    if (*points) {
      if (options.files.size() > 1) return Error{file, "is a list of points: judged by itself, not as one of a pair"};
      auto lists = beams_named(**points, options.beam);
      if (!lists) return lists.error();
      inputs.lists = std::move(*lists);
      continue;
    }
    if (!options.beam.empty()) return Error{"--beam", "is for lists of points; " + file + " is none"};
    auto table = read_lamp(file, options.settings);
    if (!table) return table.error();
    inputs.tables.push_back(std::move(*table));
  }
  return inputs;
}

/// Which function a beam has, and why.
struct Function {
  std::string name, why;
};

Function function_of(const CutoffShape& shape) {
  if (shape.tells_side()) return {"low", "its cut-off rises: " + form_name(shape.form)};
  if (shape.side == CutoffSide::kFlat) return {"fog", "its cut-off is " + form_name(shape.form)};
  return {"high", "it has no cut-off"};
}

/// By its name, else by whose rules' points it has most of.
Function function_of(const PointList& list, std::span<const Rulebook> rules) {
  if (const std::string named = function_of_beam(list.beam); !named.empty()) return {named, "by its name"};
  Function best{"", ""};
  std::size_t most = 0;
  for (const Rulebook& rule : rules) {
    const CheckResult result = check_points(list, rule, {});
    const auto measured =
        static_cast<std::size_t>(std::count_if(result.rows.begin(), result.rows.end(), [](const CheckRow& row) {
          return row.verdict != RuleVerdict::kNoData;
        }));
    if (measured > most) most = measured, best = {rule.function, "most of its points are of " + rule.id};
  }
  return best;
}

/// "EU" is ECE, "USA" is US.
std::string market_of(const std::string& asked) {
  const std::string name = upper_case(asked);
  return name == "EU" || name == "UN" || name == "UNECE" ? "ECE" : name == "USA" || name == "FMVSS" ? "US" : name;
}

/// `every`: one of many rules, of which some may not fit. `rules`: all there are.
Status judge(const LampCheckOptions& options, const Inputs& inputs, const Rulebook& rule,
             std::span<const Rulebook> rules, bool every, std::vector<Judged>& all) {
  CheckOptions check;
  check.traffic = options.traffic == "left"    ? TrafficSide::kLeft
                  : options.traffic == "right" ? TrafficSide::kRight
                                               : TrafficSide::kFind;
  check.reaim = options.reaim;
  check.aim_name = options.aim;
  check.led_module = options.led_module && (!every || rule.has_led_module_limits());
  if (options.aim_up_deg || options.aim_right_deg)
    check.aim = HV{options.aim_right_deg.value_or(0.0), options.aim_up_deg.value_or(0.0)};
  for (const PointList& list : beams_for(inputs.lists, rule)) {
    Judged judged{list_title(options.files.front(), list), list.beam, {}, {}, true};
    judged.result = check_list(list, rule, rules, check, judged.unused);
    all.push_back(std::move(judged));
  }
  if (inputs.tables.empty()) return Done{};
  const std::vector<const IntensityTable*> pointers = inputs.pointers();
  if (pointers.size() == 2 && !rule.half_sum) {
    if (!every) return Error{rule.id, "judges each lamp by itself; check the two files one by one"};
    for (std::size_t k = 0; k < 2; ++k)
      all.push_back({base_name(options.files[k]),
                     options.files[k],
                     check_lamp(std::span(pointers).subspan(k, 1), rule, check),
                     {},
                     false});
    return Done{};
  }
  if (!options.aim.empty() && rule.aim(options.aim) == nullptr && !every) {
    std::vector<std::string> known;
    for (const CutoffAim& aim : rule.cutoff_aims) known.push_back(aim.name);
    return Error{"--aim", known.empty() ? rule.id + " has no aim by the cut-off"
                                        : rule.id + ": " + unknown_name_reason("aim", options.aim, known)};
  }
  if (options.led_module && !rule.has_led_module_limits() && !every)
    return Error{"--led-module", rule.id + " has no limits of its own for LED modules"};
  all.push_back({inputs.names, inputs.names, check_lamp(pointers, rule, check), {}, false});
  return Done{};
}

/// The beams of a list that the rule is not for.
void say_left_out(const Inputs& inputs, const Rulebook& rule) {
  const std::vector<PointList> judged = beams_for(inputs.lists, rule);
  for (const PointList& list : inputs.lists) {
    if (std::ranges::any_of(judged, [&](const PointList& one) { return one.beam == list.beam; })) continue;
    std::fprintf(stderr, "phare: %s is a %s beam by its name and left out; %s is for %s beams\n", list.beam.c_str(),
                 function_of_beam(list.beam).c_str(), rule.id.c_str(), rule.function.c_str());
  }
}

/// Every rule for this function and market.
Result<PageHead> judge_by_all(const LampCheckOptions& options, const Inputs& inputs, std::vector<Judged>& all) {
  const auto rules = read_rulebooks(rules_folder());
  if (!rules) return rules.error();
  const std::string market = market_of(options.market);
  PageHead head{inputs.names, "", market.empty() ? ", rules of every market" : ", rules of " + market};
  const auto judge_one = [&](const Inputs& one, const Function& function) -> Status {
    std::size_t found = 0;
    for (const Rulebook& rule : *rules) {
      if (rule.function != function.name || (!market.empty() && rule.market != market)) continue;
      ++found;
      if (const Status status = judge(options, one, rule, *rules, true, all); !status) return status.error();
    }
    head.function += (head.function.empty() ? "" : "; ") + function.name + " beam (" + function.why + ")";
    if (found == 0) return Error{"--market", "no rulebook of " + market + " is for a " + function.name + " beam"};
    return Done{};
  };
  const Function given{options.function, "as asked"};
  if (!inputs.tables.empty()) {
    const Function function = options.function.empty()
                                  ? function_of(cutoff_shape(mounted_intensity(inputs.tables.front(), glm::dmat3{1.0})))
                                  : given;
    if (const Status status = judge_one(inputs, function); !status) return status.error();
  }
  for (const PointList& list : inputs.lists) {
    const Function function = options.function.empty() ? function_of(list, *rules) : given;
    if (function.name.empty())
      return Error{list_title(options.files.front(), list), "has no point of any rule; name its beam with --function"};
    if (const Status status = judge_one({{}, {list}, ""}, function); !status) return status.error();
  }
  return head;
}

int exit_code(const std::vector<Judged>& all) {
  const bool failed =
      std::any_of(all.begin(), all.end(), [](const Judged& j) { return j.result.verdict >= RuleVerdict::kNoData; });
  return failed ? kExitCheckFailed : kExitDone;
}

}  // namespace

int lamp_check(const LampCheckOptions& options) {
  if (options.list) return list_rules(options.json);
  if (options.files.empty()) return bad_input({"", "give a photometry file, or --list"});
  const bool every = std::find(options.rules.begin(), options.rules.end(), "all") != options.rules.end() ||
                     (options.rules.empty() && !options.market.empty());
  if (every && options.rules.size() > 1) return bad_input({"--rule", "all stands alone"});
  if (options.rules.empty() && !every) return bad_input({"--rule", "name a rulebook, or all; --list shows them"});
  if (!every && !options.market.empty()) return bad_input({"--market", "goes with --rule all, not with one rule"});
  if (!every && !options.function.empty()) return bad_input({"--function", "goes with --rule all or --market"});
  if (options.files.size() > 2) return bad_input({"", "one file, or the left and the right lamp's"});
  const auto inputs = read_inputs(options);
  if (!inputs) return bad_input(inputs.error());
  const bool turned = options.aim_up_deg || options.aim_right_deg || !options.aim.empty() || !options.reaim;
  if (turned && inputs->tables.empty())
    return bad_input({options.files.front(),
                      "is a list of measured points, which stay where they were measured: --aim, --aim-up, --aim-right "
                      "and --no-reaim are of a table"});
  if (const Status pair = same_traffic(inputs->pointers()); !pair) return bad_input(pair.error());

  std::vector<Judged> all;
  PageHead head{inputs->names, "", ""};
  if (every) {
    auto judged = judge_by_all(options, *inputs, all);
    if (!judged) return bad_input(judged.error());
    head = std::move(*judged);
  } else {
    const auto rules = read_rulebooks(rules_folder());
    if (!rules) return bad_input(rules.error());
    for (const std::string& name : options.rules) {
      const auto rule = find_rulebook(rules_folder(), name);
      if (!rule) return bad_input(rule.error());
      if (const Status status = judge(options, *inputs, *rule, *rules, false, all); !status)
        return bad_input(status.error());
      say_left_out(*inputs, *rule);
      head.function += (head.function.empty() ? "" : ", ") + rule->name;
    }
  }
  if (!options.out.empty()) {
    std::error_code code;  // a folder that cannot be made shows when the page is written
    const std::filesystem::path folder = std::filesystem::path(options.out).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, code);
    if (const Status written = write_whole_file(options.out, html_page(head, all)); !written)
      return bad_input(written.error());
  }
  if (options.out == "-") return exit_code(all);  // the page is what was asked for
  if (options.json) {
    nlohmann::json results = nlohmann::json::array();
    for (const Judged& judged : all) {
      results.push_back(judged_json(judged));
      results.back()["files"] = options.files;
      if (every) results.back()["function"] = judged.result.function;
    }
    print_json(results.size() == 1 && !every ? results.front() : results);
  } else if (every) {
    print_page(head, all);
  } else {
    for (const Judged& judged : all) print_judged(judged);
  }
  return exit_code(all);
}

}  // namespace phare
