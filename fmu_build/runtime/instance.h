/* instance.h - one instance of the model: its numbers, its place in the life cycle, and its settings.
 *
 * The FMI version that an importer speaks is a face over this: it translates calls and knows which
 * of them are allowed in which phase. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "events.h"
#include "inputs.h"
#include "integrator.h"
#include "location.h"
#include "log.h"
#include "step_memory.h"
#include "values.h"

typedef enum {
    PHASE_INSTANTIATED,
    PHASE_INITIALIZATION,
    PHASE_EVENT,           /* Model Exchange: Event Mode */
    PHASE_CONTINUOUS_TIME, /* Model Exchange: Continuous-Time Mode */
    PHASE_STEP_COMPLETE,   /* Co-Simulation: between communication steps */
    PHASE_STEP_DISCARDED,  /* Co-Simulation: the model ended within the last step */
    PHASE_TERMINATED,
    PHASE_ERROR
} Phase;

#define DEFAULT_TOLERANCE 1e-8

typedef struct {
    double start_time;
    double stop_time; /* INFINITY where the importer gives none */
    double tolerance;
} Experiment;

/* What the importer changed since the equations were last in step with the values; plain data. */
typedef struct {
    bool any;        /* an input, parameter or input derivative */
    bool parameters; /* dependent parameters are to be computed */
    bool discrete;   /* something that can take effect only at an event */
} Changes;

/* What is in step with time, states and inputs; plain data. */
typedef struct {
    bool initialization; /* the initial equations are solved for the start values */
    bool algebraics;
    bool derivatives;
} UpToDate;

/* How far the co-simulation is ahead of the importer; plain data. */
typedef struct {
    bool event_pending; /* an event follows at the end of the last integrator step */
    size_t relation;    /* that causes it, model.n_relations for a time event */
    double next_time_event;
    double crowd_start; /* all events since this time lie practically at one time */
    size_t crowd;       /* their number */
    size_t events;
    Status last_step; /* outcome of the last communication step */
} Progress;

typedef struct {
    Log log;
    bool co_simulation;
    Phase phase;
    Experiment experiment;
    Changes changed;
    UpToDate current;
    Progress progress;
    StepMemory steps;
    bool warned; /* a warning was reported since this was last cleared */

    Values start;  /* what the importer sets before and during initialisation */
    Values values; /* now */
    double *derivatives;
    Inputs inputs;
    Integrator integrator;
    RootFinder roots;

    double *block; /* holds every array above but inputs.index */
    size_t block_count;
} Instance;

/* NULL where memory is short. */
Instance *instance_create(bool co_simulation, const Log *log);
void instance_free(Instance *instance);

/* Everything but the log's settings as it was after instance_create. */
void instance_reset(Instance *instance);

/* Start and stop time and tolerance, each checked; the tolerance is kept within what double precision can do. */
Status instance_set_experiment(Instance *instance, double start_time, double stop_time, double tolerance);

/* Makes the integrator follow instance->experiment. */
void instance_apply_experiment(Instance *instance);

/* Solves the initial equations for the start values, unless that is done. */
Status instance_initialize(Instance *instance);

/* Passes what the model reports on to the log. */
EventReporter instance_reporter(Instance *instance);

#endif
