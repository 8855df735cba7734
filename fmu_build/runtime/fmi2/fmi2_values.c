/* FMI 2.0: reading and setting variables. */
#include "fmi2_component.h"

static const AccessType real_type = {TYPE_REAL, NUMBER_DOUBLE, "Real"};
static const AccessType integer_type = {TYPE_INTEGER | TYPE_ENUMERATION, NUMBER_INT32, "Integer"};
static const AccessType boolean_type = {TYPE_BOOLEAN, NUMBER_INT32_TRUTH, "Boolean"};

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    return fmi2_status(call_get_real(fmi2_enter(c, CALL_GetReal), vr, nvr, value));
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    return fmi2_status(call_get(fmi2_enter(c, CALL_GetInteger), &integer_type, vr, nvr, value));
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    return fmi2_status(call_get(fmi2_enter(c, CALL_GetBoolean), &boolean_type, vr, nvr, value));
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    (void)vr;
    (void)value;
    return fmi2_status(call_access_nothing(fmi2_enter(c, CALL_GetString), "String", nvr));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    return fmi2_status(call_set(fmi2_enter(c, CALL_SetReal), &real_type, vr, nvr, value));
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    return fmi2_status(call_set(fmi2_enter(c, CALL_SetInteger), &integer_type, vr, nvr, value));
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    return fmi2_status(call_set(fmi2_enter(c, CALL_SetBoolean), &boolean_type, vr, nvr, value));
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    (void)vr;
    (void)value;
    return fmi2_status(call_access_nothing(fmi2_enter(c, CALL_SetString), "String", nvr));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown,
                                        const fmi2Real dvKnown[], fmi2Real dvUnknown[])
{
    const Partials partials = {vUnknown_ref, nUnknown, vKnown_ref, nKnown};
    return fmi2_status(call_get_directional_derivative(fmi2_enter(c, CALL_GetDirectionalDerivative), &partials,
                                                       dvKnown, nKnown, dvUnknown, nUnknown));
}
