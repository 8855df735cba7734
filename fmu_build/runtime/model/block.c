#include "block.h"
#include "linear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STACK_SIZE = 12, /* systems up to this size need no allocation */
    MAX_ITERATIONS = 60,
    MAX_HALVINGS = 20
};

/* A step this small relative to the unknown leaves, after quadratic convergence, an error at rounding. */
static const double small_step = 1e-9;
static const double absolute_step = 1e-14;
/* Square of a scaled residual that is rounding error alone: nothing is left to improve. */
static const double rounding_merit = 1e-31;

typedef struct {
    const Block *block;
    double time;
    double *y;
    const double *p;
    double *residual, *scale, *step, *point, *matrix;
    size_t *pivot;
} Newton;

static void evaluate(const Newton *newton)
{
    newton->block->residual(newton->time, newton->y, newton->p, newton->residual);
}

/* Sum of squares of the scaled residual; NaN and infinity count as infinitely bad. */
static double merit(const Newton *newton)
{
    double sum = 0.0;
    for (size_t i = 0; i < newton->block->size; ++i) {
        const double scaled = newton->residual[i] / newton->scale[i];
        sum += scaled * scaled;
    }
    return isfinite(sum) ? sum : INFINITY;
}

/* Rows are scaled by what a change of the unknowns of their own size does to them. */
static bool linearize(Newton *newton)
{
    const size_t n = newton->block->size;
    newton->block->jacobian(newton->time, newton->y, newton->p, newton->matrix);
    for (size_t i = 0; i < n; ++i) {
        double largest = 0.0;
        for (size_t j = 0; j < n; ++j) {
            const double size = fmax(fabs(newton->y[newton->block->unknowns[j]]), 1e-3);
            const double entry = fabs(newton->matrix[i * n + j]);
            if (!isfinite(entry))
                return false;
            largest = fmax(largest, entry * size);
        }
        if (largest == 0.0)
            return false;
        newton->scale[i] = largest;
    }
    return lu_factor(n, newton->matrix, newton->pivot);
}

static bool step_is_small(const Newton *newton)
{
    for (size_t i = 0; i < newton->block->size; ++i)
        if (!(fabs(newton->step[i]) <= small_step * fabs(newton->point[i]) + absolute_step))
            return false;
    return true;
}

static void move(const Newton *newton, double fraction)
{
    for (size_t i = 0; i < newton->block->size; ++i)
        newton->y[newton->block->unknowns[i]] = newton->point[i] - fraction * newton->step[i];
}

/* Halves the step until the residual falls. */
static bool search_along_step(const Newton *newton, double before)
{
    double fraction = 1.0;
    for (int halving = 0; halving < MAX_HALVINGS; ++halving, fraction *= 0.5) {
        move(newton, fraction);
        evaluate(newton);
        if (merit(newton) <= before * (1.0 - 1e-4 * fraction))
            return true;
    }
    return false;
}

static bool iterate(Newton *newton)
{
    const size_t n = newton->block->size;
    evaluate(newton);
    for (int iteration = 0; iteration < MAX_ITERATIONS; ++iteration) {
        for (size_t i = 0; i < n; ++i)
            newton->point[i] = newton->y[newton->block->unknowns[i]];
        if (!linearize(newton))
            return false;
        const double before = merit(newton);
        if (before == INFINITY)
            return false;
        memcpy(newton->step, newton->residual, n * sizeof(double));
        lu_solve(n, newton->matrix, newton->pivot, newton->step);
        if (step_is_small(newton) || before <= rounding_merit * (double)n) {
            move(newton, 1.0);
            return true;
        }
        if (!search_along_step(newton, before))
            return false;
    }
    return false;
}

bool block_solve(const Block *block, double time, double *y, const double *p)
{
    const size_t n = block->size;
    double stack[STACK_SIZE * (STACK_SIZE + 5)];
    size_t stack_pivot[STACK_SIZE];
    void *heap = NULL;
    double *work = stack;
    size_t *pivot = stack_pivot;
    if (n > STACK_SIZE) {
        heap = malloc(n * (n + 5) * sizeof(double) + n * sizeof(size_t));
        if (heap == NULL)
            return false;
        work = heap;
        pivot = (size_t *)(work + n * (n + 5));
    }
    Newton newton = {.block = block, .time = time, .y = y, .p = p, .residual = work, .scale = work + n,
                     .step = work + 2 * n, .point = work + 3 * n, .matrix = work + 5 * n, .pivot = pivot};
    double *old = work + 4 * n;
    for (size_t i = 0; i < n; ++i)
        old[i] = y[block->unknowns[i]];
    const bool solved = iterate(&newton);
    if (!solved)
        for (size_t i = 0; i < n; ++i)
            y[block->unknowns[i]] = old[i];
    free(heap);
    return solved;
}

bool block_tangents(const Block *block, double time, const double *y, const double *p, double *moves)
{
    const size_t n = block->size;
    double *jacobian = malloc(n * n * sizeof(double) + n * sizeof(size_t));
    if (jacobian == NULL)
        return false;
    size_t *pivot = (size_t *)(jacobian + n * n);
    block->jacobian(time, y, p, jacobian);
    const bool solved = lu_factor(n, jacobian, pivot);
    if (solved) {
        for (size_t i = 0; i < n; ++i)
            moves[i] = -moves[i];
        lu_solve(n, jacobian, pivot, moves);
    }
    free(jacobian);
    return solved;
}
