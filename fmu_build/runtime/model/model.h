/* model.h - the contract between one generated model and the runtime.
 *
 * The generator writes one C file that defines everything declared here; the rest of the
 * runtime is the same for every model and knows the model only through this header.
 *
 * All values of an instance are in two arrays of double:
 *   y   continuous variables: the states first, then the algebraic variables
 *   p   everything that the equations read as constant between events: parameters, inputs, discrete
 *       variables, pre() slots, condition and relation memories, clock ticks
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

/* One variable as exposed to importers. Its value reference is its position in model.variables. */
typedef struct {
    const char *name;
    ValueType type;
    Store store;
    size_t index; /* in y, p or the derivatives */
    Causality causality;
    Variability variability;
    Initial initial;
    double min, max; /* -INFINITY and INFINITY if the model gives none */
} Variable;

/* An algebraic loop, solved by Newton's method. */
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

/* The value before the current pass of the event iteration, kept in p for pre(): p[slot] = y or p [source]. */
typedef struct {
    size_t slot;
    Store source_store;
    size_t source;
} PreBinding;

/* The relation memory p[memory] is 1 if the relation holds, that is if its root is negative, or exactly zero with
 * holds_at_zero. Relations with the same root agree in holds_at_zero, and so in their memories. Roots from n_roots
 * on are those of model_time_relations: they change only at time events and are not monitored for zero crossings. */
typedef struct {
    size_t root;
    size_t memory;
    bool holds_at_zero;
} Relation;

/* Returns whether a relation holds for a value of its root. */
static inline bool relation_holds(const Relation *relation, double root)
{
    return root < 0.0 || (root == 0.0 && relation->holds_at_zero);
}

/* What a discrete equation sets, and when:
 * ASSIGN     a variable, in every pass of the event iteration,
 * CONDITION  the memory that detects edges: committed when a pass has settled,
 * REINIT     a state: committed together with the conditions. */
typedef enum { DISCRETE_ASSIGN, DISCRETE_CONDITION, DISCRETE_REINIT } DiscreteKind;
typedef struct {
    DiscreteKind kind;
    Store store;
    size_t index;
} DiscreteTarget;

