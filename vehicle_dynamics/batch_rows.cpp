// Rows of batch output as text.
#include <charconv>
#include <utility>

#include "vehicle_dynamics/batch.h"

namespace phare::batch {

std::string header(bool lamps) {
  std::string text =
      "time_s,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,roll_rate_radps,pitch_rate_radps,yaw_rate_radps,vx_mps,vy_mps,"
      "ax_mps2,ay_mps2";
  for (const auto& [name, unit] : {std::pair{"spin", "radps"}, {"fz", "n"}, {"fx", "n"}, {"fy", "n"}})
    for (const char* wheel : {"fl", "fr", "rl", "rr"}) text += std::string(",") + name + "_" + wheel + "_" + unit;
  return text + (lamps ? ",cutoff_25m_m,cutoff_25m_z_m,lamp_tilt_rad\n" : "\n");
}

void append(const Row& row, bool lamps, std::string& text) {
  constexpr std::size_t kAll = sizeof(Row) / sizeof(double), kOfLamps = 3,
                        kMostPerNumber = 26;  // -2.2250738585072014e-308,
  const std::size_t count = lamps ? kAll : kAll - kOfLamps;
  const double* values = &row.time_s;
  std::array<char, kAll * kMostPerNumber> line;
  char* at = line.data();
  for (std::size_t i = 0; i < count; ++i) {
    at = std::to_chars(at, line.data() + line.size(), values[i]).ptr;
    *at++ = i + 1 < count ? ',' : '\n';
  }
  text.append(line.data(), at);
}

}  // namespace phare::batch
