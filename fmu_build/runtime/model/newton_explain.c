/* What a failed solution is said to be: the names of the unknowns and the reason. */

#include "linear.h"
#include "newton.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A share of the largest change of an unknown, below which another does not take part in it. */
static const double negligible = 1e-6;

static const char *problem(NewtonResult result)
{
    switch (result) {
    case NEWTON_SOLVED:
        break;
    case NEWTON_SINGULAR:
        return "singular Jacobian";
    case NEWTON_STUCK:
        return "no convergence, as no part of a step lowers the residual: there is no solution nearby, or it jumps, as "
               "that of a comparator with positive feedback, which needs a relation outside of noEvent() and smooth()";
    case NEWTON_ENDLESS:
        return "no convergence after 100 iterations";
    case NEWTON_NOT_FINITE:
        return "residual or Jacobian not finite";
    case NEWTON_NO_MEMORY:
        return "out of memory";
    }
    return "";
}

/* Returns the length of a text to which something is added; what has no room is cut off. */
static size_t add(char *text, size_t length, const char *format, const char *what)
{
    const int added = snprintf(text + length, NEWTON_TEXT_SIZE - length, format, what);
    return added < 0 ? length : strlen(text);
}

/* Adds quoted names, separated by commas, as long as `room` remains behind them; returns the new length. `is_named` of
 * NULL names all. */
static size_t add_names(const NewtonSystem *system, const bool *is_named, char *text, size_t length, size_t room)
{
    size_t named = 0, left_out = 0;
    for (size_t i = 0; i < system->size; ++i) {
        const char *name = system->name(system->context, i);
        if (is_named != NULL && !is_named[i])
            continue;
        if (left_out > 0 || length + strlen(name) + room > NEWTON_TEXT_SIZE) {
            ++left_out;
            continue;
        }
        length = add(text, length, named++ > 0 ? ", `%s`" : " `%s`", name);
    }
    if (left_out > 0)
        length += (size_t)sprintf(text + length, " and %zu%s", left_out, named > 0 ? " more" : " unknowns");
    return length;
}

/* Marks the unknowns that the singular Jacobian leaves undetermined, from a change of all of them that changes no
 * equation, each relative to its size. Returns whether the Jacobian is singular at the present unknowns. */
static bool find_undetermined(const NewtonSystem *system, double *work, size_t *pivot, bool *is_undetermined)
{
    const size_t n = system->size;
    double *jacobian = work, *change = work + n * n, largest = 0.0;
    if (!system->evaluate(system->context, change) || !system->linearize(system->context, change, jacobian))
        return false;
    const size_t eliminated = lu_eliminate(n, jacobian, pivot);
    if (eliminated == n)
        return false;
    lu_null_vector(n, jacobian, eliminated, change);
    for (size_t i = 0; i < n; ++i) {
        const double size = fmax(fabs(*system->unknown(system->context, i)), system->nominal(system->context, i));
        change[i] = fabs(change[i] / size);
        largest = fmax(largest, change[i]);
    }
    for (size_t i = 0; i < n; ++i)
        is_undetermined[i] = change[i] > negligible * largest;
    return isfinite(largest);
}

static size_t add_undetermined(const NewtonSystem *system, char *text, size_t length)
{
    const size_t n = system->size;
    double *work = malloc((n * n + n) * sizeof(double) + n * (sizeof(size_t) + sizeof(bool)));
    if (work == NULL)
        return length;
    size_t *pivot = (size_t *)(work + n * n + n);
    bool *is_undetermined = (bool *)(pivot + n);
    if (find_undetermined(system, work, pivot, is_undetermined))
        length = add_names(system, is_undetermined, text, add(text, length, "%s", ": the equations do not determine"), 16);
    free(work);
    return length;
}

const char *newton_explain(const NewtonSystem *system, NewtonResult result, const char *what,
                           char text[NEWTON_TEXT_SIZE])
{
    enum { ROOM_FOR_THE_REST = 320 };
    size_t length = add_names(system, NULL, text, add(text, 0, "%s of", what), ROOM_FOR_THE_REST);
    length = add(text, length, " could not be solved: %s", problem(result));
    if (result == NEWTON_SINGULAR)
        add_undetermined(system, text, length);
    return text;
}
