/* cosimulation.h - moving an instance through time with its own integrator.
 *
 * A communication point is no event of the model: the integrator goes past it and the answer comes from its dense
 * output. Only where the importer really changed something does the integrator go back to the point and start
 * anew from it. */
#ifndef COSIMULATION_H
#define COSIMULATION_H

#include "instance.h"

/* By more than rounding. */
bool cosimulation_is_before(double time, double other);

/* After the initialisation. */
void cosimulation_start(Instance *instance);

/* After Event Mode, which the importer has called. */
void cosimulation_resume(Instance *instance);

/* To a communication point not before the present one. STATUS_DISCARD where the model ended the simulation on
 * the way; values.time is then the time of the end. The time reached is an earlier one, too, where the importer attends
 * to the step and asks for it, or where progress.ended_at_event says so. */
Status cosimulation_advance(Instance *instance, double target);

#endif
