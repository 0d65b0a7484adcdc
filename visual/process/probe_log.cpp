#include "visual/process/probe_log.h"

#include <fmt/format.h>

#include <utility>

namespace phare {

std::string probe_columns(std::size_t probes) {
  std::string text = "time_s,x_m,y_m,z_m,yaw_rad,pitch_rad,speed_mps";
  for (std::size_t i = 1; i <= probes; ++i) text += fmt::format(",probe{}_lx", i);
  for (const double lx : kReachLevels_lx) text += fmt::format(",reach_{:g}lx_left_m,reach_{:g}lx_right_m", lx, lx);
  return text + "\n";
}

std::string probe_row(const ProbeRow& row) {
  std::string text = fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.6f}", row.time.seconds(), row.car.x_m,
                                 row.car.y_m, row.car.z_m, row.car.yaw_rad, row.car.pitch_rad, row.car.speed_mps);
  for (const std::optional<double>& lx : row.probes_lx) text += lx ? fmt::format(",{:.9g}", *lx) : ",";
  for (const Reach& reach : row.reach) text += fmt::format(",{:.1f},{:.1f}", reach.left_m, reach.right_m);
  return text + "\n";
}

ProbeLog::ProbeLog(std::filesystem::path folder, bool going_on) : going_on_(going_on) {
  if (!folder.empty()) file_ = std::move(folder) / "probes.csv";
}

bool ProbeLog::write(const ProbeRow& row) {
  newest_ = row.time.ns / kEvery_ns;
  if (!rows_.is_open()) {
    std::error_code ignored;
    const bool there = going_on_ && std::filesystem::exists(file_, ignored);
    (void)rows_.open(file_, there);
    if (there) probes_ = row.probes_lx.size();
  }
  const bool named = probes_ == row.probes_lx.size();
  const bool written = rows_.append((named ? "" : probe_columns(row.probes_lx.size())) + probe_row(row));
  if (written) probes_ = row.probes_lx.size();
  return written || std::exchange(failed_, true);
}

}  // namespace phare
