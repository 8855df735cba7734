#include "calls.h"
#include "cosimulation.h"
#include "evaluation.h"
#include "variables.h"

#include <float.h>
#include <math.h>

Status call_get_output_derivatives(Instance *instance, const unsigned *references, size_t n, const int *orders,
                                   double *values)
{
    if (!call_has(instance, n, references) || !call_has(instance, n, orders) || !call_has(instance, n, values))
        return STATUS_ERROR;
    for (size_t i = 0; i < n; ++i) {
        const Variable *variable = variable_find(instance, references[i], TYPE_REAL, "Real");
        if (variable == NULL)
            return STATUS_ERROR;
        if (orders[i] != 1)
            return call_refuse(instance, "derivatives of order %d were requested; only order 1 is available.", orders[i]);
        if (variable->causality != CAUSALITY_OUTPUT ||
            !evaluation_time_derivative(instance, variable, &values[i]))
            return call_refuse(instance, "the derivative of \"%s\" is not known.", variable->name);
    }
    return STATUS_OK;
}

/* Importers add up times in different ways, so rounding errors are not treated as errors; and an event at practically
 * the same time as a communication point may have led slightly beyond it. */
static double slack_of(double time, double step)
{
    return 1e-6 * step + cosimulation_instant(time);
}

/* Returns whether the arguments of a communication step are valid. */
static bool step_is_possible(const Instance *instance, double point, double step)
{
    const double time = instance->values.time, slack = slack_of(time, step);
    return fabs(point - time) <= slack && (step > 0.0 || (step == 0.0 && instance->face->steps_may_be_empty)) &&
           point + step <= DBL_MAX && point + step <= instance->experiment.stop_time + slack;
}

COLD static Status refuse_step(const Instance *instance, double point, double step)
{
    const double time = instance->values.time, stop_time = instance->experiment.stop_time;
    const char *why = "the step goes beyond the stop time";
    if (!isfinite(point) || !isfinite(step) || !isfinite(point + step))
        why = "the communication point, the step size and their sum must be finite";
    else if (step < 0.0)
        why = "the communication step size is negative";
    else if (step == 0.0)
        why = "the communication step size is zero";
    else if (fabs(point - time) > slack_of(time, step))
        why = "the communication point is not where the last step ended";
    return call_refuse(instance, "%s (communication point %.17g, step size %.17g; time %.17g, stop time %.17g).", why,
                       point, step, time, stop_time);
}

Status call_enter_step_mode(Instance *instance)
{
    if (instance == NULL)
        return STATUS_ERROR;
    instance->phase = PHASE_STEP_COMPLETE;
    cosimulation_resume(instance);
    return STATUS_OK;
}

Status call_do_step(Instance *instance, double point, double step)
{
    if (instance == NULL)
        return STATUS_ERROR;
    if (!step_is_possible(instance, point, step))
        return refuse_step(instance, point, step);
    const Status status = cosimulation_advance(instance, point + step);
    if (instance->phase != PHASE_STEP_COMPLETE) /* a callback of the importer has ended the simulation */
        return STATUS_ERROR;
    instance->progress.last_step = status;
    if (status == STATUS_DISCARD)
        instance->phase = PHASE_STEP_DISCARDED;
    return call_finish(instance, status);
}
