// phare vehicle: vehicles and tyres of others as vehicle files.
#include <cstdio>
#include <memory>
#include <optional>

#include "config/base/fail.h"
#include "config/base/input_files.h"
#include "config/base/whole_file.h"
#include "config/commonroad.h"
#include "config/finite_numbers.h"
#include "tools/commands.h"

namespace phare {
namespace {

struct VehicleArguments {
  std::string in, tyre, out;
  double load_n = 0.0;
};

int make_vehicle(const VehicleArguments& a) {
  const bool tyre_alone = std::filesystem::path(a.in).extension() == ".tir";
  if (tyre_alone && !a.tyre.empty()) return bad_input({"--tyre", "goes with a vehicle; " + a.in + " is a tyre itself"});
  if (!tyre_alone && a.tyre.empty())
    return bad_input({"--tyre", "is needed: parameters_tire.yaml of CommonRoad, or a .tir file"});
  if (const Status apart = check_inputs({a.in, a.tyre}, {a.out}); !apart) return bad_input(apart.error());
  const std::optional<double> load = a.load_n > 0.0 ? std::optional(a.load_n) : std::nullopt;
  const Result<VehicleText> made = tyre_alone ? tyre_table(a.in, load) : vehicle_of_commonroad(a.in, a.tyre, load);
  if (!made) return bad_input(made.error());
  if (const Status written = write_whole_file(a.out.empty() ? "-" : a.out, made->toml); !written)
    return bad_input(written.error());
  for (const std::string& note : made->notes) std::fprintf(stderr, "phare: %s\n", printable(note).c_str());
  return kExitDone;
}

}  // namespace

void add_vehicle(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<VehicleArguments>();
  CLI::App* command = app.add_subcommand(
      "vehicle", "Turn a CommonRoad vehicle (YAML) and a Magic Formula tyre (.tir) into a vehicle file");
  command->footer(
      "Examples:\n  phare vehicle vehicle.yaml --tyre tyre.tir --out car.toml\n  phare vehicle tyre.tir\n"
      "What of them is not used is named on standard error. A .tir alone gives the table [tyre].");
  command->add_option("file", arguments->in, "CommonRoad vehicle (YAML), or a tyre (.tir) for its table alone")
      ->required();
  command->add_option("--tyre", arguments->tyre, "CommonRoad tyre (YAML), or .tir: Magic Formula 5.2 (PAC2002) or 6.1");
  command
      ->add_option("--load-n", arguments->load_n,
                   "Load at which the coefficients of a .tir count [a quarter of the car's weight; alone: nominal]")
      ->check(number_within(100.0, 1e5));
  command->add_option("--out", arguments->out, "Vehicle file to write [standard output]");
  command->callback([arguments, &chosen] { chosen = [arguments] { return make_vehicle(*arguments); }; });
}

}  // namespace phare
