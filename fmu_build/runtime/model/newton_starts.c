/* Solutions from other starts than a guess that leads nowhere. */

#include "newton.h"

#include <math.h>
#include <stdlib.h>

/* Starts off a guess at which the equations are not defined or the Jacobian is singular, in units of the nominal values:
 * multiples of the golden ratio or of the square root of 2, modulo 1, spread the unknowns evenly. Each start has its
 * mirror image, and one in the reverse order, because unknowns that can be exchanged have solutions that can. */
static const double parts[] = {0.61803398874989485, 0.41421356237309505};
enum { STARTS = 8 };
/* Solutions that differ by less, relative to their size, are the same. */
static const double same_solution = 1e-6;

/* Returns the offset of unknown i of n in one of the starts, from 0.1 to 1.1 of its nominal value, of either sign. */
static double offset(unsigned start, size_t i, size_t n)
{
    const bool is_mirrored = start & 1, is_reversed = start & 2;
    const double turns = (double)(is_reversed ? n - i : i + 1) * parts[start / 4];
    const double size = 0.1 + turns - floor(turns);
    return is_mirrored ? -size : size;
}

static bool is_same(double found, double other, double nominal)
{
    return fabs(found - other) <= same_solution * fmax(fmax(fabs(found), fabs(other)), nominal);
}

/* Keeps a solution, or compares it with the one that was kept; returns whether they are the same. */
static bool keep_solution(const NewtonSystem *system, double *kept, bool is_first)
{
    bool same = true;
    for (size_t i = 0; i < system->size; ++i) {
        const double value = *system->unknown(system->context, i);
        if (is_first)
            kept[i] = value;
        else
            same = same && is_same(value, kept[i], system->nominal(system->context, i));
    }
    return same;
}

static void put(const NewtonSystem *system, const double *values)
{
    for (size_t i = 0; i < system->size; ++i)
        *system->unknown(system->context, i) = values[i];
}

bool newton_solve_beside(const NewtonSystem *system)
{
    const size_t n = system->size;
    double *start = malloc(2 * n * sizeof(double)), *kept = start + n;
    if (start == NULL)
        return false;
    keep_solution(system, start, true);
    size_t solved = 0;
    bool alike = true;
    for (unsigned k = 0; k < STARTS && alike; ++k) {
        for (size_t i = 0; i < n; ++i)
            *system->unknown(system->context, i) = start[i] + offset(k, i, n) * system->nominal(system->context, i);
        if (newton_solve(system) == NEWTON_SOLVED)
            alike = keep_solution(system, kept, solved++ == 0);
    }
    alike = alike && solved > 1;
    put(system, alike ? kept : start);
    free(start);
    return alike;
}
