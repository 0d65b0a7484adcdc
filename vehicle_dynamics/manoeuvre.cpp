#include "vehicle_dynamics/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/base/conventions.h"

namespace phare::batch {
namespace {

constexpr double kPerDeg = 180.0 / std::numbers::pi;
constexpr double kBegin_s = 1.0;  // straight ahead before anything happens

// Rows of inputs with pedals: time, road-wheel angle, brake.
struct Track {
  Inputs in;
  void add(double time_s, double steer_rad, double brake_01 = 0.0) {
    in.time_s.push_back(time_s), in.steer_rad.push_back(steer_rad);
    in.accelerator_01.push_back(0.0), in.brake_01.push_back(brake_01), in.gear.push_back(0.0);
  }
};

// Road-wheel angle that a neutral car needs for a lateral acceleration.
double steer_for(const VehicleParams& v, double ay_mps2, double speed_mps) {
  return ay_mps2 * v.wheelbase_m / (speed_mps * speed_mps);
}

// ---- ISO 4138: the wheel is turned by 2 degrees a second (chosen: half a minute), to twice what 8 m/s2 asks of a
// neutral car

Track slowly_increasing(const VehicleParams& v, double speed_mps) {
  const double rate = 2.0 / kPerDeg / v.steering_ratio;
  const double lock = 0.999 * v.max_steering_wheel_rad / v.steering_ratio;
  const double most = std::min(2.0 * steer_for(v, 8.0, speed_mps), lock);
  Track t;
  t.add(0.0, 0.0), t.add(kBegin_s, 0.0), t.add(kBegin_s + most / rate, most);
  return t;
}

// Slope of y over x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double mx = 0.0, my = 0.0, xy = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i], my += y[i];
  mx /= static_cast<double>(x.size()), my /= static_cast<double>(y.size());
  for (std::size_t i = 0; i < x.size(); ++i) xy += (x[i] - mx) * (y[i] - my), xx += (x[i] - mx) * (x[i] - mx);
  return xx > 0.0 ? xy / xx : std::nan("");
}

double steer_at(const Inputs& in, double time_s) {
  std::size_t i = 0;
  while (i + 2 < in.time_s.size() && in.time_s[i + 1] <= time_s) ++i;
  const double u = (time_s - in.time_s[i]) / (in.time_s[i + 1] - in.time_s[i]);
  return std::lerp(in.steer_rad[i], in.steer_rad[i + 1], std::clamp(u, 0.0, 1.0));
}

std::vector<Figure> of_circle(const Manoeuvre& m, const std::vector<Row>& rows) {
  std::vector<double> ay, over, roll, side;
  double most = 0.0;
  for (const Row& r : rows) {
    const double lateral = r.vx_mps * r.yaw_rate_radps;
    // Of circles: a car that spins out or tips over turns none any more. Chosen: the wheel rolls it by 0.3 degrees a
    // second.
    constexpr double kSteady_radps = 1.0 / kPerDeg;
    if (std::abs(r.roll_rate_radps) < kSteady_radps) most = std::max(most, lateral);
    if (lateral < 1.0 || lateral > 4.0) continue;  // where cars are linear
    ay.push_back(lateral), roll.push_back(r.roll_rad), side.push_back(std::atan2(r.vy_mps, r.vx_mps));
    over.push_back(steer_at(m.inputs, r.time_s) - m.options.vehicle.wheelbase_m * lateral / (r.vx_mps * r.vx_mps));
  }
  const double g = kGravity_mps2 * kPerDeg;
  return {{"understeer gradient", slope(ay, over) * g, "deg/g, at the road wheels"},
          {"roll gradient", slope(ay, roll) * g, "deg/g"},
          {"side slip gradient at the centre of gravity", slope(ay, side) * g, "deg/g"},
          {"largest lateral acceleration", most, "m/s2"}};
}

// ---- ISO 7401: a step to 4 m/s2 of a neutral car, at 500 degrees a second of the wheel

Track step_input(const VehicleParams& v, double speed_mps) {
  const double to = steer_for(v, 4.0, speed_mps), rate = 500.0 / kPerDeg / v.steering_ratio;
  Track t;
  t.add(0.0, 0.0), t.add(kBegin_s, 0.0), t.add(kBegin_s + to / rate, to), t.add(kBegin_s + 5.0, to);
  return t;
}

std::vector<Figure> of_step(const Manoeuvre& m, const std::vector<Row>& rows) {
  const double half_s = 0.5 * (m.inputs.time_s[1] + m.inputs.time_s[2]), to = m.inputs.steer_rad[2];
  double yaw = 0.0, ay = 0.0, roll = 0.0, count = 0.0, peak = 0.0, peak_s = 0.0, t90_s = std::nan(""), ay90_s = t90_s;
  for (const Row& r : rows)
    if (r.time_s > rows.back().time_s - 1.0)
      yaw += r.yaw_rate_radps, ay += r.vx_mps * r.yaw_rate_radps, roll += r.roll_rad, count += 1.0;
  yaw /= count, ay /= count, roll /= count;
  for (const Row& r : rows) {
    if (r.yaw_rate_radps > peak) peak = r.yaw_rate_radps, peak_s = r.time_s - half_s;
    if (std::isnan(t90_s) && r.yaw_rate_radps >= 0.9 * yaw) t90_s = r.time_s - half_s;
    if (std::isnan(ay90_s) && r.ay_mps2 >= 0.9 * ay) ay90_s = r.time_s - half_s;
  }
  return {{"steady lateral acceleration", ay, "m/s2"},
          {"steady yaw rate over road-wheel angle", yaw / to, "1/s"},
          {"yaw rate reaches 90 % after", t90_s, "s, from half the step"},
          {"lateral acceleration reaches 90 % after", ay90_s, "s"},
          {"yaw rate peaks after", peak_s, "s"},
          {"overshoot of the yaw rate", 100.0 * (peak / yaw - 1.0), "%"},
          {"steady roll", roll * kPerDeg, "deg"}};
}

// ---- ISO 19365: one period of 0.7 Hz with a dwell of 0.5 s at its second peak

Track sine_with_dwell(const VehicleParams& v, double speed_mps, double scale) {
  constexpr double kHz = 0.7, kDwell_s = 0.5;
  const double lock = 0.999 * v.max_steering_wheel_rad / v.steering_ratio;
  const double size = std::min(scale * steer_for(v, 0.3 * kGravity_mps2, speed_mps), lock);
  Track t;
  t.add(0.0, 0.0);
  const double dwell_at = 0.75 / kHz, end = 1.0 / kHz + kDwell_s;
  for (double s = 0.0; s < end; s += 0.01) {
    const double phase = s < dwell_at ? s : (s < dwell_at + kDwell_s ? dwell_at : s - kDwell_s);
    t.add(kBegin_s + s, size * std::sin(2.0 * std::numbers::pi * kHz * phase));
  }
  t.add(kBegin_s + end, 0.0), t.add(kBegin_s + end + 4.0, 0.0);
  return t;
}

std::vector<Figure> of_dwell(const Manoeuvre& m, const std::vector<Row>& rows) {
  const double completed_s = kBegin_s + 1.0 / 0.7 + 0.5, reversal_s = kBegin_s + 0.5 / 0.7;
  double peak = 0.0, aside = 0.0, size = 0.0;
  const auto nearest = [&](double time_s) {
    return *std::min_element(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
      return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
    });
  };
  for (const double steer : m.inputs.steer_rad) size = std::max(size, std::abs(steer));
  for (const Row& r : rows)  // the second peak, after the steering has changed its sign
    if (r.time_s > reversal_s && std::abs(r.yaw_rate_radps) > std::abs(peak)) peak = r.yaw_rate_radps;
  aside = nearest(kBegin_s + 1.07).y_m;
  return {{"amplitude at the road wheels", size * kPerDeg, "deg"},
          {"second peak of the yaw rate", peak * kPerDeg, "deg/s"},
          {"yaw rate 1.00 s after the steering, of that peak", 100.0 * nearest(completed_s + 1.0).yaw_rate_radps / peak,
           "% (35 at most)"},
          {"yaw rate 1.75 s after the steering, of that peak",
           100.0 * nearest(completed_s + 1.75).yaw_rate_radps / peak, "% (20 at most)"},
          {"lateral displacement 1.07 s after it began", std::abs(aside),
           "m (1.83 at least, from 5 times the 0.3 g angle)"}};
}

