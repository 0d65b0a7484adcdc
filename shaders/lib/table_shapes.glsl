// The shape of each lamp's table (lamps.h), of constants of the pipeline or, where its lookup says so, of the frame: PHARE_SHAPE(I).
#ifndef PHARE_TABLE_SHAPES
#define PHARE_TABLE_SHAPES
#include "lamps.h"
#include "lib/lamp_bindings.glsl"

#define PHARE_SHAPE_CONSTANT(I, J, TYPE, NAME) layout(constant_id = kSpecTables + kSpecPerTable * I + J) const TYPE NAME##_##I = 0;
#define PHARE_SHAPE_CONSTANTS(I)                \
  PHARE_SHAPE_CONSTANT(I, 0, uint, lookup)      \
  PHARE_SHAPE_CONSTANT(I, 1, float, per_x)      \
  PHARE_SHAPE_CONSTANT(I, 2, float, per_y)      \
  PHARE_SHAPE_CONSTANT(I, 3, float, phase_x)    \
  PHARE_SHAPE_CONSTANT(I, 4, float, phase_y)    \
  PHARE_SHAPE_CONSTANT(I, 5, float, fine_x)     \
  PHARE_SHAPE_CONSTANT(I, 6, float, fine_y)     \
  PHARE_SHAPE_CONSTANT(I, 7, float, coarse)     \
  PHARE_SHAPE_CONSTANT(I, 8, float, low_x)      \
  PHARE_SHAPE_CONSTANT(I, 9, float, high_x)     \
  PHARE_SHAPE_CONSTANT(I, 10, float, low_y)     \
  PHARE_SHAPE_CONSTANT(I, 11, float, high_y)    \
  PHARE_SHAPE_CONSTANT(I, 12, float, reach_l_x) \
  PHARE_SHAPE_CONSTANT(I, 13, float, reach_h_x) \
  PHARE_SHAPE_CONSTANT(I, 14, float, reach_l_y) \
  PHARE_SHAPE_CONSTANT(I, 15, float, reach_h_y) \
  PHARE_SHAPE_CONSTANT(I, 16, float, cells_row) \
  PHARE_SHAPE_CONSTANT(I, 17, float, cells_0)   \
  PHARE_SHAPE_CONSTANT(I, 18, float, from_x)    \
  PHARE_SHAPE_CONSTANT(I, 19, float, from_y)    \
  PHARE_SHAPE_CONSTANT(I, 20, float, unit_x)    \
  PHARE_SHAPE_CONSTANT(I, 21, float, unit_y)

#ifdef PHARE_LEAN
#define PHARE_FROM_FRAME(I)
#else
TableShape frame_shape(uint lookup, uint lamp) {
  GpuShape of = frame.shapes[lamp];
  return TableShape(lookup, of.per_phase.xy, of.per_phase.zw, of.fine_cells.xy, of.coarse.x, of.range, of.reach, of.fine_cells.zw, of.from_unit.xy,
                    of.from_unit.zw);
}
#define PHARE_FROM_FRAME(I)                                                                    \
  if ((lookup_##I & kLookupAsFirst) != 0u) return frame_shape(lookup_##I, 0);                  \
  if ((lookup_##I & kLookupOfFrame) != 0u) return frame_shape(lookup_##I, I);
#endif

#define PHARE_SHAPE_OF_LAMP(I)                                                                                              \
  TableShape shape_of_##I() {                                                                                               \
    PHARE_FROM_FRAME(I)                                                                                                     \
    return TableShape(lookup_##I, vec2(per_x_##I, per_y_##I), vec2(phase_x_##I, phase_y_##I), vec2(fine_x_##I, fine_y_##I), coarse_##I, \
                      vec4(low_x_##I, high_x_##I, low_y_##I, high_y_##I),                                                   \
                      vec4(reach_l_x_##I, reach_h_x_##I, reach_l_y_##I, reach_h_y_##I), vec2(cells_row_##I, cells_0_##I),   \
                      vec2(from_x_##I, from_y_##I), vec2(unit_x_##I, unit_y_##I));                                          \
  }
#define PHARE_SHAPE(I) shape_of_##I()

PHARE_EACH_LAMP(PHARE_SHAPE_CONSTANTS)
PHARE_EACH_LAMP(PHARE_SHAPE_OF_LAMP)
#endif
