#include "sensitivity.h"
#include "time_events.h"

#include <math.h>
#include <stdlib.h>

static const char *const no_memory = "out of memory";

/* Moves of an event's time that differ by more than this part of their size are different. */
static const double same_move = 1e-6, least_move = 1e-14;

/* Computes the roots of all relations at the event, those of time just after it. */
static const char *find_roots(Values *values, double *root)
{
    if (!model_roots(values->time, values->y, values->p, root))
        return "the relations could not be computed";
    model_time_relations(time_just_after(values->time), values->p, root + model.n_roots);
    return NULL;
}

/* The root stays zero at the event as the parameter changes, so the event's time moves by -(derivative of the root by
 * the parameter)/(derivative of the root along the motion). All relations that change must move alike: `is_first` sets
 * the moves, others are compared with them. */
static const char *find_moves(Values *values, const double *rate, bool is_first)
{
    const Sensitivities *s = model.sensitivities;
    for (size_t j = 0; j < s->n_parameters; ++j) {
        double *const known = &values->p[s->moves[j].next_move];
        const double move = rate[1 + j] == 0.0 ? 0.0 : -rate[1 + j] / rate[0];
        if (!isfinite(move))
            return "there are no sensitivities beyond an event that the motion touches without crossing it";
        if (!is_first && fabs(move - *known) > same_move * (fabs(move) + fabs(*known)) + least_move)
            return "there are no sensitivities beyond two events at the same time that a parameter moves apart";
        *known = move;
    }
    return NULL;
}

/* Sets the moves of the event's time from the relations that have changed. */
static const char *find_all_moves(Values *values, const double *root, double *rates)
{
    const Sensitivities *s = model.sensitivities;
    bool is_first = true;
    for (size_t i = 0; i < model.n_relations; ++i) {
        const Relation *relation = &model.relations[i];
        if (relation_holds(relation, root[relation->root]) == (values->p[relation->memory] != 0.0))
            continue;
        if (is_first && !s->root_rates(values->time, values->y, values->p, rates))
            return "the derivatives of the relations could not be computed";
        const char *problem = find_moves(values, rates + (1 + s->n_parameters) * relation->root, is_first);
        if (problem != NULL)
            return problem;
        is_first = false;
    }
    return NULL;
}

const char *sensitivity_meet_event(Values *values)
{
    const Sensitivities *s = model.sensitivities;
    if (s == NULL)
        return NULL;
    const size_t n_roots = model.n_roots + model.n_time_relations;
    double *work = malloc((1 + (2 + s->n_parameters) * n_roots) * sizeof(double));
    if (work == NULL)
        return no_memory;
    for (size_t j = 0; j < s->n_parameters; ++j)
        values->p[s->moves[j].next_move] = 0.0;
    const char *problem = find_roots(values, work);
    if (problem == NULL)
        problem = find_all_moves(values, work, work + n_roots);
    free(work);
    return problem;
}

/* Adds sign * der(x) * move to the sensitivities of the states x. */
static const char *shift_states(Values *values, double sign)
{
    const Sensitivities *s = model.sensitivities;
    double *der = malloc((model.n_states + 1) * sizeof(double));
    if (der == NULL)
        return no_memory;
    const bool known = model_derivatives(values->time, values->y, values->p, der, NULL);
    for (size_t j = 0; known && j < s->n_parameters; ++j)
        for (size_t i = 0; i < s->n_states; ++i)
            values->y[(1 + j) * s->n_states + i] += sign * der[i] * values->p[s->moves[j].move];
    free(der);
    return known ? NULL : "the derivatives at an event could not be computed";
}

const char *sensitivity_enter_event(Values *values, bool *moves)
{
    const Sensitivities *s = model.sensitivities;
    *moves = false;
    for (size_t j = 0; s != NULL && j < s->n_parameters; ++j) {
        double *next = &values->p[s->moves[j].next_move];
        values->p[s->moves[j].move] = *next;
        *moves |= *next != 0.0;
        *next = 0.0;
    }
    return *moves ? shift_states(values, 1.0) : NULL;
}

const char *sensitivity_leave_event(Values *values)
{
    const Sensitivities *s = model.sensitivities;
    const char *problem = shift_states(values, -1.0);
    for (size_t j = 0; j < s->n_parameters; ++j)
        values->p[s->moves[j].move] = 0.0;
    return problem;
}
