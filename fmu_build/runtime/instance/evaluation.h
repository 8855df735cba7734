/* evaluation.h - lazy evaluation of the model's equations at the present point of an instance. The functions of type
 * bool return false, after a message, if the equations have no solution. */
#ifndef EVALUATION_H
#define EVALUATION_H

#include "instance.h"

void evaluation_update_parameters(Instance *instance);
bool evaluation_update_algebraics(Instance *instance);
bool evaluation_update_derivatives(Instance *instance);
bool evaluation_roots(Instance *instance, double *root);

/* To be called when integration has reached an event, before event_update; see sensitivity.h. */
bool evaluation_meet_event(Instance *instance);

/* To be called after a change of time, states or inputs. */
static inline void evaluation_invalidate(Instance *instance)
{
    instance->current.algebraics = false;
    instance->current.derivatives = false;
}

/* Computes the time derivative of a continuous variable along the solution at constant inputs: exact for states, a
 * central difference along the tangent for algebraic variables. Returns false if it is not available. */
bool evaluation_time_derivative(Instance *instance, const Variable *variable, double *derivative);

#endif
