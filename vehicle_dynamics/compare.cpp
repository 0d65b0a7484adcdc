#include "vehicle_dynamics/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "vehicle_dynamics/batch.h"

namespace phare::compare {
namespace {

using Column = std::vector<double>;
constexpr std::array<const char*, 4> kWheels{"FL", "FR", "RL", "RR"};

struct Record {
  std::string file;
  CsvTable table;
  Column column(const std::string& name) const {
    Column out;
    if (const auto at = table.find({name.c_str()}))
      for (std::size_t row = 0; row < table.rows(); ++row) out.push_back(table.at(row, *at));
    return out;
  }
};

Result<Record> read(const std::filesystem::path& file) {
  Result<CsvTable> table = CsvTable::read(file);
  if (!table) return table.error();
  Record record{file.string(), std::move(*table)};
  for (const char* name : {"t", "delta", "X", "Y", "vx", "yaw_rate", "roll", "pitch", "z", "T_FL"})
    if (record.column(name).empty()) return Error{file.string() + ":1", std::string("has no column ") + name};
  return record;
}

double peak(const Column& c) {
  double most = 0.0;
  for (const double v : c) most = std::max(most, std::abs(v));
  return most;
}
double rms(const Column& c) {
  double sum = 0.0;
  for (const double v : c) sum += v * v;
  return c.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(c.size()));
}
double largest_percent(const Column& reference, const Column& ours) {
  return 100.0 * largest_difference(reference, ours) / peak(reference);
}

struct Traces {
  Column x, y, z, yaw_rate, roll, pitch;
};

Result<Traces> run(const Record& record, const Record& heights, const VehicleParams& vehicle, Level level,
                   Integrator integrator, double step_s) {
  batch::Inputs in;
  in.time_s = record.column("t"), in.steer_rad = record.column("delta");
  const bool rough = peak(heights.column("h_FL")) > 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    in.torque_nm[i] = record.column(std::string("T_") + kWheels[i]);
    if (rough) in.road_m[i] = heights.column(std::string("h_") + kWheels[i]);
    if (rough && in.road_m[i].size() != in.time_s.size())
      return Error{heights.file, "has other times than " + record.file};
  }
  batch::Options o;
  o.vehicle = vehicle, o.vehicle_place = "vehicle";
  o.level = level, o.integrator = integrator, o.step_s = step_s;
  o.speed_mps = record.column("vx").front(), o.start_x_m = record.column("X").front();
  o.output_hz = std::round(1.0 / (in.time_s[1] - in.time_s[0]));
  Traces out;
  const auto done = batch::run(o, in, [&](const batch::Row& row) {
    out.x.push_back(row.x_m), out.y.push_back(row.y_m), out.z.push_back(row.z_m);
    out.yaw_rate.push_back(row.yaw_rate_radps), out.roll.push_back(row.roll_rad), out.pitch.push_back(row.pitch_rad);
  });
  if (!done) return done.error();
  if (out.x.size() != in.time_s.size())
    return Error{record.file, "our run has " + std::to_string(out.x.size()) + " rows, the record " +
                                  std::to_string(in.time_s.size()) + ": its times are not even"};
  return out;
}

Traces of(const Record& r) {
  return {r.column("X"), r.column("Y"), r.column("z"), r.column("yaw_rate"), r.column("roll"), r.column("pitch")};
}

// Bands of the notes, section 7; of dive and squat against Chrono 3 % instead of 4, as against MB.
struct Bands {
  double yaw, pitch, bump, roll, path, rough, rough_roll;
};
constexpr Bands kFullMb{1.0, 3.0, 3.0, 5.0, 0.05, 1.0, 5.0}, kFullChrono{4.0, 3.0, 8.0, 22.0, 0.4, 1.0, 5.0},
    kSingleMb{3.0, 6.0, 15.0, 8.0, 0.2, 15.0, 15.0}, kSingleChrono{0.0, 0.0, 0.0, 0.0, 0.0, 15.0, 15.0};

}  // namespace

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (const double now = std::abs(a[i] - b[i]); !(now <= most)) {
      if (std::isnan(now)) return now;
      most = now;
    }
  return most;
}

