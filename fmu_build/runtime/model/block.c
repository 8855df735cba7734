#include "block.h"
#include "linear.h"

#include <stdlib.h>

typedef struct {
    const Block *block;
    double time;
    double *y;
    const double *p;
} Point;

static double *unknown(void *context, size_t i)
{
    const Point *point = context;
    return &point->y[point->block->unknowns[i].index];
}

static double nominal(void *context, size_t i)
{
    const Point *point = context;
    return point->block->unknowns[i].nominal;
}

static bool evaluate(void *context, double *residual)
{
    const Point *point = context;
    point->block->residual(point->time, point->y, point->p, residual);
    return true;
}

static bool linearize(void *context, const double *residual, double *jacobian)
{
    const Point *point = context;
    (void)residual;
    point->block->jacobian(point->time, point->y, point->p, jacobian);
    return true;
}

static const char *name(void *context, size_t i)
{
    const Point *point = context;
    return point->block->unknowns[i].name;
}

static NewtonSystem system_at(Point *point)
{
    return (NewtonSystem){.size = point->block->size,
                          .linear = point->block->linear,
                          .context = point,
                          .unknown = unknown,
                          .nominal = nominal,
                          .name = name,
                          .evaluate = evaluate,
                          .linearize = linearize};
}

/* Returns whether no unknown has been solved for yet. */
static bool has_start_values(const Block *block, const double *y)
{
    for (size_t i = 0; i < block->size; ++i)
        if (y[block->unknowns[i].index] != model.y_start[block->unknowns[i].index])
            return false;
    return true;
}

bool block_solve(const Block *block, double time, double *y, const double *p)
{
    Point point = {block, time, y, p};
    const NewtonSystem system = system_at(&point);
    const NewtonResult result = newton_solve(&system);
    /* Once solved, the unknowns are no guesses: another solution would be another motion. */
    const bool is_guess = !block->linear && has_start_values(block, y);
    return result == NEWTON_SOLVED || (is_guess && newton_blames_guess(result) && newton_solve_beside(&system));
}

static NewtonResult find_tangents(const Block *block, double time, const double *y, const double *p, double *moves)
{
    const size_t n = block->size;
    double *jacobian = malloc(n * n * sizeof(double) + n * sizeof(size_t));
    if (jacobian == NULL)
        return NEWTON_NO_MEMORY;
    size_t *pivot = (size_t *)(jacobian + n * n);
    block->jacobian(time, y, p, jacobian);
    const NewtonResult result = lu_factor(n, jacobian, pivot) ? NEWTON_SOLVED : NEWTON_SINGULAR;
    if (result == NEWTON_SOLVED) {
        for (size_t i = 0; i < n; ++i)
            moves[i] = -moves[i];
        lu_solve(n, jacobian, pivot, moves);
    }
    free(jacobian);
    return result;
}

bool block_tangents(const Block *block, double time, const double *y, const double *p, double *moves)
{
    return find_tangents(block, time, y, p, moves) == NEWTON_SOLVED;
}

/* Returns whether the block's Jacobian determines the tangents of its unknowns. */
static NewtonResult try_tangents(const Block *block, double time, const double *y, const double *p)
{
    double *moves = calloc(block->size, sizeof(double));
    const NewtonResult result = moves == NULL ? NEWTON_NO_MEMORY : find_tangents(block, time, y, p, moves);
    free(moves);
    return result;
}

const char *blocks_explain(double time, double *y, const double *p, char text[NEWTON_TEXT_SIZE])
{
    /* Updates the algebraic variables before the failing block. */
    const bool solved = model_algebraics(time, y, p);
    for (size_t i = 0; i < model.n_blocks; ++i) {
        Point point = {model.blocks[i], time, y, p};
        const NewtonSystem system = system_at(&point);
        const NewtonResult result =
            solved ? try_tangents(model.blocks[i], time, y, p) : newton_solve(&system);
        if (result != NEWTON_SOLVED)
            return newton_explain(&system, result, "the algebraic loop", text);
    }
    /* The second attempt succeeded. */
    return "a system of equations has no solution, or memory was short";
}
