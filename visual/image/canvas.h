// Text, lines and boxes on a picture: labels, axes, legends. Pixels count from the top left.
#pragma once

#include <string_view>

#include "visual/renderer.h"

namespace phare {

struct Colour {
  std::uint8_t red = 255, green = 255, blue = 255;
};

/// Everything outside the picture is clipped.
void fill_box(Image8& image, int x_px, int y_px, int width_px, int height_px, Colour colour);
void draw_line(Image8& image, int x0_px, int y0_px, int x1_px, int y1_px, Colour colour);
/// Copies `picture` with its top left corner at (x, y).
void paste(Image8& image, const Image8& picture, int x_px, int y_px);

/// Height of a line of text.
int text_height_px(int scale = 1);
int text_width_px(std::string_view text, int scale = 1);
/// Draws one line of Latin-1 text (given as UTF-8) with its top left corner at (x, y), in whole-number sizes of a
/// bitmap font.
void draw_text(Image8& image, int x_px, int y_px, std::string_view text, Colour colour, int scale = 1);

}  // namespace phare
