/* location.h - locates the first zero crossing within an integration step. */
#ifndef LOCATION_H
#define LOCATION_H

#include "model.h"

typedef struct {
    void *context;
    double *start;   /* [n_roots] at the start of the step, kept from step to step */
    double *sample;  /* [n_roots] at SAMPLE_FRACTION of the step, approximately */
    double *end;     /* [n_roots] at the end of the step */
    double *agrees;  /* [1] 1 if `start` is known to agree with the memories of the relations, else 0 */
    double *work[3]; /* [n_roots] each */
} RootFinder;

typedef enum { ROOTS_NOT_CROSSED, ROOTS_CROSSED, ROOTS_NOT_COMPUTABLE } RootResult;

typedef struct {
    RootResult result;
    double time;     /* just after the crossing, where the relation has changed */
    size_t relation; /* the relation that changed, or one of several */
} Crossing;

size_t roots_count(void); /* doubles in the block */
void roots_bind(RootFinder *finder, double *block);

/* Supplied by the caller: computes root[0..model.n_roots) at a time within the step; returns false if that fails. */
bool roots_evaluate(void *context, double time, double *root);

/* Returns the position of the first relation whose memory in p disagrees with the roots, or model.n_relations. */
size_t roots_first_changed(const double *root, const double *p);

/* Returns the first crossing in the step from `from` to `to`: a relation that differs from its memory in p at the end,
 * or that changes and changes back within the step. The integrator's user fills `start`, `sample` and `end`; without a
 * crossing, `end` becomes the next step's `start`. */
Crossing roots_search(RootFinder *finder, const double *p, double from, double to);

/* Returns the crossing between two points within a step that roots_search has passed: `sample` has the roots at `to`,
 * where a relation differs from its memory in p. It may change and change back in a step that is long for the roots. */
Crossing roots_locate(RootFinder *finder, const double *p, double from, double to);

#endif
