/* slide.c - der(x) = if x > 0 then -1 else 1: after x has come to zero the relation changes for ever. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>

enum { X, N_Y };
enum { POSITIVE, N_P };

static const double y_start[N_Y] = {1.0}, p_start[N_P] = {0.0}, state_nominal[] = {1.0};
static const Variable variables[] = {STATE("x", X)};
static const Relation relations[] = {{0, POSITIVE, false}};

static const char *const root_texts[] = {"-x"};

const Model model = {
    TABLES("Test.Slide"),
    ROOTS_AND_RELATIONS,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[X] = p[POSITIVE] != 0.0 ? -1.0 : 1.0;
    return root == NULL || model_roots(time, y, p, root);
}

bool model_roots(double time, double *y, const double *p, double *root)
{
    (void)time, (void)p;
    root[0] = -y[X];
    return true;
}

NO_ALGEBRAICS
NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_DISCRETE_EQUATIONS
NO_ACTIONS
NO_TANGENTS
