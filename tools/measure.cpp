// phare measure: illuminance in lux at points, through the picture's own shader or in float64.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "config/rig.h"
#include "tools/commands.h"
#include "visual/photometry/beam_image.h"
#include "visual/photometry/illuminance.h"
#include "visual/photometry/points_file.h"
#include "visual/photometry/read_lamp.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/renderer.h"
#endif

namespace phare {
namespace {

struct MeasureOptions {
  std::string rig_file, points, out, method = "fragment", design;
  std::vector<std::string> lamps;
  std::vector<std::string> beams{"low"};
  bool validation = false, json = false;
};

constexpr std::array<const char*, 6> kFunctionNames{"position", "low", "high", "fog", "daytime", "cornering"};

/// Lamps of a design with only the sources that are lit.
Result<std::vector<LampConfig>> lamps_of_rig(const MeasureOptions& options) {
  const auto rig = read_rig(options.rig_file);
  if (!rig) return rig.error();
  std::set<LampFunction> lit;
  for (std::size_t i = 0; i < kFunctionNames.size(); ++i) {
    for (const std::string& beam : options.beams) {
      if (beam == kFunctionNames[i]) lit.insert(static_cast<LampFunction>(i));
    }
  }
  const DesignConfig* design = options.design.empty() ? &rig->designs.front() : nullptr;
  std::string names;
  for (const DesignConfig& candidate : rig->designs) {
    if (candidate.name == options.design) design = &candidate;
    names += (names.empty() ? "" : ", ") + candidate.name;
  }
  if (design == nullptr) return Error{"--design " + options.design, "the rig has " + names};
  std::vector<LampConfig> lamps;
  for (LampConfig lamp : design->lamps) {
    std::erase_if(lamp.sources, [&](const SourceConfig& source) { return !lit.contains(source.function); });
    if (!lamp.sources.empty()) lamps.push_back(std::move(lamp));
  }
  if (lamps.empty()) return Error{"--beams", "no lamp of design " + design->name + " has them"};
  return lamps;
}

Result<std::vector<LampConfig>> chosen_lamps(const MeasureOptions& options) {
  if (options.lamps.empty() && options.rig_file.empty()) return Error{"", "give --rig FILE or --lamp FILE,x=…,y=…,z=…"};
  if (options.lamps.empty()) return lamps_of_rig(options);
  std::vector<LampConfig> lamps;
  for (const std::string& text : options.lamps) {
    auto lamp = parse_lamp_argument(text);
    if (!lamp) return lamp.error();
    lamps.push_back(std::move(*lamp));
  }
  return lamps;
}

using Tables = std::map<std::pair<std::string, GammaAxis>, IntensityTable>;

Result<Tables> read_tables(const std::vector<LampConfig>& lamps) {
  Tables tables;
  for (const LampConfig& lamp : lamps) {
    for (const SourceConfig& source : lamp.sources) {
      const auto key = std::make_pair(source.file.string(), source.axis);
      if (tables.contains(key)) continue;
      auto table = read_lamp(source.file, {.axis = source.axis, .folder = {}});
      if (!table) return table.error();
      tables.emplace(key, std::move(*table));
    }
  }
  return tables;
}

const IntensityTable& table_of(const Tables& tables, const SourceConfig& source) {
  return tables.at({source.file.string(), source.axis});
}

/// float64 from the tables themselves. The car stands at the world's origin.
std::vector<Illuminance> measure_reference(const std::vector<LampConfig>& lamps, const Tables& tables,
                                           const PointsFile& points) {
  std::vector<PlacedSource> sources;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    for (const SourceConfig& source : lamps[i].sources) {
      sources.push_back({&table_of(tables, source), lamps[i].position_m,
                         aim_rotation(source.yaw_rad, source.pitch_rad, source.roll_rad), source.scale, i});
    }
  }
  std::vector<Illuminance> result;
  result.reserve(points.rows.size());
  for (const PointRow& row : points.rows)
    result.push_back(illuminance_lx(sources, lamps.size(), row.position_m, row.normal));
  return result;
}

#ifdef PHARE_WITH_GRAPHICS
/// Through the shader that draws the frame.
Result<std::vector<Illuminance>> measure_fragment(const std::vector<LampConfig>& lamps, const Tables& tables,
                                                  const PointsFile& points, bool validation, std::string& device) {
  RendererOptions renderer_options;
  renderer_options.width_px = renderer_options.height_px = 64;  // nothing is drawn to it
  renderer_options.validation = validation;
  auto renderer = Renderer::create(renderer_options);
  if (!renderer) return renderer.error();
  device = renderer->device();
  std::vector<MeasurePoint> at;
  at.reserve(points.rows.size());
  for (const PointRow& row : points.rows) at.push_back({row.position_m, row.normal});
  std::vector<Illuminance> result(at.size(), Illuminance{0.0, std::vector<double>(lamps.size(), 0.0)});

  constexpr std::size_t kSlots = 8;  // beam images a renderer holds
  for (std::size_t first = 0; first < lamps.size(); first += kSlots) {
    const std::size_t count = std::min(kSlots, lamps.size() - first);
    std::vector<PlacedLamp> placed;
    for (std::size_t i = 0; i < count; ++i) {
      const LampConfig& lamp = lamps[first + i];
      std::vector<AimedSource> aimed;
      for (const SourceConfig& source : lamp.sources) {
        aimed.push_back({&table_of(tables, source), aim_rotation(source.yaw_rad, source.pitch_rad, source.roll_rad),
                         source.scale, source.colour_temperature_k});
      }
      const BeamImage image = compose_beam_image(aimed);
      renderer->set_beam(i, image);
      placed.push_back({lamp.position_m, image.car_from_image, i});
    }
    const auto lux = renderer->measure(placed, at);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t point = 0; point < at.size(); ++point) {
        const double lx = static_cast<double>(lux[i][point]);
        result[point].lamps_lx[first + i] = lx;
        result[point].total_lx += lx;
      }
    }
  }
  if (renderer->validation_messages() > 0) return Error{"validation", "the layer has complained (see above)"};
  return result;
}
#endif

