/* fmi2.c - an FMU of FMI 2.0 Co-Simulation that gives back its integers and says a text; and an oscillator,
 * x'' = -4 x - 0.5 x' + 3 force, with its directional derivatives. */
#include "fmi2Functions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FORCE = 1, X, V, DER_X, DER_V, Y, FORCE_AGAIN };
enum { P = 1, U, P_AGAIN, U_AGAIN };

typedef struct {
    int number[2], steps;
    double force;
    char said[64];
} Echo;

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)type, (void)guid, (void)resources, (void)functions, (void)visible, (void)logging;
    return calloc(1, sizeof(Echo));
}

void fmi2FreeInstance(fmi2Component instance)
{
    free(instance);
}

fmi2Status fmi2Reset(fmi2Component instance)
{
    memset(instance, 0, sizeof(Echo));
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component instance, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    (void)instance, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component instance)
{
    (void)instance;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component instance)
{
    (void)instance;
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component instance)
{
    (void)instance;
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component instance, fmi2Real time, fmi2Real length, fmi2Boolean no_going_back)
{
    (void)time, (void)length, (void)no_going_back;
    ((Echo *)instance)->steps += 1;
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component instance, const fmi2ValueReference r[], size_t n,
                          const fmi2Integer value[])
{
    for (size_t i = 0; i < n; ++i)
        ((Echo *)instance)->number[r[i] - 1] = value[i];
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component instance, const fmi2ValueReference r[], size_t n, fmi2Integer value[])
{
    for (size_t i = 0; i < n; ++i)
        value[i] = ((Echo *)instance)->number[(r[i] - 1) % 2];
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component instance, const fmi2ValueReference r[], size_t n, const fmi2Real value[])
{
    for (size_t i = 0; i < n; ++i)
        if (r[i] == FORCE)
            ((Echo *)instance)->force = value[i];
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component instance, const fmi2ValueReference r[], size_t n, fmi2Real value[])
{
    const double force = ((Echo *)instance)->force;
    for (size_t i = 0; i < n; ++i)
        value[i] = r[i] == DER_V ? 3.0 * force : r[i] == X || r[i] == V || r[i] == DER_X ? 0.0 : force;
    return fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component instance, const fmi2ValueReference r[], size_t n, fmi2String value[])
{
    Echo *it = instance;
    (void)r;
    snprintf(it->said, sizeof it->said, "step %d", it->steps);
    for (size_t i = 0; i < n; ++i)
        value[i] = it->said;
    return fmi2OK;
}

/* As those of many tools, it answers 0 for a state as an unknown. */
fmi2Status fmi2GetDirectionalDerivative(fmi2Component instance, const fmi2ValueReference unknowns[], size_t nu,
                                        const fmi2ValueReference knowns[], size_t nk, const fmi2Real seed[],
                                        fmi2Real sensitivity[])
{
    static const double slopes[3][3] = {{0.0, 1.0, 0.0}, {-4.0, -0.5, 3.0}, {0.0, 2.0, 1.0}};
    (void)instance;
    for (size_t i = 0; i < nu; ++i) {
        sensitivity[i] = 0.0;
        for (size_t j = 0; j < nk; ++j)
            if (unknowns[i] >= DER_X && unknowns[i] <= Y)
                sensitivity[i] += slopes[unknowns[i] - DER_X][knowns[j] == FORCE ? 2 : knowns[j] - X] * seed[j];
    }
    return fmi2OK;
}
