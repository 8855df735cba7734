/* fmu_loop.c - the minimal importer of a Co-Simulation FMU (FMI 2.0): load the library once, then repeatedly reset, set
 * the release angle, step, and read theta, omega and alpha. */
#define _POSIX_C_SOURCE 200809L
#include "measure.h"

#include "fmi2FunctionTypes.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static const double duration = 1.5;

typedef struct {
    fmi2InstantiateTYPE *instantiate;
    fmi2FreeInstanceTYPE *free_instance;
    fmi2SetupExperimentTYPE *setup_experiment;
    fmi2EnterInitializationModeTYPE *enter_initialization_mode;
    fmi2ExitInitializationModeTYPE *exit_initialization_mode;
    fmi2SetRealTYPE *set_real;
    fmi2GetRealTYPE *get_real;
    fmi2DoStepTYPE *do_step;
    fmi2ResetTYPE *reset;
    /* Only in a library built for counting: its number of right-hand side evaluations so far. */
    unsigned long *evaluations;
} Functions;

typedef struct {
    Functions fmu;
    fmi2Component component;
    double tolerance, theta_start;
    fmi2ValueReference start_reference, references[3];
    size_t steps;
    Sample *samples; /* [steps + 1] */
    unsigned long evaluations;
} Job;

static void log_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                        fmi2String category, fmi2String message, ...)
{
    (void)environment;
    fprintf(stderr, "%s: %s, status %d: %s\n", instance, category, (int)status, message);
}

/* ISO C cannot convert void * to a pointer to a function; this is the way that POSIX specifies. */
static void find(void *library, const char *name, void *function)
{
    *(void **)function = dlsym(library, name);
    if (*(void **)function == NULL) {
        fprintf(stderr, "the library has no function %s\n", name);
        exit(EXIT_FAILURE);
    }
}

static Functions load(const char *path)
{
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    Functions fmu;
    find(library, "fmi2Instantiate", &fmu.instantiate);
    find(library, "fmi2FreeInstance", &fmu.free_instance);
    find(library, "fmi2SetupExperiment", &fmu.setup_experiment);
    find(library, "fmi2EnterInitializationMode", &fmu.enter_initialization_mode);
    find(library, "fmi2ExitInitializationMode", &fmu.exit_initialization_mode);
    find(library, "fmi2SetReal", &fmu.set_real);
    find(library, "fmi2GetReal", &fmu.get_real);
    find(library, "fmi2DoStep", &fmu.do_step);
    find(library, "fmi2Reset", &fmu.reset);
    fmu.evaluations = dlsym(library, "derivative_evaluations");
    return fmu;
}

static bool read_sample(const Job *job, Sample *sample)
{
    fmi2Real value[3];
    if (job->fmu.get_real(job->component, job->references, 3, value) != fmi2OK)
        return false;
    *sample = (Sample){value[0], value[1], value[2]};
    return true;
}

static bool run(void *context)
{
    Job *job = context;
    const Functions *fmu = &job->fmu;
    const fmi2Component c = job->component;
    const unsigned long before = fmu->evaluations != NULL ? *fmu->evaluations : 0;
    if (fmu->reset(c) != fmi2OK ||
        fmu->setup_experiment(c, fmi2True, job->tolerance, 0.0, fmi2True, duration) != fmi2OK ||
        fmu->set_real(c, &job->start_reference, 1, &job->theta_start) != fmi2OK ||
        fmu->enter_initialization_mode(c) != fmi2OK || fmu->exit_initialization_mode(c) != fmi2OK ||
        !read_sample(job, &job->samples[0]))
        return false;
    const double interval = duration / (double)job->steps;
    for (size_t i = 0; i < job->steps; ++i) {
        if (fmu->do_step(c, (double)i * interval, interval, fmi2True) != fmi2OK ||
            !read_sample(job, &job->samples[i + 1]))
            return false;
    }
    job->evaluations = fmu->evaluations != NULL ? *fmu->evaluations - before : 0;
    return true;
}

int main(int argc, char *argv[])
{
    if (argc != 13 && argc != 14) {
        fprintf(stderr,
                "usage: %s LIBRARY GUID RESOURCES TOLERANCE THETA_START STEPS BATCHES RUNS\n"
                "       REFERENCE_OF_THETA_START _OF_THETA _OF_OMEGA _OF_ALPHA [SAMPLES_FILE]\n",
                argv[0]);
        return EXIT_FAILURE;
    }
    Job job = {
        .fmu = load(argv[1]),
        .tolerance = number_argument("TOLERANCE", argv[4]),
        .theta_start = number_argument("THETA_START", argv[5]),
        .steps = count_argument("STEPS", argv[6], 1),
        .start_reference = (fmi2ValueReference)count_argument("REFERENCE", argv[9], 0),
    };
    for (int i = 0; i < 3; ++i)
        job.references[i] = (fmi2ValueReference)count_argument("REFERENCE", argv[10 + i], 0);
    const size_t batches = count_argument("BATCHES", argv[7], 1), runs = count_argument("RUNS", argv[8], 1);
    const fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};
    job.component =
        job.fmu.instantiate("bench", fmi2CoSimulation, argv[2], argv[3], &callbacks, fmi2False, fmi2False);
    job.samples = calloc(job.steps + 1, sizeof(Sample));
    if (job.component == NULL || job.samples == NULL) {
        fprintf(stderr, "%s could not be instantiated\n", argv[1]);
        return EXIT_FAILURE;
    }
    const double seconds = measure(run, &job, batches, runs);
    print_result(seconds, job.samples, job.steps + 1, job.evaluations);
    if (argc == 14)
        write_samples(argv[13], job.samples, job.steps + 1);
    job.fmu.free_instance(job.component);
    free(job.samples);
    return EXIT_SUCCESS;
}
