/* location.h - when the first relation changes within an integration step. */
#ifndef LOCATION_H
#define LOCATION_H

#include "model.h"

typedef struct {
    void *context;
    double *start;   /* [n_roots] at the start of the step, kept from step to step */
    double *sample;  /* [n_roots] at SAMPLE_FRACTION of it, nearly */
    double *end;     /* [n_roots] at its end */
    double *agrees;  /* [1] 1 where `start` is known to agree with the memories of the relations, else 0 */
    double *work[3]; /* [n_roots] each */
} RootFinder;

typedef enum { ROOTS_NOT_CROSSED, ROOTS_CROSSED, ROOTS_NOT_COMPUTABLE } RootResult;

typedef struct {
    RootResult result;
    double time;     /* just after the crossing: the relation has changed there */
    size_t relation; /* that changed, one of them where several did */
} Crossing;

size_t roots_count(void); /* doubles in the block */
void roots_bind(RootFinder *finder, double *block);

/* root[0..model.n_roots) at a time within the step, which the user of the search supplies; false where they cannot
 * be computed. */
bool roots_evaluate(void *context, double time, double *root);

/* Position of the first relation whose memory in p disagrees with the roots, or model.n_relations. */
size_t roots_first_changed(const double *root, const double *p);

/* The first crossing in the step from `from` to `to`, whose relations all had the side that their memories
 * in p tell: a change between start and end, or there and back within the step. Looks at `start`, `sample` and `end`,
 * which whoever takes the step fills; where nothing was crossed, `end` becomes the next step's `start`. */
Crossing roots_search(RootFinder *finder, const double *p, double from, double to);

#endif
