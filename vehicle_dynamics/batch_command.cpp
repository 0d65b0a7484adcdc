#include "vehicle_dynamics/batch_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "config/base/fail.h"
#include "config/finite_numbers.h"
#include "net/clock.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/batch_output.h"
#include "vehicle_dynamics/compare.h"
#include "vehicle_dynamics/manoeuvre.h"
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

bool is_csv(const std::string& file) {
  std::string kind = std::filesystem::path(file).extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return kind == ".csv";
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
  std::string manoeuvre, follow, plot, reference;
  std::vector<std::string> columns;
  double speed_kmh = 0.0, hold_speed_kmh = 0.0, seconds = 0.0, scale = 5.0;
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
  app.add_option("--vehicle", o.vehicle, "Vehicle file (TOML); live: instead of the rig's")->group(group);
  app.add_option("--integrator", o.integrator,
                 "Batch: semi-implicit-euler, etd2, rk4 or reference (default: as in real time, "
                 "rk4 for full and etd2 for single-track)")
      ->check(CLI::IsMember({"semi-implicit-euler", "etd2", "rk4", "reference"}))
      ->group(group);
  app.add_option("--step-s", o.step_s, "Batch: fixed step, s (default 0.002)")
      ->check(number_within(1e-6, 0.1))
      ->group(group);
  app.add_option("--output-hz", o.output_hz, "Batch: rows a second")->check(number_within(0.01, 1e5))->group(group);
  app.add_option("--manoeuvre", o.manoeuvre,
                 "Batch without inputs: iso4138, iso7401, iso3888-2, iso19365 or iso21994, and its figures")
      ->check(CLI::IsMember(std::vector<std::string>(batch::kManoeuvreNames.begin(), batch::kManoeuvreNames.end())))
      ->group(group);
  app.add_option("--scale", o.scale, "iso19365: steering over that of 0.3 g")
      ->check(number_within(0.1, 10.0))
      ->group(group);
  app.add_option("--seconds", o.seconds, "Batch without inputs: drive for so long, with --hold-speed-kmh or --follow")
      ->check(number_within(0.01, 360000.0))
      ->group(group);
  app.add_option("--hold-speed-kmh", o.hold_speed_kmh, "Batch: a driver holds this speed with the pedals")
      ->check(number_within(0.0, 400.0))
      ->group(group);
  app.add_option(
         "--follow", o.follow,
         "Batch: a driver steers along a path (CSV as a scene's lane), or \"lane\": that of --road; begins there")
      ->group(group);
  app.add_option("--columns", o.columns,
                 "Batch: also slip, slip-angle, travel, camber, torque, friction-used, gear, driver, energy, level")
      ->delimiter(',')
      ->group(group);
  app.add_option("--plot", o.plot, "Batch: a page with the run's traces (HTML without scripts)")->group(group);
  app.add_option("--reference", o.reference,
                 "Batch, with --plot: another run beside ours (CSV with time_s or t and columns as in OUT)")
      ->group(group);
  app.add_option("--speed-kmh", o.speed_kmh, "Batch: speed at the start (default of a manoeuvre: its own)")
      ->check(number_within(-200.0, 430.0))
      ->group(group);
  app.add_option("--speed-mps", o.speed_mps, "Batch: speed at the start")
      ->check(number_within(-60.0, 120.0))
      ->group(group);
  app.add_option("--start-x-m", o.start_x_m, "Batch: x of the centre of gravity at the start")
      ->check(number_within(-1e8, 1e8))
      ->group(group);
  app.add_option(
         "--road", o.road,
         "Batch: glTF with a road; batch and live: heights and friction along the way (CSV: x_m and z_m or z_left_m, "
         "z_right_m; friction or friction_left, friction_right)")
      ->group(group);
  app.add_option("--roughness", o.roughness, "ISO 8608 class A to E on top of the road")->group(group);
  app.add_option("--seed", o.seed, "Of the roughness, 0 to 2^64 - 1")
      ->check(CLI::Validator(
          [](const std::string& given) -> std::string {
            std::uint64_t value = 0;
            const char* const end = given.data() + given.size();
            const auto [stop, error] = std::from_chars(given.data(), end, value);
            return error == std::errc() && stop == end ? "" : given + " is not a whole number from 0 to 2^64 - 1";
          },
          "UINT"))
      ->group(group);
  app.add_option("--envelope-m", o.envelope_m, "Length over which a tyre averages a profile; 0: point contact")
      ->check(number_within(0.0, 1.0))
      ->group(group);
  app.add_option("--friction", o.friction, "Of the whole road, 1 as the tyre was measured")
      ->check(number_within(0.01, 2.0))
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
      ->check(number_within(0.01, 100.0))
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
  const Options& o = *options_;
  return !o.in.empty() || !o.compare_with.empty() || o.work_precision || !o.manoeuvre.empty() || o.seconds > 0.0;
}

