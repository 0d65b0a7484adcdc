#version 460
#extension GL_GOOGLE_include_directive : require
#include "windscreen.h"

layout(location = 0) flat in vec4 light;
layout(location = 1) in vec2 from_middle;
layout(location = 2) flat in vec4 lobes;
layout(location = 3) flat in float taper;
layout(location = 0) out vec4 result;

void main() { result = vec4(light.rgb, light.a * screen_disc(within_drop(from_middle, taper, lobes))); }
