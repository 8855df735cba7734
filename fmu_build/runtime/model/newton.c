#include "newton.h"
#include "linear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STACK_SIZE = 12, /* systems up to this size need no allocation */
    VECTORS = 6,
    MAX_ITERATIONS = 100, /* quoted in newton_explain.c */
    MAX_HALVINGS = 30
};

/* A step this small relative to the unknown leaves an error at rounding level, due to quadratic convergence. */
static const double small_step = 1e-9;
/* The same for unknowns near zero, and their least size, both relative to the nominal value. */
static const double absolute_step = 1e-14, least_size = 1e-3;
/* Weight of the length of a step among its effects, where the Jacobian alone does not determine it. */
static const double damping = 1e-8;
/* Square of a scaled residual that is pure rounding error and cannot be reduced. */
static const double rounding_merit = 1e-31;
/* Along a Newton step the residual decreases unless it consists of rounding errors of cancelling terms. In that case,
 * the unknowns are as accurate as possible if the full step changes none of them by more than this fraction of its
 * size. */
static const double stagnant_step = 1e-6;

typedef struct {
    const NewtonSystem *system;
    double *residual, *scale, *step, *point, *nominal, *start, *matrix;
    double **unknown;
    size_t *pivot;
} Newton;

static bool evaluate(const Newton *newton)
{
    return newton->system->evaluate(newton->system->context, newton->residual);
}

/* Returns the sum of squares of the scaled residual; INFINITY if it is not finite. */
static double merit(const Newton *newton)
{
    double sum = 0.0;
    for (size_t i = 0; i < newton->system->size; ++i) {
        const double scaled = newton->residual[i] / newton->scale[i];
        sum += scaled * scaled;
    }
    return isfinite(sum) ? sum : INFINITY;
}

/* Returns the size of an unknown; near zero, a fraction of its nominal value. */
static double size_of(const Newton *newton, size_t i, double value)
{
    return fmax(fabs(value), least_size * newton->nominal[i]);
}

/* Factors the Jacobian. The scale of a row is its largest change when one unknown changes by its own size. */
static NewtonResult linearize(const Newton *newton)
{
    const size_t n = newton->system->size;
    if (!newton->system->linearize(newton->system->context, newton->residual, newton->matrix))
        return NEWTON_NOT_FINITE;
    for (size_t i = 0; i < n; ++i) {
        double largest = 0.0;
        for (size_t j = 0; j < n; ++j) {
            const double size = size_of(newton, j, *newton->unknown[j]);
            const double entry = fabs(newton->matrix[i * n + j]);
            if (!isfinite(entry))
                return NEWTON_NOT_FINITE;
            largest = fmax(largest, entry * size);
        }
        if (largest == 0.0)
            return NEWTON_SINGULAR;
        newton->scale[i] = largest;
    }
    return lu_factor(n, newton->matrix, newton->pivot) ? NEWTON_SOLVED : NEWTON_SINGULAR;
}

/* Computes the damped least-squares step of Levenberg and Marquardt, which leaves alone what the Jacobian says nothing
 * about, where the Jacobian is singular because no unknown has an effect on some equation yet, as on p*s = 6 at zero.
 * Otherwise, rounding errors could decide between several solutions. `normal` has room for a second matrix. */
static bool find_damped_step(const Newton *newton, double *normal)
{
    const size_t n = newton->system->size;
    double *jacobian = newton->matrix, largest = 0.0;
    bool is_idle = false;
    if (!newton->system->linearize(newton->system->context, newton->residual, jacobian))
        return false;
    for (size_t i = 0; i < n; ++i) {
        newton->point[i] = *newton->unknown[i];
        newton->scale[i] = 0.0;
        for (size_t j = 0; j < n; ++j) {
            jacobian[i * n + j] *= size_of(newton, j, *newton->unknown[j]);
            newton->scale[i] = fmax(newton->scale[i], fabs(jacobian[i * n + j]));
        }
        if (newton->scale[i] == 0.0) {
            newton->scale[i] = fmax(fabs(newton->residual[i]), 1.0);
            is_idle = true;
        }
    }
    for (size_t j = 0; j < n; ++j) {
        newton->step[j] = 0.0;
        for (size_t k = 0; k < n; ++k)
            normal[j * n + k] = 0.0;
        for (size_t i = 0; i < n; ++i) {
            const double entry = jacobian[i * n + j] / newton->scale[i] / newton->scale[i];
            newton->step[j] += entry * newton->residual[i];
            for (size_t k = 0; k < n; ++k)
                normal[j * n + k] += entry * jacobian[i * n + k];
        }
        largest = fmax(largest, normal[j * n + j]);
    }
    for (size_t j = 0; j < n; ++j)
        normal[j * n + j] += damping * largest;
    if (!is_idle || !(largest > 0.0) || !lu_factor(n, normal, newton->pivot))
        return false;
    lu_solve(n, normal, newton->pivot, newton->step);
    for (size_t j = 0; j < n; ++j)
        newton->step[j] *= size_of(newton, j, newton->point[j]);
    return true;
}

static bool step_is_small(const Newton *newton)
{
    for (size_t i = 0; i < newton->system->size; ++i)
        if (!(fabs(newton->step[i]) <= small_step * fabs(newton->point[i]) + absolute_step * newton->nominal[i]))
            return false;
    return true;
}

