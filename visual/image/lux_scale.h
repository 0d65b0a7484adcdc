// Illuminance as colour, the same for the wall, the bird's eye and its legend.
#pragma once

#include "config/isolux.h"
#include "visual/image/canvas.h"

namespace phare {

/// False colour of an illuminance: the very function of the shaders (shaders/lib/tone.h), to sRGB.
Colour false_colour(double illuminance_lx);
/// Which band between isolux levels, 0 below the first. Neighbours that differ have a line between them.
int isolux_band(double illuminance_lx);
/// A vertical colour bar with the levels beside it, 70 px wide.
void draw_lux_legend(Image8& image, int x_px, int y_px, int height_px);

}  // namespace phare
