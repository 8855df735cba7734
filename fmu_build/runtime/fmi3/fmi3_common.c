/* FMI 3.0: inquiry, creation and the life cycle. */
#include "fmi3_component.h"
#include "fmi3_intermediate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

static void write_message(void *context, Status status, const char *category, const char *message)
{
    const Component *component = context;
    component->log_message(component->environment, (fmi3Status)status, category, message);
}

static Component *create(bool co_simulation, fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                         bool logging)
{
    Component *component = calloc(1, sizeof *component);
    if (component == NULL)
        return NULL;
    component->environment = environment;
    component->log_message = logger;
    /* In a message, "#12#" would refer to a variable. */
    const Log log = {component, logger != NULL ? write_message : NULL, logging ? LOG_EVERYTHING : 0, "#"};
    component->instance = instance_create(co_simulation, &fmi3_face, &log);
    if (component->instance == NULL) {
        free(component);
        return NULL;
    }
    return component;
}

static fmi3Instance refuse_creation(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                    const char *why)
{
    if (logger != NULL)
        logger(environment, fmi3Error, "logStatusError", why);
    return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage)
{
    (void)resourcePath;
    (void)visible;
    const char *why = call_fault_of_creation(instanceName, instantiationToken);
    Component *component = why != NULL ? NULL : create(false, instanceEnvironment, logMessage, loggingOn);
    if (component == NULL)
        return refuse_creation(instanceEnvironment, logMessage, why != NULL ? why : "Out of memory.");
    return component;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate)
{
    (void)resourcePath;
    (void)visible;
    const char *why = call_fault_of_creation(instanceName, instantiationToken);
    Component *component = why != NULL ? NULL : create(true, instanceEnvironment, logMessage, loggingOn);
    if (component == NULL)
        return refuse_creation(instanceEnvironment, logMessage, why != NULL ? why : "Out of memory.");
    component->instance->attendance.event_mode = eventModeUsed;
    component->instance->attendance.early_return = earlyReturnAllowed;
    component->intermediate_update = intermediateUpdate;
    why = intermediate_attend(component, requiredIntermediateVariables, nRequiredIntermediateVariables);
    if (why == NULL)
        return component;
    fmi3FreeInstance(component);
    return refuse_creation(instanceEnvironment, logMessage, why);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken,
                                               fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment,
                                               fmi3LogMessageCallback logMessage,
                                               fmi3ClockUpdateCallback clockUpdate,
                                               fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption)
{
    (void)instanceName;
    (void)instantiationToken;
    (void)resourcePath;
    (void)visible;
    (void)loggingOn;
    (void)clockUpdate;
    (void)lockPreemption;
    (void)unlockPreemption;
    return refuse_creation(instanceEnvironment, logMessage, "This FMU has no Scheduled Execution.");
}

void fmi3FreeInstance(fmi3Instance instance)
{
    Component *component = instance;
    if (component == NULL)
        return;
    instance_free(component->instance);
    free(component->intermediate);
    free(component);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    Instance *entered = fmi3_enter(instance, CALL_SetDebugLogging);
    return fmi3_leave(instance, call_set_logging(entered, loggingOn, nCategories, categories));
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    Instance *entered = fmi3_enter(instance, CALL_EnterInitializationMode);
    if (entered == NULL)
        return fmi3_leave(instance, STATUS_ERROR);
    const Status status = instance_set_experiment(entered, startTime, stopTimeDefined ? stopTime : INFINITY,
                                                  toleranceDefined ? tolerance : DEFAULT_TOLERANCE);
    return fmi3_leave(instance, status == STATUS_ERROR ? status : call_enter_initialization(entered));
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    return fmi3_leave(instance, call_exit_initialization(fmi3_enter(instance, CALL_ExitInitializationMode)));
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    Instance *entered = fmi3_enter(instance, CALL_EnterEventMode);
    if (entered != NULL && entered->co_simulation && !entered->attendance.event_mode)
        return fmi3_leave(instance, call_refuse(entered, "the instance was made with eventModeUsed = fmi3False."));
    return fmi3_leave(instance, call_enter_event_mode(entered));
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance)
{
    /* fmi3UpdateDiscreteStates does all the work. */
    return fmi3_leave(instance, fmi3_enter(instance, CALL_EvaluateDiscreteStates) == NULL ? STATUS_ERROR : STATUS_OK);
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime)
{
    Instance *entered = fmi3_enter(instance, CALL_UpdateDiscreteStates);
    if (!call_has(entered, 1, discreteStatesNeedUpdate) || !call_has(entered, 1, terminateSimulation) ||
        !call_has(entered, 1, nominalsOfContinuousStatesChanged) ||
        !call_has(entered, 1, valuesOfContinuousStatesChanged) || !call_has(entered, 1, nextEventTimeDefined) ||
        !call_has(entered, 1, nextEventTime))
        return fmi3_leave(instance, STATUS_ERROR);
    EventOutcome outcome;
    const Status status = call_update_discrete_states(entered, &outcome);
    *discreteStatesNeedUpdate = fmi3False;
    *terminateSimulation = outcome.terminate;
    *nominalsOfContinuousStatesChanged = fmi3False;
    *valuesOfContinuousStatesChanged = outcome.states_changed;
    *nextEventTimeDefined = outcome.next_time < INFINITY;
    *nextEventTime = *nextEventTimeDefined ? outcome.next_time : 0.0;
    return fmi3_leave(instance, status);
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    return fmi3_leave(instance, call_terminate(fmi3_enter(instance, CALL_Terminate)));
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    return fmi3_leave(instance, call_reset(fmi3_enter(instance, CALL_Reset)));
}