// ---- ISO 21994: full braking from the speed, in gear

Track full_stop(double speed_mps) {
  Track t;
  const double longest_s = 2.0 * speed_mps / (0.04 * kGravity_mps2);  // on ice
  t.add(0.0, 0.0), t.add(kBegin_s, 0.0), t.add(kBegin_s + 0.1, 0.0, 1.0), t.add(kBegin_s + longest_s, 0.0, 1.0);
  return t;
}

std::vector<Figure> of_stop(const std::vector<Row>& rows) {
  const Row* from = nullptr;
  const Row *at80 = nullptr, *at10 = nullptr, *end = &rows.back();
  double most_yaw = 0.0;
  for (const Row& r : rows) {
    if (!from && r.time_s >= kBegin_s) from = &r;
    if (!from) continue;
    if (!at80 && r.vx_mps <= 0.8 * from->vx_mps) at80 = &r;
    if (!at10 && r.vx_mps <= 0.1 * from->vx_mps) at10 = &r;
    most_yaw = std::max(most_yaw, std::abs(r.yaw_rad));
    if (r.vx_mps <= 0.01) {
      end = &r;
      break;
    }
  }
  const auto way = [](const Row& a, const Row& b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); };
  const double mfdd = at80 && at10
                          ? (at80->vx_mps * at80->vx_mps - at10->vx_mps * at10->vx_mps) / 2.0 / way(*at80, *at10)
                          : std::nan("");
  return {{"speed when the brake is applied", from->vx_mps * 3.6, "km/h"},
          {"stopping distance", end->vx_mps <= 0.01 ? way(*from, *end) : std::nan(""), "m"},
          {"stopping time", end->time_s - from->time_s, "s"},
          {"mean fully developed deceleration", mfdd, "m/s2"},
          {"largest yaw angle", most_yaw * kPerDeg, "deg"}};
}

