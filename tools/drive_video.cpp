#include "tools/drive_video.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <system_error>
#include <thread>

#include "config/base/remedies.h"
#include "tools/child_process.h"

namespace phare {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string picture_file(std::int64_t frame) {
  return fmt::format("frames/{:06}.png", frame);
}

}  // namespace

bool make_video(const fs::path& out, const DriveSeries& series, std::int64_t frame_rate_hz, bool every_frame,
                const std::function<bool()>& stop) {
  if (stop()) return false;
  std::error_code ignored;
  std::vector<DriveSeries::Picture> pictures;
  for (const DriveSeries::Picture& picture : series.pictures)
    if (fs::exists(out / picture_file(picture.frame), ignored)) pictures.push_back(picture);
  if (pictures.size() < 2) return false;
  const auto ffmpeg = find_in_path("ffmpeg");
  if (!ffmpeg) {
    spdlog::info("no ffmpeg in PATH, so no drive.mp4 ({})", kVideoRemedy);
    return false;
  }
  const double rate_hz = every_frame ? static_cast<double>(frame_rate_hz) : 10.0;
  const fs::path list = out / "drive.mp4.txt", half = out / "drive.mp4.part";
  {
    std::ofstream stream(list);
    stream << "ffconcat version 1.0\n";
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const double lasts_s = i + 1 < pictures.size() ? pictures[i + 1].time_s - pictures[i].time_s : 1.0 / rate_hz;
      stream << "file " << picture_file(pictures[i].frame) << "\n" << fmt::format("duration {:.6f}\n", lasts_s);
    }
    stream.close();
    if (!stream) {
      spdlog::error("{}: cannot be written, so no drive.mp4", list.string());
      fs::remove(list, ignored);
      return false;
    }
  }
  // Sides of an even number of pixels, as players want them. In the folder, by names of ours: ffmpeg takes #, ? and %
  // in another's for something else.
  auto child = ChildProcess::start("/usr/bin/env", {"-C",
                                                    out.string(),
                                                    *ffmpeg,
                                                    "-y",
                                                    "-nostdin",
                                                    "-loglevel",
                                                    "error",
                                                    "-f",
                                                    "concat",
                                                    "-i",
                                                    "drive.mp4.txt",
                                                    "-vf",
                                                    "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                                    "-r",
                                                    fmt::format("{:g}", rate_hz),
                                                    "-pix_fmt",
                                                    "yuv420p",
                                                    "-crf",
                                                    "20",
                                                    "-movflags",
                                                    "+faststart",
                                                    "-f",
                                                    "mp4",
                                                    "drive.mp4.part"});
  if (!child) {
    spdlog::warn("{}, so no drive.mp4", child.error().text());
    fs::remove(list, ignored);
    return false;
  }
  const auto deadline = Clock::now() + std::chrono::minutes(10);
  std::optional<ProcessEnd> end;
  while (!(end = child->ended()) && Clock::now() < deadline && !stop())
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (!end) child->send_signal(9);
  fs::remove(list, ignored);
  if (end && end->exit_code == 0 && end->signal == 0) {
    fs::rename(half, out / "drive.mp4", ignored);
    if (!ignored) return true;
  }
  spdlog::warn("ffmpeg made no video ({})", end ? end->text() : stop() ? "interrupted" : "took more than 10 minutes");
  fs::remove(half, ignored);
  return false;
}

void thin_frames(const fs::path& out, const DriveSeries& series) {
  std::error_code ignored;
  double second = -1.0;
  for (const DriveSeries::Picture& picture : series.pictures) {
    const double here = std::floor(picture.time_s + 1e-6);
    if (here != second) {
      second = here;
      continue;
    }
    fs::remove(out / picture_file(picture.frame), ignored);
  }
}

}  // namespace phare
