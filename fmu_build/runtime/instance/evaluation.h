/* evaluation.h - the model's equations at the present point of an instance, computed only where they are out of
 * date. Each function returns false, after a message, where the equations have no solution. */
#ifndef EVALUATION_H
#define EVALUATION_H

#include "instance.h"

void evaluation_update_parameters(Instance *instance);
bool evaluation_update_algebraics(Instance *instance);
bool evaluation_update_derivatives(Instance *instance);
bool evaluation_roots(Instance *instance, double *root);

/* Time, states or inputs were changed. */
static inline void evaluation_invalidate(Instance *instance)
{
    instance->current.algebraics = false;
    instance->current.derivatives = false;
}

/* The time derivative of a continuous variable along the solution with inputs held: exact for states, a central
 * difference along the tangent for algebraic variables. False for variables that have none. */
bool evaluation_time_derivative(Instance *instance, const Variable *variable, double *derivative);

#endif
