#include "location.h"
#include "integrator.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MAX_ITERATIONS = 200, MAX_VERTEX_ITERATIONS = 6 };

/* All roots at one time. */
typedef struct {
    double time;
    double *root;
} Sample;

size_t roots_count(void)
{
    return 6 * model.n_roots + 1;
}

void roots_bind(RootFinder *finder, double *block)
{
    finder->start = block;
    finder->sample = block + model.n_roots;
    finder->end = block + 2 * model.n_roots;
    for (size_t i = 0; i < 3; ++i)
        finder->work[i] = block + (i + 3) * model.n_roots;
    finder->agrees = block + 6 * model.n_roots;
}

static bool has_changed(size_t relation, const double *root, const double *p)
{
    const Relation *r = &model.relations[relation];
    if (r->root >= model.n_roots)
        return false; /* changes only at time events */
    return relation_holds(r, root[r->root]) != (p[r->memory] != 0.0);
}

size_t roots_first_changed(const double *root, const double *p)
{
    for (size_t i = 0; i < model.n_relations; ++i)
        if (has_changed(i, root, p))
            return i;
    return model.n_relations;
}

static bool sample(const RootFinder *finder, Sample *at, double time)
{
    at->time = time;
    return roots_evaluate(finder->context, time, at->root);
}

static void swap(Sample *a, Sample *b)
{
    const Sample kept = *a;
    *a = *b;
    *b = kept;
}

/* Of the relations that have changed in `after`, returns the one whose secant from `before` crosses zero first. */
static size_t first_by_secant(const Sample *before, const Sample *after, const double *p)
{
    size_t first = model.n_relations;
    double earliest = INFINITY;
    for (size_t i = 0; i < model.n_relations; ++i) {
        if (!has_changed(i, after->root, p))
            continue;
        const double a = before->root[model.relations[i].root], b = after->root[model.relations[i].root];
        const double fraction = a == b ? 0.0 : a / (a - b);
        if (first == model.n_relations || fraction < earliest) {
            earliest = fraction;
            first = i;
        }
    }
    return first;
}

/* Returns the next point to try in the bracket, as a fraction from a to b: inverse quadratic interpolation through the
 * bracket and a third point if it is sure to help (Chandrupatla, Adv. Eng. Softw. 28, 1997), else bisection. */
static double next_fraction(double ta, double a, double tb, double b, double tc, double c)
{
    const double xi = (ta - tb) / (tc - tb), phi = (a - b) / (c - b);
    if (!(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi))
        return 0.5;
    return a / (b - a) * (c / (b - c)) + (tc - ta) / (tb - ta) * (a / (c - a)) * (b / (c - b));
}

/* Returns how long before `after` root k crossed zero, by the secant from `before`. */
static double since_crossing(const Sample *before, const Sample *after, size_t k)
{
    return (after->time - before->time) * (after->root[k] / (after->root[k] - before->root[k]));
}

/* Narrows the bracket, with no change in `before` and some change in `after`, until `after` lies just past the
 * crossing, within the spacing of doubles. `third` is another sample nearby. */
static Crossing narrow(const RootFinder *finder, const double *p, Sample before, Sample after, Sample third,
                       Sample spare)
{
    const double resolution = 2.0 * DBL_EPSILON * fmax(fabs(before.time), fabs(after.time));
    size_t relation = first_by_secant(&before, &after, p);
    bool newest_is_after = third.time > after.time;
    for (int iteration = 0; iteration < MAX_ITERATIONS; ++iteration) {
        const double width = after.time - before.time;
        const size_t k = model.relations[relation].root;
        /* A root that is exactly zero, as that of max(u, 0) > 0, says nothing about when it became so. */
        const bool at_zero = after.root[k] == 0.0;
        if (width <= resolution ||
            (iteration > 0 && !at_zero && since_crossing(&before, &after, k) <= resolution))
            break;
        const Sample *a = newest_is_after ? &after : &before, *b = newest_is_after ? &before : &after;
        const double fraction =
            at_zero && third.root[k] == 0.0
                ? 0.5
                : next_fraction(a->time, a->root[k], b->time, b->root[k], third.time, third.root[k]);
        /* Aim slightly past the crossing, so that a good guess falls on its far side and ends the search. */
        const double least = fmin(0.5, resolution / width);
        const double aim = (newest_is_after ? 1.0 - fraction : fraction) + 0.5 * least;
        const double time = before.time + fmin(fmax(aim, least), 1.0 - least) * width;
        if (!(time > before.time && time < after.time))
            break;
        if (!sample(finder, &spare, time))
            return (Crossing){.result = ROOTS_NOT_COMPUTABLE};
        newest_is_after = roots_first_changed(spare.root, p) < model.n_relations;
        swap(&third, newest_is_after ? &after : &before);
        swap(newest_is_after ? &after : &before, &spare);
        if (newest_is_after)
            relation = first_by_secant(&before, &after, p);
    }
    return (Crossing){.result = ROOTS_CROSSED, .time = after.time, .relation = relation};
}

