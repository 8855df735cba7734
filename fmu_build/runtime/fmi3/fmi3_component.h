/* fmi3_component.h - shared by the files of the FMI 3.0 face: the component behind the importer's handle, and the
 * functions that are allowed in each phase. */
#ifndef FMI3_COMPONENT_H
#define FMI3_COMPONENT_H

#include "calls.h"
#include "fmi3Functions.h"

typedef struct {
    Instance *instance;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log_message;
    fmi3IntermediateUpdateCallback intermediate_update;
    bool may_get, may_set; /* in the current intermediate update */
    size_t n_intermediate;
    fmi3ValueReference *intermediate; /* [n_intermediate] the variables that it may get or set */
} Component;

/* The functions, by name without "fmi3", and the phases in which Model Exchange and Co-Simulation allow them: FMI
 * 3.0.2, sections 2.3, 3.2 and 4.2. The letters are sets of phases, see fmi3_component.c. */
#define FMI3_ACCESS(ROW, TYPE)                                                                                        \
    ROW(Get##TYPE, I | N | E | C | T, I | N | E | S | D | U | T)                                                      \
    ROW(Set##TYPE, I | N | E | C, I | N | E | S | U)
#define FMI3_CALLS(ROW)                                                                                               \
    ROW(SetDebugLogging, SETTABLE, SETTABLE)                                                                          \
    ROW(EnterConfigurationMode, NONE, NONE)                                                                           \
    ROW(ExitConfigurationMode, NONE, NONE)                                                                            \
    ROW(EnterInitializationMode, I, I)                                                                                \
    ROW(ExitInitializationMode, N, N)                                                                                 \
    ROW(EnterEventMode, C, S)                                                                                         \
    ROW(Terminate, E | C, E | S | D)                                                                                  \
    ROW(Reset, SETTABLE, SETTABLE)                                                                                    \
    FMI3_ACCESS(ROW, Float32)                                                                                         \
    FMI3_ACCESS(ROW, Float64)                                                                                         \
    FMI3_ACCESS(ROW, Int8)                                                                                            \
    FMI3_ACCESS(ROW, UInt8)                                                                                           \
    FMI3_ACCESS(ROW, Int16)                                                                                           \
    FMI3_ACCESS(ROW, UInt16)                                                                                          \
    FMI3_ACCESS(ROW, Int32)                                                                                           \
    FMI3_ACCESS(ROW, UInt32)                                                                                          \
    FMI3_ACCESS(ROW, Int64)                                                                                           \
    FMI3_ACCESS(ROW, UInt64)                                                                                          \
    FMI3_ACCESS(ROW, Boolean)                                                                                         \
    FMI3_ACCESS(ROW, String)                                                                                          \
    FMI3_ACCESS(ROW, Binary)                                                                                          \
    ROW(GetClock, E, E)                                                                                               \
    ROW(SetClock, E, E)                                                                                               \
    ROW(GetIntervalDecimal, N | E, N | E)                                                                             \
    ROW(GetIntervalFraction, N | E, N | E)                                                                            \
    ROW(GetShiftDecimal, N, N)                                                                                        \
    ROW(GetShiftFraction, N, N)                                                                                       \
    ROW(SetIntervalDecimal, N, N)                                                                                     \
    ROW(SetIntervalFraction, N, N)                                                                                    \
    ROW(SetShiftDecimal, N, N)                                                                                        \
    ROW(SetShiftFraction, N, N)                                                                                       \
    ROW(GetNumberOfVariableDependencies, NONE, NONE)                                                                  \
    ROW(GetVariableDependencies, NONE, NONE)                                                                          \
    ROW(GetFMUState, SETTABLE, SETTABLE)                                                                              \
    ROW(SetFMUState, SETTABLE, SETTABLE)                                                                              \
    ROW(FreeFMUState, SETTABLE, SETTABLE)                                                                             \
    ROW(SerializedFMUStateSize, SETTABLE, SETTABLE)                                                                   \
    ROW(SerializeFMUState, SETTABLE, SETTABLE)                                                                        \
    ROW(DeserializeFMUState, SETTABLE, SETTABLE)                                                                      \
    ROW(GetDirectionalDerivative, N | E | C | T, N | E | S | D | T)                                                   \
    ROW(GetAdjointDerivative, N | E | C | T, N | E | S | D | T)                                                       \
    ROW(EvaluateDiscreteStates, E, E)                                                                                 \
    ROW(UpdateDiscreteStates, E, E)                                                                                   \
    ROW(EnterContinuousTimeMode, E, NONE)                                                                             \
    ROW(CompletedIntegratorStep, C, NONE)                                                                             \
    ROW(SetTime, C, NONE)                                                                                             \
    ROW(SetContinuousStates, C, NONE)                                                                                 \
    ROW(GetContinuousStateDerivatives, N | E | C | T, NONE)                                                           \
    ROW(GetEventIndicators, N | E | C | T, NONE)                                                                      \
    ROW(GetContinuousStates, N | E | C | T, NONE)                                                                     \
    ROW(GetNominalsOfContinuousStates, N | E | C | T, NONE)                                                           \
    ROW(GetNumberOfEventIndicators, I | E, NONE)                                                                      \
    ROW(GetNumberOfContinuousStates, I | E, NONE)                                                                     \
    ROW(EnterStepMode, NONE, E)                                                                                       \
    ROW(GetOutputDerivatives, NONE, S | D | U | T)                                                                    \
    ROW(DoStep, NONE, S)                                                                                              \
    ROW(ActivateModelPartition, NONE, NONE)

#define FMI3_CALL_NAME(NAME, MODEL_EXCHANGE, CO_SIMULATION) CALL_##NAME,
typedef enum { FMI3_CALLS(FMI3_CALL_NAME) CALL_COUNT } Call;

extern const Face fmi3_face;

/* Returns the instance behind a handle if its phase allows the call; else NULL, after a message. */
Instance *fmi3_enter(fmi3Instance handle, Call call);

/* Ends every call: after an error, only reading, restoring a state, resetting and freeing remain possible. */
fmi3Status fmi3_leave(fmi3Instance handle, Status status);

#endif
