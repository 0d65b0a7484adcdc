#include "vehicle_dynamics/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
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

double lock_of(const VehicleParams& v) {
  return 0.999 * v.max_steering_wheel_rad / v.steering_ratio;
}

template <class... Numbers>
std::string said(const char* format, Numbers... numbers) {
  char text[120];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

// A number that may never have come about.
Figure figure(const char* what, double value, const char* unit, const std::string& without) {
  return {what, value, std::isnan(value) ? without : unit};
}

// Road-wheel angle that a neutral car needs for a lateral acceleration.
double steer_for(const VehicleParams& v, double ay_mps2, double speed_mps) {
  return ay_mps2 * v.wheelbase_m / (speed_mps * speed_mps);
}

// ---- ISO 4138: the wheel is turned so slowly that a neutral car gains 0.1 m/s2 a second, and by 2 degrees a second at
// the most, to twice what 8 m/s2 asks of a neutral car. Chosen: ten times slower the gradient of understeer is the same
// to 0.002 deg/g from 60 to 180 km/h; at 2 degrees a second that of the hatchback had 0.12 too much at 180.

Track slowly_increasing(const VehicleParams& v, double speed_mps) {
  constexpr double kRise_mps3 = 0.1;
  const double rate = std::min(steer_for(v, kRise_mps3, speed_mps), 2.0 / kPerDeg / v.steering_ratio);
  const double most = std::min(2.0 * steer_for(v, 8.0, speed_mps), lock_of(v));
  Track t;
  t.add(0.0, 0.0), t.add(kBegin_s, 0.0), t.add(kBegin_s + most / rate, most);
  return t;
}

// A line by least squares: through the means, with a slope of y over x.
struct Line {
  double mean_x = 0.0, mean_y = 0.0, slope = 0.0;
  double at(double x) const { return mean_y + slope * (x - mean_x); }
};
Line line(const std::vector<double>& x, const std::vector<double>& y) {
  double mx = 0.0, my = 0.0, xy = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i], my += y[i];
  mx /= static_cast<double>(x.size()), my /= static_cast<double>(y.size());
  for (std::size_t i = 0; i < x.size(); ++i) xy += (x[i] - mx) * (y[i] - my), xx += (x[i] - mx) * (x[i] - mx);
  return {mx, my, xx > 0.0 ? xy / xx : std::nan("")};
}

double steer_at(const Inputs& in, double time_s) {
  std::size_t i = 0;
  while (i + 2 < in.time_s.size() && in.time_s[i + 1] <= time_s) ++i;
  const double u = (time_s - in.time_s[i]) / (in.time_s[i + 1] - in.time_s[i]);
  return std::lerp(in.steer_rad[i], in.steer_rad[i + 1], std::clamp(u, 0.0, 1.0));
}

std::vector<Figure> of_circle(const Manoeuvre& m, const std::vector<Row>& rows) {
  constexpr double kFrom_mps2 = 1.0, kTo_mps2 = 4.0;  // where cars are linear
  constexpr double kEnough_mps2 = 2.0;                // chosen: less of it gives no slope
  constexpr double kHeld = 0.98;                      // chosen: of the speed, 2 km/h of 100
  std::vector<double> ay, over, roll, side;
  double most = 0.0, reached = 0.0, slowest_mps = std::numeric_limits<double>::infinity();
  for (const Row& r : rows) {
    const double lateral = r.vx_mps * r.yaw_rate_radps;
    // Of circles: a car that spins out or tips over turns none any more. Chosen: the wheel rolls it by less than 0.1
    // degrees a second.
    constexpr double kSteady_radps = 1.0 / kPerDeg;
    if (std::abs(r.roll_rate_radps) < kSteady_radps) most = std::max(most, lateral);
    const bool beyond = reached > kTo_mps2;  // what comes back from there, out of a spin, is no circle
    if (beyond) continue;
    reached = std::max(reached, lateral);
    if (lateral < kFrom_mps2 || lateral > kTo_mps2) continue;
    slowest_mps = std::min(slowest_mps, r.vx_mps);
    ay.push_back(lateral), roll.push_back(r.roll_rad), side.push_back(std::atan2(r.vy_mps, r.vx_mps));
    over.push_back(steer_at(m.inputs, r.time_s) - m.options.vehicle.wheelbase_m * lateral / (r.vx_mps * r.vx_mps));
  }
  const bool enough = reached >= kEnough_mps2;
  const std::string never = said("the lateral acceleration never reached %.0f m/s2", kEnough_mps2);
  const auto gradient = [&](const char* what, const std::vector<double>& of, const char* unit) {
    return figure(what, enough ? line(ay, of).slope * kGravity_mps2 * kPerDeg : std::nan(""), unit, never);
  };
  const bool held = slowest_mps >= kHeld * m.options.speed_mps;
  return {
      gradient("understeer gradient", over, "deg/g, at the road wheels"),
      gradient("roll gradient", roll, "deg/g"),
      gradient("side slip gradient at the centre of gravity", side, "deg/g"),
      {"largest lateral acceleration", most, "m/s2"},
      figure("lowest speed from 1 to 4 m/s2", enough ? slowest_mps * 3.6 : std::nan(""),
             held ? "km/h" : said("km/h: the car does not hold %.1f km/h", m.options.speed_mps * 3.6).c_str(), never)};
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
          figure("yaw rate reaches 90 % after", t90_s, "s, from half the step", "never reached"),
          figure("lateral acceleration reaches 90 % after", ay90_s, "s", "never reached"),
          {"yaw rate peaks after", peak_s, "s"},
          {"overshoot of the yaw rate", 100.0 * (peak / yaw - 1.0), "%"},
          {"steady roll", roll * kPerDeg, "deg"}};
}

