/* FMI 2.0: Model Exchange. */
#include "fmi2_component.h"

#include <math.h>

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return fmi2_status(call_enter_event_mode(fmi2_enter(c, CALL_EnterEventMode)));
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo)
{
    Instance *instance = fmi2_enter(c, CALL_NewDiscreteStates);
    if (!call_has(instance, 1, eventInfo))
        return fmi2Error;
    EventOutcome outcome;
    const Status status = call_update_discrete_states(instance, &outcome);
    const bool timed = outcome.next_time < INFINITY;
    *eventInfo = (fmi2EventInfo){.newDiscreteStatesNeeded = fmi2False,
                                 .terminateSimulation = outcome.terminate,
                                 .nominalsOfContinuousStatesChanged = fmi2False,
                                 .valuesOfContinuousStatesChanged = outcome.states_changed,
                                 .nextEventTimeDefined = timed,
                                 .nextEventTime = timed ? outcome.next_time : 0.0};
    return fmi2_status(status);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    return fmi2_status(call_enter_continuous_time_mode(fmi2_enter(c, CALL_EnterContinuousTimeMode)));
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *instance = fmi2_enter(c, CALL_CompletedIntegratorStep);
    if (!call_has(instance, 1, enterEventMode) || !call_has(instance, 1, terminateSimulation))
        return fmi2Error;
    bool terminate;
    const Status status = call_completed_step(instance, &terminate);
    *enterEventMode = fmi2False;
    *terminateSimulation = terminate;
    return fmi2_status(status);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    return fmi2_status(call_set_time(fmi2_enter(c, CALL_SetTime), time));
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx)
{
    return fmi2_status(call_set_states(fmi2_enter(c, CALL_SetContinuousStates), x, nx));
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx)
{
    return fmi2_status(call_get_derivatives(fmi2_enter(c, CALL_GetDerivatives), derivatives, nx));
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni)
{
    return fmi2_status(call_get_event_indicators(fmi2_enter(c, CALL_GetEventIndicators), eventIndicators, ni));
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx)
{
    return fmi2_status(call_get_states(fmi2_enter(c, CALL_GetContinuousStates), x, nx));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx)
{
    return fmi2_status(call_get_nominals(fmi2_enter(c, CALL_GetNominalsOfContinuousStates), x_nominal, nx));
}
