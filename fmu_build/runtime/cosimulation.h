/* cosimulation.h - moving an instance through time with its own integrator.
 *
 * A communication point is no event of the model: the integrator goes past it and the answer comes from its dense
 * output. Only where the importer really changed something does the integrator go back to the point and start
 * anew from it. */
#ifndef COSIMULATION_H
#define COSIMULATION_H

#include "instance.h"

/* After the initialisation. */
void cosimulation_start(Instance *instance);

/* To a communication point not before the present one. STATUS_DISCARD where the model ended the simulation on
 * the way; values.time is then the time of the end. */
Status cosimulation_advance(Instance *instance, double target);

#endif
