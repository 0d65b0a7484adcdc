// What holds for every scene: tried on random ones, with a seed that is printed.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>

#include "tools/hard_cases/lamps.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare::hard {
namespace {

constexpr int kScenes = 40;

struct RandomScene {
  IntensityTable table;
  Placed lamp;
  std::vector<Point> points;
};

class Scenes {
 public:
  explicit Scenes(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  glm::dvec3 direction() {
    const double z = uniform(-1.0, 1.0), a = uniform(0.0, 2.0 * std::numbers::pi), r = std::sqrt(1.0 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
  }
  glm::dmat3 turn() { return aim_rotation(uniform(-3.0, 3.0), uniform(-1.4, 1.4), uniform(-3.0, 3.0)); }

  /// A smooth lopsided beam, a lamp anywhere, points before it whose faces look at it.
  void next(RandomScene& scene) {
    const double wide = uniform(3.0, 20.0), high = uniform(2.0, 10.0), peak = uniform(100.0, 50'000.0);
    const double left = uniform(-5.0, 5.0), up = uniform(-3.0, 3.0);
    scene.table = table_of(60.0, 121, 121, [=](double h, double v) {
      return peak * std::exp(-0.5 * (std::pow((h - left) / wide, 2) + std::pow((v - up) / high, 2)));
    });
    scene.lamp = {.table = &scene.table, .at_m = 30.0 * direction(), .world_from_lamp = turn()};
    scene.points.clear();
    for (int i = 0; i < 16; ++i) {
      const glm::dvec3 way = scene.lamp.world_from_lamp * table_direction(scene.table.type, scene.table.axis,
                                                                          {uniform(-25.0, 25.0), uniform(-12.0, 12.0)});
      scene.points.push_back({scene.lamp.at_m + uniform(0.5, 150.0) * way, glm::normalize(-way + 0.5 * direction())});
    }
  }

 private:
  std::mt19937_64 random_;
};

/// Each random scene by both ways: `change` makes another scene of it, whose light has to be `times` as much.
Outcome compare(const Bench& bench, const std::function<double(Scenes&, RandomScene&)>& change) {
  Outcome outcome;
  Scenes scenes(bench.seed);
  for (int k = 0; k < kScenes; ++k) {
    RandomScene scene;
    scenes.next(scene);
    const std::vector<double> device = device_lx(bench, scene.lamp, scene.points),
                              processor = float64_lx(scene.lamp, scene.points);
    RandomScene other = scene;
    other.lamp.table = &other.table;
    const double times = change(scenes, other);
    const std::vector<double> device_other = device_lx(bench, other.lamp, other.points),
                              processor_other = float64_lx(other.lamp, other.points);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      outcome.float64.push_back({static_cast<double>(k), relative(processor_other[i], times * processor[i])});
      if (!device.empty())
        outcome.device.push_back({static_cast<double>(k), relative(device_other[i], times * device[i])});
    }
  }
  return outcome;
}

Outcome moved_world(const Bench& bench) {
  return compare(bench, [](Scenes& scenes, RandomScene& scene) {
    const glm::dmat3 turn = scenes.turn();
    const glm::dvec3 shift = 2'000.0 * scenes.direction();
    scene.lamp.at_m = turn * scene.lamp.at_m + shift;
    scene.lamp.world_from_lamp = turn * scene.lamp.world_from_lamp;
    for (Point& point : scene.points) point = Point{turn * point.at_m + shift, turn * point.normal};
    return 1.0;
  });
}

Outcome mirrored(const Bench& bench) {
  return compare(bench, [](Scenes&, RandomScene& scene) {
    // Left and right changed in the table and in the lamp's own frame.
    IntensityTable& table = scene.table;
    const std::size_t columns = table.first_deg.size();
    for (std::size_t row = 0; row < table.second_deg.size(); ++row)
      std::reverse(table.candela.begin() + static_cast<std::ptrdiff_t>(row * columns),
                   table.candela.begin() + static_cast<std::ptrdiff_t>((row + 1) * columns));
    const glm::dmat3 to_lamp = glm::transpose(scene.lamp.world_from_lamp);
    const auto mirror = [&](const glm::dvec3& way) {
      const glm::dvec3 own = to_lamp * way;
      return scene.lamp.world_from_lamp * glm::dvec3(own.x, -own.y, own.z);
    };
    for (Point& point : scene.points)
      point = Point{scene.lamp.at_m + mirror(point.at_m - scene.lamp.at_m), mirror(point.normal)};
    return 1.0;
  });
}

Outcome doubled_distance(const Bench& bench) {
  return compare(bench, [](Scenes&, RandomScene& scene) {
    for (Point& point : scene.points) point.at_m = scene.lamp.at_m + 2.0 * (point.at_m - scene.lamp.at_m);
    return 0.25;
  });
}

Outcome proportional(const Bench& bench) {
  return compare(bench, [](Scenes& scenes, RandomScene& scene) {
    scene.lamp.scale = scenes.uniform(1e-3, 1.0);
    return scene.lamp.scale;
  });
}

/// Flux on the six walls of a room against the flux of the beam: nothing is gained, nothing lost.
Outcome energy(const Bench& bench) {
  Outcome outcome;
  Scenes scenes(bench.seed);
  for (int k = 0; k < 3; ++k) {
    RandomScene scene;
    scenes.next(scene);
    scene.lamp.at_m = {scenes.uniform(-1.0, 1.0), scenes.uniform(-1.0, 1.0), scenes.uniform(-1.0, 1.0)};
    constexpr int kSide = 120;
    constexpr double kHalf_m = 3.0, kStep_m = 2.0 * kHalf_m / kSide;
    std::vector<Point> points;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0})
        for (int i = 0; i < kSide; ++i)
          for (int j = 0; j < kSide; ++j) {
            Point point;
            point.at_m[axis] = sign * kHalf_m;
            point.at_m[(axis + 1) % 3] = -kHalf_m + kStep_m * (i + 0.5);
            point.at_m[(axis + 2) % 3] = -kHalf_m + kStep_m * (j + 0.5);
            point.normal = {0.0, 0.0, 0.0};
            point.normal[axis] = -sign;
            points.push_back(point);
          }
    const auto flux = [&](const std::vector<double>& lx) {
      double sum = 0.0;
      for (const double one : lx) sum += one * kStep_m * kStep_m;
      return sum;
    };
    const double exact = scene.table.flux_lm();
    outcome.float64.push_back({static_cast<double>(k), relative(flux(float64_lx(scene.lamp, points)), exact)});
    const std::vector<double> device = device_lx(bench, scene.lamp, points);
    if (!device.empty()) outcome.device.push_back({static_cast<double>(k), relative(flux(device), exact)});
  }
  return outcome;
}

}  // namespace

