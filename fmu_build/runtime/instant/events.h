/* events.h - what happens at one instant: initialisation, event iteration, time events, asserts. */
#ifndef EVENTS_H
#define EVENTS_H

#include "values.h"

typedef enum { EVENT_OK, EVENT_ERROR, EVENT_TERMINATE } EventStatus;

/* Told of asserts, warnings, terminate() and of iterations that do not come to an end. */
typedef struct {
    void *context;
    void (*report)(void *context, ActionKind kind, const char *message);
} EventReporter;

/* Solves the initial equations, settles the discrete variables at values->time and carries out the events that
 * are due then. */
EventStatus event_initialize(Values *values, const EventReporter *reporter);

/* Carries out the event at values->time, to its end: clock ticks and time events that are due, relations,
 * when-clauses, asserts. `continuous`: nothing has jumped since the event before, so that what went from one side of
 * zero to the other was zero on the way. *states_changed is set where a reinit() changed a state. */
EventStatus event_update(Values *values, bool continuous, const EventReporter *reporter, bool *states_changed);

/* The next time event after values->time, +INFINITY for none. */
double event_next_time(const Values *values);

/* Asserts and warnings that are not tied to an event; to be called after every completed integrator step. */
EventStatus event_check_asserts(Values *values, const EventReporter *reporter);

#endif
