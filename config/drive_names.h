// Names that the folder of a drive uses itself (tools/drive_folder.h), beside which a channel has a folder of its own
// name. Checked by tests/tools/rig_test.cpp.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace phare {

/// Files of a drive that are called so whatever it drives.
inline constexpr std::array<std::string_view, 17> kDriveFiles{"report.json",
                                                              "index.html",
                                                              "drive.csv",
                                                              "probes.csv",
                                                              "drive.mp4",
                                                              "drive.mp4.part",
                                                              "drive.mp4.txt",
                                                              "contact_sheet.png",
                                                              "drivers_view.png",
                                                              "birds_eye.png",
                                                              "wall_25m.png",
                                                              "versus.png",
                                                              "versus_difference.png",
                                                              "versus_birds_eye.png",
                                                              "versus_ratio.png",
                                                              "hdr.exr",
                                                              "eye.json"};
/// Folder of its pictures.
inline constexpr std::string_view kDriveFrames = "frames";

/// Of a design, by its number: "birds_eye_1.png", "wall_25m_1.png".
bool is_picture_of_design(std::string_view name);

/// Why a channel may not be called so; empty: it may. `first`: it has the drive's folder itself.
std::string why_no_channel_name(std::string_view name, bool first);

}  // namespace phare
