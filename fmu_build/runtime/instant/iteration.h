/* iteration.h - one pass of the event iteration: what relations, discrete equations and when-clauses do together. */
#ifndef ITERATION_H
#define ITERATION_H

#include "events.h"
#include "newton.h"

typedef struct {
    double *memory; /* holds the arrays below */
    double *root;   /* [n_roots + n_time_relations] */
    double *value;  /* [n_discrete] */
    bool *active;   /* [n_actions] */
    bool *stopped;  /* [n_relations] those that stay false for now */
    bool any_stopped;
    char text[NEWTON_TEXT_SIZE]; /* of a message about what went wrong */
} Iteration;

bool iteration_create(Iteration *iteration);
void iteration_free(Iteration *iteration);

/* p[slot of pre(v)] = v for all v; true where one of them was different. */
bool iteration_copy_pre(Values *values);

/* Relations and discrete equations, again and again until none of them changes; pre() values, condition memories
 * and states stay. NULL on success, else what went wrong. */
const char *iteration_settle(Iteration *iteration, Values *values);

/* From now on no relation becomes true whose opposite is true: in between, their root is zero and both are false.
 * iteration_leave_zero ends that, and returns whether there is a relation that becomes true now. */
void iteration_stop_at_zero(Iteration *iteration, const Values *values);
bool iteration_leave_zero(Iteration *iteration);

/* Sets condition memories from the pass that has settled; true where one was different. */
bool iteration_commit_conditions(const Iteration *iteration, Values *values);

/* Makes every condition memory true, so that no when-clause sees an edge. */
void iteration_hold_conditions(Values *values);

/* With the memories as they are without initial(), and initial() true now: only the conditions that this makes true
 * will have an edge. */
void iteration_arm_initial_conditions(const Iteration *iteration, Values *values);

/* Carries out the reinit()s of the pass that has settled; true where a state changed. */
bool iteration_commit_states(const Iteration *iteration, Values *values);

#endif
