#include "visual/image/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <stb_image.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

#include "visual/image/png.h"
#include "visual/image/srgb.h"

namespace phare {
namespace {

constexpr const char* kIlluminanceChannel = "illuminance_lx";

/// Runs `write` on a name beside `file` and renames, so that a reader never sees half a picture.
template <typename Write>
Status write_beside(const std::filesystem::path& file, Write write) {
  std::filesystem::path beside = file;
  beside += ".part" + std::to_string(::getpid());
  std::string reason = write(beside.string());
  std::error_code failed;
  if (reason.empty()) std::filesystem::rename(beside, file, failed);
  if (failed) reason = failed.message();
  if (reason.empty()) return Done{};
  std::filesystem::remove(beside, failed);
  return Error{file.string(), reason};
}

/// The step of 8 bits that is nearest in the signal.
std::uint8_t srgb_of_linear(float linear) {
  // Light of the signals half-way between two steps: a search among them is a tenth of a power.
  static const std::array<float, 255> between = [] {
    std::array<float, 255> light{};
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double c = (static_cast<double>(i) + 0.5) / 255.0;
      light[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return light;
  }();
  return static_cast<std::uint8_t>(std::ranges::upper_bound(between, linear) - between.begin());
}

std::size_t texels(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

}  // namespace

Image8 blank_image(int width_px, int height_px, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  Image8 image{width_px, height_px, std::vector<std::uint8_t>(texels(width_px, height_px) * 4)};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    image.rgba[i] = red;
    image.rgba[i + 1] = green;
    image.rgba[i + 2] = blue;
    image.rgba[i + 3] = 255;
  }
  return image;
}

Status write_png(const std::filesystem::path& file, const Image8& image) {
  return write_beside(file, [&](const std::string& name) -> std::string {
    const auto png = encode_png(image);
    if (!png) return "the picture cannot be encoded";
    std::ofstream stream(name, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(png->data()), static_cast<std::streamsize>(png->size()));
    stream.close();
    return stream ? "" : "the picture cannot be written here";
  });
}

Result<Image8> read_png(const std::filesystem::path& file) {
  int width_px = 0, height_px = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load(file.string().c_str(), &width_px, &height_px, &channels, 4), stbi_image_free);
  if (!pixels) return Error{file.string(), std::string("not a readable picture: ") + stbi_failure_reason()};
  Image8 image{width_px, height_px, {}};
  image.rgba.assign(pixels.get(), pixels.get() + texels(width_px, height_px) * 4);
  return image;
}

namespace {

Error too_large(const std::filesystem::path& file, int width_px, int height_px, int most_across) {
  return {file.string(), std::to_string(width_px) + " × " + std::to_string(height_px) + " pixels, more than " +
                             std::to_string(most_across) + " across"};
}

/// After "P5": width, height and largest value, with comments, then the rows. Pixels that are missing are an error.
Result<Grey8> read_pgm(const std::filesystem::path& file, std::istream& in, int most_across) {
  int numbers[3] = {};
  for (int& number : numbers) {
    while (std::isspace(in.peek()) != 0 || in.peek() == '#')
      if (in.get() == '#') in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!(in >> number) || number < 1) return Error{file.string(), "not a readable picture: no PGM header"};
  }
  const auto [width_px, height_px, most] = numbers;
  if (width_px > most_across || height_px > most_across) return too_large(file, width_px, height_px, most_across);
  if (most != 255) return Error{file.string(), "not a readable picture: a PGM of 8 bits has 255 for its largest value"};
  in.get();
  Grey8 picture{width_px, height_px, std::vector<std::uint8_t>(texels(width_px, height_px))};
  in.read(reinterpret_cast<char*>(picture.grey.data()), static_cast<std::streamsize>(picture.grey.size()));
  if (static_cast<std::size_t>(in.gcount()) != picture.grey.size())
    return Error{file.string(), "not a readable picture: " + std::to_string(in.gcount()) + " of its " +
                                    std::to_string(picture.grey.size()) + " pixels are there"};
  return picture;
}

}  // namespace

