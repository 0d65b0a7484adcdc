/* Automatic high beam as an FMI 3.0 co-simulation unit: the rule of phare.laws.AutomaticHighBeam. Speeds and time chosen by eye.
 * High beam above 40 km/h (until 25) while no lamp of another has been seen for 1.5 s; low beam at once when one is. */
#include "fmi3.h"

#include <stdlib.h>

#define OBJECTS 16 /* as modelDescription.xml has it */

enum { kSpeed = 1, kLights = 2, kLight = 3 };

typedef struct {
  double speed_mps;
  int32_t lights[OBJECTS]; /* 0 none, 1 white, 2 red */
  bool on;
  double alone_s;
} Unit;

static void think(Unit* unit, double step_s) {
  bool seen = false;
  for (int i = 0; i < OBJECTS; ++i) seen = seen || unit->lights[i] != 0;
  unit->alone_s = seen ? 0.0 : unit->alone_s + step_s;
  const double speed_kmh = unit->speed_mps * 3.6;
  unit->on = speed_kmh > (unit->on ? 25.0 : 40.0) && unit->alone_s >= 1.5;
}

FMI3_EXPORT const char* fmi3GetVersion(void) { return "3.0"; }

FMI3_EXPORT fmi3Instance fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, bool visible,
                                                     bool logging, bool events, bool early_return,
                                                     const fmi3ValueReference* intermediate, size_t intermediate_count,
                                                     void* environment, void* log, void* update) {
  (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)events, (void)early_return, (void)intermediate;
  (void)intermediate_count, (void)environment, (void)log, (void)update;
  Unit* unit = calloc(1, sizeof(Unit));
  if (unit != NULL) unit->alone_s = 1.5;
  return unit;
}

FMI3_EXPORT void fmi3FreeInstance(fmi3Instance unit) { free(unit); }

FMI3_EXPORT int fmi3EnterInitializationMode(fmi3Instance unit, bool tolerance_defined, double tolerance, double start_s,
                                            bool stop_defined, double stop_s) {
  (void)unit, (void)tolerance_defined, (void)tolerance, (void)start_s, (void)stop_defined, (void)stop_s;
  return fmi3OK;
}

FMI3_EXPORT int fmi3ExitInitializationMode(fmi3Instance unit) {
  think(unit, 0.0);
  return fmi3OK;
}

FMI3_EXPORT int fmi3DoStep(fmi3Instance unit, double point_s, double step_s, bool no_state_before, bool* event, bool* terminate,
                           bool* early_return, double* last_s) {
  (void)no_state_before;
  think(unit, step_s);
  *event = *terminate = *early_return = false;
  *last_s = point_s + step_s;
  return fmi3OK;
}

FMI3_EXPORT int fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference* which, size_t count, const double* values,
                               size_t value_count) {
  if (count != 1 || which[0] != kSpeed || value_count != 1) return fmi3Error;
  ((Unit*)instance)->speed_mps = values[0];
  return fmi3OK;
}

FMI3_EXPORT int fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference* which, size_t count, const int32_t* values,
                             size_t value_count) {
  if (count != 1 || which[0] != kLights || value_count != OBJECTS) return fmi3Error;
  for (int i = 0; i < OBJECTS; ++i) ((Unit*)instance)->lights[i] = values[i];
  return fmi3OK;
}

FMI3_EXPORT int fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference* which, size_t count, int32_t* values,
                             size_t value_count) {
  if (count != 1 || which[0] != kLight || value_count != 1) return fmi3Error;
  values[0] = ((Unit*)instance)->on ? 3 : 2;
  return fmi3OK;
}

FMI3_EXPORT int fmi3Terminate(fmi3Instance unit) { return (void)unit, fmi3OK; }
FMI3_REFUSED(fmi3GetFloat64) FMI3_REFUSED(fmi3Reset)
FMI3_REST
