// phare measure: illuminance in lux at points, through the picture's own shader or in float64.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "config/base/input_files.h"
#include "config/base/remedies.h"
#include "config/base/whole_file.h"
#include "config/finite_numbers.h"
#include "config/rig.h"
#include "tools/commands.h"
#include "tools/lamp/print_json.h"
#include "tools/reference_table.h"
#include "tools/scene_shadows.h"
#include "visual/fixed_light.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/beam/image_levels.h"
#include "visual/photometry/beam/lamp_tables.h"
#include "visual/photometry/bench/lamp_aim.h"
#include "visual/photometry/readers/points_file.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/scene/ray_hit.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/renderer.h"
#endif

namespace phare {
namespace {

struct MeasureOptions {
  std::string rig_file, points, table, out, method = "fragment", design,
                                            beam_image = level_name(ImageLevel::kFloatNodes);
  std::string street_lamps, scene;
  std::vector<std::string> lamps;
  std::vector<std::string> beams{"low"};
  double max_error = 0.0;  ///< relative; 0: the method's own
  bool validation = false, json = false;
};

/// What each method is held to (relative, where E > 0.01 lx): float32 on the table's nodes through the GPU, half floats
/// there (2^-11), float64. What the texture filter weighs is held to nothing: its error is what there is to say of it.
double limit_of(const MeasureOptions& options) {
  if (options.method == "reference") return 1e-9;
  switch (*level_named(options.beam_image)) {
    case ImageLevel::kFloatNodes:
      return 1e-5;
    case ImageLevel::kHalfNodes:
      return 5e-4;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

Result<LampTables> read_tables(const std::vector<LampConfig>& lamps) {
  LampTables tables;
  for (const LampConfig& lamp : lamps) {
    for (const SourceConfig& source : lamp.sources) {
      if (const Status read = tables.add(source); !read) return read.error();
    }
  }
  return tables;
}

/// Lamps of a design with only the sources that are lit.
Result<std::vector<LampConfig>> lamps_of_rig(const MeasureOptions& options) {
  const auto rig = read_rig(options.rig_file);
  if (!rig) return rig.error();
  if (const Status apart = check_inputs(files_of(*rig), {options.out}); !apart) return apart.error();
  std::set<LampFunction> lit;
  for (std::size_t i = 0; i < kLampFunctionNames.size(); ++i) {
    for (const std::string& beam : options.beams) {
      if (beam == kLampFunctionNames[i]) lit.insert(static_cast<LampFunction>(i));
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
    // All of a lamp's sources turn by what its low beam calls for, whichever are lit.
    if (lamp.aim.kind != AimConfig::Kind::kAsFiled) {
      const auto tables = read_tables({lamp});
      if (!tables) return tables.error();
      aim_lamp(lamp, *tables);
    }
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

/// float64 from the tables themselves. The car stands at the world's origin.
std::vector<Illuminance> measure_reference(const std::vector<LampConfig>& lamps, const LampTables& tables,
                                           const PointsFile& points) {
  std::vector<PlacedSource> sources;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    for (const SourceConfig& source : lamps[i].sources) {
      const AimedSource light = tables.aimed(source);
      sources.push_back({light.table, lamps[i].position_m, light.car_from_lamp, light.scale, i});
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
Result<std::vector<Illuminance>> measure_fragment(const std::vector<LampConfig>& lamps, const LampTables& tables,
                                                  const PointsFile& points, const MeasureOptions& options,
                                                  std::string& device) {
  RendererOptions renderer_options;
  renderer_options.width_px = renderer_options.height_px = 64;  // nothing is drawn to it
  renderer_options.validation = options.validation;
  renderer_options.beam_level = *level_named(options.beam_image);
  auto renderer = Renderer::create(renderer_options);
  if (!renderer) return with_remedy(renderer.error());
  device = renderer->device();
  std::vector<MeasurePoint> at;
  at.reserve(points.rows.size());
  for (const PointRow& row : points.rows) at.push_back({row.position_m, row.normal});
  std::vector<Illuminance> result(at.size(), Illuminance{0.0, std::vector<double>(lamps.size(), 0.0)});

  std::vector<PlacedLamp> placed;
  for (const LampConfig& lamp : lamps) {
    std::vector<AimedSource> aimed;
    for (const SourceConfig& source : lamp.sources) aimed.push_back(tables.aimed(source));
    const BeamImage image = compose_beam_image(aimed);
    renderer->set_beam(placed.size(), image);
    placed.push_back({lamp.position_m, image.car_from_image, placed.size()});
  }
  const auto lux = renderer->measure(placed, at);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    for (std::size_t point = 0; point < at.size(); ++point) {
      const double lx = static_cast<double>(lux[i][point]);
      result[point].lamps_lx[i] = lx;
      result[point].total_lx += lx;
    }
  }
  if (renderer->validation_messages() > 0) return Error{"validation", "the layer has complained (see above)"};
  return result;
}
#endif

/// Of each object, points that lie in its shadow of some lamp.
std::map<std::string, std::size_t> points_in_shadow(const std::optional<std::vector<HiddenBy>>& hidden) {
  std::map<std::string, std::size_t> shadows;
  if (!hidden) return shadows;
  for (const HiddenBy& names : *hidden)
    for (const std::string& name : std::set<std::string>(names.begin(), names.end()))
      if (!name.empty()) ++shadows[name];
  return shadows;
}

void print_shadows(std::FILE* to, const std::map<std::string, std::size_t>& shadows) {
  for (const auto& [name, count] : shadows)
    std::fprintf(to, "  %zu point%s in the shadow of %s\n", count, count == 1 ? "" : "s", name.c_str());
}

/// What stands in the light of the lamp that would be the strongest there, by its node; empty: nothing does.
std::string hides_strongest(const FixedLight& light, const World& world, const PointRow& row, double strongest_lx) {
  const auto hidden = light.hidden_at(row.position_m, row.normal);
  if (hidden.empty() || hidden.front().share.lx <= strongest_lx) return "";
  const SceneChunk* by = occluder(world, hidden.front().from_m, row.position_m);
  return by != nullptr ? name_of(*by) : "";
}

/// The lamps of a scene or of the street are measured, for no car's are named.
bool of_the_street(const MeasureOptions& options) {
  const bool of_a_car = !options.lamps.empty() || !options.rig_file.empty();
  return !options.street_lamps.empty() || (!options.scene.empty() && !of_a_car);
}

/// Street lamps in place of a car's: float64, with the shadows of a scene where one is given. The column of the lamp is
/// that of the strongest that shines there, that of what hides it of the one that would be.
int measure_street(const MeasureOptions& options) {
  if (!options.lamps.empty() || !options.rig_file.empty())
    return bad_input({"--street-lamps", "is measured alone; --lamp and --rig are a car's lamps"});
  if (options.points.empty() || options.out.empty()) return bad_input({"", "give --points FILE and --out FILE"});
  Scene scene;
  if (!options.scene.empty()) {
    auto read = read_scene(options.scene);
    if (!read) return bad_input(read.error());
    scene = std::move(*read);
  }
  const auto light = FixedLight::of(scene, options.street_lamps, std::nullopt);
  if (!light) return bad_input(light.error());
  if (options.street_lamps.empty() && light->street_lamps() + light->directional() == 0)
    return bad_input({options.scene, "has no lamps of its own; --street-lamps names a file of them"});
  const auto points = read_points(options.points);
  if (!points) return bad_input(points.error());
  std::vector<Illuminance> measured;
  std::optional<std::vector<HiddenBy>> hidden;
  if (!options.scene.empty()) hidden.emplace();
  const World world(scene);
  double highest = 0.0;
  for (const PointRow& row : points->rows) {
    const auto shares = light->shares_at(row.position_m, row.normal);
    Illuminance& at = measured.emplace_back();
    for (const FixedLight::Share& share : shares) at.total_lx += share.lx;
    const auto lamp = std::ranges::find(shares, false, &FixedLight::Share::reflected);  // strongest first
    at.lamps_lx = {lamp == shares.end() ? 0.0 : lamp->lx};
    if (hidden) hidden->push_back({hides_strongest(*light, world, row, at.lamps_lx.front())});
    highest = std::max(highest, at.total_lx);
  }
  if (const Status status = write_illuminance(options.out, *points, 1, measured, hidden); !status)
    return bad_input(status.error());
  const auto shadows = points_in_shadow(hidden);
  if (options.json) {
    nlohmann::json report{
        {"out", options.out},        {"method", "reference"},         {"device", "float64 on the CPU"},
        {"points", measured.size()}, {"max_illuminance_lx", highest}, {"street_lamps", light->street_lamps()}};
    if (!options.scene.empty()) report["scene"] = options.scene, report["points_in_shadow_of"] = shadows;
    std::printf("%s\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return kExitDone;
  }
  std::FILE* const told = is_standard_output(options.out) ? stderr : stdout;
  std::fprintf(told, "%s: %zu points, %zu street lamp%s, at most %.6g lx, in float64 on the CPU%s\n",
               options.out.c_str(), measured.size(), light->street_lamps(), light->street_lamps() == 1 ? "" : "s",
               highest, options.scene.empty() ? ", nothing stands in their light" : "");
  print_shadows(told, shadows);
  return kExitDone;
}

/// By the chosen method. `device`: what computed it.
Result<std::vector<Illuminance>> measure_points(const MeasureOptions& options, const std::vector<LampConfig>& lamps,
                                                const LampTables& tables, const PointsFile& points,
                                                std::string& device) {
  if (options.method == "reference") {
    device = "float64 on the CPU";
    return measure_reference(lamps, tables, points);
  }
#ifdef PHARE_WITH_GRAPHICS
  return measure_fragment(lamps, tables, points, options, device);
#else
  return Error{"--method fragment", "this build has no graphics (PHARE_GRAPHICS=OFF); use --method reference"};
#endif
}

/// Every column of a reference table that a photometry file answers for.
int measure_table(const MeasureOptions& options) {
  const auto cases = read_reference_table(options.table);
  if (!cases) return bad_input(cases.error());
  const double limit = options.max_error > 0.0 ? options.max_error : limit_of(options);
  const std::string table_name = std::filesystem::path(options.table).stem().string();
  nlohmann::json report{{"table", options.table}, {"method", options.method}, {"limit", limit}};
  bool within = true;
  std::string device;
  for (const ReferenceCase& asked : *cases) {
    const auto tables = read_tables(asked.lamps);
    if (!tables) return bad_input(tables.error());
    const auto measured = measure_points(options, asked.lamps, *tables, PointsFile{"", asked.points}, device);
    if (!measured) return bad_input(measured.error());
    std::vector<double> total_lx;
    for (const Illuminance& at : *measured) total_lx.push_back(at.total_lx);
    const ReferenceErrors errors = compare(asked, total_lx);
    within = within && errors.judged > 0 && errors.worst_relative <= limit;
    const std::string file = asked.lamps.front().sources.front().file.filename().string();
    if (options.json) {
      report["columns"].push_back({{"column", asked.column},
                                   {"file", file},
                                   {"points", asked.points.size()},
                                   {"judged", errors.judged},
                                   {"worst_relative", errors.worst_relative},
                                   {"worst_line", errors.worst_line},
                                   {"worst_absolute_lx", errors.worst_absolute_lx},
                                   {"highest_lx", errors.highest_lx}});
      continue;
    }
    std::printf(
        "%-16s %-14s %-20s %5zu points, %5zu above %g lx: worst %.2e relative (line %zu); %.2e of the highest\n",
        table_name.c_str(), asked.column.c_str(), file.c_str(), asked.points.size(), errors.judged,
        asked.dim_lx, errors.worst_relative, errors.worst_line,
        errors.highest_lx > 0.0 ? errors.worst_absolute_lx / errors.highest_lx : 0.0);
  }
  report["device"] = device;
  report["within"] = within;
  if (options.json) std::printf("%s\n", report.dump(2).c_str());
  if (!within)
    std::fprintf(stderr, "phare: %s: further than %g from the truth by %s\n", options.table.c_str(), limit,
                 options.method.c_str());
  return within ? kExitDone : kExitCheckFailed;
}

int measure(const MeasureOptions& options) {
  std::vector<std::string> inputs{options.points, options.rig_file, options.scene, options.street_lamps};
  const std::size_t before_lamps = inputs.size();
  for (const std::string& text : options.lamps) {
    auto lamp = parse_lamp_argument(text);
    if (!lamp) return bad_input(lamp.error());
    // Two lamps may share one file, standard input too: it is read once.
    const std::string file = lamp->sources.front().file.string();
    if (std::find(inputs.begin() + static_cast<std::ptrdiff_t>(before_lamps), inputs.end(), file) == inputs.end())
      inputs.push_back(file);
  }
  if (const Status apart = check_inputs(inputs, {options.out}); !apart) return bad_input(apart.error());
  if (const Status alone = json_alone(options.out, options.json); !alone) return bad_input(alone.error());
  if (of_the_street(options)) return measure_street(options);
  if (!options.table.empty()) return measure_table(options);
  if (options.points.empty() || options.out.empty())
    return bad_input({"", "give --points FILE and --out FILE, or --table FILE of a reference set"});
  const auto lamps = chosen_lamps(options);
  if (!lamps) return bad_input(lamps.error());
  const auto tables = read_tables(*lamps);
  if (!tables) return bad_input(tables.error());
  const auto points = read_points(options.points);
  if (!points) return bad_input(points.error());

  Scene scene;
  if (!options.scene.empty()) {
    auto read = read_scene(options.scene);
    if (!read) return bad_input(read.error());
    scene = std::move(*read);
  }

  std::string device;
  auto measured = measure_points(options, *lamps, *tables, *points, device);
  if (!measured) return bad_input(measured.error());
  std::vector<Illuminance>& illuminance = *measured;
  std::optional<std::vector<HiddenBy>> hidden;
  if (!options.scene.empty()) {
    std::vector<glm::dvec3> lamps_m;
    for (const LampConfig& lamp : *lamps) lamps_m.push_back(lamp.position_m);
    hidden = take_shadows(scene, lamps_m, points->rows, illuminance);
  }
  const auto shadows = points_in_shadow(hidden);
  if (const Status status = write_illuminance(options.out, *points, lamps->size(), illuminance, hidden); !status)
    return bad_input(status.error());

  double highest = 0.0;
  for (const Illuminance& at : illuminance) highest = std::max(highest, at.total_lx);
  if (options.json) {
    nlohmann::json report{
        {"out", options.out},           {"method", options.method},      {"device", device},
        {"points", illuminance.size()}, {"max_illuminance_lx", highest}, {"lamps", nlohmann::json::array()}};
    for (const LampConfig& lamp : *lamps) {
      for (const SourceConfig& source : lamp.sources) {
        const IntensityTable& table = tables->of(source);
        report["lamps"].push_back(
            {{"lamp", lamp.name}, {"file", source.file.string()}, {"content_hash", table.content_hash}});
      }
    }
    if (!options.scene.empty()) report["scene"] = options.scene, report["points_in_shadow_of"] = shadows;
    std::printf("%s\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::FILE* const told = is_standard_output(options.out) ? stderr : stdout;
    std::fprintf(told, "%s: %zu points, %zu lamp%s, at most %.6g lx, by %s (%s)\n", options.out.c_str(),
                 illuminance.size(), lamps->size(), lamps->size() == 1 ? "" : "s", highest, options.method.c_str(),
                 device.c_str());
    print_shadows(told, shadows);
  }
  return kExitDone;
}

}  // namespace

void add_measure(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command = app.add_subcommand("measure", "Illuminance in lux at points");
  command->footer(
      "Points: CSV with x_m,y_m,z_m,nx,ny,nz. The answer repeats them and adds illuminance_lx and one column per "
      "lamp;\nwith --scene also hidden_by_1 and so on: the object that stands in that lamp's light, empty where none "
      "does; of street\nlamps in that of the one which would be the strongest.\n"
      "Example:\n  phare measure --lamp low_beam.ies,x=1.5,y=0.6,z=0.65,pitch_deg=-0.573 --points points.csv --out "
      "points_lx.csv\n  phare measure --table road_table/a_road_flat_low.csv --method reference");
  auto* rig = command->add_option("--rig", options->rig_file,
                                  "Rig file whose lamps are measured; the car stands at the origin");
  auto* lamp = command->add_option(
      "--lamp", options->lamps,
      "FILE,x=1.5,y=0.6,z=0.65[,KEY=VALUE…]; repeat for more. Position in m; yaw_deg (left positive), "
      "pitch_deg (up positive), roll_deg [0]; scale [1]; mirror=1 turns left and right round; for type C "
      "and EULUMDAT axis=gamma0|gamma90 and c0_deg [0], where the file's plane C 0 lies; lamp_set "
      "(EULUMDAT) and emitter (TM-33) count from 1; distance_m for a CSV in lx that states none. A file "
      "name may hold commas; one that holds \",word=\" stands in double quotes, a quote in it doubled");
  lamp->allow_extra_args(false)->excludes(rig);
  command->add_option("--design", options->design, "Design of the rig [its first]")->needs(rig);
  command->add_option("--beams", options->beams, "Lit functions of the rig, joined by commas")
      ->needs(rig)
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(kLampFunctionNames.begin(), kLampFunctionNames.end())))
      ->capture_default_str();
  auto* street = command->add_option(
      "--street-lamps", options->street_lamps,
      "Instead of a car's lamps: a file of street lamps (docs/street-lamps.md), in float64; lamp 1 is the "
      "strongest of them at each point");
  auto* scene = command->add_option(
      "--scene", options->scene,
      "glTF whose shadows count, by ray. With --lamp or --rig: in a car's light, and the object that "
      "shades is named; without: in that of its own lamps, which are measured, and of --street-lamps, likewise");
  auto* points = command->add_option("--points", options->points, "Points file; \"-\" is standard input");
  auto* out = command->add_option("--out", options->out, "File to write");
  auto* table = command->add_option(
      "--table", options->table,
      "Instead of points: a table of a photometry reference set (manifest.json beside it), held against "
      "every photometry file it knows; exit 1 when one is further off than --max-error");
  for (auto* other : {rig, lamp, street, scene, points, out}) table->excludes(other);
  command
      ->add_option("--max-error", options->max_error,
                   "With --table: relative, where more than 0.01 lx is expected [fragment: 1e-5; reference: 1e-9]")
      ->check(number_within(1e-30, 1e30))
      ->needs(table);
  auto* method =
      command->add_option("--method", options->method,
                          "fragment: the shader that draws the frame; reference: float64, here on the processor");
  method->check(CLI::IsMember({"fragment", "reference"}))->capture_default_str();
  auto* image = command->add_option(
      "--beam-image", options->beam_image,
      "With --method fragment: how beam images are stored and looked up, from the 1999 paper's texture to "
      "the table's own nodes");
  image->check(CLI::IsMember(level_names()))->capture_default_str();
  command->add_flag("--validation", options->validation, "Vulkan validation with synchronization validation");
  command->add_flag("--json", options->json, "Print a summary as JSON");
  command->callback([options, method, image, &chosen] {
    const bool street = of_the_street(*options);
    if (street && method->count() > 0 && options->method == "fragment")
      throw CLI::ValidationError("--method fragment", "is of a car's lamps; those of a scene or street are in float64");
    const std::string of_float64 =
        street ? "the lamps of a scene or street are in float64" : "goes with --method fragment";
    const bool float64 = street || options->method == "reference";
    if (float64 && image->count() > 0) throw CLI::ValidationError("--beam-image " + options->beam_image, of_float64);
    if (float64 && options->validation) throw CLI::ValidationError("--validation", of_float64);
    chosen = [options] { return measure(*options); };
  });
}

}  // namespace phare
