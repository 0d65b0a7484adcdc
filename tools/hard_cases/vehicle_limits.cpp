// The car at its limits, and the loop that drives it: kerbs, spins, wheels in the air, stalls, inputs that are none.
#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "config/base/conventions.h"
#include "config/base/paths.h"
#include "config/vehicle.h"
#include "tools/hard_cases/hard_case.h"
#include "vehicle_dynamics/models/full.h"
#include "vehicle_dynamics/step.h"

namespace phare::hard {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

Result<VehicleParams> shipped_car() {
  return read_vehicle(config_dir() / "vehicles/bmw_320i.toml");
}

/// The shipped car at level full by torques alone, without air and rolling resistance: for closed forms.
struct Driven {
  full::Params car;
  full::Input input;
  full::State state;
  double time_s = 0.0;

  Driven(const full::Params& params, double speed_mps, const Road* road = nullptr) : car(params) {
    input.road = road;
    input.air_and_rolling = false;
    std::array<double, 4> height_m{};
    bool off = false;
    if (road != nullptr)
      for (std::size_t i = 0; i < 4; ++i)
        height_m[i] = road->at(car.x_m[i], car.y_m[i], car.x_m[i], car.y_m[i] > 0.0, 0.0, &off).z_m;
    state = full::at_rest(car, 0.0, 0.0, 0.0, speed_mps, height_m);
  }
  full::Forces forces() const { return full::forces(car, input, state); }
  double speed_mps() const { return std::hypot(state.u_mps, state.v_mps); }

  /// `each` before every step and once after the last.
  template <class Each>
  void run(double seconds, double step_s, Each&& each) {
    for (long left = std::lround(seconds / step_s); left > 0; --left) {
      each(*this);
      full::advance(car, input, state, step_s);
      time_s += step_s;
    }
    each(*this);
  }
};

/// Runs with the parameters of the shipped car at level full, springs without stops.
template <class Run>
Outcome with_car(Run&& run) {
  const Result<VehicleParams> vehicle = shipped_car();
  if (!vehicle) return {.error = vehicle.error().text()};
  Result<full::Params> car = full::params_of(*vehicle, "bmw_320i.toml");
  if (!car) return {.error = car.error().text()};
  car->bump_travel_m = car->rebound_travel_m = 1.0;
  return run(*car);
}

struct Kerb {
  double load_n = 0.0, pitch_rad = 0.0;  ///< most of them, in front
};

Kerb over_a_kerb(const full::Params& car, double step_s) {
  Driven driven(car, 50.0 / 3.6);
  driven.input.heights_given = true;
  Kerb most;
  driven.run(2.0, step_s, [&](Driven& now) {
    for (std::size_t i = 0; i < 4; ++i) now.input.height_m[i] = now.state.x_m + now.car.x_m[i] > 8.0 ? 0.10 : 0.0;
    const full::Forces forces = now.forces();
    most.load_n = std::max(most.load_n, forces.load_n[0]);
    most.pitch_rad = std::max(most.pitch_rad, std::abs(forces.pitch_rad));
  });
  return most;
}

Outcome kerb_load(const Bench&) {
  return with_car([](const full::Params& car) {
    // With the front axle up, its tyres are squeezed along the normal of a plane that has tilted by atan(h/L).
    const double cosine = std::cos(std::atan(0.10 / car.wheelbase_m));
    const double squeezed_m = 0.10 + (car.radius_m - 0.10) * (1.0 - cosine);
    const double expected_n = car.load_n[0] + car.tyre_rate_npm * squeezed_m;
    Outcome outcome;
    for (const double step_s : {0.002, 0.001, 0.0002})
      outcome.float64.push_back({1e3 * step_s, std::abs(over_a_kerb(car, step_s).load_n - expected_n)});
    return outcome;
  });
}

Outcome kerb_pitch(const Bench&) {
  return with_car([](const full::Params& car) {
    const double finest_rad = over_a_kerb(car, 0.0001).pitch_rad;
    Outcome outcome;
    for (const double step_s : {0.002, 0.001})
      outcome.float64.push_back({1e3 * step_s, kDegrees * std::abs(over_a_kerb(car, step_s).pitch_rad - finest_rad)});
    return outcome;
  });
}

/// Degrees turned until the car stands.
double spun_deg(const full::Params& car, double step_s) {
  Road wet;
  wet.friction_everywhere = 0.3;
  Driven driven(car, 20.0, &wet);
  driven.state.r_radps = 4.0;
  driven.state.spin_radps = {};
  driven.input.brake_nm.fill(1e5);
  double turned_rad = 0.0, last_rad = 0.0;
  driven.run(12.0, step_s, [&](const Driven& now) {
    const double yaw_rad = now.forces().yaw_rad;
    turned_rad += std::remainder(yaw_rad - last_rad, 2.0 * 3.14159265358979323846);
    last_rad = yaw_rad;
  });
  return kDegrees * turned_rad;
}

Outcome spin(const Bench&) {
  return with_car([](const full::Params& car) {
    const double finest_deg = spun_deg(car, 0.00025);
    Outcome outcome;
    for (const double step_s : {0.002, 0.001})
      outcome.float64.push_back({1e3 * step_s, std::abs(spun_deg(car, step_s) / finest_deg - 1.0)});
    return outcome;
  });
}

Outcome split_friction(const Bench&) {
  return with_car([](const full::Params& car) {
    constexpr std::array<double, 4> kFriction{1.0, 0.1, 1.0, 0.1};
    Road split;
    split.friction = {{.from_m = -1e9, .to_m = 1e9, .left = 1.0, .right = 0.1}};
    Driven driven(car, 100.0 / 3.6, &split);
    const double torque_nm = car.mass_kg * 7.0 * car.radius_m;
    driven.input.brake_nm = {0.33 * torque_nm, 0.33 * torque_nm, 0.17 * torque_nm, 0.17 * torque_nm};
    Outcome outcome;
    driven.run(10.0, 0.001, [&](const Driven& now) {
      const full::Forces forces = now.forces();
      double most = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double held_n = kFriction[i] * std::max(forces.load_n[i], 1e-6);
        most = std::max(most, std::hypot(forces.fx_n[i] / (car.tyre.p.long_peak * held_n),
                                         forces.fy_n[i] / (car.tyre.p.lat_peak * held_n)));
      }
      if (outcome.float64.empty() || now.time_s > outcome.float64.back().at + 0.01)
        outcome.float64.push_back({now.time_s, 0.0});
      outcome.float64.back().value = std::max(outcome.float64.back().value, most - 1.0);
    });
    return outcome;
  });
}

