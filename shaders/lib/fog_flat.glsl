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
layout(location = 11) flat PHARE_FOG_VARYING vec4 fog_air;
layout(location = 12) flat PHARE_FOG_VARYING vec4 fog_colour;

#ifdef PHARE_VERTEX
void pass_fog() {
  fog_air = frame.fog.air;
  fog_colour = frame.fog.colour;
}
#endif
#endif
