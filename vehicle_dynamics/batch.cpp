#include "vehicle_dynamics/batch.h"

#include <chrono>
#include <cmath>

#include "vehicle_dynamics/batch_car.h"

namespace phare::batch {
namespace {

Row between(const Row& a, const Row& b, double u) {
  static_assert(sizeof(Row) == 74 * sizeof(double), "a row is doubles only");
  Row out;
  const auto *pa = &a.time_s, *pb = &b.time_s;
  auto* po = &out.time_s;
  for (std::size_t i = 0; i < sizeof(Row) / sizeof(double); ++i) po[i] = pa[i] + u * (pb[i] - pa[i]);
  return out;
}

}  // namespace

const char* name(Integrator integrator) {
  switch (integrator) {
    case Integrator::kSemiImplicitEuler:
      return "semi-implicit-euler";
    case Integrator::kEtd2:
      return "etd2";
    case Integrator::kRk4:
      return "rk4";
    case Integrator::kReference:
      return "reference";
  }
  return "";
}

namespace {

// What can be said before the first step.
Status check(const Options& o, const Inputs& in) {
  const double span = in.time_s.back() - in.time_s.front();
  const std::size_t last = in.time_s.size() - 1;
  if (span > kMostSimulated_s) return Error{in.place(last), "more than 100 hours after the first row"};
  if (span < o.step_s * (1.0 - 1e-6))
    return Error{in.place(last),
                 "is " + text_of(span) + " s after the first row, less than a step of " + text_of(o.step_s) + " s"};
  if (span / o.step_s > kMostSteps)
    return Error{in.place(last),
                 text_of(span) + " s in steps of " + text_of(o.step_s) + " s are more than 2e9 of them"};
  if (span * o.output_hz > kMostRows)
    return Error{in.place(last), text_of(span) + " s at " + text_of(o.output_hz) + " Hz are more than 50 million rows"};
  const double lock_rad = o.vehicle.max_steering_wheel_rad / o.vehicle.steering_ratio;
  for (std::size_t row = 0; row < in.steer_rad.size(); ++row)
    if (std::abs(in.steer_rad[row]) > lock_rad * (1.0 + 1e-9))
      return Error{in.place(row),
                   "steer_rad " + text_of(in.steer_rad[row]) + " is beyond the car's lock of " + text_of(lock_rad)};
  if (o.levelling != levelling::Kind::kNone && !has_lamps(o.vehicle))
    return Error{o.vehicle_place, "has no table [levelling]: there are no lamps to level"};
  if (o.level == Level::kAuto && (in.accelerator_01.empty() || !in.road_m[0].empty()))
    return Error{in.file.empty() ? "inputs" : in.file,
                 "level auto looks at pedals and at the road ahead: not at torques, nor heights under the wheels"};
  if (o.level == Level::kAuto && o.columns & kEnergy)
    return Error{"--columns energy", "is kept by one level; auto changes it"};
  if (o.levelling == levelling::Kind::kManual && in.levelling_step.empty())
    return Error{in.file.empty() ? "inputs" : in.file, "levelling by hand needs the column levelling_step"};
  if (o.levelling != levelling::Kind::kManual && !in.levelling_step.empty())
    return Error{in.file.empty() ? "inputs" : in.file,
                 "the column levelling_step needs levelling by hand (--levelling manual)"};
  return Done{};
}

}  // namespace

Result<Summary> run(const Options& options, const Inputs& inputs, const std::function<void(const Row&)>& each) {
  const bool torques = inputs.accelerator_01.empty();
  if (Status sane = check(options, inputs); !sane) return sane.error();
  Summary summary;
  summary.resistance = options.resistance == Resistance::kOn || (options.resistance == Resistance::kAuto && !torques);
  DrivenCar car(options, summary.resistance, torques);
  if (Status ready = car.prepare(); !ready) return ready.error();
  Playhead in(inputs);
  std::array<double, 4> first{};
  if (!inputs.road_m[0].empty())
    for (std::size_t i = 0; i < 4; ++i) first[i] = inputs.road_m[i].front();
  if (Status placed = car.place(inputs.road_m[0].empty() ? nullptr : &first); !placed) return placed.error();
  car.stand(in, inputs, options.step_s);

  const double start = inputs.time_s.front(), end = inputs.time_s.back(), dt = options.step_s;
  const auto steps = static_cast<std::uint64_t>(std::llround(std::ceil((end - start) / dt - 1e-6)));
  const double every = 1.0 / options.output_hz;
  const LevellingParams& lamps = options.vehicle.levelling;
  // Rows cost about as much as a step: they are worked out where one is due, or where the lamps follow the car.
  const bool every_step = options.levelling != levelling::Kind::kNone || (options.road && options.road->mesh);
  // Rows are handed on by the thousand, so that what is done with them, writing above all, is not taken for the model's
  // time.
  std::vector<Row> waiting;
  waiting.reserve(1024);
  std::chrono::steady_clock::duration elsewhere{};
  const auto hand_on = [&] {
    const auto left = std::chrono::steady_clock::now();
    for (const Row& row : waiting) each(row);
    waiting.clear();
    elsewhere += std::chrono::steady_clock::now() - left;
  };
  Row before = car.row(start, 0.0);
  car.lamps(lamps, in.held(inputs.levelling_step), dt, before);
  waiting.push_back(before);
  summary.rows = 1;
  const auto failed = [&](double time_s, const std::string& what) {
    const bool own = options.level == Level::kKinematic;
    return Error{inputs.place(in.row()), "at " + text_of(time_s) + " s, level " + phare::name(options.level) +
                                             (own ? "" : std::string(", ") + name(options.integrator)) + ", step " +
                                             text_of(dt) + " s: " + what};
  };
  constexpr const char* kUnsound =
      "the motion is not finite or no car's; a shorter step may help, or inputs that a car can follow";
  const auto begin = std::chrono::steady_clock::now();
  std::uint64_t done = 0;
  for (std::uint64_t n = 0; n < steps; ++n) {
    const double from = start + static_cast<double>(n) * dt, to = start + static_cast<double>(n + 1) * dt;
    const auto due = [&] { return start + static_cast<double>(summary.rows) * every; };
    const bool reached = due() <= to + 1e-9 * every && due() <= end + 1e-6 * every;
    if (reached && !every_step && due() < to - 1e-9) {
      before = car.row(from, 0.0);
      car.lamps(lamps, 0.0, dt, before);
    }
    if (!car.step(in, inputs, from, dt)) return failed(from, car.gave_up().error().reason);
    if (!car.sound()) return failed(to, kUnsound);
    if (options.stop && (n % 64 == 0 || options.integrator == Integrator::kReference) && options.stop())
      return failed(to, "stopped from outside");
    done = n + 1;
    if (!reached && !every_step) continue;
    Row now = car.row(to, dt);
    car.lamps(lamps, in.held(inputs.levelling_step), dt, now);
    if (car.burst()) return failed(to, kUnsound);
    for (; due() <= to + 1e-9 * every && due() <= end + 1e-6 * every; ++summary.rows) {
      const double time = due();
      Row out = std::abs(time - to) < 1e-9 ? now : between(before, now, (time - from) / dt);
      out.time_s = time;
      if (!all_finite(out)) return failed(time, kUnsound);
      waiting.push_back(out);
      if (waiting.size() == waiting.capacity()) hand_on();
    }
    before = now;
    if (car.rolled_over_s() || (options.ends_at_rest && car.at_rest())) break;
  }
  hand_on();
  summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin - elsewhere).count();
  summary.steps = done;
  summary.simulated_s = static_cast<double>(done) * dt;
  summary.state_hash = car.hash();
  summary.off_road = car.off_road();
  summary.rolled_over_s = car.rolled_over_s();
  const AutoLevel& choice = car.choice();
  summary.switches = choice.switches(), summary.level_s = choice.seconds();
  for (std::uint64_t n = summary.switches - std::min(summary.switches, AutoLevel::kKept); n < summary.switches; ++n)
    summary.switched.push_back(choice.change(n));
  return summary;
}

}  // namespace phare::batch
