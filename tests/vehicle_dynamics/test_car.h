// The cars the tests drive.
#pragma once

#include <gtest/gtest.h>

#include "config/vehicle.h"
#include "tests/paths.h"
#include "vehicle_dynamics/step.h"

namespace phare::test {

inline VehicleParams car(const char* file) {
  Result<VehicleParams> read = read_vehicle(std::string(vehicles_dir()) + "/" + file);
  if (!read) throw std::runtime_error(read.error().text());
  return *read;
}

inline RunSetup kinematic_setup(const char* file = "bmw_320i.toml") {
  RunSetup setup;
  setup.level = Level::kKinematic;
  setup.vehicle = car(file);
  return setup;
}

constexpr SimTime seconds(double s) {
  return SimTime{static_cast<std::int64_t>(s * 1e9)};
}

/// z = z0 + slope_x x + slope_y y over a square of 2·half around the origin.
inline RoadSurface tilted_plane(double slope_x, double slope_y, double half_m = 500.0) {
  const auto point = [&](double x, double y) { return glm::dvec3(x, y, slope_x * x + slope_y * y); };
  const glm::dvec3 a = point(-half_m, -half_m), b = point(half_m, -half_m), c = point(half_m, half_m),
                   d = point(-half_m, half_m);
  return RoadSurface::from_triangles({{{a, b, c}, true}, {{a, c, d}, true}});
}

}  // namespace phare::test
