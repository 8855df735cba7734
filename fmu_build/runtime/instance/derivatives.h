/* derivatives.h - how computed variables ("unknowns") move with states, inputs, parameters and time ("knowns").
 *
 * The derivatives are exact in the present branch: relations keep their values, as do discrete variables that only
 * events change. In Initialization Mode they are those of the initial values, through start values and initial
 * equations. Nothing of the instance changes. */
#ifndef DERIVATIVES_H
#define DERIVATIVES_H

#include "instance.h"

/* The matrix J of d unknown / d known, by value references. */
typedef struct {
    const unsigned *unknowns;
    size_t n_unknowns;
    const unsigned *knowns;
    size_t n_knowns;
} Partials;

/* Both return false, after a message, where a variable cannot be an unknown or a known now, or where there is no
 * derivative. */

/* sensitivity[n_unknowns] = J seed[n_knowns] */
bool derivatives_directional(Instance *instance, const Partials *partials, const double *seed, double *sensitivity);

/* sensitivity[n_knowns] = transposed J seed[n_unknowns]: column by column, at the cost of n_knowns directional
 * derivatives. */
bool derivatives_adjoint(Instance *instance, const Partials *partials, const double *seed, double *sensitivity);

#endif
