/* lag.c - tau*der(x) = u - x, with variables of every type, kind and range, and a relation on the input. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>

enum { X, Y, N_Y };
enum { U, GEAR, ON, TAU, GAIN, HALF, HIGH, LAST_GEAR, MODE, N_P };

static const double y_start[N_Y] = {0}, p_start[N_P] = {[GEAR] = 1.0, [TAU] = 0.5, [GAIN] = 3.0, [HALF] = 0.25, [MODE] = 2.0},
                    state_nominal[] = {1.0};
static const Variable variables[] = {
    TIME,
    STATE("x", X),
    DERIVATIVE("der(x)", X),
    OUTPUT("y", Y),
    INPUT("u", U, -10.0, 10.0),
    {"gear", TYPE_INTEGER, STORE_PARAMETER, GEAR, CAUSALITY_INPUT, VARIABILITY_DISCRETE, INITIAL_NONE, 1.0, 3.0},
    {"on", TYPE_BOOLEAN, STORE_PARAMETER, ON, CAUSALITY_INPUT, VARIABILITY_DISCRETE, INITIAL_NONE, 0.0, 1.0},
    PARAMETER("tau", TAU, 1e-3, 1e3),
    {"gain", TYPE_REAL, STORE_PARAMETER, GAIN, CAUSALITY_PARAMETER, VARIABILITY_FIXED, INITIAL_EXACT, ANY},
    {"half", TYPE_REAL, STORE_PARAMETER, HALF, CAUSALITY_CALCULATED_PARAMETER, VARIABILITY_TUNABLE,
     INITIAL_CALCULATED, ANY},
    {"high", TYPE_BOOLEAN, STORE_PARAMETER, HIGH, CAUSALITY_OUTPUT, VARIABILITY_DISCRETE, INITIAL_CALCULATED,
     0.0, 1.0},
    {"lastGear", TYPE_INTEGER, STORE_PARAMETER, LAST_GEAR, CAUSALITY_OUTPUT, VARIABILITY_DISCRETE, INITIAL_CALCULATED,
     ANY},
    {"mode", TYPE_ENUMERATION, STORE_PARAMETER, MODE, CAUSALITY_PARAMETER, VARIABILITY_FIXED, INITIAL_EXACT, 1.0, 2.0},
};
static const Relation relations[] = {{0, HIGH, false}};
static const DiscreteTarget discrete[] = {{DISCRETE_ASSIGN, STORE_PARAMETER, LAST_GEAR}};

static const char *const root_texts[] = {"1.5 - u"};

const Model model = {
    TABLES("Test.Lag"),
    ROOTS_AND_RELATIONS,
    .n_discrete = 1,
    .discrete = discrete,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[X] = (p[U] - y[X]) / p[TAU];
    return root == NULL || model_roots(time, y, p, root);
}

bool model_algebraics(double time, double *y, const double *p)
{
    (void)time;
    y[Y] = p[GAIN] * y[X] + p[GEAR] + p[U];
    return true;
}

bool model_roots(double time, double *y, const double *p, double *root)
{
    (void)time, (void)y;
    root[0] = 1.5 - p[U];
    return true;
}

void model_dependent_parameters(double *p)
{
    p[HALF] = 0.5 * p[TAU];
}

void model_discrete(double time, const double *y, const double *p, double *value)
{
    (void)time, (void)y;
    value[0] = p[GEAR];
}

NO_TIME_RELATIONS
NO_INITIAL_EQUATIONS
NO_ACTIONS
NO_TANGENTS
