// phare-make-lamps: writes the sample lamps and lamps.json, reads them back and checks them against their rulebooks.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "config/base/paths.h"
#include "config/base/whole_file.h"
#include "config/empty_values.h"
#include "config/finite_numbers.h"
#include "visual/photometry/bench/check.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

constexpr const char* kKindNames[] = {"low", "low", "high", "fog", "cornering", "bicycle", "high"};

/// Rulebooks, each read once.
class Rules {
 public:
  const Rulebook* find(const std::string& id) {
    const auto known = rules_.find(id);
    if (known != rules_.end()) return &known->second;
    auto rule = find_rulebook(config_dir() / "rules", id);
    if (!rule) {
      std::fprintf(stderr, "%s\n", rule.error().text().c_str());
      return nullptr;
    }
    return &rules_.emplace(id, std::move(*rule)).first->second;
  }

 private:
  std::map<std::string, Rulebook> rules_;
};

/// Checks a lamp and prints every failed row, and all with `verbose`. Returns the count of the failed.
std::size_t report(const std::string& lamp, const IntensityTable& table, const Rulebook& rule,
                   const CheckOptions& options, bool verbose, nlohmann::json& entry) {
  const IntensityTable* tables[] = {&table};
  const CheckResult result = check_lamp(tables, rule, options);
  for (const CheckRow& row : result.rows) {
    if (row.verdict != RuleVerdict::kFail && !verbose) continue;
    std::printf("%-20s %-18s %-24s %9.1f … %9.1f %s, allowed %.1f … %.5g  %s\n", lamp.c_str(), rule.id.c_str(),
                row.id.c_str(), row.lowest, row.highest, row.unit.c_str(), row.min, row.max,
                row.verdict == RuleVerdict::kFail ? "FAILED" : "passed");
  }
  if (result.cutoff.found) {
    entry["sharpness_g"] = result.cutoff.sharpness_g;
    entry["cutoff_elevation_deg"] = result.cutoff.elevation_deg - result.aim_up_deg;
  }
  return result.failed;
}

int make(const std::filesystem::path& out, bool verbose) {
  std::error_code code;
  std::filesystem::create_directories(out / "matrix", code);
  if (code) {
    std::fprintf(stderr, "%s: %s\n", out.c_str(), code.message().c_str());
    return kExitBadInput;
  }
  std::filesystem::remove(out / "lamps.json", code);
  std::size_t failed = 0;
  Rules rules;
  nlohmann::json list = nlohmann::json::array();
  std::vector<SampleLamp> lamps = sample_lamps();
  for (SampleLamp& segment : matrix_segments()) lamps.push_back(std::move(segment));
  std::vector<const IntensityTable*> segments;
  for (const SampleLamp& lamp : lamps) {
    const std::string path = (out / lamp.file).string();
    if (const Status written = write_whole_file(path, lm63_text(lamp.table, kSampleGeneration)); !written) {
      std::fprintf(stderr, "%s\n", written.error().text().c_str());
      return kExitBadInput;
    }
    const auto read = read_lamp(path);
    if (!read) {
      std::fprintf(stderr, "%s\n", read.error().text().c_str());
      return kExitCheckFailed;
    }
    const IntensityTable& table = *read;
    if (table.candela != lamp.table.candela || table.first_deg != lamp.table.first_deg ||
        table.second_deg != lamp.table.second_deg) {
      std::printf("%-20s what was read back differs from what was written  FAILED\n", lamp.file.c_str());
      ++failed;
    }
    const TableAngles peak = table.peak_at();
    nlohmann::json entry{{"file", lamp.file},
                         {"function", kKindNames[static_cast<int>(lamp.kind)]},
                         {"description", lamp.description},
                         {"peak_cd", table.peak_cd()},
                         {"peak_h_deg", peak.first_deg},
                         {"peak_v_deg", peak.second_deg},
                         {"flux_lm", table.flux_lm()},
                         {"mount_pitch_deg", glm::degrees(sample_pitch_rad())},
                         {"passes", lamp.rules},
                         {"content_hash", table.content_hash}};
    for (const std::string& id : lamp.rules) {
      const Rulebook* rule = rules.find(id);
      if (rule == nullptr) return kExitBadInput;
      CheckOptions down;  // one adjuster turns the whole lamp: aimed with the passing beam a driving beam passes, too
      down.aim = HV{0.0, glm::degrees(sample_pitch_rad())};
      failed += report(lamp.file, table, *rule, {}, verbose, entry);
      if (lamp.kind == SampleKind::kFog || lamp.kind == SampleKind::kHigh)
        failed += report(lamp.file, table, *rule, down, verbose, entry);
    }
    if (lamp.kind == SampleKind::kSegment) segments.push_back(&lamp.table);
    if (lamp.kind != SampleKind::kSegment || verbose)
      std::printf("%-20s %6.0f cd at %+.2f, %+.2f deg, %6.1f lm\n", lamp.file.c_str(), table.peak_cd(), peak.first_deg,
                  peak.second_deg, table.flux_lm());
    list.push_back(std::move(entry));
  }
  const IntensityTable matrix = sum_tables(segments);
  std::printf("%-20s %6.0f cd, %6.1f lm from %zu segments\n", "matrix/", matrix.peak_cd(), matrix.flux_lm(),
              segments.size());
  nlohmann::json whole{{"segments", segments.size()}, {"rows", kMatrixRows},         {"columns", kMatrixColumns},
                       {"peak_cd", matrix.peak_cd()}, {"flux_lm", matrix.flux_lm()}, {"passes", {"r149-driving-b"}}};
  const Rulebook* driving = rules.find("r149-driving-b");
  if (driving == nullptr) return kExitBadInput;
  failed += report("matrix, all lit", matrix, *driving, {}, verbose, whole);
  if (failed > 0) {
    std::printf("%zu check(s) failed\n", failed);
    return kExitCheckFailed;
  }
  // Written last: where it is, the lamps are whole and passed.
  const std::string json = nlohmann::json{{"lamps", list}, {"matrix", whole}}.dump(2) + "\n";
  if (const Status written = write_whole_file((out / "lamps.json").string(), json); !written) {
    std::fprintf(stderr, "%s\n", written.error().text().c_str());
    return kExitBadInput;
  }
  return kExitDone;
}

}  // namespace
}  // namespace phare

int main(int argc, char** argv) {
  CLI::App app{
      "Makes the sample lamps (LM-63-2019 type A) and checks them.\nExample: phare-make-lamps --out generated/lamps"};
  std::string out;
  bool verbose = false;
  app.add_option("--out", out, "folder to write into")->required();
  app.add_flag("--verbose", verbose, "print every regulation row, not only the failed ones");
  phare::take_finite_numbers_only(app);
  phare::refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? phare::kExitDone : phare::kExitBadInput;
  }
  return phare::make(out, verbose);
}
