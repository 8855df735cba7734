/* time_events.h - events whose time is known in advance: ticks of periodic clocks and relations in time. */
#ifndef TIME_EVENTS_H
#define TIME_EVENTS_H

#include "values.h"

/* Returns by how much times that are practically equal differ at most: importers add up step sizes, so that rounding
 * moves their points away from the intended times. */
double instant_at(double time);

/* Returns a time just after a time event at `time`, at which both "time > t" and "time >= t" are true even if the
 * importer's own time, a sum of step sizes, is too small by a rounding error. */
double time_just_after(double time);

/* Skips the ticks of all clocks before values->time. */
void clocks_start(Values *values);

/* p[activation] = 1 for each clock with a tick at values->time, and advances it; returns false if no clock ticks. */
bool clocks_tick(Values *values);

/* p[activation] = 0 for all clocks. */
void clocks_release(Values *values);

#endif
