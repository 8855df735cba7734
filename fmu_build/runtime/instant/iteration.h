/* iteration.h - one pass of the event iteration over relations, discrete equations and when-clauses. */
#ifndef ITERATION_H
#define ITERATION_H

#include "events.h"
#include "newton.h"

typedef struct {
    double *memory;  /* holds the arrays below */
    double *root;    /* [n_roots + n_time_relations] */
    double *before;  /* [n_roots + n_time_relations] the roots of the round before */
    double *largest; /* [n_roots + n_time_relations] the largest absolute values of the roots while nothing settled */
    double *value;   /* [n_discrete] */
    bool *active;    /* [n_actions] */
    bool *at_zero;   /* [n_relations] whether the root of the relation counts as zero for now */
    bool *held;      /* [n_relations] the relations at the start of the pass */
    bool *circling;  /* [n_relations] whether the relation or its root changed while nothing settled */
    bool any_at_zero;
    char text[NEWTON_TEXT_SIZE]; /* the message of a failure */
} Iteration;

bool iteration_create(Iteration *iteration);
void iteration_free(Iteration *iteration);

/* p[slot of pre(v)] = v for all v; returns whether any of them changed. */
bool iteration_copy_pre(Values *values);

/* Updates relations and discrete equations until none of them changes; pre() values, condition memories and states are
 * constant. Returns NULL on success, else a description of the failure. */
const char *iteration_settle(Iteration *iteration, Values *values);

/* To be called before anything has changed. Where a relation is about to become true although its opposite was true,
 * their root passes through zero: for now it counts as zero, for all relations of this root, so that both are false.
 * Roots that jump later are never zero. iteration_leave_zero ends this, and returns whether a relation now changes. */
void iteration_stop_at_zero(Iteration *iteration, Values *values);
bool iteration_leave_zero(Iteration *iteration);

/* Sets the condition memories from the settled pass; returns whether any of them changed. */
bool iteration_commit_conditions(const Iteration *iteration, Values *values);

/* Sets every condition memory to true, so that no when-clause sees an edge. */
void iteration_hold_conditions(Values *values);

/* Expects condition memories computed with initial() = false and compares them with initial() = true: only conditions
 * that become true by this get an edge. */
void iteration_arm_initial_conditions(const Iteration *iteration, Values *values);

/* Carries out the reinit()s of the settled pass; returns whether a state changed. */
bool iteration_commit_states(const Iteration *iteration, Values *values);

#endif
