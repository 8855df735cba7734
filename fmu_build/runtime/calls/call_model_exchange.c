/* Model Exchange, and Event Mode, which Co-Simulation shares. */
#include "calls.h"
#include "evaluation.h"
#include "variables.h"

#include <math.h>
#include <string.h>

/* An indicator changes sign this far beyond the zero of its root, in both directions: an importer that stops at the
 * zero of the indicator then finds the relation changed and the indicator clearly on one side. A root that is exactly
 * zero may stay so, as that of max(u, 0) > 0: it counts as beyond if the relation has changed there. */
static const double hysteresis = 1e-12, beyond = 1e-9;

static bool has_sized(Instance *instance, size_t n, size_t expected, const void *values)
{
    if (!call_has(instance, n, values))
        return false;
    if (n != expected) {
        call_refuse(instance, "the size of the array is %zu, in the model description it is %zu.", n, expected);
        return false;
    }
    return instance->phase != PHASE_INITIALIZATION || instance_initialize(instance) == STATUS_OK;
}

static void copy(double *to, const double *from, size_t n)
{
    if (n > 0)
        memcpy(to, from, n * sizeof(double));
}

Status call_enter_event_mode(Instance *instance)
{
    if (instance == NULL)
        return STATUS_ERROR;
    /* Changes made by the importer cause events at a fixed time, so they are handled first. */
    if (!instance->changed.any && !evaluation_meet_event(instance))
        return call_finish(instance, STATUS_ERROR);
    instance->phase = PHASE_EVENT;
    return STATUS_OK;
}

Status call_update_discrete_states(Instance *instance, EventOutcome *outcome)
{
    *outcome = (EventOutcome){.next_time = INFINITY};
    if (instance == NULL)
        return STATUS_ERROR;
    const EventReporter reporter = instance_reporter(instance);
    evaluation_update_parameters(instance);
    evaluation_invalidate(instance);
    const bool continuous = !instance->changed.any;
    instance->changed = (Changes){0};
    const EventStatus status = event_update(&instance->values, continuous, &reporter, &outcome->states_changed);
    outcome->terminate = status == EVENT_TERMINATE;
    outcome->next_time = event_next_time(&instance->values);
    return call_finish(instance, status == EVENT_ERROR ? STATUS_ERROR : STATUS_OK);
}

Status call_enter_continuous_time_mode(Instance *instance)
{
    if (instance == NULL)
        return STATUS_ERROR;
    instance->phase = PHASE_CONTINUOUS_TIME;
    return STATUS_OK;
}

Status call_completed_step(Instance *instance, bool *terminate)
{
    *terminate = false;
    if (instance == NULL)
        return STATUS_ERROR;
    const EventReporter reporter = instance_reporter(instance);
    evaluation_update_parameters(instance);
    const EventStatus status = event_check_asserts(&instance->values, &reporter);
    *terminate = status == EVENT_TERMINATE;
    return call_finish(instance, status == EVENT_ERROR ? STATUS_ERROR : STATUS_OK);
}

Status call_set_time(Instance *instance, double time)
{
    if (instance == NULL)
        return STATUS_ERROR;
    if (!isfinite(time))
        return call_refuse(instance, "the time %g is not finite.", time);
    if (time != instance->values.time) {
        instance->values.time = time;
        evaluation_invalidate(instance);
    }
    return STATUS_OK;
}

Status call_set_states(Instance *instance, const double *states, size_t n)
{
    if (!has_sized(instance, n, model.n_states, states))
        return STATUS_ERROR;
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(states[i]))
            return call_refuse(instance, "state %zu, \"%s\", cannot be %g: a finite number is needed.", i,
                               variable_name_of_state(i), states[i]);
    copy(instance->values.y, states, n);
    evaluation_invalidate(instance);
    return STATUS_OK;
}

Status call_get_states(Instance *instance, double *states, size_t n)
{
    if (!has_sized(instance, n, model.n_states, states))
        return STATUS_ERROR;
    copy(states, instance->values.y, n);
    return STATUS_OK;
}

Status call_get_derivatives(Instance *instance, double *derivatives, size_t n)
{
    if (!has_sized(instance, n, model.n_states, derivatives) || !evaluation_update_derivatives(instance))
        return STATUS_ERROR;
    copy(derivatives, instance->derivatives, n);
    return STATUS_OK;
}

Status call_get_event_indicators(Instance *instance, double *indicators, size_t n)
{
    if (!has_sized(instance, n, model.n_roots, indicators) || (n > 0 && !evaluation_roots(instance, indicators)))
        return STATUS_ERROR;
    const double *p = instance->values.p;
    for (size_t i = 0; i < model.n_relations; ++i) {
        const Relation *r = &model.relations[i];
        if (r->root < n && indicators[r->root] == 0.0 && relation_holds(r, 0.0) != (p[r->memory] != 0.0))
            indicators[r->root] = p[r->memory] != 0.0 ? beyond : -beyond;
    }
    for (size_t i = 0; i < model.n_relations; ++i) { /* several may have the same root */
        const Relation *r = &model.relations[i];
        if (r->root < n)
            indicators[r->root] += p[r->memory] != 0.0 ? -hysteresis : hysteresis;
    }
    return STATUS_OK;
}

Status call_get_nominals(Instance *instance, double *nominals, size_t n)
{
    if (!has_sized(instance, n, model.n_states, nominals))
        return STATUS_ERROR;
    copy(nominals, model.state_nominal, n);
    return STATUS_OK;
}
