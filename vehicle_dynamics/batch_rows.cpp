// Rows of batch output as text.
#include <charconv>
#include <cstddef>
#include <utility>

#include "vehicle_dynamics/batch.h"

namespace phare::batch {
namespace {

// The groups on demand, in the order of RowColumn and of Row.
struct Group {
  const char* name;
  const char* columns[4];  ///< of one number each
  const char* wheels[2];   ///< name and unit of four
  std::size_t numbers;
};
constexpr Group kGroups[] = {
    {"slip", {}, {"slip", ""}, 4},
    {"slip-angle", {}, {"slip_angle", "_rad"}, 4},
    {"travel", {}, {"travel", "_m"}, 4},
    {"camber", {}, {"camber", "_rad"}, 4},
    {"torque", {}, {"", "_nm"}, 8},
    {"friction-used", {}, {"friction_used", "_01"}, 4},
    {"gear", {"gear", "engine_rpm"}, {}, 2},
    {"driver", {"steer_rad", "accelerator_01", "brake_01"}, {}, 3},
    {"energy", {}, {}, 7},
    {"level", {"level"}, {}, 1},
};
constexpr const char* kWheelNames[] = {"fl", "fr", "rl", "rr"};
constexpr std::size_t kBase = offsetof(Row, slip) / sizeof(double), kOfLamps = 3;

void add_wheels(const std::string& name, const std::string& unit, std::string& text) {
  for (const char* wheel : kWheelNames) text += "," + name + "_" + wheel + unit;
}

}  // namespace

std::optional<unsigned> column_named(std::string_view name) {
  unsigned bit = 1;
  for (const Group& group : kGroups) {
    if (name == group.name) return bit;
    bit *= 2;
  }
  return std::nullopt;
}

std::string header(bool lamps, unsigned columns) {
  std::string text =
      "time_s,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,roll_rate_radps,pitch_rate_radps,yaw_rate_radps,vx_mps,vy_mps,"
      "ax_mps2,ay_mps2";
  for (const auto& [name, unit] : {std::pair{"spin", "_radps"}, {"fz", "_n"}, {"fx", "_n"}, {"fy", "_n"}})
    add_wheels(name, unit, text);
  if (lamps) text += ",cutoff_25m_m,cutoff_25m_z_m,lamp_tilt_rad";
  unsigned bit = 1;
  for (const Group& group : kGroups) {
    if (columns & bit) {
      if (bit == kTorque) {
        add_wheels("drive", "_nm", text), add_wheels("brake", "_nm", text);
      } else if (bit == kEnergy) {
        text += ",car_j,engine_j,brakes_j,tyres_j,dampers_j,air_j,road_j";
      } else if (group.wheels[0]) {
        add_wheels(group.wheels[0], group.wheels[1], text);
      } else {
        for (const char* column : group.columns)
          if (column) text += std::string(",") + column;
      }
    }
    bit *= 2;
  }
  return text + "\n";
}

void append(const Row& row, bool lamps, std::string& text, unsigned columns) {
  constexpr std::size_t kAll = sizeof(Row) / sizeof(double), kMostPerNumber = 26;  // -2.2250738585072014e-308,
  const double* values = &row.time_s;
  std::array<char, kAll * kMostPerNumber> line;
  char* at = line.data();
  const auto put = [&](std::size_t from, std::size_t count) {
    for (std::size_t i = from; i < from + count; ++i) {
      at = std::to_chars(at, line.data() + line.size(), values[i]).ptr;
      *at++ = ',';
    }
  };
  put(0, lamps ? kBase : kBase - kOfLamps);
  std::size_t from = kBase;
  unsigned bit = 1;
  for (const Group& group : kGroups) {
    if (columns & bit) put(from, group.numbers);
    from += group.numbers, bit *= 2;
  }
  at[-1] = '\n';
  text.append(line.data(), at);
}

}  // namespace phare::batch
