#version 460
#extension GL_GOOGLE_include_directive : require
#include "lamps.h"
#include "lib/tone.h"
#include "sky.h"

layout(constant_id = kSpecSkyOutput) const uint output_kind = 0;
layout(push_constant) uniform Push { SkyConstants sky; };
layout(location = 0) out vec3 colour;

// Two triangles between each two rings and sectors, at infinity.
void main() {
  uint cell = uint(gl_VertexIndex) / 6u, corner = uint(gl_VertexIndex) % 6u;
  uint ring = cell / kSkySectors + (corner == 2u || corner == 3u || corner == 5u ? 1u : 0u);
  uint sector = cell % kSkySectors + (corner == 1u || corner == 4u || corner == 5u ? 1u : 0u);
  float sine = sky_ring_sine(ring), azimuth = radians(360.0) * float(sector % kSkySectors) / float(kSkySectors);
  float cosine = sqrt(max(1.0 - sine * sine, 0.0));
  vec3 luminance = sky_luminance(sky.zenith, sine);
  colour = output_kind == kOutputHdr ? luminance : srgb_encoded(tone_curve(luminance * sky.exposure.rgb));
  mat4 clip = mat4(sky.clip_from_eye[0], sky.clip_from_eye[1], sky.clip_from_eye[2], sky.clip_from_eye[3]);
  gl_Position = clip * vec4(cosine * cos(azimuth), cosine * sin(azimuth), sine, 0.0);
}
