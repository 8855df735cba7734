/* block.h - algebraic loops: their solution, their tangents, and explanations of failures. */
#ifndef BLOCK_H
#define BLOCK_H

#include "model.h"
#include "newton.h"

/* Solves block->residual = 0 for the unknowns, from their values in y as initial guesses, and stores them in y.
 * Returns false, and leaves y unchanged, if no solution was found. */
bool block_solve(const Block *block, double time, double *y, const double *p);

/* Computes the tangents of the unknowns in place: on entry, `moves` contains the tangents of the residuals at constant
 * unknowns. Returns false if the Jacobian is singular or memory runs out. */
bool block_tangents(const Block *block, double time, const double *y, const double *p, double *moves);

/* Explains which loop makes model_algebraics or model_tangents fail at this point, and why. Returns `text`, or a
 * general message if neither fails now. Computes the algebraic variables in y. */
const char *blocks_explain(double time, double *y, const double *p, char text[NEWTON_TEXT_SIZE]);

#endif
