/* co_simulation.c - the FMU integrates. */
#include "importer.h"

#include <stdbool.h>

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
    return begin_fmi2(settings, logger, fmi2CoSimulation);
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
