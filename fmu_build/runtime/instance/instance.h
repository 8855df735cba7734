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
    PHASE_EVENT,           /* Event Mode */
    PHASE_CONTINUOUS_TIME, /* Model Exchange: Continuous-Time Mode */
    PHASE_STEP_COMPLETE,   /* Co-Simulation: between communication steps */
    PHASE_STEP_DISCARDED,  /* Co-Simulation: the model ended within the last step */
    PHASE_INTERMEDIATE,    /* Co-Simulation: the importer is told of a communication step that is under way */
    PHASE_TERMINATED,
    PHASE_ERROR
} Phase;

#define DEFAULT_TOLERANCE 1e-8

/* What a version of FMI has in its own way. */
typedef struct {
    const char *const *phase_names; /* by Phase */
    unsigned told_always;           /* log categories that are on however the importer sets the log */
    bool steps_may_be_empty;        /* communication steps of length zero are allowed */
    bool states_settable_in_event_mode;
} Face;

/* How the importer takes part in communication steps; all zero where it does not. */
typedef struct {
    bool event_mode;   /* it calls Event Mode itself: a step ends at an event, ... */
    bool early_return; /* ... before its communication point where this is set */
    /* Tells it of a step of the integrator that ended at a time; it may move the end of the communication step to an
     * earlier time. False where it made a fatal call. NULL where it does not want to know. */
    bool (*step_finished)(void *context, double time, double *end);
    void *context;
} Attendance;

typedef struct {
    double start_time;
    double stop_time; /* INFINITY where the importer gives none */
    double tolerance;
} Experiment;

/* What the importer changed since the equations were last in step with the values; plain data. */
typedef struct {
    bool any;        /* an input, parameter or input derivative, but for inputs that move in Continuous-Time Mode */
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
    bool ended_at_event; /* the last communication step ended before an event, which the importer must carry out */
    Status last_step;    /* its outcome */
} Progress;

typedef struct {
    Log log;
    const Face *face;
    const char *call; /* name of the function that the importer called last */
    bool co_simulation;
    Attendance attendance;
    Phase phase;
    Experiment experiment;
    Changes changed;
    UpToDate current;
    Progress progress;
    StepMemory steps;
    double failed_at; /* the time at which derivatives or roots could not be computed last, or NAN */
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
Instance *instance_create(bool co_simulation, const Face *face, const Log *log);
void instance_free(Instance *instance);

/* Everything but the log's settings and the attendance as it was after instance_create. */
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
