/* block.h - systems of algebraic equations: their solution, their tangents, and why there are none. */
#ifndef BLOCK_H
#define BLOCK_H

#include "model.h"
#include "newton.h"

/* Solves block->residual = 0 for the unknowns, which start from their values in y and end there.
 * Returns false, and leaves y as it was, where no solution was found. */
bool block_solve(const Block *block, double time, double *y, const double *p);

/* How far the unknowns move when the residuals, with the unknowns held, move by `moves`, which is replaced by the answer.
 * False where the Jacobian is singular. */
bool block_tangents(const Block *block, double time, const double *y, const double *p, double *moves);

/* Where model_algebraics or model_tangents fails at this point: which loop it is, and why. Returns `text`, or a text
 * without names where neither fails. Computes the algebraic variables of y. */
const char *blocks_explain(double time, double *y, const double *p, char text[NEWTON_TEXT_SIZE]);

#endif
