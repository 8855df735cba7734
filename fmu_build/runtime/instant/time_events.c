#include "time_events.h"
#include "events.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Relative to the time, but to no less than a second and no more than some hours. */
static const double relative_instant = 1e-12, shortest = 1.0, longest = 1e4;

/* In spacings of numbers at a late time, as of a clock that began in 1970. */
static const double spacings = 16.0;

double instant_at(double time)
{
    const double scale = fmin(fmax(shortest, fabs(time)), longest);
    return fmax(relative_instant * scale, spacings * DBL_EPSILON * fabs(time));
}

double time_just_after(double time)
{
    return time + instant_at(time);
}

static double tick_time(const Values *values, size_t i, double number)
{
    const PeriodicClock *clock = &model.clocks[i];
    /* The sum has one common denominator, so that decimal periods and phases give the nearest double. */
    const double denominator = clock->phase_denominator * clock->period_denominator;
    return values->clock_zero[i] + (clock->phase_numerator * clock->period_denominator +
                                    number * clock->period_numerator * clock->phase_denominator) /
                                       denominator;
}

void clocks_start(Values *values)
{
    for (size_t i = 0; i < model.n_clocks; ++i) {
        const PeriodicClock *clock = &model.clocks[i];
        const double period = clock->period_numerator / clock->period_denominator;
        const double phase = clock->phase_numerator / clock->phase_denominator;
        values->clock_zero[i] = clock->counts_from_start ? values->time : 0.0;
        const double estimate = floor((values->time - values->clock_zero[i] - phase) / period) - 1.0;
        values->clock_tick[i] = fmax(0.0, estimate);
        while (time_just_after(tick_time(values, i, values->clock_tick[i])) < values->time)
            values->clock_tick[i] += 1.0;
    }
}

bool clocks_tick(Values *values)
{
    bool any = false;
    for (size_t i = 0; i < model.n_clocks; ++i) {
        if (tick_time(values, i, values->clock_tick[i]) > time_just_after(values->time))
            continue;
        values->p[model.clocks[i].activation] = 1.0;
        values->clock_tick[i] += 1.0;
        any = true;
    }
    return any;
}

void clocks_release(Values *values)
{
    for (size_t i = 0; i < model.n_clocks; ++i)
        values->p[model.clocks[i].activation] = 0.0;
}

double event_next_time(const Values *values)
{
    double next = INFINITY;
    for (size_t i = 0; i < model.n_clocks; ++i)
        next = fmin(next, tick_time(values, i, values->clock_tick[i]));
    if (model.n_time_events == 0)
        return next;
    double *when = malloc(model.n_time_events * sizeof(double));
    if (when == NULL)
        return values->time; /* triggers an event at once, which reports the lack of memory */
    model_time_events(values->p, when);
    for (size_t i = 0; i < model.n_time_events; ++i) {
        if (when[i] > time_just_after(values->time))
            next = fmin(next, when[i]);
    }
    free(when);
    return next;
}
