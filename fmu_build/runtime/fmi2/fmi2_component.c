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

#define RULE(NAME, MODEL_EXCHANGE, CO_SIMULATION) [CALL_##NAME] = {"fmi2" #NAME, MODEL_EXCHANGE, CO_SIMULATION},
static const Rule rules[CALL_COUNT] = {FMI2_CALLS(RULE)};

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
