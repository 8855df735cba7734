/* growth.c - der(x) = rate*x^power; terminate() at x > end, a warning at x > warning, an assertion x < limit that is
 * tied to no event. power = 2 grows to infinity in finite time. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>
#include <stdio.h>

enum { X, N_Y };
enum { RATE, POWER, END, WARNING, LIMIT, ENDED, WARNED, N_P };

static const double y_start[N_Y] = {1.0},
                    p_start[N_P] = {[RATE] = 1.0, [POWER] = 1.0, [END] = 1e300, [WARNING] = 1e300, [LIMIT] = 1e300},
                    state_nominal[] = {1.0};
static const Variable variables[] = {STATE("x", X), PARAMETER("rate", RATE, ANY),
                                     PARAMETER("power", POWER, ANY), PARAMETER("end", END, ANY),
                                     PARAMETER("warning", WARNING, ANY),
                                     PARAMETER("limit", LIMIT, ANY)};
static const Relation relations[] = {{0, ENDED, false}, {1, WARNED, false}};
static const ActionKind actions[] = {ACTION_TERMINATE, ACTION_WARNING, ACTION_ERROR};

static const char *const root_texts[] = {"end - x", "warning - x"};

const Model model = {
    TABLES("Test.Growth"),
    ROOTS_AND_RELATIONS,
    .n_actions = 3,
    .actions = actions,
    .actions_follow_states = true,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[X] = p[RATE] * pow(y[X], p[POWER]);
    return root == NULL || model_roots(time, y, p, root);
}

bool model_roots(double time, double *y, const double *p, double *root)
{
    (void)time;
    root[0] = p[END] - y[X];
    root[1] = p[WARNING] - y[X];
    return true;
}

bool model_watched_actions(double time, double *y, const double *p, bool *due)
{
    (void)time;
    *due = !(y[X] < p[LIMIT]);
    return true;
}

void model_actions(double time, const double *y, const double *p, bool *active)
{
    (void)time;
    active[0] = p[ENDED] != 0.0;
    active[1] = p[WARNED] != 0.0;
    active[2] = !(y[X] < p[LIMIT]);
}

void model_action_message(size_t action, double time, const double *y, const double *p, char *text, size_t size)
{
    static const char *const what[] = {"x is large enough", "x grows 100% faster than #wanted#",
                                       "x is above its limit"};
    (void)time, (void)p;
    snprintf(text, size, "%s: %g", what[action], y[X]);
}

NO_ALGEBRAICS
NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_DISCRETE_EQUATIONS
NO_TANGENTS
