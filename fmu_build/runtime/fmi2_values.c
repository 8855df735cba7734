/* FMI 2.0: reading and setting variables. */
#include "fmi2_component.h"
#include "variables.h"

/* Reads one variable after checking reference and type. */
static bool read(Instance *instance, fmi2ValueReference reference, ValueType type, double *value)
{
    const Variable *variable = variable_find(instance, reference, type);
    return variable != NULL && variable_get(instance, variable, value);
}

static Instance *enter_with_arrays(fmi2Component c, Call call, size_t n, const void *references, const void *values)
{
    Instance *instance = fmi2_enter(c, call);
    if (instance == NULL || !fmi2_has_array(instance, call, n, references) ||
        !fmi2_has_array(instance, call, n, values))
        return NULL;
    return instance;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    Instance *instance = enter_with_arrays(c, CALL_GET_REAL, nvr, vr, value);
    if (instance == NULL)
        return fmi2Error;
    for (size_t i = 0; i < nvr; ++i)
        if (!read(instance, vr[i], TYPE_REAL, &value[i]))
            return fmi2Error;
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    Instance *instance = enter_with_arrays(c, CALL_GET_INTEGER, nvr, vr, value);
    if (instance == NULL)
        return fmi2Error;
    for (size_t i = 0; i < nvr; ++i) {
        const Variable *variable = variable_find(instance, vr[i], TYPE_INTEGER);
        int32_t number;
        if (variable == NULL || !variable_get_int32(instance, variable, &number))
            return fmi2Error;
        value[i] = number;
    }
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    Instance *instance = enter_with_arrays(c, CALL_GET_BOOLEAN, nvr, vr, value);
    if (instance == NULL)
        return fmi2Error;
    for (size_t i = 0; i < nvr; ++i) {
        double number;
        if (!read(instance, vr[i], TYPE_BOOLEAN, &number))
            return fmi2Error;
        value[i] = number != 0.0 ? fmi2True : fmi2False;
    }
    return fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    (void)vr;
    (void)value;
    const Instance *instance = fmi2_enter(c, CALL_GET_STRING);
    if (instance == NULL)
        return fmi2Error;
    return nvr == 0 ? fmi2OK : fmi2_refuse(instance, CALL_GET_STRING, "the model has no variable of type String.");
}

/* Where an importer's array of any of FMI's number types is read as doubles. */
typedef double (*NumberAt)(const void *values, size_t i);

static double real_at(const void *values, size_t i)
{
    return ((const fmi2Real *)values)[i];
}

static double integer_at(const void *values, size_t i)
{
    return (double)((const fmi2Integer *)values)[i];
}

static double boolean_at(const void *values, size_t i)
{
    return ((const fmi2Boolean *)values)[i] != fmi2False ? 1.0 : 0.0;
}

/* All or nothing: no variable changes where one of them cannot be set. */
static fmi2Status set(fmi2Component c, Call call, ValueType type, const fmi2ValueReference vr[], size_t nvr,
                      const void *values, NumberAt number_at)
{
    Instance *instance = enter_with_arrays(c, call, nvr, vr, values);
    if (instance == NULL)
        return fmi2Error;
    for (size_t i = 0; i < nvr; ++i) {
        const Variable *variable = variable_find(instance, vr[i], type);
        if (variable == NULL || !variable_may_set(instance, variable, number_at(values, i)))
            return fmi2Error;
    }
    for (size_t i = 0; i < nvr; ++i)
        variable_set(instance, &model.variables[vr[i]], number_at(values, i));
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    return set(c, CALL_SET_REAL, TYPE_REAL, vr, nvr, value, real_at);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    return set(c, CALL_SET_INTEGER, TYPE_INTEGER, vr, nvr, value, integer_at);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    return set(c, CALL_SET_BOOLEAN, TYPE_BOOLEAN, vr, nvr, value, boolean_at);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    (void)vr;
    (void)value;
    const Instance *instance = fmi2_enter(c, CALL_SET_STRING);
    if (instance == NULL)
        return fmi2Error;
    return nvr == 0 ? fmi2OK : fmi2_refuse(instance, CALL_SET_STRING, "the model has no variable of type String.");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown,
                                        const fmi2Real dvKnown[], fmi2Real dvUnknown[])
{
    (void)vUnknown_ref;
    (void)nUnknown;
    (void)vKnown_ref;
    (void)nKnown;
    (void)dvKnown;
    (void)dvUnknown;
    const Instance *instance = fmi2_enter(c, CALL_GET_DIRECTIONAL_DERIVATIVE);
    if (instance == NULL)
        return fmi2Error;
    return fmi2_refuse(instance, CALL_GET_DIRECTIONAL_DERIVATIVE, "directional derivatives are not supported.");
}
