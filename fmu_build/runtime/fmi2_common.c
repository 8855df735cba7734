/* FMI 2.0: inquiry, creation and the life cycle. */
#include "cosimulation.h"
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
    static const fmi2Status translated[] = {[STATUS_OK] = fmi2OK,
                                            [STATUS_WARNING] = fmi2Warning,
                                            [STATUS_DISCARD] = fmi2Discard,
                                            [STATUS_ERROR] = fmi2Error,
                                            [STATUS_FATAL] = fmi2Fatal};
    const Component *component = context;
    component->logger(component->environment, component->name, translated[status], category, message);
}

static const char *fault_of_arguments(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (name == NULL || name[0] == '\0')
        return "The instance has no name.";
    if (type != fmi2ModelExchange && type != fmi2CoSimulation)
        return "The FMU type is neither Model Exchange nor Co-Simulation.";
    if (guid == NULL || strcmp(guid, model.token) != 0)
        return "The GUID is not that of this model: modelDescription.xml belongs to another binary.";
    return NULL;
}

static Component *create_component(fmi2String name, fmi2Type type, const fmi2CallbackFunctions *functions, bool debug)
{
    Component *component = calloc(1, sizeof *component);
    if (component == NULL)
        return NULL;
    component->name = malloc(strlen(name) + 1);
    component->logger = functions->logger;
    component->environment = functions->componentEnvironment;
    Log log;
    log_init(&log, component, functions->logger != NULL ? write_message : NULL, debug);
    component->instance = instance_create(type == fmi2CoSimulation, &log);
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
    const char *why = fault_of_arguments(instanceName, fmuType, fmuGUID);
    Component *component = NULL;
    if (why == NULL) {
        component = create_component(instanceName, fmuType, functions, loggingOn != fmi2False);
        if (component == NULL)
            why = "Memory is short.";
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
    Instance *instance = fmi2_enter(c, CALL_SET_DEBUG_LOGGING);
    if (instance == NULL || !fmi2_has_array(instance, CALL_SET_DEBUG_LOGGING, nCategories, categories))
        return fmi2Error;
    if (nCategories == 0)
        log_init(&instance->log, instance->log.context, instance->log.write, loggingOn != fmi2False);
    bool known = true;
    for (size_t i = 0; i < nCategories; ++i)
        known = categories[i] != NULL && log_switch(&instance->log, categories[i], loggingOn != fmi2False) && known;
    return known ? fmi2OK : fmi2_refuse(instance, CALL_SET_DEBUG_LOGGING, "a log category does not exist.");
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    Instance *instance = fmi2_enter(c, CALL_SETUP_EXPERIMENT);
    if (instance == NULL)
        return fmi2Error;
    const Status status = instance_set_experiment(instance, startTime, stopTimeDefined ? stopTime : INFINITY,
                                                  toleranceDefined ? tolerance : DEFAULT_TOLERANCE);
    return status == STATUS_ERROR ? fmi2Error : fmi2_finish(instance, status);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    Instance *instance = fmi2_enter(c, CALL_ENTER_INITIALIZATION_MODE);
    if (instance == NULL)
        return fmi2Error;
    instance->phase = PHASE_INITIALIZATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    Instance *instance = fmi2_enter(c, CALL_EXIT_INITIALIZATION_MODE);
    if (instance == NULL)
        return fmi2Error;
    const Status status = instance_initialize(instance);
    if (status == STATUS_OK && instance->co_simulation)
        cosimulation_start(instance);
    instance->phase = instance->co_simulation ? PHASE_STEP_COMPLETE : PHASE_EVENT;
    return fmi2_finish(instance, status);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    Instance *instance = fmi2_enter(c, CALL_TERMINATE);
    if (instance == NULL)
        return fmi2Error;
    instance->phase = PHASE_TERMINATED;
    const StepRecord *record = &instance->integrator.record;
    if (instance->co_simulation)
        log_message(&instance->log, LOG_ALL, STATUS_OK,
                    "%zu integrator steps, %zu rejected, %zu evaluations of the derivatives, %zu events.",
                    record->accepted, record->rejected, record->evaluations, instance->progress.events);
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    Instance *instance = fmi2_enter(c, CALL_RESET);
    if (instance == NULL)
        return fmi2Error;
    instance_reset(instance);
    return fmi2OK;
}