Outcome full_lock(const Bench&) {
  return with_car([](const full::Params& car) {
    Outcome outcome;
    for (const double ackermann_01 : {1.0, 0.0}) {
      full::Params steered = car;
      steered.ackermann_01 = ackermann_01;
      Driven driven(steered, 1.4);
      double low = std::numeric_limits<double>::max(), high = -low;
      driven.run(20.0, 0.002, [&](Driven& now) {
        now.input.steer_rad = 0.6 * std::min(1.0, now.time_s);
        const double missing_nm = 500.0 * (1.4 - now.state.u_mps);
        now.input.drive_nm = {0.0, 0.0, missing_nm, missing_nm};
        if (now.time_s > 15.0) low = std::min(low, now.state.r_radps), high = std::max(high, now.state.r_radps);
      });
      outcome.float64.push_back({ackermann_01, high - low});
    }
    return outcome;
  });
}

Outcome wheels_in_the_air(const Bench&) {
  return with_car([](const full::Params& car) {
    Road kerb;
    kerb.profiles.push_back(HeightProfile::bumps(
        {{.shape = Bump::Shape::kCosine, .start_m = 5.0, .height_m = 0.12, .length_m = 1.0, .right = false}}));
    Driven driven(car, 15.0, &kerb);
    Outcome outcome;
    double behind_it_j = 0.0, in_air_s = 0.0;
    driven.run(3.0, 0.001, [&](const Driven& now) {
      const full::Forces forces = now.forces();
      for (const double load_n : forces.load_n) in_air_s += load_n == 0.0 ? 0.001 : 0.0;
      // Over the kerb the road does work; behind it energy may only fall.
      if (now.state.path_m + now.car.x_m[2] < 6.1) return;
      const double energy_j = full::energy_j(now.car, now.state, forces);
      if (behind_it_j == 0.0) behind_it_j = energy_j;
      outcome.float64.push_back({now.time_s, std::max(energy_j / behind_it_j - 1.0, 0.0)});
    });
    if (in_air_s == 0.0) return Outcome{.error = "no wheel left the road"};
    return outcome;
  });
}

