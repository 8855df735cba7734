#include "calls.h"
#include "cosimulation.h"

Status call_set_logging(Instance *instance, bool on, size_t n, const char *const *categories)
{
    if (!call_has(instance, n, categories))
        return STATUS_ERROR;
    Log log = instance->log;
    if (n == 0)
        log.enabled = on ? LOG_EVERYTHING : instance->face->told_always;
    for (size_t i = 0; i < n; ++i) {
        if (categories[i] == NULL)
            return call_refuse(instance, "a log category is a null pointer.");
        if (!log_switch(&log, categories[i], on))
            return call_refuse(instance, "the log category \"%s\" does not exist.", categories[i]);
    }
    /* Only now, so that a call that is refused changes nothing. */
    instance->log.enabled = log.enabled | (instance->face->told_always & LOG_FAILURES);
    return STATUS_OK;
}

Status call_enter_initialization(Instance *instance)
{
    if (instance == NULL)
        return STATUS_ERROR;
    instance->phase = PHASE_INITIALIZATION;
    return STATUS_OK;
}

Status call_exit_initialization(Instance *instance)
{
    if (instance == NULL)
        return STATUS_ERROR;
    const Status status = instance_initialize(instance);
    if (status == STATUS_OK && instance->co_simulation)
        cosimulation_start(instance);
    instance->phase = instance->co_simulation && !instance->attendance.event_mode ? PHASE_STEP_COMPLETE : PHASE_EVENT;
    return call_finish(instance, status);
}

Status call_terminate(Instance *instance)
{
    if (instance == NULL)
        return STATUS_ERROR;
    instance->phase = PHASE_TERMINATED;
    const StepRecord *record = &instance->integrator.record;
    if (instance->co_simulation)
        log_message(&instance->log, LOG_ALL, STATUS_OK,
                    "%zu integrator steps, %zu rejected, %zu evaluations of the derivatives, %zu events.",
                    record->accepted, record->rejected, record->evaluations, instance->progress.events);
    return STATUS_OK;
}

Status call_reset(Instance *instance)
{
    if (instance == NULL)
        return STATUS_ERROR;
    instance_reset(instance);
    return STATUS_OK;
}
