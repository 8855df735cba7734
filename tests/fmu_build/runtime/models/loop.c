/* loop.c - der(x) = -z, where z + z^3 = x and w = x/2 + z form a system of equations that Newton's method solves; and
 * s*s = x - floor, which has no solution below the floor. */
#include "block.h"
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>

enum { X, Z, W, S, N_Y };
enum { FLOOR, N_P };

static const double y_start[N_Y] = {[X] = 2.0, [Z] = 1.0, [S] = 1.0}, p_start[N_P] = {[FLOOR] = -1e9},
                    state_nominal[] = {1.0};
static const Variable variables[] = {STATE("x", X), OUTPUT("z", Z), OUTPUT("w", W),
                                     PARAMETER("floor", FLOOR, ANY), OUTPUT("s", S), DERIVATIVE("der(x)", X)};

static void cubic_residual(double time, const double *y, const double *p, double *residual)
{
    (void)time, (void)p;
    residual[0] = y[W] - 0.5 * y[X] - y[Z];
    residual[1] = y[Z] + y[Z] * y[Z] * y[Z] - y[X];
}

static void cubic_jacobian(double time, const double *y, const double *p, double *jacobian)
{
    (void)time, (void)p;
    jacobian[0] = -1.0;
    jacobian[1] = 1.0;
    jacobian[2] = 1.0 + 3.0 * y[Z] * y[Z];
    jacobian[3] = 0.0;
}

static void root_residual(double time, const double *y, const double *p, double *residual)
{
    (void)time;
    residual[0] = y[S] * y[S] - (y[X] - p[FLOOR]);
}

static void root_jacobian(double time, const double *y, const double *p, double *jacobian)
{
    (void)time, (void)p;
    jacobian[0] = 2.0 * y[S];
}

static const BlockUnknown cubic_unknowns[] = {{Z, "z", 1.0}, {W, "w", 1.0}}, root_unknowns[] = {{S, "s", 1.0}};
static const Block cubic = {2, cubic_unknowns, false, cubic_residual, cubic_jacobian};
static const Block square_root = {1, root_unknowns, false, root_residual, root_jacobian};
static const Block *const blocks[] = {&cubic, &square_root};

const Model model = {
    TABLES("Test.Loop"),
    .n_blocks = 2,
    .blocks = blocks,
    .has_tangents = true,
    .has_initial_tangents = true,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    if (!model_algebraics(time, y, p))
        return false;
    der[X] = -y[Z];
    return root == NULL || model_roots(time, y, p, root);
}

bool model_algebraics(double time, double *y, const double *p)
{
    return block_solve(&cubic, time, y, p) && block_solve(&square_root, time, y, p);
}

NO_ROOTS
NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_DISCRETE_EQUATIONS
NO_ACTIONS

bool model_tangents(double time, const double *y, const double *p, double dtime, double *dy, double *dp, double *dder)
{
    (void)dtime;
    double cubic_moves[] = {-0.5 * dy[X], -dy[X]}, root_moves[] = {-(dy[X] - dp[FLOOR])};
    if (!block_tangents(&cubic, time, y, p, cubic_moves) || !block_tangents(&square_root, time, y, p, root_moves))
        return false;
    dy[Z] = cubic_moves[0];
    dy[W] = cubic_moves[1];
    dy[S] = root_moves[0];
    dder[X] = -dy[Z];
    return true;
}

void model_parameter_tangents(const double *p, double *dp)
{
    (void)p, (void)dp;
}

void model_start_tangents(const double *y, const double *p, double *dy, const double *dp)
{
    (void)y, (void)p, (void)dy, (void)dp;
}

void model_initial_residual_tangents(double time, const double *y, const double *p, double dtime, const double *dy,
                                     const double *dp, double *residual)
{
    (void)time, (void)y, (void)p, (void)dtime, (void)dy, (void)dp, (void)residual;
}