std::vector<double> undamped_energy_j(full::Params car, double step_s) {
  car.damper_nspm = {};
  car.integrator = Integrator::kRk4;
  Driven driven(car, 0.0);
  driven.state.z_m = 0.030;
  constexpr double kPitch_rad = 0.010;
  driven.state.qw = std::cos(0.5 * kPitch_rad), driven.state.qy = std::sin(0.5 * kPitch_rad);
  // Wheels where spring and tyre balance: without dampers they would hop on for ever.
  for (std::size_t i = 0; i < 4; ++i)
    driven.state.travel_m[i] = -(driven.state.z_m - car.x_m[i] * std::sin(kPitch_rad)) * car.tyre_rate_npm /
                               (car.tyre_rate_npm + car.spring_npm[i]);
  std::vector<double> energy_j;
  for (int i = 0; i < 200; ++i) {
    driven.run(0.1, step_s, [](const Driven&) {});
    energy_j.push_back(full::energy_j(driven.car, driven.state, driven.forces()));
  }
  return energy_j;
}

Outcome undamped(const Bench&) {
  return with_car([](const full::Params& car) {
    const std::vector<double> finest = undamped_energy_j(car, 0.0002), shown = undamped_energy_j(car, 0.001);
    Outcome outcome;
    for (std::size_t i = 0; i < shown.size(); ++i)
      outcome.float64.push_back({0.1 * static_cast<double>(i + 1), std::abs(shown[i] / finest[i] - 1.0)});
    return outcome;
  });
}

Outcome straight_on(const Bench&) {
  return with_car([](const full::Params& car) {
    Driven driven(car, 30.0);
    Outcome outcome;
    for (int minute = 1; minute <= 3; ++minute) {
      driven.run(60.0, 0.002, [](const Driven&) {});
      outcome.float64.push_back({60.0 * minute, std::abs(driven.state.y_m) + std::abs(driven.forces().yaw_rad)});
    }
    return outcome;
  });
}

/// The loop that drives the shipped hatchback, which has lamps, engine and gears.
Result<RunSetup> hatchback(Level level) {
  Result<VehicleParams> vehicle = read_vehicle(config_dir() / "vehicles/hatchback.toml");
  if (!vehicle) return vehicle.error();
  RunSetup setup;
  setup.vehicle = std::move(*vehicle);
  setup.level = level;
  Result<SprungParams> sprung = SprungParams::of(setup.vehicle, "hatchback.toml");
  if (!sprung) return sprung.error();
  setup.sprung = std::move(*sprung);
  return setup;
}

CarState rolling(double speed_mps) {
  CarState state;
  state.speed_mps = speed_mps;
  return state;
}

Outcome wheel_thrown(const Bench&) {
  Outcome outcome;
  for (const Level level : {Level::kSingleTrack, Level::kFull}) {
    Result<RunSetup> setup = hatchback(level);
    if (!setup) return {.error = setup.error().text()};
    StepLoop loop(*setup, rolling(120.0 / 3.6));
    for (int i = 0; i < 5000; ++i) {
      const int half_wave = i * 2 * 60 / 1000;
      loop.set_controls({.steering_wheel_rad = half_wave % 2 == 0 ? 9.0 : -9.0});
      loop.run_to(SimTime{static_cast<std::int64_t>(i + 1) * 2'000'000});
      const double felt_g = std::abs(loop.state().ay_mps2) / kGravity_mps2;
      outcome.float64.push_back({0.002 * (i + 1), std::isfinite(loop.state().roll_rad) ? felt_g : INFINITY});
    }
  }
  return outcome;
}

Outcome levels_change(const Bench&) {
  Result<RunSetup> setup = hatchback(Level::kFull);
  if (!setup) return {.error = setup.error().text()};
  constexpr std::array<Level, 4> kOrder{Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kSingleTrack};
  CarState state = rolling(50.0 / 3.6);
  SimTime time{};
  Outcome outcome;
  for (std::size_t change = 0; change < 60; ++change) {
    setup->level = kOrder[change % 4];
    StepLoop part(*setup, state, time);
    const double before_rad = state.road_pitch_rad + state.pitch_rad;
    const double jump_rad = std::abs(part.at(time).pitch_rad - before_rad);
    // And over the first step after it: beside where the pitch was going.
    part.set_controls({.steering_wheel_rad = 0.25 * std::sin(1.2 * time.seconds()), .gear = Gear::kNeutral});
    part.run_to(SimTime{time.ns + setup->step.ns});
    const CarState& now = part.state();
    const double bend_rad = std::abs(now.road_pitch_rad + now.pitch_rad - before_rad -
                                     setup->step.seconds() * (state.road_pitch_rate_radps + state.pitch_rate_radps));
    outcome.float64.push_back({time.seconds(), 1e3 * std::max(jump_rad, bend_rad)});
    for (int i = 0; i < 5; ++i) {
      part.set_controls({.steering_wheel_rad = 0.25 * std::sin(1.2 * time.seconds()), .gear = Gear::kNeutral});
      time.ns += 100'000'000;
      part.run_to(time);
    }
    state = part.state();
  }
  return outcome;
}

