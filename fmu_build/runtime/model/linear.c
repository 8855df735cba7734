#include "linear.h"

#include <float.h>
#include <math.h>

static void swap(double *a, double *b)
{
    const double kept = *a;
    *a = *b;
    *b = kept;
}

static size_t largest_in_column(size_t n, const double *matrix, size_t column)
{
    size_t row = column;
    for (size_t i = column + 1; i < n; ++i)
        if (fabs(matrix[i * n + column]) > fabs(matrix[row * n + column]))
            row = i;
    return row;
}

/* Returns whether the pivot in row k is only the rounding error of cancelling terms. These are computed from the
 * factors, so that the scaling of rows and columns does not matter. */
static bool is_rounding(size_t n, const double *matrix, size_t k)
{
    double terms = 0.0;
    for (size_t j = 0; j < k; ++j)
        terms += fabs(matrix[k * n + j] * matrix[j * n + k]);
    return fabs(matrix[k * n + k]) <= (double)k * DBL_EPSILON * terms;
}

size_t lu_eliminate(size_t n, double *matrix, size_t *pivot)
{
    for (size_t k = 0; k < n; ++k) {
        pivot[k] = largest_in_column(n, matrix, k);
        if (pivot[k] != k)
            for (size_t j = 0; j < n; ++j)
                swap(&matrix[k * n + j], &matrix[pivot[k] * n + j]);
        if (is_rounding(n, matrix, k))
            return k;
        for (size_t i = k + 1; i < n; ++i) {
            const double factor = matrix[i * n + k] /= matrix[k * n + k];
            for (size_t j = k + 1; j < n; ++j)
                matrix[i * n + j] -= factor * matrix[k * n + j];
        }
    }
    return n;
}

bool lu_factor(size_t n, double *matrix, size_t *pivot)
{
    return lu_eliminate(n, matrix, pivot) == n;
}

void lu_null_vector(size_t n, const double *factors, size_t eliminated, double *x)
{
    for (size_t i = 0; i < n; ++i)
        x[i] = i == eliminated;
    for (size_t i = eliminated; i-- > 0;) {
        for (size_t j = i + 1; j <= eliminated; ++j)
            x[i] -= factors[i * n + j] * x[j];
        x[i] /= factors[i * n + i];
    }
}

void lu_solve(size_t n, const double *factors, const size_t *pivot, double *x)
{
    for (size_t i = 0; i < n; ++i)
        swap(&x[i], &x[pivot[i]]);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < i; ++j)
            x[i] -= factors[i * n + j] * x[j];
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; ++j)
            x[i] -= factors[i * n + j] * x[j];
        x[i] /= factors[i * n + i];
    }
}
