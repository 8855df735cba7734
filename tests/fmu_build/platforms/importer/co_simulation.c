/* co_simulation.c - the FMU integrates. */
#include "importer.h"

#include <stdbool.h>
#include <stdlib.h>

#if FMI_VERSION == 3
Instance begin(const Settings *settings, Logger logger)
{
    FUNCTION(fmi3InstantiateCoSimulation);
    FUNCTION(fmi3EnterInitializationMode);
    Instance instance = fmi3InstantiateCoSimulation(
        "importer", settings->token, NULL, false, false, false, false, NULL, 0, NULL, logger, NULL);
    if (!instance)
        fail("fmi3InstantiateCoSimulation");
    CALL(fmi3EnterInitializationMode(
        instance, true, settings->tolerance, settings->start, true, settings->stop));
    return instance;
}

void step(Instance instance, double time, double size)
{
    FUNCTION(fmi3DoStep);
    bool event, terminate, early;
    double last;
    CALL(fmi3DoStep(instance, time, size, true, &event, &terminate, &early, &last));
}
#else
Instance begin(const Settings *settings, Logger logger)
{
    static fmi2CallbackFunctions callbacks = {NULL, calloc, free, NULL, NULL};
    FUNCTION(fmi2Instantiate);
    FUNCTION(fmi2SetupExperiment);
    FUNCTION(fmi2EnterInitializationMode);
    callbacks.logger = logger;
    Instance instance =
        fmi2Instantiate("importer", fmi2CoSimulation, settings->token, NULL, &callbacks, fmi2False, fmi2False);
    if (!instance)
        fail("fmi2Instantiate");
    CALL(fmi2SetupExperiment(
        instance, fmi2True, settings->tolerance, settings->start, fmi2True, settings->stop));
    CALL(fmi2EnterInitializationMode(instance));
    return instance;
}

void step(Instance instance, double time, double size)
{
    FUNCTION(fmi2DoStep);
    CALL(fmi2DoStep(instance, time, size, fmi2True));
}
#endif

void initialized(Instance instance)
{
    FUNCTION(FMI(ExitInitializationMode));
    CALL(FMI(ExitInitializationMode)(instance));
}
