#version 460
#extension GL_GOOGLE_include_directive : require
#include "gui.h"

layout(set = 0, binding = kGuiAtlas) uniform sampler2D coverage;
layout(location = 0) in vec2 at_01;
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 result;

// The display holds sRGB values: colours are blended as they are displayed, as Dear ImGui chooses them.
void main() {
  result = vec4(colour.rgb, colour.a * texture(coverage, at_01).r);
}
