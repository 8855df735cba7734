/* linear.h - dense linear systems by LU decomposition with partial pivoting. */
#ifndef LINEAR_H
#define LINEAR_H

#include <stdbool.h>
#include <stddef.h>

/* Factors the row-major n-by-n matrix in place; returns false if it is singular up to rounding. */
bool lu_factor(size_t n, double *matrix, size_t *pivot);

/* The same; returns the number of columns that were eliminated, n unless the matrix is singular. */
size_t lu_eliminate(size_t n, double *matrix, size_t *pivot);

/* Computes a vector that a singular matrix maps to zero, from its factors and the number of eliminated columns. */
void lu_null_vector(size_t n, const double *factors, size_t eliminated, double *x);

/* Solves with the factors; x holds the right-hand side on entry and the solution on return. */
void lu_solve(size_t n, const double *factors, const size_t *pivot, double *x);

#endif
