/* events.h - what happens at one instant: initialization, event iteration, time events, assertions. */
#ifndef EVENTS_H
#define EVENTS_H

#include "values.h"

typedef enum { EVENT_OK, EVENT_ERROR, EVENT_TERMINATE } EventStatus;

/* Receives assertions, warnings, terminate() and failures of the initialization or event iteration. */
typedef struct {
    void *context;
    void (*report)(void *context, ActionKind kind, const char *message);
} EventReporter;

/* Solves the initial equations, settles the discrete variables at values->time and carries out the events that are then
 * due. */
EventStatus event_initialize(Values *values, const EventReporter *reporter);

/* Carries out the whole event at values->time: due clock ticks and time events, relations, when-clauses, assertions.
 * `continuous` means that nothing has jumped since the previous event, so that a root with a changed sign was zero in
 * between. Sets *states_changed if a reinit() changed a state. */
EventStatus event_update(Values *values, bool continuous, const EventReporter *reporter, bool *states_changed);

/* Returns the time of the next time event after values->time, INFINITY for none. */
double event_next_time(const Values *values);

/* Checks assertions and warnings outside of events; to be called after every completed integrator step. */
EventStatus event_check_asserts(Values *values, const EventReporter *reporter);

#endif
