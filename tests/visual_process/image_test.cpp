#include "visual/image/image.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "visual/image/canvas.h"
#include "visual/image/contact_sheet.h"
#include "visual/image/lux_scale.h"
#include "visual/image/png.h"

namespace phare {
namespace {

std::filesystem::path temporary(const char* name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Image8 pattern(int width_px, int height_px) {
  Image8 image = blank_image(width_px, height_px, 0, 0, 0);
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    image.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(i * 31 % 251);
  return image;
}

// A disk that takes no more, here the limit of a file's size: an error, and no picture that cannot be opened.
TEST(Png, ThatTheDiskDoesNotTakeIsAnErrorAndLeavesNothing) {
  const std::filesystem::path file = temporary("full.png");
  std::filesystem::remove(file);
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit most{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &most);
    _exit(write_png(file, pattern(200, 200)).ok() ? 0 : 7);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Png, ReadsBackAndIsTheSameBytesTwice) {
  const Image8 image = pattern(37, 23);
  ASSERT_TRUE(write_png(temporary("a.png"), image).ok());
  ASSERT_TRUE(write_png(temporary("b.png"), image).ok());
  EXPECT_EQ(bytes_of(temporary("a.png")), bytes_of(temporary("b.png")));
  const Result<Image8> back = read_png(temporary("a.png"));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->width_px, 37);
  EXPECT_EQ(back->height_px, 23);
  EXPECT_EQ(back->rgba, image.rgba);
}

// Blocks that come and go, so that what the encoder takes for itself lies elsewhere each time.
TEST(Png, IsTheSameBytesWhereverItsMemoryLies) {
  std::mt19937 random(1);
  std::vector<std::unique_ptr<char[]>> blocks(64);
  for (int i = 0; i < 250; ++i) {
    Image8 image{40, 12, std::vector<std::uint8_t>(4 * 40 * 12)};
    for (std::uint8_t& channel : image.rgba) channel = static_cast<std::uint8_t>(random() % 3);
    const auto first = encode_png(image);
    ASSERT_TRUE(first);
    int others = 0;
    for (int again = 0; again < 300; ++again) {
      blocks[random() % blocks.size()] = std::make_unique_for_overwrite<char[]>(16 * (1 + random() % 6000));
      if (encode_png(image) != first) ++others;
    }
    EXPECT_EQ(others, 0);
  }
}

/// Whether anything stands in the upper halves of the sixteen vector registers.
[[gnu::target("avx"), gnu::noinline]] bool upper_halves_in_use() {
  std::array<std::uint64_t, 2> any{};
  asm volatile(
      "vorps %%ymm1, %%ymm0, %%ymm0\n\tvorps %%ymm2, %%ymm0, %%ymm0\n\tvorps %%ymm3, %%ymm0, %%ymm0\n\t"
      "vorps %%ymm4, %%ymm0, %%ymm0\n\tvorps %%ymm5, %%ymm0, %%ymm0\n\tvorps %%ymm6, %%ymm0, %%ymm0\n\t"
      "vorps %%ymm7, %%ymm0, %%ymm0\n\tvorps %%ymm8, %%ymm0, %%ymm0\n\tvorps %%ymm9, %%ymm0, %%ymm0\n\t"
      "vorps %%ymm10, %%ymm0, %%ymm0\n\tvorps %%ymm11, %%ymm0, %%ymm0\n\tvorps %%ymm12, %%ymm0, %%ymm0\n\t"
      "vorps %%ymm13, %%ymm0, %%ymm0\n\tvorps %%ymm14, %%ymm0, %%ymm0\n\tvorps %%ymm15, %%ymm0, %%ymm0\n\t"
      "vextractf128 $1, %%ymm0, %0\n\tvzeroupper"
      : "=m"(any)
      :
      : "xmm0");
  return (any[0] | any[1]) != 0;
}

// Whoever encodes a picture goes on as fast as before.
TEST(Png, LeavesTheUpperHalvesOfVectorRegistersClear) {
  if (!__builtin_cpu_supports("avx")) GTEST_SKIP() << "this processor's vector registers have no upper halves";
  Image8 image{64, 48, {}};
  for (std::size_t i = 0; i < 64 * 48 * 4; ++i) image.rgba.push_back(static_cast<std::uint8_t>(i * i >> 5));
  upper_halves_in_use();  // clears them
  const auto png = encode_png(image);
  const bool in_use = upper_halves_in_use();
  EXPECT_TRUE(png.has_value());
  EXPECT_FALSE(in_use);
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8u | static_cast<std::uint8_t>(byte);
  return value;
}

// What stb_image does not look at and other readers do: CRC-32 of each chunk (PNG, annex D) and Adler-32 of what was
// deflated (RFC 1950).
TEST(Png, HasTheChecksumsOfItsChunksAndOfItsRows) {
  const Image8 image = pattern(37, 23);
  ASSERT_TRUE(write_png(temporary("sums.png"), image).ok());
  const std::string png = bytes_of(temporary("sums.png"));
  std::string deflated;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t length = big_endian(std::string_view(png).substr(at));
    const std::string_view named = std::string_view(png).substr(at + 4, 4 + length);
    std::uint32_t crc = ~0u;
    for (const char byte : named) {
      crc ^= static_cast<std::uint8_t>(byte);
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1u ^ (crc & 1u ? 0xedb88320u : 0u);
    }
    EXPECT_EQ(big_endian(std::string_view(png).substr(at + 8 + length)), ~crc) << named.substr(0, 4);
    if (named.starts_with("IDAT")) deflated += named.substr(4);
    at += 12 + length;
  }
  std::uint32_t sum = 1, sum_of_sums = 0;
  const auto add = [&](unsigned byte) { sum = (sum + byte) % 65521u, sum_of_sums = (sum_of_sums + sum) % 65521u; };
  for (std::size_t row = 0; row < 23; ++row) {
    add(1);  // each pixel less the one before
    for (std::size_t x = 0; x < 37; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = 4 * (37 * row + x) + c;
        add(static_cast<std::uint8_t>(image.rgba[i] - (x > 0 ? image.rgba[i - 4] : 0)));
      }
  }
  ASSERT_GT(deflated.size(), 6u);
  EXPECT_EQ(big_endian(std::string_view(deflated).substr(deflated.size() - 4)), sum_of_sums << 16u | sum);
}

// Rows of one pixel, of an even and an odd number; more rows than are deflated at once, and none that repeats another,
// so that the file is larger than what was thought enough for it.
TEST(Png, ReadsBackInEverySizeAndWhereNothingCanBeSaved) {
  std::mt19937 random(7);
  for (const auto& [width_px, height_px] : {std::pair{1, 1}, {1, 40}, {2, 17}, {3, 16}, {64, 1}, {641, 479}}) {
    Image8 image = blank_image(width_px, height_px, 0, 0, 0);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
      if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(random());
    ASSERT_TRUE(write_png(temporary("noise.png"), image).ok());
    const Result<Image8> back = read_png(temporary("noise.png"));
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back->width_px, width_px);
    EXPECT_EQ(back->height_px, height_px);
    EXPECT_EQ(back->rgba, image.rgba) << width_px << " x " << height_px;
  }
}

