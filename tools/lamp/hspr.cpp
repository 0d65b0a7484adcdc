// phare lamp hspr: ranges, widths, flux, glare, points, scores and classes of lamps by the method of HSPR (GTB
// CE-5815), with the physical figure beside each of the method's.
#include "visual/photometry/bench/hspr.h"

#include <array>
#include <cstdio>
#include <deque>
#include <nlohmann/json.hpp>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/print_json.h"
#include "visual/photometry/bench/cutoff.h"

namespace phare {
namespace {

constexpr std::array<const char*, 6> kAdbSituations{"oncoming-50",  "oncoming-100",  "oncoming-200",
                                                    "preceding-50", "preceding-100", "preceding-200"};

/// Reads pairs of files and keeps their tables.
class HsprPairs {
 public:
  explicit HsprPairs(const LampHsprOptions& options) : options_(options) {}

  Result<std::vector<HsprLamp>> read(const std::string& left, const std::string& right) {
    std::vector<HsprLamp> lamps;
    for (const std::string& file : {left, right}) {
      auto table = read_lamp(file, options_.settings);
      if (!table) return table.error();
      tables_.push_back(std::move(*table));
      lamps.push_back({&tables_.back(), (lamps.empty() ? -0.5 : 0.5) * options_.spacing_m, options_.height_m, 0.0});
    }
    return lamps;
  }

 private:
  const LampHsprOptions& options_;
  std::deque<IntensityTable> tables_;  ///< stay where they are
};

/// One pair, rated as one beam.
struct HsprRating {
  std::string beam;  ///< "low", "high"
  std::vector<HsprLamp> lamps;
  HsprResult result;
  CutoffShape shape;  ///< of the left lamp: tells the side of traffic, or that it is assumed
};

Result<HsprRating> rate(HsprPairs& pairs, const std::string& left, const std::string& right, HsprBeam asked,
                        const LampHsprOptions& options) {
  auto lamps = pairs.read(left, right);
  if (!lamps) return lamps.error();
  const auto beam = hspr_beam(*lamps, asked);
  if (!beam) return beam.error();
  for (HsprLamp& lamp : *lamps) {
    if (options.pitch_given) lamp.aim_up_deg = options.pitch_deg;
  }
  const bool low = *beam == HsprBeam::kLow;
  HsprRating rating{low ? "low" : "high", *lamps, low ? hspr_low_beam(*lamps) : hspr_high_beam(*lamps),
                    cutoff_shape(mounted_intensity(*lamps->front().table, glm::dmat3{1.0}))};
  return rating;
}

nlohmann::json result_json(const HsprResult& result) {
  const auto put = [](nlohmann::json& json, const char* key, const std::optional<double>& value) {
    json[key] = value ? nlohmann::json(*value) : nlohmann::json();
  };
  nlohmann::json rows = nlohmann::json::array();
  for (const HsprRow& row : result.rows) {
    nlohmann::json one{{"id", row.id},
                       {"what", row.what},
                       {"unit", row.unit},
                       {"weight", row.weight},
                       {"one_point", row.one_point},
                       {"two_points", row.two_points},
                       {"departure", row.departure}};
    put(one, "value", row.value);
    put(one, "points", row.points);
    put(one, "physical", row.physical);
    put(one, "physical_points", row.physical_points);
    rows.push_back(std::move(one));
  }
  nlohmann::json json{{"rows", rows}, {"scale_worst", result.worst}, {"scale_best", result.best}};
  put(json, "weighted_points", result.weighted);
  put(json, "score", result.score);
  put(json, "physical_weighted_points", result.physical_weighted);
  put(json, "physical_score", result.physical_score);
  if (result.score) json["class"] = hspr_class(10.0 * *result.score);
  return json;
}

std::string cell(const std::optional<double>& value, const char* format) {
  char text[32] = "-";
  if (value) std::snprintf(text, sizeof text, format, *value);
  return text;
}

void print_rows(const HsprResult& result) {
  std::printf("  %-12s %-60s %-2s %10s %8s %10s %8s %7s\n", "row", "what", "", "method", "points", "physical", "points",
              "weight");
  for (const HsprRow& row : result.rows) {
    std::printf("  %-12s %-60s %-2s %10s %8s %10s %8s %7.2f\n", row.id.c_str(), row.what.c_str(), row.unit.c_str(),
                cell(row.value, "%.3f").c_str(), cell(row.points, "%.3f").c_str(), cell(row.physical, "%.3f").c_str(),
                cell(row.physical_points, "%.3f").c_str(), row.weight);
  }
  // Why the two columns differ, each reason once.
  std::vector<std::pair<std::string, std::string>> reasons;
  for (const HsprRow& row : result.rows) {
    const auto known =
        std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == row.departure; });
    if (known == reasons.end())
      reasons.emplace_back(row.departure, row.id);
    else
      known->second += ", " + row.id;
  }
  for (const auto& [why, ids] : reasons) std::printf("  %s: %s\n", ids.c_str(), why.c_str());
  for (const HsprRow& row : result.rows) {
    if (!row.value)
      std::printf("  %s: its threshold is never reached; the method has no number then, and no score\n",
                  row.id.c_str());
  }
  if (result.score) {
    std::printf("score %.2f by the method (%.3f weighted points; 1 is %.2f, 5 is %.2f): %s\n", *result.score,
                *result.weighted, result.worst, result.best, hspr_class(10.0 * *result.score).c_str());
  }
  if (result.physical_score)
    std::printf("score %.2f from the physical figures on the same scale\n", *result.physical_score);
}

