#include "derivatives.h"
#include "block.h"
#include "evaluation.h"
#include "linear.h"
#include "variables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The present point with its algebraic variables, and the tangents at this point. */
typedef struct {
    const Instance *instance;
    bool initial; /* whether the values are results of the initialization */
    double *memory; /* holds the arrays below */
    double *y, *dy, *dp, *dder;
    double *moves;    /* [n_initial_unknowns] */
    double *jacobian; /* of the initial equations, factored */
    size_t *pivot;
    double dtime;
} Tangents;

static bool fail(const Instance *instance, const char *why)
{
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "The derivatives at time %.9g are not known: %s.",
                instance->values.time, why);
    return false;
}

static bool is_state(const Variable *variable)
{
    return variable->store == STORE_STATE_OR_ALGEBRAIC && variable->index < model.n_states;
}

static bool is_known(const Instance *instance, const Variable *variable)
{
    if (variable->causality == CAUSALITY_INDEPENDENT || variable->causality == CAUSALITY_INPUT)
        return true;
    if (instance->phase == PHASE_INITIALIZATION && variable->initial != INITIAL_EXACT)
        return false;
    return is_state(variable) || variable->causality == CAUSALITY_PARAMETER;
}

static bool is_unknown(const Variable *variable)
{
    return variable->causality != CAUSALITY_INDEPENDENT && variable->causality != CAUSALITY_INPUT &&
           variable->causality != CAUSALITY_PARAMETER && variable->variability != VARIABILITY_CONSTANT;
}

static bool check(const Instance *instance, const Partials *partials)
{
    for (size_t i = 0; i < partials->n_unknowns; ++i) {
        const Variable *variable = variable_find(instance, partials->unknowns[i], TYPE_REAL, "Real");
        if (variable == NULL)
            return false;
        if (!is_unknown(variable)) {
            log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR,
                        "Variable \"%s\" has no derivative: it is not computed.", variable->name);
            return false;
        }
    }
    for (size_t k = 0; k < partials->n_knowns; ++k) {
        const Variable *variable = variable_find(instance, partials->knowns[k], TYPE_REAL, "Real");
        if (variable == NULL)
            return false;
        if (!is_known(instance, variable)) {
            log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR,
                        "There are no derivatives with respect to variable \"%s\": it is %s.", variable->name,
                        is_state(variable) ? "an unknown of the initialization"
                                           : "neither a state nor an input, a parameter or the time");
            return false;
        }
    }
    return true;
}

/* Computes all tangents from those of the states and the independent parameters. */
static bool propagate(Tangents *tangents)
{
    const Values *values = &tangents->instance->values;
    model_parameter_tangents(values->p, tangents->dp);
    return model_tangents(values->time, tangents->y, values->p, tangents->dtime, tangents->dy, tangents->dp,
                          tangents->dder);
}

static void rest(Tangents *tangents)
{
    memset(tangents->dy, 0, model.n_y * sizeof(double));
    memset(tangents->dp, 0, model.n_p * sizeof(double));
    tangents->dtime = 0.0;
}

static double *initial_unknown(const Tangents *tangents, size_t i)
{
    const InitialUnknown *place = &model.initial_unknowns[i];
    return place->store == STORE_PARAMETER ? &tangents->dp[place->index] : &tangents->dy[place->index];
}

static bool move_initial_residuals(Tangents *tangents)
{
    const Values *values = &tangents->instance->values;
    if (!propagate(tangents))
        return false;
    model_initial_residual_tangents(values->time, tangents->y, values->p, tangents->dtime, tangents->dy, tangents->dp,
                                    tangents->moves);
    return true;
}

static bool factor_initial_equations(Tangents *tangents)
{
    const size_t n = model.n_initial_unknowns;
    for (size_t j = 0; j < n; ++j) {
        rest(tangents);
        *initial_unknown(tangents, j) = 1.0;
        if (!move_initial_residuals(tangents))
            return false;
        for (size_t i = 0; i < n; ++i)
            tangents->jacobian[i * n + j] = tangents->moves[i];
    }
    return lu_factor(n, tangents->jacobian, tangents->pivot);
}

/* Computes the tangents of states and parameters that result from initialization from those of its inputs. */
static bool propagate_to_start(Tangents *tangents)
{
    const Values *values = &tangents->instance->values;
    const size_t n = model.n_initial_unknowns;
    model_parameter_tangents(values->p, tangents->dp);
    model_start_tangents(tangents->y, values->p, tangents->dy, tangents->dp);
    for (size_t i = 0; i < n; ++i)
        *initial_unknown(tangents, i) = 0.0;
    if (n == 0)
        return true;
    if (!move_initial_residuals(tangents))
        return false;
    lu_solve(n, tangents->jacobian, tangents->pivot, tangents->moves);
    for (size_t i = 0; i < n; ++i)
        *initial_unknown(tangents, i) = -tangents->moves[i];
    return true;
}

