/* threads.c - many instances of one FMU of FMI 3 at work in threads of their own: the same bits as one by one. */
#define _POSIX_C_SOURCE 200809L
#include "fmi3FunctionTypes.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { RUNS = 8, STEPS = 400 };

typedef struct {
    fmi3InstantiateCoSimulationTYPE *instantiate;
    fmi3SetFloat64TYPE *set;
    fmi3GetFloat64TYPE *get;
    fmi3EnterInitializationModeTYPE *enter_initialization;
    fmi3ExitInitializationModeTYPE *exit_initialization;
    fmi3DoStepTYPE *do_step;
    fmi3FreeInstanceTYPE *free_instance;
} Functions;

typedef struct {
    const Functions *fmu;
    const char *token;
    double angle;
    double values[STEPS][2];
    int failed;
} Run;

static void *run(void *argument)
{
    Run *r = argument;
    const Functions *fmu = r->fmu;
    const fmi3ValueReference states[] = {0, 1};
    fmi3Instance instance =
        fmu->instantiate("thread", r->token, NULL, false, false, false, false, NULL, 0, NULL, NULL, NULL);
    if (instance == NULL)
        return r->failed = 1, NULL;
    r->failed = fmu->set(instance, states, 1, &r->angle, 1) != fmi3OK ||
                fmu->enter_initialization(instance, true, 1e-8, 0.0, false, 0.0) != fmi3OK ||
                fmu->exit_initialization(instance) != fmi3OK;
    for (int i = 0; i < STEPS && !r->failed; ++i) {
        bool event, terminate, early;
        double time;
        r->failed = fmu->do_step(instance, i * 1e-3, 1e-3, true, &event, &terminate, &early, &time) != fmi3OK ||
                    fmu->get(instance, states, 2, r->values[i], 2) != fmi3OK;
    }
    fmu->free_instance(instance);
    return NULL;
}

static void *function(void *library, const char *name)
{
    void *found = dlsym(library, name);
    if (found == NULL)
        fprintf(stderr, "no %s\n", name);
    return found;
}

int main(int count, char **arguments)
{
    static Run threaded[RUNS], single[RUNS];
    void *library = count == 3 ? dlopen(arguments[1], RTLD_NOW) : NULL;
    if (library == NULL)
        return 2;
    Functions fmu;
    *(void **)&fmu.instantiate = function(library, "fmi3InstantiateCoSimulation");
    *(void **)&fmu.set = function(library, "fmi3SetFloat64");
    *(void **)&fmu.get = function(library, "fmi3GetFloat64");
    *(void **)&fmu.enter_initialization = function(library, "fmi3EnterInitializationMode");
    *(void **)&fmu.exit_initialization = function(library, "fmi3ExitInitializationMode");
    *(void **)&fmu.do_step = function(library, "fmi3DoStep");
    *(void **)&fmu.free_instance = function(library, "fmi3FreeInstance");
    pthread_t threads[RUNS];
    for (int i = 0; i < RUNS; ++i) {
        single[i] = threaded[i] = (Run){.fmu = &fmu, .token = arguments[2], .angle = 0.05 * (i + 1)};
        if (pthread_create(&threads[i], NULL, run, &threaded[i]) != 0)
            return 2;
    }
    int differ = 0;
    for (int i = 0; i < RUNS; ++i)
        run(&single[i]);
    for (int i = 0; i < RUNS; ++i) {
        pthread_join(threads[i], NULL);
        differ += threaded[i].failed || single[i].failed ||
                  memcmp(threaded[i].values, single[i].values, sizeof single[i].values) != 0;
    }
    printf("%d runs in threads, %d one by one: %d differ\n", RUNS, RUNS, differ);
    return differ > 0;
}
