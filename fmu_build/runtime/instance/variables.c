#include "variables.h"
#include "evaluation.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

static const char *const type_names[] = {[TYPE_REAL] = "Real",
                                         [TYPE_INTEGER] = "Integer",
                                         [TYPE_BOOLEAN] = "Boolean",
                                         [TYPE_ENUMERATION] = "Enumeration"};
static const char *const causality_names[] = {
    [CAUSALITY_PARAMETER] = "parameter", [CAUSALITY_CALCULATED_PARAMETER] = "calculated parameter",
    [CAUSALITY_INPUT] = "input",         [CAUSALITY_OUTPUT] = "output",
    [CAUSALITY_LOCAL] = "local variable", [CAUSALITY_INDEPENDENT] = "independent variable"};
static const char *const variability_names[] = {[VARIABILITY_CONSTANT] = "constant",
                                                [VARIABILITY_FIXED] = "fixed",
                                                [VARIABILITY_TUNABLE] = "tunable",
                                                [VARIABILITY_DISCRETE] = "discrete",
                                                [VARIABILITY_CONTINUOUS] = "continuous"};

const Variable *variable_find(const Instance *instance, size_t reference, unsigned types, const char *wanted)
{
    if (reference >= model.n_variables) {
        log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR,
                    "There is no variable with value reference %zu; the last one is %zu.", reference,
                    model.n_variables - 1);
        return NULL;
    }
    const Variable *variable = &model.variables[reference];
    if ((variable->type & types) == 0) {
        log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR, "Variable \"%s\" is of type %s, not %s.",
                    variable->name, type_names[variable->type], wanted);
        return NULL;
    }
    return variable;
}

static bool fail_not_a_number(const Instance *instance, const Variable *variable)
{
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR,
                "At time %.9g %s is not a number: a function outside of its domain, zero divided by zero, or an index "
                "out of its bounds.",
                instance->values.time, variable->name);
    return false;
}

/* Before the initialization, only start values can be read. */
static bool read_start(const Instance *instance, const Variable *variable, double *value)
{
    const bool has_start = variable->initial == INITIAL_EXACT || variable->initial == INITIAL_APPROX ||
                           variable->causality == CAUSALITY_INPUT;
    if (has_start && variable->store == STORE_STATE_OR_ALGEBRAIC) {
        *value = instance->start.y[variable->index];
        return true;
    }
    if (has_start && variable->store == STORE_PARAMETER) {
        *value = instance->start.p[variable->index];
        return true;
    }
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR,
                "Variable \"%s\" has no value before the initialization.", variable->name);
    return false;
}

bool variable_compute(Instance *instance, const Variable *variable, double *value)
{
    if (instance->phase == PHASE_INSTANTIATED)
        return read_start(instance, variable, value);
    if (instance->phase == PHASE_INITIALIZATION && instance_initialize(instance) != STATUS_OK)
        return false;
    const Values *values = &instance->values;
    switch (variable->store) {
    case STORE_STATE_OR_ALGEBRAIC:
        if (variable->index >= model.n_states && !evaluation_update_algebraics(instance))
            return false;
        *value = values->y[variable->index];
        return !isnan(*value) || fail_not_a_number(instance, variable);
    case STORE_PARAMETER:
        evaluation_update_parameters(instance);
        *value = values->p[variable->index];
        return true;
    case STORE_DERIVATIVE:
        if (!evaluation_update_derivatives(instance))
            return false;
        *value = instance->derivatives[variable->index];
        return true;
    case STORE_TIME:
        *value = values->time;
        return true;
    }
    return false;
}

bool variable_fits(const Instance *instance, const Variable *variable, double value)
{
    if ((variable->type & (TYPE_INTEGER | TYPE_ENUMERATION)) == 0 || (value >= INT32_MIN && value <= INT32_MAX))
        return true;
    log_message(&instance->log, LOG_STATUS_ERROR, STATUS_ERROR,
                "At time %.9g %s is %.17g, outside of the range of 32-bit integers, %" PRId32 " to %" PRId32 ".",
                instance->values.time, variable->name, value, INT32_MIN, INT32_MAX);
    return false;
}

static bool is_state(const Variable *variable)
{
    return variable->store == STORE_STATE_OR_ALGEBRAIC && variable->index < model.n_states;
}

const char *variable_name_of_state(size_t index)
{
    for (size_t i = 0; i < model.n_variables; ++i)
        if (is_state(&model.variables[i]) && model.variables[i].index == index)
            return model.variables[i].name;
    return "";
}

