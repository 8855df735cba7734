/* windows.c - der(x) = 1; `inside` is 1/width while |x - centre| < width/2, so that `area` becomes 1; and `after`
 * counts the time since x > centre, which two relations of opposite sense tell. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>

enum { X, AREA, AFTER, N_Y };
enum { CENTRE, WIDTH, INSIDE, PAST, NOT_PAST, N_P };

static const double y_start[N_Y] = {0}, p_start[N_P] = {[CENTRE] = 1.0, [WIDTH] = 1e-3},
                    state_nominal[] = {1.0, 1.0, 1.0};
static const Variable variables[] = {STATE("x", X), STATE("area", AREA), STATE("after", AFTER),
                                     PARAMETER("centre", CENTRE, ANY),
                                     PARAMETER("width", WIDTH, 0.0, INFINITY)};
static const Relation relations[] = {{0, INSIDE, false}, {1, PAST, false}, {2, NOT_PAST, true}};

static const char *const root_texts[] = {"sinh(distance)^2 - sinh(width/2)^2", "-distance", "distance"};

const Model model = {
    TABLES("Test.Windows"),
    ROOTS_AND_RELATIONS,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[X] = 1.0;
    der[AREA] = p[INSIDE] != 0.0 ? 1.0 / p[WIDTH] : 0.0;
    der[AFTER] = p[PAST] != 0.0 && p[NOT_PAST] == 0.0 ? 1.0 : 0.0;
    return root == NULL || model_roots(time, y, p, root);
}

bool model_roots(double time, double *y, const double *p, double *root)
{
    (void)time;
    const double distance = y[X] - p[CENTRE];
    root[0] = sinh(distance) * sinh(distance) - sinh(0.5 * p[WIDTH]) * sinh(0.5 * p[WIDTH]);
    root[1] = -distance;
    root[2] = distance;
    return true;
}

NO_ALGEBRAICS
NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_DISCRETE_EQUATIONS
NO_ACTIONS
NO_TANGENTS
