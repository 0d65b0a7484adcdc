#include "visual/image/canvas.h"

#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace phare {
namespace {

void put(Image8& image, int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px) return;
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(x)) * 4;
  image.rgba[at] = colour.red;
  image.rgba[at + 1] = colour.green;
  image.rgba[at + 2] = colour.blue;
  image.rgba[at + 3] = 255;
}

/// ProggyClean, the 13-pixel font inside Dear ImGui, as an alpha bitmap. Built once; no ImGui context is needed.
struct Font {
  ImFontAtlas atlas;
  ImFont* font = nullptr;
  unsigned char* alpha = nullptr;
  int width_px = 0, height_px = 0;

  Font() {
    font = atlas.AddFontDefault();
    atlas.GetTexDataAsAlpha8(&alpha, &width_px, &height_px);
  }
};

const Font& font() {
  static const Font instance;
  return instance;
}

/// UTF-8 to code points; a malformed byte stands for itself.
std::u32string code_points(std::string_view text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    if ((first & 0xE0u) == 0xC0u && i + 1 < text.size()) {
      points.push_back(((first & 0x1Fu) << 6) | (static_cast<unsigned char>(text[++i]) & 0x3Fu));
    } else {
      points.push_back(first);
    }
  }
  return points;
}

const ImFontGlyph* glyph_of(char32_t point) {
  return font().font->FindGlyph(static_cast<ImWchar>(point));
}

}  // namespace

void fill_box(Image8& image, int x_px, int y_px, int width_px, int height_px, Colour colour) {
  for (int y = std::max(y_px, 0); y < std::min(y_px + height_px, image.height_px); ++y) {
    for (int x = std::max(x_px, 0); x < std::min(x_px + width_px, image.width_px); ++x) put(image, x, y, colour);
  }
}

void draw_line(Image8& image, int x0_px, int y0_px, int x1_px, int y1_px, Colour colour) {
  const int steps = std::max({std::abs(x1_px - x0_px), std::abs(y1_px - y0_px), 1});
  for (int i = 0; i <= steps; ++i) {
    put(image, x0_px + (x1_px - x0_px) * i / steps, y0_px + (y1_px - y0_px) * i / steps, colour);
  }
}

void paste(Image8& image, const Image8& picture, int x_px, int y_px) {
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const std::size_t at =
          (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) + static_cast<std::size_t>(x)) * 4;
      put(image, x_px + x, y_px + y, {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]});
    }
  }
}

int text_height_px(int scale) {
  return 13 * scale;
}

int text_width_px(std::string_view text, int scale) {
  float width = 0.0f;
  for (const char32_t point : code_points(text)) width += glyph_of(point)->AdvanceX;
  return static_cast<int>(width) * scale;
}

void draw_text(Image8& image, int x_px, int y_px, std::string_view text, Colour colour, int scale) {
  const Font& bitmap = font();
  float pen = 0.0f;
  for (const char32_t point : code_points(text)) {
    const ImFontGlyph* glyph = glyph_of(point);
    const int left = static_cast<int>(glyph->U0 * static_cast<float>(bitmap.width_px) + 0.5f);
    const int top = static_cast<int>(glyph->V0 * static_cast<float>(bitmap.height_px) + 0.5f);
    const int right = static_cast<int>(glyph->U1 * static_cast<float>(bitmap.width_px) + 0.5f);
    const int bottom = static_cast<int>(glyph->V1 * static_cast<float>(bitmap.height_px) + 0.5f);
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        if (bitmap.alpha[v * bitmap.width_px + u] < 128) continue;
        const int x = static_cast<int>(pen + glyph->X0) + u - left, y = static_cast<int>(glyph->Y0) + v - top;
        fill_box(image, x_px + x * scale, y_px + y * scale, scale, scale, colour);
      }
    }
    pen += glyph->AdvanceX;
  }
}

}  // namespace phare
