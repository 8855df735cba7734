/* model.h - the contract between one generated model and the runtime.
 *
 * The generator writes one C file that defines everything declared here; the rest of the
 * runtime is the same for every model and knows the model through this header alone.
 *
 * All values of an instance live in two arrays of double:
 *   y   continuous variables: the states first, then the algebraic variables
 *   p   everything that is constant between events: parameters, inputs, discrete variables,
 *       pre() slots, condition and relation memories, clock ticks
 * Integers, Booleans (0 or 1) and enumerations (1, 2, ...) are stored as doubles.
 */
#ifndef MODEL_H
#define MODEL_H

#include <stdbool.h>
#include <stddef.h>

typedef enum { STORE_STATE_OR_ALGEBRAIC /* y */, STORE_PARAMETER /* p */, STORE_DERIVATIVE, STORE_TIME } Store;
typedef enum { TYPE_REAL = 1, TYPE_INTEGER = 2, TYPE_BOOLEAN = 4, TYPE_ENUMERATION = 8 } ValueType; /* or a set */
typedef enum {
    CAUSALITY_PARAMETER,
    CAUSALITY_CALCULATED_PARAMETER,
    CAUSALITY_INPUT,
    CAUSALITY_OUTPUT,
    CAUSALITY_LOCAL,
    CAUSALITY_INDEPENDENT
} Causality;
typedef enum {
    VARIABILITY_CONSTANT,
    VARIABILITY_FIXED,
    VARIABILITY_TUNABLE,
    VARIABILITY_DISCRETE,
    VARIABILITY_CONTINUOUS
} Variability;
typedef enum { INITIAL_EXACT, INITIAL_APPROX, INITIAL_CALCULATED, INITIAL_NONE } Initial;

/* One variable as importers see it. Its value reference is its position in model.variables. */
typedef struct {
    const char *name;
    ValueType type;
    Store store;
    size_t index; /* in y, p or the derivatives */
    Causality causality;
    Variability variability;
    Initial initial;
    double start;
    double min, max; /* -INFINITY and INFINITY where the model gives none */
} Variable;

/* A system of algebraic equations that has to be solved by Newton's method. */
typedef struct {
    size_t index; /* in y */
    const char *name;
    double nominal;
} BlockUnknown;
typedef struct {
    size_t size;
    const BlockUnknown *unknowns;
    bool linear; /* in the unknowns */
    void (*residual)(double time, const double *y, const double *p, double *residual);
    void (*jacobian)(double time, const double *y, const double *p, double *jacobian); /* row-major */
} Block;

/* The value at the entry of the event, kept in p for pre(): p[slot] = y or p [source]. */
typedef struct {
    size_t slot;
    Store source_store;
    size_t source;
} PreBinding;

/* relation memory p[memory] = 1 where the relation holds, that is where its root is negative,
 * or where the root is exactly zero and holds_at_zero says so. Relations of one root agree in holds_at_zero, and
 * so in their memories. Roots from n_roots on are those of model_time_relations: they change at time events only
 * and are not watched for zero crossings. */
typedef struct {
    size_t root;
    size_t memory;
    bool holds_at_zero;
} Relation;

/* Whether a relation holds for a value of its root. */
static inline bool relation_holds(const Relation *relation, double root)
{
    return root < 0.0 || (root == 0.0 && relation->holds_at_zero);
}

/* What a discrete equation sets, and when:
 * ASSIGN     in every pass of the event iteration,
 * CONDITION  the memory from which edges are found: committed when a pass has settled,
 * REINIT     a state: committed with the conditions. */
typedef enum { DISCRETE_ASSIGN, DISCRETE_CONDITION, DISCRETE_REINIT } DiscreteKind;
typedef struct {
    DiscreteKind kind;
    Store store;
    size_t index;
} DiscreteTarget;

/* Ticks at phase + n*period, n = 0, 1, ...; p[activation] is 1 in the first pass of the event of a tick. */
typedef struct {
    size_t activation;
    double period_numerator, period_denominator, phase_numerator, phase_denominator;
} PeriodicClock;

/* assert(), terminate() and warnings. */
typedef enum { ACTION_ERROR, ACTION_WARNING, ACTION_TERMINATE } ActionKind;

/* An unknown of the initial equations: y or p. */
typedef struct {
    Store store;
    size_t index;
    const char *name;
} InitialUnknown;

#define NO_SLOT ((size_t)-1)