void print(const HsprRating& rating, const LampHsprOptions& options) {
  std::printf(
      "HSPR (GTB CE-5815 by the project's notes), %s beam, lamps %.2f m high, %.2f m apart, aimed %+.2f and %+.2f "
      "deg\n",
      rating.beam.c_str(), options.height_m, options.spacing_m, rating.lamps[0].aim_up_deg, rating.lamps[1].aim_up_deg);
  std::printf("right-hand traffic (%s)\n", side_source(rating.shape).c_str());
  print_rows(rating.result);
}

/// The six pairs of an ADB, in the order of kAdbSituations.
Result<std::optional<HsprAdb>> rate_adb(HsprPairs& pairs, const LampHsprOptions& options) {
  if (options.adb.empty()) return std::optional<HsprAdb>{};
  if (options.adb.size() % 3 != 0) return Error{"--adb", "takes SITUATION LEFT RIGHT each time"};
  std::array<std::vector<HsprLamp>, 6> situations;
  for (std::size_t i = 0; i + 2 < options.adb.size(); i += 3) {
    const std::string& name = options.adb[i];
    const auto known = std::find(kAdbSituations.begin(), kAdbSituations.end(), name);
    if (known == kAdbSituations.end())
      return Error{"--adb " + name, "is none of oncoming-50, -100, -200 and preceding-50, -100, -200"};
    std::vector<HsprLamp>& here = situations[static_cast<std::size_t>(known - kAdbSituations.begin())];
    if (!here.empty()) return Error{"--adb " + name, "is given twice"};
    auto lamps = pairs.read(options.adb[i + 1], options.adb[i + 2]);
    if (!lamps) return lamps.error();
    here = std::move(*lamps);
  }
  for (std::size_t i = 0; i < situations.size(); ++i) {
    if (situations[i].empty()) return Error{"--adb", std::string(kAdbSituations[i]) + " is missing"};
  }
  return std::optional(hspr_adb(situations));
}

nlohmann::json adb_json(const HsprAdb& adb) {
  nlohmann::json json{{"score", nlohmann::json()}, {"distances", nlohmann::json::array()}};
  if (adb.score) json["score"] = *adb.score;
  for (std::size_t d = 0; d < adb.distances.size(); ++d) {
    json["distances"].push_back(result_json(adb.distances[d]));
    json["distances"].back()["distance_m"] = 50 << d;
  }
  for (const HsprBlockOut& row : adb.block_out) {
    json["block_out"].push_back({{"situation", row.situation},
                                 {"lamp", row.lamp},
                                 {"h_deg", {row.h_from_deg, row.h_to_deg}},
                                 {"v_deg", row.v_deg},
                                 {"brightest_cd", row.brightest_cd},
                                 {"limit_cd", row.limit_cd},
                                 {"within", row.brightest_cd <= row.limit_cd}});
  }
  return json;
}

