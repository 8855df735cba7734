/* variables.h - reading and setting variables by value reference, with every check that setting needs. */
#ifndef VARIABLES_H
#define VARIABLES_H

#include "instance.h"

#include <math.h>
#include <stdint.h>

/* The variable of a value reference; NULL, after a message, where there is none or it has none of the types, a set
 * that the importer calls `wanted`. */
const Variable *variable_find(const Instance *instance, size_t reference, unsigned types, const char *wanted);

/* Its present value, after the equations that it needs. False, after a message, where it could not be computed. */
bool variable_compute(Instance *instance, const Variable *variable, double *value);

/* The same, by a short cut where the value is there already. */
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

/* False, after a message, where a value of an Integer variable or an enumeration, held as a double, is beyond 32 bits. */
bool variable_fits(const Instance *instance, const Variable *variable, double value);

/* The name of a state by its place among the states. */
const char *variable_name_of_state(size_t index);

/* Whether it may be set, now and to this value. False after a message that names variable, value and what is
 * allowed. */
bool variable_may_set(const Instance *instance, const Variable *variable, double value);

/* Sets it; a value that it already has is no change. */
void variable_set(Instance *instance, const Variable *variable, double value);

#endif
