/* oscillator.c - der(x) = v, der(v) = -k*x: no events at all. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>

enum { X, V, E, N_Y };
enum { K, N_P };

static const double y_start[N_Y] = {[X] = 1.0}, p_start[N_P] = {[K] = 1.0}, state_nominal[] = {1.0, 1.0};
static const Variable variables[] = {STATE("x", X), STATE("v", V), OUTPUT("E", E),
                                     PARAMETER("k", K, 0.0, 1e6)};

const Model model = {TABLES("Test.Oscillator")};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[X] = y[V];
    der[V] = -p[K] * y[X];
    return root == NULL || model_roots(time, y, p, root);
}

bool model_algebraics(double time, double *y, const double *p)
{
    (void)time;
    y[E] = 0.5 * (p[K] * y[X] * y[X] + y[V] * y[V]);
    return true;
}

NO_ROOTS
NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_DISCRETE_EQUATIONS
NO_ACTIONS
NO_TANGENTS