/* One root at one time. */
typedef struct {
    double time, value;
} Point;

/* Computes the vertex of the parabola through three points; returns false if there is none inside, or none that comes
 * close to zero compared with the variation of the root around it. */
static bool vertex(Point a, Point b, Point c, double *time)
{
    const double left = (b.value - a.value) / (b.time - a.time), right = (c.value - b.value) / (c.time - b.time);
    const double bend = (right - left) / (c.time - a.time);
    if (bend == 0.0 || (bend > 0.0) != (b.value > 0.0))
        return false;
    const double slope = left - bend * (b.time - a.time);
    const double offset = -0.5 * slope / bend;
    *time = a.time + offset;
    if (!(*time > a.time && *time < c.time) || *time == b.time)
        return false;
    const double drop = 0.5 * slope * offset, value = a.value + drop;
    const double variation = fmax(fabs(drop), fabs(c.value - value));
    return (value > 0.0) != (b.value > 0.0) || fabs(value) <= 0.25 * variation;
}

/* Searches for a point between a and c, with b between them, at which a root is temporarily on the other side of zero.
 * ROOTS_CROSSED: a relation has changed in `found`. */
static RootResult search_vertex(const RootFinder *finder, const double *p, Point a, Point b, Point c, size_t root,
                                Sample *found)
{
    double time;
    for (int iteration = 0; iteration < MAX_VERTEX_ITERATIONS && vertex(a, b, c, &time); ++iteration) {
        if (!sample(finder, found, time))
            return ROOTS_NOT_COMPUTABLE;
        if (roots_first_changed(found->root, p) < model.n_relations)
            return ROOTS_CROSSED;
        const Point latest = {time, found->root[root]};
        const bool nearer = fabs(latest.value) < fabs(b.value);
        Point *const outer = (time < b.time) == nearer ? &c : &a;
        *outer = nearer ? b : latest;
        b = nearer ? latest : b;
    }
    return ROOTS_NOT_CROSSED;
}

/* Cheap test on three equidistant values before any search: whether there is a vertex between them. */
static bool may_touch_zero(double a, double b, double c)
{
    const double bend = a - 2.0 * b + c;
    return bend * b > 0.0 && fabs(c - a) < 2.0 * fabs(bend);
}

/* Returns whether every root stays away from zero: it has the same sign at the start, the sample and the end, and the
 * parabola through the three has no vertex within the step or a quarter of it on either side. This settles most steps
 * with available values, whereas the rest of roots_search must evaluate more roots. */
static bool is_quiet(const RootFinder *finder)
{
    const double at = SAMPLE_FRACTION, first = 1.0 / at, second = 1.0 / (1.0 - at), margin = 0.25;
    for (size_t k = 0; k < model.n_roots; ++k) {
        const double a = finder->start[k], b = finder->sample[k], c = finder->end[k];
        const double secant = first * (b - a), bend = second * (c - b) - secant;
        const double before = secant - (at + 2.0 * margin) * bend;
        const double behind = secant + (2.0 - at + 2.0 * margin) * bend;
        if (!(a * b > 0.0 && b * c > 0.0 && before * behind >= 0.0))
            return false;
    }
    return true;
}

/* The findings from three equidistant samples of a step. */
typedef struct {
    bool changed_in_middle, changed_at_end, has_vertex;
} Overview;

static Overview look_over(const double *start, const double *middle, const double *end, const double *p)
{
    Overview overview = {false, false, false};
    for (size_t i = 0; i < model.n_relations; ++i) {
        const Relation *relation = &model.relations[i];
        const size_t k = relation->root;
        if (k >= model.n_roots)
            continue;
        const bool held = p[relation->memory] != 0.0;
        overview.changed_in_middle |= relation_holds(relation, middle[k]) != held;
        overview.changed_at_end |= relation_holds(relation, end[k]) != held;
        overview.has_vertex |= may_touch_zero(start[k], middle[k], end[k]);
    }
    return overview;
}

