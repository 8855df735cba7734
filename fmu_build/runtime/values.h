/* values.h - the numbers of one instance, and nothing else: plain data that can be copied and serialised. */
#ifndef VALUES_H
#define VALUES_H

#include "model.h"

typedef struct {
    double time;
    double *y;              /* [model.n_y] */
    double *p;              /* [model.n_p] */
    double *clock_tick;     /* [model.n_clocks] number of the next tick of each periodic clock */
} Values;

/* One allocation of values_size() bytes holds all arrays; values_bind points the arrays into it. */
size_t values_count(void);                      /* doubles in the block */
void values_bind(Values *values, double *block);
void values_reset(Values *values);              /* start values of the model, time 0 */

#endif
