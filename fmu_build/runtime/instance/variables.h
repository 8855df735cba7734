/* variables.h - access to variables by value reference, with all checks that setting requires. */
#ifndef VARIABLES_H
#define VARIABLES_H

#include "instance.h"

#include <math.h>
#include <stdint.h>

/* Returns the variable with a value reference; NULL, after a message, if there is none or its type is not in the set
 * `types`. Messages use `wanted` as the importer's name for the types. */
const Variable *variable_find(const Instance *instance, size_t reference, unsigned types, const char *wanted);

/* Evaluates the equations needed and returns the variable's value in *value. Returns false, after a message, on
 * failure. */
bool variable_compute(Instance *instance, const Variable *variable, double *value);

/* The same, with a shortcut if the value is already available. */
static inline bool variable_get(Instance *instance, const Variable *variable, double *value)
{
    if (instance->phase > PHASE_INITIALIZATION && variable->store == STORE_STATE_OR_ALGEBRAIC &&
        (variable->index < model.n_states || instance->current.algebraics)) {
        *value = instance->values.y[variable->index];
        if (!isnan(*value))
            return true;
    }
    return variable_compute(instance, variable, value);
}

/* Returns false, after a message, if the value of an Integer or enumeration, stored as a double, exceeds 32 bits. */
bool variable_fits(const Instance *instance, const Variable *variable, double value);

/* Returns the name of a state by its index in y. */
const char *variable_name_of_state(size_t index);

/* Writes the names of the first variables that are not finite, with these derivatives, separated by commas; nothing
 * without derivatives. */
void variables_not_finite(const Values *values, const double *derivatives, char *text, size_t size);

/* Returns whether the variable may be set in this phase and to this value; if not, a message names the variable, the
 * value and what is allowed. */
bool variable_may_set(const Instance *instance, const Variable *variable, double value);

/* Sets the variable; setting its present value is not a change. */
void variable_set(Instance *instance, const Variable *variable, double value);

#endif