/* Searches for a relation that changes and changes back within the step; `after` becomes the sample with the change. */
static RootResult search_double(const RootFinder *finder, const double *p, const Sample *start, const Sample *middle,
                                const Sample *end, Sample *after, Sample *spare)
{
    RootResult result = ROOTS_NOT_CROSSED;
    for (size_t i = 0; i < model.n_relations; ++i) {
        const size_t k = model.relations[i].root;
        if (k >= model.n_roots || !may_touch_zero(start->root[k], middle->root[k], end->root[k]))
            continue;
        const Point a = {start->time, start->root[k]}, b = {middle->time, middle->root[k]},
                    c = {end->time, end->root[k]};
        const RootResult here = search_vertex(finder, p, a, b, c, k, spare);
        if (here == ROOTS_NOT_COMPUTABLE)
            return here;
        if (here == ROOTS_CROSSED && (result == ROOTS_NOT_CROSSED || spare->time < after->time)) {
            swap(after, spare);
            result = ROOTS_CROSSED;
        }
    }
    return result;
}

Crossing roots_search(RootFinder *finder, const double *p, double from, double to)
{
    const Crossing none = {.result = ROOTS_NOT_CROSSED}, failed = {.result = ROOTS_NOT_COMPUTABLE};
    Sample start = {from, finder->start}, middle = {0.0, finder->work[0]}, end = {to, finder->end};
    Sample between = {0.0, finder->work[1]}, spare = {0.0, finder->work[2]};
    if (*finder->agrees == 0.0)
        *finder->agrees = roots_first_changed(finder->start, p) == model.n_relations;
    if (*finder->agrees != 0.0 && is_quiet(finder)) {
        memcpy(finder->start, finder->end, model.n_roots * sizeof(double));
        return none;
    }
    if (!sample(finder, &middle, from + 0.5 * (to - from)))
        return failed;
    const Overview overview = look_over(start.root, middle.root, end.root, p);
    if (overview.changed_in_middle) {
        const size_t at_start = roots_first_changed(start.root, p);
        if (at_start < model.n_relations)
            return (Crossing){.result = ROOTS_CROSSED, .time = from, .relation = at_start};
    }

    const RootResult within =
        overview.has_vertex ? search_double(finder, p, &start, &middle, &end, &between, &spare) : ROOTS_NOT_CROSSED;
    if (within == ROOTS_NOT_COMPUTABLE)
        return failed;
    if (within == ROOTS_CROSSED && between.time < (overview.changed_in_middle ? middle.time : end.time))
        return between.time < middle.time ? narrow(finder, p, start, between, middle, spare)
                                          : narrow(finder, p, middle, between, end, spare);
    if (overview.changed_in_middle)
        return narrow(finder, p, start, middle, end, spare);
    if (overview.changed_at_end)
        return narrow(finder, p, middle, end, start, spare);
    if (roots_first_changed(finder->sample, p) < model.n_relations) {
        if (!sample(finder, &between, from + SAMPLE_FRACTION * (to - from)))
            return failed;
        if (roots_first_changed(between.root, p) < model.n_relations)
            return narrow(finder, p, middle, between, end, spare);
    }
    memcpy(finder->start, end.root, model.n_roots * sizeof(double));
    return none;
}

Crossing roots_locate(RootFinder *finder, const double *p, double from, double to)
{
    Sample before = {0.0, finder->work[0]}, middle = {0.0, finder->work[1]};
    const Sample after = {to, finder->sample}, spare = {0.0, finder->work[2]};
    if (!sample(finder, &before, from) || !sample(finder, &middle, from + 0.5 * (to - from)))
        return (Crossing){.result = ROOTS_NOT_COMPUTABLE};
    const size_t at_start = roots_first_changed(before.root, p);
    if (at_start < model.n_relations)
        return (Crossing){.result = ROOTS_CROSSED, .time = from, .relation = at_start};
    return roots_first_changed(middle.root, p) < model.n_relations ? narrow(finder, p, before, middle, after, spare)
                                                                   : narrow(finder, p, middle, after, before, spare);
}
