/* newton.h - Newton's method with a line search, for one system of equations. */
#ifndef NEWTON_H
#define NEWTON_H

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    NEWTON_SOLVED,
    NEWTON_SINGULAR,   /* the Jacobian does not determine a step */
    NEWTON_STUCK,      /* no fraction of a step reduces the residual */
    NEWTON_ENDLESS,    /* too many iterations */
    NEWTON_NOT_FINITE, /* the residual or the Jacobian is not finite, or cannot be computed */
    NEWTON_NO_MEMORY
} NewtonResult;

typedef struct {
    size_t size;
    bool linear; /* the residual is linear in the unknowns: one step solves it */
    bool guessed; /* the unknowns are only guesses: where they make the Jacobian singular, they may move away from it */
    void *context;
    double *(*unknown)(void *context, size_t i); /* the location of unknown i */
    double (*nominal)(void *context, size_t i);  /* its order of magnitude, for values near zero */
    const char *(*name)(void *context, size_t i);
    /* Both compute at the current unknowns and return false on failure. `linearize` receives the residual of this
     * point; `jacobian` is row-major. */
    bool (*evaluate)(void *context, double *residual);
    bool (*linearize)(void *context, const double *residual, double *jacobian);
} NewtonSystem;

/* Solves for the unknowns, from their values as initial guesses; without a solution, the unknowns are unchanged. */
NewtonResult newton_solve(const NewtonSystem *system);

/* Returns whether other guesses may lead to a solution where these did not. */
static inline bool newton_blames_guess(NewtonResult result)
{
    return result == NEWTON_NOT_FINITE || result == NEWTON_SINGULAR;
}

/* Solves from starts on all sides of a guess at which the equations are not defined, as 1/(a - b) with two guesses of
 * 0, or determine no step, as (a - b)^3. At least two starts must lead to a solution, and all that do to the same one;
 * otherwise returns false and leaves the unknowns unchanged. */
bool newton_solve_beside(const NewtonSystem *system);

enum { NEWTON_TEXT_SIZE = 768 };

/* Explains a failure with the names of the unknowns: "WHAT of `a`, `b` could not be solved: ...", and of those that a
 * singular Jacobian leaves undetermined. Returns `text`. */
const char *newton_explain(const NewtonSystem *system, NewtonResult result, const char *what,
                           char text[NEWTON_TEXT_SIZE]);

#endif