Result<Grey8> read_grey(const std::filesystem::path& file, int most_across) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) return Error{file.string(), "is no file"};
  std::ifstream in(file, std::ios::binary);
  if (in.get() == 'P' && in.get() == '5') return read_pgm(file, in, most_across);
  int width_px = 0, height_px = 0, channels = 0;
  if (stbi_info(file.string().c_str(), &width_px, &height_px, &channels) != 0 &&
      (width_px > most_across || height_px > most_across))
    return too_large(file, width_px, height_px, most_across);
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load(file.string().c_str(), &width_px, &height_px, &channels, 1), stbi_image_free);
  if (!pixels) return Error{file.string(), std::string("not a readable picture: ") + stbi_failure_reason()};
  return Grey8{width_px, height_px, {pixels.get(), pixels.get() + texels(width_px, height_px)}};
}

Status write_exr(const std::filesystem::path& file, const ImageF& image) {
  return write_beside(file, [&](const std::string& name) -> std::string {
    try {
      Imf::Header header(image.width_px, image.height_px);
      header.compression() = Imf::ZIP_COMPRESSION;
      Imf::addWhiteLuminance(header, 1.0f);  // OpenEXR: cd/m² of RGB (1, 1, 1)
      Imf::FrameBuffer buffer;
      const std::array<const char*, 4> names{"R", "G", "B", kIlluminanceChannel};
      const std::size_t row_bytes = static_cast<std::size_t>(image.width_px) * 4 * sizeof(float);
      for (std::size_t c = 0; c < names.size(); ++c) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        // OpenEXR takes a pointer to non-const also for writing; it only reads.
        char* first = reinterpret_cast<char*>(const_cast<float*>(image.rgba.data() + c));
        buffer.insert(names[c], Imf::Slice(Imf::FLOAT, first, 4 * sizeof(float), row_bytes));
      }
      Imf::OutputFile out(name.c_str(), header);
      out.setFrameBuffer(buffer);
      out.writePixels(image.height_px);
      return "";
    } catch (const std::exception& failure) {
      return failure.what();
    }
  });
}

Result<ImageF> read_exr(const std::filesystem::path& file) {
  try {
    Imf::InputFile in(file.string().c_str());
    const Imath::Box2i window = in.header().dataWindow();
    ImageF image{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {}};
    image.rgba.assign(texels(image.width_px, image.height_px) * 4, 0.0f);
    Imf::FrameBuffer buffer;
    const std::array<const char*, 4> names{"R", "G", "B", kIlluminanceChannel};
    const std::size_t row_bytes = static_cast<std::size_t>(image.width_px) * 4 * sizeof(float);
    for (std::size_t c = 0; c < names.size(); ++c) {
      buffer.insert(names[c],
                    Imf::Slice::Make(Imf::FLOAT, image.rgba.data() + c, window, 4 * sizeof(float), row_bytes));
    }
    in.setFrameBuffer(buffer);
    in.readPixels(window.min.y, window.max.y);
    return image;
  } catch (const std::exception& failure) {
    return Error{file.string(), failure.what()};
  }
}

Image8 box_downscale(const Image8& image, int factor) {
  if (factor <= 1) return image;
  Image8 small = blank_image(image.width_px / factor, image.height_px / factor, 0, 0, 0);
  const auto& linear = linear_of_srgb();
  const float weight = 1.0f / static_cast<float>(factor * factor);
  for (int y = 0; y < small.height_px; ++y) {
    for (int x = 0; x < small.width_px; ++x) {
      std::array<float, 3> sum{};
      for (int v = 0; v < factor; ++v) {
        for (int u = 0; u < factor; ++u) {
          const std::size_t at =
              (texels(image.width_px, y * factor + v) + static_cast<std::size_t>(x * factor + u)) * 4;
          for (std::size_t c = 0; c < 3; ++c) sum[c] += linear[image.rgba[at + c]];
        }
      }
      const std::size_t to = (texels(small.width_px, y) + static_cast<std::size_t>(x)) * 4;
      for (std::size_t c = 0; c < 3; ++c) small.rgba[to + c] = srgb_of_linear(sum[c] * weight);
    }
  }
  return small;
}

Image8 thumbnail(const Image8& image, int width_px) {
  return box_downscale(image, image.width_px / width_px);
}

}  // namespace phare
