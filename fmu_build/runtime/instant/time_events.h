/* time_events.h - events whose time is known beforehand: ticks of periodic clocks and relations of time. */
#ifndef TIME_EVENTS_H
#define TIME_EVENTS_H

#include "values.h"

/* The time at which a time event at `time` is past, so that "time > t" has become true as well as "time >= t", also
 * where the importer's own time, a sum of step sizes, is a rounding error short of it. */
double time_just_after(double time);

/* Skips the ticks of all clocks before values->time. */
void clocks_start(Values *values);

/* p[activation] = 1 for each clock with a tick at values->time, whose next tick then follows; false where none has. */
bool clocks_tick(Values *values);

/* p[activation] = 0 for all clocks. */
void clocks_release(Values *values);

#endif
