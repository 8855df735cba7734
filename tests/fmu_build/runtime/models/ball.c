/* ball.c - a ball that falls from height h and jumps back with e times the speed: reinit() at a state event. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>

enum { H, V, N_Y };
enum { G, E, BELOW, HIT, BOUNCES, PRE_BOUNCES, N_P };

static const double y_start[N_Y] = {[H] = 1.0}, p_start[N_P] = {[G] = 10.0, [E] = 0.5}, state_nominal[] = {1.0, 1.0};
static const Variable variables[] = {STATE("h", H), STATE("v", V), DISCRETE("bounces", BOUNCES),
                                     PARAMETER("g", G, 0.0, INFINITY), PARAMETER("e", E, 0.0, 1.0)};
static const Relation relations[] = {{0, BELOW, false}};
static const PreBinding pre[] = {{PRE_BOUNCES, STORE_PARAMETER, BOUNCES}};
static const DiscreteTarget discrete[] = {{DISCRETE_CONDITION, STORE_PARAMETER, HIT},
                                          {DISCRETE_REINIT, STORE_STATE_OR_ALGEBRAIC, V},
                                          {DISCRETE_ASSIGN, STORE_PARAMETER, BOUNCES}};

static const char *const root_texts[] = {"h"};

const Model model = {
    TABLES("Test.Ball"),
    ROOTS_AND_RELATIONS,
    .n_pre = 1,
    .pre = pre,
    .n_discrete = 3,
    .discrete = discrete,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[H] = y[V];
    der[V] = -p[G];
    return root == NULL || model_roots(time, y, p, root);
}

bool model_roots(double time, double *y, const double *p, double *root)
{
    (void)time, (void)p;
    root[0] = y[H];
    return true;
}

void model_discrete(double time, const double *y, const double *p, double *value)
{
    (void)time;
    const bool hit = p[BELOW] != 0.0 && p[HIT] == 0.0;
    value[0] = p[BELOW];
    value[1] = hit ? -p[E] * y[V] : y[V];
    value[2] = hit ? p[PRE_BOUNCES] + 1.0 : p[PRE_BOUNCES];
}

NO_ALGEBRAICS
NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_ACTIONS
NO_TANGENTS