// ---- ISO 3888-2: three lanes of cones, 61 m

struct Gate {
  double from_m, to_m, centre_m, width_m;
};
// The car's width: its track and 0.25 m, chosen (a tyre and half a mirror); the last lane is centred on the first.
std::array<Gate, 3> gates(const VehicleParams& v) {
  const double width = v.track_m + 0.25;
  const double first = 1.1 * width + 0.25, second = width + 1.0, third = std::max(1.3 * width + 0.25, 3.0);
  return {Gate{0.0, 12.0, 0.0, first}, Gate{25.5, 36.5, 0.5 * first + 1.0 + 0.5 * second, second},
          Gate{49.0, 61.0, 0.0, third}};
}
constexpr double kRunUp_m = 30.0;

std::vector<LanePoint> lane_change(const VehicleParams& v, double begin_x_m) {
  const auto g = gates(v);
  const auto aside = [&](double x) {
    const auto blend = [](double u) { return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(u, 0.0, 1.0)); };
    return g[1].centre_m *
           (blend((x - g[0].to_m) / (g[1].from_m - g[0].to_m)) - blend((x - g[1].to_m) / (g[2].from_m - g[1].to_m)));
  };
  std::vector<LanePoint> path;
  for (double x = -kRunUp_m - 5.0; x < 120.0; x += 0.5)
    path.push_back({.s_m = x,
                    .x_m = begin_x_m + x,
                    .y_m = aside(x),
                    .heading_rad = std::atan2(aside(x + 0.25) - aside(x - 0.25), 0.5)});
  return path;
}

