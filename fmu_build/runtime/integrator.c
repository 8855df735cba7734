#include "integrator.h"
#include "model.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The method's nodes, weights (a7j are those of order 5), error weights and dense output weights. */
static const double c2 = 1.0 / 5, c3 = 3.0 / 10, c4 = 4.0 / 5, c5 = 8.0 / 9;
static const double a21 = 1.0 / 5;
static const double a31 = 3.0 / 40, a32 = 9.0 / 40;
static const double a41 = 44.0 / 45, a42 = -56.0 / 15, a43 = 32.0 / 9;
static const double a51 = 19372.0 / 6561, a52 = -25360.0 / 2187, a53 = 64448.0 / 6561, a54 = -212.0 / 729;
static const double a61 = 9017.0 / 3168, a62 = -355.0 / 33, a63 = 46732.0 / 5247, a64 = 49.0 / 176,
                    a65 = -5103.0 / 18656;
static const double a71 = 35.0 / 384, a73 = 500.0 / 1113, a74 = 125.0 / 192, a75 = -2187.0 / 6784, a76 = 11.0 / 84;
static const double e1 = 71.0 / 57600, e3 = -71.0 / 16695, e4 = 71.0 / 1920, e5 = -17253.0 / 339200, e6 = 22.0 / 525,
                    e7 = -1.0 / 40;
static const double d1 = -12715105075.0 / 11282082432.0, d3 = 87487479700.0 / 32700410799.0,
                    d4 = -10690763975.0 / 1880347072.0, d5 = 701980252875.0 / 199316789632.0,
                    d6 = -1453857185.0 / 822651844.0, d7 = 69997945.0 / 29380423.0;

static const double safety = 0.9, smallest_factor = 0.1, largest_factor = 5.0;

enum { ARRAYS = 1 + 7 + 5 };

size_t integrator_count(void)
{
    return ARRAYS * model.n_states;
}

void integrator_bind(Integrator *integrator, double *block)
{
    const size_t n = model.n_states;
    integrator->states = block;
    for (size_t i = 0; i < 7; ++i)
        integrator->slopes[i] = block + (1 + i) * n;
    for (size_t i = 0; i < 5; ++i)
        integrator->dense[i] = block + (8 + i) * n;
}

void integrator_restart(Integrator *integrator, double time, const double *states)
{
    StepRecord *record = &integrator->record;
    record->time = record->base = time;
    record->step = 0.0;
    record->slope_known = false;
    if (model.n_states > 0)
        memmove(integrator->states, states, model.n_states * sizeof(double));
}

void integrator_interpolate(const Integrator *integrator, double time, double *states)
{
    const StepRecord *record = &integrator->record;
    if (time == record->time) {
        if (model.n_states > 0)
            memcpy(states, integrator->states, model.n_states * sizeof(double));
        return;
    }
    const double s = (time - record->base) / record->step, r = 1.0 - s;
    const double *r1 = integrator->dense[0], *r2 = integrator->dense[1], *r3 = integrator->dense[2],
                 *r4 = integrator->dense[3], *r5 = integrator->dense[4];
    for (size_t i = 0; i < model.n_states; ++i)
        states[i] = r1[i] + s * (r2[i] + r * (r3[i] + s * (r4[i] + r * r5[i])));
}

void integrator_truncate(Integrator *integrator, double time)
{
    StepRecord *record = &integrator->record;
    integrator_interpolate(integrator, time, integrator->states);
    record->time = time;
    record->slope_known = false;
    /* What was cut off must not let the steps grow, for the dense output of a step that is far too long for what
     * is used of it is spoilt by rounding. */
    record->suggestion = fmin(record->suggestion, record->step);
}

/* x^(-1/10) within 0.7 % between the values of it that no step size uses, 0.1 and 6.3. That is plenty for a
 * step size, takes far less time than pow(), and gives the same number on every platform. */
