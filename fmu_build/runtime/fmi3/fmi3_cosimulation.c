/* FMI 3.0: Co-Simulation. */
#include "cosimulation.h"
#include "fmi3_intermediate.h"

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    return fmi3_leave(instance, call_enter_step_mode(fmi3_enter(instance, CALL_EnterStepMode)));
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues)
{
    Instance *entered = fmi3_enter(instance, CALL_GetOutputDerivatives);
    if (!call_has(entered, nValueReferences, valueReferences) ||
        !intermediate_allows(instance, false, valueReferences, nValueReferences))
        return fmi3_leave(instance, STATUS_ERROR);
    if (nValues != nValueReferences)
        return fmi3_leave(instance, call_refuse(entered, "%zu derivatives of %zu variables, all of them scalars.",
                                                nValues, nValueReferences));
    return fmi3_leave(instance,
                      call_get_output_derivatives(entered, valueReferences, nValueReferences, orders, values));
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *entered = fmi3_enter(instance, CALL_DoStep);
    if (!call_has(entered, 1, eventHandlingNeeded) || !call_has(entered, 1, terminateSimulation) ||
        !call_has(entered, 1, earlyReturn) || !call_has(entered, 1, lastSuccessfulTime))
        return fmi3_leave(instance, STATUS_ERROR);
    const Status status = call_do_step(entered, currentCommunicationPoint, communicationStepSize);
    const double point = currentCommunicationPoint + communicationStepSize, time = entered->values.time;
    *terminateSimulation = status == STATUS_DISCARD;
    *eventHandlingNeeded = entered->progress.ended_at_event;
    *earlyReturn = entered->attendance.early_return && cosimulation_is_before(time, point);
    *lastSuccessfulTime = time;
    return fmi3_leave(instance, status == STATUS_DISCARD ? STATUS_OK : status);
}