// Of a picture's alpha nothing is kept, and nothing spoils a colour.
TEST(Png, AlphaIsLeftOut) {
  Image8 image = pattern(37, 23);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = static_cast<std::uint8_t>(i * 7);
  ASSERT_TRUE(write_png(temporary("alpha.png"), image).ok());
  const Result<Image8> back = read_png(temporary("alpha.png"));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->rgba, pattern(37, 23).rgba);
}

TEST(Png, OfNoPixelIsAnErrorAndLeavesNothing) {
  EXPECT_FALSE(write_png(temporary("none.png"), Image8{}).ok());
  EXPECT_FALSE(std::filesystem::exists(temporary("none.png")));
}

TEST(Png, AFolderThatIsNotThereIsAnErrorAndLeavesNothing) {
  const std::filesystem::path file = temporary("no_such_folder") / "a.png";
  const Status written = write_png(file, pattern(4, 4));
  ASSERT_FALSE(written.ok());
  EXPECT_NE(written.error().place.find("a.png"), std::string::npos);
  EXPECT_FALSE(read_png(file).ok());
}

TEST(Exr, KeepsFloatsAndIlluminance) {
  ImageF image{5, 3, {}};
  for (int i = 0; i < 5 * 3 * 4; ++i) image.rgba.push_back(0.001f * static_cast<float>(i * i) + 1e-5f);
  ASSERT_TRUE(write_exr(temporary("a.exr"), image).ok());
  const Result<ImageF> back = read_exr(temporary("a.exr"));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->width_px, 5);
  EXPECT_EQ(back->height_px, 3);
  EXPECT_EQ(back->rgba, image.rgba);
  EXPECT_FALSE(read_exr(temporary("none.exr")).ok());
  EXPECT_FALSE(write_exr(temporary("no_such_folder") / "a.exr", image).ok());
}

