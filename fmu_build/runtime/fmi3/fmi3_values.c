/* FMI 3.0: reading and setting variables. */
#include "fmi3_intermediate.h"

static const AccessType float64_type = {TYPE_REAL, NUMBER_DOUBLE, "Float64"};
static const AccessType int32_type = {TYPE_INTEGER, NUMBER_INT32, "Int32"};
static const AccessType int64_type = {TYPE_ENUMERATION, NUMBER_INT64, "Int64"};
static const AccessType boolean_type = {TYPE_BOOLEAN, NUMBER_BYTE_TRUTH, "Boolean"};

/* Returns the instance if the sizes of the arrays match and no intermediate update forbids the access; else NULL. */
static Instance *enter(fmi3Instance handle, Call call, bool setting, const fmi3ValueReference references[], size_t n,
                       size_t n_values)
{
    Instance *instance = fmi3_enter(handle, call);
    if (!call_has(instance, n, references))
        return NULL;
    if (n != n_values) {
        call_refuse(instance, "%zu values for %zu variables, all of them scalars.", n_values, n);
        return NULL;
    }
    return intermediate_allows(handle, setting, references, n) ? instance : NULL;
}

/* The value references of event indicators follow those of the variables. */
static bool is_event_indicator(const Instance *instance, fmi3ValueReference reference)
{
    return reference >= model.n_variables && reference - model.n_variables < model.n_roots &&
           instance->phase != PHASE_INSTANTIATED;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Float64 values[], size_t nValues)
{
    Instance *entered = enter(instance, CALL_GetFloat64, false, valueReferences, nValueReferences, nValues);
    Status status = call_has(entered, nValueReferences, values) ? STATUS_OK : STATUS_ERROR;
    const double *indicators = NULL; /* computed at most once */
    for (size_t i = 0; status == STATUS_OK && i < nValueReferences; ++i) {
        const fmi3ValueReference reference = valueReferences[i];
        if (!is_event_indicator(entered, reference)) {
            status = call_get_real(entered, &reference, 1, &values[i]);
            continue;
        }
        if (indicators == NULL) {
            status = call_get_event_indicators(entered, entered->roots.work[0], model.n_roots);
            indicators = entered->roots.work[0];
        }
        values[i] = indicators[reference - model.n_variables];
    }
    return fmi3_leave(instance, status);
}

#define GETTER(NAME, TYPE)                                                                                            \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[],                       \
                             size_t nValueReferences, fmi3##NAME values[], size_t nValues)                            \
    {                                                                                                                 \
        Instance *entered = enter(instance, CALL_Get##NAME, false, valueReferences, nValueReferences, nValues);       \
        return fmi3_leave(instance, call_get(entered, TYPE, valueReferences, nValueReferences, values));              \
    }
#define SETTER(NAME, TYPE)                                                                                            \
    fmi3Status fmi3Set##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[],                       \
                             size_t nValueReferences, const fmi3##NAME values[], size_t nValues)                      \
    {                                                                                                                 \
        Instance *entered = enter(instance, CALL_Set##NAME, true, valueReferences, nValueReferences, nValues);        \
        return fmi3_leave(instance, call_set(entered, TYPE, valueReferences, nValueReferences, values));              \
    }

GETTER(Int32, &int32_type)
GETTER(Int64, &int64_type)
GETTER(Boolean, &boolean_type)
SETTER(Float64, &float64_type)
SETTER(Int32, &int32_type)
SETTER(Int64, &int64_type)
SETTER(Boolean, &boolean_type)

/* Both functions for partial derivatives have the same arguments. */
#define DERIVATIVE(NAME, GET)                                                                                         \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,            \
                             const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],             \
                             size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)                            \
    {                                                                                                                 \
        const Partials partials = {unknowns, nUnknowns, knowns, nKnowns};                                             \
        Instance *entered = fmi3_enter(instance, CALL_Get##NAME);                                                     \
        return fmi3_leave(instance, GET(entered, &partials, seed, nSeed, sensitivity, nSensitivity));                 \
    }

DERIVATIVE(DirectionalDerivative, call_get_directional_derivative)
DERIVATIVE(AdjointDerivative, call_get_adjoint_derivative)
