// phare lamp convert: any format to LM-63-2019, EULUMDAT or CSV; sums and mirror images.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "config/base/whole_file.h"
#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/print_json.h"
#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/bench/lint.h"
#include "visual/photometry/readers/file_text.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

/// A sum says what its parts agree on, and of what it is the sum.
void describe_sum(IntensityTable& sum, const std::vector<IntensityTable>& parts) {
  std::string names;
  for (const IntensityTable& part : parts) names += (names.empty() ? "" : ", ") + part.name;
  for (const auto& keyword : parts.front().header.keywords) {
    const bool shared = std::all_of(parts.begin(), parts.end(), [&](const IntensityTable& part) {
      const auto& all = part.header.keywords;
      return std::find(all.begin(), all.end(), keyword) != all.end();
    });
    if (shared) sum.header.keywords.push_back(keyword);
  }
  sum.header.keywords.emplace_back("OTHER", "Sum of " + names.substr(0, 4000));
  char flux[80];
  std::snprintf(flux, sizeof flux, "Flux %.1f lm (integral of this table), peak %.0f cd", sum.flux_lm(), sum.peak_cd());
  sum.header.keywords.emplace_back("OTHER", flux);
}

/// Keywords that name the other side of the road than the cut-off shows now are turned with it. A file that was stored
/// mirrored and is set right by this keeps its words.
void describe_mirror(IntensityTable& table) {
  const CutoffSide side = cutoff_shape(mounted_intensity(table, glm::dmat3{1.0})).side;
  if (side == CutoffSide::kRisesRight || side == CutoffSide::kRisesLeft) {
    for (auto& [key, value] : table.header.keywords) value = with_traffic_side(value, side == CutoffSide::kRisesLeft);
  }
  table.header.keywords.emplace_back("OTHER", "Mirrored left to right by phare lamp convert");
}

nlohmann::json as_json(const std::string& out, const std::string& format, const IntensityTable& back,
                       const std::vector<std::string>& files, const TableDifference& worst, double peak_cd) {
  return {{"out", out},
          {"format", format},
          {"version", back.version},
          {"photometric_type", type_name(back)},
          {"axis", back.type != PhotometricType::kC   ? ""
                   : back.axis == GammaAxis::kGamma90 ? "gamma90"
                                                      : "gamma0"},
          {"first_count", back.first_deg.size()},
          {"second_count", back.second_deg.size()},
          {"files", files},
          {"flux_lm", back.flux_lm()},
          {"peak_cd", back.peak_cd()},
          {"worst_difference_cd", worst.worst_cd},
          {"worst_difference_of_peak", worst.worst_cd / std::max(peak_cd, 1e-300)},
          {"worst_at_deg", {worst.at.first_deg, worst.at.second_deg}},
          {"compared_directions", worst.looked_at}};
}

}  // namespace

int lamp_convert(const LampConvertOptions& options) {
  if (const Status alone = json_alone(options.out, options.json); !alone) return bad_input(alone.error());
  std::vector<IntensityTable> parts;
  for (const std::string& file : options.files) {
    auto table = read_lamp(file, options.settings);
    if (!table) return bad_input(table.error());
    parts.push_back(std::move(*table));
  }
  std::vector<const IntensityTable*> pointers;
  for (const IntensityTable& part : parts) pointers.push_back(&part);
  IntensityTable table = parts.size() == 1 ? parts.front() : sum_tables(pointers);
  if (parts.size() > 1) {
    table.name = std::filesystem::path(options.out).filename().string();
    describe_sum(table, parts);
  }
  if (options.settings.mirror_h) describe_mirror(table);
  std::string format = options.format;
  if (format.empty()) {
    const std::string ending = upper_case(std::filesystem::path(options.out).extension().string());
    format = ending == ".LDT" ? "eulumdat" : ending == ".CSV" ? "csv" : ending == ".IES" ? "lm63" : "";
  }
  if (format.empty()) return bad_input({options.out, "ends in none of .ies, .ldt, .csv; say --to"});
  if (options.out_axis_given && format != "eulumdat")
    return bad_input({"--out-axis", "is for EULUMDAT; other formats keep the table's own angles"});
  const std::string text = format == "eulumdat" ? eulumdat_text(table, options.out_axis)
                           : format == "csv"    ? csv_text(table)
                                                : lm63_text(table);
  if (const Status written = write_whole_file(options.out, text); !written) return bad_input(written.error());

  // Read back what was written: the truth about the round trip.
  LampReadSettings settings;
  settings.axis = format == "eulumdat" ? options.out_axis : table.axis;
  settings.format = format == "eulumdat" ? LampFormat::kEulumdat
                    : format == "csv"    ? LampFormat::kCsv
                                         : LampFormat::kLm63;
  const auto back = parse_lamp(text, options.out, settings);
  if (!back) return bad_input(back.error());
  const TableDifference worst = difference_from_sum(pointers, *back);
  const double peak_cd = table.peak_cd();
  if (options.json) {
    print_json(as_json(options.out, format, *back, options.files, worst, peak_cd));
    return kExitDone;
  }
  std::string hint;
  if (worst.worst_cd > 1e-9 * peak_cd) {
    const bool a_to_axis = format == "eulumdat" && options.out_axis == GammaAxis::kGamma0 &&
                           table.type == PhotometricType::kA && table.screen_distance_m <= 0.0;
    hint = a_to_axis          ? "; resampled: --out-axis gamma90 keeps the nodes"
           : parts.size() > 1 ? "; the parts' grids differ and were resampled"
                              : "; resampled";
  }
  std::fprintf(
      is_standard_output(options.out) ? stderr : stdout,
      "%s: %s, type %s%s, %zu × %zu values; worst difference from the %s %.3g cd (%.2g of the peak) among %zu "
      "directions%s\n",
      options.out.c_str(), back->version.c_str(), type_name(*back).c_str(),
      back->type == PhotometricType::kC && back->axis == GammaAxis::kGamma90 ? " (read with --axis gamma90)" : "",
      back->first_deg.size(), back->second_deg.size(), parts.size() > 1 ? "sum of the parts" : "input", worst.worst_cd,
      worst.worst_cd / std::max(peak_cd, 1e-300), worst.looked_at, hint.c_str());
  return kExitDone;
}

}  // namespace phare
