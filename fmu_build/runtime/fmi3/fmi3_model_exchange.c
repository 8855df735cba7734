/* FMI 3.0: Model Exchange. */
#include "fmi3_component.h"

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    return fmi3_leave(instance, call_enter_continuous_time_mode(fmi3_enter(instance, CALL_EnterContinuousTimeMode)));
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *entered = fmi3_enter(instance, CALL_CompletedIntegratorStep);
    if (!call_has(entered, 1, enterEventMode) || !call_has(entered, 1, terminateSimulation))
        return fmi3_leave(instance, STATUS_ERROR);
    *enterEventMode = fmi3False;
    return fmi3_leave(instance, call_completed_step(entered, terminateSimulation));
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    return fmi3_leave(instance, call_set_time(fmi3_enter(instance, CALL_SetTime), time));
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates)
{
    Instance *entered = fmi3_enter(instance, CALL_SetContinuousStates);
    return fmi3_leave(instance, call_set_states(entered, continuousStates, nContinuousStates));
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates)
{
    Instance *entered = fmi3_enter(instance, CALL_GetContinuousStateDerivatives);
    return fmi3_leave(instance, call_get_derivatives(entered, derivatives, nContinuousStates));
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators)
{
    Instance *entered = fmi3_enter(instance, CALL_GetEventIndicators);
    return fmi3_leave(instance, call_get_event_indicators(entered, eventIndicators, nEventIndicators));
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates)
{
    Instance *entered = fmi3_enter(instance, CALL_GetContinuousStates);
    return fmi3_leave(instance, call_get_states(entered, continuousStates, nContinuousStates));
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates)
{
    Instance *entered = fmi3_enter(instance, CALL_GetNominalsOfContinuousStates);
    return fmi3_leave(instance, call_get_nominals(entered, nominals, nContinuousStates));
}

static fmi3Status get_number(fmi3Instance instance, Call call, size_t count, size_t *number)
{
    if (!call_has(fmi3_enter(instance, call), 1, number))
        return fmi3_leave(instance, STATUS_ERROR);
    *number = count;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators)
{
    return get_number(instance, CALL_GetNumberOfEventIndicators, model.n_roots, nEventIndicators);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates)
{
    return get_number(instance, CALL_GetNumberOfContinuousStates, model.n_states, nContinuousStates);
}
