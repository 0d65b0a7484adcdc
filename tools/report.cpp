#include "tools/report.h"

#include <array>
#include <chrono>
#include <fstream>

#include "config/base/commit.h"
#include "config/base/content_hash.h"
#include "tools/utc_now.h"
#include "visual/photometry/beam/lamp_tables.h"

namespace phare {
namespace {

using nlohmann::json;

json named_by_content(const std::filesystem::path& file) {
  const auto hash = content_hash_of_file(file);
  return {{"file", file.filename().string()}, {"content_hash", hash ? *hash : ""}};
}

/// Each source as it shines: flux and peak with its scale, of the table that its settings choose from the file.
json lamps_of(const Rig& rig) {
  json lamps = json::array();
  LampTables tables;
  for (const DesignConfig& design : rig.designs) {
    for (const LampConfig& lamp : design.lamps) {
      for (const SourceConfig& source : lamp.sources) {
        json row{{"file", source.file.filename().string()}};
        if (const Status read = tables.add(source); !read) {
          row["error"] = read.error().text();
        } else {
          const IntensityTable& table = tables.of(source);
          row["content_hash"] = table.content_hash;
          row["flux_lm"] = source.scale * table.flux_lm();
          row["peak_cd"] = source.scale * table.peak_cd();
        }
        row["design"] = design.name;
        row["lamp"] = lamp.name;
        row["function"] = kLampFunctionNames[static_cast<std::size_t>(source.function)];
        row["scale"] = source.scale;
        // What else the source says about its file, where that is not what a file has by itself.
        if (source.lamp_set != 1) row["lamp_set"] = source.lamp_set;
        if (source.emitter != 1) row["emitter"] = source.emitter;
        if (source.mirror) row["mirror"] = true;
        if (!source.pixels.empty()) row["pixels"] = named_by_content(source.pixels);
        if (!source.pixel_map.empty()) row["pixel_map"] = named_by_content(source.pixel_map);
        if (!source.spectrum.empty()) row["spectrum"] = named_by_content(source.spectrum);
        if (source.c0_turn_deg != 0.0) row["c0_deg"] = source.c0_turn_deg;
        if (source.axis == GammaAxis::kGamma90) row["axis"] = "gamma90";
        lamps.push_back(std::move(row));
      }
    }
  }
  return lamps;
}

/// Lost, late, duplicate … over all messages of one process.
json message_totals(const json& bus) {
  json totals{{"received", 0}, {"lost", 0}, {"late", 0}, {"duplicate", 0}, {"restarted", 0}};
  for (const auto& [message, counts] : bus.items()) {
    if (!counts.is_object() || !counts.contains("received") || !counts.contains("lost")) continue;
    for (auto& [name, total] : totals.items())
      total = total.get<std::uint64_t>() + counts.value(name, std::uint64_t{0});
  }
  totals["refused"] = bus.value("refused", std::uint64_t{0});
  return totals;
}

}  // namespace

nlohmann::json read_stats(const std::filesystem::path& out, const std::string& process) {
  std::ifstream stream(out / (process + ".json"));
  json stats = stream ? json::parse(stream, nullptr, false) : json(nullptr);
  return stats.is_object() ? stats : json(nullptr);
}

nlohmann::json make_report(const Rig& rig, const DriveFacts& facts, const std::filesystem::path& out) {
  json report{{"version", PHARE_VERSION},    {"commit", build_commit()},   {"made_at", utc_now()},
              {"command", facts.command},    {"lockstep", facts.lockstep}, {"wall_s", facts.wall_s},
              {"exit_code", facts.exit_code}};
  report["cut_short"] = facts.interrupted;
  if (!facts.why.empty()) report["why"] = facts.why;
  report["rig"] = named_by_content(rig.file);
  report["rig"]["name"] = rig.name;
  report["scene"] = named_by_content(rig.scene_file);
  report["vehicle"] = named_by_content(rig.vehicle_file);
  report["cockpit"] = named_by_content(rig.cockpit_file);
  if (facts.traffic_file) report["traffic"] = named_by_content(*facts.traffic_file);
  if (facts.source_file) report["drive"] = named_by_content(*facts.source_file);
  report["lamps"] = lamps_of(rig);

  report["processes"] = json::object();
  json messages = json::object(), memory = json::object();
  for (const std::string& name : facts.process_names) {
    json stats = read_stats(out, name);
    if (stats.is_null()) continue;
    if (stats.contains("bus")) messages[name] = message_totals(stats["bus"]);
    if (stats.contains("memory")) memory[name] = stats["memory"];
    report["processes"][name] = std::move(stats);
  }
  for (const auto& [name, stats] : facts.own_counts) {
    messages[name] = message_totals(stats["bus"]);
    memory[name] = stats["memory"];
    report["processes"][name] = stats;
  }
  report["restarts"] = json::array();
  for (std::size_t i = 0; i < facts.restarts.size(); ++i) {
    const Restart& restart = facts.restarts[i];
    report["restarts"].push_back({{"process", restart.process}, {"at_s", restart.at_s}, {"because", restart.because}});
    // Counts under "processes" are of the process that runs at the end; those of the one that died, up to a second
    // before its death, stand here.
    if (i < facts.before_restarts.size() && !facts.before_restarts[i].is_null())
      report["restarts"].back()["before"] = facts.before_restarts[i];
  }
  report["ends"] = json::object();
  for (const auto& end : facts.ends) report["ends"][end.process] = end.how;

  // The first picture speaks for the drive; the others are under "processes".
  json summary{{"messages", messages}, {"memory", memory}, {"restarts", facts.restarts.size()}};
  if (report["processes"].contains("visual-0")) {
    const json& visual = report["processes"]["visual-0"];
    for (const char* key : {"frames",
                            "frames_before",
                            "frames_per_s",
                            "drawn_s",
                            "frame_ms",
                            "frame_ms_without_capture",
                            "gpu_ms",
                            "pass_ms",
                            "draws",
                            "passes",
                            "triangles",
                            "self_audit",
                            "picked",
                            "switch_to_photon",
                            "device",
                            "frames_in_flight",
                            "device_memory_bytes",
                            "size_px",
                            "sim_time_s",
                            "validation",
                            "validation_messages",
                            "fail_safe",
                            "law",
                            "frames_stale_pose"}) {
      if (visual.contains(key)) summary[key] = visual[key];
    }
    if (summary.value("frames_per_s", 0.0) <= 0.0) summary.erase("frames_per_s");  // one frame has no rate
    if (visual.contains("interval_ms")) {
      summary["interval_ms"] = visual["interval_ms"];
      const double median_ms = visual["interval_ms"].value("median", 0.0);
      if (median_ms > 0.0) summary["frames_per_s_median"] = 1000.0 / median_ms;
    }
  }
  report["summary"] = std::move(summary);
  return report;
}

}  // namespace phare