/* Ticks at phase + n*period, n = 0, 1, ...; p[activation] is 1 in the first pass of the event at a tick. */
typedef struct {
    size_t activation;
    double period_numerator, period_denominator, phase_numerator, phase_denominator;
    bool counts_from_start; /* the phase counts from the start of the simulation instead of time 0 */
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

/* Sensitivities by parameters: derivatives of all values at a fixed time along the run so far. Sensitivities of states
 * are states too: the model's own states are y[0..n_states), and their derivatives by parameter j are y[(1 + j) *
 * n_states..(2 + j) * n_states). During an event, all sensitivities are derivatives of the values at the event, whose
 * time moves with the parameter. */
typedef struct {
    size_t move;      /* p[move] is the derivative of the event's time by the parameter during an event, else 0 */
    size_t next_move; /* p[next_move] is the same for the next event */
} EventMove;
typedef struct {
    size_t n_states; /* the model's own */
    size_t n_parameters;
    const EventMove *moves; /* [n_parameters] */
    /* For each root of model_roots, then of model_time_relations: its derivative along the motion, and those by each
     * parameter at a fixed time, all within the active branch: rate[(1 + n_parameters) * root...]. */
    bool (*root_rates)(double time, double *y, const double *p, double *rate);
} Sensitivities;

typedef struct {
    const char *name;  /* the Modelica class */
    const char *token; /* FMI 2: GUID, FMI 3: instantiation token */

    size_t n_states, n_y, n_p;
    const double *y_start, *p_start; /* before any start value is set */
    const double *state_nominal;

    size_t n_variables;
    const Variable *variables;

    size_t n_roots; /* zero-crossing functions */
    const char *const *root_texts; /* [n_roots] in Modelica, for messages */
    bool roots_follow_time;   /* some root depends on time other than through states */
    bool roots_follow_inputs; /* some root depends on a continuous input */
    size_t n_time_relations;
    size_t n_relations;
    const Relation *relations;
    const size_t *opposites; /* [n_relations] position of a relation with the negated root if both are false at zero,
                              * n_relations for none; NULL if there is no such pair */

    size_t n_pre;
    const PreBinding *pre;
    size_t n_discrete;
    const DiscreteTarget *discrete;
    size_t n_clocks;
    const PeriodicClock *clocks;
    size_t n_time_events; /* see model_time_events */
    size_t n_actions;
    const ActionKind *actions;
    bool actions_follow_states;    /* some action can become due between events: its condition reads y or time */
    bool actions_read_algebraic;   /* some action's condition reads an algebraic variable */
    bool discrete_reads_algebraic; /* some discrete equation, or a pre(), reads an algebraic variable */
    bool has_left_limits;          /* a pre() reads an algebraic variable */
    size_t initial_event_slot; /* p[slot] is 1 during initialization; or NO_SLOT */
    size_t homotopy_slot; /* p[slot] is 1 where homotopy() is its simplified expression, 0 where it is the actual one,
                           * as it is after initialization; or NO_SLOT */

    size_t n_initial_unknowns;
    const InitialUnknown *initial_unknowns;

    size_t n_blocks;
    const Block *const *blocks; /* in the order in which model_algebraics solves them */

    bool has_tangents;         /* the tangent functions below are not empty */
    bool has_initial_tangents; /* they also hold across initialization: no when-clause may change a value there */

    const Sensitivities *sensitivities; /* NULL if the model has none */
} Model;

extern const Model model;

/* Of the functions below, those of type bool return true on success and false if a block has no solution at this
 * point. They read the states y[0..n_states) and p; blocks use the old values in y as initial guesses. */

/* der = d(states)/dt, and the roots of model_roots unless root is NULL. Computes only what it needs; may change the
 * algebraic variables in y that belong to blocks or that blocks read, and no others. */
bool model_derivatives(double time, double *y, const double *p, double *der, double *root);
/* Computes all algebraic variables in y. */
bool model_algebraics(double time, double *y, const double *p);
/* root[0..n_roots): for each relation, the side that must be smaller minus the other. */
bool model_roots(double time, double *y, const double *p, double *root);

/* root[0..n_time_relations): the same for relations that depend only on time and p. */
void model_time_relations(double time, const double *p, double *root);

/* Computes parameters in p from other parameters. */
void model_dependent_parameters(double *p);
/* Computes start values in y and p from parameters and time; called only during initialization. */
void model_start_values(double time, double *y, double *p);
/* residual[0..n_initial_unknowns) of the initial equations; the algebraic variables in y must be up to date. */
void model_initial_residual(double time, const double *y, const double *p, double *residual);

/* Forward-mode tangents: dy[i] of y[i] and dp[i] of p[i] with respect to states, inputs, parameters and time. Relations
 * and when-clauses count as constant. All of y and p must be up to date; neither is changed. */

/* dp of parameters that are computed from other parameters. */
void model_parameter_tangents(const double *p, double *dp);
/* dy of all algebraic variables, dder of the derivatives, dp of discrete variables whose equation holds at all times.
 * Returns false if a block's Jacobian is singular. */
bool model_tangents(double time, const double *y, const double *p, double dtime, double *dy, double *dp, double *dder);
/* dy of states whose start value is computed from parameters. */
void model_start_tangents(const double *y, const double *p, double *dy, const double *dp);
/* residual: the tangents of the residuals of the initial equations. */
void model_initial_residual_tangents(double time, const double *y, const double *p, double dtime, const double *dy,
                                     const double *dp, double *residual);

/* *due = whether an action that can become due between events is due; computes only what it needs. */
bool model_watched_actions(double time, double *y, const double *p, bool *due);
/* value[0..n_discrete) = right-hand sides of the discrete equations; the algebraic variables in y must be up to date if
 * discrete_reads_algebraic. */
void model_discrete(double time, const double *y, const double *p, double *value);
/* when[0..n_time_events) = the times of time events; past times and NaN mean none. */
void model_time_events(const double *p, double *when);
/* active[0..n_actions): whether each action must be executed. */
void model_actions(double time, const double *y, const double *p, bool *active);
/* Formats the message of one action into text[0..size). */
void model_action_message(size_t action, double time, const double *y, const double *p, char *text, size_t size);

#endif