std::optional<levelling::Kind> BatchCommand::levelling() const {
  if (options_->levelling.empty()) return std::nullopt;
  return static_cast<levelling::Kind>(index_of(options_->levelling, {"none", "manual", "static", "dynamic"}));
}

Conditions BatchCommand::conditions() const {
  const Options& o = *options_;
  Conditions c;
  c.roughness = o.roughness, c.seed = o.seed, c.envelope_m = o.envelope_m;
  if (o.app->count("--friction") > 0) c.friction = o.friction;
  if (is_csv(o.road)) c.csv_file = o.road;
  return c;
}

const std::string& BatchCommand::vehicle() const {
  return options_->vehicle;
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
                     {"--state", {Run::kLive}},
                     {"--alive", {Run::kLive}},
                     {"--log-level", {Run::kLive}},
                     {"--open-bus", {Run::kLive}},
                     {"--wait-for-picture", {Run::kLive}},
                     {"--port-base", {Run::kLive}},
                     {"--level", {Run::kLive, Run::kBatch}},
                     {"--levelling", {Run::kLive, Run::kBatch}},
                     {"--vehicle", {Run::kLive, Run::kBatch, Run::kCompare, Run::kWorkPrecision}},
                     {"--integrator", {Run::kBatch, Run::kCompare}},
                     {"--step-s", {Run::kBatch, Run::kCompare}},
                     {"--out", {Run::kBatch}},
                     {"--output-hz", {Run::kBatch}},
                     {"--speed-mps", {Run::kBatch}},
                     {"--speed-kmh", {Run::kBatch}},
                     {"--scale", {Run::kBatch}},
                     {"--hold-speed-kmh", {Run::kBatch}},
                     {"--follow", {Run::kBatch}},
                     {"--columns", {Run::kBatch}},
                     {"--plot", {Run::kBatch}},
                     {"--reference", {Run::kBatch}},
                     {"--start-x-m", {Run::kBatch}},
                     {"--road", {Run::kLive, Run::kBatch}},
                     {"--roughness", {Run::kLive, Run::kBatch}},
                     {"--seed", {Run::kLive, Run::kBatch}},
                     {"--envelope-m", {Run::kLive, Run::kBatch}},
                     {"--friction", {Run::kLive, Run::kBatch}},
                     {"--tyre", {Run::kBatch}},
                     {"--attitude", {Run::kBatch}},
                     {"--resistance", {Run::kBatch}},
                     {"--relaxation-scale", {Run::kBatch}}};

}  // namespace

