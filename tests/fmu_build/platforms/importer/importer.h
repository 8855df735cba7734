/* importer.h - a small importer of FMI 2.0 or, with FMI_VERSION 3, of FMI 3.0. co_simulation.c and model_exchange.c
 * give begin, initialized and step for one FMI type each; the rest is common to both. */
#ifndef IMPORTER_H
#define IMPORTER_H

#include <stddef.h>

#if FMI_VERSION == 3
#include "fmi3FunctionTypes.h"
#define FMI(name) fmi3##name
typedef fmi3Instance Instance;
typedef fmi3LogMessageCallback Logger;
#else
#include "fmi2FunctionTypes.h"
#define FMI(name) fmi2##name
typedef fmi2Component Instance;
typedef fmi2CallbackLogger Logger;
#endif
typedef FMI(ValueReference) Reference;
typedef FMI(Boolean) Boolean;

typedef struct {
    const char *token;
    double tolerance, start, stop;
    size_t n_states, n_indicators;
} Settings;

/* An instance in Initialization Mode. */
Instance begin(const Settings *settings, Logger logger);
#if FMI_VERSION == 2
/* What begin is in FMI 2.0, where the type is an argument. */
Instance begin_fmi2(const Settings *settings, Logger logger, fmi2Type type);
#endif
/* To the first communication point. */
void initialized(Instance instance);
void step(Instance instance, double time, double size);

/* Inputs and outputs of type Real. */
void set(Instance instance, const Reference *references, size_t count, const double *values);
void get(Instance instance, const Reference *references, size_t count, double *values);

/* Says what failed and ends the program. */
void fail(const char *what);
/* Puts the address of the library's function into *function. */
void find(const char *name, void *function);

/* Declares a function of the library: FUNCTION(FMI(Terminate)); */
#define FUNCTION(name) DECLARED(name)
#define DECLARED(name) \
    name##TYPE *name; \
    find(#name, &name)
#define CALL(call) \
    do { \
        if ((call) != 0) \
            fail(#call); \
    } while (0)

#endif
