#version 460
#extension GL_GOOGLE_include_directive : require
#include "gui.h"

layout(push_constant) uniform Constants { GuiConstants constants; };
layout(location = kGuiPosition) in vec2 position_px;
layout(location = kGuiTexel) in vec2 texel_01;
layout(location = kGuiColour) in vec4 srgba;
layout(location = 0) out vec2 at_01;
layout(location = 1) out vec4 colour;

void main() {
  gl_Position = vec4(position_px * constants.clip_per_px - 1.0, 0.0, 1.0);
  at_01 = texel_01;
  colour = srgba;
}
