/* inputs.h - continuous inputs that change during a communication step: on straight lines (FMI 2), or as the importer
 * says when it is asked (FMI 3). */
#ifndef INPUTS_H
#define INPUTS_H

#include "cold.h"
#include "model.h"

typedef struct {
    size_t count;  /* continuous Real inputs */
    size_t *index; /* [count] their places in p */
    double *base;  /* [count] values at `since` */
    double *slope; /* [count] derivatives with respect to time */
    double since;
    bool active; /* some slope is not zero, or the importer is asked */
    void (*ask)(void *context, double time); /* has the importer set its inputs for a time; NULL where it does not */
    void *context;
} Inputs;

size_t inputs_of_model(size_t *index); /* how many there are, and into `index` (if not NULL) which */

/* Gives one input its derivative for the coming communication step; false where p[index] is no such input. */
bool inputs_set_slope(Inputs *inputs, size_t index, double slope);

/* The lines start from the values in p at this time; nothing happens where every slope is zero and nobody is asked. */
void inputs_begin(Inputs *inputs, double time, const double *p);
/* From here on the inputs stay at what they are. */
void inputs_end(Inputs *inputs);

/* Those that are not at rest. */
COLD void inputs_move(const Inputs *inputs, double time, double *p);

static inline void inputs_apply(const Inputs *inputs, double time, double *p)
{
    if (inputs->active)
        inputs_move(inputs, time, p);
}

#endif
