/* The start of a simulation: dependent parameters, start values, initial equations, and the first event. */

#include "actions.h"
#include "block.h"
#include "events.h"
#include "iteration.h"
#include "time_events.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROUNDS = 100 };
static const double FIRST_STEP = 0.25, SHORTEST_STEP = 1.0 / 1024.0; /* of homotopy(), from 1 to 0 */

typedef struct {
    Values *values;
    double *trial; /* [n_initial_unknowns] */
} InitialSystem;

static double *unknown(void *context, size_t i)
{
    const InitialSystem *system = context;
    const InitialUnknown *place = &model.initial_unknowns[i];
    return place->store == STORE_PARAMETER ? &system->values->p[place->index] : &system->values->y[place->index];
}

static double nominal(void *context, size_t i)
{
    (void)context, (void)i;
    return 1.0;
}

static const char *name(void *context, size_t i)
{
    (void)context;
    return model.initial_unknowns[i].name;
}

static bool evaluate(void *context, double *residual)
{
    Values *values = ((const InitialSystem *)context)->values;
    model_dependent_parameters(values->p);
    if (!model_algebraics(values->time, values->y, values->p))
        return false;
    model_initial_residual(values->time, values->y, values->p, residual);
    return true;
}

/* Forward differences, with steps that are exact in binary. The model's tangents cannot replace them: they include
 * discrete variables that depend on others, whereas all discrete variables are constant here. */
static bool differentiate(void *context, const double *residual, double *jacobian)
{
    const InitialSystem *system = context;
    const size_t n = model.n_initial_unknowns;
    for (size_t j = 0; j < n; ++j) {
        double *place = unknown(context, j);
        const double centre = *place;
        *place = centre + sqrt(DBL_EPSILON) * fmax(fabs(centre), 1e-3);
        const double width = *place - centre;
        const bool evaluated = evaluate(context, system->trial);
        *place = centre;
        if (!evaluated)
            return false;
        for (size_t i = 0; i < n; ++i)
            jacobian[i * n + j] = (system->trial[i] - residual[i]) / width;
    }
    return true;
}

/* Solves the initial equations; returns NULL on success, else a description of the failure. */
static const char *solve(InitialSystem *initial, char text[NEWTON_TEXT_SIZE])
{
    const NewtonSystem system = {.size = model.n_initial_unknowns,
                                 .guessed = true,
                                 .context = initial,
                                 .unknown = unknown,
                                 .nominal = nominal,
                                 .name = name,
                                 .evaluate = evaluate,
                                 .linearize = differentiate};
    const NewtonResult result = newton_solve(&system);
    const Values *values = initial->values;
    if (result == NEWTON_SOLVED || (newton_blames_guess(result) && newton_solve_beside(&system)))
        return NULL;
    if (result == NEWTON_NOT_FINITE && !model_algebraics(values->time, values->y, values->p))
        return blocks_explain(values->time, values->y, values->p, text);
    return newton_explain(&system, result, "the initial equations", text);
}

/* Returns the squared norm of the residual; INFINITY if it cannot be computed. */
static double residual_norm(InitialSystem *system)
{
    double sum = 0.0;
    if (!evaluate(system, system->trial))
        return INFINITY;
    for (size_t i = 0; i < model.n_initial_unknowns; ++i)
        sum += system->trial[i] * system->trial[i];
    return isfinite(sum) ? sum : INFINITY;
}

static void set_initial_event(Values *values, double value)
{
    if (model.initial_event_slot != NO_SLOT)
        values->p[model.initial_event_slot] = value;
}

/* During initialization, a when-clause acts only through initial() (Modelica 3.4, section 8.6): its condition must
 * become true because of initial(). */
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

/* Alternates between initial equations and discrete variables, which depend on each other through relations. */
static const char *settle_together(InitialSystem *system, Iteration *iteration)
{
    const Values *values = system->values;
    for (int round = 0; round < MAX_ROUNDS; ++round) {
        const char *problem = model.n_initial_unknowns > 0 ? solve(system, iteration->text) : NULL;
        if (problem != NULL)
            return problem;
        const double solved = residual_norm(system);
        if (solved == INFINITY)
            return blocks_explain(values->time, values->y, values->p, iteration->text);
        problem = settle_initially(iteration, system->values);
        if (problem != NULL)
            return problem;
        if (residual_norm(system) <= solved)
            return NULL;
    }
    return "the initial values do not settle: equations and relations change each other in a circle";
}

static void keep(const Values *values, double *kept)
{
    memcpy(kept, values->y, model.n_y * sizeof(double));
    memcpy(kept + model.n_y, values->p, model.n_p * sizeof(double));
}

static void restore(Values *values, const double *kept)
{
    memcpy(values->y, kept, model.n_y * sizeof(double));
    memcpy(values->p, kept + model.n_y, model.n_p * sizeof(double));
}

/* Solves with the simplified expressions of homotopy() and deforms them into the actual ones; the steps become shorter
 * where no solution is found. Returns whether it succeeded; if not, the values are undefined. */
static bool deform(InitialSystem *system, Iteration *iteration, double *kept)
{
    Values *values = system->values;
    double *const distance = &values->p[model.homotopy_slot];
    *distance = 1.0;
    if (settle_together(system, iteration) != NULL)
        return false;
    for (double step = FIRST_STEP; *distance > 0.0 && step >= SHORTEST_STEP;) {
        keep(values, kept);
        *distance = fmax(*distance - step, 0.0);
        if (settle_together(system, iteration) != NULL) {
            restore(values, kept);
            step /= 2.0;
        }
    }
    return *distance == 0.0;
}

/* If there are several solutions, the one reached by homotopy() is taken; if it reaches none, the one near the start
 * values. */
static const char *settle_from_simplified(InitialSystem *system, Iteration *iteration)
{
    if (model.homotopy_slot == NO_SLOT)
        return settle_together(system, iteration);
    const size_t size = model.n_y + model.n_p;
    double *start = malloc(2 * size * sizeof(double));
    if (start == NULL)
        return "out of memory";
    keep(system->values, start);
    const char *problem = NULL;
    if (!deform(system, iteration, start + size)) {
        restore(system->values, start);
        problem = settle_together(system, iteration);
    }
    free(start);
    return problem;
}

/* Commits the states and conditions of the initial pass as reference for pre() and edges in later events. */
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
    const char *problem = settle_from_simplified(system, iteration);
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
    InitialSystem system = {values, malloc((model.n_initial_unknowns + 1) * sizeof(double))};
    EventStatus status = EVENT_ERROR;
    model_dependent_parameters(values->p);
    model_start_values(values->time, values->y, values->p);
    clocks_start(values);
    if (iteration_create(&iteration) && system.trial != NULL)
        status = initialize(&system, &iteration, reporter);
    else
        reporter->report(reporter->context, ACTION_ERROR, "out of memory");
    iteration_free(&iteration);
    free(system.trial);
    return status;
}
