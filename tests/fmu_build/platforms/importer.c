/* importer.c - runs an FMU's library for Co-Simulation: an importer of FMI 2.0 or, with FMI_VERSION 3, of FMI 3.0.
 *
 * importer LIBRARY TOKEN TOLERANCE STOP N_INPUTS INPUT... OUTPUT...   with value references of Real variables
 *
 * Every line of standard input is a communication point: the time and a value for each input, which holds until
 * the next point. For each one a line with the time and the outputs goes to standard output. */
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
#define LIBRARY HMODULE
#define OPEN(path) LoadLibraryA(path)
#define FIND(library, name) GetProcAddress(library, name)
#else
#include <dlfcn.h>
#define LIBRARY void *
#define OPEN(path) dlopen(path, RTLD_NOW | RTLD_LOCAL)
#define FIND(library, name) dlsym(library, name)
#endif

#define MOST 64 /* inputs, outputs */

typedef struct {
    const char *token;
    double tolerance, start, stop;
} Settings;

static LIBRARY library;

static void fail(const char *what)
{
    fprintf(stderr, "importer: %s\n", what);
    exit(1);
}

/* The conversion from an object to a function goes through memory, because C has no cast for it. */
static void find(const char *name, void *function, size_t size)
{
    *(void **)function = (void *)FIND(library, name);
    if (!*(void **)function || size != sizeof(void *))
        fail(name);
}
#define FUNCTION(name) \
    name##TYPE *name; \
    find(#name, &name, sizeof name)
#define CALL(call) \
    do { \
        if ((call) != 0) \
            fail(#call); \
    } while (0)

#if FMI_VERSION == 3
#include "fmi3FunctionTypes.h"
typedef fmi3Instance Instance;
typedef fmi3ValueReference Reference;

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text)
{
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", (int)status, category, text);
}

static Instance begin(const Settings *settings)
{
    FUNCTION(fmi3InstantiateCoSimulation);
    FUNCTION(fmi3EnterInitializationMode);
    Instance instance = fmi3InstantiateCoSimulation(
        "importer", settings->token, NULL, false, false, false, false, NULL, 0, NULL, log_message, NULL);
    if (!instance)
        fail("fmi3InstantiateCoSimulation");
    CALL(fmi3EnterInitializationMode(
        instance, true, settings->tolerance, settings->start, true, settings->stop));
    return instance;
}

static void initialized(Instance instance)
{
    FUNCTION(fmi3ExitInitializationMode);
    CALL(fmi3ExitInitializationMode(instance));
}

static void set(Instance instance, const Reference *references, size_t count, const double *values)
{
    FUNCTION(fmi3SetFloat64);
    CALL(fmi3SetFloat64(instance, references, count, values, count));
}

static void get(Instance instance, const Reference *references, size_t count, double *values)
{
    FUNCTION(fmi3GetFloat64);
    CALL(fmi3GetFloat64(instance, references, count, values, count));
}

static void step(Instance instance, double time, double size)
{
    FUNCTION(fmi3DoStep);
    bool event, terminate, early;
    double last;
    CALL(fmi3DoStep(instance, time, size, true, &event, &terminate, &early, &last));
}

static void end(Instance instance)
{
    FUNCTION(fmi3Terminate);
    FUNCTION(fmi3FreeInstance);
    CALL(fmi3Terminate(instance));
    fmi3FreeInstance(instance);
}
#else
#include "fmi2FunctionTypes.h"
typedef fmi2Component Instance;
typedef fmi2ValueReference Reference;

static void log_message(
    fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String text, ...)
{
    va_list arguments;
    (void)environment;
    fprintf(stderr, "%s: %d %s: ", name, (int)status, category);
    va_start(arguments, text);
    vfprintf(stderr, text, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

static Instance begin(const Settings *settings)
{
    static const fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};
    FUNCTION(fmi2Instantiate);
    FUNCTION(fmi2SetupExperiment);
    FUNCTION(fmi2EnterInitializationMode);
    Instance instance =
        fmi2Instantiate("importer", fmi2CoSimulation, settings->token, NULL, &callbacks, fmi2False, fmi2False);
    if (!instance)
        fail("fmi2Instantiate");
    CALL(fmi2SetupExperiment(
        instance, fmi2True, settings->tolerance, settings->start, fmi2True, settings->stop));
    CALL(fmi2EnterInitializationMode(instance));
    return instance;
}

static void initialized(Instance instance)
{
    FUNCTION(fmi2ExitInitializationMode);
    CALL(fmi2ExitInitializationMode(instance));
}

static void set(Instance instance, const Reference *references, size_t count, const double *values)
{
    FUNCTION(fmi2SetReal);
    CALL(fmi2SetReal(instance, references, count, values));
}

static void get(Instance instance, const Reference *references, size_t count, double *values)
{
    FUNCTION(fmi2GetReal);
    CALL(fmi2GetReal(instance, references, count, values));
}

static void step(Instance instance, double time, double size)
{
    FUNCTION(fmi2DoStep);
    CALL(fmi2DoStep(instance, time, size, fmi2True));
}

static void end(Instance instance)
{
    FUNCTION(fmi2Terminate);
    FUNCTION(fmi2FreeInstance);
    CALL(fmi2Terminate(instance));
    fmi2FreeInstance(instance);
}
#endif

static bool read_point(double *time, double *inputs, size_t count)
{
    if (scanf("%lf", time) != 1)
        return false;
    for (size_t i = 0; i < count; i++)
        if (scanf("%lf", &inputs[i]) != 1)
            fail("a communication point lacks an input");
    return true;
}

static void write_point(Instance instance, double time, const Reference *references, size_t count)
{
    double values[MOST];
    get(instance, references, count, values);
    printf("%.17g", time);
    for (size_t i = 0; i < count; i++)
        printf(" %.17g", values[i]);
    putchar('\n');
}

int main(int argc, char **argv)
{
    if (argc < 6 || argc - 6 > MOST)
        fail("wrong arguments");
    size_t n_inputs = strtoul(argv[5], NULL, 10), n_outputs = (size_t)argc - 6 - n_inputs;
    Reference references[MOST];
    for (int i = 6; i < argc; i++)
        references[i - 6] = (Reference)strtoul(argv[i], NULL, 10);
    library = OPEN(argv[1]);
    if (!library)
        fail("the library does not load");

    double time, next, inputs[MOST];
    if (!read_point(&time, inputs, n_inputs))
        fail("no communication point");
    Settings settings = {argv[2], strtod(argv[3], NULL), time, strtod(argv[4], NULL)};
    Instance instance = begin(&settings);
    set(instance, references, n_inputs, inputs);
    initialized(instance);
    write_point(instance, time, references + n_inputs, n_outputs);
    while (read_point(&next, inputs, n_inputs)) {
        step(instance, time, next - time);
        time = next;
        set(instance, references, n_inputs, inputs);
        write_point(instance, time, references + n_inputs, n_outputs);
    }
    end(instance);
    return 0;
}