int measure(const MeasureOptions& options) {
  const auto lamps = chosen_lamps(options);
  if (!lamps) return bad_input(lamps.error());
  const auto tables = read_tables(*lamps);
  if (!tables) return bad_input(tables.error());
  const auto points = read_points(options.points);
  if (!points) return bad_input(points.error());

  std::vector<Illuminance> illuminance;
  std::string device = "float64 on the CPU";
  if (options.method == "reference") {
    illuminance = measure_reference(*lamps, *tables, *points);
  } else {
#ifdef PHARE_WITH_GRAPHICS
    auto measured = measure_fragment(*lamps, *tables, *points, options.validation, device);
    if (!measured) return bad_input(measured.error());
    illuminance = std::move(*measured);
#else
    return bad_input({"--method fragment", "this build has no graphics (PHARE_GRAPHICS=OFF); use --method reference"});
#endif
  }
  if (const Status status = write_illuminance(options.out, *points, illuminance); !status)
    return bad_input(status.error());

  double highest = 0.0;
  for (const Illuminance& at : illuminance) highest = std::max(highest, at.total_lx);
  if (options.json) {
    nlohmann::json report{
        {"out", options.out},           {"method", options.method},      {"device", device},
        {"points", illuminance.size()}, {"max_illuminance_lx", highest}, {"lamps", nlohmann::json::array()}};
    for (const LampConfig& lamp : *lamps) {
      for (const SourceConfig& source : lamp.sources) {
        const IntensityTable& table = table_of(*tables, source);
        report["lamps"].push_back(
            {{"lamp", lamp.name}, {"file", source.file.string()}, {"content_hash", table.content_hash}});
      }
    }
    std::printf("%s\n", report.dump(2).c_str());
  } else {
    std::printf("%s: %zu points, %zu lamps, at most %.6g lx, by %s (%s)\n", options.out.c_str(), illuminance.size(),
                lamps->size(), highest, options.method.c_str(), device.c_str());
  }
  return kExitDone;
}

}  // namespace

void add_measure(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command = app.add_subcommand("measure", "Illuminance in lux at points");
  command->footer(
      "Points: CSV with x_m,y_m,z_m,nx,ny,nz. The answer repeats them and adds illuminance_lx and one column per "
      "lamp.\n"
      "Example:\n  phare measure --lamp low.ies,x=1.5,y=0.6,z=0.65,pitch_deg=-0.573 --points road.csv --out "
      "road_lx.csv");
  command->add_option("--rig", options->rig_file, "Rig file whose lamps are measured; the car stands at the origin");
  command
      ->add_option("--lamp", options->lamps,
                   "FILE,x=1.5,y=0.6,z=0.65[,yaw_deg=0][,pitch_deg=-0.573][,roll_deg=0][,axis=gamma0|gamma90][,scale=1]"
                   "; repeat for more")
      ->allow_extra_args(false);
  command->add_option("--design", options->design, "Design of the rig [its first]");
  command
      ->add_option("--beams", options->beams,
                   "Lit functions of the rig: position low high fog daytime cornering, joined by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"position", "low", "high", "fog", "daytime", "cornering"}))
      ->capture_default_str();
  command->add_option("--points", options->points, "Points file")->required();
  command->add_option("--out", options->out, "File to write")->required();
  command->add_option("--method", options->method, "fragment: the shader that draws the frame; reference: float64")
      ->check(CLI::IsMember({"fragment", "reference"}))
      ->capture_default_str();
  command->add_flag("--validation", options->validation, "Vulkan validation with synchronization validation");
  command->add_flag("--json", options->json, "Print a summary as JSON");
  command->callback([options, &chosen] { chosen = [options] { return measure(*options); }; });
}

}  // namespace phare
