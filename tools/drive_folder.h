// The folder that a drive fills: what an earlier one left there, what must not stay, the video.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace phare {

/// A process that is killed while it writes its counts leaves <name>.json.tmp<process id>.
void remove_half_written(const std::filesystem::path& out, const std::vector<std::string>& process_names);

/// What an earlier drive left in the folder; nothing else in it is touched.
void remove_earlier_output(const std::filesystem::path& out, const std::vector<std::string>& process_names);

/// The topmost folder that has to be made for `out`; empty when it is there.
std::filesystem::path first_missing(std::filesystem::path out);

/// After bad input: no count, no picture, and no folder from `made` down, which was not there before.
void remove_traces(const std::filesystem::path& out, const std::filesystem::path& made,
                   const std::vector<std::string>& process_names);

/// frames/*.png to drive.mp4; says so when there is no ffmpeg.
void make_video(const std::filesystem::path& out, std::int64_t frame_rate_hz);

}  // namespace phare