static bool step_is_stagnant(const Newton *newton)
{
    for (size_t i = 0; i < newton->system->size; ++i)
        if (!(fabs(newton->step[i]) <= stagnant_step * size_of(newton, i, newton->point[i])))
            return false;
    return true;
}

static void move(const Newton *newton, double fraction)
{
    for (size_t i = 0; i < newton->system->size; ++i)
        *newton->unknown[i] = newton->point[i] - fraction * newton->step[i];
}

/* Computes the Newton step from the present unknowns. */
static void find_step(const Newton *newton)
{
    const size_t n = newton->system->size;
    for (size_t i = 0; i < n; ++i)
        newton->point[i] = *newton->unknown[i];
    memcpy(newton->step, newton->residual, n * sizeof(double));
    lu_solve(n, newton->matrix, newton->pivot, newton->step);
}

/* Halves the step until the residual decreases. */
static bool search_along_step(const Newton *newton, double before)
{
    double fraction = 1.0;
    for (int halving = 0; halving < MAX_HALVINGS; ++halving, fraction *= 0.5) {
        move(newton, fraction);
        if (evaluate(newton) && merit(newton) <= before * (1.0 - 1e-4 * fraction))
            return true;
    }
    move(newton, 0.0);
    return false;
}

/* Moves the guesses from where the Jacobian is singular; returns whether this reduces the residual. */
static bool leave_singular_point(const Newton *newton)
{
    const size_t n = newton->system->size;
    double *normal = newton->system->guessed ? malloc(n * n * sizeof(double)) : NULL;
    if (normal == NULL)
        return false;
    bool moved = find_damped_step(newton, normal) && !step_is_small(newton);
    free(normal);
    if (moved) {
        const double before = merit(newton);
        moved = before < INFINITY && search_along_step(newton, before);
    }
    return moved;
}

/* A solution must not change when it is solved for again: relations that depend on it then have the same bits before
 * and after an event, which would otherwise be detected again and again. */
static bool is_solved(const Newton *newton)
{
    return merit(newton) <= rounding_merit * (double)newton->system->size;
}

/* Takes one step, and a second one that removes the rounding error of the first. */
static NewtonResult solve_linear(const Newton *newton)
{
    NewtonResult result = linearize(newton);
    for (int i = 0; i < 2 && result == NEWTON_SOLVED && !is_solved(newton); ++i) {
        find_step(newton);
        move(newton, 1.0);
        if (!evaluate(newton) || merit(newton) == INFINITY)
            result = NEWTON_NOT_FINITE;
    }
    return result;
}

static NewtonResult iterate(const Newton *newton)
{
    if (!evaluate(newton))
        return NEWTON_NOT_FINITE;
    if (newton->system->linear)
        return solve_linear(newton);
    for (int iteration = 0; iteration < MAX_ITERATIONS; ++iteration) {
        const NewtonResult linearized = linearize(newton);
        if (linearized == NEWTON_SINGULAR && leave_singular_point(newton))
            continue;
        if (linearized != NEWTON_SOLVED)
            return linearized;
        const double before = merit(newton);
        if (before == INFINITY)
            return NEWTON_NOT_FINITE;
        if (is_solved(newton))
            return NEWTON_SOLVED;
        find_step(newton);
        if (step_is_small(newton)) {
            move(newton, 1.0);
            return NEWTON_SOLVED;
        }
        if (!search_along_step(newton, before))
            return step_is_stagnant(newton) ? NEWTON_SOLVED : NEWTON_STUCK;
    }
    return NEWTON_ENDLESS;
}

static NewtonResult solve_in(Newton *newton)
{
    const NewtonSystem *system = newton->system;
    for (size_t i = 0; i < system->size; ++i) {
        newton->unknown[i] = system->unknown(system->context, i);
        newton->nominal[i] = system->nominal(system->context, i);
        newton->start[i] = *newton->unknown[i];
    }
    const NewtonResult result = iterate(newton);
    for (size_t i = 0; result != NEWTON_SOLVED && i < system->size; ++i)
        *newton->unknown[i] = newton->start[i];
    return result;
}

NewtonResult newton_solve(const NewtonSystem *system)
{
    const size_t n = system->size;
    double stack[STACK_SIZE * (STACK_SIZE + VECTORS)], *stack_unknown[STACK_SIZE];
    size_t stack_pivot[STACK_SIZE];
    double *work = stack, *heap = NULL, **unknown = stack_unknown;
    size_t *pivot = stack_pivot;
    if (n > STACK_SIZE) {
        const size_t n_doubles = n * (n + VECTORS);
        heap = malloc(n_doubles * sizeof(double) + n * (sizeof(double *) + sizeof(size_t)));
        if (heap == NULL)
            return NEWTON_NO_MEMORY;
        work = heap;
        unknown = (double **)(heap + n_doubles);
        pivot = (size_t *)(unknown + n);
    }
    Newton newton = {.system = system, .residual = work, .scale = work + n, .step = work + 2 * n,
                     .point = work + 3 * n, .nominal = work + 4 * n, .start = work + 5 * n,
                     .matrix = work + VECTORS * n, .unknown = unknown, .pivot = pivot};
    const NewtonResult result = solve_in(&newton);
    free(heap);
    return result;
}
