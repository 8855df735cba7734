/* newton.h - Newton's method with a line search, for one system of equations. */
#ifndef NEWTON_H
#define NEWTON_H

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    NEWTON_SOLVED,
    NEWTON_SINGULAR,   /* the Jacobian does not determine a step */
    NEWTON_STUCK,      /* no part of a step lowers the residual */
    NEWTON_ENDLESS,    /* too many steps */
    NEWTON_NOT_FINITE, /* the residual or the Jacobian is not finite, or cannot be computed */
    NEWTON_NO_MEMORY
} NewtonResult;

typedef struct {
    size_t size;
    bool linear; /* the residual is linear in the unknowns: one step solves it */
    void *context;
    double *(*unknown)(void *context, size_t i); /* where unknown i is kept */
    double (*nominal)(void *context, size_t i);  /* its order of magnitude, for what is near zero */
    const char *(*name)(void *context, size_t i);
    /* Both are computed at the present unknowns, and return false where they cannot be. `residual` is that of the
     * present point, `jacobian` is row-major. */
    bool (*evaluate)(void *context, double *residual);
    bool (*linearize)(void *context, const double *residual, double *jacobian);
} NewtonSystem;

/* Solves for the unknowns, which start from their values; they are left as they were where no solution is found. */
NewtonResult newton_solve(const NewtonSystem *system);

enum { NEWTON_TEXT_SIZE = 512 };

/* Names the unknowns of a system that was not solved, and why: "WHAT of `a`, `b` could not be solved: ...". Returns
 * `text`. */
const char *newton_explain(const NewtonSystem *system, NewtonResult result, const char *what,
                           char text[NEWTON_TEXT_SIZE]);

#endif
