// Reader of batch input files.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "vehicle_dynamics/batch.h"

namespace phare::batch {
namespace {

constexpr std::array<const char*, 4> kWheels{"fl", "fr", "rl", "rr"};

struct Column {
  std::string name;
  std::vector<double>* target;
  double min, max;
  bool required;
};

std::string brief(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace

std::string Inputs::place(std::size_t row) const {
  return row < line.size() ? file + ":" + std::to_string(line[row]) : "inputs, row " + std::to_string(row + 1);
}

Result<Inputs> read_inputs(const std::filesystem::path& csv_file) {
  Result<CsvTable> table = CsvTable::read(csv_file);
  if (!table) return table.error();
  const auto has = [&](const std::string& name) { return table->find({name.c_str()}).has_value(); };
  const std::string header_place = csv_file.string() + ":" + std::to_string(table->header_line());

  Inputs in;
  in.file = csv_file.string();
  for (std::size_t row = 0; row < table->rows(); ++row) in.line.push_back(table->line(row));
  const bool torques = has("torque_fl_nm"), pedals = has("accelerator_01") || has("brake_01");
  if (torques && pedals) return Error{header_place, "gives both pedals and wheel torques; one of them drives the car"};
  if (!torques && !pedals)
    return Error{header_place, "has neither accelerator_01, brake_01 nor torque_fl_nm to torque_rr_nm"};
  const bool brakes = has("brake_fl_nm");
  if (brakes && !torques)
    return Error{header_place, "brake_fl_nm goes with torque_fl_nm to torque_rr_nm; pedals have brake_01"};
  const bool road =
      std::any_of(kWheels.begin(), kWheels.end(), [&](const char* w) { return has("road_" + std::string(w) + "_m"); });

  std::vector<Column> columns{{"time_s", &in.time_s, -1e9, 1e9, true}, {"steer_rad", &in.steer_rad, -1.2, 1.2, true}};
  if (pedals) {
    columns.push_back({"accelerator_01", &in.accelerator_01, 0.0, 1.0, true});
    columns.push_back({"brake_01", &in.brake_01, 0.0, 1.0, true});
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (torques) columns.push_back({"torque_" + std::string(kWheels[i]) + "_nm", &in.torque_nm[i], -1e5, 1e5, true});
    if (brakes) columns.push_back({"brake_" + std::string(kWheels[i]) + "_nm", &in.brake_nm[i], 0.0, 1e5, true});
    if (road) columns.push_back({"road_" + std::string(kWheels[i]) + "_m", &in.road_m[i], -1e4, 1e4, true});
  }
  columns.push_back({"gear", &in.gear, 0.0, 3.0, false});
  columns.push_back({"parking_brake_01", &in.parking_01, 0.0, 1.0, false});
  columns.push_back({"levelling_step", &in.levelling_step, 0.0, 10.0, false});

  for (const std::string& name : table->columns())
    if (std::none_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; }))
      return Error{header_place, "column \"" + name.substr(0, 40) + "\" is none that a batch run knows"};
  if (table->rows() < 2) return Error{csv_file.string(), "needs two rows at least: a beginning and an end"};
  for (const Column& column : columns) {
    const auto at = table->find({column.name.c_str()});
    if (!at && column.required) return Error{header_place, "has no column " + column.name};
    if (!at) continue;
    for (std::size_t row = 0; row < table->rows(); ++row) {
      const double value = table->at(row, *at);
      if (value < column.min || value > column.max)
        return Error{table->place(row), column.name + " " + brief(value) + " is outside " + brief(column.min) + " to " +
                                            brief(column.max)};
      column.target->push_back(value);
    }
  }
  for (std::size_t row = 1; row < in.time_s.size(); ++row)
    if (!(in.time_s[row] > in.time_s[row - 1])) return Error{table->place(row), "time_s does not rise"};
  for (std::size_t row = 0; row < in.time_s.size(); ++row)
    if (in.time_s[row] - in.time_s.front() > kMostSimulated_s)
      return Error{table->place(row), "time_s " + brief(in.time_s[row]) + " is more than 100 hours after the first"};
  for (std::size_t row = 0; row < in.gear.size(); ++row)
    if (in.gear[row] != std::floor(in.gear[row])) return Error{table->place(row), "gear is not 0, 1, 2 or 3"};
  return in;
}

}  // namespace phare::batch
