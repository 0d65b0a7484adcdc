#include "vehicle_dynamics/batch_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "config/fail.h"
#include "config/whole_file.h"
#include "net/clock.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/compare.h"
#include "vehicle_dynamics/reference.h"
#include "vehicle_dynamics/work_precision.h"

namespace phare {
namespace {

std::size_t index_of(const std::string& text, std::initializer_list<const char*> names) {
  std::size_t i = 0;
  for (const char* name : names) {
    if (text == name) return i;
    ++i;
  }
  return 0;
}

// CLI::Range lets NaN pass.
CLI::Validator within(double least, double most) {
  char text[64];
  std::snprintf(text, sizeof text, "%g to %g", least, most);
  const std::string range = text;
  return CLI::Validator(
      [=](const std::string& given) -> std::string {
        double value = 0.0;
        const bool number = CLI::detail::lexical_cast(given, value);
        return number && value >= least && value <= most ? "" : given + " is not within " + range;
      },
      range);
}

}  // namespace

struct BatchCommand::Options {
  const CLI::App* app = nullptr;
  std::string in, compare_with, out, vehicle, integrator, tyre = "magic", attitude = "dynamic", road,
                                                          resistance = "auto", levelling, roughness;
  double step_s = 0.002, output_hz = 100.0, speed_mps = 0.0, start_x_m = 0.0, friction = 1.0, envelope_m = 0.1,
         relaxation_scale = 1.0;
  std::uint64_t seed = 1;
  bool work_precision = false;
};

BatchCommand::BatchCommand() : options_(std::make_unique<Options>()) {}
BatchCommand::~BatchCommand() = default;

void BatchCommand::add_to(CLI::App& app) {
  Options& o = *options_;
  o.app = &app;
  const std::string group = "Batch";
  app.add_option("--batch", o.in, "Run these inputs (CSV, at most 100 h and 2 GiB) instead of a rig")->group(group);
  app.add_option("--out", o.out,
                 "Batch: motion (CSV, at most 50 million rows); there whole or, after an error, not at all")
      ->group(group);
  app.add_option("--vehicle", o.vehicle, "Batch: vehicle file (TOML)")->group(group);
  app.add_option("--integrator", o.integrator,
                 "Batch: semi-implicit-euler, etd2, rk4 or reference (default: as in real time, "
                 "rk4 for full and etd2 for single-track)")
      ->check(CLI::IsMember({"semi-implicit-euler", "etd2", "rk4", "reference"}))
      ->group(group);
  app.add_option("--step-s", o.step_s, "Batch: fixed step, s (default 0.002)")->check(within(1e-6, 0.1))->group(group);
  app.add_option("--output-hz", o.output_hz, "Batch: rows a second")->check(within(0.01, 1e5))->group(group);
  app.add_option("--speed-mps", o.speed_mps, "Batch: speed at the start")->check(within(-60.0, 120.0))->group(group);
  app.add_option("--start-x-m", o.start_x_m, "Batch: x of the centre of gravity at the start")
      ->check(within(-1e8, 1e8))
      ->group(group);
  app.add_option("--road", o.road, "Batch: glTF with a road, or height profile (CSV: x_m, z_m or z_left_m, z_right_m)")
      ->group(group);
  app.add_option("--roughness", o.roughness, "Batch: ISO 8608 class A to E on top of the road")->group(group);
  app.add_option("--seed", o.seed, "Batch: of the roughness, 0 to 2^64 - 1")
      ->check(CLI::Validator(
          [](const std::string& given) -> std::string {
            std::uint64_t value = 0;
            const char* const end = given.data() + given.size();
            const auto [stop, error] = std::from_chars(given.data(), end, value);
            return error == std::errc() && stop == end ? "" : given + " is not a whole number from 0 to 2^64 - 1";
          },
          "UINT"))
      ->group(group);
  app.add_option("--envelope-m", o.envelope_m, "Batch: length over which a tyre averages a profile; 0: point contact")
      ->check(within(0.0, 1.0))
      ->group(group);
  app.add_option("--friction", o.friction, "Batch: of the whole road, 1 as the tyre was measured")
      ->check(within(0.01, 2.0))
      ->group(group);
  app.add_option("--tyre", o.tyre, "Batch, single-track: magic or linear")
      ->check(CLI::IsMember({"magic", "linear"}))
      ->group(group);
  app.add_option("--attitude", o.attitude, "Batch, single-track: dynamic or quasi-static")
      ->check(CLI::IsMember({"dynamic", "quasi-static"}))
      ->group(group);
  app.add_option("--resistance", o.resistance,
                 "Batch: air and rolling resistance; auto: off when wheel torques are given")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->group(group);
  app.add_option("--relaxation-scale", o.relaxation_scale, "Batch: multiplies the tyre's relaxation lengths")
      ->check(within(0.01, 100.0))
      ->group(group);
  app.add_option("--compare", o.compare_with,
                 "Run the reference manoeuvres of this directory and say how far we are off")
      ->group(group);
  app.add_flag("--work-precision", o.work_precision,
               "Print error and cost of every level, integrator and step (--vehicle)")
      ->group(group);
  app.add_option(
         "--levelling", o.levelling,
         "Headlamp levelling: none, manual (batch only), static or dynamic (default: live the vehicle's, batch none)")
      ->check(CLI::IsMember({"none", "manual", "static", "dynamic"}));
}

bool BatchCommand::asked() const {
  return !options_->in.empty() || !options_->compare_with.empty() || options_->work_precision;
}

std::optional<levelling::Kind> BatchCommand::levelling() const {
  if (options_->levelling.empty()) return std::nullopt;
  return static_cast<levelling::Kind>(index_of(options_->levelling, {"none", "manual", "static", "dynamic"}));
}

namespace {

enum class Run { kLive, kBatch, kCompare, kWorkPrecision };

struct Use {
  const char* option;
  std::initializer_list<Run> runs;
};

const Use kUses[] = {{"--rig", {Run::kLive}},
                     {"--lockstep", {Run::kLive}},
                     {"--drive", {Run::kLive}},
                     {"--stats", {Run::kLive}},
                     {"--port-base", {Run::kLive}},
                     {"--level", {Run::kLive, Run::kBatch}},
                     {"--levelling", {Run::kLive, Run::kBatch}},
                     {"--vehicle", {Run::kBatch, Run::kCompare, Run::kWorkPrecision}},
                     {"--integrator", {Run::kBatch, Run::kCompare}},
                     {"--step-s", {Run::kBatch, Run::kCompare}},
                     {"--out", {Run::kBatch}},
                     {"--output-hz", {Run::kBatch}},
                     {"--speed-mps", {Run::kBatch}},
                     {"--start-x-m", {Run::kBatch}},
                     {"--road", {Run::kBatch}},
                     {"--roughness", {Run::kBatch}},
                     {"--seed", {Run::kBatch}},
                     {"--envelope-m", {Run::kBatch}},
                     {"--friction", {Run::kBatch}},
                     {"--tyre", {Run::kBatch}},
                     {"--attitude", {Run::kBatch}},
                     {"--resistance", {Run::kBatch}},
                     {"--relaxation-scale", {Run::kBatch}}};

}  // namespace

Status BatchCommand::options_fit() const {
  const CLI::App& app = *options_->app;
  Run run = Run::kLive;
  const char* named = nullptr;
  for (const auto& [option, kind] :
       {std::pair{"--batch", Run::kBatch}, {"--compare", Run::kCompare}, {"--work-precision", Run::kWorkPrecision}}) {
    if (app.count(option) == 0) continue;
    if (named) return Error{option, std::string("does not go with ") + named};
    named = option, run = kind;
  }
  for (const Use& use : kUses)
    if (app.count(use.option) > 0 && std::find(use.runs.begin(), use.runs.end(), run) == use.runs.end())
      return Error{use.option,
                   named ? std::string("means nothing with ") + named : "belongs to a run without a rig, see --batch"};
  if (options_->integrator == "reference" || options_->work_precision) return ReferenceIntegrator::there();
  return Done{};
}

namespace {

// Options that a level would pass over without a word.
Status level_uses(const CLI::App& app, Level level) {
  const std::string at = std::string("level ") + name(level) + " ";
  if (level != Level::kSingleTrack)
    for (const char* option : {"--tyre", "--attitude"})
      if (app.count(option) > 0) return Error{option, at + "has no such choice, single-track has"};
  if (level == Level::kKinematic)
    for (const auto& [option, why] : {std::pair{"--integrator", "has an exact method of its own"},
                                      {"--friction", "has no tyres, its grip is the vehicle's max_lateral_mps2"},
                                      {"--relaxation-scale", "has no tyres"}})
      if (app.count(option) > 0) return Error{option, at + why};
  return Done{};
}

// The same file under whatever name; a terminal may well be both input and output.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code code;
  return !b.empty() && std::filesystem::is_regular_file(a, code) && std::filesystem::equivalent(a, b, code);
}

std::optional<Integrator> integrator_named(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return static_cast<Integrator>(index_of(text, {"semi-implicit-euler", "etd2", "rk4", "reference"}));
}

int run_compare(const std::string& directory, const std::string& vehicle, std::optional<Integrator> integrator,
                double step_s) {
  if (vehicle.empty()) return fail("phare-dynamics", {"--vehicle", "--compare needs the reference car's vehicle file"});
  const auto lines = compare::manoeuvres(directory, vehicle, integrator, step_s);
  if (!lines) return fail("phare-dynamics", lines.error());
  bool within = true;
  std::printf("full by %s, single-track by %s, steps of %g s\n",
              batch::name(integrator.value_or(batch::integrator_of(Level::kFull))),
              batch::name(integrator.value_or(batch::integrator_of(Level::kSingleTrack))), step_s);
  for (const compare::Line& line : *lines) {
    std::printf("%s\n", compare::text(line).c_str());
    within = within && line.passes();
  }
  return within ? kExitDone : kExitCheckFailed;
}

// The road that the options name, into `road` and what it points at.
Status read_road(const std::string& file, double envelope_m, RoadSurface& surface, Road& road) {
  std::string kind = std::filesystem::path(file).extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  if (kind == ".csv") {
    Result<HeightProfile> profile = HeightProfile::read(file);
    if (!profile) return profile.error();
    profile->smooth(envelope_m);
    road.profiles.push_back(std::move(*profile));
  } else if (kind == ".glb" || kind == ".gltf") {
    Result<RoadSurface> mesh = RoadSurface::read(file);
    if (!mesh) return mesh.error();
    if (mesh->triangle_count() == 0) return Error{file, "no node whose name begins with road or ground"};
    surface = std::move(*mesh);
    road.mesh = &surface;
  } else {
    return Error{file, "is no road that --road reads: a scene (.glb, .gltf) or a height profile (.csv)"};
  }
  return Done{};
}

int run_work_precision(const std::string& vehicle_file) {
  if (vehicle_file.empty()) return fail("phare-dynamics", {"--vehicle", "--work-precision needs a vehicle file"});
  const Result<VehicleParams> vehicle = read_vehicle(vehicle_file);
  if (!vehicle) return fail("phare-dynamics", vehicle.error());
  const auto lines = work_precision::table(*vehicle, vehicle_file, false);
  if (!lines) return fail("phare-dynamics", lines.error());
  std::printf("%s", work_precision::markdown(*lines).c_str());
  return kExitDone;
}

}  // namespace

