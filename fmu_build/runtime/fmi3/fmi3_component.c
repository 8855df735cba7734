#include "fmi3_component.h"

/* Sets of phases. SETTABLE is the standard's super state setFMUState, in which the state of the instance can be set. */
enum {
    NONE = 0,
    I = 1 << PHASE_INSTANTIATED,
    N = 1 << PHASE_INITIALIZATION,
    E = 1 << PHASE_EVENT,
    C = 1 << PHASE_CONTINUOUS_TIME,
    S = 1 << PHASE_STEP_COMPLETE,
    D = 1 << PHASE_STEP_DISCARDED,
    U = 1 << PHASE_INTERMEDIATE,
    T = 1 << PHASE_TERMINATED,
    SETTABLE = I | N | E | C | S | D | T
};

#define RULE(NAME, MODEL_EXCHANGE, CO_SIMULATION) [CALL_##NAME] = {"fmi3" #NAME, MODEL_EXCHANGE, CO_SIMULATION},
static const Rule rules[CALL_COUNT] = {FMI3_CALLS(RULE)};

static const char *const phase_names[] = {
    [PHASE_INSTANTIATED] = "the instantiated state",
    [PHASE_INITIALIZATION] = "Initialization Mode",
    [PHASE_EVENT] = "Event Mode",
    [PHASE_CONTINUOUS_TIME] = "Continuous-Time Mode",
    [PHASE_STEP_COMPLETE] = "Step Mode",
    [PHASE_STEP_DISCARDED] = "Step Mode after the model has ended the simulation",
    [PHASE_INTERMEDIATE] = "Intermediate Update Mode",
    [PHASE_TERMINATED] = "the terminated state",
    [PHASE_ERROR] = "the terminated state",
};

const Face fmi3_face = {.phase_names = phase_names, .states_settable_in_event_mode = true, .errors_terminate = true};

Instance *fmi3_enter(fmi3Instance handle, Call call)
{
    return handle == NULL ? NULL : call_enter(((Component *)handle)->instance, &rules[call]);
}

fmi3Status fmi3_leave(fmi3Instance handle, Status status)
{
    _Static_assert((int)fmi3OK == (int)STATUS_OK && (int)fmi3Warning == (int)STATUS_WARNING &&
                       (int)fmi3Discard == (int)STATUS_DISCARD && (int)fmi3Error == (int)STATUS_ERROR &&
                       (int)fmi3Fatal == (int)STATUS_FATAL,
                   "the severities of FMI 3.0");
    if (handle != NULL && status >= STATUS_ERROR)
        ((Component *)handle)->instance->phase = PHASE_TERMINATED;
    return (fmi3Status)status;
}