Outcome random_pedals(const Bench& bench) {
  std::mt19937_64 random(bench.seed);
  const auto within = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Outcome outcome;
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kAuto}) {
    Result<RunSetup> setup = hatchback(level);
    if (!setup) return {.error = setup.error().text()};
    setup->on_top.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kC, 3, 200.0));
    setup->on_top.friction = {{.from_m = 30.0, .to_m = 60.0, .left = 0.1, .right = 0.8}};
    StepLoop loop(*setup, CarState{});
    for (int i = 0; i < 200; ++i) {
      loop.set_controls({.steering_wheel_rad = within(-12.0, 12.0),
                         .accelerator_01 = within(-0.5, 1.5),
                         .brake_01 = std::max(0.0, within(-2.0, 1.5)),
                         .gear = static_cast<Gear>(random() % 4)});
      std::feclearexcept(FE_ALL_EXCEPT);
      loop.run_to(SimTime{(i + 1) * 100'000'000ll});
      const CarState& s = loop.state();
      const bool sound = std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0 && std::isfinite(s.x_m) &&
                         std::isfinite(s.pitch_rad) && std::abs(s.speed_mps) < 120.0;
      outcome.float64.push_back({0.1 * (i + 1), sound ? 0.0 : 1.0});
    }
  }
  return outcome;
}

Outcome inputs_that_are_none(const Bench&) {
  Outcome outcome;
  constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kAuto}) {
    Result<RunSetup> setup = hatchback(level);
    if (!setup) return {.error = setup.error().text()};
    StepLoop loop(*setup, rolling(20.0));
    std::uint64_t refused = 0;
    std::int64_t time_ns = 0;
    for (const double bad : {kNan, kInf, -kInf, 1e308, -1e308, 1e-310}) {
      for (int which = 0; which < 3; ++which) {
        Controls controls{.accelerator_01 = 0.2};
        (which == 0 ? controls.steering_wheel_rad : which == 1 ? controls.accelerator_01 : controls.brake_01) = bad;
        loop.set_controls(controls);
        if (!std::isfinite(bad)) ++refused;
        loop.run_to(SimTime{time_ns += 50'000'000});
        const CarState& s = loop.state();
        const bool sound = std::isfinite(s.x_m) && std::isfinite(s.pitch_rad) && std::isfinite(s.steer_rad) &&
                           std::abs(s.steer_rad) < 1.0;
        const bool counted = loop.controls_refused() == refused;
        outcome.float64.push_back({1e-9 * static_cast<double>(time_ns), sound && counted ? 0.0 : 1.0});
      }
    }
  }
  return outcome;
}

/// The same steps asked for in pieces of 1 to 33 ms, and in one after stalls of half a second.
Outcome jitter(const Bench& bench) {
  Outcome outcome;
  Result<RunSetup> setup = hatchback(Level::kFull);
  if (!setup) return {.error = setup.error().text()};
  setup->on_top.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kC, 3, 200.0));
  const Controls controls{.steering_wheel_rad = 0.3, .accelerator_01 = 0.3};
  StepLoop even(*setup, rolling(20.0)), uneven(*setup, rolling(20.0));
  even.set_controls(controls), uneven.set_controls(controls);
  std::mt19937_64 random(bench.seed);
  for (std::int64_t time_ms = 0, piece = 0; time_ms < 20'000; ++piece) {
    time_ms += piece % 60 == 59 ? 500 : 1 + static_cast<std::int64_t>(random() % 33);
    uneven.run_to(SimTime{time_ms * 1'000'000});
    for (std::int64_t to = even.time().ns; to < uneven.time().ns;) even.run_to(SimTime{to += 2'000'000});
    const bool same =
        even.steps() == uneven.steps() && even.at(even.time()).state_hash == uneven.at(uneven.time()).state_hash;
    outcome.float64.push_back({1e-3 * static_cast<double>(time_ms), same ? 0.0 : 1.0});
  }
  return outcome;
}

}  // namespace