double largest_distance(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& our_x,
                        const std::vector<double>& our_y) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < std::min(x.size(), our_x.size()); ++i)
    apart.push_back(std::hypot(x[i] - our_x[i], y[i] - our_y[i]));
  return largest_difference(apart, std::vector<double>(apart.size(), 0.0));
}

bool Line::passes() const {
  return std::isfinite(error) && (band == 0.0 || error <= allowed());
}

std::string text(const Line& l) {
  const bool far = !(std::abs(l.error) < 1e6);  // digits behind the point tell nothing then
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, far ? "%-22s %-7s %-13s %-9s %9.3g %-2s" : "%-22s %-7s %-13s %-9s %9.4f %-2s",
                l.manoeuvre.c_str(), l.reference.c_str(), l.level.c_str(), l.quantity.c_str(), l.error, l.unit);
  std::string out = buffer;
  if (l.band > 0.0) {
    std::snprintf(buffer, sizeof buffer, "  band %6.2f, programs differ by %8.4f  %s", l.band, l.programs,
                  !l.passes()         ? "OUTSIDE"
                  : l.error <= l.band ? "within"
                                      : "within the programs' difference");
    out += buffer;
  } else if (!l.passes()) {
    out += "  NOT A NUMBER";
  }
  return out;
}

Result<std::vector<Line>> manoeuvres(const std::filesystem::path& directory, const std::filesystem::path& vehicle_file,
                                     std::optional<Integrator> integrator, double step_s) {
  const Result<VehicleParams> vehicle = read_vehicle(vehicle_file);
  if (!vehicle) return vehicle.error();
  std::vector<Line> lines;
  for (const char* name : {"D01_slow_ramp_50", "D02_step_right_60", "D03_brake_60_partial", "D04_single_bump_20",
                           "D05_sine_sweep_80", "D06_iso8608_B_60"}) {
    const Result<Record> mb = read(directory / (std::string(name) + "__crmb.csv"));
    if (!mb) return mb.error();
    const Result<Record> chrono = read(directory / (std::string(name) + "__chrono.csv"));
    if (!chrono) return chrono.error();
    const Traces of_mb = of(*mb), of_chrono = of(*chrono);
    const bool turns = peak(of_mb.yaw_rate) > 0.05, pitches = peak(of_mb.pitch) > 0.01, rough = name[2] == '6',
               bump = name[2] == '4';
    for (const Level level : {Level::kFull, Level::kSingleTrack})
      for (const bool is_mb : {true, false}) {
        const Bands& band =
            level == Level::kFull ? (is_mb ? kFullMb : kFullChrono) : (is_mb ? kSingleMb : kSingleChrono);
        const Result<Traces> ours =
            run(is_mb ? *mb : *chrono, *mb, *vehicle, level, integrator.value_or(batch::integrator_of(level)), step_s);
        if (!ours) return ours.error();
        const Traces &ref = is_mb ? of_mb : of_chrono, &other = is_mb ? of_chrono : of_mb;
        const auto add = [&](const char* quantity, double error, double limit, double programs, const char* unit) {
          lines.push_back({name, is_mb ? "MB" : "Chrono", phare::name(level), quantity, error, limit, programs, unit});
        };
        if (rough) {
          const auto of_rms = [&](const char* quantity, const Column& a, const Column& b, const Column& c,
                                  double limit) {
            add(quantity, 100.0 * std::abs(rms(b) / rms(a) - 1.0), limit, 100.0 * std::abs(rms(c) / rms(a) - 1.0), "%");
          };
          of_rms("pitch rms", ref.pitch, ours->pitch, other.pitch, band.rough);
          of_rms("z rms", ref.z, ours->z, other.z, band.rough);
          // MB's body slides sideways on its axles against a spring, and yaws eight times as much there as Chrono's:
          // its roll lies 20 % above ours at 1.5 to 2 Hz and 80 % below at 6 to 10 Hz, where Chrono's lies 8 and 14 %
          // below. Against it the rms of roll is told, not judged.
          of_rms("roll rms", ref.roll, ours->roll, other.roll, is_mb ? 0.0 : band.rough_roll);
          continue;
        }
        if (turns) {
          add("yaw rate", largest_percent(ref.yaw_rate, ours->yaw_rate), band.yaw,
              largest_percent(ref.yaw_rate, other.yaw_rate), "%");
          add("roll", largest_percent(ref.roll, ours->roll), band.roll, largest_percent(ref.roll, other.roll), "%");
        }
        if (pitches)
          add("pitch", largest_percent(ref.pitch, ours->pitch), bump ? band.bump : band.pitch,
              largest_percent(ref.pitch, other.pitch), "%");
        add("path", largest_distance(ref.x, ref.y, ours->x, ours->y), band.path,
            largest_distance(ref.x, ref.y, other.x, other.y), "m");
      }
  }
  return lines;
}