Status BatchCommand::options_fit() const {
  const CLI::App& app = *options_->app;
  Run run = Run::kLive;
  const char* named = nullptr;
  for (const auto& [option, kind] : {std::pair{"--batch", Run::kBatch},
                                     {"--manoeuvre", Run::kBatch},
                                     {"--seconds", Run::kBatch},
                                     {"--compare", Run::kCompare},
                                     {"--work-precision", Run::kWorkPrecision}}) {
    if (app.count(option) == 0) continue;
    if (named) return Error{option, std::string("does not go with ") + named};
    named = option, run = kind;
  }
  if (run == Run::kLive && app.count("--road") > 0 && !is_csv(options_->road))
    return Error{"--road", "live the scene is the rig's; heights and friction along the way are a CSV"};
  for (const Use& use : kUses)
    if (app.count(use.option) > 0 && std::find(use.runs.begin(), use.runs.end(), run) == use.runs.end())
      return Error{use.option,
                   named ? std::string("means nothing with ") + named : "belongs to a run without a rig, see --batch"};
  if (app.count("--seed") > 0 && options_->roughness.empty())
    return Error{"--seed", "is that of --roughness, which is not given"};
  if (app.count("--envelope-m") > 0 && !is_csv(options_->road))
    return Error{"--envelope-m", "smoothes a height profile, and --road gives none"};
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
  if (level == Level::kAuto)
    for (const char* option : {"--integrator"})
      if (app.count(option) > 0) return Error{option, at + "runs each level by the method of real time"};
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

// The road of a batch run, into `road` and what it points at.
Status read_road(const std::string& file, const Conditions& conditions, RoadSurface& surface, Road& road) {
  const std::string kind = std::filesystem::path(file).extension().string();
  const bool scene = kind == ".glb" || kind == ".gltf" || kind == ".GLB" || kind == ".GLTF";
  if (scene) {
    Result<RoadSurface> mesh = RoadSurface::read(file);
    if (!mesh) return mesh.error();
    if (mesh->triangle_count() == 0) return Error{file, "no node whose name begins with road or ground"};
    surface = std::move(*mesh);
    road.mesh = &surface;
  } else if (!file.empty() && !is_csv(file)) {
    return Error{file, "is no road that --road reads: a scene (.glb, .gltf) or a height profile (.csv)"};
  }
  return lay(conditions, scene ? file : std::string{}, road);
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

// What a driver of ours goes with.
Status BatchCommand::driver_fits() const {
  const Options& o = *options_;
  const auto given = [&](const char* option) { return o.app->count(option) > 0; };
  if (given("--speed-kmh") && given("--speed-mps")) return Error{"--speed-kmh", "does not go with --speed-mps"};
  if (given("--scale") && o.manoeuvre != "iso19365")
    return Error{"--scale", "is that of --manoeuvre iso19365, which is not given"};
  if (!o.manoeuvre.empty())
    for (const char* option : {"--hold-speed-kmh", "--follow", "--start-x-m"})
      if (given(option)) return Error{option, "a manoeuvre has a driver and a place of its own"};
  if (!o.manoeuvre.empty())
    for (const auto& [option, speed] : {std::pair{"--speed-kmh", o.speed_kmh}, {"--speed-mps", o.speed_mps}})
      if (given(option) && speed <= 0.0) return Error{option, "a manoeuvre is driven forwards, at more than 0"};
  if (!o.manoeuvre.empty() && o.output_hz < batch::kManoeuvreRows_hz)
    return Error{"--output-hz", "a manoeuvre is measured by 100 rows a second or more"};
  if (!o.manoeuvre.empty() && o.levelling == "manual") return Error{"--levelling", "manual needs inputs"};
  if (given("--seconds") && !given("--hold-speed-kmh") && o.follow.empty())
    return Error{"--seconds", "goes with a driver: --hold-speed-kmh or --follow"};
  if (!o.follow.empty() && given("--start-x-m")) return Error{"--start-x-m", "a path is begun at its beginning"};
  if (o.follow == "lane" && o.road.empty()) return Error{"--follow lane", "is that of --road, which is not given"};
  return Done{};
}

// The path to follow: the car begins on its first point.
Status BatchCommand::read_path(batch::Options& to) const {
  const std::string file = options_->follow == "lane" ? lane_file_of(options_->road).string() : options_->follow;
  Result<std::vector<LanePoint>> path = read_lane(file);
  if (!path) return path.error();
  to.driver.path = std::move(*path);
  const LanePoint& first = to.driver.path.front();
  const double b = to.vehicle.wheelbase_m - to.vehicle.cg_to_front_m;
  to.start_x_m = first.x_m + b * std::cos(first.heading_rad),
  to.start_y_m = first.y_m + b * std::sin(first.heading_rad);
  to.start_yaw_rad = first.heading_rad;
  return Done{};
}

int BatchCommand::run(const std::string& level_name) const {
  const Options& o = *options_;
  const auto given = [&](const char* option) { return o.app->count(option) > 0; };
  const std::optional<Integrator> integrator = integrator_named(o.integrator);
  if (!o.compare_with.empty()) return run_compare(o.compare_with, o.vehicle, integrator, o.step_s);
  if (o.work_precision) return run_work_precision(o.vehicle);
  if (o.out.empty() && o.manoeuvre.empty() && o.plot.empty())
    return fail("phare-dynamics", {"--out", "--batch needs a file to write the motion to, or --plot a page"});
  for (const char* option : {"--output-hz", "--columns"})
    if (given(option) && o.out.empty() && o.plot.empty())
      return fail("phare-dynamics", {option, "is of the rows that are written: give --out or --plot"});
  if (!o.reference.empty() && o.plot.empty())
    return fail("phare-dynamics", {"--reference", "is drawn on a page: give --plot FILE.html"});
  if (o.vehicle.empty()) return fail("phare-dynamics", {"--vehicle", "--batch needs a vehicle file"});
  if (const Status fit = driver_fits(); !fit) return fail("phare-dynamics", fit.error());
  for (const auto& [result, written] : {std::pair{"--out", o.out}, {"--plot", o.plot}})
    for (const auto& [option, file] :
         {std::pair{"--batch", o.in}, {"--vehicle", o.vehicle}, {"--road", o.road}, {"--reference", o.reference}})
      if (same_file(written, file))
        return fail("phare-dynamics", {result, written + " is the file of " + option + "; it would be overwritten"});
  if (!o.out.empty() && (o.out == o.plot || same_file(o.out, o.plot)))
    return fail("phare-dynamics", {"--plot", o.plot + " is the file of --out; it would be overwritten"});
  batch::Options options;
  const Result<Level> level = parse_level(level_name, "--level");
  if (!level) return fail("phare-dynamics", level.error());
  if (*level == Level::kPose)
    return fail("phare-dynamics", {"--level", "pose replays a drive; a batch run moves a model"});
  if (const Status used = level_uses(*o.app, *level); !used) return fail("phare-dynamics", used.error());
  options.level = *level;
  Result<VehicleParams> vehicle = read_vehicle(o.vehicle);
  if (!vehicle) return fail("phare-dynamics", vehicle.error());
  options.vehicle = std::move(*vehicle);
  options.vehicle_place = o.vehicle;
  options.integrator = integrator.value_or(batch::integrator_of(*level));
  options.single_track = {.magic_formula = o.tyre == "magic", .dynamic_attitude = o.attitude == "dynamic"};
  options.step_s = o.step_s, options.output_hz = o.output_hz;
  options.speed_mps = given("--speed-kmh") ? o.speed_kmh / 3.6 : o.speed_mps, options.start_x_m = o.start_x_m;
  for (const std::string& name : o.columns) {
    const std::optional<unsigned> column = batch::column_named(name);
    if (!column) return fail("phare-dynamics", {"--columns", "\"" + printable(name) + "\" is none, see --help"});
    options.columns |= *column;
  }
  if (given("--hold-speed-kmh")) {
    options.driver.hold_speed_mps = o.hold_speed_kmh / 3.6;
    if (!given("--speed-kmh") && !given("--speed-mps")) options.speed_mps = o.hold_speed_kmh / 3.6;
  }
  if (!o.follow.empty())
    if (const Status read = read_path(options); !read) return fail("phare-dynamics", read.error());
  options.resistance = static_cast<batch::Resistance>(index_of(o.resistance, {"auto", "on", "off"}));
  options.levelling = levelling().value_or(levelling::Kind::kNone);
  if (o.relaxation_scale != 1.0) options.relaxation_scale = o.relaxation_scale;
  Result<batch::Inputs> inputs = batch::Inputs{};
  std::optional<batch::Manoeuvre> standard;
  if (!o.manoeuvre.empty()) {
    Result<batch::Manoeuvre> made = batch::manoeuvre(o.manoeuvre, options.speed_mps, o.scale, options);
    if (!made) return fail("phare-dynamics", made.error());
    standard = std::move(*made);
    options = standard->options, inputs = standard->inputs;
  } else if (o.seconds > 0.0) {
    inputs->time_s = {0.0, o.seconds}, inputs->steer_rad = inputs->accelerator_01 = inputs->brake_01 = {0.0, 0.0};
    options.ends_at_rest = !o.follow.empty();
  } else {
    inputs = batch::read_inputs(o.in);
    if (!inputs) return fail("phare-dynamics", inputs.error());
    if (options.driver.hold_speed_mps && inputs->accelerator_01.empty())
      return fail("phare-dynamics", {"--hold-speed-kmh", "the inputs drive by torques, which no foot holds"});
  }

  Road road;
  RoadSurface surface;
  if (!inputs->road_m[0].empty())
    for (const char* option : {"--road", "--roughness"})
      if (given(option)) return fail("phare-dynamics", {option, "the inputs give the road's heights already"});
  if (const Status read = read_road(o.road, conditions(), surface, road); !read)
    return fail("phare-dynamics", read.error());
  if (*level == Level::kKinematic && is_csv(o.road) && !road.friction.empty() && road.profiles.empty())
    return fail("phare-dynamics", {o.road, "has friction alone, and level kinematic has no tyres"});
  options.road = &road;

  const unsigned columns = options.columns;
  if (!o.plot.empty() && !inputs->accelerator_01.empty()) options.columns |= batch::kDriver;
  Result<batch::Output> output = batch::Output::open({o.out, o.plot, o.reference}, options, columns, standard,
                                                     standard       ? standard->name
                                                     : o.in.empty() ? "batch run"
                                                                    : std::filesystem::path(o.in).filename().string());
  if (!output) return fail("phare-dynamics", output.error());
  const StopFlag stop = install_stop_signals();
  options.stop = [&] { return output->failed() || stop; };
  const Result<batch::Summary> summary =
      batch::run(options, *inputs, [&](const batch::Row& row) { output->take(row); });
  if (!summary && !output->failed()) return fail("phare-dynamics", summary.error());
  const Status written = output->finish(summary ? *summary : batch::Summary{}, o.step_s);
  if (!written) return fail("phare-dynamics", written.error());
  return summary->rolled_over_s ? kExitCheckFailed : kExitDone;
}

}  // namespace phare
