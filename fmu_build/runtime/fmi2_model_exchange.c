/* FMI 2.0: Model Exchange. */
#include "evaluation.h"
#include "fmi2_component.h"

#include <math.h>
#include <string.h>

/* An indicator goes on this far beyond zero before its sign changes, and as far back, so that an importer that
 * stops at its zero finds the relation changed and the indicator clearly on one side. */
static const double hysteresis = 1e-12;

static Instance *enter_with_size(fmi2Component c, Call call, size_t n, size_t expected, const void *values)
{
    Instance *instance = fmi2_enter(c, call);
    if (instance == NULL || !fmi2_has_array(instance, call, n, values))
        return NULL;
    if (n != expected) {
        fmi2_refuse(instance, call, "the array has not the size that the model description tells.");
        return NULL;
    }
    if (instance->phase == PHASE_INITIALIZATION && instance_initialize(instance) != STATUS_OK)
        return NULL;
    return instance;
}

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    Instance *instance = fmi2_enter(c, CALL_ENTER_EVENT_MODE);
    if (instance == NULL)
        return fmi2Error;
    instance->phase = PHASE_EVENT;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo)
{
    Instance *instance = fmi2_enter(c, CALL_NEW_DISCRETE_STATES);
    if (instance == NULL || !fmi2_has_array(instance, CALL_NEW_DISCRETE_STATES, 1, eventInfo))
        return fmi2Error;
    const EventReporter reporter = instance_reporter(instance);
    bool states_changed = false;
    evaluation_update_parameters(instance);
    evaluation_invalidate(instance);
    const EventStatus status = event_update(&instance->values, &reporter, &states_changed);
    const double next = event_next_time(&instance->values);
    *eventInfo = (fmi2EventInfo){.newDiscreteStatesNeeded = fmi2False,
                                 .terminateSimulation = status == EVENT_TERMINATE,
                                 .nominalsOfContinuousStatesChanged = fmi2False,
                                 .valuesOfContinuousStatesChanged = states_changed,
                                 .nextEventTimeDefined = next < INFINITY,
                                 .nextEventTime = next < INFINITY ? next : 0.0};
    return fmi2_finish(instance, status == EVENT_ERROR ? STATUS_ERROR : STATUS_OK);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    Instance *instance = fmi2_enter(c, CALL_ENTER_CONTINUOUS_TIME_MODE);
    if (instance == NULL)
        return fmi2Error;
    instance->phase = PHASE_CONTINUOUS_TIME;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *instance = fmi2_enter(c, CALL_COMPLETED_INTEGRATOR_STEP);
    if (instance == NULL || !fmi2_has_array(instance, CALL_COMPLETED_INTEGRATOR_STEP, 1, enterEventMode) ||
        !fmi2_has_array(instance, CALL_COMPLETED_INTEGRATOR_STEP, 1, terminateSimulation))
        return fmi2Error;
    const EventReporter reporter = instance_reporter(instance);
    evaluation_update_parameters(instance);
    const EventStatus status = event_check_asserts(&instance->values, &reporter);
    *enterEventMode = fmi2False;
    *terminateSimulation = status == EVENT_TERMINATE;
    return fmi2_finish(instance, status == EVENT_ERROR ? STATUS_ERROR : STATUS_OK);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    Instance *instance = fmi2_enter(c, CALL_SET_TIME);
    if (instance == NULL)
        return fmi2Error;
    if (!isfinite(time))
        return fmi2_refuse(instance, CALL_SET_TIME, "the time is not finite.");
    if (time != instance->values.time) {
        instance->values.time = time;
        evaluation_invalidate(instance);
    }
    return fmi2OK;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx)
{
    Instance *instance = enter_with_size(c, CALL_SET_CONTINUOUS_STATES, nx, model.n_states, x);
    if (instance == NULL)
        return fmi2Error;
    for (size_t i = 0; i < nx; ++i)
        if (!isfinite(x[i]))
            return fmi2_refuse(instance, CALL_SET_CONTINUOUS_STATES, "a state is not finite.");
    if (nx > 0)
        memcpy(instance->values.y, x, nx * sizeof(double));
    evaluation_invalidate(instance);
    return fmi2OK;
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx)
{
    Instance *instance = enter_with_size(c, CALL_GET_DERIVATIVES, nx, model.n_states, derivatives);
    if (instance == NULL || !evaluation_update_derivatives(instance))
        return fmi2Error;
    if (nx > 0)
        memcpy(derivatives, instance->derivatives, nx * sizeof(double));
    return fmi2OK;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni)
{
    Instance *instance = enter_with_size(c, CALL_GET_EVENT_INDICATORS, ni, model.n_roots, eventIndicators);
    if (instance == NULL || (ni > 0 && !evaluation_roots(instance, eventIndicators)))
        return fmi2Error;
    for (size_t i = 0; i < model.n_relations; ++i) {
        const Relation *relation = &model.relations[i];
        if (relation->root < ni)
            eventIndicators[relation->root] += instance->values.p[relation->memory] != 0.0 ? -hysteresis : hysteresis;
    }
    return fmi2OK;
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx)
{
    Instance *instance = enter_with_size(c, CALL_GET_CONTINUOUS_STATES, nx, model.n_states, x);
    if (instance == NULL)
        return fmi2Error;
    if (nx > 0)
        memcpy(x, instance->values.y, nx * sizeof(double));
    return fmi2OK;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx)
{
    Instance *instance = enter_with_size(c, CALL_GET_NOMINALS, nx, model.n_states, x_nominal);
    if (instance == NULL)
        return fmi2Error;
    if (nx > 0)
        memcpy(x_nominal, model.state_nominal, nx * sizeof(double));
    return fmi2OK;
}
