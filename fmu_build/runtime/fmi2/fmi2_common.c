/* FMI 2.0: inquiry, creation and the life cycle. */
#include "fmi2_component.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

static void write_message(void *context, Status status, const char *category, const char *message)
{
    const Component *component = context;
    component->logger(component->environment, component->name, fmi2_status(status), category, message);
}

static Component *create_component(fmi2String name, fmi2Type type, const fmi2CallbackFunctions *functions, bool debug)
{
    Component *component = calloc(1, sizeof *component);
    if (component == NULL)
        return NULL;
    component->name = malloc(strlen(name) + 1);
    component->logger = functions->logger;
    component->environment = functions->componentEnvironment;
    /* A message is a printf format in which "#r12#" would refer to a variable. */
    const Log log = {component, functions->logger != NULL ? write_message : NULL,
                     debug ? LOG_EVERYTHING : LOG_PROBLEMS, "%#"};
    component->instance = instance_create(type == fmi2CoSimulation, &fmi2_face, &log);
    if (component->name == NULL || component->instance == NULL) {
        fmi2FreeInstance(component);
        return NULL;
    }
    memcpy(component->name, name, strlen(name) + 1);
    return component;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn)
{
    (void)fmuResourceLocation;
    (void)visible;
    if (functions == NULL)
        return NULL;
    const char *why = call_fault_of_creation(instanceName, fmuGUID);
    if (fmuType != fmi2ModelExchange && fmuType != fmi2CoSimulation)
        why = "The FMU type is neither Model Exchange nor Co-Simulation.";
    Component *component = NULL;
    if (why == NULL) {
        component = create_component(instanceName, fmuType, functions, loggingOn != fmi2False);
        if (component == NULL)
            why = "Out of memory.";
    }
    if (why != NULL && functions->logger != NULL)
        functions->logger(functions->componentEnvironment, instanceName != NULL ? instanceName : "", fmi2Error,
                          "logStatusError", why);
    return component;
}

void fmi2FreeInstance(fmi2Component c)
{
    Component *component = c;
    if (component == NULL)
        return;
    instance_free(component->instance);
    free(component->name);
    free(component);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[])
{
    return fmi2_status(
        call_set_logging(fmi2_enter(c, CALL_SetDebugLogging), loggingOn != fmi2False, nCategories, categories));
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    Instance *instance = fmi2_enter(c, CALL_SetupExperiment);
    if (instance == NULL)
        return fmi2Error;
    return fmi2_status(instance_set_experiment(instance, startTime, stopTimeDefined ? stopTime : INFINITY,
                                               toleranceDefined ? tolerance : DEFAULT_TOLERANCE));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return fmi2_status(call_enter_initialization(fmi2_enter(c, CALL_EnterInitializationMode)));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return fmi2_status(call_exit_initialization(fmi2_enter(c, CALL_ExitInitializationMode)));
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return fmi2_status(call_terminate(fmi2_enter(c, CALL_Terminate)));
}

fmi2Status fmi2Reset(fmi2Component c)
{
    return fmi2_status(call_reset(fmi2_enter(c, CALL_Reset)));
}
