#include "fmi2_component.h"

/* Sets of phases. */
enum {
    NONE = 0,
    I = 1 << PHASE_INSTANTIATED,
    N = 1 << PHASE_INITIALIZATION,
    E = 1 << PHASE_EVENT,
    C = 1 << PHASE_CONTINUOUS_TIME,
    S = 1 << PHASE_STEP_COMPLETE,
    D = 1 << PHASE_STEP_DISCARDED,
    T = 1 << PHASE_TERMINATED,
    X = 1 << PHASE_ERROR,
    ALL = I | N | E | C | S | D | T | X,
    READING = N | E | C | S | D | T | X,
    SETTING = I | N | E | C | S
};

/* FMI 2.0.5, the tables of sections 3.2.3 (Model Exchange) and 4.2.4 (Co-Simulation). */
static const Rule rules[CALL_COUNT] = {
    [CALL_SET_DEBUG_LOGGING] = {"fmi2SetDebugLogging", ALL, ALL},
    [CALL_SETUP_EXPERIMENT] = {"fmi2SetupExperiment", I, I},
    [CALL_ENTER_INITIALIZATION_MODE] = {"fmi2EnterInitializationMode", I, I},
    [CALL_EXIT_INITIALIZATION_MODE] = {"fmi2ExitInitializationMode", N, N},
    [CALL_TERMINATE] = {"fmi2Terminate", E | C, S | D},
    [CALL_RESET] = {"fmi2Reset", ALL, ALL},
    [CALL_GET_REAL] = {"fmi2GetReal", READING, READING},
    [CALL_GET_INTEGER] = {"fmi2GetInteger", READING, READING},
    [CALL_GET_BOOLEAN] = {"fmi2GetBoolean", READING, READING},
    [CALL_GET_STRING] = {"fmi2GetString", READING, READING},
    [CALL_SET_REAL] = {"fmi2SetReal", SETTING, SETTING},
    [CALL_SET_INTEGER] = {"fmi2SetInteger", I | N | E, I | N | S},
    [CALL_SET_BOOLEAN] = {"fmi2SetBoolean", I | N | E, I | N | S},
    [CALL_SET_STRING] = {"fmi2SetString", I | N | E, I | N | S},
    [CALL_GET_FMU_STATE] = {"fmi2GetFMUstate", ALL, ALL},
    [CALL_SET_FMU_STATE] = {"fmi2SetFMUstate", ALL, ALL},
    [CALL_FREE_FMU_STATE] = {"fmi2FreeFMUstate", ALL, ALL},
    [CALL_SERIALIZED_FMU_STATE_SIZE] = {"fmi2SerializedFMUstateSize", ALL, ALL},
    [CALL_SERIALIZE_FMU_STATE] = {"fmi2SerializeFMUstate", ALL, ALL},
    [CALL_DESERIALIZE_FMU_STATE] = {"fmi2DeSerializeFMUstate", ALL, ALL},
    [CALL_GET_DIRECTIONAL_DERIVATIVE] = {"fmi2GetDirectionalDerivative", READING, READING},
    [CALL_ENTER_EVENT_MODE] = {"fmi2EnterEventMode", E | C, NONE},
    [CALL_NEW_DISCRETE_STATES] = {"fmi2NewDiscreteStates", E, NONE},
    [CALL_ENTER_CONTINUOUS_TIME_MODE] = {"fmi2EnterContinuousTimeMode", E, NONE},
    [CALL_COMPLETED_INTEGRATOR_STEP] = {"fmi2CompletedIntegratorStep", C, NONE},
    [CALL_SET_TIME] = {"fmi2SetTime", E | C, NONE},
    [CALL_SET_CONTINUOUS_STATES] = {"fmi2SetContinuousStates", C, NONE},
    [CALL_GET_DERIVATIVES] = {"fmi2GetDerivatives", N | E | C | T | X, NONE},
    [CALL_GET_EVENT_INDICATORS] = {"fmi2GetEventIndicators", N | E | C | T | X, NONE},
    [CALL_GET_CONTINUOUS_STATES] = {"fmi2GetContinuousStates", N | E | C | T | X, NONE},
    [CALL_GET_NOMINALS] = {"fmi2GetNominalsOfContinuousStates", I | N | E | C | T | X, NONE},
    [CALL_SET_REAL_INPUT_DERIVATIVES] = {"fmi2SetRealInputDerivatives", NONE, I | N | S},
    [CALL_GET_REAL_OUTPUT_DERIVATIVES] = {"fmi2GetRealOutputDerivatives", NONE, S | D | T | X},
    [CALL_DO_STEP] = {"fmi2DoStep", NONE, S},
    [CALL_CANCEL_STEP] = {"fmi2CancelStep", NONE, NONE},
    [CALL_GET_STATUS] = {"fmi2GetStatus", NONE, S | D | T},
    [CALL_GET_REAL_STATUS] = {"fmi2GetRealStatus", NONE, S | D | T},
    [CALL_GET_INTEGER_STATUS] = {"fmi2GetIntegerStatus", NONE, S | D | T},
    [CALL_GET_BOOLEAN_STATUS] = {"fmi2GetBooleanStatus", NONE, S | D | T},
    [CALL_GET_STRING_STATUS] = {"fmi2GetStringStatus", NONE, S | D | T},
};

static const char *const phase_names[] = {
    [PHASE_INSTANTIATED] = "the instantiated state",
    [PHASE_INITIALIZATION] = "Initialization Mode",
    [PHASE_EVENT] = "Event Mode",
    [PHASE_CONTINUOUS_TIME] = "Continuous-Time Mode",
    [PHASE_STEP_COMPLETE] = "the step complete state",
    [PHASE_STEP_DISCARDED] = "the step failed state",
    [PHASE_TERMINATED] = "the terminated state",
    [PHASE_ERROR] = "the error state",
};

const Face fmi2_face = {.phase_names = phase_names, .told_always = LOG_PROBLEMS, .steps_may_be_empty = true};

Instance *fmi2_enter(fmi2Component handle, Call call)
{
    return handle == NULL ? NULL : call_enter(((Component *)handle)->instance, &rules[call]);
}
