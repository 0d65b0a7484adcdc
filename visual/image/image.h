// Picture files: PNG for eyes (8 bit sRGB), OpenEXR for numbers (cd/m², lx).
#pragma once

#include <filesystem>

#include "config/base/result.h"
#include "visual/renderer.h"

namespace phare {

/// An opaque picture of one colour.
Image8 blank_image(int width_px, int height_px, std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// Writes a PNG, RGB without alpha. The same picture gives the same bytes. Written beside and renamed: never half a
/// file.
Status write_png(const std::filesystem::path& file, const Image8& image);
Result<Image8> read_png(const std::filesystem::path& file);

/// One channel of 8 bits, rows from above.
struct Grey8 {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> grey;
};
/// PNG or PGM; colours as their luma, the numbers as they stand in the file. Error: no file (a pipe would be waited
/// for), no picture, or more than `most_across` pixels in a direction, which are not read then.
Result<Grey8> read_grey(const std::filesystem::path& file, int most_across);

/// Writes an OpenEXR file, 32-bit float, ZIP: R, G, B in cd/m² (linear Rec. 709, whiteLuminance 1) and the channel
/// "illuminance_lx" from the alpha of the image. Written beside and renamed.
Status write_exr(const std::filesystem::path& file, const ImageF& image);
Result<ImageF> read_exr(const std::filesystem::path& file);

/// The mean of each `factor` x `factor` box, taken in linear light. Rows and columns that fill no box are left out.
Image8 box_downscale(const Image8& image, int factor);

/// The smallest box_downscale that is still at least `width_px` wide; narrower pictures come back unchanged.
Image8 thumbnail(const Image8& image, int width_px);

}  // namespace phare