int BatchCommand::run(const std::string& level_name) const {
  const Options& o = *options_;
  const auto given = [&](const char* option) { return o.app->count(option) > 0; };
  const std::optional<Integrator> integrator = integrator_named(o.integrator);
  if (!o.compare_with.empty()) return run_compare(o.compare_with, o.vehicle, integrator, o.step_s);
  if (o.work_precision) return run_work_precision(o.vehicle);
  if (o.out.empty()) return fail("phare-dynamics", {"--out", "--batch needs a file to write the motion to"});
  if (o.vehicle.empty()) return fail("phare-dynamics", {"--vehicle", "--batch needs a vehicle file"});
  for (const auto& [option, file] : {std::pair{"--batch", o.in}, {"--vehicle", o.vehicle}, {"--road", o.road}})
    if (same_file(o.out, file))
      return fail("phare-dynamics", {"--out", o.out + " is the file of " + option + "; it would be overwritten"});
  batch::Options options;
  const Result<Level> level = parse_level(level_name, "--level");
  if (!level) return fail("phare-dynamics", level.error());
  if (*level == Level::kPose)
    return fail("phare-dynamics", {"--level", "pose replays a drive; a batch run moves a model"});
  if (*level == Level::kAuto)
    return fail("phare-dynamics", {"--level", "auto chooses while driving; a batch run names its level"});
  if (const Status used = level_uses(*o.app, *level); !used) return fail("phare-dynamics", used.error());
  if (given("--seed") && o.roughness.empty())
    return fail("phare-dynamics", {"--seed", "is that of --roughness, which is not given"});
  if (given("--envelope-m") && !o.road.ends_with(".csv"))
    return fail("phare-dynamics", {"--envelope-m", "smoothes a height profile, and --road gives none"});
  options.level = *level;
  Result<VehicleParams> vehicle = read_vehicle(o.vehicle);
  if (!vehicle) return fail("phare-dynamics", vehicle.error());
  options.vehicle = std::move(*vehicle);
  options.vehicle_place = o.vehicle;
  options.integrator = integrator.value_or(batch::integrator_of(*level));
  options.single_track = {.magic_formula = o.tyre == "magic", .dynamic_attitude = o.attitude == "dynamic"};
  options.step_s = o.step_s, options.output_hz = o.output_hz;
  options.speed_mps = o.speed_mps, options.start_x_m = o.start_x_m;
  options.resistance = static_cast<batch::Resistance>(index_of(o.resistance, {"auto", "on", "off"}));
  options.levelling = levelling().value_or(levelling::Kind::kNone);
  if (o.relaxation_scale != 1.0) options.relaxation_scale = o.relaxation_scale;
  Result<batch::Inputs> inputs = batch::read_inputs(o.in);
  if (!inputs) return fail("phare-dynamics", inputs.error());

  Road road;
  RoadSurface surface;
  road.friction_everywhere = o.friction;
  if (!inputs->road_m[0].empty())
    for (const char* option : {"--road", "--roughness"})
      if (given(option)) return fail("phare-dynamics", {option, "the inputs give the road's heights already"});
  if (!o.road.empty())
    if (const Status read = read_road(o.road, o.envelope_m, surface, road); !read)
      return fail("phare-dynamics", read.error());
  if (!o.roughness.empty()) {
    const Result<RoughnessClass> roughness = parse_roughness(o.roughness, "--roughness");
    if (!roughness) return fail("phare-dynamics", roughness.error());
    road.profiles.push_back(HeightProfile::iso8608(*roughness, o.seed));
  }
  options.road = &road;

  const bool lamps = batch::has_lamps(options.vehicle);
  Result<WholeFile> file = WholeFile::create(o.out);
  if (!file) return fail("phare-dynamics", file.error());
  const StopFlag stop = install_stop_signals();
  std::string text = batch::header(lamps);
  Status written = Done{};
  const auto pass_on = [&](std::size_t from_size) {
    if (text.size() < from_size) return;
    if (written) written = file->write(text);
    text.clear();
  };
  options.stop = [&] { return !written || stop; };
  const Result<batch::Summary> summary = batch::run(options, *inputs, [&](const batch::Row& row) {
    batch::append(row, lamps, text);
    pass_on(1 << 18);
  });
  if (!written) return fail("phare-dynamics", written.error());
  if (!summary) return fail("phare-dynamics", summary.error());
  pass_on(0);
  if (written) written = file->finish();
  if (!written) return fail("phare-dynamics", written.error());
  if (summary->rolled_over_s)
    std::fprintf(stderr, "phare-dynamics: the car has rolled over at %.9g s; the run ends there\n",
                 *summary->rolled_over_s);
  if (!lamps)
    std::fprintf(stderr, "phare-dynamics: %s has no table [levelling]: no columns for cut-off and lamps\n",
                 printable(o.vehicle).c_str());
  std::fprintf(
      is_standard_output(o.out) ? stderr : stdout,
      "%llu steps of %g s in %.3f s: %.0f times real time; state hash %016llx%s%s\n",
      static_cast<unsigned long long>(summary->steps), o.step_s, summary->wall_s,
      summary->simulated_s / std::max(summary->wall_s, 1e-9), static_cast<unsigned long long>(summary->state_hash),
      summary->resistance ? "" : "; no air and rolling resistance", summary->off_road ? "; a wheel left the road" : "");
  return summary->rolled_over_s ? kExitCheckFailed : kExitDone;
}

}  // namespace phare
