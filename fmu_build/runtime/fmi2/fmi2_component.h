/* fmi2_component.h - shared by the files of the FMI 2.0 face: the component behind the importer's handle, and the
 * functions that are allowed in each phase. */
#ifndef FMI2_COMPONENT_H
#define FMI2_COMPONENT_H

#include "calls.h"
#include "fmi2Functions.h"

typedef struct {
    Instance *instance;
    char *name;
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
} Component;

/* The functions, by name without "fmi2", and the phases in which Model Exchange and Co-Simulation allow them: FMI
 * 2.0.5, tables in sections 3.2.3 and 4.2.4. The letters are sets of phases, see fmi2_component.c. */
#define FMI2_CALLS(ROW)                                                                                               \
    ROW(SetDebugLogging, ALL, ALL)                                                                                    \
    ROW(SetupExperiment, I, I)                                                                                        \
    ROW(EnterInitializationMode, I, I)                                                                                \
    ROW(ExitInitializationMode, N, N)                                                                                 \
    ROW(Terminate, E | C, S | D)                                                                                      \
    ROW(Reset, ALL, ALL)                                                                                              \
    ROW(GetReal, READING, READING)                                                                                    \
    ROW(GetInteger, READING, READING)                                                                                 \
    ROW(GetBoolean, READING, READING)                                                                                 \
    ROW(GetString, READING, READING)                                                                                  \
    ROW(SetReal, SETTING, SETTING)                                                                                    \
    ROW(SetInteger, I | N | E, I | N | S)                                                                             \
    ROW(SetBoolean, I | N | E, I | N | S)                                                                             \
    ROW(SetString, I | N | E, I | N | S)                                                                              \
    ROW(GetFMUstate, ALL, ALL)                                                                                        \
    ROW(SetFMUstate, ALL, ALL)                                                                                        \
    ROW(FreeFMUstate, ALL, ALL)                                                                                       \
    ROW(SerializedFMUstateSize, ALL, ALL)                                                                             \
    ROW(SerializeFMUstate, ALL, ALL)                                                                                  \
    ROW(DeSerializeFMUstate, ALL, ALL)                                                                                \
    ROW(GetDirectionalDerivative, READING, READING)                                                                   \
    ROW(EnterEventMode, E | C, NONE)                                                                                  \
    ROW(NewDiscreteStates, E, NONE)                                                                                   \
    ROW(EnterContinuousTimeMode, E, NONE)                                                                             \
    ROW(CompletedIntegratorStep, C, NONE)                                                                             \
    ROW(SetTime, E | C, NONE)                                                                                         \
    ROW(SetContinuousStates, C, NONE)                                                                                 \
    ROW(GetDerivatives, N | E | C | T | X, NONE)                                                                      \
    ROW(GetEventIndicators, N | E | C | T | X, NONE)                                                                  \
    ROW(GetContinuousStates, N | E | C | T | X, NONE)                                                                 \
    ROW(GetNominalsOfContinuousStates, I | N | E | C | T | X, NONE)                                                   \
    ROW(SetRealInputDerivatives, NONE, I | N | S)                                                                     \
    ROW(GetRealOutputDerivatives, NONE, S | D | T | X)                                                                \
    ROW(DoStep, NONE, S)                                                                                              \
    ROW(CancelStep, NONE, NONE)                                                                                       \
    ROW(GetStatus, NONE, S | D | T)                                                                                   \
    ROW(GetRealStatus, NONE, S | D | T)                                                                               \
    ROW(GetIntegerStatus, NONE, S | D | T)                                                                            \
    ROW(GetBooleanStatus, NONE, S | D | T)                                                                            \
    ROW(GetStringStatus, NONE, S | D | T)

#define FMI2_CALL_NAME(NAME, MODEL_EXCHANGE, CO_SIMULATION) CALL_##NAME,
typedef enum { FMI2_CALLS(FMI2_CALL_NAME) CALL_COUNT } Call;

extern const Face fmi2_face;

/* Returns the instance behind a handle if its phase allows the call; else NULL, after a message. */
Instance *fmi2_enter(fmi2Component handle, Call call);

static inline fmi2Status fmi2_status(Status status)
{
    _Static_assert((int)fmi2OK == (int)STATUS_OK && (int)fmi2Warning == (int)STATUS_WARNING &&
                       (int)fmi2Discard == (int)STATUS_DISCARD && (int)fmi2Error == (int)STATUS_ERROR &&
                       (int)fmi2Fatal == (int)STATUS_FATAL,
                   "the severities of FMI 2.0");
    return (fmi2Status)status;
}

#endif
