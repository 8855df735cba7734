#include "calls.h"
#include "variables.h"

Status call_get_real(Instance *instance, const unsigned *references, size_t n, double *values)
{
    if (!call_has(instance, n, references) || !call_has(instance, n, values))
        return STATUS_ERROR;
    for (size_t i = 0; i < n; ++i) {
        const Variable *variable = variable_find(instance, references[i], TYPE_REAL, "Real");
        if (variable == NULL || !variable_get(instance, variable, &values[i]))
            return STATUS_ERROR;
    }
    return STATUS_OK;
}

static void store(NumberType type, void *values, size_t i, double number)
{
    switch (type) {
    case NUMBER_DOUBLE:
        ((double *)values)[i] = number;
        break;
    case NUMBER_INT32:
        ((int32_t *)values)[i] = (int32_t)number;
        break;
    case NUMBER_INT64:
        ((int64_t *)values)[i] = (int64_t)number;
        break;
    case NUMBER_INT32_TRUTH:
        ((int32_t *)values)[i] = number != 0.0;
        break;
    case NUMBER_BYTE_TRUTH:
        ((unsigned char *)values)[i] = number != 0.0;
        break;
    }
}

static double load(NumberType type, const void *values, size_t i)
{
    switch (type) {
    case NUMBER_DOUBLE:
        return ((const double *)values)[i];
    case NUMBER_INT32:
        return (double)((const int32_t *)values)[i];
    case NUMBER_INT64:
        return (double)((const int64_t *)values)[i];
    case NUMBER_INT32_TRUTH:
        return ((const int32_t *)values)[i] != 0 ? 1.0 : 0.0;
    case NUMBER_BYTE_TRUTH:
        return ((const unsigned char *)values)[i] != 0 ? 1.0 : 0.0;
    }
    return 0.0;
}

Status call_get(Instance *instance, const AccessType *type, const unsigned *references, size_t n, void *values)
{
    if (!call_has(instance, n, references) || !call_has(instance, n, values))
        return STATUS_ERROR;
    for (size_t i = 0; i < n; ++i) {
        const Variable *variable = variable_find(instance, references[i], type->value_types, type->name);
        double number;
        if (variable == NULL || !variable_get(instance, variable, &number) ||
            !variable_fits(instance, variable, number))
            return STATUS_ERROR;
        store(type->stored, values, i, number);
    }
    return STATUS_OK;
}

/* All or nothing: no variable changes if one of them cannot be set. */
Status call_set(Instance *instance, const AccessType *type, const unsigned *references, size_t n, const void *values)
{
    if (!call_has(instance, n, references) || !call_has(instance, n, values))
        return STATUS_ERROR;
    for (size_t i = 0; i < n; ++i) {
        const Variable *variable = variable_find(instance, references[i], type->value_types, type->name);
        if (variable == NULL || !variable_may_set(instance, variable, load(type->stored, values, i)))
            return STATUS_ERROR;
    }
    for (size_t i = 0; i < n; ++i)
        variable_set(instance, &model.variables[references[i]], load(type->stored, values, i));
    return STATUS_OK;
}

Status call_access_nothing(const Instance *instance, const char *type, size_t n)
{
    if (instance == NULL)
        return STATUS_ERROR;
    return n == 0 ? STATUS_OK : call_refuse(instance, "the model has no variable of type %s.", type);
}

static bool has_arrays(const Instance *instance, const Partials *partials, const double *seed, size_t n_seed,
                       size_t expected_seed, const double *sensitivity, size_t n_sensitivity,
                       size_t expected_sensitivity)
{
    if (!call_has(instance, partials->n_unknowns, partials->unknowns) ||
        !call_has(instance, partials->n_knowns, partials->knowns) || !call_has(instance, n_seed, seed) ||
        !call_has(instance, n_sensitivity, sensitivity))
        return false;
    if (n_seed == expected_seed && n_sensitivity == expected_sensitivity)
        return true;
    call_refuse(instance, "a seed of %zu and a sensitivity of %zu values; %zu and %zu are needed, as all variables are "
                "scalars.", n_seed, n_sensitivity, expected_seed, expected_sensitivity);
    return false;
}

Status call_get_directional_derivative(Instance *instance, const Partials *partials, const double *seed, size_t n_seed,
                                       double *sensitivity, size_t n_sensitivity)
{
    return has_arrays(instance, partials, seed, n_seed, partials->n_knowns, sensitivity, n_sensitivity,
                      partials->n_unknowns) &&
                   derivatives_directional(instance, partials, seed, sensitivity)
               ? STATUS_OK
               : STATUS_ERROR;
}

Status call_get_adjoint_derivative(Instance *instance, const Partials *partials, const double *seed, size_t n_seed,
                                   double *sensitivity, size_t n_sensitivity)
{
    return has_arrays(instance, partials, seed, n_seed, partials->n_unknowns, sensitivity, n_sensitivity,
                      partials->n_knowns) &&
                   derivatives_adjoint(instance, partials, seed, sensitivity)
               ? STATUS_OK
               : STATUS_ERROR;
}
