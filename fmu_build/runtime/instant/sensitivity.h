/* sensitivity.h - the change of sensitivities at an event whose time depends on the parameters. The functions return
 * NULL on success, else a description of the failure; without sensitivities they do nothing. */
#ifndef SENSITIVITY_H
#define SENSITIVITY_H

#include "values.h"

/* To be called where integration has reached an event: computes how the event's time moves with each parameter, for the
 * next event_update. Without this call, or if no relation has changed, the event's time is fixed. */
const char *sensitivity_meet_event(Values *values);

/* Converts the sensitivities to those at the moving event; sets *moves if it moves. */
const char *sensitivity_enter_event(Values *values, bool *moves);
/* Converts the sensitivities back to those at a fixed time after an event that moves. */
const char *sensitivity_leave_event(Values *values);

#endif
