/* importer LIBRARY TOKEN TOLERANCE STOP N_STATES N_INDICATORS N_INPUTS INPUT... OUTPUT...
 *
 * Inputs and outputs are value references of variables of type Real. Every line of standard input is a
 * communication point: the time and a value for each input, which holds until the next point. For each one a line
 * with the time and the outputs goes to standard output. */
#include "importer.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
static HMODULE library;
#define OPEN(path) LoadLibraryA(path)
#define FIND(name) GetProcAddress(library, name)
#else
#include <dlfcn.h>
static void *library;
#define OPEN(path) dlopen(path, RTLD_NOW | RTLD_LOCAL)
#define FIND(name) dlsym(library, name)
#endif

#define FIRST_REFERENCE 8 /* of the arguments */
#define MOST 64 /* inputs and outputs */

void fail(const char *what)
{
    fprintf(stderr, "importer: %s\n", what);
    exit(1);
}

void find(const char *name, void *function)
{
    /* Through memory, because C has no conversion between objects and functions. */
    *(void **)function = (void *)FIND(name);
    if (!*(void **)function)
        fail(name);
}

#if FMI_VERSION == 3
static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text)
{
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", (int)status, category, text);
}

void set(Instance instance, const Reference *references, size_t count, const double *values)
{
    FUNCTION(fmi3SetFloat64);
    CALL(fmi3SetFloat64(instance, references, count, values, count));
}

void get(Instance instance, const Reference *references, size_t count, double *values)
{
    FUNCTION(fmi3GetFloat64);
    CALL(fmi3GetFloat64(instance, references, count, values, count));
}
#else
Instance begin_fmi2(const Settings *settings, Logger logger, fmi2Type type)
{
    static fmi2CallbackFunctions callbacks = {NULL, calloc, free, NULL, NULL};
    FUNCTION(fmi2Instantiate);
    FUNCTION(fmi2SetupExperiment);
    FUNCTION(fmi2EnterInitializationMode);
    callbacks.logger = logger;
    Instance instance =
        fmi2Instantiate("importer", type, settings->token, NULL, &callbacks, fmi2False, fmi2False);
    if (!instance)
        fail("fmi2Instantiate");
    CALL(fmi2SetupExperiment(
        instance, fmi2True, settings->tolerance, settings->start, fmi2True, settings->stop));
    CALL(fmi2EnterInitializationMode(instance));
    return instance;
}

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

void set(Instance instance, const Reference *references, size_t count, const double *values)
{
    FUNCTION(fmi2SetReal);
    CALL(fmi2SetReal(instance, references, count, values));
}

void get(Instance instance, const Reference *references, size_t count, double *values)
{
    FUNCTION(fmi2GetReal);
    CALL(fmi2GetReal(instance, references, count, values));
}
#endif

static void end(Instance instance)
{
    FUNCTION(FMI(Terminate));
    FUNCTION(FMI(FreeInstance));
    CALL(FMI(Terminate)(instance));
    FMI(FreeInstance)(instance);
}

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
    if (argc < FIRST_REFERENCE || argc - FIRST_REFERENCE > MOST)
        fail("wrong arguments");
    size_t n_inputs = strtoul(argv[7], NULL, 10), n_outputs = (size_t)(argc - FIRST_REFERENCE) - n_inputs;
    Reference inputs[MOST], *outputs = inputs + n_inputs;
    for (int i = FIRST_REFERENCE; i < argc; i++)
        inputs[i - FIRST_REFERENCE] = (Reference)strtoul(argv[i], NULL, 10);
    library = OPEN(argv[1]);
    if (!library)
        fail("the library does not load");

    double time, next, values[MOST];
    if (!read_point(&time, values, n_inputs))
        fail("no communication point");
    Settings settings = {argv[2], strtod(argv[3], NULL), time, strtod(argv[4], NULL),
                         strtoul(argv[5], NULL, 10), strtoul(argv[6], NULL, 10)};
    Instance instance = begin(&settings, log_message);
    set(instance, inputs, n_inputs, values);
    initialized(instance);
    write_point(instance, time, outputs, n_outputs);
    while (read_point(&next, values, n_inputs)) {
        step(instance, time, next - time);
        time = next;
        write_point(instance, time, outputs, n_outputs);
        set(instance, inputs, n_inputs, values);
    }
    end(instance);
    return 0;
}
