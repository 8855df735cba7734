/* sampler.c - der(x) = 1; every tenth of a second `held` takes the value of x and `ticks` counts. Another clock, which
 * nothing listens to, ticks once in 1000 s from the start of the simulation. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>

enum { X, N_Y };
enum { TICK, RARE_TICK, HELD, TICKS, PRE_HELD, PRE_TICKS, N_P };

static const double y_start[N_Y] = {0.0}, p_start[N_P] = {0.0}, state_nominal[] = {1.0};
static const Variable variables[] = {STATE("x", X), DISCRETE("held", HELD), DISCRETE("ticks", TICKS)};
static const PeriodicClock clocks[] = {{TICK, 1.0, 10.0, 0.0, 1.0, false}, {RARE_TICK, 1000.0, 1.0, 0.0, 1.0, true}};
static const PreBinding pre[] = {{PRE_HELD, STORE_PARAMETER, HELD}, {PRE_TICKS, STORE_PARAMETER, TICKS}};
static const DiscreteTarget discrete[] = {{DISCRETE_ASSIGN, STORE_PARAMETER, HELD},
                                          {DISCRETE_ASSIGN, STORE_PARAMETER, TICKS}};

const Model model = {
    TABLES("Test.Sampler"),
    .n_pre = 2,
    .pre = pre,
    .n_discrete = 2,
    .discrete = discrete,
    .n_clocks = 2,
    .clocks = clocks,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[X] = 1.0;
    return root == NULL || model_roots(time, y, p, root);
}

void model_discrete(double time, const double *y, const double *p, double *value)
{
    (void)time;
    value[0] = p[TICK] != 0.0 ? y[X] : p[PRE_HELD];
    value[1] = p[TICK] != 0.0 ? p[PRE_TICKS] + 1.0 : p[PRE_TICKS];
}

NO_ALGEBRAICS
NO_ROOTS
NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_ACTIONS
NO_TANGENTS