typedef struct {
    const char *name;  /* the Modelica class */
    const char *token; /* FMI 2: GUID, FMI 3: instantiation token */

    size_t n_states, n_y, n_p;
    const double *y_start, *p_start; /* before any start value is set */
    const double *state_nominal;

    size_t n_variables;
    const Variable *variables;

    size_t n_roots; /* zero crossings */
    const char *const *root_texts; /* [n_roots] each as Modelica, for messages */
    bool roots_follow_time;   /* some zero crossing depends on time otherwise than through states */
    bool roots_follow_inputs; /* or on a continuous input */
    size_t n_time_relations;
    size_t n_relations;
    const Relation *relations;
    const size_t *opposites; /* [n_relations] position of a relation of the negated root where both are false at zero,
                              * n_relations for none; NULL where there are no such two */

    size_t n_pre;
    const PreBinding *pre;
    size_t n_discrete;
    const DiscreteTarget *discrete;
    size_t n_clocks;
    const PeriodicClock *clocks;
    size_t n_time_events; /* see model_time_events */
    size_t n_actions;
    const ActionKind *actions;
    bool actions_follow_states;    /* some action can become due between events */
    bool actions_read_algebraic;   /* the condition of some action reads an algebraic variable */
    bool discrete_reads_algebraic; /* and some discrete equation */
    size_t initial_event_slot; /* p[slot] is 1 during initialisation, or NO_SLOT */

    size_t n_initial_unknowns;
    const InitialUnknown *initial_unknowns;

    size_t n_blocks;
    const Block *const *blocks; /* in the order in which model_algebraics solves them */

    bool has_tangents;         /* the functions of tangents below are there */
    bool has_initial_tangents; /* and cover the initialization: no when-clause may move a value there */
} Model;

extern const Model model;

/* The functions below return true on success and false when a block has no solution at this point.
 * They read the states y[0..n_states) and p; blocks take the old values in y as their first guess. */

/* der = d(states)/dt, and the roots of model_roots unless root is NULL. Computes what it needs; leaves the algebraic
 * variables of y, blocks apart, as they were. */
bool model_derivatives(double time, double *y, const double *p, double *der, double *root);
/* All algebraic variables of y. */
bool model_algebraics(double time, double *y, const double *p);
/* root[0..n_roots) = lhs - rhs of each relation, the smaller side first for "<" and "<=". */
bool model_roots(double time, double *y, const double *p, double *root);

/* root[0..n_time_relations) = lhs - rhs of the relations that depend on time and p alone. */
void model_time_relations(double time, const double *p, double *root);

/* p: parameters that are computed from other parameters. */
void model_dependent_parameters(double *p);
/* y, p: start values that are computed from parameters; only in initialisation. */
void model_start_values(double *y, double *p);
/* residual[0..n_initial_unknowns) of the initial equations; the algebraic variables of y are up to date. */
void model_initial_residual(double time, const double *y, const double *p, double *residual);

/* Tangents: how far each value moves, dy[i] beside y[i] and dp[i] beside p[i], when states, inputs, parameters and time
 * move a little. Relations and when-clauses are held. All of y and p is up to date and stays as it is. */

/* dp: of parameters that are computed from other parameters. */
void model_parameter_tangents(const double *p, double *dp);
/* dy: of all algebraic variables; dder: of the derivatives; dp: of discrete variables that follow others at all times.
 * False where a block does not determine them. */
bool model_tangents(double time, const double *y, const double *p, double dtime, double *dy, double *dp, double *dder);
/* dy: of states whose start value is computed from parameters. */
void model_start_tangents(const double *y, const double *p, double *dy, const double *dp);
/* residual: of the initial equations. */
void model_initial_residual_tangents(double time, const double *y, const double *p, double dtime, const double *dy,
                                     const double *dp, double *residual);

/* *due = whether an action is due that can become so between events; computes no more than that needs. */
bool model_watched_actions(double time, double *y, const double *p, bool *due);
/* value[0..n_discrete) = right-hand sides of the discrete equations; y's algebraic variables are up to date
 * where discrete_reads_algebraic says that they are read. */
void model_discrete(double time, const double *y, const double *p, double *value);
/* when[0..n_time_events) = the times of time events; past ones and NaN count as none. */
void model_time_events(const double *p, double *when);
/* active[0..n_actions): true where the action must be taken. */
void model_actions(double time, const double *y, const double *p, bool *active);
/* The message of one action, formatted into text[0..size). */
void model_action_message(size_t action, double time, const double *y, const double *p, char *text, size_t size);

#endif
