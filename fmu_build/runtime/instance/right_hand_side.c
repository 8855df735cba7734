/* What the integrator integrates: the equations of one instance, with its inputs on their lines. The roots come along
 * where the search for crossings wants them. */

#include "instance.h"

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
    const Instance *instance = context;
    inputs_apply(&instance->inputs, time, instance->values.p);
    return model_derivatives(time, instance->values.y, instance->values.p, der, wanted_roots(&instance->roots, point));
}