Result<Measured> measured_drive(const std::filesystem::path& directory, const std::filesystem::path& vehicle_file) {
  Result<VehicleParams> vehicle = read_vehicle(vehicle_file);
  if (!vehicle) return vehicle.error();
  const std::string base = (directory / "measured_bmw_m8_launch_coast_abs_stop__").string();
  const Result<CsvTable> inputs = CsvTable::read(base + "inputs.csv"), imu = CsvTable::read(base + "imu.csv");
  if (!inputs) return inputs.error();
  if (!imu) return imu.error();
  const auto t = inputs->find({"t"}), throttle = inputs->find({"throttle"}), brake = inputs->find({"brake"}),
             vx = inputs->find({"vx"});
  const auto ti = imu->find({"t"}), pitch = imu->find({"pitch"});
  if (!t || !throttle || !brake || !vx || !ti || !pitch) return Error{base + "inputs.csv", "lacks a column"};
  batch::Inputs in;
  Column speed;
  for (std::size_t row = 0; row < inputs->rows(); ++row) {
    if (!in.time_s.empty() && inputs->at(row, *t) <= in.time_s.back()) continue;  // stamps repeat here and there
    in.time_s.push_back(inputs->at(row, *t));
    in.steer_rad.push_back(0.0);
    in.accelerator_01.push_back(std::clamp(inputs->at(row, *throttle), 0.0, 1.0));
    in.brake_01.push_back(std::clamp(inputs->at(row, *brake), 0.0, 1.0));
    speed.push_back(inputs->at(row, *vx));
  }
  batch::Options o;
  o.vehicle = std::move(*vehicle), o.vehicle_place = vehicle_file.string();
  std::vector<batch::Row> rows;
  if (const auto done = batch::run(o, in, [&](const batch::Row& row) { rows.push_back(row); }); !done)
    return done.error();

  Measured out;
  double count = 0.0;
  std::size_t k = 0;
  for (const batch::Row& row : rows) {
    while (k + 1 < in.time_s.size() && in.time_s[k + 1] < row.time_s) ++k;
    out.speed_rms_mps += (row.vx_mps - speed[k]) * (row.vx_mps - speed[k]);
    out.speed_peak_mps = std::max(out.speed_peak_mps, speed[k]);
    count += 1.0;
  }
  out.speed_rms_mps = std::sqrt(out.speed_rms_mps / count);
  // The site slopes: the pitch before the launch is taken off.
  double at_rest = 0.0, resting = 0.0;
  for (std::size_t row = 0; row < imu->rows(); ++row)
    if (imu->at(row, *ti) < 0.5) at_rest += imu->at(row, *pitch), resting += 1.0;
  at_rest /= std::max(resting, 1.0);
  double sum = 0.0, pairs = 0.0;
  k = 0;
  for (std::size_t row = 0; row < imu->rows(); ++row) {
    const double time = imu->at(row, *ti), value = imu->at(row, *pitch) - at_rest;
    if (time < rows.front().time_s || time > rows.back().time_s) continue;
    while (k + 1 < rows.size() && rows[k + 1].time_s < time) ++k;
    sum += (rows[k].pitch_rad - value) * (rows[k].pitch_rad - value), pairs += 1.0;
    out.pitch_peak_rad = std::max(out.pitch_peak_rad, std::abs(value));
  }
  out.pitch_rms_rad = std::sqrt(sum / std::max(pairs, 1.0));
  return out;
}

}  // namespace phare::compare