std::vector<HardCase> vehicle_limit_cases() {
  const auto car = std::bind_front(float64_case, "The car");
  return {
      car("kerb-load", "a step in the road gives a force that depends on the time step, or none",
          "a kerb of 0.10 m at 50 km/h, steps of 2, 1 and 0.2 ms, level full", "N beside static load + rate × squeeze",
          "step, ms", 1e-6, "closed form: a force is a function of the state, whatever the step", kerb_load),
      car("kerb-pitch", "how far the cut-off jumps over a kerb depends on the time step",
          "the same, against steps of 0.1 ms", "° of pitch at its most", "step, ms", 0.02,
          "9 mm of the cut-off on a wall at 25 m; at which moment of a step a wheel meets the kerb is not resolved",
          kerb_pitch),
      car("spin", "slip angles beyond 90°, speeds through 0: the spin ends anywhere",
          "20 m/s, turning at 4 rad/s, wheels locked, friction 0.3, to a stand, against steps of 0.25 ms, level full",
          "of the turn, apart", "step, ms", 1e-3,
          "at 20 m/s this file's tyres settle within 1 ms, a step: 1e-3 of 1,150° is 1.2°", spin),
      car("split-friction", "the tyres give more than friction × load while one side slides",
          "100 km/h, braked by 7 m/s², friction 1 left and 0.1 right, level full", "of the friction ellipse, beyond 1",
          "time, s", 1e-3, "the ellipse, and the load within the step", split_friction),
      car("full-lock", "parallel front wheels fight each other and the car shakes for ever",
          "walking pace, wheels at 0.6 rad, Ackermann 1 and 0, level full", "rad/s of ripple after 15 s",
          "Ackermann share", 1e-5, "what nobody sees in a cut-off: 1e-5 rad in a second", full_lock),
      car("wheels-in-the-air", "a wheel that comes back to the road brings energy with it",
          "54 km/h, a bump of 0.12 m under the left wheels, level full", "of the car's energy, gained behind it",
          "time, s", 1e-3, "energy may only fall; 0.1 % is the step's", wheels_in_the_air),
      car("undamped", "springs without dampers gain energy by the integrator until the car flies",
          "20 s lifted by 30 mm and pitched by 10 mrad, no dampers, steps of 1 ms against 0.2 ms, level full",
          "of the energy, apart", "time, s", 2.5e-5,
          "fourth order loses (ωh)⁶/144 a step: for wheel hop at 12 Hz, the stiffest mode, 2.5e-5 in 20,000", undamped),
      car("straight-on", "rounding turns a car that nobody steers", "three minutes at 108 km/h, hands off, level full",
          "m and rad off its line", "time, s", 1e-9, "left and right are summed alike: nothing to grow", straight_on),
      car("wheel-thrown", "a wheel thrown from lock to lock gives accelerations that no tyre holds",
          "lock to lock 30 times a second at 120 km/h, levels single-track and full", "g across", "time, s", 1.2,
          "the tyre file's peak friction is 1.17", wheel_thrown),
      car("levels-change", "the picture jumps when a finer model takes over",
          "the level changes every half second through lane changes at 50 km/h",
          "mrad of pitch, at once or bent in a step", "time, s", 0.05, "1.2 mm on a wall at 25 m", levels_change),
      car("random-pedals", "some order of pedals, gears and wheel divides by zero",
          "20 s at each level, inputs at random and beyond their ranges, rough and icy road",
          "moments not finite, or past an invalid operation", "time, s", 0.0, "none may be", random_pedals),
      car("inputs-that-are-none", "one NaN from a pedal and the car is gone",
          "NaN, infinity, 1e308 and 1e-310 for wheel, accelerator and brake at each level",
          "moments not finite, or not counted as refused", "time, s", 0.0, "none may be", inputs_that_are_none),
      car("jitter", "the motion depends on how the frames fall",
          "pieces of 1 to 33 ms and of 500 ms, against even steps", "states that are not the same, bit for bit",
          "time, s", 0.0, "the same steps", jitter)};
}

}  // namespace phare::hard
