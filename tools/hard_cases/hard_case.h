// Hard cases as a product: what breaks in programs of this kind, and the number that this one reaches on the machine at
// hand. `phare hard-cases` runs them; docs/hard-cases.md is printed from this table, and a test compares them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {
class Renderer;
}

namespace phare::hard {

/// A number of a case, and where on its way it was found.
struct Found {
  double at = 0.0;     ///< of what HardCase::along names
  double value = 0.0;  ///< in HardCase::unit
};

struct Outcome {
  std::vector<Found> device{};   ///< by the shader that draws the frame, or by the device
  std::vector<Found> float64{};  ///< by the CPU
  std::string error{};           ///< the case could not be run
  std::string not_run{};         ///< what this machine lacks for it
  std::string missed{};          ///< what its numbers do not tell of how it missed
};

/// What the cases need: the device, if this build draws, and a seed.
struct Bench {
  Renderer* renderer = nullptr;
  std::uint64_t seed = 1;
};

struct HardCase {
  std::string name, group;
  std::string breaks;  ///< what goes wrong elsewhere
  std::string setup;
  std::string unit, along;
  std::optional<double> device_bound{}, float64_bound{};  ///< most that is allowed; without one that way is not run
  std::string source;                                     ///< of the bound: an estimate, or who asks for it
  std::function<Outcome(const Bench&)> run;
};

/// A case that the processor alone runs.
HardCase float64_case(const char* group, const char* name, const char* breaks, const char* setup, const char* unit,
                      const char* along, double bound, const char* source, std::function<Outcome(const Bench&)> run);

std::vector<HardCase> light_cases();
std::vector<HardCase> property_cases();
std::vector<HardCase> vehicle_cases();
std::vector<HardCase> vehicle_limit_cases();
std::vector<HardCase> bus_cases();
#ifdef PHARE_WITH_GRAPHICS
std::vector<HardCase> picture_cases();
std::vector<HardCase> whole_drive_cases();
#endif

/// The largest value; NaN and infinity count as infinity. Nothing found: none.
std::optional<double> worst(const std::vector<Found>& found);

enum class Standing { kHeld, kMissed, kNotRun };
Standing standing(const HardCase& hard, const Outcome& outcome);

/// docs/hard-cases.md.
std::string markdown(const std::vector<HardCase>& cases);
/// One page with a plot of each case. No script.
std::string page(const std::vector<HardCase>& cases, const std::vector<Outcome>& outcomes, const std::string& about);

}  // namespace phare::hard