TEST(BoxDownscale, AveragesInLinearLight) {
  Image8 image = blank_image(4, 2, 0, 0, 0);
  fill_box(image, 0, 0, 1, 2, {255, 255, 255});  // half of the left box white
  const Image8 small = box_downscale(image, 2);
  EXPECT_EQ(small.width_px, 2);
  EXPECT_EQ(small.height_px, 1);
  EXPECT_EQ(small.rgba[0], 188);  // sRGB of 0.5
  EXPECT_EQ(small.rgba[4], 0);
  EXPECT_EQ(thumbnail(blank_image(1280, 720, 9, 9, 9), 320).height_px, 180);
  EXPECT_EQ(thumbnail(blank_image(200, 100, 9, 9, 9), 320).width_px, 200);
}

// IEC 61966-2-1 by its own formula; what lies within rounding of half-way between two steps may be either.
TEST(BoxDownscale, GivesTheNearestStepOfEveryMean) {
  Image8 image = blank_image(512, 512, 0, 0, 0);
  for (int a = 0; a < 256; ++a)
    for (int b = 0; b < 256; ++b) {
      const auto step = static_cast<std::uint8_t>(a), other = static_cast<std::uint8_t>(b);
      fill_box(image, 2 * a, 2 * b, 1, 2, {step, step, step});
      fill_box(image, 2 * a + 1, 2 * b, 1, 2, {other, other, other});
    }
  const Image8 small = box_downscale(image, 2);
  const auto linear = [](int step) {
    const double c = step / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  for (int a = 0; a < 256; ++a)
    for (int b = 0; b < 256; ++b) {
      const double mean = 0.5 * (linear(a) + linear(b));
      const double c = mean <= 0.0031308 ? 12.92 * mean : 1.055 * std::pow(mean, 1.0 / 2.4) - 0.055;
      ASSERT_NEAR(small.rgba[4 * static_cast<std::size_t>(256 * b + a)], 255.0 * c, 0.5 + 1e-4) << a << ' ' << b;
    }
}

TEST(Text, PutsInkInsideItsBox) {
  Image8 image = blank_image(200, 40, 0, 0, 0);
  draw_text(image, 10, 10, "25 m ±20°", {255, 255, 255});
  int ink = 0, outside = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (image.rgba[static_cast<std::size_t>(y * 200 + x) * 4] == 0) continue;
      ++ink;
      if (x < 10 || y < 10 || x >= 10 + text_width_px("25 m ±20°") || y >= 10 + text_height_px()) ++outside;
    }
  }
  EXPECT_GT(ink, 40);
  EXPECT_EQ(outside, 0);
  draw_text(image, -300, -300, "clipped", {255, 0, 0});  // no crash
  draw_text(image, 190, 35, "clipped", {255, 0, 0}, 3);
}

TEST(ContactSheet, LayoutHoldsAllPictures) {
  const SheetLayout layout = contact_sheet_layout(14, 320, 180);
  EXPECT_EQ(layout.columns, 4);
  EXPECT_EQ(layout.rows, 4);
  EXPECT_GE(layout.width_px, 4 * 320);
  EXPECT_GE(layout.height_px, 4 * 180);
  EXPECT_EQ(contact_sheet_layout(2, 320, 180).columns, 2);
  EXPECT_EQ(contact_sheet_layout(0, 320, 180).width_px, 0);
  const Image8 sheet =
      contact_sheet({{blank_image(64, 36, 200, 0, 0), "0.0 s"}, {blank_image(64, 36, 0, 200, 0), "1.0 s"}});
  EXPECT_EQ(sheet.width_px, contact_sheet_layout(2, 64, 36).width_px);
}

TEST(Thumbnails, StayFewAndEvenOverALongDrive) {
  Thumbnails thumbnails;
  for (int second = 0; second < 3600; ++second) {
    if (thumbnails.wants_next())
      thumbnails.offer({blank_image(8, 8, 0, 0, 0), std::to_string(second)});
    else
      thumbnails.skip();
    EXPECT_LE(thumbnails.size(), Thumbnails::kMost);
  }
  const std::vector<LabelledImage> picked = thumbnails.pick(16);
  ASSERT_EQ(picked.size(), 16u);
  EXPECT_EQ(picked.front().label, "0");
  EXPECT_GT(std::stoi(picked.back().label), 3200);
  for (std::size_t i = 1; i < picked.size(); ++i) {
    const int gap = std::stoi(picked[i].label) - std::stoi(picked[i - 1].label);
    EXPECT_GT(gap, 0);
    EXPECT_LT(gap, 400);
  }
}

TEST(LuxScale, BandsAreTheIsoluxLevels) {
  EXPECT_EQ(isolux_band(0.5), 0);
  EXPECT_EQ(isolux_band(1.0), 1);
  EXPECT_EQ(isolux_band(4.0), 2);
  EXPECT_EQ(isolux_band(1000.0), 7);
}

}  // namespace
}  // namespace phare
