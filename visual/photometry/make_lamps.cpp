// phare-make-lamps: writes the sample lamps and lamps.json, reads them back and checks them against their regulation
// rows.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "visual/photometry/beam_image.h"
#include "visual/photometry/regulation.h"
#include "visual/photometry/sample_lamps.h"

namespace phare {
namespace {

bool write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
  return static_cast<bool>(stream);
}

/// Prints every failed row, and all with `verbose`. Returns the count of the failed.
int report(const std::string& lamp, const std::string& rule, const std::vector<RowResult>& results, bool verbose) {
  int failed = 0;
  for (const RowResult& row : results) {
    if (!row.passed) ++failed;
    if (row.passed && !verbose) continue;
    std::printf("%-16s %-28s %-22s %9.1f … %9.1f cd, allowed %.1f … %.5g  %s\n", lamp.c_str(), rule.c_str(),
                row.id.c_str(), row.lowest_cd, row.highest_cd, row.min_cd, row.max_cd,
                row.passed ? "passed" : "FAILED");
  }
  return failed;
}

/// Sharpness and linearity of a passing beam's cut-off (UN R149: 0.13 ≤ G ≤ 0.40, spread at 1.5°, 2.5°, 3.5° at most
/// 0.2°).
int check_cutoff(const SampleLamp& lamp, const IntensityTable& table, const glm::dmat3& aim, nlohmann::json& entry) {
  const double side = lamp.kind == SampleKind::kLowLeft ? 1.0 : -1.0;
  double low = 90.0, high = -90.0;
  for (const double h : {1.5, 2.5, 3.5}) {
    const double v = find_cutoff(table, aim, side * h).elevation_deg;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const Cutoff cutoff = find_cutoff(table, aim, side * 2.5);
  entry["sharpness_g"] = cutoff.sharpness_g;
  entry["cutoff_elevation_deg"] = cutoff.elevation_deg;
  const bool passed = cutoff.sharpness_g >= 0.13 && cutoff.sharpness_g <= 0.40 && high - low <= 0.2 &&
                      std::abs(cutoff.elevation_deg + 0.57) <= 0.05;
  std::printf("%-16s cut-off at %.2f deg, spread %.2f deg, G = %.3f  %s\n", lamp.file.c_str(), cutoff.elevation_deg,
              high - low, cutoff.sharpness_g, passed ? "passed" : "FAILED");
  return passed ? 0 : 1;
}

int make(const std::filesystem::path& out, bool verbose) {
  std::error_code code;
  std::filesystem::create_directories(out, code);
  if (code) {
    std::fprintf(stderr, "%s: %s\n", out.c_str(), code.message().c_str());
    return kExitBadInput;
  }
  std::filesystem::remove(out / "lamps.json", code);
  int failed = 0;
  nlohmann::json list = nlohmann::json::array();
  for (const SampleLamp& lamp : sample_lamps()) {
    if (!write_text(out / lamp.file, lm63_text(lamp))) return kExitBadInput;
    const auto read = read_lm63(out / lamp.file);
    if (!read) {
      std::fprintf(stderr, "%s\n", read.error().text().c_str());
      return kExitCheckFailed;
    }
    const IntensityTable& table = *read;
    if (table.candela != lamp.table.candela || table.first_deg != lamp.table.first_deg ||
        table.second_deg != lamp.table.second_deg) {
      std::printf("%-16s what was read back differs from what was written  FAILED\n", lamp.file.c_str());
      ++failed;
    }
    const std::size_t at =
        static_cast<std::size_t>(std::max_element(table.candela.begin(), table.candela.end()) - table.candela.begin());
    nlohmann::json entry{{"file", lamp.file},
                         {"description", lamp.description},
                         {"peak_cd", table.peak_cd()},
                         {"peak_h_deg", table.first_deg[at % table.first_deg.size()]},
                         {"peak_v_deg", table.second_deg[at / table.first_deg.size()]},
                         {"flux_lm", table.flux_lm()},
                         {"mount_pitch_deg", glm::degrees(sample_pitch_rad())},
                         {"content_hash", table.content_hash}};
    const glm::dmat3 down = aim_rotation(0.0, sample_pitch_rad(), 0.0);
    switch (lamp.kind) {
      case SampleKind::kLowRight:
      case SampleKind::kLowLeft:
        entry["function"] = "low";
        failed += report(lamp.file, "R149 class C",
                         check_rows(table, down, r149_passing_class_c(), lamp.kind == SampleKind::kLowLeft), verbose);
        failed += check_cutoff(lamp, table, down, entry);
        if (table.flux_lm() < 1000.0) {  // R149 class C: objective luminous flux at least 1,000 lm
          std::printf("%-16s flux %.1f lm is below 1000 lm  FAILED\n", lamp.file.c_str(), table.flux_lm());
          ++failed;
        }
        break;
      case SampleKind::kHigh:
        entry["function"] = "high";
        for (const auto& [mounted, aim] : {std::pair{"level", glm::dmat3{1.0}}, {"1 % down", down}}) {
          failed += report(lamp.file, std::string("R149 class B, ") + mounted,
                           check_rows(table, aim, r149_driving_class_b()), verbose);
          failed += report(lamp.file, std::string("R149 class A, ") + mounted,
                           check_rows(table, aim, r149_driving_class_a()), verbose);
          failed += report(lamp.file, std::string("FMVSS UB2, ") + mounted,
                           check_rows(table, aim, fmvss108_upper_ub2()), verbose);
        }
        break;
      case SampleKind::kFog:
        entry["function"] = "fog";
        break;
    }
    std::printf("%-16s %6.0f cd at %+.2f, %+.2f deg, %6.1f lm\n", lamp.file.c_str(), table.peak_cd(),
                entry["peak_h_deg"].get<double>(), entry["peak_v_deg"].get<double>(), table.flux_lm());
    list.push_back(std::move(entry));
  }
  if (failed > 0) {
    std::printf("%d check(s) failed\n", failed);
    return kExitCheckFailed;
  }
  // Written last: where it is, the lamps are whole and passed.
  const bool written = write_text(out / "lamps.json", nlohmann::json{{"lamps", list}}.dump(2) + "\n");
  return written ? kExitDone : kExitBadInput;
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? phare::kExitDone : phare::kExitBadInput;
  }
  return phare::make(out, verbose);
}
