// phare lamp convert: any format to LM-63-2019, EULUMDAT or CSV; sums and mirror images.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "visual/photometry/combine.h"
#include "visual/photometry/file_text.h"
#include "visual/photometry/whole_file.h"
#include "visual/photometry/write_lamp.h"

namespace phare {
namespace {

/// Worst difference at the nodes of `table` between it and what was written, in cd.
double worst_at_nodes(const IntensityTable& table, const IntensityTable& written) {
  double worst = 0.0;
  const std::size_t columns = table.first_deg.size();
  for (std::size_t k = 0; k < table.candela.size(); ++k) {
    const glm::dvec3 d = table.direction_of({table.first_deg[k % columns], table.second_deg[k / columns]});
    if (d.x <= 1e-9) continue;  // poles and edges, where a direction has many angles
    worst = std::max(worst, std::abs(table.candela[k] - written.intensity_cd(d)));
  }
  return worst;
}

}  // namespace

int lamp_convert(const LampConvertOptions& options) {
  std::vector<IntensityTable> tables;
  for (const std::string& file : options.files) {
    auto table = read_lamp(file, options.settings);
    if (!table) return bad_input(table.error());
    tables.push_back(std::move(*table));
  }
  std::vector<const IntensityTable*> pointers;
  for (const IntensityTable& table : tables) pointers.push_back(&table);
  IntensityTable table = tables.size() == 1 ? tables.front() : sum_tables(pointers);
  if (tables.size() > 1) {
    table.name = std::filesystem::path(options.out).filename().string();
    table.header.keywords = tables.front().header.keywords;
    std::string names;
    for (const IntensityTable& part : tables) names += (names.empty() ? "" : ", ") + part.name;
    table.header.keywords.emplace_back("OTHER", "Sum of " + names.substr(0, 4000));
  }
  if (options.mirror) {
    mirror_left_right(table);
    table.header.keywords.emplace_back("OTHER", "Mirrored left to right");
  }
  std::string format = options.format;
  if (format.empty()) {
    const std::string ending = upper_case(std::filesystem::path(options.out).extension().string());
    format = ending == ".LDT" ? "eulumdat" : ending == ".CSV" ? "csv" : ending == ".IES" ? "lm63" : "";
  }
  if (format.empty()) return bad_input({options.out, "ends in none of .ies, .ldt, .csv; say --format"});
  const std::string text = format == "eulumdat" ? eulumdat_text(table)
                           : format == "csv"    ? csv_text(table)
                                                : lm63_text(table);
  if (const Status written = write_whole_file(options.out, text); !written) return bad_input(written.error());

  // Read back what was written: the truth about the round trip.
  LampReadSettings settings;
  settings.axis = format == "eulumdat" ? GammaAxis::kGamma0 : table.axis;
  settings.format = format == "eulumdat" ? LampFormat::kEulumdat
                    : format == "csv"    ? LampFormat::kCsv
                                         : LampFormat::kLm63;
  const auto back = parse_lamp(text, options.out, settings);
  if (!back) return bad_input(back.error());
  const double worst = worst_at_nodes(table, *back);
  std::FILE* const words = is_standard_output(options.out) ? stderr : stdout;
  std::fprintf(words, "%s: %s, type %d, %zu × %zu values; worst difference at a node of the input %.3g cd (%.2g of the peak)\n",
              options.out.c_str(), back->version.c_str(), static_cast<int>(back->type), back->first_deg.size(),
              back->second_deg.size(), worst, worst / std::max(table.peak_cd(), 1e-300));
  return kExitDone;
}

}  // namespace phare
