/* integrator.h - the Runge-Kutta method of order 5(4) of Dormand and Prince (J. Comp. Appl. Math. 6, 1980)
 * with the dense output of order 4 of Hairer, Norsett and Wanner (Solving Ordinary Differential Equations I,
 * section II.6). It knows neither events nor inputs. `size` below is model.n_states, a constant under link-time
 * optimization. */
#ifndef INTEGRATOR_H
#define INTEGRATOR_H

#include <stdbool.h>
#include <stddef.h>

/* The part of a saved state that is not in the arrays; plain data. */
typedef struct {
    double time;       /* end of the last step, where the next one starts */
    double suggestion; /* size of the next step, 0 if it is not known yet */
    double base, step; /* the dense output covers base to base + step */
    bool slope_known;  /* the slope of stage 1 holds the derivatives at `time` */
    size_t evaluations, accepted, rejected;
} StepRecord;

typedef struct {
    const double *nominal; /* [size] magnitudes of the states, for the absolute tolerance */
    double tolerance;
    double largest_step;
    double *argument; /* [size] the states at which integrator_derivatives evaluates */
    void *context;

    StepRecord record;
    double *arrays; /* [integrator_count()] states at record.time, slopes of the stages, coefficients of the dense
                     * output: one block, so that the compiler knows that they do not overlap */
} Integrator;

typedef enum {
    STEP_DONE,
    STEP_TOO_SMALL,      /* the error stays above the tolerance, or the step does not advance the time */
    STEP_NOT_COMPUTABLE, /* the derivatives could not be computed or were not finite */
} StepResult;

size_t integrator_count(void); /* doubles in the block */

/* Where in a step the derivatives are evaluated: at the start (first step only); at SAMPLE_FRACTION of the step, with
 * states of order 3; at the end; or elsewhere. The step may still be rejected after sample and end. */
typedef enum { STEP_START, STEP_SAMPLE, STEP_END, STEP_ELSEWHERE } StepPoint;
#define SAMPLE_FRACTION 0.8

/* Supplied by the caller: computes the derivatives at integrator->argument; returns false if that fails. `point` is for
 * callers that compute more than derivatives. */
bool integrator_derivatives(void *context, double time, StepPoint point, double *der);

void integrator_bind(Integrator *integrator, double *block);

/* Restarts from a point; the last step size is kept as a first guess. */
void integrator_restart(Integrator *integrator, double time, const double *states);

/* Takes one accepted step from record.time, not beyond `limit`. */
StepResult integrator_step(Integrator *integrator, double limit);

/* After STEP_NOT_COMPUTABLE: evaluates again where the derivatives were not finite, and returns these; NULL if they are
 * finite there. */
const double *integrator_find_failure(Integrator *integrator);

/* Computes the states at a time within the last step from the dense output. */
void integrator_interpolate(const Integrator *integrator, double time, double *states);

/* Ends the last step at a time within it; the dense output remains valid up to there. */
void integrator_truncate(Integrator *integrator, double time);

#endif