/* Returns whether an event sets the state: a reinit(), or any event if it is a sensitivity. */
static bool is_reinitialized(size_t state)
{
    if (model.sensitivities != NULL && state >= model.sensitivities->n_states)
        return true;
    for (size_t i = 0; i < model.n_discrete; ++i)
        if (model.discrete[i].kind == DISCRETE_REINIT && model.discrete[i].index == state)
            return true;
    return false;
}

/* Which variables may be set in which phase: FMI 2.0.5, notes to the tables in sections 3.2.3 and 4.2.4; FMI 3.0.2,
 * states in sections 2.3, 3.2 and 4.2. */
static bool is_settable_now(const Instance *instance, const Variable *variable)
{
    const bool input = variable->causality == CAUSALITY_INPUT;
    const bool tunable =
        variable->causality == CAUSALITY_PARAMETER && variable->variability == VARIABILITY_TUNABLE;
    switch (instance->phase) {
    case PHASE_INSTANTIATED:
        return input || (variable->variability != VARIABILITY_CONSTANT &&
                         (variable->initial == INITIAL_EXACT || variable->initial == INITIAL_APPROX));
    case PHASE_INITIALIZATION:
        return input || (variable->variability != VARIABILITY_CONSTANT && variable->initial == INITIAL_EXACT);
    case PHASE_EVENT:
        return input || tunable ||
               (is_state(variable) && instance->face->states_settable_in_event_mode &&
                !is_reinitialized(variable->index));
    case PHASE_STEP_COMPLETE:
        return input || tunable;
    case PHASE_CONTINUOUS_TIME:
        return (input && variable->variability == VARIABILITY_CONTINUOUS) || is_state(variable);
    case PHASE_INTERMEDIATE:
        return input && variable->variability == VARIABILITY_CONTINUOUS;
    default:
        return false;
    }
}

bool variable_may_set(const Instance *instance, const Variable *variable, double value)
{
    const Log *log = &instance->log;
    if (!is_settable_now(instance, variable)) {
        log_message(log, LOG_STATUS_ERROR, STATUS_ERROR, "Variable \"%s\", a %s %s, cannot be set %s.",
                    variable->name, variability_names[variable->variability], causality_names[variable->causality],
                    variable->causality == CAUSALITY_PARAMETER && variable->initial == INITIAL_EXACT &&
                            variable->variability != VARIABILITY_CONSTANT
                        ? "after the initialization"
                        : "now");
        return false;
    }
    if (!isfinite(value)) {
        log_message(log, LOG_STATUS_ERROR, STATUS_ERROR, "Variable \"%s\" cannot be %g: a finite number is needed.",
                    variable->name, value);
        return false;
    }
    if (value < variable->min || value > variable->max) {
        log_message(log, LOG_STATUS_ERROR, STATUS_ERROR,
                    "Variable \"%s\" cannot be %.9g: the allowed range is %.9g to %.9g.", variable->name, value,
                    variable->min, variable->max);
        return false;
    }
    return true;
}

void variables_not_finite(const Values *values, const double *derivatives, char *text, size_t size)
{
    enum { MOST_NAMES = 3 };
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0, named = 0; derivatives != NULL && i < model.n_variables && named < MOST_NAMES; ++i) {
        const Variable *variable = &model.variables[i];
        const bool is_derivative = variable->store == STORE_DERIVATIVE;
        if (!is_derivative && variable->store != STORE_STATE_OR_ALGEBRAIC)
            continue;
        if (isfinite(is_derivative ? derivatives[variable->index] : values->y[variable->index]))
            continue;
        const size_t room = size - length;
        const int written = snprintf(text + length, room, "%s%s", named == 0 ? "" : ", ", variable->name);
        if (written < 0 || (size_t)written >= room)
            return; /* the last name is cut off */
        length += (size_t)written;
        ++named;
    }
}

void variable_set(Instance *instance, const Variable *variable, double value)
{
    const bool before_start = instance->phase == PHASE_INSTANTIATED || instance->phase == PHASE_INITIALIZATION;
    Values *values = before_start ? &instance->start : &instance->values;
    double *place = variable->store == STORE_PARAMETER ? &values->p[variable->index] : &values->y[variable->index];
    if (*place == value)
        return;
    *place = value;
    if (before_start) {
        instance->current.initialization = false;
        return;
    }
    if (instance->phase != PHASE_CONTINUOUS_TIME)
        instance->changed.any = true;
    if (variable->causality == CAUSALITY_PARAMETER)
        instance->changed.parameters = instance->changed.discrete = true;
    if (variable->variability != VARIABILITY_CONTINUOUS)
        instance->changed.discrete = true;
    evaluation_invalidate(instance);
}
