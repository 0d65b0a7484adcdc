// unit: driving at random, by pedals through engine and gearbox, on roads at random: no situation breaks the energy
// audit or comes to no end. Each drive has a seed of its own, which a failure names; PHARE_SEED=N PHARE_DRIVES=M drives
// others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "config/base/conventions.h"
#include "full_car.h"
#include "vehicle_dynamics/batch.h"

namespace phare {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double within(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  bool once_in(int n) { return engine_() % static_cast<std::uint64_t>(n) == 0; }
  std::size_t of(std::size_t n) { return engine_() % n; }

 private:
  std::mt19937_64 engine_;
};

struct Situation {
  std::string words;
  batch::Options options;
  batch::Inputs inputs;
  Road road;
};

void lay_random_road(Dice& dice, Situation& s) {
  if (dice.once_in(2)) s.road.slope_x = dice.within(-0.15, 0.15), s.road.slope_y = dice.within(-0.06, 0.06);
  if (dice.once_in(3)) {
    const auto roughness = static_cast<RoughnessClass>(dice.of(4));
    s.road.profiles.push_back(HeightProfile::iso8608(roughness, dice.of(1000)));
    s.road.profiles.back().smooth(0.1);
    s.words += ", class " + std::string(1, static_cast<char>('A' + static_cast<int>(roughness)));
  }
  for (double from = -200.0; from < 800.0 && s.words.size() < 1000;) {
    const double to = from + dice.within(5.0, 80.0);
    s.road.friction.push_back(
        {.from_m = from, .to_m = to, .left = dice.within(0.05, 1.1), .right = dice.within(0.05, 1.1)});
    from = to;
  }
}

void press_at_random(Dice& dice, double seconds, Situation& s) {
  batch::Inputs& in = s.inputs;
  const double lock = s.options.vehicle.max_steering_wheel_rad / s.options.vehicle.steering_ratio;
  const double wild = dice.once_in(4) ? lock : 0.08;
  for (double t = 0.0; t < seconds; t += dice.within(0.05, 1.2)) {
    in.time_s.push_back(t);
    in.steer_rad.push_back(dice.within(-wild, wild));
    in.accelerator_01.push_back(dice.once_in(2) ? dice.within(0.0, 1.0) : 0.0);
    in.brake_01.push_back(dice.once_in(3) ? dice.within(0.0, 1.0) : 0.0);
    in.gear.push_back(dice.once_in(12) ? 2.0 : dice.once_in(12) ? 1.0 : 0.0);
    in.parking_01.push_back(dice.once_in(15) ? 1.0 : 0.0);
  }
  in.time_s.push_back(in.time_s.back() + 1.0);
  for (auto* column : {&in.steer_rad, &in.accelerator_01, &in.brake_01, &in.gear, &in.parking_01})
    column->push_back(column->back());
}

Situation random_situation(std::uint64_t seed, Level level, double seconds) {
  Dice dice(seed);
  constexpr const char* kCars[] = {"bmw_320i.toml", "ford_escort.toml", "hatchback.toml", "vw_vanagon.toml"};
  Situation s;
  const char* file = kCars[dice.of(4)];
  s.words = "seed " + std::to_string(seed) + ", " + name(level) + ", " + file;
  s.options.vehicle = test::car(file), s.options.vehicle_place = file;
  s.options.level = level, s.options.integrator = batch::integrator_of(level);
  // A row a step: at a standstill forces take turns, and of every second one they would seem to be all alike.
  s.options.step_s = 0.001, s.options.output_hz = 1000.0, s.options.columns = batch::kEnergy;
  s.options.speed_mps = dice.once_in(5) ? 0.0 : dice.within(-4.0, 38.0);
  lay_random_road(dice, s);
  press_at_random(dice, seconds, s);
  return s;
}

std::uint64_t number_in(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// What the models make of nothing, by choice (docs/dynamics.md, "Choices that show"): the road's force has a lever
// about the centre of gravity that turns the body, and its contact does not move with that turning.
struct Pushed {
  double along_n = 0.0, aside_n = 0.0;  // of all tyres, along the car's axes, mean of two rows
};
Pushed pushed(const batch::Row& a, const batch::Row& b) {
  Pushed sum;
  for (const batch::Row* row : {&a, &b})
    for (std::size_t i = 0; i < 4; ++i) {
      const double steer = i < 2 ? row->steer_rad : 0.0;
      sum.along_n += 0.5 * (row->fx_n[i] * std::cos(steer) - row->fy_n[i] * std::sin(steer));
      sum.aside_n += 0.5 * (row->fx_n[i] * std::sin(steer) + row->fy_n[i] * std::cos(steer));
    }
  return sum;
}

// The plane under a car that looks there: > 0 rises ahead, and to the left.
struct Slopes {
  double ahead = 0.0, left = 0.0;
};
Slopes slopes(const Road& road, double yaw_rad) {
  const double c = std::cos(yaw_rad), sn = std::sin(yaw_rad);
  return {road.slope_x * c + road.slope_y * sn, road.slope_y * c - road.slope_x * sn};
}

// Of full the body turns over the plane: on a slope a car that steers pitches and rolls in the world without any
// turning of its body.
double lever_of_full_j(const full::Params& p, const Road& road, const batch::Row& a, const batch::Row& b) {
  const auto over_plane = [&](const batch::Row& row) {
    const Slopes plane = slopes(road, row.yaw_rad);
    const double pitch = -std::atan(plane.ahead);
    return std::pair(row.pitch_rad - pitch, row.roll_rad - std::atan(plane.left * std::cos(pitch)));
  };
  const auto [pitch_a, roll_a] = over_plane(a);
  const auto [pitch_b, roll_b] = over_plane(b);
  const Pushed push = pushed(a, b);
  return -p.cg_height_m * push.along_n * (pitch_b - pitch_a) +
         p.sprung_kg / p.mass_kg * p.cg_height_m * push.aside_n * (roll_b - roll_a);
}

// Of single-track it turns by slopes in the world, and what leans it over is weighed in the stiffness of its roll.
double lever_of_single_track_j(const full::Params& p, const Road& road, const batch::Row& a, const batch::Row& b) {
  const auto turned = [](const batch::Row& row) {
    const double pitch = std::tan(row.pitch_rad);
    return std::pair(pitch, std::tan(row.roll_rad) * std::sqrt(1.0 + pitch * pitch));
  };
  const auto [pitch_a, roll_a] = turned(a);
  const auto [pitch_b, roll_b] = turned(b);
  const Slopes plane = slopes(road, 0.5 * (a.yaw_rad + b.yaw_rad));
  const Pushed push = pushed(a, b);
  const double felt_mps2 = push.aside_n / p.mass_kg * (1.0 + plane.left * plane.left),
               leant_mps2 = kGravity_mps2 * (0.5 * (roll_a + roll_b) - plane.left);
  return -p.cg_height_m * push.along_n * (1.0 + plane.ahead * plane.ahead) * (pitch_b - pitch_a) +
         p.sprung_kg * p.cg_height_m * (felt_mps2 + leant_mps2) * (roll_b - roll_a);
}

// Of what was turned over, 5 kJ at least: the half percent that every manoeuvre is asked for (energy_test.cpp).
constexpr double kMostMissing = 0.005;
// Of a car that tips over, beyond this, the levers change with its angles, which they are not asked for: one in 8,700
// drives has 0.59 %.
constexpr double kTips_rad = 0.35, kMostMissingTipping = 0.01;

TEST(RandomDriving, KeepsItsEnergy) {
  const std::uint64_t first = number_in("PHARE_SEED", 15),
                      drives = number_in("PHARE_DRIVES", test::long_run() ? 2000 : 6);
  double worst = 0.0;
  std::string where;
  for (std::uint64_t seed = first; seed < first + drives; ++seed)
    for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
      Situation s = random_situation(seed, level, 10.0);
      s.options.road = &s.road;
      const full::Params car = test::full_car(s.options.vehicle_place.c_str());
      double given_j = 0.0, most_j = 0.0, missing = 0.0, tipping = 0.0, lever_j = 0.0;
      bool tumbles = false, tips = false;
      std::optional<batch::Row> start, before;
      const auto done = batch::run(s.options, s.inputs, [&](const batch::Row& row) {
        if (!start) start = before = row;
        given_j += std::abs(row.engine_j - before->engine_j) + std::abs(row.road_j - before->road_j);
        most_j = std::max(most_j, std::abs(row.car_j));
        if (level == Level::kFull) lever_j += lever_of_full_j(car, s.road, *before, row);
        if (level == Level::kSingleTrack) lever_j += lever_of_single_track_j(car, s.road, *before, row);
        const double left = lever_j + row.engine_j + row.road_j - (row.car_j - start->car_j) - row.brakes_j -
                            row.tyres_j - row.dampers_j - row.air_j;
        // A car that tumbles turns about its own axes and no longer by the sum of two angles, as the levers have it.
        tumbles = tumbles || std::abs(row.roll_rad) > 0.5 || std::abs(row.pitch_rad) > 0.5;
        tips = tips || std::abs(row.roll_rad) > kTips_rad || std::abs(row.pitch_rad) > kTips_rad;
        const double share = std::abs(left) / (std::max(most_j, 5e3) + given_j);
        if (!tumbles) (tips ? tipping : missing) = std::max(tips ? tipping : missing, share);
        before = row;
      });
      ASSERT_TRUE(done.ok()) << s.words << ": " << done.error().text();
      EXPECT_LT(missing, kMostMissing) << s.words;
      EXPECT_LT(tipping, kMostMissingTipping) << s.words << (done->rolled_over_s ? ", rolled over" : "");
      if (missing > worst) worst = missing, where = s.words;
    }
  std::printf("seeds %llu to %llu: %.3f %% missing at the most (%s)\n", static_cast<unsigned long long>(first),
              static_cast<unsigned long long>(first + drives - 1), 100.0 * worst, where.c_str());
}

}  // namespace
}  // namespace phare