std::vector<HardCase> property_cases() {
  const auto property = [](const char* name, const char* breaks, const char* setup, double device, double float64,
                           const char* source, std::function<Outcome(const Bench&)> run) {
    return HardCase{.name = name,
                    .group = "What holds for every scene",
                    .breaks = breaks,
                    .setup = setup,
                    .unit = "relative difference",
                    .along = "scene",
                    .device_bound = device,
                    .float64_bound = float64,
                    .source = source,
                    .run = std::move(run)};
  };
  const char* const smooth =
      "angles to 25° are stepped by 1.9e-6° in float32, on slopes of these beams of up to 5 a degree; two steps on "
      "both sides, and 1e-5";
  return {property("moved-world", "light depends on where the world's origin is or how it is turned",
                   "40 random scenes of 16 points, moved by 2 km and turned any way", 5e-5, 1e-8, smooth, moved_world),
          property("mirrored", "left and right are not the same by half a texel",
                   "40 random scenes, the table and its points mirrored", 5e-5, 1e-9, smooth, mirrored),
          property("inverse-square", "light falls off by a curve that an artist likes",
                   "40 random scenes, every point twice as far", 5e-5, 1e-9, smooth, doubled_distance),
          property("proportional", "twice the intensity is not twice the light", "40 random scenes, dimmed at random",
                   1e-6, 1e-12, "a few roundings of float32, of float64", proportional),
          property("energy", "a filter or a falloff adds or loses light",
                   "three random beams in a closed room, lux summed over its walls in 0.05 m squares", 2e-3, 2e-3,
                   "sum by midpoints: step²/24 times the curvature of beams of 2° and more within 6 m, 1e-3", energy)};
}

}  // namespace phare::hard
