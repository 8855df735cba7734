/* The right-hand side for the integrator: the derivatives of one instance, with inputs as functions of time, and the
 * roots at the points where the search for crossings needs them. */

#include "instance.h"

#include <math.h>

static double *wanted_roots(const RootFinder *finder, StepPoint point)
{
    switch (point) {
    case STEP_START:
        return finder->start;
    case STEP_SAMPLE:
        return finder->sample;
    case STEP_END:
        return finder->end;
    case STEP_ELSEWHERE:
        break;
    }
    return NULL;
}

bool integrator_derivatives(void *context, double time, StepPoint point, double *der)
{
    Instance *instance = context;
    const Values *values = &instance->values;
    inputs_apply(&instance->inputs, time, values->p);
    const bool known = model_derivatives(time, values->y, values->p, der, wanted_roots(&instance->roots, point));
    instance->failed_at = known ? NAN : time;
    return known;
}
