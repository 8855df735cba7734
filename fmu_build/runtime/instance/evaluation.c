#include "evaluation.h"
#include "block.h"
#include "sensitivity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool fail(const Instance *instance, const char *what)
{
    const Values *values = &instance->values;
    char why[NEWTON_TEXT_SIZE];
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "The %s at time %.17g could not be computed: %s.", what,
                values->time, blocks_explain(values->time, values->y, values->p, why));
    return false;
}

void evaluation_update_parameters(Instance *instance)
{
    if (instance->changed.parameters) {
        model_dependent_parameters(instance->values.p);
        instance->changed.parameters = false;
    }
}

bool evaluation_update_algebraics(Instance *instance)
{
    Values *values = &instance->values;
    if (instance->current.algebraics)
        return true;
    evaluation_update_parameters(instance);
    instance->current.algebraics = model_algebraics(values->time, values->y, values->p);
    return instance->current.algebraics || fail(instance, "algebraic variables");
}

bool evaluation_update_derivatives(Instance *instance)
{
    Values *values = &instance->values;
    if (instance->current.derivatives)
        return true;
    evaluation_update_parameters(instance);
    instance->current.derivatives = model_derivatives(values->time, values->y, values->p, instance->derivatives, NULL);
    return instance->current.derivatives || fail(instance, "derivatives");
}

bool evaluation_roots(Instance *instance, double *root)
{
    Values *values = &instance->values;
    evaluation_update_parameters(instance);
    return model_roots(values->time, values->y, values->p, root) || fail(instance, "event indicators");
}

bool evaluation_meet_event(Instance *instance)
{
    if (model.sensitivities == NULL)
        return true;
    evaluation_update_parameters(instance);
    const char *problem = sensitivity_meet_event(&instance->values);
    if (problem != NULL)
        log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "At time %.17g: %s", instance->values.time, problem);
    return problem == NULL;
}

bool roots_evaluate(void *context, double time, double *root)
{
    Instance *instance = context;
    integrator_interpolate(&instance->integrator, time, instance->values.y);
    inputs_apply(&instance->inputs, time, instance->values.p);
    const bool known = model_roots(time, instance->values.y, instance->values.p, root);
    instance->failed_at = known ? NAN : time;
    return known;
}

/* Computes one algebraic variable slightly later or earlier, with the states extrapolated along their derivatives. */
static bool algebraic_beside(const Instance *instance, double delay, size_t index, double *scratch, double *value)
{
    const Values *values = &instance->values;
    memcpy(scratch, values->y, model.n_y * sizeof(double));
    for (size_t i = 0; i < model.n_states; ++i)
        scratch[i] += delay * instance->derivatives[i];
    const bool solved = model_algebraics(values->time + delay, scratch, values->p);
    *value = scratch[index];
    return solved;
}

bool evaluation_time_derivative(Instance *instance, const Variable *variable, double *derivative)
{
    if (variable->store != STORE_STATE_OR_ALGEBRAIC || !evaluation_update_algebraics(instance) ||
        !evaluation_update_derivatives(instance))
        return false;
    if (variable->index < model.n_states) {
        *derivative = instance->derivatives[variable->index];
        return true;
    }
    const double scale = instance->integrator.record.suggestion;
    const double delay = 1e-5 * (scale > 0.0 ? scale : 1e-2);
    double *scratch = malloc(model.n_y * sizeof(double));
    if (scratch == NULL)
        return false;
    double before, after;
    const bool solved = algebraic_beside(instance, -delay, variable->index, scratch, &before) &&
                        algebraic_beside(instance, delay, variable->index, scratch, &after);
    free(scratch);
    if (solved)
        *derivative = (after - before) / (2.0 * delay);
    return solved;
}
