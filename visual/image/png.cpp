#include "visual/image/png.h"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>

namespace phare {
namespace {

/// ISA-L's assembly leaves the upper halves of vector registers in use, and code that knows only the lower ones, ours,
/// is then slower by half on AMD's Zen 4 and by more on Intel's (Intel 64 optimization manual, mixing AVX and SSE
/// code).
[[gnu::target("avx")]] void clear_upper_halves() {
  __builtin_ia32_vzeroupper();
}
struct UpperHalves {
  UpperHalves() = default;
  UpperHalves(const UpperHalves&) = delete;
  UpperHalves& operator=(const UpperHalves&) = delete;
  ~UpperHalves() {
    if (__builtin_cpu_supports("avx")) clear_upper_halves();
  }
};

constexpr std::size_t kChannels = 3;
constexpr std::uint8_t kSub = 1;  // the filter: each pixel less the one before it

void append_u32(std::vector<std::uint8_t>& to, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// The chunk's length and name. What follows is its content, until end_chunk().
std::size_t begin_chunk(std::vector<std::uint8_t>& to, std::string_view name) {
  append_u32(to, 0);
  const std::size_t begin = to.size();
  to.insert(to.end(), name.begin(), name.end());
  return begin;
}

void end_chunk(std::vector<std::uint8_t>& to, std::size_t begin) {
  const std::size_t bytes = to.size() - begin;
  for (std::size_t i = 0; i < 4; ++i) to[begin - 4 + i] = static_cast<std::uint8_t>((bytes - 4) >> (24 - 8 * i));
  const UpperHalves after;
  append_u32(to, crc32_gzip_refl(0, to.data() + begin, bytes));
}

/// Each of eight bytes of `a` less its own of `b`: what one borrows must not reach the next.
std::uint64_t less_by_bytes(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kHigh = 0x8080808080808080ull;
  return ((a | kHigh) - (b & ~kHigh)) ^ ((a ^ ~b) & kHigh);
}

/// A row of RGBA as PNG has it: the filter, then the pixels without alpha, two at a time. Writes one byte past it.
void filter_row(const std::uint8_t* rgba, std::size_t width_px, std::uint8_t* to) {
  *to++ = kSub;
  std::memcpy(to, rgba, 4);
  std::size_t x = 1;
  for (to += kChannels; x + 2 <= width_px; x += 2, to += 2 * kChannels) {
    std::array<std::uint64_t, 2> pixels;  // with the pixel before
    std::memcpy(&pixels[0], rgba + 4 * x - 4, 8);
    std::memcpy(&pixels[1], rgba + 4 * x, 8);
    const std::uint64_t less = less_by_bytes(pixels[1], pixels[0]);
    std::array<std::uint8_t, 8> bytes;
    std::memcpy(bytes.data(), &less, 8);
    std::memcpy(to, bytes.data(), 4);
    std::memcpy(to + kChannels, bytes.data() + 4, 4);
  }
  if (x < width_px)
    for (std::size_t c = 0; c < kChannels; ++c)
      to[c] = static_cast<std::uint8_t>(rgba[4 * x + c] - rgba[4 * x + c - 4]);
}

/// Deflates all rows to the end of `to`, so that the same picture gives the same bytes. In one piece: in pieces ISA-L
/// looks at what the buffer held before. By its level 0: levels 1 and 2 take one match more or less by the address at
/// which their stream lies (of 96,000 pieces at places chosen by chance, 107 were others), for 18 % fewer bytes.
bool append_pixels(std::vector<std::uint8_t>& to, const Image8& image) {
  const auto width = static_cast<std::size_t>(image.width_px), height = static_cast<std::size_t>(image.height_px);
  const std::size_t row_bytes = 1 + kChannels * width, bytes = row_bytes * height;
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::size_t room = bytes + bytes / 1024 + 1024;  // of what nothing is saved of: 5 bytes a block of 64 KiB
  if (room > kMost) return false;
  const auto rows = std::make_unique_for_overwrite<std::uint8_t[]>(bytes + 1);
  for (std::size_t y = 0; y < height; ++y) filter_row(image.rgba.data() + 4 * width * y, width, &rows[y * row_bytes]);
  const auto stream = std::make_unique<isal_zstream>();
  isal_deflate_stateless_init(stream.get());
  stream->gzip_flag = IGZIP_ZLIB;
  stream->level = 0;
  stream->end_of_stream = 1;
  stream->next_in = rows.get();
  stream->avail_in = static_cast<std::uint32_t>(bytes);
  const auto deflated = std::make_unique_for_overwrite<std::uint8_t[]>(room);
  stream->next_out = deflated.get();
  stream->avail_out = static_cast<std::uint32_t>(room);
  const UpperHalves after;
  if (isal_deflate_stateless(stream.get()) != COMP_OK) return false;
  to.insert(to.end(), deflated.get(), deflated.get() + stream->total_out);
  return true;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> encode_png(const Image8& image) {
  constexpr std::size_t kMostOfAChunk = 0x7fffffff;
  if (image.width_px < 1 || image.height_px < 1) return std::nullopt;
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  std::vector<std::uint8_t> png(kSignature.begin(), kSignature.end());

  std::size_t begin = begin_chunk(png, "IHDR");
  append_u32(png, static_cast<std::uint32_t>(image.width_px));
  append_u32(png, static_cast<std::uint32_t>(image.height_px));
  constexpr std::uint8_t kBits = 8, kRgb = 2;
  for (const std::uint8_t byte : {kBits, kRgb, std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}}) png.push_back(byte);
  end_chunk(png, begin);

  begin = begin_chunk(png, "IDAT");
  if (!append_pixels(png, image) || png.size() - begin - 4 > kMostOfAChunk) return std::nullopt;
  end_chunk(png, begin);

  end_chunk(png, begin_chunk(png, "IEND"));
  return png;
}

}  // namespace phare
