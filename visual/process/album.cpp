#include "visual/process/album.h"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <fstream>

#include "net/stats.h"
#include "visual/image/image.h"
#include "visual/process/stills.h"

namespace phare {
namespace {

constexpr int kThumbnailWidth_px = 320;
constexpr std::size_t kSheetPictures = 16;
constexpr const char* kLastStill = "wall_25m.png";  // written last: where it is, the others are whole

constexpr const char* kEyeState = "eye.json";

/// A picture that cannot be written is told once each; the drive goes on.
void tell(const Status& status) {
  if (!status) spdlog::error("{}", status.error().text());
}

}  // namespace

Result<Album> Album::open(const std::filesystem::path& folder, bool going_on) {
  std::error_code failed;
  std::filesystem::create_directories(folder / "frames", failed);
  if (failed) return Error{folder.string(), failed.message()};
  Album album;
  album.folder_ = folder;
  if (!going_on) return album;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "frames", failed))
    album.frames_found_ += entry.path().extension() == ".png" ? 1 : 0;
  if (std::ifstream stream(folder / kEyeState); stream) {
    nlohmann::json state = nlohmann::json::parse(stream, nullptr, false);
    if (!state.is_discarded()) album.eye_ = std::move(state);
  }
  album.has_stills_ = std::filesystem::exists(folder / kLastStill, failed);
  return album;
}

void Album::keep_frame(std::int64_t frame_index, const Image8& image, const std::string& label) {
  char name[40];
  std::snprintf(name, sizeof name, "frames/%06lld.png", static_cast<long long>(frame_index));
  save(name, image);
  for (const std::uint8_t byte : image.rgba) frames_hash_ = (frames_hash_ ^ byte) * 0x100000001b3ull;
  ++kept_frames_;
  if (thumbnails_.wants_next())
    thumbnails_.offer({thumbnail(image, kThumbnailWidth_px), label});
  else
    thumbnails_.skip();
}

void Album::keep_stills(Renderer& renderer, FrameInput driver, const VehicleState& pose, const Lamps& lamps,
                        int width_px, int height_px, const std::string& label) {
  has_stills_ = true;
  driver.want_image = true;
  driver.overlay.clear();
  driver.instruments.clear();
  driver.panel = {};

  constexpr int kFiner = 2;
  renderer.resize(kFiner * width_px, kFiner * height_px);
  renderer.draw(driver);
  const Image8 fine = renderer.read_image();
  save("drivers_view.png", box_downscale(fine, fine.width_px / width_px));  // a window keeps its size

  FrameInput above = driver;
  above.camera = birds_eye_camera(pose);
  above.want_hdr = true;  // its alpha is the illuminance
  renderer.resize(1200, 480);
  renderer.draw(above);
  save("birds_eye.png", birds_eye_picture(renderer.read_hdr(), "Illuminance on what lies below, lux; " + label));

  renderer.resize(width_px, height_px);
  driver.want_hdr = true;
  renderer.draw(driver);
  tell(write_exr(folder_ / "hdr.exr", renderer.read_hdr()));

  save(kLastStill, wall_picture(lamps, lamps.design_index()));
}

void Album::keep_eye(const nlohmann::json& state) {
  if (wanted() && !write_json(folder_ / kEyeState, state)) spdlog::debug("{} cannot be written", kEyeState);
}

void Album::finish() {
  if (!wanted()) return;
  std::error_code ignored;
  std::filesystem::remove(folder_ / kEyeState, ignored);
  const std::vector<LabelledImage> pictures = thumbnails_.pick(kSheetPictures);
  if (!pictures.empty()) save("contact_sheet.png", contact_sheet(pictures));
}

void Album::save(const char* name, const Image8& image) {
  tell(write_png(folder_ / name, image));
}

}  // namespace phare
