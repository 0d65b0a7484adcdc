// What the fog of a view is the same for, as flat varyings: each read of a uniform costs a software device's pixel as much as ten
// multiplications. Only where two lamps are all there are: beside more lamps there is no room for it.
#ifndef PHARE_FOG_FLAT_LIB
#define PHARE_FOG_FLAT_LIB
#include "lib/lamp_bindings.glsl"

#ifdef PHARE_VERTEX
#define PHARE_FOG_VARYING out
#else
#define PHARE_FOG_VARYING in
#endif
layout(location = 11) flat PHARE_FOG_VARYING vec4 fog_air;     // extinction, reach, column = pixel·z + w
layout(location = 12) flat PHARE_FOG_VARYING vec4 fog_rows;    // as to_row, w the first pixel of close rows
layout(location = 13) flat PHARE_FOG_VARYING vec4 fog_colour;
layout(location = 14) flat PHARE_FOG_VARYING vec4 fog_lamp_0;  // w: the last pixel of close rows
layout(location = 15) flat PHARE_FOG_VARYING vec3 fog_lamp_1;

#ifdef PHARE_VERTEX
void pass_fog() {
  fog_air = vec4(frame.fog.air.xz, frame.fog.to_column.xy);
  fog_rows = vec4(frame.fog.to_row.xyz, frame.fog.to_column.z);
  fog_colour = frame.fog.colour;
  fog_lamp_0 = vec4(frame.fog.lamps[0].xyz, frame.fog.to_column.w);
  fog_lamp_1 = frame.fog.lamps[1].xyz;
}
#endif
#endif