// ---- ISO 19365: one period of 0.7 Hz with a dwell of 0.5 s at its second peak

// Road-wheel angle at which the car has 0.3 g: the wheel is turned by 13.5 degrees a second, and a line laid through
// 0.1 to 0.375 g. On a dry level road, whatever road the manoeuvre is driven on.
Result<double> angle_of_three_tenths(const Options& given, double speed_mps) {
  constexpr double kFrom_mps2 = 0.1 * kGravity_mps2, kTo_mps2 = 0.375 * kGravity_mps2;
  Options o = given;
  const VehicleParams& v = o.vehicle;
  o.integrator = integrator_of(o.level), o.step_s = 0.002, o.output_hz = kManoeuvreRows_hz;
  o.speed_mps = speed_mps, o.road = nullptr, o.levelling = levelling::Kind::kNone, o.columns = 0;
  o.driver.hold_speed_mps = speed_mps;
  const double rate = 13.5 / kPerDeg / v.steering_ratio;
  const double most = std::min(5.0 * steer_for(v, kTo_mps2, speed_mps), lock_of(v));
  Track t;
  t.add(0.0, 0.0), t.add(kBegin_s, 0.0), t.add(kBegin_s + most / rate, most);
  std::vector<double> ay, steer;
  bool reached = false;
  const Result<Summary> driven = run(o, t.in, [&](const Row& r) {
    const double lateral = r.vx_mps * r.yaw_rate_radps;
    reached = reached || lateral >= kTo_mps2;
    if (!reached && lateral >= kFrom_mps2) ay.push_back(lateral), steer.push_back(steer_at(t.in, r.time_s));
  });
  if (!driven) return driven.error();
  if (!reached)
    return Error{"--manoeuvre iso19365",
                 said("at %.1f km/h the car never has the 0.3 g that its steering is measured by", speed_mps * 3.6)};
  return line(ay, steer).at(0.3 * kGravity_mps2);
}

Track sine_with_dwell(const VehicleParams& v, double of_three_tenths_rad, double scale) {
  constexpr double kHz = 0.7, kDwell_s = 0.5;
  const double size = std::min(scale * of_three_tenths_rad, lock_of(v));
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
  const auto of_peak = [&](const char* what, double after_s, const char* unit) {
    const double time_s = completed_s + after_s;
    const bool driven = rows.back().time_s > time_s - 0.1 && peak != 0.0;
    return figure(what, driven ? 100.0 * nearest(time_s).yaw_rate_radps / peak : std::nan(""), unit,
                  "the run ends before it");
  };
  return {{"steering of 0.3 g at the road wheels", m.of_three_tenths_rad * kPerDeg,
           "deg, of a ramp of 13.5 degrees a second at the wheel"},
          {"amplitude at the road wheels", size * kPerDeg, "deg"},
          {"second peak of the yaw rate", peak * kPerDeg, "deg/s"},
          of_peak("yaw rate 1.00 s after the steering, of that peak", 1.0, "% (35 at most)"),
          of_peak("yaw rate 1.75 s after the steering, of that peak", 1.75, "% (20 at most)"),
          {"lateral displacement 1.07 s after it began", std::abs(aside),
           "m (1.83 at least, from 5 times the 0.3 g angle)"}};
}

// ---- ISO 21994: full braking from the speed, in gear. The distance is that from the speed asked for: the way goes
// with the square of the one that was driven.

Track full_stop(double speed_mps) {
  Track t;
  const double longest_s = 2.0 * speed_mps / (0.01 * kGravity_mps2);  // on the least friction there is
  t.add(0.0, 0.0), t.add(kBegin_s, 0.0), t.add(kBegin_s + 0.1, 0.0, 1.0), t.add(kBegin_s + longest_s, 0.0, 1.0);
  return t;
}

std::vector<Figure> of_stop(const Manoeuvre& m, const std::vector<Row>& rows) {
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
  const bool stopped = end->vx_mps <= 0.01;
  const std::string within = said("did not stop within %.1f s", rows.back().time_s - from->time_s);
  const double way_m = stopped ? way(*from, *end) : std::nan(""), faster = m.options.speed_mps / from->vx_mps;
  return {{"speed when the brake is applied", from->vx_mps * 3.6, "km/h"},
          {"stopping distance", way_m * faster * faster,
           stopped ? said("m, from %.1f km/h", m.options.speed_mps * 3.6) : within},
          figure("stopping distance as driven", way_m, "m", within),
          figure("stopping time", stopped ? end->time_s - from->time_s : std::nan(""), "s", within),
          figure("mean fully developed deceleration", mfdd, "m/s2", "the speed never fell to a tenth"),
          {"largest yaw angle", most_yaw * kPerDeg, "deg"}};
}

