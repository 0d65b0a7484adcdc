// Contract of the gui pass: coloured triangles in pixels with letters from an atlas, blended over the picture.
#ifndef PHARE_SHADERS_GUI_H
#define PHARE_SHADERS_GUI_H
#include "lib/portable.h"
PHARE_SHADER_BEGIN
const uint kGuiAtlas = 0u;     // binding: coverage, one channel
const uint kGuiPosition = 0u;  // location: pixels from the upper left corner
const uint kGuiTexel = 1u;     // location: shares of the atlas
const uint kGuiColour = 2u;    // location: sRGB as displayed, and alpha
struct GuiConstants {
  vec2 clip_per_px;  // two over width and height of the picture
};
PHARE_SHADER_END
#endif
