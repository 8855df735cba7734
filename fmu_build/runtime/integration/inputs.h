/* inputs.h - continuous inputs that change during a communication step: linearly (FMI 2), or as set by the importer on
 * request (FMI 3). */
#ifndef INPUTS_H
#define INPUTS_H

#include "cold.h"
#include "model.h"

typedef struct {
    size_t count;  /* continuous Real inputs */
    size_t *index; /* [count] their slots in p */
    double *base;  /* [count] values at `since` */
    double *slope; /* [count] derivatives with respect to time */
    double since;
    bool active; /* some slope is not zero, or `ask` is set */
    void (*ask)(void *context, double time); /* lets the importer set its inputs for a time; NULL if it does not */
    void *context;
} Inputs;

size_t inputs_of_model(size_t *index); /* returns their number; stores their slots in `index` unless it is NULL */

/* Sets the derivative of the input p[index] for the next communication step. */
void inputs_set_slope(Inputs *inputs, size_t index, double slope);

/* Starts the lines at the values in p at this time; does nothing if all slopes are zero and `ask` is NULL. */
void inputs_begin(Inputs *inputs, double time, const double *p);
/* Holds the inputs at their present values from now on. */
void inputs_end(Inputs *inputs);

/* Moves the inputs; call it only if they are active. */
COLD void inputs_move(const Inputs *inputs, double time, double *p);

static inline void inputs_apply(const Inputs *inputs, double time, double *p)
{
    if (inputs->active)
        inputs_move(inputs, time, p);
}

#endif