// How far the corners of the car stay from the cones, < 0: beyond them.
std::vector<Figure> of_lane_change(const Manoeuvre& m, const std::vector<Row>& rows) {
  const VehicleParams& v = m.options.vehicle;
  const auto g = gates(v);
  std::array<double, 3> clear{1e9, 1e9, 1e9};
  double enters = 0.0, leaves = 0.0, most_roll = 0.0;
  const double half = 0.5 * (v.track_m + 0.25), front = v.cg_to_front_m, rear = v.cg_to_front_m - v.wheelbase_m;
  for (const Row& r : rows) {
    if (r.x_m <= 0.0) enters = r.vx_mps;
    if (r.x_m <= 61.0) leaves = r.vx_mps;
    most_roll = std::max(most_roll, std::abs(r.roll_rad));
    for (const double along : {front, rear})
      for (const double across : {half, -half}) {
        const double x = r.x_m + std::cos(r.yaw_rad) * along - std::sin(r.yaw_rad) * across;
        const double y = r.y_m + std::sin(r.yaw_rad) * along + std::cos(r.yaw_rad) * across;
        for (std::size_t k = 0; k < 3; ++k)
          if (x >= g[k].from_m && x <= g[k].to_m)
            clear[k] = std::min(clear[k], 0.5 * g[k].width_m - std::abs(y - g[k].centre_m));
      }
  }
  const double least = std::min({clear[0], clear[1], clear[2]});
  return {{"speed into the first lane", enters * 3.6, "km/h"},
          {"speed out of the last", leaves * 3.6, "km/h"},
          {"least distance to the cones, first lane", clear[0], "m"},
          {"least distance to the cones, second lane", clear[1], "m"},
          {"least distance to the cones, third lane", clear[2], "m"},
          {"cones stand", least > 0.0 ? 1.0 : 0.0, "(1: all of them)"},
          {"largest roll", most_roll * kPerDeg, "deg"}};
}

}  // namespace

Result<Manoeuvre> manoeuvre(std::string_view name, double speed_mps, double scale, Options o) {
  const auto at = std::find(kManoeuvreNames.begin(), kManoeuvreNames.end(), name);
  if (at == kManoeuvreNames.end()) return Error{"--manoeuvre " + std::string(name), "is none that is built in"};
  constexpr std::array<double, 5> kOwn_kmh{100.0, 80.0, 60.0, 80.0, 100.0};
  const auto index = static_cast<std::size_t>(at - kManoeuvreNames.begin());
  const double speed = speed_mps > 0.0 ? speed_mps : kOwn_kmh[index] / 3.6;
  Manoeuvre m{.name = std::string(name), .inputs = {}, .options = std::move(o)};
  const VehicleParams& v = m.options.vehicle;
  m.options.speed_mps = speed;
  m.options.output_hz = std::max(m.options.output_hz, kManoeuvreRows_hz);
  Track t;
  switch (index) {
    case 0:
      t = slowly_increasing(v, speed);
      m.options.driver.hold_speed_mps = speed;
      break;
    case 1:
      t = step_input(v, speed);
      m.options.driver.hold_speed_mps = speed;
      break;
    case 2:
      // The throttle is let go two metres into the first lane: the driver holds the speed until there.
      m.options.start_x_m = -kRunUp_m;
      m.options.driver.path = lane_change(v, 0.0);
      m.options.driver.hold_speed_mps = speed;
      m.options.driver.hold_until_x_m = 2.0;
      m.options.driver.preview_s = 0.45;
      t.add(0.0, 0.0), t.add((kRunUp_m + 75.0) / speed * 1.3, 0.0);
      break;
    case 3:
      t = sine_with_dwell(v, speed, scale);
      break;
    default:
      t = full_stop(speed);
      m.options.driver.hold_speed_mps = speed;
      m.options.driver.hold_until_x_m = speed * kBegin_s;
      m.options.ends_at_rest = true;
  }
  m.inputs = std::move(t.in);
  return m;
}

std::vector<Figure> figures(const Manoeuvre& m, const std::vector<Row>& rows) {
  if (m.name == "iso4138") return of_circle(m, rows);
  if (m.name == "iso7401") return of_step(m, rows);
  if (m.name == "iso3888-2") return of_lane_change(m, rows);
  if (m.name == "iso19365") return of_dwell(m, rows);
  return of_stop(rows);
}

}  // namespace phare::batch
