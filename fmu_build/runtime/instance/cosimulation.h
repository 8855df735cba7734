/* cosimulation.h - advances an instance in time with its own integrator.
 *
 * A communication point is not an event of the model: the integrator steps past it and answers from its dense output.
 * It goes back to the point and restarts there only if the importer has changed a value. */
#ifndef COSIMULATION_H
#define COSIMULATION_H

#include "instance.h"

/* Returns by how much times at `time` differ at most that are practically equal. */
double cosimulation_instant(double time);

/* Returns whether `time` is before `other` by more than rounding. */
bool cosimulation_is_before(double time, double other);

/* To be called after the initialization. */
void cosimulation_start(Instance *instance);

/* To be called after Event Mode, if the importer carries it out. */
void cosimulation_resume(Instance *instance);

/* Advances to a communication point not before the present one. Returns STATUS_DISCARD if the model ended the
 * simulation on the way; values.time is then the time of the end. It is also earlier than the target if the importer
 * attends to the step and requests it, or if progress.ended_at_event is set. */
Status cosimulation_advance(Instance *instance, double target);

#endif
