/* FMI 2.0: Co-Simulation. */
#include "cosimulation.h"
#include "evaluation.h"
#include "fmi2_component.h"
#include "variables.h"

#include <float.h>
#include <math.h>

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    const Call call = CALL_SET_REAL_INPUT_DERIVATIVES;
    Instance *instance = fmi2_enter(c, call);
    if (instance == NULL || !fmi2_has_array(instance, call, nvr, vr) || !fmi2_has_array(instance, call, nvr, order) ||
        !fmi2_has_array(instance, call, nvr, value))
        return fmi2Error;
    for (size_t i = 0; i < nvr; ++i) {
        const Variable *variable = variable_find(instance, vr[i], TYPE_REAL);
        if (variable == NULL)
            return fmi2Error;
        if (order[i] != 1)
            return fmi2_refuse(instance, call, "only derivatives of order 1 are used.");
        if (!isfinite(value[i]))
            return fmi2_refuse(instance, call, "a derivative is not finite.");
        if (variable->causality != CAUSALITY_INPUT || variable->variability != VARIABILITY_CONTINUOUS)
            return fmi2_refuse(instance, call, "a variable is not a continuous input.");
    }
    for (size_t i = 0; i < nvr; ++i)
        inputs_set_slope(&instance->inputs, model.variables[vr[i]].index, value[i]);
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    const Call call = CALL_GET_REAL_OUTPUT_DERIVATIVES;
    Instance *instance = fmi2_enter(c, call);
    if (instance == NULL || !fmi2_has_array(instance, call, nvr, vr) || !fmi2_has_array(instance, call, nvr, order) ||
        !fmi2_has_array(instance, call, nvr, value))
        return fmi2Error;
    for (size_t i = 0; i < nvr; ++i) {
        const Variable *variable = variable_find(instance, vr[i], TYPE_REAL);
        if (variable == NULL)
            return fmi2Error;
        if (order[i] != 1)
            return fmi2_refuse(instance, call, "only derivatives of order 1 are known.");
        if (variable->causality != CAUSALITY_OUTPUT ||
            !evaluation_time_derivative(instance, variable, &value[i]))
            return fmi2_refuse(instance, call, "the derivative of a variable is not known.");
    }
    return fmi2OK;
}

/* What is wrong with the arguments of a communication step, or NULL. Importers sum up times in their own ways, so
 * that rounding errors are no fault. */
static const char *fault_of_step(const Instance *instance, double point, double step)
{
    const double time = instance->values.time;
    const double slack = 1e-6 * step + 16.0 * DBL_EPSILON * fabs(time);
    const double stop_time = instance->experiment.stop_time;
    if (fabs(point - time) <= slack && step >= 0.0 && step <= DBL_MAX && point + step <= stop_time + slack)
        return NULL;
    if (!isfinite(point) || !isfinite(step))
        return "the communication point and the step size must be finite.";
    if (step < 0.0)
        return "the communication step size is negative.";
    if (fabs(point - time) > slack)
        return "the communication point is not where the last step ended.";
    return "the step goes beyond the stop time.";
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *instance = fmi2_enter(c, CALL_DO_STEP);
    if (instance == NULL)
        return fmi2Error;
    const char *why = fault_of_step(instance, currentCommunicationPoint, communicationStepSize);
    if (why != NULL)
        return fmi2_refuse(instance, CALL_DO_STEP, why);
    const Status status = cosimulation_advance(instance, currentCommunicationPoint + communicationStepSize);
    instance->progress.last_step = status;
    if (status == STATUS_DISCARD)
        instance->phase = PHASE_STEP_DISCARDED;
    return fmi2_finish(instance, status);
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    const Instance *instance = fmi2_enter(c, CALL_CANCEL_STEP);
    return instance == NULL ? fmi2Error
                            : fmi2_refuse(instance, CALL_CANCEL_STEP, "no step is running in the background.");
}

/* Status information is known only where it does not concern asynchronous steps; else the standard has
 * fmi2Discard. */
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value)
{
    const Instance *instance = fmi2_enter(c, CALL_GET_STATUS);
    if (instance == NULL || !fmi2_has_array(instance, CALL_GET_STATUS, 1, value))
        return fmi2Error;
    if (s != fmi2DoStepStatus)
        return fmi2Discard;
    *value = instance->progress.last_step == STATUS_DISCARD ? fmi2Discard : fmi2OK;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value)
{
    const Instance *instance = fmi2_enter(c, CALL_GET_REAL_STATUS);
    if (instance == NULL || !fmi2_has_array(instance, CALL_GET_REAL_STATUS, 1, value))
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
    return fmi2_enter(c, CALL_GET_INTEGER_STATUS) == NULL ? fmi2Error : fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value)
{
    const Instance *instance = fmi2_enter(c, CALL_GET_BOOLEAN_STATUS);
    if (instance == NULL || !fmi2_has_array(instance, CALL_GET_BOOLEAN_STATUS, 1, value))
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
    return fmi2_enter(c, CALL_GET_STRING_STATUS) == NULL ? fmi2Error : fmi2Discard;
}
