/* derivatives.h - partial derivatives of computed variables ("unknowns") with respect to states, inputs, parameters and
 * time ("knowns").
 *
 * The derivatives are exact within the active branch: relations, and discrete variables that only events change, are
 * constant. In Initialization Mode they are derivatives of the initial values, through start values and initial
 * equations. Values that the importer reads do not change. */
#ifndef DERIVATIVES_H
#define DERIVATIVES_H

#include "instance.h"

/* The Jacobian J = d unknown / d known, by value references. */
typedef struct {
    const unsigned *unknowns;
    size_t n_unknowns;
    const unsigned *knowns;
    size_t n_knowns;
} Partials;

/* Both return false, after a message, if a variable cannot be an unknown or a known in this phase, or if there is no
 * derivative. */

/* sensitivity[n_unknowns] = J seed[n_knowns] */
bool derivatives_directional(Instance *instance, const Partials *partials, const double *seed, double *sensitivity);

/* sensitivity[n_knowns] = transposed J seed[n_unknowns], assembled column by column at the cost of n_knowns
 * directional derivatives. */
bool derivatives_adjoint(Instance *instance, const Partials *partials, const double *seed, double *sensitivity);

#endif
