/* A co-simulation importer in C that knows nothing of pyjoystick: it loads the binary of an FMU, sets one
   parameter and prints an output over time. Compiled for FMI 2 or, with FMI=3, for FMI 3.

   importer BINARY TOKEN PARAMETER VALUE OUTPUT STEP COUNT     (variables by value reference) */

#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#if FMI == 3
#include "fmi3Functions.h"
#define PREFIX "fmi3"
#else
#include "fmi2Functions.h"
#define PREFIX "fmi2"
#endif

static void *library;

static void *function(const char *name) {
    char whole[64];
    snprintf(whole, sizeof whole, "%s%s", PREFIX, name);
    void *found = dlsym(library, whole);
    if (!found) {
        fprintf(stderr, "there is no %s\n", whole);
        exit(1);
    }
    return found;
}

#define CALL(kind, name, ...) \
    do { \
        if (((kind *)function(name))(__VA_ARGS__) != 0) { \
            fprintf(stderr, "%s failed\n", name); \
            return 1; \
        } \
    } while (0)

#if FMI == 3

static void tell(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text) {
    (void)environment, (void)category;
    fprintf(stderr, "%d: %s\n", (int)status, text);
}

static int run(const char *token, unsigned parameter, double value, unsigned output, double step, int count) {
    fmi3Instance one = ((fmi3InstantiateCoSimulationTYPE *)function("InstantiateCoSimulation"))(
        "one", token, NULL, fmi3False, fmi3False, fmi3False, fmi3False, NULL, 0, NULL, tell, NULL);
    if (!one) return 1;
    fmi3ValueReference set = parameter, get = output;
    CALL(fmi3SetFloat64TYPE, "SetFloat64", one, &set, 1, &value, 1);
    CALL(fmi3EnterInitializationModeTYPE, "EnterInitializationMode", one, fmi3False, 0.0, 0.0, fmi3False, 0.0);
    CALL(fmi3ExitInitializationModeTYPE, "ExitInitializationMode", one);
    for (int i = 0; i <= count; ++i) {
        double result, reached;
        fmi3Boolean event, end, early;
        CALL(fmi3GetFloat64TYPE, "GetFloat64", one, &get, 1, &result, 1);
        printf("%.17g\n", result);
        CALL(fmi3DoStepTYPE, "DoStep", one, i * step, step, fmi3True, &event, &end, &early, &reached);
    }
    CALL(fmi3TerminateTYPE, "Terminate", one);
    ((fmi3FreeInstanceTYPE *)function("FreeInstance"))(one);
    return 0;
}

#else

static void tell(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                 fmi2String text, ...) {
    (void)environment, (void)name, (void)category;
    fprintf(stderr, "%d: %s\n", (int)status, text);
}

static int run(const char *token, unsigned parameter, double value, unsigned output, double step, int count) {
    const fmi2CallbackFunctions callbacks = {tell, calloc, free, NULL, NULL};
    fmi2Component one = ((fmi2InstantiateTYPE *)function("Instantiate"))(
        "one", fmi2CoSimulation, token, NULL, &callbacks, fmi2False, fmi2False);
    if (!one) return 1;
    fmi2ValueReference set = parameter, get = output;
    CALL(fmi2SetRealTYPE, "SetReal", one, &set, 1, &value);
    CALL(fmi2SetupExperimentTYPE, "SetupExperiment", one, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    CALL(fmi2EnterInitializationModeTYPE, "EnterInitializationMode", one);
    CALL(fmi2ExitInitializationModeTYPE, "ExitInitializationMode", one);
    for (int i = 0; i <= count; ++i) {
        double result;
        CALL(fmi2GetRealTYPE, "GetReal", one, &get, 1, &result);
        printf("%.17g\n", result);
        CALL(fmi2DoStepTYPE, "DoStep", one, i * step, step, fmi2True);
    }
    CALL(fmi2TerminateTYPE, "Terminate", one);
    ((fmi2FreeInstanceTYPE *)function("FreeInstance"))(one);
    return 0;
}

#endif

int main(int count, char **given) {
    if (count != 8) return 2;
    library = dlopen(given[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    return run(given[2], (unsigned)atoi(given[3]), atof(given[4]), (unsigned)atoi(given[5]), atof(given[6]),
               atoi(given[7]));
}
