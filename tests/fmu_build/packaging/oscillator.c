/* oscillator.c - a hand-written model on model.h: m*der(v) = F - k*x, with one variable of every type. */
#include "model.h"
#include "token.h"

#include <math.h>
#include <stdio.h>

enum { X, V, E, N_Y };
enum { K, M, F, MODE, N, FLAG, N_P };

static const double y_start[N_Y] = {0.1, 0.0, 0.0};
static const double p_start[N_P] = {4.0, 1.0, 0.0, 2.0, 3.0, 1.0};
static const double state_nominal[] = {1.0, 1.0};

#define ALL -INFINITY, INFINITY
static const Variable variables[] = {
    {"time", TYPE_REAL, STORE_TIME, 0, CAUSALITY_INDEPENDENT, VARIABILITY_CONTINUOUS, INITIAL_NONE, ALL},
    {"x", TYPE_REAL, STORE_STATE_OR_ALGEBRAIC, X, CAUSALITY_OUTPUT, VARIABILITY_CONTINUOUS, INITIAL_EXACT, ALL},
    {"v", TYPE_REAL, STORE_STATE_OR_ALGEBRAIC, V, CAUSALITY_LOCAL, VARIABILITY_CONTINUOUS, INITIAL_EXACT, ALL},
    {"der(x)", TYPE_REAL, STORE_DERIVATIVE, X, CAUSALITY_LOCAL, VARIABILITY_CONTINUOUS, INITIAL_CALCULATED, ALL},
    {"der(v)", TYPE_REAL, STORE_DERIVATIVE, V, CAUSALITY_LOCAL, VARIABILITY_CONTINUOUS, INITIAL_CALCULATED, ALL},
    {"k", TYPE_REAL, STORE_PARAMETER, K, CAUSALITY_PARAMETER, VARIABILITY_TUNABLE, INITIAL_EXACT, 0.0, INFINITY},
    {"m", TYPE_REAL, STORE_PARAMETER, M, CAUSALITY_PARAMETER, VARIABILITY_TUNABLE, INITIAL_EXACT, 1e-6, INFINITY},
    {"F", TYPE_REAL, STORE_PARAMETER, F, CAUSALITY_INPUT, VARIABILITY_CONTINUOUS, INITIAL_NONE, ALL},
    {"E", TYPE_REAL, STORE_STATE_OR_ALGEBRAIC, E, CAUSALITY_OUTPUT, VARIABILITY_CONTINUOUS, INITIAL_CALCULATED, ALL},
    {"mode", TYPE_ENUMERATION, STORE_PARAMETER, MODE, CAUSALITY_PARAMETER, VARIABILITY_FIXED, INITIAL_EXACT, 1.0, 2.0},
    {"n", TYPE_INTEGER, STORE_PARAMETER, N, CAUSALITY_PARAMETER, VARIABILITY_FIXED, INITIAL_EXACT, ALL},
    {"flag", TYPE_BOOLEAN, STORE_PARAMETER, FLAG, CAUSALITY_PARAMETER, VARIABILITY_FIXED, INITIAL_EXACT, ALL},
};

const Model model = {
    .name = "Test.Oscillator",
    .token = MODEL_TOKEN,
    .n_states = 2,
    .n_y = N_Y,
    .n_p = N_P,
    .y_start = y_start,
    .p_start = p_start,
    .state_nominal = state_nominal,
    .n_variables = sizeof variables / sizeof *variables,
    .variables = variables,
    .initial_event_slot = NO_SLOT,
    .homotopy_slot = NO_SLOT,
};

bool model_derivatives(double time, double *y, const double *p, double *der, double *root) {
    der[X] = y[V];
    der[V] = (p[F] - p[K] * y[X]) / p[M];
    return root == NULL || model_roots(time, y, p, root);
}

bool model_algebraics(double time, double *y, const double *p) {
    (void)time;
    y[E] = 0.5 * p[K] * y[X] * y[X] + 0.5 * p[M] * y[V] * y[V];
    return true;
}

bool model_roots(double time, double *y, const double *p, double *root) {
    (void)time, (void)y, (void)p, (void)root;
    return true;
}

void model_time_relations(double time, const double *p, double *root) { (void)time, (void)p, (void)root; }

void model_dependent_parameters(double *p) { (void)p; }
void model_start_values(double time, double *y, double *p) { (void)time, (void)y, (void)p; }

void model_initial_residual(double time, const double *y, const double *p, double *residual) {
    (void)time, (void)y, (void)p, (void)residual;
}

void model_discrete(double time, const double *y, const double *p, double *value) {
    (void)time, (void)y, (void)p, (void)value;
}

void model_time_events(const double *p, double *when) { (void)p, (void)when; }

bool model_watched_actions(double time, double *y, const double *p, bool *due)
{
    (void)time;
    (void)y;
    (void)p;
    *due = false;
    return true;
}

void model_actions(double time, const double *y, const double *p, bool *active) {
    (void)time, (void)y, (void)p, (void)active;
}

void model_action_message(size_t action, double time, const double *y, const double *p, char *text, size_t size) {
    (void)action, (void)time, (void)y, (void)p;
    snprintf(text, size, "no actions");
}

void model_parameter_tangents(const double *p, double *dp) { (void)p, (void)dp; }

bool model_tangents(double time, const double *y, const double *p, double dtime, double *dy, double *dp, double *dder)
{
    (void)time, (void)y, (void)p, (void)dtime, (void)dy, (void)dp, (void)dder;
    return false;
}

void model_start_tangents(const double *y, const double *p, double *dy, const double *dp)
{
    (void)y, (void)p, (void)dy, (void)dp;
}

void model_initial_residual_tangents(double time, const double *y, const double *p, double dtime, const double *dy,
                                     const double *dp, double *residual)
{
    (void)time, (void)y, (void)p, (void)dtime, (void)dy, (void)dp, (void)residual;
}
