/* calls.h - the importer's calls, independent of the FMI version.
 *
 * The files fmi2_* and fmi3_* translate: they know the names and types of their standard and its tables of allowed
 * calls. The functions for the calls, below, take the result of call_enter and return STATUS_ERROR if it is NULL. A
 * rejected call reports why and changes no value of the instance. */
#ifndef CALLS_H
#define CALLS_H

#include "derivatives.h"

#include <stdint.h>

/* One row of a standard's table of allowed calls: bit n of a mask stands for phase n. */
typedef struct {
    const char *name;
    unsigned model_exchange, co_simulation;
} Rule;

/* Returns the instance if the rule allows the call in its phase; else NULL, after a message. */
Instance *call_enter(Instance *instance, const Rule *rule);

/* Logs what is wrong with the current call, and returns STATUS_ERROR. */
#if defined __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
Status call_refuse(const Instance *instance, const char *format, ...);

/* Returns false, after a message, if an array of n elements is missing; false if there is no instance. */
bool call_has(const Instance *instance, size_t n, const void *array);

/* Ends a call: a failure puts the instance in PHASE_ERROR, a reported warning turns STATUS_OK into STATUS_WARNING. */
Status call_finish(Instance *instance, Status status);

/* Creation: returns why these arguments cannot make an instance, or NULL. */
const char *call_fault_of_creation(const char *name, const char *token);

/* The life cycle. */
Status call_set_logging(Instance *instance, bool on, size_t n, const char *const *categories);
Status call_enter_initialization(Instance *instance);
Status call_exit_initialization(Instance *instance);
Status call_terminate(Instance *instance);
Status call_reset(Instance *instance);

/* Variables, in the importer's types. */
typedef enum { NUMBER_DOUBLE, NUMBER_INT32, NUMBER_INT64, NUMBER_INT32_TRUTH, NUMBER_BYTE_TRUTH } NumberType;
typedef struct {
    unsigned value_types; /* of the model, ValueType */
    NumberType stored;
    const char *name; /* in the standard */
} AccessType;
Status call_get_real(Instance *instance, const unsigned *references, size_t n, double *values);
Status call_get(Instance *instance, const AccessType *type, const unsigned *references, size_t n, void *values);
Status call_set(Instance *instance, const AccessType *type, const unsigned *references, size_t n, const void *values);
/* Access to types that no model's variables have. */
Status call_access_nothing(const Instance *instance, const char *type, size_t n);

/* Partial derivatives. */
Status call_get_directional_derivative(Instance *instance, const Partials *partials, const double *seed, size_t n_seed,
                                       double *sensitivity, size_t n_sensitivity);
Status call_get_adjoint_derivative(Instance *instance, const Partials *partials, const double *seed, size_t n_seed,
                                   double *sensitivity, size_t n_sensitivity);

/* Saved states, which importers keep as void pointers. */
Status call_get_state(const Instance *instance, void **state);
Status call_set_state(Instance *instance, const void *state);
Status call_free_state(const Instance *instance, void **state);
Status call_state_size(const Instance *instance, const void *state, size_t *size);
Status call_serialize_state(const Instance *instance, const void *state, void *bytes, size_t size);
Status call_deserialize_state(const Instance *instance, const void *bytes, size_t size, void **state);

/* Event Mode. */
typedef struct {
    bool terminate, states_changed;
    double next_time; /* INFINITY for none */
} EventOutcome;
Status call_enter_event_mode(Instance *instance);
Status call_update_discrete_states(Instance *instance, EventOutcome *outcome);

/* Model Exchange. */
Status call_enter_continuous_time_mode(Instance *instance);
Status call_completed_step(Instance *instance, bool *terminate);
Status call_set_time(Instance *instance, double time);
Status call_set_states(Instance *instance, const double *states, size_t n);
Status call_get_states(Instance *instance, double *states, size_t n);
Status call_get_derivatives(Instance *instance, double *derivatives, size_t n);
Status call_get_event_indicators(Instance *instance, double *indicators, size_t n);
Status call_get_nominals(Instance *instance, double *nominals, size_t n);

/* Co-Simulation. */
Status call_get_output_derivatives(Instance *instance, const unsigned *references, size_t n, const int *orders,
                                   double *values);
Status call_enter_step_mode(Instance *instance);
Status call_do_step(Instance *instance, double point, double step);

#endif
