#include "visual/process/report.h"

#include <fmt/format.h>

#include "net/stats.h"
#include "visual/effects_of_frame.h"

namespace phare {

namespace {

nlohmann::json aims_json(const Lamps& lamps) {
  nlohmann::json aims = nlohmann::json::array();
  for (const LampAiming& aiming : lamps.aimings()) {
    aims.push_back({{"design", aiming.design},
                    {"lamp", aiming.lamp},
                    {"cutoff_found", aiming.found},
                    {"turned_deg", aiming.turned_deg},
                    {"text", aiming.text()}});
    if (aiming.found) aims.back()["cutoff_v_deg"] = aiming.after_deg;
  }
  return aims;
}

nlohmann::json table_ends_json(const Lamps& lamps) {
  nlohmann::json ends = nlohmann::json::array();
  for (const SourceEnd& end : lamps.table_ends()) {
    ends.push_back({{"design", end.design}, {"lamp", end.lamp}, {"file", end.file}, {"text", end.text()}});
    if (end.end.below) ends.back()["v_deg"] = end.end.v_deg;
    if (end.end.below) ends.back()["nearest_road_m"] = end.end.nearest_road_m;
  }
  return ends;
}

/// Effects that are otherwise in this view than in the frame's own.
nlohmann::json view_effects_json(const FrameResult& frame, const ViewResult& view) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Effect effect : differing_effects(frame.views.front(), view)) {
    const EffectRow& row = effect_table()[static_cast<std::size_t>(effect)];
    const EffectDecision& decision = view.effects[effect];
    rows.push_back({{"name", row.name}, {"level", row.levels[decision.level]}, {"because", decision.reason}});
  }
  return rows;
}

/// What was on in the newest frame, why, and what it took; `ms` only where the effect has had a pass, median.
nlohmann::json effects_json(const FrameStats& stats) {
  nlohmann::json rows = nlohmann::json::array();
  for (const EffectRow& row : effect_table()) {
    const EffectDecision& decision = stats.newest.effects[row.effect];
    const EffectCost& cost = stats.newest.effect_costs[static_cast<std::size_t>(row.effect)];
    rows.push_back({{"name", row.name},
                    {"level", row.levels[decision.level]},
                    {"because", decision.reason},
                    {"needs", row.needs},
                    {"passes", cost.passes},
                    {"bytes", cost.bytes}});
    if (const auto times = stats.effect_ms.find(row.effect); times != stats.effect_ms.end())
      rows.back()["ms"] = times->second.percentile(0.5);
  }
  return rows;
}

}  // namespace

