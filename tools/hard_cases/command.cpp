// phare hard-cases: where programs of this kind break, tried on this machine.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "config/base/fail.h"
#include "config/base/whole_file.h"
#include "config/finite_numbers.h"
#include "tools/commands.h"
#include "tools/hard_cases/hard_case.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/renderer.h"
#endif

namespace phare {
namespace {

using namespace hard;

struct HardCaseOptions {
  std::vector<std::string> names;
  std::string out;
  std::uint64_t seed = 1;
  double tighten = 1.0;
  bool markdown = false;
};

std::vector<HardCase> all_cases() {
  std::vector<HardCase> cases = light_cases();
  const auto add = [&](std::vector<HardCase> more) {
    for (HardCase& one : more) cases.push_back(std::move(one));
  };
  add(property_cases());
#ifdef PHARE_WITH_GRAPHICS
  add(picture_cases());
  add(whole_drive_cases());
#endif
  add(vehicle_cases());
  add(vehicle_limit_cases());
  add(bus_cases());
  return cases;
}

std::string cell(const std::vector<Found>& found, const std::optional<double>& bound) {
  const std::optional<double> most = worst(found);
  char text[48] = "";
  if (most && bound) std::snprintf(text, sizeof text, "%.2g of %.2g", *most, *bound);
  return text;
}

int run_cases(const HardCaseOptions& options) {
  std::vector<HardCase> all = all_cases();
  if (options.markdown) {
    std::fputs(markdown(all).c_str(), stdout);
    return kExitDone;
  }
  std::vector<HardCase> cases;
  for (const std::string& name : options.names)
    if (std::none_of(all.begin(), all.end(), [&](const HardCase& one) { return one.name == name; }))
      return bad_input({name, "is no hard case; phare hard-cases --markdown lists them"});
  for (HardCase& one : all)
    for (std::optional<double>* bound : {&one.device_bound, &one.float64_bound})
      if (*bound) **bound /= options.tighten;
  for (const HardCase& one : all)
    if (options.names.empty() || std::find(options.names.begin(), options.names.end(), one.name) != options.names.end())
      cases.push_back(one);
  if (!options.out.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.out, failed);
    if (failed) return bad_input({"--out " + options.out, failed.message()});
  }
  Bench bench{.renderer = nullptr, .seed = options.seed};
  std::string about = "seed " + std::to_string(options.seed);
#ifdef PHARE_WITH_GRAPHICS
  Result<Renderer> renderer = Renderer::create({.width_px = 64, .height_px = 64});
  if (!renderer) return bad_input(renderer.error());
  bench.renderer = &*renderer;
  about += ", " + renderer->device();
#else
  about += ", without a device: this build draws nothing";
#endif
  std::printf("%s\n%-26s %-8s %-20s %-20s %s\n", about.c_str(), "case", "", "device", "float64", "of");
  std::vector<Outcome> outcomes;
  int missed = 0;
  for (const HardCase& one : cases) {
    outcomes.push_back(one.run(bench));
    const Outcome& outcome = outcomes.back();
    const Standing found = standing(one, outcome);
    const std::string& why = outcome.error.empty() ? outcome.not_run : outcome.error;
    std::printf("%-26s %-8s %-20s %-20s %s%s\n", one.name.c_str(),
                found == Standing::kHeld     ? "held"
                : found == Standing::kMissed ? "MISSED"
                                             : "not run",
                cell(outcome.device, one.device_bound).c_str(), cell(outcome.float64, one.float64_bound).c_str(),
                one.unit.c_str(), why.empty() ? "" : ("; " + why).c_str());
    std::fflush(stdout);
    if (found != Standing::kMissed) continue;
    ++missed;
    if (!outcome.missed.empty()) std::printf("  %s\n", outcome.missed.c_str());
    char tighten[48] = "";
    if (options.tighten != 1.0) std::snprintf(tighten, sizeof tighten, " --tighten %.9g", options.tighten);
    std::printf("  again: phare hard-cases %s --seed %llu%s\n", one.name.c_str(),
                static_cast<unsigned long long>(options.seed), tighten);
  }
  if (!options.out.empty())
    if (const Status written =
            write_whole_file(std::filesystem::path(options.out) / "index.html", page(cases, outcomes, about));
        !written)
      return bad_input(written.error());
  return missed == 0 ? kExitDone : kExitCheckFailed;
}

}  // namespace

void add_hard_cases(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<HardCaseOptions>();
  CLI::App* command = app.add_subcommand(
      "hard-cases", "Where programs of this kind break: tried on this machine, each with its number");
  command->footer(
      "Example:\n  phare hard-cases grazing-incidence far-origin\nExit code 1 if a case misses its number.");
  command->add_option("names", options->names, "Cases [all]");
  command->add_option("--out", options->out, "Folder for a page with a plot of each");
  command->add_option("--seed", options->seed, "Of the random scenes")->capture_default_str();
  command->add_option("--tighten", options->tighten, "Allow so many times less: how much room a case has")
      ->check(number_within(1.0, 1e30))
      ->capture_default_str();
  command->add_flag("--markdown", options->markdown, "Print the list as docs/hard-cases.md has it");
  command->callback([options, &chosen] { chosen = [options] { return run_cases(*options); }; });
}

}  // namespace phare