void print(const HsprAdb& adb) {
  for (std::size_t d = 0; d < adb.distances.size(); ++d) {
    std::printf("ADB, other cars at %d m, lamps as filed\n", 50 << d);
    print_rows(adb.distances[d]);
  }
  std::printf("dark field of the ADB (the method checks it and does not score it)\n");
  for (const HsprBlockOut& row : adb.block_out)
    std::printf("  %-12s %-5s H %+.2f to %+.2f, V %+.2f deg: %8.0f cd, at most %6.0f: %s\n", row.situation.c_str(),
                row.lamp.c_str(), row.h_from_deg, row.h_to_deg, row.v_deg, row.brightest_cd, row.limit_cd,
                row.brightest_cd <= row.limit_cd ? "dark enough" : "TOO BRIGHT");
  if (adb.score) std::printf("ADB score %.2f by the method: %s\n", *adb.score, hspr_class(10.0 * *adb.score).c_str());
}

}  // namespace

int lamp_hspr(const LampHsprOptions& options) {
  if (!options.adb.empty() && options.high.empty())
    return bad_input({"--adb", "rates a system; name its driving beam too, with --high LEFT RIGHT"});
  if (!options.high.empty() && options.beam == "high")
    return bad_input({"--high", "stands beside a passing beam; leave out --beam high"});
  HsprPairs pairs(options);
  const bool system = !options.high.empty();
  const auto first = rate(pairs, options.left, options.right,
                          options.beam == "low" || system ? HsprBeam::kLow
                          : options.beam == "high"        ? HsprBeam::kHigh
                                                          : HsprBeam::kFind,
                          options);
  if (!first) return bad_input(first.error());
  std::vector<HsprRating> ratings{*first};
  if (system) {
    LampHsprOptions as_filed = options;  // --pitch-deg is of the passing beam here
    as_filed.pitch_given = false;
    const auto high = rate(pairs, options.high[0], options.high[1], HsprBeam::kHigh, as_filed);
    if (!high) return bad_input(high.error());
    ratings.push_back(*high);
  }
  const auto adb = rate_adb(pairs, options);
  if (!adb) return bad_input(adb.error());
  std::vector<HsprSystem> systems;
  if (system && ratings[0].result.score && ratings[1].result.score)
    systems = hspr_systems(*ratings[0].result.score, *ratings[1].result.score, *adb ? (*adb)->score : std::nullopt);

  if (options.json) {
    nlohmann::json json = result_json(ratings[0].result);
    json["beam"] = ratings[0].beam;
    json["traffic_source"] = ratings[0].shape.tells_side() ? "by the cut-off" : "assumed";
    json["left"] = options.left;
    json["right"] = options.right;
    json["aim_up_deg"] = {ratings[0].lamps[0].aim_up_deg, ratings[0].lamps[1].aim_up_deg};
    json["height_m"] = options.height_m;
    json["spacing_m"] = options.spacing_m;
    if (system) json["high"] = result_json(ratings[1].result);
    if (*adb) json["adb"] = adb_json(**adb);
    for (const HsprSystem& one : systems)
      json["systems"].push_back(
          {{"name", one.name}, {"mean_performance", one.mean_performance}, {"score", one.score}, {"class", one.grade}});
    print_json(json);
    return kExitDone;
  }
  for (const HsprRating& rating : ratings) print(rating, options);
  if (*adb) print(**adb);
  for (const HsprSystem& one : systems)
    std::printf("system, %s: score %.1f, %s (mean effective performance %.2f)\n", one.name.c_str(), one.score,
                one.grade.c_str(), one.mean_performance);
  return kExitDone;
}

}  // namespace phare
