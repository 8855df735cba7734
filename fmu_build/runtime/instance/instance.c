#include "instance.h"
#include "evaluation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The errors of single steps add up over a simulation and its events; the tolerance applies to their sum. */
static const double part_of_one_step = 0.02, least_of_one_step = 1e-14;

static const double least_tolerance = 1e-13, greatest_tolerance = 1e-2;

/* Steps longer than this fraction of the experiment could miss fast changes without events. */
static const double largest_step_fraction = 0.02;

static size_t block_count(size_t n_inputs)
{
    return 2 * values_count() + model.n_states + integrator_count() + roots_count() + 2 * n_inputs;
}

static void bind(Instance *instance)
{
    double *next = instance->block;
    values_bind(&instance->start, next);
    next += values_count();
    values_bind(&instance->values, next);
    next += values_count();
    instance->derivatives = next;
    next += model.n_states;
    integrator_bind(&instance->integrator, next);
    next += integrator_count();
    roots_bind(&instance->roots, next);
    next += roots_count();
    instance->inputs.base = next;
    instance->inputs.slope = next + instance->inputs.count;
}

static void connect(Instance *instance)
{
    Integrator *integrator = &instance->integrator;
    integrator->nominal = model.state_nominal;
    integrator->context = instance;
    instance->roots.context = instance;
    bind(instance);
    integrator->argument = instance->values.y;
}

Instance *instance_create(bool co_simulation, const Face *face, const Log *log)
{
    const size_t n_inputs = inputs_of_model(NULL);
    Instance *instance = calloc(1, sizeof *instance);
    if (instance == NULL)
        return NULL;
    instance->co_simulation = co_simulation;
    instance->face = face;
    instance->log = *log;
    instance->block_count = block_count(n_inputs);
    instance->block = malloc((instance->block_count + 1) * sizeof(double));
    instance->inputs.index = malloc((n_inputs + 1) * sizeof(size_t));
    if (instance->block == NULL || instance->inputs.index == NULL) {
        instance_free(instance);
        return NULL;
    }
    instance->inputs.count = inputs_of_model(instance->inputs.index);
    connect(instance);
    instance_reset(instance);
    return instance;
}

void instance_free(Instance *instance)
{
    if (instance == NULL)
        return;
    free(instance->inputs.index);
    free(instance->block);
    free(instance);
}

void instance_apply_experiment(Instance *instance)
{
    const Experiment *experiment = &instance->experiment;
    instance->integrator.tolerance = fmax(part_of_one_step * experiment->tolerance, least_of_one_step);
    instance->integrator.largest_step = (experiment->stop_time - experiment->start_time) * largest_step_fraction;
    if (!(instance->integrator.largest_step > 0.0))
        instance->integrator.largest_step = INFINITY;
}

void instance_reset(Instance *instance)
{
    memset(instance->block, 0, instance->block_count * sizeof(double));
    values_reset(&instance->start);
    values_reset(&instance->values);
    instance->phase = PHASE_INSTANTIATED;
    instance->experiment = (Experiment){.start_time = 0.0, .stop_time = INFINITY, .tolerance = DEFAULT_TOLERANCE};
    instance->changed = (Changes){0};
    instance->current = (UpToDate){0};
    instance->progress = (Progress){0};
    instance->steps = (StepMemory){0};
    instance->integrator.record = (StepRecord){0};
    instance->inputs.since = 0.0;
    instance->inputs.active = false;
    instance->warned = false;
    instance_apply_experiment(instance);
}

Status instance_set_experiment(Instance *instance, double start_time, double stop_time, double tolerance)
{
    const Log *log = &instance->log;
    if (!isfinite(start_time)) {
        log_message(log, LOG_STATUS_ERROR, STATUS_ERROR, "The start time %g is not finite.", start_time);
        return STATUS_ERROR;
    }
    if (!(stop_time >= start_time)) {
        log_message(log, LOG_STATUS_ERROR, STATUS_ERROR, "The stop time %g lies before the start time %g.", stop_time,
                    start_time);
        return STATUS_ERROR;
    }
    if (!(tolerance > 0.0)) {
        log_message(log, LOG_STATUS_ERROR, STATUS_ERROR, "The tolerance %g is not a positive number.", tolerance);
        return STATUS_ERROR;
    }
    const double usable = fmin(fmax(tolerance, least_tolerance), greatest_tolerance);
    instance->experiment = (Experiment){.start_time = start_time, .stop_time = stop_time, .tolerance = usable};
    instance->current.initialization = false;
    instance_apply_experiment(instance);
    if (usable == tolerance)
        return STATUS_OK;
    log_message(log, LOG_STATUS_WARNING, STATUS_WARNING,
                "The tolerance %g is outside of what can be kept, %g to %g; %g is used.", tolerance, least_tolerance,
                greatest_tolerance, usable);
    return STATUS_WARNING;
}

Status instance_initialize(Instance *instance)
{
    if (instance->current.initialization)
        return STATUS_OK;
    Values *values = &instance->values;
    memcpy(values->y, instance->start.y, values_count() * sizeof(double));
    values->time = instance->experiment.start_time;
    instance->current = (UpToDate){0};
    const EventReporter reporter = instance_reporter(instance);
    if (event_initialize(values, &reporter) == EVENT_OK) {
        instance->current.initialization = true;
        return STATUS_OK;
    }
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "The initialization at time %.17g failed.",
                values->time);
    return STATUS_ERROR;
}

static void report(void *context, ActionKind kind, const char *message)
{
    Instance *instance = context;
    const double time = instance->values.time;
    switch (kind) {
    case ACTION_ERROR:
        log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "At time %.9g: %s", time, message);
        break;
    case ACTION_WARNING:
        instance->warned = true;
        log_message(&instance->log, LOG_STATUS_WARNING, STATUS_WARNING, "At time %.9g: %s", time, message);
        break;
    case ACTION_TERMINATE:
        log_message(&instance->log, LOG_STATUS_DISCARD, STATUS_DISCARD,
                    "At time %.9g the model ends the simulation: %s", time, message);
        break;
    }
}

EventReporter instance_reporter(Instance *instance)
{
    return (EventReporter){.context = instance, .report = report};
}
