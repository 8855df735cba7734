/* model_exchange.c - the importer integrates: the classical method of Runge and Kutta in equal steps. A step in which
 * an indicator changes its sign is halved until the event is at the end of a very small one. */
#include "importer.h"

#include <stdbool.h>

#define LARGEST_STEP 5e-5
#define SMALLEST_STEP 1e-10
#define MOST 16 /* states, event indicators */

static size_t n_states, n_indicators;
static bool negative[MOST]; /* the indicators in the present branch */

#if FMI_VERSION == 3
#define DERIVATIVES fmi3GetContinuousStateDerivatives
static void discrete_states(Instance instance)
{
    FUNCTION(fmi3UpdateDiscreteStates);
    bool again = true, terminate, nominals, states, timed;
    double next;
    while (again)
        CALL(fmi3UpdateDiscreteStates(instance, &again, &terminate, &nominals, &states, &timed, &next));
    if (terminate || timed)
        fail("neither an end nor time events are expected");
}

Instance begin(const Settings *settings, Logger logger)
{
    FUNCTION(fmi3InstantiateModelExchange);
    FUNCTION(fmi3EnterInitializationMode);
    Instance instance =
        fmi3InstantiateModelExchange("importer", settings->token, NULL, false, false, NULL, logger);
    if (!instance)
        fail("fmi3InstantiateModelExchange");
    CALL(fmi3EnterInitializationMode(
        instance, true, settings->tolerance, settings->start, true, settings->stop));
    n_states = settings->n_states;
    n_indicators = settings->n_indicators;
    return instance;
}
#else
#define DERIVATIVES fmi2GetDerivatives
static void discrete_states(Instance instance)
{
    FUNCTION(fmi2NewDiscreteStates);
    fmi2EventInfo info;
    do
        CALL(fmi2NewDiscreteStates(instance, &info));
    while (info.newDiscreteStatesNeeded);
    if (info.terminateSimulation || info.nextEventTimeDefined)
        fail("neither an end nor time events are expected");
}

Instance begin(const Settings *settings, Logger logger)
{
    Instance instance = begin_fmi2(settings, logger, fmi2ModelExchange);
    n_states = settings->n_states;
    n_indicators = settings->n_indicators;
    return instance;
}
#endif

static void states_of(Instance instance, double *x)
{
    FUNCTION(FMI(GetContinuousStates));
    CALL(FMI(GetContinuousStates)(instance, x, n_states));
}

static void set_point(Instance instance, double time, const double *x)
{
    FUNCTION(FMI(SetTime));
    FUNCTION(FMI(SetContinuousStates));
    CALL(FMI(SetTime)(instance, time));
    CALL(FMI(SetContinuousStates)(instance, x, n_states));
}

static void derivatives(Instance instance, double time, const double *x, double *der)
{
    FUNCTION(DERIVATIVES);
    set_point(instance, time, x);
    CALL(DERIVATIVES(instance, der, n_states));
}

/* Whether some indicator has another sign than in the present branch. */
static bool crossed(Instance instance, bool remember)
{
    FUNCTION(FMI(GetEventIndicators));
    double indicators[MOST];
    bool changed = false;
    CALL(FMI(GetEventIndicators)(instance, indicators, n_indicators));
    for (size_t i = 0; i < n_indicators; i++) {
        changed |= negative[i] != (indicators[i] < 0.0);
        if (remember)
            negative[i] = indicators[i] < 0.0;
    }
    return changed;
}

/* From Event Mode to Continuous-Time Mode. */
static void take_event(Instance instance)
{
    FUNCTION(FMI(EnterContinuousTimeMode));
    discrete_states(instance);
    CALL(FMI(EnterContinuousTimeMode)(instance));
    (void)crossed(instance, true);
}

static void event(Instance instance)
{
    FUNCTION(FMI(EnterEventMode));
    CALL(FMI(EnterEventMode)(instance));
    take_event(instance);
}

void initialized(Instance instance)
{
    FUNCTION(FMI(ExitInitializationMode));
    CALL(FMI(ExitInitializationMode)(instance));
    take_event(instance);
}

static void runge_kutta(Instance instance, double time, double h, const double *x, double *next)
{
    static const double part[] = {0.0, 0.5, 0.5, 1.0}, weight[] = {1.0, 2.0, 2.0, 1.0};
    double at[MOST], k[4][MOST];
    for (int stage = 0; stage < 4; stage++) {
        for (size_t j = 0; j < n_states; j++)
            at[j] = stage ? x[j] + part[stage] * h * k[stage - 1][j] : x[j];
        derivatives(instance, time + part[stage] * h, at, k[stage]);
    }
    for (size_t j = 0; j < n_states; j++) {
        next[j] = x[j];
        for (int stage = 0; stage < 4; stage++)
            next[j] += h / 6.0 * weight[stage] * k[stage][j];
    }
}

/* From `time` over h, from the states x to new ones there. */
static void advance(Instance instance, double time, double h, double *x)
{
    FUNCTION(FMI(CompletedIntegratorStep));
    Boolean enter, terminate;
    double next[MOST];
    runge_kutta(instance, time, h, x, next);
    set_point(instance, time + h, next);
    bool crosses = crossed(instance, false);
    if (crosses && h > SMALLEST_STEP) {
        advance(instance, time, h / 2.0, x);
        advance(instance, time + h / 2.0, h / 2.0, x);
        return;
    }
    CALL(FMI(CompletedIntegratorStep)(instance, true, &enter, &terminate));
    if (crosses || enter)
        event(instance);
    states_of(instance, x);
}

void step(Instance instance, double time, double size)
{
    double x[MOST];
    size_t n = (size_t)(size / LARGEST_STEP) + 1;
    event(instance); /* inputs may have jumped */
    states_of(instance, x);
    for (size_t i = 0; i < n; i++)
        advance(instance, time + size * (double)i / (double)n, size / (double)n, x);
}
