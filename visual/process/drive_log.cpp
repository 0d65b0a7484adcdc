#include "visual/process/drive_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "config/base/whole_file.h"

namespace phare {
namespace {

/// A name as a cell of CSV (RFC 4180); a line of the file stays one row.
std::string cell(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string glare_cells(const Glare& glare) {
  const std::string cells =
      fmt::format(",{:.5g},{:.5g},{:.4g},", glare.illuminance_lx, glare.veil_cdm2, glare.threshold_increment_percent);
  return glare.de_boer ? cells + fmt::format("{:.3f}", *glare.de_boer) : cells;
}

}  // namespace

std::string drive_columns(DriveColumns columns) {
  std::string text =
      "frame,time_s,x_m,y_m,z_m,yaw_rad,pitch_rad,roll_rad,speed_mps,lamp_tilt_rad,lit,design,fail_safe,pose_held,"
      "picture,cutoff_25m_m";
  for (const double lx : kReachLevels_lx) text += fmt::format(",reach_{:g}lx_left_m,reach_{:g}lx_right_m", lx, lx);
  text += ",frame_ms,gpu_ms";
  for (const double lx : kReachLevels_lx)
    if (columns.versus) text += fmt::format(",versus_reach_{:g}lx_left_m,versus_reach_{:g}lx_right_m", lx, lx);
  if (columns.traffic)
    text +=
        ",glare_lx,veil_cdm2,threshold_increment_percent,de_boer,others_eye_lx,others_veil_cdm2,"
        "others_threshold_increment_percent,others_de_boer";
  return text + "\n";
}

std::string drive_row(const DriveRow& row, DriveColumns columns) {
  const VehicleState& car = row.car;
  std::string text = fmt::format(
      "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.6f},{:.9f},{},{},{:d},{:d},{:d},", row.frame,
      row.time.seconds(), car.x_m, car.y_m, car.z_m, car.yaw_rad, car.pitch_rad, car.roll_rad, car.speed_mps,
      car.lamp_tilt_rad, cell(row.lit), cell(row.design), row.fail_safe, row.pose_held, row.picture);
  if (row.cutoff_m) text += fmt::format("{:.5f}", *row.cutoff_m);
  const auto put = [&text](const std::vector<Reach>& reach) {
    for (std::size_t i = 0; i < kReachLevels_lx.size(); ++i)
      text += i < reach.size() ? fmt::format(",{:.1f},{:.1f}", reach[i].left_m, reach[i].right_m) : ",,";
  };
  put(row.reach);
  text += fmt::format(",{:.3f},{:.3f}", row.frame_ms, row.gpu_ms);
  if (columns.versus) put(row.versus_reach);
  if (columns.traffic) text += glare_cells(row.glare) + glare_cells(row.others_glare);
  return text + "\n";
}

DriveLog::DriveLog(std::filesystem::path folder, bool going_on, DriveColumns columns)
    : going_on_(going_on), columns_(columns) {
  if (!folder.empty()) file_ = std::move(folder) / "drive.csv";
}

std::int64_t DriveLog::frames_before() const {
  std::int64_t frames = 0;
  std::ifstream before(file_);
  if (!going_on_ || !before) return frames;
  std::string line;
  std::getline(before, line);
  while (std::getline(before, line) && !before.eof())
    frames = std::max<std::int64_t>(frames, std::atoll(line.c_str()) + 1);
  return frames;
}

/// What the process before left, up to the frame that comes now; its last row may be cut off.
void DriveLog::begin(SimTime now) {
  std::string kept = drive_columns(columns_);
  if (std::ifstream before(file_); going_on_ && before) {
    std::string line;
    std::getline(before, line);
    std::size_t until_now = kept.size();  // time goes back where somebody has sought
    while (std::getline(before, line) && !before.eof()) {
      const std::size_t comma = line.find(',');
      if (comma == std::string::npos) break;
      kept += line + "\n";
      if (std::atof(line.c_str() + comma + 1) <= now.seconds() - 1e-6) until_now = kept.size();
    }
    kept.resize(until_now);
  }
  // Where the disk is full the rows of before stay as they are, and the next row tries again.
  begun_ = write_whole_file(file_, kept).ok() && rows_.open(file_, true);
}

bool DriveLog::write(const DriveRow& row) {
  if (!begun_) begin(row.time);
  if (!row.reach.empty()) newest_reach_ = row.time.ns / kReachEvery_ns;
  return (begun_ && rows_.append(drive_row(row, columns_))) || std::exchange(failed_, true);
}

}  // namespace phare
