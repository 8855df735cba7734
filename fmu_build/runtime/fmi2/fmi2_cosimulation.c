/* FMI 2.0: Co-Simulation. */
#include "fmi2_component.h"
#include "variables.h"

#include <math.h>

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    Instance *instance = fmi2_enter(c, CALL_SetRealInputDerivatives);
    if (!call_has(instance, nvr, vr) || !call_has(instance, nvr, order) || !call_has(instance, nvr, value))
        return fmi2Error;
    for (size_t i = 0; i < nvr; ++i) {
        const Variable *variable = variable_find(instance, vr[i], TYPE_REAL, "Real");
        const char *why = NULL;
        if (variable == NULL)
            return fmi2Error;
        if (order[i] != 1)
            why = "only derivatives of order 1 are used";
        else if (!isfinite(value[i]))
            why = "a finite number is needed";
        else if (variable->causality != CAUSALITY_INPUT || variable->variability != VARIABILITY_CONTINUOUS)
            why = "it is not a continuous input";
        if (why != NULL)
            return fmi2_status(call_refuse(instance, "variable \"%s\", derivative %g of order %d: %s.", variable->name,
                                           value[i], order[i], why));
    }
    for (size_t i = 0; i < nvr; ++i)
        inputs_set_slope(&instance->inputs, model.variables[vr[i]].index, value[i]);
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    Instance *instance = fmi2_enter(c, CALL_GetRealOutputDerivatives);
    return fmi2_status(call_get_output_derivatives(instance, vr, nvr, order, value));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    return fmi2_status(
        call_do_step(fmi2_enter(c, CALL_DoStep), currentCommunicationPoint, communicationStepSize));
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return fmi2_enter(c, CALL_CancelStep) == NULL ? fmi2Error : fmi2OK;
}

/* Only status information about asynchronous steps is missing, for which the standard requires fmi2Discard. */
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value)
{
    const Instance *instance = fmi2_enter(c, CALL_GetStatus);
    if (!call_has(instance, 1, value))
        return fmi2Error;
    if (s != fmi2DoStepStatus)
        return fmi2Discard;
    *value = instance->progress.last_step == STATUS_DISCARD ? fmi2Discard : fmi2OK;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value)
{
    const Instance *instance = fmi2_enter(c, CALL_GetRealStatus);
    if (!call_has(instance, 1, value))
        return fmi2Error;
    if (s != fmi2LastSuccessfulTime)
        return fmi2Discard;
    *value = instance->values.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value)
{
    (void)s;
    (void)value;
    return fmi2_enter(c, CALL_GetIntegerStatus) == NULL ? fmi2Error : fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value)
{
    const Instance *instance = fmi2_enter(c, CALL_GetBooleanStatus);
    if (!call_has(instance, 1, value))
        return fmi2Error;
    if (s != fmi2Terminated)
        return fmi2Discard;
    *value = instance->phase == PHASE_STEP_DISCARDED;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value)
{
    (void)s;
    (void)value;
    return fmi2_enter(c, CALL_GetStringStatus) == NULL ? fmi2Error : fmi2Discard;
}
