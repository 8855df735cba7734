/* integrator.h - the Runge-Kutta method of order 5(4) of Dormand and Prince (J. Comp. Appl. Math. 6, 1980)
 * with the dense output of order 4 of Hairer, Norsett and Wanner (Solving Ordinary Differential Equations I,
 * section II.6). It knows neither events nor inputs. `size` below is model.n_states, which is a constant to a
 * compiler that optimizes across files. */
#ifndef INTEGRATOR_H
#define INTEGRATOR_H

#include <stdbool.h>
#include <stddef.h>

/* What a saved state must hold besides the arrays; plain data. */
typedef struct {
    double time;       /* end of the last step, where the next one starts */
    double suggestion; /* size of the next step, 0 where it is not known yet */
    double base, step; /* the dense output covers base to base + step */
    bool slope_known;  /* the derivatives at `time` are in slopes[0] */
    size_t evaluations, accepted, rejected;
} StepRecord;

typedef struct {
    const double *nominal; /* [size] magnitudes of the states, for the absolute tolerance */
    double tolerance;
    double largest_step;
    double *argument; /* [size] where `derivatives` finds the states */
    void *context;

    StepRecord record;
    double *arrays; /* [integrator_count()] states at record.time, slopes of the stages, coefficients of the dense
                     * output: one block, whose parts a compiler knows to be apart */
} Integrator;

typedef enum {
    STEP_DONE,
    STEP_TOO_SMALL,      /* the error stays above the tolerance, or the step does not move the time */
    STEP_NOT_COMPUTABLE, /* the derivatives could not be computed, or were not finite */
} StepResult;

size_t integrator_count(void); /* doubles in the block */

/* Where in a step the derivatives are asked for: the start is that of a first step; the sample lies SAMPLE_FRACTION of
 * the step behind it, with states of order 3; sample and end are those of a step that may still be rejected. */
typedef enum { STEP_START, STEP_SAMPLE, STEP_END, STEP_ELSEWHERE } StepPoint;
#define SAMPLE_FRACTION 0.8

/* The derivatives at integrator->argument, which the user of the integrator supplies; false where they cannot be
 * computed. `point` is for users who look at more than derivatives. */
bool integrator_derivatives(void *context, double time, StepPoint point, double *der);

void integrator_bind(Integrator *integrator, double *block);

/* Starts anew from a point; the size of the step before is kept as a first guess. */
void integrator_restart(Integrator *integrator, double time, const double *states);

/* One accepted step from record.time, not beyond `limit`. */
StepResult integrator_step(Integrator *integrator, double limit);

/* The states at a time within the last step. */
void integrator_interpolate(const Integrator *integrator, double time, double *states);

/* Ends the last step at a time within it; it can still be interpolated up to there. */
void integrator_truncate(Integrator *integrator, double time);

#endif
