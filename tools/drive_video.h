// The video of a drive, of the pictures that its folder holds.
#pragma once

#include <filesystem>
#include <functional>

#include "tools/drive_series.h"

namespace phare {

/// frames/*.png to drive.mp4, each shown as long as drive.csv says that it was till the next: at the speed of the
/// drive. Says so when there is no ffmpeg. `every_frame`: the rate is the rig's, else ten a second. `stop`: asked
/// often; none is made then. Whether there is one.
bool make_video(const std::filesystem::path& out, const DriveSeries& series, std::int64_t frame_rate_hz,
                bool every_frame, const std::function<bool()>& stop);

/// What the video holds need not lie there as well: of frames/ the first picture of each second stays.
void thin_frames(const std::filesystem::path& out, const DriveSeries& series);

}  // namespace phare
