#include "fmi2_component.h"

/* Sets of phases. */
enum {
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

typedef enum { BOTH, MODEL_EXCHANGE, CO_SIMULATION } Interface;

typedef struct {
    const char *name;
    Interface interface;
    unsigned allowed;
} Rule;

/* FMI 2.0.4, the tables of sections 3.2.3 (Model Exchange) and 4.2.4 (Co-Simulation). A function of both has one
 * row, as no instance is ever in a phase of the other kind. */
static const Rule rules[CALL_COUNT] = {
    [CALL_SET_DEBUG_LOGGING] = {"fmi2SetDebugLogging", BOTH, ALL},
    [CALL_SETUP_EXPERIMENT] = {"fmi2SetupExperiment", BOTH, I},
    [CALL_ENTER_INITIALIZATION_MODE] = {"fmi2EnterInitializationMode", BOTH, I},
    [CALL_EXIT_INITIALIZATION_MODE] = {"fmi2ExitInitializationMode", BOTH, N},
    [CALL_TERMINATE] = {"fmi2Terminate", BOTH, E | C | S | D},
    [CALL_RESET] = {"fmi2Reset", BOTH, ALL},
    [CALL_GET_REAL] = {"fmi2GetReal", BOTH, READING},
    [CALL_GET_INTEGER] = {"fmi2GetInteger", BOTH, READING},
    [CALL_GET_BOOLEAN] = {"fmi2GetBoolean", BOTH, READING},
    [CALL_GET_STRING] = {"fmi2GetString", BOTH, READING},
    [CALL_SET_REAL] = {"fmi2SetReal", BOTH, SETTING},
    [CALL_SET_INTEGER] = {"fmi2SetInteger", BOTH, I | N | E | S},
    [CALL_SET_BOOLEAN] = {"fmi2SetBoolean", BOTH, I | N | E | S},
    [CALL_SET_STRING] = {"fmi2SetString", BOTH, I | N | E | S},
    [CALL_GET_FMU_STATE] = {"fmi2GetFMUstate", BOTH, ALL},
    [CALL_SET_FMU_STATE] = {"fmi2SetFMUstate", BOTH, ALL},
    [CALL_FREE_FMU_STATE] = {"fmi2FreeFMUstate", BOTH, ALL},
    [CALL_SERIALIZED_FMU_STATE_SIZE] = {"fmi2SerializedFMUstateSize", BOTH, ALL},
    [CALL_SERIALIZE_FMU_STATE] = {"fmi2SerializeFMUstate", BOTH, ALL},
    [CALL_DESERIALIZE_FMU_STATE] = {"fmi2DeSerializeFMUstate", BOTH, ALL},
    [CALL_GET_DIRECTIONAL_DERIVATIVE] = {"fmi2GetDirectionalDerivative", BOTH, READING},
    [CALL_ENTER_EVENT_MODE] = {"fmi2EnterEventMode", MODEL_EXCHANGE, E | C},
    [CALL_NEW_DISCRETE_STATES] = {"fmi2NewDiscreteStates", MODEL_EXCHANGE, E},
    [CALL_ENTER_CONTINUOUS_TIME_MODE] = {"fmi2EnterContinuousTimeMode", MODEL_EXCHANGE, E},
    [CALL_COMPLETED_INTEGRATOR_STEP] = {"fmi2CompletedIntegratorStep", MODEL_EXCHANGE, C},
    [CALL_SET_TIME] = {"fmi2SetTime", MODEL_EXCHANGE, E | C},
    [CALL_SET_CONTINUOUS_STATES] = {"fmi2SetContinuousStates", MODEL_EXCHANGE, C},
    [CALL_GET_DERIVATIVES] = {"fmi2GetDerivatives", MODEL_EXCHANGE, N | E | C | T | X},
    [CALL_GET_EVENT_INDICATORS] = {"fmi2GetEventIndicators", MODEL_EXCHANGE, N | E | C | T | X},
    [CALL_GET_CONTINUOUS_STATES] = {"fmi2GetContinuousStates", MODEL_EXCHANGE, N | E | C | T | X},
    [CALL_GET_NOMINALS] = {"fmi2GetNominalsOfContinuousStates", MODEL_EXCHANGE, I | N | E | C | T | X},
    [CALL_SET_REAL_INPUT_DERIVATIVES] = {"fmi2SetRealInputDerivatives", CO_SIMULATION, I | N | S},
    [CALL_GET_REAL_OUTPUT_DERIVATIVES] = {"fmi2GetRealOutputDerivatives", CO_SIMULATION, S | D | T | X},
    [CALL_DO_STEP] = {"fmi2DoStep", CO_SIMULATION, S},
    [CALL_CANCEL_STEP] = {"fmi2CancelStep", CO_SIMULATION, 0},
    [CALL_GET_STATUS] = {"fmi2GetStatus", CO_SIMULATION, S | D | T},
    [CALL_GET_REAL_STATUS] = {"fmi2GetRealStatus", CO_SIMULATION, S | D | T},
    [CALL_GET_INTEGER_STATUS] = {"fmi2GetIntegerStatus", CO_SIMULATION, S | D | T},
    [CALL_GET_BOOLEAN_STATUS] = {"fmi2GetBooleanStatus", CO_SIMULATION, S | D | T},
    [CALL_GET_STRING_STATUS] = {"fmi2GetStringStatus", CO_SIMULATION, S | D | T},
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

Instance *fmi2_enter(fmi2Component handle, Call call)
{
    if (handle == NULL)
        return NULL;
    Instance *instance = ((Component *)handle)->instance;
    const Rule *rule = &rules[call];
    const Interface interface = instance->co_simulation ? CO_SIMULATION : MODEL_EXCHANGE;
    if ((rule->interface == BOTH || rule->interface == interface) && (rule->allowed >> instance->phase & 1u) != 0)
        return instance;
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "%s is not allowed in %s of %s.", rule->name,
                phase_names[instance->phase], instance->co_simulation ? "Co-Simulation" : "Model Exchange");
    return NULL;
}

fmi2Status fmi2_refuse(const Instance *instance, Call call, const char *why)
{
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "%s: %s", rules[call].name, why);
    return fmi2Error;
}

bool fmi2_has_array(const Instance *instance, Call call, size_t n, const void *array)
{
    if (n == 0 || array != NULL)
        return true;
    fmi2_refuse(instance, call, "an argument that must be an array is a null pointer.");
    return false;
}

fmi2Status fmi2_finish(Instance *instance, Status status)
{
    static const fmi2Status translated[] = {[STATUS_OK] = fmi2OK,
                                            [STATUS_WARNING] = fmi2Warning,
                                            [STATUS_DISCARD] = fmi2Discard,
                                            [STATUS_ERROR] = fmi2Error,
                                            [STATUS_FATAL] = fmi2Fatal};
    if (status >= STATUS_ERROR)
        instance->phase = PHASE_ERROR;
    if (status == STATUS_OK && instance->warned)
        status = STATUS_WARNING;
    instance->warned = false;
    return translated[status];
}
