/* The start of a simulation: dependent parameters, start values, initial equations, and the first event. */

#include "actions.h"
#include "events.h"
#include "iteration.h"
#include "linear.h"
#include "time_events.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NEWTON_STEPS = 100, MAX_HALVINGS = 30, MAX_ROUNDS = 100 };

typedef struct {
    Values *values;
    double *memory; /* holds the arrays below */
    double *residual, *trial, *step, *point, *jacobian;
    size_t *pivot;
} InitialSystem;

static double *unknown(const InitialSystem *system, size_t i)
{
    const InitialUnknown *place = &model.initial_unknowns[i];
    return place->store == STORE_PARAMETER ? &system->values->p[place->index] : &system->values->y[place->index];
}

static bool system_create(InitialSystem *system, Values *values)
{
    const size_t n = model.n_initial_unknowns;
    system->values = values;
    system->memory = malloc((n * n + 4 * n) * sizeof(double) + n * sizeof(size_t) + 1);
    if (system->memory == NULL)
        return false;
    system->residual = system->memory;
    system->trial = system->residual + n;
    system->step = system->trial + n;
    system->point = system->step + n;
    system->jacobian = system->point + n;
    system->pivot = (size_t *)(system->jacobian + n * n);
    return true;
}

/* The residual at the present unknowns; its square norm, INFINITY where it cannot be computed. */
static double evaluate(const InitialSystem *system, double *residual)
{
    Values *values = system->values;
    model_dependent_parameters(values->p);
    if (!model_algebraics(values->time, values->y, values->p))
        return INFINITY;
    model_initial_residual(values->time, values->y, values->p, residual);
    double sum = 0.0;
    for (size_t i = 0; i < model.n_initial_unknowns; ++i)
        sum += residual[i] * residual[i];
    return isfinite(sum) ? sum : INFINITY;
}

/* Forward differences, with steps that are exact in binary. */
static bool differentiate(const InitialSystem *system)
{
    const size_t n = model.n_initial_unknowns;
    for (size_t j = 0; j < n; ++j) {
        double *place = unknown(system, j);
        const double centre = *place;
        *place = centre + sqrt(DBL_EPSILON) * fmax(fabs(centre), 1e-3);
        const double width = *place - centre;
        if (evaluate(system, system->trial) == INFINITY)
            return false;
        *place = centre;
        for (size_t i = 0; i < n; ++i)
            system->jacobian[i * n + j] = (system->trial[i] - system->residual[i]) / width;
    }
    return lu_factor(n, system->jacobian, system->pivot);
}

static bool step_is_negligible(const InitialSystem *system)
{
    for (size_t i = 0; i < model.n_initial_unknowns; ++i)
        if (!(fabs(system->step[i]) <= 4.0 * DBL_EPSILON * fmax(fabs(system->point[i]), DBL_MIN / DBL_EPSILON)))
            return false;
    return true;
}

/* Takes the Newton step, or as much of it as lowers the residual; false where no part does. */
static bool descend(const InitialSystem *system, double before)
{
    double fraction = 1.0;
    for (int halving = 0; halving < MAX_HALVINGS; ++halving, fraction *= 0.5) {
        for (size_t i = 0; i < model.n_initial_unknowns; ++i)
            *unknown(system, i) = system->point[i] - fraction * system->step[i];
        if (evaluate(system, system->residual) < before)
            return true;
    }
    for (size_t i = 0; i < model.n_initial_unknowns; ++i)
        *unknown(system, i) = system->point[i];
    evaluate(system, system->residual);
    return false;
}

/* Newton's method until the residual is zero or falls no further. Where it stops falling, the unknowns are as good
 * as rounding lets them be if the step there is small. */
static bool solve(const InitialSystem *system)
{
    const size_t n = model.n_initial_unknowns;
    double norm = evaluate(system, system->residual);
    for (int i = 0; i < MAX_NEWTON_STEPS && norm > 0.0; ++i) {
        if (norm == INFINITY || !differentiate(system))
            return false;
        for (size_t j = 0; j < n; ++j)
            system->point[j] = *unknown(system, j);
        memcpy(system->step, system->residual, n * sizeof(double));
        lu_solve(n, system->jacobian, system->pivot, system->step);
        if (step_is_negligible(system))
            return true;
        if (!descend(system, norm)) {
            for (size_t j = 0; j < n; ++j)
                if (fabs(system->step[j]) > 1e-9 * fmax(fabs(system->point[j]), 1e-3))
                    return false;
            return true;
        }
        norm = evaluate(system, system->residual);
    }
    return norm == 0.0;
}

static void set_initial_event(Values *values, double value)
{
    if (model.initial_event_slot != NO_SLOT)
        values->p[model.initial_event_slot] = value;
}

/* During initialisation a when-clause acts only through initial() (Modelica 3.4, section 8.6): where initial() makes
 * a condition true that is false without it. */
static const char *settle_initially(Iteration *iteration, Values *values)
{
    set_initial_event(values, 0.0);
    iteration_hold_conditions(values);
    const char *problem = iteration_settle(iteration, values);
    if (problem != NULL)
        return problem;
    iteration_commit_conditions(iteration, values);
    set_initial_event(values, 1.0);
    iteration_arm_initial_conditions(iteration, values);
    return iteration_settle(iteration, values);
}

/* Initial equations and discrete variables depend on each other through the relations. */
static const char *settle_together(const InitialSystem *system, Iteration *iteration)
{
    for (int round = 0; round < MAX_ROUNDS; ++round) {
        if (model.n_initial_unknowns > 0 && !solve(system))
            return "the initial equations could not be solved";
        const double solved = evaluate(system, system->residual);
        if (solved == INFINITY)
            return "the algebraic equations could not be solved";
        const char *problem = settle_initially(iteration, system->values);
        if (problem != NULL)
            return problem;
        if (evaluate(system, system->residual) <= solved)
            return NULL;
    }
    return "the initial values do not settle: equations and relations change each other in a circle";
}

/* What the initial pass has found counts as pre() in the events that follow it: values and conditions. */
static const char *conclude(Iteration *iteration, Values *values)
{
    const char *problem = NULL;
    if (iteration_commit_states(iteration, values))
        problem = iteration_settle(iteration, values);
    if (problem == NULL)
        iteration_commit_conditions(iteration, values);
    set_initial_event(values, 0.0);
    return problem;
}

static EventStatus initialize(InitialSystem *system, Iteration *iteration, const EventReporter *reporter)
{
    Values *values = system->values;
    iteration_copy_pre(values);
    const char *problem = settle_together(system, iteration);
    EventStatus status = EVENT_OK;
    if (problem == NULL) {
        status = actions_take(values, iteration->active, reporter);
        problem = conclude(iteration, values);
    }
    if (problem != NULL) {
        reporter->report(reporter->context, ACTION_ERROR, problem);
        return EVENT_ERROR;
    }
    bool states_changed = false;
    return status == EVENT_OK ? event_update(values, false, reporter, &states_changed) : status;
}

EventStatus event_initialize(Values *values, const EventReporter *reporter)
{
    Iteration iteration = {0};
    InitialSystem system = {0};
    EventStatus status = EVENT_ERROR;
    model_dependent_parameters(values->p);
    model_start_values(values->y, values->p);
    clocks_start(values);
    if (iteration_create(&iteration) && system_create(&system, values))
        status = initialize(&system, &iteration, reporter);
    else
        reporter->report(reporter->context, ACTION_ERROR, "out of memory");
    iteration_free(&iteration);
    free(system.memory);
    return status;
}
