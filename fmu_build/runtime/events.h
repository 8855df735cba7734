/* events.h - what happens at one instant: initialisation, event iteration, time events, asserts. */
#ifndef EVENTS_H
#define EVENTS_H

#include "values.h"

typedef enum { EVENT_OK, EVENT_ERROR, EVENT_TERMINATE } EventStatus;

/* Told of asserts, warnings and failures; category is one of FMI 2's standard log categories. */
typedef struct {
    void *context;
    void (*report)(void *context, ActionKind kind, const char *message);
} EventReporter;

/* Solves the initial equations and settles the discrete variables at values->time. */
EventStatus event_initialize(Values *values, const EventReporter *reporter);

/* Carries out the event at values->time: clock ticks and time events that are due, relations, when-clauses.
 * *states_changed is set where a reinit() changed a state; *again where another event follows at this instant. */
EventStatus event_update(Values *values, const EventReporter *reporter, bool *states_changed);

/* The next time event after values->time, +INFINITY for none. */
double event_next_time(const Values *values);

/* Asserts that are not tied to an event; to be called after every completed integrator step. */
EventStatus event_check_asserts(const Values *values, const EventReporter *reporter);

#endif
