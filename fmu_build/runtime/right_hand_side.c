/* What the integrator integrates: the equations of one instance, with its inputs on their lines. */

#include "instance.h"

bool integrator_derivatives(void *context, double time, double *der)
{
    const Instance *instance = context;
    inputs_apply(&instance->inputs, time, instance->values.p);
    return model_derivatives(time, instance->values.y, instance->values.p, der);
}
