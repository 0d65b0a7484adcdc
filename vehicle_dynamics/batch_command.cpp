#include "vehicle_dynamics/batch_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>

#include "config/fail.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/compare.h"
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
  std::string in, compare_with, out, vehicle, integrator = "rk4", tyre = "magic", attitude = "dynamic", road,
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
  const std::string group = "Batch";
  app.add_option("--batch", o.in, "Run these inputs (CSV) instead of a rig")->group(group);
  app.add_option("--out", o.out, "Batch: motion (CSV)")->group(group);
  app.add_option("--vehicle", o.vehicle, "Batch: vehicle file (TOML)")->group(group);
  app.add_option("--integrator", o.integrator, "Batch: semi-implicit-euler, etd2, rk4 or reference")
      ->check(CLI::IsMember({"semi-implicit-euler", "etd2", "rk4", "reference"}))
      ->group(group);
  app.add_option("--step-s", o.step_s, "Batch: fixed step, s")->check(within(1e-6, 0.1))->group(group);
  app.add_option("--output-hz", o.output_hz, "Batch: rows a second")->check(within(0.01, 1e5))->group(group);
  app.add_option("--speed-mps", o.speed_mps, "Batch: speed at the start")->check(within(-60.0, 120.0))->group(group);
  app.add_option("--start-x-m", o.start_x_m, "Batch: x of the centre of gravity at the start")
      ->check(within(-1e8, 1e8))
      ->group(group);
  app.add_option("--road", o.road, "Batch: glTF with a road, or height profile (CSV: x_m, z_m or z_left_m, z_right_m)")
      ->group(group);
  app.add_option("--roughness", o.roughness, "Batch: ISO 8608 class A to E on top of the road")->group(group);
  app.add_option("--seed", o.seed, "Batch: of the roughness")->group(group);
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

int run_compare(const std::string& directory, const std::string& vehicle, Integrator integrator, double step_s) {
  if (vehicle.empty()) return fail("phare-dynamics", {"--vehicle", "--compare needs the reference car's vehicle file"});
  const auto lines = compare::manoeuvres(directory, vehicle, integrator, step_s);
  if (!lines) return fail("phare-dynamics", lines.error());
  bool within = true;
  for (const compare::Line& line : *lines) {
    std::printf("%s\n", compare::text(line).c_str());
    within = within && (line.band == 0.0 || line.error <= line.allowed());
  }
  return within ? kExitDone : kExitCheckFailed;
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
  const auto integrator =
      static_cast<Integrator>(index_of(o.integrator, {"semi-implicit-euler", "etd2", "rk4", "reference"}));
  if (!o.compare_with.empty()) return run_compare(o.compare_with, o.vehicle, integrator, o.step_s);
  if (o.work_precision) return run_work_precision(o.vehicle);
  if (o.out.empty()) return fail("phare-dynamics", {"--out", "--batch needs a file to write the motion to"});
  if (o.vehicle.empty()) return fail("phare-dynamics", {"--vehicle", "--batch needs a vehicle file"});
  batch::Options options;
  const Result<Level> level = parse_level(level_name, "--level");
  if (!level) return fail("phare-dynamics", level.error());
  if (*level == Level::kPose)
    return fail("phare-dynamics", {"--level", "pose replays a drive; a batch run moves a model"});
  if (*level == Level::kAuto)
    return fail("phare-dynamics", {"--level", "auto chooses while driving; a batch run names its level"});
  options.level = *level;
  Result<VehicleParams> vehicle = read_vehicle(o.vehicle);
  if (!vehicle) return fail("phare-dynamics", vehicle.error());
  options.vehicle = std::move(*vehicle);
  options.vehicle_place = o.vehicle;
  options.integrator = integrator;
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
  if (!o.road.empty()) {
    if (!inputs->road_m[0].empty())
      return fail("phare-dynamics", {"--road", "the inputs give the road's heights already"});
    if (o.road.ends_with(".csv")) {
      Result<HeightProfile> profile = HeightProfile::read(o.road);
      if (!profile) return fail("phare-dynamics", profile.error());
      profile->smooth(o.envelope_m);
      road.profiles.push_back(std::move(*profile));
    } else {
      Result<RoadSurface> mesh = RoadSurface::read(o.road);
      if (!mesh) return fail("phare-dynamics", mesh.error());
      if (mesh->triangle_count() == 0)
        return fail("phare-dynamics", {o.road, "no node whose name begins with road or ground"});
      surface = std::move(*mesh);
      road.mesh = &surface;
    }
  }
  if (!o.roughness.empty()) {
    const Result<RoughnessClass> roughness = parse_roughness(o.roughness, "--roughness");
    if (!roughness) return fail("phare-dynamics", roughness.error());
    road.profiles.push_back(HeightProfile::iso8608(*roughness, o.seed));
  }
  options.road = &road;

  std::FILE* file = std::fopen(o.out.c_str(), "w");
  if (!file) return fail("phare-dynamics", {o.out, "cannot be written"});
  std::fprintf(file, "%s\n", batch::header().c_str());
  const Result<batch::Summary> summary =
      batch::run(options, *inputs, [&](const batch::Row& row) { batch::print(row, file); });
  const bool written = std::ferror(file) == 0;
  if (std::fclose(file) != 0 || !written) return fail("phare-dynamics", {o.out, "could not be written to its end"});
  if (!summary) return fail("phare-dynamics", summary.error());
  if (summary->gave_up) return fail("phare-dynamics", {"--integrator", "the reference integrator gave up"});
  std::printf(
      "%llu steps of %g s in %.3f s: %.0f times real time; state hash %016llx%s%s\n",
      static_cast<unsigned long long>(summary->steps), o.step_s, summary->wall_s,
      summary->simulated_s / std::max(summary->wall_s, 1e-9), static_cast<unsigned long long>(summary->state_hash),
      summary->resistance ? "" : "; no air and rolling resistance", summary->off_road ? "; a wheel left the road" : "");
  return kExitDone;
}

}  // namespace phare
