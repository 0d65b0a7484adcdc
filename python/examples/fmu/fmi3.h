/* The part of FMI 3.0 (clause 2.2, co-simulation) that this example speaks, declared by us. Whoever has the standard's own headers takes
 * those. An importer looks for every function of the standard: those of no use here answer fmi3Error. */
#ifndef PHARE_EXAMPLE_FMI3_H
#define PHARE_EXAMPLE_FMI3_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FMI3_EXPORT __attribute__((visibility("default")))

enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
typedef void* fmi3Instance;
typedef uint32_t fmi3ValueReference;

#define FMI3_REFUSED(name) \
  FMI3_EXPORT int name(void) { return fmi3Error; }

#define FMI3_REFUSED_GET_SET(type) FMI3_REFUSED(fmi3Get##type) FMI3_REFUSED(fmi3Set##type)

#define FMI3_REST                                                                                                          \
  FMI3_EXPORT void* fmi3InstantiateModelExchange(void) { return NULL; }                                                    \
  FMI3_EXPORT void* fmi3InstantiateScheduledExecution(void) { return NULL; }                                               \
  FMI3_REFUSED_GET_SET(Float32) FMI3_REFUSED_GET_SET(Int8) FMI3_REFUSED_GET_SET(UInt8) FMI3_REFUSED_GET_SET(Int16)         \
  FMI3_REFUSED_GET_SET(UInt16) FMI3_REFUSED_GET_SET(UInt32) FMI3_REFUSED_GET_SET(Int64) FMI3_REFUSED_GET_SET(UInt64)       \
  FMI3_REFUSED_GET_SET(Boolean) FMI3_REFUSED_GET_SET(String) FMI3_REFUSED_GET_SET(Binary) FMI3_REFUSED_GET_SET(Clock)      \
  FMI3_REFUSED(fmi3SetDebugLogging) FMI3_REFUSED(fmi3EnterEventMode) FMI3_REFUSED(fmi3EnterStepMode)                       \
  FMI3_REFUSED(fmi3GetNumberOfVariableDependencies) FMI3_REFUSED(fmi3GetVariableDependencies)                              \
  FMI3_REFUSED_GET_SET(FMUState) FMI3_REFUSED(fmi3FreeFMUState) FMI3_REFUSED(fmi3SerializedFMUStateSize)                   \
  FMI3_REFUSED(fmi3SerializeFMUState) FMI3_REFUSED(fmi3DeserializeFMUState) FMI3_REFUSED(fmi3GetDirectionalDerivative)     \
  FMI3_REFUSED(fmi3GetAdjointDerivative) FMI3_REFUSED(fmi3EnterConfigurationMode) FMI3_REFUSED(fmi3ExitConfigurationMode)  \
  FMI3_REFUSED_GET_SET(IntervalDecimal) FMI3_REFUSED_GET_SET(IntervalFraction) FMI3_REFUSED_GET_SET(ShiftDecimal)          \
  FMI3_REFUSED_GET_SET(ShiftFraction) FMI3_REFUSED(fmi3EvaluateDiscreteStates) FMI3_REFUSED(fmi3UpdateDiscreteStates)      \
  FMI3_REFUSED(fmi3EnterContinuousTimeMode) FMI3_REFUSED(fmi3CompletedIntegratorStep) FMI3_REFUSED(fmi3SetTime)            \
  FMI3_REFUSED_GET_SET(ContinuousStates) FMI3_REFUSED(fmi3GetContinuousStateDerivatives) FMI3_REFUSED(fmi3GetEventIndicators) \
  FMI3_REFUSED(fmi3GetNominalsOfContinuousStates) FMI3_REFUSED(fmi3GetNumberOfEventIndicators)                             \
  FMI3_REFUSED(fmi3GetNumberOfContinuousStates) FMI3_REFUSED(fmi3GetOutputDerivatives) FMI3_REFUSED(fmi3ActivateModelPartition)

#endif
