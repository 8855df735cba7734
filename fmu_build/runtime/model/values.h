/* values.h - the numbers of one instance and nothing else: plain data that can be copied and serialized. */
#ifndef VALUES_H
#define VALUES_H

#include "model.h"

typedef struct {
    double time;
    double *y;          /* [model.n_y] */
    double *p;          /* [model.n_p] */
    double *clock_tick; /* [model.n_clocks] number of the next tick of each periodic clock */
    double *clock_zero; /* [model.n_clocks] time from which its phase counts */
    double *reported;   /* [model.n_actions] 1 if a warning was reported and its condition still holds */
    double *any_reported;
} Values;

/* One block of values_count() doubles holds all arrays; values_bind points the arrays into it. */
size_t values_count(void);
void values_bind(Values *values, double *block);
void values_reset(Values *values); /* start values of the model, time 0; the block must be zero */

#endif