// ---- ISO 3888-2: three lanes of cones, 61 m

struct Gate {
  double from_m, to_m, centre_m, width_m;
};
// The car's width: its track and 0.25 m, chosen (a tyre and half a mirror); the last lane is centred on the first. A
// vehicle file has no overhangs, so the corners are those of that width at the axles.
std::array<Gate, 3> gates(const VehicleParams& v) {
  const double width = v.track_m + 0.25;
  const double first = 1.1 * width + 0.25, second = width + 1.0, third = std::max(1.3 * width + 0.25, 3.0);
  return {Gate{0.0, 12.0, 0.0, first}, Gate{25.5, 36.5, 0.5 * first + 1.0 + 0.5 * second, second},
          Gate{49.0, 61.0, 0.0, third}};
}
constexpr double kRunUp_m = 30.0, kRunOut_m = 14.0;

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

// How far the wheels stay from the cones, < 0: beyond them.
std::vector<Figure> of_lane_change(const Manoeuvre& m, const std::vector<Row>& rows) {
  const VehicleParams& v = m.options.vehicle;
  const auto g = gates(v);
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::array<double, 3> clear{kNever, kNever, kNever};
  double enters = 0.0, leaves = 0.0, most_roll = 0.0, through_m = -kNever;
  const double half = 0.5 * (v.track_m + 0.25), front = v.cg_to_front_m, rear = v.cg_to_front_m - v.wheelbase_m;
  for (const Row& r : rows) {
    if (r.x_m > g[2].to_m + kRunOut_m) break;
    if (r.x_m <= 0.0) enters = r.vx_mps;
    if (r.x_m <= g[2].to_m) leaves = r.vx_mps;
    most_roll = std::max(most_roll, std::abs(r.roll_rad));
    for (const double along : {front, rear})
      for (const double across : {half, -half}) {
        const double x = r.x_m + std::cos(r.yaw_rad) * along - std::sin(r.yaw_rad) * across;
        const double y = r.y_m + std::sin(r.yaw_rad) * along + std::cos(r.yaw_rad) * across;
        for (std::size_t k = 0; k < 3; ++k)
          if (x >= g[k].from_m && x <= g[k].to_m)
            clear[k] = std::min(clear[k], 0.5 * g[k].width_m - std::abs(y - g[k].centre_m));
      }
    through_m = std::max(through_m, r.x_m + std::cos(r.yaw_rad) * rear);
  }
  const bool through = through_m >= g[2].to_m;
  std::vector<Figure> out{
      {"speed into the first lane", enters * 3.6, "km/h"},
      figure("speed out of the last", through ? leaves * 3.6 : std::nan(""), "km/h", "the car stops before its end")};
  constexpr std::array<const char*, 3> kLanes{"first", "second", "third"};
  for (std::size_t k = 0; k < 3; ++k)
    out.push_back(figure(said("least distance to the cones, %s lane", kLanes[k]).c_str(),
                         clear[k] < kNever ? clear[k] : std::nan(""),
                         through_m >= g[k].to_m ? "m, of the wheels" : "m, of the wheels; the car stops in it",
                         "the lane was not reached"));
  const bool stand = through && *std::min_element(clear.begin(), clear.end()) > 0.0;
  out.push_back({"cones stand", stand ? 1.0 : 0.0, through ? "(1: all of them)" : "(not driven through, not passed)"});
  out.push_back({"largest roll", most_roll * kPerDeg, "deg"});
  return out;
}

}  // namespace

Result<Manoeuvre> manoeuvre(std::string_view name, double speed_mps, double scale, Options o) {
  const auto at = std::find(kManoeuvreNames.begin(), kManoeuvreNames.end(), name);
  if (at == kManoeuvreNames.end()) return Error{"--manoeuvre " + std::string(name), "is none that is built in"};
  constexpr std::array<double, 5> kOwn_kmh{100.0, 80.0, 60.0, 80.0, 100.0};
  const auto index = static_cast<std::size_t>(at - kManoeuvreNames.begin());
  if (speed_mps < 0.0) return Error{"--manoeuvre " + std::string(name), "is driven forwards"};
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
      m.options.ends_at_rest = true;
      t.add(0.0, 0.0), t.add((kRunUp_m + gates(v)[2].to_m + kRunOut_m) / speed * 3.0, 0.0);
      break;
    case 3: {
      const Result<double> angle = angle_of_three_tenths(m.options, speed);
      if (!angle) return angle.error();
      m.of_three_tenths_rad = *angle;
      t = sine_with_dwell(v, *angle, scale);
      break;
    }
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
  return of_stop(m, rows);
}

}  // namespace phare::batch
