// The folder of pictures that a drive leaves behind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "config/base/result.h"
#include "visual/process/cameras.h"
#include "visual/process/frame_pictures.h"
#include "visual/process/lamps.h"
#include "visual/process/versus.h"

namespace phare {

class Album {
 public:
  /// An album without a folder keeps nothing.
  Album() = default;
  /// Makes the folder and frames/ in it. `going_on`: the pictures there are of this drive, left by a process that was
  /// killed; stills that are whole are not made again.
  static Result<Album> open(const std::filesystem::path& folder, bool going_on = false);

  bool wanted() const { return !folder_.empty(); }
  void write_beside() { frames_.write_beside(); }  ///< pictures of frames
  bool busy() const { return frames_.busy(); }
  /// frames/NNNNNN.png, and a thumbnail for the contact sheet.
  void keep_frame(std::int64_t frame_index, Image8 image, const std::string& label);
  /// drivers_view.png (drawn at twice the size and averaged), hdr.exr, birds_eye.png, wall_25m.png. `driver` is the
  /// driver's frame; the map below the bird's eye is made of it with another camera. drivers_view.png is `width_px` x
  /// `height_px`; hdr.exr has the size of the renderer's picture.
  void keep_stills(Renderer& renderer, FrameInput driver, const VehicleState& pose, const Lamps& lamps, int width_px,
                   int height_px, const std::string& label);
  /// Bird's eye and wall of another design than that of the stills: birds_eye_N.png and wall_25m_N.png, by its number
  /// from 0. Its beams are in the renderer, and its lamps in `driver`.
  void keep_design(Renderer& renderer, FrameInput driver, const VehicleState& pose, const Lamps& lamps,
                   std::size_t design, const std::string& label);
  /// Both designs of a comparison in the moment of the stills: versus.png, the driver's view in halves;
  /// versus_difference.png and versus_birds_eye.png, B's lux less A's; versus_ratio.png, B's over A's from above.
  void keep_versus(Renderer& renderer, FrameInput driver, const Versus& versus, const VehicleState& pose,
                   const std::string& label);
  bool has_stills() const { return has_stills_; }
  /// eye.json: what the eye is adapted to now, for a process that takes the place of this one.
  void keep_eye(const nlohmann::json& state);
  /// What the process before left of it, when going on.
  const std::optional<nlohmann::json>& eye() const { return eye_; }
  /// contact_sheet.png; takes eye.json away
  void finish();

  const FramePictures& frames() const { return frames_; }
  /// Pictures that the disk did not take, and the first of them with its reason.
  std::uint64_t not_kept() const { return not_kept_; }
  /// Something else that was to be kept and is not: counted as a picture is, and told.
  void missed(const std::string& file) { keep(Error{file, "cannot be written"}); }
  const std::string& first_not_kept() const { return first_not_kept_; }
  /// One more than the highest number in frames/ when going on; 0 otherwise.
  std::int64_t frames_found() const { return frames_found_; }

 private:
  bool save(const std::string& name, const Image8& image);
  bool keep(const Status& written);

  std::filesystem::path folder_;
  FramePictures frames_;
  std::optional<nlohmann::json> eye_;
  bool has_stills_ = false;
  std::int64_t frames_found_ = 0;
  std::uint64_t not_kept_ = 0;
  std::string first_not_kept_;
};

}  // namespace phare