nlohmann::json report_json(const Session& session, SimTime now) {
  nlohmann::json report = stats_json("visual", session.bus);
  const FrameStats& stats = session.stats;
  report["version"] = PHARE_VERSION;
  report["channel"] = session.channel().name;
  report["channel_index"] = session.options.channel;
  report["size_px"] = {session.options.width_px, session.options.height_px};
  report["lockstep"] = session.options.lockstep;
  report["sim_time_s"] = now.seconds();
  report["device"] = session.renderer.device();
  report["frames_in_flight"] = session.renderer.frames_in_flight();
  report["device_memory_bytes"] = session.renderer.device_memory_bytes();
  report["validation"] = session.options.validation;
  report["validation_messages"] = session.renderer.validation_messages();

  report["frames"] = stats.frames;
  if (stats.frames_before > 0) report["frames_before"] = stats.frames_before;
  report["frames_per_s"] = stats.frames_per_s();
  report["drawn_s"] = stats.seconds();
  report["frames_captured"] = stats.captured_frames;
  report["frames_stale_pose"] = stats.stale_frames;
  if (session.options.law) report["law"] = session.law.json();
  if (const auto lock = session.lock.json(); !lock.is_null()) report["frame_lock"] = lock;
  report["fail_safe"] = session.fail_safes.json();
  report["frame_ms"] = to_json(stats.wall_ms);
  report["frame_ms_without_capture"] = to_json(stats.wall_no_capture_ms);
  report["gpu_ms"] = to_json(stats.gpu_ms);
  report["interval_ms"] = to_json(stats.interval_ms);
  report["pass_ms"] = nlohmann::json::object();
  for (const auto& [pass, times] : stats.pass_ms) report["pass_ms"][pass] = to_json(times);
  report["made_in_the_drive"] = {{"pipelines", stats.pipelines_made},
                                 {"frames", stats.making_frames},
                                 {"longest_frame_ms", stats.longest_making_ms},
                                 {"kinds_followed", stats.kinds_followed},
                                 {"kinds_complete", stats.kinds_complete},
                                 {"beside_the_frames", stats.pipelines_rehearsed},
                                 {"longest_between_frames_ms", stats.longest_rehearsal_ms}};
  report["draws"] = stats.newest.draws;
  report["passes"] = stats.newest.pass_count;
  report["triangles"] = stats.newest.triangles;
  report["images"] = {{"count", stats.newest.images}, {"bytes", stats.newest.image_bytes}};
  report["road_cuts"] = session.options.road_cuts;
  report["method"] = kMethodNames[static_cast<std::size_t>(session.desk.method)];
  report["weather"] = nlohmann::json::object();
  if (session.desk.visibility_m) report["weather"]["visibility_m"] = *session.desk.visibility_m;
  if (session.desk.rain_mmph > 0.0) report["weather"]["rain_mmph"] = session.desk.rain_mmph;
  if (session.desk.snow_mmph > 0.0) report["weather"]["snow_mmph"] = session.desk.snow_mmph;
  if (session.desk.snow_cover_01 > 0.0) report["weather"]["snow_cover"] = session.desk.snow_cover_01;
  report["views"] = nlohmann::json::array();
  for (const ViewResult& view : stats.newest.views) {
    report["views"].push_back({{"name", view.name},
                               {"passes", view.passes},
                               {"draws", view.draws},
                               {"triangles", view.triangles},
                               {"lamps", view.lamps},
                               {"lamps_that_reach_nothing", view.lamps_unreached},
                               {"lamps_over_the_limit", view.lamps_over_limit},
                               {"lamps_without_a_shadow_map", view.lamps_without_map},
                               {"effects", view_effects_json(stats.newest, view)}});
  }
  report["effects"] = effects_json(stats);
  report["beams"] = {{"image", level_name(session.options.beam_image.value_or(session.rig.beam_image))},
                     {"compositions", session.lamps.compositions()},
                     {"summed_texels", session.lamps.summed_texels()},
                     {"uploaded_texels", session.renderer.uploaded_texels()},
                     {"uploads", session.lamps.uploads()},
                     {"resampled", session.lamps.resampled_images()}};
  report["eye"] = {{"adaptation", session.eye.fixed() ? "fixed" : "auto"}, {"adapted_k", session.eye.adapted_k()}};
  report["self_audit"] = session.audit.json();
  if (!session.options.picked.empty()) {
    report["picked"] = {{"level", session.options.levels[session.options.begin_level].text()},
                        {"why", session.options.picked}};
    if (session.governor.on()) report["picked"]["governor"] = session.governor.json();
    if (!session.governor_left.is_null()) report["picked"]["governor"] = session.governor_left;
  }
  report["switch_to_photon"] = session.switches.json();
  report["scene"] = {{"file", session.scene.file.filename().string()},
                     {"content_hash", session.scene.content_hash},
                     {"triangles", session.scene.indices.size() / 3}};
  report["designs"] = nlohmann::json::array();
  for (const auto& [design, seconds] : session.designs_lit.seconds)
    report["designs"].push_back({{"index", design},
                                 {"name", session.lamps.designs()[design].name},
                                 {"lit_s", seconds},
                                 {"in_the_stills", session.stills_design == design}});
  if (const auto& two = session.designs_lit.compared)
    report["versus"] = {{"a", session.lamps.designs()[two->first].name},
                        {"b", session.lamps.designs()[two->second].name},
                        {"compare", kCompareNames[static_cast<std::size_t>(session.desk.compare)]},
                        {"aligned", session.desk.versus_aligned}};
  report["lamps"] = session.lamps_json;
  report["aims"] = aims_json(session.lamps);
  report["table_ends"] = table_ends_json(session.lamps);
  report["kept_frames"] = {{"count", session.album.frames().kept()},
                           {"hash", fmt::format("{:016x}", session.album.frames().hash())},
                           {"not_kept", session.album.not_kept()},
                           {"first_not_kept", session.album.first_not_kept()}};
  return report;
}

}  // namespace phare
