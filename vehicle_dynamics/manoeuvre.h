// Standard manoeuvres for batch runs, with the figures that are read off them: phare-dynamics --manoeuvre NAME.
//
// What: inputs, driver and result figures of ISO 4138 (steady-state circular driving, constant speed, slowly increasing
//   steer), ISO 7401 (step input), ISO 3888-2 (obstacle avoidance), ISO 19365 (sine with dwell) and ISO 21994 (stopping
//   distance, straight line, ABS).
// Source: the standards of these numbers as they are commonly quoted (the paid texts were not at hand); where a figure
//   of theirs was not known it is chosen, and the line says so.
//   The angle of 0.3 g that ISO 19365 asks for is measured as FMVSS 126 has it (49 CFR 571.126, S7.6).
// Leaves out: repetitions and their statistics, corrections for wind and slope, the tyre warm-up.
// Tests: tests/vehicle_dynamics/manoeuvre_test.cpp.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "vehicle_dynamics/batch.h"

namespace phare::batch {

/// Rows a second that the measures of a manoeuvre are taken from, at least.
inline constexpr double kManoeuvreRows_hz = 100.0;
inline constexpr std::array<std::string_view, 5> kManoeuvreNames{"iso4138", "iso7401", "iso3888-2", "iso19365",
                                                                 "iso21994"};

struct Manoeuvre {
  std::string name;
  Inputs inputs;
  Options options;                   ///< those given, with speed and driver of the manoeuvre
  double of_three_tenths_rad = 0.0;  ///< iso19365: road-wheel angle at which this car has 0.3 g
};

/// One result, as it is printed: "stopping distance", 36.1, "m".
struct Figure {
  std::string what;
  double value = 0.0;  ///< NaN: there is none
  std::string unit;    ///< or, where there is no value, why
};

/// `speed_mps` 0: the standard's own (80 km/h; 100 for iso4138 and iso21994, 60 for iso3888-2). `scale`: of the
/// steering amplitude of iso19365 over the one of 0.3 g (1 to 6.5), for which it drives the car on a dry level road.
/// Error: the level or the vehicle does not go with it, or the car never has 0.3 g.
Result<Manoeuvre> manoeuvre(std::string_view name, double speed_mps, double scale, Options options);

/// From all rows of its run, 100 a second or more.
std::vector<Figure> figures(const Manoeuvre& manoeuvre, const std::vector<Row>& rows);

}  // namespace phare::batch
