/* instance.h - one instance of the model: its numbers, its phase in the life cycle, and its settings.
 *
 * On top of it is a face for the FMI version of the importer, which translates the calls and knows which of them are
 * allowed in which phase. */
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
    PHASE_INTERMEDIATE,    /* Co-Simulation: in an intermediate update during a communication step */
    PHASE_TERMINATED,
    PHASE_ERROR
} Phase;

#define DEFAULT_TOLERANCE 1e-8

/* The differences between FMI versions. */
typedef struct {
    const char *const *phase_names; /* by Phase */
    unsigned told_always;           /* log categories that stay on when the importer switches logging off */
    bool steps_may_be_empty;        /* communication steps of length zero are allowed */
    bool states_settable_in_event_mode;
    bool errors_terminate; /* there is no error state: an error leads to the terminated state */
} Face;

/* How the importer takes part in communication steps; all zero if it does not. */
typedef struct {
    bool event_mode;   /* it carries out Event Mode itself: a step ends at an event at its communication point, ... */
    bool early_return; /* ... and, with this, at any earlier event */
    /* Reports the end of an integrator step at a time, and may move the end of the communication step forward to an
     * earlier time. Returns false if a call in between has ended the simulation. NULL if the importer does not
     * attend. */
    bool (*step_finished)(void *context, double time, double *end);
    void *context;
} Attendance;

typedef struct {
    double start_time;
    double stop_time; /* INFINITY if the importer gives none */
    double tolerance;
} Experiment;

/* What the importer has changed since the equations were last consistent with the values; plain data. */
typedef struct {
    bool any;        /* an input, parameter or input derivative, except in Continuous-Time Mode */
    bool parameters; /* dependent parameters must be computed */
    bool discrete;   /* a change that takes effect only at an event */
} Changes;

/* What is up to date with time, states and inputs; plain data. */
typedef struct {
    bool initialization; /* the initial equations are solved for the start values */
    bool algebraics;
    bool derivatives;
} UpToDate;

/* The state of the co-simulation, which may be ahead of the importer; plain data. */
typedef struct {
    bool event_pending; /* an event is due at the end of the last integrator step */
    size_t relation;    /* the relation that causes it, model.n_relations for a time event */
    double next_time_event;
    double crowd_start; /* start of a crowd: events at practically the same time */
    size_t crowd;       /* number of events in it */
    size_t events;
    bool ended_at_event; /* the last communication step ended at an event, which the importer must carry out */
    Status last_step;    /* the outcome of the last communication step */
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
    double failed_at; /* the time of the last evaluation of derivatives or roots if it failed, else NAN */
    bool warned; /* a warning has been reported since this was last cleared */

    Values start;  /* the values set by the importer before and during initialization */
    Values values; /* the present values */
    double *derivatives;
    Inputs inputs;
    Integrator integrator;
    RootFinder roots;

    double *block; /* holds every array above except inputs.index */
    size_t block_count;
} Instance;

/* Returns NULL if memory runs out. */
Instance *instance_create(bool co_simulation, const Face *face, const Log *log);
void instance_free(Instance *instance);

/* Restores the state after instance_create, except for the log's settings and the attendance. */
void instance_reset(Instance *instance);

/* Checks and sets start time, stop time and tolerance; limits the tolerance to the achievable range. */
Status instance_set_experiment(Instance *instance, double start_time, double stop_time, double tolerance);

/* Applies instance->experiment to the integrator. */
void instance_apply_experiment(Instance *instance);

/* Solves the initial equations for the start values, unless they are already solved. */
Status instance_initialize(Instance *instance);

/* Returns a reporter that writes the model's messages to the log. */
EventReporter instance_reporter(Instance *instance);

#endif