static bool allocate(Tangents *tangents)
{
    const size_t n = model.n_initial_unknowns;
    const size_t n_doubles = 2 * model.n_y + model.n_p + model.n_states + n + n * n;
    tangents->memory = malloc(n_doubles * sizeof(double) + (n + 1) * sizeof(size_t));
    if (tangents->memory == NULL)
        return false;
    tangents->y = tangents->memory;
    tangents->dy = tangents->y + model.n_y;
    tangents->dp = tangents->dy + model.n_y;
    tangents->dder = tangents->dp + model.n_p;
    tangents->moves = tangents->dder + model.n_states;
    tangents->jacobian = tangents->moves + n;
    tangents->pivot = (size_t *)(tangents->memory + n_doubles);
    return true;
}

static bool fail_to_solve(const Tangents *tangents)
{
    const Values *values = &tangents->instance->values;
    char why[NEWTON_TEXT_SIZE];
    return fail(tangents->instance, blocks_explain(values->time, tangents->y, values->p, why));
}

/* Copies y and computes the algebraic variables in the copy. The instance's own are left alone, because they serve as
 * initial guesses later and must not depend on this call. */
static bool copy_point(Tangents *tangents, Instance *instance)
{
    if (tangents->initial && instance_initialize(instance) != STATUS_OK)
        return false;
    const Values *values = &instance->values;
    evaluation_update_parameters(instance);
    if (model.n_y > 0)
        memcpy(tangents->y, values->y, model.n_y * sizeof(double));
    return instance->current.algebraics || model_algebraics(values->time, tangents->y, values->p) ||
           fail_to_solve(tangents);
}

static bool begin(Tangents *tangents, Instance *instance, const Partials *partials)
{
    tangents->instance = instance;
    tangents->initial = instance->phase == PHASE_INITIALIZATION;
    if (!model.has_tangents)
        return fail(instance, "the model does not provide them");
    if (!check(instance, partials))
        return false;
    if (tangents->initial && !model.has_initial_tangents)
        return fail(instance, "a when-clause may act in the initialization");
    if (!allocate(tangents))
        return fail(instance, "out of memory");
    if (!copy_point(tangents, instance))
        return false;
    return !tangents->initial || factor_initial_equations(tangents) ||
           fail(instance, "the initial equations do not determine their unknowns");
}

static void move_known(Tangents *tangents, const Variable *variable, double by)
{
    switch (variable->store) {
    case STORE_TIME:
        tangents->dtime += by;
        break;
    case STORE_PARAMETER:
        tangents->dp[variable->index] += by;
        break;
    default:
        tangents->dy[variable->index] += by;
    }
}

static double tangent_of(const Tangents *tangents, const Variable *variable)
{
    switch (variable->store) {
    case STORE_DERIVATIVE:
        return tangents->dder[variable->index];
    case STORE_PARAMETER:
        return tangents->dp[variable->index];
    default:
        return tangents->dy[variable->index];
    }
}

static bool propagate_knowns(Tangents *tangents)
{
    return ((!tangents->initial || propagate_to_start(tangents)) && propagate(tangents)) ||
           fail_to_solve(tangents);
}

static bool read_unknown(const Tangents *tangents, unsigned reference, double *tangent)
{
    const Variable *variable = &model.variables[reference];
    *tangent = tangent_of(tangents, variable);
    if (isfinite(*tangent))
        return true;
    log_message(&tangents->instance->log, LOG_STATUS_ERROR, STATUS_ERROR,
                "At time %.9g variable \"%s\" has no finite derivative in this direction.",
                tangents->instance->values.time, variable->name);
    return false;
}

static bool directional(Tangents *tangents, const Partials *partials, const double *seed, double *sensitivity)
{
    rest(tangents);
    for (size_t k = 0; k < partials->n_knowns; ++k)
        move_known(tangents, &model.variables[partials->knowns[k]], seed[k]);
    if (!propagate_knowns(tangents))
        return false;
    for (size_t i = 0; i < partials->n_unknowns; ++i)
        if (!read_unknown(tangents, partials->unknowns[i], &sensitivity[i]))
            return false;
    return true;
}

static bool adjoint(Tangents *tangents, const Partials *partials, const double *seed, double *sensitivity)
{
    for (size_t k = 0; k < partials->n_knowns; ++k) {
        rest(tangents);
        move_known(tangents, &model.variables[partials->knowns[k]], 1.0);
        if (!propagate_knowns(tangents))
            return false;
        sensitivity[k] = 0.0;
        for (size_t i = 0; i < partials->n_unknowns; ++i) {
            double tangent;
            if (!read_unknown(tangents, partials->unknowns[i], &tangent))
                return false;
            sensitivity[k] += seed[i] * tangent;
        }
    }
    return true;
}

bool derivatives_directional(Instance *instance, const Partials *partials, const double *seed, double *sensitivity)
{
    Tangents tangents = {0};
    const bool known =
        begin(&tangents, instance, partials) && directional(&tangents, partials, seed, sensitivity);
    free(tangents.memory);
    return known;
}

bool derivatives_adjoint(Instance *instance, const Partials *partials, const double *seed, double *sensitivity)
{
    Tangents tangents = {0};
    const bool known = begin(&tangents, instance, partials) && adjoint(&tangents, partials, seed, sensitivity);
    free(tangents.memory);
    return known;
}
