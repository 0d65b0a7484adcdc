#include "visual/process/frame_pictures.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "visual/image/image.h"

namespace phare {
namespace {

constexpr int kThumbnailWidth_px = 320;

}  // namespace

void FramePictures::Made::see(const Image8& image, const std::string& label) {
  std::uint64_t all = hash;
  for (std::size_t i = 0; i < image.rgba.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t pixels = 0;
    std::memcpy(&pixels, image.rgba.data() + i, std::min(sizeof pixels, image.rgba.size() - i));
    all = (all ^ pixels) * 0x100000001b3ull;
    all ^= all >> 32u;  // a product carries upward alone
  }
  hash = all;
  if (thumbnails.wants_next())
    thumbnails.offer({thumbnail(image, kThumbnailWidth_px), label});
  else
    thumbnails.skip();
}

std::vector<Status> FramePictures::keep(std::filesystem::path file, Image8 image, std::string label) {
  if (!writer_) {
    Status written = write_png(file, image);
    if (written) {
      made_->see(image, label);
      ++kept_;
    }
    return {std::move(written)};
  }
  ++kept_;
  return writer_->take([made = made_, file = std::move(file), image = std::move(image), label = std::move(label)] {
    made->see(image, label);
    return write_png(file, image);
  });
}

}  // namespace phare
