#include "integrator.h"
#include "cold.h"
#include "extremes.h"
#include "model.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* The method's nodes, weights (a7j are those of order 5), error weights and dense output weights. */
enum { STAGES = 7 };
static const double nodes[STAGES - 1] = {1.0 / 5, 3.0 / 10, SAMPLE_FRACTION, 8.0 / 9, 1.0, 1.0}; /* of stages 2 to 7 */
static const double weights[STAGES - 1][STAGES - 1] = {
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};
static const double e1 = 71.0 / 57600, e3 = -71.0 / 16695, e4 = 71.0 / 1920, e5 = -17253.0 / 339200, e6 = 22.0 / 525,
                    e7 = -1.0 / 40;
static const double d1 = -12715105075.0 / 11282082432.0, d3 = 87487479700.0 / 32700410799.0,
                    d4 = -10690763975.0 / 1880347072.0, d5 = 701980252875.0 / 199316789632.0,
                    d6 = -1453857185.0 / 822651844.0, d7 = 69997945.0 / 29380423.0;

static const double safety = 0.9, smallest_factor = 0.1, largest_factor = 5.0;

/* The arrays of the block, [size] each: the states, the slopes of 7 stages, 5 coefficients of the dense output. */
enum { STATES, SLOPES, DENSE = SLOPES + 7, ARRAYS = DENSE + 5 };

size_t integrator_count(void)
{
    return ARRAYS * model.n_states;
}

void integrator_bind(Integrator *integrator, double *block)
{
    integrator->arrays = block;
}

static double *states_of(const Integrator *integrator)
{
    return integrator->arrays;
}

/* Returns the slope of stage 1 to 7. */
static double *slope_of(const Integrator *integrator, size_t stage)
{
    return integrator->arrays + (SLOPES + stage - 1) * model.n_states;
}

void integrator_restart(Integrator *integrator, double time, const double *states)
{
    StepRecord *record = &integrator->record;
    record->time = record->base = time;
    record->step = 0.0;
    record->slope_known = false;
    if (model.n_states > 0)
        memmove(states_of(integrator), states, model.n_states * sizeof(double));
}

/* Evaluates the dense output at the fraction s of the step. */
static void interpolate(const double *arrays, double s, double *states)
{
    const size_t n = model.n_states;
    const double *r1 = arrays + DENSE * n, *r2 = r1 + n, *r3 = r2 + n, *r4 = r3 + n, *r5 = r4 + n;
    const double r = 1.0 - s;
    for (size_t i = 0; i < n; ++i)
        states[i] = r1[i] + s * (r2[i] + r * (r3[i] + s * (r4[i] + r * r5[i])));
}

void integrator_interpolate(const Integrator *integrator, double time, double *states)
{
    const StepRecord *record = &integrator->record;
    if (time != record->time)
        interpolate(integrator->arrays, (time - record->base) / record->step, states);
    else if (model.n_states > 0)
        memcpy(states, states_of(integrator), model.n_states * sizeof(double));
}

void integrator_truncate(Integrator *integrator, double time)
{
    StepRecord *record = &integrator->record;
    if (time != record->time)
        interpolate(integrator->arrays, (time - record->base) / record->step, states_of(integrator));
    record->time = time;
    record->slope_known = false;
    /* A truncated step must not let the steps grow: rounding spoils the dense output of a step of which only a
     * tiny part is used. */
    record->suggestion = smaller(record->suggestion, record->step);
}

/* Returns x^(-1/10) within 1 % for results between 0.1 and 6.3; step sizes use no others. That is accurate enough for a
 * step size, takes far less time than pow(), and gives the same number on every platform. The bits of a double, read as
 * an integer, are its binary logarithm in units of 2^-52, offset by 1023 and linear between the powers of 2. */
static double inverse_tenth_root(double x)
{
    static const double unit = 4503599627370496.0 /* 2^52 */, bias = 1023.0;
    const uint64_t digits = ((uint64_t)1 << 52) - 1, one = (uint64_t)1023 << 52;
    const double bounded = smaller(larger(x, 1e-8), 1e10);
    uint64_t bits;
    memcpy(&bits, &bounded, sizeof bits);
    bits = (uint64_t)(int64_t)(1.1 * bias * unit - 0.1 * (double)(int64_t)bits);
    double power, mantissa;
    memcpy(&power, &bits, sizeof power);
    bits = (bits & digits) | one;
    memcpy(&mantissa, &bits, sizeof mantissa);
    return power * (0.998 - 0.245 * (mantissa - 1.0) * (2.0 - mantissa));
}