static double inverse_tenth_root(double x)
{
    static const double powers[10] = {1.0,      0.933033, 0.870551, 0.812252, 0.757858,
                                      0.707107, 0.659754, 0.615572, 0.574349, 0.535887}; /* 2^(-i/10) */
    int exponent;
    const double mantissa = frexp(fmin(fmax(x, 1e-8), 1e10), &exponent); /* in [0.5, 1) */
    const int whole = exponent >= 0 ? exponent / 10 : -((9 - exponent) / 10);
    const double power = whole >= 0 ? 1.0 / (1 << whole) : 1 << -whole;
    return powers[exponent - 10 * whole] * power * (1.0 + 0.143547 * (1.0 - mantissa));
}

static bool evaluate(Integrator *integrator, double time, double *slope)
{
    ++integrator->record.evaluations;
    return integrator_derivatives(integrator->context, time, slope);
}

static double weight(const Integrator *integrator, size_t i, double magnitude)
{
    return 1.0 / (integrator->tolerance * (integrator->nominal[i] + magnitude));
}

/* A first step from the sizes of the first and second derivatives (Hairer, Norsett and Wanner, section II.4). */
static bool guess_step(Integrator *integrator)
{
    const size_t n = model.n_states;
    StepRecord *record = &integrator->record;
    const double *slope = integrator->slopes[0];
    double *other = integrator->slopes[1];
    double states_norm = 0.0, slope_norm = 0.0, curvature = 0.0;
    for (size_t i = 0; i < n; ++i) {
        const double w = weight(integrator, i, fabs(integrator->states[i]));
        states_norm = fmax(states_norm, fabs(w * integrator->states[i]));
        slope_norm = fmax(slope_norm, fabs(w * slope[i]));
    }
    const double usable = states_norm >= 1e-5 && slope_norm >= 1e-5;
    const double small = fmin(usable ? 0.01 * states_norm / slope_norm : 1e-6, integrator->largest_step);
    for (size_t i = 0; i < n; ++i)
        integrator->argument[i] = integrator->states[i] + small * slope[i];
    if (!evaluate(integrator, record->time + small, other))
        return false;
    for (size_t i = 0; i < n; ++i)
        curvature = fmax(curvature, fabs(weight(integrator, i, fabs(integrator->states[i])) * (other[i] - slope[i])));
    const double largest = fmax(slope_norm, curvature / small);
    const double fitting = largest <= 1e-15 ? fmax(1e-6, small * 1e-3) : pow(0.01 / largest, 0.2);
    record->suggestion = fmin(fmin(100.0 * small, fitting), integrator->largest_step);
    return isfinite(record->suggestion);
}

/* The stages of one step of size h; the result of order 5 is left in `argument`. */
static bool stages(Integrator *integrator, double h)
{
    const size_t n = model.n_states;
    const double t = integrator->record.time;
    const double *y = integrator->states;
    double *out = integrator->argument;
    double *k1 = integrator->slopes[0], *k2 = integrator->slopes[1], *k3 = integrator->slopes[2],
           *k4 = integrator->slopes[3], *k5 = integrator->slopes[4], *k6 = integrator->slopes[5],
           *k7 = integrator->slopes[6];
    for (size_t i = 0; i < n; ++i)
        out[i] = y[i] + h * a21 * k1[i];
    if (!evaluate(integrator, t + c2 * h, k2))
        return false;
    for (size_t i = 0; i < n; ++i)
        out[i] = y[i] + h * (a31 * k1[i] + a32 * k2[i]);
    if (!evaluate(integrator, t + c3 * h, k3))
        return false;
    for (size_t i = 0; i < n; ++i)
        out[i] = y[i] + h * (a41 * k1[i] + a42 * k2[i] + a43 * k3[i]);
    if (!evaluate(integrator, t + c4 * h, k4))
        return false;
    for (size_t i = 0; i < n; ++i)
        out[i] = y[i] + h * (a51 * k1[i] + a52 * k2[i] + a53 * k3[i] + a54 * k4[i]);
    if (!evaluate(integrator, t + c5 * h, k5))
        return false;
    for (size_t i = 0; i < n; ++i)
        out[i] = y[i] + h * (a61 * k1[i] + a62 * k2[i] + a63 * k3[i] + a64 * k4[i] + a65 * k5[i]);
    if (!evaluate(integrator, t + h, k6))
        return false;
    for (size_t i = 0; i < n; ++i)
        out[i] = y[i] + h * (a71 * k1[i] + a73 * k3[i] + a74 * k4[i] + a75 * k5[i] + a76 * k6[i]);
    return evaluate(integrator, t + h, k7);
}

