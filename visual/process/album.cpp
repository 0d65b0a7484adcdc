#include "visual/process/album.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>

#include "net/stats.h"
#include "visual/image/image.h"
#include "visual/process/stills.h"

namespace phare {
namespace {

constexpr std::size_t kSheetPictures = 16;
constexpr const char* kLastStill = "wall_25m.png";  // written last: where it is, the others are whole

constexpr const char* kEyeState = "eye.json";

}  // namespace

Result<Album> Album::open(const std::filesystem::path& folder, bool going_on) {
  std::error_code failed;
  std::filesystem::create_directories(folder / "frames", failed);
  if (failed) return Error{folder.string(), failed.message()};
  Album album;
  album.folder_ = folder;
  if (!going_on) return album;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "frames", failed)) {
    const std::string stem = entry.path().stem().string();
    std::int64_t number = -1;
    const auto read = std::from_chars(stem.data(), stem.data() + stem.size(), number);
    if (entry.path().extension() == ".png" && read.ec == std::errc{} && read.ptr == stem.data() + stem.size())
      album.frames_found_ = std::max(album.frames_found_, number + 1);
  }
  if (std::ifstream stream(folder / kEyeState); stream) {
    nlohmann::json state = nlohmann::json::parse(stream, nullptr, false);
    if (!state.is_discarded()) album.eye_ = std::move(state);
  }
  album.has_stills_ = std::filesystem::exists(folder / kLastStill, failed);
  return album;
}

void Album::keep_frame(std::int64_t frame_index, Image8 image, const std::string& label) {
  char name[40];
  std::snprintf(name, sizeof name, "frames/%06lld.png", static_cast<long long>(frame_index));
  for (const Status& written : frames_.keep(folder_ / name, std::move(image), label)) keep(written);
}

void Album::keep_stills(Renderer& renderer, FrameInput driver, const VehicleState& pose, const Lamps& lamps,
                        int width_px, int height_px, const std::string& label) {
  has_stills_ = true;
  driver.want_image = false;
  driver.overlay.clear();
  driver.instruments.clear();
  driver.panel = {};
  driver.gui = nullptr;

  // The driver's view as it is, finer, and from above, in one frame.
  constexpr int kFiner = 2;
  ViewInput fine = driver;
  fine.own_picture = {kFiner * width_px, kFiner * height_px};
  fine.want_image = true;
  ViewInput above = driver;
  above.camera = birds_eye_camera(pose);
  above.own_picture = kBirdsEyePicture;
  above.want_hdr = true;  // its alpha is the illuminance
  driver.want_hdr = true;
  driver.more_views = {std::move(fine), std::move(above)};
  renderer.draw(driver);
  save("drivers_view.png", box_downscale(renderer.read_image(1), kFiner));
  save("birds_eye.png", birds_eye_picture(renderer.read_hdr(2), "Illuminance on what lies below, lux; " + label));
  keep(write_exr(folder_ / "hdr.exr", renderer.read_hdr()));

  save(kLastStill, wall_picture(lamps, lamps.design_index()));
}

void Album::keep_design(Renderer& renderer, FrameInput driver, const VehicleState& pose, const Lamps& lamps,
                        std::size_t design, const std::string& label) {
  driver.camera = birds_eye_camera(pose);
  driver.own_picture = kBirdsEyePicture;
  driver.want_image = false;
  driver.want_hdr = true;  // its alpha is the illuminance
  FrameInput frame = driver;
  frame.own_picture.reset();
  frame.want_hdr = false;
  frame.more_views = {driver};
  renderer.draw(frame);
  const std::string number = "_" + std::to_string(design) + ".png";
  save("birds_eye" + number, birds_eye_picture(renderer.read_hdr(1), "Illuminance on what lies below, lux; " + label));
  save("wall_25m" + number, wall_picture(lamps, design));
}

void Album::keep_versus(Renderer& renderer, FrameInput driver, const Versus& versus, const VehicleState& pose,
                        const std::string& label) {
  driver.want_image = false;
  driver.want_hdr = true;  // its alpha is the illuminance
  driver.overlay.clear(), driver.instruments.clear(), driver.panel = {}, driver.marks = {}, driver.gui = nullptr;
  const PictureSize size = renderer.picture_size();
  const auto view = [&](const Camera& camera, std::vector<PlacedLamp> lamps, PictureSize picture) {
    ViewInput one = driver;
    one.camera = camera, one.lamps = std::move(lamps), one.own_picture = picture;
    return one;
  };
  const Camera above = birds_eye_camera(pose);
  FrameInput frame = driver;
  frame.more_views = {view(driver.camera, versus.placed(pose), size), view(above, driver.lamps, kBirdsEyePicture),
                      view(above, versus.placed(pose), kBirdsEyePicture)};
  renderer.draw(frame);
  const ImageF here = renderer.read_hdr(), here_b = renderer.read_hdr(1), map = renderer.read_hdr(2),
               map_b = renderer.read_hdr(3);
  save("versus_difference.png", versus_picture(here, here_b, VersusScale::kDifference, "B less A, lux; " + label));
  save("versus_birds_eye.png", versus_picture(map, map_b, VersusScale::kDifference, "B less A, lux; " + label));
  save("versus_ratio.png", versus_picture(map, map_b, VersusScale::kRatio, "B over A; " + label));
  FrameInput halves = driver;
  halves.want_image = true, halves.want_hdr = false;
  versus.split(halves, pose, {}, {});
  renderer.draw(halves);
  save("versus.png", renderer.read_image());
}

void Album::keep_eye(const nlohmann::json& state) {
  if (wanted() && !write_json(folder_ / kEyeState, state)) spdlog::debug("{} cannot be written", kEyeState);
}

void Album::finish() {
  if (!wanted()) return;
  for (const Status& written : frames_.finish()) keep(written);
  std::error_code ignored;
  std::filesystem::remove(folder_ / kEyeState, ignored);
  const std::vector<LabelledImage> pictures = frames_.thumbnails(kSheetPictures);
  if (!pictures.empty()) save("contact_sheet.png", contact_sheet(pictures));
}

bool Album::save(const std::string& name, const Image8& image) {
  return keep(write_png(folder_ / name, image));
}

/// A picture that the disk does not take is counted, and told ten times; the drive goes on.
bool Album::keep(const Status& written) {
  if (written) return true;
  constexpr std::uint64_t kTold = 10;
  if (not_kept_ == 0) first_not_kept_ = written.error().text();
  if (++not_kept_ <= kTold) spdlog::error("{}", written.error().text());
  return false;
}

}  // namespace phare
