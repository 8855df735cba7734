/* sensitivity.h - how the sensitivities of a run pass an event whose time depends on the parameters. The functions
 * return NULL on success, else what went wrong; without sensitivities they do nothing. */
#ifndef SENSITIVITY_H
#define SENSITIVITY_H

#include "values.h"

/* The motion has led to the present point, where an event is due: computes how its time moves with each parameter, for
 * the next event_update. Without this call, or if no relation has changed, the event's time is fixed. */
const char *sensitivity_meet_event(Values *values);

/* Makes the sensitivities those of the values at the event as it moves; sets *moves if it does. */
const char *sensitivity_enter_event(Values *values, bool *moves);
/* Makes them those at a fixed time again, after an event that moves. */
const char *sensitivity_leave_event(Values *values);

#endif