/* Mean square, in units of the tolerance, of the error estimate and of the rounding in the dense output, which is
 * relative to the change over the whole step. */
static double squared_error(const Integrator *integrator, double h)
{
    double *const *k = integrator->slopes;
    double sum = 0.0;
    for (size_t i = 0; i < model.n_states; ++i) {
        const double error = e1 * k[0][i] + e3 * k[2][i] + e4 * k[3][i] + e5 * k[4][i] + e6 * k[5][i] + e7 * k[6][i];
        const double rounding = DBL_EPSILON * (integrator->argument[i] - integrator->states[i]);
        const double scaled = (fabs(h * error) + fabs(rounding)) * weight(integrator, i, fabs(integrator->states[i]));
        sum += scaled * scaled;
    }
    return model.n_states > 0 ? sum / (double)model.n_states : 0.0;
}

/* Takes the step over: the dense output, the new states and the first slope of the next step. */
static void accept(Integrator *integrator, double h, double end)
{
    const size_t n = model.n_states;
    StepRecord *record = &integrator->record;
    double *const *k = integrator->slopes;
    double *const *r = integrator->dense;
    for (size_t i = 0; i < n; ++i) {
        const double change = integrator->argument[i] - integrator->states[i];
        const double bend = h * k[0][i] - change;
        r[0][i] = integrator->states[i];
        r[1][i] = change;
        r[2][i] = bend;
        r[3][i] = change - h * k[6][i] - bend;
        r[4][i] = h * (d1 * k[0][i] + d3 * k[2][i] + d4 * k[3][i] + d5 * k[4][i] + d6 * k[5][i] + d7 * k[6][i]);
        integrator->states[i] = integrator->argument[i];
        k[0][i] = k[6][i];
    }
    record->base = record->time;
    record->step = h;
    record->time = end;
    record->slope_known = true;
    ++record->accepted;
}

/* Derivatives at the start of the step, and a size to try. */
static bool prepare(Integrator *integrator)
{
    StepRecord *record = &integrator->record;
    if (!record->slope_known) {
        if (model.n_states > 0)
            memcpy(integrator->argument, integrator->states, model.n_states * sizeof(double));
        if (!evaluate(integrator, record->time, integrator->slopes[0]))
            return false;
        record->slope_known = true;
    }
    return record->suggestion > 0.0 || guess_step(integrator);
}

StepResult integrator_step(Integrator *integrator, double limit)
{
    if (!prepare(integrator))
        return STEP_NOT_COMPUTABLE;
    StepRecord *record = &integrator->record;
    const double smallest = fmax(16.0 * DBL_EPSILON * fabs(record->time), 16.0 * DBL_MIN);
    double h = fmin(record->suggestion, integrator->largest_step);
    bool rejected = false;
    for (;;) {
        /* A step that would leave a sliver before the limit is stretched to it. */
        const bool limited = record->time + 1.01 * h >= limit;
        if (limited)
            h = limit - record->time;
        const bool computed = stages(integrator, h);
        const double error = computed ? squared_error(integrator, h) : INFINITY;
        if (error <= 1.0) {
            const double factor = fmin(safety * inverse_tenth_root(error), rejected ? 1.0 : largest_factor);
            const double next = h * fmax(factor, smallest_factor);
            record->suggestion = limited ? fmax(next, record->suggestion) : next;
            accept(integrator, h, limited ? limit : record->time + h);
            return STEP_DONE;
        }
        ++record->rejected;
        rejected = true;
        h *= isfinite(error) ? fmax(safety * inverse_tenth_root(error), smallest_factor) : smallest_factor;
        record->suggestion = h;
        if (!(h > smallest))
            return isfinite(error) ? STEP_TOO_SMALL : STEP_NOT_COMPUTABLE;
    }
}