/* Steps are not shorter than this. */
static double shortest_step(const StepRecord *record)
{
    return larger(16.0 * DBL_EPSILON * fabs(record->time), 16.0 * DBL_MIN);
}

static bool evaluate(Integrator *integrator, double time, StepPoint point, double *slope)
{
    ++integrator->record.evaluations;
    return integrator_derivatives(integrator->context, time, point, slope);
}

static double weight(const Integrator *integrator, size_t i, double magnitude)
{
    return 1.0 / (integrator->tolerance * (integrator->nominal[i] + magnitude));
}

/* Guesses a first step from the norms of the first and second derivatives (Hairer, Norsett, Wanner, section II.4). */
static bool guess_step(Integrator *integrator)
{
    const size_t n = model.n_states;
    StepRecord *record = &integrator->record;
    const double *y = states_of(integrator), *slope = slope_of(integrator, 1);
    double *other = slope_of(integrator, 2);
    double states_norm = 0.0, slope_norm = 0.0, curvature = 0.0;
    for (size_t i = 0; i < n; ++i) {
        const double w = weight(integrator, i, fabs(y[i]));
        states_norm = larger(states_norm, fabs(w * y[i]));
        slope_norm = larger(slope_norm, fabs(w * slope[i]));
    }
    const bool usable = states_norm >= 1e-5 && slope_norm >= 1e-5;
    const double small = smaller(usable ? 0.01 * states_norm / slope_norm : 1e-6, integrator->largest_step);
    for (size_t i = 0; i < n; ++i)
        integrator->argument[i] = y[i] + small * slope[i];
    if (!evaluate(integrator, record->time + small, STEP_ELSEWHERE, other))
        return false;
    for (size_t i = 0; i < n; ++i)
        curvature = larger(curvature, fabs(weight(integrator, i, fabs(y[i])) * (other[i] - slope[i])));
    const double largest = larger(slope_norm, curvature / small);
    const double fitting = largest <= 1e-15 ? larger(1e-6, small * 1e-3) : pow(0.01 / largest, 0.2);
    record->suggestion = smaller(smaller(100.0 * small, fitting), integrator->largest_step);
    return isfinite(record->suggestion);
}

/* out = states + h * (weight[0] * slope 1 + weight[1] * slope 2 + ...) */
static inline void combine(const double *arrays, double h, const double *weight, size_t stages, double *out)
{
    const size_t n = model.n_states;
    const double *y = arrays + STATES * n, *k = arrays + SLOPES * n;
    for (size_t i = 0; i < n; ++i) {
        double sum = weight[0] * k[i];
        for (size_t j = 1; j < stages; ++j)
            if (weight[j] != 0.0)
                sum += weight[j] * k[j * n + i];
        out[i] = y[i] + h * sum;
    }
}

/* Computes one stage of a step of size h. `number` is always a literal, so that compilers unroll the weights' loop. */
static inline bool stage(Integrator *integrator, size_t number, double h, double end)
{
    const StepPoint point = number == 4 ? STEP_SAMPLE : number == 7 ? STEP_END : STEP_ELSEWHERE;
    const double time = number < 6 ? integrator->record.time + nodes[number - 2] * h : end;
    combine(integrator->arrays, h, weights[number - 2], number - 1, integrator->argument);
    return evaluate(integrator, time, point, slope_of(integrator, number));
}

/* Computes all stages; leaves the result of order 5 in `argument`. */
static bool stages(Integrator *integrator, double h, double end)
{
    return stage(integrator, 2, h, end) && stage(integrator, 3, h, end) && stage(integrator, 4, h, end) &&
           stage(integrator, 5, h, end) && stage(integrator, 6, h, end) && stage(integrator, 7, h, end);
}

/* Returns the mean square over the states from `first` to `end`, in units of the tolerance, of the error estimate plus
 * the rounding error of the dense output, which is relative to the change over the whole step. */
static double squared_error_of(const Integrator *integrator, double h, size_t first, size_t end)
{
    const size_t n = model.n_states;
    const double *y = integrator->arrays + STATES * n, *k = integrator->arrays + SLOPES * n;
    double sum = 0.0;
    for (size_t i = first; i < end; ++i) {
        const double error = e1 * k[i] + e3 * k[2 * n + i] + e4 * k[3 * n + i] + e5 * k[4 * n + i] +
                             e6 * k[5 * n + i] + e7 * k[6 * n + i];
        const double rounding = DBL_EPSILON * (integrator->argument[i] - y[i]);
        const double scaled = (fabs(h * error) + fabs(rounding)) * weight(integrator, i, fabs(y[i]));
        sum += scaled * scaled;
    }
    return end > first ? sum / (double)(end - first) : 0.0;
}

