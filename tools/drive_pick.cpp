#include "tools/drive_pick.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "config/picture_options.h"
#include "tools/cost/measure_settings.h"
#include "tools/cost/progress_line.h"
#include "tools/cost/settings.h"
#include "visual/air_of_desk.h"
#include "visual/photometry/beam/image_levels.h"
#include "visual/process/governor.h"

namespace phare {
namespace {

using namespace cost;

std::string asked_text(const DriveOptions& options) {
  char text[48];
  std::snprintf(text, sizeof text, options.tolerance ? "--tolerance %.4g%%" : "--budget-ms %.4g",
                options.tolerance ? 100.0 * *options.tolerance : options.budget_ms);
  return text;
}

#ifdef PHARE_WITH_GRAPHICS
/// The table of this machine: kept, or measured now and kept.
Result<SettingsTable> table_of_this_machine(const SettingsPlan& plan) {
  const Result<Validity> wanted = validity_of(plan);
  if (!wanted) return wanted.error();
  KeptSettings kept = kept_settings(*wanted);
  if (kept.table) {
    spdlog::info("settings as measured on this machine {}, kept in {}", kept.table->measured_at,
                 kept_settings_file(*wanted).string());
    return std::move(*kept.table);
  }
  spdlog::info("measuring what the settings of this picture cost on this machine, once: {}", kept.why_not);
  const auto begin = std::chrono::steady_clock::now();
  Result<SettingsTable> table = measure_settings(plan);
  if (!table) return table.error();
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto file = keep_settings(*table);
  if (file)
    spdlog::info("measured in {:.0f} s, kept in {}; phare cost --ladder settings measures longer", took_s,
                 file->file.string());
  else
    spdlog::warn("measured in {:.0f} s, and not kept: {}", took_s, file.error().text());
  return table;
}

GovernorLevel level_of(const Setting& setting) {
  return {setting.method, setting.shadows, setting.fog, std::max(setting.p95_ms, 1e-3)};
}
#endif

}  // namespace

Status pick_settings(DriveOptions& options, const Rig& rig) {
  if (options.budget_ms <= 0.0 && !options.tolerance) return Done{};
#ifdef PHARE_WITH_GRAPHICS
  Desk desk = rig.desk;
  for (const std::string& words : options.desk)
    if (const auto done = apply(desk, setting_of(words), {.designs = rig.designs.size()}); !done) return done.error();
  bool method_set = rig.desk.method != Method::kFragment;
  for (const DeskCommand& command : options.picture.desk) {
    if (const auto done = apply(desk, command, {.designs = rig.designs.size()}); !done) return done.error();
    method_set = method_set || command.setting == "method";
  }
  const std::size_t design = desk.design.value_or(0);
  const bool low_beam = std::ranges::any_of(rig.designs[design].lamps, [](const LampConfig& lamp) {
    return std::ranges::any_of(lamp.sources,
                               [](const SourceConfig& one) { return one.function == LampFunction::kLow; });
  });
  if (!low_beam)
    return Error{asked_text(options),
                 "settings are measured by low beam, and design \"" + rig.designs[design].name + "\" has none"};
  if (desk.shadows.value_or(0) >= kRayShadows)
    return Error{asked_text(options), "shadows \"" + std::string(kShadowNames[*desk.shadows]) +
                                          "\" are a reference, for which nothing is picked; the finest that is: \"" +
                                          std::string(kShadowNames[kRayShadows - 1]) + "\""};
  FixedSettings fixed{.shadows = desk.shadows, .fog = desk.fog};
  if (method_set) fixed.method = desk.method;
  // As with the method, a level of the rig's own that is not the default stays.
  if (rig.beam_image != Rig{}.beam_image) fixed.image = rig.beam_image;
  if (!options.picture.beam_image.empty()) fixed.image = level_named(options.picture.beam_image);

  SettingsPlan plan{.rig = &rig,
                    .width_px = rig.channels.front().width_px,
                    .height_px = rig.channels.front().height_px,
                    .samples = options.picture.samples,
                    .road_cuts = options.picture.road_cuts,
                    .air = air_of(desk),
                    .design = design,
                    .device_name = options.picture.device_name,
                    .progress = {}};
  if (options.picture.width_px > 0)
    plan.width_px = options.picture.width_px, plan.height_px = options.picture.height_px;
  Result<SettingsTable> table = [&] {
    ProgressLine line;
    plan.progress = [&](const std::string& doing, double share_01) { line.show(doing, share_01); };
    return table_of_this_machine(plan);
  }();
  if (!table) return table.error();
  const std::vector<Setting> settings = all_settings(*table, fixed);
  if (settings.empty())
    return Error{asked_text(options), "what --method and --beam-image say was not measured together"};

  const Pick pick = options.tolerance ? pick_for_tolerance(settings, *options.tolerance)
                                      : pick_for_budget(settings, options.budget_ms);
  if (options.tolerance && !pick.holds) return Error{asked_text(options), pick.why};
  const std::string line = asked_text(options) + ": " + pick.setting.text() + ": " + pick.why;
  if (pick.holds)
    spdlog::info("{}", line);
  else
    spdlog::warn("{}", line);
  if (options.budget_ms > 0.0 && options.lockstep) spdlog::info("lockstep: the governor is off, what is picked stays");

  options.picked_arguments = {"--picked", pick.why};
  const auto add = [&](std::initializer_list<std::string> words) {
    options.picked_arguments.insert(options.picked_arguments.end(), words);
  };
  if (!fixed.image) add({"--beam-image", level_name(pick.setting.image)});
  if (options.tolerance) {
    add({"--level", words_of(level_of(pick.setting))});
    return Done{};
  }
  const std::vector<Setting> steps = steps_about(settings, pick.setting);
  for (const Setting& step : steps) add({"--level", words_of(level_of(step))});
  const auto begin = std::ranges::find(steps, pick.setting.text(), &Setting::text) - steps.begin();
  char budget[32];
  std::snprintf(budget, sizeof budget, "%.9g", options.budget_ms);
  add({"--begin-level", std::to_string(begin), "--budget-ms", budget});
  return Done{};
#else
  (void)rig;
  return Error{asked_text(options), "this build draws nothing"};
#endif
}

}  // namespace phare
