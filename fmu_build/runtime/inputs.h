/* inputs.h - continuous inputs that follow a straight line during a communication step. */
#ifndef INPUTS_H
#define INPUTS_H

#include "model.h"

typedef struct {
    size_t count;  /* continuous Real inputs */
    size_t *index; /* [count] their places in p */
    double *base;  /* [count] values at `since` */
    double *slope; /* [count] derivatives with respect to time */
    double since;
    bool active; /* some slope is not zero */
} Inputs;

size_t inputs_of_model(size_t *index); /* how many there are, and into `index` (if not NULL) which */

/* Gives one input its derivative for the coming communication step; false where p[index] is no such input. */
bool inputs_set_slope(Inputs *inputs, size_t index, double slope);

/* The lines start from the values in p at this time; nothing happens where every slope is zero. */
void inputs_begin(Inputs *inputs, double time, const double *p);
/* From here on the inputs stay at what they are. */
void inputs_end(Inputs *inputs);

static inline void inputs_apply(const Inputs *inputs, double time, double *p)
{
    if (!inputs->active)
        return;
    for (size_t i = 0; i < inputs->count; ++i)
        p[inputs->index[i]] = inputs->base[i] + inputs->slope[i] * (time - inputs->since);
}

#endif
