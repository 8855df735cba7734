/* What the integrator integrates: the equations of one instance, with its inputs on their lines. */

#include "instance.h"

bool integrator_derivatives(void *context, double time, StepPoint point, double *der)
{
    const Instance *instance = context;
    double *root = point == STEP_START ? instance->roots.start : point == STEP_END ? instance->roots.end : NULL;
    inputs_apply(&instance->inputs, time, instance->values.p);
    return model_derivatives(time, instance->values.y, instance->values.p, der, root);
}