/* Returns the largest mean square of the model's own states and of their sensitivities by one parameter: sensitivities
 * shorten steps, and never lengthen them. */
static double squared_error(const Integrator *integrator, double h)
{
    if (model.sensitivities == NULL)
        return squared_error_of(integrator, h, 0, model.n_states);
    const size_t size = model.sensitivities->n_states;
    double largest = 0.0;
    for (size_t first = 0; first < model.n_states; first += size) {
        const double error = squared_error_of(integrator, h, first, first + size);
        if (!isfinite(error))
            return INFINITY;
        largest = larger(largest, error);
    }
    return largest;
}

static void make_dense(double *restrict arrays, double h, const double *restrict end)
{
    const size_t n = model.n_states;
    double *y = arrays + STATES * n, *k = arrays + SLOPES * n, *r = arrays + DENSE * n;
    for (size_t i = 0; i < n; ++i) {
        const double change = end[i] - y[i];
        const double bend = h * k[i] - change;
        r[i] = y[i];
        r[n + i] = change;
        r[2 * n + i] = bend;
        r[3 * n + i] = change - h * k[6 * n + i] - bend;
        r[4 * n + i] = h * (d1 * k[i] + d3 * k[2 * n + i] + d4 * k[3 * n + i] + d5 * k[4 * n + i] +
                            d6 * k[5 * n + i] + d7 * k[6 * n + i]);
        y[i] = end[i];
        k[i] = k[6 * n + i];
    }
}

/* Accepts the step: computes the dense output, the new states and the first slope of the next step. */
static void accept(Integrator *integrator, double h, double end)
{
    StepRecord *record = &integrator->record;
    make_dense(integrator->arrays, h, integrator->argument);
    record->base = record->time;
    record->step = h;
    record->time = end;
    record->slope_known = true;
    ++record->accepted;
}

/* Computes the derivatives at the start of the step and a step size to try. */
static bool prepare(Integrator *integrator)
{
    StepRecord *record = &integrator->record;
    if (!record->slope_known) {
        if (model.n_states > 0)
            memcpy(integrator->argument, states_of(integrator), model.n_states * sizeof(double));
        if (!evaluate(integrator, record->time, STEP_START, slope_of(integrator, 1)))
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
    const double smallest = shortest_step(record);
    /* An event right behind another one truncates a step to less than that, which suggests nothing about the next. */
    double h = larger(smaller(record->suggestion, integrator->largest_step), smallest);
    bool rejected = false;
    for (;;) {
        /* A step that would leave a sliver before the limit is stretched to the limit. */
        const bool limited = record->time + 1.01 * h >= limit;
        if (limited)
            h = limit - record->time;
        const double end = limited ? limit : record->time + h;
        if (!(end > record->time))
            return STEP_TOO_SMALL;
        const bool computed = stages(integrator, h, end);
        const double error = computed ? squared_error(integrator, h) : INFINITY;
        if (error <= 1.0) {
            const double factor = smaller(safety * inverse_tenth_root(error), rejected ? 1.0 : largest_factor);
            const double next = smaller(h * larger(factor, smallest_factor), DBL_MAX);
            record->suggestion = limited ? larger(next, record->suggestion) : next;
            accept(integrator, h, end);
            return STEP_DONE;
        }
        ++record->rejected;
        rejected = true;
        h *= isfinite(error) ? larger(safety * inverse_tenth_root(error), smallest_factor) : smallest_factor;
        record->suggestion = h;
        if (!(h > smallest))
            return isfinite(error) ? STEP_TOO_SMALL : STEP_NOT_COMPUTABLE;
    }
}

COLD static bool is_finite(const double *values)
{
    for (size_t i = 0; i < model.n_states; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* Evaluates one stage of a step of size h, or its start as stage 1; returns whether its slope is finite. */
COLD static bool stage_succeeds(Integrator *integrator, size_t number, double h)
{
    double *slope = slope_of(integrator, number);
    if (number == 1)
        memcpy(integrator->argument, states_of(integrator), model.n_states * sizeof(double));
    else
        combine(integrator->arrays, h, weights[number - 2], number - 1, integrator->argument);
    return evaluate(integrator, integrator->record.time + h, STEP_ELSEWHERE, slope) && is_finite(slope);
}

COLD const double *integrator_find_failure(Integrator *integrator)
{
    /* The shortest step that fails leaves fewest variables that are not finite only because others are not. */
    for (double h = shortest_step(&integrator->record); model.n_states > 0 && h < 1.0; h *= 10.0)
        for (size_t number = 1; number <= STAGES; ++number)
            if (!stage_succeeds(integrator, number, number > 1 ? h : 0.0))
                return slope_of(integrator, number);
    return NULL;
}
